/* SPDX-License-Identifier: MIT
 *
 * grid_box - a function or function block: frame, pins, what is connected.
 */
#include "editor-gtk/draw/grid_pen.h"

#include <glib.h>

#define PADDING   6
#define MIDDLE    4.5f  /* baseline of a text whose middle is on a line          */
#define CIRCLE    3     /* radius of an inverting pin                            */

static struct lettered fit(const struct pen *pen, enum letter letter, const char *text,
			   size_t len, float bound)
{
	return lettering_fit(pen->drafting->lettering, letter, text, (ptrdiff_t)len, bound);
}

static void draw_pin(const struct pen *pen, const struct rung_box *box,
		     const struct rung_pin *pin, bool output)
{
	float y = pen->layout->row[box->top].wire + pin->y;
	float side = output ? box->x + box->inner : box->x, way = output ? 1 : -1;
	struct lettered name = fit(pen, LETTER_PIN, pin->name, pin->name_len, 140);
	struct wire idle = { TOKEN_IDLE, STROKE_SOLID, pen->theme->idle_width };

	picture_text(pen->picture, pen->ink, LETTER_PIN, name,
		     output ? side - PADDING - name.width : side + PADDING, y + MIDDLE);
	if (!pin->value)
		return;
	struct lettered value = fit(pen, LETTER_OPERAND, pin->value, pin->value_len,
				    box->value_most);
	float from = side + (pin->inverse ? way * 2 * CIRCLE : 0);
	pen_line(pen, idle, from, y, side + way * BOX_STUB, y);
	if (pin->inverse)
		picture_arc(pen->picture, pen->ink, pen->theme->idle_width,
			    side + way * CIRCLE, y, CIRCLE, 0, (float)(2 * G_PI));
	float x = side + way * (BOX_STUB + 3);
	picture_text(pen->picture, pen->ink, LETTER_OPERAND, value,
		     output ? x : x - value.width, y + MIDDLE);
}

/* Rows of power that lead into the box, and the one that leads out of it. */
static void draw_power(const struct pen *pen, const struct rung_box *box)
{
	const struct rung_layout *layout = pen->layout;
	float y = layout->row[box->top].wire;

	for (int row = box->top; row <= box->last; row++) {
		float at = layout->row[row].wire;

		if (row == box->top || rung_at(pen->rung, row, box->col)->operand)
			pen_line(pen, pen_wire(pen, pen_net(pen, row, box->col)),
				 rung_layout_bar(layout, row, box->col), at, box->x, at);
	}
	pen_line(pen, pen_wire(pen, pen_live(pen, box->top, box->col)),
		 box->x + box->inner, y,
		 rung_layout_bar(layout, box->top, box->col + 1), y);
}

static void draw_value(const struct pen *pen, const struct rung_box *box, float bottom)
{
	const struct grid_live *live = pen->scene->live;
	struct live_value value;

	if (!box->value || !live || !live->value ||
	    !live->value(live->context, box->top, box->col, &value))
		return;
	float room = box->inner - 2 * PADDING;
	struct lettered text = lettering_fit(pen->drafting->lettering, LETTER_VALUE,
					     value.text, -1, room);
	pen_text(pen, TOKEN_ACCENT, LETTER_VALUE, text, box->x + box->inner / 2,
		 bottom - 12);
	if (value.part < 0)
		return;
	float part = MIN(value.part, 1);
	picture_fill(pen->picture, TOKEN_LINE, 1, box->x + PADDING, bottom - 7, room, 3);
	picture_fill(pen->picture, TOKEN_POWER, 1, box->x + PADDING, bottom - 7,
		     room * part, 3);
}

static void draw_frame(const struct pen *pen, const struct rung_box *box)
{
	float y = pen->layout->row[box->top].wire, middle = box->x + box->inner / 2;
	bool lit = pen_live(pen, box->top, box->col) & LIVE_OUT;
	const char *instance = project_text(pen->drafting->project, box->cell->operand);
	int column = rung_layout_column(pen->layout, box->top, box->col);
	bool wrong = pen_marks(pen, box->top, column) & MARK_ERROR;

	if (pen_live(pen, box->top, box->col) & LIVE_FRESH)
		picture_fill(pen->picture, TOKEN_ACCENT, pen->theme->wash, box->x,
			     y - BOX_ABOVE, box->inner, BOX_ABOVE + box->bottom);
	picture_frame(pen->picture, lit ? TOKEN_POWER : pen->ink, STROKE_SOLID,
		      lit ? pen->theme->power_width : pen->theme->shape_width, box->x,
		      y - BOX_ABOVE, box->inner, BOX_ABOVE + box->bottom);
	pen_text(pen, pen->ink, LETTER_TYPE,
		 lettering_fit(pen->drafting->lettering, LETTER_TYPE, box->row->word, -1,
			       280), middle, y - BOX_ABOVE + 15);
	if (*instance)
		pen_text(pen, wrong ? TOKEN_ERROR : pen->ink, LETTER_SYMBOL,
			 lettering_fit(pen->drafting->lettering, LETTER_SYMBOL, instance,
				       -1, box->name_most), middle, y - BOX_ABOVE - 5);
	draw_value(pen, box, y + box->bottom);
	if (box->in.cut || box->out.cut)
		pen_text(pen, pen->ink, LETTER_PIN,
			 lettering_fit(pen->drafting->lettering, LETTER_PIN, "\xe2\x80\xa6",
				       -1, 0), middle, y + box->bottom - 3);
}

void grid_draw_box(const struct pen *pen, int row, int col)
{
	int column = rung_layout_column(pen->layout, row, col);
	struct rung_box box;

	rung_box_make(pen->drafting, pen->rung, row, col, &box);
	rung_box_place(&box, pen->layout->row, pen->layout->column_x[column],
		       pen->layout->column_width[column]);
	draw_power(pen, &box);
	draw_frame(pen, &box);
	for (int i = 0; i < box.in.count; i++)
		draw_pin(pen, &box, &box.in.pin[i], false);
	for (int i = 0; i < box.out.count; i++)
		draw_pin(pen, &box, &box.out.pin[i], true);
}
