/* SPDX-License-Identifier: MIT
 *
 * entry_expression - a comparison or an assignment, typed with or without brackets.
 */
#ifndef EDITOR_ENTRY_EXPRESSION_H
#define EDITOR_ENTRY_EXPRESSION_H

#include "editor-gtk/edit/entry_operand.h"

/** entry_expression - reads one to @entry. Fails: false, @entry->why says why. */
bool entry_expression(const struct entry_place *place, const char *text, size_t len,
		      struct entry *entry);

#endif
