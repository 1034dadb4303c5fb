/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder - a project whose charts are written as ladders.
 *
 * Of each chart a program that moves from step to step and one that does what the steps
 * ask for, over a bit for each step; bodies of lists and rungs become subroutines. It
 * does in each scan what the chart does, as docs/sfc.md has it.
 */
#ifndef CLASSIC_SFC_LADDER_H
#define CLASSIC_SFC_LADDER_H

#include "engine/base/diag.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"

/**
 * sfc_ladder - the text of @project with ladders in the place of its charts
 * @project: without errors; its table of names grows
 * @sink:    gets the text, which is not canonical
 *
 * Adds LD460 with its place for each part that has no ladder.
 * Owns: nothing.   Scan-safe: no.   Fails: false after a diagnostic.
 */
bool sfc_ladder(struct project *project, const struct sink *sink,
		struct diag_list *diags);
#endif
