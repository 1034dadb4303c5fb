/* SPDX-License-Identifier: MIT
 *
 * compare_sides - see compare_sides.h. Both sides of a rung have the same columns and the
 * same width, so that a cell is at the same place in both.
 */
#include "editor-gtk/panels/compare_sides.h"

#include "editor-gtk/draw/diff_draw.h"
#include "editor-gtk/draw/diff_networks.h"
#include "editor-gtk/kit/i18n.h"

#include <string.h>

#define EDGE   12 /* px around texts                                           */
#define AROUND 40 /* lines of a list before and after the piece that is shown  */
#define TINT   0.10f
#define RUNGS_MOST 60 /* of a whole POU                                       */
#define CHART_Y 60 /* px above the part of a chart that is shown                */

/* One side of a drawing. */
struct side {
	const struct comparison *of;
	const struct compare_row *row;
	bool newer;
	enum drafting_show show;
	struct picture *picture;
	struct lettering *lettering;
};

static const struct project *project_of(const struct side *side, bool newer)
{
	return ladder_project(newer ? side->of->of_b : side->of->of_a);
}

static const struct pou *pou_of(const struct side *side, bool newer)
{
	const int pou = newer ? side->row->pou_b : side->row->pou_a;

	return pou < 0 ? NULL : &project_of(side, newer)->pou[pou];
}

static float put_note(const struct side *side, const char *text, float y)
{
	struct lettered fits = lettering_fit(side->lettering, LETTER_COMMENT, text, -1, 0);

	picture_text(side->picture, TOKEN_COMMENT, LETTER_COMMENT, fits, EDGE, y + 24);
	picture_grow(side->picture, fits.width + 2 * EDGE, y + 40);
	return y + 40;
}

/* ---- rungs ---- */

static const struct rung *rung_of(const struct side *side, bool newer)
{
	const struct pou *pou = pou_of(side, newer);
	const int at = newer ? side->row->at_b : side->row->at_a;

	return pou && pou->language == LANGUAGE_LD && at >= 0 && at < pou->rung_count ?
	       pou->rung[at] : NULL;
}

struct laid {
	struct drafting drafting;
	struct rung_layout *layout;
};

static struct laid lay_out(const struct side *side, bool newer, const struct rung *rung,
			   int number, int columns, float width)
{
	const struct project *project = project_of(side, newer);
	struct laid laid = { .drafting = { .project = project,
		.names = grid_names_new(project, pou_of(side, newer)),
		.lettering = side->lettering, .show = side->show, .all_comments = true,
		.beside = DIFF_ROOM, .columns = columns, .width = width } };

	laid.layout = rung_layout_new(&laid.drafting, rung, number, 0);
	rung_layout_stretch(laid.layout, width);
	return laid;
}

static void laid_clear(struct laid *laid)
{
	rung_layout_free(laid->layout);
	grid_names_free((struct grid_names *)laid->drafting.names);
}

static float natural(const struct side *side, bool newer, const struct rung *rung, int columns)
{
	struct laid laid;
	float width;

	if (!rung)
		return 0;
	laid = lay_out(side, newer, rung, 1, columns, 0);
	width = laid.layout->natural;
	laid_clear(&laid);
	return width;
}

static void put_scene(const struct side *side, const struct laid *laid, unsigned int state,
		      const struct grid_mark *mark, int marks, float y)
{
	const struct grid_scene scene = { .drafting = &laid->drafting,
		.layout = laid->layout, .theme = theme_screen(), .mark = mark,
		.mark_count = marks, .state = state };

	picture_move(side->picture, 0, y);
	grid_draw(&scene, side->picture);
	picture_move(side->picture, 0, 0);
	picture_grow(side->picture, rung_layout_width(laid->layout),
		     y + laid->layout->height);
}

static float put_rung(const struct side *side)
{
	const struct rung *a = rung_of(side, false), *b = rung_of(side, true);
	const struct rung *own = side->newer ? b : a;
	const int columns = MAX(a ? rung_layout_columns(a) : 0, b ? rung_layout_columns(b) : 0);
	const float width = MAX(natural(side, false, a, columns), natural(side, true, b, columns));
	const struct diff_rungs rungs = { project_of(side, false), project_of(side, true), a, b };
	struct grid_mark mark[DIFF_MARKS];
	struct laid laid;
	int marks = 0;

	if (!own)
		return put_note(side, _("not there"), 0);
	laid = lay_out(side, side->newer, own, (side->newer ? side->row->at_b :
						 side->row->at_a) + 1, columns, width);
	if (a && b)
		marks = diff_mark_cells(&rungs, laid.layout, mark);
	put_scene(side, &laid, (side->newer ? RUNG_ADDED : RUNG_REMOVED) |
		  (a && b ? RUNG_CHANGED : 0), mark, marks, 0);
	laid_clear(&laid);
	return 0;
}

static float put_rungs(const struct side *side, const struct pou *pou)
{
	const int count = MIN(pou->rung_count, RUNGS_MOST);
	char *more = g_strdup_printf(ngettext("and %d more rung", "and %d more rungs",
		(gulong)(pou->rung_count - count)), pou->rung_count - count);
	float y = 0;

	for (int i = 0; i < count; i++) {
		struct laid laid = lay_out(side, side->newer, pou->rung[i], i + 1,
					   rung_layout_columns(pou->rung[i]), 0);

		put_scene(side, &laid, side->newer ? RUNG_ADDED : RUNG_REMOVED, NULL, 0, y);
		y += laid.layout->height;
		laid_clear(&laid);
	}
	if (count < pou->rung_count)
		put_note(side, more, y);
	g_free(more);
	return 0;
}

/* ---- charts ---- */

static struct sfc_sheet *chart_of(const struct side *side, bool newer)
{
	const struct pou *pou = pou_of(side, newer);

	return pou && pou->sfc ? sfc_sheet_new(project_of(side, newer), pou, side->lettering) :
				 NULL;
}

static float put_chart(const struct side *side)
{
	struct sfc_sheet *a = chart_of(side, false), *b = chart_of(side, true);
	struct sfc_sheet *own = side->newer ? b : a;
	GArray *removed = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	GArray *added = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	const int shape = side->newer ? side->row->at_b : side->row->at_a;
	float y = 0;

	if (a && b)
		diff_mark_charts(a, b, removed, added);
	if (own)
		diff_draw_chart(own, side->newer ? added : removed, side->newer,
				theme_screen(), 0, side->picture);
	else
		put_note(side, _("not there"), 0);
	if (own && shape >= 0 && shape < own->layout->shape_count)
		y = MAX(sfc_sheet_box(own, shape).origin.y - CHART_Y, 0);
	g_array_unref(removed);
	g_array_unref(added);
	g_clear_pointer(&a, sfc_sheet_free);
	g_clear_pointer(&b, sfc_sheet_free);
	return y;
}

/* ---- networks ---- */

static struct fbd_layout *network_of(const struct side *side, bool newer, int at)
{
	const struct pou *pou = pou_of(side, newer);

	return pou && pou->fbd && at >= 0 && at < fbd_layout_networks(pou) ?
	       fbd_layout_new(project_of(side, newer), pou, at, side->lettering) : NULL;
}

static void put_layout(const struct side *side, const struct fbd_layout *layout, unsigned int state,
		       const GArray *marks, float y)
{
	const struct fbd_scene scene = { .layout = layout, .theme = theme_screen(),
		.mark = marks ? (const struct fbd_mark *)marks->data : NULL,
		.mark_count = marks ? (int)marks->len : 0,
		.state = state | (side->newer ? RUNG_ADDED : RUNG_REMOVED) };

	picture_move(side->picture, 0, y);
	fbd_draw(&scene, side->picture);
	picture_move(side->picture, 0, 0);
	picture_grow(side->picture, layout->width, y + layout->height);
}

static float put_network(const struct side *side)
{
	struct fbd_layout *a = network_of(side, false, side->row->at_a), *b = network_of(side, true, side->row->at_b);
	const struct fbd_layout *own = side->newer ? b : a, *other = side->newer ? a : b;
	GArray *marks = own && other ? diff_mark_boxes(&own->graph, &other->graph) : NULL;

	if (own)
		put_layout(side, own, other ? RUNG_CHANGED : 0, marks, 0);
	else
		put_note(side, _("not there"), 0);
	g_clear_pointer(&marks, g_array_unref);
	fbd_layout_free(a);
	fbd_layout_free(b);
	return 0;
}

static float put_networks(const struct side *side, const struct pou *pou)
{
	const int count = MIN(fbd_layout_networks(pou), RUNGS_MOST), more = fbd_layout_networks(pou) - count;
	char *text = g_strdup_printf(ngettext("and %d more network", "and %d more networks", (gulong)more), more);
	float y = 0;

	for (int i = 0; i < count; i++) {
		struct fbd_layout *layout = network_of(side, side->newer, i);

		put_layout(side, layout, 0, NULL, y);
		y += layout->height;
		fbd_layout_free(layout);
	}
	if (more)
		put_note(side, text, y);
	g_free(text);
	return 0;
}

/* ---- lists ---- */

struct listing {
	const struct side *side;
	int at, row;     /* the piece that is shown: its first line; lines so far */
	int first;       /* line of the merged text where it begins; -1: not met */
	GArray *line;    /* struct compare_line; texts in @texts                */
	GStringChunk *texts;
};

static void take_line(void *context, struct compare_line line)
{
	struct listing *listing = context;
	const struct compare_row *row = listing->side->row;

	if (listing->first < 0 && ((row->at_a >= 0 && line.line_a == row->at_a + 1) ||
				   (row->at_b >= 0 && line.line_b == row->at_b + 1)) &&
	    (!line.line_a || !line.line_b || (row->at_a < 0 && row->at_b < 0)))
		listing->first = (int)listing->line->len;
	line.text = g_string_chunk_insert(listing->texts, line.text);
	g_array_append_val(listing->line, line);
}

/* The line as this side has it; false: only the other one has it. */
static bool own_line(const struct side *side, struct compare_line *line)
{
	const bool same = line->line_a && line->line_b;
	const int number = side->newer ? line->line_b : line->line_a;

	line->line_a = same || !side->newer ? number : 0;
	line->line_b = same || side->newer ? number : 0;
	return number > 0;
}

/* The POU of a version for compare_lines(); -1: it is none in the language of this side. */
static int list_of(const struct side *side, bool newer)
{
	const struct pou *pou = pou_of(side, newer), *own = pou_of(side, side->newer);

	return !pou || !own || pou->language != own->language ? -1 :
	       newer ? side->row->pou_b : side->row->pou_a;
}

static float put_lines(const struct side *side)
{
	struct listing listing = { .side = side, .first = -1,
		.line = g_array_new(FALSE, FALSE, sizeof(struct compare_line)),
		.texts = g_string_chunk_new(4096) };
	const struct pou *pou = pou_of(side, side->newer);
	int from, to;
	float y = EDGE;

	if (!pou)
		put_note(side, _("not there"), 0);
	else
		compare_lines(project_of(side, false), list_of(side, false),
			      project_of(side, true), list_of(side, true), take_line, &listing);
	from = MAX(listing.first - AROUND, 0);
	to = MIN(MAX(listing.first, 0) + 2 * AROUND, (int)listing.line->len);
	for (int i = from; i < to; i++, y += DIFF_LINE) {
		struct compare_line line = g_array_index(listing.line, struct compare_line, i);

		if (own_line(side, &line))
			diff_draw_line(side->lettering, &line, y, side->picture);
	}
	picture_grow(side->picture, 1, y + EDGE);
	g_array_unref(listing.line);
	g_string_chunk_free(listing.texts);
	return (float)((MAX(listing.first, 0) - from) * DIFF_LINE) - CHART_Y;
}

/* ---- texts ---- */

static float put_texts(const struct side *side)
{
	const struct compare_row *row = side->row;
	float y = EDGE;

	for (guint i = 0; i < row->details->len; i++) {
		const struct compare_detail *detail = &g_array_index(row->details,
			struct compare_detail, i);
		const char *text = side->newer ? detail->to : detail->from;
		char *line = g_strdup_printf("%s%s%s", detail->label, *detail->label ? _(": ") : "",
					     *text ? text : _("nothing"));
		const enum token token = side->newer ? TOKEN_POWER : TOKEN_ERROR;

		if (*text) {
			struct lettered fits = lettering_fit(side->lettering, LETTER_OPERAND,
							     line, -1, 0);

			picture_fill(side->picture, token, TINT, 0, y,
				     40 + fits.width + DIFF_SIGN_X, DIFF_LINE);
			diff_draw_text(side->lettering, token, side->newer ? "+" :
				       "\xe2\x88\x92", DIFF_SIGN_X, y, side->picture);
		}
		diff_draw_text(side->lettering, *text ? TOKEN_INK : TOKEN_COMMENT, line, 40, y,
			       side->picture);
		g_free(line);
		y += DIFF_LINE + 4;
	}
	picture_grow(side->picture, 1, y + EDGE);
	return 0;
}

static float put_pou(const struct side *side)
{
	const struct pou *pou = pou_of(side, side->newer);

	if (!pou)
		return put_note(side, _("not there"), 0);
	if (pou->sfc)
		return put_chart(side);
	if (pou->fbd)
		return put_networks(side, pou);
	return pou->language == LANGUAGE_LD ? put_rungs(side, pou) : put_lines(side);
}

float compare_side_draw(const struct comparison *of, const struct compare_row *row, bool newer,
			enum drafting_show show, struct picture *picture,
			struct lettering *lettering)
{
	const struct side side = { of, row, newer, show, picture, lettering };

	switch (row->shows) {
	case COMPARE_SHOWS_RUNG: return put_rung(&side);
	case COMPARE_SHOWS_CHART: return put_chart(&side);
	case COMPARE_SHOWS_NETWORK: return put_network(&side);
	case COMPARE_SHOWS_LINES: return MAX(put_lines(&side), 0);
	case COMPARE_SHOWS_POU: return MAX(put_pou(&side), 0);
	case COMPARE_SHOWS_TEXT: break;
	}
	return put_texts(&side);
}
