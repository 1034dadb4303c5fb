/* SPDX-License-Identifier: MIT
 *
 * show_box - draws a function or function block as a box.
 *
 * Pins that carry power are in the rows of the rung file; the others follow below, with
 * their values beside them. Parameters are not checked.
 */
#include "engine/show/draw.h"
#include "engine/model/args.h"
#include "engine/base/plain.h"

#include <string.h>
#include <strings.h>

static bool same_name(const char *a, size_t a_len, const char *b, size_t b_len)
{
	return a_len == b_len && strncasecmp(a, b, a_len) == 0;
}

static bool side_has(const struct box_side *side, const char *name, size_t len)
{
	for (int i = 0; i < side->count; i++)
		if (same_name(side->pin[i].name, side->pin[i].name_len, name,
			      len))
			return true;
	return false;
}

static void side_add(struct box_side *side, struct box_pin pin)
{
	if (side->count == BOX_PINS)
		return;
	side->pin[side->count++] = pin;

	int name = draw_clipped(pin.name, pin.name_len, DRAW_CLIP);
	int value = pin.value ?
		    draw_clipped(pin.value, pin.value_len, DRAW_CLIP) : 0;
	if (name > side->name_width)
		side->name_width = name;
	if (value > side->value_width)
		side->value_width = value;
}

/* Adds a pin of the row, with the value written for it if there is one. */
static void side_add_named(struct draw *draw, bool output, const char *name)
{
	struct box_side *side = output ? &draw->box.out : &draw->box.in;
	struct box_pin pin = { .name = name, .name_len = strlen(name) };
	struct arg arg;

	if (args_find_side(draw->box.args, output, name, pin.name_len, &arg)) {
		pin.value = arg.value;
		pin.value_len = arg.value_len;
		pin.inverse = arg.inverse;
	}
	side_add(side, pin);
}

static bool has_row(const struct draw *draw, const char *name)
{
	const struct box *box = &draw->box;
	size_t len = strlen(name);

	for (int row = box->top + 1; row <= box->last; row++) {
		const struct cell *cell = rung_at(draw->rung, row, box->col);
		const char *pin = project_text(draw->project, cell->operand);

		if (same_name(pin, strlen(pin), name, len))
			return true;
	}
	return false;
}

/* Parameters at pins that the row does not list: IN3, errors, and a parameter at a pin
 * that carries power. */
static void add_others(struct draw *draw)
{
	const char *at = draw->box.args;
	struct arg arg;

	while (args_next(&at, &arg)) {
		struct box_side *side = arg.output ? &draw->box.out :
						     &draw->box.in;
		if (!side_has(side, arg.pin, arg.pin_len))
			side_add(side, (struct box_pin){ arg.pin, arg.value,
							 arg.pin_len,
							 arg.value_len,
							 arg.inverse });
	}
}

static const char *power_pin(const struct word_row *row, enum pin_dir dir)
{
	if (row->kind == WORD_FN)
		return dir == PIN_IN ? "EN" : "ENO";
	int pin = word_first_bool(row, dir);
	return pin < 0 ? "" : row->pin[pin].name;
}

static void add_pins(struct draw *draw)
{
	const struct word_row *row = draw->box.row;

	for (int i = 0; i < row->pin_count; i++) {
		const struct word_pin *pin = &row->pin[i];
		bool output = pin->dir == PIN_OUT;
		const char *power = output ? draw->box.power_out :
					     draw->box.power_in;

		if (pin->dir == PIN_VAR || pin->dir == PIN_NONE || strcmp(pin->name, power) == 0 ||
		    (!output && has_row(draw, pin->name)))
			continue;
		side_add_named(draw, output, pin->name);
	}
	if (row->kind == WORD_FN && !word_is_test(row))
		side_add_named(draw, true, "OUT");
	add_others(draw);
}

static int at_least(int value, int least)
{
	return value < least ? least : value;
}

static int clipped_text(const char *text)
{
	return draw_clipped(text, strlen(text), DRAW_CLIP);
}

static void measure(struct draw *draw)
{
	struct box *box = &draw->box;
	int left = at_least(box->in.name_width, clipped_text(box->power_in));
	int right = at_least(box->out.name_width, clipped_text(box->power_out));

	for (int row = box->top + 1; row <= box->last; row++) {
		const struct cell *cell = rung_at(draw->rung, row, box->col);
		left = at_least(left, clipped_text(
			project_text(draw->project, cell->operand)));
	}
	box->inner = at_least(left + 2 + right,
			      (int)strlen(box->row->word) + 4);
	box->lead = box->in.value_width ? box->in.value_width + 2 : 2;
	box->tail = box->out.value_width ? box->out.value_width + 3 : 2;
	box->need = at_least(box->lead + box->inner + 2 + box->tail,
			     clipped_text(project_text(draw->project,
					  box->cell->operand)) + 2);
}

void box_make(struct draw *draw, int row, int col)
{
	struct box *box = &draw->box;
	const struct cell *cell = rung_at(draw->rung, row, col);

	memset(box, 0, sizeof(*box));
	box->cell = cell;
	box->row = words_row(&draw->project->words, cell->word);
	box->args = project_text(draw->project, cell->args);
	box->top = row;
	box->last = row + rung_height(draw->rung, row, col) - 1;
	box->col = col;
	box->power_in = power_pin(box->row, PIN_IN);
	box->power_out = power_pin(box->row, PIN_OUT);
	add_pins(draw);
	measure(draw);
}

int box_bottom(const struct draw *draw)
{
	const struct box *box = &draw->box;
	int left = draw->y[box->last] - draw->y[box->top] + box->in.count;

	return at_least(left, box->out.count) + 1;
}

/* Columns before the left side of the box: the column may be wider than the box. */
static int box_start(const struct draw *draw)
{
	const struct box *box = &draw->box;
	int body = box->lead + box->inner + 2 + box->tail;

	return box->lead + (draw->width[box->col] - body) / 2;
}

static int box_rest(const struct draw *draw)
{
	return draw->width[draw->box.col] - box_start(draw) -
	       draw->box.inner - 2;
}

static void instance_line(const struct draw *draw)
{
	const struct box *box = &draw->box;
	int width = draw->width[box->col];
	const char *name = project_text(draw->project, box->cell->operand);
	int taken = clipped_text(name);
	int start = box_start(draw) + (box->inner + 2 - taken) / 2;

	if (start + taken > width - 1)
		start = width - 1 - taken;
	start = at_least(start, 1);
	draw_blank(draw, start);
	draw_text(draw, name, strlen(name), DRAW_CLIP);
	draw_blank(draw, width - start - taken);
}

static void edge_line(const struct draw *draw, const char *title, int corner)
{
	const struct box *box = &draw->box;
	int taken = *title ? (int)strlen(title) + 2 : 0;
	int before = (box->inner - taken) / 2;

	draw_blank(draw, box_start(draw));
	sink_text(draw->sink, draw->strokes->corner[corner]);
	draw_across(draw, before, false);
	if (*title)
		sink_printf(draw->sink, " %.*s ", DRAW_CLIP, title);
	draw_across(draw, box->inner - before - taken, false);
	sink_text(draw->sink, draw->strokes->corner[corner + 1]);
	draw_blank(draw, box_rest(draw));
}

static void left_of_box(const struct draw *draw, const struct box_pin *pin,
			bool power)
{
	int start = box_start(draw);
	const char *side = draw->strokes->side;

	if (power) {
		draw_across(draw, start, draw->in);
		side = draw->strokes->open;
	} else if (pin && pin->value) {
		int taken = draw_clipped(pin->value, pin->value_len, DRAW_CLIP);

		draw_blank(draw, start - taken - 1);
		draw_text(draw, pin->value, pin->value_len, DRAW_CLIP);
		if (pin->inverse) /* a circle at the pin */
			sink_text(draw->sink, "o");
		else
			draw_across(draw, 1, false);
		side = draw->strokes->open;
	} else {
		draw_blank(draw, start);
	}
	sink_text(draw->sink, side);
}

static void right_of_box(const struct draw *draw, const struct box_pin *pin,
			 bool power)
{
	int rest = box_rest(draw);

	if (power) {
		bool on = draw_goes_right(draw, draw->box.top, draw->box.col);

		sink_text(draw->sink, on ? draw->strokes->close :
					   draw->strokes->side);
		if (on)
			draw_across(draw, rest, draw->out);
		else
			draw_blank(draw, rest);
	} else if (pin && pin->value) {
		sink_text(draw->sink, draw->strokes->close);
		draw_across(draw, 1, false);
		draw_blank(draw, 1);
		int taken = draw_text(draw, pin->value, pin->value_len,
				      DRAW_CLIP);
		draw_blank(draw, rest - 2 - taken);
	} else {
		sink_text(draw->sink, draw->strokes->side);
		draw_blank(draw, rest);
	}
}

/* Row of the box whose power line is @line below the first; -1: none. */
static int row_of_line(const struct draw *draw, int line)
{
	const struct box *box = &draw->box;

	for (int row = box->top; row <= box->last; row++)
		if (draw->y[row] - draw->y[box->top] == line)
			return row;
	return -1;
}

static void pin_line(const struct draw *draw, int line)
{
	const struct box *box = &draw->box;
	int row = row_of_line(draw, line);
	int below = line - (draw->y[box->last] - draw->y[box->top]) - 1;
	const struct box_pin *in = NULL, *out = NULL;
	const char *left = "", *right = line == 0 ? box->power_out : "";
	size_t left_len, right_len = strlen(right);

	if (row == box->top)
		left = box->power_in;
	else if (row > 0)
		left = project_text(draw->project, rung_at(draw->rung, row,
							   box->col)->operand);
	left_len = strlen(left);
	bool fed = *left || row == box->top;

	if (below >= 0 && below < box->in.count) {
		in = &box->in.pin[below];
		left = in->name;
		left_len = in->name_len;
	}
	if (line > 0 && line <= box->out.count) {
		out = &box->out.pin[line - 1];
		right = out->name;
		right_len = out->name_len;
	}
	left_of_box(draw, in, fed);
	int taken = draw_text(draw, left, left_len, DRAW_CLIP);
	draw_blank(draw, box->inner - taken -
			 draw_clipped(right, right_len, DRAW_CLIP));
	draw_text(draw, right, right_len, DRAW_CLIP);
	right_of_box(draw, out, line == 0);
}

void box_line(struct draw *draw, int line)
{
	const struct box *box = &draw->box;
	int bottom = box_bottom(draw);

	if (line == -2 && box->cell->operand)
		instance_line(draw);
	else if (line == -1)
		edge_line(draw, box->row->word, 0);
	else if (line == bottom)
		edge_line(draw, "", 2);
	else if (line < -1 || line > bottom)
		draw_blank(draw, draw->width[box->col]);
	else
		pin_line(draw, line);
}
