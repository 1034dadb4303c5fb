/* SPDX-License-Identifier: MIT
 *
 * log_view - what happened to a document, with the time of day.
 *
 * Messages of system, compile, operator, simulation and communication (with what runs on
 * this machine) in one list; it keeps the last thousand.
 */
#ifndef EDITOR_LOG_VIEW_H
#define EDITOR_LOG_VIEW_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

GtkWidget *ladder_log_view_new(LadderDocument *document);
/** ladder_log_view_put - a line with the time. @kind: "system", "operator" …, translated. */
void ladder_log_view_put(GtkWidget *view, const char *kind, const char *what);

#endif
