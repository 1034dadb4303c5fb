/* SPDX-License-Identifier: MIT
 *
 * cases - the parts of the case maker, which runs on the machine that builds.
 */
#ifndef GUEST_CASES_H
#define GUEST_CASES_H

#include <stdbool.h>
#include <stdint.h>

/** make_plan - writes NAME.plan to @folder, from a program, its scenarios and its map.
 * @map: NULL: also writes NAME.io. Returns 0; 1: an error, with a message; 3: the
 * program uses more than bits, or has tasks. */
int make_plan(const char *folder, const char *rung, const char *scn,
	      const char *map);
/** make_bad - writes images with one error each, from a good one. */
int make_bad(const char *folder, const char *image);
/** make_bundle - records random programs, their inputs and results. */
int make_bundle(const char *path, uint32_t count, uint64_t seed);
#endif
