/* SPDX-License-Identifier: MIT
 *
 * cmd_bench - `ladder bench`: measures how long a program takes here. A slow machine is
 * no failure.
 */
#include "ladder/report.h"
#include "ladder/tty.h"

#include "engine/scan/still.h"
#include "hal/clock.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PERIOD_NS 10000000
#define BATCH_NS  20000   /* least duration of a sample without changes      */
#define LOADS     5       /* the fastest one is reported                     */
#define LEAST     51      /* samples without changes                         */
#define PACED     1000    /* scans that are a millisecond apart              */
#define PACE_NS   1000000

struct figure {
	double least, median, longest; /* ns a scan                           */
};

/* What the inputs do. */
enum inputs {
	INPUTS_ZERO,     /* all are FALSE                                     */
	INPUTS_FIXED,    /* random ones, which stay                           */
	INPUTS_RANDOM,   /* others in each scan                               */
	INPUTS_ONE,      /* one of them changes in each scan                  */
	INPUTS_PACED,    /* others in each scan, a millisecond after the last one: other
			    programs have used the caches                    */
};

static const struct measure {
	const char *name, *key;
	bool body;             /* the program alone                           */
	enum inputs inputs;
	bool skips;            /* what has not changed is left out            */
} measures[] = {
	{ "body, zero",   "body_zero",   true,  INPUTS_ZERO, false },
	{ "body, fixed",  "body_fixed",  true,  INPUTS_FIXED, false },
	{ "body, random", "body_random", true,  INPUTS_RANDOM, false },
	{ "body, 1 ms",   "body_paced",  true,  INPUTS_PACED, false },
	{ "scan, zero",   "scan_zero",   false, INPUTS_ZERO, false },
	{ "scan, fixed",  "scan_fixed",  false, INPUTS_FIXED, false },
	{ "scan, random", "scan_random", false, INPUTS_RANDOM, false },
	{ "scan, 1 ms",   "scan_paced",  false, INPUTS_PACED, false },
	{ "rest: body",   "rest_body",   true,  INPUTS_FIXED, true },
	{ "rest: scan",   "rest_scan",   false, INPUTS_FIXED, true },
	{ "rest: one",    "rest_one",    false, INPUTS_ONE, true },
	{ "rest: all",    "rest_all",    false, INPUTS_RANDOM, true },
};
enum { MEASURES = sizeof(measures) / sizeof(*measures) };

struct bench {
	struct call *call;
	struct machine machine;
	struct resource *resource;
	struct still *still;     /* NULL: each scan runs the whole program    */
	double *sample;
	int64_t scans, now_ns;
	int64_t load_ns, build_ns;
	double clock_ns;         /* what reading the clock itself takes       */
	uint64_t random;
	int rungs;
	struct figure figure[MEASURES];
};

static uint64_t next_random(struct bench *bench)
{
	uint64_t x = bench->random;

	x ^= x << 13;
	x ^= x >> 7;
	x ^= x << 17;
	return bench->random = x;
}

static void set_area(struct bench *bench, enum iec_area area)
{
	uint8_t *memory = image_area(&bench->resource->image, area);
	const uint32_t size = bench->resource->image.program->areas.bytes[area];

	for (uint32_t at = 0; at < size; at += sizeof(uint64_t)) {
		const uint64_t bits = next_random(bench);

		memcpy(memory + at, &bits, size - at < sizeof(bits) ? size - at : sizeof(bits));
	}
}

/* Random values in all inputs. */
static void set_inputs(struct bench *bench)
{
	set_area(bench, AREA_I);
	set_area(bench, AREA_AI);
	set_area(bench, AREA_XI);
	set_area(bench, AREA_XAI);
}

/* One bit of the inputs that the program uses. */
static void change_one(struct bench *bench)
{
	struct image *image = &bench->resource->image;
	const struct program *program = image->program;

	for (uint32_t i = 0; i < program->bits_count; i++) {
		const struct code_bits *bits = &program->bits[i];
		const uint32_t bit = bits->first + (uint32_t)(next_random(bench) % bits->count);

		if (bits->area != AREA_I)
			continue;
		image_area(image, AREA_I)[bit / 8] ^= (uint8_t)(1u << bit % 8);
		return;
	}
}

/* The program between the edges of a scan that leaves out what has not changed. */
static bool run_rest(struct bench *bench)
{
	struct resource *resource = bench->resource;
	const struct program *program = resource->image.program;
	struct still *still = resource->still;
	bool good = true;

	still_begin(still, &resource->image, resource->vm.now_ns, true);
	for (uint32_t i = 0; i < program->call_count; i++)
		good = still_run(still, &resource->vm, program->call[i]) == FAULT_NONE && good;
	still_end(still, &resource->image);
	return good;
}

static bool run_body(struct bench *bench)
{
	struct resource *resource = bench->resource;
	const struct program *program = resource->image.program;
	bool good = true;

	resource->vm.now_ns = bench->now_ns += PERIOD_NS;
	resource->vm.budget = program->header->budget;
	if (resource->still)
		return run_rest(bench);
	for (uint32_t i = 0; i < program->call_count; i++)
		good = vm_run(&resource->vm, program->call[i], false) ==
		       FAULT_NONE && good;
	return good;
}

static bool run_once(struct bench *bench, bool body)
{
	if (body)
		return run_body(bench);
	return resource_scan(bench->resource, bench->now_ns += PERIOD_NS);
}

/* One sample of @batch scans; negative: the program faulted. */
static double take_sample(struct bench *bench, bool body, int64_t batch)
{
	bool good = true;
	int64_t start, took;

	if (body)
		image_begin(&bench->resource->image);
	start = clock_now();
	for (int64_t i = 0; i < batch; i++)
		good = run_once(bench, body) && good;
	took = clock_now() - start;
	if (body)
		image_end(&bench->resource->image);
	if (!good)
		return -1;
	double ns = ((double)took - bench->clock_ns) / (double)batch;

	return ns > 0 ? ns : 0;
}

static int order(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

/* Scans of a sample whose inputs stay: many, because reading the clock takes longer than a
 * small program. */
static int64_t batch_of(struct bench *bench, bool body)
{
	const double once = take_sample(bench, body, 16);

	return once < 1 ? BATCH_NS : 1 + (int64_t)(BATCH_NS / once);
}

static int64_t count_samples(const struct bench *bench, enum inputs inputs, int64_t batch)
{
	int64_t count = 1 + bench->scans / batch;

	if (inputs == INPUTS_RANDOM || inputs == INPUTS_ONE)
		return bench->scans;
	if (count < LEAST || inputs == INPUTS_PACED)
		count = inputs == INPUTS_PACED ? PACED : LEAST;
	return count < bench->scans ? count : bench->scans;
}

static bool measure(struct bench *bench, const struct measure *measure, struct figure *out)
{
	const bool change = measure->inputs >= INPUTS_RANDOM;
	int64_t batch = 1, count;

	bench->resource->still = measure->skips ? bench->still : NULL;
	resource_start(bench->resource);
	resource_scan(bench->resource, bench->now_ns += PERIOD_NS);
	if (measure->inputs != INPUTS_ZERO)
		set_inputs(bench);
	for (int i = 0; i < 100; i++)
		take_sample(bench, measure->body, 1);
	if (!change)
		batch = batch_of(bench, measure->body);
	count = count_samples(bench, measure->inputs, batch);
	for (int64_t i = 0; i < count; i++) {
		if (measure->inputs == INPUTS_ONE)
			change_one(bench);
		else if (change)
			set_inputs(bench);
		if (measure->inputs == INPUTS_PACED)
			nanosleep(&(struct timespec){ .tv_nsec = PACE_NS }, NULL);
		bench->sample[i] = take_sample(bench, measure->body, batch);
		if (bench->sample[i] < 0)
			return false;
	}
	qsort(bench->sample, (size_t)count, sizeof(double), order);
	*out = (struct figure){
		bench->sample[0], bench->sample[count / 2], bench->sample[count - 1],
	};
	return true;
}

static void measure_clock(struct bench *bench)
{
	bench->clock_ns = 1e9;
	for (int i = 0; i < 1000; i++) {
		int64_t start = clock_now(), took = clock_now() - start;

		if ((double)took < bench->clock_ns)
			bench->clock_ns = (double)took;
	}
}

static void measure_load(struct bench *bench, const char *path)
{
	bench->load_ns = bench->build_ns = INT64_MAX;
	for (int i = 0; i < LOADS; i++) {
		struct ladder *ladder = ladder_new();
		int64_t start = clock_now(), loaded, built;
		bool good = ladder && report_read_program(ladder, path);

		loaded = clock_now();
		good = good && ladder_build(ladder);
		built = clock_now();
		ladder_free(ladder);
		if (!good)
			continue;
		if (loaded - start < bench->load_ns)
			bench->load_ns = loaded - start;
		if (built - loaded < bench->build_ns)
			bench->build_ns = built - loaded;
	}
}

/* Those that leave something out come last. */
static bool is_measured(const struct bench *bench, int i)
{
	return bench->still || !measures[i].skips;
}

static int count_rungs(const struct machine *machine)
{
	const struct project *project = ladder_project(machine->ladder);
	const struct program *program = ladder_program(machine->ladder);
	int count = 0;

	for (int i = 0; project && i < project->pou_count; i++)
		for (int k = 0; k < project->pou[i].rung_count; k++)
			count += !project->pou[i].rung[k]->off;
	for (uint32_t i = 0; !project && i < program->place_count; i++)
		count += i == 0 ||
			 program->place[i].rung != program->place[i - 1].rung ||
			 program->place[i].pou != program->place[i - 1].pou;
	return count;
}

static void print_text(const struct bench *bench)
{
	const struct program *program = ladder_program(bench->machine.ladder);
	const struct sink *out = &bench->call->out;

	sink_printf(out, "rungs   %d\n", bench->rungs);
	sink_printf(out, "image   %zu bytes, %u with names and maps\n",
		    code_strip(program->header, NULL), program->header->size);
	sink_printf(out, "memory  %zu bytes to load, %zu to run\n",
		    ladder_memory(bench->machine.ladder),
		    image_memory_size(program));
	sink_printf(out, "load    %.3f ms to read, %.3f ms to check and "
		    "translate\n", (double)bench->load_ns / 1e6,
		    (double)bench->build_ns / 1e6);
	sink_printf(out, "\n%-14s%33s%36s\n%-14s%11s%11s%11s%14s%11s%11s\n", "",
		    "ns a scan", "ns a rung", "", "least", "median", "longest",
		    "least", "median", "longest");
	for (int i = 0; i < MEASURES && is_measured(bench, i); i++) {
		const struct figure *f = &bench->figure[i];
		double n = bench->rungs ? bench->rungs : 1;

		sink_printf(out, "%-14s%11.1f%11.1f%11.1f", measures[i].name,
			    f->least, f->median, f->longest);
		if (bench->rungs)
			sink_printf(out, "%14.2f%11.2f%11.2f", f->least / n,
				    f->median / n, f->longest / n);
		sink_text(out, "\n");
	}
}

static void print_json(const struct bench *bench)
{
	const struct program *program = ladder_program(bench->machine.ladder);
	const struct sink *out = &bench->call->out;

	sink_text(out, "{\"file\": ");
	sink_json_text(out, bench->call->arg[0]);
	sink_printf(out, ", \"version\": \"%s\", \"rungs\": %d, "
		    "\"scans\": %lld, \"code_bytes\": %zu, \"image_bytes\": %u, ",
		    LADDER_VERSION, bench->rungs, (long long)bench->scans,
		    code_strip(program->header, NULL), program->header->size);
	sink_printf(out, "\"load_bytes\": %zu, \"run_bytes\": %zu, "
		    "\"read_ns\": %lld, \"build_ns\": %lld",
		    ladder_memory(bench->machine.ladder),
		    image_memory_size(program), (long long)bench->load_ns,
		    (long long)bench->build_ns);
	for (int i = 0; i < MEASURES && is_measured(bench, i); i++) {
		const struct figure *f = &bench->figure[i];

		sink_printf(out, ",\n \"%s_ns\": {\"min\": %.1f, "
			    "\"median\": %.1f, \"max\": %.1f}",
			    measures[i].key, f->least, f->median, f->longest);
	}
	sink_text(out, "}\n");
}

static enum status run(struct bench *bench)
{
	const char *path = bench->call->arg[0];

	bench->resource = &bench->machine.resource;
	bench->random = 88172645463325252u;
	bench->sample = calloc((size_t)bench->scans, sizeof(double));
	if (!bench->sample)
		return report_no_memory(path);
	bench->rungs = count_rungs(&bench->machine);
	measure_clock(bench);
	measure_load(bench, path);
	for (int i = 0; i < MEASURES && is_measured(bench, i); i++)
		if (!measure(bench, &measures[i], &bench->figure[i])) {
			report_diag((struct diag){ .id = DIAG_FAULT,
						   .file = path }, "%s",
				    fault_text(FAULT_BUDGET));
			return STATUS_NO;
		}
	if (call_flag(bench->call, "--json"))
		print_json(bench);
	else
		print_text(bench);
	return STATUS_GOOD;
}

enum status cmd_bench(struct call *call)
{
	struct bench bench = { .call = call };
	enum status status;

	if (!report_count(call, "--scans", 2000, 10000000, &bench.scans))
		return STATUS_WRONG;
	status = machine_open(&bench.machine, call->arg[0], MACHINE_AS_FILE);
	if (status == STATUS_GOOD) {
		machine_skip(&bench.machine, call);
		bench.still = bench.machine.resource.still;
		status = run(&bench);
	}
	free(bench.sample);
	machine_close(&bench.machine);
	return status;
}
