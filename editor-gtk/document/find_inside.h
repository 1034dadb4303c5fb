/* SPDX-License-Identifier: MIT
 *
 * find_inside - what the two halves of find share. Only they include it.
 */
#ifndef EDITOR_FIND_INSIDE_H
#define EDITOR_FIND_INSIDE_H

#include "editor-gtk/document/find.h"

/* Which text of a rung or cell: find_hit.field. */
enum hit_field {
	HIT_OPERAND, HIT_ARGS, HIT_COMMENT, HIT_RUNG_COMMENT, HIT_TITLE, HIT_LABEL,
};

#endif
