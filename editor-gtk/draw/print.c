/* SPDX-License-Identifier: MIT
 *
 * print - GtkPrintOperation over pages.h, and pictures of a rung; see print.h.
 */
#include "editor-gtk/draw/print.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/pages.h"

#include <math.h>

#define EDGE 12 /* px around the picture of a rung                              */

struct job {
	const struct project *project;
	char *file, *date;
	int pou;
	enum drafting_show show;
	struct lettering *lettering;
	struct pages *pages; /* from begin-print on                              */
};

static void job_free(gpointer pointer, GClosure *closure)
{
	struct job *job = pointer;

	(void)closure;
	pages_free(job->pages);
	lettering_free(job->lettering);
	g_free(job->file);
	g_free(job->date);
	g_free(job);
}

/* The setup's sizes include the orientation. */
static struct paper paper_of(GtkPageSetup *setup, const char *date)
{
	return (struct paper){
		.width = (float)gtk_page_setup_get_paper_width(setup, GTK_UNIT_MM),
		.height = (float)gtk_page_setup_get_paper_height(setup, GTK_UNIT_MM),
		.date = date,
	};
}

static void begin_print(GtkPrintOperation *operation, GtkPrintContext *context,
			struct job *job)
{
	const struct paper paper = paper_of(gtk_print_context_get_page_setup(context),
					    job->date);

	pages_free(job->pages);
	job->pages = pages_new(job->project, job->file, job->pou, 0, job->show, &paper,
			       job->lettering);
	gtk_print_operation_set_n_pages(operation, pages_count(job->pages));
}

static void draw_page(GtkPrintOperation *operation, GtkPrintContext *context, int page,
		      struct job *job)
{
	(void)operation;
	pages_paint(job->pages, page, gtk_print_context_get_cairo_context(context));
}

GtkPrintOperation *print_operation_new(const struct project *project, const char *file,
				       int pou, enum drafting_show show, const char *date)
{
	GtkPrintOperation *operation = gtk_print_operation_new();
	PangoContext *context = lettering_context();
	struct job *job = g_new0(struct job, 1);
	char *name = g_path_get_basename(file);

	*job = (struct job){ .project = project, .file = g_strdup(file), .pou = pou,
			     .date = g_strdup(date), .show = show,
			     .lettering = lettering_new(context, NULL) };
	g_object_unref(context);
	gtk_print_operation_set_unit(operation, GTK_UNIT_POINTS);
	gtk_print_operation_set_use_full_page(operation, TRUE);
	gtk_print_operation_set_job_name(operation, name);
	g_free(name);
	g_signal_connect(operation, "draw-page", G_CALLBACK(draw_page), job);
	g_signal_connect_data(operation, "begin-print", G_CALLBACK(begin_print), job,
			      job_free, 0);
	return operation;
}

GBytes *print_pdf(const struct project *project, const char *file,
		  enum drafting_show show, const char *date)
{
	GtkPageSetup *setup = gtk_page_setup_new();
	const struct paper paper = paper_of(setup, date);
	PangoContext *context = lettering_context();
	struct lettering *lettering = lettering_new(context, NULL);
	struct pages *pages = pages_new(project, file, -1, 0, show, &paper, lettering);
	const char *title = project_text(project, project->title);
	GBytes *pdf = pages_pdf(pages, &paper, *title ? title : file, NULL);

	pages_free(pages);
	lettering_free(lettering);
	g_object_unref(context);
	g_object_unref(setup);
	return pdf;
}

/* ---- a rung as a picture ---- */

static void draw_rung(const struct sheet *sheet, int index, const struct theme *theme,
		      struct picture *picture)
{
	const struct rung_layout *layout = sheet->rung[index];
	struct grid_scene scene = { .drafting = &sheet->drafting, .layout = layout,
				    .theme = theme, .state = RUNG_NO_GUTTER };

	picture_init(picture);
	picture_move(picture, 0, EDGE);
	grid_draw(&scene, picture);
	picture->width = ceilf(rung_layout_width(layout));
	picture->height = ceilf(layout->height) + 2 * EDGE;
}

GBytes *print_rung_svg(const struct sheet *sheet, int index, const struct theme *theme)
{
	struct picture picture;
	char *svg;

	draw_rung(sheet, index, theme, &picture);
	svg = picture_svg(&picture, theme, 1, true);
	picture_clear(&picture);
	return g_bytes_new_take(svg, strlen(svg));
}

GBytes *print_rung_png(const struct sheet *sheet, int index, const struct theme *theme,
		       float scale)
{
	struct picture picture;
	GBytes *png;

	draw_rung(sheet, index, theme, &picture);
	png = picture_png(&picture, theme, sheet->drafting.lettering, scale);
	picture_clear(&picture);
	return png;
}

GdkContentProvider *print_rung_picture(const struct sheet *sheet, int index,
				       const struct theme *theme, float scale)
{
	if (index < 0 || index >= sheet->count)
		return NULL;
	GBytes *svg = print_rung_svg(sheet, index, theme);
	GBytes *png = print_rung_png(sheet, index, theme, scale);
	GdkContentProvider *both[2] = {
		gdk_content_provider_new_for_bytes("image/svg+xml", svg),
		png ? gdk_content_provider_new_for_bytes("image/png", png) : NULL,
	};

	g_bytes_unref(svg);
	g_bytes_unref(png);
	return gdk_content_provider_new_union(both, png ? 2 : 1);
}
