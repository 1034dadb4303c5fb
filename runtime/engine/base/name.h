/* SPDX-License-Identifier: MIT
 *
 * name - whether two spellings are one name.
 *
 * Case does not count, nor whether an accent is a character of its own: é, É and e with U+0301
 * are one letter. Spellings are compared after canonical decomposition and simple case folding
 * of Unicode, without a locale. Bytes that are no UTF-8 are compared as they are. It keeps no
 * names: names.h does.
 */
#ifndef BASE_NAME_H
#define BASE_NAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** name_same - are they spellings of one name? No NUL is needed. Scan-safe: yes; so are all. */
bool name_same(const char *a, size_t a_len, const char *b, size_t b_len);

/** name_is - the same of the NUL-ended @word and @len bytes of @text. */
bool name_is(const char *word, const char *text, size_t len);

/** name_equal - the same of two NUL-ended texts. */
bool name_equal(const char *a, const char *b);

/** name_begins - does @text begin with the letters of @begin? */
bool name_begins(const char *begin, size_t begin_len, const char *text, size_t len);

/**
 * name_head - bytes at the beginning of @text that spell @word
 *
 * A point, a bracket, a blank or the end follows them in @text.
 * Returns 0 if it begins with no spelling of @word.
 */
size_t name_head(const char *word, size_t word_len, const char *text, size_t len);

/* The hash of a name is the same for all spellings: first NAME_HASH, then the name in one piece
 * or several, which end before a point, bracket or blank. */
#define NAME_HASH 2166136261u
uint32_t name_hash_more(uint32_t hash, const char *text, size_t len);
/** name_hash - the hash of a whole name, its bits mixed. */
uint32_t name_hash(const char *text, size_t len);

/** name_key - a text that is the same for all spellings: decomposed and folded. Returns as
 * snprintf; @out may be NULL if @size is 0. */
size_t name_key(const char *text, size_t len, char *out, size_t size);

#endif
