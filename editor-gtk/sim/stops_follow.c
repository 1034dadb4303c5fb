/* SPDX-License-Identifier: MIT
 *
 * stops_follow - see stops_follow.h.
 */
#include "editor-gtk/sim/stops_follow.h"

#include "editor-gtk/document/text_lines.h"

#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

struct stops_follow {
	LadderDocument *document;
	LadderBreakpoints *points;
	GHashTable *text;   /* of each POU that has some, as it was last seen     */
	bool held;
};

static char *text_of(const struct stops_follow *follow, const char *pou)
{
	const struct project *project = ladder_document_project(follow->document);
	const int index = project ? project_find_pou(project, pou, strlen(pou)) : -1;

	return index >= 0 ? ladder_document_list(follow->document, index) : NULL;
}

/* A POU that has gone, or has another name, keeps its text: it may come back. */
static void look(struct stops_follow *follow)
{
	GHashTable *before = follow->text;

	follow->text = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
	for (guint i = 0; i < ladder_breakpoints_count(follow->points); i++) {
		const char *pou = ladder_breakpoints_at(follow->points, i)->pou;
		char *text;

		if (g_hash_table_contains(follow->text, pou))
			continue;
		text = text_of(follow, pou);
		g_hash_table_insert(follow->text, g_strdup(pou),
				    text ? text : g_strdup(g_hash_table_lookup(before, pou)));
	}
	g_hash_table_unref(before);
}

/* The new place of a line; -1: it has gone. @match: of text_lines_match(). */
static int line_now(const int *match, int count, int lines, int line)
{
	int next = line;

	if (line < count && match[line] >= 0)
		return match[line];
	while (next < count && match[next] < 0)
		next++;
	return line < (next < count ? match[next] : lines) ? line : -1;
}

/* @to: by breakpoint of the POU. */
static void find_lines(const struct stops_follow *follow, const char *pou, const char *before,
		       const char *now, int *to)
{
	const int lines = text_lines_count(now);
	int count = 0, *match = text_lines_match(before, now, &count);

	for (guint i = 0; i < ladder_breakpoints_count(follow->points); i++) {
		const struct breakpoint *point = ladder_breakpoints_at(follow->points, i);

		if (name_equal(point->pou, pou))
			*to++ = match ? line_now(match, count, lines, point->line) : point->line;
	}
	free(match);
}

static void follow_text(struct stops_follow *follow, const char *pou, const char *before)
{
	char *now = text_of(follow, pou);
	int *to;

	if (now && before && strcmp(before, now) != 0) {
		to = g_new(int, ladder_breakpoints_count(follow->points) + 1);
		find_lines(follow, pou, before, now, to);
		ladder_breakpoints_move(follow->points, pou, pou, to);
		g_free(to);
	}
	g_free(now);
}

static void points_changed(struct stops_follow *follow)
{
	if (!follow->held)
		look(follow);
}

static void changed(struct stops_follow *follow)
{
	GHashTableIter iter;
	gpointer pou, before;

	if (follow->held || !g_hash_table_size(follow->text))
		return;
	follow->held = true; /* it moves them itself                              */
	g_hash_table_iter_init(&iter, follow->text);
	while (g_hash_table_iter_next(&iter, &pou, &before))
		follow_text(follow, pou, before);
	follow->held = false;
	look(follow);
}

void stops_follow_hold(struct stops_follow *follow, bool hold)
{
	follow->held = hold;
	if (!hold)
		look(follow);
}

struct stops_follow *stops_follow_new(LadderDocument *document, LadderBreakpoints *points)
{
	static const char *const signals[] = { "rungs-changed", "project-changed", "list-changed",
					       "variable-changed", NULL };
	struct stops_follow *follow = g_new0(struct stops_follow, 1);

	follow->document = document;
	follow->points = points;
	follow->text = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
	for (int i = 0; signals[i]; i++)
		g_signal_connect_swapped(document, signals[i], G_CALLBACK(changed), follow);
	g_signal_connect_swapped(points, "changed", G_CALLBACK(points_changed), follow);
	return follow;
}

void stops_follow_free(struct stops_follow *follow)
{
	if (!follow)
		return;
	g_signal_handlers_disconnect_by_data(follow->document, follow);
	g_signal_handlers_disconnect_by_data(follow->points, follow);
	g_hash_table_unref(follow->text);
	g_free(follow);
}
