/* SPDX-License-Identifier: MIT
 *
 * test_sim - a simulation beside the window: it runs, stands, is stepped, acted upon, shows
 * any scan that was; errors keep it off, faults stop it. A chart of it has every scan.
 */
#include "editor-gtk/chart.h"
#include "tests/tap.h"

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

/* Waits for at most ten seconds. */
#define UNTIL(condition) do { \
	const gint64 until = g_get_monotonic_time() + 10000000; \
	while (!(condition) && g_get_monotonic_time() < until) \
		if (!g_main_context_iteration(NULL, FALSE)) \
			g_usleep(200); \
	CHECK_AS(condition, #condition); \
} while (0)

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
	CHECK(!ladder_sim_is_on(sim) && ladder_sim_state(sim) == SIM_OFF);
	CHECK(!ladder_sim_twin(sim) && !ladder_sim_lock_record(sim));
	ladder_sim_run(sim);
	ladder_sim_scan(sim, 3);
	CHECK_AS(ladder_sim_state(sim) == SIM_OFF, "nothing runs while it is off");
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(ladder_sim_state(sim) == SIM_STOP && states > 0);
	ladder_sim_scan(sim, 5);
	UNTIL(ladder_sim_twin(sim)->scan == 5);
	CHECK(ladder_sim_state(sim) == SIM_PAUSE && value("Count") == 5);
	CHECK(ladder_sim_twin(sim)->now_ns == 5 * SIM_PERIOD);
	ladder_sim_run(sim);
	UNTIL(value("Count") > 20);
	CHECK(ladder_sim_state(sim) == SIM_RUN);
	ladder_sim_pause(sim);
	UNTIL(ladder_sim_state(sim) == SIM_PAUSE);
	ladder_sim_reset(sim, false);
	UNTIL(value("Count") == 0);
	ladder_sim_stop(sim);
	UNTIL(ladder_sim_state(sim) == SIM_STOP);
}

static void test_acts(void)
{
	const gint64 before = value("Count");

	act(ACT_SET, "Go", 1);
	UNTIL(value("Go") == 1);
	CHECK_AS(value("Lamp") == 0 && value("Count") == before, "at once, without a scan");
	ladder_sim_scan(sim, 1);
	UNTIL(value("Lamp") == 1);
	act(ACT_SET, "Go", 0);
	act(ACT_FORCE, "Lamp", 1);
	ladder_sim_scan(sim, 2);
	UNTIL(value("Count") == 3);
	CHECK(value("Lamp") == 1 && ladder_sim_forces(sim) == 1);
	CHECK(ladder_sim_is_forced(sim, image_find(image(), "Lamp", 4)));
	act(ACT_RELEASE, "Lamp", 0);
	UNTIL(ladder_sim_forces(sim) == 0);
	ladder_sim_scan(sim, 1);
	UNTIL(value("Count") == 4);
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
	CHECK_AS(!ladder_sim_is_past(sim), "an act ends the look at the past");
	UNTIL(value("Go") == 1);
}

static void test_chart(void)
{
	struct chart *chart = chart_new(sim);
	bool good = true;

	CHECK(chart_add(chart, "Count") && chart_add(chart, "lamp"));
	CHECK_AS(!chart_add(chart, "COUNT"), "one line a variable");
	CHECK(chart_add(chart, "Nobody"));
	while (chart_feed(chart, 1000000))
		;
	CHECK(chart_first(chart) == ladder_sim_first(sim));
	CHECK(chart_end(chart) == ladder_sim_last(sim) + 1);
	CHECK(chart_at(chart, 2).type == IEC_NONE);
	for (guint64 scan = chart_first(chart); scan < chart_end(chart); scan++) {
		ladder_sim_show(sim, scan);
		good = good && chart_value(chart, 0, scan) == (double)value("Count") &&
		       chart_value(chart, 1, scan) == (double)value("Lamp") &&
		       chart_time(chart, scan) == ladder_sim_twin(sim)->now_ns &&
		       chart_scan_at(chart, chart_time(chart, scan)) == scan;
	}
	CHECK_AS(good, "every scan of the chart is what the scan was");
	ladder_sim_show_now(sim);
	ladder_sim_scan(sim, 30000);
	UNTIL(ladder_sim_twin(sim)->scan > 30000);
	while (chart_feed(chart, 1000000))
		;
	CHECK(chart_end(chart) - chart_first(chart) == CHART_SCANS);
	CHECK(chart_value(chart, 0, chart_end(chart) - 1) == (double)value("Count"));
	chart_remove(chart, 0);
	CHECK_TEXT(chart_name(chart, 0), "lamp");
	chart_move(chart, 0, 1);
	CHECK_TEXT(chart_name(chart, 1), "lamp");
	chart_free(chart);
}

static void test_fault(void)
{
	g_clear_pointer(&told, g_free);
	act(ACT_SET, "Go", 1);
	ladder_sim_scan(sim, 1);
	UNTIL(value("Lamp") == 1);
	act(ACT_SET, "Spin", 1);
	ladder_sim_run(sim);
	UNTIL(ladder_sim_state(sim) == SIM_FAULT);
	CHECK(told && strstr(told, "budget") && strstr(told, "rung 3"));
	CHECK(ladder_sim_twin(sim)->resource.fault_at.rung == 3);
	CHECK_AS(value("Lamp") == 0, "outputs are safe in a fault");
	ladder_sim_run(sim);
	UNTIL(ladder_sim_state(sim) == SIM_RUN);
	CHECK_AS(value("Spin") == 0 && value("Go") == 1,
		 "a start is cold and clears the fault; switches stay");
	ladder_sim_end(sim);
	CHECK(!ladder_sim_twin(sim) && ladder_sim_state(sim) == SIM_OFF);
}

/* An edit while it runs: another rung, the values of before. */
static void test_change(void)
{
	gint64 count;
	char *text;

	open_text(sample);
	text = ladder_document_text(document, NULL);
	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_scan(sim, 7);
	UNTIL(value("Count") == 7);
	CHECK(ladder_sim_rung(sim, 0, 2) == 2);
	CHECK(ladder_document_replace(document, (gsize)(strstr(text, "RUNG Again") - text), 0,
		"RUNG\n  | NC Go | COIL %QX0.1 |\n", NULL));
	g_free(text);
	count = value("Count");
	UNTIL(ladder_sim_rung(sim, 0, 3) == 3 && image_find(image(), "%QX0.1", 6).type !=
	      IEC_NONE && value("Count") == count);
	ladder_sim_scan(sim, 1);
	UNTIL(value("Count") == count + 1);
	CHECK(value("%QX0.1") == 1);
	CHECK_AS(ladder_sim_twin(sim)->scan == 8, "scans go on");
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
	test_acts();
	test_past();
	test_chart();
	test_fault();
	test_change();
	test_errors();
	CHECK(shown > 0);
	g_object_unref(sim);
	g_object_unref(document);
	g_free(told);
	return tap_done();
}
