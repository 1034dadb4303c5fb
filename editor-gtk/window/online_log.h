/* SPDX-License-Identifier: MIT
 *
 * online_log - the events of the connected board, as lines of the log.
 */
#ifndef EDITOR_ONLINE_LOG_H
#define EDITOR_ONLINE_LOG_H

#include "editor-gtk/window/core.h"

struct online_log {
	struct core *core;
	guint32 next;          /* number of the first event that is not known  */
	gint64 last_ns;        /* time of the last event that was logged       */
	char *where;           /* the board that these are of                  */
	GArray *events;        /* of struct event: asked for, not logged yet   */
	bool asking;
	bool past;             /* `events` are from before the connection      */
};

void online_log_init(struct online_log *log, struct core *core);
void online_log_clear(struct online_log *log);

#endif
