/* SPDX-License-Identifier: MIT
 *
 * words - what words.c and words_block.c share to write the text of a cell.
 */
#ifndef WALKER_WORDS_H
#define WALKER_WORDS_H

#include "tests/walker/random.h"

/* Text that is being written; cut where there is no room. */
struct builder {
	struct random_source *source;
	char *out;
	size_t size, used;
};

void put(struct builder *builder, const char *format, ...);
/** variable - one of just this type that may be read, or written. */
const char *variable(struct random_source *source, const char *type, bool write);
/** literal - a constant of this type. */
const char *literal(struct random_source *source, const char *type);
/** is_used - @name stands in @body as a word of its own. */
bool is_used(const char *body, const char *name);

/* words_block.c */
/** random_block - a function block and its parameters; gives how many of its pins,
 * in @pin, want a row of their own. */
int random_block(struct builder *builder, const char *pin[3]);
/** random_declare_blocks - declarations of the instances that @body names. */
void random_declare_blocks(struct builder *builder, const char *body);
#endif
