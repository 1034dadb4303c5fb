/* SPDX-License-Identifier: MIT
 *
 * sfc_graph - a chart as points and edges that can be drawn from top to bottom.
 *
 * Points are steps, then transitions, then one root for each chart: that of the program,
 * then those in macro-steps. An edge that leads up, to nothing, or out of its chart is
 * `far`: it is not drawn as a line. What remains has no loops, and each point has one
 * dominator: the last point through which every way to it leads. It judges nothing.
 */
#ifndef SHOW_SFC_GRAPH_H
#define SHOW_SFC_GRAPH_H

#include "engine/base/arena.h"
#include "engine/model/sfc.h"

struct sfc_edge {
	int to;            /* point; -1: none of this name in this chart       */
	int ref;           /* of sfc.ref; -1: from a root                     */
	bool far;
};

struct sfc_graph {
	const struct sfc *sfc;
	int steps, transitions, points; /* points: with the roots               */
	struct sfc_edge *edge;         /* those out of point n: first[n] …     */
	int *first;                    /* points + 1                           */
	int *order;                    /* points from top to bottom, with roots */
	int *ways;                     /* edges to a point that are not far    */
	int *dominator;                /* -1: a root                          */
	int *merge;                    /* by dominator: the first point below it
					  that several ways lead to; -1      */
	int *next;                     /* merge: the next of them, downwards  */
};

/**
 * sfc_graph_make - of any chart, right or wrong
 * @arena: for everything in it
 *
 * Scan-safe: no.   Fails: false: no memory.
 */
bool sfc_graph_make(struct sfc_graph *graph, const struct sfc *sfc, struct arena *arena);

#endif
