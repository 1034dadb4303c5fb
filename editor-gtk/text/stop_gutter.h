/* SPDX-License-Identifier: MIT
 *
 * stop_gutter - the marks of breakpoints beside the lines of a text, and where the program stands.
 *
 * Signals:
 *   pressed (int line, gboolean ask)  a line, from 0, was pressed; @ask: with the second button
 */
#ifndef EDITOR_STOP_GUTTER_H
#define EDITOR_STOP_GUTTER_H

#include <gtksourceview/gtksource.h>

#define LADDER_TYPE_STOP_GUTTER (ladder_stop_gutter_get_type())
G_DECLARE_FINAL_TYPE(LadderStopGutter, ladder_stop_gutter, LADDER, STOP_GUTTER, GtkSourceGutterRenderer)

enum stop_mark {
	STOP_SET = 1,      /* a breakpoint                                     */
	STOP_IF = 2,       /* with a condition                                 */
	STOP_LOST = 4,     /* that is never reached                            */
	STOP_STANDS = 8,   /* the program stands before this line              */
	STOP_CALLS = 16,   /* it waits in this line for what it called         */
};

/** stop_gutter_new - @marks: gets bits of enum stop_mark of a line, from 0; @context: borrowed. */
GtkSourceGutterRenderer *stop_gutter_new(unsigned (*marks)(void *context, int line), void *context);
#endif
