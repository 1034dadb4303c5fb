/* SPDX-License-Identifier: MIT
 *
 * markdown - a page of the manual as blocks: headings, paragraphs, tables, code, pictures.
 *
 * The library md4c parses it; without the library (markdown_none.c) there are no pages.
 * Constructs that the manual does not use are refused: see md_page.unknown.
 */
#ifndef EDITOR_MARKDOWN_H
#define EDITOR_MARKDOWN_H

#include <glib.h>
#include <stdbool.h>

enum md_style { MD_BOLD = 1, MD_EMPHASIS = 2, MD_CODE = 4 };

/* A piece of text in one style. */
struct md_run {
	char *text;
	unsigned int style;  /* enum md_style, or'ed                             */
	char *link;          /* "rung-file.md#tasks"; NULL: none                */
};

enum md_kind { MD_HEADING, MD_TEXT, MD_CODE_BLOCK, MD_TABLE, MD_PICTURE };

struct md_block {
	enum md_kind kind;
	int level;           /* of a heading, 1 …; else how deep in lists, 0: not */
	char *mark;          /* of the first text of an item: "•", "3."; NULL: none */
	char *anchor;        /* of a heading, as links name it                   */
	GArray *runs;        /* struct md_run; the code; the text instead of a picture */
	char *file;          /* of a picture                                     */
	int columns;         /* of a table                                       */
	GPtrArray *cells;    /* of a table: GArray of struct md_run, row by row; the first row
				is the heading */
};

struct md_page {
	char *title;         /* the first heading; never NULL                   */
	GPtrArray *blocks;   /* struct md_block                                 */
	char *unknown;       /* the first construct that is not shown; NULL: none */
};

/** markdown_is_here - was the editor built with the library? */
bool markdown_is_here(void);
/** markdown_read - Owns: markdown_free(). NULL: the library is missing. */
struct md_page *markdown_read(const char *text, gsize len);
void markdown_free(struct md_page *page);
/** markdown_runs_text - the text of runs without styles. Caller frees. */
char *markdown_runs_text(const GArray *runs);
/** markdown_block_text - all text of a block; cells are parted by tabs and lines. Caller
 * frees. */
char *markdown_block_text(const struct md_block *block);
/** markdown_anchor - of a heading: "Elements of arrays" is elements-of-arrays. Caller frees. */
char *markdown_anchor(const char *heading);

#endif
