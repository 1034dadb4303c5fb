/* SPDX-License-Identifier: MIT
 *
 * ladder_inside - what the parts of the facade share. Only they include it.
 */
#ifndef ENGINE_LADDER_INSIDE_H
#define ENGINE_LADDER_INSIDE_H

#include "engine/ladder.h"

/** ladder_read_project - what was read, with its errors; NULL: nothing, an image.
 * Owns: @ladder, until its next load. */
struct project *ladder_read_project(struct ladder *ladder);
#endif
