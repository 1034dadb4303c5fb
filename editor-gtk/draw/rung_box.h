/* SPDX-License-Identifier: MIT
 *
 * rung_box - a function or function block as a box: its pins, how large it is.
 *
 * Pins that carry power stand in the rows of the rung; all others follow below, with the
 * connected values beside them. Parameters are not checked here.
 */
#ifndef EDITOR_RUNG_BOX_H
#define EDITOR_RUNG_BOX_H

#include "editor-gtk/draw/rung_layout.h"

#define BOX_LINE    16      /* px from pin to pin                              */
#define BOX_ABOVE   26      /* from its top to the first wire                  */
#define BOX_BELOW   12      /* from its last pin to its lower edge             */
#define BOX_VALUE   22      /* more for a live value inside                    */
#define BOX_PIN_MOST 64     /* on each side; more are not shown                */
#define BOX_STUB    12      /* px from a value to the side                     */

struct rung_pin {
	const char *name;   /* borrowed, not NUL-ended                         */
	const char *value;  /* connected to it; NULL: nothing                  */
	size_t name_len, value_len;
	float y;            /* below the first wire                            */
	bool inverse;       /* the value goes in inverted                      */
	bool power;         /* a row of the rung leads to it or from it        */
};
struct rung_side {
	struct rung_pin pin[BOX_PIN_MOST];
	int count, others;  /* all; those that carry no power, the last ones    */
	float name_width, value_width;
	bool cut;           /* there are more                                  */
};
struct rung_box {
	const struct word_row *row;
	const struct cell *cell;
	int top, last, col;      /* of the rung                                */
	struct rung_side in, out;
	float lead, inner, tail; /* px: before, between and behind its sides    */
	float left, right;       /* px from its middle to the ends of all of it */
	float name_most, value_most; /* px of its name, of a value at a pin     */
	bool value;              /* has room for a live value                  */
	float bottom;            /* below the first wire                       */
	float x;                 /* of its left side; after rung_box_place()    */
};

/** rung_box_make - finds pins and sizes; places come with rung_box_place().
 * @row, @col: its first cell */
void rung_box_make(const struct drafting *drafting, const struct rung *rung, int row,
		   int col, struct rung_box *box);
/** rung_box_place - gives x, bottom and the y of all pins.
 * @row: places of the rows, known from box->top down to box->last */
void rung_box_place(struct rung_box *box, const struct rung_row *row, float column_x,
		    float column_width);
/** rung_box_at - both, for the box whose first cell is (row, col) of a rung that is laid out. */
void rung_box_at(const struct drafting *drafting, const struct rung_layout *layout, int row,
		 int col, struct rung_box *box);

#endif
