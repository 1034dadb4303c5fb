/* SPDX-License-Identifier: MIT
 *
 * check_own - parameters of calls, and calls of the project's own functions.
 *
 * Each pin of them has a type of its own, so that nothing is worked out: what is
 * handed over widens to it, or is the very thing.
 */
#include "engine/check/il_check.h"

#include "engine/model/shape.h"

#include <string.h>
#include <strings.h>

static const char *pin_text(struct il_check *c, const struct il_line *arg)
{
	return scope_text(c->scope, arg->pin);
}

static const char *operand_text(struct il_check *c, const struct il_line *line)
{
	return scope_text(c->scope, line->operand);
}

static bool is_arg(const struct il_check *c, int at)
{
	return at < c->il->count && (c->il->line[at].kind == IL_ARG_IN ||
				     c->il->line[at].kind == IL_ARG_OUT);
}

static struct result value_of(const struct meaning *m)
{
	struct result out = { .there = true, .type = m->type };

	if (m->kind == MEANING_LITERAL && m->type == IEC_NONE)
		out.literal = &m->literal;
	return out;
}

/* Is it of a type without parts, or else told what is wrong with it? */
static bool is_plain(struct il_check *c, const struct il_line *arg,
		     const struct meaning *m)
{
	if (m->kind == MEANING_STRUCT)
		return il_report(c, arg, DIAG_STRUCT_AS_VALUE, operand_text(c, arg));
	return meaning_fault(m) == DIAG_COUNT ||
	       il_report(c, arg, meaning_fault(m), operand_text(c, arg));
}

static bool check_in_out(struct il_check *c, const struct il_line *arg,
			 const struct meaning *m, const struct word_pin *pin)
{
	if (pin->type == IEC_NONE)
		return il_check_shape(c, arg, m, pin) &&
		       (m->kind == MEANING_INSTANCE || il_can_write(c, arg, m));
	if (!is_plain(c, arg, m) || !il_can_write(c, arg, m))
		return false;
	if (m->type == pin->type)
		return true;
	return il_report(c, arg, DIAG_WRONG_TYPE, iec_type_row(pin->type)->word);
}

/* @m: what stands at the pin, to be read or written. */
static bool check_value(struct il_check *c, const struct il_line *arg,
			const struct meaning *m, const struct word_pin *pin)
{
	bool output = pin->dir == PIN_OUT;

	if (pin->elements)
		return il_check_shape(c, arg, m, pin) &&
		       (pin->dir == PIN_IN || il_can_write(c, arg, m));
	if (pin->dir == PIN_IN_OUT)
		return check_in_out(c, arg, m, pin);
	if (pin->type == IEC_NONE)
		return il_check_shape(c, arg, m, pin) &&
		       (!output || il_can_write(c, arg, m));
	if (!is_plain(c, arg, m))
		return false;
	if (!output)
		return il_can_store(c, arg, value_of(m), pin->type);
	return il_can_write(c, arg, m) &&
	       il_can_store(c, arg, (struct result){ .there = true, .type = pin->type },
			    m->type);
}

bool il_check_pin(struct il_check *c, const struct word_row *row,
		  const struct il_line *arg)
{
	const char *name = pin_text(c, arg);
	int index = word_pin_find(row, name, strlen(name));
	const struct meaning *m = il_find(c, arg);

	if (!m)
		return false;
	if (index < 0)
		return is_plain(c, arg, m) &&
		       il_report(c, arg, DIAG_NO_PIN, arg->mark & IL_IN_ORDER ?
				 operand_text(c, arg) : name);
	if ((row->pin[index].dir == PIN_OUT) != (arg->kind == IL_ARG_OUT))
		return il_report(c, arg, DIAG_PIN_DIRECTION, name);
	return check_value(c, arg, m, &row->pin[index]);
}

/* Is there a parameter for pin @name of the call at @at? */
static bool has_arg(struct il_check *c, int at, const char *name)
{
	for (int i = at + 1; is_arg(c, i); i++)
		if (strcasecmp(pin_text(c, &c->il->line[i]), name) == 0)
			return true;
	return false;
}

bool il_check_in_outs(struct il_check *c, int at, const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN_OUT &&
		    !has_arg(c, at, row->pin[i].name))
			return il_report(c, &c->il->line[at], DIAG_MISSING_INPUT,
					 row->pin[i].name);
	return true;
}

/* ---- functions ---- */

static const struct var *result_var(struct il_check *c, int at)
{
	const struct pou *pou = shape_pou(scope_project(c->scope),
					  (enum word)c->il->line[at].word);

	return pou && pou->vars.count > 0 ? &pou->vars.var[0] : NULL;
}

bool il_check_power(struct il_check *c, const struct il_line *arg, bool write)
{
	const struct meaning *m = il_find(c, arg);

	return m && is_plain(c, arg, m) && (!write || il_can_write(c, arg, m)) &&
	       il_need_bool(c, arg, value_of(m), operand_text(c, arg));
}

/* OUT => variable: the function's result. */
static bool check_result(struct il_check *c, const struct il_line *arg,
			 const struct var *var)
{
	const struct meaning *m = il_find(c, arg);
	struct word_pin pin = { .dir = PIN_OUT };

	if (!m || !var)
		return false;
	pin.type = var->type;
	if (var->type == IEC_NONE)
		pin.word = var->fb;
	return check_value(c, arg, m, &pin);
}

/* Every input that has no value of its own must be given. */
static bool check_inputs(struct il_check *c, int at, const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN && !row->pin[i].has_init &&
		    !has_arg(c, at, row->pin[i].name))
			return il_report(c, &c->il->line[at], DIAG_MISSING_INPUT,
					 row->pin[i].name);
	return il_check_in_outs(c, at, row);
}

bool il_check_own_call(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	bool good = check_inputs(c, at, row);

	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->il->line[i];
		const char *pin = pin_text(c, arg);
		bool output = arg->kind == IL_ARG_OUT;

		if (strcasecmp(pin, output ? "ENO" : "EN") == 0)
			good &= il_check_power(c, arg, output);
		else if (output && strcasecmp(pin, "OUT") == 0)
			good &= check_result(c, arg, result_var(c, at));
		else
			good &= il_check_pin(c, row, arg);
	}
	c->now.there = false;
	return good;
}

/* The next input behind pin @index; -1: none. */
static int next_input(const struct word_row *row, int index)
{
	while (++index < row->pin_count)
		if (row->pin[index].dir == PIN_IN)
			return index;
	return -1;
}

/* An operand at the next input; @pin gets its index. */
static bool check_operand(struct il_check *c, const struct word_row *row,
			  const struct il_line *line, int *pin)
{
	const struct meaning *m = il_find(c, line);

	*pin = next_input(row, *pin);
	if (!m)
		return false;
	if (*pin < 0)
		return il_report(c, line, DIAG_TOO_MANY_OPERANDS, operand_text(c, line));
	return check_value(c, line, m, &row->pin[*pin]);
}

/* The result is the first input, the operands are the others. */
bool il_check_own_fn(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	const struct var *var = result_var(c, at);
	struct result first = c->now;
	int pin = next_input(row, -1);
	bool good = true;

	c->now = (struct result){ .there = true, .type = var ? var->type : IEC_NONE };
	if (!first.there)
		return il_report(c, line, DIAG_IL_NO_RESULT, row->word);
	if (pin < 0 || row->pin[pin].type == IEC_NONE || !var ||
	    var->type == IEC_NONE)
		return il_report(c, line, DIAG_WRONG_TYPE, row->word);
	good = il_can_store(c, line, first, row->pin[pin].type);
	if (line->operand)
		good &= check_operand(c, row, line, &pin);
	for (int i = at + 1; good && is_arg(c, i); i++)
		good &= check_operand(c, row, &c->il->line[i], &pin);
	while (good && (pin = next_input(row, pin)) >= 0)
		if (!row->pin[pin].has_init)
			return il_report(c, line, DIAG_MISSING_INPUT,
					 row->pin[pin].name);
	return il_check_in_outs(c, at, row) && good;
}
