/* SPDX-License-Identifier: MIT
 *
 * function - the instruction for one function on operands in memory.
 *
 * FN runs any function. Operations on two numbers of one type and a plain MOVE have faster
 * instructions of their own with the same results. The caller has chosen the operand types.
 */
#include "engine/translate/lists.h"

/* ---- comparisons ---- */

/* The comparison of a table of (>=, <=). The rows stand in this order. */
uint32_t list_table(enum word word)
{
	static const uint8_t table[] = {
		[FN_GT - FN_GT] = 0x2, [FN_GE - FN_GT] = 0xa, [FN_EQ - FN_GT] = 0x8,
		[FN_LE - FN_GT] = 0xc, [FN_LT - FN_GT] = 0x4, [FN_NE - FN_GT] = 0x7,
	};

	return table[word - FN_GT];
}

bool list_is_compare(enum word word)
{
	return word >= FN_GT && word <= FN_NE;
}

void list_compare(struct list *list, enum word word, uint32_t left, uint32_t right)
{
	list->now = (struct il_result){
		.kind = RESULT_BITS,
		.bits = bits_compare(list->as, list_table(word), left, right),
	};
}

/* ---- short forms ---- */

/* The instruction that computes with two values of @type; VM_FN: there is none. */
static enum vm_op op_of(enum iec_type type)
{
	return type == IEC_REAL ? VM_REAL : type == IEC_DINT ? VM_DINT :
	       type == IEC_INT ? VM_INT : VM_FN;
}

static bool math_of(uint32_t fn, uint32_t *math)
{
	static const uint32_t fns[MATH_COUNT] = { FN_ADD, FN_SUB, FN_MUL, FN_DIV, FN_MOD };

	for (*math = 0; *math < MATH_COUNT; ++*math)
		if (fns[*math] == fn)
			return true;
	return false;
}

/* Has it an instruction of its own? */
static bool is_math(const struct fn_code *fn, uint32_t *math)
{
	return op_of(fn->type) != VM_FN && fn->count == 2 &&
	       CODE_TYPE(fn->to) == (uint32_t)fn->type &&
	       CODE_TYPE(fn->input[0]) == (uint32_t)fn->type &&
	       CODE_TYPE(fn->input[1]) == (uint32_t)fn->type &&
	       math_of(fn->fn, math);
}

static bool has_always_result(uint32_t fn, enum iec_type type)
{
	return (fn == FN_ADD || fn == FN_SUB || fn == FN_MUL) &&
	       iec_type_row(type)->class & ANY_INT;
}

bool list_stores_left(const struct fn_code *fn)
{
	uint32_t math;

	return has_always_result(fn->fn, fn->result) || is_math(fn, &math);
}

/* Marks the REAL before, whose ENO is the EN of @fn. */
static void mark_row(struct assembler *as, const struct fn_code *fn, enum vm_op op)
{
	uint32_t *before;

	if (op != VM_REAL || as->text->count < 6 || as->op_at != as->text->count - 6)
		return;
	before = &as->text->word[as->op_at];
	if ((*before & 0xff) == VM_REAL && *before >> 8 & MATH_ENABLED && before[2] == fn->en)
		*before |= MATH_ROW << 8;
}

/* ---- all ---- */

void list_emit_fn(struct list *list, const struct fn_code *fn)
{
	struct assembler *as = list->as;
	uint32_t math;
	bool is_short = is_math(fn, &math);

	list_place(list);
	if (is_short) {
		mark_row(as, fn, op_of(fn->type));
		emit_op(as, op_of(fn->type), math |
			(fn->en != CODE_TRUE_AT(as->areas) ?
			 MATH_ENABLED | (likely_is(as, fn->en) ? MATH_LIKELY : 0) :
			 fn->left && !has_always_result(fn->fn, fn->type) ? MATH_LEFT : 0));
	} else {
		emit_op(as, VM_FN, (uint32_t)fn->type | fn->count << 8 |
			(uint32_t)fn->result << 16);
		emit(as, fn->fn);
	}
	emit(as, fn->en);
	emit(as, fn->eno);
	emit(as, is_short ? CODE_OFFSET(fn->to) : fn->to);
	for (uint32_t i = 0; i < fn->count; i++)
		emit(as, is_short ? CODE_OFFSET(fn->input[i]) : fn->input[i]);
	likely_note(as, fn->en, fn->eno);
}

void list_copy_if(struct list *list, uint32_t en, uint32_t to, uint32_t from)
{
	enum iec_type type = (enum iec_type)CODE_TYPE(to);
	bool plain = type == CODE_TYPE(from) && type != IEC_STRING;

	emit_op(list->as, VM_COPY, plain ? iec_type_row(type)->size : 0);
	emit(list->as, en);
	emit(list->as, to);
	emit(list->as, from);
}
