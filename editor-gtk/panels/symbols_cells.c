/* SPDX-License-Identifier: MIT
 *
 * symbols_cells - cells of the symbol table that can be edited.
 */
#include "editor-gtk/panels/symbols_cells.h"

#include "editor-gtk/kit/cell_entry.h"
#include "editor-gtk/kit/cells.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

struct cells {
	enum field field;
	bool (*set)(gpointer owner, LadderPanelRow *row, enum field field,
		    const char *text, char **why);
	gpointer owner;
};

static bool is_check(enum field field)
{
	return field == FIELD_RETAIN || field == FIELD_CONSTANT;
}

/* ---- what a person did ---- */

/* The row has it now, and shows what became of it. @text: taken over. */
static void taken(GtkWidget *cell, char *text)
{
	cells_refuse(cell, NULL);
	tip_set(cell, text);
	g_object_set_data_full(G_OBJECT(cell), "shown", text, g_free);
}

/* What stands in the cell is what is meant, unless it was refused already. */
static bool commit(GtkWidget *cell, GtkListItem *item)
{
	const struct cells *cells = g_object_get_data(G_OBJECT(cell), "cells");
	const char *refused = g_object_get_data(G_OBJECT(cell), "refused");
	LadderPanelRow *row = gtk_list_item_get_item(item);
	char *text, *why = NULL;
	bool good;

	if (!row)
		return true;
	text = g_strdup(gtk_editable_get_text(GTK_EDITABLE(cell)));
	if (refused && strcmp(refused, text) == 0) {
		g_free(text);
		return true;
	}
	g_object_ref(row);
	g_object_ref(cell);
	/* What is as it was is told, too, if that was refused before: it is no more. */
	good = (!refused && strcmp(text, panel_row_text(row, cells->field)) == 0) ||
	       cells->set(cells->owner, row, cells->field, text, &why);
	if (good)
		taken(cell, text);
	else
		cells_refused(cell, why);
	g_object_set_data_full(G_OBJECT(cell), "refused", good ? NULL : text, g_free);
	g_object_unref(cell);
	g_object_unref(row);
	return good;
}

static void activated(GtkEntry *cell, GtkListItem *item)
{
	commit(GTK_WIDGET(cell), item);
}

static void left(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	GtkRoot *root = gtk_widget_get_root(cell);

	/* A window that goes took what was typed before (cells_take). */
	if (!root || gtk_widget_in_destruction(GTK_WIDGET(root)))
		return;
	gtk_editable_select_region(GTK_EDITABLE(cell), 0, 0);
	commit(cell, item);
}

/* Its row is the one that what is done next is done with. */
static void entered(GtkEventControllerFocus *focus, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus));
	GtkWidget *table = gtk_widget_get_ancestor(cell, GTK_TYPE_COLUMN_VIEW);

	if (table)
		gtk_single_selection_set_selected(GTK_SINGLE_SELECTION(
			gtk_column_view_get_model(GTK_COLUMN_VIEW(table))),
			gtk_list_item_get_position(item));
}

/* Escape: as it was. */
static gboolean pressed(GtkEventControllerKey *keys, guint key, guint code,
			GdkModifierType state, GtkListItem *item)
{
	GtkWidget *cell = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(keys));
	const struct cells *cells = g_object_get_data(G_OBJECT(cell), "cells");
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const char *text = row ? panel_row_text(row, cells->field) : "";

	(void)code;
	(void)state;
	if (key != GDK_KEY_Escape ||
	    strcmp(text, gtk_editable_get_text(GTK_EDITABLE(cell))) == 0)
		return FALSE;
	gtk_editable_set_text(GTK_EDITABLE(cell), text);
	commit(cell, item);
	return TRUE;
}

static void toggled(GtkCheckButton *check, GtkListItem *item)
{
	const struct cells *cells = g_object_get_data(G_OBJECT(check), "cells");
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const bool is = row && *panel_row_text(row, cells->field);
	char *why = NULL;

	if (!row || gtk_check_button_get_active(check) == is)
		return;
	/* The list gave the keys to the first cell of the row that was clicked. */
	gtk_widget_grab_focus(GTK_WIDGET(check));
	g_object_ref(row);
	if (cells->set(cells->owner, row, cells->field, is ? "" : "1", &why))
		cells_refuse(GTK_WIDGET(check), NULL);
	else {
		gtk_check_button_set_active(check, is);
		cells_refused(GTK_WIDGET(check), why);
	}
	g_object_unref(row);
}

/* ---- the factory ---- */

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct cells *cells = data;
	GtkWidget *cell = is_check(cells->field) ? gtk_check_button_new() : cell_entry_new();

	(void)factory;
	g_object_set_data(G_OBJECT(cell), "cells", data);
	if (is_check(cells->field)) {
		gtk_widget_set_halign(cell, GTK_ALIGN_CENTER);
	} else {
		cells_add(cell, "focus", gtk_event_controller_focus_new());
		cells_add(cell, "keys", gtk_event_controller_key_new());
	}
	gtk_list_item_set_child(item, cell);
}

static void connect_text(GtkWidget *cell, GtkListItem *item)
{
	g_signal_connect(cell, "activate", G_CALLBACK(activated), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "focus"), "leave",
			 G_CALLBACK(left), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "focus"), "enter",
			 G_CALLBACK(entered), item);
	g_signal_connect(g_object_get_data(G_OBJECT(cell), "keys"), "key-pressed",
			 G_CALLBACK(pressed), item);
	cells_on_take(cell, commit, item);
}

static bool is_fixed(const struct cells *cells, const LadderPanelRow *row)
{
	if (row->flags & SYMBOLS_FIXED)
		return true;
	return row->flags & SYMBOLS_MEMBER && (is_check(cells->field) ||
					       cells->field == FIELD_ADDRESS);
}

/* What somebody types there stays. */
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
	const struct cells *cells = g_object_get_data(G_OBJECT(cell), "cells");
	const char *text = panel_row_text(row, cells->field);
	char *name = g_strdup_printf("%s, %s", panel_row_text(row, FIELD_NAME),
				     symbol_field_name(cells->field));

	gtk_widget_set_sensitive(cell, !is_fixed(cells, row));
	if (is_check(cells->field))
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
	const struct cells *cells = data;
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);

	(void)factory;
	cells_refuse(cell, NULL);
	cells_stand(cell, item, (int)cells->field);
	g_object_set_data(G_OBJECT(cell), "refused", NULL);
	g_object_set_data(G_OBJECT(cell), "shown", NULL);
	show(row, item);
	g_signal_connect(row, "changed", G_CALLBACK(show), item);
	if (is_check(cells->field))
		g_signal_connect(cell, "toggled", G_CALLBACK(toggled), item);
	else
		connect_text(cell, item);
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

static void free_cells(gpointer cells, GClosure *closure)
{
	(void)closure;
	g_free(cells);
}

GtkListItemFactory *symbols_cells(enum field field,
				  bool (*set)(gpointer owner, LadderPanelRow *row,
					      enum field field, const char *text,
					      char **why),
				  gpointer owner)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	struct cells *cells = g_new(struct cells, 1);

	*cells = (struct cells){ field, set, owner };
	g_signal_connect_data(factory, "setup", G_CALLBACK(setup), cells, free_cells, 0);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), cells);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), cells);
	return factory;
}
