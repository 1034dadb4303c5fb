/* SPDX-License-Identifier: MIT
 *
 * master - the masters of all buses of a map, each in a thread of its own.
 */
#ifndef MODBUS_MASTER_H
#define MODBUS_MASTER_H

#include "modbus/line.h"

struct master {
	struct bus bus;
	struct line line;
	pthread_t thread;
	pthread_cond_t wake;
	atomic_bool stop;
	bool runs;
};

struct masters {
	struct master **of;    /* one for each bus of the map; NULL: no bus of Modbus, or no point on it */
	int count;
};

/** masters_start - begins with all buses. Owns: masters_stop(), also after a failure.
 * Fails: false: no memory or no thread. */
bool masters_start(struct masters *masters, const struct iomap *map, struct field *field);
/** masters_stop - ends after the requests that are under way; nothing more is written. */
void masters_stop(struct masters *masters);
/** masters_output - a new value for an output of the map. */
void masters_output(struct masters *masters, int point, union iec_value value);
/** masters_ask - a request of block @ask of the program; as bus_ask_for(). */
void masters_ask(struct masters *masters, const struct iomap *map, int ask, uint32_t number);
#endif
