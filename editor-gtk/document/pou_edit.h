/* SPDX-License-Identifier: MIT
 *
 * pou_edit - adds, duplicates, moves and deletes programs and blocks.
 *
 * Each edit is one step of the history, made as a change of the text.
 */
#ifndef EDITOR_POU_EDIT_H
#define EDITOR_POU_EDIT_H

#include "editor-gtk/document/document.h"

/** pou_free_name - for a new one: Program1, Block1. Owns: the caller. */
char *pou_free_name(LadderDocument *document, enum pou_kind kind);
/** pou_copy_name - for a copy of a POU: Motor_2. Owns: the caller. */
char *pou_copy_name(LadderDocument *document, int pou);
/** pou_name_refusal - why a new POU of this kind cannot have the name, translated; NULL: it
 * can. Owns: the caller. */
char *pou_name_refusal(LadderDocument *document, enum pou_kind kind, const char *name);
/** pou_add - adds one at the end of the file. Returns NULL, or why it failed, translated,
 * which the caller frees. */
char *pou_add(LadderDocument *document, enum pou_kind kind, enum pou_language language,
	      const char *name);
/** pou_duplicate - adds a copy with another name behind it, with its comments and local
 * variables. Returns as pou_add(). */
char *pou_duplicate(LadderDocument *document, int pou, const char *name);
/** pou_part - the canonical text, and the place of a POU in it, with the comments above it.
 * NULL: it is declared in another file. Caller frees. */
char *pou_part(LadderDocument *document, int pou, struct text_span *span);
/** pou_beside - the next (@by 1) or previous (-1) one of this file in the same list of the
 * project tree: programs, or functions and blocks. -1: none. */
int pou_beside(LadderDocument *document, int pou, int by);
/** pou_order_counts - do programs run in the order of the file? Else a CONFIGURATION lists
 * them. */
bool pou_order_counts(LadderDocument *document);
/** pou_move - moves its text, with the comments above it, before or behind that of POU
 * @beside; nothing, if they are the same. Returns NULL, or why it failed, translated, static. */
const char *pou_move(LadderDocument *document, int pou, int beside, bool behind);
/** pou_uses - the number of places outside of a POU that use it. */
int pou_uses(LadderDocument *document, int pou);
/** pou_delete - deletes a POU, but not the last one or one of another file, and with it what
 * cannot be read without it: its boxes, its instances, and lines of lists that call it.
 * Returns NULL, or why it failed, translated, static. */
const char *pou_delete(LadderDocument *document, int pou);
/** pou_delete_text - deletes a part of the canonical text, and the lines that cannot be read
 * without its @name. Part of an open step. Fails: false, nothing changed. */
bool pou_delete_text(LadderDocument *document, const struct text_span *span, const char *name);

#endif
