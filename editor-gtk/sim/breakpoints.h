/* SPDX-License-Identifier: MIT
 *
 * breakpoints - the breakpoints of a person: lines of texts of programs. They last as long as the
 * window.
 *
 * Signals:
 *   changed ()
 */
#ifndef EDITOR_BREAKPOINTS_H
#define EDITOR_BREAKPOINTS_H

#include <glib-object.h>
#include <stdbool.h>

#define LADDER_TYPE_BREAKPOINTS (ladder_breakpoints_get_type())
G_DECLARE_FINAL_TYPE(LadderBreakpoints, ladder_breakpoints, LADDER, BREAKPOINTS, GObject)

struct breakpoint {
	char *pou;
	int line;                /* of its text, from 0                        */
	char *condition;         /* it stands only while this is TRUE; NULL: always */
};

/** ladder_breakpoints_new - none. */
LadderBreakpoints *ladder_breakpoints_new(void);
guint ladder_breakpoints_count(LadderBreakpoints *points);
/** ladder_breakpoints_at - borrowed until the next change. */
const struct breakpoint *ladder_breakpoints_at(LadderBreakpoints *points, guint index);
/** ladder_breakpoints_find - that of a line; NULL: it has none. As ladder_breakpoints_at(). */
const struct breakpoint *ladder_breakpoints_find(LadderBreakpoints *points, const char *pou, int line);
/** ladder_breakpoints_set - one in that line, with another condition if it has one. NULL: always. */
void ladder_breakpoints_set(LadderBreakpoints *points, const char *pou, int line,
			    const char *condition);
void ladder_breakpoints_clear(LadderBreakpoints *points, const char *pou, int line);
void ladder_breakpoints_clear_all(LadderBreakpoints *points);
/** ladder_breakpoints_move - the text of @pou has changed: @to has the new line of each one of it, in
 * their order; -1: it is gone. @name: of the POU now. */
void ladder_breakpoints_move(LadderBreakpoints *points, const char *pou, const char *name,
			     const int *to);
#endif
