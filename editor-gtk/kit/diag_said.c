/* SPDX-License-Identifier: MIT
 *
 * diag_said - a diagnostic of the engine in the language of the session.
 *
 * An argument is mostly a name of the user and must not be translated even if the engine has
 * the same word, such as `index`. In sentences of the engine round such names
 * (diag_args.def) the sentence is translated and the names stay.
 */
#include "editor-gtk/kit/diag_said.h"

#include "editor-gtk/kit/i18n.h"

#include <glib.h>
#include <string.h>

#define PARTS_MOST 3 /* names in one sentence                                  */

struct sentence { enum diag_id id; const char *text; };
static const struct sentence sentences[] = {
#define SENTENCE(id, text) { DIAG_##id, text },
#include "editor-gtk/kit/diag_args.def"
};

/* A name within an argument. */
struct part { const char *text; int len; };

const char *diag_said(const struct diag *diag)
{
	return said(diag_text(diag->id));
}

/* Up to the next name of a sentence, or its end. */
static size_t plain_length(const char *sentence)
{
	const char *name = strstr(sentence, "%s");

	return name ? (size_t)(name - sentence) : strlen(sentence);
}

/* Where the text @plain of that length stands in @arg; behind the last name it must be
 * the end. NULL: nowhere. */
static const char *find_plain(const char *arg, const char *plain, size_t len, bool last)
{
	const size_t size = strlen(arg);

	if (last)
		return size > len && memcmp(arg + size - len, plain, len) == 0 ?
		       arg + size - len : NULL;
	return size > 1 ? g_strstr_len(arg + 1, -1, plain) : NULL;
}

/* Is @arg such a sentence? Its names; no name is empty. */
static bool is_sentence(const char *arg, const char *sentence, struct part *part)
{
	size_t len = plain_length(sentence);

	if (strncmp(arg, sentence, len) != 0)
		return false;
	arg += len;
	sentence += len;
	for (int i = 0; *sentence; i++) {
		char *plain;
		const char *found;

		sentence += strlen("%s");
		len = plain_length(sentence);
		plain = g_strndup(sentence, len);
		found = find_plain(arg, plain, len, sentence[len] == '\0');
		g_free(plain);
		if (!found || i == PARTS_MOST)
			return false;
		part[i] = (struct part){ arg, (int)(found - arg) };
		arg = found + len;
		sentence += len;
	}
	return *arg == '\0';
}

/* Names are counted, %2$s, where a language needs another order. */
static char *filled(const char *sentence, const struct part *part)
{
	GString *out = g_string_new(NULL);
	int next = 0;

	for (; *sentence; sentence++) {
		int which = next;

		if (*sentence != '%') {
			g_string_append_c(out, *sentence);
			continue;
		}
		if (g_ascii_isdigit(sentence[1])) {
			which = sentence[1] - '1';
			sentence += strlen("1$");
		}
		sentence++;
		next++;
		if (which >= 0 && which < PARTS_MOST)
			g_string_append_len(out, part[which].text, part[which].len);
	}
	return g_string_free(out, FALSE);
}

char *diag_said_arg(const struct diag *diag)
{
	const bool ours = diag->id == DIAG_EXPECTED || diag->id == DIAG_TOO_MANY ||
			  strchr(diag->arg, ' ');
	const char *text = ours ? said(diag->arg) : diag->arg;
	struct part part[PARTS_MOST] = { { "", 0 }, { "", 0 }, { "", 0 } };

	for (gsize i = 0; text == diag->arg && i < G_N_ELEMENTS(sentences); i++)
		if (sentences[i].id == diag->id &&
		    is_sentence(diag->arg, sentences[i].text, part))
			return filled(_(sentences[i].text), part);
	return g_strdup(text);
}

char *diag_said_whole(const struct diag *diag)
{
	char *arg = diag_said_arg(diag);
	char *whole = g_strdup_printf("%s%s%s", diag_said(diag), arg[0] ? ": " : "", arg);

	g_free(arg);
	return whole;
}

/* "pump.rung:14:3: ". */
static void add_file(GString *line, const struct diag *diag)
{
	if (!diag->file)
		return;
	g_string_append_printf(line, "%s:", diag->file);
	if (diag->line > 0)
		g_string_append_printf(line, "%d:", diag->line);
	if (diag->line > 0 && diag->column > 0)
		g_string_append_printf(line, "%d:", diag->column);
	g_string_append_c(line, ' ');
}

static void add_rung(GString *line, const struct diag *diag)
{
	if (diag->line <= 0 && diag->pou)
		g_string_append_printf(line, "%s: ", diag->pou);
	if (diag->rung > 0 && diag->row > 0)
		g_string_append_printf(line, _("rung %d (%d,%d): "), diag->rung, diag->row,
				       diag->col);
	else if (diag->rung > 0)
		g_string_append_printf(line, _("rung %d: "), diag->rung);
}

char *diag_said_line(const struct diag *diag)
{
	GString *line = g_string_new(NULL);
	char *whole = diag_said_whole(diag);

	add_file(line, diag);
	add_rung(line, diag);
	g_string_append_printf(line, "%s %s: %s", diag_severity(diag->id) == SEVERITY_ERROR ?
			       _("error") : _("warning"), diag_code(diag->id), whole);
	g_free(whole);
	return g_string_free(line, FALSE);
}
