/* SPDX-License-Identifier: MIT
 *
 * test_sim - the simulation: run, pause, single scans, acts, scans of the past, errors,
 * faults, and a timing chart that has every scan.
 */
#include "editor-gtk/live/timing.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/sim_thread.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include "engine/base/limits.h"

#include <glib/gstdio.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n"
	"  Spin : BOOL;\n  Count : DINT;\nEND_VAR\n\nPROGRAM Main LD\n"
	"RUNG\n  | NO Go | COIL Lamp |\n"
	"RUNG\n  | --- | [ Count := Count + 1 ] |\n"
	"RUNG Again\n  | NO Spin | JMP Again |\n"
	"END_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;
static int shown, states;
static char *told;

static void count(int *counter)
{
	(*counter)++;
}

static void keep_told(LadderSim *of, const char *text, gboolean bad)
{
	(void)of;
	g_free(told);
	told = g_strdup_printf("%s%s", bad ? "! " : "", text);
}

static const struct image *image(void)
{
	return &ladder_sim_twin(sim)->resource.image;
}

static gint64 value(const char *name)
{
	return image_get(image(), image_find(image(), name, strlen(name))).i;
}

static void act(enum act_kind kind, const char *name, gint64 to)
{
	ladder_sim_act(sim, &(struct act){ .kind = kind, .value.i = to,
		.at = image_find(image(), name, strlen(name)) });
}

static void open_text(const char *text)
{
	ladder_document_open_text(document, NULL, text, strlen(text), true);
}

static void test_states(void)
{
	const gint64 began_us = g_get_monotonic_time();
	struct sim_lateness late;
	struct sim_cost cost;

	CHECK(!ladder_sim_is_on(sim) && ladder_sim_state(sim) == SIM_OFF);
	CHECK(!ladder_sim_twin(sim) && !ladder_sim_lock_record(sim));
	ladder_sim_run(sim);
	ladder_sim_scan(sim, 3);
	CHECK_AS(ladder_sim_state(sim) == SIM_OFF,
		 "no scan runs while the simulation is off");
	CHECK(!ladder_sim_lateness(sim, &late) && !ladder_sim_cost(sim, &cost));
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(ladder_sim_state(sim) == SIM_STOP && states > 0);
	ladder_sim_scan(sim, 5);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 5);
	CHECK(ladder_sim_state(sim) == SIM_PAUSE && value("Count") == 5);
	CHECK(ladder_sim_twin(sim)->now_ns == 5 * SIM_PERIOD);
	ladder_sim_run(sim);
	CHECK_SOON(value("Count") > 20);
	CHECK(ladder_sim_state(sim) == SIM_RUN);
	ladder_sim_pause(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_PAUSE);
	CHECK_AS(ladder_sim_lateness(sim, &late) &&
		 sim_lateness_scans(&late) == ladder_sim_twin(sim)->scan - 5,
		 "the lateness of each scan in RUN is counted");
	CHECK(sim_lateness_us(&late, 0.5) <= sim_lateness_us(&late, 1));
	CHECK_AS(ladder_sim_cost(sim, &cost) && cost.scans == sim_lateness_scans(&late),
		 "what each of them took is counted");
	CHECK(cost.usual_ns > 0 && cost.usual_ns <= cost.most_ns &&
	      cost.most_ns / 1000 <= g_get_monotonic_time() - began_us);
	ladder_sim_reset(sim, false);
	CHECK_SOON(value("Count") == 0);
	ladder_sim_stop(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_STOP);
}

/* The shown period changes only when it is in effect. */
static void test_period(void)
{
	const gint64 before = ladder_sim_period(sim);
	const int told_states = states;
	struct sim_cost cost;

	CHECK(ladder_sim_cost(sim, &cost));
	ladder_sim_set_period(sim, 2 * before);
	CHECK_AS(states == told_states, "a typed period is not reset before it is in effect");
	CHECK_SOON(states > told_states && ladder_sim_period(sim) == 2 * before);
	CHECK_AS(!ladder_sim_cost(sim, &cost), "the cost is counted anew with another period");
	ladder_sim_set_period(sim, before);
	CHECK_SOON(ladder_sim_period(sim) == before);
}

static void test_acts(void)
{
	const gint64 before = value("Count");

	act(ACT_SET, "Go", 1);
	CHECK_SOON(value("Go") == 1);
	CHECK_AS(value("Lamp") == 0 && value("Count") == before,
		 "an input is set at once, without a scan");
	ladder_sim_scan(sim, 1);
	CHECK_SOON(value("Lamp") == 1);
	act(ACT_SET, "Go", 0);
	act(ACT_FORCE, "Lamp", 1);
	ladder_sim_scan(sim, 2);
	CHECK_SOON(value("Count") == 3);
	CHECK(value("Lamp") == 1 && ladder_sim_forces(sim) == 1);
	CHECK(live_value_is_forced(sim, false, image_find(image(), "Lamp", 4)));
	act(ACT_RELEASE, "Lamp", 0);
	CHECK_SOON(ladder_sim_forces(sim) == 0);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(value("Count") == 4);
	CHECK(value("Lamp") == 0);
}

static void test_past(void)
{
	const guint64 last = ladder_sim_twin(sim)->scan;

	CHECK(last > 3 && ladder_sim_last(sim) == last);
	CHECK(ladder_sim_show(sim, last - 3) && ladder_sim_is_past(sim));
	CHECK(ladder_sim_twin(sim)->scan == last - 3 && value("Lamp") == 1);
	CHECK(!ladder_sim_show(sim, last + 1));
	ladder_sim_show_now(sim);
	CHECK(!ladder_sim_is_past(sim) && value("Lamp") == 0);
	CHECK(ladder_sim_show(sim, last - 1));
	act(ACT_SET, "Go", 1);
	CHECK_AS(!ladder_sim_is_past(sim), "an act shows the present again");
	CHECK_SOON(value("Go") == 1);
}

static void test_chart(void)
{
	struct timing *timing = timing_new(sim);
	bool good = true;

	CHECK(timing_add(timing, "Count") && timing_add(timing, "lamp"));
	CHECK_AS(!timing_add(timing, "COUNT"), "a variable has one line at most");
	CHECK(timing_add(timing, "Nobody"));
	while (timing_feed(timing, 1000000))
		;
	CHECK(timing_first(timing) == ladder_sim_first(sim));
	CHECK(timing_end(timing) == ladder_sim_last(sim) + 1);
	CHECK(timing_at(timing, 2).type == IEC_NONE);
	for (guint64 scan = timing_first(timing); scan < timing_end(timing); scan++) {
		ladder_sim_show(sim, scan);
		good = good && timing_value(timing, 0, scan) == (double)value("Count") &&
		       timing_value(timing, 1, scan) == (double)value("Lamp") &&
		       timing_time(timing, scan) == ladder_sim_twin(sim)->now_ns &&
		       timing_scan_at(timing, timing_time(timing, scan)) == scan;
	}
	CHECK_AS(good, "every scan of the chart has the recorded values");
	ladder_sim_show_now(sim);
	ladder_sim_scan(sim, 30000);
	CHECK_SOON(ladder_sim_twin(sim)->scan > 30000);
	while (timing_feed(timing, 1000000))
		;
	CHECK(timing_end(timing) - timing_first(timing) == TIMING_SCANS);
	CHECK(timing_value(timing, 0, timing_end(timing) - 1) == (double)value("Count"));
	timing_remove(timing, 0);
	CHECK_TEXT(timing_name(timing, 0), "lamp");
	timing_move(timing, 0, 1);
	CHECK_TEXT(timing_name(timing, 1), "lamp");
	timing_free(timing);
}

static void test_fault(void)
{
	g_clear_pointer(&told, g_free);
	act(ACT_SET, "Go", 1);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(value("Lamp") == 1);
	act(ACT_SET, "Spin", 1);
	ladder_sim_run(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_FAULT);
	CHECK(told && strstr(told, "budget") && strstr(told, "rung 3"));
	CHECK(ladder_sim_twin(sim)->resource.fault_at.rung == 3);
	CHECK_AS(value("Lamp") == 0, "outputs are safe in a fault");
	ladder_sim_run(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_RUN);
	CHECK_AS(value("Spin") == 0 && value("Go") == 1,
		 "a start is cold and clears the fault; switches stay");
	ladder_sim_end(sim);
	CHECK(!ladder_sim_twin(sim) && ladder_sim_state(sim) == SIM_OFF);
}

/* An edit while it runs: the rung changes, the values stay. */
static void test_change(void)
{
	gint64 count;
	char *text;

	open_text(sample);
	text = ladder_document_text(document, NULL);
	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_scan(sim, 7);
	CHECK_SOON(value("Count") == 7);
	CHECK(ladder_sim_rung(sim, document, 0, 2) == 2);
	CHECK(ladder_document_replace(document, (gsize)(strstr(text, "RUNG Again") - text), 0,
		"RUNG\n  | NC Go | COIL %QX0.1 |\n", NULL));
	g_free(text);
	count = value("Count");
	g_clear_pointer(&told, g_free);
	CHECK_SOON(ladder_sim_rung(sim, document, 0, 3) == 3 && image_find(image(), "%QX0.1", 6).type !=
	      IEC_NONE && value("Count") == count);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(value("Count") == count + 1);
	CHECK(value("%QX0.1") == 1);
	CHECK_AS(ladder_sim_twin(sim)->scan == 8,
		 "the scan number goes on after an edit");
	CHECK(told && strstr(told, "after scan 7"));
	CHECK(ladder_sim_first(sim) == 0 && ladder_sim_show(sim, 6));
	ladder_sim_show_now(sim);
	ladder_sim_end(sim);
}

/* ---- refused acts ---- */

static gboolean nothing_to_do(gpointer data)
{
	(void)data;
	return G_SOURCE_REMOVE;
}

/* Waits until @count acts were refused. */
static void wait_refused(struct sim_source *source, struct sim_view *view, guint count)
{
	const gint64 until = g_get_monotonic_time() + 10000000;
	bool other;

	do {
		g_usleep(200);
		CHECK(source->take(source, view, &other));
	} while (view->refusal.count != count && g_get_monotonic_time() < until);
	CHECK(view->refusal.count == count);
}

static struct sim_program *program_of(const char *text)
{
	return sim_program_new(g_intern_static_string("test.rung"), text, strlen(text),
			       NULL);
}

/* After an edit, the place of Far belongs to another variable, or to none. */
static void test_stale(void)
{
	static const char other[] =
		"RUNGBOARD 1\n\nVAR\n  Near : INT := 5;\nEND_VAR\n\nPROGRAM Main LD\n"
		"RUNG\n  | --- | [ Near := Near ] |\nEND_PROGRAM\n";
	struct sim_program *old = program_of(sample), *new = program_of(other);
	struct sim_thread *thread = sim_thread_new(old, NULL, SIM_PERIOD, 0, nothing_to_do,
						   NULL);
	struct sim_source *source = sim_thread_source(thread);
	struct sim_view view = { .program = NULL };
	struct act act = { .kind = ACT_SET, .value.i = -1 };
	struct twin before;
	const struct image *image;
	bool is_other;

	CHECK(source->take(source, &view, &is_other) && is_other);
	image = &view.twin.resource.image;
	act.at = image_find(image, "Count", 5);
	source->act(source, old, &act, 1);
	sim_thread_change(thread, new);
	while (view.program != new)
		CHECK(source->take(source, &view, &is_other));
	CHECK_AS(view.refusal.count == 0, "an act before the change is done");
	CHECK(twin_clone(&before, &view.twin));
	source->act(source, old, &act, 1);
	act.kind = ACT_FORCE;
	source->act(source, old, &act, 1);
	wait_refused(source, &view, 2);
	CHECK(view.refusal.why == SIM_REFUSED_STALE && image->force_count == 0);
	CHECK_AS(memcmp(image->memory, before.resource.image.memory,
			view.twin.memory_size) == 0, "a refused act does not change the memory");
	act.at = image_find(image, "Near", 4);
	source->act(source, new, &act, 1);
	source->act(source, NULL, &(struct act){ .kind = ACT_RELEASE }, 1);
	wait_refused(source, &view, 3);
	CHECK(view.refusal.why == SIM_REFUSED_PLACE && image->force_count == 1);
	twin_free(&before);
	sim_view_clear(&view);
	sim_thread_free(thread);
	sim_program_unref(old);
	sim_program_unref(new);
}

static void told_is(const char *word)
{
	CHECK_SOON(told && strstr(told, word));
	g_clear_pointer(&told, g_free);
}

/* Each refusal is reported, also in a new simulation. */
static void test_refused(void)
{
	const struct location nowhere = { .type = IEC_NONE };

	open_text(sample);
	for (int again = 0; again < 2; again++) {
		CHECK(ladder_sim_begin(sim, NULL));
		g_clear_pointer(&told, g_free);
		ladder_sim_act(sim, &(struct act){ .kind = ACT_FORCE, .at = nowhere });
		told_is("Not done: the variable cannot be set or forced");
		for (guint i = 0; i < LIMIT_FORCES; i++)
			ladder_sim_act(sim, &(struct act){ .kind = ACT_FORCE,
				.at = { .type = IEC_BOOL, .area = AREA_M, .where = i } });
		CHECK_SOON(ladder_sim_forces(sim) == LIMIT_FORCES);
		CHECK(!told);
		act(ACT_FORCE, "Count", 7);
		told_is("too many variables are forced already");
		CHECK(ladder_sim_forces(sim) == LIMIT_FORCES && value("Count") == 0);
		ladder_sim_end(sim);
	}
}

/* As on a board, a division by zero is no fault; its place is reported once for each start. */
static void test_failed(void)
{
	open_text("RUNGBOARD 1\n\nVAR\n  Parts, Minutes, Rate : INT := 1;\nEND_VAR\n\n"
		  "PROGRAM Main LD\nRUNG\n  | --- | [ Parts := Parts ] |\n"
		  "RUNG\n  | --- | [ Rate := Parts / Minutes ] |\nEND_PROGRAM\n");
	CHECK(ladder_sim_begin(sim, NULL));
	for (int again = 0; again < 2; again++) {
		ladder_sim_scan(sim, 2);
		g_clear_pointer(&told, g_free);
		act(ACT_SET, "Minutes", 0);
		CHECK_SOON(value("Minutes") == 0 && !told);
		ladder_sim_scan(sim, 2);
		told_is("division by zero: Main, rung 2, row 1, column B");
		CHECK(ladder_sim_state(sim) == SIM_PAUSE);
		ladder_sim_scan(sim, 2);
		CHECK_SOON(ladder_sim_twin(sim)->resource.vm.errors == 4);
		CHECK(!told);
		ladder_sim_reset(sim, false);
		CHECK_SOON(ladder_sim_twin(sim)->resource.vm.errors == 0);
	}
	ladder_sim_end(sim);
}

/* By default the first failed operation of a start is a FAULT, with outputs off until it
 * continues. In single scans, or if switched off, it is not. */
static void test_heeds(void)
{
	GArray *acts = g_array_new(FALSE, FALSE, sizeof(struct sim_played));

	open_text("RUNGBOARD 1\n\nVAR\n  Parts, Minutes, Rate : INT;\n  Lamp AT %QX0.0 : BOOL;\n"
		  "END_VAR\n\nPROGRAM Main LD\n"
		  "RUNG\n  | --- | COIL Lamp |\n"
		  "RUNG\n  | --- | [ Rate := Parts / Minutes ] |\nEND_PROGRAM\n");
	CHECK(ladder_sim_begin(sim, NULL) && ladder_sim_fault_on_error(sim));
	for (int again = 0; again < 20; again++) {
		ladder_sim_run(sim);
		told_is("! FAULT: an operation failed");
		CHECK_SOON(ladder_sim_state(sim) == SIM_FAULT);
		CHECK(ladder_sim_twin(sim)->resource.vm.errors == 1);
		CHECK_AS(value("Lamp") == 0, "outputs are off in a FAULT");
		ladder_sim_reset(sim, again % 2);
		CHECK_SOON(ladder_sim_state(sim) == SIM_PAUSE);
	}
	ladder_sim_run(sim);
	told_is("! FAULT");
	CHECK_SOON(ladder_sim_state(sim) == SIM_FAULT);
	CHECK(ladder_sim_show(sim, ladder_sim_last(sim)) && value("Lamp") == 1);
	ladder_sim_show_now(sim);
	CHECK(value("Lamp") == 0);
	ladder_sim_run(sim);
	CHECK_SOON(ladder_sim_twin(sim)->resource.vm.errors > 3);
	CHECK_AS(!told && ladder_sim_state(sim) == SIM_RUN,
		 "the simulation continues without another report");
	CHECK_AS(value("Lamp") == 1,
		 "the outputs of the program are back when it continues");
	ladder_sim_stop(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_STOP);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(told && g_str_has_prefix(told, "ENO is FALSE"));
	g_clear_pointer(&told, g_free);
	CHECK(ladder_sim_play(sim, SIM_PERIOD, 0, acts, 5, NULL));
	CHECK_SOON(told && g_str_has_prefix(told, "ENO is FALSE"));
	CHECK_SOON(ladder_sim_twin(sim)->scan == 5);
	g_clear_pointer(&told, g_free);
	ladder_sim_set_fault_on_error(sim, false);
	ladder_sim_reset(sim, false);
	ladder_sim_run(sim);
	CHECK_SOON(told && g_str_has_prefix(told, "ENO is FALSE"));
	CHECK_SOON(ladder_sim_twin(sim)->resource.vm.errors > 3);
	CHECK(ladder_sim_state(sim) == SIM_RUN);
	ladder_sim_set_fault_on_error(sim, true);
	ladder_sim_end(sim);
	g_array_unref(acts);
}

/* A start that fails at once is reported each time. */
static void test_fault_again(void)
{
	open_text("RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG Again\n  | --- | JMP Again |\n"
		  "END_PROGRAM\n");
	CHECK(ladder_sim_begin(sim, NULL));
	for (int again = 0; again < 5; again++) {
		g_clear_pointer(&told, g_free);
		ladder_sim_run(sim);
		told_is("! instruction budget of the scan exceeded (a loop?): Main, rung 1");
		CHECK(ladder_sim_state(sim) == SIM_FAULT);
	}
	ladder_sim_end(sim);
}

/* An error of a plant is reported with file and place. */
static void test_bad_plant(void)
{
	GError *error = NULL;
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *path = g_build_filename(folder, "bad.plant.rung", NULL);

	CHECK(g_file_set_contents(path, "RUNGBOARD 1\n\nPROGRAM World LD\nRUNG\n"
		"  | --- | COIL %QX0.0 |\nRUNG\n  | NO Nobody | COIL %QX0.1 |\n"
		"END_PROGRAM\n", -1, NULL));
	CHECK(!ladder_sim_set_plant(sim, path, &error));
	CHECK(error && g_str_has_prefix(error->message, path) &&
	      strstr(error->message, "World, rung 2, row 1, column A: \"Nobody\" is not declared"));
	g_clear_error(&error);
	CHECK(g_unlink(path) == 0 && g_rmdir(folder) == 0);
	g_free(path);
	g_free(folder);
}

/* Forces of the plant are counted, and released with the others. */
static void test_plant_forces(void)
{
	struct act act = { .kind = ACT_FORCE, .plant = true, .value.r = 50 };
	const struct image *plant;
	GError *error = NULL;

	CHECK(ladder_document_open(document, "ladders/tank-level.rung", NULL));
	CHECK(ladder_sim_set_plant(sim, "ladders/tank-level.plant.rung", &error));
	CHECK(ladder_sim_begin(sim, NULL));
	plant = &ladder_sim_twin(sim)->plant.image;
	act.at = image_find(plant, "Level", 5);
	CHECK(act.at.type == IEC_REAL);
	ladder_sim_act(sim, &act);
	CHECK_SOON(ladder_sim_forces(sim) == 1);
	act.plant = false;
	act.value.i = 1;
	act.at = image_find(image(), "%IX0.7", 6);
	ladder_sim_act(sim, &act);
	CHECK_SOON(ladder_sim_forces(sim) == 2);
	g_clear_pointer(&told, g_free);
	ladder_sim_release_all(sim);
	CHECK_SOON(ladder_sim_forces(sim) == 0);
	ladder_sim_end(sim);
	CHECK(ladder_sim_set_plant(sim, NULL, NULL));
	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_release_all(sim);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 1);
	CHECK_AS(!told, "without a plant releasing all forces is not refused");
	ladder_sim_end(sim);
}

static void test_errors(void)
{
	GError *error = NULL;

	open_text("RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO Nobody | COIL %QX0.0 |\n"
		  "END_PROGRAM\n");
	CHECK(!ladder_sim_begin(sim, &error) && error && strstr(error->message, "Nobody"));
	CHECK(ladder_document_diags(document)->errors == 1 && !ladder_sim_is_on(sim));
	g_clear_error(&error);
	open_text("no rung file\n");
	CHECK(!ladder_sim_begin(sim, &error) && error);
	g_clear_error(&error);
	CHECK(!ladder_sim_set_plant(sim, "/nowhere/plant.rung", &error) && error);
	g_clear_error(&error);
}

int main(void)
{
	document = ladder_document_new();
	open_text(sample);
	sim = ladder_sim_new(document);
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(count), &shown);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(count), &states);
	g_signal_connect(sim, "told", G_CALLBACK(keep_told), NULL);
	test_states();
	test_period();
	test_acts();
	test_past();
	test_chart();
	test_fault();
	test_change();
	test_stale();
	test_refused();
	test_failed();
	test_heeds();
	test_fault_again();
	test_bad_plant();
	test_plant_forces();
	test_errors();
	CHECK(shown > 0);
	g_object_unref(sim);
	g_object_unref(document);
	g_free(told);
	return tap_done();
}
