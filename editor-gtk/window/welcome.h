/* SPDX-License-Identifier: MIT
 *
 * welcome - the page of an editor without a file: begin a project, open one, open a sample.
 *
 * A sample opens as a copy without a file, so that it stays as it is.
 */
#ifndef EDITOR_WELCOME_H
#define EDITOR_WELCOME_H

#include <gtk/gtk.h>

/** welcome_new - its rows activate win.begin, win.begin-chart, win.begin-statements, win.begin-networks, win.open, win.import-project,
 * win.open-path and win.open-sample. */
GtkWidget *welcome_new(void);

#endif
