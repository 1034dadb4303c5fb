/* SPDX-License-Identifier: MIT
 *
 * entry_want - what could stand at the word before the cursor of a line.
 *
 * It looks at what stands before that word, and offers nothing itself.
 */
#include "editor-gtk/edit/entry_search.h"

#include "engine/base/ascii.h"

#include <string.h>

bool entry_is_part(char c)
{
	return (c >= '0' && c <= '9') || ascii_upper(c) != c || (c >= 'A' && c <= 'Z') ||
	       c == '_' || c == '%' || c == '.' || (c & 0x80);
}

static void want_operand(struct search *s)
{
	switch (s->row->operand) {
	case OPND_BOOL_R:
		s->want = WANT_BOOL | WANT_NEW;
		return;
	case OPND_BOOL_W:
		s->want = WANT_BOOL | WANT_NEW;
		s->write = true;
		return;
	case OPND_LABEL:
		s->want = WANT_LABEL;
		return;
	case OPND_ROUTINE:
		s->want = WANT_ROUTINE;
		return;
	case OPND_EXPR:
	case OPND_ASSIGN:
		s->want = WANT_ANY | WANT_FUNCTION;
		return;
	case OPND_LOOP:
	case OPND_ANY_R:
	case OPND_ANY_W:
		s->want = WANT_ANY;
		return;
	case OPND_NONE:
	case OPND_LOOP_END:
	case OPND_INSTANCE:
	case OPND_PIN:
		return;
	}
}

/* Behind `PT:=`: what fits that pin. */
static void want_value(struct search *s, const char *rest, size_t len)
{
	size_t from;
	int pin;

	while (len > 0 && strchr(":=>/ ", rest[len - 1]))
		len--;
	for (from = len; from > 0 && entry_is_part(rest[from - 1]); from--)
		;
	pin = word_pin_find(s->row, rest + from, len - from);
	s->want = WANT_ANY;
	if (pin < 0)
		return;
	s->classes = entry_fit_pin(s->row, s->row->kind == WORD_FN ?
				   word_input(s->row, (uint32_t)pin) : &s->row->pin[pin],
				   IEC_NONE, false).classes;
}

/* Behind a word: its operand, its instance, its parameters. */
static void want_behind(struct search *s, const char *rest, size_t len)
{
	size_t end = len;

	if (s->row->kind == WORD_ELEM) {
		want_operand(s);
		return;
	}
	while (end > 0 && rest[end - 1] == ' ')
		end--;
	if (end > 0 && strchr("=>/", rest[end - 1])) {
		want_value(s, rest, end);
		return;
	}
	s->want = WANT_PIN_NAME;
	if (s->row->kind == WORD_FN)
		s->want |= WANT_ANY;
	else if (end == 0)
		s->want |= WANT_INSTANCE;
	else
		s->want |= WANT_ANY;
}

/* In an expression: what goes with its first operand. */
static void want_operand_like(struct search *s, const char *text)
{
	struct entry_target target;
	size_t len = 0;

	while (entry_is_part(text[len]))
		len++;
	s->want = WANT_ANY | WANT_FUNCTION;
	s->write = false;
	entry_target_find(s->place, text, len, &target);
	if (target.means == MEANS_VALUE)
		s->classes = entry_fit_type(target.type, false).classes;
}

void entry_find_want(struct search *s)
{
	const char *line = s->line;
	size_t at = strspn(line, " \t"), glyph = entry_glyph(line + at, &s->word);
	size_t end = at;
	bool below;

	s->word = glyph ? s->word : WORD_COUNT;
	if (glyph) {
		end = at + glyph;
	} else {
		while (end < s->from && line[end] != ' ' && line[end] != '[')
			end++;
		if (end == at || end == s->from)
			end = at;
		else
			s->word = entry_word_find(s->place, line + at, end - at, &below);
	}
	s->write = s->place->output;
	s->want = WANT_WORD | WANT_BOOL | WANT_NEW;
	if (s->word != WORD_COUNT && s->from >= end && end > at) {
		s->row = words_row(&s->place->project->words, s->word);
		s->want = 0;
		s->write = false;
		want_behind(s, line + end, s->from - end);
	} else if (s->from > at && line[at] != '/' && line[at] != '!') {
		want_operand_like(s, line + at + (line[at] == '['));
	}
}
