/* SPDX-License-Identifier: MIT
 *
 * problems - the list of what the checks found, and the number of problems.
 *
 * Signal: title-changed (): ladder_problems_title() changed.
 *
 * Activating a row, or ladder_problems_next(), goes to its place by the action win.go-to
 * (iiii). It corrects nothing.
 */
#ifndef EDITOR_PROBLEMS_H
#define EDITOR_PROBLEMS_H

#include <gtk/gtk.h>

#include "editor-gtk/document/document.h"

#define LADDER_TYPE_PROBLEMS (ladder_problems_get_type())
G_DECLARE_FINAL_TYPE(LadderProblems, ladder_problems, LADDER, PROBLEMS, GtkWidget)

GtkWidget *ladder_problems_new(void);
void ladder_problems_set_document(LadderProblems *problems, LadderDocument *document);
/** ladder_problems_show - shows these instead, whose places are those of @document. A click goes to one. */
void ladder_problems_show(LadderProblems *problems, LadderDocument *document, const struct diag_list *diags);
/** ladder_problems_title - "Problems 3", for the tab. Borrowed until it changes. */
const char *ladder_problems_title(LadderProblems *problems);
/** ladder_problems_count - of all, or of errors only. */
int ladder_problems_count(LadderProblems *problems, bool errors);
/** ladder_problems_next - selects the next or previous problem, after the last the first,
 * and goes there. False: none. */
bool ladder_problems_next(LadderProblems *problems, bool back);
/** ladder_problems_code - "LD203" of the selected problem; "": none. Borrowed until the next
 * `checked`. */
const char *ladder_problems_code(LadderProblems *problems);
/** ladder_problems_current - "Error: … Main, rung 3" of the selected problem; "": none.
 * Borrowed until the next `checked`. */
const char *ladder_problems_current(LadderProblems *problems);
/** ladder_problems_show_error - selects the first error and goes there. False: none. */
bool ladder_problems_show_error(LadderProblems *problems);

#endif
