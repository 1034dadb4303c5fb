/* SPDX-License-Identifier: MIT
 *
 * render - `ladder-editor --render`: loads a project, draws it, writes a file.
 *
 * Everything is drawn by grid_draw and pages; what is compared by render_diff.
 */
#include "editor-gtk/render.h"
#include "editor-gtk/diag_said.h"
#include "editor-gtk/disk.h"
#include "editor-gtk/i18n.h"
#include "editor-gtk/render_classic.h"
#include "editor-gtk/render_diff.h"
#include "editor-gtk/render_options.h"
#include "editor-gtk/render_sheet.h"
#include "engine/ladder.h"

#include <cairo-pdf.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define MOST_PIXELS 32000 /* of a side of a PNG; cairo's bound is 32767         */

static void say_diags(const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		char *line = diag_said_line(diag);
		char *size = disk_told_size(diag->file, diag, LIMIT_TEXT);

		fprintf(stderr, "%s%s\n", line, size);
		g_free(line);
		g_free(size);
	}
	if (diags->dropped)
		fprintf(stderr, _("and %d more\n"), diags->dropped);
}

/* NULL: it has errors, or *status is RENDER_WRONG: it cannot be read. */
static struct ladder *load(const char *path, enum render_status *status)
{
	struct ladder *ladder = ladder_new();

	*status = RENDER_WRONG;
	if (!ladder || !ladder_take_classic(ladder, false)) {
		ladder_free(ladder);
		return NULL;
	}
	if (ladder_load(ladder, path) && ladder_project(ladder)) {
		*status = RENDER_GOOD;
		return ladder;
	}
	say_diags(ladder_diags(ladder));
	if (ladder_could_read(ladder))
		*status = RENDER_NO;
	if (!ladder_diags(ladder)->count)
		fprintf(stderr, _("ladder-editor: %s: a code image has no drawing\n"),
			path);
	ladder_free(ladder);
	return NULL;
}

static int find_pou(const struct project *project, const char *name)
{
	for (int i = 0; i < project->pou_count; i++)
		if (!strcasecmp(project_text(project, project->pou[i].name), name))
			return i;
	return -1;
}

static enum render_status failed(const char *path, const char *why)
{
	fprintf(stderr, _("ladder-editor: cannot write %s: %s\n"), path, why);
	return RENDER_WRONG;
}

/* Is there a POU of that name, and in it a rung of that number? */
static bool is_there(const struct project *project, const struct render_options *options,
		     int pou)
{
	const struct pou *first;

	if (options->pou && pou < 0) {
		fprintf(stderr, _("ladder-editor: %s has no POU called %.80s\n"),
			options->file, options->pou);
		return false;
	}
	if (!options->rung || options->original)
		return true;
	first = pou >= 0 ? &project->pou[pou] : project->pou_count ? project->pou : NULL;
	if (first && options->rung <= first->rung_count)
		return true;
	fprintf(stderr, _("ladder-editor: %s has no rung %d\n"), options->file,
		options->rung);
	return false;
}

static enum render_status write_svg(const struct picture *picture,
				    const struct render_options *options,
				    const struct theme *theme)
{
	char *svg = picture_svg(picture, theme, options->scale, true);
	GError *error = NULL;
	enum render_status status = RENDER_GOOD;

	if (!g_file_set_contents(options->out, svg, -1, &error)) {
		status = failed(options->out, error->message);
		g_error_free(error);
	}
	g_free(svg);
	return status;
}

static enum render_status write_png(const struct picture *picture,
				    const struct render_options *options,
				    const struct theme *theme, struct lettering *lettering)
{
	double scale = (double)options->scale;
	double width = (double)picture->width * scale;
	double height = (double)picture->height * scale;

	if (width > MOST_PIXELS || height > MOST_PIXELS)
		return failed(options->out, _("it would be too large; draw one POU or one "
					      "rung, or an .svg"));
	cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24,
							      (int)width, (int)height);
	cairo_t *cr = cairo_create(surface);
	gdk_cairo_set_source_rgba(cr, &theme->color[TOKEN_SHEET]);
	cairo_paint(cr);
	cairo_scale(cr, scale, scale);
	picture_cairo(picture, theme, lettering, cr);
	cairo_destroy(cr);
	cairo_status_t result = cairo_surface_write_to_png(surface, options->out);
	cairo_surface_destroy(surface);
	return result == CAIRO_STATUS_SUCCESS ? RENDER_GOOD :
		failed(options->out, cairo_status_to_string(result));
}

static enum render_status write_picture(struct picture *picture,
					const struct render_options *options,
					struct lettering *lettering)
{
	const struct theme *theme = theme_get(options->theme, THEME_GREEN);

	if (options->format == RENDER_SVG)
		return write_svg(picture, options, theme);
	return write_png(picture, options, theme, lettering);
}

/* The table of contents that a reader shows beside the pages: POUs, symbols. */
static void add_outline(cairo_surface_t *surface, const struct pages *pages, int page)
{
	const char *subject = pages_subject(pages, page);
	char place[32];

	if (page > 0 && strcmp(subject, pages_subject(pages, page - 1)) == 0)
		return;
	snprintf(place, sizeof(place), "page=%d", page + 1);
	cairo_pdf_surface_add_outline(surface, CAIRO_PDF_OUTLINE_ROOT, subject, place, 0);
}

/* A PDF names neither the day nor the machine it was made on. */
static enum render_status write_pdf(const struct project *project, int pou,
				    const struct render_options *options,
				    struct lettering *lettering)
{
	const struct paper *paper = &options->paper;
	struct pages *pages = pages_new(project, options->file, pou, options->rung,
					options->show, paper, lettering);
	double width = (double)(paper->landscape ? paper->height : paper->width);
	double height = (double)(paper->landscape ? paper->width : paper->height);
	cairo_surface_t *surface = cairo_pdf_surface_create(options->out, width / 25.4 * 72,
							    height / 25.4 * 72);
	cairo_t *cr = cairo_create(surface);
	const char *title = project_text(project, project->title);

	cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE,
				       "2000-01-01T00:00:00Z");
	cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE,
				       *title ? title : options->file);
	for (int page = 0; page < pages_count(pages); page++) {
		pages_paint(pages, page, cr);
		add_outline(surface, pages, page);
		cairo_show_page(cr);
	}
	cairo_destroy(cr);
	cairo_surface_finish(surface);
	cairo_status_t result = cairo_surface_status(surface);
	cairo_surface_destroy(surface);
	pages_free(pages);
	return result == CAIRO_STATUS_SUCCESS ? RENDER_GOOD :
		failed(options->out, cairo_status_to_string(result));
}

/* Rungs as they are, or were there. */
static bool draw_rungs(struct ladder *ladder, int pou, const struct render_options *options,
		       struct lettering *lettering, struct picture *picture)
{
	if (!options->original)
		render_sheets(ladder_project(ladder), pou, options, lettering, picture);
	else if (!render_classic(ladder, pou, options, lettering, picture))
		return false;
	return true;
}

static enum render_status draw(struct ladder *ladder, const struct render_options *options,
			       struct lettering *lettering)
{
	const struct project *project = ladder_project(ladder);
	int pou = options->pou ? find_pou(project, options->pou) : -1;
	enum render_status status;
	struct picture picture;

	if (!is_there(project, options, pou))
		return RENDER_WRONG;
	if (options->rung && pou < 0 && !options->original)
		pou = 0;
	if (options->format == RENDER_PDF)
		return write_pdf(project, pou, options, lettering);
	picture_init(&picture);
	if (draw_rungs(ladder, pou, options, lettering, &picture)) {
		status = write_picture(&picture, options, lettering);
	} else {
		fprintf(stderr, _("ladder-editor: %s: nothing of it comes from "
				  "ClassicLadder\n"), options->file);
		status = RENDER_WRONG;
	}
	picture_clear(&picture);
	return status;
}

static enum render_status draw_difference(const struct project *project,
					  const struct render_options *options,
					  struct lettering *lettering)
{
	enum render_status status;
	struct ladder *older = load(options->older, &status);
	struct picture picture;

	if (!older)
		return status;
	picture_init(&picture);
	render_diff(ladder_project(older), project, options, lettering, &picture);
	status = write_picture(&picture, options, lettering);
	picture_clear(&picture);
	ladder_free(older);
	return status;
}

int render_main(int argc, char **argv)
{
	struct render_options options;
	enum render_status status;

	if (!render_options_parse(argc, argv, &options))
		return RENDER_WRONG;
	if (options.help) {
		render_options_help();
		return RENDER_GOOD;
	}
	struct ladder *ladder = load(options.file, &status);
	if (!ladder)
		return (int)status;
	if (options.check) {
		status = ladder_build(ladder) ? RENDER_GOOD : RENDER_NO;
		say_diags(ladder_diags(ladder));
		options.diags = ladder_diags(ladder);
	}
	PangoContext *context = lettering_context();
	struct lettering *lettering = lettering_new(context, NULL);
	enum render_status drawn = options.older ?
		draw_difference(ladder_project(ladder), &options, lettering) :
		draw(ladder, &options, lettering);
	lettering_free(lettering);
	g_object_unref(context);
	ladder_free(ladder);
	return (int)(drawn == RENDER_GOOD ? status : drawn);
}
