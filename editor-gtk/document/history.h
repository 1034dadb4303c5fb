/* SPDX-License-Identifier: MIT
 *
 * history - the steps of a document, as text.
 *
 * A change is a piece of text that was replaced by another; undo exchanges the two. This
 * file applies nothing and knows no rungs: document.c does.
 */
#ifndef EDITOR_HISTORY_H
#define EDITOR_HISTORY_H

#include <glib.h>
#include <stdbool.h>

enum change_kind {
	CHANGE_RUNGS, /* consecutive rungs of a POU                            */
	CHANGE_TEXT,  /* bytes of the canonical text, or of a document of text */
	CHANGE_VIEW,  /* the VIEW part of the file                             */
	CHANGE_LIST,  /* the text of one POU, readable or not */
	CHANGE_VARIABLE, /* a new declaration at the end of a block */
	CHANGE_FILE,  /* bytes of a text file beside the document, which is saved separately */
};

struct change {
	enum change_kind kind;
	int pou;          /* RUNGS, LIST: number of the POU; VARIABLE: the same, -1: global;
			     FILE: number of the file */
	gsize at;         /* first rung, first byte, or block of variables     */
	GPtrArray *before, *after; /* of char *: one text for each rung or declaration; of the
				      other kinds one text */
};

/* The cursor in a sheet, 0-based; pou -1: it is in none. */
struct step_cursor {
	int pou, rung;    /* rung -1: in a chart                               */
	int row, col;     /* display cell; of a chart: line of its text        */
};

struct step {
	char *name;       /* "Delete rung": shown behind Undo                  */
	char *key;        /* consecutive steps with the same key join; NULL: never */
	GPtrArray *change; /* of struct change *                               */
	guint64 serial;   /* grows from step to step                           */
	bool is_back;     /* it restored the state of place @back_to           */
	guint64 back_to;
	struct step_cursor cursor; /* where it was when the step began         */
};

struct history;

/** history_new - empty. Owns: the caller, history_free(). */
struct history *history_new(void);
void history_free(struct history *history);
/** history_set_cursor - sets the function that gives the cursor when a step begins. */
void history_set_cursor(struct history *history,
			struct step_cursor (*cursor)(gpointer data), gpointer data);
/** history_restart - for another document, which is saved; the steps of files beside it
 * stay. */
void history_restart(struct history *history);

/** change_new - one text replaces another. @before, @after: taken over. */
struct change *change_new(enum change_kind kind, int pou, gsize at,
			  GPtrArray *before, GPtrArray *after);
/** change_texts - a container for change_new that frees its texts. */
GPtrArray *change_texts(void);

/* Begins a step, to which changes are added until history_end(). A nested one is part of
 * the outer step. */
void history_begin(struct history *history, const char *name, const char *key);
/** history_add - @change: taken over; outside a step it becomes a step of its own. */
void history_add(struct history *history, struct change *change);
/** history_end - true if the outermost step ended, and changed something. */
bool history_end(struct history *history);

/** history_undo - the step to undo, from its last change to its first; NULL: there is none.
 * Borrowed until the history changes. */
const struct step *history_undo(struct history *history);
/** history_redo - the step to redo, from its first change to its last. */
const struct step *history_redo(struct history *history);
/** history_undo_cursor - of the step to undo; pou -1: none. */
struct step_cursor history_undo_cursor(const struct history *history);
/** history_undo_name, history_redo_name - NULL: nothing to undo, to redo. */
const char *history_undo_name(const struct history *history);
const char *history_redo_name(const struct history *history);
/** history_open_step - the changes of the open step so far; NULL: none is open. */
const struct step *history_open_step(const struct history *history);
/** history_cancel - forgets the open step. */
void history_cancel(struct history *history);

/* ---- places ---- */

/** history_place - the place behind the last step that is done. */
guint64 history_place(const struct history *history);
/** history_since - the number of steps done since a place; -1: the place is gone: undone,
 * forgotten, or the step before it grew. */
int history_since(const struct history *history, guint64 place);
/** history_done - 0: the last step that is done, 1: the one before. Borrowed. */
const struct step *history_done(const struct history *history, int index);
/** history_goes_back - marks the open step as one that restores the state of that place. */
void history_goes_back(struct history *history, guint64 place);

/** history_forget_file - forgets the steps of file @file. */
void history_forget_file(struct history *history, int file);
/** step_is_aside - does it change only files beside the document? */
bool step_is_aside(const struct step *step);

/** history_mark_saved - the present state is the one in the file. */
void history_mark_saved(struct history *history);
/** history_is_saved - is the document as it was saved? Files beside it do not count. */
bool history_is_saved(const struct history *history);
/** history_never_saved - no state is the one in the file. */
void history_never_saved(struct history *history);

#endif
