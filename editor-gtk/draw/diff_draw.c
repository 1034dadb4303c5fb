/* SPDX-License-Identifier: MIT
 *
 * diff_draw - differences of rungs, charts and lists as marks and strokes; see diff_draw.h.
 */
#include "editor-gtk/draw/diff_draw.h"

#include "editor-gtk/draw/grid_draw.h"

#include "engine/base/name.h"
#include "engine/text/pou_print.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define NUMBER_END 62   /* right end of the number of a line                      */
#define INDENT     7    /* px of a blank before a text                           */
#define TINT       0.10f

#define PLUS  "+"
#define MINUS "\xe2\x88\x92"

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

static char *print_shape(struct plain *plain, int shape)
{
	const int index = is_step(plain, shape) ? shape : shape - plain->sfc->step_count;
	const bool two = is_step(plain, shape) && plain->sfc->step[index].kind == STEP_MACRO;

	return print(plain, (struct sfc_piece){ is_step(plain, shape) ? PIECE_STEP :
		     PIECE_TRANSITION, index }, two ? 2 : 1);
}

/* The piece without its first line, with the name of the macro-step it is in. */
static char *text_of_shape(struct plain *plain, int shape)
{
	const int macro = is_step(plain, shape) ? plain->sfc->step[shape].macro :
						  way_of(plain, shape)->macro;
	char *text = print_shape(plain, shape);
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
		if (!name_equal(text_of(a, a->sfc->ref[first_a + i].name),
			       text_of(b, b->sfc->ref[first_b + i].name)))
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
		return name_equal(text_of(a, a->sfc->step[i].name),
				  text_of(b, b->sfc->step[k].name));
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

void diff_mark_charts(const struct sfc_sheet *before, const struct sfc_sheet *after,
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

/* ---- the same as a list of parts ---- */

/* Lines of @text that @other lacks, with @sign before each. */
static void add_lines(GString *out, const char *text, const char *other, const char *sign)
{
	char **lines = g_strsplit(text, "\n", -1), **others = g_strsplit(other, "\n", -1);

	for (int i = 0; lines[i]; i++) {
		const char *line = g_strstrip(lines[i]);
		bool has = !*line || g_str_has_prefix(line, "END_");

		for (int k = 0; others[k] && !has; k++)
			has = strcmp(line, g_strstrip(others[k])) == 0;
		if (!has)
			g_string_append_printf(out, "%s%s %s", out->len ? "\n" : "", sign,
					       line);
	}
	g_strfreev(others);
	g_strfreev(lines);
}

char *diff_words(const char *from, const char *to)
{
	GString *words = g_string_new(NULL);

	add_lines(words, from, to, MINUS);
	add_lines(words, to, from, PLUS);
	return g_string_free(words, FALSE);
}

/* The text of a step or transition, and of the actions of a step, a line each. */
static char *whole_text(struct plain *plain, int shape)
{
	char *piece = print_shape(plain, shape);
	GString *text = g_string_new(piece);
	const struct sfc_step *step = is_step(plain, shape) ? &plain->sfc->step[shape] : NULL;

	for (int i = 0; step && i < step->use_count; i++) {
		const int use = step->first_use + i;
		char *body = action_text(plain, use);

		g_string_append_printf(text, "\n%s %s %s\n%s", plain->sheet->what[use],
				       plain->sheet->does[use], plain->sheet->use_comment[use],
				       body && strchr(body, '\n') ? strchr(body, '\n') : "");
		free(body);
	}
	free(piece);
	return g_string_free(text, FALSE);
}

static char *words_of(struct plain *a, int i, struct plain *b, int k)
{
	char *from = i < 0 ? g_strdup("") : whole_text(a, i);
	char *to = k < 0 ? g_strdup("") : whole_text(b, k), *words = diff_words(from, to);

	g_free(from);
	g_free(to);
	return words;
}

static void add_part(GArray *parts, struct plain *a, int i, struct plain *b, int k)
{
	struct diff_part part = { i, k, words_of(a, i, b, k) };

	if (i >= 0 && k >= 0 && a->same[i] && !*part.words)
		g_free(part.words);
	else
		g_array_append_val(parts, part);
}

static void clear_part(gpointer part)
{
	g_free(((struct diff_part *)part)->words);
}

GArray *diff_chart_parts(const struct sfc_sheet *before, const struct sfc_sheet *after)
{
	struct plain *a = g_new0(struct plain, 1), *b = g_new0(struct plain, 1);
	GArray *parts = g_array_new(FALSE, FALSE, sizeof(struct diff_part));

	g_array_set_clear_func(parts, clear_part);
	start(a, before);
	start(b, after);
	match(a, b);
	for (int i = 0; i < box_count(a); i++)
		add_part(parts, a, i, b, a->like[i]);
	for (int k = 0; k < box_count(b); k++)
		if (b->like[k] < 0)
			add_part(parts, a, -1, b, k);
	end(a);
	end(b);
	g_free(a);
	g_free(b);
	return parts;
}

/* ---- lists and charts ---- */

float diff_draw_text(struct lettering *lettering, enum token token, const char *text,
		     float x, float y, struct picture *picture)
{
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, text, -1, 0);

	picture_text(picture, token, LETTER_OPERAND, fits, x, y + 13);
	picture_grow(picture, x + fits.width + DIFF_SIGN_X, y + DIFF_LINE);
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

void diff_draw_line(struct lettering *lettering, const struct compare_line *line, float y,
		    struct picture *picture)
{
	const bool added = !line->line_a;
	const enum token token = added ? TOKEN_POWER : TOKEN_ERROR;
	const float x = DIFF_TEXT_X + (float)(line->indent * INDENT);
	struct lettered fits = lettering_fit(lettering, LETTER_OPERAND, line->text, -1, 0);

	if (!line->line_a || !line->line_b) {
		picture_fill(picture, token, TINT, 0, y, x + fits.width + DIFF_SIGN_X, DIFF_LINE);
		diff_draw_text(lettering, token, added ? PLUS : MINUS, DIFF_SIGN_X, y, picture);
	}
	put_number(lettering, line->line_b ? line->line_b : line->line_a, y, picture);
	diff_draw_text(lettering, TOKEN_INK, line->text, x, y, picture);
}

float diff_draw_chart(const struct sfc_sheet *chart, const GArray *marks, bool added,
		      const struct theme *theme, float y, struct picture *picture)
{
	const struct sfc_scene scene = { .sheet = chart,
					 .theme = theme,
					 .mark = (const struct sfc_mark *)marks->data,
					 .mark_count = (int)marks->len };
	const enum token token = added ? TOKEN_POWER : TOKEN_ERROR;

	picture_fill(picture, token, TINT, 0, y, RUNG_GUTTER + chart->width, chart->height);
	picture_text(picture, token, LETTER_HEADING,
		     lettering_fit(chart->lettering, LETTER_HEADING, added ? PLUS : MINUS, -1, 0),
		     DIFF_SIGN_X, y + 27);
	picture_move(picture, RUNG_GUTTER, y);
	sfc_draw(&scene, picture);
	picture_move(picture, 0, 0);
	y += chart->height + DIFF_LINE;
	picture_grow(picture, RUNG_GUTTER + chart->width, y);
	return y;
}

/* ---- rungs ---- */

static bool same_text(const struct diff_rungs *of, uint32_t a, uint32_t b)
{
	return strcmp(project_text(of->a, a), project_text(of->b, b)) == 0;
}

static bool same_cell(const struct diff_rungs *of, const struct cell *a,
		      const struct cell *b)
{
	const char *word_a = words_row(&of->a->words, a->word)->word;
	const char *word_b = words_row(&of->b->words, b->word)->word;

	return name_equal(word_a, word_b) && a->link == b->link &&
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

int diff_mark_cells(const struct diff_rungs *of, const struct rung_layout *layout,
		    struct grid_mark mark[DIFF_MARKS])
{
	const struct rung *a = of->rung_a, *b = of->rung_b;
	const struct rung *own = layout->rung;
	const bool outputs = has_outputs(a) && has_outputs(b);
	int count = 0;

	for (int row = 0; row < own->rows; row++)
		for (int col = 0; col < own->cols && count < DIFF_MARKS; col++) {
			const struct cell *x = cell_like(a, own, row, col, outputs);
			const struct cell *y = cell_like(b, own, row, col, outputs);

			if (!same_cell(of, x, y))
				mark[count++] = (struct grid_mark){
					row, rung_layout_column(layout, row, col),
					MARK_CHANGED };
		}
	return count;
}
