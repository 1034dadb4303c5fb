/* SPDX-License-Identifier: MIT
 *
 * fuse - bits as truth tables of up to three BOOLs, until they must be stored.
 *
 * Contacts, branches and inverters with three inputs become one instruction, and
 * consecutive instructions share one LUT word. It knows tables only, no patterns.
 */
#include "engine/translate/assembler.h"

void emit(struct assembler *as, uint32_t word)
{
	words_push(as, as->text, word);
}

void bits_end(struct assembler *as)
{
	as->open_lut = -1;
	as->open_cmp = -1;
	as->open_bit = -1;
	as->open_number = -1;
}

void emit_op(struct assembler *as, enum vm_op op, uint32_t n)
{
	bits_end(as);
	as->op_before = as->op_at;
	as->op_at = as->text->count;
	emit(as, (uint32_t)op | n << 8);
}

void emit_block(struct assembler *as, uint32_t to, uint32_t from, uint32_t size)
{
	if (to == from)
		return;
	emit_op(as, VM_BLOCK, 0);
	emit(as, to);
	emit(as, from);
	emit(as, size);
}

bool likely_is(const struct assembler *as, uint32_t en)
{
	for (int i = 0; i < 4; i++)
		if (as->likely[i] == en)
			return true;
	return en == CODE_TRUE_AT(as->areas);
}

void likely_note(struct assembler *as, uint32_t en, uint32_t made)
{
	const bool likely = likely_is(as, en);

	for (int i = 0; i < 4; i++)
		if (as->likely[i] == made)
			as->likely[i] = CODE_TRUE_AT(as->areas);
	if (likely)
		as->likely[as->likely_count++ % 4] = made;
}

uint32_t scratch_new(struct assembler *as)
{
	uint32_t *slot;

	if (as->scratch_used < as->slots->count)
		return as->slots->slot[as->scratch_used++];
	slot = arena_push(as->arena, &as->slots->slot, &as->slots->count,
			  sizeof(*slot));
	if (!slot) {
		as->failed = true;
		return CODE_FALSE_AT(as->areas);
	}
	as->scratch_used++;
	return *slot = layout_tail(as, RUN_VALUES, IEC_BOOL);
}

struct bits bits_constant(bool value)
{
	return (struct bits){ .table = value ? 0xff : 0x00 };
}

struct bits bits_leaf(const struct assembler *as, uint32_t offset)
{
	const struct areas *areas = as->areas;

	if (offset == CODE_TRUE_AT(areas) || offset == CODE_FALSE_AT(areas))
		return bits_constant(offset == CODE_TRUE_AT(areas));
	return (struct bits){ .count = 1, .table = 0xaa, .leaf = { offset } };
}

struct bits bits_not(struct bits a)
{
	a.table = (uint8_t)~a.table;
	return a;
}

bool bits_is_leaf(const struct bits *a)
{
	return a->count == 1 && a->table == 0xaa;
}

bool bits_reads(const struct bits *a, uint32_t offset, uint32_t size)
{
	for (int i = 0; i < a->count; i++)
		if (a->leaf[i] - offset < size)
			return true;
	return false;
}

/* Leaves of both; -1 when there are more than three. */
static int join(const struct bits *a, const struct bits *b, uint32_t leaf[3])
{
	int count = a->count;

	for (int i = 0; i < a->count; i++)
		leaf[i] = a->leaf[i];
	for (int i = 0; i < b->count; i++) {
		int k = 0;

		while (k < count && leaf[k] != b->leaf[i])
			k++;
		if (k < count)
			continue;
		if (count == 3)
			return -1;
		leaf[count++] = b->leaf[i];
	}
	return count;
}

/* The value of @a when the joined leaves have the bits of @index. */
static unsigned look_up(const struct bits *a, const uint32_t leaf[3], int count,
			unsigned index)
{
	unsigned own = 0;

	for (int i = 0; i < a->count; i++)
		for (int k = 0; k < count; k++)
			if (leaf[k] == a->leaf[i])
				own |= (index >> k & 1u) << i;
	return a->table >> own & 1u;
}

struct bits bits_combine(struct assembler *as, struct bits a, struct bits b,
			 uint8_t table2)
{
	struct bits out = { .count = 0 };
	int count;

	while ((count = join(&a, &b, out.leaf)) < 0) {
		if (a.count >= b.count)
			a = bits_keep(as, &a);
		else
			b = bits_keep(as, &b);
	}
	out.count = (uint8_t)count;
	for (unsigned index = 0; index < 8; index++) {
		unsigned left = look_up(&a, out.leaf, count, index);
		unsigned right = look_up(&b, out.leaf, count, index);

		out.table |= (uint8_t)((table2 >> (left + 2 * right) & 1u)
				       << index);
	}
	return out;
}

void bits_store(struct assembler *as, const struct bits *a, uint32_t offset)
{
	uint32_t none = CODE_FALSE_AT(as->areas);

	if (bits_is_leaf(a) && a->leaf[0] == offset)
		return;
	if (as->open_lut >= 0) {
		as->text->word[as->open_lut] += 1u << 8;
	} else {
		int at = as->text->count;

		emit_op(as, VM_LUT, 1);
		as->open_lut = at;
	}
	for (int i = 0; i < 3; i++)
		emit(as, i < a->count ? a->leaf[i] : none);
	emit(as, offset << 8 | a->table);
}

/* ---- comparisons ---- */

struct bits bits_compare(struct assembler *as, uint32_t table, uint32_t left,
			 uint32_t right)
{
	uint32_t type = CODE_TYPE(left), slot = scratch_new(as);
	enum vm_op op = type != CODE_TYPE(right) ? VM_CMP :
			type == IEC_REAL ? VM_CMP_REAL :
			type == IEC_DINT ? VM_CMP_DINT :
			type == IEC_INT ? VM_CMP_INT : VM_CMP;
	int at = as->text->count;

	emit_op(as, op, table << 4 | table);
	emit(as, op == VM_CMP ? left : CODE_OFFSET(left));
	emit(as, op == VM_CMP ? right : CODE_OFFSET(right));
	emit(as, CODE_FALSE_AT(as->areas));
	emit(as, slot);
	as->open_cmp = at;
	as->open_bit = at + 4;
	return bits_leaf(as, slot);
}

uint32_t bits_made(const struct assembler *as)
{
	return as->open_bit < 0 ? 0 : as->text->word[as->open_bit];
}

/* @a: the comparison, and at most one other bit. */
static bool store_compared(struct assembler *as, const struct bits *a, uint32_t offset)
{
	uint32_t slot = bits_made(as), *code, table = 0;
	int own = 0;

	while (own < a->count && a->leaf[own] != slot)
		own++;
	if (own == a->count || a->count > 2)
		return false;
	code = &as->text->word[as->open_cmp];
	for (uint32_t i = 0; i < 8; i++) {
		uint32_t index = (*code >> (8 + (i & 3)) & 1) << own | i >> 2 << !own;

		table |= (a->table >> index & 1u) << i;
	}
	if (a->count == 2)
		code[3] = a->leaf[!own];
	code[4] = offset;
	*code = (*code & 0xff) | table << 8;
	return true;
}

bool bits_store_made(struct assembler *as, const struct bits *a, uint32_t offset)
{
	if (as->open_cmp >= 0) {
		if (!store_compared(as, a, offset))
			return false;
	} else if (bits_is_leaf(a) && a->leaf[0] == bits_made(as)) {
		as->text->word[as->open_bit] = offset;
	} else {
		return false;
	}
	bits_end(as);
	return true;
}

struct bits bits_keep(struct assembler *as, const struct bits *a)
{
	uint32_t slot;

	if (bits_is_leaf(a))
		return *a;
	slot = scratch_new(as);
	bits_store(as, a, slot);
	return bits_leaf(as, slot);
}
