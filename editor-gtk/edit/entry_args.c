/* SPDX-License-Identifier: MIT
 *
 * entry_args - the parameters of a box as a person types them: by name, or in their
 * order, and what a fresh timer begins with.
 *
 * It makes the canonical text; what does not fit a pin's type the checks will say.
 */
#include "editor-gtk/edit/entry_inside.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/model/args.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool entry_wrong(struct entry *entry, const char *why, const char *what, size_t len)
{
	if (len > sizeof(entry->what) - 1)
		len = sizeof(entry->what) - 1;
	entry->sense = ENTRY_WRONG;
	entry->why = why;
	memcpy(entry->what, what, len);
	entry->what[len] = '\0';
	return false;
}

bool entry_append(char *out, size_t size, const char *text, size_t len)
{
	const size_t used = strlen(out);

	if (used + len + 1 > size)
		return false;
	memcpy(out + used, text, len);
	out[used + len] = '\0';
	return true;
}

/* ---- one value ---- */

struct value {
	const char *name;    /* of its pin; name_len 0: the line says none      */
	size_t name_len;
	bool output, inverse;
	const char *text;    /* a new name with what the line says of it        */
	size_t len;
};

/* Of a line: there are no more than every other byte. */
struct values {
	struct value value[ENTRY_TEXT / 2];
	int count;
};

static const char *text_end(const char *text, const char *end)
{
	const char *stop = text + 1;

	while (stop < end && *stop != '\'')
		stop += *stop == '$' && stop + 1 < end ? 2 : 1;
	return stop < end ? stop + 1 : end;
}

/* Where the value at the lexer ends: `-5`, `Table[i].X`, `T#5s`, `'text'`, `New AT %MW4`. */
static const char *value_end(struct lex *lex)
{
	const char *text = lex->token.text;
	const size_t said = entry_said_len(text, (size_t)(lex->end - text));
	const char *end;
	int depth = 0;

	if (*text == '\'' || said > 0) {
		lex->at = said > 0 ? text + said : text_end(text, lex->end);
		end = lex->at;
		lex_next(lex);
		return end;
	}
	do {
		depth += lex_is(lex, "[") - lex_is(lex, "]");
		end = lex->token.text + lex->token.len;
		lex_next(lex);
	} while (lex->token.kind != TOKEN_END && !lex_is(lex, ",") &&
		 (depth > 0 || !lex->token.space_before));
	return end;
}

/* The next value of the line: `PT:=/Ready`, `Q=>Lamp`, `5`. */
static bool next_value(struct lex *lex, struct value *out)
{
	const struct token name = lex->token;
	struct lex ahead = *lex;

	*out = (struct value){ .name = "" };
	lex_next(&ahead);
	if (lex_is(&ahead, ":=") || lex_is(&ahead, "=>")) {
		out->output = lex_is(&ahead, "=>");
		out->name = name.text;
		out->name_len = name.len;
		*lex = ahead;
		lex_next(lex);
	}
	out->inverse = lex_accept(lex, "/");
	if (lex->token.kind == TOKEN_END)
		return false;
	out->text = lex->token.text;
	out->len = (size_t)(value_end(lex) - out->text);
	lex_accept(lex, ",");
	return true;
}

static const struct word_pin *pin_of(const struct word_row *row, int index)
{
	return row->kind == WORD_FN ? word_input(row, (uint32_t)index) : &row->pin[index];
}

/* A literal as it is kept: 5s becomes T#5s. False: it is none. */
static bool add_literal(const struct value *value, char *out, size_t size, bool *fits)
{
	struct literal literal;
	int64_t ns;

	*fits = true;
	if (value->len > 0 && *value->text == '+')
		return false;
	if (literal_parse(value->text, value->len, &literal) == LITERAL_OK)
		*fits = entry_append(out, size, value->text, value->len);
	else if (literal_parse_duration(value->text, value->len, &ns))
		*fits = entry_append(out, size, "T#", 2) &&
			entry_append(out, size, value->text, value->len);
	else
		return false;
	return true;
}

static bool add_value(const struct entry_place *place, const struct entry_fit *fit,
		      const struct value *value, struct entry *entry)
{
	struct entry_target target;
	char number[8] = "";
	bool fits;

	if (fit->write && value->inverse)
		return entry_wrong(entry, N_("this cannot be written"), value->text,
				   value->len);
	if ((fit->write || value->inverse) &&
	    add_literal(value, number, sizeof(number), &fits))
		return entry_wrong(entry, fit->write ? N_("this cannot be written") :
				   N_("this is no operand"), value->text, value->len);
	if (value->inverse && !entry_append(entry->args, sizeof(entry->args), "/", 1))
		return entry_wrong(entry, N_("this line is too long"), "", 0);
	if (add_literal(value, entry->args, sizeof(entry->args), &fits))
		return fits || entry_wrong(entry, N_("this line is too long"), "", 0);
	if (!entry_operand(place, value->text, value->len, fit, &target, entry))
		return false;
	if (fit->write && target.means == MEANS_VALUE && !target.write)
		return entry_wrong(entry, N_("this cannot be written"), value->text,
				   value->len);
	return entry_append(entry->args, sizeof(entry->args), target.text,
			    strlen(target.text)) ||
	       entry_wrong(entry, N_("this line is too long"), "", 0);
}

/* ---- parameters ---- */

static bool add_pin(const struct entry_place *place, const struct entry_fit *fit,
		    const char *name, const struct value *value, struct entry *entry)
{
	char head[ENTRY_NAME];
	struct arg arg;

	if (args_find(entry->args, name, strlen(name), &arg))
		return entry_wrong(entry, N_("this pin is given twice"), name,
				   strlen(name));
	snprintf(head, sizeof(head), "%s%.250s%s", entry->args[0] ? " " : "", name,
		 fit->write ? "=>" : ":=");
	return (entry_append(entry->args, sizeof(entry->args), head, strlen(head)) ||
		entry_wrong(entry, N_("this line is too long"), "", 0)) &&
	       add_value(place, fit, value, entry);
}

static bool is_out(const struct word_row *row, const char *name, size_t len)
{
	return row->kind == WORD_FN && ascii_is("OUT", name, len);
}

static void upper(const char *text, size_t len, char *out, size_t size)
{
	size_t i = 0;

	for (; i < len && i + 1 < size; i++)
		out[i] = ascii_upper(text[i]);
	out[i] = '\0';
}

static bool add_named(const struct entry_place *place, const struct word_row *row,
		      const struct value *value, enum iec_type shared,
		      struct entry *entry)
{
	const int index = word_pin_find(row, value->name, value->name_len);
	const struct word_pin *pin = index >= 0 ? pin_of(row, index) : NULL;
	char spelled[LIMIT_NAME + 1];
	struct entry_fit fit;

	if (!pin && !is_out(row, value->name, value->name_len))
		return entry_wrong(entry, N_("the box has no such pin"), value->name,
				   value->name_len);
	upper(value->name, value->name_len, spelled, sizeof(spelled));
	if (pin && (row->kind != WORD_FN || index < row->pin_count))
		snprintf(spelled, sizeof(spelled), "%s", pin->name);
	fit = pin ? entry_fit_pin(row, pin, shared, value->output) :
		    entry_fit_result(row, shared);
	fit.write = value->output;
	return add_pin(place, &fit, spelled, value, entry);
}

/* Name of input @index of a function, also past its named pins: IN3 behind IN2. */
static void input_name(const struct word_row *row, int index, char *out, size_t size)
{
	const char *last;
	int letters;

	if (index < row->pin_count) {
		snprintf(out, size, "%s", row->pin[index].name);
		return;
	}
	last = row->pin[row->pin_count - 1].name;
	letters = (int)strcspn(last, "0123456789");
	snprintf(out, size, "%.*s%d", letters, last,
		 word_last_number(row) + index - row->pin_count + 1);
}

/* The last value of a function is where its result goes, unless power is its result. */
static bool add_inputs(const struct entry_place *place, const struct word_row *row,
		       const struct value *value, int count, enum iec_type shared,
		       struct entry *entry)
{
	const bool out = count > 1 && !word_is_test(row);
	const int inputs = out ? count - 1 : count;
	const struct entry_fit result = entry_fit_result(row, shared);
	char name[LIMIT_NAME + 1];

	if (row->pin_count == 0 || inputs > row->most_inputs)
		return entry_wrong(entry, N_("the box has fewer inputs"), "", 0);
	for (int i = 0; i < inputs; i++) {
		const struct entry_fit fit = entry_fit_pin(row, pin_of(row, i), shared,
							   false);

		input_name(row, i, name, sizeof(name));
		if (!add_pin(place, &fit, name, &value[i], entry))
			return false;
	}
	return !out || add_pin(place, &result, "OUT", &value[inputs], entry);
}

/* Those of a block that no row of power is drawn to: its inputs that are not BOOL. */
static bool add_block_inputs(const struct entry_place *place, const struct word_row *row,
			     const struct value *value, int count, struct entry *entry)
{
	int used = 0;

	for (int i = 0; i < row->pin_count && used < count; i++) {
		const struct word_pin *pin = &row->pin[i];
		const struct entry_fit fit = entry_fit_pin(row, pin, IEC_NONE, false);

		if (pin->dir != PIN_IN || pin->type == IEC_BOOL)
			continue;
		if (!add_pin(place, &fit, pin->name, &value[used++], entry))
			return false;
	}
	return used == count ||
	       entry_wrong(entry, N_("the box has fewer inputs"), "", 0);
}

/* What a timer or counter of the catalogue gets that nothing was said for. */
static bool add_first_values(const struct word_row *row, struct entry *entry)
{
	const bool counts = !strcmp(row->family, "Counters");

	if (word_is_own(entry->word))
		return true;
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		const uint16_t class = iec_type_row(pin->type)->class;
		char text[LIMIT_NAME + 16];

		if (pin->dir != PIN_IN || pin->has_init ||
		    !(class & (counts ? ANY_INT : CLASS_TIME)))
			continue;
		snprintf(text, sizeof(text), "%s%s:=%s", entry->args[0] ? " " : "",
			 pin->name, class & CLASS_TIME ? "T#1s" : "10");
		entry_append(entry->args, sizeof(entry->args), text, strlen(text));
	}
	return true;
}

/* Is it at a pin whose type does not depend on the others? */
static bool is_alone(const struct word_row *row, const struct value *value, int number)
{
	const int index = value->name_len ? word_pin_find(row, value->name,
							  value->name_len) : number;

	return index >= 0 && row->pin_count > 0 &&
	       (pin_of(row, index)->own || pin_of(row, index)->type != IEC_NONE);
}

/* Of one value; IEC_NONE: nobody knows. @guessed gets what it may be then. */
static enum iec_type type_of(const struct entry_place *place, const struct value *value,
			     enum iec_type *guessed)
{
	struct entry_target target;
	struct literal literal;
	int64_t ns;

	if (literal_parse(value->text, value->len, &literal) == LITERAL_OK) {
		if (literal.real)
			*guessed = IEC_REAL;
		return literal.type;
	}
	if (literal_parse_duration(value->text, value->len, &ns))
		return IEC_TIME;
	entry_target_find(place, value->text, value->len, &target);
	return target.means == MEANS_VALUE && !target.array ? target.type : IEC_NONE;
}

/* That the inputs of a function have in common, by the first one that is known. */
static enum iec_type shared_type(const struct entry_place *place,
				 const struct word_row *row, const struct values *values)
{
	enum iec_type guessed = IEC_NONE, type = IEC_NONE;
	int number = 0;

	for (int i = 0; type == IEC_NONE && i < values->count; i++) {
		const struct value *value = &values->value[i];

		if (!is_alone(row, value, number))
			type = type_of(place, value, &guessed);
		number += value->name_len == 0;
	}
	return type != IEC_NONE ? type : guessed;
}

static bool read_values(const char *text, struct values *out, struct entry *entry)
{
	struct lex lex;

	lex_init(&lex, text, strlen(text));
	lex_next(&lex);
	lex_accept(&lex, ",");
	while (lex.token.kind != TOKEN_END) {
		struct value *value = &out->value[out->count];

		if (out->count == ENTRY_TEXT / 2)
			return entry_wrong(entry, N_("this line is too long"), "", 0);
		if (!next_value(&lex, value))
			return entry_wrong(entry, N_("a value is missing"), value->name,
					   value->name_len);
		out->count++;
	}
	return true;
}

/* Those with a name at once; the others come behind them, in their order. */
static bool add_all(const struct entry_place *place, const struct word_row *row,
		    struct values *values, struct entry *entry)
{
	const enum iec_type shared = row->kind != WORD_FN ? IEC_NONE :
				     shared_type(place, row, values);
	struct value *value = values->value;
	int count = 0;

	for (int i = 0; i < values->count; i++)
		if (value[i].name_len == 0)
			value[count++] = value[i];
		else if (!add_named(place, row, &value[i], shared, entry))
			return false;
	entry->proposed = row->kind == WORD_FB && values->count == 0;
	if (count == 0)
		return !entry->proposed || add_first_values(row, entry);
	return row->kind == WORD_FN ?
		add_inputs(place, row, value, count, shared, entry) :
		add_block_inputs(place, row, value, count, entry);
}

bool entry_args(const struct entry_place *place, const struct word_row *row,
		const char *text, struct entry *entry)
{
	struct values *values = calloc(1, sizeof(*values));
	bool good;

	if (!values)
		return entry_wrong(entry, N_("out of memory"), "", 0);
	good = read_values(text, values, entry) && add_all(place, row, values, entry);
	free(values);
	return good;
}
