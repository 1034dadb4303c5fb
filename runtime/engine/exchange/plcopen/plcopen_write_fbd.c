/* SPDX-License-Identifier: MIT
 *
 * plcopen_write_fbd - networks as drawn elements of a body.
 *
 * Each box, store and jump has the number of its place in the order of execution, so that where it
 * stands says nothing. A box R_EDGE or F_EDGE is an edge at the pins that it leads to.
 */
#include "engine/exchange/plcopen/plcopen_out.h"

#include "engine/model/fbd.h"
#include "engine/model/fbd_graph.h"
#include "engine/model/st.h"
#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

enum { LEFT = 200, COLUMN = 260, ROW = 100, PIN = 20, WIDTH = 90 };

/* What leads into a pin. */
struct input {
	int id;                 /* localId; 0: nothing                            */
	const char *pin;        /* of a block; NULL: its only output              */
	bool negated;
	const char *edge;       /* "rising"; NULL: none                           */
};

struct diagram {
	struct out *out;
	const struct fbd_graph *graph;
	const struct fbd_network *network;
	int number;             /* of the network, 1-based                        */
	int *id, *column;       /* of each box                                    */
	struct input *input;    /* of each pin that is an input                   */
};

static const struct fbd_box *box_of(const struct diagram *d, int pin)
{
	return &d->graph->box[d->graph->pin[pin].box];
}

static int index_of(const struct diagram *d, const struct fbd_box *box)
{
	return (int)(box - d->graph->box);
}

/* A wire from a variable is a copy of it: what it is later does not change the wire. */
static const char *function_of(struct diagram *d, const struct fbd_box *box)
{
	static const struct { const char *sign, *name; } signs[] = {
		{ "+", "ADD" }, { "-", "SUB" }, { "*", "MUL" }, { "/", "DIV" }, { "**", "EXPT" }, { "=", "EQ" },
		{ "<>", "NE" }, { "<", "LT" }, { "<=", "LE" }, { ">", "GT" }, { ">=", "GE" }, { "&", "AND" },
		{ "AND_THEN", "AND" }, { "OR_ELSE", "OR" },
	};

	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (!strcmp(signs[i].sign, box->type))
			return signs[i].name;
	return box->kind == FBD_VALUE ? "MOVE" : plco_words(d->out, box->type);
}

/* IN1, IN2 … of an operator; IN of one with a single input. */
static const char *pin_name(struct diagram *d, const struct fbd_box *box, int pin)
{
	const struct fbd_pin *p = &d->graph->pin[pin];
	int number = 0, inputs = 0;

	if (*p->name)
		return p->name;
	if (p->declared && !p->extends)
		return p->declared->name;
	if (p->output)
		return "OUT";
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++) {
		inputs += !d->graph->pin[i].output;
		number += !d->graph->pin[i].output && i <= pin;
	}
	return inputs == 1 ? "IN" : plco_print(d->out, "IN%d", number);
}

static int y_of(const struct diagram *d, int box)
{
	return d->out->y + box * ROW;
}

static int x_of(const struct diagram *d, int box)
{
	return LEFT + d->column[box] * COLUMN;
}

static void put_position(struct out *out, int x, int y)
{
	plco_position(out, x, y);
}

static int put_given(struct diagram *d, int x, int y, const char *expression)
{
	struct out *out = d->out;
	const int id = ++out->ids;

	plco_place(out, id, x + WIDTH, y);
	plco_open(out, "inVariable localId=\"%d\" height=\"%d\" width=\"%d\"", id, PIN, WIDTH);
	put_position(out, x, y);
	plco_line(out, "connectionPointOut");
	plco_text(out, "expression", expression);
	plco_close(out, "inVariable");
	return id;
}

/* ---- inputs ---- */

static struct input find_input(struct diagram *d, int pin, int depth)
{
	const struct fbd_pin *p = &d->graph->pin[pin];
	const int source = fbd_graph_source(d->graph, pin);
	struct input input = { 0, NULL, p->negated, NULL };
	const struct fbd_box *from;

	if (source < 0) {
		if (p->operand)
			input.id = put_given(d, x_of(d, p->box) - WIDTH - PIN, y_of(d, p->box) + PIN, p->operand);
		return input;
	}
	from = box_of(d, source);
	if (from->kind == FBD_TRIGGER && depth < 4) {
		input = find_input(d, from->first_pin, depth + 1);
		if (p->negated || input.edge)
			plco_lost(d->out, REPORT_CHANGED, p->line, d->number, "%s", report_said(d->out->report,
				  REPORTED("the edge is detected at the pin, after the value is inverted")));
		input.edge = *from->type == 'R' ? "rising" : "falling";
		input.negated = input.negated != p->negated;
		return input;
	}
	input.id = d->id[index_of(d, from)];
	input.pin = pin_name(d, from, source);
	if (p->previous && from->kind != FBD_BLOCK && index_of(d, from) < p->box)
		plco_lost(d->out, REPORT_CHANGED, p->line, d->number, "%s", report_said(d->out->report,
			  REPORTED("other tools have no PREVIOUS( ): they use the value of this scan")));
	return input;
}

static void put_connection(struct diagram *d, struct input input)
{
	plco_open(d->out, "connectionPointIn");
	if (input.id)
		plco_connection(d->out, input.id, input.pin);
	plco_close(d->out, "connectionPointIn");
}

static const char *modifiers(struct diagram *d, struct input input)
{
	return plco_print(d->out, "%s%s%s%s", input.negated ? " negated=\"true\"" : "", input.edge ? " edge=\"" : "",
			  input.edge ? input.edge : "", input.edge ? "\"" : "");
}

/* ---- boxes ---- */

/* A box with one input and one output. @enable: NULL: it has no EN. */
static void put_unary(struct diagram *d, const char *name, int height, int x, int y,
		      const struct input *enable, struct input value, int id)
{
	struct out *out = d->out;

	plco_open(out, "block localId=\"%d\" typeName=\"%s\" height=\"%d\" width=\"%d\" executionOrderId=\"%d\"", id,
		  name, height, WIDTH, ++out->order);
	put_position(out, x, y);
	plco_open(out, "inputVariables");
	if (enable) {
		plco_open(out, "variable formalParameter=\"EN\"%s", modifiers(d, *enable));
		put_connection(d, *enable);
		plco_close(out, "variable");
	}
	plco_open(out, "variable formalParameter=\"IN\"%s", modifiers(d, value));
	put_connection(d, value);
	plco_close(out, "variable");
	plco_close(out, "inputVariables");
	plco_line(out, "inOutVariables");
	plco_open(out, "outputVariables");
	plco_output(out, "OUT", false, WIDTH);
	plco_close(out, "outputVariables");
	plco_close(out, "block");
}

/* The EN of a call of an instance; -1: it has none. */
static int enable_of(const struct diagram *d, const struct fbd_box *box)
{
	for (int i = box->first_pin; box->kind == FBD_BLOCK && i < box->first_pin + box->pins; i++)
		if (!d->graph->pin[i].output && !strcmp(d->graph->pin[i].name, "EN") && d->input[i].id)
			return i;
	return -1;
}

static bool is_stored(const struct fbd_pin *pin)
{
	return pin->output && pin->operand;
}

/* What EN reads may be another value when the outputs are stored: a box keeps it, and an edge is found once. */
static void keep_enable(struct diagram *d, int number)
{
	const struct fbd_box *box = &d->graph->box[number];
	const int pin = enable_of(d, box);
	const int x = x_of(d, number) - WIDTH - PIN, y = y_of(d, number);
	bool stored = false;
	int id;

	for (int i = box->first_pin; pin >= 0 && i < box->first_pin + box->pins; i++)
		stored = stored || is_stored(&d->graph->pin[i]);
	if (!stored || (fbd_graph_source(d->graph, pin) >= 0 && !d->graph->pin[pin].previous && !d->input[pin].edge))
		return;
	id = ++d->out->ids;
	plco_place(d->out, id, x + WIDTH, y);
	put_unary(d, "MOVE", 3 * PIN, x, y, NULL, d->input[pin], id);
	d->input[pin] = (struct input){ id, "OUT", false, NULL };
}

/* Other tools store outputs of an instance in any scan: those of a call with EN go through a MOVE
 * with the same EN. */
static struct input enabled(struct diagram *d, int box, int pin)
{
	const struct fbd_box *from = &d->graph->box[box];
	const struct input value = { d->id[box], pin_name(d, from, pin), false, NULL };
	const int enable = enable_of(d, from);
	int id;

	if (enable < 0)
		return value;
	id = ++d->out->ids;
	plco_place(d->out, id, x_of(d, box) + WIDTH + PIN + WIDTH, y_of(d, box) + PIN);
	put_unary(d, "MOVE", 3 * PIN, x_of(d, box) + WIDTH + PIN, y_of(d, box) + PIN, &d->input[enable],
		  value, id);
	return (struct input){ id, "OUT", false, NULL };
}

static void put_stored(struct diagram *d, int box, int pin)
{
	const struct fbd_pin *p = &d->graph->pin[pin];
	const struct input value = enabled(d, box, pin);
	struct out *out = d->out;

	plco_open(out, "outVariable localId=\"%d\" height=\"%d\" width=\"%d\" executionOrderId=\"%d\"", ++out->ids, PIN,
		  WIDTH, ++out->order);
	put_position(out, x_of(d, box) + WIDTH + PIN + (value.id == d->id[box] ? 0 : COLUMN / 2), y_of(d, box) + PIN);
	put_connection(d, value);
	plco_text(out, "expression", p->operand);
	plco_close(out, "outVariable");
}

static void put_pins(struct diagram *d, const struct fbd_box *box)
{
	struct out *out = d->out;
	const bool action = box->pins == 1 && !box->instance && plco_is_action(out, box->type);

	plco_open(out, "inputVariables");
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++) {
		const struct fbd_pin *p = &d->graph->pin[i];

		if (p->output || (p->open && !strcmp(p->name, "EN")))
			continue;
		plco_open(out, "variable formalParameter=\"%s\"%s", pin_name(d, box, i), modifiers(d, d->input[i]));
		put_connection(d, d->input[i]);
		plco_close(out, "variable");
	}
	plco_close(out, "inputVariables");
	plco_line(out, "inOutVariables");
	plco_open(out, "outputVariables");
	for (int i = box->first_pin; i < box->first_pin + box->pins && !action; i++) {
		const struct fbd_pin *p = &d->graph->pin[i];

		if (!p->output || (p->open && !strcmp(p->name, "ENO")))
			continue;
		plco_output(out, pin_name(d, box, i), p->negated, WIDTH);
	}
	plco_close(out, "outputVariables");
}

static void put_box(struct diagram *d, int number)
{
	const struct fbd_box *box = &d->graph->box[number];
	struct out *out = d->out;
	const char *named = box->instance ? plco_print(out, " instanceName=\"%s\"", box->instance) : "";

	keep_enable(d, number);
	plco_open(out, "block localId=\"%d\" typeName=\"%s\"%s height=\"%d\" width=\"%d\" executionOrderId=\"%d\"",
		  d->id[number], function_of(d, box), named, PIN * (box->pins + 1), WIDTH, ++out->order);
	put_position(out, x_of(d, number), y_of(d, number));
	put_pins(d, box);
	plco_close(out, "block");
	for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
		if (is_stored(&d->graph->pin[i]))
			put_stored(d, number, i);
}

static void put_end(struct diagram *d, int number, const char *element, const char *attributes)
{
	const struct fbd_box *box = &d->graph->box[number];
	const struct input input = d->input[box->first_pin];
	struct out *out = d->out;
	const bool leaves = box->kind == FBD_JUMP || box->kind == FBD_RETURN;

	plco_open(out, "%s localId=\"%d\" height=\"%d\" width=\"%d\" executionOrderId=\"%d\"%s%s", element,
		  d->id[number], PIN, WIDTH, ++out->order, attributes, leaves ? "" : modifiers(d, input));
	put_position(out, x_of(d, number), y_of(d, number));
	put_connection(d, input);
	if (!leaves)
		plco_text(out, "expression", box->target);
	plco_close(out, element);
	if (leaves && (input.negated || input.edge))
		plco_lost(out, REPORT_LOST, box->line, d->number, "%s", report_said(out->report,
			  REPORTED("a jump has no negation: what it depends on is not inverted")));
}

/* A jump without a condition, and one with an inverted one, get a box in front of it. */
static void give_condition(struct diagram *d, int number)
{
	const struct fbd_box *box = &d->graph->box[number];
	struct input *input = &d->input[box->first_pin];
	struct out *out = d->out;
	int id;

	if (!input->id)
		input->id = put_given(d, x_of(d, number) - WIDTH - PIN, y_of(d, number), "TRUE");
	if (!input->negated)
		return;
	id = ++out->ids;
	plco_place(out, id, x_of(d, number) - PIN, y_of(d, number));
	input->negated = false;
	put_unary(d, "NOT", 2 * PIN, x_of(d, number) - WIDTH - PIN, y_of(d, number), NULL, *input, id);
	*input = (struct input){ id, "OUT", false, NULL };
}

/* The format has no STOP: it is a box of that name. */
static void put_stop(struct diagram *d, int number)
{
	const struct fbd_box *box = &d->graph->box[number];
	const struct input input = d->input[box->first_pin];
	struct out *out = d->out;

	plco_open(out, "block localId=\"%d\" typeName=\"STOP\" height=\"%d\" width=\"%d\" executionOrderId=\"%d\"",
		  d->id[number], PIN * 2, WIDTH, ++out->order);
	put_position(out, x_of(d, number), y_of(d, number));
	plco_open(out, "inputVariables");
	plco_open(out, "variable formalParameter=\"EN\"%s", modifiers(d, input));
	put_connection(d, input);
	plco_close(out, "variable");
	plco_close(out, "inputVariables");
	plco_line(out, "inOutVariables");
	plco_line(out, "outputVariables");
	plco_close(out, "block");
}

static void put_element(struct diagram *d, int number)
{
	const struct fbd_box *box = &d->graph->box[number];

	switch (box->kind) {
	case FBD_FUNCTION:
	case FBD_BLOCK:
	case FBD_OPERATOR:
	case FBD_VALUE:
		put_box(d, number);
		break;
	case FBD_STORE:
		put_end(d, number, "outVariable", "");
		break;
	case FBD_SET:
	case FBD_RESET:
		put_end(d, number, "outVariable", box->kind == FBD_SET ? " storage=\"set\"" : " storage=\"reset\"");
		break;
	case FBD_JUMP:
	case FBD_RETURN:
		give_condition(d, number);
		put_end(d, number, box->kind == FBD_JUMP ? "jump" : "return", box->kind == FBD_RETURN ? "" :
			plco_print(d->out, " label=\"%s\"", box->target ? box->target : ""));
		break;
	case FBD_STOP:
		give_condition(d, number);
		put_stop(d, number);
		break;
	case FBD_TRIGGER:
		break;
	}
}

/* ---- networks ---- */

static void find_columns(struct diagram *d)
{
	for (int b = 0; b < d->graph->box_count; b++) {
		const struct fbd_box *box = &d->graph->box[b];

		for (int i = box->first_pin; i < box->first_pin + box->pins; i++) {
			const int source = d->graph->pin[i].output ? -1 : fbd_graph_source(d->graph, i);
			const int from = source < 0 ? -1 : d->graph->pin[source].box;

			if (from >= 0 && from < b && d->column[from] + 1 > d->column[b])
				d->column[b] = d->column[from] + 1;
		}
	}
}

static void put_comment(struct out *out, const char *text)
{
	if (!*text)
		return;
	plco_open(out, "comment localId=\"%d\" height=\"40\" width=\"400\"", ++out->ids);
	put_position(out, 40, out->y);
	plco_formatted(out, "content", text);
	plco_close(out, "comment");
	out->y += 60;
}

static void put_label(struct out *out, const struct fbd_network *network)
{
	if (!network->label)
		return;
	plco_open(out, "label localId=\"%d\" label=\"%s\"", ++out->ids, plco_id(out, network->label));
	put_position(out, 40, out->y);
	plco_close(out, "label");
	out->y += 40;
}

static void put_heading(struct diagram *d)
{
	struct out *out = d->out;
	const char *title = plco_id(out, d->network->title);

	put_comment(out, plco_bare(out, plco_id(out, d->network->comment)));
	put_comment(out, title);
	for (int i = 0; i < d->graph->note_count; i++)
		put_comment(out, plco_bare(out, plco_id(out, out->pou->st->item[d->graph->note[i]].text)));
	put_label(out, d->network);
}

static void put_network(struct diagram *d)
{
	const struct fbd_graph *graph = d->graph;

	put_heading(d);
	find_columns(d);
	for (int b = 0; b < graph->box_count; b++) {
		d->id[b] = ++d->out->ids;
		plco_place(d->out, d->id[b], x_of(d, b) + WIDTH, y_of(d, b));
	}
	for (int b = 0; b < graph->box_count; b++) {
		const struct fbd_box *box = &graph->box[b];

		if (box->kind == FBD_TRIGGER)
			continue;
		for (int i = box->first_pin; i < box->first_pin + box->pins; i++)
			if (!graph->pin[i].output)
				d->input[i] = find_input(d, i, 0);
		put_element(d, b);
	}
	d->out->y += (graph->box_count + 1) * ROW;
}

static void put_off(struct out *out, const struct fbd_network *network, int number)
{
	const struct sink before = out->sink;
	struct sink_memory memory;

	sink_memory_init(&memory);
	out->sink = sink_to_memory(&memory);
	text_write_st(out->project, &(struct st){ .item = out->pou->st->item + network->first,
						  .count = network->count }, &out->sink);
	out->sink = before;
	plco_lost(out, REPORT_LOST, network->line, number, "%s", report_said(out->report,
		  REPORTED("the network is OFF and becomes a comment")));
	put_label(out, network);
	put_comment(out, sink_memory_text(&memory));
	sink_memory_free(&memory);
}

static void put_numbered(struct out *out, const struct pou *pou, int number)
{
	struct diagram d = { .out = out, .network = &pou->fbd->network[number], .number = number + 1 };
	struct fbd_graph graph;

	if (d.network->off) {
		put_off(out, d.network, d.number);
		return;
	}
	if (!fbd_graph_make(out->project, pou, number, &graph))
		return;
	d.graph = &graph;
	d.id = arena_alloc(out->arena, sizeof(int) * ((size_t)graph.box_count + 1));
	d.column = arena_alloc(out->arena, sizeof(int) * ((size_t)graph.box_count + 1));
	d.input = arena_alloc(out->arena, sizeof(*d.input) * ((size_t)graph.pin_count + 1));
	if (d.id && d.column && d.input)
		put_network(&d);
	fbd_graph_free(&graph);
}

void plco_networks(struct out *out, const struct pou *pou)
{
	out->order = 0;
	plco_open(out, "FBD");
	for (int i = 0; pou->fbd && i < pou->fbd->count; i++)
		put_numbered(out, pou, i);
	plco_close(out, "FBD");
}
