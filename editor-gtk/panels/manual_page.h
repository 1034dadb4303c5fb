/* SPDX-License-Identifier: MIT
 *
 * manual_page - a page of the manual as the text of a GtkTextView.
 *
 * Headings, paragraphs, lists and code are text, so that they can be selected. Tables and
 * pictures are widgets in the text; what is copied has their text in their place.
 */
#ifndef EDITOR_MANUAL_PAGE_H
#define EDITOR_MANUAL_PAGE_H

#include "editor-gtk/kit/markdown.h"

#include <gtk/gtk.h>

struct manual_text {
	GtkTextView *view;      /* borrowed                                      */
	GArray *start;          /* int: where each block begins in the text      */
	GPtrArray *tables;      /* GtkWidget, borrowed: a grid of labels; NULL for other blocks */
	GPtrArray *pictures;    /* the same: a GtkPicture                       */
	const struct md_page *page; /* borrowed; NULL: none yet                  */
	int width;              /* px of the text                               */
};

void manual_text_init(struct manual_text *text, GtkTextView *view);
void manual_text_clear(struct manual_text *text);
/** manual_text_show - the page, which must live as long, in place of the last one. @folder: of the pictures; @follow:
 * called with @data for a link in a table. */
void manual_text_show(struct manual_text *text, const struct md_page *page, const char *folder,
		      gboolean (*follow)(GtkLabel *label, const char *link, gpointer data),
		      gpointer data);
/** manual_text_fit - tables and pictures become as wide as the text. */
void manual_text_fit(struct manual_text *text);
/** manual_text_block - the number of the block at a place; -1: none. */
int manual_text_block(const struct manual_text *text, const GtkTextIter *at);
/** manual_text_copy - the text of a selection; tables as lines, their cells parted by tabs.
 * Caller frees. */
char *manual_text_copy(const struct manual_text *text, const GtkTextIter *from,
		       const GtkTextIter *to);
/** manual_text_block_copy - all text of a block, likewise. Caller frees. */
char *manual_text_block_copy(const struct manual_text *text, int block);
/** manual_text_link - the link at a place in the text; NULL: none. Borrowed. */
const char *manual_text_link(const GtkTextIter *at);
/** manual_text_next_link - moves @at to the next link behind it, or before; false: none. */
bool manual_text_next_link(GtkTextIter *at, GtkTextIter *end, bool back);

#endif
