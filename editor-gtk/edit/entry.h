/* SPDX-License-Identifier: MIT
 *
 * entry - quick entry: the meaning of a line typed at the cursor, and its candidates.
 *
 * A line is a mnemonic of any dialect, a plain name, an address in any spelling or an
 * expression. This file only reads it into struct entry: grid_edit puts the cell, the
 * document declares the variables.
 */
#ifndef EDITOR_ENTRY_H
#define EDITOR_ENTRY_H

#include "engine/xref/xref.h"

#define ENTRY_TEXT 1024  /* bytes of an operand or of parameters, with NUL      */
#define ENTRY_NAME 320   /* of a name, an address, a note                       */
#define ENTRY_NEW_MOST 4 /* variables that one line may declare                 */
#define ENTRY_CHOICES 3  /* addresses offered for a new variable                */
#define ENTRY_ADDRESS_TEXT 32 /* bytes of one, with NUL                         */

/* Place of the cursor. */
struct entry_place {
	struct project *project; /* gets strings and rows of its words, nothing else changes */
	int pou;                 /* index in it                                */
	bool output;             /* the cursor is in the last column           */
	bool box;                /* a block is wanted: blocks are the first candidates */
	struct xref *xref;       /* of the project, borrowed; NULL: made when needed, which
				    takes longer */
};

/* A new variable that the line would declare. */
struct entry_new {
	char name[ENTRY_NAME];
	char type[ENTRY_NAME];    /* "BOOL", "TON"                             */
	char address[ENTRY_ADDRESS_TEXT]; /* "%IX0.3"; "": none                */
	char shares[ENTRY_NAME];  /* another variable at this address; "": none */
	char choice[ENTRY_CHOICES][ENTRY_ADDRESS_TEXT]; /* addresses it may get, the proposed
							   one first; "": no address */
	int choices;              /* 0: there is no choice                     */
};

enum entry_sense {
	ENTRY_EMPTY,   /* nothing typed                                        */
	ENTRY_ELEMENT, /* an element that can be put                           */
	ENTRY_PART,    /* a word whose operand is still missing                */
	ENTRY_WRONG,   /* see @why                                             */
};

struct entry {
	enum entry_sense sense;
	enum word word;
	bool below;               /* in parallel to the element at the cursor: OR X */
	char operand[ENTRY_TEXT]; /* "": none                                  */
	char args[ENTRY_TEXT];    /* "PT:=T#1s"; "": none                      */
	bool proposed;            /* @args of a block are not from the line    */
	struct entry_new declare[ENTRY_NEW_MOST];
	int declares;             /* 0: no new variable                        */
	const char *why;          /* N_() text, with %s where @what belongs if that is
				     not empty; NULL: nothing is wrong         */
	char what[ENTRY_NAME];
	char instead[64];         /* what a second %s of @why says: what to write */
	char wrong[ENTRY_NAME];   /* the word of the line that @why is about; "": the whole line */
	size_t wrong_at, wrong_len; /* its wrong part, in bytes                */
	const struct var *known;  /* the variable whose declaration @why is about;
				     borrowed from the project; NULL: none     */
};

/**
 * entry_read - reads a line
 * @line: as typed, UTF-8
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false unless @out->sense is ENTRY_ELEMENT.
 */
bool entry_read(const struct entry_place *place, const char *line, struct entry *out);
/** entry_condition - the same for the condition of a transition: a BOOL expression.
 * @out->operand has it without declarations. */
bool entry_condition(const struct entry_place *place, const char *line,
		     struct entry *out);
/** entry_cell - the element as a cell, with its texts as strings of the project. Fails:
 * false if @entry is not an element, or memory is out. */
bool entry_cell(struct project *project, const struct entry *entry, struct cell *cell);

/* `Open %` may also be a word with its operand. */
enum entry_doubt { ENTRY_WORD_POSSIBLE, ENTRY_WORD_GIVEN };
/** entry_declared_len - bytes of the name that a line declares: `Open AT`, `Open :`, or
 * with ENTRY_WORD_GIVEN `Open %`; 0: no declaration. */
size_t entry_declared_len(const char *text, size_t len, enum entry_doubt doubt);

enum entry_kind {
	ENTRY_VARIABLE, ENTRY_INSTANCE, ENTRY_PIN, ENTRY_ADDRESS, ENTRY_LABEL,
	ENTRY_ROUTINE, ENTRY_WORD, ENTRY_NEW, ENTRY_BITS,
};

struct entry_candidate {
	enum entry_kind kind;
	char text[ENTRY_NAME];    /* the word or name                          */
	char address[32];         /* "": none                                  */
	char note[ENTRY_NAME];    /* type and comment; for a word its explanation */
	char line[ENTRY_TEXT];    /* the line after the candidate is taken     */
};

/**
 * entry_candidates - candidates for the word before the cursor, best first
 * @cursor: bytes of @line before it
 * @out:    caller's, room for @most
 *
 * Exact matches come first, then texts that begin with the word, then texts that contain
 * it; in each group variables of the fitting type, addresses in use, pins, words. Last
 * comes a new name, where one is possible, with each address it may get. Returns how many.
 * Owns: nothing.   Scan-safe: no.
 */
int entry_candidates(const struct entry_place *place, const char *line, size_t cursor,
		     struct entry_candidate *out, int most);
/** entry_kind_text - "variable", for a screen reader; N_() text. Lives for ever. */
const char *entry_kind_text(enum entry_kind kind);
#endif
