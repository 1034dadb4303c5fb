/* SPDX-License-Identifier: MIT
 *
 * words - writes the text of a cell; for words*.c.
 */
#ifndef WALKER_WORDS_H
#define WALKER_WORDS_H

#include "tests/walker/random.h"

/* Text that is being written; cut at the end of the buffer. */
struct builder {
	struct random_source *source;
	char *out;
	size_t size, used;
};

void words_put(struct builder *builder, const char *format, ...);
/** variable - one of exactly this type that may be read, or written. */
const char *variable(struct random_source *source, const char *type, bool write);
/** operand - a variable, or a bit, byte or word of one; not for an expression. */
const char *operand(struct random_source *source, const char *type, bool write);
/** term - a variable, or an element with a computed index: for expressions. */
const char *term(struct random_source *source, const char *type, bool write);
/** number - a value of exactly @type; @tight: in parentheses if it has operators. */
void number(struct builder *builder, const char *type, int depth, bool tight);
/** is_used - whether @name is in @body as a word of its own. */
bool is_used(const char *body, const char *name);

/* words_literal.c */
/** literal - a constant of this type. */
const char *literal(struct random_source *source, const char *type);

/* words_time.c */
/** random_timely - a TIME made of dates, or of a time and a number. */
void random_timely(struct builder *builder, int depth);
/** random_moment - a time of day or a moment some time before or after another. */
void random_moment(struct builder *builder, const char *type, int depth);
/** random_text - a box with a function of texts. */
void random_text(struct builder *builder);

/* words_own.c */
/** random_declare_own - declarations of structures and instances in @body. */
void random_declare_own(struct builder *builder, const char *body);

/* words_block.c */
/** random_block - a function block and its parameters; returns the number of its pins,
 * in @pin, that need a row of their own. */
int random_block(struct builder *builder, const char *pin[3]);
/** random_declare_blocks - declarations of the instances in @body. */
void random_declare_blocks(struct builder *builder, const char *body);
#endif
