/* SPDX-License-Identifier: MIT
 *
 * document_inside - what the files of a document share. Only they include it.
 */
#ifndef EDITOR_DOCUMENT_INSIDE_H
#define EDITOR_DOCUMENT_INSIDE_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/document/history.h"
#include "editor-gtk/kit/i18n.h"

#include <glib/gstdio.h>

struct _LadderDocument {
	GObject parent;
	struct ladder *ladder;    /* holds the live project                    */
	char *text;               /* instead, of a file that cannot be read    */
	gsize text_len;
	GHashTable *list;         /* POU number -> text that cannot be read    */
	struct history *history;
	GArray *files;            /* beside it, whose steps are in the history  */
	char *path;
	char *disk_sum;           /* digest of the file when it was read or saved */
	GStatBuf disk_seen;       /* of the file when it was looked at last    */
	enum disk_state disk;     /* and what it was then                      */
	int repaired;             /* line of the first byte that is no text; 0: none */
	bool fixed;               /* nothing changes it                        */
	guint64 version;
	/* Checks: */
	struct ladder *checked;
	struct diag_list diags;
	guint check_timer;
	bool checking;            /* a thread is at work                       */
	guint64 checked_version;  /* that `checked` or the thread is of        */
};

/** document_apply_file - a file beside gets @to in the place of @from. */
void document_apply_file(LadderDocument *document, const struct change *change,
			 const char *from, const char *to);
/** document_file - what diagnostics call it. Borrowed. */
const char *document_file(const LadderDocument *document);
/** document_take - the text becomes the document; nothing can be undone. */
void document_take(LadderDocument *document, const char *text, gsize len);
/** document_read - what is to become of the text; it is nobody's project yet. Owns: the
 * caller, ladder_free(). Fails: NULL, @why (or NULL) says why it cannot be read. */
struct ladder *document_read(LadderDocument *document, const char *text, gsize len,
			     struct diag_list *why);
/** document_take_ladder - becomes the project. @ladder: owned here from now on. */
void document_take_ladder(LadderDocument *document, struct ladder *ladder);
/** document_record - does a change, and the history has it. */
void document_record(LadderDocument *document, struct change *change);
/** document_apply_list - POU @pou gets the text, in the project or beside it. */
void document_apply_list(LadderDocument *document, int pou, const char *text);
/** document_forget_place - what is known of the place of a list is not so any more. */
void document_forget_place(LadderDocument *document);
/** document_check_lists - tells of lists that stand beside the project though all can be
 * read: one has more than its POU, or no POU. @read: what came of the whole text. */
void document_check_lists(LadderDocument *document, const struct project *read,
			  struct diag_list *diags);
/** document_apply_variable - declarations at the end of block @block of a POU (-1: the
 * globals) become others. */
void document_apply_variable(LadderDocument *document, int pou, int block,
			     const GPtrArray *from, const GPtrArray *to);
/** document_tell_variable - one of this name and address ("": none) came or went. */
void document_tell_variable(LadderDocument *document, int pou, const char *name,
			    const char *address);
/** document_report_lost - a promise of our own is broken: it does not return. */
void document_report_lost(const char *what);
/** document_apply_view - the VIEW part becomes another. */
void document_apply_view(LadderDocument *document, const char *text);
/** document_pou_name - of a POU now; NULL: there is none. Caller frees with g_free(). */
char *document_pou_name(LadderDocument *document, int pou);
/** document_follow_name - the text of a POU that was called @before may give it another
 * name: its bookmarks follow. */
void document_follow_name(LadderDocument *document, int pou, const char *before);
/** document_shift_bookmarks - they follow rungs that were exchanged. */
void document_shift_bookmarks(LadderDocument *document, int pou, int at, int removed,
			      int inserted);
/** document_move_bookmarks - they are those of @view, which was the part before a rung
 * moved. */
void document_move_bookmarks(LadderDocument *document, int pou, int from, int to,
			     const char *view);
/** document_one_text - for change_new(). */
GPtrArray *document_one_text(const char *text, gsize len);
/** document_changed - another version: it is to be checked, and told. */
void document_changed(LadderDocument *document);
void document_tell_state(LadderDocument *document);
void document_tell_checked(LadderDocument *document);
/** document_tell_whole - all may be another. */
void document_tell_whole(LadderDocument *document);
/** document_tell_project - the same, and document_changed(). */
void document_tell_project(LadderDocument *document);
void document_tell_list(LadderDocument *document, int pou);
void document_tell_bookmarks(LadderDocument *document);
/** document_check_later - soon, when nobody types. */
void document_check_later(LadderDocument *document);
void document_stop_checks(LadderDocument *document);

#endif
