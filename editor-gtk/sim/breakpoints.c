/* SPDX-License-Identifier: MIT
 *
 * breakpoints - lines of texts of programs: see breakpoints.h.
 */
#include "editor-gtk/sim/breakpoints.h"

#include "engine/base/name.h"

#include <string.h>

struct _LadderBreakpoints {
	GObject parent;
	GArray *point;           /* of struct breakpoint                       */
};

static guint changed_signal;

G_DEFINE_FINAL_TYPE(LadderBreakpoints, ladder_breakpoints, G_TYPE_OBJECT)

static struct breakpoint *at(LadderBreakpoints *points, guint index)
{
	return &g_array_index(points->point, struct breakpoint, index);
}

static void tell(LadderBreakpoints *points)
{
	g_signal_emit(points, changed_signal, 0);
}

static struct breakpoint *find(LadderBreakpoints *points, const char *pou, int line)
{
	for (guint i = 0; i < points->point->len; i++)
		if (at(points, i)->line == line && name_equal(at(points, i)->pou, pou))
			return at(points, i);
	return NULL;
}

guint ladder_breakpoints_count(LadderBreakpoints *points)
{
	return points->point->len;
}

const struct breakpoint *ladder_breakpoints_at(LadderBreakpoints *points, guint index)
{
	return at(points, index);
}

const struct breakpoint *ladder_breakpoints_find(LadderBreakpoints *points, const char *pou, int line)
{
	return find(points, pou, line);
}

void ladder_breakpoints_set(LadderBreakpoints *points, const char *pou, int line,
			    const char *condition)
{
	struct breakpoint *known = find(points, pou, line);
	struct breakpoint point = { g_strdup(pou), line, g_strdup(condition) };

	if (known) {
		g_free(known->pou);
		g_free(known->condition);
		*known = point;
	} else {
		g_array_append_val(points->point, point);
	}
	tell(points);
}

void ladder_breakpoints_clear(LadderBreakpoints *points, const char *pou, int line)
{
	struct breakpoint *known = find(points, pou, line);

	if (!known)
		return;
	g_array_remove_index(points->point,
			     (guint)(known - (struct breakpoint *)(void *)points->point->data));
	tell(points);
}

void ladder_breakpoints_clear_all(LadderBreakpoints *points)
{
	if (points->point->len == 0)
		return;
	g_array_set_size(points->point, 0);
	tell(points);
}

/* Two that come into the same line become one. */
void ladder_breakpoints_move(LadderBreakpoints *points, const char *pou, const char *name,
			     const int *to)
{
	bool changed = false;
	guint kept = 0;

	for (guint i = 0; i < points->point->len; i++) {
		struct breakpoint *point = at(points, i);

		if (!name_equal(point->pou, pou))
			continue;
		changed = changed || point->line != *to || strcmp(pou, name) != 0;
		g_free(point->pou);
		point->pou = g_strdup(name);
		point->line = *to++;
	}
	for (guint i = 0; i < points->point->len; i++) {
		struct breakpoint *point = at(points, i);

		if (point->line >= 0 && find(points, point->pou, point->line) == point)
			kept++;
		else
			point->line = -1;
	}
	for (guint i = points->point->len; kept < points->point->len && i-- > 0;)
		if (at(points, i)->line < 0)
			g_array_remove_index(points->point, i);
	if (changed)
		tell(points);
}

static void clear(gpointer data)
{
	struct breakpoint *point = data;

	g_free(point->pou);
	g_free(point->condition);
}

static void ladder_breakpoints_finalize(GObject *object)
{
	g_array_unref(LADDER_BREAKPOINTS(object)->point);
	G_OBJECT_CLASS(ladder_breakpoints_parent_class)->finalize(object);
}

static void ladder_breakpoints_class_init(LadderBreakpointsClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_breakpoints_finalize;
	changed_signal = g_signal_new("changed", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
				      NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_breakpoints_init(LadderBreakpoints *points)
{
	points->point = g_array_new(FALSE, FALSE, sizeof(struct breakpoint));
	g_array_set_clear_func(points->point, clear);
}

LadderBreakpoints *ladder_breakpoints_new(void)
{
	return g_object_new(LADDER_TYPE_BREAKPOINTS, NULL);
}
