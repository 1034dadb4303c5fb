/* SPDX-License-Identifier: MIT
 *
 * task_lane - draws the runs of one task over time; see task_lane.h.
 *
 * A run has no length in virtual time. Its bar shows when it begins; bars of one cycle stand
 * beside each other in the order in which they run.
 */
#include "editor-gtk/panels/task_lane.h"

#include "editor-gtk/kit/theme.h"
#include "editor-gtk/sim/live_value.h"

#include <adwaita.h>
#include <math.h>

#define HIGH 26       /* px of a lane                                          */
#define RULER_HIGH 20
#define BAR_HIGH 14
#define BAR_LEAST 2   /* px of a bar                                           */
#define BAR_MOST 12
#define DASH 5        /* px of a dash of an event's line, and between two      */
#define TICK_APART 80 /* px between two times of the ruler, at least           */

struct _LadderTaskLane {
	GtkWidget parent_instance;
	GtkAdjustment *time;
	const struct schedule *schedule;
	int number;
	gint64 mark_ns;
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

/* The width of a bar: those of a cycle fit into it, with a gap behind them. */
static double bar_width(const struct drawing *drawing)
{
	const struct schedule *schedule = drawing->lane->schedule;

	return CLAMP((double)schedule->tick_ns * drawing->px / (schedule->lane_count + 1),
		     BAR_LEAST, BAR_MOST);
}

static void draw_runs(struct drawing *drawing)
{
	const struct schedule *schedule = drawing->lane->schedule;
	const double wide = bar_width(drawing);
	const double apart = (double)schedule->tick_ns * drawing->px >
			     wide * schedule->lane_count ? wide : 0;

	fill(drawing, TOKEN_LINE, 0, HIGH - 6, drawing->width, 1);
	for (guint i = 0; i < schedule->run->len; i++) {
		const struct schedule_run *run = &g_array_index(schedule->run,
								struct schedule_run, i);
		const double x = x_of(drawing, (double)run->at_ns) + run->order * apart;

		if (x > drawing->width)
			return;
		if (run->lane == drawing->lane->number && x + wide >= 0)
			fill(drawing, TOKEN_ACCENT, x, HIGH - 6 - BAR_HIGH, MAX(wide - 1, BAR_LEAST),
			     BAR_HIGH);
	}
}

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

static void draw_time(struct drawing *drawing, double ns)
{
	const double x = x_of(drawing, ns);
	PangoLayout *layout;
	char text[32];
	int width;

	live_time_print((gint64)ns, text, sizeof(text));
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
		draw_time(drawing, ns);
}

/* ---- the widget ---- */

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
	else if (lane->schedule->lane[lane->number].kind == TASK_EVENT)
		draw_event(&drawing);
	else
		draw_runs(&drawing);
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
	AdwStyleManager *manager = adw_style_manager_get_default();

	lane->number = -1;
	lane->mark_ns = -1;
	gtk_widget_set_overflow(GTK_WIDGET(lane), GTK_OVERFLOW_HIDDEN);
	gtk_widget_set_hexpand(GTK_WIDGET(lane), TRUE);
	g_signal_connect_object(manager, "notify::dark", G_CALLBACK(gtk_widget_queue_draw), lane,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(manager, "notify::high-contrast",
				G_CALLBACK(gtk_widget_queue_draw), lane, G_CONNECT_SWAPPED);
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
	gtk_widget_queue_resize(GTK_WIDGET(lane));
}

void ladder_task_lane_mark(LadderTaskLane *lane, gint64 ns)
{
	if (lane->mark_ns == ns)
		return;
	lane->mark_ns = ns;
	gtk_widget_queue_draw(GTK_WIDGET(lane));
}
