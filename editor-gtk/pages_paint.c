/* SPDX-License-Identifier: MIT
 *
 * pages_paint - one page upon a cairo surface, with its title block.
 */
#include "editor-gtk/i18n.h"
#include "editor-gtk/pages_inside.h"

#include <string.h>

static void paint_piece(const struct pages *pages, const struct piece *piece, cairo_t *cr)
{
	cairo_save(cr);
	cairo_translate(cr, PAGE_MARGIN, (double)(PAGE_MARGIN + piece->y));
	cairo_scale(cr, (double)piece->scale, (double)piece->scale);
	if (piece->right > 0)
		cairo_rectangle(cr, (double)piece->x, 0, (double)(piece->right - piece->left),
				(double)(piece->to - piece->from));
	else
		cairo_rectangle(cr, -PAGE_MARGIN, 0, (double)(pages->width / piece->scale),
				(double)(piece->to - piece->from));
	cairo_clip(cr);
	cairo_translate(cr, (double)(piece->x - piece->left), (double)-piece->from);
	picture_cairo(piece->picture, pages->theme, pages->lettering, cr);
	cairo_restore(cr);
}

/* ---- the title block ---- */

enum { PROJECT, NAME, UNIT, DATE, PAGE, FIELDS };

#define FIELD_AIR 16 /* px in a field beside its text                                */

/* What it is in small type, and its text. */
struct field {
	const char *what, *text; /* what NULL: there is none                    */
	float width;             /* px: as it is, unless somebody needs more      */
	float need, least;       /* px: its text in one line, or in two of small type */
	float label;             /* px of what it is                            */
};

static float width_of(const struct pages *pages, enum letter letter, const char *text)
{
	return lettering_fit(pages->lettering, letter, text, -1, 0).width;
}

/* The least that a text needs in two lines of small type. */
static float broken_width(const struct pages *pages, const char *text)
{
	const float whole = width_of(pages, LETTER_BADGE, text);
	float room = whole / 2;

	while (room < whole &&
	       width_of(pages, LETTER_BADGE, text + lettering_wrap(pages->lettering,
				LETTER_BADGE, text, room)) > room)
		room += 4;
	return room;
}

static void measure(const struct pages *pages, struct field *field, const char *text)
{
	const float what = width_of(pages, LETTER_BADGE, field->what) + FIELD_AIR + 1;
	const float one = width_of(pages, LETTER_SYMBOL, text) + FIELD_AIR + 1;
	const float two = broken_width(pages, text) + FIELD_AIR + 1;

	field->label = what;
	field->need = MAX(field->need, MAX(what, one));
	field->least = MAX(field->least, MAX(what, MIN(one, two)));
}

/* Fields that need more get it from those that need less than they have. */
static void share_width(struct field *field, float width)
{
	float lacking = 0, spare = 0, over = -width;

	for (int i = 0; i < FIELDS; i++) {
		lacking += MAX(0, field[i].need - field[i].width);
		spare += MAX(0, field[i].width - field[i].need);
		over += field[i].need;
	}
	for (int i = 0; i < FIELDS; i++)
		if (over > 0 || field[i].need > field[i].width)
			field[i].width = field[i].need;
		else if (spare > 0)
			field[i].width -= (field[i].width - field[i].need) * lacking / spare;
	/* Too much for all: some are written in two lines, the name of the project first. */
	for (int i = 0; i < FIELDS && over > 0; i++) {
		const float less = MIN(over, field[i].need - field[i].least);

		field[i].width -= less;
		over -= less;
	}
	/* And what even so has no room ends in an ellipsis. */
	spare = 0;
	for (int i = PROJECT; i <= UNIT; i++)
		spare += field[i].width - field[i].label;
	for (int i = PROJECT; i <= UNIT && over > 0 && spare > 0; i++)
		field[i].width -= MIN(1, over / spare) * (field[i].width - field[i].label);
}

static void draw_field(const struct pages *pages, struct picture *picture,
		       const struct field *field, float x)
{
	const float room = field->width - FIELD_AIR, end = x + field->width;
	const bool wide = width_of(pages, LETTER_SYMBOL, field->text) > room;
	const bool broken = wide && width_of(pages, LETTER_BADGE, field->text) > room;
	const enum letter letter = wide ? LETTER_BADGE : LETTER_SYMBOL;
	const size_t first = broken ? lettering_wrap(pages->lettering, letter, field->text,
						     room) : strlen(field->text);
	size_t shown = first;

	while (shown > 1 && field->text[shown - 1] == ' ')
		shown--;
	if (end < pages->room_width - 1)
		picture_line(picture, TOKEN_INK, STROKE_SOLID, 0.75f, end, 0, end, 36);
	picture_text(picture, TOKEN_COMMENT, LETTER_BADGE,
		     lettering_fit(pages->lettering, LETTER_BADGE, field->what, -1, room),
		     x + 8, broken ? 11 : 12);
	picture_text(picture, TOKEN_INK, letter,
		     lettering_fit(pages->lettering, letter, field->text, (ptrdiff_t)shown,
				   room), x + 8, broken ? 22 : 29);
	if (broken)
		picture_text(picture, TOKEN_INK, letter,
			     lettering_fit(pages->lettering, letter, field->text + first,
					   -1, room), x + 8, 32);
}

/* As wide on all pages: what differs from one to the next is measured on each. */
static void measure_fields(const struct pages *pages, struct field *field, const char *last)
{
	for (int i = 0; i < FIELDS; i++)
		if (field[i].what)
			measure(pages, &field[i], field[i].text);
	for (int i = 0; i < pages_count(pages); i++)
		measure(pages, &field[UNIT], pages_subject(pages, i));
	measure(pages, &field[PAGE], last);
	field[PAGE].least = field[PAGE].need;
}

static void title_block(const struct pages *pages, int page, struct picture *picture)
{
	const char *title = project_text(pages->project, pages->project->title);
	const float width = pages->room_width, part = width / 100;
	const int pages_all = pages_count(pages);
	char *count = g_strdup_printf(_("%d of %d"), page + 1, pages_all);
	char *last = g_strdup_printf(_("%d of %d"), pages_all, pages_all);
	struct field field[FIELDS] = {
		[PROJECT] = { _("Project"), *title ? title : pages->file, 34 * part, 0, 0, 0 },
		[NAME] = { _("File"), pages->file, 22 * part, 0, 0, 0 },
		[UNIT] = { _("Program unit"), pages_subject(pages, page),
			   (pages->date ? 14 : 30) * part, 0, 0, 0 },
		[DATE] = { pages->date ? _("Date") : NULL, pages->date,
			   pages->date ? 16 * part : 0, 0, 0, 0 },
		[PAGE] = { _("Page"), count, 14 * part, 0, 0, 0 },
	};
	float x = 0;

	measure_fields(pages, field, last);
	share_width(field, width);
	picture_move(picture, PAGE_MARGIN, pages->height - PAGE_MARGIN - 36);
	picture_frame(picture, TOKEN_INK, STROKE_SOLID, 0.75f, 0, 0, width, 36);
	for (int i = 0; i < FIELDS; i++) {
		if (field[i].what)
			draw_field(pages, picture, &field[i], x);
		x += field[i].width;
	}
	g_free(count);
	g_free(last);
}

void pages_paint(const struct pages *pages, int page, cairo_t *cr)
{
	const struct page *this = g_ptr_array_index(pages->page, page);
	struct picture picture;

	cairo_save(cr);
	cairo_scale(cr, 0.75, 0.75); /* px of 1/96 inch to points */
	for (guint i = 0; i < this->piece->len; i++)
		paint_piece(pages, &g_array_index(this->piece, struct piece, i), cr);
	picture_init(&picture);
	title_block(pages, page, &picture);
	picture_cairo(&picture, pages->theme, pages->lettering, cr);
	picture_clear(&picture);
	cairo_restore(cr);
}
