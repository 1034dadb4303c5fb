/* SPDX-License-Identifier: MIT
 *
 * file_marks - what is wrong with lines of a text: underlined, and told below it for the
 * line that the cursor is on. Marks go with their lines while somebody types.
 */
#ifndef EDITOR_FILE_MARKS_H
#define EDITOR_FILE_MARKS_H

#include <gtk/gtk.h>

struct file_marks;

/** file_marks_new - none yet. @buffer: referenced; @told: the label below; borrowed as long
 * as the marks. Owns: file_marks_free(). */
struct file_marks *file_marks_new(GtkTextBuffer *buffer, GtkLabel *told);
void file_marks_free(struct file_marks *marks);
void file_marks_clear(struct file_marks *marks);
/** file_marks_add - @line, @column: 1-based, bytes; column 0: the whole line. */
void file_marks_add(struct file_marks *marks, int line, int column, const char *text);
/** file_marks_of - of a line, 1-based; NULL: nothing is wrong with it. Caller frees. */
char *file_marks_of(struct file_marks *marks, int line);

#endif
