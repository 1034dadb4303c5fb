/* SPDX-License-Identifier: MIT
 *
 * entry_duplicate - copies of rungs whose timers and counters have instances of their own.
 */
#ifndef EDITOR_ENTRY_DUPLICATE_H
#define EDITOR_ENTRY_DUPLICATE_H

#include "editor-gtk/edit/entry.h"

struct entry_instance {
	uint32_t from, to;   /* string ids of names                            */
	enum word word;      /* the block that it is one of                    */
	bool retain;         /* both are retained                              */
};

/**
 * entry_duplicate - copies rungs of the POU of @place; their instances get new names
 * @rungs: replaced by the copies, each the caller's, rung_free()
 * @made:  gets @made_count new instances, each to be declared; the caller's, free()
 *
 * Elements of arrays and parameters of the POU keep their names.   Scan-safe: no.
 * Fails: false, memory is out; @rungs are unchanged.
 */
bool entry_duplicate(const struct entry_place *place, struct rung **rungs, int count,
		     struct entry_instance **made, int *made_count);
#endif
