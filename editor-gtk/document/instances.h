/* SPDX-License-Identifier: MIT
 *
 * instances - the instances of a function block that a project declares.
 */
#ifndef EDITOR_INSTANCES_H
#define EDITOR_INSTANCES_H

#include "engine/model/project.h"

/**
 * instance_first - the first instance of POU @pou, as the status chart names it: "Main.Lift",
 * "Main.Cell.Lift" inside another instance, "Lift" of the globals
 *
 * NULL: the POU is no function block, or nothing declares an instance. Instances in arrays have
 * no name of that kind and are left out. Caller: g_free().
 */
char *instance_first(const struct project *project, int pou);

#endif
