/* SPDX-License-Identifier: MIT
 *
 * test_fold - random rungs and long ones, folded at many widths: each element is shown once, wholly, on the
 * page, over no other one; what a pointer meets there is that element; the drawing shows it there.
 *
 * FOLD_SEEDS=FROM..TO tries other random rungs.
 */
#include "tests/editor/drawn.h"
#include "tests/tap.h"
#include "tests/walker/random.h"

#include <glib.h>
#include <stdlib.h>

#define MOST_TEXT (1 << 20)
#define FAULTS_SHOWN 5

static struct lettering *lettering;
static int faults, folded;

/* A rung that is laid out for a page. */
struct page {
	struct drafting drafting;
	struct rung_layout *layout;
	struct rung_fold *fold;
	float width;
	const char *name;
};

static void fault(const struct page *page, const char *what, int row, int column)
{
	if (faults++ < FAULTS_SHOWN)
		printf("# %s, rung %d, %g px, row %d, column %d: %s\n", page->name, page->layout->number,
		       (double)page->width, row, column, what);
}

static graphene_rect_t shown_box(const struct page *page, int row, int column)
{
	graphene_rect_t box = rung_layout_cell(page->layout, row, column);
	const float middle = box.size.width / 2;
	const graphene_point_t at = rung_fold_shown(page->fold, box.origin.x + middle, box.origin.y);

	box.origin = GRAPHENE_POINT_INIT(at.x - middle, at.y);
	return box;
}

static bool is_element(const struct page *page, int row, int col)
{
	const struct rung *rung = page->layout->rung;
	const struct word_row *word = words_row(&page->drafting.project->words, rung_at(rung, row, col)->word);

	return word->kind != WORD_ELEM || (word->place != PLACE_NONE && word->place != PLACE_WIRE &&
					   word->place != PLACE_PIN);
}

/* The pointer in the middle of its upper edge meets the cell. */
static void check_hit(const struct page *page, int row, int column, const graphene_rect_t *box)
{
	const float x = box->origin.x + box->size.width / 2, y = box->origin.y + 3;
	const graphene_point_t at = rung_fold_laid(page->fold, page->layout, x, y);
	const graphene_point_t back = rung_fold_shown(page->fold, at.x, at.y);
	const struct rung_hit hit = rung_layout_hit(&page->drafting, page->layout, at.x, at.y);

	if (fabsf(back.x - x) > 0.1f || fabsf(back.y - y) > 0.1f)
		fault(page, "a point does not come back", row, column);
	if (hit.row != row || hit.column != column || hit.part == RUNG_PART_NONE)
		fault(page, "the pointer meets another cell", row, column);
}

static void check_element(const struct page *page, int row, int column, GArray *boxes)
{
	const graphene_rect_t box = shown_box(page, row, column);
	const float right = box.origin.x + box.size.width, bottom = box.origin.y + box.size.height;

	if (box.origin.x < RUNG_LEFT - 0.1f || right > RUNG_LEFT + page->width + 0.1f)
		fault(page, "it is not on the page", row, column);
	if (box.origin.y < page->layout->top - 0.1f || bottom > page->fold->height)
		fault(page, "it is not on the strip", row, column);
	for (guint i = 0; i < boxes->len; i++) {
		const graphene_rect_t *other = &g_array_index(boxes, graphene_rect_t, i);
		graphene_rect_t common;

		if (graphene_rect_intersection(other, &box, &common) && common.size.width > 0.1f &&
		    common.size.height > 0.1f)
			fault(page, "it lies over another one", row, column);
	}
	g_array_append_val(boxes, box);
	check_hit(page, row, column, &box);
}

static void check_elements(const struct page *page)
{
	const struct rung *rung = page->layout->rung;
	GArray *boxes = g_array_new(FALSE, FALSE, sizeof(graphene_rect_t));

	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++)
			if (is_element(page, row, col))
				check_element(page, row, rung_layout_column(page->layout, row, col), boxes);
	g_array_unref(boxes);
}

/* All columns once, in order; a wire goes on at each fold; the last line ends at the common rail. */
static void check_lines(const struct page *page)
{
	const struct rung_fold *fold = page->fold;
	const struct rung_fold_line *end = &fold->line[fold->lines - 1];
	const float rail = rung_fold_shown(fold, page->layout->right, page->layout->row[0].wire).x;

	if (fold->lines < 2 || fold->line[0].first != 0 || end->last != page->layout->columns)
		fault(page, "a column has no line", -1, -1);
	for (int i = 0; i + 1 < fold->lines; i++) {
		if (fold->line[i].last != fold->line[i + 1].first || fold->line[i].first >= fold->line[i].last)
			fault(page, "columns between lines", i, -1);
		int cut = 0;
		for (int row = 0; row < page->layout->rung->rows; row++)
			cut += rung_fold_goes_on(fold, page->layout, i, row);
		if (cut == 0)
			fault(page, "no wire goes on at a fold", i, fold->line[i].last);
	}
	if (fabsf(rail - RUNG_LEFT - page->width) > 0.5f)
		fault(page, "the right rail stands elsewhere", -1, -1);
}

/* ---- the drawing ---- */

static cairo_surface_t *painted(const struct page *page, bool folds)
{
	const float height = folds ? page->fold->height : page->layout->height;
	const struct grid_scene scene = {
		.drafting = &page->drafting, .layout = page->layout, .fold = folds ? page->fold : NULL,
		.theme = theme_get(THEME_LIGHT, THEME_GREEN), .state = RUNG_ON_GUTTER,
	};
	GskRenderNode *node = grid_draw_node(&scene);
	cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_A8, folds ?
		(int)(RUNG_LEFT + page->width + RUNG_AFTER) : (int)rung_layout_width(page->layout), (int)height);
	cairo_t *cr = cairo_create(image);

	gsk_render_node_draw(node, cr);
	cairo_destroy(cr);
	cairo_surface_flush(image);
	gsk_render_node_unref(node);
	return image;
}

/* How much is painted inside of a box, without its edges: wires of a neighbour begin there. */
static long ink_in(cairo_surface_t *image, graphene_rect_t box)
{
	const int stride = cairo_image_surface_get_stride(image);
	const unsigned char *data = cairo_image_surface_get_data(image);
	const int to_x = MIN((int)(box.origin.x + box.size.width) - 4, cairo_image_surface_get_width(image));
	const int to_y = MIN((int)(box.origin.y + box.size.height) - 12, cairo_image_surface_get_height(image));
	long ink = 0;

	for (int y = (int)box.origin.y + 2; y < to_y; y++)
		for (int x = (int)box.origin.x + 4; x < to_x; x++)
			ink += data[y * stride + x];
	return ink;
}

static void check_drawing(const struct page *page)
{
	const struct rung *rung = page->layout->rung;
	cairo_surface_t *whole = painted(page, false), *lines = painted(page, true);

	for (int row = 0; row < rung->rows; row++)
		for (int col = 0; col < rung->cols; col++) {
			const int column = rung_layout_column(page->layout, row, col);
			long want, got;

			if (!is_element(page, row, col))
				continue;
			want = ink_in(whole, rung_layout_cell(page->layout, row, column));
			got = ink_in(lines, shown_box(page, row, column));
			if (want == 0 || labs(want - got) > want / 4)
				fault(page, "it is not drawn where it is", row, column);
		}
	cairo_surface_destroy(whole);
	cairo_surface_destroy(lines);
}

/* ---- rungs and pages ---- */

static void check_page(const struct drafting *drafting, const struct rung *rung, int number, float width,
		       const char *name)
{
	struct page page = { .drafting = *drafting, .width = width, .name = name };

	page.drafting.most = width;
	page.layout = rung_layout_new(&page.drafting, rung, number, 0);
	page.width = MAX(width, MIN(page.layout->tight, rung_fold_room(page.layout)));
	if (page.layout->tight > page.width) {
		folded++;
		page.fold = rung_fold_new(page.layout, page.width);
		rung_fold_place(page.fold, page.layout, NULL, 0);
		check_lines(&page);
		check_elements(&page);
		check_drawing(&page);
		g_free(page.fold);
	}
	rung_layout_free(page.layout);
}

static void check_program(const char *name, const char *text, const float *widths, int count)
{
	struct ladder *ladder = drawn_load(name, text);
	struct project *project;

	if (!ladder) {
		faults++;
		return;
	}
	project = ladder_project(ladder);
	for (int p = 0; p < project->pou_count; p++) {
		struct sheet *sheet = sheet_new(project, &project->pou[p], lettering);

		sheet->drafting.folds = true;
		sheet_layout(sheet);
		for (int i = 0; i < sheet->count; i++)
			for (int w = 0; w < count; w++)
				check_page(&sheet->drafting, sheet->rung[i]->rung, i + 1, widths[w], name);
		sheet_free(sheet);
	}
	ladder_free(ladder);
}

static void check_random(void)
{
	static const float widths[] = { 396, 430, 500, 640 };
	const char *seeds = g_getenv("FOLD_SEEDS");
	int from = 1, to = 40;
	char *text = g_malloc(MOST_TEXT), name[32];

	if (seeds && strstr(seeds, "..")) {
		from = atoi(seeds);
		to = atoi(strstr(seeds, "..") + 2);
	}
	for (int seed = from; seed <= to; seed++) {
		struct random_program *program = g_new0(struct random_program, 1);

		random_make(program, (uint64_t)seed);
		random_print(program, text, MOST_TEXT);
		g_snprintf(name, sizeof(name), "seed-%d.rung", seed);
		check_program(name, text, widths, G_N_ELEMENTS(widths));
		g_free(program);
	}
	g_free(text);
	printf("# %d folded\n", folded);
	CHECK_AS(folded > 2 * (to - from + 1), "random rungs are folded");
	CHECK_AS(faults == 0, "each element of a random rung has its place in a line, and is met and drawn there");
}

/* A row of so many contacts with branches below, and a short rung beside it. */
static char *long_rung(int contacts, int branches)
{
	GString *text = g_string_new("RUNGBOARD 1\nVAR\n  A : BOOL;\n  OverloadOfThePump : BOOL;\n  T : TON;\nEND_VAR\n"
				     "PROGRAM Main LD\nRUNG\n  | NO A | COIL %QX0.0 |\nRUNG \"Long\"\n  |");

	for (int i = 0; i < contacts; i++)
		g_string_append(text, i % 11 == 5 ? " TON T PT:=T#5s |" : i % 7 == 3 ? " NC OverloadOfThePump |" :
				" NO A |");
	g_string_append(text, " COIL %QX0.1 |\n");
	for (int branch = 0; branch < branches; branch++) {
		g_string_append(text, "  |");
		for (int i = 0; i < contacts; i++)
			g_string_append(text, i % 9 == 2 ? " ^ |" : i % 9 == 3 ? " NO A ^ |" : " |");
		g_string_append(text, "\n");
	}
	g_string_append(text, "END_PROGRAM\n");
	return g_string_free(text, FALSE);
}

static void check_long(void)
{
	static const float widths[] = { 396, 700, 1000, 1300, 2000 };

	faults = folded = 0;
	for (int contacts = 4; contacts <= 62; contacts += 1 + contacts / 8)
		for (int branches = 0; branches <= 2; branches++) {
			char *text = long_rung(contacts, branches);

			check_program("long.rung", text, widths, G_N_ELEMENTS(widths));
			g_free(text);
		}
	printf("# %d folded\n", folded);
	CHECK_AS(folded > 60, "long rungs are folded");
	CHECK_AS(faults == 0, "each element of a long rung has its place in a line, and is met and drawn there");
}

/* A short rung on the sheet of a long one has one line; a row that is empty in a line is not shown there. */
static void check_rows(void)
{
	char *text = long_rung(24, 1);
	struct ladder *ladder = drawn_load("rows.rung", text);
	struct project *project = ladder_project(ladder);
	struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);
	struct rung_layout *layout;
	struct rung_fold *fold;

	sheet->drafting.folds = true;
	sheet_layout(sheet);
	CHECK(sheet->rung[0]->columns == sheet->rung[1]->columns && sheet->rung[0]->tight < 600);
	layout = rung_layout_new(&sheet->drafting, sheet->rung[1]->rung, 2, 0);
	fold = rung_fold_new(layout, 420);
	CHECK(rung_fold_place(fold, layout, NULL, 0));
	int one = 0;
	for (int i = 0; i < fold->lines; i++)
		one += fold->line[i].rows == 1;
	CHECK_AS(one > 0 && one < fold->lines, "only lines with a branch show its row");
	for (int i = 0; i < fold->lines; i++) {
		const struct rung_fold_wish wish = { 1, fold->line[i].first, false };
		const struct rung_fold_wish on = { 1, fold->line[i].first, true };

		rung_fold_place(fold, layout, &wish, 1);
		int two = 0;
		for (int other = 0; other < fold->lines; other++)
			two += fold->line[other].rows == 2;
		CHECK_AS(fold->line[i].rows == 2 && two <= fold->lines - one + 1,
			 "a line shows the row of the cursor, the others do not");
		rung_fold_place(fold, layout, NULL, 0);
		const float stays = fold->line[i].y;
		rung_fold_place(fold, layout, &on, 1);
		bool later = true;
		for (int other = i; other < fold->lines; other++)
			later &= fold->line[other].rows == 2;
		CHECK_AS(later, "a line and all later ones show the row of a wire");
		CHECK_AS(fold->line[i].y == stays, "a line stays where it is when it shows one more row");
	}
	const struct rung_fold_wish all = { 1, 0, true };
	rung_fold_place(fold, layout, &all, 1);
	for (int i = 0; i < fold->lines; i++)
		CHECK(fold->line[i].rows == 2);
	CHECK(!rung_fold_place(fold, layout, &all, 1));
	g_free(fold);
	rung_layout_free(layout);
	sheet_free(sheet);
	ladder_free(ladder);
	g_free(text);
}

int main(void)
{
	PangoContext *context = lettering_context();

	gtk_init_check(); /* for the types of nodes; a display is not needed    */
	lettering = lettering_new(context, NULL);
	check_random();
	check_long();
	check_rows();
	lettering_free(lettering);
	g_object_unref(context);
	return tap_done();
}
