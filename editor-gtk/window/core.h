/* SPDX-License-Identifier: MIT
 *
 * core - what the parts of one window share: document, simulation, and the lower parts.
 *
 * A part calls the parts below it. To parts above it, it emits a signal of @window or
 * activates one of its actions ("win.save"); window.h lists the signals.
 */
#ifndef EDITOR_CORE_H
#define EDITOR_CORE_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/online/board_values.h"
#include "editor-gtk/sim/board_run.h"
#include "editor-gtk/sim/sim.h"

#include <adwaita.h>

struct core {
	GtkWindow *window;
	LadderDocument *document;  /* NULL: the window is closing                 */
	LadderSim *sim;            /* off while editing                           */
	LadderBoardRun *board;     /* the program on this machine                 */
	LadderBoardLink *link;     /* to the connected board                      */
	LadderBoardValues *values; /* of it, shown by the simulation              */
	GtkPageSetup *paper;       /* of prints and their preview                 */
	GtkWidget *tree;
	unsigned with;             /* the facts that hold, WITH_… of verbs.h; by core_with() */
	struct messages *messages;
	struct below *below;
	struct front *front;
	struct tabs *tabs;
};

/** core_connect - connects @handler with @part as its data; disconnected when the window is
 * freed. */
static inline void core_connect(struct core *core, gpointer instance, const char *signal,
				GCallback handler, gpointer part, GConnectFlags flags)
{
	GClosure *closure = flags & G_CONNECT_SWAPPED ?
		g_cclosure_new_swap(handler, part, NULL) : g_cclosure_new(handler, part, NULL);

	g_object_watch_closure(G_OBJECT(core->window), closure);
	g_signal_connect_closure(instance, signal, closure, (flags & G_CONNECT_AFTER) != 0);
}

/** core_on_press - calls @handler(@part) when a button is pressed on @widget, before its
 * children act. */
static inline void core_on_press(GtkWidget *widget, GCallback handler, gpointer part)
{
	GtkGesture *click = gtk_gesture_click_new();

	gtk_event_controller_set_propagation_phase(GTK_EVENT_CONTROLLER(click),
						   GTK_PHASE_CAPTURE);
	g_signal_connect_swapped(click, "pressed", handler, part);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(click));
}

/** core_do - activates an action of the window, such as "win.save". */
static inline void core_do(struct core *core, const char *action)
{
	gtk_widget_activate_action(GTK_WIDGET(core->window), action, NULL);
}

/** core_with - tells whether facts, bits WITH_… of verbs.h, hold now; the commands that need them
 * become sensitive or insensitive. Emits "facts-changed" of the window, with all that hold. */
static inline void core_with(struct core *core, unsigned facts, bool hold)
{
	const unsigned changed = facts & (hold ? ~core->with : core->with);

	core->with ^= changed;
	for (int i = 0; changed && i < VERB_COUNT; i++)
		if (verb_needs((enum verb)i) & changed)
			gtk_widget_action_set_enabled(GTK_WIDGET(core->window),
				verb_row((enum verb)i)->action,
				!verb_why_not((enum verb)i, core->with));
	if (changed)
		g_signal_emit_by_name(core->window, "facts-changed", core->with);
}

/** core_is_own - is the connected board the program that this editor runs on this machine? */
static inline bool core_is_own(const struct core *core)
{
	const char *own = ladder_board_run_where(core->board);

	return own && g_strcmp0(own, ladder_board_link_where(core->link)) == 0;
}

#endif
