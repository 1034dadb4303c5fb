/* SPDX-License-Identifier: MIT
 *
 * render_diff - two projects compared, as a picture of what differs.
 */
#ifndef EDITOR_RENDER_DIFF_H
#define EDITOR_RENDER_DIFF_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/render/render.h"

/** render_diff - what is other in project @b than in @a: rungs that were removed, added
 * and, above each other with their cells marked, changed; then lists, charts and, in
 * words, all else. */
void render_diff(const struct project *a, const struct project *b,
		 const struct render_options *options, struct lettering *lettering,
		 struct picture *picture);

#endif
