/* SPDX-License-Identifier: MIT
 *
 * vars - declared variables in the order of their declaration.
 *
 * Only simple searches; check/scope.h finds the names of a whole project.
 */
#include "engine/model/vars.h"

#include <string.h>

const struct var_block *vars_block(const struct var_table *table, int index)
{
	int low = 0, high = table->block_count;

	/* Finds the last block that begins at or before @index; empty blocks begin
	 * where the next one does. */
	while (high - low > 1) {
		int middle = low + (high - low) / 2;

		if (table->block[middle].first <= index)
			low = middle;
		else
			high = middle;
	}
	return table->block_count ? &table->block[low] : NULL;
}

uint16_t vars_flags(const struct var_table *table, int index)
{
	const struct var_block *block = vars_block(table, index);

	return block ? block->flags : 0;
}

uint32_t var_unit(const struct var *var)
{
	return iec_type_size(var->type, var->capacity);
}

uint32_t var_bytes(const struct var *var)
{
	return var_unit(var) * (var->array.count ? var->array.count : 1);
}

struct iec_addr vars_shift(struct iec_addr at, uint32_t element)
{
	uint32_t bit = at.bit + element;

	if (at.bits != 1) {
		at.byte += element * (at.bits / 8u);
		return at;
	}
	at.byte += bit / 8;
	at.bit = (uint8_t)(bit % 8);
	return at;
}

/* Bits from the start of the area. */
static uint64_t bits_from(struct iec_addr addr)
{
	return (uint64_t)addr.byte * 8 + addr.bit;
}

bool var_lies_on(const struct var *var, struct iec_addr addr)
{
	const uint32_t count = var->array.count ? var->array.count : 1;
	const struct iec_addr last = vars_shift(var->at, count - 1);

	return addr.area != AREA_NONE && var->at.area == addr.area &&
	       bits_from(addr) + addr.bits > bits_from(var->at) &&
	       bits_from(addr) < bits_from(last) + last.bits;
}

struct var_array vars_flat(const struct var_array *dim, int dims)
{
	uint64_t count = dims ? dim[0].count : 0;

	for (int i = 1; i < dims && count <= UINT32_MAX; i++)
		count *= dim[i].count;
	return (struct var_array){ dims == 1 ? dim[0].low : 0,
				   count > UINT32_MAX ? UINT32_MAX : (uint32_t)count };
}

bool vars_same_bounds(const struct var_array *a, int a_dims, const struct var_array *b, int b_dims)
{
	bool same = a_dims == b_dims || (a_dims <= 1 && b_dims <= 1);

	for (int i = 0; same && a_dims > 1 && i < a_dims; i++)
		same = a[i].low == b[i].low && a[i].count == b[i].count;
	return same;
}

bool var_range_fits(const struct var_range *range)
{
	return range->low <= range->high && range->low >= INT32_MIN && range->low <= INT32_MAX &&
	       range->high - range->low < (int64_t)UINT32_MAX;
}

int64_t var_element(struct var_array array, int64_t index)
{
	int64_t last = (int64_t)array.low + array.count - 1;

	return index < array.low || index > last ? -1 : index - array.low;
}

int vars_find(const struct var_table *table, uint32_t fold)
{
	for (int i = 0; fold && i < table->count; i++)
		if (table->var[i].fold == fold)
			return i;
	return -1;
}

bool vars_is_eno(const struct var_table *table, int index)
{
	return index == 1 && vars_flags(table, index) & VAR_RESULT;
}

int vars_declared(const struct var_table *table)
{
	const struct var_block *last = table->block_count ?
		&table->block[table->block_count - 1] : NULL;

	return last && last->flags & VAR_SFC ? last->first : table->count;
}

const char *vars_head(uint16_t flags)
{
	static const struct { uint16_t flag; const char *word; } heads[] = {
		{ VAR_GLOBAL_WORD, "VAR_GLOBAL" }, { VAR_INPUT, "VAR_INPUT" },
		{ VAR_OUTPUT, "VAR_OUTPUT" }, { VAR_IN_OUT, "VAR_IN_OUT" },
		{ VAR_TEMP, "VAR_TEMP" }, { VAR_EXTERNAL, "VAR_EXTERNAL" },
	};

	for (size_t i = 0; i < sizeof(heads) / sizeof(*heads); i++)
		if (flags & heads[i].flag)
			return heads[i].word;
	return "VAR";
}

bool vars_push(struct var_table *table, int block, const struct var *var,
	       struct arena *arena)
{
	const int at = table->block[block].first + table->block[block].count;

	if (!arena_push(arena, &table->var, &table->count, sizeof(*var)))
		return false;
	memmove(&table->var[at + 1], &table->var[at],
		(size_t)(table->count - 1 - at) * sizeof(*var));
	table->var[at] = *var;
	table->block[block].count++;
	for (int i = block + 1; i < table->block_count; i++)
		table->block[i].first++;
	return true;
}

void vars_pop(struct var_table *table, int block)
{
	const int at = table->block[block].first + --table->block[block].count;

	table->count--;
	memmove(&table->var[at], &table->var[at + 1],
		(size_t)(table->count - at) * sizeof(*table->var));
	for (int i = block + 1; i < table->block_count; i++)
		table->block[i].first--;
}

int vars_argument(const struct var_table *table, uint32_t fold, bool output, int *last)
{
	int index = fold ? vars_find(table, fold) : *last;

	if (fold)
		return index >= 0 && vars_flags(table, index) & (output ? VAR_OUTPUT :
			VAR_INPUT | VAR_IN_OUT) ? index : -1;
	do
		index++;
	while (index < table->count && !(vars_flags(table, index) & (VAR_INPUT | VAR_IN_OUT)));
	*last = index;
	return index < table->count ? index : -1;
}
