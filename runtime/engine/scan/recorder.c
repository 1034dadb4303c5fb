/* SPDX-License-Identifier: MIT
 *
 * recorder - writes records into the ring. A ring is at least eight times as large as a
 * keyframe, so the present segment and the next keyframe always have room.
 */
#include "engine/scan/recorder.h"
#include "engine/scan/place.h"

#include <string.h>

#define BAD_PART 32u /* a list of values that are not good has at most this part of the ring */
#define GAP_MOST 4u /* bytes that did not change, between two that did: one run    */

/* ---- bytes ---- */

/* A record that is being made, without long parts. */
struct record {
	uint8_t bytes[KEY_HEAD];
	uint32_t len;
};

static void put8(struct record *record, uint32_t value)
{
	record->bytes[record->len++] = (uint8_t)value;
}

static void put32(struct record *record, uint32_t value)
{
	for (int i = 0; i < 4; i++)
		put8(record, value >> 8 * i);
}

static void put64(struct record *record, uint64_t value)
{
	put32(record, (uint32_t)value);
	put32(record, (uint32_t)(value >> 32));
}

static void put_time(struct record *record, int64_t ns)
{
	put64(record, (uint64_t)ns);
}

/* 7 bits a byte, the lowest first; the top bit says that more follow. */
static void put_number(struct record *record, uint64_t value)
{
	for (; value >= 0x80; value >>= 7)
		put8(record, (uint32_t)value | 0x80);
	put8(record, (uint32_t)value);
}

/* 0, -1, 1, -2 … as 0, 1, 2, 3 … */
static void put_signed(struct record *record, int64_t value)
{
	put_number(record, (uint64_t)value << 1 ^ (value < 0 ? UINT64_MAX : 0));
}

/* ---- the ring ---- */

static uint8_t byte_at(const struct recorder *recorder, uint64_t position)
{
	const uint64_t back = recorder->head - position;

	return recorder->ring[recorder->at >= back ? recorder->at - back :
						     recorder->at + recorder->size - back];
}

static uint32_t segment_bytes(const struct recorder *recorder, uint64_t segment)
{
	uint32_t bytes = 0;

	for (uint32_t i = 0; i < 4; i++)
		bytes |= (uint32_t)byte_at(recorder, segment + 1 + i) << 8 * i;
	return bytes;
}

/* Drops the oldest segments. The present one is never needed: see recorder_begin(). */
static void make_room(struct recorder *recorder, uint32_t len)
{
	while (recorder->head + len - recorder->oldest > recorder->size &&
	       recorder->oldest != recorder->key)
		recorder->oldest += segment_bytes(recorder, recorder->oldest);
}

static void put_bytes(struct recorder *recorder, const void *bytes, uint32_t len)
{
	const uint32_t left = recorder->size - recorder->at, first = len < left ? len : left;

	make_room(recorder, len);
	memcpy(recorder->ring + recorder->at, bytes, first);
	memcpy(recorder->ring, (const uint8_t *)bytes + first, len - first);
	recorder->head += len;
	recorder->at = len < left ? recorder->at + len : len - left;
}

static void put_record(struct recorder *recorder, const struct record *record)
{
	put_bytes(recorder, record->bytes, record->len);
}

/* Tells the length of the segment that ends here. */
static void end_segment(struct recorder *recorder)
{
	const uint32_t bytes = (uint32_t)(recorder->head - recorder->key);

	for (uint32_t i = 0; i < 4; i++) {
		const uint64_t back = bytes - 1 - i;

		recorder->ring[recorder->at >= back ? recorder->at - back :
						      recorder->at + recorder->size - back] =
			(uint8_t)(bytes >> 8 * i);
	}
}

/* ---- inputs ---- */

uint32_t recorder_core(const struct program *program)
{
	return program->header->core_runs < program->run_count ?
		       program->run[program->header->core_runs].offset :
		       program->header->data_size;
}

bool recorder_input(const struct program *program, uint32_t i, uint32_t *at, uint32_t *size)
{
	static const enum iec_area area[] = { AREA_I, AREA_AI, AREA_XI, AREA_XAI };

	if (i >= RECORDER_INPUTS)
		return false;
	if (i >= RECORDER_INPUTS - 2) { /* the later ones last: old records have less */
		const bool zone = i == RECORDER_INPUTS - 2;

		*at = program->areas.at[AREA_SM] + (zone ? RESOURCE_ZONE : RESOURCE_DISK);
		*size = zone ? sizeof(int64_t) : 1;
		return true;
	}
	*at = program->areas.at[area[i]];
	*size = program->areas.bytes[area[i]];
	return true;
}

static void see_inputs(struct recorder *recorder, const struct resource *resource)
{
	uint8_t *seen = recorder->seen;

	for (uint32_t i = 0; i < recorder->input_count; i++) {
		memcpy(seen, resource->image.memory + recorder->input[i].at,
		       recorder->input[i].size);
		seen += recorder->input[i].size;
	}
}

/* The bytes from @from on that differ; gaps of a few equal ones are taken along. */
static uint32_t run_length(const uint8_t *now, const uint8_t *seen, uint32_t size)
{
	uint32_t end = 1;

	for (uint32_t i = 1; i < size && i - end < GAP_MOST; i++)
		if (now[i] != seen[i])
			end = i + 1;
	return end;
}

static void put_run(struct recorder *recorder, const uint8_t *bytes, uint32_t len, uint32_t gap)
{
	struct record head = { .len = 0 };

	put_number(&head, gap);
	put_number(&head, len);
	put_record(recorder, &head);
	put_bytes(recorder, bytes, len);
}

/* @gap: bytes since the last run that did not change. Returns those behind the last one. */
static uint32_t put_runs(struct recorder *recorder, const uint8_t *now, const uint8_t *seen,
			 uint32_t size, uint32_t gap)
{
	for (uint32_t i = 0; i < size; ) {
		uint32_t len;

		if (now[i] == seen[i]) {
			i++;
			gap++;
			continue;
		}
		len = run_length(now + i, seen + i, size - i);
		put_run(recorder, now + i, len, gap);
		gap = 0;
		i += len;
	}
	return gap;
}

static void put_inputs(struct recorder *recorder, const struct resource *resource)
{
	const uint8_t *seen = recorder->seen;
	uint32_t gap = 0;
	bool any = false;

	for (uint32_t i = 0; i < recorder->input_count; i++) {
		const uint32_t size = recorder->input[i].size;
		const uint8_t *now = resource->image.memory + recorder->input[i].at;

		if (memcmp(now, seen, size) != 0) {
			if (!any)
				put_bytes(recorder, &(uint8_t){ RECORD_INPUTS }, 1);
			any = true;
			gap = put_runs(recorder, now, seen, size, gap);
		} else {
			gap += size;
		}
		seen += size;
	}
	if (any)
		put_bytes(recorder, (uint8_t[2]){ 0, 0 }, 2);
}

/* ---- quality ---- */

static void make_bad(struct record *record, uint32_t bit, uint32_t count, bool fault)
{
	put_number(record, 2 * (uint64_t)count + fault);
	put_number(record, bit);
}

/* The runs that have no room become one, from the first place of them to the last one. */
static void add_to_rest(struct recorder *recorder)
{
	const uint32_t end = recorder->bad_at + recorder->bad_count;

	if (!recorder->rest_end || recorder->bad_at < recorder->rest_at)
		recorder->rest_at = recorder->bad_at;
	if (end > recorder->rest_end)
		recorder->rest_end = end;
	recorder->rest_fault = recorder->rest_fault || recorder->bad_fault;
}

static void end_bad(struct recorder *recorder)
{
	struct record record = { .len = 0 };

	if (!recorder->bad_count)
		return;
	make_bad(&record, recorder->bad_at, recorder->bad_count, recorder->bad_fault);
	if (recorder->head + record.len <= recorder->quality_end)
		put_record(recorder, &record);
	else
		add_to_rest(recorder);
	recorder->bad_count = 0;
}

/* Neighbours are one run. */
void recorder_bad(struct recorder *recorder, uint32_t bit, uint32_t count, bool fault)
{
	if (recorder->bad_count && recorder->bad_fault == fault &&
	    recorder->bad_at + recorder->bad_count == bit) {
		recorder->bad_count += count;
		return;
	}
	end_bad(recorder);
	recorder->bad_at = bit;
	recorder->bad_count = count;
	recorder->bad_fault = fault;
}

static void put_quality(struct recorder *recorder, uint64_t serial)
{
	struct record last = { .len = 0 };

	put_bytes(recorder, &(uint8_t){ RECORD_STATE | RECORD_QUALITY << RECORD_SUB }, 1);
	recorder->quality_end = recorder->head + recorder->size / BAD_PART;
	recorder->rest_at = recorder->rest_end = 0;
	recorder->rest_fault = false;
	if (serial)
		recorder->quality.each(recorder->quality.context, recorder);
	end_bad(recorder);
	if (recorder->rest_end)
		make_bad(&last, recorder->rest_at, recorder->rest_end - recorder->rest_at, recorder->rest_fault);
	put8(&last, 0);
	put_record(recorder, &last);
	recorder->quality_serial = serial;
}

/* A list stands until the next one, or until a keyframe. One behind a keyframe is of its state: before a list of the
 * next scan stands an empty one, then. */
static void see_quality(struct recorder *recorder)
{
	uint64_t serial;

	if (!recorder->quality.each)
		return;
	serial = recorder->quality.serial(recorder->quality.context);
	if (serial == recorder->quality_serial)
		return;
	if (recorder->head == recorder->key_end)
		put_quality(recorder, 0);
	put_quality(recorder, serial);
}

void recorder_tell_quality(struct recorder *recorder, const struct recorder_quality *quality)
{
	recorder->quality = *quality;
}

/* ---- keyframes ---- */

static void put_tasks(struct recorder *recorder, const struct resource *resource)
{
	for (uint32_t i = 0; i < resource->image.program->task_count; i++) {
		const struct task_state *state = &resource->tasks.state[i];
		struct record record = { .len = 0 };

		put_time(&record, state->next_ns);
		put_time(&record, state->began_ns);
		put8(&record, (state->began ? KEY_BEGAN : 0u) | (state->due ? KEY_DUE : 0u) |
			      (state->ran ? KEY_RAN : 0u) | (state->was ? KEY_WAS : 0u));
		put64(&record, state->runs);
		put64(&record, state->overruns);
		put32(&record, state->late_row);
		put_record(recorder, &record);
	}
}

static void put_forces(struct recorder *recorder, const struct image *image)
{
	for (int i = 0; i < image->force_count; i++) {
		const struct force *force = &image->force[i];
		struct record record = { .len = 0 };

		put32(&record, place_word(image->program, force->at));
		put64(&record, (uint64_t)force->value.i);
		put64(&record, (uint64_t)force->aside.i);
		put_record(recorder, &record);
	}
}

static uint32_t key_flags(const struct resource *resource)
{
	return (resource->halted ? KEY_HALTED : 0u) | (resource->late ? KEY_LATE : 0u) |
	       (resource->io_fault ? KEY_IO : 0u) | (resource->warm ? KEY_WARM : 0u) |
	       (resource->retain_lost ? KEY_LOST : 0u) |
	       (resource->retain_old_copy ? KEY_OLD_COPY : 0u) |
	       (resource->vm.stop ? KEY_STOP : 0u);
}

/* The head of a keyframe: KEY_HEAD bytes. */
static void put_head(struct recorder *recorder, const struct resource *resource,
		     enum record_why why)
{
	const struct program *program = resource->image.program;
	struct record record = { .len = 0 };

	put8(&record, RECORD_KEY | (uint32_t)why << RECORD_SUB);
	put32(&record, 0); /* end_segment() tells the length */
	memcpy(record.bytes + record.len, recorder->identity, 32);
	record.len += 32;
	put64(&record, recorder->scan);
	put_time(&record, recorder->now_ns);
	put_time(&record, recorder->step_ns);
	put_time(&record, recorder->wall_ns);
	put8(&record, (uint32_t)resource->state);
	put8(&record, (uint32_t)resource->fault);
	put8(&record, key_flags(resource));
	put64(&record, resource->scans);
	put_time(&record, resource->start_ns);
	put32(&record, resource->errors_before);
	put32(&record, resource->vm.errors);
	put_time(&record, resource->timers_ns);
	put32(&record, resource->scan_us);
	put32(&record, resource->scan_max_us);
	put_time(&record, resource->second_ns);
	put_time(&record, resource->day_ns);
	put_time(&record, resource->period_ns);
	put8(&record, program->task_count);
	put32(&record, (uint32_t)resource->image.force_count);
	put32(&record, recorder_core(program));
	put_record(recorder, &record);
}

static void put_key(struct recorder *recorder, const struct resource *resource,
		    enum record_why why)
{
	const uint32_t bytes = recorder->key_bytes +
			       (uint32_t)resource->image.force_count * KEY_FORCE;

	if (recorder->oldest != recorder->head)
		end_segment(recorder);
	recorder->key = recorder->head;
	make_room(recorder, bytes);
	recorder->wall_ns = resource->wall_offset_ns;
	recorder->period_ns = resource->period_ns;
	put_head(recorder, resource, why);
	put_tasks(recorder, resource);
	put_forces(recorder, &resource->image);
	put_bytes(recorder, resource->image.memory, recorder_core(resource->image.program));
	recorder->quality_serial = 0;
	recorder->key_end = 0;
	see_quality(recorder);
	recorder->key_end = recorder->quality_serial ? 0 : recorder->head;
	see_inputs(recorder, resource);
}

/* Is it time for a new segment? At most a quarter of the ring is lost with one. */
static bool is_long(const struct recorder *recorder)
{
	const uint64_t bytes = recorder->head - recorder->key;
	uint32_t most = recorder->size / 16;

	if (most < 4 * recorder->key_bytes)
		most = 4 * recorder->key_bytes;
	if (most > recorder->size / 4)
		most = recorder->size / 4;
	return bytes >= most;
}

/* ---- what happens ---- */

void recorder_init(struct recorder *recorder, uint8_t *memory, uint32_t size)
{
	memset(recorder, 0, sizeof(*recorder));
	recorder->seen = memory;
	recorder->ring = memory + RECORDER_BESIDE;
	recorder->size = size;
}

static uint32_t measure(struct recorder *recorder, const struct program *program)
{
	uint32_t i, at, size;

	for (i = 0; recorder_input(program, i, &at, &size); i++) {
		recorder->input[i].at = at;
		recorder->input[i].size = size;
	}
	recorder->input_count = i;
	return KEY_HEAD + program->task_count * KEY_TASK + recorder_core(program);
}

void recorder_begin(struct recorder *recorder, const struct resource *resource,
		    const uint8_t identity[32], enum record_why why)
{
	recorder->key_bytes = measure(recorder, resource->image.program);
	recorder->on = recorder->key_bytes + LIMIT_FORCES * KEY_FORCE <= recorder->size / 8;
	memcpy(recorder->identity, identity, sizeof(recorder->identity));
	if (recorder->on)
		put_key(recorder, resource, why);
}

void recorder_scan(struct recorder *recorder, const struct resource *resource, int64_t now_ns)
{
	const int64_t step_ns = now_ns - recorder->now_ns;
	struct record record = { .len = 0 };
	uint32_t head = RECORD_SCAN;

	recorder->scan++;
	if (!recorder->on) {
		recorder->now_ns = now_ns;
		return;
	}
	see_quality(recorder);
	put_inputs(recorder, resource);
	head |= (resource->late ? RECORD_LATE : 0u) | (resource->io_fault ? RECORD_IO : 0u) |
		(resource->watch ? RECORD_WATCH : 0u) |
		(resource->scans == 0 ? RECORD_DUE : 0u) |
		(resource->period_ns != recorder->period_ns ? RECORD_PERIOD : 0u);
	put8(&record, head);
	put_signed(&record, step_ns - recorder->step_ns);
	put_signed(&record, resource->wall_offset_ns - recorder->wall_ns);
	put_number(&record, resource->scan_us);
	if (head & RECORD_DUE)
		put_signed(&record, resource->due_ns ? now_ns - resource->due_ns : 0);
	if (head & RECORD_PERIOD)
		put_signed(&record, resource->period_ns);
	put_record(recorder, &record);
	recorder->now_ns = now_ns;
	recorder->step_ns = step_ns;
	recorder->wall_ns = resource->wall_offset_ns;
	recorder->period_ns = resource->period_ns;
}

/* How many tasks ran in the scan; 0: all that were due. */
static uint32_t tasks_cut(const struct resource *resource)
{
	bool left = false;

	for (uint32_t i = 0; i < resource->image.program->task_count; i++)
		left |= resource->tasks.state[i].due && !resource->tasks.state[i].ran;
	return left ? resource->tasks_ran : 0;
}

static void put_state(struct recorder *recorder, enum record_state state, const uint8_t *more,
		      uint32_t len)
{
	if (!recorder->on)
		return;
	put_bytes(recorder, &(uint8_t){ (uint8_t)(RECORD_STATE | (uint32_t)state << RECORD_SUB) }, 1);
	if (len)
		put_bytes(recorder, more, len);
}

/* The inputs of the interrupted task, from which a reader goes on. */
void recorder_interrupting(struct recorder *recorder, const struct resource *resource)
{
	if (recorder->on)
		see_inputs(recorder, resource);
}

/* Without this scan the records in the ring are of no use. */
static void give_up(struct recorder *recorder)
{
	recorder->on = false;
	recorder->full = true;
	recorder->oldest = recorder->key = recorder->head;
}

void recorder_interrupt(struct recorder *recorder, const struct resource *resource, int64_t now_ns)
{
	struct record record = { .len = 0 };

	if (!recorder->on)
		return;
	put_inputs(recorder, resource);
	put8(&record, RECORD_STATE | RECORD_INTERRUPTED << RECORD_SUB);
	put_number(&record, resource->vm.points);
	put_signed(&record, now_ns - recorder->now_ns);
	put_record(recorder, &record);
	if (recorder->head - recorder->key > recorder->size / 2)
		give_up(recorder);
}

void recorder_scanned(struct recorder *recorder, const struct resource *resource)
{
	const uint8_t ran = tasks_declared(resource->image.program) ?
				    (uint8_t)tasks_cut(resource) : 0;

	if (recorder->full) {
		recorder->full = false;
		recorder->on = true;
		put_key(recorder, resource, RECORD_NEXT);
	}
	if (!recorder->on)
		return;
	if (ran)
		put_state(recorder, RECORD_TASKS, &ran, 1);
	if (is_long(recorder) && resource->state == STATE_RUN)
		put_key(recorder, resource, RECORD_NEXT);
	else
		see_inputs(recorder, resource);
}

void recorder_change(struct recorder *recorder, const struct resource *resource,
		     enum record_kind kind, struct location at, union iec_value value)
{
	struct record record = { .len = 0 };

	if (!recorder->on)
		return;
	if (is_long(recorder))
		put_key(recorder, resource, RECORD_NEXT);
	put8(&record, (uint32_t)kind);
	put32(&record, place_word(resource->image.program, at));
	if (kind != RECORD_UNFORCE && at.type == IEC_STRING)
		put_number(&record, value.s->length);
	else if (kind != RECORD_UNFORCE)
		put64(&record, (uint64_t)value.i);
	put_record(recorder, &record);
	if (kind != RECORD_UNFORCE && at.type == IEC_STRING)
		put_bytes(recorder, value.s->text, value.s->length);
}

void recorder_changed(struct recorder *recorder, const struct resource *resource)
{
	if (recorder->on)
		see_inputs(recorder, resource);
}

void recorder_stopped(struct recorder *recorder)
{
	put_state(recorder, RECORD_STOPPED, NULL, 0);
}

/* Inputs may have been read without a scan. */
void recorder_failed(struct recorder *recorder, const struct resource *resource)
{
	const uint8_t fault = (uint8_t)resource->fault;

	if (!recorder->on)
		return;
	put_inputs(recorder, resource);
	see_inputs(recorder, resource);
	put_state(recorder, RECORD_FAILED, &fault, 1);
	see_quality(recorder);
}

void recorder_take(const struct recorder *recorder, struct recorder_part *part)
{
	const uint64_t from = part->from > recorder->head ? recorder->head : part->from;

	part->oldest = recorder->oldest;
	part->end = recorder->head;
	part->at = from < recorder->oldest ? recorder->oldest : from;
	part->len = recorder->head - part->at < part->room ?
			    (uint32_t)(recorder->head - part->at) : part->room;
	if (part->len) {
		const uint64_t back = recorder->head - part->at;
		const uint32_t start = (uint32_t)(recorder->at >= back ? recorder->at - back :
						  recorder->at + recorder->size - back);
		const uint32_t left = recorder->size - start;
		const uint32_t first = part->len < left ? part->len : left;

		memcpy(part->out, recorder->ring + start, first);
		memcpy(part->out + first, recorder->ring, part->len - first);
	}
}
