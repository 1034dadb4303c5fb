/* SPDX-License-Identifier: MIT
 *
 * st_differential - the engine and the evaluator of tests/st run the same random programs of
 * Structured Text; every variable and the number of failed operations must be the same in
 * every scan. The engine runs them plain, watched, and with breakpoints and single steps.
 *
 *   st_differential [--seed S] [--count N] [--long] [--refused] [--text] [--whole] [FILE]
 *
 * ST_DIFFERENTIAL sets N. A program with a difference is printed without the lines that do not matter for it, with
 * its seed. docs/st.md decides which side is wrong.
 */
#include "tests/st/st_random.h"
#include "tests/st/st_walk.h"
#include "tests/tap.h"

#include "engine/ladder.h"
#include "engine/trial/stops.h"

#include <math.h>
#include <time.h>

#define TEXT_MAX (64 * 1024)
#define SCANS 6
#define COUNT 600  /* programs of a regular check                            */
#define SHOWN 2000

enum verdict { AGREE, DISAGREE, REFUSED, UNWALKED, ENDLESS };

struct side {
	struct resource resource;
	void *memory;
};

struct match {
	struct ladder *ladder;
	struct st_world *world;
	struct side side[2];      /* plain; watched                           */
	struct twin twin;         /* stands now and then                      */
	struct stops *stops;
	uint64_t stood;
	struct location at[SHOWN];
	char why[300];
	int scan;
};

#define SIDES 3

static struct resource *resource_of(struct match *match, int side)
{
	return side < 2 ? &match->side[side].resource : &match->twin.resource;
}

static double number(struct value value)
{
	return value.type == IEC_LREAL ? value.d : value.type == IEC_REAL ? (double)value.r :
	       (double)value.i;
}

static bool same_value(struct match *match, int side, int index)
{
	const union iec_value theirs =
		image_get(&resource_of(match, side)->image, match->at[index]);
	const struct value mine = *st_world_value(match->world, index);
	const bool real = mine.type == IEC_REAL || mine.type == IEC_LREAL;

	if (mine.type == IEC_STRING) {
		if (theirs.s->length == mine.len &&
		    memcmp(theirs.s->text, mine.text, (size_t)mine.len) == 0)
			return true;
		snprintf(match->why, sizeof(match->why), "scan %d: %s: engine '%.*s', evaluator '%.*s'",
			 match->scan, st_world_name(match->world, index), theirs.s->length,
			 theirs.s->text, mine.len, mine.text);
		return false;
	}
	if (real ? memcmp(&(double){ theirs.r }, &(double){ number(mine) }, sizeof(double)) == 0 :
		   theirs.i == mine.i)
		return true;
	snprintf(match->why, sizeof(match->why), "scan %d%s: %s: engine %.17g, evaluator %.17g",
		 match->scan, side == 2 ? " (stepped)" : side ? " (watched)" : "", st_world_name(match->world, index),
		 real ? theirs.r : (double)theirs.i, number(mine));
	return false;
}

static bool same_all(struct match *match, int side)
{
	const uint32_t errors = resource_of(match, side)->vm.errors;

	for (int i = 0; i < st_world_count(match->world); i++)
		if (st_world_is_settled(match->world, i) && !same_value(match, side, i))
			return false;
	if (errors == st_world_errors(match->world))
		return true;
	snprintf(match->why, sizeof(match->why), "scan %d: failed operations: engine %u, evaluator %u",
		 match->scan, errors, st_world_errors(match->world));
	return false;
}

/* ---- inputs ---- */

static int64_t input_value(struct random_source *source, const struct iec_type_row *row)
{
	const uint64_t bits = (uint64_t)random_next(source) << 32 | random_next(source);

	switch (random_below(source, 5)) {
	case 0: return row->low;
	case 1: return row->high;
	case 2: return (int64_t)((uint64_t)row->low + bits % ((uint64_t)row->high - (uint64_t)row->low));
	default: return (int64_t)random_below(source, 8) + (row->low < 0 && row->size > 1 ? -2 : 0);
	}
}

static void set_input(struct match *match, int index, struct random_source *source)
{
	struct value *mine = st_world_value(match->world, index);
	union iec_value theirs;

	if (mine->type == IEC_REAL) {
		static const float some[] = { 0, 1, -1.5f, 2.5f, 3.0e38f, 1.0e-40f, 0.5f, NAN };

		mine->r = some[random_below(source, sizeof(some) / sizeof(*some))];
		theirs.r = (double)mine->r;
	} else {
		mine->i = input_value(source, iec_type_row(mine->type));
		if (mine->type == IEC_TIME)
			mine->i = (int64_t)random_below(source, 20) * 1000000;
		if (mine->type == IEC_BOOL)
			mine->i &= 1;
		theirs.i = mine->i;
	}
	for (int side = 0; side < SIDES; side++)
		image_set(&resource_of(match, side)->image, match->at[index], theirs);
}

static void change_inputs(struct match *match, struct random_source *source)
{
	for (int k = 0; st_random_input(k).name; k++)
		for (int i = 0; i < st_world_count(match->world); i++)
			if (strcmp(st_world_name(match->world, i), st_random_input(k).name) == 0 &&
			    random_chance(source, 60))
				set_input(match, i, source);
}

/* ---- one program ---- */

/* Stands at some statements. */
static bool step_scan(struct match *match, struct random_source *source, int64_t now_ns)
{
	static const enum stops_step way[] = { STOPS_INTO, STOPS_INTO, STOPS_OVER, STOPS_OUT, STOPS_GO };
	uint32_t most = 400;
	bool goes_on;

	match->twin.period_ns = now_ns - match->twin.now_ns;
	do {
		const enum stops_step step = most == 0 ? STOPS_LEAVE :
			way[random_below(source, sizeof(way) / sizeof(*way))];

		goes_on = stops_scan(match->stops, &match->twin, step);
		match->stood += match->twin.resource.stopped;
		most -= most > 0;
	} while (match->twin.resource.stopped);
	return goes_on;
}

static bool scan_side(struct match *match, int side, struct random_source *source, int64_t now_ns)
{
	return side == 2 ? step_scan(match, source, now_ns) :
			   resource_scan(&match->side[side].resource, now_ns);
}

static enum verdict run_match(struct match *match, uint64_t seed)
{
	struct random_source source, steps;
	int64_t now_ns;

	random_seed(&source, seed ^ 0x57a7e);
	random_seed(&steps, seed ^ 0x57e95);
	now_ns = random_next(&source);
	for (match->scan = 1; match->scan <= SCANS; match->scan++) {
		change_inputs(match, &source);
		now_ns += random_chance(&source, 50) ? 2000000 : random_below(&source, 9000000);
		if (!st_world_scan(match->world, now_ns))
			return ENDLESS;
		for (int side = 0; side < SIDES; side++) {
			if (!scan_side(match, side, &steps, now_ns)) {
				snprintf(match->why, sizeof(match->why), "scan %d: a fault", match->scan);
				return DISAGREE;
			}
			if (!same_all(match, side))
				return DISAGREE;
		}
	}
	return AGREE;
}

/* With a breakpoint in every fifth line. */
static bool begin_steps(struct match *match)
{
	const struct program *program = ladder_program(match->ladder);
	const struct act start = { .kind = ACT_START };

	match->stops = stops_new(program);
	if (!match->stops || !twin_init(&match->twin, program, NULL, 1))
		return false;
	for (uint32_t pou = 0; pou < program->entry_count; pou++)
		for (uint32_t line = 1; (line = stops_line(program, pou, line)); line += 5)
			stops_add(match->stops, pou, line, NULL, NULL, false);
	return twin_act(&match->twin, &start);
}

static enum verdict begin_match(struct match *match, const char *text, size_t len)
{
	const struct diag_list *diags = ladder_diags(match->ladder);
	const char *why = "";

	if (!ladder_load_text(match->ladder, "random.rung", text, len) || !ladder_build(match->ladder)) {
		for (int i = 0; i < diags->count && !match->why[0]; i++)
			if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR)
				diag_print(&diags->diag[i], match->why, sizeof(match->why));
		return REFUSED;
	}
	match->world = st_world_new(ladder_project(match->ladder), &why);
	snprintf(match->why, sizeof(match->why), "%s", why);
	if (!match->world)
		return UNWALKED;
	for (int i = 0; i < 2; i++) {
		const struct program *program = ladder_program(match->ladder);
		struct side *side = &match->side[i];

		side->memory = aligned_alloc(8, (image_memory_size(program) + 7) / 8 * 8);
		if (!side->memory)
			return UNWALKED;
		resource_init(&side->resource, program, side->memory);
		resource_start(&side->resource);
		side->resource.watch = i == 1;
	}
	if (!begin_steps(match))
		return UNWALKED;
	for (int i = 0; i < st_world_count(match->world); i++) {
		const char *name = st_world_name(match->world, i);

		match->at[i] = image_find(&match->side[0].resource.image, name, strlen(name));
		if (match->at[i].type == IEC_NONE) {
			snprintf(match->why, sizeof(match->why), "the image has no %s", name);
			return UNWALKED;
		}
	}
	return AGREE;
}

static uint64_t stood; /* at statements, in all programs                    */

static enum verdict judge(const char *text, size_t len, uint64_t seed, char *why, size_t size)
{
	static struct match match;
	enum verdict verdict;

	match = (struct match){ .ladder = ladder_new() };
	if (!match.ladder)
		return UNWALKED;
	ladder_watch(match.ladder, true);
	ladder_watch_lists(match.ladder, seed % 2);
	verdict = begin_match(&match, text, len);
	if (verdict == AGREE)
		verdict = run_match(&match, seed);
	snprintf(why, size, "%s", match.why);
	free(match.side[0].memory);
	free(match.side[1].memory);
	if (match.stops)
		twin_free(&match.twin);
	stops_free(match.stops);
	stood += match.stood;
	st_world_free(match.world);
	ladder_free(match.ladder);
	return verdict;
}

/* ---- the smallest program that still differs ---- */

/* Leaves out lines @from … @from + @count - 1; length, 0: there are fewer. */
static size_t without(const char *text, int from, int count, char *out)
{
	size_t used = 0;
	int line = 0;
	bool all = false;

	for (const char *at = text; *at; line++) {
		const size_t len = strcspn(at, "\n") + (strchr(at, '\n') != NULL);

		if (line < from || line >= from + count) {
			memcpy(out + used, at, len);
			used += len;
		} else {
			all = line == from + count - 1;
		}
		at += len;
	}
	out[used] = '\0';
	return all ? used : 0;
}

static int lines_of(const char *text)
{
	int lines = 0;

	for (; *text; text++)
		lines += *text == '\n';
	return lines;
}

static bool drop(char *text, char *trial, int from, int count, uint64_t seed)
{
	char why[300];
	const size_t len = without(text, from, count, trial);

	if (!len || judge(trial, len, seed, why, sizeof(why)) != DISAGREE)
		return false;
	memcpy(text, trial, len + 1);
	return true;
}

/* A block without its first and its last line. */
static bool unwrap(char *text, char *trial, int from, int count, uint64_t seed)
{
	static char half[TEXT_MAX];
	char why[300];
	size_t len = without(text, from + count - 1, 1, half);

	len = len ? without(half, from, 1, trial) : 0;
	if (!len || judge(trial, len, seed, why, sizeof(why)) != DISAGREE)
		return false;
	memcpy(text, trial, len + 1);
	return true;
}

static bool shrink_once(char *text, uint64_t seed)
{
	static char trial[TEXT_MAX];
	bool smaller = false;

	for (int count = lines_of(text) / 2; count > 0; count = count > 8 ? count / 2 : count - 1)
		for (int from = lines_of(text) - count; from >= 0; from--)
			smaller |= drop(text, trial, from, count, seed);
	for (int count = 3; count < 14; count++)
		for (int from = lines_of(text) - count; from >= 0; from--)
			smaller |= unwrap(text, trial, from, count, seed);
	return smaller;
}

static void report(char *text, uint64_t seed)
{
	char why[300];

	while (shrink_once(text, seed))
		;
	judge(text, strlen(text), seed, why, sizeof(why));
	printf("# --seed %llu --count 1: %s\n", (unsigned long long)seed, why);
	for (const char *at = text; *at; ) {
		const int n = (int)strcspn(at, "\n");

		printf("#   %.*s\n", n, at);
		at += n + (at[n] == '\n');
	}
	fflush(stdout);
}

/* ---- */

struct options {
	uint64_t seed, count;
	bool show_refused, text, whole;
	const char *file;
};

static bool read_options(int argc, char **argv, struct options *options)
{
	for (int i = 1; i < argc; i++) {
		const bool more = i + 1 < argc;

		if (strcmp(argv[i], "--refused") == 0)
			options->show_refused = true;
		else if (strcmp(argv[i], "--text") == 0)
			options->text = true;
		else if (strcmp(argv[i], "--whole") == 0)
			options->whole = true;
		else if (strcmp(argv[i], "--long") == 0)
			*options = (struct options){ .seed = (uint64_t)time(NULL) * 1000000, .count = UINT32_MAX };
		else if (more && strcmp(argv[i], "--seed") == 0)
			options->seed = strtoull(argv[++i], NULL, 10);
		else if (more && strcmp(argv[i], "--count") == 0)
			options->count = strtoull(argv[++i], NULL, 10);
		else if (*argv[i] != '-')
			options->file = argv[i];
		else
			return false;
	}
	return true;
}

/* A program from a file. */
static int judge_file(const struct options *options)
{
	static char text[TEXT_MAX];
	static const char *const said[] = { "agree", "differ", "refused", "not walked", "too long" };
	FILE *file = fopen(options->file, "r");
	char why[300] = "";
	const size_t len = file ? fread(text, 1, sizeof(text) - 1, file) : 0;
	const enum verdict verdict = judge(text, len, options->seed, why, sizeof(why));

	if (file)
		fclose(file);
	printf("%s: %s\n", said[verdict], why);
	return verdict != AGREE;
}

int main(int argc, char **argv)
{
	const char *wish = getenv("ST_DIFFERENTIAL");
	struct options options = { .seed = 1, .count = wish ? strtoull(wish, NULL, 10) : (uint64_t)tap_rounds(COUNT) };
	static char text[TEXT_MAX];
	uint64_t got[5] = { 0 };
	char why[300];

	if (!read_options(argc, argv, &options)) {
		fprintf(stderr, "usage: st_differential [--seed S] [--count N] [--long] [--refused] [--text] [--whole] [FILE]\n");
		return 2;
	}
	if (options.file)
		return judge_file(&options);
	for (uint64_t seed = options.seed; seed - options.seed < options.count; seed++) {
		const size_t len = st_random_print(seed, text, sizeof(text));
		enum verdict verdict;

		if (options.text) {
			fputs(text, stdout);
			return 0;
		}
		verdict = judge(text, len, seed, why, sizeof(why));
		got[verdict]++;
		if ((verdict == REFUSED || verdict == UNWALKED) && options.show_refused)
			printf("# seed %llu: %s\n", (unsigned long long)seed, why);
		if (verdict == DISAGREE && options.whole)
			printf("# --seed %llu: %s\n", (unsigned long long)seed, why);
		else if (verdict == DISAGREE)
			report(text, seed);
		if (got[DISAGREE] >= 5 && !options.whole)
			break;
	}
	printf("# %llu agree, %llu differ, %llu refused, %llu not walked, %llu too long\n",
	       (unsigned long long)got[AGREE], (unsigned long long)got[DISAGREE],
	       (unsigned long long)got[REFUSED], (unsigned long long)got[UNWALKED],
	       (unsigned long long)got[ENDLESS]);
	CHECK_AS(got[DISAGREE] == 0, "engine and evaluator agree");
	CHECK_AS(got[UNWALKED] == 0, "the evaluator runs each program that the engine builds");
	CHECK_AS(got[REFUSED] * 10 <= got[AGREE], "few programs are refused");
	CHECK_AS(got[ENDLESS] * 12 <= got[AGREE], "few programs run too long");
	CHECK_AS(got[AGREE] > 0, "some programs ran");
	CHECK_AS(options.count < 2 || stood > got[AGREE], "they stood at statements");
	return tap_done();
}
