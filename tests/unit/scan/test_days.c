/* SPDX-License-Identifier: MIT
 *
 * test_days - 100 days of running in virtual time: timers, counters, tasks and clocks equal a model
 * in every scan, most of all where a count of 32 bits would come round; meanwhile the clock of the
 * wall is set by a day, there and back, and moves none of them.
 */
#include "tests/unit/rig.h"

#define MS    INT64_C(1000000)
#define HOUR  (3600000 * MS)
#define DAY   (24 * HOUR)
#define COUNT_MOST 32767

static const char text[] =
	"VAR\n  In, Up, Down : BOOL;\n  Long : TIME;\n"
	"  Up1 : TON;\n  Lag : TOF;\n  Pulse : TP;\n  Sum : TONR;\n  C : CTU;\n  D : CTD;\n"
	"  Runs : UDINT;\n  Now : DATE_AND_TIME;\n  Mon : WEEK_TIMER;\n"
	"  Second, Minute : BOOL;\nEND_VAR\n"
	"CONFIGURATION Board\n  TASK Slow (INTERVAL := T#1s, PRIORITY := 2);\n"
	"  PROGRAM A : Main;\n  PROGRAM B WITH Slow : Beats;\nEND_CONFIGURATION\n"
	"PROGRAM Beats LD\nRUNG\n  | [ Runs := Runs + 1 ] |\nEND_PROGRAM\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO In | TON Up1 PT:=Long |\n"
	"RUNG\n  | NO In | TOF Lag PT:=Long |\n"
	"RUNG\n  | NO In | TP Pulse PT:=Long |\n"
	"RUNG\n  | NO In | TONR Sum PT:=T#200d |\n"
	"RUNG\n  | NO Up | CTU C PV:=30000 |\n"
	"RUNG\n  | NO Down | CTD D PV:=100 |\n"
	"RUNG\n  | [ Now := SYS_DATE_TIME ] |\n"
	"RUNG\n  | WEEK_TIMER Mon NOW:=SYS_DATE_TIME DAYS1:=1 ON1:=TOD#06:00:00 OFF1:=TOD#18:00:00 |\n"
	"RUNG\n  | NO SYS_CLOCK_1S | COIL Second |\n"
	"RUNG\n  | NO SYS_CLOCK_1MIN | COIL Minute |\n"
	"END_PROGRAM\n";

/* What the standard says, in numbers that cannot come round. */
struct model {
	int64_t on_since, off_since, pulse_since, counted, last; /* ns; -1: not    */
	int64_t up, down, runs, began, due;
	bool in, was_up, was_down, off_q, pulse_on, sum_in;
};

static struct rig rig;
static struct model model;
static uint64_t source = 38;
static int64_t wall_ns;
static unsigned scans, wrong;

/* xorshift64*: the same on every machine. */
static uint32_t below(uint32_t n)
{
	source ^= source >> 12;
	source ^= source << 25;
	source ^= source >> 27;
	return (uint32_t)(source * UINT64_C(2685821657736338717) >> 32) % n;
}

static int64_t least(int64_t a, int64_t b)
{
	return a < b ? a : b;
}

static void expect(const char *name, int64_t value)
{
	const int64_t found = rig_get(&rig, name);

	if (found == value)
		return;
	if (wrong++ < 10)
		printf("# %s at %lld ns: %lld, not %lld\n", name, (long long)rig.now, (long long)found,
		       (long long)value);
}

static void expect_timers(bool in, int64_t pt)
{
	const int64_t now = rig.now;

	if (in && !model.in)
		model.on_since = now;
	expect("Up1.ET", in ? least(now - model.on_since, pt) : 0);
	expect("Up1.Q", in && now - model.on_since >= pt);

	if (in)
		model.off_q = true, model.off_since = -1;
	else if (model.off_q && model.off_since < 0)
		model.off_since = now;
	if (!in && model.off_q)
		model.off_q = now - model.off_since < pt;
	if (model.off_q)
		expect("Lag.ET", in ? 0 : now - model.off_since);
	expect("Lag.Q", model.off_q);

	if (in && !model.pulse_on && model.pulse_since < 0)
		model.pulse_on = true, model.pulse_since = now;
	if (model.pulse_on)
		model.pulse_on = now - model.pulse_since < pt;
	if (model.pulse_on)
		expect("Pulse.ET", now - model.pulse_since);
	expect("Pulse.Q", model.pulse_on);
	if (!model.pulse_on && !in)
		model.pulse_since = -1;

	if (model.sum_in)
		model.counted += now - model.last;
	model.sum_in = in;
	model.last = now;
	expect("Sum.ET", model.counted);
	model.in = in;
}

static void expect_counters(bool up, bool down)
{
	if (up && !model.was_up)
		model.up = least(model.up + 1, COUNT_MOST);
	if (down && !model.was_down && model.down > -COUNT_MOST - 1)
		model.down--;
	model.was_up = up;
	model.was_down = down;
	expect("C.CV", model.up);
	expect("C.Q", model.up >= 30000);
	expect("D.CV", model.down);
	expect("D.Q", model.down <= 0);
}

/* 1970-01-01 was a Thursday, so day 4 a Monday. */
static void expect_clocks(void)
{
	const int64_t wall = rig.now + wall_ns, day = wall / DAY, of_day = wall % DAY;
	const int64_t since = rig.now - model.began;

	expect("Now", wall);
	expect("Mon.Q", day % 7 == 4 && of_day >= 6 * HOUR && of_day < 18 * HOUR);
	expect("Second", since % (1000 * MS) < 500 * MS);
	expect("Minute", since % (60000 * MS) < 30000 * MS);
}

static void expect_task(void)
{
	if (rig.now >= model.due) {
		model.runs++;
		model.due += ((rig.now - model.due) / (1000 * MS) + 1) * 1000 * MS;
	}
	expect("Runs", model.runs);
}

static void scan(int64_t step_ns)
{
	const bool in = below(40) ? model.in : !model.in;
	const bool up = below(2), down = below(2);
	const int64_t pt = rig_get(&rig, "Long");

	rig.now += step_ns;
	rig_set(&rig, "In", in);
	rig_set(&rig, "Up", up);
	rig_set(&rig, "Down", down);
	rig.resource.wall_offset_ns = wall_ns;
	wrong += !resource_scan(&rig.resource, rig.now);
	if (!scans++)
		model.began = model.due = rig.now;
	expect_timers(in, pt);
	expect_counters(up, down);
	expect_clocks();
	expect_task();
}

/* Some scans of 10 ms around a moment, each side. */
static void cross(int64_t at_ns)
{
	if (rig.now < at_ns - 100 * 10 * MS)
		scan(at_ns - 100 * 10 * MS - rig.now);
	for (int i = 0; i < 200; i++)
		scan(10 * MS + (i == 100) - (i == 101));
}

/* A preset that no timer of this phase reaches, or one of a scan or of days. */
static void choose_preset(void)
{
	static const int64_t preset_ms[] = { 10, 1000, 3600000, 2147483647, 2147483648, 4294967295,
					     4294967296, 4294967297, 8640000000 };

	rig_set(&rig, "Long", preset_ms[below(sizeof(preset_ms) / sizeof(preset_ms[0]))] * MS);
}

static void test_a_hundred_days(void)
{
	/* 32 bits of ns, us and ms, with and without sign; 2^53 ns: where an LREAL ends. */
	static const int64_t at[] = { INT64_C(2147483648), INT64_C(4294967296), 2147483648 * 1000,
		4294967296 * 1000, 2147483648 * MS, 4294967296 * MS, 100 * DAY,
		INT64_C(9007199254740992) };

	wall_ns = INT64_C(1780297200) * 1000 * MS; /* a Monday */
	model.off_since = model.pulse_since = -1;
	rig_set(&rig, "Long", 4294967296 * MS);
	for (size_t i = 0; i < sizeof(at) / sizeof(at[0]); i++) {
		while (rig.now + 2 * HOUR < at[i]) {
			scan(1 + (int64_t)below(3600000) * MS + below(1000));
			if (!below(50))
				wall_ns += below(2) ? DAY : -DAY; /* somebody sets the clock */
			if (!below(200))
				choose_preset();
		}
		cross(at[i]);
	}
	CHECK(rig.now > 100 * DAY && scans > 5000);
	CHECK_AS(wrong == 0, "no deviation from the model");
}

/* One timer runs for 100 days, with PT far behind all bounds of 32 bits. */
static void test_a_timer_runs_through(void)
{
	const int64_t began = rig.now + 10 * MS;

	rig_set(&rig, "Long", 100 * DAY);
	model.in = true;
	while (rig.now < began + 101 * DAY) {
		rig.now += rig.now == began - 10 * MS ? 10 * MS : HOUR / 7;
		rig_set(&rig, "In", true);
		wrong += !resource_scan(&rig.resource, rig.now);
		if (rig_get(&rig, "Up1.ET") != least(rig.now - began, 100 * DAY) ||
		    rig_get(&rig, "Up1.Q") != (rig.now - began >= 100 * DAY))
			wrong++;
	}
	CHECK_AS(wrong == 0, "TON reaches 100 days, and Q comes in that scan");
}

int main(void)
{
	if (rig_open(&rig, text, false)) {
		test_a_hundred_days();
		rig_set(&rig, "In", false);
		rig.now += 10 * MS;
		wrong += !resource_scan(&rig.resource, rig.now);
		test_a_timer_runs_through();
	}
	rig_close(&rig);
	return tap_done();
}
