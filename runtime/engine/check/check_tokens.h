/* SPDX-License-Identifier: MIT
 *
 * check_tokens - what a chart can come to: which steps can be active together.
 *
 * Each condition may be true or not at any time, but for the constants TRUE and FALSE;
 * what an operator does with RESET and FORCE is not looked at. So nothing is overlooked,
 * and what is told may need inputs that the machine never gives: all are warnings.
 */
#ifndef CHECK_CHECK_TOKENS_H
#define CHECK_CHECK_TOKENS_H

#include "engine/check/scope.h"

/**
 * check_tokens - LD450 … LD455 of a chart in which check_sfc() found no error
 * @scratch: up to LIMIT_MARKINGS states; dead afterwards
 *
 * A chart of branches that come together again as they parted is proven in the order of
 * its size; of others the states are looked at one by one, as many as the limit allows.
 * Owns: nothing.   Scan-safe: no.   Fails: when memory is out, which @scratch knows.
 */
void check_tokens(struct scope *scope, const struct pou *pou, struct arena *scratch,
		  struct diag_list *diags);
#endif
