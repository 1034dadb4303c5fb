/* SPDX-License-Identifier: MIT
 *
 * board_devices - the lines and analog devices of the connected board, to choose from in an I/O map.
 *
 * The board looks, which may take a second for each sensor; meanwhile it is asked again and again.
 */
#ifndef EDITOR_BOARD_DEVICES_H
#define EDITOR_BOARD_DEVICES_H

#include "editor-gtk/document/iomap_check.h"
#include "editor-gtk/document/iomap_devices.h"
#include "editor-gtk/online/board_link.h"

/* What a board has. */
struct board_devices {
	struct io_machine machine;
	struct io_devices devices;
};
void board_devices_free(struct board_devices *devices);

/** board_devices_came - @devices: taken over by the handler: board_devices_free(); NULL: the board does not tell, and
 * @why says why, translated; "": it has gone. */
typedef void (*board_devices_came)(gpointer data, struct board_devices *devices, const char *why);

/**
 * board_devices_ask - has the board look for them now
 * @owner: if it is disposed before, @came is not called
 * @came: with @owner; called once
 */
void board_devices_ask(LadderBoardLink *link, GObject *owner, board_devices_came came);
#endif
