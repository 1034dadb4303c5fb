/* SPDX-License-Identifier: MIT
 *
 * check - what is wrong with a project that could be read.
 *
 * Topology of rungs and names here; types are found over the instruction list
 * (check_il.h), once for LD and IL. It translates nothing.
 */
#ifndef CHECK_CHECK_H
#define CHECK_CHECK_H

#include "engine/base/diag.h"
#include "engine/model/network.h"
#include "engine/model/project.h"

/**
 * check_rung - topology of one rung
 * @pou:     name of its POU, for diagnostics
 * @number:  1-based number of the rung
 * @network: its graph
 *
 * LD201 … LD214. Scan-safe: no.   Fails: false when it added an error.
 */
bool check_rung(const struct project *project, const struct pou *pou, int number,
		const struct rung *rung, const struct network *network,
		struct diag_list *diags);

/**
 * check_names - declarations, labels, instances, uses of variables in a project
 *
 * Unknown and duplicate names, labels, AT types, writes to inputs and constants,
 * coils in two places, instances called twice, never written, never read,
 * unreachable rungs.   Fails: false when it added an error.
 */
bool check_names(struct project *project, struct diag_list *diags);
#endif
