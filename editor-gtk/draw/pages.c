/* SPDX-License-Identifier: MIT
 *
 * pages - breaking a project into pages; see pages.h. Rungs are pages_rung.c and
 * pages_fold.c, charts pages_chart.c, painting is pages_paint.c and pages_title.c.
 */
#include "editor-gtk/draw/pages_inside.h"
#include "editor-gtk/kit/i18n.h"

#include <math.h>

#define TITLE_AIR   16 /* px above the title block                             */
#define HEADING_LINE 24 /* px from a line of a heading to the next              */

bool paper_find(const char *name, struct paper *out)
{
	static const struct { const char *name; float width, height; } known[] = {
		{ "a4", 210, 297 }, { "a3", 297, 420 }, { "a5", 148, 210 },
		{ "letter", 215.9f, 279.4f }, { "legal", 215.9f, 355.6f },
	};

	for (size_t i = 0; i < G_N_ELEMENTS(known); i++)
		if (g_ascii_strcasecmp(name, known[i].name) == 0) {
			out->width = known[i].width;
			out->height = known[i].height;
			return true;
		}
	return false;
}

/* ---- the flow ---- */

static struct page *page_now(struct pages *pages)
{
	return g_ptr_array_index(pages->page, pages->page->len - 1);
}

static void page_free(gpointer pointer)
{
	struct page *page = pointer;

	g_array_unref(page->piece);
	g_free(page->subject);
	g_free(page);
}

void pages_next(struct pages *pages)
{
	struct page *page = g_new0(struct page, 1);

	page->piece = g_array_new(FALSE, FALSE, sizeof(struct piece));
	page->subject = g_strdup(pages->subject);
	g_ptr_array_add(pages->page, page);
	pages->y = 0;
}

static void picture_free(gpointer pointer)
{
	picture_clear(pointer);
	g_free(pointer);
}

struct picture *pages_picture(struct pages *pages)
{
	struct picture *picture = g_new(struct picture, 1);

	picture_init(picture);
	g_ptr_array_add(pages->picture, picture);
	return picture;
}

static void put_piece(struct pages *pages, const struct picture *picture, float scale,
		      float from, float to)
{
	struct piece piece = { picture, pages->y, scale, from, to, pages->left,
			       pages->right, pages->x };
	struct piece beside = { pages->beside, pages->y, scale, from, to, 0, 0, 0 };

	g_array_append_val(page_now(pages)->piece, piece);
	if (pages->beside)
		g_array_append_val(page_now(pages)->piece, beside);
	pages->y += (to - from) * scale;
}

void pages_put_whole(struct pages *pages, const struct picture *picture, float height,
		     float scale, float more)
{
	if (pages->y > 0 && pages->y + height * scale + more > pages->room_height)
		pages_next(pages);
	put_piece(pages, picture, scale, 0, height);
}

/* ---- what is put on them ---- */

void pages_put_heading(struct pages *pages, const char *text, float more)
{
	struct picture *picture = pages_picture(pages);
	int lines = 0;

	while (*text || !lines) {
		const struct lettered line = lettering_line(pages->lettering, LETTER_HEADING,
							    &text, pages->room_width, false);

		picture_text(picture, TOKEN_INK, LETTER_HEADING, line, 0,
			     20 + (float)(lines++ * HEADING_LINE));
	}
	pages_put_whole(pages, picture, 32 + (float)((lines - 1) * HEADING_LINE), 1, more);
}

void pages_put_span(struct pages *pages, const struct picture *picture, float scale,
		    float from, float end)
{
	while (from < end) {
		float to = fminf(end, from + (pages->room_height - pages->y) / scale);

		put_piece(pages, picture, scale, from, to);
		from = to;
		if (from < end)
			pages_next(pages);
	}
}

bool pages_can_cut(const struct picture *picture, float x, float top, float room)
{
	for (int i = 0; i < picture->count; i++) {
		const struct stroke *stroke = &picture->stroke[i];
		const bool solid = stroke->kind == STROKE_TEXT ||
			((stroke->kind == STROKE_FILL || stroke->kind == STROKE_FRAME) &&
			 stroke->w < room / 2);

		if (solid && stroke->y > top && stroke->x < x && stroke->x + stroke->w > x)
			return false;
	}
	return true;
}

void pages_put_line(struct pages *pages, const char *line)
{
	GString *text = g_string_new(line);
	float room = pages->room_width - 8;

	g_string_replace(text, "\t", "        ", 0);
	for (const char *at = text->str; at == text->str || *at;) {
		struct picture *picture = pages_picture(pages);
		size_t len = lettering_wrap(pages->lettering, LETTER_OPERAND, at, room);

		picture_text(picture, TOKEN_INK, LETTER_OPERAND,
			     lettering_fit(pages->lettering, LETTER_OPERAND, at,
					   (ptrdiff_t)len, 0), 8, 12);
		pages_put_whole(pages, picture, TEXT_LINE, 1, 0);
		at += len;
	}
	g_string_free(text, TRUE);
}

void pages_put_list(struct pages *pages, const char *heading, char **lines)
{
	pages_put_heading(pages, heading, 3 * TEXT_LINE);
	for (int i = 0; lines && lines[i]; i++)
		pages_put_line(pages, lines[i]);
	g_strfreev(lines);
}

/* ---- symbols ---- */

static const float share[LISTING_COLUMNS + 1] = { 0, 0.24f, 0.40f, 0.52f, 0.66f, 1 };

/* One cell, in as many lines as it takes; returns them. */
static int put_cell(const struct pages *pages, struct picture *picture, int column,
		    enum letter letter, enum token token, const char *text)
{
	float x = share[column] * pages->room_width;
	float room = (share[column + 1] - share[column]) * pages->room_width - 8;
	int lines = 0;

	while (*text) {
		size_t len = lettering_wrap(pages->lettering, letter, text, room);

		picture_text(picture, token, letter,
			     lettering_fit(pages->lettering, letter, text, (ptrdiff_t)len,
					   0), x, 12.5f + (float)(lines++ * TEXT_LINE));
		text += len;
	}
	return lines;
}

/* A row of the table; returns its height. */
static float draw_cells(const struct pages *pages, struct picture *picture,
			char *cell[LISTING_COLUMNS], bool head)
{
	int most = 1;

	for (int i = 0; i < LISTING_COLUMNS; i++) {
		enum letter letter = head ? LETTER_TYPE : i == LISTING_COMMENT ?
			LETTER_COMMENT : i == LISTING_NAME ? LETTER_SYMBOL : LETTER_OPERAND;
		int lines = put_cell(pages, picture, i, letter,
				     head ? TOKEN_COMMENT : TOKEN_INK, cell[i]);

		most = MAX(most, lines);
	}
	float height = (float)(most * TEXT_LINE) + 2;
	picture_fill(picture, TOKEN_LINE, 1, 0, height - 1, pages->room_width, 0.75f);
	return height;
}

static void put_table(struct pages *pages, const struct var_table *table,
		      const char *heading)
{
	const int count = vars_declared(table), first = listing_first(table);
	char *head[LISTING_COLUMNS] = { _("Name"), _("Type"), _("Address"),
					_("Initial value"), _("Comment") };

	if (first == count)
		return;
	pages_put_heading(pages, heading, 5 * TEXT_LINE);
	struct picture *top = pages_picture(pages);
	float top_height = draw_cells(pages, top, head, true);
	pages_put_whole(pages, top, top_height, 1, 2 * TEXT_LINE);
	for (int i = first; i < count; i++) {
		struct picture *picture = pages_picture(pages);
		char *cell[LISTING_COLUMNS];

		listing_symbol(pages->project, table, i, cell);
		float height = draw_cells(pages, picture, cell, false);
		if (pages->y + height > pages->room_height) {
			pages_next(pages);
			put_piece(pages, top, 1, 0, top_height);
		}
		put_piece(pages, picture, 1, 0, height);
		for (int c = 0; c < LISTING_COLUMNS; c++)
			g_free(cell[c]);
	}
	pages->y += PAGE_AIR;
}

static void put_symbols(struct pages *pages)
{
	const struct project *project = pages->project;
	bool any = project->globals.count > 0;

	for (int i = 0; i < project->pou_count; i++)
		any |= listing_count(&project->pou[i].vars) > 0;
	if (!any)
		return;
	pages->subject = _("Symbols");
	pages_next(pages);
	put_table(pages, &project->globals, _("Global symbols"));
	for (int i = 0; i < project->pou_count; i++) {
		char *heading = g_strdup_printf(_("Symbols of %s"),
			project_text(project, project->pou[i].name));

		put_table(pages, &project->pou[i].vars, heading);
		g_free(heading);
	}
}

static void put_ladder(struct pages *pages, const char *heading, int only)
{
	struct sheet *sheet = pages_sheet(pages);

	pages_put_rungs(pages, sheet, heading, only ? only - 1 : 0,
			only ? only : sheet->count);
	pages_put_references(pages);
	sheet_free(sheet);
}

static void put_pou(struct pages *pages, int index, int rung)
{
	const struct pou *pou = &pages->project->pou[index];
	const char *name = project_text(pages->project, pou->name);
	char *heading = g_strdup_printf("%s %s", pou_word(pou->kind), name);

	pages->pou = index;
	pages->subject = name;
	pages_next(pages);
	if (pou->language == LANGUAGE_IL)
		pages_put_list(pages, heading, listing_il(pages->project, pou));
	else if (pou->sfc && !rung)
		pages_put_chart(pages, heading);
	else
		put_ladder(pages, heading, rung);
	g_free(heading);
}

/* Of a project whose name has no room in the title block. */
static void put_name(struct pages *pages)
{
	char **line;

	if (!pages->title_cut)
		return;
	line = g_new0(char *, 2);
	line[0] = g_strdup(project_text(pages->project, pages->project->title));
	pages->subject = _("Project");
	pages_next(pages);
	pages_put_list(pages, _("Project"), line);
}

/* Above a title block as high as it was measured; what was put before that goes. */
static void put_all(struct pages *pages, int pou, int rung)
{
	g_ptr_array_set_size(pages->page, 0);
	g_ptr_array_set_size(pages->picture, 0);
	pages->room_height = fmaxf(TEXT_LINE, pages->height - 2 * PAGE_MARGIN - TITLE_AIR -
				   pages_title_height(pages));
	for (int i = 0; i < pages->project->pou_count; i++)
		if (pou < 0 || pou == i)
			put_pou(pages, i, rung);
	if (pou < 0)
		put_symbols(pages);
	put_name(pages);
	if (pages->page->len == 0)
		pages_next(pages);
}

struct pages *pages_new(const struct project *project, const char *file, int pou, int rung,
			enum drafting_show show, const struct paper *paper,
			struct lettering *lettering)
{
	struct pages *pages = g_new0(struct pages, 1);
	float width = paper->landscape ? paper->height : paper->width;
	float height = paper->landscape ? paper->width : paper->height;

	pages->project = project;
	pages->lettering = lettering;
	pages->theme = theme_get(THEME_PRINT, THEME_GREEN);
	pages->show = show;
	pages->file = g_path_get_basename(file);
	pages->date = g_strdup(paper->date);
	pages->width = width * PAGE_PX;
	pages->height = height * PAGE_PX;
	pages->room_width = pages->width - 2 * PAGE_MARGIN;
	pages->page = g_ptr_array_new_with_free_func(page_free);
	pages->picture = g_ptr_array_new_with_free_func(picture_free);
	pages->reads = listing_reads_new(project);
	pages->reference = g_ptr_array_new_with_free_func(g_free);
	pages->remark = g_ptr_array_new_with_free_func(g_free);
	do
		put_all(pages, pou, rung);
	while (pages_measure_title(pages));
	return pages;
}

void pages_free(struct pages *pages)
{
	if (!pages)
		return;
	listing_reads_free(pages->reads);
	g_ptr_array_unref(pages->reference);
	g_ptr_array_unref(pages->remark);
	g_ptr_array_unref(pages->page);
	g_ptr_array_unref(pages->picture);
	g_free(pages->file);
	g_free(pages->date);
	g_free(pages);
}

const char *pages_subject(const struct pages *pages, int page)
{
	const struct page *of = g_ptr_array_index(pages->page, page);

	return of->subject ? of->subject : "";
}

int pages_count(const struct pages *pages)
{
	return (int)pages->page->len;
}
