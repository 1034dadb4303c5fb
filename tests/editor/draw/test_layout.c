/* SPDX-License-Identifier: MIT
 *
 * test_layout - places of a rung's parts, the part at a point, and the cost of a change.
 */
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/draw/rung_box.h"
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib.h>

static struct lettering *lettering;

static struct sheet *sheet_of_file(struct ladder *ladder, int pou)
{
	struct project *project = ladder_project(ladder);
	struct sheet *sheet = sheet_new(project, &project->pou[pou], lettering);

	sheet_layout(sheet);
	return sheet;
}

static enum rung_part part_at(const struct sheet *sheet, int rung, float x, float y)
{
	return rung_layout_hit(&sheet->drafting, sheet->rung[rung], x, y).part;
}

/* The middle of every cell hits it, and so do its corners. */
static int missed_cells(const struct sheet *sheet)
{
	int missed = 0;

	for (int i = 0; i < sheet->count; i++) {
		const struct rung_layout *layout = sheet->rung[i];

		for (int row = 0; row < layout->rows; row++)
			for (int d = 0; d < layout->columns; d++) {
				graphene_rect_t r = rung_layout_cell(layout, row, d);
				float x = r.origin.x + r.size.width / 2;
				struct rung_hit hit = rung_layout_hit(&sheet->drafting,
					layout, x, layout->row[row].y + 3);

				missed += hit.part == RUNG_PART_NONE || hit.column != d ||
					  hit.row > row;
				missed += r.origin.x < RUNG_LEFT - 1 ||
					  r.origin.x + r.size.width > layout->right + 1 ||
					  r.origin.y + r.size.height > layout->height;
			}
	}
	return missed;
}

/* Columns of a row do not overlap, also when stretched. */
static int bad_columns(const struct sheet *sheet)
{
	int bad = 0;

	for (int i = 0; i < sheet->count; i++)
		for (int d = 1; d < sheet->rung[i]->columns; d++)
			bad += sheet->rung[i]->column_x[d] + 0.01f <
			       sheet->rung[i]->column_x[d - 1] +
			       sheet->rung[i]->column_width[d - 1];
	return bad;
}

static void check_simple(const struct sheet *sheet)
{
	const struct rung_layout *layout = sheet->rung[0];

	CHECK(layout->columns == RUNG_LEAST_COLUMNS);
	CHECK((int)layout->column_width[0] == RUNG_CELL_WIDTH);
	CHECK((int)layout->row[0].height == RUNG_CELL_HEIGHT);
	CHECK(rung_layout_column(layout, 0, 2) == layout->columns - 1);
	CHECK(rung_layout_col(layout, 0, layout->columns - 1) == 2);
	CHECK(rung_layout_col(layout, 0, 3) == -1);
	CHECK(rung_layout_wired(layout, 0, 3));
	CHECK(!rung_layout_wired(layout, 1, 3));
	CHECK(rung_layout_column(layout, 1, 0) == 0);
	float y = layout->row[0].wire, x = layout->column_x[3] + 40;
	CHECK(part_at(sheet, 0, x, y + 2) == RUNG_PART_WIRE);
	CHECK(part_at(sheet, 0, x, y + 20) == RUNG_PART_CELL);
	CHECK(part_at(sheet, 0, layout->column_x[1], y + 40) == RUNG_PART_LINK);
	CHECK(part_at(sheet, 0, 10, 20) == RUNG_PART_NUMBER);
	CHECK(part_at(sheet, 0, 200, 20) == RUNG_PART_TITLE);
	CHECK(part_at(sheet, 0, layout->right + 10, y) == RUNG_PART_NONE);
	CHECK(part_at(sheet, 0, -1, y) == RUNG_PART_NONE);
	CHECK(part_at(sheet, 0, x, layout->height + 1) == RUNG_PART_NONE);
	struct rung_hit hit = rung_layout_hit(&sheet->drafting, layout,
					      layout->column_x[1], y + 40);
	CHECK(hit.row == 1 && hit.column == 0);
}

static bool begins(const struct sheet *sheet, const struct rung_layout *layout, float x,
		   float y, int row, int bar)
{
	int found_row = -1, found_bar = -1;

	return rung_layout_end(&sheet->drafting, layout, x, y, &found_row, &found_bar) &&
	       found_row == row && found_bar == bar;
}

/* A drag begins a wire beside an element, on a wire, and at free ends. */
static void check_ends(const struct sheet *sheet)
{
	const struct rung_layout *layout = sheet->rung[0];
	const float wire = layout->row[0].wire, x = layout->column_x[0];
	const float width = layout->column_width[0], last = layout->right;
	int row, bar;

	CHECK(begins(sheet, layout, x + 8, wire, 0, 0));
	CHECK(begins(sheet, layout, x + width - 8, wire + 5, 0, 1));
	CHECK(!begins(sheet, layout, x + width / 2, wire, 0, 0));
	CHECK(!begins(sheet, layout, x + width - 8, wire + 20, 0, 1));
	CHECK(!begins(sheet, layout, last - 2, wire, 0, layout->columns - 1));
	CHECK(!begins(sheet, layout, last + 10, wire, 0, layout->columns - 1));
	/* The lower end of the link to the branch below. */
	CHECK(begins(sheet, layout, x + width, layout->row[1].wire - 20, 1, 1));
	/* A free cell: only at its end. */
	CHECK(begins(sheet, layout, layout->column_x[3], layout->row[1].wire, 1, 3));
	CHECK(!begins(sheet, layout, layout->column_x[3] + 40, layout->row[1].wire, 1, 3));
	/* A box: left and right of it, in its first row. */
	layout = sheet->rung[3];
	graphene_rect_t box = rung_layout_cell(layout, 0, 1);
	CHECK(begins(sheet, layout, box.origin.x + 3, layout->row[0].wire, 0, 1));
	CHECK(!begins(sheet, layout, box.origin.x + box.size.width / 2,
		      layout->row[0].wire, 0, 1));
	CHECK(begins(sheet, layout, box.origin.x + box.size.width - 3,
		     layout->row[0].wire, 0, 2));
	rung_layout_nearest(layout, box.origin.x + box.size.width * 0.8f, layout->height + 40, &row, &bar);
	CHECK(row == layout->rows && bar == 2);
}

/* Rung 4 of the shapes has a timer in column 1: PT below IN, ET below Q. */
static void check_box(const struct sheet *sheet)
{
	const struct rung_layout *layout = sheet->rung[3];
	struct rung_box box;
	graphene_rect_t cell = rung_layout_cell(layout, 0, 1);

	rung_box_make(&sheet->drafting, layout->rung, 0, 1, &box);
	rung_box_place(&box, layout->row, layout->column_x[1], layout->column_width[1]);
	CHECK(box.x > cell.origin.x && box.x + box.inner < cell.origin.x + cell.size.width);
	CHECK(layout->row[0].wire + box.bottom < layout->row[0].y + layout->row[0].height);
	struct rung_hit hit = rung_layout_hit(&sheet->drafting, layout, box.x - 20,
					      layout->row[0].wire + BOX_LINE);
	CHECK(hit.part == RUNG_PART_PIN && !hit.output && hit.column == 1);
	CHECK(hit.pin == 1 && !strncmp(box.in.pin[1].name, "PT", 2));
	hit = rung_layout_hit(&sheet->drafting, layout, box.x + box.inner + 20,
			      layout->row[0].wire + BOX_LINE);
	CHECK(hit.part == RUNG_PART_PIN && hit.output);
	CHECK(!strncmp(box.out.pin[hit.pin].name, "ET", 2));
	/* A box with a pin row is one cell to the cursor. */
	layout = sheet->rung[4];
	graphene_rect_t first = rung_layout_cell(layout, 0, 1);
	graphene_rect_t second = rung_layout_cell(layout, 1, 1);
	CHECK(graphene_rect_equal(&first, &second));
	CHECK(first.size.height > 2 * RUNG_CELL_HEIGHT);
	/* Cells beside it have the usual height. */
	CHECK(layout->row[1].height > RUNG_CELL_HEIGHT + 40);
	CHECK((int)rung_layout_cell(layout, 1, 0).size.height == RUNG_CELL_HEIGHT);
}

/* Rows below the rung, for a cursor that goes there. */
static void check_more_rows(const struct sheet *sheet)
{
	struct rung_layout *layout = rung_layout_new(&sheet->drafting,
						     sheet->pou->rung[0], 1, 5);

	CHECK(layout->rows == 5);
	CHECK(rung_layout_col(layout, 4, 0) == -1);
	CHECK(!rung_layout_wired(layout, 4, 0));
	CHECK(layout->row[4].y > layout->row[1].y + RUNG_CELL_HEIGHT);
	rung_layout_free(layout);
}

/* Rungs are below one another, with one right rail. */
static void check_sheet(struct sheet *sheet)
{
	int bad = 0;

	for (int i = 0; i < sheet->count; i++) {
		bad += sheet->rung[i]->right != sheet->rung[0]->right;
		bad += sheet->y[i] + sheet->rung[i]->height != sheet->y[i + 1];
		bad += sheet->rung[i]->number != i + 1;
	}
	CHECK(bad == 0);
	CHECK(sheet->height == sheet->y[sheet->count]);
	float rails = sheet->rails;
	sheet->drafting.width = rails + 300;
	sheet_layout(sheet);
	CHECK(sheet->rails == rails + 300);
	CHECK(sheet->rung[0]->column_x[5] > sheet->rung[0]->column_x[4] + 300);
}

static void check_clipping(void)
{
	struct lettered whole = lettering_fit(lettering, LETTER_SYMBOL, "Motor", -1, 200);
	struct lettered cut = lettering_fit(lettering, LETTER_SYMBOL,
					    "a rather long name", -1, 60);
	struct lettered part = lettering_fit(lettering, LETTER_SYMBOL, "Motor.Q", 5, 0);
	struct lettered odd = lettering_fit(lettering, LETTER_SYMBOL, "a\x01\xff\x80z",
					    -1, 0);

	CHECK_TEXT(whole.text, "Motor");
	CHECK_TEXT(part.text, "Motor");
	CHECK(cut.width <= 60 && g_str_has_suffix(cut.text, "\xe2\x80\xa6"));
	CHECK(g_utf8_validate(odd.text, -1, NULL) && !strchr(odd.text, 1));
	/* A combining mark stays with its letter at any width. */
	for (float bound = 1; bound < 60; bound++) {
		const char *text = lettering_fit(lettering, LETTER_SYMBOL,
			"e\xcc\x81" "e\xcc\x81" "e\xcc\x81" "e\xcc\x81", -1, bound).text;

		if (strstr(text, "e\xe2\x80\xa6"))
			CHECK_AS(false, "a letter keeps its accent when a text is cut");
	}
}

/* ---- names of boxes ---- */

#define LONG_BOX "Delay_of_the_northern_pump"
#define LONG_PIN "Preset_of_the_delay_between_first_and_second"

/* The text of the only rung that begins with @begin; NULL: none. */
static const struct stroke *stroke_of(const struct picture *picture, const char *begin)
{
	for (int i = 0; i < picture->count; i++)
		if (picture->stroke[i].kind == STROKE_TEXT &&
		    g_str_has_prefix(picture->stroke[i].text, begin))
			return &picture->stroke[i];
	return NULL;
}

/* The name of a box is in its column, so that a rung can be folded beside it, whatever is
 * connected on one side. */
static void check_box_name(struct sheet *sheet, bool paper)
{
	sheet->drafting.all_comments = paper;
	sheet_layout(sheet);
	const struct rung_layout *layout = sheet->rung[0];
	const struct grid_scene scene = { .drafting = &sheet->drafting, .layout = layout,
					  .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
	const float left = layout->column_x[0], right = left + layout->column_width[0];
	struct picture picture;

	picture_init(&picture);
	grid_draw(&scene, &picture);
	CHECK(drawn_faults(&picture, rung_layout_width(layout), layout->height, "box") == 0);
	const struct stroke *name = stroke_of(&picture, "Delay");
	const struct stroke *pin = stroke_of(&picture, "Preset");
	if (CHECK(name && pin)) {
		CHECK(name->x >= left && name->x + name->w <= right);
		CHECK(pin->x >= left && pin->x + pin->w <= right);
		CHECK(!paper || strcmp(name->text, LONG_BOX) == 0);
		CHECK((strcmp(pin->text, LONG_PIN) == 0) == paper);
	}
	picture_clear(&picture);
}

static void check_box_names(void)
{
	struct ladder *ladder = drawn_load("box.rung", "RUNGBOARD 1\n\nPROGRAM Main LD\nVAR\n"
		"  " LONG_BOX " : TON;\n  " LONG_PIN " : TIME;\nEND_VAR\nRUNG\n"
		"  | TON " LONG_BOX " PT:=" LONG_PIN " | NO %IX0.0 | COIL %QX0.0 |\n"
		"END_PROGRAM\n");

	if (!CHECK(ladder))
		return;
	struct sheet *sheet = sheet_of_file(ladder, 0);
	check_box_name(sheet, false);
	check_box_name(sheet, true);
	sheet_free(sheet);
	ladder_free(ladder);
}

static void check_comments(void)
{
	static const struct { const char *comment, *text; } cases[] = {
		{ "", "" }, { "(**)", "" }, { "// one", "one" }, { "(* one *)", "one" },
		{ "(* one\r\n\t two *)", "one two" }, { "(* one *)\n(* two *)", "one two" },
		{ "// one (* still one\n// two", "one (* still one two" },
		{ "(* see http://x *)\n// two", "see http://x two" },
		{ "(* \xe7\x94\xb5\xe6\x9c\xba *)", "\xe7\x94\xb5\xe6\x9c\xba" },
		{ "(* not closed", "not closed" },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(cases); i++) {
		char *text = comment_text(cases[i].comment);

		CHECK_TEXT(text, cases[i].text);
		g_free(text);
	}
}

/* Does a line at @x cut the strokes of the element in cell (row, col)? */
static bool cuts(const struct sheet *sheet, const struct rung_layout *layout, int row, int col,
		 float x)
{
	const struct word_row *word = word_row(rung_at(layout->rung, row, col)->word);
	const int d = rung_layout_column(layout, row, col);
	const float middle = layout->column_x[d] + layout->column_width[d] / 2;
	struct rung_box box;

	if (d == layout->columns - 1 || rung_at(layout->rung, row, col)->word == ELEM_EMPTY || word->place == PLACE_WIRE ||
	    word->place == PLACE_PIN)
		return false;
	if (word->kind == WORD_ELEM)
		return x > middle - RUNG_HALF && x < middle + RUNG_HALF;
	rung_box_at(&sheet->drafting, layout, row, col, &box);
	return x > box.x + 1 && x < box.x + box.inner - 1;
}

static int cut_elements(const struct sheet *sheet, const struct rung_layout *layout, float x)
{
	const struct rung *rung = layout->rung;
	int cut = 0;

	for (int i = 0; i < rung->rows * rung->cols; i++)
		cut += cuts(sheet, layout, i / rung->cols, i % rung->cols, x);
	return cut;
}

/* A line from top to bottom that hides what is right of it cuts no element, wherever it begins. */
static void check_whole(const struct sheet *sheet)
{
	int cut = 0, moved = 0, bad = 0;

	for (int i = 0; i < sheet->count; i++)
		for (float x = RUNG_LEFT; x < sheet->rung[i]->right; x += 3) {
			struct rung_layout *layout = sheet->rung[i];
			const float at = rung_layout_whole(&sheet->drafting, layout, x);

			cut += cut_elements(sheet, layout, at);
			moved += at < x;
			bad += at > x || rung_layout_whole(&sheet->drafting, layout, at) != at ||
			       (at < x && cut_elements(sheet, layout, x) == 0 &&
				x - at > RUNG_CELL_WIDTH * 4);
		}
	CHECK_AS(cut == 0 && bad == 0 && moved > 100, "no element is cut at the edge of what is shown");
}

/* Nothing is measured again for the same place, until the columns have moved. */
static void check_kept(const struct sheet *sheet)
{
	int kept = 0, stale = 0;

	for (int i = 0; i < sheet->count; i++) {
		struct rung_layout *layout = sheet->rung[i];
		const float x = layout->column_x[layout->columns - 1] - RUNG_CELL_WIDTH / 2;
		const float width = rung_layout_width(layout), at = rung_layout_whole(&sheet->drafting, layout, x);

		layout->whole = -7;
		kept += rung_layout_whole(&sheet->drafting, layout, x) == -7;
		rung_layout_stretch(layout, width);
		stale += rung_layout_whole(&sheet->drafting, layout, x) == -7 || at > x;
	}
	CHECK_AS(kept == sheet->count && kept > 0 && stale == 0, "the edge of a rung is measured once, and again when its columns move");
}

int main(void)
{
	check_comments();
	lettering = lettering_new(NULL, NULL);
	check_box_names();
	struct ladder *ladder = drawn_load("tests/editor/drawing/shapes.rung", NULL);
	if (!CHECK(ladder))
		return tap_done();
	struct sheet *sheet = sheet_of_file(ladder, 0);
	check_simple(sheet);
	check_ends(sheet);
	check_box(sheet);
	check_more_rows(sheet);
	CHECK(missed_cells(sheet) == 0);
	CHECK(bad_columns(sheet) == 0);
	check_sheet(sheet);
	check_whole(sheet);
	check_kept(sheet);
	check_clipping();
	sheet_free(sheet);
	ladder_free(ladder);
	lettering_free(lettering);
	return tap_done();
}
