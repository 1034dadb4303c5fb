/* SPDX-License-Identifier: MIT
 *
 * window_older - the program as it was before an edit, while a scan that it ran is shown.
 *
 * It stands in the place of the tabs, with a bar that says what it is: its POUs are sheets
 * of a document that nobody can change. It comes and goes with the scan that is shown.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/kit/drop.h"

#include <string.h>

struct window_older {
	LadderDocument *document; /* NULL: the program that runs is seen          */
	GtkWidget *box, *page;    /* page: of the POU; NULL: none                 */
	GtkLabel *label;
	GtkDropDown *pous;
	bool filling;             /* the list of POUs changes by itself           */
};

GtkWidget *window_older_page(LadderWindow *window)
{
	return window->older && window->older->document ? window->older->page : NULL;
}

/* ---- its POUs ---- */

static void drop_page(struct window_older *older)
{
	if (older->page)
		gtk_box_remove(GTK_BOX(older->box), older->page);
	older->page = NULL;
}

static void show_pou(LadderWindow *window, int pou)
{
	struct window_older *older = window->older;

	drop_page(older);
	older->page = tabs_page_new(window, older->document, pou);
	gtk_widget_set_vexpand(older->page, TRUE);
	gtk_box_append(GTK_BOX(older->box), older->page);
	tabs_show_place(window);
}

static void chosen(LadderWindow *window)
{
	const guint pou = gtk_drop_down_get_selected(window->older->pous);

	if (!window->older->filling && window->older->document &&
	    pou != GTK_INVALID_LIST_POSITION)
		show_pou(window, (int)pou);
}

bool window_older_by(LadderWindow *window, int by)
{
	struct window_older *older = window->older;
	int count, next;

	if (!window_older_page(window))
		return false;
	count = (int)g_list_model_get_n_items(gtk_drop_down_get_model(older->pous));
	next = ((int)gtk_drop_down_get_selected(older->pous) + by + count) % count;
	gtk_drop_down_set_selected(older->pous, (guint)next);
	return true;
}

/* The one that is looked at, if it was there then. */
static int pou_before(LadderWindow *window, const struct project *project)
{
	AdwTabPage *tab = adw_tab_view_get_selected_page(window->tabs);
	const char *name = tab ? adw_tab_page_get_title(tab) : "";

	return MAX(project_find_pou(project, name, strlen(name)), 0);
}

static void fill_pous(LadderWindow *window)
{
	struct window_older *older = window->older;
	const struct project *project = ladder_document_project(older->document);
	GPtrArray *names = g_ptr_array_new();
	const int pou = pou_before(window, project);

	for (int i = 0; i < project->pou_count; i++)
		g_ptr_array_add(names, (gpointer)project_text(project, project->pou[i].name));
	older->filling = true;
	drop_fill(older->pous, names);
	gtk_drop_down_set_selected(older->pous, (guint)pou);
	older->filling = false;
	gtk_widget_set_visible(GTK_WIDGET(older->pous), project->pou_count > 1);
	g_ptr_array_unref(names);
	show_pou(window, pou);
}

/* ---- coming and going ---- */

static bool has_focus(LadderWindow *window, GtkWidget *widget)
{
	GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));

	return focus && gtk_widget_is_ancestor(focus, widget);
}

static void see(LadderWindow *window, bool older)
{
	gtk_widget_set_visible(window->older->box, older);
	gtk_widget_set_visible(window->front, !older);
	gtk_widget_set_visible(GTK_WIDGET(window->tab_bar), !older);
}

static void say_which(struct window_older *older, const struct sim_edited *edit)
{
	GDateTime *when = g_date_time_new_from_unix_local(edit->us / G_USEC_PER_SEC);
	char *clock = g_date_time_format(when, "%H:%M:%S");
	char *text = g_strdup_printf(_("Before the edit of %s, after scan %llu: the program "
				       "as it was then, to be looked at"), clock,
				     (unsigned long long)edit->scan);

	gtk_label_set_text(older->label, text);
	g_free(text);
	g_free(clock);
	g_date_time_unref(when);
}

static void leave(LadderWindow *window)
{
	const bool focus = has_focus(window, window->older->box);

	drop_page(window->older);
	g_clear_object(&window->older->document);
	see(window, false);
	if (focus)
		tabs_enter_program(window);
	tabs_show_place(window);
}

static void enter(LadderWindow *window, LadderDocument *document,
		  const struct sim_edited *edit)
{
	const bool focus = has_focus(window, GTK_WIDGET(window->tabs)) ||
			   has_focus(window, window->older->box);

	g_set_object(&window->older->document, document);
	say_which(window->older, edit);
	fill_pous(window);
	see(window, true);
	if (focus)
		tabs_enter_program(window);
}

static void program_changed(LadderWindow *window)
{
	struct sim_edited edit;
	LadderDocument *document = ladder_sim_older(window->sim, &edit);
	const struct project *project = document ? ladder_document_project(document) : NULL;

	if (project && project->pou_count > 0)
		enter(window, document, &edit);
	else if (window->older->document)
		leave(window);
}

/* ---- life ---- */

static GtkWidget *new_bar(struct window_older *older)
{
	GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
	GtkWidget *now = gtk_button_new_with_label(_("Show the newest scan"));

	older->label = GTK_LABEL(gtk_label_new(NULL));
	older->pous = GTK_DROP_DOWN(gtk_drop_down_new(NULL, NULL));
	gtk_label_set_xalign(older->label, 0);
	gtk_label_set_wrap(older->label, TRUE);
	gtk_widget_set_hexpand(GTK_WIDGET(older->label), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(older->pous),
		GTK_ACCESSIBLE_PROPERTY_LABEL, _("Program or block"), -1);
	gtk_actionable_set_action_name(GTK_ACTIONABLE(now), "win.sim_now");
	gtk_widget_set_valign(now, GTK_ALIGN_CENTER);
	gtk_widget_set_valign(GTK_WIDGET(older->pous), GTK_ALIGN_CENTER);
	gtk_widget_add_css_class(bar, "older-bar");
	gtk_box_append(GTK_BOX(bar), gtk_image_new_from_icon_name(
		"document-open-recent-symbolic"));
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(older->label));
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(older->pous));
	gtk_box_append(GTK_BOX(bar), now);
	return bar;
}

void window_older_init(LadderWindow *window)
{
	struct window_older *older = g_new0(struct window_older, 1);
	GtkWidget *place = gtk_widget_get_parent(window->front);

	window->older = older;
	older->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	gtk_widget_set_vexpand(older->box, TRUE);
	gtk_widget_set_visible(older->box, FALSE);
	gtk_box_append(GTK_BOX(older->box), new_bar(older));
	gtk_box_append(GTK_BOX(place), older->box);
	g_signal_connect_object(older->pous, "notify::selected", G_CALLBACK(chosen), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(window->sim, "program-changed",
				G_CALLBACK(program_changed), window, G_CONNECT_SWAPPED);
}

void window_older_free(LadderWindow *window)
{
	if (!window->older)
		return;
	g_clear_object(&window->older->document);
	g_clear_pointer(&window->older, g_free);
}
