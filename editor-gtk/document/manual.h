/* SPDX-License-Identifier: MIT
 *
 * manual - the pages of the manual (docs/), by name, and search over all of them.
 */
#ifndef EDITOR_MANUAL_H
#define EDITOR_MANUAL_H

#include "editor-gtk/kit/markdown.h"

struct manual;

/** manual_new - the pages beside the program, in the build or installed. Owns:
 * manual_free(). NULL: there is no manual. */
struct manual *manual_new(void);
void manual_free(struct manual *manual);
/** manual_folder - of the pages and pictures. Borrowed. */
const char *manual_folder(const struct manual *manual);

/** manual_count - pages, in the order in which they are listed. */
int manual_count(const struct manual *manual);
/** manual_name - of a page: "editor.md". Borrowed. */
const char *manual_name(const struct manual *manual, int page);
/** manual_find - the number of a page; -1: there is none. */
int manual_find(const struct manual *manual, const char *name);
/** manual_page - read when it is asked for first. Borrowed; NULL: it cannot be read, or
 * markdown_is_here() is false. */
const struct md_page *manual_page(struct manual *manual, int page);
/** manual_anchor - the block of a heading with this anchor; -1: none. */
int manual_anchor(struct manual *manual, int page, const char *anchor);
/** manual_word - the block of words.md about a word of the catalogue; -1: none. */
int manual_word(struct manual *manual, const char *word);
/** manual_code - page and block of the first text about the code of a message, "LD336".
 * False: no page names it. */
bool manual_code(struct manual *manual, const char *code, int *page, int *block);

struct manual_hit { int page, block; char *line; };
/** manual_search - blocks with a text, in any case; at most @most. struct manual_hit; Owns:
 * g_array_unref(). */
GArray *manual_search(struct manual *manual, const char *text, guint most);

#endif
