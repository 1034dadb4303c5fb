/* SPDX-License-Identifier: MIT
 *
 * mend_habits - a row of a rung as people type it who know other controllers: whole cells are written anew.
 *
 * Logix, Siemens, Mitsubishi and CODESYS write two contacts behind each other, a branch with OR, the values
 * of a timer in parentheses, constants with K, and addresses with a blank or a slash. mend.c mends the words and
 * signs of what is made here.
 */
#ifndef TEXT_MEND_HABITS_H
#define TEXT_MEND_HABITS_H

#include "engine/text/mend.h"

/**
 * mend_habits - writes the cells of a row anew
 * @text: the row, without blanks around it, NUL-ended; gets the new one
 * @size: its room
 * @out:  gets the first change, as if it were the only one; its line is not written
 *
 * False: nothing was changed. Owns: nothing.   Scan-safe: no.
 */
bool mend_habits(struct project *project, char *text, size_t size, struct mended *out);

#endif
