/* SPDX-License-Identifier: MIT
 *
 * test_strokes - drawings, stroke by stroke, against tests/editor/drawing/. Widths come
 * from a rule instead of fonts, so that they are the same on every machine.
 *
 * Each drawing is then painted by render nodes and by cairo's paths, and both must look the
 * same.
 *
 * --bless writes the files again; read the difference.
 */
#include "tests/editor/drawn.h"
#include "tests/editor/lines.h"
#include "tests/editor/nodes.h"
#include "tests/tap.h"

#include <glib.h>

#define FOLDER "tests/editor/drawing/"

static bool bless;
static struct lettering *with_fonts;

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

/* ---- on the screen as on paper ---- */

#define ZOOM 4

static cairo_t *white(int width, int height)
{
	cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24,
							    width * ZOOM, height * ZOOM);
	cairo_t *cr = cairo_create(image);

	cairo_surface_destroy(image);
	cairo_set_source_rgb(cr, 1, 1, 1);
	cairo_paint(cr);
	cairo_scale(cr, ZOOM, ZOOM);
	return cr;
}

/* Of the bytes that are not white in either image, those that differ much, in thousandths. */
static long differs(cairo_t *one, cairo_t *other)
{
	cairo_surface_t *left = cairo_get_target(one), *right = cairo_get_target(other);
	const int stride = cairo_image_surface_get_stride(left);
	const long size = (long)stride * cairo_image_surface_get_height(left);
	const unsigned char *a, *b;
	long inked = 0, others = 0;

	cairo_surface_flush(left);
	cairo_surface_flush(right);
	a = cairo_image_surface_get_data(left);
	b = cairo_image_surface_get_data(right);
	for (long i = 0; i < size; i++) {
		if (i % 4 == 3) /* unused byte of RGB24 */
			continue;
		inked += a[i] < 250 || b[i] < 250;
		others += abs(a[i] - b[i]) > 128;
	}
	return inked ? others * 1000 / inked : 1000;
}

static bool is_broken(const struct picture *picture)
{
	for (int i = 0; i < picture->count; i++)
		if (picture->stroke[i].style != STROKE_SOLID ||
		    picture->stroke[i].kind == STROKE_WAVE)
			return true;
	return false;
}

/* @broken: has strokes that only cairo draws. @scale: of the screen; 0: unknown. */
static void as_paper(struct picture *picture, int width, int height, bool broken,
		     float scale, const char *name)
{
	const struct theme *theme = theme_get(THEME_LIGHT, THEME_GREEN);
	cairo_t *screen = white(width, height), *paper = white(width, height);
	GskRenderNode *node;
	long part;

	picture->scale = scale;
	node = picture_node(picture, theme, with_fonts);
	gsk_render_node_draw(node, screen);
	picture_cairo(picture, theme, with_fonts, paper);
	part = differs(screen, paper);
	if (!CHECK_AS(part < 30, "the screen and the paper show the same picture"))
		printf("# %s: %ld of 1000 bytes differ\n", name, part);
	CHECK_AS(node_has(node, "cairo {") == broken,
		 "only a broken picture is drawn by cairo");
	cairo_destroy(screen);
	cairo_destroy(paper);
	gsk_render_node_unref(node);
}

/* Paints both ways. With an unknown scale the ends of arcs differ a little. */
static void both_ways(struct picture *picture, int width, int height, bool broken,
		      const char *name)
{
	as_paper(picture, width, height, broken, 0, name);
	as_paper(picture, width, height, broken, ZOOM, name);
}

/* ---- scenes ---- */

static void draw(struct sheet *sheet, int index, struct grid_scene scene, const char *name)
{
	struct picture picture;

	scene.drafting = &sheet->drafting;
	scene.layout = sheet->rung[index];
	scene.theme = theme_get(THEME_LIGHT, THEME_GREEN);
	picture_init(&picture);
	grid_draw(&scene, &picture);
	compare(&picture, name);
	both_ways(&picture, (int)rung_layout_width(scene.layout), (int)scene.layout->height,
		  is_broken(&picture), name);
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

/* Start is open, Motor closed, Stop closed: power flows through the lower branch. */
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
		{ 0, 1, MARK_SELECTED }, { 0, 2, MARK_DROP }, { 0, 3, MARK_SELECTED | MARK_WARNING },
		{ 0, 5, MARK_TWICE }, { 1, 0, MARK_FOUND | MARK_CHANGED },
		{ 1, 1, MARK_FOUND | MARK_FOUND_NOW }, { 1, 1, MARK_FOUND }, { 7, 0, MARK_CURSOR }, { 0, 70, MARK_ERROR },
	};
	struct grid_scene scene = { .mark = mark, .mark_count = G_N_ELEMENTS(mark),
				    .state = RUNG_CURRENT | RUNG_EDITED | RUNG_FOUND };
	bool takes[64] = { [1] = true };

	draw(sheet, 0, scene, "marks");
	takes[sheet->rung[0]->columns + 2] = true; /* second row, third column */
	draw(sheet, 0, (struct grid_scene){ .takes = takes }, "takes");
	draw(sheet, 0, (struct grid_scene){ .state = RUNG_GRID }, "grid");
}

/* What is marked may be forced, written twice and wrong at run time: its badges have room between
 * them. */
static void check_badges(struct sheet *sheet, int rung, struct grid_mark mark, int count)
{
	const struct grid_scene scene = { .drafting = &sheet->drafting,
					  .layout = sheet->rung[rung], .mark = &mark,
					  .mark_count = 1,
					  .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
	graphene_rect_t badge[8], wide;
	struct picture picture;
	int badges = 0;

	picture_init(&picture);
	grid_draw(&scene, &picture);
	for (int i = 0; i < picture.count && badges < 8; i++) {
		const struct stroke *stroke = &picture.stroke[i];

		if (stroke->kind == STROKE_FILL && stroke->h == 13 &&
		    (stroke->token == TOKEN_FORCE || stroke->token == TOKEN_ERROR))
			badge[badges++] = GRAPHENE_RECT_INIT(stroke->x, stroke->y, stroke->w,
							     stroke->h);
	}
	CHECK_AS(badges == count, "each mark has its badge");
	for (int i = 0; i < badges; i++)
		for (int other = 0; other < i; other++) {
			graphene_rect_inset_r(&badge[i], -1, -1, &wide);
			CHECK_AS(!graphene_rect_intersection(&wide, &badge[other], NULL),
				 "two badges touch");
		}
	picture_clear(&picture);
}

/* Coils in series: the power of the first one goes on to the others. */
static void check_series(struct lettering *lettering)
{
	static const char text[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n"
				   "  | NO I0 | COIL Q0 | COIL Q1 |\nEND_PROGRAM\n";
	struct ladder *ladder = ladder_new();
	uint8_t cell[8];
	struct grid_live live = { cell, NULL, NULL };
	struct grid_scene scene = { .live = &live, .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
	struct picture picture;
	struct project *project;
	struct sheet *sheet;
	int idle = 0, dotted = 0;

	ladder_load_text(ladder, "a.rung", text, sizeof(text) - 1);
	project = ladder_project(ladder);
	sheet = sheet_new(project, &project->pou[0], lettering);
	sheet_layout(sheet);
	memset(cell, LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED, sizeof(cell));
	scene.drafting = &sheet->drafting;
	scene.layout = sheet->rung[0];
	picture_init(&picture);
	grid_draw(&scene, &picture);
	for (int i = 0; i < picture.count; i++) {
		dotted += picture.stroke[i].style == STROKE_DOTTED;
		idle += picture.stroke[i].kind == STROKE_LINE && picture.stroke[i].token == TOKEN_IDLE;
	}
	CHECK(dotted == 0 && picture.count > 0);
	if (!CHECK(idle <= 1)) /* the right rail */
		printf("# %d lines without power\n", idle);
	picture_clear(&picture);
	sheet_free(sheet);
	ladder_free(ladder);
}

static const char *note_of(void *context, int row, int column)
{
	(void)context;
	return row == 0 && column == 0 ? "must be on" : NULL;
}

/* Blockers with a note, without one, below a value, at a box, and beside a force. */
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

static char *reference_of(void *context, int row, int col, float room)
{
	(void)context;
	(void)col;
	(void)room;
	return row == 1 ? NULL : g_strdup("read in Main 3, 5");
}

static void shape(struct picture *picture, int which)
{
	switch (which) {
	case 0:
		picture_arc(picture, TOKEN_INK, 2, 30, 20, 20, (float)G_PI - 0.73f,
			    (float)G_PI + 0.73f);
		return;
	case 1:
		picture_arc(picture, TOKEN_INK, 2, 30, 20, 20, -0.73f, 0.73f);
		return;
	case 2:
		picture_arc(picture, TOKEN_INK, 1.5f, 30, 20, 5, 0, (float)(2 * G_PI));
		return;
	case 3:
		picture_disc(picture, TOKEN_POWER, 0.5f, 30, 20, 13);
		return;
	case 4:
		picture_line(picture, TOKEN_INK, STROKE_SOLID, 2, 10, 35, 50, 5);
		return;
	case 5:
		picture_line(picture, TOKEN_INK, STROKE_SOLID, 2, 50, 30, 10, 20);
		return;
	case 6:
		picture_line(picture, TOKEN_INK, STROKE_DASHED, 2, 10, 35, 50, 5);
		return;
	case 7:
		picture_arc(picture, TOKEN_INK, 2, 30, 20, 15, 0.3f, 1.9f); /* not symmetric */
		return;
	default: /* the first arc has a short angle, the second has not */
		picture_text(picture, TOKEN_INK, LETTER_SYMBOL,
			     lettering_fit(with_fonts, LETTER_SYMBOL, "Motor", -1, 0), 5, 30);
		picture_fill(picture, TOKEN_POWER, 1, 20, 10, 20, 25);
		picture_text(picture, TOKEN_INK, LETTER_SYMBOL,
			     lettering_fit(with_fonts, LETTER_SYMBOL, "On", -1, 0), 22, 20);
		return;
	}
}

static void check_shapes(void)
{
	static const char *const names[] = {
		"left arc", "right arc", "circle", "disc", "slash", "backward", "dashed",
		"arc askew", "a text below another",
	};

	for (int i = 0; i < (int)G_N_ELEMENTS(names); i++) {
		struct picture picture;

		picture_init(&picture);
		shape(&picture, i);
		both_ways(&picture, 60, 40, i == 6 || i == 7, names[i]);
		picture_clear(&picture);
	}
}

static GskRenderNode *arc_node(float scale, float dx)
{
	struct picture picture;
	GskRenderNode *node;

	picture_init(&picture);
	picture_move(&picture, dx, 0);
	picture.scale = scale;
	shape(&picture, 0);
	node = picture_node(&picture, theme_get(THEME_DARK, THEME_GREEN), with_fonts);
	picture_clear(&picture);
	return node;
}

/* Arcs become images where their size on the screen is known. */
static void check_images(void)
{
	static const float scales[] = { 0, 0.5f, 1, 1.1f, 2 };

	for (int i = 0; i < (int)G_N_ELEMENTS(scales); i++) {
		GskRenderNode *node = arc_node(scales[i], 0);

		CHECK(node_has(node, "texture {") == (i == 2 || i == 4));
		gsk_render_node_unref(node);
	}
}

/* Arcs that look alike share an image. */
static void check_same_image(void)
{
	static const struct { float dx; bool same; } cases[] = {
		{ 0, true }, { 8, true }, { 0.1f, true }, { -0.1f, true }, { 0.5f, false },
	};
	GskRenderNode *node = arc_node(1, 0);

	for (gsize i = 0; i < G_N_ELEMENTS(cases); i++) {
		GskRenderNode *other = arc_node(1, cases[i].dx);

		CHECK((gsk_texture_node_get_texture(node) ==
		       gsk_texture_node_get_texture(other)) == cases[i].same);
		gsk_render_node_unref(other);
	}
	gsk_render_node_unref(node);
}

int main(int argc, char **argv)
{
	PangoContext *context = lettering_context();
	struct lettering *lettering = lettering_new(NULL, NULL);
	struct ladder *ladder = drawn_load(FOLDER "shapes.rung", NULL);

	with_fonts = lettering_new(context, NULL);
	gtk_init_check(); /* for the types of nodes; a display is not needed    */
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
	check_badges(sheet, 0, (struct grid_mark){ 0, 5, MARK_FORCED | MARK_TWICE }, 2);
	check_badges(sheet, 3, (struct grid_mark){ 0, 1, MARK_FORCED | MARK_TWICE | MARK_FAILED }, 3);
	check_badges(sheet, 3, (struct grid_mark){ 0, 1, MARK_TWICE | MARK_FAILED }, 2);
	check_series(lettering);
	draw_blockers(sheet);
	draw(sheet, 0, (struct grid_scene){ .state = RUNG_NO_GUTTER,
					    .reference = reference_of }, "paper");
	draw(sheet, 1, (struct grid_scene){ .state = RUNG_NO_GUTTER,
					    .reference = reference_of }, "paper-2");
	draw(sheet, 0, (struct grid_scene){ .state = RUNG_REMOVED | RUNG_CHANGED },
	     "removed");
	check_shapes();
	check_images();
	check_same_image();
	sheet_free(sheet);
	ladder_free(ladder);
	lettering_free(with_fonts);
	lettering_free(lettering);
	g_object_unref(context);
	return tap_done();
}
