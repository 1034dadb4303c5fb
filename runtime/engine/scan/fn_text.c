/* SPDX-License-Identifier: MIT
 *
 * fn_text - converts values to text. fn_text_to.c converts back.
 */
#include "engine/scan/fn_text.h"
#include "engine/base/decimal.h"

#include <string.h>

#define SECOND_NS INT64_C(1000000000)
#define DAY_NS    (86400 * SECOND_NS)

/* Where the next byte goes. */
struct pen {
	char *at;
};

static void put(struct pen *pen, const char *text)
{
	while (*text)
		*pen->at++ = *text++;
}

/* At least @digits digits. */
static void put_number(struct pen *pen, uint64_t number, int digits)
{
	char digit[20];
	int count = 0;

	for (; number || count < digits; number /= 10)
		digit[count++] = (char)('0' + number % 10);
	while (count > 0)
		*pen->at++ = digit[--count];
}

static void put_zeros(struct pen *pen, int count)
{
	while (count-- > 0)
		*pen->at++ = '0';
}

static void put_digits(struct pen *pen, const char *digit, int count)
{
	memcpy(pen->at, digit, (size_t)count);
	pen->at += count;
}

/* 1.5e+10 */
static void put_exponent(struct pen *pen, const struct decimal *d)
{
	put_digits(pen, d->digit, 1);
	put(pen, d->count > 1 ? "." : ".0");
	put_digits(pen, d->digit + 1, d->count - 1);
	put(pen, d->exponent < 0 ? "e-" : "e+");
	put_number(pen, (uint64_t)(d->exponent < 0 ? -d->exponent : d->exponent), 2);
}

/* Without an exponent where it is small: from -4 up to as many digits as there are,
 * six at least. */
static void put_decimal(struct pen *pen, const struct decimal *d)
{
	int whole = d->exponent + 1;

	if (d->exponent < -4 || d->exponent >= (d->count < 6 ? 6 : d->count)) {
		put_exponent(pen, d);
	} else if (whole <= 0) {
		put(pen, "0.");
		put_zeros(pen, -whole);
		put_digits(pen, d->digit, d->count);
	} else if (whole >= d->count) {
		put_digits(pen, d->digit, d->count);
		put_zeros(pen, whole - d->count);
		put(pen, ".0");
	} else {
		put_digits(pen, d->digit, whole);
		put(pen, ".");
		put_digits(pen, d->digit + whole, d->count - whole);
	}
}

static void put_real(struct pen *pen, double value, bool single)
{
	struct decimal decimal;
	uint64_t bits;

	memcpy(&bits, &value, sizeof(bits));
	if (value != value) {
		put(pen, "nan");
		return;
	}
	put(pen, bits >> 63 ? "-" : "");
	bits = bits << 1 >> 1;
	memcpy(&value, &bits, sizeof(value));
	if (bits >> 52 == 0x7ff) {
		put(pen, "inf");
	} else if (bits == 0) {
		put(pen, "0.0");
	} else {
		decimal_of(value, single, &decimal);
		put_decimal(pen, &decimal);
	}
}

/* T#1d2h3m4s5ms6us7ns without the parts that are 0. */
static void put_time(struct pen *pen, int64_t ns)
{
	static const struct { const char *word; uint64_t ns; } units[] = {
		{ "d", (uint64_t)DAY_NS }, { "h", UINT64_C(3600000000000) },
		{ "m", UINT64_C(60000000000) }, { "s", (uint64_t)SECOND_NS },
		{ "ms", 1000000 }, { "us", 1000 }, { "ns", 1 },
	};
	uint64_t left = ns < 0 ? 0 - (uint64_t)ns : (uint64_t)ns;

	put(pen, ns < 0 ? "T#-" : ns ? "T#" : "T#0s");
	for (size_t i = 0; i < sizeof(units) / sizeof(*units); i++) {
		if (left >= units[i].ns) {
			put_number(pen, left / units[i].ns, 1);
			put(pen, units[i].word);
		}
		left %= units[i].ns;
	}
}

static void put_date(struct pen *pen, int64_t day)
{
	int year, month, of_month;

	iec_civil(day, &year, &month, &of_month);
	put_number(pen, (uint64_t)year, 4);
	put(pen, "-");
	put_number(pen, (uint64_t)month, 2);
	put(pen, "-");
	put_number(pen, (uint64_t)of_month, 2);
}

/* 08:30:00, with as many decimals as it takes. */
static void put_clock(struct pen *pen, uint64_t ns)
{
	uint64_t second = ns / (uint64_t)SECOND_NS, below = ns % (uint64_t)SECOND_NS;
	int digits = 9;

	put_number(pen, second / 3600, 2);
	put(pen, ":");
	put_number(pen, second / 60 % 60, 2);
	put(pen, ":");
	put_number(pen, second % 60, 2);
	if (!below)
		return;
	for (; below % 10 == 0; below /= 10)
		digits--;
	put(pen, ".");
	put_number(pen, below, digits);
}

static void put_dated(struct pen *pen, uint16_t class, int64_t ns)
{
	int64_t day = ns / DAY_NS - (ns % DAY_NS < 0);

	put(pen, class == CLASS_TOD ? "TOD#" : class == CLASS_DATE ? "D#" : "DT#");
	if (class == CLASS_TOD) {
		/* A value that was written through an address may be longer than a day. */
		put_clock(pen, (uint64_t)((ns % DAY_NS + DAY_NS) % DAY_NS));
		return;
	}
	put_date(pen, day);
	if (class == CLASS_DATE)
		return;
	put(pen, "-");
	/* Unsigned: the first day begins before the first value. */
	put_clock(pen, (uint64_t)ns - (uint64_t)day * (uint64_t)DAY_NS);
}

uint32_t fn_text_from(enum iec_type type, union iec_value value, char *out)
{
	struct pen pen = { out };
	bool minus = value.i < 0 && !iec_is_wide(type);

	switch ((enum iec_class)iec_type_row(type)->class) {
	case CLASS_BOOL:
		put(&pen, value.i ? "TRUE" : "FALSE");
		break;
	case CLASS_BITS:
	case CLASS_SIGNED:
	case CLASS_UNSIGNED:
		put(&pen, minus ? "-" : "");
		put_number(&pen, minus ? 0 - (uint64_t)value.i : (uint64_t)value.i, 1);
		break;
	case CLASS_REAL:
		put_real(&pen, value.r, type == IEC_REAL);
		break;
	case CLASS_TIME:
		put_time(&pen, value.i);
		break;
	case CLASS_TOD:
	case CLASS_DATE:
	case CLASS_DT:
		put_dated(&pen, iec_type_row(type)->class, value.i);
		break;
	case CLASS_STRING:
		break;
	}
	return (uint32_t)(pen.at - out);
}
