/* SPDX-License-Identifier: MIT
 *
 * rung_clip_line - a line of mnemonics, of any dialect, as the row of a rung.
 *
 *   XIC Start XIO Stop OTE Motor     | NO Start | NC Stop | COIL Motor |
 *
 * Each element is read as one that is typed at the cursor. Nothing is declared: where a
 * name lies is not to be guessed for several at once.
 */
#include "editor-gtk/rung_clip_line.h"

#include "editor-gtk/entry.h"

#include <string.h>

struct line {
	struct entry_place place;
	struct entry *entry;
	GString *row;
};

/* An element whose operand is missing. */
static bool is_begun(const struct line *line, const char *text)
{
	entry_read(&line->place, text, line->entry);
	return line->entry->sense == ENTRY_PART;
}

/* A word whose operand follows; of a block that may be missing, too. */
static bool is_word(const struct line *line, const char *text)
{
	if (words_find(&line->place.project->words, text, strlen(text)) != WORD_COUNT)
		return true;
	return is_begun(line, text);
}

static bool add(struct line *line, const char *text)
{
	const struct entry *entry = line->entry;
	const struct word_row *row;

	if (!entry_read(&line->place, text, line->entry) || entry->below)
		return false;
	row = words_row(&line->place.project->words, entry->word);
	if (row->operand == OPND_EXPR || row->operand == OPND_ASSIGN ||
	    row->operand == OPND_LOOP)
		return false;
	g_string_append_printf(line->row, " %s%s%s%s%s |", row->word,
			       entry->operand[0] ? " " : "", entry->operand,
			       entry->args[0] ? " " : "", entry->args);
	return true;
}

/* From each word up to the next one; its operand may be called as one: Stop. */
static bool add_all(struct line *line, char *const *part)
{
	bool good = part[0] && is_word(line, part[0]);

	while (good && part[0]) {
		GString *one = g_string_new(*part++);

		while (part[0] && (is_begun(line, one->str) || !is_word(line, part[0])))
			g_string_append_printf(one, " %s", *part++);
		good = add(line, one->str);
		g_string_free(one, TRUE);
	}
	return good;
}

static char **words_of(const char *text)
{
	GStrvBuilder *words = g_strv_builder_new();
	char **part = g_strsplit_set(text, " \t", -1), **found;

	for (char **at = part; *at; at++)
		if (**at)
			g_strv_builder_add(words, *at);
	found = g_strv_builder_end(words);
	g_strv_builder_unref(words);
	g_strfreev(part);
	return found;
}

char *rung_clip_line(LadderDocument *document, int pou, const char *text)
{
	struct line line = { .place = { .project = ladder_document_project(document),
					.pou = pou } };
	char *clean = g_strstrip(g_strdup(text)), **part;
	struct xref xref;
	bool good;

	if (strlen(clean) >= ENTRY_TEXT || strpbrk(clean, "\r\n")) {
		g_free(clean);
		return NULL;
	}
	if (!xref_make(&xref, line.place.project))
		g_error("out of memory");
	line.place.xref = &xref;
	line.entry = g_new0(struct entry, 1);
	line.row = g_string_new("RUNG\n|");
	part = words_of(clean);
	good = add_all(&line, part);
	g_strfreev(part);
	g_free(line.entry);
	g_free(clean);
	xref_free(&xref);
	return g_string_free(line.row, !good);
}
