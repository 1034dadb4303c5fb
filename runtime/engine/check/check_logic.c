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
		bool good = il_need_bool(c, line, left, "result");

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

static bool open_paren(struct il_check *c, const struct il_line *line, bool good)
{
	const struct meaning *m;

	if (c->depth == LIMIT_IL_DEPTH)
		return il_report(c, line, DIAG_TOO_DEEP, "(");
	c->opened[c->depth].left = c->now;
	c->opened[c->depth++].op = line->op;
	if (!il_is_bits(c->now) && !c->now.literal)
		good = good && il_need_bool(c, line, c->now, "result");
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
		return open_paren(c, line, good);
	m = il_value_of(c, line);
	if (m && good)
		return combine(c, line, (enum op)line->op, c->now, il_result_of(m),
			       il_operand_text(c, line));
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	return false;
}

bool il_check_close(struct il_check *c, const struct il_line *line)
{
	bool good = il_need_result(c, line);
	struct result right = c->now;

	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	if (c->depth == 0)
		return il_report(c, line, DIAG_IL_CLOSE_PAREN, ")");
	c->depth--;
	if (!good || !c->opened[c->depth].left.there)
		return false;
	return combine(c, line, (enum op)c->opened[c->depth].op,
		       c->opened[c->depth].left, right, "result");
}

bool il_check_not(struct il_check *c, const struct il_line *line)
{
	struct result now = c->now;
	bool good = il_need_result(c, line);

	if (good && il_is_bits(now))
		return true;
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	return good && il_need_bool(c, line, now, "result");
}
