/* SPDX-License-Identifier: MIT
 *
 * code_access - the memory that the instructions of a program read and write.
 */
#include "engine/scan/code_access.h"

struct visit {
	void (*take)(void *context, const struct code_access *access);
	void *context;
};

static void give(const struct visit *visit, uint64_t bit, uint64_t bits, uint32_t unit,
		 bool write)
{
	const struct code_access access = { bit, bits, unit, write };

	visit->take(visit->context, &access);
}

static void give_bytes(const struct visit *visit, uint32_t where, uint64_t bytes,
		       bool write)
{
	give(visit, 8 * (uint64_t)where, 8 * bytes, 8 * (uint32_t)bytes, write);
}

static uint32_t size_of(uint32_t type)
{
	return type > IEC_NONE && type < IEC_TYPE_COUNT ?
	       iec_type_row((enum iec_type)type)->size : 0;
}

static void give_typed(const struct visit *visit, uint32_t operand, bool write)
{
	const uint32_t size = size_of(CODE_TYPE(operand));

	if (size)
		give_bytes(visit, CODE_OFFSET(operand), size, write);
}

static void give_bool(const struct visit *visit, uint32_t where, bool write)
{
	give_bytes(visit, where, 1, write);
}

/* EN and ENO. */
static void give_gate(const struct visit *visit, uint32_t en, uint32_t eno)
{
	give_bool(visit, en, false);
	give_bool(visit, eno, true);
}

static void visit_lut(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	for (; n; n--, at += 4) {
		for (int i = 0; i < 3; i++)
			give_bool(visit, at[i], false);
		give_bool(visit, at[3] >> 8, true);
	}
}

static void visit_math(const struct visit *visit, const uint32_t *at, uint32_t op)
{
	const uint32_t type = code_type(op);

	give_gate(visit, at[0], at[1]);
	give_typed(visit, CODE_OPERAND(type, at[3]), false);
	give_typed(visit, CODE_OPERAND(type, at[4]), false);
	give_typed(visit, CODE_OPERAND(type, at[2]), true);
}

/* The values have their type in front, or share that of @op. */
static void visit_compare(const struct visit *visit, const uint32_t *at, uint32_t op)
{
	const uint32_t type = op == VM_CMP ? 0 : CODE_OPERAND(code_type(op), 0);

	give_typed(visit, type | at[0], false);
	give_typed(visit, type | at[1], false);
	give_gate(visit, at[2], at[3]);
}

static void visit_fn(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	for (uint32_t i = 0; i < (n >> 8 & 0xff); i++)
		give_typed(visit, at[4 + i] & ~CODE_OWN, false);
	give_gate(visit, at[1], at[2]);
	give_typed(visit, at[3], true);
}

/* All elements that the indices at @dimension can select, each of @size; in units of
 * @unit bits. */
static void visit_elements(const struct visit *visit, uint64_t first, uint32_t size,
			   const uint32_t *dimension, uint32_t count, uint32_t unit,
			   bool write)
{
	uint64_t all = size;

	for (uint32_t i = 0; i < count; i++, dimension += CODE_DIMENSION) {
		give_typed(visit, dimension[0], false);
		if (dimension[2])
			all += (uint64_t)(dimension[2] - 1) * dimension[3];
	}
	give(visit, first * unit, all * unit, size * unit, write);
}

static void visit_element(const struct visit *visit, const uint32_t *at, uint32_t n,
			  bool put)
{
	const bool bits = n & 1;

	give_gate(visit, at[0], at[1]);
	give_typed(visit, at[2], !put);
	visit_elements(visit, CODE_OFFSET(at[3]), bits ? 1 : size_of(CODE_TYPE(at[3])),
		       at + 4, 1 + (n >> 1), bits ? 1 : 8, put);
}

static void visit_block(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	const bool to = n & 1; /* the element is the destination */

	give_gate(visit, at[0], at[1]);
	give_bytes(visit, to ? at[3] : at[2], at[4], !to);
	visit_elements(visit, to ? at[2] : at[3], at[4], at + 5, 1 + (n >> 1), 8, to);
}

static void visit_tick(const struct visit *visit, const uint32_t *at, uint32_t n)
{
	give_bool(visit, at[0], false);
	give_bytes(visit, at[3], n, false);
	give_bytes(visit, at[1], sizeof(int64_t), true);
	give_bytes(visit, at[2], sizeof(int64_t), true);
	give_bytes(visit, at[4], n * sizeof(int64_t), true);
}

#ifndef RUNGBOARD_SMALL
/* Without the place that it leads to: code_has_pointers(). */
static void visit_pointer(const struct visit *visit, const uint32_t *at, bool poke, bool all)
{
	give_gate(visit, at[0], at[1]);
	give_bytes(visit, CODE_OFFSET(at[3]), sizeof(uint64_t), false);
	if (all) {
		give_bytes(visit, at[2], at[5], !poke);
		return;
	}
	give_typed(visit, at[5], false);
	give_typed(visit, at[2], !poke);
}
#endif

static void visit_code(const struct visit *visit, const uint32_t *code)
{
	const uint32_t op = *code & 0xff, n = *code >> 8, *at = code + 1;

	switch ((enum vm_op)op) {
	case VM_LUT: visit_lut(visit, at, n); return;
	case VM_BITGET:
		give(visit, 8 * (uint64_t)at[0] + n, 1, 1, false);
		give_bool(visit, at[1], true);
		return;
	case VM_BITPUT:
		give_bool(visit, at[0], false);
		give(visit, 8 * (uint64_t)at[1] + n, 1, 1, true);
		return;
	case VM_COPY:
		give_bool(visit, at[0], false);
		give_typed(visit, at[2], false);
		give_typed(visit, at[1], true);
		return;
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT: visit_compare(visit, at, op); return;
	case VM_REAL:
	case VM_DINT:
	case VM_INT: visit_math(visit, at, op); return;
	case VM_FN: visit_fn(visit, at, n); return;
	case VM_FB:
		give_bytes(visit, at[0], word_row((enum word)n)->size, false);
		give_bytes(visit, at[0], word_row((enum word)n)->size, true);
		return;
	case VM_BLOCK:
		give_bytes(visit, at[1], at[2], false);
		give_bytes(visit, at[0], at[2], true);
		return;
	case VM_AGET:
	case VM_APUT: visit_element(visit, at, n & CODE_ACCESS, op == VM_APUT); return;
	case VM_ABLOCK: visit_block(visit, at, n); return;
	case VM_EACH:
		give_bytes(visit, at[1], n, false);
		give_bytes(visit, at[0], sizeof(uint32_t), true);
		return;
	case VM_TICK: visit_tick(visit, at, n); return;
	case VM_SWITCH: give_typed(visit, at[0], false); return;
	case VM_STOP: give_bool(visit, at[0], false); return;
	case VM_JMPC: give_bool(visit, at[1], false); return;
	WITH_POINTERS(case VM_PEEK: case VM_POKE: visit_pointer(visit, at, op == VM_POKE, n); return;)
	case VM_CALL:
	case VM_JMP:
	case VM_END:
	case VM_POINT:
	case VM_COUNT: return;
	}
}

#ifndef RUNGBOARD_SMALL
bool code_has_pointers(const struct program *program)
{
	const uint32_t *end = program->text + program->text_words;

	for (const uint32_t *code = program->text; code < end; code += code_words(code))
		if ((*code & 0xff) == VM_PEEK || (*code & 0xff) == VM_POKE)
			return true;
	return false;
}
#endif

void code_each_access(const struct program *program,
		      void (*take)(void *context, const struct code_access *access),
		      void *context)
{
	const struct visit visit = { take, context };
	const uint32_t *end = program->text + program->text_words;

	for (const uint32_t *code = program->text; code < end; code += code_words(code))
		visit_code(&visit, code);
}

#ifndef RUNGBOARD_SMALL
void code_access(const uint32_t *code,
		 void (*take)(void *context, const struct code_access *access),
		 void *context)
{
	const struct visit visit = { take, context };

	visit_code(&visit, code);
}
#endif
