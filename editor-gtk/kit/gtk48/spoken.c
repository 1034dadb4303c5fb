/* SPDX-License-Identifier: MIT
 *
 * spoken - accessible names that widgets lack; see spoken.h.
 */
#include "editor-gtk/kit/gtk48/spoken.h"

#include <string.h>

void spoken_name(gpointer widget, const char *name)
{
	gtk_accessible_update_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       name, -1);
}

/* Depth first. */
static GtkWidget *next(GtkWidget *widget, GtkWidget *root)
{
	GtkWidget *found = gtk_widget_get_first_child(widget);

	while (!found && widget != root) {
		found = gtk_widget_get_next_sibling(widget);
		widget = gtk_widget_get_parent(widget);
	}
	return found;
}

static void name_part(GtkWidget *widget)
{
	GtkWidget *parent = gtk_widget_get_parent(widget);
	const char *text = gtk_widget_get_tooltip_text(widget);
	const char *tip = text ? text : gtk_widget_get_tooltip_markup(widget);

	if (GTK_IS_TOGGLE_BUTTON(widget) && GTK_IS_DROP_DOWN(parent))
		gtk_accessible_update_relation(GTK_ACCESSIBLE(widget),
			GTK_ACCESSIBLE_RELATION_LABELLED_BY, parent, NULL, -1);
	else if (GTK_IS_BUTTON(widget) && tip &&
		 strcmp(G_OBJECT_TYPE_NAME(parent), "AdwTab") == 0)
		spoken_name(widget, tip);
	else if (GTK_IS_BUTTON(widget) && gtk_button_get_use_underline(GTK_BUTTON(widget)))
		gtk_accessible_reset_relation(GTK_ACCESSIBLE(widget),
					      GTK_ACCESSIBLE_RELATION_LABELLED_BY);
}

/* It stays visible while it moves in or out. */
static void hide_closed(GtkRevealer *revealer)
{
	gtk_widget_set_visible(GTK_WIDGET(revealer),
			       gtk_revealer_get_reveal_child(revealer) ||
			       gtk_revealer_get_child_revealed(revealer));
}

static void keep_hidden(GtkRevealer *revealer)
{
	g_signal_handlers_disconnect_by_func(revealer, hide_closed, NULL);
	g_signal_connect(revealer, "notify::reveal-child", G_CALLBACK(hide_closed), NULL);
	g_signal_connect(revealer, "notify::child-revealed", G_CALLBACK(hide_closed), NULL);
	hide_closed(revealer);
}

void spoken_parts(GtkWidget *root)
{
	for (GtkWidget *widget = next(root, root); widget; widget = next(widget, root)) {
		name_part(widget);
		if (GTK_IS_REVEALER(widget))
			keep_hidden(GTK_REVEALER(widget));
	}
}

static void say_choice(GtkToggleButton *button)
{
	gtk_accessible_update_state(GTK_ACCESSIBLE(button), GTK_ACCESSIBLE_STATE_CHECKED,
		gtk_toggle_button_get_active(button) ? GTK_ACCESSIBLE_TRISTATE_TRUE :
						       GTK_ACCESSIBLE_TRISTATE_FALSE, -1);
}

void spoken_choice(GtkToggleButton *button)
{
	g_object_set(button, "accessible-role", GTK_ACCESSIBLE_ROLE_RADIO, NULL);
	g_signal_connect(button, "toggled", G_CALLBACK(say_choice), NULL);
	say_choice(button);
}

/* GTK ignores the same text. */
void spoken_say(GtkWidget *widget, const char *text)
{
	gtk_accessible_reset_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_DESCRIPTION);
	gtk_accessible_update_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_DESCRIPTION,
				       text, -1);
}

/* GTK makes the tooltip the description, but not anew. */
static gboolean say_tooltip(gpointer data)
{
	GtkWidget *widget = data;
	const char *tip = gtk_widget_get_tooltip_text(widget);

	g_object_steal_data(data, "spoken-once");
	if (tip)
		spoken_say(widget, tip);
	else
		gtk_accessible_reset_property(GTK_ACCESSIBLE(widget),
					      GTK_ACCESSIBLE_PROPERTY_DESCRIPTION);
	return G_SOURCE_REMOVE;
}

static void stop_timer(gpointer timer)
{
	g_source_remove(GPOINTER_TO_UINT(timer));
}

void spoken_once(GtkWidget *widget, const char *text)
{
	spoken_say(widget, text);
	g_object_set_data_full(G_OBJECT(widget), "spoken-once",
			       GUINT_TO_POINTER(g_timeout_add_seconds(1, say_tooltip, widget)),
			       stop_timer);
}

static void hide_empty(GtkLabel *label)
{
	gtk_widget_set_visible(GTK_WIDGET(label), *gtk_label_get_text(label));
}

void spoken_text(GtkLabel *label)
{
	g_signal_connect(label, "notify::label", G_CALLBACK(hide_empty), NULL);
	hide_empty(label);
}
