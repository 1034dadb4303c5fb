/* SPDX-License-Identifier: MIT
 *
 * rungs - which rungs of a program are drawn, and with what power.
 */
#ifndef LADDER_RUNGS_H
#define LADDER_RUNGS_H

#include "ladder/report.h"

#include "engine/show/show.h"

/**
 * rungs_show - draws rungs by their name
 * @name:     a POU, a rung's number or label, POU:RUNG; INSTANCE or INSTANCE:RUNG of
 *            a block of the project, with @resource; NULL: all
 * @resource: of a watched program: wires with power are thick; NULL: no power
 * @options:  its power is taken from @resource
 *
 * Returns as show_rungs().
 */
int rungs_show(const struct project *project, const char *name,
	       const struct resource *resource, struct show_options options,
	       const struct sink *out);
#endif
