/* SPDX-License-Identifier: MIT
 *
 * find - `ladder-modbus scan`: which units of a bus answer.
 *
 * It reads one register of each. Any answer counts, also a refusal. It writes nothing to a unit. What is no answer of
 * the unit, or is damaged, is reported but does not count.
 */
#ifndef MODBUS_FIND_H
#define MODBUS_FIND_H

#include "hal/channel.h"

/** find_units - asks units @first to @last and prints those that answer, on standard output
 * @json: one object: {"units":[{"unit":3,"ms":4.1,"exception":0}],"doubts":[{"at":5,"why":"…"}]}
 * Standard error tells why there is none, and what to look at.
 * Returns how many; -1: the bus cannot be opened, or has gone. */
int find_units(const struct io_bus *bus, int first, int last, bool json);
#endif
