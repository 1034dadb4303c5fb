/* SPDX-License-Identifier: MIT
 *
 * values - which enumeration a name is a value of, when several have it: the place says so.
 *
 * `Lamp := Red`, `Lamp = Red`, a value of a CASE of Lamp, an argument at a pin of Lamp's type. A list has the name of
 * the type afterwards: `EQ Light#Red`. Where nothing stands beside the name that has an enumeration, it stays as it
 * is, and check_il() reports it (LD382).
 */
#ifndef CHECK_VALUES_H
#define CHECK_VALUES_H

#include "engine/check/scope.h"
#include "engine/model/il.h"

/** values_choose - the operand @operand as a value of the enumeration of what @like names; @operand itself if it is
 * no value of several, or @like has none. Scan-safe: no. */
uint32_t values_choose(struct scope *scope, const struct pou *pou, uint32_t operand, uint32_t like);
/** values_in_list - the same for all lines of @il, a list of @pou; lines of it are changed. Scan-safe: no. */
void values_in_list(struct scope *scope, const struct pou *pou, struct il *il);
#endif
