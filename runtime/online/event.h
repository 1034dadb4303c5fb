/* SPDX-License-Identifier: MIT
 *
 * event - a record of a board's log: what happened, when, and who did it, in a fixed size.
 *
 * Records lie in a ring, each with a checksum; a damaged one is left out. Texts come from
 * outside: a program that shows them replaces characters that are not printable. It opens no file.
 */
#ifndef ONLINE_EVENT_H
#define ONLINE_EVENT_H

#include "online/wire.h"

#define EVENT_BYTES 256u       /* of a record                                 */
#define EVENT_RING  2048u      /* records of a log                            */

enum event_id {
#define EVENT(id, number, text) EVENT_##id = (number),
#include "online/events.def"
};

struct event {
	uint32_t seq;          /* from 1 on; the log has the last EVENT_RING   */
	int64_t time_ns;       /* since 1970                                  */
	uint8_t id;            /* enum event_id                               */
	uint8_t role;          /* enum role; 0: the board itself              */
	char user[32];         /* "" : the board itself                       */
	char arg[2][80];
};

/** event_text - of events.def; NULL: no event has this number. Static. */
const char *event_text(uint8_t id);
/** event_program - how the log names a program: its identity in hex; "none": the board has none. */
void event_program(const uint8_t identity[32], char out[65]);
/** event_put, event_take - the fields of an event. Scan-safe: yes. Fails: the reader has
 * failed. */
void event_put(struct wire_writer *out, const struct event *event);
void event_take(struct wire_reader *in, struct event *event);
/** event_seal - a record. @out: EVENT_BYTES. */
void event_seal(const struct event *event, uint8_t *out);
/** event_open - Fails: false: no record, or damaged. */
bool event_open(const uint8_t *bytes, struct event *out);
/** event_fill - @text, that of the event or its translation, with its arguments: "forced
 * Start=1"; what is not printable is shown as `?`. As snprintf. */
int event_fill(const struct event *event, const char *text, char *out, size_t size);
/** event_print - event_fill() with the text of events.def. */
int event_print(const struct event *event, char *out, size_t size);
#endif
