/* SPDX-License-Identifier: MIT
 *
 * check_flow - JMP, RET, STP and CAL of an instruction list.
 *
 * A part of check_il. Circles of calls are found by check_calls.
 */
#include "engine/check/il_check.h"

#include "engine/model/advice.h"

static bool is_label(struct il_check *c, uint32_t name)
{
	uint32_t fold = names_fold(&scope_project(c->scope)->names, name);

	return fold && fold < c->label_count && c->label[fold];
}

/* With C the result must be there, without it nothing goes on. */
bool il_check_flow(struct il_check *c, const struct il_line *line)
{
	bool good = true;

	if (c->depth > 0 && line->op != OP_STP)
		good = il_report(c, line, DIAG_IL_OPEN_PAREN, op_row(line->op)->word);
	if (line->op == OP_JMP && !is_label(c, line->operand))
		good = il_report_near(c, line, DIAG_NO_LABEL, EXPECT_LABEL);
	if (line->modifiers & MOD_C)
		return il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "the result") && good;
	if (line->op != OP_STP)
		c->now.there = false;
	return good;
}

static bool is_arg(const struct il_check *c, int at)
{
	return at < c->il->count && (c->il->line[at].kind == IL_ARG_IN ||
				     c->il->line[at].kind == IL_ARG_OUT);
}

/* CAL of a SUBROUTINE, which has no parameters. */
static bool check_routine(struct il_check *c, int at, const struct pou *to)
{
	const struct il_line *line = &c->il->line[at];
	bool good = true;

	if (to->kind != POU_SUBROUTINE)
		return il_report(c, line, DIAG_NOT_SUBROUTINE, il_operand_text(c, line));
	if (line->modifiers & MOD_C)
		good = il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "the result");
	if (is_arg(c, at + 1))
		good = il_report(c, &c->il->line[at + 1], DIAG_TOO_MANY_OPERANDS,
				 scope_text(c->scope, c->il->line[at + 1].pin));
	c->now.there = false;
	return good;
}

bool il_check_cal(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct pou *routine = scope_pou(c->scope, c->pou, line->operand);
	const struct meaning *m;
	bool good = true;

	if (routine)
		return check_routine(c, at, routine);
	m = il_find(c, line);
	if (!m)
		return false;
	if (m->kind != MEANING_INSTANCE)
		return il_report(c, line, DIAG_NOT_INSTANCE, il_operand_text(c, line));
	if (line->modifiers & MOD_C)
		good = il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "the result");
	for (int i = at + 1; is_arg(c, i); i++)
		good &= il_check_pin(c, scope_row(c->scope, m->word),
				     &c->il->line[i]);
	good &= il_check_in_outs(c, at, scope_row(c->scope, m->word));
	c->now.there = false;
	return good;
}
