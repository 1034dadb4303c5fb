/* SPDX-License-Identifier: MIT
 *
 * draft - what was not saved, kept where a crash does not reach it.
 *
 * Some seconds after a change the text goes into the state folder of the user, never into
 * the user's own file. It goes away when the document is saved or closed; what is left
 * belongs to an editor that died.
 */
#ifndef EDITOR_DRAFT_H
#define EDITOR_DRAFT_H

#include "editor-gtk/document.h"

/** draft_keep - from now on drafts of @document are kept. */
void draft_keep(LadderDocument *document);
/** draft_remove - of @document: it is saved, or not wanted. */
void draft_remove(LadderDocument *document);
/** draft_write - at once. */
void draft_write(LadderDocument *document);

struct draft {
	char *file;  /* of the draft                                           */
	char *path;  /* of the user's file; NULL: it had none                  */
	char *sum;   /* ladder_document_disk_sum() of that then; NULL: unknown  */
	char *text;
	gsize len;
};
/** draft_find - those of editors that are gone. Owns: the caller, g_ptr_array_unref; of
 * struct draft *. */
GPtrArray *draft_find(void);
/** draft_forget - deletes its file. */
void draft_forget(const struct draft *draft);

#endif
