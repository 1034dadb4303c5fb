/* SPDX-License-Identifier: MIT
 *
 * cases - what the case maker makes; it runs on the machine that builds.
 */
#ifndef GUEST_CASES_H
#define GUEST_CASES_H

#include <stdbool.h>
#include <stdint.h>

/** make_plan - NAME.plan in @folder, from a program, its scenarios and its map.
 * @map: NULL: NAME.io is made, too. Gives 0; 1: an error, told on stderr; 3: the
 * program uses more than bits or has tasks. */
int make_plan(const char *folder, const char *rung, const char *scn,
	      const char *map);
/** make_bad - images that no ladderd may run, from a good one. */
int make_bad(const char *folder, const char *image);
/** make_bundle - random programs, inputs and what they do here. */
int make_bundle(const char *path, uint32_t count, uint64_t seed);
#endif
