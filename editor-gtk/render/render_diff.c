/* SPDX-License-Identifier: MIT
 *
 * render_diff - a comparison of two projects as one picture: rungs, lists, charts and, as
 * text, everything else. The engine finds the pairs of rungs (compare_rungs).
 */
#include "editor-gtk/render/render_diff.h"

#include "editor-gtk/draw/diff_draw.h"
#include "editor-gtk/draw/diff_networks.h"
#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/render/render_sheet.h"

#include "engine/base/name.h"
#include "engine/compare/compare.h"

#include <string.h>
#include <strings.h>

#define AROUND     3    /* unchanged lines that are shown before and after a change */

#define DOTS  "\xe2\x80\xa6"

/* ---- lists, charts, declarations ---- */

struct listed {
	GArray *line;           /* struct compare_line; owns the texts              */
	GStringChunk *texts;
};

static void take_line(void *context, struct compare_line line)
{
	struct listed *listed = context;

	line.text = g_string_chunk_insert(listed->texts, line.text);
	g_array_append_val(listed->line, line);
}

static bool is_same(const struct compare_line *line)
{
	return line->line_a && line->line_b;
}

/* Is a changed line near enough to show this one? */
static bool is_shown(const GArray *lines, int index)
{
	const int from = MAX(0, index - AROUND), to = MIN((int)lines->len - 1,
							  index + AROUND);

	for (int i = from; i <= to; i++)
		if (!is_same(&g_array_index(lines, struct compare_line, i)))
			return true;
	return false;
}

static float put_lines(const struct project *a, int pou_a, const struct project *b,
			int pou_b, struct lettering *lettering, float y,
			struct picture *picture)
{
	struct listed listed = { g_array_new(FALSE, FALSE, sizeof(struct compare_line)),
				 g_string_chunk_new(4096) };
	bool left_out = false;

	compare_lines(a, pou_a, b, pou_b, take_line, &listed);
	for (int i = 0; i < (int)listed.line->len; i++) {
		if (!is_shown(listed.line, i)) {
			if (!left_out)
				diff_draw_text(lettering, TOKEN_COMMENT, DOTS, DIFF_TEXT_X,
					       y, picture);
			y += left_out ? 0 : DIFF_LINE;
			left_out = true;
			continue;
		}
		left_out = false;
		diff_draw_line(lettering, &g_array_index(listed.line, struct compare_line, i),
			       y, picture);
		y += DIFF_LINE;
	}
	g_array_unref(listed.line);
	g_string_chunk_free(listed.texts);
	return y + DIFF_LINE;
}

static float put_charts(const struct project *a, int pou_a, const struct project *b,
			 int pou_b, const struct render_options *options,
			 struct lettering *lettering, float y, struct picture *picture)
{
	struct sfc_sheet *before = pou_a < 0 ? NULL :
		sfc_sheet_new(a, &a->pou[pou_a], lettering);
	struct sfc_sheet *after = pou_b < 0 ? NULL :
		sfc_sheet_new(b, &b->pou[pou_b], lettering);
	const struct theme *theme = theme_get(options->theme, THEME_GREEN);
	GArray *removed = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	GArray *added = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));

	if (before && after)
		diff_mark_charts(before, after, removed, added);
	if (before)
		y = diff_draw_chart(before, removed, false, theme, y, picture);
	if (after)
		y = diff_draw_chart(after, added, true, theme, y, picture);
	g_array_unref(removed);
	g_array_unref(added);
	if (before)
		sfc_sheet_free(before);
	if (after)
		sfc_sheet_free(after);
	return y;
}

/* ---- networks ---- */

static float put_network(const struct project *project, const struct pou *pou, int index, unsigned int state,
			 const struct theme *theme, struct lettering *lettering, float y, struct picture *picture)
{
	struct fbd_layout *layout = fbd_layout_new(project, pou, index, lettering);
	const struct fbd_scene scene = { .layout = layout, .theme = theme, .state = state };

	picture_move(picture, 0, y);
	fbd_draw(&scene, picture);
	picture_move(picture, 0, 0);
	y += layout->height;
	picture_grow(picture, layout->width, y);
	fbd_layout_free(layout);
	return y;
}

static float put_besides(const struct project *a, const struct project *b,
			  const struct render_options *options,
			  struct lettering *lettering, float y, struct picture *picture)
{
	struct sink_memory memory;
	struct sink sink;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (compare_besides(a, b, options->pou, &sink) > 0) {
		char **lines = g_strsplit(sink_memory_text(&memory), "\n", -1);

		y += render_heading(lettering, _("Outside the rungs"), y, picture);
		for (int i = 0; lines[i] && *lines[i]; i++, y += DIFF_LINE)
			diff_draw_text(lettering, TOKEN_INK, lines[i], DIFF_SIGN_X, y,
				       picture);
		g_strfreev(lines);
		y += DIFF_LINE;
		picture_grow(picture, 1, y);
	}
	sink_memory_free(&memory);
	return y;
}

/* ---- rungs ---- */

struct comparison {
	const struct project *a, *b;
	const struct render_options *options;
	struct lettering *lettering;
	struct picture *picture;
	struct sheet *before, *after; /* of the two POUs; NULL: there is none */
	int pou_a, pou_b;
	bool headed;                  /* the heading of the POU is drawn          */
	float y;
};

static const struct pou *pou_of(const struct project *project, int index)
{
	return index < 0 ? NULL : &project->pou[index];
}

static struct sheet *sheet_of(const struct comparison *of, const struct project *project,
			      int index)
{
	const struct pou *pou = pou_of(project, index);

	if (!pou || pou->language != LANGUAGE_LD)
		return NULL;
	struct sheet *sheet = sheet_new(project, pou, of->lettering);
	sheet->drafting.show = of->options->show;
	sheet->drafting.width = of->options->width;
	sheet->drafting.all_comments = true;
	sheet->drafting.beside = DIFF_ROOM;
	sheet_layout(sheet);
	return sheet;
}

/* Both versions get the same width. */
static void start_pou(struct comparison *of, struct compare_pair pair)
{
	sheet_free(of->before);
	sheet_free(of->after);
	of->pou_a = pair.pou_a;
	of->pou_b = pair.pou_b;
	of->headed = false;
	of->before = sheet_of(of, of->a, pair.pou_a);
	of->after = sheet_of(of, of->b, pair.pou_b);
	float rails = MAX(of->before ? of->before->rails : 0,
			  of->after ? of->after->rails : 0);
	for (int i = 0; of->before && i < of->before->count; i++)
		rung_layout_stretch(of->before->rung[i], rails);
	for (int i = 0; of->after && i < of->after->count; i++)
		rung_layout_stretch(of->after->rung[i], rails);
}

static void name_pou(struct comparison *of, const char *said)
{
	const struct project *project = of->pou_b < 0 ? of->a : of->b;
	const struct pou *pou = pou_of(project, of->pou_b < 0 ? of->pou_a : of->pou_b);
	const char *change = of->pou_a < 0 ? _("added") :
			     of->pou_b < 0 ? _("removed") : said;
	char *heading = g_strdup_printf("%s %s%s%s", pou_word(pou->kind),
					project_text(project, pou->name),
					*change ? _(": ") : "", change);

	if (!of->headed)
		of->y += render_heading(of->lettering, heading, of->y, of->picture);
	of->headed = true;
	g_free(heading);
}

static void put_rung(struct comparison *of, const struct sheet *sheet, int index,
		     unsigned int state, const struct grid_mark *mark, int marks)
{
	struct grid_scene scene = {
		.drafting = &sheet->drafting, .layout = sheet->rung[index],
		.theme = theme_get(of->options->theme, THEME_GREEN),
		.mark = mark, .mark_count = marks, .state = state,
	};

	name_pou(of, "");
	picture_move(of->picture, 0, of->y);
	grid_draw(&scene, of->picture);
	picture_move(of->picture, 0, 0);
	of->y += sheet->rung[index]->height;
	picture_grow(of->picture, rung_layout_width(sheet->rung[index]), of->y);
	of->y = render_remarks(sheet, index, index + 1, NULL, of->y, of->picture);
}

static void put_changed(struct comparison *of, struct compare_pair pair)
{
	const struct rung_layout *before = of->before->rung[pair.rung_a];
	const struct rung_layout *after = of->after->rung[pair.rung_b];
	struct grid_mark *mark = g_new(struct grid_mark, DIFF_MARKS);
	const struct diff_rungs rungs = { of->a, of->b, before->rung, after->rung };
	int marks = diff_mark_cells(&rungs, before, mark);

	put_rung(of, of->before, pair.rung_a, RUNG_REMOVED | RUNG_CHANGED, mark, marks);
	marks = diff_mark_cells(&rungs, after, mark);
	put_rung(of, of->after, pair.rung_b, RUNG_ADDED | RUNG_CHANGED, mark, marks);
	g_free(mark);
}

static void put_moved(struct comparison *of, struct compare_pair pair)
{
	char *said = g_strdup_printf(_("Rung %d moved to %d"), pair.rung_a + 1,
				     pair.rung_b + 1);
	struct lettered fits = lettering_fit(of->lettering, LETTER_TITLE, said, -1, 0);

	name_pou(of, "");
	picture_text(of->picture, TOKEN_FORCE, LETTER_TITLE, fits, RUNG_LEFT, of->y + 20);
	of->y += 32;
	picture_grow(of->picture, fits.width + RUNG_LEFT, of->y);
	g_free(said);
}

/* The networks that differ, both versions of a changed one below each other; false: none is drawn. */
static bool put_pou_networks(struct comparison *of, int pou_a, int pou_b)
{
	const struct theme *theme = theme_get(of->options->theme, THEME_GREEN);
	const struct pou *a = pou_of(of->a, pou_a), *b = pou_of(of->b, pou_b);
	GArray *parts = diff_networks(of->a, a, of->b, b);
	const bool any = parts->len > 0;

	for (guint i = 0; i < parts->len; i++) {
		const struct diff_network *part = &g_array_index(parts, struct diff_network, i);

		if (part->a >= 0)
			of->y = put_network(of->a, a, part->a, RUNG_REMOVED, theme, of->lettering, of->y, of->picture);
		if (part->b >= 0)
			of->y = put_network(of->b, b, part->b, RUNG_ADDED, theme, of->lettering, of->y, of->picture);
	}
	g_array_unref(parts);
	return any;
}

/* A POU that only one project has, or that has another language. */
static void put_all(struct comparison *of, bool added)
{
	const struct project *project = added ? of->b : of->a;
	const int index = added ? of->pou_b : of->pou_a;
	const struct pou *pou = pou_of(project, index);

	if (!pou)
		return;
	for (int i = 0; pou->language == LANGUAGE_LD && i < pou->rung_count; i++)
		put_rung(of, added ? of->after : of->before, i,
			 added ? RUNG_ADDED : RUNG_REMOVED, NULL, 0);
	if (pou->language == LANGUAGE_LD ||
	    (pou->fbd && put_pou_networks(of, added ? -1 : index, added ? index : -1)))
		return;
	if (pou->sfc)
		of->y = put_charts(of->a, added ? -1 : index, of->b,
					   added ? index : -1, of->options, of->lettering,
					   of->y, of->picture);
	of->y = put_lines(of->a, added ? -1 : index, of->b, added ? index : -1,
				  of->lettering, of->y, of->picture);
}

/* Lists and charts, and POUs whose language changed. */
static void put_other(struct comparison *of)
{
	const struct pou *a = pou_of(of->a, of->pou_a), *b = pou_of(of->b, of->pou_b);

	if (!a || !b || a->language != b->language) {
		char *said = a && b ? g_strdup_printf("%s \xe2\x86\x92 %s",
			pou_language_word(a->language), pou_language_word(b->language)) :
			g_strdup("");

		name_pou(of, said);
		put_all(of, false);
		put_all(of, true);
		g_free(said);
		return;
	}
	if (a->fbd) {
		name_pou(of, "");
		if (put_pou_networks(of, of->pou_a, of->pou_b))
			return;
	}
	name_pou(of, a->sfc ? _("the chart differs") : _("the instruction list differs"));
	if (a->sfc && b->sfc)
		of->y = put_charts(of->a, of->pou_a, of->b, of->pou_b, of->options,
					   of->lettering, of->y, of->picture);
	of->y = put_lines(of->a, of->pou_a, of->b, of->pou_b, of->lettering, of->y,
				  of->picture);
}

static void take_pair(void *context, struct compare_pair pair)
{
	struct comparison *of = context;
	const char *wanted = of->options->pou;
	const struct project *project = pair.pou_b < 0 ? of->a : of->b;
	const struct pou *pou = pou_of(project, pair.pou_b < 0 ? pair.pou_a : pair.pou_b);

	if (wanted && !name_equal(wanted, project_text(project, pou->name)))
		return;
	if (pair.pou_a != of->pou_a || pair.pou_b != of->pou_b)
		start_pou(of, pair);
	if (pair.rung_a < 0 && pair.rung_b < 0) {
		if (pair.changed)
			put_other(of);
		return;
	}
	if (pair.moved)
		put_moved(of, pair);
	if (!pair.changed)
		return;
	if (pair.rung_b < 0)
		put_rung(of, of->before, pair.rung_a, RUNG_REMOVED, NULL, 0);
	else if (pair.rung_a < 0)
		put_rung(of, of->after, pair.rung_b, RUNG_ADDED, NULL, 0);
	else
		put_changed(of, pair);
}

void render_diff(const struct project *a, const struct project *b,
		 const struct render_options *options, struct lettering *lettering,
		 struct picture *picture)
{
	struct comparison of = { .a = a, .b = b, .options = options, .pou_a = -2,
				 .pou_b = -2, .lettering = lettering, .picture = picture };

	compare_rungs(a, b, take_pair, &of);
	if (of.y <= 0)
		of.y += render_heading(lettering, _("No rung differs"), 0, picture);
	of.y = put_besides(a, b, options, lettering, of.y, picture);
	picture_grow(picture, 1, of.y);
	sheet_free(of.before);
	sheet_free(of.after);
}
