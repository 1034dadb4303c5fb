/* SPDX-License-Identifier: MIT
 *
 * history - what was done to a document, step by step, as text.
 *
 * A change is a piece of text that became another; to undo it is to exchange the
 * two. It applies nothing itself and knows no rung: document.c does.
 */
#ifndef EDITOR_HISTORY_H
#define EDITOR_HISTORY_H

#include <glib.h>
#include <stdbool.h>

enum change_kind {
	CHANGE_RUNGS, /* some rungs in a row of a POU                          */
	CHANGE_TEXT,  /* bytes of the canonical text, or of a text that cannot be read */
	CHANGE_VIEW,  /* the VIEW part of the file                             */
	CHANGE_LIST,  /* the text of one POU, which may be one that cannot be read */
	CHANGE_VARIABLE, /* a declaration at the end of a block, that was not there */
	CHANGE_FILE,  /* bytes of a text file beside the document, that is saved by itself */
};

struct change {
	enum change_kind kind;
	int pou;          /* of RUNGS and LIST: its number; of VARIABLE too, -1: global;
			     of FILE: the file's                               */
	gsize at;         /* first rung, first byte, or block of variables     */
	GPtrArray *before, *after; /* of char *: a text each rung or declaration; of
				      the other kinds one text                 */
};

struct step {
	char *name;       /* "Delete rung": shown behind Undo                  */
	char *key;        /* steps with the same one in a row join; NULL: never */
	GPtrArray *change; /* of struct change *                               */
	guint64 serial;   /* grows from step to step                           */
	bool is_back;     /* it took back what came behind place @back_to      */
	guint64 back_to;
};

struct history;

/** history_new - nothing was done. Owns: the caller, history_free(). */
struct history *history_new(void);
void history_free(struct history *history);
/** history_restart - it is another document, and that is saved; what was done to files
 * beside it stays. */
void history_restart(struct history *history);

/** change_new - one text became another. @before, @after: taken over. */
struct change *change_new(enum change_kind kind, int pou, gsize at,
			  GPtrArray *before, GPtrArray *after);
/** change_texts - a container for change_new that frees its texts. */
GPtrArray *change_texts(void);

/* A step is begun, gets its changes as they are made, and ends; begun inside another
 * it becomes part of that. */
void history_begin(struct history *history, const char *name, const char *key);
/** history_add - @change: taken over; outside a step it is one of its own. */
void history_add(struct history *history, struct change *change);
/** history_end - true if the outermost step ended, and changed something. */
bool history_end(struct history *history);

/** history_undo - the step to be taken back, from its last change to its first;
 * NULL: there is none. Borrowed until the next call that is no question. */
const struct step *history_undo(struct history *history);
/** history_redo - the step to be done again, from its first change to its last. */
const struct step *history_redo(struct history *history);
/** history_undo_name, history_redo_name - NULL: nothing to undo, to redo. */
const char *history_undo_name(const struct history *history);
const char *history_redo_name(const struct history *history);
/** history_open_step - the changes of the step that is open so far; NULL: none. */
const struct step *history_open_step(const struct history *history);
/** history_cancel - forgets the step that is open. */
void history_cancel(struct history *history);

/* ---- places ---- */

/** history_place - behind the last step that is done. */
guint64 history_place(const struct history *history);
/** history_since - how many steps are done behind a place; -1: it is not there any more:
 * undone, forgotten, or the step before it grew. */
int history_since(const struct history *history, guint64 place);
/** history_done - 0: the last step that is done, 1: the one before. Borrowed. */
const struct step *history_done(const struct history *history, int index);
/** history_goes_back - the open step takes back what came behind that place. */
void history_goes_back(struct history *history, guint64 place);

/** history_forget_file - what was done to file @file is not to be undone any more. */
void history_forget_file(struct history *history, int file);
/** step_is_aside - does it change files beside the document and nothing of that? */
bool step_is_aside(const struct step *step);

/** history_mark_saved - what there is now is what stands in the file. */
void history_mark_saved(struct history *history);
/** history_is_saved - of the document; files beside it are no part of that. */
bool history_is_saved(const struct history *history);
/** history_never_saved - what there is differs from any file. */
void history_never_saved(struct history *history);

#endif
