/* SPDX-License-Identifier: MIT
 *
 * device_view - the page of the connected board: what it is, how it runs, its tasks and its
 * forces.
 *
 * It shows what the last status said, and only while it can be seen. Its button activates
 * win.sim_release.
 */
#ifndef EDITOR_DEVICE_VIEW_H
#define EDITOR_DEVICE_VIEW_H

#include "editor-gtk/online/board_link.h"

#include <gtk/gtk.h>

GtkWidget *ladder_device_view_new(LadderBoardLink *link);

#endif
