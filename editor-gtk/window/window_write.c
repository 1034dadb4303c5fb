/* SPDX-License-Identifier: MIT
 *
 * window_write - files that a window writes beside its program: where, under which name,
 * and over what. Saving the program itself is window_file.c's.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/document/csv.h"
#include "editor-gtk/document/disk.h"

#include <string.h>

/* ---- a name that gets its ending here ---- */

struct named {
	LadderWindow *window;
	char *path;
	void (*save)(LadderWindow *window, const char *path);
};

static void named_free(gpointer data, GClosure *closure)
{
	struct named *named = data;

	(void)closure;
	g_free(named->path);
	g_free(named);
}

static void replace_response(AdwMessageDialog *dialog, const char *response,
			     struct named *named)
{
	(void)dialog;
	if (g_strcmp0(response, "replace") == 0)
		named->save(named->window, named->path);
	else
		named->window->closing = false;
}

static void ask_replace(struct named *named)
{
	GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(named->window),
						   _("Replace the file?"), NULL);
	AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);
	char *name = g_path_get_basename(named->path);

	adw_message_dialog_format_body(message, _("“%s” is there already."), name);
	adw_message_dialog_add_responses(message, "cancel", _("Cancel"), "replace",
					 _("Replace"), NULL);
	adw_message_dialog_set_response_appearance(message, "replace",
						   ADW_RESPONSE_DESTRUCTIVE);
	adw_message_dialog_set_default_response(message, "cancel");
	adw_message_dialog_set_close_response(message, "cancel");
	g_signal_connect_data(dialog, "response", G_CALLBACK(replace_response), named,
			      named_free, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(name);
}

/* Has it one of them, parted by `|`? */
static bool has_ending(const char *path, const char *endings)
{
	char *name = g_path_get_basename(path), *lower = g_utf8_strdown(name, -1);
	char **ending = g_strsplit(endings, "|", -1);
	bool found = false;

	for (int i = 0; ending[i] && !found; i++)
		found = g_str_has_suffix(lower, ending[i]);
	g_strfreev(ending);
	g_free(lower);
	g_free(name);
	return found;
}

/* The first one. Caller frees. */
static char *ending_of(const char *endings)
{
	return g_strndup(endings, strcspn(endings, "|"));
}

void window_save_named(LadderWindow *window, const char *path, const char *endings,
		       window_write *save)
{
	const bool has = has_ending(path, endings);
	struct named *named = g_new(struct named, 1);
	char *ending = ending_of(endings);

	*named = (struct named){ window, g_strconcat(path, has ? NULL : ending, NULL), save };
	g_free(ending);
	if (!has && g_file_test(named->path, G_FILE_TEST_EXISTS)) {
		ask_replace(named);
		return;
	}
	save(window, named->path);
	named_free(named, NULL);
}

/* ---- asking where ---- */

char *window_name_with(LadderWindow *window, const char *ending)
{
	const char *path = ladder_document_path(window->document);
	char *name, *dot;

	if (!path && window->classic)
		path = ladder_origin_path(window->classic);
	if (!path)
		path = window_sample(window);
	name = path ? g_path_get_basename(path) : g_strdup("program");
	dot = strrchr(name, '.');
	if (dot && dot != name)
		*dot = '\0';
	dot = g_strconcat(name, ending, NULL);
	g_free(name);
	return dot;
}

/* What is asked for while the dialog is open. */
struct asked {
	LadderWindow *window;
	const char *endings;
	window_write *save;
};

static void asked_free(gpointer asked, GClosure *closure)
{
	(void)closure;
	g_free(asked);
}

static void where_response(GtkNativeDialog *dialog, int response, struct asked *asked)
{
	char *path = response == GTK_RESPONSE_ACCEPT ? window_chosen_path(dialog) : NULL;

	if (path)
		window_save_named(asked->window, path, asked->endings, asked->save);
	g_free(path);
	g_object_unref(dialog);
}

GtkFileChooser *window_ask_where(LadderWindow *window, const char *title,
				 const char *endings, window_write *save)
{
	GtkFileChooserNative *chooser = gtk_file_chooser_native_new(title,
		GTK_WINDOW(window), GTK_FILE_CHOOSER_ACTION_SAVE, _("Save"), _("Cancel"));
	char *ending = ending_of(endings), *name = window_name_with(window, ending);
	struct asked *asked = g_new(struct asked, 1);

	*asked = (struct asked){ window, endings, save };
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	panel_choose_beside(chooser, window->document);
	gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), name);
	g_signal_connect_data(chooser, "response", G_CALLBACK(where_response), asked,
			      asked_free, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
	g_free(name);
	g_free(ending);
	return GTK_FILE_CHOOSER(chooser);
}

/* ---- tables of symbols ---- */

static void symbols_to(LadderWindow *window, const char *path)
{
	int count;
	char *table = csv_export(window->document, &count), *told;
	GError *error = NULL;

	if (disk_save(path, table, strlen(table), &error)) {
		if (window->banner_do == window_export_symbols) /* it told of one before */
			window_banner_close(window);
		told = g_strdup_printf(ngettext("%d symbol is in %s now",
			"%d symbols are in %s now", (gulong)count), count, path);
		window_toast(window, told);
		g_free(told);
	} else {
		window_banner(window, error->message, _("Save as…"), window_export_symbols);
	}
	g_clear_error(&error);
	g_free(table);
}

void window_export_symbols(LadderWindow *window)
{
	if (ladder_document_project(window->document))
		window_ask_where(window, _("Export symbols"), ".csv|.txt", symbols_to);
	else
		window_toast(window, _("The file cannot be read as a program"));
}
