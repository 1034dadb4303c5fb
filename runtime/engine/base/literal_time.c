/* SPDX-License-Identifier: MIT
 *
 * literal_time - digits and durations: the only constants that an I/O map and a
 * runtime's command line need. literal.c has the others.
 */
#include "engine/base/literal_part.h"

enum literal_result literal_digits(struct rest *rest, unsigned int base,
				       uint64_t *out)
{
	bool over = false, digit = false;
	uint64_t value = 0;

	for (; !literal_end(rest); rest->at++) {
		unsigned int d = literal_digit(*rest->at);

		if (*rest->at == '_' && digit && rest->end - rest->at > 1 &&
		    literal_digit(rest->at[1]) < base)
			continue;
		if (d >= base)
			break;
		digit = true;
		over |= __builtin_mul_overflow(value, (uint64_t)base, &value);
		over |= __builtin_add_overflow(value, (uint64_t)d, &value);
	}
	*out = value;
	return !digit ? LITERAL_BAD : over ? LITERAL_RANGE : LITERAL_OK;
}

bool literal_fraction(uint64_t part, int places, uint64_t ns, uint64_t *out)
{
	while (places > 0) {
		if (part % 10 == 0)
			part /= 10;
		else if (ns % 10 == 0)
			ns /= 10;
		else if (part % 2 == 0 && ns % 5 == 0) {
			part /= 2;
			ns /= 5;
		} else if (part % 5 == 0 && ns % 2 == 0) {
			part /= 5;
			ns /= 2;
		} else {
			return false;
		}
		places--;
	}
	return !__builtin_mul_overflow(part, ns, out);
}

enum literal_result literal_places(struct rest *rest, uint64_t *part,
				       int *places)
{
	struct rest digits = *rest;

	if (literal_digits(rest, 10, part) == LITERAL_BAD)
		return LITERAL_BAD;
	digits.end = rest->at;
	while (digits.end - digits.at > 1 &&
	       (digits.end[-1] == '0' || digits.end[-1] == '_'))
		digits.end--;
	*places = 0;
	for (const char *at = digits.at; at != digits.end; at++)
		*places += *at != '_';
	return literal_digits(&digits, 10, part);
}

enum literal_result literal_signed(uint64_t size, bool minus, int64_t *out)
{
	if (size > (uint64_t)INT64_MAX + minus)
		return LITERAL_RANGE;
	*out = minus ? (int64_t)(0 - size) : (int64_t)size;
	return LITERAL_OK;
}

const struct literal_unit literal_unit[LITERAL_UNITS] = {
	{ "d",  0,   86400000000000u }, { "h",  23,  3600000000000u },
	{ "m",  59,  60000000000u },    { "s",  59,  1000000000u },
	{ "ms", 999, 1000000u },        { "us", 999, 1000u },
	{ "ns", 999, 1u },
};

/* The unit word at the cursor; LITERAL_UNITS: none. */
static int take_unit(struct rest *rest)
{
	size_t len = 0;

	while (rest->at + len != rest->end &&
	       ascii_upper(rest->at[len]) >= 'A' &&
	       ascii_upper(rest->at[len]) <= 'Z')
		len++;
	for (int i = 0; i < LITERAL_UNITS; i++)
		if (ascii_is(literal_unit[i].word, rest->at, len)) {
			rest->at += len;
			return i;
		}
	return LITERAL_UNITS;
}

enum literal_result literal_units(struct rest rest, uint64_t *out)
{
	uint64_t total = 0, count, part = 0, ns;
	int before = -1, places = 0;

	while (!literal_end(&rest)) {
		enum literal_result result = literal_digits(&rest, 10, &count);
		bool point = result != LITERAL_BAD && literal_byte(&rest, '.');
		int unit;

		if (point && result == LITERAL_OK)
			result = literal_places(&rest, &part, &places);
		if (result != LITERAL_OK)
			return result;
		unit = take_unit(&rest);
		if (unit == LITERAL_UNITS || unit <= before ||
		    (point && !literal_end(&rest)))
			return LITERAL_BAD;
		if ((before >= 0 && count > literal_unit[unit].most) ||
		    __builtin_mul_overflow(count, literal_unit[unit].ns, &ns) ||
		    __builtin_add_overflow(total, ns, &total))
			return LITERAL_RANGE;
		if (point && (!literal_fraction(part, places, literal_unit[unit].ns,
					     &ns) ||
			      __builtin_add_overflow(total, ns, &total)))
			return LITERAL_RANGE;
		before = unit;
		if (literal_byte(&rest, '_') && literal_end(&rest))
			return LITERAL_BAD;
	}
	*out = total;
	return before < 0 ? LITERAL_BAD : LITERAL_OK;
}

bool literal_parse_duration(const char *text, size_t len, int64_t *ns)
{
	struct rest rest = { text, text + len };
	uint64_t size;

	return literal_units(rest, &size) == LITERAL_OK &&
	       literal_signed(size, false, ns) == LITERAL_OK;
}
