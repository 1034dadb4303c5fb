/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder - writes a project with ladders instead of its charts.
 *
 * A chart becomes two programs over a bit for each step: one moves from step to step, one
 * runs the actions. Bodies of lists and rungs become subroutines. In each scan they do what
 * docs/sfc.md says of the chart.
 */
#ifndef CLASSIC_SFC_LADDER_H
#define CLASSIC_SFC_LADDER_H

#include "engine/base/diag.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"

/**
 * sfc_ladder - the text of @project with ladders instead of its charts
 * @project: without errors; its table of names grows
 * @wanted:  a byte a POU: 1 for a chart that becomes ladders; NULL: all of them
 * @sink:    gets the text, which is not canonical
 *
 * A part that a ladder cannot express is a diagnostic LD460 with its place.
 * Owns: nothing.   Scan-safe: no.   Fails: false after a diagnostic.
 */
bool sfc_ladder(struct project *project, const uint8_t *wanted, const struct sink *sink,
		struct diag_list *diags);
#endif
