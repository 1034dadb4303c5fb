/* SPDX-License-Identifier: MIT
 *
 * inbox - which datagram is a board's next one.
 */
#include "peer/inbox.h"

#include "engine/base/name.h"

#include <string.h>

static int find_source(const struct inbox *inbox, int bus, const char *board, size_t len)
{
	for (int i = 0; i < inbox->source_count; i++)
		if (inbox->source[i].bus == bus && name_is(inbox->source[i].board, board, len))
			return i;
	return -1;
}

static int add_source(struct inbox *inbox, const struct io_channel *channel)
{
	const int found = find_source(inbox, channel->bus, channel->device, strlen(channel->device));

	if (found >= 0)
		return found;
	inbox->source[inbox->source_count] = (struct inbox_source){ .bus = channel->bus, .board = channel->device };
	return inbox->source_count++;
}

bool inbox_open(struct inbox *inbox, const struct iomap *map, struct arena *arena)
{
	const size_t room = (size_t)map->count + 1;

	*inbox = (struct inbox){
		.source = arena_alloc(arena, room * sizeof(*inbox->source)),
		.point = arena_alloc(arena, room * sizeof(*inbox->point)),
	};
	if (!inbox->source || !inbox->point)
		return false;
	for (int i = 0; i < map->count; i++) {
		const struct io_point *point = &map->point[i];
		const struct io_channel *channel = point->channel;

		if (point->driver != DRIVER_peer || point->output || !channel || !channel->device || !channel->name)
			continue;
		inbox->point[inbox->point_count++] = (struct inbox_point){
			.point = (uint32_t)i, .source = add_source(inbox, channel), .name = channel->name,
			.raw = channel->raw, .stale_ns = channel->stale_ns,
		};
	}
	return true;
}

/* Is this its next datagram? Also counts those between that never came. */
static bool is_next(struct inbox_source *source, const struct peer_head *head, uint32_t address, int64_t now_ns)
{
	const int32_t step = (int32_t)(head->sequence - source->sequence);
	const bool same_run = source->heard && head->run == source->run;
	const bool speaks = source->heard && now_ns - source->heard_ns < INBOX_FORGET_NS;

	if (speaks && address != source->address)
		return false; /* two boards have one name, or somebody claims to be it */
	if (source->heard && !same_run && head->run == source->run_before)
		return false; /* of before its last start */
	if (speaks && same_run && step <= 0)
		return false;
	if (same_run && step > 0)
		source->lost += (uint64_t)step - 1;
	if (!same_run)
		source->run_before = source->run;
	source->heard = true;
	source->address = address;
	source->run = head->run;
	source->sequence = head->sequence;
	source->heard_ns = now_ns;
	return true;
}

static int put_value(const struct inbox *inbox, int source, const struct peer_head *head,
		     const struct peer_value *value, inbox_put *put, void *context)
{
	int count = 0;

	for (int i = 0; i < inbox->point_count; i++) {
		const struct inbox_point *point = &inbox->point[i];
		union iec_value raw = { .i = 0 };
		bool fits;

		if (point->source != source || !name_is(point->name, value->name, value->name_len) ||
		    head->age_ms * INT64_C(1000000) > point->stale_ns)
			continue;
		fits = peer_convert(value->type, value->value, point->raw, &raw);
		put(context, point->point, point->raw, fits ? raw : (union iec_value){ .i = 0 }, fits && value->good);
		count++;
	}
	return count;
}

int inbox_take(struct inbox *inbox, int bus, const uint8_t *bytes, size_t len, uint32_t address, uint64_t own,
	       int64_t now_ns, inbox_put *put, void *context)
{
	struct wire_reader values;
	struct peer_head head;
	struct peer_value value;
	int at, count = 0;

	if (!peer_read(bytes, len, &head, &values) || head.run == own)
		return 0;
	at = find_source(inbox, bus, head.board, head.board_len);
	if (at < 0)
		return 0;
	if (!is_next(&inbox->source[at], &head, address, now_ns)) {
		inbox->source[at].refused++;
		return 0;
	}
	inbox->source[at].taken++;
	/* While no program runs there, its variables do not move: they become stale here. */
	while (!(head.flags & PEER_HELD) && peer_next(&values, &value))
		count += put_value(inbox, at, &head, &value, put, context);
	return count;
}
