/* SPDX-License-Identifier: MIT
 *
 * port - opens a serial line: raw, 8 data bits, no parity, one stop bit, no flow control.
 *
 * Both sides use it. It moves no bytes.
 */
#ifndef ONLINE_PORT_H
#define ONLINE_PORT_H

#include <stdint.h>

/**
 * port_open - @text: `/dev/ttyUSB0,115200` or `/dev/ttyUSB0`
 * @baud: gets the speed
 *
 * Two programs of ours never share a line. Owns: the caller, the descriptor; reads do not
 * wait. Scan-safe: no.
 * Fails: -errno; -EINVAL: not such a speed; -EBUSY: another program has it; -ENOTTY: no line.
 */
int port_open(const char *text, uint32_t *baud);
/** port_why - what an error of port_open() means, for a person: "this is no serial line". Static. */
const char *port_why(int error);
#endif
