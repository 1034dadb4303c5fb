/* SPDX-License-Identifier: MIT
 *
 * sfc_net - the steps that each transition deactivates and activates, with macro-steps
 * resolved.
 *
 * A macro-step is active together with what is inside, so it is a step of its own
 * beside its first one when it is entered, and beside its last one when it is left.
 * Names that do not exist are left out: check/check_sfc.c reports them.
 */
#ifndef MODEL_SFC_NET_H
#define MODEL_SFC_NET_H

#include "engine/model/sfc.h"

/* Steps by number, each once. */
struct sfc_steps { int *step; int count; };

/** sfc_steps_has - is @step one of them? Scan-safe: yes. */
bool sfc_steps_has(const struct sfc_steps *steps, int step);

struct sfc_arc {
	int transition;      /* of sfc.transition                              */
	struct sfc_steps from, to;
};

struct sfc_net {
	struct sfc_steps initial;
	struct sfc_arc *arc; /* the first true one deactivates its steps       */
	int arc_count;
};

/** sfc_entry, sfc_exit - the step at which a macro-step is entered, left; -1: none.
 * Linear.   Scan-safe: yes. */
int sfc_entry(const struct sfc *sfc, int macro);
int sfc_exit(const struct sfc *sfc, int macro);

/**
 * sfc_net_make - the net of a chart after sfc_link()
 *
 * Owns: @arena. Scan-safe: no. Fails: false: no memory.
 */
bool sfc_net_make(const struct sfc *sfc, struct arena *arena, struct sfc_net *out);

/** sfc_forced - the steps that are active when @step is made active alone: the
 * macro-steps around it, and its first inner step. As sfc_net_make(). */
bool sfc_forced(const struct sfc *sfc, int step, struct arena *arena,
		struct sfc_steps *out);
#endif
