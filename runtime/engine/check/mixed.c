/* SPDX-License-Identifier: MIT
 *
 * mixed - which conversions Structured Text makes between bit strings and numbers.
 */
#include "engine/check/mixed.h"

static uint16_t class_of(enum iec_type type)
{
	return iec_type_row(type)->class;
}

bool mixed_is_bits(enum iec_type type)
{
	return class_of(type) == CLASS_BITS;
}

static bool is_whole(enum iec_type type)
{
	return class_of(type) & (ANY_INT | CLASS_BITS);
}

enum iec_type mixed_join(enum iec_type a, enum iec_type b)
{
	a = a == IEC_NONE ? b : a;
	b = b == IEC_NONE ? a : b;
	if (class_of(a) == CLASS_REAL && is_whole(b))
		return a;
	if (class_of(b) == CLASS_REAL && is_whole(a))
		return b;
	if (!is_whole(a) || !is_whole(b))
		return IEC_TYPE_COUNT;
	if (iec_type_row(a)->size != iec_type_row(b)->size)
		return iec_type_row(a)->size > iec_type_row(b)->size ? a : b;
	return mixed_is_bits(a) ? a : b;
}

bool mixed_converts(enum iec_type from, enum iec_type to)
{
	if (from == IEC_BOOL)
		return is_whole(to);
	if (!mixed_is_bits(from) && !(is_whole(from) && mixed_is_bits(to)))
		return false;
	return class_of(to) == CLASS_REAL ||
	       (is_whole(to) && iec_type_row(from)->size <= iec_type_row(to)->size);
}

bool mixed_narrows(enum iec_type from, enum iec_type to)
{
	return from != to && class_of(from) & (ANY_NUM | CLASS_BITS) &&
	       class_of(to) & (ANY_NUM | CLASS_BITS);
}

/* The type of @class with the width of @type. */
static enum iec_type twin(enum iec_type type, uint16_t class)
{
	for (int i = IEC_NONE + 1; i < IEC_TYPE_COUNT; i++)
		if (class_of((enum iec_type)i) == class &&
		    iec_type_row((enum iec_type)i)->size == iec_type_row(type)->size)
			return (enum iec_type)i;
	return type;
}

enum iec_type mixed_pin(uint16_t classes, enum iec_type type)
{
	if (class_of(type) & classes || !is_whole(type))
		return type;
	if (mixed_is_bits(type) && classes & CLASS_UNSIGNED)
		return twin(type, CLASS_UNSIGNED);
	if (class_of(type) & ANY_INT && classes & CLASS_BITS)
		return twin(type, CLASS_BITS);
	return classes & CLASS_REAL ? IEC_REAL : type;
}
