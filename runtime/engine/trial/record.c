/* SPDX-License-Identifier: MIT
 *
 * record - frames of a twin's state in a ring, each with the acts until the next one.
 *
 * A frame is the state right after a scan. Acts that were done after that very scan stand
 * in it, too, and come before the next scan.
 */
#include "engine/trial/record.h"
#include "engine/trial/keep.h"

#include <stdlib.h>
#include <string.h>

#define APART_LEAST 16 /* scans from frame to frame: a copy should cost less than they */
#define BLOCK 16       /* bytes that the system takes for a block of memory  */

struct done {
	uint64_t after;
	struct act act;
	struct iec_string *text; /* its own; NULL: the value is no text       */
};
struct frame {
	uint64_t scan;
	uint8_t *state;          /* trial/keep.h: beside the record's base    */
	size_t size;
	struct done *done;
	size_t count, room;
};
struct record {
	struct twin base;        /* as it was when the record began           */
	struct frame *frame;     /* a ring                                    */
	size_t first, count, room;
	uint64_t last;           /* scan that was recorded last               */
	uint64_t serial;         /* another one whenever it begins anew       */
	uint64_t scans;          /* that should be kept                       */
	size_t bytes, most;      /* of frames, acts and texts                 */
	uint8_t *scratch;        /* where a state is put before its size is known */
	size_t scratch_size;
};

static struct frame *frame_at(const struct record *record, size_t index)
{
	return &record->frame[(record->first + index) % record->room];
}

/* ---- frames ---- */

static size_t text_size(const struct iec_string *text)
{
	return sizeof(*text) + text->length;
}

static void drop_first(struct record *record)
{
	struct frame *frame = frame_at(record, 0);

	for (size_t i = 0; i < frame->count; i++) {
		if (frame->done[i].text)
			record->bytes -= text_size(frame->done[i].text) + BLOCK;
		free(frame->done[i].text);
	}
	record->bytes -= frame->size + frame->room * sizeof(*frame->done) + 2 * BLOCK;
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

/* The state of @twin, as long as it is; NULL: no memory. */
static uint8_t *put_state(struct record *record, const struct twin *twin, size_t *size)
{
	const size_t most = keep_most(twin);
	uint8_t *state;

	if (record->scratch_size < most) {
		free(record->scratch);
		record->scratch_size = 0;
		record->scratch = malloc(most);
		if (!record->scratch)
			return NULL;
		record->scratch_size = most;
	}
	*size = keep_put(twin, &record->base, record->scratch);
	state = malloc(*size);
	if (state)
		memcpy(state, record->scratch, *size);
	return state;
}

static bool add_frame(struct record *record, const struct twin *twin)
{
	size_t size;
	uint8_t *state = put_state(record, twin, &size);
	struct frame *frame;

	if (!state || !make_room(record)) {
		free(state);
		return false;
	}
	frame = frame_at(record, record->count++);
	*frame = (struct frame){ .scan = twin->scan, .state = state, .size = size };
	record->bytes += size + 2 * BLOCK;
	record->last = twin->scan;
	while (record->bytes > record->most && record->count > 1)
		drop_first(record);
	return true;
}

/* Without memory even for one frame it is empty until there is some. */
static bool begin_anew(struct record *record, const struct twin *twin)
{
	while (record->count)
		drop_first(record);
	record->serial++;
	record->last = twin->scan;
	twin_copy(&record->base, twin);
	return add_frame(record, twin);
}

struct record *record_new(const struct twin *twin, uint64_t scans, size_t bytes)
{
	struct record *record = calloc(1, sizeof(*record));

	if (!record)
		return NULL;
	record->most = bytes;
	record->scans = scans;
	if (!twin_clone(&record->base, twin) || !begin_anew(record, twin)) {
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
	twin_free(&record->base);
	free(record->scratch);
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

static struct frame *last_frame(const struct record *record)
{
	return record->count ? frame_at(record, record->count - 1) : NULL;
}

/* The act with a text of its own. */
static bool own_text(struct record *record, struct done *done)
{
	const struct iec_string *text = done->act.value.s;
	const size_t size = text_size(text);

	done->text = malloc(size);
	if (!done->text)
		return false;
	memcpy(done->text, text, size);
	done->text->capacity = text->length;
	done->act.value.s = done->text;
	record->bytes += size + BLOCK;
	return true;
}

bool record_act(struct record *record, const struct twin *twin, const struct act *act)
{
	struct frame *frame = last_frame(record);
	struct done done = { .after = twin->scan, .act = *act };

	if (!frame || !make_room_for_act(record, frame) ||
	    (is_text(act) && !own_text(record, &done)))
		return begin_anew(record, twin) && !frame;
	frame->done[frame->count++] = done;
	return true;
}

/* Scans from a frame to the next: in proportion to what it takes, so that as many scans
 * fit as shall be kept, whatever their states look like. Acts may take as much again. */
static uint64_t apart(const struct record *record, const struct frame *frame)
{
	const uint64_t size = frame->size + 2 * BLOCK + sizeof(*frame);
	uint64_t acts = frame->room * sizeof(*frame->done);
	uint64_t scans;

	if (acts > size)
		acts = size;
	scans = 1 + record->scans * (size + acts) / (record->most ? record->most : 1);
	return scans < APART_LEAST ? APART_LEAST : scans;
}

bool record_scan(struct record *record, const struct twin *twin)
{
	const struct frame *frame = last_frame(record);

	if (!frame)
		return begin_anew(record, twin);
	record->last = twin->scan;
	if (twin->scan - frame->scan < apart(record, frame))
		return true;
	return add_frame(record, twin) || (begin_anew(record, twin), false);
}

uint64_t record_first(const struct record *record)
{
	return record->count ? frame_at(record, 0)->scan : record->last + 1;
}

uint64_t record_last(const struct record *record)
{
	return record->last;
}

size_t record_bytes(const struct record *record)
{
	return sizeof(*record) + record->room * sizeof(*record->frame) + record->bytes +
	       record->base.memory_size + record->base.plant_size +
	       record->scratch_size;
}

uint64_t record_apart(const struct record *record)
{
	return record->count ? apart(record, last_frame(record)) : APART_LEAST;
}

/* ---- looking ---- */

bool replay_init(struct replay *replay, const struct record *record)
{
	replay->serial = 0;
	return twin_clone(&replay->twin, &record->base);
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

/* False: one could not be done now, for want of memory. */
static bool do_again(struct twin *twin, const struct frame *frame)
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
		if (!twin_act(twin, &frame->done[low].act))
			return false;
	return true;
}

bool replay_next(struct replay *replay, const struct record *record)
{
	struct twin *twin = &replay->twin;
	const uint64_t before = twin->scan;

	if (replay->serial != record->serial || !reaches(record, before) ||
	    before == record->last)
		return false;
	if (do_again(twin, frame_of(record, before))) {
		twin_scan(twin);
		if (twin->scan != before)
			return true;
	}
	replay->serial = 0; /* it is half on its way: of no scan */
	return false;
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
		keep_get(twin, &record->base, frame->state);
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
