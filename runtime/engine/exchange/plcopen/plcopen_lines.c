/* SPDX-License-Identifier: MIT
 *
 * plcopen_lines - a graph as statements, or as lines of a network.
 *
 * What an output needs is computed just before it, in the order of the pins, and once. A power
 * rail is TRUE, contacts in series are AND, connections that meet are OR.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include "engine/base/catalog.h"
#include "engine/base/lex.h"

#include <string.h>

enum { MOST_TEXT = 20000, MOST_DEEP = 500, MOST_WORK = 1000000 };

/* How strongly an expression holds together. */
enum tie { TIE_OR, TIE_AND, TIE_NOT, TIE_ATOM };

struct value { const char *text; enum tie tie; }; /* text NULL: nothing, or a message is there */

static struct value value_of(struct plc_lines *l, const struct plc_pin *pin, int depth);

static const char *tied(struct plc_lines *l, struct value value, enum tie at_least)
{
	return value.tie >= at_least ? value.text : plc_print(l->c, "(%s)", value.text);
}

static bool is_true(struct value value)
{
	return !strcmp(value.text, "TRUE");
}

static struct value both(struct plc_lines *l, struct value a, struct value b)
{
	if (is_true(a))
		return b;
	if (is_true(b))
		return a;
	return (struct value){ plc_print(l->c, "%s AND %s", tied(l, a, TIE_AND), tied(l, b, TIE_AND)),
			       TIE_AND };
}

static struct value either(struct plc_lines *l, struct value a, struct value b)
{
	if (!a.text)
		return b;
	if (is_true(a) || is_true(b))
		return (struct value){ "TRUE", TIE_ATOM };
	return (struct value){ plc_print(l->c, "%s OR %s", a.text, b.text), TIE_OR };
}

static struct value invert(struct plc_lines *l, struct value a)
{
	return (struct value){ plc_print(l->c, "NOT %s", tied(l, a, TIE_ATOM)), TIE_NOT };
}

static void fail(struct plc_lines *l, enum diag_id id, const struct xml_node *node, const char *arg)
{
	const struct diag place = { .id = id, .file = l->c->file, .line = node->line };

	if (!l->failed)
		diag_add(l->c->diags, place, "%s", arg);
	l->failed = true;
}

static void begin_line(struct plc_lines *l, const struct plc_element *e)
{
	l->c->at = e->node->line;
	plc_put(l->c, "%s", l->indent);
}

/* An edge of a value; among statements it is that of a block of its own. */
static struct value trigger(struct plc_lines *l, const struct plc_element *e, enum plc_edge edge,
			    struct value value)
{
	const char *name;

	if (edge == PLC_NO_EDGE || !value.text)
		return value;
	if (l->networks)
		return (struct value){ plc_print(l->c, "%s(%s)", edge == PLC_RISING ? "R_EDGE" : "F_EDGE",
						 value.text), TIE_ATOM };
	name = plc_make(l->c, l->graph->pou, edge == PLC_RISING ? "Rise" : "Fall",
			edge == PLC_RISING ? "R_TRIG" : "F_TRIG");
	begin_line(l, e);
	plc_put(l->c, "%s(CLK := %s);\n", name, value.text);
	return (struct value){ plc_print(l->c, "%s.Q", name), TIE_ATOM };
}

/* The text of a variable or an expression as it stands in a drawing. */
static struct value written(struct plc_lines *l, const char *text)
{
	struct lex lex;
	int tokens = 0;

	lex_init(&lex, text, strlen(text));
	for (; lex_next(&lex) != TOKEN_END; tokens++)
		if (lex_is(&lex, "[") || lex_is(&lex, "]"))
			tokens--;
	if (!*text)
		return (struct value){ NULL, TIE_ATOM };
	return (struct value){ plc_print(l->c, "%s", text),
			       tokens == 1 || strchr(text, '[') ? TIE_ATOM : TIE_OR };
}

static struct value modified(struct plc_lines *l, const struct plc_element *e, bool negated,
			     enum plc_edge edge, struct value value)
{
	if (!value.text)
		return value;
	if (negated)
		value = invert(l, value);
	return trigger(l, e, edge, value);
}

/* ---- blocks ---- */

/* A pin that is both, VAR_IN_OUT. */
static bool is_both(const struct plc_lines *l, const struct plc_element *e, const char *name)
{
	return *name && plc_input(l->graph, e, name) && plc_output(l->graph, e, name);
}

/* AND and the like take any number of inputs, and NOT is an operator: they need no names. */
static bool takes_names(const struct plc_lines *l, const char *type)
{
	const enum word word = plc_catalog(l->c, type);

	return word == WORD_COUNT || (word_row(word)->most_inputs < LIMIT_FN_INPUTS &&
				      op_find(type, strlen(type)) == OP_COUNT);
}

/* The pin has another name in the catalogue, or none: then it is given by its place. */
static bool has_pin(const struct plc_lines *l, const struct plc_element *e, const char *name)
{
	const enum word word = plc_catalog(l->c, e->name);

	if (plc_pou(l->c, e->name))
		return *name != '\0';
	return *name && word != WORD_COUNT &&
	       word_pin_find(word_row(word), name, strlen(name)) >= 0;
}

static bool all_named(const struct plc_lines *l, const struct plc_element *e)
{
	for (int i = 0; i < e->ins; i++) {
		const char *name = plc_in(l->graph, e, i)->name;

		if (!plc_same(name, "EN") && !has_pin(l, e, name))
			return false;
	}
	return true;
}

static const char *arguments(struct plc_lines *l, struct plc_element *e, bool named, int depth)
{
	const char *all = "";

	for (int i = 0; i < e->ins && !l->failed; i++) {
		const struct plc_pin *pin = plc_in(l->graph, e, i);
		struct value value = value_of(l, pin, depth + 1);

		value = modified(l, e, pin->negated, pin->edge, value);
		if (!value.text)
			continue;
		if (named || plc_same(pin->name, "EN"))
			all = plc_print(l->c, "%s%s%s := %s", all, *all ? ", " : "", pin->name, value.text);
		else
			all = plc_print(l->c, "%s%s%s", all, *all ? ", " : "", value.text);
	}
	return all;
}

static const char *new_wire(struct plc_lines *l, const struct plc_element *e, const char *pin)
{
	const char *name = plc_print(l->c, "%s%s_%s", e->name, *pin && !plc_same(pin, "OUT") ? pin : "", e->id);

	return plc_find_variable(l->graph->pou, name) ? plc_print(l->c, "%s_wire", name) : name;
}

static bool is_result(const struct plc_pin *pin)
{
	return !*pin->name || plc_same(pin->name, "OUT");
}

/* The output of a function that is its result: the one without a name, OUT, that of the function's
 * name, or the first but ENO. */
static int result_of(const struct plc_lines *l, const struct plc_element *e)
{
	int first = -1;

	for (int i = 0; i < e->outs; i++) {
		const struct plc_pin *pin = plc_out(l->graph, e, i);

		if (is_result(pin) || plc_same(pin->name, e->name))
			return i;
		if (first < 0 && !plc_same(pin->name, "ENO") && !is_both(l, e, pin->name))
			first = i;
	}
	return first;
}

static int uses_besides(const struct plc_lines *l, const struct plc_element *e, int result)
{
	int uses = 0;

	for (int i = 0; i < e->outs; i++)
		if (i != result)
			uses += plc_out(l->graph, e, i)->uses;
	return uses;
}

static const char *further_outputs(struct plc_lines *l, const struct plc_element *e, int result,
				   const char *all)
{
	for (int i = 0; i < e->outs; i++) {
		struct plc_pin *pin = plc_out(l->graph, e, i);
		const char **wire = &l->wire[e->first_out + i];

		if (i == result || !pin->uses || is_both(l, e, pin->name))
			continue;
		*wire = new_wire(l, e, pin->name);
		all = plc_print(l->c, "%s%s%s => %s", all, *all ? ", " : "", pin->name, *wire);
	}
	return all;
}

/* Whether a further output but ENO is used. */
static bool uses_value(const struct plc_lines *l, const struct plc_element *e)
{
	for (int i = 0; i < e->outs; i++) {
		const struct plc_pin *pin = plc_out(l->graph, e, i);

		if (pin->uses && !plc_same(pin->name, "ENO") && !is_both(l, e, pin->name))
			return true;
	}
	return false;
}

static void call_unknown(struct plc_lines *l, const struct plc_element *e)
{
	if (plc_word(l->c, l->graph, e) == PLC_UNKNOWN)
		l->unknown = true;
}

static void call_block(struct plc_lines *l, struct plc_element *e, int depth)
{
	const char *all;

	l->done[e - l->graph->element] = true;
	call_unknown(l, e);
	all = arguments(l, e, true, depth);
	begin_line(l, e);
	plc_put(l->c, "%s(%s)%s\n", e->instance ? e->instance : plc_renamed(l->c, e->name), all, l->networks ? "" : ";");
}

/* Whether only functions act between a function with a number and the element that needs its
 * value: then it may stand inside of that one. */
static bool may_wait(const struct plc_lines *l, const struct plc_element *e, int result)
{
	const struct plc_graph *graph = l->graph;
	int at = 0;

	if (e->order <= 0)
		return true;
	while (at < graph->steps && &graph->element[graph->step[at]] != e)
		at++;
	for (at++; at < graph->steps; at++) {
		const struct plc_element *user = &graph->element[graph->step[at]];

		for (int i = 0; i < user->ins; i++) {
			const struct plc_pin *pin = plc_in(graph, user, i);

			for (int s = 0; s < pin->sources; s++)
				if (&graph->element[graph->source[pin->first + s].element] == e &&
				    graph->source[pin->first + s].output == result)
					return true;
		}
		if (user->kind != PLC_BLOCK || user->instance)
			return false;
	}
	return false;
}

/* Does a variable take a result with nothing between them? */
static bool is_next(const struct plc_element *e, const struct plc_element *user)
{
	return user->order > 0 ? user->order == e->order + 1 : e->order <= 0;
}

/* The variable that alone takes the result of a function, as it is; NULL: there is none. */
static struct plc_element *only_store(const struct plc_lines *l, const struct plc_element *e, int result)
{
	for (int i = 0; i < l->graph->steps; i++) {
		struct plc_element *user = &l->graph->element[l->graph->step[i]];
		const struct plc_pin *pin = user->ins == 1 ? plc_in(l->graph, user, 0) : NULL;

		if (pin && user->kind == PLC_OUT && pin->sources == 1 && !user->negated &&
		    user->edge == PLC_NO_EDGE && user->storage == PLC_NO_STORAGE && is_next(e, user) &&
		    &l->graph->element[l->graph->source[pin->first].element] == e &&
		    l->graph->source[pin->first].output == result)
			return user;
	}
	return NULL;
}

/* While EN is FALSE the function does not run, and what takes its result keeps its value. */
static bool has_enable(const struct plc_lines *l, const struct plc_element *e)
{
	const struct plc_pin *pin = plc_input(l->graph, e, "EN");

	return pin && (pin->sources || pin->expression);
}

/* Text of the call whose ENO decides whether others take the result. */
static const char *guard(struct plc_lines *l, const struct plc_element *e, const char *all)
{
	for (int i = 0; i < e->outs; i++)
		if (plc_same(plc_out(l->graph, e, i)->name, "ENO") && l->wire[e->first_out + i]) {
			l->guard[e - l->graph->element] = l->wire[e->first_out + i];
			return all;
		}
	l->guard[e - l->graph->element] = new_wire(l, e, "ENO");
	return plc_print(l->c, "%s, ENO => %s", all, l->guard[e - l->graph->element]);
}

/* A function stands in a line of its own if it has several users or several outputs. */
static void call_function(struct plc_lines *l, struct plc_element *e, int depth)
{
	const int result = result_of(l, e);
	const bool more = uses_besides(l, e, result) > 0;
	const bool named = all_named(l, e) && (takes_names(l, e->name) || more || plc_input(l->graph, e, "EN"));
	struct plc_element *user;
	const char *all;

	l->done[e - l->graph->element] = true;
	call_unknown(l, e);
	if (plc_catalog(l->c, e->name) != WORD_COUNT && !more && (result < 0 || !plc_out(l->graph, e, result)->uses)) {
		plc_report(l->c, REPORT_LOST, e->node,
			   report_said(l->c->report, REPORTED("nothing uses the result of %s: it is left out")), e->name);
		return;
	}
	all = arguments(l, e, named, depth);
	l->called[e - l->graph->element] = true;
	if (l->failed)
		return;
	if (more && l->networks)
		all = further_outputs(l, e, result, all);
	user = more && l->networks && result >= 0 && plc_out(l->graph, e, result)->uses == 1 ?
	       only_store(l, e, result) : NULL;
	if (user && !plc_out(l->graph, e, result)->negated) {
		l->done[user - l->graph->element] = true;
		begin_line(l, e);
		plc_put(l->c, "%s := %s(%s)\n", user->name, plc_renamed(l->c, e->name), all);
		return;
	}
	if (result >= 0 && plc_out(l->graph, e, result)->uses <= 1 && !(more && l->networks) &&
	    !l->wire[e->first_out + result] && (!l->networks || may_wait(l, e, result))) {
		l->wire[e->first_out + result] = plc_print(l->c, "%s(%s)", plc_renamed(l->c, e->name), all);
		if (plc_out(l->graph, e, result)->uses)
			return;
	}
	if (!l->networks && result >= 0) {
		l->wire[e->first_out + result] = plc_print(l->c, "%s(%s)", plc_renamed(l->c, e->name), all);
		return;
	}
	if (has_enable(l, e) && ((result >= 0 && plc_out(l->graph, e, result)->uses) || uses_value(l, e)))
		all = guard(l, e, all);
	begin_line(l, e);
	if (result >= 0 && plc_out(l->graph, e, result)->uses) {
		if (!l->wire[e->first_out + result])
			l->wire[e->first_out + result] = new_wire(l, e, "");
		plc_put(l->c, "%s := ", l->wire[e->first_out + result]);
	}
	plc_put(l->c, "%s(%s)%s\n", plc_renamed(l->c, e->name), all, l->networks ? "" : ";");
}

static bool is_function(const struct plc_lines *l, const struct plc_element *e)
{
	const enum plc_word word = plc_word(l->c, l->graph, e);

	return word == PLC_FUNCTION || (word == PLC_UNKNOWN && !e->instance);
}

/* What no pin takes under a condition stands in an action of its own: a network has only calls. Among
 * statements it is one. */
static void call_if(struct plc_lines *l, struct plc_element *e, const char *lines, const char *condition)
{
	struct plcopen *c = l->c;
	const char *name;

	if (!l->networks) {
		begin_line(l, e);
		plc_put(c, "IF %s THEN\n", condition ? condition : "TRUE");
		plc_text(c, lines);
		plc_put(c, "\n%sEND_IF;\n", l->indent);
		return;
	}
	name = plc_make(c, l->graph->pou, "Execute", "BOOL");
	begin_line(l, e);
	plc_put(c, "%s := %s\n", name, condition ? condition : "TRUE");
	begin_line(l, e);
	plc_put(c, "%s_lines()\n", name);
	l->guard[e - l->graph->element] = name;
	plc_part_swap(c, &c->added);
	c->at = e->node->line;
	plc_put(c, "\nACTION %s_lines:\n  IF %s THEN\n", name, name);
	plc_text(c, lines);
	plc_put(c, "\n  END_IF;\nEND_ACTION\n");
	plc_part_swap(c, &c->added);
}

static void call_lines(struct plc_lines *l, struct plc_element *e, enum plc_word word, int depth)
{
	const struct plc_pin *pin = has_enable(l, e) ? plc_input(l->graph, e, "EN") : NULL;
	struct value value = { NULL, TIE_ATOM };

	l->done[e - l->graph->element] = true;
	if (pin)
		value = modified(l, e, pin->negated, pin->edge, value_of(l, pin, depth + 1));
	if (l->failed)
		return;
	if (word == PLC_ACTION && !value.text) {
		begin_line(l, e);
		plc_put(l->c, "%s()%s\n", plc_renamed(l->c, e->name), l->networks ? "" : ";");
	} else if (l->graph->pou->kind == POU_FUNCTION && l->networks) {
		plc_report(l->c, REPORT_LOST, e->node,
			   report_said(l->c->report, REPORTED("a function has no actions: the box %s is left out")), e->name);
	} else {
		call_if(l, e, word == PLC_ACTION ? plc_print(l->c, "    %s();", plc_renamed(l->c, e->name)) : e->code,
			value.text);
	}
}

static void call(struct plc_lines *l, struct plc_element *e, int depth)
{
	const enum plc_word word = plc_word(l->c, l->graph, e);

	if (l->done[e - l->graph->element])
		return;
	if (word == PLC_ACTION || word == PLC_EXECUTE) {
		call_lines(l, e, word, depth);
		return;
	}
	if (is_function(l, e))
		call_function(l, e, depth);
	else
		call_block(l, e, depth);
}

/* The value of the scan before, of a function that is not called yet and must not be now. */
static const char *value_before(struct plc_lines *l, struct plc_element *e, int output)
{
	const char **wire = &l->wire[e->first_out + output];

	if (!l->networks) {
		fail(l, DIAG_PLCOPEN_CIRCLE, e->node, e->name);
		return "";
	}
	if (!*wire)
		*wire = new_wire(l, e, output == result_of(l, e) ? "" : plc_out(l->graph, e, output)->name);
	return plc_print(l->c, "PREVIOUS(%s)", *wire);
}

static struct value output_value(struct plc_lines *l, struct plc_element *e, int output, int depth)
{
	const struct plc_pin *pin = output < 0 ? NULL : plc_out(l->graph, e, output);
	struct value value = { NULL, TIE_ATOM };

	/* A block with a number of its own acts when its number comes. */
	if (!(e->order > 0 && l->networks))
		call(l, e, depth);
	if (!pin || l->failed)
		return value;
	if (is_both(l, e, pin->name))
		return value_of(l, plc_input(l->graph, e, pin->name), depth + 1);
	if (!is_function(l, e) && plc_same(pin->name, "ENO") && l->guard[e - l->graph->element]) {
		value.text = l->guard[e - l->graph->element];
	} else if (!is_function(l, e) && plc_same(pin->name, "ENO")) { /* an instance has run if EN let it */
		value.text = "TRUE";
		value = has_enable(l, e) ? value_of(l, plc_input(l->graph, e, "EN"), depth + 1) : value;
	} else if (!is_function(l, e))
		value.text = plc_print(l->c, "%s.%s", e->instance ? e->instance : plc_renamed(l->c, e->name), pin->name);
	else if (l->called[e - l->graph->element] && l->wire[e->first_out + output])
		value.text = l->wire[e->first_out + output];
	else
		value.text = value_before(l, e, output);
	return modified(l, e, pin->negated, pin->edge, value);
}

/* ---- what leads into a pin ---- */

static struct value element_value(struct plc_lines *l, struct plc_element *e, int output, int depth);

static bool same_sources(const struct plc_lines *l, const struct plc_pin *a, const struct plc_pin *b)
{
	if (a->sources != b->sources)
		return false;
	for (int i = 0; i < a->sources; i++) {
		const struct plc_source *one = &l->graph->source[a->first + i];
		const struct plc_source *two = &l->graph->source[b->first + i];

		if (one->element != two->element || one->output != two->output)
			return false;
	}
	return true;
}

static bool is_contact(const struct plc_element *e)
{
	return e->kind == PLC_CONTACT && e->ins == 1;
}

/* Parallel contacts that begin at one point: (a OR b) AND what leads there. */
static struct value contacts_together(struct plc_lines *l, const struct plc_pin *pin, int at,
				      bool *taken, int depth)
{
	struct plc_element *first = &l->graph->element[l->graph->source[pin->first + at].element];
	struct value all = { NULL, TIE_ATOM }, before;

	before = value_of(l, plc_in(l->graph, first, 0), depth + 1);
	for (int i = at; i < pin->sources && !l->failed; i++) {
		struct plc_element *e = &l->graph->element[l->graph->source[pin->first + i].element];
		struct value own;

		if (!is_contact(e) || !same_sources(l, plc_in(l->graph, e, 0), plc_in(l->graph, first, 0)))
			continue;
		taken[i] = true;
		own = modified(l, e, e->negated, e->edge, written(l, e->name));
		if (own.text)
			all = either(l, all, own);
	}
	if (!before.text && !l->failed) {
		fail(l, DIAG_PLCOPEN_OPEN, first->node, first->name);
		return before;
	}
	return l->failed || !all.text ? all : both(l, before, all);
}

static struct value element_value(struct plc_lines *l, struct plc_element *e, int output, int depth)
{
	struct value none = { NULL, TIE_ATOM };
	struct plc_element *from;

	switch ((int)e->kind) {
	case PLC_LEFT:
		return (struct value){ "TRUE", TIE_ATOM };
	case PLC_IN:
	case PLC_INOUT:
		return modified(l, e, e->negated, e->edge, written(l, e->name));
	case PLC_BLOCK:
		return output_value(l, e, output, depth);
	case PLC_CONTINUATION:
		from = plc_connector(l->graph, e);
		if (from)
			return value_of(l, plc_in(l->graph, from, 0), depth + 1);
		fail(l, DIAG_PLCOPEN_DANGLING, e->node, e->name);
		return none;
	case PLC_COIL:
	case PLC_CONNECTOR:
		return e->ins ? value_of(l, plc_in(l->graph, e, 0), depth + 1) : none;
	default:
		return none;
	}
}

static struct value value_of(struct plc_lines *l, const struct plc_pin *pin, int depth)
{
	struct value all = { NULL, TIE_ATOM };
	bool *taken;

	if (l->failed)
		return all;
	if (pin->expression)
		return written(l, pin->expression);
	if (depth > MOST_DEEP) {
		fail(l, DIAG_PLCOPEN_CIRCLE, pin->node, "");
		return all;
	}
	if (++l->work > MOST_WORK) {
		fail(l, DIAG_PLCOPEN_LONG, pin->node, "");
		return all;
	}
	taken = arena_alloc(l->c->arena, (size_t)pin->sources + 1);
	for (int i = 0; taken && i < pin->sources && !l->failed; i++) {
		const struct plc_source *source = &l->graph->source[pin->first + i];
		struct plc_element *e = &l->graph->element[source->element];
		struct value value;

		if (taken[i])
			continue;
		value = is_contact(e) ? contacts_together(l, pin, i, taken, depth) :
			element_value(l, e, source->output, depth);
		if (value.text)
			all = either(l, all, value);
		if (all.text && strlen(all.text) > MOST_TEXT)
			fail(l, DIAG_PLCOPEN_LONG, pin->node, "");
	}
	return l->failed ? (struct value){ NULL, TIE_ATOM } : all;
}

const char *plc_lines_value(struct plc_lines *l, struct plc_pin *pin)
{
	return value_of(l, pin, 0).text;
}

/* ---- what acts ---- */

/* A variable does not take the result of a function that did not run. */
static struct value guarded(struct plc_lines *l, const struct plc_element *e, struct value value)
{
	const struct plc_pin *pin = plc_in(l->graph, e, 0);
	const struct plc_source *source = &l->graph->source[pin->first];
	const char *ran = pin->sources == 1 ? l->guard[source->element] : NULL;

	if (!ran || !is_function(l, &l->graph->element[source->element]) || e->storage != PLC_NO_STORAGE ||
	    (source->output >= 0 && plc_same(plc_out(l->graph, &l->graph->element[source->element], source->output)->name, "ENO")))
		return value;
	return (struct value){ plc_print(l->c, "MOVE(EN := %s, IN := %s)", ran, value.text), TIE_ATOM };
}

static void store(struct plc_lines *l, struct plc_element *e, struct value value)
{
	const char *target = e->name, *end = l->networks ? "" : ";";

	begin_line(l, e);
	if (e->storage == PLC_NO_STORAGE)
		plc_put(l->c, "%s := %s%s\n", target, value.text, end);
	else if (l->networks)
		plc_put(l->c, "%s %s= %s\n", target, e->storage == PLC_SET ? "S" : "R", value.text);
	else
		plc_put(l->c, "IF %s THEN %s := %s; END_IF;\n", value.text, target,
			e->storage == PLC_SET ? "TRUE" : "FALSE");
}

static void leave(struct plc_lines *l, struct plc_element *e, struct value value)
{
	const char *word = e->kind == PLC_JUMP ? plc_print(l->c, "JMP %s", e->name) :
			   e->kind == PLC_STOP ? "STOP" : "RETURN";

	begin_line(l, e);
	if (is_true(value))
		plc_put(l->c, "%s%s\n", word, l->networks ? "" : ";");
	else if (l->networks)
		plc_put(l->c, "%s IF %s\n", word, value.text);
	else
		plc_put(l->c, "IF %s THEN %s; END_IF;\n", value.text, word);
}

void plc_lines_step(struct plc_lines *l, struct plc_element *e)
{
	struct value value;

	if (*e->comment) {
		begin_line(l, e);
		plc_comment(l->c, e->comment);
		plc_put(l->c, "\n");
	}
	if (e->kind == PLC_BLOCK) {
		call(l, e, 0);
		return;
	}
	value = e->ins ? value_of(l, plc_in(l->graph, e, 0), 0) : (struct value){ NULL, TIE_ATOM };
	/* It stands in the line of the function that it takes its value from. */
	if (l->failed || l->done[e - l->graph->element])
		return;
	if (!value.text) {
		if (e->kind != PLC_INOUT)
			plc_report(l->c, REPORT_LOST, e->node,
				   report_said(l->c->report, REPORTED("nothing leads to \"%s\": it does nothing and is left out")),
				   e->kind == PLC_RETURN ? "RETURN" : e->kind == PLC_STOP ? "STOP" : e->name);
		return;
	}
	value = modified(l, e, e->negated, e->edge, value);
	if (e->kind == PLC_OUT || e->kind == PLC_INOUT)
		value = guarded(l, e, value);
	if (e->kind == PLC_JUMP || e->kind == PLC_RETURN || e->kind == PLC_STOP)
		leave(l, e, value);
	else
		store(l, e, value);
}

bool plc_lines_init(struct plc_lines *lines, struct plcopen *c, struct plc_graph *graph,
		    bool networks, const char *indent)
{
	*lines = (struct plc_lines){ .c = c, .graph = graph, .networks = networks, .indent = indent };
	lines->wire = arena_alloc(c->arena, sizeof(*lines->wire) * ((size_t)graph->pins + 1));
	lines->done = arena_alloc(c->arena, (size_t)graph->elements + 1);
	lines->called = arena_alloc(c->arena, (size_t)graph->elements + 1);
	lines->guard = arena_alloc(c->arena, sizeof(*lines->guard) * ((size_t)graph->elements + 1));
	return lines->wire && lines->done && lines->called && lines->guard;
}
