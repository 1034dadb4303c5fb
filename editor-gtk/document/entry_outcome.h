/* SPDX-License-Identifier: MIT
 *
 * entry_outcome - the result of a line that entry.h read, for sheets of ladders and charts:
 * the message below it, and the declarations in the document.
 */
#ifndef EDITOR_ENTRY_OUTCOME_H
#define EDITOR_ENTRY_OUTCOME_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/edit/entry.h"

/** entry_outcome_tell - the error in @line, or what it would declare. @good: gets whether
 * there is no error. Caller frees with g_free(). */
char *entry_outcome_tell(LadderDocument *document, int pou, const struct entry *entry,
			 const char *line, bool *good);
/** entry_outcome_declare - declares the new variables in the open step of the history: those
 * with an address globally, others in the POU. False: not all of them. */
bool entry_outcome_declare(LadderDocument *document, int pou, const struct entry *entry);
#endif
