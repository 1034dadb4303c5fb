/* SPDX-License-Identifier: MIT
 *
 * pins - the values at the pins of networks after a scan, for `ladder show --after`.
 */
#ifndef LADDER_PINS_H
#define LADDER_PINS_H

#include "engine/model/fbd_graph.h"
#include "engine/model/il.h"
#include "engine/scan/resource.h"

/* Whose values: of a POU, and of which of its instances. */
struct pins {
	const struct project *project;
	const struct resource *resource;
	const struct il *il;     /* of the POU; NULL: results that no variable has are not known */
	int pou;
	const char *instance;    /* of a block; NULL: none                      */
};

/**
 * pins_value - the value at a pin
 * @network: from 0   @text: of a number or a text; "" of a BOOL   @on: whether that is TRUE
 *
 * A result that no variable has needs ladder_watch_lists(). False: it is not known.
 */
bool pins_value(const struct pins *pins, int network, const struct fbd_graph *graph, int pin, char *text, size_t size,
		bool *on);
#endif
