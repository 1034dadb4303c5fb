/* SPDX-License-Identifier: MIT
 *
 * caller - a text whose function main needs no argument, without a program or with one that main
 * calls: as in other languages, it runs.
 */
#ifndef MODEL_CALLER_H
#define MODEL_CALLER_H

#include "engine/model/project.h"

/**
 * caller_add - adds a program behind the POUs that calls main in each scan, if there is such a
 * function, and stores the result in a variable of its name
 *
 * The program is not in the file: the caller sets project->pou_count back. Scan-safe: no.
 * Fails: false: no memory.
 */
bool caller_add(struct project *project);
#endif
