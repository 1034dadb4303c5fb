/* SPDX-License-Identifier: MIT
 *
 * window_names - what is done with the name at the cursor: where it is driven, where it is
 * used, another name for it.
 *
 * What a name means is told by the engine's cross reference.
 */
#include "editor-gtk/window_inside.h"

#include "editor-gtk/symbols.h"
#include "editor-gtk/uses_view.h"
#include "editor-gtk/watch_view.h"

#include "engine/view/xref.h"

#include <stdlib.h>
#include <string.h>

/* ---- what the cursor is on ---- */

static bool is_here(const struct xref_use *use, LadderGridView *sheet, int row, int col)
{
	const struct grid_cursor cursor = ladder_grid_view_cursor(sheet);

	return use->pou == ladder_grid_view_pou(sheet) &&
	       use->rung == ladder_grid_view_first(sheet) + cursor.rung + 1 &&
	       use->row == row + 1 && use->col == col + 1;
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

/* The same, and if there is none that is told. */
static bool begin(LadderWindow *window, struct xref *xref, int *here)
{
	const bool found = find_here(window, xref, here);

	if (!found && ladder_document_project(window->document))
		ladder_window_tell(window, _("There is no name at the cursor."));
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

/* The next one that drives it, round and round. */
void names_go_driver(LadderWindow *window)
{
	struct xref xref = { 0 };
	int here;

	if (begin(window, &xref, &here)) {
		for (int step = 1; step <= xref.count; step++) {
			const struct xref_use *use = &xref.use[(here + step) % xref.count];

			if (use->pou >= 0 && !use->included && drives(use->kind) &&
			    xref_touches(&use->target, &xref.use[here].target)) {
				go_to_use(window, use);
				xref_free(&xref);
				return;
			}
		}
		ladder_window_tell(window, _("Nothing in the program drives it."));
	}
	xref_free(&xref);
}

/* ---- another name ---- */

struct renaming {
	LadderWindow *window;
	GtkWidget *line, *dialog;
	struct xref_target target;
	char *old;
};

/* @old: what it is called until now; valid until the document changes. */
static void rename_target(LadderWindow *window, const struct xref_target *target,
			  const char *old, const char *name)
{
	LadderDocument *document = window->document;
	struct ladder_rename how;
	size_t len, old_len;
	char *text = ladder_rename(ladder_document_ladder(document), target, name, &len,
				   &how);
	char *step = g_strdup_printf(_("Rename %s to %s"), old, name);
	char *before = ladder_document_outline(document, &old_len, NULL, NULL);
	char *old_pou = target->what == XREF_POU ? g_strdup(old) : NULL;
	char *told;

	if (text) {
		ladder_document_begin(document, step, NULL);
		ladder_document_replace(document, 0, old_len, text, NULL);
		if (old_pou)
			ladder_document_rename_bookmarks(document, old_pou, name);
		ladder_document_end(document);
		told = g_strdup_printf(ngettext("%d place changed", "%d places changed",
			(unsigned long)how.places), how.places);
	} else {
		told = rename_reason(document, &how, name);
	}
	ladder_window_tell(window, told);
	g_free(told);
	g_free(old_pou);
	g_free(before);
	g_free(step);
	free(text);
}

void names_rename_pou(LadderWindow *window, int pou, const char *name)
{
	const struct project *project = ladder_document_project(window->document);
	const struct xref_target target = { .what = XREF_POU, .index = pou };

	if (project)
		rename_target(window, &target, project_text(project, project->pou[pou].name),
			      name);
}

static void rename_now(AdwMessageDialog *dialog, const char *response,
		       struct renaming *renaming)
{
	const char *name = gtk_editable_get_text(GTK_EDITABLE(renaming->line));

	(void)dialog;
	if (strcmp(response, "rename") == 0)
		rename_target(renaming->window, &renaming->target, renaming->old, name);
}

static void renaming_free(gpointer data, GClosure *closure)
{
	struct renaming *renaming = data;

	(void)closure;
	g_free(renaming->old);
	g_free(renaming);
}

static void ask_name(LadderWindow *window, const struct xref_target *target,
		     const char *name, int uses)
{
	struct renaming *renaming = g_new0(struct renaming, 1);
	GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(window),
						   _("Rename everywhere"), NULL);

	*renaming = (struct renaming){ window, gtk_entry_new(), dialog, *target,
					g_strdup(name) };
	adw_message_dialog_format_body(ADW_MESSAGE_DIALOG(dialog),
		ngettext("%s stands in %d place.", "%s stands in %d places.",
			 (unsigned long)uses), name, uses);
	gtk_editable_set_text(GTK_EDITABLE(renaming->line), name);
	gtk_entry_set_activates_default(GTK_ENTRY(renaming->line), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(renaming->line),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, _("New name"), -1);
	adw_message_dialog_set_extra_child(ADW_MESSAGE_DIALOG(dialog), renaming->line);
	adw_message_dialog_add_responses(ADW_MESSAGE_DIALOG(dialog),
		"cancel", _("Cancel"), "rename", _("Rename"), NULL);
	adw_message_dialog_set_response_appearance(ADW_MESSAGE_DIALOG(dialog), "rename",
						   ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(ADW_MESSAGE_DIALOG(dialog), "rename");
	adw_message_dialog_set_close_response(ADW_MESSAGE_DIALOG(dialog), "cancel");
	g_signal_connect_data(dialog, "response", G_CALLBACK(rename_now), renaming,
			      renaming_free, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	gtk_widget_grab_focus(renaming->line);
}

/* What it is declared as; NULL: it is not, or is a POU, which the tree renames. */
static const char *declared_name(const struct xref *xref, const struct xref_target *target)
{
	if (target->what != XREF_VARIABLE && target->what != XREF_STEP &&
	    target->what != XREF_TRANSITION && target->what != XREF_ACTION)
		return NULL;
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->kind == XREF_DECLARED && use->slot &&
		    xref_same(&use->target, target))
			return project_text(xref->project, *use->slot);
	}
	return NULL;
}

void names_rename(LadderWindow *window)
{
	struct xref xref = { 0 };
	const char *name;
	int here, uses = 0;

	if (begin(window, &xref, &here)) {
		const struct xref_target *target = &xref.use[here].target;

		for (int i = 0; i < xref.count; i++)
			uses += xref_same(&xref.use[i].target, target);
		name = declared_name(&xref, target);
		if (name)
			ask_name(window, target, name, uses);
		else
			ladder_window_tell(window, _("Only a declared name can be "
				"changed; this one has no declaration."));
	}
	xref_free(&xref);
}

/* ---- all uses ---- */

static char *name_by(LadderWindow *window,
		     bool (*find)(LadderWindow *window, struct xref *xref, int *here))
{
	struct xref xref = { 0 };
	char name[400] = "";
	int here;

	if (find(window, &xref, &here))
		xref_name(ladder_document_project(window->document), &xref.use[here].target,
			  &xref.use[here], name, sizeof(name));
	xref_free(&xref);
	return name[0] ? g_strdup(name) : NULL;
}

char *names_at_cursor(LadderWindow *window)
{
	return name_by(window, begin);
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

void names_show_uses(LadderWindow *window)
{
	char *name = names_at_cursor(window);

	if (name)
		names_show_uses_of(window, name);
	else
		ladder_uses_view_set_mode(LADDER_USES_VIEW(below_show(window, "uses")),
					  USES_ALL);
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
			begin(window, &xref, &here) &&
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
