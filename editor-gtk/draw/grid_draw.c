/* SPDX-License-Identifier: MIT
 *
 * grid_draw - strokes of a rung: background, rails, wires, elements, boxes, marks, heading;
 * and of an element in the palette. See grid_draw.h.
 */
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/grid_glyph.h"
#include "editor-gtk/draw/rung_box.h"
#include "editor-gtk/draw/rung_text.h"
#include "editor-gtk/kit/i18n.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define COMMENT_LINE 17
#define PADDING   6     /* px inside the frame of a box                         */
#define MIDDLE    4.5f  /* from the middle of a line to the baseline of a text on it */
#define CIRCLE    3     /* radius of an inverting pin                            */
#define BELOW_BASELINE 30 /* px below the wire: comment, value                  */
#define EDGE 5          /* px of an icon: from a word to the side; length of a wire */
#define ICON_LINE 10    /* px from a line of an icon to the next                */
#define INSET 3 /* px below and above: Chinese names need the room */
#define HATCH 9 /* px from line to line                      */
#define CORNER 7 /* px of a side of a marked corner           */
#define CORNER_INSET 3 /* px inside other frames              */
#define GRID_STROKE 5 /* px                                       */
#define UNKNOWN 0.6f /* of the ink: an element whose state is not known */

struct pen {
	struct nib nib;
	const struct grid_scene *scene;
	const struct drafting *drafting;
	const struct rung_layout *layout;
	const struct rung *rung;
	uint8_t *net_live;   /* enum live_bit of the net at each bar, by row     */
};

static struct wire wire_of(const struct pen *pen, unsigned int live)
{
	struct wire wire = { TOKEN_IDLE, STROKE_SOLID, pen->nib.theme->idle_width };

	if (!pen->scene->live)
		return wire;
	if (!(live & LIVE_KNOWN))
		wire.style = STROKE_DOTTED;
	else if (live & LIVE_OUT)
		wire = (struct wire){ TOKEN_POWER, STROKE_SOLID, pen->nib.theme->power_width };
	return wire;
}

static unsigned int live_of(const struct pen *pen, int row, int col)
{
	const struct grid_live *live = pen->scene->live;

	return live ? live->cell[row * pen->rung->cols + col] : 0;
}

static unsigned int net_of(const struct pen *pen, int row, int bar)
{
	return pen->net_live[row * (pen->rung->cols + 1) + bar];
}

static void put_line(const struct pen *pen, struct wire wire, float x1, float y1, float x2,
	      float y2)
{
	if (x2 != x1 || y2 != y1)
		picture_line(pen->nib.picture, wire.token, wire.style, wire.width, x1, y1, x2,
			     y2);
}

static void put_text(const struct pen *pen, enum token token, enum letter letter,
	      struct lettered text, float x, float baseline)
{
	picture_text(pen->nib.picture, token, letter, text, x - text.width / 2, baseline);
}

/* ---- nets ---- */

static int root_of(int *net, int bar)
{
	while (net[bar] != bar)
		bar = net[bar] = net[net[bar]];
	return bar;
}

static void join(int *net, int a, int b)
{
	int x = root_of(net, a), y = root_of(net, b);

	net[MAX(x, y)] = MIN(x, y);
}

static bool is_wire(const struct pen *pen, int row, int col)
{
	return word_row(rung_at(pen->rung, row, col)->word)->place == PLACE_WIRE;
}

static void find_power(struct pen *pen)
{
	const struct rung *rung = pen->rung;
	int bars = rung->cols + 1;
	int *net = g_new(int, rung->rows * bars);
	uint8_t *live = g_new0(uint8_t, rung->rows * bars);

	for (int bar = 0; bar < rung->rows * bars; bar++)
		net[bar] = bar % bars == 0 ? 0 : bar;
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			int bar = row * bars + col + 1;

			if (rung_at(rung, row, col)->link && row > 0)
				join(net, bar, bar - bars);
			if (is_wire(pen, row, col))
				join(net, bar, bar - 1);
		}
	if (pen->scene->live && !(pen->scene->state & RUNG_STILL))
		live[0] = LIVE_KNOWN | LIVE_OUT;
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			enum place place =
				word_row(rung_at(rung, row, col)->word)->place;
			unsigned int state = live_of(pen, row, col);

			/* A coil passes its power on to the coils behind it. */
			if (place == PLACE_LAST)
				state = (state & LIVE_KNOWN) | (state & LIVE_IN ? LIVE_OUT : 0);
			if (place == PLACE_SERIES || place == PLACE_BOX || place == PLACE_LAST)
				live[root_of(net, row * bars + col + 1)] |=
					state & (LIVE_KNOWN | LIVE_OUT);
		}
	for (int bar = 0; bar < rung->rows * bars; bar++)
		live[bar] = live[root_of(net, bar)];
	g_free(net);
	pen->net_live = live;
}

/* ---- wires that belong to no cell ---- */

static void draw_links(const struct pen *pen)
{
	const struct rung *rung = pen->rung;

	for (int row = 1; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			if (!rung_at(rung, row, col)->link)
				continue;
			struct wire wire = wire_of(pen, net_of(pen, row, col + 1));
			float x = rung_layout_bar(pen->layout, row, col + 1);
			float half = wire.width / 2;

			put_line(pen, wire, x, pen->layout->row[row - 1].wire - half, x,
				 pen->layout->row[row].wire + half);
		}
}

/* The power of a box that ends its row goes on to the right rail. */
static void draw_trails(const struct pen *pen)
{
	for (int row = 0; row < pen->rung->rows; row++) {
		const struct rung_row *r = &pen->layout->row[row];

		if (r->trail >= 0)
			put_line(pen, wire_of(pen, live_of(pen, row, r->trail)),
				 rung_layout_bar(pen->layout, row, r->trail + 1), r->wire,
				 pen->layout->right, r->wire);
	}
}

static void draw_rails(const struct pen *pen)
{
	const struct rung_row *last = &pen->layout->row[pen->layout->rows - 1];
	float width = pen->nib.theme->rail_width, end = last->y + last->height;
	bool live = pen->scene->live && !pen->rung->off &&
		    !(pen->scene->state & RUNG_STILL);
	enum stroke_style style = pen->rung->off ? STROKE_DASHED : STROKE_SOLID;

	picture_line(pen->nib.picture, live ? TOKEN_POWER : TOKEN_IDLE, style, width,
		     RUNG_LEFT, pen->layout->top, RUNG_LEFT, end);
	picture_line(pen->nib.picture, TOKEN_IDLE, style, width, pen->layout->right,
		     pen->layout->top, pen->layout->right, end);
}

/* ---- marks of a cell ---- */

static unsigned int marks_of(const struct pen *pen, int row, int column)
{
	unsigned int marks = 0;

	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (mark->row == row && mark->column == column)
			marks |= mark->marks;
	}
	return marks;
}

static const char *note_of(const struct pen *pen, int row, int column)
{
	const struct grid_scene *scene = pen->scene;

	return scene->note && marks_of(pen, row, column) & MARK_BLOCKS ?
	       scene->note(scene->context, row, column) : NULL;
}

/* ---- boxes ---- */

static struct lettered fit(const struct pen *pen, enum letter letter, const char *text,
			   size_t len, float bound)
{
	return lettering_fit(pen->drafting->lettering, letter, text, (ptrdiff_t)len, bound);
}

/* Strokes from @first on are lighter if the state of their element is not known; texts stay readable. */
static void lighten(const struct pen *pen, unsigned int live, int first)
{
	struct picture *picture = pen->nib.picture;

	for (int i = first; pen->scene->live && !(live & LIVE_KNOWN) && i < picture->count; i++)
		if (picture->stroke[i].kind != STROKE_TEXT)
			picture->stroke[i].alpha *= UNKNOWN;
}

static void draw_pin(const struct pen *pen, const struct rung_box *box,
		     const struct rung_pin *pin, bool output)
{
	float y = pen->layout->row[box->top].wire + pin->y;
	float side = output ? box->x + box->inner : box->x, way = output ? 1 : -1;
	struct lettered name = fit(pen, LETTER_PIN, pin->name, pin->name_len, 140);
	struct wire idle = { TOKEN_IDLE, STROKE_SOLID, pen->nib.theme->idle_width };

	picture_text(pen->nib.picture, pen->nib.ink, LETTER_PIN, name,
		     output ? side - PADDING - name.width : side + PADDING, y + MIDDLE);
	if (!pin->value)
		return;
	struct lettered value = fit(pen, LETTER_OPERAND, pin->value, pin->value_len,
				    box->value_most);
	float from = side + (pin->inverse ? way * 2 * CIRCLE : 0);
	put_line(pen, idle, from, y, side + way * BOX_STUB, y);
	if (pin->inverse)
		picture_arc(pen->nib.picture, pen->nib.ink, pen->nib.theme->idle_width,
			    side + way * CIRCLE, y, CIRCLE, 0, (float)(2 * G_PI));
	float x = side + way * (BOX_STUB + 3);
	picture_text(pen->nib.picture, pen->nib.ink, LETTER_OPERAND, value,
		     output ? x : x - value.width, y + MIDDLE);
}

/* The rows whose power enters the box, and the one whose power leaves it. */
static void draw_power(const struct pen *pen, const struct rung_box *box)
{
	const struct rung_layout *layout = pen->layout;
	float y = layout->row[box->top].wire;

	for (int row = box->top; row <= box->last; row++) {
		float at = layout->row[row].wire;

		if (row == box->top || rung_at(pen->rung, row, box->col)->operand)
			put_line(pen, wire_of(pen, net_of(pen, row, box->col)),
				 rung_layout_bar(layout, row, box->col), at, box->x, at);
	}
	put_line(pen, wire_of(pen, live_of(pen, box->top, box->col)),
		 box->x + box->inner, y,
		 rung_layout_bar(layout, box->top, box->col + 1), y);
}

/* "0:12:05 / 2:00:00 h" without its goal if there is no room for both. */
static struct lettered fit_count(struct lettering *lettering, const char *text, float room)
{
	const char *goal = strstr(text, " / ");

	if (goal && lettering_fit(lettering, LETTER_VALUE, text, -1, 0).width > room) {
		/* the unit of both is behind the goal */
		const char *unit = memchr(text, ' ', (size_t)(goal - text)) ? "" : strrchr(text, ' ');
		char now[48];

		g_snprintf(now, sizeof(now), "%.*s%s", (int)(goal - text), text,
			   g_ascii_isalpha(unit[0] ? unit[1] : 0) ? unit : "");
		return lettering_fit(lettering, LETTER_VALUE, now, -1, room);
	}
	return lettering_fit(lettering, LETTER_VALUE, text, -1, room);
}

static void draw_value(const struct pen *pen, const struct rung_box *box, float bottom)
{
	const struct grid_live *live = pen->scene->live;
	struct live_value value;

	if (!box->value || !live || !live->value ||
	    !live->value(live->context, box->top, box->col, &value))
		return;
	float room = box->inner - 2 * PADDING;
	struct lettered text = fit_count(pen->drafting->lettering, value.text, room);
	put_text(pen, TOKEN_ACCENT, LETTER_VALUE, text, box->x + box->inner / 2,
		 bottom - 12);
	if (value.part < 0)
		return;
	float part = MIN(value.part, 1);
	picture_fill(pen->nib.picture, TOKEN_LINE, 1, box->x + PADDING, bottom - 7, room, 3);
	picture_fill(pen->nib.picture, TOKEN_POWER, 1, box->x + PADDING, bottom - 7,
		     room * part, 3);
}

static void draw_frame(const struct pen *pen, const struct rung_box *box)
{
	float y = pen->layout->row[box->top].wire, middle = box->x + box->inner / 2;
	bool lit = live_of(pen, box->top, box->col) & LIVE_OUT;
	const char *instance = project_text(pen->drafting->project, box->cell->operand);
	int column = rung_layout_column(pen->layout, box->top, box->col);
	bool wrong = marks_of(pen, box->top, column) & MARK_ERROR;

	if (live_of(pen, box->top, box->col) & LIVE_FRESH)
		picture_fill(pen->nib.picture, TOKEN_ACCENT, pen->nib.theme->wash, box->x,
			     y - BOX_ABOVE, box->inner, BOX_ABOVE + box->bottom);
	picture_frame(pen->nib.picture, lit ? TOKEN_POWER : pen->nib.ink, STROKE_SOLID,
		      lit ? pen->nib.theme->power_width : pen->nib.theme->shape_width, box->x,
		      y - BOX_ABOVE, box->inner, BOX_ABOVE + box->bottom);
	lighten(pen, live_of(pen, box->top, box->col), pen->nib.picture->count - 1);
	put_text(pen, pen->nib.ink, LETTER_TYPE,
		 lettering_fit(pen->drafting->lettering, LETTER_TYPE, box->row->word, -1,
			       280), middle, y - BOX_ABOVE + 15);
	if (*instance)
		put_text(pen, wrong ? TOKEN_ERROR : pen->nib.ink, LETTER_SYMBOL,
			 lettering_fit(pen->drafting->lettering, LETTER_SYMBOL, instance,
				       -1, box->name_most), middle, y - BOX_ABOVE - 5);
	draw_value(pen, box, y + box->bottom);
	if (box->in.cut || box->out.cut)
		put_text(pen, pen->nib.ink, LETTER_PIN,
			 lettering_fit(pen->drafting->lettering, LETTER_PIN, "\xe2\x80\xa6",
				       -1, 0), middle, y + box->bottom - 3);
}

static void draw_box(const struct pen *pen, int row, int col)
{
	struct rung_box box;

	rung_box_at(pen->drafting, pen->layout, row, col, &box);
	draw_power(pen, &box);
	draw_frame(pen, &box);
	for (int i = 0; i < box.in.count; i++)
		draw_pin(pen, &box, &box.in.pin[i], false);
	for (int i = 0; i < box.out.count; i++)
		draw_pin(pen, &box, &box.out.pin[i], true);
}

/* ---- elements ---- */

/* The wire style of an element's strokes. A coil passes no power, so its left end counts. */
static struct wire shape_wire(const struct pen *pen, const struct word_row *word,
			      unsigned int live)
{
	unsigned int lit = word->place == PLACE_LAST ? LIVE_IN : LIVE_OUT;
	struct wire wire = { pen->nib.ink, STROKE_SOLID, pen->nib.theme->shape_width };

	if (live & LIVE_KNOWN && live & lit)
		wire = (struct wire){ TOKEN_POWER, STROKE_SOLID, pen->nib.theme->power_width };
	return wire;
}

static void draw_label(const struct pen *pen, int row, int col, float x)
{
	const struct rung_row *r = &pen->layout->row[row];
	struct rung_label label = rung_label(pen->drafting, rung_at(pen->rung, row, col));
	int column = rung_layout_column(pen->layout, row, col);
	bool wrong = marks_of(pen, row, column) & MARK_ERROR;

	put_text(pen, wrong ? TOKEN_ERROR : pen->nib.ink, LETTER_SYMBOL, label.symbol, x,
		 r->wire - (r->addressed ? 31 : 18));
	put_text(pen, TOKEN_COMMENT, LETTER_ADDRESS, label.address, x, r->wire - 17);
}

/* Draws a coil's comment and the places that read it, in the room that has only the coil's
 * own wire on the left. */
static void draw_reference(const struct pen *pen, int row, int col, float x)
{
	const struct rung_layout *layout = pen->layout;
	float from = MAX(rung_layout_bar(layout, row, col), pen->scene->reference_from) + 6;
	float room = layout->right - 6 - from, baseline = layout->row[row].wire + BELOW_BASELINE;
	struct lettered fits = rung_element_comment(pen->drafting,
						    rung_at(pen->rung, row, col), room);
	char *before = g_strdup_printf("%s%s", fits.text, *fits.text ? " \xc2\xb7 " : "");
	float taken = lettering_fit(pen->drafting->lettering, LETTER_PIN, before, -1,
				    0).width;
	char *read = pen->scene->reference(pen->scene->context, row, col, room - taken);
	char *text = g_strdup_printf("%s%s", read ? before : fits.text, read ? read : "");

	fits = lettering_fit(pen->drafting->lettering, LETTER_PIN, text, -1, room);
	g_free(read);
	g_free(text);
	g_free(before);
	float left = MIN(x - fits.width / 2, layout->right - 6 - fits.width);
	picture_text(pen->nib.picture, TOKEN_COMMENT, LETTER_PIN, fits, left, baseline);
}

/* @up: px from the wire to the upper end of the strokes. An expression of many lines has
 * room only above it. */
static void draw_below(const struct pen *pen, int row, int col, float x, float room,
		       float up)
{
	const struct grid_scene *scene = pen->scene;
	const struct cell *cell = rung_at(pen->rung, row, col);
	float baseline = pen->layout->row[row].wire +
			 (up > RUNG_HALF ? -up - 4 : BELOW_BASELINE);
	struct live_value value;

	if (note_of(pen, row, rung_layout_column(pen->layout, row, col)))
		return; /* the note has this room */
	if (scene->live && scene->live->value &&
	    scene->live->value(scene->live->context, row, col, &value)) {
		put_text(pen, TOKEN_ACCENT, LETTER_VALUE,
			 lettering_fit(pen->drafting->lettering, LETTER_VALUE, value.text,
				       -1, room), x, baseline);
		return;
	}
	if (scene->reference && word_row(cell->word)->place == PLACE_LAST)
		draw_reference(pen, row, col, x);
	else
		put_text(pen, TOKEN_COMMENT, LETTER_PIN,
			 rung_element_comment(pen->drafting, cell, room), x, baseline);
}

/* A jump leads away from the row: a wire behind it would lead nowhere. */
static bool leads_away(const struct word_row *word)
{
	return word->place == PLACE_LAST && word->operand != OPND_BOOL_W;
}

static void draw_shape(const struct pen *pen, int row, int col)
{
	const struct rung_layout *layout = pen->layout;
	const struct cell *cell = rung_at(pen->rung, row, col);
	const struct word_row *word = word_row(cell->word);
	int column = rung_layout_column(layout, row, col);
	float width = layout->column_width[column], y = layout->row[row].wire;
	unsigned int live = live_of(pen, row, col), left = net_of(pen, row, col);
	bool last = word->place == PLACE_LAST;
	int first;
	struct glyph glyph = { .strokes = explain_glyph(word), .y = y, .half = glyph_half(word),
			       .x = layout->column_x[column] + width / 2,
			       .wire = shape_wire(pen, word, live), .up = RUNG_HALF,
			       .lit = live & LIVE_CLOSED };

	struct rung_framed framed;

	if (rung_is_framed(word)) {
		framed = rung_framed(pen->drafting, cell);
		glyph.framed = &framed;
		glyph.half = framed.width / 2 + FRAMED_SIDE;
		glyph.up = framed.up;
	} else if (word->operand == OPND_NONE) {
		glyph.inside = explain_inside(word);
		glyph.letter = LETTER_TYPE;
	}
	put_line(pen, wire_of(pen, left), rung_layout_bar(layout, row, col), y,
		 glyph_meets(&glyph), y);
	if (!leads_away(word) || col != layout->row[row].output)
		put_line(pen, wire_of(pen, last ? left : live), glyph.x + glyph.half, y,
			 rung_layout_bar(layout, row, col + 1), y);
	if (live & LIVE_FRESH)
		picture_fill(pen->nib.picture, TOKEN_ACCENT, pen->nib.theme->wash,
			     glyph.x - glyph.half - 4, y - glyph.up - 2,
			     2 * glyph.half + 8, 2 * glyph.up + 4);
	first = pen->nib.picture->count;
	glyph_draw(&pen->nib, &glyph);
	lighten(pen, live, first);
	draw_label(pen, row, col, glyph.x);
	draw_below(pen, row, col, glyph.x, width - 8 - 2 * pen->drafting->beside, glyph.up);
}

static void draw_element(const struct pen *pen, int row, int col)
{
	const struct cell *cell = rung_at(pen->rung, row, col);
	const struct word_row *word = words_row(&pen->drafting->project->words, cell->word);
	float y = pen->layout->row[row].wire;

	if (word->kind != WORD_ELEM)
		draw_box(pen, row, col);
	else if (word->place == PLACE_WIRE)
		put_line(pen, wire_of(pen, net_of(pen, row, col)),
			 rung_layout_bar(pen->layout, row, col), y,
			 rung_layout_bar(pen->layout, row, col + 1), y);
	else if (word->place != PLACE_NONE && word->place != PLACE_PIN)
		draw_shape(pen, row, col);
}

/* ---- heading, number, rails ---- */

struct line_place {
	struct picture *picture;
	enum token token;
	enum letter letter;
	float x, y, step;
};

static void take_line(void *context, int line, struct lettered text)
{
	const struct line_place *place = context;

	picture_text(place->picture, place->token, place->letter, text, place->x,
		     place->y + (float)line * place->step);
}

static void draw_title(const struct pen *pen, const struct rung_heading *heading)
{
	const struct rung_layout *layout = pen->layout;
	struct line_place place = { pen->nib.picture, pen->nib.ink, LETTER_TITLE,
				    RUNG_LEFT + heading->indent, layout->title_y,
				    TITLE_STEP };

	if (layout->title_lines)
		rung_lines(pen->drafting, LETTER_TITLE,
			   project_text(pen->drafting->project, pen->rung->title),
			   layout->heading_room - heading->indent, layout->title_lines,
			   take_line, &place);
	else
		take_line(&place, 0, heading->title);
}

static void draw_heading(const struct pen *pen)
{
	const struct rung_layout *layout = pen->layout;
	struct rung_heading heading = rung_heading(pen->drafting, pen->rung);
	float y = layout->title_y;

	picture_text(pen->nib.picture, TOKEN_ACCENT, LETTER_OPERAND, heading.label, RUNG_LEFT, y);
	draw_title(pen, &heading);
	y += layout->title_lines ? (float)((layout->title_lines - 1) * TITLE_STEP) : 0;
	if (layout->comment_lines) {
		struct line_place place = { pen->nib.picture, TOKEN_COMMENT, LETTER_COMMENT,
					    RUNG_LEFT, y + (heading.width > 0 ?
							    COMMENT_LINE : 0),
					    COMMENT_LINE };

		rung_lines(pen->drafting, LETTER_COMMENT, heading.comment,
			   layout->heading_room, layout->comment_lines, take_line, &place);
	} else if (*heading.comment) {
		picture_text(pen->nib.picture, TOKEN_COMMENT, LETTER_COMMENT,
			     lettering_fit(pen->drafting->lettering, LETTER_COMMENT,
					   heading.comment, -1, 0),
			     RUNG_LEFT + heading.width, y);
	}
	g_free(heading.comment);
}

static void draw_ground(const struct pen *pen, float width, float height)
{
	unsigned int state = pen->scene->state;

	if (!(state & (RUNG_NO_GUTTER | RUNG_ON_GUTTER)))
		picture_fill(pen->nib.picture, TOKEN_GUTTER, 1, 0, 0, RUNG_GUTTER, height);
	if (state & RUNG_SELECTED)
		picture_fill(pen->nib.picture, TOKEN_ACCENT, pen->nib.theme->wash, 0, 0, width, height);
	if (state & RUNG_ADDED)
		picture_fill(pen->nib.picture, TOKEN_POWER, 0.10f, 0, 0, width, height);
	if (state & RUNG_REMOVED)
		picture_fill(pen->nib.picture, TOKEN_ERROR, 0.10f, 0, 0, width, height);
	if (state & RUNG_CURRENT)
		picture_fill(pen->nib.picture, TOKEN_ACCENT, 1, 0, 2, 3, height - 4);
	if (!(state & RUNG_NO_GUTTER))
		picture_fill(pen->nib.picture, TOKEN_LINE, 1, 0, height - 1, width, 1);
}

#define MISSING_ROOM 31 /* from the right end to the note, left of the rail       */

/* An arrow that waits below the number, and a note at the lower right. */
static void draw_missing(const struct pen *pen, float x, float y)
{
	struct lettering *lettering = pen->drafting->lettering;
	const struct lettered note =
		lettering_fit(lettering, LETTER_COMMENT, _("not downloaded"), -1, 0);

	put_text(pen, TOKEN_FORCE, LETTER_HEADING,
		 lettering_fit(lettering, LETTER_HEADING, "\xe2\x86\x93", -1, 0), x, y + 36);
	put_text(pen, TOKEN_FORCE, LETTER_COMMENT, note,
		 rung_layout_width(pen->layout) - MISSING_ROOM - note.width / 2,
		 pen->layout->height - 8);
}

static void draw_number(const struct pen *pen)
{
	unsigned int state = pen->scene->state;
	enum token token = state & RUNG_CURRENT ? TOKEN_ACCENT : TOKEN_COMMENT;
	const char *sign = state & RUNG_ADDED ? "+" : state & RUNG_REMOVED ?
		"\xe2\x88\x92" : state & RUNG_CHANGED ? "\xe2\x89\xa0" : NULL;
	enum letter small = state & RUNG_NO_GUTTER ? LETTER_PIN : LETTER_BADGE;
	float y = pen->layout->title_y, x = RUNG_GUTTER / 2.0f;
	struct lettering *lettering = pen->drafting->lettering;
	char number[16];

	g_snprintf(number, sizeof(number), "%d", pen->layout->number);
	put_text(pen, token, LETTER_NUMBER,
		 lettering_fit(lettering, LETTER_NUMBER, number, -1, 0), x, y);
	if (pen->rung->off) /* paper may be made smaller */
		put_text(pen, TOKEN_COMMENT, small,
			 lettering_fit(lettering, small, _("OFF"), -1, 0), x, y + 15);
	if (sign)
		put_text(pen, state & RUNG_ADDED ? TOKEN_POWER : state & RUNG_REMOVED ?
			 TOKEN_ERROR : TOKEN_FORCE, LETTER_HEADING,
			 lettering_fit(lettering, LETTER_HEADING, sign, -1, 0), x, y + 36);
	if (state & RUNG_MISSING)
		draw_missing(pen, x, y);
	if (state & RUNG_MARKED) /* a ribbon */
		picture_fill(pen->nib.picture, TOKEN_ACCENT, 1, 7, 0, 6, y + 6);
	if (state & RUNG_EDITED)
		picture_disc(pen->nib.picture, TOKEN_ACCENT, 1, RUNG_GUTTER - 6, y - 5, 3);
}

/* ---- marks: each has a shape or a letter, never a colour alone ---- */

static bool is_inside(const struct pen *pen, const struct grid_mark *mark)
{
	return mark->row >= 0 && mark->row < pen->layout->rows && mark->column >= 0 &&
	       mark->column < pen->layout->columns;
}

static graphene_rect_t place_of(const struct pen *pen, const struct grid_mark *mark)
{
	graphene_rect_t rect = rung_layout_cell(pen->layout, mark->row, mark->column);

	return GRAPHENE_RECT_INIT(rect.origin.x + 1, rect.origin.y,
				  rect.size.width - 2, rect.size.height - INSET);
}

/* Slanting lines, faint enough to read the element through them. */
static void draw_hatch(const struct pen *pen, const graphene_rect_t *r)
{
	const float width = r->size.width, height = r->size.height;

	for (float at = HATCH; at < width + height; at += HATCH) {
		const float left = MAX(at - height, 0), right = MIN(at, width);

		picture_line(pen->nib.picture, TOKEN_BLOCKS, STROKE_SOLID, 1,
			     r->origin.x + left, r->origin.y + at - left,
			     r->origin.x + right, r->origin.y + at - right);
		pen->nib.picture->stroke[pen->nib.picture->count - 1].alpha = 0.35f;
	}
}

/* Of a hit of a search; the current one has a frame, too. */
static void fill_found(const struct pen *pen, const graphene_rect_t *r, bool now)
{
	picture_fill(pen->nib.picture, now ? TOKEN_FOUND_NOW : TOKEN_FOUND, 1, r->origin.x, r->origin.y,
		     r->size.width, r->size.height);
	if (now)
		picture_frame(pen->nib.picture, TOKEN_INK, STROKE_SOLID, 2, r->origin.x, r->origin.y,
			      r->size.width, r->size.height);
}

/* Label, title and comment. */
static graphene_rect_t heading_rect(const struct pen *pen)
{
	const struct rung_layout *layout = pen->layout;
	const struct rung_heading heading = rung_heading(pen->drafting, pen->rung);
	const float width = layout->title_lines || layout->comment_lines ? layout->heading_room :
			    heading.width + heading.comment_width;

	g_free(heading.comment);
	return GRAPHENE_RECT_INIT(RUNG_LEFT - 3, layout->title_y - 15, width + 6,
				  layout->top - layout->title_y + 12);
}

/* The current hit covers others in the same cell. */
static void draw_found(const struct pen *pen, bool now)
{
	const unsigned int state = now ? RUNG_FOUND_NOW : RUNG_FOUND;

	if (pen->scene->state & state) {
		const graphene_rect_t heading = heading_rect(pen);

		fill_found(pen, &heading, now);
	}
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];
		graphene_rect_t r;

		if (!is_inside(pen, mark) || !(mark->marks & (now ? MARK_FOUND_NOW : MARK_FOUND)))
			continue;
		r = place_of(pen, mark);
		fill_found(pen, &r, now);
	}
}

/* Paper, with just enough to count the columns. */
static void draw_grid(const struct pen *pen)
{
	const struct rung_layout *layout = pen->layout;

	for (int row = 0; pen->scene->state & RUNG_GRID && row < layout->rows; row++)
		for (int column = 1; column < layout->columns; column++)
			picture_fill(pen->nib.picture, TOKEN_LINE, 1, layout->column_x[column],
				     layout->row[row].y + layout->row[row].height - GRID_STROKE, 1, GRID_STROKE);
}

/* A cell may have several marks: its ground is washed once. */
static bool is_washed(const struct pen *pen, int mark)
{
	const unsigned int washes = MARK_CURSOR | MARK_SELECTED | MARK_DROP;
	const struct grid_mark *of = pen->scene->mark;

	for (int i = 0; i < mark; i++)
		if (of[i].row == of[mark].row && of[i].column == of[mark].column && of[i].marks & washes)
			return false;
	return of[mark].marks & washes;
}

static void draw_grounds(const struct pen *pen)
{
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (!is_inside(pen, mark))
			continue;
		graphene_rect_t r = place_of(pen, mark);
		if (mark->marks & MARK_BLOCKS)
			draw_hatch(pen, &r);
		if (is_washed(pen, i))
			picture_fill(pen->nib.picture, TOKEN_ACCENT, pen->nib.theme->wash,
				     r.origin.x, r.origin.y, r.size.width, r.size.height);
	}
}

/* A letter on a small background, its upper left corner at (x, y); returns its width. */
static float badge(const struct pen *pen, enum token ground, const char *text, float x,
		   float y)
{
	struct lettered fits = lettering_fit(pen->drafting->lettering, LETTER_BADGE, text,
					     -1, 0);

	picture_fill(pen->nib.picture, ground, 1, x, y, fits.width + 6, 13);
	picture_text(pen->nib.picture, TOKEN_BADGE, LETTER_BADGE, fits, x + 3, y + 10);
	return fits.width + 6;
}

unsigned int grid_mark_of(const struct diag *diag)
{
	if (diag->id == DIAG_COIL_TWICE)
		return MARK_TWICE;
	return diag_severity(diag->id) == SEVERITY_ERROR ? MARK_ERROR : MARK_WARNING;
}

#define FORCED "F"
#define TWICE  "2\xc3\x97"
#define FAILED "!"
#define STALE  "\xe2\x9a\xa0"
#define FAULT  "\xe2\x9c\x96"

/* The value is not good: at the left, so that a force has room. */
static void mark_quality(const struct pen *pen, unsigned int marks, float x, float y)
{
	if (marks & (MARK_STALE | MARK_FAULT))
		badge(pen, TOKEN_ERROR, marks & MARK_FAULT ? FAULT : STALE, x, y);
}

static void mark_wrong(const struct pen *pen, unsigned int marks, float x, float y, float w)
{
	if (marks & MARK_ERROR)
		picture_wave(pen->nib.picture, TOKEN_ERROR, x, y, w);
	else if (marks & MARK_WARNING)
		picture_line(pen->nib.picture, TOKEN_FORCE, STROKE_DASHED, 2, x, y + 1, x + w,
			     y + 1);
}

/* Error marks stand below all lines of an expression. */
static void mark_framed(const struct pen *pen, unsigned int marks, const struct cell *cell,
			float middle, float y)
{
	struct rung_framed framed = rung_framed(pen->drafting, cell);
	float x = middle + framed.width / 2 + FRAMED_SIDE + 2;

	mark_wrong(pen, marks, middle - 22, y + framed.up + 2, 44);
	mark_quality(pen, marks, middle - framed.width / 2 - FRAMED_SIDE - 20, y + 2);
	if (marks & (MARK_FORCED | MARK_TWICE))
		badge(pen, TOKEN_FORCE, marks & MARK_FORCED ? FORCED : TWICE, x,
		      y - 15);
	if (marks & MARK_FAILED)
		badge(pen, TOKEN_ERROR, FAILED, x, y + 2);
}

/* Marks stand behind the address if there is room, else below the wire. */
static void mark_element(const struct pen *pen, unsigned int marks, int row, int col,
			 const graphene_rect_t *r)
{
	const struct cell *cell = col >= 0 ? rung_at(pen->rung, row, col) : NULL;
	const struct word_row *word = cell ? word_row(cell->word) : NULL;
	float middle = r->origin.x + r->size.width / 2, y = pen->layout->row[row].wire;
	float half = word ? glyph_half(word) : 8, address = 0;

	if (word && rung_is_framed(word)) {
		mark_framed(pen, marks, cell, middle, y);
		return;
	}
	if (word)
		address = rung_label(pen->drafting, cell).address.width;
	float behind = middle + address / 2 + 2;
	bool fits = address > 0 && behind + 13 < r->origin.x + r->size.width;
	mark_wrong(pen, marks, middle - 22, y + RUNG_HALF + 2, 44);
	mark_quality(pen, marks, middle - half - 20, y + 2);
	if (marks & MARK_FORCED && fits)
		badge(pen, TOKEN_FORCE, FORCED, behind, y - 28);
	else if (marks & MARK_FORCED)
		badge(pen, TOKEN_FORCE, FORCED, middle + half + 3, y + 1.5f);
	/* Behind the address the badge of a force reaches down to this place. */
	if (marks & MARK_TWICE)
		badge(pen, TOKEN_FORCE, TWICE, middle + half + 3,
		      marks & MARK_FORCED && fits ? y + 1.5f : y - 15);
}

/* Marks of a box stand below it. */
static void mark_box(const struct pen *pen, unsigned int marks, int row, int col)
{
	const struct rung_layout *layout = pen->layout;
	struct rung_box box;

	rung_box_at(pen->drafting, layout, row, col, &box);
	float x = box.x, y = layout->row[row].wire + box.bottom + 2;
	if (marks & (MARK_ERROR | MARK_WARNING)) {
		mark_wrong(pen, marks, x, y + 1, 36);
		x += 38;
	}
	if (marks & MARK_FORCED)
		x += badge(pen, TOKEN_FORCE, FORCED, x, y) + 2;
	if (marks & MARK_TWICE)
		x += badge(pen, TOKEN_FORCE, TWICE, x, y) + 2;
	if (marks & MARK_FAILED)
		x += badge(pen, TOKEN_ERROR, FAILED, x, y) + 2;
	mark_quality(pen, marks, x, y);
}

/* Stands in the place of the value. */
static void draw_note(const struct pen *pen, const struct grid_mark *mark,
		      const graphene_rect_t *r)
{
	const char *note = note_of(pen, mark->row, mark->column);
	struct lettered fits = lettering_fit(pen->drafting->lettering, LETTER_BADGE, note,
					     -1, r->size.width - 10);

	badge(pen, TOKEN_BLOCKS, fits.text,
	      r->origin.x + (r->size.width - fits.width) / 2 - 3,
	      r->origin.y + r->size.height - 17);
}

/* Only corners: whole frames around many cells would hide the elements, and each dashed
 * stroke costs an image. */
static void draw_corners(const struct pen *pen, const graphene_rect_t *r)
{
	const float left = r->origin.x + CORNER_INSET, top = r->origin.y + CORNER_INSET;
	const float right = r->origin.x + r->size.width - CORNER_INSET;
	const float bottom = r->origin.y + r->size.height - CORNER_INSET;
	const float thick = floorf(pen->nib.theme->idle_width);

	for (int i = 0; i < 4; i++) {
		const bool after = i % 2, below = i / 2;

		picture_fill(pen->nib.picture, TOKEN_ACCENT, 1, after ? right - CORNER : left,
			     below ? bottom - thick : top, CORNER, thick);
		picture_fill(pen->nib.picture, TOKEN_ACCENT, 1, after ? right - thick : left,
			     below ? bottom - CORNER : top + thick, thick,
			     CORNER - thick);
	}
}

static void draw_frames(const struct pen *pen, const struct grid_mark *mark,
			const graphene_rect_t *r)
{
	if (mark->marks & MARK_CURSOR)
		picture_frame(pen->nib.picture, TOKEN_ACCENT, STROKE_SOLID, 1.5f, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_DROP)
		picture_frame(pen->nib.picture, TOKEN_ACCENT, STROKE_DASHED, 1.5f,
			      r->origin.x, r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_BLOCKS)
		picture_frame(pen->nib.picture, TOKEN_BLOCKS, STROKE_SOLID, 2, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
	if (mark->marks & MARK_CHANGED)
		picture_frame(pen->nib.picture, TOKEN_FORCE, STROKE_DOTTED, 1.5f, r->origin.x,
			      r->origin.y, r->size.width, r->size.height);
}

static void draw_takes(const struct pen *pen)
{
	const int columns = pen->layout->columns;

	for (int i = 0; pen->scene->takes && i < pen->layout->rows * columns; i++) {
		const struct grid_mark mark = { i / columns, i % columns, 0 };
		const graphene_rect_t r = place_of(pen, &mark);

		if (pen->scene->takes[i])
			draw_corners(pen, &r);
	}
}

static void draw_marks(const struct pen *pen)
{
	draw_takes(pen);
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct grid_mark *mark = &pen->scene->mark[i];

		if (!is_inside(pen, mark))
			continue;
		graphene_rect_t r = place_of(pen, mark);
		int col = rung_layout_col(pen->layout, mark->row, mark->column);
		int top = col < 0 ? -1 : rung_box_top(pen->rung, mark->row, col);
		draw_frames(pen, mark, &r);
		if (top >= 0)
			mark_box(pen, mark->marks, top, col);
		else
			mark_element(pen, mark->marks, mark->row, col, &r);
		if (mark->marks & MARK_CHANGED)
			badge(pen, TOKEN_FORCE, "\xe2\x89\xa0", r.origin.x + 1,
			      r.origin.y + r.size.height - 14);
		if (note_of(pen, mark->row, mark->column))
			draw_note(pen, mark, &r);
	}
}

/* ---- all of a rung ---- */

static struct pen pen_of(const struct grid_scene *scene, struct picture *picture)
{
	struct pen pen = { .scene = scene, .drafting = scene->drafting,
			   .layout = scene->layout, .rung = scene->layout->rung,
			   .nib = { picture, scene->theme, scene->drafting->lettering,
				    scene->layout->rung->off ? TOKEN_COMMENT : TOKEN_INK } };

	find_power(&pen);
	return pen;
}

/* All but the ground. */
static void draw_rung(const struct pen *pen)
{
	draw_grid(pen);
	draw_grounds(pen);
	draw_found(pen, false);
	draw_found(pen, true);
	draw_links(pen);
	draw_trails(pen);
	for (int row = 0; row < pen->rung->rows; row++)
		for (int col = 0; col < pen->rung->cols; col++)
			draw_element(pen, row, col);
	draw_rails(pen);
	draw_heading(pen);
	draw_number(pen);
	draw_marks(pen);
}

/* A rung that is off is not scanned. */
static struct grid_scene scene_to_draw(const struct grid_scene *scene)
{
	struct grid_scene still = *scene;

	if (still.layout->rung->off)
		still.live = NULL;
	return still;
}

void grid_draw(const struct grid_scene *scene, struct picture *picture)
{
	const struct grid_scene still = scene_to_draw(scene);
	struct pen pen = pen_of(&still, picture);

	draw_ground(&pen, rung_layout_width(pen.layout), pen.layout->height);
	draw_rung(&pen);
	g_free(pen.net_live);
}

/* ---- a folded rung: the pieces of its drawing, and what stands between them ---- */

#define HEAD      5   /* px of its tip                                          */
#define PART_LINE 14  /* baseline of "2/3" at a later line                      */

/* The wire of a row at the end of a line. */
static struct wire cut_wire(const struct pen *pen, int line, int row)
{
	const int behind = pen->scene->fold->line[line].last;
	const int col = rung_layout_col(pen->layout, row, behind);

	if (col >= 0)
		return wire_of(pen, net_of(pen, row, col));
	if (pen->layout->row[row].output >= 0)
		return wire_of(pen, net_of(pen, row, pen->layout->row[row].output));
	return wire_of(pen, pen->layout->row[row].trail < 0 ? 0 : live_of(pen, row, pen->layout->row[row].trail));
}

/* An arrow from @x to the right; @number is at its end without a wire. */
static void draw_arrow(const struct pen *pen, struct wire wire, int number, float x, float y, bool ends)
{
	const float to = x + FOLD_END, tip = to - HEAD;
	char text[16];

	g_snprintf(text, sizeof(text), "%d", number);
	const struct lettered fits = lettering_fit(pen->drafting->lettering, LETTER_PIN, text, -1, 0);
	put_line(pen, wire, x, y, to, y);
	picture_line(pen->nib.picture, wire.token, STROKE_SOLID, pen->nib.theme->idle_width, tip, y - HEAD, to, y);
	picture_line(pen->nib.picture, wire.token, STROKE_SOLID, pen->nib.theme->idle_width, tip, y + HEAD, to, y);
	picture_text(pen->nib.picture, pen->nib.ink, LETTER_PIN, fits, ends ? to + 4 : x - 4 - fits.width, y + 4);
}

/* Each wire that is cut between two lines has the same number at both ends. */
static int draw_arrows(const struct pen *pen, int line, int number)
{
	const struct rung_fold *fold = pen->scene->fold;
	const struct rung_fold_line *above = &fold->line[line], *below = above + 1;

	for (int row = 0; row < pen->rung->rows; row++) {
		const float down = pen->layout->row[row].wire - fold->top;
		struct wire wire;

		if (!rung_fold_goes_on(fold, pen->layout, line, row))
			continue;
		wire = cut_wire(pen, line, row);
		draw_arrow(pen, wire, ++number, above->to - above->from + above->x, above->y + down, true);
		draw_arrow(pen, wire, number, below->x - FOLD_END, below->y + down, false);
	}
	return number;
}

static void draw_part(const struct pen *pen, int line)
{
	const struct rung_fold *fold = pen->scene->fold;
	char text[32];

	g_snprintf(text, sizeof(text), "%d/%d", line + 1, fold->lines);
	put_text(pen, TOKEN_COMMENT, LETTER_PIN,
		 lettering_fit(pen->drafting->lettering, LETTER_PIN, text, -1, 0), RUNG_GUTTER / 2.0f,
		 fold->line[line].y + PART_LINE);
}

static void append(GtkSnapshot *snapshot, GskRenderNode *node)
{
	if (node)
		gtk_snapshot_append_node(snapshot, node);
}

/* What a line shows of the drawing of the whole rung. */
static void append_line(GtkSnapshot *snapshot, const struct pen *pen, GskRenderNode *whole, int number)
{
	const struct rung_fold *fold = pen->scene->fold;
	const struct rung_fold_line *line = &fold->line[number];
	const bool shows_end = number + 1 == fold->lines && line->rows == pen->layout->rows;
	const float bottom = shows_end ? pen->layout->height : rung_fold_bottom(fold, pen->layout, number);

	gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(line->x, line->y, line->to - line->from,
							     bottom - fold->top));
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(line->x - line->from, line->y - fold->top));
	append(snapshot, whole);
	gtk_snapshot_restore(snapshot);
	gtk_snapshot_pop(snapshot);
}

static GskRenderNode *node_of(const struct pen *pen)
{
	return picture_node(pen->nib.picture, pen->scene->theme, pen->drafting->lettering);
}

/* The ground, and the ends of the wires that are cut. */
static GskRenderNode *node_between(struct pen pen, const struct grid_scene *scene)
{
	const struct rung_fold *fold = scene->fold;
	struct picture picture;
	GskRenderNode *node;
	int number = 0;

	picture_init(&picture);
	picture.scale = scene->scale;
	pen.nib.picture = &picture;
	draw_ground(&pen, RUNG_LEFT + fold->width + RUNG_AFTER, fold->height);
	for (int line = 0; line < fold->lines; line++) {
		if (line > 0)
			draw_part(&pen, line);
		if (line + 1 < fold->lines)
			number = draw_arrows(&pen, line, number);
	}
	node = node_of(&pen);
	picture_clear(&picture);
	return node;
}

static GskRenderNode *folded_node(const struct pen *pen, const struct grid_scene *scene)
{
	GskRenderNode *whole = node_of(pen), *between = node_between(*pen, scene);
	const float width = RUNG_LEFT + scene->fold->width + RUNG_AFTER;
	GtkSnapshot *snapshot = gtk_snapshot_new();

	append(snapshot, between);
	gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(0, 0, width, scene->fold->top));
	append(snapshot, whole);
	gtk_snapshot_pop(snapshot);
	for (int line = 0; line < scene->fold->lines; line++)
		append_line(snapshot, pen, whole, line);
	g_clear_pointer(&whole, gsk_render_node_unref);
	g_clear_pointer(&between, gsk_render_node_unref);
	return gtk_snapshot_free_to_node(snapshot);
}

GskRenderNode *grid_draw_node(const struct grid_scene *scene)
{
	const struct grid_scene still = scene_to_draw(scene);
	struct picture picture;
	struct pen pen;
	GskRenderNode *node;

	picture_init(&picture);
	picture.scale = scene->scale;
	pen = pen_of(&still, &picture);
	if (!scene->fold)
		draw_ground(&pen, rung_layout_width(pen.layout), pen.layout->height);
	draw_rung(&pen);
	node = scene->fold ? folded_node(&pen, &still) : node_of(&pen);
	g_free(pen.net_live);
	picture_clear(&picture);
	return node;
}

/* ---- icons: with the word of the element instead of its text ---- */

struct word_lines {
	struct lettered line[2];
	int lines;
	float width;
};

/* Breaks behind the last `_` in the first half or a little more; else in the middle. */
static size_t break_at(const char *word)
{
	size_t len = strlen(word), at = 0;

	for (size_t i = 1; i < len; i++)
		if (word[i - 1] == '_' && (i <= len / 2 + 2 || at == 0))
			at = i;
	return at ? at : (len + 1) / 2;
}

static struct word_lines lines_of(struct lettering *lettering, const char *word,
				  float room)
{
	struct lettered whole = lettering_fit(lettering, LETTER_BADGE, word, -1, 0);
	struct word_lines lines = { { whole }, 1, whole.width };

	if (whole.width <= room)
		return lines;
	size_t at = break_at(word);
	lines.line[0] = lettering_fit(lettering, LETTER_BADGE, word, (ptrdiff_t)at, room);
	lines.line[1] = lettering_fit(lettering, LETTER_BADGE, word + at, -1, room);
	lines.lines = 2;
	lines.width = MAX(lines.line[0].width, lines.line[1].width);
	return lines;
}

/* Words of a project that are not ASCII are clipped, not broken. */
static bool is_plain(const char *word)
{
	for (; *word; word++)
		if ((guchar)*word >= 0x80)
			return false;
	return true;
}

static void say_word(const struct pen *pen, const struct glyph *glyph,
		     const struct word_lines *lines)
{
	float y = glyph->y + (lines->lines > 1 ? -2 : 3.5f);

	for (int i = 0; i < lines->lines; i++)
		put_text(pen, TOKEN_INK, LETTER_BADGE, lines->line[i], glyph->x,
			 y + (float)(i * ICON_LINE));
}

static void draw_word(const struct pen *pen, struct glyph *glyph, bool box,
		      const struct word_lines *lines)
{
	float up = lines->lines > 1 ? RUNG_HALF + 2 : RUNG_HALF;
	if (box)
		picture_frame(pen->nib.picture, TOKEN_INK, STROKE_SOLID,
			      pen->nib.theme->shape_width, glyph->x - glyph->half,
			      glyph->y - up, 2 * glyph->half, 2 * up);
	else
		glyph_outline(&pen->nib, glyph);
	say_word(pen, glyph, lines);
}

void grid_draw_icon(const struct word_row *word, const struct theme *theme,
		    struct lettering *lettering, float width, float height,
		    struct picture *picture)
{
	struct drafting drafting = { .lettering = lettering };
	struct grid_scene scene = { .drafting = &drafting, .theme = theme };
	struct pen pen = { .scene = &scene, .drafting = &drafting,
			   .nib = { picture, theme, lettering, TOKEN_INK } };
	struct wire wire = { TOKEN_INK, STROKE_SOLID, theme->shape_width };
	struct glyph glyph = { .strokes = explain_glyph(word), .x = width / 2, .y = height / 2,
			       .half = glyph_half(word), .wire = wire, .up = RUNG_HALF };
	bool box = word->kind != WORD_ELEM;
	bool pointed = !box && strchr("<>", explain_glyph(word)[0]);
	bool says = box || rung_is_framed(word) || word->operand == OPND_NONE;
	float room = width - 2 * EDGE - 2;
	struct word_lines lines = { .lines = 0 };

	if (word->place == PLACE_WIRE) {
		put_line(&pen, wire, 0, glyph.y, width, glyph.y);
		return;
	}
	if (says && is_plain(word->word))
		lines = lines_of(lettering, word->word, room);
	else if (says)
		lines = (struct word_lines){ { lettering_fit(lettering, LETTER_BADGE,
			word->word, -1, room) }, 1, room };
	float side = pointed ? 12 : lines.width + 8 > room ? 3 : EDGE;
	if (says)
		glyph.half = MAX(lines.width / 2 + side, 14);
	put_line(&pen, wire, 0, glyph.y, glyph_meets(&glyph), glyph.y);
	if (!leads_away(word))
		put_line(&pen, wire, glyph.x + glyph.half, glyph.y, width, glyph.y);
	if (says)
		draw_word(&pen, &glyph, box, &lines);
	else
		glyph_draw(&pen.nib, &glyph);
}
