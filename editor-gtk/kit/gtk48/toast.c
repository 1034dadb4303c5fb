/* SPDX-License-Identifier: MIT
 *
 * toast - holds the end of a toast back until it has been shown; see toast.h.
 */
#include "editor-gtk/kit/gtk48/toast.h"

#define SHOWN_US 500000 /* the longest animation that shows a toast */

/* The toasts of an overlay. */
struct toasts {
	GtkWidget *overlay;
	guint count;       /* shown or waiting                                     */
	guint frames;      /* the callback for each frame while one comes; 0: none */
	gint64 since;      /* us; the first of these frames; 0: not drawn yet      */
	gboolean is_shown; /* its animation ended before this frame or in it       */
	AdwToast *held;    /* goes as soon as it has been shown; with a reference  */
};

static gboolean drawn(GtkWidget *overlay, GdkFrameClock *clock, gpointer data)
{
	struct toasts *toasts = data;
	const gint64 now = gdk_frame_clock_get_frame_time(clock);
	AdwToast *held;

	(void)overlay;
	if (!toasts->since)
		toasts->since = now;
	if (now - toasts->since < SHOWN_US)
		return G_SOURCE_CONTINUE;
	if (!toasts->is_shown) {
		toasts->is_shown = TRUE; /* the end of the animation may come after us in this frame */
		return G_SOURCE_CONTINUE;
	}
	toasts->frames = 0;
	held = g_steal_pointer(&toasts->held);
	if (held) /* not adw_toast_dismiss(): at the first time the toast forgot its overlay */
		g_signal_emit_by_name(held, "dismissed");
	g_clear_object(&held);
	return G_SOURCE_REMOVE;
}

/* A toast is shown from now on. */
static void begin(struct toasts *toasts)
{
	toasts->since = 0;
	toasts->is_shown = FALSE;
	if (!toasts->frames)
		toasts->frames = gtk_widget_add_tick_callback(toasts->overlay, drawn, toasts, NULL);
}

/* Comes before the handler of the overlay. */
static void dismissed(AdwToast *toast, struct toasts *toasts)
{
	if (gtk_widget_in_destruction(toasts->overlay))
		return;
	if (toasts->frames) {
		g_set_object(&toasts->held, toast);
		g_signal_stop_emission_by_name(toast, "dismissed");
		return;
	}
	g_signal_handlers_disconnect_by_data(toast, toasts);
	toasts->count--;
	if (toasts->count)
		begin(toasts);
}

static void toasts_free(gpointer data)
{
	struct toasts *toasts = data;

	g_clear_object(&toasts->held);
	g_free(toasts);
}

static struct toasts *toasts_of(AdwToastOverlay *overlay)
{
	struct toasts *toasts = g_object_get_data(G_OBJECT(overlay), "toasts");

	if (!toasts) {
		toasts = g_new(struct toasts, 1);
		*toasts = (struct toasts){ .overlay = GTK_WIDGET(overlay) };
		g_object_set_data_full(G_OBJECT(overlay), "toasts", toasts, toasts_free);
	}
	return toasts;
}

void toast_show(AdwToastOverlay *overlay, const char *text)
{
	struct toasts *toasts = toasts_of(overlay);
	AdwToast *toast = adw_toast_new(text);

	g_signal_connect(toast, "dismissed", G_CALLBACK(dismissed), toasts);
	toasts->count++;
	if (toasts->count == 1)
		begin(toasts);
	adw_toast_overlay_add_toast(overlay, toast);
}
