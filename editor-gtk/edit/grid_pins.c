/* SPDX-License-Identifier: MIT
 *
 * grid_pins - rows of pins below boxes.
 *
 * A further Boolean input has a row only when a branch feeds it; all others are
 * parameters (docs/rung-file.md, "Boxes").
 */
#include "editor-gtk/edit/grid_canvas.h"

#include "engine/model/args.h"

#include <string.h>

/* Why input @name may have no row of its own; GRID_DONE: it may. */
static enum grid_refusal judge(const struct word_row *row, const char *name)
{
	const int index = word_pin_find(row, name, strlen(name));
	const struct word_pin *pin;

	if (index < 0)
		return GRID_BAD_PIN;
	pin = &row->pin[index < row->pin_count ? index : row->pin_count - 1];
	if (pin->dir != PIN_IN)
		return GRID_BAD_PIN;
	if (row->kind == WORD_FN)
		return pin->classes & CLASS_BOOL ? GRID_DONE : GRID_BAD_PIN;
	if (index == word_first_bool(row, PIN_IN))
		return GRID_FIRST_PIN;
	return pin->type == IEC_BOOL ? GRID_DONE : GRID_BAD_PIN;
}

static bool is_connected(const struct canvas *c, const struct project *project, int row,
			 int col, uint32_t pin)
{
	const struct cell *box = rung_at(c->rung, row, col);
	const char *name = project_text(project, pin);
	const int height = rung_height(c->rung, row, col);
	struct arg arg;

	for (int i = 1; i < height; i++)
		if (rung_at(c->rung, row + i, col)->operand == pin)
			return true;
	return box->args && args_find(project_text(project, box->args), name,
				      strlen(name), &arg);
}

static bool may_add(struct canvas *c, const struct project *project, int row, int col,
		    uint32_t pin)
{
	const enum word word = canvas_word(c, row, col);
	const struct word_row *words = words_row(&project->words, word);
	enum grid_refusal why;

	if (words->place != PLACE_BOX || words->kind == WORD_ELEM)
		return canvas_fail(c, GRID_NO_BOX);
	why = judge(words, project_text(project, pin));
	if (why == GRID_DONE && is_connected(c, project, row, col, pin))
		why = GRID_PIN_TAKEN;
	return why == GRID_DONE || canvas_fail(c, why);
}

/* The row right below the box gets free in column @col and before it. */
static bool room_below(struct canvas *c, int row, int col)
{
	if (row == c->rung->rows)
		return canvas_rows(c, row + 1);
	if ((!canvas_is_empty(c, row, col) || canvas_bar_used(c, row, col)) &&
	    !canvas_insert_row(c, row))
		return false;
	return !canvas_bar_used(c, row, col) || canvas_fail(c, GRID_CROSSING);
}

static void add_row(struct canvas *c, struct grid_at *at, uint32_t pin,
		    const struct cell *feed)
{
	const struct cell cell = { .word = ELEM_PIN, .operand = pin };
	int col = at->col, row = at->row + rung_height(c->rung, at->row, at->col);

	if (col == 0 && !canvas_insert_column(c, col++))
		return;
	if (!room_below(c, row, col))
		return;
	canvas_put(c, row, col, cell);
	if (feed) {
		const enum place place = word_row((enum word)feed->word)->place;

		if (place != PLACE_SERIES && place != PLACE_BOX) {
			canvas_fail(c, GRID_NO_WORD);
			return;
		}
		canvas_put(c, row, col - 1, *feed);
		canvas_close_left(c, row, col - 1);
	}
	at->row = row;
	at->col = col - 1;
	canvas_mark(c, row, col - 1);
}

/* A row of pins is a part of the box above it. */
static void climb_to_box(const struct rung *rung, struct grid_at *at)
{
	if (at->col < 0 || at->col >= rung->cols || at->row >= rung->rows)
		return;
	while (at->row > 0 && rung_at(rung, at->row, at->col)->word == ELEM_PIN)
		at->row--;
}

struct rung *grid_add_pin(const struct rung *rung, struct grid_at *at,
			  const struct project *project, uint32_t pin,
			  const struct cell *feed)
{
	struct canvas c;

	climb_to_box(rung, at);
	if (canvas_at_element(&c, rung, at) &&
	    may_add(&c, project, at->row, at->col, pin))
		add_row(&c, at, pin, feed);
	return canvas_close(&c, at);
}
