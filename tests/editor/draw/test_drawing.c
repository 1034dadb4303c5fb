/* SPDX-License-Identifier: MIT
 *
 * test_drawing - every word of the catalogue and every sample is drawn without overlaps,
 * with the fonts of this machine and without fonts.
 */
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib.h>
#include <stdlib.h>

/* ---- every word ---- */

static uint32_t name_id(struct project *project, const char *text)
{
	return *text ? names_intern(&project->names, text, strlen(text)) : 0;
}

/* A value at every pin; a long one in two of @seed's three cases. */
static char *all_args(const struct word_row *row, int seed)
{
	GString *out = g_string_new(NULL);

	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		const char *value = seed ? "ANameThatIsRatherLong.Member" : "X";

		if (pin->dir == PIN_IN)
			g_string_append_printf(out, "%s:=%s%s ", pin->name,
					       i % 2 && seed ? "/" : "", value);
		else if (pin->dir == PIN_OUT)
			g_string_append_printf(out, "%s=>%s ", pin->name, value);
	}
	return g_string_free(out, FALSE);
}

static const char *operand_of(const struct word_row *row, int seed)
{
	switch (row->operand) {
	case OPND_BOOL_R:
	case OPND_BOOL_W:
	case OPND_ANY_R:
	case OPND_ANY_W:
		return seed == 0 ? "X" : seed == 1 ? "启动按钮" :
		       "ThisNameIsMuchTooLongForAnyCellOfALadderDiagramIsItNot";
	case OPND_INSTANCE:
		return seed ? "InstanceWithAVeryLongNameIndeed" : "T1";
	case OPND_EXPR:
		return seed == 0 ? "a > b" : seed == 1 ?
		       "Level * 3 + Count > 1000 AND Level < 20000 OR Count = 5 AND A" :
		       "Level * 3 + Count > 1000 AND Level < 20000 OR Count = 5 AND "
		       "Level <> 17 AND Count < 12345 OR Level = Count AND NOT Stopped "
		       "AND NOT (Level + 1 = Count) OR Level > 3 AND Level < 7 AND X AND "
		       "ANameThatIsSoLongThatItTakesALineOfItsOwnAndAPartOfTheNextOne2 AND "
		       "Y AND (this OR that) AND so AND on AND on AND on AND on AND on";
	case OPND_ASSIGN:
		return "Count := Count + 1";
	case OPND_LOOP:
		return "i := 1 TO 10";
	case OPND_LABEL:
	case OPND_ROUTINE:
	case OPND_EXECUTE:
		return seed ? "ALabelThatSaysALot" : "L1";
	case OPND_NONE:
	case OPND_LOOP_END:
	case OPND_PIN:
		return "";
	}
	return "";
}

/* The word three times: alone, beside itself, and below itself. */
static struct rung *rung_of(struct project *project, const struct word_row *row,
			    uint16_t word, int seed)
{
	struct rung *rung = rung_new(2, 3);
	char *args = all_args(row, seed);
	struct cell cell = { .word = word };

	cell.operand = name_id(project, row->kind == WORD_FB && seed ?
			       "InstanceWithAVeryLongNameIndeed" :
			       row->kind == WORD_FB ? "T1" : operand_of(row, seed));
	if (row->kind != WORD_ELEM)
		cell.args = name_id(project, args);
	g_free(args);
	cell.comment = name_id(project, seed ? "(* a comment that is not short *)" : "");
	*rung_cell(rung, 0, 0) = cell;
	*rung_cell(rung, 1, 0) = cell;
	rung_cell(rung, 1, 0)->link = 1;
	if (row->place != PLACE_LAST)
		*rung_cell(rung, 0, 1) = cell;
	else
		rung_cell(rung, 1, 0)->link = 0;
	return rung;
}

static int word_faults(struct project *project, struct lettering *lettering, int word)
{
	const struct word_row *row = word_row(word);
	struct grid_names *names = grid_names_new(project, NULL);
	struct drafting drafting = { .project = project, .names = names,
				     .lettering = lettering };
	int faults = 0;

	for (int seed = 0; seed < 3; seed++) {
		struct rung *rung = rung_of(project, row, (uint16_t)word, seed);
		struct rung_layout *layout = rung_layout_new(&drafting, rung, 1, 0);
		struct grid_scene scene = { .drafting = &drafting, .layout = layout,
					    .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
		struct picture picture;

		picture_init(&picture);
		grid_draw(&scene, &picture);
		faults += drawn_faults(&picture, rung_layout_width(layout), layout->height,
				       explain_id(row));
		picture_clear(&picture);
		rung_layout_free(layout);
		rung_free(rung);
	}
	grid_names_free(names);
	return faults;
}

/* An icon is drawn with strokes, inside its bounds. */
static int icon_faults(struct lettering *lettering, int word)
{
	struct picture picture;
	int faults = 0;

	picture_init(&picture);
	grid_draw_icon(word_row(word), theme_get(THEME_DARK, THEME_BLUE), lettering, 64, 32,
		       &picture);
	for (int i = 0; i < picture.count; i++)
		faults += picture.stroke[i].x < -0.5f || picture.stroke[i].x > 64.5f ||
			  picture.stroke[i].y < -0.5f || picture.stroke[i].y > 32.5f;
	faults += picture.count == 0;
	if (faults)
		printf("# icon of %s: %d\n", explain_id(word_row(word)), faults);
	picture_clear(&picture);
	return faults;
}

static void check_words(struct lettering *lettering, const char *fonts)
{
	struct ladder *ladder = drawn_load("words.rung", "RUNGBOARD 1\n");
	int faults = 0, icons = 0, words = 0;

	for (int word = ELEM_EMPTY + 1; word < WORD_COUNT; word++) {
		if (word == ELEM_PIN || word == WORD_CORE)
			continue;
		words++;
		faults += word_faults(ladder_project(ladder), lettering, word);
		icons += icon_faults(lettering, word);
	}
	printf("# %d words, %s\n", words, fonts);
	CHECK(words > 100);
	CHECK_AS(faults == 0, "no word overlaps another part");
	CHECK_AS(icons == 0, "every word has an icon");
	ladder_free(ladder);
}

/* ---- samples ---- */

static int sample_faults(struct lettering *lettering, const char *path, int *rungs)
{
	struct ladder *ladder = drawn_load(path, NULL);
	int faults = 0;

	if (!ladder)
		return 1;
	struct project *project = ladder_project(ladder);
	for (int p = 0; p < project->pou_count; p++)
		for (int way = 0; way < 4; way++) {
			struct sheet *sheet = sheet_new(project, &project->pou[p],
							lettering);
			sheet->drafting.show = way % 3;
			sheet->drafting.comments = way == 3;
			sheet->drafting.width = way == 2 ? 1500 : 0;
			sheet_layout(sheet);
			faults += drawn_sheet(sheet, false, path);
			faults += drawn_sheet(sheet, true, path);
			*rungs += sheet->count;
			for (int i = 1; i < sheet->count; i++)
				faults += sheet->rung[i]->right != sheet->rung[0]->right;
			sheet_free(sheet);
		}
	ladder_free(ladder);
	return faults;
}

static void check_samples(struct lettering *lettering)
{
	GDir *folder = g_dir_open("ladders", 0, NULL);
	int faults = 0, rungs = 0;

	for (const char *name; folder && (name = g_dir_read_name(folder));) {
		char *path = g_build_filename("ladders", name, NULL);

		if (g_str_has_suffix(name, ".rung"))
			faults += sample_faults(lettering, path, &rungs);
		g_free(path);
	}
	if (folder)
		g_dir_close(folder);
	CHECK(rungs > 400);
	CHECK_AS(faults == 0, "the drawings of the samples have no overlaps");
}

/* ---- hostile files ---- */

static uint32_t random_seed = 1;

static int random_below(int count)
{
	random_seed = random_seed * 1664525u + 1013904223u;
	return (int)((random_seed >> 8) % (uint32_t)count);
}

static struct rung *random_rung(struct project *project)
{
	static const char *const text[] = {
		"", "", "X", "启动", "%QX0.0", "Line.OUT", "PT:=T#5s Q=>X", "R:=/Stop CV=>X",
		"(* a *)", "(* (* *)", "a := b", "\xff\x01", "A:=", "=> X", "IN1:='a $' b'",
	};
	struct rung *rung = rung_new(1 + random_below(12), 1 + random_below(12));

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		struct cell *cell = &rung->cell[i];
		int kind = random_below(4);

		cell->word = (uint16_t)(kind == 0 ? ELEM_EMPTY : kind == 1 ? ELEM_PIN :
					kind == 2 ? random_below(ELEM_PIN) :
					random_below(WORD_COUNT + 3));
		cell->link = (uint8_t)(random_below(3) == 0);
		cell->operand = name_id(project, text[random_below(15)]);
		cell->args = name_id(project, text[random_below(15)]);
		cell->comment = name_id(project, text[random_below(15)]);
	}
	rung->title = name_id(project, text[random_below(15)]);
	rung->comment = name_id(project, text[random_below(15)]);
	rung->label = name_id(project, text[random_below(15)]);
	rung->off = (uint8_t)(random_below(8) == 0);
	return rung;
}

/* Draws it, and hits every point. */
static int poke_rung(const struct drafting *drafting, const struct rung *rung)
{
	struct rung_layout *layout = rung_layout_new(drafting, rung, 1, random_below(14));
	uint8_t cell[12 * 12];
	struct grid_live live = { cell, drawn_value, NULL };
	struct grid_mark mark = { random_below(14), random_below(14), 0x3ff };
	struct grid_scene scene = { .drafting = drafting, .layout = layout, .live = &live,
				    .theme = theme_get(THEME_DARK, THEME_BLUE),
				    .mark = &mark, .mark_count = 1 };
	struct picture picture;
	int bad = 0;

	memset(cell, random_below(32), sizeof(cell));
	picture_init(&picture);
	grid_draw(&scene, &picture);
	for (int i = 0; i < picture.count; i++)
		bad += !(picture.stroke[i].x > -1e4f && picture.stroke[i].y < 1e5f);
	picture_clear(&picture);
	for (float y = 0; y < layout->height; y += 17)
		for (float x = 0; x < layout->right + 9; x += 23) {
			struct rung_hit hit = rung_layout_hit(drafting, layout, x, y);

			bad += hit.row < 0 || hit.row >= layout->rows || hit.column < 0 ||
			       hit.column >= layout->columns;
		}
	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++)
			bad += rung_layout_col(layout, row,
				rung_layout_column(layout, row, col)) > rung->cols;
	rung_layout_free(layout);
	return bad;
}

static void check_random(struct lettering *lettering)
{
	struct ladder *ladder = drawn_load("random.rung", "RUNGBOARD 1\n");
	struct project *project = ladder_project(ladder);
	struct grid_names *names = grid_names_new(project, NULL);
	struct drafting drafting = { .project = project, .names = names,
				     .lettering = lettering };
	int bad = 0;

	for (int i = 0; i < 1000; i++) {
		struct rung *rung = random_rung(project);

		drafting.show = random_below(3);
		drafting.comments = random_below(2);
		drafting.all_comments = random_below(2);
		bad += poke_rung(&drafting, rung);
		rung_free(rung);
	}
	CHECK(bad == 0);
	grid_names_free(names);
	ladder_free(ladder);
}

/* ---- boxes of an import ---- */

static bool has_text(const struct picture *picture, const char *text)
{
	for (int i = 0; i < picture->count; i++)
		if (picture->stroke[i].text && strcmp(picture->stroke[i].text, text) == 0)
			return true;
	return false;
}

/* A box shows the values of its declaration, and no input that a person does not set. */
static void check_declared(struct lettering *lettering)
{
	static const char text[] = "RUNGBOARD 1\nVAR\n  T0 : CL_TON := (P := 20, BASE := T#100ms);\n"
		"  T1 : CL_TOF := (P := 7, FAITHFUL := TRUE);\n  T2 : TON := (PT := T#3s);\nEND_VAR\n"
		"PROGRAM Main LD\nRUNG\n| NO %IX0.0 | CL_TON T0 DT:=SYS_CYCLE | TON T2 | COIL %QX0.0 |\n"
		"RUNG\n| NO %IX0.0 | CL_TOF T1 DT:=SYS_CYCLE | COIL %QX0.1 |\nEND_PROGRAM\n";
	struct ladder *ladder = drawn_load("declared", text);
	struct sheet *sheet = ladder ? sheet_new(ladder_project(ladder),
						 &ladder_project(ladder)->pou[0], lettering) : NULL;

	if (!CHECK(sheet))
		return;
	sheet_layout(sheet);
	for (int i = 0; i < sheet->count; i++) {
		struct grid_scene scene = { .drafting = &sheet->drafting, .layout = sheet->rung[i],
					    .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
		struct picture picture;

		picture_init(&picture);
		grid_draw(&scene, &picture);
		CHECK(has_text(&picture, i ? "7" : "20"));
		CHECK(i || (has_text(&picture, "T#100ms") && has_text(&picture, "T#3s")));
		CHECK(!has_text(&picture, "DT") && !has_text(&picture, "SYS_CYCLE"));
		CHECK(has_text(&picture, "FAITHFUL") == (i == 1));
		picture_clear(&picture);
	}
	sheet_free(sheet);
	ladder_free(ladder);
}

int main(void)
{
	PangoContext *context = lettering_context();
	struct lettering *real = lettering_new(context, NULL);
	struct lettering *rule = lettering_new(NULL, NULL);

	check_words(rule, "without fonts");
	check_words(real, "with fonts");
	check_samples(rule);
	check_samples(real);
	check_random(rule);
	check_declared(rule);
	lettering_free(real);
	lettering_free(rule);
	g_object_unref(context);
	return tap_done();
}
