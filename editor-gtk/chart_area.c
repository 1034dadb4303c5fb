/* SPDX-License-Identifier: MIT
 *
 * chart_area - a timing chart that can be used: cursor, zoom, pan, lines.
 */
#include "editor-gtk/chart_inside.h"

#include "editor-gtk/i18n.h"
#include "editor-gtk/popover.h"

#include <adwaita.h>

#define SPAN_LEAST 1e6    /* ns                                                  */
#define SPAN_MOST  4e12
#define SPAN_FIRST 1e10
#define FEED_US    2000   /* a frame may take so long to bring in new scans      */

enum { LINES_CHANGED, TOLD, SIGNAL_COUNT };
static guint signals[SIGNAL_COUNT];

G_DEFINE_FINAL_TYPE(LadderChartArea, ladder_chart_area, GTK_TYPE_WIDGET)

/* ---- time and place ---- */

static double newest(LadderChartArea *area)
{
	const struct chart *chart = area->chart;

	return chart_first(chart) < chart_end(chart) ?
	       (double)chart_time(chart, chart_end(chart) - 1) : 0;
}

double chart_right(LadderChartArea *area)
{
	return area->follows ? MAX(newest(area), area->span_ns) : area->right_ns;
}

double chart_plot_width(LadderChartArea *area)
{
	return MAX(gtk_widget_get_width(GTK_WIDGET(area)) - CHART_NAMES, 0);
}

double chart_x(LadderChartArea *area, double ns)
{
	return CHART_NAMES + chart_plot_width(area) -
	       (chart_right(area) - ns) / area->span_ns * chart_plot_width(area);
}

double chart_visible_top(LadderChartArea *area)
{
	return area->scrolled ? gtk_adjustment_get_value(area->scrolled) : 0;
}

double chart_visible_bottom(LadderChartArea *area)
{
	const double height = gtk_widget_get_height(GTK_WIDGET(area));

	return area->scrolled ? MIN(height, chart_visible_top(area) +
				    gtk_adjustment_get_page_size(area->scrolled)) : height;
}

static double ns_at(LadderChartArea *area, double x)
{
	return chart_right(area) - (CHART_NAMES + chart_plot_width(area) - x) *
	       area->span_ns / MAX(chart_plot_width(area), 1);
}

double ladder_chart_area_x(LadderChartArea *area, guint64 scan)
{
	return chart_x(area, (double)chart_time(area->chart, scan));
}

static void see(LadderChartArea *area, double right_ns)
{
	const double most = newest(area), least = area->span_ns;

	area->follows = right_ns >= most;
	area->right_ns = CLAMP(right_ns, MIN(least, most), MAX(most, least));
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void zoom_at(LadderChartArea *area, double factor, double x)
{
	const double ns = ns_at(area, x);
	const double part = (x - CHART_NAMES) / MAX(chart_plot_width(area), 1);

	area->span_ns = CLAMP(area->span_ns / factor, SPAN_LEAST, SPAN_MOST);
	if (!area->follows)
		see(area, ns + (1 - part) * area->span_ns);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

void ladder_chart_area_zoom(LadderChartArea *area, double factor)
{
	zoom_at(area, factor, CHART_NAMES + chart_plot_width(area) / 2);
}

void ladder_chart_area_fit(LadderChartArea *area)
{
	const struct chart *chart = area->chart;

	if (chart_first(chart) < chart_end(chart))
		area->span_ns = CLAMP(newest(area) -
			(double)chart_time(chart, chart_first(chart)), SPAN_LEAST, SPAN_MOST);
	area->follows = true;
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

/* ---- the record ---- */

static gboolean fill_idle(gpointer data)
{
	LadderChartArea *area = data;
	const bool more = chart_feed(area->chart, FEED_US);

	gtk_widget_queue_draw(GTK_WIDGET(area));
	if (more)
		return G_SOURCE_CONTINUE;
	area->idle = 0;
	return G_SOURCE_REMOVE;
}

static void tell_cursor(LadderChartArea *area)
{
	const struct twin *twin = ladder_sim_twin(area->sim);
	char *text;

	if (!twin)
		return;
	text = g_strdup_printf(_("scan %llu, %.2f s"), (unsigned long long)twin->scan,
			       (double)twin->now_ns / 1e9);
	gtk_accessible_update_property(GTK_ACCESSIBLE(area),
		GTK_ACCESSIBLE_PROPERTY_VALUE_NOW, (double)twin->scan,
		GTK_ACCESSIBLE_PROPERTY_VALUE_TEXT, text, -1);
	g_free(text);
}

static void shown(LadderChartArea *area)
{
	const guint64 end = chart_end(area->chart);

	if (!gtk_widget_get_mapped(GTK_WIDGET(area)))
		return;
	if (!area->idle && chart_feed(area->chart, FEED_US))
		area->idle = g_idle_add(fill_idle, area);
	if (ladder_sim_is_past(area->sim))
		tell_cursor(area);
	if (end != chart_end(area->chart) || ladder_sim_state(area->sim) != SIM_RUN)
		gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void program_changed(LadderChartArea *area)
{
	const guint64 life = ladder_sim_life(area->sim);

	chart_program_changed(area->chart);
	if (area->life != life) {
		area->mark_ns = -1;
		area->follows = true;
	}
	area->life = life;
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

struct chart *ladder_chart_area_chart(LadderChartArea *area)
{
	return area->chart;
}

void ladder_chart_area_lines_changed(LadderChartArea *area)
{
	area->selected = MIN(area->selected, chart_lines(area->chart) - 1);
	gtk_widget_queue_resize(GTK_WIDGET(area));
	shown(area);
}

/* ---- the cursor ---- */

static void show_scan(LadderChartArea *area, guint64 scan)
{
	const struct chart *chart = area->chart;

	if (chart_first(chart) >= chart_end(chart))
		return;
	scan = CLAMP(scan, chart_first(chart), chart_end(chart) - 1);
	/* What is looked at stands still. */
	area->right_ns = chart_right(area);
	area->follows = false;
	if (!ladder_sim_show(area->sim, scan))
		g_signal_emit(area, signals[TOLD], 0, _("that scan is not kept any more"));
	const double x = ladder_chart_area_x(area, scan);

	if (x < CHART_NAMES || x > CHART_NAMES + chart_plot_width(area))
		see(area, (double)chart_time(chart, scan) + area->span_ns / 2);
}

static void show_now(LadderChartArea *area)
{
	area->follows = true;
	ladder_sim_show_now(area->sim);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void show_at(LadderChartArea *area, double x)
{
	const double ns = ns_at(area, x);

	show_scan(area, chart_scan_at(area->chart, (gint64)MAX(ns, 0)));
}

/* ---- pointer ---- */

static int line_at(LadderChartArea *area, double y)
{
	const int line = (int)(y / CHART_ROW);

	return y >= 0 && line < chart_lines(area->chart) ? line : -1;
}

static void drag_begin(GtkGestureDrag *drag, double x, double y, LadderChartArea *area)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(drag));

	gtk_widget_grab_focus(GTK_WIDGET(area));
	area->drag_x = x;
	area->selected = line_at(area, y);
	if (x >= CHART_NAMES && (state & GDK_SHIFT_MASK))
		area->mark_ns = (gint64)MAX(ns_at(area, x), 0);
	else if (x >= CHART_NAMES)
		show_at(area, x);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void drag_update(GtkGestureDrag *drag, double dx, double dy, LadderChartArea *area)
{
	(void)drag;
	(void)dy;
	if (area->drag_x >= CHART_NAMES)
		show_at(area, MAX(area->drag_x + dx, CHART_NAMES));
}

static void pan_begin(GtkGestureDrag *drag, double x, double y, LadderChartArea *area)
{
	(void)drag;
	(void)x;
	(void)y;
	area->pan_ns = chart_right(area);
}

static void pan_update(GtkGestureDrag *drag, double dx, double dy, LadderChartArea *area)
{
	(void)drag;
	(void)dy;
	see(area, area->pan_ns - dx * area->span_ns / MAX(chart_plot_width(area), 1));
}

static gboolean scroll(GtkEventControllerScroll *scroll, double dx, double dy,
		       LadderChartArea *area)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(scroll));

	if (state & GDK_CONTROL_MASK)
		ladder_chart_area_zoom(area, dy < 0 ? 1.25 : 0.8);
	else if (dx != 0 || (state & GDK_SHIFT_MASK))
		see(area, chart_right(area) + (dx != 0 ? dx : dy) * area->span_ns / 20);
	else
		return GDK_EVENT_PROPAGATE;
	return GDK_EVENT_STOP;
}

/* ---- lines ---- */

static void move_line(LadderChartArea *area, int by)
{
	const int to = area->selected + by;

	if (area->selected < 0 || to < 0 || to >= chart_lines(area->chart))
		return;
	chart_move(area->chart, area->selected, to);
	area->selected = to;
	ladder_chart_area_lines_changed(area);
	g_signal_emit(area, signals[LINES_CHANGED], 0);
}

static void remove_line(LadderChartArea *area)
{
	if (area->selected < 0)
		return;
	chart_remove(area->chart, area->selected);
	ladder_chart_area_lines_changed(area);
	g_signal_emit(area, signals[LINES_CHANGED], 0);
}

static void do_line(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderChartArea *area = LADDER_CHART_AREA(widget);

	(void)unused;
	if (g_str_equal(name, "line.remove"))
		remove_line(area);
	else
		move_line(area, g_str_equal(name, "line.up") ? -1 : 1);
}

static void open_menu(GtkGestureClick *click, int count, double x, double y,
		      LadderChartArea *area)
{
	GMenu *menu;

	(void)click;
	(void)count;
	area->selected = line_at(area, y);
	gtk_widget_queue_draw(GTK_WIDGET(area));
	if (area->selected < 0)
		return;
	menu = g_menu_new();
	g_menu_append(menu, _("Move up"), "line.up");
	g_menu_append(menu, _("Move down"), "line.down");
	g_menu_append(menu, _("Remove"), "line.remove");
	popover_menu(GTK_WIDGET(area), menu, &(GdkRectangle){ (int)x, (int)y, 1, 1 },
		     GTK_WIDGET(area));
}

/* ---- keys ---- */

static void step(LadderChartArea *area, gint64 by)
{
	const struct twin *twin = ladder_sim_twin(area->sim);

	if (twin)
		show_scan(area, by < 0 && twin->scan < (guint64)-by ? 0 :
			  twin->scan + (guint64)by);
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderChartArea *area)
{
	const gint64 far = state & GDK_CONTROL_MASK ? 100 : state & GDK_SHIFT_MASK ? 10 : 1;

	(void)keys;
	(void)code;
	if (state & GDK_ALT_MASK)
		return GDK_EVENT_PROPAGATE;
	switch (key) {
	case GDK_KEY_Left: step(area, -far); break;
	case GDK_KEY_Right: step(area, far); break;
	case GDK_KEY_Home: show_scan(area, 0); break;
	case GDK_KEY_End: case GDK_KEY_Escape: show_now(area); break;
	case GDK_KEY_Up: area->selected = MAX(area->selected - 1, 0); break;
	case GDK_KEY_Down:
		area->selected = MIN(area->selected + 1, chart_lines(area->chart) - 1);
		break;
	case GDK_KEY_plus: case GDK_KEY_KP_Add: ladder_chart_area_zoom(area, 1.25); break;
	case GDK_KEY_minus: case GDK_KEY_KP_Subtract:
		ladder_chart_area_zoom(area, 0.8);
		break;
	case GDK_KEY_Delete: remove_line(area); break;
	default: return GDK_EVENT_PROPAGATE;
	}
	gtk_widget_queue_draw(GTK_WIDGET(area));
	return GDK_EVENT_STOP;
}

/* ---- the widget ---- */

static void area_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
			 int *minimum, int *natural, int *baseline, int *natural_baseline)
{
	(void)for_size;
	*minimum = *natural = orientation == GTK_ORIENTATION_HORIZONTAL ? CHART_NAMES + 100 :
		CHART_ROW * MAX(chart_lines(LADDER_CHART_AREA(widget)->chart), 1) +
		CHART_RULER;
	*baseline = *natural_baseline = -1;
}

static void area_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	chart_draw(LADDER_CHART_AREA(widget), snapshot);
}

/* The ruler stays in sight. */
static void watch_scrolling(LadderChartArea *area)
{
	GtkWidget *scroller = gtk_widget_get_ancestor(GTK_WIDGET(area),
						      GTK_TYPE_SCROLLED_WINDOW);

	if (!scroller || area->scrolled)
		return;
	area->scrolled = g_object_ref(gtk_scrolled_window_get_vadjustment(
		GTK_SCROLLED_WINDOW(scroller)));
	g_signal_connect_object(area->scrolled, "value-changed",
				G_CALLBACK(gtk_widget_queue_draw), area, G_CONNECT_SWAPPED);
}

static void area_map(GtkWidget *widget)
{
	GTK_WIDGET_CLASS(ladder_chart_area_parent_class)->map(widget);
	watch_scrolling(LADDER_CHART_AREA(widget));
	shown(LADDER_CHART_AREA(widget));
}

static void ladder_chart_area_dispose(GObject *object)
{
	LadderChartArea *area = LADDER_CHART_AREA(object);

	g_clear_handle_id(&area->idle, g_source_remove);
	g_clear_pointer(&area->chart, chart_free);
	g_clear_pointer(&area->lettering, lettering_free);
	g_clear_object(&area->scrolled);
	g_clear_object(&area->sim);
	G_OBJECT_CLASS(ladder_chart_area_parent_class)->dispose(object);
}

static void ladder_chart_area_class_init(LadderChartAreaClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
	const GType type = G_TYPE_FROM_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_chart_area_dispose;
	widget->measure = area_measure;
	widget->snapshot = area_snapshot;
	widget->map = area_map;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_SLIDER);
	gtk_widget_class_install_action(widget, "line.up", NULL, do_line);
	gtk_widget_class_install_action(widget, "line.down", NULL, do_line);
	gtk_widget_class_install_action(widget, "line.remove", NULL, do_line);
	signals[LINES_CHANGED] = g_signal_new("lines-changed", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void add_drag(LadderChartArea *area, guint button, GCallback begin, GCallback update)
{
	GtkGesture *drag = gtk_gesture_drag_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), button);
	g_signal_connect(drag, "drag-begin", begin, area);
	g_signal_connect(drag, "drag-update", update, area);
	gtk_widget_add_controller(GTK_WIDGET(area), GTK_EVENT_CONTROLLER(drag));
}

static void add_menu(LadderChartArea *area)
{
	GtkGesture *click = gtk_gesture_click_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	g_signal_connect(click, "pressed", G_CALLBACK(open_menu), area);
	gtk_widget_add_controller(GTK_WIDGET(area), GTK_EVENT_CONTROLLER(click));
}

static void ladder_chart_area_init(LadderChartArea *area)
{
	GtkEventController *wheel = gtk_event_controller_scroll_new(
		GTK_EVENT_CONTROLLER_SCROLL_BOTH_AXES);
	GtkEventController *keys = gtk_event_controller_key_new();

	area->span_ns = SPAN_FIRST;
	area->follows = true;
	area->selected = -1;
	area->mark_ns = -1;
	area->lettering = lettering_new(gtk_widget_get_pango_context(GTK_WIDGET(area)), NULL);
	gtk_widget_set_focusable(GTK_WIDGET(area), TRUE);
	gtk_accessible_update_property(GTK_ACCESSIBLE(area),
		GTK_ACCESSIBLE_PROPERTY_LABEL, _("Timing chart, cursor"), -1);
	add_drag(area, GDK_BUTTON_PRIMARY, G_CALLBACK(drag_begin), G_CALLBACK(drag_update));
	add_drag(area, GDK_BUTTON_MIDDLE, G_CALLBACK(pan_begin), G_CALLBACK(pan_update));
	add_menu(area);
	g_signal_connect(wheel, "scroll", G_CALLBACK(scroll), area);
	gtk_widget_add_controller(GTK_WIDGET(area), wheel);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), area);
	gtk_widget_add_controller(GTK_WIDGET(area), keys);
}

GtkWidget *ladder_chart_area_new(LadderSim *sim)
{
	LadderChartArea *area = g_object_new(LADDER_TYPE_CHART_AREA, NULL);

	area->sim = g_object_ref(sim);
	area->chart = chart_new(sim);
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), area, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(program_changed), area,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(gtk_widget_queue_draw), area, G_CONNECT_SWAPPED);
	return GTK_WIDGET(area);
}
