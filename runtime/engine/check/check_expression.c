/* SPDX-License-Identifier: MIT
 *
 * check_expression - names, indices and functions in the expression of a cell.
 *
 * A part of check_operand. Types are check_il's.
 */
#include "engine/check/operand_check.h"

#include "engine/model/expr_args.h"

#include <stdio.h>

/* An index that is an expression: of the array @id, or an address, which then is one;
 * @tail: the path behind it. The type of the index is check_il's. Returns the text of the
 * first element behind it; 0 after a diagnostic. */
static uint32_t use_index(struct operand_check *c, struct operand_spot at, uint32_t id,
			  struct expr_tail tail)
{
	const struct meaning *m = operand_find(c, at, id);

	if (m && m->kind != MEANING_ARRAY && m->kind != MEANING_ADDRESS) {
		operand_refuse(c, DIAG_NOT_ARRAY, at, id, m);
		return 0;
	}
	id = m ? scope_first(c->scope, c->pou, id, tail.text, tail.len) : 0;
	if (m && !id)
		operand_report(c, DIAG_NAME_TOO_LONG, at, "");
	return id;
}

/* The same of a whole path; @end is its last index. */
static uint32_t use_indices(struct operand_check *c, struct operand_spot at,
			    const struct expr *expr, int end)
{
	int16_t chain[LIMIT_INDICES];
	int count = 0;
	uint32_t id = 0;

	for (; end >= 0 && count < LIMIT_INDICES; end = expr->node[end].right)
		chain[count++] = (int16_t)end;
	if (end >= 0) {
		operand_report(c, DIAG_INDEX_PLAIN, at, "");
		return 0;
	}
	for (int i = count - 1; i >= 0; i--) {
		const struct expr_node *part = &expr->node[chain[i]];

		if (part->right < 0)
			id = operand_intern(c, part->text, part->len);
		id = use_index(c, at, id, part->tail);
		if (!id)
			return 0;
	}
	return id;
}

/* What such a path leads to, as it is of the first elements. @whole: it may be an
 * array. */
static void use_element(struct operand_check *c, struct operand_spot at, uint32_t id,
			bool write, bool whole)
{
	const struct meaning *m = id ? operand_find(c, at, id) : NULL;

	if (!m)
		return;
	if (m->kind == MEANING_INSTANCE)
		operand_refuse(c, DIAG_INDEX_PLAIN, at, id, m);
	else if (m->kind == MEANING_ARRAY && !whole)
		operand_refuse(c, DIAG_ARRAY_AS_VALUE, at, id, m);
	else if (write && m->constant)
		operand_refuse(c, DIAG_WRITE_CONSTANT, at, id, m);
	else if (write && !m->writable)
		operand_refuse(c, DIAG_WRITE_INPUT, at, id, m);
	else
		uses_add(c->uses, m, write ? USE_WRITTEN : USE_READ);
}

/* A value, or if @whole an array, too. */
static void read_whole(struct operand_check *c, struct operand_spot at, uint32_t id, bool whole)
{
	if (whole && operand_is_array(c, id))
		uses_add(c->uses, operand_find(c, at, id), USE_READ);
	else
		operand_read(c, at, id);
}

/* What an assignment writes. */
static void use_target(struct operand_check *c, struct operand_spot at, const struct expr *expr)
{
	uint32_t id = operand_intern(c, expr->target, expr->target_len);

	if (expr->target_index >= 0) {
		if (expr->target_base >= 0)
			id = use_indices(c, at, expr, expr->target_base);
		id = id ? use_index(c, at, id, expr->target_tail) : 0;
		use_element(c, at, id, true, true);
	} else if (operand_is_array(c, id)) {
		operand_write_array(c, at, id);
	} else {
		operand_write(c, at, id, false);
	}
}

/* ---- functions ---- */

/* `LIMIT.MX`, `LIMIT.4` of the fourth argument, if there is no such input. */
static void report_call(struct operand_check *c, struct operand_spot at, enum diag_id why,
			const struct expr_node *call, const struct word_row *row,
			const struct expr_args *args)
{
	const int name = call->len < LIMIT_NAME ? call->len : LIMIT_NAME;
	const int len = args->len < LIMIT_ARG ? args->len : LIMIT_ARG;
	char text[LIMIT_NAME + LIMIT_ARG + 2], pin[LIMIT_NAME + 1];

	if (args->wrong >= 0)
		expr_pin_name(row, args->wrong, pin, sizeof(pin));
	else
		snprintf(pin, sizeof(pin), "%.*s", len, args->text);
	snprintf(text, sizeof(text), "%.*s%s%.*s", name, call->text,
		 *pin ? "." : "", LIMIT_ARG, pin);
	operand_report(c, why, at, text);
}

/* An argument of a function of the project's own that it takes as it is. */
static void note_place(struct operand_check *c, struct operand_spot at,
		       struct expr_node *value, const struct word_pin *pin)
{
	if (!pin->elements && pin->type != IEC_NONE && pin->dir != PIN_IN_OUT)
		return;
	value->whole = true;
	if (value->op != EXPR_NAME && value->op != EXPR_INDEX)
		operand_report(c, pin->dir == PIN_IN_OUT ? DIAG_WRITE_CONSTANT :
			       DIAG_WRONG_TYPE, at, pin->name);
	else if (value->op == EXPR_NAME && pin->dir == PIN_IN_OUT && !pin->elements)
		operand_change(c, at, operand_intern(c, value->text, value->len));
	else if (value->op == EXPR_NAME && pin->dir == PIN_IN_OUT)
		operand_write_array(c, at, operand_intern(c, value->text, value->len));
}

static void check_call(struct operand_check *c, struct operand_spot at, struct expr *expr,
		       const struct expr_node *call)
{
	struct word_table *words = &c->project->words;
	enum word word = expr_function(words, call);
	const struct word_row *row = words_row(words, word);
	struct expr_args args = { .wrong = -1, .text = "" };
	enum diag_id why;

	if (word == WORD_COUNT) {
		report_call(c, at, words_find(words, call->text, call->len) == WORD_COUNT ?
			    DIAG_UNKNOWN_WORD : DIAG_NOT_FUNCTION, call, row, &args);
		return;
	}
	why = expr_match(expr, call, row, &args);
	if (why == DIAG_NO_PIN && !args.len) { /* no name: its number */
		char number[16];

		args.len = snprintf(number, sizeof(number), "%d", args.number);
		args.text = number;
		report_call(c, at, why, call, row, &args);
	} else if (why != DIAG_COUNT) {
		report_call(c, at, why, call, row, &args);
	} else if (word_is_own(word)) {
		for (int i = 0; i < args.count; i++)
			note_place(c, at, &expr->node[args.arg[i].at],
				   &row->pin[args.arg[i].pin]);
	}
}

void operand_expression(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	struct names *names = &c->project->names;
	const char *text = names_text(names, id);
	struct expr *expr = c->expr;
	struct diag place = {
		.file = c->pou->file, .line = rung_line(c->rung, at.row + 1),
		.pou = project_text(c->project, c->pou->name),
		.rung = c->number, .row = at.row + 1, .col = at.col + 1,
	};

	if (!expr_parse_text(text, names_len(names, id), expr, c->diags,
			     place)) {
		c->good = false;
		return;
	}
	if (expr->target)
		expr->node[expr->root].whole = true;
	for (int i = 0; i < expr->count; i++)
		if (expr->node[i].op == EXPR_CALL)
			check_call(c, at, expr, &expr->node[i]);
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *part = &expr->node[i];

		if (part->op == EXPR_NAME)
			read_whole(c, at, operand_intern(c, part->text, part->len),
				   part->whole);
		else if (part->op == EXPR_INDEX && !part->inner)
			use_element(c, at, use_indices(c, at, expr, i), false,
				    part->whole);
		else if (part->op == EXPR_LITERAL)
			operand_find(c, at, operand_intern(c, part->text, part->len));
	}
	if (expr->target)
		use_target(c, at, expr);
}
