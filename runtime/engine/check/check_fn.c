/* SPDX-License-Identifier: MIT
 *
 * check_fn - do the inputs of a function go together, and does it take them?
 *
 * A part of check_il.
 */
#include "engine/check/il_check.h"

#include <stdio.h>

static bool report_pin(struct il_check *c, const struct il_line *line,
		       const struct word_pin *pin, enum iec_type type)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	char text[LIMIT_ARG];

	if (pin->own)
		snprintf(text, sizeof(text), "%.16s.%.8s does not take %s",
			 row->word, pin->name, iec_type_row(type)->word);
	else
		snprintf(text, sizeof(text), "%s does not take %s", row->word,
			 iec_type_row(type)->word);
	return il_report(c, line, DIAG_WRONG_TYPE, text);
}

/* An input with a type of its own. */
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
	snprintf(text, sizeof(text), "%s and %s: %s", iec_type_row(a)->word,
		 iec_type_row(b)->word, name);
	return il_report(c, line, DIAG_NEEDS_CONVERSION, text);
}

static bool report_literal(struct il_check *c, const struct il_line *line, int index,
			   const struct literal *literal, enum iec_type type)
{
	char name[LIMIT_ARG], text[2 * LIMIT_ARG];

	if (!(line->mark & IL_NAMED) || literal->real ||
	    !(iec_type_row(type)->class & (ANY_NUM | CLASS_BITS)))
		return il_report_constant(c, line, literal, type);
	input_name(line, scope_row(c->scope, (enum word)line->word), index, name);
	snprintf(text, sizeof(text), "%s: %s", iec_type_row(type)->word, name);
	return il_report(c, line, DIAG_LITERAL_RANGE, text);
}

/* The type that inputs share, and whether the function takes it. */
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

bool il_check_inputs(struct il_check *c, const struct il_line *line,
			 const struct result *in, int count,
			 enum iec_type hint, enum iec_type *common)
{
	const struct word_row *row = scope_row(c->scope, (enum word)line->word);
	const struct word_pin *shared = NULL;
	const struct result *first = NULL;
	enum iec_type type = IEC_NONE;

	for (int i = 0; i < count; i++) {
		const struct word_pin *pin = word_input(row, (uint32_t)i);
		bool point = in[i].literal && in[i].literal->real;
		enum iec_type own = point ? IEC_REAL : in[i].type;
		enum iec_type join = types_join(type, own);

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
		return true;
	if (shared->type != IEC_NONE && (type == IEC_NONE ||
					 iec_can_widen(type, shared->type)))
		type = shared->type; /* INT_TO_REAL: made an INT first */
	if (type == IEC_NONE)
		type = constants_type(shared, first, hint);
	*common = type;
	return check_shared(c, line, in, count, shared, type);
}
