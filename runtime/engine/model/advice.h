/* SPDX-License-Identifier: MIT
 *
 * advice - services that only programs for people at a desk need.
 *
 * Suggestions for misspelled words, texts in files of other tools, and warnings about the states of charts. The
 * command line and the editor set them; `ladderd` does not, and is linked without them.
 * No error in a rung file depends on them.
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
	EXPECT_QUALIFIER   = 1 << 14, /* N, SD: qualifiers of a line of a step  */
	EXPECT_STEP_PART   = 1 << 15, /* X, T                                   */
	EXPECT_VALUE       = 1 << 16, /* of an enumeration                      */
	EXPECT_PART        = 1 << 17, /* of a number: 3, %B1                    */
};

struct mend_line;
struct mended;
struct text_file;

struct advice {
	/* mend_line() of text/mend.h */
	bool (*mend)(const struct mend_line *line, struct mended *out);
	/* expect_nearest() of check/expect.h */
	enum diag_id (*nearest)(const struct project *project, const struct pou *pou,
				unsigned int kinds, const char *wanted, char *out,
				size_t size);
	/* iec_file_text() of exchange/iec_file/iec_file.h */
	bool (*text)(const struct text_file *files, int count, int at, char **out,
		     size_t *out_len, struct diag_list *diags);
	/* check_tokens() of check/check_tokens.h */
	void (*tokens)(struct scope *scope, const struct pou *pou, struct arena *scratch,
		       struct diag_list *diags);
};

/**
 * advice_word - the argument of a message about an unknown word: "Mtor", "Motor, Rotor"
 * @pou:   NULL: of no POU
 * @kinds: enum expect_kind, or'ed: what it could be
 * @diags: suggestions are made for the first few messages only, as they take time
 * @out: of @size bytes, clipped; the word alone if there is no suggestion
 *
 * Returns DIAG_COUNT, or a message that tells more than the caller's, with @out as its argument:
 * another tool has a variable of this name. Scan-safe: no.
 */
enum diag_id advice_word(const struct project *project, const struct pou *pou,
			 unsigned int kinds, const struct diag_list *diags, const char *wanted,
			 char *out, size_t size);
#endif
