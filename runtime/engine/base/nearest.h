/* SPDX-License-Identifier: MIT
 *
 * nearest - the words that are spelled most like a misspelled one.
 *
 * Candidates are offered one after another; the nearest few are kept.
 */
#ifndef BASE_NEAREST_H
#define BASE_NEAREST_H

#include <stddef.h>

#define NEAREST_KEPT 3
#define NEAREST_MOST 32 /* bytes; longer words get no suggestion              */

struct nearest {
	const char *wanted;      /* borrowed                                  */
	size_t len;
	struct nearest_word { const char *text; int far; } word[NEAREST_KEPT];
	int count;
};

/** nearest_init - no candidates yet. Scan-safe: yes. */
void nearest_init(struct nearest *nearest, const char *wanted, size_t len);
/** nearest_offer - a candidate; borrowed as long as @nearest lives. Case is ignored;
 * duplicates count once. Scan-safe: yes. */
void nearest_offer(struct nearest *nearest, const char *text);
/** nearest_print - the wanted word and, as a second part of a diagnostic, the
 * suggestions: "Motor, Rotor". As snprintf, but returns nothing. Scan-safe: no. */
void nearest_print(const struct nearest *nearest, char *out, size_t size);
#endif
