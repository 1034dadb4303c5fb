/* SPDX-License-Identifier: MIT
 *
 * entry_args - the parameters of a box as a person types them: by name, or in their
 * order, and what a fresh timer begins with.
 *
 * It makes the canonical text; what does not fit a pin's type the checks will say.
 */
#include "editor-gtk/entry_inside.h"
#include "editor-gtk/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/literal.h"
#include "engine/model/args.h"

#include <stdio.h>
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

bool entry_declare(const struct entry_place *place, struct entry *entry, const char *name,
		   size_t len, const char *type, const char *address)
{
	struct entry_new *made;

	struct iec_addr addr;

	for (int i = 0; i < entry->declares; i++)
		if (ascii_is(entry->declare[i].name, name, len))
			return true;
	if (entry->declares == ENTRY_NEW_MOST)
		return entry_wrong(entry, N_("too many new names in one line"), name, len);
	made = &entry->declare[entry->declares++];
	snprintf(made->name, sizeof(made->name), "%.*s", (int)len, name);
	snprintf(made->type, sizeof(made->type), "%s", type);
	snprintf(made->address, sizeof(made->address), "%s", address);
	if (iec_addr_parse(address, strlen(address), &addr) == ADDR_OK)
		entry_shares(place, addr, made->shares, sizeof(made->shares));
	return true;
}

/* ---- one value ---- */

struct value {
	const char *text;
	size_t len;
	bool inverse;
};

/* The next value of the line: `/Ready`, `-5`, `Table[i].X`, `T#5s`, `'text'`. */
static bool next_value(struct lex *lex, struct value *out)
{
	const char *end;

	out->inverse = lex_accept(lex, "/");
	if (lex->token.kind == TOKEN_END)
		return false;
	out->text = lex->token.text;
	if (*out->text == '\'') {
		const char *stop = out->text + 1;

		while (stop < lex->end && *stop != '\'')
			stop += *stop == '$' && stop + 1 < lex->end ? 2 : 1;
		end = stop < lex->end ? stop + 1 : lex->end;
		lex->at = end;
		lex_next(lex);
	} else {
		int depth = 0;

		do {
			depth += lex_is(lex, "[") - lex_is(lex, "]");
			end = lex->token.text + lex->token.len;
			lex_next(lex);
		} while (lex->token.kind != TOKEN_END && !lex_is(lex, ",") &&
			 (depth > 0 || !lex->token.space_before));
	}
	out->len = (size_t)(end - out->text);
	lex_accept(lex, ",");
	return true;
}

static const struct word_pin *pin_of(const struct word_row *row, int index)
{
	return row->kind == WORD_FN ? word_input(row, (uint32_t)index) : &row->pin[index];
}

/* What a new variable at a pin is declared as. */
static const char *type_of(const struct word_pin *pin)
{
	if (pin && pin->type != IEC_NONE)
		return iec_type_row(pin->type)->word;
	if (pin && pin->classes && !(pin->classes & ~CLASS_REAL))
		return "REAL";
	if (pin && pin->classes && !(pin->classes & ~(CLASS_TIME)))
		return "TIME";
	if (pin && pin->classes == CLASS_BOOL)
		return "BOOL";
	if (pin && pin->classes == CLASS_STRING)
		return "STRING";
	return "INT";
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

static bool add_value(const struct entry_place *place, const struct word_pin *pin,
		      bool output, const struct value *value, struct entry *entry)
{
	struct entry_target target;
	char number[8] = "";
	bool fits;

	if (output && value->inverse)
		return entry_wrong(entry, N_("this cannot be written"), value->text,
				   value->len);
	if ((output || value->inverse) && add_literal(value, number, sizeof(number), &fits))
		return entry_wrong(entry, output ? N_("this cannot be written") :
				   N_("this is no operand"), value->text, value->len);
	if (value->inverse && !entry_append(entry->args, sizeof(entry->args), "/", 1))
		return entry_wrong(entry, N_("this line is too long"), "", 0);
	if (add_literal(value, entry->args, sizeof(entry->args), &fits))
		return fits || entry_wrong(entry, N_("this line is too long"), "", 0);
	entry_target_find(place, value->text, value->len, &target);
	if (target.means == MEANS_WRONG || target.means == MEANS_NOTHING)
		return entry_wrong(entry, target.why ? target.why :
				   N_("this is no value"), value->text, value->len);
	if (target.means == MEANS_NEW &&
	    !entry_declare(place, entry, value->text, value->len, type_of(pin), ""))
		return false;
	if (output && target.means == MEANS_VALUE && !target.write)
		return entry_wrong(entry, N_("this cannot be written"), value->text,
				   value->len);
	return entry_append(entry->args, sizeof(entry->args), target.text,
			    strlen(target.text)) ||
	       entry_wrong(entry, N_("this line is too long"), "", 0);
}

/* ---- parameters ---- */

static bool add_pin(const struct entry_place *place, const struct word_pin *pin,
		    const char *name, bool output, const struct value *value,
		    struct entry *entry)
{
	char head[ENTRY_NAME];
	struct arg arg;

	if (args_find(entry->args, name, strlen(name), &arg))
		return entry_wrong(entry, N_("this pin is given twice"), name,
				   strlen(name));
	snprintf(head, sizeof(head), "%s%.250s%s", entry->args[0] ? " " : "", name,
		 output ? "=>" : ":=");
	return (entry_append(entry->args, sizeof(entry->args), head, strlen(head)) ||
		entry_wrong(entry, N_("this line is too long"), "", 0)) &&
	       add_value(place, pin, output, value, entry);
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
		      const struct token *name, bool output, const struct value *value,
		      struct entry *entry)
{
	const int index = word_pin_find(row, name->text, name->len);
	const struct word_pin *pin = index >= 0 ? pin_of(row, index) : NULL;
	char spelled[LIMIT_NAME + 1];

	if (!pin && !is_out(row, name->text, name->len))
		return entry_wrong(entry, N_("the box has no such pin"), name->text,
				   name->len);
	upper(name->text, name->len, spelled, sizeof(spelled));
	if (pin && (row->kind != WORD_FN || index < row->pin_count))
		snprintf(spelled, sizeof(spelled), "%s", pin->name);
	return add_pin(place, pin, spelled, output, value, entry);
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

#define VALUES_MOST (LIMIT_FN_INPUTS + 1)

/* The last value of a function is where its result goes, unless power is its result. */
static bool add_inputs(const struct entry_place *place, const struct word_row *row,
		       const struct value *value, int count, struct entry *entry)
{
	const bool out = count > 1 && !word_is_test(row);
	const int inputs = out ? count - 1 : count;
	char name[LIMIT_NAME + 1];

	if (row->pin_count == 0 || inputs > row->most_inputs)
		return entry_wrong(entry, N_("the box has fewer inputs"), "", 0);
	for (int i = 0; i < inputs; i++) {
		input_name(row, i, name, sizeof(name));
		if (!add_pin(place, pin_of(row, i), name, false, &value[i], entry))
			return false;
	}
	return !out || add_pin(place, pin_of(row, 0), "OUT", true, &value[inputs], entry);
}

/* Those of a block that no row of power is drawn to: its inputs that are not BOOL. */
static bool add_block_inputs(const struct entry_place *place, const struct word_row *row,
			     const struct value *value, int count, struct entry *entry)
{
	int used = 0;

	for (int i = 0; i < row->pin_count && used < count; i++) {
		const struct word_pin *pin = &row->pin[i];

		if (pin->dir != PIN_IN || pin->type == IEC_BOOL)
			continue;
		if (!add_pin(place, pin, pin->name, false, &value[used++], entry))
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

bool entry_args(const struct entry_place *place, const struct word_row *row,
		const char *text, struct entry *entry)
{
	struct value value[VALUES_MOST];
	struct lex lex;
	int count = 0;

	lex_init(&lex, text, strlen(text));
	lex_next(&lex);
	lex_accept(&lex, ",");
	while (lex.token.kind != TOKEN_END) {
		const struct token name = lex.token;
		struct lex ahead = lex;
		struct value given;

		lex_next(&ahead);
		if (lex_is(&ahead, ":=") || lex_is(&ahead, "=>")) {
			const bool output = lex_is(&ahead, "=>");

			lex = ahead;
			lex_next(&lex);
			if (!next_value(&lex, &given))
				return entry_wrong(entry, N_("a value is missing"),
						   name.text, name.len);
			if (!add_named(place, row, &name, output, &given, entry))
				return false;
			continue;
		}
		if (count == VALUES_MOST || !next_value(&lex, &value[count]))
			return entry_wrong(entry, N_("a value is missing"), "", 0);
		count++;
	}
	if (count == 0)
		return entry->args[0] || row->kind != WORD_FB ||
		       add_first_values(row, entry);
	return row->kind == WORD_FN ? add_inputs(place, row, value, count, entry) :
				      add_block_inputs(place, row, value, count, entry);
}
