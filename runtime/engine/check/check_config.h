/* SPDX-License-Identifier: MIT
 *
 * check_config - do the names in a CONFIGURATION mean anything?
 *
 * A part of check_names; what the values of a task may be, its reader has judged.
 */
#ifndef CHECK_CHECK_CONFIG_H
#define CHECK_CHECK_CONFIG_H

#include "engine/check/scope.h"
#include "engine/check/uses.h"

/**
 * check_config - tasks, programs and areas of the project's configuration, if any
 * @uses: gets the variables that start tasks, as read
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false when it added an error.
 */
bool check_config(struct scope *scope, struct uses *uses,
		  struct diag_list *diags);
#endif
