/* SPDX-License-Identifier: MIT
 *
 * iomap_cells - cells of the table of an I/O map that can be edited.
 */
#include "editor-gtk/iomap/iomap_cells.h"

#include "editor-gtk/kit/cell_entry.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

struct column {
	enum io_field field;
	const struct iomap_cells *cells;
};

const char *io_field_name(enum io_field field)
{
	static const char *const name[IO_FIELDS] = {
		[IO_ADDRESS] = N_("Address"), [IO_DRIVER] = N_("Driver"),
		[IO_LINE] = N_("I/O line"), [IO_PULL] = N_("Pull"),
		[IO_ACTIVE_LOW] = N_("Active low"), [IO_DEBOUNCE] = N_("Debounce"),
		[IO_DRIVE] = N_("Drive"), [IO_SAFE] = N_("Safe"),
		[IO_COMMENT] = N_("Comment"),
	};

	return _(name[field]);
}

static bool has_choices(enum io_field field)
{
	return field != IO_DEBOUNCE && field != IO_COMMENT && field != IO_ACTIVE_LOW;
}

static const struct column *column_of(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "column");
}

/* ---- what a person did ---- */

/* What stands in a cell; NULL: it was refused already, or nothing is to be done. Caller:
 * g_free. */
static char *meant(GtkWidget *cell, const LadderPanelRow *row)
{
	const char *refused = g_object_get_data(G_OBJECT(cell), "refused");
	char *text = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(cell))));

	if (row && g_strcmp0(refused, text) != 0 &&
	    strcmp(text, panel_row_text(row, (int)column_of(cell)->field)) != 0)
		return text;
	g_free(text);
	return NULL;
}

/* @refused: taken over; NULL: nothing is. */
static void mark(GtkWidget *cell, char *refused, char *why)
{
	if (refused)
		cells_refused(cell, why);
	else
		cells_refuse(cell, NULL);
	g_object_set_data_full(G_OBJECT(cell), "refused", refused, g_free);
}

static void commit(GtkWidget *cell, GtkListItem *item)
{
	const struct column *column = column_of(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	char *text = meant(cell, row), *why = NULL;
	bool good;

	if (!text)
		return;
	g_object_ref(row);
	g_object_ref(cell);
	good = column->cells->set(column->cells->owner, row, column->field, text, &why);
	mark(cell, good ? NULL : g_strdup(text), why);
	g_free(text);
	g_object_unref(cell);
	g_object_unref(row);
}

static void activated(GtkEntry *cell, GtkListItem *item)
{
	commit(GTK_WIDGET(cell), item);
}

/* An edit that waits until the focus is where it goes: the rows are made anew by it. */
struct later {
	const struct column *column;
	GtkWidget *cell;
	LadderPanelRow *row;
	char *text;
};

static gboolean do_later(gpointer data)
{
	struct later *later = data;
	const struct iomap_cells *cells = later->column->cells;
	char *why = NULL;
	const bool good = cells->set(cells->owner, later->row, later->column->field,
				     later->text, &why);
	GtkListItem *item = g_object_get_data(G_OBJECT(later->cell), "item");

	if (!good && item && gtk_list_item_get_item(item) == later->row)
		mark(later->cell, g_strdup(later->text), why);
	else
		g_free(why);
	return G_SOURCE_REMOVE;
}

static void later_free(gpointer data)
{
	struct later *later = data;

	g_object_unref(later->column->cells->owner);
	g_object_unref(later->cell);
	g_object_unref(later->row);
	g_free(later->text);
	g_free(later);
}

/* It is as it was, and what was told of it is over. */
static void give_up(GtkWidget *cell)
{
	const struct iomap_cells *cells = column_of(cell)->cells;

	mark(cell, NULL, NULL);
	tip_set(cell, gtk_editable_get_text(GTK_EDITABLE(cell)));
	cells->given_up(cells->owner);
}

static void left(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	LadderPanelRow *row = gtk_list_item_get_item(item);
	char *text = meant(cell, row);
	struct later *later;

	gtk_editable_select_region(GTK_EDITABLE(cell), 0, 0);
	if (!text && row && g_object_get_data(G_OBJECT(cell), "refused") &&
	    strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)),
		   panel_row_text(row, (int)column_of(cell)->field)) == 0)
		give_up(cell);
	if (!text)
		return;
	later = g_new(struct later, 1);
	*later = (struct later){ column_of(cell), g_object_ref(cell),
				 g_object_ref(row), text };
	g_object_ref(later->column->cells->owner);
	g_idle_add_full(G_PRIORITY_HIGH_IDLE, do_later, later, later_free);
}

static void entered(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	const struct iomap_cells *cells = column_of(cell)->cells;

	cells->entered(cells->owner, gtk_list_item_get_item(item));
}

/* ---- the cell that has the focus ---- */

/* NULL: none of a table. */
static GtkWidget *focused(GtkWidget *within)
{
	GtkRoot *root = gtk_widget_get_root(within);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	for (; focus && focus != within; focus = gtk_widget_get_parent(focus))
		if (column_of(focus) && !GTK_IS_POPOVER(focus))
			return focus;
	return NULL;
}

void iomap_cells_commit(GtkWidget *within)
{
	GtkWidget *cell = focused(within);
	GtkListItem *item = cell ? g_object_get_data(G_OBJECT(cell), "item") : NULL;

	if (item)
		commit(cell, item);
}

bool iomap_cells_place(GtkWidget *within, int *row, enum io_field *field)
{
	GtkWidget *cell = focused(within);
	GtkListItem *item = cell ? g_object_get_data(G_OBJECT(cell), "item") : NULL;
	LadderPanelRow *of = item ? gtk_list_item_get_item(item) : NULL;

	if (!of)
		return false;
	*row = of->index;
	*field = column_of(cell)->field;
	return true;
}

bool iomap_cells_focus(GtkWidget *within, int row, enum io_field field)
{
	const struct column *column = column_of(within);
	GtkListItem *item = column ? g_object_get_data(G_OBJECT(within), "item") : NULL;
	LadderPanelRow *of = item ? gtk_list_item_get_item(item) : NULL;

	if (of && of->index == row && column->field == field) {
		if (GTK_IS_ENTRY(within))
			gtk_entry_grab_focus_without_selecting(GTK_ENTRY(within));
		else
			gtk_widget_grab_focus(within);
		return true;
	}
	for (GtkWidget *child = column ? NULL : gtk_widget_get_first_child(within); child;
	     child = gtk_widget_get_next_sibling(child))
		if (iomap_cells_focus(child, row, field))
			return true;
	return false;
}

static void toggled(GtkCheckButton *check, GtkListItem *item)
{
	const struct column *column = column_of(GTK_WIDGET(check));
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const bool is = row && *panel_row_text(row, (int)column->field);
	char *why = NULL;

	if (!row || gtk_check_button_get_active(check) == is)
		return;
	g_object_ref(row);
	if (column->cells->set(column->cells->owner, row, column->field, is ? "" : "1",
			       &why)) {
		cells_refuse(GTK_WIDGET(check), NULL);
	} else {
		gtk_check_button_set_active(check, is);
		cells_refused(GTK_WIDGET(check), why);
	}
	g_object_unref(row);
}

/* ---- a list of what there is ---- */

#define MANY 8 /* choices; with more of them one can search                    */

static void popover_closed(GtkWidget *popover)
{
	/* Not before its row has been taken. */
	popover_drop_later(popover);
}

static void chosen(GtkWidget *popover, GtkListBoxRow *choice)
{
	const struct column *column = column_of(popover);
	LadderPanelRow *row = g_object_get_data(G_OBJECT(popover), "row");
	char *why = NULL;

	gtk_popover_popdown(GTK_POPOVER(popover));
	iomap_cells_focus(gtk_widget_get_parent(popover), row->index, column->field);
	column->cells->set(column->cells->owner, row, column->field,
			   g_object_get_data(G_OBJECT(choice), "text"), &why);
	g_free(why);
}

static gboolean is_wanted(GtkListBoxRow *row, gpointer search)
{
	char *wanted = g_utf8_casefold(gtk_editable_get_text(search), -1);
	char *text = g_utf8_casefold(g_object_get_data(G_OBJECT(row), "whole"), -1);
	const bool is = strstr(text, wanted) != NULL;

	g_free(wanted);
	g_free(text);
	return is;
}

static GtkWidget *choice_row(const char *text, const char *about)
{
	GtkWidget *row = gtk_list_box_row_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);
	GtkWidget *name = gtk_label_new(*text ? text : _("(none)"));
	GtkWidget *note = gtk_label_new(about);
	char *whole = g_strdup_printf("%s %s", *text ? text : _("(none)"), about);

	gtk_label_set_xalign(GTK_LABEL(name), 0);
	gtk_widget_set_hexpand(name, TRUE);
	gtk_widget_add_css_class(note, "dim-label");
	gtk_widget_add_css_class(note, "caption");
	gtk_box_append(GTK_BOX(box), name);
	gtk_box_append(GTK_BOX(box), note);
	gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
	gtk_accessible_update_property(GTK_ACCESSIBLE(row), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       whole, -1);
	g_object_set_data_full(G_OBJECT(row), "text", g_strdup(text), g_free);
	g_object_set_data_full(G_OBJECT(row), "whole", whole, g_free);
	return row;
}

static GtkWidget *choice_list(GPtrArray *choices, const char *now)
{
	GtkWidget *list = gtk_list_box_new();

	gtk_list_box_set_activate_on_single_click(GTK_LIST_BOX(list), TRUE);
	for (guint i = 0; i + 1 < choices->len; i += 2) {
		GtkWidget *row = choice_row(choices->pdata[i], choices->pdata[i + 1]);

		gtk_list_box_append(GTK_LIST_BOX(list), row);
		if (strcmp(choices->pdata[i], now) == 0)
			gtk_list_box_select_row(GTK_LIST_BOX(list), GTK_LIST_BOX_ROW(row));
	}
	return list;
}

static GtkWidget *choice_popover(GPtrArray *choices, const char *now)
{
	GtkWidget *popover = gtk_popover_new(), *scroller = gtk_scrolled_window_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
	GtkWidget *list = choice_list(choices, now);

	if (choices->len / 2 > MANY) {
		GtkWidget *search = gtk_search_entry_new();

		gtk_accessible_update_property(GTK_ACCESSIBLE(search),
			GTK_ACCESSIBLE_PROPERTY_LABEL, _("Filter"), -1);
		g_signal_connect_swapped(search, "search-changed",
			G_CALLBACK(gtk_list_box_invalidate_filter), list);
		gtk_list_box_set_filter_func(GTK_LIST_BOX(list), is_wanted, search, NULL);
		gtk_box_append(GTK_BOX(box), search);
	}
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
	gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), 280);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), list);
	gtk_box_append(GTK_BOX(box), scroller);
	gtk_popover_set_child(GTK_POPOVER(popover), box);
	gtk_popover_set_position(GTK_POPOVER(popover), GTK_POS_BOTTOM);
	g_signal_connect_swapped(list, "row-activated", G_CALLBACK(chosen), popover);
	g_signal_connect(popover, "closed", G_CALLBACK(popover_closed), NULL);
	return popover;
}

static void show_choices(GtkWidget *cell, GtkListItem *item)
{
	const struct column *column = column_of(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *scroller = gtk_widget_get_ancestor(cell, GTK_TYPE_SCROLLED_WINDOW);
	GPtrArray *choices;
	GtkWidget *popover;
	graphene_rect_t bounds;

	if (!row || !scroller)
		return;
	choices = column->cells->choices(column->cells->owner, row, column->field);
	popover = choice_popover(choices, panel_row_text(row, (int)column->field));
	g_object_set_data(G_OBJECT(popover), "column", (gpointer)column);
	g_object_set_data_full(G_OBJECT(popover), "row", g_object_ref(row), g_object_unref);
	popover_put(popover, scroller);
	if (gtk_widget_compute_bounds(cell, scroller, &bounds))
		gtk_popover_set_pointing_to(GTK_POPOVER(popover), &(GdkRectangle){
			(int)bounds.origin.x, (int)bounds.origin.y,
			(int)bounds.size.width, (int)bounds.size.height });
	gtk_popover_popup(GTK_POPOVER(popover));
	g_ptr_array_unref(choices);
}

static void icon_pressed(GtkEntry *cell, GtkEntryIconPosition position, GtkListItem *item)
{
	(void)position;
	if (has_choices(column_of(GTK_WIDGET(cell))->field))
		show_choices(GTK_WIDGET(cell), item);
}

/* Escape: as it was. Alt+Down: what there is. */
static gboolean pressed(GtkEventControllerKey *keys, guint key, guint code,
			GdkModifierType state, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(keys));
	const struct column *column = column_of(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const char *text = row ? panel_row_text(row, (int)column->field) : "";

	(void)code;
	if (key == GDK_KEY_Down && state & GDK_ALT_MASK && has_choices(column->field)) {
		show_choices(cell, item);
		return TRUE;
	}
	if (key != GDK_KEY_Escape ||
	    strcmp(text, gtk_editable_get_text(GTK_EDITABLE(cell))) == 0)
		return FALSE;
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	give_up(cell);
	return TRUE;
}

/* ---- the factory ---- */

static GtkWidget *entry_new(enum io_field field)
{
	GtkWidget *cell = cell_entry_new();

	cells_add(cell, "focus", gtk_event_controller_focus_new());
	cells_add(cell, "keys", gtk_event_controller_key_new());
	gtk_editable_set_width_chars(GTK_EDITABLE(cell), 4);
	if (has_choices(field)) {
		gtk_entry_set_icon_from_icon_name(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY,
						  "pan-down-symbolic");
		gtk_entry_set_icon_tooltip_text(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY,
						_("What there is (Alt+Down)"));
	}
	return cell;
}

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct column *column = data;
	GtkWidget *cell = column->field == IO_ACTIVE_LOW ? gtk_check_button_new() :
		entry_new(column->field);

	(void)factory;
	g_object_set_data(G_OBJECT(cell), "column", data);
	if (column->field == IO_ACTIVE_LOW)
		gtk_widget_set_halign(cell, GTK_ALIGN_CENTER);
	gtk_list_item_set_child(item, cell);
}

static void bind_entry(GtkWidget *cell, GtkListItem *item, const char *text)
{
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	tip_set(cell, text);
	g_object_set_data(G_OBJECT(cell), "refused", NULL);
	g_signal_connect(cell, "activate", G_CALLBACK(activated), item);
	g_signal_connect(cell, "icon-press", G_CALLBACK(icon_pressed), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "focus"), "leave",
			 G_CALLBACK(left), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "focus"), "enter",
			 G_CALLBACK(entered), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "keys"), "key-pressed",
			 G_CALLBACK(pressed), item);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct column *column = data;
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);
	const char *text = panel_row_text(row, (int)column->field);
	char *name = g_strdup_printf("%s, %s", panel_row_text(row, IO_ADDRESS),
				     io_field_name(column->field));

	(void)factory;
	cells_refuse(cell, NULL);
	cells_stand(cell, item, (int)column->field);
	if (column->field == IO_ACTIVE_LOW) {
		gtk_check_button_set_active(GTK_CHECK_BUTTON(cell), *text);
		g_signal_connect(cell, "toggled", G_CALLBACK(toggled), item);
	} else {
		bind_entry(cell, item, text);
	}
	gtk_accessible_update_property(GTK_ACCESSIBLE(cell),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	panel_speak(cell, row);
	g_free(name);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	(void)data;
	g_signal_handlers_disconnect_by_data(cell, item);
	cells_stand(cell, NULL, 0);
	if (!GTK_IS_ENTRY(cell))
		return;
	g_signal_handlers_disconnect_by_data(g_object_get_data(G_OBJECT(cell), "focus"), item);
	g_signal_handlers_disconnect_by_data(g_object_get_data(G_OBJECT(cell), "keys"), item);
}

static void free_column(gpointer column, GClosure *closure)
{
	(void)closure;
	g_free(column);
}

GtkListItemFactory *iomap_cells(enum io_field field, const struct iomap_cells *cells)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	struct column *column = g_new(struct column, 1);

	*column = (struct column){ field, cells };
	g_signal_connect_data(factory, "setup", G_CALLBACK(setup), column, free_column, 0);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), column);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), column);
	return factory;
}
