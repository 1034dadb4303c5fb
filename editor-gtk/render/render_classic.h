/* SPDX-License-Identifier: MIT
 *
 * render_classic - rungs of a ClassicLadder project as they stand in its files, alone or
 * with what becomes of them here, in one picture.
 */
#ifndef EDITOR_RENDER_CLASSIC_H
#define EDITOR_RENDER_CLASSIC_H

#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/render/render_options.h"
#include "engine/ladder.h"

/**
 * render_classic - of POU @pou (-1: all), or of its rung options->rung alone
 * Fails: false: @ladder has loaded no such project, or no such rung came from one.
 */
bool render_classic(struct ladder *ladder, int pou, const struct render_options *options,
		    struct lettering *lettering, struct picture *picture);

#endif
