/* SPDX-License-Identifier: MIT
 *
 * bookmarks - bookmarks as lines of the VIEW part.
 */
#include "editor-gtk/document/bookmarks.h"

#include "engine/base/limits.h"
#include "engine/base/name.h"

#include <glib.h>
#include <stdlib.h>
#include <string.h>

/* Reads `bookmark Main 3`: the 0-based rung if it is in @pou, else -1. @end: behind the
 * number. */
static int bookmark_of(const char *line, const char *pou, const char **end)
{
	char *behind;
	long number;
	gsize len;

	line += strspn(line, " \t");
	if (!g_str_has_prefix(line, "bookmark "))
		return -1;
	line += strlen("bookmark ");
	line += strspn(line, " \t");
	len = name_head(pou, strlen(pou), line, strcspn(line, "\n"));
	if (!len || line[len] != ' ')
		return -1;
	number = strtol(line + len, &behind, 10);
	if (number < 1 || number > LIMIT_RUNGS)
		return -1;
	*end = behind;
	return (int)number - 1;
}

bool bookmarks_have(const char *view, const char *pou, int rung)
{
	const char *end;

	while (view && *view) {
		if (bookmark_of(view, pou, &end) == rung)
			return true;
		view = strchr(view, '\n');
		view = view ? view + 1 : NULL;
	}
	return false;
}

char *bookmarks_add(const char *view, const char *pou, int rung)
{
	const char *end = view[0] ? strrchr(view, '\n') : NULL;

	return end ? g_strdup_printf("%.*s\n  bookmark %s %d%s", (int)(end - view), view, pou,
				     rung + 1, end) :
		g_strdup_printf("VIEW\n  bookmark %s %d\nEND_VIEW", pou, rung + 1);
}

static int place_after(const struct bookmark_shift *shift, int rung)
{
	if (shift->drop)
		return rung == shift->at ? -1 : rung;
	if (shift->from >= 0) {
		if (rung == shift->from)
			return shift->at;
		rung -= rung > shift->from;
		return rung + (rung >= shift->at);
	}
	if (rung < shift->at)
		return rung;
	if (rung >= shift->at + shift->removed)
		return rung + shift->inserted - shift->removed;
	return rung - shift->at < shift->inserted ? rung : -1;
}

char *bookmarks_shift(const char *view, const struct bookmark_shift *shift)
{
	char **lines = g_strsplit(view, "\n", -1);
	GString *out = g_string_new(NULL);

	for (char **line = lines; *line; line++) {
		const char *end;
		const int rung = bookmark_of(*line, shift->name, &end);
		const int to = rung < 0 ? 0 : place_after(shift, rung);

		if (to < 0)
			continue;
		if (line != lines)
			g_string_append_c(out, '\n');
		if (rung < 0)
			g_string_append(out, *line);
		else
			g_string_append_printf(out, "  bookmark %s %d%s", shift->to, to + 1,
					       end);
	}
	g_strfreev(lines);
	return g_string_free(out, FALSE);
}
