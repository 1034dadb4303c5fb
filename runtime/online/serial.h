/* SPDX-License-Identifier: MIT
 *
 * serial - makes a stream of bytes of a serial line, which loses and changes bytes.
 *
 * The stream goes in pieces. A piece is a packet between two zero bytes: COBS-coded, with a
 * checksum, numbered, and sent again until the other side has taken it (docs/online.md). One
 * piece waits at a time. Bytes that are no packet are dropped: text of a kernel, a login, noise.
 *
 * It opens nothing, reads no clock and knows no frames. Both sides use it.
 */
#ifndef ONLINE_SERIAL_H
#define ONLINE_SERIAL_H

#include "online/wire.h"

#define SERIAL_PIECE  512u                     /* bytes of a piece, at most         */
#define SERIAL_HEAD   7u                       /* of a packet before the piece      */
#define SERIAL_PACKET (SERIAL_HEAD + SERIAL_PIECE + 4) /* with its checksum          */
#define SERIAL_CODED  (SERIAL_PACKET + SERIAL_PACKET / 254 + 3) /* on the line       */
#define SERIAL_LEAST  32u                      /* bytes of a piece on a slow line    */
#define SERIAL_SILENT INT64_C(30000000000)     /* ns: then the other side is away    */

enum serial_side { SERIAL_DESK, SERIAL_BOARD };

/* What a byte of the line completed. */
enum serial_event {
	SERIAL_NOTHING,
	SERIAL_BEGUN,   /* a session; of a board: the one before has ended    */
	SERIAL_CAME,    /* a piece: `piece`, `piece_len`                      */
	SERIAL_TAKEN,   /* the other side has what serial_send() sent         */
	SERIAL_ENDED,   /* the other side does not have this session          */
};

struct serial {
	enum serial_side side;
	uint32_t session;      /* chosen by the desk                          */
	bool open, beginning;  /* the board has it; the desk asks for it      */
	uint16_t sent, taken;  /* numbers of the last pieces                  */
	uint16_t most;         /* bytes of a piece at this speed              */
	int64_t patience_ns;   /* for an answer                               */
	int64_t again_ns;      /* when the piece that waits is sent again     */
	int64_t heard_ns;      /* when the last packet came                   */
	uint64_t noise;        /* bytes that were no packet                   */
	/* A piece that came; until the next byte. */
	const uint8_t *piece;
	size_t piece_len;
	/* Sent and not taken yet; 0: none. */
	size_t kept_len;
	uint8_t kept[SERIAL_PIECE];
	size_t in_len;         /* more than there is room: too long           */
	uint8_t in[SERIAL_CODED];
	size_t out_len, out_done; /* bytes for the line                       */
	uint8_t out[2 * SERIAL_CODED];
};

/** serial_init - no session. @baud: speed of the line. Scan-safe: yes; so are all functions. */
void serial_init(struct serial *serial, enum serial_side side, uint32_t baud);
/** serial_begin - of a desk: asks for a session. @session: a number by chance. */
void serial_begin(struct serial *serial, uint32_t session, int64_t now_ns);
/** serial_end - says that the session has ended, once. */
void serial_end(struct serial *serial);
/**
 * serial_byte - takes the next byte of the line
 *
 * After SERIAL_CAME, serial_take() says that the piece was taken. If it is not called, the
 * piece comes again.
 */
enum serial_event serial_byte(struct serial *serial, uint8_t byte, int64_t now_ns);
void serial_take(struct serial *serial);
/** serial_is_free - whether the next piece can be sent. */
bool serial_is_free(const struct serial *serial);
/** serial_send - sends up to `most` bytes; only if serial_is_free(). Returns how many. */
size_t serial_send(struct serial *serial, const uint8_t *bytes, size_t len, int64_t now_ns);
/** serial_due - when serial_step() has to do something; INT64_MAX: never. */
int64_t serial_due(const struct serial *serial);
/** serial_step - sends again what is due. Fails: false: the other side has been silent for
 * SERIAL_SILENT although something waits; the session has ended. */
bool serial_step(struct serial *serial, int64_t now_ns);
/** serial_pending - bytes for the line; 0: none. serial_wrote - so many are written. */
const uint8_t *serial_pending(const struct serial *serial, size_t *len);
void serial_wrote(struct serial *serial, size_t len);

/** cobs_encode - @out: has room for @len + @len / 254 + 1 bytes. Returns its bytes, none is 0. */
size_t cobs_encode(const uint8_t *bytes, size_t len, uint8_t *out);
/** cobs_decode - in place. Returns its bytes. Fails: 0: not COBS. */
size_t cobs_decode(uint8_t *bytes, size_t len);
#endif
