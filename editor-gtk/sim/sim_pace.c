/* SPDX-License-Identifier: MIT
 *
 * sim_pace - period, slow motion, what it pauses at, cold and warm start.
 */
#include "editor-gtk/sim/sim_pace.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"

#define SLOWEST 1
#define FASTEST 50 /* scans a second of slow motion                             */

struct pace {
	LadderSim *sim;
	GtkSpinButton *period;
	GtkSwitch *slow, *heed;
	GtkScale *speed;
	GtkLabel *plant;
	bool showing; /* what the simulation has, not what a person wants          */
};

static void pace_free(gpointer pointer)
{
	struct pace *pace = pointer;

	g_signal_handlers_disconnect_by_data(pace->sim, pace);
	g_object_unref(pace->sim);
	g_free(pace);
}

static void show_plant(struct pace *pace)
{
	const char *path = ladder_sim_plant(pace->sim);
	char *name = path ? g_path_get_basename(path) : g_strdup(_("none"));

	gtk_label_set_text(pace->plant, name);
	tip_set(GTK_WIDGET(pace->plant), path);
	g_free(name);
}

static void show(struct pace *pace)
{
	const double speed = ladder_sim_speed(pace->sim);

	pace->showing = true;
	gtk_spin_button_set_value(pace->period, (double)ladder_sim_period(pace->sim) / 1e6);
	/* Even its own state, set again, ends the movement of one that is on its way. */
	if (gtk_switch_get_active(pace->slow) != (speed > 0))
		gtk_switch_set_active(pace->slow, speed > 0);
	if (gtk_switch_get_active(pace->heed) != ladder_sim_heeds(pace->sim))
		gtk_switch_set_active(pace->heed, ladder_sim_heeds(pace->sim));
	gtk_widget_set_sensitive(GTK_WIDGET(pace->speed), speed > 0);
	if (speed > 0)
		gtk_range_set_value(GTK_RANGE(pace->speed), speed);
	pace->showing = false;
	show_plant(pace);
}

static void period_changed(GtkSpinButton *spin, struct pace *pace)
{
	if (!pace->showing)
		ladder_sim_set_period(pace->sim,
			(gint64)(gtk_spin_button_get_value(spin) * 1e6 + 0.5));
}

static void speed_changed(struct pace *pace)
{
	if (!pace->showing)
		ladder_sim_set_speed(pace->sim, gtk_switch_get_active(pace->slow) ?
			gtk_range_get_value(GTK_RANGE(pace->speed)) : 0);
}

static void heed_changed(struct pace *pace)
{
	if (!pace->showing)
		ladder_sim_set_heeds(pace->sim, gtk_switch_get_active(pace->heed));
}

static void name_it(GtkWidget *widget, GtkWidget *label)
{
	gtk_accessible_update_relation(GTK_ACCESSIBLE(widget),
				       GTK_ACCESSIBLE_RELATION_LABELLED_BY, label, NULL, -1);
}

static GtkWidget *row(GtkGrid *grid, int at, const char *text, GtkWidget *widget)
{
	GtkWidget *label = gtk_label_new(text);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_grid_attach(grid, label, 0, at, 1, 1);
	gtk_grid_attach(grid, widget, 1, at, 1, 1);
	name_it(widget, label);
	return widget;
}

/* In a popover the keys that press a button do not come to a switch by themselves. */
static GtkSwitch *switch_new(void)
{
	GtkWidget *widget = gtk_switch_new();
	GtkEventController *keys = gtk_shortcut_controller_new();
	GtkShortcutTrigger *trigger = gtk_alternative_trigger_new(
		gtk_keyval_trigger_new(GDK_KEY_space, 0),
		gtk_keyval_trigger_new(GDK_KEY_Return, 0));

	gtk_shortcut_controller_add_shortcut(GTK_SHORTCUT_CONTROLLER(keys),
		gtk_shortcut_new(trigger, g_object_ref(gtk_activate_action_get())));
	gtk_widget_add_controller(widget, keys);
	gtk_widget_set_halign(widget, GTK_ALIGN_START);
	return GTK_SWITCH(widget);
}

static GtkWidget *start_button(const char *label, const char *action)
{
	GtkWidget *button = gtk_button_new_with_label(label);

	gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
	return button;
}

GtkWidget *sim_pace_new(LadderSim *sim)
{
	GtkWidget *popover = gtk_popover_new(), *widget = gtk_grid_new();
	GtkWidget *starts = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkWidget *plants = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkGrid *grid = GTK_GRID(widget);
	struct pace *pace = g_new0(struct pace, 1);

	pace->sim = g_object_ref(sim);
	pace->period = GTK_SPIN_BUTTON(gtk_spin_button_new_with_range(0.1, 60000, 1));
	gtk_spin_button_set_digits(pace->period, 1);
	pace->slow = switch_new();
	pace->heed = switch_new();
	pace->speed = GTK_SCALE(gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL,
							 SLOWEST, FASTEST, 1));
	gtk_scale_set_draw_value(pace->speed, TRUE);
	gtk_scale_set_value_pos(pace->speed, GTK_POS_RIGHT);
	gtk_range_set_value(GTK_RANGE(pace->speed), 5);
	gtk_widget_set_size_request(GTK_WIDGET(pace->speed), 180, -1);
	gtk_grid_set_row_spacing(grid, 8);
	gtk_grid_set_column_spacing(grid, 12);
	row(grid, 0, _("Period, ms"), GTK_WIDGET(pace->period));
	row(grid, 1, _("Slow motion"), GTK_WIDGET(pace->slow));
	row(grid, 2, _("Scans a second"), GTK_WIDGET(pace->speed));
	row(grid, 3, _("FAULT at a failed operation"), GTK_WIDGET(pace->heed));
	pace->plant = GTK_LABEL(gtk_label_new(NULL));
	gtk_label_set_xalign(pace->plant, 0);
	gtk_label_set_ellipsize(pace->plant, PANGO_ELLIPSIZE_MIDDLE);
	row(grid, 4, _("Plant"), GTK_WIDGET(pace->plant));
	gtk_box_append(GTK_BOX(plants), start_button(_("Choose…"), "win.sim_plant"));
	gtk_box_append(GTK_BOX(plants), start_button(_("Without"), "win.sim_no_plant"));
	gtk_box_set_homogeneous(GTK_BOX(plants), TRUE);
	gtk_grid_attach(grid, plants, 0, 5, 2, 1);
	gtk_box_append(GTK_BOX(starts), start_button(_("Cold start"), "win.sim_cold"));
	gtk_box_append(GTK_BOX(starts), start_button(_("Warm start"), "win.sim_warm"));
	gtk_box_set_homogeneous(GTK_BOX(starts), TRUE);
	gtk_grid_attach(grid, starts, 0, 6, 2, 1);
	gtk_popover_set_child(GTK_POPOVER(popover), widget);
	show(pace);
	g_signal_connect(pace->period, "value-changed", G_CALLBACK(period_changed), pace);
	g_signal_connect_swapped(pace->slow, "notify::active", G_CALLBACK(speed_changed),
				 pace);
	g_signal_connect_swapped(pace->heed, "notify::active", G_CALLBACK(heed_changed),
				 pace);
	g_signal_connect_swapped(pace->speed, "value-changed", G_CALLBACK(speed_changed),
				 pace);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(show), pace);
	g_object_set_data_full(G_OBJECT(popover), "pace", pace, pace_free);
	return popover;
}
