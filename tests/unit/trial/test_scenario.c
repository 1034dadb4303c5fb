/* SPDX-License-Identifier: MIT
 *
 * test_scenario - scenario files: reading, expectations, reports.
 */
#include "tests/tap.h"
#include "tests/unit/trial.h"

static struct bed bed;
static struct scenario failed; /* the first one, after its run: only its numbers */

static const char *run(const char *text)
{
	return bed_judge(&bed, text, &failed);
}

#define S "scenario \"s\"\n"

static void test_held(void)
{
	CHECK_TEXT(run("scenario \"stop wins over start\"\n"
		       "  period 10ms\n"
		       "  at 0ms     Open = 1\n"
		       "  at 20ms    expect Motor = 1\n"
		       "  at 1s      Stop = 1\n"
		       "  within 10ms expect Motor = 0\n"
		       "  always     not (Lamp and Stop and Motor)\n"), "held");
	CHECK_TEXT(run(S "# a comment (* that (* is none\n"
		       "at 0 Open = 1, Stop = 0 # more \"\n"
		       "Open = 1\n(* over\n lines *) expect Motor // and this\n"
		       "NEVER Motor AND NOT Open\n"), "held");
	CHECK_TEXT(run(S "at 0ms Open=1\nat 0ms Open=1 \n at 50ms expect Lamp\n"
		       "scenario \"t\"\nexpect not Motor\n"), "held");
	CHECK_TEXT(run(S "period 1ms\nat 0 Open=1\nfor 30ms expect not Lamp\n"
		       "within 31ms expect Lamp\n"), "held");
}

static void test_times(void)
{
	/* The first scan is at t = period, and `at` acts before t >= T. */
	CHECK_TEXT(run(S "at 10ms Open=1\nexpect Level = 7\nat 20ms expect "
		       "Level = 14\n"), "held");
	CHECK_TEXT(run(S "at 11ms Open=1\nexpect Level = 7\nat 30ms expect "
		       "Level = 14\n"), "held");
	/* `within 10ms` from 1 s checks 1 s and 1.01 s, not 1.02 s. */
	CHECK_TEXT(run(S "at 1s Open=1\nwithin 10ms expect Level = 14\n"),
		   "held");
	CHECK(strstr(run(S "at 1s Open=1\nwithin 10ms expect Level = 21\n"),
		     "at 1010 ms: not true: within 10ms expect Level = 21"));
	/* `for 20ms` from 1 s checks 1 s and 1.01 s, not 1.02 s. */
	CHECK_TEXT(run(S "at 1s Open=1\nfor 20ms expect Level < 15\n"), "held");
	CHECK(strstr(run(S "at 1s Open=1\nfor 21ms expect Level < 15\n"),
		     "at 1020 ms: not true:"));
	CHECK_TEXT(run(S "at 1s for 0 expect Level = 0\n"), "held");
	/* An open expectation behind decided ones is still checked. */
	CHECK(strstr(run(S "at 10ms within 50ms expect Lamp\n"
			 "at 20ms expect not Motor\nat 30ms expect not Lamp\n"),
		     "at 60 ms: not true: at 10ms within 50ms expect Lamp"));
}

static void test_report(void)
{
	CHECK_TEXT(run(S "at 0 Open = 1\nat 30ms Stop = 1\n"
		       "at 50ms expect Motor = 1 and Level > 5\n"),
		   "# s.scn:4: at 50 ms: not true: at 50ms expect Motor = 1 and "
		   "Level > 5\n"
		   "#   1 t=10 Motor=1 Level=7\n#   2 t=20 Motor=1 Level=14\n"
		   "#   3 t=30 Motor=0 Level=21\n#   4 t=40 Motor=0 Level=28\n"
		   "#   5 t=50 Motor=0 Level=35\n");
	const char *text = run(S "at 0 Open=1\nalways Level < 80\n"
			       "at 1s expect Motor\n");

	CHECK(strncmp(text, "# s.scn:3: at 120 ms: not true: always Level < 80\n"
		      "#   5 t=50 Level=35\n", 68) == 0);
	CHECK(strstr(text, "#   12 t=120 Level=84\n") != NULL);
	CHECK(strstr(text, "13") == NULL);
	CHECK(failed.failure == FAILURE_FALSE && failed.failed_ns == 120000000 &&
	      failed.failed_scan == 12 && failed.failed_line == 3 && failed.failed_step);
	CHECK(strstr(run(S "never Motor\nat 0 Open=1\n"), "never Motor\n"));
	CHECK(strstr(run(S "expect 1 / Level = 1\n"), "cannot be computed"));
	CHECK(failed.failure == FAILURE_UNKNOWN && failed.failed_ns == 10000000);
	CHECK(strstr(run(S "at 0 Level = 30000\nat 20ms Level = Level * 2\n"
			 "expect TRUE\n"), "value is out of range: "));
	CHECK(failed.failure == FAILURE_RANGE && failed.failed_line == 3);
	CHECK(strstr(run(S "Heat = 200.0\nexpect TRUE\n"), "# s.scn:1: at 10 "
		     "ms: the program stopped with a fault: "));
	CHECK(failed.failure == FAILURE_PROGRAM && !failed.failed_step);
}

static void test_values(void)
{
	static const char *const good[] = {
		"Motor = 0", "Motor = FALSE", "not Motor", "Motor <> TRUE",
		"Delay.PT = 30ms", "Delay.PT = T#30ms", "Delay.PT + 1s > 1s",
		"Delay.PT - T#10ms <= 20ms", "Heat = 1.5", "Heat >= 1",
		"Heat * 2 = 3", "Heat / 2 < 1", "-Level = 0", "Seven = 7",
		"Seven mod 4 = 3", "Seven / 2 = 3", "16#FF = 255",
		"Level + 2 * 3 = 6", "(Level + 2) * 3 = 6",
		"TRUE or FALSE and FALSE", "TRUE xor FALSE", "%I0 = 0",
		"%QX0.0 = 0", "Motor + Lamp <= 1",
		"Seven > 6.5",
	};
	char text[200];

	for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++) {
		snprintf(text, sizeof(text), S "expect %s\n", good[i]);
		CHECK_AS(strcmp(run(text), "held") == 0, good[i]);
	}
	CHECK_TEXT(run(S "at 0 Heat = 0.1\nexpect Heat = 0.1\n"), "held");
	CHECK_TEXT(run(S "Wait = 2s, Level = -5, Heat = 3\n"
		       "expect Wait = 2s and Level = -5 and Heat = 3.0\n"),
		   "held");
	CHECK_TEXT(run(S "at 0 Level = 3\nat 20ms Level = Level + 1\n"
		       "expect Level = 4\n"), "held");
}

static void test_wrong(void)
{
	CHECK_TEXT(run("\xff\xfe@A"), "LD142:1:1"); /* UTF-16 */
	CHECK_TEXT(run(""), "LD107:1:1");
	CHECK_TEXT(run("at 0 Open = 1\n"), "LD107:1:1");
	CHECK_TEXT(run("scenario\nexpect Motor\n"), "LD107:1:9");
	CHECK_TEXT(run(S "at 0 Open = 1\n"), "LD136:1:0");
	CHECK_TEXT(run(S "expect Nothing\n"), "LD301:2:8");
	CHECK_TEXT(run(S "expect Motor and Level\n"), "LD324:2:18");
	CHECK_TEXT(run(S "expect Level and Motor\n"), "LD324:2:8");
	CHECK_TEXT(run(S "expect Level\n"), "LD324:2:8");
	CHECK_TEXT(run(S "expect Level + 1 = Delay.ET\n"), "LD303:2:8");
	CHECK_TEXT(run(S "expect Motor Motor\n"), "LD106:2:14");
	CHECK_TEXT(run(S "at 5 expect Motor\n"), "LD107:2:4");
	CHECK_TEXT(run(S "at x expect Motor\n"), "LD107:2:4");
	CHECK_TEXT(run(S "at 2s expect Motor\nat 1s expect Motor\n"),
		   "LD131:3:7");
	CHECK_TEXT(run(S "at 0 Nothing = 1\n"), "LD301:2:6");
	CHECK_TEXT(run(S "at 0 Seven = 1\n"), "LD305:2:6");
	CHECK_TEXT(run(S "at 0 Open = 2\n"), "LD116:2:6");
	CHECK_TEXT(run(S "at 0 Open = 1s\n"), "LD303:2:6");
	CHECK_TEXT(run(S "at 0 Level = 40000\n"), "LD116:2:6");
	CHECK_TEXT(run(S "at 0 Open\n"), "LD107:2:6");
	CHECK_TEXT(run(S "within 10ms Motor\n"), "LD107:2:13");
	CHECK_TEXT(run(S "within expect Motor\n"), "LD107:2:8");
	CHECK_TEXT(run(S "period 0ms\nexpect TRUE\n"), "LD116:2:11");
	CHECK_TEXT(run(S "period 1s\nperiod 1s\nexpect TRUE\n"), "LD132:3:8");
	CHECK_TEXT(run(S "plant \"world.rung\"\nexpect TRUE\n"), "LD135:2:7");
	CHECK_TEXT(run(S "expect MAX(Level, 1) = 1\n"), "LD139:2:8");
	CHECK_TEXT(run(S "period 1ns\nat 1h expect Motor\n"), "LD137:3:0");
	CHECK_TEXT(run(S "at 9999999999999999999s expect Motor\n"),
		   "LD116:2:4");
	CHECK_TEXT(run(S "\xff"), "LD104:2:1");
	run(S "expect A\nexpect B\nat 0 C = 1\n");
	CHECK_AS(bed.diags.errors == 3, "a file with three errors gives three messages");
	run("scenario\"s\" expect (((((((((((");
	CHECK(bed.diags.errors > 0);
}

int main(void)
{
	if (!CHECK_AS(bed_open(&bed), "the test's program builds"))
		return tap_done();
	test_held();
	test_times();
	test_report();
	test_values();
	test_wrong();
	bed_close(&bed);
	return tap_done();
}
