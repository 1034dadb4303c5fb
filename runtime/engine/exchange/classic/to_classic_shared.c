/* SPDX-License-Identifier: MIT
 *
 * to_classic_shared - which variables lie on one another here. ClassicLadder's have each a
 * memory of their own, so such a one has no number there.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include <string.h>

static bool overlap(struct iec_addr a, int64_t bits, struct iec_addr b, int64_t more)
{
	int64_t from = (int64_t)a.byte * 8 + a.bit, to = (int64_t)b.byte * 8 + b.bit;

	return a.area == b.area && from < to + more && to < from + bits;
}

static int64_t bits_of(const struct var *var)
{
	return (int64_t)var->at.bits * (var->array.count ? var->array.count : 1);
}

static bool table_shares(const struct var_table *table, const struct var *var)
{
	for (int i = 0; i < table->count; i++)
		if (&table->var[i] != var && table->var[i].at.area != AREA_NONE &&
		    overlap(var->at, bits_of(var), table->var[i].at,
			    bits_of(&table->var[i])))
			return true;
	return false;
}

bool is_shared(struct leaving *e, const struct var *var)
{
	const struct names *names = &e->project->names;

	for (uint32_t id = 1; id < (uint32_t)names->count; id++) {
		const char *text = names_text(names, id);
		struct iec_addr addr;

		if (id != var->at_text && iec_addr_parse(text, strlen(text), &addr) == ADDR_OK &&
		    overlap(var->at, bits_of(var), addr, addr.bits) &&
		    memcmp(&addr, &var->at, sizeof(addr)) != 0)
			return true;
	}
	if (table_shares(&e->project->globals, var))
		return true;
	for (int i = 0; i < e->project->pou_count; i++)
		if (table_shares(&e->project->pou[i].vars, var))
			return true;
	return false;
}
