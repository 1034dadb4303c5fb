/* SPDX-License-Identifier: MIT
 *
 * test_place - the column that is shown for a cell: on sheets, in charts, for missing
 * cells; and the part of a chart for a line.
 */
#include "editor-gtk/draw/place.h"

#include "engine/ladder.h"
#include "tests/tap.h"

#include <glib.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
	"RUNG\n  | NO %IX0.0 | NO %IX0.1 | NO %IX0.2 | NO %IX0.3 | NO %IX0.4 |"
	" NO %IX0.5 | NO %IX0.6 | COIL %QX0.1 |\n"
	"RUNG\n  | NO %IX0.0 | [ %MW0 := 1 ] |\nEND_PROGRAM\n\n"
	"PROGRAM Chart SFC\n  INITIAL_STEP A:\n    Act(N);\n  END_STEP\n"
	"  STEP B:\n  END_STEP\n  TRANSITION FROM A TO B := %IX0.0; END_TRANSITION\n"
	"  TRANSITION Back FROM B TO A := %IX0.1; END_TRANSITION\n"
	"  CONTROL(RESET := %IX0.7);\n"
	"  ACTION Act:\n  RUNG\n    | NO %IX0.2 | COIL %QX0.2 |\n  END_ACTION\n"
	"END_PROGRAM\n";

static void test_letters(void)
{
	char out[PLACE_LETTERS];

	CHECK_TEXT(place_column(0, out), "A");
	CHECK_TEXT(place_column(25, out), "Z");
	CHECK_TEXT(place_column(26, out), "AA");
	CHECK_TEXT(place_column(LIMIT_COLS - 1, out), "BL");
}

static void test_shown(const struct project *project)
{
	struct place_sheet sheet = { 0 };
	const int last = project->pou[1].rung_count - 1;

	CHECK_AS(place_shown(&sheet, project, 0, 0, 0, 1) == 7, "a coil is shown in the last column");
	CHECK_AS(place_shown(&sheet, project, 0, 0, 0, 0) == 0, "a contact is shown in its own column");
	CHECK(place_shown(&sheet, project, 0, 1, 0, 7) == 7);
	CHECK_AS(place_shown(&sheet, project, 1, last, 0, 1) == 5,
		 "a body of a chart has its own columns");
	CHECK(place_shown(&sheet, project, 0, 0, 0, 1) == 7);
}

static void check_line(const struct project *project, int pou, int row, const char *told)
{
	char *place = place_line(project, pou, row);

	CHECK_TEXT(place, told);
	g_free(place);
}

static void check_rung(const struct project *project, int pou, int rung, const char *told,
		       bool alone)
{
	bool whole;
	char *place = place_rung(project, pou, rung, &whole);

	CHECK_TEXT(place, told);
	CHECK(whole == alone);
	g_free(place);
}

static void check_cell(const struct project *project, int pou, int rung, int row, int col,
		       const char *told)
{
	struct place_sheet sheet = { 0 };
	char *place = place_cell(&sheet, project, pou, rung, row, col);

	CHECK_TEXT(place, told);
	g_free(place);
}

/* The column is that of the sheet, not of the file. */
static void test_cells(const struct project *project)
{
	check_cell(project, 0, 0, 0, 1, "Main, rung 1, row 1, column H");
	check_cell(project, 0, 2, -1, -1, "Main, rung 3");
	check_cell(project, 1, 0, 0, 0, "Chart, transition A \xe2\x86\x92 B");
}

/* Each rung of the file is a place that a person sees. */
static void test_rungs(const struct project *project)
{
	check_rung(project, 0, 1, "Main", false);
	check_rung(project, 1, 0, "Chart, transition A \xe2\x86\x92 B", true);
	check_rung(project, 1, 1, "Chart, transition Back", true);
	check_rung(project, 1, project->pou[1].rung_count - 1, "Chart, action Act", false);
}

/* In a chart the place is a step or transition, no line. */
static void test_lines(const struct project *project)
{
	check_line(project, 0, 2, "Main, line 3");
	check_line(project, 1, 0, "Chart");
	check_line(project, 1, 1, "Chart, step A");
	check_line(project, 1, 2, "Chart, step A");
	check_line(project, 1, 4, "Chart, step B");
	check_line(project, 1, 6, "Chart, transition A \xe2\x86\x92 B");
	check_line(project, 1, 7, "Chart, transition Back");
	check_line(project, 1, 8, "Chart, CONTROL");
	check_line(project, 1, 10, "Chart, action Act");
}

static void test_nowhere(const struct project *project)
{
	struct place_sheet sheet = { 0 };

	CHECK(place_shown(&sheet, project, 0, 9, 0, 1) == 1);
	CHECK(place_shown(&sheet, project, 9, 0, 0, 1) == 1);
	CHECK(place_shown(&sheet, project, -1, -1, -1, 8) == 8);
	CHECK(place_shown(&sheet, project, 0, 0, 0, 99) == 99);
	CHECK(place_shown(&sheet, project, 0, 0, 5, 1) == 1);
	CHECK(place_shown(&sheet, NULL, 0, 0, -1, -1) == -1);
}

int main(void)
{
	struct ladder *ladder = ladder_new();
	const struct project *project;

	CHECK(ladder && ladder_load_text(ladder, "test", sample, sizeof(sample) - 1));
	project = ladder_project(ladder);
	test_letters();
	if (project && project->pou_count == 2) {
		test_shown(project);
		test_lines(project);
		test_rungs(project);
		test_cells(project);
		test_nowhere(project);
	}
	CHECK(project && project->pou_count == 2);
	ladder_free(ladder);
	return tap_done();
}
