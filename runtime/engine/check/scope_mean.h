/* SPDX-License-Identifier: MIT
 *
 * scope_mean - what the two halves of the scope share.
 *
 * Private to check/. scope.c knows names and remembers answers, scope_path.c follows
 * dots and brackets.
 */
#ifndef CHECK_SCOPE_MEAN_H
#define CHECK_SCOPE_MEAN_H

#include "engine/check/scope.h"

/** scope_has_index - is this an operand with an index in it? Scan-safe: yes. */
bool scope_has_index(const char *text, size_t len);
/** scope_mean_path - `Runout.Q`, `Table[i]`, `Line[2].Recipe.Times[i]`, `%MW0[i]`;
 * there may be blanks around what is in brackets. Scan-safe: no.
 * Fails: false and @why; then @out is as it was. */
bool scope_mean_path(struct scope *scope, uint32_t table, const char *text,
		     size_t len, struct meaning *out, enum diag_id *why);
/** scope_mean_name - a declared name alone. Scan-safe: no. False: it is none. */
bool scope_mean_name(const struct scope *scope, uint32_t table, const char *text,
		     size_t len, struct meaning *out);
/** scope_mean_address - a direct address. Scan-safe: no. */
bool scope_mean_address(const struct scope *scope, const char *text, size_t len,
			struct meaning *out, enum diag_id *why);
/** scope_mean_whole - @out is something of @word, which has parts. */
void scope_mean_whole(const struct scope *scope, enum word word,
		      struct meaning *out);
/** scope_keep_open - @m is behind @count indices that are found out in the scan.
 * Scan-safe: no. Fails: false when memory is out. */
bool scope_keep_open(struct scope *scope, struct meaning *m,
		     const struct open_index *open, int count);
#endif
