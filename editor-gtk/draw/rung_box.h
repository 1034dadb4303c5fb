/* SPDX-License-Identifier: MIT
 *
 * rung_box - a function or function block as a box: its pins and its size.
 *
 * Pins that carry power are in the rows of the rung; the others follow below, with the
 * connected values beside them. Parameters are not checked here.
 */
#ifndef EDITOR_RUNG_BOX_H
#define EDITOR_RUNG_BOX_H

#include "editor-gtk/draw/rung_layout.h"

#define BOX_LINE    16      /* px from pin to pin                              */
#define BOX_ABOVE   26      /* from its top to the first wire                  */
#define BOX_BELOW   12      /* from its last pin to its lower edge             */
#define BOX_VALUE   22      /* more for a live value inside                    */
#define BOX_PIN_MOST 64     /* on each side; further pins are not shown        */
#define BOX_STUB    12      /* px from a value to the side                     */

struct rung_pin {
	const char *name;   /* borrowed, not NUL-ended                         */
	const char *value;  /* connected to it; NULL: nothing                  */
	size_t name_len, value_len;
	float y;            /* px below the first wire                         */
	bool inverse;       /* the value goes in inverted                      */
	bool power;         /* it has a row of the rung                        */
};
struct rung_side {
	struct rung_pin pin[BOX_PIN_MOST];
	int count, others;  /* the pins that carry no power come last           */
	float name_width, value_width;
	bool cut;           /* more pins than are shown                        */
};
struct rung_box {
	const struct word_row *row;
	const struct cell *cell;
	int top, last, col;      /* of the rung                                */
	struct rung_side in, out;
	float lead, inner, tail; /* px: before, between and behind its sides    */
	float left, right;       /* px from its middle to its outer ends */
	float name_most, value_most; /* px, most of its name, of a value at a pin */
	bool value;              /* reserves room for a live value             */
	float bottom;            /* below the first wire                       */
	float x;                 /* of its left side; set by rung_box_place()   */
};

/** rung_box_make - finds pins and sizes; rung_box_place() finds the places.
 * @row, @col: its first cell */
void rung_box_make(const struct drafting *drafting, const struct rung *rung, int row,
		   int col, struct rung_box *box);
/** rung_box_place - sets x, bottom and the y of all pins.
 * @row: places of the rows, valid from box->top to box->last */
void rung_box_place(struct rung_box *box, const struct rung_row *row, float column_x,
		    float column_width);
/** rung_box_at - both, for the box whose first cell is (row, col) of a finished layout. */
void rung_box_at(const struct drafting *drafting, const struct rung_layout *layout, int row,
		 int col, struct rung_box *box);

#endif
