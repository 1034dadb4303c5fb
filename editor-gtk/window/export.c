/* SPDX-License-Identifier: MIT
 *
 * export - writes files beside the program, and prints; see export.h.
 */
#include "editor-gtk/window/export.h"

#include "editor-gtk/document/csv.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/draw/print.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/preview_view.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <errno.h>
#include <string.h>

/* ---- a name that gets its ending here ---- */

struct named {
	char *path;
	export_write *write;
	gpointer part;
};

static void named_free(gpointer data, GClosure *closure)
{
	struct named *named = data;

	(void)closure;
	g_free(named->path);
	g_free(named);
}

static void replace_answered(AdwMessageDialog *dialog, const char *answer,
			     struct named *named)
{
	(void)dialog;
	if (g_strcmp0(answer, "replace") == 0)
		named->write(named->part, named->path);
}

static void ask_replace(struct core *core, struct named *named)
{
	char *name = g_path_get_basename(named->path);
	char *body = g_strdup_printf(_("“%s” already exists."), name);
	AdwMessageDialog *dialog = ask_new(core->window, _("Replace the file?"), body,
		"replace", _("Replace"), ADW_RESPONSE_DESTRUCTIVE);

	adw_message_dialog_set_default_response(dialog, "cancel");
	g_signal_connect_data(dialog, "response", G_CALLBACK(replace_answered), named,
			      named_free, 0);
	gtk_window_present(GTK_WINDOW(dialog));
	g_free(body);
	g_free(name);
}

/* Does @path end in one of @endings, which `|` separates? */
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

/* The first of @endings. Caller frees. */
static char *ending_of(const char *endings)
{
	return g_strndup(endings, strcspn(endings, "|"));
}

void export_named(struct core *core, const char *path, const char *endings,
		  export_write *write, gpointer part)
{
	const bool has = has_ending(path, endings);
	struct named *named = g_new(struct named, 1);
	char *ending = ending_of(endings);

	*named = (struct named){ g_strconcat(path, has ? NULL : ending, NULL), write, part };
	g_free(ending);
	if (!has && g_file_test(named->path, G_FILE_TEST_EXISTS)) {
		ask_replace(core, named);
		return;
	}
	write(part, named->path);
	named_free(named, NULL);
}

/* ---- asking where ---- */

/* Data of the open file chooser. */
struct asked {
	struct core *core;
	const char *endings;
	export_write *write;
	gpointer part;
};

static void asked_free(gpointer asked, GClosure *closure)
{
	(void)closure;
	g_free(asked);
}

static void where_answered(GtkNativeDialog *dialog, int response, struct asked *asked)
{
	char *path = ask_take_path(dialog, response);

	if (path)
		export_named(asked->core, path, asked->endings, asked->write, asked->part);
	g_free(path);
}

GtkFileChooser *export_ask(struct export *export, const char *title, const char *endings,
			   export_write *write, gpointer part)
{
	struct core *core = export->core;
	GtkFileChooserNative *chooser = gtk_file_chooser_native_new(title, core->window,
		GTK_FILE_CHOOSER_ACTION_SAVE, _("Save"), _("Cancel"));
	char *ending = ending_of(endings), *name = origin_name(export->origin, ending);
	struct asked *asked = g_new(struct asked, 1);

	*asked = (struct asked){ core, endings, write, part };
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	panel_choose_beside(chooser, core->document);
	gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), name);
	g_signal_connect_data(chooser, "response", G_CALLBACK(where_answered), asked,
			      asked_free, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
	g_free(name);
	g_free(ending);
	return GTK_FILE_CHOOSER(chooser);
}

/* ---- tables of symbols ---- */

static void symbols_to(gpointer part, const char *path)
{
	struct export *export = part;
	struct messages *messages = export->core->messages;
	int count;
	char *table = csv_export(export->core->document, &count), *told;
	GError *error = NULL;

	if (disk_save(path, table, strlen(table), &error)) {
		messages_close_offer(messages, "win.export_symbols");
		told = g_strdup_printf(ngettext("Exported %d symbol to %s",
			"Exported %d symbols to %s", (gulong)count), count, path);
		messages_toast(messages, told);
		g_free(told);
	} else {
		messages_banner(messages, LOG_SYSTEM, error->message, _("Save as…"),
				"win.export_symbols");
	}
	g_clear_error(&error);
	g_free(table);
}

void export_symbols(struct export *export)
{
	if (ladder_document_project(export->core->document))
		export_ask(export, _("Export symbols"), ".csv|.txt", symbols_to, export);
	else
		messages_toast(export->core->messages, _("The file cannot be read as a program. Correct its errors first"));
}

/* ---- on paper ---- */

/* The contents of a print: project, title block, and what is shown above elements. */
struct printing {
	const struct project *project;
	char *file, *date;
	enum drafting_show show;
};

static struct printing printing_of(struct export *export)
{
	const char *path = ladder_document_path(export->core->document);
	LadderGridView *sheet = front_sheet(export->core->front);
	GDateTime *now = g_date_time_new_now_local();
	const struct printing printing = {
		.project = ladder_document_project(export->core->document),
		.file = path ? g_path_get_basename(path) : g_strdup(""),
		.date = g_date_time_format(now, "%x"),
		.show = sheet ? ladder_grid_view_show(sheet) : SHOW_BOTH,
	};

	g_date_time_unref(now);
	return printing;
}

/* False: the file is open as text only; shows its problems. */
static bool has_pages(struct export *export)
{
	if (ladder_document_project(export->core->document))
		return true;
	messages_toast(export->core->messages, _("There is nothing to print: the file cannot be "
						 "read as a program."));
	below_show_error(export->core->below);
	return false;
}

static GtkPrintOperation *operation_new(struct export *export)
{
	const struct printing printing = printing_of(export);
	GtkPrintOperation *operation = print_operation_new(printing.project, printing.file,
							   -1, printing.show, printing.date);

	gtk_print_operation_set_default_page_setup(operation, export->core->paper);
	/* the operation borrows both while it runs */
	g_object_set_data_full(G_OBJECT(operation), "file", printing.file, g_free);
	g_object_set_data_full(G_OBJECT(operation), "date", printing.date, g_free);
	return operation;
}

static gboolean end_preview(gpointer operation)
{
	gtk_print_operation_preview_end_preview(GTK_PRINT_OPERATION_PREVIEW(operation));
	g_object_unref(operation);
	return G_SOURCE_REMOVE;
}

/* GTK requires one from the handler of "preview", even if nothing is drawn on it. */
static void give_canvas(GtkPrintContext *context)
{
	cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1, 1);
	cairo_t *canvas = cairo_create(surface);

	gtk_print_context_set_cairo_context(context, canvas, 72, 72);
	cairo_destroy(canvas);
	cairo_surface_destroy(surface);
}

void export_preview(struct export *export)
{
	if (has_pages(export))
		tabs_show_widget(export->core->tabs, "preview");
}

/* *Preview* of the print dialog, with its paper. Returns true: GTK then shows none of
 * its own. */
static gboolean preview(GtkPrintOperation *operation, GtkPrintOperationPreview *pages,
			GtkPrintContext *context, GtkWindow *parent, struct export *export)
{
	GtkPageSetup *chosen = gtk_print_context_get_page_setup(context);
	GtkPageSetup *paper = export->core->paper;

	(void)pages;
	(void)parent;
	gtk_page_setup_set_paper_size(paper, gtk_page_setup_get_paper_size(chosen));
	gtk_page_setup_set_orientation(paper, gtk_page_setup_get_orientation(chosen));
	ladder_preview_view_again(LADDER_PREVIEW_VIEW(tabs_show_widget(export->core->tabs,
								       "preview")));
	give_canvas(context);
	g_idle_add(end_preview, g_object_ref(operation));
	return TRUE;
}

void export_print(struct export *export)
{
	GtkPrintOperation *operation;
	GError *error = NULL;

	if (!has_pages(export))
		return;
	operation = operation_new(export);
	core_connect(export->core, operation, "preview", G_CALLBACK(preview), export, 0);
	if (gtk_print_operation_run(operation, GTK_PRINT_OPERATION_ACTION_PRINT_DIALOG,
				    export->core->window, &error) ==
	    GTK_PRINT_OPERATION_RESULT_ERROR)
		messages_warn(export->core->messages, error->message);
	g_clear_error(&error);
	g_object_unref(operation);
}

static GBytes *pdf_of(struct export *export)
{
	struct printing printing = printing_of(export);
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
	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_NOMEM, _("%s: %s"), path,
		    g_strerror(ENOMEM));
	return false;
}

static void pdf_to(gpointer part, const char *path)
{
	struct export *export = part;
	struct messages *messages = export->core->messages;
	GBytes *pdf = pdf_of(export);
	GError *error = NULL;

	if (save_pdf(path, pdf, &error)) {
		messages_close_offer(messages, "win.export_pdf");
		messages_toast(messages, path);
	} else {
		messages_banner(messages, LOG_SYSTEM, error->message, _("Save as…"),
				"win.export_pdf");
	}
	g_clear_error(&error);
	g_bytes_unref(pdf);
}

void export_pdf(struct export *export)
{
	if (has_pages(export))
		export_ask(export, _("Export as PDF"), ".pdf", pdf_to, export);
}

void export_init(struct export *export, struct core *core, struct origin *origin)
{
	*export = (struct export){ core, origin };
}
