/* SPDX-License-Identifier: MIT
 *
 * to_classic - a project as one of ClassicLadder's, of LinuxCNC's or as a bare rung file.
 *
 * Variables get numbers (those of an imported project the ones they came from), rungs a
 * grid of 12 x 8 or 10 x 6; what does not fit so, or would be evaluated in another order
 * there, is cut into several with bits between them. What cannot be said there is a
 * diagnostic with its place (LD730 to LD738): nothing is written then.
 */
#ifndef CLASSIC_TO_CLASSIC_H
#define CLASSIC_TO_CLASSIC_H

#include "engine/base/diag.h"
#include "engine/exchange/classic/classic.h"
#include "engine/exchange/report.h"
#include "engine/model/project.h"

/* An I/O map in their terms; what it cannot say there was told when it was made. */
struct classic_lines {
	const struct classic_io *io;
	int count;
	int sample_ms;         /* inputs are looked at so often; 0: as usual    */
};

/** classic_sfc_fits - can each chart be a sequential page? Else they are written as
 * ladders first (sfc_ladder.h). Scan-safe: no. */
bool classic_sfc_fits(const struct project *project);
/**
 * to_classic - @project as a ClassicLadder project
 * @project: without errors; its table of names grows
 * @lines:   of its I/O map; NULL: none. Borrowed as long as what is returned lives
 * @arena:   owns what is returned
 * @report:  gets what means something else there
 *
 * Owns: @arena.   Scan-safe: no.   Fails: NULL and at least one diagnostic.
 */
struct classic_project *to_classic(struct project *project, enum classic_dialect dialect,
				   const struct classic_lines *lines, struct arena *arena,
				   struct classic_report *report, struct diag_list *diags);
#endif
