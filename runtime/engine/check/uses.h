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
	USE_PASSED = 4,  /* given to a VAR_IN_OUT, which may store into it    */
	USE_CALLED = 8,
	USE_TWICE = 16,  /* USE_CALLED a second time                          */
};

/* A bit each for every bit of the process image, or of a variable: written by coils, by two. */
struct use_coils {
	uint8_t *once, *twice;
};

/* A bit each for every bit of the process image. */
struct use_map {
	uint8_t *read, *written;
	struct use_coils coils;
};

/* The place of a coil. */
struct use_coil {
	struct use_coil *next;
	const struct pou *pou;
	uint32_t name;        /* of its operand                               */
	int line, column, rung, row, col; /* as in struct diag                */
	int number;           /* of the variable, or USE_COIL_IMAGE           */
	uint32_t first, count; /* bits of the image, or of the variable       */
};
#define USE_COIL_IMAGE (-1)

struct uses {
	const struct project *project;
	const struct areas *areas; /* of the scope                            */
	uint8_t *flags;       /* of every declared variable                   */
	int *base;            /* of the globals, then of each POU: its first  */
	int count;            /* of declared variables                        */
	struct use_map map;
	struct arena *arena;
	struct use_coils *coils; /* NULL, or of every declared variable: none if no coil writes it */
	struct use_coil *coil, **coil_end; /* all coils, in their order       */
};

/** uses_init - nothing is used yet. @scope: borrowed. Owns: @arena. Fails: false: no memory. */
bool uses_init(struct uses *uses, const struct scope *scope, struct arena *arena);

/**
 * uses_add - notes one use
 * @use: USE_READ, USE_WRITTEN, USE_PASSED, USE_CALLED. A write through a pointer only reads the pointer.
 *
 * True when this is the second call of the same instance; later ones are not reported.
 */
bool uses_add(struct uses *uses, const struct meaning *meaning,
	      unsigned int use);

/** uses_add_within - a variable inside of a block is used from outside: its declaration is not
 * unused. Scan-safe: yes. */
void uses_add_within(struct uses *uses, const struct meaning *meaning, unsigned int use);
/** uses_add_coil - the meaning is written by a coil at the place @at, whose next, number, first and
 * count are ignored. */
void uses_add_coil(struct uses *uses, const struct meaning *meaning, struct use_coil at);
/** uses_coil_twice - is the place of @coil, or a bit of it, written by another coil, too? Ask it
 * when all coils are noted. */
bool uses_coil_twice(const struct uses *uses, const struct use_coil *coil);

/** uses_add_index - the variables that the indices of operand @text are read from;
 * @meaning: its own. */
void uses_add_index(struct uses *uses, struct scope *scope, const struct pou *pou,
		    uint32_t text, const struct meaning *meaning);

/** uses_of - what is done with a declared variable: its own flags and those of
 * its address. @table 0: globals, else number of the POU + 1. */
unsigned int uses_of(const struct uses *uses, int table, int index,
		     const struct var *var);
#endif
