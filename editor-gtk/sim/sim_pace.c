/* SPDX-License-Identifier: MIT
 *
 * sim_pace - the popover of the clock button: see sim_pace.h.
 */
#include "editor-gtk/sim/sim_pace.h"

#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

struct _LadderSimPace {
	GtkPopover parent;
	LadderSim *sim;
	GtkSpinButton *period, *board;
	GtkSwitch *slow, *fault;
	GtkScale *speed;
	GtkLabel *plant;
	bool showing; /* widgets are being set: ignore their signals               */
};

G_DEFINE_FINAL_TYPE(LadderSimPace, ladder_sim_pace, GTK_TYPE_POPOVER)

static void show_plant(LadderSimPace *pace)
{
	const char *path = ladder_sim_plant(pace->sim);
	char *name = path ? g_path_get_basename(path) : g_strdup(_("none"));

	gtk_label_set_text(pace->plant, name);
	tip_set(GTK_WIDGET(pace->plant), path);
	g_free(name);
}

static void show(LadderSimPace *pace)
{
	const double speed = ladder_sim_speed(pace->sim);
	const bool fault = ladder_sim_fault_on_error(pace->sim);

	pace->showing = true;
	gtk_spin_button_set_value(pace->period, (double)ladder_sim_period(pace->sim) / 1e6);
	gtk_spin_button_set_value(pace->board, (double)ladder_sim_board_speed(pace->sim));
	/* Setting a switch to its own state would end its animation. */
	if (gtk_switch_get_active(pace->slow) != (speed > 0))
		gtk_switch_set_active(pace->slow, speed > 0);
	if (gtk_switch_get_active(pace->fault) != fault)
		gtk_switch_set_active(pace->fault, fault);
	gtk_widget_set_sensitive(GTK_WIDGET(pace->speed), speed > 0);
	if (speed > 0)
		gtk_range_set_value(GTK_RANGE(pace->speed), speed);
	pace->showing = false;
	show_plant(pace);
}

static void period_changed(LadderSimPace *pace)
{
	if (!pace->showing)
		ladder_sim_set_period(pace->sim,
			(gint64)(gtk_spin_button_get_value(pace->period) * 1e6 + 0.5));
}

static void board_changed(LadderSimPace *pace)
{
	if (!pace->showing)
		ladder_sim_set_board_speed(pace->sim,
			(guint64)gtk_spin_button_get_value(pace->board));
}

static void speed_changed(LadderSimPace *pace)
{
	if (!pace->showing)
		ladder_sim_set_speed(pace->sim, gtk_switch_get_active(pace->slow) ?
			gtk_range_get_value(GTK_RANGE(pace->speed)) : 0);
}

static void fault_changed(LadderSimPace *pace)
{
	if (!pace->showing)
		ladder_sim_set_fault_on_error(pace->sim, gtk_switch_get_active(pace->fault));
}

/* In a popover, Space and Return do not reach a switch without this. */
static void add_keys(GtkSwitch *widget)
{
	GtkEventController *keys = gtk_shortcut_controller_new();
	GtkShortcutTrigger *trigger = gtk_alternative_trigger_new(
		gtk_keyval_trigger_new(GDK_KEY_space, 0),
		gtk_keyval_trigger_new(GDK_KEY_Return, 0));

	gtk_shortcut_controller_add_shortcut(GTK_SHORTCUT_CONTROLLER(keys),
		gtk_shortcut_new(trigger, g_object_ref(gtk_activate_action_get())));
	gtk_widget_add_controller(GTK_WIDGET(widget), keys);
}

static void ladder_sim_pace_dispose(GObject *object)
{
	g_clear_object(&LADDER_SIM_PACE(object)->sim);
	G_OBJECT_CLASS(ladder_sim_pace_parent_class)->dispose(object);
}

static void ladder_sim_pace_class_init(LadderSimPaceClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_sim_pace_dispose;
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/sim_pace.ui");
	gtk_widget_class_bind_template_child(widget, LadderSimPace, period);
	gtk_widget_class_bind_template_child(widget, LadderSimPace, board);
	gtk_widget_class_bind_template_child(widget, LadderSimPace, slow);
	gtk_widget_class_bind_template_child(widget, LadderSimPace, fault);
	gtk_widget_class_bind_template_child(widget, LadderSimPace, speed);
	gtk_widget_class_bind_template_child(widget, LadderSimPace, plant);
	gtk_widget_class_bind_template_callback(widget, period_changed);
	gtk_widget_class_bind_template_callback(widget, board_changed);
	gtk_widget_class_bind_template_callback(widget, speed_changed);
	gtk_widget_class_bind_template_callback(widget, fault_changed);
}

static void ladder_sim_pace_init(LadderSimPace *pace)
{
	pace->showing = true;
	gtk_widget_init_template(GTK_WIDGET(pace));
	add_keys(pace->slow);
	add_keys(pace->fault);
}

GtkWidget *ladder_sim_pace_new(LadderSim *sim)
{
	LadderSimPace *pace = g_object_new(LADDER_TYPE_SIM_PACE, NULL);

	pace->sim = g_object_ref(sim);
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(show), pace,
				G_CONNECT_SWAPPED);
	show(pace);
	return GTK_WIDGET(pace);
}
