/* SPDX-License-Identifier: MIT
 *
 * find - find and replace in all texts of a document. It does not rename: see rename in
 * symbols.h for a symbol that is used in many places.
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
	bool whole_word;       /* no letter or digit before and behind         */
	bool match_case;       /* else case does not count, in all scripts     */
};

struct find_hit {
	enum find_where where;
	int pou;               /* 0-based; -1: globals and structures          */
	int rung, row, col;    /* 0-based; -1: the whole. In a list: row is the line of its
				  text, col the byte in it */
	int table, index;      /* of a declaration, as in xref                 */
	int field;             /* private: the text of the cell                */
	bool by_symbol;        /* the symbol lies at the searched address: nothing to replace
				  */
	gsize at, len;         /* bytes in the text                            */
	char *text;            /* the whole text, or its line                  */
};

struct find {
	GPtrArray *hit;        /* of struct find_hit *, in the order of the file */
	char *wanted;
	char *folded;          /* private                                      */
	struct find_options options;
};

/* The hits that the sheets mark. */
struct find_seen {
	const struct find *find; /* NULL: none                                 */
	int current;           /* index of the current hit; -1: none           */
	bool all;              /* also the others                              */
};

#define FIND_HITS_MOST 100000

/** find_new - all hits in the document as it is. A whole address (%QX0.0) also finds
 * elements whose symbol lies at it. Owns: the caller. */
struct find *find_new(LadderDocument *document, const char *wanted,
		      struct find_options options);
void find_free(struct find *find);
/** find_next - the first hit behind a place (0-based, -1: before all in it), or before it;
 * goes on at the other end. -1: there is none. */
int find_next(const struct find *find, int pou, int rung, int row, int col, bool back);
/** find_seen_next - the first marked hit in @pou from index *@at on; *@at: the index behind it. NULL: no
 * more. @now: whether it is the current one. Owns: @find. */
const struct find_hit *find_seen_next(const struct find_seen *seen, int pou, int *at, bool *now);
/** find_match - the first match of the searched text in any text, from byte *@from on; *@from: its end.
 * Returns where it begins; -1: there is none. */
gssize find_match(const struct find *find, const char *text, gsize *from);

/**
 * find_replace - replaces one hit by @with, as a step
 *
 * @find is out of date then: call find_new again. Fails: false, and @why (the caller frees
 * it; may be NULL): the result could not be read. Nothing changed.
 */
bool find_replace(LadderDocument *document, const struct find *find, int number,
		  const char *with, char **why);
/** find_replace_all - replaces all hits that are not by_symbol, as one step. Returns how
 * many; -1: failed as above. */
int find_replace_all(LadderDocument *document, const struct find *find, const char *with,
		     char **why);

#endif
