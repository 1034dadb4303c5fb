/* SPDX-License-Identifier: MIT
 *
 * plcopen_ladder - networks of contacts, boxes and coils as rungs.
 *
 * A network becomes a rung if it is series and parallel connections that branch to its outputs,
 * and if no output reads what another one of it writes: a rung reads all before it writes. If it
 * is not, each of its outputs may be a rung of its own. Anything else is no ladder here.
 */
#include "engine/exchange/plcopen/plcopen_graph.h"

#include "engine/base/catalog.h"
#include "engine/base/lex.h"
#include "engine/base/limits.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_EDGES = 400, MOST_NETS = 400, MOST_CODE = 20, RAIL = 0 };

enum piece_kind { PIECE_CELL, PIECE_SERIES, PIECE_PARALLEL };

struct piece {
	enum piece_kind kind;
	const char *text;       /* of a cell                                     */
	struct piece *first, *next;
	int width, height;
	int y;                  /* of its highest element in the drawing         */
};

/* Between two nets. */
struct link { int from, to, step; struct piece *piece; bool gone; };

struct sink_at { int net, step; const char *text; };

struct sketch {
	struct plcopen *c;
	struct plc_graph *graph;
	bool odd;               /* no rung                                       */
	struct link link[MOST_EDGES];
	int links;
	struct sink_at sink[MOST_EDGES];
	int sinks;
	int nets, step;         /* step: of what is met now                  */
	int *net_of;            /* of each output pin: the net that it leads to; 0: none */
	bool *met;              /* of each element: it is in the sketch          */
	bool *absorbed;         /* of each element: a box has it as a parameter */
	int *seen, look;        /* of each element: by which look it was seen    */
	const char *cell[LIMIT_ROWS][LIMIT_COLS];
	bool joined[LIMIT_ROWS + 1][LIMIT_COLS + 1];
	int rows, columns, last_step;
	const struct plc_element *code[MOST_CODE];
	int codes;
};

static struct plc_element *element_of(const struct sketch *s, const struct plc_source *source)
{
	return &s->graph->element[source->element];
}

/* ---- names ---- */

static bool is_operand(const char *text)
{
	struct lex lex;
	enum token_kind kind;
	bool dot = false;
	int depth = 0;

	lex_init(&lex, text, strlen(text));
	kind = lex_next(&lex);
	if (kind == TOKEN_ADDRESS)
		return lex_next(&lex) == TOKEN_END;
	if (kind != TOKEN_NAME || lex_is(&lex, "TRUE") || lex_is(&lex, "FALSE") || lex_is(&lex, "NOT"))
		return false;
	while (lex_next(&lex) != TOKEN_END) {
		const bool name = lex.token.kind == TOKEN_NAME || lex.token.kind == TOKEN_NUMBER;

		depth += lex_is(&lex, "[") - lex_is(&lex, "]");
		if (name ? !depth && !dot : !lex_is(&lex, "[") && !lex_is(&lex, "]") && !lex_is(&lex, "."))
			return false;
		dot = lex_is(&lex, ".");
	}
	return true;
}

static bool is_constant(const char *text)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	lex_next(&lex);
	if (lex_is(&lex, "-"))
		lex_next(&lex);
	if (lex.token.kind != TOKEN_NUMBER && !lex_is(&lex, "TRUE") && !lex_is(&lex, "FALSE") &&
	    !strchr(text, '#'))
		return false;
	return lex_next(&lex) == TOKEN_END;
}

/* Does @text name the variable that @name begins with? */
static bool mentions(const char *text, const char *name)
{
	const size_t base = strcspn(name, ".[");
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	while (lex_next(&lex) != TOKEN_END) {
		const char *dot = memchr(lex.token.text, '.', lex.token.len);
		const size_t len = dot && lex.token.kind == TOKEN_NAME ? (size_t)(dot - lex.token.text) :
				   lex.token.len;

		if (len == base && !strncmp(lex.token.text, name, base))
			return true;
	}
	return false;
}

/* ---- pieces ---- */

static struct piece *cell(struct sketch *s, const char *text)
{
	struct piece *piece = arena_alloc(s->c->arena, sizeof(*piece));

	if (piece)
		*piece = (struct piece){ .text = text, .width = 1, .height = 1, .y = INT_MAX };
	else
		s->odd = true;
	return piece;
}

/* An element with its documentation. */
static struct piece *cell_of(struct sketch *s, const struct plc_element *e, const char *text)
{
	const char *comment = plc_flat(s->c, e->comment);
	struct piece *piece = cell(s, *comment ? plc_print(s->c, "%s (* %s *)", text, comment) : text);

	if (piece)
		piece->y = e->y;
	return piece;
}

/* Parallel parts stand as they do in the drawing. */
static void append(struct piece *whole, struct piece *part)
{
	struct piece **at = &whole->first;

	while (*at && (whole->kind == PIECE_SERIES || (*at)->y <= part->y))
		at = &(*at)->next;
	part->next = *at;
	*at = part;
	whole->y = part->y < whole->y ? part->y : whole->y;
	if (whole->kind == PIECE_SERIES) {
		whole->width += part->width;
		whole->height = part->height > whole->height ? part->height : whole->height;
	} else {
		whole->height += part->height;
		whole->width = part->width > whole->width ? part->width : whole->width;
	}
}

/* Parts of a piece of the same kind become parts of the whole. */
static struct piece *combine(struct sketch *s, enum piece_kind kind, struct piece *a, struct piece *b)
{
	struct piece *whole = a, *part, *next;

	if (!a || !b)
		return NULL;
	if (a->kind != kind) {
		whole = cell(s, NULL);
		if (!whole)
			return NULL;
		*whole = (struct piece){ .kind = kind, .y = INT_MAX };
		append(whole, a);
	}
	if (b->kind != kind) {
		append(whole, b);
		return whole;
	}
	for (part = b->first; part; part = next) {
		next = part->next;
		part->next = NULL;
		append(whole, part);
	}
	return whole;
}

static void add_link(struct sketch *s, int from, int to, struct piece *piece)
{
	if (s->links == MOST_EDGES || !piece) {
		s->odd = true;
		return;
	}
	s->link[s->links++] = (struct link){ from, to, s->step, piece, false };
}

/* ---- nets ---- */

static int net_of_pin(struct sketch *s, const struct plc_pin *pin);
static void meet_box(struct sketch *s, struct plc_element *e);

/* What gives a net its power, behind coils and connectors that only pass it on. */
static const struct plc_pin *passed_on(struct sketch *s, const struct plc_pin *pin)
{
	for (int depth = 0; depth < 50; depth++) {
		struct plc_element *e;

		if (pin->sources != 1)
			return pin;
		e = element_of(s, &s->graph->source[pin->first]);
		if (e->kind == PLC_CONTINUATION)
			e = plc_connector(s->graph, e);
		else if (e->kind != PLC_COIL && e->kind != PLC_CONNECTOR)
			return pin;
		if (!e || !e->ins)
			break;
		pin = plc_in(s->graph, e, 0);
	}
	s->odd = true;
	return pin;
}

static const char *contact_word(struct sketch *s, bool negated, enum plc_edge edge)
{
	if (negated && edge != PLC_NO_EDGE)
		s->odd = true;
	return edge == PLC_RISING ? "P" : edge == PLC_FALLING ? "N" : negated ? "NC" : "NO";
}

/* The output that a source is; -1: it has none. */
static int output_pin(const struct sketch *s, const struct plc_source *source)
{
	return source->output < 0 ? -1 : element_of(s, source)->first_out + source->output;
}

static void meet_contact(struct sketch *s, struct plc_element *e, int to)
{
	int from = RAIL;

	if (e->kind == PLC_CONTACT && e->ins == 1)
		from = net_of_pin(s, plc_in(s->graph, e, 0));
	if (e->kind != PLC_CONTACT && !is_operand(e->name) && *e->name && !e->negated && e->edge == PLC_NO_EDGE) {
		add_link(s, from, to, cell_of(s, e, plc_print(s->c, "[ %s ]", e->name)));
		return;
	}
	if (!is_operand(e->name) || e->storage != PLC_NO_STORAGE)
		s->odd = true;
	add_link(s, from, to, cell_of(s, e, plc_print(s->c, "%s %s", contact_word(s, e->negated, e->edge), e->name)));
}

static void meet_source(struct sketch *s, const struct plc_source *source, int net)
{
	struct plc_element *e = element_of(s, source);
	const int pin = output_pin(s, source);

	if (pin < 0 || (s->net_of[pin] && s->net_of[pin] != net)) {
		s->odd = true;
		return;
	}
	if (s->net_of[pin] == net)
		return;
	s->net_of[pin] = net;
	if (e->kind == PLC_BLOCK)
		meet_box(s, e);
	else if (e->kind == PLC_CONTACT || e->kind == PLC_IN || e->kind == PLC_INOUT)
		meet_contact(s, e, net);
	else
		s->odd = true;
}

/* The net of a pin: all pins with the same sources share it. */
static int net_of_pin(struct sketch *s, const struct plc_pin *pin)
{
	int net = 0;

	pin = passed_on(s, pin);
	if (pin->sources == 0 || s->odd || s->nets >= MOST_NETS) {
		s->odd = true;
		return RAIL;
	}
	for (int i = 0; i < pin->sources; i++) {
		const struct plc_source *source = &s->graph->source[pin->first + i];
		const int out = output_pin(s, source);

		if (element_of(s, source)->kind == PLC_LEFT) {
			s->odd = s->odd || pin->sources > 1;
			return RAIL;
		}
		if (out >= 0 && s->net_of[out] && net && s->net_of[out] != net)
			s->odd = true;
		if (out >= 0 && s->net_of[out])
			net = s->net_of[out];
	}
	/* It is known, or none of its sources is. */
	if (net) {
		for (int i = 0; i < pin->sources; i++) {
			const int out = output_pin(s, &s->graph->source[pin->first + i]);

			if (out < 0 || s->net_of[out] != net)
				s->odd = true;
		}
		for (int i = 0, all = 0; i < s->graph->pins; i++) {
			all += s->net_of[i] == net;
			if (all > pin->sources)
				s->odd = true;
		}
		return net;
	}
	net = ++s->nets;
	for (int i = 0; i < pin->sources; i++)
		meet_source(s, &s->graph->source[pin->first + i], net);
	return net;
}

/* ---- boxes ---- */

static const char *first_bool(struct sketch *s, const struct plc_element *e, bool input)
{
	const struct plcopen_pou *pou = plc_pou(s->c, e->name);
	const enum word word = plc_catalog(s->c, e->name);
	const struct xml_node *interface = pou ? xml_look(pou->node, "interface") : NULL;
	int index;

	for (const struct xml_node *list = interface ? interface->first : NULL; list; list = list->next) {
		if (!xml_is(list, input ? "inputVars" : "outputVars"))
			continue;
		for (const struct xml_node *each = list->first; each; each = each->next)
			if (xml_is(each, "variable") && xml_look(xml_look(each, "type"), "BOOL"))
				return xml_value(each, "name");
	}
	if (pou || word == WORD_COUNT)
		return NULL;
	index = word_first_bool(word_row(word), input ? PIN_IN : PIN_OUT);
	return index < 0 ? NULL : word_pins(word_row(word))[index].name;
}

/* What stands behind PIN:= ; NULL: no operand. */
static const char *parameter(struct sketch *s, const struct plc_pin *pin)
{
	bool negated = pin->negated;
	const struct plc_element *e;
	const char *text = pin->expression;

	if (pin->edge != PLC_NO_EDGE)
		return NULL;
	if (!text) {
		pin = passed_on(s, pin);
		if (pin->sources != 1)
			return NULL;
		e = element_of(s, &s->graph->source[pin->first]);
		if (e->edge != PLC_NO_EDGE)
			return NULL;
		if (e->kind == PLC_LEFT)
			return negated ? "FALSE" : "TRUE";
		if (e->kind == PLC_CONTACT && e->ins == 1) {
			const struct plc_pin *before = passed_on(s, plc_in(s->graph, e, 0));

			if (before->sources != 1 ||
			    element_of(s, &s->graph->source[before->first])->kind != PLC_LEFT)
				return NULL;
		} else if (e->kind != PLC_IN && e->kind != PLC_INOUT) {
			return NULL;
		}
		negated = negated != e->negated;
		text = e->name;
	}
	if (is_constant(text))
		return negated ? NULL : text;
	if (!is_operand(text))
		return NULL;
	return negated ? plc_print(s->c, "/%s", text) : text;
}

/* What an output that is not the box's power is stored in; NULL: not one plain variable. */
static const char *stored_in(struct sketch *s, const struct plc_element *box, int output)
{
	const char *name = NULL;

	for (int i = 0; i < s->graph->steps; i++) {
		const int at = s->graph->step[i];
		const struct plc_element *e = &s->graph->element[at];
		const struct plc_pin *pin = e->ins ? plc_in(s->graph, e, 0) : NULL;

		if (!pin || (e->kind != PLC_OUT && e->kind != PLC_COIL) || pin->sources != 1 ||
		    element_of(s, &s->graph->source[pin->first]) != box ||
		    s->graph->source[pin->first].output != output)
			continue;
		if (name || e->negated || e->edge != PLC_NO_EDGE || e->storage != PLC_NO_STORAGE ||
		    !is_operand(e->name))
			return NULL;
		name = e->name;
		s->absorbed[at] = true;
	}
	return name;
}

static bool is_power_out(struct sketch *s, const struct plc_element *e, const struct plc_pin *pin,
			 bool function, bool enabled)
{
	const enum word word = plc_catalog(s->c, e->name);
	const char *first;

	if (!function) {
		first = first_bool(s, e, false);
		return first && plc_same(first, pin->name);
	}
	if (plc_same(pin->name, "ENO"))
		return word == WORD_COUNT || !word_is_test(word_row(word));
	return !enabled && word != WORD_COUNT && word_is_test(word_row(word));
}

static const char *outputs_of(struct sketch *s, const struct plc_element *e, bool function,
			      bool enabled, const char *text)
{
	for (int i = 0; i < e->outs; i++) {
		const struct plc_pin *pin = plc_out(s->graph, e, i);
		const char *name;

		if (!pin->uses || plc_input(s->graph, e, pin->name))
			continue;
		if (is_power_out(s, e, pin, function, enabled))
			continue;
		name = pin->negated ? NULL : stored_in(s, e, i);
		if (!name) {
			s->odd = true;
			return text;
		}
		text = plc_print(s->c, "%s %s=>%s", text, *pin->name ? pin->name : "OUT", name);
	}
	return text;
}

/* A function's pin that the catalogue does not know by this name. */
static bool knows_pin(struct sketch *s, const struct plc_element *e, const char *name)
{
	const enum word word = plc_catalog(s->c, e->name);

	return plc_pou(s->c, e->name) || (word != WORD_COUNT &&
	       word_pin_find(word_row(word), name, strlen(name)) >= 0);
}

/* The net that the power of a box leads to; a new one if nothing uses it. */
static int out_net(struct sketch *s, const struct plc_element *e)
{
	for (int i = 0; i < e->outs; i++)
		if (s->net_of[e->first_out + i])
			return s->net_of[e->first_out + i];
	return ++s->nets;
}

/* The edge of power. */
static struct piece *edge_cell(struct sketch *s, enum plc_edge edge)
{
	const char *type = edge == PLC_RISING ? "R_TRIG" : "F_TRIG";
	const char *name = plc_make(s->c, s->graph->pou, edge == PLC_RISING ? "Rise" : "Fall", type);

	return cell(s, plc_print(s->c, "%s %s", type, name));
}

/* The one element that leads to a pin without a modifier; NULL: there are several, or none. */
static struct plc_element *only_source(struct sketch *s, const struct plc_pin *pin)
{
	if (pin->negated || pin->edge != PLC_NO_EDGE || pin->sources != 1)
		return NULL;
	return element_of(s, &s->graph->source[pin->first]);
}

/* Something whose value is not that of a branch: an expression, or a comparison at the rail. */
static bool is_test(struct sketch *s, const struct plc_pin *pin)
{
	const struct plc_element *e = only_source(s, pin);
	const enum word word = e && e->kind == PLC_BLOCK ? plc_catalog(s->c, e->name) : WORD_COUNT;

	if (e && e->kind == PLC_IN)
		return !e->negated && e->edge == PLC_NO_EDGE;
	return word != WORD_COUNT && word_row(word)->kind == WORD_FN && word_is_test(word_row(word)) &&
	       !plc_input(s->graph, e, "EN") && plc_out(s->graph, e, s->graph->source[pin->first].output)->uses == 1;
}

/* NOT of power, and AND of power with a test: as an export of this project writes them. */
static bool meet_logic(struct sketch *s, struct plc_element *e)
{
	const bool inverts = plc_same(e->name, "NOT") && e->ins == 1;
	const struct plc_pin *pin;
	int from, to, middle;

	if (plc_pou(s->c, e->name) || e->outs != 1 || plc_out(s->graph, e, 0)->negated ||
	    (!inverts && (!plc_same(e->name, "AND") || e->ins != 2)))
		return false;
	pin = plc_in(s->graph, e, 0);
	if (pin->negated || pin->edge != PLC_NO_EDGE || pin->expression)
		return false;
	to = s->net_of[e->first_out];
	if (inverts) {
		from = net_of_pin(s, pin);
		add_link(s, from, to, cell_of(s, e, "NOT"));
		return true;
	}
	if (!is_test(s, plc_in(s->graph, e, 1)) || is_test(s, pin))
		return false;
	from = net_of_pin(s, pin);
	middle = net_of_pin(s, plc_in(s->graph, e, 1));
	/* The test begins at the rail: it begins at the power instead. */
	for (int i = 0; i < s->links; i++)
		if (s->link[i].to == middle && s->link[i].from == RAIL) {
			s->link[i].from = from;
			s->link[i].to = to;
			return true;
		}
	s->odd = true;
	return true;
}

/* MOVE of an expression is [ Name := expression ]. */
static bool meet_assignment(struct sketch *s, struct plc_element *e)
{
	struct plc_pin *power = plc_input(s->graph, e, "EN"), *in = plc_input(s->graph, e, "IN");
	struct plc_pin *result = plc_output(s->graph, e, "OUT");
	const struct plc_element *given = in ? only_source(s, in) : NULL;
	const char *name;

	if (plc_pou(s->c, e->name) || !plc_same(e->name, "MOVE") || !power || power->negated ||
	    power->edge != PLC_NO_EDGE || !power->sources || !result || result->negated || !given || given->kind != PLC_IN ||
	    given->negated || is_operand(given->name) || is_constant(given->name))
		return false;
	name = stored_in(s, e, (int)(result - &s->graph->pin[e->first_out]));
	if (!name)
		return false;
	add_link(s, net_of_pin(s, power), out_net(s, e), cell_of(s, e, plc_print(s->c, "[ %s := %s ]", name, given->name)));
	return true;
}

static void meet_code(struct sketch *s, struct plc_element *e, const struct plc_pin *power)
{
	const bool wired = power && power->sources;

	s->odd = s->odd || s->codes == MOST_CODE || (wired && (power->negated || power->edge != PLC_NO_EDGE));
	if (s->odd)
		return;
	s->code[s->codes++] = e;
	add_link(s, wired ? net_of_pin(s, power) : RAIL, out_net(s, e), cell_of(s, e, plc_print(s->c, "EXECUTE Box%s", e->id)));
}

static void meet_box(struct sketch *s, struct plc_element *e)
{
	const enum plc_word word = plc_word(s->c, s->graph, e);
	const bool function = word == PLC_FUNCTION;
	struct plc_pin *enabling = plc_input(s->graph, e, "EN"), *power = enabling;
	const int index = (int)(e - s->graph->element);
	const char *text = plc_renamed(s->c, e->name);
	int from = RAIL;
	struct piece *piece;

	if (s->met[index])
		return;
	s->met[index] = true;
	if (word == PLC_EXECUTE) {
		meet_code(s, e, enabling);
		return;
	}
	if (word == PLC_ACTION) {
		s->odd = s->odd || !enabling || !enabling->sources || enabling->negated || enabling->edge != PLC_NO_EDGE;
		if (!s->odd)
			add_link(s, net_of_pin(s, enabling), out_net(s, e),
				 cell_of(s, e, plc_print(s->c, "CALL %s", plc_renamed(s->c, e->name))));
		return;
	}
	if (meet_logic(s, e) || meet_assignment(s, e))
		return;
	if (word == PLC_UNKNOWN || (!function && (!e->instance || !plc_is_name(e->instance) || enabling)) ||
	    (function && enabling && !enabling->sources))
		s->odd = true;
	if (!function && !s->odd) {
		text = plc_print(s->c, "%s %s", plc_renamed(s->c, e->name), e->instance);
		power = first_bool(s, e, true) ? plc_input(s->graph, e, first_bool(s, e, true)) : NULL;
		s->odd = s->odd || !power || (!power->sources && !power->expression);
	}
	if (power && !s->odd) {
		s->odd = power->expression != NULL;
		from = net_of_pin(s, power);
	}
	for (int i = 0; i < e->ins && !s->odd; i++) {
		const struct plc_pin *pin = plc_in(s->graph, e, i);
		const char *value;

		if (pin == power || (!pin->sources && !pin->expression))
			continue;
		value = parameter(s, pin);
		if (!value || !knows_pin(s, e, pin->name))
			s->odd = true;
		else
			text = plc_print(s->c, "%s %s:=%s", text, pin->name, value);
	}
	if (s->odd)
		return;
	text = outputs_of(s, e, function, enabling != NULL, text);
	if (strlen(text) > 200)
		s->odd = true;
	piece = cell_of(s, e, text);
	if (power && power->edge != PLC_NO_EDGE)
		piece = combine(s, PIECE_SERIES, edge_cell(s, power->edge), piece);
	if (power && power->negated)
		piece = combine(s, PIECE_SERIES, cell(s, "NOT"), piece);
	for (int i = 0; i < e->outs; i++)
		if (plc_out(s->graph, e, i)->negated && s->net_of[e->first_out + i])
			piece = combine(s, PIECE_SERIES, piece, cell(s, "NOT"));
	add_link(s, from, out_net(s, e), piece);
}

/* ---- outputs ---- */

static const char *coil_text(struct sketch *s, const struct plc_element *e)
{
	const char *word = "COIL";

	if (e->kind == PLC_JUMP)
		return plc_print(s->c, "JMP %s", e->name);
	if (e->kind == PLC_RETURN || e->kind == PLC_STOP) {
		s->odd = s->odd || e->negated || e->edge != PLC_NO_EDGE;
		return e->kind == PLC_STOP ? "STOP" : "RET";
	}
	if (!is_operand(e->name) || (e->negated + (e->edge != PLC_NO_EDGE) + (e->storage != PLC_NO_STORAGE)) > 1)
		s->odd = true;
	if (e->storage != PLC_NO_STORAGE)
		word = e->storage == PLC_SET ? "S" : "R";
	else if (e->edge != PLC_NO_EDGE)
		word = e->edge == PLC_RISING ? "COILP" : "COILN";
	else if (e->negated)
		word = "COILNOT";
	return *plc_flat(s->c, e->comment) ? plc_print(s->c, "%s %s (* %s *)", word, e->name, plc_flat(s->c, e->comment)) :
	       plc_print(s->c, "%s %s", word, e->name);
}

/* A variable of another type than BOOL, as far as the declaration tells it, has no coil. */
static bool may_be_bool(const struct sketch *s, const struct plc_element *e)
{
	const struct xml_node *variable = plc_find_variable(s->graph->pou, e->name);
	const struct xml_node *type = variable ? xml_look(variable, "type") : NULL;

	return !type || !type->first || xml_is(type->first, "BOOL") || xml_is(type->first, "derived");
}

static void meet_step(struct sketch *s, int step)
{
	struct plc_element *e = &s->graph->element[s->graph->step[step]];

	s->step = step;
	if (e->kind == PLC_BLOCK) {
		if (!s->met[e - s->graph->element])
			meet_box(s, e);
		return;
	}
	if (s->absorbed[e - s->graph->element] || !e->ins)
		return;
	if (!may_be_bool(s, e)) {
		const struct plc_pin *pin = plc_in(s->graph, e, 0);
		struct plc_element *from = pin->sources == 1 ? element_of(s, &s->graph->source[pin->first]) : NULL;

		if (from && from->kind == PLC_BLOCK)
			meet_box(s, from);
		s->odd = s->odd || !s->absorbed[e - s->graph->element];
		return;
	}
	if (s->sinks == MOST_EDGES) {
		s->odd = true;
		return;
	}
	s->sink[s->sinks] = (struct sink_at){ net_of_pin(s, plc_in(s->graph, e, 0)), step, coil_text(s, e) };
	if (!s->absorbed[e - s->graph->element])
		s->sinks++;
}

/* ---- does one read what another one writes? ---- */

static bool cone_reads(struct sketch *s, const struct plc_pin *pin, const char *name, int depth)
{
	if (pin->expression && mentions(pin->expression, name))
		return true;
	for (int i = 0; i < pin->sources && depth < MOST_NETS; i++) {
		const int at = s->graph->source[pin->first + i].element;
		const struct plc_element *e = &s->graph->element[at];

		if (s->seen[at] == s->look)
			continue;
		s->seen[at] = s->look;
		if ((e->kind == PLC_CONTACT || e->kind == PLC_IN || e->kind == PLC_INOUT) &&
		    mentions(e->name, name))
			return true;
		for (int k = 0; k < e->ins; k++)
			if (cone_reads(s, plc_in(s->graph, e, k), name, depth + 1))
				return true;
	}
	return depth >= MOST_NETS;
}

static bool step_reads(struct sketch *s, const struct plc_element *e, const char *name)
{
	s->look++;
	for (int k = 0; k < e->ins; k++)
		if (cone_reads(s, plc_in(s->graph, e, k), name, 0))
			return true;
	return false;
}

/* The box that writes a variable or acts itself; NULL: none. */
static const struct plc_element *box_of(const struct sketch *s, int step)
{
	const int at = s->graph->step[step];
	const struct plc_element *e = &s->graph->element[at];

	if (e->kind == PLC_BLOCK)
		return e;
	return s->absorbed[at] ? element_of(s, &s->graph->source[plc_in(s->graph, e, 0)->first]) : NULL;
}

static bool interferes(struct sketch *s, int first, int count)
{
	for (int i = first; i < first + count; i++) {
		const struct plc_element *e = &s->graph->element[s->graph->step[i]], *box = box_of(s, i);
		const char *name = e->kind == PLC_BLOCK ? e->instance : e->name;

		if (e->kind == PLC_JUMP || e->kind == PLC_RETURN || e->kind == PLC_STOP || !name)
			continue;
		/* What a box writes is written before the coils act, and after what leads to it was read. */
		for (int k = box ? first : i + 1; k < first + count; k++)
			if ((!box || box_of(s, k) != box) &&
			    step_reads(s, &s->graph->element[s->graph->step[k]], name))
				return true;
	}
	return false;
}

/* ---- from nets to rows ---- */

static int count_links(const struct sketch *s, int net, bool into, int *found)
{
	int count = 0;

	for (int i = 0; i < s->links; i++)
		if (!s->link[i].gone && (into ? s->link[i].to : s->link[i].from) == net) {
			*found = i;
			count++;
		}
	return count;
}

static bool has_sink(const struct sketch *s, int net)
{
	for (int i = 0; i < s->sinks; i++)
		if (s->sink[i].net == net)
			return true;
	return false;
}

static bool join_parallel(struct sketch *s)
{
	bool any = false;

	for (int a = 0; a < s->links; a++)
		for (int b = a + 1; b < s->links && !s->link[a].gone; b++) {
			struct link *one = &s->link[a], *two = &s->link[b];

			if (two->gone || one->from != two->from || one->to != two->to)
				continue;
			one->piece = combine(s, PIECE_PARALLEL, one->piece, two->piece);
			two->gone = true;
			any = true;
		}
	return any;
}

static bool join_series(struct sketch *s)
{
	bool any = false;

	for (int net = 1; net <= s->nets; net++) {
		int in = 0, out = 0;

		if (has_sink(s, net) || count_links(s, net, true, &in) != 1 ||
		    count_links(s, net, false, &out) != 1 || in == out)
			continue;
		s->link[in].piece = combine(s, PIECE_SERIES, s->link[in].piece, s->link[out].piece);
		s->link[in].to = s->link[out].to;
		s->link[out].gone = true;
		any = true;
	}
	return any;
}

static void put_cell(struct sketch *s, int row, int column, const char *text)
{
	if (row >= LIMIT_ROWS || column >= LIMIT_COLS || (s->cell[row][column] && text)) {
		s->odd = true;
		return;
	}
	s->cell[row][column] = text;
	s->rows = row >= s->rows ? row + 1 : s->rows;
	s->columns = column >= s->columns ? column + 1 : s->columns;
}

static void join_rows(struct sketch *s, int top, int row, int bar)
{
	/* The left rail joins all rows. */
	for (int i = top + 1; i <= row && bar > 0; i++)
		if (i < LIMIT_ROWS && bar <= LIMIT_COLS)
			s->joined[i][bar] = true;
}

/* Draws a piece with its first row at @row, stretched by wire to @width. */
static void draw(struct sketch *s, const struct piece *piece, int row, int column, int width)
{
	int at = column, top = row;

	if (s->odd)
		return;
	switch (piece->kind) {
	case PIECE_CELL:
		put_cell(s, row, at++, piece->text);
		break;
	case PIECE_SERIES:
		for (const struct piece *part = piece->first; part; part = part->next) {
			draw(s, part, row, at, part->width);
			at += part->width;
		}
		break;
	case PIECE_PARALLEL:
		for (const struct piece *part = piece->first; part; part = part->next) {
			draw(s, part, row, column, width);
			join_rows(s, top, row, column);
			join_rows(s, top, row, column + width);
			row += part->height;
		}
		return;
	}
	for (; at < column + width; at++)
		put_cell(s, row, at, "---");
}

/* All that begins at a net, the output that acts first on top; returns the next free row. */
static int draw_net(struct sketch *s, int net, int row, int column, int depth)
{
	const int top = row;
	int next = -1;

	if (depth > LIMIT_COLS)
		s->odd = true;
	while (!s->odd) {
		int best = -1, sink = -1, step = 1 << 30;

		for (int i = 0; i < s->links; i++)
			if (!s->link[i].gone && s->link[i].from == net && s->link[i].step < step) {
				best = i;
				step = s->link[i].step;
			}
		for (int i = 0; i < s->sinks; i++)
			if (s->sink[i].net == net && s->sink[i].step < step) {
				sink = i;
				step = s->sink[i].step;
			}
		if (best < 0 && sink < 0)
			break;
		row = next < 0 ? row : next;
		if (row != top)
			join_rows(s, top, row, column);
		if (sink >= 0) {
			s->odd = s->odd || s->sink[sink].step < s->last_step;
			s->last_step = s->sink[sink].step;
			/* Marks it: it moves to the last column. */
			put_cell(s, row, column, s->sink[sink].text);
			s->sink[sink].net = -1;
			next = row + 1;
			continue;
		}
		s->link[best].gone = true;
		draw(s, s->link[best].piece, row, column, s->link[best].piece->width);
		next = draw_net(s, s->link[best].to, row, column + s->link[best].piece->width, depth + 1);
		if (next < row + s->link[best].piece->height)
			next = row + s->link[best].piece->height;
	}
	return next < 0 ? row : next;
}

static bool reduce(struct sketch *s)
{
	bool joined = true;

	while (joined && !s->odd) {
		joined = join_parallel(s);
		joined = join_series(s) || joined;
	}
	for (int net = 1; net <= s->nets && !s->odd; net++) {
		int in = 0, out = 0;

		if (count_links(s, net, true, &in) > 1 ||
		    (!count_links(s, net, true, &in) && (count_links(s, net, false, &out) || has_sink(s, net))))
			s->odd = true;
	}
	return !s->odd;
}

/* ---- text ---- */

static bool is_last(const char *text)
{
	static const char *const words[] = { "COIL ", "COILNOT ", "COILP ", "COILN ", "S ", "R ", "JMP " };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (!strncmp(text, words[i], strlen(words[i])))
			return true;
	return !strcmp(text, "RET");
}

/* Outputs stand in the last column. */
static void align_outputs(struct sketch *s)
{
	for (int row = 0; row < s->rows; row++) {
		int column = s->columns;

		while (column > 0 && !s->cell[row][column - 1])
			column--;
		if (!column || column == s->columns || !is_last(s->cell[row][column - 1]))
			continue;
		s->cell[row][s->columns - 1] = s->cell[row][column - 1];
		for (int i = column - 1; i < s->columns - 1; i++)
			s->cell[row][i] = "---";
	}
}

static void put_rows(struct sketch *s, const char *indent)
{
	struct plcopen *c = s->c;

	for (int row = 0; row < s->rows; row++) {
		int last = s->columns;

		while (last > 0 && !s->cell[row][last - 1] && !s->joined[row][last])
			last--;
		plc_put(c, "%s  |", indent);
		for (int column = 0; column < last; column++)
			plc_put(c, " %s %s|", s->cell[row][column] ? s->cell[row][column] : "",
				s->joined[row][column + 1] ? "^" : "");
		plc_put(c, "\n");
	}
}

static void put_code(struct sketch *s, const char *indent)
{
	struct plcopen *c = s->c;

	for (int i = 0; i < s->codes; i++) {
		c->at = s->code[i]->node->line;
		plc_put(c, "%s  EXECUTE Box%s:\n", indent, s->code[i]->id);
		plc_text(c, s->code[i]->code);
		plc_put(c, "\n%s  END_EXECUTE\n", indent);
	}
}

static void put_heading(struct plcopen *c, const struct plc_group *group, const char *indent, bool first)
{
	c->at = group->node->line;
	if (first && *group->comment) {
		plc_put(c, "%s", indent);
		plc_comment(c, group->comment);
		plc_put(c, "\n");
	}
	plc_put(c, "%sRUNG%s", indent, group->missing ? " OFF" : "");
	if (first && group->label)
		plc_put(c, " %s", group->label);
	if (group->missing)
		plc_put(c, " \"%s is not known\"", group->missing);
	plc_put(c, "\n");
	c->count.rungs++;
	c->rungs++;
}

/* The steps @first … as one rung; false: they are none. */
static bool put_rung(struct plcopen *c, struct plc_graph *graph, const struct plc_group *group, int first,
		     int count, const char *indent)
{
	struct sketch *s = calloc(1, sizeof(*s));
	bool good = false;

	if (!s)
		return false;
	s->c = c;
	s->graph = graph;
	s->net_of = calloc((size_t)graph->pins + 1, sizeof(*s->net_of));
	s->met = calloc((size_t)graph->elements + 1, 1);
	s->absorbed = calloc((size_t)graph->elements + 1, 1);
	s->seen = calloc((size_t)graph->elements + 1, sizeof(*s->seen));
	s->odd = !s->net_of || !s->met || !s->absorbed || !s->seen;
	/* A block with a number of its own stands where its output leads: behind outputs and later blocks. */
	for (int i = first; i < first + count && !s->odd; i++)
		if (graph->element[graph->step[i]].kind != PLC_BLOCK)
			meet_step(s, i);
	for (int i = first + count - 1; i >= first && !s->odd; i--)
		if (graph->element[graph->step[i]].kind == PLC_BLOCK)
			meet_step(s, i);
	if (!s->odd && !interferes(s, first, count) && reduce(s)) {
		draw_net(s, RAIL, 0, 0, 0);
		good = !s->odd && s->rows > 0;
	}
	if (good) {
		plc_picture(c, graph, group);
		align_outputs(s);
		put_heading(c, group, indent, first == group->first);
		c->at = graph->element[graph->step[first]].node->line;
		put_rows(s, indent);
		put_code(s, indent);
	}
	free(s->net_of);
	free(s->met);
	free(s->absorbed);
	free(s->seen);
	free(s);
	return good;
}

/* Whether a block stands before two of the steps: it would be called twice. */
static bool shares_block(struct plc_graph *graph, const struct plc_group *group)
{
	for (int i = 0; i < graph->elements; i++)
		if (graph->element[i].kind == PLC_BLOCK &&
		    graph->element[i].component == graph->element[graph->step[group->first]].component)
			return true;
	return false;
}

/* Kept as it is and OFF: a type is not known. */
static void put_unknown(struct plcopen *c, struct plc_graph *graph, const struct plc_group *group,
			const char *indent)
{
	struct plc_lines lines;

	if (!plc_lines_init(&lines, c, graph, false, "    "))
		return;
	plc_picture(c, graph, group);
	put_heading(c, group, indent, true);
	plc_put(c, "%s  | EXECUTE |\n%s  EXECUTE:\n", indent, indent);
	for (int i = 0; i < group->count; i++)
		plc_lines_step(&lines, &graph->element[graph->step[group->first + i]]);
	plc_put(c, "%s  END_EXECUTE\n", indent);
}

static bool put_group(struct plcopen *c, struct plc_graph *graph, const struct plc_group *group,
		      const char *indent)
{
	if (group->missing) {
		put_unknown(c, graph, group, indent);
		return true;
	}
	if (!group->count) {
		put_heading(c, group, indent, true);
		return true;
	}
	if (put_rung(c, graph, group, group->first, group->count, indent))
		return true;
	if (group->count == 1 || shares_block(graph, group))
		return false;
	for (int i = 0; i < group->count; i++)
		if (!put_rung(c, graph, group, group->first + i, 1, indent))
			return false;
	return true;
}

bool plc_ladder(struct plcopen *c, struct plc_graph *graph, const struct plc_groups *groups,
		const char *indent)
{
	struct plc_part before = plc_part_begin(c);
	const int rungs = c->count.rungs, made = c->made.count, own = c->rungs, drawings = c->drawings.count;
	bool good = true;

	for (int i = 0; i < groups->count && good; i++)
		good = put_group(c, graph, &groups->group[i], indent);
	plc_part_swap(c, &before);
	if (good) {
		plc_part_append(c, &before);
		return true;
	}
	sink_memory_free(&before.text);
	c->count.rungs = rungs;
	c->rungs = own;
	c->drawings.count = drawings;
	c->made.count = made;
	return false;
}
