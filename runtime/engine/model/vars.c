/* SPDX-License-Identifier: MIT
 *
 * vars - declared variables in the order of their declaration.
 *
 * Small look-ups only; names of a whole project are found through check/scope.h.
 */
#include "engine/model/vars.h"

uint8_t vars_flags(const struct var_table *table, int index)
{
	int low = 0, high = table->block_count;

	/* The last block that begins at or before @index; empty blocks begin
	 * where the next one does. */
	while (high - low > 1) {
		int middle = low + (high - low) / 2;

		if (table->block[middle].first <= index)
			low = middle;
		else
			high = middle;
	}
	return table->block_count ? table->block[low].flags : 0;
}

int vars_find(const struct var_table *table, uint32_t fold)
{
	for (int i = 0; fold && i < table->count; i++)
		if (table->var[i].fold == fold)
			return i;
	return -1;
}

const char *vars_head(uint8_t flags)
{
	static const struct { uint8_t flag; const char *word; } heads[] = {
		{ VAR_GLOBAL_WORD, "VAR_GLOBAL" }, { VAR_INPUT, "VAR_INPUT" },
		{ VAR_OUTPUT, "VAR_OUTPUT" }, { VAR_IN_OUT, "VAR_IN_OUT" },
		{ VAR_TEMP, "VAR_TEMP" },
	};

	for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++)
		if (flags & heads[i].flag)
			return heads[i].word;
	return "VAR";
}
