/* SPDX-License-Identifier: MIT
 *
 * ascii - letters without a locale.
 *
 * Keywords compare the same on every machine, whatever its language is set to,
 * so <ctype.h> and strcasecmp are not used. Bytes above 127 are never folded.
 */
#ifndef BASE_ASCII_H
#define BASE_ASCII_H

#include <stdbool.h>
#include <stddef.h>

/** ascii_upper - A for a; other bytes as they are. Scan-safe: yes; so are all. */
static inline char ascii_upper(char c)
{
	return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

/** ascii_digit - is it 0 … 9? */
static inline bool ascii_digit(char c)
{
	return c >= '0' && c <= '9';
}

/** ascii_same - whether @len bytes are equal, ignoring case. No NUL is needed. */
static inline bool ascii_same(const char *a, const char *b, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (ascii_upper(a[i]) != ascii_upper(b[i]))
			return false;
	return true;
}

/** ascii_is - whether @text (@len bytes) equals the NUL-ended @word, ignoring case. */
static inline bool ascii_is(const char *word, const char *text, size_t len)
{
	for (size_t i = 0; i < len; i++)
		if (!word[i] || ascii_upper(word[i]) != ascii_upper(text[i]))
			return false;
	return word[len] == '\0';
}

/** ascii_prefix - length of the NUL-ended @word if @text begins with it, else 0. */
static inline size_t ascii_prefix(const char *word, const char *text, size_t len)
{
	size_t i = 0;

	for (; word[i]; i++)
		if (i == len || ascii_upper(word[i]) != ascii_upper(text[i]))
			return 0;
	return i;
}

/** utf8_cut - how many bytes of a NUL-ended UTF-8 text fit into @most, without a part of a character. */
static inline size_t utf8_cut(const char *text, size_t most)
{
	size_t len = 0;

	while (len < most && text[len])
		len++;
	while (len > 0 && text[len] && ((unsigned char)text[len] & 0xc0) == 0x80)
		len--;
	return len;
}

#endif
