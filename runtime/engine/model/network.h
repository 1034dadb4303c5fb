/* SPDX-License-Identifier: MIT
 *
 * network - the power-flow graph of a rung.
 *
 * Bars joined by wires and links are one net; elements lead from net to net. Checks,
 * translation and drawing use this graph. Rungs with errors have one, too.
 */
#ifndef MODEL_NETWORK_H
#define MODEL_NETWORK_H

#include "engine/base/arena.h"
#include "engine/model/rung.h"

#define NET_RAIL 0 /* the left rail is net 0                                */
#define NET_NONE -1

struct network_element {
	uint16_t row, col;  /* 0-based cell                                    */
	uint16_t word;      /* enum word; never EMPTY, WIRE or PIN             */
	int in, out;        /* nets of its left and right end                  */
	int first_pin, pins; /* its PIN rows with an operand, in network.pin   */
};

struct network_pin {
	uint16_t row, col;
	uint32_t operand;   /* string id: the pin's name                       */
	int in;             /* net of its left end                             */
};

struct network {
	int rows, cols;
	int net_count;
	int *bar_net;               /* rows * (cols + 1), by row               */
	struct network_element *element; /* in reading order: rows, then cols  */
	int element_count;
	struct network_pin *pin;
	int pin_count;
	/* Elements that lead into net n (coils too), in reading order:
	 * feeder[first_feeder[n]] … feeder[first_feeder[n + 1] - 1]. */
	int *first_feeder, *feeder;
	/* Number of elements and pins that read net n. */
	int *reader_count;
};

/**
 * network_make - the graph of a rung
 * @out: caller's; everything in it is allocated from @arena
 *
 * Owns: @arena.   Scan-safe: no.   Fails: false when memory is out.
 */
bool network_make(const struct rung *rung, struct arena *arena,
		  struct network *out);
/** network_net - net of bar @bar of @row. */
int network_net(const struct network *network, int row, int bar);
#endif
