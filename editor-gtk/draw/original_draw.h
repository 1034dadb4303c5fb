/* SPDX-License-Identifier: MIT
 *
 * original_draw - a rung or network as another tool has drawn it, above what the import made of it.
 *
 * Elements stand where the file of the other tool has them, and wires go as they do there. Drawing needs no
 * widget and no display.
 */
#ifndef EDITOR_ORIGINAL_DRAW_H
#define EDITOR_ORIGINAL_DRAW_H

#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/kit/picture.h"

#include "engine/exchange/drawing.h"

struct original_scene {
	const struct drawing *drawing;
	struct lettering *lettering;
	const struct theme *theme;
	const char *name;            /* of the file                              */
	const struct project *project; /* the import; NULL: only the original     */
	int pou, number;             /* of the rung or network                   */
	enum drafting_show show;
};

/** original_pair - it, and what the import made of it below. */
void original_pair(const struct original_scene *scene, struct picture *picture);

#endif
