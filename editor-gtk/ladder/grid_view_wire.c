/* SPDX-License-Identifier: MIT
 *
 * grid_view_wire - wires drawn on a sheet with the pointer.
 *
 * Near the end of an element, on a wire and at the ends of free cells the pointer is a cross,
 * and a drag from there draws a wire (grid_draw_wire()), or erases one with Ctrl. The sheet
 * shows its way and where it may end; the document gets it at the release. grid_wire.c defines
 * the way of a wire.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include <math.h>
#include <string.h>

#define RING   5   /* px; half size of the mark where a wire would begin       */
#define DOT    2.5f /* px; half size of the marks where it may end             */
#define GHOST  3   /* px; width of the drawn wire                              */
#define DASH   7   /* px; dashes of a wire that erases or is refused           */
#define ASIDE  50  /* px from a wire to the branch below it                     */
#define JUST   0.2f /* px from the end of a line to the beginning of the next   */

/* ---- where ---- */

/* A point of the layout, px of the widget. */
static graphene_point_t shown(LadderGridView *view, graphene_point_t at)
{
	return canvas_rect(LADDER_CANVAS(view), (graphene_rect_t){
		.origin = strip_shown(view, strips_get(view, view->wire.rung), at.x, at.y) }).origin;
}

/* An end of a wire, as laid out. @ends: it is shown at the end of a line. */
static graphene_point_t laid_of(LadderGridView *view, struct grid_end end, bool ends)
{
	const struct rung_layout *layout = strips_get(view, view->wire.rung)->layout;
	const int row = MIN(end.row, layout->rows - 1);
	const float below = end.row > row ? RUNG_CELL_HEIGHT : 0;

	return GRAPHENE_POINT_INIT(rung_layout_end_x(layout, end.bar) - (ends ? JUST : 0),
				   layout->row[row].wire + below);
}

static graphene_point_t place_of(LadderGridView *view, struct grid_end end, bool ends)
{
	return shown(view, laid_of(view, end, ends));
}

static int line_at(LadderGridView *view, int rung, float x)
{
	const struct rung_fold *fold = strips_get(view, rung)->fold;

	return fold ? rung_fold_line_at(fold, x) : 0;
}

/* Is the pointer, at @x as laid out, in the line before the one that begins with @bar? */
static bool is_before(LadderGridView *view, int rung, float x, int bar)
{
	const float end = rung_layout_end_x(strips_get(view, rung)->layout, bar);

	return line_at(view, rung, x) < line_at(view, rung, end) && line_at(view, rung, x) == line_at(view, rung, end - JUST);
}

/* A point of the widget as one of the layout of @rung. */
static graphene_point_t in_strip(LadderGridView *view, int rung, double x, double y)
{
	return strip_laid(view, strips_get(view, rung), canvas_point(LADDER_CANVAS(view), x, y));
}

/* Rung and cell end where a wire can begin; -1: none near. */
static int begin_at(LadderGridView *view, double x, double y, struct grid_end *end, bool *ends)
{
	struct rung_hit hit;
	const bool drawn = !view->canvas->entry && !ladder_document_is_fixed(view->canvas->document);
	const int rung = drawn ? sheet_point(view, x, y, &hit) : -1;
	graphene_point_t at;

	if (rung < 0)
		return -1;
	at = in_strip(view, rung, x, y);
	if (!rung_layout_end(&view->drafting, strips_get(view, rung)->layout, at.x, at.y, &end->row, &end->bar))
		return -1;
	*ends = is_before(view, rung, at.x, end->bar);
	return rung;
}

/* The end of a stroke for a pointer at (@x, @y). Its line shows all rows from now on. */
static struct grid_end end_at(LadderGridView *view, double x, double y)
{
	const struct rung_layout *layout = strips_get(view, view->wire.rung)->layout;
	const graphene_point_t at = in_strip(view, view->wire.rung, x, y);
	struct grid_end end;

	rung_layout_nearest(layout, at.x, at.y, &end.row, &end.bar);
	end.row = MIN(end.row, layout->rung->rows);
	view->wire.to_ends = is_before(view, view->wire.rung, at.x, end.bar);
	if (line_at(view, view->wire.rung, at.x) < view->wire.line) {
		view->wire.line = line_at(view, view->wire.rung, at.x);
		strip_follow(view, view->wire.rung);
	}
	return end;
}

/* ---- the pointer ---- */

static void set_pointer(LadderGridView *view, const char *name)
{
	gtk_widget_set_cursor_from_name(GTK_WIDGET(view), name);
}

static void hover(LadderGridView *view, double x, double y)
{
	struct grid_end end = { -1, -1 };
	bool ends = false;
	const int rung = view->preview ? -1 : begin_at(view, x, y, &end, &ends);

	/* The pointer may move far before the stroke begins. */
	if (view->wire.pressed || (rung == view->wire.hover && ends == view->wire.from_ends &&
	    end.row == view->wire.from.row && end.bar == view->wire.from.bar))
		return;
	view->wire.from_ends = ends;
	view->wire.hover = view->wire.rung = rung;
	view->wire.from = end;
	set_pointer(view, rung < 0 ? NULL : "crosshair");
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void moved(GtkEventControllerMotion *motion, double x, double y,
		  LadderGridView *view)
{
	(void)motion;
	hover(view, x, y);
}

static void left(GtkEventControllerMotion *motion, LadderGridView *view)
{
	(void)motion;
	if (!view->wire.pressed)
		wire_forget(view);
}

/* ---- a stroke ---- */

bool wire_press(LadderGridView *view, double x, double y)
{
	struct grid_end end;
	bool ends = false;
	const int rung = begin_at(view, x, y, &end, &ends);

	view->wire.pressed = rung >= 0;
	if (rung < 0)
		return false;
	view->wire.rung = rung;
	view->wire.from = view->wire.to = end;
	view->wire.from_ends = view->wire.to_ends = ends;
	return true;
}

/* Shows one more row below the rung: a stroke may end there. */
static void begin(LadderGridView *view, const struct rung *rung)
{
	view->wire.drawing = true;
	view->wire.rows = MIN(rung->rows + 1, LIMIT_ROWS);
	view->wire.line = line_at(view, view->wire.rung, laid_of(view, view->wire.from, view->wire.from_ends).x);
	view->wire.legal = g_new0(bool, view->wire.rows * view->columns);
	grid_wire_ends(rung, view->columns, view->wire.from, view->wire.rows,
		       view->wire.legal);
	strips_dirty(view, view->wire.rung);
}

/* The first direction of the pointer decides which leg comes first. */
static void choose_leg(LadderGridView *view, struct grid_end to)
{
	const struct grid_end *from = &view->wire.from;

	if (to.row == from->row || to.bar == from->bar)
		view->wire.along = to.row != from->row;
}

static void show_stroke(LadderGridView *view)
{
	set_pointer(view, view->wire.course == GRID_NO_COURSE &&
		    (view->wire.to.row != view->wire.from.row ||
		     view->wire.to.bar != view->wire.from.bar) ? "not-allowed" :
		    "crosshair");
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void wire_drag(LadderGridView *view, double x, double y, GdkModifierType state)
{
	const struct rung *rung = sheet_rung(view, view->wire.rung);
	struct grid_end to;

	if (!view->wire.pressed || !rung)
		return;
	if (!view->wire.drawing)
		begin(view, rung);
	to = end_at(view, x, y);
	choose_leg(view, to);
	view->wire.to = to;
	view->wire.erase = state & GDK_CONTROL_MASK;
	if (view->wire.erase)
		view->wire.course = view->wire.along ? GRID_ALONG : GRID_ACROSS;
	else
		view->wire.course = grid_wire_course(rung, view->columns, view->wire.from,
						     to, view->wire.along);
	show_stroke(view);
}

void wire_forget(LadderGridView *view)
{
	const int rung = view->wire.drawing ? view->wire.rung : -1;

	g_free(view->wire.legal);
	memset(&view->wire, 0, sizeof(view->wire));
	view->wire.rung = view->wire.hover = -1;
	set_pointer(view, NULL);
	if (sheet_rung(view, rung))
		strips_dirty(view, rung);
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void put_stroke(LadderGridView *view, const struct sheet_wire *wire)
{
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct grid_at at = sheet_at(view);
	struct rung *made = wire->erase ?
		grid_erase_wire(rung, &at, wire->from, wire->to, wire->along) :
		grid_draw_wire(rung, &at, wire->from, wire->to, wire->along);

	if (sheet_put(view, made, &at, wire->erase ? _("Erase wire") : _("Draw wire")) &&
	    (wire->course == GRID_ROUND || wire->course == GRID_OVER))
		canvas_tell(LADDER_CANVAS(view), _("This branch is empty: type an element, or drop "
			  "one on the wire."));
}

bool wire_release(LadderGridView *view)
{
	const struct sheet_wire wire = view->wire;

	if (!wire.drawing) {
		view->wire.pressed = false;
		return false;
	}
	wire_forget(view);
	if (wire.rung == view->cursor.at.rung && sheet_rung(view, wire.rung) &&
	    (wire.to.row != wire.from.row || wire.to.bar != wire.from.bar))
		put_stroke(view, &wire);
	return true;
}

/* ---- drawing ---- */

struct brush {
	GtkSnapshot *snapshot;
	GdkRGBA color;
	bool dashed;
};

static void fill(const struct brush *brush, float x, float y, float width, float height)
{
	gtk_snapshot_append_color(brush->snapshot, &brush->color,
				  &GRAPHENE_RECT_INIT(x, y, width, height));
}

/* Upright or level, as wires are. */
static void stroke(const struct brush *brush, graphene_point_t a, graphene_point_t b)
{
	const bool level = fabsf(b.x - a.x) >= fabsf(b.y - a.y);
	const float x = MIN(a.x, b.x), y = MIN(a.y, b.y);
	const float length = (level ? fabsf(b.x - a.x) : fabsf(b.y - a.y)) + GHOST;
	const float step = brush->dashed ? DASH * 2 : length;
	const float part = brush->dashed ? DASH : length;

	for (float at = 0; at < length; at += step) {
		const float size = MIN(part, length - at);

		if (level)
			fill(brush, x + at - GHOST / 2.0f, a.y - GHOST / 2.0f, size, GHOST);
		else
			fill(brush, a.x - GHOST / 2.0f, y + at - GHOST / 2.0f, GHOST, size);
	}
}

static void square(const struct brush *brush, graphene_point_t at, float half)
{
	fill(brush, at.x - half, at.y - half, 2 * half, 2 * half);
}

static void frame(const struct brush *brush, graphene_point_t at, float half)
{
	const float line = 1.5f;

	fill(brush, at.x - half, at.y - half, 2 * half, line);
	fill(brush, at.x - half, at.y + half - line, 2 * half, line);
	fill(brush, at.x - half, at.y - half, line, 2 * half);
	fill(brush, at.x + half - line, at.y - half, line, 2 * half);
}

/* Does a folded rung show an end? */
static bool is_shown(LadderGridView *view, struct grid_end end)
{
	const struct strip *strip = strips_get(view, view->wire.rung);

	return !strip->fold ||
	       end.row < strip->fold->line[rung_fold_line_at(strip->fold, rung_layout_end_x(strip->layout, end.bar))].rows;
}

static void draw_legal(LadderGridView *view, const struct brush *brush)
{
	for (int row = 0; row < view->wire.rows; row++)
		for (int bar = 0; bar < view->columns; bar++) {
			const struct grid_end end = { row, bar };

			if (view->wire.legal[row * view->columns + bar] && is_shown(view, end))
				square(brush, place_of(view, end, false), DOT);
		}
}

/* A part of the way in one line of a folded rung. */
static void stroke_line(LadderGridView *view, const struct brush *brush, const struct rung_fold *fold, int line,
			graphene_point_t a, graphene_point_t b)
{
	const struct rung_fold_line *part = &fold->line[line];
	const float zoom = (float)view->canvas->zoom, last = part->to - 0.1f;
	const bool before = a.x < part->from, behind = b.x > last;
	graphene_point_t from = shown(view, GRAPHENE_POINT_INIT(MAX(a.x, part->from), a.y));
	graphene_point_t to = shown(view, GRAPHENE_POINT_INIT(MIN(b.x, last), b.y));

	from.x -= before ? FOLD_END * zoom : 0;
	to.x += behind ? FOLD_END * zoom : 0;
	stroke(brush, from, to);
}

/* A part of the way, upright or level, as laid out. A level one goes on in the next lines of a folded rung. */
static void stroke_laid(LadderGridView *view, const struct brush *brush, graphene_point_t a, graphene_point_t b)
{
	const struct rung_fold *fold = strips_get(view, view->wire.rung)->fold;

	if (!fold) {
		stroke(brush, shown(view, a), shown(view, b));
		return;
	}
	if (a.x > b.x) {
		const graphene_point_t other = a;

		a = b;
		b = other;
	}
	for (int line = rung_fold_line_at(fold, a.x); line <= rung_fold_line_at(fold, b.x); line++)
		stroke_line(view, brush, fold, line, a, b);
}

/* Over one corner, or around the elements between its ends. */
static void draw_way(LadderGridView *view, const struct brush *brush)
{
	const enum grid_course course = view->wire.course;
	const graphene_point_t a = laid_of(view, view->wire.from, view->wire.from_ends);
	const graphene_point_t b = laid_of(view, view->wire.to, view->wire.to_ends);
	const float aside = course == GRID_OVER ? -0.8f * ASIDE : ASIDE;
	graphene_point_t first = { b.x, a.y }, second;

	if (course == GRID_ALONG)
		first = (graphene_point_t){ a.x, b.y };
	second = first;
	if (course == GRID_ROUND || course == GRID_OVER) {
		first = (graphene_point_t){ a.x, a.y + aside };
		second = (graphene_point_t){ b.x, b.y + aside };
	}
	square(brush, shown(view, b), RING);
	stroke_laid(view, brush, a, first);
	stroke_laid(view, brush, first, second);
	stroke_laid(view, brush, second, b);
}

void wire_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme)
{
	const bool good = view->wire.course != GRID_NO_COURSE;
	struct brush brush = { snapshot, theme->color[TOKEN_ACCENT], false };

	if (view->wire.rung < 0 || view->wire.rung >= sheet_rungs(view) ||
	    !strips_get(view, view->wire.rung)->layout)
		return;
	if (!view->wire.drawing) {
		if (view->wire.hover >= 0)
			frame(&brush, place_of(view, view->wire.from, view->wire.from_ends), RING);
		return;
	}
	if (!view->wire.erase)
		draw_legal(view, &brush);
	brush.dashed = view->wire.erase || !good;
	if (brush.dashed)
		brush.color = theme->color[TOKEN_ERROR];
	draw_way(view, &brush);
}

void wire_init(LadderGridView *view)
{
	GtkEventController *motion = gtk_event_controller_motion_new();

	view->wire.rung = view->wire.hover = -1;
	g_signal_connect(motion, "motion", G_CALLBACK(moved), view);
	g_signal_connect(motion, "leave", G_CALLBACK(left), view);
	gtk_widget_add_controller(GTK_WIDGET(view), motion);
}
