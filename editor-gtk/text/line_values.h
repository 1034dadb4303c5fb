/* SPDX-License-Identifier: MIT
 *
 * line_values - an instruction list, or Structured Text, that shows its values while it is simulated: right of the
 * longest line the value of the operand of each line, and the current result after it.
 *
 * Both are of the scan that is shown. A result is what that scan has computed
 * (code_result()): it is not computed again here. A line that the scan has jumped over says so.
 * Only the lines on the screen are looked at. It changes nothing.
 */
#ifndef EDITOR_LINE_VALUES_H
#define EDITOR_LINE_VALUES_H

#include "editor-gtk/document/text_range.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/sim/sim.h"

#include <gtksourceview/gtksource.h>

#define LADDER_TYPE_LINE_VALUES (ladder_line_values_get_type())
G_DECLARE_FINAL_TYPE(LadderLineValues, ladder_line_values, LADDER, LINE_VALUES, GtkSourceView)

/** line_values_new - a source view of @buffer. */
LadderLineValues *line_values_new(GtkSourceBuffer *buffer);
/** line_values_set_sim - whose values are shown; referenced. NULL: none. */
void line_values_set_sim(LadderLineValues *values, LadderSim *sim);
/** line_values_set_pou - the POU whose list is shown; "": none. */
void line_values_set_pou(LadderLineValues *values, const char *pou);
/** line_values_set_part - which lines of the text of the POU are shown; borrowed, read each time. NULL:
 * all. */
void line_values_set_part(LadderLineValues *values, const struct text_range *part);
/** line_values_set_st - is the text Structured Text? Then the values of all variables of a line are
 * shown, in the order in which they stand there; those of enumerations by name. */
void line_values_set_st(LadderLineValues *values, bool st);
/* The current result after line @line, from 0, of a list that is not in the file, as
 * live_map_result() finds it. False: it is not known. */
typedef bool (*LineResult)(void *context, const struct live_map *map, int line,
			   struct live_result *out);
/** line_values_set_result - for a list that is not in the file; @context: borrowed. */
void line_values_set_result(LadderLineValues *values, LineResult result, void *context);
/** line_values_set_note - what a screen reader says about line @line, from 0, before its values;
 * allocated, NULL: nothing. @context: borrowed. */
void line_values_set_note(LadderLineValues *values, char *(*note)(void *context, int line),
			  void *context);
/** line_values_set_hidden - @hidden: how many lines are hidden behind line @line, from 0; -1: the line
 * itself is. @context: borrowed. */
void line_values_set_hidden(LadderLineValues *values, int (*hidden)(void *context, int line),
			    void *context);
/** line_values_tell - the note of the line of the cursor may have changed. */
void line_values_tell(LadderLineValues *values);
/** line_values_instance - of a block: the instance whose values are shown, because the program stands
 * in it; NULL: the first one. Borrowed until the next scan is shown. */
const char *line_values_instance(LadderLineValues *values);
/** line_values_text - of the operand of a line, from 0: "3.2 s / 5 s"; NULL: none. Borrowed until
 * the list, the program or the scan changes. */
const char *line_values_text(LadderLineValues *values, int line);
/** line_values_result - the current result after it: "TRUE", "not run"; NULL: none is known. As
 * line_values_text(). */
const char *line_values_result(LadderLineValues *values, int line);

#endif
