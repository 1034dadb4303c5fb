/* SPDX-License-Identifier: MIT
 *
 * test_board_values - the simulation of a document shows a real ladderd: values, power, writes,
 * forces, modes, a role that may only look, another program, more variables than are published,
 * a board that goes and comes back, or is late.
 */
#include "editor-gtk/online/board_values.h"
#include "editor-gtk/live/timing.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/task_runs.h"
#include "tests/editor/online/board.h"

#include <string.h>

#define OTHER "RUNGBOARD 1\nPROJECT \"Other\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n" \
	"  Motor AT %QX0.0 : BOOL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n" \
	"  | NO Start | COIL Motor |\nRUNG\n  | NC Start | COIL Motor |\nEND_PROGRAM\n"

#define RECORDED "RUNGBOARD 1\nPROJECT \"Recorded\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n" \
	"  Motor AT %QX0.0 : BOOL;\n  Count : DINT;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n" \
	"  | --- | [ Count := Count + 1 ] |\nRUNG\n  | NO Start | COIL Motor |\nEND_PROGRAM\n"

static LadderDocument *document;
static LadderSim *sim;
static LadderBoardLink *link_;
static LadderBoardValues *values;
static char *told, *mended;
static struct location refused_at;
static char *refused;

static void keep_refused(LadderSim *of, const struct location *at, const char *why)
{
	(void)of;
	refused_at = *at;
	g_free(refused);
	refused = g_strdup(why);
}

static void keep_told(LadderSim *of, const char *text, gboolean bad)
{
	(void)of;
	(void)bad;
	g_free(told);
	told = g_strdup(text);
}

static void keep_mended(LadderBoardValues *of, const char *why)
{
	(void)of;
	g_free(mended);
	mended = g_strdup(why);
}

static void open_editor(const char *text)
{
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, text, strlen(text), true);
	sim = ladder_sim_new(document);
	g_signal_connect(sim, "told", G_CALLBACK(keep_told), NULL);
	g_signal_connect(sim, "refused", G_CALLBACK(keep_refused), NULL);
	link_ = ladder_board_link_new();
	values = ladder_board_values_new(sim, link_);
	g_signal_connect(values, "mended", G_CALLBACK(keep_mended), NULL);
}

static void close_editor(void)
{
	ladder_board_link_disconnect(link_);
	CHECK(!ladder_sim_is_on(sim));
	g_object_unref(values);
	g_object_unref(link_);
	g_object_unref(sim);
	g_object_unref(document);
	g_clear_pointer(&told, g_free);
	g_clear_pointer(&mended, g_free);
	g_clear_pointer(&refused, g_free);
}

static void connect_to(const struct test_board *board)
{
	char *why = NULL;

	CHECK(ladder_board_link_connect(link_, board->where, &why));
}

static struct location place(const char *name)
{
	const struct image *image = live_image(sim, false);

	return image ? image_find(image, name, strlen(name)) :
		       (struct location){ .type = IEC_NONE };
}

static gint64 value(const char *name)
{
	return live_value_get(sim, false, place(name)).i;
}

static bool power(guint rung, guint col)
{
	const struct twin *twin = ladder_sim_twin(sim);
	bool in = false, out = false;

	return twin && ladder_sim_has_power(sim, "Main") &&
	       resource_power(&twin->resource, 0, rung, 1, col, &in, &out) && out;
}

static void shows_and_changes(void)
{
	struct test_board board = { .empty = false };
	guint64 scan;

	board_open(&board, "eng");
	open_editor(BOARD_PROGRAM);
	CHECK_AS(ladder_sim_begin(sim, NULL), "a simulation runs before");
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) && ladder_sim_state(sim) == SIM_RUN);
	CHECK_TEXT(ladder_sim_board(sim), "table");
	scan = ladder_sim_twin(sim)->scan;
	CHECK_SOON(ladder_sim_twin(sim)->scan > scan + 5);
	CHECK(value("Motor") == 0 && ladder_sim_forces(sim) == 0 && !ladder_sim_late(sim));
	live_value_force(sim, false, place("Start"), (union iec_value){ .i = 1 });
	CHECK_SOON(ladder_sim_forces(sim) == 1 && value("Motor") == 1);
	CHECK_SOON(power(1, 1) && power(1, 2));
	live_value_set(sim, false, place("Count"), (union iec_value){ .i = 1234 });
	CHECK_SOON(value("Count") == 1234);
	CHECK_AS(!refused, "nothing was refused");
	ladder_sim_release_all(sim);
	CHECK_SOON(ladder_sim_forces(sim) == 0 && !power(1, 1));
	ladder_sim_stop(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_STOP);
	ladder_sim_run(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_RUN);
	CHECK_SOON(value("Count") == 0); /* Run is a warm start, and Count is not retained */
	CHECK_SOON(ladder_sim_last(sim) > ladder_sim_first(sim) + 3);
	CHECK(ladder_sim_show(sim, ladder_sim_last(sim) - 1) && ladder_sim_is_past(sim));
	ladder_sim_show_now(sim);
	CHECK_AS(ladder_sim_begin(sim, NULL) && ladder_sim_board(sim), "it is on already");
	CHECK(ladder_sim_why_not(sim, SIM_WISH_TIME) && ladder_sim_why_not(sim, SIM_WISH_RESTART) &&
	      !ladder_sim_why_not(sim, SIM_WISH_FORCE));
	board_stop(&board);
	CHECK_SOON(!ladder_sim_is_on(sim));
	CHECK_AS(!ladder_sim_twin(sim), "values of a board that has gone are unknown");
	board_start(&board);
	CHECK_SOON(ladder_sim_board(sim) && ladder_sim_state(sim) == SIM_RUN);
	close_editor();
	board_close(&board);
}

/* @words: after the place of the board; NULL-ended. */
static void run_ladder(const struct test_board *board, const char *const *words)
{
	const char *build = g_getenv("BUILD");
	char *relative = g_build_filename(build ? build : "build", "ladder", NULL);
	char *program = g_canonicalize_filename(relative, NULL);
	const char *arguments[8] = { program, "board", board->where };
	GSubprocessLauncher *launcher = g_subprocess_launcher_new(
		G_SUBPROCESS_FLAGS_STDOUT_SILENCE | G_SUBPROCESS_FLAGS_STDERR_SILENCE);
	GSubprocess *run;

	for (int i = 0; words[i]; i++)
		arguments[3 + i] = words[i];
	g_subprocess_launcher_set_cwd(launcher, board->folder);
	run = g_subprocess_launcher_spawnv(launcher, arguments, NULL);
	CHECK(run && g_subprocess_wait_check(run, NULL, NULL));
	g_clear_object(&run);
	g_object_unref(launcher);
	g_free(program);
	g_free(relative);
}

static void download(const struct test_board *board, const char *file)
{
	run_ladder(board, (const char *[]){ "download", file, "board.io", "--yes", NULL });
}

/* A file of `ladder board … record` is shown without its board; only with its program. */
static void plays_a_recording(void)
{
	struct test_board board = { .empty = false };
	GError *error = NULL;
	char *path;
	guint64 first, last;
	gint64 count;

	board_open(&board, "eng");
	board_write(&board, "recorded.rung", RECORDED);
	download(&board, "recorded.rung");
	turn(300);
	run_ladder(&board, (const char *[]){ "record", "-o", "it.rec", NULL });
	path = board_path(&board, "it.rec");
	open_editor(OTHER);
	CHECK(!ladder_sim_play_recording(sim, path, &error) && !ladder_sim_is_on(sim));
	CHECK(strstr(error->message, "it.rec: it was recorded with another program"));
	g_clear_error(&error);
	close_editor();
	open_editor(RECORDED);
	CHECK(!ladder_sim_play_recording(sim, "/dev/null", &error) && !ladder_sim_is_on(sim));
	g_clear_error(&error);
	CHECK(ladder_sim_play_recording(sim, path, &error));
	CHECK_SOON(ladder_sim_is_on(sim) && ladder_sim_state(sim) == SIM_PAUSE);
	CHECK(ladder_sim_is_recording(sim));
	CHECK_TEXT(ladder_sim_board(sim), "table");
	last = ladder_sim_last(sim);
	first = ladder_sim_first(sim);
	CHECK(ladder_sim_twin(sim)->scan == last && last > first + 10);
	CHECK(ladder_sim_show(sim, last - 9));
	count = value("Count");
	for (int i = 1; i < 9; i++)
		CHECK(ladder_sim_show(sim, last - 9 + (guint64)i) && value("Count") == count + i);
	CHECK(power(1, 1) && !ladder_sim_is_missing(sim, document, 0, 0));
	ladder_sim_run(sim);
	live_value_set(sim, false, place("Count"), (union iec_value){ .i = 0 });
	CHECK(told && g_str_has_prefix(told, "A recording only shows"));
	ladder_sim_show_now(sim);
	CHECK_AS(value("Count") == count + 9, "nothing is changed in a recording");
	ladder_sim_end(sim);
	CHECK(ladder_sim_begin(sim, NULL) && ladder_sim_state(sim) == SIM_STOP);
	ladder_sim_end(sim);
	close_editor();
	g_free(path);
	board_close(&board);
}

/* The board recorded scans before the editor was there, and each one since. */
static void shows_its_record(void)
{
	struct test_board board = { .empty = false };
	guint64 connected, scan;
	gint64 count;

	board_open(&board, "eng");
	open_editor(RECORDED);
	board_write(&board, "recorded.rung", RECORDED);
	download(&board, "recorded.rung");
	turn(300);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	connected = ladder_sim_first(sim);
	CHECK_SOON(ladder_sim_last(sim) > connected + 20);
	CHECK(ladder_sim_show(sim, ladder_sim_last(sim)));
	CHECK_SOON(ladder_sim_first(sim) < connected);
	scan = connected - 3;
	CHECK(ladder_sim_show(sim, scan) && ladder_sim_twin(sim)->scan == scan);
	count = value("Count");
	for (int i = 1; i < 10; i++)
		CHECK_AS(ladder_sim_show(sim, scan + i) && value("Count") == count + i,
			 "each scan is computed again");
	CHECK(power(1, 1));
	ladder_sim_show_now(sim);
	CHECK(!ladder_sim_is_past(sim) && value("Count") > count + 10);
	close_editor();
	board_close(&board);
}

#define TASKS "RUNGBOARD 1\nPROJECT \"Tasks\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n" \
	"  Motor AT %QX0.0 : BOOL;\n  Count : DINT;\nEND_VAR\n\nCONFIGURATION Plant\n" \
	"  TASK Fast (INTERVAL := T#10ms, PRIORITY := 1);\n" \
	"  TASK Slow (INTERVAL := T#40ms, PRIORITY := 2);\n" \
	"  PROGRAM A WITH Fast : Main;\n  PROGRAM B WITH Slow : Other;\nEND_CONFIGURATION\n\n" \
	"PROGRAM Main LD\nRUNG\n  | NO Start | COIL Motor |\nEND_PROGRAM\n\n" \
	"PROGRAM Other LD\nRUNG\n  | --- | [ Count := Count + 1 ] |\nEND_PROGRAM\n"

/* How often a task ran, from a run on. */
static guint ran(const struct task_runs *runs, const char *task, guint from)
{
	guint count = 0;

	for (guint i = from; i < task_runs_count(runs); i++)
		count += strcmp(task_runs_get(runs, i)->task, task) == 0;
	return count;
}

/* ns of the run that was most behind its deadline. */
static gint64 latest(const struct task_runs *runs)
{
	gint64 most = 0;

	for (guint i = 0; i < task_runs_count(runs); i++)
		most = MAX(most, task_runs_get(runs, i)->late_ns);
	return most;
}

/* Reads what the board has recorded; it may be more than before. */
static guint runs_of(struct task_runs *runs)
{
	ladder_sim_fetch(sim);
	turn(20);
	while (task_runs_feed(runs, G_USEC_PER_SEC))
		;
	return task_runs_count(runs);
}

/* The real runs, also those after a restart; those of the last scans come with the next fetch. */
static void shows_which_task_ran(void)
{
	struct test_board board = { .empty = false };
	struct task_runs *runs;
	guint64 before;
	guint first;

	board_open(&board, "eng");
	board_write(&board, "tasks.rung", TASKS);
	download(&board, "tasks.rung");
	open_editor(TASKS);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) && ladder_sim_last(sim) > ladder_sim_first(sim) + 3);
	runs = task_runs_new(sim);
	CHECK_SOON(runs_of(runs) > 20);
	CHECK(ran(runs, "Fast", 0) > ran(runs, "Slow", 0) && ran(runs, "Slow", 0) > 1);
	first = task_runs_count(runs);
	CHECK_SOON(runs_of(runs) > first + 20);
	CHECK_AS(ran(runs, "Fast", first) > ran(runs, "Slow", first), "later runs are added");
	for (guint i = 1; i < task_runs_count(runs); i++)
		if (task_runs_get(runs, i)->at_ns < task_runs_get(runs, i - 1)->at_ns)
			CHECK_AS(false, "runs follow each other in time");
	CHECK(task_runs_time(runs) > 0);
	g_subprocess_send_signal(board.daemon, SIGSTOP);
	turn(200);
	g_subprocess_send_signal(board.daemon, SIGCONT);
	CHECK_SOON(runs_of(runs) && latest(runs) >= G_GINT64_CONSTANT(100000000));
	CHECK_AS(latest(runs) < G_GINT64_CONSTANT(60000000000),
		 "how late a run was is counted on the clock of the views");
	ladder_sim_stop(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_STOP);
	before = task_runs_get(runs, task_runs_count(runs) - 1)->scan;
	ladder_sim_run(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_RUN);
	CHECK_SOON(runs_of(runs) > 4 && task_runs_get(runs, task_runs_count(runs) - 1)->scan < before);
	task_runs_free(runs);
	close_editor();
	board_close(&board);
}

/* The timing chart takes what is published, and shows the values of the next program after a swap. */
static void fills_a_timing_chart(void)
{
	struct test_board board = { .empty = false };
	struct timing *timing;
	double low, high;

	board_open(&board, "eng");
	board_write(&board, "recorded.rung", RECORDED);
	download(&board, "recorded.rung");
	open_editor(RECORDED);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	timing = timing_new(sim);
	CHECK(timing_add(timing, "Motor") && timing_add(timing, "Count"));
	CHECK_SOON(!timing_feed(timing, 1000) && timing_end(timing) > timing_first(timing) + 10);
	CHECK(timing_value(timing, 1, timing_end(timing) - 1) >
	      timing_value(timing, 1, timing_first(timing)) + 5);
	live_value_force(sim, false, place("Start"), (union iec_value){ .i = 1 });
	CHECK_SOON(!timing_feed(timing, 1000) &&
		   timing_value(timing, 0, timing_end(timing) - 1) == 1);
	CHECK(timing_range(timing, 0, timing_first(timing), timing_end(timing) - 1, &low, &high) &&
	      low == 0 && high == 1);
	timing_free(timing);
	close_editor();
	board_close(&board);
}

static void only_looks(void)
{
	struct test_board board = { .empty = false };

	board_open(&board, "view");
	open_editor(BOARD_PROGRAM);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	live_value_force(sim, false, place("Start"), (union iec_value){ .i = 1 });
	CHECK_SOON(told && strstr(told, "ladder-eng") && strstr(told, "view"));
	CHECK_TEXT(ladder_sim_why_not(sim, SIM_WISH_FORCE), told);
	close_editor();
	open_editor(OTHER);
	connect_to(&board);
	CHECK_SOON(told && *told);
	CHECK_AS(!ladder_sim_is_on(sim), "this role cannot read another program");
	close_editor();
	board_close(&board);
}

/* An operator may write what the program exports. The view in which a person did it can say so. */
static void says_where_it_is_refused(void)
{
	struct test_board board = { .empty = false };

	board_open(&board, "oper");
	open_editor(BOARD_PROGRAM);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK(!ladder_sim_why_not(sim, SIM_WISH_SET) && ladder_sim_why_not(sim, SIM_WISH_FORCE));
	live_value_set(sim, false, place("Count"), (union iec_value){ .i = 5 });
	CHECK_SOON(refused && strstr(refused, "\"Count\" may be written only with the role eng"));
	CHECK(refused && live_value_is_same(refused_at, place("Count")));
	live_value_force(sim, false, place("Start"), (union iec_value){ .i = 1 });
	CHECK(refused && strstr(refused, "ladder-eng") &&
	      live_value_is_same(refused_at, place("Start")));
	CHECK_TEXT(refused, ladder_board_link_why_not(link_, SERVICE_FORCE));
	close_editor();
	board_close(&board);
}

#define LARGE 3000

/* A program with so many variables that the board does not publish all. Caller frees. */
static char *large_program(void)
{
	GString *text = g_string_new("RUNGBOARD 1\nPROJECT \"Large\"\n\nVAR\n"
		"  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\n");

	for (int i = 0; i < LARGE; i++)
		g_string_append_printf(text, "  Number%d : INT := %d;\n", i, i);
	g_string_append(text, "END_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO Start | COIL Motor |\n"
			      "END_PROGRAM\n");
	return g_string_free(text, FALSE);
}

/* Those that views need come; the board counts forces that it does not publish, too. */
static void shows_some_of_many(void)
{
	struct test_board board = { .empty = false };
	char *program = large_program();
	struct location last, first;

	board_open(&board, "eng");
	board_write(&board, "large.rung", program);
	download(&board, "large.rung");
	open_editor(program);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) && value("Number7") == 7);
	run_ladder(&board, (const char *[]){ "force", "Number2999=5", NULL });
	CHECK_SOON(ladder_sim_forces(sim) == 1);
	last = place("Number2999");
	first = place("Number0");
	g_subprocess_send_signal(board.daemon, SIGSTOP);
	CHECK_AS(!ladder_sim_knows(sim, last), "it is beyond those that are published");
	turn(200);
	CHECK_AS(!ladder_sim_knows(sim, place("Number2998")), "it is needed while the board is asked");
	turn(200);
	g_subprocess_send_signal(board.daemon, SIGCONT);
	CHECK_SOON(ladder_sim_knows(sim, last) && ladder_sim_knows(sim, place("Number2998")));
	CHECK_SOON(value("Number2999") == 5 && value("Number2998") == 2998);
	CHECK_AS(ladder_sim_knows(sim, first), "the others go on");
	CHECK_AS(!told || !strstr(told, "more than the board can take"), "nothing is asked for too early");
	run_ladder(&board, (const char *[]){ "unforce", NULL });
	CHECK_SOON(ladder_sim_forces(sim) == 0);
	close_editor();
	board_close(&board);
	g_free(program);
}

#define CHART "RUNGBOARD 1\nPROJECT \"Chart\"\n\nVAR\n  Start AT %IX0.0 : BOOL;\n" \
	"  Motor AT %QX0.0 : BOOL;\nEND_VAR\n\nPROGRAM Main SFC\n  INITIAL_STEP Idle:\n  END_STEP\n\n" \
	"  TRANSITION FROM Idle TO Run := Start; END_TRANSITION\n\n  STEP Run:\n    Motor(N);\n" \
	"  END_STEP\n\n  TRANSITION FROM Run TO Idle := NOT Start; END_TRANSITION\nEND_PROGRAM\n"

/* The rungs of its conditions are those of the board, so their power is shown. */
static void numbers_a_chart(void)
{
	struct test_board board = { .empty = false };

	board_open(&board, "eng");
	board_write(&board, "chart.rung", CHART);
	download(&board, "chart.rung");
	open_editor(CHART);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK(ladder_sim_rung(sim, document, 0, 0) == 0 && ladder_sim_rung(sim, document, 0, 1) == 1);
	CHECK(ladder_sim_may_miss(sim) && !ladder_sim_is_missing(sim, document, 0, -1) &&
	      !ladder_sim_is_missing(sim, document, SIM_SYMBOLS, -1));
	close_editor();
	board_close(&board);
}

/* A board that does not answer: what is shown gets older. */
static void says_how_late_it_is(void)
{
	struct test_board board = { .empty = false };
	gint64 late;

	board_open(&board, "eng");
	open_editor(BOARD_PROGRAM);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK(ladder_sim_late(sim) == 0);
	g_subprocess_send_signal(board.daemon, SIGSTOP);
	CHECK_SOON(ladder_sim_late(sim) >= 200000000);
	late = ladder_sim_late(sim);
	CHECK_SOON(ladder_sim_late(sim) > late);
	CHECK_AS(ladder_sim_late(sim) % 100000000 == 0, "in steps that can be read");
	g_subprocess_send_signal(board.daemon, SIGCONT);
	CHECK_SOON(ladder_sim_late(sim) == 0 && ladder_sim_board(sim));
	close_editor();
	board_close(&board);
}

/* ladderd was started with a file: it has no sources of it. */
static void knows_no_sources(void)
{
	struct test_board board = { .empty = false };

	board_open(&board, "eng");
	open_editor(OTHER);
	connect_to(&board);
	CHECK_SOON(told && strstr(told, "sources"));
	CHECK(!mended && !ladder_sim_is_on(sim));
	board_write(&board, "other.rung", OTHER);
	download(&board, "other.rung");
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK_AS(mended && strcmp(mended, told) == 0, "what was told before is true no more");
	close_editor();
	board_close(&board);
}

/* The board runs a folder of IEC text that a command has sent. */
static void shows_several_files(void)
{
	struct test_board board = { .empty = false };
	char *path;

	board_open(&board, "eng");
	path = board_path(&board, "line");
	g_mkdir(path, 0700);
	board_write(&board, "line/kinds.st", "TYPE\n  Kind : (Off, Go);\nEND_TYPE\n"
		    "VAR_GLOBAL\n  Most : INT := 3;\nEND_VAR\n");
	board_write(&board, "line/main.st", "PROGRAM Main\nVAR\n  Motor AT %QX0.0 : BOOL;\n"
		    "  Now : Kind;\n  Count : INT;\nEND_VAR\n  Count := Count + 1;\n"
		    "  Motor := Count >= Most;\n  IF Motor THEN\n    Now := Go;\n  END_IF;\nEND_PROGRAM\n");
	download(&board, "line");
	open_editor(OTHER);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK_SOON(ladder_sim_twin(sim) && value("Most") == 3 && value("Main.Motor") == 1 &&
		   value("Main.Now") == 1);
	CHECK(!told || !*told);
	close_editor();
	g_free(path);
	board_close(&board);
}

static void waits_for_a_program(void)
{
	struct test_board board = { .empty = true };

	board_open(&board, "eng");
	open_editor(OTHER);
	connect_to(&board);
	CHECK_SOON(told && strcmp(told, "The board has no program.") == 0);
	board_write(&board, "other.rung", OTHER);
	download(&board, "other.rung");
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK_TEXT(mended, "The board has no program.");
	close_editor();
	board_close(&board);
}

/* Somebody else downloads while the editor is connected. */
static void gets_another_program(void)
{
	struct test_board board = { .empty = false };

	board_open(&board, "eng");
	board_write(&board, "other.rung", OTHER);
	open_editor(BOARD_PROGRAM);
	connect_to(&board);
	CHECK_SOON(ladder_sim_board(sim) != NULL);
	CHECK(!ladder_sim_is_missing(sim, document, 0, 0));
	download(&board, "other.rung");
	CHECK_SOON(ladder_sim_board(sim) && ladder_sim_ladder(sim) &&
		   ladder_project(ladder_sim_ladder(sim))->pou[0].rung_count == 2);
	CHECK(ladder_sim_rung(sim, document, 0, 0) == 0);
	CHECK_SOON(power(2, 2) && value("Motor") == 1);
	close_editor();
	board_close(&board);
}

int main(void)
{
	shows_and_changes();
	shows_its_record();
	shows_which_task_ran();
	fills_a_timing_chart();
	plays_a_recording();
	only_looks();
	says_where_it_is_refused();
	shows_some_of_many();
	numbers_a_chart();
	says_how_late_it_is();
	knows_no_sources();
	shows_several_files();
	waits_for_a_program();
	gets_another_program();
	return tap_done();
}
