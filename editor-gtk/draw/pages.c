/* SPDX-License-Identifier: MIT
 *
 * pages - breaks a project into pages and paints them; see pages.h.
 *
 * Everything is first drawn as pictures, whose pieces are placed on pages, one below the
 * other. A rung that is too wide for a page is folded: its columns continue in strips below
 * each other, and both ends of each cut wire have the same number. A chart continues across
 * and down over as many pages as it needs. The title block has the same fields in the same
 * places on all pages; its longest text sets its height.
 */
#include "editor-gtk/draw/pages.h"
#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/draw/rung_text.h"
#include "editor-gtk/draw/sfc_bodies.h"
#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/kit/i18n.h"

#include <cairo-pdf.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define PAGE_PX     (96 / 25.4f) /* px a mm                                     */
#define PAGE_MARGIN 45           /* px: 12 mm                                   */
#define TEXT_LINE   16           /* px of a line of IL or of a table             */
#define PAGE_AIR    14           /* px between parts of a page                   */
#define PAGE_LEAST  0.6f         /* least scale of rungs and charts: 5.1 pt          */
#define ABOVE_TITLE 16           /* px above the title block                     */
#define HEADING_LINE 24          /* px from line to line of a heading            */
#define MOST_PLACES 12 /* most places below a coil if not all fit                */
#define MOST_STRIPS LIMIT_COLS
#define LINK_AIR    3    /* px behind a link that stays with its row                  */
#define MARK        38   /* px of an arrow with its number                           */
#define ARROW       12   /* px of the arrow alone                                    */
#define HEAD        5    /* px of its tip                                            */
#define FIELD_AIR  16 /* px beside the text of a field                            */
#define LINE_STEP  10 /* px from line to line of small type                       */
#define LINES_LEAST 2 /* lines that always fit                                    */
#define SHORT_TEXT 80 /* px: a shorter text is not broken                         */
#define PART_MOST  4  /* the lines take at most this part of a page, as a divisor */
#define PAPER_LEAST 240 /* px: a lower page has no title block                      */

/* In the order of the title block. MAKER and STATE are properties of the project. */
enum { PROJECT, NAME, UNIT, MAKER, STATE, DATE, PAGE, FIELDS };

/* Part of a picture on a page. */
struct piece {
	const struct picture *picture;
	float y;         /* below the upper margin                               */
	float scale;
	float from, to;  /* px of the picture: the part that is shown             */
	float left, right; /* the same across; both 0: all of it                 */
	float x;         /* of the page: where @left is drawn, px of the picture  */
};
struct page {
	GArray *piece;
	char *subject;   /* name of the POU, or "Symbols"                        */
};

struct pages {
	const struct project *project;
	struct lettering *lettering;
	const struct theme *theme;
	enum drafting_show show;
	char *file, *date;
	char *maker, *state;           /* of the properties; NULL: none are given */
	float width, height;           /* px of a page                          */
	float room_width, room_height; /* px inside the margins, above the title block */
	float field[FIELDS];      /* px: widths of the fields of the title block */
	int title_lines;               /* of small type in the fields; 0: not measured */
	bool title_cut;                /* the name of the project does not fit  */
	GPtrArray *page, *picture;
	struct listing_reads *reads;
	/* While the pages are made: */
	float y;                       /* px: start of the free part of the last page */
	float left, right, x;          /* of the next piece: struct piece        */
	const struct picture *beside;  /* drawn beside it, in full width; NULL: nothing */
	const char *subject;
	int pou;
	const struct rung *rung;
	const struct drafting *drafting;
	GPtrArray *reference;          /* lines: references that do not fit below their coil */
	GPtrArray *remark;             /* lines: comments that do not fit at their element */
};

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

/* The name of a POU, or "Symbols". Borrowed from @pages. */
static const char *subject_of(const struct pages *pages, int page)
{
	const struct page *of = g_ptr_array_index(pages->page, page);

	return of->subject ? of->subject : "";
}

int pages_count(const struct pages *pages)
{
	return (int)pages->page->len;
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

static void next_page(struct pages *pages)
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

static struct picture *new_picture(struct pages *pages)
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

static void put_whole(struct pages *pages, const struct picture *picture, float height,
		     float scale, float more)
{
	if (pages->y > 0 && pages->y + height * scale + more > pages->room_height)
		next_page(pages);
	put_piece(pages, picture, scale, 0, height);
}

/* ---- headings, spans, lists ---- */

static void put_heading(struct pages *pages, const char *text, float more)
{
	struct picture *picture = new_picture(pages);
	int lines = 0;

	while (*text || !lines) {
		const struct lettered line = lettering_line(pages->lettering, LETTER_HEADING,
							    &text, pages->room_width, false);

		picture_text(picture, TOKEN_INK, LETTER_HEADING, line, 0,
			     20 + (float)(lines++ * HEADING_LINE));
	}
	put_whole(pages, picture, 32 + (float)((lines - 1) * HEADING_LINE), 1, more);
}

static void put_span(struct pages *pages, const struct picture *picture, float scale,
		    float from, float end)
{
	while (from < end) {
		float to = fminf(end, from + (pages->room_height - pages->y) / scale);

		put_piece(pages, picture, scale, from, to);
		from = to;
		if (from < end)
			next_page(pages);
	}
}

static bool can_cut(const struct picture *picture, float x, float top, float room)
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

static void put_line(struct pages *pages, const char *line)
{
	GString *text = g_string_new(line);
	float room = pages->room_width - 8;
	const char *at;

	g_string_replace(text, "\t", "        ", 0);
	at = text->str;
	do { /* once for an empty line, too */
		struct picture *picture = new_picture(pages);
		size_t len = lettering_wrap(pages->lettering, LETTER_OPERAND, at, room);

		picture_text(picture, TOKEN_INK, LETTER_OPERAND,
			     lettering_fit(pages->lettering, LETTER_OPERAND, at,
					   (ptrdiff_t)len, 0), 8, 12);
		put_whole(pages, picture, TEXT_LINE, 1, 0);
		at += len;
	} while (*at);
	g_string_free(text, TRUE);
}

static void put_list(struct pages *pages, const char *heading, char **lines)
{
	put_heading(pages, heading, 3 * TEXT_LINE);
	for (int i = 0; lines && lines[i]; i++)
		put_line(pages, lines[i]);
	g_strfreev(lines);
}

/* ---- the title block ---- */

/* A field of the title block: its label, and the width of its texts. */
struct field {
	const char *what;        /* NULL: there is none                         */
	float width;             /* px: usual width                              */
	float need, least;       /* px: with one line, or with all lines of small type */
	float label;             /* px of @what                                 */
};

static float width_of(const struct pages *pages, enum letter letter, const char *text)
{
	return lettering_fit(pages->lettering, letter, text, -1, 0).width;
}

static bool fits(const struct pages *pages, const char *text, float room, int lines)
{
	return lettering_lines(pages->lettering, LETTER_BADGE, text, room) <= lines;
}

/* The least width of a text in so many lines of small type, to a pixel. */
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

/* The text as it is drawn: without tabs and line breaks. Borrowed until lettering_trim(). */
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

/* A field has the same width on all pages: measures its text on each page, if it differs. */
static void measure_fields(const struct pages *pages, struct field *field,
			   void (*measured)(const struct pages *pages, struct field *field,
					    const char *text))
{
	const int count = pages_count(pages);

	measured(pages, &field[PROJECT], project_title(pages));
	measured(pages, &field[NAME], file_name(pages));
	for (int i = 0; i < count; i++)
		if (i == 0 || strcmp(subject_of(pages, i), subject_of(pages, i - 1)) != 0)
			measured(pages, &field[UNIT], subject_of(pages, i));
	if (pages->maker)
		measured(pages, &field[MAKER], drawn(pages, pages->maker));
	if (pages->state)
		measured(pages, &field[STATE], drawn(pages, pages->state));
	if (pages->date)
		measured(pages, &field[DATE], drawn(pages, pages->date));
}

/* px of all fields together, with pages->title_lines lines. */
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

/* Gives spare width of some fields to those that need more. */
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
	/* Not enough for all: breaks texts into lines, the name of the project first. */
	for (int i = 0; i < FIELDS && over > 0; i++) {
		const float less = MIN(over, field[i].need - field[i].least);

		field[i].width -= less;
		over -= less;
	}
	/* Cuts texts that still do not fit: first the name of the project, which then gets
	 * a page of its own. */
	for (int i = PROJECT; i <= STATE && over > 0; i++) {
		const float less = MIN(over, field[i].width - field[i].label);

		field[i].width -= less;
		over -= less;
	}
}

static float title_height(const struct pages *pages)
{
	const int lines = MAX(pages->title_lines, LINES_LEAST); /* 0: not measured */

	return pages->height < PAPER_LEAST ? 0 : (float)(16 + LINE_STEP * lines);
}

/* Did the name of the project fit until now, and does not any more? */
static bool is_cut_now(struct pages *pages)
{
	const bool before = pages->title_cut;

	pages->title_cut |= !fits(pages, project_title(pages),
				  pages->field[PROJECT] - FIELD_AIR, pages->title_lines);
	return pages->title_cut && !before;
}

static bool measure_title(struct pages *pages)
{
	const float width = pages->room_width, part = width / 100;
	const int before = MAX(pages->title_lines, LINES_LEAST);
	int most = (int)(pages->height / PART_MOST / LINE_STEP);
	char *last = g_strdup_printf(_("%d of %d"), pages_count(pages), pages_count(pages));
	struct field field[FIELDS] = {
		[PROJECT] = { _("Project"), 34 * part, 0, 0, 0 },
		[NAME] = { _("File"), 22 * part, 0, 0, 0 },
		[UNIT] = { _("Program unit"), (pages->date ? 14 : 30) * part, 0, 0, 0 },
		[MAKER] = { pages->maker ? _("Author") : NULL, 0, 0, 0, 0 },
		[STATE] = { pages->state ? _("Version") : NULL, 0, 0, 0, 0 },
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
	const float room = width - FIELD_AIR, end = x + width, height = title_height(pages);
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

static void draw_title(const struct pages *pages, int page, struct picture *picture)
{
	const float height = title_height(pages);
	char *count = g_strdup_printf(_("%d of %d"), page + 1, pages_count(pages));
	const char *what[FIELDS] = { _("Project"), _("File"), _("Program unit"), _("Author"),
				     _("Version"), _("Date"), _("Page") };
	const char *text[FIELDS] = {
		project_title(pages), file_name(pages), subject_of(pages, page),
		pages->maker ? drawn(pages, pages->maker) : NULL,
		pages->state ? drawn(pages, pages->state) : NULL,
		pages->date ? drawn(pages, pages->date) : NULL, count,
	};
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

/* ---- rungs ---- */

/* Keeps a reference for the list behind the rungs, once for all coils of the same bit. */
static void note_reference(struct pages *pages, const struct cell *cell, const char *text)
{
	const struct rung_label label = rung_label(pages->drafting, cell);
	char *line = g_strdup_printf(_("%s%s%s: %s"), label.symbol.text,
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

/* All places if they fit, else the first ones. */
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
		put_heading(pages, heading, 3 * TEXT_LINE);
	for (guint i = 0; i < lines->len; i++)
		put_line(pages, g_ptr_array_index(lines, i));
	pages->y += lines->len ? PAGE_AIR : 0;
	g_ptr_array_set_size(lines, 0);
}

static void put_references(struct pages *pages)
{
	put_told(pages, pages->remark, _("Comments"));
	put_told(pages, pages->reference, _("Cross reference"));
}

static struct grid_scene scene_of(struct pages *pages, const struct sheet *sheet,
			      const struct rung_layout *layout)
{
	pages->rung = layout->rung;
	pages->drafting = &sheet->drafting;
	return (struct grid_scene){
		.drafting = &sheet->drafting, .layout = layout, .theme = pages->theme,
		.state = RUNG_NO_GUTTER, .reference = reference_of, .context = pages,
	};
}

static void put_rows(struct pages *pages, const struct rung_layout *layout,
		    const struct picture *picture, float scale, float from, float bottom)
{
	float end = from;

	for (int row = 0; row < layout->rows && layout->row[row].y < bottom; row++) {
		float to = fminf(layout->row[row].y + layout->row[row].height, bottom);

		if ((to - from) * scale > pages->room_height - pages->y) {
			put_span(pages, picture, scale, from, end);
			next_page(pages);
			from = end;
		}
		end = to;
	}
	put_span(pages, picture, scale, from, bottom);
}

static struct sheet *lay_out(struct pages *pages)
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

/* ---- rungs in strips ---- */

struct fold {
	struct pages *pages;
	const struct rung_layout *layout;
	struct picture *picture;
	float scale;
	float cut[MOST_STRIPS + 1]; /* x of the picture: where strips begin, and the end */
	int strips;
	int wires[MOST_STRIPS + 1]; /* cut there                                       */
};

/* Does a stroke pass (@x, @y), along a row (@across) or between rows? */
static bool is_wire(const struct picture *picture, float x, float y, bool across)
{
	for (int i = 0; i < picture->count; i++) {
		const struct stroke *line = &picture->stroke[i];

		if (line->kind != STROKE_LINE)
			continue;
		if (across ? line->y == line->h && fabsf(line->y - y) < 1 &&
			     fminf(line->x, line->w) <= x && fmaxf(line->x, line->w) >= x
			   : line->x == line->w && fabsf(line->x - x) < 2 &&
			     fmaxf(line->y, line->h) > y)
			return true;
	}
	return false;
}

/* The end of a strip that begins at @left: between columns. It does not cut through links
 * between rows, unless that would leave half of the strip empty. */
static float fold_at(const struct fold *fold, float left, float room)
{
	const struct rung_layout *layout = fold->layout;
	float joined = 0;

	for (int column = layout->columns - 1; column > 0; column--) {
		const float x = layout->column_x[column];

		if (x > left + room - LINK_AIR || x <= left + LINK_AIR)
			continue;
		if (joined > 0 && x < left + room / 2)
			break;
		if (!is_wire(fold->picture, x, layout->top, false) &&
		    can_cut(fold->picture, x, layout->top, room))
			return x;
		if (joined <= 0 &&
		    can_cut(fold->picture, x + LINK_AIR, layout->top, room))
			joined = x + LINK_AIR;
	}
	return joined > 0 ? joined : left + room;
}

/* Finds the strips, as wide as the page; the first one begins with the number of the rung. */
static void find_strips(struct fold *fold)
{
	const struct rung_layout *layout = fold->layout;
	const float room = fold->pages->room_width / fold->scale;
	float left = 0, end = layout->right + RUNG_AFTER;

	while (fold->strips < MOST_STRIPS - 1 &&
	       end - left > room - (fold->strips ? RUNG_LEFT : 0)) {
		left = fold_at(fold, left, room - MARK - (fold->strips ? RUNG_LEFT : 0));
		fold->cut[++fold->strips] = left;
	}
	fold->cut[++fold->strips] = end;
}

static bool goes_on(const struct fold *fold, int row, float x)
{
	const float y = fold->layout->row[row].wire;

	return is_wire(fold->picture, x - 1, y, true) &&
	       is_wire(fold->picture, x + 1, y, true);
}

/* An arrow from @x to the right; its number is at the end without a wire. */
static void draw_arrow(const struct fold *fold, struct picture *picture, float x, float y,
		       int number, bool ends)
{
	const struct theme *theme = fold->pages->theme;
	const float to = x + ARROW;
	char text[16];

	g_snprintf(text, sizeof(text), "%d", number);
	struct lettered fits = lettering_fit(fold->pages->lettering, LETTER_PIN, text, -1, 0);
	picture_line(picture, TOKEN_INK, STROKE_SOLID, theme->idle_width, x, y, to, y);
	picture_line(picture, TOKEN_INK, STROKE_SOLID, theme->idle_width, to - HEAD,
		     y - HEAD, to, y);
	picture_line(picture, TOKEN_INK, STROKE_SOLID, theme->idle_width, to - HEAD,
		     y + HEAD, to, y);
	picture_text(picture, TOKEN_INK, LETTER_PIN, fits,
		     ends ? to + 4 : x - 4 - fits.width, y + 4);
}

/* Arrows at the end of a strip, or at the start of the next one. */
static void draw_arrows(const struct fold *fold, struct picture *picture, int cut, float x,
			bool ends)
{
	int number = fold->wires[cut];

	for (int row = 0; row < fold->layout->rung->rows; row++)
		if (goes_on(fold, row, fold->cut[cut]))
			draw_arrow(fold, picture, ends ? x : x - ARROW,
				   fold->layout->row[row].wire, ++number, ends);
}

static void number_wires(struct fold *fold)
{
	for (int cut = 1; cut < fold->strips; cut++) {
		fold->wires[cut + 1] = fold->wires[cut];
		for (int row = 0; row < fold->layout->rung->rows; row++)
			fold->wires[cut + 1] += goes_on(fold, row, fold->cut[cut]);
	}
}

/* The number of the rung, and that of the strip. */
static void draw_number(const struct fold *fold, struct picture *picture, int strip)
{
	struct lettering *lettering = fold->pages->lettering;
	char number[16], part[32];

	g_snprintf(number, sizeof(number), "%d", fold->layout->number);
	g_snprintf(part, sizeof(part), "%d/%d", strip + 1, fold->strips);
	struct lettered first = lettering_fit(lettering, LETTER_NUMBER, number, -1, 0);
	struct lettered second = lettering_fit(lettering, LETTER_PIN, part, -1, 0);
	picture_text(picture, TOKEN_COMMENT, LETTER_NUMBER, first,
		     (RUNG_GUTTER - first.width) / 2, fold->layout->top + 14);
	picture_text(picture, TOKEN_COMMENT, LETTER_PIN, second,
		     (RUNG_GUTTER - second.width) / 2, fold->layout->top + 29);
}

static float stroke_bottom(const struct stroke *stroke)
{
	switch (stroke->kind) {
	case STROKE_LINE:
		return fmaxf(stroke->y, stroke->h);
	case STROKE_ARC:
	case STROKE_DISC:
		return stroke->y + stroke->w;
	case STROKE_FILL:
	case STROKE_FRAME:
		return stroke->y + stroke->h;
	case STROKE_WAVE:
	case STROKE_TEXT:
		break;
	}
	return stroke->y;
}

/* The lower end of the last row with something in the strip; rails do not count. */
static float strip_bottom(const struct fold *fold, int strip)
{
	const struct rung_layout *layout = fold->layout;
	const float from = fold->cut[strip], to = fminf(fold->cut[strip + 1],
							layout->right - 2);
	float most = layout->top;
	int row = 0;

	if (strip == 0)
		return layout->height;
	for (int i = 0; i < fold->picture->count; i++) {
		const struct stroke *stroke = &fold->picture->stroke[i];
		const float end = stroke->kind == STROKE_LINE ? stroke->w :
								stroke->x + stroke->w;

		if (fminf(stroke->x, end) < to && fmaxf(stroke->x, end) > from)
			most = fmaxf(most, stroke_bottom(stroke));
	}
	while (row + 1 < layout->rows && layout->row[row + 1].y < most)
		row++;
	return row + 1 < layout->rows ? layout->row[row + 1].y : layout->height;
}

/* Numbers and arrows beside the columns, which begin at @x. */
static struct picture *draw_beside(const struct fold *fold, int strip, float x)
{
	struct picture *beside = new_picture(fold->pages);

	if (strip > 0) {
		draw_number(fold, beside, strip);
		draw_arrows(fold, beside, strip, x, false);
	}
	if (strip + 1 < fold->strips)
		draw_arrows(fold, beside, strip + 1,
			    x + fold->cut[strip + 1] - fold->cut[strip], true);
	return beside;
}

/* @room: px of a page it may use. */
static void put_strip(struct fold *fold, int strip, float room)
{
	struct pages *pages = fold->pages;
	const struct rung_layout *layout = fold->layout;
	const float x = strip ? RUNG_LEFT : 0, bottom = strip_bottom(fold, strip);
	const float top = strip ? 0 : layout->top;
	float height = (bottom - layout->top + top) * fold->scale;

	if (height > room) /* the title stays with the first row */
		height = (layout->row[0].height + top) * fold->scale;
	if (pages->y + height > pages->room_height && height <= room)
		next_page(pages);
	if (strip == 0) /* title and comment are as wide as the page */
		put_span(pages, fold->picture, fold->scale, 0, layout->top);
	pages->left = fold->cut[strip];
	pages->right = fold->cut[strip + 1];
	pages->x = x;
	pages->beside = draw_beside(fold, strip, x);
	put_rows(pages, layout, fold->picture, fold->scale, layout->top, bottom);
	pages->left = pages->right = pages->x = 0;
	pages->beside = NULL;
}

/* Scales down until no column is wider than a strip, if possible. */
static float scale_for(const struct pages *pages, const struct rung_layout *layout,
		       float scale)
{
	float widest = 0;

	for (int column = 0; column < layout->columns; column++)
		widest = fmaxf(widest, layout->column_width[column]);
	return fmaxf(PAGE_LEAST, fminf(scale, pages->room_width / (RUNG_LEFT + widest +
								  2 * LINK_AIR + MARK)));
}

/* Drawn first without references, whose room depends on the cuts. The right rail is in line
 * with that of the other rungs. */
static void draw_strips(struct fold *fold, struct grid_scene scene, struct rung_layout *layout,
		 float rails)
{
	struct picture plain;
	char *(*reference)(void *, int, int, float) = scene.reference;

	picture_init(&plain);
	scene.reference = NULL;
	grid_draw(&scene, &plain);
	fold->picture = &plain;
	find_strips(fold);
	picture_clear(&plain);
	scene.reference = reference;
	scene.reference_from = fold->cut[fold->strips - 1];
	float last = layout->right - scene.reference_from;
	if (last < rails)
		rung_layout_stretch(layout, layout->right - RUNG_LEFT + rails - last);
	fold->cut[fold->strips] = layout->right + RUNG_AFTER;
	fold->picture = new_picture(fold->pages);
	grid_draw(&scene, fold->picture);
	number_wires(fold);
}

static void put_folded(struct pages *pages, const struct sheet *sheet, int index, float scale,
		bool first)
{
	const struct rung *rung = sheet->rung[index]->rung;
	const float room = pages->room_height - (first ? pages->y : 0);
	struct drafting drafting = sheet->drafting;
	struct fold fold = { .pages = pages,
			     .scale = scale_for(pages, sheet->rung[index], scale) };

	drafting.columns = 0;
	drafting.most = pages->room_width / fold.scale - RUNG_LEFT - RUNG_AFTER;
	struct rung_layout *layout = rung_layout_new(&drafting, rung, index + 1, 0);
	struct grid_scene scene = scene_of(pages, sheet, layout);
	scene.drafting = &drafting;
	fold.layout = layout;
	draw_strips(&fold, scene, layout, sheet->rails * scale / fold.scale);
	for (int strip = 0; strip < fold.strips; strip++)
		put_strip(&fold, strip, strip ? pages->room_height : room);
	rung_layout_free(layout);
}

/* ---- the rungs of a POU, all at one scale ---- */

/* The first rung always goes on the page of its POU's heading. */
static void put_rung(struct pages *pages, const struct sheet *sheet, int index,
		     float scale, bool first)
{
	const struct rung_layout *layout = sheet->rung[index];
	const struct grid_scene scene = scene_of(pages, sheet, layout);
	struct picture *picture = new_picture(pages);
	float room = pages->room_height - (first ? pages->y : 0);
	float shrunk = room / layout->height * 0.999f;

	grid_draw(&scene, picture);
	if (layout->height * scale <= room)
		put_whole(pages, picture, layout->height, scale, 0);
	else if (shrunk >= PAGE_LEAST)
		put_whole(pages, picture, layout->height, shrunk, 0);
	else
		put_rows(pages, layout, picture, scale, 0, layout->height);
}

static void put_rungs(struct pages *pages, const struct sheet *sheet, const char *heading,
		     int first, int end)
{
	const float scale = fminf(1, pages->room_width / sheet->width);
	float more = first < end ? sheet->rung[first]->height * scale : 0;

	put_heading(pages, heading, fminf(more, pages->room_height - 40));
	for (int i = first; i < end; i++) {
		if (sheet_is_wide(sheet, i))
			put_folded(pages, sheet, i, scale, i == first);
		else
			put_rung(pages, sheet, i, scale, i == first);
		sheet_remarks(sheet, i, pages->remark);
	}
}

/* ---- charts ---- */

/* Is this part of a picture empty? */
static bool is_blank(const struct pages *pages, const struct picture *picture, float from,
		     float to)
{
	const float right = pages->right > 0 ? pages->right : INFINITY;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *stroke = &picture->stroke[i];

		if (stroke->kind == STROKE_TEXT && stroke->y > from && stroke->y < to &&
		    stroke->x >= pages->left && stroke->x < right)
			return false;
	}
	return true;
}

/* Puts it on a new page, unless it is the first piece or empty. Returns how much room of
 * the next page is used: none. */
static float put_slice(struct pages *pages, const struct picture *picture, float scale,
		       float from, float to, float room_used)
{
	if (is_blank(pages, picture, from, to))
		return room_used;
	if (pages->y > room_used)
		next_page(pages);
	put_span(pages, picture, scale, from, to);
	return 0;
}

/* Puts as many rows of a chart on each page as fit; pages end between boxes if possible. */
static void put_chart_slices(struct pages *pages, const struct sfc_sheet *chart,
			     const struct picture *picture, float scale)
{
	float from = 0, end = 0, room_used = pages->y;

	for (int row = 0; row < chart->layout->rows; row++) {
		float to = sfc_sheet_y(row) + SFC_ROW / 2.0f;

		if (!sfc_sheet_can_part(chart, row))
			continue;
		if (end > from && (to - from) * scale > pages->room_height - room_used) {
			room_used = put_slice(pages, picture, scale, from, end, room_used);
			from = end;
		}
		end = to;
	}
	put_slice(pages, picture, scale, from, chart->height, room_used);
}

static void put_bodies(struct pages *pages, const struct pou *pou)
{
	struct sheet *sheet = lay_out(pages);
	int count;
	struct sfc_part_body *bodies = sfc_bodies_new(pages->project, pou, &count);

	for (int i = 0; i < count; i++) {
		const struct sfc_body *body = bodies[i].body;

		if (body->kind == BODY_LIST || body->kind == BODY_ST)
			put_list(pages, bodies[i].heading,
				 sfc_body_lines(pages->project, pou, body));
		else
			put_rungs(pages, sheet, bodies[i].heading, body->first,
				  body->first + body->count);
	}
	put_references(pages);
	sfc_bodies_free(bodies, count);
	sheet_free(sheet);
}

/* The end of the part that fits on a page, from @left on. */
static float cut_at(const struct picture *picture, float left, float room, float width)
{
	float x = left + room;

	if (x + 1 >= width) /* a rounding error makes no second page */
		return width;
	while (x > left + room / 2 && !can_cut(picture, x, -1, room))
		x -= 4;
	return x > left + room / 2 ? x : left + room;
}

static void put_columns(struct pages *pages, const struct sfc_sheet *chart,
			const struct picture *picture, const char *heading, float scale)
{
	const float room = pages->room_width / scale;
	int number = 0;

	for (float left = 0, right; left < chart->width; left = right) {
		char *text = left > 0 || chart->width > room + 1 ?
			g_strdup_printf(_("%s, part %d"), heading, ++number) :
			g_strdup(heading);

		right = cut_at(picture, left, room, chart->width);
		if (left > 0)
			next_page(pages);
		put_heading(pages, text, 5 * TEXT_LINE);
		pages->left = left;
		pages->right = right;
		if (chart->height * scale <= pages->room_height - pages->y)
			put_whole(pages, picture, chart->height, scale, 0);
		else
			put_chart_slices(pages, chart, picture, scale);
		pages->left = pages->right = 0;
		g_free(text);
	}
}

/* Puts a comment on paper that did not fit at @at beside its box. */
static void put_comment(struct pages *pages, const struct sfc_sheet *chart, int shape,
			const char *comment, graphene_point_t at, bool *any)
{
	const float room = fminf(SFC_BOUND,
			sfc_sheet_room(chart, chart->layout->shape[shape].lane, at.x, at.y));
	char *line;

	if (!*comment || lettering_fit(pages->lettering, LETTER_COMMENT, comment, -1,
				       0).width <= room)
		return;
	if (!*any)
		put_heading(pages, _("Comments"), 3 * TEXT_LINE);
	*any = true;
	line = g_strdup_printf(_("%s: %s"), chart->name[shape], comment);
	put_line(pages, line);
	g_free(line);
}

static void put_comments(struct pages *pages, const struct sfc_sheet *chart)
{
	const struct sfc *sfc = chart->layout->sfc;
	bool any = false;

	for (int i = 0; i < chart->layout->shape_count; i++)
		put_comment(pages, chart, i, chart->comment[i],
			    sfc_sheet_comment(chart, i), &any);
	for (int i = 0; i < sfc->use_count; i++) {
		const graphene_rect_t use = sfc_sheet_use(chart, i);

		put_comment(pages, chart, sfc->use[i].step, chart->use_comment[i],
			    GRAPHENE_POINT_INIT(use.origin.x + use.size.width + SFC_APART,
						use.origin.y + use.size.height / 2), &any);
	}
	pages->y += any ? PAGE_AIR : 0;
}

/* Comments alone get no page of their own: they are cut at the end of the last one. */
static void narrow(struct sfc_sheet *chart, const struct picture *picture, float room)
{
	float width = 0, left = 0;

	for (int i = 0; i < picture->count; i++) {
		const struct stroke *stroke = &picture->stroke[i];

		if (stroke->kind == STROKE_FRAME || (stroke->kind == STROKE_TEXT &&
						     stroke->letter != LETTER_COMMENT))
			width = fmaxf(width, stroke->x + stroke->w + SFC_EDGE);
	}
	while (cut_at(picture, left, room, width) < width)
		left = cut_at(picture, left, room, width);
	chart->width = fminf(chart->width, left + room);
}

static void put_chart(struct pages *pages, const char *heading)
{
	const struct pou *pou = &pages->project->pou[pages->pou];
	struct sfc_sheet *chart = sfc_sheet_new(pages->project, pou, pages->lettering);
	const struct sfc_scene scene = { .sheet = chart, .theme = pages->theme };
	const float scale = fmaxf(fminf(1, pages->room_width / chart->width), PAGE_LEAST);
	struct picture *picture = new_picture(pages);

	sfc_draw(&scene, picture);
	if (chart->width * scale > pages->room_width) {
		narrow(chart, picture, pages->room_width / scale);
		picture = new_picture(pages);
		sfc_draw(&scene, picture);
	}
	put_columns(pages, chart, picture, heading, scale);
	put_comments(pages, chart);
	sfc_sheet_free(chart);
	put_bodies(pages, pou);
}

/* ---- networks ---- */

/* A network that is higher than a page ends its pages between boxes. */
static void put_network_rows(struct pages *pages, const struct fbd_layout *layout, const struct picture *picture,
			     float scale)
{
	float from = 0, end = 0;

	for (int row = 0; row < layout->plan.rows; row++) {
		const float to = fbd_layout_y(layout, row) + FBD_ROW / 2.0f;

		if (!fbd_layout_can_part(layout, row))
			continue;
		if (end > from && (to - from) * scale > pages->room_height - pages->y) {
			put_span(pages, picture, scale, from, end);
			next_page(pages);
			from = end;
		}
		end = to;
	}
	put_span(pages, picture, scale, from, layout->height);
}

/* One that is wider than a page continues in strips below each other. */
static void put_network(struct pages *pages, const struct fbd_layout *layout, float scale, bool first)
{
	const struct fbd_scene scene = { .layout = layout, .theme = pages->theme, .state = RUNG_NO_GUTTER };
	const float room = pages->room_width / scale;
	struct picture *picture = new_picture(pages);

	fbd_draw(&scene, picture);
	for (float left = 0, right; left < layout->width; left = right) {
		right = layout->width <= room + 1 ? layout->width : cut_at(picture, left, room, layout->width);
		pages->left = left;
		pages->right = right;
		if (layout->height * scale > pages->room_height) {
			if (pages->y > 0 && !first)
				next_page(pages);
			put_network_rows(pages, layout, picture, scale);
		} else {
			put_whole(pages, picture, layout->height, scale, 0);
		}
	}
	pages->left = pages->right = 0;
}

static void put_networks(struct pages *pages, const char *heading, int only)
{
	const struct pou *pou = &pages->project->pou[pages->pou];
	const int count = fbd_layout_networks(pou), first = only ? only - 1 : 0, end = only ? MIN(only, count) : count;
	struct fbd_layout **layout = g_new0(struct fbd_layout *, count + 1);
	float width = 1, scale;

	for (int i = first; i < end; i++) {
		layout[i] = fbd_layout_new(pages->project, pou, i, pages->lettering);
		width = fmaxf(width, layout[i]->width);
	}
	scale = fmaxf(fminf(1, pages->room_width / width), PAGE_LEAST);
	put_heading(pages, heading, first < end ? fminf(layout[first]->height * scale, pages->room_height - 40) : 0);
	for (int i = first; i < end; i++) {
		put_network(pages, layout[i], scale, i == first);
		fbd_layout_free(layout[i]);
	}
	g_free(layout);
}

/* ---- symbols ---- */

static const float share[LISTING_COLUMNS + 1] = { 0, 0.24f, 0.40f, 0.52f, 0.66f, 1 };

/* Draws one cell; returns its number of lines. */
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

/* Draws a row of the table; returns its height. */
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
	put_heading(pages, heading, 5 * TEXT_LINE);
	struct picture *top = new_picture(pages);
	float top_height = draw_cells(pages, top, head, true);
	put_whole(pages, top, top_height, 1, 2 * TEXT_LINE);
	for (int i = first; i < count; i++) {
		struct picture *picture = new_picture(pages);
		char *cell[LISTING_COLUMNS];

		listing_symbol(pages->project, table, i, cell);
		float height = draw_cells(pages, picture, cell, false);
		if (pages->y + height > pages->room_height) {
			next_page(pages);
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
	next_page(pages);
	put_table(pages, &project->globals, _("Global symbols"));
	for (int i = 0; i < project->pou_count; i++) {
		char *heading = g_strdup_printf(_("Symbols of %s"),
			project_text(project, project->pou[i].name));

		put_table(pages, &project->pou[i].vars, heading);
		g_free(heading);
	}
}

/* ---- all of it ---- */

static void put_ladder(struct pages *pages, const char *heading, int only)
{
	struct sheet *sheet = lay_out(pages);

	put_rungs(pages, sheet, heading, only ? only - 1 : 0,
			only ? only : sheet->count);
	put_references(pages);
	sheet_free(sheet);
}

static void put_pou(struct pages *pages, int index, int rung)
{
	const struct pou *pou = &pages->project->pou[index];
	const char *name = project_text(pages->project, pou->name);
	char *heading = g_strdup_printf("%s %s", pou_word(pou->kind), name);

	pages->pou = index;
	pages->subject = name;
	next_page(pages);
	if (pou->language == LANGUAGE_IL || pou->language == LANGUAGE_ST)
		put_list(pages, heading, listing_il(pages->project, pou));
	else if (pou->fbd)
		put_networks(pages, heading, rung);
	else if (pou->sfc && !rung)
		put_chart(pages, heading);
	else
		put_ladder(pages, heading, rung);
	g_free(heading);
}

/* A page for the name of the project, if the title block cuts it. */
static void put_name(struct pages *pages)
{
	char **line;

	if (!pages->title_cut)
		return;
	line = g_new0(char *, 2);
	line[0] = g_strdup(project_text(pages->project, pages->project->title));
	pages->subject = _("Project");
	next_page(pages);
	put_list(pages, _("Project"), line);
}

/* Makes all pages again, with the measured height of the title block. */
static void put_all(struct pages *pages, int pou, int rung)
{
	g_ptr_array_set_size(pages->page, 0);
	g_ptr_array_set_size(pages->picture, 0);
	pages->room_height = fmaxf(TEXT_LINE, pages->height - 2 * PAGE_MARGIN - ABOVE_TITLE -
				   title_height(pages));
	for (int i = 0; i < pages->project->pou_count; i++)
		if (pou < 0 || pou == i)
			put_pou(pages, i, rung);
	if (pou < 0)
		put_symbols(pages);
	put_name(pages);
	if (pages->page->len == 0)
		next_page(pages);
}

/* The properties that are given, with commas between them; NULL: none. Caller frees. */
static char *properties(const struct project *project, const enum property *property, int count)
{
	GString *out = g_string_new(NULL);

	for (int i = 0; i < count; i++) {
		const char *text = project_text(project, project->property[property[i]]);

		if (*text)
			g_string_append_printf(out, "%s%s", out->len ? ", " : "", text);
	}
	return g_string_free(out, out->len == 0);
}

struct pages *pages_new(const struct project *project, const char *file, int pou, int rung,
			enum drafting_show show, const struct paper *paper,
			struct lettering *lettering)
{
	static const enum property maker[] = { PROPERTY_AUTHOR, PROPERTY_COMPANY };
	static const enum property state[] = { PROPERTY_VERSION, PROPERTY_REVISION,
					       PROPERTY_DATE };
	struct pages *pages = g_new0(struct pages, 1);
	float width = paper->landscape ? paper->height : paper->width;
	float height = paper->landscape ? paper->width : paper->height;

	pages->project = project;
	pages->lettering = lettering;
	pages->theme = theme_get(THEME_PRINT, THEME_GREEN);
	pages->show = show;
	pages->file = g_path_get_basename(file);
	pages->date = g_strdup(paper->date);
	pages->maker = properties(project, maker, G_N_ELEMENTS(maker));
	pages->state = properties(project, state, G_N_ELEMENTS(state));
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
	while (measure_title(pages));
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
	g_free(pages->maker);
	g_free(pages->state);
	g_free(pages);
}

/* ---- painting ---- */

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

void pages_paint(const struct pages *pages, int page, cairo_t *cr)
{
	const struct page *this = g_ptr_array_index(pages->page, page);
	struct picture picture;

	cairo_save(cr);
	cairo_scale(cr, 0.75, 0.75); /* px of 1/96 inch to points */
	for (guint i = 0; i < this->piece->len; i++)
		paint_piece(pages, &g_array_index(this->piece, struct piece, i), cr);
	picture_init(&picture);
	if (title_height(pages) > 0)
		draw_title(pages, page, &picture);
	picture_cairo(&picture, pages->theme, pages->lettering, cr);
	picture_clear(&picture);
	cairo_restore(cr);
}

/* ---- PDF ---- */

static double points(float mm)
{
	return (double)mm / 25.4 * 72;
}

/* Adds to the table of contents that a reader shows: POUs, symbols. */
static void add_outline(cairo_surface_t *surface, const struct pages *pages, int page)
{
	const char *subject = subject_of(pages, page);
	char place[32];

	if (page > 0 && strcmp(subject, subject_of(pages, page - 1)) == 0)
		return;
	snprintf(place, sizeof(place), "page=%d", page + 1);
	cairo_pdf_surface_add_outline(surface, CAIRO_PDF_OUTLINE_ROOT, subject, place, 0);
}

static void paint_all(cairo_surface_t *surface, const struct pages *pages)
{
	cairo_t *cr = cairo_create(surface);

	for (int page = 0; page < pages_count(pages); page++) {
		pages_paint(pages, page, cr);
		add_outline(surface, pages, page);
		cairo_show_page(cr);
	}
	cairo_destroy(cr);
}

GBytes *pages_pdf(const struct pages *pages, const struct paper *paper, const char *title,
		  const char *made)
{
	GByteArray *bytes = g_byte_array_new();
	const float width = paper->landscape ? paper->height : paper->width;
	const float height = paper->landscape ? paper->width : paper->height;
	cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(picture_append, bytes,
		points(width), points(height));
	bool good;

	if (made)
		cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, made);
	cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
	if (pages->project->property[PROPERTY_AUTHOR])
		cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_AUTHOR,
			project_text(pages->project, pages->project->property[PROPERTY_AUTHOR]));
	paint_all(surface, pages);
	cairo_surface_finish(surface);
	good = cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS;
	cairo_surface_destroy(surface);
	if (good)
		return g_byte_array_free_to_bytes(bytes);
	g_byte_array_unref(bytes);
	return NULL;
}
