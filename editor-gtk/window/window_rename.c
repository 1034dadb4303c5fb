/* SPDX-License-Identifier: MIT
 *
 * window_rename - another name for what the cursor is on, or a program, wherever it is used.
 *
 * The question says why a name cannot be, while it is typed, and stays until one can be or
 * nothing is to change. Whether one can be is the engine's to say.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/document/symbols.h"

#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

#define WHY_LINES 4

/* A thing that can get another name. */
struct named {
	struct xref_target target;
	char *name;          /* what it is called until now                   */
	int uses;
};

struct renaming {
	LadderWindow *window;
	AdwMessageDialog *dialog;
	GtkWidget *line, *why;
	GArray *choice;      /* of struct named, one at least                 */
	guint chosen;
};

/* ---- doing it ---- */

static void rename_target(LadderWindow *window, const struct named *named, const char *name)
{
	LadderDocument *document = window->document;
	struct ladder_rename how;
	size_t len, old_len;
	char *text = ladder_rename(ladder_document_ladder(document), &named->target, name,
				   &len, &how);
	char *step = g_strdup_printf(_("Rename %s to %s"), named->name, name);
	char *before = ladder_document_outline(document, &old_len, NULL, NULL);
	char *told;

	if (text) {
		ladder_document_begin(document, step, NULL);
		ladder_document_replace(document, 0, old_len, text, NULL);
		if (named->target.what == XREF_POU)
			ladder_document_rename_bookmarks(document, named->name, name);
		ladder_document_end(document);
		told = g_strdup_printf(ngettext("%d place changed", "%d places changed",
			(unsigned long)how.places), how.places);
	} else {
		told = rename_reason(document, &how, name);
	}
	ladder_window_tell(window, told);
	g_free(told);
	g_free(before);
	g_free(step);
	free(text);
}

/* Why it cannot be called so; NULL: it can. Caller frees. */
static char *refusal(LadderDocument *document, const struct named *named, const char *name)
{
	struct ladder_rename how;
	size_t len;
	char *text, *why;

	if (strcmp(name, named->name) == 0)
		return NULL;
	if (!*name)
		return g_strdup(_("A name is needed"));
	text = ladder_rename(ladder_document_ladder(document), &named->target, name, &len,
			     &how);
	why = text ? NULL : rename_reason(document, &how, name);
	free(text);
	return why;
}

/* ---- the question ---- */

static const struct named *chosen_of(const struct renaming *renaming)
{
	return &g_array_index(renaming->choice, struct named, renaming->chosen);
}

/* Caller frees. */
static char *name_typed(const struct renaming *renaming)
{
	return g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(renaming->line))));
}

static void typed(GtkEditable *line, struct renaming *renaming)
{
	char *name = name_typed(renaming);
	char *why = refusal(renaming->window->document, chosen_of(renaming), name);

	gtk_label_set_text(GTK_LABEL(renaming->why), why ? why : "");
	adw_message_dialog_set_response_enabled(renaming->dialog, "rename", !why);
	cells_refuse(GTK_WIDGET(line), why);
	g_free(name);
}

static void show_chosen(struct renaming *renaming)
{
	const struct named *named = chosen_of(renaming);

	adw_message_dialog_format_body(renaming->dialog,
		ngettext("%s stands in %d place.", "%s stands in %d places.",
			 (unsigned long)named->uses), named->name, named->uses);
	gtk_editable_set_text(GTK_EDITABLE(renaming->line), named->name);
}

static void choose(GtkDropDown *list, GParamSpec *spec, struct renaming *renaming)
{
	const guint chosen = gtk_drop_down_get_selected(list);

	(void)spec;
	if (chosen >= renaming->choice->len)
		return;
	renaming->chosen = chosen;
	show_chosen(renaming);
}

static void rename_now(AdwMessageDialog *dialog, const char *response,
		       struct renaming *renaming)
{
	const struct named *named = chosen_of(renaming);
	char *name = name_typed(renaming);

	(void)dialog;
	if (strcmp(response, "rename") == 0 && strcmp(name, named->name) != 0)
		rename_target(renaming->window, named, name);
	g_free(name);
}

static void renaming_free(gpointer data, GClosure *closure)
{
	struct renaming *renaming = data;

	(void)closure;
	g_array_unref(renaming->choice);
	g_free(renaming);
}

/* NULL: there is nothing to choose. */
static GtkWidget *choice_new(struct renaming *renaming)
{
	GtkStringList *names = gtk_string_list_new(NULL);
	GtkWidget *list;

	for (guint i = 0; i < renaming->choice->len; i++)
		gtk_string_list_append(names, g_array_index(renaming->choice, struct named,
							    i).name);
	list = gtk_drop_down_new(G_LIST_MODEL(names), NULL);
	gtk_widget_set_visible(list, renaming->choice->len > 1);
	gtk_accessible_update_property(GTK_ACCESSIBLE(list), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       _("Which name"), -1);
	g_signal_connect(list, "notify::selected", G_CALLBACK(choose), renaming);
	return list;
}

static GtkWidget *line_new(struct renaming *renaming)
{
	GtkWidget *line = gtk_entry_new();

	gtk_entry_set_activates_default(GTK_ENTRY(line), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(line), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       _("New name"), -1);
	g_signal_connect(line, "changed", G_CALLBACK(typed), renaming);
	return line;
}

/* It has its line also while it is empty: what is below it stays where it is. */
static GtkWidget *why_new(void)
{
	GtkWidget *why = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(why), 0);
	gtk_label_set_wrap(GTK_LABEL(why), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(why), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_lines(GTK_LABEL(why), WHY_LINES);
	gtk_label_set_ellipsize(GTK_LABEL(why), PANGO_ELLIPSIZE_END);
	gtk_widget_add_css_class(why, "error");
	return why;
}

static GtkWidget *parts_new(struct renaming *renaming)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);

	renaming->line = line_new(renaming);
	renaming->why = why_new();
	gtk_box_append(GTK_BOX(box), choice_new(renaming));
	gtk_box_append(GTK_BOX(box), renaming->line);
	gtk_box_append(GTK_BOX(box), renaming->why);
	spoken_parts(box);
	return box;
}

/* @choice: taken over. */
static void ask_name(LadderWindow *window, GArray *choice)
{
	struct renaming *renaming = g_new0(struct renaming, 1);
	GtkWidget *widget = adw_message_dialog_new(GTK_WINDOW(window),
						   _("Rename everywhere"), NULL);
	AdwMessageDialog *dialog = ADW_MESSAGE_DIALOG(widget);

	*renaming = (struct renaming){ .window = window, .dialog = dialog,
					.choice = choice };
	adw_message_dialog_add_responses(dialog, "cancel", _("Cancel"), "rename",
					 _("Rename"), NULL);
	adw_message_dialog_set_response_appearance(dialog, "rename", ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(dialog, "rename");
	adw_message_dialog_set_close_response(dialog, "cancel");
	adw_message_dialog_set_extra_child(dialog, parts_new(renaming));
	show_chosen(renaming);
	g_signal_connect_data(dialog, "response", G_CALLBACK(rename_now), renaming,
			      renaming_free, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	gtk_widget_grab_focus(renaming->line);
}

/* ---- what there is to be renamed ---- */

/* What it is declared as; NULL: it is not. */
static const char *declared_name(const struct xref *xref, const struct xref_target *target)
{
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->kind == XREF_DECLARED && use->slot &&
		    xref_same(&use->target, target))
			return project_text(xref->project, *use->slot);
	}
	return NULL;
}

static void named_clear(gpointer named)
{
	g_free(((struct named *)named)->name);
}

static GArray *choice_start(void)
{
	GArray *choice = g_array_new(FALSE, FALSE, sizeof(struct named));

	g_array_set_clear_func(choice, named_clear);
	return choice;
}

/* If it is declared, and not among them yet. */
static void choice_add(GArray *choice, const struct xref *xref,
		       const struct xref_target *target)
{
	const char *name = declared_name(xref, target);
	struct named named = { .target = *target };

	for (guint i = 0; i < choice->len; i++)
		if (xref_same(&g_array_index(choice, struct named, i).target, target))
			return;
	if (!name)
		return;
	named.name = g_strdup(name);
	for (int i = 0; i < xref->count; i++)
		named.uses += xref_same(&xref->use[i].target, target);
	g_array_append_val(choice, named);
}

/* What is written in the cell; then what only its box is named by: an instance comes before
 * its block. */
static GArray *choice_here(LadderWindow *window, const struct xref *xref, int here)
{
	GArray *choice = choice_start();

	for (int unnamed = 0; unnamed < 2; unnamed++)
		for (int i = here; i < xref->count; i++)
			if (xref->use[i].unnamed == (unnamed == 1) &&
			    names_is_here(window, xref, here, i))
				choice_add(choice, xref, &xref->use[i].target);
	return choice;
}

void names_rename(LadderWindow *window)
{
	struct xref xref = { 0 };
	int here;

	if (names_begin(window, &xref, &here)) {
		GArray *choice = choice_here(window, &xref, here);

		if (choice->len) {
			ask_name(window, choice);
		} else {
			ladder_window_tell(window, _("Only a declared name can be "
				"changed; this one has no declaration."));
			g_array_unref(choice);
		}
	}
	xref_free(&xref);
}

void names_rename_pou(LadderWindow *window, int pou)
{
	struct project *project = ladder_document_project(window->document);
	const struct xref_target target = { .what = XREF_POU, .index = pou };
	struct xref xref = { 0 };
	GArray *choice = choice_start();

	if (project && !xref_make(&xref, project))
		g_error("out of memory");
	choice_add(choice, &xref, &target);
	if (choice->len)
		ask_name(window, choice);
	else
		g_array_unref(choice);
	xref_free(&xref);
}
