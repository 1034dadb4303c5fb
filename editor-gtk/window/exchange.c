/* SPDX-License-Identifier: MIT
 *
 * exchange - import from and export to ClassicLadder; see exchange.h.
 */
#include "editor-gtk/window/exchange.h"

#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/report_lines.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/report_view.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"

#define REPORT_ROOM 300 /* px that the panel gets at most                       */
#define SHEETS      2   /* times as high as the report are the sheets           */

static LadderReportView *view_of(struct exchange *exchange)
{
	return LADDER_REPORT_VIEW(below_panel(exchange->core->below, "report"));
}

/* ---- the panel ---- */

static void show_panel(struct exchange *exchange)
{
	below_offer(exchange->core->below, "report", true);
	below_show(exchange->core->below, "report");
	below_share_room(exchange->core->below, REPORT_ROOM, SHEETS);
}

static void close_panel(struct exchange *exchange)
{
	below_show(exchange->core->below, "problems");
	below_offer(exchange->core->below, "report", false);
	front_enter_program(exchange->core->front);
}

static void follow(struct exchange *exchange)
{
	LadderGridView *sheet = front_sheet(exchange->core->front);
	LadderFbdView *networks = front_networks(exchange->core->front);

	if (networks) {
		ladder_report_view_follow(view_of(exchange), ladder_canvas_pou(LADDER_CANVAS(networks)),
					  ladder_fbd_view_network(networks));
		return;
	}
	ladder_report_view_follow(view_of(exchange),
		sheet ? ladder_canvas_pou(LADDER_CANVAS(sheet)) : -1,
		sheet ? ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung : -1);
}

void exchange_show(struct exchange *exchange)
{
	if (!below_made(exchange->core->below, "report") ||
	    !ladder_report_view_has(view_of(exchange))) {
		messages_tell(exchange->core->messages, _("There is no report: nothing was "
							  "imported from another tool or "
							  "exported for one."));
		return;
	}
	show_panel(exchange);
	follow(exchange);
	ladder_report_view_focus(view_of(exchange));
}

static void cursor_moved(struct exchange *exchange)
{
	GtkWidget *view = below_made(exchange->core->below, "report");

	if (view && gtk_widget_get_mapped(view))
		follow(exchange);
}

void exchange_show_original(struct exchange *exchange)
{
	if (!exchange->origin->classic) {
		messages_tell(exchange->core->messages, _("This project was not imported "
							  "from another tool."));
		return;
	}
	ladder_report_view_import(view_of(exchange), exchange->origin->classic);
	show_panel(exchange);
	follow(exchange);
	front_enter_program(exchange->core->front);
}

static GtkWidget *panel_new(gpointer data)
{
	struct exchange *exchange = data;
	GtkWidget *view = ladder_report_view_new(exchange->core->document);

	core_connect(exchange->core, view, "close-wanted", G_CALLBACK(close_panel), exchange,
		     G_CONNECT_SWAPPED);
	return view;
}

void exchange_imported(struct exchange *exchange)
{
	ladder_report_view_import(view_of(exchange), exchange->origin->classic);
	below_offer(exchange->core->below, "report", true);
	messages_banner(exchange->core->messages, LOG_SYSTEM,
			ladder_report_view_title(view_of(exchange)), _("Show report"),
			"win.show_report");
}

/* ---- writing one ---- */

/* Shows the report of an export in place of that of the import. */
static void tell_export(struct exchange *exchange, const char *path, GPtrArray *lines)
{
	char *name = g_path_get_basename(path);

	if (lines->len || !exchange->origin->classic)
		ladder_report_view_export(view_of(exchange), name, lines);
	else
		ladder_report_view_import(view_of(exchange), exchange->origin->classic);
	g_free(name);
}

static void tell_written(struct exchange *exchange, const char *path, guint changed)
{
	char *name = g_path_get_basename(path);
	char *text = changed ?
		g_strdup_printf(ngettext("Exported %s for ClassicLadder; %u item has another "
					 "meaning there.",
					 "Exported %s for ClassicLadder; %u items have "
					 "another meaning there.", changed), name, changed) :
		g_strdup_printf(_("Exported %s for ClassicLadder."), name);

	if (changed)
		messages_banner(exchange->core->messages, LOG_SYSTEM, text, _("Show report"),
				"win.show_report");
	else
		messages_toast(exchange->core->messages, text);
	g_free(text);
	g_free(name);
}

bool exchange_export_to(struct exchange *exchange, const char *path)
{
	GPtrArray *lines = g_ptr_array_new_with_free_func(left_line_free);
	GError *error = NULL;
	const bool good = classic_save(exchange->core->document, path, lines, &error);

	tell_export(exchange, path, lines);
	if (good) {
		messages_close_banner(exchange->core->messages);
		tell_written(exchange, path, lines->len);
	} else {
		messages_banner(exchange->core->messages, LOG_SYSTEM, error->message,
				lines->len ? _("Show report") : NULL,
				lines->len ? "win.show_report" : NULL);
		if (lines->len)
			exchange_show(exchange);
	}
	g_clear_error(&error);
	g_ptr_array_unref(lines);
	return good;
}

/* ---- asking where ---- */

void exchange_add_filter(GtkFileChooser *chooser, bool numbers, bool chosen)
{
	GtkFileFilter *filter = gtk_file_filter_new();

	gtk_file_filter_set_name(filter, "ClassicLadder (*.clprj, *.clprjz, *.clp)");
	gtk_file_filter_add_pattern(filter, "*.clprj");
	gtk_file_filter_add_pattern(filter, "*.clprjz");
	gtk_file_filter_add_pattern(filter, "*.clp");
	if (numbers)
		gtk_file_filter_add_pattern(filter, "*.txt");
	gtk_file_chooser_add_filter(chooser, filter);
	if (chosen)
		gtk_file_chooser_set_filter(chooser, filter);
	g_object_unref(filter);
}

void exchange_add_others(GtkFileChooser *chooser)
{
	static const char *const others[][2] = {
		{ "LDmicro (*.ld)", "*.ld" },
		{ "PLCopen XML (*.xml)", "*.xml" },
		{ "OpenPLC Editor 4 (project.json)", "project.json" },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(others); i++) {
		GtkFileFilter *filter = gtk_file_filter_new();

		gtk_file_filter_set_name(filter, others[i][0]);
		gtk_file_filter_add_pattern(filter, others[i][1]);
		gtk_file_chooser_add_filter(chooser, filter);
		g_object_unref(filter);
	}
}

static void export_chosen(gpointer exchange, const char *path)
{
	exchange_export_to(exchange, path);
}

void exchange_export(struct exchange *exchange)
{
	GtkFileChooser *chooser = export_ask(exchange->export,
		_("Export as ClassicLadder"), ".clprj|.*", export_chosen, exchange);

	exchange_add_filter(chooser, true, true);
}

void exchange_init(struct exchange *exchange, struct core *core, struct origin *origin,
		 struct export *export)
{
	*exchange = (struct exchange){ core, origin, export };
	below_add(core->below, "report", N_("Report"), panel_new, exchange);
	below_offer(core->below, "report", false);
	core_connect(core, core->window, "cursor-moved", G_CALLBACK(cursor_moved), exchange,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->window, "page-changed", G_CALLBACK(cursor_moved), exchange,
		     G_CONNECT_SWAPPED);
}
