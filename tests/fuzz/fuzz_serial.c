/* SPDX-License-Identifier: MIT
 *
 * fuzz_serial - gives any bytes to both ends of a serial line.
 *
 * What an end takes has the length of a piece, and what it sends is packets.
 */
#include "engine/base/digest.h"
#include "online/serial.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

static void as_side(enum serial_side side, const uint8_t *bytes, size_t len)
{
	static struct serial serial;
	uint8_t sum = 0;
	size_t out;

	serial_init(&serial, side, 9600);
	if (side == SERIAL_DESK)
		serial_begin(&serial, 0x01020304, 0);
	for (size_t i = 0; i < len; i++) {
		const enum serial_event event = serial_byte(&serial, bytes[i], (int64_t)i * 1000000);

		if (event == SERIAL_CAME) {
			fuzz_expect(serial.piece_len && serial.piece_len <= SERIAL_PIECE,
				    "a piece has a length");
			for (size_t k = 0; k < serial.piece_len; k++)
				sum ^= serial.piece[k];
			serial_take(&serial);
		}
		if (serial_is_free(&serial))
			serial_send(&serial, &sum, 1, (int64_t)i * 1000000);
		serial_step(&serial, (int64_t)i * 1000000);
		serial_pending(&serial, &out);
		fuzz_expect(out <= sizeof(serial.out), "what waits is in its room");
		serial_wrote(&serial, i % 3 ? out : out / 2);
	}
}

/* Makes packets with good checksums of the bytes, so that their fields are read. */
static size_t pack(const uint8_t *bytes, size_t len, uint8_t *out, size_t size)
{
	size_t at = 0;

	while (len > 1 && at + 2 * SERIAL_CODED < size) {
		uint8_t packet[SERIAL_PACKET];
		size_t part = bytes[0] % 64u;

		bytes++;
		len--;
		part = part < len ? part : len;
		memcpy(packet, bytes, part);
		for (int i = 0; i < 4; i++)
			packet[part + (size_t)i] = (uint8_t)(digest_crc32c(0, packet, part) >> 8 * i);
		at += cobs_encode(packet, part + 4, out + at);
		out[at++] = 0;
		bytes += part;
		len -= part;
	}
	return at;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	static uint8_t packed[1 << 16];
	uint8_t copy[1024];
	const size_t packed_len = pack(bytes, len, packed, sizeof(packed));

	for (enum serial_side side = SERIAL_DESK; side <= SERIAL_BOARD; side++) {
		as_side(side, bytes, len);
		as_side(side, packed, packed_len);
	}
	if (len <= sizeof(copy)) {
		memcpy(copy, bytes, len);
		fuzz_expect(cobs_decode(copy, len) <= len, "decoding makes it shorter");
	}
	return 0;
}

/* What both ends of a session send: after a byte of length, the fields of packets of the session
 * that both ends have, and then whole packets. */
uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	static struct serial desk;
	uint8_t *seed = malloc(4096);
	static const uint8_t fields[] = {
		7, 1, 4, 3, 2, 1, 0, 0, /* begin */ 8, 2, 4, 3, 2, 1, 1, 0, 'r', /* piece 1 */
		7, 3, 4, 3, 2, 1, 1, 0, 7, 4, 4, 3, 2, 1, 0, 0,
		7, 129, 4, 3, 2, 1, 0, 0, 8, 130, 4, 3, 2, 1, 1, 0, 'r',
		7, 131, 4, 3, 2, 1, 1, 0, 7, 132, 4, 3, 2, 1, 0, 0,
	};
	size_t at = sizeof(fields), count;
	const uint8_t *out;

	if (!seed)
		return NULL;
	memcpy(seed, fields, sizeof(fields));
	serial_init(&desk, SERIAL_DESK, 115200);
	serial_begin(&desk, 0x01020304, 0);
	desk.open = true;
	desk.beginning = false;
	serial_send(&desk, (const uint8_t *)"rung", 4, 0);
	(void)bytes, (void)len;
	for (int side = 0; side < 2; side++) {
		out = serial_pending(&desk, &count);
		memcpy(seed + at, out, count);
		at += count;
		serial_wrote(&desk, count);
		desk.side = SERIAL_BOARD;
		serial_take(&desk);
	}
	*out_len = at;
	return seed;
}
