/* SPDX-License-Identifier: MIT
 *
 * welcome - what an editor without a file shows: begin anew, go on, look at a sample.
 *
 * A sample is opened as a copy that has no file yet, so that nobody spoils it.
 */
#ifndef EDITOR_WELCOME_H
#define EDITOR_WELCOME_H

#include <gtk/gtk.h>

/** welcome_new - its rows activate win.begin, win.begin-chart, win.open, win.import-project,
 * win.open-path and win.open-sample. */
GtkWidget *welcome_new(void);

#endif
