/* SPDX-License-Identifier: MIT
 *
 * check_logic - AND OR XOR NOT of an instruction list: on BOOL, or on bit strings as
 * the functions of the same names.
 *
 * A part of check_il. Whether a constant is a bit or bits is told by what it meets.
 */
#include "engine/check/il_check.h"

bool il_is_bits(struct result result)
{
	return iec_type_row(result.type)->class & CLASS_BITS;
}

/* The result of @op on two values; of BOOLs as an operator, of bits as a function. */
static bool combine(struct il_check *c, const struct il_line *line, enum op op,
		    struct result left, struct result right, const char *what)
{
	struct il_line function = *line;
	struct result in[2] = { left, right };
	enum iec_type type = IEC_NONE;

	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	if (!il_is_bits(left) && !il_is_bits(right)) {
		bool good = il_need_bool(c, line, left, "the result");

		good = il_need_bool(c, line, right, what) && good;
		if (!good) /* goes with everything */
			c->now.type = IEC_NONE;
		return good;
	}
	function.word = (uint16_t)op_function(op);
	c->now.type = IEC_NONE;
	if (!il_check_inputs(c, &function, in, 2, IEC_NONE, &type))
		return false;
	c->now.type = type;
	return true;
}

bool il_open_paren(struct il_check *c, const struct il_line *line, bool good)
{
	const struct meaning *m;

	if (c->depth == LIMIT_IL_DEPTH)
		return il_report(c, line, DIAG_TOO_DEEP, "(");
	c->opened[c->depth++] = (struct il_opened){
		.left = c->now, .op = line->op,
		.word = line->kind == IL_FN ? (enum word)line->word : 0,
	};
	if (line->kind == IL_OP && !il_is_bits(c->now) && !c->now.literal)
		good = good && il_need_bool(c, line, c->now, "the result");
	c->now.there = false;
	if (!line->operand)
		return good;
	m = il_value_of(c, line); /* AND( Level, then GT 10 */
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	if (m)
		c->now = il_result_of(m);
	return m && good;
}

bool il_check_logic(struct il_check *c, const struct il_line *line)
{
	bool good = il_need_result(c, line);
	const struct meaning *m;

	if (line->modifiers & MOD_PAREN)
		return il_open_paren(c, line, good);
	m = il_value_of(c, line);
	if (m && good)
		return combine(c, line, (enum op)line->op, c->now, il_result_of(m),
			       il_operand_text(c, line));
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	return false;
}

/* The function before a parenthesis, on what stands left of it and inside. */
static bool close_function(struct il_check *c, int at, struct result left,
			   struct result right, enum iec_type *common)
{
	const enum word word = fn_overload(c->opened[c->depth].word, left.type,
					   right.type);
	const struct word_row *row = scope_row(c->scope, word);
	struct il_line function = c->il->line[at];
	struct result in[2] = { left, right };
	enum iec_type stored = il_stored_type(c->scope, c->pou, c->il, at);

	function.word = (uint16_t)word;
	c->now.type = word_is_test(row) ? IEC_BOOL : IEC_NONE;
	if (!il_check_inputs(c, &function, in, 2, IEC_NONE, common))
		return false;
	c->now.type = fn_result(row, *common, stored);
	return true;
}

static bool close_paren(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->il->line[at];
	bool good = il_need_result(c, line);
	struct result right = c->now;

	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	if (c->depth == 0)
		return il_report(c, line, DIAG_IL_CLOSE_PAREN, ")");
	c->depth--;
	if (!good || !c->opened[c->depth].left.there)
		return false;
	if (c->opened[c->depth].word)
		return close_function(c, at, c->opened[c->depth].left, right,
				      common);
	good = combine(c, line, (enum op)c->opened[c->depth].op,
		       c->opened[c->depth].left, right, "the result");
	*common = c->now.type;
	return good;
}

bool il_check_close(struct il_check *c, int at, enum iec_type *common)
{
	*common = IEC_NONE;
	return close_paren(c, at, common);
}

bool il_check_not(struct il_check *c, const struct il_line *line)
{
	struct result now = c->now;
	bool good = il_need_result(c, line);

	if (good && il_is_bits(now))
		return true;
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	return good && il_need_bool(c, line, now, "the result");
}
