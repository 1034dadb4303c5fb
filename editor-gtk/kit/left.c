/* SPDX-License-Identifier: MIT
 *
 * left - a queue of work that waits until the focus has moved; see left.h.
 */
#include "editor-gtk/kit/left.h"

struct leave {
	gpointer (*note)(GtkWidget *widget, gpointer data);
	void (*then)(gpointer noted);
	GDestroyNotify gone;
	gpointer data;
};

struct due {
	void (*then)(gpointer noted);
	GDestroyNotify gone;
	gpointer noted;
};

static GQueue waiting = G_QUEUE_INIT; /* of struct due                          */
static guint idle;

void left_now(void)
{
	struct due *due;

	/* This may move the focus again. */
	while ((due = g_queue_pop_head(&waiting)) != NULL) {
		due->then(due->noted);
		due->gone(due->noted);
		g_free(due);
	}
	g_clear_handle_id(&idle, g_source_remove);
}

static gboolean now(gpointer unused)
{
	(void)unused;
	idle = 0;
	left_now();
	return G_SOURCE_REMOVE;
}

static void leaves(GtkEventControllerFocus *focus, struct leave *leave)
{
	gpointer noted = leave->note(gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(focus)),
				     leave->data);
	struct due *due;

	if (!noted)
		return;
	due = g_new(struct due, 1);
	*due = (struct due){ leave->then, leave->gone, noted };
	g_queue_push_tail(&waiting, due);
	if (!idle)
		idle = g_idle_add_full(G_PRIORITY_HIGH, now, NULL, NULL);
}

static void leave_free(gpointer leave, GClosure *closure)
{
	(void)closure;
	g_free(leave);
}

GtkEventController *left_connect(GtkWidget *widget, gpointer (*note)(GtkWidget *widget, gpointer data),
				 void (*then)(gpointer noted), GDestroyNotify gone, gpointer data)
{
	GtkEventController *focus = gtk_event_controller_focus_new();
	struct leave *leave = g_new(struct leave, 1);

	*leave = (struct leave){ note, then, gone, data };
	g_signal_connect_data(focus, "leave", G_CALLBACK(leaves), leave, leave_free, 0);
	gtk_widget_add_controller(widget, focus);
	return focus;
}
