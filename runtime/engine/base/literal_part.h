/* SPDX-License-Identifier: MIT
 *
 * literal_part - steps that literal.c and literal_time.c share. Private to base/.
 */
#ifndef BASE_LITERAL_PART_H
#define BASE_LITERAL_PART_H

#include "engine/base/ascii.h"
#include "engine/base/literal.h"

/* The rest of the text. */
struct rest {
	const char *at, *end;
};

static inline bool literal_end(const struct rest *rest)
{
	return rest->at == rest->end;
}

static inline bool literal_byte(struct rest *rest, char c)
{
	if (literal_end(rest) || *rest->at != c)
		return false;
	rest->at++;
	return true;
}

/** literal_digit - the value of a digit up to F; 99: it is none. */
static inline unsigned int literal_digit(char c)
{
	if (ascii_digit(c))
		return (unsigned int)(c - '0');
	c = ascii_upper(c);
	return c >= 'A' && c <= 'F' ? (unsigned int)(c - 'A') + 10 : 99;
}

/** literal_digits - digits of @base with single underscores between them. */
enum literal_result literal_digits(struct rest *rest, unsigned int base,
				   uint64_t *out);
/** literal_places - digits behind the point; trailing zeros do not count. */
enum literal_result literal_places(struct rest *rest, uint64_t *part, int *places);
/** literal_fraction - @part / 10^@places of @ns, if that is a whole number; false: it
 * is finer. */
bool literal_fraction(uint64_t part, int places, uint64_t ns, uint64_t *out);
struct literal_unit {
	char word[3];
	uint16_t most; /* behind a larger unit                                */
	uint64_t ns;
};
#define LITERAL_UNITS 7
/* d to ns. */
extern const struct literal_unit literal_unit[LITERAL_UNITS];
/** literal_units - 1h2m3.5s in ns. */
enum literal_result literal_units(struct rest rest, uint64_t *out);
/** literal_signed - @magnitude with its sign; false if 64 bits do not hold it. */
enum literal_result literal_signed(uint64_t magnitude, bool minus, int64_t *out);
#endif
