/* SPDX-License-Identifier: MIT
 *
 * panel_cells - editable cells of a panel's list.
 */
#include "editor-gtk/document/panel_cells.h"

#include "editor-gtk/kit/cell_entry.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

#include <string.h>

struct column {
	int field;
	const struct panel_cells *cells;
};

static const struct column *column_of(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "column");
}

static bool is_check(const struct column *column)
{
	return column->cells->checks >> column->field & 1;
}

static bool has_choices(const struct column *column)
{
	return column->cells->choosable >> column->field & 1;
}

static GtkListItem *item_of(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "item");
}

static const char *refused_text(GtkWidget *cell)
{
	return g_object_get_data(G_OBJECT(cell), "refused");
}

static bool set(const struct column *column, LadderPanelRow *row, const char *text,
		char **why)
{
	return column->cells->set(column->cells->owner, row, column->field, text, why);
}

/* ---- an edit of a text ---- */

/* @refused: the refused text, taken over; NULL: the row has the text of the cell. */
static void mark(GtkWidget *cell, char *refused, char *why)
{
	const char *text = gtk_editable_get_text(GTK_EDITABLE(cell));

	if (refused) {
		cells_refused(cell, why);
	} else {
		cells_refuse(cell, NULL);
		tip_set(cell, text);
		g_object_set_data_full(G_OBJECT(cell), "shown", g_strdup(text), g_free);
	}
	g_object_set_data_full(G_OBJECT(cell), "refused", refused, g_free);
}

/* The new text; NULL: it is unchanged, or was refused already. Caller: g_free. */
static char *edited(GtkWidget *cell, const LadderPanelRow *row)
{
	const struct column *column = column_of(cell);
	const char *refused = refused_text(cell);
	char *text = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(cell))));

	if (row && g_strcmp0(refused, text) != 0 &&
	    strcmp(text, panel_row_text(row, column->field)) != 0)
		return text;
	g_free(text);
	return NULL;
}

static bool apply(GtkWidget *cell, LadderPanelRow *row, const char *text)
{
	char *why = NULL;
	bool good;

	g_object_ref(row);
	g_object_ref(cell);
	good = set(column_of(cell), row, text, &why);
	mark(cell, good ? NULL : g_strdup(text), why);
	g_object_unref(cell);
	g_object_unref(row);
	return good;
}

/* Restores the text from before the edit. */
static void give_up(GtkWidget *cell, LadderPanelRow *row)
{
	const struct panel_cells *cells = column_of(cell)->cells;
	const bool refused = refused_text(cell);

	if (!cells->given_up) {
		if (refused && row)
			apply(cell, row, gtk_editable_get_text(GTK_EDITABLE(cell)));
		return;
	}
	mark(cell, NULL, NULL);
	cells->given_up(cells->owner);
}

static bool is_as_before(GtkWidget *cell, const LadderPanelRow *row)
{
	return row && strcmp(gtk_editable_get_text(GTK_EDITABLE(cell)),
			     panel_row_text(row, column_of(cell)->field)) == 0;
}

/* False: it is refused. A text that was refused before is not tried again. */
static bool commit(GtkWidget *cell, GtkListItem *item)
{
	LadderPanelRow *row = gtk_list_item_get_item(item);
	char *text = edited(cell, row);
	bool good = true;

	if (text)
		good = apply(cell, row, text);
	else if (refused_text(cell) && is_as_before(cell, row))
		give_up(cell, row);
	g_free(text);
	return good;
}

static void activated(GtkEntry *cell, GtkListItem *item)
{
	commit(GTK_WIDGET(cell), item);
}

/* An edit that is set when the focus has moved. */
struct later {
	const struct column *column;
	GtkWidget *cell;
	LadderPanelRow *row;
	char *text;
};

static gboolean do_later(gpointer data)
{
	struct later *later = data;
	char *why = NULL;
	const bool good = set(later->column, later->row, later->text, &why);
	GtkListItem *item = item_of(later->cell);

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

static void left(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	GtkRoot *root = gtk_widget_get_root(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	struct later *later;
	char *text;

	/* the window committed the edit before it closes */
	if (root ? gtk_widget_in_destruction(GTK_WIDGET(root)) :
		   !column_of(cell)->cells->later)
		return;
	gtk_editable_select_region(GTK_EDITABLE(cell), 0, 0);
	text = column_of(cell)->cells->later ? edited(cell, row) : NULL;
	if (!text) {
		commit(cell, item);
		return;
	}
	later = g_new(struct later, 1);
	*later = (struct later){ column_of(cell), g_object_ref(cell), g_object_ref(row),
				 text };
	g_object_ref(later->column->cells->owner);
	g_idle_add_full(G_PRIORITY_HIGH_IDLE, do_later, later, later_free);
}

/* Actions of the panel apply to the row whose cell has the focus. */
static void entered(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	GtkWidget *table = gtk_widget_get_ancestor(cell, GTK_TYPE_COLUMN_VIEW);

	if (table)
		gtk_single_selection_set_selected(GTK_SINGLE_SELECTION(
			gtk_column_view_get_model(GTK_COLUMN_VIEW(table))),
			gtk_list_item_get_position(item));
}

void panel_cells_commit(GtkColumnView *view)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(view));
	GtkWidget *cell = root ? gtk_root_get_focus(root) : NULL;

	while (cell && cell != GTK_WIDGET(view) && !column_of(cell))
		cell = gtk_widget_get_parent(cell);
	if (cell && gtk_widget_is_ancestor(cell, GTK_WIDGET(view)) && GTK_IS_ENTRY(cell) &&
	    item_of(cell))
		commit(cell, item_of(cell));
}

bool panel_cells_focus(GtkWidget *within, int row, int field)
{
	const struct column *column = column_of(within);
	GtkListItem *item = column ? item_of(within) : NULL;
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
		if (panel_cells_focus(child, row, field))
			return true;
	return false;
}

static void toggled(GtkCheckButton *check, GtkListItem *item)
{
	const struct column *column = column_of(GTK_WIDGET(check));
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const bool is = row && *panel_row_text(row, column->field);
	char *why = NULL;

	if (!row || gtk_check_button_get_active(check) == is)
		return;
	/* the list has focused the first cell of the row */
	gtk_widget_grab_focus(GTK_WIDGET(check));
	g_object_ref(row);
	if (set(column, row, is ? "" : "1", &why)) {
		cells_refuse(GTK_WIDGET(check), NULL);
	} else {
		gtk_check_button_set_active(check, is);
		cells_refused(GTK_WIDGET(check), why);
	}
	g_object_unref(row);
}

/* ---- choices ---- */

#define MANY 8 /* choices; longer lists get a search entry                     */

static void popover_closed(GtkWidget *popover)
{
	/* Not before the choice has been taken. */
	popover_drop_later(popover);
}

static void chosen(GtkWidget *popover, GtkListBoxRow *choice)
{
	const struct column *column = column_of(popover);
	LadderPanelRow *row = g_object_get_data(G_OBJECT(popover), "row");
	char *why = NULL;

	gtk_popover_popdown(GTK_POPOVER(popover));
	panel_cells_focus(gtk_widget_get_parent(popover), row->index, column->field);
	set(column, row, g_object_get_data(G_OBJECT(choice), "text"), &why);
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
	choices = column->cells->choices(column->cells->owner, column->field);
	popover = choice_popover(choices, panel_row_text(row, column->field));
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
	if (has_choices(column_of(GTK_WIDGET(cell))))
		show_choices(GTK_WIDGET(cell), item);
}

/* Esc restores the text. Alt+Down opens the choices. */
static gboolean pressed(GtkEventControllerKey *keys, guint key, guint code,
			GdkModifierType state, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(keys));
	const struct column *column = column_of(cell);
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const char *text = row ? panel_row_text(row, column->field) : "";

	(void)code;
	if (key == GDK_KEY_Down && state & GDK_ALT_MASK && has_choices(column)) {
		show_choices(cell, item);
		return TRUE;
	}
	if (key != GDK_KEY_Escape ||
	    strcmp(text, gtk_editable_get_text(GTK_EDITABLE(cell))) == 0)
		return FALSE;
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	give_up(cell, row);
	return TRUE;
}

/* ---- the factory ---- */

static GtkWidget *entry_new(const struct column *column)
{
	GtkWidget *cell = cell_entry_new();

	cells_add(cell, "focus", gtk_event_controller_focus_new());
	cells_add(cell, "keys", gtk_event_controller_key_new());
	gtk_editable_set_width_chars(GTK_EDITABLE(cell), 4);
	if (has_choices(column)) {
		gtk_entry_set_icon_tooltip_text(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY,
						_("Choices (Alt+Down)"));
	}
	return cell;
}

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct column *column = data;
	GtkWidget *cell = is_check(column) ? gtk_check_button_new() : entry_new(column);

	(void)factory;
	g_object_set_data(G_OBJECT(cell), "column", data);
	if (is_check(column))
		gtk_widget_set_halign(cell, GTK_ALIGN_CENTER);
	gtk_list_item_set_child(item, cell);
}

static void connect_entry(GtkWidget *cell, GtkListItem *item)
{
	GObject *focus = g_object_get_data(G_OBJECT(cell), "focus");

	g_signal_connect(cell, "activate", G_CALLBACK(activated), item);
	g_signal_connect(cell, "icon-press", G_CALLBACK(icon_pressed), item);
	g_signal_connect(focus, "leave", G_CALLBACK(left), item);
	g_signal_connect(focus, "enter", G_CALLBACK(entered), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "keys"), "key-pressed",
			 G_CALLBACK(pressed), item);
	if (!column_of(cell)->cells->later)
		cells_on_take(cell, commit, item);
}

/* Keeps the text that is being typed. */
static void show_text(GtkWidget *cell, const char *text)
{
	const char *shown = g_object_get_data(G_OBJECT(cell), "shown");
	const char *now = gtk_editable_get_text(GTK_EDITABLE(cell));

	if (shown && strcmp(shown, now) != 0)
		return;
	if (strcmp(now, text) != 0)
		gtk_editable_set_text(GTK_EDITABLE(cell), text);
	g_object_set_data_full(G_OBJECT(cell), "shown", g_strdup(text), g_free);
	tip_set(cell, text);
}

static void show(LadderPanelRow *row, GtkListItem *item)
{
	GtkWidget *cell = gtk_list_item_get_child(item);
	const struct column *column = column_of(cell);
	const struct panel_cells *cells = column->cells;
	const char *text = panel_row_text(row, column->field);
	char *name = g_strdup_printf("%s, %s", panel_row_text(row, 0),
				     cells->name(column->field));
	const bool fixed = cells->is_fixed && cells->is_fixed(row, column->field);

	gtk_widget_set_sensitive(cell, !fixed);
	if (has_choices(column))
		gtk_entry_set_icon_from_icon_name(GTK_ENTRY(cell), GTK_ENTRY_ICON_SECONDARY,
						  fixed ? NULL : "pan-down-symbolic");
	if (cells->dress)
		cells->dress(cell, row, column->field);
	if (is_check(column))
		gtk_check_button_set_active(GTK_CHECK_BUTTON(cell), *text);
	else
		show_text(cell, text);
	gtk_accessible_update_property(GTK_ACCESSIBLE(cell),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	panel_speak(cell, row);
	g_free(name);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct column *column = data;
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	cells_refuse(cell, NULL);
	cells_stand(cell, item, column->field);
	g_object_set_data(G_OBJECT(cell), "refused", NULL);
	g_object_set_data(G_OBJECT(cell), "shown", NULL);
	show(row, item);
	g_signal_connect(row, "changed", G_CALLBACK(show), item);
	if (is_check(column))
		g_signal_connect(cell, "toggled", G_CALLBACK(toggled), item);
	else
		connect_entry(cell, item);
}

static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	(void)data;
	g_signal_handlers_disconnect_by_data(gtk_list_item_get_item(item), item);
	g_signal_handlers_disconnect_by_data(cell, item);
	cells_stand(cell, NULL, 0);
	if (!GTK_IS_ENTRY(cell))
		return;
	cells_on_take(cell, NULL, NULL);
	g_signal_handlers_disconnect_by_data(g_object_get_data(G_OBJECT(cell), "focus"), item);
	g_signal_handlers_disconnect_by_data(g_object_get_data(G_OBJECT(cell), "keys"), item);
}

static void free_column(gpointer column, GClosure *closure)
{
	(void)closure;
	g_free(column);
}

void panel_cells_add(struct panel_list *list, const struct panel_cells *cells, int field,
		     unsigned int flags, int width)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	struct column *column = g_new(struct column, 1);

	*column = (struct column){ field, cells };
	g_signal_connect_data(factory, "setup", G_CALLBACK(setup), column, free_column, 0);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), column);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), column);
	panel_list_add(list, cells->name(field), field, flags, width, factory);
}
