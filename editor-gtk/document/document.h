/* SPDX-License-Identifier: MIT
 *
 * document - one rung file while it is edited.
 *
 * It holds the live project, the history of all changes, and the diagnostics of the last
 * check. All changes go through it. It draws nothing and opens no dialogs. A file that
 * cannot be read is a document of plain text until it can be read.
 *
 * Signals:
 *   rungs-changed (int pou, int at, int removed, int inserted)
 *   variable-changed (int pou, string name, string address)
 *                        one was added or removed, -1: a global one; other variables
 *                        have new numbers and places in memory, all else is unchanged
 *   project-changed ()   anything may differ: names, POUs, all rungs
 *   list-changed (int pou)  the text of a list that cannot be read changed
 *   bookmarks-changed ()  or other lines of the VIEW part
 *   checked ()           ladder_document_diags() are new
 *   file-opened (LadderSideFile file)  an edit of the project changed a file beside it
 *   state-changed ()     saved or not, path, the step that Undo would undo
 */
#ifndef EDITOR_DOCUMENT_H
#define EDITOR_DOCUMENT_H

#include "editor-gtk/document/history.h"

#include <gio/gio.h>

#include "engine/ladder.h"

#define LADDER_TYPE_DOCUMENT (ladder_document_get_type())
G_DECLARE_FINAL_TYPE(LadderDocument, ladder_document, LADDER, DOCUMENT, GObject)

/** ladder_document_new - a project with a program of one empty rung, never saved. */
LadderDocument *ladder_document_new(void);

/**
 * ladder_document_open - from a file; a damaged one opens as text
 *
 * Fails: false, and @error says why, if the file cannot be read at all or is a code image.
 * The document is then unchanged.
 */
bool ladder_document_open(LadderDocument *document, const char *path, GError **error);
/** ladder_document_open_text - from memory
 * @path: the file it belongs to, NULL: none; @saved: does the file hold this text? */
void ladder_document_open_text(LadderDocument *document, const char *path,
			       const char *text, gsize len, bool saved);
/** ladder_document_open_copy - the same without a file of its own: files that the text names are looked for beside
 * @original until it is saved. */
void ladder_document_open_copy(LadderDocument *document, const char *original, const char *text, gsize len,
			       bool saved);
/** ladder_document_files - the files that the project is made of beside its own: those of INCLUDE and USES, and
 * theirs. Each once. Caller: g_ptr_array_unref(). */
GPtrArray *ladder_document_files(LadderDocument *document);
/** ladder_document_needs_rung_file - is it plain IEC text that has got what only a rung file can hold:
 * ladders, charts, a title, a view? */
bool ladder_document_needs_rung_file(LadderDocument *document);
/**
 * ladder_document_save - to its path, or to another, which becomes its path
 * @path: NULL: its own
 *
 * An interrupted save leaves the old file or the new one. Fails: false, @error says why;
 * nothing is lost.
 */
bool ladder_document_save(LadderDocument *document, const char *path, GError **error);
enum disk_state {
	DISK_AS_READ,  /* or saved; or unknown; or there is no file yet         */
	DISK_OTHER,    /* another program changed the file                     */
	DISK_GONE,     /* only the document still has the text                 */
};
/** ladder_document_disk - looks at the file. A document whose file is gone counts as not
 * saved. */
enum disk_state ladder_document_disk(LadderDocument *document);
/** ladder_document_disk_sum - digest of the file as it was last read or saved; NULL:
 * unknown. Borrowed. */
const char *ladder_document_disk_sum(LadderDocument *document);
/** ladder_document_restore - from a draft of the file @path (NULL: none), which had the
 * digest @sum (NULL: unknown) when it was read. */
void ladder_document_restore(LadderDocument *document, const char *path, const char *sum,
			     const char *text, gsize len);

/** ladder_document_fix - makes the document read-only and ends its checks. */
void ladder_document_fix(LadderDocument *document);
bool ladder_document_is_fixed(LadderDocument *document);

/** ladder_document_repaired - line of the first byte that was not UTF-8 when the file was
 * read, and is now U+FFFD; 0: none. */
int ladder_document_repaired(LadderDocument *document);

/** ladder_document_path - NULL: none yet. Borrowed. */
const char *ladder_document_path(LadderDocument *document);
/** ladder_document_file - the file beside which those are that its text names: its own, or that of the original of a
 * copy that is not saved yet; "": neither. Borrowed. */
const char *ladder_document_file(const LadderDocument *document);
/** ladder_document_folder - of its path, else of the original that it was imported from;
 * NULL: neither. Caller frees. */
char *ladder_document_folder(LadderDocument *document);
/** ladder_document_set_from - sets the original, of a document without a path. */
void ladder_document_set_from(LadderDocument *document, const char *path);
/** ladder_document_name - for titles: the project's name, else the file's. Caller frees. */
char *ladder_document_name(LadderDocument *document);
bool ladder_document_is_saved(LadderDocument *document);

/** ladder_document_project - the live project, read-only; NULL: a document of text.
 * Pointers into it die with project-changed, rungs with rungs-changed, variables with
 * variable-changed. */
struct project *ladder_document_project(LadderDocument *document);
/** ladder_document_ladder - the engine that holds it, for names and rungs as text. */
struct ladder *ladder_document_ladder(LadderDocument *document);
/** ladder_document_text - all of it, as it would be saved. Caller frees. */
char *ladder_document_text(LadderDocument *document, gsize *len);
/** ladder_document_reader - nothing loaded; INCLUDE finds the texts of the files beside the
 * document as they are now, saved or not, also in another thread. Owns: the caller,
 * ladder_free(). */
struct ladder *ladder_document_reader(LadderDocument *document);
/** ladder_document_version - another number after every change. */
guint64 ladder_document_version(LadderDocument *document);

/* ---- changes: between begin and end, one step of the history ---- */

/** ladder_document_begin - opens a step. @name: shown behind Undo, translated; @key:
 * consecutive steps with the same key join; NULL: never. May be nested. */
void ladder_document_begin(LadderDocument *document, const char *name, const char *key);
void ladder_document_end(LadderDocument *document);
/** ladder_document_cancel - undoes the changes of the open step and closes it, all levels. */
void ladder_document_cancel(LadderDocument *document);

/**
 * ladder_document_splice - replaces rungs
 * @at:    the first one, 0-based; @removed: how many are removed
 * @rungs: the new ones, @inserted of them; always taken over
 * @why:   NULL, or gets what is wrong with a rung that a file cannot hold
 *
 * Fails: false, nothing changed: no such POU in LD or place, or a rung that a file cannot
 * hold.
 */
bool ladder_document_splice(LadderDocument *document, int pou, int at, int removed,
			    struct rung **rungs, int inserted, struct diag_list *why);
/** ladder_document_put_rung - replaces one rung. */
bool ladder_document_put_rung(LadderDocument *document, int pou, int at,
			      struct rung *rung, struct diag_list *why);
/** ladder_document_move_rung - @to: its place afterwards. */
bool ladder_document_move_rung(LadderDocument *document, int pou, int from, int to);

/** ladder_document_outline - the canonical text of the live project, and the places of its
 * parts, for ladder_document_replace. Caller frees; NULL: a document of text. */
char *ladder_document_outline(LadderDocument *document, gsize *len,
			      void (*take)(void *context, const struct text_span *span),
			      void *context);
/** ladder_document_pou - the same text, with the place of POU @pou in it. */
char *ladder_document_pou(LadderDocument *document, int pou, struct text_span *span);
/**
 * ladder_document_replace - replaces bytes of the canonical text, or of a document of text
 * @at, @removed: bytes; @with: the new text
 *
 * The new text of a project must be readable. Fails: false, nothing changed; @why (or NULL)
 * says why.
 */
bool ladder_document_replace(LadderDocument *document, gsize at, gsize removed,
			     const char *with, struct diag_list *why);
/** ladder_document_replace_step - the same as a step @step of the history. Returns NULL, or why
 * it failed, translated: the first error. Owns: the caller. */
char *ladder_document_replace_step(LadderDocument *document, gsize at, gsize removed,
				   const char *with, const char *step);

/** ladder_document_declare - adds a variable
 * @pou: its POU; -1: global; @type: "BOOL", "TON"; @address: "%IX0.3", "" or NULL: none
 * Fails: as ladder_document_replace. */
bool ladder_document_declare(LadderDocument *document, int pou, const char *name,
			     const char *type, const char *address,
			     struct diag_list *why);

/** ladder_document_list - the text of a POU as it was typed, readable or not. Caller frees. */
char *ladder_document_list(LadderDocument *document, int pou);
/** ladder_document_with_list - the text of the document if that POU had the text @list. Caller frees.
 * Fails: NULL: a text of the document cannot be read. */
char *ladder_document_with_list(LadderDocument *document, int pou, const char *list);
/** ladder_document_took - did the last change put the text of a POU into the document, and was @text then
 * what it read? The document itself has it in its canonical form. */
bool ladder_document_took(LadderDocument *document, const char *text);
/** ladder_document_put_list - from PROGRAM to END_PROGRAM; never refused. A text that
 * cannot be read is kept beside the project until it can, and ladder_document_diags() say
 * why. */
bool ladder_document_put_list(LadderDocument *document, int pou, const char *text);

/** ladder_document_lines_before - lines of the whole text before that of POU @pou; -1: 0. */
int ladder_document_lines_before(LadderDocument *document, int pou);
/** ladder_document_list_at - the POU whose text is kept beside the project and has line
 * @line (1-based) of the whole text; @row: the line in the POU, 0-based. -1: none has
 * it. */
int ladder_document_list_at(LadderDocument *document, int line, int *row);
/** ladder_document_is_whole - is all of its text in the project, with no list beside it? */
bool ladder_document_is_whole(LadderDocument *document);

/* ---- text files beside the document: one history for all ---- */

/** file_apply - replaces @from, which stands at byte @at of @file, by @to. */
typedef void (*file_apply)(gpointer file, gsize at, const char *from, const char *to);
/** ladder_document_attach - a number for @file, whose edits are steps of the history from
 * now on. Borrowed until ladder_document_detach().
 * @text: gives the present text of @file; an INCLUDE of @path reads it; borrowed. NULL: it is no
 * part of the project */
int ladder_document_attach(LadderDocument *document, file_apply apply, const char *path,
			   const char *(*text)(gpointer file), gpointer file);
/** ladder_document_includes - does the project take in parts of the file @path? */
bool ladder_document_includes(LadderDocument *document, const char *path);
/** ladder_document_detach - the file is closed; its steps are forgotten. */
void ladder_document_detach(LadderDocument *document, int file);
/** ladder_document_note - adds a step for an edit of a file: at byte @at @before became
 * @after. It does not change whether the document is saved. @name, @key: as for
 * ladder_document_begin(). */
void ladder_document_note(LadderDocument *document, int file, const char *name,
			  const char *key, gsize at, const char *before, const char *after);

/** ladder_document_set_cursor - sets the function that gives the cursor of the window when a
 * step begins, so that undo can move it back there. NULL: none. */
void ladder_document_set_cursor(LadderDocument *document,
				struct step_cursor (*cursor)(gpointer data), gpointer data);
/** ladder_document_undo_cursor - the cursor when the step began that Undo would undo. */
struct step_cursor ladder_document_undo_cursor(LadderDocument *document);
/** ladder_document_undo, ladder_document_redo - false: there is nothing to undo or redo. */
bool ladder_document_undo(LadderDocument *document);
bool ladder_document_redo(LadderDocument *document);
/** ladder_document_undo_name, ladder_document_redo_name - name of the step, translated;
 * NULL: there is none. Borrowed. */
const char *ladder_document_undo_name(LadderDocument *document);
const char *ladder_document_redo_name(LadderDocument *document);

/* ---- places in the history ---- */

/** ladder_document_place - the place behind the last step that is done. */
guint64 ladder_document_place(LadderDocument *document);
/** ladder_document_knows_place - false: it was undone, or is forgotten. */
bool ladder_document_knows_place(LadderDocument *document, guint64 place);
enum back {
	BACK_NOTHING, /* the rung is as it was at the place, or the place is forgotten */
	BACK_DONE,
	BACK_OTHER,   /* not possible: other things were changed since then      */
};
/** ladder_document_give_back - restores rung @rung as it was at @place, without the
 * variables that its edits declared; one step, called @name. */
enum back ladder_document_give_back(LadderDocument *document, int pou, int rung,
				    guint64 place, const char *name);

/* ---- bookmarks follow their rungs ---- */

/** ladder_document_toggle_bookmark - sets or clears one, as a step. */
void ladder_document_toggle_bookmark(LadderDocument *document, int pou, int rung);
bool ladder_document_is_bookmarked(LadderDocument *document, int pou, int rung);
/** ladder_document_next_bookmark - the next one behind that rung, in the order of the file,
 * then from the beginning; false: there is none. */
bool ladder_document_next_bookmark(LadderDocument *document, int *pou, int *rung);
/** ladder_document_rename_bookmarks - for a renamed POU; part of an open step. */
void ladder_document_rename_bookmarks(LadderDocument *document, const char *from,
				      const char *to);

/* ---- the VIEW part: data of the editor in the file ---- */

/** ladder_document_view - VIEW … END_VIEW as it stands in the file; "": none. Borrowed
 * until the next change. */
const char *ladder_document_view(LadderDocument *document);
/** ladder_document_set_view - replaces it; part of an open step. Change only your own
 * lines. Emits bookmarks-changed. */
void ladder_document_set_view(LadderDocument *document, const char *view);

/* ---- checks ---- */

/** ladder_document_diags - of the last check; the project may have changed since. Borrowed
 * until the next `checked`. */
const struct diag_list *ladder_document_diags(LadderDocument *document);
/** ladder_document_checked - the copy that was checked, built if it has no errors; NULL:
 * none yet. Borrowed until the next `checked`. */
struct ladder *ladder_document_checked(LadderDocument *document);
/** ladder_document_check_now - checks and waits: for tests and before a simulation. */
void ladder_document_check_now(LadderDocument *document);

#endif
