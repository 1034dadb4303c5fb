/* SPDX-License-Identifier: MIT
 *
 * board_time - the date and time of a board: fields of the service `time`.
 */
#ifndef ONLINE_BOARD_TIME_H
#define ONLINE_BOARD_TIME_H

#include "online/service.h"
#include "online/wire.h"

#define BOARD_TIME_LEAST INT64_C(946684800000000000)  /* 2000-01-01 UTC       */
#define BOARD_TIME_END   INT64_C(4102444800000000000) /* 2100-01-01 UTC       */

/* Whether a time server keeps the clock, as far as the kernel knows. */
enum board_sync { SYNC_NO, SYNC_YES, SYNC_UNKNOWN };

struct board_time {
	int64_t time_ns;       /* since 1970, UTC                              */
	int32_t zone_s;        /* local time less UTC                          */
	uint8_t sync;          /* enum board_sync                              */
	char zone[16];         /* its short name, such as CEST; "": unknown    */
};

/* The clock of a board; by the link thread. */
struct server_clock {
	/** @at_ns: when the zone is wanted; 0: now. */
	void (*read)(void *context, int64_t at_ns, struct board_time *out);
	/** Fails: REFUSAL_TIME_RIGHT: ladderd may not; REFUSAL_RANGE: the kernel does not take it. */
	enum refusal (*set)(void *context, int64_t time_ns);
};

/** board_time_put, board_time_take - its fields. Scan-safe: yes. Fails: the reader has failed. */
void board_time_put(struct wire_writer *out, const struct board_time *time);
void board_time_take(struct wire_reader *in, struct board_time *time);
/** board_time_print - date and time at @zone_s from UTC, "2026-05-31 07:30:00"; @out: 20 bytes or more. */
void board_time_print(int64_t time_ns, int32_t zone_s, char out[20]);
/** board_time_parse - the reverse of board_time_print(); between date and time, `T` is as good as a
 * blank; without seconds, they are 0. @utc: `Z` follows. Fails: false: no date and time. */
bool board_time_parse(const char *text, int64_t *time_ns, bool *utc);
#endif
