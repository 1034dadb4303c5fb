/* SPDX-License-Identifier: MIT
 *
 * grid - one rung of the walker: nets by union-find, elements in reading order.
 */
#ifndef WALKER_GRID_H
#define WALKER_GRID_H

#include "tests/walker/inside.h"

/* A parameter of a box, or a pin fed by a row of its own. */
struct parameter {
	int pin;              /* of an FB: number in its row; else input      */
	bool output, inverse; /* inverse: /, the value is inverted            */
	struct placed placed;
	int net;              /* of a fed pin; -1: a written parameter        */
};

struct walked {
	int row, col;
	enum word word;
	int in, out;          /* nets                                         */
	bool read;            /* the power behind it is used                  */
	struct placed operand;
	struct block *block;
	struct frame *callee; /* of a function or block of the project        */
	struct expression *expression;
	struct parameter *parameter;
	int parameter_count;
	enum iec_type inputs; /* common type of a function                    */
	int target;           /* rung a jump goes to, POU that CALL runs      */
	const struct boxed *boxed; /* of EXECUTE                              */
	bool memory;          /* of an edge                                   */
	bool done;            /* in this evaluation                           */
	bool power_in, power_out;
};

struct walked_pou;
struct walked_rung {
	const struct rung *rung;
	struct walked_pou *owner; /* set when it is evaluated                 */
	int *net;             /* of each bar                                  */
	struct walked *element;
	int count;
	uint64_t scan;        /* it was evaluated last                        */
	int stopped;          /* element that ended it; count: none           */
};

struct walked_pou {
	const struct pou *pou;
	struct frame *frame;
	struct walked_rung *rung;
	struct played_sfc *sfc; /* of a chart                                    */
	struct expression **statement; /* by item of pou->st; NULL: not yet    */
};

/** grid_make - the graph of a rung; false: out of memory or cannot walk. */
bool grid_make(struct walker *walker, const struct frame *frame,
	       const struct rung *rung, struct walked_rung *out);
int grid_net(const struct walked_rung *walked, int row, int bar);
#define GRID_RAIL(walked) grid_net(walked, 0, 0)
#endif
