/* SPDX-License-Identifier: MIT
 *
 * uses - which variable, instance and address is read, written and called.
 *
 * Book-keeping for check_names: it judges nothing and reports nothing. A direct
 * address and a variable AT it are the same place, and %MB0 covers %MX0.0.
 */
#ifndef CHECK_USES_H
#define CHECK_USES_H

#include "engine/check/scope.h"

enum use {
	USE_READ = 1,
	USE_WRITTEN = 2,
	USE_COIL = 4,    /* set at every evaluation, not only with power      */
	USE_CALLED = 8,
	USE_TWICE = 16,  /* USE_COIL or USE_CALLED was reported a second time */
};

/* A bit each for every bit of the process image. */
struct use_map {
	uint8_t *read, *written, *coil;
};

struct uses {
	const struct project *project;
	const struct areas *areas; /* of the scope                            */
	uint8_t *flags;       /* of every declared variable                   */
	int *base;            /* of the globals, then of each POU: its first  */
	int count;            /* of declared variables                        */
	struct use_map map;
	struct arena *arena;
	uint8_t **coils;      /* NULL, or of every declared variable NULL or a bit for each bit of
				 it: written by a coil that names a part of it */
};

/** uses_init - nothing is used yet. @scope: borrowed. Owns: @arena. Fails: false: no memory. */
bool uses_init(struct uses *uses, const struct scope *scope, struct arena *arena);

/**
 * uses_add - notes one use
 * @use: USE_READ, USE_WRITTEN, USE_CALLED, or USE_WRITTEN | USE_COIL
 *
 * True when this is the second coil or the second call of the same place, or of places that share a
 * bit; of a whole variable once.
 */
bool uses_add(struct uses *uses, const struct meaning *meaning,
	      unsigned int use);

/** uses_add_index - the variables that the indices of operand @text are read from;
 * @meaning: its own. */
void uses_add_index(struct uses *uses, struct scope *scope, const struct pou *pou,
		    uint32_t text, const struct meaning *meaning);

/** uses_of - what is done with a declared variable: its own flags and those of
 * its address. @table 0: globals, else number of the POU + 1. */
unsigned int uses_of(const struct uses *uses, int table, int index,
		     const struct var *var);
#endif
