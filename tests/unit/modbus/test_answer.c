/* SPDX-License-Identifier: MIT
 *
 * test_answer - containment: every function with every table and address; nothing but the windows of the
 * map is read or changed.
 */
#include "modbus/answer.h"
#include "modbus/serve.h"
#include "tests/tap.h"

#define WINDOWS 6

static struct io_window windows[WINDOWS] = {
	{ .serve = 0, .table = TABLE_HOLDING_REGISTER, .first = 10, .count = 20, .writable = true },
	{ .serve = 0, .table = TABLE_HOLDING_REGISTER, .first = 30, .count = 5 },
	{ .serve = 0, .table = TABLE_COIL, .first = 100, .count = 40, .writable = true },
	{ .serve = 0, .table = TABLE_DISCRETE_INPUT, .first = 0, .count = 9 },
	{ .serve = 0, .table = TABLE_INPUT_REGISTER, .first = 65530, .count = 6 },
	{ .serve = 1, .table = TABLE_HOLDING_REGISTER, .first = 0, .count = 5, .writable = true },
};
static const struct io_net net = { .serve_count = 2, .window = windows, .window_count = WINDOWS };
static uint16_t value[WINDOWS][64];
static bool outside, dead;

static bool read_window(void *context, int window, uint32_t first, int count, uint16_t *out)
{
	(void)context;
	if (first + (uint32_t)count > windows[window].count || count < 1 || windows[window].serve != 0)
		outside = true;
	else
		memcpy(out, value[window] + first, (size_t)count * sizeof(*out));
	return !dead;
}

static bool write_window(void *context, int window, uint32_t first, int count, const uint16_t *in)
{
	(void)context;
	if (first + (uint32_t)count > windows[window].count || count < 1 || !windows[window].writable ||
	    windows[window].serve != 0)
		outside = true;
	else
		memcpy(value[window] + first, in, (size_t)count * sizeof(*in));
	return !dead;
}

static const struct answer_image image = { .read = read_window, .write = write_window };

static void reset(void)
{
	for (int i = 0; i < WINDOWS; i++)
		for (int j = 0; j < 64; j++)
			value[i][j] = windows[i].table == TABLE_COIL || windows[i].table == TABLE_DISCRETE_INPUT ?
				      j % 3 == 0 : (uint16_t)(i * 1000 + j);
	outside = dead = false;
}

static struct pdu ask(struct pdu request)
{
	struct pdu answer = { .len = -1 };

	answer_make(&net, 0, &image, &request, &answer);
	return answer;
}

/* Whether a register or coil may be read, or written. */
static bool may(enum io_table table, int at, bool write)
{
	for (int i = 0; i < WINDOWS; i++)
		if (windows[i].serve == 0 && windows[i].table == table && at >= windows[i].first &&
		    at < windows[i].first + (int)windows[i].count && (!write || windows[i].writable))
			return true;
	return false;
}

static bool may_all(enum io_table table, int at, int count, bool write)
{
	for (int i = 0; i < count; i++)
		if (!may(table, at + i, write))
			return false;
	return true;
}

static bool is_exception(const struct pdu *answer, int function, int number)
{
	return answer->len == 2 && answer->byte[0] == (function | 0x80) && answer->byte[1] == number;
}

/* Each function that reads, from each address, 1 … 7 of them. */
static void test_reads_stay_in_their_windows(void)
{
	int good = 0, tried = 0, allowed = 0;

	reset();
	for (int table = TABLE_COIL; table <= TABLE_HOLDING_REGISTER; table++) {
		for (int at = 0; at < 65536; at++) {
			const int count = 1 + at % 7;
			const bool bits = table == TABLE_COIL || table == TABLE_DISCRETE_INPUT;
			const bool right = may_all((enum io_table)table, at, count, false);
			struct pdu request, answer;

			pdu_read(&request, (enum io_table)table, (uint16_t)at, count);
			answer = ask(request);
			tried++;
			allowed += right;
			good += right ? answer.byte[0] == request.byte[0] &&
					answer.len == 2 + (bits ? 1 : 2 * count) :
					is_exception(&answer, request.byte[0], PDU_NO_ADDRESS);
		}
	}
	CHECK(good == tried && allowed > 50 && !outside);
}

/* Each function that writes, to each address: only what may be written differs afterwards. */
static void test_writes_stay_in_their_windows(void)
{
	static const int functions[] = { PDU_SET_COIL, PDU_SET_REGISTER, PDU_SET_COILS, PDU_SET_REGISTERS,
					 PDU_MASK, PDU_BOTH };
	int good = 0, tried = 0, allowed = 0;

	for (size_t f = 0; f < sizeof(functions) / sizeof(functions[0]); f++) {
		for (int at = 0; at < 65536; at++) {
			const enum io_table table = functions[f] == PDU_SET_COIL || functions[f] == PDU_SET_COILS ?
						    TABLE_COIL : TABLE_HOLDING_REGISTER;
			const bool several = functions[f] == PDU_SET_COILS || functions[f] == PDU_SET_REGISTERS ||
					     functions[f] == PDU_BOTH;
			const int count = several ? 2 : 1;
			const bool bits[2] = { true, true };
			const uint16_t words[2] = { 0xabcd, 0xabce };
			const bool right = may_all(table, at, count, true);
			static uint16_t before[WINDOWS][64];
			struct pdu request, answer;
			bool same = true;

			reset();
			memcpy(before, value, sizeof(before));
			if (functions[f] == PDU_MASK) {
				pdu_mask(&request, (uint16_t)at, 0xffff, 0xabcd);
			} else if (functions[f] == PDU_BOTH) {
				/* It reads a window that it may read. */
				request = (struct pdu){ .len = 14, .byte = {
					PDU_BOTH, 0, 30, 0, 1, (uint8_t)(at >> 8), (uint8_t)at, 0, 2, 4,
					0xab, 0xcd, 0xab, 0xce } };
			} else if (table == TABLE_COIL) {
				pdu_set_bits(&request, (uint16_t)at, bits, count, false);
			} else {
				pdu_set_words(&request, (uint16_t)at, words, count, false);
			}
			answer = ask(request);
			for (int i = 0; i < WINDOWS; i++)
				for (int j = 0; j < 64; j++) {
					const int reg = windows[i].first + j;
					const bool here = right && windows[i].serve == 0 &&
							  windows[i].table == table && reg >= at && reg < at + count;
					const uint16_t wanted = !here ? before[i][j] : table == TABLE_COIL ? 1 :
								words[reg - at];

					same = same && value[i][j] == wanted;
				}
			tried++;
			allowed += right;
			good += same && (right ? answer.byte[0] == functions[f] :
					 is_exception(&answer, functions[f], PDU_NO_ADDRESS));
		}
	}
	CHECK(good == tried && allowed > 100 && !outside);
}

/* All other functions are exception 1, and lengths and counts of bytes that are wrong change nothing. */
static void test_other_functions_and_any_bytes(void)
{
	static uint16_t before[WINDOWS][64];
	uint32_t seed = 7;
	int good = 0, tried = 0;

	reset();
	memcpy(before, value, sizeof(before));
	for (int function = 0; function < 256; function++) {
		const bool known = (function >= 1 && function <= 6) || function == 15 || function == 16 ||
				   function == 22 || function == 23;

		for (int len = 1; !known && len < 12; len++) {
			struct pdu request = { .len = len, .byte = { (uint8_t)function, 0, 10, 0, 1 } };
			const struct pdu answer = ask(request);

			tried++;
			good += is_exception(&answer, function, PDU_NO_FUNCTION);
		}
	}
	CHECK(good == tried && memcmp(before, value, sizeof(before)) == 0);
	for (int i = 0; i < 400000; i++) {
		struct pdu request = { .len = 0 };

		seed = seed * 1664525 + 1013904223;
		request.len = (int)(seed >> 8) % 20;
		for (int j = 0; j < request.len; j++) {
			seed = seed * 1664525 + 1013904223;
			request.byte[j] = (uint8_t)(seed >> 24 & (j == 1 || j == 3 ? 0 : j == 0 ? 31 : 127));
		}
		outside = outside || ask(request).len < 2;
	}
	CHECK(!outside);
	CHECK(memcmp(before[1], value[1], sizeof(before[1])) == 0 && memcmp(before[3], value[3], 3 * sizeof(before[3])) == 0);
}

static void test_counts_and_values(void)
{
	static const uint8_t wrong[][8] = {
		{ 1, 0, 100, 0, 0 }, { 1, 0, 100, 7, 0xd1 }, { 3, 0, 10, 0, 126 }, { 4, 255, 250, 0, 0 },
		{ 5, 0, 100, 1, 0 }, { 5, 0, 100, 0xff, 1 },
	};
	struct pdu answer;

	reset();
	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		struct pdu request = { .len = 5 };

		memcpy(request.byte, wrong[i], 5);
		answer = ask(request);
		CHECK(is_exception(&answer, wrong[i][0], PDU_BAD_VALUE));
	}
	/* The values themselves: coils 100 … 111 are 1 at each third; a read over two windows. */
	answer = ask((struct pdu){ .len = 5, .byte = { 1, 0, 100, 0, 12 } });
	CHECK(answer.len == 4 && answer.byte[2] == 0x49 && answer.byte[3] == 0x02);
	answer = ask((struct pdu){ .len = 5, .byte = { 3, 0, 29, 0, 2 } });
	CHECK(answer.len == 6 && pdu_at(&answer, 0) == 19 && pdu_at(&answer, 1) == 1000);
	/* A mask changes the bits that it names; function 23 writes before it reads. */
	ask((struct pdu){ .len = 7, .byte = { 22, 0, 15, 0xff, 0xf0, 0, 0x0a } });
	CHECK(value[0][5] == 10);
	answer = ask((struct pdu){ .len = 12, .byte = { 23, 0, 11, 0, 1, 0, 11, 0, 1, 2, 9, 9 } });
	CHECK(answer.len == 4 && pdu_at(&answer, 0) == 0x0909 && value[0][1] == 0x0909);
	dead = true;
	answer = ask((struct pdu){ .len = 5, .byte = { 3, 0, 29, 0, 2 } });
	CHECK(is_exception(&answer, 3, PDU_FAILURE));
}

/* ---- frames on a serial line ---- */

static int frame(uint8_t *out, const uint8_t *byte, int len)
{
	const uint16_t crc = pdu_crc(byte, len);

	memcpy(out, byte, (size_t)len);
	out[len] = (uint8_t)crc;
	out[len + 1] = (uint8_t)(crc >> 8);
	return len + 2;
}

/* What a server with unit 5 finds in a stream that comes byte by byte. */
static int found(const uint8_t *stream, int len, int *last)
{
	uint8_t byte[SERVE_FRAME];
	int kept = 0, requests = 0, take;

	for (int i = 0; i <= len; i++) {
		const bool quiet = i == len;

		if (!quiet)
			byte[kept++] = stream[i];
		do {
			const int whole = serve_rtu(byte, kept, 5, quiet, &take);

			requests += whole > 0;
			if (whole)
				*last = byte[1];
			kept -= take;
			memmove(byte, byte + take, (size_t)kept);
		} while (take && kept);
	}
	return kept ? -1 : requests;
}

static void test_requests_in_a_stream(void)
{
	static const uint8_t read5[] = { 5, 3, 0, 10, 0, 2 }, read9[] = { 9, 3, 0, 10, 0, 2 },
			     answer9[] = { 9, 3, 4, 1, 2, 3, 4 }, set5[] = { 5, 16, 0, 10, 0, 1, 2, 7, 7 },
			     all[] = { 0, 6, 0, 10, 0, 1 }, odd5[] = { 5, 8, 0, 0, 1, 2 };
	uint8_t stream[200];
	int len = 0, last = 0, good = 0;

	len += frame(stream + len, read5, 6);
	CHECK(found(stream, len, &last) == 1 && last == 3);
	len += frame(stream + len, read9, 6);
	len += frame(stream + len, answer9, 7);
	len += frame(stream + len, set5, 9);
	CHECK(found(stream, len, &last) == 2 && last == 16);
	len += frame(stream + len, all, 6);
	CHECK(found(stream, len, &last) == 3 && last == 6);
	/* One damaged byte costs at most the frame that has it and the next one. */
	for (int i = 0; i < len; i++) {
		stream[i] ^= 0x11;
		good += found(stream, len, &last) >= 1 && found(stream, len, &last) <= 3;
		stream[i] ^= 0x11;
	}
	CHECK(good == len);
	/* A function that nobody knows ends with silence. */
	len = frame(stream, odd5, 6);
	CHECK(found(stream, len, &last) == 1 && last == 8);
	stream[len - 1] ^= 1;
	CHECK(found(stream, len, &last) == 0);
}

int main(void)
{
	test_reads_stay_in_their_windows();
	test_writes_stay_in_their_windows();
	test_other_functions_and_any_bytes();
	test_counts_and_values();
	test_requests_in_a_stream();
	return tap_done();
}
