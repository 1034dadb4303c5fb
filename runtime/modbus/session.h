/* SPDX-License-Identifier: MIT
 *
 * session - between ladderd and the wires: reads the map that runs, starts masters and servers, and moves
 * values until it is told to stop.
 */
#ifndef MODBUS_SESSION_H
#define MODBUS_SESSION_H

/** session_run - until SIGTERM or SIGINT
 * @socket: of ladderd. Returns the exit status. */
int session_run(const char *socket);
#endif
