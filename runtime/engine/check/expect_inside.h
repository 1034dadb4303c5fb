/* SPDX-License-Identifier: MIT
 *
 * expect_inside - what the files share that find what is wanted at a place.
 *
 * Private to check/. expect_at knows lists and cells, expect_sfc charts.
 */
#ifndef CHECK_EXPECT_INSIDE_H
#define CHECK_EXPECT_INSIDE_H

#include "engine/base/lex.h"
#include "engine/check/expect.h"

#define TOKENS_MOST 128

/* The tokens of one instruction or cell before the cursor, without the word that is
 * being written. */
struct before {
	struct scope *scope;
	const struct pou *pou;
	struct token token[TOKENS_MOST];
	int count;
};

bool expect_is(const struct token *token, const char *text);
/** expect_value, expect_write - a value of these classes, a variable that is written. */
struct expect_want expect_value(uint16_t classes);
struct expect_want expect_write(uint16_t classes);
/** expect_list, expect_cell - behind these words of an instruction, of a cell. */
struct expect_want expect_list(const struct before *b);
struct expect_want expect_cell(const struct before *b);
/** expect_ends_value - does a value end there, so that an operator must come? */
bool expect_ends_value(const struct token *token);
/** expect_line - where the line begins that byte @at stands in. */
size_t expect_line(const char *text, size_t at);
/** expect_statement - where what goes on in the line at @line begins. */
size_t expect_statement(const char *text, size_t line);
/** expect_tokens - the words in bytes [@from, @to). */
void expect_tokens(struct before *b, const char *text, size_t from, size_t to);
/** expect_sfc - what is wanted in the line at @line of a chart, before @to; @bar:
 * behind its last bar, or @line. */
struct expect_want expect_sfc(struct before *b, const char *text, size_t line,
			      size_t bar, size_t to);
#endif
