/* SPDX-License-Identifier: MIT
 *
 * draft - keeps unsaved text where a crash does not reach it.
 *
 * Seconds after a change the text goes into the state folder of the user, never into the
 * user's own file. The draft is deleted when the document is saved or closed. A draft that
 * is left belongs to an editor that crashed.
 */
#ifndef EDITOR_DRAFT_H
#define EDITOR_DRAFT_H

#include "editor-gtk/document/side_file.h"

/** draft_keep - starts keeping drafts of @document. */
void draft_keep(LadderDocument *document);
/** draft_of_sample - marks @document, of which drafts are kept, as a copy of a sample. */
void draft_of_sample(LadderDocument *document, const char *path);
/** draft_keep_file - starts keeping drafts of a text file beside @document. */
void draft_keep_file(LadderSideFile *file, LadderDocument *document);
/** draft_remove - deletes the draft of a document or side file: it is saved, or not wanted. */
void draft_remove(gpointer object);
/** draft_write - writes the draft of an unsaved document or side file at once. */
void draft_write(gpointer object);
/** draft_is_kept - would a crash lose at most the last seconds of a document or side file? */
bool draft_is_kept(gpointer object);
/** draft_stop - stops keeping drafts; the present one stays. */
void draft_stop(gpointer object);
/** draft_on_failure - sets a function that is called when a draft cannot be kept, with the
 * reason. NULL: none. */
void draft_on_failure(void (*tell)(gpointer object, const char *why));

struct draft {
	char *file;   /* path of the draft                                     */
	char *path;   /* of the user's file; NULL: it had none                 */
	char *sum;    /* digest of that file; NULL: unknown                    */
	bool is_file; /* is it of a text file beside a project, that had a path? */
	char *beside; /* path of that project; NULL: it had none               */
	char *sample; /* the sample that the document is a copy of; NULL: none */
	char *text;
	gsize len;
};
/** draft_find - the drafts of editors that do not run any more, documents before side
 * files. Owns: the caller, g_ptr_array_unref; of struct draft *. */
GPtrArray *draft_find(void);
/** draft_forget - deletes its file. */
void draft_forget(const struct draft *draft);

#endif
