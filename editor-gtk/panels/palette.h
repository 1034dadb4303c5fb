/* SPDX-License-Identifier: MIT
 *
 * palette - what the sheet in front is made of, as tiles by family: elements and blocks for a
 * ladder; steps, transitions and actions for a chart. They are clicked, dragged or searched.
 *
 * Elements come from the catalogue and from the blocks of the project, parts of a chart from
 * draw/sfc_tool.h; their icons are drawn as on the sheet.
 */
#ifndef EDITOR_PALETTE_H
#define EDITOR_PALETTE_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

enum palette_kind { PALETTE_NONE, PALETTE_LADDER, PALETTE_CHART, PALETTE_NETWORK };

/** ladder_palette_new - a click activates "win.place" with a word, or "win.place-part" with a
 * tool of a chart; a drag is ladder_grid_view_drag(), ladder_sfc_view_drag() or ladder_fbd_view_drag(). */
GtkWidget *ladder_palette_new(LadderDocument *document);
/** ladder_palette_show - the tiles for the sheet in front; PALETTE_NONE: its parent is hidden. */
void ladder_palette_show(GtkWidget *palette, enum palette_kind kind);
/** ladder_palette_find - focuses the search entry; false: it is hidden. Return activates the
 * action of the best match; Escape clears it and activates "win.to-sheet". */
bool ladder_palette_find(GtkWidget *palette);

#endif
