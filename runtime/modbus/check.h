/* SPDX-License-Identifier: MIT
 *
 * check - what this machine lacks for the buses and servers of a map, before anything is driven.
 *
 * It opens serial lines and listens for a moment; it sends nothing.
 */
#ifndef MODBUS_CHECK_H
#define MODBUS_CHECK_H

#include "hal/channel.h"

/** check_machine - serial lines, permissions, names of hosts, addresses to listen at
 * Fails: false and an error for each, with its place in the map. */
bool check_machine(const struct iomap *map, struct diag_list *diags);
/** check_serve - the error of a server that cannot listen, for errno @why. */
void check_serve(const struct iomap *map, const struct io_serve *serve, int why,
		 struct diag_list *diags);
#endif
