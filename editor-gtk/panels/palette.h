/* SPDX-License-Identifier: MIT
 *
 * palette - every element and block as a tile, by family, to be clicked or dragged.
 *
 * Tiles come from the catalogue and from the blocks of the project; their icons are the
 * drawing of the sheet.
 */
#ifndef EDITOR_PALETTE_H
#define EDITOR_PALETTE_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** ladder_palette_new - a click does "win.place", a drag is ladder_grid_view_drag(). */
GtkWidget *ladder_palette_new(LadderDocument *document);
/** ladder_palette_find - the keys go to its search; Return there does "win.place" with the
 * one that fits best, Escape empties it and does "win.to-sheet". */
void ladder_palette_find(GtkWidget *palette);

#endif
