/* SPDX-License-Identifier: MIT
 *
 * symbols_cells - cells of the symbol table that can be edited.
 */
#include "editor-gtk/symbols_cells.h"

#include "editor-gtk/i18n.h"

#include <string.h>

struct cells {
	enum field field;
	bool (*set)(gpointer owner, const LadderPanelRow *row, enum field field,
		    const char *text, char **why);
	gpointer owner;
};

static bool is_check(enum field field)
{
	return field == FIELD_RETAIN || field == FIELD_CONSTANT;
}

/* ---- what a person did ---- */

static void show_refusal(GtkWidget *cell, char *why)
{
	if (why) {
		gtk_widget_add_css_class(cell, "error");
		gtk_widget_set_tooltip_text(cell, why);
		gtk_accessible_update_state(GTK_ACCESSIBLE(cell),
			GTK_ACCESSIBLE_STATE_INVALID, GTK_ACCESSIBLE_INVALID_TRUE, -1);
	} else {
		gtk_widget_remove_css_class(cell, "error");
		gtk_widget_set_tooltip_text(cell, NULL);
		gtk_accessible_reset_state(GTK_ACCESSIBLE(cell),
					   GTK_ACCESSIBLE_STATE_INVALID);
	}
	g_free(why);
}

static void edited(GtkEditableLabel *label, GParamSpec *spec, GtkListItem *item)
{
	const struct cells *cells = g_object_get_data(G_OBJECT(label), "cells");
	LadderPanelRow *row = gtk_list_item_get_item(item);
	char *text, *why = NULL;

	(void)spec;
	if (gtk_editable_label_get_editing(label) || !row)
		return;
	text = g_strdup(gtk_editable_get_text(GTK_EDITABLE(label)));
	g_object_ref(row);
	if (strcmp(text, panel_row_text(row, cells->field)) == 0 ||
	    cells->set(cells->owner, row, cells->field, text, &why))
		show_refusal(GTK_WIDGET(label), NULL);
	else
		show_refusal(GTK_WIDGET(label), why ? why : g_strdup(_("Refused")));
	g_object_unref(row);
	g_free(text);
}

static void toggled(GtkCheckButton *check, GtkListItem *item)
{
	const struct cells *cells = g_object_get_data(G_OBJECT(check), "cells");
	LadderPanelRow *row = gtk_list_item_get_item(item);
	const bool is = row && *panel_row_text(row, cells->field);
	char *why = NULL;

	if (!row || gtk_check_button_get_active(check) == is)
		return;
	g_object_ref(row);
	if (cells->set(cells->owner, row, cells->field, is ? "" : "1", &why))
		show_refusal(GTK_WIDGET(check), NULL);
	else {
		gtk_check_button_set_active(check, is);
		show_refusal(GTK_WIDGET(check), why ? why : g_strdup(_("Refused")));
	}
	g_object_unref(row);
}

/* ---- the factory ---- */

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct cells *cells = data;
	GtkWidget *cell = is_check(cells->field) ? gtk_check_button_new() :
						   gtk_editable_label_new("");

	(void)factory;
	g_object_set_data(G_OBJECT(cell), "cells", data);
	if (is_check(cells->field))
		gtk_widget_set_halign(cell, GTK_ALIGN_CENTER);
	gtk_list_item_set_child(item, cell);
}

static bool is_fixed(const struct cells *cells, const LadderPanelRow *row)
{
	if (row->flags & SYMBOLS_FIXED)
		return true;
	return row->flags & SYMBOLS_MEMBER && (is_check(cells->field) ||
					       cells->field == FIELD_ADDRESS);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data)
{
	const struct cells *cells = data;
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *cell = gtk_list_item_get_child(item);
	const char *text = panel_row_text(row, cells->field);
	char *name = g_strdup_printf("%s, %s", panel_row_text(row, FIELD_NAME),
				     symbol_field_name(cells->field));

	(void)factory;
	show_refusal(cell, NULL);
	gtk_widget_set_sensitive(cell, !is_fixed(cells, row));
	if (is_check(cells->field)) {
		gtk_check_button_set_active(GTK_CHECK_BUTTON(cell), *text);
		g_signal_connect(cell, "toggled", G_CALLBACK(toggled), item);
	} else {
		gtk_editable_set_text(GTK_EDITABLE(cell), text);
		g_signal_connect(cell, "notify::editing", G_CALLBACK(edited), item);
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
	if (GTK_IS_EDITABLE_LABEL(cell))
		gtk_editable_label_stop_editing(GTK_EDITABLE_LABEL(cell), FALSE);
}

static void free_cells(gpointer cells, GClosure *closure)
{
	(void)closure;
	g_free(cells);
}

GtkListItemFactory *symbols_cells(enum field field,
				  bool (*set)(gpointer owner, const LadderPanelRow *row,
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
