/* SPDX-License-Identifier: MIT
 *
 * paned - switches the gestures of a paned off while a child is hidden; see paned.h.
 */
#include "editor-gtk/kit/gtk48/paned.h"

#include <stdbool.h>

#define PHASE "paned-phase" /* of the gesture, as GTK has set it, + 1 */

static bool is_seen(GtkWidget *child)
{
	return child && gtk_widget_get_visible(child);
}

static void take_presses(GtkEventController *gesture, bool take)
{
	gpointer kept = g_object_get_data(G_OBJECT(gesture), PHASE);

	if (!kept) {
		kept = GINT_TO_POINTER(gtk_event_controller_get_propagation_phase(gesture) + 1);
		g_object_set_data(G_OBJECT(gesture), PHASE, kept);
	}
	gtk_event_controller_set_propagation_phase(gesture, take ?
		(GtkPropagationPhase)(GPOINTER_TO_INT(kept) - 1) : GTK_PHASE_NONE);
}

static void child_changed(GtkPaned *paned)
{
	const bool both = is_seen(gtk_paned_get_start_child(paned)) && is_seen(gtk_paned_get_end_child(paned));
	GListModel *all = gtk_widget_observe_controllers(GTK_WIDGET(paned));

	for (guint i = 0; i < g_list_model_get_n_items(all); i++) {
		GtkEventController *each = g_list_model_get_item(all, i);

		if (GTK_IS_GESTURE_DRAG(each))
			take_presses(each, both);
		g_object_unref(each);
	}
	g_object_unref(all);
}

static void children_changed(GtkPaned *paned)
{
	GtkWidget *child[] = { gtk_paned_get_start_child(paned), gtk_paned_get_end_child(paned) };

	for (size_t i = 0; i < G_N_ELEMENTS(child); i++) {
		if (!child[i])
			continue;
		g_signal_handlers_disconnect_by_func(child[i], child_changed, paned);
		g_signal_connect_object(child[i], "notify::visible", G_CALLBACK(child_changed), paned,
					G_CONNECT_SWAPPED);
	}
	child_changed(paned);
}

void paned_mend(GtkPaned *paned)
{
	g_signal_connect(paned, "notify::start-child", G_CALLBACK(children_changed), NULL);
	g_signal_connect(paned, "notify::end-child", G_CALLBACK(children_changed), NULL);
	children_changed(paned);
}
