/* SPDX-License-Identifier: MIT
 *
 * il - an instruction list as data.
 *
 * It keeps lines in order and knows nothing of their meaning.
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
