/* SPDX-License-Identifier: MIT
 *
 * window_classic - a project that came from ClassicLadder, or goes there: its report, the
 * originals of its rungs, and writing it. A document that is exported is not saved by that.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/report_lines.h"
#include "editor-gtk/panels/report_view.h"

#include <string.h>

#define REPORT_ROOM 300 /* px that the panel gets at least, if there is room    */
#define SHEET_ROOM  180

static LadderReportView *report_of(LadderWindow *window)
{
	return LADDER_REPORT_VIEW(below_panel(window, "report"));
}

/* ---- the panel ---- */

static void make_room(LadderWindow *window)
{
	const int height = gtk_widget_get_height(GTK_WIDGET(window->below_paned));
	const int most = MAX(height - REPORT_ROOM, SHEET_ROOM);

	if (height && gtk_paned_get_position(window->below_paned) > most)
		gtk_paned_set_position(window->below_paned, most);
}

static void show_panel(LadderWindow *window)
{
	below_offer(window, "report", true);
	below_show(window, "report");
	make_room(window);
}

static void close_panel(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);

	gtk_stack_set_visible_child_name(window->below_stack, "problems");
	below_offer(window, "report", false);
	if (sheet)
		gtk_widget_grab_focus(GTK_WIDGET(sheet));
}

static void follow(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);

	if (sheet)
		ladder_report_view_follow(report_of(window), ladder_grid_view_pou(sheet),
					  ladder_grid_view_cursor(sheet).rung, true);
}

void window_show_report(LadderWindow *window)
{
	if (!below_made(window, "report") || !ladder_report_view_has(report_of(window))) {
		ladder_window_tell(window, _("Nothing was taken from ClassicLadder or "
					     "written for it."));
		return;
	}
	show_panel(window);
	follow(window);
	ladder_report_view_focus(report_of(window));
}

void window_follow_original(LadderWindow *window)
{
	GtkWidget *report = below_made(window, "report");

	if (report && gtk_widget_get_mapped(report))
		follow(window);
}

void window_show_original(LadderWindow *window)
{
	LadderGridView *sheet = tabs_sheet(window);

	if (!window->classic) {
		ladder_window_tell(window, _("Nothing of this project was taken from "
					     "ClassicLadder."));
		return;
	}
	ladder_report_view_import(report_of(window), window->classic);
	show_panel(window);
	follow(window);
	if (sheet)
		gtk_widget_grab_focus(GTK_WIDGET(sheet));
}

GtkWidget *window_report_new(LadderWindow *window)
{
	GtkWidget *report = ladder_report_view_new(window->document);

	g_signal_connect_object(report, "close-wanted", G_CALLBACK(close_panel), window,
				G_CONNECT_SWAPPED);
	return report;
}

void ladder_window_set_classic(LadderWindow *window, LadderOrigin *origin)
{
	g_set_object(&window->classic, origin);
	ladder_report_view_import(report_of(window), origin);
	below_offer(window, "report", true);
	window_banner(window, ladder_report_view_title(report_of(window)), _("Show report"),
		      window_show_report);
}

/* "pump.rung": "pump.io". Caller frees. */
static char *map_beside(const char *path)
{
	const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
	const gsize len = dot && dot > slash + 1 ? (gsize)(dot - path) : strlen(path);

	return g_strdup_printf("%.*s.io", (int)len, path);
}

void window_classic_saved(LadderWindow *window)
{
	const char *io = window->classic ? ladder_origin_io(window->classic) : NULL;
	char *path = io ? map_beside(ladder_document_path(window->document)) : NULL;
	GError *error = NULL;

	if (io && !g_file_test(path, G_FILE_TEST_EXISTS)) {
		char *name = g_path_get_basename(path);
		char *text = g_strdup_printf(_("Saved, and the I/O map beside it: %s"), name);

		if (disk_save(path, io, strlen(io), &error))
			window_toast(window, text);
		else
			ladder_window_warn(window, error->message);
		g_free(text);
		g_free(name);
	}
	g_clear_error(&error);
	g_free(path);
}

/* ---- writing one ---- */

/* In the place of the import's, which comes again with an original. */
static void tell_export(LadderWindow *window, const char *path, GPtrArray *lines)
{
	char *name = g_path_get_basename(path);

	if (lines->len || !window->classic)
		ladder_report_view_export(report_of(window), name, lines);
	else
		ladder_report_view_import(report_of(window), window->classic);
	g_free(name);
}

static void tell_written(LadderWindow *window, const char *path, guint changed)
{
	char *name = g_path_get_basename(path);
	char *text = changed ?
		g_strdup_printf(ngettext("%s was written for ClassicLadder; %u thing means "
					 "something else there.",
					 "%s was written for ClassicLadder; %u things mean "
					 "something else there.", changed), name, changed) :
		g_strdup_printf(_("%s was written for ClassicLadder."), name);

	if (changed)
		window_banner(window, text, _("Show report"), window_show_report);
	else
		window_toast(window, text);
	g_free(text);
	g_free(name);
}

bool window_export_to(LadderWindow *window, const char *path)
{
	GPtrArray *lines = g_ptr_array_new_with_free_func(left_line_free);
	GError *error = NULL;
	const bool good = classic_save(window->document, path, lines, &error);

	tell_export(window, path, lines);
	if (good) {
		window_banner_close(window);
		tell_written(window, path, lines->len);
	} else {
		window_banner(window, error->message,
			      lines->len ? _("Show report") : NULL, window_show_report);
		if (lines->len)
			window_show_report(window);
	}
	g_clear_error(&error);
	g_ptr_array_unref(lines);
	return good;
}

/* ---- asking where ---- */

void window_classic_filter(GtkFileChooser *chooser, bool numbers)
{
	GtkFileFilter *filter = gtk_file_filter_new();

	gtk_file_filter_set_name(filter, "ClassicLadder (*.clprj, *.clprjz, *.clp)");
	gtk_file_filter_add_pattern(filter, "*.clprj");
	gtk_file_filter_add_pattern(filter, "*.clprjz");
	gtk_file_filter_add_pattern(filter, "*.clp");
	if (numbers)
		gtk_file_filter_add_pattern(filter, "*.txt");
	gtk_file_chooser_add_filter(chooser, filter);
	if (numbers)
		gtk_file_chooser_set_filter(chooser, filter);
	g_object_unref(filter);
}

static void export_chosen(LadderWindow *window, const char *path)
{
	window_export_to(window, path);
}

void window_export_classic(LadderWindow *window)
{
	GtkFileChooser *chooser = window_ask_where(window, _("Export as ClassicLadder"),
						   ".clprj|.*", export_chosen);

	window_classic_filter(chooser, true);
}
