/* SPDX-License-Identifier: MIT
 *
 * blockers - why the element at the cursor has no power, or how power reaches it.
 *
 * trial/why.h finds the reasons. They are marked in the rung and shown in the status bar
 * for the current scan, until the command is given again. What is said of a condition or of a network
 * follows the values, too, and goes when the cursor moves.
 */
#ifndef EDITOR_BLOCKERS_H
#define EDITOR_BLOCKERS_H

#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/window/core.h"

struct blockers {
	struct core *core;
	LadderGridView *sheet;  /* weak; NULL: nothing is asked */
	int rung, row, col;     /* 0-based, of the rung                        */
	char *told;
	GtkWidget *asked;       /* weak; networks or a text that is asked; NULL: neither */
	char *place;            /* of the cursor of @asked; it stays when @asked is closed. NULL: nothing is asked */
	guint pause;            /* source; until it ends, @asked is not looked at again for a new scan. 0: none */
	bool late;              /* a scan was shown in the pause               */
};

void blockers_init(struct blockers *blockers, struct core *core);
void blockers_clear(struct blockers *blockers);
/** blockers_ask - shows the reasons for the element at the cursor; if they are shown
 * already, clears them. */
void blockers_ask(struct blockers *blockers);

#endif
