/* SPDX-License-Identifier: MIT
 *
 * pages_rung - the rungs of a POU on paper, all at one scale. Those that are too wide for a
 * page even so are folded: pages_fold.c.
 */
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/draw/pages_inside.h"
#include "editor-gtk/draw/rung_text.h"

#include <math.h>

#define MOST_PLACES 12 /* are told where there is no room for all                  */

/* @text is to be read behind the rungs, once for all coils of the same bit. */
static void note_reference(struct pages *pages, const struct cell *cell, const char *text)
{
	const struct rung_label label = rung_label(pages->drafting, cell);
	char *line = g_strdup_printf("%s%s%s: %s", label.symbol.text,
				     *label.symbol.text && *label.address.text ? " " : "",
				     label.address.text, text);

	if (g_ptr_array_find_with_equal_func(pages->reference, line, g_str_equal, NULL))
		g_free(line);
	else
		g_ptr_array_add(pages->reference, line);
}

static bool has_room(const struct pages *pages, const char *text, float room)
{
	return lettering_fit(pages->lettering, LETTER_PIN, text, -1, 0).width <= room;
}

/* All places, or as many as there is room for. */
static char *reference_of(void *context, int row, int col, float room)
{
	struct pages *pages = context;
	const struct cell *cell = rung_at(pages->rung, row, col);
	const char *operand = project_text(pages->project, cell->operand);
	char *text;

	if (word_row(cell->word)->operand != OPND_BOOL_W)
		return NULL;
	text = listing_reads_of(pages->reads, pages->pou, operand, 0);
	if (!text || has_room(pages, text, room))
		return text;
	note_reference(pages, cell, text);
	for (int most = MOST_PLACES; most > 0 && !has_room(pages, text, room); most--) {
		g_free(text);
		text = listing_reads_of(pages->reads, pages->pou, operand, most);
	}
	return text;
}

static void put_told(struct pages *pages, GPtrArray *lines, const char *heading)
{
	if (lines->len)
		pages_put_heading(pages, heading, 3 * TEXT_LINE);
	for (guint i = 0; i < lines->len; i++)
		pages_put_line(pages, g_ptr_array_index(lines, i));
	pages->y += lines->len ? PAGE_AIR : 0;
	g_ptr_array_set_size(lines, 0);
}

void pages_put_references(struct pages *pages)
{
	put_told(pages, pages->remark, _("Comments"));
	put_told(pages, pages->reference, _("Cross reference"));
}

struct grid_scene pages_scene(struct pages *pages, const struct sheet *sheet,
			      const struct rung_layout *layout)
{
	pages->rung = layout->rung;
	pages->drafting = &sheet->drafting;
	return (struct grid_scene){
		.drafting = &sheet->drafting, .layout = layout, .theme = pages->theme,
		.state = RUNG_NO_GUTTER, .reference = reference_of, .context = pages,
	};
}

void pages_put_rows(struct pages *pages, const struct rung_layout *layout,
		    const struct picture *picture, float scale, float from, float bottom)
{
	float end = from;

	for (int row = 0; row < layout->rows && layout->row[row].y < bottom; row++) {
		float to = fminf(layout->row[row].y + layout->row[row].height, bottom);

		if ((to - from) * scale > pages->room_height - pages->y) {
			pages_put_span(pages, picture, scale, from, end);
			pages_next(pages);
			from = end;
		}
		end = to;
	}
	pages_put_span(pages, picture, scale, from, bottom);
}

/* The first one stands below the heading of its POU, whatever it takes. */
static void put_rung(struct pages *pages, const struct sheet *sheet, int index,
		     float scale, bool first)
{
	const struct rung_layout *layout = sheet->rung[index];
	const struct grid_scene scene = pages_scene(pages, sheet, layout);
	struct picture *picture = pages_picture(pages);
	float room = pages->room_height - (first ? pages->y : 0);
	float shrunk = room / layout->height * 0.999f;

	grid_draw(&scene, picture);
	if (layout->height * scale <= room)
		pages_put_whole(pages, picture, layout->height, scale, 0);
	else if (shrunk >= PAGE_LEAST)
		pages_put_whole(pages, picture, layout->height, shrunk, 0);
	else
		pages_put_rows(pages, layout, picture, scale, 0, layout->height);
}

struct sheet *pages_sheet(struct pages *pages)
{
	struct sheet *sheet = sheet_new(pages->project,
					&pages->project->pou[pages->pou],
					pages->lettering);

	sheet->drafting.show = pages->show;
	sheet->drafting.all_comments = true;
	sheet->most = pages->room_width / PAGE_LEAST - RUNG_LEFT - RUNG_AFTER;
	sheet_layout(sheet);
	return sheet;
}

void pages_put_rungs(struct pages *pages, const struct sheet *sheet, const char *heading,
		     int first, int end)
{
	const float scale = fminf(1, pages->room_width / sheet->width);
	float more = first < end ? sheet->rung[first]->height * scale : 0;

	pages_put_heading(pages, heading, fminf(more, pages->room_height - 40));
	for (int i = first; i < end; i++) {
		if (sheet_is_wide(sheet, i))
			pages_fold(pages, sheet, i, scale, i == first);
		else
			put_rung(pages, sheet, i, scale, i == first);
		sheet_remarks(sheet, i, pages->remark);
	}
}
