/* SPDX-License-Identifier: MIT
 *
 * timing_kept - names of the timing chart as lines of the VIEW part, and back.
 */
#include "editor-gtk/live/timing_kept.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

#define LINE "timing"

/* The name in a line, if it is one of ours. Caller frees; NULL: it is not. */
static char *name_in(const char *line)
{
	const gsize len = strlen(LINE);
	gsize name;

	line += strspn(line, " \t");
	if (strncmp(line, LINE, len) != 0 || !line[len] || !strchr(" \t", line[len]))
		return NULL;
	line += len;
	line += strspn(line, " \t");
	name = strcspn(line, " \t\r");
	return name ? g_strndup(line, name) : NULL;
}

char **timing_kept_read(const char *view)
{
	GPtrArray *names = g_ptr_array_new();
	char **lines = g_strsplit(view, "\n", -1);

	for (char **line = lines; *line; line++) {
		char *name = name_in(*line);

		if (name)
			g_ptr_array_add(names, name);
	}
	g_ptr_array_add(names, NULL);
	g_strfreev(lines);
	return (char **)g_ptr_array_free(names, FALSE);
}

static bool is_end(const char *line)
{
	return g_ascii_strncasecmp(line + strspn(line, " \t"), "END_VIEW", 8) == 0;
}

char *timing_kept_write(const char *view, const char *const *names)
{
	char **lines = g_strsplit(*view ? view : "VIEW\nEND_VIEW", "\n", -1);
	GString *out = g_string_new(NULL);
	bool written = false;

	for (char **line = lines; *line; line++) {
		char *name = name_in(*line);

		if (!written && (name || is_end(*line))) {
			for (int i = 0; names[i]; i++)
				g_string_append_printf(out, "  " LINE " %s\n", names[i]);
			written = true;
		}
		if (!name)
			g_string_append_printf(out, "%s\n", *line);
		g_free(name);
	}
	g_string_truncate(out, out->len - 1);
	g_strfreev(lines);
	return g_string_free(out, FALSE);
}

void timing_kept_put(LadderDocument *document, const char *const *names)
{
	const char *view = ladder_document_view(document);
	char **before = timing_kept_read(view), *after;

	if (ladder_document_project(document) &&
	    !g_strv_equal((const char *const *)before, names)) {
		after = timing_kept_write(view, names);
		ladder_document_begin(document, _("Variables of the timing chart"), NULL);
		ladder_document_set_view(document, after);
		ladder_document_end(document);
		g_free(after);
	}
	g_strfreev(before);
}
