/* SPDX-License-Identifier: MIT
 *
 * random_project - ClassicLadder projects with a script each, from a seed.
 *
 * Mostly what its editor allows; a few things that it does not and that its engine runs
 * all the same. What would not end or has no defined meaning there is not made.
 */
#ifndef CLASSIC_RANDOM_PROJECT_H
#define CLASSIC_RANDOM_PROJECT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct random_texts {
	char *project, *script;  /* free() each                                */
};

/** random_project - both texts of a seed; @odd: also what the editor would not allow.
 * false: no memory. */
bool random_project(uint64_t seed, bool odd, struct random_texts *texts);
#endif
