/* SPDX-License-Identifier: MIT
 *
 * args - the parameters written at a box: "PT:=T#3s CV=>Count".
 *
 * They are kept as canonical text (one blank between, none around := and =>), and split
 * by this iterator.
 */
#ifndef MODEL_ARGS_H
#define MODEL_ARGS_H

#include <stdbool.h>
#include <stddef.h>

struct arg {
	const char *pin, *value; /* borrowed from the text; not NUL-ended      */
	size_t pin_len, value_len;
	bool output;             /* => instead of :=                           */
	bool inverse;            /* :=/ : a BOOL, inverted; value is without /  */
};

/**
 * args_next - the next parameter of @text, from *@at on
 * @at: start with *at = text
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false at the end.
 */
bool args_next(const char **at, struct arg *out);
/** args_find_side - the parameter of @pin (any case) with => (@output) or with :=. */
bool args_find_side(const char *text, bool output, const char *pin, size_t pin_len,
		    struct arg *out);
/** args_find - the parameter of @pin (any case). */
bool args_find(const char *text, const char *pin, size_t pin_len, struct arg *out);
#endif
