/* SPDX-License-Identifier: MIT
 *
 * test_fn_text - values as text and back, against the printer of literals, which uses
 * libc, and strtod: on edges of every type and on random bits.
 */
#include "engine/base/literal.h"
#include "engine/scan/fn_text.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

static uint64_t seed = 0x9e3779b97f4a7c15u;

static uint64_t chance(void)
{
	seed ^= seed << 13;
	seed ^= seed >> 7;
	seed ^= seed << 17;
	return seed;
}

static void text_of(enum iec_type type, union iec_value value, char *out)
{
	out[fn_text_from(type, value, out)] = '\0';
}

static bool reads(enum iec_type type, const char *text, union iec_value *out)
{
	return fn_text_to(type, text, (uint32_t)strlen(text), out);
}

static bool same(enum iec_type type, union iec_value a, union iec_value b)
{
	if (iec_type_row(type)->class == CLASS_REAL)
		return memcmp(&a.r, &b.r, sizeof(a.r)) == 0;
	return a.i == b.i;
}

/* The text is the literal and reads back. For a REAL it may have fewer digits than
 * printf's, if its neighbours are not equally far. */
static bool agrees(enum iec_type type, union iec_value value)
{
	char text[FN_TEXT_MOST + 1], literal[80];
	union iec_value back = { .i = 4711 };
	bool good;

	text_of(type, value, text);
	literal_print(type, value, literal, sizeof(literal));
	good = reads(type, text, &back) && same(type, back, value) &&
	       (strcmp(text, literal) == 0 ||
		(iec_type_row(type)->class == CLASS_REAL &&
		 strlen(text) <= strlen(literal)));
	if (!good)
		printf("# %s: %s, not %s\n", iec_type_row(type)->word, text, literal);
	return good;
}

static union iec_value real(double r)
{
	return (union iec_value){ .r = r };
}

static union iec_value whole(int64_t i)
{
	return (union iec_value){ .i = i };
}

static void integers(void)
{
	for (int t = IEC_BOOL; t <= IEC_ULINT; t++) {
		enum iec_type type = (enum iec_type)t;
		const struct iec_type_row *row = iec_type_row(type);
		bool good = agrees(type, whole(row->low)) && agrees(type, whole(0)) &&
			    agrees(type, whole(row->high)) && agrees(type, whole(1));

		CHECK_AS(good, row->word);
		CHECK(!iec_is_wide(type) || agrees(type, whole(-1)));
	}
}

static bool gives(enum iec_type type, const char *text, int64_t want)
{
	union iec_value value = { .i = 4711 };

	return reads(type, text, &value) && value.i == want;
}

static bool fails(enum iec_type type, const char *text)
{
	union iec_value value = { .i = 4711 };

	return !reads(type, text, &value);
}

static void reads_integers(void)
{
	CHECK(gives(IEC_INT, "32767", 32767) && fails(IEC_INT, "32768"));
	CHECK(gives(IEC_INT, "-32768", -32768) && fails(IEC_INT, "-32769"));
	CHECK(gives(IEC_INT, "  +7 ", 7) && gives(IEC_INT, "-0", 0));
	CHECK(gives(IEC_INT, "1_000", 1000) && gives(IEC_INT, "1__0", 1) &&
	      gives(IEC_INT, "1_", 1) && fails(IEC_INT, "_1"));
	CHECK(gives(IEC_INT, "INT#16#7F", 127) && gives(IEC_WORD, "16#ffff", 65535));
	CHECK(gives(IEC_BYTE, "2#1010_1010", 170) && gives(IEC_BYTE, "8#17", 15));
	CHECK(fails(IEC_BYTE, "2#2") && fails(IEC_BYTE, "256") && fails(IEC_BYTE, "-1"));
	CHECK(fails(IEC_INT, "") && fails(IEC_INT, "   ") && fails(IEC_INT, "-") &&
	      gives(IEC_INT, "5 6", 5) && gives(IEC_INT, "3.14", 3) && fails(IEC_INT, "x") &&
	      gives(IEC_UINT, "12kg", 12) && gives(IEC_DINT, "-7;8", -7) &&
	      fails(IEC_INT, "DINT#5") && gives(IEC_INT, "16#", 16));
	CHECK(gives(IEC_ULINT, "18446744073709551615", -1) &&
	      fails(IEC_ULINT, "18446744073709551616"));
	CHECK(gives(IEC_LINT, "-9223372036854775808", INT64_MIN) &&
	      fails(IEC_LINT, "9223372036854775808"));
	CHECK(gives(IEC_BOOL, "true", 1) && gives(IEC_BOOL, "FALSE", 0) &&
	      gives(IEC_BOOL, "1", 1) && gives(IEC_BOOL, "0", 0) &&
	      fails(IEC_BOOL, "2") && fails(IEC_BOOL, "TRUEST"));
}

static void reads_times(void)
{
	CHECK(gives(IEC_TIME, "T#1h30m", INT64_C(5400000000000)) &&
	      gives(IEC_TIME, "1h30m", INT64_C(5400000000000)) &&
	      gives(IEC_TIME, "time#-2.5s", INT64_C(-2500000000)));
	CHECK(gives(IEC_TIME, "T#0s", 0) && gives(IEC_TIME, "1d_2h", INT64_C(93600000000000)));
	CHECK(fails(IEC_TIME, "5") && fails(IEC_TIME, "T#5x") && fails(IEC_TIME, "1m1h") &&
	      fails(IEC_TIME, "1.5h3m") && fails(IEC_TIME, "T#") && fails(IEC_TIME, "1.s") &&
	      fails(IEC_TIME, "0.5ns") && fails(IEC_TIME, "106752d"));
	CHECK(agrees(IEC_TIME, whole(INT64_MIN)) && agrees(IEC_TIME, whole(INT64_MAX)) &&
	      agrees(IEC_TIME, whole(-1)) && agrees(IEC_TIME, whole(0)));
	CHECK(gives(IEC_TIME_OF_DAY, "08:30:00.5", INT64_C(30600500000000)) &&
	      fails(IEC_TIME_OF_DAY, "24:00:00") && fails(IEC_TIME_OF_DAY, "8:30"));
	CHECK(gives(IEC_DATE, "D#1970-01-02", INT64_C(86400000000000)) &&
	      gives(IEC_DATE, "2024-02-29", INT64_C(1709164800000000000)) &&
	      fails(IEC_DATE, "2023-02-29") && fails(IEC_DATE, "1600-01-01") &&
	      fails(IEC_DATE, "2024-00-10") && fails(IEC_DATE, "2024-2"));
	CHECK(gives(IEC_DATE_AND_TIME, "DT#1970-01-01-00:00:01", 1000000000) &&
	      fails(IEC_DATE_AND_TIME, "1970-01-01") &&
	      fails(IEC_DATE_AND_TIME, "1970-01-01-00:00:00.0000000001"));
	CHECK(agrees(IEC_DATE_AND_TIME, whole(INT64_MAX)) &&
	      agrees(IEC_DATE_AND_TIME, whole(-1)) &&
	      agrees(IEC_TIME_OF_DAY, whole(INT64_C(86399999999999))));
}

static bool random_whole(enum iec_type type, int64_t mask)
{
	bool good = true;

	for (int i = 0; i < tap_rounds(20000) && good; i++)
		good = agrees(type, whole((int64_t)(chance() >> (chance() & 63)) & mask));
	return good;
}

static const double edges[] = {
	0.1, 0.2, 0.3, 1, 1.5, 10, 100000, 999999, 1e6, 1e7, 123456789, 1e-4, 1e-5,
	9007199254740992.0, 9007199254740993.0, 1.7976931348623157e308,
	2.2250738585072014e-308, 4.9406564584124654e-324, 1e-323, 5e-310,
	1e23, 8.5e22, 9.5e-5, 0.00012345, 3.4028234663852886e38,
	1.1754943508222875e-38, 1.401298464324817e-45, 5.6843418860808015e-14, 0,
};

static void reals(void)
{
	bool good = true;

	for (size_t i = 0; i < sizeof(edges) / sizeof(*edges); i++) {
		good = agrees(IEC_LREAL, real(edges[i])) &&
		       agrees(IEC_LREAL, real(-edges[i])) && good;
		if (fabs(edges[i]) < 3.5e38)
			good = agrees(IEC_REAL, real((double)(float)edges[i])) && good;
	}
	CHECK_AS(good, "edges");
	for (int e = -1074; e < 1024 && good; e++)
		good = agrees(IEC_LREAL, real(ldexp(1, e)));
	CHECK_AS(good, "powers of 2 are printed as literals that read back");
	for (int i = 0; i < tap_rounds(60000) && good; i++) {
		union iec_value value = { .i = (int64_t)(chance() & ~(UINT64_C(1) << 63)) };
		uint32_t bits = (uint32_t)chance();
		float single;

		memcpy(&single, &bits, sizeof(single));
		good = (!isfinite(value.r) || agrees(IEC_LREAL, value)) &&
		       (!isfinite(single) || agrees(IEC_REAL, real((double)single)));
	}
	CHECK_AS(good, "random bits are printed as literals that read back");
	for (int i = 0; i < tap_rounds(60000) && good; i++)
		good = agrees(IEC_LREAL, real((double)(chance() % 1000000000) /
					      (double)(1 << chance() % 24)));
	CHECK_AS(good,
		 "random numbers below 10^9 are printed as literals that read back");
}

/* The nearest value, as libc gives it. */
static bool nearest(const char *text)
{
	union iec_value value = { .i = 0 };
	double want = strtod(text, NULL);
	bool good = isfinite(want) ? reads(IEC_LREAL, text, &value) &&
				     same(IEC_LREAL, value, real(want)) :
				     !reads(IEC_LREAL, text, &value);
	double single = (double)strtof(text, NULL);

	good = good && (isfinite(single) ? reads(IEC_REAL, text, &value) &&
					   same(IEC_REAL, value, real(single)) :
					   !reads(IEC_REAL, text, &value));
	if (!good)
		printf("# %s\n", text);
	return good;
}

/* Half way between two values: one digit far to the right decides. */
static void ties(void)
{
	CHECK(nearest("9007199254740993") && nearest("9007199254740993.0000000000001") &&
	      nearest("9007199254740992.9999999999999") && nearest("9007199254740995"));
	CHECK(nearest("16777217") && nearest("16777217.00000000000000000000000000001") &&
	      nearest("16777219") && nearest("33554435"));
	CHECK(nearest("2.4703282292062327208e-324") && nearest("2.4703282292062328e-324") &&
	      nearest("7.0064923216240854e-46") && nearest("7.0064923216240862e-46"));
	CHECK(nearest("1.7976931348623158e308") && nearest("1.7976931348623159e308") &&
	      nearest("3.4028235677973366e38") && nearest("3.4028235677973365e38"));
	CHECK(nearest("1e400") && nearest("1e-400") && nearest("0e999999") &&
	      nearest("1e99999999999999999999") && nearest("1e-99999999999999999999"));
	CHECK(nearest("0.00000000000000000000000000000000000000000000000000000000001e60"));
}

static void random_texts(void)
{
	bool good = true;

	for (int i = 0; i < tap_rounds(40000) && good; i++) {
		char text[280];
		int n = 1 + (int)(chance() % (i % 16 ? 25 : 200)), at = 0;

		for (int k = 0; k < n; k++) {
			text[at++] = (char)('0' + chance() % 10);
			if (k == (int)(chance() % 5) && !memchr(text, '.', (size_t)at) &&
			    k + 1 < n)
				text[at++] = '.';
		}
		snprintf(text + at, 16, "e%d", (int)(chance() % 700) - 360);
		good = nearest(text);
	}
	CHECK_AS(good, "random texts are read as libc reads them");
	{
		/* The smallest value with 255 digits. */
		char text[256];

		memset(text, '9', sizeof(text));
		memcpy(text + 249, "e-570", 6);
		text[1] = '.';
		CHECK(nearest(text));
		memcpy(text + 249, "e-330", 6);
		CHECK(nearest(text));
	}
}

/* @text goes on behind the number. */
static bool begins_with(double number, const char *text)
{
	union iec_value value = { .i = 0 };

	return reads(IEC_REAL, text, &value) && same(IEC_REAL, value, real(number));
}

static void refuses_reals(void)
{
	CHECK(fails(IEC_REAL, "") && fails(IEC_REAL, ".5") && fails(IEC_REAL, "nan") &&
	      fails(IEC_REAL, "inf") && fails(IEC_REAL, "x1"));
	CHECK(begins_with(5, "5.") && begins_with(1, "1e") && begins_with(1, "1e+") &&
	      begins_with(1.5, "1.5x") && begins_with(1, "1,5") && begins_with(-25, " -2.5e1 bar"));
	union iec_value value = { .i = 0 };
	CHECK(reads(IEC_REAL, "REAL#1_000.2_5", &value) && value.r >= 1000.25 &&
	      value.r <= 1000.25);
	CHECK(begins_with(1, "1_.5") && begins_with(1, "1._5") && begins_with(1.5, "1.5.5"));
	char text[FN_TEXT_MOST + 1];

	text_of(IEC_REAL, real(-INFINITY), text);
	CHECK_TEXT(text, "-inf");
	text_of(IEC_LREAL, real(NAN), text);
	CHECK_TEXT(text, "nan");
	text_of(IEC_LREAL, real(-0.0), text);
	CHECK_TEXT(text, "-0.0");
}

int main(void)
{
	integers();
	reads_integers();
	reads_times();
	CHECK(random_whole(IEC_TIME, -1) && random_whole(IEC_LINT, -1));
	CHECK(random_whole(IEC_DATE_AND_TIME, INT64_MAX));
	reals();
	ties();
	random_texts();
	refuses_reals();
	return tap_done();
}
