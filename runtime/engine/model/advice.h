/* SPDX-License-Identifier: MIT
 *
 * advice - what messages say only to people at a desk.
 *
 * Which word may have been meant; which states a chart can come to. A project has these
 * services or not: the command line and the editor give them to what they load, a
 * `ladderd` does not and so is linked without them. No error depends on them.
 */
#ifndef MODEL_ADVICE_H
#define MODEL_ADVICE_H

#include "engine/base/diag.h"

struct arena;
struct pou;
struct project;
struct scope;

/* What a word may be. */
enum expect_kind {
	EXPECT_KEYWORD     = 1 << 0,
	EXPECT_OPERATOR    = 1 << 1,  /* with its modifiers: LD LDN             */
	EXPECT_FUNCTION    = 1 << 2,
	EXPECT_BLOCK       = 1 << 3,
	EXPECT_ELEMENT     = 1 << 4,  /* words of cells                         */
	EXPECT_INSTANCE    = 1 << 5,
	EXPECT_SUBROUTINE  = 1 << 6,
	EXPECT_LABEL       = 1 << 7,
	EXPECT_VARIABLE    = 1 << 8,
	EXPECT_PIN         = 1 << 9,  /* of a row, or a member                  */
	EXPECT_TYPE        = 1 << 10,
	EXPECT_CONSTANT    = 1 << 11, /* TRUE and FALSE                         */
	EXPECT_STEP        = 1 << 12, /* of a chart                             */
	EXPECT_ACTION      = 1 << 13, /* likewise                               */
	EXPECT_QUALIFIER   = 1 << 14, /* N, SD: what a line of a step may have  */
	EXPECT_STEP_PART   = 1 << 15, /* X, T                                   */
};

struct advice {
	/* expect_nearest() of check/expect.h */
	void (*nearest)(const struct project *project, const struct pou *pou,
			unsigned int kinds, const char *wanted, char *out, size_t size);
	/* check_tokens() of check/check_tokens.h */
	void (*tokens)(struct scope *scope, const struct pou *pou, struct arena *scratch,
		       struct diag_list *diags);
};

/**
 * advice_word - the argument of a message about an unknown word: "Mtor", "Motor, Rotor"
 * @pou:   NULL: of no POU
 * @kinds: enum expect_kind, or'ed: what it could be
 * @diags: the first few messages say what may have been meant: it takes its time
 * @out:   the word alone if nothing is near, or nobody advises; of @size bytes, clipped
 *
 * Scan-safe: no.
 */
void advice_word(const struct project *project, const struct pou *pou,
		 unsigned int kinds, const struct diag_list *diags, const char *wanted,
		 char *out, size_t size);
#endif
