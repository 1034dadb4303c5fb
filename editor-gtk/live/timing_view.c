/* SPDX-License-Identifier: MIT
 *
 * timing_view - the timing chart with its buttons.
 */
#include "editor-gtk/live/timing_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/live/watch_names.h"
#include "editor-gtk/sim/live_value.h"

#include <string.h>

#define LINES_FIRST 12 /* at most, until a person chooses variables               */

struct _LadderTimingView {
	GtkBox parent;
	LadderSim *sim;
	LadderTimingArea *area;
	bool chosen;             /* a person chose the variables                */
	int compared;            /* lines that are the inputs and outputs       */
	bool keeping;            /* it changes the document itself              */
	GtkSearchEntry *wanted;
	GtkLabel *refusal;       /* why it is refused                           */
	GtkStringList *names;
	GtkStringFilter *filter;
	GtkSingleSelection *selection;
	GtkScrolledWindow *scroller;
};

G_DEFINE_FINAL_TYPE(LadderTimingView, ladder_timing_view, GTK_TYPE_BOX)

/* ---- names ---- */

static void each_name(LadderTimingView *view,
		      void (*take)(LadderTimingView *view, const struct symbol *symbol))
{
	const struct twin *twin = ladder_sim_twin(view->sim);
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;

	while (twin && image_next_symbol(&twin->resource.image, &cursor, &symbol))
		if (symbol.at.type != IEC_NONE && !symbol.at.constant)
			take(view, &symbol);
}

static void take_name(LadderTimingView *view, const struct symbol *symbol)
{
	gtk_string_list_append(view->names, symbol->name);
}

static bool is_pin(const struct twin *twin, struct location at)
{
	const enum iec_area area = at.area != AREA_NONE ? at.area :
		areas_find(&twin->resource.image.program->areas, at.where);

	return area == AREA_I || area == AREA_Q || area == AREA_AI || area == AREA_AQ;
}

static void take_first(LadderTimingView *view, const struct symbol *symbol)
{
	struct timing *timing = ladder_timing_area_timing(view->area);

	if (timing_lines(timing) < LINES_FIRST &&
	    is_pin(ladder_sim_twin(view->sim), symbol->at))
		timing_add(timing, symbol->name);
}

static void drop_lines(LadderTimingView *view)
{
	struct timing *timing = ladder_timing_area_timing(view->area);

	while (timing_lines(timing))
		timing_remove(timing, 0);
}

/* Counts the lines that are already the inputs and outputs; INT_MAX: one is not. */
static void compare_first(LadderTimingView *view, const struct symbol *symbol)
{
	struct timing *timing = ladder_timing_area_timing(view->area);

	if (view->compared >= LINES_FIRST ||
	    !is_pin(ladder_sim_twin(view->sim), symbol->at))
		return;
	if (view->compared >= timing_lines(timing) ||
	    strcmp(timing_name(timing, view->compared), symbol->name) != 0)
		view->compared = INT_MAX;
	else
		view->compared++;
}

static void program_changed(LadderTimingView *view)
{
	struct timing *timing = ladder_timing_area_timing(view->area);

	if (view->chosen || !ladder_sim_is_on(view->sim) ||
	    (ladder_sim_is_past(view->sim) && timing_lines(timing)))
		return;
	view->compared = 0;
	each_name(view, compare_first);
	if (view->compared == timing_lines(timing) && view->compared > 0)
		return;
	drop_lines(view);
	each_name(view, take_first);
	ladder_timing_area_lines_changed(view->area);
}

/* ---- what the project keeps ---- */

static LadderDocument *document_of(LadderTimingView *view)
{
	return ladder_sim_document(view->sim);
}

/* Caller: g_free(); the names are borrowed. */
static const char **names_of(LadderTimingView *view)
{
	struct timing *timing = ladder_timing_area_timing(view->area);
	const char **names = g_new0(const char *, (gsize)timing_lines(timing) + 1);

	for (int i = 0; i < timing_lines(timing); i++)
		names[i] = timing_name(timing, i);
	return names;
}

static void keep(LadderTimingView *view)
{
	const char **names = names_of(view);

	view->chosen = names[0] != NULL;
	view->keeping = true;
	timing_kept_put(document_of(view), names);
	view->keeping = false;
	g_free(names);
}

/* After another file or an undo, the chart shows what the project keeps. */
static void read_kept(LadderTimingView *view)
{
	char **kept = view->keeping ? NULL :
		timing_kept_read(ladder_document_view(document_of(view)));
	const char **names = names_of(view);

	if (kept && kept[0] && !g_strv_equal((const char *const *)kept, names)) {
		drop_lines(view);
		for (char **name = kept; *name; name++)
			timing_add(ladder_timing_area_timing(view->area), *name);
		view->chosen = true;
		ladder_timing_area_lines_changed(view->area);
	} else if (kept && !kept[0] && view->chosen) {
		view->chosen = false;
		drop_lines(view);
		program_changed(view);
		ladder_timing_area_lines_changed(view->area);
	}
	g_free(names);
	g_strfreev(kept);
}

bool ladder_timing_view_add(LadderTimingView *view, const char *name)
{
	char *plain = live_name(name);
	const bool good = *plain && timing_add(ladder_timing_area_timing(view->area), plain);

	g_free(plain);
	if (!good)
		return false;
	ladder_timing_area_lines_changed(view->area);
	keep(view);
	return true;
}

/* ---- adding ---- */

/* @why: borrowed; NULL: it is not refused. */
static void refuse_wanted(LadderTimingView *view, const char *why)
{
	GtkWidget *entry = GTK_WIDGET(view->wanted);

	style_wrong(entry, why != NULL);
	gtk_label_set_text(view->refusal, why ? why : "");
	gtk_widget_set_visible(GTK_WIDGET(view->refusal), why != NULL);
}

static void wanted_changed(LadderTimingView *view)
{
	gtk_string_filter_set_search(view->filter,
				     gtk_editable_get_text(GTK_EDITABLE(view->wanted)));
	refuse_wanted(view, NULL);
}

static void add_named(LadderTimingView *view, const char *name)
{
	if (!ladder_timing_view_add(view, name))
		refuse_wanted(view, timing_has(ladder_timing_area_timing(view->area), name) ?
			      _("The chart shows it already") :
			      _("The chart has no room for more variables"));
}

static void add_row(LadderTimingView *view, guint row)
{
	GtkStringObject *name = g_list_model_get_item(G_LIST_MODEL(view->selection), row);

	add_named(view, gtk_string_object_get_string(name));
	g_object_unref(name);
}

/* Adds the variable of the typed name, or else the first one in the list. */
static void add_wanted(LadderTimingView *view)
{
	const char *text = gtk_editable_get_text(GTK_EDITABLE(view->wanted));

	if (*text && live_value_find(live_image(view->sim, false), text).type != IEC_NONE)
		add_named(view, text);
	else if (g_list_model_get_n_items(G_LIST_MODEL(view->selection)))
		add_row(view, gtk_single_selection_get_selected(view->selection));
	else
		refuse_wanted(view, _("There is no such symbol"));
	gtk_editable_select_region(GTK_EDITABLE(view->wanted), 0, -1);
}

static void popover_shown(LadderTimingView *view)
{
	gtk_string_list_splice(view->names, 0,
		g_list_model_get_n_items(G_LIST_MODEL(view->names)), NULL);
	each_name(view, take_name);
	refuse_wanted(view, NULL);
	gtk_widget_grab_focus(GTK_WIDGET(view->wanted));
}

/* ---- dropping ---- */

static gboolean dropped(LadderTimingView *view, const GValue *value)
{
	GPtrArray *names = watch_names_expand(live_image(view->sim, false),
					      g_value_get_string(value));
	bool any = false;

	for (guint i = 0; i < names->len; i++)
		any = ladder_timing_view_add(view, names->pdata[i]) || any;
	g_ptr_array_unref(names);
	return any;
}

/* ---- buttons ---- */

static void zoom_in(LadderTimingView *view)
{
	ladder_timing_area_zoom(view->area, 1.6);
}

static void zoom_out(LadderTimingView *view)
{
	ladder_timing_area_zoom(view->area, 1 / 1.6);
}

static void fit(LadderTimingView *view)
{
	ladder_timing_area_fit(view->area);
}

/* ---- the widget ---- */

static void ladder_timing_view_dispose(GObject *object)
{
	LadderTimingView *view = LADDER_TIMING_VIEW(object);

	if (view->sim)
		g_signal_handlers_disconnect_by_data(document_of(view), view);
	g_clear_object(&view->sim);
	G_OBJECT_CLASS(ladder_timing_view_parent_class)->dispose(object);
}

static void ladder_timing_view_class_init(LadderTimingViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_timing_view_dispose;
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/timing_view.ui");
	gtk_widget_class_bind_template_child(widget, LadderTimingView, wanted);
	gtk_widget_class_bind_template_child(widget, LadderTimingView, refusal);
	gtk_widget_class_bind_template_child(widget, LadderTimingView, names);
	gtk_widget_class_bind_template_child(widget, LadderTimingView, filter);
	gtk_widget_class_bind_template_child(widget, LadderTimingView, selection);
	gtk_widget_class_bind_template_child(widget, LadderTimingView, scroller);
	gtk_widget_class_bind_template_callback(widget, popover_shown);
	gtk_widget_class_bind_template_callback(widget, wanted_changed);
	gtk_widget_class_bind_template_callback(widget, add_wanted);
	gtk_widget_class_bind_template_callback(widget, add_row);
	gtk_widget_class_bind_template_callback(widget, zoom_in);
	gtk_widget_class_bind_template_callback(widget, zoom_out);
	gtk_widget_class_bind_template_callback(widget, fit);
}

static void ladder_timing_view_init(LadderTimingView *view)
{
	gtk_widget_init_template(GTK_WIDGET(view));
}

GtkWidget *ladder_timing_view_new(LadderSim *sim)
{
	LadderTimingView *view = g_object_new(LADDER_TYPE_TIMING_VIEW, NULL);
	GtkWidget *area = ladder_timing_area_new(sim);
	GtkDropTarget *drop = gtk_drop_target_new(G_TYPE_STRING, GDK_ACTION_COPY);

	view->sim = g_object_ref(sim);
	view->area = LADDER_TIMING_AREA(area);
	gtk_scrolled_window_set_child(view->scroller, area);
	gtk_viewport_set_scroll_to_focus(GTK_VIEWPORT(gtk_widget_get_parent(area)), FALSE);
	g_signal_connect_swapped(drop, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(drop));
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(program_changed), view,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(area, "lines-changed", G_CALLBACK(keep), view,
				G_CONNECT_SWAPPED);
	g_signal_connect_swapped(document_of(view), "bookmarks-changed",
				 G_CALLBACK(read_kept), view);
	g_signal_connect_swapped(document_of(view), "project-changed",
				 G_CALLBACK(read_kept), view);
	read_kept(view);
	program_changed(view); /* one may be running already */
	return GTK_WIDGET(view);
}
