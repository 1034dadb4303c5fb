/* SPDX-License-Identifier: MIT
 *
 * test_script - stimulus scripts and the three forms of a trace.
 */
#include "engine/trial/value.h"

#include "tests/tap.h"
#include "tests/unit/trial.h"

#define MS INT64_C(1000000)

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
	const char *text = run(script);

	CHECK_TEXT(text, "");
	return bed_first(&bed);
}

static void test_times(void)
{
	static const struct {
		const char *text;
		int64_t unit, ns;
		enum literal_result result;
	} cases[] = {
		{ "10ms", 0, 10 * MS, LITERAL_OK },
		{ "25us", 0, 25000, LITERAL_OK },
		{ "25ns", 0, 25, LITERAL_OK },
		{ "2.5s", 0, 2500 * MS, LITERAL_OK },
		{ "1m30s", 0, 90000 * MS, LITERAL_OK },
		{ "1min", 0, 60000 * MS, LITERAL_OK },
		{ "1d", 0, 86400000 * MS, LITERAL_OK },
		{ "T#1s500ms", 0, 1500 * MS, LITERAL_OK },
		{ "7", MS, 7 * MS, LITERAL_OK },
		{ "0.5", MS, MS / 2, LITERAL_OK },
		{ "0", MS, 0, LITERAL_OK },
		{ "0.000001ms", 0, 1, LITERAL_OK },
		{ "0.5ns", 0, 0, LITERAL_RANGE },
		{ "0.0000001ms", 0, 0, LITERAL_RANGE },
		{ "7", 0, 0, LITERAL_BAD },
		{ "", MS, 0, LITERAL_BAD },
		{ "ms", MS, 0, LITERAL_BAD },
		{ ".5ms", MS, 0, LITERAL_BAD },
		{ "5.ms", MS, 0, LITERAL_BAD },
		{ "-5ms", MS, 0, LITERAL_BAD },
		{ "5x", MS, 0, LITERAL_BAD },
		{ "1s5", MS, 0, LITERAL_BAD },
		{ "1.5s5ms", MS, 0, LITERAL_BAD },
		{ "1000000000s", 0, VALUE_TIME_MAX, LITERAL_OK },
		{ "1000000001s", 0, 0, LITERAL_RANGE },
		{ "99999999999999999999999999s", 0, 0, LITERAL_RANGE },
		{ "T#-1s", 0, 0, LITERAL_RANGE },
		{ "16#FF", MS, 0, LITERAL_BAD },
	};

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		int64_t ns = -1;
		enum literal_result result =
			value_parse_time(cases[i].text, strlen(cases[i].text),
					 cases[i].unit, &ns);

		CHECK_AS(result == cases[i].result, cases[i].text);
		if (cases[i].result == LITERAL_OK)
			CHECK_AS(ns == cases[i].ns, cases[i].text);
	}
}

static void test_lines(void)
{
	CHECK_TEXT(run("@print Motor %Q0\n.\n%I0=1\n%I0=0 Stop=1\n"),
		   "1 t=10 Motor=0 %Q0=0\n2 t=20 Motor=1 %Q0=1\n"
		   "3 t=30 Motor=0 %Q0=0\n");
	CHECK_TEXT(run("@print Motor\n# nothing\n\n  Open=0 Open=1 # two\r\n"),
		   "1 t=10 Motor=1\n");
	CHECK_TEXT(run("@print Level\nOpen=1 x3 quiet\n"), "3 t=30 Level=21\n");
	CHECK_TEXT(run("@print Level\n. x2\n"),
		   "1 t=10 Level=0\n2 t=20 Level=0\n");
	CHECK_TEXT(run("@print\n+5\n+25us\n+25ns\n+0 @print\n"), "");
	CHECK_TEXT(bed_first(&bed), "LD106:5:4");
	CHECK_TEXT(run("@print Motor\n+5\n+25us\n+25ns\n+0\n.\n+1.5 x2\n"),
		   "1 t=5 Motor=0\n2 t=5.025 Motor=0\n3 t=5.025025 Motor=0\n"
		   "4 t=5.025025 Motor=0\n5 t=15.025025 Motor=0\n"
		   "6 t=16.525025 Motor=0\n7 t=18.025025 Motor=0\n");
	CHECK_TEXT(run("@period 2\n@print Motor\n.\n@period 1s\n.\n"),
		   "1 t=2 Motor=0\n2 t=1002 Motor=0\n");
	CHECK_TEXT(run("@echo hello # you\n@print Motor\nOpen=1\n"),
		   "# hello # you\n1 t=10 Motor=1\n");
	CHECK_TEXT(run("@PRINT Level\nOPEN=TRUE QUIET\nopen=false\n"),
		   "1 t=10 Level=7\n2 t=20 Level=7\n");
}

static void test_values(void)
{
	CHECK_TEXT(run("@print Delay.ET Delay.PT Lamp\nOpen=1\n+1.5\n+40\n"),
		   "1 t=10 Delay.ET=0 Delay.PT=30 Lamp=0\n"
		   "2 t=11.5 Delay.ET=1.5 Delay.PT=30 Lamp=0\n"
		   "3 t=51.5 Delay.ET=30 Delay.PT=30 Lamp=1\n");
	CHECK_TEXT(run("@print Wait Heat Level\nWait=20 Heat=-2.25 Level=-5\n"
		       "Wait=T#1m Heat=0.1\nWait=2s Level=16#7F\n"),
		   "1 t=10 Wait=20 Heat=-2.25 Level=-5\n"
		   "2 t=20 Wait=60000 Heat=0.1 Level=-5\n"
		   "3 t=30 Wait=2000 Heat=0.1 Level=127\n");
	CHECK(strstr(run("."), "1 t=10 Open=0 Stop=0 Motor=0 Lamp=0 Level=0 "
			       "Heat=1.5 Wait=30 Delay.IN=0 Delay.Q=0 ") !=
	      NULL);
	CHECK(strstr(run("."), "Delay.ET=0 Seven=7\n") != NULL);
	CHECK(strstr(run("."), "Delay.start") == NULL);
}

static void test_ranges(void)
{
	CHECK_TEXT(run("@print %Q0..3\nOpen=1\n"),
		   "1 t=10 %Q0=1 %Q1=0 %Q2=0 %Q3=0\n");
	CHECK_TEXT(run("@print %IX0.0..1 Motor..Level\nOpen=1\n"),
		   "1 t=10 %IX0.0=1 %IX0.1=0 Motor=1 Lamp=0 Level=7\n");
	CHECK_TEXT(run("@print %Q0..%Q1\n.\n"), "1 t=10 %Q0=0 %Q1=0\n");
	CHECK_TEXT(wrong("@print %Q3..0\n"), "LD116:1:8");
	CHECK_TEXT(wrong("@print %Q0..9999\n"), "LD301:1:8");
	CHECK_TEXT(wrong("@print Motor Nothing\n"), "LD301:1:14");
	CHECK_TEXT(wrong("@print Level..Motor\n"), "LD116:1:8");
}

static void test_changes(void)
{
	CHECK_TEXT(run_form("@print Motor Level Heat\n.\n.\nOpen=1\nOpen=0\n"
			    "Stop=1\n", TRACE_LINES, true),
		   "1 t=10 Heat=1.5\n3 t=30 Motor=1 Level=7\n"
		   "5 t=50 Motor=0\n");
	CHECK_TEXT(run_form("@print Level\nOpen=1 x5 quiet\nOpen=0\n",
			    TRACE_LINES, true), "5 t=50 Level=35\n");
}

static void test_csv(void)
{
	CHECK_TEXT(run_form("@print Motor Heat\n.\nOpen=1\n", TRACE_CSV, false),
		   "scan,t_ms,Motor,Heat\r\n1,10,0,1.5\r\n2,20,1,1.5\r\n");
	CHECK_TEXT(run_form("@print Motor\n@echo no\n", TRACE_CSV, false),
		   "scan,t_ms,Motor\r\n");
	CHECK_TEXT(run_form("@print Motor\n.\n.\nOpen=1\n", TRACE_CSV, true),
		   "scan,t_ms,Motor\r\n3,30,1\r\n");
	run_form(".\n@print Motor\n", TRACE_CSV, false);
	CHECK_TEXT(bed_first(&bed), "LD126:2:1");
}

static void test_vcd(void)
{
	CHECK_TEXT(run_form("@print Motor Level Heat\nOpen=1\n.\n", TRACE_VCD,
			    false),
		   "$version Rungboard $end\n$timescale 1ns $end\n"
		   "$scope module program $end\n$var wire 1 ! Motor $end\n"
		   "$var wire 16 \" Level $end\n$var real 64 # Heat $end\n"
		   "$upscope $end\n$enddefinitions $end\n#0\n$dumpvars\n0!\n"
		   "b0000000000000000 \"\nr0 #\n$end\n#10000000\n1!\n"
		   "b0000000000000111 \"\nr1.5 #\n#20000000\n"
		   "b0000000000001110 \"\n");
	const char *quiet = run_form("@print Motor\nOpen=1\n. x3\n", TRACE_VCD,
				     false);

	CHECK_AS(strstr(quiet, "#10000000\n1!\n#40000000\n"),
		 "a waveform is as long as the run even if nothing changes");
}

static void test_wrong(void)
{
	CHECK_TEXT(wrong(".\n  Nothing=1\n"), "LD301:2:3");
	CHECK_TEXT(wrong("Open=2\n"), "LD116:1:6");
	CHECK_TEXT(wrong("Level=40000\n"), "LD116:1:7");
	CHECK_TEXT(wrong("Level=\n"), "LD115:1:7");
	CHECK_TEXT(wrong("Level=x\n"), "LD115:1:7");
	CHECK_TEXT(wrong("=1\n"), "LD107:1:1");
	CHECK_TEXT(wrong("Seven=1\n"), "LD305:1:1");
	CHECK_TEXT(wrong("Open\n"), "LD106:1:1");
	CHECK_TEXT(wrong("Delay=1\n"), "LD301:1:1");
	CHECK_TEXT(wrong(". x0\n"), "LD116:1:3");
	CHECK_TEXT(wrong(". x1000000001\n"), "LD116:1:3");
	CHECK_TEXT(wrong(". x5y\n"), "LD115:1:3");
	CHECK_TEXT(wrong("+\n"), "LD115:1:1");
	CHECK_TEXT(wrong("+-1\n"), "LD115:1:1");
	CHECK_TEXT(wrong("+99999999999999999999\n"), "LD116:1:1");
	CHECK_TEXT(wrong("@period 0\n"), "LD116:1:9");
	CHECK_TEXT(wrong("@period\n"), "LD107:1:1");
	CHECK_TEXT(wrong("@period 5 6\n"), "LD106:1:11");
	CHECK_TEXT(wrong("@reset now\n"), "LD106:1:8");
	CHECK_TEXT(wrong("@what\n"), "LD110:1:1");
	CHECK_TEXT(wrong("@\n"), "LD110:1:1");
	CHECK_TEXT(wrong("a\x01\n"), "LD105:1:2");
	CHECK_TEXT(wrong(".\n.\xff\n"), "LD104:2:2");
	CHECK_TEXT(wrong("\xff\xfe@A"), "LD142:1:1"); /* UTF-16 */
	wrong("Open=2\nOpen\n@what\n");
	CHECK_AS(bed.diags.errors == 3,
		 "a script with three errors gives three messages");
	CHECK_TEXT(run(""), "");
	CHECK(bed.diags.count == 0);
}

static void test_fault(void)
{
	CHECK_TEXT(run("@print Motor\n.\nHeat=200\n.\n"),
		   "1 t=10 Motor=0\n2 t=20 Motor=0\n");
	CHECK_TEXT(bed_first(&bed), "LD008:3:0");
	CHECK(bed.diags.diag[0].rung == 5);
}

static void test_stop(void)
{
	struct trace trace;
	bool stop = true;
	const char *text = ". x1000000000\n";

	bed_clear(&bed);
	trace_init(&trace, &bed.resource.image, &bed.out, TRACE_LINES, false);
	trace.stop = &stop;
	CHECK(!script_run("s", text, strlen(text), MS, &bed.resource, NULL, &trace,
			  &bed.diags));
	CHECK(bed.diags.count == 0);
	trace_free(&trace);
}

static int64_t value_at(const char *address)
{
	const struct image *image = &bed.resource.image;

	return image_get(image, image_find(image, address, strlen(address))).i;
}

/* Inputs come from outside: a restart keeps them, in each area and width. All others
 * are reset. */
static void test_restarts(void)
{
	static const char *const area[] = { "I", "AI", "XI", "XAI", "Q", "AQ", "XQ", "XAQ",
					    "M", "V", "S" };
	static const char *const width[] = { "X16.5", "B16", "W16", "D16", "L16" };
	static const char *const restart[] = { "@reset", "@warm", "@warm\n.\n@reset" };
	char address[32], script[120];

	for (int i = 0; i < 11 * 5 * 3; i++) {
		const char *how = restart[i % 3];
		bool input = i / 15 < 4;

		snprintf(address, sizeof(address), "%%%s%s", area[i / 15], width[i / 3 % 5]);
		snprintf(script, sizeof(script), "%s=1\n. x2\n%s\n.\n", address, how);
		run(script);
		snprintf(script, sizeof(script), "restart %d: %s %s", i % 3, address,
			 input ? "stays" : "is reset");
		CHECK_AS(value_at(address) == input, script);
	}
	CHECK_TEXT(run("@print Open Motor Level\nOpen=1 x2 quiet\n@warm\n. x2\n"
		       "@reset\nOpen=0\n"),
		   "2 t=20 Open=1 Motor=1 Level=14\n3 t=30 Open=1 Motor=1 Level=7\n"
		   "4 t=40 Open=1 Motor=1 Level=14\n5 t=50 Open=0 Motor=0 Level=0\n");
}

int main(void)
{
	test_times();
	if (!CHECK_AS(bed_open(&bed), "the test's program builds")) {
		for (int i = 0; i < ladder_diags(bed.ladder)->count; i++) {
			char line[300];

			diag_print(&ladder_diags(bed.ladder)->diag[i], line,
				   sizeof(line));
			printf("# %s\n", line);
		}
		return tap_done();
	}
	test_lines();
	test_values();
	test_ranges();
	test_changes();
	test_csv();
	test_vcd();
	test_wrong();
	test_fault();
	test_stop();
	test_restarts();
	bed_close(&bed);
	return tap_done();
}
