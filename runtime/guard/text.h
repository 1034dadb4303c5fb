/* SPDX-License-Identifier: MIT
 *
 * text - short texts without stdio, which would allocate and brings floating point: half of the size
 * of the guard.
 */
#ifndef GUARD_TEXT_H
#define GUARD_TEXT_H

#include <stddef.h>

/**
 * text_print - as snprintf(), for %s, %.*s, %d, %u and %lld only
 * Returns the bytes of the whole text, also if @out has no room for all of it.
 */
int text_print(char *out, size_t size, const char *format, ...)
	__attribute__((format(printf, 3, 4)));
/** text_say - a line on standard error, behind "ladder-guard: "; in one piece, clipped after 500 bytes. */
void text_say(const char *format, ...) __attribute__((format(printf, 1, 2)));
/** text_number - the digits of @text; -1: it has none, has something else, or is more than 2,000,000,000. */
long long text_number(const char *text);
#endif
