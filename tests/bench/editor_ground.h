/* SPDX-License-Identifier: MIT
 *
 * editor_ground - a window that draws only a background, in another colour each frame: the
 * share of the toolkit for so many pixels. Only tests/bench/editor.c includes it.
 */
#ifndef BENCH_EDITOR_GROUND_H
#define BENCH_EDITOR_GROUND_H

#include <gtk/gtk.h>

/** ground_window - shows a window of @width x @height px. Owns: the toolkit;
 * gtk_window_destroy(). */
GtkWidget *ground_window(int width, int height);
/** ground_change - changes the colour and queues a frame. */
void ground_change(GtkWidget *window);

#endif
