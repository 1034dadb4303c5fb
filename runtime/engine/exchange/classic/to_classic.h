/* SPDX-License-Identifier: MIT
 *
 * to_classic - a project as one of ClassicLadder, of LinuxCNC, or as a bare rung file.
 *
 * Variables get numbers; those of an imported project keep theirs. Rungs get a grid of
 * 12 x 8 or 10 x 6; one that does not fit, or would be evaluated in another order, is cut
 * into several with bits between them. What ClassicLadder cannot hold is a diagnostic with
 * its place (LD730 to LD739), and there is no result.
 */
#ifndef CLASSIC_TO_CLASSIC_H
#define CLASSIC_TO_CLASSIC_H

#include "engine/base/diag.h"
#include "engine/exchange/classic/classic.h"
#include "engine/exchange/report.h"
#include "engine/model/project.h"

/* An I/O map as lines of ioconf.csv. The code that makes it reports what does not fit. */
struct classic_lines {
	const struct classic_io *io;
	int count;
	int sample_ms;         /* time between samples of inputs; 0: the default */
};

/** classic_sfc_fits - true if each chart can be a sequential page. Else sfc_ladder() must
 * write them as ladders first. Scan-safe: no. */
bool classic_sfc_fits(const struct project *project);
/**
 * to_classic - converts @project
 * @project: without errors; its table of names grows
 * @lines:   of its I/O map; NULL: none. Borrowed as long as the result lives
 * @arena:   owns the result
 * @report:  gets what changes its meaning or is not exported
 *
 * Owns: @arena.   Scan-safe: no.   Fails: NULL and at least one diagnostic.
 */
struct classic_project *to_classic(struct project *project, enum classic_dialect dialect,
				   const struct classic_lines *lines, struct arena *arena,
				   struct classic_report *report, struct diag_list *diags);
#endif
