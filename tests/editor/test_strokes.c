/* SPDX-License-Identifier: MIT
 *
 * test_strokes - drawings, stroke by stroke, against tests/editor/drawing/. Measured by
 * rule and not with fonts, so that they are the same on every machine.
 *
 * With --bless the files are written anew; read the difference.
 */
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib.h>

#define FOLDER "tests/editor/drawing/"

static bool bless;

static void compare(const struct picture *picture, const char *name)
{
	char *path = g_strdup_printf(FOLDER "%s.strokes", name);
	char *got = picture_lines(picture), *want = NULL;

	if (bless)
		g_file_set_contents(path, got, -1, NULL);
	g_file_get_contents(path, &want, NULL, NULL);
	if (!CHECK_AS(want && strcmp(got, want) == 0, name) && want) {
		char **is = g_strsplit(got, "\n", -1), **was = g_strsplit(want, "\n", -1);

		for (int i = 0; is[i] && was[i]; i++)
			if (strcmp(is[i], was[i]) != 0) {
				printf("# line %d: %s\n#   wanted: %s\n", i + 1, is[i],
				       was[i]);
				break;
			}
		g_strfreev(is);
		g_strfreev(was);
	}
	g_free(path);
	g_free(got);
	g_free(want);
}

static void draw(struct sheet *sheet, int index, struct grid_scene scene, const char *name)
{
	struct picture picture;

	scene.drafting = &sheet->drafting;
	scene.layout = sheet->rung[index];
	scene.theme = theme_get(THEME_LIGHT, THEME_GREEN);
	picture_init(&picture);
	grid_draw(&scene, &picture);
	compare(&picture, name);
	picture_clear(&picture);
}

static bool value_of(void *context, int row, int col, struct live_value *out)
{
	(void)context;
	if (col != 1)
		return false;
	snprintf(out->text, sizeof(out->text), "%d.%d s", row, col);
	out->part = 0.64f;
	return true;
}

/* Start is open, Motor holds itself, Stop is closed: power comes round below. */
static void draw_live(struct sheet *sheet)
{
	const struct rung *rung = sheet->pou->rung[0];
	uint8_t cell[64] = { 0 };
	struct grid_live live = { cell, value_of, NULL };

	cell[0] = LIVE_KNOWN | LIVE_IN;
	cell[1] = LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED;
	cell[2] = LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED;
	cell[rung->cols] = LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED;
	draw(sheet, 0, (struct grid_scene){ .live = &live }, "live");
	memset(cell, 0, sizeof(cell)); /* edited since */
	draw(sheet, 0, (struct grid_scene){ .live = &live }, "unknown");
	cell[1] = LIVE_CLOSED; /* in STOP nothing has power, not even the rail */
	draw(sheet, 0, (struct grid_scene){ .live = &live, .state = RUNG_STILL }, "still");
	cell[0] = cell[1] = LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED | LIVE_FRESH;
	cell[2] = cell[3] = LIVE_KNOWN;
	draw(sheet, 3, (struct grid_scene){ .live = &live }, "timer");
}

static void draw_marks(struct sheet *sheet)
{
	static const struct grid_mark mark[] = {
		{ 0, 0, MARK_ERROR | MARK_FORCED }, { 0, 1, MARK_CURSOR },
		{ 0, 2, MARK_DROP }, { 0, 3, MARK_SELECTED | MARK_WARNING },
		{ 0, 5, MARK_TWICE }, { 1, 0, MARK_FOUND | MARK_CHANGED },
		{ 1, 4, MARK_ILLEGAL }, { 7, 0, MARK_CURSOR }, { 0, 70, MARK_ERROR },
	};
	struct grid_scene scene = { .mark = mark, .mark_count = G_N_ELEMENTS(mark),
				    .state = RUNG_CURRENT | RUNG_EDITED };

	draw(sheet, 0, scene, "marks");
}

static const char *note_of(void *context, int row, int column)
{
	(void)context;
	return row == 0 && column == 0 ? "must be on" : NULL;
}

/* With a note, without one, below a value; a box; at its side a force. */
static void draw_blockers(struct sheet *sheet)
{
	static const struct grid_mark mark[] = {
		{ 0, 0, MARK_BLOCKS }, { 1, 0, MARK_BLOCKS | MARK_FORCED },
	};
	static const struct grid_mark box[] = { { 0, 1, MARK_BLOCKS } };
	uint8_t cell[64];
	struct grid_live live = { cell, value_of, NULL };
	struct grid_scene scene = { .live = &live, .mark = mark, .note = note_of,
				    .mark_count = G_N_ELEMENTS(mark) };

	memset(cell, LIVE_KNOWN, sizeof(cell));
	draw(sheet, 0, scene, "blocks");
	scene.mark = box;
	scene.mark_count = G_N_ELEMENTS(box);
	draw(sheet, 3, scene, "blocks-box");
}

static char *reference_of(void *context, int row, int col)
{
	(void)context;
	(void)col;
	return row == 1 ? NULL : g_strdup("read in Main 3, 5");
}

int main(int argc, char **argv)
{
	struct lettering *lettering = lettering_new(NULL, NULL);
	struct ladder *ladder = drawn_load(FOLDER "shapes.rung", NULL);

	bless = argc > 1 && strcmp(argv[1], "--bless") == 0;
	if (!CHECK(ladder))
		return tap_done();
	struct project *project = ladder_project(ladder);
	struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);
	sheet_layout(sheet);
	for (int i = 0; i < sheet->count; i++) {
		char name[24];

		snprintf(name, sizeof(name), "rung-%d", i + 1);
		draw(sheet, i, (struct grid_scene){ 0 }, name);
	}
	draw_live(sheet);
	draw_marks(sheet);
	draw_blockers(sheet);
	draw(sheet, 0, (struct grid_scene){ .state = RUNG_NO_GUTTER,
					    .reference = reference_of }, "paper");
	draw(sheet, 1, (struct grid_scene){ .state = RUNG_NO_GUTTER,
					    .reference = reference_of }, "paper-2");
	draw(sheet, 0, (struct grid_scene){ .state = RUNG_REMOVED | RUNG_CHANGED },
	     "removed");
	sheet_free(sheet);
	ladder_free(ladder);
	lettering_free(lettering);
	return tap_done();
}
