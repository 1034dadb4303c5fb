/* SPDX-License-Identifier: MIT
 *
 * text_lines - finds a line of the canonical text in the text as it was typed.
 *
 * Lists are checked in canonical form, without blank lines and with other indents, while
 * the user edits the text as it was typed. It reads no file.
 */
#ifndef EDITOR_TEXT_LINES_H
#define EDITOR_TEXT_LINES_H

/**
 * text_lines_place - maps a place of the canonical text to the shown text
 * @line:   0-based, becomes a line of @shown; @column: bytes, or NULL
 *
 * Chooses the nearest line with the same words; else the line with as many non-blank lines
 * before it. Owns: nothing.
 */
void text_lines_place(const char *shown, const char *canonical, int *line, int *column);

/** text_lines_count - number of complete lines of @text. */
int text_lines_count(const char *text);

#endif
