/* SPDX-License-Identifier: MIT
 *
 * check_sfc - is a chart complete?
 *
 * check_names checks the names in it, check_rung and check_il its rungs and lists,
 * check_tokens the states it can reach.
 */
#ifndef CHECK_CHECK_SFC_H
#define CHECK_CHECK_SFC_H

#include "engine/check/scope.h"

/**
 * check_sfc - steps, transitions and actions: where they lead, what they lack
 * @pou:     a chart, linked and declared (model/sfc.h)
 * @scratch: some memory a chart; dead afterwards
 *
 * LD430 … LD449, and labels of lists.
 * Owns: nothing.   Scan-safe: no.   Fails: false when it added an error.
 */
bool check_sfc(struct scope *scope, const struct pou *pou, struct arena *scratch,
	       struct diag_list *diags);
#endif
