/* SPDX-License-Identifier: MIT
 *
 * outbox - the variables that PUBLISH lines of a map name, their values, and when they are sent.
 *
 * Every line is sent as a whole each time, so that a board that missed a datagram has the values after the next one. It opens
 * no socket.
 */
#ifndef PEER_OUTBOX_H
#define PEER_OUTBOX_H

#include "hal/channel.h"
#include "peer/datagram.h"

struct outbox_value {
	const char *name;      /* of the map                                  */
	bool known, good;      /* known: ladderd has told its value; a text stays unknown */
	enum iec_type type;
	union iec_value value;
};

struct outbox_line {
	const struct io_publish *publish;
	uint32_t first;        /* of its values                               */
	int counts;            /* the line that counts the datagrams of its board on its bus */
	uint32_t sequence;
	uint32_t next;         /* the value that the next datagram begins with */
	int64_t due_ns;
};

struct outbox {
	struct outbox_value *value;
	uint32_t value_count;
	struct outbox_line *line;
	int line_count;
	uint64_t run;
};

/** outbox_open - the PUBLISH lines of @map, which is borrowed. @run: of this program. Owns: the arena. Scan-safe:
 * no. Fails: false: no memory. */
bool outbox_open(struct outbox *outbox, const struct iomap *map, uint64_t run, struct arena *arena);
/** outbox_due - when the next line is due; INT64_MAX: never. */
int64_t outbox_due(const struct outbox *outbox);
/** outbox_line_due - the next line that is due, with its next time set; NULL: none. */
struct outbox_line *outbox_line_due(struct outbox *outbox, int64_t now_ns);
/** outbox_write - the next datagram of a line, all values of which need several perhaps. Fails: false: it was the
 * last one. */
bool outbox_write(struct outbox *outbox, struct outbox_line *line, uint8_t flags, uint32_t age_ms,
		  struct peer_writer *out);
#endif
