/* SPDX-License-Identifier: MIT
 *
 * render_sheet - POUs below one another in one picture, or the original rungs of a
 * ClassicLadder project; see render_sheet.h.
 */
#include "editor-gtk/render/render_sheet.h"

#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/draw/sfc_bodies.h"
#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/base/name.h"

#include <glib.h>

#define HEADING   40
#define TEXT_LINE 17
#define SIDE      16 /* px beside a text                                        */

float render_heading(struct lettering *lettering, const char *text, float y,
		     struct picture *picture)
{
	struct lettered fits = lettering_fit(lettering, LETTER_HEADING, text, -1, 0);

	picture_move(picture, 0, y);
	picture_text(picture, TOKEN_INK, LETTER_HEADING, fits, SIDE, 27);
	picture_move(picture, 0, 0);
	picture_grow(picture, fits.width + 2 * SIDE, y + HEADING);
	return HEADING;
}

static float put_line(struct lettered text, float y, struct picture *picture)
{
	picture_text(picture, TOKEN_INK, LETTER_OPERAND, text, SIDE, y + 13);
	picture_grow(picture, text.width + 2 * SIDE, y + TEXT_LINE);
	return y + TEXT_LINE;
}

static float put_lines(char **lines, struct lettering *lettering, float y,
		       struct picture *picture)
{
	for (int i = 0; lines && lines[i]; i++) {
		GString *text = g_string_new(lines[i]);

		g_string_replace(text, "\t", "        ", 0);
		y = put_line(lettering_fit(lettering, LETTER_OPERAND, text->str, -1, 0), y,
			     picture);
		g_string_free(text, TRUE);
	}
	g_strfreev(lines);
	return y + TEXT_LINE;
}

/* Marks the diagnostics of this rung's cells. */
static int mark_wrong(const struct diag_list *diags, const struct rung_layout *layout,
		      const char *pou, struct grid_mark *mark)
{
	const struct rung *rung = layout->rung;
	int count = 0;

	for (int i = 0; diags && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		int row = diag->row - 1, col = diag->col - 1;

		if (!diag->pou || !name_equal(diag->pou, pou) ||
		    diag->rung != layout->number || row < 0 || row >= rung->rows ||
		    col < 0 || col >= rung->cols)
			continue;
		mark[count++] = (struct grid_mark){
			row, rung_layout_column(layout, row, col), grid_mark_of(diag) };
	}
	return count;
}

static struct sheet *new_sheet(const struct project *project, const struct pou *pou,
			       const struct render_options *options,
			       struct lettering *lettering)
{
	struct sheet *sheet = sheet_new(project, pou, lettering);

	sheet->drafting.show = options->show;
	sheet->drafting.width = options->width;
	sheet->drafting.all_comments = true;
	sheet_layout(sheet);
	return sheet;
}

float render_remarks(const struct sheet *sheet, int first, int end, const char *heading,
		     float y, struct picture *picture)
{
	struct lettering *lettering = sheet->drafting.lettering;
	GPtrArray *lines = g_ptr_array_new_with_free_func(g_free);

	for (int i = first; i < end; i++)
		sheet_remarks(sheet, i, lines);
	if (lines->len && heading)
		y += render_heading(lettering, heading, y, picture);
	for (guint i = 0; i < lines->len; i++)
		for (const char *text = g_ptr_array_index(lines, i); *text;)
			y = put_line(lettering_line(lettering, LETTER_OPERAND, &text,
						    sheet->width - 2 * SIDE, false), y,
				     picture);
	y += lines->len ? TEXT_LINE : 0;
	g_ptr_array_unref(lines);
	return y;
}

/* Draws rungs @first … @end - 1. */
static float put_rungs(const struct sheet *sheet, const struct render_options *options,
		       int first, int end, float y, struct picture *picture)
{
	const struct theme *theme = theme_get(options->theme, THEME_GREEN);
	const struct project *project = sheet->drafting.project;

	for (int i = first; i < end; i++) {
		struct grid_mark mark[LIMIT_DIAGS];
		int marks = mark_wrong(options->diags, sheet->rung[i],
				       project_text(project, sheet->pou->name), mark);
		struct grid_scene scene = { .drafting = &sheet->drafting,
					    .layout = sheet->rung[i], .theme = theme,
					    .mark = mark, .mark_count = marks };

		picture_move(picture, 0, y);
		grid_draw(&scene, picture);
		y += sheet->rung[i]->height;
		picture_grow(picture, sheet->width, y);
	}
	picture_move(picture, 0, 0);
	return render_remarks(sheet, first, end, _("Comments"), y, picture);
}

static float put_ladder(const struct project *project, const struct pou *pou,
			const struct render_options *options,
			struct lettering *lettering, float y, struct picture *picture)
{
	struct sheet *sheet = new_sheet(project, pou, options, lettering);

	y = put_rungs(sheet, options, options->rung ? options->rung - 1 : 0,
		      options->rung ? options->rung : pou->rung_count, y, picture);
	sheet_free(sheet);
	return y;
}

/* Marks the diagnostics of a chart, by the lines of steps and transitions. */
static int mark_chart(const struct diag_list *diags, const struct sfc_sheet *sheet,
		      struct sfc_mark *mark)
{
	int count = 0;

	for (int i = 0; diags && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		const char *name = project_text(sheet->project, sheet->pou->name);
		struct sfc_mark at;

		if (!diag->pou || !name_equal(diag->pou, name) ||
		    !sfc_sheet_of_diag(sheet, NULL, diag, &at.shape, &at.use))
			continue;
		at.signs = diag_severity(diag->id) == SEVERITY_ERROR ? SFC_ERROR :
								       SFC_WARNING;
		mark[count++] = at;
	}
	return count;
}

/* Draws a chart, and below it its bodies: rungs and lists. */
static float put_chart(const struct project *project, const struct pou *pou,
		       const struct render_options *options,
		       struct lettering *lettering, float y, struct picture *picture)
{
	struct sfc_sheet *chart = sfc_sheet_new(project, pou, lettering);
	struct sheet *sheet = NULL;
	struct sfc_mark mark[LIMIT_DIAGS];
	const struct sfc_scene scene = {
		.sheet = chart, .theme = theme_get(options->theme, THEME_GREEN),
		.mark = mark, .mark_count = mark_chart(options->diags, chart, mark) };
	struct sfc_part_body *bodies;
	int count;

	picture_move(picture, 0, y);
	sfc_draw(&scene, picture);
	picture_move(picture, 0, 0);
	y += chart->height;
	picture_grow(picture, chart->width, y);
	bodies = sfc_bodies_new(project, pou, &count);
	if (count)
		sheet = new_sheet(project, pou, options, lettering);
	for (int i = 0; i < count; i++) {
		const struct sfc_body *body = bodies[i].body;

		y += render_heading(lettering, bodies[i].heading, y, picture);
		if (body->kind == BODY_LIST || body->kind == BODY_ST)
			y = put_lines(sfc_body_lines(project, pou, body), lettering, y,
				      picture);
		else
			y = put_rungs(sheet, options, body->first,
				      body->first + body->count, y, picture);
	}
	sfc_bodies_free(bodies, count);
	sheet_free(sheet);
	sfc_sheet_free(chart);
	return y;
}

/* Marks the diagnostics of a network. */
static int mark_network(const struct diag_list *diags, const struct fbd_layout *layout, const char *pou,
			struct fbd_mark *mark)
{
	int count = 0;

	for (int i = 0; diags && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		struct fbd_mark at;

		if (!diag->pou || !name_equal(diag->pou, pou) ||
		    !fbd_layout_of_diag(layout, diag, &at.box, &at.pin))
			continue;
		at.marks = grid_mark_of(diag);
		mark[count++] = at;
	}
	return count;
}

static float put_networks(const struct project *project, const struct pou *pou, const struct render_options *options,
			  struct lettering *lettering, float y, struct picture *picture)
{
	const int first = options->rung ? options->rung - 1 : 0;
	const int count = fbd_layout_networks(pou), end = MIN(options->rung ? options->rung : count, count);
	struct fbd_layout **layout = g_new0(struct fbd_layout *, count + 1);
	float width = options->width;

	for (int i = first; i < end; i++) {
		layout[i] = fbd_layout_new(project, pou, i, lettering);
		width = MAX(width, layout[i]->width);
	}
	for (int i = first; i < end; i++) {
		struct fbd_mark mark[LIMIT_DIAGS];
		const struct fbd_scene scene = {
			.layout = layout[i], .theme = theme_get(options->theme, THEME_GREEN), .mark = mark,
			.mark_count = mark_network(options->diags, layout[i], project_text(project, pou->name), mark),
			.width = width };

		picture_move(picture, 0, y);
		fbd_draw(&scene, picture);
		y += layout[i]->height;
		picture_grow(picture, width, y);
		fbd_layout_free(layout[i]);
	}
	picture_move(picture, 0, 0);
	g_free(layout);
	return y;
}

void render_sheets(const struct project *project, int pou,
		   const struct render_options *options, struct lettering *lettering,
		   struct picture *picture)
{
	bool several = pou < 0 && project->pou_count > 1;
	float y = 0;

	picture_grow(picture, 1, 1);
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *one = &project->pou[i];
		char *heading;

		if (pou >= 0 && pou != i)
			continue;
		heading = g_strdup_printf("%s %s", pou_word(one->kind),
					  project_text(project, one->name));
		if (several)
			y += render_heading(lettering, heading, y, picture);
		g_free(heading);
		if (one->language == LANGUAGE_IL || one->language == LANGUAGE_ST)
			y = put_lines(listing_il(project, one), lettering, y + 8,
				      picture);
		else if (one->fbd)
			y = put_networks(project, one, options, lettering, y, picture);
		else if (one->sfc && !options->rung)
			y = put_chart(project, one, options, lettering, y, picture);
		else
			y = put_ladder(project, one, options, lettering, y, picture);
	}
	picture_grow(picture, 1, y);
}

/* ---- rungs of ClassicLadder ---- */

struct before {
	struct ladder *ladder;
	const struct render_options *options;
	struct lettering *lettering;
	struct picture *picture;
	float y;
};

/* The rungs of @pou that come from @rung; GArray of int. */
static GArray *became(const struct before *of, int pou, const struct classic_rung *rung)
{
	const struct project *project = ladder_project(of->ladder);
	GArray *all = g_array_new(FALSE, FALSE, sizeof(int));

	for (int i = 0; i < project->pou[pou].rung_count; i++)
		if (ladder_import_rung(of->ladder, pou, i) == rung)
			g_array_append_val(all, i);
	return all;
}

static void put_pair(struct before *of, int pou, const struct classic_rung *rung)
{
	GArray *ours = became(of, pou, rung);
	const struct classic_pair pair = {
		.there = { ladder_import_project(of->ladder), rung, of->lettering,
			   theme_get(of->options->theme, THEME_GREEN) },
		.there_name = *rung->place.member ? rung->place.member : of->options->file,
		.project = ladder_project(of->ladder), .pou = pou,
		.rung = &g_array_index(ours, int, 0),
		.rungs = of->options->original == ORIGINAL_BOTH ? (int)ours->len : 0,
		.show = of->options->show,
	};

	of->y = grid_classic_pair(&pair, of->y, of->picture);
	g_array_unref(ours);
}

static void put_pou(struct before *of, int pou)
{
	const struct pou *one = &ladder_project(of->ladder)->pou[pou];
	const struct classic_rung *last = NULL;

	for (int i = 0; i < one->rung_count; i++) {
		const struct classic_rung *rung = ladder_import_rung(of->ladder, pou, i);

		if (!rung || rung == last ||
		    (of->options->rung && of->options->rung != i + 1))
			continue;
		put_pair(of, pou, rung);
		last = rung;
	}
}

bool render_classic(struct ladder *ladder, int pou, const struct render_options *options,
		    struct lettering *lettering, struct picture *picture)
{
	struct before of = { ladder, options, lettering, picture, 0 };

	if (!ladder_import_project(ladder))
		return false;
	for (int i = 0; i < ladder_project(ladder)->pou_count; i++)
		/* A number without a POU means the first POU with such a rung. */
		if (pou == i || (pou < 0 && (!options->rung || of.y <= 0)))
			put_pou(&of, i);
	picture_grow(picture, 1, of.y);
	return of.y > 0;
}
