/* SPDX-License-Identifier: MIT
 *
 * fuzz_peer - gives any bytes to ladder-peer as datagrams of its network.
 *
 * Each datagram is: u8 options, u16 its length, the bytes. Options: 1: with a good checksum; 2: of another address; 4: some
 * seconds later. What is taken is written again and read again.
 */
#include "peer/inbox.h"
#include "peer/outbox.h"
#include "tests/fuzz/fuzz.h"

#include "engine/base/digest.h"

#include <stdlib.h>
#include <string.h>

#define POINTS 4
static const enum iec_type raws[POINTS] = { IEC_INT, IEC_BOOL, IEC_REAL, IEC_ULINT };

struct rig {
	struct arena arena;
	struct io_point point[POINTS];
	struct io_channel channel[POINTS];
	struct iomap map;
	struct inbox inbox;
	int puts;
};

static void rig_open(struct rig *rig)
{
	static const char *const names[POINTS] = { "Level", "Running", "Flow", "Level" };

	memset(rig, 0, sizeof(*rig));
	arena_init(&rig->arena);
	for (int i = 0; i < POINTS; i++) {
		rig->channel[i] = (struct io_channel){ .raw = raws[i], .device = i == 3 ? "tank" : "pump", .name = names[i],
						       .stale_ns = 1000000000 };
		rig->point[i] = (struct io_point){ .driver = DRIVER_peer, .channel = &rig->channel[i] };
	}
	rig->map = (struct iomap){ .point = rig->point, .count = POINTS };
	fuzz_expect(inbox_open(&rig->inbox, &rig->map, &rig->arena) && rig->inbox.source_count == 2 &&
		    rig->inbox.point_count == POINTS, "the points of other boards");
}

static void put(void *context, uint32_t point, enum iec_type type, union iec_value value, bool good)
{
	struct rig *rig = context;
	const struct iec_type_row *row = iec_type_row(type);

	(void)good;
	rig->puts++;
	fuzz_expect(point < POINTS && type == raws[point], "a point gets its type");
	fuzz_expect(row->class & CLASS_REAL || iec_is_wide(type) || (value.i >= row->low && value.i <= row->high),
		    "its type holds the value");
}

/* What was read is written as the same bytes. */
static void write_again(const uint8_t *bytes, size_t len)
{
	static struct peer_writer writer;
	struct wire_reader values;
	struct peer_value value;
	struct peer_head head;

	if (!peer_read(bytes, len, &head, &values))
		return;
	peer_begin(&writer, &head);
	while (peer_next(&values, &value))
		fuzz_expect(peer_add(&writer, &value), "there is room");
	fuzz_expect(peer_end(&writer) == len, "a datagram has as many bytes again");
	fuzz_expect(memcmp(writer.bytes, bytes, 4) == 0, "of the same kind");
}

static void set_sum(uint8_t *bytes, size_t len)
{
	const uint32_t sum = len >= 4 ? digest_crc32c(0, bytes, len - 4) : 0;

	for (size_t i = 0; len >= 4 && i < 4; i++)
		bytes[len - 4 + i] = (uint8_t)(sum >> 8 * i);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t len)
{
	uint8_t *datagram = malloc(2048);
	int64_t now_ns = 1;
	struct rig rig;
	size_t at = 0;

	rig_open(&rig);
	while (datagram && len - at > 3) {
		const uint8_t options = bytes[at];
		size_t count = (size_t)bytes[at + 1] | (size_t)(bytes[at + 2] & 7) << 8;

		at += 3;
		count = count < len - at ? count : len - at;
		memcpy(datagram, bytes + at, count);
		at += count;
		if (options & 1)
			set_sum(datagram, count);
		now_ns += options & 4 ? 3 * INT64_C(1000000000) : 1000;
		inbox_take(&rig.inbox, 0, datagram, count, options & 2 ? 7 : 9, 1, now_ns, put, &rig);
		write_again(datagram, count);
	}
	fuzz_expect(rig.inbox.source[0].taken || rig.inbox.source[1].taken || !rig.puts, "only what was taken is put");
	free(datagram);
	arena_free(&rig.arena);
	return 0;
}

static size_t add(uint8_t *out, uint32_t sequence, enum iec_type type, const char *board)
{
	static struct peer_writer writer;
	const struct peer_value value = { .name = "Level", .name_len = 5, .type = type, .good = true, .value = { .i = 7 } };
	const struct peer_value bit = { .name = "Running", .name_len = 7, .type = IEC_BOOL, .good = true, .value = { .i = 1 } };
	size_t len;

	peer_begin(&writer, &(struct peer_head){ .run = 3, .sequence = sequence, .board = board, .board_len = 4 });
	peer_add(&writer, &value);
	peer_add(&writer, &bit);
	len = peer_end(&writer);
	out[0] = 1;
	out[1] = (uint8_t)len;
	out[2] = (uint8_t)(len >> 8);
	memcpy(out + 3, writer.bytes, len);
	return 3 + len;
}

/* Datagrams of two boards, one after another. */
uint8_t *fuzz_seed(const uint8_t *bytes, size_t len, size_t *out_len)
{
	uint8_t *seed = malloc(1024);
	size_t at = 0;

	(void)bytes, (void)len;
	if (!seed)
		return NULL;
	at += add(seed + at, 1, IEC_INT, "pump");
	at += add(seed + at, 2, IEC_WORD, "pump");
	at += add(seed + at, 3, IEC_ULINT, "tank");
	*out_len = at;
	return seed;
}
