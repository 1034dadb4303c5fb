/* SPDX-License-Identifier: MIT
 *
 * test_resource - states, system bits and clocks, errors and faults with their
 * places, the power of cells.
 */
#include "tests/unit/rig.h"

#define MS INT64_C(1000000)

static const char source[] =
	"VAR\n"
	"  Go    AT %IX0.0 : BOOL;\n"
	"  Spin  AT %IX0.1 : BOOL;\n"
	"  Split AT %IX0.2 : BOOL;\n"
	"  Count : INT;\n"
	"  Rest  : INT;\n"
	"  Firsts : INT;\n"
	"END_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Go | --- | COIL Q0 |\n  | NO Q0 ^|\n"
	"RUNG\n  | NO SYS_FIRST_SCAN | [ Firsts := Firsts + 1 ] |\n"
	"RUNG\n  | NO Go | NO Split | DIV IN1:=Count IN2:=Rest OUT=>Rest | COIL Q1 |\n"
	"RUNG Again\n  | [ Count := Count + 1 ] |\n"
	"RUNG OFF\n  | NO I7 | COIL Q7 |\n"
	"RUNG\n  | NO Go | NO Spin | JMP Again |\n"
	"END_PROGRAM\n"
	"PROGRAM Last LD\nRUNG\n  | NO Go | NC Spin | COIL Q2 |\nEND_PROGRAM\n";

static struct rig rig;

static bool scan_at(int64_t ms)
{
	return resource_scan(&rig.resource, ms * MS);
}

static void has_states(void)
{
	struct resource *r = &rig.resource;

	CHECK(r->state == STATE_RUN && r->scans == 0);
	resource_stop(r);
	CHECK(r->state == STATE_STOP && !scan_at(0) && r->scans == 0);
	CHECK(rig_get(&rig, "Count") == 0);
	resource_start(r);
	CHECK(scan_at(5) && r->scans == 1 && rig_get(&rig, "Count") == 1);
	resource_fail(r, FAULT_IO);
	resource_fail(r, FAULT_WATCHDOG);
	CHECK_AS(r->state == STATE_FAULT && r->fault == FAULT_IO,
		 "a second fault does not replace the first one");
	CHECK(!scan_at(6) && r->scans == 1);
	resource_stop(r);
	CHECK_AS(r->state == STATE_FAULT, "a stop does not clear a fault");
	resource_start(r);
	CHECK(r->state == STATE_RUN && r->fault == FAULT_NONE);
	CHECK_AS(rig_get(&rig, "Count") == 0, "a start resets the variables");
	for (int fault = 0; fault < FAULT_COUNT; fault++)
		CHECK(fault_text((enum fault)fault)[0] != '\0');
	CHECK_TEXT(fault_text(FAULT_COUNT), "unknown");
}

static void shows_first_scan(void)
{
	resource_start(&rig.resource);
	CHECK(scan_at(0) && rig_get(&rig, "SYS_FIRST_SCAN") == 1);
	CHECK(rig_get(&rig, "Firsts") == 1);
	CHECK(scan_at(1) && rig_get(&rig, "SYS_FIRST_SCAN") == 0);
	CHECK(rig_get(&rig, "Firsts") == 1 && rig_get(&rig, "SYS_ALWAYS_ON") == 1);
	CHECK(rig_set(&rig, "SYS_ALWAYS_ON", 0) && scan_at(2));
	CHECK(rig_get(&rig, "SYS_ALWAYS_ON") == 1);
}

/* Clocks begin with the first scan: first half TRUE. */
static void has_clocks(void)
{
	static const struct { int64_t ms; int fast, second, minute; } want[] = {
		{ 0, 1, 1, 1 }, { 49, 1, 1, 1 }, { 50, 0, 1, 1 },
		{ 100, 1, 1, 1 }, { 499, 0, 1, 1 }, { 500, 1, 0, 1 },
		{ 1000, 1, 1, 1 }, { 29999, 0, 0, 1 }, { 30000, 1, 1, 0 },
		{ 59999, 0, 0, 0 }, { 60000, 1, 1, 1 },
	};

	resource_start(&rig.resource);
	for (size_t i = 0; i < sizeof(want) / sizeof(want[0]); i++) {
		CHECK(scan_at(123456789 + want[i].ms));
		CHECK(rig_get(&rig, "SYS_CLOCK_100MS") == want[i].fast);
		CHECK(rig_get(&rig, "SYS_CLOCK_1S") == want[i].second);
		CHECK(rig_get(&rig, "SYS_CLOCK_1MIN") == want[i].minute);
	}
}

static void shows_what_it_is_told(void)
{
	struct resource *r = &rig.resource;

	r->late = r->io_fault = true;
	r->scan_us = 70000;
	r->scan_max_us = 80000;
	resource_disk(r, true);
	CHECK(scan_at(200000000));
	CHECK(rig_get(&rig, "SYS_DISK_FAULT"));
	CHECK(rig_get(&rig, "SYS_WD_LATE") && rig_get(&rig, "SYS_IO_FAULT"));
	CHECK(rig_get(&rig, "SYS_SCAN_US") == 70000);
	CHECK(rig_get(&rig, "SYS_SCAN_MAX_US") == 80000);
	resource_start(r);
	CHECK(scan_at(0));
	CHECK(!rig_get(&rig, "SYS_DISK_FAULT"));
	CHECK(!rig_get(&rig, "SYS_WD_LATE") && !rig_get(&rig, "SYS_IO_FAULT"));
	CHECK(rig_get(&rig, "SYS_SCAN_US") == 0);
}

static void counts_errors(void)
{
	struct resource *r = &rig.resource;

	resource_start(r);
	CHECK(rig_set(&rig, "Go", 1) && scan_at(0));
	CHECK(r->vm.errors == 0 && r->error_at.rung == 0);
	CHECK(rig_set(&rig, "Split", 1) && scan_at(1));
	CHECK(r->vm.errors == 1 && r->state == STATE_RUN);
	CHECK_TEXT(r->error_at.pou, "Main");
	CHECK(r->error_at.rung == 3 && r->error_at.row == 1 && r->error_at.col == 3);
	CHECK_AS(rig_get(&rig, "SYS_ERRORS") == 0,
		 "SYS_ERRORS counts the error in the next scan");
	CHECK(rig_get(&rig, "SYS_MATH_ERROR") == 0 && rig_get(&rig, "Q1") == 0);
	CHECK(rig_set(&rig, "Split", 0) && scan_at(2));
	CHECK(rig_get(&rig, "SYS_ERRORS") == 1 && rig_get(&rig, "SYS_MATH_ERROR"));
	CHECK(scan_at(3) && rig_get(&rig, "SYS_ERRORS") == 1);
	CHECK(rig_get(&rig, "SYS_MATH_ERROR") == 0);
	CHECK(rig_set(&rig, "Count", INT16_MAX) && scan_at(4));
	CHECK(rig_get(&rig, "Count") == INT16_MIN && r->vm.errors == 2);
	CHECK_AS(r->error_at.rung == 3, "the place is that of the first error");
}

static void faults_on_the_budget(void)
{
	struct resource *r = &rig.resource;

	resource_start(r);
	CHECK(rig_set(&rig, "Go", 1) && scan_at(0) && rig_get(&rig, "Q2") == 1);
	CHECK(rig_set(&rig, "Spin", 1) && !scan_at(1));
	CHECK(r->state == STATE_FAULT && r->fault == FAULT_BUDGET);
	CHECK_AS(rig_get(&rig, "Q2") == 1, "the program after the fault does not run");
	CHECK_TEXT(r->fault_at.pou, "Main");
	CHECK(r->fault_at.rung == 6 && r->fault_at.row == 1 && r->fault_at.col == 3);
	resource_start(r);
	CHECK(r->fault_at.rung == 0 && rig_set(&rig, "Go", 1) && scan_at(0));
}

static int power_of(uint32_t pou, uint32_t rung, uint32_t row, uint32_t col)
{
	bool in, out;

	if (!resource_power(&rig.resource, pou, rung, row, col, &in, &out))
		return -1;
	return in * 2 + out;
}

static void tells_power(void)
{
	CHECK(rig_open(&rig, source, true));
	CHECK(rig_scan(&rig));
	CHECK(power_of(0, 1, 1, 1) == 2 && power_of(0, 1, 1, 2) == 0);
	CHECK(power_of(0, 1, 1, 3) == 0 && power_of(0, 1, 2, 1) == 2);
	CHECK(rig_set(&rig, "Go", 1) && rig_scan(&rig));
	CHECK(power_of(0, 1, 1, 1) == 3 && power_of(0, 1, 1, 2) == 3);
	CHECK(power_of(0, 1, 1, 3) == 3);
	CHECK_AS(power_of(0, 1, 2, 1) == 2,
		 "the seal-in contact shows Q0 of the scan before");
	CHECK(rig_set(&rig, "Go", 0) && rig_scan(&rig));
	CHECK(power_of(0, 1, 1, 1) == 2 && power_of(0, 1, 2, 1) == 3);
	CHECK(power_of(0, 1, 1, 2) == 3 && power_of(1, 1, 1, 2) == 0);
	CHECK(power_of(0, 1, 2, 2) == -1 && power_of(0, 1, 1, 4) == -1);
	CHECK(power_of(0, 5, 1, 1) == -1 && power_of(0, 7, 1, 1) == -1);
	CHECK(power_of(2, 1, 1, 1) == -1 && power_of(0, 1, 0, 1) == -1);
	CHECK(power_of(0, 1, UINT32_MAX, 1) == -1);
	CHECK(power_of(0, 1, 1, UINT32_MAX) == -1);
	rig.resource.watch = false;
	CHECK(rig_set(&rig, "Q0", 0) && rig_scan(&rig));
	CHECK_AS(power_of(0, 1, 1, 2) == 3, "power is not updated while nobody watches");
	rig.resource.watch = true;
	CHECK(rig_scan(&rig) && power_of(0, 1, 1, 2) == 0);
}

/* The same place, watched or not. */
static void tells_places_while_watched(void)
{
	struct resource *r = &rig.resource;

	resource_start(r);
	CHECK(rig_set(&rig, "Go", 1) && rig_set(&rig, "Split", 1) && rig_scan(&rig));
	CHECK_AS(r->vm.errors && r->error_at.rung == 3 && r->error_at.col == 3,
		 "the place of a failed operation is known while watched");
	CHECK(rig_set(&rig, "Spin", 1) && !rig_scan(&rig));
	CHECK(r->fault == FAULT_BUDGET);
	CHECK_TEXT(r->fault_at.pou, "Main");
	CHECK_AS(r->fault_at.rung == 6 && r->fault_at.row == 1 && r->fault_at.col == 3,
		 "the place of a fault is known while watched");
	resource_start(r);
}

static void runs_without_maps(void)
{
	size_t len;
	const void *image = ladder_image(rig.ladder, &len);
	size_t size = code_strip(image, NULL);
	void *small = aligned_alloc(8, (size + 7) / 8 * 8);
	struct arena scratch;
	struct program program;
	struct resource r;
	enum diag_id why;
	bool in, out;

	arena_init(&scratch);
	CHECK(small && code_strip(image, small) == size);
	CHECK(code_open(small, size, &scratch, &program, &why, &len));
	arena_free(&scratch);
	void *memory = calloc(1, image_memory_size(&program));

	resource_init(&r, &program, memory);
	r.watch = true; /* the image has no watched section */
	resource_start(&r);
	image_area(&r.image, AREA_I)[0] = 1;
	CHECK(resource_scan(&r, 0) && image_area(&r.image, AREA_Q)[0] == 5);
	CHECK(!resource_power(&r, 0, 1, 1, 1, &in, &out));
	image_area(&r.image, AREA_I)[0] = 3;
	CHECK(!resource_scan(&r, 1) && r.fault == FAULT_BUDGET);
	CHECK(r.fault_at.pou && r.fault_at.rung == 0);
	free(memory);
	free(small);
}

int main(void)
{
	if (rig_open(&rig, source, false)) {
		has_states();
		shows_first_scan();
		has_clocks();
		shows_what_it_is_told();
		counts_errors();
		faults_on_the_budget();
		CHECK_AS(power_of(0, 1, 1, 1) == -1,
			 "a program built without the power map has no power");
	}
	rig_close(&rig);
	tells_power();
	if (rig.good)
		tells_places_while_watched();
	if (rig.good)
		runs_without_maps();
	rig_close(&rig);
	return tap_done();
}
