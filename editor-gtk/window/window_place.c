/* SPDX-License-Identifier: MIT
 *
 * window_place - the status bar: where the cursor is, what the next key does, and how large
 * what is in front is shown.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/iomap/iomap_view.h"

/* ---- texts ---- */

LadderTextView *tabs_list(LadderWindow *window)
{
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);
	GtkWidget *content = page ? tabs_content(page) : NULL;

	return LADDER_IS_TEXT_VIEW(content) &&
	       ladder_text_view_pou(LADDER_TEXT_VIEW(content)) >= 0 ?
	       LADDER_TEXT_VIEW(content) : NULL;
}

/* Of a program, a file that cannot be read, a file beside the project; NULL: of none. */
static GtkTextBuffer *buffer_of(AdwTabPage *page)
{
	GtkWidget *content = page ? tabs_content(page) : NULL;

	if (LADDER_IS_TEXT_VIEW(content))
		return GTK_TEXT_BUFFER(ladder_text_view_buffer(LADDER_TEXT_VIEW(content)));
	return LADDER_IS_FILE_VIEW(content) ?
		ladder_side_file_buffer(ladder_file_view_file(LADDER_FILE_VIEW(content))) : NULL;
}

GtkTextBuffer *tabs_text(LadderWindow *window)
{
	LadderFileView *file = tabs_file(window);
	GtkWidget *table = file ? ladder_file_view_table(file) : NULL;

	/* A table hides the text. */
	return table && !ladder_iomap_view_is_text(LADDER_IOMAP_VIEW(table)) ? NULL :
	       buffer_of(adw_tab_view_get_selected_page(window->tabs));
}

/* NULL: there is none in it. */
static GtkTextView *view_in(GtkWidget *within)
{
	GtkTextView *found = GTK_IS_TEXT_VIEW(within) ? GTK_TEXT_VIEW(within) : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(within); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = view_in(child);
	return found;
}

void tabs_reveal_cursor(LadderWindow *window)
{
	AdwTabPage *page = adw_tab_view_get_selected_page(window->tabs);
	GtkTextView *view = page ? view_in(tabs_content(page)) : NULL;

	if (!view)
		return;
	gtk_text_view_scroll_to_mark(view, gtk_text_buffer_get_insert(
		gtk_text_view_get_buffer(view)), 0.1, FALSE, 0, 0);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

static char *place_in(GtkTextBuffer *text)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(text, &at, gtk_text_buffer_get_insert(text));
	return g_strdup_printf(_("Line %d · column %d"), gtk_text_iter_get_line(&at) + 1,
			       gtk_text_iter_get_line_offset(&at) + 1);
}

static char *keys_in_list(void)
{
	GString *text = g_string_new(NULL);

	verb_tell(text, VERB_go_coil);
	verb_tell(text, VERB_show_uses);
	verb_tell(text, VERB_rename);
	verb_tell(text, VERB_next_problem);
	return g_string_free(text, FALSE);
}

/* ---- all of it ---- */

/* Of what is no sheet and no chart. */
static void show_text(LadderWindow *window)
{
	GtkTextBuffer *buffer = tabs_text(window);
	char *place = buffer ? place_in(buffer) : g_strdup("");

	window_show_keys(window, tabs_list(window) ? keys_in_list() : g_strdup(""));
	gtk_label_set_text(window->place_label, place);
	gtk_label_set_text(window->zoom_label, "");
	g_free(place);
}

void tabs_show_place(LadderWindow *window)
{
	LadderGridView *sheet = tabs_seen_sheet(window);
	LadderSfcView *chart = sheet ? NULL : tabs_seen_chart(window);
	char *place, *zoom;

	if (!sheet && !chart) {
		show_text(window);
		return;
	}
	place = sheet ? ladder_grid_view_place(sheet) : ladder_sfc_view_place(chart);
	zoom = g_strdup_printf("%d %%", (int)((sheet ? ladder_grid_view_zoom(sheet) :
			       ladder_sfc_view_zoom(chart)) * 100 + 0.5));
	window_show_keys(window, sheet ? ladder_grid_view_keys(sheet) :
			 ladder_sfc_view_keys(chart));
	gtk_label_set_text(window->place_label, place);
	gtk_label_set_text(window->zoom_label, zoom);
	g_free(place);
	g_free(zoom);
}

void place_follow(LadderWindow *window, AdwTabPage *page)
{
	GtkTextBuffer *buffer = buffer_of(page);
	GtkWidget *content = tabs_content(page);

	if (LADDER_IS_FILE_VIEW(content) && ladder_file_view_table(LADDER_FILE_VIEW(content)))
		g_signal_connect_object(ladder_file_view_table(LADDER_FILE_VIEW(content)),
					"turned", G_CALLBACK(tabs_show_place),
					window, G_CONNECT_SWAPPED);
	if (buffer)
		g_signal_connect_object(buffer, "notify::cursor-position",
					G_CALLBACK(tabs_show_place), window,
					G_CONNECT_SWAPPED);
}
