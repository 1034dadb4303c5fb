/* SPDX-License-Identifier: MIT
 *
 * entry - the meaning of a line of quick entry.
 *
 * The line is tried as an expression, a drawn element, a mnemonic with its operand, and a
 * plain name, in this order. A declared name wins over a mnemonic without operand; so does
 * a name before AT or a colon.
 */
#include "editor-gtk/edit/entry_address.h"
#include "editor-gtk/edit/entry_expression.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/model/args.h"
#include "engine/model/loop.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char too_long[] = N_("the line is too long");

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static void trim(const char **text, size_t *len)
{
	for (; *len > 0 && is_blank(**text); ++*text)
		--*len;
	while (*len > 0 && is_blank((*text)[*len - 1]))
		--*len;
}

static bool keep_operand(struct entry *entry, const char *text, size_t len)
{
	if (!entry_append(entry->operand, sizeof(entry->operand), text, len))
		return entry_wrong(entry, too_long, "", 0);
	entry->sense = ENTRY_ELEMENT;
	return true;
}

/* ---- Boolean operands ---- */

/* The power that an instance gives: its first Boolean output. */
static bool keep_instance(const struct entry_place *place, struct entry_target *target,
			  const char *text, size_t len, bool write, struct entry *entry)
{
	const struct word_row *row = words_row(&place->project->words, target->word);
	const int pin = target->array || row->kind != WORD_FB ? -1 :
			word_first_bool(row, PIN_OUT);

	if (pin < 0 || write)
		return entry_wrong(entry, N_("“%s” is not a BOOL"), text, len);
	return keep_operand(entry, target->text, strlen(target->text)) &&
	       keep_operand(entry, ".", 1) &&
	       keep_operand(entry, row->pin[pin].name, strlen(row->pin[pin].name));
}

static bool take_bool(const struct entry_place *place, const char *text, size_t len,
		      bool write, struct entry *entry)
{
	const struct entry_fit fit = entry_fit_bool(write);
	struct entry_target target;

	if (!entry_operand(place, text, len, &fit, &target, entry))
		return false;
	if (target.means == MEANS_INSTANCE)
		return keep_instance(place, &target, target.text, strlen(target.text),
				     write, entry);
	if (target.means == MEANS_VALUE && (target.type != IEC_BOOL || target.array))
		return entry_wrong(entry, N_("“%s” is not a BOOL: compare it, as in Level > 5"),
				   target.text, strlen(target.text));
	if (target.means == MEANS_VALUE && write && !target.write)
		return entry_wrong(entry, N_("“%s” cannot be written"), target.text,
				   strlen(target.text));
	return keep_operand(entry, target.text, strlen(target.text));
}

static bool is_operator(const struct lex *lex)
{
	static const char *const signs[] = {
		":=", "<", ">", "=", "<=", ">=", "<>", "+", "-", "*", "&", "MOD", "AND",
		"OR", "XOR",
	};

	for (size_t i = 0; i < sizeof(signs) / sizeof(*signs); i++)
		if (lex_is(lex, signs[i]))
			return true;
	return false;
}

/* Does an operator follow the first operand, as in X := Y + 1? After a word, := belongs to
 * a parameter. After a type, := makes it an expression too: quick entry sets no initial
 * values. */
static bool is_expression(const char *text, size_t len)
{
	struct lex lex;
	int depth = 0;

	const size_t said = entry_said_len(text, len);

	lex_init(&lex, text + said, len - said);
	lex_next(&lex);
	if (said > 0)
		return lex.token.kind != TOKEN_END && is_operator(&lex);
	if (lex_is(&lex, "(") || lex_is(&lex, "NOT"))
		return lex_is(&lex, "(");
	do {
		depth += lex_is(&lex, "[") - lex_is(&lex, "]");
		lex_next(&lex);
	} while (lex.token.kind != TOKEN_END &&
		 (depth > 0 || (!lex.token.space_before && !is_operator(&lex))));
	return lex.token.kind != TOKEN_END && is_operator(&lex);
}

/* ---- parameters of a box: by name, or in their order ---- */

struct value {
	const char *name;    /* of the pin; name_len 0: given by position       */
	size_t name_len;
	bool output, inverse;
	const char *text;    /* with its declaration, if it is a new name       */
	size_t len;
};

/* A value takes at least two bytes of the line. */
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

/* The end of a value: `-5`, `Table[i].X`, `T#5s`, `'text'`, `New AT %MW4`. */
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

static bool add_value(const struct entry_place *place, const struct entry_fit *fit,
		      const struct value *value, struct entry *entry)
{
	struct entry_target target;
	char number[8] = "";
	bool fits;

	if (fit->write && value->inverse)
		return entry_wrong(entry, N_("“%s” cannot be written"), value->text,
				   value->len);
	if ((fit->write || value->inverse) &&
	    entry_literal(value->text, value->len, number, sizeof(number), &fits))
		return entry_wrong(entry, fit->write ? N_("“%s” cannot be written") :
				   N_("“%s” is not an operand"), value->text, value->len);
	if (value->inverse && !entry_append(entry->args, sizeof(entry->args), "/", 1))
		return entry_wrong(entry, too_long, "", 0);
	if (entry_literal(value->text, value->len, entry->args, sizeof(entry->args), &fits))
		return fits || entry_wrong(entry, too_long, "", 0);
	if (!entry_operand(place, value->text, value->len, fit, &target, entry))
		return false;
	if (fit->write && target.means == MEANS_VALUE && !target.write)
		return entry_wrong(entry, N_("“%s” cannot be written"), value->text,
				   value->len);
	return entry_append(entry->args, sizeof(entry->args), target.text,
			    strlen(target.text)) ||
	       entry_wrong(entry, too_long, "", 0);
}

static bool add_pin(const struct entry_place *place, const struct entry_fit *fit,
		    const char *name, const struct value *value, struct entry *entry)
{
	char head[ENTRY_NAME];
	struct arg arg;

	if (args_find(entry->args, name, strlen(name), &arg))
		return entry_wrong(entry, N_("“%s” is given twice"), name,
				   strlen(name));
	snprintf(head, sizeof(head), "%s%.250s%s", entry->args[0] ? " " : "", name,
		 fit->write ? "=>" : ":=");
	return (entry_append(entry->args, sizeof(entry->args), head, strlen(head)) ||
		entry_wrong(entry, too_long, "", 0)) &&
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
		return entry_wrong(entry, N_("“%s” is not a pin of this box"), value->name,
				   value->name_len);
	upper(value->name, value->name_len, spelled, sizeof(spelled));
	if (pin && (row->kind != WORD_FN || index < row->pin_count))
		snprintf(spelled, sizeof(spelled), "%s", pin->name);
	fit = pin ? entry_fit_pin(row, pin, shared, value->output) :
		    entry_fit_result(row, shared);
	fit.write = value->output;
	return add_pin(place, &fit, spelled, value, entry);
}

/* Name of input @index of a function; past the named pins: IN3 after IN2. */
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

/* The last value of a function is its result, unless the result is its power. */
static bool add_inputs(const struct entry_place *place, const struct word_row *row,
		       const struct value *value, int count, enum iec_type shared,
		       struct entry *entry)
{
	const bool out = count > 1 && !word_is_test(row);
	const int inputs = out ? count - 1 : count;
	const struct entry_fit result = entry_fit_result(row, shared);
	char name[LIMIT_NAME + 1];

	if (row->pin_count == 0 || inputs > row->most_inputs)
		return entry_wrong(entry, N_("there are more values than inputs of the box"), "", 0);
	for (int i = 0; i < inputs; i++) {
		const struct entry_fit fit = entry_fit_pin(row, pin_of(row, i), shared,
							   false);

		input_name(row, i, name, sizeof(name));
		if (!add_pin(place, &fit, name, &value[i], entry))
			return false;
	}
	return !out || add_pin(place, &result, "OUT", &value[inputs], entry);
}

/* Values of a block by position: its inputs that are not BOOL. */
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
	       entry_wrong(entry, N_("there are more values than inputs of the box"), "", 0);
}

/* Default values of a timer or counter, if the line has none. */
static bool add_first_values(const struct word_row *row, struct entry *entry)
{
	const bool counts = !strcmp(explain_family(row), "Counters");

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

/* Does its pin have a type that does not depend on other pins? */
static bool is_alone(const struct word_row *row, const struct value *value, int number)
{
	const int index = value->name_len ? word_pin_find(row, value->name,
							  value->name_len) : number;

	return index >= 0 && row->pin_count > 0 &&
	       (pin_of(row, index)->own || pin_of(row, index)->type != IEC_NONE);
}

/* The type of a value; IEC_NONE: unknown, and @guessed gets a possible type. */
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

/* The type that the inputs of a function share: that of the first known value. */
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
			return entry_wrong(entry, too_long, "", 0);
		if (!next_value(&lex, value))
			return entry_wrong(entry, value->name_len ? N_("“%s” needs a value") :
					   N_("a value is missing"), value->name,
					   value->name_len);
		out->count++;
	}
	return true;
}

/* Adds named values first, then the others by position. */
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

/* Reads values into @entry->args; a timer or counter without any gets defaults. Types are
 * left to the checks of the engine. */
static bool read_args(const struct entry_place *place, const struct word_row *row,
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

/* ---- words ---- */

static bool take_name(const char *text, size_t len, struct entry *entry)
{
	struct lex lex;

	lex_init(&lex, text, len);
	if (lex_next(&lex) != TOKEN_NAME || lex.token.len != len ||
	    memchr(text, '.', len) || len > LIMIT_NAME)
		return entry_wrong(entry, N_("“%s” is not a name"), text, len);
	return keep_operand(entry, text, len);
}

/* Bytes of / ! or NOT before an operand. */
static size_t inverts(const char *text, size_t len)
{
	if (len > 0 && (*text == '/' || *text == '!'))
		return 1;
	return len > 4 && ascii_is("NOT", text, 3) && text[3] == ' ' ? 3 : 0;
}

static bool take_bool_of(const struct entry_place *place, const struct word_row *row,
			 const char *text, size_t len, struct entry *entry)
{
	const size_t sign = inverts(text, len);

	if (sign > 0) {
		entry->word = grid_word_negated(entry->word);
		text += sign;
		len -= sign;
		trim(&text, &len);
	}
	return take_bool(place, text, len, row->operand == OPND_BOOL_W, entry);
}

static bool take_element(const struct entry_place *place, const struct word_row *row,
			 const char *text, size_t len, struct entry *entry)
{
	struct loop loop;

	switch (row->operand) {
	case OPND_BOOL_R:
		if (row->edge == EDGE_NONE && !row->negate && is_expression(text, len))
			return entry_expression(place, text, len, entry);
		return take_bool_of(place, row, text, len, entry);
	case OPND_BOOL_W:
		return take_bool_of(place, row, text, len, entry);
	case OPND_LABEL:
	case OPND_ROUTINE:
	case OPND_EXECUTE:
		return take_name(text, len, entry);
	case OPND_LOOP:
		if (!loop_parse(text, len, &loop))
			return entry_wrong(entry, N_("“%s” is not a loop: write FOR I := 1 TO 10"), text,
					   len);
		return keep_operand(entry, text, len);
	case OPND_EXPR:
	case OPND_ASSIGN:
		return entry_expression(place, text, len, entry);
	case OPND_NONE:
	case OPND_LOOP_END:
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_INSTANCE:
	case OPND_PIN:
		break;
	}
	return entry_wrong(entry, N_("“%s” is not expected: this word has no operand"), text, len);
}

static bool takes_nothing(const struct word_row *row)
{
	return row->kind == WORD_ELEM &&
	       (row->operand == OPND_NONE || row->operand == OPND_LOOP_END ||
		row->operand == OPND_EXECUTE);
}

/* The length of the name of an instance, with its index; 0: a parameter or a value follows. */
static size_t instance_len(const char *text)
{
	struct lex lex;
	size_t len;

	lex_init(&lex, text, strlen(text));
	if (lex_next(&lex) != TOKEN_NAME || memchr(lex.token.text, '.', lex.token.len))
		return 0;
	len = (size_t)(lex.token.text - text) + lex.token.len;
	lex_next(&lex);
	if (lex_is(&lex, ":=") || lex_is(&lex, "=>"))
		return 0;
	if (text[len] == '[') {
		const char *stop = strchr(text + len, ']');

		len = stop ? (size_t)(stop - text) + 1 : len;
	}
	return len;
}

static bool take_block(const struct entry_place *place, const struct word_row *row,
		       const char *text, struct entry *entry)
{
	size_t len = instance_len(text);
	struct entry_target target;
	char fresh[ENTRY_NAME];

	if (len == 0) {
		entry_fresh_name(place, entry, entry_family_base(row), fresh,
				 sizeof(fresh));
		return entry_declare(place, entry, fresh, strlen(fresh), row->word, "") &&
		       keep_operand(entry, fresh, strlen(fresh)) &&
		       read_args(place, row, text, entry);
	}
	entry_target_find(place, text, len, &target);
	if (target.means == MEANS_NEW) {
		if (!entry_declare(place, entry, text, len, row->word, ""))
			return false;
	} else if (target.means != MEANS_INSTANCE || target.array ||
		   target.word != entry->word) {
		return entry_wrong(entry, target.why ? target.why :
				   N_("“%s” is not an instance of this block"), text, len);
	}
	return keep_operand(entry, target.text, strlen(target.text)) &&
	       read_args(place, row, text + len, entry);
}

static bool take_word(const struct entry_place *place, enum word word, const char *text,
		      size_t len, struct entry *entry)
{
	const struct word_row *row = words_row(&place->project->words, word);

	entry->word = word;
	if (place->output && row->place == PLACE_SERIES)
		return entry_wrong(entry, N_("“%s” cannot stand in the last column: only an output can"),
				   row->word, strlen(row->word));
	if (row->kind == WORD_FB)
		return take_block(place, row, text, entry) &&
		       (entry->sense = ENTRY_ELEMENT);
	if (row->kind == WORD_FN)
		return read_args(place, row, text, entry) &&
		       (entry->sense = ENTRY_ELEMENT);
	if (len == 0 && !takes_nothing(row)) {
		entry->sense = ENTRY_PART;
		return false;
	}
	if (len == 0) {
		entry->sense = ENTRY_ELEMENT;
		return true;
	}
	return take_element(place, row, text, len, entry);
}

/* A plain name: a contact, or a coil in the last column. */
static bool take_symbol(const struct entry_place *place, const char *text, size_t len,
			struct entry *entry)
{
	const bool negated = *text == '/' || *text == '!';

	entry->word = place->output ? ELEM_COIL : ELEM_CONTACT_NO;
	if (negated) {
		entry->word = grid_word_negated(entry->word);
		text++;
		len--;
		trim(&text, &len);
	}
	if (len == 0) {
		entry->sense = ENTRY_PART;
		return false;
	}
	return take_bool(place, text, len, place->output, entry);
}

/* ---- which of them ---- */

static bool is_there(const struct entry_place *place, const char *text, size_t len)
{
	struct entry_target target;

	entry_target_find(place, text, len, &target);
	return target.means == MEANS_VALUE || target.means == MEANS_INSTANCE;
}

static size_t head_len(const char *text, size_t len)
{
	size_t head = 0;

	if (len > 1 && text[0] == '=' && text[1] != '>')
		return 1;
	while (head < len && !is_blank(text[head]))
		head++;
	return head;
}

/* `Stop` is a push button, `STOP` the word that ends the program: a word without operand
 * counts only in capitals, as in the catalogue; so does RETURN. */
static bool is_name_rather(const struct entry_place *place, enum word word, const char *text,
			   size_t len)
{
	const struct word_row *row = words_row(&place->project->words, word);

	return row->place == PLACE_LAST && row->operand == OPND_NONE &&
	       ((ascii_is(row->word, text, len) && strncmp(row->word, text, len) != 0) ||
		(ascii_is("RETURN", text, len) && strncmp("RETURN", text, len) != 0));
}

static bool read_line(const struct entry_place *place, const char *text, size_t len,
		      struct entry *out)
{
	const size_t head = head_len(text, len), glyph = entry_glyph(text, &out->word);
	const char *rest = text + head;
	size_t rest_len = len - head;
	enum word word;

	if (glyph)
		return take_word(place, out->word, text + glyph, len - glyph, out);
	if (text[0] == '[')
		return entry_expression(place, text + 1,
					len - (text[len - 1] == ']' ? 2 : 1), out);
	if (text[0] == '/' || text[0] == '!')
		return take_symbol(place, text, len, out);
	trim(&rest, &rest_len);
	if (is_expression(text, len))
		return entry_expression(place, text, len, out);
	if (entry_declared_len(text, len, ENTRY_WORD_POSSIBLE))
		return take_symbol(place, text, len, out);
	if (rest_len == 0 && is_there(place, text, len))
		return take_symbol(place, text, len, out);
	word = entry_word_find(place, text, head, &out->below);
	if (word != WORD_COUNT && rest_len == 0 && is_name_rather(place, word, text, len)) {
		if (take_symbol(place, text, len, out))
			return true;
		*out = (struct entry){ .below = out->below }; /* it cannot be a name */
	}
	/* AND IN1:=A is the function, AND A the contact. */
	if (out->below || word < ELEM_PIN) {
		struct lex lex;

		lex_init(&lex, rest, rest_len);
		lex_next(&lex);
		lex_next(&lex);
		if (lex_is(&lex, ":=") || lex_is(&lex, "=>")) {
			enum word other = words_find(&place->project->words, text, head);

			if (words_row(&place->project->words, other)->kind == WORD_FN) {
				word = other;
				out->below = false;
			}
		}
	}
	if (word != WORD_COUNT && word != ELEM_WIRE && word != ELEM_PIN)
		return take_word(place, word, rest, rest_len, out);
	if (rest_len > 0 && !entry_declared_len(text, len, ENTRY_WORD_GIVEN))
		return entry_wrong(out, N_("“%s” is not the word of an element or block"), text, head);
	return take_symbol(place, text, len, out);
}

typedef bool reading(const struct entry_place *place, const char *text, size_t len,
		     struct entry *out);

static bool read_with(reading *read, const struct entry_place *place, const char *line,
		      struct entry *out)
{
	char copy[ENTRY_TEXT];
	const char *text = line;
	size_t len = strlen(line);

	memset(out, 0, sizeof(*out));
	out->word = WORD_COUNT;
	trim(&text, &len);
	if (len == 0)
		return false;
	if (len >= sizeof(copy))
		return entry_wrong(out, too_long, "", 0);
	memcpy(copy, text, len);
	copy[len] = '\0';
	if (!utf8_valid(copy, len, NULL))
		return entry_wrong(out, N_("the line is not valid UTF-8"), "", 0);
	if (read(place, copy, len, out))
		return true;
	entry_blame_address(place, out);
	out->declares = 0;
	return false;
}

bool entry_read(const struct entry_place *place, const char *line, struct entry *out)
{
	return read_with(read_line, place, line, out);
}

static bool read_condition(const struct entry_place *place, const char *text, size_t len,
			   struct entry *out)
{
	return entry_expression(place, text, len, out) &&
	       (out->word == ELEM_COMPARE ||
		entry_wrong(out, N_("“%s” is not a valid expression"), text, len));
}

bool entry_condition(const struct entry_place *place, const char *line, struct entry *out)
{
	return read_with(read_condition, place, line, out);
}

static bool intern(struct project *project, const char *text, uint32_t *id)
{
	*id = names_intern(&project->names, text, strlen(text));
	return *id || !text[0];
}

bool entry_cell(struct project *project, const struct entry *entry, struct cell *cell)
{
	/* A new EXECUTE box has one empty statement, beside which there is room for others. */
	const char *args = entry->word == ELEM_EXECUTE ? "  ;\n" : entry->args;

	*cell = (struct cell){ .word = (uint16_t)entry->word };
	return entry->sense == ENTRY_ELEMENT &&
	       intern(project, entry->operand, &cell->operand) &&
	       intern(project, args, &cell->args);
}
