/* SPDX-License-Identifier: MIT
 *
 * find - find and replace in all texts of a document. It renames nothing: for a symbol
 * that is used in many places there is rename (symbols.h).
 */
#ifndef EDITOR_FIND_H
#define EDITOR_FIND_H

#include "editor-gtk/document/document.h"

/* Where to look. */
enum find_where {
	FIND_OPERANDS = 1,     /* of cells, with expressions and parameters    */
	FIND_COMMENTS = 2,     /* of cells and rungs                           */
	FIND_TITLES = 4,
	FIND_LABELS = 8,
	FIND_LISTS = 16,       /* POUs in IL, whole                            */
	FIND_DECLARATIONS = 32,
	FIND_EVERYWHERE = 63,
};

struct find_options {
	unsigned int where;    /* enum find_where, or'ed                       */
	bool whole_word;       /* nothing of a name before and behind          */
	bool match_case;       /* else letters of all scripts are alike        */
};

struct find_hit {
	enum find_where where;
	int pou;               /* 0-based; -1: globals and structures          */
	int rung, row, col;    /* 0-based; -1: the whole. Of a list: row is the line
				  of its text, col the byte in it              */
	int table, index;      /* of a declaration, as in xref                 */
	int field;             /* private: which text of the cell              */
	bool by_symbol;        /* its symbol lies at the address that is wanted: there
				  is nothing to be replaced here               */
	gsize at, len;         /* bytes in the text                            */
	char *text;            /* all of that text, or its line                */
};

struct find {
	GPtrArray *hit;        /* of struct find_hit *, in the order of the file */
	char *wanted;
	struct find_options options;
};

#define FIND_HITS_MOST 100000

/** find_new - all hits in the document as it is; of a whole address (%QX0.0) also the
 * elements whose symbol lies at it. Owns: the caller. */
struct find *find_new(LadderDocument *document, const char *wanted,
		      struct find_options options);
void find_free(struct find *find);
/** find_next - the first hit behind a place (0-based, -1: before all in it), or before
 * it; around the end. -1: there is none. */
int find_next(const struct find *find, int pou, int rung, int row, int col, bool back);

/**
 * find_replace - one hit becomes @with, as a step of its own
 * The hits are those of before: find_new again. Fails: false, and @why (the caller
 * frees it; may be NULL): what came of it could not be read. Nothing changed.
 */
bool find_replace(LadderDocument *document, const struct find *find, int number,
		  const char *with, char **why);
/** find_replace_all - all of them that are not by_symbol as one step. Returns how many;
 * -1: as above. */
int find_replace_all(LadderDocument *document, const struct find *find, const char *with,
		     char **why);

#endif
