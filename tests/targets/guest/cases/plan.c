/* SPDX-License-Identifier: MIT
 *
 * plan - turns the scenarios of a program into a plan for lines: inputs that change before
 * a scan, outputs to be checked after a scan.
 *
 * The expected outputs are those of the engine in virtual time, as `ladder trace` prints
 * them. A real line may change a scan sooner or later. So the scenario also runs with
 * inputs that come some scans late, each line separately, and with a clock that is not
 * exact. An output is expected only where all these runs agree. The share that remains,
 * nearly everything, is printed.
 *
 * A scenario that goes by the date is left out, for a board has a date of its own; so is one of more than a day,
 * which takes an emulated kernel long even if it only sleeps.
 */
#include "tests/targets/guest/cases/cases.h"

#include "engine/base/file.h"
#include "engine/ladder.h"
#include "engine/trial/scenario.h"
#include "hal/iomap.h"
#include "tests/walker/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINES     32
#define EVENTS    4096
#define SCANS_MOST 12000 /* as in the scenario                                */
#define VARIANTS  40
#define LATE      1  /* the most scans that an input comes late, without debounce */
#define LOOK_EACH 1000 /* the most scans between two checks of the same outputs */
#define LONGEST_NS (86400 * INT64_C(1000000000))

struct event {
	uint32_t scan, delay;
	unsigned line;
	bool value;
};

struct maker {
	const char *folder;
	char name[64];
	struct ladder *ladder, *plant_ladder;
	struct plant plant;
	struct resource resource;
	struct arena arena;
	struct diag_list diags;
	struct iomap map;
	const struct io_point *in[LINES], *out[LINES];
	unsigned ins, outs;
	int64_t debounce_ns;       /* the longest                            */
	FILE *plan;
	/* Of one scenario. */
	const struct scenario *scenario;
	struct event event[EVENTS];
	unsigned events;
	uint32_t scans;
	uint32_t *want, *mask;
	/* Of all scenarios. */
	unsigned long bits, kept;
};

static struct maker maker;

static bool tell(const char *what)
{
	for (int i = 0; i < maker.diags.count; i++) {
		char text[600];

		diag_print(&maker.diags.diag[i], text, sizeof(text));
		fprintf(stderr, "%s\n", text);
	}
	fprintf(stderr, "make_cases: %s: %s\n", maker.name, what);
	return false;
}

/* The byte of an area in memory. */
static bool is_word_of_lines(struct location at)
{
	enum iec_area area = areas_find(&ladder_program(maker.ladder)->areas,
					at.where);

	return area != AREA_NONE && area != AREA_M && area != AREA_V &&
	       area != AREA_SM;
}

/* Of inputs and outputs. */
static bool uses_only_bits(void)
{
	const struct program *program = ladder_program(maker.ladder);
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;

	while (image_next_declared(program, &cursor, &symbol)) {
		enum iec_area area = symbol.at.area;

		if (symbol.at.type == IEC_NONE)
			continue;
		if (area == AREA_NONE && is_word_of_lines(symbol.at))
			return false;
		if (area != AREA_NONE && area != AREA_I && area != AREA_Q &&
		    area != AREA_M && area != AREA_SM && area != AREA_V)
			return false;
	}
	return true;
}

/* The bits of an array that a program indexes have no byte of their own; they have a name. */
static bool is_declared(uint32_t area, uint32_t bit)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name symbol;

	while (image_next_declared(ladder_program(maker.ladder), &cursor, &symbol))
		if (symbol.at.area == area &&
		    bit - symbol.at.where < (symbol.array.count ? symbol.array.count : 1))
			return true;
	return false;
}

static bool uses(uint32_t area, uint32_t bit)
{
	const struct program *program = ladder_program(maker.ladder);

	for (uint32_t i = 0; i < program->bits_count; i++)
		if (program->bits[i].area == area &&
		    bit - program->bits[i].first < program->bits[i].count)
			return true;
	return is_declared(area, bit);
}

static bool write_map(const char *path)
{
	FILE *out = fopen(path, "w");

	if (!out)
		return tell(path);
	fprintf(out, "BOARD \"simulated\"\n");
	for (uint32_t bit = 0; bit < 64; bit++)
		if (uses(AREA_I, bit))
			fprintf(out, "%%IX%u.%u gpio line=I%u_%u\n", bit / 8,
				bit % 8, bit / 8, bit % 8);
	for (uint32_t bit = 0; bit < 64; bit++)
		if (uses(AREA_Q, bit))
			fprintf(out, "%%QX%u.%u gpio line=Q%u_%u safe=0\n",
				bit / 8, bit % 8, bit / 8, bit % 8);
	return fclose(out) == 0;
}

static bool read_map(const char *path)
{
	size_t len;
	char *text = file_read(path, 65536, &len, &maker.diags);

	if (!text || !iomap_read(&maker.map, &maker.arena, path, text, len,
				 &maker.diags))
		return tell(path);
	free(text);
	for (int i = 0; i < maker.map.count; i++) {
		const struct io_point *point = &maker.map.point[i];

		if (maker.ins == LINES || maker.outs == LINES)
			return tell("too many lines");
		if (point->output)
			maker.out[maker.outs++] = point;
		else
			maker.in[maker.ins++] = point;
		if (point->debounce_ns > maker.debounce_ns)
			maker.debounce_ns = point->debounce_ns;
	}
	return maker.ins + maker.outs <= LINES || tell("too many lines");
}

static uint32_t bit_of(const struct io_point *point)
{
	return point->addr.byte * 8 + point->addr.bit;
}

/* The line that a setting moves; LINES: it sets no input. */
static unsigned line_of(struct location at)
{
	unsigned i = 0;

	while (i < maker.ins &&
	       (at.area != AREA_I || at.where != bit_of(maker.in[i])))
		i++;
	return i < maker.ins ? i : LINES;
}

static uint32_t scan_at(int64_t at_ns)
{
	int64_t period_ns = maker.scenario->period_ns;
	int64_t scan = (at_ns + period_ns - 1) / period_ns;

	return scan < 1 ? 1 : (uint32_t)scan;
}

/* Reads settings up to the first one of a variable that is no input. NULL: it is at the
 * start; else "" or the name of the variable. */
static const char *collect(void)
{
	static char text[80];

	maker.events = 0;
	for (int i = 0; i < maker.scenario->step_count; i++) {
		struct scenario_step *step = &maker.scenario->step[i];
		uint32_t scan = scan_at(step->at_ns);
		union iec_value value;
		unsigned line;

		if (step->verb != VERB_SET)
			continue;
		line = line_of(step->target);
		if (line == LINES) {
			snprintf(text, sizeof(text), "%.*s", step->text_len,
				 step->text);
			text[strcspn(text, "=,")] = 0;
			maker.scans = scan - 1;
			return scan <= 2 ? NULL : text;
		}
		if (maker.events == EVENTS ||
		    !formula_value(step->formula, &maker.resource.image,
				   &value))
			exit(tell("a setting cannot be computed") + 1);
		maker.event[maker.events++] =
			(struct event){ scan, 0, line, value.i != 0 };
	}
	return "";
}

/* Runs once with these delays; @out gets the outputs after each scan. The clock is
 * exact, or @slow, or varies. */
static void simulate(uint32_t *out, bool slow, struct random_source *chance)
{
	struct image *image = &maker.resource.image;
	int64_t period_ns = maker.scenario->period_ns, now_ns = 0, skew_ns = 0;

	resource_start(&maker.resource);
	for (uint32_t scan = 1; scan <= maker.scans; scan++) {
		for (unsigned i = 0; i < maker.events; i++)
			if (maker.event[i].scan + maker.event[i].delay == scan)
				image_set_bit(image, AREA_I,
					bit_of(maker.in[maker.event[i].line]),
					maker.event[i].value);
		if (chance)
			skew_ns = random_below(chance,
					       (uint32_t)(period_ns / 20));
		now_ns = (int64_t)scan * period_ns + skew_ns -
			 (slow ? (int64_t)scan : 0);
		if (!resource_scan(&maker.resource, now_ns))
			exit(tell("the program stops with a fault") + 1);
		out[scan] = 0;
		for (unsigned i = 0; i < maker.outs; i++)
			out[scan] |= (uint32_t)image_get_bit(image, AREA_Q,
				bit_of(maker.out[i])) << i;
	}
}

/* Events of one line keep their order; settings at the start are made before ladderd
 * starts. */
static void delay(struct random_source *chance, uint32_t most, int all)
{
	uint32_t last[LINES] = { 0 };

	for (unsigned i = 0; i < maker.events; i++) {
		struct event *event = &maker.event[i];

		event->delay = event->scan == 1 ? 0 :
			       all >= 0 ? (uint32_t)all :
			       random_below(chance, most + 1);
		if (event->scan + event->delay <= last[event->line] &&
		    last[event->line] > 1)
			event->delay = last[event->line] + 1 - event->scan;
		last[event->line] = event->scan + event->delay;
	}
}

static void narrow(const uint32_t *other)
{
	for (uint32_t scan = 1; scan <= maker.scans; scan++)
		maker.mask[scan] &= ~(maker.want[scan] ^ other[scan]);
}

static void run_variants(void)
{
	uint32_t *other = calloc(maker.scans + 2, sizeof(*other));
	uint32_t all = (uint32_t)((UINT64_C(1) << maker.outs) - 1);
	uint32_t late = LATE + scan_at(maker.debounce_ns) * !!maker.debounce_ns;
	int exact = 2 * (int)late + 1; /* variants without random delays    */
	struct random_source chance;

	random_seed(&chance, 4400);
	delay(&chance, late, 0);
	simulate(maker.want, false, NULL);
	for (uint32_t scan = 1; scan <= maker.scans; scan++)
		maker.mask[scan] = all;
	for (int i = 0; other && i < VARIANTS; i++) {
		delay(&chance, late, i <= exact ? i / 2 : -1);
		simulate(other, i % 2, i > exact ? &chance : NULL);
		narrow(other);
	}
	if (!other)
		exit(tell("out of memory") + 1);
	/* Also accepts a check that comes a scan too soon or too late. */
	memcpy(other + 1, maker.want + 1, maker.scans * sizeof(*other));
	other[0] = maker.want[0] = other[1];
	for (uint32_t scan = 2; scan <= maker.scans; scan++)
		maker.mask[scan] &= ~(other[scan] ^ other[scan - 1]);
	for (uint32_t scan = 1; scan < maker.scans; scan++)
		maker.mask[scan] &= ~(other[scan] ^ other[scan + 1]);
	free(other);
}

static void write_events(uint32_t scan, uint32_t *inputs, unsigned *next)
{
	uint32_t before = *inputs;

	for (; *next < maker.events && maker.event[*next].scan <= scan;
	     ++*next) {
		uint32_t mask = UINT32_C(1) << maker.event[*next].line;

		*inputs = maker.event[*next].value ? *inputs | mask :
			  *inputs & ~mask;
	}
	if (scan == 1 || *inputs != before)
		fprintf(maker.plan, "at %u %x\n", (unsigned)scan,
			(unsigned)*inputs);
}

/* Checks at the start and the end of each range without a change, and between them:
 * often at first, then rarely. */
static void write_plan(const char *until)
{
	uint32_t inputs = 0, since = 0;
	unsigned next = 0;

	fprintf(maker.plan, "scenario %lld %u %s%s%s\n",
		(long long)(maker.scenario->period_ns / 1000),
		(unsigned)maker.scans, maker.scenario->name,
		*until ? ", until it sets " : "", until);
	for (uint32_t scan = 1; scan <= maker.scans; scan++) {
		uint32_t want = maker.want[scan] & maker.mask[scan];
		uint32_t mask = maker.mask[scan];
		bool first = scan == 1 || mask != maker.mask[scan - 1] ||
			     want != (maker.want[scan - 1] & mask);
		bool last = scan == maker.scans ||
			    mask != maker.mask[scan + 1] ||
			    want != (maker.want[scan + 1] & mask);

		write_events(scan, &inputs, &next);
		since = first ? 0 : since + 1;
		if (mask && (first || last || (since & (since - 1)) == 0 ||
			     since % LOOK_EACH == 0))
			fprintf(maker.plan, "see %u %x %x\n", (unsigned)scan,
				(unsigned)want, (unsigned)mask);
		maker.bits += maker.outs;
		maker.kept += (unsigned long)__builtin_popcount(mask);
	}
	fprintf(maker.plan, "end\n");
}

/* Whether the scenario holds; then counts its scans. */
static bool holds(const struct scenario_file *file, int index)
{
	struct sink_memory report;
	bool good;

	sink_memory_init(&report);
	struct sink sink = sink_to_memory(&report);

	good = scenario_run(file, index, &maker.resource, NULL, &sink);
	sink_memory_free(&report);
	maker.scans = (uint32_t)maker.resource.scans;
	return good;
}

/* Scenarios of hours are scanned less often: with the longest period for which the
 * scenario still holds, up to a limit. */
static bool choose_period(struct scenario_file *file, int index)
{
	static const int times[] = { 2, 5, 10, 20, 50 };
	struct scenario *scenario = &file->scenario[index];
	int64_t period_ns = scenario->period_ns, best_ns = period_ns;

	if (!holds(file, index))
		return tell("a scenario does not hold");
	for (int i = 0; i < 5 && maker.scans > SCANS_MOST; i++) {
		scenario->period_ns = period_ns * times[i];
		if (holds(file, index))
			best_ns = scenario->period_ns;
		else
			maker.scans = UINT32_MAX;
	}
	scenario->period_ns = best_ns;
	return holds(file, index);
}

/* Whether another date, time of the day or day of the week gives other outputs. */
static bool goes_by_date(void)
{
	static const int64_t hours[] = { 183 * 24 + 12, 3 * 24 + 7 };
	const size_t bytes = maker.scans * sizeof(*maker.want);
	const int64_t wall_ns = maker.resource.wall_offset_ns;
	bool differs = false;

	delay(NULL, 0, 0);
	simulate(maker.want, false, NULL);
	for (int i = 0; i < 2; i++) {
		maker.resource.wall_offset_ns = wall_ns + hours[i] * 3600 * INT64_C(1000000000);
		simulate(maker.mask, false, NULL);
		differs = differs || memcmp(maker.want + 1, maker.mask + 1, bytes) != 0;
	}
	maker.resource.wall_offset_ns = wall_ns;
	return differs;
}

static bool make_scenario(struct scenario_file *file, int index)
{
	const char *until;

	maker.scenario = &file->scenario[index];
	if (!choose_period(file, index))
		return false;
	until = collect();
	if (!until) {
		fprintf(maker.plan, "skip %s\n", maker.scenario->name);
		return true;
	}
	maker.want = calloc(maker.scans + 2, sizeof(*maker.want));
	maker.mask = calloc(maker.scans + 2, sizeof(*maker.mask));
	if (!maker.want || !maker.mask)
		return tell("out of memory");
	if (maker.scans * maker.scenario->period_ns > LONGEST_NS) {
		fprintf(maker.plan, "days %s\n", maker.scenario->name);
	} else if (goes_by_date()) {
		fprintf(maker.plan, "dated %s\n", maker.scenario->name);
	} else {
		run_variants();
		write_plan(until);
	}
	free(maker.want);
	free(maker.mask);
	return true;
}

static void write_head(const char *map)
{
	const char *name = strrchr(map, '/');

	fprintf(maker.plan, "name %s\nmap %s\n", maker.name,
		name ? name + 1 : map);
	for (unsigned i = 0; i < maker.ins; i++)
		fprintf(maker.plan, "in %s%s\n", maker.in[i]->line,
			maker.in[i]->active_low ? " low" : "");
	for (unsigned i = 0; i < maker.outs; i++)
		fprintf(maker.plan, "out %s%s\n", maker.out[i]->line,
			maker.out[i]->active_low ? " low" : "");
}

/* The plant is loaded only because the scenario names it. */
static bool read_scenarios(const char *scn, const char *text, size_t len,
			   struct scenario_file *file)
{
	struct diag place;
	const char *name = scenario_find_plant(scn, text, len, &maker.arena, &place);
	const char *slash = strrchr(scn, '/');
	const struct image *image = NULL;
	char path[512];

	snprintf(path, sizeof(path), "%.*s%s", slash ? (int)(slash + 1 - scn) : 0, scn,
		 name ? name : "");
	if (name) {
		maker.plant_ladder = ladder_new();
		if (!ladder_load(maker.plant_ladder, path) ||
		    !ladder_build(maker.plant_ladder) ||
		    !plant_init(&maker.plant, ladder_program(maker.plant_ladder),
				maker.resource.image.program))
			return tell(path);
		image = &maker.plant.resource.image;
	}
	return scenario_read(scn, text, len, &maker.resource.image, image,
			     (struct formula_projects){ ladder_project(maker.ladder),
				maker.plant_ladder ? ladder_project(maker.plant_ladder) : NULL },
			     &maker.arena, file, &maker.diags);
}

static bool make_all(const char *scn)
{
	struct scenario_file file;
	size_t len;
	char *text = file_read(scn, 1 << 20, &len, &maker.diags);
	bool good = text && read_scenarios(scn, text, len, &file);

	if (!good)
		return tell(scn);
	/* On a board there is no simulated plant. */
	for (int i = 0; good && i < file.count; i++)
		good = file.scenario[i].with_plant || make_scenario(&file, i);
	free(text);
	printf("# %s: %d scenarios, %.1f %% of output bits are expected\n",
	       maker.name, file.count,
	       maker.bits ? 100.0 * (double)maker.kept / (double)maker.bits :
			    0.0);
	/* A plan must contain enough checks. */
	return good && (maker.kept * 10 >= maker.bits * 8 ||
			tell("too little can be expected"));
}

int make_plan(const char *folder, const char *rung, const char *scn,
	      const char *map)
{
	static _Alignas(8) uint8_t memory[1 << 20];
	static char path[512], own[512];
	const char *name = strrchr(rung, '/');
	bool good;

	maker.folder = folder;
	name = name ? name + 1 : rung;
	snprintf(maker.name, sizeof(maker.name), "%.*s",
		 (int)strcspn(name, "."), name);
	arena_init(&maker.arena);
	diag_init(&maker.diags);
	maker.ladder = ladder_new();
	if (!maker.ladder || !ladder_load(maker.ladder, rung) ||
	    !ladder_build(maker.ladder) ||
	    image_memory_size(ladder_program(maker.ladder)) > sizeof(memory))
		return !tell("does not build");
	/* The intervals of tasks are too short for an emulated machine. */
	if (!uses_only_bits() || tasks_declared(ladder_program(maker.ladder)))
		return 3;
	resource_init(&maker.resource, ladder_program(maker.ladder), memory);
	snprintf(own, sizeof(own), "%s/%s.io", folder, maker.name);
	snprintf(path, sizeof(path), "%s/%s.plan", folder, maker.name);
	if ((!map && !write_map(own)) || !read_map(map ? map : own))
		return 1;
	maker.plan = fopen(path, "w");
	if (!maker.plan)
		return !tell(path);
	write_head(map ? map : own);
	good = make_all(scn);
	if (fclose(maker.plan) != 0)
		good = tell(path);
	if (!good)
		remove(path);
	ladder_free(maker.ladder);
	arena_free(&maker.arena);
	return !good;
}
