/* SPDX-License-Identifier: MIT
 *
 * iomap_live - the column of an I/O map's table with present values, and the test of a point: its value is
 * set, forced or released by hand.
 *
 * Values are those of the simulation or of the connected board (sim/live_value.h), with its rights.
 */
#ifndef EDITOR_IOMAP_LIVE_H
#define EDITOR_IOMAP_LIVE_H

#include "editor-gtk/document/panel.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/sim/sim.h"

struct iomap_live {
	LadderSim *sim;         /* NULL: none yet                              */
	GPtrArray *cells;       /* buttons that show a row, borrowed           */
	GPtrArray *columns;     /* of all pages, borrowed                      */
	GtkWidget *test;        /* the popover; NULL: not open                 */
};

void iomap_live_init(struct iomap_live *live);
void iomap_live_clear(struct iomap_live *live);
/** iomap_live_add - adds the column to a page. @live: outlives the list. */
void iomap_live_add(struct iomap_live *live, struct panel_list *list);
/** iomap_live_follow - shows the values of @sim while it is on. @owner: of @live; the signals of @sim
 * end with it. */
void iomap_live_follow(struct iomap_live *live, LadderSim *sim, GObject *owner);

#endif
