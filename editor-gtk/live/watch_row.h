/* SPDX-License-Identifier: MIT
 *
 * watch_row - a row of the status chart: a line of the chart, its place in the program, the
 * value that is shown, and a new value that was typed. It knows no document.
 */
#ifndef EDITOR_WATCH_ROW_H
#define EDITOR_WATCH_ROW_H

#include "editor-gtk/live/watch.h"
#include "editor-gtk/sim/live_named.h"

#include <gtk/gtk.h>

/* Its fields are for the view and tests. */
#define LADDER_TYPE_WATCH_ROW (ladder_watch_row_get_type())
G_DECLARE_FINAL_TYPE(LadderWatchRow, ladder_watch_row, LADDER, WATCH_ROW, GObject)

struct _LadderWatchRow {
	GObject parent_instance;
	struct watch_line *line;
	bool asked;             /* there was a program in which to find it     */
	struct location at;     /* type IEC_NONE: not found                    */
	struct live_named named; /* of its values                               */
	struct live_seen seen;  /* as it is shown                             */
	char *typed;            /* the new value; "": none                     */
	bool acted, forcing;    /* a value was written, or it was forced or released: the board
				   may refuse it later                         */
	char *sent;             /* what was typed then                         */
	/* Its cells while they are on screen; borrowed. */
	GtkWidget *value, *fresh, *force;
};

/** watch_row_new - @image: of the program that may have the name; NULL: none. @sim: that runs it;
 * NULL: none. */
LadderWatchRow *watch_row_new(const struct watch_line *line, const struct image *image,
			      LadderSim *sim);
/** watch_row_equal - the same variable at the same place, with the same format and comment? */
bool watch_row_equal(const LadderWatchRow *a, const LadderWatchRow *b);
/** watch_row_is_unknown - the program does not have the name. */
bool watch_row_is_unknown(const LadderWatchRow *row);
/** watch_row_value - the value that is shown. Caller frees. */
char *watch_row_value(const LadderWatchRow *row);
/** watch_row_parse - parses the typed value. False: @why says why not; caller frees it. */
bool watch_row_parse(const LadderWatchRow *row, const struct image *image,
		     struct iec_text *room, union iec_value *out, char **why);

#endif
