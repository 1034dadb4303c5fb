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
#include "engine/check/scope.h"
#include "engine/model/network.h"
#include "engine/model/project.h"

/**
 * check_rung - topology of one rung
 * @pou:     name of its POU, for diagnostics
 * @number:  1-based number of the rung
 * @network: its graph
 * @scratch: some memory a rung; the caller resets it between rungs
 *
 * LD201 … LD214; a rung that is OFF is good. A fault is reported once, where it
 * begins, without the faults that follow from it.
 * Owns: nothing.   Scan-safe: no.   Fails: false when it added an error.
 */
bool check_rung(const struct project *project, const struct pou *pou,
		int number, const struct rung *rung,
		const struct network *network,
		struct arena *scratch, struct diag_list *diags);

/**
 * check_loops - do FOR and NEXT of a ladder pair, each alone in its rung?
 * @first, @count: rungs of the ladder: of a chart one of its bodies
 * @bad: as in check_names, of this POU; NULL: none
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when it added an error.
 */
bool check_loops(const struct project *project, const struct pou *pou, int first,
		 int count, uint8_t *bad, struct diag_list *diags);

/**
 * check_names - declarations, labels, instances, uses of variables in a project
 * @scope:   of the project
 * @bad:     NULL, or for each POU NULL or a byte a rung; set to 1 for a rung
 *           that has an error, so that translation can leave it out; behind
 *           them, of a chart, one for what is no rung
 * @scratch: some memory a project; dead afterwards
 *
 * Unknown and duplicate names, labels, AT types, writes to inputs and
 * constants, coils in more than one place, instances called twice, never written, never
 * read, unreachable rungs. Of an IL POU it only counts the uses: check_il()
 * judges it.
 * Owns: nothing.   Scan-safe: no.   Fails: false when it added an error.
 */
bool check_names(struct scope *scope, uint8_t *const *bad,
		 struct arena *scratch, struct diag_list *diags);
#endif
