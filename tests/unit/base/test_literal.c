/* SPDX-License-Identifier: MIT
 *
 * test_literal - constants are read strictly, fit a type only exactly, and print as
 * text that reads back.
 */
#include "engine/base/literal.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct literal last;

static enum literal_result parse(const char *text)
{
	return literal_parse(text, strlen(text), &last);
}

/* Whether it is an untyped or typed integer with this value. */
static bool is(const char *text, enum iec_type type, int64_t value)
{
	return parse(text) == LITERAL_OK && last.type == type && !last.real &&
	       last.value.i == value;
}

static bool is_real(const char *text, enum iec_type type, double value)
{
	return parse(text) == LITERAL_OK && last.type == type &&
	       last.real == (type == IEC_NONE) && last.value.r == value;
}

static void integers(void)
{
	CHECK(is("12", IEC_NONE, 12));
	CHECK(is("-7", IEC_NONE, -7));
	CHECK(is("+7", IEC_NONE, 7));
	CHECK(is("1_000", IEC_NONE, 1000));
	CHECK(is("2#1010_0001", IEC_NONE, 0xa1));
	CHECK(is("8#17", IEC_NONE, 15));
	CHECK(is("16#fF", IEC_NONE, 255));
	CHECK(is("007", IEC_NONE, 7));
	CHECK(is("9223372036854775807", IEC_NONE, INT64_MAX));
	CHECK(is("-9223372036854775808", IEC_NONE, INT64_MIN));
	CHECK(is("10#1000", IEC_NONE, 1000));
	CHECK(is("INT#10#1_000", IEC_INT, 1000));
	CHECK(is("INT#16#7F", IEC_INT, 127));
	CHECK(is("INT#-5", IEC_INT, -5));
	CHECK(is("word#16#FFFF", IEC_WORD, 65535));
	CHECK(is("UDINT#4294967295", IEC_UDINT, 4294967295));
	CHECK(is("TRUE", IEC_BOOL, 1));
	CHECK(is("false", IEC_BOOL, 0));
	CHECK(is("BOOL#1", IEC_BOOL, 1));
	CHECK(is("BOOL#TRUE", IEC_BOOL, 1));
	CHECK(is("BOOL#FALSE", IEC_BOOL, 0));
}

static void reals(void)
{
	CHECK(is_real("1.5E-3", IEC_NONE, 1.5e-3));
	CHECK(is_real("-0.25", IEC_NONE, -0.25));
	CHECK(is_real("1e3", IEC_NONE, 1000));
	CHECK(is_real("1_0.2_5e+1", IEC_NONE, 102.5));
	CHECK(is_real("3.141592653589793", IEC_NONE, 3.141592653589793));
	CHECK(is_real("0.0000000000000000000000001", IEC_NONE, 1e-25));
	CHECK(is_real("REAL#5", IEC_REAL, 5));
	CHECK(is_real("REAL#-1.5", IEC_REAL, -1.5));
	CHECK(is_real("REAL#0.1", IEC_REAL, (double)0.1f));
	CHECK(parse("1e400") == LITERAL_RANGE);
	CHECK(parse("1e99999999999999999999") == LITERAL_RANGE);
	CHECK(parse("REAL#1e39") == LITERAL_RANGE);
}

/* @count digits and @end; if the digit is 0, the first one is 1. */
static const char *long_text(char digit, int count, const char *end)
{
	static char text[420];
	size_t len = strlen(end) + 1;

	memset(text, digit, sizeof(text));
	if (digit == '0')
		text[0] = '1';
	memcpy(text + count, end, len);
	return text;
}

/* A literal with many digits is read exactly or refused. */
static void long_reals(void)
{
	char text[420] = "0.";

	CHECK_AS(is_real(long_text('0', 309, ".0"), IEC_NONE, 1e308),
		 "308 zeros after the first digit are read");
	memset(text + 2, '0', 301);
	text[303] = '5';
	CHECK_AS(is_real(text, IEC_NONE, 5e-302), "301 zeros after the point are read");
	CHECK_AS(is_real(long_text('3', 254, "3e-254"), IEC_NONE, 10.0 / 3), "255 digits");
	CHECK_AS(parse(long_text('3', 255, "3e-254")) == LITERAL_RANGE,
		 "a literal of 256 digits is refused, not cut");
	CHECK(parse("1._5") == LITERAL_BAD && parse("1.5_") == LITERAL_BAD);
}

/* As libc reads them; libc is exact, too. */
static void reals_of_libc(void)
{
	uint64_t seed = 4711;
	int wrong = 0, looked = 0;

	for (int i = 0; i < 20000; i++) {
		char text[64];
		double value;

		seed = seed * 6364136223846793005u + 1442695040888963407u;
		memcpy(&value, &seed, sizeof(value));
		if (!(value - value == 0))
			continue;
		snprintf(text, sizeof(text), "%.*e", (int)(seed >> 20 & 15) + 5, value);
		looked++;
		wrong += !is_real(text, IEC_NONE, strtod(text, NULL));
	}
	CHECK(looked > 15000 && wrong == 0);
}

static void times(void)
{
	const int64_t s = 1000000000;

	CHECK(is("T#1h2m3.5s", IEC_TIME, 3723 * s + s / 2));
	CHECK(is("TIME#1d_2h", IEC_TIME, 93600 * s));
	CHECK(is("t#90S", IEC_TIME, 90 * s));
	CHECK(is("T#-5ms", IEC_TIME, -5000000));
	CHECK(is("T#0s", IEC_TIME, 0));
	CHECK(is("T#1us2ns", IEC_TIME, 1002));
	CHECK(is("T#1.5d", IEC_TIME, 129600 * s));
	CHECK(is("T#0.000000001s", IEC_TIME, 1));
	CHECK(is("T#1.5000000000000000000000000s", IEC_TIME, s + s / 2));
	CHECK(is("T#1_000ms", IEC_TIME, s));
	CHECK(is("T#0.00000000000125h", IEC_NONE, 0) ||
	      parse("T#0.00000000000125h") == LITERAL_RANGE);
	CHECK(is("T#0.0000000000125h", IEC_TIME, 45));
	CHECK(parse("T#0.0000000001s") == LITERAL_RANGE);
	CHECK(parse("T#0.5ns") == LITERAL_RANGE);
	CHECK(parse("T#1m90s") == LITERAL_RANGE);
	CHECK(parse("T#106752d") == LITERAL_RANGE);
	CHECK(parse("T#99999999999999999999s") == LITERAL_RANGE);
	CHECK(is("T#-106751d23h47m16s854ms775us808ns", IEC_TIME, INT64_MIN));
	CHECK(parse("T#106751d23h47m16s854ms775us808ns") == LITERAL_RANGE);
}

static void malformed(void)
{
	static const char *const bad[] = {
		"2#3", "8#8", "16#G", "16#", "10#A", "10#", "3#1", "-16#FF", "1__0",
		"1_", "1.", "1.5.2", "1e", "1e+", "5x", "T#", "T#5", "T#5x",
		"T#s", "T#1s1h", "T#1s2s", "T#1.5h2m", "T#1h_", "T#1h__2m",
		"T#--5s", "T#1. s", "INT#", "INT#x", "INT#1.5", "FOO#5", "#5",
		"INT#INT#5", "REAL#16#FF", "16#FF#1", "1 2", "BOOL#maybe",
		"-", "1_.5", "0x10", "_1#2", "TIME#5", "T#1h2",
	};
	static const char *const none[] = {
		"", "Motor", "TRUEX", "T", "%IX0.3", "10ms", "2.5s", "1h30m",
	};
	static const char *const range[] = {
		"16#1_0000_0000_0000_0000", "18446744073709551616", "-9223372036854775809",
		"LINT#9223372036854775808", "SINT#128",
		"UINT#-1", "BOOL#2", "BYTE#256", "INT#16#FFFF",
		"99999999999999999999999999", "WORD#-1",
	};
	enum literal_result result;

	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++) {
		result = parse(bad[i]);
		CHECK_AS(result == LITERAL_BAD ||
			 (result == LITERAL_NONE && bad[i][0] == '-'), bad[i]);
	}
	for (size_t i = 0; i < sizeof(none) / sizeof(*none); i++)
		CHECK_AS(parse(none[i]) == LITERAL_NONE, none[i]);
	for (size_t i = 0; i < sizeof(range) / sizeof(*range); i++)
		CHECK_AS(parse(range[i]) == LITERAL_RANGE, range[i]);
}

static bool fits(const char *text, enum iec_type type)
{
	union iec_value value;

	return parse(text) == LITERAL_OK && literal_fit(&last, type, &value);
}

static void fit(void)
{
	union iec_value value;

	CHECK(fits("127", IEC_SINT));
	CHECK(!fits("128", IEC_SINT));
	CHECK(fits("-128", IEC_SINT));
	CHECK(!fits("-1", IEC_UINT));
	CHECK(fits("16#FFFF", IEC_WORD));
	CHECK(!fits("16#FFFF", IEC_INT));
	CHECK(fits("1", IEC_BOOL));
	CHECK(!fits("2", IEC_BOOL));
	CHECK(fits("TRUE", IEC_BOOL));
	CHECK(!fits("TRUE", IEC_INT));
	CHECK(!fits("1.5", IEC_INT));
	CHECK(fits("1.5", IEC_REAL));
	CHECK(fits("5", IEC_REAL));
	CHECK(literal_fit(&last, IEC_REAL, &value) && value.r == 5);
	CHECK_AS(!fits("16777217", IEC_REAL),
		 "a whole number that a REAL cannot hold exactly does not fit");
	CHECK(fits("16777216", IEC_REAL));
	CHECK(!fits("9223372036854775807", IEC_REAL));
	CHECK(!fits("1e39", IEC_REAL));
	CHECK(!fits("1e-60", IEC_REAL));
	CHECK(!fits("5", IEC_TIME));
	CHECK(fits("T#5s", IEC_TIME));
	CHECK(!fits("T#5s", IEC_DINT));
	CHECK(fits("INT#5", IEC_DINT));
	CHECK(!fits("DINT#5", IEC_INT));
	CHECK(fits("INT#5", IEC_REAL));
	CHECK(literal_fit(&last, IEC_REAL, &value) && value.r == 5);
	CHECK(!fits("5", IEC_NONE));
}

static const char *time_text(int64_t ns)
{
	static char text[100];

	literal_print_time(ns, text, sizeof(text));
	return text;
}

static const char *text_of(enum iec_type type, union iec_value value)
{
	static char text[100];

	literal_print(type, value, text, sizeof(text));
	return text;
}

static void prints(void)
{
	CHECK_TEXT(time_text(0), "T#0s");
	CHECK_TEXT(time_text(3000000000), "T#3s");
	CHECK_TEXT(time_text(3723500000000), "T#1h2m3s500ms");
	CHECK_TEXT(time_text(-5000000), "T#-5ms");
	CHECK_TEXT(time_text(86400000000001), "T#1d1ns");
	CHECK_TEXT(text_of(IEC_BOOL, (union iec_value){ .i = 1 }), "TRUE");
	CHECK_TEXT(text_of(IEC_BOOL, (union iec_value){ .i = 0 }), "FALSE");
	CHECK_TEXT(text_of(IEC_INT, (union iec_value){ .i = -5 }), "-5");
	CHECK_TEXT(text_of(IEC_REAL, (union iec_value){ .r = 5 }), "5.0");
	CHECK_TEXT(text_of(IEC_REAL, (union iec_value){ .r = 1e6 }), "1.0e+06");
	CHECK_TEXT(text_of(IEC_REAL, (union iec_value){ .r = 1.5 }), "1.5");
	CHECK_TEXT(text_of(IEC_TIME, (union iec_value){ .i = 1000 }), "T#1us");
}

/* The printed text reads back as the same value. */
static void round_trip(void)
{
	uint64_t seed = 1;
	int wrong = 0;

	for (int i = 0; i < 5000; i++) {
		int64_t ns;
		const char *text;

		seed = seed * 6364136223846793005u + 1442695040888963407u;
		ns = (int64_t)seed >> (i % 60);
		text = time_text(ns);
		wrong += !is(text, IEC_TIME, ns);
	}
	wrong += !is(time_text(INT64_MIN), IEC_TIME, INT64_MIN);
	wrong += !is(time_text(INT64_MAX), IEC_TIME, INT64_MAX);
	CHECK(wrong == 0);
}

static bool lasts(const char *text, int64_t want)
{
	int64_t ns = -1;

	return literal_parse_duration(text, strlen(text), &ns) && ns == want;
}

static void durations(void)
{
	int64_t ns;

	CHECK(lasts("10ms", 10000000));
	CHECK(lasts("2.5s", 2500000000));
	CHECK(lasts("1m30s", 90000000000));
	CHECK(lasts("1H", 3600000000000));
	CHECK(lasts("0ms", 0));
	CHECK(lasts("25ns", 25));
	CHECK(!literal_parse_duration("", 0, &ns));
	CHECK(!literal_parse_duration("10", 2, &ns));
	CHECK(!literal_parse_duration("-5ms", 4, &ns));
	CHECK(!literal_parse_duration("ms", 2, &ns));
	CHECK(!literal_parse_duration("T#5s", 4, &ns));
	CHECK(!literal_parse_duration("999999999d", 10, &ns));
	CHECK(!literal_parse_duration("5 s", 3, &ns));
}

static void long_texts(void)
{
	static char text[100000];

	memset(text, '1', sizeof(text));
	CHECK(literal_parse(text, sizeof(text), &last) == LITERAL_RANGE);
	text[1] = '.';
	CHECK(literal_parse(text, sizeof(text), &last) == LITERAL_RANGE);
	text[1] = '#';
	CHECK(literal_parse(text, sizeof(text), &last) == LITERAL_BAD);
	memcpy(text, "T#", 2);
	CHECK(literal_parse(text, sizeof(text), &last) == LITERAL_RANGE);
	memset(text, '_', sizeof(text));
	text[0] = '1';
	CHECK(literal_parse(text, sizeof(text), &last) == LITERAL_BAD);
}

static bool ns_of(const char *text, enum iec_type type, int64_t ns)
{
	return literal_parse(text, strlen(text), &last) == LITERAL_OK &&
	       last.type == type && last.value.i == ns;
}

static bool becomes(const char *text, enum literal_result result)
{
	return literal_parse(text, strlen(text), &last) == result;
}

/* Every month from -1 to 14 and every day from -1 to 33. */
static void calendar(void)
{
	static const int length[] = { 0, 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
	static const int years[] = { 1900, 1970, 2000, 2023, 2024 };
	int wrong = 0;

	for (size_t i = 0; i < sizeof(years) / sizeof(*years); i++)
		for (int month = -1; month <= 14; month++)
			for (int day = -1; day <= 33; day++) {
				const int y = years[i];
				const bool leap = y % 4 == 0 && (y % 100 != 0 || y % 400 == 0);
				const bool is_there = month >= 1 && month <= 12 && day >= 1 &&
					day <= length[month] + (month == 2 && leap);
				int64_t ns;

				wrong += iec_date(y, month, day, &ns) != is_there;
			}
	CHECK_AS(wrong == 0, "a day is one of the calendar or is refused");
}

static void dates(void)
{
	CHECK(ns_of("D#1970-01-02", IEC_DATE, INT64_C(86400000000000)));
	CHECK(ns_of("date#1969-12-31", IEC_DATE, INT64_C(-86400000000000)));
	CHECK(ns_of("TOD#23:59:59.999999999", IEC_TIME_OF_DAY,
		    INT64_C(86399999999999)));
	CHECK(ns_of("TIME_OF_DAY#00:00:00", IEC_TIME_OF_DAY, 0));
	CHECK(ns_of("DT#1970-01-01-00:00:00.000000001", IEC_DATE_AND_TIME, 1));
	CHECK(ns_of("DATE_AND_TIME#1969-12-31-23:59:59.5", IEC_DATE_AND_TIME,
		    -500000000));
	CHECK(becomes("D#2024-02-29", LITERAL_OK) && becomes("D#2023-02-29", LITERAL_RANGE));
	CHECK(becomes("D#2024-13-01", LITERAL_RANGE) && becomes("D#2024-00-01", LITERAL_RANGE));
	CHECK(becomes("D#1677-09-21", LITERAL_RANGE) && becomes("D#2262-04-12", LITERAL_RANGE));
	CHECK(becomes("TOD#24:00:00", LITERAL_RANGE) && becomes("TOD#12:60:00", LITERAL_RANGE));
	CHECK(becomes("TOD#12:00:00.0000000001", LITERAL_RANGE));
	CHECK(becomes("D#2024-01", LITERAL_BAD) && becomes("D#2024-01-01x", LITERAL_BAD));
	CHECK(becomes("D#", LITERAL_BAD) && becomes("TOD#12", LITERAL_BAD));
	CHECK(becomes("DT#2024-01-01", LITERAL_BAD) && becomes("DT#2024-01-01 12:00:00", LITERAL_BAD));
	CHECK(becomes("D#2_024-01-01", LITERAL_BAD) && becomes("D#-2024-01-01", LITERAL_BAD));
}

/* The text between the quotes, or "?" if it is not a constant. */
static const char *quoted(const char *text)
{
	static char bytes[IEC_STRING_MOST + 1];

	if (literal_parse(text, strlen(text), &last) != LITERAL_OK ||
	    last.type != IEC_STRING)
		return "?";
	bytes[literal_string(&last, bytes)] = '\0';
	return bytes;
}

static void texts(void)
{
	char text[800] = "'";
	size_t at = 1;

	CHECK_TEXT(quoted("''"), "");
	CHECK_TEXT(quoted("'it$'s'"), "it's");
	CHECK_TEXT(quoted("'$$ $L$n$P$r$T'"), "$ \n\n\f\r\t");
	CHECK_TEXT(quoted("'$41$4a'"), "AJ");
	CHECK_TEXT(quoted("'T\xc3\xbcr \"A\"'"), "T\xc3\xbcr \"A\"");
	CHECK(becomes("'", LITERAL_BAD) && becomes("'a", LITERAL_BAD) && becomes("'a'b'", LITERAL_BAD));
	CHECK(becomes("'$'", LITERAL_BAD) && becomes("'$Q'", LITERAL_BAD) && becomes("'$4'", LITERAL_BAD));
	for (int i = 0; i < 255; i++, at += 3)
		memcpy(text + at, "$41", 3);
	memcpy(text + at, "'", 2);
	CHECK_AS(strlen(quoted(text)) == 255, "a text may have 255 bytes");
	memcpy(text + at, "x'", 3);
	CHECK(becomes(text, LITERAL_RANGE));
}

static void lreals(void)
{
	union iec_value value;

	CHECK(becomes("LREAL#0.1", LITERAL_OK) && last.type == IEC_LREAL &&
	      last.value.r == 0.1);
	CHECK(becomes("1.7976931348623157E308", LITERAL_OK) &&
	      literal_fit(&last, IEC_LREAL, &value) &&
	      !literal_fit(&last, IEC_REAL, &value));
	CHECK(becomes("4.9406564584124654E-324", LITERAL_OK) &&
	      literal_fit(&last, IEC_LREAL, &value) && value.r > 0);
	CHECK(becomes("0.1", LITERAL_OK) && literal_fit(&last, IEC_LREAL, &value) &&
	      value.r == 0.1 && literal_fit(&last, IEC_REAL, &value) &&
	      value.r == (double)0.1f);
	CHECK(becomes("9007199254740992", LITERAL_OK) &&
	      literal_fit(&last, IEC_LREAL, &value));
	CHECK_AS(becomes("9007199254740993", LITERAL_OK) &&
		 !literal_fit(&last, IEC_LREAL, &value),
		 "a whole number that an LREAL cannot hold exactly does not fit");
	CHECK(becomes("-9007199254740992", LITERAL_OK) &&
	      literal_fit(&last, IEC_LREAL, &value) && value.r == -9007199254740992.0);
	CHECK(becomes("-9007199254740993", LITERAL_OK) && !literal_fit(&last, IEC_LREAL, &value));
}

int main(void)
{
	integers();
	reals();
	long_reals();
	reals_of_libc();
	times();
	malformed();
	fit();
	prints();
	round_trip();
	durations();
	long_texts();
	dates();
	calendar();
	texts();
	lreals();
	return tap_done();
}
