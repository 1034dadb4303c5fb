/* SPDX-License-Identifier: MIT
 *
 * check_init - initial values of structures and of arrays of them.
 *
 * A part of check_names. Those of other variables are judged when they are read.
 */
#ifndef CHECK_CHECK_INIT_H
#define CHECK_CHECK_INIT_H

#include "engine/model/init.h"

/**
 * check_init - does the text of @var's initial values, which has parts, fit its type?
 * @walk:    *@walk NULL or what an earlier call left there; from @scratch
 * @place:   of the declaration
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false after one diagnostic.
 */
bool check_init(const struct project *project, const struct var *var,
		struct init_walk **walk, struct arena *scratch,
		struct diag_list *diags, struct diag place);
#endif
