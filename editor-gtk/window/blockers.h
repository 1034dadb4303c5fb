/* SPDX-License-Identifier: MIT
 *
 * blockers - why the element at the cursor has no power, or by what ways it has it.
 *
 * The engine finds the reasons (trial/why.h). They are marked in the rung and told in the
 * status bar, for the scan that is shown, until the person asks again.
 */
#ifndef EDITOR_BLOCKERS_H
#define EDITOR_BLOCKERS_H

#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/window/core.h"

struct blockers {
	struct core *core;
	LadderGridView *sheet;  /* of the window's document, weak; NULL: nothing is asked */
	int rung, row, col;     /* 0-based, of the rung                        */
	char *told;
};

void blockers_init(struct blockers *blockers, struct core *core);
void blockers_clear(struct blockers *blockers);
/** blockers_ask - of the element at the cursor; asked again of the same, the marks go. */
void blockers_ask(struct blockers *blockers);

#endif
