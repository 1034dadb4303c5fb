/* SPDX-License-Identifier: MIT
 *
 * check_il - walks an instruction list with the type of its current result.
 */
#include "engine/check/il_check.h"

#include "engine/model/advice.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

struct diag il_place(const struct scope *scope, const struct pou *pou,
		     const struct il_line *line, enum diag_id id)
{
	struct diag place = {
		.id = id, .file = pou->file, .line = (int)line->line,
		.pou = scope_text(scope, pou->name), .rung = (int)line->rung,
	};

	if (line->rung) {
		place.row = line->row;
		place.col = line->col;
	} else {
		place.column = line->col ? line->col : line->row;
	}
	return place;
}

bool il_report(struct il_check *c, const struct il_line *line,
		   enum diag_id id, const char *arg)
{
	return diag_add(c->diags, il_place(c->scope, c->pou, line, id), "%s", arg);
}

/* Is it what translation made, no name of anybody's? */
static bool is_made(const struct il_check *c, const char *operand)
{
	return c->pou->language == LANGUAGE_LD && operand[0] == '_' &&
	       (operand[1] == 'N' || operand[1] == 'T');
}

bool il_report_types(struct il_check *c, const struct il_line *line,
			 enum iec_type from, enum iec_type to)
{
	const struct il_line *call = line;
	const char *operand = line->operand ?
		scope_text(c->scope, line->operand) : "";
	char text[LIMIT_ARG];

	while (call->kind == IL_ARG_IN && call > c->il->line)
		call--;
	if (call != line && call->mark & IL_NAMED) { /* its operand may be nobody's */
		snprintf(text, sizeof(text), "%s and %s: %.20s.%.16s",
			 iec_type_row(from)->word, iec_type_row(to)->word,
			 scope_row(c->scope, (enum word)call->word)->word,
			 scope_text(c->scope, line->pin));
		return il_report(c, line, DIAG_NEEDS_CONVERSION, text);
	}
	if (is_made(c, operand))
		operand = "";
	snprintf(text, sizeof(text), "%s and %s%s%.24s", iec_type_row(from)->word,
		 iec_type_row(to)->word, *operand ? ": " : "", operand);
	return il_report(c, line, DIAG_NEEDS_CONVERSION, text);
}

const char *il_operand_text(struct il_check *c, const struct il_line *line)
{
	return scope_text(c->scope, line->operand);
}

bool il_report_near(struct il_check *c, const struct il_line *line, enum diag_id id,
		    unsigned int kinds)
{
	char text[LIMIT_ARG];

	advice_word(scope_project(c->scope), c->pou, kinds, c->diags,
		    il_operand_text(c, line), text, sizeof(text));
	return il_report(c, line, id, text);
}

static void report_unknown(struct il_check *c, const struct il_line *line,
			   enum diag_id why)
{
	unsigned int kinds = EXPECT_VARIABLE | EXPECT_INSTANCE;

	if (line->kind == IL_OP && line->op == OP_CAL)
		kinds = EXPECT_INSTANCE | EXPECT_SUBROUTINE;
	if (why == DIAG_UNKNOWN_NAME)
		il_report_near(c, line, why, kinds);
	else
		il_report(c, line, why, il_operand_text(c, line));
}

static const struct meaning *find(struct il_check *c, const struct il_line *line)
{
	enum diag_id why = DIAG_UNKNOWN_NAME;
	const struct meaning *m = scope_find(c->scope, c->pou, line->operand,
					     &why);
	char array[LIMIT_ARG];

	if (m)
		return m;
	/* The index may be a temporary that nobody wrote. */
	if ((why == DIAG_INDEX_TYPE || why == DIAG_INDEX_PLAIN) && c->pou->language == LANGUAGE_LD) {
		const char *text = il_operand_text(c, line);

		snprintf(array, sizeof(array), "%.*s", (int)strcspn(text, "["),
			 text);
		il_report(c, line, why, array);
	} else {
		report_unknown(c, line, why);
	}
	return NULL;
}

/* The operand as a value to read; NULL after a diagnostic. */
static const struct meaning *as_value(struct il_check *c, const struct il_line *line,
				      const struct meaning *m)
{
	if (m && meaning_fault(m) != DIAG_COUNT) {
		il_report(c, line, meaning_fault(m), il_operand_text(c, line));
		return NULL;
	}
	if (m && m->kind == MEANING_STRUCT) {
		il_report(c, line, DIAG_STRUCT_AS_VALUE,
			  is_made(c, il_operand_text(c, line)) ?
			  scope_row(c->scope, (enum word)m->word)->word :
			  il_operand_text(c, line));
		return NULL;
	}
	return m;
}

const struct meaning *il_value_of(struct il_check *c,
				      const struct il_line *line)
{
	return as_value(c, line, find(c, line));
}

struct result il_result_of(const struct meaning *m)
{
	struct result out = { .there = true, .type = m->type };

	if (m->kind == MEANING_LITERAL && m->type == IEC_NONE)
		out.literal = &m->literal;
	return out;
}

/* An untyped constant that is no value of @to: out of its range, or of another
 * kind; then with an example of the right one. */
bool il_report_constant(struct il_check *c, const struct il_line *line,
			    const struct literal *literal, enum iec_type to)
{
	static const struct { uint16_t class; const char *like; } kind[] = {
		{ CLASS_BOOL, "TRUE" }, { CLASS_TIME, "T#5s" },
		{ CLASS_REAL, "1.5" }, { ANY_INT | CLASS_BITS, "5" },
		{ CLASS_TOD, "TOD#08:30:00" }, { CLASS_DATE, "D#2026-11-21" },
		{ CLASS_DT, "DT#2026-11-21-08:30:00" }, { CLASS_STRING, "'text'" },
	};
	const struct iec_type_row *row = iec_type_row(to);
	char text[LIMIT_ARG];
	int k = 0;

	if (row->class & (ANY_NUM | CLASS_BITS) &&
	    (!literal->real || row->class == CLASS_REAL))
		return il_report(c, line, DIAG_LITERAL_RANGE, row->word);
	while (!(kind[k].class & row->class))
		k++;
	snprintf(text, sizeof(text), "must be %s, such as %s", row->word,
		 kind[k].like);
	return il_report(c, line, DIAG_WRONG_CONSTANT, text);
}

/* After an error was told: a result that fits everywhere. */
bool il_is_unknown(struct result result)
{
	return result.there && result.type == IEC_NONE && !result.literal;
}

/* Can the value go to @to? An untyped constant must fit. */
static bool can_store(struct il_check *c, const struct il_line *line,
		      struct result from, enum iec_type to)
{
	union iec_value value;

	if (from.literal) {
		if (literal_fit(from.literal, to, &value))
			return true;
		return il_report_constant(c, line, from.literal, to);
	}
	if (il_is_unknown(from))
		return false;
	if (iec_can_widen(from.type, to))
		return true;
	return il_report_types(c, line, from.type, to);
}

static bool can_write(struct il_check *c, const struct il_line *line,
		      const struct meaning *m)
{
	if (line->mark & IL_MADE && m->var && m->pou == c->pou &&
	    vars_flags(&c->pou->vars, m->index) & VAR_SFC)
		return true;
	if (m->kind == MEANING_LITERAL || m->constant)
		return il_report(c, line, DIAG_WRITE_CONSTANT, il_operand_text(c, line));
	if (!m->writable)
		return il_report(c, line, m->kind == MEANING_PIN ?
			      DIAG_PIN_DIRECTION : DIAG_WRITE_INPUT,
			      il_operand_text(c, line));
	return true;
}

bool il_need_result(struct il_check *c, const struct il_line *line)
{
	return c->now.there ||
	       il_report(c, line, DIAG_IL_NO_RESULT, il_operand_text(c, line));
}

bool il_need_bool(struct il_check *c, const struct il_line *line,
		      struct result result, const char *what)
{
	union iec_value value;

	if (result.type == IEC_BOOL ||
	    (result.literal && literal_fit(result.literal, IEC_BOOL, &value)))
		return true;
	if (il_is_unknown(result))
		return false;
	return il_report(c, line, DIAG_NOT_BOOL, what);
}

static bool check_load(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct meaning *m = find(c, line);

	if (il_loads_whole(c, at, m)) {
		c->now = (struct result){ .there = true, .whole = m };
		return true;
	}
	m = as_value(c, line, m);
	/* After an error: a result that complains no more. */
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	if (!m)
		return false;
	if (line->modifiers & MOD_N && !il_is_bits(il_result_of(m)))
		return il_need_bool(c, line, il_result_of(m), il_operand_text(c, line));
	c->now = il_result_of(m);
	return true;
}

static bool check_store(struct il_check *c, const struct il_line *line)
{
	const struct meaning *m = il_value_of(c, line);
	bool bits = line->op != OP_ST ||
		    (line->modifiers & MOD_N && !(m && il_is_bits(il_result_of(m))));

	if (!m || !il_need_result(c, line) || !can_write(c, line, m))
		return false;
	if (bits && (!il_need_bool(c, line, c->now, "the result") ||
		     !il_need_bool(c, line, il_result_of(m), il_operand_text(c, line))))
		return false;
	return can_store(c, line, c->now, m->type);
}

/* For check_own.c. */
const struct meaning *il_find(struct il_check *c, const struct il_line *line)
{
	return find(c, line);
}

bool il_can_store(struct il_check *c, const struct il_line *line,
		  struct result from, enum iec_type to)
{
	return can_store(c, line, from, to);
}

bool il_can_write(struct il_check *c, const struct il_line *line,
		  const struct meaning *m)
{
	return can_write(c, line, m);
}

/* ---- functions and calls ---- */

static bool is_arg(const struct il_check *c, int at)
{
	return at < c->il->count && (c->il->line[at].kind == IL_ARG_IN ||
				     c->il->line[at].kind == IL_ARG_OUT);
}

/* The operands behind the first input: `MAX Low, High`. -1 after a diagnostic. */
static int read_inputs(struct il_check *c, int at, struct result *in)
{
	int count = 1;

	for (int i = at; i == at ? c->il->line[i].operand != 0 : is_arg(c, i); i++) {
		const struct meaning *m = il_value_of(c, &c->il->line[i]);

		if (!m)
			return -1;
		if (count == LIMIT_FN_INPUTS) {
			il_report(c, &c->il->line[i], DIAG_TOO_MANY_OPERANDS,
				  il_operand_text(c, &c->il->line[i]));
			return -1;
		}
		in[count++] = il_result_of(m);
	}
	return count;
}

/* The line with the word that it is on inputs of these types. */
static struct il_line overloaded(const struct il_line *line, const struct result *in,
				 int count)
{
	struct il_line out = *line;

	if (count == 2)
		out.word = (uint16_t)fn_overload((enum word)line->word, in[0].type,
						 in[1].type);
	return out;
}

/* A function on the current result: ADD 5. */
static bool check_fn(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	struct il_line runs;
	struct result in[LIMIT_FN_INPUTS] = { c->now };
	enum iec_type stored;
	int count;

	if (!il_need_result(c, line))
		return false;
	if (line->modifiers & MOD_PAREN)
		return il_open_paren(c, line, true);
	c->now = (struct result){ .there = true,
		.type = word_is_test(row) ? IEC_BOOL : IEC_NONE };
	count = read_inputs(c, at, in);
	if (count < 0)
		return false;
	if (count > row->most_inputs && row->pin_count > 1)
		return il_report(c, line, DIAG_TOO_MANY_OPERANDS, row->word);
	if (count < row->pin_count || count > row->most_inputs)
		return il_report(c, line, DIAG_MISSING_INPUT, row->word);
	runs = overloaded(line, in, count);
	row = scope_row(c->scope, (enum word)runs.word);
	stored = il_stored_type(c->scope, c->pou, c->il, at);
	if (!il_check_inputs(c, &runs, in, count, IEC_NONE, common))
		return false;
	c->now = (struct result){
		.there = true, .type = fn_result(row, *common, stored),
	};
	return true;
}

/* Type of the variable behind OUT =>. */
static enum iec_type out_type(struct il_check *c, int at)
{
	enum diag_id why;

	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->il->line[i];
		const struct meaning *m;

		if (arg->kind != IL_ARG_OUT ||
		    strcasecmp(scope_text(c->scope, arg->pin), "OUT") != 0)
			continue;
		m = scope_find(c->scope, c->pou, arg->operand, &why);
		return m ? m->type : IEC_NONE;
	}
	return IEC_NONE;
}

/* ADD(EN := …, IN1 := …, ENO => …, OUT => …): the lines behind @at. */
static bool check_call(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	struct result in[LIMIT_FN_INPUTS] = { { .there = false } };
	struct il_line runs;
	struct result out;
	enum iec_type stored;
	int count = 0, last = 0;
	bool good = true;

	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->il->line[i];
		const char *pin = scope_text(c->scope, arg->pin);
		int index = word_pin_find(row, pin, strlen(pin));
		const struct meaning *m;

		if (arg->kind != IL_ARG_IN)
			continue;
		m = il_value_of(c, arg);
		if (!m) {
			good = false;
		} else if (strcasecmp(pin, "EN") == 0) {
			good &= il_need_bool(c, arg, il_result_of(m),
					  il_operand_text(c, arg));
		} else if (index < 0 || index >= LIMIT_FN_INPUTS) {
			good = il_report(c, arg, DIAG_NO_PIN, pin);
		} else {
			count += !in[index].there;
			in[index] = il_result_of(m);
			last = index > last ? index : last;
		}
	}
	if (!good)
		return false;
	if (count < row->pin_count || count != last + 1)
		return il_report(c, line, DIAG_MISSING_INPUT, row->word);
	runs = overloaded(line, in, count);
	row = scope_row(c->scope, (enum word)runs.word);
	stored = out_type(c, at);
	if (!il_check_inputs(c, &runs, in, count, word_shares(row) ? stored :
			  IEC_NONE, common))
		return false;
	out = (struct result){ .there = true,
			       .type = fn_result(row, *common, stored) };
	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->il->line[i];
		const char *pin = scope_text(c->scope, arg->pin);
		const struct meaning *m;

		if (arg->kind != IL_ARG_OUT)
			continue;
		m = il_value_of(c, arg);
		if (!m || !can_write(c, arg, m))
			good = false;
		else if (strcasecmp(pin, "ENO") == 0)
			good &= il_need_bool(c, arg, il_result_of(m),
					  il_operand_text(c, arg));
		else if (strcasecmp(pin, "OUT") == 0)
			good &= can_store(c, arg, out, m->type);
		else
			good = il_report(c, arg, DIAG_NO_PIN, pin);
	}
	c->now.there = false;
	return good;
}

/* ---- the walk ---- */

static bool check_op(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];

	if (line->modifiers & ~op_row((enum op)line->op)->modifiers)
		return il_report(c, line, DIAG_IL_MODIFIER,
			      op_row((enum op)line->op)->word);
	switch ((enum op)line->op) {
	case OP_LD:
		return check_load(c, at);
	case OP_ST:
		if (c->now.there && c->now.whole)
			return il_check_store_whole(c, at);
		return check_store(c, line);
	case OP_S:
	case OP_R:
		return check_store(c, line);
	case OP_AND:
	case OP_OR:
	case OP_XOR:
		return il_check_logic(c, line);
	case OP_NOT:
		return il_check_not(c, line);
	case OP_JMP:
	case OP_RET:
	case OP_STP:
		return il_check_flow(c, line);
	case OP_CAL:
		return il_check_cal(c, at);
	case OP_COUNT:
		break;
	}
	return false;
}

static bool check_line(struct il_check *c, int at, enum iec_type *type)
{
	const struct il_line *line = &c->il->line[at];
	bool good = true;

	switch ((enum il_kind)line->kind) {
	case IL_OP:
		good = check_op(c, at);
		break;
	case IL_FN:
		if (word_is_own((enum word)line->word))
			return il_check_own_fn(c, at);
		return check_fn(c, at, type);
	case IL_CALL:
		if (word_is_own((enum word)line->word))
			return il_check_own_call(c, at);
		if (il_is_whole_move(c, at))
			return il_check_whole_move(c, at);
		return check_call(c, at, type);
	case IL_CLOSE:
		return il_check_close(c, at, type);
	case IL_LABEL:
		if (c->depth > 0)
			good = il_report(c, line, DIAG_IL_OPEN_PAREN,
				      il_operand_text(c, line));
		c->depth = 0;
		c->now.there = false;
		break;
	case IL_EACH:
	case IL_TICK:
		c->now.there = false;
		break;
	case IL_TARGET:
	case IL_ARG_IN:
	case IL_ARG_OUT:
	case IL_COMMENT:
		break;
	}
	*type = c->now.type;
	return good;
}

/* One byte a folded name. Two labels of one name are an error. */
static bool find_labels(struct il_check *c, struct arena *scratch)
{
	struct names *names = &scope_project(c->scope)->names;
	bool good = true;

	for (int i = 0; i < c->il->count; i++)
		if (c->il->line[i].kind == IL_LABEL)
			names_fold(names, c->il->line[i].operand);
	c->label_count = (uint32_t)names->count;
	c->label = arena_alloc(scratch, c->label_count);
	if (!c->label)
		return false;
	for (int i = 0; i < c->il->count; i++) {
		const struct il_line *line = &c->il->line[i];
		uint32_t fold;

		if (line->kind != IL_LABEL)
			continue;
		fold = names_fold(names, line->operand);
		if (c->label[fold] && c->pou->language == LANGUAGE_IL)
			good = il_report(c, line, DIAG_DUPLICATE_LABEL,
				      il_operand_text(c, line));
		c->label[fold] = 1;
	}
	return good;
}

bool check_il(struct scope *scope, const struct pou *pou, const struct il *il,
	      struct arena *scratch, enum iec_type *types,
	      struct diag_list *diags)
{
	struct il_check c = {
		.scope = scope, .pou = pou, .il = il, .types = types,
		.diags = diags,
	};
	bool good = find_labels(&c, scratch);

	c.opened = arena_alloc(scratch, LIMIT_IL_DEPTH * sizeof(*c.opened));
	if (!c.label || !c.opened)
		return false;
	for (int i = 0; i < il->count; i++)
		good &= check_line(&c, i, &types[i]);
	if (c.depth > 0 && il->count > 0)
		good = il_report(&c, &il->line[il->count - 1], DIAG_IL_OPEN_PAREN,
			      "(");
	return good;
}
