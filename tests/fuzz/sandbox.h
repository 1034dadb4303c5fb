/* SPDX-License-Identifier: MIT
 *
 * sandbox - a small program for targets that need one to speak of.
 */
#ifndef FUZZ_SANDBOX_H
#define FUZZ_SANDBOX_H

#include "engine/base/sink.h"
#include "engine/ladder.h"

struct sandbox {
	struct ladder *ladder;
	struct resource resource;
	void *memory;
	struct sink sink;  /* swallows what is written                        */
};

/** sandbox_open - the program, built and at a cold start. */
void sandbox_open(struct sandbox *sandbox);
void sandbox_close(struct sandbox *sandbox);
#endif
