/* SPDX-License-Identifier: MIT
 *
 * random - random valid ladder programs, from a seed.
 *
 * A program is a grid of cell texts, so that a failing one can be reduced cell by cell.
 */
#ifndef WALKER_RANDOM_H
#define WALKER_RANDOM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define RANDOM_ROWS  6
#define RANDOM_COLS  8
#define RANDOM_TEXT  144
#define RANDOM_RUNGS 16
#define RANDOM_AREAS 5 /* I, Q, M, V, XAQ                                     */

/* The POU of a rung. */
enum random_pou {
	RANDOM_MAIN, RANDOM_OTHER, RANDOM_INNER, RANDOM_OUTER, RANDOM_RECKON,
	RANDOM_POUS
};

enum random_kind {
	RANDOM_EMPTY, RANDOM_WIRE, RANDOM_SERIES, RANDOM_BOX, RANDOM_LAST,
	RANDOM_COIL,  /* a coil that other outputs may follow                 */
	RANDOM_PIN,   /* a PIN row of the box above, fed by a branch          */
	RANDOM_BLANK, /* a PIN row without a pin                              */
};

struct random_cell {
	enum random_kind kind;
	bool link;
	char text[RANDOM_TEXT];
};

struct random_rung {
	int pou;       /* enum random_pou                                    */
	int label;     /* 1-based number of its label; 0: none               */
	bool off;
	int rows, cols;
	struct random_cell cell[RANDOM_ROWS][RANDOM_COLS];
};

struct random_program {
	bool routine;  /* the second POU is a SUBROUTINE                     */
	int rungs;
	bool sized;    /* areas have these sizes, not the usual ones         */
	uint32_t bytes[RANDOM_AREAS];
	struct random_rung rung[RANDOM_RUNGS];
};

/* xorshift64*: the same numbers on every machine. */
struct random_source {
	uint64_t state;
};
void random_seed(struct random_source *source, uint64_t seed);
uint32_t random_next(struct random_source *source);
/** random_below - 0 … @n - 1. */
uint32_t random_below(struct random_source *source, uint32_t n);
bool random_chance(struct random_source *source, uint32_t percent);

/** random_make - a program; the same for the same seed. */
void random_make(struct random_program *program, uint64_t seed);
/** random_print - its text with just the declarations it uses; length. */
size_t random_print(const struct random_program *program, char *out,
		    size_t size);
/** random_sound - whether the rung keeps the rules of topology. */
bool random_sound(const struct random_rung *rung);

/* words.c: the text of one cell. @later: label a jump may go to; 0: none. */
void random_series(struct random_source *source, char *out, size_t size);
void random_last(struct random_source *source, int later, char *out,
		 size_t size);
/** random_box - returns the pins that need a feeding row, from the top. */
int random_box(struct random_source *source, char *out, size_t size,
	       const char *pin[3]);
/* words_own.c: functions, blocks and structures of the program's own. */
/** random_own_call - the text of a box that calls one of them from a rung of @pou. */
void random_own_call(struct random_source *source, int pou, char *out, size_t size);
/** random_without_memory - replaces edges in the text of a cell by plain contacts. */
void random_without_memory(struct random_source *source, char *text, size_t size);
/** random_own_head, random_own_tail - the text around the rungs. Static. */
const char *random_own_head(int pou);
const char *random_own_tail(int pou);
/** random_types - the types that @body needs. Static. */
const char *random_types(const char *body);
/** random_declare - declarations of the variables in @body. */
size_t random_declare(const char *body, char *out, size_t size);
#endif
