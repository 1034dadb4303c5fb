/* SPDX-License-Identifier: MIT
 *
 * infer - the types of parts of an expression; see infer.h.
 */
#include "engine/check/infer.h"

#include "engine/check/generic.h"
#include "engine/check/mixed.h"
#include "engine/model/fbd.h"
#include "engine/model/shape.h"

enum iec_type infer_operand(struct infer *c, uint32_t operand)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, operand, &why);

	if (m && m->kind == MEANING_LITERAL && m->literal.real)
		return c->pointless ? IEC_NONE : IEC_REAL;
	return m ? m->type : IEC_NONE;
}

/* check_operand keeps LIMIT_INDICES. */
static enum iec_type infer_element(struct infer *c, const struct expr_node *node)
{
	return infer_operand(c, scope_first_of(c->scope, c->pou, c->expr, node));
}

static bool is_bits(enum iec_type type)
{
	return iec_type_row(type)->class & CLASS_BITS;
}


/* A bit string and a number, or two bit strings, in arithmetic of Structured Text. */
bool infer_mixes(const struct infer *c, enum iec_type left, enum iec_type right)
{
	if (!c->statement || (!mixed_is_bits(left) && !mixed_is_bits(right)))
		return false;
	return mixed_join(left, right) != IEC_TYPE_COUNT;
}

/* The type of AND OR XOR NOT: BOOL, unless a side is a bit string that the other fits;
 * IEC_NONE for constants alone. */
enum iec_type infer_logic(struct infer *c, const struct expr_node *node)
{
	enum iec_type type = infer_type(c, node->left);

	if (node->op != EXPR_NOT) {
		const enum iec_type right = infer_type(c, node->right);

		type = types_join(type, right) == IEC_TYPE_COUNT && infer_mixes(c, type, right) ?
		       mixed_join(type, right) : types_join(type, right);
	}
	if (c->statement && type != IEC_TYPE_COUNT)
		type = mixed_pin(CLASS_BITS, type);
	return type == IEC_NONE || is_bits(type) ? type : IEC_BOOL;
}

enum word infer_function(const struct infer *c, const struct expr_node *node)
{
	return generic_word(c->scope, c->pou, c->expr, node, expr_function(&c->project->words, node));
}

/* ---- types ---- */

const struct var *infer_result(const struct infer *c, enum word word)
{
	const struct pou *pou = shape_pou(c->project, word);

	return pou && pou->vars.count ? &pou->vars.var[0] : NULL;
}

/* The overload of a word for these arguments. */
enum word infer_overload(struct infer *c, enum word word, const struct expr_args *args)
{
	if (args->count != 2)
		return word;
	return fn_overload(word, infer_type(c, args->arg[0].at),
			   infer_type(c, args->arg[1].at));
}

/* The type that the inputs share; IEC_NONE: all are constants, or no type fits. */
enum iec_type infer_shared(struct infer *c, const struct word_row *row,
				 const struct expr_args *args)
{
	enum iec_type type = IEC_NONE;

	for (int i = 0; i < args->count && type != IEC_TYPE_COUNT; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)args->arg[i].pin);
		enum iec_type is;

		if (pin->own)
			continue;
		is = pin->type != IEC_NONE ? pin->type : infer_type(c, args->arg[i].at);
		if (types_join(type, is) == IEC_TYPE_COUNT && infer_mixes(c, type, is))
			type = mixed_join(type, is);
		else
			type = types_join(type, is);
	}
	return type == IEC_TYPE_COUNT ? IEC_NONE : type;
}

/* The type that the function works on: of SHL on an INT it is WORD. */
enum iec_type infer_work(struct infer *c, const struct word_row *row,
			       const struct expr_args *args)
{
	const enum iec_type type = infer_shared(c, row, args);

	for (int i = 0; i < args->count && c->statement; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)args->arg[i].pin);

		if (pin->own || pin->type != IEC_NONE)
			continue;
		if (row == word_row(FN_SHR) && iec_type_row(type)->class == CLASS_SIGNED)
			return IEC_LWORD; /* the sign comes in from the left */
		return mixed_pin(pin->classes, type);
	}
	return type;
}

/* Of a function that works on @work instead of @type. */
enum iec_type infer_back(enum iec_type type, enum iec_type work)
{
	return mixed_is_bits(work) ? type : work;
}

/* @type, or a wider one that can hold the constant at @index. */
static enum iec_type roomy(const struct infer *c, enum iec_type type, int index)
{
	const struct expr_node *node = &c->expr->node[index];
	struct literal literal;
	union iec_value value;

	if (!c->statement || node->op != EXPR_LITERAL || !(iec_type_row(type)->class & ANY_INT) ||
	    literal_parse(node->text, node->len, &literal) != LITERAL_OK ||
	    literal.type != IEC_NONE || literal.real || literal_fit(&literal, type, &value))
		return type;
	return literal_fit(&literal, IEC_DINT, &value) ? IEC_DINT : IEC_LINT;
}

/* Does a constant of the operation need a wider type than the other side has? */
bool infer_is_roomy(struct infer *c, const struct expr_node *node)
{
	const enum iec_type left = infer_type(c, node->left), right = infer_type(c, node->right);

	return roomy(c, left, node->right) != left || roomy(c, right, node->left) != right;
}

static enum iec_type infer_call(struct infer *c, const struct expr_node *node)
{
	enum word word = infer_function(c, node);
	const struct word_row *row = scope_row(c->scope, word);
	struct expr_args args;
	const struct var *result;
	enum expr_measure what;
	struct expr_node *of;
	enum fbd_word is;

	if (word_is_own(word)) {
		result = infer_result(c, word);
		return result && !result->array.count ? result->type : IEC_NONE;
	}
	if (word == WORD_COUNT && expr_is_clock(node))
		return IEC_TIME;
	if (word == WORD_COUNT && expr_measured(c->expr, node, &what))
		return what == MEASURE_PLACE ? IEC_LWORD : what == MEASURE_VALID ? IEC_BOOL : IEC_NONE;
	if (word == WORD_COUNT && c->pou && c->pou->fbd && (is = fbd_word(c->expr, node, &of)) != FBD_NO_WORD)
		return is == FBD_PREVIOUS ? infer_type(c, (int)(of - c->expr->node)) : IEC_BOOL;
	if (word == WORD_COUNT ||
	    expr_match(c->expr, node, row, &args) != DIAG_COUNT)
		return IEC_NONE;
	if (infer_is_whole_power(c, word, &args) || infer_is_root(c, word, &args))
		return infer_power(c, args.arg[0].at, args.arg[1].at);
	row = scope_row(c->scope, infer_overload(c, word, &args));
	if (word_shares(row))
		return infer_back(infer_shared(c, row, &args), infer_work(c, row, &args));
	return row->result == RESULT_OPEN ? IEC_NONE : (enum iec_type)row->result;
}

enum iec_type infer_bits(unsigned int bits)
{
	return bits == 1 ? IEC_BOOL : bits == 8 ? IEC_BYTE : bits == 16 ? IEC_WORD :
	       bits == 32 ? IEC_DWORD : IEC_LWORD;
}

/* Are base and exponent of a power integers, or constants without a point? */
bool infer_is_power(struct infer *c, int base, int exponent)
{
	const enum iec_type left = infer_type(c, base), right = infer_type(c, exponent);

	return !(iec_type_row(left)->class & CLASS_REAL) && !(iec_type_row(right)->class & CLASS_REAL);
}

/* Of a power: that of the base, or REAL as the exponent. */
enum iec_type infer_power(struct infer *c, int base, int exponent)
{
	const enum iec_type left = infer_type(c, base), right = infer_type(c, exponent);

	return !(iec_type_row(left)->class & CLASS_REAL) && iec_type_row(right)->class & CLASS_REAL ?
	       right : left;
}

/* EXPT(base, exponent) of integers; @args: its arguments. */
bool infer_is_whole_power(struct infer *c, enum word word, const struct expr_args *args)
{
	return word == FN_EXPT && args->count == 2 && !args->more && args->arg[0].pin == 0 &&
	       infer_is_power(c, args->arg[0].at, args->arg[1].at);
}

/* EXPT(integer, real); @args: its arguments. */
bool infer_is_root(struct infer *c, enum word word, const struct expr_args *args)
{
	return word == FN_EXPT && args->count == 2 && !args->more && args->arg[0].pin == 0 &&
	       iec_type_row(infer_type(c, args->arg[0].at))->class & ANY_INT &&
	       iec_type_row(infer_type(c, args->arg[1].at))->class & CLASS_REAL;
}

/* 2 * T#1s is T#1s * 2, and T#1h + Begin is Begin + T#1h: the functions take the other first. */
static bool is_turned(const struct expr_node *node, enum iec_type left, enum iec_type right)
{
	return (node->fn == FN_MUL || node->fn == FN_ADD) && fn_overload(node->fn, left, right) == node->fn &&
	       fn_overload(node->fn, right, left) != node->fn;
}

/* Type of a part; constants without a type take that of their neighbours. */
enum iec_type infer_type(struct infer *c, int index)
{
	const struct expr_node *node = &c->expr->node[index];
	enum iec_type left, right;
	unsigned int bits, number;

	switch (node->op) {
	case EXPR_NAME:
	case EXPR_LITERAL:
		return infer_operand(c, names_intern(&c->project->names, node->text, node->len));
	case EXPR_INDEX: /* that of its array's elements */
		return infer_element(c, node);
	case EXPR_BIT:
		return expr_part(node->tail, &bits, &number) ? infer_bits(bits) : IEC_NONE;
	case EXPR_NEG:
		left = infer_type(c, node->left);
		return infer_mixes(c, left, IEC_SINT) ? mixed_join(left, IEC_SINT) : left;
	case EXPR_NOT:
	case EXPR_AND:
	case EXPR_XOR:
	case EXPR_OR:
		return infer_logic(c, node);
	case EXPR_CALL:
		return infer_call(c, node);
	case EXPR_ARG:
		return IEC_NONE;
	case EXPR_FN:
		break;
	}
	if (word_is_test(word_row(node->fn)))
		return IEC_BOOL;
	if (node->fn == FN_EXPT)
		return infer_power(c, node->left, node->right);
	left = infer_type(c, node->left);
	right = infer_type(c, node->right);
	if (is_turned(node, left, right)) {
		struct expr_node *turned = &c->expr->node[index];
		const int16_t first = turned->left;

		turned->left = turned->right;
		turned->right = first;
		return infer_type(c, index);
	}
	if (fn_overload(node->fn, left, right) != node->fn)
		return fn_result(word_row(fn_overload(node->fn, left, right)), left,
				 IEC_NONE);
	if (infer_mixes(c, left, right))
		return mixed_join(left, right);
	left = types_join(roomy(c, left, node->right), roomy(c, right, node->left));
	return left == IEC_TYPE_COUNT ? right : left;
}

/* The same where @hint is wanted: an LREAL, if only constants make it a REAL. */
enum iec_type infer_wanted(struct infer *c, int index, enum iec_type hint)
{
	enum iec_type type = infer_type(c, index), others;

	if (type != IEC_REAL || hint != IEC_LREAL)
		return type;
	c->pointless = true;
	others = infer_type(c, index);
	c->pointless = false;
	return others == IEC_REAL ? type : hint;
}
