/* SPDX-License-Identifier: MIT
 *
 * render_diff_chart - which steps, lines of steps and transitions of two charts differ.
 */
#ifndef EDITOR_RENDER_DIFF_SFC_H
#define EDITOR_RENDER_DIFF_SFC_H

#include "editor-gtk/draw/sfc_draw.h"

#include <glib.h>

/** render_diff_marks - marks (struct sfc_mark) of what was and of what is: SFC_CHANGED for
 * what both have otherwise, SFC_REMOVED or SFC_ADDED for what one of them has. */
void render_diff_marks(const struct sfc_sheet *before, const struct sfc_sheet *after,
		       GArray *removed, GArray *added);

#endif
