/* SPDX-License-Identifier: MIT
 *
 * window_paper - a project on paper: to a printer, into a PDF.
 *
 * The pages are print.c's. What cannot be written is told in a banner; a PDF is there whole,
 * or what was there stays.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/draw/print.h"
#include "editor-gtk/panels/problems.h"

#include <errno.h>

/* What is printed, and how: the title block and what stands above elements. */
struct printing {
	const struct project *project;
	char *file, *date;
	enum drafting_show show;
};

static struct printing printing_of(LadderWindow *window)
{
	const char *path = ladder_document_path(window->document);
	LadderGridView *sheet = tabs_sheet(window);
	GDateTime *now = g_date_time_new_now_local();
	const struct printing printing = {
		.project = ladder_document_project(window->document),
		.file = path ? g_path_get_basename(path) : g_strdup(""),
		.date = g_date_time_format(now, "%x"),
		.show = sheet ? ladder_grid_view_show(sheet) : SHOW_BOTH,
	};

	g_date_time_unref(now);
	return printing;
}

/* A file that is open as text has no pages: the panel shows what is wrong with it. */
static bool has_pages(LadderWindow *window)
{
	if (ladder_document_project(window->document))
		return true;
	window_toast(window, _("There is nothing to print: the file cannot be read as a "
			       "program."));
	ladder_problems_show_error(LADDER_PROBLEMS(below_show(window, "problems")));
	return false;
}

/* ---- to a printer ---- */

static GtkPrintOperation *operation_new(LadderWindow *window)
{
	const struct printing printing = printing_of(window);
	GtkPrintOperation *operation = print_operation_new(printing.project, printing.file,
							   -1, printing.show, printing.date);

	/* The operation asks for them again while it runs. */
	g_object_set_data_full(G_OBJECT(operation), "file", printing.file, g_free);
	g_object_set_data_full(G_OBJECT(operation), "date", printing.date, g_free);
	return operation;
}

void window_print(LadderWindow *window)
{
	GtkPrintOperation *operation;
	GError *error = NULL;

	if (!has_pages(window))
		return;
	operation = operation_new(window);
	if (gtk_print_operation_run(operation, GTK_PRINT_OPERATION_ACTION_PRINT_DIALOG,
				    GTK_WINDOW(window), &error) ==
	    GTK_PRINT_OPERATION_RESULT_ERROR)
		ladder_window_warn(window, error->message);
	g_clear_error(&error);
	g_object_unref(operation);
}

/* ---- into a PDF ---- */

static GBytes *pdf_of(LadderWindow *window)
{
	struct printing printing = printing_of(window);
	GBytes *pdf = print_pdf(printing.project, printing.file, printing.show,
				printing.date);

	g_free(printing.file);
	g_free(printing.date);
	return pdf;
}

static bool save_pdf(const char *path, GBytes *pdf, GError **error)
{
	if (pdf)
		return disk_save(path, g_bytes_get_data(pdf, NULL), g_bytes_get_size(pdf),
				 error);
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_NOMEM, "%s: %s", path,
		    g_strerror(ENOMEM));
	return false;
}

static void export_to(LadderWindow *window, const char *path)
{
	GBytes *pdf = pdf_of(window);
	GError *error = NULL;

	if (save_pdf(path, pdf, &error)) {
		if (window->banner_do == window_export_pdf) /* it told of one before */
			window_banner_close(window);
		window_toast(window, path);
	} else {
		window_banner(window, error->message, _("Save as…"), window_export_pdf);
	}
	g_clear_error(&error);
	g_bytes_unref(pdf);
}

void window_export_pdf(LadderWindow *window)
{
	if (has_pages(window))
		window_ask_where(window, _("Export as PDF"), ".pdf", export_to);
}
