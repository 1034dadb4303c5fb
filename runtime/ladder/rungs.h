/* SPDX-License-Identifier: MIT
 *
 * rungs - draws rungs by name, with or without power.
 */
#ifndef LADDER_RUNGS_H
#define LADDER_RUNGS_H

#include "ladder/report.h"

#include "engine/show/show.h"

/**
 * rungs_show - draws rungs by name
 * @name:     a POU, the number or label of a rung, or POU:RUNG; with @resource also
 *            INSTANCE or INSTANCE:RUNG; NULL: all
 * @resource: a watched program: wires with power are thick; NULL: no power
 * @ladder:   has @project, and the lists of networks for their results; NULL: only variables have values
 * @options:  its power functions are replaced, if there is a @resource
 *
 * Returns the same as show_rungs().
 */
int rungs_show(const struct project *project, const char *name,
	       const struct resource *resource, const struct ladder *ladder,
	       struct show_options options, const struct sink *out);
#endif
