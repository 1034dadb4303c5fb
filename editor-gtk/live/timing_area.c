/* SPDX-License-Identifier: MIT
 *
 * timing_area - a timing chart that can be used: cursor, zoom, pan, lines.
 */
#include "editor-gtk/live/timing_inside.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/popover.h"

#include <adwaita.h>

#define SPAN_LEAST 1e6    /* ns                                                  */
#define SPAN_MOST  4e12
#define SPAN_FIRST 1e10
#define FEED_US    2000   /* a frame may take so long to bring in new scans      */

enum { LINES_CHANGED, TOLD, SIGNAL_COUNT };
static guint signals[SIGNAL_COUNT];

G_DEFINE_FINAL_TYPE(LadderTimingArea, ladder_timing_area, GTK_TYPE_WIDGET)

/* ---- time and place ---- */

static double newest(LadderTimingArea *area)
{
	const struct timing *timing = area->timing;

	return timing_first(timing) < timing_end(timing) ?
	       (double)timing_time(timing, timing_end(timing) - 1) : 0;
}

double timing_right(LadderTimingArea *area)
{
	return area->follows ? MAX(newest(area), area->span_ns) : area->right_ns;
}

double timing_plot_width(LadderTimingArea *area)
{
	return MAX(gtk_widget_get_width(GTK_WIDGET(area)) - TIMING_NAMES, 0);
}

double timing_x(LadderTimingArea *area, double ns)
{
	return TIMING_NAMES + timing_plot_width(area) -
	       (timing_right(area) - ns) / area->span_ns * timing_plot_width(area);
}

double timing_visible_top(LadderTimingArea *area)
{
	return area->scrolled ? gtk_adjustment_get_value(area->scrolled) : 0;
}

double timing_visible_bottom(LadderTimingArea *area)
{
	const double height = gtk_widget_get_height(GTK_WIDGET(area));

	return area->scrolled ? MIN(height, timing_visible_top(area) +
				    gtk_adjustment_get_page_size(area->scrolled)) : height;
}

static double ns_at(LadderTimingArea *area, double x)
{
	return timing_right(area) - (TIMING_NAMES + timing_plot_width(area) - x) *
	       area->span_ns / MAX(timing_plot_width(area), 1);
}

double ladder_timing_area_x(LadderTimingArea *area, guint64 scan)
{
	return timing_x(area, (double)timing_time(area->timing, scan));
}

static void see(LadderTimingArea *area, double right_ns)
{
	const double most = newest(area), least = area->span_ns;

	area->follows = right_ns >= most;
	area->right_ns = CLAMP(right_ns, MIN(least, most), MAX(most, least));
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void zoom_at(LadderTimingArea *area, double factor, double x)
{
	const double ns = ns_at(area, x);
	const double part = (x - TIMING_NAMES) / MAX(timing_plot_width(area), 1);

	area->span_ns = CLAMP(area->span_ns / factor, SPAN_LEAST, SPAN_MOST);
	if (!area->follows)
		see(area, ns + (1 - part) * area->span_ns);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

void ladder_timing_area_zoom(LadderTimingArea *area, double factor)
{
	zoom_at(area, factor, TIMING_NAMES + timing_plot_width(area) / 2);
}

void ladder_timing_area_fit(LadderTimingArea *area)
{
	const struct timing *timing = area->timing;

	if (timing_first(timing) < timing_end(timing))
		area->span_ns = CLAMP(newest(area) -
			(double)timing_time(timing, timing_first(timing)), SPAN_LEAST, SPAN_MOST);
	area->follows = true;
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

/* ---- the record ---- */

static gboolean fill_idle(gpointer data)
{
	LadderTimingArea *area = data;
	const bool more = timing_feed(area->timing, FEED_US);

	gtk_widget_queue_draw(GTK_WIDGET(area));
	if (more)
		return G_SOURCE_CONTINUE;
	area->idle = 0;
	return G_SOURCE_REMOVE;
}

static void tell_cursor(LadderTimingArea *area)
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

static void shown(LadderTimingArea *area)
{
	const guint64 end = timing_end(area->timing);

	if (!gtk_widget_get_mapped(GTK_WIDGET(area)))
		return;
	if (!area->idle && timing_feed(area->timing, FEED_US))
		area->idle = g_idle_add(fill_idle, area);
	if (ladder_sim_is_past(area->sim))
		tell_cursor(area);
	if (end != timing_end(area->timing) || ladder_sim_state(area->sim) != SIM_RUN)
		gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void program_changed(LadderTimingArea *area)
{
	const guint64 life = ladder_sim_life(area->sim);

	timing_program_changed(area->timing);
	if (area->life != life) {
		area->mark_ns = -1;
		area->follows = true;
	}
	area->life = life;
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

struct timing *ladder_timing_area_timing(LadderTimingArea *area)
{
	return area->timing;
}

void ladder_timing_area_lines_changed(LadderTimingArea *area)
{
	area->selected = MIN(area->selected, timing_lines(area->timing) - 1);
	gtk_widget_queue_resize(GTK_WIDGET(area));
	shown(area);
}

/* ---- the cursor ---- */

static void show_scan(LadderTimingArea *area, guint64 scan)
{
	const struct timing *timing = area->timing;

	if (timing_first(timing) >= timing_end(timing))
		return;
	scan = CLAMP(scan, timing_first(timing), timing_end(timing) - 1);
	/* What is looked at stands still. */
	area->right_ns = timing_right(area);
	area->follows = false;
	if (!ladder_sim_show(area->sim, scan))
		g_signal_emit(area, signals[TOLD], 0, _("that scan is not kept any more"));
	const double x = ladder_timing_area_x(area, scan);

	if (x < TIMING_NAMES || x > TIMING_NAMES + timing_plot_width(area))
		see(area, (double)timing_time(timing, scan) + area->span_ns / 2);
}

static void show_now(LadderTimingArea *area)
{
	area->follows = true;
	ladder_sim_show_now(area->sim);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void show_at(LadderTimingArea *area, double x)
{
	const double ns = ns_at(area, x);

	show_scan(area, timing_scan_at(area->timing, (gint64)MAX(ns, 0)));
}

/* ---- pointer ---- */

static int line_at(LadderTimingArea *area, double y)
{
	const int line = (int)(y / TIMING_ROW);

	return y >= 0 && line < timing_lines(area->timing) ? line : -1;
}

static void drag_begin(GtkGestureDrag *drag, double x, double y, LadderTimingArea *area)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(drag));

	gtk_widget_grab_focus(GTK_WIDGET(area));
	area->drag_x = x;
	area->selected = line_at(area, y);
	if (x >= TIMING_NAMES && (state & GDK_SHIFT_MASK))
		area->mark_ns = (gint64)MAX(ns_at(area, x), 0);
	else if (x >= TIMING_NAMES)
		show_at(area, x);
	gtk_widget_queue_draw(GTK_WIDGET(area));
}

static void drag_update(GtkGestureDrag *drag, double dx, double dy, LadderTimingArea *area)
{
	(void)drag;
	(void)dy;
	if (area->drag_x >= TIMING_NAMES)
		show_at(area, MAX(area->drag_x + dx, TIMING_NAMES));
}

static void pan_begin(GtkGestureDrag *drag, double x, double y, LadderTimingArea *area)
{
	(void)drag;
	(void)x;
	(void)y;
	area->pan_ns = timing_right(area);
}

static void pan_update(GtkGestureDrag *drag, double dx, double dy, LadderTimingArea *area)
{
	(void)drag;
	(void)dy;
	see(area, area->pan_ns - dx * area->span_ns / MAX(timing_plot_width(area), 1));
}

static gboolean scroll(GtkEventControllerScroll *scroll, double dx, double dy,
		       LadderTimingArea *area)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(scroll));

	if (state & GDK_CONTROL_MASK)
		ladder_timing_area_zoom(area, dy < 0 ? 1.25 : 0.8);
	else if (dx != 0 || (state & GDK_SHIFT_MASK))
		see(area, timing_right(area) + (dx != 0 ? dx : dy) * area->span_ns / 20);
	else
		return GDK_EVENT_PROPAGATE;
	return GDK_EVENT_STOP;
}

/* ---- lines ---- */

static void move_line(LadderTimingArea *area, int by)
{
	const int to = area->selected + by;

	if (area->selected < 0 || to < 0 || to >= timing_lines(area->timing))
		return;
	timing_move(area->timing, area->selected, to);
	area->selected = to;
	ladder_timing_area_lines_changed(area);
	g_signal_emit(area, signals[LINES_CHANGED], 0);
}

static void remove_line(LadderTimingArea *area)
{
	if (area->selected < 0)
		return;
	timing_remove(area->timing, area->selected);
	ladder_timing_area_lines_changed(area);
	g_signal_emit(area, signals[LINES_CHANGED], 0);
}

static void do_line(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderTimingArea *area = LADDER_TIMING_AREA(widget);

	(void)unused;
	if (g_str_equal(name, "line.remove"))
		remove_line(area);
	else
		move_line(area, g_str_equal(name, "line.up") ? -1 : 1);
}

static void open_menu(GtkGestureClick *click, int count, double x, double y,
		      LadderTimingArea *area)
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

static void step(LadderTimingArea *area, gint64 by)
{
	const struct twin *twin = ladder_sim_twin(area->sim);

	if (twin)
		show_scan(area, by < 0 && twin->scan < (guint64)-by ? 0 :
			  twin->scan + (guint64)by);
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
			    GdkModifierType state, LadderTimingArea *area)
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
		area->selected = MIN(area->selected + 1, timing_lines(area->timing) - 1);
		break;
	case GDK_KEY_plus: case GDK_KEY_KP_Add: ladder_timing_area_zoom(area, 1.25); break;
	case GDK_KEY_minus: case GDK_KEY_KP_Subtract:
		ladder_timing_area_zoom(area, 0.8);
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
	*minimum = *natural = orientation == GTK_ORIENTATION_HORIZONTAL ? TIMING_NAMES + 100 :
		TIMING_ROW * MAX(timing_lines(LADDER_TIMING_AREA(widget)->timing), 1) +
		TIMING_RULER;
	*baseline = *natural_baseline = -1;
}

static void area_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	timing_draw(LADDER_TIMING_AREA(widget), snapshot);
}

/* The ruler stays in sight. */
static void watch_scrolling(LadderTimingArea *area)
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
	GTK_WIDGET_CLASS(ladder_timing_area_parent_class)->map(widget);
	watch_scrolling(LADDER_TIMING_AREA(widget));
	shown(LADDER_TIMING_AREA(widget));
}

static void ladder_timing_area_dispose(GObject *object)
{
	LadderTimingArea *area = LADDER_TIMING_AREA(object);

	g_clear_handle_id(&area->idle, g_source_remove);
	g_clear_pointer(&area->timing, timing_free);
	g_clear_pointer(&area->lettering, lettering_free);
	g_clear_object(&area->scrolled);
	g_clear_object(&area->sim);
	G_OBJECT_CLASS(ladder_timing_area_parent_class)->dispose(object);
}

static void ladder_timing_area_class_init(LadderTimingAreaClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
	const GType type = G_TYPE_FROM_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_timing_area_dispose;
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

static void add_drag(LadderTimingArea *area, guint button, GCallback begin, GCallback update)
{
	GtkGesture *drag = gtk_gesture_drag_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), button);
	g_signal_connect(drag, "drag-begin", begin, area);
	g_signal_connect(drag, "drag-update", update, area);
	gtk_widget_add_controller(GTK_WIDGET(area), GTK_EVENT_CONTROLLER(drag));
}

static void add_menu(LadderTimingArea *area)
{
	GtkGesture *click = gtk_gesture_click_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	g_signal_connect(click, "pressed", G_CALLBACK(open_menu), area);
	gtk_widget_add_controller(GTK_WIDGET(area), GTK_EVENT_CONTROLLER(click));
}

static void ladder_timing_area_init(LadderTimingArea *area)
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

GtkWidget *ladder_timing_area_new(LadderSim *sim)
{
	LadderTimingArea *area = g_object_new(LADDER_TYPE_TIMING_AREA, NULL);

	area->sim = g_object_ref(sim);
	area->timing = timing_new(sim);
	g_signal_connect_object(sim, "shown", G_CALLBACK(shown), area, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(program_changed), area,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(gtk_widget_queue_draw), area, G_CONNECT_SWAPPED);
	return GTK_WIDGET(area);
}
