/* SPDX-License-Identifier: MIT
 *
 * fbd_lines - what the sheet asks about the networks of a POU: headings, statements, lines.
 *
 * It only reads. Sheets cannot include model/fbd.h, as theme.h and the lexer share names.
 */
#ifndef EDITOR_FBD_LINES_H
#define EDITOR_FBD_LINES_H

#include "editor-gtk/edit/fbd_edit.h"

/** fbd_lines_count - how many networks a POU has; 0: it is in another language. */
int fbd_lines_count(const struct pou *pou);
/** fbd_lines_heading - of a network; texts are borrowed from the project. */
struct fbd_heading fbd_lines_heading(const struct project *project, const struct pou *pou, int network);
/** fbd_lines_line - the line of the word NETWORK in the file, from 1. */
int fbd_lines_line(const struct pou *pou, int network);
/** fbd_lines_statement - the number of item @item of the POU in its network, comments not counted. */
int fbd_lines_statement(const struct pou *pou, int network, int item);
/** fbd_lines_place - the lines of the file in which item @item of the POU stands. Fails: false: it has no such item. */
bool fbd_lines_place(const struct project *project, const struct pou *pou, int item, int *first, int *last);
/** fbd_lines_text - of item @item of the POU. Borrowed. */
const char *fbd_lines_text(const struct project *project, const struct pou *pou, int item);
/** fbd_heading_len - bytes of a network's text before the first line below its heading. */
size_t fbd_heading_len(const char *text, size_t len);
/** fbd_is_network - does the text begin with the word NETWORK, behind comments? */
bool fbd_is_network(const char *text);
/** fbd_lines_wire - index in pou->vars of the wire of this name; -1: the network has none. */
int fbd_lines_wire(struct project *project, const struct pou *pou, int network, const char *name, size_t len);

#endif
