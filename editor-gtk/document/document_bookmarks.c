/* SPDX-License-Identifier: MIT
 *
 * document_bookmarks - rungs that a person wants to come back to.
 *
 * They are lines `bookmark POU NUMBER` of the file's VIEW part, so that they are saved with
 * it and undone like everything else; other lines of that part are left as they are. They
 * follow their rungs.
 */
#include "editor-gtk/document/document_inside.h"

#include <stdlib.h>
#include <string.h>

/* ---- lines of the VIEW part ---- */

/* `bookmark Main 3`: its rung, 0-based, if it is one of @pou; else -1. @end: behind it. */
static int bookmark_of(const char *line, const char *pou, const char **end)
{
	const gsize len = strlen(pou);
	char *behind;
	long number;

	line += strspn(line, " \t");
	if (!g_str_has_prefix(line, "bookmark "))
		return -1;
	line += strlen("bookmark ");
	line += strspn(line, " \t");
	if (g_ascii_strncasecmp(line, pou, len) != 0 || line[len] != ' ')
		return -1;
	number = strtol(line + len, &behind, 10);
	if (number < 1 || number > LIMIT_RUNGS)
		return -1;
	*end = behind;
	return (int)number - 1;
}

static const char *pou_name(LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);

	return project && pou >= 0 && pou < project->pou_count ?
	       project_text(project, project->pou[pou].name) : NULL;
}

/* What happens to the rungs of a POU. */
struct shift {
	const char *name, *to;     /* of the POU, before and afterwards        */
	int at, removed, inserted;
	int from;                  /* >= 0: a rung moves from there to @at       */
	bool drop;                 /* the bookmark at @at goes                 */
};

static int place_after(const struct shift *shift, int rung)
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

static char *rewritten(const char *view, const struct shift *shift)
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

/* ---- the part ---- */

static char *view_text(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	return g_strdup(project ? project_view(project) : "");
}

void document_apply_view(LadderDocument *document, const char *text)
{
	if (!project_set_view(ladder_project(document->ladder), text))
		g_error("out of memory");
	document_tell_bookmarks(document);
}

/* An empty part that is the last one was ours, and goes. */
static void put_view(LadderDocument *document, const char *before, const char *after)
{
	char *plain = g_strstrip(g_strdup(after));

	if (strcmp(before, after) == 0 || document->fixed ||
	    !ladder_document_project(document)) {
		g_free(plain);
		return;
	}
	if (strcmp(plain, "VIEW\nEND_VIEW") == 0 &&
	    project_view_is_last(ladder_document_project(document)))
		after = "";
	document_record(document, change_new(CHANGE_VIEW, -1, 0,
					     document_one_text(before, strlen(before)),
					     document_one_text(after, strlen(after))));
	g_free(plain);
}

static void shift_view(LadderDocument *document, const struct shift *shift)
{
	char *before = view_text(document), *after = rewritten(before, shift);

	put_view(document, before, after);
	g_free(before);
	g_free(after);
}

void document_shift_bookmarks(LadderDocument *document, int pou, int at, int removed,
			      int inserted)
{
	const char *name = pou_name(document, pou);
	const struct shift shift = { name, name, at, removed, inserted, -1, false };

	if (removed != inserted)
		shift_view(document, &shift);
}

void document_move_bookmarks(LadderDocument *document, int pou, int from, int to,
			     const char *view)
{
	const char *name = pou_name(document, pou);
	const struct shift shift = { name, name, to, 0, 0, from, false };
	char *before = view_text(document), *after = rewritten(view, &shift);

	put_view(document, before, after);
	g_free(before);
	g_free(after);
}

/* ---- names of POUs ---- */

char *document_pou_name(LadderDocument *document, int pou)
{
	return g_strdup(pou_name(document, pou));
}

static bool is_taken(LadderDocument *document, int pou, const char *name)
{
	const int pous = ladder_document_project(document)->pou_count;

	for (int i = 0; i < pous; i++)
		if (i != pou && g_ascii_strcasecmp(pou_name(document, i), name) == 0)
			return true;
	return false;
}

/* While somebody types, a name may be another's for a moment: that one keeps its own. */
void document_follow_name(LadderDocument *document, int pou, const char *before)
{
	const char *now = pou_name(document, pou);

	if (before && now && strcmp(before, now) != 0 && !is_taken(document, pou, before) &&
	    !is_taken(document, pou, now))
		ladder_document_rename_bookmarks(document, before, now);
}

/* ---- from outside ---- */

void ladder_document_rename_bookmarks(LadderDocument *document, const char *from,
				      const char *to)
{
	const struct shift shift = { from, to, 0, 0, 0, -1, false };

	shift_view(document, &shift);
}

const char *ladder_document_view(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	return project ? project_view(project) : "";
}

void ladder_document_set_view(LadderDocument *document, const char *view)
{
	char *before = view_text(document);

	put_view(document, before, view);
	g_free(before);
}

bool ladder_document_is_bookmarked(LadderDocument *document, int pou, int rung)
{
	const struct project *project = ladder_document_project(document);
	const char *name = pou_name(document, pou), *end;
	const char *line = name ? project_view(project) : NULL;

	while (line && *line) {
		if (bookmark_of(line, name, &end) == rung)
			return true;
		line = strchr(line, '\n');
		line = line ? line + 1 : NULL;
	}
	return false;
}

bool ladder_document_next_bookmark(LadderDocument *document, int *pou, int *rung)
{
	const struct project *project = ladder_document_project(document);
	const int pous = project ? project->pou_count : 0;

	if (pous == 0 || !project_view(project)[0])
		return false;
	for (int i = 0, at = MAX(*pou, 0), from = *rung + 1; i <= pous;
	     i++, at = (at + 1) % pous, from = 0)
		for (int n = from; n < project->pou[at].rung_count; n++)
			if (ladder_document_is_bookmarked(document, at, n)) {
				*pou = at;
				*rung = n;
				return true;
			}
	return false;
}

static void add_bookmark(LadderDocument *document, int pou, int rung)
{
	char *before = view_text(document);
	const char *end = before[0] ? strrchr(before, '\n') : NULL;
	char *after = end ? g_strdup_printf("%.*s\n  bookmark %s %d%s", (int)(end - before),
					    before, pou_name(document, pou), rung + 1, end) :
		g_strdup_printf("VIEW\n  bookmark %s %d\nEND_VIEW",
				pou_name(document, pou), rung + 1);

	put_view(document, before, after);
	g_free(before);
	g_free(after);
}

void ladder_document_toggle_bookmark(LadderDocument *document, int pou, int rung)
{
	const char *name = pou_name(document, pou);
	const struct shift shift = { name, name, rung, 0, 0, -1, true };
	const bool is = ladder_document_is_bookmarked(document, pou, rung);

	if (!name)
		return;
	ladder_document_begin(document, is ? _("Clear bookmark") : _("Set bookmark"), NULL);
	if (is)
		shift_view(document, &shift);
	else
		add_bookmark(document, pou, rung);
	ladder_document_end(document);
}
