/* SPDX-License-Identifier: MIT
 *
 * document - one rung file while a person works on it.
 *
 * It holds the live project, the one history of all that was done, and what the
 * engine's checks last said of it. All changes go through it; it draws nothing and asks
 * nobody anything. A file that cannot be read is a document of plain text, until it can.
 *
 * Signals:
 *   rungs-changed (int pou, int at, int removed, int inserted)
 *   variable-changed (int pou, string name, string address)
 *                        one was added or taken away, -1: a global one; others have
 *                        other numbers and places in memory, all else is as it was
 *   project-changed ()   anything may be another: names, POUs, all rungs
 *   list-changed (int pou)  the text of a list that cannot be read changed
 *   bookmarks-changed ()  or something else of the VIEW part
 *   checked ()           ladder_document_diags() are new
 *   state-changed ()     saved or not, path, what Undo would undo
 */
#ifndef EDITOR_DOCUMENT_H
#define EDITOR_DOCUMENT_H

#include <gio/gio.h>

#include "engine/ladder.h"

#define LADDER_TYPE_DOCUMENT (ladder_document_get_type())
G_DECLARE_FINAL_TYPE(LadderDocument, ladder_document, LADDER, DOCUMENT, GObject)

/** ladder_document_new - a project with a program of one empty rung, never saved. */
LadderDocument *ladder_document_new(void);

/**
 * ladder_document_open - from a file; a damaged one opens as text
 * Fails: false, and @error says why, if the file cannot be read at all or is a code image.
 * The document is as it was.
 */
bool ladder_document_open(LadderDocument *document, const char *path, GError **error);
/** ladder_document_open_text - from memory
 * @path: what it belongs to, NULL: nothing yet; @saved: is that what stands there? */
void ladder_document_open_text(LadderDocument *document, const char *path,
			       const char *text, gsize len, bool saved);
/**
 * ladder_document_save - to its path, or to another, which becomes its path
 * @path: NULL: its own
 * The file is the old one or the new one, never a mix. Fails: false, @error says why;
 * nothing is lost.
 */
bool ladder_document_save(LadderDocument *document, const char *path, GError **error);
enum disk_state {
	DISK_AS_READ,  /* or saved; or nothing is known: there is no file yet   */
	DISK_OTHER,    /* somebody else wrote it                               */
	DISK_GONE,     /* what the document holds is all there is of it        */
};
/** ladder_document_disk - looks at the file. A document whose file is gone is not saved. */
enum disk_state ladder_document_disk(LadderDocument *document);
/** ladder_document_disk_sum - of the file as it was read or saved last; NULL: it is not
 * known. Borrowed. */
const char *ladder_document_disk_sum(LadderDocument *document);
/** ladder_document_restore - from a draft of the file @path (NULL: none), which had
 * the sum @sum (NULL: nobody knows) when it was read. */
void ladder_document_restore(LadderDocument *document, const char *path, const char *sum,
			     const char *text, gsize len);

/** ladder_document_fix - it stays as it is: nothing changes it from here on, and it is
 * checked no more. */
void ladder_document_fix(LadderDocument *document);
bool ladder_document_is_fixed(LadderDocument *document);

/** ladder_document_repaired - line of the first byte that was no UTF-8 when the file was
 * read, and is now U+FFFD; 0: all was well. */
int ladder_document_repaired(LadderDocument *document);

/** ladder_document_path - NULL: none yet. Borrowed. */
const char *ladder_document_path(LadderDocument *document);
/** ladder_document_name - for titles: the project's, else of the file. Caller frees. */
char *ladder_document_name(LadderDocument *document);
bool ladder_document_is_saved(LadderDocument *document);

/** ladder_document_project - the live one, to be read only; NULL: a document of text.
 * Pointers into it die with project-changed, rungs with rungs-changed, variables with
 * variable-changed. */
struct project *ladder_document_project(LadderDocument *document);
/** ladder_document_ladder - what holds it, for names and rungs as text. */
struct ladder *ladder_document_ladder(LadderDocument *document);
/** ladder_document_text - all of it as it would be saved. Caller frees. */
char *ladder_document_text(LadderDocument *document, gsize *len);
/** ladder_document_version - another number after every change. */
guint64 ladder_document_version(LadderDocument *document);

/* ---- changes: between begin and end, one step of the history ---- */

/** ladder_document_begin - @name: shown behind Undo, translated; @key: steps in a row
 * with the same key are one; NULL: never. May be nested. */
void ladder_document_begin(LadderDocument *document, const char *name, const char *key);
void ladder_document_end(LadderDocument *document);
/** ladder_document_cancel - undoes what the open step did, and ends it, all levels. */
void ladder_document_cancel(LadderDocument *document);

/**
 * ladder_document_splice - rungs become others
 * @at:    of the first one, 0-based; @removed: how many go
 * @rungs: what comes, @inserted of them; taken over, whatever happens
 * @why:   NULL, or gets what is wrong with a rung that cannot be written and read
 *
 * Fails: false, nothing changed: no such POU in LD or place, or a rung that a file
 * could not hold.
 */
bool ladder_document_splice(LadderDocument *document, int pou, int at, int removed,
			    struct rung **rungs, int inserted, struct diag_list *why);
/** ladder_document_put_rung - one rung becomes another. */
bool ladder_document_put_rung(LadderDocument *document, int pou, int at,
			      struct rung *rung, struct diag_list *why);
/** ladder_document_move_rung - @to: its place afterwards. */
bool ladder_document_move_rung(LadderDocument *document, int pou, int from, int to);

/** ladder_document_outline - the canonical text of the live project, and where its parts
 * are: for ladder_document_replace. Caller frees; NULL: a document of text. */
char *ladder_document_outline(LadderDocument *document, gsize *len,
			      void (*take)(void *context, const struct text_span *span),
			      void *context);
/**
 * ladder_document_replace - bytes of the canonical text become others
 * @at, @removed: bytes; @with: what comes in their place
 *
 * Of a document of text: of that. Else what came of it must be readable.
 * Fails: false, nothing changed; @why (or NULL) says why.
 */
bool ladder_document_replace(LadderDocument *document, gsize at, gsize removed,
			     const char *with, struct diag_list *why);

/** ladder_document_declare - one more variable
 * @pou: whose; -1: global; @type: "BOOL", "TON"; @address: "%IX0.3", "" or NULL: none
 * Fails: as ladder_document_replace. */
bool ladder_document_declare(LadderDocument *document, int pou, const char *name,
			     const char *type, const char *address,
			     struct diag_list *why);

/** ladder_document_list - the text of a POU as the person left it, which may be one that
 * cannot be read. Caller frees. */
char *ladder_document_list(LadderDocument *document, int pou);
/** ladder_document_put_list - from PROGRAM to END_PROGRAM; never refused. What cannot be
 * read is kept beside the project until it can, and ladder_document_diags() tell why. */
bool ladder_document_put_list(LadderDocument *document, int pou, const char *text);

/** ladder_document_lines_before - lines of the whole text before that of POU @pou; -1: 0. */
int ladder_document_lines_before(LadderDocument *document, int pou);
/** ladder_document_list_at - the POU whose text stands beside the project and has line
 * @line, from 1, of the whole; @row: its line in that, from 0. -1: none has it. */
int ladder_document_list_at(LadderDocument *document, int line, int *row);
/** ladder_document_is_whole - all of its text is in the project: no list stands beside it. */
bool ladder_document_is_whole(LadderDocument *document);

/* ---- text files beside the document (document_beside.c): one history for all ---- */

/** file_apply - @file gets @to in the place of @from, which stands at byte @at. */
typedef void (*file_apply)(gpointer file, gsize at, const char *from, const char *to);
/** ladder_document_attach - a number for @file, whose steps the history takes from now on.
 * Borrowed until ladder_document_detach(). */
int ladder_document_attach(LadderDocument *document, file_apply apply, gpointer file);
/** ladder_document_detach - it is gone, and nothing of it can be undone. */
void ladder_document_detach(LadderDocument *document, int file);
/** ladder_document_note - a step that was done to a file: at byte @at @before became
 * @after. The document is as saved as it was. @name, @key: as of ladder_document_begin(). */
void ladder_document_note(LadderDocument *document, int file, const char *name,
			  const char *key, gsize at, const char *before, const char *after);

/** ladder_document_undo, ladder_document_redo - false: there is nothing. */
bool ladder_document_undo(LadderDocument *document);
bool ladder_document_redo(LadderDocument *document);
/** … - translated name of the step; NULL: there is none. Borrowed. */
const char *ladder_document_undo_name(LadderDocument *document);
const char *ladder_document_redo_name(LadderDocument *document);

/* ---- places in the history (document_back.c) ---- */

/** ladder_document_place - where it is now: behind the last step that is done. */
guint64 ladder_document_place(LadderDocument *document);
/** ladder_document_knows_place - false: it was undone, or is too long ago. */
bool ladder_document_knows_place(LadderDocument *document, guint64 place);
enum back {
	BACK_NOTHING, /* that rung is as it was, or nobody knows how that was   */
	BACK_DONE,
	BACK_OTHER,   /* no: since then other things were changed, too           */
};
/** ladder_document_give_back - rung @rung as it was at @place, without the variables that
 * its edits declared; one step, called @name. */
enum back ladder_document_give_back(LadderDocument *document, int pou, int rung,
				    guint64 place, const char *name);

/* ---- bookmarks: rungs to come back to; they follow their rungs ---- */

/** ladder_document_toggle_bookmark - sets or clears one, as a step. */
void ladder_document_toggle_bookmark(LadderDocument *document, int pou, int rung);
bool ladder_document_is_bookmarked(LadderDocument *document, int pou, int rung);
/** ladder_document_next_bookmark - behind that rung, in the order of the file, and round
 * again; false: there is none. */
bool ladder_document_next_bookmark(LadderDocument *document, int *pou, int *rung);
/** ladder_document_rename_bookmarks - a POU has another name; part of an open step. */
void ladder_document_rename_bookmarks(LadderDocument *document, const char *from,
				      const char *to);

/* ---- the VIEW part: what the editor keeps in the file for itself ---- */

/** ladder_document_view - VIEW … END_VIEW as it stands in the file; "": none. Borrowed
 * until the next change. */
const char *ladder_document_view(LadderDocument *document);
/** ladder_document_set_view - another one takes its place; part of an open step. Each line
 * belongs to who put it there: others' lines stay. Tells bookmarks-changed. */
void ladder_document_set_view(LadderDocument *document, const char *view);

/* ---- checks ---- */

/** ladder_document_diags - of the last check; their places may be older than the
 * project. Borrowed until the next `checked`. */
const struct diag_list *ladder_document_diags(LadderDocument *document);
/** ladder_document_checked - the copy that was checked, built if it is without errors;
 * NULL: none yet. Borrowed until the next `checked`. */
struct ladder *ladder_document_checked(LadderDocument *document);
/** ladder_document_check_now - at once, and waits: for tests and before a simulation. */
void ladder_document_check_now(LadderDocument *document);

#endif
