/* SPDX-License-Identifier: MIT
 *
 * check_fbd - networks of a body in FBD: the names of their lines, sources and readers of wires, order,
 * labels. Types are left to the translation and to check_il.
 */
#ifndef CHECK_CHECK_FBD_H
#define CHECK_CHECK_FBD_H

#include "engine/check/check_operand.h"

/** check_fbd - all networks of c->pou that are not OFF; c->rung is NULL. Notes the uses.
 * Scan-safe: no. Fails: false (and c->good too) when it added an error. */
bool check_fbd(struct operand_check *c, struct arena *scratch);
#endif
