/* SPDX-License-Identifier: MIT
 *
 * test_peer - which datagram is a board's next one, and what a value of another type becomes.
 */
#include "peer/inbox.h"
#include "peer/outbox.h"

#include "tests/tap.h"

#include <string.h>

#define S INT64_C(1000000000)

struct bench {
	struct arena arena;
	struct io_channel channel;
	struct io_point point;
	struct iomap map;
	struct inbox inbox;
	int puts, bad;
	int64_t value;
};

static void bench_open(struct bench *bench, enum iec_type raw)
{
	memset(bench, 0, sizeof(*bench));
	arena_init(&bench->arena);
	bench->channel = (struct io_channel){ .raw = raw, .device = "Pump", .name = "Level", .stale_ns = S };
	bench->point = (struct io_point){ .driver = DRIVER_peer, .channel = &bench->channel };
	bench->map = (struct iomap){ .point = &bench->point, .count = 1 };
	CHECK(inbox_open(&bench->inbox, &bench->map, &bench->arena));
}

static void put(void *context, uint32_t point, enum iec_type type, union iec_value value, bool good)
{
	struct bench *bench = context;

	CHECK(point == 0 && type == bench->channel.raw);
	bench->puts++;
	bench->bad += !good;
	bench->value = value.i;
}

struct said {
	uint32_t sequence;
	uint64_t run;
	uint32_t address;
	uint8_t flags;
	bool poor;
	uint32_t age_ms;
	enum iec_type type;
	int64_t value;
};

/* How many values a datagram at @now_ns puts. */
static int say(struct bench *bench, int64_t now_ns, struct said said)
{
	struct peer_writer writer;
	const struct peer_value value = { .name = "level", .name_len = 5, .type = said.type ? said.type : IEC_INT,
					  .good = !said.poor, .value = { .i = said.value } };

	peer_begin(&writer, &(struct peer_head){ .flags = said.flags, .run = said.run ? said.run : 5, .sequence = said.sequence,
						 .age_ms = said.age_ms, .board = "pump", .board_len = 4 });
	CHECK(peer_add(&writer, &value));
	return inbox_take(&bench->inbox, 0, writer.bytes, peer_end(&writer), said.address, 77, now_ns, put, bench);
}

static void test_the_next_one(void)
{
	struct bench bench;
	const struct inbox_source *source;
	uint64_t before;

	bench_open(&bench, IEC_INT);
	source = bench.inbox.source;
	CHECK(say(&bench, S, (struct said){ .sequence = 10, .value = 3 }) == 1 && bench.value == 3);
	CHECK_AS(say(&bench, S, (struct said){ .sequence = 10 }) == 0, "it comes twice");
	CHECK_AS(say(&bench, S, (struct said){ .sequence = 9 }) == 0, "it is older");
	CHECK(say(&bench, S, (struct said){ .sequence = 13 }) == 1 && source->lost == 2 && source->refused == 2);
	CHECK_AS(say(&bench, 2 * S, (struct said){ .sequence = 14, .address = 1 }) == 0, "another one in its name");
	CHECK(say(&bench, 2 * S, (struct said){ .sequence = 1, .run = 6 }) == 1);
	CHECK_AS(say(&bench, 2 * S, (struct said){ .sequence = 99 }) == 0, "of before its last start");
	CHECK(say(&bench, 2 * S, (struct said){ .sequence = 0x7fffffff, .run = 6 }) == 1);
	CHECK(say(&bench, 2 * S, (struct said){ .sequence = 0xfffffffe, .run = 6 }) == 1);
	CHECK_AS(say(&bench, 2 * S, (struct said){ .sequence = 1, .run = 6 }) == 1, "round");
	CHECK_AS(say(&bench, 6 * S, (struct said){ .sequence = 2, .run = 9, .address = 1 }) == 0, "it spoke 4 s ago");
	CHECK_AS(say(&bench, 7 * S, (struct said){ .sequence = 2, .run = 9, .address = 1 }) == 1, "after a silence");
	CHECK_AS(say(&bench, 8 * S, (struct said){ .sequence = 3, .run = 77, .address = 1 }) == 0, "itself");
	CHECK_AS(say(&bench, 8 * S, (struct said){ .sequence = 4, .run = 9, .address = 1, .flags = PEER_HELD }) == 0, "in STOP");
	CHECK_AS(say(&bench, 8 * S, (struct said){ .sequence = 5, .run = 9, .address = 1, .age_ms = 1001 }) == 0, "too old");
	CHECK(say(&bench, 8 * S, (struct said){ .sequence = 6, .run = 9, .address = 1, .age_ms = 1000 }) == 1);
	CHECK(bench.bad == 0);
	say(&bench, 8 * S, (struct said){ .sequence = 7, .run = 9, .address = 1, .type = IEC_UINT, .value = 40000 });
	CHECK_AS(bench.bad == 1, "no value of its type");
	CHECK(say(&bench, 8 * S, (struct said){ .sequence = 8, .run = 9, .address = 1, .value = 4, .poor = true }) == 1);
	CHECK_AS(bench.bad == 2 && bench.value == 4, "an input that is stale there");
	before = source->lost;
	CHECK_AS(say(&bench, 20 * S, (struct said){ .sequence = 3, .run = 9, .address = 2 }) == 1 && source->lost == before,
		 "after a silence it may count anew");
	CHECK(say(&bench, 20 * S, (struct said){ .sequence = 5, .run = 9, .address = 2 }) == 1 && source->lost == before + 1);
	arena_free(&bench.arena);
}

static void test_types(void)
{
	static const struct {
		enum iec_type from;
		int64_t value;
		enum iec_type to;
		bool good;
		int64_t becomes;
	} rows[] = {
		{ IEC_INT, -2, IEC_WORD, true, 65534 }, { IEC_WORD, 65534, IEC_INT, true, -2 },
		{ IEC_INT, -2, IEC_UINT, false, 0 }, { IEC_INT, 300, IEC_SINT, false, 0 },
		{ IEC_INT, -128, IEC_SINT, true, -128 }, { IEC_SINT, -1, IEC_DINT, true, -1 },
		{ IEC_UINT, 65535, IEC_DINT, true, 65535 }, { IEC_BOOL, 1, IEC_INT, true, 1 },
		{ IEC_INT, 1, IEC_BOOL, true, 1 }, { IEC_INT, 2, IEC_BOOL, false, 0 },
		{ IEC_WORD, 65535, IEC_DINT, true, 65535 }, { IEC_DINT, -1, IEC_WORD, false, 0 },
		{ IEC_ULINT, -1, IEC_LINT, false, 0 }, { IEC_ULINT, -1, IEC_LWORD, true, -1 },
		{ IEC_LINT, -1, IEC_ULINT, false, 0 }, { IEC_LINT, 5, IEC_ULINT, true, 5 },
		{ IEC_INT, 1, IEC_REAL, false, 0 }, { IEC_TIME, 1, IEC_LINT, false, 0 },
		{ IEC_REAL, 1, IEC_INT, false, 0 }, { IEC_LINT, 1, IEC_TIME, false, 0 },
		{ IEC_BYTE, 1, IEC_BOOL, true, 1 }, { IEC_BYTE, 2, IEC_BOOL, false, 0 }, { IEC_BOOL, 1, IEC_BYTE, true, 1 },
		{ IEC_USINT, 1, IEC_BOOL, true, 1 }, { IEC_BOOL, 1, IEC_SINT, true, 1 },
		{ IEC_ULINT, 5, IEC_DINT, true, 5 }, { IEC_ULINT, INT64_C(1) << 31, IEC_DINT, false, 0 },
		{ IEC_LINT, INT64_MIN, IEC_LWORD, true, INT64_MIN }, { IEC_LINT, -129, IEC_SINT, false, 0 },
		{ IEC_TIME, 7, IEC_TIME, true, 7 }, { IEC_TIME, 7, IEC_DATE, false, 0 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		union iec_value out = { .i = 0 };
		const bool good = peer_convert(rows[i].from, (union iec_value){ .i = rows[i].value }, rows[i].to, &out);

		if (!CHECK(good == rows[i].good && (!good || out.i == rows[i].becomes)))
			printf("# row %zu: %d %lld\n", i, good, (long long)out.i);
	}
}

/* A value of REAL is one of LREAL, and back; a number is neither. */
static void test_reals(void)
{
	union iec_value out = { .i = 0 };

	CHECK(peer_convert(IEC_REAL, (union iec_value){ .r = 1.5 }, IEC_LREAL, &out) && out.r == 1.5);
	CHECK(peer_convert(IEC_LREAL, (union iec_value){ .r = -0.25 }, IEC_REAL, &out) && out.r == -0.25);
	CHECK(!peer_convert(IEC_REAL, (union iec_value){ .r = 1.0 }, IEC_DWORD, &out));
}

/* Two values of each type in a datagram; then it is cut, grown and changed at each place. */
static void test_a_damaged_datagram(void)
{
	static const char text[] = "A_name";
	struct peer_writer writer;
	struct wire_reader values;
	struct peer_head head;
	struct peer_value value;
	uint8_t bytes[PEER_BYTES + 1];
	size_t len;
	int good = 0, types = 0, seen = 0;

	peer_begin(&writer, &(struct peer_head){ .run = 5, .sequence = 1, .age_ms = 7, .board = "pump", .board_len = 4 });
	for (int type = IEC_NONE + 1; type < IEC_TYPE_COUNT; type++)
		if (type != IEC_STRING && ++types)
			for (int i = 0; i < 2; i++)
				CHECK(peer_add(&writer, &(struct peer_value){ .name = text, .name_len = 6, .good = i, .type = (enum iec_type)type }));
	len = peer_end(&writer);
	CHECK(peer_read(writer.bytes, len, &head, &values) && head.count == 2 * types && head.age_ms == 7 && head.board_len == 4);
	while (peer_next(&values, &value))
		seen += value.name_len == 6 && value.good == seen % 2;
	CHECK_AS(seen == 2 * types, "each type, good and not");
	memset(bytes, 0, sizeof(bytes));
	for (size_t cut = 0; cut <= PEER_BYTES + 1; cut++) {
		memcpy(bytes, writer.bytes, len);
		good += cut != len && peer_read(bytes, cut, &head, &values);
	}
	CHECK_AS(good == 0, "another length is no datagram");
	for (size_t at = 0; at < len; at++)
		for (int bit = 0; bit < 8; bit++) {
			memcpy(bytes, writer.bytes, len);
			bytes[at] ^= (uint8_t)(1 << bit);
			good += peer_read(bytes, len, &head, &values);
		}
	CHECK_AS(good == 0, "with a changed bit it is none");
}

/* One that has no values, and one that has no room for a further one. */
static void test_room(void)
{
	struct peer_writer writer;
	struct wire_reader values;
	struct peer_head head;
	struct peer_value value = { .name = "abcdefghijklmnopqrstuvwxyz", .name_len = 26, .good = true, .type = IEC_LREAL };
	int count = 0;
	size_t len;

	peer_begin(&writer, &(struct peer_head){ .run = 5, .sequence = 1, .board = "pump", .board_len = 4 });
	len = peer_end(&writer);
	CHECK(peer_read(writer.bytes, len, &head, &values) && head.count == 0 && !peer_next(&values, &value));
	peer_begin(&writer, &(struct peer_head){ .run = 5, .sequence = 1, .board = "pump", .board_len = 4 });
	value = (struct peer_value){ .name = "abcdefghijklmnopqrstuvwxyz", .name_len = 26, .good = true, .type = IEC_LREAL };
	while (peer_add(&writer, &value))
		count++;
	CHECK(count > 30 && !peer_add(&writer, &value));
	value = (struct peer_value){ .name = "a", .name_len = 1, .good = true, .type = IEC_BOOL };
	while (peer_add(&writer, &value))
		count++;
	len = peer_end(&writer);
	CHECK(len <= PEER_BYTES && peer_read(writer.bytes, len, &head, &values) && head.count == count);
}

/* Boards of one name on two buses are two boards; other points of the map are left alone. */
static void test_boards_and_points(void)
{
	struct io_channel channel[6];
	struct io_point point[8];
	struct iomap map = { .point = point, .count = 8 };
	struct bench bench;

	memset(&bench, 0, sizeof(bench));
	memset(point, 0, sizeof(point));
	arena_init(&bench.arena);
	bench.channel.raw = IEC_INT;
	for (int i = 0; i < 6; i++)
		channel[i] = (struct io_channel){ .raw = IEC_INT, .bus = i % 2, .device = "Pump", .name = i < 4 ? "Level" : "Flow", .stale_ns = S };
	for (int i = 0; i < 8; i++)
		point[i] = (struct io_point){ .driver = DRIVER_peer, .channel = i < 6 ? &channel[i] : NULL };
	point[2].driver = DRIVER_modbus;
	point[3].output = true;
	channel[4].device = NULL;
	channel[5].name = NULL;
	CHECK(inbox_open(&bench.inbox, &map, &bench.arena));
	CHECK(bench.inbox.source_count == 2 && bench.inbox.point_count == 2 && bench.inbox.point[1].point == 1);
	CHECK_AS(say(&bench, S, (struct said){ .sequence = 10, .value = 3 }) == 1 && bench.value == 3, "it comes on bus 0");
	CHECK(bench.inbox.source[0].taken == 1 && bench.inbox.source[1].taken == 0 && !bench.inbox.source[1].heard);
	arena_free(&bench.arena);
}

static void test_no_memory(void)
{
	static const char *names[1] = { "Level" };
	struct io_publish line = { .as = "pump", .name = names, .count = 1, .every_ns = S };
	struct io_net net = { .publish = &line, .publish_count = 1 };
	struct iomap map = { .net = &net }, none = { .net = NULL };
	struct peer_writer writer;
	struct outbox outbox;
	struct inbox inbox;
	struct arena arena;

	arena_init(&arena);
	CHECK_AS(outbox_open(&outbox, &none, 5, &arena) && outbox_due(&outbox) == INT64_MAX && !outbox_line_due(&outbox, S), "no line: never");
	CHECK(outbox_open(&outbox, &map, 5, &arena) && outbox_due(&outbox) == 0);
	/* ladderd has not told its value yet: a datagram goes, without it. */
	CHECK(outbox_write(&outbox, outbox_line_due(&outbox, S), 0, 0, &writer) && writer.count == 0);
	arena.failed = true;
	CHECK(!inbox_open(&inbox, &map, &arena) && !outbox_open(&outbox, &map, 5, &arena));
	arena_free(&arena);
}

/* Three lines of 100 variables: each is sent whole, in as few datagrams as it takes. */
static void test_a_long_line(void)
{
	static const char *names[100];
	static struct io_publish lines[2];
	struct io_net net = { .publish = lines, .publish_count = 2 };
	struct iomap map = { .net = &net };
	struct peer_writer writer;
	struct outbox outbox;
	struct arena arena;
	uint32_t sent = 0, datagrams = 0;
	struct outbox_line *line;

	arena_init(&arena);
	for (int i = 0; i < 100; i++)
		names[i] = "A_name_of_40_characters_as_they_may_well_be";
	lines[0] = (struct io_publish){ .as = "pump", .name = names, .count = 100, .every_ns = S / 10 };
	lines[1] = (struct io_publish){ .as = "PUMP", .name = names, .count = 1, .every_ns = S };
	CHECK(outbox_open(&outbox, &map, 5, &arena) && outbox.value_count == 101);
	for (uint32_t i = 0; i < 101; i++)
		outbox.value[i] = (struct outbox_value){ .name = names[0], .known = true, .good = true, .type = IEC_LINT };
	line = outbox_line_due(&outbox, 5 * S);
	CHECK(line == &outbox.line[0] && line->due_ns == 5 * S + S / 10);
	while (outbox_write(&outbox, line, 0, 0, &writer)) {
		struct wire_reader values;
		struct peer_value value;
		struct peer_head head;

		CHECK(peer_read(writer.bytes, peer_end(&writer), &head, &values) && head.sequence == ++datagrams);
		while (peer_next(&values, &value))
			sent++;
	}
	CHECK(sent == 100 && datagrams == 4);
	line = outbox_line_due(&outbox, 5 * S);
	CHECK(line == &outbox.line[1] && outbox_write(&outbox, line, 0, 0, &writer) && outbox.line[0].sequence == 5);
	CHECK(!outbox_line_due(&outbox, 5 * S) && outbox_due(&outbox) == 5 * S + S / 10);
	line = outbox_line_due(&outbox, 5 * S + S / 2);
	CHECK_AS(line && line->due_ns == 5 * S + 6 * S / 10, "what is over is left out");
	arena_free(&arena);
}

int main(void)
{
	test_the_next_one();
	test_types();
	test_reals();
	test_a_damaged_datagram();
	test_room();
	test_boards_and_points();
	test_no_memory();
	test_a_long_line();
	return tap_done();
}
