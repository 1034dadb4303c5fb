/* SPDX-License-Identifier: MIT
 *
 * shape - what lies where in an instance, a function's frame, a structure.
 *
 * The one place that computes size, alignment and offset of what has parts. It fills
 * in the rows of a project's own words (model/words.h): a pin for each variable of
 * their tables, in that order, then one for each edge memory. Where an instance lies
 * as a whole is decided in translate/.
 */
#ifndef MODEL_SHAPE_H
#define MODEL_SHAPE_H

#include "engine/base/diag.h"
#include "engine/model/project.h"

/**
 * shape_make - the rows of all words of a project, after it was read
 *
 * Asking again after an edit gives them anew.
 * Owns: the project's arena.   Scan-safe: no.
 * Fails: false after LD350 (something contains itself), LD113, LD605, LD606 or
 * LD001; the rows can be used all the same, but not to lay out memory.
 */
bool shape_make(struct project *project, struct diag_list *diags);

/* Bytes of a variable or member, all elements together; from one element to the next,
 * of a single one its own; and what the offset is a multiple of. */
struct extent { uint64_t size; uint32_t unit, align; };
/** shape_of - of what is declared like @pin: type, capacity, word and array count. */
struct extent shape_of(const struct word_table *words, const struct word_pin *pin);
/** shape_pin - a pin without a name that is declared like @var. */
struct word_pin shape_pin(const struct var *var);
/** shape_of_var - the same of a declared variable. */
struct extent shape_of_var(const struct word_table *words, const struct var *var);
/** shape_vars - the table that the word's row was made from; NULL: none. */
const struct var_table *shape_vars(const struct project *project,
				   enum word word);
/** shape_pou - the POU of a function or block of the project; NULL: it is none. */
const struct pou *shape_pou(const struct project *project, enum word word);
#endif
