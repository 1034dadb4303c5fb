/* SPDX-License-Identifier: MIT
 *
 * datagram - what boards send each other: some variables of one board, in one datagram (docs/peer.md).
 *
 * A datagram comes from anybody: it is compared as a whole before any of it is used. It opens no socket and knows
 * no map.
 */
#ifndef PEER_DATAGRAM_H
#define PEER_DATAGRAM_H

#include "engine/base/iec.h"
#include "online/wire.h"

#define PEER_MAGIC   0x52454550u /* "PEER"                                    */
#define PEER_VERSION 1u
#define PEER_BYTES   1400u /* of a datagram, so that no network cuts it       */
#define PEER_BOARD   63u   /* bytes of the name of a board                    */

enum peer_flag { PEER_HELD = 1 }; /* no program runs there                        */

struct peer_head {
	uint8_t flags;
	uint16_t count;        /* values                                      */
	uint64_t run;          /* by chance, for each run of the sender       */
	uint32_t sequence;     /* of this board, from 1 on                    */
	uint32_t age_ms;       /* since ladderd answered the sender           */
	const char *board;     /* borrowed, not ended by NUL                  */
	uint8_t board_len;
};

struct peer_value {
	const char *name;      /* borrowed                                    */
	uint8_t name_len;
	enum iec_type type;    /* no STRING                                   */
	bool good;
	union iec_value value;
};

/** peer_read - the head of a datagram. @values: for peer_next(). Scan-safe: yes; so are all functions.
 * Fails: false: it is damaged, of another version, or no datagram of a board; no part of it was used. */
bool peer_read(const uint8_t *bytes, size_t len, struct peer_head *out, struct wire_reader *values);
/** peer_next - the next value. Fails: false: there are no more. */
bool peer_next(struct wire_reader *values, struct peer_value *out);

/* One that is being written. */
struct peer_writer {
	struct wire_writer out;
	uint8_t *count_at;
	uint16_t count;
	uint8_t bytes[PEER_BYTES];
};
/** peer_begin - @head: count is not used. */
void peer_begin(struct peer_writer *writer, const struct peer_head *head);
/** peer_add - Fails: false: it has no room; the datagram is as before. */
bool peer_add(struct peer_writer *writer, const struct peer_value *value);
/** peer_end - returns its bytes. */
size_t peer_end(struct peer_writer *writer);

/**
 * peer_convert - a value as one of another type
 *
 * Whole numbers, bit strings and BOOL become one another if the other type holds the value; a bit string of the
 * same size holds the bits of a number, and a number those of a bit string. REAL and LREAL become one another.
 * Fails: false: it is no value of @to.
 */
bool peer_convert(enum iec_type from, union iec_value value, enum iec_type to, union iec_value *out);
#endif
