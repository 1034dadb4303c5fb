/* SPDX-License-Identifier: MIT
 *
 * differential - the engine and the walker run the same random programs, and
 * every variable, output, marker and cell's power must be the same.
 *
 *   differential [--seed S] [--count N] [--long] [--refused] [--values]
 *
 * --values leaves out the power of cells, --refused tells why a program was not built.
 *
 * A program on which they differ is cut down to the smallest that still does,
 * and printed with its seed. It decides nothing about who is right: that is
 * what docs/language.md is for.
 */
#include "engine/ladder.h"
#include "tests/tap.h"
#include "tests/walker/random.h"
#include "tests/walker/walker.h"

#include <stdlib.h>
#include <time.h>

#define TEXT_MAX (128 * 1024)
#define COMPARED 1500 /* variables of one program                            */
#define WINDOW 16     /* bytes of I, Q and M that programs use               */
#define MARKS 24

enum verdict { AGREE, DISAGREE, REFUSED, UNWALKED };

#ifndef DIFFERENTIAL_COUNT
#define DIFFERENTIAL_COUNT 20000
#endif

struct side {
	struct resource resource;
	void *memory;
	struct location at[COMPARED];
};

struct duel {
	struct ladder *ladder;
	struct walker *walker;
	struct side side[2];  /* plain; watched                              */
	uint64_t seed;
	int scan;
	bool values;          /* the power of cells does not count           */
	char why[256];
};

static void differ(struct duel *duel, int side, const char *what, double engine,
		   double walker)
{
	snprintf(duel->why, sizeof(duel->why),
		 "scan %d%s: %s: engine %.17g, walker %.17g", duel->scan + 1,
		 side ? " (watched)" : "", what, engine, walker);
}

static bool same_values(struct duel *duel, int side)
{
	struct image *image = &duel->side[side].resource.image;

	for (int i = 0; i < walker_count(duel->walker) && i < COMPARED; i++) {
		struct location at = duel->side[side].at[i];
		struct value mine = walker_value(duel->walker, i);
		union iec_value theirs = image_get(image, at);
		bool real = mine.type == IEC_REAL || mine.type == IEC_LREAL;
		double a = real ? theirs.r : (double)theirs.i;
		double b = mine.type == IEC_LREAL ? mine.d :
			   real ? (double)mine.r : (double)mine.i;

		if (!walker_is_settled(duel->walker, i))
			continue;
		if (mine.type == IEC_STRING) {
			if (theirs.s->length == mine.len &&
			    memcmp(theirs.s->text, mine.text, (size_t)mine.len) == 0)
				continue;
			differ(duel, side, walker_name(duel->walker, i),
			       theirs.s->length, mine.len);
			return false;
		}
		if (real ? a != b && (a == a || b == b) : theirs.i != mine.i) {
			differ(duel, side, walker_name(duel->walker, i), a, b);
			return false;
		}
	}
	return true;
}

static bool same_area(struct duel *duel, int side, enum iec_area area, int size)
{
	const uint8_t *a = image_area(&duel->side[side].resource.image, area);
	const uint8_t *b = walker_area(duel->walker, area);
	char text[32];

	for (int i = 0; i < size; i++) {
		if (a[i] == b[i])
			continue;
		snprintf(text, sizeof(text), "%%%sB%d",
			 iec_area_row(area)->letters, i);
		differ(duel, side, text, a[i], b[i]);
		return false;
	}
	return true;
}

/* Of a POU, or of a block in an instance of it. */
struct body {
	const struct pou *pou;
	int number;
	const char *instance; /* NULL: of a POU                               */
};

static bool engine_power(struct duel *duel, const struct body *body, uint32_t rung,
			 uint32_t row, uint32_t col, bool *in, bool *out)
{
	const struct resource *resource = &duel->side[1].resource;

	if (!body->instance)
		return resource_power(resource, (uint32_t)body->number, rung, row, col,
				      in, out);
	return resource_power_in(resource, body->instance, strlen(body->instance), rung,
				 row, col, in, out);
}

static bool same_cell(struct duel *duel, const struct body *body, int rung, int row,
		      int col)
{
	bool in = false, out = false, my_in = false, my_out = false;
	enum walker_power known = body->instance ?
		walker_power_in(duel->walker, body->number, rung, row, col, &my_in, &my_out) :
		walker_power(duel->walker, body->number, rung, row, col, &my_in, &my_out);
	char text[160];

	if (known == POWER_UNKNOWN)
		return true;
	snprintf(text, sizeof(text), "power of %.60s rung %d (%d,%d)",
		 body->instance ? body->instance : "", rung, row, col);
	if (!engine_power(duel, body, (uint32_t)rung, (uint32_t)row, (uint32_t)col, &in,
			  &out)) {
		differ(duel, 1, text, -1, my_in);
		return false;
	}
	if (in == my_in && (known == POWER_IN_ONLY || out == my_out))
		return true;
	differ(duel, 1, text, in * 2 + out, my_in * 2 + my_out);
	return false;
}

static bool same_body(struct duel *duel, const struct body *body)
{
	for (int i = 0; i < body->pou->rung_count; i++) {
		const struct rung *rung = body->pou->rung[i];

		for (int c = 0; c < rung->rows * rung->cols; c++)
			if (!same_cell(duel, body, i + 1, c / rung->cols + 1,
				       c % rung->cols + 1))
				return false;
	}
	return true;
}

static bool same_power(struct duel *duel)
{
	const struct project *project = ladder_project(duel->ladder);
	struct body body = { NULL, 0, NULL };

	for (; body.number < project->pou_count; body.number++) {
		body.pou = &project->pou[body.number];
		if (!same_body(duel, &body))
			return false;
	}
	for (body.number = 0; (body.pou = walker_instance(duel->walker, body.number,
			       &body.instance)) != NULL; body.number++)
		if (!same_body(duel, &body))
			return false;
	return true;
}

static bool same_scan(struct duel *duel, struct random_source *source,
		      int64_t now_ns)
{
	uint8_t *inputs = walker_area(duel->walker, AREA_I);
	bool good = walker_scan(duel->walker, now_ns);

	for (int side = 0; side < 2; side++) {
		struct resource *resource = &duel->side[side].resource;

		memcpy(image_area(&resource->image, AREA_I), inputs, WINDOW);
		if (resource_scan(resource, now_ns) != good) {
			differ(duel, side, "scan ends", !good, good);
			return false;
		}
		if (!good)
			return true;
		if (!same_area(duel, side, AREA_Q, WINDOW) ||
		    !same_area(duel, side, AREA_M, MARKS) ||
		    !same_values(duel, side))
			return false;
		if (resource->vm.errors != walker_errors(duel->walker)) {
			differ(duel, side, "failed operations",
			       resource->vm.errors,
			       walker_errors(duel->walker));
			return false;
		}
	}
	return duel->values || !random_chance(source, 50) || same_power(duel);
}

static void change_inputs(struct duel *duel, struct random_source *source)
{
	uint8_t *inputs = walker_area(duel->walker, AREA_I);

	for (int i = 0; i < 8; i++) {
		if (random_chance(source, 50))
			inputs[i] ^= (uint8_t)(1u << random_below(source, 8));
		if (random_chance(source, 10))
			inputs[i] = (uint8_t)random_next(source);
	}
}

static bool run_duel(struct duel *duel)
{
	struct random_source source;
	int scans;
	int64_t now_ns;

	random_seed(&source, duel->seed ^ 0x5ca5ca5c);
	now_ns = random_next(&source);
	scans = 10 + (int)random_below(&source, 11);
	for (duel->scan = 0; duel->scan < scans; duel->scan++) {
		change_inputs(duel, &source);
		now_ns += random_chance(&source, 50) ? 5000000 :
			  random_below(&source, 20000000);
		if (!same_scan(duel, &source, now_ns))
			return false;
	}
	return true;
}

static bool set_up(struct duel *duel)
{
	const struct program *program = ladder_program(duel->ladder);

	for (int i = 0; i < 2; i++) {
		struct side *side = &duel->side[i];
		size_t size = (image_memory_size(program) + 7) / 8 * 8;

		side->memory = aligned_alloc(8, size);
		if (!side->memory)
			return false;
		resource_init(&side->resource, program, side->memory);
		resource_start(&side->resource);
		side->resource.watch = i == 1;
		for (int v = 0; v < walker_count(duel->walker) &&
		     v < COMPARED; v++) {
			const char *name = walker_name(duel->walker, v);

			side->at[v] = image_find(&side->resource.image, name,
						 strlen(name));
			if (side->at[v].type != IEC_NONE)
				continue;
			snprintf(duel->why, sizeof(duel->why),
				 "the image has no %s", name);
			return false;
		}
	}
	return true;
}

static enum verdict fight(struct duel *duel, const char *text, size_t len)
{
	struct diag_list *diags = ladder_diags(duel->ladder);
	const char *why = "";

	if (!ladder_load_text(duel->ladder, "random.rung", text, len) ||
	    !ladder_build(duel->ladder)) {
		for (int i = 0; i < diags->count; i++)
			if (diag_severity(diags->diag[i].id) == SEVERITY_ERROR) {
				diag_print(&diags->diag[i], duel->why,
					   sizeof(duel->why));
				break;
			}
		return REFUSED;
	}
	duel->walker = walker_new(ladder_project(duel->ladder), &why);
	if (!duel->walker) {
		snprintf(duel->why, sizeof(duel->why), "walker: %s", why);
		return UNWALKED;
	}
	return set_up(duel) && run_duel(duel) ? AGREE : DISAGREE;
}

static bool values_only;

/* One whole comparison; @why gets the reason when it is not AGREE. */
static enum verdict judge(const struct random_program *program, uint64_t seed,
			  char *why, size_t size)
{
	static char text[TEXT_MAX];
	static struct duel duel;
	enum verdict verdict = UNWALKED;
	size_t len = random_print(program, text, sizeof(text));

	memset(&duel, 0, sizeof(duel));
	duel.seed = seed;
	duel.values = values_only;
	duel.ladder = ladder_new();
	if (duel.ladder)
		ladder_watch(duel.ladder, true);
	if (duel.ladder)
		verdict = fight(&duel, text, len);
	snprintf(why, size, "%s", duel.why);
	free(duel.side[0].memory);
	free(duel.side[1].memory);
	walker_free(duel.walker);
	ladder_free(duel.ladder);
	return verdict;
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

/* One smaller program after the other; true if one of them still fails. */
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

/* Without one of its rows or columns. */
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
	CHECK_AS(got[UNWALKED] == 0, "every program that is built is walked");
	CHECK_AS(got[REFUSED] * 20 <= got[AGREE], "few programs are refused");
	CHECK_AS(got[AGREE] > 0, "some programs ran");
	return tap_done();
}
