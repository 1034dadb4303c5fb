/* SPDX-License-Identifier: MIT
 *
 * to_classic_expression - what stands in [ … ] as ClassicLadder's arithmetic.
 *
 * An expression there has at most 49 bytes and one comparison. Rungs before the element
 * compute parts of longer ones in words and bits of their own. Functions that an import
 * writes become operators again.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include "engine/base/ascii.h"

#include <stdlib.h>
#include <string.h>

/* Precedence in ClassicLadder, from high to low. */
enum rank { RANK_TERM, RANK_PRODUCT, RANK_SUM, RANK_AND, RANK_XOR, RANK_OR };

struct term {
	const char *text;
	enum rank rank;
	bool is_bool;
	const char *compare;   /* "<" between left and right; NULL: none      */
	const char *left, *right;
	bool constant;
	int32_t value;
};

struct building {
	struct leaving *e;
	const struct expr *expr;
	struct out_before *first, **last;
};

static struct term build(struct building *b, int term, int depth);

static struct term failed(struct building *b, const char *text, size_t len)
{
	out_refuse(b->e, DIAG_EXPORT_EXPRESSION, "%.*s", (int)(len > 40 ? 40 : len), text);
	return (struct term){ .text = "0", .constant = true };
}

const char *out_encode(struct leaving *e, struct classic_variable variable)
{
	if (variable.index_type < 0)
		return out_text(e, "@%d/%d@", variable.type, variable.number);
	return out_text(e, "@%d/%d[%d/%d]@", variable.type, variable.number,
			variable.index_type, variable.index_number);
}

static struct out_before *before(struct building *b, const char *text, int bit)
{
	struct out_before *one = arena_alloc(b->e->arena, sizeof(*one));

	if (!one)
		return NULL;
	*one = (struct out_before){ text, bit, NULL };
	*b->last = one;
	b->last = &one->next;
	return one;
}

/* Stores a part in a word of its own, unless it is short. */
static struct term apart(struct building *b, struct term part)
{
	int word;

	if (strlen(part.text) <= 10)
		return part;
	word = new_word(b->e);
	before(b, out_text(b->e, "@%d/%d@:=%s", CL_WORD, word, part.text), -1);
	return (struct term){ .text = out_encode(b->e, variable_of(CL_WORD, word)),
			      .is_bool = part.is_bool };
}

/* Stores a comparison in a bit. */
static struct term settled(struct building *b, struct term part)
{
	int bit;

	if (!part.compare)
		return part;
	bit = new_bit(b->e);
	before(b, out_text(b->e, "%s%s%s", part.left, part.compare, part.right), bit);
	return (struct term){ .text = out_encode(b->e, variable_of(CL_BIT, bit)),
			      .is_bool = true };
}

static const char *inside(struct building *b, struct term part, enum rank rank)
{
	bool sign = part.constant && part.value < 0 && rank < RANK_SUM;

	return part.rank > rank || sign ? out_text(b->e, "(%s)", part.text) : part.text;
}

enum { ROOM = CLASSIC_EXPRESSION - 12 }; /* without a target, @200/1234@:= */

static struct term binary(struct building *b, struct term left, const char *op,
			  struct term right, enum rank rank)
{
	struct term part = { .rank = rank };

	left = settled(b, left);
	right = settled(b, right);
	for (int pass = 0; pass < 3; pass++) {
		part.text = out_text(b->e, "%s%s%s", inside(b, left, rank), op,
				     inside(b, right, rank - 1));
		if (strlen(part.text) <= ROOM)
			break;
		if (strlen(left.text) >= strlen(right.text))
			left = apart(b, left);
		else
			right = apart(b, right);
	}
	return part;
}

static struct term compared(struct building *b, struct term left, const char *op,
			    struct term right)
{
	left = settled(b, left);
	right = settled(b, right);
	while (strlen(left.text) + strlen(right.text) + 2 > CLASSIC_EXPRESSION) {
		struct term *longer = strlen(left.text) > strlen(right.text) ? &left : &right;

		*longer = apart(b, *longer);
	}
	return (struct term){ .compare = op, .left = left.text, .right = right.text,
			      .is_bool = true, .text = "" };
}

static struct term operand(struct building *b, const struct expr_node *term)
{
	struct out_operand is;

	if (!there_text(b->e, term->text, term->len, &is))
		return (struct term){ .text = "0", .constant = true };
	if (is.is_constant)
		return (struct term){ .text = out_text(b->e, "%d", is.value),
			.constant = true, .value = is.value, .is_bool = is.is_bool };
	return (struct term){ .text = out_encode(b->e, is.variable), .is_bool = is.is_bool };
}

/* The index i + 3: an offset and a variable. */
static bool index_of(struct building *b, int term, int *offset,
		     struct classic_variable *variable)
{
	const struct expr_node *at = &b->expr->node[term];
	struct out_operand left, right;

	*offset = 0;
	if (at->op == EXPR_NAME && there_text(b->e, at->text, at->len, &left) &&
	    !left.is_constant && !left.is_bool && left.variable.index_type < 0) {
		*variable = left.variable;
		return true;
	}
	if (at->op != EXPR_FN || (at->fn != FN_ADD && at->fn != FN_SUB) ||
	    b->expr->node[at->left].op != EXPR_NAME ||
	    b->expr->node[at->right].op != EXPR_LITERAL)
		return false;
	if (!there_text(b->e, b->expr->node[at->left].text, b->expr->node[at->left].len,
			  &left) || left.is_bool || left.variable.index_type >= 0 ||
	    !there_text(b->e, b->expr->node[at->right].text,
			  b->expr->node[at->right].len, &right))
		return false;
	*variable = left.variable;
	*offset = at->fn == FN_ADD ? right.value : -right.value;
	return true;
}

/* An array element whose index is a variable with an offset. */
static bool element(struct building *b, const char *text, size_t len, int index,
		    struct out_operand *out)
{
	struct leaving *e = b->e;
	const struct meaning *m;
	enum diag_id why;
	uint32_t id;
	int offset;
	struct classic_variable by;

	id = names_intern(&e->project->names, text, len);
	m = scope_find(e->scope, e->pou, id, &why);
	if (!m || m->kind != MEANING_ARRAY || !m->var || !index_of(b, index, &offset, &by))
		return false;
	id = scope_first(e->scope, e->pou, id, "", 0);
	if (!id || !there_find(e, id, out) || out->variable.index_type >= 0)
		return false;
	out->variable.number += offset - m->array.low;
	out->variable.index_type = by.type;
	out->variable.index_number = by.number;
	e->indexes = true;
	return out->variable.number >= 0;
}

/* ---- functions ---- */

/* @title: the comment that an import writes above the function: it tells it from others of the
 * same name. */
struct known { const char *here, *op; enum rank rank; bool upstream; const char *title; };

static const struct known known[] = {
	{ "Sum", "+", RANK_SUM, false, "A + B, of" },
	{ "Difference", "-", RANK_SUM, false, "A - B, of" },
	{ "Product", "*", RANK_PRODUCT, false, "A * B, of" },
	{ "Quotient", "/", RANK_PRODUCT, false, "A / B; by" },
	{ "Remainder", "%", RANK_PRODUCT, false, "A MOD B; by" },
	{ "BitAnd", "&", RANK_AND, false, "the bits that both" },
	{ "BitXor", "^", RANK_XOR, true, "the bits that one" },
	{ "BitOr", "|", RANK_OR, false, "the bits that any" },
	{ "Power", "POW", RANK_TERM, false, "A to the power" },
	{ "ShiftLeft", "SHL", RANK_TERM, true, "A, B places to the left" },
	{ "ShiftRight", "SHR", RANK_TERM, true, "A, B places to the right" },
	{ "RotateLeft", "ROL", RANK_TERM, true, "A, B places round to the left" },
	{ "RotateRight", "ROR", RANK_TERM, true, "A, B places round to the right" },
};

/* The row of a function name, also with a number behind it. */
static const struct known *known_function(const char *text, size_t len)
{
	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++) {
		size_t own = strlen(known[i].here);

		if (len >= own && !strncmp(text, known[i].here, own) &&
		    (len == own || text[own] == '_'))
			return &known[i];
	}
	return NULL;
}

bool pou_is_imported(const struct project *project, const struct pou *pou)
{
	const char *name = project_text(project, pou->name);
	const struct known *row = known_function(name, strlen(name));

	return row && pou->kind == POU_FUNCTION &&
	       strstr(project_text(project, pou->comment), row->title);
}

/* The operator that a call stands for; NULL: it calls something else. */
static const struct known *operator_of(const struct building *b, const char *text, size_t len)
{
	const struct project *project = b->e->project;
	const int pou = project_find_pou(project, text, len);

	return pou >= 0 && pou_is_imported(project, &project->pou[pou]) ?
	       known_function(text, len) : NULL;
}

enum { ARGUMENTS = 10 };

static int arguments(struct building *b, const struct expr_node *term, struct term *part,
		     int depth)
{
	int at = term->left, count = 0, list[ARGUMENTS];

	for (; at >= 0 && count < ARGUMENTS; at = b->expr->node[at].right)
		list[count++] = b->expr->node[at].left;
	if (at >= 0)
		return -1;
	for (int i = 0; i < count; i++)
		part[i] = settled(b, build(b, list[count - 1 - i], depth));
	return count;
}

/* Arguments of functions are variables, for upstream also constants. Other parts are stored in
 * a word. */
static struct term atom(struct building *b, struct term part)
{
	const char *end = *part.text == '@' ? strchr(part.text + 1, '@') : NULL;
	int word;

	if ((end && !end[1]) || (part.constant && part.value >= 0 &&
				 b->e->dialect == CLASSIC_UPSTREAM))
		return part;
	word = new_word(b->e);
	before(b, out_text(b->e, "@%d/%d@:=%s", CL_WORD, word, part.text), -1);
	return (struct term){ .text = out_encode(b->e, variable_of(CL_WORD, word)) };
}

static const char *call_text(struct building *b, const char *name, struct term *part,
			     int count)
{
	const char *text = out_text(b->e, "%s(%s", name, part[0].text);

	for (int i = 1; i < count; i++)
		text = out_text(b->e, "%s,%s", text, part[i].text);
	return out_text(b->e, "%s)", text);
}

static struct term call(struct building *b, const struct expr_node *term, int depth)
{
	const struct known *own = operator_of(b, term->text, term->len);
	struct term part[ARGUMENTS];
	int count = arguments(b, term, part, depth);
	bool upstream = b->e->dialect == CLASSIC_UPSTREAM;
	const char *name = NULL;

	if (!b->e->good || count < 1)
		return failed(b, term->text, term->len);
	b->e->divides |= own && own->rank == RANK_PRODUCT && *own->op != '*' && !upstream &&
			 count == 2 && !(part[1].constant && part[1].value);
	if (own && count == 2 && own->rank != RANK_TERM && (upstream || !own->upstream))
		return binary(b, part[0], own->op, part[1], own->rank);
	if (own && count == 2 && !upstream && !strcmp(own->op, "POW"))
		return binary(b, part[0], "^", part[1], RANK_XOR);
	if (own && count == 2 && upstream)
		name = own->op;
	else if (ascii_is("ABS", term->text, term->len))
		name = "ABS";
	else if (ascii_is("MIN", term->text, term->len))
		name = "MINI";
	else if (ascii_is("MAX", term->text, term->len))
		name = "MAXI";
	else if (count == 1 && (ascii_is("BOOL_TO_DINT", term->text, term->len) ||
				ascii_is("BOOL_TO_INT", term->text, term->len) ||
				ascii_is("INT_TO_DINT", term->text, term->len) ||
				ascii_is("UINT_TO_DINT", term->text, term->len) ||
				ascii_is("WORD_TO_DINT", term->text, term->len)))
		return (struct term){ .text = part[0].text, .rank = part[0].rank,
				      .constant = part[0].constant,
				      .value = part[0].value };
	if (!name)
		return failed(b, term->text, term->len);
	for (int i = 0; i < count; i++)
		part[i] = atom(b, part[i]);
	for (int i = 0; i < count && strlen(call_text(b, name, part, count)) > ROOM; i++)
		part[i] = apart(b, part[i]);
	if (strlen(call_text(b, name, part, count)) > ROOM)
		return failed(b, term->text, term->len);
	return (struct term){ .text = call_text(b, name, part, count) };
}

/* ---- operators ---- */

static struct term negated(struct building *b, struct term part)
{
	static const struct { const char *op, *other; } row[] = {
		{ "=", "<>" }, { "<>", "=" }, { "<", ">=" }, { ">=", "<" }, { ">", "<=" },
		{ "<=", ">" },
	};

	for (size_t i = 0; part.compare && i < sizeof(row) / sizeof(*row); i++)
		if (!strcmp(part.compare, row[i].op)) {
			part.compare = row[i].other;
			return part;
		}
	return (struct term){ .text = out_text(b->e, "!%s", inside(b, part, RANK_TERM)),
			      .is_bool = true };
}

static struct term function(struct building *b, const struct expr_node *term, int depth)
{
	struct term left = build(b, term->left, depth);
	struct term right = build(b, term->right, depth);

	b->e->sums |= term->fn == FN_ADD || term->fn == FN_SUB || term->fn == FN_MUL;
	b->e->divides |= (term->fn == FN_DIV || term->fn == FN_MOD) &&
			 !(right.constant && right.value);
	switch ((int)term->fn) {
	case FN_ADD: return binary(b, left, "+", right, RANK_SUM);
	case FN_SUB: return binary(b, left, "-", right, RANK_SUM);
	case FN_MUL: return binary(b, left, "*", right, RANK_PRODUCT);
	case FN_DIV: return binary(b, left, "/", right, RANK_PRODUCT);
	case FN_MOD: return binary(b, left, "%", right, RANK_PRODUCT);
	case FN_GT: return compared(b, left, ">", right);
	case FN_GE: return compared(b, left, ">=", right);
	case FN_LT: return compared(b, left, "<", right);
	case FN_LE: return compared(b, left, "<=", right);
	case FN_EQ: return compared(b, left, "=", right);
	case FN_NE: return compared(b, left, "<>", right);
	}
	return failed(b, "", 0);
}

static struct term logic(struct building *b, const struct expr_node *term, int depth)
{
	struct term left = build(b, term->left, depth), right = build(b, term->right, depth);
	bool is_bool = left.is_bool && right.is_bool;
	struct term part;

	if (term->op == EXPR_AND)
		part = binary(b, left, "&", right, RANK_AND);
	else if (term->op == EXPR_OR)
		part = binary(b, left, "|", right, RANK_OR);
	else if (is_bool)
		part = settled(b, compared(b, left, "<>", right));
	else if (b->e->dialect == CLASSIC_UPSTREAM)
		part = binary(b, left, "^", right, RANK_XOR);
	else
		return failed(b, "XOR", 3);
	part.is_bool = is_bool;
	return part;
}

static struct term build(struct building *b, int term, int depth)
{
	const struct expr_node *at = &b->expr->node[term];
	struct out_operand is;
	struct term part;

	if (!b->e->good || depth > LIMIT_EXPR_DEPTH)
		return failed(b, "", 0);
	switch (at->op) {
	case EXPR_NAME: case EXPR_LITERAL:
		return operand(b, at);
	case EXPR_INDEX:
		if (!at->tail.len && at->len && element(b, at->text, at->len, at->left, &is))
			return (struct term){ .text = out_encode(b->e, is.variable),
					      .is_bool = is.is_bool };
		return failed(b, at->text, at->len);
	case EXPR_NEG:
		part = settled(b, build(b, at->left, depth + 1));
		if (part.constant)
			return (struct term){ .text = out_text(b->e, "%d", -part.value),
				.constant = true, .value = -part.value };
		return (struct term){ .text = out_text(b->e, "0-%s",
				inside(b, part, RANK_PRODUCT)), .rank = RANK_SUM };
	case EXPR_NOT:
		part = build(b, at->left, depth + 1);
		return part.is_bool ? negated(b, part) : failed(b, "NOT", 3);
	case EXPR_FN:
		return function(b, at, depth + 1);
	case EXPR_AND: case EXPR_OR: case EXPR_XOR:
		return logic(b, at, depth + 1);
	case EXPR_CALL:
		return call(b, at, depth + 1);
	case EXPR_ARG: case EXPR_BIT:
		break;
	}
	return failed(b, at->text, at->len);
}

/* ---- cells ---- */

/* ClassicLadder takes a number for TRUE if it is not 0: `x <> 0` becomes `x`. */
static const char *truth_value(struct building *b, struct term part)
{
	if (part.compare && !strcmp(part.compare, "<>") && !strcmp(part.right, "0"))
		return part.left;
	return settled(b, part).text;
}

static bool assignment(struct building *b, struct out_part *item)
{
	const struct expr *expr = b->expr;
	struct out_operand target;
	struct term part;
	const char *value, *name;

	if (expr->target_tail.len || expr->target_base >= 0)
		return out_refuse(b->e, DIAG_EXPORT_EXPRESSION, "%.*s",
			      (int)expr->target_len, expr->target);
	if (expr->target_index >= 0) {
		if (!element(b, expr->target, expr->target_len, expr->target_index, &target))
			return out_refuse(b->e, DIAG_EXPORT_EXPRESSION, "%.*s",
				      (int)expr->target_len, expr->target);
	} else if (!there_text(b->e, expr->target, expr->target_len, &target)) {
		return false;
	}
	part = build(b, expr->root, 0);
	value = target.is_bool ? truth_value(b, part) : settled(b, part).text;
	name = out_encode(b->e, target.variable);
	if (strlen(name) + 2 + strlen(value) > CLASSIC_EXPRESSION)
		value = apart(b, (struct term){ .text = value }).text;
	item->text = out_text(b->e, "%s:=%s", name, value);
	return b->e->good;
}

bool cell_expression(struct leaving *e, const char *text, struct out_part *item)
{
	struct building b = { .e = e, .expr = e->expr };
	struct diag_list *scrap = arena_alloc(e->arena, sizeof(*scrap));
	struct term part;

	b.last = &b.first;
	if (!scrap || !expr_parse_text(text, strlen(text), e->expr, scrap, (struct diag){ 0 }))
		return out_refuse(e, DIAG_EXPORT_EXPRESSION, "%.40s", text);
	if (e->expr->target) {
		if (!assignment(&b, item))
			return false;
	} else {
		part = build(&b, e->expr->root, 0);
		if (part.compare)
			item->text = out_text(e, "%s%s%s", part.left, part.compare,
					      part.right);
		else
			item->text = out_text(e, "%s<>0", part.text);
	}
	item->before = b.first;
	if (strlen(item->text) > CLASSIC_EXPRESSION)
		return out_refuse(e, DIAG_EXPORT_EXPRESSION, "%.40s", text);
	return e->good;
}
