/* SPDX-License-Identifier: MIT
 *
 * expect - which words could stand at a place: of a list, of a cell, of a file.
 *
 * The editor's completion and `ladder complete` ask by place (expect_at), messages of
 * the checks by what they looked for (expect_nearest); the words come from one source.
 * The project may have errors, only what could be read of it is known. It changes
 * nothing and judges nothing.
 */
#ifndef CHECK_EXPECT_H
#define CHECK_EXPECT_H

#include "engine/check/scope.h"
#include "engine/model/advice.h"

/* The kinds of words that fit a place. */
struct expect_want {
	unsigned int kinds;        /* enum expect_kind, or'ed                   */
	uint16_t classes;          /* of variables, pins: enum iec_class; 0: any */
	bool write;                /* variables that a program may write        */
	enum word block;           /* of instances; WORD_COUNT: any             */
	const struct word_row *row; /* whose pins                               */
	unsigned int dirs;         /* of pins: 1 << enum pin_dir; 0: all that have
				      a name outside                        */
	bool call;                 /* of a function's pins: EN ENO OUT too      */
	bool boxes;                /* blocks and functions as boxes of a cell   */
	const char *begun;         /* what stands of the word; NULL: nothing.
				      Words made by rule, such as INT_TO_REAL,
				      are hundreds: those whose first type it
				      has, up to the _, are offered           */
	size_t begun_len;
	const char *const *words;  /* the keywords, up to NULL; NULL: those of a file */
	int enumeration;           /* whose values; -1: of all                  */
	bool marks;                /* of pins: with := or => behind             */
	unsigned int bits;         /* of the number whose parts                 */
};

struct expect_word {
	enum expect_kind kind;
	const char *text;          /* lives while it is looked at               */
	const char *note;          /* its type; NULL: see expect_note()         */
	const struct word_row *row; /* of a word, a pin                         */
	enum op op;                /* of an operator                            */
	int pin;
};

struct expect_taker {
	void (*take)(void *context, const struct expect_word *word);
	void *context;
};

/** expect_offer - hands over every word of what is wanted, unordered. @pou NULL: of no
 * POU. Owns: nothing.   Scan-safe: no. */
void expect_offer(const struct project *project, const struct pou *pou,
		  const struct expect_want *want, const struct expect_taker *taker);

/** expect_functions - the same of functions alone, with those made by rule of which
 * @begun has the first type. Scan-safe: no. */
void expect_functions(const struct project *project, const char *begun, size_t len,
		      const struct expect_taker *taker);

/** expect_note - the type of what was offered, or what it does; "": nothing. Lives as
 * @word does, at least. Only programs that call this link the explanations. */
const char *expect_note(const struct expect_word *word);

/** expect_kind_text - "variable". Lives for ever. */
const char *expect_kind_text(enum expect_kind kind);

/** expect_nearest - @wanted, with the words of @kinds that may be meant behind it, as
 * nearest_print(). Call advice_word() instead, which has the meaning of the result. Scan-safe: no. */
enum diag_id expect_nearest(const struct project *project, const struct pou *pou,
			    unsigned int kinds, const char *wanted, char *out, size_t size);

/* A place in a text. */
struct expect_place {
	const struct pou *pou;     /* NULL: outside                             */
	struct expect_want want;
	const char *prefix;        /* what stands of the word, in the text      */
	size_t prefix_len;
};

/**
 * expect_at - what could stand before the cursor
 * @text:   of the file that the scope's project was read from
 * @line:   1-based
 * @column: 1-based byte; the cursor stands before it
 *
 * Owns: nothing; @out points into @text.   Scan-safe: no.
 * Fails: false if there is no such place, or memory is out.
 */
bool expect_at(struct scope *scope, const char *text, size_t len, int line,
	       int column, struct expect_place *out);

/* A call whose arguments are being written. */
struct expect_call {
	char text[512];            /* Wait(IN : BOOL, PT : TIME, Q => BOOL)     */
	size_t from, to;           /* of it the argument at the cursor; equal: none */
};
/** expect_call - the call of Structured Text around the cursor, otherwise as expect_at. Fails:
 * false: there is none. */
bool expect_call(struct scope *scope, const char *text, size_t len, int line, int column,
		 struct expect_call *out);
#endif
