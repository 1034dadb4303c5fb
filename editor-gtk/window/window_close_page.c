/* SPDX-License-Identifier: MIT
 *
 * window_close_page - a tab goes: a file beside the project that is not saved is asked for;
 * with the last one, that nothing is open is said.
 */
#include "editor-gtk/window/window_inside.h"

#include <string.h>

struct closing {
	LadderWindow *window;
	AdwTabPage *page;
};

static void close_answered(AdwMessageDialog *dialog, const char *answer,
			   struct closing *closing)
{
	LadderSideFile *file = ladder_file_view_file(
		LADDER_FILE_VIEW(tabs_content(closing->page)));
	const bool save = strcmp(answer, "save") == 0;
	const bool close = strcmp(answer, "discard") == 0 ||
		(save && window_save_file(closing->window, file));

	(void)dialog;
	if (close)
		draft_remove(file);
	adw_tab_view_close_page_finish(closing->window->tabs, closing->page, close);
}

static void closing_free(gpointer closing, GClosure *closure)
{
	(void)closure;
	g_object_unref(((struct closing *)closing)->page);
	g_free(closing);
}

/* A file that is not saved goes only if the person says so. */
static gboolean close_page(LadderWindow *window, AdwTabPage *page)
{
	GtkWidget *widget = tabs_content(page), *dialog;
	struct closing *closing;
	char *name;

	if (!LADDER_IS_FILE_VIEW(widget) ||
	    ladder_side_file_is_saved(ladder_file_view_file(LADDER_FILE_VIEW(widget))))
		return GDK_EVENT_PROPAGATE;
	closing = g_new0(struct closing, 1);
	*closing = (struct closing){ window, g_object_ref(page) };
	name = ladder_side_file_name(ladder_file_view_file(LADDER_FILE_VIEW(widget)));
	dialog = window_ask_save(window, name);
	g_signal_connect_data(dialog, "response", G_CALLBACK(close_answered), closing,
			      closing_free, 0);
	g_free(name);
	return GDK_EVENT_STOP;
}

void tabs_close(LadderWindow *window)
{
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);

	if (page)
		adw_tab_view_close_page(window->tabs, page);
}

static void show_nothing(LadderWindow *window)
{
	gtk_label_set_text(window->nothing_label, ladder_document_project(window->document) ?
		_("Nothing is open. A double click in the tree opens a program.") :
		_("Nothing is open. A double click on a problem below opens the file as text."));
	gtk_widget_set_visible(GTK_WIDGET(window->nothing_label),
			       adw_tab_view_get_n_pages(window->tabs) == 0);
}

void tabs_init_closing(LadderWindow *window)
{
	g_signal_connect_object(window->tabs, "close-page", G_CALLBACK(close_page), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(window->tabs, "notify::n-pages", G_CALLBACK(show_nothing),
				window, G_CONNECT_SWAPPED);
}
