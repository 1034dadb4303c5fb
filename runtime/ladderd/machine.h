/* SPDX-License-Identifier: MIT
 *
 * machine - the lines and devices of the board, for desks that ask for them.
 *
 * A thread looks, because a sensor may take a second to answer. It requests no line and changes none. All
 * functions are for the link thread.
 */
#ifndef LADDERD_MACHINE_H
#define LADDERD_MACHINE_H

#include "online/server.h"

struct machine;

/** machine_new - @dev, @sys: of struct iomap; they live for ever. Fails: NULL: no memory. */
struct machine *machine_new(const char *dev, const char *sys);
/** machine_free - waits for the thread. */
void machine_free(struct machine *machine);
/** machine_io - for the server. */
struct server_machine machine_io(struct machine *machine);
#endif
