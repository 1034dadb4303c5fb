/* SPDX-License-Identifier: MIT
 *
 * grid_view_live - a sheet while it simulates: power, values, forces, and acts.
 *
 * It shows what the program computed and evaluates nothing. What a person does to values
 * goes to the simulation as acts.
 */
#ifndef EDITOR_GRID_VIEW_LIVE_H
#define EDITOR_GRID_VIEW_LIVE_H

#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sim/sim.h"

/** ladder_grid_view_set_sim - whenever @sim is on the sheet shows it. A reference is kept;
 * NULL: none. */
void ladder_grid_view_set_sim(LadderGridView *view, LadderSim *sim);

/** ladder_grid_view_set_instance - whose body is shown, of a function block: "Line.Belt1";
 * NULL: the first one. */
void ladder_grid_view_set_instance(LadderGridView *view, const char *instance);
/** ladder_grid_view_instance - NULL: it is no block, has no instance, or nothing runs.
 * Borrowed until the program changes. */
const char *ladder_grid_view_instance(LadderGridView *view);

/* A cell that keeps power from where it is wanted, 0-based, of the rung. */
struct grid_blocker {
	int row, col;
	const char *note;   /* short: "must be on"; NULL: none                  */
};
/** ladder_grid_view_set_blockers - marks these cells of a rung, and no others; of rung -1:
 * none. Copies are made. They stay until the rung is edited or others are set. */
void ladder_grid_view_set_blockers(LadderGridView *view, int rung,
				   const struct grid_blocker *cells, int count);

/** ladder_grid_view_drawn - how many rungs were drawn since the view was made. */
guint ladder_grid_view_drawn(LadderGridView *view);
/** ladder_grid_view_live - LIVE_… bits (grid_draw.h) of a cell as it is shown, and its
 * value's text, if there is one; false: nothing of it is shown. @text: 48 bytes. */
bool ladder_grid_view_live(LadderGridView *view, int rung, int row, int col,
			   unsigned int *bits, char *text);

#endif
