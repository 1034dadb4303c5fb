/* SPDX-License-Identifier: MIT
 *
 * attempt - `Target ?= reference`: the reference, or NULL if it leads to another type.
 */
#ifndef CHECK_ATTEMPT_H
#define CHECK_ATTEMPT_H

#include "engine/check/scope.h"
#include "engine/model/expr.h"

enum attempt { ATTEMPT_STORES, ATTEMPT_NULL, ATTEMPT_WRONG };
/** attempt_of - what the assignment of @expr does; ATTEMPT_WRONG: a side is no reference. Scan-safe: no. */
enum attempt attempt_of(struct scope *scope, const struct pou *pou, struct expr *expr);
#endif
