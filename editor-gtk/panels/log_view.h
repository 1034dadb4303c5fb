/* SPDX-License-Identifier: MIT
 *
 * log_view - the log of a document: messages with the time of day.
 *
 * Kinds are system, compile, operator, simulation, and communication with the program on
 * this machine. The last 1,000 messages are kept.
 */
#ifndef EDITOR_LOG_VIEW_H
#define EDITOR_LOG_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

GtkWidget *ladder_log_view_new(LadderDocument *document);
/** ladder_log_view_put - adds a message. @kind: "system", "operator" …, translated. */
void ladder_log_view_put(GtkWidget *view, const char *kind, const char *what);

#endif
