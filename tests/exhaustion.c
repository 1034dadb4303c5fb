/* SPDX-License-Identifier: MIT
 *
 * exhaustion - memory runs out at the 1st, 2nd, 3rd … allocation, until loading,
 * building and writing succeed.
 *
 *   exhaustion [FILE…]
 *
 * Linked with --wrap, so that every allocation of the engine comes through here. Each
 * failure must give LD001, without leaks. A simulation and its record must go on, and
 * must not show states that never existed.
 */
#include "engine/ladder.h"
#include "engine/base/file.h"
#include "engine/scan/carry.h"
#include "engine/trial/record.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <sys/mman.h>

#define ATTEMPTS_MAX 100000

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t align, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t align, size_t size);
void __wrap_free(void *block);
/* The name of mmap() on systems with offsets of 64 bits. */
void *__real_mmap64(void *at, size_t size, int prot, int flags, int fd, off_t offset);
void *__wrap_mmap64(void *at, size_t size, int prot, int flags, int fd, off_t offset);
int __real_munmap(void *at, size_t size);
int __wrap_munmap(void *at, size_t size);

static long live;         /* blocks that are allocated                        */
static long mapped;       /* bytes that are allocated                         */
static long left = -1;    /* allocations that still succeed; -1: all          */
static long refused;

static bool may_allocate(void)
{
	if (left == 0) {
		refused++;
		return false;
	}
	if (left > 0)
		left--;
	return true;
}

static void *counted(void *block)
{
	live += block != NULL;
	return block;
}

void *__wrap_malloc(size_t size)
{
	return may_allocate() ? counted(__real_malloc(size)) : NULL;
}

void *__wrap_calloc(size_t count, size_t size)
{
	return may_allocate() ? counted(__real_calloc(count, size)) : NULL;
}

void *__wrap_realloc(void *old, size_t size)
{
	void *block;

	if (!may_allocate())
		return NULL;
	block = __real_realloc(old, size);
	live += block && !old;
	return block;
}

void *__wrap_aligned_alloc(size_t align, size_t size)
{
	return may_allocate() ? counted(__real_aligned_alloc(align, size)) :
				NULL;
}

void __wrap_free(void *block)
{
	live -= block != NULL;
	__real_free(block);
}

void *__wrap_mmap64(void *at, size_t size, int prot, int flags, int fd, off_t offset)
{
	void *memory = MAP_FAILED;

	if (may_allocate())
		memory = __real_mmap64(at, size, prot, flags, fd, offset);
	mapped += memory != MAP_FAILED ? (long)size : 0;
	return memory;
}

int __wrap_munmap(void *at, size_t size)
{
	mapped -= (long)size;
	return __real_munmap(at, size);
}

enum stage { STAGE_NEW, STAGE_LOAD, STAGE_BUILD, STAGE_WRITE, STAGE_DONE };

static bool has_no_memory(struct ladder *ladder)
{
	const struct diag_list *diags = ladder_diags(ladder);

	for (int i = 0; i < diags->count; i++)
		if (diags->diag[i].id == DIAG_NO_MEMORY)
			return true;
	return false;
}

/* Returns the last stage that succeeded; @told: whether the failure was reported. */
static enum stage try_all(const char *file, const char *text, size_t len,
			  bool *told)
{
	struct ladder *ladder = ladder_new();
	enum stage stage = STAGE_LOAD;
	char *written;
	size_t written_len;

	*told = true;
	if (!ladder)
		return STAGE_NEW;
	if (!ladder_take_classic(ladder, false) || !ladder_take_others(ladder)) {
		ladder_free(ladder);
		return STAGE_NEW;
	}
	if (ladder_load_text(ladder, file, text, len)) {
		stage = STAGE_BUILD;
		if (ladder_build(ladder))
			stage = STAGE_WRITE;
	}
	if (stage != STAGE_WRITE)
		*told = has_no_memory(ladder);
	written = stage == STAGE_WRITE ? ladder_write(ladder, &written_len) :
					 NULL;
	if (written)
		stage = STAGE_DONE;
	free(written);
	ladder_free(ladder);
	return stage;
}

static void starve(const char *file, const char *text, size_t len)
{
	long before = live + mapped, untold = 0, leaks = 0, lies = 0, n;
	enum stage stage = STAGE_NEW;
	char what[256];

	for (n = 0; n < ATTEMPTS_MAX && stage != STAGE_DONE; n++) {
		bool told;

		refused = 0;
		left = n;
		stage = try_all(file, text, len, &told);
		left = -1;
		untold += !told;
		leaks += live + mapped - before;
		/* An allocation failed and all stages succeeded: a NULL was ignored. */
		lies += refused && stage == STAGE_DONE;
	}
	printf("# %s: %ld allocations\n", file, n - 1);
	snprintf(what, sizeof(what), "%.200s: the last try has enough memory and succeeds", file);
	CHECK_AS(stage == STAGE_DONE && n > 2, what);
	snprintf(what, sizeof(what), "%.200s: each failed allocation is reported as LD001", file);
	CHECK_AS(untold == 0, what);
	snprintf(what, sizeof(what), "%.200s: nothing leaks", file);
	CHECK_AS(leaks == 0, what);
	snprintf(what, sizeof(what), "%.200s: no failed allocation is ignored", file);
	CHECK_AS(lies == 0, what);
}

static void starve_file(const char *path)
{
	struct diag_list diags;
	size_t len;
	char *text;

	diag_init(&diags);
	text = file_read(path, LIMIT_TEXT, &len, &diags);
	if (CHECK_AS(text, path))
		starve(path, text, len);
	free(text);
}

/* ---- a twin and its record ---- */

static uint64_t sum_of(const struct twin *twin)
{
	uint64_t sum = twin->scan * 31 + (uint64_t)twin->now_ns;

	for (size_t i = 0; i < twin->memory_size; i++)
		sum = sum * 1099511628211u + twin->resource.image.memory[i];
	return sum;
}

static void act(struct twin *twin, struct record *record, enum act_kind kind,
		const char *name, union iec_value value)
{
	const struct image *image = &twin->resource.image;
	const struct act what = { .kind = kind, .value = value,
				  .at = image_find(image, name, strlen(name)) };

	if (twin_act(twin, &what))
		record_act(record, twin, &what);
}

/* Scans and acts of all kinds; the sums of all scans. False: the start failed, which a
 * person would see. */
static bool play(struct twin *twin, struct record *record, uint64_t *sum)
{
	struct iec_text room;

	act(twin, record, ACT_START, "", (union iec_value){ 0 });
	while (twin->resource.state == STATE_RUN && twin->scan < 60) {
		if (twin->scan % 7 == 3)
			act(twin, record, ACT_SET, "Go",
			    (union iec_value){ .i = twin->scan & 1 });
		if (twin->scan % 20 == 9)
			act(twin, record, ACT_SET, "Text",
			    (union iec_value){ .s = iec_text_init(&room, 0) });
		if (twin->scan % 20 == 13)
			act(twin, record, ACT_WARM, "", (union iec_value){ 0 });
		twin_scan(twin);
		record_scan(record, twin);
		sum[twin->scan] = sum_of(twin);
	}
	return twin->scan == 60;
}

/* Whether each replayed scan equals the original. */
static bool is_true(const struct record *record, const uint64_t *sum)
{
	struct replay replay;
	bool good = true;

	if (!replay_init(&replay, record))
		return true;
	for (uint64_t scan = 60; good && scan > 0; scan -= 3)
		if (replay_seek(&replay, record, scan))
			good = sum_of(&replay.twin) == sum[scan];
	replay_free(&replay);
	return good;
}

static bool try_twin(const struct program *program, bool *good)
{
	static uint64_t sum[61];
	struct twin twin, next;
	struct record *record = NULL;
	bool done = false;

	if (!twin_init(&twin, program, NULL, 10000000))
		return false;
	record = record_new(&twin, 100, 20000);
	if (record && play(&twin, record, sum)) {
		*good = is_true(record, sum) && *good;
		done = record_first(record) <= 40;
	}
	if (done && twin_init(&next, program, NULL, 1)) {
		done = twin_change(&next, &twin);
		*good = (!done || sum_of(&next) == sum_of(&twin)) && *good;
		twin_free(&next);
	}
	record_free(record);
	twin_free(&twin);
	return done;
}

static void starve_twin(void)
{
	static const char text[] =
		"RUNGBOARD 1\nVAR\n  Go : BOOL;\n  N : INT;\n  Text : STRING[8];\nEND_VAR\n"
		"VAR RETAIN\n  Kept : INT;\nEND_VAR\nPROGRAM Main LD\n"
		"RUNG\n  | P Go | [ Kept := Kept + 1 ] |\n"
		"RUNG\n  | --- | [ N := N + 1 ] |\nEND_PROGRAM\n";
	struct ladder *ladder = ladder_new();
	bool good = true, done = false;
	long before, leaks = 0, n;

	ladder_watch(ladder, true);
	if (!CHECK_AS(ladder_load_text(ladder, "twin.rung", text, strlen(text)) &&
		      ladder_build(ladder), "a program to simulate"))
		return;
	before = live + mapped;
	for (n = 0; n < 400; n++) {
		refused = 0;
		left = n;
		done = try_twin(ladder_program(ladder), &good) && !refused;
		left = -1;
		leaks += live + mapped - before;
		if (done)
			break;
	}
	printf("# a simulation: %ld allocations\n", n);
	CHECK_AS(done && n > 10,
		 "a simulation and its record succeed once there is enough memory");
	CHECK_AS(good, "a record without memory shows the true state or none");
	CHECK_AS(leaks == 0, "a record leaks nothing");
	ladder_free(ladder);
}

/* ---- a change of the running program ---- */

/* Fails until @n allocations are enough; then the plan must be one. Returns their number;
 * -1: a plan was made although an allocation failed, or there was none at last. */
static long starve_change(const struct program *to, const struct program *from)
{
	long n;

	for (n = 0; n < 400; n++) {
		const struct carry_plan *plan;
		struct arena arena;
		bool wrong;

		arena_init(&arena);
		refused = 0;
		left = n;
		plan = carry_plan_new(to, from, &arena);
		left = -1;
		wrong = plan ? refused > 0 : refused == 0;
		arena_free(&arena);
		if (wrong)
			return -1;
		if (plan)
			return n;
	}
	return -1;
}

/* A program of @count variables, forward or backward, with texts, edges and initial values:
 * the plan moves each by itself. */
static struct ladder *load_many(int count, bool back)
{
	struct ladder *ladder = ladder_new();
	const size_t size = 200 * (size_t)count + 200;
	char *text = __real_malloc(size);
	size_t used = (size_t)snprintf(text, size, "RUNGBOARD 1\nVAR\n");

	for (int i = 0; i < count; i++) {
		const int n = back ? count - i : i;

		used += (size_t)snprintf(text + used, size - used, "  N%d : INT := %d;\n"
					 "  T%d : STRING[%d] := '%d';\n  B%d : BOOL;\n",
					 n, back, n, 4 + back, back, n);
	}
	used += (size_t)snprintf(text + used, size - used, "END_VAR\nPROGRAM Main LD\n");
	for (int i = 1; i < count; i++)
		used += (size_t)snprintf(text + used, size - used,
					 "RUNG\n  | %s B%d | COIL %%QX1.1 |\n",
					 back ? "P" : "N", i);
	used += (size_t)snprintf(text + used, size - used, "END_PROGRAM\n");
	CHECK_AS(ladder_load_text(ladder, "many.rung", text, used) && ladder_build(ladder),
		 "a program with many variables");
	__real_free(text);
	return ladder;
}

/* Different programs, so that memory runs out at different places. */
static void starve_changes(void)
{
	static const char *const file[] = {
		"ladders/garage-door.rung", "ladders/lift.rung", "ladders/recipe.rung",
		"ladders/traffic-crossing.rung", "tests/fuzz/corpus/code/random-100.rung",
		"tests/fuzz/corpus/code/tasks.rung", "tests/fuzz/corpus/code/arrays-in-blocks.rung",
	};
	enum { FILES = sizeof(file) / sizeof(*file), ALL = FILES + 4 };
	struct ladder *ladder[ALL];
	long before, all = 0, most = 0, wrong = 0;

	for (int i = 0; i < FILES; i++) {
		ladder[i] = ladder_new();
		CHECK_AS(ladder_load(ladder[i], file[i]) && ladder_build(ladder[i]), file[i]);
	}
	for (int i = 0; i < 4; i++)
		ladder[FILES + i] = load_many(i < 2 ? 300 : 3000, i & 1);
	before = live + mapped;
	for (int i = 0; i < ALL * ALL; i++) {
		const long n = starve_change(ladder_program(ladder[i / ALL]),
					     ladder_program(ladder[i % ALL]));

		wrong += n < 1;
		all += n;
		most = n > most ? n : most;
	}
	printf("# %d changes of programs: %ld allocations, %ld of one\n", ALL * ALL, all, most);
	CHECK_AS(wrong == 0, "a change without memory has no plan; with memory it has one");
	CHECK_AS(most > 7 && all > 3 * ALL * ALL, "many allocations of a plan fail");
	CHECK_AS(live + mapped == before, "a plan leaks nothing");
	for (int i = 0; i < ALL; i++)
		ladder_free(ladder[i]);
}

int main(int argc, char **argv)
{
	for (int i = 1; i < argc; i++)
		starve_file(argv[i]);
	if (argc == 1) {
		starve_twin();
		starve_changes();
		starve_file("ladders/garage-door.rung");
		starve_file("tests/fuzz/corpus/code/random-100.rung");
		starve_file("tests/fuzz/corpus/code/il.rung");
		starve_file("tests/fuzz/corpus/code/tasks.rung");
		starve_file("tests/fuzz/corpus/code/arrays-in-blocks.rung");
		starve_file("tests/golden/declared-expressions/main.rung");
		starve_file("tests/fuzz/corpus/classic/linuxcnc.clp");
		starve_file("tests/fuzz/corpus/classic/packed.clprjz");
		starve_file("tests/fuzz/corpus/ldmicro/all.ld");
	}
	return tap_done();
}
