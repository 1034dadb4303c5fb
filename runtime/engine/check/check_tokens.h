/* SPDX-License-Identifier: MIT
 *
 * check_tokens - what a chart can come to: which steps can be active together.
 *
 * Any condition may be true or false at any time, except the constants TRUE and FALSE;
 * RESET and FORCE by an operator are ignored. So no state is missed, but a state may need
 * inputs that the machine never gives: all messages are warnings.
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
