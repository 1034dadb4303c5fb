/* SPDX-License-Identifier: MIT
 *
 * check_operand - every name in a cell: known, of the right kind, writable.
 *
 * It notes good operands in uses. It does not judge labels or topology.
 */
#include "engine/check/check_operand.h"

#include "engine/base/name.h"

#include "engine/base/ascii.h"
#include "engine/check/attempt.h"
#include "engine/check/generic.h"
#include "engine/check/split.h"
#include "engine/model/dialect.h"
#include "engine/model/named.h"
#include "engine/model/advice.h"
#include "engine/model/args.h"
#include "engine/check/infer.h"
#include "engine/model/expr_args.h"
#include "engine/model/fbd.h"
#include "engine/model/loop.h"
#include "engine/model/st.h"

#include <stdio.h>
#include <string.h>

/* A cell of the rung, 0-based. */
struct operand_spot {
	int row, col;
};

static struct diag operand_place(const struct operand_check *c, enum diag_id id,
				 struct operand_spot at)
{
	struct diag place = { .id = id, .file = c->pou->file,
			      .pou = project_text(c->project, c->pou->name) };

	if (!c->rung) {
		st_where(&c->project->names, c->item, c->spot, &place.line, &place.column);
		return place;
	}
	place.line = rung_line(c->rung, at.row + 1);
	place.rung = c->number;
	place.row = at.row + 1;
	place.col = at.col + 1;
	return place;
}

static bool operand_report(struct operand_check *c, enum diag_id id, struct operand_spot at,
		   const char *arg)
{
	struct diag place = operand_place(c, id, at);
	bool good = diag_add(c->diags, place, "%s", arg);

	c->good &= good;
	return good;
}

/* 5s, 0xFF, T#5: how this list of statements writes it. DIAG_COUNT: it is nothing of the kind. */
static enum diag_id foreign_constant(const char *name, char *out, size_t size)
{
	const bool based = name[0] == '0' && (name[1] | 32) == 'x';
	const char *digits = based ? name + 2 : name, *hash = strchr(name, '#');
	char timed[LIMIT_NAME + 8];
	int64_t ns;

	if (strlen(name) > 40 || (name[0] | 32) < '0')
		return DIAG_COUNT;
	if (based && *digits && strspn(digits, "0123456789abcdefABCDEF_") == strlen(digits)) {
		snprintf(out, size, "%.40s" DIAG_AND "16#%.40s", name, digits);
		return DIAG_ST_FOREIGN;
	}
	snprintf(timed, sizeof(timed), "T#%s", name);
	if (name[0] >= '0' && name[0] <= '9' && literal_parse_duration(name, strlen(name), &ns)) {
		snprintf(out, size, "%.40s" DIAG_AND "%.44s", name, timed);
		return DIAG_ST_FOREIGN;
	}
	snprintf(timed, sizeof(timed), "%sms", name);
	if (hash && (name[0] | 32) == 't' && hash[1] && strspn(hash + 1, "0123456789") == strlen(hash + 1) &&
	    literal_parse_duration(strchr(timed, '#') + 1, strlen(strchr(timed, '#') + 1), &ns)) {
		snprintf(out, size, "%.40s" DIAG_AND "TIME" DIAG_AND "%.44s", name, timed);
		return DIAG_WRONG_CONSTANT;
	}
	return DIAG_COUNT;
}

/* A wire of another network. */
static bool said_elsewhere(struct operand_check *c, struct operand_spot at, const char *name)
{
	const size_t len = strcspn(name, ".[^");
	char text[2 * LIMIT_ARG];

	for (int i = 0; c->pou->fbd && i < c->pou->fbd->count; i++) {
		const int wire = fbd_wire(&c->project->names, c->pou, i, name, len);

		if (wire < 0)
			continue;
		snprintf(text, sizeof(text), "%.*s" DIAG_AND "%d", len < LIMIT_ARG ? (int)len : LIMIT_ARG - 1, name,
			 c->pou->vars.var[wire].line);
		return !operand_report(c, DIAG_FBD_ELSEWHERE, at, text);
	}
	return false;
}

/* @kinds: kinds of words to suggest in the message. */
static void report_unknown(struct operand_check *c, struct operand_spot at, uint32_t id,
			   enum diag_id why, unsigned int kinds)
{
	const char *name = project_text(c->project, id);
	char text[2 * LIMIT_ARG];
	const enum diag_id foreign = !c->statement ? DIAG_COUNT : foreign_constant(name, text, sizeof(text));

	if (foreign != DIAG_COUNT) {
		operand_report(c, foreign, at, text);
		return;
	}
	if (why != DIAG_UNKNOWN_NAME) {
		char told[2 * LIMIT_ARG];

		if (why == DIAG_NO_PIN && strchr(name, '.'))
			advice_word(c->project, c->pou, EXPECT_PIN, c->diags, name, told, sizeof(told));
		else
			scope_tell(c->scope, c->pou, why, id, told, sizeof(told));
		operand_report(c, why, at, told);
		return;
	}
	if (said_elsewhere(c, at, name))
		return;
	const enum diag_id better = advice_word(c->project, c->pou, kinds, c->diags, name, text,
						sizeof(text));

	operand_report(c, better != DIAG_COUNT ? better : why, at, text);
}

/* M8000: an address without a variable that other tools set by themselves. */
bool operand_special(const char *name, const struct meaning *m, char *out, size_t size)
{
	struct dialect_special special;
	char address[40];

	if (m->kind != MEANING_ADDRESS || m->var || m->addr.area == AREA_SM || *name == '%' ||
	    !dialect_special(name, strlen(name), &special))
		return false;
	iec_addr_print(m->addr, address, sizeof(address));
	snprintf(out, size, "%.40s" DIAG_AND "%s" DIAG_AND "%s", name, special.tool,
		 *special.ours ? special.ours : address);
	return true;
}

static void said_special(struct operand_check *c, struct operand_spot at, const char *name,
			 const struct meaning *m)
{
	char text[LIMIT_PARTS];

	if (operand_special(name, m, text, sizeof(text)))
		operand_report(c, DIAG_SET_BY_OTHERS, at, text);
}

/* The meaning of @id, or NULL after a diagnostic. */
static const struct meaning *operand_find_for(struct operand_check *c, struct operand_spot at,
				      uint32_t id, bool write)
{
	enum diag_id why = DIAG_UNKNOWN_NAME;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &why);

	if (!m)
		report_unknown(c, at, id, why, EXPECT_VARIABLE | EXPECT_INSTANCE);
	else if (m->within && operand_report(c, write ? DIAG_WRITE_WITHIN : DIAG_WITHIN_BLOCK, at,
					     scope_said(c->scope, id)))
		uses_add_index(c->uses, c->scope, c->pou, id, m);
	else if (scope_is_condition(m) && !c->condition)
		operand_report(c, DIAG_SFC_TRANSITION, at, project_text(c->project, id));
	else
		uses_add_index(c->uses, c->scope, c->pou, id, m);
	if (m && m->within)
		uses_add_within(c->uses, m, write ? USE_WRITTEN : USE_READ);
	if (m)
		said_special(c, at, project_text(c->project, id), m);
	return m;
}

static const struct meaning *operand_find(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	return operand_find_for(c, at, id, false);
}

static uint32_t operand_intern(struct operand_check *c, const char *text, size_t len)
{
	return names_intern(&c->project->names, text, len);
}

/* Marks a wrong name as used, so that no second message says "never used". */
static const struct meaning *operand_refuse(struct operand_check *c, enum diag_id id,
				    struct operand_spot at, uint32_t name,
				    const struct meaning *m)
{
	operand_report(c, id, at, m->address_of && (id == DIAG_NO_REFERENCE || id == DIAG_POINTER_ITSELF) ?
			   project_text(c->project, name) + 1 : scope_said(c->scope, name));
	uses_add(c->uses, m, USE_READ | USE_WRITTEN);
	return NULL;
}

/* May a whole array stand here? As a parameter of a POU of the project, or copied to another
 * array; check_il compares the bounds. */
static bool operand_is_array(struct operand_check *c, uint32_t id)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &why);

	return m && m->kind == MEANING_ARRAY;
}

/* A name that is read. NULL after a diagnostic. */
static const struct meaning *operand_read(struct operand_check *c, struct operand_spot at,
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

/* A VAR_IN_OUT may leave alone what it gets: the body itself stores nothing there. */
static unsigned int use_written(const struct operand_check *c)
{
	return c->passing ? USE_PASSED : USE_WRITTEN;
}

/* Why a program cannot write here; DIAG_COUNT: it can. */
static enum diag_id write_fault(const struct meaning *m)
{
	if (meaning_fault(m) != DIAG_COUNT)
		return meaning_fault(m);
	if (m->constant || m->kind == MEANING_LITERAL)
		return DIAG_WRITE_CONSTANT;
	if (m->address_of)
		return m->var->target ? DIAG_POINTER_ITSELF : DIAG_NO_REFERENCE;
	if (m->writable)
		return DIAG_COUNT;
	if (m->within)
		return DIAG_STORE_WITHIN;
	return m->kind == MEANING_PIN ? DIAG_PIN_DIRECTION : DIAG_WRITE_INPUT;
}

/* @always: written at every evaluation, as a coil does; report_coils() tells such places. */
static const struct meaning *operand_write(struct operand_check *c, struct operand_spot at,
					uint32_t id, bool always)
{
	enum diag_id fault = DIAG_COUNT;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &fault);

	if (m && m->within && write_fault(m) != DIAG_COUNT) /* it can only be read, and no more is said of it */
		return operand_refuse(c, write_fault(m), at, id, m);
	m = operand_find_for(c, at, id, true);
	if (!m)
		return NULL;
	fault = write_fault(m);
	if (fault != DIAG_COUNT)
		return operand_refuse(c, fault, at, id, m);
	/* Writes in a chart do not happen in every scan, so two of them are no conflict. */
	always &= c->pou->language != LANGUAGE_SFC;
	if (always) {
		const struct diag place = operand_place(c, DIAG_COIL_TWICE, at);

		uses_add_coil(c->uses, m, (struct use_coil){
			.pou = c->pou, .name = id, .line = place.line, .column = place.column,
			.rung = place.rung, .row = place.row, .col = place.col });
	} else {
		uses_add(c->uses, m, use_written(c));
	}
	return m;
}

static void check_bool(struct operand_check *c, struct operand_spot at, uint32_t id,
		       const struct meaning *m)
{
	if (m && m->type != IEC_BOOL)
		operand_report(c, DIAG_NOT_BOOL, at, scope_said(c->scope, id));
}

/* A whole array that is written. */
static void operand_write_array(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	const struct meaning *m = operand_find(c, at, id);

	if (m->constant || !m->writable)
		operand_refuse(c, m->constant ? DIAG_WRITE_CONSTANT : DIAG_WRITE_INPUT,
		       at, id, m);
	else
		uses_add(c->uses, m, use_written(c));
}

/* FOR I := 1 TO 10 BY 2: the sign of a constant BY gives the direction. */
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
		operand_report(c, DIAG_LOOP_STEP, at, "");
}

/* ---- boxes ---- */

/* IN17 of a function that takes up to 16. */
static bool is_numbered(const struct word_row *row, const struct arg *arg)
{
	return row->most_inputs > row->pin_count && arg->pin_len > 2 &&
	       ascii_same(arg->pin, "IN", 2) && ascii_digit(arg->pin[2]);
}

/* The error of a parameter's pin; DIAG_COUNT: none. Functions have EN, ENO and OUT beside the
 * inputs of their row. */
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
		return DIAG_IN_OUT_INVERTED; /* nothing comes back through a / */
	if (output == arg->output)
		return DIAG_COUNT;
	return output ? DIAG_PIN_DIRECTION : DIAG_INPUT_READ;
}

/* A parameter for VAR_IN_OUT. */
static bool is_in_out(const struct word_row *row, const struct arg *arg)
{
	int index = word_pin_find(row, arg->pin, arg->pin_len);

	return index >= 0 && index < row->pin_count &&
	       row->pin[index].dir == PIN_IN_OUT;
}

static void operand_change(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	const struct meaning *m = operand_find(c, at, id);

	if (m && m->kind == MEANING_INSTANCE)
		uses_add(c->uses, m, USE_READ | USE_WRITTEN);
	else if (m) {
		c->passing = true;
		if (operand_write(c, at, id, false))
			uses_add(c->uses, m, USE_READ);
		c->passing = false;
	}
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
		uses_add(c->uses, m, arg->output ? USE_WRITTEN : in_out ? USE_PASSED | USE_READ : USE_READ);
}

/* Refuses the pin of @arg. EQ A := 5, MOVE A => B: with the pins that its two values belong to. @alone: there is no
 * other parameter. */
static void refuse_pin(struct operand_check *c, struct operand_spot at, const struct word_row *row, const struct arg *arg,
		       enum diag_id why, bool alone)
{
	const uint32_t id = operand_intern(c, arg->pin, arg->pin_len), value = operand_intern(c, arg->value, arg->value_len);
	const char *name = project_text(c->project, id), *other = project_text(c->project, value);
	const bool store = row->kind == WORD_FN && row->pin_count == 1;
	char text[4 * LIMIT_ARG];
	enum diag_id none;

	if (why != DIAG_NO_PIN || !alone || row->kind != WORD_FN || row->pin_count > 2 ||
	    !scope_find(c->scope, c->pou, id, &none))
		snprintf(text, sizeof(text), "%s", name);
	else if (store)
		snprintf(text, sizeof(text), "%.40s" DIAG_AND "%s:=%.40s OUT=>%.40s", name, row->pin[0].name,
			 arg->output ? name : other, arg->output ? other : name);
	else
		snprintf(text, sizeof(text), "%.40s" DIAG_AND "%s:=%.40s %s:=%.40s", name, row->pin[0].name, name,
			 row->pin[1].name, other);
	operand_report(c, why, at, text);
}

/* False: a pin has the wrong name or direction. */
static bool check_args(struct operand_check *c, struct operand_spot at,
		       const struct cell *cell)
{
	const struct word_row *row = words_row(&c->project->words, (enum word)cell->word);
	const char *next = project_text(c->project, cell->args);
	bool whole = word_is_own((enum word)cell->word) || cell->word == FN_MOVE, good = true;
	struct arg arg;
	int count = 0;

	while (args_next(&next, &arg)) {
		enum diag_id wrong = judge_pin(row, &arg);

		good = good && wrong == DIAG_COUNT;
		uint32_t value = operand_intern(c, arg.value, arg.value_len);

		if (wrong != DIAG_COUNT)
			refuse_pin(c, at, row, &arg, wrong, count == 0 && !*next);
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
		count++;
	}
	return good;
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
		if (name_is(text, name, strlen(name)))
			return true;
	}
	return false;
}

/* POUs of the project: every input without a default must be given. */
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

/* Functions of the catalogue: every named input, and no gap among the numbered ones. */
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

static void refuse_instance(struct operand_check *c, struct operand_spot at,
			    const struct cell *cell, const struct meaning *m)
{
	const char *name = project_text(c->project, cell->operand);
	const char *contact = cell->word == FB_R_TRIG ? "P" : cell->word == FB_F_TRIG ? "N" : NULL;
	char text[2 * LIMIT_ARG];

	if (contact && m->type == IEC_BOOL)
		snprintf(text, sizeof(text), "%.30s" DIAG_AND "%.30s" DIAG_AND "%s %.30s", name,
			 scope_row(c->scope, (enum word)cell->word)->word, contact, name);
	else
		snprintf(text, sizeof(text), "%.30s" DIAG_AND "%.30s", name, scope_row(c->scope, (enum word)cell->word)->word);
	operand_report(c, DIAG_NOT_INSTANCE, at, text);
	uses_add(c->uses, m, USE_READ | USE_WRITTEN);
}

static void check_instance(struct operand_check *c, struct operand_spot at,
			   const struct cell *cell)
{
	const struct meaning *m = operand_find(c, at, cell->operand);
	const char *name = project_text(c->project, cell->operand);

	if (!m)
		return;
	if (m->kind != MEANING_INSTANCE ||
	    generic_plain(c->project, (enum word)m->word) != (enum word)cell->word)
		refuse_instance(c, at, cell, m);
	else if (meaning_is_indexed(m)) /* the cells of a box have one instance */
		operand_refuse(c, DIAG_INDEX_PLAIN, at, cell->operand, m);
	else if (uses_add(c->uses, m, USE_CALLED))
		operand_report(c, DIAG_INSTANCE_TWICE, at, name);
}

static void check_routine(struct operand_check *c, struct operand_spot at, uint32_t name)
{
	const struct pou *pou = scope_pou(c->scope, c->pou, name);

	enum diag_id why;

	if (!pou && !scope_find(c->scope, c->pou, name, &why))
		report_unknown(c, at, name, DIAG_UNKNOWN_NAME, EXPECT_SUBROUTINE);
	else if (!pou || (pou->kind != POU_SUBROUTINE && pou->kind != POU_ACTION))
		operand_report(c, DIAG_NOT_SUBROUTINE, at, project_text(c->project, name));
}

/* Checks an index that is an expression, of the array @id or of an address; @tail is the path
 * after it. check_il checks the type of the index. Returns the text of the first element after
 * it; 0 after a diagnostic. */
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

/* The same for a whole path; @end is its last index. */
static uint32_t use_indices(struct operand_check *c, struct operand_spot at,
			    const struct expr *expr, int end)
{
	int16_t chain[LIMIT_INDICES];
	int count = 0;
	uint32_t id = 0;

	for (; end >= 0 && count < LIMIT_INDICES; end = expr->node[end].right)
		chain[count++] = (int16_t)end;
	if (end >= 0) {
		operand_report(c, DIAG_INDICES_MANY, at, "");
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

/* The meaning of such a path for the first elements. @whole: an array is allowed. */
static void use_element(struct operand_check *c, struct operand_spot at, uint32_t id,
			bool write, bool whole)
{
	const struct meaning *m = id ? operand_find(c, at, id) : NULL;

	if (!m)
		return;
	if (m->kind == MEANING_INSTANCE)
		operand_refuse(c, DIAG_INSTANCE_AS_VALUE, at, id, m);
	else if (m->kind == MEANING_ARRAY && !whole)
		operand_refuse(c, DIAG_ARRAY_AS_VALUE, at, id, m);
	else if (write && m->constant)
		operand_refuse(c, DIAG_WRITE_CONSTANT, at, id, m);
	else if (write && !m->writable)
		operand_refuse(c, DIAG_WRITE_INPUT, at, id, m);
	else
		uses_add(c->uses, m, write ? use_written(c) : USE_READ);
}

/* A value, or if @whole an array, too, and if @instance an instance. */
static void read_whole(struct operand_check *c, struct operand_spot at, uint32_t id, bool whole,
		       bool instance)
{
	enum diag_id why;
	const struct meaning *m = whole ? scope_find(c->scope, c->pou, id, &why) : NULL;

	if (m && (m->kind == MEANING_ARRAY || (instance && m->kind == MEANING_INSTANCE)))
		uses_add(c->uses, operand_find(c, at, id), USE_READ);
	else
		operand_read(c, at, id);
}

/* `Word.3`, `Word.%B1`: has the place such a part? @id: the place, or its first element. */
static void check_bit(struct operand_check *c, struct operand_spot at, uint32_t id,
		      struct expr_tail tail)
{
	enum diag_id why;
	const struct meaning *m = id ? scope_find(c->scope, c->pou, id, &why) : NULL;
	unsigned int bits, number;
	char text[LIMIT_ARG];

	if (!m || meaning_fault(m) != DIAG_COUNT)
		return;
	if (iec_type_row(m->type)->class & (ANY_INT | CLASS_BITS) && expr_part(tail, &bits, &number) &&
	    bits * (number + 1) <= 8u * iec_type_row(m->type)->size)
		return;
	snprintf(text, sizeof(text), "%.*s" DIAG_AND "%.24s", tail.len < 24 ? tail.len : 24, tail.text,
		 m->type == IEC_NONE ? scope_row(c->scope, (enum word)m->word)->word :
		 iec_type_row(m->type)->word);
	operand_report(c, DIAG_NO_SUCH_PART, at, text);
}

/* May a pointer lead to the place @node? */
static void check_place(struct operand_check *c, struct operand_spot at, struct expr *expr,
			struct expr_node *node)
{
	char text[LIMIT_NAME + 4];
	const struct meaning *m;
	enum diag_id why;
	uint32_t id;

	node->whole = true;
	if (node->op == EXPR_INDEX)
		id = use_indices(c, at, expr, (int)(node - expr->node));
	else
		id = node->op == EXPR_NAME ? operand_intern(c, node->text, node->len) : 0;
	if (!id && node->op == EXPR_INDEX)
		return;
	m = id ? scope_find(c->scope, c->pou, id, &why) : NULL;
	snprintf(text, sizeof(text), "%.*s", node->len < LIMIT_NAME ? node->len : LIMIT_NAME, node->text);
	if (id && !m)
		return; /* as any other unknown name */
	if (!m)
		operand_report(c, DIAG_ADR_OF, at, node->len ? text : "+");
	else if (!m->var || (m->constant && !m->through) || m->addr.area != AREA_NONE)
		operand_refuse(c, DIAG_ADR_OF, at, id, m);
	else
		uses_add(c->uses, m, USE_READ | USE_WRITTEN);
}

/* What an assignment writes. */
static void use_target(struct operand_check *c, struct operand_spot at, struct expr *expr)
{
	uint32_t id = operand_intern(c, expr->target, expr->target_len);

	if (expr->target_points) {
		struct expr_node *root = &expr->node[expr->root];
		const struct meaning *m;
		char text[3 * LIMIT_NAME + 2];

		if (expr->target_base >= 0)
			id = use_indices(c, at, expr, expr->target_base);
		if (expr->target_index >= 0 && id)
			id = use_index(c, at, id, expr->target_tail);
		if (!id)
			return;
		snprintf(text, sizeof(text), "@%.*s", (int)sizeof(text) - 2, project_text(c->project, id));
		m = operand_write(c, at, operand_intern(c, text, strlen(text)), false);
		if (m && !(m->like && m->like->target))
			operand_report(c, DIAG_NO_REFERENCE, at, text + 1);
		c->spot = root->text;
		check_place(c, at, expr, root);
		return;
	}
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
	if (expr->target_tried && c->good) {
		const enum attempt attempt = attempt_of(c->scope, c->pou, expr);
		char text[LIMIT_NAME + 4];

		snprintf(text, sizeof(text), "%.*s", expr->target_len < LIMIT_NAME ? (int)expr->target_len : LIMIT_NAME,
			 expr->target);
		c->spot = expr->target;
		if (attempt != ATTEMPT_STORES)
			operand_report(c, attempt == ATTEMPT_NULL ? DIAG_ATTEMPT_NULL : DIAG_ATTEMPT_OF, at, text);
	}
	if (expr->target_bit.len) {
		const struct meaning *m = id ? operand_find(c, at, id) : NULL;

		if (m)
			uses_add(c->uses, m, USE_READ);
		check_bit(c, at, id, expr->target_bit);
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

/* W.3 where only a whole variable can stand. */
static void report_part(struct operand_check *c, struct operand_spot at, const struct expr *expr, int node)
{
	const struct expr_node *part = &expr->node[node], *whole = &expr->node[part->left];
	const char *end = part->tail.text + part->tail.len;
	const int len = end > whole->text && end - whole->text < LIMIT_ARG ? (int)(end - whole->text) : 0;
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%.*s", len ? len : part->tail.len, len ? whole->text : part->tail.text);
	c->spot = whole->text;
	operand_report(c, DIAG_WHOLE_WANTED, at, text);
}

/* An argument for a VAR_IN_OUT, or a structure or array, of a function of the project. */
static void note_place(struct operand_check *c, struct operand_spot at, const struct expr *expr,
		       struct expr_node *value, const struct word_pin *pin)
{
	if (!pin->elements && pin->type != IEC_NONE && pin->dir != PIN_IN_OUT)
		return;
	value->whole = true;
	if (value->op == EXPR_CALL && pin->dir != PIN_IN_OUT)
		return; /* check_il compares the types */
	if (value->op == EXPR_BIT && pin->dir == PIN_IN_OUT)
		report_part(c, at, expr, (int)(value - expr->node));
	else if (value->op != EXPR_NAME && value->op != EXPR_INDEX)
		operand_report(c, pin->dir == PIN_IN_OUT ? DIAG_WRITE_CONSTANT :
			       DIAG_WRONG_TYPE, at, pin->name);
	else if (value->op == EXPR_NAME && pin->dir == PIN_IN_OUT && !pin->elements)
		operand_change(c, at, operand_intern(c, value->text, value->len));
	else if (value->op == EXPR_NAME && pin->dir == PIN_IN_OUT) {
		c->passing = true;
		operand_write_array(c, at, operand_intern(c, value->text, value->len));
		c->passing = false;
	}
}

/* A variable or element that a => of a call writes. */
static void use_stored(struct operand_check *c, struct operand_spot at, struct expr *expr, struct expr_node *to)
{
	uint32_t id;

	if (to->op == EXPR_INDEX) {
		use_element(c, at, use_indices(c, at, expr, (int)(to - expr->node)), true, true);
		return;
	}
	id = operand_intern(c, to->text, to->len);
	if (to->op != EXPR_NAME)
		operand_report(c, DIAG_WRITE_CONSTANT, at, project_text(c->project, id));
	else if (operand_is_array(c, id))
		operand_write_array(c, at, id);
	else
		operand_write(c, at, id, false);
}

/* EN and outputs of a call. */
static void note_others(struct operand_check *c, struct operand_spot at, struct expr *expr,
			const struct expr_args *args)
{
	for (int i = 0; i < args->more; i++) {
		struct expr_node *value = &expr->node[args->other[i].at];

		if (args->other[i].pin == EXPR_EN)
			continue;
		value->written = value->op != EXPR_BIT; /* a part is read, too */
		use_stored(c, at, expr, value->op == EXPR_BIT ? &expr->node[value->left] : value);
	}
}

/* ADR, SIZEOF, __ISVALIDREF; false: another call. */
static bool use_measured(struct operand_check *c, struct operand_spot at, struct expr *expr,
			 const struct expr_node *call)
{
	enum expr_measure what;
	struct expr_node *of = expr_measured(expr, call, &what);
	const struct meaning *m;
	enum diag_id why;
	char text[LIMIT_NAME + 2];

	if (!of)
		return false;
	c->spot = of->text;
	if (what == MEASURE_PLACE) {
		check_place(c, at, expr, of);
		return true;
	}
	of->whole = true;
	snprintf(text, sizeof(text), "%s%.*s", what == MEASURE_VALID ? "@" : "",
		 of->len < LIMIT_NAME ? of->len : LIMIT_NAME, of->text);
	m = of->op == EXPR_NAME ? scope_find(c->scope, c->pou, operand_intern(c, text, strlen(text)), &why) :
				  NULL;
	if (of->op == EXPR_NAME && !m && what == MEASURE_SIZE && scope_type_bytes(c->scope, of->text, of->len)) {
		of->written = true; /* it is no variable that is read */
		return true;
	}
	if (of->op != EXPR_NAME || (m && what == MEASURE_VALID && !(m->like && m->like->target)))
		operand_report(c, what == MEASURE_VALID ? DIAG_NO_REFERENCE : DIAG_ADR_OF, at,
			       of->len ? text + (*text == '@') : "+");
	else if (m)
		uses_add(c->uses, m, USE_READ);
	return true;
}

/* LOWER_BOUND, UPPER_BOUND; false: another call. */
static bool use_bound(struct operand_check *c, struct operand_spot at, struct expr *expr,
		      const struct expr_node *call)
{
	struct expr_bound bound;
	char text[LIMIT_NAME + 1];
	int64_t value;

	if (!expr_is_bound(call))
		return false;
	snprintf(text, sizeof(text), "%.*s", call->len < LIMIT_NAME ? call->len : LIMIT_NAME, call->text);
	if (!expr_bound(expr, call, &bound) || !bound_value(c->scope, c->pou, expr, &bound, &value))
		operand_report(c, DIAG_BOUND_OF, at, text);
	for (int at_arg = call->left; at_arg >= 0; at_arg = expr->node[at_arg].right)
		expr->node[expr->node[at_arg].left].whole = true;
	return true;
}

/* `Table(1)` for Table[1]. */
static bool is_array_name(struct operand_check *c, const struct expr_node *call)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, operand_intern(c, call->text, call->len), &why);

	return m && m->kind == MEANING_ARRAY;
}

/* PREVIOUS(Wire), R_EDGE(value), F_EDGE(value) in a network. False: none of them. */
static bool use_fbd_word(struct operand_check *c, struct operand_spot at, struct expr *expr,
			 const struct expr_node *call)
{
	struct names *names = &c->project->names;
	struct expr_node *of = NULL;
	const enum fbd_word word = fbd_word(expr, call, &of);
	char text[LIMIT_ARG];
	int wire;

	if (word == FBD_NO_WORD)
		return false;
	if (c->pou->kind == POU_FUNCTION) {
		snprintf(text, sizeof(text), "%.*s", call->len < 40 ? call->len : 40, call->text);
		operand_report(c, DIAG_FBD_KEEPS, at, text);
	}
	if (word != FBD_PREVIOUS) {
		struct infer in = { .scope = c->scope, .pou = c->pou, .project = c->project, .expr = expr,
				    .statement = true };
		const enum iec_type type = infer_type(&in, (int)(of - expr->node));

		if (type != IEC_BOOL && type != IEC_NONE) {
			snprintf(text, sizeof(text), "%.*s", of->len < LIMIT_ARG ? of->len : LIMIT_ARG - 1,
				 of->text ? of->text : "");
			c->spot = of->text ? of->text : c->spot;
			operand_report(c, DIAG_NOT_BOOL, at, text);
		}
		return true;
	}
	wire = of->op != EXPR_NAME || c->network < 0 ? -1 : fbd_wire(names, c->pou, c->network, of->text, of->len);
	if (wire < 0) {
		snprintf(text, sizeof(text), "%.*s", of->len < LIMIT_ARG ? of->len : LIMIT_ARG - 1,
			 of->text ? of->text : "");
		operand_report(c, DIAG_FBD_PREVIOUS, at, *text ? text : "PREVIOUS");
	}
	of->written = true; /* it is read by nobody else */
	return true;
}

/* F(A := 1) of a function that also has B. Only Structured Text may leave it out; boxes and lists give all. */
static bool check_left_out(struct operand_check *c, struct operand_spot at, const struct expr_node *call,
			   const struct word_row *row, const struct expr_args *args)
{
	const struct word_pin *pin = expr_left_out(row, args);
	const bool may = c->item || c->pou->language == LANGUAGE_ST;
	char text[2 * LIMIT_NAME + 2];

	if (!pin)
		return true;
	snprintf(text, sizeof(text), "%.*s.%.*s", call->len < LIMIT_NAME ? call->len : LIMIT_NAME, call->text,
		 LIMIT_NAME, pin->name);
	operand_report(c, may ? DIAG_LEFT_OUT : DIAG_MISSING_INPUT, at, text);
	return may;
}

static void check_call(struct operand_check *c, struct operand_spot at, struct expr *expr,
		       const struct expr_node *call)
{
	struct word_table *words = &c->project->words;
	const enum word plain = expr_function(words, call);
	const enum word word = generic_word(c->scope, c->pou, expr, call, plain);
	const struct word_row *row = words_row(words, word);
	struct expr_args args = { .wrong = -1, .text = "" };
	enum diag_id why;

	if (word == WORD_COUNT && c->statement && expr_is_clock(call))
		return;
	if (word == WORD_COUNT && c->statement && use_measured(c, at, expr, call))
		return;
	if (word == WORD_COUNT && c->statement && use_bound(c, at, expr, call))
		return;
	if (word == WORD_COUNT && c->pou->fbd && use_fbd_word(c, at, expr, call))
		return;
	if (word == WORD_COUNT && c->statement && is_array_name(c, call)) {
		char text[2 * LIMIT_NAME + 8];
		const int len = call->len < LIMIT_NAME ? call->len : LIMIT_NAME;

		snprintf(text, sizeof(text), "%.*s(" DIAG_AND "%.*s[", len, call->text, len, call->text);
		operand_report(c, DIAG_ST_FOREIGN, at, text);
		return;
	}
	if (word == WORD_COUNT && c->statement && split_find(c->scope, c->pou, call)) {
		char text[LIMIT_NAME + 1];

		snprintf(text, sizeof(text), "%.*s", call->len, call->text);
		operand_report(c, DIAG_NO_RESULT, at, text);
		return;
	}
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
	}
	if (why != DIAG_COUNT || !check_left_out(c, at, call, row, &args))
		return;
	if (word_is_own(word) && row->owner >= 0 && c->project->pou[row->owner].no_result &&
	    !(c->item && c->item->kind == ST_CALL && call == &expr->node[expr->root]))
		operand_report(c, DIAG_NO_RESULT, at, row->word);
	if (word_is_own(word) && row->owner >= 0 && pou_has_any_bounds(&c->project->pou[row->owner])) {
		operand_report(c, DIAG_ANY_BOUNDS_OF, at, row->word);
		for (int i = 0; i < args.count; i++)
			expr->node[args.arg[i].at].whole = true;
		return;
	}
	note_others(c, at, expr, &args);
	if (word_is_own(word)) {
		for (int i = 0; i < args.count; i++)
			note_place(c, at, expr, &expr->node[args.arg[i].at],
				   &row->pin[args.arg[i].pin]);
	}
}

static bool is_test(const struct expr_node *node)
{
	return node->op == EXPR_FN && word_is_test(word_row(node->fn));
}

static bool is_plain(const struct expr_node *node)
{
	return (node->op == EXPR_NAME || node->op == EXPR_LITERAL) && node->len < 20;
}

/* `1 < A < 5` compares a BOOL with 5. A TRUE or FALSE, and a 0 or 1 for equality, may be meant. */
static bool is_chain(struct operand_check *c, struct expr *expr, const struct expr_node *node)
{
	struct infer in = { .scope = c->scope, .pou = c->pou, .project = c->project, .expr = expr,
			    .statement = c->statement };
	const struct expr_node *right;

	if (!is_test(node) || !is_test(&expr->node[node->left]))
		return false;
	right = &expr->node[node->right];
	if (right->op == EXPR_LITERAL)
		return !ascii_is("TRUE", right->text, right->len) && !ascii_is("FALSE", right->text, right->len) &&
		       (right->len > 1 || right->text[0] > '1' ||
			(node->fn != FN_EQ && node->fn != FN_NE));
	const enum iec_type type = infer_type(&in, node->right);

	return type != IEC_BOOL && type != IEC_NONE;
}

/* Reports it, with both comparisons apart where each side is one word. */
static void report_chain(struct operand_check *c, struct operand_spot at, const struct expr *expr,
			 const struct expr_node *node)
{
	static const char *const sign[] = { "=", "<>", "<", "<=", ">", ">=" };
	static const enum word word[] = { FN_EQ, FN_NE, FN_LT, FN_LE, FN_GT, FN_GE };
	const struct expr_node *first = &expr->node[node->left], *a = &expr->node[first->left],
			       *b = &expr->node[first->right], *d = &expr->node[node->right];
	const char *signs[2] = { "", "" };
	char text[LIMIT_PARTS];

	for (size_t i = 0; i < sizeof(word) / sizeof(*word); i++) {
		signs[0] = first->fn == word[i] ? sign[i] : signs[0];
		signs[1] = node->fn == word[i] ? sign[i] : signs[1];
	}
	if (is_plain(a) && is_plain(b) && is_plain(d))
		snprintf(text, sizeof(text), "%.*s %s %.*s %s %.*s" DIAG_AND "%.*s %s %.*s AND %.*s %s %.*s", a->len,
			 a->text, signs[0], b->len, b->text, signs[1], d->len, d->text, a->len, a->text, signs[0],
			 b->len, b->text, b->len, b->text, signs[1], d->len, d->text);
	else
		snprintf(text, sizeof(text), "%s", signs[1]);
	operand_report(c, DIAG_CHAIN, at, text);
}

#ifdef RUNGBOARD_SMALL
#define warn_of_count(c, at, expr) ((void)0) /* it has no room for it */
#else
/* `A = A + 1` compares. Whoever writes it means to store. */
static void warn_of_count(struct operand_check *c, struct operand_spot at, const struct expr *expr)
{
	const struct expr_node *root = &expr->node[expr->root], *a, *b, *left, *right;
	char text[LIMIT_PARTS];

	if (expr->target || root->op != EXPR_FN || root->fn != FN_EQ)
		return;
	a = &expr->node[root->left];
	b = &expr->node[root->right];
	if (a->op != EXPR_NAME || !is_plain(a) || b->op != EXPR_FN || (b->fn != FN_ADD && b->fn != FN_SUB))
		return;
	left = &expr->node[b->left];
	right = &expr->node[b->right];
	if (left->op != EXPR_NAME || right->op != EXPR_LITERAL || !is_plain(right) || a->len != left->len ||
	    !ascii_same(a->text, left->text, (size_t)a->len) || (right->len == 1 && *right->text == '0'))
		return;
	snprintf(text, sizeof(text), "%.*s = %.*s %c %.*s" DIAG_AND "%.*s := %.*s %c %.*s", a->len, a->text, a->len, a->text,
		 b->fn == FN_ADD ? '+' : '-', right->len, right->text, a->len, a->text, a->len, a->text,
		 b->fn == FN_ADD ? '+' : '-', right->len, right->text);
	operand_report(c, DIAG_STORE_MEANT, at, text);
}
#endif

/* The names of a parsed expression. */
static void use_expression(struct operand_check *c, struct operand_spot at, struct expr *expr)
{
	if (expr->target)
		expr->node[expr->root].whole = true;
	warn_of_count(c, at, expr);
	for (int i = 0; i < expr->count; i++) {
		c->spot = expr->node[i].text;
		if (expr->node[i].op == EXPR_CALL)
			check_call(c, at, expr, &expr->node[i]);
	}
	for (int i = 0; i < expr->count; i++) {
		const struct expr_node *part = &expr->node[i];

		c->spot = part->text ? part->text : c->spot;
		if (part->written)
			continue;
		if (part->op == EXPR_NAME)
			read_whole(c, at, operand_intern(c, part->text, part->len), part->whole,
				   !expr->target || expr->target_points || i != expr->root);
		else if (part->op == EXPR_INDEX && !part->inner)
			use_element(c, at, use_indices(c, at, expr, i), false,
				    part->whole);
		else if (part->op == EXPR_BIT)
			check_bit(c, at, expr->node[part->left].op == EXPR_NAME ?
				  operand_intern(c, expr->node[part->left].text,
						 expr->node[part->left].len) :
				  use_indices(c, at, expr, part->left), part->tail);
		else if (part->op == EXPR_LITERAL)
			operand_find(c, at, operand_intern(c, part->text, part->len));
	}
	c->spot = expr->target ? expr->target : c->spot;
	if (expr->target)
		use_target(c, at, expr);
	for (int i = 0; i < expr->count; i++)
		if (is_chain(c, expr, &expr->node[i])) {
			report_chain(c, at, expr, &expr->node[i]);
			return;
		}
}

static void operand_expression(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	struct names *names = &c->project->names;
	const char *text = names_text(names, id);

	if (!expr_parse_text(text, names_len(names, id), c->expr, c->diags,
			     operand_place(c, DIAG_COUNT, at))) {
		c->good = false;
		return;
	}
	use_expression(c, at, c->expr);
}

/* R Parts: other tools reset a timer or counter so. */
static bool said_block(struct operand_check *c, struct operand_spot at, uint32_t id)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, id, &why);

	if (!m || m->kind != MEANING_INSTANCE)
		return false;
	operand_refuse(c, DIAG_BLOCK_RESET, at, id, m);
	return true;
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
		if (said_block(c, at, cell->operand))
			break;
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
	case OPND_EXECUTE:
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_NONE:
	case OPND_LABEL:
	case OPND_PIN:
		break;
	}
	if (cell->args && row->operand != OPND_EXECUTE && !check_args(c, at, cell))
		return; /* an input may seem missing only because its name is wrong */
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

/* ---- statements ---- */

bool check_said(struct operand_check *c, enum diag_id id, const char *arg)
{
	return operand_report(c, id, (struct operand_spot){ 0, 0 }, arg);
}

/* The text of the first element of a place that the expression is; its indices are read. */
static uint32_t use_path(struct operand_check *c, struct expr *expr)
{
	const struct operand_spot at = { 0, 0 };
	struct expr_node *root = &expr->node[expr->root];

	if (root->op != EXPR_INDEX)
		return operand_intern(c, root->text, root->len);
	root->written = true;
	use_expression(c, at, expr);
	return use_indices(c, at, expr, expr->root);
}

/* A variable or element that stands alone and is written. */
static void use_place(struct operand_check *c, struct expr *expr, enum operand_use use)
{
	const struct operand_spot at = { 0, 0 };
	const struct expr_node *root = &expr->node[expr->root];
	uint32_t id;

	if (root->op == EXPR_INDEX) {
		const struct meaning *m;

		id = use_path(c, expr);
		m = id && use == OPERAND_CHANGED ? operand_find(c, at, id) : NULL;
		if (m && m->kind == MEANING_INSTANCE)
			uses_add(c->uses, m, USE_READ | USE_WRITTEN);
		else
			use_element(c, at, id, true, true);
		return;
	}
	if (root->op == EXPR_BIT && use == OPERAND_STORED) {
		use_expression(c, at, expr);
		use_stored(c, at, expr, &expr->node[root->left]);
		return;
	}
	if (root->op != EXPR_NAME) {
		const bool named = root->op == EXPR_LITERAL;
		char text[LIMIT_ARG];

		if (root->op == EXPR_BIT) {
			report_part(c, at, expr, expr->root);
			return;
		}
		snprintf(text, sizeof(text), "%.*s", root->len, root->text);
		operand_report(c, named ? DIAG_WRITE_CONSTANT : DIAG_EXPECTED, at,
			       named ? text : "name of a variable");
		return;
	}
	id = operand_intern(c, root->text, root->len);
	if (use == OPERAND_CHANGED && !operand_is_array(c, id))
		operand_change(c, at, id);
	else if (operand_is_array(c, id))
		operand_write_array(c, at, id);
	else
		operand_write(c, at, id, false);
}

static void use_called(struct operand_check *c, struct expr *expr)
{
	const struct operand_spot at = { 0, 0 };
	const uint32_t id = use_path(c, expr);
	const struct meaning *m = id ? operand_find(c, at, id) : NULL;

	c->spot = expr->node[expr->root].text;
	if (m && m->kind != MEANING_INSTANCE)
		operand_refuse(c, DIAG_NOT_INSTANCE, at, id, m);
	else if (m)
		uses_add(c->uses, m, USE_READ | USE_CALLED);
}

bool check_part(struct operand_check *c, struct expr *expr, enum operand_use use)
{
	struct expr_node *root = &expr->node[expr->root];
	const bool before = c->good;

	c->good = true;
	c->spot = expr->node[0].text;
	if (use == OPERAND_CALLED) {
		use_called(c, expr);
	} else if (use == OPERAND_WRITTEN || use == OPERAND_STORED || use == OPERAND_CHANGED) {
		c->passing = use == OPERAND_CHANGED;
		use_place(c, expr, use);
		c->passing = false;
	} else {
		root->whole |= use == OPERAND_WHOLE;
		use_expression(c, (struct operand_spot){ 0, 0 }, expr);
	}
	const bool good = c->good;

	c->good &= before;
	return good;
}
