/* SPDX-License-Identifier: MIT
 *
 * check_il - walks an instruction list with the type of its current result.
 */
#include "engine/check/generic.h"
#include "engine/check/check_il.h"
#include "engine/base/name.h"
#include "engine/check/constant.h"

#include "engine/model/named.h"
#include "engine/model/advice.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* A temporary that holds a constant. */
struct folded {
	const struct var *var;
	enum iec_type type;
	union iec_value value;
};
#define FOLDED_MOST 8

struct il_check {
	struct fn_check fn;
	enum iec_type *types;
	uint8_t *label;        /* by folded name: is it a label?            */
	uint32_t label_count;
	struct il_result now;
	uint32_t ended_at;   /* label that ended a result; 0: no label did  */
	bool jumps;          /* a conditional jump was seen                 */
	struct il_result in[LIMIT_FN_ARGS]; /* inputs of the function of this line */
	struct folded folded[FOLDED_MOST]; /* var NULL: free                */
	int depth;           /* of open parentheses                         */
	struct il_opened {
		struct il_result left;
		uint8_t op;          /* of AND OR XOR                       */
		enum word word;      /* of a function; 0: of an operator    */
	} *opened;           /* LIMIT_IL_DEPTH of them                      */
};

/* @operand is not of the type @wanted. */
static bool il_report_wrong(struct il_check *c, const struct il_line *line, const char *operand,
		     const char *wanted)
{
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%.30s" DIAG_AND "%.30s", il_is_made(&c->fn, operand) ? "" :
		 operand, wanted);
	return il_report(&c->fn, line, DIAG_WRONG_TYPE, text);
}

static const char *il_operand_text(struct il_check *c, const struct il_line *line)
{
	return scope_said(c->fn.scope, line->operand);
}

/* Without REF( ). */
static const char *il_name_text(struct il_check *c, const struct il_line *line)
{
	const char *text = scope_text(c->fn.scope, line->operand);

	return text + (*text == '&' || *text == '@');
}

/* The same, with likely words of @kinds in the message. */
static bool il_report_near(struct il_check *c, const struct il_line *line, enum diag_id id,
			   unsigned int kinds)
{
	char text[LIMIT_ARG];
	const enum diag_id better = advice_word(scope_project(c->fn.scope), c->fn.pou, kinds,
						c->fn.diags, il_name_text(c, line), text,
						sizeof(text));

	return il_report(&c->fn, line, better != DIAG_COUNT ? better : id, text);
}

static void report_unknown(struct il_check *c, const struct il_line *line,
			   enum diag_id why)
{
	unsigned int kinds = EXPECT_VARIABLE | EXPECT_INSTANCE;

	if (line->kind == IL_OP && line->op == OP_CAL)
		kinds = EXPECT_INSTANCE | EXPECT_SUBROUTINE;
	if (why == DIAG_UNKNOWN_NAME) {
		il_report_near(c, line, why, kinds);
	} else {
		char told[2 * LIMIT_ARG];

		if (why == DIAG_NO_PIN && strchr(il_name_text(c, line), '.'))
			advice_word(scope_project(c->fn.scope), c->fn.pou, EXPECT_PIN, c->fn.diags, il_name_text(c, line),
				    told, sizeof(told));
		else
			scope_tell(c->fn.scope, c->fn.pou, why, line->operand, told, sizeof(told));
		il_report(&c->fn, line, why, told);
	}
}

static const struct meaning *find(struct il_check *c, const struct il_line *line)
{
	enum diag_id why = DIAG_UNKNOWN_NAME;
	const struct meaning *m = scope_find(c->fn.scope, c->fn.pou, line->operand,
					     &why);
	char array[LIMIT_ARG];

	if (m && !m->several)
		return m;
	if (m)
		why = DIAG_AMBIGUOUS_VALUE;
	/* The index may be a temporary that is never written. */
	if ((why == DIAG_INDEX_TYPE || why == DIAG_INDICES_MANY) && c->fn.pou->language == LANGUAGE_LD) {
		const char *text = il_operand_text(c, line);

		snprintf(array, sizeof(array), "%.*s", (int)strcspn(text, "["),
			 text);
		il_report(&c->fn, line, why, array);
	} else {
		report_unknown(c, line, why);
	}
	return NULL;
}

/* A structure or array in a message: its name; of a result, its type. */
static const char *il_whole_text(struct il_check *c, const struct il_line *line,
				 const struct meaning *m, char out[LIMIT_ARG])
{
	const char *word = m->type == IEC_NONE ? scope_row(c->fn.scope, (enum word)m->word)->word :
						 iec_type_row(m->type)->word;

	if (!il_is_made(&c->fn, il_operand_text(c, line)))
		return il_operand_text(c, line);
	snprintf(out, LIMIT_ARG, "%s%.40s", m->kind == MEANING_ARRAY ? "ARRAY OF " : "", word);
	return out;
}

/* The operand as a value to read; NULL after a diagnostic. */
static const struct meaning *as_value(struct il_check *c, const struct il_line *line,
				      const struct meaning *m)
{
	char text[LIMIT_ARG];

	if (m && meaning_fault(m) != DIAG_COUNT) {
		il_report(&c->fn, line, m->kind == MEANING_INSTANCE && (line->op == OP_R || line->op == OP_S) ?
			  DIAG_BLOCK_RESET : meaning_fault(m), il_whole_text(c, line, m, text));
		return NULL;
	}
	if (m && m->kind == MEANING_STRUCT) {
		il_report(&c->fn, line, DIAG_STRUCT_AS_VALUE, il_whole_text(c, line, m, text));
		return NULL;
	}
	return m;
}

/* The operand as a value to read; NULL after a diagnostic. */
static const struct meaning *il_value_of(struct il_check *c,
				      const struct il_line *line)
{
	return as_value(c, line, find(c, line));
}

/* The value of a constant that has a type: of a literal such as INT#5, of a CONSTANT, of a
 * temporary that an operation on constants was stored in. */
static void find_value(const struct il_check *c, const struct meaning *m, struct il_result *out)
{
	if (m->type == IEC_NONE || m->type == IEC_STRING)
		return;
	if (m->kind == MEANING_LITERAL) {
		out->known = true;
		out->value = m->literal.value;
		return;
	}
	if (m->kind != MEANING_VARIABLE)
		return;
	if (m->constant && m->var->has_init) {
		out->known = true;
		out->value = m->var->init;
		return;
	}
	for (int i = 0; i < FOLDED_MOST; i++)
		if (c->folded[i].var == m->var) {
			out->known = true;
			out->type = c->folded[i].type;
			out->value = c->folded[i].value;
		}
}

/* The value of the operand of @line. */
static struct il_result il_result_of(const struct il_check *c, const struct il_line *line,
				  const struct meaning *m)
{
	struct il_result out = { .there = true, .type = m->type, .text = line->operand };

	if (m->kind == MEANING_LITERAL && m->type == IEC_NONE)
		out.literal = &m->literal;
	else
		find_value(c, m, &out);
	return out;
}

/* Can the value go to @to? An untyped constant must fit. */
static bool can_store(struct il_check *c, const struct il_line *line,
		      struct il_result from, enum iec_type to)
{
	union iec_value value;

	if (from.literal) {
		if (literal_fit(from.literal, to, &value))
			return true;
		return il_report_constant(&c->fn, line, from.literal, to);
	}
	if (il_is_unknown(from))
		return false;
	if (iec_can_widen(from.type, to))
		return true;
	return il_report_types(&c->fn, line, from.type, to);
}

/* May @like have the value, if that is a constant? Else it is compared in the scan. */
static bool may_hold(struct il_check *c, const struct il_line *line, struct il_result from,
		     const struct var *like)
{
	const struct project *project = scope_project(c->fn.scope);
	char text[2 * LIMIT_ARG], has[LIMIT_ARG];
	int64_t number = from.literal ? from.literal->value.i : from.value.i;

	if (!like || (!like->enumeration && !like->range) || (!from.literal && !from.known) ||
	    named_may_hold(project, like, number))
		return true;
	named_print(project, like, has, sizeof(has));
	snprintf(text, sizeof(text), "%.40s" DIAG_AND "%lld" DIAG_AND "%.60s",
		 project_text(project, like->name), (long long)number, has);
	return il_report(&c->fn, line, DIAG_OUTSIDE, text);
}

/* @var, or every temporary if it is NULL, holds no constant from here on. */
static void forget(struct il_check *c, const struct var *var)
{
	for (int i = 0; i < FOLDED_MOST; i++)
		if (!var || c->folded[i].var == var)
			c->folded[i].var = NULL;
}

/* @m is a temporary that gets @from. */
static void remember(struct il_check *c, const struct meaning *m, struct il_result from)
{
	int i = 0;

	while (i < FOLDED_MOST && c->folded[i].var)
		i++;
	if (i < FOLDED_MOST && m->kind == MEANING_VARIABLE && from.known)
		c->folded[i] = (struct folded){ m->var, from.type, from.value };
}

static bool can_write(struct il_check *c, const struct il_line *line,
		      const struct meaning *m)
{
	if (m->var)
		forget(c, m->var);
	if (line->mark & IL_MADE && m->var && m->pou == c->fn.pou &&
	    (vars_flags(&c->fn.pou->vars, m->index) & VAR_SFC || m->var->edge))
		return true;
	if (m->kind == MEANING_LITERAL || m->constant)
		return il_report(&c->fn, line, DIAG_WRITE_CONSTANT, il_operand_text(c, line));
	if (m->address_of)
		return il_report(&c->fn, line, m->var->target ? DIAG_POINTER_ITSELF : DIAG_NO_REFERENCE,
				 il_name_text(c, line));
	if (!m->writable)
		return il_report(&c->fn, line, m->within ? DIAG_STORE_WITHIN : m->kind == MEANING_PIN ?
			      DIAG_PIN_DIRECTION : DIAG_WRITE_INPUT,
			      il_operand_text(c, line));
	return true;
}

static bool no_result(struct il_check *c, const struct il_line *line, const char *what)
{
	char text[2 * LIMIT_ARG];

	if (!c->ended_at)
		return il_report(&c->fn, line, DIAG_IL_NO_RESULT, what);
	snprintf(text, sizeof(text), "%.40s" DIAG_AND "%.40s", what,
		 scope_text(c->fn.scope, c->ended_at));
	return il_report(&c->fn, line, DIAG_IL_LABEL_RESULT, text);
}

static bool il_need_result(struct il_check *c, const struct il_line *line)
{
	return c->now.there || no_result(c, line, il_operand_text(c, line));
}

/* @what names the value in the message; "": the current result. */
static bool il_need_bool(struct il_check *c, const struct il_line *line,
		      struct il_result result, const char *what)
{
	union iec_value value;

	if (result.type == IEC_BOOL ||
	    (result.literal && literal_fit(result.literal, IEC_BOOL, &value)))
		return true;
	if (il_is_unknown(result))
		return false;
	return il_report(&c->fn, line, *what ? DIAG_NOT_BOOL : DIAG_RESULT_NOT_BOOL, what);
}

/* BYTE to LWORD? */
static bool il_is_bits(struct il_result result)
{
	return iec_type_row(result.type)->class & CLASS_BITS;
}

/* ---- MOVE ---- */

static bool may_move(const struct meaning *m)
{
	return m && (m->kind == MEANING_STRUCT || m->kind == MEANING_ARRAY);
}

/* ---- LD and ST ---- */

/* The line behind @at that is no comment; count: none. */
static int next_line(const struct il_check *c, int at)
{
	do
		at++;
	while (at < c->fn.il->count && c->fn.il->line[at].kind == IL_COMMENT);
	return at;
}

static bool is_store(const struct il_check *c, int at)
{
	const struct il_line *line = at < c->fn.il->count ? &c->fn.il->line[at] : NULL;

	return line && line->kind == IL_OP && line->op == OP_ST && !line->modifiers;
}

/* Is @m a structure or array that LD at @at loads and the lines behind
 * it only store? */
static bool il_loads_whole(struct il_check *c, int at, const struct meaning *m)
{
	return may_move(m) && !c->fn.il->line[at].modifiers &&
	       is_store(c, next_line(c, at));
}

static bool check_load(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct meaning *m = find(c, line);

	if (il_loads_whole(c, at, m)) {
		c->now = (struct il_result){ .there = true, .whole = m };
		return true;
	}
	m = as_value(c, line, m);
	/* After an error: no result, and no second error. */
	c->now = (struct il_result){ .there = true, .type = m ? IEC_BOOL : IEC_NONE };
	if (!m)
		return false;
	if (line->modifiers & MOD_N && !il_is_bits(il_result_of(c, line, m)))
		return il_need_bool(c, line, il_result_of(c, line, m), il_operand_text(c, line));
	c->now = il_result_of(c, line, m);
	return true;
}

static bool check_store(struct il_check *c, const struct il_line *line)
{
	const struct meaning *m = il_value_of(c, line);
	bool bits = line->op != OP_ST ||
		    (line->modifiers & MOD_N && !(m && il_is_bits(il_result_of(c, line, m))));

	if (!m || !il_need_result(c, line) || !can_write(c, line, m))
		return false;
	if (bits && (!il_need_bool(c, line, c->now, "") ||
		     !il_need_bool(c, line, il_result_of(c, line, m), il_operand_text(c, line))))
		return false;
	if (il_is_made(&c->fn, il_operand_text(c, line)) && !line->modifiers && line->op == OP_ST)
		remember(c, m, c->now);
	return can_store(c, line, c->now, m->type) && may_hold(c, line, c->now, m->like);
}

/* ---- functions and calls ---- */

static bool is_arg(const struct il_check *c, int at)
{
	return at < c->fn.il->count && (c->fn.il->line[at].kind == IL_ARG_IN ||
				     c->fn.il->line[at].kind == IL_ARG_OUT);
}

/* Counts the operands after the first input: 2 in `MAX Low, High, 5`. -1 after a
 * diagnostic. */
static int read_inputs(struct il_check *c, int at, struct il_result *in)
{
	int count = 1;

	for (int i = at; i == at ? c->fn.il->line[i].operand != 0 : is_arg(c, i); i++) {
		const struct meaning *m = il_value_of(c, &c->fn.il->line[i]);

		if (!m)
			return -1;
		if (count == LIMIT_FN_ARGS) {
			il_report(&c->fn, &c->fn.il->line[i], DIAG_TOO_MANY_OPERANDS,
				  il_operand_text(c, &c->fn.il->line[i]));
			return -1;
		}
		in[count++] = il_result_of(c, &c->fn.il->line[i], m);
	}
	return count;
}

/* The overload of the line's word for inputs of these types. */
static struct il_line overloaded(const struct il_line *line, const struct il_result *in,
				 int count)
{
	struct il_line out = *line;

	if (count == 2)
		out.word = (uint16_t)fn_overload((enum word)line->word, in[0].type,
						 in[1].type);
	return out;
}

/* AND( or ADD( : the result waits. @good: so far. */
static bool il_open_paren(struct il_check *c, const struct il_line *line, bool good)
{
	const struct meaning *m;

	if (c->depth == LIMIT_IL_DEPTH)
		return il_report(&c->fn, line, DIAG_TOO_DEEP, "(");
	c->opened[c->depth++] = (struct il_opened){
		.left = c->now, .op = line->op,
		.word = line->kind == IL_FN ? (enum word)line->word : 0,
	};
	if (line->kind == IL_OP && !il_is_bits(c->now) && !c->now.literal)
		good = good && il_need_bool(c, line, c->now, "");
	c->now.there = false;
	if (!line->operand)
		return good;
	m = il_value_of(c, line); /* AND( Level, followed by GT 10 */
	c->now = (struct il_result){ .there = true, .type = IEC_BOOL };
	if (m)
		c->now = il_result_of(c, line, m);
	return m && good;
}

/* A function on the current result: ADD 5. */
static bool check_fn(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct word_row *row = scope_row(c->fn.scope, (enum word)line->word);
	struct il_line runs;
	struct il_result *in = c->in;
	enum iec_type stored;
	int count;

	in[0] = c->now;
	if (!il_need_result(c, line))
		return false;
	if (line->modifiers & MOD_PAREN)
		return il_open_paren(c, line, true);
	c->now = (struct il_result){ .there = true,
		.type = word_is_test(row) ? IEC_BOOL : IEC_NONE };
	count = read_inputs(c, at, in);
	if (count < 0)
		return false;
	if (count > row->most_inputs && row->pin_count > 1)
		return il_report(&c->fn, line, DIAG_TOO_MANY_OPERANDS, row->word);
	if (count < row->pin_count || count > row->most_inputs)
		return il_report(&c->fn, line, DIAG_MISSING_INPUT, row->word);
	runs = overloaded(line, in, count);
	row = scope_row(c->fn.scope, (enum word)runs.word);
	stored = il_stored_type(c->fn.scope, c->fn.pou, c->fn.il, at);
	if (!il_check_inputs(&c->fn, &runs, in, count, stored, common))
		return false;
	c->now = il_function_result(&c->fn, fn_result(row, *common, stored));
	return true;
}

/* Type of the variable behind OUT =>. */
static enum iec_type out_type(struct il_check *c, int at)
{
	enum diag_id why;

	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->fn.il->line[i];
		const struct meaning *m;

		if (arg->kind != IL_ARG_OUT ||
		    strcasecmp(scope_text(c->fn.scope, arg->pin), "OUT") != 0)
			continue;
		m = scope_find(c->fn.scope, c->fn.pou, arg->operand, &why);
		return m ? m->type : IEC_NONE;
	}
	return IEC_NONE;
}

/* ADD(EN := …, IN1 := …, ENO => …, OUT => …): checks the lines after @at. */
static bool check_call(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct word_row *row = scope_row(c->fn.scope, (enum word)line->word);
	struct il_result *in = c->in;
	struct il_line runs;
	struct il_result out;
	enum iec_type stored;
	int count = 0, last = 0;
	bool good = true;

	for (int i = 0; i < LIMIT_FN_ARGS; i++)
		in[i].there = false;
	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->fn.il->line[i];
		const char *pin = scope_text(c->fn.scope, arg->pin);
		int index = word_pin_find(row, pin, strlen(pin));
		const struct meaning *m;

		if (arg->kind != IL_ARG_IN)
			continue;
		m = il_value_of(c, arg);
		if (!m) {
			good = false;
		} else if (strcasecmp(pin, "EN") == 0) {
			good &= il_need_bool(c, arg, il_result_of(c, arg, m),
					  il_operand_text(c, arg));
		} else if (index < 0 || index >= LIMIT_FN_ARGS) {
			good = il_report(&c->fn, arg, DIAG_NO_PIN, pin);
		} else {
			count += !in[index].there;
			in[index] = il_result_of(c, arg, m);
			last = index > last ? index : last;
		}
	}
	if (!good)
		return false;
	if (count < row->pin_count || count != last + 1)
		return il_report(&c->fn, line, DIAG_MISSING_INPUT, row->word);
	runs = overloaded(line, in, count);
	row = scope_row(c->fn.scope, (enum word)runs.word);
	stored = out_type(c, at);
	if (!il_check_inputs(&c->fn, &runs, in, count, stored, common))
		return false;
	out = il_function_result(&c->fn, fn_result(row, *common, stored));
	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->fn.il->line[i];
		const char *pin = scope_text(c->fn.scope, arg->pin);
		const struct meaning *m;

		if (arg->kind != IL_ARG_OUT)
			continue;
		m = il_value_of(c, arg);
		if (!m || !can_write(c, arg, m))
			good = false;
		else if (strcasecmp(pin, "ENO") == 0)
			good &= il_need_bool(c, arg, il_result_of(c, arg, m),
					  il_operand_text(c, arg));
		else if (strcasecmp(pin, "OUT") == 0) {
			good &= can_store(c, arg, out, m->type) && may_hold(c, arg, out, m->like);
			if (il_is_made(&c->fn, il_operand_text(c, arg)))
				remember(c, m, out);
		} else
			good = il_report(&c->fn, arg, DIAG_NO_PIN, pin);
	}
	c->now.there = false;
	return good;
}

static bool is_label(struct il_check *c, uint32_t name)
{
	uint32_t fold = names_fold(&scope_project(c->fn.scope)->names, name);

	return fold && fold < c->label_count && c->label[fold];
}

/* CALC and CALCN need a result; CAL alone ends it. */
static bool il_check_flow(struct il_check *c, const struct il_line *line)
{
	bool good = true;

	if (c->depth > 0 && line->op != OP_STP)
		good = il_report(&c->fn, line, DIAG_IL_OPEN_PAREN, op_row(line->op)->word);
	if (line->op == OP_JMP && !is_label(c, line->operand))
		good = il_report_near(c, line, DIAG_NO_LABEL, EXPECT_LABEL);
	if (line->modifiers & MOD_C)
		return il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "") && good;
	if (line->op != OP_STP)
		c->now.there = false;
	return good;
}

/* CAL of a SUBROUTINE or PROGRAM, which has no parameters. */
static bool check_routine(struct il_check *c, int at, const struct pou *to)
{
	const struct il_line *line = &c->fn.il->line[at];
	bool good = true;

	if (to->kind != POU_SUBROUTINE && to->kind != POU_ACTION &&
	    !(to->kind == POU_PROGRAM && (c->fn.pou->language == LANGUAGE_ST || c->fn.pou->fbd ||
					  scope_project(c->fn.scope)->words.own_first)))
		return il_report(&c->fn, line, DIAG_NOT_SUBROUTINE, il_operand_text(c, line));
	if (line->modifiers & MOD_C)
		good = il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "");
	if (is_arg(c, at + 1))
		good = il_report(&c->fn, &c->fn.il->line[at + 1], DIAG_TOO_MANY_OPERANDS,
				 scope_text(c->fn.scope, c->fn.il->line[at + 1].pin));
	c->now.there = false;
	return good;
}

static const char *pin_text(struct il_check *c, const struct il_line *arg)
{
	return scope_text(c->fn.scope, arg->pin);
}

/* Adds a diagnostic when the operand is a structure or array. */
static bool is_plain(struct il_check *c, const struct il_line *arg,
		     const struct meaning *m)
{
	char text[LIMIT_ARG];

	if (m->kind == MEANING_STRUCT)
		return il_report(&c->fn, arg, DIAG_STRUCT_AS_VALUE, il_whole_text(c, arg, m, text));
	return meaning_fault(m) == DIAG_COUNT ||
	       il_report(&c->fn, arg, meaning_fault(m), il_whole_text(c, arg, m, text));
}

static struct il_result value_of(const struct meaning *m)
{
	struct il_result out = { .there = true, .type = m->type };

	if (m->kind == MEANING_LITERAL && m->type == IEC_NONE)
		out.literal = &m->literal;
	return out;
}

/* ---- shapes ---- */

/* The variable of a block or function of the project that @pin was made from; NULL: none. */
static const struct var *pin_variable(const struct il_check *c, const struct word_pin *pin)
{
	const struct project *project = scope_project(c->fn.scope);

	for (int i = 0; i < project->words.count; i++) {
		const struct word_row *row = project->words.row[i];
		const struct var_table *table;

		if (pin < row->pin || pin >= row->pin + row->pin_count)
			continue;
		table = shape_vars(project, (enum word)(WORD_FIRST_OWN + i));
		return table && pin - row->pin < table->count ? &table->var[pin - row->pin] : NULL;
	}
	return NULL;
}

/* Dimensions of the array that a pin takes. */
struct pin_dims {
	const struct var_array *dim;
	int dims;
};

static bool is_like(const struct meaning *m, const struct word_pin *pin, struct pin_dims dims)
{
	if (pin->elements)
		return m->kind == MEANING_ARRAY && m->addr.area == AREA_NONE &&
		       m->type == pin->type && m->array.low == pin->low &&
		       m->array.count == pin->elements &&
		       vars_same_bounds(m->dim, m->dims, dims.dim, dims.dims) &&
		       (pin->type != IEC_NONE || m->word == pin->word) &&
		       (pin->type != IEC_STRING || m->capacity == pin->capacity);
	return (m->kind == MEANING_STRUCT || m->kind == MEANING_INSTANCE) && m->addr.area == AREA_NONE &&
	       pin->type == IEC_NONE && m->word == pin->word;
}

/* `[1..2, 0..3]` */
static void print_bounds(const struct word_pin *pin, struct pin_dims dims, char *out, size_t size)
{
	const struct var_array one = pin_array(pin), *dim = dims.dims > 1 ? dims.dim : &one;
	size_t used = 0;

	for (int i = 0; i < (dims.dims > 1 ? dims.dims : 1) && used < size; i++)
		used += (size_t)snprintf(out + used, size - used, "%s%ld..%lld", i ? ", " : "", (long)dim[i].low,
					 (long long)dim[i].low + dim[i].count - 1);
}

/** il_check_shape - is @m a structure, array or instance of the type that @pin declares? */
static bool il_check_shape(struct il_check *c, const struct il_line *arg,
			   const struct meaning *m, const struct word_pin *pin, struct pin_dims dims)
{
	const char *word = pin->type == IEC_NONE ? scope_row(c->fn.scope, pin->word)->word :
						   iec_type_row(pin->type)->word;
	const char *operand = il_operand_text(c, arg);
	char text[2 * LIMIT_ARG], room[16] = "", bounds[LIMIT_ARG];

	if (is_like(m, pin, dims))
		return true;
	if (!pin->elements && m->kind == MEANING_STRUCT && m->word == pin->word && m->addr.area != AREA_NONE) {
		snprintf(text, sizeof(text), "%.20s" DIAG_AND "%.40s", operand, word);
		return il_report(&c->fn, arg, DIAG_AT_WHOLE, text);
	}
	if (!pin->elements)
		return il_report_wrong(c, arg, operand, word);
	if (pin->type == IEC_STRING)
		snprintf(room, sizeof(room), "[%u]", pin->capacity);
	print_bounds(pin, dims, bounds, sizeof(bounds));
	snprintf(text, sizeof(text), "%.20s" DIAG_AND "ARRAY[%.60s] OF %.20s%s", operand, bounds, word, room);
	return il_report(&c->fn, arg, m->addr.area == AREA_NONE ? DIAG_WRONG_TYPE : DIAG_AT_WHOLE,
			 text);
}

static bool check_whole(struct il_check *c, const struct il_line *arg, const struct meaning *m,
			const struct word_pin *pin)
{
	const struct var *var = pin->elements ? pin_variable(c, pin) : NULL;

	return il_check_shape(c, arg, m, pin, var ? (struct pin_dims){ var->dim, var->dims } :
						    (struct pin_dims){ NULL, 0 });
}

static bool check_in_out(struct il_check *c, const struct il_line *arg,
			 const struct meaning *m, const struct word_pin *pin)
{
	if (pin->type == IEC_NONE)
		return check_whole(c, arg, m, pin) &&
		       (m->kind == MEANING_INSTANCE || can_write(c, arg, m));
	if (!is_plain(c, arg, m) || !can_write(c, arg, m))
		return false;
	if (m->type == pin->type)
		return true;
	return il_report_wrong(c, arg, il_operand_text(c, arg),
			       iec_type_row(pin->type)->word);
}

/* What a pin may hold; NULL: what its type holds. */
static const struct var *holder_of(const struct il_check *c, const struct word_pin *pin)
{
	const struct project *project = scope_project(c->fn.scope);

	return project->enumeration_count || project->ranges ? pin_variable(c, pin) : NULL;
}

/* @m: the operand at the pin. */
static bool check_value(struct il_check *c, const struct il_line *arg,
			const struct meaning *m, const struct word_pin *pin)
{
	bool output = pin->dir == PIN_OUT;

	if (pin->elements)
		return check_whole(c, arg, m, pin) &&
		       (pin->dir == PIN_IN || can_write(c, arg, m));
	if (pin->dir == PIN_IN_OUT)
		return check_in_out(c, arg, m, pin);
	if (pin->type == IEC_NONE)
		return check_whole(c, arg, m, pin) &&
		       (!output || can_write(c, arg, m));
	if (!is_plain(c, arg, m))
		return false;
	if (!output)
		return can_store(c, arg, il_result_of(c, arg, m), pin->type) &&
		       may_hold(c, arg, il_result_of(c, arg, m), holder_of(c, pin));
	return can_write(c, arg, m) &&
	       can_store(c, arg, (struct il_result){ .there = true, .type = pin->type },
			    m->type);
}

/** il_check_pin - one parameter against the pin of @row that it names. */
static bool il_check_pin(struct il_check *c, const struct word_row *row,
			 const struct il_line *arg)
{
	const char *name = pin_text(c, arg);
	int index = word_pin_find(row, name, strlen(name));
	const struct meaning *m = find(c, arg);
	enum diag_id why;

	if (!m)
		return false;
	if (index < 0)
		return is_plain(c, arg, m) &&
		       (arg->mark & IL_IN_ORDER ?
			il_report(&c->fn, arg, DIAG_TOO_MANY_OPERANDS, il_operand_text(c, arg)) :
			il_report(&c->fn, arg, DIAG_NO_PIN, name));
	if ((row->pin[index].dir == PIN_OUT) != (arg->kind == IL_ARG_OUT))
		return il_report(&c->fn, arg, arg->kind == IL_ARG_OUT ? DIAG_INPUT_READ :
				 DIAG_PIN_DIRECTION, name);
	why = generic_fault(scope_project(c->fn.scope), row, index, m);
	if (why != DIAG_COUNT)
		return il_report(&c->fn, arg, why, why == DIAG_ANY_BOUNDS_OF ? row->word : il_operand_text(c, arg));
	return check_value(c, arg, m, &row->pin[index]);
}

/* Is there a parameter for pin @name of the call at @at? */
static bool has_arg(struct il_check *c, int at, const char *name)
{
	for (int i = at + 1; is_arg(c, i); i++)
		if (name_is(pin_text(c, &c->fn.il->line[i]), name, strlen(name)))
			return true;
	return false;
}

/* Is there a parameter for each VAR_IN_OUT of @row? */
static bool il_check_in_outs(struct il_check *c, int at, const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN_OUT &&
		    !has_arg(c, at, row->pin[i].name))
			return il_report(&c->fn, &c->fn.il->line[at], DIAG_MISSING_INPUT,
					 row->pin[i].name);
	return true;
}

/* CAL of an instance or a subroutine; the lines behind @at too. */
static bool il_check_cal(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct pou *routine = scope_pou(c->fn.scope, c->fn.pou, line->operand), *block;
	const struct meaning *m;
	bool good = true;

	if (routine)
		return check_routine(c, at, routine);
	m = find(c, line);
	if (!m)
		return false;
	if (m->kind != MEANING_INSTANCE)
		return il_report(&c->fn, line, DIAG_NOT_INSTANCE, il_operand_text(c, line));
	block = shape_pou(scope_project(c->fn.scope), (enum word)m->word);
	if (block && pou_has_any_bounds(block))
		return il_report(&c->fn, line, DIAG_ANY_BOUNDS_BLOCK, il_operand_text(c, line));
	if (line->modifiers & MOD_C)
		good = il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "");
	for (int i = at + 1; is_arg(c, i); i++)
		good &= il_check_pin(c, scope_row(c->fn.scope, m->word),
				     &c->fn.il->line[i]);
	good &= il_check_in_outs(c, at, scope_row(c->fn.scope, m->word));
	c->now.there = false;
	return good;
}

/* The result of @op on two values; of BOOLs as an operator, of bits as a function. */
static bool combine(struct il_check *c, const struct il_line *line, enum op op,
		    struct il_result left, struct il_result right, const char *what)
{
	struct il_line function = *line;
	struct il_result in[2] = { left, right };
	enum iec_type type = IEC_NONE;

	c->now = (struct il_result){ .there = true, .type = IEC_BOOL };
	if (!il_is_bits(left) && !il_is_bits(right)) {
		bool good = il_need_bool(c, line, left, "");

		good = il_need_bool(c, line, right, what) && good;
		if (!good) /* the type after an error: no second error */
			c->now.type = IEC_NONE;
		return good;
	}
	function.word = (uint16_t)op_function(op);
	c->now.type = IEC_NONE;
	if (!il_check_inputs(&c->fn, &function, in, 2, IEC_NONE, &type))
		return false;
	c->now = il_function_result(&c->fn, type);
	return true;
}

/* AND OR XOR, with N and parentheses; il_check_close the other end;
 * il_check_not NOT. On BOOL or on bits. */
static bool il_check_logic(struct il_check *c, const struct il_line *line)
{
	bool good = il_need_result(c, line);
	const struct meaning *m;

	if (line->modifiers & MOD_PAREN)
		return il_open_paren(c, line, good);
	m = il_value_of(c, line);
	if (m && good)
		return combine(c, line, (enum op)line->op, c->now, il_result_of(c, line, m),
			       il_operand_text(c, line));
	c->now = (struct il_result){ .there = true, .type = IEC_BOOL };
	return false;
}

static bool il_check_not(struct il_check *c, const struct il_line *line)
{
	struct il_result now = c->now;
	bool good = il_need_result(c, line);

	if (good && il_is_bits(now))
		return true;
	c->now = (struct il_result){ .there = true, .type = IEC_BOOL };
	return good && il_need_bool(c, line, now, "");
}

/* The type as a declaration would spell it. */
static struct word_pin pin_like(const struct meaning *m)
{
	struct word_pin pin = { .type = m->type };

	if (m->type == IEC_NONE)
		pin.word = (enum word)m->word;
	else
		pin.capacity = m->capacity;
	if (m->kind == MEANING_ARRAY) {
		pin.elements = m->array.count;
		pin.low = m->array.low;
	}
	return pin;
}

/* Adds a diagnostic unless @m and @like are of the same type and may be copied whole. */
static bool il_check_same(struct il_check *c, const struct il_line *arg,
			  const struct meaning *m, const struct meaning *like)
{
	const struct word_pin pin = pin_like(like);
	const struct pin_dims dims = { like->dim, like->kind == MEANING_ARRAY ? like->dims : 0 };

	if (like->addr.area != AREA_NONE) /* a variable with AT cannot be copied whole */
		return il_check_shape(c, arg, like, &pin, dims);
	return il_check_shape(c, arg, m, &pin, dims);
}

/* ST of a structure or array. */
static bool il_check_store_whole(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct meaning *from = c->now.whole, *to = find(c, line);

	if (!is_store(c, next_line(c, at))) /* no other instruction takes a whole */
		c->now = (struct il_result){ .there = false };
	return to && il_check_same(c, line, to, from) && can_write(c, line, to);
}

/* ---- the walk ---- */

static bool check_op(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];

	if (line->modifiers & ~op_row((enum op)line->op)->modifiers)
		return il_report(&c->fn, line, DIAG_IL_MODIFIER,
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

/* Checks the function before a parenthesis with the value left of it and the value inside. */
static bool close_function(struct il_check *c, int at, struct il_result left,
			   struct il_result right, enum iec_type *common)
{
	const enum word word = fn_overload(c->opened[c->depth].word, left.type,
					   right.type);
	const struct word_row *row = scope_row(c->fn.scope, word);
	struct il_line function = c->fn.il->line[at];
	struct il_result in[2] = { left, right };
	enum iec_type stored = il_stored_type(c->fn.scope, c->fn.pou, c->fn.il, at);

	function.word = (uint16_t)word;
	c->now.type = word_is_test(row) ? IEC_BOOL : IEC_NONE;
	if (!il_check_inputs(&c->fn, &function, in, 2, IEC_NONE, common))
		return false;
	c->now = il_function_result(&c->fn, fn_result(row, *common, stored));
	return true;
}

static bool close_paren(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->fn.il->line[at];
	bool good = il_need_result(c, line);
	struct il_result right = c->now;

	c->now = (struct il_result){ .there = true, .type = IEC_BOOL };
	if (c->depth == 0)
		return il_report(&c->fn, line, DIAG_IL_CLOSE_PAREN, ")");
	c->depth--;
	if (!good || !c->opened[c->depth].left.there)
		return false;
	if (c->opened[c->depth].word)
		return close_function(c, at, c->opened[c->depth].left, right,
				      common);
	good = combine(c, line, (enum op)c->opened[c->depth].op,
		       c->opened[c->depth].left, right, "");
	*common = c->now.type;
	return good;
}

static bool il_check_close(struct il_check *c, int at, enum iec_type *common)
{
	*common = IEC_NONE;
	return close_paren(c, at, common);
}

/* ---- functions ---- */

static const struct var *result_var(struct il_check *c, int at)
{
	const struct pou *pou = shape_pou(scope_project(c->fn.scope),
					  (enum word)c->fn.il->line[at].word);

	return pou && pou->vars.count > 0 ? &pou->vars.var[0] : NULL;
}

/* EN := or ENO => at @arg. */
static bool il_check_power(struct il_check *c, const struct il_line *arg, bool write)
{
	const struct meaning *m = find(c, arg);

	return m && is_plain(c, arg, m) && (!write || can_write(c, arg, m)) &&
	       il_need_bool(c, arg, value_of(m), il_operand_text(c, arg));
}

/* OUT => variable: the function's result. */
static bool check_result(struct il_check *c, const struct il_line *arg,
			 const struct var *var)
{
	const struct meaning *m = find(c, arg);
	struct word_pin pin = { .dir = PIN_OUT };

	if (!m || !var)
		return false;
	pin.type = var->type;
	pin.capacity = var->capacity;
	pin.elements = var->array.count;
	pin.low = var->array.low;
	if (var->type == IEC_NONE)
		pin.word = var->fb;
	if (pin.elements)
		return il_check_shape(c, arg, m, &pin, (struct pin_dims){ var->dim, var->dims }) &&
		       can_write(c, arg, m);
	return check_value(c, arg, m, &pin);
}

/* Adds a diagnostic for an input that is neither given nor has a default. Structured Text may leave it out, with a
 * warning that it has had; boxes have been checked. */
static bool check_inputs(struct il_check *c, int at, const struct word_row *row)
{
	for (int i = 0; i < row->pin_count && c->fn.pou->language == LANGUAGE_IL; i++)
		if (row->pin[i].dir == PIN_IN && !row->pin[i].has_init &&
		    !has_arg(c, at, row->pin[i].name))
			return il_report(&c->fn, &c->fn.il->line[at], DIAG_MISSING_INPUT,
					 row->pin[i].name);
	return il_check_in_outs(c, at, row);
}

/* A function with formal parameters. */
static bool il_check_own_call(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct word_row *row = scope_row(c->fn.scope, (enum word)line->word);
	bool good = check_inputs(c, at, row);

	for (int i = at + 1; is_arg(c, i); i++) {
		const struct il_line *arg = &c->fn.il->line[i];
		const char *pin = pin_text(c, arg);
		bool output = arg->kind == IL_ARG_OUT;

		if (strcasecmp(pin, output ? "ENO" : "EN") == 0)
			good &= il_check_power(c, arg, output);
		else if (output && strcasecmp(pin, words_result(row)) == 0)
			good &= check_result(c, arg, result_var(c, at));
		else
			good &= il_check_pin(c, row, arg);
	}
	c->now.there = false;
	return good;
}

/* The next input after pin @index; -1: none. */
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
	const struct meaning *m = find(c, line);

	*pin = next_input(row, *pin);
	if (!m)
		return false;
	if (*pin < 0)
		return il_report(&c->fn, line, DIAG_TOO_MANY_OPERANDS, il_operand_text(c, line));
	return check_value(c, line, m, &row->pin[*pin]);
}

/* The result is the first input, the operands are the others. */
static bool il_check_own_fn(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct word_row *row = scope_row(c->fn.scope, (enum word)line->word);
	const struct var *var = result_var(c, at);
	struct il_result first = c->now;
	int pin = next_input(row, -1);
	bool good = true;

	c->now = (struct il_result){ .there = true, .type = var ? var->type : IEC_NONE };
	if (!first.there)
		return no_result(c, line, row->word);
	if (pin < 0 || row->pin[pin].type == IEC_NONE || !var ||
	    var->type == IEC_NONE || var->array.count)
		return il_report(&c->fn, line, DIAG_WRONG_TYPE, row->word);
	good = can_store(c, line, first, row->pin[pin].type);
	if (line->operand)
		good &= check_operand(c, row, line, &pin);
	for (int i = at + 1; good && is_arg(c, i); i++)
		good &= check_operand(c, row, &c->fn.il->line[i], &pin);
	while (good && (pin = next_input(row, pin)) >= 0)
		if (!row->pin[pin].has_init)
			return il_report(&c->fn, line, DIAG_MISSING_INPUT,
					 row->pin[pin].name);
	return il_check_in_outs(c, at, row) && good;
}

/* Is the line at @at a MOVE of a structure or array? */
static bool il_is_whole_move(struct il_check *c, int at)
{
	enum diag_id why;

	if (c->fn.il->line[at].word != FN_MOVE)
		return false;
	for (int i = at + 1; is_arg(c, i); i++)
		if (may_move(scope_find(c->fn.scope, c->fn.pou, c->fn.il->line[i].operand,
					&why)))
			return true;
	return false;
}

static const struct il_line *arg_of(struct il_check *c, int at, const char *name)
{
	for (int i = at + 1; is_arg(c, i); i++)
		if (strcasecmp(scope_text(c->fn.scope, c->fn.il->line[i].pin), name) == 0)
			return &c->fn.il->line[i];
	return NULL;
}

static bool il_check_whole_move(struct il_check *c, int at)
{
	const struct il_line *line = &c->fn.il->line[at];
	const struct il_line *in = arg_of(c, at, "IN"), *out = arg_of(c, at, "OUT");
	const struct il_line *en = arg_of(c, at, "EN"), *eno = arg_of(c, at, "ENO");
	const struct meaning *from, *to;

	c->now.there = false;
	if (!in || !out)
		return il_report(&c->fn, line, DIAG_MISSING_INPUT, in ? "OUT" : "IN");
	from = find(c, in);
	to = find(c, out);
	if (!from || !to || (en && !il_check_power(c, en, false)) ||
	    (eno && !il_check_power(c, eno, true)))
		return false;
	if (!may_move(to))
		return il_check_same(c, out, to, from);
	return il_check_same(c, in, from, to) && can_write(c, out, to);
}

/* A function with ARRAY[*] that has no copy for this call. Reports it. */
static bool has_any_bounds(struct il_check *c, const struct il_line *line)
{
	const struct project *project = scope_project(c->fn.scope);
	const struct pou *pou = shape_pou(project, (enum word)line->word);

	if (!pou || !pou_has_any_bounds(pou))
		return false;
	il_report(&c->fn, line, line->kind == IL_FN ? DIAG_ANY_BOUNDS_CALL : DIAG_ANY_BOUNDS_OF,
		  project_text(project, pou->name));
	return true;
}

static bool check_line(struct il_check *c, int at, enum iec_type *type)
{
	const struct il_line *line = &c->fn.il->line[at];
	bool good = true;

	if (c->now.there)
		c->ended_at = 0;
	switch ((enum il_kind)line->kind) {
	case IL_OP:
		good = check_op(c, at);
		if (line->op == OP_CAL || line->op == OP_JMP)
			c->ended_at = 0;
		c->jumps |= line->op == OP_JMP && line->modifiers & MOD_C;
		break;
	case IL_FN:
		if (has_any_bounds(c, line))
			return false;
		if (word_is_own((enum word)line->word))
			return il_check_own_fn(c, at);
		return check_fn(c, at, type);
	case IL_CALL:
		if (has_any_bounds(c, line))
			return false;
		if (word_is_own((enum word)line->word))
			return il_check_own_call(c, at);
		if (il_is_whole_move(c, at))
			return il_check_whole_move(c, at);
		return check_call(c, at, type);
	case IL_CLOSE:
		return il_check_close(c, at, type);
	case IL_LABEL:
		if (c->depth > 0)
			good = il_report(&c->fn, line, DIAG_IL_OPEN_PAREN,
				      il_operand_text(c, line));
		c->depth = 0;
		forget(c, NULL);
		c->ended_at = c->now.there || c->jumps ? line->operand : 0;
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
	struct names *names = &scope_project(c->fn.scope)->names;
	bool good = true;

	for (int i = 0; i < c->fn.il->count; i++)
		if (c->fn.il->line[i].kind == IL_LABEL)
			names_fold(names, c->fn.il->line[i].operand);
	c->label_count = (uint32_t)names->count;
	c->label = arena_alloc(scratch, c->label_count);
	if (!c->label)
		return false;
	for (int i = 0; i < c->fn.il->count; i++) {
		const struct il_line *line = &c->fn.il->line[i];
		uint32_t fold;

		if (line->kind != IL_LABEL)
			continue;
		fold = names_fold(names, line->operand);
		if (c->label[fold] && c->fn.pou->language == LANGUAGE_IL)
			good = il_report(&c->fn, line, DIAG_DUPLICATE_LABEL,
				      il_operand_text(c, line));
		c->label[fold] = 1;
	}
	return good;
}

bool check_il(struct scope *scope, const struct pou *pou, const struct il *il,
	      struct arena *scratch, enum iec_type *types,
	      struct diag_list *diags)
{
	struct il_check *c = arena_alloc(scratch, sizeof(*c));
	bool good;

	if (!c)
		return false;
	*c = (struct il_check){
		.fn = { .scope = scope, .pou = pou, .il = il, .diags = diags }, .types = types };
	good = find_labels(c, scratch);
	c->opened = arena_alloc(scratch, LIMIT_IL_DEPTH * sizeof(*c->opened));
	if (!c->label || !c->opened)
		return false;
	for (int i = 0; i < il->count; i++)
		good &= check_line(c, i, &types[i]);
	if (c->depth > 0 && il->count > 0)
		good = il_report(&c->fn, &il->line[il->count - 1], DIAG_IL_OPEN_PAREN,
			      "(");
	return good;
}

/* ---- parameters of CAL without names ---- */

/* The row of the block that a line calls; NULL: the line is no call. */
static const struct word_row *called_row(struct scope *scope, const struct pou *pou,
					 const struct il_line *line)
{
	const struct meaning *m;
	enum diag_id why;

	if (line->kind != IL_OP || line->op != OP_CAL)
		return NULL;
	m = scope_find(scope, pou, line->operand, &why);
	return m && m->kind == MEANING_INSTANCE ? scope_row(scope, (enum word)m->word) :
						  NULL;
}

/* The pin behind @pin that a value goes to; pin_count: there is none. */
static int next_pin(const struct word_row *row, int pin)
{
	do
		pin++;
	while (pin < row->pin_count && row->pin[pin].dir != PIN_IN &&
	       row->pin[pin].dir != PIN_IN_OUT);
	return pin;
}

void il_order_args(struct scope *scope, const struct pou *pou, struct il *il)
{
	struct names *names = &scope_project(scope)->names;
	const struct word_row *row = NULL;
	int pin = -1;

	for (int i = 0; i < il->count; i++) {
		struct il_line *line = &il->line[i];

		if (line->kind != IL_ARG_IN && line->kind != IL_ARG_OUT) {
			row = called_row(scope, pou, line);
			pin = -1;
		}
		if (line->kind != IL_ARG_IN || !(line->mark & IL_IN_ORDER))
			continue;
		line->pin = 0;
		pin = row ? next_pin(row, pin) : pin;
		if (row && pin < row->pin_count)
			line->pin = names_intern(names, row->pin[pin].name,
						 strlen(row->pin[pin].name));
	}
}
