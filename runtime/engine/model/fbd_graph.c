/* SPDX-License-Identifier: MIT
 *
 * fbd_graph - boxes, pins and wires from the statements of a network; see fbd_graph.h.
 *
 * Statements are read in their order. What a name means that no line above gives is decided at the
 * end: a wire or an output from further down is a feedback.
 */
#include "engine/model/fbd_graph.h"

#include "engine/base/ascii.h"
#include "engine/base/name.h"
#include "engine/model/expr_args.h"
#include "engine/model/fbd.h"
#include "engine/model/st.h"

#include <stdlib.h>
#include <string.h>

/* A token of the statement. */
struct piece {
	const char *text;
	uint32_t len;
	bool word;           /* a name                                           */
};

/* A part of the statement's text, in tokens. */
struct span { int first, last; };

/* The value of an expression. */
struct value {
	int pin;             /* the output that gives it; -1: none               */
	int wire;            /* the named wire that gives it; -1: none           */
	const char *operand; /* NULL: a wire                                     */
	bool negated, previous;
	bool refers;         /* @operand may be a wire or an output further down */
	bool box;            /* it is the output of a box made for it            */
	struct span part;
};

/* An argument of a call. */
struct argument {
	const char *name;    /* ""; by its place                                 */
	size_t len;
	bool output, inverted, empty;
	struct value value;
	int row_pin;         /* index in the row; or one of these:               */
	bool placed;
};
enum { NO_PIN = -4, PIN_EN = EXPR_EN, PIN_ENO = EXPR_ENO, PIN_RESULT = EXPR_OUT };

#define ARGUMENTS (2 * LIMIT_ARGS + 4)

struct call {
	struct argument arg[ARGUMENTS];
	int count;
};

/* A wire that has a name. */
struct definition {
	const char *name;
	uint32_t hash;
	int wire;
};

struct maker {
	const struct project *project;
	const struct pou *pou;
	struct fbd_graph *out;
	struct arena scratch; /* of one statement                                */
	struct arena lasting; /* of the network                                  */
	struct expr *expr;
	struct diag_list *ignored;
	const struct st_item *item;
	int number;          /* of the item                                      */
	const char *text;    /* of it                                            */
	struct piece *piece;
	int pieces;
	struct definition *definition;
	int definitions;
	int order;
	bool *refers;        /* by pin                                           */
	int refers_count;
};

/* ---- texts ---- */

static const char *keep(struct maker *m, const char *text, size_t len)
{
	const char *copy = arena_copy(&m->out->arena, text, len);

	return copy ? copy : "";
}

/* The pieces of a statement's text; the lexer stands at its first token. */
static void split(struct maker *m, struct lex lex)
{
	m->piece = NULL;
	m->pieces = 0;
	for (; lex.token.kind != TOKEN_END; lex_next(&lex)) {
		struct piece *piece = arena_push(&m->scratch, &m->piece, &m->pieces, sizeof(*piece));

		if (!piece)
			return;
		*piece = (struct piece){ lex.token.text, (uint32_t)lex.token.len,
					 lex.token.kind == TOKEN_NAME };
	}
}

static bool is_piece(const struct maker *m, int at, const char *text)
{
	return at >= 0 && at < m->pieces && ascii_is(text, m->piece[at].text, m->piece[at].len);
}

/* The piece that has the byte @text. */
static int piece_at(const struct maker *m, const char *text)
{
	int low = 0, high = m->pieces - 1;

	while (low < high) {
		const int middle = (low + high + 1) / 2;

		if (m->piece[middle].text <= text)
			low = middle;
		else
			high = middle - 1;
	}
	return low;
}

static int closing(const struct maker *m, int open)
{
	int depth = 0;

	for (int i = open; i < m->pieces; i++) {
		depth += is_piece(m, i, "(") || is_piece(m, i, "[");
		depth -= is_piece(m, i, ")") || is_piece(m, i, "]");
		if (depth == 0)
			return i;
	}
	return m->pieces - 1;
}

static bool is_word(const struct maker *m, int at)
{
	static const char *const words[] = { "NOT", "AND", "OR", "XOR", "MOD", "AND_THEN", "OR_ELSE", "IF" };

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (is_piece(m, at, words[i]))
			return true;
	return false;
}

/* Does an operand end there? An operator may follow. */
static bool is_operand(const struct maker *m, int at)
{
	const struct piece *piece = at >= 0 ? &m->piece[at] : NULL;

	if (!piece || is_word(m, at))
		return false;
	return piece->word || is_piece(m, at, ")") || is_piece(m, at, "]") || is_piece(m, at, "^") ||
	       !strchr("(,:=<>+-*/&[", piece->text[0]);
}

/* Does the parenthesis at @open belong to the name before it? AND( ) may be a call, too. */
static bool is_of_call(const struct maker *m, int open)
{
	if (open <= 0 || !m->piece[open - 1].word)
		return false;
	if (is_piece(m, open - 1, "NOT") || is_piece(m, open - 1, "IF"))
		return false;
	return !is_word(m, open - 1) || !is_operand(m, open - 2);
}

/* With the parentheses around it. */
static struct span outer(const struct maker *m, struct span part)
{
	while (is_piece(m, part.first - 1, "(") && is_piece(m, part.last + 1, ")") &&
	       !is_of_call(m, part.first - 1)) {
		part.first--;
		part.last++;
	}
	return part;
}

/* A path with its indices, or a call with its arguments, from its first piece on. */
static struct span path_at(const struct maker *m, const char *text)
{
	const int first = piece_at(m, text);
	int last = first;

	for (;;) {
		if (is_piece(m, last + 1, "[") || (is_piece(m, last + 1, "(") && is_of_call(m, last + 1)))
			last = closing(m, last + 1);
		else if (is_piece(m, last + 1, "."))
			last += 2;
		else if (is_piece(m, last + 1, "^"))
			last++;
		else
			break;
	}
	return (struct span){ first, last < m->pieces ? last : m->pieces - 1 };
}

static const char *part_end(const struct maker *m, struct span part)
{
	return m->piece[part.last].text + m->piece[part.last].len;
}

static const char *part_text(struct maker *m, struct span part)
{
	const char *begin = m->piece[part.first].text;

	return keep(m, begin, (size_t)(part_end(m, part) - begin));
}

static void place(const struct maker *m, struct span part, int *at, int *len, int *line, int *column)
{
	const char *begin = m->piece[part.first].text;

	*at = (int)(begin - m->text);
	*len = (int)(part_end(m, part) - begin);
	st_where(&m->project->names, m->item, begin, line, column);
}

/* ---- boxes, pins, wires ---- */

static struct fbd_box *add_box(struct maker *m, enum fbd_box_kind kind, const char *type, struct span part)
{
	struct fbd_graph *out = m->out;
	struct fbd_box *box = arena_push(&out->arena, &out->box, &out->box_count, sizeof(*box));

	if (!box)
		return NULL;
	*box = (struct fbd_box){ .kind = kind, .type = type, .item = m->number,
				 .first_pin = out->pin_count };
	if (kind < FBD_VALUE)
		box->order = ++m->order;
	place(m, part, &box->at, &box->len, &box->line, &box->column);
	return box;
}

/* A pin of the last box. Its index; -1: no memory. */
static int add_pin(struct maker *m, const char *name, const struct word_pin *declared, bool output)
{
	struct fbd_graph *out = m->out;
	struct fbd_box *box = &out->box[out->box_count - 1];
	struct fbd_pin *pin = arena_push(&out->arena, &out->pin, &out->pin_count, sizeof(*pin));
	bool *refers = arena_push(&m->lasting, &m->refers, &m->refers_count, sizeof(*refers));

	if (!pin || !refers)
		return -1;
	*refers = false;
	*pin = (struct fbd_pin){ .name = name, .declared = declared, .output = output, .open = true,
				 .box = out->box_count - 1, .wire = -1, .line = box->line,
				 .column = box->column };
	box->pins++;
	return out->pin_count - 1;
}

static int add_wire(struct maker *m, int pin, const char *name)
{
	struct fbd_graph *out = m->out;
	struct fbd_wire *wire = arena_push(&out->arena, &out->wire, &out->wire_count, sizeof(*wire));

	if (!wire)
		return -1;
	*wire = (struct fbd_wire){ .name = name, .from_pin = pin, .item = name ? m->number : -1 };
	if (out->pin[pin].wire < 0)
		out->pin[pin].wire = out->wire_count - 1;
	out->pin[pin].open = false;
	return out->wire_count - 1;
}

/* The wire from output @pin that a value takes. */
static int wire_of(struct maker *m, int pin)
{
	return m->out->pin[pin].wire >= 0 ? m->out->pin[pin].wire : add_wire(m, pin, NULL);
}

/* Gives the wire from output @pin a name; a second name is a second wire. */
static void define(struct maker *m, int pin, const char *name)
{
	struct fbd_graph *out = m->out;
	const int first = out->pin[pin].wire;
	struct definition *new = arena_push(&m->lasting, &m->definition, &m->definitions, sizeof(*new));

	if (!new)
		return;
	*new = (struct definition){ .name = name, .hash = name_hash(name, strlen(name)), .wire = first };
	if (first < 0 || out->wire[first].name) {
		new->wire = add_wire(m, pin, name);
	} else {
		out->wire[first].name = name;
		out->wire[first].item = m->number;
	}
}

/* Connects input @pin with a value. */
static void connect(struct maker *m, int pin, const struct value *value)
{
	struct fbd_pin *p;

	if (pin < 0 || m->out->arena.failed)
		return;
	p = &m->out->pin[pin];
	p->open = false;
	p->negated = value->negated;
	p->previous = value->previous;
	p->operand = value->operand;
	m->refers[pin] = value->refers;
	place(m, value->part, &p->at, &p->len, &p->line, &p->column);
	if (value->wire >= 0)
		p->wire = value->wire;
	else if (value->pin >= 0) {
		const int wire = wire_of(m, value->pin);

		m->out->pin[pin].wire = wire;
	}
}

/* ---- names ---- */

static const struct definition *find_definition(const struct maker *m, const char *name, size_t len)
{
	const uint32_t hash = name_hash(name, len);

	for (int i = m->definitions - 1; i >= 0; i--)
		if (m->definition[i].hash == hash && name_is(m->definition[i].name, name, len))
			return &m->definition[i];
	return NULL;
}

/* The pin of `Delay.Q` among the boxes from @from towards @to; -1: none. */
static int find_output(const struct fbd_graph *out, const char *text, size_t len, int from, int to)
{
	size_t dot = len;

	while (dot > 0 && text[dot - 1] != '.')
		dot--;
	if (dot < 2)
		return -1;
	for (int i = from; i != to; i += from < to ? 1 : -1) {
		const struct fbd_box *box = &out->box[i];

		if (box->kind != FBD_BLOCK || !box->instance || !name_is(box->instance, text, dot - 1))
			continue;
		for (int k = box->first_pin; k < box->first_pin + box->pins; k++)
			if (out->pin[k].output && name_is(out->pin[k].name, text + dot, len - dot))
				return k;
	}
	return -1;
}

/* What a name gives by a line above; else it stays an operand. */
static struct value name_value(struct maker *m, struct span part, bool previous)
{
	struct value value = { .pin = -1, .wire = -1, .operand = part_text(m, part),
			       .previous = previous, .refers = true, .part = part };
	const size_t len = strlen(value.operand);
	const struct definition *definition;

	if (previous) /* the last line that gives it decides */
		return value;
	definition = find_definition(m, value.operand, len);
	if (definition)
		value.wire = definition->wire;
	else
		value.pin = find_output(m->out, value.operand, len, m->out->box_count - 1, -1);
	if (value.wire >= 0 || value.pin >= 0) {
		value.operand = NULL;
		value.refers = false;
	}
	if (value.pin >= 0) /* behind a circle is the inverse of what the name means */
		value.negated = m->out->pin[value.pin].negated;
	return value;
}

static const struct var *find_in(const struct var_table *vars, uint32_t fold)
{
	const int index = fold ? vars_find(vars, fold) : -1;

	return index < 0 ? NULL : &vars->var[index];
}

/* The declaration of a name; NULL: there is none. */
static const struct var *find_variable(const struct maker *m, const char *text, size_t len)
{
	const struct project *project = m->project;
	const uint32_t fold = names_find_any(&project->names, text, len);
	const int owner = pou_owner(project, m->pou);
	const struct var *var = find_in(&m->pou->vars, fold);

	if (!var && owner >= 0)
		var = find_in(&project->pou[owner].vars, fold);
	if (!var)
		var = find_in(&m->pou->external, fold);
	return var ? var : find_in(&project->globals, fold);
}

/* Is a target a wire: a plain name that is declared nowhere? */
static bool is_wire(const struct maker *m, struct span part)
{
	const struct piece *piece = &m->piece[part.first];
	struct iec_addr addr;

	if (part.first != part.last || !piece->word || memchr(piece->text, '.', piece->len))
		return false;
	if (find_variable(m, piece->text, piece->len))
		return false;
	for (int i = 0; i < SYS_COUNT; i++)
		if (name_is(sys_row((enum sys_id)i)->name, piece->text, piece->len))
			return false;
	return iec_addr_parse(piece->text, piece->len, &addr) == ADDR_NONE;
}

/* The word of the member with this name; WORD_COUNT: none. */
static enum word member_word(const struct word_row *row, const char *text, size_t len)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].name && name_is(row->pin[i].name, text, len))
			return row->pin[i].type == IEC_NONE ? (enum word)row->pin[i].word : WORD_COUNT;
	return WORD_COUNT;
}

/* The block of the instance that @text names: Delay, Motor[3].Delay. NULL: it is none. */
static const struct word_row *instance_row(const struct maker *m, const char *text, size_t len)
{
	const size_t head = strcspn(text, ".[ ^");
	const struct var *var = find_variable(m, text, head < len ? head : len);
	const struct word_row *row;
	size_t at = head;

	if (!var || var->type != IEC_NONE)
		return NULL;
	row = words_row(&m->out->words, var->fb);
	while (at < len) {
		size_t name;

		at += strcspn(text + at, ".");
		at += at < len;
		name = strcspn(text + at, ".[ ^");
		if (name && at < len)
			row = words_row(&m->out->words, member_word(row, text + at, name));
		at += name;
	}
	return row->kind == WORD_FB ? row : NULL;
}

/* ---- calls ---- */

static bool is_function(const struct word_row *row)
{
	return row && row->kind == WORD_FN;
}

static bool takes(const struct word_row *row, int index)
{
	return (is_function(row) && row->most_inputs) || pin_is_given(&row->pin[index]);
}

/* IN3 of GT too, which has two pins. */
static int input_named(const struct word_row *row, const struct argument *arg)
{
	const int pin = word_pin_find(row, arg->name, arg->len);

	if (pin >= 0 || !is_function(row) || !row->most_inputs || arg->len < 3 || arg->len > 4 ||
	    !ascii_same(arg->name, "IN", 2))
		return pin < 0 ? NO_PIN : pin;
	for (int i = 1; i <= LIMIT_FN_INPUTS; i++) {
		char name[8];

		expr_pin_name(row, row->pin_count - 1 + i - word_last_number(row), name, sizeof(name));
		if (i > word_last_number(row) && name_is(name, arg->name, arg->len))
			return row->pin_count - 1 + i - word_last_number(row);
	}
	return NO_PIN;
}

/* The input for the argument behind that of pin @last; a block has outputs behind its inputs. */
static int next_place(const struct word_row *row, int last)
{
	const int most = !is_function(row) || !row->most_inputs ? row->pin_count :
			 row->most_inputs > LIMIT_FN_INPUTS ? row->most_inputs : LIMIT_FN_INPUTS;

	for (int i = last + 1; i < most; i++)
		if (i >= row->pin_count || takes(row, i))
			return i;
	for (int i = last < 0 ? 0 : last + 1; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_OUT)
			return i;
	return NO_PIN;
}

/* Which pin of the row each argument belongs to. */
static void match(const struct word_row *row, struct call *call)
{
	int last = -1;

	for (int i = 0; i < call->count; i++) {
		struct argument *arg = &call->arg[i];

		arg->row_pin = NO_PIN;
		if (!row || (row->kind != WORD_FN && row->kind != WORD_FB))
			continue;
		if (!arg->len)
			arg->row_pin = last = next_place(row, last == NO_PIN ? row->pin_count : last);
		else if (arg->output)
			arg->row_pin = word_pin_find(row, arg->name, arg->len);
		else
			arg->row_pin = input_named(row, arg);
		if (arg->row_pin >= 0 || !arg->len)
			continue;
		arg->row_pin = NO_PIN;
		if (ascii_is("EN", arg->name, arg->len) && !arg->output)
			arg->row_pin = PIN_EN;
		else if (ascii_is("ENO", arg->name, arg->len) && arg->output)
			arg->row_pin = PIN_ENO;
		else if (ascii_is("OUT", arg->name, arg->len) && arg->output)
			arg->row_pin = PIN_RESULT;
	}
}

/* The value behind `=>`: a wire gets its name, a variable stands at the pin. */
static void give(struct maker *m, int pin, const struct argument *arg)
{
	struct fbd_pin *p = &m->out->pin[pin];

	place(m, arg->value.part, &p->at, &p->len, &p->line, &p->column);
	p->negated = arg->inverted;
	if (is_wire(m, arg->value.part)) {
		define(m, pin, part_text(m, arg->value.part));
		return;
	}
	p->operand = part_text(m, arg->value.part);
	p->open = false;
}

/* Adds a pin with its argument, if there is one. */
static int put_pin(struct maker *m, struct call *call, const char *name, const struct word_pin *declared,
		   bool output, int row_pin)
{
	const int pin = add_pin(m, name, declared, output);

	for (int i = 0; i < call->count && pin >= 0; i++) {
		struct argument *arg = &call->arg[i];

		if (arg->placed || arg->row_pin != row_pin || (row_pin == NO_PIN && arg->name != name))
			continue;
		arg->placed = true;
		if (arg->empty)
			continue;
		if (output)
			give(m, pin, arg);
		else
			connect(m, pin, &arg->value);
	}
	return pin;
}

static bool has_enable(const struct call *call)
{
	for (int i = 0; i < call->count; i++)
		if (call->arg[i].row_pin == PIN_EN || call->arg[i].row_pin == PIN_ENO)
			return true;
	return false;
}

/* Those that the row does not have are mistakes; they are shown as they are written. */
static void put_others(struct maker *m, struct call *call, bool output)
{
	for (int i = 0; i < call->count; i++) {
		struct argument *arg = &call->arg[i];

		if (arg->placed || arg->row_pin != NO_PIN || arg->output != output)
			continue;
		arg->name = keep(m, arg->name, arg->len);
		put_pin(m, call, arg->name, NULL, output, NO_PIN);
	}
}

static void put_inputs(struct maker *m, struct call *call, const struct word_row *row)
{
	const bool grows = is_function(row) && row->most_inputs;
	int most = row->pin_count;

	for (int i = 0; i < call->count && grows; i++)
		if (call->arg[i].row_pin >= most)
			most = call->arg[i].row_pin + 1;
	for (int i = 0; i < most; i++) {
		char name[16];
		int pin;

		if (i < row->pin_count && !takes(row, i))
			continue;
		expr_pin_name(row, i, name, sizeof(name));
		pin = put_pin(m, call, i < row->pin_count ? row->pin[i].name : keep(m, name, strlen(name)),
			      &row->pin[i < row->pin_count ? i : row->pin_count - 1], false, i);
		if (pin >= 0)
			m->out->pin[pin].extends = i >= row->pin_count;
	}
}

/* The pins of the last box, inputs first. The pin of a function's result; -1: it has none. */
static int put_pins(struct maker *m, struct call *call, const struct word_row *row, bool result)
{
	const bool enable = has_enable(call);
	int out = -1;

	if (enable)
		put_pin(m, call, "EN", NULL, false, PIN_EN);
	if (row)
		put_inputs(m, call, row);
	put_others(m, call, false);
	if (enable)
		put_pin(m, call, "ENO", NULL, true, PIN_ENO);
	if (result)
		out = put_pin(m, call, "OUT", NULL, true, PIN_RESULT);
	for (int i = 0; row && i < row->pin_count; i++)
		if (!(is_function(row) && row->most_inputs) && row->pin[i].dir == PIN_OUT)
			put_pin(m, call, row->pin[i].name, &row->pin[i], true, i);
	put_others(m, call, true);
	return out;
}

/* ---- expressions ---- */

static struct value build(struct maker *m, const struct expr *expr, int at);

static struct value box_value(const struct maker *m, int pin, struct span part)
{
	return (struct value){ .pin = pin, .wire = -1, .box = true, .part = outer(m, part) };
}

static bool has_result(const struct maker *m, const struct word_row *row)
{
	return !row || row->owner < 0 || !is_function(row) || !row->number || row->most_inputs ||
	       row->owner >= m->project->pou_count || !m->project->pou[row->owner].no_result;
}

/* The box of a call of a function. */
static struct value finish_call(struct maker *m, struct call *call, const struct word_row *row, struct span part,
				uint16_t made)
{
	const struct piece *name = &m->piece[part.first];
	const char *type = is_function(row) ? row->word : keep(m, name->text, name->len);
	struct fbd_box *box = add_box(m, FBD_FUNCTION, type, part);
	int result;

	if (!box)
		return box_value(m, -1, part);
	box->row = row;
	box->made = made;
	match(row, call);
	result = put_pins(m, call, row, has_result(m, row));
	return box_value(m, result, part);
}

static const struct word_row *function_row(struct maker *m, const char *text, size_t len)
{
	const enum word word = words_find(&m->out->words, text, len);
	const struct word_row *row = words_row(&m->out->words, word);

	return word != WORD_COUNT && row->kind == WORD_FN ? row : NULL;
}

/* `NOT Q =>` */
static bool is_inverted(const struct maker *m, const struct argument *arg)
{
	return arg->len && is_piece(m, piece_at(m, arg->name) - 1, "NOT");
}

/* The arguments of a call are linked from the last to the first. */
static void take_arguments(struct maker *m, const struct expr *expr, int at, struct call *call)
{
	int order[ARGUMENTS], count = 0;

	for (; at >= 0 && count < ARGUMENTS; at = expr->node[at].right)
		order[count++] = at;
	for (; count > 0; call->count++) {
		const struct expr_node *node = &expr->node[order[--count]];
		struct argument *arg = &call->arg[call->count];

		*arg = (struct argument){ .name = node->len ? node->text : "", .len = node->len,
					  .output = node->output };
		if (node->output) {
			arg->value.part = path_at(m, expr->node[node->left].text);
			arg->inverted = is_inverted(m, arg);
		} else
			arg->value = build(m, expr, node->left);
	}
}

static struct value edge_value(struct maker *m, const struct expr *expr, const struct expr_node *node,
			       struct span part)
{
	const struct value value = build(m, expr, expr->node[node->left].left);
	struct fbd_box *box = add_box(m, FBD_TRIGGER, ascii_upper(*node->text) == 'R' ? "R_EDGE" : "F_EDGE", part);

	if (box) {
		box->made = expr_mark(expr, (int)(node - expr->node), m->text);
		connect(m, add_pin(m, "", NULL, false), &value);
	}
	return box_value(m, box ? add_pin(m, "", NULL, true) : -1, part);
}

/* Open inputs, `IN3 :=`, which the parser leaves out. */
static void take_open(const struct maker *m, struct span part, struct call *call)
{
	int depth = 0;

	for (int i = part.first; i + 2 <= part.last && call->count < ARGUMENTS; i++) {
		depth += is_piece(m, i, "(") || is_piece(m, i, "[");
		depth -= is_piece(m, i, ")") || is_piece(m, i, "]");
		if (depth == 1 && m->piece[i].word && is_piece(m, i + 1, ":=") &&
		    (is_piece(m, i + 2, ",") || is_piece(m, i + 2, ")")))
			call->arg[call->count++] = (struct argument){ .name = m->piece[i].text,
								      .len = m->piece[i].len, .empty = true };
	}
}

static struct value call_value(struct maker *m, const struct expr *expr, const struct expr_node *node)
{
	const struct span part = path_at(m, node->text);
	const bool single = node->left >= 0 && expr->node[node->left].right < 0 &&
			    !expr->node[node->left].output;
	struct call *call;

	if (single && ascii_is("PREVIOUS", node->text, node->len)) {
		const int inner = expr->node[node->left].left;
		struct value value = expr->node[inner].op == EXPR_NAME ?
				     name_value(m, path_at(m, expr->node[inner].text), true) :
				     build(m, expr, inner);

		value.part = part;
		return value;
	}
	if (single && (ascii_is("R_EDGE", node->text, node->len) || ascii_is("F_EDGE", node->text, node->len)))
		return edge_value(m, expr, node, part);
	call = arena_alloc(&m->scratch, sizeof(*call));
	if (!call)
		return box_value(m, -1, part);
	call->count = 0;
	take_arguments(m, expr, node->left, call);
	take_open(m, part, call);
	return finish_call(m, call, function_row(m, node->text, node->len), part,
			   expr_mark(expr, (int)(node - expr->node), m->text));
}

struct sign {
	enum expr_op op;
	enum word fn;
	const char *text, *lazy;
	bool chain;          /* several in a row are one box                     */
};
static const struct sign signs[] = {
	{ EXPR_AND, FN_AND, "AND", "AND_THEN", true }, { EXPR_OR, FN_OR, "OR", "OR_ELSE", true },
	{ EXPR_XOR, FN_XOR, "XOR", "XOR", true }, { EXPR_NOT, FN_NOT, "NOT", "", false },
	{ EXPR_NEG, FN_NEG, "-", "", false },
	{ EXPR_FN, FN_ADD, "+", "", true }, { EXPR_FN, FN_SUB, "-", "", false },
	{ EXPR_FN, FN_MUL, "*", "", true }, { EXPR_FN, FN_DIV, "/", "", false },
	{ EXPR_FN, FN_MOD, "MOD", "", false }, { EXPR_FN, FN_EXPT, "**", "", false },
	{ EXPR_FN, FN_GT, ">", "", false }, { EXPR_FN, FN_GE, ">=", "", false },
	{ EXPR_FN, FN_EQ, "=", "", false }, { EXPR_FN, FN_LE, "<=", "", false },
	{ EXPR_FN, FN_LT, "<", "", false }, { EXPR_FN, FN_NE, "<>", "", false },
};

static const struct sign *sign_of(const struct expr_node *node)
{
	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (signs[i].op == node->op && (node->op != EXPR_FN || signs[i].fn == node->fn))
			return &signs[i];
	return &signs[0];
}

static bool same_sign(const struct expr_node *a, const struct expr_node *b)
{
	return a->op == b->op && a->lazy == b->lazy && (a->op != EXPR_FN || a->fn == b->fn);
}

/* The operands of an operator, from the left: of a chain all of them. Returns their number. */
static int operands_of(const struct expr *expr, int at, int operand[LIMIT_FN_INPUTS])
{
	const struct expr_node *root = &expr->node[at];
	const bool chain = sign_of(root)->chain;
	int count = 0;

	while (chain && same_sign(&expr->node[at], root) && count < LIMIT_FN_INPUTS - 1) {
		operand[count++] = expr->node[at].right;
		at = expr->node[at].left;
	}
	if (!chain && root->right >= 0)
		operand[count++] = root->right;
	operand[count++] = chain ? at : root->left;
	for (int i = 0, k = count - 1; i < k; i++, k--) {
		const int swap = operand[i];

		operand[i] = operand[k];
		operand[k] = swap;
	}
	return count;
}

static struct span joined(struct span a, struct span b)
{
	return (struct span){ a.first < b.first ? a.first : b.first, a.last > b.last ? a.last : b.last };
}

/* Up to the partners of parentheses of which only one stands in it, as in (a + b) + (c + d), where all are operands
 * of one box. */
static struct span balanced(const struct maker *m, struct span part)
{
	int open = 0, close = 0;

	for (int i = part.first; i <= part.last; i++) {
		open += is_piece(m, i, "(");
		close += is_piece(m, i, ")") && open == 0;
		open -= is_piece(m, i, ")") && open > 0;
	}
	for (; close > 0 && part.first > 0; part.first--)
		close -= is_piece(m, part.first - 1, "(");
	for (; open > 0 && part.last + 1 < m->pieces; part.last++)
		open -= is_piece(m, part.last + 1, ")");
	return part;
}

static struct value operator_value(struct maker *m, const struct expr *expr, int at)
{
	const struct expr_node *node = &expr->node[at];
	const struct sign *sign = sign_of(node);
	int operand[LIMIT_FN_INPUTS];
	const int count = operands_of(expr, at, operand);
	struct value *value = arena_alloc(&m->scratch, (size_t)count * sizeof(*value));
	struct span part = { 0, 0 };
	struct fbd_box *box;

	if (!value)
		return box_value(m, -1, part);
	for (int i = 0; i < count; i++) {
		value[i] = build(m, expr, operand[i]);
		part = i ? joined(part, value[i].part) : value[i].part;
	}
	part = balanced(m, part);
	if (node->right < 0)
		part.first -= part.first > 0; /* the sign */
	box = add_box(m, FBD_OPERATOR, node->lazy ? sign->lazy : sign->text, part);
	if (!box)
		return box_value(m, -1, part);
	box->row = word_row(sign->fn);
	box->made = expr_mark(expr, at, m->text);
	for (int i = 0; i < count; i++) {
		const int pin = add_pin(m, "", box->row->pin_count ? word_input(box->row, (uint32_t)i) : NULL,
					false);

		connect(m, pin, &value[i]);
		if (pin >= 0)
			m->out->pin[pin].extends = i > 1;
	}
	return box_value(m, add_pin(m, "", NULL, true), part);
}

static struct value operand_value(struct maker *m, const char *text)
{
	const struct span part = path_at(m, text);

	return (struct value){ .pin = -1, .wire = -1, .operand = part_text(m, part), .part = outer(m, part) };
}

/* NOT of an operand is a circle at the pin. */
static struct value not_value(struct maker *m, const struct expr *expr, int at)
{
	struct value value;
	const struct expr_node *inner = &expr->node[expr->node[at].left];

	if (inner->op != EXPR_NAME && inner->op != EXPR_INDEX && inner->op != EXPR_BIT &&
	    inner->op != EXPR_LITERAL &&
	    !(inner->op == EXPR_CALL && ascii_is("PREVIOUS", inner->text, inner->len)))
		return operator_value(m, expr, at);
	value = build(m, expr, expr->node[at].left);
	value.negated = !value.negated;
	value.part.first -= value.part.first > 0; /* NOT */
	value.part = outer(m, value.part);
	return value;
}

static struct value build(struct maker *m, const struct expr *expr, int at)
{
	const struct expr_node *node = &expr->node[at];
	struct value value;

	switch (node->op) {
	case EXPR_NAME:
		value = name_value(m, path_at(m, node->text), false);
		value.part = outer(m, value.part);
		return value;
	case EXPR_INDEX:
	case EXPR_BIT:
	case EXPR_LITERAL:
		return operand_value(m, expr_first(expr, at, m->text));
	case EXPR_NEG:
		if (expr->node[node->left].op != EXPR_LITERAL)
			return operator_value(m, expr, at);
		value = operand_value(m, expr->node[node->left].text);
		value.part.first -= value.part.first > 0; /* the sign */
		value.operand = part_text(m, value.part);
		value.part = outer(m, value.part);
		return value;
	case EXPR_NOT:
		return not_value(m, expr, at);
	case EXPR_FN:
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		return operator_value(m, expr, at);
	case EXPR_CALL:
		return call_value(m, expr, node);
	case EXPR_ARG:
		break;
	}
	return (struct value){ .pin = -1, .wire = -1 };
}

/* ---- statements ---- */

/* Reads the next part; false: there is none, or it cannot be read. */
static bool next_part(struct maker *m, struct st_walk *walk, struct st_part *part)
{
	diag_init(m->ignored);
	return st_next(walk, part, m->expr, m->ignored, (struct diag){ .file = "" }) &&
	       part->role != ST_NO_PART;
}

/* The hint of a statement is that of its outermost box. */
static void put_hint(struct maker *m, int first)
{
	struct fbd_graph *out = m->out;
	int main = -1;

	for (int i = first; i < out->box_count; i++) {
		const enum fbd_box_kind kind = out->box[i].kind;
		const bool ends = kind == FBD_STORE || kind == FBD_SET || kind == FBD_RESET ||
				  kind == FBD_JUMP || kind == FBD_RETURN;

		if (!ends || main < 0)
			main = i;
		out->box[i].nested = !ends;
	}
	if (main < 0)
		return;
	out->box[main].nested = false;
	out->box[main].at_column = m->item->at_column;
	out->box[main].at_row = m->item->at_row;
}

/* A box at the end of a wire: a store, a jump … */
static void end_box(struct maker *m, enum fbd_box_kind kind, const char *type, const char *target,
		    struct span part, const struct value *value)
{
	struct fbd_box *box = add_box(m, kind, type, part);
	int pin;

	if (!box)
		return;
	box->target = target;
	pin = add_pin(m, "", NULL, false);
	if (value)
		connect(m, pin, value);
}

/* Low := value, where Low is a wire. */
static void wire_line(struct maker *m, const char *name, struct value value)
{
	if ((value.pin >= 0 || value.wire >= 0) && !value.negated && !value.previous) {
		define(m, value.pin >= 0 ? value.pin : m->out->wire[value.wire].from_pin, name);
		return;
	}
	if (!add_box(m, FBD_VALUE, "", value.part))
		return;
	connect(m, add_pin(m, "", NULL, false), &value);
	value.pin = add_pin(m, "", NULL, true);
	if (value.pin >= 0)
		define(m, value.pin, name);
}

/* The target of an assignment, up to the piece before := or REF= or ?= */
static struct span target_part(const struct maker *m, const struct expr *expr, const char **type)
{
	struct span part = path_at(m, expr->target);

	*type = expr->target_points ? "REF=" : expr->target_tried ? "?=" : "";
	return part;
}

static void assign_line(struct maker *m)
{
	struct st_walk walk;
	struct st_part part;

	st_begin(&walk, &m->project->names, m->item);
	split(m, walk.lex);
	while (m->pieces && next_part(m, &walk, &part) && m->expr->target) {
		const char *type;
		const struct span target = target_part(m, m->expr, &type);
		const bool wire = !*type && is_wire(m, target);
		const char *name = part_text(m, target);
		const struct value value = build(m, m->expr, m->expr->root);

		if (wire)
			wire_line(m, name, value);
		else
			end_box(m, FBD_STORE, type, name, target, &value);
	}
}

/* An argument of a call that is a statement. */
static void take_part_of_call(struct maker *m, struct call *call, const struct st_part *part)
{
	struct argument *arg;

	if (call->count == ARGUMENTS)
		return;
	arg = &call->arg[call->count++];
	*arg = (struct argument){ .name = part->pin.len ? part->pin.text : "", .len = part->pin.len,
				  .output = part->role == ST_OUTPUT, .empty = part->role == ST_OPEN };
	if (arg->empty)
		return;
	if (arg->output) {
		arg->value.part = path_at(m, part->text);
		arg->inverted = part->inverted;
	} else
		arg->value = build(m, m->expr, m->expr->root);
}

/* Delay(IN := Start, Q => Motor), or a function alone */
static void call_line(struct maker *m)
{
	struct call *call = arena_alloc(&m->scratch, sizeof(*call));
	const struct word_row *block;
	struct span whole, name;
	struct st_walk walk;
	struct st_part part;
	const char *text;

	st_begin(&walk, &m->project->names, m->item);
	split(m, walk.lex);
	if (!call || !m->pieces || !next_part(m, &walk, &part))
		return;
	call->count = 0;
	name = whole = path_at(m, part.text);
	if (is_piece(m, name.last, ")"))
		for (int depth = 0; name.last > name.first; name.last--) {
			depth += is_piece(m, name.last, ")") - is_piece(m, name.last, "(");
			if (!depth)
				break;
		}
	if (name.last > name.first && is_piece(m, name.last, "("))
		name.last--;
	text = part_text(m, name);
	while (next_part(m, &walk, &part))
		take_part_of_call(m, call, &part);
	block = instance_row(m, text, strlen(text));
	if (!block) {
		finish_call(m, call, function_row(m, text, strlen(text)), whole, 0);
		return;
	}
	if (!add_box(m, FBD_BLOCK, block->word, whole))
		return;
	m->out->box[m->out->box_count - 1].instance = text;
	m->out->box[m->out->box_count - 1].row = block;
	match(block, call);
	put_pins(m, call, block, false);
}

/* Horn S= value, JMP Fill IF value, RETURN IF value */
static void end_line(struct maker *m, enum fbd_box_kind kind)
{
	const bool names = kind != FBD_RETURN && kind != FBD_STOP;
	struct value value = { .pin = -1, .wire = -1 };
	struct span target = { 0, 0 };
	struct st_walk walk;
	struct st_part part;
	bool given = false;

	st_begin(&walk, &m->project->names, m->item);
	split(m, walk.lex);
	if (!m->pieces)
		return;
	if (kind == FBD_JUMP)
		target.first = target.last = m->pieces > 1;
	while (next_part(m, &walk, &part)) {
		if (part.role == ST_VARIABLE)
			target = path_at(m, part.text);
		given = part.role == ST_VALUE;
		if (given)
			value = build(m, m->expr, m->expr->root);
	}
	end_box(m, kind, kind == FBD_SET ? "S" : kind == FBD_RESET ? "R" : kind == FBD_RETURN ? "RETURN" :
		kind == FBD_STOP ? "STOP" : ">>",
		names ? part_text(m, target) : NULL, target, given ? &value : NULL);
}

static void take_item(struct maker *m)
{
	const int first = m->out->box_count;

	switch ((enum st_kind)m->item->kind) {
	case ST_ASSIGN:
		assign_line(m);
		break;
	case ST_CALL:
		call_line(m);
		break;
	case ST_SET:
		end_line(m, FBD_SET);
		break;
	case ST_RESET:
		end_line(m, FBD_RESET);
		break;
	case ST_JUMP:
	case ST_JUMP_IF:
		end_line(m, FBD_JUMP);
		break;
	case ST_RETURN:
	case ST_RETURN_IF:
		end_line(m, FBD_RETURN);
		break;
	case ST_STOP_IF:
		end_line(m, FBD_STOP);
		break;
	case ST_COMMENT: {
		int *note = arena_push(&m->out->arena, &m->out->note, &m->out->note_count, sizeof(*note));

		if (note)
			*note = m->number;
		break;
	}
	case ST_IF: case ST_ELSIF: case ST_ELSE: case ST_END_IF: case ST_CASE: case ST_CHOICE:
	case ST_END_CASE: case ST_FOR: case ST_END_FOR: case ST_WHILE: case ST_END_WHILE: case ST_REPEAT:
	case ST_UNTIL: case ST_EXIT: case ST_CONTINUE: case ST_LABEL: case ST_EMPTY: case ST_KINDS:
		break; /* no line of a network */
	}
	put_hint(m, first);
	arena_reset(&m->scratch);
}

/* ---- feedback ---- */

/* A name that no line above gives: a wire or an output from further down is the value of the scan before. */
static void feed_back(struct maker *m, int pin)
{
	struct fbd_graph *out = m->out;
	struct fbd_pin *p = &out->pin[pin];
	const size_t len = strlen(p->operand);
	const struct definition *definition = find_definition(m, p->operand, len);
	const int output = definition ? -1 : find_output(out, p->operand, len, 0, out->box_count);

	if (!definition && output < 0)
		return;
	p->operand = NULL;
	p->previous = true;
	if (definition) {
		p->wire = definition->wire;
		return;
	}
	p->wire = -1;
	p->negated = p->negated != out->pin[output].negated;
	out->pin[pin].wire = wire_of(m, output);
}

static bool take_network(struct maker *m, const struct fbd_network *network)
{
	const struct st *st = m->pou->st;

	m->expr = arena_alloc(&m->lasting, sizeof(*m->expr));
	m->ignored = arena_alloc(&m->lasting, sizeof(*m->ignored));
	if (!m->expr || !m->ignored)
		return false;
	for (int i = network->first; i < network->first + network->count; i++) {
		m->number = i;
		m->item = &st->item[i];
		m->text = names_text(&m->project->names, m->item->text);
		take_item(m);
	}
	for (int i = 0; i < m->refers_count && i < m->out->pin_count; i++)
		if (m->refers[i] && m->out->pin[i].operand)
			feed_back(m, i);
	return !m->lasting.failed && !m->scratch.failed && !m->out->arena.failed;
}

bool fbd_graph_make(const struct project *project, const struct pou *pou, int network,
		    struct fbd_graph *out)
{
	struct maker m = { .project = project, .pou = pou, .out = out };
	bool good;

	*out = (struct fbd_graph){ .words = project->words };
	arena_init(&out->arena);
	arena_init(&m.scratch);
	arena_init(&m.lasting);
	out->words.arena = &out->arena; /* words made by rule stay in the graph */
	out->words.made = NULL;
	out->words.made_count = 0;
	good = network >= 0 && pou->fbd && network < pou->fbd->count &&
	       take_network(&m, &pou->fbd->network[network]);
	arena_free(&m.scratch);
	arena_free(&m.lasting);
	if (!good)
		fbd_graph_free(out);
	return good;
}

void fbd_graph_free(struct fbd_graph *graph)
{
	arena_free(&graph->arena);
	*graph = (struct fbd_graph){ .box_count = 0 };
}

int fbd_graph_source(const struct fbd_graph *graph, int pin)
{
	const int wire = graph->pin[pin].output ? -1 : graph->pin[pin].wire;

	return wire < 0 ? -1 : graph->wire[wire].from_pin;
}

int fbd_pin_number(const struct fbd_graph *graph, int pin)
{
	const struct fbd_box *box = &graph->box[graph->pin[pin].box];
	int number = 0;

	for (int i = box->first_pin; i <= pin; i++)
		number += graph->pin[i].output == graph->pin[pin].output;
	return number;
}
