/* SPDX-License-Identifier: MIT
 *
 * render_diff - the rungs that differ, in one picture; see render_diff.h. Which of them
 * belong together is the engine's to say (compare_rungs). What is no rung is
 * render_diff_lines.c.
 */
#include "editor-gtk/render/render_diff.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/render/render_diff_lines.h"
#include "editor-gtk/render/render_sheet.h"
#include "engine/compare/compare.h"

#include <string.h>
#include <strings.h>

#define MOST_MARKS 512
#define MARK_ROOM  16 /* px that the mark of a changed cell takes of its lower edge */

struct comparison {
	const struct project *a, *b;
	const struct render_options *options;
	struct lettering *lettering;
	struct picture *picture;
	struct sheet *before, *after; /* of the POUs of the pair; NULL: there is none */
	int pou_a, pou_b;
	bool headed;                  /* the POU is named already                 */
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
	sheet->drafting.beside = MARK_ROOM;
	sheet_layout(sheet);
	return sheet;
}

/* The same width for what was and what is. */
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
					*change ? ": " : "", change);

	if (!of->headed)
		of->y += render_heading(of->lettering, heading, of->y, of->picture);
	of->headed = true;
	g_free(heading);
}

static bool same_text(const struct comparison *of, uint32_t a, uint32_t b)
{
	return strcmp(project_text(of->a, a), project_text(of->b, b)) == 0;
}

static bool same_cell(const struct comparison *of, const struct cell *a,
		      const struct cell *b)
{
	const char *word_a = words_row(&of->a->words, a->word)->word;
	const char *word_b = words_row(&of->b->words, b->word)->word;

	return strcasecmp(word_a, word_b) == 0 && a->link == b->link &&
	       same_text(of, a->operand, b->operand) && same_text(of, a->args, b->args) &&
	       same_text(of, a->comment, b->comment);
}

/* Has it a column of outputs? That one is drawn at the right, however far it is. */
static bool has_outputs(const struct rung *rung)
{
	bool has = false;

	for (int row = 0; row < rung->rows && !has; row++) {
		const enum word word = (enum word)rung_at(rung, row, rung->cols - 1)->word;

		has = !word_is_own(word) && word_row(word)->place == PLACE_LAST;
	}
	return has;
}

/* The cell of @rung where @own, which may be wider or narrower, has this one. */
static const struct cell *cell_like(const struct rung *rung, const struct rung *own,
				    int row, int col, bool outputs)
{
	static const struct cell nothing = { .word = ELEM_EMPTY };
	static const struct cell wire = { .word = ELEM_WIRE };

	if (row >= rung->rows)
		return &nothing;
	if (outputs && col == own->cols - 1)
		return rung_at(rung, row, rung->cols - 1);
	if (col < rung->cols - outputs)
		return rung_at(rung, row, col);
	/* Wire that only leads on to an output that is farther away is the same. */
	return outputs && rung_at(own, row, col)->word == ELEM_WIRE ? &wire : &nothing;
}

/* Marks of the cells of @layout that the other rung has otherwise or has not. */
static int mark_cells(const struct comparison *of, const struct rung *a,
		      const struct rung *b, const struct rung_layout *layout,
		      struct grid_mark *mark)
{
	const struct rung *own = layout->rung;
	const bool outputs = has_outputs(a) && has_outputs(b);
	int count = 0;

	for (int row = 0; row < own->rows; row++)
		for (int col = 0; col < own->cols && count < MOST_MARKS; col++) {
			const struct cell *x = cell_like(a, own, row, col, outputs);
			const struct cell *y = cell_like(b, own, row, col, outputs);

			if (!same_cell(of, x, y))
				mark[count++] = (struct grid_mark){
					row, rung_layout_column(layout, row, col),
					MARK_CHANGED };
		}
	return count;
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
	render_grow(of->picture, rung_layout_width(sheet->rung[index]), of->y);
	of->y = render_remarks(sheet, index, index + 1, NULL, of->y, of->picture);
}

static void put_changed(struct comparison *of, struct compare_pair pair)
{
	const struct rung_layout *before = of->before->rung[pair.rung_a];
	const struct rung_layout *after = of->after->rung[pair.rung_b];
	struct grid_mark *mark = g_new(struct grid_mark, MOST_MARKS);
	int marks = mark_cells(of, before->rung, after->rung, before, mark);

	put_rung(of, of->before, pair.rung_a, RUNG_REMOVED | RUNG_CHANGED, mark, marks);
	marks = mark_cells(of, before->rung, after->rung, after, mark);
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
	render_grow(of->picture, fits.width + RUNG_LEFT, of->y);
	g_free(said);
}

/* All of a POU that is there alone, or in another language than before. */
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
	if (pou->language == LANGUAGE_LD)
		return;
	if (pou->sfc)
		of->y = render_diff_charts(of->a, added ? -1 : index, of->b,
					   added ? index : -1, of->options, of->lettering,
					   of->y, of->picture);
	of->y = render_diff_lines(of->a, added ? -1 : index, of->b, added ? index : -1,
				  of->lettering, of->y, of->picture);
}

/* Lists and charts, and what has changed from one language to another. */
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
	name_pou(of, a->sfc ? _("the chart differs") : _("the instruction list differs"));
	if (a->sfc && b->sfc)
		of->y = render_diff_charts(of->a, of->pou_a, of->b, of->pou_b, of->options,
					   of->lettering, of->y, of->picture);
	of->y = render_diff_lines(of->a, of->pou_a, of->b, of->pou_b, of->lettering, of->y,
				  of->picture);
}

static void take_pair(void *context, struct compare_pair pair)
{
	struct comparison *of = context;
	const char *wanted = of->options->pou;
	const struct project *project = pair.pou_b < 0 ? of->a : of->b;
	const struct pou *pou = pou_of(project, pair.pou_b < 0 ? pair.pou_a : pair.pou_b);

	if (wanted && strcasecmp(wanted, project_text(project, pou->name)) != 0)
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
	of.y = render_diff_besides(a, b, options, lettering, of.y, picture);
	render_grow(picture, 1, of.y);
	sheet_free(of.before);
	sheet_free(of.after);
}
