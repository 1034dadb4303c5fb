/* SPDX-License-Identifier: MIT
 *
 * test_trial_text - texts, dates, LREAL and 64 unsigned bits in scripts, traces and
 * scenarios.
 */
#include "tests/tap.h"
#include "tests/unit/trial.h"

static const char source[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  Go    AT %IX0.0 : BOOL;\n"
	"  Name  : STRING[6] := 'a$$';\n"
	"  Copy  : STRING[20];\n"
	"  Clock : TIME_OF_DAY := TOD#06:30:00;\n"
	"  Day   : DATE := D#2026-11-21;\n"
	"  Now   : DATE_AND_TIME := DT#2026-11-21-08:30:00;\n"
	"  Delay : TIME := T#10s;\n"
	"  Exact : LREAL := 0.1;\n"
	"  Rough : REAL := 0.1;\n"
	"  Big   : ULINT := 18446744073709551615;\n"
	"END_VAR\n"
	"VAR CONSTANT\n  Fixed : STRING := 'fixed';\nEND_VAR\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Go | CONCAT IN1:=Name IN2:=', ' IN3:=Name OUT=>Copy |\n"
	"RUNG\n  | [ Copy = Fixed ] | [ Clock > TOD#23:00:00 ] | [ Day > D#2000-01-01 ] "
	"| [ Now > DT#2000-01-01-00:00:00 ] | [ Delay > T#1s ] | [ Exact > 1.0 ] "
	"| [ Rough > 1.0 ] | [ Big > 5 ] | COIL Q0 |\n"
	"END_PROGRAM\n";

static struct bed bed;

static const char *run_form(const char *script, enum trace_form form, bool changes)
{
	return bed_trace(&bed, script, form, changes);
}

static const char *run(const char *script)
{
	return run_form(script, TRACE_LINES, false);
}

static const char *wrong(const char *script)
{
	CHECK_TEXT(run(script), "");
	return bed_first(&bed);
}

static void scripts(void)
{
	CHECK_TEXT(run("@print Name Copy\n.\nGo=1 Name='b c' # 'x\nName='' Go=0\n"),
		   "1 t=10 Name='a$$' Copy=''\n"
		   "2 t=20 Name='b c' Copy='b c, b c'\n"
		   "3 t=30 Name='' Copy='b c, b c'\n");
	CHECK_TEXT(run("@print Name\nName='#$'=$41'\n"), "1 t=10 Name='#$'=A'\n");
	CHECK_TEXT(run("@print Clock Day Now\nClock=23:59:59.5 Day=2024-02-29\n"
		       "Clock=TOD#00:00:00 Now=1969-12-31-23:59:59\n"),
		   "1 t=10 Clock=23:59:59.5 Day=2024-02-29 Now=2026-11-21-08:30:00\n"
		   "2 t=20 Clock=00:00:00 Day=2024-02-29 Now=1969-12-31-23:59:59\n");
	CHECK_TEXT(run("@print Exact Rough Big\nExact=0.3 Rough=0.3 Big=9223372036854775808\n"),
		   "1 t=10 Exact=0.3 Rough=0.3 Big=9223372036854775808\n");
	CHECK_TEXT(wrong("Name='abcdefg'\n"), "LD116:1:6");
	CHECK_TEXT(wrong("Name='abc\n"), "LD115:1:6");
	CHECK_TEXT(wrong("Name=abc\n"), "LD115:1:6");
	CHECK_TEXT(wrong("Name=5\n"), "LD116:1:6");
	CHECK_TEXT(wrong("Go='a'\n"), "LD116:1:4");
	CHECK_TEXT(wrong("Name='a'b\n"), "LD115:1:6");
	CHECK_TEXT(wrong("Name='a' 'b'\n"), "LD106:1:10");
	CHECK_TEXT(wrong("Name='$Q'\n"), "LD115:1:6");
	CHECK_TEXT(wrong("Fixed='a'\n"), "LD305:1:1");
	CHECK_TEXT(wrong("Clock=24:00:00\n"), "LD116:1:7");
	CHECK_TEXT(wrong("Day=2023-02-29\n"), "LD116:1:5");
	CHECK_TEXT(wrong("Day=TOD#01:00:00\n"), "LD116:1:5");
	CHECK_TEXT(wrong("Now=2023-01-01\n"), "LD115:1:5");
	CHECK_TEXT(wrong("Day=1999-01-01-01-01-01-01-01-01-01-01-01-01-01-01-01-01-01-01-01\n"),
		   "LD115:1:5");
}

static void changes(void)
{
	CHECK_TEXT(run_form("@print Name Copy\n.\n.\nName='b' Go=1\n.\nName='a$$'\n",
			    TRACE_LINES, true),
		   "1 t=10 Name='a$$'\n"
		   "3 t=30 Name='b' Copy='b, b'\n"
		   "5 t=50 Name='a$$' Copy='a$$, a$$'\n");
	CHECK_AS(strstr(run_form("@print Name\n.\n@print Copy\n.\nGo=1\n", TRACE_LINES, true),
			"2 t=20") == NULL, "a new column does not count as a change");
}

static void tables(void)
{
	CHECK_TEXT(run_form("@print Name Copy\nName='\"'\nGo=1\n", TRACE_CSV, false),
		   "scan,t_ms,Name,Copy\r\n"
		   "1,10,\"'\"\"'\",''\r\n"
		   "2,20,\"'\"\"'\",\"'\"\", \"\"'\"\r\n");
	const char *wave = run_form("@print Name Exact Big Clock\nName='a b\\$07'\n",
				    TRACE_VCD, false);

	CHECK(strstr(wave, "$var string 1 ! Name $end\n") != NULL);
	CHECK(strstr(wave, "$var real 64 \" Exact $end\n") != NULL);
	CHECK(strstr(wave, "$var wire 64 # Big $end\n") != NULL);
	CHECK(strstr(wave, "$dumpvars\ns !\nr0 \"\n") != NULL);
	CHECK(strstr(wave, "sa\\040b\\134\\007 !\nr0.10000000000000001 \"\n") != NULL);
}

static const char *judge(const char *text)
{
	return bed_judge(&bed, text, NULL);
}

#define S "scenario \"s\"\n"

static void texts(void)
{
	CHECK_TEXT(judge(S "at 0 Name = 'b c', Go = 1\nexpect Copy = 'b c, b c'\n"
			 "expect Name < 'c' and Name >= 'b' and Name <> Copy\n"
			 "at 20ms Name = Fixed\n"
			 "at 40ms expect Copy = 'fixed, fixed'\n"), "held");
	CHECK_TEXT(judge(S "at 0 Name = 'x'\nat 20ms Name = 'y'\n"
			 "at 20ms expect Name = 'z'\n"),
		   "# s.scn:4: at 20 ms: not true: at 20ms expect Name = 'z'\n"
		   "#   1 t=10 Name='x'\n#   2 t=20 Name='y'\n");
	CHECK_TEXT(judge(S "at 0 Name = 'abcdefg'\nexpect Go\n"), "LD116:2:6");
	CHECK_TEXT(judge(S "at 0 Name = 5\nexpect Go\n"), "LD303:2:6");
	CHECK_TEXT(judge(S "at 0 Go = 'a'\nexpect Go\n"), "LD303:2:6");
	CHECK_TEXT(judge(S "expect Name = 5\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect Name + 'a' = 'b'\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect -Name = 'b'\n"), "LD303:2:9");
	CHECK_TEXT(judge(S "expect Name\n"), "LD324:2:8");
	CHECK_TEXT(judge(S "at 0 Go = 1\nat 20ms Name = Copy\nexpect not Go\n"),
		   "# s.scn:4: at 20 ms: not true: expect not Go\n"
		   "#   1 t=10 Go=1\n#   2 t=20 Go=1\n");
	CHECK_AS(strstr(judge(S "at 0 Copy = 'longer than six'\nat 20ms Name = Copy\n"
				"expect Go = 0\n"), "value is out of range") != NULL,
		 "a text longer than its variable is refused");
}

static void times(void)
{
	CHECK_TEXT(judge(S "expect Clock + 1h = TOD#07:30:00\n"
			 "expect Clock - TOD#06:00:00 = 30min and Clock < TOD#06:30:01\n"
			 "expect Now - DT#2026-11-21-08:00:00 = 30min\n"
			 "expect Now - 1d < Now and Now + 1d > Now\n"
			 "expect Day - D#2026-11-20 = 1d\n"
			 "expect Delay * 2 = 20s and Delay / 4 = 2.5s and Delay * 0.5 = 5s\n"
			 "at 20ms Clock = Clock + 1h, Day = D#2000-02-29\n"
			 "expect Clock = TOD#07:30:00 and Day = D#2000-02-29\n"), "held");
	CHECK_TEXT(judge(S "expect Clock = 5\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect Clock = Now\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect Day + 1d = Day\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect Clock + Clock = Clock\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect Delay * Delay = 1s\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "expect 2 * Delay = 20s\n"), "LD303:2:8");
	CHECK_TEXT(judge(S "at 0 Clock = 1h\nexpect Go\n"), "LD303:2:6");
	CHECK_AS(strstr(judge(S "at 0 Clock = Clock + 20h\nexpect not Go\n"),
			"value is out of range") != NULL,
				"a TIME_OF_DAY of 24 hours or more is refused");
}

static void numbers(void)
{
	CHECK_TEXT(judge(S "expect Exact = 0.1 and Rough = 0.1 and Exact = Rough\n"
			 "expect Exact < 0.10000000000000002\n"
			 "expect Big = 18446744073709551615 and Big > 9223372036854775807\n"
			 "expect Big > 0 and not (Big < 1)\n"
			 "at 20ms Big = 9223372036854775808, Exact = 0.3\n"
			 "expect Big > 9223372036854775807 and Big < 9223372036854775809\n"
			 "expect Exact = 0.3\n"), "held");
	CHECK_TEXT(judge(S "at 0 Big = -1\nexpect Go\n"), "LD116:2:6");
}

int main(void)
{
	if (!CHECK_AS(bed_open_source(&bed, source), "the test's program builds")) {
		for (int i = 0; i < ladder_diags(bed.ladder)->count; i++) {
			char line[300];

			diag_print(&ladder_diags(bed.ladder)->diag[i], line,
				   sizeof(line));
			printf("# %s\n", line);
		}
		return tap_done();
	}
	scripts();
	changes();
	tables();
	texts();
	times();
	numbers();
	bed_close(&bed);
	return tap_done();
}
