/* SPDX-License-Identifier: MIT
 *
 * constant - a function of a list on its inputs: the type that they share, and what it gives
 * if they are constants.
 *
 * Constants are computed by the functions of the scan, so the check and the board agree.
 */
#include "engine/check/constant.h"

#include "engine/model/convert.h"

#include <stdio.h>
#include <string.h>

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

bool il_report(struct fn_check *c, const struct il_line *line,
		   enum diag_id id, const char *arg)
{
	return diag_add(c->diags, il_place(c->scope, c->pou, line, id), "%s", arg);
}

bool il_is_made(const struct fn_check *c, const char *operand)
{
	return c->pou->language != LANGUAGE_IL && operand[0] == '_' &&
	       (operand[1] == 'N' || operand[1] == 'T');
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

bool il_report_types(struct fn_check *c, const struct il_line *line,
			 enum iec_type from, enum iec_type to)
{
	const struct il_line *call = line;
	const char *operand = line->operand ?
		scope_said(c->scope, line->operand) : "";
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
	if (il_is_made(c, operand))
		operand = "";
	snprintf(text, sizeof(text), "%.24s" DIAG_AND "%s" DIAG_AND "%s", operand,
		 iec_type_row(from)->word, iec_type_row(to)->word);
	return il_report(c, line, mismatch(from, to), text);
}

/* An untyped number as a message shows it. */
static void il_print_constant(const struct literal *literal, char out[NUMBER_TEXT])
{
	if (literal->real)
		iec_value_print(IEC_LREAL, literal->value, out, NUMBER_TEXT);
	else if (literal->high)
		snprintf(out, NUMBER_TEXT, "%llu", (unsigned long long)literal->value.i);
	else
		snprintf(out, NUMBER_TEXT, "%lld", (long long)literal->value.i);
}

bool il_report_constant(struct fn_check *c, const struct il_line *line,
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
	if (to == IEC_BOOL && line->kind == IL_FN && line->word >= FN_GT && line->word <= FN_NE) {
		snprintf(text, sizeof(text), "%s", number);
		return il_report(c, line, DIAG_COMPARED_TWICE, text);
	}
	while (!(kind[k].class & row->class))
		k++;
	snprintf(text, sizeof(text), "%s" DIAG_AND "%s" DIAG_AND "%s", number, row->word,
		 kind[k].like);
	return il_report(c, line, DIAG_CONSTANT_KIND, text);
}

bool il_is_unknown(struct il_result result)
{
	return result.there && result.type == IEC_NONE && !result.literal;
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

static bool report_pin(struct fn_check *c, const struct il_line *line,
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
static bool check_own(struct fn_check *c, const struct il_line *line,
		      const struct word_pin *pin, const struct il_result *in)
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
				    const struct il_result *in, enum iec_type hint)
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

static bool report_join(struct fn_check *c, const struct il_line *line, int index,
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

static bool report_literal(struct fn_check *c, const struct il_line *line, int index,
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

struct il_result il_function_result(const struct fn_check *c, enum iec_type type)
{
	return (struct il_result){ .there = true, .type = type, .known = c->has_constant,
				.value = c->args.out };
}

/* The value of an input as the function gets it; false: it is known in a scan only.
 * @type: of the inputs that share one; becomes that of an input with its own */
static bool input_value(const struct il_result *in, const struct word_pin *pin,
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
static void print_input(const struct fn_check *c, const struct il_result *in, char out[28])
{
	const char *text = in->text ? scope_text(c->scope, in->text) : "";
	char number[NUMBER_TEXT];

	if (in->literal && in->literal->real) {
		literal_print(IEC_LREAL, in->literal->value, out, 28);
	} else if (in->literal) {
		il_print_constant(in->literal, number);
		snprintf(out, 28, "%.27s", number);
	} else if (in->known && (!*text || il_is_made(c, text) || strchr(text, '#'))) {
		literal_print(in->type, in->value, out, 28);
	} else {
		snprintf(out, 28, "%.27s", !*text || il_is_made(c, text) ? "..." : text);
	}
}

/* "100 * 1000", "SQRT(-1.0)". */
static void print_operation(const struct fn_check *c, const struct word_row *row, enum word word,
			    const struct il_result *in, int count, char out[LIMIT_ARG])
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
static void print_need(const struct fn_check *c, const struct need *need, char *out, size_t size)
{
	const int last = need->word == FN_MUX ? (int)c->args.count - 2 :
						iec_type_row(c->args.type)->size * 8 - 1;

	if (need->range)
		snprintf(out, size, DIAG_AND "%s" DIAG_AND "%s", need->pin, need->range);
	else
		snprintf(out, size, DIAG_AND "%s" DIAG_AND "0..%d", need->pin, last);
}

static bool divides_by_zero(const struct fn_check *c, const struct il_line *line,
			    const struct il_result *in, enum word word)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	enum iec_type type = c->args.type;
	union iec_value by;

	return divides(word) && input_value(&in[1], word_input(row, 1), &type, &by) &&
	       (iec_type_row(type)->class == CLASS_REAL ? by.r == 0 : by.i == 0);
}

static bool report_failing(struct fn_check *c, const struct il_line *line,
			   const struct il_result *in, enum word word)
{
	const struct need *need = need_of(word);
	char text[2 * LIMIT_ARG];
	size_t len;

	print_operation(c, scope_row(c->scope, (enum word)line->word), word, in,
			(int)c->args.count, text);
	/* Programs of other tools run as they do with a variable in place of the constant. */
	if (scope_project(c->scope)->words.own_first)
		return il_report(c, line, DIAG_NEVER_SUCCEEDS, text);
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
static void check_compare(struct fn_check *c, const struct il_line *line,
			  const struct il_result *in, const bool known[2])
{
	static const enum word mirrored[] = { FN_LT, FN_LE, FN_EQ, FN_GE, FN_GT, FN_NE };
	const struct il_result *open = &in[known[0]];
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
static bool fold(struct fn_check *c, const struct il_line *line, const struct il_result *in,
		 int count, enum iec_type type, enum iec_type stored)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	const enum word word = row->runs ? row->runs : (enum word)line->word;
	const int deciding = deciding_input(word);
	struct fn_args *args = &c->args;
	bool known[LIMIT_FN_ARGS], all = true;
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
static bool check_shared(struct fn_check *c, const struct il_line *line,
			 const struct il_result *in, int count,
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

bool il_check_inputs(struct fn_check *c, const struct il_line *line,
			 const struct il_result *in, int count,
			 enum iec_type stored, enum iec_type *common)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	/* Both operands are constants. */
	const enum iec_type hint = word_shares(row) ? stored : IEC_NONE;
	const struct word_pin *shared = NULL;
	const struct il_result *first = NULL;
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

