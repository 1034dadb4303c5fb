/* SPDX-License-Identifier: MIT
 *
 * differential - the engine and the walker run the same random programs; every
 * variable, output, marker and cell's power must be the same.
 *
 *   differential [--seed S] [--count N] [--long] [--refused] [--values]
 *
 * --values leaves out the power of cells, --refused prints why a program was not built.
 *
 * A program with a difference is reduced to the smallest one that still differs, and
 * printed with its seed. docs/language.md decides which side is wrong.
 */
#include "tests/tap.h"
#include "tests/walker/duel.h"

#include <stdlib.h>
#include <time.h>

#define TEXT_MAX (128 * 1024)
#ifndef DIFFERENTIAL_COUNT
#define DIFFERENTIAL_COUNT 20000
#endif

static bool values_only;

static void change_inputs(struct random_source *source, uint8_t *inputs)
{
	for (int i = 0; i < 8; i++) {
		if (random_chance(source, 50))
			inputs[i] ^= (uint8_t)(1u << random_below(source, 8));
		if (random_chance(source, 10))
			inputs[i] = (uint8_t)random_next(source);
	}
}

static int64_t time_passed(struct random_source *source)
{
	return random_chance(source, 50) ? 5000000 : random_below(source, 20000000);
}

/* One whole comparison; @why gets the reason when it is not AGREE. */
static enum verdict judge(const struct random_program *program, uint64_t seed,
			  char *why, size_t size)
{
	static char text[TEXT_MAX];
	const struct duel_plan plan = { .seed = seed, .values = values_only,
					.scans = 10, .more_scans = 11,
					.inputs = change_inputs, .passed = time_passed };

	return duel_judge(text, random_print(program, text, sizeof(text)), &plan, why,
			  size);
}

static bool still_fails(const struct random_program *program, uint64_t seed)
{
	char why[256];

	return judge(program, seed, why, sizeof(why)) == DISAGREE;
}

static void drop_rung(struct random_program *program, int at)
{
	program->rungs--;
	memmove(&program->rung[at], &program->rung[at + 1],
		(size_t)(program->rungs - at) * sizeof(program->rung[0]));
}

/* Tries smaller programs; true if one of them still fails. */
static bool shrink_cells(struct random_program *program, uint64_t seed, int at)
{
	static struct random_program trial;
	static const enum random_kind kinds[] = { RANDOM_EMPTY, RANDOM_WIRE };
	struct random_rung *rung = &program->rung[at];

	for (int i = 0; i < rung->rows * rung->cols * 3; i++) {
		int row = i / 3 / rung->cols, col = i / 3 % rung->cols;
		struct random_cell *cell;

		trial = *program;
		cell = &trial.rung[at].cell[row][col];
		if (i % 3 == 2) {
			if (!cell->link)
				continue;
			cell->link = false;
		} else {
			if (cell->kind == RANDOM_EMPTY ||
			    cell->kind == kinds[i % 3])
				continue;
			cell->kind = kinds[i % 3];
			cell->text[0] = '\0';
		}
		if (random_sound(&trial.rung[at]) && still_fails(&trial, seed)) {
			*program = trial;
			return true;
		}
	}
	return false;
}

static void drop_row(struct random_rung *rung, int at)
{
	rung->rows--;
	memmove(rung->cell[at], rung->cell[at + 1],
		(size_t)(rung->rows - at) * sizeof(rung->cell[0]));
}

static void drop_column(struct random_rung *rung, int at)
{
	rung->cols--;
	for (int row = 0; row < rung->rows; row++)
		memmove(&rung->cell[row][at], &rung->cell[row][at + 1],
			(size_t)(rung->cols - at) * sizeof(rung->cell[0][0]));
}

/* Tries the program without one of its rows or columns. */
static bool shrink_grid(struct random_program *program, uint64_t seed, int at)
{
	static struct random_program trial;
	struct random_rung *rung = &program->rung[at];

	for (int i = 0; i < rung->rows + rung->cols; i++) {
		if (i < rung->rows ? rung->rows == 1 : rung->cols == 1)
			continue;
		trial = *program;
		if (i < rung->rows)
			drop_row(&trial.rung[at], i);
		else
			drop_column(&trial.rung[at], i - rung->rows);
		if (random_sound(&trial.rung[at]) && still_fails(&trial, seed)) {
			*program = trial;
			return true;
		}
	}
	return false;
}

static bool shrink_once(struct random_program *program, uint64_t seed)
{
	static struct random_program trial;

	for (int i = 0; i < program->rungs && program->rungs > 1; i++) {
		trial = *program;
		drop_rung(&trial, i);
		if (still_fails(&trial, seed)) {
			*program = trial;
			return true;
		}
	}
	for (int i = 0; i < program->rungs; i++)
		if (shrink_grid(program, seed, i) ||
		    shrink_cells(program, seed, i))
			return true;
	return false;
}

static void report(struct random_program *program, uint64_t seed)
{
	static char text[TEXT_MAX];
	char why[256];

	for (int i = 0; i < 300 && shrink_once(program, seed); i++)
		;
	judge(program, seed, why, sizeof(why));
	random_print(program, text, sizeof(text));
	printf("# --seed %llu --count 1: %s\n", (unsigned long long)seed, why);
	for (const char *at = text; *at; ) {
		int n = (int)strcspn(at, "\n");

		printf("#   %.*s\n", n, at);
		at += n + (at[n] == '\n');
	}
	fflush(stdout);
}

struct options {
	uint64_t seed, count;
	bool endless, show_refused, text;
};

static bool read_options(int argc, char **argv, struct options *options)
{
	for (int i = 1; i < argc; i++) {
		bool more = i + 1 < argc;

		if (strcmp(argv[i], "--long") == 0)
			options->endless = true;
		else if (strcmp(argv[i], "--refused") == 0)
			options->show_refused = true;
		else if (strcmp(argv[i], "--text") == 0)
			options->text = true;
		else if (strcmp(argv[i], "--values") == 0)
			values_only = true;
		else if (more && strcmp(argv[i], "--seed") == 0)
			options->seed = strtoull(argv[++i], NULL, 10);
		else if (more && strcmp(argv[i], "--count") == 0)
			options->count = strtoull(argv[++i], NULL, 10);
		else
			return false;
	}
	return true;
}

/* The program of a seed, for other tests. */
static int print_program(uint64_t seed)
{
	static struct random_program program;
	static char text[TEXT_MAX];

	random_make(&program, seed);
	random_print(&program, text, sizeof(text));
	fputs(text, stdout);
	return 0;
}

int main(int argc, char **argv)
{
	struct options options = { .seed = 1, .count = DIFFERENTIAL_COUNT };
	static struct random_program program;
	uint64_t got[4] = { 0 }, seed;
	char why[256];

	if (!read_options(argc, argv, &options)) {
		fprintf(stderr, "usage: differential [--seed S] [--count N] "
			"[--long] [--refused] [--values] [--text]\n");
		return 2;
	}
	if (options.text)
		return print_program(options.seed);
	if (options.endless) {
		options.seed = (uint64_t)time(NULL) * 1000000;
		options.count = UINT64_MAX - options.seed;
		printf("# from seed %llu on, until stopped\n",
		       (unsigned long long)options.seed);
		fflush(stdout);
	}
	for (seed = options.seed; seed - options.seed < options.count; seed++) {
		enum verdict verdict;

		random_make(&program, seed);
		verdict = judge(&program, seed, why, sizeof(why));
		got[verdict]++;
		if (verdict == DISAGREE)
			report(&program, seed);
		else if (verdict != AGREE && options.show_refused)
			printf("# seed %llu: %s\n", (unsigned long long)seed, why);
		if (got[DISAGREE] >= 5 && !options.endless)
			break;
	}
	printf("# %llu agree, %llu differ, %llu refused, %llu not walked\n",
	       (unsigned long long)got[AGREE], (unsigned long long)got[DISAGREE],
	       (unsigned long long)got[REFUSED],
	       (unsigned long long)got[UNWALKED]);
	CHECK_AS(got[DISAGREE] == 0, "engine and walker agree");
	CHECK_AS(got[UNWALKED] == 0,
		 "the walker runs each program that the engine builds");
	CHECK_AS(got[REFUSED] * 20 <= got[AGREE], "few programs are refused");
	CHECK_AS(got[AGREE] > 0, "some programs ran");
	return tap_done();
}
