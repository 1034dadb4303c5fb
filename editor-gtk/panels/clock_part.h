/* SPDX-License-Identifier: MIT
 *
 * clock_part - date and time of the connected board, how far they are from those of this computer,
 * and a button that sets them.
 *
 * It asks the board once a status, and only while it can be seen. A board without this service
 * hides it.
 */
#ifndef EDITOR_CLOCK_PART_H
#define EDITOR_CLOCK_PART_H

#include "editor-gtk/online/board_link.h"

#include <gtk/gtk.h>

GtkWidget *ladder_clock_part_new(LadderBoardLink *link);

#endif
