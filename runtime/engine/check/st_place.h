/* SPDX-License-Identifier: MIT
 *
 * st_place - where in a body of Structured Text a cursor stands: which statement, block and call.
 *
 * It reads the text before the cursor only, token by token; the text may have any errors. It knows
 * no names: check/expect.c asks it, and finds what they mean.
 */
#ifndef CHECK_ST_PLACE_H
#define CHECK_ST_PLACE_H

#include "engine/base/lex.h"
#include "engine/model/st.h"

#define ST_PLACE_TOKENS 128 /* of a longer statement those at its end           */

#define ST_PLACE_BLOCKS 64

struct st_block {
	enum st_kind kind;         /* ST_IF, ST_CASE, ST_FOR, ST_WHILE, ST_REPEAT */
	bool other;                /* of an IF or CASE: its ELSE has been        */
	struct token selector;     /* of CASE: the last token before OF; len 0: none */
};

struct st_place {
	struct token token[ST_PLACE_TOKENS]; /* of the statement, before the cursor */
	int count;
	struct st_block open[ST_PLACE_BLOCKS]; /* the blocks around it           */
	int depth;
	/* While the text is read: */
	int parens;
	bool declares;             /* in VAR … END_VAR                         */
};

/** st_place_block - the innermost open block; NULL: none. Scan-safe: yes. */
static inline const struct st_block *st_place_block(const struct st_place *place)
{
	return place->depth ? &place->open[place->depth - 1] : NULL;
}
/** st_place_find - @body: where a body, or its declarations, begin; @at: the cursor. Borrows the
 * text. Scan-safe: no. */
void st_place_find(struct st_place *out, const char *body, size_t at);

/* The innermost open parenthesis or bracket. */
struct st_open {
	int at;       /* its token; -1: none                                 */
	int argument; /* commas behind it                                    */
	int last;     /* the first token of the argument at the cursor       */
};
/** st_place_open - Scan-safe: yes. */
struct st_open st_place_open(const struct st_place *place);
/** st_is - is it this word, in any case, or symbol? Scan-safe: yes. */
bool st_is(const struct token *token, const char *text);
/** st_ends_value - does a value end there, so that an operator must come? Scan-safe: yes. */
bool st_ends_value(const struct st_place *place);
#endif
