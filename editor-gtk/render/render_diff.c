/* SPDX-License-Identifier: MIT
 *
 * render_diff - a comparison of two projects as one picture: rungs, lists, charts and, as
 * text, everything else. The engine finds the pairs of rungs (compare_rungs).
 */
#include "editor-gtk/render/render_diff.h"

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/render/render_sheet.h"

#include "engine/compare/compare.h"
#include "engine/text/pou_print.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MOST_MARKS 512
#define MARK_ROOM  16 /* px of a cell's lower edge that the mark of a changed cell covers */
#define TEXT_LINE  17
#define SIGN_X     16   /* x of + and -                                           */
#define NUMBER_END 62   /* right end of the number of a line                      */
#define TEXT_X     76
#define INDENT     7    /* px of a blank before a text                           */
#define AROUND     3    /* unchanged lines that are shown before and after a change */
#define TINT       0.10f

#define PLUS  "+"
#define MINUS "\xe2\x88\x92"
#define DOTS  "\xe2\x80\xa6"

/* ---- which steps and transitions of two charts differ ---- */

/* A copy of a chart for one piece at a time, with steps that do nothing. */
struct plain {
	const struct sfc_sheet *sheet;
	const struct sfc *sfc;   /* the original                               */
	struct pou pou;
	struct sfc one;
	struct sfc_piece piece[2];
	char **text;             /* by shape; NULL for jumps                    */
	int *like;               /* by shape: the matching shape of the other chart; -1: none
				    */
	bool *same;
};

static const char *text_of(const struct plain *plain, uint32_t id)
{
	return project_text(plain->sheet->project, id);
}

static int box_count(const struct plain *plain)
{
	return plain->sfc->step_count + plain->sfc->transition_count;
}

static bool is_step(const struct plain *plain, int shape)
{
	return shape < plain->sfc->step_count;
}

static const struct sfc_transition *way_of(const struct plain *plain, int shape)
{
	return &plain->sfc->transition[shape - plain->sfc->step_count];
}

static char *print(struct plain *plain, struct sfc_piece first, int count)
{
	plain->piece[0] = first;
	plain->piece[1] = (struct sfc_piece){ PIECE_MACRO_END, first.index };
	plain->one.piece = plain->piece;
	plain->one.piece_count = count;
	return pou_print(plain->sheet->project, &plain->pou);
}

/* The piece without its first line, with the name of the macro-step it is in. */
static char *text_of_shape(struct plain *plain, int shape)
{
	const int index = is_step(plain, shape) ? shape : shape - plain->sfc->step_count;
	const int macro = is_step(plain, shape) ? plain->sfc->step[index].macro :
						  plain->sfc->transition[index].macro;
	const bool two = is_step(plain, shape) && plain->sfc->step[index].kind == STEP_MACRO;
	char *text = print(plain, (struct sfc_piece){ is_step(plain, shape) ? PIECE_STEP :
				   PIECE_TRANSITION, index }, two ? 2 : 1);
	const char *body = text ? strchr(text, '\n') : NULL;
	char *out = g_strdup_printf("%s\n%s", macro < 0 ? "" :
		text_of(plain, plain->sfc->step[macro].name), body ? body : "");

	free(text);
	return out;
}

static void start(struct plain *plain, const struct sfc_sheet *sheet)
{
	struct sfc_step *steps;

	plain->sheet = sheet;
	plain->sfc = sheet->pou->sfc;
	plain->pou = *sheet->pou;
	plain->one = *plain->sfc;
	plain->pou.sfc = &plain->one;
	plain->pou.vars.block_count = 0;
	steps = g_new0(struct sfc_step, plain->sfc->step_count + 1);
	for (int i = 0; i < plain->sfc->step_count; i++) {
		steps[i] = plain->sfc->step[i];
		steps[i].use_count = 0;
	}
	plain->one.step = steps;
	plain->text = g_new0(char *, box_count(plain) + 1);
	plain->like = g_new(int, box_count(plain) + 1);
	plain->same = g_new0(bool, box_count(plain) + 1);
	for (int i = 0; i < box_count(plain); i++) {
		plain->text[i] = text_of_shape(plain, i);
		plain->like[i] = -1;
	}
}

static void end(struct plain *plain)
{
	g_strfreev(plain->text);
	g_free(plain->like);
	g_free(plain->same);
	g_free(plain->one.step);
}

static bool same_names(const struct plain *a, int first_a, int count_a,
		       const struct plain *b, int first_b, int count_b)
{
	for (int i = 0; i < count_a && count_a == count_b; i++)
		if (strcasecmp(text_of(a, a->sfc->ref[first_a + i].name),
			       text_of(b, b->sfc->ref[first_b + i].name)) != 0)
			return false;
	return count_a == count_b;
}

static bool same_side(const struct plain *a, int i, const struct plain *b, int k, bool to)
{
	const struct sfc_transition *x = way_of(a, i), *y = way_of(b, k);

	return to ? same_names(a, x->first_to, x->to_count, b, y->first_to, y->to_count) :
		    same_names(a, x->first_from, x->from_count, b, y->first_from,
			       y->from_count);
}

enum likeness { ALL, BOTH_SIDES, SAME_FROM, SAME_TO, LIKENESSES };

static bool is_like(const struct plain *a, int i, const struct plain *b, int k,
		    enum likeness likeness)
{
	if (is_step(a, i) != is_step(b, k))
		return false;
	if (likeness == ALL)
		return strcmp(a->text[i], b->text[k]) == 0;
	if (is_step(a, i))
		return strcasecmp(text_of(a, a->sfc->step[i].name),
				  text_of(b, b->sfc->step[k].name)) == 0;
	return (likeness == SAME_TO || same_side(a, i, b, k, false)) &&
	       (likeness == SAME_FROM || same_side(a, i, b, k, true));
}

/* Matches the most alike first; each has at most one match. */
static void match(struct plain *a, struct plain *b)
{
	for (int likeness = ALL; likeness < LIKENESSES; likeness++)
		for (int i = 0; i < box_count(a); i++)
			for (int k = 0; k < box_count(b) && a->like[i] < 0; k++) {
				if (b->like[k] >= 0 ||
				    !is_like(a, i, b, k, (enum likeness)likeness))
					continue;
				a->like[i] = k;
				b->like[k] = i;
				a->same[i] = b->same[k] = likeness == ALL;
			}
}

static char *action_text(struct plain *plain, int use)
{
	const int action = plain->sfc->use[use].action;

	return action < 0 ? NULL :
	       print(plain, (struct sfc_piece){ PIECE_ACTION, action }, 1);
}

/* The body of a named action counts too. */
static bool same_action(struct plain *a, int i, struct plain *b, int k)
{
	char *x = action_text(a, i), *y = action_text(b, k);
	const char *body_x = x ? strchr(x, '\n') : "", *body_y = y ? strchr(y, '\n') : "";
	const bool same = body_x && body_y && strcmp(body_x, body_y) == 0;

	free(x);
	free(y);
	return same;
}

static bool same_use(struct plain *a, int i, struct plain *b, int k)
{
	return strcmp(a->sheet->what[i], b->sheet->what[k]) == 0 &&
	       strcmp(a->sheet->does[i], b->sheet->does[k]) == 0 &&
	       strcmp(a->sheet->use_comment[i], b->sheet->use_comment[k]) == 0 &&
	       same_action(a, i, b, k);
}

static void mark_uses(struct plain *own, int step, struct plain *other, GArray *marks)
{
	const struct sfc_step *s = &own->sfc->step[step];
	const struct sfc_step *o = &other->sfc->step[own->like[step]];

	for (int i = s->first_use; i < s->first_use + s->use_count; i++) {
		const struct sfc_mark mark = { step, i, SFC_CHANGED };
		bool same = false;

		for (int k = o->first_use; k < o->first_use + o->use_count && !same; k++)
			same = same_use(own, i, other, k);
		if (!same)
			g_array_append_val(marks, mark);
	}
}

static void mark_all(struct plain *own, struct plain *other, unsigned int alone,
		     GArray *marks)
{
	for (int i = 0; i < box_count(own); i++) {
		const struct sfc_mark mark = { i, -1, own->like[i] < 0 ? alone : SFC_CHANGED };

		if (!own->same[i])
			g_array_append_val(marks, mark);
		if (is_step(own, i) && own->like[i] >= 0)
			mark_uses(own, i, other, marks);
	}
}

/* Marks (struct sfc_mark): SFC_CHANGED in both charts, SFC_REMOVED or SFC_ADDED in one. */
static void mark_charts(const struct sfc_sheet *before, const struct sfc_sheet *after,
		       GArray *removed, GArray *added)
{
	struct plain *a = g_new0(struct plain, 1), *b = g_new0(struct plain, 1);

	start(a, before);
	start(b, after);
	match(a, b);
	mark_all(a, b, SFC_REMOVED, removed);
	mark_all(b, a, SFC_ADDED, added);
	end(a);
	end(b);
	g_free(a);
	g_free(b);
}

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

static float put_text(struct lettering *lettering, enum token token, const char *text,
		      float x, float y, struct picture *picture)
{
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, text, -1, 0);

	picture_text(picture, token, LETTER_OPERAND, fits, x, y + 13);
	render_grow(picture, x + fits.width + SIGN_X, y + TEXT_LINE);
	return fits.width;
}

static void put_number(struct lettering *lettering, int number, float y,
		       struct picture *picture)
{
	char text[16];

	g_snprintf(text, sizeof(text), "%d", number);
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, text, -1, 0);
	picture_text(picture, TOKEN_COMMENT, LETTER_OPERAND, fits, NUMBER_END - fits.width,
		     y + 13);
}

static void put_line(struct lettering *lettering, const struct compare_line *line, float y,
		     struct picture *picture)
{
	const bool added = !line->line_a;
	const enum token token = added ? TOKEN_POWER : TOKEN_ERROR;
	const float x = TEXT_X + (float)(line->indent * INDENT);
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, line->text, -1, 0);

	if (!is_same(line)) {
		picture_fill(picture, token, TINT, 0, y, x + fits.width + SIGN_X, TEXT_LINE);
		put_text(lettering, token, added ? PLUS : MINUS, SIGN_X, y, picture);
	}
	put_number(lettering, line->line_b ? line->line_b : line->line_a, y, picture);
	put_text(lettering, TOKEN_INK, line->text, x, y, picture);
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
				put_text(lettering, TOKEN_COMMENT, DOTS, TEXT_X, y, picture);
			y += left_out ? 0 : TEXT_LINE;
			left_out = true;
			continue;
		}
		left_out = false;
		put_line(lettering, &g_array_index(listed.line, struct compare_line, i), y,
			 picture);
		y += TEXT_LINE;
	}
	g_array_unref(listed.line);
	g_string_chunk_free(listed.texts);
	return y + TEXT_LINE;
}

/* @added: the newer chart, else the older one. */
static float put_chart(const struct sfc_sheet *chart, const GArray *marks, bool added,
		       const struct render_options *options, struct lettering *lettering,
		       float y, struct picture *picture)
{
	const struct sfc_scene scene = { .sheet = chart,
					 .theme = theme_get(options->theme, THEME_GREEN),
					 .mark = (const struct sfc_mark *)marks->data,
					 .mark_count = (int)marks->len };
	const enum token token = added ? TOKEN_POWER : TOKEN_ERROR;

	picture_fill(picture, token, TINT, 0, y, RUNG_GUTTER + chart->width, chart->height);
	picture_text(picture, token, LETTER_HEADING,
		     lettering_fit(lettering, LETTER_HEADING, added ? PLUS : MINUS, -1, 0),
		     SIGN_X, y + 27);
	picture_move(picture, RUNG_GUTTER, y);
	sfc_draw(&scene, picture);
	picture_move(picture, 0, 0);
	y += chart->height + TEXT_LINE;
	render_grow(picture, RUNG_GUTTER + chart->width, y);
	return y;
}

static float put_charts(const struct project *a, int pou_a, const struct project *b,
			 int pou_b, const struct render_options *options,
			 struct lettering *lettering, float y, struct picture *picture)
{
	struct sfc_sheet *before = pou_a < 0 ? NULL :
		sfc_sheet_new(a, &a->pou[pou_a], lettering);
	struct sfc_sheet *after = pou_b < 0 ? NULL :
		sfc_sheet_new(b, &b->pou[pou_b], lettering);
	GArray *removed = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	GArray *added = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));

	if (before && after)
		mark_charts(before, after, removed, added);
	if (before)
		y = put_chart(before, removed, false, options, lettering, y, picture);
	if (after)
		y = put_chart(after, added, true, options, lettering, y, picture);
	g_array_unref(removed);
	g_array_unref(added);
	if (before)
		sfc_sheet_free(before);
	if (after)
		sfc_sheet_free(after);
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
		for (int i = 0; lines[i] && *lines[i]; i++, y += TEXT_LINE)
			put_text(lettering, TOKEN_INK, lines[i], SIGN_X, y, picture);
		g_strfreev(lines);
		y += TEXT_LINE;
		render_grow(picture, 1, y);
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
	sheet->drafting.beside = MARK_ROOM;
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

/* Does the rung have outputs? They are always drawn in the last column. */
static bool has_outputs(const struct rung *rung)
{
	bool has = false;

	for (int row = 0; row < rung->rows && !has; row++) {
		const enum word word = (enum word)rung_at(rung, row, rung->cols - 1)->word;

		has = !word_is_own(word) && word_row(word)->place == PLACE_LAST;
	}
	return has;
}

/* The cell of @rung in the place of a cell of @own, whose width may differ. */
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
	/* a longer wire to an output is no change */
	return outputs && rung_at(own, row, col)->word == ELEM_WIRE ? &wire : &nothing;
}

/* Marks the cells of @layout that differ from the other rung. */
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
	if (pou->language == LANGUAGE_LD)
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
	of.y = put_besides(a, b, options, lettering, of.y, picture);
	render_grow(picture, 1, of.y);
	sheet_free(of.before);
	sheet_free(of.after);
}
