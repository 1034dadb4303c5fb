/* SPDX-License-Identifier: MIT
 *
 * iomap_compare - the differences of two I/O maps: lines that came, went or changed, by address.
 */
#ifndef EDITOR_IOMAP_COMPARE_H
#define EDITOR_IOMAP_COMPARE_H

#include <glib.h>
#include <stdbool.h>

/* A line that differs, named by its address or "BOARD". Texts are borrowed during the call. */
struct iomap_difference {
	const char *address;
	bool in_a, in_b;
	const char *field;      /* translated; NULL: the whole line came or went */
	const char *from, *to;  /* of the field, or the words of the line; "": nothing */
};

/** iomap_compare - @a, @b: texts; NULL: there is no map. Any bytes. Hands over a difference for each
 * line that came or went and for each field that changed, in the order of @b, then what only @a has. */
void iomap_compare(const char *a, const char *b,
		   void (*take)(void *context, const struct iomap_difference *what), void *context);

#endif
