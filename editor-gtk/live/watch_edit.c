/* SPDX-License-Identifier: MIT
 *
 * watch_edit - what a person does to the charts: rows come, go, change places and names.
 *
 * Each is one step of the document's history; the view follows by what the document tells.
 */
#include "editor-gtk/live/watch_inside.h"

#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/live/watch_names.h"

#include <string.h>

/* ---- charts ---- */

struct watch *watch_edit(LadderWatchView *view, GPtrArray **charts)
{
	*charts = watch_list_of(view->document);
	return view->chart < (*charts)->len ? (*charts)->pdata[view->chart] : NULL;
}

/* @charts: taken over. */
static void keep(LadderWatchView *view, GPtrArray *charts, const char *step)
{
	watch_list_keep(view->document, charts, step);
	g_ptr_array_unref(charts);
	watch_refresh(view);
}

static bool is_taken(GPtrArray *charts, const char *name)
{
	for (guint i = 0; i < charts->len; i++)
		if (strcmp(((struct watch *)charts->pdata[i])->name, name) == 0)
			return true;
	return false;
}

static struct watch *add_chart(LadderWatchView *view, GPtrArray *charts)
{
	struct watch *chart;
	char *name = NULL;

	for (int number = 1; !name || is_taken(charts, name); number++) {
		g_free(name);
		name = g_strdup_printf(_("Chart %d"), number);
	}
	chart = watch_new(name);
	g_ptr_array_add(charts, chart);
	view->chart = charts->len - 1;
	g_free(view->chart_name);
	view->chart_name = name;
	return chart;
}

static void new_chart(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);
	GPtrArray *charts = watch_list_of(view->document);

	(void)action;
	(void)unused;
	add_chart(view, charts);
	keep(view, charts, _("New status chart"));
}

static void delete_chart(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);
	GPtrArray *charts;

	(void)action;
	(void)unused;
	if (watch_edit(view, &charts))
		g_ptr_array_remove_index(charts, view->chart);
	keep(view, charts, _("Delete status chart"));
}

/* ---- a line that is typed ---- */

enum asked { ASK_ADD, ASK_NAME, ASK_CHART };
struct ask {
	LadderWatchView *view;
	enum asked what;
	int row;             /* of ASK_NAME                                    */
};

static char *line_changed(void *context, const char *line, int cursor, bool *good)
{
	struct ask *ask = context;
	LadderWatchView *view = ask->view;
	struct image *room;

	(void)good;
	if (!view->popup || ask->what == ASK_CHART)
		return NULL; /* while it is made, it cannot be filled */
	room = g_new0(struct image, 1);
	watch_names_offer(view->document, watch_image(view->document, view->sim, room),
			  line, (gsize)(g_utf8_offset_to_pointer(line, cursor) - line),
			  LADDER_ENTRY_POPUP(view->popup));
	g_free(room);
	return NULL;
}

static void rename_row(LadderWatchView *view, int row, const char *name)
{
	GPtrArray *charts;
	struct watch *chart = watch_edit(view, &charts);
	struct watch_line *line = chart && row < (int)chart->lines->len ?
		chart->lines->pdata[row] : NULL;

	if (line) {
		g_free(line->name);
		line->name = g_strdup(name);
		line->format = WATCH_AUTO;
	}
	keep(view, charts, _("Another variable in the status chart"));
}

static void rename_chart(LadderWatchView *view, const char *name)
{
	GPtrArray *charts;
	struct watch *chart = watch_edit(view, &charts);
	char *plain = g_strstrip(g_strdup(name));

	if (chart && *plain && !is_taken(charts, plain)) {
		g_free(chart->name);
		chart->name = g_strdup(plain);
		g_free(view->chart_name);
		view->chart_name = g_strdup(plain);
	}
	keep(view, charts, _("Rename status chart"));
	g_free(plain);
}

static bool line_taken(void *context, const char *line)
{
	struct ask *ask = context;

	switch (ask->what) {
	case ASK_ADD: ladder_watch_view_add(ask->view, line); break;
	case ASK_NAME:
		if (*line)
			rename_row(ask->view, ask->row, line);
		break;
	case ASK_CHART: rename_chart(ask->view, line); break;
	}
	return true;
}

/* Its own signal is still under way. */
static void line_gone(void *context)
{
	struct ask *ask = context;

	if (ask->view->popup)
		popover_drop_later(ask->view->popup);
	ask->view->popup = NULL;
	gtk_widget_grab_focus(ask->view->list);
	g_free(ask);
}

static void ask_line(LadderWatchView *view, enum asked what, int row, const char *prompt,
		     const char *text, GtkWidget *at)
{
	struct ask *ask = g_new0(struct ask, 1);
	const struct entry_popup_calls calls = {
		.changed = line_changed, .taken = line_taken, .gone = line_gone,
		.context = ask,
	};
	GdkRectangle place = { 0, 0, 1, 1 };
	double x = 0, y = 0;

	*ask = (struct ask){ .view = view, .what = what, .row = row };
	if (view->popup) {
		g_free(ask);
		return;
	}
	if (at && gtk_widget_translate_coordinates(at, GTK_WIDGET(view), 0, 0, &x, &y))
		place = (GdkRectangle){ (int)x, (int)y, gtk_widget_get_width(at),
					gtk_widget_get_height(at) };
	view->popup = ladder_entry_popup_new(GTK_WIDGET(view), prompt, text, false, &calls);
	ladder_entry_popup_ask(LADDER_ENTRY_POPUP(view->popup));
	ladder_entry_popup_show(LADDER_ENTRY_POPUP(view->popup), &place);
}

static void ask_add(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);

	(void)action;
	(void)unused;
	ask_line(view, ASK_ADD, 0, _("Names and addresses, such as Motor %IW0 %Q0..7"), "",
		 view->add_button);
}

void watch_ask_name(LadderWatchView *view, LadderWatchRow *row)
{
	ask_line(view, ASK_NAME, watch_place(view, row), _("Name or address"),
		 row->line->name, row->value ? row->value : view->list);
}

static void ask_chart(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);

	(void)action;
	(void)unused;
	ask_line(view, ASK_CHART, 0, _("Name of the chart"),
		 view->chart_name ? view->chart_name : "", view->charts);
}

/* ---- rows ---- */

bool ladder_watch_view_add(LadderWatchView *view, const char *line)
{
	struct image *room = g_new0(struct image, 1);
	GPtrArray *names = watch_names_expand(watch_image(view->document, view->sim, room),
					      line);
	const int selected = watch_selected(view);
	GPtrArray *charts;
	struct watch *chart = watch_edit(view, &charts);
	const bool good = names->len > 0 && ladder_document_project(view->document);
	int at;

	if (good) {
		chart = chart ? chart : add_chart(view, charts);
		at = selected < 0 ? (int)chart->lines->len : selected + 1;
		for (guint i = 0; i < names->len; i++)
			g_ptr_array_insert(chart->lines, at + (int)i,
				watch_line_new(WATCH_AUTO, names->pdata[i], NULL));
		watch_list_keep(view->document, charts, _("Add to the status chart"));
		watch_refresh(view);
		watch_select(view, at + (int)names->len - 1);
	}
	g_ptr_array_unref(charts);
	g_ptr_array_unref(names);
	g_free(room);
	return good;
}

static void remove_row(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);
	const int at = watch_selected(view);
	GPtrArray *charts;
	struct watch *chart = watch_edit(view, &charts);

	(void)action;
	(void)unused;
	if (chart && at >= 0 && at < (int)chart->lines->len)
		g_ptr_array_remove_index(chart->lines, (guint)at);
	keep(view, charts, _("Remove from the status chart"));
	watch_select(view, at);
}

static void move_row(LadderWatchView *view, int by)
{
	const int at = watch_selected(view), to = at + by;
	GPtrArray *charts;
	struct watch *chart = watch_edit(view, &charts);

	if (!chart || at < 0 || to < 0 || to >= (int)chart->lines->len) {
		g_ptr_array_unref(charts);
		return;
	}
	g_ptr_array_insert(chart->lines, to, g_ptr_array_steal_index(chart->lines,
								     (guint)at));
	keep(view, charts, _("Move in the status chart"));
	watch_select(view, to);
}

static void row_up(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	move_row(LADDER_WATCH_VIEW(widget), -1);
}

static void row_down(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	move_row(LADDER_WATCH_VIEW(widget), 1);
}

static void set_format(GtkWidget *widget, const char *action, GVariant *to)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);
	GPtrArray *charts;
	struct watch *chart = watch_edit(view, &charts);
	int row, format;

	(void)action;
	g_variant_get(to, "(ii)", &row, &format);
	if (chart && row >= 0 && row < (int)chart->lines->len && format >= 0 &&
	    format < WATCH_FORMATS)
		((struct watch_line *)chart->lines->pdata[row])->format =
			(enum watch_format)format;
	keep(view, charts, _("Shown in another way"));
}

void watch_set_comment(LadderWatchView *view, LadderWatchRow *row, const char *text)
{
	const int at = watch_place(view, row);
	GPtrArray *charts;
	struct watch *chart;

	if (at < 0 || strcmp(text, row->line->comment) == 0)
		return;
	chart = watch_edit(view, &charts);
	if (chart && at < (int)chart->lines->len) {
		struct watch_line *line = chart->lines->pdata[at];

		g_free(line->comment);
		line->comment = g_strdup(text);
	}
	keep(view, charts, _("Comment in the status chart"));
}

static void write_all(GtkWidget *widget, const char *action, GVariant *unused)
{
	(void)action;
	(void)unused;
	watch_write_all(LADDER_WATCH_VIEW(widget));
}

void watch_install_actions(GtkWidgetClass *class)
{
	gtk_widget_class_install_action(class, "watch.add", NULL, ask_add);
	gtk_widget_class_install_action(class, "watch.remove", NULL, remove_row);
	gtk_widget_class_install_action(class, "watch.up", NULL, row_up);
	gtk_widget_class_install_action(class, "watch.down", NULL, row_down);
	gtk_widget_class_install_action(class, "watch.format", "(ii)", set_format);
	gtk_widget_class_install_action(class, "watch.new-chart", NULL, new_chart);
	gtk_widget_class_install_action(class, "watch.rename-chart", NULL, ask_chart);
	gtk_widget_class_install_action(class, "watch.delete-chart", NULL, delete_chart);
	gtk_widget_class_install_action(class, "watch.write-all", NULL, write_all);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Insert, 0, "watch.add", NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Delete, 0, "watch.remove", NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Up, GDK_ALT_MASK, "watch.up",
					    NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Down, GDK_ALT_MASK, "watch.down",
					    NULL);
}
