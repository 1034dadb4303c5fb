/* SPDX-License-Identifier: MIT
 *
 * located - VAR_CONFIG: addresses and initial values that a configuration gives the variables of
 * programs (IEC 61131-3, 2.7.1).
 */
#ifndef MODEL_LOCATED_H
#define MODEL_LOCATED_H

#include "engine/base/diag.h"
#include "engine/model/project.h"

/**
 * located_place - gives the variables of programs what the lines of VAR_CONFIG say
 *
 * The lines of an instance that has data of its own are compared with its program only. Types are
 * resolved, constants computed. Owns: the project's arena.   Scan-safe: no.
 * Fails: false after a diagnostic, or without memory.
 */
bool located_place(struct project *project, struct diag_list *diags);
/** located_further - the same for @pou, a further instance with its name, whose variables are copied
 * for it. Scan-safe: no.   Fails: false: no memory. */
bool located_further(struct project *project, struct pou *pou);
#endif
