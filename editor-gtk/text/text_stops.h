/* SPDX-License-Identifier: MIT
 *
 * text_stops - the breakpoints of a program in Structured Text, of the actions of a chart, or of EXECUTE boxes, on their sheet:
 * marks that move with the lines, the line before which the program stands, and the question for a condition.
 */
#ifndef EDITOR_TEXT_STOPS_H
#define EDITOR_TEXT_STOPS_H

#include "editor-gtk/text/line_values.h"

#include <gtksourceview/gtksource.h>

struct text_stops;

/** text_stops_new - on @view, of @document; @pou: where its number is; @part: which lines of it are
 * shown; borrowed. Owns: text_stops_free(), before @view goes. Lines are those that are shown. */
struct text_stops *text_stops_new(LadderLineValues *view, LadderDocument *document, const int *pou,
				  const struct text_range *part);
void text_stops_free(struct text_stops *stops);
/** text_stops_set_sim - whose breakpoints they are; referenced. NULL: none are shown. */
void text_stops_set_sim(struct text_stops *stops, LadderSim *sim);
/** text_stops_leave - another POU comes: text_stops_renew() finds its breakpoints. */
void text_stops_leave(struct text_stops *stops);
/** text_stops_renew - the POU has another number, name or language. */
void text_stops_renew(struct text_stops *stops);
/** text_stops_take - the text of the sheet goes into the document; text_stops_taken: it is there. */
void text_stops_take(struct text_stops *stops);
void text_stops_taken(struct text_stops *stops);
/** text_stops_exchanged - the sheet has another text of the document, or other lines of it. */
void text_stops_exchanged(struct text_stops *stops);
/** text_stops_toggle - a breakpoint in line @line, from 0, or none. */
void text_stops_toggle(struct text_stops *stops, int line);
/** text_stops_ask - for the condition of the breakpoint in line @line, from 0, which is set then. */
void text_stops_ask(struct text_stops *stops, int line);
/** text_stops_say - what a screen reader says about line @line, from 0; NULL: nothing. Caller
 * frees. */
char *text_stops_say(struct text_stops *stops, int line);
#endif
