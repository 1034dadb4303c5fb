/* SPDX-License-Identifier: MIT
 *
 * fbd_view_cursor - the shown networks and the cursor.
 *
 * After a change of the project all networks are laid out again. The cursor is made valid before the entry
 * closes: closing it moves the focus, and the window then reads the cursor's place.
 */
#include "editor-gtk/fbd/fbd_view_inside.h"


#include <math.h>
#include <string.h>

#define AROUND 30    /* px at 100 % shown around the cursor                      */
#define APART  8     /* px between two networks                                 */
#define ASIDE  2.5f  /* weight of a px aside against a px ahead                  */
#define LEAST  3     /* px that an arrow moves at least                         */

struct pou *fbd_pou(LadderFbdView *view)
{
	struct project *project = ladder_document_project(view->canvas->document);
	const int pou = view->canvas->pou;

	return project && pou < project->pou_count && project->pou[pou].fbd ? &project->pou[pou] : NULL;
}

/* ---- the sheet ---- */

void fbd_forget_places(LadderFbdView *view)
{
	g_clear_pointer(&view->map, live_map_free);
	for (int i = 0; i < view->count; i++)
		g_clear_pointer(&view->strip[i].places, g_free);
}

void fbd_clear(LadderFbdView *view)
{
	fbd_forget_places(view);
	for (int i = 0; i < view->count; i++) {
		fbd_layout_free(view->strip[i].layout);
		g_free(view->strip[i].selected);
	}
	g_clear_pointer(&view->strip, g_free);
	view->count = 0;
}

const struct fbd_graph *fbd_graph_of(LadderFbdView *view, int network)
{
	return &view->strip[network].layout->graph;
}

/* Moves a place back into the networks. */
static struct fbd_pos fitted(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_graph *graph;

	if (view->count == 0)
		return FBD_NOWHERE;
	at.network = CLAMP(at.network, 0, view->count - 1);
	graph = fbd_graph_of(view, at.network);
	if (at.box >= graph->box_count)
		at = (struct fbd_pos){ at.network, graph->box_count - 1, -1 };
	if (at.pin >= 0 && (at.box < 0 || at.pin < graph->box[at.box].first_pin ||
			    at.pin >= graph->box[at.box].first_pin + graph->box[at.box].pins))
		at.pin = -1;
	return at;
}

static void lay_out_all(LadderFbdView *view)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct pou *pou = fbd_pou(view);

	view->count = pou ? fbd_lines_count(pou) : 0;
	view->strip = g_new0(struct fbd_strip, view->count + 1);
	view->width = 0;
	view->height = 0;
	for (int i = 0; i < view->count; i++) {
		struct fbd_strip *strip = &view->strip[i];

		strip->layout = fbd_layout_new(project, pou, i, view->canvas->lettering);
		strip->y = view->height;
		view->height += strip->layout->height + APART;
		view->width = MAX(view->width, strip->layout->width);
	}
}

void fbd_make_sheet(LadderFbdView *view)
{
	fbd_clear(view);
	view->of = ladder_document_ladder(view->canvas->document);
	lay_out_all(view);
	g_array_set_size(view->found, 0);
	view->link = view->drop = view->stroke.from = view->stroke.to = FBD_NOWHERE;
	view->stroke.drawn = false;
	g_array_set_size(view->marks, 0);
	view->cursor = fitted(view, view->cursor);
	canvas_close_entry(LADDER_CANVAS(view));
	gtk_widget_queue_resize(GTK_WIDGET(view));
	fbd_reveal(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
	canvas_moved(LADDER_CANVAS(view));
}

void fbd_fresh(LadderFbdView *view)
{
	if (view->of != ladder_document_ladder(view->canvas->document))
		fbd_make_sheet(view);
}

/* ---- places ---- */

const struct fbd_box *fbd_box_at(LadderFbdView *view, struct fbd_pos at)
{
	return at.network >= 0 && at.box >= 0 ? &fbd_graph_of(view, at.network)->box[at.box] : NULL;
}

const struct fbd_pin *fbd_pin_at(LadderFbdView *view, struct fbd_pos at)
{
	return fbd_box_at(view, at) && at.pin >= 0 ? &fbd_graph_of(view, at.network)->pin[at.pin] : NULL;
}

/* Is the text in place of a pin the place of it? A pin with a wire is where it meets its box. */
static graphene_rect_t pin_rect(const struct fbd_layout *layout, int pin)
{
	const struct fbd_pin *p = &layout->graph.pin[pin];
	const graphene_point_t at = fbd_layout_pin(layout, pin);
	graphene_rect_t text;

	if (p->wire >= 0 && !p->operand)
		return GRAPHENE_RECT_INIT(at.x - 9, at.y - 9, 18, 18);
	text = fbd_layout_operand(layout, pin);
	return text;
}

graphene_rect_t fbd_rect(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_layout *layout;
	graphene_rect_t rect;

	if (at.network < 0)
		return GRAPHENE_RECT_INIT(16, 8, 120, FBD_ROW);
	layout = view->strip[at.network].layout;
	if (at.box < 0 && !layout->title.width && !layout->label.width) /* the number in the gutter */
		rect = GRAPHENE_RECT_INIT(4, layout->title_y - 16, RUNG_GUTTER - 8, 22);
	else if (at.box < 0)
		rect = GRAPHENE_RECT_INIT(RUNG_LEFT - 4, layout->title_y - 16,
					  MAX(120, layout->title_x + layout->title.width - RUNG_LEFT + 8), 22);
	else
		rect = at.pin >= 0 ? pin_rect(layout, at.pin) : fbd_layout_box(layout, at.box);
	graphene_rect_offset(&rect, 0, view->strip[at.network].y);
	return rect;
}

/* The network at @y, px at 100 %; -1: none. */
static int fbd_strip_at(LadderFbdView *view, float y)
{
	for (int i = 0; i < view->count; i++)
		if (y < view->strip[i].y + view->strip[i].layout->height + APART)
			return y >= view->strip[i].y ? i : -1;
	return -1;
}

struct fbd_pos fbd_hit_at(LadderFbdView *view, graphene_point_t point, float slack, enum fbd_part *part)
{
	const int network = fbd_strip_at(view, point.y);
	struct fbd_pos at = { network, -1, -1 };
	struct fbd_hit hit;

	*part = FBD_PART_NONE;
	if (network < 0)
		return FBD_NOWHERE;
	hit = fbd_layout_hit(view->strip[network].layout, point.x, point.y - view->strip[network].y, slack);
	*part = hit.part;
	if (hit.part == FBD_PART_WIRE) {
		at.pin = hit.pin;
		at.box = fbd_graph_of(view, network)->pin[hit.pin].box;
	} else if (hit.part == FBD_PART_BOX || hit.part == FBD_PART_PIN || hit.part == FBD_PART_OPERAND) {
		at.box = hit.box;
		at.pin = hit.part == FBD_PART_BOX ? -1 : hit.pin;
	}
	return at;
}

/* ---- moving ---- */

void fbd_reveal(LadderFbdView *view)
{
	const double around = AROUND * view->canvas->zoom;

	if (view->cursor.network >= 0)
		canvas_reveal(LADDER_CANVAS(view), fbd_rect(view, view->cursor), around, around);
}

static void select_box(LadderFbdView *view, struct fbd_pos at)
{
	struct fbd_strip *strip = at.network >= 0 ? &view->strip[at.network] : NULL;

	if (!strip || at.box < 0)
		return;
	if (!strip->selected)
		strip->selected = g_new0(bool, strip->layout->graph.box_count + 1);
	strip->selected[at.box] = true;
}

void fbd_select(LadderFbdView *view, bool all)
{
	for (int i = 0; i < view->count; i++)
		g_clear_pointer(&view->strip[i].selected, g_free);
	if (all && view->cursor.network >= 0)
		for (int i = 0; i < fbd_graph_of(view, view->cursor.network)->box_count; i++)
			select_box(view, (struct fbd_pos){ view->cursor.network, i, -1 });
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void fbd_go(LadderFbdView *view, struct fbd_pos at, bool extend)
{
	if (!extend || at.network != view->cursor.network)
		fbd_select(view, false);
	else
		select_box(view, view->cursor);
	view->cursor = fitted(view, at);
	if (extend)
		select_box(view, view->cursor);
	fbd_reveal(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
	canvas_moved(LADDER_CANVAS(view));
}

/* The point from which arrows measure: an input at its left, an output at its right. */
static graphene_point_t anchor_of(LadderFbdView *view, struct fbd_pos at)
{
	const graphene_rect_t rect = fbd_rect(view, at);
	const struct fbd_pin *pin = fbd_pin_at(view, at);
	graphene_point_t point = { rect.origin.x + rect.size.width / 2, rect.origin.y + rect.size.height / 2 };

	if (pin) {
		point = fbd_layout_pin(view->strip[at.network].layout, at.pin);
		point.y += view->strip[at.network].y;
		point.x += pin->output ? 6 : -6;
	} else if (at.box < 0) {
		point.x = rect.origin.x;
	}
	return point;
}

struct way {
	graphene_point_t from;
	int dx, dy;
	float least;
	struct fbd_pos best;
};

static void try_place(LadderFbdView *view, struct fbd_pos at, struct way *way)
{
	const graphene_point_t to = anchor_of(view, at);
	const float x = to.x - way->from.x, y = to.y - way->from.y;
	const float ahead = way->dx ? x * (float)way->dx : y * (float)way->dy;
	const float far = ahead + ASIDE * fabsf(way->dx ? y : x);

	if (fbd_is_same(at, view->cursor) || ahead < LEAST || far >= way->least)
		return;
	way->least = far;
	way->best = at;
}

static void try_network(LadderFbdView *view, int network, bool boxes_only, struct way *way)
{
	const struct fbd_graph *graph = fbd_graph_of(view, network);

	if (!way->dx)
		try_place(view, (struct fbd_pos){ network, -1, -1 }, way);
	for (int i = 0; i < graph->box_count; i++) {
		const struct fbd_box *box = &graph->box[i];

		try_place(view, (struct fbd_pos){ network, i, -1 }, way);
		for (int pin = box->first_pin; !boxes_only && pin < box->first_pin + box->pins; pin++)
			try_place(view, (struct fbd_pos){ network, i, pin }, way);
	}
}

/* Up and down from a box lead to boxes, from a pin to pins of its side first. */
static bool step_along_pins(LadderFbdView *view, int dy)
{
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);
	const struct fbd_graph *graph;
	struct fbd_pos at = view->cursor;

	if (!pin || !dy)
		return false;
	graph = fbd_graph_of(view, at.network);
	at.pin += dy;
	if (at.pin < graph->box[at.box].first_pin ||
	    at.pin >= graph->box[at.box].first_pin + graph->box[at.box].pins ||
	    graph->pin[at.pin].output != pin->output)
		return false;
	fbd_go(view, at, false);
	return true;
}

/* The first pin of a side of a box; -1: none. */
static int first_pin(const struct fbd_graph *graph, const struct fbd_box *box, bool output)
{
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
		if (graph->pin[i].output == output)
			return i;
	return -1;
}

/* The other end of the wire at a pin: what gives an input, the first reader of an output. -1: none. */
static int other_end(const struct fbd_graph *graph, int pin)
{
	if (!graph->pin[pin].output)
		return fbd_graph_source(graph, pin);
	for (int i = 0; i < graph->pin_count; i++)
		if (!graph->pin[i].output && fbd_graph_source(graph, i) == pin)
			return i;
	return -1;
}

/* Left and right lead from a box to its pins, from a pin to its box, along a wire to its other end. */
static bool step_along_wire(LadderFbdView *view, int dx)
{
	const struct fbd_box *box = fbd_box_at(view, view->cursor);
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);
	const struct fbd_graph *graph;
	struct fbd_pos at = view->cursor;

	if (!box || !dx)
		return false;
	graph = fbd_graph_of(view, at.network);
	if (!pin)
		at.pin = first_pin(graph, box, dx > 0);
	else if (pin->output == (dx > 0))
		at.pin = other_end(graph, at.pin);
	else
		at.pin = -1;
	if (at.pin < 0 && (!pin || pin->output == (dx > 0)))
		return false;
	if (at.pin >= 0)
		at.box = graph->pin[at.pin].box;
	fbd_go(view, at, false);
	return true;
}

void fbd_step(LadderFbdView *view, int dx, int dy, bool extend)
{
	struct way way = { .dx = dx, .dy = dy, .least = INFINITY, .best = view->cursor };

	if (view->cursor.network < 0 || (!extend && (step_along_pins(view, dy) || step_along_wire(view, dx))))
		return;
	way.from = anchor_of(view, view->cursor);
	for (int i = MAX(view->cursor.network - 1, 0); i <= MIN(view->cursor.network + 1, view->count - 1); i++)
		if (i == view->cursor.network || (dy < 0 && i < view->cursor.network) ||
		    (dy > 0 && i > view->cursor.network))
			try_network(view, i, extend || (dy && view->cursor.pin < 0), &way);
	fbd_go(view, way.best, extend);
}

/* ---- for edits ---- */

static int statement_of(LadderFbdView *view, int network, int item)
{
	return fbd_lines_statement(fbd_pou(view), network, item);
}

struct fbd_spot fbd_spot_of(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_graph *graph = fbd_graph_of(view, at.network);
	const struct fbd_box *box = fbd_box_at(view, at);
	const struct fbd_pin *pin = fbd_pin_at(view, at);
	struct fbd_spot spot = { .statement = -1, .output = true };

	if (!box)
		return spot;
	spot.statement = statement_of(view, at.network, box->item);
	for (int i = 0; i < at.box; i++)
		spot.box += graph->box[i].item == box->item;
	if (pin) {
		spot.pin = pin->name;
		spot.number = fbd_pin_number(graph, at.pin) - 1;
		spot.output = pin->output;
	}
	return spot;
}

GArray *fbd_selection(LadderFbdView *view)
{
	GArray *spots = g_array_new(FALSE, FALSE, sizeof(struct fbd_spot));
	const int network = view->cursor.network;
	const bool *selected = network >= 0 ? view->strip[network].selected : NULL;

	for (int i = 0; selected && i < fbd_graph_of(view, network)->box_count; i++) {
		const struct fbd_spot spot = fbd_spot_of(view, (struct fbd_pos){ network, i, -1 });

		if (selected[i])
			g_array_append_val(spots, spot);
	}
	if (!spots->len && fbd_box_at(view, view->cursor)) {
		const struct fbd_spot spot = fbd_spot_of(view, (struct fbd_pos){ network, view->cursor.box, -1 });

		g_array_append_val(spots, spot);
	}
	return spots;
}

void fbd_go_statement(LadderFbdView *view, int network, int statement)
{
	const struct fbd_graph *graph;
	struct fbd_pos at = { network, -1, -1 };

	if (network >= view->count)
		return;
	graph = fbd_graph_of(view, network);
	for (int i = 0; i < graph->box_count; i++)
		if (statement_of(view, network, graph->box[i].item) == statement)
			at.box = i;
	fbd_go(view, at, false);
}
