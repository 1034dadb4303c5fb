/* SPDX-License-Identifier: MIT
 *
 * sim_panel_bound - keys that a person gave to inputs: they act while the program is
 * simulated, wherever in the window the focus is, but where a text is written.
 */
#include "editor-gtk/live/sim_panel_inside.h"

/* A line that is on as long as a key is down. */
struct held {
	guint code;              /* of the keyboard: what is typed may change    */
	LadderSimRow *row;
};

static void held_free(gpointer data)
{
	struct held *held = data;

	g_object_unref(held->row);
	g_free(held);
}

bool sim_panel_can_bind(guint key)
{
	const gunichar letter = gdk_keyval_to_unicode(key);

	return (key >= GDK_KEY_F1 && key <= GDK_KEY_F12) ||
	       (key >= GDK_KEY_KP_0 && key <= GDK_KEY_KP_9) ||
	       (letter && g_unichar_isgraph(letter));
}

static void give(LadderSimPanel *panel, LadderSimRow *row, gint64 to)
{
	sim_row_set(row, panel->sim, row->at, (union iec_value){ .i = to });
}

void sim_panel_let_go_bound(LadderSimPanel *panel)
{
	while (panel->bound && panel->bound->len) {
		struct held *held = g_ptr_array_index(panel->bound, panel->bound->len - 1);

		give(panel, held->row, 0);
		g_ptr_array_set_size(panel->bound, (gint)panel->bound->len - 1);
	}
}

static bool is_down(const LadderSimPanel *panel, guint code)
{
	for (guint i = 0; i < panel->bound->len; i++)
		if (((struct held *)panel->bound->pdata[i])->code == code)
			return true;
	return false;
}

static void press(LadderSimPanel *panel, LadderSimRow *row, guint code)
{
	struct held *held;

	if (row->key_toggles) {
		give(panel, row, !sim_row_value(row, panel->sim, row->at).i);
		return;
	}
	held = g_new(struct held, 1);
	held->code = code;
	held->row = g_object_ref(row);
	g_ptr_array_add(panel->bound, held);
	give(panel, row, 1);
}

/* A key that toggles repeats itself, too: it does so once. */
static bool act(LadderSimPanel *panel, guint key, guint code, bool repeats)
{
	const char *name = gdk_keyval_name(gdk_keyval_to_lower(key));
	bool any = false;

	for (guint i = 0; i < panel->rows->len; i++) {
		LadderSimRow *row = g_ptr_array_index(panel->rows, i);

		if (!row->key || g_strcmp0(row->key, name) != 0 || !sim_row_is_bit(row))
			continue;
		any = true;
		if (!repeats)
			press(panel, row, code);
	}
	return any;
}

static bool is_writing(LadderSimPanel *panel)
{
	GtkWidget *focus = gtk_root_get_focus(panel->root);

	return focus && (GTK_IS_EDITABLE(focus) || GTK_IS_TEXT_VIEW(focus));
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderSimPanel *panel)
{
	const bool repeats = panel->last_code == code || is_down(panel, code);

	(void)keys;
	if (!panel->on || panel->asking || is_writing(panel) ||
	    state & (GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK))
		return GDK_EVENT_PROPAGATE;
	if (!act(panel, key, code, repeats))
		return GDK_EVENT_PROPAGATE;
	panel->last_code = code;
	return GDK_EVENT_STOP;
}

static void key_released(GtkEventControllerKey *keys, guint key, guint code,
			 GdkModifierType state, LadderSimPanel *panel)
{
	(void)keys;
	(void)key;
	(void)state;
	if (panel->last_code == code)
		panel->last_code = 0;
	for (guint i = panel->bound->len; i-- > 0;) {
		struct held *held = g_ptr_array_index(panel->bound, i);

		if (held->code != code)
			continue;
		give(panel, held->row, 0);
		g_ptr_array_remove_index(panel->bound, i);
	}
}

/* Nobody tells of a release in another window. */
static void active_changed(LadderSimPanel *panel)
{
	if (!gtk_window_is_active(GTK_WINDOW(panel->root)))
		sim_panel_let_go(panel);
}

void sim_panel_bind_root(LadderSimPanel *panel, GtkRoot *root)
{
	if (!GTK_IS_WINDOW(root))
		return;
	panel->root = root;
	panel->bound = g_ptr_array_new_with_free_func(held_free);
	panel->root_keys = gtk_event_controller_key_new();
	gtk_event_controller_set_propagation_phase(panel->root_keys, GTK_PHASE_CAPTURE);
	g_signal_connect(panel->root_keys, "key-pressed", G_CALLBACK(key_pressed), panel);
	g_signal_connect(panel->root_keys, "key-released", G_CALLBACK(key_released), panel);
	gtk_widget_add_controller(GTK_WIDGET(root), panel->root_keys);
	panel->root_active = g_signal_connect_swapped(root, "notify::is-active",
						      G_CALLBACK(active_changed), panel);
}

void sim_panel_unbind_root(LadderSimPanel *panel)
{
	if (!panel->root)
		return;
	sim_panel_let_go_bound(panel);
	g_signal_handler_disconnect(panel->root, panel->root_active);
	gtk_widget_remove_controller(GTK_WIDGET(panel->root), panel->root_keys);
	g_clear_pointer(&panel->bound, g_ptr_array_unref);
	panel->root_keys = NULL;
	panel->root = NULL;
}
