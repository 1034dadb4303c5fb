/* SPDX-License-Identifier: MIT
 *
 * timing_view - the timing chart with its buttons.
 */
#include "editor-gtk/live/timing_view.h"

#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/live/watch_names.h"
#include "editor-gtk/sim/live_value.h"

#include <string.h>

#define LINES_FIRST 12 /* of those that nobody chose                             */

struct _LadderTimingView {
	GtkBox parent;
	LadderSim *sim;
	LadderTimingArea *area;
	bool chosen;             /* a person said what is to be seen            */
	int compared;            /* lines that are those of the program        */
	bool keeping;            /* what the document keeps changes by itself   */
	GtkSearchEntry *wanted;
	GtkStringList *names;
	GtkFilterListModel *found;
	GtkSingleSelection *selection;
	GtkWidget *popover;
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

/* Are its lines those that nobody chose, already? */
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

/* Of the chart. Caller: g_free(); the names are borrowed. */
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

/* Another file, or an undo: the chart is what the project keeps. */
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

static gboolean is_wanted(gpointer item, gpointer data)
{
	LadderTimingView *view = data;
	char *name = g_utf8_casefold(gtk_string_object_get_string(item), -1);
	char *wanted = g_utf8_casefold(gtk_editable_get_text(GTK_EDITABLE(view->wanted)), -1);
	const bool good = strstr(name, wanted) != NULL;

	g_free(name);
	g_free(wanted);
	return good;
}

static void wanted_changed(LadderTimingView *view)
{
	gtk_filter_changed(gtk_filter_list_model_get_filter(view->found),
			   GTK_FILTER_CHANGE_DIFFERENT);
	gtk_widget_remove_css_class(GTK_WIDGET(view->wanted), "error");
}

static void add_row(GtkListView *list, guint row, LadderTimingView *view)
{
	GtkStringObject *name = g_list_model_get_item(G_LIST_MODEL(view->selection), row);

	(void)list;
	ladder_timing_view_add(view, gtk_string_object_get_string(name));
	g_object_unref(name);
}

/* What was typed, if it is something; else the first that has it in its name. */
static void add_wanted(LadderTimingView *view)
{
	const char *text = gtk_editable_get_text(GTK_EDITABLE(view->wanted));

	if (*text && live_value_find(live_image(view->sim, false), text).type != IEC_NONE)
		ladder_timing_view_add(view, text);
	else if (g_list_model_get_n_items(G_LIST_MODEL(view->selection)))
		add_row(NULL, gtk_single_selection_get_selected(view->selection), view);
	else
		gtk_widget_add_css_class(GTK_WIDGET(view->wanted), "error");
	gtk_editable_select_region(GTK_EDITABLE(view->wanted), 0, -1);
}

static void popover_shown(LadderTimingView *view)
{
	gtk_string_list_splice(view->names, 0,
		g_list_model_get_n_items(G_LIST_MODEL(view->names)), NULL);
	each_name(view, take_name);
	gtk_widget_grab_focus(GTK_WIDGET(view->wanted));
}

static void setup_name(GtkListItemFactory *factory, GtkListItem *item)
{
	GtkWidget *label = gtk_label_new(NULL);

	(void)factory;
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_list_item_set_child(item, label);
}

static void bind_name(GtkListItemFactory *factory, GtkListItem *item)
{
	(void)factory;
	gtk_label_set_text(GTK_LABEL(gtk_list_item_get_child(item)),
		gtk_string_object_get_string(gtk_list_item_get_item(item)));
}

static GtkWidget *new_list(LadderTimingView *view)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	GtkWidget *list;

	view->names = gtk_string_list_new(NULL);
	view->found = gtk_filter_list_model_new(G_LIST_MODEL(view->names),
		GTK_FILTER(gtk_custom_filter_new(is_wanted, view, NULL)));
	view->selection = gtk_single_selection_new(G_LIST_MODEL(view->found));
	g_signal_connect(factory, "setup", G_CALLBACK(setup_name), NULL);
	g_signal_connect(factory, "bind", G_CALLBACK(bind_name), NULL);
	list = gtk_list_view_new(GTK_SELECTION_MODEL(view->selection), factory);
	gtk_list_view_set_single_click_activate(GTK_LIST_VIEW(list), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(list), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       _("Variables"), -1);
	g_signal_connect(list, "activate", G_CALLBACK(add_row), view);
	return list;
}

static GtkWidget *new_popover(LadderTimingView *view)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
	GtkWidget *scroller = gtk_scrolled_window_new();

	view->popover = gtk_popover_new();
	view->wanted = GTK_SEARCH_ENTRY(gtk_search_entry_new());
	g_object_set(view->wanted, "placeholder-text", _("Name or address"), NULL);
	gtk_accessible_update_property(GTK_ACCESSIBLE(view->wanted),
		GTK_ACCESSIBLE_PROPERTY_LABEL, _("Variable to be seen"), -1);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), new_list(view));
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_widget_set_size_request(scroller, 260, 260);
	gtk_box_append(GTK_BOX(box), GTK_WIDGET(view->wanted));
	gtk_box_append(GTK_BOX(box), scroller);
	gtk_popover_set_child(GTK_POPOVER(view->popover), box);
	g_signal_connect_swapped(view->wanted, "search-changed", G_CALLBACK(wanted_changed),
				 view);
	g_signal_connect_swapped(view->wanted, "activate", G_CALLBACK(add_wanted), view);
	g_signal_connect_swapped(view->popover, "show", G_CALLBACK(popover_shown), view);
	return view->popover;
}

/* ---- dropping ---- */

/* Names with blanks between them; of an instance all that it has. */
static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			LadderTimingView *view)
{
	GPtrArray *names = watch_names_expand(live_image(view->sim, false),
					      g_value_get_string(value));
	bool any = false;

	(void)target;
	(void)x;
	(void)y;
	for (guint i = 0; i < names->len; i++)
		any = ladder_timing_view_add(view, names->pdata[i]) || any;
	g_ptr_array_unref(names);
	return any;
}

/* ---- buttons ---- */

static void name_button(GtkWidget *button, const char *name)
{
	tip_set(button, name);
	gtk_accessible_update_property(GTK_ACCESSIBLE(button),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_widget_add_css_class(button, "flat");
}

static void larger(LadderTimingView *view)
{
	ladder_timing_area_zoom(view->area, 1.6);
}

static void smaller(LadderTimingView *view)
{
	ladder_timing_area_zoom(view->area, 1 / 1.6);
}

static void fit(LadderTimingView *view)
{
	ladder_timing_area_fit(view->area);
}

static void add_button(LadderTimingView *view, GtkBox *bar, const char *icon,
		       const char *name, void (*act)(LadderTimingView *view))
{
	GtkWidget *button = gtk_button_new_from_icon_name(icon);

	name_button(button, name);
	g_signal_connect_swapped(button, "clicked", G_CALLBACK(act), view);
	gtk_box_append(bar, button);
}

static GtkWidget *new_bar(LadderTimingView *view)
{
	GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
	GtkWidget *add = gtk_menu_button_new();

	gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(add), "list-add-symbolic");
	gtk_menu_button_set_popover(GTK_MENU_BUTTON(add), new_popover(view));
	name_button(add, _("Add a variable"));
	gtk_box_append(GTK_BOX(bar), add);
	add_button(view, GTK_BOX(bar), "zoom-in-symbolic", _("Less time"), larger);
	add_button(view, GTK_BOX(bar), "zoom-out-symbolic", _("More time"), smaller);
	add_button(view, GTK_BOX(bar), "zoom-fit-best-symbolic", _("All that is kept"), fit);
	return bar;
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
	G_OBJECT_CLASS(class)->dispose = ladder_timing_view_dispose;
}

static void ladder_timing_view_init(LadderTimingView *view)
{
	(void)view;
}

LadderTimingArea *ladder_timing_view_area(LadderTimingView *view)
{
	return view->area;
}

GtkWidget *ladder_timing_view_new(LadderSim *sim)
{
	LadderTimingView *view = g_object_new(LADDER_TYPE_TIMING_VIEW, NULL);
	GtkWidget *scroller = gtk_scrolled_window_new(), *area = ladder_timing_area_new(sim);
	GtkDropTarget *drop = gtk_drop_target_new(G_TYPE_STRING, GDK_ACTION_COPY);

	view->sim = g_object_ref(sim);
	view->area = LADDER_TIMING_AREA(area);
	gtk_box_append(GTK_BOX(view), new_bar(view));
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), area);
	gtk_viewport_set_scroll_to_focus(GTK_VIEWPORT(gtk_widget_get_parent(area)), FALSE);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_widget_set_hexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(view), scroller);
	g_signal_connect(drop, "drop", G_CALLBACK(dropped), view);
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
