/* SPDX-License-Identifier: MIT
 *
 * check_il - walks an instruction list with the type of its current result.
 */
#include "engine/check/check_il.h"
#include "engine/base/name.h"

#include "engine/model/advice.h"
#include "engine/model/convert.h"
#include "engine/model/shape.h"
#include "engine/scan/vm.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* The current result (IEC 61131-3 3.2.2): nothing, a type, or a constant that
 * has no type yet. */
struct result {
	bool there;
	bool known;                  /* a constant that has a type: its value  */
	enum iec_type type;
	uint32_t text;               /* the operand it was read from, or 0     */
	union iec_value value;
	const struct literal *literal;
	const struct meaning *whole; /* a structure or array; else NULL    */
};

/* A temporary that holds a constant. */
struct folded {
	const struct var *var;
	enum iec_type type;
	union iec_value value;
};
#define FOLDED_MOST 8

struct il_check {
	struct scope *scope;
	const struct pou *pou;
	const struct il *il;
	enum iec_type *types;
	struct diag_list *diags;
	uint8_t *label;        /* by folded name: is it a label?            */
	uint32_t label_count;
	struct result now;
	uint32_t ended_at;   /* label that ended a result; 0: no label did  */
	bool jumps;          /* a conditional jump was seen                 */
	bool has_constant;   /* the last function has a constant result, args.out */
	struct fn_args args; /* of it                                       */
	struct result in[LIMIT_FN_INPUTS]; /* inputs of the function of this line */
	struct folded folded[FOLDED_MOST]; /* var NULL: free                */
	int depth;           /* of open parentheses                         */
	struct il_opened {
		struct result left;
		uint8_t op;          /* of AND OR XOR                       */
		enum word word;      /* of a function; 0: of an operator    */
	} *opened;           /* LIMIT_IL_DEPTH of them                      */
};
struct expect_want;

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

/* Each adds a diagnostic at @line; false unless it is a warning. */
static bool il_report(struct il_check *c, const struct il_line *line,
		   enum diag_id id, const char *arg)
{
	return diag_add(c->diags, il_place(c->scope, c->pou, line, id), "%s", arg);
}

/* Was @name made by translation? */
static bool is_made(const struct il_check *c, const char *operand)
{
	return c->pou->language == LANGUAGE_LD && operand[0] == '_' &&
	       (operand[1] == 'N' || operand[1] == 'T');
}

#define NUMBER_TEXT 32

/* @operand is not of the type @wanted. */
static bool il_report_wrong(struct il_check *c, const struct il_line *line, const char *operand,
		     const char *wanted)
{
	char text[LIMIT_ARG];

	snprintf(text, sizeof(text), "%.30s" DIAG_AND "%.30s", is_made(c, operand) ? "" :
		 operand, wanted);
	return il_report(c, line, DIAG_WRONG_TYPE, text);
}

/* Is there a word such as INT_TO_REAL for it? */
static enum diag_id mismatch(enum iec_type from, enum iec_type to)
{
	struct convert_word made;
	char word[48];
	int len = snprintf(word, sizeof(word), "%s_TO_%s", iec_type_row(from)->word,
			   iec_type_row(to)->word);

	return convert_make(word, (size_t)len, &made) ? DIAG_NEEDS_CONVERSION :
							DIAG_NO_CONVERSION;
}

static bool il_report_types(struct il_check *c, const struct il_line *line,
			 enum iec_type from, enum iec_type to)
{
	const struct il_line *call = line;
	const char *operand = line->operand ?
		scope_text(c->scope, line->operand) : "";
	char text[LIMIT_ARG];

	while (call->kind == IL_ARG_IN && call > c->il->line)
		call--;
	if (call != line && call->mark & IL_NAMED) { /* the operand need not be a name */
		snprintf(text, sizeof(text), "%.20s.%.16s" DIAG_AND "%s" DIAG_AND "%s",
			 scope_row(c->scope, (enum word)call->word)->word,
			 scope_text(c->scope, line->pin), iec_type_row(from)->word,
			 iec_type_row(to)->word);
		return il_report(c, line, mismatch(from, to), text);
	}
	if (is_made(c, operand))
		operand = "";
	snprintf(text, sizeof(text), "%.24s" DIAG_AND "%s" DIAG_AND "%s", operand,
		 iec_type_row(from)->word, iec_type_row(to)->word);
	return il_report(c, line, mismatch(from, to), text);
}

static const char *il_operand_text(struct il_check *c, const struct il_line *line)
{
	return scope_text(c->scope, line->operand);
}

/* The same, with likely words of @kinds in the message. */
static bool il_report_near(struct il_check *c, const struct il_line *line, enum diag_id id,
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
	/* The index may be a temporary that is never written. */
	if ((why == DIAG_INDEX_TYPE || why == DIAG_INDEX_PLAIN ||
	     why == DIAG_INDICES_MANY) && c->pou->language == LANGUAGE_LD) {
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

/* The operand as a value to read; NULL after a diagnostic. */
static const struct meaning *il_value_of(struct il_check *c,
				      const struct il_line *line)
{
	return as_value(c, line, find(c, line));
}

/* The value of a constant that has a type: of a literal such as INT#5, of a CONSTANT, of a
 * temporary that an operation on constants was stored in. */
static void find_value(const struct il_check *c, const struct meaning *m, struct result *out)
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
static struct result il_result_of(const struct il_check *c, const struct il_line *line,
				  const struct meaning *m)
{
	struct result out = { .there = true, .type = m->type, .text = line->operand };

	if (m->kind == MEANING_LITERAL && m->type == IEC_NONE)
		out.literal = &m->literal;
	else
		find_value(c, m, &out);
	return out;
}

/* An untyped number as a message shows it. */
static void il_print_constant(const struct literal *literal, char out[NUMBER_TEXT])
{
	if (literal->real)
		snprintf(out, NUMBER_TEXT, "%g", literal->value.r);
	else if (literal->high)
		snprintf(out, NUMBER_TEXT, "%llu", (unsigned long long)literal->value.i);
	else
		snprintf(out, NUMBER_TEXT, "%lld", (long long)literal->value.i);
}

/* The diagnostic for an untyped constant that is no value of @to: out of range, or of another
 * kind; then with an example of the right kind. */
static bool il_report_constant(struct il_check *c, const struct il_line *line,
			    const struct literal *literal, enum iec_type to)
{
	static const struct { uint16_t class; const char *like; } kind[] = {
		{ CLASS_BOOL, "TRUE" }, { CLASS_TIME, "T#5s" },
		{ CLASS_REAL, "1.5" }, { ANY_INT | CLASS_BITS, "5" },
		{ CLASS_TOD, "TOD#08:30:00" }, { CLASS_DATE, "D#2026-11-21" },
		{ CLASS_DT, "DT#2026-11-21-08:30:00" }, { CLASS_STRING, "'text'" },
	};
	const struct iec_type_row *row = iec_type_row(to);
	char text[2 * LIMIT_ARG], number[NUMBER_TEXT];
	int k = 0;

	il_print_constant(literal, number);
	if (row->class & (ANY_NUM | CLASS_BITS) &&
	    (!literal->real || row->class == CLASS_REAL)) {
		snprintf(text, sizeof(text), "%s" DIAG_AND "%s", number, row->word);
		return il_report(c, line, DIAG_LITERAL_RANGE, text);
	}
	if (row->class & CLASS_TIME && !literal->real && !literal->high) {
		snprintf(text, sizeof(text), "%s" DIAG_AND "%s" DIAG_AND "T#%sms", number,
			 row->word, number);
		return il_report(c, line, DIAG_WRONG_CONSTANT, text);
	}
	while (!(kind[k].class & row->class))
		k++;
	snprintf(text, sizeof(text), "%s" DIAG_AND "%s" DIAG_AND "%s", number, row->word,
		 kind[k].like);
	return il_report(c, line, DIAG_CONSTANT_KIND, text);
}

/* After an error: a result that fits every use, so that no second error follows. */
static bool il_is_unknown(struct result result)
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

/* @var, or every temporary if it is NULL, holds no constant from here on. */
static void forget(struct il_check *c, const struct var *var)
{
	for (int i = 0; i < FOLDED_MOST; i++)
		if (!var || c->folded[i].var == var)
			c->folded[i].var = NULL;
}

/* @m is a temporary that gets @from. */
static void remember(struct il_check *c, const struct meaning *m, struct result from)
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

static bool no_result(struct il_check *c, const struct il_line *line, const char *what)
{
	char text[2 * LIMIT_ARG];

	if (!c->ended_at)
		return il_report(c, line, DIAG_IL_NO_RESULT, what);
	snprintf(text, sizeof(text), "%.40s" DIAG_AND "%.40s", what,
		 scope_text(c->scope, c->ended_at));
	return il_report(c, line, DIAG_IL_LABEL_RESULT, text);
}

static bool il_need_result(struct il_check *c, const struct il_line *line)
{
	return c->now.there || no_result(c, line, il_operand_text(c, line));
}

/* @what names the value in the message; "": the current result. */
static bool il_need_bool(struct il_check *c, const struct il_line *line,
		      struct result result, const char *what)
{
	union iec_value value;

	if (result.type == IEC_BOOL ||
	    (result.literal && literal_fit(result.literal, IEC_BOOL, &value)))
		return true;
	if (il_is_unknown(result))
		return false;
	return il_report(c, line, *what ? DIAG_NOT_BOOL : DIAG_RESULT_NOT_BOOL, what);
}

/* BYTE to LWORD? */
static bool il_is_bits(struct result result)
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
	while (at < c->il->count && c->il->line[at].kind == IL_COMMENT);
	return at;
}

static bool is_store(const struct il_check *c, int at)
{
	const struct il_line *line = at < c->il->count ? &c->il->line[at] : NULL;

	return line && line->kind == IL_OP && line->op == OP_ST && !line->modifiers;
}

/* Is @m a structure or array that LD at @at loads and the lines behind
 * it only store? */
static bool il_loads_whole(struct il_check *c, int at, const struct meaning *m)
{
	return may_move(m) && !c->il->line[at].modifiers &&
	       is_store(c, next_line(c, at));
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
	/* After an error: no result, and no second error. */
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
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
	if (is_made(c, il_operand_text(c, line)) && !line->modifiers && line->op == OP_ST)
		remember(c, m, c->now);
	return can_store(c, line, c->now, m->type);
}

static const struct meaning *il_find(struct il_check *c, const struct il_line *line)
{
	return find(c, line);
}

/* May it be stored there, written? False after a diagnostic. */
static bool il_can_store(struct il_check *c, const struct il_line *line,
			 struct result from, enum iec_type to)
{
	return can_store(c, line, from, to);
}

static bool il_can_write(struct il_check *c, const struct il_line *line,
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

/* Counts the operands after the first input: 2 in `MAX Low, High, 5`. -1 after a
 * diagnostic. */
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
		in[count++] = il_result_of(c, &c->il->line[i], m);
	}
	return count;
}

/* The overload of the line's word for inputs of these types. */
static struct il_line overloaded(const struct il_line *line, const struct result *in,
				 int count)
{
	struct il_line out = *line;

	if (count == 2)
		out.word = (uint16_t)fn_overload((enum word)line->word, in[0].type,
						 in[1].type);
	return out;
}

/* "SINT..LINT, REAL, LREAL": the types of a pin. */
static void print_classes(uint16_t classes, char out[LIMIT_ARG])
{
	static const struct { uint16_t class; const char *types; } kind[] = {
		{ CLASS_BOOL, "BOOL" }, { CLASS_BITS, "BYTE..LWORD" },
		{ CLASS_SIGNED, "SINT..LINT" }, { CLASS_UNSIGNED, "USINT..ULINT" },
		{ CLASS_REAL, "REAL, LREAL" }, { CLASS_TIME, "TIME" }, { CLASS_TOD, "TIME_OF_DAY" },
		{ CLASS_DATE, "DATE" }, { CLASS_DT, "DATE_AND_TIME" }, { CLASS_STRING, "STRING" },
	};
	size_t len = 0;

	*out = '\0';
	for (size_t i = 0; i < sizeof(kind) / sizeof(*kind); i++)
		if (classes & kind[i].class && len + strlen(kind[i].types) + 3 < LIMIT_ARG)
			len += (size_t)snprintf(out + len, LIMIT_ARG - len, "%s%s",
						len ? ", " : "", kind[i].types);
}

static bool report_pin(struct il_check *c, const struct il_line *line,
		       const struct word_pin *pin, enum iec_type type)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	char text[2 * LIMIT_ARG], classes[LIMIT_ARG] = "";

	if (pin->type == IEC_NONE)
		print_classes(pin->classes, classes);
	snprintf(text, sizeof(text), "%.16s%s%.8s" DIAG_AND "%s" DIAG_AND "%s", row->word,
		 pin->own ? "." : "", pin->own ? pin->name : "", iec_type_row(type)->word,
		 pin->type == IEC_NONE ? classes : iec_type_row(pin->type)->word);
	return il_report(c, line, DIAG_TYPE_NOT_TAKEN, text);
}

/* An input whose pin has a type of its own. */
static bool check_own(struct il_check *c, const struct il_line *line,
		      const struct word_pin *pin, const struct result *in)
{
	enum iec_type type = in->literal ? fn_own_type(pin, in->literal) : in->type;

	if (il_is_unknown(*in))
		return false;
	if (iec_type_row(type)->class & pin->classes)
		return true;
	if (type == IEC_NONE)
		type = in->literal->real ? IEC_REAL : IEC_DINT;
	return report_pin(c, line, pin, type);
}

/* Constants only: the first usual type that the function takes. */
static enum iec_type constants_type(const struct word_pin *pin,
				    const struct result *in, enum iec_type hint)
{
	enum iec_type type;

	if (iec_type_row(hint)->class & pin->classes)
		return hint;
	type = in ? fn_own_type(pin, in->literal) : IEC_NONE;
	return type ? type : IEC_DINT;
}

/* Input @index of a call in an expression: "LIMIT.MX"; "" elsewhere. */
static const char *input_name(const struct il_line *line, const struct word_row *row,
			      int index, char out[LIMIT_ARG])
{
	int len = 0;

	*out = '\0';
	if (!(line->mark & IL_NAMED))
		return out;
	len = snprintf(out, LIMIT_ARG, "%.24s.", row->word);
	if (index < row->pin_count)
		snprintf(out + len, LIMIT_ARG - (size_t)len, "%.16s", row->pin[index].name);
	else
		snprintf(out + len, LIMIT_ARG - (size_t)len, "IN%d",
			 index - (row->pin_count - 1) + word_last_number(row));
	return out;
}

static bool report_join(struct il_check *c, const struct il_line *line, int index,
			enum iec_type a, enum iec_type b)
{
	char name[LIMIT_ARG], text[2 * LIMIT_ARG];

	if (!(line->mark & IL_NAMED))
		return il_report_types(c, line, a, b);
	input_name(line, scope_row(c->scope, (enum word)line->word), index, name);
	snprintf(text, sizeof(text), "%s" DIAG_AND "%s" DIAG_AND "%s", name,
		 iec_type_row(a)->word, iec_type_row(b)->word);
	return il_report(c, line, mismatch(a, b), text);
}

static bool report_literal(struct il_check *c, const struct il_line *line, int index,
			   const struct literal *literal, enum iec_type type)
{
	char name[LIMIT_ARG], text[2 * LIMIT_ARG], number[NUMBER_TEXT];

	if (!(line->mark & IL_NAMED) || literal->real ||
	    !(iec_type_row(type)->class & (ANY_NUM | CLASS_BITS)))
		return il_report_constant(c, line, literal, type);
	input_name(line, scope_row(c->scope, (enum word)line->word), index, name);
	il_print_constant(literal, number);
	snprintf(text, sizeof(text), "%s" DIAG_AND "%s" DIAG_AND "%s", number,
		 iec_type_row(type)->word, name);
	return il_report(c, line, DIAG_LITERAL_RANGE, text);
}

/* ---- constants ---- */

/* The result of the function that was checked last. */
static struct result function_result(const struct il_check *c, enum iec_type type)
{
	return (struct result){ .there = true, .type = type, .known = c->has_constant,
				.value = c->args.out };
}

/* The value of an input as the function gets it; false: it is known in a scan only.
 * @type: of the inputs that share one; becomes that of an input with its own */
static bool input_value(const struct result *in, const struct word_pin *pin,
			enum iec_type *type, union iec_value *out)
{
	out->i = 0;
	if (pin->own)
		*type = in->literal ? fn_own_type(pin, in->literal) : in->type;
	if (in->literal)
		return literal_fit(in->literal, *type, out);
	if (!in->known)
		return false;
	*out = in->value;
	if (iec_type_row(*type)->class == CLASS_REAL &&
	    iec_type_row(in->type)->class != CLASS_REAL)
		out->r = (double)in->value.i;
	return true;
}

/* Functions that take only some values of a type. @input decides alone whether they succeed;
 * -1: all inputs together do. */
static const struct need {
	enum word word;
	int input;
	enum diag_id id;
	const char *pin, *range; /* of DIAG_INPUT_RANGE; range NULL: 0 to the last bit or input */
} needs[] = {
	{ FN_SHL, 1, DIAG_INPUT_RANGE, "N", ">= 0" }, { FN_SHR, 1, DIAG_INPUT_RANGE, "N", ">= 0" },
	{ FN_ROL, 1, DIAG_INPUT_RANGE, "N", ">= 0" }, { FN_ROR, 1, DIAG_INPUT_RANGE, "N", ">= 0" },
	{ FN_BIT_TEST, 1, DIAG_INPUT_RANGE, "N", NULL }, { FN_BIT_SET, 1, DIAG_INPUT_RANGE, "N", NULL },
	{ FN_BIT_RESET, 1, DIAG_INPUT_RANGE, "N", NULL }, { FN_MUX, 0, DIAG_INPUT_RANGE, "K", NULL },
	{ FN_SQRT, -1, DIAG_INPUT_RANGE, "IN", ">= 0" }, { FN_LN, -1, DIAG_INPUT_RANGE, "IN", "> 0" },
	{ FN_LOG, -1, DIAG_INPUT_RANGE, "IN", "> 0" }, { FN_ASIN, -1, DIAG_INPUT_RANGE, "IN", "-1..1" },
	{ FN_ACOS, -1, DIAG_INPUT_RANGE, "IN", "-1..1" },
	{ FN_FROM_BCD, -1, DIAG_BCD_DIGIT, NULL, NULL },
	{ FN_CONCAT_DATE, -1, DIAG_NO_SUCH_DATE, NULL, NULL },
	{ FN_CONCAT_TOD, -1, DIAG_NO_SUCH_DATE, NULL, NULL },
	{ FN_CONCAT_DT, -1, DIAG_NO_SUCH_DATE, NULL, NULL },
};

static const struct need *need_of(enum word word)
{
	for (size_t i = 0; i < sizeof(needs) / sizeof(*needs); i++)
		if (needs[i].word == word)
			return &needs[i];
	return NULL;
}

static bool divides(enum word word)
{
	return word == FN_DIV || word == FN_MOD || word == FN_DIVTIME;
}

/* The input that decides whether the function can succeed, whatever the others are. */
static int deciding_input(enum word word)
{
	const struct need *need = need_of(word);

	return need ? need->input : divides(word) ? 1 : -1;
}

/* The sign of a function in an expression; NULL: it has none. */
static const char *sign_of(enum word word)
{
	static const struct { enum word word; const char *sign; } signs[] = {
		{ FN_ADD, "+" }, { FN_SUB, "-" }, { FN_MUL, "*" }, { FN_DIV, "/" },
		{ FN_MOD, "MOD" }, { FN_MULTIME, "*" }, { FN_DIVTIME, "/" },
		{ FN_ADD_TOD_TIME, "+" }, { FN_ADD_DT_TIME, "+" }, { FN_SUB_TOD_TIME, "-" },
		{ FN_SUB_TOD_TOD, "-" }, { FN_SUB_DATE_DATE, "-" }, { FN_SUB_DT_TIME, "-" },
		{ FN_SUB_DT_DT, "-" }, { FN_GT, ">" }, { FN_GE, ">=" }, { FN_EQ, "=" },
		{ FN_LE, "<=" }, { FN_LT, "<" }, { FN_NE, "<>" },
	};

	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (signs[i].word == word)
			return signs[i].sign;
	return NULL;
}

/* An input as a message shows it: the name of a variable, the value of a constant, "..." of
 * anything else. */
static void print_input(const struct il_check *c, const struct result *in, char out[28])
{
	const char *text = in->text ? scope_text(c->scope, in->text) : "";
	char number[NUMBER_TEXT];

	if (in->literal && in->literal->real) {
		literal_print(IEC_LREAL, in->literal->value, out, 28);
	} else if (in->literal) {
		il_print_constant(in->literal, number);
		snprintf(out, 28, "%.27s", number);
	} else if (in->known && (!*text || is_made(c, text) || strchr(text, '#'))) {
		literal_print(in->type, in->value, out, 28);
	} else {
		snprintf(out, 28, "%.27s", !*text || is_made(c, text) ? "..." : text);
	}
}

/* "100 * 1000", "SQRT(-1.0)". */
static void print_operation(const struct il_check *c, const struct word_row *row, enum word word,
			    const struct result *in, int count, char out[LIMIT_ARG])
{
	const char *sign = count == 2 ? sign_of(word) : NULL;
	char number[28];
	int len = sign ? 0 : snprintf(out, LIMIT_ARG, "%.20s(", row->word);

	for (int i = 0; i < count; i++) {
		if (word == FN_FROM_BCD && in[i].literal)
			snprintf(number, sizeof(number), "16#%llX",
				 (unsigned long long)in[i].literal->value.i);
		else
			print_input(c, &in[i], number);
		if (!sign && len + strlen(number) > LIMIT_ARG - 10) {
			len += snprintf(out + len, LIMIT_ARG - (size_t)len, "...");
			break;
		}
		len += snprintf(out + len, LIMIT_ARG - (size_t)len, "%s%s%s%s", number,
				i + 1 < count && !sign ? ", " : "",
				i + 1 < count && sign ? " " : "", i == 0 && sign ? sign : "");
		if (i == 0 && sign)
			len += snprintf(out + len, LIMIT_ARG - (size_t)len, " ");
	}
	if (!sign)
		snprintf(out + len, LIMIT_ARG - (size_t)len, ")");
}

/* "IN must be > 0" as parts of a message. */
static void print_need(const struct il_check *c, const struct need *need, char *out, size_t size)
{
	const int last = need->word == FN_MUX ? (int)c->args.count - 2 :
						iec_type_row(c->args.type)->size * 8 - 1;

	if (need->range)
		snprintf(out, size, DIAG_AND "%s" DIAG_AND "%s", need->pin, need->range);
	else
		snprintf(out, size, DIAG_AND "%s" DIAG_AND "0..%d", need->pin, last);
}

static bool divides_by_zero(const struct il_check *c, const struct il_line *line,
			    const struct result *in, enum word word)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	enum iec_type type = c->args.type;
	union iec_value by;

	return divides(word) && input_value(&in[1], word_input(row, 1), &type, &by) &&
	       (iec_type_row(type)->class == CLASS_REAL ? by.r == 0 : by.i == 0);
}

static bool report_failing(struct il_check *c, const struct il_line *line,
			   const struct result *in, enum word word)
{
	const struct need *need = need_of(word);
	char text[2 * LIMIT_ARG];
	size_t len;

	print_operation(c, scope_row(c->scope, (enum word)line->word), word, in,
			(int)c->args.count, text);
	if (divides_by_zero(c, line, in, word))
		return il_report(c, line, DIAG_DIVIDES_BY_ZERO, text);
	len = strlen(text);
	if (!need)
		snprintf(text + len, sizeof(text) - len, DIAG_AND "%s",
			 iec_type_row(c->args.result)->word);
	else if (need->pin)
		print_need(c, need, text + len, sizeof(text) - len);
	return il_report(c, line, need ? need->id : DIAG_NO_RESULT_IN, text);
}

/* <0, 0, >0 as @a is below, equal to or above @b, values of @type. */
static int compare(enum iec_type type, union iec_value a, union iec_value b)
{
	if (iec_type_row(type)->class == CLASS_REAL)
		return (a.r > b.r) - (a.r < b.r);
	if (iec_is_wide(type))
		return ((uint64_t)a.i > (uint64_t)b.i) - ((uint64_t)a.i < (uint64_t)b.i);
	return (a.i > b.i) - (a.i < b.i);
}

/* Warns of a comparison of an integer with a constant at which, or beyond which, its type
 * ends: it always has the same result. */
static void check_compare(struct il_check *c, const struct il_line *line,
			  const struct result *in, const bool known[2])
{
	static const enum word mirrored[] = { FN_LT, FN_LE, FN_EQ, FN_GE, FN_GT, FN_NE };
	const struct result *open = &in[known[0]];
	const struct iec_type_row *row = iec_type_row(open->type);
	const enum iec_type type = c->args.type;
	const union iec_value value = c->args.in[known[1]];
	union iec_value low = { .i = row->low }, high = { .i = row->high };
	enum word word = (enum word)line->word;
	char text[3 * LIMIT_ARG], from[28], to[28];
	int below, above;
	bool always, never;

	if (known[0] == known[1] || !(row->class & (ANY_INT | CLASS_BITS)) ||
	    line->mark & IL_MADE)
		return;
	if (iec_is_wide(open->type))
		high.i = -1;
	literal_print(open->type, low, from, sizeof(from));
	literal_print(open->type, high, to, sizeof(to));
	if (iec_type_row(type)->class == CLASS_REAL) {
		low.r = (double)low.i;
		high.r = (double)high.i;
	}
	below = compare(type, low, value);
	above = compare(type, high, value);
	if (known[0])
		word = mirrored[word - FN_GT];
	always = word == FN_GT ? below > 0 : word == FN_GE ? below >= 0 :
		 word == FN_LT ? above < 0 : word == FN_LE ? above <= 0 :
		 word == FN_NE && (below > 0 || above < 0);
	never = word == FN_GT ? above <= 0 : word == FN_GE ? above < 0 :
		word == FN_LT ? below >= 0 : word == FN_LE ? below > 0 :
		word == FN_EQ && (below > 0 || above < 0);
	if (!always && !never)
		return;
	print_operation(c, NULL, (enum word)line->word, in, 2, text);
	snprintf(text + strlen(text), sizeof(text) - strlen(text),
		 DIAG_AND "%s" DIAG_AND "%s" DIAG_AND "%s..%s", always ? "TRUE" : "FALSE",
		 row->word, from, to);
	il_report(c, line, DIAG_ALWAYS_SAME, text);
}

/* Computes a function of constants as a scan would, and reports one that can never succeed.
 * @type: what its inputs share
 * @stored: of the variable that gets the result
 */
static bool fold(struct il_check *c, const struct il_line *line, const struct result *in,
		 int count, enum iec_type type, enum iec_type stored)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	const enum word word = row->runs ? row->runs : (enum word)line->word;
	const int deciding = deciding_input(word);
	struct fn_args *args = &c->args;
	bool known[LIMIT_FN_INPUTS], all = true;
	enum fn_status status;

	c->has_constant = false;
	*args = (struct fn_args){ .type = type, .result = fn_result(row, type, stored),
				  .count = (uint32_t)count };
	if (type == IEC_STRING || args->result == IEC_STRING)
		return true;
	for (int i = 0; i < count; i++) {
		args->in_type[i] = type;
		known[i] = input_value(&in[i], word_input(row, (uint32_t)i), &args->in_type[i],
				       &args->in[i]);
		if (args->in_type[i] == IEC_STRING)
			return true;
		all &= known[i];
	}
	if (!all && word >= FN_GT && word <= FN_NE)
		check_compare(c, line, in, known);
	if (!all && (deciding < 0 || !known[deciding]))
		return true;
	status = vm_function(word, args);
	c->has_constant = all && status == FN_OK;
	if (status == FN_OK)
		return true;
	return report_failing(c, line, in, word);
}

/* Finds the type that the inputs share, and whether the function takes it. */
static bool check_shared(struct il_check *c, const struct il_line *line,
			 const struct result *in, int count,
			 const struct word_pin *pin, enum iec_type type)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	union iec_value value;

	if (pin->type != IEC_NONE && type != pin->type)
		return report_join(c, line, 0, type, pin->type);
	if (!(pin->classes & iec_type_row(type)->class))
		return report_pin(c, line, pin, type);
	for (int i = 0; i < count; i++)
		if (in[i].literal && !word_input(row, (uint32_t)i)->own &&
		    !literal_fit(in[i].literal, type, &value))
			return report_literal(c, line, i, in[i].literal, type);
	return true;
}

/* The type that inputs of a function share, and whether it takes them
 * @stored: of the variable that gets the result, or IEC_NONE
 * @common: gets that type; unchanged if none is shared
 *
 * Fails: false after a diagnostic, or where one was told before.
 */
static bool il_check_inputs(struct il_check *c, const struct il_line *line,
			 const struct result *in, int count,
			 enum iec_type stored, enum iec_type *common)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	/* Of constants alone. */
	const enum iec_type hint = word_shares(row) ? stored : IEC_NONE;
	const struct word_pin *shared = NULL;
	const struct result *first = NULL;
	enum iec_type type = IEC_NONE, real;
	int point = -1;

	for (int i = 0; i < count; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)i);
		enum iec_type own = in[i].type, join = types_join(type, own);

		if (in[i].literal && in[i].literal->real && !pin->own)
			point = i;

		if (pin->own && !check_own(c, line, pin, &in[i]))
			return false;
		if (pin->own)
			continue;
		if (il_is_unknown(in[i]))
			return false;
		if (join == IEC_TYPE_COUNT)
			return report_join(c, line, i, type, own);
		type = join;
		shared = pin;
		first = in[i].literal && !first ? &in[i] : first;
	}
	if (!shared)
		return fold(c, line, in, count, IEC_NONE, stored);
	/* A constant with a point is of the wanted type, as one without. */
	if (point >= 0 && iec_type_row(type)->class != CLASS_REAL) {
		real = iec_type_row(hint)->class == CLASS_REAL ? hint : IEC_REAL;
		if (types_join(type, real) == IEC_TYPE_COUNT)
			return point ? report_join(c, line, point, type, real) :
				       report_join(c, line, point, real, type);
		type = types_join(type, real);
	}
	if (shared->type != IEC_NONE && (type == IEC_NONE ||
					 iec_can_widen(type, shared->type)))
		type = shared->type; /* INT_TO_REAL: made an INT first */
	if (type == IEC_NONE)
		type = constants_type(shared, first, hint);
	*common = type;
	if (!check_shared(c, line, in, count, shared, type))
		return false;
	return fold(c, line, in, count, type, stored);
}

/* AND( or ADD( : the result waits. @good: so far. */
static bool il_open_paren(struct il_check *c, const struct il_line *line, bool good)
{
	const struct meaning *m;

	if (c->depth == LIMIT_IL_DEPTH)
		return il_report(c, line, DIAG_TOO_DEEP, "(");
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
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	if (m)
		c->now = il_result_of(c, line, m);
	return m && good;
}

/* A function on the current result: ADD 5. */
static bool check_fn(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	struct il_line runs;
	struct result *in = c->in;
	enum iec_type stored;
	int count;

	in[0] = c->now;
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
	if (!il_check_inputs(c, &runs, in, count, stored, common))
		return false;
	c->now = function_result(c, fn_result(row, *common, stored));
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

/* ADD(EN := …, IN1 := …, ENO => …, OUT => …): checks the lines after @at. */
static bool check_call(struct il_check *c, int at, enum iec_type *common)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	struct result *in = c->in;
	struct il_line runs;
	struct result out;
	enum iec_type stored;
	int count = 0, last = 0;
	bool good = true;

	for (int i = 0; i < LIMIT_FN_INPUTS; i++)
		in[i].there = false;
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
			good &= il_need_bool(c, arg, il_result_of(c, arg, m),
					  il_operand_text(c, arg));
		} else if (index < 0 || index >= LIMIT_FN_INPUTS) {
			good = il_report(c, arg, DIAG_NO_PIN, pin);
		} else {
			count += !in[index].there;
			in[index] = il_result_of(c, arg, m);
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
	if (!il_check_inputs(c, &runs, in, count, stored, common))
		return false;
	out = function_result(c, fn_result(row, *common, stored));
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
			good &= il_need_bool(c, arg, il_result_of(c, arg, m),
					  il_operand_text(c, arg));
		else if (strcasecmp(pin, "OUT") == 0) {
			good &= can_store(c, arg, out, m->type);
			if (is_made(c, il_operand_text(c, arg)))
				remember(c, m, out);
		} else
			good = il_report(c, arg, DIAG_NO_PIN, pin);
	}
	c->now.there = false;
	return good;
}

static bool is_label(struct il_check *c, uint32_t name)
{
	uint32_t fold = names_fold(&scope_project(c->scope)->names, name);

	return fold && fold < c->label_count && c->label[fold];
}

/* CALC and CALCN need a result; CAL alone ends it. */
static bool il_check_flow(struct il_check *c, const struct il_line *line)
{
	bool good = true;

	if (c->depth > 0 && line->op != OP_STP)
		good = il_report(c, line, DIAG_IL_OPEN_PAREN, op_row(line->op)->word);
	if (line->op == OP_JMP && !is_label(c, line->operand))
		good = il_report_near(c, line, DIAG_NO_LABEL, EXPECT_LABEL);
	if (line->modifiers & MOD_C)
		return il_need_result(c, line) &&
		       il_need_bool(c, line, c->now, "") && good;
	if (line->op != OP_STP)
		c->now.there = false;
	return good;
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
		       il_need_bool(c, line, c->now, "");
	if (is_arg(c, at + 1))
		good = il_report(c, &c->il->line[at + 1], DIAG_TOO_MANY_OPERANDS,
				 scope_text(c->scope, c->il->line[at + 1].pin));
	c->now.there = false;
	return good;
}

static const char *pin_text(struct il_check *c, const struct il_line *arg)
{
	return scope_text(c->scope, arg->pin);
}

static const char *operand_text(struct il_check *c, const struct il_line *line)
{
	return scope_text(c->scope, line->operand);
}

/* Adds a diagnostic when the operand is a structure or array. */
static bool is_plain(struct il_check *c, const struct il_line *arg,
		     const struct meaning *m)
{
	if (m->kind == MEANING_STRUCT)
		return il_report(c, arg, DIAG_STRUCT_AS_VALUE, operand_text(c, arg));
	return meaning_fault(m) == DIAG_COUNT ||
	       il_report(c, arg, meaning_fault(m), operand_text(c, arg));
}

static struct result value_of(const struct meaning *m)
{
	struct result out = { .there = true, .type = m->type };

	if (m->kind == MEANING_LITERAL && m->type == IEC_NONE)
		out.literal = &m->literal;
	return out;
}

/* ---- shapes ---- */

static bool is_like(const struct meaning *m, const struct word_pin *pin)
{
	if (pin->elements)
		return m->kind == MEANING_ARRAY && m->addr.area == AREA_NONE &&
		       m->type == pin->type && m->array.low == pin->low &&
		       m->array.count == pin->elements &&
		       (pin->type != IEC_NONE || m->word == pin->word) &&
		       (pin->type != IEC_STRING || m->capacity == pin->capacity);
	return (m->kind == MEANING_STRUCT || m->kind == MEANING_INSTANCE) &&
	       pin->type == IEC_NONE && m->word == pin->word;
}

/** il_check_shape - is @m a structure, array or instance of the type that @pin declares? */
static bool il_check_shape(struct il_check *c, const struct il_line *arg,
			   const struct meaning *m, const struct word_pin *pin)
{
	const char *word = pin->type == IEC_NONE ? scope_row(c->scope, pin->word)->word :
						   iec_type_row(pin->type)->word;
	const char *operand = il_operand_text(c, arg);
	char text[2 * LIMIT_ARG], room[16] = "";

	if (is_like(m, pin))
		return true;
	if (!pin->elements)
		return il_report_wrong(c, arg, operand, word);
	if (pin->type == IEC_STRING)
		snprintf(room, sizeof(room), "[%u]", pin->capacity);
	snprintf(text, sizeof(text), "%.20s" DIAG_AND "ARRAY[%ld..%lld] OF %.20s%s", operand,
		 (long)pin->low, (long long)pin->low + pin->elements - 1, word, room);
	return il_report(c, arg, m->addr.area == AREA_NONE ? DIAG_WRONG_TYPE : DIAG_AT_WHOLE,
			 text);
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
	return il_report_wrong(c, arg, operand_text(c, arg),
			       iec_type_row(pin->type)->word);
}

/* @m: the operand at the pin. */
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

/** il_check_pin - one parameter against the pin of @row that it names. */
static bool il_check_pin(struct il_check *c, const struct word_row *row,
			 const struct il_line *arg)
{
	const char *name = pin_text(c, arg);
	int index = word_pin_find(row, name, strlen(name));
	const struct meaning *m = il_find(c, arg);

	if (!m)
		return false;
	if (index < 0)
		return is_plain(c, arg, m) &&
		       (arg->mark & IL_IN_ORDER ?
			il_report(c, arg, DIAG_TOO_MANY_OPERANDS, operand_text(c, arg)) :
			il_report(c, arg, DIAG_NO_PIN, name));
	if ((row->pin[index].dir == PIN_OUT) != (arg->kind == IL_ARG_OUT))
		return il_report(c, arg, arg->kind == IL_ARG_OUT ? DIAG_INPUT_READ :
				 DIAG_PIN_DIRECTION, name);
	return check_value(c, arg, m, &row->pin[index]);
}

/* Is there a parameter for pin @name of the call at @at? */
static bool has_arg(struct il_check *c, int at, const char *name)
{
	for (int i = at + 1; is_arg(c, i); i++)
		if (name_is(pin_text(c, &c->il->line[i]), name, strlen(name)))
			return true;
	return false;
}

/* Is there a parameter for each VAR_IN_OUT of @row? */
static bool il_check_in_outs(struct il_check *c, int at, const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN_OUT &&
		    !has_arg(c, at, row->pin[i].name))
			return il_report(c, &c->il->line[at], DIAG_MISSING_INPUT,
					 row->pin[i].name);
	return true;
}

/* CAL of an instance or a subroutine; the lines behind @at too. */
static bool il_check_cal(struct il_check *c, int at)
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
		       il_need_bool(c, line, c->now, "");
	for (int i = at + 1; is_arg(c, i); i++)
		good &= il_check_pin(c, scope_row(c->scope, m->word),
				     &c->il->line[i]);
	good &= il_check_in_outs(c, at, scope_row(c->scope, m->word));
	c->now.there = false;
	return good;
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
		bool good = il_need_bool(c, line, left, "");

		good = il_need_bool(c, line, right, what) && good;
		if (!good) /* the type after an error: no second error */
			c->now.type = IEC_NONE;
		return good;
	}
	function.word = (uint16_t)op_function(op);
	c->now.type = IEC_NONE;
	if (!il_check_inputs(c, &function, in, 2, IEC_NONE, &type))
		return false;
	c->now = function_result(c, type);
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
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
	return false;
}

static bool il_check_not(struct il_check *c, const struct il_line *line)
{
	struct result now = c->now;
	bool good = il_need_result(c, line);

	if (good && il_is_bits(now))
		return true;
	c->now = (struct result){ .there = true, .type = IEC_BOOL };
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

	if (like->addr.area != AREA_NONE) /* a variable with AT cannot be copied whole */
		return il_check_shape(c, arg, like, &pin);
	return il_check_shape(c, arg, m, &pin);
}

/* ST of a structure or array. */
static bool il_check_store_whole(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct meaning *from = c->now.whole, *to = il_find(c, line);

	if (!is_store(c, next_line(c, at))) /* no other instruction takes a whole */
		c->now = (struct result){ .there = false };
	return to && il_check_same(c, line, to, from) && il_can_write(c, line, to);
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

/* Checks the function before a parenthesis with the value left of it and the value inside. */
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
	c->now = function_result(c, fn_result(row, *common, stored));
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
	const struct pou *pou = shape_pou(scope_project(c->scope),
					  (enum word)c->il->line[at].word);

	return pou && pou->vars.count > 0 ? &pou->vars.var[0] : NULL;
}

/* EN := or ENO => at @arg. */
static bool il_check_power(struct il_check *c, const struct il_line *arg, bool write)
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

/* Adds a diagnostic for an input that is neither given nor has a default. */
static bool check_inputs(struct il_check *c, int at, const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN && !row->pin[i].has_init &&
		    !has_arg(c, at, row->pin[i].name))
			return il_report(c, &c->il->line[at], DIAG_MISSING_INPUT,
					 row->pin[i].name);
	return il_check_in_outs(c, at, row);
}

/* A function with formal parameters. */
static bool il_check_own_call(struct il_check *c, int at)
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
	const struct meaning *m = il_find(c, line);

	*pin = next_input(row, *pin);
	if (!m)
		return false;
	if (*pin < 0)
		return il_report(c, line, DIAG_TOO_MANY_OPERANDS, operand_text(c, line));
	return check_value(c, line, m, &row->pin[*pin]);
}

/* The result is the first input, the operands are the others. */
static bool il_check_own_fn(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	const struct var *var = result_var(c, at);
	struct result first = c->now;
	int pin = next_input(row, -1);
	bool good = true;

	c->now = (struct result){ .there = true, .type = var ? var->type : IEC_NONE };
	if (!first.there)
		return no_result(c, line, row->word);
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

/* Is the line at @at a MOVE of a structure or array? */
static bool il_is_whole_move(struct il_check *c, int at)
{
	enum diag_id why;

	if (c->il->line[at].word != FN_MOVE)
		return false;
	for (int i = at + 1; is_arg(c, i); i++)
		if (may_move(scope_find(c->scope, c->pou, c->il->line[i].operand,
					&why)))
			return true;
	return false;
}

static const struct il_line *arg_of(struct il_check *c, int at, const char *name)
{
	for (int i = at + 1; is_arg(c, i); i++)
		if (strcasecmp(scope_text(c->scope, c->il->line[i].pin), name) == 0)
			return &c->il->line[i];
	return NULL;
}

static bool il_check_whole_move(struct il_check *c, int at)
{
	const struct il_line *line = &c->il->line[at];
	const struct il_line *in = arg_of(c, at, "IN"), *out = arg_of(c, at, "OUT");
	const struct il_line *en = arg_of(c, at, "EN"), *eno = arg_of(c, at, "ENO");
	const struct meaning *from, *to;

	c->now.there = false;
	if (!in || !out)
		return il_report(c, line, DIAG_MISSING_INPUT, in ? "OUT" : "IN");
	from = il_find(c, in);
	to = il_find(c, out);
	if (!from || !to || (en && !il_check_power(c, en, false)) ||
	    (eno && !il_check_power(c, eno, true)))
		return false;
	if (!may_move(to))
		return il_check_same(c, out, to, from);
	return il_check_same(c, in, from, to) && il_can_write(c, out, to);
}

static bool check_line(struct il_check *c, int at, enum iec_type *type)
{
	const struct il_line *line = &c->il->line[at];
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
	struct il_check *c = arena_alloc(scratch, sizeof(*c));
	bool good;

	if (!c)
		return false;
	*c = (struct il_check){ .scope = scope, .pou = pou, .il = il, .types = types,
				.diags = diags };
	good = find_labels(c, scratch);
	c->opened = arena_alloc(scratch, LIMIT_IL_DEPTH * sizeof(*c->opened));
	if (!c->label || !c->opened)
		return false;
	for (int i = 0; i < il->count; i++)
		good &= check_line(c, i, &types[i]);
	if (c->depth > 0 && il->count > 0)
		good = il_report(c, &il->line[il->count - 1], DIAG_IL_OPEN_PAREN,
			      "(");
	return good;
}
