/* SPDX-License-Identifier: MIT
 *
 * entry_outcome - what becomes of a line that entry.h read, for sheets and charts: it is
 * told, and what it declares goes to the document.
 */
#ifndef EDITOR_ENTRY_OUTCOME_H
#define EDITOR_ENTRY_OUTCOME_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/edit/entry.h"

/** entry_outcome_tell - what is wrong with a @line, or what it would declare. @good: is
 * nothing wrong? Caller frees with g_free(). */
char *entry_outcome_tell(LadderDocument *document, int pou, const struct entry *entry,
			 const char *line, bool *good);
/** entry_outcome_declare - what is new, in the step of the history that is open: an
 * instance belongs to the POU, a bit of the plant to all. False: not all of it. */
bool entry_outcome_declare(LadderDocument *document, int pou, const struct entry *entry);
#endif
