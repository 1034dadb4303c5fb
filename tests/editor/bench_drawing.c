/* SPDX-License-Identifier: MIT
 *
 * bench_drawing - what it costs to lay out and draw a sheet of 5,000 rungs, and networks of 60 boxes, in time of
 * the processor. It prints and judges nothing.
 */
#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/draw/pages.h"
#include "tests/editor/drawn.h"

#include <malloc.h>
#include <time.h>

#define RUNGS 5000
#define SEEN  6     /* rungs on a screen                                        */
#define TIMES 1000

static clock_t started;

static void start(void)
{
	started = clock();
}

/* Milliseconds since start(), over @count. */
static double taken(int count)
{
	return (double)(clock() - started) * 1e3 / CLOCKS_PER_SEC / count;
}

/* Five columns and a branch; each tenth rung has a timer. */
static char *program(void)
{
	GString *text = g_string_new("RUNGBOARD 1\nVAR\n");

	for (int i = 0; i < 400; i++)
		g_string_append_printf(text, "  In%d AT %%MX%d.%d : BOOL; (* input %d *)\n"
				       "  Out%d AT %%MX%d.%d : BOOL;\n", i, i / 8, i % 8, i,
				       i, 100 + i / 8, i % 8);
	g_string_append(text, "END_VAR\nPROGRAM Main LD\nVAR\n");
	for (int i = 0; i < RUNGS / 10; i++)
		g_string_append_printf(text, "  T%d : TON;\n", i);
	g_string_append(text, "END_VAR\n");
	for (int i = 0; i < RUNGS; i++) {
		int n = i % 400;

		g_string_append_printf(text, "RUNG \"Rung number %d\"\n", i);
		if (i % 10 == 3)
			g_string_append_printf(text, "  | NO In%d | TON T%d PT:=T#5s | "
					       "COIL Out%d |\n", n, i / 10, n);
		else
			g_string_append_printf(text, "  | NO In%d | NC In%d | NO In%d | "
				"NC Out%d | COIL Out%d |\n  | NO Out%d ^|\n", n,
				i * 7 % 400, i * 3 % 400, i * 5 % 400, n, n);
	}
	g_string_append(text, "END_PROGRAM\n");
	return g_string_free(text, FALSE);
}

static struct grid_scene scene_of(const struct sheet *sheet, int index,
				  const struct grid_live *live)
{
	return (struct grid_scene){ .drafting = &sheet->drafting,
				    .layout = sheet->rung[index], .live = live,
				    .theme = theme_get(THEME_LIGHT, THEME_GREEN) };
}

static void bench_layout(struct sheet *sheet)
{
	size_t before = mallinfo2().uordblks;

	start();
	sheet_layout(sheet);
	printf("layout of %d rungs, names not measured     %8.1f ms\n", RUNGS, taken(1));
	printf("memory of that                              %8.1f MB\n",
	       (double)(mallinfo2().uordblks - before) / 1e6);
	start();
	sheet_layout(sheet);
	printf("layout of a rung, names measured            %8.1f us\n",
	       taken(RUNGS) * 1e3);
}

static void bench_nodes(const struct sheet *sheet, const struct grid_live *live,
			const char *what)
{
	start();
	for (int i = 0; i < TIMES; i++) {
		struct grid_scene scene = scene_of(sheet, i % 50, live);
		struct picture picture;

		picture_init(&picture);
		grid_draw(&scene, &picture);
		picture_clear(&picture);
	}
	printf("strokes of a rung, %-10s              %10.1f us\n", what,
	       taken(TIMES) * 1e3);
	start();
	for (int i = 0; i < TIMES; i++) {
		struct grid_scene scene = scene_of(sheet, i % 50, live);

		gsk_render_node_unref(grid_draw_node(&scene));
	}
	printf("node of a rung, %-10s                 %10.1f us\n", what,
	       taken(TIMES) * 1e3);
}

static void bench_paint(const struct sheet *sheet)
{
	cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1280, 900);
	cairo_t *cr = cairo_create(surface);
	GskRenderNode *node[SEEN];

	for (int i = 0; i < SEEN; i++) {
		struct grid_scene scene = scene_of(sheet, i, NULL);

		node[i] = grid_draw_node(&scene);
		gsk_render_node_draw(node[i], cr);
	}
	start();
	for (int frame = 0; frame < TIMES / 10; frame++) {
		cairo_set_source_rgb(cr, 1, 1, 1);
		cairo_paint(cr);
		for (int i = 0; i < SEEN; i++) {
			cairo_save(cr);
			cairo_translate(cr, 0, (double)sheet->y[i]);
			gsk_render_node_draw(node[i], cr);
			cairo_restore(cr);
		}
	}
	printf("a frame of %d rungs, by cairo              %10.2f ms\n", SEEN,
	       taken(TIMES / 10));
	for (int i = 0; i < SEEN; i++)
		gsk_render_node_unref(node[i]);
	cairo_destroy(cr);
	cairo_surface_destroy(surface);
}

static void bench_pages(const struct project *project, struct lettering *lettering)
{
	struct paper paper = { .date = NULL };

	paper_find("a4", &paper);
	start();
	struct pages *pages = pages_new(project, "bench.rung", -1, 0, SHOW_BOTH, &paper,
					lettering);
	printf("breaking it into %4d pages                %10.1f ms\n", pages_count(pages),
	       taken(1));
	pages_free(pages);
}

/* 60 boxes, each of which reads two others near to it. */
static char *network(void)
{
	GString *text = g_string_new("RUNGBOARD 1\nPROGRAM Main FBD\nVAR\n  A, B, C, Q : BOOL;\nEND_VAR\nNETWORK\n");

	for (int i = 0; i < 59; i++)
		g_string_append_printf(text, i < 3 ? "  W%d := AND(A, NOT B)\n" : "  W%d := OR(W%d, NOT W%d, C)\n", i,
				       i - 1 - i * 5 % 3, i - 1 - i * 7 % 3);
	g_string_append(text, "  Q := W58\nEND_PROGRAM\n");
	return g_string_free(text, FALSE);
}

static void bench_network(struct lettering *lettering)
{
	char *text = network();
	struct ladder *ladder = drawn_load("bench.rung", text);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;
	struct fbd_layout *layout;

	g_free(text);
	if (!project)
		return;
	start();
	for (int i = 0; i < TIMES / 10; i++)
		fbd_layout_free(fbd_layout_new(project, &project->pou[0], 0, lettering));
	layout = fbd_layout_new(project, &project->pou[0], 0, lettering);
	printf("graph and layout of a network of %d boxes  %10.3f ms\n", layout->graph.box_count, taken(TIMES / 10));
	start();
	for (int i = 0; i < TIMES / 10; i++) {
		const struct fbd_scene scene = { .layout = layout, .theme = theme_get(THEME_LIGHT, THEME_GREEN) };

		gsk_render_node_unref(fbd_draw_node(&scene));
	}
	printf("node of that network                       %10.3f ms\n", taken(TIMES / 10));
	fbd_layout_free(layout);
	ladder_free(ladder);
}

int main(void)
{
	PangoContext *context = lettering_context();
	struct lettering *lettering = lettering_new(context, NULL);
	uint8_t cell[4096];
	struct grid_live live = { cell, NULL, NULL };
	char *text = program();

	gtk_init_check(); /* registers the node types; needs no display         */
	memset(cell, LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED, sizeof(cell));
	start();
	struct ladder *ladder = drawn_load("bench.rung", text);
	if (!ladder)
		return 1;
	printf("reading %d rungs                          %10.1f ms\n", RUNGS, taken(1));
	struct project *project = ladder_project(ladder);
	struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);
	bench_layout(sheet);
	bench_nodes(sheet, NULL, "edited");
	bench_nodes(sheet, &live, "running");
	bench_paint(sheet);
	bench_pages(project, lettering);
	bench_network(lettering);
	sheet_free(sheet);
	ladder_free(ladder);
	lettering_free(lettering);
	g_object_unref(context);
	g_free(text);
	return 0;
}
