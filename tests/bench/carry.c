/* SPDX-License-Identifier: MIT
 *
 * carry - measures a change of a running program: to plan it, and to apply the plan between
 * two scans.
 *
 *   carry NAME OLD NEW [ROUNDS]
 *
 * Prints a row of a table: rows of the plan, its memory, the time to make it, median and
 * longest time to apply it without forces and with all forces.
 */
#include "engine/ladder.h"
#include "engine/scan/carry_plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct side {
	struct ladder *ladder;
	const struct program *program;
	void *memory;
	struct resource resource;
};

static double now_us(void)
{
	struct timespec now;

	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec * 1e6 + (double)now.tv_nsec / 1e3;
}

static int by_time(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

static bool open_side(struct side *side, const char *file)
{
	side->ladder = ladder_new();
	if (!ladder_load(side->ladder, file) || !ladder_build(side->ladder))
		return false;
	side->program = ladder_program(side->ladder);
	side->memory = calloc(1, image_memory_size(side->program));
	resource_init(&side->resource, side->program, side->memory);
	resource_start(&side->resource);
	return side->memory;
}

/* Forces as many values as possible, spread over the program. */
static void force_all(struct image *image)
{
	static struct symbol_cursor cursor;
	const uint32_t step = image->program->symbol_count / LIMIT_FORCES + 1;
	struct symbol symbol;
	uint32_t n = 0;

	cursor = (struct symbol_cursor){ .whole = true };
	while (image_next_symbol(image, &cursor, &symbol))
		if (n++ % step == 0)
			image_force(image, symbol.at, (union iec_value){ .i = 1 });
}

/* Median and longest time of @rounds changes, in µs. */
static void measure(const struct carry_plan *plan, struct side *to,
		    const struct side *from, int rounds, double *took)
{
	for (int i = 0; i < rounds; i++) {
		double begin;

		resource_init(&to->resource, to->program, to->memory);
		begin = now_us();
		if (!carry_apply(plan, &to->resource, &from->resource))
			exit(2);
		took[i] = now_us() - begin;
	}
	qsort(took, (size_t)rounds, sizeof(*took), by_time);
	printf(" %.1f | %.1f |", took[rounds / 2], took[rounds - 1]);
}

int main(int argc, char **argv)
{
	const int rounds = argc > 4 ? atoi(argv[4]) : 1001;
	double *took = malloc(sizeof(*took) * (size_t)(rounds > 0 ? rounds : 1));
	static struct side from, to;
	const struct carry_plan *plan;
	struct arena arena;
	double begin;

	if (argc < 4 || rounds < 1 || !took || !open_side(&from, argv[2]) ||
	    !open_side(&to, argv[3])) {
		fprintf(stderr, "usage: carry NAME OLD NEW [ROUNDS]\n");
		return 2;
	}
	for (int i = 1; i <= 20; i++)
		resource_scan(&from.resource, i * INT64_C(10000000));
	arena_init(&arena);
	begin = now_us();
	plan = carry_plan_new(to.program, from.program, &arena);
	begin = now_us() - begin;
	if (!plan)
		return 2;
	printf("| %s | %u | %u | %u | %llu | %u | %zu | %.1f |", argv[1],
	       (unsigned)from.program->symbol_count, (unsigned)plan->move_count,
	       (unsigned)plan->lost_count, (unsigned long long)carry_cost(plan).bytes,
	       (unsigned)carry_cost(plan).operations, arena.used, begin / 1e3);
	measure(plan, &to, &from, rounds, took);
	force_all(&from.resource.image);
	printf(" %d |", from.resource.image.force_count);
	measure(plan, &to, &from, rounds, took);
	printf("\n");
	arena_free(&arena);
	ladder_free(from.ladder);
	ladder_free(to.ladder);
	free(from.memory);
	free(to.memory);
	free(took);
	return 0;
}
