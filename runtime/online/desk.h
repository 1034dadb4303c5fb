/* SPDX-License-Identifier: MIT
 *
 * desk - the desk's side of a session: sends a request, waits for its answer, takes frames
 * that were not asked for.
 *
 * One thread at a time. It shows nothing; every failure is a value with a text. For programs
 * of a desk only.
 */
#ifndef ONLINE_DESK_H
#define ONLINE_DESK_H

#include "online/serial.h"
#include "online/service.h"
#include "online/stream.h"

enum desk_end {
	DESK_GOOD,
	DESK_REFUSED,  /* the board said no: `refusal` and `detail`           */
	DESK_LATE,     /* no answer within the service's time                 */
	DESK_GONE,     /* the stream has ended                                */
	DESK_NONSENSE, /* what came is no answer of this protocol             */
	DESK_NO_ROOM,  /* the request is longer than a frame can be           */
};

struct desk {
	struct stream stream;
	uint16_t request;      /* number of the last one                      */
	uint16_t version;      /* that both speak                             */
	enum role role;        /* what this session may do                    */
	char board[64], software[32];
	/* Of the last call. */
	uint16_t refusal;
	char detail[LIMIT_PARTS]; /* parts of a diagnostic                  */
	/* Takes frames that were not asked for; NULL: they are dropped. */
	void (*told)(void *context, const struct frame *frame);
	void *context;
	/* Of a serial line. A slow line may take longer than the service, as long as it moves. */
	struct serial serial;
	bool ended;            /* the board does not have this session       */
	int64_t until_ms, patience_ms, most_until_ms;
	size_t in_len, used;
	uint8_t in[WIRE_FRAME_MOST], out[WIRE_FRAME_MOST];
};

/**
 * desk_open - connects and says hello
 * @name: of the program at the desk, for the board's log
 *
 * Owns: the caller, desk_close(), also after a failure. Scan-safe: no; so are all functions.
 */
enum desk_end desk_open(struct desk *desk, const struct stream *stream, const char *name);
/** desk_open_within - the same, where the board answers only when a person has answered
 * questions of the stream. @ms: waits so long. */
enum desk_end desk_open_within(struct desk *desk, const struct stream *stream, const char *name,
			       int ms);
/** desk_open_as - the same as desk_open() for a session that wants the role ROLE_IO; desk->role tells whether it
 * has it. */
enum desk_end desk_open_as(struct desk *desk, const struct stream *stream, const char *name,
			   enum role role);
void desk_close(struct desk *desk);

/** desk_ask - begins a request; the caller writes its fields. */
struct wire_writer desk_ask(struct desk *desk, enum service service);
/**
 * desk_call - sends the request that desk_ask() began, waits for its answer
 * @answer: gets the fields; valid until the next call
 */
enum desk_end desk_call(struct desk *desk, struct wire_writer *request, struct wire_reader *answer);
/** desk_listen - takes what comes within @ms; DESK_LATE: nothing did. */
enum desk_end desk_listen(struct desk *desk, int ms);
/** desk_diag - why the last call failed, as a diagnostic without a place. @end: not
 * DESK_GOOD. */
struct diag desk_diag(const struct desk *desk, enum desk_end end);
#endif
