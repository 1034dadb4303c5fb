/* SPDX-License-Identifier: MIT
 *
 * test_record_file - a record of a board gives the same scans again, bit for bit: random
 * programs with random inputs, clocks, writes, forces, faults, starts and exchanges of the
 * program, in rings of several sizes. Also: damaged files.
 */
#include "engine/base/digest.h"
#include "engine/scan/carry.h"
#include "engine/scan/recorder.h"
#include "engine/trial/record_file.h"
#include "tests/unit/scan/carry_random.h"

#define SEEDS  40
#define SCANS  400
#define NAMES  2048
#define PERIOD INT64_C(10000000)

/* ---- a state as one number ---- */

static uint64_t mix(uint64_t hash, const void *bytes, size_t size)
{
	const uint8_t *at = bytes;

	while (size--)
		hash = (hash ^ *at++) * UINT64_C(1099511628211);
	return hash;
}

static uint64_t state_of(const struct resource *resource)
{
	const struct image *image = &resource->image;
	uint64_t hash = mix(1469598103934665603u, image->memory, recorder_core(image->program));

	for (int i = 0; i < image->force_count; i++) {
		hash = mix(hash, &image->force[i].at.where, sizeof(uint32_t));
		hash = mix(hash, &image->force[i].value.i, 8);
		hash = mix(hash, &image->force[i].aside.i, 8);
	}
	for (uint32_t i = 0; i < image->program->task_count; i++) {
		const struct task_state *state = &resource->tasks.state[i];
		const int64_t all[] = { state->next_ns, (int64_t)state->runs,
					(int64_t)state->overruns, state->due, state->was,
					state->ran };

		hash = mix(hash, all, sizeof(all));
	}
	{
		const int64_t all[] = { resource->state, resource->fault, resource->halted,
					(int64_t)resource->scans, resource->vm.errors };

		hash = mix(hash, all, sizeof(all));
	}
	return hash;
}

/* ---- a board ---- */

static struct board {
	struct random_source source;
	struct ladder *ladder[8];
	int ladders;
	void *memory[8];
	struct resource resource;
	uint8_t identity[32];
	struct recorder recorder;
	uint8_t *ring;
	struct location name[NAMES];
	uint32_t names;
	int64_t now_ns;
	uint64_t seen[SCANS + 1];
	uint64_t scan;
	bool watches, interrupts;
	uint8_t level[4];      /* of the lines, which are the first bytes of I */
} board;

static int64_t board_clock_ns;
static struct random_source board_clock_source;

/* Some tasks take long, so that others of higher priority cut the cycle. */
static int64_t board_clock(const struct resource *resource)
{
	(void)resource;
	board_clock_ns += random_chance(&board_clock_source, 20) ?
			  (int64_t)random_below(&board_clock_source, 20000000) : 1000;
	return board_clock_ns;
}

static uint64_t cuts, swaps, faults, dropped, compared, watched;

static const struct program *program_of(int number)
{
	return ladder_program(board.ladder[number]);
}

static char source_text[sizeof(((struct made *)0)->text) + 32];

/* Three tasks that interrupt each other: they count inputs, in loops. */
static int make_tasks(uint64_t seed)
{
	const int a = (int)(seed % 5), b = (int)(seed % 3);

	return snprintf(source_text, sizeof(source_text),
		"RUNGBOARD 1\nVAR_GLOBAL\n  I AT %%IW0 : INT;\n  Q AT %%QW0 : INT;\n"
		"  R AT %%QW2 : INT;\n  Sum, K, L, N : INT;\n  T : TIME;\nEND_VAR\n"
		"CONFIGURATION Plant\n  RESOURCE Cpu\n"
		"    TASK T1 (INTERVAL := T#1ms, PRIORITY := 0);\n"
		"    TASK T2 (INTERVAL := T#2ms, PRIORITY := 1);\n"
		"    TASK T3 (INTERVAL := T#10ms, PRIORITY := 2);\n"
		"    PROGRAM A WITH T1 : P1;\n    PROGRAM B WITH T2 : P2;\n"
		"    PROGRAM C WITH T3 : P3;\n  END_RESOURCE\nEND_CONFIGURATION\n"
		"PROGRAM P1 IL\n  LD I\n  ADD Sum\n  ST Sum\n  LD SYS_CYCLE\n  ST T\nEND_PROGRAM\n"
		"PROGRAM P2 IL\n  LD 0\n  ST L\nOn:\n  LD L\n  ADD 1\n  ST L\n  ADD I\n  ADD R\n"
		"  ST R\n  LD L\n  LT %d\n  JMPC On\nEND_PROGRAM\n"
		"PROGRAM P3 IL\n  LD 0\n  ST K\nOn:\n  LD K\n  ADD 1\n  ST K\n  LD I\n  ADD Sum\n"
		"  ADD Q\n  ST Q\n  LD N\n  ADD R\n  ST N\n  LD K\n  LT %d\n  JMPC On\n"
		"END_PROGRAM\n", 2 + b, 3 + 2 * a);
}

static bool open_program(uint64_t seed)
{
	static struct made made;
	struct ladder *ladder = ladder_new();
	int len = board.interrupts ? make_tasks(seed) :
		  snprintf(source_text, sizeof(source_text), "RUNGBOARD 1\n%s", make_text_of(&made, seed));
	const int number = board.ladders;

	ladder_watch(ladder, true);
	if (!ladder_load_text(ladder, "r.rung", source_text, (size_t)len) || !ladder_build(ladder)) {
		ladder_free(ladder);
		return false;
	}
	board.ladder[number] = ladder;
	board.memory[number] = calloc(1, image_memory_size(ladder_program(ladder)));
	board.ladders++;
	return true;
}

static void take_names(void)
{
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;

	board.names = 0;
	while (board.names < NAMES &&
	       image_next_symbol(&board.resource.image, &cursor, &symbol))
		if (!symbol.at.constant)
			board.name[board.names++] = symbol.at;
}

static void set_up(int number)
{
	board.resource.clock_ns = tasks_declared(program_of(number)) ? board_clock : NULL;
	board.resource.tick_ns = board.resource.period_ns = PERIOD;
	board.resource.watch = board.watches;
	code_identity(program_of(number), board.identity);
	take_names();
}

/* A start with retained values. */
static void start(void)
{
	resource_start(&board.resource);
	for (int i = 0; i < 10 && board.names; i++)
		stir_value(&board.source, &board.resource.image,
			   board.name[random_below(&board.source, board.names)]);
	board.resource.warm = random_chance(&board.source, 50);
	board.resource.timers_ns = (int64_t)random_below(&board.source, 1000);
	recorder_begin(&board.recorder, &board.resource, board.identity, RECORD_START);
}

static void swap(uint64_t seed)
{
	const int number = board.ladders;
	struct arena arena;
	const struct carry_plan *plan;
	struct resource *next;

	if (number == 8 || !open_program(seed))
		return;
	arena_init(&arena);
	next = arena_alloc(&arena, sizeof(*next));
	resource_init(next, program_of(number), board.memory[number]);
	plan = carry_plan_new(program_of(number), board.resource.image.program, &arena);
	if (carry_apply(plan, next, &board.resource)) {
		board.resource = *next;
		set_up(number);
		recorder_begin(&board.recorder, &board.resource, board.identity, RECORD_SWAP);
		swaps++;
	}
	arena_free(&arena);
}

/* As online/exchange.c does it. */
static void change(void)
{
	struct image *image = &board.resource.image;
	const uint32_t bit = random_below(&board.source, 64);
	const struct iec_addr input = { .area = AREA_I, .bits = 1, .byte = bit / 8,
					.bit = (uint8_t)(bit % 8) };
	const struct location at = random_chance(&board.source, 20) ?
		image_locate(image, input) : board.name[random_below(&board.source, board.names)];
	const uint32_t dice = random_below(&board.source, 10);
	union iec_value value = { .i = (int64_t)random_next(&board.source) };
	struct iec_text room;

	if (at.type == IEC_REAL || at.type == IEC_LREAL)
		value.r = (double)value.i / 8;
	if (at.type == IEC_STRING) {
		struct iec_string *text = iec_text_init(&room, 5);

		memset(text->text, 'a' + (int)dice, 5);
		value.s = text;
	}
	if (dice < 6) {
		recorder_change(&board.recorder, &board.resource, RECORD_WRITE, at, value);
		image_set(image, at, value);
	} else if (dice < 8 && at.type != IEC_STRING && image->force_count < LIMIT_FORCES) {
		recorder_change(&board.recorder, &board.resource, RECORD_FORCE, at, value);
		image_force(image, at, value);
	} else if (image_is_forced(image, at)) {
		recorder_change(&board.recorder, &board.resource, RECORD_UNFORCE, at, value);
		image_unforce(image, at);
	}
	recorder_changed(&board.recorder, &board.resource);
}

static void stir_byte(uint8_t *bytes, uint32_t count)
{
	uint8_t *byte = bytes + random_below(&board.source, count);

	*byte = (uint8_t)random_next(&board.source);
}

/* Lines overwrite what a desk wrote; other inputs have no line. */
static void read_inputs(void)
{
	uint32_t at, size;

	if (random_chance(&board.source, 20))
		stir_byte(board.level, sizeof(board.level));

	for (uint32_t i = 0; recorder_input(board.resource.image.program, i, &at, &size); i++)
		for (uint32_t k = random_chance(&board.source, 30) && size ?
				  random_below(&board.source, 20) : 0; k; k--)
			stir_byte(board.resource.image.memory + at, size);
	memcpy(image_area(&board.resource.image, AREA_I), board.level, sizeof(board.level));
}

/* ---- tasks that interrupt others ---- */

static uint64_t interruptions;

static bool asks(struct resource *resource, int64_t *now_ns)
{
	(void)resource;
	*now_ns = board_clock_ns += random_below(&board_clock_source, 100000);
	return random_chance(&board_clock_source, 8);
}

static bool begin(struct resource *resource, int64_t now_ns)
{
	recorder_interrupting(&board.recorder, resource);
	read_inputs();
	recorder_interrupt(&board.recorder, resource, now_ns);
	interruptions++;
	return true;
}

static bool end(struct resource *resource, int64_t now_ns)
{
	(void)resource, (void)now_ns;
	return true;
}

static const struct interrupts at_random = { asks, begin, end, NULL };

static void fail(enum fault fault)
{
	resource_fail(&board.resource, fault);
	recorder_failed(&board.recorder, &board.resource);
	faults++;
}

static void scan(void)
{
	struct resource *resource = &board.resource;

	board.now_ns += PERIOD + random_below(&board.source, 90000);
	if (random_chance(&board.source, 5))
		board.now_ns += PERIOD * random_below(&board.source, 30);
	board_clock_ns = board.now_ns;
	resource->due_ns = board.now_ns - random_below(&board.source, 50000);
	resource->late = random_chance(&board.source, 10);
	resource->io_fault = random_chance(&board.source, 10);
	resource->wall_offset_ns += random_below(&board.source, 200) - 100;
	if (random_chance(&board.source, 3))
		resource->wall_offset_ns += INT64_C(3600000000000) * 5;
	if (random_chance(&board.source, 5))
		resource->watch = !resource->watch;
	read_inputs();
	resource->interrupts = board.interrupts ? &at_random : NULL;
	resource->vm.ask = 1;
	recorder_scan(&board.recorder, resource, board.now_ns);
	resource_scan(resource, board.now_ns);
	recorder_scanned(&board.recorder, resource);
	watched += resource->watch;
	for (uint32_t i = 0, left = 0; i < resource->image.program->task_count && !left; i++) {
		left = resource->tasks.state[i].due && !resource->tasks.state[i].ran &&
		       resource->state == STATE_RUN;
		cuts += left;
	}
	resource->scan_us = random_below(&board.source, 900);
	if (resource->scan_us > resource->scan_max_us)
		resource->scan_max_us = resource->scan_us;
	if (resource->state == STATE_FAULT) {
		fail(resource->fault);
	} else if (random_chance(&board.source, 1)) {
		if (random_chance(&board.source, 50))
			read_inputs();
		fail(random_chance(&board.source, 50) ? FAULT_IO : FAULT_WATCHDOG);
	}
	board.seen[++board.scan] = state_of(resource);
}

static void play(uint64_t seed)
{
	while (board.scan < SCANS) {
		if (board.resource.state == STATE_RUN && random_chance(&board.source, 1)) {
			resource_stop(&board.resource);
			recorder_stopped(&board.recorder);
		}
		while (random_chance(&board.source, 20) && board.names)
			change();
		if (random_chance(&board.source, 1))
			swap(seed * 1000 + board.scan);
		if (board.resource.state == STATE_RUN)
			scan();
		else
			start();
	}
}

static bool open_board(uint64_t seed, uint32_t ring)
{
	memset(&board, 0, sizeof(board));
	random_seed(&board.source, seed * 977 + 5);
	random_seed(&board_clock_source, seed);
	board.watches = seed % 2;
	board.interrupts = seed % 4 == 1;
	if (!open_program(seed))
		return false;
	board.ring = calloc(1, RECORDER_BESIDE + ring);
	recorder_init(&board.recorder, board.ring, ring);
	resource_init(&board.resource, program_of(0), board.memory[0]);
	set_up(0);
	board.seen[0] = 0;
	start();
	return true;
}

static void close_board(void)
{
	for (int i = 0; i < board.ladders; i++) {
		free(board.memory[i]);
		ladder_free(board.ladder[i]);
	}
	free(board.ring);
}

/* ---- its file ---- */

/* The log, taken in parts of a random size. */
static uint8_t *take_log(size_t *len)
{
	uint8_t *log = malloc(board.recorder.size + 1u);
	struct recorder_part part = { .from = 0 };

	*len = 0;
	do {
		part.out = log + *len;
		part.room = 1 + random_below(&board.source, 5000);
		recorder_take(&board.recorder, &part);
		part.from = part.at + part.len;
		*len += part.len;
	} while (part.from < part.end);
	return log;
}

static bool write_file(struct sink_memory *memory, int hidden)
{
	struct record_parts parts = { .board = "bench" };
	const struct sink sink = sink_to_memory(memory);
	size_t len;
	uint8_t *log = take_log(&len);
	bool good;

	parts.log = log;
	parts.len = len;
	good = record_programs(&parts);
	for (uint32_t i = 0; i < parts.program_count; i++)
		for (int k = 0; k < board.ladders; k++) {
			uint8_t identity[32];
			size_t size;

			code_identity(program_of(k), identity);
			if (k == hidden || memcmp(identity, parts.program[i].identity, 32) != 0)
				continue;
			parts.program[i].image = ladder_image(board.ladder[k], &size);
			parts.program[i].len = (uint32_t)size;
		}
	good = good && record_write(&parts, &sink) && !memory->failed;
	free(log);
	return good;
}

static struct record_file *open_file(const struct sink_memory *memory)
{
	enum diag_id why;
	size_t where;
	struct record_file *file = record_file_open(memory->text, memory->len, &why, &where);

	if (!file)
		printf("# refused: %d at %zu of %zu\n", (int)why, where, memory->len);
	return file;
}

static bool seek_all(struct playback *playback, uint64_t first, uint64_t last)
{
	bool same = true;

	for (int i = 0; i < 150 && same; i++) {
		const uint64_t at = first + random_below(&board.source, (uint32_t)(last - first + 1));

		same = playback_seek(playback, at) && playback->twin.scan == at;
		/* The first state is before the acts that follow it. */
		if (same && at > first)
			same = state_of(&playback->twin.resource) == board.seen[at];
		if (!same)
			printf("# scan %llu differs after a seek\n", (unsigned long long)at);
	}
	return same && !playback_seek(playback, last + 1);
}

static bool compare(const struct record_file *file)
{
	const uint64_t first = record_file_first(file), last = record_file_last(file);
	struct playback playback;
	bool same = playback_init(&playback, file);

	playback.exact = true;
	while (same && playback_next(&playback)) {
		same = state_of(&playback.twin.resource) == board.seen[playback.twin.scan];
		if (!same)
			printf("# scan %llu differs\n", (unsigned long long)playback.twin.scan);
		compared++;
	}
	if (playback.differs)
		printf("# keyframe at %llu differs\n", (unsigned long long)playback.differs);
	same = same && playback.twin.scan == last && !playback.differs &&
	       seek_all(&playback, first, last);
	playback_free(&playback);
	return same;
}

static bool test_seed(uint64_t seed)
{
	const uint32_t ring = seed % 3 == 0 ? 8u << 20 : seed % 4 == 1 ? 1u << 19 : 160000;
	struct sink_memory memory;
	struct record_file *file;
	bool good;

	if (!open_board(seed, ring)) {
		close_board();
		return true;
	}
	play(seed);
	sink_memory_init(&memory);
	good = write_file(&memory, -1);
	file = good ? open_file(&memory) : NULL;
	good = file && record_file_last(file) == SCANS &&
	       strcmp(record_file_board(file), "bench") == 0 && compare(file);
	if (good && seed % 3 == 0)
		good = record_file_first(file) == 0;
	dropped += file && record_file_first(file) > 0;
	record_file_free(file);
	sink_memory_free(&memory);
	if (!good)
		printf("# seed %llu\n", (unsigned long long)seed);
	close_board();
	return good;
}

static void test_random(void)
{
	const uint64_t seeds = (uint64_t)tap_rounds(SEEDS);
	uint64_t good = 0;

	for (uint64_t seed = 1; seed <= seeds; seed++)
		good += test_seed(seed);
	printf("# %llu scans, %llu of them watched; %llu cut cycles, %llu swaps, %llu faults; "
	       "%llu rings dropped something\n", (unsigned long long)compared,
	       (unsigned long long)watched, (unsigned long long)cuts, (unsigned long long)swaps,
	       (unsigned long long)faults, (unsigned long long)dropped);
	CHECK_AS(good == seeds, "every scan of every record is the board's");
	CHECK(compared > seeds * 100 && dropped > seeds / 6);
	printf("# %llu interruptions\n", (unsigned long long)interruptions);
	CHECK(interruptions > 100 * seeds);
	CHECK(cuts > seeds && swaps > seeds / 2 && faults > seeds && watched > seeds);
}

/* ---- a program that is not in the file, one that is too large ---- */

static void test_missing_program(void)
{
	struct sink_memory memory;
	struct record_file *file;
	uint64_t seed = 1;

	for (board.ladders = 0; board.ladders < 3 && seed < 50; seed++) {
		if (seed > 1)
			close_board();
		if (open_board(seed, 8u << 20))
			play(seed);
	}
	CHECK(board.ladders >= 3);
	sink_memory_init(&memory);
	CHECK(write_file(&memory, 0));
	file = open_file(&memory);
	CHECK_AS(file && record_file_first(file) > 0 && record_file_last(file) == SCANS,
		 "scans of an unknown program are left out");
	CHECK(file && compare(file));
	record_file_free(file);
	sink_memory_free(&memory);
	close_board();
}

static void test_too_large(void)
{
	CHECK(open_board(3, 16384));
	play(3);
	CHECK_AS(board.recorder.head == 0, "nothing is recorded of a program that is too large");
	close_board();
}

/* ---- damaged files ---- */

static void seal(uint8_t *bytes, size_t len)
{
	const uint32_t crc = digest_crc32c(0, bytes, len - 4);

	for (int i = 0; i < 4; i++)
		bytes[len - 4 + (size_t)i] = (uint8_t)(crc >> 8 * i);
}

static void play_all(const uint8_t *bytes, size_t len, uint64_t *opened)
{
	enum diag_id why;
	size_t where;
	struct record_file *file = record_file_open(bytes, len, &why, &where);
	struct playback playback;

	if (!file)
		return;
	++*opened;
	if (playback_init(&playback, file))
		for (int i = 0; i < 300 && playback_next(&playback); i++)
			continue;
	playback_free(&playback);
	record_file_free(file);
}

static void test_damaged(void)
{
	struct sink_memory memory;
	uint64_t opened = 0, sealed = 0;
	uint8_t *bytes;

	CHECK(open_board(6, 200000));
	play(6);
	sink_memory_init(&memory);
	CHECK(write_file(&memory, -1));
	bytes = malloc(memory.len);
	for (int i = 0; i < tap_rounds(600); i++) {
		const size_t at = (uint64_t)random_next(&board.source) % memory.len;
		const size_t len = i % 4 ? memory.len : at;

		memcpy(bytes, memory.text, memory.len);
		if (i % 4)
			bytes[at] ^= (uint8_t)(1u << random_below(&board.source, 8));
		play_all(bytes, len, &opened);
		if (len < 4)
			continue;
		seal(bytes, len);
		play_all(bytes, len, &sealed);
	}
	printf("# %llu opened with a new checksum\n", (unsigned long long)sealed);
	CHECK_AS(opened == 0, "a file with a wrong byte or cut is refused");
	free(bytes);
	sink_memory_free(&memory);
	close_board();
}

int main(void)
{
	test_random();
	test_missing_program();
	test_too_large();
	test_damaged();
	return tap_done();
}
