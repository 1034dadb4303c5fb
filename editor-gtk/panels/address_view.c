/* SPDX-License-Identifier: MIT
 *
 * address_view - the page of the address map; see address_view.h.
 */
#include "editor-gtk/panels/address_view.h"

#include "editor-gtk/document/address_rows.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/style.h"

/* Texts of a row; its index is the number of its struct address_row. */
enum { MAP_BYTES, MAP_NAMES };

struct _LadderAddressView {
	GtkBox parent_instance;
	GtkWidget *stack, *areas, *kinds, *legend;
	struct panel_list list;
	struct panel_watch *watch;
	struct address_rows *rows;
	GArray *area;           /* of int: the areas that the drop-down offers     */
	bool busy;              /* a drop-down is being filled: ignore its signal */
};

G_DEFINE_FINAL_TYPE(LadderAddressView, ladder_address_view, GTK_TYPE_BOX)

static const struct { const char *name, *style, *mark; } states[ADDRESS_STATES] = {
	[ADDRESS_FREE] = { N_("Free"), "free", "" },
	[ADDRESS_REACHED] = { N_("An index may reach it"), "reached", "…" },
	[ADDRESS_UNUSED] = { N_("Declared, never used"), "unused", "○" },
	[ADDRESS_USED] = { N_("Used"), "used", "●" },
	[ADDRESS_SEVERAL] = { N_("Used by several"), "several", "◆" },
	[ADDRESS_TWICE] = { N_("Written twice"), "twice", "!" },
};

/* ---- rows ---- */

/* Has a cell of the row this state? ADDRESS_STATES: any row has. What an index may reach is
 * shown also where it is used. */
static bool has_state(const LadderAddressView *view, int row, guint state)
{
	if (state == ADDRESS_REACHED)
		return address_is_reached(view->rows, row);
	for (int i = 0; i < ADDRESS_COLUMNS && state < ADDRESS_STATES; i++)
		if (address_state_of(view->rows, row, i) == (enum address_state)state)
			return true;
	return state >= ADDRESS_STATES;
}

static LadderPanelRow *row_new(const LadderAddressView *view, int number)
{
	LadderPanelRow *row = ladder_panel_row_new();

	row->text[MAP_BYTES] = address_row_text(view->rows, number);
	row->text[MAP_NAMES] = address_row_names(view->rows, number);
	row->spoken = g_strdup_printf("%s, %s", row->text[MAP_BYTES], row->text[MAP_NAMES]);
	row->table = 0;
	row->index = number;
	return row;
}

/* All, or one kind: the first entry of the drop-down has all rows. */
static guint wanted_state(const LadderAddressView *view)
{
	static const guint state[] = { ADDRESS_STATES, ADDRESS_SEVERAL, ADDRESS_TWICE,
				       ADDRESS_UNUSED, ADDRESS_REACHED, ADDRESS_FREE };
	const guint at = gtk_drop_down_get_selected(GTK_DROP_DOWN(view->kinds));

	return at < G_N_ELEMENTS(state) ? state[at] : ADDRESS_STATES;
}

static int wanted_area(const LadderAddressView *view)
{
	const guint at = gtk_drop_down_get_selected(GTK_DROP_DOWN(view->areas));

	return at < view->area->len ? g_array_index(view->area, int, at) : AREA_NONE;
}

static void fill_rows(LadderAddressView *view)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	const guint state = wanted_state(view);
	const int area = wanted_area(view);

	for (int i = 0; i < (int)view->rows->row->len; i++) {
		const struct address_row *row = address_rows_at(view->rows, i);

		if ((area == AREA_NONE || (int)row->area == area) && has_state(view, i, state))
			g_ptr_array_add(rows, row_new(view, i));
	}
	/* The rows of another map would keep the cells of the old one. */
	g_list_store_remove_all(view->list.store);
	panel_list_update(&view->list, rows);
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack),
					 view->rows->row->len ? "map" : "none");
	g_ptr_array_unref(rows);
}

/* "%I inputs": the areas in which something is. */
static void fill_areas(LadderAddressView *view)
{
	const int was = wanted_area(view);
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	guint selected = 0;
	int area = AREA_NONE;

	g_array_set_size(view->area, 0);
	g_array_append_val(view->area, area);
	g_ptr_array_add(names, g_strdup(_("All areas")));
	for (int i = 0; i < (int)view->rows->row->len; i++) {
		const int of = (int)address_rows_at(view->rows, i)->area;

		if (of == area)
			continue;
		area = of;
		selected = area == was ? view->area->len : selected;
		g_array_append_val(view->area, area);
		g_ptr_array_add(names, g_strdup_printf("%%%s",
			iec_area_row((enum iec_area)area)->letters));
	}
	view->busy = true;
	drop_fill(GTK_DROP_DOWN(view->areas), names);
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->areas), selected);
	view->busy = false;
	g_ptr_array_unref(names);
}

static void refresh(GtkWidget *widget)
{
	LadderAddressView *view = LADDER_ADDRESS_VIEW(widget);
	int field;
	LadderPanelRow *row = cells_focused(view->list.view, &field);

	if (row)
		g_object_ref(row);
	address_rows_free(view->rows);
	view->rows = address_rows_new(panel_watch_document(view->watch));
	fill_areas(view);
	fill_rows(view);
	if (row && panel_list_select(&view->list, panel_row_is_like, row))
		cells_enter(view->list.view, panel_list_row(&view->list), field);
	g_clear_object(&row);
}

void ladder_address_view_enter(LadderAddressView *view)
{
	if (!g_list_model_get_n_items(G_LIST_MODEL(view->list.selection)))
		return;
	panel_list_go(&view->list, 0);
	cells_enter(view->list.view, panel_list_row(&view->list), 7);
}

static void choice_changed(GtkDropDown *drop, GParamSpec *spec, LadderAddressView *view)
{
	(void)drop;
	(void)spec;
	if (!view->busy)
		fill_rows(view);
}

static void search_changed(GtkSearchEntry *entry, LadderAddressView *view)
{
	panel_list_want(&view->list, gtk_editable_get_text(GTK_EDITABLE(entry)));
}

/* ---- going there ---- */

static void open_cell(LadderAddressView *view, int row, int column)
{
	GtkWidget *widget = GTK_WIDGET(view);
	int table, index;
	char *name, *text;

	if (!address_cell_goal(view->rows, row, column, &table, &index, &name)) {
		text = address_cell_text(view->rows, row, column);
		gtk_widget_activate_action(widget, "win.tell", "s", text);
		g_free(text);
	} else if (name) {
		gtk_widget_activate_action(widget, "win.show-uses", "s", name);
		g_free(name);
	} else {
		gtk_widget_activate_action(widget, "win.go-to", "(iiii)", -1, -1, table, index);
	}
}

static int column_of(GtkWidget *cell)
{
	return GPOINTER_TO_INT(g_object_get_data(G_OBJECT(cell), "column"));
}

/* Later, because the click moves the focus to the cell after this signal. */
static gboolean open_later(gpointer data)
{
	GtkWidget *cell = data;
	GtkListItem *item = g_object_get_data(G_OBJECT(cell), "item");
	GtkWidget *view = gtk_widget_get_ancestor(cell, LADDER_TYPE_ADDRESS_VIEW);
	const LadderPanelRow *row = item ? gtk_list_item_get_item(item) : NULL;

	if (row && view)
		open_cell(LADDER_ADDRESS_VIEW(view), row->index, column_of(cell));
	return G_SOURCE_REMOVE;
}

static void clicked(GtkWidget *cell)
{
	g_idle_add_full(G_PRIORITY_DEFAULT, open_later, g_object_ref(cell), g_object_unref);
}

/* ---- keys ---- */

/* The cell beside the one with the focus, and the same one of another row. */
static void go_by(LadderAddressView *view, LadderPanelRow *row, int column, int by, int down)
{
	GListModel *rows = G_LIST_MODEL(view->list.selection);
	const int count = (int)g_list_model_get_n_items(rows);
	int at = (int)gtk_single_selection_get_selected(view->list.selection);

	/* bit 7 stands at the left */
	column = column < ADDRESS_BYTE ? 7 - column : column;
	column = CLAMP(column + by, 0, ADDRESS_COLUMNS - 1);
	column = column < ADDRESS_BYTE ? 7 - column : column;
	at = CLAMP(at + down, 0, count - 1);
	if (down) {
		gtk_single_selection_set_selected(view->list.selection, (guint)at);
		row = g_list_model_get_item(rows, (guint)at);
		g_object_unref(row); /* the list has a reference */
	}
	cells_enter(view->list.view, row, column);
}

static gboolean key_pressed(LadderAddressView *view, guint key, guint code,
			    GdkModifierType state)
{
	int column;
	LadderPanelRow *row = cells_focused(view->list.view, &column);

	(void)code;
	if (!row || state & gtk_accelerator_get_default_mod_mask())
		return FALSE;
	switch (key) {
	case GDK_KEY_Left: go_by(view, row, column, -1, 0); return TRUE;
	case GDK_KEY_Right: go_by(view, row, column, 1, 0); return TRUE;
	case GDK_KEY_Home: go_by(view, row, column, -ADDRESS_COLUMNS, 0); return TRUE;
	case GDK_KEY_End: go_by(view, row, column, ADDRESS_COLUMNS, 0); return TRUE;
	case GDK_KEY_Up: go_by(view, row, column, 0, -1); return TRUE;
	case GDK_KEY_Down: go_by(view, row, column, 0, 1); return TRUE;
	case GDK_KEY_Page_Up: go_by(view, row, column, 0, -16); return TRUE;
	case GDK_KEY_Page_Down: go_by(view, row, column, 0, 16); return TRUE;
	case GDK_KEY_Return: case GDK_KEY_KP_Enter: case GDK_KEY_space:
		open_cell(view, row->index, column);
		return TRUE;
	default:
		return FALSE;
	}
}

/* ---- cells ---- */

static void style_cell(GtkWidget *cell, enum address_state state)
{
	for (int i = 0; i < ADDRESS_STATES; i++)
		style_set(cell, states[i].style, i == (int)state);
}

static const char *mark_of(enum address_state state, bool own)
{
	return own || state == ADDRESS_TWICE || state == ADDRESS_REACHED ? states[state].mark : "";
}

static void setup_cell(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer column)
{
	GtkWidget *cell = gtk_button_new_with_label("");

	(void)factory;
	gtk_widget_add_css_class(cell, "address-cell");
	g_object_set_data(G_OBJECT(cell), "column", column);
	g_signal_connect(cell, "clicked", G_CALLBACK(clicked), NULL);
	gtk_list_item_set_child(item, cell);
}

static void bind_cell(GtkSignalListItemFactory *factory, GtkListItem *item,
		      LadderAddressView *view)
{
	GtkWidget *cell = gtk_list_item_get_child(item);
	const LadderPanelRow *row = gtk_list_item_get_item(item);
	const int column = column_of(cell);
	const enum address_state state = address_state_of(view->rows, row->index, column);
	char *text = address_cell_text(view->rows, row->index, column);
	char *spoken = state <= ADDRESS_REACHED || state == ADDRESS_USED ? g_strdup(text) :
		       g_strdup_printf("%s, %s", text, _(states[state].name));

	(void)factory;
	cells_stand(cell, item, column);
	style_cell(cell, state);
	gtk_button_set_label(GTK_BUTTON(cell), mark_of(state, address_is_own(view->rows,
							row->index, column)));
	tip_set(cell, spoken);
	spoken_name(cell, spoken);
	g_free(spoken);
	g_free(text);
}

static void unbind_cell(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	(void)factory;
	cells_stand(gtk_list_item_get_child(item), NULL, 0);
}

#define CELL_WIDTH 34 /* px, of a heading of one letter                         */

static void add_cells(LadderAddressView *view, const char *name, int column)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	GtkColumnViewColumn *of;

	g_signal_connect(factory, "setup", G_CALLBACK(setup_cell), GINT_TO_POINTER(column));
	g_signal_connect(factory, "bind", G_CALLBACK(bind_cell), view);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind_cell), NULL);
	of = gtk_column_view_column_new(name, factory);
	gtk_column_view_column_set_fixed_width(of, CELL_WIDTH);
	gtk_column_view_append_column(view->list.view, of);
	g_object_unref(of);
}

static void add_columns(LadderAddressView *view)
{
	static const char *const wide[] = { "B", "W", "D", "L" };

	panel_list_column(&view->list, _("Bytes"), MAP_BYTES, 0, 170);
	for (int bit = 7; bit >= 0; bit--) {
		char *name = g_strdup_printf("%d", bit);

		add_cells(view, name, bit);
		g_free(name);
	}
	for (int i = 0; i < (int)G_N_ELEMENTS(wide); i++)
		add_cells(view, wide[i], ADDRESS_BYTE + i);
	panel_list_column(&view->list, _("Names"), MAP_NAMES, PANEL_EXPAND, 0);
	panel_list_unsort(&view->list); /* memory has its order */
}

/* ---- the widget ---- */

static GtkWidget *legend_entry(enum address_state state)
{
	GtkWidget *entry = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkWidget *cell = gtk_label_new(states[state].mark);
	GtkWidget *name = gtk_label_new(_(states[state].name));

	gtk_widget_add_css_class(cell, "address-cell");
	style_cell(cell, state);
	gtk_widget_add_css_class(name, "caption");
	gtk_box_append(GTK_BOX(entry), cell);
	gtk_box_append(GTK_BOX(entry), name);
	return entry;
}

static void add_keys(LadderAddressView *view)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect_swapped(keys, "key-pressed", G_CALLBACK(key_pressed), view);
	gtk_widget_add_controller(GTK_WIDGET(view->list.view), keys);
}

static void dispose(GObject *object)
{
	LadderAddressView *view = LADDER_ADDRESS_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	G_OBJECT_CLASS(ladder_address_view_parent_class)->dispose(object);
	panel_list_clear(&view->list);
	g_clear_pointer(&view->rows, address_rows_free);
	g_clear_pointer(&view->area, g_array_unref);
}

static void ladder_address_view_class_init(LadderAddressViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/address_view.ui");
	gtk_widget_class_bind_template_child(widget, LadderAddressView, stack);
	gtk_widget_class_bind_template_child(widget, LadderAddressView, areas);
	gtk_widget_class_bind_template_child(widget, LadderAddressView, kinds);
	gtk_widget_class_bind_template_child(widget, LadderAddressView, legend);
	panel_bind_list(widget, LadderAddressView);
	gtk_widget_class_bind_template_callback(widget, choice_changed);
	gtk_widget_class_bind_template_callback(widget, search_changed);
}

static void ladder_address_view_init(LadderAddressView *view)
{
	view->area = g_array_new(FALSE, FALSE, sizeof(int));
	view->busy = true;
	gtk_widget_init_template(GTK_WIDGET(view));
	view->busy = false;
	panel_list_init(&view->list, view->list.view);
	add_columns(view);
	add_keys(view);
	for (int i = 0; i < ADDRESS_STATES; i++)
		gtk_flow_box_insert(GTK_FLOW_BOX(view->legend),
				    legend_entry((enum address_state)i), -1);
	view->watch = panel_watch_new(GTK_WIDGET(view), false, refresh);
}

GtkWidget *ladder_address_view_new(LadderDocument *document)
{
	LadderAddressView *view = g_object_new(LADDER_TYPE_ADDRESS_VIEW, NULL);

	panel_watch_set(view->watch, document);
	refresh(GTK_WIDGET(view));
	return GTK_WIDGET(view);
}
