/* SPDX-License-Identifier: MIT
 *
 * task_lane - draws the runs of one task over time; see task_lane.h.
 *
 * A run has no length in virtual time. Its bar shows when it begins; bars of one cycle stand
 * beside each other in the order in which they run. During a simulation the plan is drawn as low
 * grey bars, and the runs over it; a line leads from the deadline to a late one.
 */
#include "editor-gtk/panels/task_lane.h"

#include "editor-gtk/kit/theme.h"
#include "editor-gtk/sim/live_value.h"

#include <gtk/gtk.h>
#include <math.h>

#define HIGH 26       /* px of a lane                                          */
#define RULER_HIGH 20
#define BAR_HIGH 14
#define BAR_BAD 17    /* px of a run that was late                             */
#define PLAN_HIGH 6   /* px of a bar of the plan below the runs                */
#define BAR_LEAST 2   /* px of a bar                                           */
#define BAR_MOST 12
#define DASH 5        /* px of a dash of an event's line, and between two      */
#define TICK_APART 80 /* px between two times of the ruler, at least           */

struct _LadderTaskLane {
	GtkWidget parent_instance;
	GtkAdjustment *time;
	const struct schedule *schedule;
	int number;
	const char *task;      /* its name, interned                            */
	gint64 mark_ns;
	struct task_live live;
};

G_DEFINE_FINAL_TYPE(LadderTaskLane, ladder_task_lane, GTK_TYPE_WIDGET)

struct drawing {
	LadderTaskLane *lane;
	GtkSnapshot *snapshot;
	const struct theme *theme;
	double width, from_ns, px; /* pixels of a ns                           */
};

static double page_of(const LadderTaskLane *lane)
{
	return MAX(gtk_adjustment_get_page_size(lane->time), 1);
}

gint64 ladder_task_lane_time(LadderTaskLane *lane, double x)
{
	const double width = MAX(gtk_widget_get_width(GTK_WIDGET(lane)), 1);

	return (gint64)(gtk_adjustment_get_value(lane->time) + x / width * page_of(lane));
}

static void fill(struct drawing *drawing, enum token token, double x, double y, double width,
		 double height)
{
	gtk_snapshot_append_color(drawing->snapshot, &drawing->theme->color[token],
		&GRAPHENE_RECT_INIT((float)x, (float)y, (float)width, (float)height));
}

static double x_of(const struct drawing *drawing, double ns)
{
	return (ns - drawing->from_ns) * drawing->px;
}

/* ---- runs ---- */

/* px from one cycle to the next. */
static double cycle_px(const struct drawing *drawing)
{
	const LadderTaskLane *lane = drawing->lane;

	return (double)(lane->live.runs ? lane->live.period_ns : lane->schedule->tick_ns) *
	       drawing->px;
}

/* The width of a bar: those of a cycle fit into it, with a gap behind them. */
static double bar_width(const struct drawing *drawing)
{
	return CLAMP(cycle_px(drawing) / (drawing->lane->schedule->lane_count + 1), BAR_LEAST,
		     BAR_MOST);
}

/* px from a bar to the next one of the same cycle; 0: there is no room for that. */
static double bars_apart(const struct drawing *drawing)
{
	const double wide = bar_width(drawing);

	return cycle_px(drawing) > wide * drawing->lane->schedule->lane_count ? wide : 0;
}

static void draw_bar(struct drawing *drawing, enum token token, double x, double high)
{
	fill(drawing, token, x, HIGH - 6 - high, MAX(bar_width(drawing) - 1, BAR_LEAST), high);
}

static void draw_runs(struct drawing *drawing)
{
	const struct schedule *schedule = drawing->lane->schedule;
	const double wide = bar_width(drawing), apart = bars_apart(drawing);

	for (guint i = 0; i < schedule->run->len; i++) {
		const struct schedule_run *run = &g_array_index(schedule->run,
								struct schedule_run, i);
		const double x = x_of(drawing, (double)run->at_ns) + run->order * apart;

		if (x > drawing->width)
			return;
		if (run->lane == drawing->lane->number && x + wide >= 0)
			draw_bar(drawing, TOKEN_ACCENT, x, BAR_HIGH);
	}
}

/* ---- a simulation ---- */

/* How many tasks are due before this one at a time after the start. */
static int planned_before(const LadderTaskLane *lane, gint64 since_ns)
{
	int before = 0;

	for (int i = 0; i < lane->number; i++) {
		const struct schedule_lane *other = &lane->schedule->lane[i];

		before += other->kind == TASK_INTERVAL && since_ns % other->interval_ns == 0;
	}
	return before;
}

/* At most one bar for each px. */
static void draw_plan(struct drawing *drawing)
{
	const LadderTaskLane *lane = drawing->lane;
	const struct schedule_lane *of = &lane->schedule->lane[lane->number];
	const gint64 step = of->kind == TASK_INTERVAL ? of->interval_ns : lane->live.period_ns;
	const gint64 from = (gint64)MAX(drawing->from_ns - (double)lane->live.start_ns, 0);
	const gint64 by = step * MAX((gint64)ceil(1 / ((double)step * drawing->px)), 1);
	const double apart = bars_apart(drawing);

	for (gint64 since = from / step * step;; since += by) {
		const double x = x_of(drawing, (double)(lane->live.start_ns + since));

		if (x > drawing->width)
			return;
		draw_bar(drawing, TOKEN_IDLE, x + planned_before(lane, since) * apart, PLAN_HIGH);
	}
}

static bool is_bad(const struct task_run *run)
{
	return run->late_ns || run->missed || run->fault;
}

/* A run that takes time is as wide as that; a line joins its parts. */
static void draw_run(struct drawing *drawing, const struct task_run *run, double x, bool bad)
{
	const enum token token = bad ? TOKEN_ERROR : TOKEN_POWER;
	const double high = bad ? BAR_BAD : BAR_HIGH, wide = (double)run->took_ns * drawing->px;
	const double paused = (double)(run->at_ns - run->paused_ns) * drawing->px;

	if (run->took_ns)
		fill(drawing, token, x, HIGH - 6 - high, MAX(wide, BAR_LEAST), high);
	else
		draw_bar(drawing, token, x, high);
	if (run->paused_ns && paused > 1)
		fill(drawing, token, x - paused, HIGH - 6 - BAR_HIGH / 2.0, paused, 1);
}

/* At most one bar for each px, bad ones before good ones. */
static void draw_real(struct drawing *drawing)
{
	const LadderTaskLane *lane = drawing->lane;
	const struct task_runs *runs = lane->live.runs;
	const double apart = bars_apart(drawing);
	const gint64 from = (gint64)(drawing->from_ns - BAR_MOST * 2 / drawing->px);
	double drawn = -2 * BAR_MOST;
	bool bad = false;

	for (guint i = task_runs_from(runs, from); i < task_runs_count(runs); i++) {
		const struct task_run *run = task_runs_get(runs, i);
		const double x = x_of(drawing, (double)run->at_ns) + run->order * apart;
		const double late = (double)run->late_ns * drawing->px;

		if (x > drawing->width)
			return;
		if (run->task != lane->task || (x - drawn < 1 && (bad || !is_bad(run))))
			continue;
		drawn = x;
		bad = is_bad(run);
		draw_run(drawing, run, x, bad);
		if (late > 1)
			fill(drawing, TOKEN_ERROR, x - late, HIGH - 6 - BAR_BAD, late, 2);
	}
}

/* ---- events ---- */

/* A dashed line: an event comes at no known time. */
static void draw_event(struct drawing *drawing)
{
	for (double x = 0; x < drawing->width; x += 2 * DASH)
		fill(drawing, TOKEN_COMMENT, x, HIGH / 2.0, DASH, 1);
}

/* ---- the ruler ---- */

/* 1, 2 or 5 times a power of ten, at least @least. */
static double step_of(double least)
{
	const double ten = pow(10, floor(log10(MAX(least, 1))));

	return least <= ten ? ten : least <= 2 * ten ? 2 * ten : least <= 5 * ten ? 5 * ten :
	       10 * ten;
}

static void draw_time(struct drawing *drawing, double ns, double step)
{
	const double x = x_of(drawing, ns);
	PangoLayout *layout;
	char text[32];
	int width;

	live_time_print_tick((gint64)(round(ns / step) * step), (gint64)step, text, sizeof(text));
	layout = gtk_widget_create_pango_layout(GTK_WIDGET(drawing->lane), text);

	pango_layout_get_pixel_size(layout, &width, NULL);
	fill(drawing, TOKEN_LINE, x, 0, 1, 5);
	if (x + 3 + width <= drawing->width) {
		gtk_snapshot_save(drawing->snapshot);
		gtk_snapshot_translate(drawing->snapshot, &GRAPHENE_POINT_INIT((float)x + 3, 1));
		gtk_snapshot_append_layout(drawing->snapshot, layout,
					   &drawing->theme->color[TOKEN_COMMENT]);
		gtk_snapshot_restore(drawing->snapshot);
	}
	g_object_unref(layout);
}

static void draw_ruler(struct drawing *drawing)
{
	const double step = step_of(TICK_APART / drawing->px);

	fill(drawing, TOKEN_LINE, 0, 0, drawing->width, 1);
	for (double ns = ceil(drawing->from_ns / step) * step; x_of(drawing, ns) < drawing->width;
	     ns += step)
		draw_time(drawing, ns, step);
}

/* ---- the widget ---- */

static void draw_lane(struct drawing *drawing)
{
	const LadderTaskLane *lane = drawing->lane;
	const bool event = lane->schedule->lane[lane->number].kind == TASK_EVENT;

	if (event)
		draw_event(drawing);
	else
		fill(drawing, TOKEN_LINE, 0, HIGH - 6, drawing->width, 1);
	if (!lane->live.runs) {
		if (!event)
			draw_runs(drawing);
		return;
	}
	if (!event)
		draw_plan(drawing);
	draw_real(drawing);
}

static void snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderTaskLane *lane = LADDER_TASK_LANE(widget);
	const int width = gtk_widget_get_width(widget);
	struct drawing drawing = { lane, snapshot, theme_screen(), width,
		gtk_adjustment_get_value(lane->time), width / page_of(lane) };

	if (!lane->schedule || width <= 0)
		return;
	if (lane->number < 0)
		draw_ruler(&drawing);
	else
		draw_lane(&drawing);
	if (lane->live.runs)
		fill(&drawing, TOKEN_ACCENT, x_of(&drawing, (double)lane->live.now_ns), 0, 2, HIGH);
	if (lane->mark_ns >= 0 && lane->number >= 0)
		fill(&drawing, TOKEN_INK, x_of(&drawing, (double)lane->mark_ns), 0, 1, HIGH);
}

static void measure(GtkWidget *widget, GtkOrientation orientation, int for_size, int *minimum,
		    int *natural, int *minimum_baseline, int *natural_baseline)
{
	const int high = LADDER_TASK_LANE(widget)->number < 0 ? RULER_HIGH : HIGH;

	(void)for_size;
	*minimum = orientation == GTK_ORIENTATION_VERTICAL ? high : TICK_APART;
	*natural = orientation == GTK_ORIENTATION_VERTICAL ? high : 3 * TICK_APART;
	*minimum_baseline = *natural_baseline = -1;
}

static void dispose(GObject *object)
{
	g_clear_object(&LADDER_TASK_LANE(object)->time);
	G_OBJECT_CLASS(ladder_task_lane_parent_class)->dispose(object);
}

static void ladder_task_lane_class_init(LadderTaskLaneClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->snapshot = snapshot;
	widget->measure = measure;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_PRESENTATION);
}

static void ladder_task_lane_init(LadderTaskLane *lane)
{
	lane->number = -1;
	lane->mark_ns = -1;
	gtk_widget_set_overflow(GTK_WIDGET(lane), GTK_OVERFLOW_HIDDEN);
	gtk_widget_set_hexpand(GTK_WIDGET(lane), TRUE);
	theme_follow(lane, G_CALLBACK(gtk_widget_queue_draw));
}

GtkWidget *ladder_task_lane_new(GtkAdjustment *time)
{
	LadderTaskLane *lane = g_object_new(LADDER_TYPE_TASK_LANE, NULL);

	lane->time = g_object_ref(time);
	g_signal_connect_object(time, "changed", G_CALLBACK(gtk_widget_queue_draw), lane,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(time, "value-changed", G_CALLBACK(gtk_widget_queue_draw), lane,
				G_CONNECT_SWAPPED);
	return GTK_WIDGET(lane);
}

void ladder_task_lane_set(LadderTaskLane *lane, const struct schedule *schedule, int number)
{
	lane->schedule = schedule;
	lane->number = number;
	lane->task = schedule && number >= 0 ? g_intern_string(schedule->lane[number].name) : NULL;
	gtk_widget_queue_resize(GTK_WIDGET(lane));
}

void ladder_task_lane_live(LadderTaskLane *lane, const struct task_live *live)
{
	lane->live = *live;
	gtk_widget_queue_draw(GTK_WIDGET(lane));
}

void ladder_task_lane_mark(LadderTaskLane *lane, gint64 ns)
{
	if (lane->mark_ns == ns)
		return;
	lane->mark_ns = ns;
	gtk_widget_queue_draw(GTK_WIDGET(lane));
}
