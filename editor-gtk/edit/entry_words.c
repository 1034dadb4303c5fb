/* SPDX-License-Identifier: MIT
 *
 * entry_words - which word a mnemonic or a drawn element means.
 *
 * Tables of other dialects, then the catalogue and the project's own words.
 */
#include "editor-gtk/edit/entry_inside.h"

#include "engine/base/ascii.h"

#include <string.h>

static const struct entry_mnemonic elements[] = {
#define MNEMONIC(text, id, below, dialect) { text, ELEM_##id, below, dialect },
#include "editor-gtk/edit/entry_words.def"
};

static const struct { const char *text, *word, *dialect; } functions[] = {
#define MNEMONIC(text, word, dialect) { text, word, dialect },
#include "editor-gtk/edit/entry_functions.def"
};

#define COUNT(table) ((int)(sizeof(table) / sizeof(*(table))))

const struct entry_mnemonic *entry_mnemonic(int index)
{
	return index >= 0 && index < COUNT(elements) ? &elements[index] : NULL;
}

static enum word find_element(const char *text, size_t len, bool *below)
{
	for (int i = 0; i < COUNT(elements); i++)
		if (ascii_is(elements[i].text, text, len)) {
			*below = elements[i].below;
			return elements[i].word;
		}
	return WORD_COUNT;
}

enum word entry_word_find(const struct entry_place *place, const char *text, size_t len,
			  bool *below)
{
	enum word word = find_element(text, len, below);

	if (word != WORD_COUNT)
		return word;
	*below = false;
	for (int i = 0; i < COUNT(functions); i++)
		if (ascii_is(functions[i].text, text, len))
			return word_find(functions[i].word, strlen(functions[i].word));
	word = words_find(&place->project->words, text, len);
	if (word == WORD_COUNT || word == ELEM_EMPTY ||
	    words_row(&place->project->words, word)->kind == WORD_STRUCT)
		return WORD_COUNT;
	return word;
}

/* A glyph without its blanks: "||" for "| |". */
static size_t match(const char *glyph, const char *text)
{
	size_t n = strlen(glyph);
	char tight[4] = "";
	size_t len = 0;

	if (!strncmp(text, glyph, n))
		return n;
	for (size_t i = 0; i < n && i < 3; i++)
		if (glyph[i] != ' ')
			tight[len++] = glyph[i];
	return len > 1 && !strncmp(text, tight, len) ? len : 0;
}

static size_t dashes(const char *text)
{
	return strspn(text, "- ");
}

size_t entry_glyph(const char *line, enum word *word)
{
	const size_t before = dashes(line);

	if (line[before] != '|' && line[before] != '(')
		return 0;
	for (int i = 0; i < WORD_KNOWN; i++) {
		const struct word_row *row = word_row((enum word)i);
		size_t len;

		if (row->kind != WORD_ELEM || (row->operand != OPND_BOOL_R &&
					       row->operand != OPND_BOOL_W))
			continue;
		len = match(row->glyph, line + before);
		if (len == 0)
			continue;
		*word = (enum word)i;
		return before + len + dashes(line + before + len);
	}
	return 0;
}
