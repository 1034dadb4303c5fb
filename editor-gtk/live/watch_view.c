/* SPDX-License-Identifier: MIT
 *
 * watch_view - the status chart: which rows there are, and looking at their values.
 *
 * A scan that was shown costs a comparison for each row of the chart; only cells whose
 * value is another are touched. Unseen it does nothing.
 */
#include "editor-gtk/live/watch_inside.h"

#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/gtk48/list.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderWatchView, ladder_watch_view, GTK_TYPE_WIDGET)

/* ---- rows ---- */

LadderWatchRow *watch_row_at(LadderWatchView *view, guint at)
{
	return g_list_model_get_item(G_LIST_MODEL(view->store), at);
}

int watch_place(LadderWatchView *view, LadderWatchRow *row)
{
	guint at;

	return g_list_store_find(view->store, row, &at) ? (int)at : -1;
}

int watch_selected(LadderWatchView *view)
{
	const guint at = gtk_single_selection_get_selected(view->selection);

	return at == GTK_INVALID_LIST_POSITION ? -1 : (int)at;
}

void watch_select(LadderWatchView *view, int at)
{
	const int count = (int)g_list_model_get_n_items(G_LIST_MODEL(view->store));

	at = MIN(at, count - 1);
	gtk_single_selection_set_selected(view->selection, at < 0 ?
					  GTK_INVALID_LIST_POSITION : (guint)at);
	if (at >= 0)
		list_scroll_to(view->list, (guint)at);
}

GListModel *ladder_watch_view_list(LadderWatchView *view)
{
	return G_LIST_MODEL(view->store);
}

/* ---- messages ---- */

void watch_tell(LadderWatchView *view, char *text)
{
	gtk_label_set_text(GTK_LABEL(view->message), text ? text : "");
	gtk_revealer_set_reveal_child(GTK_REVEALER(view->bar), text != NULL);
	g_free(text);
}

const char *ladder_watch_view_message(LadderWatchView *view)
{
	return gtk_label_get_text(GTK_LABEL(view->message));
}

/* ---- what the charts of the project are ---- */

static const char *shown_name(const struct watch *chart)
{
	return *chart->name ? chart->name : _("Status chart");
}

/* The one that was shown is found again by its name, else by its place. */
static void find_chart(LadderWatchView *view, GPtrArray *charts)
{
	struct watch *chart;

	if (view->chart >= charts->len)
		view->chart = charts->len ? charts->len - 1 : 0;
	chart = charts->len ? charts->pdata[view->chart] : NULL;
	for (guint i = 0; i < charts->len && view->chart_name &&
	     strcmp(chart->name, view->chart_name) != 0; i++) {
		chart = charts->pdata[i];
		if (strcmp(chart->name, view->chart_name) == 0)
			view->chart = i;
	}
	g_free(view->chart_name);
	view->chart_name = charts->len ?
		g_strdup(((struct watch *)charts->pdata[view->chart])->name) : NULL;
}

static void fill_charts(LadderWatchView *view, GPtrArray *charts)
{
	GtkDropDown *drop = GTK_DROP_DOWN(view->charts);
	GPtrArray *names = g_ptr_array_new();

	for (guint i = 0; i < charts->len; i++)
		g_ptr_array_add(names, (gpointer)shown_name(charts->pdata[i]));
	view->busy = true;
	drop_fill(drop, names);
	if (charts->len)
		gtk_drop_down_set_selected(drop, view->chart);
	gtk_widget_set_visible(view->charts, charts->len > 0);
	view->busy = false;
	g_ptr_array_unref(names);
}

static void show_actions(LadderWatchView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);
	const bool project = ladder_document_project(view->document) != NULL;
	const bool on = view->sim && ladder_sim_is_on(view->sim);
	const bool row = watch_selected(view) >= 0;

	gtk_widget_action_set_enabled(widget, "watch.add", project);
	gtk_widget_action_set_enabled(widget, "watch.new-chart", project);
	gtk_widget_action_set_enabled(widget, "watch.rename-chart", view->chart_name != NULL);
	gtk_widget_action_set_enabled(widget, "watch.delete-chart", view->chart_name != NULL);
	gtk_widget_action_set_enabled(widget, "watch.remove", row);
	gtk_widget_action_set_enabled(widget, "watch.up", row);
	gtk_widget_action_set_enabled(widget, "watch.down", row);
	gtk_widget_action_set_enabled(widget, "watch.write-all", on);
}

/* ---- rows become others ---- */

/* What is typed and not written yet goes with the name. */
static void keep_typed(LadderWatchView *view, GPtrArray *rows)
{
	const guint old = g_list_model_get_n_items(G_LIST_MODEL(view->store));
	GHashTable *typed = g_hash_table_new(g_str_hash, g_str_equal);

	for (guint i = 0; i < old; i++) {
		LadderWatchRow *row = watch_row_at(view, i);

		if (*row->typed)
			g_hash_table_insert(typed, row->line->name, row->typed);
		g_object_unref(row);
	}
	for (guint i = 0; i < rows->len && g_hash_table_size(typed); i++) {
		LadderWatchRow *row = rows->pdata[i];
		const char *text = g_hash_table_lookup(typed, row->line->name);

		if (text) {
			g_free(row->typed);
			row->typed = g_strdup(text);
		}
	}
	g_hash_table_unref(typed);
}

static bool stays(LadderWatchView *view, guint at, LadderWatchRow *row)
{
	LadderWatchRow *old = watch_row_at(view, at);
	const bool same = watch_row_equal(old, row);

	g_object_unref(old);
	return same;
}

/* What is the same at both ends stays, so that selection, focus and scrolling do. */
static void exchange(LadderWatchView *view, GPtrArray *rows)
{
	const guint old = g_list_model_get_n_items(G_LIST_MODEL(view->store));
	guint first = 0, last = 0;

	keep_typed(view, rows);
	while (first < MIN(old, rows->len) && stays(view, first, rows->pdata[first]))
		first++;
	while (last < MIN(old, rows->len) - first &&
	       stays(view, old - 1 - last, rows->pdata[rows->len - 1 - last]))
		last++;
	if (old - first - last || rows->len - first - last)
		g_list_store_splice(view->store, first, old - first - last,
				    rows->pdata + first, rows->len - first - last);
	list_mend_focus(view->list);
}

static void look(LadderWatchView *view)
{
	const guint count = g_list_model_get_n_items(G_LIST_MODEL(view->store));

	for (guint i = 0; i < count; i++) {
		LadderWatchRow *row = watch_row_at(view, i);

		if (watch_row_look(row, view->sim))
			watch_cells_show(row);
		g_object_unref(row);
	}
}

void watch_refresh(LadderWatchView *view)
{
	GPtrArray *charts = watch_list_of(view->document);
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	struct image *room = g_new0(struct image, 1);
	const struct image *image = watch_image(view->document, view->sim, room);
	struct watch *chart;

	view->dirty = false;
	find_chart(view, charts);
	fill_charts(view, charts);
	chart = charts->len ? charts->pdata[view->chart] : NULL;
	for (guint i = 0; chart && i < chart->lines->len; i++)
		g_ptr_array_add(rows, ladder_watch_row_new(chart->lines->pdata[i], image));
	exchange(view, rows);
	look(view);
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), rows->len ? "list" : "none");
	show_actions(view);
	g_free(room);
	g_ptr_array_unref(rows);
	g_ptr_array_unref(charts);
}

static void changed(LadderWatchView *view)
{
	view->dirty = true;
	if (gtk_widget_get_mapped(GTK_WIDGET(view)))
		watch_refresh(view);
}

/* Of a program that is gone nothing may be looked at, seen or not. */
static void program_changed(LadderWatchView *view)
{
	view->dirty = true;
	changed(view);
}

static void shown(LadderWatchView *view)
{
	if (!gtk_widget_get_mapped(GTK_WIDGET(view)))
		return;
	if (view->dirty)
		watch_refresh(view);
	else
		look(view);
}

static void mapped(GtkWidget *widget)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(widget);

	GTK_WIDGET_CLASS(ladder_watch_view_parent_class)->map(widget);
	shown(view);
}

/* ---- the widget ---- */

static void chart_chosen(GtkDropDown *drop, GParamSpec *spec, LadderWatchView *view)
{
	const guint at = gtk_drop_down_get_selected(drop);

	(void)spec;
	if (view->busy || !view->document || at == GTK_INVALID_LIST_POSITION)
		return;
	view->chart = at;
	g_clear_pointer(&view->chart_name, g_free);
	watch_refresh(view);
}

static void activated(GtkColumnView *list, guint at, LadderWatchView *view)
{
	LadderWatchRow *row = watch_row_at(view, at);

	(void)list;
	if (row)
		watch_ask_name(view, row);
	g_clear_object(&row);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			LadderWatchView *view)
{
	(void)target;
	(void)x;
	(void)y;
	return ladder_watch_view_add(view, g_value_get_string(value));
}

static void dispose(GObject *object)
{
	LadderWatchView *view = LADDER_WATCH_VIEW(object);

	if (view->document)
		g_signal_handlers_disconnect_by_data(view->document, view);
	if (view->sim)
		g_signal_handlers_disconnect_by_data(view->sim, view);
	g_clear_pointer(&view->popup, gtk_widget_unparent);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	g_clear_object(&view->selection);
	g_clear_object(&view->store);
	g_clear_object(&view->sim);
	g_clear_object(&view->document);
	g_clear_pointer(&view->chart_name, g_free);
	G_OBJECT_CLASS(ladder_watch_view_parent_class)->dispose(object);
}

static void ladder_watch_view_class_init(LadderWatchViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->map = mapped;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/watch_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderWatchView, name)
	CHILD(box); CHILD(charts); CHILD(add_button); CHILD(stack); CHILD(empty);
	CHILD(bar); CHILD(message); CHILD(list);
#undef CHILD
	gtk_widget_class_bind_template_callback(widget, chart_chosen);
	gtk_widget_class_bind_template_callback(widget, activated);
	watch_install_actions(widget);
}

static void ladder_watch_view_init(LadderWatchView *view)
{
	GtkDropTarget *drop = gtk_drop_target_new(G_TYPE_STRING, GDK_ACTION_COPY);

	gtk_widget_init_template(GTK_WIDGET(view));
	view->store = g_list_store_new(LADDER_TYPE_WATCH_ROW);
	view->selection = gtk_single_selection_new(g_object_ref(G_LIST_MODEL(view->store)));
	gtk_single_selection_set_autoselect(view->selection, FALSE);
	gtk_single_selection_set_can_unselect(view->selection, TRUE);
	gtk_column_view_set_model(GTK_COLUMN_VIEW(view->list),
				  GTK_SELECTION_MODEL(view->selection));
	watch_columns(view);
	g_signal_connect(drop, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(view->stack, GTK_EVENT_CONTROLLER(drop));
}

static void follow_document(LadderWatchView *view)
{
	static const char *const signals[] = {
		"project-changed", "bookmarks-changed", "checked",
	};

	for (gsize i = 0; i < G_N_ELEMENTS(signals); i++)
		g_signal_connect_swapped(view->document, signals[i], G_CALLBACK(changed),
					 view);
}

GtkWidget *ladder_watch_view_new(LadderDocument *document, LadderSim *sim)
{
	LadderWatchView *view = g_object_new(LADDER_TYPE_WATCH_VIEW, NULL);

	view->document = g_object_ref(document);
	view->sim = g_object_ref(sim);
	follow_document(view);
	g_signal_connect_swapped(view->selection, "notify::selected",
				 G_CALLBACK(show_actions), view);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(program_changed), view);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(show_actions), view);
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(shown), view);
	watch_refresh(view);
	return GTK_WIDGET(view);
}
