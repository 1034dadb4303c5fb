/* SPDX-License-Identifier: MIT
 *
 * check_operand - every name in a cell: known, of the right kind, writable.
 *
 * What it finds good it notes in uses. It judges no labels and no topology.
 */
#include "engine/check/operand_check.h"

#include "engine/base/ascii.h"
#include "engine/model/advice.h"
#include "engine/model/args.h"
#include "engine/model/loop.h"

#include <stdio.h>
#include <string.h>

bool operand_report(struct operand_check *c, enum diag_id id, struct operand_spot at,
		   const char *arg)
{
	struct diag place = {
		.id = id, .file = c->pou->file, .line = rung_line(c->rung, at.row + 1),
		.pou = project_text(c->project, c->pou->name),
		.rung = c->number, .row = at.row + 1, .col = at.col + 1,
	};
	bool good = diag_add(c->diags, place, "%s", arg);

	c->good &= good;
	return good;
}

/* @kinds: of the words that may have been meant. */
static void report_unknown(struct operand_check *c, struct operand_spot at, uint32_t id,
			   enum diag_id why, unsigned int kinds)
{
	const char *name = project_text(c->project, id);
	char text[LIMIT_ARG];

	if (why != DIAG_UNKNOWN_NAME) {
		operand_report(c, why, at, name);
		return;
	}
	advice_word(c->project, c->pou, kinds, c->diags, name, text, sizeof(text));
	operand_report(c, why, at, text);
}

/* The meaning of @id, or NULL after a diagnostic. */
const struct meaning *operand_find(struct operand_check *c, struct operand_spot at,
				  uint32_t id)
{
	enum diag_id why = DIAG_UNKNOWN_NAME;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &why);

	if (!m)
		report_unknown(c, at, id, why, EXPECT_VARIABLE | EXPECT_INSTANCE);
	else if (scope_is_condition(m) && !c->condition)
		operand_report(c, DIAG_SFC_TRANSITION, at, project_text(c->project, id));
	else
		uses_add_index(c->uses, c->scope, c->pou, id, m);
	return m;
}

uint32_t operand_intern(struct operand_check *c, const char *text, size_t len)
{
	return names_intern(&c->project->names, text, len);
}

/* What is named wrongly is at least not unused: one mistake, one message. */
const struct meaning *operand_refuse(struct operand_check *c, enum diag_id id,
				    struct operand_spot at, uint32_t name,
				    const struct meaning *m)
{
	operand_report(c, id, at, project_text(c->project, name));
	uses_add(c->uses, m, USE_READ | USE_WRITTEN);
	return NULL;
}

/* A whole array goes to a parameter of the project's own words, or to another; check_il
 * looks at its bounds. */
bool operand_is_array(struct operand_check *c, uint32_t id)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &why);

	return m && m->kind == MEANING_ARRAY;
}

/* A name whose value is asked for. NULL after a diagnostic. */
const struct meaning *operand_read(struct operand_check *c, struct operand_spot at,
				       uint32_t id)
{
	const struct meaning *m = operand_find(c, at, id);

	if (!m)
		return NULL;
	if (meaning_fault(m) != DIAG_COUNT)
		return operand_refuse(c, meaning_fault(m), at, id, m);
	uses_add(c->uses, m, USE_READ);
	return m;
}

/* Why a program cannot write here; DIAG_COUNT: it can. */
static enum diag_id write_fault(const struct meaning *m)
{
	if (meaning_fault(m) != DIAG_COUNT)
		return meaning_fault(m);
	if (m->constant || m->kind == MEANING_LITERAL)
		return DIAG_WRITE_CONSTANT;
	if (m->writable)
		return DIAG_COUNT;
	return m->kind == MEANING_PIN ? DIAG_PIN_DIRECTION : DIAG_WRITE_INPUT;
}

/* @always: written at every evaluation, as a coil does; two such places
 * fight. */
const struct meaning *operand_write(struct operand_check *c, struct operand_spot at,
					uint32_t id, bool always)
{
	const struct meaning *m = operand_find(c, at, id);
	enum diag_id fault;

	if (!m)
		return NULL;
	fault = write_fault(m);
	if (fault != DIAG_COUNT)
		return operand_refuse(c, fault, at, id, m);
	/* What stands in a chart is not done in every scan: it does not fight. */
	always &= c->pou->language != LANGUAGE_SFC;
	if (uses_add(c->uses, m, always ? USE_WRITTEN | USE_COIL : USE_WRITTEN))
		operand_report(c, DIAG_COIL_TWICE, at, project_text(c->project, id));
	return m;
}

static void check_bool(struct operand_check *c, struct operand_spot at, uint32_t id,
		       const struct meaning *m)
{
	if (m && m->type != IEC_BOOL)
		operand_report(c, DIAG_NOT_BOOL, at, project_text(c->project, id));
}

/* A whole array that is written. */
void operand_write_array(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	const struct meaning *m = operand_find(c, at, id);

	if (m->constant || !m->writable)
		operand_refuse(c, m->constant ? DIAG_WRITE_CONSTANT : DIAG_WRITE_INPUT,
		       at, id, m);
	else
		uses_add(c->uses, m, USE_WRITTEN);
}

/* FOR I := 1 TO 10 BY 2: one way, which a constant tells. */
static void check_loop(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	const struct names *names = &c->project->names;
	const struct meaning *m;
	struct loop loop;

	if (!loop_parse(names_text(names, id), names_len(names, id), &loop)) {
		operand_report(c, DIAG_LOOP_FORM, at, names_text(names, id));
		return;
	}
	m = operand_write(c, at, operand_intern(c, loop.variable.text, loop.variable.len),
		       false);
	if (m)
		uses_add(c->uses, m, USE_READ);
	operand_read(c, at, operand_intern(c, loop.from.text, loop.from.len));
	operand_read(c, at, operand_intern(c, loop.to.text, loop.to.len));
	if (loop.step == 0)
		operand_report(c, DIAG_LOOP_FORM, at, "BY 0");
}

/* ---- boxes ---- */

/* IN17 of a function that takes up to 16. */
static bool is_numbered(const struct word_row *row, const struct arg *arg)
{
	return row->most_inputs > row->pin_count && arg->pin_len > 2 &&
	       ascii_same(arg->pin, "IN", 2) && ascii_digit(arg->pin[2]);
}

/* What is wrong with the pin of a parameter; DIAG_COUNT: nothing. Functions
 * have EN, ENO and OUT beside the inputs of their row. */
static enum diag_id judge_pin(const struct word_row *row, const struct arg *arg)
{
	int index = word_pin_find(row, arg->pin, arg->pin_len);
	bool output;

	if (index >= row->pin_count)
		output = false;
	else if (index >= 0)
		output = row->pin[index].dir == PIN_OUT;
	else if (row->kind != WORD_FN)
		return DIAG_NO_PIN;
	else if (ascii_is("EN", arg->pin, arg->pin_len))
		output = false;
	else if (ascii_is("ENO", arg->pin, arg->pin_len) ||
		 ascii_is("OUT", arg->pin, arg->pin_len))
		output = true;
	else
		return is_numbered(row, arg) ? DIAG_TOO_MANY_OPERANDS : DIAG_NO_PIN;
	if (arg->inverse && index >= 0 && index < row->pin_count &&
	    row->pin[index].dir == PIN_IN_OUT)
		return DIAG_PIN_DIRECTION; /* nothing comes back through a / */
	return output == arg->output ? DIAG_COUNT : DIAG_PIN_DIRECTION;
}

/* A parameter that the box changes, too. */
static bool is_in_out(const struct word_row *row, const struct arg *arg)
{
	int index = word_pin_find(row, arg->pin, arg->pin_len);

	return index >= 0 && index < row->pin_count &&
	       row->pin[index].dir == PIN_IN_OUT;
}

void operand_change(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	const struct meaning *m = operand_find(c, at, id);

	if (m && m->kind == MEANING_INSTANCE)
		uses_add(c->uses, m, USE_READ | USE_WRITTEN);
	else if (m && operand_write(c, at, id, false))
		uses_add(c->uses, m, USE_READ);
}

static void use_whole_array(struct operand_check *c, struct operand_spot at, uint32_t id,
			    const struct arg *arg, bool in_out)
{
	const struct meaning *m = operand_find(c, at, id);
	bool write = arg->output || in_out;

	if (!m)
		return;
	if (arg->inverse)
		operand_refuse(c, DIAG_ARRAY_AS_VALUE, at, id, m);
	else if (write && (m->constant || !m->writable))
		operand_refuse(c, m->constant ? DIAG_WRITE_CONSTANT : DIAG_WRITE_INPUT,
		       at, id, m);
	else
		uses_add(c->uses, m, (write ? USE_WRITTEN : 0u) |
				     (arg->output ? 0u : USE_READ));
}

static void check_args(struct operand_check *c, struct operand_spot at,
		       const struct cell *cell)
{
	const struct word_row *row = words_row(&c->project->words, (enum word)cell->word);
	const char *next = project_text(c->project, cell->args);
	bool whole = word_is_own((enum word)cell->word) || cell->word == FN_MOVE;
	struct arg arg;

	while (args_next(&next, &arg)) {
		enum diag_id wrong = judge_pin(row, &arg);
		uint32_t value = operand_intern(c, arg.value, arg.value_len);

		if (wrong != DIAG_COUNT)
			operand_report(c, wrong, at, project_text(c->project,
				operand_intern(c, arg.pin, arg.pin_len)));
		else if (whole && operand_is_array(c, value))
			use_whole_array(c, at, value, &arg,
					is_in_out(row, &arg));
		else if (is_in_out(row, &arg))
			operand_change(c, at, value);
		else if (arg.output)
			operand_write(c, at, value, row->kind == WORD_FB);
		else if (arg.inverse)
			check_bool(c, at, value, operand_read(c, at, value));
		else
			operand_read(c, at, value);
	}
}

/* Bit i is set for input i of a function that a parameter or a pin row feeds. */
static unsigned int connected_inputs(const struct operand_check *c,
				     struct operand_spot at, const struct cell *cell)
{
	const struct word_row *row = words_row(&c->project->words, (enum word)cell->word);
	const char *next = project_text(c->project, cell->args);
	unsigned int inputs = 0;
	struct arg arg;
	int pin;

	while (args_next(&next, &arg)) {
		pin = word_pin_find(row, arg.pin, arg.pin_len);
		if (pin >= 0)
			inputs |= 1u << pin;
	}
	for (int i = at.row + 1; i < c->rung->rows; i++) {
		const struct cell *below = rung_at(c->rung, i, at.col);
		const char *name = project_text(c->project, below->operand);

		if (below->word != ELEM_PIN)
			break;
		pin = word_pin_find(row, name, strlen(name));
		if (pin >= 0)
			inputs |= 1u << pin;
	}
	return inputs;
}

static bool has_pin_row(const struct operand_check *c, struct operand_spot at,
			const char *name)
{
	for (int i = at.row + 1; i < c->rung->rows; i++) {
		const struct cell *below = rung_at(c->rung, i, at.col);
		const char *text = project_text(c->project, below->operand);

		if (below->word != ELEM_PIN)
			break;
		if (ascii_is(text, name, strlen(name)))
			return true;
	}
	return false;
}

/* What is the project's own needs its inputs that have no value. */
static void check_own_inputs(struct operand_check *c, struct operand_spot at,
			     const struct cell *cell, const struct word_row *row)
{
	const char *args = project_text(c->project, cell->args);
	struct arg arg;

	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		bool needed = pin->dir == PIN_IN_OUT ||
			      (row->kind == WORD_FN && pin->dir == PIN_IN &&
			       !pin->has_init);

		if (!needed || has_pin_row(c, at, pin->name) ||
		    args_find(args, pin->name, strlen(pin->name), &arg))
			continue;
		operand_report(c, DIAG_MISSING_INPUT, at, pin->name);
		return;
	}
}

/* A function needs all its named inputs, and of the others no gap. */
static void check_inputs(struct operand_check *c, struct operand_spot at,
			 const struct cell *cell)
{
	const struct word_row *row = words_row(&c->project->words, (enum word)cell->word);
	unsigned int inputs;
	char name[24];

	if (word_is_own((enum word)cell->word)) {
		check_own_inputs(c, at, cell, row);
		return;
	}
	inputs = connected_inputs(c, at, cell);

	for (int i = 0; i < row->pin_count || inputs >> i; i++) {
		if (inputs >> i & 1)
			continue;
		if (i < row->pin_count)
			snprintf(name, sizeof(name), "%s", row->pin[i].name);
		else
			snprintf(name, sizeof(name), "IN%d",
				 i - (row->pin_count - 1) + word_last_number(row));
		operand_report(c, DIAG_MISSING_INPUT, at, name);
		return;
	}
}

static void check_instance(struct operand_check *c, struct operand_spot at,
			   const struct cell *cell)
{
	const struct meaning *m = operand_find(c, at, cell->operand);
	const char *name = project_text(c->project, cell->operand);

	if (!m)
		return;
	if (m->kind != MEANING_INSTANCE || m->word != (enum word)cell->word)
		operand_refuse(c, DIAG_NOT_INSTANCE, at, cell->operand, m);
	else if (uses_add(c->uses, m, USE_CALLED))
		operand_report(c, DIAG_INSTANCE_TWICE, at, name);
}

static void check_routine(struct operand_check *c, struct operand_spot at, uint32_t name)
{
	const struct pou *pou = scope_pou(c->scope, c->pou, name);

	enum diag_id why;

	if (!pou && !scope_find(c->scope, c->pou, name, &why))
		report_unknown(c, at, name, DIAG_UNKNOWN_NAME, EXPECT_SUBROUTINE);
	else if (!pou || pou->kind != POU_SUBROUTINE)
		operand_report(c, DIAG_NOT_SUBROUTINE, at, project_text(c->project, name));
}

static void check_element(struct operand_check *c, struct operand_spot at,
			  const struct cell *cell)
{
	const struct word_row *row = words_row(&c->project->words, (enum word)cell->word);

	if (row->edge != EDGE_NONE && c->pou->kind == POU_FUNCTION)
		operand_report(c, DIAG_FUNCTION_KEEPS, at,
		       project_text(c->project, cell->operand));
	if (cell->word == ELEM_END &&
	    (c->pou->kind != POU_PROGRAM || c->pou->language == LANGUAGE_SFC))
		operand_report(c, DIAG_END_ELSEWHERE, at, pou_word(c->pou->kind));
	switch (row->operand) {
	case OPND_BOOL_R:
		check_bool(c, at, cell->operand,
			   operand_read(c, at, cell->operand));
		break;
	case OPND_BOOL_W:
		check_bool(c, at, cell->operand,
			   operand_write(c, at, cell->operand,
				      row->next == OP_ST));
		break;
	case OPND_EXPR:
	case OPND_ASSIGN:
		operand_expression(c, at, cell->operand);
		break;
	case OPND_INSTANCE:
		check_instance(c, at, cell);
		break;
	case OPND_LOOP:
		check_loop(c, at, cell->operand);
		break;
	case OPND_ROUTINE:
		check_routine(c, at, cell->operand);
		break;
	case OPND_LOOP_END:
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_NONE:
	case OPND_LABEL:
	case OPND_PIN:
		break;
	}
	if (cell->args)
		check_args(c, at, cell);
	if (row->kind == WORD_FN || word_is_own((enum word)cell->word))
		check_inputs(c, at, cell);
}

bool check_operands(struct operand_check *c)
{
	const struct rung *rung = c->rung;
	const struct cell *cell = rung->cell;

	c->good = true;
	for (int row = 0; row < rung->rows; row++) {
		for (int col = 0; col < rung->cols; col++, cell++) {
			struct operand_spot at = { row, col };

			if (cell->word != ELEM_EMPTY && cell->word != ELEM_WIRE)
				check_element(c, at, cell);
		}
	}
	return c->good;
}
