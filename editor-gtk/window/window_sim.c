/* SPDX-License-Identifier: MIT
 *
 * window_sim - the simulation in the window: its switch, its buttons, what the status bar
 * says of it. What it shows in sheets and panels is theirs.
 */
#include "editor-gtk/window/window_inside.h"

#include "editor-gtk/panels/problems.h"
#include "editor-gtk/sim/sim_pace.h"
#include "editor-gtk/live/sim_panel.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

#define WHEN_US 200000 /* the title tells the time so often                      */

/* ---- what it says ---- */

static void set_pill(LadderWindow *window, const char *text, const char *class)
{
	static const char *const classes[] = { "run", "still", "past", "fault" };

	/* A label that is told the same again is drawn again. */
	if (g_strcmp0(gtk_label_get_text(window->pill), text) == 0 &&
	    (!class || gtk_widget_has_css_class(GTK_WIDGET(window->pill), class)))
		return;
	for (gsize i = 0; i < G_N_ELEMENTS(classes); i++)
		gtk_widget_remove_css_class(GTK_WIDGET(window->pill), classes[i]);
	if (class)
		gtk_widget_add_css_class(GTK_WIDGET(window->pill), class);
	gtk_label_set_text(window->pill, text);
}

void window_show_pill(LadderWindow *window)
{
	static const struct { const char *text, *class; } pills[] = {
		[SIM_OFF] = { N_("EDIT"), NULL },
		[SIM_STOP] = { N_("SIMULATION · STOP"), "still" },
		[SIM_RUN] = { N_("SIMULATION"), "run" },
		[SIM_PAUSE] = { N_("SIMULATION · PAUSE"), "still" },
		[SIM_FAULT] = { N_("SIMULATION · FAULT"), "fault" },
	};
	const enum sim_state state = ladder_sim_state(window->sim);
	const char *class, *board = window_board_pill(window, &class);
	char *text;

	if (board) {
		set_pill(window, board, class);
		return;
	}
	if (!ladder_sim_is_past(window->sim)) {
		set_pill(window, _(pills[state].text), pills[state].class);
		return;
	}
	text = g_strdup_printf(_("PAST · scan %llu"),
			       (unsigned long long)ladder_sim_twin(window->sim)->scan);
	set_pill(window, text, "past");
	g_free(text);
}

static void show_when(LadderWindow *window)
{
	const struct twin *twin = ladder_sim_twin(window->sim);
	char *text;

	if (!twin)
		return;
	text = g_strdup_printf(_("Simulating · %g ms · scan %llu · %.2f s"),
			       (double)twin->period_ns / 1e6,
			       (unsigned long long)twin->scan, (double)twin->now_ns / 1e9);
	adw_window_title_set_subtitle(window->title, text);
	g_free(text);
}

static void show_forces(LadderWindow *window)
{
	const int forces = ladder_sim_forces(window->sim);
	char *text = g_strdup_printf(ngettext("%d force", "%d forces",
					      (unsigned long)forces), forces);

	if (g_strcmp0(gtk_button_get_label(window->forces_button), text) != 0) {
		gtk_widget_set_visible(GTK_WIDGET(window->forces_button), forces > 0);
		gtk_button_set_label(window->forces_button, text);
	}
	g_free(text);
}

static void show_buttons(LadderWindow *window)
{
	const bool on = ladder_sim_is_on(window->sim);
	const bool run = ladder_sim_state(window->sim) == SIM_RUN;
	const char *name = run ? _("Pause") : _("Run");

	gtk_widget_set_visible(GTK_WIDGET(window->sim_buttons), on);
	gtk_button_set_icon_name(window->run_button, run ? "media-playback-pause-symbolic" :
				 "media-playback-start-symbolic");
	tip_set(GTK_WIDGET(window->run_button), name);
	gtk_accessible_update_property(GTK_ACCESSIBLE(window->run_button),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	gtk_toggle_button_set_active(on ? window->simulate_mode : window->edit_mode, TRUE);
	gtk_widget_action_set_enabled(GTK_WIDGET(window), "win.sim_stop",
		on && ladder_sim_state(window->sim) != SIM_STOP);
}

static void go_on(LadderWindow *window)
{
	ladder_sim_run(window->sim);
}

static void state_changed(LadderWindow *window)
{
	/* What it stood still for is past. */
	if (ladder_sim_state(window->sim) == SIM_RUN && window->banner_do == go_on) {
		window_banner_close(window);
		window->banner_do = NULL;
		ladder_window_tell(window, "");
	}
	show_buttons(window);
	window_show_pill(window);
	if (ladder_sim_is_on(window->sim))
		show_when(window);
	else
		window_show_state(window);
}

static gboolean when_elapsed(gpointer data)
{
	LadderWindow *window = data;

	window->when_timer = 0;
	show_when(window);
	return G_SOURCE_REMOVE;
}

static void shown(LadderWindow *window)
{
	window_show_pill(window);
	show_forces(window);
	if (!window->when_timer && ladder_sim_is_on(window->sim))
		window->when_timer = g_timeout_add(WHEN_US / 1000, when_elapsed, window);
}

/* What the simulation stands still for. */
static const struct fault_place *stopped_at(const struct resource *resource)
{
	switch (resource->state) {
	case STATE_FAULT: return &resource->fault_at;
	case STATE_STOP: return &resource->halt_at;
	case STATE_RUN: break;
	}
	return &resource->error_at;
}

/* A fault opens the place where it was. */
static void go_to_fault(LadderWindow *window)
{
	const struct fault_place *at =
		stopped_at(&ladder_sim_twin(window->sim)->resource);
	const struct project *project = ladder_document_project(window->document);
	const int pou = project && at->rung && at->pou ?
		project_find_pou(project, at->pou, strlen(at->pou)) : -1;

	if (pou >= 0)
		tabs_go(window, pou, (int)at->rung - 1, (int)at->row - 1, (int)at->col - 1);
}

static void told(LadderSim *sim, const char *text, gboolean bad, LadderWindow *window)
{
	(void)sim;
	ladder_window_tell(window, text);
	if (!bad) {
		window_log(window, _("simulation"), text);
		return;
	}
	window_banner_of(window, _("simulation"), text, _("Run"), go_on);
	go_to_fault(window);
}

/* ---- what it does ---- */

/* The program has errors, and the list of them is another one now. */
static void show_problems(LadderWindow *window)
{
	ladder_problems_show_error(LADDER_PROBLEMS(below_show(window, "problems")));
}

/* What is wrong with the plant stands in no list: it is told where it stays. */
static bool refuse(LadderWindow *window, GError *error, bool plant)
{
	char *text = plant ? g_strdup_printf(_("The plant has errors: %s"), error->message) :
			     g_strdup(error->message);

	if (plant)
		ladder_window_warn(window, text);
	else
		show_problems(window);
	ladder_window_tell(window, text);
	g_free(text);
	g_error_free(error);
	show_buttons(window);
	return false;
}

static bool begin(LadderWindow *window)
{
	GError *error = NULL;

	if (ladder_sim_is_on(window->sim))
		return true;
	if (!window_plant_ready(window, &error))
		return refuse(window, error, true);
	if (!ladder_sim_begin(window->sim, &error))
		return refuse(window, error, false);
	window_banner_close(window);
	ladder_window_tell(window, ""); /* what kept it from beginning is over */
	gtk_widget_set_visible(GTK_WIDGET(window->right), TRUE);
	return true;
}

static void end(LadderWindow *window)
{
	ladder_sim_end(window->sim);
	gtk_widget_set_visible(GTK_WIDGET(window->right), FALSE);
	window_banner_close(window);
}

static void mode_toggled(LadderWindow *window)
{
	if (gtk_toggle_button_get_active(window->simulate_mode) ==
	    ladder_sim_is_on(window->sim))
		return;
	if (ladder_sim_is_on(window->sim))
		end(window);
	else
		begin(window);
}

static void run_or_pause(LadderWindow *window)
{
	if (ladder_sim_state(window->sim) == SIM_RUN && !ladder_sim_is_past(window->sim))
		ladder_sim_pause(window->sim);
	else if (begin(window))
		ladder_sim_run(window->sim);
}

static void step_shown(LadderWindow *window, int by)
{
	const struct twin *twin = ladder_sim_twin(window->sim);

	if (!twin)
		return;
	if (by > 0 && twin->scan >= ladder_sim_last(window->sim))
		ladder_sim_show_now(window->sim);
	else if (!ladder_sim_show(window->sim, by > 0 ? twin->scan + 1 : twin->scan - 1))
		ladder_window_tell(window, _("no scan before this one was kept"));
}

bool window_sim(LadderWindow *window, enum verb verb)
{
	LadderSim *sim = window->sim;

	switch ((int)verb) {
	case VERB_sim_mode:
		if (ladder_sim_is_on(sim))
			end(window);
		else
			begin(window);
		return true;
	case VERB_sim_run: run_or_pause(window); return true;
	case VERB_sim_scan:
		if (begin(window))
			ladder_sim_scan(sim, 1);
		return true;
	case VERB_sim_stop: ladder_sim_stop(sim); return true;
	case VERB_sim_cold: ladder_sim_reset(sim, false); return true;
	case VERB_sim_warm: ladder_sim_reset(sim, true); return true;
	case VERB_sim_back: step_shown(window, -1); return true;
	case VERB_sim_forth: step_shown(window, 1); return true;
	case VERB_sim_plant: window_plant_choose(window); return true;
	case VERB_sim_no_plant: window_plant_none(window); return true;
	case VERB_sim_why: window_why_ask(window); return true;
	case VERB_sim_now: ladder_sim_show_now(sim); return true;
	case VERB_sim_release: ladder_sim_release_all(sim); return true;
	case VERB_right:
		if (ladder_sim_is_on(sim))
			gtk_widget_set_visible(GTK_WIDGET(window->right),
				!gtk_widget_get_visible(GTK_WIDGET(window->right)));
		return true;
	default: return false;
	}
}

void window_sim_init(LadderWindow *window)
{
	LadderSim *sim = window->sim;
	GtkWidget *panel = ladder_sim_panel_new(sim);

	gtk_widget_set_vexpand(panel, TRUE);
	gtk_box_append(window->right, panel);
	window_why_init(window);
	window_older_init(window);
	tip_set(GTK_WIDGET(window->forces_button),
				    _("Release all forces"));
	gtk_menu_button_set_popover(window->pace_button, sim_pace_new(sim));
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(state_changed), window,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), window, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "told", G_CALLBACK(told), window, 0);
	g_signal_connect_object(window->simulate_mode, "toggled", G_CALLBACK(mode_toggled),
				window, G_CONNECT_SWAPPED);
	show_buttons(window);
}
