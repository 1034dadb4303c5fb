/* SPDX-License-Identifier: MIT
 *
 * text_mend - the change that a message asks for; see text_mend.h.
 */
#include "editor-gtk/text/text_mend.h"

#include "engine/base/name.h"

#include <string.h>

/* Part @number, from 0, of the message's argument; "": there is none. Caller frees. */
static char *part_of(const struct diag *diag, int number)
{
	char **parts = g_strsplit(diag->arg, DIAG_AND, -1);
	char *part = g_strdup(number < (int)g_strv_length(parts) ? parts[number] : "");

	g_strfreev(parts);
	return part;
}

static gboolean put(struct text_mend *out, gsize at, gsize len, char *with)
{
	*out = (struct text_mend){ at, len, with };
	return TRUE;
}

static gsize name_length(const char *at)
{
	gsize len = 0;

	while (g_ascii_isalnum(at[len]) || at[len] == '_' || (guchar)at[len] >= 0x80)
		len++;
	return len;
}

/* "A = 5": := in place of =. */
static gboolean mend_compares(const char *text, gsize at, struct text_mend *out)
{
	for (; text[at] && text[at] != '\n' && text[at] != ';'; at++)
		if (text[at] == '=')
			return put(out, at, 1, g_strdup(":="));
	return FALSE;
}

/* "ELSE IF": ELSIF. */
static gboolean mend_else_if(const char *text, gsize at, struct text_mend *out)
{
	gsize len;

	if (g_ascii_strncasecmp(text + at, "IF", 2) == 0) /* the message stands at the IF */
		for (; at > 0 && text[at - 1] != '\n'; at--)
			if (g_ascii_strncasecmp(text + at, "ELSE", 4) == 0)
				break;
	if (g_ascii_strncasecmp(text + at, "ELSE", 4) != 0)
		return FALSE;
	len = 4 + strspn(text + at + 4, " \t");
	return g_ascii_strncasecmp(text + at + len, "IF", 2) == 0 &&
	       put(out, at, len + 2, g_strdup("ELSIF"));
}

static gsize line_start(const char *text, gsize at)
{
	while (at > 0 && text[at - 1] != '\n')
		at--;
	return at;
}

static gboolean goes_on(const char *line)
{
	return g_ascii_strncasecmp(line, "ELSE", 4) == 0 || g_ascii_strncasecmp(line, "ELSIF", 5) == 0;
}

/* "IF is not closed; add END_IF": above the first line that is not further to the right. */
static gboolean mend_open(const char *text, gsize at, const char *end, struct text_mend *out)
{
	const gsize start = line_start(text, at), blanks = strspn(text + start, " \t");
	const char *line = strchr(text + at, '\n');

	if (!*end || strcmp(end, "END_REPEAT") == 0 || strchr(end, ' '))
		return FALSE;
	while (line && line[1]) {
		const gsize inside = strspn(line + 1, " \t");

		if (line[1 + inside] != '\n' && inside <= blanks && !goes_on(line + 1 + inside))
			return put(out, (gsize)(line + 1 - text), 0,
				   g_strdup_printf("%.*s%s;\n", (int)blanks, text + start, end));
		line = strchr(line + 1, '\n');
	}
	return FALSE;
}

/* "Mtor … did you mean Motor?" */
static gboolean mend_name(const char *text, gsize at, const char *name, const char *meant,
			  struct text_mend *out)
{
	const gsize len = strlen(name);

	return *meant && !strchr(meant, ',') && strlen(text + at) >= len &&
	       name_is(name, text + at, len) &&
	       put(out, at, len, g_strdup(meant));
}

gboolean text_mend_find(const char *text, gsize at, const struct diag *diag,
			struct text_mend *out)
{
	char *first = part_of(diag, 0), *second = part_of(diag, 1);
	gboolean found = FALSE;

	switch ((int)diag->id) {
	case DIAG_ST_SEMICOLON:
		found = put(out, at, 0, g_strdup(";"));
		break;
	case DIAG_ST_COMPARES:
		found = mend_compares(text, at, out);
		break;
	case DIAG_ST_ELSE_IF:
		found = mend_else_if(text, at, out);
		break;
	case DIAG_ST_NOT_CALLED:
		found = name_length(text + at) > 0 &&
			put(out, at + name_length(text + at), 0, g_strdup("()"));
		break;
	case DIAG_ST_OPEN:
		found = mend_open(text, at, second, out);
		break;
	case DIAG_UNKNOWN_NAME: case DIAG_UNKNOWN_WORD: case DIAG_NO_PIN:
		found = mend_name(text, at, first, second, out);
		break;
	default:
		break;
	}
	g_free(first);
	g_free(second);
	return found;
}
