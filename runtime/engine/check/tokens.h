/* SPDX-License-Identifier: MIT
 *
 * tokens - the states of a chart, for check_tokens and its test.
 *
 * Private to check/. A state (a marking) is the set of active steps, macro-steps among
 * them.
 *
 * It fires one transition at a time, although a scan fires all that are true. That is
 * enough: transitions that fire together have different steps before them, so firing them
 * one after another has the same result, unless one enters a step before another has left
 * it. In that case the first one alone enters an active step, which is a warning.
 */
#ifndef CHECK_TOKENS_H
#define CHECK_TOKENS_H

#include "engine/model/sfc_net.h"

#include <stdint.h>

enum token_kind {
	TOKEN_TWICE, /* a step is entered that is active: step, arc            */
	TOKEN_DEAD,  /* nothing is enabled: step that waits in vain            */
	TOKEN_LEFT,  /* a macro-step is left while more in it is active: arc   */
};
struct token_find {
	enum token_kind kind;
	int step, arc;
	int state;             /* in which it happens                          */
};

/* States one after another in blocks, known by a hash. */
struct token_states {
	uint64_t **block;
	int *before;           /* by state: the state before it on a shortest way; -1 */
	int count, most;
	int words;             /* of a state                                   */
	uint32_t *slot, mask;  /* number of a state + 1                        */
};

struct tokens {
	const struct sfc *sfc;
	struct arena *arena;
	struct sfc_net net;
	uint8_t *never;        /* by arc: it cannot fire, whatever is active   */
	int *first, *leaving;  /* arcs by step that they leave: those of step i
				  are leaving[first[i]] … leaving[first[i + 1] - 1] */
	uint8_t *reached;      /* by step: it can be active                    */
	uint8_t *fires;        /* by arc: it can be enabled                    */
	uint8_t *strange;      /* by arc: its steps do not belong together     */
	struct token_states states;
	struct token_find *find;
	int find_count;
	bool gave_up;
};

/** tokens_begin - the net, and which arcs can never fire. @always: by transition, 1: its
 * condition is TRUE, 2: FALSE. Owns: @arena.   Fails: false: no memory. */
bool tokens_begin(struct tokens *t, const struct sfc *sfc, const uint8_t *always,
		  struct arena *arena);
/** tokens_prove - does the structure of the chart show that no step is entered twice and that
 * there is no dead end? If so, sets reached and fires. False too when memory is out. Linear,
 * except for joins of many branches. */
bool tokens_prove(struct tokens *t);
/** tokens_walk - looks at the states one by one: find, reached, fires, gave_up.
 * Fails: false: no memory. */
bool tokens_walk(struct tokens *t);
/** tokens_bound - sets reached and fires for everything that could be active if all states were
 * possible. Fails: false: no memory. */
bool tokens_bound(struct tokens *t);
/** tokens_state - the bits of one. */
const uint64_t *tokens_state(const struct tokens *t, int state);
#endif
