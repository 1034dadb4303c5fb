/* SPDX-License-Identifier: MIT
 *
 * sandbox - a small program for targets that need one to speak of.
 */
#ifndef FUZZ_SANDBOX_H
#define FUZZ_SANDBOX_H

#include "engine/base/sink.h"
#include "engine/ladder.h"

struct sandbox {
	struct resource resource;
	struct sink sink;  /* swallows what is written                        */
};

/** sandbox_open - the program at a cold start; built once and kept. */
struct sandbox *sandbox_open(void);
#endif
