/* SPDX-License-Identifier: MIT
 *
 * slow_bar - scroll bars that follow what is scrolled a moment later.
 *
 * To move the slider of a bar GTK 4.8 lays out the window, and for that asks the X server
 * where the screens are, and waits for it: a fourth of the time of a frame. A person does
 * not see whether the slider is there 16 or 100 ms later, nor that it is a pixel off: for
 * less it does not follow. A slider that is dragged keeps up.
 *
 * The bars stand beside what is scrolled: one that fades in above it has a second of frames
 * drawn up to the edge of the window, through a clip of four rectangles.
 */
#ifndef EDITOR_SLOW_BAR_H
#define EDITOR_SLOW_BAR_H

#include <gtk/gtk.h>

/** slow_bar_make - of both bars of @scroller, as long as it lives. */
void slow_bar_make(GtkScrolledWindow *scroller);

#endif
