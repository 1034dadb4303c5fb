/* SPDX-License-Identifier: MIT
 *
 * still_differential - leaving out what has not changed gives what whole scans give.
 *
 *   still_differential [--seed S] [--count N] [--show]
 *
 * Random ladders, sets of tasks and charts run twice, with the same inputs, which change rarely,
 * the same forces and the same values from outside. After each scan all that has a name, outputs,
 * counters and places of faults must be the same. Stretches are as short as can be.
 */
#include "engine/ladder.h"
#include "engine/scan/still.h"
#include "tests/tap.h"
#include "tests/walker/random_sfc.h"

#include <stdlib.h>
#include <string.h>

#define TEXT_MAX (192u * 1024)
#define SCANS    60
#define MS       INT64_C(1000000)

#ifndef STILL_COUNT
#define STILL_COUNT 1500
#endif

struct side {
	void *memory;
	struct resource resource;
};

struct pair {
	struct ladder *ladder;
	const struct program *program;
	struct side whole, still;
	struct arena keep;
	uint8_t *named;              /* a byte for each of memory              */
	struct random_source source;
	char why[160];
};

struct totals { uint64_t same, differ, refused, whole, ran, all; };

/* ---- what everybody can see ---- */

static void name(struct pair *pair, uint32_t at, uint32_t size)
{
	for (uint32_t i = at; i < at + size && i < pair->program->header->data_size; i++)
		pair->named[i] = 1;
}

/* Everything but temporaries. */
static void name_all(struct pair *pair)
{
	const struct program *p = pair->program;
	struct symbol_cursor cursor = { .pin = 0 };
	struct symbol symbol;

	name(pair, 0, p->areas.size);
	for (uint32_t i = 0; i < p->bits_count; i++)
		name(pair, p->bits[i].slot, p->bits[i].count);
	for (uint32_t i = 0; i < p->run_count; i++)
		if (p->run[i].kind == RUN_INSTANCE)
			name(pair, p->run[i].offset, p->run[i].count * code_run_size(&p->run[i]));
	while (image_next_symbol(&pair->whole.resource.image, &cursor, &symbol)) {
		const struct location at = symbol.at;

		if (at.area != AREA_NONE || symbol.flags & SYMBOL_HIDDEN)
			continue;
		name(pair, at.where, at.type != IEC_STRING ? iec_type_row(at.type)->size :
			sizeof(struct iec_string) +
			((const struct iec_string *)((char *)pair->whole.memory + at.where))->capacity);
	}
}

static bool differ(struct pair *pair, const char *what, uint32_t at)
{
	snprintf(pair->why, sizeof(pair->why), "%s differs (%u)", what, at);
	return true;
}

static bool is_place(const struct fault_place *a, const struct fault_place *b)
{
	return a->rung == b->rung && a->row == b->row && a->col == b->col && a->line == b->line &&
	       a->pou == b->pou && a->task == b->task;
}

static bool are_different(struct pair *pair)
{
	const struct resource *a = &pair->whole.resource, *b = &pair->still.resource;
	const uint8_t *x = pair->whole.memory, *y = pair->still.memory;

	if (a->state != b->state || a->fault != b->fault || a->halted != b->halted)
		return differ(pair, "state", b->state);
	if (!is_place(&a->fault_at, &b->fault_at) || !is_place(&a->halt_at, &b->halt_at) ||
	    !is_place(&a->error_at, &b->error_at))
		return differ(pair, "a place", 0);
	if (a->vm.errors != b->vm.errors)
		return differ(pair, "the number of errors", b->vm.errors);
	if (a->state == STATE_RUN && !pair->program->watch_words &&
	    a->vm.budget != b->vm.budget)
		return differ(pair, "the budget", b->vm.budget);
	if (a->words != b->words)
		return differ(pair, "the number of words", (uint32_t)b->words);
	if (a->state == STATE_FAULT)
		return false;
	for (uint32_t i = 0; i < pair->program->header->data_size; i++)
		if (pair->named[i] && x[i] != y[i])
			return differ(pair, "memory", i);
	for (int i = 0; i < a->image.force_count; i++)
		if (a->image.force[i].aside.i != b->image.force[i].aside.i)
			return differ(pair, "a value under a force", (uint32_t)i);
	return false;
}

/* ---- what happens between two scans ---- */

static void set_byte(struct pair *pair, enum iec_area area, uint32_t at, uint8_t value)
{
	image_area(&pair->whole.resource.image, area)[at] = value;
	image_area(&pair->still.resource.image, area)[at] = value;
}

/* Programs read the first bytes of their areas. */
static void change_inputs(struct pair *pair)
{
	const uint32_t bytes = pair->program->areas.bytes[AREA_I];
	const uint32_t at = random_below(&pair->source, bytes < 8 ? bytes : 8);
	const uint8_t bit = (uint8_t)(1u << random_below(&pair->source, 8));

	set_byte(pair, AREA_I, at, image_area(&pair->whole.resource.image, AREA_I)[at] ^ bit);
	for (uint32_t i = 0; i < bytes && random_chance(&pair->source, 10); i++)
		set_byte(pair, AREA_I, i, (uint8_t)random_next(&pair->source));
}

/* One of the named values, at random. */
static struct location pick(struct pair *pair)
{
	struct symbol_cursor cursor = { .pin = 0 };
	struct location at = { .type = IEC_NONE };
	struct symbol symbol;
	uint32_t seen = 0;

	while (image_next_symbol(&pair->whole.resource.image, &cursor, &symbol)) {
		const bool fits = !symbol.at.constant && symbol.at.type != IEC_STRING &&
				  !(symbol.flags & SYMBOL_HIDDEN);

		if (fits && random_below(&pair->source, ++seen) == 0)
			at = symbol.at;
	}
	return at;
}

static void write_both(struct pair *pair)
{
	const struct location at = pick(pair);
	const union iec_value value = { .i = random_below(&pair->source, 3) };
	const uint32_t what = random_below(&pair->source, 3);
	struct image *a = &pair->whole.resource.image, *b = &pair->still.resource.image;

	if (at.type == IEC_NONE || iec_type_row(at.type)->class & CLASS_REAL)
		return;
	if (what == 0) {
		image_force(a, at, value);
		image_force(b, at, value);
	} else if (what == 1) {
		image_set(a, at, value);
		image_set(b, at, value);
	} else if (a->force_count) {
		const struct location held = a->force[0].at;

		image_unforce(a, held);
		image_unforce(b, held);
	}
}

/* The time does not always go on. */
static int64_t time_passed(struct pair *pair)
{
	const uint32_t chance = random_below(&pair->source, 20);

	return chance == 0 ? 0 : chance == 1 ? 997 * MS : chance < 10 ? 5 * MS : 10 * MS;
}

static void meddle(struct pair *pair)
{
	if (random_chance(&pair->source, 25))
		change_inputs(pair);
	if (random_chance(&pair->source, 6))
		write_both(pair);
	if (random_chance(&pair->source, 2)) {
		pair->whole.resource.io_fault = !pair->whole.resource.io_fault;
		pair->still.resource.io_fault = pair->whole.resource.io_fault;
	}
	if (random_chance(&pair->source, 2) || pair->whole.resource.state != STATE_RUN) {
		resource_start(&pair->whole.resource);
		resource_start(&pair->still.resource);
	}
	if (pair->program->watch_words && random_chance(&pair->source, 3))
		pair->still.resource.watch = !pair->still.resource.watch;
}

static bool run(struct pair *pair)
{
	int64_t now_ns = 0;

	for (int i = 0; i < SCANS; i++) {
		meddle(pair);
		now_ns += time_passed(pair);
		resource_scan(&pair->whole.resource, now_ns);
		resource_scan(&pair->still.resource, now_ns);
		if (are_different(pair)) {
			printf("# scan %d: %s\n", i, pair->why);
			return false;
		}
	}
	return true;
}

/* ---- programs ---- */

/* Two tasks of one priority, which do not interrupt each other. */
static size_t add_tasks(char *text)
{
	static const char tasks[] = "CONFIGURATION C\n  RESOURCE R ON PLC\n"
		"    TASK Often (INTERVAL := T#10ms, PRIORITY := 1);\n"
		"    TASK Rarely (INTERVAL := T#30ms, PRIORITY := 1);\n"
		"    PROGRAM A WITH Often : Main;\n    PROGRAM B WITH Rarely : Other;\n"
		"  END_RESOURCE\nEND_CONFIGURATION\n";
	char *at = strchr(text, '\n');
	const size_t len = strlen(text);

	if (!at || !strstr(text, "PROGRAM Other") || strstr(text, "CONFIGURATION") ||
	    len + sizeof(tasks) > TEXT_MAX)
		return len;
	memmove(at + sizeof(tasks), at + 1, len - (size_t)(at - text));
	memcpy(at + 1, tasks, sizeof(tasks) - 1);
	return len + sizeof(tasks) - 1;
}

static size_t make_text(uint64_t seed, char *text)
{
	static struct random_program program;
	static struct random_sfc chart;
	size_t len;

	if (seed % 5 == 0) {
		chart.seed = seed;
		chart.dropped_count = 0;
		return random_sfc_print(&chart, text, TEXT_MAX);
	}
	random_make(&program, seed);
	len = random_print(&program, text, TEXT_MAX);
	return seed % 5 == 1 ? add_tasks(text) : len;
}

static void open_side(struct pair *pair, struct side *side)
{
	side->memory = calloc(1, image_memory_size(pair->program));
	if (!side->memory)
		abort();
	resource_init(&side->resource, pair->program, side->memory);
	resource_start(&side->resource);
}

/* Returns false if they differ. */
static bool run_pair(struct pair *pair, uint64_t seed, struct totals *totals)
{
	struct still *still;
	bool same;

	pair->program = ladder_program(pair->ladder);
	open_side(pair, &pair->whole);
	open_side(pair, &pair->still);
	pair->named = calloc(1, pair->program->header->data_size);
	if (!pair->named)
		abort();
	name_all(pair);
	random_seed(&pair->source, seed * 7 + 3);
	still = still_new(pair->program, 1 + random_below(&pair->source, 24), &pair->keep, NULL);
	pair->still.resource.still = still;
	totals->whole += !still;
	same = !still || run(pair);
	if (still) {
		totals->ran += still->ran;
		totals->all += still->all;
	}
	return same;
}

static void judge(uint64_t seed, struct totals *totals, bool show)
{
	static char text[TEXT_MAX];
	const size_t len = make_text(seed, text);
	struct pair pair = { .ladder = ladder_new() };

	if (!pair.ladder)
		abort();
	arena_init(&pair.keep);
	ladder_watch(pair.ladder, seed % 3 == 0);
	if (show)
		fwrite(text, 1, len, stdout);
	if (!ladder_load_text(pair.ladder, "random.rung", text, len) ||
	    !ladder_build(pair.ladder)) {
		totals->refused++;
	} else if (run_pair(&pair, seed, totals)) {
		totals->same++;
	} else {
		totals->differ++;
		printf("# seed %llu: it differs\n", (unsigned long long)seed);
	}
	free(pair.named);
	free(pair.whole.memory);
	free(pair.still.memory);
	arena_free(&pair.keep);
	ladder_free(pair.ladder);
}

int main(int argc, char **argv)
{
	uint64_t seed = 1, count = STILL_COUNT;
	struct totals totals = { 0 };
	bool show = false;

	for (int i = 1; i < argc; i++) {
		show = show || strcmp(argv[i], "--show") == 0;
		if (i + 1 < argc && strcmp(argv[i], "--seed") == 0)
			seed = strtoull(argv[++i], NULL, 10);
		else if (i + 1 < argc && strcmp(argv[i], "--count") == 0)
			count = strtoull(argv[++i], NULL, 10);
	}
	for (uint64_t i = 0; i < count && totals.differ < 5; i++)
		judge(seed + i, &totals, show);
	printf("# %llu the same, %llu differ, %llu refused, %llu without stretches; of %llu stretches "
	       "%llu ran\n", (unsigned long long)totals.same, (unsigned long long)totals.differ,
	       (unsigned long long)totals.refused, (unsigned long long)totals.whole,
	       (unsigned long long)totals.all, (unsigned long long)totals.ran);
	CHECK_AS(totals.differ == 0, "what is left out would have changed nothing");
	CHECK_AS(totals.ran * 10 <= totals.all * 8 || count < 100, "some of it is left out");
	CHECK_AS(totals.refused * 10 <= totals.same, "few programs are refused");
	return tap_done();
}
