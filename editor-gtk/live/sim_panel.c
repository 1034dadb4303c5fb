/* SPDX-License-Identifier: MIT
 *
 * sim_panel - which lines stand in the panel, and when they look again. What a line is is
 * sim_panel_rows.c's, how it looks sim_panel_view.c's, keys and menu sim_panel_keys.c's.
 */
#include "editor-gtk/live/sim_panel_inside.h"

#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/live/sim_panel_kept.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderSimPanel, ladder_sim_panel, GTK_TYPE_WIDGET)

GListModel *ladder_sim_panel_list(LadderSimPanel *panel)
{
	return G_LIST_MODEL(panel->selection);
}

#define AT_A_TIME 12 /* lines that are not seen                                 */
#define BEHIND_MS 30

/* ---- the lines ---- */

static bool is_folded(LadderSimPanel *panel, const LadderSimRow *row)
{
	char *section = sim_row_section(row);
	const bool folded = g_hash_table_contains(panel->folded, section);

	g_free(section);
	return folded;
}

static bool is_section(const LadderSimRow *row, const LadderSimRow *other)
{
	return row->group == other->group && g_strcmp0(row->place, other->place) == 0;
}

/* Lines of the same group and place: one heading, and those below it. */
static void add_section(LadderSimPanel *panel, GPtrArray *out, guint from, guint to)
{
	const LadderSimRow *first = g_ptr_array_index(panel->rows, from);
	const bool wants = panel->wanted[0] != '\0';
	const bool folded = !wants && is_folded(panel, first);
	const guint before = out->len;

	g_ptr_array_add(out, sim_row_heading(first, folded));
	for (guint i = from; i < to && !folded; i++) {
		LadderSimRow *row = g_ptr_array_index(panel->rows, i);

		if (!wants || sim_row_matches(row, panel->wanted))
			g_ptr_array_add(out, g_object_ref(row));
	}
	if (out->len == before + 1 && !folded)
		g_ptr_array_set_size(out, (gint)before);
}

static gint find_line(LadderSimPanel *panel, const LadderSimRow *like)
{
	GListModel *list = G_LIST_MODEL(panel->store);

	for (guint i = 0; like && i < g_list_model_get_n_items(list); i++) {
		LadderSimRow *row = g_list_model_get_item(list, i);

		g_object_unref(row);
		if (row->kind == SIM_HEADING ? like->kind == SIM_HEADING &&
					       is_section(row, like) :
		    like->kind != SIM_HEADING && sim_row_is(row, like))
			return (gint)i;
	}
	return -1;
}

/* The same line stays selected. */
static void show_lines(LadderSimPanel *panel)
{
	GPtrArray *out = g_ptr_array_new_with_free_func(g_object_unref);
	LadderSimRow *selected = gtk_single_selection_get_selected_item(panel->selection);
	guint from = 0;
	gint at;

	if (selected)
		g_object_ref(selected);
	for (guint i = 1; i <= panel->rows->len; i++) {
		if (i < panel->rows->len && is_section(panel->rows->pdata[from],
						       panel->rows->pdata[i]))
			continue;
		add_section(panel, out, from, i);
		from = i;
	}
	g_list_store_splice(panel->store, 0, g_list_model_get_n_items(
			    G_LIST_MODEL(panel->store)), out->pdata, out->len);
	list_mend_focus(GTK_WIDGET(panel));
	at = find_line(panel, selected);
	gtk_single_selection_set_selected(panel->selection, at < 0 ?
					  GTK_INVALID_LIST_POSITION : (guint)at);
	gtk_stack_set_visible_child_name(GTK_STACK(panel->found), out->len ? "list" : "none");
	g_ptr_array_unref(out);
	g_clear_object(&selected);
}

static bool are_same(GPtrArray *left, GPtrArray *right)
{
	if (left->len != right->len)
		return false;
	for (guint i = 0; i < left->len; i++)
		if (!sim_row_is(g_ptr_array_index(left, i), g_ptr_array_index(right, i)))
			return false;
	return true;
}

/* Another program. What has the same lines keeps their widgets. */
static void look_at_program(LadderSimPanel *panel)
{
	GPtrArray *rows = sim_rows_new(panel->sim);

	if (are_same(panel->rows, rows)) {
		for (guint i = 0; i < rows->len; i++)
			sim_row_become(g_ptr_array_index(panel->rows, i),
				       g_ptr_array_index(rows, i));
		g_ptr_array_unref(rows);
		return;
	}
	sim_panel_let_go(panel);
	g_ptr_array_unref(panel->rows);
	panel->rows = rows;
	sim_kept_read(ladder_document_view(ladder_sim_document(panel->sim)), rows);
	show_lines(panel);
}

void sim_panel_read_choices(LadderSimPanel *panel)
{
	LadderDocument *document = ladder_sim_document(panel->sim);

	if (!sim_kept_read(ladder_document_view(document), panel->rows))
		return;
	for (guint i = 0; i < panel->views->len; i++) {
		LadderSimRowView *view = g_ptr_array_index(panel->views, i);

		ladder_sim_row_view_bind(view, ladder_sim_row_view_row(view));
	}
}

/* ---- what happens ---- */

static bool is_seen(LadderSimPanel *panel, GtkWidget *view)
{
	const float height = (float)gtk_widget_get_height(panel->list);
	graphene_rect_t box;

	return gtk_widget_compute_bounds(view, panel->list, &box) &&
	       box.origin.y + box.size.height > 0 && box.origin.y < height;
}

/* A list has some two hundred widgets, most of them beyond its edges: those follow a few at
 * a time, for assistive technology, and at once when they come into sight. */
static gboolean look_at_some(gpointer data)
{
	LadderSimPanel *panel = data;

	for (guint i = 0; i < AT_A_TIME && panel->behind > 0; i++) {
		if (--panel->behind < panel->views->len)
			ladder_sim_row_view_update(g_ptr_array_index(panel->views,
								     panel->behind));
	}
	if (panel->behind == 0 && panel->again) {
		panel->again = false;
		panel->behind = panel->views->len;
	}
	if (panel->behind > 0)
		return G_SOURCE_CONTINUE;
	panel->behind_timer = 0;
	return G_SOURCE_REMOVE;
}

static void look(LadderSimPanel *panel)
{
	guint seen = 0;

	for (guint i = 0; i < panel->views->len; i++) {
		GtkWidget *view = g_ptr_array_index(panel->views, i);

		if (!is_seen(panel, view))
			continue;
		ladder_sim_row_view_update(LADDER_SIM_ROW_VIEW(view));
		seen++;
	}
	if (seen == panel->views->len)
		return;
	/* A round that has begun is not begun again, or its end never came. */
	if (panel->behind_timer) {
		panel->again = true;
		return;
	}
	panel->behind = panel->views->len;
	panel->behind_timer = g_timeout_add(BEHIND_MS, look_at_some, panel);
}

static void shown(LadderSim *sim, LadderSimPanel *panel)
{
	(void)sim;
	if (gtk_widget_get_mapped(GTK_WIDGET(panel)))
		look(panel);
}

static void program_changed(LadderSim *sim, LadderSimPanel *panel)
{
	(void)sim;
	look_at_program(panel);
	look(panel);
}

static void state_changed(LadderSim *sim, LadderSimPanel *panel)
{
	const bool on = ladder_sim_is_on(sim);

	if (on != panel->on)
		look_at_program(panel);
	panel->on = on;
	gtk_stack_set_visible_child_name(GTK_STACK(panel->stack), on ? "on" : "off");
	if (on)
		return;
	sim_panel_let_go(panel);
	sim_panel_end_asking(panel);
}

static void search_changed(GtkSearchEntry *entry, LadderSimPanel *panel)
{
	g_free(panel->wanted);
	panel->wanted = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(entry))));
	show_lines(panel);
}

static void fold(GtkWidget *widget, const char *name, GVariant *section)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	const char *key = g_variant_get_string(section, NULL);

	(void)name;
	if (!g_hash_table_remove(panel->folded, key))
		g_hash_table_add(panel->folded, g_strdup(key));
	show_lines(panel);
}

/* What cannot be built the window tells: its own action does the same. */
static void simulate(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);

	(void)name;
	(void)unused;
	if (!gtk_widget_activate_action(widget, "win.sim_mode", NULL))
		ladder_sim_begin(panel->sim, NULL);
}

bool ladder_sim_panel_select(LadderSimPanel *panel, const char *name)
{
	GListModel *list = G_LIST_MODEL(panel->store);

	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		LadderSimRow *row = g_list_model_get_item(list, i);
		const bool is = row->kind != SIM_HEADING && strcmp(row->name, name) == 0;

		g_object_unref(row);
		if (!is)
			continue;
		gtk_single_selection_set_selected(panel->selection, i);
		list_scroll_to(panel->list, i);
		return true;
	}
	return false;
}

LadderSimRow *sim_panel_selected(LadderSimPanel *panel)
{
	LadderSimRow *row = gtk_single_selection_get_selected_item(panel->selection);

	return row && row->kind != SIM_HEADING ? row : NULL;
}

LadderSimRowView *sim_panel_view_of(LadderSimPanel *panel, const LadderSimRow *row)
{
	for (guint i = 0; row && i < panel->views->len; i++)
		if (ladder_sim_row_view_row(g_ptr_array_index(panel->views, i)) == row)
			return g_ptr_array_index(panel->views, i);
	return NULL;
}

char *ladder_sim_panel_shown(LadderSimPanel *panel, const LadderSimRow *row)
{
	LadderSimRowView *view = sim_panel_view_of(panel, row);

	if (view)
		ladder_sim_row_view_update(view); /* as if it came into sight */
	return view ? ladder_sim_row_view_text(view) : NULL;
}

/* ---- widgets of lines ---- */

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item,
		  LadderSimPanel *panel)
{
	(void)factory;
	gtk_list_item_set_activatable(item, TRUE);
	gtk_list_item_set_child(item, ladder_sim_row_view_new(panel->sim, item));
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item,
		 LadderSimPanel *panel)
{
	GtkWidget *view = gtk_list_item_get_child(item);

	(void)factory;
	ladder_sim_row_view_bind(LADDER_SIM_ROW_VIEW(view), gtk_list_item_get_item(item));
	g_ptr_array_add(panel->views, view);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item,
		   LadderSimPanel *panel)
{
	GtkWidget *view = gtk_list_item_get_child(item);

	(void)factory;
	if (panel->views)
		g_ptr_array_remove_fast(panel->views, view);
	if (view)
		ladder_sim_row_view_bind(LADDER_SIM_ROW_VIEW(view), NULL);
}

static void make_list(LadderSimPanel *panel, GtkWidget *list)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();

	g_signal_connect(factory, "setup", G_CALLBACK(setup), panel);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), panel);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), panel);
	panel->store = g_list_store_new(LADDER_TYPE_SIM_ROW);
	panel->selection = gtk_single_selection_new(G_LIST_MODEL(g_object_ref(panel->store)));
	gtk_single_selection_set_autoselect(panel->selection, FALSE);
	gtk_single_selection_set_can_unselect(panel->selection, TRUE);
	gtk_list_view_set_factory(GTK_LIST_VIEW(list), factory);
	gtk_list_view_set_model(GTK_LIST_VIEW(list), GTK_SELECTION_MODEL(panel->selection));
	g_signal_connect_object(gtk_scrollable_get_vadjustment(GTK_SCROLLABLE(list)),
				"value-changed", G_CALLBACK(look), panel, G_CONNECT_SWAPPED);
	g_object_unref(factory);
}

/* ---- the widget ---- */

static void dispose(GObject *object)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(object);

	g_clear_handle_id(&panel->behind_timer, g_source_remove);
	sim_panel_let_go(panel);
	sim_panel_end_asking(panel);
	if (panel->sim) {
		g_signal_handlers_disconnect_by_data(panel->sim, panel);
		g_signal_handlers_disconnect_by_data(ladder_sim_document(panel->sim), panel);
	}
	g_clear_pointer(&panel->views, g_ptr_array_unref);
	sim_panel_end_keys(panel);
	g_clear_pointer(&panel->stack, gtk_widget_unparent);
	g_clear_object(&panel->selection);
	g_clear_object(&panel->store);
	g_clear_pointer(&panel->rows, g_ptr_array_unref);
	g_clear_object(&panel->sim);
	g_clear_pointer(&panel->wanted, g_free);
	g_clear_pointer(&panel->folded, g_hash_table_unref);
	G_OBJECT_CLASS(ladder_sim_panel_parent_class)->dispose(object);
}

static void root(GtkWidget *widget)
{
	GTK_WIDGET_CLASS(ladder_sim_panel_parent_class)->root(widget);
	sim_panel_bind_root(LADDER_SIM_PANEL(widget), gtk_widget_get_root(widget));
}

static void unroot(GtkWidget *widget)
{
	sim_panel_unbind_root(LADDER_SIM_PANEL(widget));
	GTK_WIDGET_CLASS(ladder_sim_panel_parent_class)->unroot(widget);
}

static void ladder_sim_panel_class_init(LadderSimPanelClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->root = root;
	widget->unroot = unroot;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_css_name(widget, "sim-panel");
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/sim_panel.ui");
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, stack);
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, found);
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, search);
	gtk_widget_class_bind_template_child(widget, LadderSimPanel, list);
	gtk_widget_class_bind_template_callback(widget, search_changed);
	gtk_widget_class_install_action(widget, "sim-panel.fold", "s", fold);
	gtk_widget_class_install_action(widget, "sim-panel.simulate", NULL, simulate);
	sim_panel_install_keys(widget);
	sim_panel_install_choices(widget);
}

static void ladder_sim_panel_init(LadderSimPanel *panel)
{
	gtk_widget_init_template(GTK_WIDGET(panel));
	panel->wanted = g_strdup("");
	panel->folded = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	panel->views = g_ptr_array_new();
	panel->rows = g_ptr_array_new_with_free_func(g_object_unref);
	make_list(panel, panel->list);
	sim_panel_begin_keys(panel);
	g_signal_connect(panel, "map", G_CALLBACK(look), NULL);
}

GtkWidget *ladder_sim_panel_new(LadderSim *sim)
{
	LadderSimPanel *panel = g_object_new(LADDER_TYPE_SIM_PANEL, NULL);

	panel->sim = g_object_ref(sim);
	g_signal_connect(sim, "shown", G_CALLBACK(shown), panel);
	g_signal_connect(sim, "program-changed", G_CALLBACK(program_changed), panel);
	g_signal_connect(sim, "state-changed", G_CALLBACK(state_changed), panel);
	g_signal_connect_swapped(ladder_sim_document(sim), "bookmarks-changed",
				 G_CALLBACK(sim_panel_read_choices), panel);
	state_changed(sim, panel);
	return GTK_WIDGET(panel);
}
