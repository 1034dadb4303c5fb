/* SPDX-License-Identifier: MIT
 *
 * stores - the operands of each instruction that it writes.
 */
#include "engine/trial/stores.h"

struct visit {
	void (*take)(void *context, const struct store *store);
	void *context;
	uint32_t text;
};

static void take_bytes(const struct visit *visit, uint32_t where, uint64_t bytes)
{
	const struct store store = { .text = visit->text, .bit = 8 * (uint64_t)where,
				     .bits = 8 * bytes };

	visit->take(visit->context, &store);
}

static void take_typed(const struct visit *visit, uint32_t operand)
{
	const uint32_t type = CODE_TYPE(operand);

	if (type > IEC_NONE && type < IEC_TYPE_COUNT)
		take_bytes(visit, CODE_OFFSET(operand),
			   iec_type_row((enum iec_type)type)->size);
}

static void take_lut(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	for (; n; n--, at += 4) {
		const struct store store = {
			.text = visit->text, .bit = 8 * (uint64_t)(at[3] >> 8),
			.bits = 8, .table = at[3] & 0xff,
			.read = { at[0], at[1], at[2] },
		};

		visit->take(visit->context, &store);
	}
}

static void take_bit(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	const struct store store = { .text = visit->text, .bits = 1,
				     .bit = 8 * (uint64_t)at[1] + n, .read = { at[0] } };

	visit->take(visit->context, &store);
}

/* All elements that the indices at @dimension could lead to, each of @size; both in
 * units of @unit bits. */
static void take_elements(const struct visit *visit, uint64_t first, uint64_t size,
			  const uint32_t *dimension, uint32_t count, uint32_t unit)
{
	struct store store = { .text = visit->text, .bit = first * unit };

	for (uint32_t i = 0; i < count; i++, dimension += CODE_DIMENSION)
		if (dimension[2])
			size += (uint64_t)(dimension[2] - 1) * dimension[3];
	store.bits = size * unit;
	visit->take(visit->context, &store);
}

static void take_put(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	const bool bits = n & 1;
	const uint32_t type = CODE_TYPE(at[3]);

	take_bytes(visit, at[1], 1);
	take_elements(visit, CODE_OFFSET(at[3]),
		      bits || type >= IEC_TYPE_COUNT ? 1 :
		      iec_type_row((enum iec_type)type)->size,
		      at + 4, 1 + (n >> 1), bits ? 1 : 8);
}

static void take_block(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	take_bytes(visit, at[1], 1);
	if (n & 1)
		take_elements(visit, at[2], at[4], at + 5, 1 + (n >> 1), 8);
	else
		take_bytes(visit, at[2], at[4]);
}

static void visit_code(const struct visit *visit, const uint32_t *code)
{
	const uint32_t n = *code >> 8, *at = code + 1;

	switch ((enum vm_op)(*code & 0xff)) {
	case VM_LUT: take_lut(visit, at, n); return;
	case VM_BITGET: take_bytes(visit, at[1], 1); return;
	case VM_BITPUT: take_bit(visit, at, n); return;
	case VM_COPY: take_typed(visit, at[1]); return;
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT: take_bytes(visit, at[3], 1); return;
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
		take_bytes(visit, at[1], 1);
		take_typed(visit, CODE_OPERAND(code_type(*code & 0xff), at[2]));
		return;
	case VM_FN:
		take_bytes(visit, at[2], 1);
		take_typed(visit, at[3]);
		return;
	case VM_FB: take_bytes(visit, at[0], word_row((enum word)n)->size); return;
	case VM_BLOCK: take_bytes(visit, at[0], at[2]); return;
	case VM_AGET:
		take_bytes(visit, at[1], 1);
		take_typed(visit, at[2]);
		return;
	case VM_APUT: take_put(visit, at, n); return;
	case VM_ABLOCK: take_block(visit, at, n); return;
	case VM_EACH: take_bytes(visit, at[0], sizeof(uint32_t)); return;
	case VM_TICK:
		take_bytes(visit, at[1], sizeof(int64_t));
		take_bytes(visit, at[2], sizeof(int64_t));
		take_bytes(visit, at[4], n * sizeof(int64_t));
		return;
	case VM_CALL:
	case VM_STOP:
	case VM_JMP:
	case VM_JMPC:
	case VM_END:
	case VM_COUNT: return;
	}
}

void stores_each(const struct program *program,
		 void (*take)(void *context, const struct store *store), void *context)
{
	struct visit visit = { .take = take, .context = context };

	for (; visit.text < program->text_words;
	     visit.text += code_words(program->text + visit.text))
		visit_code(&visit, program->text + visit.text);
}
