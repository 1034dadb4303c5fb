/* SPDX-License-Identifier: MIT
 *
 * ghost - the picture at the pointer while an element or a rung is dragged.
 *
 * It is half transparent on the colour of a sheet, so that it and the sheet below can both
 * be read.
 */
#ifndef EDITOR_GHOST_H
#define EDITOR_GHOST_H

#include "editor-gtk/draw/grid_draw.h"

#define GHOST_WIDTH  64 /* px, of a tile                                       */
#define GHOST_HEIGHT 40
/** ghost_tile - the picture of a tile, GHOST_WIDTH x GHOST_HEIGHT. */
void ghost_tile(GtkDragSource *source, const struct picture *picture,
		const struct theme *theme, struct lettering *lettering);
/** ghost_element - its icon; @word: of the catalogue or of a project. */
void ghost_element(GtkDragSource *source, const struct word_row *word,
		   const struct theme *theme, struct lettering *lettering);
/**
 * ghost_rung - the drawing of a rung, at most 480 x 160 px
 * @scale:    of the sheet; a wider rung is scaled down, a higher one is cut off
 * @hot_x, hot_y: start of the drag, px of the drawing at 100 %
 */
void ghost_rung(GtkDragSource *source, const struct drafting *drafting,
		const struct rung_layout *layout, const struct theme *theme, float scale,
		float hot_x, float hot_y);

#endif
