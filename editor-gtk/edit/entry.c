/* SPDX-License-Identifier: MIT
 *
 * entry - what a line of quick entry means.
 *
 * An expression, a drawn element, a mnemonic with its operand, or just a name: in this
 * order. A name that is declared wins over a mnemonic that stands alone, and so does one
 * that AT or a colon stands behind.
 */
#include "editor-gtk/edit/entry_inside.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/model/loop.h"

#include <stdio.h>
#include <string.h>

static const char too_long[] = N_("this line is too long");

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
		return entry_wrong(entry, N_("this is no BOOL"), text, len);
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
		return entry_wrong(entry, N_("this is no BOOL: compare it, as in Level > 5"),
				   target.text, strlen(target.text));
	if (target.means == MEANS_VALUE && write && !target.write)
		return entry_wrong(entry, N_("this cannot be written"), target.text,
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

/* Does an operator stand behind the first operand of the line, as in X := Y + 1? A word
 * with parameters has := further on. Behind a type, too, := is one: a line of quick entry
 * gives no initial values. */
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

/* ---- words ---- */

static bool take_name(const char *text, size_t len, struct entry *entry)
{
	struct lex lex;

	lex_init(&lex, text, len);
	if (lex_next(&lex) != TOKEN_NAME || lex.token.len != len ||
	    memchr(text, '.', len) || len > LIMIT_NAME)
		return entry_wrong(entry, N_("this is no name"), text, len);
	return keep_operand(entry, text, len);
}

/* With a / or ! before it the opposite. */
static bool take_bool_of(const struct entry_place *place, const struct word_row *row,
			 const char *text, size_t len, struct entry *entry)
{
	if (*text == '/' || *text == '!') {
		entry->word = grid_word_negated(entry->word);
		text++;
		len--;
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
		return take_name(text, len, entry);
	case OPND_LOOP:
		if (!loop_parse(text, len, &loop))
			return entry_wrong(entry, N_("a loop is: FOR I := 1 TO 10"), text,
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
	return entry_wrong(entry, N_("nothing stands behind this word"), text, len);
}

static bool takes_nothing(const struct word_row *row)
{
	return row->kind == WORD_ELEM &&
	       (row->operand == OPND_NONE || row->operand == OPND_LOOP_END);
}

/* Does the line go on with the name of an instance, rather than with a parameter or a
 * value? Gives its bytes, an index with it. */
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
		       entry_args(place, row, text, entry);
	}
	entry_target_find(place, text, len, &target);
	if (target.means == MEANS_NEW) {
		if (!entry_declare(place, entry, text, len, row->word, ""))
			return false;
	} else if (target.means != MEANS_INSTANCE || target.array ||
		   target.word != entry->word) {
		return entry_wrong(entry, target.why ? target.why :
				   N_("this is no instance of that block"), text, len);
	}
	return keep_operand(entry, target.text, strlen(target.text)) &&
	       entry_args(place, row, text + len, entry);
}

static bool take_word(const struct entry_place *place, enum word word, const char *text,
		      size_t len, struct entry *entry)
{
	const struct word_row *row = words_row(&place->project->words, word);

	entry->word = word;
	if (place->output && row->place == PLACE_SERIES)
		return entry_wrong(entry, N_("only an output can stand in the last column"),
				   row->word, strlen(row->word));
	if (row->kind == WORD_FB)
		return take_block(place, row, text, entry) &&
		       (entry->sense = ENTRY_ELEMENT);
	if (row->kind == WORD_FN)
		return entry_args(place, row, text, entry) &&
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

/* Just a name: a contact, or a coil in the last column. */
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

/* `Stop` is a push button before it is what ends the program for good: a word alone that
 * has no operand is meant if it is written as it is listed, STOP. */
static bool is_name_rather(const struct entry_place *place, enum word word, const char *text,
			   size_t len)
{
	const struct word_row *row = words_row(&place->project->words, word);

	return row->place == PLACE_LAST && row->operand == OPND_NONE &&
	       ascii_is(row->word, text, len) && strncmp(row->word, text, len) != 0;
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
		*out = (struct entry){ .below = out->below }; /* it can be no name */
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
		return entry_wrong(out, N_("there is no such word"), text, head);
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
		return entry_wrong(out, N_("this is not UTF-8"), "", 0);
	if (read(place, copy, len, out))
		return true;
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
		entry_wrong(out, N_("this is no expression"), text, len));
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
	*cell = (struct cell){ .word = (uint16_t)entry->word };
	return entry->sense == ENTRY_ELEMENT &&
	       intern(project, entry->operand, &cell->operand) &&
	       intern(project, entry->args, &cell->args);
}
