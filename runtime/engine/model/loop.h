/* SPDX-License-Identifier: MIT
 *
 * loop - the text behind FOR: "I := 1 TO Count BY 2" (IEC 61131-3 table 56). Names are
 * not resolved.
 */
#ifndef MODEL_LOOP_H
#define MODEL_LOOP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct loop_part {
	const char *text; /* borrowed; not NUL-ended                          */
	size_t len;
};

struct loop {
	struct loop_part variable, from, to, by; /* by.text NULL: BY 1        */
	int64_t step;     /* of BY, a whole constant                          */
};

/** loop_parse - parses the text behind FOR. Scan-safe: no. Fails: false if its form is
 * wrong. */
bool loop_parse(const char *text, size_t len, struct loop *out);
#endif
