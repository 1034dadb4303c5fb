/* SPDX-License-Identifier: MIT
 *
 * element - AGET and APUT: elements of arrays whose index is found out in the scan.
 *
 * A value goes through a place of its own, so that no other instruction knows of
 * arrays. Elements with a fixed index are variables like others and not met here.
 */
#include "engine/translate/lists.h"

/* The operands of both instructions behind the value. */
static void emit_array(struct list *list, const struct meaning *m, uint32_t index)
{
	struct spot spot = layout_spot(list->as, m);
	uint32_t base = spot.packed ? spot.offset * 8 + spot.bit : spot.offset;

	emit(list->as, CODE_OPERAND(m->type, base));
	emit(list->as, index);
	emit(list->as, (uint32_t)m->array.low);
	emit(list->as, m->array.count);
	emit(list->as, spot.packed ? 1 : m->stride);
}

static uint32_t index_operand(struct list *list, const struct meaning *m)
{
	return list_number(list, m->index_of, m->index_of->type);
}

static void emit_head(struct list *list, enum vm_op op, const struct meaning *m,
		      uint32_t en, uint32_t ok)
{
	list_place(list);
	emit_op(list->as, op, layout_spot(list->as, m).packed);
	emit(list->as, en);
	emit(list->as, ok);
}

uint32_t list_fetch(struct list *list, const struct meaning *m, uint32_t en,
		    uint32_t *ok)
{
	uint32_t index = index_operand(list, m);
	uint32_t to = m->type == IEC_BOOL ? scratch_new(list->as) :
		layout_tail(list->as, RUN_VALUES, m->type);

	*ok = scratch_new(list->as);
	emit_head(list, VM_AGET, m, en, *ok);
	emit(list->as, CODE_OPERAND(m->type, to));
	emit_array(list, m, index);
	return CODE_OPERAND(m->type, to);
}

void list_deposit(struct list *list, const struct meaning *m, uint32_t en,
		  uint32_t from)
{
	struct spot spot = layout_spot(list->as, m);
	uint32_t index = index_operand(list, m), ok = scratch_new(list->as);

	/* To the end of the last one and no further: where a call is jumped over, what
	 * lies behind must not be stored on the way. In a text there are no bits. */
	if (!spot.packed && m->type != IEC_STRING)
		list_protect(list, spot.offset, (m->array.count - 1) * m->stride +
			     iec_type_row(m->type)->size);
	emit_head(list, VM_APUT, m, en, ok);
	emit(list->as, from);
	emit_array(list, m, index);
}
