/* SPDX-License-Identifier: MIT
 *
 * text_found - marks the hits of a search in a text: yellow grounds, the current one stronger.
 *
 * It does not search by itself: document/find.h has the rule.
 */
#ifndef EDITOR_TEXT_FOUND_H
#define EDITOR_TEXT_FOUND_H

#include "editor-gtk/document/find.h"

#include <gtk/gtk.h>

struct text_found;

/** text_found_new - nothing is marked. @buffer: borrowed, lives longer. Owns: text_found_free(). */
struct text_found *text_found_new(GtkTextBuffer *buffer);
void text_found_free(struct text_found *found);
/** text_found_show - marks all matches; @find NULL: none. The one at byte @column of line @line, both
 * from 0, is the current one; @line -1: none is. @all: also the others. */
void text_found_show(struct text_found *found, const struct find *find, int line, int column, bool all);

#endif
