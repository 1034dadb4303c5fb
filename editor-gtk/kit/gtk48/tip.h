/* SPDX-License-Identifier: MIT
 *
 * tip - tooltips with lines of a good width.
 *
 * Mends in GTK 4.8.3:
 * - A tooltip is as wide as its text has characters, each taken for a Latin one, and a text
 *   with more than one line is not wrapped. A Chinese name of three characters stands in three
 *   lines, a long comment runs off the screen. To see it: remove tip_init(). Test:
 *   tests/editor/kit/gtk48/test_tip.c.
 * - gtk_widget_set_tooltip_text() waits each time for the X server to say where the pointer
 *   is; a list would wait for every cell. tip_set() asks only for the widget below the
 *   pointer. To see it: use GTK's function in a list and compare `make bench-editor`.
 * Try without both on each new floor.
 *
 * A handler of "query-tooltip" calls tip_show(); tip_init() takes care of all other tooltips.
 */
#ifndef EDITOR_TIP_H
#define EDITOR_TIP_H

#include <gtk/gtk.h>

/**
 * tip_text - a text as a tooltip needs it
 *
 * Lines are broken at about 60 columns; a Chinese character has two. A text of one line gets
 * invisible characters, so that it has as many characters as columns. Caller frees.
 */
char *tip_text(const char *text);

/** tip_show - returns what a handler of "query-tooltip" returns; @text NULL: no tooltip. */
gboolean tip_show(GtkTooltip *tooltip, const char *text);

/** tip_set - sets tooltip and accessible description of a widget; NULL or "": none, or the
 * one of its .ui file. */
void tip_set(GtkWidget *widget, const char *text);

/** tip_init - call before the first widget is made: all tooltips of classes that are not in
 * use yet get such lines. */
void tip_init(void);

#endif
