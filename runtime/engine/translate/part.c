/* SPDX-License-Identifier: MIT
 *
 * part - a bit, byte or word of a number: Word.3, Table[i].%B1.
 *
 * Such a part has no place of its own. It is read out of the number, and stored by giving the
 * number another value. Parts of an address with a fixed place are addresses: scope_find().
 */
#include "engine/translate/lists.h"

#include "engine/model/words.h"

static enum iec_type bits_type(uint32_t size)
{
	return size == 1 ? IEC_BYTE : size == 2 ? IEC_WORD : size == 4 ? IEC_DWORD : IEC_LWORD;
}

static uint32_t size_of(enum iec_type type)
{
	return iec_type_row(type)->size;
}

/* Bits below @count. */
static uint64_t low_bits(uint32_t count)
{
	return count < 64 ? (UINT64_C(1) << count) - 1 : UINT64_MAX;
}

uint32_t list_constant(struct list *list, enum iec_type type, uint64_t bits)
{
	const union iec_value value = { .i = (int64_t)(bits & low_bits(8 * size_of(type))) };

	return CODE_OPERAND(type, layout_constant(list->as, type, value));
}

uint32_t list_run(struct list *list, enum word fn, enum iec_type result, uint32_t left, uint32_t right)
{
	const struct fn_code code = {
		.fn = (uint32_t)fn, .type = (enum iec_type)CODE_TYPE(left), .result = result,
		.en = CODE_TRUE_AT(list->as->areas), .eno = list_sink(list->as, IEC_BOOL),
		.to = CODE_OPERAND(result, layout_tail(list->as, RUN_VALUES, result)),
		.count = right ? 2 : 1, .input = { left, right },
	};

	list_emit_fn(list, &code);
	return code.to;
}

uint32_t list_convert(struct list *list, uint32_t from, enum iec_type type)
{
	return CODE_TYPE(from) == (uint32_t)type ? from : list_run(list, FN_CONVERT, type, from, 0);
}

static uint32_t shift(struct list *list, enum word fn, uint32_t from, uint32_t bits)
{
	return bits ? list_run(list, fn, (enum iec_type)CODE_TYPE(from), from,
			  CODE_OWN | list_constant(list, IEC_INT, bits)) : from;
}

/* The number of which @m is a part. */
static uint32_t number_of(struct list *list, const struct meaning *m, uint32_t en, uint32_t *ok)
{
	*ok = en;
	return meaning_is_indexed(m->number) ? list_fetch(list, m->number, en, ok) :
					       list_number(list, m->number, m->number->type);
}

uint32_t list_fetch_part(struct list *list, const struct meaning *m, uint32_t en, uint32_t *ok)
{
	const enum iec_type all = bits_type(size_of(m->number->type));
	const uint32_t from = list_convert(list, number_of(list, m, en, ok), all);
	struct bits bits;

	if (m->type != IEC_BOOL)
		return list_convert(list, shift(list, FN_SHR, from, m->first), m->type);
	bits = bits_compare(list->as, list_table(FN_NE), list_run(list, op_function(OP_AND), all, from,
			    list_constant(list, all, UINT64_C(1) << m->first)), list_constant(list, all, 0));
	return CODE_OPERAND(IEC_BOOL, list_keep(list, &bits));
}

uint32_t list_deposit_part(struct list *list, const struct meaning *m, uint32_t en, uint32_t from)
{
	const struct meaning *number = m->number;
	const enum iec_type all = bits_type(size_of(number->type));
	const uint32_t width = m->type == IEC_BOOL ? 1 : 8 * size_of(m->type);
	const uint32_t part = shift(list, FN_SHL, list_convert(list, from, all), m->first);
	uint32_t ok, rest = list_convert(list, number_of(list, m, en, &ok), all), to;

	rest = list_run(list, op_function(OP_AND), all, rest, list_constant(list, all, ~(low_bits(width) << m->first)));
	to = list_convert(list, list_run(list, op_function(OP_OR), all, rest, part), number->type);
	if (meaning_is_checked(number))
		return list_deposit(list, number, ok, to);
	list_copy_if(list, en, list_number(list, number, number->type), to);
	return en;
}
