/* SPDX-License-Identifier: MIT
 *
 * window_names - what is done with the name at the cursor: where it is driven, where it is
 * used. Another name for it is window_rename.c's.
 *
 * What a name means is told by the engine's cross reference.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/panels/uses_view.h"
#include "editor-gtk/live/watch_view.h"

#include "engine/xref/xref.h"

#include <string.h>

static const char no_name[] = N_("There is no name at the cursor.");

/* ---- what the cursor is on ---- */

static bool is_in_rung(const struct xref_use *use, LadderGridView *sheet)
{
	return use->pou == ladder_grid_view_pou(sheet) &&
	       use->rung == ladder_grid_view_first(sheet) +
			    ladder_grid_view_cursor(sheet).rung + 1;
}

static bool is_here(const struct xref_use *use, LadderGridView *sheet, int row, int col)
{
	return is_in_rung(use, sheet) && use->row == row + 1 && use->col == col + 1;
}

bool names_is_here(LadderWindow *window, const struct xref *xref, int here, int use)
{
	LadderGridView *sheet = tabs_sheet(window);
	int row, col;

	return use == here || (sheet && ladder_grid_view_cell(sheet, &row, &col) &&
			       is_here(&xref->use[use], sheet, row, col));
}

/* What the name at the cursor of a list is: the use in that line, or elsewhere in it. */
static int use_in_list(LadderTextView *list, const struct xref *xref)
{
	char *name = ladder_text_view_name(list);
	int found = -1;

	for (int i = 0; name && i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->pou != ladder_text_view_pou(list) || use->rung > 0 || !use->slot ||
		    strlen(name) != use->len ||
		    g_ascii_strncasecmp(name, xref_text(xref, use) + use->at, use->len) != 0)
			continue;
		if (found < 0 || ladder_text_view_is_at(list, use->row))
			found = i;
	}
	g_free(name);
	return found;
}

/* The first use in the cursor's cell; -1: there is none. */
static int use_here(LadderWindow *window, const struct xref *xref)
{
	LadderGridView *sheet = tabs_sheet(window);
	int row, col;

	if (!sheet && tabs_chart(window)) {
		const struct xref_use *use = ladder_sfc_view_use(tabs_chart(window), xref);

		return use ? (int)(use - xref->use) : -1;
	}
	if (tabs_list(window))
		return use_in_list(tabs_list(window), xref);
	if (!sheet || !ladder_grid_view_cell(sheet, &row, &col))
		return -1;
	for (int i = 0; i < xref->count; i++)
		if (is_here(&xref->use[i], sheet, row, col))
			return i;
	return -1;
}

static bool find_here(LadderWindow *window, struct xref *xref, int *here)
{
	struct project *project = ladder_document_project(window->document);

	if (!project)
		return false;
	if (!xref_make(xref, project))
		g_error("out of memory");
	*here = use_here(window, xref);
	return *here >= 0;
}

bool names_begin(LadderWindow *window, struct xref *xref, int *here)
{
	const bool found = find_here(window, xref, here);

	if (!found && ladder_document_project(window->document))
		ladder_window_tell(window, _(no_name));
	return found;
}

/* ---- going ---- */

static void go_to_use(LadderWindow *window, const struct xref_use *use)
{
	if (use->rung > 0)
		tabs_go(window, use->pou, use->rung - 1, use->row - 1, use->col - 1);
	else
		tabs_go(window, use->pou, -1, use->row - 1, use->col - 1);
}

static bool drives(enum xref_kind kind)
{
	return kind == XREF_COIL || kind == XREF_SET || kind == XREF_RESET ||
	       kind == XREF_WRITTEN || kind == XREF_CHANGED || kind == XREF_CALLED ||
	       kind == XREF_ENTERED;
}

/* A jump leads to its label, a call to what it calls; else what drives it is meant. */
static bool is_named_place(const struct xref_use *use)
{
	return use->kind == XREF_JUMPED ||
	       (use->target.what == XREF_POU && !use->unnamed);
}

static bool leads(const struct xref_use *from, const struct xref_use *to)
{
	if (to->pou < 0 || to->included || !xref_touches(&to->target, &from->target))
		return false;
	return is_named_place(from) ? to->kind == XREF_DECLARED : drives(to->kind);
}

static const char *lost(const struct xref *xref, int here)
{
	const struct xref_use *use = &xref->use[here];

	if (use->kind == XREF_JUMPED)
		return _("No rung has this label.");
	return is_named_place(use) ? _("It is declared in another file") :
	       _("Nothing in the program drives it.");
}

/* The next one that drives it, round and round. */
void names_go_driver(LadderWindow *window)
{
	struct xref xref = { 0 };
	int here;

	if (names_begin(window, &xref, &here)) {
		for (int step = 1; step <= xref.count; step++) {
			const struct xref_use *use = &xref.use[(here + step) % xref.count];

			if (leads(&xref.use[here], use)) {
				go_to_use(window, use);
				xref_free(&xref);
				return;
			}
		}
		ladder_window_tell(window, lost(&xref, here));
	}
	xref_free(&xref);
}

/* ---- all uses ---- */

static char *name_by(LadderWindow *window,
		     bool (*find)(LadderWindow *window, struct xref *xref, int *here))
{
	struct xref xref = { 0 };
	char name[400] = "";
	int here = -1;

	if (find(window, &xref, &here))
		xref_name(ladder_document_project(window->document), &xref.use[here].target,
			  &xref.use[here], name, sizeof(name));
	xref_free(&xref);
	return name[0] ? g_strdup(name) : NULL;
}

char *names_at_cursor(LadderWindow *window)
{
	return name_by(window, names_begin);
}

void names_uses_seen(GtkWidget *uses, LadderWindow *window)
{
	char *name = name_by(window, find_here);

	if (name)
		ladder_uses_view_set_symbol(LADDER_USES_VIEW(uses), -1, name);
	g_free(name);
}

void names_follow(LadderWindow *window)
{
	GtkWidget *uses = below_made(window, "uses");

	if (uses && gtk_widget_get_mapped(uses) &&
	    ladder_uses_view_is_lost(LADDER_USES_VIEW(uses)))
		names_uses_seen(uses, window);
}

/* Where there is no name in a rung that has a label: the label. */
static bool find_label(LadderWindow *window, struct xref *xref, int *here)
{
	LadderGridView *sheet = tabs_sheet(window);

	if (find_here(window, xref, here) || !sheet || !xref->project)
		return *here >= 0;
	for (int i = 0; i < xref->count && *here < 0; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->target.what == XREF_LABEL && use->kind == XREF_DECLARED &&
		    is_in_rung(use, sheet))
			*here = i;
	}
	return *here >= 0;
}

void names_show_uses(LadderWindow *window)
{
	char *name = name_by(window, find_label);

	if (name) {
		names_show_uses_of(window, name);
	} else {
		ladder_window_tell(window, _(no_name));
		ladder_uses_view_set_mode(LADDER_USES_VIEW(below_show(window, "uses")),
					  USES_ALL);
	}
	g_free(name);
}

void names_watch_this(LadderWindow *window, const char *name)
{
	ladder_watch_view_add(LADDER_WATCH_VIEW(below_show(window, "watch")), name);
}

static bool at_step(LadderWindow *window)
{
	struct xref xref = { 0 };
	int here;
	const bool is = !tabs_sheet(window) && tabs_chart(window) &&
			names_begin(window, &xref, &here) &&
			xref.use[here].target.what == XREF_STEP;

	xref_free(&xref);
	return is;
}

/* Of a step, whether it is active. */
void names_watch(LadderWindow *window)
{
	char *name = names_at_cursor(window);
	char *active = name && at_step(window) ? g_strconcat(name, ".X", NULL) : NULL;

	names_watch_this(window, active ? active : name ? name : "");
	g_free(active);
	g_free(name);
}

void names_show_uses_of(LadderWindow *window, const char *name)
{
	GtkWidget *uses = below_show(window, "uses");

	ladder_uses_view_set_symbol(LADDER_USES_VIEW(uses), -1, name);
	ladder_uses_view_set_mode(LADDER_USES_VIEW(uses), USES_SYMBOL);
}
