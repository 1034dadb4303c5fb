/* SPDX-License-Identifier: MIT
 *
 * sandbox - a small program for targets that need one.
 */
#ifndef FUZZ_SANDBOX_H
#define FUZZ_SANDBOX_H

#include "engine/base/sink.h"
#include "engine/ladder.h"

struct sandbox {
	struct resource resource;
	struct sink sink;  /* keeps nothing                                   */
};

/** sandbox_open - the program after a cold start; built once and kept. */
struct sandbox *sandbox_open(void);
#endif
