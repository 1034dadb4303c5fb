/* SPDX-License-Identifier: MIT
 *
 * record_file - reads records one after another. next_item() checks their form. Opening a file
 * checks places and values against each program, so a playback need not.
 */
#include "engine/trial/record_file.h"

#include "engine/base/digest.h"
#include "engine/scan/place.h"
#include "engine/scan/recorder.h"
#include "engine/scan/still.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define TIME_MOST (INT64_C(1) << 60) /* ns: no sum of two overflows             */
#define DAY_NS    (86400 * INT64_C(1000000000))
#define BOARD_MOST 256
#define NO_PROGRAM UINT32_MAX

/* ---- bytes ---- */

struct reader {
	const uint8_t *at, *end;
	bool failed;
};

static const uint8_t *take(struct reader *in, size_t len)
{
	const uint8_t *at = in->at;

	if (in->failed || (size_t)(in->end - in->at) < len) {
		in->failed = true;
		return NULL;
	}
	in->at += len;
	return at;
}

static uint64_t take_bytes(struct reader *in, size_t len)
{
	const uint8_t *at = take(in, len);
	uint64_t value = 0;

	for (size_t i = 0; at && i < len; i++)
		value |= (uint64_t)at[i] << 8 * i;
	return value;
}

static uint8_t take8(struct reader *in)
{
	return (uint8_t)take_bytes(in, 1);
}

static uint32_t take32(struct reader *in)
{
	return (uint32_t)take_bytes(in, 4);
}

static int64_t take_time(struct reader *in)
{
	return (int64_t)take_bytes(in, 8);
}

static uint64_t take_number(struct reader *in)
{
	uint64_t value = 0;

	for (uint32_t shift = 0; shift < 64; shift += 7) {
		const uint8_t byte = take8(in);

		value |= (uint64_t)(byte & 0x7f) << shift;
		if (!(byte & 0x80))
			return value;
	}
	in->failed = true;
	return 0;
}

static int64_t take_signed(struct reader *in)
{
	const uint64_t value = take_number(in);

	return (int64_t)(value >> 1 ^ (value & 1 ? UINT64_MAX : 0));
}

/* Without overflow: a hostile difference wraps, and the result is checked. */
static int64_t add(int64_t a, int64_t b)
{
	return (int64_t)((uint64_t)a + (uint64_t)b);
}

static bool is_time(int64_t ns)
{
	return ns >= -TIME_MOST && ns <= TIME_MOST;
}

/* ---- records ---- */

struct key {
	enum record_why why;
	const uint8_t *identity;
	uint64_t scan, scans;
	int64_t now_ns, step_ns, wall_ns, start_ns, timers_ns, second_ns, day_ns, period_ns;
	uint8_t state, fault, flags, task_count;
	uint32_t errors_before, errors, scan_us, scan_max_us, force_count, memory_len;
	const uint8_t *task, *force, *memory;
};

struct item {
	enum record_kind kind;
	uint32_t head;            /* the first byte                           */
	struct key key;
	int64_t step_ns, wall_ns, due_ns, period_ns; /* of a scan; the first two differences */
	uint32_t scan_us;
	const uint8_t *runs;
	uint32_t place;
	uint64_t value;
	const uint8_t *text;      /* of a STRING                              */
	uint32_t text_len;
	uint32_t number;          /* of a state                               */
};

/* The second is in its day; INT64_MIN before the first scan. */
static bool is_calendar(const struct key *key)
{
	return key->second_ns == INT64_MIN ||
	       (uint64_t)key->second_ns - (uint64_t)key->day_ns < (uint64_t)DAY_NS;
}

static void take_key(struct reader *in, struct key *key, uint32_t head)
{
	key->why = (enum record_why)(head >> RECORD_SUB);
	take32(in); /* the length of the segment serves the board only */
	key->identity = take(in, 32);
	key->scan = take_bytes(in, 8);
	key->now_ns = take_time(in);
	key->step_ns = take_time(in);
	key->wall_ns = take_time(in);
	key->state = take8(in);
	key->fault = take8(in);
	key->flags = take8(in);
	key->scans = take_bytes(in, 8);
	key->start_ns = take_time(in);
	key->errors_before = take32(in);
	key->errors = take32(in);
	key->timers_ns = take_time(in);
	key->scan_us = take32(in);
	key->scan_max_us = take32(in);
	key->second_ns = take_time(in);
	key->day_ns = take_time(in);
	key->period_ns = take_time(in);
	key->task_count = take8(in);
	key->force_count = take32(in);
	key->memory_len = take32(in);
	key->task = take(in, (size_t)key->task_count * KEY_TASK);
	if (key->force_count > LIMIT_FORCES)
		in->failed = true;
	else
		key->force = take(in, (size_t)key->force_count * KEY_FORCE);
	key->memory = take(in, key->memory_len);
	if (in->failed || key->why >= RECORD_WHY_COUNT || key->state > STATE_FAULT ||
	    key->fault >= FAULT_COUNT || key->task_count > LIMIT_TASKS ||
	    !is_calendar(key) ||
	    key->now_ns < 0 || !is_time(key->now_ns) || !is_time(key->step_ns) ||
	    !is_time(key->start_ns) || !is_time(key->timers_ns) || !is_time(key->period_ns))
		in->failed = true;
}

static void take_scan(struct reader *in, struct item *item)
{
	uint64_t scan_us;

	item->step_ns = take_signed(in);
	item->wall_ns = take_signed(in);
	scan_us = take_number(in);
	item->scan_us = (uint32_t)scan_us;
	item->due_ns = item->head & RECORD_DUE ? take_signed(in) : 0;
	item->period_ns = item->head & RECORD_PERIOD ? take_signed(in) : 0;
	if (scan_us > UINT32_MAX || !is_time(item->due_ns) || !is_time(item->period_ns))
		in->failed = true;
}

static bool take_run(struct reader *in, uint64_t *gap, uint64_t *len, const uint8_t **bytes)
{
	*gap = take_number(in);
	*len = take_number(in);
	if (*gap > RECORDER_BESIDE || *len > RECORDER_BESIDE)
		in->failed = true;
	*bytes = in->failed ? NULL : take(in, (size_t)*len);
	return !in->failed && *len;
}

/* A run of bits that are not good. False: the list ends, or its form is wrong. */
static bool take_bad(struct reader *in, uint64_t *first, uint64_t *count, bool *fault)
{
	const uint64_t head = take_number(in);

	if (in->failed || !head)
		return false;
	*count = head >> 1;
	*fault = head & 1;
	*first = take_number(in);
	if (!*count || *count > 8 * (uint64_t)LIMIT_AREAS || *first > 8 * (uint64_t)LIMIT_AREAS)
		in->failed = true;
	return !in->failed;
}

static bool is_text(uint32_t place)
{
	return CODE_TYPE(place) == IEC_STRING;
}

static void take_change(struct reader *in, struct item *item)
{
	item->place = take32(in);
	if (item->kind == RECORD_UNFORCE)
		return;
	if (!is_text(item->place)) {
		item->value = take_bytes(in, 8);
		return;
	}
	item->text_len = (uint32_t)take_number(in);
	if (item->text_len > IEC_STRING_MOST)
		in->failed = true;
	else
		item->text = take(in, item->text_len);
}

static void take_quality(struct reader *in, struct item *item)
{
	uint64_t first, count;
	bool fault;

	item->runs = in->at;
	while (take_bad(in, &first, &count, &fault))
		continue;
}

static void take_interruption(struct reader *in, struct item *item)
{
	const uint64_t points = take_number(in);

	item->number = (uint32_t)points;
	item->step_ns = take_signed(in);
	if (points >= UINT32_MAX || !is_time(item->step_ns) || item->step_ns < 0)
		in->failed = true;
}

/* The next record. Fails: false: its form is wrong, or there is none. */
static bool next_item(struct reader *in, struct item *item)
{
	uint64_t gap, len;
	const uint8_t *bytes;

	memset(item, 0, sizeof(*item));
	item->head = take8(in);
	item->kind = (enum record_kind)(item->head & RECORD_KIND);
	switch (item->kind) {
	case RECORD_SCAN:
		take_scan(in, item);
		break;
	case RECORD_KEY:
		take_key(in, &item->key, item->head);
		break;
	case RECORD_INPUTS:
		item->runs = in->at;
		while (take_run(in, &gap, &len, &bytes))
			continue;
		break;
	case RECORD_WRITE: case RECORD_FORCE: case RECORD_UNFORCE:
		take_change(in, item);
		break;
	case RECORD_STATE:
		if (item->head >> RECORD_SUB == RECORD_INTERRUPTED)
			take_interruption(in, item);
		else if (item->head >> RECORD_SUB == RECORD_QUALITY)
			take_quality(in, item);
		else if (item->head >> RECORD_SUB != RECORD_STOPPED)
			item->number = take8(in);
		if (item->head >> RECORD_SUB >= RECORD_STATE_COUNT)
			in->failed = true;
		break;
	default:
		in->failed = true;
	}
	return !in->failed;
}

static bool is_state(const struct item *item, enum record_state state)
{
	return item->kind == RECORD_STATE && item->head >> RECORD_SUB == (uint32_t)state;
}

/* ---- the file ---- */

struct entry {
	uint8_t identity[32];
	struct program program;
	uint8_t *cold;            /* memory after a cold start                */
	uint32_t core;
};

struct place_of_key {
	size_t at;
	uint64_t scan;
	enum record_why why;
	uint32_t program;
};

struct record_file {
	struct arena arena;
	const char *board;
	struct entry entry[RECORD_PROGRAMS];
	uint32_t entry_count;
	const uint8_t *log;
	size_t len;
	struct place_of_key *key;
	int key_count, first_key;
	uint64_t first, last;
	int64_t begin_ns;
};

static uint32_t find_entry(const struct record_file *file, const uint8_t *identity)
{
	for (uint32_t i = 0; i < file->entry_count; i++)
		if (memcmp(file->entry[i].identity, identity, 32) == 0)
			return i;
	return NO_PROGRAM;
}

/* ---- checks ---- */

static bool is_sound_text(const uint8_t *at, uint32_t capacity)
{
	struct iec_string head;

	memcpy(&head, at, sizeof(head));
	return head.capacity == capacity && head.length <= capacity;
}

static bool is_sound_instance(const struct word_row *row, const uint8_t *at)
{
	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &word_pins(row)[i];

		if (pin->type == IEC_BOOL ? at[pin->offset] > 1 :
		    pin->type == IEC_STRING && !is_sound_text(at + pin->offset, WORD_TEXT))
			return false;
	}
	return true;
}

/* Values that the program relies on: a BOOL is 0 or 1, a text has its room, a constant has
 * its value. Blocks check the rest of their memory themselves. */
static bool is_sound_run(const struct code_run *run, const uint8_t *memory, const uint8_t *cold)
{
	const uint32_t size = code_run_size(run);

	if (run->kind == RUN_CONSTANTS)
		return memcmp(memory + run->offset, cold + run->offset,
			      (size_t)size * run->count) == 0;
	for (uint32_t i = 0; i < run->count; i++) {
		const uint8_t *at = memory + run->offset + (size_t)i * size;

		if (run->kind == RUN_INSTANCE ?
			    !is_sound_instance(word_row((enum word)run->word), at) :
		    run->type == IEC_BOOL ? *at > 1 :
		    run->type == IEC_STRING && !is_sound_text(at, run->word))
			return false;
	}
	return true;
}

static bool is_sound_memory(const struct entry *entry, const uint8_t *memory)
{
	const struct program *program = &entry->program;

	for (uint32_t i = 0; i < program->run_count; i++) {
		const struct code_run *run = &program->run[i];

		if (run->offset < entry->core && !is_sound_run(run, memory, entry->cold))
			return false;
	}
	return true;
}

static struct location force_place(const struct program *program, uint32_t place)
{
	struct location at = place_locate(program, place);

	if (at.constant || at.type == IEC_STRING)
		at.type = IEC_NONE;
	return at;
}

static bool is_good_key(const struct entry *entry, const struct key *key)
{
	struct reader in = { key->force, key->force + (size_t)key->force_count * KEY_FORCE, false };

	if (key->task_count != entry->program.task_count || key->memory_len != entry->core)
		return false;
	for (uint32_t i = 0; i < key->force_count; i++) {
		if (force_place(&entry->program, take32(&in)).type == IEC_NONE)
			return false;
		take(&in, 16);
	}
	in = (struct reader){ key->task, key->task + (size_t)key->task_count * KEY_TASK, false };
	for (uint32_t i = 0; i < key->task_count; i++) {
		if (!is_time(take_time(&in)) || !is_time(take_time(&in)))
			return false;
		take(&in, KEY_TASK - 16);
	}
	return is_sound_memory(entry, key->memory);
}

static uint32_t input_bytes(const struct program *program)
{
	uint32_t at, size, sum = 0;

	for (uint32_t i = 0; recorder_input(program, i, &at, &size); i++)
		sum += size;
	return sum;
}

static bool is_good_inputs(const struct program *program, const struct item *item,
			   const uint8_t *end)
{
	struct reader in = { item->runs, end, false };
	const uint32_t most = input_bytes(program);
	uint64_t gap, len, at = 0;
	const uint8_t *bytes;

	while (take_run(&in, &gap, &len, &bytes)) {
		at += gap + len;
		if (at > most)
			return false;
	}
	return !in.failed;
}

static bool is_good_quality(const struct program *program, const struct item *item, const uint8_t *end)
{
	struct reader in = { item->runs, end, false };
	uint64_t first, count;
	bool fault;

	while (take_bad(&in, &first, &count, &fault))
		if (first + count > 8 * (uint64_t)program->areas.size)
			return false;
	return !in.failed;
}

static bool is_good_change(const struct program *program, const struct item *item)
{
	const struct location at = place_locate(program, item->place);

	if (at.type == IEC_NONE || at.constant)
		return false;
	/* A text has its room; one in an instance cannot be written. */
	if (at.type == IEC_STRING)
		return item->kind == RECORD_WRITE && code_run_at(program, at.where)->kind !=
						     RUN_INSTANCE;
	return true;
}

/* A state while a log is checked. */
struct course {
	uint32_t program;         /* NO_PROGRAM: unknown                      */
	uint64_t scan;
	int64_t now_ns, step_ns;
	bool begun;
};

static bool follow_scan(struct record_file *file, struct course *course, const struct item *item)
{
	course->step_ns = add(course->step_ns, item->step_ns);
	course->now_ns = add(course->now_ns, course->step_ns);
	course->scan++;
	/* Before its first scan a board has no time. */
	if (!file->begin_ns && course->program != NO_PROGRAM)
		file->begin_ns = course->now_ns;
	return course->step_ns >= 0 && course->step_ns <= TIME_MOST &&
	       course->now_ns >= 0 && course->now_ns <= TIME_MOST && course->scan;
}

static bool follow_key(struct record_file *file, struct course *course, const struct item *item,
		       size_t at)
{
	const struct key *key = &item->key;
	const uint32_t program = find_entry(file, key->identity);
	struct place_of_key *found;

	if (course->begun && (key->scan < course->scan || key->now_ns < course->now_ns))
		return false;
	if (key->why == RECORD_NEXT && course->begun && program != course->program)
		return false;
	if (program != NO_PROGRAM && !is_good_key(&file->entry[program], key))
		return false;
	found = arena_push(&file->arena, &file->key, &file->key_count, sizeof(*found));
	if (!found)
		return false;
	*found = (struct place_of_key){ at, key->scan, key->why, program };
	if (program == NO_PROGRAM) {
		file->first_key = file->key_count;
	} else if (file->first_key == file->key_count - 1) {
		file->first = key->scan;
		file->begin_ns = key->now_ns; /* 0: see follow_scan() */
	}
	course->program = program;
	course->scan = key->scan;
	course->now_ns = key->now_ns;
	course->step_ns = key->step_ns;
	course->begun = true;
	return true;
}

static bool follow(struct record_file *file, struct course *course, const struct item *item,
		   size_t at, const uint8_t *end)
{
	const struct program *program = course->program == NO_PROGRAM ? NULL :
					&file->entry[course->program].program;

	if (item->kind != RECORD_KEY && !course->begun)
		return false;
	switch (item->kind) {
	case RECORD_SCAN: return follow_scan(file, course, item);
	case RECORD_KEY: return follow_key(file, course, item, at);
	case RECORD_INPUTS: return !program || is_good_inputs(program, item, end);
	case RECORD_WRITE: case RECORD_FORCE: case RECORD_UNFORCE:
		return !program || is_good_change(program, item);
	case RECORD_STATE:
		if (item->head >> RECORD_SUB == RECORD_QUALITY)
			return !program || is_good_quality(program, item, end);
		return item->head >> RECORD_SUB != RECORD_FAILED ||
		       (item->number > FAULT_NONE && item->number < FAULT_COUNT);
	}
	return false;
}

static bool check_log(struct record_file *file, size_t *where)
{
	struct reader in = { file->log, file->log + file->len, false };
	struct course course = { .program = NO_PROGRAM };
	struct item *item = malloc(sizeof(*item));
	bool good = item;

	while (good && in.at < in.end) {
		*where = (size_t)(in.at - file->log);
		good = next_item(&in, item) && follow(file, &course, item, *where, in.at);
	}
	free(item);
	file->last = course.scan;
	*where = good ? file->len : *where;
	return good && file->first_key < file->key_count;
}

/* ---- opening ---- */

static bool open_program(struct record_file *file, struct reader *in, enum diag_id *why,
			 size_t *where)
{
	struct entry *entry = &file->entry[file->entry_count];
	const uint8_t *identity = take(in, 32);
	const uint32_t len = take32(in);
	const uint8_t *bytes = take(in, len);
	uint8_t found[32];
	struct arena scratch;
	struct image *image;
	void *copy;
	bool good;

	*why = DIAG_RECORD_DAMAGED;
	if (!bytes)
		return false;
	copy = arena_alloc(&file->arena, len + 8u);
	image = arena_alloc(&file->arena, sizeof(*image));
	*why = DIAG_NO_MEMORY;
	if (!copy || !image)
		return false;
	memcpy(copy, bytes, len);
	arena_init(&scratch);
	good = code_open(copy, len, &scratch, &entry->program, why, where);
	arena_free(&scratch);
	if (!good)
		return false;
	code_identity(&entry->program, found);
	*why = DIAG_RECORD_DAMAGED;
	if (memcmp(found, identity, 32) != 0 || find_entry(file, identity) != NO_PROGRAM)
		return false;
	memcpy(entry->identity, identity, 32);
	entry->core = recorder_core(&entry->program);
	entry->cold = arena_alloc(&file->arena, image_memory_size(&entry->program));
	*why = DIAG_NO_MEMORY;
	if (!entry->cold)
		return false;
	image_init(image, &entry->program, entry->cold);
	file->entry_count++;
	return true;
}

static bool open_head(struct record_file *file, struct reader *in, enum diag_id *why)
{
	const uint8_t *magic = take(in, 8);
	const uint32_t version = take32(in), len = take32(in);
	const uint8_t *board = len < BOARD_MOST ? take(in, len) : NULL;

	*why = DIAG_NOT_RECORD;
	if (!magic || memcmp(magic, RECORD_MAGIC, 8) != 0)
		return false;
	*why = DIAG_RECORD_NEWER;
	if (!version || version > RECORD_VERSION)
		return false;
	*why = DIAG_RECORD_DAMAGED;
	if (!board)
		return false;
	file->board = arena_copy(&file->arena, (const char *)board, len);
	*why = DIAG_NO_MEMORY;
	return file->board;
}

static bool open_all(struct record_file *file, const uint8_t *bytes, size_t len, enum diag_id *why,
		     size_t *where)
{
	struct reader in = { bytes, bytes + len, false };
	const uint8_t *log;
	uint8_t *copy;
	uint32_t programs;

	if (!open_head(file, &in, why))
		return false;
	*why = DIAG_RECORD_DAMAGED;
	*where = len;
	if (in.end - in.at < 4)
		return false;
	in.end -= 4;
	if (take_bytes(&(struct reader){ in.end, bytes + len, false }, 4) !=
	    digest_crc32c(0, bytes, len - 4))
		return false;
	programs = take32(&in);
	if (programs > RECORD_PROGRAMS)
		return false;
	for (uint32_t i = 0; i < programs; i++)
		if (!open_program(file, &in, why, where))
			return false;
	*why = DIAG_RECORD_DAMAGED;
	file->len = take32(&in);
	*where = (size_t)(in.at - bytes);
	log = take(&in, file->len);
	if (!log || in.at != in.end)
		return false;
	copy = arena_alloc(&file->arena, file->len + 1);
	if (!copy)
		return false;
	file->log = memcpy(copy, log, file->len);
	if (check_log(file, where))
		return true;
	*why = *where == file->len ? DIAG_RECORD_EMPTY : DIAG_RECORD_DAMAGED;
	*where += (size_t)(log - bytes);
	return false;
}

struct record_file *record_file_open(const void *bytes, size_t len, enum diag_id *why,
				     size_t *where)
{
	struct record_file *file = calloc(1, sizeof(*file));

	*why = DIAG_NO_MEMORY;
	*where = 0;
	if (!file)
		return NULL;
	arena_init(&file->arena);
	if (open_all(file, bytes, len, why, where))
		return file;
	if (file->arena.failed)
		*why = DIAG_NO_MEMORY;
	record_file_free(file);
	return NULL;
}

void record_file_free(struct record_file *file)
{
	if (!file)
		return;
	arena_free(&file->arena);
	free(file);
}

const char *record_file_board(const struct record_file *file)
{
	return file->board;
}

uint64_t record_file_first(const struct record_file *file)
{
	return file->first;
}

uint64_t record_file_last(const struct record_file *file)
{
	return file->last;
}

/* ---- writing ---- */

bool record_programs(struct record_parts *parts)
{
	struct reader in = { parts->log, parts->log + parts->len, false };
	struct item *item = malloc(sizeof(*item));
	bool good = item;

	parts->program_count = 0;
	parts->has_quality = false;
	while (good && in.at < in.end) {
		uint32_t i = 0;

		good = next_item(&in, item);
		parts->has_quality |= good && is_state(item, RECORD_QUALITY);
		if (!good || item->kind != RECORD_KEY)
			continue;
		while (i < parts->program_count &&
		       memcmp(parts->program[i].identity, item->key.identity, 32) != 0)
			i++;
		if (i < parts->program_count)
			continue;
		good = i < RECORD_PROGRAMS;
		if (good)
			memcpy(parts->program[parts->program_count++].identity,
			       item->key.identity, 32);
	}
	free(item);
	return good;
}

struct writer {
	const struct sink *out;
	uint32_t crc;
};

static void give(struct writer *writer, const void *bytes, size_t len)
{
	writer->crc = digest_crc32c(writer->crc, bytes, len);
	sink_write(writer->out, bytes, len);
}

static void give32(struct writer *writer, uint32_t value)
{
	const uint8_t bytes[4] = { (uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16),
				   (uint8_t)(value >> 24) };

	give(writer, bytes, 4);
}

bool record_write(const struct record_parts *parts, const struct sink *out)
{
	struct writer writer = { out, 0 };
	uint32_t known = 0, board = (uint32_t)strlen(parts->board);

	if (board >= BOARD_MOST)
		board = BOARD_MOST - 1;
	for (uint32_t i = 0; i < parts->program_count; i++)
		known += parts->program[i].image != NULL;
	give(&writer, RECORD_MAGIC, 8);
	give32(&writer, parts->has_quality ? RECORD_VERSION : 1);
	give32(&writer, board);
	give(&writer, parts->board, board);
	give32(&writer, known);
	for (uint32_t i = 0; i < parts->program_count; i++) {
		const struct record_program *program = &parts->program[i];

		if (!program->image)
			continue;
		give(&writer, program->identity, 32);
		give32(&writer, program->len);
		give(&writer, program->image, program->len);
	}
	give32(&writer, (uint32_t)parts->len);
	give(&writer, parts->log, parts->len);
	give32(&writer, writer.crc);
	return parts->len <= RECORD_MOST;
}

/* ---- playback ---- */

static struct reader reader_at(const struct playback *playback, size_t at)
{
	const struct record_file *file = playback->file;

	return (struct reader){ file->log + at, file->log + file->len, false };
}

static void load_tasks(struct resource *resource, const struct key *key)
{
	struct reader in = { key->task, key->task + (size_t)key->task_count * KEY_TASK, false };

	for (uint32_t i = 0; i < key->task_count; i++) {
		struct task_state *state = &resource->tasks.state[i];
		uint8_t flags;

		state->next_ns = take_time(&in);
		state->began_ns = take_time(&in);
		flags = take8(&in);
		state->began = flags & KEY_BEGAN;
		state->due = flags & KEY_DUE;
		state->ran = flags & KEY_RAN;
		state->was = flags & KEY_WAS;
		state->runs = take_bytes(&in, 8);
		state->overruns = take_bytes(&in, 8);
		state->late_row = take32(&in);
	}
}

static void load_forces(struct image *image, const struct key *key)
{
	struct reader in = { key->force, key->force + (size_t)key->force_count * KEY_FORCE, false };

	image->force_count = (int)key->force_count;
	for (uint32_t i = 0; i < key->force_count; i++) {
		struct force *force = &image->force[i];

		force->at = force_place(image->program, take32(&in));
		force->value.i = take_time(&in);
		force->aside.i = take_time(&in);
	}
}

static void load_resource(struct resource *resource, const struct key *key)
{
	resource->state = (enum resource_state)key->state;
	resource->fault = (enum fault)key->fault;
	resource->halted = key->flags & KEY_HALTED;
	resource->late = key->flags & KEY_LATE;
	resource->io_fault = key->flags & KEY_IO;
	resource->warm = key->flags & KEY_WARM;
	resource->retain_lost = key->flags & KEY_LOST;
	resource->retain_old_copy = key->flags & KEY_OLD_COPY;
	resource->vm.stop = key->flags & KEY_STOP;
	resource->scans = key->scans;
	resource->start_ns = key->start_ns;
	resource->errors_before = key->errors_before;
	resource->vm.errors = key->errors;
	resource->vm.now_ns = key->now_ns + key->timers_ns;
	resource->timers_ns = key->timers_ns;
	resource->scan_us = key->scan_us;
	resource->scan_max_us = key->scan_max_us;
	resource->second_ns = key->second_ns;
	resource->day_ns = key->day_ns;
	resource->period_ns = key->period_ns;
	resource->wall_offset_ns = key->wall_ns;
}

/* Gives the twin the program of a keyframe. */
static bool take_program(struct playback *playback, const struct key *key)
{
	const uint32_t program = find_entry(playback->file, key->identity);

	if (playback->twin.resource.image.program && playback->program == program)
		return true;
	twin_free(&playback->twin);
	playback->program = program;
	playback->changes++;
	return twin_init(&playback->twin, &playback->file->entry[program].program, NULL, 1);
}

static bool load_key(struct playback *playback, const struct key *key)
{
	struct resource *resource = &playback->twin.resource;

	if (!take_program(playback, key))
		return false;
	if (key->why != RECORD_NEXT) {
		const bool watch = resource->watch;

		resource_init(resource, resource->image.program, resource->image.memory);
		resource->watch = watch;
	}
	load_resource(resource, key);
	load_tasks(resource, key);
	load_forces(&resource->image, key);
	memcpy(resource->image.memory, key->memory, key->memory_len);
	playback->time_ns = key->now_ns;
	playback->step_ns = key->step_ns;
	playback->twin.scan = key->scan;
	playback->twin.now_ns = key->now_ns ? key->now_ns - playback->file->begin_ns : 0;
	playback->wall_ns = add(key->now_ns, key->wall_ns);
	playback->bad = NULL;
	playback->bad_len = 0;
	return true;
}

static void use_quality(struct playback *playback, const struct item *item, const uint8_t *end)
{
	playback->bad = item->runs;
	playback->bad_len = (size_t)(end - item->runs);
}

/* A list behind a keyframe, or behind a FAULT, belongs to that state. */
static void take_quality_behind(struct playback *playback, struct item *item)
{
	struct reader in = reader_at(playback, playback->at);

	if (in.at == in.end || !next_item(&in, item) || !is_state(item, RECORD_QUALITY))
		return;
	use_quality(playback, item, in.at);
	playback->at = (size_t)(in.at - playback->file->log);
}

/* Temporaries may differ: a board that leaves out rungs does not write all of them in each scan. */
static bool is_same_memory(const struct entry *entry, const uint8_t *memory, const struct key *key)
{
	struct arena arena;
	const uint8_t *carries;
	bool same;

	if (memcmp(memory, key->memory, key->memory_len) == 0)
		return true;
	arena_init(&arena);
	carries = still_carries(&entry->program, &arena);
	same = carries;
	for (uint32_t i = 0; same && i < key->memory_len; i++)
		same = memory[i] == key->memory[i] || !carries[i];
	arena_free(&arena);
	return same;
}

/* Is the state that was computed the one that the board had? */
static bool is_same(const struct playback *playback, const struct key *key)
{
	const struct resource *resource = &playback->twin.resource;
	struct playback *other = calloc(1, sizeof(*other));
	bool same = false;

	if (!other)
		return true;
	other->file = playback->file;
	if (load_key(other, key)) {
		const struct resource *board = &other->twin.resource;

		same = is_same_memory(&playback->file->entry[playback->program],
				      resource->image.memory, key) &&
		       resource->scans == board->scans && resource->state == board->state &&
		       resource->start_ns == board->start_ns &&
		       resource->vm.errors == board->vm.errors &&
		       resource->errors_before == board->errors_before &&
		       resource->second_ns == board->second_ns &&
		       resource->image.force_count == board->image.force_count &&
		       playback->twin.scan == key->scan && playback->time_ns == key->now_ns;
		for (int i = 0; same && i < board->image.force_count; i++) {
			const struct force *a = &resource->image.force[i];
			const struct force *b = &board->image.force[i];

			same = a->value.i == b->value.i && a->aside.i == b->aside.i &&
			       a->at.where == b->at.where && a->at.area == b->at.area;
		}
		for (uint32_t i = 0; same && i < resource->image.program->task_count; i++) {
			const struct task_state *a = &resource->tasks.state[i];
			const struct task_state *b = &board->tasks.state[i];

			same = a->next_ns == b->next_ns && a->runs == b->runs &&
			       a->overruns == b->overruns && a->late_row == b->late_row &&
			       a->due == b->due && a->was == b->was && a->began == b->began &&
			       a->began_ns == b->began_ns;
		}
	}
	playback_free(other);
	free(other);
	return same;
}

static bool meet_key(struct playback *playback, const struct key *key)
{
	if (playback->exact && key->why == RECORD_NEXT && !playback->differs &&
	    !is_same(playback, key))
		playback->differs = key->scan;
	return load_key(playback, key);
}

static void set_inputs(struct image *image, const struct item *item, const uint8_t *end)
{
	struct reader in = { item->runs, end, false };
	uint32_t input = 0, at = 0, size = 0, from = 0;
	uint64_t gap, len, where = 0;
	const uint8_t *bytes;

	recorder_input(image->program, input, &at, &size);
	while (take_run(&in, &gap, &len, &bytes)) {
		where += gap;
		for (uint64_t i = 0; i < len; i++, where++) {
			while (where - from >= size) {
				from += size;
				recorder_input(image->program, ++input, &at, &size);
			}
			image->memory[at + (where - from)] = bytes[i];
		}
	}
}

static void do_change(struct image *image, const struct item *item)
{
	const struct location at = place_locate(image->program, item->place);
	union iec_value value = { .i = (int64_t)item->value };
	struct iec_text room;

	if (item->text) {
		struct iec_string *text = iec_text_init(&room, (uint16_t)item->text_len);

		memcpy(text->text, item->text, item->text_len);
		value.s = text;
	}
	if (item->kind == RECORD_WRITE)
		image_set(image, at, value);
	else if (item->kind == RECORD_FORCE)
		image_force(image, at, value);
	else
		image_unforce(image, at);
}

/* ---- interruptions ---- */

/* Finds the next one of the scan that runs. Without memory there is none. */
static void find_interruption(struct playback *playback)
{
	struct reader in = reader_at(playback, playback->at);
	struct item *item = malloc(sizeof(*item));
	bool good = item && in.at < in.end && next_item(&in, item);

	playback->points = UINT32_MAX;
	playback->inputs_at = 0;
	if (good && item->kind == RECORD_INPUTS) {
		playback->inputs_at = playback->at;
		good = in.at < in.end && next_item(&in, item);
	}
	if (good && is_state(item, RECORD_INTERRUPTED)) {
		playback->points = item->number;
		playback->point_ns = add(playback->time_ns, item->step_ns);
		playback->point_end = (size_t)(in.at - playback->file->log);
	}
	free(item);
}

static struct playback *playback_of(struct resource *resource)
{
	return (struct playback *)((char *)resource - offsetof(struct playback, twin.resource));
}

static bool asks_record(struct resource *resource, int64_t *now_ns)
{
	const struct playback *playback = playback_of(resource);

	*now_ns = playback->point_ns;
	return playback->points == resource->vm.points;
}

static bool begin_recorded(struct resource *resource, int64_t now_ns)
{
	struct playback *playback = playback_of(resource);
	struct reader in = reader_at(playback, playback->inputs_at);
	struct item *item = playback->inputs_at ? malloc(sizeof(*item)) : NULL;

	(void)now_ns;
	if (item && next_item(&in, item))
		set_inputs(&resource->image, item, in.at);
	free(item);
	playback->at = playback->point_end;
	find_interruption(playback);
	return true;
}

static bool end_recorded(struct resource *resource, int64_t now_ns)
{
	(void)resource, (void)now_ns;
	return true;
}

static const struct interrupts by_record = { asks_record, begin_recorded, end_recorded, NULL };

/* Copies of the twin interrupt nothing. */
static void scan_recorded(struct playback *playback)
{
	struct resource *resource = &playback->twin.resource;

	find_interruption(playback);
	resource->interrupts = &by_record;
	resource->vm.ask = playback->points != UINT32_MAX;
	resource_scan(resource, playback->time_ns);
	resource->interrupts = NULL;
	resource->vm.ask = 0;
}

/* ---- a scan ---- */

static void do_scan(struct playback *playback, const struct item *item, uint32_t tasks)
{
	struct twin *twin = &playback->twin;
	struct resource *resource = &twin->resource;

	playback->step_ns = add(playback->step_ns, item->step_ns);
	playback->time_ns = add(playback->time_ns, playback->step_ns);
	resource->late = item->head & RECORD_LATE;
	resource->io_fault = item->head & RECORD_IO;
	resource->watch = !playback->exact || item->head & RECORD_WATCH;
	resource->wall_offset_ns = add(resource->wall_offset_ns, item->wall_ns);
	resource->scan_us = item->scan_us;
	if (resource->scan_us > resource->scan_max_us)
		resource->scan_max_us = resource->scan_us;
	resource->due_ns = item->head & RECORD_DUE ? playback->time_ns - item->due_ns : 0;
	if (item->head & RECORD_PERIOD)
		resource->period_ns = item->period_ns;
	resource->tasks_most = tasks;
	scan_recorded(playback);
	twin->scan++;
	twin->now_ns = playback->time_ns - playback->file->begin_ns;
	twin->period_ns = playback->step_ns > 0 ? playback->step_ns : 1;
	playback->wall_ns = add(playback->time_ns, resource->wall_offset_ns);
}

/* What a scan leads to belongs to it: a FAULT, perhaps with inputs that were read for the next
 * one. */
static void finish_scan(struct playback *playback, struct item *item)
{
	struct reader in = reader_at(playback, playback->at), fault;
	struct resource *resource = &playback->twin.resource;
	struct item inputs;

	if (in.at == in.end || !next_item(&in, item))
		return;
	if (is_state(item, RECORD_TASKS)) {
		playback->at = (size_t)(in.at - playback->file->log);
		if (in.at == in.end || !next_item(&in, item))
			return;
	}
	fault = in;
	inputs = *item;
	if (item->kind == RECORD_INPUTS && (in.at == in.end || !next_item(&in, item)))
		return;
	if (!is_state(item, RECORD_FAILED))
		return;
	if (inputs.kind == RECORD_INPUTS)
		set_inputs(&resource->image, &inputs, fault.at);
	resource_fail(resource, (enum fault)item->number);
	playback->at = (size_t)(in.at - playback->file->log);
	take_quality_behind(playback, item);
}

static uint32_t tasks_after(struct reader in)
{
	struct item *item = in.at < in.end ? malloc(sizeof(*item)) : NULL;
	uint32_t tasks = 0;

	if (item && next_item(&in, item) && is_state(item, RECORD_TASKS))
		tasks = item->number;
	free(item);
	return tasks;
}

/* Does the next record. @scanned: it was a scan. Fails: false: no memory. */
static bool do_item(struct playback *playback, struct item *item, bool *scanned)
{
	struct reader in = reader_at(playback, playback->at);
	struct resource *resource = &playback->twin.resource;

	*scanned = false;
	if (!next_item(&in, item))
		return false;
	playback->at = (size_t)(in.at - playback->file->log);
	switch (item->kind) {
	case RECORD_SCAN:
		do_scan(playback, item, tasks_after(in));
		finish_scan(playback, item);
		*scanned = true;
		return true;
	case RECORD_KEY:
		return meet_key(playback, &item->key);
	case RECORD_INPUTS:
		set_inputs(&resource->image, item, in.at);
		return true;
	case RECORD_WRITE: case RECORD_FORCE: case RECORD_UNFORCE:
		do_change(&resource->image, item);
		return true;
	case RECORD_STATE:
		if (is_state(item, RECORD_STOPPED))
			resource_stop(resource);
		else if (is_state(item, RECORD_FAILED))
			resource_fail(resource, (enum fault)item->number);
		else if (is_state(item, RECORD_QUALITY))
			use_quality(playback, item, in.at);
		return true;
	}
	return false;
}

bool playback_next(struct playback *playback)
{
	struct item *item;
	bool scanned = false, good = true;

	if (playback->twin.scan >= playback->file->last)
		return false;
	item = malloc(sizeof(*item));
	while (good && item && !scanned)
		good = do_item(playback, item, &scanned);
	free(item);
	return scanned;
}

static bool jump(struct playback *playback, const struct place_of_key *key)
{
	struct reader in = reader_at(playback, key->at);
	struct item *item = malloc(sizeof(*item));
	bool good = item && next_item(&in, item) && load_key(playback, &item->key);

	playback->at = (size_t)(in.at - playback->file->log);
	if (good)
		take_quality_behind(playback, item);
	free(item);
	return good;
}

bool playback_seek(struct playback *playback, uint64_t scan)
{
	const struct record_file *file = playback->file;
	int best = file->first_key;

	if (scan < file->first || scan > file->last)
		return false;
	for (int i = file->first_key; i < file->key_count; i++)
		if (file->key[i].scan < scan ||
		    (file->key[i].scan == scan && file->key[i].why == RECORD_NEXT))
			best = i;
	if ((playback->twin.scan > scan || playback->at <= file->key[best].at ||
	     !playback->twin.resource.image.program) && !jump(playback, &file->key[best]))
		return false;
	while (playback->twin.scan < scan)
		if (!playback_next(playback))
			return false;
	return playback->twin.scan == scan;
}

bool playback_init(struct playback *playback, const struct record_file *file)
{
	memset(playback, 0, sizeof(*playback));
	playback->file = file;
	return jump(playback, &file->key[file->first_key]);
}

void playback_free(struct playback *playback)
{
	twin_free(&playback->twin);
}

/* ---- quality of values ---- */

enum record_quality record_quality_of(const uint8_t *bad, size_t len, const struct program *program,
				      struct location at)
{
	struct reader in = { bad, bad ? bad + len : bad, false };
	enum record_quality quality = RECORD_GOOD;
	uint64_t first, count;
	uint32_t bit, bits;
	bool fault;

	if (!bad || !image_bits(program, at, &bit, &bits))
		return RECORD_GOOD;
	while (take_bad(&in, &first, &count, &fault))
		if (first < (uint64_t)bit + bits && bit < first + count && quality != RECORD_BROKEN)
			quality = fault ? RECORD_BROKEN : RECORD_STALE;
	return quality;
}
