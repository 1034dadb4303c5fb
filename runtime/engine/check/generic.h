/* SPDX-License-Identifier: MIT
 *
 * generic - functions and blocks with ARRAY[*]: each set of bounds that a call gives them has a copy of its own.
 *
 * The copies stand behind the other POUs while a project is built, have the same name and the same body, and
 * bounds as any other array. The POU itself is never translated. An instance of a block has the type of the copy with the
 * bounds of its first call.
 */
#ifndef CHECK_GENERIC_H
#define CHECK_GENERIC_H

#include "engine/check/scope.h"
#include "engine/model/expr.h"

/** generic_add - the copies that the calls of @project need, one at least of each function; @arena: for the
 * names of each round. Scan-safe: no. Fails: false: no memory, or LD605 and the like in @diags. */
bool generic_add(struct project *project, struct arena *arena, struct diag_list *diags);
/** generic_end - after the build: nobody may look into the copies any more. */
void generic_end(struct project *project, int pous);
/** generic_word - the copy of @word for the arguments of @call; @word itself if it needs none, or there is
 * none for them. Scan-safe: no. */
enum word generic_word(struct scope *scope, const struct pou *pou, struct expr *expr,
		       const struct expr_node *call, enum word word);
/** generic_plain - the block that @word is, or is a copy of. Scan-safe: yes. */
enum word generic_plain(const struct project *project, enum word word);
/** generic_fault - why the array @m cannot go to pin @pin of an instance of @row, which is a copy of a block with ARRAY[*];
 * DIAG_COUNT: it can, or its bounds are no matter. Scan-safe: yes. */
enum diag_id generic_fault(const struct project *project, const struct word_row *row, int pin, const struct meaning *m);
/** generic_lines - the same for all calls with named arguments of a list of @pou. Scan-safe: no. Fails: false: no memory. */
bool generic_lines(struct scope *scope, const struct pou *pou, struct il *il, struct arena *scratch);
struct expr_bound;
/** bound_value - what LOWER_BOUND or UPPER_BOUND is. Scan-safe: no. Fails: false: its first argument is no array,
 * the second no number of a dimension. */
bool bound_value(struct scope *scope, const struct pou *pou, struct expr *expr, const struct expr_bound *bound,
		 int64_t *out);
#endif
