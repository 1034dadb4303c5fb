/* SPDX-License-Identifier: MIT
 *
 * fbd_draw - strokes of a network: wires, boxes, pins, values, marks, heading. See fbd_draw.h.
 */
#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/draw/rung_text.h"
#include "editor-gtk/kit/i18n.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define MIDDLE     4.5f   /* from the middle of a line to the baseline of a text on it */
#define NAME_UP    5      /* from a wire up to the baseline of its name          */
#define VALUE_UP   7      /* the same from a text at a pin to its value         */
#define PADDING    7      /* from the side of a box to the name of a pin         */
#define ORDER      8      /* radius of the number at a box                        */
#define HOP        4      /* radius of a bridge over another wire                 */
#define DOT        2.5f   /* radius where a wire branches                         */
#define BAR        4      /* height of the progress of a timer                     */
#define NOTE_LINE  17
#define SELECTED   7      /* width of the ground below a selected wire             */

struct pen {
	const struct fbd_scene *scene;
	const struct fbd_layout *layout;
	const struct fbd_graph *graph;
	const struct fbd_plan *plan;
	const struct theme *theme;
	struct picture *picture;
	const struct fbd_live *live;  /* NULL: not running, or OFF                */
	enum token ink;
	unsigned int *state;          /* by pin: enum live_bit                    */
	char (*text)[48];             /* by pin: its value                        */
};

struct way { enum token token; enum stroke_style style; float width; };

static struct lettered fit(const struct pen *pen, enum letter letter, const char *text, float bound)
{
	return lettering_fit(pen->layout->lettering, letter, text, -1, bound);
}

static void put_text(const struct pen *pen, enum token token, enum letter letter, struct lettered text, float x,
		     float baseline)
{
	picture_text(pen->picture, token, letter, text, x, baseline);
}

static void put_middle(const struct pen *pen, enum token token, enum letter letter, struct lettered text, float x,
		       float baseline)
{
	picture_text(pen->picture, token, letter, text, x - text.width / 2, baseline);
}

static void put_line(const struct pen *pen, struct way way, float x1, float y1, float x2, float y2)
{
	if (x1 != x2 || y1 != y2)
		picture_line(pen->picture, way.token, way.style, way.width, x1, y1, x2, y2);
}

/* ---- live values ---- */

static void take_live(struct pen *pen)
{
	const struct fbd_graph *graph = pen->graph;

	pen->state = g_new0(unsigned int, graph->pin_count + 1);
	pen->text = g_malloc0_n((gsize)graph->pin_count + 1, sizeof(*pen->text));
	for (int i = 0; i < graph->pin_count && pen->live; i++)
		pen->state[i] = pen->live->pin(pen->live->context, i, pen->text[i], sizeof(pen->text[i]));
}

/* The stroke of the wire at a pin. */
static struct way way_of(const struct pen *pen, int pin)
{
	struct way way = { pen->ink == TOKEN_INK ? TOKEN_IDLE : pen->ink, STROKE_SOLID, pen->theme->idle_width };

	if (!pen->live)
		return way;
	if (!(pen->state[pin] & LIVE_KNOWN))
		way.style = STROKE_DOTTED;
	else if (*pen->text[pin])
		way.token = TOKEN_ACCENT;
	else if (pen->state[pin] & LIVE_OUT)
		way = (struct way){ TOKEN_POWER, STROKE_SOLID, pen->theme->power_width };
	return way;
}

/* The state of the value at an input: that of its wire, or its own. */
static int state_pin(const struct pen *pen, int pin)
{
	const int source = fbd_graph_source(pen->graph, pin);

	return source >= 0 ? source : pin;
}

/* ---- wires ---- */

/* A vertical part, with bridges where it crosses others. */
static void draw_upright(const struct pen *pen, struct way way, const struct fbd_segment *s)
{
	const float x = pen->layout->left + s->x1;
	float y = fbd_layout_y(pen->layout, s->row1) - way.width / 2;

	for (int row = s->row1 + 1; row < s->row2; row++)
		for (int i = 0; i < pen->plan->crossing_count; i++) {
			const struct fbd_point *c = &pen->plan->crossing[i];
			const float at = fbd_layout_y(pen->layout, row);

			if (c->pin != s->pin || c->row != row || c->x != s->x1)
				continue;
			put_line(pen, way, x, y, x, at - HOP);
			picture_arc(pen->picture, way.token, way.width, x, at, HOP, (float)(-G_PI / 2),
				    (float)(G_PI / 2));
			y = at + HOP;
			break;
		}
	put_line(pen, way, x, y, x, fbd_layout_y(pen->layout, s->row2) + way.width / 2);
}

static void draw_segments(const struct pen *pen)
{
	for (int i = 0; i < pen->plan->segment_count; i++) {
		const struct fbd_segment *s = &pen->plan->segment[i];
		struct way way = way_of(pen, s->pin);

		if (s->feedback && way.style == STROKE_SOLID)
			way.style = STROKE_DASHED;
		if (s->row1 == s->row2)
			put_line(pen, way, pen->layout->left + s->x1, fbd_layout_y(pen->layout, s->row1),
				 pen->layout->left + s->x2, fbd_layout_y(pen->layout, s->row1));
		else
			draw_upright(pen, way, s);
	}
	for (int i = 0; i < pen->plan->joint_count; i++) {
		const struct fbd_point *joint = &pen->plan->joint[i];
		const struct way way = way_of(pen, joint->pin);

		picture_disc(pen->picture, way.token, 1, pen->layout->left + joint->x,
			     fbd_layout_y(pen->layout, joint->row), DOT + way.width / 2);
	}
}

/* Names and values stand above the beginning of a wire. */
static void draw_wire_name(const struct pen *pen, int pin)
{
	const graphene_point_t at = fbd_layout_pin(pen->layout, pin);
	float x = at.x + PADDING + (pen->graph->pin[pin].negated ? FBD_CIRCLE : 0);

	for (int i = 0; i < pen->graph->wire_count; i++) {
		const struct fbd_wire *wire = &pen->graph->wire[i];
		struct lettered name;

		if (wire->from_pin != pin || !wire->name)
			continue;
		name = fit(pen, LETTER_PIN, wire->name, FBD_PIN_BOUND);
		put_text(pen, TOKEN_COMMENT, LETTER_PIN, name, x, at.y - NAME_UP);
		x += name.width + PADDING;
	}
	if (pen->live && *pen->text[pin])
		put_text(pen, TOKEN_ACCENT, LETTER_VALUE, fit(pen, LETTER_VALUE, pen->text[pin], FBD_VALUE_BOUND),
			 x, at.y - NAME_UP);
}

/* ---- pins ---- */

static void draw_open(const struct pen *pen, int pin, graphene_point_t at)
{
	const float way = pen->graph->pin[pin].output ? 5 : -5;

	put_line(pen, (struct way){ TOKEN_COMMENT, STROKE_SOLID, 1 }, at.x, at.y, at.x + way, at.y);
}

static void draw_operand(const struct pen *pen, int pin, graphene_point_t at)
{
	const struct fbd_pin *p = &pen->graph->pin[pin];
	const enum letter letter = fbd_operand_letter(p->operand);
	const struct lettered text = fit(pen, letter, p->operand, LABEL_BOUND);
	const float way = p->output ? 1 : -1, from = p->negated ? 2 * FBD_CIRCLE : 0;
	const float x = at.x + way * (FBD_STUB + from - 4);
	const bool constant = fbd_is_constant(p->operand);

	if (p->wire >= 0) { /* the wire goes on below it */
		put_text(pen, pen->ink, letter, text, at.x + PADDING, at.y - NAME_UP);
		return;
	}
	put_line(pen, constant ? (struct way){ TOKEN_IDLE, STROKE_SOLID, pen->theme->idle_width } :
		 way_of(pen, pin), at.x, at.y, x, at.y);
	put_text(pen, pen->ink, letter, text, p->output ? x + 4 : x - 4 - text.width, at.y + MIDDLE);
	if (pen->live && *pen->text[pin] && !constant) {
		const struct lettered value = fit(pen, LETTER_VALUE, pen->text[pin],
						  MAX(text.width, FBD_VALUE_BOUND - 8));

		put_text(pen, TOKEN_ACCENT, LETTER_VALUE, value, p->output ? x + 4 : x - 4 - value.width,
			 at.y - VALUE_UP);
	}
}

static void draw_circle(const struct pen *pen, int pin, graphene_point_t at)
{
	const struct way way = way_of(pen, state_pin(pen, pin));
	const float x = at.x + (pen->graph->pin[pin].output ? FBD_CIRCLE : -FBD_CIRCLE);

	picture_disc(pen->picture, TOKEN_SHEET, 1, x, at.y, FBD_CIRCLE);
	picture_arc(pen->picture, way.token == TOKEN_POWER ? TOKEN_POWER : pen->ink,
		    way.token == TOKEN_POWER ? pen->theme->power_width : pen->theme->idle_width, x, at.y,
		    FBD_CIRCLE, 0, (float)(2 * G_PI));
}

static void draw_pin(const struct pen *pen, int pin)
{
	const struct fbd_pin *p = &pen->graph->pin[pin];
	const graphene_point_t at = fbd_layout_pin(pen->layout, pin);
	const struct lettered name = fit(pen, LETTER_PIN, p->name, FBD_PIN_BOUND);

	put_text(pen, pen->ink, LETTER_PIN, name, p->output ? at.x - PADDING - name.width : at.x + PADDING,
		 at.y + MIDDLE);
	if (p->open)
		draw_open(pen, pin, at);
	if (p->operand)
		draw_operand(pen, pin, at);
	if (p->previous) /* a turning arrow */
		put_text(pen, TOKEN_COMMENT, LETTER_PIN, fit(pen, LETTER_PIN, "\xe2\x86\xba", 0),
			 at.x - 14 - (p->negated ? FBD_CIRCLE : 0), at.y - NAME_UP + 1);
	if (p->negated)
		draw_circle(pen, pin, at);
	if (p->output && (p->wire >= 0 || fbd_pin_shows_value(p)) && !p->operand)
		draw_wire_name(pen, pin);
}

/* ---- boxes ---- */

static unsigned int marks_of(const struct pen *pen, int box, int pin)
{
	unsigned int marks = 0;

	for (int i = 0; i < pen->scene->mark_count; i++)
		if (pen->scene->mark[i].box == box && pen->scene->mark[i].pin == pin)
			marks |= pen->scene->mark[i].marks;
	return marks;
}

/* The number at the upper right corner: the order of execution. */
static void draw_order(const struct pen *pen, const struct fbd_box *box, const graphene_rect_t *r)
{
	const float x = r->origin.x + r->size.width, y = r->origin.y;
	char number[12];

	g_snprintf(number, sizeof(number), "%d", box->order);
	picture_disc(pen->picture, TOKEN_SHEET, 1, x, y, ORDER);
	picture_arc(pen->picture, TOKEN_ACCENT, 1, x, y, ORDER, 0, (float)(2 * G_PI));
	put_middle(pen, TOKEN_ACCENT, LETTER_BADGE, fit(pen, LETTER_BADGE, number, 0), x, y + 3.5f);
}

static void draw_body(const struct pen *pen, int index, const graphene_rect_t *r)
{
	const struct fbd_box *box = &pen->graph->box[index];
	float part = -1;
	const unsigned int live = pen->live && pen->live->box ?
				  pen->live->box(pen->live->context, index, &part) : 0;
	const bool runs = live & LIVE_OUT;
	const float middle = r->origin.x + r->size.width / 2;

	if (live & LIVE_FRESH)
		picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash, r->origin.x, r->origin.y, r->size.width,
			     r->size.height);
	picture_frame(pen->picture, runs ? TOKEN_POWER : pen->ink, STROKE_SOLID,
		      runs ? pen->theme->power_width : pen->theme->shape_width, r->origin.x, r->origin.y,
		      r->size.width, r->size.height);
	put_middle(pen, pen->ink, LETTER_TYPE, fit(pen, LETTER_TYPE, fbd_box_title(box), FBD_TYPE_BOUND), middle,
		   r->origin.y + 15);
	if (box->instance)
		put_middle(pen, marks_of(pen, index, -1) & MARK_ERROR ? TOKEN_ERROR : pen->ink, LETTER_SYMBOL,
			   fit(pen, LETTER_SYMBOL, box->instance, LABEL_BOUND), middle, r->origin.y - 6);
	if (box->order)
		draw_order(pen, box, r);
	if (part < 0)
		return;
	picture_fill(pen->picture, TOKEN_LINE, 1, r->origin.x, r->origin.y + r->size.height + 2, r->size.width, BAR);
	picture_fill(pen->picture, TOKEN_ACCENT, 1, r->origin.x, r->origin.y + r->size.height + 2,
		     r->size.width * MIN(part, 1), BAR);
}

/* A store, set, reset, jump or return. */
static void draw_end(const struct pen *pen, int index, const graphene_rect_t *r)
{
	const struct fbd_box *box = &pen->graph->box[index];
	const int pin = state_pin(pen, box->first_pin);
	const bool inverse = pen->graph->pin[box->first_pin].negated;
	const bool known = pen->live && pen->state[pin] & LIVE_KNOWN && !*pen->text[pin];
	const bool lit = known && !(pen->state[pin] & LIVE_OUT) == inverse;
	const float y = r->origin.y + r->size.height / 2 + MIDDLE;
	const struct lettered type = fit(pen, LETTER_TYPE, box->type, FBD_TYPE_BOUND);
	float x = r->origin.x, width = r->size.width;

	if (lit)
		picture_fill(pen->picture, TOKEN_POWER, pen->theme->fill, x, r->origin.y, width, r->size.height);
	picture_frame(pen->picture, lit ? TOKEN_POWER : pen->ink, STROKE_SOLID,
		      lit ? pen->theme->shape_width : pen->theme->idle_width, x, r->origin.y, width, r->size.height);
	if (!box->target) {
		put_middle(pen, pen->ink, LETTER_TYPE, type, x + width / 2, y);
		return;
	}
	if (*box->type) {
		put_text(pen, pen->ink, LETTER_TYPE, type, x + PADDING, y);
		x += type.width + 2 * PADDING;
		width -= type.width + 2 * PADDING;
		put_line(pen, (struct way){ pen->ink, STROKE_SOLID, pen->theme->idle_width }, x, r->origin.y, x,
			 r->origin.y + r->size.height);
	}
	put_middle(pen, marks_of(pen, index, -1) & MARK_ERROR ? TOKEN_ERROR : pen->ink, LETTER_SYMBOL,
		   fit(pen, LETTER_SYMBOL, box->target, MIN(LABEL_BOUND, width - 4)), x + width / 2, y);
}

static void draw_box(const struct pen *pen, int index)
{
	const struct fbd_box *box = &pen->graph->box[index];
	const graphene_rect_t r = fbd_layout_box(pen->layout, index);

	if (fbd_is_end(box))
		draw_end(pen, index, &r);
	else if (box->kind != FBD_VALUE)
		draw_body(pen, index, &r);
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
		draw_pin(pen, i);
}

/* ---- marks ---- */

/* The place of a mark: a box, a text at a pin, or the pin. */
static graphene_rect_t place_of(const struct pen *pen, const struct fbd_mark *mark)
{
	graphene_rect_t r;

	if (mark->pin < 0) {
		r = fbd_layout_box(pen->layout, mark->box);
		graphene_rect_inset(&r, -5, -5);
		return r;
	}
	r = fbd_layout_operand(pen->layout, mark->pin);
	graphene_rect_inset(&r, -3, 1);
	return r;
}

static bool is_shown(const struct pen *pen, const struct fbd_mark *mark)
{
	return mark->pin < 0 ? mark->box >= 0 && mark->box < pen->graph->box_count :
	       mark->pin < pen->graph->pin_count;
}

/* A mark of an output that has a wire is one of that wire. */
static bool is_wire(const struct fbd_mark *mark)
{
	return mark->pin >= 0 && mark->box < 0;
}

static void wash_wire(const struct pen *pen, int pin)
{
	for (int i = 0; i < pen->plan->segment_count; i++) {
		const struct fbd_segment *s = &pen->plan->segment[i];
		const float y1 = fbd_layout_y(pen->layout, s->row1), y2 = fbd_layout_y(pen->layout, s->row2);

		if (s->pin == pin)
			picture_fill(pen->picture, TOKEN_ACCENT, 0.3f, pen->layout->left + s->x1 - SELECTED / 2.0f,
				     y1 - SELECTED / 2.0f, s->x2 - s->x1 + SELECTED, y2 - y1 + SELECTED);
	}
}

/* A place may have several marks: its ground is washed once. */
static bool is_washed(const struct pen *pen, int mark)
{
	const unsigned int washes = MARK_CURSOR | MARK_SELECTED | MARK_DROP;
	const struct fbd_mark *of = pen->scene->mark;

	for (int i = 0; i < mark; i++)
		if (of[i].box == of[mark].box && of[i].pin == of[mark].pin && of[i].marks & washes)
			return false;
	return of[mark].marks & washes;
}

static void draw_grounds(const struct pen *pen)
{
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct fbd_mark *mark = &pen->scene->mark[i];
		graphene_rect_t r;

		if (!is_shown(pen, mark) || !is_washed(pen, i))
			continue;
		if (is_wire(mark)) {
			wash_wire(pen, mark->pin);
			continue;
		}
		r = place_of(pen, mark);
		picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash, r.origin.x, r.origin.y, r.size.width,
			     r.size.height);
	}
}

static void fill_found(const struct pen *pen, const graphene_rect_t *r, bool now)
{
	picture_fill(pen->picture, now ? TOKEN_FOUND_NOW : TOKEN_FOUND, 1, r->origin.x, r->origin.y, r->size.width,
		     r->size.height);
	if (now)
		picture_frame(pen->picture, TOKEN_INK, STROKE_SOLID, 2, r->origin.x, r->origin.y, r->size.width,
			      r->size.height);
}

/* Label, title and comments. */
static graphene_rect_t heading_rect(const struct pen *pen)
{
	const struct fbd_layout *layout = pen->layout;
	float right = layout->title_x + layout->title.width;

	for (char **note = layout->note; *note; note++)
		right = MAX(right, RUNG_LEFT + fit(pen, LETTER_COMMENT, *note, 0).width);
	return GRAPHENE_RECT_INIT(RUNG_LEFT - 3, layout->title_y - 15, right - RUNG_LEFT + 6,
				  layout->top - layout->title_y + 4);
}

/* As in rungs: the current hit of a search covers others of the same place and has a frame. */
static void draw_found(const struct pen *pen, bool now)
{
	if (pen->scene->state & (now ? RUNG_FOUND_NOW : RUNG_FOUND)) {
		const graphene_rect_t heading = heading_rect(pen);

		fill_found(pen, &heading, now);
	}
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct fbd_mark *mark = &pen->scene->mark[i];
		graphene_rect_t r;

		if (!is_shown(pen, mark) || !(mark->marks & (now ? MARK_FOUND_NOW : MARK_FOUND)))
			continue;
		r = place_of(pen, mark);
		fill_found(pen, &r, now);
	}
}

static void badge(const struct pen *pen, enum token ground, const char *text, float x, float y)
{
	const struct lettered fits = fit(pen, LETTER_BADGE, text, 0);

	picture_fill(pen->picture, ground, 1, x, y, fits.width + 6, 13);
	put_text(pen, TOKEN_BADGE, LETTER_BADGE, fits, x + 3, y + 10);
}

static void draw_frame(const struct pen *pen, unsigned int marks, const graphene_rect_t *r)
{
	static const struct { unsigned int mark; enum token token; enum stroke_style style; } frames[] = {
		{ MARK_CURSOR, TOKEN_ACCENT, STROKE_SOLID }, { MARK_DROP, TOKEN_ACCENT, STROKE_DASHED },
		{ MARK_BLOCKS, TOKEN_BLOCKS, STROKE_SOLID }, { MARK_CHANGED, TOKEN_FORCE, STROKE_DOTTED },
	};
	float x = r->origin.x;

	for (size_t i = 0; i < G_N_ELEMENTS(frames); i++)
		if (marks & frames[i].mark)
			picture_frame(pen->picture, frames[i].token, frames[i].style, 1.5f, r->origin.x, r->origin.y,
				      r->size.width, r->size.height);
	if (marks & MARK_ERROR)
		picture_wave(pen->picture, TOKEN_ERROR, x, r->origin.y + r->size.height - 2, MIN(r->size.width, 44));
	else if (marks & MARK_WARNING)
		picture_line(pen->picture, TOKEN_FORCE, STROKE_DASHED, 2, x, r->origin.y + r->size.height - 1,
			     x + MIN(r->size.width, 44), r->origin.y + r->size.height - 1);
	x += r->size.width + 2;
	if (marks & MARK_FORCED)
		badge(pen, TOKEN_FORCE, "F", x, r->origin.y + 2);
	else if (marks & MARK_TWICE)
		badge(pen, TOKEN_FORCE, "2\xc3\x97", x, r->origin.y + 2);
	if (marks & MARK_FAILED)
		badge(pen, TOKEN_ERROR, "!", x, r->origin.y + 16);
	if (marks & (MARK_STALE | MARK_FAULT)) /* a force stands at the other end */
		badge(pen, TOKEN_ERROR, marks & MARK_FAULT ? "\xe2\x9c\x96" : "\xe2\x9a\xa0", r->origin.x - 18, r->origin.y + 2);
	if (marks & MARK_CHANGED)
		badge(pen, TOKEN_FORCE, "\xe2\x89\xa0", r->origin.x + 1, r->origin.y + r->size.height - 14);
}

static void draw_marks(const struct pen *pen)
{
	for (int i = 0; i < pen->scene->mark_count; i++) {
		const struct fbd_mark *mark = &pen->scene->mark[i];
		graphene_rect_t r;

		if (!is_shown(pen, mark) || is_wire(mark))
			continue;
		r = place_of(pen, mark);
		draw_frame(pen, mark->marks, &r);
	}
}

/* ---- heading, gutter ---- */

static void draw_ground(const struct pen *pen, float width)
{
	const struct fbd_layout *layout = pen->layout;
	const unsigned int state = pen->scene->state;

	if (!(state & (RUNG_NO_GUTTER | RUNG_ON_GUTTER)))
		picture_fill(pen->picture, TOKEN_GUTTER, 1, 0, 0, RUNG_GUTTER, layout->height);
	if (state & RUNG_SELECTED)
		picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash, 0, 0, width, layout->height);
	if (state & RUNG_ADDED)
		picture_fill(pen->picture, TOKEN_POWER, 0.10f, 0, 0, width, layout->height);
	if (state & RUNG_REMOVED)
		picture_fill(pen->picture, TOKEN_ERROR, 0.10f, 0, 0, width, layout->height);
	if (state & RUNG_CURRENT)
		picture_fill(pen->picture, TOKEN_ACCENT, 1, 0, 2, 3, layout->height - 4);
	if (!(state & RUNG_NO_GUTTER))
		picture_fill(pen->picture, TOKEN_LINE, 1, 0, layout->height - 1, width, 1);
}

static void draw_heading(const struct pen *pen)
{
	const struct fbd_layout *layout = pen->layout;
	float y = layout->note_y;

	put_text(pen, TOKEN_ACCENT, LETTER_OPERAND, layout->label, RUNG_LEFT, layout->title_y);
	put_text(pen, pen->ink, LETTER_TITLE, layout->title, layout->title_x, layout->title_y);
	for (char **note = layout->note; *note; note++, y += NOTE_LINE)
		put_text(pen, TOKEN_COMMENT, LETTER_COMMENT, fit(pen, LETTER_COMMENT, *note, 0), RUNG_LEFT, y);
}

static void draw_number(const struct pen *pen, float width)
{
	const unsigned int state = pen->scene->state;
	const char *sign = state & RUNG_ADDED ? "+" : state & RUNG_REMOVED ? "\xe2\x88\x92" :
			   state & RUNG_CHANGED ? "\xe2\x89\xa0" : NULL;
	const enum letter small = state & RUNG_NO_GUTTER ? LETTER_PIN : LETTER_BADGE;
	const float x = RUNG_GUTTER / 2.0f, y = pen->layout->title_y;
	char number[12];

	g_snprintf(number, sizeof(number), "%d", pen->layout->number);
	put_middle(pen, state & RUNG_CURRENT ? TOKEN_ACCENT : TOKEN_COMMENT, LETTER_NUMBER,
		   fit(pen, LETTER_NUMBER, number, 0), x, y);
	if (pen->layout->off)
		put_middle(pen, TOKEN_COMMENT, small, fit(pen, small, _("OFF"), 0), x, y + 15);
	if (sign)
		put_middle(pen, state & RUNG_ADDED ? TOKEN_POWER : state & RUNG_REMOVED ? TOKEN_ERROR : TOKEN_FORCE,
			   LETTER_HEADING, fit(pen, LETTER_HEADING, sign, 0), x, y + 36);
	if (state & RUNG_MISSING) {
		const struct lettered note = fit(pen, LETTER_COMMENT, _("not downloaded"), 0);

		put_middle(pen, TOKEN_FORCE, LETTER_HEADING, fit(pen, LETTER_HEADING, "\xe2\x86\x93", 0), x, y + 36);
		put_text(pen, TOKEN_FORCE, LETTER_COMMENT, note, width - RUNG_AFTER - note.width,
			 pen->layout->height - 8);
	}
	if (state & RUNG_MARKED) /* a ribbon */
		picture_fill(pen->picture, TOKEN_ACCENT, 1, 7, 0, 6, y + 6);
	if (state & RUNG_EDITED)
		picture_disc(pen->picture, TOKEN_ACCENT, 1, RUNG_GUTTER - 6, y - 5, 3);
}

void fbd_draw(const struct fbd_scene *scene, struct picture *picture)
{
	const bool off = scene->layout->off;
	const float width = MAX(scene->width, scene->layout->width);
	struct pen pen = { .scene = scene, .layout = scene->layout, .graph = &scene->layout->graph,
			   .plan = &scene->layout->plan, .theme = scene->theme, .picture = picture,
			   .live = off ? NULL : scene->live, .ink = off ? TOKEN_COMMENT : TOKEN_INK };

	take_live(&pen);
	draw_ground(&pen, width);
	draw_grounds(&pen);
	draw_found(&pen, false);
	draw_found(&pen, true);
	draw_segments(&pen);
	for (int i = 0; i < pen.graph->box_count; i++)
		draw_box(&pen, i);
	draw_heading(&pen);
	draw_number(&pen, width);
	draw_marks(&pen);
	g_free(pen.state);
	g_free(pen.text);
}

GskRenderNode *fbd_draw_node(const struct fbd_scene *scene)
{
	struct picture picture;
	GskRenderNode *node;

	picture_init(&picture);
	picture.scale = scene->scale;
	fbd_draw(scene, &picture);
	node = picture_node(&picture, scene->theme, scene->layout->lettering);
	picture_clear(&picture);
	return node;
}
