/* SPDX-License-Identifier: MIT
 *
 * slow_bar - blocks the handler of a scroll bar at "value-changed" of its adjustment, and
 * lets the bar follow by a timer; see slow_bar.h.
 */
#include "editor-gtk/kit/gtk48/slow_bar.h"

#include <math.h>

#define FOLLOW_MS 100

struct slow_bar {
	GtkAdjustment *adjustment; /* holds a reference                       */
	GtkWidget *scrollbar;      /* its adjustment                          */
	gboolean level;
	double value;              /* the value that the slider shows         */
	guint timer;
};

/* Is the slider a pixel or more off? In a long sheet one wheel step moves it less. */
static gboolean is_behind(const struct slow_bar *bar)
{
	GtkAdjustment *of = bar->adjustment;
	const double way = gtk_adjustment_get_upper(of) - gtk_adjustment_get_lower(of);
	const int length = bar->level ? gtk_widget_get_width(bar->scrollbar) :
					gtk_widget_get_height(bar->scrollbar);

	return fabs(gtk_adjustment_get_value(of) - bar->value) * length >= way;
}

static gboolean follow(gpointer data)
{
	struct slow_bar *bar = data;

	bar->timer = 0;
	g_signal_emit_by_name(bar->adjustment, "changed");
	return G_SOURCE_REMOVE;
}

/* GTK laid out the slider: by follow(), or because the scrolled widget changed its size. */
static void followed(struct slow_bar *bar)
{
	bar->value = gtk_adjustment_get_value(bar->adjustment);
}

static void moved(struct slow_bar *bar)
{
	if (!bar->timer && is_behind(bar))
		bar->timer = g_timeout_add(FOLLOW_MS, follow, bar);
}

/* The user drags the slider, or presses beside it. */
static gboolean by_hand(struct slow_bar *bar)
{
	g_clear_handle_id(&bar->timer, g_source_remove);
	bar->timer = g_idle_add_full(G_PRIORITY_HIGH_IDLE, follow, bar, NULL);
	return GDK_EVENT_PROPAGATE;
}

static void bar_free(gpointer data)
{
	struct slow_bar *bar = data;

	g_clear_handle_id(&bar->timer, g_source_remove);
	g_signal_handlers_disconnect_by_data(bar->adjustment, bar);
	g_object_unref(bar->adjustment);
	g_free(bar);
}

static void make(GtkScrollbar *scrollbar)
{
	GtkWidget *range = gtk_widget_get_first_child(GTK_WIDGET(scrollbar));
	struct slow_bar *bar = g_new0(struct slow_bar, 1);

	bar->adjustment = g_object_ref(gtk_scrollbar_get_adjustment(scrollbar));
	bar->scrollbar = GTK_WIDGET(scrollbar);
	bar->level = gtk_orientable_get_orientation(GTK_ORIENTABLE(scrollbar)) ==
		     GTK_ORIENTATION_HORIZONTAL;
	followed(bar);
	g_signal_handlers_block_matched(bar->adjustment,
		G_SIGNAL_MATCH_ID | G_SIGNAL_MATCH_DATA,
		g_signal_lookup("value-changed", GTK_TYPE_ADJUSTMENT), 0, NULL, NULL, range);
	g_object_set_data_full(G_OBJECT(scrollbar), "slow-bar", bar, bar_free);
	g_signal_connect_data(bar->adjustment, "value-changed", G_CALLBACK(moved), bar,
			      NULL, G_CONNECT_SWAPPED);
	g_signal_connect_data(bar->adjustment, "changed", G_CALLBACK(followed), bar, NULL,
			      G_CONNECT_SWAPPED);
	g_signal_connect_swapped(range, "change-value", G_CALLBACK(by_hand), bar);
}

/* ---- bars that change while the window is laid out or drawn ---- */

/* Is the window of @widget in this phase of a frame, "layout" or "paint"? */
static gboolean is_in(GtkWidget *widget, const char *phase)
{
	GdkFrameClock *clock = gtk_widget_get_frame_clock(widget);
	const GSignalInvocationHint *hint = clock ? g_signal_get_invocation_hint(clock) : NULL;

	return hint && hint->signal_id == g_signal_lookup(phase, GDK_TYPE_FRAME_CLOCK);
}

/* What GtkRange does when its adjustment has changed. */
static void lay_out_slider(GtkWidget *range)
{
	GtkAdjustment *of = gtk_range_get_adjustment(GTK_RANGE(range));

	gtk_widget_queue_allocate(gtk_widget_get_first_child(range));
	gtk_accessible_update_property(GTK_ACCESSIBLE(range),
		GTK_ACCESSIBLE_PROPERTY_VALUE_MAX, gtk_adjustment_get_upper(of),
		GTK_ACCESSIBLE_PROPERTY_VALUE_MIN, gtk_adjustment_get_lower(of),
		GTK_ACCESSIBLE_PROPERTY_VALUE_NOW, gtk_adjustment_get_value(of), -1);
}

static gboolean lay_out_later(gpointer range)
{
	g_object_set_data(range, "slider-due", NULL);
	lay_out_slider(range);
	return G_SOURCE_REMOVE;
}

static void range_changed(GtkWidget *range)
{
	if (!is_in(range, "layout") && !is_in(range, "paint")) {
		lay_out_slider(range);
		return;
	}
	if (g_object_get_data(G_OBJECT(range), "slider-due"))
		return;
	g_object_set_data(G_OBJECT(range), "slider-due", range);
	g_idle_add_full(G_PRIORITY_HIGH_IDLE, lay_out_later, g_object_ref(range), g_object_unref);
}

static void take_over(GtkWidget *range, const char *name)
{
	GtkAdjustment *of = gtk_range_get_adjustment(GTK_RANGE(range));

	g_signal_handlers_block_matched(of, G_SIGNAL_MATCH_ID | G_SIGNAL_MATCH_DATA,
		g_signal_lookup(name, GTK_TYPE_ADJUSTMENT), 0, NULL, NULL, range);
	g_signal_connect_object(of, name, G_CALLBACK(range_changed), range, G_CONNECT_SWAPPED);
}

/* Once for each bar. A slow one does not hear of values. */
static void wait_for_drawing(GtkWidget *scrollbar)
{
	GtkWidget *range = gtk_widget_get_first_child(scrollbar);

	if (g_object_get_data(G_OBJECT(range), "slider-waits"))
		return;
	g_object_set_data(G_OBJECT(range), "slider-waits", range);
	take_over(range, "changed");
	if (!g_object_get_data(G_OBJECT(scrollbar), "slow-bar"))
		take_over(range, "value-changed");
}

/* ---- texts that change while the window is laid out ---- */

static void text_scrolled(GtkWidget *scroller)
{
	if (is_in(scroller, "layout"))
		g_object_set_data(G_OBJECT(scroller), "text-due", scroller);
}

/* Called behind GTK in each layout, which is done again before the window is drawn. */
static void laid_out(GtkWidget *scroller)
{
	if (g_object_steal_data(G_OBJECT(scroller), "text-due"))
		gtk_widget_queue_resize(scroller);
}

static void follow_axis(GtkWidget *scroller, GtkAdjustment *of)
{
	g_signal_connect_object(of, "changed", G_CALLBACK(text_scrolled), scroller, G_CONNECT_SWAPPED);
	g_signal_connect_object(of, "value-changed", G_CALLBACK(text_scrolled), scroller,
				G_CONNECT_SWAPPED);
}

/* A scroller may be shown in another window later. */
static void lay_out_again(GtkScrolledWindow *scroller)
{
	GdkFrameClock *clock = gtk_widget_get_frame_clock(GTK_WIDGET(scroller));
	GdkFrameClock *was = g_object_get_data(G_OBJECT(scroller), "text-clock");

	if (!GTK_IS_TEXT_VIEW(gtk_scrolled_window_get_child(scroller)) || clock == was)
		return;
	if (was) {
		g_signal_handlers_disconnect_by_func(was, laid_out, scroller);
	} else {
		follow_axis(GTK_WIDGET(scroller), gtk_scrolled_window_get_hadjustment(scroller));
		follow_axis(GTK_WIDGET(scroller), gtk_scrolled_window_get_vadjustment(scroller));
	}
	g_object_set_data_full(G_OBJECT(scroller), "text-clock", g_object_ref(clock), g_object_unref);
	g_signal_connect_object(clock, "layout", G_CALLBACK(laid_out), scroller, G_CONNECT_SWAPPED);
}

/* ---- which bars are shown ---- */

static GtkPolicyType policy_of(GtkAdjustment *along)
{
	return gtk_adjustment_get_upper(along) - gtk_adjustment_get_lower(along) >
	       gtk_adjustment_get_page_size(along) ? GTK_POLICY_ALWAYS : GTK_POLICY_EXTERNAL;
}

static GtkPolicyType chosen(GtkAdjustment *along, GtkPolicyType now)
{
	return along && g_object_get_data(G_OBJECT(along), "bar-chosen") ? policy_of(along) : now;
}

static gboolean choose_bars(gpointer data)
{
	GtkScrolledWindow *scroller = data;
	GtkPolicyType level, down;

	g_object_set_data(data, "bars-due", NULL);
	gtk_scrolled_window_get_policy(scroller, &level, &down);
	gtk_scrolled_window_set_policy(scroller,
		chosen(gtk_scrolled_window_get_hadjustment(scroller), level),
		chosen(gtk_scrolled_window_get_vadjustment(scroller), down));
	return G_SOURCE_REMOVE;
}

static void bars_changed(GtkScrolledWindow *scroller)
{
	if (g_object_get_data(G_OBJECT(scroller), "bars-due"))
		return;
	g_object_set_data(G_OBJECT(scroller), "bars-due", scroller);
	g_idle_add_full(G_PRIORITY_HIGH_IDLE, choose_bars, g_object_ref(scroller),
			g_object_unref);
}

/* Returns the policy to set now. */
static GtkPolicyType choose(GtkScrolledWindow *scroller, GtkAdjustment *along, GtkPolicyType policy)
{
	if (policy != GTK_POLICY_AUTOMATIC)
		return policy;
	g_object_set_data(G_OBJECT(along), "bar-chosen", along);
	g_signal_connect_object(along, "changed", G_CALLBACK(bars_changed), scroller,
				G_CONNECT_SWAPPED);
	return GTK_POLICY_EXTERNAL;
}

void slow_bar_choose(GtkScrolledWindow *scroller)
{
	GtkPolicyType level, down;

	gtk_scrolled_window_get_policy(scroller, &level, &down);
	level = choose(scroller, gtk_scrolled_window_get_hadjustment(scroller), level);
	down = choose(scroller, gtk_scrolled_window_get_vadjustment(scroller), down);
	gtk_scrolled_window_set_policy(scroller, level, down);
	bars_changed(scroller);
}

/* A popup is laid out on its own. */
static gboolean widget_mapped(GSignalInvocationHint *hint, guint count, const GValue *values, gpointer data)
{
	GtkWidget *widget = g_value_get_object(&values[0]);

	(void)hint;
	(void)count;
	(void)data;
	if (GTK_IS_SCROLLED_WINDOW(widget)) {
		wait_for_drawing(gtk_scrolled_window_get_hscrollbar(GTK_SCROLLED_WINDOW(widget)));
		wait_for_drawing(gtk_scrolled_window_get_vscrollbar(GTK_SCROLLED_WINDOW(widget)));
		lay_out_again(GTK_SCROLLED_WINDOW(widget));
	}
	if (GTK_IS_SCROLLED_WINDOW(widget) && !GTK_IS_POPOVER(gtk_widget_get_native(widget)))
		slow_bar_choose(GTK_SCROLLED_WINDOW(widget));
	return TRUE;
}

void slow_bar_choose_all(void)
{
	g_type_class_unref(g_type_class_ref(GTK_TYPE_WIDGET)); /* makes its signals */
	g_signal_add_emission_hook(g_signal_lookup("map", GTK_TYPE_WIDGET), 0, widget_mapped, NULL, NULL);
}

void slow_bar_make(GtkScrolledWindow *scroller)
{
	slow_bar_choose(scroller);
	gtk_scrolled_window_set_overlay_scrolling(scroller, FALSE);
	make(GTK_SCROLLBAR(gtk_scrolled_window_get_hscrollbar(scroller)));
	make(GTK_SCROLLBAR(gtk_scrolled_window_get_vscrollbar(scroller)));
}
