/* SPDX-License-Identifier: MIT
 *
 * code_print - one instruction of a code image as text, for `ladder code`.
 *
 * Operands are shown as `b123` (BOOL at offset 123) or `INT@456`. Names are not looked
 * up.
 */
#include "engine/scan/code.h"

#include <stdio.h>

struct operand_text { char text[24]; };

static struct operand_text typed(uint32_t operand)
{
	struct operand_text out;
	uint32_t type = CODE_TYPE(operand);
	const char *word = type < IEC_TYPE_COUNT ?
		iec_type_row((enum iec_type)type)->word : "?";

	snprintf(out.text, sizeof(out.text), "%s@%u", word,
		 CODE_OFFSET(operand));
	return out;
}

static int print_fn(const uint32_t *at, uint32_t n, char *out, size_t size)
{
	char inputs[LIMIT_FN_ARGS * 26] = "";
	size_t used = 0;

	for (uint32_t i = 0; i < (n >> 8 & 0xff) && i < LIMIT_FN_ARGS; i++)
		used += (size_t)snprintf(inputs + used, sizeof(inputs) - used,
					 " %s", typed(at[4 + i] & ~CODE_OWN).text);
	return snprintf(out, size, "fn      %s.%s en b%u%s -> %s eno b%u",
			word_row((enum word)at[0])->word,
			iec_type_row((enum iec_type)(n & 0xff))->word, at[1],
			inputs, typed(at[3]).text, at[2]);
}

/* `REAL@4 > REAL@8 -> b9`; `… and b5 -> b9`; else the table, as for a LUT. */
static int print_cmp(const uint32_t *at, uint32_t type, uint32_t n, char *out,
		     size_t size)
{
	static const char *const rel[16] = {
		[0x2] = ">", [0xa] = ">=", [0x8] = "=", [0xc] = "<=", [0x4] = "<",
		[0x7] = "<>",
	};
	struct operand_text left = typed(CODE_OPERAND(type, 0) | at[0]);
	struct operand_text right = typed(CODE_OPERAND(type, 0) | at[1]);
	uint32_t low = n & 15, high = n >> 4 & 15;

	if (rel[high] && low == high)
		return snprintf(out, size, "cmp     %s %s %s -> b%u", left.text,
				rel[high], right.text, at[3]);
	if (rel[high] && low == 0)
		return snprintf(out, size, "cmp     %s %s %s and b%u -> b%u",
				left.text, rel[high], right.text, at[2], at[3]);
	return snprintf(out, size, "cmp     %02x %s %s b%u -> b%u", n,
			left.text, right.text, at[2], at[3]);
}

static int print_math(const uint32_t *at, uint32_t op, uint32_t n, char *out,
		      size_t size)
{
	static const char *const math[MATH_COUNT] = { "ADD", "SUB", "MUL", "DIV", "MOD" };
	uint32_t type = code_type(op);

	return snprintf(out, size, "%-7s %s%s en b%u %s %s -> %s eno b%u",
			vm_row((enum vm_op)op)->word, math[MATH_OF(n) % MATH_COUNT],
			n & MATH_LEFT ? " or left" : "", at[0],
			typed(CODE_OPERAND(type, at[3])).text,
			typed(CODE_OPERAND(type, at[4])).text,
			typed(CODE_OPERAND(type, at[2])).text, at[1]);
}

/* `[INT@8 - 1] of 10 by 2` for each index. */
static int print_dimensions(const uint32_t *at, uint32_t count, char *out, size_t size)
{
	int used = 0;

	for (uint32_t i = 0; i < count && (size_t)used < size; i++, at += CODE_DIMENSION)
		used += snprintf(out + used, size - (size_t)used,
				 "%s[%s - %d] of %u by %u", i ? " " : "",
				 typed(at[0]).text, (int)at[1], at[2], at[3]);
	return used;
}

/* AGET, APUT, ABLOCK. */
static int print_element(const uint32_t *code, char *out, size_t size)
{
	const uint32_t op = *code & 0xff, *at = code + 1;
	const bool block = op == VM_ABLOCK, keep = op == VM_AGET && *code >> 8 & CODE_KEEP;
	const uint32_t n = *code >> 8 & CODE_ACCESS;
	char array[LIMIT_INDICES * 64], other[40], element[64];

	print_dimensions(at + (block ? 5 : 4),
			 n >> 1 < LIMIT_INDICES ? 1 + (n >> 1) : 1, array, sizeof(array));
	if (block) {
		snprintf(other, sizeof(other), "@%u", n & 1 ? at[3] : at[2]);
		snprintf(element, sizeof(element), "%u @%u", at[4],
			 n & 1 ? at[2] : at[3]);
		return n & 1 ? snprintf(out, size, "ablock  en b%u %s -> %s%s ok b%u",
					at[0], other, element, array, at[1]) :
			       snprintf(out, size, "ablock  en b%u %s%s -> %s ok b%u",
					at[0], element, array, other, at[1]);
	}
	if (op == VM_AGET)
		return snprintf(out, size, "aget    en b%u %s%s%s -> %s%s ok b%u", at[0],
				n & 1 ? "bit " : "", typed(at[3]).text, array,
				typed(at[2]).text, keep ? " or keep" : "", at[1]);
	return snprintf(out, size, "aput    en b%u %s -> %s%s%s ok b%u", at[0],
			typed(at[2]).text, n & 1 ? "bit " : "", typed(at[3]).text,
			array, at[1]);
}

#ifndef RUNGBOARD_SMALL
static int print_pointer(const uint32_t *code, char *out, size_t size)
{
	const uint32_t *at = code + 1;

	if (*code >> 8)
		return snprintf(out, size, "%s    en b%u ok b%u b%u pointer %s + %u, %u bytes",
				vm_row((enum vm_op)(*code & 0xff))->word, at[0], at[1], at[2],
				typed(at[3]).text, at[4], at[5]);
	return snprintf(out, size, "%s    en b%u ok b%u %s pointer %s + %u + %s - %d",
			vm_row((enum vm_op)(*code & 0xff))->word, at[0], at[1], typed(at[2]).text,
			typed(at[3]).text, at[4], typed(at[5]).text, (int)at[6]);
}
#endif

/* `switch  INT@8 - 1 of 3: 20 31 31`; the number of bytes of all targets. */
static int print_switch(const uint32_t *code, char *out, size_t size)
{
	const uint32_t *at = code + 1, n = *code >> 8;
	int used = snprintf(out, size, "switch  %s - %d of %u:", typed(at[0]).text, (int)at[1], n);

	for (uint32_t i = 0; i < n; i++) {
		const bool fits = (size_t)used < size;

		used += snprintf(fits ? out + used : NULL, fits ? size - (size_t)used : 0, " %u", at[2 + i]);
	}
	return used;
}

int code_print(const uint32_t *code, uint32_t part, char *out, size_t size)
{
	uint32_t n = *code >> 8;
	const uint32_t *at = code + 1;

	switch ((enum vm_op)(*code & 0xff)) {
	case VM_LUT:
		at += 4 * part;
		return snprintf(out, size, "lut     %02x b%u b%u b%u -> b%u",
				at[3] & 0xff, at[0], at[1], at[2], at[3] >> 8);
	case VM_BITGET:
		return snprintf(out, size, "bitget  %u.%u -> b%u", at[0], n, at[1]);
	case VM_BITPUT:
		return snprintf(out, size, "bitput  b%u -> %u.%u", at[0], at[1], n);
	case VM_COPY:
		return snprintf(out, size, "copy    en b%u %s -> %s", at[0],
				typed(at[2]).text, typed(at[1]).text);
	case VM_CMP:
	case VM_CMP_REAL:
	case VM_CMP_DINT:
	case VM_CMP_INT:
		return print_cmp(at, code_type(*code & 0xff), n, out, size);
	case VM_REAL:
	case VM_DINT:
	case VM_INT:
		return print_math(at, *code & 0xff, n, out, size);
	case VM_FN:
		return print_fn(at, n, out, size);
	case VM_FB:
		return snprintf(out, size, "fb      %s @%u",
				word_row((enum word)n)->word, at[0]);
	case VM_BLOCK:
		return snprintf(out, size, "block   %u @%u -> @%u", at[2], at[1],
				at[0]);
	case VM_CALL:
		return snprintf(out, size, "call    program %u", at[0]);
	case VM_AGET:
	case VM_APUT:
	case VM_ABLOCK:
		return print_element(code, out, size);
	case VM_STOP:
		return snprintf(out, size, "stop    b%u", at[0]);
	case VM_JMP:
		return snprintf(out, size, "jmp     %u", at[0]);
	case VM_JMPC:
		return snprintf(out, size, "jmpc    %sb%u %u", n ? "not " : "", at[1],
				at[0]);
	case VM_EACH:
		return snprintf(out, size, "each    %u of b%u @%u", n, at[1], at[0]);
	case VM_SWITCH:
		return print_switch(code, out, size);
	case VM_TICK:
		return snprintf(out, size, "tick    hold b%u %u of b%u @%u dt @%u last @%u",
				at[0], n, at[3], at[4], at[2], at[1]);
	case VM_END:
		return snprintf(out, size, "end");
	case VM_POINT:
		return snprintf(out, size, "point   %u words", n);
	WITH_POINTERS(case VM_PEEK: case VM_POKE: return print_pointer(code, out, size);)
	case VM_COUNT:
		break;
	}
	return snprintf(out, size, "?");
}
