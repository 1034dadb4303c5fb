/* SPDX-License-Identifier: MIT
 *
 * serial - packets of a serial line.
 */
#include "online/serial.h"

#include "engine/base/digest.h"

#include <string.h>

#define MS INT64_C(1000000)

/* Kinds of packets; those of the board have FROM_BOARD, so a side ignores an echo of its own. */
enum kind { KIND_BEGIN = 1, KIND_PIECE, KIND_TAKEN, KIND_END };
#define FROM_BOARD 128u

/* ---- COBS: no byte of a packet is 0 ---- */

size_t cobs_encode(const uint8_t *bytes, size_t len, uint8_t *out)
{
	size_t at = 1, head = 0;

	for (size_t i = 0; i < len; i++) {
		if (bytes[i])
			out[at++] = bytes[i];
		if (!bytes[i] || (at - head == 255 && i + 1 < len)) {
			out[head] = (uint8_t)(at - head);
			head = at++;
		}
	}
	out[head] = (uint8_t)(at - head);
	return at;
}

/* In place: bytes are written before the place where they are read. */
size_t cobs_decode(uint8_t *bytes, size_t len)
{
	size_t from = 0, to = 0;

	while (from < len) {
		const size_t run = bytes[from++];

		if (run == 0 || run - 1 > len - from)
			return 0;
		memmove(bytes + to, bytes + from, run - 1);
		to += run - 1;
		from += run - 1;
		if (run < 255 && from < len)
			bytes[to++] = 0;
	}
	return to;
}

/* ---- packets out ---- */

static bool put_packet(struct serial *serial, enum kind kind, uint32_t session, uint16_t number,
		       const uint8_t *bytes, size_t len)
{
	uint8_t packet[SERIAL_PACKET];
	struct wire_writer out = wire_write(packet, sizeof(packet));

	if (serial->out_done == serial->out_len)
		serial->out_done = serial->out_len = 0;
	if (sizeof(serial->out) - serial->out_len < SERIAL_CODED)
		return false; /* the line is slow: it will be asked for again */
	wire_put_u8(&out, (uint8_t)(kind | (serial->side == SERIAL_BOARD ? FROM_BOARD : 0)));
	wire_put_u32(&out, session);
	wire_put_u16(&out, number);
	wire_put_bytes(&out, bytes, len);
	wire_put_u32(&out, digest_crc32c(0, packet, wire_len(&out)));
	serial->out[serial->out_len++] = 0; /* ends what noise has begun */
	serial->out_len += cobs_encode(packet, wire_len(&out), serial->out + serial->out_len);
	serial->out[serial->out_len++] = 0;
	return true;
}

static void send_kept(struct serial *serial, int64_t now_ns)
{
	if (serial->beginning)
		put_packet(serial, KIND_BEGIN, serial->session, 0, NULL, 0);
	else
		put_packet(serial, KIND_PIECE, serial->session, serial->sent, serial->kept,
			   serial->kept_len);
	serial->again_ns = now_ns + serial->patience_ns;
}

const uint8_t *serial_pending(const struct serial *serial, size_t *len)
{
	*len = serial->out_len - serial->out_done;
	return serial->out + serial->out_done;
}

void serial_wrote(struct serial *serial, size_t len)
{
	serial->out_done += len;
}

/* ---- sessions ---- */

static void renew(struct serial *serial, uint32_t session)
{
	serial->session = session;
	serial->sent = serial->taken = 0;
	serial->kept_len = 0;
	serial->open = serial->beginning = false;
}

/* A piece takes at most 50 ms. An answer may take the time of two of them, and that of a busy
 * machine. */
void serial_init(struct serial *serial, enum serial_side side, uint32_t baud)
{
	const uint32_t bytes = baud / 200;

	memset(serial, 0, sizeof(*serial));
	serial->side = side;
	serial->most = (uint16_t)(bytes < SERIAL_LEAST ? SERIAL_LEAST :
				  bytes > SERIAL_PIECE ? SERIAL_PIECE : bytes);
	serial->patience_ns = 100 * MS + (int64_t)serial->most * 2 * 10 * 1000 * MS / baud;
}

void serial_begin(struct serial *serial, uint32_t session, int64_t now_ns)
{
	renew(serial, session);
	serial->beginning = true;
	serial->heard_ns = now_ns;
	send_kept(serial, now_ns);
}

void serial_end(struct serial *serial)
{
	if (serial->open)
		put_packet(serial, KIND_END, serial->session, 0, NULL, 0);
	serial->open = serial->beginning = false;
	serial->kept_len = 0;
}

bool serial_is_free(const struct serial *serial)
{
	return serial->open && !serial->kept_len;
}

size_t serial_send(struct serial *serial, const uint8_t *bytes, size_t len, int64_t now_ns)
{
	if (len > serial->most)
		len = serial->most;
	memcpy(serial->kept, bytes, len);
	serial->kept_len = len;
	serial->sent++;
	serial->heard_ns = now_ns;
	send_kept(serial, now_ns);
	return len;
}

int64_t serial_due(const struct serial *serial)
{
	return serial->beginning || serial->kept_len ? serial->again_ns : INT64_MAX;
}

bool serial_step(struct serial *serial, int64_t now_ns)
{
	if (serial_due(serial) > now_ns)
		return true;
	if (now_ns - serial->heard_ns > SERIAL_SILENT) {
		serial_end(serial);
		return false;
	}
	send_kept(serial, now_ns);
	return true;
}

void serial_take(struct serial *serial)
{
	serial->taken++;
	put_packet(serial, KIND_TAKEN, serial->session, serial->taken, NULL, 0);
}

/* ---- packets in ---- */

static enum serial_event came_begin(struct serial *serial, uint32_t session)
{
	const bool again = serial->open && serial->session == session;

	if (serial->side == SERIAL_DESK) {
		if (!serial->beginning || serial->session != session)
			return SERIAL_NOTHING;
		serial->beginning = false;
		serial->open = true;
		return SERIAL_BEGUN;
	}
	if (!again)
		renew(serial, session);
	serial->open = true;
	put_packet(serial, KIND_BEGIN, session, 0, NULL, 0);
	return again ? SERIAL_NOTHING : SERIAL_BEGUN;
}

static enum serial_event came_piece(struct serial *serial, uint16_t number)
{
	if (number == serial->taken) /* the answer was lost */
		put_packet(serial, KIND_TAKEN, serial->session, number, NULL, 0);
	return number == (uint16_t)(serial->taken + 1) && serial->piece_len ? SERIAL_CAME :
									      SERIAL_NOTHING;
}

static enum serial_event came_taken(struct serial *serial, uint16_t number)
{
	if (!serial->kept_len || number != serial->sent)
		return SERIAL_NOTHING;
	serial->kept_len = 0;
	return SERIAL_TAKEN;
}

/* Of a session that is not open here. */
static enum serial_event came_late(struct serial *serial, uint8_t kind, uint32_t session)
{
	if (serial->side == SERIAL_BOARD && kind == KIND_PIECE)
		put_packet(serial, KIND_END, session, 0, NULL, 0);
	return SERIAL_NOTHING;
}

static enum serial_event take_packet(struct serial *serial, size_t len, int64_t now_ns)
{
	struct wire_reader in = wire_read(serial->in, len);
	struct wire_reader sum = wire_read(serial->in + len - 4, 4);
	const uint8_t from = serial->side == SERIAL_BOARD ? 0 : FROM_BOARD;
	const uint8_t kind = wire_u8(&in);
	const uint32_t session = wire_u32(&in);
	const uint16_t number = wire_u16(&in);

	if (wire_u32(&sum) != digest_crc32c(0, serial->in, len - 4)) {
		serial->noise += len;
		return SERIAL_NOTHING;
	}
	if ((kind & FROM_BOARD) != from)
		return SERIAL_NOTHING; /* an echo */
	serial->piece_len = wire_left(&in) - 4;
	serial->piece = wire_bytes(&in, serial->piece_len);
	serial->heard_ns = now_ns;
	if ((kind & ~FROM_BOARD) == KIND_BEGIN)
		return came_begin(serial, session);
	if (!serial->open || session != serial->session)
		return came_late(serial, kind & (uint8_t)~FROM_BOARD, session);
	switch ((enum kind)(kind & ~FROM_BOARD)) {
	case KIND_PIECE:
		return came_piece(serial, number);
	case KIND_TAKEN:
		return came_taken(serial, number);
	case KIND_END:
		renew(serial, session);
		return SERIAL_ENDED;
	case KIND_BEGIN:
		break;
	}
	return SERIAL_NOTHING;
}

enum serial_event serial_byte(struct serial *serial, uint8_t byte, int64_t now_ns)
{
	size_t len = serial->in_len;

	if (byte) {
		if (len < sizeof(serial->in))
			serial->in[serial->in_len++] = byte;
		else
			serial->noise++; /* all of it is noise then: the checksum is wrong */
		return SERIAL_NOTHING;
	}
	serial->in_len = 0;
	if (!len)
		return SERIAL_NOTHING;
	len = cobs_decode(serial->in, len);
	if (len >= SERIAL_HEAD + 4 && len <= SERIAL_PACKET)
		return take_packet(serial, len, now_ns);
	serial->noise++;
	return SERIAL_NOTHING;
}
