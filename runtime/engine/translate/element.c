/* SPDX-License-Identifier: MIT
 *
 * element - AGET, APUT and ABLOCK: elements of arrays whose index is computed in the scan.
 *
 * A value, structure or array is copied to a place of its own, so that no other instruction
 * needs such indices. Elements with a fixed index are ordinary variables.
 */
#include "engine/translate/lists.h"

/* Operands of the indices. They are computed before the instruction, because a bit of an area
 * may have to be fetched. */
static struct indices indices_of(struct list *list, const struct meaning *m)
{
	struct indices out = { .pointer = 0 };

	for (int i = 0; i < m->opens; i++) {
		const struct meaning *of = m->open[i].of;
		const struct shift *shift = list_shift(list, of);

		out.low[i] = (uint32_t)m->open[i].array.low - (shift ? (uint32_t)shift->by : 0);
		of = shift ? shift->of : of;
		out.operand[i] = list_number(list, of, of->type);
	}
	return out;
}

/* @dims: number of indices. */
static void emit_head(struct list *list, enum vm_op op, uint32_t n, uint32_t dims, uint32_t en,
		      uint32_t ok)
{
	list_place(list);
	emit_op(list->as, op, n | (dims - 1) << 1);
	emit(list->as, en);
	emit(list->as, ok);
	likely_note(list->as, en, ok);
}

static void emit_indices(struct list *list, const struct meaning *m,
			 const struct indices *indices, bool packed)
{
	for (int i = 0; i < m->opens; i++) {
		emit(list->as, indices->operand[i]);
		emit(list->as, indices->low[i]);
		emit(list->as, m->open[i].array.count);
		emit(list->as, !packed ? m->open[i].stride : m->var && m->var->type == IEC_NONE ?
			       8 * m->open[i].stride : 1);
	}
}

/* The value of a subrange is an index without effect on the place: another value is refused as
 * another element is. */
static void emit_range(struct list *list, const struct var_range *range, uint32_t value)
{
	emit(list->as, value);
	emit(list->as, (uint32_t)range->low);
	emit(list->as, (uint32_t)(range->high - range->low + 1));
	emit(list->as, 0);
}

/* What the VM may know of an access with one index; types of the values, and of the index. */
static uint32_t shortness(uint32_t value, uint32_t base, uint32_t index)
{
	const uint32_t size = iec_type_row((enum iec_type)base)->size;
	const bool wide = index == IEC_DINT;

	if (value != base || base == IEC_STRING || (size != 2 && size != 4) || (!wide && index != IEC_INT))
		return 0;
	return CODE_SHORT | (size == 4 ? CODE_LONG : 0) | (wide ? CODE_WIDE : 0);
}

/* ---- behind a pointer ---- */

#define THROUGH_WORDS 8 /* of a PEEK or POKE */

/* Does the scan compute the place of the element itself? Else it is added to the pointer. */
static bool is_plain_index(const struct meaning *m)
{
	return m->opens == 0 || (m->opens == 1 && m->open[0].array.count == LIMIT_ELEMENTS &&
				 !meaning_is_whole(m) && m->type != IEC_STRING);
}

/* Stores @from at @to, if it is a value of @range. Returns the BOOL that tells. */
static uint32_t keep_in(struct list *list, const struct var_range *range, uint32_t en, uint32_t to,
			uint32_t from)
{
	const uint32_t ok = scratch_new(list->as);

	list_protect(list, CODE_OFFSET(to), iec_type_row((enum iec_type)CODE_TYPE(to))->size);
	emit_head(list, VM_APUT, shortness(CODE_TYPE(from), CODE_TYPE(to), CODE_TYPE(from)), 1, en, ok);
	emit(list->as, from);
	emit(list->as, to);
	emit_range(list, range, from);
	return ok;
}

/* @pointer, moved to the element of @m; @en becomes FALSE if there is none. */
static uint32_t moved(struct list *list, const struct meaning *m, uint32_t pointer, uint32_t *en)
{
	uint32_t sum = list_convert(list, CODE_OPERAND(IEC_LWORD, pointer), IEC_LINT);

	for (int i = 0; i < m->opens; i++) {
		const struct open_index *open = &m->open[i];
		const uint32_t index = list_number(list, open->of, open->of->type);
		const enum iec_type type = (enum iec_type)CODE_TYPE(index);
		const struct var_range range = { open->array.low,
						 (int64_t)open->array.low + open->array.count - 1 };
		uint32_t at = CODE_OPERAND(type, layout_tail(list->as, RUN_VALUES, type));

		*en = keep_in(list, &range, *en, at, index);
		at = list_run(list, FN_SUB, IEC_LINT, list_convert(list, at, IEC_LINT),
			      list_constant(list, IEC_LINT, (uint64_t)(int64_t)open->array.low));
		at = list_run(list, FN_MUL, IEC_LINT, at, list_constant(list, IEC_LINT, open->stride));
		sum = list_run(list, FN_ADD, IEC_LINT, sum, at);
	}
	return CODE_OFFSET(list_convert(list, sum, IEC_LWORD));
}

/* The place of the pointer that leads to @m, which another one may lead to; @en becomes FALSE if none
 * does. Depth: the ^ of one path. */
static uint32_t pointer_of(struct list *list, const struct meaning *m, uint32_t *en)
{
	const struct meaning *by = meaning_pointer(m);
	const uint32_t pointer = meaning_is_indexed(by) ? CODE_OFFSET(list_fetch(list, by, *en, en)) :
							  layout_spot(list->as, by).offset;

	return is_plain_index(m) ? pointer : moved(list, m, pointer, en);
}

/* ---- a value ---- */

/* PEEK and POKE. */
static void emit_through(struct list *list, enum vm_op op, const struct meaning *m,
			 const uint32_t operand[3])
{
	uint32_t en = operand[0];
	const uint32_t pointer = pointer_of(list, m, &en);
	const bool index = m->opens && is_plain_index(m);
	const uint32_t at = index ? list_number(list, m->open[0].of, m->open[0].of->type) :
				    CODE_OPERAND(IEC_BOOL, CODE_FALSE_AT(list->as->areas));

	list_protect(list, 0, UINT32_MAX / 2);
	emit_head(list, op, 0, 1, en, operand[1]);
	emit(list->as, operand[2]);
	emit(list->as, CODE_OPERAND(m->type, pointer));
	emit(list->as, m->offset);
	emit(list->as, at);
	emit(list->as, index ? (uint32_t)m->open[0].array.low : 0);
}

/* @flags: CODE_KEEP or 0. */
static void emit_value(struct list *list, enum vm_op op, uint32_t flags, const struct meaning *m,
		       const uint32_t operand[3])
{
	struct spot spot = layout_spot(list->as, m);
	struct indices indices;
	uint32_t base = spot.packed ? spot.offset * 8 + spot.bit : spot.offset;
	const bool ranged = op == VM_APUT && meaning_is_ranged(m);

	if (m->through) {
		emit_through(list, op == VM_APUT ? VM_POKE : VM_PEEK, m, operand);
		return;
	}
	indices = indices_of(list, m);
	if (!spot.packed && m->opens + ranged == 1)
		flags |= shortness(CODE_TYPE(operand[2]), m->type,
				   CODE_TYPE(m->opens ? indices.operand[0] : operand[2]));
	emit_head(list, op, flags | spot.packed, m->opens + ranged, operand[0], operand[1]);
	emit(list->as, operand[2]);
	emit(list->as, CODE_OPERAND(m->type, base));
	emit_indices(list, m, &indices, spot.packed);
	if (ranged)
		emit_range(list, m->like->range, operand[2]);
}

/* ---- a whole ---- */

/* ABLOCK: @put: from @at into the element; else out of it. */
static void emit_copy(struct list *list, const struct meaning *m, const struct indices *indices,
		      bool put, const uint32_t operand[3])
{
	uint32_t base = layout_spot(list->as, m).offset;

	emit_head(list, VM_ABLOCK, put, m->opens, operand[0], operand[1]);
	emit(list->as, put ? base : operand[2]);
	emit(list->as, put ? operand[2] : base);
	emit(list->as, scope_size(list->as->translation->scope, m));
	emit_indices(list, m, indices, false);
}

/* PEEK or POKE of a structure, an instance or an array. */
static void emit_whole_through(struct list *list, const struct meaning *m, uint32_t pointer, bool put,
			       const uint32_t operand[3])
{
	list_protect(list, 0, UINT32_MAX / 2);
	list_place(list);
	emit_op(list->as, put ? VM_POKE : VM_PEEK, 1);
	emit(list->as, operand[0]);
	emit(list->as, operand[1]);
	emit(list->as, operand[2]);
	emit(list->as, pointer);
	emit(list->as, m->offset);
	emit(list->as, scope_size(list->as->translation->scope, m));
	emit(list->as, 0);
}

static void emit_whole(struct list *list, const struct meaning *m, bool put,
		       const uint32_t operand[3])
{
	uint32_t en = operand[0], pointer;

	if (m->through) {
		pointer = pointer_of(list, m, &en);
		emit_whole_through(list, m, pointer, put, (uint32_t[]){ en, operand[1], operand[2] });
		return;
	}
	struct indices indices = indices_of(list, m);

	emit_copy(list, m, &indices, put, operand);
}

uint32_t list_fetch_whole(struct list *list, const struct meaning *m, uint32_t en,
			  uint32_t to)
{
	uint32_t ok = scratch_new(list->as);

	list_protect(list, to, scope_size(list->as->translation->scope, m));
	emit_whole(list, m, false, (uint32_t[]){ en, ok, to });
	return ok;
}

uint32_t list_fetch(struct list *list, const struct meaning *m, uint32_t en,
		    uint32_t *ok)
{
	uint32_t to;
	int at;

	if (m->part)
		return list_fetch_part(list, m, en, ok);
	if (meaning_is_whole(m)) {
		to = layout_like(list->as, m);
		*ok = list_fetch_whole(list, m, en, to);
		return CODE_OPERAND(IEC_NONE, to);
	}
	to = m->type == IEC_BOOL ? scratch_new(list->as) :
	     layout_tail(list->as, RUN_VALUES, m->type);
	*ok = scratch_new(list->as);
	at = list->as->text->count;
	emit_value(list, VM_AGET, 0, m,
		   (uint32_t[]){ en, *ok, CODE_OPERAND(m->type, to) });
	list->as->open_number = (m->through ? list->as->text->count - THROUGH_WORDS : at) + 3;
	return CODE_OPERAND(m->type, to);
}

uint32_t list_fetch_to(struct list *list, const struct meaning *m, uint32_t en, uint32_t to)
{
	uint32_t ok, from;

	if (m->part) {
		from = list_fetch_part(list, m, en, &ok);
		list_copy_if(list, ok, to, from);
		return ok;
	}
	ok = scratch_new(list->as);
	list_protect(list, CODE_OFFSET(to), 1);
	emit_value(list, VM_AGET, CODE_KEEP, m, (uint32_t[]){ en, ok, to });
	return ok;
}

/* @from as a value of @type, in a place of its own. */
static uint32_t widened(struct list *list, uint32_t en, uint32_t from, enum iec_type type)
{
	const uint32_t to = CODE_OPERAND(type, layout_tail(list->as, RUN_VALUES, type));

	list_place(list);
	emit_op(list->as, VM_COPY, 0);
	emit(list->as, en);
	emit(list->as, to);
	emit(list->as, from);
	return to;
}

uint32_t list_deposit(struct list *list, const struct meaning *m, uint32_t en,
		      uint32_t from)
{
	struct spot spot;
	uint32_t ok;

	if (m->part)
		return list_deposit_part(list, m, en, from);
	spot = layout_spot(list->as, m);
	ok = scratch_new(list->as);
	if (m->through && !meaning_is_whole(m) && (enum iec_type)CODE_TYPE(from) != m->type)
		from = widened(list, en, from, m->type);

	/* Ends with the last element: a jump over a call must not skip storing what lies after
	 * it. Texts have no bits. */
	if (!spot.packed && m->type != IEC_STRING)
		list_protect(list, spot.offset,
			     scope_span(list->as->translation->scope, m));
	if (meaning_is_whole(m))
		emit_whole(list, m, true,
			   (uint32_t[]){ en, ok, CODE_OFFSET(from) });
	else
		emit_value(list, VM_APUT, 0, m, (uint32_t[]){ en, ok, from });
	return ok;
}

void list_keep_range(struct list *list, const struct var_range *range, uint32_t to,
		     uint32_t from)
{
	keep_in(list, range, CODE_TRUE_AT(list->as->areas), to, from);
}

/* ---- an instance that is called ---- */

/* The pointer is kept, because the body may change it. */
static uint32_t borrow_through(struct list *list, const struct meaning *m, uint32_t to, struct indices *out)
{
	const uint32_t ok = scratch_new(list->as);
	uint32_t en = CODE_TRUE_AT(list->as->areas);

	*out = (struct indices){ .pointer = layout_tail(list->as, RUN_VALUES, IEC_LWORD) };
	list_copy(list, CODE_OPERAND(IEC_LWORD, out->pointer),
		  CODE_OPERAND(IEC_LWORD, pointer_of(list, m, &en)));
	emit_whole_through(list, m, out->pointer, false, (uint32_t[]){ en, ok, to });
	return ok;
}

uint32_t list_borrow(struct list *list, const struct meaning *m, uint32_t to, struct indices *out)
{
	if (m->through)
		return borrow_through(list, m, to, out);
	const uint32_t ok = scratch_new(list->as);

	*out = indices_of(list, m);
	for (int i = 0; i < m->opens; i++) {
		const enum iec_type type = (enum iec_type)CODE_TYPE(out->operand[i]);
		const uint32_t kept = CODE_OPERAND(type, layout_tail(list->as, RUN_VALUES, type));

		list_copy(list, kept, out->operand[i]);
		out->operand[i] = kept;
	}
	list_protect(list, to, scope_size(list->as->translation->scope, m));
	emit_copy(list, m, out, false, (uint32_t[]){ CODE_TRUE_AT(list->as->areas), ok, to });
	return ok;
}

void list_give_back(struct list *list, const struct meaning *m, uint32_t from,
		    const struct indices *indices)
{
	const uint32_t always = CODE_TRUE_AT(list->as->areas), sink = list_sink(list->as, IEC_BOOL);

	if (m->through) {
		emit_whole_through(list, m, indices->pointer, true, (uint32_t[]){ always, sink, from });
		return;
	}
	list_protect(list, layout_spot(list->as, m).offset,
		     scope_span(list->as->translation->scope, m));
	emit_copy(list, m, indices, true, (uint32_t[]){ always, sink, from });
}

void list_keep_power(struct list *list, const struct meaning *m, const struct indices *indices,
		     const struct element_power *power)
{
	emit_head(list, VM_ABLOCK, 1, m->opens, CODE_TRUE_AT(list->as->areas),
		  list_sink(list->as, IEC_BOOL));
	emit(list->as, power->to + m->offset / power->unit * power->size);
	emit(list->as, power->from);
	emit(list->as, power->size);
	for (int i = 0; i < m->opens; i++) {
		emit(list->as, indices->operand[i]);
		emit(list->as, indices->low[i]);
		emit(list->as, m->open[i].array.count);
		emit(list->as, m->open[i].stride / power->unit * power->size);
	}
}
