/* SPDX-License-Identifier: MIT
 *
 * literal_part - what literal.c is made of. Private to base/.
 */
#ifndef BASE_LITERAL_PART_H
#define BASE_LITERAL_PART_H

#include "engine/base/literal.h"

/* What is left of the text. */
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

/** literal_digits - digits of @base with single underscores between them. */
enum literal_result literal_digits(struct rest *rest, unsigned int base,
				   uint64_t *out);
/** literal_places - digits behind the point; zeros at their end do not count. */
enum literal_result literal_places(struct rest *rest, uint64_t *part, int *places);
/** literal_fraction - @part / 10^@places of @ns, if that is a whole number; false: it
 * is finer. */
bool literal_fraction(uint64_t part, int places, uint64_t ns, uint64_t *out);
/** literal_date - what stands behind TOD#, D# and DT# (IEC 61131-3 table 8). */
enum literal_result literal_date(enum iec_type type, struct rest rest, int64_t *out);
/** literal_quoted - a STRING in its quotes. */
enum literal_result literal_quoted(struct rest rest, struct literal *out);
#endif
