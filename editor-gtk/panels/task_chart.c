/* SPDX-License-Identifier: MIT
 *
 * task_chart - what runs when; see task_chart.h.
 */
#include "editor-gtk/panels/task_chart.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/task_lane.h"
#include "editor-gtk/sim/live_value.h"

#define NAMES_PX 150   /* names left of the lanes                              */
#define ZOOM 1.5
#define CYCLES_LEAST 4 /* visible ones, at least                               */
#define FEED_US 4000   /* for reading the record, at a time                    */
#define NOW_AT 0.9     /* where the running time stands in the picture         */
#define FETCH_US 1000000 /* before a board is asked again what it recorded       */

struct _LadderTaskChart {
	GtkBox parent_instance;
	GtkWidget *tools, *list, *ruler, *bar, *text;
	GtkAdjustment *time;
	struct schedule *schedule; /* NULL: none                               */
	gint64 at_ns;              /* the time that is shown; -1: none         */
	LadderSim *sim;            /* NULL: none                               */
	struct task_runs *runs;    /* NULL: the simulation is off              */
	guint reading;             /* idle that reads the record               */
	gint64 fetched_us;         /* when a board was asked for it            */
	bool follows;              /* the time that is shown is in sight       */
	bool moving;               /* it scrolls by itself                     */
};

G_DEFINE_FINAL_TYPE(LadderTaskChart, ladder_task_chart, GTK_TYPE_BOX)

/* ---- the shown range of time ---- */

static LadderTaskLane *lane_of(GtkListBoxRow *row)
{
	return LADDER_TASK_LANE(gtk_widget_get_last_child(gtk_list_box_row_get_child(row)));
}

/* "the first 40 ms; then everything repeats". Caller frees. */
static char *span_text(const struct schedule *schedule)
{
	char span[32];

	live_time_print(schedule->span_ns, span, sizeof(span));
	return g_strdup_printf(schedule->whole ? _("the first %s; then everything repeats") :
			       _("the first %s"), span);
}

/* With what it did in the simulation until the scan that is shown. Caller frees. */
static char *lane_text(LadderTaskChart *chart, int lane)
{
	const struct twin *twin = chart->runs ? ladder_sim_twin(chart->sim) : NULL;
	char *sum = twin ? task_runs_sum_text(twin, chart->schedule->lane[lane].name) : NULL;
	char *plan = schedule_lane_text(chart->schedule, lane);
	char *text = sum ? g_strdup_printf("%s · %s", plan, sum) : g_strdup(plan);

	g_free(plan);
	g_free(sum);
	return text;
}

static char *live_text(LadderTaskChart *chart, GtkListBoxRow *row)
{
	if (chart->at_ns >= 0)
		return task_runs_at_text(chart->runs, chart->at_ns, ladder_sim_period(chart->sim));
	return row ? lane_text(chart, gtk_list_box_row_get_index(row)) :
	       g_strdup(_("low, grey: planned · green: ran · high, red: late, or runs left out"));
}

/* The time that is shown. Of a board it is that of the last scan that was read. */
static gint64 now_of(const LadderTaskChart *chart, const struct twin *twin)
{
	return ladder_sim_may_miss(chart->sim) && !ladder_sim_is_past(chart->sim) &&
	       task_runs_time(chart->runs) ? task_runs_time(chart->runs) : twin->now_ns;
}

static void show_text(LadderTaskChart *chart)
{
	GtkListBoxRow *row = gtk_list_box_get_selected_row(GTK_LIST_BOX(chart->list));
	char *text = chart->schedule && chart->runs ? live_text(chart, row) : !chart->schedule ? g_strdup(_("Correct the errors of the program to see what "
						   "runs when.")) :
		chart->at_ns >= 0 ? schedule_at_text(chart->schedule, chart->at_ns) :
		row ? schedule_lane_text(chart->schedule, gtk_list_box_row_get_index(row)) :
		span_text(chart->schedule);

	gtk_label_set_text(GTK_LABEL(chart->text), text);
	tip_set(chart->text, text);
	g_free(text);
}

static void show_at(LadderTaskChart *chart, gint64 ns)
{
	const struct schedule *schedule = chart->schedule;
	GtkListBoxRow *row;

	chart->at_ns = ns < 0 || !schedule ? -1 : chart->runs ? ns :
		MIN(ns, schedule->span_ns - 1) / schedule->tick_ns * schedule->tick_ns;
	for (int i = 0; (row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(chart->list), i)); i++)
		ladder_task_lane_mark(lane_of(row), chart->at_ns);
	show_text(chart);
}

static void moved(GtkEventControllerMotion *motion, double x, double y, LadderTaskChart *chart)
{
	GtkWidget *lane = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(motion));

	(void)y;
	show_at(chart, MAX(ladder_task_lane_time(LADDER_TASK_LANE(lane), x), 0));
}

static void left(GtkEventControllerMotion *motion, LadderTaskChart *chart)
{
	(void)motion;
	show_at(chart, -1);
}

static void selected(GtkListBox *list, GtkListBoxRow *row, LadderTaskChart *chart)
{
	(void)list;
	(void)row;
	show_text(chart);
}

/* ---- zoom ---- */

/* All the time that can be seen, in ns: of the plan, or of the simulation. */
static double whole(LadderTaskChart *chart)
{
	const struct twin *twin = chart->runs ? ladder_sim_twin(chart->sim) : NULL;
	const guint count = chart->runs ? task_runs_count(chart->runs) : 0;
	gint64 ns = chart->schedule ? chart->schedule->span_ns : 1;

	if (twin)
		ns = MAX(ns, twin->now_ns);
	if (count)
		ns = MAX(ns, task_runs_get(chart->runs, count - 1)->at_ns);
	return (double)ns;
}

static void set_span(LadderTaskChart *chart, double from, double page)
{
	double span = whole(chart);

	page = MIN(page, span);
	if (chart->runs) /* room for the bars of the newest scan */
		span += (1 - NOW_AT) * page;
	chart->moving = true;
	gtk_adjustment_configure(chart->time, CLAMP(from, 0, span - page), 0, span, page / 10,
				 page * 0.9, page);
	chart->moving = false;
	gtk_widget_set_visible(chart->bar, page < span);
	gtk_widget_action_set_enabled(GTK_WIDGET(chart), "task-chart.zoom-out", page < span);
	gtk_widget_action_set_enabled(GTK_WIDGET(chart), "task-chart.zoom-fit", page < span);
	gtk_widget_action_set_enabled(GTK_WIDGET(chart), "task-chart.zoom-in", chart->schedule &&
		page > (double)(CYCLES_LEAST * chart->schedule->tick_ns));
}

/* The time that is shown stays where it is, else the left edge. */
static void zoom(LadderTaskChart *chart, double factor)
{
	const double from = gtk_adjustment_get_value(chart->time);
	const double page = gtk_adjustment_get_page_size(chart->time);
	const double still = chart->at_ns >= 0 ? (double)chart->at_ns : from;
	double now;

	if (!chart->schedule)
		return;
	now = MAX(page / factor, (double)(CYCLES_LEAST * chart->schedule->tick_ns));
	set_span(chart, still - (still - from) / page * now, now);
}

static void act(GtkWidget *widget, const char *action, GVariant *unused)
{
	LadderTaskChart *chart = LADDER_TASK_CHART(widget);

	(void)unused;
	if (g_str_has_suffix(action, "fit"))
		set_span(chart, 0, G_MAXDOUBLE);
	else
		zoom(chart, g_str_has_suffix(action, "in") ? ZOOM : 1 / ZOOM);
}

static gboolean scrolled(GtkEventControllerScroll *scroll, double dx, double dy,
			 LadderTaskChart *chart)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(scroll));

	(void)dx;
	if (!(state & GDK_CONTROL_MASK))
		return FALSE;
	zoom(chart, dy < 0 ? ZOOM : 1 / ZOOM);
	return TRUE;
}

/* ---- keys ---- */

/* The same in the simulation; without a time, of the scan that is shown. */
static gint64 real_beside(const LadderTaskChart *chart, int lane, int by)
{
	const char *task = g_intern_string(chart->schedule->lane[lane].name);
	const struct twin *twin = ladder_sim_twin(chart->sim);
	const gint64 at = chart->at_ns >= 0 || !twin ? chart->at_ns : now_of(chart, twin) + 1;
	const guint count = task_runs_count(chart->runs);
	guint i = task_runs_from(chart->runs, by > 0 ? at + 1 : at);

	for (i = by > 0 ? i : i - 1; i < count; i += (guint)by)
		if (task_runs_get(chart->runs, i)->task == task)
			return task_runs_get(chart->runs, i)->at_ns;
	return -1;
}

/* The next run of a lane before or behind the time that is shown; -1: none. */
static gint64 run_beside(const LadderTaskChart *chart, int lane, int by)
{
	const GArray *run = chart->schedule->run;
	gint64 found = -1;

	for (guint i = 0; i < run->len; i++) {
		const struct schedule_run *each = &g_array_index(run, struct schedule_run, i);

		if (each->lane != lane)
			continue;
		if (by > 0 && each->at_ns > chart->at_ns)
			return each->at_ns;
		if (by < 0 && each->at_ns < chart->at_ns)
			found = each->at_ns;
	}
	return found;
}

static void reveal(LadderTaskChart *chart, gint64 ns)
{
	const double page = gtk_adjustment_get_page_size(chart->time);

	gtk_adjustment_clamp_page(chart->time, (double)ns, (double)ns + page / 20);
}

/* Shows the last scan with a run at or before the time. */
static void show_scan(LadderTaskChart *chart, gint64 ns)
{
	const guint behind = chart->runs ? task_runs_from(chart->runs, ns + 1) : 0;

	if (behind)
		ladder_sim_show(chart->sim, task_runs_get(chart->runs, behind - 1)->scan);
}

static void clicked(GtkGestureClick *click, int count, double x, double y, LadderTaskChart *chart)
{
	GtkWidget *lane = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(click));

	(void)count;
	(void)y;
	show_scan(chart, ladder_task_lane_time(LADDER_TASK_LANE(lane), x));
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderTaskChart *chart)
{
	GtkListBoxRow *row = gtk_list_box_get_selected_row(GTK_LIST_BOX(chart->list));
	const int by = key == GDK_KEY_Right ? 1 : key == GDK_KEY_Left ? -1 : 0;
	gint64 to;

	(void)keys;
	(void)code;
	if (key == GDK_KEY_Escape && chart->at_ns >= 0) {
		show_at(chart, -1);
		return TRUE;
	}
	if ((key == GDK_KEY_Return || key == GDK_KEY_KP_Enter) && chart->runs &&
	    chart->at_ns >= 0) {
		show_scan(chart, chart->at_ns);
		return TRUE;
	}
	if (!by || !row || !chart->schedule || state & gtk_accelerator_get_default_mod_mask())
		return FALSE;
	to = chart->runs ? real_beside(chart, gtk_list_box_row_get_index(row), by) :
	     run_beside(chart, gtk_list_box_row_get_index(row), by);
	if (to >= 0) {
		show_at(chart, to);
		reveal(chart, to);
	}
	return TRUE;
}

/* ---- the simulation ---- */

static void show_lanes(LadderTaskChart *chart, const struct twin *twin)
{
	const struct task_live live = { chart->runs, twin ? twin->resource.start_ns : 0,
		twin ? now_of(chart, twin) : 0, twin ? twin->period_ns : 1 };
	const bool still = !twin || ladder_sim_state(chart->sim) != SIM_RUN;
	GtkListBoxRow *row;

	ladder_task_lane_live(LADDER_TASK_LANE(chart->ruler), &live);
	for (int i = 0; (row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(chart->list), i)); i++) {
		char *text = still ? lane_text(chart, i) : NULL;

		ladder_task_lane_live(lane_of(row), &live);
		if (text) /* not many times a second */
			spoken_name(row, text);
		g_free(text);
	}
}

/* The scan that is shown stays in sight, unless a person scrolled away from it. */
static void scroll_to_now(LadderTaskChart *chart, gint64 now_ns)
{
	const double page = gtk_adjustment_get_page_size(chart->time), now = (double)now_ns;
	double from = gtk_adjustment_get_value(chart->time);
	const bool seen = now >= from && now <= from + NOW_AT * page;

	if (!seen && (chart->follows || ladder_sim_is_past(chart->sim)))
		from = MAX(now - NOW_AT * page, 0);
	set_span(chart, from, page);
}

static void show_live(LadderTaskChart *chart)
{
	const struct twin *twin = ladder_sim_twin(chart->sim);

	if (twin)
		scroll_to_now(chart, now_of(chart, twin));
	show_lanes(chart, twin);
	show_text(chart);
}

static gboolean read_on(gpointer data)
{
	LadderTaskChart *chart = data;

	if (chart->runs && task_runs_feed(chart->runs, FEED_US))
		return G_SOURCE_CONTINUE;
	chart->reading = 0;
	if (chart->runs)
		show_live(chart);
	return G_SOURCE_REMOVE;
}

/* Between the plan alone and a simulation. */
static void turn(LadderTaskChart *chart, bool on)
{
	g_clear_pointer(&chart->runs, task_runs_free);
	chart->at_ns = -1;
	chart->follows = true;
	if (on)
		chart->runs = task_runs_new(chart->sim);
	set_span(chart, 0, chart->schedule ? (double)chart->schedule->span_ns : 1);
}

/* What a board recorded since it was asked last. */
static void fetch(LadderTaskChart *chart)
{
	const gint64 now = g_get_monotonic_time();

	if (!ladder_sim_may_miss(chart->sim) || now - chart->fetched_us < FETCH_US)
		return;
	chart->fetched_us = now;
	ladder_sim_fetch(chart->sim);
}

static void follow(LadderTaskChart *chart)
{
	const bool on = chart->sim && ladder_sim_is_on(chart->sim);

	if (!gtk_widget_get_mapped(GTK_WIDGET(chart)) || (!on && !chart->runs))
		return;
	if (on != (chart->runs != NULL))
		turn(chart, on);
	if (on)
		fetch(chart);
	if (on && !chart->reading && task_runs_feed(chart->runs, FEED_US))
		chart->reading = g_idle_add(read_on, chart);
	show_live(chart);
}

static void scrolled_to(GtkAdjustment *time, LadderTaskChart *chart)
{
	const struct twin *twin = chart->runs ? ladder_sim_twin(chart->sim) : NULL;
	const double from = gtk_adjustment_get_value(time);

	if (!chart->moving && twin)
		chart->follows = (double)now_of(chart, twin) >= from &&
			(double)now_of(chart, twin) <= from + gtk_adjustment_get_page_size(time);
}

void ladder_task_chart_follow(LadderTaskChart *chart, LadderSim *sim)
{
	chart->sim = g_object_ref(sim);
	g_signal_connect_object(sim, "shown", G_CALLBACK(follow), chart, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(follow), chart,
				G_CONNECT_SWAPPED);
	g_signal_connect(chart, "map", G_CALLBACK(follow), NULL);
}

/* ---- lanes ---- */

static GtkWidget *label_new(void)
{
	GtkWidget *label = gtk_label_new(NULL);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	return label;
}

static void listen(LadderTaskChart *chart, GtkWidget *lane)
{
	GtkEventController *motion = gtk_event_controller_motion_new();
	GtkGesture *click = gtk_gesture_click_new();

	g_signal_connect(click, "released", G_CALLBACK(clicked), chart);
	gtk_widget_add_controller(lane, GTK_EVENT_CONTROLLER(click));
	g_signal_connect(motion, "motion", G_CALLBACK(moved), chart);
	g_signal_connect(motion, "leave", G_CALLBACK(left), chart);
	gtk_widget_add_controller(lane, motion);
}

/* Name and period at the left, the lane beside them. */
static GtkWidget *row_new(LadderTaskChart *chart)
{
	GtkWidget *row = gtk_list_box_row_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkWidget *names = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkWidget *name = label_new(), *when = label_new();
	GtkWidget *lane = ladder_task_lane_new(chart->time);

	gtk_widget_set_hexpand(name, TRUE);
	gtk_widget_add_css_class(when, "dim-label");
	gtk_widget_add_css_class(when, "caption");
	gtk_widget_set_size_request(names, NAMES_PX, -1);
	gtk_widget_set_hexpand(names, FALSE);
	gtk_box_append(GTK_BOX(names), name);
	gtk_box_append(GTK_BOX(names), when);
	gtk_box_append(GTK_BOX(box), names);
	gtk_box_append(GTK_BOX(box), lane);
	gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
	listen(chart, lane);
	return row;
}

/* "5 ms", or the variable. Caller frees. */
static char *when_text(const struct schedule *schedule, const struct schedule_lane *lane,
		       const struct task_rows *tasks)
{
	const int row = task_rows_find(tasks, TASKS_TASK, lane->name);
	char period[32];

	if (lane->kind == TASK_EVENT)
		return g_strdup_printf(_("on %s"), row >= 0 ? tasks->row[row].text[TASKS_WHEN] : "");
	live_time_print(lane->kind == TASK_INTERVAL ? lane->interval_ns : schedule->tick_ns,
			period, sizeof(period));
	return g_strdup(period);
}

static void fill_row(LadderTaskChart *chart, GtkListBoxRow *row, int number,
		     const struct task_rows *tasks)
{
	const struct schedule_lane *lane = &chart->schedule->lane[number];
	GtkWidget *name = gtk_widget_get_first_child(gtk_widget_get_first_child(
		gtk_list_box_row_get_child(row)));
	char *when = when_text(chart->schedule, lane, tasks);
	char *text = lane_text(chart, number);

	gtk_label_set_text(GTK_LABEL(name), schedule_lane_name(lane));
	gtk_label_set_text(GTK_LABEL(gtk_widget_get_next_sibling(name)), when);
	ladder_task_lane_set(lane_of(row), chart->schedule, number);
	spoken_name(row, text);
	tip_set(gtk_list_box_row_get_child(row), text);
	g_free(when);
	g_free(text);
}

void ladder_task_chart_set(LadderTaskChart *chart, struct schedule *schedule,
			   const struct task_rows *tasks)
{
	GtkListBox *list = GTK_LIST_BOX(chart->list);
	const int count = schedule ? schedule->lane_count : 0;
	const bool fits = !chart->schedule || !schedule ||
			  chart->schedule->span_ns != schedule->span_ns;
	GtkListBoxRow *row;

	while ((row = gtk_list_box_get_row_at_index(list, count)))
		gtk_list_box_remove(list, GTK_WIDGET(row));
	ladder_task_lane_set(LADDER_TASK_LANE(chart->ruler), schedule, -1);
	g_clear_pointer(&chart->schedule, schedule_free);
	chart->schedule = schedule;
	for (int i = 0; i < count; i++) {
		if (!gtk_list_box_get_row_at_index(list, i))
			gtk_list_box_append(list, row_new(chart));
		fill_row(chart, gtk_list_box_get_row_at_index(list, i), i, tasks);
	}
	if (fits)
		set_span(chart, 0, G_MAXDOUBLE);
	gtk_widget_set_visible(gtk_widget_get_parent(chart->ruler), schedule != NULL);
	gtk_widget_set_visible(chart->tools, schedule != NULL);
	show_at(chart, chart->at_ns);
	if (chart->runs)
		show_live(chart);
}

/* ---- the widget ---- */

static GtkWidget *heading_new(LadderTaskChart *chart)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6), *label = label_new();

	gtk_label_set_text(GTK_LABEL(label), _("WHAT RUNS WHEN"));
	gtk_widget_add_css_class(label, "panel-heading");
	chart->text = label_new();
	gtk_widget_set_hexpand(chart->text, TRUE);
	gtk_widget_set_margin_top(chart->text, 6); /* that of the heading */
	chart->tools = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
	gtk_box_append(GTK_BOX(chart->tools), panel_button_new("zoom-out-symbolic",
		_("Zoom out"), "task-chart.zoom-out"));
	gtk_box_append(GTK_BOX(chart->tools), panel_button_new("zoom-in-symbolic",
		_("Zoom in"), "task-chart.zoom-in"));
	gtk_box_append(GTK_BOX(chart->tools), panel_button_new("zoom-fit-best-symbolic",
		_("Show the whole time"), "task-chart.zoom-fit"));
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), chart->text);
	gtk_box_append(GTK_BOX(box), chart->tools);
	return box;
}

/* A row below the lanes with the same place for names. */
static GtkWidget *below_lanes(GtkWidget *child)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	GtkWidget *names = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);

	gtk_widget_set_size_request(names, NAMES_PX, -1);
	gtk_widget_add_css_class(box, "below-lanes");
	gtk_widget_set_hexpand(child, TRUE);
	gtk_box_append(GTK_BOX(box), names);
	gtk_box_append(GTK_BOX(box), child);
	return box;
}

static void dispose(GObject *object)
{
	LadderTaskChart *chart = LADDER_TASK_CHART(object);
	GtkListBoxRow *row;

	while (chart->list && (row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(chart->list), 0)))
		gtk_list_box_remove(GTK_LIST_BOX(chart->list), GTK_WIDGET(row));
	if (chart->ruler)
		ladder_task_lane_set(LADDER_TASK_LANE(chart->ruler), NULL, -1);
	chart->list = chart->ruler = NULL;
	g_clear_handle_id(&chart->reading, g_source_remove);
	g_clear_pointer(&chart->runs, task_runs_free);
	g_clear_object(&chart->sim);
	g_clear_pointer(&chart->schedule, schedule_free);
	g_clear_object(&chart->time);
	G_OBJECT_CLASS(ladder_task_chart_parent_class)->dispose(object);
}

static void ladder_task_chart_class_init(LadderTaskChartClass *class)
{
	static const char *const actions[] = {
		"task-chart.zoom-in", "task-chart.zoom-out", "task-chart.zoom-fit",
	};

	G_OBJECT_CLASS(class)->dispose = dispose;
	for (gsize i = 0; i < G_N_ELEMENTS(actions); i++)
		gtk_widget_class_install_action(GTK_WIDGET_CLASS(class), actions[i], NULL, act);
}

static void ladder_task_chart_init(LadderTaskChart *chart)
{
	GtkBox *box = GTK_BOX(chart);
	GtkEventController *scroll =
		gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkWidget *scroller = gtk_scrolled_window_new();

	gtk_orientable_set_orientation(GTK_ORIENTABLE(chart), GTK_ORIENTATION_VERTICAL);
	chart->at_ns = -1;
	chart->time = g_object_ref_sink(gtk_adjustment_new(0, 0, 1, 0, 0, 1));
	g_signal_connect_object(chart->time, "value-changed", G_CALLBACK(scrolled_to), chart, 0);
	chart->list = gtk_list_box_new();
	chart->ruler = ladder_task_lane_new(chart->time);
	chart->bar = gtk_scrollbar_new(GTK_ORIENTATION_HORIZONTAL, chart->time);
	gtk_widget_add_css_class(chart->list, "task-lanes");
	spoken_name(chart->list, _("What runs when"));
	g_signal_connect(chart->list, "row-selected", G_CALLBACK(selected), chart);
	g_signal_connect(scroll, "scroll", G_CALLBACK(scrolled), chart);
	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), chart);
	gtk_widget_add_controller(chart->list, scroll);
	gtk_widget_add_controller(chart->list, keys);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
	gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), 240);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), chart->list);
	gtk_box_append(box, heading_new(chart));
	gtk_box_append(box, scroller);
	gtk_box_append(box, below_lanes(chart->ruler));
	gtk_box_append(box, below_lanes(chart->bar));
	show_text(chart);
}
