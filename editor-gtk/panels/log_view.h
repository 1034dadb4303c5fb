/* SPDX-License-Identifier: MIT
 *
 * log_view - the log of a document: messages of four kinds with the time of day, each kind
 * with a button that hides it.
 *
 * The last 1,000 messages are kept.
 */
#ifndef EDITOR_LOG_VIEW_H
#define EDITOR_LOG_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

enum log_kind {
	LOG_SYSTEM,        /* what programs did: editor, simulation, board     */
	LOG_COMPILE,       /* errors and warnings of the program               */
	LOG_OPERATOR,      /* what a person did, here or at the board          */
	LOG_COMMUNICATION, /* connections and what they refused                */
	LOG_KINDS
};

GtkWidget *ladder_log_view_new(LadderDocument *document);
/** ladder_log_view_put - adds a message. @us: when it happened, as g_get_real_time(); 0:
 * now. */
void ladder_log_view_put(GtkWidget *view, enum log_kind kind, gint64 us, const char *what);

#endif
