/* SPDX-License-Identifier: MIT
 *
 * What a scan leaves out: time that stands, blocks with a clock, SYS_CYCLE; what the budget and values from
 * outside do to it; when whole scans run. Random programs are in tests/still_differential.c.
 */
#include "engine/scan/still.h"
#include "tests/unit/rig.h"

#define MS INT64_C(1000000)

#define HEAD "VAR\n  A : BOOL;\n  B : BOOL;\n  C : BOOL;\n  D : BOOL;\n"
#define TAIL "RUNG\n  | NO A | COIL B |\nRUNG\n  | NO B | COIL C |\nRUNG\n  | NO C | COIL D |\nEND_PROGRAM\n"

static const char timer[] = HEAD
	"  In AT %IX0.0 : BOOL;\n  Out : BOOL;\n  Delay : TON;\nEND_VAR\nPROGRAM Main LD\n"
	"RUNG\n  | NO In | TON Delay PT:=T#100ms | COIL Out |\n" TAIL;
static const char flasher[] = HEAD
	"  Flash : BOOL;\n  Light : BLINK;\nEND_VAR\nPROGRAM Main LD\n"
	"RUNG\n  | NO SYS_ALWAYS_ON | BLINK Light TH:=T#50ms TL:=T#50ms | COIL Flash |\n" TAIL;
static const char cycle[] = HEAD
	"  Long : BOOL;\nEND_VAR\nPROGRAM Main LD\n"
	"RUNG\n  | [ SYS_CYCLE > T#15ms ] | COIL Long |\n" TAIL;

static const char loops[] = HEAD
	"  Near : ARRAY[1..100] OF INT;\n  N : INT := 20;\n  X : INT;\n  Far : ARRAY[1..100] OF INT;\n  Y : INT;\nEND_VAR\n"
	"PROGRAM Main ST\n  X := 0;\n  WHILE X < N DO X := X + 1; END_WHILE;\n  B := A;\n"
	"  Y := 0;\n  WHILE Y < 10 DO Y := Y + 1; END_WHILE;\n  C := B;\n  D := C;\nEND_PROGRAM\n";
static const char lively[] = "VAR\n  In AT %IX0.0 : BOOL;\n  Out AT %QX0.0 : BOOL;\n  A : BOOL;\n  B : BOOL;\n"
	"  C : BOOL;\nEND_VAR\nPROGRAM Main LD\nRUNG\n  | NO In | COIL A |\nRUNG\n  | NC In | COIL B |\n"
	"RUNG\n  | NO In | NC C | COIL C |\nRUNG\n  | NO A | COIL Out |\nEND_PROGRAM\n";

static struct rig rig;

static void scan_after(int64_t ms)
{
	rig.now += ms * MS;
	resource_scan(&rig.resource, rig.now);
}

static void rest(void)
{
	for (int i = 0; i < 40; i++)
		scan_after(10);
}

static void set_input(bool on)
{
	image_area(&rig.resource.image, AREA_I)[0] = on;
}

static void standing_time(void)
{
	rest();
	set_input(true);
	scan_after(10);
	scan_after(0);
	scan_after(0);
	scan_after(60);
	CHECK_AS(rig_get(&rig, "Out") == 0, "the timer runs");
	scan_after(60);
	CHECK_AS(rig_get(&rig, "Out") == 1, "a timer that began while the time stood ends in time");
}

static void clocks(void)
{
	int changes = 0;

	for (int i = 0; i < 100; i++) {
		const int64_t before = rig_get(&rig, "Flash");

		scan_after(10);
		changes += rig_get(&rig, "Flash") != before;
	}
	CHECK_AS(changes >= 18 && changes <= 21, "a block with a clock runs in each scan");
}

static void cycle_time(void)
{
	rest();
	CHECK(rig_get(&rig, "Long") == 0);
	scan_after(20);
	CHECK_AS(rig_get(&rig, "Long") == 1, "SYS_CYCLE is seen in its own scan");
	scan_after(10);
	CHECK(rig_get(&rig, "Long") == 0);
}

/* ---- the budget ---- */

static bool begin(void)
{
	return still_begin(rig.resource.still, &rig.resource.image, rig.now += 10 * MS, true);
}

/* The program alone, with this budget. */
static enum fault run_with(uint32_t budget)
{
	struct vm *vm = &rig.resource.vm;

	vm->budget = budget;
	return still_run(rig.resource.still, vm, ladder_program(rig.ladder)->call[0]);
}

static uint32_t cost(void)
{
	run_with(1000000);
	return 1000000 - rig.resource.vm.budget;
}

/* As a stretch before the first one would. */
static bool change_first(int64_t n)
{
	rig.resource.still->pending[0] |= 1;
	return rig_set(&rig, "N", n);
}

static void loops_cost(void)
{
	uint32_t longer, shorter;

	rest();
	CHECK(begin());
	longer = cost();
	rig_set(&rig, "N", 5);
	rest();
	CHECK(begin());
	shorter = cost();
	CHECK_AS(shorter > 0 && longer > shorter + 15, "stretches that do not run take from the budget, too");
	CHECK(begin() && run_with(shorter) == FAULT_NONE && rig.resource.vm.budget == 0);
	CHECK_AS(begin() && run_with(shorter - 1) == FAULT_BUDGET, "a scan ends where the whole scan would");
	CHECK_AS(rig.resource.still->stale, "after a fault everything runs");
	rest();
	CHECK(begin() && change_first(20) && run_with(longer) == FAULT_NONE && rig_get(&rig, "X") == 20);
	rig_set(&rig, "N", 5);
	rest();
	CHECK(begin() && change_first(20));
	CHECK_AS(run_with(longer - 1) == FAULT_BUDGET && rig_get(&rig, "X") == 20,
		 "also if a stretch before has taken more than the last time");
}

/* ---- values from outside ---- */

static void written_late(void)
{
	rest();
	CHECK(begin() && run_with(1000) == FAULT_NONE);
	rig_set(&rig, "Out", 1);
	CHECK_AS(!still_end(rig.resource.still, &rig.resource.image),
		 "a value that was written after the begin is packed with all others");
	rest();
	CHECK(begin() && run_with(1000) == FAULT_NONE && still_end(rig.resource.still, &rig.resource.image));
	rest();
	CHECK(begin() && run_with(1000) == FAULT_NONE && rig_force(&rig, "In", 1));
	CHECK_AS(!still_end(rig.resource.still, &rig.resource.image), "so are all while a force is held");
	CHECK(rig_release(&rig, "In"));
}

/* ---- whole scans ---- */

/* Scans that compared, of @count; in each of them all inputs change, or none does. */
static int count_compared(int count, bool change)
{
	int compared = 0;

	for (int i = 0; i < count; i++) {
		if (change)
			set_input(!(image_area(&rig.resource.image, AREA_I)[0] & 1));
		scan_after(10);
		compared += !rig.resource.still->stale;
	}
	return compared;
}

static void whole_scans(void)
{
	rest();
	CHECK_AS(count_compared(20, false) == 20, "a program at rest is compared in each scan");
	const int first = count_compared(20, true), later = count_compared(400, true);

	CHECK_AS(first >= 2 && first < 10, "whole scans run where more than half would, each time more of them");
	CHECK_AS(later >= 1 && later < 6, "then it is seldom tried again");
	count_compared(300, false);
	set_input(!(image_area(&rig.resource.image, AREA_I)[0] & 1));
	CHECK_AS(count_compared(3, false) >= 1, "after some time at rest it is tried at once");
	count_compared(400, true);
	still_reset(rig.resource.still);
	CHECK_AS(begin(), "a reset ends the whole scans");
}

static void run(const char *text, void (*test)(void))
{
	struct arena keep;

	arena_init(&keep);
	if (rig_open(&rig, text, false)) {
		rig.resource.still = still_new(ladder_program(rig.ladder), 1, &keep, NULL);
		if (CHECK_AS(rig.resource.still, "the program has stretches"))
			test();
	}
	rig_close(&rig);
	arena_free(&keep);
}

int main(void)
{
	run(timer, standing_time);
	run(flasher, clocks);
	run(cycle, cycle_time);
	if (!HAS_STILL) /* each scan runs the whole program */
		return tap_done();
	run(loops, loops_cost);
	run(lively, written_late);
	run(lively, whole_scans);
	return tap_done();
}
