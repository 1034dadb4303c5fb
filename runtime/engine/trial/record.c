/* SPDX-License-Identifier: MIT
 *
 * record - frames of a twin's state in a ring, each with the acts until the next one.
 *
 * A frame is the state right after a scan. Acts after that scan are stored in the
 * frame, too, and are repeated before the next scan.
 */
#include "engine/trial/record.h"

#include "engine/trial/twin.h"

#include <stdlib.h>
#include <string.h>

#define APART_LEAST 16 /* scans between frames: a copy should cost less */
#define BLOCK 16       /* overhead of a block of malloc()                    */

struct done {
	uint64_t after;
	struct act act;
	struct iec_string *text; /* owned copy; NULL: the value is no text    */
};
struct frame {
	uint64_t scan;
	uint8_t *state;          /* difference from the record's base         */
	size_t size;
	struct done *done;
	size_t count, room;
};
struct record {
	struct twin base;        /* the state when the record began           */
	struct frame *frame;     /* a ring                                    */
	size_t first, count, room;
	uint64_t last;           /* scan that was recorded last               */
	uint64_t serial;         /* a new number whenever it begins anew      */
	uint64_t scans;          /* number to keep                            */
	size_t bytes, most;      /* of frames, acts and texts                 */
	uint8_t *scratch;        /* buffer for a state of unknown size */
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

struct times { int64_t now_ns, period_ns; uint64_t scan; };

/* ---- the state of a twin ---- */

/* With that of the plant, which follows the program's. */
static size_t memory_of(const struct twin *twin)
{
	return twin->memory_size + twin->plant_size;
}

/* Bytes that a state takes at most.   Scan-safe: yes. */
static size_t keep_most(const struct twin *twin)
{
	/* Both resources contain their forces. */
	const size_t size = memory_of(twin) + 2 * sizeof(twin->resource) +
			    sizeof(struct times);

	/* A byte for each word and each run; incomplete words. */
	return size + size / 4 + 4 * 8 * LIMIT_FORCES;
}

#define SAME 0x00u
#define RUN_SAME 128
#define RUN_OTHER 64

static uint64_t difference(const uint8_t *a, const uint8_t *b, size_t size)
{
	uint64_t x = 0, y = 0;

	memcpy(&x, a, size < 8 ? size : 8);
	memcpy(&y, b, size < 8 ? size : 8);
	return x ^ y;
}
#define BITS 0x80u
#define REST 0xc0u

#define ONES UINT64_C(0x0101010101010101)

static unsigned kind_of(uint64_t differs)
{
	return !differs ? SAME : differs & ~ONES ? REST : BITS;
}

static uint8_t *put_word(uint8_t *to, uint64_t differs, unsigned kind)
{
	uint8_t *mask = to++;

	*mask = 0;
	for (int i = 0; i < 8; i++) {
		const uint8_t byte = (uint8_t)(differs >> 8 * i);

		if (!byte)
			continue;
		*mask |= (uint8_t)(1u << i);
		if (kind == REST)
			*to++ = byte;
	}
	return to;
}

/* Writes the words from @at on that are of the same kind. */
static uint8_t *put_run(uint8_t *to, const uint8_t *a, const uint8_t *b, size_t size,
			size_t *at)
{
	const unsigned kind = kind_of(difference(a + *at, b + *at, size - *at));
	const unsigned most = kind == SAME ? RUN_SAME : RUN_OTHER;
	uint8_t *head = to++;
	unsigned words = 0;

	while (*at < size && words < most) {
		const uint64_t differs = difference(a + *at, b + *at, size - *at);

		if (kind_of(differs) != kind)
			break;
		if (kind != SAME)
			to = put_word(to, differs, kind);
		*at += 8;
		words++;
	}
	*head = (uint8_t)(kind | (words - 1));
	return to;
}

static uint8_t *put(uint8_t *to, const void *a, const void *b, size_t size)
{
	for (size_t at = 0; at < size; )
		to = put_run(to, a, b, size, &at);
	return to;
}

/* The size of a resource's state without unused entries for forces. */
#define FORCES_AT (offsetof(struct resource, image) + offsetof(struct image, force))
#define BEHIND_AT (FORCES_AT + sizeof(((struct image *)0)->force))

/* ---- the state of a resource ---- */

static const struct force no_force;

static uint8_t *put_resource(uint8_t *to, const struct resource *a,
			     const struct resource *b)
{
	const uint8_t *x = (const uint8_t *)a, *y = (const uint8_t *)b;

	to = put(to, x, y, FORCES_AT);
	to = put(to, x + BEHIND_AT, y + BEHIND_AT, sizeof(*a) - BEHIND_AT);
	for (int i = 0; i < a->image.force_count; i++)
		to = put(to, &a->image.force[i], &no_force, sizeof(no_force));
	return to;
}

/* Writes the difference between @twin and @base to @to
 * @to: keep_most() bytes Returns the bytes written. Scan-safe: as twin_copy(). */
static size_t keep_put(const struct twin *twin, const struct twin *base, uint8_t *to)
{
	const struct times now = { twin->now_ns, twin->period_ns, twin->scan };
	const struct times then = { base->now_ns, base->period_ns, base->scan };
	uint8_t *at = put(to, &now, &then, sizeof(now));

	at = put_resource(at, &twin->resource, &base->resource);
	if (twin->plant.image.program)
		at = put_resource(at, &twin->plant, &base->plant);
	at = put(at, twin->resource.image.memory, base->resource.image.memory,
		 memory_of(twin));
	return (size_t)(at - to);
}

/* The state of @twin in a block of its size; NULL: no memory. */
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

/* If there is no memory for one frame, it is empty until there is some. */
static bool begin_anew(struct record *record, const struct twin *twin)
{
	while (record->count)
		drop_first(record);
	record->serial++;
	record->last = twin->scan;
	twin_copy(&record->base, twin);
	return add_frame(record, twin);
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

/* Copies the text of the act. */
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

/* Scans from a frame to the next: proportional to the size of the frame, so that the
 * wanted number of scans fits into memory. Acts may take as much memory as frames. */
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

/* ---- reading ---- */

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

/* The last frame at or before @scan, which is in the record. */
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

/* False: an act could not be repeated, as memory is out. */
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
	replay->serial = 0; /* its state is between two scans */
	return false;
}

static const uint8_t *get_word(const uint8_t *from, uint8_t *out, size_t size, bool bits)
{
	const uint8_t mask = *from++;

	for (size_t i = 0; i < 8; i++)
		if (mask >> i & 1) {
			const uint8_t byte = bits ? 1 : *from++;

			if (i < size)
				out[i] ^= byte;
		}
	return from;
}

static const uint8_t *get(const uint8_t *from, void *out, const void *base, size_t size)
{
	uint8_t *bytes = out;
	size_t at = 0;

	memmove(bytes, base, size);
	while (at < size) {
		const unsigned head = *from++;
		size_t words = head < BITS ? head + 1 : (head & (RUN_OTHER - 1)) + 1;

		for (; words; words--, at += 8)
			if (head >= BITS)
				from = get_word(from, bytes + at, size - at, head < REST);
	}
	return from;
}

static const uint8_t *get_resource(const uint8_t *from, struct resource *out,
				   const struct resource *base)
{
	uint8_t *x = (uint8_t *)out, *own = out->image.memory;
	const uint8_t *y = (const uint8_t *)base;

	from = get(from, x, y, FORCES_AT);
	from = get(from, x + BEHIND_AT, y + BEHIND_AT, sizeof(*out) - BEHIND_AT);
	for (int i = 0; i < out->image.force_count; i++)
		from = get(from, &out->image.force[i], &no_force, sizeof(no_force));
	out->image.memory = out->vm.memory = own;
	return from;
}

/* Restores the state at @from to @twin. @base: the same as in keep_put().
 * Scan-safe: as twin_copy(). */
static void keep_get(struct twin *twin, const struct twin *base, const uint8_t *from)
{
	struct times now;
	const struct times then = { base->now_ns, base->period_ns, base->scan };

	from = get(from, &now, &then, sizeof(now));
	from = get_resource(from, &twin->resource, &base->resource);
	if (twin->plant.image.program)
		from = get_resource(from, &twin->plant, &base->plant);
	get(from, twin->resource.image.memory, base->resource.image.memory,
	    memory_of(twin));
	twin->now_ns = now.now_ns;
	twin->period_ns = now.period_ns;
	twin->scan = now.scan;
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
