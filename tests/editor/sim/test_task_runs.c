/* SPDX-License-Identifier: MIT
 *
 * test_task_runs - the runs of a simulation: as planned, late, left out, by an event, after an edit,
 * in a FAULT, and those of a program without tasks.
 */
#include "editor-gtk/sim/task_runs.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <string.h>

#define MS G_GINT64_CONSTANT(1000000)

static const char tasks[] =
	"RUNGBOARD 1\n\nVAR\n  Door AT %IX0.0 : BOOL;\n  Spin : BOOL;\nEND_VAR\n\n"
	"CONFIGURATION Plant\n"
	"  TASK Fast (INTERVAL := T#5ms, PRIORITY := 1);\n"
	"  TASK Slow (INTERVAL := T#20ms, PRIORITY := 2);\n"
	"  TASK Rung (SINGLE := Door, PRIORITY := 3);\n"
	"  PROGRAM A WITH Fast : One;\n  PROGRAM B WITH Slow : Two;\n"
	"  PROGRAM C WITH Rung : Three;\nEND_CONFIGURATION\n\n"
	"PROGRAM One LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n\n"
	"PROGRAM Two LD\nRUNG Again\n  | NO Spin | JMP Again |\nEND_PROGRAM\n\n"
	"PROGRAM Three LD\nRUNG\n  | NO %IX0.3 | COIL %QX0.3 |\nEND_PROGRAM\n";
static const char plain[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";

/* Slow counts to 20 in a loop that begins with a safe point. A run of Fast has more than 10 words:
 * at 1 word/ms it takes longer than 10 periods of 1 ms. */
static const char pair[] =
	"RUNGBOARD 1\n\nVAR_GLOBAL\n  N, K, Sum : INT;\nEND_VAR\n\nCONFIGURATION Plant\n"
	"  TASK Fast (INTERVAL := T#1ms, PRIORITY := 0);\n"
	"  TASK Slow (INTERVAL := T#50ms, PRIORITY := 1);\n"
	"  PROGRAM A WITH Fast : One;\n  PROGRAM B WITH Slow : Two;\nEND_CONFIGURATION\n\n"
	"PROGRAM One IL\n  LD N\n  ADD 1\n  ST N\n  LD Sum\n  ADD N\n  ST Sum\n  LD Sum\n"
	"  MUL 3\n  ST Sum\nEND_PROGRAM\n\n"
	"PROGRAM Two IL\n  LD 0\n  ST K\nAgain:\n  LD K\n  ADD 1\n  ST K\n  LT 20\n"
	"  JMPC Again\nEND_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;
static struct task_runs *runs;

static void open_text(const char *text)
{
	ladder_document_open_text(document, NULL, text, strlen(text), true);
}

static void scan(int scans)
{
	const guint64 last = ladder_sim_last(sim) + (guint64)scans;

	ladder_sim_scan(sim, scans);
	CHECK_SOON(ladder_sim_twin(sim)->scan == last);
	while (task_runs_feed(runs, G_USEC_PER_SEC))
		;
}

static void set(const char *name, gint64 to)
{
	const struct image *image = &ladder_sim_twin(sim)->resource.image;

	ladder_sim_act(sim, &(struct act){ .kind = ACT_SET, .value.i = to,
		.at = image_find(image, name, strlen(name)) });
}

/* "5:Fast 5:Slow+3/1" of all runs: the time in ms, the task, how late in ms, and what was left
 * out. */
static bool are(const char *want)
{
	GString *got = g_string_new(NULL);
	bool good;

	for (guint i = 0; i < task_runs_count(runs); i++) {
		const struct task_run *run = task_runs_get(runs, i);

		g_string_append_printf(got, "%s%lld:%s", i ? " " : "", (long long)(run->at_ns / MS),
				       *run->task ? run->task : "-");
		if (run->late_ns || run->missed)
			g_string_append_printf(got, "+%lld/%u", (long long)(run->late_ns / MS),
					       run->missed);
		if (run->fault)
			g_string_append_c(got, '!');
	}
	good = strcmp(got->str, want) == 0;
	if (!good)
		printf("# %s\n# %s\n", got->str, want);
	g_string_free(got, TRUE);
	return good;
}

static bool says(gint64 ms, const char *want)
{
	char *text = task_runs_at_text(runs, ms * MS, ladder_sim_period(sim));
	const bool good = strcmp(text, want) == 0;

	if (!good)
		printf("# %s\n", text);
	g_free(text);
	return good;
}

/* Lives until the next call. */
static const char *says_sum(const char *task)
{
	static char *text;

	g_free(text);
	return text = task_runs_sum_text(ladder_sim_twin(sim), task);
}

static bool sums(const char *task, const char *want)
{
	return g_strcmp0(says_sum(task), want) == 0;
}

static void test_planned(void)
{
	open_text(tasks);
	CHECK(ladder_sim_begin(sim, NULL) && ladder_sim_period(sim) == 5 * MS);
	CHECK(!task_runs_feed(runs, G_USEC_PER_SEC) && task_runs_count(runs) == 0);
	scan(5);
	CHECK(are("5:Fast 5:Slow 10:Fast 15:Fast 20:Fast 25:Fast 25:Slow"));
	CHECK(task_runs_get(runs, 1)->order == 1 && task_runs_get(runs, 2)->order == 0);
	CHECK(task_runs_from(runs, 6 * MS) == 2 && task_runs_from(runs, 99 * MS) == 7);
	CHECK(says(27, "At 25 ms: Fast, then Slow") && says(2, "At 0 s: nothing ran"));
	CHECK(sums("Slow", "2 runs") && sums("Rung", "0 runs") && sums("None", NULL));
}

static void test_event(void)
{
	set("Door", 1);
	scan(1);
	CHECK(says(30, "At 30 ms: Fast, then Rung"));
	scan(1);
	CHECK(says(35, "At 35 ms: Fast"));
}

/* The period of the scans does not fit to the tasks. */
static void test_late(void)
{
	ladder_sim_set_period(sim, 12 * MS);
	CHECK_SOON(ladder_sim_period(sim) == 12 * MS);
	scan(1);
	CHECK(says(47, "At 47 ms: Fast (7 ms late, 1 run left out), then Slow (2 ms late)"));
	CHECK(sums("Fast", "8 runs, 1 left out"));
	CHECK(ladder_sim_show(sim, 2) && sums("Fast", "2 runs"));
	ladder_sim_show_now(sim);
	ladder_sim_set_period(sim, 5 * MS);
	CHECK_SOON(ladder_sim_period(sim) == 5 * MS);
}

/* The runs before it stay. */
static void test_edit(void)
{
	const guint count = task_runs_count(runs);
	char **part = g_strsplit(tasks, "Fast", -1);
	char *text = g_strjoinv("Next", part), *was;
	gsize len;

	was = ladder_document_text(document, &len);
	CHECK(ladder_document_replace(document, 0, len, text, NULL));
	g_free(was);
	g_free(text);
	g_strfreev(part);
	CHECK_SOON(sums("Next", "8 runs, 1 left out") || sums("Next", "0 runs"));
	scan(1);
	CHECK(task_runs_count(runs) > count);
	CHECK_TEXT(task_runs_get(runs, count)->task, "Next");
	CHECK_TEXT(task_runs_get(runs, count - 2)->task, "Fast");
	CHECK(task_runs_get(runs, count)->missed == 0 && task_runs_get(runs, count)->late_ns == 0);
}

/* Counts begin at 0 again: nothing was left out. */
static void test_cold(void)
{
	const guint count = task_runs_count(runs);

	ladder_sim_set_period(sim, 12 * MS);
	scan(2);
	CHECK(strstr(says_sum("Next"), "left out"));
	ladder_sim_reset(sim, false);
	scan(1);
	CHECK(sums("Next", "1 run"));
	for (guint i = count; i < task_runs_count(runs); i++)
		CHECK(task_runs_get(runs, i)->missed <= 1);
	ladder_sim_set_period(sim, 5 * MS);
}

static void test_fault(void)
{
	const struct task_run *run;

	set("Spin", 1);
	ladder_sim_scan(sim, 5);
	CHECK_SOON(ladder_sim_state(sim) == SIM_FAULT);
	while (task_runs_feed(runs, G_USEC_PER_SEC))
		;
	run = task_runs_get(runs, task_runs_count(runs) - 1);
	CHECK(run->fault && strcmp(run->task, "Slow") == 0);
	CHECK(!task_runs_get(runs, task_runs_count(runs) - 2)->fault);
}

/* A program without tasks runs in each scan; runs of the simulation before are gone. */
static void test_plain(void)
{
	open_text(plain);
	CHECK(ladder_sim_restart(sim, NULL));
	scan(2);
	CHECK_AS(are("5:- 10:-") && sums("", "2 runs") && says(10, "At 10 ms: Each scan"),
		 "a program without tasks runs in each scan");
	ladder_sim_end(sim);
	CHECK(!task_runs_feed(runs, G_USEC_PER_SEC) && task_runs_count(runs) == 0);
}

static char *last_told;

static void told(LadderSim *of, const char *text, gboolean bad)
{
	(void)of, (void)bad;
	g_free(last_told);
	last_told = g_strdup(text);
}

/* With a speed of the board: how long the runs took, and which one was interrupted. */
static void test_paced(void)
{
	const struct task_run *run;
	guint first, count;
	char *text;

	ladder_sim_end(sim);
	open_text(pair);
	ladder_sim_set_period(sim, MS);
	ladder_sim_set_board_speed(sim, 120);
	CHECK(ladder_sim_board_speed(sim) == 120 && ladder_sim_begin(sim, NULL));
	CHECK(ladder_sim_twin(sim)->resource.pace.speed == 120);
	while (task_runs_feed(runs, G_USEC_PER_SEC))
		;
	scan(54);
	first = task_runs_from(runs, 51 * MS);
	count = task_runs_count(runs);
	CHECK(count - first >= 6);
	run = task_runs_get(runs, first);
	CHECK(strcmp(run->task, "Fast") == 0 && run->at_ns == 51 * MS && run->whole &&
	      run->took_ns > 0 && !run->paused_ns);
	run = task_runs_get(runs, first + 1);
	CHECK(strcmp(run->task, "Slow") == 0 && !run->whole && !run->paused_ns &&
	      run->at_ns == 51 * MS + task_runs_get(runs, first)->took_ns);
	CHECK(task_runs_get(runs, first + 3)->paused_ns == run->at_ns + run->took_ns);
	CHECK(task_runs_get(runs, first + 3)->at_ns > 52 * MS);
	text = task_runs_at_text(runs, 51 * MS + MS / 2, MS);
	CHECK(g_str_has_prefix(text, "At 51 ms: Fast (") && strstr(text, ", then Slow (") &&
	      g_str_has_suffix(text, ", interrupted)"));
	printf("# %s\n", text);
	g_free(text);
	CHECK(strstr(says_sum("Slow"), "2 runs, interrupted ") != NULL);
	/* Far too slow: the watchdog, which has no place in the program. */
	g_signal_connect(sim, "told", G_CALLBACK(told), NULL);
	ladder_sim_set_board_speed(sim, 1);
	ladder_sim_reset(sim, false);
	CHECK_SOON(ladder_sim_twin(sim)->resource.scans == 0);
	ladder_sim_scan(sim, 200);
	CHECK_SOON(ladder_sim_twin(sim)->resource.state == STATE_FAULT);
	CHECK(ladder_sim_twin(sim)->resource.fault == FAULT_WATCHDOG);
	CHECK_SOON(last_told && strstr(last_told, "task Fast: watchdog") != NULL);
	printf("# %s\n", last_told ? last_told : "nothing");
	ladder_sim_set_board_speed(sim, 0);
}

int main(void)
{
	document = ladder_document_new();
	sim = ladder_sim_new(document);
	runs = task_runs_new(sim);
	test_planned();
	test_event();
	test_late();
	test_edit();
	test_cold();
	test_fault();
	test_plain();
	test_paced();
	task_runs_free(runs);
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
