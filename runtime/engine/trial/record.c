/* SPDX-License-Identifier: MIT
 *
 * record - frames of a twin's state in a ring, each with the acts until the next one.
 *
 * A frame is the state right after a scan. Acts that were done after that very scan stand
 * in it, too, and come before the next scan.
 */
#include "engine/trial/record.h"

#include <stdlib.h>
#include <string.h>

#define APART_LEAST 16 /* scans from frame to frame: a copy should cost less than they */

struct done {
	uint64_t after;
	struct act act;
	struct iec_string *text; /* its own; NULL: the value is no text       */
};
struct frame {
	uint64_t scan;
	uint8_t *state;
	size_t size;
	struct done *done;
	size_t count, room;
};
struct record {
	struct twin model;        /* whose programs it is of                   */
	struct frame *frame;     /* a ring                                    */
	size_t first, count, room;
	uint64_t apart;          /* scans from one frame to the next          */
	uint64_t last;           /* scan that was recorded last               */
	uint64_t serial;         /* another one whenever it begins anew       */
	size_t bytes, most;
};

static struct frame *frame_at(const struct record *record, size_t index)
{
	return &record->frame[(record->first + index) % record->room];
}

/* ---- the state of a resource without the forces that it could have ---- */

static size_t packed_size(const struct resource *resource, size_t memory)
{
	return sizeof(*resource) - sizeof(resource->image.force) + memory +
	       (size_t)resource->image.force_count * sizeof(struct force);
}

static void put(uint8_t **at, const void *from, size_t size)
{
	memcpy(*at, from, size);
	*at += size;
}

static void get(const uint8_t **at, void *to, size_t size)
{
	memcpy(to, *at, size);
	*at += size;
}

#define FORCES_AT (offsetof(struct resource, image) + offsetof(struct image, force))
#define BEHIND_AT (FORCES_AT + sizeof(((struct image *)0)->force))

static void pack(uint8_t **at, const struct resource *resource, size_t memory)
{
	const uint8_t *bytes = (const uint8_t *)resource;

	put(at, bytes, FORCES_AT);
	put(at, bytes + BEHIND_AT, sizeof(*resource) - BEHIND_AT);
	put(at, resource->image.force,
	    (size_t)resource->image.force_count * sizeof(struct force));
	put(at, resource->image.memory, memory);
}

static void unpack(const uint8_t **at, struct resource *resource, size_t memory)
{
	uint8_t *bytes = (uint8_t *)resource, *own = resource->image.memory;

	get(at, bytes, FORCES_AT);
	get(at, bytes + BEHIND_AT, sizeof(*resource) - BEHIND_AT);
	get(at, resource->image.force,
	    (size_t)resource->image.force_count * sizeof(struct force));
	resource->image.memory = resource->vm.memory = own;
	get(at, own, memory);
}

static size_t state_size(const struct twin *twin)
{
	size_t size = packed_size(&twin->resource, twin->memory_size) +
		      sizeof(twin->now_ns) + sizeof(twin->period_ns);

	if (twin->plant.image.program)
		size += packed_size(&twin->plant, twin->plant_size);
	return size;
}

static void state_keep(const struct twin *twin, uint8_t *at)
{
	put(&at, &twin->now_ns, sizeof(twin->now_ns));
	put(&at, &twin->period_ns, sizeof(twin->period_ns));
	pack(&at, &twin->resource, twin->memory_size);
	if (twin->plant.image.program)
		pack(&at, &twin->plant, twin->plant_size);
}

static void state_restore(struct twin *twin, const struct frame *frame)
{
	const uint8_t *at = frame->state;

	get(&at, &twin->now_ns, sizeof(twin->now_ns));
	get(&at, &twin->period_ns, sizeof(twin->period_ns));
	unpack(&at, &twin->resource, twin->memory_size);
	if (twin->plant.image.program)
		unpack(&at, &twin->plant, twin->plant_size);
	twin->scan = frame->scan;
}

/* ---- frames ---- */

static void drop_first(struct record *record)
{
	struct frame *frame = frame_at(record, 0);

	for (size_t i = 0; i < frame->count; i++)
		free(frame->done[i].text);
	record->bytes -= frame->size + frame->room * sizeof(*frame->done);
	free(frame->done);
	free(frame->state);
	memset(frame, 0, sizeof(*frame));
	record->first = (record->first + 1) % record->room;
	record->count--;
}

static bool make_room(struct record *record)
{
	const size_t room = record->room ? 2 * record->room : 64;
	struct frame *frame;

	if (record->count < record->room)
		return true;
	frame = calloc(room, sizeof(*frame));
	if (!frame)
		return false;
	for (size_t i = 0; i < record->count; i++)
		frame[i] = *frame_at(record, i);
	free(record->frame);
	record->frame = frame;
	record->first = 0;
	record->room = room;
	return true;
}

static bool add_frame(struct record *record, const struct twin *twin)
{
	const size_t size = state_size(twin);
	uint8_t *state = malloc(size);
	struct frame *frame;

	if (!state || !make_room(record)) {
		free(state);
		return false;
	}
	state_keep(twin, state);
	frame = frame_at(record, record->count++);
	*frame = (struct frame){ .scan = twin->scan, .state = state, .size = size };
	record->bytes += size;
	record->last = twin->scan;
	while (record->bytes > record->most && record->count > 1)
		drop_first(record);
	return true;
}

static bool begin_anew(struct record *record, const struct twin *twin)
{
	while (record->count)
		drop_first(record);
	record->serial++;
	return add_frame(record, twin);
}

struct record *record_new(const struct twin *twin, uint64_t scans, size_t bytes)
{
	struct record *record = calloc(1, sizeof(*record));

	if (!record)
		return NULL;
	record->most = bytes;
	record->apart = 1 + scans * state_size(twin) / (bytes ? bytes : 1);
	if (record->apart < APART_LEAST)
		record->apart = APART_LEAST;
	if (!twin_clone(&record->model, twin) || !begin_anew(record, twin)) {
		record_free(record);
		return NULL;
	}
	return record;
}

void record_free(struct record *record)
{
	if (!record)
		return;
	while (record->count)
		drop_first(record);
	twin_free(&record->model);
	free(record->frame);
	free(record);
}

static bool make_room_for_act(struct record *record, struct frame *frame)
{
	const size_t room = frame->room ? 2 * frame->room : 4;
	struct done *done;

	if (frame->count < frame->room)
		return true;
	done = realloc(frame->done, room * sizeof(*done));
	if (!done)
		return false;
	record->bytes += (room - frame->room) * sizeof(*done);
	frame->done = done;
	frame->room = room;
	return true;
}

static bool is_text(const struct act *act)
{
	return act->kind == ACT_SET && act->at.type == IEC_STRING;
}

bool record_act(struct record *record, const struct twin *twin, const struct act *act)
{
	struct frame *frame = frame_at(record, record->count - 1);
	struct done done = { .after = twin->scan, .act = *act };

	if (is_text(act)) {
		const size_t size = sizeof(*act->value.s) + act->value.s->length;

		done.text = malloc(size);
		if (!done.text)
			return begin_anew(record, twin), false;
		memcpy(done.text, act->value.s, size);
		done.act.value.s = done.text;
	}
	if (!make_room_for_act(record, frame)) {
		free(done.text);
		return begin_anew(record, twin), false;
	}
	frame->done[frame->count++] = done;
	return true;
}

bool record_scan(struct record *record, const struct twin *twin)
{
	const struct frame *frame = frame_at(record, record->count - 1);

	record->last = twin->scan;
	if (twin->scan - frame->scan < record->apart)
		return true;
	return add_frame(record, twin) || (begin_anew(record, twin), false);
}

uint64_t record_first(const struct record *record)
{
	return frame_at(record, 0)->scan;
}

uint64_t record_last(const struct record *record)
{
	return record->last;
}

size_t record_bytes(const struct record *record)
{
	return sizeof(*record) + record->room * sizeof(*record->frame) + record->bytes +
	       record->model.memory_size + record->model.plant_size;
}

/* ---- looking ---- */

bool replay_init(struct replay *replay, const struct record *record)
{
	replay->serial = 0;
	return twin_clone(&replay->twin, &record->model);
}

void replay_free(struct replay *replay)
{
	twin_free(&replay->twin);
	replay->serial = 0;
}

/* The last one that is not behind @scan, which the record reaches. */
static const struct frame *frame_of(const struct record *record, uint64_t scan)
{
	size_t low = 0, high = record->count;

	while (high - low > 1) {
		const size_t middle = low + (high - low) / 2;

		if (frame_at(record, middle)->scan <= scan)
			low = middle;
		else
			high = middle;
	}
	return frame_at(record, low);
}

static bool reaches(const struct record *record, uint64_t scan)
{
	return record->count && scan >= record_first(record) && scan <= record->last;
}

static void do_again(struct twin *twin, const struct frame *frame)
{
	size_t low = 0, high = frame->count;

	while (low < high) {
		const size_t middle = low + (high - low) / 2;

		if (frame->done[middle].after < twin->scan)
			low = middle + 1;
		else
			high = middle;
	}
	for (; low < frame->count && frame->done[low].after == twin->scan; low++)
		twin_act(twin, &frame->done[low].act);
}

bool replay_next(struct replay *replay, const struct record *record)
{
	struct twin *twin = &replay->twin;
	uint64_t before;

	if (replay->serial != record->serial || !reaches(record, twin->scan) ||
	    twin->scan == record->last)
		return false;
	do_again(twin, frame_of(record, twin->scan));
	before = twin->scan;
	twin_scan(twin);
	return twin->scan != before;
}

bool replay_jump(struct replay *replay, const struct record *record, uint64_t scan)
{
	struct twin *twin = &replay->twin;
	const struct frame *frame;

	if (!reaches(record, scan))
		return false;
	frame = frame_of(record, scan);
	if (replay->serial != record->serial || twin->scan > scan ||
	    twin->scan < frame->scan) {
		state_restore(twin, frame);
		replay->serial = record->serial;
	}
	return true;
}

bool replay_seek(struct replay *replay, const struct record *record, uint64_t scan)
{
	if (!replay_jump(replay, record, scan))
		return false;
	while (replay->twin.scan < scan && replay_next(replay, record))
		;
	return replay->twin.scan == scan;
}

void record_each_act(const struct record *record, uint64_t from,
		     void (*take)(void *context, uint64_t after, const struct act *act),
		     void *context)
{
	for (size_t i = 0; i < record->count; i++) {
		const struct frame *frame = frame_at(record, i);

		for (size_t k = 0; k < frame->count; k++)
			if (frame->done[k].after >= from)
				take(context, frame->done[k].after, &frame->done[k].act);
	}
}
