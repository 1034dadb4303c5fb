/* SPDX-License-Identifier: MIT
 *
 * still - round a widget: an image of it, once it has not changed for a moment.
 *
 * The cairo renderer goes through every node of a window in each frame, also those that
 * are far from what changed: a palette alone has hundreds. An image is one of them. A
 * renderer that keeps nodes by itself gets them as they are.
 */
#ifndef EDITOR_STILL_H
#define EDITOR_STILL_H

#include <gtk/gtk.h>

#define LADDER_TYPE_STILL (ladder_still_get_type())
G_DECLARE_FINAL_TYPE(LadderStill, ladder_still, LADDER, STILL, GtkWidget)

/** ladder_still_new - @child is drawn within its bounds alone. It may be <child> in a template. */
GtkWidget *ladder_still_new(GtkWidget *child);

#endif
