/* SPDX-License-Identifier: MIT
 *
 * show - draws rungs and charts as text.
 *
 * First every column and line of a rung is measured, then each text line is written
 * from left to right. Rungs with errors are drawn, too.
 */
#include "engine/show/show.h"

#include "engine/base/plain.h"
#include "engine/model/fbd.h"
#include "engine/show/draw.h"
#include "engine/text/pou_print.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NARROW 3    /* columns of a cell of wire                              */
#define NORMAL 7    /* columns of a cell with an element, at least            */
#define RAIL_GAP 2  /* columns between a coil and its bar                     */

static const struct strokes unicode = {
	.joint = { " ", "╵", "╷", "│", "─", "┘", "┐", "┤",
		   "─", "└", "┌", "├", "─", "┴", "┬", "┼" },
	.across = "─", .powered = "━", .rail = "│", .off_rail = "┆", .open = "┤", .close = "├",
	.corner = { "┌", "┐", "└", "┘" }, .side = "│", .more = "…",
};
static const struct strokes ascii = {
	.joint = { " ", "|", "|", "|", "-", "+", "+", "+",
		   "-", "+", "+", "+", "-", "+", "+", "+" },
	.across = "-", .powered = "=", .rail = "|", .off_rail = ":", .open = "|", .close = "|",
	.corner = { "+", "+", "+", "+" }, .side = "|", .more = "~",
};

/* How an element is drawn in its cell. */
enum form { FORM_EMPTY, FORM_WIRE, FORM_GLYPH, FORM_TEXT, FORM_BOX };

static const struct cell *cell_at(const struct draw *draw, int row, int col)
{
	return rung_at(draw->rung, row, col);
}

static const struct word_row *row_at(const struct draw *draw, int row, int col)
{
	return word_row(cell_at(draw, row, col)->word);
}

static const char *operand_at(const struct draw *draw, int row, int col)
{
	return project_text(draw->project, cell_at(draw, row, col)->operand);
}

static enum form form_at(const struct draw *draw, int row, int col)
{
	const struct word_row *word = row_at(draw, row, col);

	if (rung_box_top(draw->rung, row, col) >= 0)
		return FORM_BOX;
	if (word->place == PLACE_NONE)
		return col > draw->trail[row] ? FORM_WIRE : FORM_EMPTY;
	if (word->place == PLACE_WIRE)
		return FORM_WIRE;
	if (word->operand == OPND_BOOL_R || word->operand == OPND_BOOL_W)
		return FORM_GLYPH;
	return FORM_TEXT;
}

/* ---- connections ---- */

static bool linked_up(const struct draw *draw, int row, int bar)
{
	return bar > 0 && row < draw->rung->rows &&
	       cell_at(draw, row, bar - 1)->link;
}

static bool goes_left(const struct draw *draw, int row, int col)
{
	if (col == draw->rung->cols)
		return draw->trail[row] < col;
	const struct word_row *word = row_at(draw, row, col);
	if (word->place == PLACE_PIN)
		return cell_at(draw, row, col)->operand != 0;
	return word->place != PLACE_NONE || col > draw->trail[row];
}

bool draw_goes_right(const struct draw *draw, int row, int col)
{
	enum place place = row_at(draw, row, col)->place;

	if (place == PLACE_PIN)
		return false;
	if (place == PLACE_NONE)
		return col > draw->trail[row];
	if (place != PLACE_LAST && place != PLACE_BOX)
		return true;
	/* An output has no wire at its right unless something is joined to it. */
	return goes_left(draw, row, col + 1) ||
	       linked_up(draw, row, col + 1) ||
	       linked_up(draw, row + 1, col + 1);
}

static const char *joint(const struct draw *draw, int row, int bar)
{
	unsigned ways = 0;

	if (linked_up(draw, row, bar))
		ways |= JOIN_UP;
	if (linked_up(draw, row + 1, bar))
		ways |= JOIN_DOWN;
	if (bar == 0)
		ways |= JOIN_UP | JOIN_DOWN;
	else if (draw_goes_right(draw, row, bar - 1))
		ways |= JOIN_LEFT;
	if (goes_left(draw, row, bar))
		ways |= JOIN_RIGHT;
	if (bar == 0 && ways == (JOIN_UP | JOIN_DOWN) && draw->rung->off)
		return draw->strokes->off_rail;
	return draw->strokes->joint[ways];
}

/* The line of an output with nothing behind it goes on to the right rail, as on paper. */
static int trail_of(const struct draw *draw, int row)
{
	const struct rung *rung = draw->rung;
	int col = rung->cols - 1;

	for (; col >= 0 && row_at(draw, row, col)->place == PLACE_NONE; col--)
		if (linked_up(draw, row, col + 1) ||
		    linked_up(draw, row + 1, col + 1))
			return LIMIT_COLS;
	if (col < 0 || linked_up(draw, row, col + 1) ||
	    linked_up(draw, row + 1, col + 1))
		return LIMIT_COLS;

	const struct word_row *word = row_at(draw, row, col);
	bool coil = word->place == PLACE_LAST && word->operand == OPND_BOOL_W;
	bool box = word->place == PLACE_BOX || word->kind != WORD_ELEM;
	return coil || box ? col : LIMIT_COLS;
}

/* ---- elements drawn as one line of text: [ a > b ], >>Label, <RETURN>, |NOT| ---- */

struct framed {
	const char *text;
	char before[16], after[8];
	int width;
};

static void set_stroke(const struct draw *draw, char stroke, bool left, char out[8])
{
	if (stroke == '|')
		snprintf(out, 8, "%s", left ? draw->strokes->open : draw->strokes->close);
	else
		out[0] = stroke;
}

static struct framed framed_at(const struct draw *draw, int row, int col)
{
	const struct word_row *word = row_at(draw, row, col);
	struct framed framed = { operand_at(draw, row, col), "", "", 0 };

	switch (word->operand) {
	case OPND_EXPR:
	case OPND_ASSIGN:
		memcpy(framed.before, "[ ", 2);
		memcpy(framed.after, " ]", 2);
		break;
	case OPND_LABEL:
		memcpy(framed.before, explain_glyph(word), 2);
		break;
	case OPND_LOOP:
		memcpy(framed.before, "FOR ", 4);
		break;
	case OPND_ROUTINE:
		memcpy(framed.before, "CALL ", 5);
		break;
	case OPND_EXECUTE:
		snprintf(framed.before, sizeof(framed.before), "[ %s%s", word->word,
			 *framed.text ? " " : "");
		memcpy(framed.after, " ]", 2);
		break;
	case OPND_LOOP_END:
	case OPND_NONE:
		framed.text = explain_inside(word);
		set_stroke(draw, explain_glyph(word)[0], true, framed.before);
		set_stroke(draw, explain_glyph(word)[2], false, framed.after);
		break;
	case OPND_BOOL_R:
	case OPND_BOOL_W:
	case OPND_ANY_R:
	case OPND_ANY_W:
	case OPND_INSTANCE:
	case OPND_PIN:
		framed.before[0] = word->word[0];
		break;
	}
	framed.width = draw_clipped(framed.before, strlen(framed.before), DRAW_CLIP_TEXT) +
		       draw_clipped(framed.text, strlen(framed.text), DRAW_CLIP_TEXT) +
		       draw_clipped(framed.after, strlen(framed.after), DRAW_CLIP_TEXT);
	return framed;
}

static void draw_framed(struct draw *draw, int row, int col)
{
	struct framed framed = framed_at(draw, row, col);
	int width = draw->width[col];
	bool last = row_at(draw, row, col)->place == PLACE_LAST;
	int start = last ? width - RAIL_GAP - framed.width :
			   (width - framed.width) / 2;
	int rest = width - start - framed.width;

	if (goes_left(draw, row, col))
		draw_across(draw, start, draw->in);
	else
		draw_blank(draw, start);
	sink_text(draw->sink, framed.before);
	draw_text(draw, framed.text, strlen(framed.text), DRAW_CLIP_TEXT);
	sink_text(draw->sink, framed.after);
	if (draw_goes_right(draw, row, col))
		draw_across(draw, rest, draw->out);
	else
		draw_blank(draw, rest);
}

/* ---- contacts and coils ---- */

static int glyph_start(const struct draw *draw, int row, int col)
{
	int width = draw->width[col];

	return row_at(draw, row, col)->place == PLACE_LAST ?
	       width - RAIL_GAP - 3 : (width - 3) / 2;
}

static void glyph_stroke(const struct draw *draw, char stroke, bool left)
{
	char text[8] = "";

	set_stroke(draw, stroke, left, text);
	sink_text(draw->sink, text);
}

static void draw_glyph(struct draw *draw, int row, int col)
{
	const char *glyph = explain_glyph(row_at(draw, row, col));
	int start = glyph_start(draw, row, col);
	int rest = draw->width[col] - start - 3;

	draw_across(draw, start, draw->in);
	glyph_stroke(draw, glyph[0], true);
	sink_write(draw->sink, glyph + 1, 1);
	glyph_stroke(draw, glyph[2], false);
	if (draw_goes_right(draw, row, col))
		draw_across(draw, rest, draw->out);
	else
		draw_blank(draw, rest);
}

static void draw_name(struct draw *draw, int row, int col)
{
	const char *name = operand_at(draw, row, col);
	size_t len = strlen(name);
	int taken = draw_clipped(name, len, DRAW_CLIP);
	int start = glyph_start(draw, row, col) + 1 - (taken - 1) / 2;

	if (start + taken > draw->width[col] - 1)
		start = draw->width[col] - 1 - taken;
	if (start < 1)
		start = 1;
	draw_blank(draw, start);
	draw_text(draw, name, len, DRAW_CLIP);
	draw_blank(draw, draw->width[col] - start - taken);
}

/* ---- measuring ---- */

static int cell_need(struct draw *draw, int row, int col)
{
	const char *name = operand_at(draw, row, col);

	switch (form_at(draw, row, col)) {
	case FORM_EMPTY:
	case FORM_WIRE:
		return NARROW;
	case FORM_GLYPH: {
		int need = draw_clipped(name, strlen(name), DRAW_CLIP) + 2;
		return need < NORMAL ? NORMAL : need;
	}
	case FORM_TEXT: {
		int need = framed_at(draw, row, col).width + 2 * RAIL_GAP;
		return need < NORMAL ? NORMAL : need;
	}
	case FORM_BOX:
		if (row_at(draw, row, col)->place == PLACE_PIN)
			return NARROW;
		box_make(draw, row, col);
		return draw->box.need;
	}
	return NARROW;
}

static int lines_above(struct draw *draw, int row, int col)
{
	const struct cell *cell = cell_at(draw, row, col);

	switch (form_at(draw, row, col)) {
	case FORM_GLYPH:
		return cell->operand != 0;
	case FORM_BOX:
		if (row_at(draw, row, col)->place == PLACE_PIN)
			return 0;
		return cell->operand ? 2 : 1;
	case FORM_EMPTY:
	case FORM_WIRE:
	case FORM_TEXT:
		return 0;
	}
	return 0;
}

static int lines_below(struct draw *draw, int row, int col)
{
	int top = rung_box_top(draw->rung, row, col);

	if (top < 0 || top + rung_height(draw->rung, top, col) - 1 != row)
		return 0;
	box_make(draw, top, col);
	return box_bottom(draw) - (draw->y[row] - draw->y[top]);
}

static void measure_lines(struct draw *draw)
{
	int next = 0; /* first line that is still free */

	for (int row = 0; row < draw->rung->rows; row++) {
		draw->above[row] = draw->below[row] = 0;
		for (int col = 0; col < draw->rung->cols; col++) {
			int lines = lines_above(draw, row, col);
			if (lines > draw->above[row])
				draw->above[row] = lines;
		}
		draw->y[row] = next + draw->above[row];
		for (int col = 0; col < draw->rung->cols; col++) {
			int lines = lines_below(draw, row, col);
			if (lines > draw->below[row])
				draw->below[row] = lines;
		}
		next = draw->y[row] + draw->below[row] + 1;
	}
}

/* Widens a column without moving an element out of its middle. */
static bool can_stretch(const struct draw *draw, int col)
{
	for (int row = 0; row < draw->rung->rows; row++) {
		const struct word_row *word = row_at(draw, row, col);
		if (word->place == PLACE_SERIES || word->place == PLACE_BOX ||
		    word->place == PLACE_PIN || word->kind != WORD_ELEM)
			return false;
	}
	return true;
}

static void measure_columns(struct draw *draw, int wanted)
{
	int cols = draw->rung->cols;
	int total = draw->margin + cols + 2, stretch = cols - 1;

	for (int col = 0; col < cols; col++) {
		draw->width[col] = NARROW;
		for (int row = 0; row < draw->rung->rows; row++) {
			int need = cell_need(draw, row, col);
			if (need > draw->width[col])
				draw->width[col] = need;
		}
		total += draw->width[col];
	}
	for (int col = 0; col < cols; col++)
		if (can_stretch(draw, col))
			stretch = col;
	if (total < wanted)
		draw->width[stretch] += wanted - total;
}

/* ---- lines ---- */

static void draw_cell(struct draw *draw, int row, int col, int line)
{
	int top = rung_box_top(draw->rung, row, col);

	draw->in = draw->out = false;
	if (line == 0 && draw->options && draw->options->power)
		draw->options->power(draw->options->context, draw->pou, draw->number,
				     row + 1, col + 1, &draw->in, &draw->out);
	if (top >= 0) {
		box_make(draw, top, col);
		box_line(draw, draw->y[row] + line - draw->y[top]);
		return;
	}
	enum form form = form_at(draw, row, col);
	if (line == -1 && form == FORM_GLYPH)
		draw_name(draw, row, col);
	else if (line != 0 || form == FORM_EMPTY)
		draw_blank(draw, draw->width[col]);
	else if (form == FORM_WIRE)
		draw_across(draw, draw->width[col], draw->in);
	else if (form == FORM_TEXT)
		draw_framed(draw, row, col);
	else
		draw_glyph(draw, row, col);
}

static const char *bar_stroke(const struct draw *draw, int row, int bar,
			      int line)
{
	const struct strokes *strokes = draw->strokes;
	const char *straight = strokes->joint[JOIN_LEFT | JOIN_RIGHT];

	if (line == 0 && bar > 0 && draw->out && joint(draw, row, bar) == straight)
		return strokes->powered;
	if (line == 0)
		return joint(draw, row, bar);
	if (bar == 0)
		return draw->rung->off ? strokes->off_rail : strokes->rail;
	return linked_up(draw, line < 0 ? row : row + 1, bar) ? strokes->rail :
								" ";
}

static const char *right_rail(const struct draw *draw, int row, int line)
{
	if (line == 0 && draw->trail[row] < LIMIT_COLS)
		return draw->strokes->joint[JOIN_UP | JOIN_DOWN | JOIN_LEFT];
	return draw->rung->off ? draw->strokes->off_rail : draw->strokes->rail;
}

static void draw_line(struct draw *draw, int row, int line)
{
	if (row == 0 && line == 0)
		sink_printf(draw->sink, "%*d", draw->margin, draw->number);
	else
		draw_blank(draw, draw->margin);
	for (int bar = 0; bar <= draw->rung->cols; bar++) {
		sink_text(draw->sink, bar_stroke(draw, row, bar, line));
		if (bar < draw->rung->cols)
			draw_cell(draw, row, bar, line);
	}
	sink_text(draw->sink, right_rail(draw, row, line));
	sink_text(draw->sink, "\n");
}

static void draw_head(const struct draw *draw)
{
	const struct rung *rung = draw->rung;
	const char *label = project_text(draw->project, rung->label);
	const char *title = project_text(draw->project, rung->title);
	const char *at = project_text(draw->project, rung->comment), *line;
	size_t len;

	plain_text(draw->sink, label);
	if (*label && *title)
		sink_text(draw->sink, ": ");
	plain_text(draw->sink, title);
	if (rung->off)
		sink_text(draw->sink, *label || *title ? " [OFF]" : "[OFF]");
	if (*label || *title || rung->off)
		sink_text(draw->sink, "\n");
	while ((line = plain_comment_line(&at, &len))) {
		draw_blank(draw, draw->margin + 2);
		plain_write(draw->sink, line, len);
		sink_text(draw->sink, "\n");
	}
}

static void draw_comments(const struct draw *draw)
{
	for (int row = 0; row < draw->rung->rows; row++)
		for (int col = 0; col < draw->rung->cols; col++) {
			const struct cell *cell = rung_at(draw->rung, row, col);
			const char *at = project_text(draw->project,
						      cell->comment);
			const char *line, *name = project_text(draw->project, cell->operand);
			size_t len;

			while ((line = plain_comment_line(&at, &len))) {
				draw_blank(draw, draw->margin + 1);
				sink_printf(draw->sink, "(%d,%d) ", row + 1,
					    col + 1);
				draw_text(draw, name, strlen(name), DRAW_CLIP);
				sink_text(draw->sink, *name ? ": " : "");
				plain_write(draw->sink, line, len);
				sink_text(draw->sink, "\n");
			}
		}
}

/* The lines of EXECUTE boxes. */
static void draw_statements(const struct draw *draw)
{
	for (int i = 0; i < draw->rung->rows * draw->rung->cols; i++) {
		const struct cell *cell = &draw->rung->cell[i];
		const char *at = project_text(draw->project, cell->args), *end;
		const char *name = project_text(draw->project, cell->operand);

		if (cell->word != ELEM_EXECUTE)
			continue;
		draw_blank(draw, draw->margin + 1);
		sink_printf(draw->sink, "(%d,%d) EXECUTE%s", i / draw->rung->cols + 1,
			    i % draw->rung->cols + 1, *name ? " " : "");
		plain_text(draw->sink, name);
		sink_text(draw->sink, ":\n");
		for (; *at; at = end + (*end == '\n')) {
			end = at + strcspn(at, "\n");
			draw_blank(draw, end > at ? draw->margin + 1 : 0);
			plain_write(draw->sink, at, (size_t)(end - at));
			sink_text(draw->sink, "\n");
		}
	}
}

void draw_rung(struct draw *draw)
{
	const int wanted = draw->options ? draw->options->width : 0;

	for (int row = 0; row < draw->rung->rows; row++)
		draw->trail[row] = trail_of(draw, row);
	measure_columns(draw, wanted);
	measure_lines(draw);
	draw_head(draw);
	for (int row = 0; row < draw->rung->rows; row++)
		for (int line = -draw->above[row]; line <= draw->below[row];
		     line++)
			draw_line(draw, row, line);
	draw_statements(draw);
	draw_comments(draw);
}

/* ---- selection ---- */

static int digits(int number)
{
	int count = 1;

	for (; number >= 10; number /= 10)
		count++;
	return count;
}

static int show_ld(struct draw *draw, const struct pou *pou, int rung)
{
	int first = rung ? rung - 1 : 0;
	int end = rung ? rung : pou->rung_count;

	if (rung < 0 || end > pou->rung_count)
		return 0;
	draw->margin = digits(end);
	for (int i = first; i < end; i++) {
		if (i > first)
			sink_text(draw->sink, "\n");
		draw->rung = pou->rung[i];
		draw->number = i + 1;
		draw_rung(draw);
	}
	return end - first;
}

static int show_sfc(struct draw *draw, const struct pou *pou)
{
	sink_text(draw->sink, "\n");
	draw->margin = digits(pou->rung_count);
	return draw_sfc(draw, pou) ? 1 : -1;
}

static int show_text(struct draw *draw, const struct pou *pou)
{
	char *text = pou_print(draw->project, pou);
	const bool good = text != NULL;

	if (good)
		sink_text(draw->sink, text);
	free(text);
	return good ? 1 : -1;
}

static int show_fbd(struct draw *draw, const struct pou *pou, int network)
{
	const int first = network ? network - 1 : 0, end = network ? network : pou->fbd->count;

	if (network < 0 || end > pou->fbd->count)
		return 0;
	draw->margin = digits(end);
	for (int i = first; i < end; i++) {
		if (i > first)
			sink_text(draw->sink, "\n");
		draw->number = i + 1;
		if (!draw_network(draw, pou, i))
			return -1;
	}
	return end - first;
}

static int show_pou(struct draw *draw, const struct pou *pou, int rung)
{
	const bool drawn = pou->rung_count || (pou->fbd && pou->fbd->count);

	if (pou->language == LANGUAGE_ST)
		return rung == 0 ? show_text(draw, pou) : 0;
	if (pou->language == LANGUAGE_IL) {
		if (rung != 0)
			return 0;
		return pou_print_il(draw->project, pou, &pou->vars, NULL, 0,
				     &pou->il, draw->sink) ? 1 : -1;
	}
	if (rung == 0) {
		sink_text(draw->sink, pou_word(pou->kind));
		sink_text(draw->sink, " ");
		plain_text(draw->sink, project_text(draw->project, pou->name));
		if (draw->options && draw->options->instance)
			sink_printf(draw->sink, " as %.100s", draw->options->instance);
		sink_text(draw->sink, drawn && !pou->sfc ? "\n\n" : "\n");
		if (pou->sfc)
			return show_sfc(draw, pou);
	}
	return pou->fbd ? show_fbd(draw, pou, rung) : show_ld(draw, pou, rung);
}

int show_rungs(const struct project *project, int pou, int rung,
	      const struct show_options *options, const struct sink *sink)
{
	struct draw *draw = calloc(1, sizeof(*draw));
	int first = pou < 0 ? 0 : pou;
	int end = pou < 0 ? project->pou_count : pou + 1;
	int drawn = 0, more = 0;

	if (!draw)
		return -1;
	draw->project = project;
	draw->sink = sink;
	draw->options = options;
	draw->strokes = options && options->ascii ? &ascii : &unicode;
	if (end > project->pou_count)
		end = project->pou_count;
	for (int i = first; i < end && more >= 0; i++) {
		if (drawn > 0)
			sink_text(sink, "\n");
		draw->pou = i;
		more = show_pou(draw, &project->pou[i], rung);
		drawn += more;
	}
	free(draw);
	return more < 0 ? -1 : drawn;
}
