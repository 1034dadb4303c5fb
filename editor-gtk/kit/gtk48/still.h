/* SPDX-License-Identifier: MIT
 *
 * still - a container that draws its child as one image when the child has not changed for
 * 250 ms.
 *
 * Mends in GTK 4.8.3: the cairo renderer walks through every node of a window in each frame,
 * also those far from the change; a palette alone has hundreds. The image is one node. Other
 * renderers keep nodes by themselves and get them unchanged.
 *
 * To see it: remove it round the palette and compare `make bench-editor`. When the floor
 * rises, compare again with GSK_RENDERER=cairo; it can go if nobody uses the cairo renderer.
 */
#ifndef EDITOR_STILL_H
#define EDITOR_STILL_H

#include <gtk/gtk.h>

#define LADDER_TYPE_STILL (ladder_still_get_type())
G_DECLARE_FINAL_TYPE(LadderStill, ladder_still, LADDER, STILL, GtkWidget)

/** ladder_still_new - @child is clipped to its bounds. It may be <child> in a template. */
GtkWidget *ladder_still_new(GtkWidget *child);

#endif
