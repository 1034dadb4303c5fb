/* SPDX-License-Identifier: MIT
 *
 * text_scroll - scrolls a text to its cursor.
 *
 * Mends in GTK 4.8.3: a text that is scrolled before it has a size keeps the scroll range of that
 * moment, of a page of 0 px, also when it is shown: its first line and column are cut, and it
 * has scrollbars that it does not need. To see it: open an instruction list from the tree.
 * Test: tests/editor/text/test_text.c. On a new floor call gtk_text_view_scroll_to_mark() at once and
 * run it.
 */
#ifndef EDITOR_TEXT_SCROLL_H
#define EDITOR_TEXT_SCROLL_H

#include <gtk/gtk.h>

/** text_scroll_to_cursor - shows the cursor, a tenth of the page from the edges: at once, or when
 * @text has a size. @text: borrowed; it may be destroyed meanwhile. */
void text_scroll_to_cursor(GtkTextView *text);

#endif
