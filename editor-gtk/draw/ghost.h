/* SPDX-License-Identifier: MIT
 *
 * ghost - what hangs from the pointer while an element or a rung is dragged.
 *
 * Half transparent upon the ground of a sheet, so that it is read wherever it is and what
 * is below it is seen. It knows nothing of where it may be dropped.
 */
#ifndef EDITOR_GHOST_H
#define EDITOR_GHOST_H

#include "editor-gtk/draw/grid_draw.h"

/** ghost_element - its icon; @word: of the catalogue or of a project. */
void ghost_element(GtkDragSource *source, const struct word_row *word,
		   const struct theme *theme, struct lettering *lettering);
/**
 * ghost_rung - its drawing, not larger than a hand can lead
 * @scale:    of the sheet; what is too wide gets smaller, what is too high is cut off
 * @hot_x, hot_y: where it was taken, px of its drawing at 100 %
 */
void ghost_rung(GtkDragSource *source, const struct drafting *drafting,
		const struct rung_layout *layout, const struct theme *theme, float scale,
		float hot_x, float hot_y);

#endif
