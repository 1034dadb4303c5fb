/* SPDX-License-Identifier: MIT
 *
 * inbox - the points of a map that other boards give values, and whether a datagram may.
 *
 * It takes datagrams only of boards that the map names. One that is old, that comes twice, or that somebody else
 * sends in the name of a board that still speaks, is refused and counted. It opens no socket.
 */
#ifndef PEER_INBOX_H
#define PEER_INBOX_H

#include "hal/channel.h"
#include "online/report.h"
#include "peer/datagram.h"

#define INBOX_FORGET_NS INT64_C(5000000000) /* then a board may have another address   */

/* Another board on one bus. */
struct inbox_source {
	int bus;
	const char *board;     /* of the map                                  */
	bool heard;
	uint32_t address;      /* that it had last                            */
	uint64_t run, run_before;
	uint32_t sequence;     /* the last one                                */
	int64_t heard_ns;
	uint64_t taken, refused, lost;
};

struct inbox_point {
	uint32_t point;        /* number in the map                           */
	int source;
	const char *name;      /* variable there                              */
	enum iec_type raw;
	int64_t stale_ns;
};

struct inbox {
	struct inbox_source *source;
	int source_count;
	struct inbox_point *point;
	int point_count;
};

/** inbox_open - the points of @map, which is borrowed. Owns: the arena. Scan-safe: no. Fails: false: no memory. */
bool inbox_open(struct inbox *inbox, const struct iomap *map, struct arena *arena);

/* For each value that a point gets. */
typedef void inbox_put(void *context, uint32_t point, enum iec_type type, union iec_value value, bool good);
/**
 * inbox_take - a datagram that came on a bus
 * @bus: its number in the map; @address: of the sender
 * @own: runs of this program, which hears itself, are not taken
 *
 * Returns how many values were put. Scan-safe: yes.
 */
int inbox_take(struct inbox *inbox, int bus, const uint8_t *bytes, size_t len, uint32_t address, uint64_t own,
	       int64_t now_ns, inbox_put *put, void *context);
#endif
