/* SPDX-License-Identifier: MIT
 *
 * text_lines - which line of a text that a person writes is a line of its canonical form.
 *
 * Lists are checked as a file would hold them, without blank lines and with other
 * indents, while the person goes on in the text as it was typed. It reads no file.
 */
#ifndef EDITOR_TEXT_LINES_H
#define EDITOR_TEXT_LINES_H

/**
 * text_lines_place - where a place of the canonical text is in the one that is shown
 * @line:   0-based, becomes one of @shown; @column: bytes, or NULL
 *
 * The line that says the same, the nearest one if there are some; else the one before
 * which as many lines stand that are not blank. Owns: nothing.
 */
void text_lines_place(const char *shown, const char *canonical, int *line, int *column);

/** text_lines_count - lines of @text that end. */
int text_lines_count(const char *text);

#endif
