/* SPDX-License-Identifier: MIT
 *
 * connect_dialog - see connect_dialog.h.
 */
#include "editor-gtk/online/connect_dialog.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/online/board_finder.h"

#include "online/stream.h"

#include <adwaita.h>
#include <string.h>

struct _LadderConnectDialog {
	GtkWindow parent;
	LadderBoardFinder *finder;
	GtkWidget *entry, *wrong, *page;
	GPtrArray *groups;     /* widgets of the list                          */
};

G_DEFINE_FINAL_TYPE(LadderConnectDialog, ladder_connect_dialog, GTK_TYPE_WINDOW)

static guint chosen_signal;

/* ---- choosing ---- */

static void choose(LadderConnectDialog *dialog, const char *where)
{
	char *taken = g_strdup(where);

	g_object_ref(dialog);
	gtk_window_close(GTK_WINDOW(dialog));
	g_signal_emit(dialog, chosen_signal, 0, taken);
	g_object_unref(dialog);
	g_free(taken);
}

static void row_activated(GtkWidget *row)
{
	choose(LADDER_CONNECT_DIALOG(gtk_widget_get_ancestor(row, LADDER_TYPE_CONNECT_DIALOG)),
	       g_object_get_data(G_OBJECT(row), "where"));
}

static void clear_wrong(LadderConnectDialog *dialog)
{
	gtk_widget_set_visible(dialog->wrong, FALSE);
	gtk_widget_remove_css_class(dialog->entry, "error");
}

/* Enter, or the button. */
static void typed(LadderConnectDialog *dialog)
{
	char *where = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(dialog->entry))));
	struct stream_where at;
	const bool wrong = stream_parse(where, &at) != NULL;

	if (!wrong) {
		choose(dialog, where);
	} else {
		gtk_label_set_text(GTK_LABEL(dialog->wrong),
			_("Write USER@BOARD, unix:SOCKET, serial:TTY or exec:COMMAND."));
		gtk_widget_set_visible(dialog->wrong, TRUE);
		gtk_widget_add_css_class(dialog->entry, "error");
		gtk_widget_grab_focus(dialog->entry);
	}
	g_free(where);
}

/* ---- the list ---- */

static GtkWidget *row_new(const char *title, const char *about)
{
	GtkWidget *row = adw_action_row_new();
	char *head = g_markup_escape_text(title, -1), *below = g_markup_escape_text(about, -1);

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), head);
	adw_action_row_set_subtitle(ADW_ACTION_ROW(row), below);
	adw_action_row_set_title_lines(ADW_ACTION_ROW(row), 1);
	g_free(head);
	g_free(below);
	return row;
}

static GtkWidget *group_new(LadderConnectDialog *dialog, const char *title)
{
	GtkWidget *group = adw_preferences_group_new();

	adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(group), title);
	gtk_box_append(GTK_BOX(dialog->page), group);
	g_ptr_array_add(dialog->groups, group);
	return group;
}

static void add_group(LadderConnectDialog *dialog, enum found_kind kind, const char *title,
		      const char *otherwise)
{
	GPtrArray *list = ladder_board_finder_list(dialog->finder);
	GtkWidget *group = NULL;

	for (guint i = 0; i < list->len; i++) {
		const struct board_found *found = list->pdata[i];
		GtkWidget *row;

		if (found->kind != kind)
			continue;
		if (!group)
			group = group_new(dialog, title);
		row = row_new(found->title, found->about);
		gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), TRUE);
		g_object_set_data_full(G_OBJECT(row), "where", g_strdup(found->where), g_free);
		g_signal_connect(row, "activated", G_CALLBACK(row_activated), NULL);
		adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), row);
	}
	if (!group && otherwise)
		adw_preferences_group_set_description(
			ADW_PREFERENCES_GROUP(group_new(dialog, title)), otherwise);
}

static void refill(LadderConnectDialog *dialog)
{
	const char *why = ladder_board_finder_why(dialog->finder);

	for (guint i = 0; i < dialog->groups->len; i++)
		gtk_box_remove(GTK_BOX(dialog->page), dialog->groups->pdata[i]);
	g_ptr_array_set_size(dialog->groups, 0);
	add_group(dialog, FOUND_HERE, "", NULL); /* its only row says what it is */
	add_group(dialog, FOUND_RECENT, _("Recent boards"), NULL);
	add_group(dialog, FOUND_NETWORK, _("In the network"),
		  why ? why : _("No board has announced itself yet."));
	add_group(dialog, FOUND_SERIAL, _("Serial ports"), NULL);
}

/* ---- the window ---- */

static void ladder_connect_dialog_dispose(GObject *object)
{
	LadderConnectDialog *dialog = LADDER_CONNECT_DIALOG(object);

	if (dialog->finder)
		g_signal_handlers_disconnect_by_data(dialog->finder, dialog);
	g_clear_object(&dialog->finder);
	g_clear_pointer(&dialog->groups, g_ptr_array_unref);
	G_OBJECT_CLASS(ladder_connect_dialog_parent_class)->dispose(object);
}

static void ladder_connect_dialog_class_init(LadderConnectDialogClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_connect_dialog_dispose;
	chosen_signal = g_signal_new("chosen", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0,
				     NULL, NULL, NULL, G_TYPE_NONE, 1, G_TYPE_STRING);
	gtk_widget_class_add_binding_action(GTK_WIDGET_CLASS(class), GDK_KEY_Escape, 0,
					    "window.close", NULL);
}

/* The line that takes a place, and the message below it. */
static GtkWidget *line_new(LadderConnectDialog *dialog)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
	GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
	GtkWidget *button = gtk_button_new_with_label(_("Connect"));

	dialog->entry = gtk_entry_new();
	gtk_entry_set_placeholder_text(GTK_ENTRY(dialog->entry), _("user@host, unix:…, serial:…, exec:…"));
	spoken_name(dialog->entry, _("Board"));
	gtk_widget_set_hexpand(dialog->entry, TRUE);
	g_signal_connect_swapped(dialog->entry, "activate", G_CALLBACK(typed), dialog);
	g_signal_connect_swapped(dialog->entry, "changed", G_CALLBACK(clear_wrong), dialog);
	gtk_widget_add_css_class(button, "suggested-action");
	g_signal_connect_swapped(button, "clicked", G_CALLBACK(typed), dialog);
	gtk_box_append(GTK_BOX(line), dialog->entry);
	gtk_box_append(GTK_BOX(line), button);
	dialog->wrong = gtk_label_new("");
	gtk_label_set_wrap(GTK_LABEL(dialog->wrong), TRUE);
	gtk_label_set_xalign(GTK_LABEL(dialog->wrong), 0);
	gtk_widget_add_css_class(dialog->wrong, "error");
	gtk_widget_set_visible(dialog->wrong, FALSE);
	gtk_box_append(GTK_BOX(box), line);
	gtk_box_append(GTK_BOX(box), dialog->wrong);
	return box;
}

static void ladder_connect_dialog_init(LadderConnectDialog *dialog)
{
	GtkWidget *whole = gtk_box_new(GTK_ORIENTATION_VERTICAL, 12);
	GtkWidget *scrolled = gtk_scrolled_window_new();

	dialog->groups = g_ptr_array_new();
	dialog->page = gtk_box_new(GTK_ORIENTATION_VERTICAL, 14);
	gtk_window_set_title(GTK_WINDOW(dialog), _("Connect to a board"));
	gtk_window_set_titlebar(GTK_WINDOW(dialog), adw_header_bar_new());
	gtk_window_set_modal(GTK_WINDOW(dialog), TRUE);
	gtk_window_set_default_size(GTK_WINDOW(dialog), 520, 560);
	gtk_widget_set_margin_start(whole, 16);
	gtk_widget_set_margin_end(whole, 16);
	gtk_widget_set_margin_top(whole, 12);
	gtk_widget_set_margin_bottom(dialog->page, 16);
	gtk_widget_set_vexpand(scrolled, TRUE);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), dialog->page);
	gtk_box_append(GTK_BOX(whole), line_new(dialog));
	gtk_box_append(GTK_BOX(whole), scrolled);
	gtk_window_set_child(GTK_WINDOW(dialog), whole);
	dialog->finder = ladder_board_finder_new(g_getenv("RUNGBOARD_DEV"));
	g_signal_connect_swapped(dialog->finder, "changed", G_CALLBACK(refill), dialog);
	refill(dialog);
}

GtkWidget *ladder_connect_dialog_new(GtkWindow *parent, const char *last)
{
	LadderConnectDialog *dialog = g_object_new(LADDER_TYPE_CONNECT_DIALOG, "transient-for",
						   parent, NULL);

	if (last)
		gtk_editable_set_text(GTK_EDITABLE(dialog->entry), last);
	gtk_widget_grab_focus(dialog->entry);
	return GTK_WIDGET(dialog);
}
