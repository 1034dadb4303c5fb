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
#define BITS   40

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
	uint8_t quality[BITS]; /* enum record_quality of the first bits of I  */
	uint64_t exchanged;    /* scan of the first exchange of the program   */
	uint64_t qualities;    /* how often they changed                      */
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
		if (board.ladders == 2)
			board.exchanged = board.scan;
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

/* ---- quality ---- */

static uint64_t bad_told;

static bool all_good(void)
{
	for (int i = 0; i < BITS; i++)
		if (board.quality[i])
			return false;
	return true;
}

static uint64_t quality_serial(void *context)
{
	(void)context;
	return all_good() ? 0 : board.qualities;
}

static void each_bad(void *context, struct recorder *recorder)
{
	const uint32_t at = 8 * board.resource.image.program->areas.at[AREA_I];

	(void)context;
	for (uint32_t i = 0; i < BITS; i++)
		if (board.quality[i])
			recorder_bad(recorder, at + i, 1, board.quality[i] == RECORD_BROKEN);
}

static void stir_quality(void)
{
	const uint32_t from = random_below(&board.source, BITS);
	const uint32_t count = 1 + random_below(&board.source, BITS - from);

	if (!random_chance(&board.source, 8))
		return;
	board.qualities++;
	if (random_chance(&board.source, 30))
		memset(board.quality, RECORD_GOOD, BITS);
	else
		memset(board.quality + from, (int)random_below(&board.source, 3), count);
}

/* What is told of each bit, and of the first byte, which is as bad as its worst bit. */
static uint64_t quality_of(const struct image *image, const uint8_t *bad, size_t len, uint64_t hash)
{
	uint8_t all[BITS + 1] = { 0 };

	for (uint32_t i = 0; i <= BITS; i++) {
		const struct iec_addr addr = { .area = AREA_I, .bits = i < BITS ? 1 : 8, .byte = i < BITS ? i / 8 : 0,
					       .bit = (uint8_t)(i < BITS ? i % 8 : 0) };

		all[i] = (uint8_t)record_quality_of(bad, len, image->program, image_locate(image, addr));
	}
	return mix(hash, all, sizeof(all));
}

static uint64_t quality_seen(uint64_t hash)
{
	uint8_t all[BITS + 1];

	memcpy(all, board.quality, BITS);
	all[BITS] = RECORD_GOOD;
	for (int i = 0; i < 8; i++)
		if (all[i] > all[BITS])
			all[BITS] = all[i];
	bad_told += !all_good();
	return mix(hash, all, sizeof(all));
}

static uint64_t state_played(const struct playback *playback)
{
	const struct resource *resource = &playback->twin.resource;

	return quality_of(&resource->image, playback->bad, playback->bad_len, state_of(resource));
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
	stir_quality();
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
		stir_quality();
		fail(random_chance(&board.source, 50) ? FAULT_IO : FAULT_WATCHDOG);
	}
	board.seen[++board.scan] = quality_seen(state_of(resource));
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
	recorder_tell_quality(&board.recorder, &(struct recorder_quality){ quality_serial, each_bad, NULL });
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
			same = state_played(playback) == board.seen[at];
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
		same = state_played(&playback) == board.seen[playback.twin.scan];
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
	CHECK(bad_told > 100 * seeds);
	CHECK(cuts > seeds / 20 && swaps > seeds / 2 && faults > seeds && watched > seeds);
}

/* ---- a program that is not in the file, one that is too large ---- */

static void test_missing_program(void)
{
	struct sink_memory memory;
	struct record_file *file;
	uint64_t seed = 2; /* the programs of seed 1 are few, so one may come again */

	for (board.ladders = 0; (board.ladders < 3 || !board.exchanged) && seed < 50; seed++) {
		if (seed > 2)
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

/* ---- quality of values, by hand ---- */

/* The file of a log, whose programs are named in its first @named bytes. */
static struct sink_memory of_log(const uint8_t *log, size_t named, size_t len)
{
	struct record_parts parts = { .board = "b", .log = log, .len = named };
	struct sink_memory memory;
	struct sink sink;
	size_t size;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	CHECK(record_programs(&parts) && parts.program_count == 1);
	parts.program[0].image = ladder_image(board.ladder[0], &size);
	parts.program[0].len = (uint32_t)size;
	parts.len = len;
	CHECK(record_write(&parts, &sink));
	return memory;
}

/* A log of a keyframe, and one list of values behind it: is it refused, and where? */
static bool list_refused(const void *list, size_t len, bool at_its_start)
{
	uint8_t *log = malloc(board.recorder.head + len + 16);
	const size_t key = (size_t)board.recorder.head;
	struct sink_memory memory;
	struct record_file *file;
	enum diag_id why;
	size_t where = 0, places;
	bool refused;

	memcpy(log, board.recorder.ring, key);
	memcpy(log + key, list, len);
	memory = of_log(log, key, key + len);
	places = memory.len - 4 - len; /* where the list begins */
	file = record_file_open(memory.text, memory.len, &why, &where);
	refused = !file && why == DIAG_RECORD_DAMAGED && (!at_its_start || where == places);
	if (!refused)
		printf("# opened %d, at %zu, not %zu\n", file != NULL, where, places);
	record_file_free(file);
	sink_memory_free(&memory);
	free(log);
	return refused;
}

static void test_hostile_lists(void)
{
	static const uint8_t none[] = { 38, 1, 0, 0 };        /* a run of no bits       */
	static const uint8_t open[] = { 38, 2, 0 };           /* no end                 */
	static const uint8_t cut[] = { 38, 0x82 };            /* half a number          */
	static const uint8_t far[] = { 38, 2, 0xff, 0xff, 0xff, 0x03, 0 };
	static const uint8_t huge[] = { 38, 0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01, 0, 0 };
	static const uint8_t wraps[] = { 38, 2, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01, 0 };
	static const uint8_t other[] = { 46, 0 };             /* a state that is none   */

	CHECK(open_board(2, 8u << 20));
	CHECK_AS(list_refused(none, sizeof(none), true), "a run of no bits is refused at its list");
	CHECK(list_refused(open, sizeof(open), true));
	CHECK(list_refused(cut, sizeof(cut), true));
	CHECK_AS(list_refused(far, sizeof(far), true), "bits behind the process image are refused");
	CHECK(list_refused(huge, sizeof(huge), true));
	CHECK(list_refused(wraps, sizeof(wraps), true));
	CHECK(list_refused(other, sizeof(other), true));
	close_board();
}

/* What never had a bad value has the first version, which older programs read. */
static void test_versions(void)
{
	struct sink_memory memory;
	struct record_file *file;

	CHECK(open_board(2, 8u << 20));
	memory = of_log(board.recorder.ring, (size_t)board.recorder.head, (size_t)board.recorder.head);
	CHECK_AS(memory.text[8] == 1, "a record of good values is of version 1");
	file = open_file(&memory);
	CHECK(file);
	record_file_free(file);
	sink_memory_free(&memory);
	board.quality[3] = RECORD_STALE;
	board.qualities++;
	recorder_scan(&board.recorder, &board.resource, PERIOD);
	memory = of_log(board.recorder.ring, (size_t)board.recorder.head, (size_t)board.recorder.head);
	CHECK_AS(memory.text[8] == 2, "one with a bad value is of version 2");
	sink_memory_free(&memory);
	close_board();
}

/* Is each of the first bits of I told as not good? */
static bool all_bad_at_the_end(const struct record_file *file)
{
	struct playback playback;
	uint32_t bad = 0;

	if (!playback_init(&playback, file) || !playback_seek(&playback, record_file_last(file)))
		return false;
	for (uint32_t i = 0; i < BITS; i++) {
		const struct image *image = &playback.twin.resource.image;
		const struct iec_addr addr = { .area = AREA_I, .bits = 1, .byte = i / 8, .bit = (uint8_t)(i % 8) };

		bad += record_quality_of(playback.bad, playback.bad_len, image->program, image_locate(image, addr)) != RECORD_GOOD;
	}
	playback_free(&playback);
	return bad == BITS;
}

/* Values turn bad in the scan behind each keyframe, good in the next one: back from the last scan, each has its own. */
static void test_behind_keys(void)
{
	struct sink_memory memory;
	struct record_file *file;
	struct playback playback = { .file = NULL };
	uint64_t same = 0;
	bool good;
	enum { COUNT = 120 };

	CHECK(open_board(2, 8u << 20));
	for (int i = 0; i < COUNT; i++) {
		if (i % 5 == 2)
			recorder_begin(&board.recorder, &board.resource, board.identity, RECORD_NEXT);
		board.quality[i % BITS] = i % 5 == 2 ? RECORD_STALE : RECORD_GOOD;
		board.quality[(i + BITS - 1) % BITS] = i % 10 == 4 ? RECORD_BROKEN : RECORD_GOOD;
		memset(board.quality, RECORD_GOOD, i % 5 == 3 ? BITS : 0);
		board.qualities++;
		board.now_ns += PERIOD;
		recorder_scan(&board.recorder, &board.resource, board.now_ns);
		resource_scan(&board.resource, board.now_ns);
		recorder_scanned(&board.recorder, &board.resource);
		board.seen[++board.scan] = quality_seen(state_of(&board.resource));
	}
	sink_memory_init(&memory);
	CHECK(write_file(&memory, -1));
	file = open_file(&memory);
	CHECK(file && compare(file));
	good = file && playback_init(&playback, file);
	for (uint64_t at = COUNT; good && at > 0; at--)
		same += playback_seek(&playback, at) && state_played(&playback) == board.seen[at];
	CHECK_AS(same == COUNT, "after a seek the quality is that of the scan");
	playback_free(&playback);
	record_file_free(file);
	sink_memory_free(&memory);
	close_board();
}

/* The first two bits as many runs, which fill the list; then all of them. */
static void each_of_many(void *context, struct recorder *recorder)
{
	const uint32_t at = 8 * board.resource.image.program->areas.at[AREA_I];

	(void)context;
	for (uint32_t i = 0; i < 3000; i++)
		recorder_bad(recorder, at + i % 2, 1, i % 2);
	for (uint32_t i = 0; i < BITS; i++)
		recorder_bad(recorder, at + i, 1, board.quality[i] == RECORD_BROKEN);
}

/* However many values are bad, a list has its bound, and the ring stays whole. */
static void test_many_bad(void)
{
	struct sink_memory memory;
	struct record_file *file;

	CHECK(open_board(2, 160000));
	recorder_tell_quality(&board.recorder, &(struct recorder_quality){ quality_serial, each_of_many, NULL });
	for (int i = 0; i < BITS; i++)
		board.quality[i] = i % 2 ? RECORD_STALE : RECORD_BROKEN;
	for (int i = 0; i < 3000; i++) {
		board.qualities++;
		board.now_ns += PERIOD;
		recorder_scan(&board.recorder, &board.resource, board.now_ns);
		resource_scan(&board.resource, board.now_ns);
		recorder_scanned(&board.recorder, &board.resource);
		board.scan++;
	}
	sink_memory_init(&memory);
	CHECK(write_file(&memory, -1));
	file = open_file(&memory);
	CHECK_AS(file && record_file_first(file) > 0 && record_file_last(file) == board.scan,
		 "a ring that turned over many lists is read");
	CHECK_AS(file && all_bad_at_the_end(file), "what a list has no room for is not told as good");
	record_file_free(file);
	sink_memory_free(&memory);
	close_board();
}

int main(void)
{
	test_random();
	test_hostile_lists();
	test_versions();
	test_behind_keys();
	test_many_bad();
	test_missing_program();
	test_too_large();
	test_damaged();
	return tap_done();
}
