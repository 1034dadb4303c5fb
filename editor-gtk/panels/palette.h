/* SPDX-License-Identifier: MIT
 *
 * palette - every element and block as a tile, by family, to be clicked, dragged or
 * searched.
 *
 * Tiles come from the catalogue and from the blocks of the project; their icons are drawn
 * as on the sheet.
 */
#ifndef EDITOR_PALETTE_H
#define EDITOR_PALETTE_H

#include "editor-gtk/document/document.h"

#include <gtk/gtk.h>

/** ladder_palette_new - a click activates "win.place"; a drag is ladder_grid_view_drag(). */
GtkWidget *ladder_palette_new(LadderDocument *document);
/** ladder_palette_find - focuses the search entry. Return activates "win.place" with the
 * best match; Escape clears it and activates "win.to-sheet". */
void ladder_palette_find(GtkWidget *palette);

#endif
