/* SPDX-License-Identifier: MIT
 *
 * test_scan - one scan as a whole: its end, its system variables, and forces. Programs
 * are written as text; no driver is used.
 */
#include "engine/ladder.h"
#include "tests/tap.h"

#include <stdlib.h>

#define MS INT64_C(1000000)

struct scan_bed {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
};

/* A program that does not build fails the test by its name; NULL is allowed. */
static bool open_bed(struct scan_bed *bed, const char *text)
{
	const struct program *program;

	memset(bed, 0, sizeof(*bed));
	bed->ladder = ladder_new();
	if (!CHECK_AS(bed->ladder &&
		      ladder_load_text(bed->ladder, "bed.rung", text,
				       strlen(text)) &&
		      ladder_build(bed->ladder), "the program builds"))
		return false;
	program = ladder_program(bed->ladder);
	bed->memory = calloc(1, image_memory_size(program));
	if (!CHECK(bed->memory != NULL))
		return false;
	resource_init(&bed->resource, program, bed->memory);
	return true;
}

static void close_bed(struct scan_bed *bed)
{
	free(bed->memory);
	ladder_free(bed->ladder);
}

static struct location at(struct scan_bed *bed, const char *name)
{
	return image_find(&bed->resource.image, name, strlen(name));
}

static int64_t get(struct scan_bed *bed, const char *name)
{
	return image_get(&bed->resource.image, at(bed, name)).i;
}

static bool set(struct scan_bed *bed, const char *name, int64_t value)
{
	return image_set(&bed->resource.image, at(bed, name),
			 (union iec_value){ .i = value });
}

static bool force(struct scan_bed *bed, const char *name, int64_t value)
{
	return image_force(&bed->resource.image, at(bed, name),
			   (union iec_value){ .i = value });
}

/* ---- the budget ---- */

static void test_loops(void)
{
	static const char *const loops[] = {
		"RUNGBOARD 1\nPROGRAM Main IL\nHere:\n  JMP Here\nEND_PROGRAM\n",
		"RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\nPROGRAM Main IL\n"
		"  LD 1\n  ST A\nHere:\n  LD A\n  JMPC Here\nEND_PROGRAM\n",
		"RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\nPROGRAM Main LD\n"
		"RUNG Here\n  | JMP Here |\nRUNG\n  | COIL A |\nEND_PROGRAM\n",
	};

	for (int i = 0; i < 3; i++) {
		struct scan_bed bed;

		if (open_bed(&bed, loops[i])) {
			resource_start(&bed.resource);
			CHECK(!resource_scan(&bed.resource, MS));
			CHECK(bed.resource.state == STATE_FAULT);
			CHECK(bed.resource.fault == FAULT_BUDGET);
			CHECK_TEXT(bed.resource.fault_at.pou, "Main");
		}
		close_bed(&bed);
	}
}

/* A jump back costs the words it jumps over, plus one. A run may spend its whole
 * budget, not more. The code has a known length: a loop of one JMP costs 1. */
static void test_budget(void)
{
	struct scan_bed bed;
	struct vm vm;
	struct code_header header;
	struct program program;

	if (!open_bed(&bed, "RUNGBOARD 1\nVAR\n  N : INT;\nEND_VAR\n"
		      "PROGRAM Main IL\nHere:\n  LD N\n  ADD 1\n  ST N\n"
		      "  LT 4\n  JMPC Here\nEND_PROGRAM\n")) {
		close_bed(&bed);
		return;
	}
	program = *ladder_program(bed.ladder);
	header = *program.header;
	program.header = &header;
	resource_start(&bed.resource);
	memset(&vm, 0, sizeof(vm));
	vm.memory = bed.memory;
	vm.program = &program;
	vm.budget = 100000;
	CHECK(vm_run(&vm, 0, false) == FAULT_NONE);
	CHECK(get(&bed, "N") == 4);
	/* Three jumps back, all of one cost. */
	uint32_t spent = 100000 - vm.budget;

	CHECK(spent > 0 && spent % 3 == 0);
	set(&bed, "N", 0);
	vm.budget = spent;
	CHECK_AS(vm_run(&vm, 0, false) == FAULT_NONE && vm.budget == 0,
		 "the run ends without a fault when its budget is just enough");
	set(&bed, "N", 0);
	vm.budget = spent - 1;
	CHECK_AS(vm_run(&vm, 0, false) == FAULT_BUDGET,
		 "the run is a fault when its budget is too small by 1");
	CHECK(get(&bed, "N") == 3);
	close_bed(&bed);
}

/* After a fault no further program runs in that scan. */
static void test_stops_there(void)
{
	struct scan_bed bed;

	if (open_bed(&bed, "RUNGBOARD 1\nVAR\n  N : INT;\nEND_VAR\n"
		     "PROGRAM One IL\nHere:\n  JMP Here\nEND_PROGRAM\n"
		     "PROGRAM Two IL\n  LD N\n  ADD 1\n  ST N\nEND_PROGRAM\n")) {
		resource_start(&bed.resource);
		CHECK(!resource_scan(&bed.resource, MS));
		CHECK(get(&bed, "N") == 0);
		CHECK_AS(!resource_scan(&bed.resource, 2 * MS),
			 "no scan runs after a fault");
		CHECK(bed.resource.scans == 1);
		resource_stop(&bed.resource);
		CHECK_AS(bed.resource.state == STATE_FAULT,
			 "a stop does not end a FAULT");
	}
	close_bed(&bed);
}

static void test_first_fault(void)
{
	struct scan_bed bed;

	if (open_bed(&bed, "RUNGBOARD 1\nPROGRAM Main IL\n  RET\n"
		     "END_PROGRAM\n")) {
		resource_start(&bed.resource);
		resource_fail(&bed.resource, FAULT_IO);
		resource_fail(&bed.resource, FAULT_WATCHDOG);
		CHECK_AS(bed.resource.fault == FAULT_IO,
			 "a second fault does not replace the first one");
		resource_start(&bed.resource);
		CHECK(bed.resource.state == STATE_RUN);
		CHECK(bed.resource.fault == FAULT_NONE);
	}
	close_bed(&bed);
}

/* ---- system variables ---- */

static void test_errors(void)
{
	struct scan_bed bed;

	if (open_bed(&bed, "RUNGBOARD 1\nVAR\n  N, Zero : INT;\nEND_VAR\n"
		     "PROGRAM Main LD\n"
		     "RUNG\n  | [ N := 1 / Zero ] |\n"
		     "RUNG\n  | [ N := 2 / Zero ] |\n"
		     "END_PROGRAM\n")) {
		resource_start(&bed.resource);
		CHECK(resource_scan(&bed.resource, MS));
		CHECK(bed.resource.vm.errors == 2);
		CHECK_AS(bed.resource.error_at.rung == 1,
			 "the place is that of the first failed operation");
		CHECK_AS(get(&bed, "SYS_MATH_ERROR") == 0,
			 "SYS_MATH_ERROR is FALSE in the scan of the error");
		set(&bed, "Zero", 1);
		CHECK(resource_scan(&bed.resource, 2 * MS));
		CHECK_AS(get(&bed, "SYS_MATH_ERROR") == 1,
			 "SYS_MATH_ERROR is TRUE in the next scan");
		CHECK(get(&bed, "SYS_ERRORS") == 2);
		CHECK(resource_scan(&bed.resource, 3 * MS));
		CHECK(get(&bed, "SYS_MATH_ERROR") == 0);
		CHECK(bed.resource.error_at.rung == 1);
	}
	close_bed(&bed);
}

/* A clock is TRUE in the first half of its period, counted from the start. */
static void test_clocks(void)
{
	static const struct {
		const char *name;
		int64_t half;
	} clocks[] = {
		{ "SYS_CLOCK_100MS", 50 }, { "SYS_CLOCK_1S", 500 },
		{ "SYS_CLOCK_1MIN", 30000 },
	};
	struct scan_bed bed;
	int64_t start = 12345 * MS;

	if (!open_bed(&bed, "RUNGBOARD 1\nPROGRAM Main IL\n  RET\n"
		      "END_PROGRAM\n")) {
		close_bed(&bed);
		return;
	}
	for (int i = 0; i < 3; i++) {
		int64_t half = clocks[i].half * MS;
		const char *name = clocks[i].name;

		resource_start(&bed.resource);
		resource_scan(&bed.resource, start);
		CHECK_AS(get(&bed, name) == 1, name);
		CHECK(get(&bed, "SYS_FIRST_SCAN") == 1);
		resource_scan(&bed.resource, start + half - 1);
		CHECK_AS(get(&bed, name) == 1, name);
		CHECK(get(&bed, "SYS_FIRST_SCAN") == 0);
		resource_scan(&bed.resource, start + half);
		CHECK_AS(get(&bed, name) == 0, name);
		resource_scan(&bed.resource, start + 2 * half - 1);
		CHECK_AS(get(&bed, name) == 0, name);
		resource_scan(&bed.resource, start + 2 * half);
		CHECK_AS(get(&bed, name) == 1, name);
	}
	close_bed(&bed);
}

static void test_told(void)
{
	struct scan_bed bed;

	if (open_bed(&bed, "RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\n"
		     "PROGRAM Main IL\n  LD A\n  ST A\nEND_PROGRAM\n")) {
		resource_start(&bed.resource);
		resource_scan(&bed.resource, MS);
		CHECK(get(&bed, "SYS_WD_LATE") == 0);
		CHECK(get(&bed, "SYS_IO_FAULT") == 0);
		CHECK(get(&bed, "SYS_FORCED_ANY") == 0);
		CHECK(get(&bed, "SYS_ALWAYS_ON") == 1);
		bed.resource.late = bed.resource.io_fault = true;
		bed.resource.scan_us = 7;
		bed.resource.scan_max_us = 9;
		force(&bed, "A", 1);
		resource_scan(&bed.resource, 2 * MS);
		CHECK(get(&bed, "SYS_WD_LATE") == 1);
		CHECK(get(&bed, "SYS_IO_FAULT") == 1);
		CHECK(get(&bed, "SYS_FORCED_ANY") == 1);
		CHECK(get(&bed, "SYS_SCAN_US") == 7);
		CHECK(get(&bed, "SYS_SCAN_MAX_US") == 9);
	}
	close_bed(&bed);
}

/* ---- forces ---- */

static const char held[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  In AT %IX0.0 : BOOL;\n"
	"  Other AT %IX0.1 : BOOL;\n"
	"  Out AT %QX0.0 : BOOL;\n"
	"  Both AT %QX0.1 : BOOL;\n"
	"  N : INT;\n"
	"  Counted : INT;\n"
	"END_VAR\n"
	"VAR CONSTANT\n"
	"  Seven : INT := 7;\n"
	"END_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n"
	"  | NO In | COIL Out |\n"
	"RUNG\n"
	"  | NO In | NO Other | COIL Both |\n"
	"RUNG\n"
	"  | [ Counted := Counted + 1 ] | [ N := Counted + 0 * Seven ] |\n"
	"END_PROGRAM\n";

static void scan_times(struct scan_bed *bed, int times)
{
	for (int i = 0; i < times; i++)
		resource_scan(&bed->resource,
			      (int64_t)(bed->resource.scans + 1) * MS);
}

static void test_force(void)
{
	struct scan_bed bed;
	struct image *image = &bed.resource.image;

	if (!open_bed(&bed, held)) {
		close_bed(&bed);
		return;
	}
	resource_start(&bed.resource);
	CHECK(force(&bed, "In", 1));
	CHECK(force(&bed, "Other", 1));
	scan_times(&bed, 1);
	CHECK_AS(get(&bed, "Both") == 1,
		 "the program reads the forced values of two inputs");
	CHECK_AS(image_area(image, AREA_Q)[0] == 3,
		 "the outputs follow the forced inputs");
	CHECK(force(&bed, "Out", 0));
	CHECK(image_is_forced(image, at(&bed, "Out")));
	scan_times(&bed, 1);
	CHECK_AS(image_area(image, AREA_Q)[0] == 2,
		 "a forced output keeps its value after the program wrote it");
	CHECK(image_unforce(image, at(&bed, "Out")));
	CHECK_AS(get(&bed, "Out") == 1,
		 "a released output has the value that the program wrote");
	CHECK(!image_unforce(image, at(&bed, "Out")));
	CHECK(!image_is_forced(image, at(&bed, "Out")));
	scan_times(&bed, 1);
	CHECK(image_area(image, AREA_Q)[0] == 3);
	close_bed(&bed);
}

/* A variable that the program does not write has its old value after a force. */
static void test_aside(void)
{
	struct scan_bed bed;
	struct image *image = &bed.resource.image;

	if (!open_bed(&bed, held)) {
		close_bed(&bed);
		return;
	}
	resource_start(&bed.resource);
	set(&bed, "In", 1);
	CHECK(force(&bed, "In", 0));
	scan_times(&bed, 3);
	CHECK(get(&bed, "Out") == 0);
	image_unforce(image, at(&bed, "In"));
	CHECK_AS(get(&bed, "In") == 1, "a released input has its old value");
	CHECK(force(&bed, "N", -5));
	CHECK(force(&bed, "N", -6));
	scan_times(&bed, 2);
	CHECK(get(&bed, "N") == -6);
	image_unforce(image, at(&bed, "N"));
	CHECK_AS(get(&bed, "N") == 5,
		 "a released number has the value that the program wrote last");
	close_bed(&bed);
}

static void test_no_force(void)
{
	struct scan_bed bed;
	struct image *image = &bed.resource.image;
	int held_count = 0;

	if (!open_bed(&bed, held)) {
		close_bed(&bed);
		return;
	}
	resource_start(&bed.resource);
	CHECK(!force(&bed, "Nobody", 1));
	CHECK(!force(&bed, "Seven", 8));
	CHECK(!set(&bed, "Seven", 8));
	CHECK(!set(&bed, "Nobody", 8));
	CHECK(get(&bed, "Seven") == 7);
	for (uint32_t bit = 0; bit < LIMIT_FORCES + 1; bit++)
		held_count += image_force(image, (struct location){
			.type = IEC_BOOL, .area = AREA_M, .where = bit },
			(union iec_value){ .i = 1 });
	CHECK(held_count == LIMIT_FORCES);
	CHECK(image->force_count == LIMIT_FORCES);
	resource_scan(&bed.resource, MS);
	CHECK(image_get_bit(image, AREA_M, LIMIT_FORCES - 1));
	CHECK(!image_get_bit(image, AREA_M, LIMIT_FORCES));
	resource_start(&bed.resource);
	CHECK_AS(image->force_count == 0, "a cold start removes all forces");
	close_bed(&bed);
}

/* ---- charts with many steps ---- */

#define STEPS 200

/* Steps S0 … with a transition to the next one each; every third one is initial. */
static void write_chart(char *text, size_t size)
{
	size_t used = (size_t)snprintf(text, size, "RUNGBOARD 1\nPROGRAM Main SFC\n"
				       "  VAR\n    Go AT %%IX0.0 : BOOL;\n  END_VAR\n");

	for (int i = 0; i < STEPS; i++)
		used += (size_t)snprintf(text + used, size - used, "  %s S%d:\n  END_STEP\n",
					 i % 3 ? "STEP" : "INITIAL_STEP", i);
	for (int i = 0; i < STEPS; i++)
		used += (size_t)snprintf(text + used, size - used, "  TRANSITION FROM S%d TO S%d := Go; END_TRANSITION\n",
					 i, (i + 1) % STEPS);
	snprintf(text + used, size - used, "END_PROGRAM\n");
}

/* How many steps are active, and are these those at @first, @first + 3 …? */
static bool active_are(struct scan_bed *bed, int first)
{
	char name[16];

	for (int i = 0; i < STEPS; i++) {
		snprintf(name, sizeof(name), "S%d.X", i);
		if (get(bed, name) != (i >= first && (i - first) % 3 == 0))
			return false;
	}
	return true;
}

/* The cursor of the first EACH of the program. */
static uint8_t *cursor_of(struct scan_bed *bed)
{
	const struct program *program = ladder_program(bed->ladder);
	const uint32_t *code = program->text + program->entry[0].text;

	while ((*code & 0xff) != VM_EACH)
		code += code_words(code);
	return bed->resource.image.memory + code[1];
}

/* One that an image has set to where there is no step; no EACH reads anything there. */
static void test_cursor(void)
{
	const uint32_t cursors[] = { STEPS - 1, STEPS, STEPS + 1, STEPS + 64, 65536, INT32_MAX, UINT32_MAX - 8, UINT32_MAX };
	static char text[STEPS * 100];
	struct scan_bed bed;

	write_chart(text, sizeof(text));
	if (!open_bed(&bed, text))
		return;
	resource_start(&bed.resource);
	CHECK(resource_scan(&bed.resource, MS) && active_are(&bed, 0));
	for (uint32_t i = 0; i < sizeof(cursors) / sizeof(*cursors); i++) {
		memcpy(cursor_of(&bed), &cursors[i], sizeof(cursors[i]));
		CHECK(resource_scan(&bed.resource, (2 + i) * MS) && active_are(&bed, 0));
	}
	CHECK(set(&bed, "Go", 1));
	CHECK(resource_scan(&bed.resource, 100 * MS) && active_are(&bed, 1));
	close_bed(&bed);
}

int main(void)
{
	test_loops();
	test_budget();
	test_stops_there();
	test_first_fault();
	test_errors();
	test_clocks();
	test_told();
	test_force();
	test_aside();
	test_no_force();
	test_cursor();
	return tap_done();
}
