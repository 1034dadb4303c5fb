/* SPDX-License-Identifier: MIT
 *
 * entry_duplicate - a rung once more, with blocks that count and time for themselves.
 */
#ifndef EDITOR_ENTRY_DUPLICATE_H
#define EDITOR_ENTRY_DUPLICATE_H

#include "editor-gtk/entry.h"

struct entry_instance {
	uint32_t from, to;   /* string ids of names                            */
	enum word word;      /* the block that it is one of                    */
};

/**
 * entry_duplicate - a copy of a rung of the POU of @place, whose instances have new names
 * @made:  gets them, @count of them, each to be declared; the caller's, free()
 *
 * Elements of arrays and parameters of the POU stay what they are. Owns: the caller,
 * rung_free().   Scan-safe: no.   Fails: NULL, memory is out.
 */
struct rung *entry_duplicate(const struct entry_place *place, const struct rung *rung,
			     struct entry_instance **made, int *count);
#endif
