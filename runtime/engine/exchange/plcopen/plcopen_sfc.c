/* SPDX-License-Identifier: MIT
 *
 * plcopen_sfc - charts: what leads from which steps to which, conditions and actions.
 *
 * Blocks that a drawn condition needs are called by an action that stays on, as Beremiz does it.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_DEEP = 60 };

struct steps { const char **name; int count; };

struct chart {
	struct plcopen *c;
	struct plcopen_pou *pou;
	struct plc_graph *graph;
	struct steps *to;       /* of each element that is a transition          */
	const char **condition; /* the same; NULL: none                         */
	bool il;                /* @condition is a list                          */
	int inlines;            /* actions that stand in their step, so far      */
	struct plc_part calls;  /* of blocks that conditions need                */
	const char *compute;    /* the action with them; NULL: there are none    */
	struct plc_part actions; /* that stand in their step                     */
	struct chart *root;     /* of the POU; itself, but in a macro-step       */
};

static void add_step(struct chart *chart, struct steps *steps, const char *name)
{
	const char **added;

	for (int i = 0; i < steps->count; i++)
		if (plc_same(steps->name[i], name))
			return;
	added = arena_push(chart->c->arena, &steps->name, &steps->count, sizeof(*added));
	if (added)
		*added = name;
}

static struct plc_element *source_of(const struct chart *chart, const struct plc_pin *pin, int i)
{
	return &chart->graph->element[chart->graph->source[pin->first + i].element];
}

/* The steps above a transition. */
static void find_from(struct chart *chart, const struct plc_element *e, struct steps *from, int depth)
{
	for (int i = 0; i < e->ins && depth < MOST_DEEP; i++) {
		const struct plc_pin *pin = plc_in(chart->graph, e, i);

		for (int s = 0; s < pin->sources; s++) {
			const struct plc_element *above = source_of(chart, pin, s);

			if (above->kind == PLC_STEP || above->kind == PLC_MACRO)
				add_step(chart, from, above->name);
			else if (above->kind == PLC_CHOICE || above->kind == PLC_PARALLEL_END)
				find_from(chart, above, from, depth + 1);
		}
	}
}

/* Gives @step to the transitions above @e. */
static void find_to(struct chart *chart, const struct plc_element *e, const char *step, int depth)
{
	for (int i = 0; i < e->ins && depth < MOST_DEEP; i++) {
		const struct plc_pin *pin = plc_in(chart->graph, e, i);

		for (int s = 0; s < pin->sources; s++) {
			const struct plc_element *above = source_of(chart, pin, s);

			if (above->kind == PLC_TRANSITION)
				add_step(chart, &chart->to[above - chart->graph->element], step);
			else if (above->kind == PLC_CHOICE_END || above->kind == PLC_PARALLEL)
				find_to(chart, above, step, depth + 1);
		}
	}
}

/* ---- conditions ---- */

/* `:= Start;` and `Name := Start;` are Start. */
static const char *bare_condition(struct plcopen *c, const char *text)
{
	struct lex lex;
	size_t len;

	text = plc_trim(c, text);
	lex_init(&lex, text, strlen(text));
	if (lex_next(&lex) == TOKEN_NAME)
		lex_next(&lex);
	if (lex_is(&lex, ":="))
		text = plc_trim(c, lex.at);
	len = strlen(text);
	while (len && (text[len - 1] == ';' || (unsigned char)text[len - 1] <= ' '))
		len--;
	text = arena_copy(c->arena, text, len);
	return text ? text : "";
}

/* The value of a pin; calls of blocks go to chart->calls. */
static const char *drawn_condition(struct chart *chart, struct plc_graph *graph, struct plc_pin *pin)
{
	struct plcopen *c = chart->c;
	struct plc_part before = plc_part_begin(c);
	struct plc_lines lines;
	const char *value = NULL;

	if (plc_lines_init(&lines, c, graph, false, "  "))
		value = plc_lines_value(&lines, pin);
	plc_part_swap(c, &before);
	if (before.text.len && !chart->root->compute)
		chart->root->compute = plc_print(c, "%s_blocks", chart->pou->name);
	plc_part_swap(c, &chart->root->calls);
	plc_part_append(c, &before);
	plc_part_swap(c, &chart->root->calls);
	return value;
}

/* The coil or the variable with the name of the transition. */
static struct plc_element *result_of(struct plc_graph *graph, const char *name)
{
	struct plc_element *only = NULL;

	for (int i = 0; i < graph->steps; i++) {
		struct plc_element *e = &graph->element[graph->step[i]];

		if (e->kind != PLC_COIL && e->kind != PLC_OUT)
			continue;
		if (plc_same(e->name, name))
			return e;
		only = e;
	}
	return only;
}

static const char *condition_of_body(struct chart *chart, struct xml_node *body, const char *name)
{
	struct plcopen *c = chart->c;
	struct xml_node *element;
	const enum plcopen_language language = plc_language(body, &element);
	struct plc_graph *graph;
	struct plc_element *result;
	const char *text;

	if (!element)
		return NULL;
	body->taken = true;
	element->taken = true;
	if (language == PLCOPEN_ST)
		return bare_condition(c, xml_text(c->arena, element, NULL));
	if (language == PLCOPEN_IL) {
		chart->il = true;
		return plc_trim(c, xml_text(c->arena, element, NULL));
	}
	graph = arena_alloc(c->arena, sizeof(*graph));
	if (!graph || language == PLCOPEN_SFC || !plc_graph_read(c, chart->pou, element, graph))
		return NULL;
	result = result_of(graph, name);
	if (!result || !result->ins)
		return NULL;
	text = drawn_condition(chart, graph, plc_in(graph, result, 0));
	return text && result->negated ? plc_print(c, "NOT (%s)", text) : text;
}

static const char *named_condition(struct chart *chart, const char *name)
{
	struct xml_node *list = xml_child(chart->pou->node, "transitions");

	for (struct xml_node *each = list ? list->first : NULL; each; each = each->next) {
		if (!xml_is(each, "transition") || !xml_value(each, "name") ||
		    !plc_same(xml_value(each, "name"), name))
			continue;
		each->taken = true;
		xml_take(each, "name");
		return condition_of_body(chart, xml_child(each, "body"), name);
	}
	return name;
}

static const char *find_condition(struct chart *chart, struct plc_element *e)
{
	struct xml_node *condition = xml_child(e->node, "condition"), *inner;
	struct plcopen *c = chart->c;
	const char *text = NULL;
	bool negated;

	if (!condition)
		return NULL;
	negated = xml_flag(condition, "negated");
	if ((inner = xml_child(condition, "reference"))) {
		text = xml_take(inner, "name");
		text = text ? named_condition(chart, text) : NULL;
	} else if ((inner = xml_child(condition, "inline"))) {
		xml_take(inner, "name");
		text = condition_of_body(chart, inner, "");
	} else {
		struct plc_pin *pin = plc_condition_pin(c, chart->graph, condition);

		text = pin ? drawn_condition(chart, chart->graph, pin) : NULL;
	}
	/* CODESYS takes a semicolon behind it. */
	for (size_t len = text && !chart->il ? strlen(text) : 0; len && strchr("; \t\r\n", text[len - 1]); len--)
		text = text[len - 1] == ';' ? plc_print(c, "%.*s", (int)(len - 1), text) : text;
	if (text && negated)
		text = chart->il ? plc_print(c, "%s\nNOT", text) : plc_print(c, "NOT (%s)", text);
	return text;
}

static void put_list(struct plcopen *c, const struct steps *steps)
{
	plc_put(c, steps->count > 1 ? "(" : "");
	for (int i = 0; i < steps->count; i++)
		plc_put(c, "%s%s", i ? ", " : "", steps->name[i]);
	plc_put(c, steps->count > 1 ? ")" : "");
}

static void put_transition(struct chart *chart, struct plc_element *e)
{
	struct plcopen *c = chart->c;
	struct steps from = { NULL, 0 }, *to = &chart->to[e - chart->graph->element];
	const char *priority = xml_take(e->node, "priority"), *condition;

	chart->il = false;
	condition = find_condition(chart, e);
	find_from(chart, e, &from, 0);
	c->at = e->node->line;
	if (!from.count || !to->count) {
		plc_report(c, REPORT_LOST, e->node,
			   report_said(c->report, REPORTED("the transition %s leads from no step or to no step and is left out")),
			   condition ? condition : "");
		return;
	}
	if (!condition || !*condition) {
		plc_report(c, REPORT_CHANGED, e->node, "%s",
			   report_said(c->report, REPORTED("the transition has no condition; it gets FALSE")));
		condition = "FALSE";
	}
	plc_comment(c, plc_documentation(c, e->node));
	plc_put(c, "\nTRANSITION");
	if (priority && *priority)
		plc_put(c, " (PRIORITY := %s)", priority);
	plc_put(c, " FROM ");
	put_list(c, &from);
	plc_put(c, " TO ");
	put_list(c, to);
	plc_put(c, chart->il ? ":\n" : " := ");
	plc_text(c, condition);
	c->at = e->node->line;
	plc_put(c, chart->il ? "\nEND_TRANSITION\n" : "; END_TRANSITION\n");
}

/* ---- steps and actions ---- */

static bool is_qualifier(const char *text)
{
	static const char *const known[] = { "N", "S", "R", "L", "D", "P", "P0", "P1", "SD", "DS", "SL" };

	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++)
		if (!strcmp(text, known[i]))
			return true;
	return false;
}

/* An action that calls @name, an action of an instance or behind the chart. */
static const char *calling(struct chart *chart, const struct plc_element *step, const char *name)
{
	struct plcopen *c = chart->c;
	const char *made = plc_print(c, "%s_Inline%d", step->name, ++chart->root->inlines);

	plc_part_swap(c, &chart->root->actions);
	plc_put(c, "\nACTION %s:\n  %s();\nEND_ACTION\n", made, plc_renamed(c, name));
	plc_part_swap(c, &chart->root->actions);
	return made;
}

/* The name of the thing that a line of a step does; NULL: it does nothing. */
static const char *action_name(struct chart *chart, const struct plc_element *step,
			       struct xml_node *action)
{
	struct plcopen *c = chart->c;
	struct xml_node *reference = xml_child(action, "reference"), *body = xml_child(action, "inline");
	const char *name = xml_take(reference, "name");
	struct plc_part before;

	if (reference && name && *name)
		return plc_instance_action(c, chart->pou, name) || plc_is_called(chart->pou, name) ?
		       calling(chart, step, name) : name;
	if (!body)
		return NULL;
	xml_take(body, "name");
	name = plc_print(c, "%s_Inline%d", step->name, ++chart->root->inlines);
	before = plc_part_begin(c);
	plc_put(c, "\nACTION %s:\n", name);
	if (!plc_put_inner(c, chart->pou, body, "  "))
		name = NULL;
	plc_put(c, "END_ACTION\n");
	plc_part_swap(c, &before);
	if (!name) {
		sink_memory_free(&before.text);
		return NULL;
	}
	plc_part_swap(c, &chart->root->actions);
	plc_part_append(c, &before);
	plc_part_swap(c, &chart->root->actions);
	return name;
}

/* ---- what CODESYS does in a step: a main, an entry and an exit action ---- */

static const struct set_action { const char *guid, *qualifier, *end; } set_actions[] = {
	{ "700a583f-b4d4-43e4-8c14-629c7cd3bec8", "N", "active" },
	{ "a6b08bd8-b696-47e3-9cbf-7408b61c9ff8", "P1", "entry" },
	{ "a2621e18-7de3-4ea6-ae6d-89e9e0b7befd", "P0", "exit" },
};

/* These repeat a name, a qualifier or what is drawn, or have this value. */
static bool says_nothing(const struct xml_node *attribute, const char *guid)
{
	static const char *const repeated[] = {
		"38391c6d-6d4a-42f8-8ee7-9f45e5adafa8", "6844a48e-46c2-4cc8-a185-a478f3b99cc0",
		"e174fc0d-80b0-4a9e-a530-ca239c249a50", "23bdaa98-72ec-41f7-817b-9dede5697086",
		"7d894980-aeea-405c-a0f6-e2b26429c58f",
	};
	const char *text = attribute->text ? attribute->text : "";

	for (size_t i = 0; i < sizeof(repeated) / sizeof(*repeated); i++)
		if (!strcmp(guid, repeated[i]))
			return true;
	return !*text || !strcmp(text, "FALSE") || !strcmp(text, "0");
}

static void put_set_action(struct chart *chart, const struct plc_element *step, const struct set_action *set,
			   const char *name, struct plc_part *lines)
{
	struct plcopen *c = chart->c;
	const char *made;

	if (strchr(name, '.') || !plc_has_action(c, chart->pou, name) || plc_is_called(chart->pou, name)) {
		made = plc_print(c, "%s_%s", step->name, set->end);
		plc_part_swap(c, &chart->root->actions);
		plc_put(c, "\nACTION %s:\n  %s();\nEND_ACTION\n", made, plc_renamed(c, name));
		plc_part_swap(c, &chart->root->actions);
		name = made;
	}
	plc_part_swap(c, lines);
	c->at = step->node->line;
	plc_put(c, "  %s(%s);\n", plc_renamed(c, name), set->qualifier);
	plc_part_swap(c, lines);
}

static void put_attributes(struct chart *chart, const struct plc_element *step, struct xml_node *attributes,
			   struct plc_part *lines)
{
	for (struct xml_node *each = attributes->first; each; each = each->next) {
		const char *guid = xml_value(each, "guid"), *name = each->text ? plc_trim(chart->c, each->text) : "";
		bool taken = !guid || says_nothing(each, guid);

		for (size_t i = 0; step && *name && !taken && i < sizeof(set_actions) / sizeof(*set_actions); i++)
			if (!strcmp(guid, set_actions[i].guid)) {
				put_set_action(chart, step, &set_actions[i], name, lines);
				taken = true;
			}
		if (taken)
			xml_take_all(each);
	}
}

/* @step: NULL: of another element. */
static void put_set_actions(struct chart *chart, const struct plc_element *step, struct xml_node *node,
			    struct plc_part *lines)
{
	static const char end[] = "/sfc/element";
	struct xml_node *add = xml_look(node, "addData");

	for (struct xml_node *data = add ? add->first : NULL; data; data = data->next) {
		const char *name = xml_value(data, "name");
		struct xml_node *attributes = xml_look(data, "attributes");

		if (!name || !attributes || strlen(name) < strlen(end) ||
		    strcmp(name + strlen(name) - strlen(end), end) != 0)
			continue;
		add->taken = data->taken = attributes->taken = true;
		xml_take(data, "name");
		xml_take(data, "handleUnknown");
		put_attributes(chart, step, attributes, lines);
	}
}

/* ---- lines of a step ---- */

static void put_action(struct chart *chart, const struct plc_element *step, struct xml_node *action,
		       struct plc_part *lines)
{
	struct plcopen *c = chart->c;
	const char *qualifier = xml_take(action, "qualifier"), *time = xml_take(action, "duration");
	const char *indicator = xml_take(action, "indicator"), *name;
	bool timed;

	action->taken = true;
	xml_child(action, "connectionPointOut"); /* nothing leads on from there */
	put_set_actions(chart, NULL, action, NULL);
	if (!qualifier || !*qualifier)
		qualifier = "N";
	name = action_name(chart, step, action);
	if (!name || !is_qualifier(qualifier)) {
		plc_report(c, REPORT_LOST, action,
			   report_said(c->report, REPORTED("the line %s %s of step %s is left out")), qualifier,
			   name ? name : "", step->name);
		return;
	}
	if (indicator && *indicator)
		plc_report(c, REPORT_LOST, action,
			   report_said(c->report, REPORTED("the indicator %s is left out")), indicator);
	timed = time && *time && strchr("LDS", qualifier[0]) && strcmp(qualifier, "S") != 0;
	plc_part_swap(c, lines);
	c->at = action->line;
	plc_put(c, "  %s(%s%s%s);", name, qualifier, timed ? ", " : "", timed ? time : "");
	plc_comment(c, plc_documentation(c, action));
	plc_put(c, "\n");
	plc_part_swap(c, lines);
}

/* All blocks of actions that are connected with @step. */
static void put_actions(struct chart *chart, const struct plc_element *step, struct plc_part *lines)
{
	for (int i = 0; i < chart->graph->elements; i++) {
		const struct plc_element *e = &chart->graph->element[i];

		if (e->kind != PLC_ACTIONS || !e->ins || !plc_in(chart->graph, e, 0)->sources ||
		    source_of(chart, plc_in(chart->graph, e, 0), 0) != step)
			continue;
		for (struct xml_node *each = e->node->first; each; each = each->next)
			if (xml_is(each, "action"))
				put_action(chart, step, each, lines);
	}
}

static void put_items(struct chart *chart);

static void put_macro(struct chart *chart, struct plc_element *step)
{
	struct plcopen *c = chart->c;
	struct xml_node *body = xml_child(step->node, "body"), *element;
	struct chart inner = { .c = c, .pou = chart->pou, .root = chart->root };
	struct plc_graph *graph = arena_alloc(c->arena, sizeof(*graph));

	if (!graph || !body || plc_language(body, &element) != PLCOPEN_SFC ||
	    !plc_graph_read(c, chart->pou, element, graph))
		return;
	body->taken = true;
	inner.graph = graph;
	put_items(&inner);
}

static void put_step(struct chart *chart, struct plc_element *step)
{
	struct plcopen *c = chart->c;
	const bool initial = xml_flag(step->node, "initialStep");
	struct plc_part lines = plc_part_begin(c);

	plc_part_swap(c, &lines);
	put_set_actions(chart, step, step->node, &lines);
	put_actions(chart, step, &lines);
	c->at = step->node->line;
	plc_put(c, "\n");
	if (*plc_documentation(c, step->node)) {
		plc_comment(c, plc_documentation(c, step->node));
		plc_put(c, "\n");
	}
	plc_put(c, "%sSTEP %s:\n", step->kind == PLC_MACRO ? "MACRO_" : initial ? "INITIAL_" : "",
		step->name);
	plc_part_append(c, &lines);
	if (initial && chart->root == chart && chart->compute)
		plc_put(c, "  %s(S);\n", chart->compute);
	if (step->kind == PLC_MACRO)
		put_macro(chart, step);
	plc_put(c, "END_STEP\n");
	c->count.steps++;
}

static void find_targets(struct chart *chart)
{
	for (int i = 0; i < chart->graph->elements; i++) {
		const struct plc_element *e = &chart->graph->element[i];

		if (e->kind == PLC_STEP || e->kind == PLC_MACRO || e->kind == PLC_JUMP_STEP)
			find_to(chart, e, e->name, 0);
	}
}

struct stand { int x, y, element; };

static int compare_places(const void *a, const void *b)
{
	const struct stand *one = a, *two = b;

	return one->y != two->y ? one->y - two->y : one->x != two->x ? one->x - two->x :
	       one->element - two->element;
}

static void put_transitions(struct chart *chart)
{
	const struct plc_graph *graph = chart->graph;
	struct stand *place = arena_alloc(chart->c->arena, sizeof(*place) * ((size_t)graph->elements + 1));
	int count = 0;

	for (int i = 0; place && i < graph->elements; i++)
		if (graph->element[i].kind == PLC_TRANSITION)
			place[count++] = (struct stand){ graph->element[i].x, graph->element[i].y, i };
	if (!place)
		return;
	qsort(place, (size_t)count, sizeof(*place), compare_places);
	for (int i = 0; i < count; i++)
		put_transition(chart, &graph->element[place[i].element]);
}

/* Conditions come first: they tell whether an action must call blocks. */
static void put_items(struct chart *chart)
{
	struct plcopen *c = chart->c;
	struct plc_part before;

	chart->to = arena_alloc(c->arena, sizeof(*chart->to) * ((size_t)chart->graph->elements + 1));
	if (!chart->to)
		return;
	find_targets(chart);
	for (int i = 0; i < chart->graph->elements; i++)
		if (chart->graph->element[i].kind != PLC_STEP)
			put_set_actions(chart, NULL, chart->graph->element[i].node, NULL);
	before = plc_part_begin(c);
	put_transitions(chart);
	plc_part_swap(c, &before);
	for (int i = 0; i < chart->graph->elements; i++) {
		struct plc_element *e = &chart->graph->element[i];

		if (e->kind == PLC_STEP || e->kind == PLC_MACRO)
			put_step(chart, e);
		else if (e->kind == PLC_COMMENT && *plc_trim(c, e->name)) {
			plc_comment(c, e->name);
			plc_put(c, "\n");
		}
	}
	plc_part_append(c, &before);
}

static bool has_init(const char *text)
{
	static const char flag[] = "SFCInit";
	const size_t size = sizeof(flag) - 1;

	for (size_t left = text ? strlen(text) : 0; left >= size; left--, text++)
		if (ascii_same(text, flag, size))
			return true;
	return false;
}

/* CODESYS declares all flags of its charts at once. One that no body names is no loss. */
void plc_note_init(struct plcopen *c, const struct xml_node *project)
{
	for (const struct xml_node *node = project; node && !c->uses_init; node = xml_next(node)) {
		const struct xml_attribute *each = xml_is(node, "variable") && node->parent &&
			strstr(node->parent->name, "Vars") ? NULL : node->attribute;

		for (; each; each = each->next)
			c->uses_init |= has_init(each->value);
		c->uses_init |= has_init(node->text);
	}
}

/* While SFCReset or SFCInit is TRUE, a chart of CODESYS is in its first step. */
static void put_flags(struct plcopen *c, const struct plcopen_pou *pou)
{
	const struct xml_node *reset = plc_find_variable(pou, "SFCReset"), *init = plc_find_variable(pou, "SFCInit");
	const struct xml_node *flag = reset ? reset : init, *type = flag ? xml_look(flag, "type") : NULL;

	if (!type || !type->first || !xml_is(type->first, "BOOL") || xml_is(flag->parent, "externalVars"))
		return;
	plc_put(c, "  CONTROL(RESET := %s);\n", xml_value(flag, "name"));
	if (reset && init && c->uses_init)
		plc_report(c, REPORT_LOST, init, "%s", report_said(c->report,
			   REPORTED("SFCInit does nothing beside SFCReset")));
}

void plc_chart(struct plcopen *c, struct plcopen_pou *pou)
{
	struct chart chart = { .c = c, .pou = pou };
	struct plc_graph *graph = arena_alloc(c->arena, sizeof(*graph));

	if (!graph || !plc_graph_read(c, pou, pou->body, graph))
		return;
	chart.graph = graph;
	chart.root = &chart;
	put_flags(c, pou);
	put_items(&chart);
	if (chart.compute)
		plc_put(c, "\nACTION %s:\n", chart.compute);
	plc_part_append(c, &chart.calls);
	if (chart.compute)
		plc_put(c, "END_ACTION\n");
	plc_part_append(c, &chart.actions);
	plc_actions(c, pou, false);
}
