/* SPDX-License-Identifier: MIT
 *
 * carry_losses - tells a person what a plan does not carry, in names.
 */
#include "engine/scan/carry_plan.h"

#include <stdio.h>
#include <string.h>

struct teller {
	const struct carry_plan *plan;
	const struct image *now;
	void (*tell)(void *context, const struct carry_loss *loss);
	void *context;
};

static void tell(const struct teller *teller, enum carry_reason reason, const char *name,
		 struct location at)
{
	const struct carry_loss loss = { reason, name, at };

	teller->tell(teller->context, &loss);
}

/* ---- values ---- */

/* "Main.List[3..4]": @count elements of the loss from its @first on. */
static void tell_part(const struct teller *teller, const struct carry_lost *lost,
		      uint32_t first, uint32_t count, struct location at)
{
	const int low = (int)(lost->low + (int64_t)first);
	const int own = (int)(lost->head < LIMIT_NAME ? lost->head : LIMIT_NAME);
	char text[2 * LIMIT_NAME + 64];
	int used = snprintf(text, sizeof(text), "%.255s%s%.*s", lost->pou,
			    *lost->pou ? "." : "", own, lost->name);

	if (lost->count)
		used += snprintf(text + used, sizeof(text) - (size_t)used, "[%d", low);
	if (lost->count && count > 1)
		used += snprintf(text + used, sizeof(text) - (size_t)used, "..%d",
				 (int)(low + (int64_t)count - 1));
	if (lost->count)
		snprintf(text + used, sizeof(text) - (size_t)used, "]");
	tell(teller, lost->reason, text, at);
}

static bool is_too_long(const struct carry_lost *lost, const struct image *now, uint32_t i)
{
	const uint8_t *text = now->memory + lost->from + i * lost->stride;

	return iec_load(text, IEC_STRING).s->length > lost->room;
}

/* One by one, as each text has its own length. */
static void tell_texts(const struct teller *teller, const struct carry_lost *lost)
{
	const uint32_t count = lost->count ? lost->count : 1;
	const uint32_t size = iec_type_size(IEC_STRING, lost->room);
	struct location at = lost->at;

	for (uint32_t i = 0; i < count; i++, at.where += size)
		if (is_too_long(lost, teller->now, i))
			tell_part(teller, lost, i, 1, at);
}

/* ---- forces ---- */

/* Forces that end and are not reported yet: a bit for each. */
struct ending {
	uint64_t bit[LIMIT_FORCES / 64];
};
_Static_assert(LIMIT_FORCES % 64 == 0, "a word of the set is cut");

static bool has_address(const struct carry_plan *plan, struct location at)
{
	return at.area != AREA_NONE || at.where < plan->from->areas.size;
}

static void tell_address(const struct teller *teller, struct location at)
{
	const struct areas *areas = &teller->plan->from->areas;
	struct iec_addr addr = {
		.area = at.area, .bits = 1, .bit = at.where % 8, .byte = at.where / 8,
	};
	char text[32];

	if (at.area == AREA_NONE) {
		addr.area = areas_find(areas, at.where);
		addr.bits = (uint8_t)(8 * iec_type_row(at.type)->size);
		addr.bit = 0;
		addr.byte = at.where - areas->at[addr.area];
	}
	iec_addr_print(addr, text, sizeof(text));
	tell(teller, CARRY_FORCE, text, at);
}

/* False: the names of all were reported. */
static bool find_ending(const struct teller *teller, struct ending *ending)
{
	const struct image *now = teller->now;
	bool any = false;

	memset(ending, 0, sizeof(*ending));
	for (int i = 0; i < now->force_count; i++) {
		const struct location at = now->force[i].at;

		if (carry_force_place(teller->plan, at).type != IEC_NONE)
			continue;
		if (has_address(teller->plan, at)) {
			tell_address(teller, at);
			continue;
		}
		ending->bit[i / 64] |= UINT64_C(1) << i % 64;
		any = true;
	}
	return any;
}

/* The forces of one symbol of the old program; NULL: all that are left. */
static void tell_forces(const struct teller *teller, struct ending *ending,
			const struct symbol *symbol)
{
	for (int i = 0; i < teller->now->force_count; i++) {
		const struct location at = teller->now->force[i].at;
		const uint64_t bit = UINT64_C(1) << i % 64;

		if (!(ending->bit[i / 64] & bit) ||
		    (symbol && (symbol->at.type != at.type || symbol->at.area != at.area ||
				symbol->at.where != at.where)))
			continue;
		ending->bit[i / 64] &= ~bit;
		tell(teller, CARRY_FORCE, symbol ? symbol->name : "", at);
	}
}

static void tell_all_forces(const struct teller *teller)
{
	struct symbol_cursor cursor = { .whole = true };
	struct ending ending;
	struct symbol symbol;

	if (!find_ending(teller, &ending))
		return;
	while (image_next_symbol(teller->now, &cursor, &symbol))
		tell_forces(teller, &ending, &symbol);
	tell_forces(teller, &ending, NULL);
}

void carry_plan_losses(const struct carry_plan *plan, const struct image *now,
		       void (*take)(void *context, const struct carry_loss *loss),
		       void *context)
{
	const struct teller teller = { plan, now, take, context };

	for (uint32_t i = 0; i < plan->lost_count; i++) {
		const struct carry_lost *lost = &plan->lost[i];

		if (lost->reason == CARRY_TEXT && now && now->memory)
			tell_texts(&teller, lost);
		else
			tell_part(&teller, lost, 0, lost->count, lost->at);
	}
	if (now)
		tell_all_forces(&teller);
}
