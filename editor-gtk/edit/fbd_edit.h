/* SPDX-License-Identifier: MIT
 *
 * fbd_edit - changes a network of a function block diagram: boxes, pins, wires, lines.
 *
 * An edit reads the lines of a network, changes trees and gives the lines again; the document exchanges the
 * texts, and undo exchanges them back. Only lines that must differ differ. It knows no toolkit; of the project
 * it changes only the table of strings and rows of words made by rule.
 *
 * Boxes are counted as model/fbd_graph.h does: in a statement from 0, nested ones before the box that they
 * stand in, the store, jump or value of a wire last.
 */
#ifndef EDITOR_FBD_EDIT_H
#define EDITOR_FBD_EDIT_H

#include "editor-gtk/edit/fbd_net.h"

#define FBD_MOST_INPUTS 16
#define FBD_MOST_BOXES  256 /* in a statement                                    */

struct fbd_edit {
	struct project *project;
	int pou;                  /* number in it                               */
	struct fbd_net net;
	const char *why;          /* N_(): the last refusal; NULL: none          */
	const struct fbd_line *made; /* the line of what was made or changed last; NULL: none */
};

/* A box, or one of its pins. */
struct fbd_spot {
	int statement;            /* 0-based, comments not counted              */
	int box;                  /* 0-based in the statement                   */
	const char *pin;          /* the name of a pin of a call; NULL or "": by @number */
	int number;               /* 0-based, among the inputs or the outputs    */
	bool output;
};

/** fbd_edit_new - of the lines below the heading of a network. Owns: the caller, fbd_edit_free(). NULL: no memory. */
struct fbd_edit *fbd_edit_new(struct project *project, int pou, const char *text, size_t len);
void fbd_edit_free(struct fbd_edit *edit);
/** fbd_edit_text - the lines as they are now. Owns: the caller, free(). NULL: no memory. */
char *fbd_edit_text(const struct fbd_edit *edit);
/** fbd_edit_statements - how many there are, comments not counted. */
int fbd_edit_statements(const struct fbd_edit *edit);
/** fbd_edit_made - the statement of what was made or changed last; -1: none. */
int fbd_edit_made(const struct fbd_edit *edit);

/* These fail with false, and edit->why says why. */

/** fbd_edit_line - a new line behind a statement; -1: at the beginning. */
bool fbd_edit_line(struct fbd_edit *edit, int behind, const char *text);
/** fbd_edit_add - a new box behind a statement (-1: at the beginning): an operator, a function, or, with
 * @instance, a block. Its inputs are open, its result is a new wire. */
bool fbd_edit_add(struct fbd_edit *edit, int behind, const char *word, const char *instance);
/** fbd_edit_append - the same, with its first input joined to output @from. */
bool fbd_edit_append(struct fbd_edit *edit, const struct fbd_spot *from, const char *word,
		     const char *instance);
/** fbd_edit_insert - the same between input @to and what it has. */
bool fbd_edit_insert(struct fbd_edit *edit, const struct fbd_spot *to, const char *word,
		     const char *instance);
/** fbd_edit_store - a line that stores output @from: of kind ASSIGN, SET, RESET, JUMP or RETURN. */
bool fbd_edit_store(struct fbd_edit *edit, const struct fbd_spot *from, enum fbd_line_kind kind,
		    const char *target);
/** fbd_edit_remove - the boxes. Where one has one value, what read it reads that; other pins become open. */
bool fbd_edit_remove(struct fbd_edit *edit, const struct fbd_spot *spot, int count);
/** fbd_edit_join - input @to reads output @from; if that closes a loop, its value of the scan before. */
bool fbd_edit_join(struct fbd_edit *edit, const struct fbd_spot *from, const struct fbd_spot *to);
/** fbd_edit_clear - the pin becomes open. A box that only it reads stays, with a wire of its own. */
bool fbd_edit_clear(struct fbd_edit *edit, const struct fbd_spot *pin);
/** fbd_edit_operand - what stands in place at a pin: a value, or the variable that an output gives; "": none.
 * At a box that stores it is the variable, at a jump the label, if @pin->output. */
bool fbd_edit_operand(struct fbd_edit *edit, const struct fbd_spot *pin, const char *text);
/** fbd_edit_negate - NOT at an input, or at an output of a block or function that is not its result; or no longer.
 * Lines that read the output `Delay.Q` itself then read its inverse, by the name of a wire. */
bool fbd_edit_negate(struct fbd_edit *edit, const struct fbd_spot *pin);
/** fbd_edit_add_input - a further one, up to 16. */
bool fbd_edit_add_input(struct fbd_edit *edit, const struct fbd_spot *box);
/** fbd_edit_drop_input - this one, down to 2. */
bool fbd_edit_drop_input(struct fbd_edit *edit, const struct fbd_spot *pin);
/** fbd_edit_type - another function or operator; of a block another instance. */
bool fbd_edit_type(struct fbd_edit *edit, const struct fbd_spot *box, const char *word);
/** fbd_edit_rename - a wire of the network. */
bool fbd_edit_rename(struct fbd_edit *edit, const char *wire, const char *name);
/** fbd_edit_move - the statement is executed before the one above it, or after the one below it. */
bool fbd_edit_move(struct fbd_edit *edit, int statement, bool down);
/** fbd_edit_place - the hint of a box, from 1; 0: none. A nested box gets a line of its own. */
bool fbd_edit_place(struct fbd_edit *edit, const struct fbd_spot *box, int column, int row);

/** fbd_edit_copy - the lines of these boxes, without the rest. Owns: the caller, free(). NULL: no memory. */
char *fbd_edit_copy(struct fbd_edit *edit, const struct fbd_spot *spot, int count);
/** fbd_edit_paste - lines behind a statement; wires that have the name of one here get another. */
bool fbd_edit_paste(struct fbd_edit *edit, int behind, const char *text);

/* The heading of a network. */
struct fbd_heading {
	bool off;
	const char *label, *title, *comment; /* NULL or "": none                 */
};
/** fbd_heading_text - the comment, and the line that begins a network. Owns: the caller, free(). NULL: no memory. */
char *fbd_heading_text(const struct fbd_heading *heading);

#endif
