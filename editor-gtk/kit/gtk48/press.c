/* SPDX-License-Identifier: MIT
 *
 * press - keeps a broken grab from the handler of GTK when the press has ended; see press.h.
 *
 * A hook hears of each event first. It blocks the handler of GTK for that one event; a handler behind
 * it unblocks it again.
 */
#include "editor-gtk/kit/gtk48/press.h"

#include <gtk/gtk.h>

#include <stdbool.h>

#define PRESSED "press-pressed"
#define BLOCKED "press-blocked"
#define KNOWN   "press-known"

static guint event_signal(void)
{
	return g_signal_lookup("event", GDK_TYPE_SURFACE);
}

/* GTK connects its handler with the widget of the surface as data. */
static gpointer widget_of(GdkSurface *surface)
{
	return gtk_native_get_for_surface(surface);
}

static bool is_pressed(GdkSurface *surface)
{
	return g_object_get_data(G_OBJECT(surface), PRESSED);
}

static void set_pressed(GdkSurface *surface, bool pressed)
{
	g_object_set_data(G_OBJECT(surface), PRESSED, pressed ? surface : NULL);
}

static gboolean after(GdkSurface *surface, GdkEvent *event, gpointer unused)
{
	gpointer widget = g_object_steal_data(G_OBJECT(surface), BLOCKED);

	(void)event;
	(void)unused;
	if (!widget)
		return FALSE;
	g_signal_handlers_unblock_matched(surface, G_SIGNAL_MATCH_ID | G_SIGNAL_MATCH_DATA,
					  event_signal(), 0, NULL, NULL, widget);
	return TRUE;
}

/* Once for each surface, behind GTK, which connects when it makes the surface. */
static void know(GdkSurface *surface)
{
	if (g_object_get_data(G_OBJECT(surface), KNOWN))
		return;
	g_object_set_data(G_OBJECT(surface), KNOWN, surface);
	g_signal_connect(surface, "event", G_CALLBACK(after), NULL);
}

/* GTK has counted too many presses for some; while no button is held, none is in one. A widget that
 * loses the mark takes it from those in it. */
static gboolean unmark(gpointer surface)
{
	GtkNative *native = gtk_native_get_for_surface(surface);
	GtkRoot *root = native ? gtk_widget_get_root(GTK_WIDGET(native)) : NULL;

	if (root && !is_pressed(surface))
		gtk_widget_unset_state_flags(GTK_WIDGET(root), GTK_STATE_FLAG_ACTIVE);
	return G_SOURCE_REMOVE;
}

/* A release tells the buttons before it. */
static bool is_last(GdkEvent *release)
{
	const GdkModifierType held = gdk_event_get_modifier_state(release) & (GDK_BUTTON1_MASK |
		GDK_BUTTON2_MASK | GDK_BUTTON3_MASK | GDK_BUTTON4_MASK | GDK_BUTTON5_MASK);

	return (held & (held - 1)) == 0;
}

static void ended(GdkSurface *surface)
{
	set_pressed(surface, false);
	g_idle_add_full(G_PRIORITY_HIGH, unmark, g_object_ref(surface), g_object_unref);
}

static void broken(GdkSurface *surface)
{
	gpointer widget = widget_of(surface);

	if (is_pressed(surface) || !widget)
		return;
	g_object_set_data(G_OBJECT(surface), BLOCKED, widget);
	g_signal_handlers_block_matched(surface, G_SIGNAL_MATCH_ID | G_SIGNAL_MATCH_DATA,
					event_signal(), 0, NULL, NULL, widget);
}

static gboolean event_comes(GSignalInvocationHint *hint, guint count, const GValue *values,
			    gpointer unused)
{
	GdkSurface *surface = g_value_get_object(&values[0]);
	GdkEvent *event = g_value_get_pointer(&values[1]);
	const GdkEventType type = gdk_event_get_event_type(event);

	(void)hint;
	(void)count;
	(void)unused;
	if (type == GDK_BUTTON_PRESS)
		set_pressed(surface, true);
	else if ((type == GDK_BUTTON_RELEASE && is_last(event)) ||
		 (type == GDK_LEAVE_NOTIFY && gdk_crossing_event_get_mode(event) == GDK_CROSSING_GRAB))
		ended(surface);
	else if (type == GDK_GRAB_BROKEN && gdk_grab_broken_event_get_implicit(event) &&
		 g_object_get_data(G_OBJECT(surface), KNOWN))
		broken(surface);
	know(surface);
	return TRUE; /* for the next one, too */
}

void press_init(void)
{
	g_type_class_unref(g_type_class_ref(GDK_TYPE_SURFACE)); /* makes its signals */
	g_signal_add_emission_hook(event_signal(), 0, event_comes, NULL, NULL);
}
