/* SPDX-License-Identifier: MIT
 *
 * shape - the memory layout of an instance, a function's frame or a structure.
 *
 * Only this file computes size, alignment and offsets. It fills in the rows of a
 * project's own words (model/words.h): a pin for each variable of their tables, in that
 * order, then one for each edge memory. translate/ places whole instances.
 */
#ifndef MODEL_SHAPE_H
#define MODEL_SHAPE_H

#include "engine/base/diag.h"
#include "engine/model/project.h"

/**
 * shape_make - the rows of all words of a project, after it was read
 *
 * A call after an edit makes them again.
 * Owns: the project's arena. Scan-safe: no.
 * Fails: false after LD350 (something contains itself), LD113, LD605, LD606 or LD001;
 * the rows can be used, but have no memory layout.
 */
bool shape_make(struct project *project, struct diag_list *diags);

/* Bytes of a variable or member with all its elements; bytes from one element to the
 * next; alignment of the offset. */
struct extent { uint64_t size; uint32_t unit, align; };
/** shape_of - of a variable declared like @pin: type, capacity, word and array count. */
struct extent shape_of(const struct word_table *words, const struct word_pin *pin);
/** shape_pin - a pin without a name that is declared like @var. */
struct word_pin shape_pin(const struct var *var);
/** shape_of_var - the extent of a declared variable. */
struct extent shape_of_var(const struct word_table *words, const struct var *var);
/** shape_vars - the table that the word's row was made from; NULL: none. */
const struct var_table *shape_vars(const struct project *project,
				   enum word word);
/** shape_pou - the POU of a function or block of the project; NULL: it is none. */
const struct pou *shape_pou(const struct project *project, enum word word);
#endif
