/* SPDX-License-Identifier: MIT
 *
 * show - rungs and charts drawn as text in a terminal.
 *
 * Everything is written to a sink and nothing is checked: rungs with errors are drawn
 * as they are. Control characters in a user's text are not printed, except newlines.
 */
#ifndef SHOW_H
#define SHOW_H

#include "engine/base/sink.h"
#include "engine/model/project.h"

struct fbd_graph;

struct show_options {
	bool ascii;   /* - | + instead of box characters                      */
	int width;    /* narrower rungs are stretched to it, in columns; 0: no */
	/* Power at the ends of a cell, 1-based as in resource_power(). Wires without
	 * power, or where it returns false, are thin. NULL: not known. */
	bool (*power)(void *context, int pou, int rung, int row, int col, bool *in,
		      bool *out);
	/* Whether a step of a chart is active, and for how long ("": not known). NULL:
	 * not known. */
	bool (*step)(void *context, int pou, int step, char *time, size_t size);
	/* The value at a pin of a network (model/fbd_graph.h), @network from 0. @text: of a
	 * number or a text, "" of a BOOL; @on: whether that is TRUE. False, or NULL: not known. */
	bool (*pin)(void *context, int pou, int network, const struct fbd_graph *graph,
		    int pin, char *text, size_t size, bool *on);
	void *context;
	const char *instance; /* of a block whose rungs are drawn; or NULL    */
};

/**
 * show_rungs - draws rungs with box characters
 * @pou:     index in the project; -1: all POUs
 * @rung:    1-based number in its POU; 0: all
 * @options: NULL: Unicode, not stretched
 *
 * A POU in IL is printed as its list. Rungs are not wrapped to the terminal's width.
 * Returns the rungs drawn (a POU in IL counts as one); 0: there is no such rung; -1: no
 * memory. Scan-safe: no.
 */
int show_rungs(const struct project *project, int pou, int rung,
	       const struct show_options *options, const struct sink *sink);

#endif
