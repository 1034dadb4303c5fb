/* SPDX-License-Identifier: MIT
 *
 * test_wire - fields and frames: what is written is read, and nothing beyond an end.
 */
#include "online/service.h"
#include "online/status.h"

#include "engine/base/ascii.h"

#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static void test_fields_go_and_come_back(void)
{
	uint8_t bytes[64];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct wire_reader in;
	size_t len;

	wire_put_u8(&out, 0xfe);
	wire_put_u16(&out, 0x1234);
	wire_put_u32(&out, 0x89abcdef);
	wire_put_u64(&out, UINT64_C(0xfedcba9876543210));
	wire_put_i64(&out, INT64_MIN);
	wire_put_string(&out, "ab");
	CHECK(wire_len(&out) == 1 + 2 + 4 + 8 + 8 + 4);
	CHECK(bytes[1] == 0x34 && bytes[2] == 0x12); /* the low byte first */
	in = wire_read(bytes, wire_len(&out));
	CHECK(wire_u8(&in) == 0xfe && wire_u16(&in) == 0x1234 && wire_u32(&in) == 0x89abcdef);
	CHECK(wire_u64(&in) == UINT64_C(0xfedcba9876543210) && wire_i64(&in) == INT64_MIN);
	CHECK(memcmp(wire_text(&in, &len), "ab", 2) == 0 && len == 2);
	CHECK(wire_done(&in) && wire_left(&in) == 0);
	CHECK(wire_u8(&in) == 0 && in.failed && !wire_done(&in));
}

/* After the first read past the end all later ones fail, also shorter ones. */
static void test_a_reader_stays_failed(void)
{
	const uint8_t bytes[] = { 1, 2, 3 };

	for (size_t len = 0; len < 8; len++) {
		struct wire_reader in = wire_read(bytes, len < 3 ? len : 3);

		wire_u64(&in);
		CHECK(in.failed && wire_u8(&in) == 0 && wire_left(&in) == 0 &&
		      !wire_bytes(&in, 0));
	}
}

static void test_texts_are_bounded(void)
{
	static uint8_t bytes[2 * WIRE_TEXT_MOST];
	static char text[WIRE_TEXT_MOST + 40];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct wire_reader in;
	size_t len;

	memset(text, 'a', sizeof(text) - 1);
	memcpy(text + WIRE_TEXT_MOST - 1, "\xc3\xa4", 2); /* a character on the bound */
	wire_put_string(&out, text);
	in = wire_read(bytes, wire_len(&out));
	wire_text(&in, &len);
	CHECK(len == WIRE_TEXT_MOST - 1);
	bytes[0] = (WIRE_TEXT_MOST + 1) & 255;
	bytes[1] = (WIRE_TEXT_MOST + 1) >> 8;
	in = wire_read(bytes, sizeof(bytes));
	CHECK(*wire_text(&in, &len) == '\0' && len == 0 && in.failed);
	in = wire_read("\5\0abc", 5);
	CHECK(*wire_text(&in, &len) == '\0' && len == 0 && in.failed);
}

/* "Größe" has two bytes for each of its letters that are no ASCII: none is cut in half. */
static void test_texts_are_cut_at_whole_letters(void)
{
	static const char word[] = "Gr\303\266\303\237e";
	static const size_t whole[sizeof(word)] = { 0, 1, 2, 2, 4, 4, 6, 7 };

	for (size_t room = 1; room <= sizeof(word); room++) {
		uint8_t bytes[32];
		char text[16];
		struct wire_writer out = wire_write(bytes, sizeof(bytes));
		struct wire_reader in;

		wire_put_string(&out, word);
		in = wire_read(bytes, (size_t)(out.at - out.start));
		wire_copy_text(&in, text, room);
		CHECK(strlen(text) == whole[room - 1] && memcmp(text, word, strlen(text)) == 0 && wire_done(&in));
		CHECK(utf8_cut(word, room - 1) == whole[room - 1]);
	}
	CHECK(utf8_cut("", 5) == 0 && utf8_cut("abc", 5) == 3 && utf8_cut("\200\200", 1) == 0);
}

static void test_a_writer_stays_in_its_room(void)
{
	uint8_t bytes[16];

	for (size_t size = 0; size < 12; size++) {
		struct wire_writer out = wire_write(bytes, size);

		memset(bytes, 0xee, sizeof(bytes));
		frame_begin(&out, 1, 0, 1);
		wire_put_u32(&out, 7);
		CHECK(out.failed && bytes[size] == 0xee && frame_end(&out) == 0);
	}
}

static void test_frames_come_whole(void)
{
	uint8_t bytes[64];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct frame frame;
	size_t len, used = 99;

	frame_begin(&out, 7, WIRE_TOLD, 513);
	wire_put_u32(&out, 5);
	len = frame_end(&out);
	CHECK(len == WIRE_HEAD + 4);
	for (size_t part = 0; part < len; part++)
		CHECK(frame_next(bytes, part, &frame, &used) == FRAME_PART);
	CHECK(frame_next(bytes, sizeof(bytes), &frame, &used) == FRAME_GOOD && used == len);
	CHECK(frame.service == 7 && frame.flags == WIRE_TOLD && frame.request == 513);
	CHECK(wire_u32(&frame.body) == 5 && wire_done(&frame.body));
}

static void test_lengths_out_of_bounds_are_bad(void)
{
	static const struct { uint32_t length; enum frame_state state; } cases[] = {
		{ 0, FRAME_BAD }, { 3, FRAME_BAD }, { 4, FRAME_GOOD },
		{ WIRE_FRAME_MOST - 4, FRAME_PART }, { WIRE_FRAME_MOST - 3, FRAME_BAD },
		{ UINT32_MAX, FRAME_BAD },
	};

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		uint8_t bytes[8] = { 0 };
		struct wire_writer out = wire_write(bytes, 4);
		struct frame frame;
		size_t used;

		wire_put_u32(&out, cases[i].length);
		CHECK(frame_next(bytes, sizeof(bytes), &frame, &used) == cases[i].state);
	}
}

static union iec_value sample(enum iec_type type)
{
	if (type == IEC_REAL)
		return (union iec_value){ .r = 1.5 };
	if (type == IEC_LREAL)
		return (union iec_value){ .r = -0.1 };
	return (union iec_value){ .i = 1 };
}

static void test_values_of_every_type(void)
{
	uint8_t bytes[64];
	struct iec_text room;

	for (enum iec_type type = IEC_NONE + 1; type < IEC_STRING; type++) {
		struct wire_writer out = wire_write(bytes, sizeof(bytes));
		struct wire_reader in;

		wire_put_value(&out, type, sample(type));
		CHECK(wire_len(&out) == iec_type_row(type)->size);
		in = wire_read(bytes, wire_len(&out));
		CHECK(wire_value(&in, type, &room).i == sample(type).i && wire_done(&in));
	}
	{
		struct wire_reader in = wire_read("\3abcd", 5);
		const struct iec_string *text = wire_value(&in, IEC_STRING, &room).s;

		CHECK(text->length == 3 && memcmp(text->text, "abc", 3) == 0 && !in.failed);
		in = wire_read("\3ab", 3);
		CHECK(wire_value(&in, IEC_STRING, &room).s->length == 0 && in.failed);
		in = wire_read("\2", 1);
		wire_value(&in, IEC_BOOL, &room);
		CHECK(in.failed); /* a BOOL is 0 or 1 */
		in = wire_read("\1\1\1\1\1\1\1\1", 8);
		wire_value(&in, IEC_NONE, &room);
		CHECK(in.failed);
	}
}

static void test_a_status_comes_back_and_is_cut_nowhere(void)
{
	struct board_status *given = calloc(1, sizeof(*given));
	struct board_status *taken = calloc(1, sizeof(*taken));
	static uint8_t bytes[8192];
	struct wire_writer out = wire_write(bytes, sizeof(bytes));
	struct wire_reader in;
	/* Of a board that does not tell of its last start; of interruptions; of its disk; of its next start. */
	size_t cut_well = 0, len, newer, new, old, older;
	const size_t task = 16; /* bytes of each task's interruptions */

	given->mode = 2;
	given->scans = 77;
	given->wake_p999_ns = -5;
	given->task_count = 2;
	snprintf(given->board, sizeof(given->board), "Pi");
	snprintf(given->fault, sizeof(given->fault), "none");
	snprintf(given->task[1].name, sizeof(given->task[1].name), "Slow");
	given->task[1].max_ns = 9;
	given->speed = 5000;
	given->began = 31;
	given->began_how = 9;
	given->began_ends = 2;
	status_put(&out, given);
	len = wire_len(&out);
	wire_put_string(&out, "");
	newer = len - 1 - 2 - 4;
	new = newer - 2 * task - sizeof(given->speed);
	old = new - (wire_len(&out) - len);
	wire_put_u8(&out, 0);
	wire_put_string(&out, "");
	older = new - (wire_len(&out) - len);
	wire_put_u64(&out, 1); /* a field of a later version */
	in = wire_read(bytes, wire_len(&out));
	status_take(&in, taken);
	CHECK(!in.failed && memcmp(given, taken, sizeof(*given)) == 0);
	for (size_t part = 0; part < len; part++) {
		in = wire_read(bytes, part);
		status_take(&in, taken);
		cut_well += in.failed == (part != newer && part != new && part != new + task &&
					  part != new + 2 * task && part != old && part != older);
	}
	CHECK(cut_well == len);
	free(given);
	free(taken);
}

int main(void)
{
	test_fields_go_and_come_back();
	test_a_reader_stays_failed();
	test_texts_are_bounded();
	test_texts_are_cut_at_whole_letters();
	test_a_writer_stays_in_its_room();
	test_frames_come_whole();
	test_lengths_out_of_bounds_are_bad();
	test_values_of_every_type();
	test_a_status_comes_back_and_is_cut_nowhere();
	return tap_done();
}
