/* SPDX-License-Identifier: MIT
 *
 * value - typed memory as the VM reads and writes it: inline, without branches that
 * depend on the type where that is possible.
 *
 * Other rooms use iec_load() and iec_store(). A load may read 8 bytes from any value
 * on; data memory has a tail for that. Little-endian only.
 */
#ifndef SCAN_VALUE_H
#define SCAN_VALUE_H

#include "engine/base/iec.h"

#include <string.h>

/* Number of bits above a value in 64; not for REAL and STRING. */
static inline unsigned value_spare_bits(uint32_t type)
{
	static const uint8_t spare[IEC_TYPE_COUNT] = {
#define TYPE(id, ctype, size, class, low, high) [IEC_##id] = 64 - 8 * (size),
#include "engine/catalog.def"
	};

	return spare[type];
}

static inline bool value_is_signed(uint32_t type)
{
	static const bool is_signed[IEC_TYPE_COUNT] = {
#define TYPE(id, ctype, size, class, low, high) \
		[IEC_##id] = ((class) & (CLASS_SIGNED | CLASS_TIME | ANY_DATE)) != 0,
#include "engine/catalog.def"
	};

	return is_signed[type];
}

/** value_wrap - the low bits of @value as a value of @type. Scan-safe: yes. */
static inline int64_t value_wrap(uint32_t type, int64_t value)
{
	unsigned spare = value_spare_bits(type);
	uint64_t high = (uint64_t)value << spare;

	return value_is_signed(type) ? (int64_t)high >> spare
				     : (int64_t)(high >> spare);
}

/** value_integer - loads BOOL, bits, integers or TIME. */
static inline int64_t value_integer(const uint8_t *at, uint32_t type)
{
	int64_t raw;

	memcpy(&raw, at, sizeof(raw));
	return value_wrap(type, raw);
}

/** value_is_real - REAL or LREAL: member r holds the value. */
static inline bool value_is_real(uint32_t type)
{
	return type == IEC_REAL || type == IEC_LREAL;
}

static inline double value_real(const uint8_t *at, uint32_t type)
{
	float single;
	double both;

	if (type == IEC_LREAL) {
		memcpy(&both, at, sizeof(both));
		return both;
	}
	memcpy(&single, at, sizeof(single));
	return (double)single;
}

/** value_put - stores the low bits of an integer, or a REAL or LREAL. */
static inline void value_put(uint8_t *at, uint32_t type, union iec_value value)
{
	float real;

	if (type == IEC_REAL) {
		real = (float)value.r;
		memcpy(at, &real, sizeof(real));
		return;
	}
	switch (value_spare_bits(type)) {
	case 56:
		memcpy(at, &value.i, 1);
		break;
	case 48:
		memcpy(at, &value.i, 2);
		break;
	case 32:
		memcpy(at, &value.i, 4);
		break;
	default:
		memcpy(at, &value.i, 8);
		break;
	}
}

/** value_order - <0, 0, >0 as @a sorts before, with or behind @b: byte by byte, a
 * shorter text first. Scan-safe: yes. */
static inline int value_order(const struct iec_string *a, const struct iec_string *b)
{
	uint16_t len = a->length < b->length ? a->length : b->length;
	int order = memcmp(a->text, b->text, len);

	return order ? order : (int)a->length - (int)b->length;
}
#endif
