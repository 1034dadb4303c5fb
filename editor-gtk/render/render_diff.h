/* SPDX-License-Identifier: MIT
 *
 * render_diff - a comparison of two projects as one picture.
 */
#ifndef EDITOR_RENDER_DIFF_H
#define EDITOR_RENDER_DIFF_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/render/render.h"

/** render_diff - the changes from project @a to project @b: rungs that were removed or
 * added, changed rungs above each other with marked cells; then lists, charts and, as text,
 * everything else. */
void render_diff(const struct project *a, const struct project *b,
		 const struct render_options *options, struct lettering *lettering,
		 struct picture *picture);

#endif
