/* SPDX-License-Identifier: MIT
 *
 * random_project - makes a ClassicLadder project and a script from a seed.
 *
 * Most of it is what the editor of ClassicLadder allows; some is not, but its engine runs it.
 * Nothing is made that does not end or has no defined meaning there.
 */
#ifndef CLASSIC_RANDOM_PROJECT_H
#define CLASSIC_RANDOM_PROJECT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct random_texts {
	char *project, *script;  /* free() each                                */
};

/** random_project - both texts of a seed. @odd: also what the editor does not allow. false: no
 * memory. */
bool random_project(uint64_t seed, bool odd, struct random_texts *texts);
#endif
