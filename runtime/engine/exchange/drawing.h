/* SPDX-License-Identifier: MIT
 *
 * drawing - a rung or network as another tool has drawn it: its elements and their places.
 *
 * An importer makes one for each rung and network whose elements have places; the editor shows it beside
 * the result. It says nothing that is compiled.
 */
#ifndef EXCHANGE_DRAWING_H
#define EXCHANGE_DRAWING_H

#include <stdbool.h>

enum drawn_kind { DRAWN_RAIL, DRAWN_CONTACT, DRAWN_COIL, DRAWN_BOX, DRAWN_VALUE, DRAWN_JUMP };

struct drawn_shape {
	enum drawn_kind kind;
	int x, y, width, height; /* in the units of the tool, from the left top of the drawing */
	const char *text;        /* variable, expression, type of a box, label    */
	const char *above;       /* the instance of a box; ""                      */
	const char *sign;        /* in a contact or coil: "/", "P", "N", "S", "R"; "" */
};
struct drawn_pin {
	int x, y;
	bool output, negated;
	const char *name;
};
struct drawn_line { int x1, y1, x2, y2; };

struct drawing {
	const char *pou;         /* of the result                                  */
	int number;              /* of the rung or network in it, 0-based          */
	int line;                /* in the file                                    */
	int width, height;
	struct drawn_shape *shape;
	int shapes;
	struct drawn_pin *pin;
	int pins;
	struct drawn_line *wire;
	int wires;
};
struct drawings { struct drawing *one; int count; };
#endif
