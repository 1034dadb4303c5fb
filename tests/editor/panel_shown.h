/* SPDX-License-Identifier: MIT
 *
 * panel_shown - the texts in the widgets of the simulation panel, for tests.
 */
#ifndef TESTS_EDITOR_PANEL_SHOWN_H
#define TESTS_EDITOR_PANEL_SHOWN_H

#include "editor-gtk/live/sim_panel.h"
#include "editor-gtk/live/sim_panel_view.h"

/* The first descendant for which @is is true, not inside row views; NULL: none. */
static GtkWidget *panel_find(GtkWidget *widget, bool (*is)(GtkWidget *widget, const void *data),
			     const void *data)
{
	GtkWidget *found = NULL, *child = gtk_widget_get_first_child(widget);

	for (; child && !found; child = gtk_widget_get_next_sibling(child))
		found = is(child, data) ? child :
			LADDER_IS_SIM_ROW_VIEW(child) ? NULL : panel_find(child, is, data);
	return found;
}

static bool panel_is_type(GtkWidget *widget, const void *type)
{
	return g_type_is_a(G_OBJECT_TYPE(widget), *(const GType *)type);
}

static bool panel_has_class(GtkWidget *widget, const void *class)
{
	return gtk_widget_has_css_class(widget, class);
}

static bool panel_has_name(GtkWidget *widget, const void *name)
{
	return strcmp(gtk_widget_get_css_name(widget), name) == 0;
}

static bool panel_shows_row(GtkWidget *widget, const void *row)
{
	return LADDER_IS_SIM_ROW_VIEW(widget) &&
	       ladder_sim_row_view_row(LADDER_SIM_ROW_VIEW(widget)) == row;
}

/* Of LadderSimRow, with headings, as listed. */
static GListModel *panel_list(LadderSimPanel *panel)
{
	const GType type = GTK_TYPE_LIST_VIEW;
	GtkWidget *list = panel_find(GTK_WIDGET(panel), panel_is_type, &type);

	return G_LIST_MODEL(gtk_list_view_get_model(GTK_LIST_VIEW(list)));
}

/* The text of a row's widget, as if it were visible: "0" or "1" of a bit, "1.0 s / 2 s" of a
 * timer, else the value. NULL: no widget shows it. Caller frees. */
static char *panel_shown(LadderSimPanel *panel, const LadderSimRow *row)
{
	const GType type = row->push ? GTK_TYPE_TOGGLE_BUTTON : GTK_TYPE_SWITCH;
	GtkWidget *view = panel_find(GTK_WIDGET(panel), panel_shows_row, row);
	gboolean active;

	if (!view || row->kind == SIM_HEADING)
		return NULL;
	ladder_sim_row_view_update(LADDER_SIM_ROW_VIEW(view));
	if (!sim_row_is_bit(row))
		return g_strdup(gtk_label_get_text(GTK_LABEL(panel_find(view, panel_has_class,
									"sim-value"))));
	if (row->kind == SIM_SWITCH)
		g_object_get(panel_find(view, panel_is_type, &type), "active", &active, NULL);
	else
		active = gtk_widget_has_css_class(panel_find(view, panel_has_name, "lamp"), "on");
	return g_strdup(active ? "1" : "0");
}

/* "0" or "1": the lamp of a row's widget. NULL: no widget shows it. Caller frees. */
static inline char *panel_lamp(LadderSimPanel *panel, const LadderSimRow *row)
{
	GtkWidget *view = panel_find(GTK_WIDGET(panel), panel_shows_row, row);

	if (!view)
		return NULL;
	ladder_sim_row_view_update(LADDER_SIM_ROW_VIEW(view));
	return g_strdup(gtk_widget_has_css_class(panel_find(view, panel_has_name, "lamp"), "on") ?
			"1" : "0");
}

#endif
