/* SPDX-License-Identifier: MIT
 *
 * mend_number - numbers as people write them in other tools and other countries: 0x1F, 1,5,
 * 1.500,5, 1 500, 5s.
 *
 * It looks at one line and says what its numbers should be; mend.c changes the line.
 */
#ifndef TEXT_MEND_NUMBER_H
#define TEXT_MEND_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/** mend_is_word - is it a character of a name or number? Scan-safe: yes. */
bool mend_is_word(char c);
/** mend_word_length - how many of them @text begins with. Scan-safe: yes. */
size_t mend_word_length(const char *text);
/**
 * mend_groups - a number whose thousands are apart: `1.500,5`, `1,500.5`, `1 500`
 * @line: NUL-ended
 * @at:   byte of its first digit
 * @out:  gets `1500.5`
 *
 * Returns its bytes in the line; 0: none is there, or it does not fit into @out.
 * Owns: nothing.   Scan-safe: yes.
 */
size_t mend_groups(const char *line, size_t at, char *out, size_t size);
/**
 * mend_unit - a number with the unit of a time: `5 sec`
 * @len: bytes of the number at @line + @at
 * @out: gets `T#5s`; `5s` if T# is there already
 *
 * Returns as mend_groups().
 */
size_t mend_unit(const char *line, size_t at, size_t len, char *out, size_t size);
/**
 * mend_separates - may the comma at byte @at separate two values or arguments?
 * @declares: the line is a declaration, where a [ begins a list of values
 *
 * Not in `Level > 1,5`, in `PT := 1,5`, in `2(1,5)`; but in `SQRT(1,5)`. Scan-safe: yes.
 */
bool mend_separates(const char *line, size_t at, bool declares);
/**
 * mend_next_decimal - the next comma, from byte @from on, that may stand for the point of a number
 * @open:  only in this bracket; -1: in all
 *
 * Commas that separate, without a blank between two digits, are taken in pairs: of `[1,5,2,5]`
 * the first and the third. A row of an odd number of values is left alone, because nobody knows
 * which of its commas are points.
 * Returns its byte; -1: there is none. Owns: nothing. Scan-safe: yes.
 */
int mend_next_decimal(const char *line, int from, int open, bool declares);
/** mend_bracket - the byte of the innermost bracket that is open at byte @at; -1: none. Scan-safe:
 * yes. */
int mend_bracket(const char *line, size_t at);

#endif
