/* SPDX-License-Identifier: MIT
 *
 * focus - keys go somewhere at any time.
 */
#ifndef EDITOR_FOCUS_H
#define EDITOR_FOCUS_H

#include <gtk/gtk.h>

/**
 * focus_mend - after widgets inside @list were replaced
 *
 * The toolkit leaves the focus at a widget that has left the window until it lays out the
 * next frame, and a key that comes meanwhile is lost, Ctrl+S as well. Here the window has
 * it meanwhile. Owns: nothing. Fails: no.
 */
void focus_mend(GtkWidget *list);
#endif
