/* SPDX-License-Identifier: MIT
 *
 * tip - tooltips whose lines are as wide as what stands in them.
 *
 * GTK 4.8 makes a tooltip as wide as its text has characters, each taken for a Latin one,
 * and does not break a text that has more than one line. So a Chinese name of three
 * characters stood in three lines, and a long comment ran off the screen. Who shows a
 * tooltip of its own calls tip_show(); all others are found by tip_init(). It knows nothing
 * of what is told.
 */
#ifndef EDITOR_TIP_H
#define EDITOR_TIP_H

#include <gtk/gtk.h>

/**
 * tip_text - a text as a tooltip needs it to stand as it should.
 *
 * Lines are broken at about 60 columns, a Chinese character being two; a text of one line
 * gets characters that nobody sees, so that there are as many as it has columns. Returns a
 * new text; the caller frees it.
 */
char *tip_text(const char *text);

/** tip_show - what a handler of query-tooltip says; @text: NULL for nothing. */
gboolean tip_show(GtkTooltip *tooltip, const char *text);

/**
 * tip_set - the tooltip of a widget, which describes it to a reader, too; NULL or "": none,
 * or that of its file.
 *
 * The toolkit's own function waits in GTK 4.8 for the X server to say where the pointer is,
 * each time: a list would wait for each cell that it shows. Here only that of a widget which
 * the pointer is on is looked at again.
 */
void tip_set(GtkWidget *widget, const char *text);

/** tip_init - the tooltips of all widgets whose class is not in use yet stand so. */
void tip_init(void);

#endif
