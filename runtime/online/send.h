/* SPDX-License-Identifier: MIT
 *
 * send - a desk's download: sends the parts of a program that the board does not have.
 *
 * The board gives the sums of the blocks of the program that runs there; bytes of the new one
 * that are in it, at whatever place, are copied on the board. It neither verifies nor commits.
 */
#ifndef ONLINE_SEND_H
#define ONLINE_SEND_H

#include "online/desk.h"
#include "online/stored.h"

struct sent {
	uint32_t bytes;        /* of the program, that went over the stream    */
	uint32_t copied;       /* that the board had                           */
	/* Told how many bytes the board has; false: nothing more is sent. NULL: nobody. */
	bool (*go_on)(void *context, uint32_t received);
	void *context;
};

/**
 * send_program - begins a download, or goes on with one that was cut, and sends it
 * @all: sends every byte, as to a board that has no sums
 * @sent: its `go_on` and `context` are read, the rest is filled
 *
 * If `verify` then refuses it as not whole and something was copied, send it again with @all.
 * Owns: nothing. Scan-safe: no. Fails: as desk_call(); DESK_NO_ROOM: no memory.
 */
enum desk_end send_program(struct desk *desk, const struct stored *stored, bool all,
			   struct sent *sent);
#endif
