/* SPDX-License-Identifier: MIT
 *
 * expr_path - operands with dots and indices, token by token.
 *
 * Private to model/: what expr.c asks of the scanner. It builds nothing.
 */
#ifndef MODEL_EXPR_PATH_H
#define MODEL_EXPR_PATH_H

#include "engine/base/lex.h"

/** expr_skip_path - from the last token of a name, or of an index behind it, to that of
 * what follows with simple indices alone, `[2].Times`. An index that is an expression is
 * not gone to. Scan-safe: yes. */
void expr_skip_path(struct lex *lex);
/** expr_text_len - bytes of what ends at the cursor, on its last token, from @text on.
 * Scan-safe: yes. */
size_t expr_text_len(const char *text, const struct lex *lex);
/** expr_has_target - is there a := that belongs to what the cursor is on? Scan-safe:
 * yes. */
bool expr_has_target(struct lex lex);
#endif
