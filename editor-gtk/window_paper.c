/* SPDX-License-Identifier: MIT
 *
 * window_paper - a project on paper: to a printer, into a PDF.
 *
 * The pages are print.c's. What cannot be written is told in a banner.
 */
#include "editor-gtk/window_inside.h"

#include "editor-gtk/chooser.h"
#include "editor-gtk/print.h"

static GtkPrintOperation *operation_new(LadderWindow *window)
{
	const struct project *project = ladder_document_project(window->document);
	const char *path = ladder_document_path(window->document);
	LadderGridView *sheet = tabs_sheet(window);
	char *file = path ? g_path_get_basename(path) : g_strdup("");
	GDateTime *now = g_date_time_new_now_local();
	char *date = g_date_time_format(now, "%x");
	GtkPrintOperation *operation;

	operation = print_operation_new(project, file, -1, sheet ?
					ladder_grid_view_show(sheet) : SHOW_BOTH, date);
	/* The operation asks for them again while it runs. */
	g_object_set_data_full(G_OBJECT(operation), "file", file, g_free);
	g_object_set_data_full(G_OBJECT(operation), "date", date, g_free);
	g_date_time_unref(now);
	return operation;
}

static void run(LadderWindow *window, GtkPrintOperation *operation,
		GtkPrintOperationAction action)
{
	GError *error = NULL;

	if (gtk_print_operation_run(operation, action, GTK_WINDOW(window), &error) ==
	    GTK_PRINT_OPERATION_RESULT_ERROR)
		ladder_window_warn(window, error->message);
	g_clear_error(&error);
	g_object_unref(operation);
}

void window_print(LadderWindow *window)
{
	if (ladder_document_project(window->document))
		run(window, operation_new(window), GTK_PRINT_OPERATION_ACTION_PRINT_DIALOG);
}

static void export_response(GtkNativeDialog *dialog, int response, LadderWindow *window)
{
	char *path = response == GTK_RESPONSE_ACCEPT ? window_chosen_path(dialog) : NULL;

	if (path && ladder_document_project(window->document)) {
		GtkPrintOperation *operation = operation_new(window);

		gtk_print_operation_set_export_filename(operation, path);
		run(window, operation, GTK_PRINT_OPERATION_ACTION_EXPORT);
		window_toast(window, path);
	}
	g_free(path);
	g_object_unref(dialog);
}

void window_export_pdf(LadderWindow *window)
{
	GtkFileChooserNative *chooser = gtk_file_chooser_native_new(_("Export as PDF"),
		GTK_WINDOW(window), GTK_FILE_CHOOSER_ACTION_SAVE, _("Export"), _("Cancel"));
	char *name = ladder_document_name(window->document);
	char *file = g_strdup_printf("%s.pdf", name);

	chooser_beside(chooser, window->document);
	gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), file);
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	g_signal_connect(chooser, "response", G_CALLBACK(export_response), window);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
	g_free(file);
	g_free(name);
}
