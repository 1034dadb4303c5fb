/* SPDX-License-Identifier: MIT
 *
 * declared - steps through the declared variables and instances of an image.
 *
 * Pins and elements are in symbols.c, which a small board does not link.
 */
#include "engine/scan/image.h"

#include <string.h>

/* A bit of the areas, counted from the start of the first area, as a bit of its own
 * area. */
static void locate_bit(const struct areas *areas, struct location *at, uint32_t bit)
{
	at->area = areas_find(areas, bit / 8);
	at->where = bit - areas->at[at->area] * 8;
}

static uint32_t stride_of(const struct program *p, const struct location *at)
{
	const struct code_run *run;

	if (at->area != AREA_NONE)
		return 1;
	run = at->type == IEC_STRING ? code_run_at(p, at->where) : NULL;
	return run ? code_run_size(run) : iec_type_row(at->type)->size;
}

static bool next(const struct program *p, struct declared_cursor *cursor,
		 struct declared_name *out)
{
	uint32_t i = cursor->index, word;

	if (i >= p->symbol_count)
		return false;
	if (cursor->group + 1 < p->group_count &&
	    p->group[cursor->group + 1].first == i)
		cursor->group++;
	const struct code_group *group = &p->group[cursor->group];

	word = p->symbol[i];
	*out = (struct declared_name){
		.name = p->string + cursor->string, .pou = "",
		.at.type = (enum iec_type)(CODE_TYPE(word) & SYMBOL_TYPE),
		.at.where = CODE_OFFSET(word),
		.at.constant = group->flags & SYMBOL_CONSTANT,
		.flags = group->flags |
			 (CODE_TYPE(word) & (SYMBOL_HIDDEN | SYMBOL_SHARED)),
	};
	if (group->pou)
		out->pou = p->string + p->entry[group->pou - 1].name;
	if (CODE_TYPE(word) & SYMBOL_BIT)
		locate_bit(&p->areas, &out->at, CODE_OFFSET(word));
	out->array = code_bounds(out->name);
	out->stride = stride_of(p, &out->at);
	cursor->string += (uint32_t)strlen(out->name) + 1;
	cursor->index++;
	return true;
}

bool image_next_declared(const struct program *p, struct declared_cursor *cursor,
			 struct declared_name *out)
{
	while (next(p, cursor, out))
		if (cursor->memories || !(out->flags & SYMBOL_HIDDEN) ||
		    !strchr(out->name, ' '))
			return true;
	return false;
}

struct location declared_element(const struct declared_name *array,
				 uint32_t number)
{
	struct location at = array->at;

	at.where += number * array->stride;
	return at;
}
