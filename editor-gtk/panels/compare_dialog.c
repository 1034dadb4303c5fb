/* SPDX-License-Identifier: MIT
 *
 * compare_dialog - see compare_dialog.h.
 */
#include "editor-gtk/panels/compare_dialog.h"

#include "editor-gtk/document/git_log.h"
#include "editor-gtk/kit/i18n.h"

#include <adwaita.h>
#include <string.h>

struct _LadderCompareDialog {
	GtkWindow parent_instance;
	GtkWidget *revisions;      /* group of the rows of git                   */
	GtkWidget *reading;        /* the row that says that git is asked        */
	GCancellable *cancel;
	char *path;                /* of the document; NULL: none                */
};

G_DEFINE_FINAL_TYPE(LadderCompareDialog, ladder_compare_dialog, GTK_TYPE_WINDOW)

enum { SAVED, FILE_WANTED, FILES_WANTED, REVISION, SIGNALS };
static guint signals[SIGNALS];

/* ---- rows ---- */

static GtkWidget *row_new(GtkWidget *group, const char *title, const char *subtitle)
{
	GtkWidget *row = adw_action_row_new();
	char *head = g_markup_escape_text(title, -1);
	char *below = g_markup_escape_text(subtitle, -1);

	adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), head);
	adw_action_row_set_subtitle(ADW_ACTION_ROW(row), below);
	adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), row);
	g_free(head);
	g_free(below);
	return row;
}

static GtkWidget *choice_new(GtkWidget *group, const char *title, const char *subtitle,
			     GCallback chosen, gpointer dialog)
{
	GtkWidget *row = row_new(group, title, subtitle);

	gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), TRUE);
	g_signal_connect_swapped(row, "activated", chosen, dialog);
	return row;
}

static GtkWidget *group_new(GtkWidget *page, const char *title)
{
	GtkWidget *group = adw_preferences_group_new();

	adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(group), title);
	adw_preferences_page_add(ADW_PREFERENCES_PAGE(page), ADW_PREFERENCES_GROUP(group));
	return group;
}

/* ---- the choice ---- */

static void end(LadderCompareDialog *dialog, guint signal)
{
	g_object_ref(dialog);
	gtk_window_close(GTK_WINDOW(dialog));
	g_signal_emit(dialog, signals[signal], 0);
	g_object_unref(dialog);
}

static void saved_chosen(LadderCompareDialog *dialog)
{
	end(dialog, SAVED);
}

static void file_chosen(LadderCompareDialog *dialog)
{
	end(dialog, FILE_WANTED);
}

static void files_chosen(LadderCompareDialog *dialog)
{
	end(dialog, FILES_WANTED);
}

static void revision_chosen(GtkWidget *row)
{
	LadderCompareDialog *dialog = LADDER_COMPARE_DIALOG(gtk_widget_get_ancestor(row,
		LADDER_TYPE_COMPARE_DIALOG));

	g_object_ref(dialog);
	g_object_ref(row);
	gtk_window_close(GTK_WINDOW(dialog));
	g_signal_emit(dialog, signals[REVISION], 0, g_object_get_data(G_OBJECT(row), "hash"),
		      g_object_get_data(G_OBJECT(row), "file"),
		      g_object_get_data(G_OBJECT(row), "name"));
	g_object_unref(row);
	g_object_unref(dialog);
}

/* ---- revisions ---- */

static void add_revision(LadderCompareDialog *dialog, const struct git_revision *revision)
{
	char *base = g_path_get_basename(dialog->path), *then = g_path_get_basename(revision->name);
	char *subtitle = strcmp(base, then) == 0 ?
		g_strdup_printf("%s · %s", revision->brief, revision->date) :
		g_strdup_printf("%s · %s · %s", revision->brief, revision->date, then);
	GtkWidget *row = row_new(dialog->revisions, revision->subject, subtitle);

	gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), TRUE);
	adw_action_row_set_title_lines(ADW_ACTION_ROW(row), 1);
	g_object_set_data_full(G_OBJECT(row), "hash", g_strdup(revision->hash), g_free);
	g_object_set_data_full(G_OBJECT(row), "file", g_strdup(revision->name), g_free);
	g_object_set_data_full(G_OBJECT(row), "name", g_strdup_printf("%s, %s, %s", then,
		revision->brief, revision->date), g_free);
	g_signal_connect(row, "activated", G_CALLBACK(revision_chosen), NULL);
	g_free(then);
	g_free(base);
	g_free(subtitle);
}

static void take(gpointer data, GPtrArray *revisions, const char *why)
{
	LadderCompareDialog *dialog = data;

	if (!revisions) {
		adw_preferences_row_set_title(ADW_PREFERENCES_ROW(dialog->reading), "");
		adw_preferences_row_set_use_markup(ADW_PREFERENCES_ROW(dialog->reading), FALSE);
		adw_preferences_row_set_title(ADW_PREFERENCES_ROW(dialog->reading), why);
		return;
	}
	adw_preferences_group_remove(ADW_PREFERENCES_GROUP(dialog->revisions),
				     dialog->reading);
	for (guint i = 0; i < revisions->len; i++)
		add_revision(dialog, revisions->pdata[i]);
	g_ptr_array_unref(revisions);
}

/* ---- the window ---- */

static void dispose(GObject *object)
{
	LadderCompareDialog *dialog = LADDER_COMPARE_DIALOG(object);

	if (dialog->cancel)
		g_cancellable_cancel(dialog->cancel);
	g_clear_object(&dialog->cancel);
	g_clear_pointer(&dialog->path, g_free);
	G_OBJECT_CLASS(ladder_compare_dialog_parent_class)->dispose(object);
}

static void ladder_compare_dialog_class_init(LadderCompareDialogClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
	const GType type = LADDER_TYPE_COMPARE_DIALOG;

	G_OBJECT_CLASS(class)->dispose = dispose;
	signals[SAVED] = g_signal_new("saved", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
				      G_TYPE_NONE, 0);
	signals[FILE_WANTED] = g_signal_new("file", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
					    NULL, G_TYPE_NONE, 0);
	signals[FILES_WANTED] = g_signal_new("files", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
					     NULL, G_TYPE_NONE, 0);
	signals[REVISION] = g_signal_new("revision", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
					 NULL, G_TYPE_NONE, 3, G_TYPE_STRING, G_TYPE_STRING,
					 G_TYPE_STRING);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_Escape, 0, "window.close", NULL);
}

static void ladder_compare_dialog_init(LadderCompareDialog *dialog)
{
	dialog->cancel = g_cancellable_new();
	gtk_window_set_title(GTK_WINDOW(dialog), _("Compare with"));
	gtk_window_set_titlebar(GTK_WINDOW(dialog), adw_header_bar_new());
	gtk_window_set_modal(GTK_WINDOW(dialog), TRUE);
	gtk_window_set_default_size(GTK_WINDOW(dialog), 560, 520);
}

static void fill(LadderCompareDialog *dialog)
{
	GtkWidget *page = adw_preferences_page_new(), *group = group_new(page, _("A file"));
	GtkWidget *row;
	char *base = dialog->path ? g_path_get_basename(dialog->path) : NULL;

	row = choice_new(group, _("The last saved state"), base ? base : _("not saved yet"),
			 G_CALLBACK(saved_chosen), dialog);
	gtk_widget_set_sensitive(row, base != NULL);
	choice_new(group, _("Another file…"), _("Rung files and ClassicLadder projects"),
		   G_CALLBACK(file_chosen), dialog);
	choice_new(group, _("Two other files…"), _("The older one first, then the newer one"),
		   G_CALLBACK(files_chosen), dialog);
	dialog->revisions = group_new(page, _("Revisions in git"));
	dialog->reading = row_new(dialog->revisions, base ? _("Asking git…") :
				  _("Only a saved file can have revisions."), "");
	gtk_window_set_child(GTK_WINDOW(dialog), page);
	if (dialog->path)
		git_log_read(dialog->path, dialog->cancel, take, dialog);
	g_free(base);
}

GtkWidget *ladder_compare_dialog_new(GtkWindow *parent, LadderDocument *document)
{
	LadderCompareDialog *dialog = g_object_new(LADDER_TYPE_COMPARE_DIALOG, "transient-for",
						   parent, NULL);

	dialog->path = g_strdup(ladder_document_path(document));
	fill(dialog);
	return GTK_WIDGET(dialog);
}
