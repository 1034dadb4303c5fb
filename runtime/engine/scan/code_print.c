/* SPDX-License-Identifier: MIT
 *
 * code_print - one instruction of a code image as text, for `ladder code`.
 *
 * Operands are shown as `b123` (BOOL at offset 123) or `INT@456`. It looks up no
 * names and judges nothing.
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
	char inputs[LIMIT_FN_INPUTS * 26] = "";
	size_t used = 0;

	for (uint32_t i = 0; i < (n >> 8 & 0xff) && i < LIMIT_FN_INPUTS; i++)
		used += (size_t)snprintf(inputs + used, sizeof(inputs) - used,
					 " %s", typed(at[4 + i] & ~CODE_OWN).text);
	return snprintf(out, size, "fn      %s.%s en b%u%s -> %s eno b%u",
			word_row((enum word)at[0])->word,
			iec_type_row((enum iec_type)(n & 0xff))->word, at[1],
			inputs, typed(at[3]).text, at[2]);
}

int code_print(const uint32_t *code, uint32_t part, char *out, size_t size)
{
	static const char *const rel[CMP_COUNT] = {
		">", ">=", "=", "<=", "<", "<>",
	};
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
		return snprintf(out, size, "cmp     %s %s %s -> b%u",
				typed(at[1]).text, rel[n % CMP_COUNT],
				typed(at[2]).text, at[0]);
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
		return snprintf(out, size, "aget    en b%u %s%s[%s - %d] of %u by"
				" %u -> %s ok b%u", at[0], n ? "bit " : "",
				typed(at[3]).text, typed(at[4]).text,
				(int)at[5], at[6], at[7], typed(at[2]).text,
				at[1]);
	case VM_APUT:
		return snprintf(out, size, "aput    en b%u %s -> %s%s[%s - %d] of"
				" %u by %u ok b%u", at[0], typed(at[2]).text,
				n ? "bit " : "", typed(at[3]).text,
				typed(at[4]).text, (int)at[5], at[6], at[7],
				at[1]);
	case VM_STOP:
		return snprintf(out, size, "stop    b%u", at[0]);
	case VM_JMP:
		return snprintf(out, size, "jmp     %u", at[0]);
	case VM_JMPC:
		return snprintf(out, size, "jmpc    b%u %u", at[1], at[0]);
	case VM_END:
		return snprintf(out, size, "end");
	case VM_COUNT:
		break;
	}
	return snprintf(out, size, "?");
}
