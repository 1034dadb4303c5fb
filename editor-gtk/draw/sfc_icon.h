/* SPDX-License-Identifier: MIT
 *
 * sfc_icon - the picture of a tool of a chart, for its tile and for a drag.
 */
#ifndef EDITOR_SFC_ICON_H
#define EDITOR_SFC_ICON_H

#include "editor-gtk/draw/sfc_tool.h"
#include "editor-gtk/kit/picture.h"

/** sfc_icon_draw - in the middle of @width x @height px. */
void sfc_icon_draw(enum sfc_tool tool, const struct theme *theme, struct lettering *lettering,
		   float width, float height, struct picture *picture);

#endif
