/* SPDX-License-Identifier: MIT
 *
 * fold_gutter - the numbers of the lines that are not hidden, and triangles beside blocks that can be
 * folded.
 *
 * GtkSourceView's own numbers are drawn over each other where lines are hidden.
 *
 * Signals of fold_gutter_new():
 *   pressed (int line)   the triangle of a line, from 0, was pressed
 */
#ifndef EDITOR_FOLD_GUTTER_H
#define EDITOR_FOLD_GUTTER_H

#include <gtksourceview/gtksource.h>

#define LADDER_TYPE_FOLD_GUTTER (ladder_fold_gutter_get_type())
G_DECLARE_FINAL_TYPE(LadderFoldGutter, ladder_fold_gutter, LADDER, FOLD_GUTTER, GtkSourceGutterRenderer)
#define LADDER_TYPE_LINE_NUMBERS (ladder_line_numbers_get_type())
G_DECLARE_FINAL_TYPE(LadderLineNumbers, ladder_line_numbers, LADDER, LINE_NUMBERS, GtkSourceGutterRendererText)

enum fold_mark {
	FOLD_BEGINS = 1,   /* a block begins in the line                        */
	FOLD_CLOSED = 2,   /* it is folded                                      */
	FOLD_HIDDEN = 4,   /* the line is hidden                                */
};

/** fold_gutter_new - @marks: gets bits of enum fold_mark of a line, from 0; @context: borrowed. */
GtkSourceGutterRenderer *fold_gutter_new(unsigned (*marks)(void *context, int line), void *context);
/** line_numbers_new - likewise. */
GtkSourceGutterRenderer *line_numbers_new(unsigned (*marks)(void *context, int line), void *context);
#endif
