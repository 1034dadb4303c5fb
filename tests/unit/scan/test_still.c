/* SPDX-License-Identifier: MIT
 *
 * What a scan leaves out: time that stands, blocks with a clock, SYS_CYCLE. Random programs are in
 * tests/still_differential.c.
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
	return tap_done();
}
