/* SPDX-License-Identifier: MIT
 *
 * vm_array - array elements whose index is computed in the scan.
 *
 * Private to vm.c.
 */
#ifndef SCAN_VM_ARRAY_H
#define SCAN_VM_ARRAY_H

#include "engine/scan/vm_value.h"

#include <string.h>

/* Operands of AGET and APUT; ABLOCK has SIZE in between. The indices follow. */
enum { EN, OK, VALUE, BASE, ELEMENT, SIZE = ELEMENT };
enum { INDEX, LOW, COUNT, STRIDE };

/* Adds the offset of the element to *where; false: no such element. An index below
 * `low` wraps to a number far above `count`, so one comparison is enough. */
static inline bool find_index(const uint8_t *m, const uint32_t *at, uint32_t *where)
{
	int64_t index = integer(m, at[INDEX]);
	uint64_t element = (uint64_t)index - (uint64_t)(int32_t)at[LOW];

	if (element >= at[COUNT] ||
	    (index < 0 && !value_is_signed(CODE_TYPE(at[INDEX]))))
		return false;
	*where += (uint32_t)element * at[STRIDE];
	return true;
}

/* The indices after the first. */
static inline bool find_more(const uint8_t *m, const uint32_t *at, uint32_t more,
		      uint32_t *where)
{
	for (; more > 0; more--) {
		at += CODE_DIMENSION;
		if (!find_index(m, at, where))
			return false;
	}
	return true;
}

static inline bool find_element(const uint8_t *m, const uint32_t *at, uint32_t more,
				uint32_t *where)
{
	return find_index(m, at, where) && (!more || find_more(m, at, more, where));
}

static inline void clear_value(uint8_t *m, const uint32_t *at)
{
	static const struct iec_string none = { 0, 0 };

	if (CODE_TYPE(at[VALUE]) == IEC_STRING)
		put_text(m, at[VALUE], &none);
	else
		put(m, at[VALUE], (union iec_value){ .i = 0 });
}

static inline bool get_element(uint8_t *m, const uint32_t *at, uint32_t n)
{
	uint32_t where = CODE_OFFSET(at[BASE]), copy[3] = { 0, at[VALUE], 0 };

	if (!find_element(m, at + ELEMENT, n >> 1, &where))
		return false;
	if (n & 1) {
		m[CODE_OFFSET(at[VALUE])] = m[where / 8] >> where % 8 & 1u;
		return true;
	}
	copy[2] = CODE_OPERAND(CODE_TYPE(at[BASE]), where);
	run_copy(m, copy);
	return true;
}

static inline bool put_element(uint8_t *m, const uint32_t *at, uint32_t n)
{
	uint32_t where = CODE_OFFSET(at[BASE]), copy[3] = { 0, 0, at[VALUE] };

	if (!find_element(m, at + ELEMENT, n >> 1, &where))
		return false;
	if (n & 1) {
		uint8_t *byte = &m[where / 8];

		*byte = (uint8_t)((*byte & ~(1u << where % 8)) |
				  (uint32_t)m[CODE_OFFSET(at[VALUE])]
				  << where % 8);
		return true;
	}
	copy[1] = CODE_OPERAND(CODE_TYPE(at[BASE]), where);
	run_copy(m, copy);
	return true;
}

/* @at[VALUE] and @at[BASE]: destination and source. */
static inline bool move_element(uint8_t *m, const uint32_t *at, uint32_t n)
{
	uint32_t to = at[VALUE], from = at[BASE];

	if (!find_element(m, at + SIZE + 1, n >> 1, n & 1 ? &to : &from))
		return false;
	memcpy(m + to, m + from, at[SIZE]);
	return true;
}
#endif
