/* SPDX-License-Identifier: MIT
 *
 * test_scenario - records a scenario, runs it, and goes to the scan that failed, with the
 * thread of a simulation.
 */
#include "editor-gtk/sim/scenario_record.h"
#include "editor-gtk/sim/scenario_run.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Stop AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL;\n  Late AT %QX0.1 : BOOL;\n  Level : INT;\n"
	"  Label : STRING[8];\n  Delay : TON;\nEND_VAR\n\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Start | NC Stop | COIL Motor |\n  | NO Motor ^|\n"
	"RUNG\n  | NO Motor | TON Delay PT:=T#50ms | COIL Late |\n"
	"END_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;
static LadderRecorder *recorder;
static char *why;
static int endings;

static void ended(LadderRecorder *unused, const char *text, gpointer data)
{
	(void)unused;
	(void)data;
	g_free(why);
	why = g_strdup(text);
	endings++;
}

/* ---- the simulation, by name ---- */

static struct location place(const char *name)
{
	return image_find(&ladder_sim_twin(sim)->resource.image, name, strlen(name));
}

static gint64 value(const char *name)
{
	return image_get(&ladder_sim_twin(sim)->resource.image, place(name)).i;
}

static void act(enum act_kind kind, const char *name, gint64 to)
{
	const struct act act = { .kind = kind, .at = place(name), .value.i = to };

	ladder_sim_act(sim, &act);
}

static void scans(int count)
{
	const guint64 until = ladder_sim_last(sim) + (guint64)count;

	ladder_sim_scan(sim, count);
	WAIT(ladder_sim_twin(sim)->scan == until);
}

static bool expects(const char *name)
{
	char *said;
	const bool good = ladder_recorder_expect(recorder, name, &said);

	if (!good)
		printf("# %s\n", said);
	g_free(said);
	return good;
}

/* Begins a recording and pauses at once, so that the scan is known. */
static void begin_paused(void)
{
	ladder_sim_begin(sim, NULL);
	ladder_sim_scan(sim, 1);
	WAIT(ladder_sim_state(sim) == SIM_PAUSE && ladder_sim_last(sim) > 0);
	CHECK(ladder_recorder_begin(recorder, NULL));
	CHECK_SOON(ladder_sim_state(sim) == SIM_PAUSE && ladder_sim_twin(sim)->scan == 0);
}

/* ---- running ---- */

static GPtrArray *results;

static void done(GObject *source, GAsyncResult *result, gpointer data)
{
	(void)source;
	(void)data;
	results = scenario_run_finish(result);
}

static struct scenario_result *run(const char *text)
{
	GPtrArray *files = g_ptr_array_new_with_free_func(g_free);
	GPtrArray *texts = g_ptr_array_new_with_free_func(g_free);

	g_clear_pointer(&results, g_ptr_array_unref);
	g_ptr_array_add(files, g_strdup("/tmp/x/motor.scn"));
	g_ptr_array_add(texts, g_strdup(text));
	scenario_run_all(ladder_new(), "/tmp/x/motor.rung", sample, strlen(sample), files, texts, NULL,
			 done, NULL);
	WAIT(results);
	return results && results->len ? results->pdata[0] : NULL;
}

/* ---- tests ---- */

static char *recorded(void)
{
	begin_paused();
	CHECK(!expects("Motor")); /* no scan yet */
	act(ACT_SET, "Start", 1);
	scans(1);
	CHECK(value("Motor") == 1 && expects("Motor"));
	act(ACT_SET, "Start", 0);
	WAIT(value("Start") == 0);
	CHECK(!expects("Start")); /* it was 1 right after the scan */
	scans(6);
	CHECK(value("Late") == 1 && expects("Late") && expects("Delay.ET"));
	CHECK(!expects("Nobody"));
	act(ACT_SET, "Stop", 1);
	scans(2);
	CHECK(expects("Motor"));
	ladder_recorder_end(recorder);
	CHECK(endings == 1 && !why && !ladder_recorder_is_on(recorder));
	CHECK(ladder_recorder_acts(recorder) == 3 && ladder_recorder_expects(recorder) == 4);
	CHECK(!expects("Motor"));
	return ladder_recorder_text(recorder, "by hand");
}

static void test_record(void)
{
	static const char expected[] =
		"scenario \"by hand\"\n  period 10ms\n"
		"  at 10ms       Start = 1\n                expect Motor = 1\n"
		"  at 20ms       Start = 0\n"
		"  at 70ms       expect Late = 1, Delay.ET = T#50ms\n"
		"  at 80ms       Stop = 1\n"
		"  at 90ms       expect Motor = 0\n";
	char *text = recorded(), *wrong;
	struct scenario_result *result;
	char **parts;

	CHECK_TEXT(text, expected);
	result = run(text);
	CHECK(result && result->outcome == SCENARIO_HELD && results->len == 1);
	CHECK_TEXT(result->name, "by hand");
	/* A wrong expectation is shown at its scan. */
	parts = g_strsplit(text, "Late = 1", 2);
	wrong = g_strconcat(parts[0], "Late = 0", parts[1], NULL);
	result = run(wrong);
	CHECK(result && result->outcome == SCENARIO_FAILED && result->line == 6 &&
	      result->scan == 7);
	CHECK_TEXT(result->why, "at 70 ms: not true: at 70ms       expect Late = 0");
	CHECK(ladder_sim_play(sim, result->period_ns, result->speed, result->acts, result->scan, NULL));
	CHECK_SOON(ladder_sim_twin(sim)->scan == 7 && ladder_sim_state(sim) == SIM_PAUSE);
	CHECK(value("Late") == 1 && value("Start") == 0 &&
	      value("Delay.ET") == G_GINT64_CONSTANT(50000000));
	CHECK(ladder_sim_show(sim, 1) && value("Start") == 1 && value("Late") == 0);
	g_strfreev(parts);
	g_free(wrong);
	g_free(text);
}

/* The same recording while the simulation runs by itself. */
static void test_running(void)
{
	struct scenario_result *result;
	char *text;

	ladder_sim_end(sim);
	CHECK(ladder_recorder_begin(recorder, NULL));
	for (int i = 0; i < 12; i++) {
		const guint64 from = ladder_sim_last(sim);

		act(ACT_SET, i % 3 ? "Start" : "Stop", i / 2 % 2);
		WAIT(ladder_sim_twin(sim)->scan > from + 3);
		CHECK(expects(i % 2 ? "Motor" : "Delay.ET"));
	}
	ladder_recorder_end(recorder);
	CHECK(ladder_recorder_acts(recorder) == 12);
	text = ladder_recorder_text(recorder, "running");
	result = run(text);
	if (!CHECK(result && result->outcome == SCENARIO_HELD))
		printf("# %s\n# %s\n", result->why, text);
	g_free(text);
}

static void test_ended(void)
{
	begin_paused();
	act(ACT_SET, "Start", 1);
	scans(2);
	endings = 0;
	act(ACT_FORCE, "Motor", 0);
	scans(1);
	CHECK_SOON(endings == 1 && why && strstr(why, "force"));
	CHECK(!ladder_recorder_is_on(recorder) && ladder_recorder_acts(recorder) == 1);
	CHECK(ladder_recorder_expect_outputs(recorder) == 2);
	begin_paused();
	ladder_document_declare(document, -1, "Spare", "INT", NULL, NULL);
	ladder_document_check_now(document);
	CHECK_SOON(endings == 2 && strstr(why, "changed"));
	CHECK(ladder_recorder_expect_outputs(recorder) == 0);
	ladder_document_undo(document);
	ladder_document_check_now(document);
	ladder_sim_end(sim);
	CHECK(ladder_recorder_begin(recorder, NULL));
	ladder_sim_end(sim);
	CHECK(endings == 3 && !ladder_recorder_is_on(recorder));
}

static void test_unread(void)
{
	struct scenario_result *result = run("scenario \"a\"\n  at 10ms  Strat = 1\n"
					     "  expect Motor\n  expect Lamp\n");

	CHECK(results->len == 2 && result->outcome == SCENARIO_UNREAD && result->line == 2 &&
	      result->column == 12 && strstr(result->why, "Strat"));
	CHECK(((struct scenario_result *)results->pdata[1])->line == 4);
	result = run("scenario \"text\"\n  at 20ms  Label = 'abc', Level = 7\n"
		     "  at 30ms expect Label = 'abd'\n");
	CHECK(result->outcome == SCENARIO_FAILED && result->scan == 3 &&
	      result->acts->len == 2);
	CHECK(ladder_sim_play(sim, result->period_ns, result->speed, result->acts, result->scan, NULL));
	CHECK_SOON(ladder_sim_twin(sim)->scan == 3);
	CHECK(value("Level") == 7);
	CHECK(image_get(&ladder_sim_twin(sim)->resource.image, place("Label")).s->length == 3);
}

/* The plant that the file names is found beside it, in a run and when a failure is shown. */
static void test_plant(void)
{
	static const char plant[] =
		"RUNGBOARD 1\n\nVAR\n  Runs AT %IX0.0 : BOOL;\n  Away AT %QX0.1 : BOOL;\n"
		"END_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO Runs | COIL Away |\n"
		"END_PROGRAM\n";
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *path = g_build_filename(folder, "belt.plant.rung", NULL);
	char *text = g_strdup_printf("plant \"%s\"\nscenario \"it stops itself\"\n"
		"  at 10ms Start = 1\n  expect Motor\n  at 20ms expect plant.Away\n"
		"  Start = 0\n  at 30ms expect Motor\n", path);
	struct scenario_result *result;

	CHECK(g_file_set_contents(path, plant, -1, NULL));
	result = run(text);
	if (!CHECK(result->outcome == SCENARIO_FAILED && result->scan == 3 &&
		   result->line == 7))
		printf("# %d: %s\n", result->line, result->why);
	CHECK(g_strcmp0(result->plant, path) == 0);
	CHECK(ladder_sim_set_plant(sim, result->plant, NULL));
	CHECK(ladder_sim_play(sim, result->period_ns, result->speed, result->acts, result->scan, NULL));
	CHECK_SOON(ladder_sim_twin(sim)->scan == 3);
	CHECK(ladder_sim_show(sim, 2) && value("Stop") == 1 && value("Motor") == 0);
	begin_paused();
	scans(3);
	CHECK(expects("Motor"));
	ladder_recorder_end(recorder);
	g_free(text);
	text = ladder_recorder_text(recorder, "beside a plant");
	CHECK(strstr(text, "\n  plant \"") && strstr(text, "belt.plant.rung\"\n"));
	CHECK(run(text)->outcome == SCENARIO_HELD);
	g_unlink(path);
	CHECK(run(text)->outcome == SCENARIO_UNREAD && results->len == 1);
	CHECK(ladder_sim_set_plant(sim, NULL, NULL));
	g_rmdir(folder);
	g_free(text);
	g_free(path);
	g_free(folder);
}

static void test_files(void)
{
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	static const char *const names[] = {
		"motor.rung", "motor.scn", "motor-more.scn", "motor2.rung", "motor2.scn",
		"door.scn",
	};
	char *path = g_build_filename(folder, "motor.rung", NULL);
	GPtrArray *files;

	for (gsize i = 0; i < G_N_ELEMENTS(names); i++) {
		char *file = g_build_filename(folder, names[i], NULL);

		g_file_set_contents(file, "", 0, NULL);
		g_free(file);
	}
	files = scenario_files(path);
	CHECK(files->len == 2 && g_str_has_suffix(files->pdata[0], "/motor-more.scn") &&
	      g_str_has_suffix(files->pdata[1], "/motor.scn"));
	g_ptr_array_unref(files);
	for (gsize i = 0; i < G_N_ELEMENTS(names); i++) {
		char *file = g_build_filename(folder, names[i], NULL);

		g_unlink(file);
		g_free(file);
	}
	g_rmdir(folder);
	g_free(path);
	g_free(folder);
}

int main(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/motor.rung", sample, strlen(sample), true);
	ladder_document_check_now(document);
	sim = ladder_sim_new(document);
	recorder = ladder_recorder_new(sim);
	g_signal_connect(recorder, "ended", G_CALLBACK(ended), NULL);
	test_record();
	test_running();
	test_ended();
	test_unread();
	test_plant();
	test_files();
	g_clear_pointer(&results, g_ptr_array_unref);
	g_free(why);
	g_object_unref(recorder);
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
