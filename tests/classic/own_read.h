/* SPDX-License-Identifier: MIT
 *
 * own_read - reads ClassicLadder projects for the second evaluator, without the importer.
 */
#ifndef CLASSIC_OWN_READ_H
#define CLASSIC_OWN_READ_H

#include "engine/exchange/classic/classic.h"

/** own_read - the project in a file or folder; NULL: there is none. Owns: @arena. */
struct classic_project *own_read(struct arena *arena, const char *path);
/** own_expression, own_setting - by number or key; NULL: there is none. */
const char *own_expression(const struct classic_project *project, int number);
const char *own_setting(const struct classic_project *project, const char *key);
#endif
