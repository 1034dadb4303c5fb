/* SPDX-License-Identifier: MIT
 *
 * plcopen_picture - the elements of a network and their places, for a picture beside the result.
 *
 * Coordinates are read for this alone. A network with two elements at one place has no picture: its tool
 * lays it out anew each time.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { PIN_STEP = 20, PIN_FIRST = 30, MOST_POINTS = 200, MOST_SHAPES = 2000 };

struct sketch {
	struct plcopen *c;
	const struct plc_graph *graph;
	struct drawing *to;
	bool *shown;             /* by component: it is in the group               */
	bool *hangs;             /* by element: a rail on which something of it hangs */
};

static int number_of(const struct xml_node *node, const char *name, int otherwise)
{
	const char *value = xml_value(node, name);
	const double number = value ? strtod(value, NULL) : otherwise;

	return number > -1e6 && number < 1e6 ? (int)number : otherwise;
}

static enum drawn_kind kind_of(const struct plc_element *e)
{
	switch ((int)e->kind) {
	case PLC_LEFT:
	case PLC_RIGHT:
		return DRAWN_RAIL;
	case PLC_CONTACT:
		return DRAWN_CONTACT;
	case PLC_COIL:
		return DRAWN_COIL;
	case PLC_BLOCK:
		return DRAWN_BOX;
	case PLC_JUMP:
	case PLC_RETURN:
	case PLC_STOP:
		return DRAWN_JUMP;
	default:
		return DRAWN_VALUE;
	}
}

static const char *sign_of(const struct plc_element *e)
{
	return e->storage == PLC_SET ? "S" : e->storage == PLC_RESET ? "R" : e->edge == PLC_RISING ? "P" :
	       e->edge == PLC_FALLING ? "N" : e->negated ? "/" : "";
}

static int width_of(const struct plc_element *e)
{
	return number_of(e->node, "width", e->kind == PLC_LEFT || e->kind == PLC_RIGHT ? 3 :
			 e->kind == PLC_CONTACT || e->kind == PLC_COIL ? 21 : 80);
}

static int height_of(const struct plc_element *e)
{
	const int pins = e->ins > e->outs ? e->ins : e->outs;

	return number_of(e->node, "height", e->kind == PLC_BLOCK ? PIN_FIRST + pins * PIN_STEP :
			 e->kind == PLC_CONTACT || e->kind == PLC_COIL ? 15 : 20);
}

/* Where a pin stands: as the tool says, or one below the other at its side. */
static void place_of(const struct plc_element *e, const struct plc_pin *pin, int number, bool output, int *x, int *y)
{
	const struct xml_node *place = xml_look(pin->node, "relPosition");

	*x = e->x + (place ? number_of(place, "x", 0) : output ? width_of(e) : 0);
	*y = e->y + (place ? number_of(place, "y", 0) : e->kind == PLC_BLOCK ? PIN_FIRST + number * PIN_STEP :
		     height_of(e) / 2);
}

static void add_wire(struct sketch *s, int x1, int y1, int x2, int y2)
{
	struct drawn_line *line = arena_push(s->c->arena, &s->to->wire, &s->to->wires, sizeof(*line));

	if (line)
		*line = (struct drawn_line){ x1, y1, x2, y2 };
}

/* The points of a connection lead from the pin back to its source. */
static bool add_points(struct sketch *s, const struct xml_node *connection)
{
	int x = 0, y = 0, count = 0;

	for (const struct xml_node *each = connection->first; each && count < MOST_POINTS; each = each->next) {
		const int next_x = number_of(each, "x", 0), next_y = number_of(each, "y", 0);

		if (!xml_is(each, "position"))
			continue;
		if (count++)
			add_wire(s, x, y, next_x, next_y);
		x = next_x;
		y = next_y;
	}
	return count > 1;
}

static void add_connection(struct sketch *s, const struct plc_element *e, int pin, int source,
			   const struct xml_node *connection)
{
	const struct plc_source *from = &s->graph->source[plc_in(s->graph, e, pin)->first + source];
	const struct plc_element *other = &s->graph->element[from->element];
	int x1, y1, x2, y2, middle;

	s->hangs[from->element] |= other->kind == PLC_LEFT;
	place_of(e, plc_in(s->graph, e, pin), pin, false, &x2, &y2);
	if (from->output < 0 || (connection && add_points(s, connection)))
		return;
	place_of(other, plc_out(s->graph, other, from->output), from->output, true, &x1, &y1);
	/* A rail is as long as what hangs on it. */
	if (other->kind == PLC_LEFT)
		y1 = y2;
	middle = x1 + (x2 - x1) / 2;
	add_wire(s, x1, y1, middle, y1);
	add_wire(s, middle, y1, middle, y2);
	add_wire(s, middle, y2, x2, y2);
}

static void add_connections(struct sketch *s, const struct plc_element *e)
{
	for (int i = 0; i < e->ins; i++) {
		const struct plc_pin *pin = plc_in(s->graph, e, i);
		const struct xml_node *each = pin->node->first;

		for (int k = 0; k < pin->sources; k++) {
			while (each && !xml_is(each, "connection"))
				each = each->next;
			add_connection(s, e, i, k, each);
			each = each ? each->next : NULL;
		}
	}
}

static void add_pins(struct sketch *s, const struct plc_element *e)
{
	for (int i = 0; i < e->ins + e->outs; i++) {
		const bool output = i >= e->ins;
		const int number = output ? i - e->ins : i;
		const struct plc_pin *from = output ? plc_out(s->graph, e, number) : plc_in(s->graph, e, number);
		struct drawn_pin *pin = arena_push(s->c->arena, &s->to->pin, &s->to->pins, sizeof(*pin));

		if (!pin)
			return;
		*pin = (struct drawn_pin){ .output = output, .negated = from->negated, .name = plc_print(s->c, "%s", from->name) };
		place_of(e, from, number, output, &pin->x, &pin->y);
	}
}

static void add_shape(struct sketch *s, const struct plc_element *e)
{
	struct drawn_shape *shape = arena_push(s->c->arena, &s->to->shape, &s->to->shapes, sizeof(*shape));

	if (!shape)
		return;
	*shape = (struct drawn_shape){ .kind = kind_of(e), .x = e->x, .y = e->y, .width = width_of(e), .height = height_of(e),
				       .text = plc_print(s->c, "%s", e->kind == PLC_RETURN ? "RETURN" : e->name),
				       .above = plc_print(s->c, "%s", e->instance ? e->instance : ""), .sign = sign_of(e) };
	if (e->kind == PLC_BLOCK)
		add_pins(s, e);
	add_connections(s, e);
}

/* A rail is drawn from the first to the last element that hangs on it. */
static void add_rail(struct sketch *s, int rail)
{
	const struct plc_element *e = &s->graph->element[rail];
	int top = INT_MAX, bottom = INT_MIN;

	for (int i = 0; i < s->to->wires; i++)
		if (s->to->wire[i].x1 <= e->x + width_of(e) && s->to->wire[i].x1 >= e->x) {
			top = s->to->wire[i].y1 < top ? s->to->wire[i].y1 : top;
			bottom = s->to->wire[i].y1 > bottom ? s->to->wire[i].y1 : bottom;
		}
	for (int i = 0; i < s->to->wires; i++)
		if (s->to->wire[i].x2 <= e->x + width_of(e) && s->to->wire[i].x2 >= e->x) {
			top = s->to->wire[i].y2 < top ? s->to->wire[i].y2 : top;
			bottom = s->to->wire[i].y2 > bottom ? s->to->wire[i].y2 : bottom;
		}
	if (top <= bottom) {
		struct drawn_shape *shape = arena_push(s->c->arena, &s->to->shape, &s->to->shapes, sizeof(*shape));

		if (shape)
			*shape = (struct drawn_shape){ .kind = DRAWN_RAIL, .x = e->x, .y = top - 10, .width = width_of(e),
						       .height = bottom - top + 20, .text = "", .above = "", .sign = "" };
	}
}

static void reach(int *least, int *most, int from, int to)
{
	*least = from < *least ? from : *least;
	*most = to > *most ? to : *most;
}

/* Two elements at one place: nobody has placed them. */
static bool is_placed(const struct drawing *to)
{
	int drawn = 0;

	if (to->shapes > MOST_SHAPES)
		return false;
	for (int i = 0; i < to->shapes; i++) {
		drawn += to->shape[i].kind != DRAWN_RAIL;
		for (int k = 0; k < i && to->shape[i].kind != DRAWN_RAIL; k++)
			if (to->shape[k].kind != DRAWN_RAIL && to->shape[k].x == to->shape[i].x &&
			    to->shape[k].y == to->shape[i].y)
				return false;
	}
	return drawn > 1;
}

/* To the left top; false: the elements are too far from one another. */
static bool settle(struct drawing *to)
{
	int left = INT_MAX, top = INT_MAX, right = INT_MIN, bottom = INT_MIN;

	for (int i = 0; i < to->shapes; i++) {
		const struct drawn_shape *shape = &to->shape[i];

		reach(&left, &right, shape->x, shape->x + shape->width);
		reach(&top, &bottom, shape->y, shape->y + shape->height);
	}
	for (int i = 0; i < to->wires; i++) {
		reach(&left, &right, to->wire[i].x1, to->wire[i].x2);
		reach(&top, &bottom, to->wire[i].y1, to->wire[i].y2);
		reach(&left, &right, to->wire[i].x2, to->wire[i].x1);
		reach(&top, &bottom, to->wire[i].y2, to->wire[i].y1);
	}
	if (right - left > 20000 || bottom - top > 20000)
		return false;
	for (int i = 0; i < to->shapes; i++) {
		to->shape[i].x -= left;
		to->shape[i].y -= top;
	}
	for (int i = 0; i < to->pins; i++) {
		to->pin[i].x -= left;
		to->pin[i].y -= top;
	}
	for (int i = 0; i < to->wires; i++) {
		to->wire[i].x1 -= left;
		to->wire[i].x2 -= left;
		to->wire[i].y1 -= top;
		to->wire[i].y2 -= top;
	}
	to->width = right - left;
	to->height = bottom - top;
	return true;
}

void plc_picture(struct plcopen *c, const struct plc_graph *graph, const struct plc_group *group)
{
	struct drawing drawing = { .pou = plc_print(c, "%s", plc_renamed(c, c->pou_name)), .number = c->rungs, .line = group->node->line };
	struct sketch s = { .c = c, .graph = graph, .to = &drawing };
	struct drawing *added;

	if (!c->pictures)
		return;
	s.shown = calloc(2 * ((size_t)graph->elements + 1), sizeof(*s.shown));
	if (!s.shown)
		return;
	s.hangs = s.shown + graph->elements + 1;
	for (int i = 0; i < group->count; i++)
		s.shown[graph->element[graph->step[group->first + i]].component] = true;
	for (int i = 0; i < graph->elements; i++) {
		const struct plc_element *e = &graph->element[i];

		if (s.shown[e->component] && e->kind < PLC_STEP && e->kind != PLC_LEFT && e->kind != PLC_RIGHT &&
		    e->kind != PLC_COMMENT)
			add_shape(&s, e);
	}
	for (int i = 0; i < graph->elements; i++)
		if (s.hangs[i])
			add_rail(&s, i);
	free(s.shown);
	if (!is_placed(&drawing) || !settle(&drawing))
		return;
	added = arena_push(c->arena, &c->drawings.one, &c->drawings.count, sizeof(*added));
	if (added)
		*added = drawing;
}
