/* SPDX-License-Identifier: MIT
 *
 * watch_row - a row of a status chart while it is shown: its line, where the variable is,
 * the value that is seen, the one that is typed. It makes no widget.
 */
#ifndef EDITOR_WATCH_ROW_H
#define EDITOR_WATCH_ROW_H

#include "editor-gtk/live/watch.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_WATCH_ROW (ladder_watch_row_get_type())
G_DECLARE_FINAL_TYPE(LadderWatchRow, ladder_watch_row, LADDER, WATCH_ROW, GObject)

struct _LadderWatchRow {
	GObject parent_instance;
	struct watch_line *line;
	bool asked;             /* there was a program to find it in           */
	struct location at;     /* type IEC_NONE: not found                    */
	struct live_seen seen;  /* as it is shown                             */
	char *typed;            /* the new value; "": none                     */
	/* Its cells while they are on the screen; borrowed. */
	GtkWidget *value, *fresh, *force;
};

/** ladder_watch_row_new - @image: where it is looked for; NULL: nowhere. */
LadderWatchRow *ladder_watch_row_new(const struct watch_line *line,
				     const struct image *image);
/** watch_row_equal - is it the same variable, shown the same way? */
bool watch_row_equal(const LadderWatchRow *a, const LadderWatchRow *b);
/** watch_row_is_unknown - the program has no such name. */
bool watch_row_is_unknown(const LadderWatchRow *row);
/** watch_row_value - what is to be shown; "": no value is seen. Caller frees. */
char *watch_row_value(const LadderWatchRow *row);
/** watch_row_take - what is typed, as a value. @room: as live_value_parse(). Fails: false, and
 * @why says why; caller frees that. */
bool watch_row_take(const LadderWatchRow *row, const struct image *image,
		    struct iec_text *room, union iec_value *out, char **why);

/** watch_image - where names are found: the program that runs, else the document's own as
 * it was checked last. @room: to be used for it. NULL: there is none. */
const struct image *watch_image(LadderDocument *document, LadderSim *sim,
				struct image *room);

#endif
