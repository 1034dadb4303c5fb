/* SPDX-License-Identifier: MIT
 *
 * plcopen_graph - reads the elements of a drawn body and resolves their references.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"
#include "engine/model/convert.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_DEEP = 2000, SAME_ROW = 10, MOST_DIGITS = 18 }; /* elements whose heights differ by less stand in one row */

static const struct { const char *name; enum plc_kind kind; } kinds[] = {
	{ "leftPowerRail", PLC_LEFT }, { "rightPowerRail", PLC_RIGHT }, { "contact", PLC_CONTACT },
	{ "coil", PLC_COIL }, { "block", PLC_BLOCK }, { "inVariable", PLC_IN },
	{ "outVariable", PLC_OUT }, { "inOutVariable", PLC_INOUT }, { "connector", PLC_CONNECTOR },
	{ "continuation", PLC_CONTINUATION }, { "label", PLC_LABEL }, { "jump", PLC_JUMP },
	{ "return", PLC_RETURN }, { "comment", PLC_COMMENT }, { "error", PLC_COMMENT }, { "vendorElement", PLC_COMMENT },
	{ "step", PLC_STEP }, { "macroStep", PLC_MACRO }, { "transition", PLC_TRANSITION },
	{ "jumpStep", PLC_JUMP_STEP }, { "selectionDivergence", PLC_CHOICE },
	{ "selectionConvergence", PLC_CHOICE_END }, { "simultaneousDivergence", PLC_PARALLEL },
	{ "simultaneousConvergence", PLC_PARALLEL_END }, { "actionBlock", PLC_ACTIONS },
};

static enum plc_kind kind_of(const struct xml_node *node)
{
	for (size_t i = 0; i < sizeof(kinds) / sizeof(*kinds); i++)
		if (xml_is(node, kinds[i].name))
			return kinds[i].kind;
	return PLC_OTHER;
}

static enum plc_edge edge_of(struct xml_node *node, const char *name)
{
	const char *value = xml_take(node, name);

	return !value ? PLC_NO_EDGE : !strcmp(value, "rising") ? PLC_RISING :
	       !strcmp(value, "falling") ? PLC_FALLING : PLC_NO_EDGE;
}

static enum plc_storage storage_of(struct xml_node *node, const char *name)
{
	const char *value = xml_take(node, name);

	return !value ? PLC_NO_STORAGE : !strcmp(value, "set") ? PLC_SET :
	       !strcmp(value, "reset") ? PLC_RESET : PLC_NO_STORAGE;
}

static int coordinate(struct xml_node *node, const char *position, const char *axis)
{
	const char *value = xml_value(xml_look(node, position), axis);
	const double number = value ? strtod(value, NULL) : 0;

	return number > -1e8 && number < 1e8 ? (int)number : 0;
}

static struct plc_pin *add_pin(struct plcopen *c, struct plc_graph *graph, struct xml_node *node,
			       const char *name)
{
	struct plc_pin *pin = arena_push(c->arena, &graph->pin, &graph->pins, sizeof(*pin));

	if (pin)
		*pin = (struct plc_pin){ .name = name ? name : "", .node = node };
	return pin;
}

static void read_modifiers(struct plc_pin *pin, struct xml_node *node)
{
	pin->negated = xml_flag(node, "negated");
	pin->edge = edge_of(node, "edge");
	pin->storage = storage_of(node, "storage");
}

/* The variables of a block in one of its lists. */
static int read_variables(struct plcopen *c, struct plc_graph *graph, struct xml_node *list,
			  const char *point)
{
	int count = 0;

	for (struct xml_node *each = list ? list->first : NULL; each; each = each->next) {
		struct xml_node *connection;
		struct plc_pin *pin;

		if (!xml_is(each, "variable"))
			continue;
		each->taken = true;
		connection = xml_child(each, point);
		pin = add_pin(c, graph, connection ? connection : each,
			      xml_take(each, "formalParameter"));
		if (!pin)
			return count;
		read_modifiers(pin, each);
		if (connection && *plc_documentation(c, each))
			xml_look(each, "documentation")->taken = false;
		count++;
	}
	return count;
}

/* CODESYS and TwinCAT: the lines of a box EXECUTE. */
static const char *code_of(struct plcopen *c, struct xml_node *block)
{
	struct xml_node *add = xml_look(block, "addData");

	for (struct xml_node *data = add ? add->first : NULL; data; data = data->next) {
		struct xml_node *code = xml_look(data, "STCode");

		if (!code)
			continue;
		add->taken = true;
		xml_take_all(data);
		return plc_renamed(c, code->text ? code->text : "");
	}
	return NULL;
}

/* What an export here makes of STOP: the format has no element for it. */
static bool is_stop(const struct plcopen *c, const struct plc_graph *graph, const struct plc_element *e)
{
	return plc_same(e->name, "STOP") && !e->instance && !plc_pou(c, e->name) && e->ins == 1 && e->outs == 0 &&
	       plc_same(plc_in(graph, e, 0)->name, "EN");
}

/* CODESYS and TwinCAT name these pins of SR and RS in their own way. */
static void name_latch(const struct plcopen *c, struct plc_graph *graph, const struct plc_element *e)
{
	static const char *const names[][3] = {
		{ "SR", "SET1", "S1" }, { "SR", "RESET", "R" }, { "RS", "SET", "S" }, { "RS", "RESET1", "R1" },
	};

	for (int i = 0; i < e->ins && !plc_pou(c, e->name); i++)
		for (size_t k = 0; k < sizeof(names) / sizeof(*names); k++)
			if (plc_same(e->name, names[k][0]) && plc_same(plc_in(graph, e, i)->name, names[k][1]))
				plc_in(graph, e, i)->name = names[k][2];
}

static void read_block(struct plcopen *c, struct plc_graph *graph, struct plc_element *e)
{
	struct xml_node *in = xml_child(e->node, "inputVariables");
	struct xml_node *both = xml_child(e->node, "inOutVariables");
	struct xml_node *out = xml_child(e->node, "outputVariables");

	e->comment = plc_documentation(c, e->node);
	e->name = xml_take(e->node, "typeName");
	e->name = e->name ? plc_without_library(c, e->name) : "";
	e->code = plc_same(e->name, "EXECUTE") ? code_of(c, e->node) : NULL;
	e->code = e->code ? plc_renamed(c, e->code) : NULL;
	e->instance = xml_take(e->node, "instanceName");
	e->instance = e->instance && *e->instance ? plc_renamed(c, e->instance) : NULL;
	e->first_in = graph->pins;
	e->ins = read_variables(c, graph, in, "connectionPointIn");
	e->ins += read_variables(c, graph, both, "connectionPointIn");
	e->first_out = graph->pins;
	e->outs = read_variables(c, graph, out, "connectionPointOut");
	e->outs += read_variables(c, graph, both, "connectionPointOut");
	name_latch(c, graph, e);
	if (e->code && e->outs == 1) /* CODESYS: Out1 */
		plc_out(graph, e, 0)->name = "ENO";
	if (is_stop(c, graph, e)) {
		e->kind = PLC_STOP;
		e->negated = plc_in(graph, e, 0)->negated;
		e->edge = plc_in(graph, e, 0)->edge;
	}
	for (int i = 0; i < e->outs; i++) {
		struct plc_pin *pin = plc_out(graph, e, i);

		pin->x = e->x + coordinate(pin->node, "relPosition", "x");
		pin->y = e->y + coordinate(pin->node, "relPosition", "y");
	}
}

static void read_points(struct plcopen *c, struct plc_graph *graph, struct plc_element *e)
{
	e->first_in = graph->pins;
	for (struct xml_node *each = e->node->first; each; each = each->next)
		if (xml_is(each, "connectionPointIn")) {
			each->taken = true;
			add_pin(c, graph, each, "");
		}
	e->ins = graph->pins - e->first_in;
	e->first_out = graph->pins;
	for (struct xml_node *each = e->node->first; each; each = each->next)
		if (xml_is(each, "connectionPointOut") || xml_is(each, "connectionPointOutAction")) {
			each->taken = true;
			add_pin(c, graph, each, xml_take(each, "formalParameter"));
		}
	/* A tool may leave out what nobody need say. */
	if (graph->pins == e->first_out && e->kind != PLC_COMMENT)
		add_pin(c, graph, e->node, "");
	e->outs = graph->pins - e->first_out;
}

static const char *text_in(struct plcopen *c, struct plc_element *e, const char *child)
{
	return plc_renamed(c, plc_trim(c, xml_text(c->arena, xml_child(e->node, child), NULL)));
}

static void read_own(struct plcopen *c, struct plc_element *e)
{
	e->comment = e->kind < PLC_STEP ? plc_documentation(c, e->node) : "";
	switch ((int)e->kind) {
	case PLC_CONTACT:
	case PLC_COIL:
		e->name = text_in(c, e, "variable");
		break;
	case PLC_IN:
	case PLC_OUT:
	case PLC_INOUT:
		e->name = text_in(c, e, "expression");
		break;
	case PLC_LABEL:
	case PLC_JUMP:
		e->name = xml_take(e->node, "label");
		if (e->name && plc_same(e->name, "OFF")) /* a heading would take it as its word */
			e->name = "OFF_1";
		break;
	case PLC_COMMENT:
		/* The title of a network in CODESYS is an element of its own. */
		e->name = xml_text(c->arena, xml_child(e->node, xml_is(e->node, "vendorElement") ? "alternativeText" : "content"),
				   NULL);
		break;
	case PLC_JUMP_STEP:
		e->name = xml_take(e->node, "targetName");
		break;
	default:
		e->name = xml_take(e->node, "name");
		break;
	}
	if (!e->name)
		e->name = "";
}

/* What names in the text end with: the number, or that of the element in its body if there is no plain one. */
static const char *id_of(struct plcopen *c, const struct plc_graph *graph, const char *id)
{
	size_t digits = 0;

	while (ascii_digit(id[digits]))
		digits++;
	return digits && digits <= MOST_DIGITS && !id[digits] ? id : plc_print(c, "x%d", graph->elements);
}

static bool add_element(struct plcopen *c, struct plc_graph *graph, struct xml_node *node)
{
	struct plc_element *e = arena_push(c->arena, &graph->element, &graph->elements, sizeof(*e));
	const char *order;

	if (!e)
		return false;
	*e = (struct plc_element){ .kind = kind_of(node), .node = node, .name = "", .id = "", .number = -1 };
	if (e->kind == PLC_OTHER)
		return true;
	node->taken = true;
	e->id = xml_take(node, "localId");
	e->number = e->id && *e->id ? strtoll(e->id, NULL, 10) : -1;
	e->id = id_of(c, graph, e->id ? e->id : "");
	e->x = coordinate(node, "position", "x");
	e->y = coordinate(node, "position", "y");
	order = xml_take(node, "executionOrderId");
	e->order = order ? strtol(order, NULL, 10) : 0;
	e->negated = xml_flag(node, "negated");
	e->edge = edge_of(node, "edge");
	e->storage = storage_of(node, "storage");
	if (e->kind == PLC_BLOCK) {
		read_block(c, graph, e);
		return true;
	}
	read_own(c, e);
	read_points(c, graph, e);
	return true;
}

/* ---- references ---- */

static int compare_numbers(const void *a, const void *b)
{
	const struct plc_number *one = a, *two = b;

	return one->number != two->number ? (one->number < two->number ? -1 : 1) :
	       one->element - two->element;
}

/* How many elements have @number; @first: the first of them in by_number. */
static int find_number(const struct plc_graph *graph, long long number, int *first)
{
	int low = 0, high = graph->elements, count = 0;

	while (low < high) {
		const int mid = low + (high - low) / 2;

		if (graph->by_number[mid].number < number)
			low = mid + 1;
		else
			high = mid;
	}
	*first = low;
	while (low + count < graph->elements &&
	       graph->by_number[low + count].number == number)
		count++;
	return count;
}

static bool told(struct plcopen *c, enum diag_id id, const struct xml_node *node, const char *arg)
{
	const struct diag place = { .id = id, .file = c->file, .line = node->line,
				    .pou = c->pou_name };

	return diag_add(c->diags, place, "%s", arg);
}

/* The output where the last point of a connection lies; the first one if none is there. */
static int output_at(const struct plc_graph *graph, const struct plc_element *e,
		     const struct xml_node *connection)
{
	const struct xml_node *last = NULL;

	for (const struct xml_node *each = connection->first; each; each = each->next)
		if (xml_is(each, "position"))
			last = each;
	for (int i = 0; last && i < e->outs; i++) {
		const struct plc_pin *pin = plc_out(graph, e, i);
		const char *x = xml_value(last, "x"), *y = xml_value(last, "y");

		if (x && y && pin->x == (int)strtod(x, NULL) && pin->y == (int)strtod(y, NULL))
			return i;
	}
	return 0;
}

/* CODESYS: a coil behind a block is connected to an output of its own name, which is the first one. */
static bool is_own_name(const struct xml_node *connection, const char *name)
{
	const struct xml_node *reader = connection->parent ? connection->parent->parent : NULL;
	const struct xml_node *variable = reader && xml_is(reader, "coil") ? xml_look(reader, "variable") : NULL;

	return variable && variable->text && plc_same(variable->text, name);
}

static int output_of(struct plcopen *c, const struct plc_graph *graph, const struct plc_element *e,
		     struct xml_node *connection)
{
	const char *name = xml_take(connection, "formalParameter");

	if (e->kind != PLC_BLOCK || !e->outs)
		return e->outs ? 0 : -1;
	if (!name)
		return output_at(graph, e, connection);
	for (int i = 0; i < e->outs; i++)
		if (!strcmp(plc_out(graph, e, i)->name, name))
			return i;
	for (int i = 0; i < e->outs; i++)
		if (plc_same(plc_out(graph, e, i)->name, name))
			return i;
	if (!*name)
		return output_at(graph, e, connection);
	if ((e->code && e->outs == 1) || is_own_name(connection, name))
		return 0;
	told(c, DIAG_PLCOPEN_NO_PIN, connection, name);
	return -1;
}

static bool read_connection(struct plcopen *c, struct plc_graph *graph, struct plc_pin *pin,
			    struct xml_node *connection)
{
	const char *id = xml_take(connection, "refLocalId");
	int first = 0, count = id && *id ? find_number(graph, strtoll(id, NULL, 10), &first) : 0;
	struct plc_source *source;
	struct plc_element *from;

	connection->taken = true;
	if (!count)
		return told(c, DIAG_PLCOPEN_DANGLING, connection, id ? id : "");
	if (count > 1)
		return told(c, DIAG_PLCOPEN_TWICE, connection, id);
	source = arena_push(c->arena, &graph->source, &graph->sources, sizeof(*source));
	if (!source)
		return false;
	from = &graph->element[graph->by_number[first].element];
	*source = (struct plc_source){ graph->by_number[first].element,
				       output_of(c, graph, from, connection) };
	if (source->output >= 0)
		plc_out(graph, from, source->output)->uses++;
	pin->sources++;
	return true;
}

static bool connect_pin(struct plcopen *c, struct plc_graph *graph, struct plc_pin *pin)
{
	struct xml_node *expression = xml_look(pin->node, "expression");
	bool good = true;

	pin->first = graph->sources;
	for (struct xml_node *each = pin->node->first; each; each = each->next)
		if (xml_is(each, "connection"))
			good = read_connection(c, graph, pin, each) && good;
	if (expression && !pin->sources)
		pin->expression = plc_renamed(c, plc_trim(c, xml_text(c->arena, expression, NULL)));
	return good;
}

static bool connect_all(struct plcopen *c, struct plc_graph *graph)
{
	bool good = true;

	graph->by_number = arena_alloc(c->arena, sizeof(*graph->by_number) * (size_t)graph->elements);
	if (!graph->by_number)
		return false;
	for (int i = 0; i < graph->elements; i++)
		graph->by_number[i] = (struct plc_number){ graph->element[i].number, i };
	qsort(graph->by_number, (size_t)graph->elements, sizeof(*graph->by_number),
	      compare_numbers);
	for (int i = 0; i < graph->elements; i++)
		for (int k = 0; k < graph->element[i].ins; k++)
			good = connect_pin(c, graph, plc_in(graph, &graph->element[i], k)) && good;
	return good;
}

struct plc_pin *plc_condition_pin(struct plcopen *c, struct plc_graph *graph,
				  struct xml_node *condition)
{
	struct xml_node *point = xml_child(condition, "connectionPointIn");
	struct plc_pin *pin;

	/* 1.0: the connections stand in a list of their own. */
	if (!point)
		point = xml_child(condition, "connections");
	if (!point && xml_look(condition, "connection"))
		point = condition;
	pin = point ? add_pin(c, graph, point, "") : NULL;
	return pin && connect_pin(c, graph, pin) ? pin : NULL;
}

struct plc_element *plc_connector(const struct plc_graph *graph,
				  const struct plc_element *continuation)
{
	for (int i = 0; i < graph->elements; i++)
		if (graph->element[i].kind == PLC_CONNECTOR &&
		    plc_same(graph->element[i].name, continuation->name))
			return &graph->element[i];
	return NULL;
}

/* ---- components ---- */

static int root_of(struct plc_graph *graph, int i)
{
	while (graph->element[i].component != i) {
		graph->element[i].component = graph->element[graph->element[i].component].component;
		i = graph->element[i].component;
	}
	return i;
}

static void join(struct plc_graph *graph, int a, int b)
{
	a = root_of(graph, a);
	b = root_of(graph, b);
	graph->element[a > b ? a : b].component = a > b ? b : a;
}

static void find_components(struct plc_graph *graph)
{
	for (int i = 0; i < graph->elements; i++)
		graph->element[i].component = i;
	for (int i = 0; i < graph->elements; i++) {
		const struct plc_element *e = &graph->element[i];

		if (e->kind == PLC_CONTINUATION && plc_connector(graph, e))
			join(graph, i, (int)(plc_connector(graph, e) - graph->element));
		for (int k = 0; k < e->ins; k++) {
			const struct plc_pin *pin = plc_in(graph, e, k);

			for (int s = 0; s < pin->sources; s++) {
				const int from = graph->source[pin->first + s].element;

				/* Rails join nothing. */
				if (graph->element[from].kind != PLC_LEFT && e->kind != PLC_RIGHT)
					join(graph, i, from);
			}
		}
	}
	for (int i = 0; i < graph->elements; i++)
		graph->element[i].component = root_of(graph, i);
}

/* ---- the order ---- */

/* First those with a number, then what writes, then the other blocks. */
static int class_of(const struct plc_element *e)
{
	switch ((int)e->kind) {
	case PLC_BLOCK:
		return e->order > 0 ? 0 : 2;
	case PLC_OUT:
	case PLC_INOUT:
	case PLC_COIL:
	case PLC_JUMP:
	case PLC_RETURN:
	case PLC_STOP:
		return e->order > 0 ? 0 : 1;
	default:
		return -1;
	}
}

struct step_key { int class; long order; int x, y, element; };

static int compare_steps(const void *a, const void *b)
{
	const struct step_key *one = a, *two = b;
	const int down = one->y - two->y, across = one->x - two->x;

	if (one->class != two->class)
		return one->class - two->class;
	if (!one->class && one->order != two->order)
		return one->order < two->order ? -1 : 1;
	if (down <= -SAME_ROW || down >= SAME_ROW)
		return down;
	return across ? across : one->element - two->element;
}

/* Marks the blocks that are called because @e needs them. */
static void call_needed(struct plc_graph *graph, int at, int depth)
{
	const struct plc_element *e = &graph->element[at];

	/* What is longer is refused where it becomes text. */
	for (int i = 0; i < e->ins && depth < MOST_DEEP; i++) {
		const struct plc_pin *pin = plc_in(graph, e, i);

		for (int s = 0; s < pin->sources; s++) {
			const int from = graph->source[pin->first + s].element;
			struct plc_element *source = &graph->element[from];

			if (source->busy || (source->kind == PLC_BLOCK && source->order > 0))
				continue;
			source->busy = true;
			call_needed(graph, from, depth + 1);
		}
	}
	if (e->kind == PLC_CONTINUATION && plc_connector(graph, e) && !plc_connector(graph, e)->busy) {
		plc_connector(graph, e)->busy = true;
		call_needed(graph, (int)(plc_connector(graph, e) - graph->element), depth + 1);
	}
}

/* A block that an output has called does not act again. */
static void drop_called(struct plc_graph *graph)
{
	int kept = 0;

	for (int i = 0; i < graph->steps; i++) {
		const int at = graph->step[i];

		if (graph->element[at].kind == PLC_BLOCK && graph->element[at].busy)
			continue;
		graph->element[at].busy = true;
		call_needed(graph, at, 0);
		graph->step[kept++] = at;
	}
	graph->steps = kept;
}

static bool order_steps(struct plcopen *c, struct plc_graph *graph)
{
	const size_t room = (size_t)graph->elements + 1;
	struct step_key *key = arena_alloc(c->arena, sizeof(*key) * room);

	graph->step = arena_alloc(c->arena, sizeof(int) * room);
	if (!graph->step || !key)
		return false;
	for (int i = 0; i < graph->elements; i++) {
		const struct plc_element *e = &graph->element[i];

		if (class_of(e) >= 0)
			key[graph->steps++] = (struct step_key){ class_of(e), e->order, e->x, e->y, i };
	}
	qsort(key, (size_t)graph->steps, sizeof(*key), compare_steps);
	for (int i = 0; i < graph->steps; i++)
		graph->step[i] = key[i].element;
	drop_called(graph);
	return true;
}

bool plc_graph_read(struct plcopen *c, struct plcopen_pou *pou, struct xml_node *content,
		    struct plc_graph *graph)
{
	*graph = (struct plc_graph){ .pou = pou };
	content->taken = true;
	for (struct xml_node *each = content->first; each; each = each->next)
		if (!add_element(c, graph, each))
			return false;
	if (!connect_all(c, graph))
		return false;
	find_components(graph);
	return order_steps(c, graph);
}

/* ---- words ---- */

const char *plc_without_library(const struct plcopen *c, const char *name)
{
	const char *dot = strrchr(name, '.');
	const enum word word = dot ? word_find(dot + 1, strlen(dot + 1)) : WORD_COUNT;

	return word != WORD_COUNT && word_row(word)->kind == WORD_FB && !plc_pou(c, name) && !plc_pou(c, dot + 1) ?
	       dot + 1 : name;
}

enum word plc_catalog(const struct plcopen *c, const char *type)
{
	const size_t len = strlen(type);
	const enum op op = op_find(type, len);
	const enum word word = op == OP_COUNT ? WORD_COUNT : op_function(op);

	if (plc_pou(c, type))
		return WORD_COUNT;
	/* NOT is an element of a rung, too. */
	return word != WORD_COUNT ? word : word_find(type, len);
}

/* The call of an action has no pins but EN and ENO. */
static bool calls_action(const struct plcopen *c, const struct plc_graph *graph, const struct plc_element *block)
{
	for (int i = 0; i < block->ins; i++)
		if (!plc_same(plc_in(graph, block, i)->name, "EN"))
			return false;
	for (int i = 0; i < block->outs; i++)
		if (!plc_same(plc_out(graph, block, i)->name, "ENO") && plc_out(graph, block, i)->uses)
			return false;
	return !block->instance && plc_has_action(c, graph->pou, block->name);
}

enum plc_word plc_word(const struct plcopen *c, const struct plc_graph *graph, const struct plc_element *block)
{
	const char *type = block->name;
	const struct plcopen_pou *pou = plc_pou(c, type);
	const enum word word = plc_catalog(c, type);
	struct convert_word convert;

	if (block->code)
		return PLC_EXECUTE;
	if (calls_action(c, graph, block))
		return PLC_ACTION;
	if (pou)
		return pou->kind == POU_FUNCTION ? PLC_FUNCTION :
		       pou->kind == POU_BLOCK ? PLC_FUNCTION_BLOCK : PLC_UNKNOWN;
	if (word != WORD_COUNT && word_row(word)->kind == WORD_FB)
		return PLC_FUNCTION_BLOCK;
	if (word != WORD_COUNT && word_row(word)->kind == WORD_FN)
		return PLC_FUNCTION;
	return convert_make(type, strlen(type), &convert) ? PLC_FUNCTION : PLC_UNKNOWN;
}

struct plc_pin *plc_input(const struct plc_graph *graph, const struct plc_element *element,
			  const char *name)
{
	for (int i = 0; i < element->ins; i++)
		if (plc_same(plc_in(graph, element, i)->name, name))
			return plc_in(graph, element, i);
	return NULL;
}

struct plc_pin *plc_output(const struct plc_graph *graph, const struct plc_element *element,
			   const char *name)
{
	for (int i = 0; i < element->outs; i++)
		if (plc_same(plc_out(graph, element, i)->name, name))
			return plc_out(graph, element, i);
	return NULL;
}
