/* SPDX-License-Identifier: MIT
 *
 * buses - what this machine lacks for the buses and servers of a map, before anything is driven.
 *
 * It opens serial lines and listens for a moment; it sends nothing. The programs that serve a bus and `ladder io`
 * link it; ladderd itself does not.
 */
#ifndef HAL_BUSES_H
#define HAL_BUSES_H

#include "hal/channel.h"

/** buses_check - serial lines, permissions, names of hosts, addresses to listen at. Scan-safe: no.
 * Fails: false and an error for each, with its place in the map. */
bool buses_check(const struct iomap *map, struct diag_list *diags);
/** buses_check_peers - the networks of boards, likewise. */
bool buses_check_peers(const struct iomap *map, struct diag_list *diags);
/** buses_server_error - the error of a server that cannot listen, for errno @why. */
void buses_server_error(const struct iomap *map, const struct io_serve *serve, int why,
			struct diag_list *diags);
/** buses_listen - a socket that listens at an address of this machine; -1 and errno (ENXIO: no such address). */
int buses_listen(const struct io_bus *at);
#endif
