/* SPDX-License-Identifier: MIT
 *
 * rung_clip_line - lines of mnemonics, of any dialect, as rows of rungs.
 *
 *   XIC Start XIO Stop OTE Motor     | NO Start | NC Stop | COIL Motor |
 *
 * Each element is read as one that is typed at the cursor. Nothing is declared: where a
 * name lies is not to be guessed for several at once.
 */
#include "editor-gtk/document/rung_clip_line.h"

#include "editor-gtk/edit/entry.h"
#include "editor-gtk/document/entry_outcome.h"
#include "editor-gtk/kit/i18n.h"

#include <string.h>

#define TEXT_MOST 65536 /* bytes: more is no list of mnemonics                 */

struct typed {
	char *text;
	int line;       /* where it stands                                     */
};

struct line {
	LadderDocument *document;
	struct entry_place place;
	struct entry *entry;
	GStrvBuilder *rungs;
	GString *row;   /* of the rung that is being read; NULL: none          */
	bool ended;     /* by its output                                       */
	char *why;
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

static bool refuse(struct line *line, const char *text, const char *why)
{
	line->why = g_strdup_printf("%s: %s", why, text);
	return false;
}

static void end_rung(struct line *line)
{
	if (!line->row)
		return;
	g_strv_builder_add(line->rungs, line->row->str);
	g_string_free(line->row, TRUE);
	line->row = NULL;
}

static bool add(struct line *line, const char *text)
{
	const struct entry *entry = line->entry;
	const struct word_row *row;
	bool good, output;

	if (!entry_read(&line->place, text, line->entry)) {
		line->why = entry_outcome_tell(line->document, line->place.pou, entry, text,
					       &good);
		return false;
	}
	row = words_row(&line->place.project->words, entry->word);
	output = row->place == PLACE_LAST;
	if (entry->below || row->operand == OPND_EXPR || row->operand == OPND_ASSIGN ||
	    row->operand == OPND_LOOP || (output && line->ended))
		return refuse(line, text,
			      _("this can only be pasted as a row of a rung file"));
	if (line->ended)
		end_rung(line);
	if (!line->row)
		line->row = g_string_new("RUNG\n|");
	line->ended = output;
	g_string_append_printf(line->row, " %s%s%s%s%s |", row->word,
			       entry->operand[0] ? " " : "", entry->operand,
			       entry->args[0] ? " " : "", entry->args);
	return true;
}

/* @count words as one line. Caller: g_free. */
static char *joined(const struct typed *from, int count)
{
	GString *one = g_string_new(from->text);

	for (int i = 1; i < count; i++)
		g_string_append_printf(one, " %s", from[i].text);
	return g_string_free(one, FALSE);
}

/* How many belong to the word at @from: up to the next one, which begins every line; its
 * operand may be called as one: Stop. */
static int count_of(const struct line *line, const struct typed *from)
{
	GString *one = g_string_new(from->text);
	int count = 1;

	while (from[count].text && one->len < ENTRY_TEXT &&
	       (is_begun(line, one->str) || (from[count].line == from->line &&
					     !is_word(line, from[count].text))))
		g_string_append_printf(one, " %s", from[count++].text);
	g_string_free(one, TRUE);
	return count;
}

/* What is good without its last words has a word too many that is none. */
static bool refuse_last(struct line *line, const struct typed *from, int count)
{
	while (--count > 0) {
		char *less = joined(from, count);
		const bool good = entry_read(&line->place, less, line->entry);

		g_free(less);
		if (good) {
			g_free(line->why);
			return refuse(line, from[count].text, _("there is no such word"));
		}
	}
	return false;
}

static bool add_all(struct line *line, const struct typed *part, int *at)
{
	bool good = true;

	while (good && part->text) {
		const int count = count_of(line, part);
		char *one = joined(part, count);

		*at = part->line;
		good = is_word(line, part->text) ? add(line, one) :
			refuse(line, part->text, _("there is no such word"));
		if (!good && count > 1 && line->entry->sense == ENTRY_WRONG)
			refuse_last(line, part, count);
		part += count;
		g_free(one);
	}
	return good;
}

/* Words with a text of NULL behind them. */
static GArray *words_of(const char *text)
{
	GArray *words = g_array_new(TRUE, TRUE, sizeof(struct typed));
	int line = 1;

	while (*text) {
		const size_t len = strcspn(text, " \t\r\n");
		const struct typed part = { g_strndup(text, len), line };

		if (len > 0)
			g_array_append_val(words, part);
		else
			g_free(part.text);
		text += len;
		line += *text == '\n';
		text += *text != '\0';
	}
	return words;
}

static void part_clear(gpointer part)
{
	g_free(((struct typed *)part)->text);
}

char **rung_clip_lines(LadderDocument *document, int pou, const char *text, char **why,
		       int *at)
{
	struct line line = { .document = document,
			     .place = { .project = ladder_document_project(document),
					.pou = pou } };
	GArray *words = words_of(strlen(text) > TEXT_MOST ? "" : text);
	struct xref xref;
	char **rungs;
	bool good;

	g_array_set_clear_func(words, part_clear);
	if (!xref_make(&xref, line.place.project))
		g_error("out of memory");
	line.place.xref = &xref;
	line.entry = g_new0(struct entry, 1);
	line.rungs = g_strv_builder_new();
	good = add_all(&line, (const struct typed *)words->data, at);
	end_rung(&line);
	rungs = g_strv_builder_end(line.rungs);
	g_strv_builder_unref(line.rungs);
	g_free(line.entry);
	g_array_unref(words);
	xref_free(&xref);
	*why = line.why;
	if (good)
		return rungs;
	g_strfreev(rungs);
	return NULL;
}
