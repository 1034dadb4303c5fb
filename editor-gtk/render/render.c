/* SPDX-License-Identifier: MIT
 *
 * render - `ladder-editor --render`: loads a project, draws it, writes a file.
 *
 * Everything is drawn by grid_draw and pages; what is compared by render_diff.
 */
#include "editor-gtk/render/render.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/draw/pages.h"
#include "editor-gtk/render/render_classic.h"
#include "editor-gtk/render/render_diff.h"
#include "editor-gtk/render/render_options.h"
#include "editor-gtk/render/render_sheet.h"
#include "engine/ladder.h"

#include <errno.h>
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

/* Whole, or what was there stays. @bytes: taken over; NULL: there was no memory for them. */
static enum render_status write_out(GBytes *bytes, const char *path)
{
	enum render_status status = RENDER_GOOD;
	GError *error = NULL;

	if (!bytes)
		return failed(path, g_strerror(ENOMEM));
	if (!disk_save(path, g_bytes_get_data(bytes, NULL), g_bytes_get_size(bytes), &error)) {
		fprintf(stderr, "ladder-editor: %s\n", error->message);
		g_error_free(error);
		status = RENDER_WRONG;
	}
	g_bytes_unref(bytes);
	return status;
}

static enum render_status write_svg(const struct picture *picture,
				    const struct render_options *options,
				    const struct theme *theme)
{
	char *svg = picture_svg(picture, theme, options->scale, true);

	return write_out(g_bytes_new_take(svg, strlen(svg)), options->out);
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
	return write_out(picture_png(picture, theme, lettering, options->scale),
			 options->out);
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

/* A PDF names neither the day nor the machine it was made on. */
static enum render_status write_pdf(const struct project *project, int pou,
				    const struct render_options *options,
				    struct lettering *lettering)
{
	struct pages *pages = pages_new(project, options->file, pou, options->rung,
					options->show, &options->paper, lettering);
	const char *title = project_text(project, project->title);
	GBytes *pdf = pages_pdf(pages, &options->paper, *title ? title : options->file,
				"2000-01-01T00:00:00Z");

	pages_free(pages);
	return write_out(pdf, options->out);
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
	int pou = options->pou ? project_find_pou(project, options->pou, strlen(options->pou)) : -1;
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
