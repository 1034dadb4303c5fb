/* SPDX-License-Identifier: MIT
 *
 * literal - constants as IEC 61131-3 writes them (tables 5 to 8).
 *
 * `12 -7 1_000 2#1010 8#17 16#FF TRUE 1.5E-3 T#1h2m3.5s INT#16#7F TOD#08:30:00
 * D#2026-11-21 DT#2026-11-21-08:30:00 'it$'s' "caf$00E9"`. Text to value and value to canonical
 * text. Nothing is rounded silently.
 */
#ifndef BASE_LITERAL_H
#define BASE_LITERAL_H

#include "engine/base/iec.h"

enum literal_result {
	LITERAL_OK,
	LITERAL_NONE,  /* not a literal at all                               */
	LITERAL_BAD,   /* begins like a literal but is wrong, such as 2#3 or T#5x */
	LITERAL_RANGE, /* does not fit its own type or 64 bits               */
};

struct literal {
	enum iec_type type;    /* IEC_NONE: an untyped number, fits where it can */
	bool real;             /* untyped with a point or exponent               */
	bool wide;             /* of a STRING: its quotes are "; $ and four digits are a character */
	bool high;             /* i holds the bits of a number above INT64_MAX   */
	union iec_value value; /* r when real or type REAL or LREAL, else i      */
	const char *text;      /* of a STRING: what stands between its quotes,   */
	size_t len;            /* with its escapes; borrowed                     */
};

/**
 * literal_parse - the constant that all @len bytes of @text spell
 *
 * TIME is rounded to no less than 1 ns; finer is LITERAL_RANGE.
 * Owns: nothing.   Scan-safe: no (strtod).   Fails: as the result says.
 */
enum literal_result literal_parse(const char *text, size_t len,
				  struct literal *out);

/** literal_is_named - whether it spells Color#Red: a value of an enumeration, behind the name of
 * its type. Scan-safe: yes. */
bool literal_is_named(const char *text, size_t len);

/**
 * literal_fit - the literal as a value of @type
 *
 * Fails: false if it is not of that type or out of its range.
 */
bool literal_fit(const struct literal *literal, enum iec_type type,
		 union iec_value *out);

/**
 * literal_string - the bytes of a STRING literal, its escapes resolved
 * @out: gets at most IEC_STRING_MOST of them
 *
 * ($$ $' $L $N $P $R $T $xx, IEC 61131-3 table 6.) Returns their number.
 */
size_t literal_string(const struct literal *literal, char *out);

/**
 * literal_parse_duration - a time without its T#, as scenarios write it
 * @ns: nanoseconds of `10ms`, `2.5s`, `1m30s`; never negative
 *
 * Owns: nothing.   Scan-safe: no.   Fails: false; also finer than 1 ns.
 */
bool literal_parse_duration(const char *text, size_t len, int64_t *ns);

/** literal_print_time - "T#1h2m3s500ms" of nanoseconds; as snprintf. */
int literal_print_time(int64_t ns, char *out, size_t size);
/** literal_print - a value as source text of its type: TRUE, 5, 1.5, T#3s. */
int literal_print(enum iec_type type, union iec_value value, char *out,
		  size_t size);
#endif
