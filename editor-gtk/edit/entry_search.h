/* SPDX-License-Identifier: MIT
 *
 * entry_search - what the files of the candidates share. Only they include it.
 */
#ifndef EDITOR_ENTRY_SEARCH_H
#define EDITOR_ENTRY_SEARCH_H

#include "editor-gtk/edit/entry_inside.h"

enum {
	WANT_WORD = 1, WANT_BOOL = 2, WANT_ANY = 4, WANT_INSTANCE = 8, WANT_LABEL = 16,
	WANT_ROUTINE = 32, WANT_PIN_NAME = 64, WANT_NEW = 128,
	WANT_FUNCTION = 256,
};

struct search {
	const struct entry_place *place;
	const char *line;
	size_t cursor, from;       /* the word is line[from … cursor)          */
	size_t head;               /* of it: up to its last dot; 0: none       */
	unsigned int want;
	uint16_t classes;          /* of values; 0: any                        */
	bool write;
	const struct word_row *row; /* of the line's word; NULL: none          */
	enum word word;
	struct entry_candidate *out;
	int count, most;
	int *rank;                 /* of each in out                           */
};

/** entry_is_part - may the byte be one of a word? */
bool entry_is_part(char c);
/** entry_find_want - what may stand at the word before the cursor, by what stands before
 * that. */
void entry_find_want(struct search *s);
/** entry_add_new - a new name behind the others, if the line would declare it. */
void entry_add_new(struct search *s);
/** entry_is_said - does the cursor stand in what a line says of its name, `AT %I`? It is
 * offered then. */
bool entry_is_said(struct search *s);
#endif
