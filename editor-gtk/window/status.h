/* SPDX-License-Identifier: MIT
 *
 * status - the status bar: mode, cursor position, hint, zoom, and the number of problems.
 *
 * messages.c shows messages in it.
 */
#ifndef EDITOR_STATUS_H
#define EDITOR_STATUS_H

#include "editor-gtk/window/core.h"

struct status {
	struct core *core;
	GtkLabel *pill, *place, *checked, *zoom;
	GtkTextBuffer *below;      /* followed; NULL: none                   */
	int forces;                /* when the hint was made                  */
};

void status_init(struct status *status, struct core *core);

#endif
