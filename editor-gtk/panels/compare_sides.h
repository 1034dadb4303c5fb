/* SPDX-License-Identifier: MIT
 *
 * compare_sides - draws one side of a difference: rung, chart, lines or texts.
 */
#ifndef EDITOR_COMPARE_SIDES_H
#define EDITOR_COMPARE_SIDES_H

#include "editor-gtk/document/comparison.h"
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/kit/picture.h"

/**
 * compare_side_draw - what a version has at the place of @row; an empty version gets "not
 * there"
 * @newer: the newer version, else the older one
 * @show: names above elements
 *
 * Returns the y of the place in the picture.
 */
float compare_side_draw(const struct comparison *of, const struct compare_row *row, bool newer,
			enum drafting_show show, struct picture *picture,
			struct lettering *lettering);

#endif
