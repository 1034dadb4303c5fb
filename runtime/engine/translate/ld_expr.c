/* SPDX-License-Identifier: MIT
 *
 * ld_expr - [ … ] cells as IL: a chain of operators, operands and calls of functions.
 *
 * Every operation that can fail gets EN from the ENO of the one before, the first from the
 * power of the cell, as the same boxes in series would.
 */
#include "engine/check/attempt.h"
#include "engine/check/generic.h"
#include "engine/check/infer.h"
#include "engine/check/mixed.h"
#include "engine/model/expr_args.h"
#include "engine/model/fbd.h"
#include "engine/model/shape.h"
#include "engine/translate/ladder_unit.h"
#include "engine/translate/whole_number.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* A part of an expression that has been computed. */
struct value {
	uint32_t operand;
	enum iec_type type;     /* IEC_NONE: a constant without a type        */
	bool whole;             /* a LINT that was computed from bit strings: not cut yet */
};

struct chain {
	struct ld *ld;
	const struct expr *expr;
	int net;                /* power of the cell                          */
	uint32_t en;            /* of the next operation; 0: none so far      */
	bool can_fail;
	int calls;              /* calls of functions of the project still to come */
	struct infer in;        /* its types                                  */
	bool folds;             /* what an index is made of stays until the element is used */
};

static uint32_t chain_intern(struct chain *c, const char *text, size_t len)
{
	uint32_t id = names_intern(&c->ld->translation->project->names, text,
				   len);

	if (!id)
		c->ld->failed = true;
	return id;
}

/* Removes the blanks from a text; returns its length. */
static size_t drop_blanks(char *text, size_t len)
{
	size_t used = 0;

	for (size_t i = 0; i < len; i++)
		if (text[i] != ' ')
			text[used++] = text[i];
	return used;
}

/* A name as it stands in the cell: `Table[ i ]` is `Table[i]`. */
static uint32_t intern_name(struct chain *c, const char *text, size_t len)
{
	char out[2 * LIMIT_NAME + 1];

	if (!memchr(text, ' ', len) || len >= sizeof(out))
		return chain_intern(c, text, len);
	memcpy(out, text, len);
	return chain_intern(c, out, drop_blanks(out, len));
}

static const struct meaning *meaning(struct chain *c, uint32_t operand)
{
	enum diag_id why;

	return scope_find(c->ld->translation->scope, c->ld->unit->pou, operand,
			  &why);
}

static bool is_bits(enum iec_type type)
{
	return iec_type_row(type)->class & CLASS_BITS;
}

static enum op operator_of(const struct expr_node *node)
{
	return node->op == EXPR_NOT ? OP_NOT : node->op == EXPR_AND ? OP_AND :
	       node->op == EXPR_OR ? OP_OR : OP_XOR;
}

/* Is this a constant of @type? If not, the message shows it without a type. */
static bool fits(const char *text, size_t len, enum iec_type type)
{
	struct literal literal;
	union iec_value value;

	return literal_parse(text, len, &literal) == LITERAL_OK &&
	       literal_fit(&literal, type, &value);
}

/* A constant; with its type in front when no neighbour gives it one. */
static struct value constant(struct chain *c, const char *text, size_t len,
			     bool negative, enum iec_type hint)
{
	char out[LIMIT_NAME + 32];
	const char *word = iec_type_row(hint)->word;
	struct value value = { .type = IEC_NONE };
	bool prefix = hint != IEC_NONE && !memchr(text, '#', len) &&
		      fits(text, len, hint);
	int size = snprintf(out, sizeof(out), "%s%s%s%.*s", prefix ? word : "",
			    prefix ? "#" : "", negative ? "-" : "", (int)len,
			    text);

	if (size < 0 || (size_t)size >= sizeof(out))
		c->ld->failed = true;
	else
		value.operand = chain_intern(c, out, (size_t)size);
	value.type = value.operand ? infer_operand(&c->in, value.operand) : IEC_NONE;
	return value;
}

static bool takes_whole(enum iec_type type)
{
	return iec_type_row(type)->class & ANY_INT || mixed_is_bits(type);
}

/* In a statement: a number of constants alone, such as 60 * 1000, where @type is wanted. */
static bool is_whole_constant(const struct chain *c, int index, enum iec_type type,
			      union iec_value *value)
{
	struct literal literal;

	return !c->ld->rung && takes_whole(type) && whole_compute(c->expr, index, &literal) &&
	       literal_fit(&literal, type, value);
}

static struct value whole_constant(struct chain *c, union iec_value value, enum iec_type type)
{
	char text[32];
	const int len = literal_print(type, value, text, sizeof(text));

	return constant(c, text, (size_t)len, false, type);
}

/* The operand that enables the next operation. */
static uint32_t chain_power(struct chain *c)
{
	if (!c->en) {
		uint16_t row = c->ld->row, col = c->ld->col;

		c->en = c->ld->rung ? ld_operand(c->ld, c->net) : c->ld->true_id;
		c->ld->row = row; /* an error stops at this cell */
		c->ld->col = col;
	}
	c->can_fail = true;
	return c->en;
}

/* One function of two inputs; @target 0: into a temporary of @type. */
static struct value operate(struct chain *c, enum word fn, struct value left,
			    struct value right, enum iec_type type,
			    uint32_t target)
{
	struct ld *ld = c->ld;
	const struct word_row *row = word_row(fn);
	uint32_t en = chain_power(c), eno = temps_bool(ld->temps);
	struct value out = { .operand = target, .type = type };

	if (!target)
		out.operand = temps_number(ld->temps, type);
	ld_call(ld, fn);
	ld_arg(ld, false, ld->en_id, en);
	ld_arg(ld, false, chain_intern(c, row->pin[0].name, strlen(row->pin[0].name)),
	       left.operand);
	if (right.operand)
		ld_arg(ld, false, chain_intern(c, row->pin[1].name,
					 strlen(row->pin[1].name)),
		       right.operand);
	ld_arg(ld, true, ld->eno_id, eno);
	ld_arg(ld, true, ld->out_id, out.operand);
	c->en = eno;
	return out;
}

/* A value that LD cannot take comes from a MOVE, which can fail. */
static struct value settle(struct chain *c, struct value value)
{
	struct value none = { .type = IEC_NONE };

	const struct meaning *m = value.operand ? meaning(c, value.operand) : NULL;

	if (!m || !meaning_is_indexed(m) || meaning_is_whole(m))
		return value;
	return operate(c, FN_MOVE, value, none, value.type, 0);
}

static struct value chain_compute(struct chain *c, int index, enum iec_type hint,
				  uint32_t target);
static struct value compute_raw(struct chain *c, int index, enum iec_type hint, uint32_t target);
static struct value chain_side(struct chain *c, int index, enum iec_type type);

/* ---- bit strings as numbers ---- */

/* @value as a value of @type; a bit string as the number that it is. */
static struct value chain_convert(struct chain *c, struct value value, enum iec_type type,
				  uint32_t target)
{
	const struct value none = { .type = IEC_NONE };

	if ((mixed_is_bits(value.type) && iec_type_row(type)->class == CLASS_REAL) ||
	    (mixed_is_bits(type) && iec_type_row(value.type)->class == CLASS_SIGNED &&
	     iec_type_row(value.type)->size < iec_type_row(type)->size))
		value = operate(c, FN_CONVERT, value, none, IEC_LINT, 0);
	return operate(c, FN_CONVERT, value, none, type, target);
}

/* In plain IEC text, what is computed goes into any number or bit string, as in other tools. */
static bool chain_narrows(const struct chain *c, enum iec_type from, enum iec_type to)
{
	return c->ld->statement && c->ld->translation->project->words.own_first &&
	       mixed_narrows(from, to);
}

/* A pointer, which is of no use in less than its bytes. */
static bool chain_points(struct chain *c, struct value value)
{
	const struct meaning *m = meaning(c, value.operand);

	return m && (m->address_of || (m->kind != MEANING_LITERAL && m->like && m->like->target));
}

/* Is a variable or a result in the expression an LREAL? A REAL and a DINT are computed as one, too. */
static bool has_long(struct chain *c)
{
	for (int i = 0; i < c->expr->count; i++) {
		const enum expr_op op = c->expr->node[i].op;

		if ((op == EXPR_NAME || op == EXPR_INDEX || op == EXPR_CALL || op == EXPR_LITERAL) &&
		    infer_type(&c->in, i) == IEC_LREAL)
			return true;
	}
	return false;
}

/* A warning, unless a whole number becomes a REAL. */
static void say_narrowed(struct chain *c, enum iec_type from, enum iec_type to)
{
	const struct unit *unit = c->ld->unit;
	const struct translation *translation = c->ld->translation;
	const char *at = c->expr->target ? c->expr->target : c->expr->node[c->expr->root].text;
	struct diag place = { .id = DIAG_NARROWED, .file = unit->pou->file, .line = c->ld->line,
			      .pou = project_text(translation->project, unit->pou->name) };

	if (iec_type_row(to)->class == CLASS_REAL &&
	    (iec_type_row(from)->class != CLASS_REAL || !has_long(c)))
		return;
	if (at)
		st_where(&translation->project->names, c->ld->item, at, &place.line, &place.column);
	diag_add(translation->diags, place, "%s" DIAG_AND "%s", iec_type_row(from)->word,
		 iec_type_row(to)->word);
}

/* The same into @target (0: a temporary), if that needs no conversion in the text. */
static struct value chain_fit_into(struct chain *c, struct value value, enum iec_type type,
				   uint32_t target)
{
	if (!c->ld->statement || value.type == type || !value.operand || !type || !value.type ||
	    iec_can_widen(value.type, type))
		return value;
	if (mixed_converts(value.type, type))
		return chain_convert(c, value, type, 0);
	if (!chain_narrows(c, value.type, type) || chain_points(c, value))
		return value;
	say_narrowed(c, value.type, type);
	return chain_convert(c, value, type, target);
}

static struct value chain_fit(struct chain *c, struct value value, enum iec_type type)
{
	return chain_fit_into(c, value, type, 0);
}

/* Cuts the result of bit strings to the width of its place. */
static struct value cut(struct chain *c, struct value value, enum iec_type as, enum iec_type hint,
			uint32_t target)
{
	const uint16_t class = iec_type_row(hint)->class;

	if (class & ANY_NUM || mixed_is_bits(hint))
		as = hint;
	else
		target = 0;
	if (as == IEC_LINT)
		return (struct value){ .operand = value.operand, .type = IEC_LINT };
	return chain_convert(c, value, as, target);
}

/* An operand of an operation in @type. */
static struct value mixed_side(struct chain *c, int index, enum iec_type type)
{
	struct value value = c->expr->node[index].op == EXPR_LITERAL ?
		chain_side(c, index, type) : compute_raw(c, index, type, 0);

	if (value.type == type || value.type == IEC_NONE)
		return value;
	return chain_convert(c, value, type, 0);
}

/* Arithmetic in 64 bits, which no BYTE, WORD or DWORD leaves. */
static struct value compute_mixed(struct chain *c, const struct expr_node *node)
{
	const enum iec_type left = infer_type(&c->in, node->left), right = infer_type(&c->in, node->right);
	const enum iec_type join = mixed_join(left, right);
	const enum iec_type type = iec_type_row(join)->class == CLASS_REAL ? join : IEC_LINT;
	struct value a = mixed_side(c, node->left, type), b = mixed_side(c, node->right, type);
	struct value out = operate(c, node->fn, a, b, type, 0);

	out.whole = type == IEC_LINT;
	return out;
}

/* An input beside one of @type: a bare constant takes that type without help, an operation on
 * constants needs it. */
static struct value chain_side(struct chain *c, int index, enum iec_type type)
{
	const struct expr_node *node = &c->expr->node[index];

	if (node->op == EXPR_NEG)
		node = &c->expr->node[node->left];
	return chain_compute(c, index, node->op == EXPR_LITERAL ? IEC_NONE : type, 0);
}

/* On bit strings: the functions with the operators' names. */
static struct value compute_bits(struct chain *c, const struct expr_node *node,
				 enum iec_type type, uint32_t target)
{
	struct value left, right = { .type = IEC_NONE };

	if (node->op == EXPR_NOT) {
		left = chain_fit(c, chain_compute(c, node->left, type, 0), type);
	} else {
		left = chain_fit(c, chain_side(c, node->left, type), type);
		right = chain_fit(c, chain_side(c, node->right, type), type);
	}
	return operate(c, op_function(operator_of(node)), left, right, type, target);
}

/* AND_THEN, OR_ELSE: the left side enables the operations of the right one, which cannot fail without
 * it. */
static struct value compute_lazy(struct chain *c, const struct expr_node *node)
{
	const struct value left = settle(c, chain_compute(c, node->left, IEC_NONE, 0));
	const uint32_t before = c->en;
	const bool could_fail = c->can_fail;
	const uint32_t power = chain_power(c);
	struct value right, out = { .type = IEC_BOOL };
	uint32_t needed;

	ld_emit(c->ld, OP_LD, node->op == EXPR_OR ? MOD_N : 0, left.operand);
	ld_emit(c->ld, OP_AND, 0, power);
	needed = c->en = ld_store_new(c->ld);
	right = settle(c, chain_compute(c, node->right, IEC_NONE, 0));
	if (c->en == needed) { /* nothing in it can fail */
		c->en = before;
		c->can_fail = could_fail;
	} else {
		const uint32_t good = c->en;

		ld_emit(c->ld, OP_LD, MOD_N, needed);
		ld_emit(c->ld, OP_AND, 0, power);
		ld_emit(c->ld, OP_OR, 0, good);
		c->en = ld_store_new(c->ld);
	}
	ld_emit(c->ld, OP_LD, 0, left.operand);
	ld_emit(c->ld, operator_of(node), 0, right.operand);
	out.operand = ld_store_new(c->ld);
	return out;
}

static struct value compute_logic(struct chain *c, const struct expr_node *node,
				  enum iec_type hint, uint32_t target)
{
	enum iec_type type = infer_logic(&c->in, node);
	struct value left, right, out = { .type = IEC_BOOL };

	if (type == IEC_NONE && is_bits(hint))
		type = hint;
	if (is_bits(type))
		return compute_bits(c, node, type, target);
	if (node->lazy)
		return compute_lazy(c, node);
	left = settle(c, chain_compute(c, node->left, IEC_NONE, 0));
	if (node->op == EXPR_NOT) {
		ld_emit(c->ld, OP_LD, 0, left.operand);
		ld_emit(c->ld, OP_NOT, 0, 0);
	} else {
		right = settle(c, chain_compute(c, node->right, IEC_NONE, 0));
		ld_emit(c->ld, OP_LD, 0, left.operand);
		ld_emit(c->ld, operator_of(node), 0, right.operand);
	}
	out.operand = ld_store_new(c->ld);
	return out;
}

static struct value compute_compare(struct chain *c,
				    const struct expr_node *node)
{
	enum iec_type type = types_join(infer_type(&c->in, node->left),
					infer_type(&c->in, node->right));
	struct value left, right, out = { .type = IEC_BOOL };
	struct il_line line = { .kind = IL_FN, .word = (uint16_t)node->fn };

	if (type == IEC_TYPE_COUNT)
		type = IEC_NONE;
	if (infer_mixes(&c->in, infer_type(&c->in, node->left), infer_type(&c->in, node->right)) && type == IEC_NONE) {
		type = mixed_join(infer_type(&c->in, node->left), infer_type(&c->in, node->right));
		type = iec_type_row(type)->class == CLASS_REAL ? type : IEC_LINT;
		left = mixed_side(c, node->left, type);
		right = mixed_side(c, node->right, type);
	} else {
		type = mixed_is_bits(type) && c->ld->statement && type != IEC_LWORD ? IEC_DWORD : type;
		left = chain_side(c, node->left, type);
		right = chain_side(c, node->right, type);
	}
	left = settle(c, left);
	right = settle(c, right);
	ld_emit(c->ld, OP_LD, 0, left.operand);
	line.operand = right.operand;
	ld_emit_line(c->ld, line);
	out.operand = ld_store_new(c->ld);
	return out;
}

/* Times and dates: each side has its own type. */
static struct value compute_overload(struct chain *c, const struct expr_node *node,
				     enum word word, enum iec_type type,
				     uint32_t target)
{
	struct value left = chain_compute(c, node->left, IEC_NONE, 0);
	struct value right = chain_compute(c, node->right, IEC_NONE, 0);

	return operate(c, word, left, right, type, target);
}

static bool is_integer(enum iec_type type)
{
	return iec_type_row(type)->class & ANY_INT;
}

/* Base and exponent are integers: so is the power. It is computed as an LREAL. */
static struct value compute_power(struct chain *c, int base, int exponent, enum iec_type hint,
				  uint32_t target)
{
	const struct value none = { .type = IEC_NONE };
	enum iec_type type = infer_power(&c->in, base, exponent);
	struct value left = chain_side(c, base, IEC_LREAL), right, out;

	if (left.type != IEC_LREAL)
		left = operate(c, FN_CONVERT, left, none, IEC_LREAL, 0);
	right = chain_side(c, exponent, IEC_DINT);
	if (type == IEC_NONE || (hint != IEC_NONE && types_join(type, hint) == hint))
		type = hint == IEC_NONE ? IEC_DINT : hint;
	out = operate(c, FN_EXPT, left, right, IEC_LREAL, type == IEC_LREAL ? target : 0);
	return type == IEC_LREAL ? out : operate(c, FN_CONVERT, out, none, type, target);
}

/* Base ** exponent; one of them is REAL. */
static struct value compute_root(struct chain *c, int base, int exponent, enum iec_type hint,
				 uint32_t target)
{
	const struct value none = { .type = IEC_NONE };
	enum iec_type type = infer_power(&c->in, base, exponent);
	struct value left, right;

	if (type == IEC_REAL && hint == IEC_LREAL)
		type = hint;
	left = chain_side(c, base, type);
	if (is_integer(left.type))
		left = operate(c, FN_CONVERT, left, none, type, 0);
	right = chain_side(c, exponent, c->expr->node[exponent].op == EXPR_LITERAL &&
			   infer_type(&c->in, exponent) == IEC_NONE ? IEC_DINT : IEC_NONE);
	return operate(c, FN_EXPT, left, right, type, target);
}

static struct value compute_fn(struct chain *c, const struct expr_node *node,
			       int index, enum iec_type hint, uint32_t target)
{
	enum iec_type type = infer_wanted(&c->in, index, hint);
	struct value left, right;
	union iec_value number;
	enum word word;

	if (word_is_test(word_row(node->fn)))
		return compute_compare(c, node);
	if (is_whole_constant(c, index, hint, &number))
		return whole_constant(c, number, hint);
	if (node->fn == FN_EXPT)
		return infer_is_power(&c->in, node->left, node->right) ?
			compute_power(c, node->left, node->right, hint, target) :
			compute_root(c, node->left, node->right, hint, target);
	infer_type(&c->in, index); /* it may turn the sides */
	word = fn_overload(node->fn, infer_type(&c->in, node->left), infer_type(&c->in, node->right));
	if (word != node->fn)
		return compute_overload(c, node, word, type, target);
	if (infer_mixes(&c->in, infer_type(&c->in, node->left), infer_type(&c->in, node->right)))
		return compute_mixed(c, node);
	if (type != IEC_NONE && infer_is_roomy(&c->in, node)) { /* the constant says the type */
		left = chain_compute(c, node->left, type, 0);
		right = chain_compute(c, node->right, type, 0);
	} else if (type) {
		left = chain_side(c, node->left, type);
		right = chain_side(c, node->right, type);
	} else {
		left = chain_compute(c, node->left, hint, 0);
		right = chain_compute(c, node->right, hint, 0);
		type = hint ? hint : types_join(left.type, right.type);
	}
	if (type == IEC_NONE || type == IEC_TYPE_COUNT)
		type = IEC_DINT;
	return operate(c, node->fn, left, right, type, target);
}

/* ---- elements ---- */

#define INDEX_LINES 6 /* of a sum: the call, EN, its inputs, ENO, OUT */

/* i + 1, 1 + i, i - 1. */
static bool is_shifted(const struct chain *c, const struct expr_node *node)
{
	const struct expr_node *left = node->left < 0 ? NULL : &c->expr->node[node->left];
	const struct expr_node *right = node->right < 0 ? NULL : &c->expr->node[node->right];

	if (node->op != EXPR_FN || !left || !right)
		return false;
	if (node->fn == FN_ADD && left->op == EXPR_LITERAL)
		return right->op == EXPR_NAME;
	return (node->fn == FN_ADD || node->fn == FN_SUB) && left->op == EXPR_NAME &&
	       right->op == EXPR_LITERAL;
}

/* Where the sum overflows there is no such element. */
static bool holds_all(const struct var_array *array, enum iec_type type, int64_t by)
{
	const struct iec_type_row *row = iec_type_row(type);

	return array->low >= row->low && (int64_t)array->low + array->count - 1 <= row->high &&
	       by > -LIMIT_ELEMENTS && by < LIMIT_ELEMENTS && array->low - by >= INT32_MIN &&
	       array->low - by <= INT32_MAX;
}

/* The index of @element was computed by the lines from @from on: if it is a variable and a constant,
 * its bounds can take the constant. */
static void fold_index(struct chain *c, const struct expr_node *node, int from, uint32_t element)
{
	const struct meaning *m = meaning(c, element), *of = NULL, *by = NULL, *in;
	struct il *il = c->ld->il;
	struct il_line *call = from < il->count ? &il->line[from] : NULL;

	if (!c->folds || !is_shifted(c, node) || !m || !m->opens || m->through || !call ||
	    call->kind != IL_CALL || il->count != from + INDEX_LINES)
		return;
	for (int i = from; i < il->count; i++) {
		if (il->line[i].kind != IL_ARG_IN || il->line[i].pin == c->ld->en_id)
			continue;
		in = meaning(c, il->line[i].operand);
		*(in && in->kind == MEANING_LITERAL ? &by : &of) = in;
	}
	if (of && by && of->kind == MEANING_VARIABLE && !meaning_is_indexed(of) &&
	    (of->type == IEC_INT || of->type == IEC_DINT) && m->open[m->opens - 1].of->type == of->type &&
	    holds_all(&m->open[m->opens - 1].array, of->type, by->literal.value.i) && !by->several)
		call->mark |= IL_INDEX;
}

/* `Table[index].Member`, after the index has been computed. */
static uint32_t compute_element(struct chain *c, const struct expr_node *node)
{
	const struct names *names = &c->ld->translation->project->names;
	uint32_t base = node->right < 0 ? chain_intern(c, node->text, node->len) :
			compute_element(c, &c->expr->node[node->right]);
	const struct expr_tail tail = node->tail;
	const bool bits = infer_mixes(&c->in, infer_type(&c->in, node->left), IEC_NONE);
	const int from = c->ld->il->count;
	struct value index = chain_compute(c, node->left, bits ? IEC_DWORD : IEC_NONE, 0);
	struct value none = { .type = IEC_NONE };
	char text[3 * LIMIT_NAME + 12 * LIMIT_INDICES];
	int size;

	const struct meaning *of = meaning(c, index.operand);

	if (strchr(names_text(names, index.operand), '[') || (of && of->through))
		index = operate(c, FN_MOVE, index, none, index.type, 0);
	size = snprintf(text, sizeof(text), "%s[%s]%.*s", names_text(names, base),
			names_text(names, index.operand), (int)tail.len,
			tail.len ? tail.text : "");
	if (!index.operand || !base || size < 0 || (size_t)size >= sizeof(text)) {
		c->ld->failed = true;
		return 0;
	}
	base = chain_intern(c, text, drop_blanks(text, (size_t)size));
	fold_index(c, &c->expr->node[node->left], from, base);
	return base;
}

/* The operand of a variable or element, as it is. */
static struct value chain_place(struct chain *c, int index)
{
	const struct expr_node *node = &c->expr->node[index];
	struct value value = { .type = IEC_NONE };

	value.operand = node->op == EXPR_INDEX ? compute_element(c, node) :
			intern_name(c, node->text, node->len);
	value.type = node->op == EXPR_INDEX ? infer_type(&c->in, index) :
		     infer_operand(&c->in, value.operand);
	return value;
}

/* ---- parts of bit strings and integers ---- */

static void fn_line(struct chain *c, enum word word, uint32_t operand)
{
	ld_emit_line(c->ld, (struct il_line){ .kind = IL_FN, .word = (uint16_t)word,
					      .mark = IL_MADE, .operand = operand });
}

/* Makes the result, a value of @from, one of @to. */
static void convert_result(struct chain *c, enum iec_type from, enum iec_type to)
{
	if (from != to)
		fn_line(c, words_conversion(&c->ld->translation->project->words, from, to), 0);
}

static uint32_t bits_constant(struct chain *c, enum iec_type type, uint64_t bits)
{
	char text[48];
	const unsigned int size = iec_type_row(type)->size;

	if (size < 8)
		bits &= (UINT64_C(1) << 8 * size) - 1;
	return chain_intern(c, text, (size_t)snprintf(text, sizeof(text), "%s#16#%" PRIX64,
						      iec_type_row(type)->word, bits));
}

static uint32_t number_constant(struct chain *c, unsigned int number)
{
	char text[16];

	return chain_intern(c, text, (size_t)snprintf(text, sizeof(text), "%u", number));
}

static struct value compute_bit(struct chain *c, const struct expr_node *node)
{
	const struct value from = settle(c, chain_place(c, node->left));
	const enum iec_type all = infer_bits(8u * iec_type_row(from.type)->size);
	struct value out = { .type = IEC_BOOL };
	unsigned int bits, number;

	if (!expr_part(node->tail, &bits, &number) || from.type == IEC_NONE) {
		c->ld->failed = true;
		return out;
	}
	ld_emit(c->ld, OP_LD, 0, from.operand);
	convert_result(c, from.type, all);
	if (bits == 1) {
		fn_line(c, op_function(OP_AND), bits_constant(c, all, UINT64_C(1) << number));
		fn_line(c, FN_NE, bits_constant(c, all, 0));
		out.operand = ld_store_new(c->ld);
		return out;
	}
	out.type = infer_bits(bits);
	if (number)
		fn_line(c, FN_SHR, number_constant(c, number * bits));
	convert_result(c, all, out.type);
	out.operand = temps_number(c->ld->temps, out.type);
	ld_emit(c->ld, OP_ST, 0, out.operand);
	return out;
}

/* The value of @target with @value as its part @tail. */
static struct value put_bit(struct chain *c, uint32_t target, struct expr_tail tail,
			    struct value value)
{
	const struct value from = settle(c, (struct value){ .operand = target, .type = infer_operand(&c->in, target) });
	const enum iec_type all = infer_bits(8u * iec_type_row(from.type)->size);
	struct value out = { .type = from.type };
	unsigned int bits, number;
	uint32_t part;

	if (!expr_part(tail, &bits, &number) || from.type == IEC_NONE) {
		c->ld->failed = true;
		return out;
	}
	part = temps_number(c->ld->temps, all);
	ld_emit(c->ld, OP_LD, 0, value.operand);
	convert_result(c, infer_bits(bits), all);
	if (number)
		fn_line(c, FN_SHL, number_constant(c, number * bits));
	ld_emit(c->ld, OP_ST, 0, part);
	ld_emit(c->ld, OP_LD, 0, from.operand);
	convert_result(c, from.type, all);
	fn_line(c, op_function(OP_AND), bits_constant(c, all,
		~((bits == 64 ? UINT64_MAX : (UINT64_C(1) << bits) - 1) << number * bits)));
	fn_line(c, op_function(OP_OR), part);
	convert_result(c, all, from.type);
	out.operand = temps_number(c->ld->temps, from.type);
	ld_emit(c->ld, OP_ST, 0, out.operand);
	return out;
}

/* What @target becomes; it is computed into @to. */
static struct value chain_assigned(struct chain *c, uint32_t target, uint32_t to)
{
	const struct expr_tail tail = c->expr->target_bit;
	unsigned int bits = 1, number;
	enum iec_type type;

	if (!tail.len)
		return chain_compute(c, c->expr->root, infer_operand(&c->in, target), to);
	expr_part(tail, &bits, &number);
	type = infer_bits(bits);
	return put_bit(c, target, tail,
		       settle(c, chain_fit(c, chain_compute(c, c->expr->root, type, 0), type)));
}

/* Is it a variable, or a part of one, that a => of the expression writes? */
static bool is_output(struct chain *c, const struct meaning *m)
{
	for (int i = 0; m->var && i < c->expr->count; i++) {
		const struct expr_node *arg = &c->expr->node[i], *to;
		const struct meaning *written;

		if (arg->op != EXPR_ARG || !arg->output)
			continue;
		to = &c->expr->node[arg->left];
		written = meaning(c, to->op == EXPR_INDEX ?
				  scope_first_of(c->ld->translation->scope, c->ld->unit->pou, c->expr, to) :
				  chain_intern(c, to->text, to->len));
		if (written && written->var == m->var)
			return true;
	}
	return false;
}

/* Freezes what the bodies of functions further right may write, and what stands behind a =>. */
static struct value keep_value(struct chain *c, struct value value)
{
	const struct value none = { .type = IEC_NONE };
	const struct meaning *m = value.operand ? meaning(c, value.operand) : NULL;

	if (!m || m->kind == MEANING_LITERAL || meaning_is_whole(m))
		return value;
	if ((!c->calls || (m->pou && !m->through)) && !is_output(c, m))
		return value;
	return operate(c, FN_MOVE, value, none, value.type, 0);
}

/* ---- calls ---- */

static bool is_part(const struct chain *c, int index)
{
	return c->expr->node[index].op == EXPR_BIT;
}

/* `Left => Word.%B1`: what the call left in @from goes to a part of a number. */
static void store_part(struct chain *c, int index, uint32_t from, bool inverted)
{
	const struct expr_node *node = &c->expr->node[index];
	const struct value none = { .type = IEC_NONE };
	struct value place = chain_place(c, node->left), value = { .operand = from, .type = infer_operand(&c->in, from) };
	unsigned int bits = 1, number;

	expr_part(node->tail, &bits, &number);
	if (inverted) {
		ld_emit(c->ld, OP_LD, MOD_N, from);
		value.operand = ld_store_new(c->ld);
	}
	value = put_bit(c, place.operand, node->tail, chain_fit(c, value, infer_bits(bits)));
	operate(c, FN_MOVE, value, none, value.type, place.operand);
}

/* @in by argument. Into a temporary, if there is no @target. */
static struct value emit_call(struct chain *c, enum word word, const struct expr_args *args,
			      const struct value in[LIMIT_ARGS], const uint32_t other[LIMIT_ARGS],
			      struct value out)
{
	struct ld *ld = c->ld;
	const struct word_row *row = ld_row(ld, word);
	uint32_t en = chain_power(c), eno = temps_bool(ld->temps);

	ld_emit_line(ld, (struct il_line){ .kind = IL_CALL, .word = (uint16_t)word,
					   .mark = IL_NAMED });
	ld_arg(ld, false, ld->en_id, en);
	for (int i = 0; i < args->count; i++) {
		char name[24];
		int len = expr_pin_name(row, args->arg[i].pin, name, sizeof(name));
		uint32_t pin = args->arg[i].pin < row->pin_count ?
			chain_intern(c, row->pin[args->arg[i].pin].name,
				     strlen(row->pin[args->arg[i].pin].name)) :
			chain_intern(c, name, (size_t)len);

		ld_arg(ld, false, pin, in[i].operand);
	}
	for (int i = 0; i < args->more; i++)
		if (args->other[i].pin >= 0 && other[i])
			ld_arg(ld, true, chain_intern(c, row->pin[args->other[i].pin].name,
				strlen(row->pin[args->other[i].pin].name)), other[i]);
	ld_arg(ld, true, ld->eno_id, eno);
	ld_arg(ld, true, chain_intern(c, words_result(row), strlen(words_result(row))), out.operand);
	for (int i = 0; i < args->more; i++)
		if (is_part(c, args->other[i].at)) {
			c->en = args->other[i].pin == EXPR_ENO ? 0 : eno; /* ENO is stored in any case */
			store_part(c, args->other[i].at, args->other[i].pin == EXPR_ENO ? eno :
				   args->other[i].pin == EXPR_OUT ? out.operand : other[i], args->other[i].inverted);
		} else if (args->other[i].pin == EXPR_ENO || args->other[i].pin == EXPR_OUT) {
			ld_emit(ld, OP_LD, 0, args->other[i].pin == EXPR_ENO ? eno : out.operand);
			ld_emit(ld, OP_ST, args->other[i].inverted ? MOD_N : 0, other[i]);
		} else if (args->other[i].inverted) {
			/* It was stored if ENO is TRUE. */
			ld_emit(ld, OP_LD, 0, other[i]);
			ld_emit(ld, OP_XOR, 0, eno);
			ld_emit(ld, OP_ST, 0, other[i]);
		}
	c->en = eno;
	return out;
}

/* The condition of EN, which also keeps what follows from being computed. */
static void chain_enable(struct chain *c, int index)
{
	const struct value value = settle(c, chain_compute(c, index, IEC_BOOL, 0));
	const uint32_t en = chain_power(c);

	ld_emit(c->ld, OP_LD, 0, value.operand);
	ld_emit(c->ld, OP_AND, 0, en);
	c->en = ld_store_new(c->ld);
}

/* A temporary for an output that goes to a part of a number; ENO and the result are there anyway. */
static uint32_t part_value(struct chain *c, const struct word_row *row, int pin)
{
	if (pin < 0 || pin >= row->pin_count || row->pin[pin].type == IEC_NONE)
		return 0;
	return row->pin[pin].type == IEC_BOOL ? temps_bool(c->ld->temps) : temps_number(c->ld->temps, row->pin[pin].type);
}

/* EN and the places behind =>. */
static void take_others(struct chain *c, const struct word_row *row, const struct expr_args *args,
			uint32_t other[LIMIT_ARGS])
{
	for (int i = 0; i < args->more; i++) {
		other[i] = 0;
		if (args->other[i].pin == EXPR_EN) {
			chain_enable(c, args->other[i].at);
			continue;
		}
		if (is_part(c, args->other[i].at)) {
			other[i] = part_value(c, row, args->other[i].pin);
			continue;
		}
		other[i] = chain_place(c, args->other[i].at).operand;
		ld_freeze(c->ld, other[i]);
	}
}

static bool is_whole(const struct word_pin *pin)
{
	return pin->elements || pin->type == IEC_NONE;
}

/* A function of the project: each argument has its pin's type; a VAR_IN_OUT is the variable
 * itself. */
static struct value call_own(struct chain *c, enum word word, const struct expr_args *args,
			     uint32_t target)
{
	struct ld *ld = c->ld;
	const struct word_row *row = ld_row(ld, word);
	const struct var *result = infer_result(&c->in, word);
	const bool array = result && result->array.count;
	struct value in[LIMIT_ARGS], out = {
		.operand = target, .type = result && !array ? result->type : IEC_NONE };
	uint32_t more[LIMIT_ARGS];

	take_others(c, row, args, more);
	for (int i = 0; i < args->count; i++) {
		const struct word_pin *pin = &row->pin[args->arg[i].pin];
		bool place = is_whole(pin) || pin->dir == PIN_IN_OUT;

		if (place && c->expr->node[args->arg[i].at].op == EXPR_CALL)
			in[i] = chain_compute(c, args->arg[i].at, IEC_NONE, 0);
		else
			in[i] = place ? chain_place(c, args->arg[i].at) :
				chain_fit(c, chain_side(c, args->arg[i].at, pin->type),
					  pin->type);
		if (pin->dir == PIN_IN_OUT)
			ld_freeze(ld, in[i].operand);
	}
	c->calls--;
	ld_freeze_globals(ld);
	if (!out.operand && result && result->type != IEC_NONE && !array)
		out.operand = temps_number(ld->temps, result->type);
	else if (!out.operand && result)
		out.operand = temps_whole(ld->temps, &(struct meaning){
			.kind = array ? MEANING_ARRAY : MEANING_STRUCT, .type = result->type,
			.array = result->array, .dim = result->dim, .dims = result->dims,
			.capacity = result->capacity, .word = (uint16_t)result->fb });
	return emit_call(c, word, args, in, more, out);
}

/* At a pin of a function of the catalogue, whose shared pins get @given. */
static struct value argument(struct chain *c, int index, const struct word_pin *pin,
			     enum iec_type given)
{
	struct value value = chain_side(c, index, pin->own ? IEC_NONE : given);
	enum iec_type type = pin->type ? pin->type : pin->own ?
		mixed_pin(pin->classes, value.type) : given;

	if (!c->ld->statement || !value.type || !type || value.type == type)
		return value;
	if (iec_can_widen(value.type, type) && iec_type_row(value.type)->class & pin->classes)
		return value;
	if (pin->own || mixed_converts(value.type, type) ||
	    mixed_pin(iec_type_row(type)->class, value.type) == type)
		return chain_convert(c, value, type, 0);
	return iec_type_row(type)->class & pin->classes ? chain_fit(c, value, type) : value;
}

/* A comparison of several: each with the next. */
__attribute__((noinline))
static struct value call_tests(struct chain *c, enum word word, const struct expr_args *args)
{
	const enum iec_type type = infer_shared(&c->in, ld_row(c->ld, word), args);
	struct value in[LIMIT_FN_ARGS], out = { .type = IEC_BOOL };

	for (int i = 0; i < args->count; i++)
		in[args->arg[i].pin] = settle(c, chain_side(c, args->arg[i].at, type));
	for (int i = 1; i < args->count; i++) {
		ld_emit(c->ld, OP_LD, 0, in[i - 1].operand);
		ld_emit_line(c->ld, (struct il_line){ .kind = IL_FN, .word = (uint16_t)word,
						      .operand = in[i].operand });
		if (out.operand)
			ld_emit(c->ld, OP_AND, 0, out.operand);
		out.operand = ld_store_new(c->ld);
	}
	return out;
}

/* The operator that the function is; OP_COUNT: it is none. */
static enum op logic_of(enum word word)
{
	static const enum op ops[] = { OP_AND, OP_OR, OP_XOR };

	for (size_t i = 0; i < sizeof(ops) / sizeof(*ops); i++)
		if (word == op_function(ops[i]))
			return ops[i];
	return OP_COUNT;
}

/* AND(a, b, c) of BOOLs: as an operator, without EN and ENO. */
__attribute__((noinline))
static struct value call_logic(struct chain *c, enum op op, const struct expr_args *args)
{
	struct value in[LIMIT_FN_ARGS], out = { .type = IEC_BOOL };

	for (int i = 0; i < args->count; i++)
		in[args->arg[i].pin] = settle(c, chain_side(c, args->arg[i].at, IEC_BOOL));
	ld_emit(c->ld, OP_LD, 0, in[0].operand);
	for (int i = 1; i < args->count; i++)
		ld_emit(c->ld, op, 0, in[i].operand);
	out.operand = ld_store_new(c->ld);
	return out;
}

/* Do the inputs have one type that can be compared without EN and ENO: no text, no number with a point? */
static bool tests_plain(struct chain *c, enum word word, const struct expr_args *args)
{
	const enum iec_type type = infer_shared(&c->in, ld_row(c->ld, word), args);

	for (int i = 0; i < args->count; i++) {
		const enum iec_type is = infer_type(&c->in, args->arg[i].at);

		if (is != type && is != IEC_NONE)
			return false;
	}
	return iec_type_row(type)->class & ANY_INT;
}

/* Of the catalogue. */
static struct value call_known(struct chain *c, enum word word, const struct expr_args *args,
			       int index, enum iec_type hint, uint32_t target)
{
	const struct word_row *row = ld_row(c->ld, word);
	enum word runs = infer_overload(&c->in, word, args);
	enum iec_type type = infer_work(&c->in, row, args), given;
	const enum iec_type back = infer_back(infer_shared(&c->in, row, args), type);
	const bool other = word_shares(row) && back != type;
	struct value in[LIMIT_ARGS], out = { .operand = other ? 0 : target };
	uint32_t more[LIMIT_ARGS];

	take_others(c, row, args, more);
	if (type == IEC_REAL && word_shares(row))
		type = infer_wanted(&c->in, index, hint);

	given = type ? type : word_shares(row) ? hint : IEC_NONE;
	for (int i = 0; i < args->count; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)args->arg[i].pin);

		in[i] = argument(c, args->arg[i].at, pin, runs == word ? given : IEC_NONE);
		if (!pin->own && !type)
			given = types_join(given, in[i].type);
	}
	if (given == IEC_NONE || given == IEC_TYPE_COUNT)
		given = IEC_DINT;
	if (runs != word)
		given = infer_type(&c->in, args->arg[0].at);
	out.type = fn_result(ld_row(c->ld, runs), given, hint);
	if (!out.operand)
		out.operand = temps_number(c->ld->temps, out.type);
	out = emit_call(c, word, args, in, more, out);
	return other ? chain_convert(c, out, back, target) : out;
}

/* ---- pointers ---- */

/* The operand @sign and @len bytes of @text. */
static uint32_t signed_operand(struct chain *c, char sign, const char *text, size_t len)
{
	char *both = arena_alloc(c->ld->scratch, len + 2);

	if (!both) {
		c->ld->failed = true;
		return 0;
	}
	both[0] = sign;
	memcpy(both + 1, text, len);
	return chain_intern(c, both, 1 + drop_blanks(both + 1, len));
}

/* @bytes more, as a LINT. */
static struct value whole_term(struct chain *c, int64_t bytes)
{
	char text[32];
	const int len = snprintf(text, sizeof(text), "LINT#%" PRId64, bytes);

	return (struct value){ .operand = chain_intern(c, text, (size_t)len), .type = IEC_LINT };
}

/* The next computed index in the text of a place; the text goes behind it. */
static struct value next_computed(struct chain *c, const char **at)
{
	struct value value = { .type = IEC_NONE };
	const struct meaning *m;

	while ((*at = strpbrk(*at, "[,"))) {
		const char *text = *at + 1 + strspn(*at + 1, " ");
		size_t len = strcspn(text, ",]");

		*at = text;
		while (len && text[len - 1] == ' ')
			len--;
		value.operand = chain_intern(c, text, len);
		m = meaning(c, value.operand);
		value.type = m ? m->type : IEC_NONE;
		if (!m || (m->kind != MEANING_LITERAL && !(m->constant && m->var->has_init)))
			break;
	}
	return value;
}

/* The offset that computed indices or a pointer add to a known place. */
static struct value place_behind(struct chain *c, uint32_t place, const struct meaning *m)
{
	const struct value none = { .type = IEC_NONE };
	const char *text = names_text(&c->ld->translation->project->names, place), *at = text;
	const size_t head = strcspn(text, m->through ? "^" : "[");
	const bool reference = m->through && !text[head]; /* its name is what it leads to */
	const size_t len = reference ? strcspn(text, ".[") : head;
	const uint32_t id = m->through && !reference ? chain_intern(c, text, len) :
			    signed_operand(c, reference ? '@' : '&', text, len);
	const struct meaning *from = meaning(c, m->through ? id : chain_intern(c, text, len));
	struct value sum = { .operand = id, .type = IEC_LWORD };

	if (!from || !meaning(c, id)) {
		c->ld->failed = true;
		return none;
	}
	sum = operate(c, FN_CONVERT, sum, none, IEC_LINT, 0);
	if (m->offset != (m->through ? 0 : from->offset))
		sum = operate(c, FN_ADD, sum, whole_term(c, (int64_t)m->offset - (m->through ? 0 : from->offset)),
			      IEC_LINT, 0);
	for (int i = 0; i < m->opens; i++) {
		struct value index = next_computed(c, &at);

		if (index.type != IEC_LINT)
			index = operate(c, FN_CONVERT, index, none, IEC_LINT, 0);
		index = operate(c, FN_SUB, index, whole_term(c, m->open[i].array.low), IEC_LINT, 0);
		index = operate(c, FN_MUL, index, whole_term(c, m->open[i].stride), IEC_LINT, 0);
		sum = operate(c, FN_ADD, sum, index, IEC_LINT, 0);
	}
	return operate(c, FN_CONVERT, sum, none, IEC_LWORD, 0);
}

/* ADR. */
static struct value chain_place_of(struct chain *c, int index)
{
	const bool folds = c->folds;

	c->folds = false; /* its index is a number */
	const uint32_t place = chain_place(c, index).operand;
	c->folds = folds;
	const struct meaning *m = meaning(c, place);
	const char *text = names_text(&c->ld->translation->project->names, place);

	if (m && meaning_is_indexed(m))
		return place_behind(c, place, m);
	return (struct value){ .operand = signed_operand(c, '&', text, strlen(text)), .type = IEC_LWORD };
}

/* __ISVALIDREF: does the reference lead anywhere? */
static struct value chain_valid(struct chain *c, const struct expr_node *of)
{
	struct value out = { .type = IEC_BOOL };
	const uint32_t name = intern_name(c, of->text, of->len);
	const struct meaning *m = meaning(c, name);

	/* The name of a reference is what it leads to; that of a pointer is the pointer. */
	ld_emit(c->ld, OP_LD, 0, m && m->through ? signed_operand(c, '@', of->text, of->len) : name);
	fn_line(c, FN_NE, chain_intern(c, "NULL", 4));
	out.operand = ld_store_new(c->ld);
	return out;
}

static struct value chain_measure(struct chain *c, const struct expr_node *of, enum expr_measure what,
				  enum iec_type hint)
{
	const struct meaning *m;
	char text[24];
	int len;

	if (what == MEASURE_PLACE)
		return chain_place_of(c, (int)(of - c->expr->node));
	if (what == MEASURE_VALID)
		return chain_valid(c, of);
	m = meaning(c, intern_name(c, of->text, of->len));
	len = snprintf(text, sizeof(text), "%lu",
		       (unsigned long)(m ? scope_bytes(c->ld->translation->scope, m) :
				       scope_type_bytes(c->ld->translation->scope, of->text, of->len)));
	return constant(c, text, (size_t)len, false, hint);
}

/* LOWER_BOUND, UPPER_BOUND */
static struct value chain_bound(struct chain *c, const struct expr_bound *bound, enum iec_type hint)
{
	int64_t value = 0;
	char text[24];
	int len;

	if (!bound_value(c->ld->translation->scope, c->ld->unit->pou, c->ld->expr, bound, &value))
		c->ld->failed = true;
	len = snprintf(text, sizeof(text), "%lld", (long long)value);
	return constant(c, text, (size_t)len, false, hint);
}

/* TIME(): milliseconds in 32 bits, which begin again at 0. */
static struct value chain_clock(struct chain *c)
{
	struct ld *ld = c->ld;
	const struct value none = { .type = IEC_NONE };
	const struct value mask = { .operand = chain_intern(c, "LWORD#16#FFFFFFFF", 17),
				    .type = IEC_LWORD };
	const uint32_t last = temps_number(ld->temps, IEC_TIME), no = chain_intern(c, "FALSE", 5);
	struct value now = { .operand = temps_number(ld->temps, IEC_TIME), .type = IEC_TIME };
	const struct { const char *pin; uint32_t operand; } arg[] = {
		{ "HOLD", no }, { "X", temps_bool(ld->temps) },
		{ "T", temps_number(ld->temps, IEC_TIME) },
	};

	ld_emit(ld, OP_LD, 0, no);
	ld_emit(ld, OP_ST, 0, arg[1].operand); /* nothing else is counted */
	ld_emit(ld, OP_LD, 0, chain_intern(c, "T#0s", 4));
	ld_emit(ld, OP_ST, 0, last);
	ld_emit_line(ld, (struct il_line){ .kind = IL_TICK, .operand = now.operand, .pin = last,
					   .word = 1 });
	for (size_t i = 0; i < sizeof(arg) / sizeof(*arg); i++)
		ld_arg(ld, false, chain_intern(c, arg[i].pin, strlen(arg[i].pin)), arg[i].operand);
	now = operate(c, FN_CONVERT, now, none, IEC_LWORD, 0);
	now = operate(c, FN_AND, now, mask, IEC_LWORD, 0);
	return operate(c, FN_CONVERT, now, none, IEC_TIME, 0);
}

/* PREVIOUS(Wire): what it was at the end of the scan before. */
__attribute__((noinline))
static struct value chain_before(struct chain *c, const struct expr_node *wire)
{
	struct value value = { .operand = fbd_wire_name(&c->ld->translation->project->names, wire->text, wire->len,
							c->ld->fbd - 1, true) };

	value.type = infer_operand(&c->in, value.operand);
	return value;
}

/* R_EDGE(value), F_EDGE(value): a hidden variable keeps what the value was. */
__attribute__((noinline))
static struct value chain_edge(struct chain *c, const struct expr_node *call, const struct expr_node *of,
			       bool rising)
{
	struct ld *ld = c->ld;
	struct names *names = &ld->translation->project->names;
	const int item = (int)(ld->item - ld->unit->pou->st->item);
	const uint32_t memory = fbd_edge_name(names, ld->fbd - 1, fbd_edge_number(names, ld->unit->pou, ld->fbd - 1,
										   item, call->text));
	const struct value value = settle(c, chain_compute(c, (int)(of - c->expr->node), IEC_BOOL, 0));
	struct value out = { .type = IEC_BOOL };

	ld_emit(ld, OP_LD, rising ? 0 : MOD_N, value.operand);
	ld_emit(ld, OP_AND, rising ? MOD_N : 0, memory);
	if (c->can_fail)
		ld_emit(ld, OP_AND, 0, c->en);
	out.operand = ld_store_new(ld);
	ld_emit(ld, OP_LD, 0, value.operand);
	if (c->can_fail) { /* what could not be computed is not remembered */
		ld_emit(ld, OP_AND, 0, c->en);
		ld_emit(ld, OP_OR, MOD_PAREN, memory);
		ld_emit(ld, OP_AND, MOD_N, c->en);
		ld_emit_line(ld, (struct il_line){ .kind = IL_CLOSE });
	}
	ld_emit(ld, OP_ST, 0, memory);
	return out;
}

static struct value chain_call(struct chain *c, int index, enum iec_type hint,
			       uint32_t target)
{
	const struct expr_node *node = &c->expr->node[index];
	enum word word = infer_function(&c->in, node);
	struct value none = { .type = IEC_NONE };
	const struct expr_node *of;
	struct expr_args args;
	struct expr_bound bound;
	enum expr_measure what;
	struct expr_node *fbd_of;
	enum fbd_word fbd = word == WORD_COUNT && c->ld->fbd ? fbd_word(c->ld->expr, node, &fbd_of) : FBD_NO_WORD;

	if (fbd == FBD_PREVIOUS)
		return chain_before(c, fbd_of);
	if (fbd != FBD_NO_WORD)
		return chain_edge(c, node, fbd_of, fbd == FBD_RISING);
	if (word == WORD_COUNT && expr_is_clock(node))
		return chain_clock(c);
	if (word == WORD_COUNT && (of = expr_measured(c->ld->expr, node, &what)))
		return chain_measure(c, of, what, hint);
	if (word == WORD_COUNT && expr_bound(c->ld->expr, node, &bound))
		return chain_bound(c, &bound, hint);
	if (word == WORD_COUNT ||
	    expr_match(c->expr, node, ld_row(c->ld, word), &args) != DIAG_COUNT) {
		c->ld->failed = true;
		return none;
	}
	if (infer_is_whole_power(&c->in, word, &args) &&
	    (!(iec_type_row(hint)->class & CLASS_REAL) || is_integer(infer_type(&c->in, args.arg[0].at))))
		return compute_power(c, args.arg[0].at, args.arg[1].at, hint, target);
	if (infer_is_root(&c->in, word, &args))
		return compute_root(c, args.arg[0].at, args.arg[1].at, hint, target);
	if (!word_is_own(word) && word_is_test(ld_row(c->ld, word)) &&
	    (args.count > ld_row(c->ld, word)->most_inputs ||
	     (c->ld->fbd && args.count > 1 && !args.more && tests_plain(c, word, &args))))
		return call_tests(c, word, &args);
	if (c->ld->fbd && !args.more && logic_of(word) != OP_COUNT &&
	    infer_shared(&c->in, ld_row(c->ld, word), &args) == IEC_BOOL)
		return call_logic(c, logic_of(word), &args);
	return word_is_own(word) ? call_own(c, word, &args, target) :
				   call_known(c, word, &args, index, hint, target);
}

static struct value compute_neg(struct chain *c, const struct expr_node *node,
				enum iec_type hint, uint32_t target);

/* In a statement the next instructions come from the place of @text. */
static void chain_at(struct chain *c, const char *text)
{
	struct ld *ld = c->ld;
	int column;

	if (ld->rung || !text)
		return;
	st_where(&ld->translation->project->names, ld->item, text, &ld->line, &column);
	ld->row = ld->col = column > UINT16_MAX ? 0 : (uint16_t)column;
}

static bool is_stored(const struct il_line *line)
{
	return line->kind == IL_ARG_OUT || (line->kind == IL_OP && line->op == OP_ST);
}

/* Of a network: which of the lines from @from on leaves the value that an operation has. A wire has another name
 * there. */
static void mark_made(struct chain *c, int index, int from, uint32_t operand, bool is_target)
{
	struct il *il = c->ld->il;
	const uint16_t mark = c->ld->fbd && c->ld->item ?
		expr_mark(c->expr, index, names_text(&c->ld->translation->project->names, c->ld->item->text)) : 0;
	int at = il->count - 1;

	while (mark && at >= from && !(is_stored(&il->line[at]) && (is_target || il->line[at].operand == operand)))
		at--;
	while (mark && at > from && (il->line[at].kind == IL_ARG_OUT || il->line[at].kind == IL_ARG_IN))
		at--; /* back to the call */
	if (mark && at >= from && !il->line[at].made)
		il->line[at].made = mark;
}

static struct value chain_compute(struct chain *c, int index, enum iec_type hint,
				  uint32_t target)
{
	const int from = c->ld->il->count;
	struct value value = compute_raw(c, index, hint, target);

	if (value.whole)
		value = cut(c, value, infer_type(&c->in, index), hint, target);
	mark_made(c, index, from, value.operand, target && value.operand == target);
	return value;
}

/* The parser keeps LIMIT_EXPR_DEPTH, which bounds the recursion. */
static struct value compute_raw(struct chain *c, int index, enum iec_type hint,
				  uint32_t target)
{
	const struct expr_node *node = &c->expr->node[index];
	struct value value = { .type = IEC_NONE };

	chain_at(c, node->text);
	switch (node->op) {
	case EXPR_NAME:
	case EXPR_INDEX:
		return keep_value(c, chain_place(c, index));
	case EXPR_BIT:
		return compute_bit(c, node);
	case EXPR_CALL:
		return chain_call(c, index, hint, target);
	case EXPR_ARG:
		return value;
	case EXPR_LITERAL:
		return constant(c, node->text, node->len, false, hint);
	case EXPR_NEG:
		return compute_neg(c, node, hint, target);
	case EXPR_FN:
		return compute_fn(c, node, index, hint, target);
	case EXPR_NOT:
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		return compute_logic(c, node, hint, target);
	}
	return value;
}

static struct value compute_neg(struct chain *c, const struct expr_node *node,
				enum iec_type hint, uint32_t target)
{
	const struct expr_node *inner = &c->expr->node[node->left];
	struct value zero, value;
	enum iec_type type;

	if (inner->op == EXPR_LITERAL && !memchr(inner->text, '#', inner->len))
		return constant(c, inner->text, inner->len, true, hint);
	if (infer_mixes(&c->in, infer_type(&c->in, node->left), IEC_NONE)) {
		zero = constant(c, "0", 1, false, IEC_LINT);
		value = operate(c, FN_SUB, zero, mixed_side(c, node->left, IEC_LINT), IEC_LINT, 0);
		value.whole = true;
		return value;
	}
	value = chain_compute(c, node->left, hint, 0);
	zero = value.type == IEC_TIME ? constant(c, "T#0s", 4, false, IEC_NONE)
				      : constant(c, "0", 1, false, IEC_NONE);
	type = value.type ? value.type : hint;
	return operate(c, FN_SUB, zero, value, type ? type : IEC_DINT, target);
}

static bool parse(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	const struct names *names = &ld->translation->project->names;
	uint32_t id = rung_at(ld->rung, at->row, at->col)->operand;
	struct diag place = { .id = DIAG_BAD_EXPRESSION };

	if (expr_parse_text(names_text(names, id), names_len(names, id),
			    ld->expr, ld->ignored, place))
		return true;
	ld->failed = true;
	return false;
}

static struct infer infer_of(const struct ld *ld)
{
	return (struct infer){ .scope = ld->translation->scope, .pou = ld->unit->pou,
			       .project = ld->translation->project, .expr = ld->expr, .statement = ld->statement };
}

/** chain_count_calls - calls of the project's own functions in the expression. */
static int chain_count_calls(const struct ld *ld, const struct expr *expr)
{
	const struct infer in = infer_of(ld);
	int calls = 0;

	for (int i = 0; i < expr->count; i++)
		calls += expr->node[i].op == EXPR_CALL &&
			 word_is_own(infer_function(&in, &expr->node[i]));
	return calls;
}

/* May an index be read when its element is used? Not if a function may change it before. */
static bool chain_folds(const struct chain *c)
{
	for (int i = 0; i < c->expr->count; i++)
		if (c->expr->node[i].output)
			return false;
	return c->calls == 0;
}

void ld_compare(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct element_state *state = &ld->element[element];
	struct chain c = { .ld = ld, .expr = ld->expr, .net = at->in, .in = infer_of(ld) };
	struct value value = { .type = IEC_NONE };

	if (!parse(ld, element))
		return;
	c.calls = chain_count_calls(ld, ld->expr);
	c.folds = chain_folds(&c);
	ld_place(ld, at->row, at->col);
	value = settle(&c, chain_compute(&c, ld->expr->root, IEC_NONE, 0));
	state->leaf = value.operand;
	if (!c.can_fail)
		return;
	ld_emit(ld, OP_LD, 0, value.operand);
	ld_emit(ld, OP_AND, 0, c.en);
	state->powered = true;
	state->leaf = ld_store_new(ld);
}

/* The place that ld->expr assigns to. */
static uint32_t chain_target(struct chain *c)
{
	const struct expr *expr = c->expr;

	chain_at(c, expr->target);
	if (expr->target_index < 0)
		return intern_name(c, expr->target, expr->target_len);
	return compute_element(c, &(struct expr_node){
		.text = expr->target, .len = (uint16_t)expr->target_len,
		.left = (int16_t)expr->target_index, .right = (int16_t)expr->target_base,
		.tail = expr->target_tail });
}

static bool is_place(const struct expr *expr)
{
	return expr->node[expr->root].op == EXPR_NAME || expr->node[expr->root].op == EXPR_INDEX;
}

void ld_assign(struct ld *ld, int element)
{
	const struct network_element *at = &ld->network.element[element];
	struct chain c = { .ld = ld, .expr = ld->expr, .net = at->in, .in = infer_of(ld) };
	const struct value none = { .type = IEC_NONE };
	struct value value = { .type = IEC_NONE };
	uint32_t target;

	if (!parse(ld, element))
		return;
	c.calls = chain_count_calls(ld, ld->expr);
	c.folds = chain_folds(&c);
	ld_place(ld, at->row, at->col);
	target = chain_target(&c);
	ld_freeze(ld, target);
	value = chain_assigned(&c, target, target);
	if (value.operand != target || is_place(ld->expr))
		operate(&c, FN_MOVE, value, none, value.type, target);
	ld->element[element].leaf = c.en;
	ld->element[element].powered = true;
}

/* ---- statements ---- */

static struct chain statement(struct ld *ld)
{
	struct chain c = { .ld = ld, .expr = ld->expr, .net = NET_RAIL, .in = infer_of(ld),
			   .calls = chain_count_calls(ld, ld->expr) };

	c.folds = chain_folds(&c);
	return c;
}

/* May LD and ST copy it? LD of an element that does not exist gives 0, which must not be stored; ST does
 * not count a text that it cuts. */
static bool is_loadable(struct chain *c, uint32_t from, uint32_t to)
{
	const struct meaning *a = meaning(c, from), *b = meaning(c, to);

	return a && b && !meaning_is_indexed(a) && b->type != IEC_STRING &&
	       (!meaning_is_indexed(b) || !meaning_is_whole(b));
}

/* Reference REF= place */
static void store_reference(struct chain *c)
{
	const struct expr *expr = c->expr;
	const struct value none = { .type = IEC_NONE };
	const char *place = expr->target;
	size_t len = expr->target_len;

	if (expr->target_index >= 0) {
		const uint32_t element = chain_target(c);

		place = names_text(&c->ld->translation->project->names, element);
		len = strlen(place);
	}
	const uint32_t target = signed_operand(c, '@', place, len);

	operate(c, FN_MOVE, chain_place_of(c, expr->root), none, IEC_LWORD, target);
}

static void said_cut(struct chain *c, enum iec_type type, const struct literal *literal,
		     const char *becomes)
{
	const struct unit *unit = c->ld->unit;
	const struct translation *translation = c->ld->translation;
	char text[LIMIT_ARG], number[40];
	struct diag place = { .id = DIAG_CUT_CONSTANT, .file = unit->pou->file,
			      .pou = project_text(translation->project, unit->pou->name) };

	iec_value_print(literal->high ? IEC_ULINT : IEC_LINT, literal->value, number, sizeof(number));
	snprintf(text, sizeof(text), "%.21s" DIAG_AND "%s" DIAG_AND "%.21s", number,
		 iec_type_row(type)->word, becomes);
	st_where(&translation->project->names, c->ld->item, c->expr->target, &place.line,
		 &place.column);
	diag_add(translation->diags, place, "%s", text);
}

/* In plain IEC text a constant that the type cannot hold is cut, as other tools do. False: it is none. */
static bool store_cut(struct chain *c, uint32_t target)
{
	const struct meaning *m = meaning(c, target);
	char text[40];
	struct literal literal;
	union iec_value value;

	if (!c->ld->translation->project->words.own_first || !m || c->expr->target_bit.len ||
	    !takes_whole(m->type) || meaning_is_ranged(m) || (m->like && m->like->enumeration) ||
	    !whole_compute(c->expr, c->expr->root, &literal) || literal_fit(&literal, m->type, &value))
		return false;
	value = whole_cut(&literal, m->type);
	iec_value_print(m->type, value, text, sizeof(text));
	said_cut(c, m->type, &literal, text);
	chain_at(c, c->expr->target);
	operate(c, FN_MOVE, whole_constant(c, value, m->type), (struct value){ .type = IEC_NONE }, m->type,
		target);
	return true;
}

void ld_store(struct ld *ld)
{
	struct chain c = statement(ld);
	const struct value none = { .type = IEC_NONE };

	if (ld->expr->target_points) {
		store_reference(&c);
		return;
	}
	const uint32_t target = chain_target(&c);
	const enum iec_type type = infer_operand(&c.in, target);

	if (ld->expr->target_tried &&
	    attempt_of(ld->translation->scope, ld->unit->pou, ld->expr) == ATTEMPT_NULL) {
		operate(&c, FN_MOVE, (struct value){ .operand = chain_intern(&c, "NULL", 4), .type = IEC_LWORD }, none, IEC_LWORD, target);
		return;
	}
	if (store_cut(&c, target))
		return;
	const enum iec_type from = infer_type(&c.in, ld->expr->root);
	const bool other = !ld->expr->target_bit.len && !iec_can_widen(from, type) &&
			   (mixed_converts(from, type) || chain_narrows(&c, from, type));
	struct value value = chain_assigned(&c, target, other ? 0 : target);

	chain_at(&c, ld->expr->target);
	value = chain_fit_into(&c, value, type, ld->expr->target_bit.len ? 0 : target);
	if (value.operand == target && !is_place(ld->expr))
		return;
	if (c.can_fail || !is_loadable(&c, value.operand, target)) {
		operate(&c, FN_MOVE, value, none, value.type, target);
		return;
	}
	ld_emit(ld, OP_LD, 0, value.operand);
	ld_emit(ld, OP_ST, 0, target);
}

uint32_t ld_value(struct ld *ld, enum iec_type *type, uint32_t *good)
{
	struct chain c = statement(ld);
	struct value value = settle(&c, chain_compute(&c, ld->expr->root, *type, 0));

	value = chain_fit(&c, value, *type);
	*type = value.type;
	*good = c.can_fail ? c.en : 0;
	return value.operand;
}

enum iec_type ld_test(struct ld *ld)
{
	struct chain c = statement(ld);
	struct value value = settle(&c, chain_compute(&c, ld->expr->root, IEC_BOOL, 0));

	ld_emit(ld, OP_LD, 0, value.operand);
	if (c.can_fail)
		ld_emit(ld, OP_AND, 0, c.en);
	return value.type;
}

uint32_t ld_target(struct ld *ld, uint32_t *good)
{
	struct chain c = statement(ld);
	struct value value;

	c.folds = false; /* it is used later */
	chain_at(&c, ld->expr->node[ld->expr->root].text);
	value = chain_place(&c, ld->expr->root);
	*good = c.can_fail ? c.en : 0;
	return value.operand;
}
