/* SPDX-License-Identifier: MIT
 *
 * editor_ground - a window in which nothing is drawn but a ground, another colour in each
 * frame: what the toolkit takes for so many pixels, whatever stands on them. Only
 * tests/bench/editor.c includes it.
 */
#ifndef BENCH_EDITOR_GROUND_H
#define BENCH_EDITOR_GROUND_H

#include <gtk/gtk.h>

/** ground_window - of @width x @height px, shown. Owns: the toolkit; gtk_window_destroy. */
GtkWidget *ground_window(int width, int height);
/** ground_change - it is to be drawn anew. */
void ground_change(GtkWidget *window);

#endif
