/* SPDX-License-Identifier: MIT
 *
 * sim_panel_keys - what keys and the menu do in the simulation panel: with the selected line.
 */
#include "editor-gtk/live/sim_panel_inside.h"

#include "editor-gtk/kit/i18n.h"

/* ---- keys ---- */

void sim_panel_let_go(LadderSimPanel *panel)
{
	if (panel->held)
		sim_row_unpress(panel->held, panel->sim);
	g_clear_object(&panel->held);
	sim_panel_let_go_bound(panel);
}

static bool is_typing(LadderSimPanel *panel)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(panel));

	return root && GTK_IS_EDITABLE(gtk_root_get_focus(root));
}

/* The line does more than to be activated: space is held. */
static bool press(LadderSimPanel *panel)
{
	LadderSimRow *row = sim_panel_selected(panel);

	if (panel->held)
		return true; /* the key repeats itself */
	if (!row || !sim_row_is_bit(row))
		return false;
	panel->held = g_object_ref(row);
	sim_row_press(row, panel->sim);
	return true;
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderSimPanel *panel)
{
	const GdkModifierType held = state & gtk_accelerator_get_default_mod_mask();

	(void)keys;
	(void)code;
	if (is_typing(panel))
		return GDK_EVENT_PROPAGATE;
	if (key == GDK_KEY_space && !held && press(panel))
		return GDK_EVENT_STOP;
	return GDK_EVENT_PROPAGATE;
}

static void key_released(GtkEventControllerKey *keys, guint key, guint code,
			 GdkModifierType state, LadderSimPanel *panel)
{
	(void)keys;
	(void)code;
	(void)state;
	if (key == GDK_KEY_space)
		sim_panel_let_go(panel);
}

static void left(GtkEventControllerFocus *focus, LadderSimPanel *panel)
{
	(void)focus;
	if (panel->held)
		sim_row_unpress(panel->held, panel->sim);
	g_clear_object(&panel->held);
}

/* Return, or a double click. */
static void activated(GtkListView *list, guint at, LadderSimPanel *panel)
{
	LadderSimRow *row = g_list_model_get_item(G_LIST_MODEL(panel->selection), at);
	LadderSimRowView *view = sim_panel_view_of(panel, row);

	(void)list;
	if (row && row->kind == SIM_HEADING)
		ladder_sim_row_view_fold(GTK_WIDGET(panel), row);
	else if (view)
		ladder_sim_row_view_edit(view, row->given.type != IEC_NONE ?
					 SIM_EDIT_PRESET : SIM_EDIT_VALUE);
	g_clear_object(&row);
}

/* ---- actions ---- */

static void force_to(LadderSimPanel *panel, gint64 to)
{
	LadderSimRow *row = sim_panel_selected(panel);

	if (row && sim_row_is_bit(row))
		sim_row_force(row, panel->sim, (union iec_value){ .i = to });
}

static void force(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	LadderSimRow *row = sim_panel_selected(panel);

	(void)name;
	(void)unused;
	if (!row)
		return;
	if (sim_row_is_forced(row, panel->sim))
		sim_row_release(row, panel->sim);
	else
		sim_row_force(row, panel->sim, sim_row_value(row, panel->sim, row->at));
}

static void force_on(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	force_to(LADDER_SIM_PANEL(widget), 1);
}

static void force_off(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	force_to(LADDER_SIM_PANEL(widget), 0);
}

static void release_all(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	ladder_sim_release_all(LADDER_SIM_PANEL(widget)->sim);
}

static void edit(LadderSimPanel *panel, enum sim_edit what)
{
	LadderSimRowView *view = sim_panel_view_of(panel, sim_panel_selected(panel));

	if (view)
		ladder_sim_row_view_edit(view, what);
}

static void edit_value(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	edit(LADDER_SIM_PANEL(widget), SIM_EDIT_VALUE);
}

static void edit_preset(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	edit(LADDER_SIM_PANEL(widget), SIM_EDIT_PRESET);
}

/* ---- the menu ---- */

static void add(GMenu *menu, const char *text, const char *action)
{
	g_menu_append(menu, text, action);
}

/* An action of the window, with the name of the variable. */
static void add_named(GMenu *menu, const char *text, const char *action, const char *name)
{
	GMenuItem *item = g_menu_item_new(text, NULL);

	g_menu_item_set_action_and_target(item, action, "s", name);
	g_menu_append_item(menu, item);
	g_object_unref(item);
}

/* Of a timer or counter what it tells is Q. */
static void add_window(GMenu *menu, const LadderSimRow *row)
{
	char *name = row->kind == SIM_PRESET ? g_strconcat(row->name, ".Q", NULL) :
		     g_strdup(row->name);

	add_named(menu, _("Expect this value"), "win.expect-value", name);
	add_named(menu, _("Add to the status chart"), "win.watch-value", row->name);
	g_free(name);
}

static GMenuModel *menu_of(LadderSimPanel *panel, const LadderSimRow *row)
{
	GMenu *menu = g_menu_new(), *values = g_menu_new(), *forces = g_menu_new();
	GMenuModel *choices = sim_panel_choices(panel, row);
	GMenu *others = g_menu_new();

	if (row->kind == SIM_PRESET) {
		if (row->given.type != IEC_NONE)
			add(values, _("Change Preset…"), "sim-panel.edit-preset");
		add(values, row->group == SIM_COUNTERS ? _("Change Count…") :
		    _("Change Elapsed Time…"), "sim-panel.edit-value");
	} else if (!sim_row_is_bit(row) && !row->at.constant) {
		add(values, _("Change Value…"), "sim-panel.edit-value");
	}
	if (sim_row_is_forced(row, panel->sim))
		add(forces, _("Release Force"), "sim-panel.force");
	if (sim_row_is_bit(row)) {
		add(forces, _("Force On"), "sim-panel.force-on");
		add(forces, _("Force Off"), "sim-panel.force-off");
	} else if (row->at.type != IEC_STRING && !sim_row_is_forced(row, panel->sim)) {
		add(forces, _("Force at This Value"), "sim-panel.force");
	}
	if (ladder_sim_forces(panel->sim))
		add(forces, _("Release All Forces"), "sim-panel.release-all");
	if (!row->plant)
		add_window(others, row);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(values));
	g_menu_append_section(menu, NULL, G_MENU_MODEL(forces));
	g_menu_append_section(menu, NULL, choices);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(others));
	g_object_unref(others);
	g_object_unref(values);
	g_object_unref(forces);
	g_object_unref(choices);
	return G_MENU_MODEL(menu);
}

static void show_menu(LadderSimPanel *panel, const GdkRectangle *at)
{
	LadderSimRow *row = sim_panel_selected(panel);
	GMenuModel *model;

	if (!row)
		return;
	model = menu_of(panel, row);
	if (!panel->menu) {
		panel->menu = gtk_popover_menu_new_from_model(model);
		gtk_widget_set_parent(panel->menu, GTK_WIDGET(panel));
		gtk_popover_set_has_arrow(GTK_POPOVER(panel->menu), FALSE);
		gtk_widget_set_halign(panel->menu, GTK_ALIGN_START);
	}
	gtk_popover_menu_set_menu_model(GTK_POPOVER_MENU(panel->menu), model);
	gtk_popover_set_pointing_to(GTK_POPOVER(panel->menu), at);
	gtk_popover_popup(GTK_POPOVER(panel->menu));
	g_object_unref(model);
}

static void menu_at_line(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSimPanel *panel = LADDER_SIM_PANEL(widget);
	LadderSimRowView *view = sim_panel_view_of(panel, sim_panel_selected(panel));
	graphene_rect_t box;

	(void)name;
	(void)unused;
	if (view && gtk_widget_compute_bounds(GTK_WIDGET(view), widget, &box))
		show_menu(panel, &(GdkRectangle){ (int)box.origin.x + 20,
			(int)box.origin.y, 1, (int)box.size.height });
}

static void right_clicked(GtkGestureClick *gesture, int times, double x, double y,
			  LadderSimPanel *panel)
{
	GtkWidget *at = gtk_widget_pick(GTK_WIDGET(panel), x, y, GTK_PICK_DEFAULT);
	LadderSimRow *row = NULL;

	(void)times;
	at = at && !LADDER_IS_SIM_ROW_VIEW(at) ?
		gtk_widget_get_ancestor(at, LADDER_TYPE_SIM_ROW_VIEW) : at;
	if (at)
		row = ladder_sim_row_view_row(LADDER_SIM_ROW_VIEW(at));
	if (!row)
		return;
	gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_CLAIMED);
	ladder_sim_panel_select(panel, row->name);
	show_menu(panel, &(GdkRectangle){ (int)x, (int)y, 1, 1 });
}

/* ---- all ---- */

void sim_panel_install_keys(GtkWidgetClass *class)
{
	gtk_widget_class_install_action(class, "sim-panel.force", NULL, force);
	gtk_widget_class_install_action(class, "sim-panel.force-on", NULL, force_on);
	gtk_widget_class_install_action(class, "sim-panel.force-off", NULL, force_off);
	gtk_widget_class_install_action(class, "sim-panel.release-all", NULL, release_all);
	gtk_widget_class_install_action(class, "sim-panel.edit-value", NULL, edit_value);
	gtk_widget_class_install_action(class, "sim-panel.edit-preset", NULL, edit_preset);
	gtk_widget_class_install_action(class, "sim-panel.menu", NULL, menu_at_line);
	gtk_widget_class_add_binding_action(class, GDK_KEY_F, GDK_CONTROL_MASK |
					    GDK_SHIFT_MASK, "sim-panel.force", NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_Menu, 0, "sim-panel.menu", NULL);
	gtk_widget_class_add_binding_action(class, GDK_KEY_F10, GDK_SHIFT_MASK,
					    "sim-panel.menu", NULL);
}

void sim_panel_begin_keys(LadderSimPanel *panel)
{
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkEventController *focus = gtk_event_controller_focus_new();
	GtkGesture *click = gtk_gesture_click_new();

	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), panel);
	g_signal_connect(keys, "key-released", G_CALLBACK(key_released), panel);
	g_signal_connect(focus, "leave", G_CALLBACK(left), panel);
	g_signal_connect(panel->list, "activate", G_CALLBACK(activated), panel);
	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	g_signal_connect(click, "pressed", G_CALLBACK(right_clicked), panel);
	gtk_widget_add_controller(panel->list, keys);
	gtk_widget_add_controller(panel->list, focus);
	gtk_widget_add_controller(GTK_WIDGET(panel), GTK_EVENT_CONTROLLER(click));
}

void sim_panel_end_keys(LadderSimPanel *panel)
{
	g_clear_pointer(&panel->menu, gtk_widget_unparent);
}
