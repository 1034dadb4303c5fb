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

/**
 * text_lines_match - which lines of @other the lines of @shown are
 * @other: may begin behind the first line of @shown and end behind its last one
 * @count: gets the number of lines of @shown, the last one included
 *
 * Compares from both ends, up to the first line with other words: what stands between was
 * edited. Gives for each line of @shown a line of @other, from 0; -1: none, or it is blank.
 * Owns: the caller, free(). Fails: NULL: no memory.
 */
int *text_lines_match(const char *shown, const char *other, int *count);

/** text_lines_count - number of complete lines of @text. */
int text_lines_count(const char *text);

#endif
