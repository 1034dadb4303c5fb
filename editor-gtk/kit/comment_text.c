/* SPDX-License-Identifier: MIT
 *
 * comment_text - the text of a comment; see comment_text.h.
 */
#include "editor-gtk/kit/comment_text.h"

#include <glib.h>
#include <stdbool.h>

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* Adds a single blank between words, none at the beginning. */
static void add_blank(GString *out)
{
	if (out->len && out->str[out->len - 1] != ' ')
		g_string_append_c(out, ' ');
}

char *comment_text(const char *comment)
{
	GString *out = g_string_new(NULL);
	char inside = '\0'; /* '*': inside (* *), '/': behind // in a line */

	for (; *comment; comment++) {
		const char *ends = inside == '*' ? "*)" : "\n";

		if (!inside && (g_str_has_prefix(comment, "(*") ||
				g_str_has_prefix(comment, "//"))) {
			inside = comment[0] == '/' ? '/' : '*';
			comment++;
		} else if (inside && g_str_has_prefix(comment, ends)) {
			comment += inside == '*';
			inside = '\0';
			add_blank(out);
		} else if (is_blank(*comment)) {
			add_blank(out);
		} else {
			g_string_append_c(out, *comment);
		}
	}
	while (out->len && out->str[out->len - 1] == ' ')
		g_string_truncate(out, out->len - 1);
	return g_string_free(out, FALSE);
}

char *comment_text_safe(const char *text)
{
	GString *out = g_string_new("");

	for (const char *at = text; *at; at++) {
		const bool blank = g_ascii_isspace(*at);

		if (!blank)
			g_string_append_c(out, *at);
		if (blank || (at[0] == '*' && at[1] == ')') || (at[0] == '(' && at[1] == '*'))
			add_blank(out);
	}
	return g_strchomp(g_string_free(out, FALSE));
}
