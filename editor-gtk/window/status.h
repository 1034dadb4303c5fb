/* SPDX-License-Identifier: MIT
 *
 * status - the status bar: what the window is doing, where the cursor is, what the next key
 * does, how large the page in front is shown, what the checks found. Its messages are
 * messages.c's.
 */
#ifndef EDITOR_STATUS_H
#define EDITOR_STATUS_H

#include "editor-gtk/window/core.h"

struct status {
	struct core *core;
	GtkLabel *pill, *place, *checked, *zoom;
};

void status_init(struct status *status, struct core *core);

#endif
