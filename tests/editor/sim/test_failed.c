/* SPDX-License-Identifier: MIT
 *
 * test_failed - a cell is marked while its operation fails, and not if power ends there for
 * another reason.
 */
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/sim/sim.h"
#include "tests/tap.h"

#include <string.h>

static uint8_t failed_at(LadderSim *of, int rung)
{
	const struct project *project = ladder_project(ladder_sim_ladder(of));
	const struct resource *resource = &ladder_sim_twin(of)->resource;
	struct live_map *map = live_map_new(resource, "Main", NULL);
	struct live_rung *live = live_rung_new(map, project, project->pou[0].rung[rung], rung);
	uint8_t bits = 0;

	live_rung_look(live, resource, 0, false);
	for (int i = 0; i < live->rows * live->cols; i++)
		bits |= live->bits[i];
	live_rung_free(live);
	live_map_free(map);
	return bits & LIVE_FAILED;
}

static void test_failed(void)
{
	static const char text[] =
		"RUNGBOARD 1\nVAR\n  A : INT := 12;\n  B : INT;\n  Rest : INT;\n  Q : BOOL;\n"
		"END_VAR\nPROGRAM Main LD\n"
		"RUNG\n  | DIV IN1:=A IN2:=B OUT=>Rest | COIL Q |\n"
		"RUNG\n  | --- | [ Rest := A / B ] |\n"
		"RUNG\n  | GT IN1:=B IN2:=A | COIL Q |\n"
		"RUNG\n  | [ B > 100 ] | COIL Q |\n"
		"RUNG\n  | NO Q | DIV IN1:=A IN2:=B OUT=>Rest |\nEND_PROGRAM\n";
	LadderDocument *of = ladder_document_new();
	LadderSim *divides = ladder_sim_new(of);
	struct act act = { .kind = ACT_SET, .value.i = 3 };
	const gint64 end = g_get_monotonic_time() + 30 * G_USEC_PER_SEC;

	ladder_document_open_text(of, NULL, text, strlen(text), true);
	CHECK(ladder_sim_begin(divides, NULL));
	ladder_sim_scan(divides, 1);
	while (ladder_sim_twin(divides)->scan < 1 && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, FALSE);
	CHECK(failed_at(divides, 0) && failed_at(divides, 1));
	CHECK_AS(!failed_at(divides, 2) && !failed_at(divides, 3) && !failed_at(divides, 4),
		 "a false comparison and an element that does not run are not failures");
	act.at = image_find(&ladder_sim_twin(divides)->resource.image, "B", 1);
	ladder_sim_act(divides, &act);
	ladder_sim_scan(divides, 1);
	while (ladder_sim_twin(divides)->scan < 2 && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, FALSE);
	CHECK(!failed_at(divides, 0) && !failed_at(divides, 1));
	g_object_unref(divides);
	g_object_unref(of);
}

int main(void)
{
	test_failed();
	return tap_done();
}
