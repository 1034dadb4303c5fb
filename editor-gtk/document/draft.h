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

#include "editor-gtk/document/side_file.h"

/** draft_keep - from now on drafts of @document are kept. */
void draft_keep(LadderDocument *document);
/** draft_of_sample - @document, of which drafts are kept, is a copy of a sample. */
void draft_of_sample(LadderDocument *document, const char *path);
/** draft_keep_file - of a text file beside @document, too. */
void draft_keep_file(LadderSideFile *file, LadderDocument *document);
/** draft_remove - of a document or side file: it is saved, or not wanted. */
void draft_remove(gpointer object);
/** draft_write - of a document or side file that is not saved, at once. */
void draft_write(gpointer object);
/** draft_is_kept - of a document or side file: a crash would lose nothing but seconds. */
bool draft_is_kept(gpointer object);
/** draft_stop - no more are kept of it; what there is stays. */
void draft_stop(gpointer object);
/** draft_on_failure - who is told that what is not saved cannot be kept, and why. NULL:
 * nobody. */
void draft_on_failure(void (*tell)(gpointer object, const char *why));

struct draft {
	char *file;   /* of the draft                                          */
	char *path;   /* of the user's file; NULL: it had none                 */
	char *sum;    /* of what stood there; NULL: unknown                    */
	bool is_file; /* a text file beside a project, that had a path         */
	char *beside; /* of the project then; NULL: it had none                */
	char *sample; /* that a document is a copy of; NULL: of none           */
	char *text;
	gsize len;
};
/** draft_find - those of editors that are gone, documents before the files beside them.
 * Owns: the caller, g_ptr_array_unref; of struct draft *. */
GPtrArray *draft_find(void);
/** draft_forget - deletes its file. */
void draft_forget(const struct draft *draft);

#endif
