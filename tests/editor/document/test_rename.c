/* SPDX-License-Identifier: MIT
 *
 * test_rename - a symbol, program, step or label gets another name in the project, its scenarios,
 * its plants and its charts, in one step. No display.
 */
#include "editor-gtk/document/rename.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/document/symbols.h"

#include "tests/editor/texts.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <string.h>

static const char PROGRAM[] =
	"RUNGBOARD 1\n\n"
	"TYPE\n  Recipe : STRUCT\n    Speed : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n"
	"  Start AT %IX0.0 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL;\n"
	"  Within : INT;\n"
	"  Unused AT %IX0.5 : BOOL;\n"
	"  Table : ARRAY[1..4] OF Recipe;\n"
	"END_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\nEND_VAR\n"
	"RUNG\n  | NO Start | TON Delay PT:=T#1s | COIL Motor |\n"
	"RUNG\n  | [ Table[Within].Speed > 3 ] | COIL %QX0.1 |\n"
	"END_PROGRAM\n\n"
	"PROGRAM Chart SFC\n INITIAL_STEP Idle:\n END_STEP\n\n"
	" TRANSITION FROM Idle TO Idle := Start; END_TRANSITION\nEND_PROGRAM\n";

static const char PLANT[] =
	"RUNGBOARD 1\n(* Motor turns the belt. *)\n\n"
	"VAR\n"
	"  Motor  AT  %IX0.0 : BOOL;\n"
	"  Start AT %QX0.0 : BOOL;\n"
	"  Within AT %QX0.7 : BOOL;\n"
	"END_VAR\n\n"
	"PROGRAM Line LD\nRUNG \"Motor\"\n  | NO Motor | COIL %QX0.3 |\nEND_PROGRAM\n";

static const char SCENARIO[] =
	"# Motor follows Start\n"
	"plant \"pump.plant.rung\"\n"
	"scenario \"Motor\"\n"
	"  at 0ms start = 1, Within = 2, Main.Delay.PT = T#5s\n"
	"  at 10ms expect Motor = 0, not (plant.Motor) and Delay.Q = 0\n"
	"  within 10ms expect Within = 2\n"
	"  always Table[Within].Speed < 5 // Motor\n"
	"  for 2s expect Within > 1\n"
	"  at 2s expect Chart.Idle.X and Idle.T < 1s\n"
	"  at 3s Table[2].Speed = 3, Unused = 1\n";

static char *folder, *program, *scenario, *plant;
static LadderDocument *document;
static GPtrArray *opened;

static void file_opened(LadderDocument *of, LadderSideFile *file)
{
	(void)of;
	g_ptr_array_add(opened, g_object_ref(file));
}

static void start_with(const char *text)
{
	CHECK(g_file_set_contents(program, text, -1, NULL));
	CHECK(g_file_set_contents(scenario, SCENARIO, -1, NULL));
	CHECK(g_file_set_contents(plant, PLANT, -1, NULL));
	document = ladder_document_new();
	opened = g_ptr_array_new_with_free_func(g_object_unref);
	g_signal_connect(document, "file-opened", G_CALLBACK(file_opened), NULL);
	CHECK(ladder_document_open(document, program, NULL));
}

static void start(void)
{
	start_with(PROGRAM);
}

static void end(void)
{
	g_ptr_array_unref(opened);
	g_object_unref(document);
}

/* @text with the first @count pairs of texts exchanged, one place each. */
static char *with(const char *text, const char *const *pairs)
{
	GString *out = g_string_new(text);

	for (; *pairs; pairs += 2)
		CHECK_AS(g_string_replace(out, pairs[0], pairs[1], 1) == 1, pairs[0]);
	return g_string_free(out, FALSE);
}

static bool holds(const char *path, const char *want)
{
	LadderSideFile *file = side_file_find(document, path);
	char *text = file ? ladder_side_file_text(file) : NULL;
	const bool same = file ? strcmp(text, want) == 0 : false;

	if (text && !same)
		printf("# %s\n", text);
	g_free(text);
	return same;
}

static struct xref_target target_of(int table, const char *name)
{
	struct project *project = ladder_document_project(document);
	const struct var_table *vars = xref_table(project, table);

	for (int i = 0; i < vars->count; i++)
		if (strcmp(project_text(project, vars->var[i].name), name) == 0)
			return xref_variable(project, table, i);
	CHECK_AS(false, name);
	return (struct xref_target){ 0 };
}

static bool rename_to(const struct xref_target *target, const char *name, int want)
{
	char *why = NULL;
	int places = 0;
	const bool good = rename_everywhere(document, target, name, "Rename", &places, &why);

	CHECK_AS(!good || places == want, name);
	if (good && places != want)
		printf("# %d places\n", places);
	CHECK(good == !why);
	g_free(why);
	return good;
}

/* A variable that the plant has on the other side: listed, changed, undone, redone. */
static void test_output(void)
{
	static const char *const in_scenario[] = { "expect Motor", "expect Pump", "plant.Motor",
						   "plant.Pump", NULL };
	static const char *const in_plant[] = { "  Motor  AT", "  Pump  AT", "NO Motor",
						"NO Pump", NULL };
	struct xref_target target;
	GPtrArray *files;
	char *why = NULL, *text, *other;

	start();
	target = target_of(0, "Motor");
	files = rename_files(document, &target, NULL, &why);
	CHECK_AS(files && files->len == 2,
		 "the changed files are listed before the rename");
	for (guint i = 0; files && i < files->len; i++)
		CHECK(((struct rename_file *)files->pdata[i])->places == 2);
	CHECK(opened->len == 0);
	g_ptr_array_unref(files);
	CHECK(rename_to(&target, "Pump", 2 + 2 + 2));
	text = with(SCENARIO, in_scenario);
	other = with(PLANT, in_plant);
	CHECK_AS(opened->len == 2 && document_has(document, "COIL Pump") && !document_has(document, "Motor"), "the program changes");
	CHECK_AS(holds(scenario, text), "the scenario changes");
	CHECK_AS(holds(plant, other), "only the name changes in the plant");
	CHECK_AS(ladder_document_undo(document) && document_has(document, "COIL Motor") &&
		 holds(scenario, SCENARIO) && holds(plant, PLANT), "one undo restores all files");
	CHECK(!ladder_document_undo_name(document));
	CHECK_AS(ladder_document_redo(document) && holds(scenario, text) && holds(plant, other) &&
		 opened->len == 2, "redo changes all files");
	g_free(other);
	g_free(text);
	end();
}

static void renames(int table, const char *from, const char *to, int places,
		    const char *const *pairs)
{
	struct xref_target target;
	char *text;

	start();
	target = target_of(table, from);
	CHECK(rename_to(&target, to, places));
	text = with(SCENARIO, pairs);
	CHECK_AS(holds(scenario, text), from);
	CHECK_AS(!side_file_find(document, plant), "the plant has nothing to change");
	g_free(text);
	end();
}

static void test_kinds(void)
{
	static const char *const local[] = { "Main.Delay.PT", "Main.Wait.PT", "and Delay.Q",
					     "and Wait.Q", NULL };
	static const char *const word[] = { ", Within = 2", ", Row = 2", "expect Within", "expect Row",
					    "Table[Within]", "Table[Row]",
					    "2s expect Within", "2s expect Row", NULL };
	static const char *const member[] = { "Table[Within].Speed", "Table[Within].Rate",
					      "Table[2].Speed", "Table[2].Rate", NULL };
	static const char *const step[] = { "Chart.Idle", "Chart.Rest", "and Idle.T", "and Rest.T",
					    NULL };
	static const char *const pou[] = { "Main.Delay", "Line.Delay", NULL };
	const struct xref_target target = { .what = XREF_POU, .index = 0 };
	char *text;

	renames(1, "Delay", "Wait", 2 + 2, local);
	renames(0, "Within", "Row", 2 + 4, word);
	renames(3, "Speed", "Rate", 2 + 2, member);
	start();
	CHECK(rename_to(&(struct xref_target){ .what = XREF_STEP, .table = 2 }, "Rest", 3 + 2));
	text = with(SCENARIO, step);
	CHECK_AS(holds(scenario, text), "a step");
	g_free(text);
	end();
	start();
	CHECK(rename_to(&target, "Line", 1 + 1));
	text = with(SCENARIO, pou);
	CHECK_AS(holds(scenario, text), "a program");
	g_free(text);
	end();
}

/* A new name in the table of symbols renames everywhere, also in scenarios. */
static void test_symbols(void)
{
	static const char *const pairs[] = { "Unused = 1", "Spare = 1", NULL };
	char *text = with(SCENARIO, pairs);

	start();
	CHECK(symbol_set(document, 0, target_of(0, "Unused").index, FIELD_NAME, "Spare", NULL));
	CHECK_AS(holds(scenario, text), "the scenario follows the table of symbols");
	g_free(text);
	end();
}

/* A rename uses the text of an open file, not the saved one. */
static void test_open(void)
{
	struct xref_target target;
	LadderSideFile *file;

	start();
	target = target_of(0, "Motor");
	file = ladder_side_file_open(scenario, document, NULL);
	ladder_side_file_set(file, "scenario \"a\"\n  expect Motor\n");
	CHECK(rename_to(&target, "Pump", 2 + 1 + 2));
	CHECK_AS(holds(scenario, "scenario \"a\"\n  expect Pump\n"), "an open file keeps its edits");
	CHECK(opened->len == 1);
	g_object_unref(file);
	end();
}

static void test_refused(void)
{
	struct xref_target target;
	char *why;

	start();
	target = target_of(0, "Motor");
	why = rename_refusal(document, &target, "Pump_2");
	CHECK(!why);
	CHECK(g_file_set_contents(plant, "RUNGBOARD 1\nVAR\n  Motor AT %IX0.0 : BOOL;\n"
		"  Pump : BOOL;\nEND_VAR\nPROGRAM Line LD\nRUNG\nEND_PROGRAM\n", -1, NULL));
	why = rename_refusal(document, &target, "Pump");
	CHECK_AS(why && strstr(why, "pump.plant.rung"), "a plant that has the name refuses it");
	CHECK_AS(!rename_to(&target, "Pump", 0) && document_has(document, "COIL Motor") && opened->len == 0,
		 "a refused rename changes nothing");
	g_free(why);
	end();
}

/* Two scenarios with different plants: both plants get the new name. */
static void test_plants(void)
{
	char *second = g_build_filename(folder, "pump_2.scn", NULL);
	char *other = g_build_filename(folder, "other.plant.rung", NULL);
	static const char TEXT[] = "plant \"other.plant.rung\"\nscenario \"b\"\n"
				   "  expect Motor and plant.Motor\n";
	static const char *const both[] = { "and plant.Motor", "and plant.Pump", "expect Motor",
					    "expect Pump", NULL };
	static const char *const in_plant[] = { "  Motor  AT", "  Pump  AT", "NO Motor",
						"NO Pump", NULL };
	struct xref_target target;
	GPtrArray *files;
	char *why = NULL, *text = with(TEXT, both), *changed = with(PLANT, in_plant);

	start();
	CHECK(g_file_set_contents(second, TEXT, -1, NULL));
	CHECK(g_file_set_contents(other, PLANT, -1, NULL));
	target = target_of(0, "Motor");
	files = rename_files(document, &target, NULL, &why);
	CHECK_AS(files && files->len == 4, "two scenarios and two plants are listed");
	g_ptr_array_unref(files);
	CHECK(rename_to(&target, "Pump", 2 + 2 * 2 + 2 * 2));
	CHECK_AS(holds(second, text) && holds(other, changed) && holds(plant, changed),
		 "both plants change");
	CHECK(ladder_document_undo(document));
	CHECK_AS(holds(second, TEXT) && holds(other, PLANT) && holds(plant, PLANT),
		 "one undo restores both plants");
	end();
	g_unlink(second);
	g_unlink(other);
	g_free(second);
	g_free(other);
	g_free(text);
	g_free(changed);
}

/* Names in status charts and timing charts. Comments of a chart stay. */
static void test_charts(void)
{
	static const char VIEW[] = "\nVIEW\n  bookmark Main 1\n  status-chart Motor\n"
		"    watch auto MOTOR Motor of the belt\n    watch hex Main.Delay.ET\n"
		"    watch auto plant.Motor\n    watch auto Table[Within].Speed\n"
		"  timing Motor\n  timing Delay.Q\n  timing %QX0.0\nEND_VIEW\n";
	static const char *const motor[] = { "auto MOTOR Motor", "auto Pump Motor", "plant.Motor",
					     "plant.Pump", "timing Motor", "timing Pump", NULL };
	static const char *const delay[] = { "Main.Delay.ET", "Main.Wait.ET", "timing Delay.Q",
					     "timing Wait.Q", NULL };
	char *whole = g_strconcat(PROGRAM, VIEW, NULL);
	char *view, *text = with(VIEW, motor), *local;
	struct xref_target target;
	GPtrArray *files;
	char *why = NULL;
	bool listed = false;

	start_with(whole);
	view = g_strdup(ladder_document_view(document));
	target = target_of(0, "Motor");
	files = rename_files(document, &target, NULL, &why);
	for (guint i = 0; files && i < files->len; i++) {
		const struct rename_file *file = files->pdata[i];

		listed |= !file->path && file->places == 3;
	}
	CHECK_AS(listed, "the changed charts are listed before the rename");
	g_ptr_array_unref(files);
	CHECK(rename_to(&target, "Pump", 2 + 2 + 2 + 3));
	CHECK_AS(strstr(text, ladder_document_view(document)), "the charts change");
	CHECK(ladder_document_undo(document));
	CHECK_AS(strcmp(ladder_document_view(document), view) == 0 && document_has(document, "COIL Motor"),
		 "one undo restores the charts");
	target = target_of(1, "Delay");
	CHECK(rename_to(&target, "Wait", 2 + 2 + 2));
	local = with(VIEW, delay);
	CHECK_AS(strstr(local, ladder_document_view(document)),
		 "a local variable is renamed in charts");
	g_free(local);
	g_free(text);
	g_free(view);
	g_free(whole);
	end();
}

/* A label: its rung and its jumps. */
static void test_label(void)
{
	struct xref xref = { 0 };
	int found = -1;

	start_with("RUNGBOARD 1\n\nPROGRAM Main LD\n"
		   "RUNG\n  | NO I0 | JMP Past |\nRUNG\n  | NO I1 | COIL Q0 |\n"
		   "RUNG Past\n  | NO I2 | COIL Q1 |\nEND_PROGRAM\n");
	CHECK(xref_make(&xref, ladder_document_project(document)));
	for (int i = 0; i < xref.count; i++)
		if (xref.use[i].target.what == XREF_LABEL && xref.use[i].kind == XREF_DECLARED)
			found = i;
	CHECK(found >= 0 && rename_to(&xref.use[found].target, "Behind", 2));
	CHECK_AS(document_has(document, "JMP Behind") && document_has(document, "RUNG Behind"),
		 "a label is renamed at its rung and its jump");
	xref_free(&xref);
	end();
}

int main(void)
{
	folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	program = g_build_filename(folder, "pump.rung", NULL);
	scenario = g_build_filename(folder, "pump.scn", NULL);
	plant = g_build_filename(folder, "pump.plant.rung", NULL);
	test_output();
	test_kinds();
	test_symbols();
	test_open();
	test_refused();
	test_plants();
	test_charts();
	test_label();
	g_unlink(program);
	g_unlink(scenario);
	g_unlink(plant);
	g_rmdir(folder);
	g_free(plant);
	g_free(scenario);
	g_free(program);
	g_free(folder);
	return tap_done();
}
