/* SPDX-License-Identifier: MIT
 *
 * test_print - printing into a file, and a rung as a picture; no printer, no display.
 */
#include "editor-gtk/draw/print.h"
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <unistd.h>

static void check_export(const struct project *project)
{
	GtkPrintOperation *operation = print_operation_new(project, "shapes.rung", -1,
							   SHOW_BOTH, NULL);
	char *path = NULL, *bytes = NULL;
	size_t len = 0;

	close(g_file_open_tmp("print-XXXXXX.pdf", &path, NULL));
	gtk_print_operation_set_export_filename(operation, path);
	CHECK(gtk_print_operation_run(operation, GTK_PRINT_OPERATION_ACTION_EXPORT, NULL,
				      NULL) == GTK_PRINT_OPERATION_RESULT_APPLY);
	int pages;
	g_object_get(operation, "n-pages", &pages, NULL);
	CHECK(pages >= 3 && pages < 9);
	CHECK(g_file_get_contents(path, &bytes, &len, NULL) && len > 5000 &&
	      memcmp(bytes, "%PDF", 4) == 0);
	g_unlink(path);
	g_free(bytes);
	g_free(path);
	g_object_unref(operation);
}

/* The same pages without an operation. */
static void check_pdf(const struct project *project)
{
	GBytes *pdf = print_pdf(project, "shapes.rung", SHOW_BOTH, "2026-03-01");
	size_t len = 0;
	const char *bytes = pdf ? g_bytes_get_data(pdf, &len) : "";

	CHECK(len > 5000 && memcmp(bytes, "%PDF", 4) == 0);
	CHECK(len > 5000 && memcmp(bytes + len - 6, "%%EOF\n", 6) == 0);
	g_bytes_unref(pdf);
}

/* A picture larger than a PNG can be is NULL; the SVG is there. */
static void check_too_large(const struct project *project, struct lettering *lettering)
{
	struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);
	const struct theme *theme = theme_get(THEME_LIGHT, THEME_GREEN);

	sheet_layout(sheet);
	CHECK(!print_rung_png(sheet, 0, theme, 1000));
	GdkContentProvider *one = print_rung_picture(sheet, 0, theme, 1000);
	GdkContentFormats *formats = gdk_content_provider_ref_formats(one);
	CHECK(gdk_content_formats_contain_mime_type(formats, "image/svg+xml"));
	CHECK(!gdk_content_formats_contain_mime_type(formats, "image/png"));
	gdk_content_formats_unref(formats);
	g_object_unref(one);
	sheet_free(sheet);
}

static void check_picture(const struct project *project, struct lettering *lettering)
{
	struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);
	const struct theme *theme = theme_get(THEME_LIGHT, THEME_GREEN);

	sheet_layout(sheet);
	GBytes *svg = print_rung_svg(sheet, 0, theme);
	GBytes *png = print_rung_png(sheet, 0, theme, 2);
	size_t len;
	const char *text = g_bytes_get_data(svg, &len);
	CHECK(len > 500 && g_strstr_len(text, (gssize)len, ">Motor</text>"));
	text = g_bytes_get_data(png, &len);
	CHECK(len > 500 && memcmp(text + 1, "PNG", 3) == 0);
	g_bytes_unref(svg);
	g_bytes_unref(png);
	CHECK(!print_rung_picture(sheet, 99, theme, 1));
	CHECK(!print_rung_picture(sheet, -1, theme, 1));
	GdkContentProvider *both = print_rung_picture(sheet, 0, theme, 1);
	GdkContentFormats *formats = gdk_content_provider_ref_formats(both);
	CHECK(gdk_content_formats_contain_mime_type(formats, "image/svg+xml"));
	CHECK(gdk_content_formats_contain_mime_type(formats, "image/png"));
	gdk_content_formats_unref(formats);
	g_object_unref(both);
	sheet_free(sheet);
}

/* The rung as one node; the same drawing. */
static void check_node(const struct project *project, struct lettering *lettering)
{
	struct sheet *sheet = sheet_new(project, &project->pou[0], lettering);
	graphene_rect_t bounds;

	sheet_layout(sheet);
	for (int i = 0; i < sheet->count; i++) {
		struct grid_scene scene = { .drafting = &sheet->drafting,
			.layout = sheet->rung[i],
			.theme = theme_get(THEME_DARK, THEME_GREEN) };
		GskRenderNode *node = grid_draw_node(&scene);

		gsk_render_node_get_bounds(node, &bounds);
		if (bounds.size.width < sheet->rung[i]->right - 2 ||
		    bounds.size.height > sheet->rung[i]->height + 2)
			CHECK_AS(false, "a node has the size of its rung");
		gsk_render_node_unref(node);
	}
	sheet_free(sheet);
}

int main(void)
{
	gtk_init_check(); /* for the types of nodes; a display is not needed    */
	struct ladder *ladder = drawn_load("tests/editor/drawing/shapes.rung", NULL);
	if (!CHECK(ladder))
		return tap_done();
	PangoContext *context = lettering_context();
	struct lettering *lettering = lettering_new(context, NULL);
	check_export(ladder_project(ladder));
	check_pdf(ladder_project(ladder));
	check_picture(ladder_project(ladder), lettering);
	check_too_large(ladder_project(ladder), lettering);
	check_node(ladder_project(ladder), lettering);
	lettering_free(lettering);
	g_object_unref(context);
	ladder_free(ladder);
	return tap_done();
}
