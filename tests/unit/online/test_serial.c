/* SPDX-License-Identifier: MIT
 *
 * test_serial - two ends of a line that loses, doubles, changes and inserts bytes: each stream
 * arrives as it was sent, or the session ends.
 *
 * Time is virtual. SERIAL_ROUNDS sets how many lines are tried.
 */
#include "online/serial.h"
#include "tests/tap.h"
#include "tests/walker/random.h"

#include <stdlib.h>
#include <string.h>

#define MS     INT64_C(1000000)
#define STREAM 20000u

static void test_cobs(void)
{
	uint8_t bytes[600], coded[700];
	bool same = true, no_zero = true;

	for (size_t len = 0; len <= sizeof(bytes); len++)
		for (int kind = 0; kind < 3; kind++) {
			size_t coded_len;

			for (size_t i = 0; i < len; i++)
				bytes[i] = (uint8_t)(kind == 0 ? 0 : kind == 1 ? 1 + i % 255 : i % 256);
			coded_len = cobs_encode(bytes, len, coded);
			no_zero &= !memchr(coded, 0, coded_len) && coded_len <= len + len / 254 + 1;
			same &= cobs_decode(coded, coded_len) == len && memcmp(coded, bytes, len) == 0;
		}
	CHECK(same && no_zero);
	coded[0] = 5;
	CHECK(cobs_decode(coded, 3) == 0);
	coded[0] = 0;
	CHECK(cobs_decode(coded, 1) == 0);
}

struct end {
	struct serial serial;
	uint8_t stream[STREAM]; /* that came                                  */
	size_t sent, got;
	bool ended, began_again;
};

struct line {
	struct random_source random;
	unsigned lost, doubled, flipped, inserted; /* in 10,000               */
};

static uint8_t byte_of(size_t at, bool board)
{
	return (uint8_t)(at * 7 + (at >> 8) + board);
}

static void take(struct end *end, uint8_t byte, int64_t now_ns)
{
	struct serial *serial = &end->serial;

	switch (serial_byte(serial, byte, now_ns)) {
	case SERIAL_BEGUN:
		end->began_again |= end->got || end->sent;
		break;
	case SERIAL_CAME:
		if (end->got + serial->piece_len > STREAM)
			break; /* no room: it comes again */
		memcpy(end->stream + end->got, serial->piece, serial->piece_len);
		end->got += serial->piece_len;
		serial_take(serial);
		break;
	case SERIAL_ENDED:
		end->ended = true;
		break;
	case SERIAL_NOTHING:
	case SERIAL_TAKEN:
		break;
	}
}

static bool chance(struct line *line, unsigned of)
{
	return of && random_below(&line->random, 10000) < of;
}

static void carry(struct line *line, struct end *from, struct end *to, int64_t now_ns)
{
	size_t len;
	const uint8_t *bytes = serial_pending(&from->serial, &len);

	for (size_t i = 0; i < len; i++) {
		uint8_t byte = bytes[i];

		if (chance(line, line->inserted))
			take(to, (uint8_t)random_below(&line->random, 256), now_ns);
		if (chance(line, line->lost))
			continue;
		if (chance(line, line->flipped))
			byte ^= (uint8_t)(1u << random_below(&line->random, 8));
		take(to, byte, now_ns);
		if (chance(line, line->doubled))
			take(to, byte, now_ns);
	}
	serial_wrote(&from->serial, len);
}

static void speak(struct end *end, bool board, int64_t now_ns)
{
	uint8_t bytes[SERIAL_PIECE];
	size_t len = STREAM - end->sent;

	serial_step(&end->serial, now_ns);
	if (!serial_is_free(&end->serial) || !len)
		return;
	len = len < sizeof(bytes) ? len : sizeof(bytes);
	for (size_t i = 0; i < len; i++)
		bytes[i] = byte_of(end->sent + i, board);
	end->sent += serial_send(&end->serial, bytes, len, now_ns);
}

static bool is_right(const struct end *end, bool from_board)
{
	for (size_t i = 0; i < end->got; i++)
		if (end->stream[i] != byte_of(i, from_board))
			return false;
	return true;
}

/* Returns the ms that both streams took. @right: no byte was wrong. */
static int64_t exchange(struct line *line, uint32_t baud, bool *right)
{
	static struct end desk, board;
	int64_t now_ns = 0;

	memset(&desk, 0, sizeof(desk));
	memset(&board, 0, sizeof(board));
	serial_init(&desk.serial, SERIAL_DESK, baud);
	serial_init(&board.serial, SERIAL_BOARD, baud);
	serial_begin(&desk.serial, 77, now_ns);
	while ((desk.got < STREAM || board.got < STREAM) && !desk.ended && now_ns < 3600000 * MS) {
		now_ns += MS;
		speak(&desk, false, now_ns);
		carry(line, &desk, &board, now_ns);
		speak(&board, true, now_ns);
		carry(line, &board, &desk, now_ns);
	}
	*right = is_right(&desk, true) && is_right(&board, false) && !board.began_again &&
		 desk.got == STREAM && board.got == STREAM;
	return now_ns / MS;
}

static void test_good_line(void)
{
	struct line line = { .lost = 0 };
	bool right;

	CHECK(exchange(&line, 115200, &right) < 1000 && right);
	exchange(&line, 1200, &right);
	CHECK(right);
}

static void test_bad_lines(void)
{
	static const struct line kinds[] = {
		{ .lost = 8 }, { .doubled = 8 }, { .flipped = 8 }, { .inserted = 8 },
		{ .lost = 4, .doubled = 4, .flipped = 4, .inserted = 4 },
	};
	const char *more = getenv("SERIAL_ROUNDS");
	const int rounds = more ? (int)strtol(more, NULL, 10) : 12;

	for (size_t k = 0; k < sizeof(kinds) / sizeof(kinds[0]); k++) {
		bool all = true;

		for (int i = 0; i < rounds; i++) {
			struct line line = kinds[k];
			bool right;

			random_seed(&line.random, (uint64_t)i + 1000 * k + 1);
			exchange(&line, i % 2 ? 115200 : 9600, &right);
			all &= right;
		}
		CHECK(all);
	}
}

/* Bytes of one end, given to another. */
static void give(struct end *from, struct end *to)
{
	struct line line = { .lost = 0 };

	carry(&line, from, to, 1);
}

static void test_sessions(void)
{
	static struct end desk, board;

	serial_init(&desk.serial, SERIAL_DESK, 115200);
	serial_init(&board.serial, SERIAL_BOARD, 115200);
	serial_begin(&desk.serial, 5, 0);
	give(&desk, &board);
	give(&board, &desk);
	CHECK(desk.serial.open && board.serial.open && board.serial.session == 5);
	serial_send(&desk.serial, (const uint8_t *)"ab", 2, 0);
	give(&desk, &board);
	give(&board, &desk);
	CHECK(board.got == 2 && serial_is_free(&desk.serial));
	/* The desk begins anew: the board forgets the old numbers. */
	serial_begin(&desk.serial, 6, 0);
	give(&desk, &board);
	CHECK(board.began_again && board.serial.taken == 0 && board.serial.session == 6);
	give(&board, &desk);
	/* The board begins anew: the desk is told. */
	serial_init(&board.serial, SERIAL_BOARD, 115200);
	serial_send(&desk.serial, (const uint8_t *)"cd", 2, 0);
	give(&desk, &board);
	CHECK(board.got == 2);
	give(&board, &desk);
	CHECK(desk.ended && !desk.serial.open);
}

/* What an old desk sent late belongs to no session; a kernel that writes before a packet does
 * not spoil it. */
static void test_old_packets_and_texts(void)
{
	static struct end old, desk, board;
	struct line line = { .lost = 0 };

	serial_init(&old.serial, SERIAL_DESK, 115200);
	serial_init(&desk.serial, SERIAL_DESK, 115200);
	serial_init(&board.serial, SERIAL_BOARD, 115200);
	serial_begin(&old.serial, 5, 0);
	carry(&line, &old, &board, 1);
	carry(&line, &board, &old, 1);
	serial_begin(&desk.serial, 6, 0);
	carry(&line, &desk, &board, 1);
	carry(&line, &board, &desk, 1);
	serial_send(&old.serial, (const uint8_t *)"old", 3, 0);
	carry(&line, &old, &board, 1);
	CHECK(board.got == 0 && board.serial.session == 6);
	carry(&line, &board, &old, 1);
	CHECK(old.ended);
	for (const char *at = "[ 1.5] usb 1-1: new device"; *at; at++)
		take(&board, (uint8_t)*at, 1);
	serial_send(&desk.serial, (const uint8_t *)"new", 3, 0);
	carry(&line, &desk, &board, 1);
	CHECK(board.got == 3 && memcmp(board.stream, "new", 3) == 0);
}

static void test_echo_and_silence(void)
{
	static struct end desk;
	struct line line = { .lost = 0 };

	serial_init(&desk.serial, SERIAL_DESK, 115200);
	serial_begin(&desk.serial, 5, 0);
	carry(&line, &desk, &desk, 1);
	CHECK(!desk.serial.open && desk.serial.noise == 0);
	for (const char *at = "\r\ngarage login: "; *at; at++)
		take(&desk, (uint8_t)*at, 1);
	take(&desk, 0, 1);
	CHECK(desk.serial.noise > 0);
	CHECK(serial_due(&desk.serial) < 300 * MS);
	CHECK(serial_step(&desk.serial, 300 * MS));
	CHECK(!serial_step(&desk.serial, SERIAL_SILENT + 400 * MS));
	CHECK(serial_due(&desk.serial) == INT64_MAX);
}

int main(void)
{
	test_cobs();
	test_good_line();
	test_bad_lines();
	test_sessions();
	test_old_packets_and_texts();
	test_echo_and_silence();
	return tap_done();
}
