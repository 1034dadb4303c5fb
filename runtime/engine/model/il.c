/* SPDX-License-Identifier: MIT
 *
 * il - an instruction list as data: a vector of lines.
 */
#include "engine/model/il.h"

struct il_line *il_add(struct il *il, struct il_line line)
{
	struct il_line *added = arena_push(il->arena, &il->line, &il->count,
					   sizeof(line));

	if (added)
		*added = line;
	return added;
}
