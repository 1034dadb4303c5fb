/* SPDX-License-Identifier: MIT
 *
 * sim_bar - the simulation in the window; see sim_bar.h.
 */
#include "editor-gtk/window/sim_bar.h"

#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/live/sim_panel.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/sim_pace.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/below.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <math.h>
#include <string.h>

#define NARROW 1200 /* px of a window that has no room for both sides             */
#define PANEL 280   /* px of the panel; both for letters of the usual size        */
#define TITLE_PADDING 24 /* px beside the texts of the title                     */
#define WHEN_US 200000 /* us between updates of the title                        */

/* ---- its text ---- */

static GtkWidget *label_of(GtkWidget *widget, const char *class)
{
	GtkWidget *found = GTK_IS_LABEL(widget) && gtk_widget_has_css_class(widget, class) ? widget : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = label_of(child, class);
	return found;
}

/* Px between the buttons of the header bar; -1: unknown as yet. */
static int room_of(AdwWindowTitle *title)
{
	GtkWidget *bar = gtk_widget_get_ancestor(GTK_WIDGET(title), GTK_TYPE_CENTER_BOX);
	GtkWidget *start = bar ? gtk_center_box_get_start_widget(GTK_CENTER_BOX(bar)) : NULL;
	GtkWidget *end = bar ? gtk_center_box_get_end_widget(GTK_CENTER_BOX(bar)) : NULL;

	if (!bar || gtk_widget_get_width(bar) == 0)
		return -1;
	return gtk_widget_get_width(bar) - (start ? gtk_widget_get_width(start) : 0) -
	       (end ? gtk_widget_get_width(end) : 0) - TITLE_PADDING;
}

/* Leaves out the second of the parts that dots separate, and again, until the title has room. */
static void shorten(AdwWindowTitle *title, char *text)
{
	static const char dot[] = " · ";
	GtkWidget *label = label_of(GTK_WIDGET(title), "subtitle");
	const int room = room_of(title);
	char *second, *third;
	int width = 0;

	if (!label || room < 0)
		return;
	for (;;) {
		PangoLayout *layout = gtk_widget_create_pango_layout(label, text);

		pango_layout_get_pixel_size(layout, &width, NULL);
		g_object_unref(layout);
		second = width > room ? strstr(text, dot) : NULL;
		if (!second)
			return;
		third = strstr(second + strlen(dot), dot);
		memmove(second, third ? third : "", third ? strlen(third) + 1 : 1);
	}
}

/* With tenths, also of whole seconds: a title that is longer by two signs each second would jump. */
static void print_now(gint64 ns, char *out, size_t size)
{
	if (ns >= G_GINT64_CONSTANT(1000000000) && ns < G_GINT64_CONSTANT(60000000000))
		live_time_print_tick(ns, 100000000, out, size);
	else
		live_time_print_short(ns, out, size);
}

static void show_when(struct sim_bar *bar)
{
	const struct twin *twin = ladder_sim_twin(bar->core->sim);
	const char *board = ladder_sim_board(bar->core->sim);
	char *text, period[32], now[32];

	if (!twin)
		return;
	live_time_print(twin->period_ns, period, sizeof(period));
	print_now(twin->now_ns, now, sizeof(now));
	if (board)
		text = g_strdup_printf(ladder_sim_is_recording(bar->core->sim) ?
				       _("Recording: %s · %s · scan %llu") :
				       _("Online: %s · %s · scan %llu"), board, period,
				       (unsigned long long)twin->scan);
	else
		text = g_strdup_printf(_("Simulating · %s · scan %llu · %s"), period,
				       (unsigned long long)twin->scan, now);
	shorten(bar->title, text);
	adw_window_title_set_subtitle(bar->title, text);
	g_free(text);
}

/* "0.4 %", "12 %", "less than 0.1 %": the part of the period. Caller frees. */
static char *share_text(gint64 part_ns, gint64 period_ns)
{
	const double percent = 100 * (double)part_ns / (double)MAX(period_ns, 1);

	if (percent < 0.1)
		return g_strdup(_("less than 0.1 %"));
	return g_strdup_printf(percent < 10 ? _("%.1f %%") : _("%.0f %%"), percent);
}

/* "4 µs", "2.2 ms": times that were counted in steps of 6 % have no more digits. */
static void print_counted(gint64 ns, char *out, size_t size)
{
	if (ns < 1000000)
		snprintf(out, size, "%d µs", (int)MAX(ns / 1000, 1));
	else
		live_time_print((ns + 50000) / 100000 * 100000, out, size);
}

/* Does a period of the program take as long for a person? */
static bool is_in_time(const struct sim_bar *bar)
{
	const double scans = ladder_sim_speed(bar->core->sim);
	const double period_ns = (double)ladder_sim_twin(bar->core->sim)->period_ns;

	return scans <= 0 || fabs(scans * period_ns / 1e9 - 1) < 0.01;
}

/* What a scan takes, for somebody who chooses a period. Appends nothing before the first scan. */
static void tell_cost(const struct sim_bar *bar, GString *text)
{
	const struct twin *twin = ladder_sim_twin(bar->core->sim);
	char usual[32], most[32], period[32], *share;
	struct sim_cost cost;

	if (!twin || !ladder_sim_cost(bar->core->sim, &cost))
		return;
	print_counted(cost.usual_ns, usual, sizeof(usual));
	print_counted(cost.most_ns, most, sizeof(most));
	live_time_print(twin->period_ns, period, sizeof(period));
	share = share_text(cost.usual_ns, twin->period_ns);
	g_string_append_printf(text, _("On this machine a scan takes %s: %s of the period of %s. "
				       "The longest took %s."), usual, share, period, most);
	g_free(share);
	g_string_append_c(text, '\n');
	if (cost.most_ns > twin->period_ns && !is_in_time(bar))
		return;
	g_string_append_printf(text, "%s\n", cost.most_ns > twin->period_ns ?
		_("A scan took longer than the period, so later ones were late.") :
		_("The rest of the period is free. A board may be slower: its state shows its own time."));
}

/* A machine that is too slow, or busy, shows here. */
static gboolean tell_lateness(GtkWidget *title, int x, int y, gboolean keys, GtkTooltip *tooltip,
			      struct sim_bar *bar)
{
	struct sim_lateness late;
	char most[32], worst[32];
	GString *text;
	gboolean told;

	(void)title, (void)x, (void)y, (void)keys;
	if (!ladder_sim_lateness(bar->core->sim, &late) || !sim_lateness_scans(&late))
		return FALSE;
	print_counted((gint64)(sim_lateness_us(&late, 0.99) * 1000), most, sizeof(most));
	print_counted((gint64)(sim_lateness_us(&late, 1) * 1000), worst, sizeof(worst));
	text = g_string_new(NULL);
	tell_cost(bar, text);
	g_string_append_printf(text, _("99 of 100 scans began at most %s late, all of them at most %s late"),
			       most, worst);
	told = tip_show(tooltip, text->str);
	g_string_free(text, TRUE);
	return told;
}

static void show_forces(struct sim_bar *bar)
{
	const int forces = ladder_sim_forces(bar->core->sim);
	char *text = g_strdup_printf(ngettext("%d force", "%d forces",
					      (unsigned long)forces), forces);

	core_with(bar->core, WITH_FORCES, forces > 0);
	if (g_strcmp0(gtk_button_get_label(bar->forces_button), text) != 0) {
		gtk_widget_set_visible(GTK_WIDGET(bar->forces_button), forces > 0);
		gtk_button_set_label(bar->forces_button, text);
	}
	g_free(text);
}

/* While a board is connected, the board says what can be stopped. */
static void tell_facts(struct sim_bar *bar, bool online)
{
	struct core *core = bar->core;

	core_with(core, WITH_SIM, ladder_sim_is_on(core->sim));
	core_with(core, WITH_TIME, !online && !ladder_sim_why_not(core->sim, SIM_WISH_TIME));
	if (!online)
		core_with(core, WITH_STOP, ladder_sim_is_on(core->sim) &&
			  ladder_sim_state(core->sim) != SIM_STOP);
}

static void show_buttons(struct sim_bar *bar)
{
	const bool online = ladder_board_link_state(bar->core->link) != LINK_OFF;
	const bool on = ladder_sim_is_on(bar->core->sim) && !online;
	const bool run = ladder_sim_state(bar->core->sim) == SIM_RUN;
	const char *name = run ? _("Pause") : _("Run");

	gtk_widget_set_visible(GTK_WIDGET(bar->buttons), on);
	gtk_button_set_icon_name(bar->run_button, run ? "media-playback-pause-symbolic" :
				 "media-playback-start-symbolic");
	tip_set(GTK_WIDGET(bar->run_button), name);
	spoken_name(bar->run_button, name);
	if (!online)
		gtk_toggle_button_set_active(on ? bar->simulate_mode : bar->edit_mode, TRUE);
	tell_facts(bar, online);
}

/* How many times as large as usual the person has letters. */
static double letters(void)
{
	int dpi = 0;

	g_object_get(gtk_settings_get_default(), "gtk-xft-dpi", &dpi, NULL);
	return dpi > 0 ? MAX(dpi / 1024.0 / 96, 1) : 1;
}

/* The panel grows with the letters, but leaves more than half of the window to the sheet. */
static void size_panel(struct sim_bar *bar)
{
	const int window = gtk_widget_get_width(GTK_WIDGET(bar->core->window));
	const int wanted = (int)(PANEL * letters());

	gtk_widget_set_size_request(GTK_WIDGET(bar->right), window > 0 ?
				    MAX(MIN(wanted, window * 2 / 5), PANEL) : wanted, -1);
}

/* In a narrow window the panel takes the room of the left side, not that of the rungs. An empty
 * list of problems gives its room to them, too. */
static void make_room(struct sim_bar *bar)
{
	const int width = gtk_widget_get_width(GTK_WIDGET(bar->core->window));

	size_panel(bar);
	if (width <= 0 || width >= NARROW * letters())
		return;
	below_rest(bar->core->below);
	bar->side_hidden = gtk_widget_get_visible(bar->side);
	if (bar->side_hidden)
		gtk_widget_set_visible(bar->side, FALSE);
}

/* The welcome page shows nothing of what runs. */
static void leave_welcome(struct sim_bar *bar)
{
	AdwTabPage *page = front_tab(bar->core->front);
	const struct project *project = ladder_document_project(bar->core->document);

	if (page && strcmp(page_name(page), " welcome") == 0 && project && project->pou_count > 0)
		tabs_show(bar->core->tabs, 0);
}

/* The panel comes with a board, as with a simulation, and goes with it. */
static void follow_board(struct sim_bar *bar)
{
	const bool board = ladder_sim_board(bar->core->sim) != NULL;

	if (board == bar->board)
		return;
	bar->board = board;
	if (board) {
		leave_welcome(bar);
		make_room(bar);
	}
	gtk_widget_set_visible(GTK_WIDGET(bar->right), board);
}

static void state_changed(struct sim_bar *bar)
{
	follow_board(bar);
	if (ladder_sim_state(bar->core->sim) == SIM_RUN &&
	    messages_close_offer(bar->core->messages, "win.sim_run"))
		messages_tell(bar->core->messages, ""); /* clears the message of the fault */
	show_buttons(bar);
	if (ladder_sim_is_on(bar->core->sim)) {
		show_when(bar);
	} else if (bar->side_hidden) { /* however it ended */
		gtk_widget_set_visible(bar->side, TRUE);
		bar->side_hidden = false;
	}
}

static gboolean when_elapsed(gpointer data)
{
	struct sim_bar *bar = data;

	bar->when_timer = 0;
	show_when(bar);
	return G_SOURCE_REMOVE;
}

static void shown(struct sim_bar *bar)
{
	show_forces(bar);
	if (!bar->when_timer && ladder_sim_is_on(bar->core->sim))
		bar->when_timer = g_timeout_add(WHEN_US / 1000, when_elapsed, bar);
}

/* Where the program stopped, or an operation failed. */
static const struct fault_place *stopped_at(const struct resource *resource)
{
	switch (resource->state) {
	case STATE_FAULT: return &resource->fault_at;
	case STATE_STOP: return &resource->halt_at;
	case STATE_RUN: break;
	}
	return &resource->error_at;
}

/* Opens the place of the fault. */
static void go_to_fault(struct sim_bar *bar)
{
	const struct fault_place *at =
		stopped_at(&ladder_sim_twin(bar->core->sim)->resource);
	const struct project *project = ladder_document_project(bar->core->document);
	const int pou = project && at->rung && at->pou ?
		project_find_pou(project, at->pou, strlen(at->pou)) : -1;

	if (pou >= 0)
		tabs_go(bar->core->tabs, pou, (int)at->rung - 1, (int)at->row - 1,
			(int)at->col - 1);
}

static void told(LadderSim *sim, const char *text, gboolean bad, struct sim_bar *bar)
{
	(void)sim;
	messages_tell(bar->core->messages, text);
	if (!bad) {
		messages_log(bar->core->messages, LOG_SYSTEM, text);
		return;
	}
	messages_banner(bar->core->messages, LOG_SYSTEM, text, _("Run"), "win.sim_run");
	go_to_fault(bar);
}

/* ---- its commands ---- */

static void offer_errors(struct sim_bar *bar, int errors)
{
	char *text = g_strdup_printf(ngettext("Cannot simulate: %d error",
		"Cannot simulate: %d errors", (unsigned long)errors), errors);

	messages_banner(bar->core->messages, LOG_SYSTEM, text, _("Show"),
			"win.show-error");
	g_free(text);
	bar->refused = errors;
}

/* Errors of the plant are not in the problems list, so the banner has the first. */
static bool refuse(struct sim_bar *bar, GError *error, bool plant)
{
	const int errors = ladder_document_diags(bar->core->document)->errors;
	char *text = plant ? g_strdup_printf(_("The plant has errors: %s"), error->message) :
			     g_strdup(error->message);

	if (errors && !plant)
		offer_errors(bar, errors);
	else
		messages_warn(bar->core->messages, text);
	messages_tell(bar->core->messages, text);
	g_free(text);
	g_error_free(error);
	show_buttons(bar);
	return false;
}

/* A banner with another number of errors is out of date. */
static void checked(struct sim_bar *bar)
{
	if (ladder_document_diags(bar->core->document)->errors != bar->refused)
		messages_close_offer(bar->core->messages, "win.show-error");
}

static bool begin(struct sim_bar *bar)
{
	GError *error = NULL;

	if (ladder_sim_is_on(bar->core->sim))
		return true;
	if (!origin_load_plant(bar->origin, &error))
		return refuse(bar, error, true);
	if (!ladder_sim_begin(bar->core->sim, &error))
		return refuse(bar, error, false);
	messages_close_banner(bar->core->messages);
	messages_tell(bar->core->messages, ""); /* clears an earlier refusal */
	leave_welcome(bar);
	make_room(bar);
	sim_bar_show_panel(bar);
	return true;
}

static void end(struct sim_bar *bar)
{
	ladder_sim_end(bar->core->sim);
	gtk_widget_set_visible(GTK_WIDGET(bar->right), FALSE);
	messages_close_banner(bar->core->messages);
}

static void begin_or_end(struct sim_bar *bar)
{
	const char *why = ladder_sim_why_not(bar->core->sim, SIM_WISH_RESTART);

	if (why) {
		messages_tell(bar->core->messages, why);
		return;
	}
	if (ladder_sim_is_on(bar->core->sim))
		end(bar);
	else if (begin(bar) && settings_flag("simulate-runs", TRUE))
		ladder_sim_run(bar->core->sim);
}

static void mode_toggled(struct sim_bar *bar)
{
	if (ladder_board_link_state(bar->core->link) != LINK_OFF)
		return; /* the mode Online ends first, then this comes again */
	if (gtk_toggle_button_get_active(bar->simulate_mode) !=
	    ladder_sim_is_on(bar->core->sim))
		begin_or_end(bar);
}

static void run_or_pause(struct sim_bar *bar)
{
	if (ladder_sim_state(bar->core->sim) == SIM_RUN && !ladder_sim_is_past(bar->core->sim))
		ladder_sim_pause(bar->core->sim);
	else if (begin(bar))
		ladder_sim_run(bar->core->sim);
}

static void step_shown(struct sim_bar *bar, int by)
{
	const struct twin *twin = ladder_sim_twin(bar->core->sim);

	if (!twin)
		return;
	if (by > 0 && twin->scan >= ladder_sim_last(bar->core->sim))
		ladder_sim_show_now(bar->core->sim);
	else if (!ladder_sim_show(bar->core->sim, by > 0 ? twin->scan + 1 : twin->scan - 1))
		messages_tell(bar->core->messages, _("No earlier scan was kept"));
}

static void plant_chosen(GtkNativeDialog *dialog, int response, struct sim_bar *bar)
{
	char *path = ask_take_path(dialog, response);

	if (path)
		origin_set_plant(bar->origin, path);
	g_free(path);
}

static void choose_plant(struct sim_bar *bar)
{
	struct core *core = bar->core;
	GtkFileChooserNative *chooser = ask_rung_file(core->window, core->document,
		_("Plant beside the program"), GTK_FILE_CHOOSER_ACTION_OPEN, _("Choose"));

	core_connect(core, chooser, "response", G_CALLBACK(plant_chosen), bar, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

static void recording_chosen(GtkNativeDialog *dialog, int response, struct sim_bar *bar)
{
	char *path = ask_take_path(dialog, response);
	GError *error = NULL;

	if (path && !ladder_sim_play_recording(bar->core->sim, path, &error)) {
		messages_warn(bar->core->messages, error->message);
		messages_tell(bar->core->messages, error->message);
		g_error_free(error);
	}
	g_free(path);
}

static void choose_recording(struct sim_bar *bar)
{
	struct core *core = bar->core;
	GtkFileChooserNative *chooser;

	if (ladder_board_link_state(core->link) != LINK_OFF) {
		messages_tell(core->messages, _("A board is connected. Disconnect it first"));
		return;
	}
	chooser = gtk_file_chooser_native_new(_("Recording of a board"), core->window,
		GTK_FILE_CHOOSER_ACTION_OPEN, _("Open"), _("Cancel"));
	gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
	core_connect(core, chooser, "response", G_CALLBACK(recording_chosen), bar, 0);
	gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

bool sim_bar_do(struct sim_bar *bar, enum verb verb)
{
	LadderSim *sim = bar->core->sim;

	switch ((int)verb) {
	case VERB_sim_mode: begin_or_end(bar); return true;
	case VERB_sim_run: run_or_pause(bar); return true;
	case VERB_sim_scan:
		if (begin(bar))
			ladder_sim_scan(sim, 1);
		return true;
	case VERB_sim_stop: ladder_sim_stop(sim); return true;
	case VERB_sim_cold: ladder_sim_reset(sim, false); return true;
	case VERB_sim_warm: ladder_sim_reset(sim, true); return true;
	case VERB_sim_back: step_shown(bar, -1); return true;
	case VERB_sim_forth: step_shown(bar, 1); return true;
	case VERB_sim_plant: choose_plant(bar); return true;
	case VERB_sim_recording: choose_recording(bar); return true;
	case VERB_sim_no_plant: origin_set_plant(bar->origin, NULL); return true;
	case VERB_sim_now: ladder_sim_show_now(sim); return true;
	case VERB_sim_release: ladder_sim_release_all(sim); return true;
	case VERB_right:
		if (ladder_sim_is_on(sim))
			gtk_widget_set_visible(GTK_WIDGET(bar->right),
				!gtk_widget_get_visible(GTK_WIDGET(bar->right)));
		return true;
	default: return false;
	}
}

void sim_bar_show_panel(struct sim_bar *bar)
{
	gtk_widget_set_visible(GTK_WIDGET(bar->right), TRUE);
}

void sim_bar_init(struct sim_bar *bar, struct core *core, struct origin *origin)
{
	LadderSim *sim = core->sim;
	GtkWidget *panel = ladder_sim_panel_new(sim);

	bar->core = core;
	bar->origin = origin;
	gtk_widget_set_vexpand(panel, TRUE);
	gtk_box_append(bar->right, panel);
	tip_set(GTK_WIDGET(bar->forces_button), _("Release all forces"));
	size_panel(bar);
	gtk_widget_set_has_tooltip(GTK_WIDGET(bar->title), TRUE);
	core_connect(core, bar->title, "query-tooltip", G_CALLBACK(tell_lateness), bar, 0);
	core_connect(core, gtk_settings_get_default(), "notify::gtk-xft-dpi",
		     G_CALLBACK(size_panel), bar, G_CONNECT_SWAPPED);
	gtk_menu_button_set_popover(bar->pace_button, ladder_sim_pace_new(sim));
	core_connect(core, sim, "state-changed", G_CALLBACK(state_changed), bar,
		     G_CONNECT_SWAPPED);
	core_connect(core, sim, "shown", G_CALLBACK(shown), bar, G_CONNECT_SWAPPED);
	core_connect(core, sim, "told", G_CALLBACK(told), bar, 0);
	core_connect(core, core->document, "checked", G_CALLBACK(checked), bar,
		     G_CONNECT_SWAPPED);
	core_connect(core, bar->simulate_mode, "toggled", G_CALLBACK(mode_toggled), bar,
		     G_CONNECT_SWAPPED);
	show_buttons(bar);
}

void sim_bar_clear(struct sim_bar *bar)
{
	g_clear_handle_id(&bar->when_timer, g_source_remove);
}
