/* SPDX-License-Identifier: MIT
 *
 * entry_duplicate - rungs once more, with blocks that count and time for themselves.
 */
#ifndef EDITOR_ENTRY_DUPLICATE_H
#define EDITOR_ENTRY_DUPLICATE_H

#include "editor-gtk/edit/entry.h"

struct entry_instance {
	uint32_t from, to;   /* string ids of names                            */
	enum word word;      /* the block that it is one of                    */
	bool retain;         /* it is kept while the power is off: so is this  */
};

/**
 * entry_duplicate - copies of rungs of the POU of @place, whose instances have new names
 * @rungs: become the copies, each the caller's, rung_free()
 * @made:  gets them, @made_count of them, each to be declared; the caller's, free()
 *
 * Elements of arrays and parameters of the POU stay what they are.   Scan-safe: no.
 * Fails: false, memory is out; @rungs are what they were.
 */
bool entry_duplicate(const struct entry_place *place, struct rung **rungs, int count,
		     struct entry_instance **made, int *made_count);
#endif
