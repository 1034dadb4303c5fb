/* SPDX-License-Identifier: MIT
 *
 * vm_value - operands of instructions as values.
 *
 * Private to vm.c.
 */
#ifndef SCAN_VM_VALUE_H
#define SCAN_VM_VALUE_H

#include "engine/scan/code.h"
#include "engine/scan/value.h"

static inline bool is_real(uint32_t word)
{
	return value_is_real(CODE_TYPE(word));
}

static inline int64_t integer(const uint8_t *m, uint32_t word)
{
	return value_integer(m + CODE_OFFSET(word), CODE_TYPE(word));
}

/* An operand for REAL arithmetic: integers that widen are exact. */
static inline double real(const uint8_t *m, uint32_t word)
{
	return is_real(word) ? value_real(m + CODE_OFFSET(word), CODE_TYPE(word))
			     : (double)integer(m, word);
}

static inline const struct iec_string *text(const uint8_t *m, uint32_t word)
{
	return (const void *)(m + CODE_OFFSET(word));
}

static inline void put(uint8_t *m, uint32_t word, union iec_value value)
{
	value_put(m + CODE_OFFSET(word), CODE_TYPE(word), value);
}

/* False if a text had to be cut. */
static inline bool put_text(uint8_t *m, uint32_t word, const struct iec_string *from)
{
	uint16_t len = from->length;

	iec_store(m + CODE_OFFSET(word), IEC_STRING, (union iec_value){ .s = from });
	return text(m, word)->length == len;
}

static inline void run_copy(uint8_t *m, const uint32_t *pc)
{
	union iec_value value;

	if (CODE_TYPE(pc[1]) == IEC_STRING) {
		put_text(m, pc[1], text(m, pc[2]));
		return;
	}
	if (is_real(pc[1]))
		value.r = real(m, pc[2]);
	else
		value.i = integer(m, pc[2]);
	put(m, pc[1], value);
}
#endif
