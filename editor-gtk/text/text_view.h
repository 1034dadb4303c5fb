/* SPDX-License-Identifier: MIT
 *
 * text_view - a program in IL or ST, or a file that cannot be read, as text.
 *
 * With syntax colours, completion, and errors while typing. Each change goes into the document
 * and its history.
 */
#ifndef EDITOR_TEXT_VIEW_H
#define EDITOR_TEXT_VIEW_H

#include "editor-gtk/document/find.h"
#include "editor-gtk/sim/sim.h"

#include <gtksourceview/gtksource.h>

#define LADDER_TYPE_TEXT_VIEW (ladder_text_view_get_type())
G_DECLARE_FINAL_TYPE(LadderTextView, ladder_text_view, LADDER, TEXT_VIEW, GtkBox)

/** ladder_text_view_new - of POU @pou; -1: of the whole file. */
GtkWidget *ladder_text_view_new(LadderDocument *document, int pou);
int ladder_text_view_pou(LadderTextView *view);
void ladder_text_view_set_pou(LadderTextView *view, int pou);
/**
 * ladder_text_view_set_part - shows nothing but the EXECUTE box or the action around a line; all, if
 * there is none
 * @line: 1-based, of the POU as a file holds it
 *
 * It emits "part-changed" when that part gets another name or is gone. An action of a program or a
 * block is always shown so.
 */
void ladder_text_view_set_part(LadderTextView *view, int line);
/** ladder_text_view_has - is that line shown? */
bool ladder_text_view_has(LadderTextView *view, int line);
/** ladder_text_view_part - what is shown: "Text of the program", "Statements of Count"; NULL: its lines
 * have gone. Caller frees. */
char *ladder_text_view_part(LadderTextView *view);
/** ladder_text_view_set_sim - the values beside the lines and in their tooltips come from @sim;
 * keeps a reference. NULL: none. */
void ladder_text_view_set_sim(LadderTextView *view, LadderSim *sim);
/** ladder_text_view_tip - the tooltip of line @line, 1-based, of the shown text: errors and
 * values; NULL: none. Caller frees. */
char *ladder_text_view_tip(LadderTextView *view, int line);
/** ladder_text_view_take - puts the last letters into the document at once, without the usual
 * delay. */
void ladder_text_view_take(LadderTextView *view);
/** ladder_text_view_buffer - the shown text. Borrowed. */
GtkSourceBuffer *ladder_text_view_buffer(LadderTextView *view);
/** ladder_text_view_name - the name or address at the cursor; NULL: none. Owns: the
 * caller, g_free(). */
char *ladder_text_view_name(LadderTextView *view);
/** ladder_text_view_is_st - is it a POU in Structured Text, or a chart with such actions? */
gboolean ladder_text_view_is_st(LadderTextView *view);
/** ladder_text_view_format - writes it in its canonical form, as `ladder fmt` does. Fails: FALSE: it
 * has errors that hide its form. */
gboolean ladder_text_view_format(LadderTextView *view);
/** ladder_text_view_mend - mends the first error of the cursor's line whose message says how.
 * Fails: FALSE: there is none. */
gboolean ladder_text_view_mend(LadderTextView *view);
/** ladder_text_view_why - why the condition in the line of the cursor is TRUE or FALSE, in
 * Structured Text while simulating; NULL: no condition is there. Caller frees. */
char *ladder_text_view_why(LadderTextView *view);
/** ladder_text_view_toggle_stop - a breakpoint in the line of the cursor, or none; of Structured
 * Text. */
void ladder_text_view_toggle_stop(LadderTextView *view);
/** ladder_text_view_ask_stop - asks for the condition of that breakpoint, which is set then. */
void ladder_text_view_ask_stop(LadderTextView *view);
/** ladder_text_view_run_here - goes on up to the line of the cursor. Fails: false: no statement is
 * there or behind it, or nothing is simulated. */
bool ladder_text_view_run_here(LadderTextView *view);
/** ladder_text_view_fold - folds the innermost block around the cursor that is not folded, or unfolds
 * the one that begins in its line. Fails: false: there is none. */
bool ladder_text_view_fold(LadderTextView *view, bool fold);
/** ladder_text_view_fold_all - folds all blocks, or unfolds them. */
void ladder_text_view_fold_all(LadderTextView *view, bool fold);
/** ladder_text_view_row - the line of the cursor in the text of the POU, from 0. */
int ladder_text_view_row(LadderTextView *view);
/** ladder_text_view_is_at - whether line @line, 1-based, of the list as a file holds it, is
 * the one of the cursor. */
bool ladder_text_view_is_at(LadderTextView *view, int line);
/** ladder_text_view_set_found - marks the hits of a search in the text. */
void ladder_text_view_set_found(LadderTextView *view, const struct find_seen *seen);
/** ladder_text_view_go - @line: 1-based, of the file; the cursor goes there. */
void ladder_text_view_go(LadderTextView *view, int line, int column);
/** ladder_text_view_go_here - @line: 1-based, of the list as a file
 * holds it. */
void ladder_text_view_go_here(LadderTextView *view, int line, int column);

#endif
