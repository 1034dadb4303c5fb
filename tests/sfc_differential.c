/* SPDX-License-Identifier: MIT
 *
 * sfc_differential - the engine and the walker's token game run the same random charts:
 * every Step.X, Step.T, output, alarm and count of runs must be the same in every scan.
 *
 *   sfc_differential [--seed S] [--count N] [--long] [--refused] [--values] [--text]
 *   sfc_differential FILE.rung …
 *
 * A chart with a difference is reduced to the smallest one that still differs, and
 * printed with its seed; --text prints the chart of a seed. Files are run on random
 * inputs. docs/sfc.md decides which side is wrong.
 */
#include "tests/tap.h"
#include "tests/walker/duel.h"
#include "tests/walker/random_sfc.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define TEXT_MAX (128 * 1024)

#ifndef DIFFERENTIAL_COUNT
#define DIFFERENTIAL_COUNT 12000
#endif

struct options {
	uint64_t seed, count;
	bool endless, refused, values, text;
	int file; /* of argv; 0: none                                         */
};

/* An input changes sometimes; a control less often, and not for long. */
static void change_inputs(struct random_source *source, uint8_t *inputs)
{
	for (int i = 0; i < 4; i++)
		if (random_chance(source, 60))
			inputs[0] ^= (uint8_t)(1u << random_below(source, 8));
	for (int i = 0; i < 5; i++) {
		uint8_t bit = (uint8_t)(1u << i);

		if (random_chance(source, inputs[1] & bit ? 40 : i == 4 ? 40 : 3))
			inputs[1] ^= bit;
	}
	if (random_chance(source, 4))
		inputs[2] = (uint8_t)random_below(source, 24);
}

static int64_t time_passed(struct random_source *source)
{
	switch (random_below(source, 4)) {
	case 0:
		return random_below(source, 60000000);
	case 1:
		return random_chance(source, 10) ? 500000000 : 0;
	default:
		return 10000000;
	}
}

static enum verdict judge_text(const char *text, size_t len, uint64_t seed, bool values,
			       char *why, size_t size)
{
	const struct duel_plan plan = { .seed = seed, .values = values, .scans = 50,
					.more_scans = 21, .inputs = change_inputs,
					.passed = time_passed };

	return duel_judge(text, len, &plan, why, size);
}

static enum verdict judge(struct random_sfc *chart, bool values, char *why, size_t size)
{
	static char text[TEXT_MAX];
	size_t len = random_sfc_print(chart, text, sizeof(text));

	return judge_text(text, len, chart->seed, values, why, size);
}

/* Without another part, if it still fails then. */
static bool shrink_once(struct random_sfc *chart, bool values)
{
	static struct random_sfc trial;
	char why[256];

	for (int i = 0; i < chart->part_count && chart->dropped_count < SFC_PARTS; i++) {
		trial = *chart;
		trial.dropped[trial.dropped_count++] = chart->part[i];
		if (judge(&trial, values, why, sizeof(why)) == DISAGREE) {
			*chart = trial;
			return true;
		}
	}
	return false;
}

static void report(struct random_sfc *chart, bool values)
{
	static char text[TEXT_MAX];
	char why[256];

	while (shrink_once(chart, values))
		;
	judge(chart, values, why, sizeof(why));
	random_sfc_print(chart, text, sizeof(text));
	printf("# --seed %llu --count 1: %s\n", (unsigned long long)chart->seed, why);
	for (const char *at = text; *at; ) {
		int n = (int)strcspn(at, "\n");

		printf("#   %.*s\n", n, at);
		at += n + (at[n] == '\n');
	}
	fflush(stdout);
}

static bool read_option(const char *word, struct options *options)
{
	static const char *const words[] = { "--long", "--refused", "--values", "--text" };
	bool *const flags[] = { &options->endless, &options->refused, &options->values,
				&options->text };

	for (int i = 0; i < 4; i++)
		if (strcmp(word, words[i]) == 0) {
			*flags[i] = true;
			return true;
		}
	return false;
}

static bool read_options(int argc, char **argv, struct options *options)
{
	for (int i = 1; i < argc; i++) {
		if (argv[i][0] != '-') {
			options->file = i;
			return true;
		}
		if (i + 1 < argc && strcmp(argv[i], "--seed") == 0)
			options->seed = strtoull(argv[++i], NULL, 10);
		else if (i + 1 < argc && strcmp(argv[i], "--count") == 0)
			options->count = strtoull(argv[++i], NULL, 10);
		else if (!read_option(argv[i], options))
			return false;
	}
	return true;
}

static int print_chart(uint64_t seed)
{
	static struct random_sfc chart;
	static char text[TEXT_MAX];

	chart.seed = seed;
	random_sfc_print(&chart, text, sizeof(text));
	fputs(text, stdout);
	return 0;
}

/* A file, on the inputs of many seeds. */
static bool run_file(const char *path, const struct options *options, char *why, size_t size)
{
	static char text[TEXT_MAX];
	FILE *file = fopen(path, "rb");
	size_t len = file ? fread(text, 1, sizeof(text) - 1, file) : 0;
	enum verdict verdict = len ? AGREE : REFUSED;

	if (file)
		fclose(file);
	text[len] = '\0';
	for (uint64_t seed = 1; seed <= 50 && verdict == AGREE; seed++)
		verdict = judge_text(text, len, seed, options->values, why, size);
	return verdict == AGREE;
}

static int run_files(int argc, char **argv, const struct options *options)
{
	char why[256] = "";

	for (int i = options->file; i < argc; i++) {
		bool good = run_file(argv[i], options, why, sizeof(why));

		CHECK_AS(good, argv[i]);
		if (!good)
			printf("# %s\n", why);
	}
	return tap_done();
}

int main(int argc, char **argv)
{
	struct options options = { .seed = 1, .count = DIFFERENTIAL_COUNT };
	static struct random_sfc chart;
	uint64_t got[4] = { 0 }, seed, unsafe = 0;
	char why[256];

	if (!read_options(argc, argv, &options)) {
		fprintf(stderr, "usage: sfc_differential [--seed S] [--count N] [--long] "
			"[--refused] [--values] [--text] [FILE.rung ...]\n");
		return 2;
	}
	if (options.file)
		return run_files(argc, argv, &options);
	if (options.text)
		return print_chart(options.seed);
	if (options.endless) {
		options.seed = (uint64_t)time(NULL) * 1000000;
		options.count = UINT64_MAX - options.seed;
		printf("# from seed %llu on, until stopped\n",
		       (unsigned long long)options.seed);
	}
	for (seed = options.seed; seed - options.seed < options.count; seed++) {
		enum verdict verdict;

		chart.seed = seed;
		chart.dropped_count = 0;
		verdict = judge(&chart, options.values, why, sizeof(why));
		got[verdict]++;
		unsafe += verdict == AGREE && chart.unsafe;
		if (verdict == DISAGREE)
			report(&chart, options.values);
		else if (verdict != AGREE && options.refused)
			printf("# seed %llu: %s\n", (unsigned long long)seed, why);
		if (got[DISAGREE] >= 5 && !options.endless)
			break;
	}
	printf("# %llu agree (of them %llu where tokens may meet), %llu differ, %llu refused, "
	       "%llu not walked\n", (unsigned long long)got[AGREE],
	       (unsigned long long)unsafe, (unsigned long long)got[DISAGREE],
	       (unsigned long long)got[REFUSED], (unsigned long long)got[UNWALKED]);
	CHECK_AS(got[DISAGREE] == 0, "engine and walker agree");
	CHECK_AS(got[UNWALKED] == 0, "the walker runs each chart that the engine builds");
	CHECK_AS(got[REFUSED] * 20 <= got[AGREE], "few charts are refused");
	CHECK_AS(unsafe > 0, "tokens met in some charts");
	return tap_done();
}
