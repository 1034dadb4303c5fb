/* SPDX-License-Identifier: MIT
 *
 * pages_title - the title block: the same fields at the same places on all pages, as many
 * lines high as the longest text in them needs.
 */
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/draw/pages_inside.h"

#include <math.h>
#include <string.h>

#define FIELD_AIR  16 /* px in a field beside its text                            */
#define LINE_STEP  10 /* px from a line of small type to the next                 */
#define LINES_LEAST 2 /* there is always room for these                           */
#define SHORT_TEXT 80 /* px: what is not longer is not broken                     */
#define PART_MOST  4  /* of a page are the most lines, as a divisor               */
#define PAPER_LEAST 240 /* px: on less there is no title block                      */

/* In the order in which they stand. A page gives it some of what it says. */
enum { PROJECT, NAME, UNIT, DATE, PAGE, FIELDS };
G_STATIC_ASSERT(FIELDS == PAGE_FIELDS);

/* What it is in small type, and how much room its texts need. */
struct field {
	const char *what;        /* NULL: there is none                         */
	float width;             /* px: as it is, unless somebody needs more      */
	float need, least;       /* px: in one line, or in all lines of small type */
	float label;             /* px of what it is                            */
};

static float width_of(const struct pages *pages, enum letter letter, const char *text)
{
	return lettering_fit(pages->lettering, letter, text, -1, 0).width;
}

static bool fits(const struct pages *pages, const char *text, float room, int lines)
{
	return lettering_lines(pages->lettering, LETTER_BADGE, text, room) <= lines;
}

/* The least that a text needs in so many lines of small type, to a pixel. */
static float broken_width(const struct pages *pages, const char *text, int lines)
{
	float more = ceilf(width_of(pages, LETTER_BADGE, text)), less = floorf(more / (float)lines);

	while (more - less > 1) {
		const float middle = floorf((less + more) / 2);

		if (fits(pages, text, middle, lines))
			more = middle;
		else
			less = middle;
	}
	return more;
}

static void measure(const struct pages *pages, struct field *field, const char *text)
{
	const float what = width_of(pages, LETTER_BADGE, field->what) + FIELD_AIR + 1;
	const float one = width_of(pages, LETTER_SYMBOL, text) + FIELD_AIR + 1;

	field->label = what;
	field->need = MAX(field->need, MAX(what, one));
}

static void measure_least(const struct pages *pages, struct field *field, const char *text)
{
	const float broken = MAX(broken_width(pages, text, pages->title_lines),
				 MIN(width_of(pages, LETTER_BADGE, text), SHORT_TEXT));

	field->least = MAX(field->least, MAX(field->label, MIN(field->need, broken + FIELD_AIR + 1)));
}

/* As it is drawn: a tab is a blank, and nothing begins a line of its own. Borrowed until
 * lettering_trim(). */
static const char *drawn(const struct pages *pages, const char *text)
{
	return lettering_fit(pages->lettering, LETTER_BADGE, text, -1, 0).text;
}

static const char *file_name(const struct pages *pages)
{
	return drawn(pages, pages->file);
}

static const char *project_title(const struct pages *pages)
{
	const char *title = project_text(pages->project, pages->project->title);

	return *title ? drawn(pages, title) : file_name(pages);
}

/* As wide on all pages: what differs from one to the next is measured on each. */
static void measure_fields(const struct pages *pages, struct field *field,
			   void (*measured)(const struct pages *pages, struct field *field,
					    const char *text))
{
	const int count = pages_count(pages);

	measured(pages, &field[PROJECT], project_title(pages));
	measured(pages, &field[NAME], file_name(pages));
	for (int i = 0; i < count; i++)
		if (i == 0 || strcmp(pages_subject(pages, i), pages_subject(pages, i - 1)) != 0)
			measured(pages, &field[UNIT], pages_subject(pages, i));
	if (pages->date)
		measured(pages, &field[DATE], drawn(pages, pages->date));
}

/* What all fields need in so many lines, px. */
static float needed(const struct pages *pages, struct field *field)
{
	float sum = 0;

	for (int i = 0; i < FIELDS; i++)
		field[i].least = i == PAGE ? field[i].need : 0;
	measure_fields(pages, field, measure_least);
	for (int i = 0; i < FIELDS; i++)
		sum += field[i].least;
	return sum;
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
	/* Too much for all: some are written in more lines, the name of the project first. */
	for (int i = 0; i < FIELDS && over > 0; i++) {
		const float less = MIN(over, field[i].need - field[i].least);

		field[i].width -= less;
		over -= less;
	}
	/* And what even so has no room ends in an ellipsis: that name first, which is told elsewhere. */
	for (int i = PROJECT; i <= UNIT && over > 0; i++) {
		const float less = MIN(over, field[i].width - field[i].label);

		field[i].width -= less;
		over -= less;
	}
}

float pages_title_height(const struct pages *pages)
{
	const int lines = MAX(pages->title_lines, LINES_LEAST); /* not measured: 0 */

	return pages->height < PAPER_LEAST ? 0 : (float)(16 + LINE_STEP * lines);
}

/* The name of the project has no room, and had before. */
static bool is_cut_now(struct pages *pages)
{
	const bool before = pages->title_cut;

	pages->title_cut |= !fits(pages, project_title(pages),
				  pages->field[PROJECT] - FIELD_AIR, pages->title_lines);
	return pages->title_cut && !before;
}

bool pages_measure_title(struct pages *pages)
{
	const float width = pages->room_width, part = width / 100;
	const int before = MAX(pages->title_lines, LINES_LEAST);
	int most = (int)(pages->height / PART_MOST / LINE_STEP);
	char *last = g_strdup_printf(_("%d of %d"), pages_count(pages), pages_count(pages));
	struct field field[FIELDS] = {
		[PROJECT] = { _("Project"), 34 * part, 0, 0, 0 },
		[NAME] = { _("File"), 22 * part, 0, 0, 0 },
		[UNIT] = { _("Program unit"), (pages->date ? 14 : 30) * part, 0, 0, 0 },
		[DATE] = { pages->date ? _("Date") : NULL, pages->date ? 16 * part : 0, 0, 0, 0 },
		[PAGE] = { _("Page"), 14 * part, 0, 0, 0 },
	};

	measure_fields(pages, field, measure);
	measure(pages, &field[PAGE], last);
	for (int less = before; less < most;) {
		pages->title_lines = (less + most) / 2;
		if (needed(pages, field) > width)
			less = pages->title_lines + 1;
		else
			most = pages->title_lines;
	}
	pages->title_lines = most;
	needed(pages, field);
	share_width(field, width);
	for (int i = 0; i < FIELDS; i++)
		pages->field[i] = field[i].width;
	g_free(last);
	return pages->title_lines > before || is_cut_now(pages);
}

static void draw_field(const struct pages *pages, struct picture *picture, const char *what,
		       const char *text, float x, float width)
{
	const float room = width - FIELD_AIR, end = x + width, height = pages_title_height(pages);
	const bool wide = width_of(pages, LETTER_SYMBOL, text) > room;
	const bool broken = wide && width_of(pages, LETTER_BADGE, text) > room;
	const enum letter letter = wide ? LETTER_BADGE : LETTER_SYMBOL;

	if (end < pages->room_width - 1)
		picture_line(picture, TOKEN_INK, STROKE_SOLID, 0.75f, end, 0, end, height);
	picture_text(picture, TOKEN_COMMENT, LETTER_BADGE,
		     lettering_fit(pages->lettering, LETTER_BADGE, what, -1, room),
		     x + 8, broken ? 11 : 12);
	for (int line = 0; *text; line++)
		picture_text(picture, TOKEN_INK, letter,
			     lettering_line(pages->lettering, letter, &text, room,
					    line == pages->title_lines - 1), x + 8,
			     broken ? 22 + (float)(line * LINE_STEP) : 29);
}

void pages_draw_title(const struct pages *pages, int page, struct picture *picture)
{
	const float height = pages_title_height(pages);
	char *count = g_strdup_printf(_("%d of %d"), page + 1, pages_count(pages));
	const char *what[FIELDS] = { _("Project"), _("File"), _("Program unit"), _("Date"),
				     _("Page") };
	const char *date = pages->date ? drawn(pages, pages->date) : NULL;
	const char *text[FIELDS] = { project_title(pages), file_name(pages),
				     pages_subject(pages, page), date, count };
	float x = 0;

	picture_move(picture, PAGE_MARGIN, pages->height - PAGE_MARGIN - height);
	picture_frame(picture, TOKEN_INK, STROKE_SOLID, 0.75f, 0, 0, pages->room_width, height);
	for (int i = 0; i < FIELDS; i++) {
		if (text[i])
			draw_field(pages, picture, what[i], text[i], x, pages->field[i]);
		x += pages->field[i];
	}
	g_free(count);
}
