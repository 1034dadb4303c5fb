/* SPDX-License-Identifier: MIT
 *
 * ld_fn - functions in expressions, as IL: `[ y := LIMIT(0, a + b, 100) ]`.
 *
 * A call is what the box of the function would be: it gets EN from the ENO of what was
 * computed before it. Whether its arguments are right was looked at before; their types
 * are check_il's.
 */
#include "engine/translate/ld_chain.h"

#include "engine/check/check_il.h"
#include "engine/model/expr_args.h"
#include "engine/model/shape.h"

#include <string.h>

static enum word function_of(const struct ld *ld, const struct expr_node *node)
{
	return expr_function(&ld->translation->project->words, node);
}

int chain_count_calls(const struct ld *ld, const struct expr *expr)
{
	int calls = 0;

	for (int i = 0; i < expr->count; i++)
		calls += expr->node[i].op == EXPR_CALL &&
			 word_is_own(function_of(ld, &expr->node[i]));
	return calls;
}

/* ---- types ---- */

static const struct var *result_of(const struct chain *c, enum word word)
{
	const struct pou *pou = shape_pou(c->ld->translation->project, word);

	return pou && pou->vars.count ? &pou->vars.var[0] : NULL;
}

/* The word that it is on these arguments: of times ADD is another. */
static enum word overloaded(struct chain *c, enum word word, const struct expr_args *args)
{
	if (args->count != 2)
		return word;
	return fn_overload(word, chain_infer(c, args->arg[0].at),
			   chain_infer(c, args->arg[1].at));
}

/* The type that the inputs share; IEC_NONE: constants, or none does. */
static enum iec_type shared_type(struct chain *c, const struct word_row *row,
				 const struct expr_args *args)
{
	enum iec_type type = IEC_NONE;

	for (int i = 0; i < args->count && type != IEC_TYPE_COUNT; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)args->arg[i].pin);

		if (!pin->own)
			type = types_join(type, pin->type != IEC_NONE ? pin->type :
					  chain_infer(c, args->arg[i].at));
	}
	return type == IEC_TYPE_COUNT ? IEC_NONE : type;
}

enum iec_type chain_infer_call(struct chain *c, const struct expr_node *node)
{
	enum word word = function_of(c->ld, node);
	const struct word_row *row = ld_row(c->ld, word);
	struct expr_args args;
	const struct var *result;

	if (word_is_own(word)) {
		result = result_of(c, word);
		return result ? result->type : IEC_NONE;
	}
	if (word == WORD_COUNT ||
	    expr_match(c->expr, node, row, &args) != DIAG_COUNT)
		return IEC_NONE;
	row = ld_row(c->ld, overloaded(c, word, &args));
	if (word_shares(row))
		return shared_type(c, row, &args);
	return row->result == RESULT_OPEN ? IEC_NONE : (enum iec_type)row->result;
}

/* ---- calls ---- */

/* @in by argument. Into a temporary, if there is no @target. */
static struct value emit_call(struct chain *c, enum word word, const struct expr_args *args,
			      const struct value in[LIMIT_ARGS], struct value out)
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
	ld_arg(ld, true, ld->eno_id, eno);
	ld_arg(ld, true, ld->out_id, out.operand);
	c->en = eno;
	return out;
}

static bool is_whole(const struct word_pin *pin)
{
	return pin->elements || pin->type == IEC_NONE;
}

/* Of the project's own function: each argument is of its pin's type, or the very thing. */
static struct value call_own(struct chain *c, enum word word, const struct expr_args *args,
			     uint32_t target)
{
	struct ld *ld = c->ld;
	const struct word_row *row = ld_row(ld, word);
	const struct var *result = result_of(c, word);
	struct value in[LIMIT_ARGS], out = { target, result ? result->type : IEC_NONE };

	for (int i = 0; i < args->count; i++) {
		const struct word_pin *pin = &row->pin[args->arg[i].pin];
		bool place = is_whole(pin) || pin->dir == PIN_IN_OUT;

		in[i] = place ? chain_place(c, args->arg[i].at) :
				chain_side(c, args->arg[i].at, pin->type);
		if (pin->dir == PIN_IN_OUT)
			ld_freeze(ld, in[i].operand);
	}
	c->calls--;
	ld_freeze_globals(ld);
	if (!out.operand && result && result->type != IEC_NONE)
		out.operand = temps_number(ld->temps, result->type);
	else if (!out.operand && result)
		out.operand = temps_whole(ld->temps, &(struct meaning){
			.kind = MEANING_STRUCT, .word = (uint16_t)result->fb });
	return emit_call(c, word, args, in, out);
}

/* Of the catalogue. */
static struct value call_known(struct chain *c, enum word word, const struct expr_args *args,
			       enum iec_type hint, uint32_t target)
{
	const struct word_row *row = ld_row(c->ld, word);
	enum word runs = overloaded(c, word, args);
	enum iec_type type = shared_type(c, row, args), given;
	struct value in[LIMIT_ARGS], out = { target, IEC_NONE };

	given = type ? type : word_shares(row) ? hint : IEC_NONE;
	for (int i = 0; i < args->count; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)args->arg[i].pin);

		in[i] = chain_side(c, args->arg[i].at,
				   pin->own || runs != word ? IEC_NONE : given);
		if (!pin->own && !type)
			given = types_join(given, in[i].type);
	}
	if (given == IEC_NONE || given == IEC_TYPE_COUNT)
		given = IEC_DINT;
	if (runs != word)
		given = chain_infer(c, args->arg[0].at);
	out.type = fn_result(ld_row(c->ld, runs), given, hint);
	if (!target)
		out.operand = temps_number(c->ld->temps, out.type);
	return emit_call(c, word, args, in, out);
}

struct value chain_call(struct chain *c, const struct expr_node *node,
			enum iec_type hint, uint32_t target)
{
	enum word word = function_of(c->ld, node);
	struct value none = { 0, IEC_NONE };
	struct expr_args args;

	if (word == WORD_COUNT ||
	    expr_match(c->expr, node, ld_row(c->ld, word), &args) != DIAG_COUNT) {
		c->ld->failed = true;
		return none;
	}
	return word_is_own(word) ? call_own(c, word, &args, target) :
				   call_known(c, word, &args, hint, target);
}
