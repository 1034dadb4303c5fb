/* SPDX-License-Identifier: MIT
 *
 * touch - whether two operands share a place.
 */
#include "engine/check/touch.h"

uint32_t meaning_end(const struct meaning *m)
{
	struct iec_addr last = m->addr;
	uint32_t count = meaning_reach(m).count;

	if (count)
		last = vars_shift(m->addr, count - 1);
	return last.byte + (last.bits + 7u) / 8;
}

static bool is_var(const struct meaning *m)
{
	return m->var && (m->kind == MEANING_VARIABLE || m->kind == MEANING_PIN ||
			  m->kind == MEANING_INSTANCE ||
			  m->kind == MEANING_STRUCT ||
			  m->kind == MEANING_ARRAY ||
			  m->kind == MEANING_ELEMENT);
}

/* Bytes of a variable that it may cover: all elements that an index may reach. */
static uint32_t end_of(const struct scope *scope, const struct meaning *m)
{
	return m->offset + scope_span(scope, m);
}

/* Do two parts of one variable overlap? With an address, compares places. */
static bool parts_touch(const struct scope *scope, const struct meaning *a,
			const struct meaning *b)
{
	return a->offset < end_of(scope, b) && b->offset < end_of(scope, a);
}

static bool bytes_overlap(const struct meaning *a, const struct meaning *b)
{
	if (a->addr.area != b->addr.area || a->addr.area == AREA_NONE)
		return false;
	if (a->addr.bits == 1 && b->addr.bits == 1 && !meaning_reach(a).count &&
	    !meaning_reach(b).count)
		return a->addr.byte == b->addr.byte && a->addr.bit == b->addr.bit;
	return a->addr.byte < meaning_end(b) && b->addr.byte < meaning_end(a);
}

bool meaning_touches(const struct scope *scope, const struct meaning *a, const struct meaning *b)
{
	if (is_var(a) && is_var(b) && a->var == b->var)
		return parts_touch(scope, a, b);
	return bytes_overlap(a, b);
}
