/* SPDX-License-Identifier: MIT
 *
 * check_sfc_names - names in a chart outside its rungs and lists.
 *
 * A part of check_names. check_sfc checks FROM, TO and the structure of the chart.
 */
#ifndef CHECK_CHECK_SFC_NAMES_H
#define CHECK_CHECK_SFC_NAMES_H

#include "engine/check/scope.h"
#include "engine/check/uses.h"

/**
 * check_sfc_names - names of steps, transitions and actions, each once; what its lines,
 * its supervision and CONTROL work on; TRANSITION in lists of actions. Notes the uses.
 * @pou:     a chart
 * @scratch: some memory, dead afterwards
 *
 * Scan-safe: no.   Fails: false when it added an error, or memory is out.
 */
bool check_sfc_names(struct scope *scope, const struct pou *pou, struct uses *uses,
		     struct arena *scratch, struct diag_list *diags);
#endif
