/* SPDX-License-Identifier: MIT
 *
 * cells - what cells that can be edited share; see cells.h.
 */
#include "editor-gtk/cells.h"

#include "editor-gtk/i18n.h"
#include "editor-gtk/tip.h"

/* Not by its colour alone: what was refused may be an empty text. */
static void show_icon(GtkEntry *cell, const char *why)
{
	const char *shown = gtk_entry_get_icon_name(cell, GTK_ENTRY_ICON_PRIMARY);
	const char *name = why ? "dialog-error-symbolic" : NULL;

	if (g_strcmp0(shown, name) != 0)
		gtk_entry_set_icon_from_icon_name(cell, GTK_ENTRY_ICON_PRIMARY, name);
	if (why)
		gtk_entry_set_icon_tooltip_text(cell, GTK_ENTRY_ICON_PRIMARY, why);
}

void cells_refuse(GtkWidget *cell, char *why)
{
	if (GTK_IS_ENTRY(cell))
		show_icon(GTK_ENTRY(cell), why);
	if (why) {
		gtk_widget_add_css_class(cell, "error");
		tip_set(cell, why);
		gtk_accessible_update_state(GTK_ACCESSIBLE(cell),
			GTK_ACCESSIBLE_STATE_INVALID, GTK_ACCESSIBLE_INVALID_TRUE, -1);
	} else {
		gtk_widget_remove_css_class(cell, "error");
		tip_set(cell, NULL);
		gtk_accessible_reset_state(GTK_ACCESSIBLE(cell),
					   GTK_ACCESSIBLE_STATE_INVALID);
	}
	g_free(why);
}

void cells_refused(GtkWidget *cell, char *why)
{
	cells_refuse(cell, why ? why : g_strdup(_("Refused")));
}

void cells_add(GtkWidget *cell, const char *name, GtkEventController *controller)
{
	gtk_widget_add_controller(cell, controller);
	g_object_set_data(G_OBJECT(cell), name, controller);
}

/* ---- an edit that is to end where it stands ---- */

struct take {
	bool (*take)(GtkWidget *cell, GtkListItem *item);
	GtkListItem *item;   /* borrowed: the cell is bound as long           */
};

void cells_on_take(GtkWidget *cell, bool (*take)(GtkWidget *cell, GtkListItem *item),
		   GtkListItem *item)
{
	const struct take how = { take, item };

	g_object_set_data_full(G_OBJECT(cell), "take",
			       take ? g_memdup2(&how, sizeof(how)) : NULL, g_free);
}

bool cells_take(GtkWidget *focus)
{
	for (; focus; focus = gtk_widget_get_parent(focus)) {
		const struct take *how = g_object_get_data(G_OBJECT(focus), "take");

		if (how)
			return how->take(focus, how->item);
	}
	return true;
}
