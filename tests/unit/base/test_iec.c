/* SPDX-License-Identifier: MIT
 *
 * test_iec - types widen as the standard says, addresses read and print, values
 * survive memory, and text of values is the same everywhere.
 */
#include "engine/base/iec.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

static void types(void)
{
	CHECK(iec_type_find("bool", 4) == IEC_BOOL);
	CHECK(iec_type_find("Dword", 5) == IEC_DWORD);
	CHECK(iec_type_find("INTX", 3) == IEC_INT);
	CHECK(iec_type_find("IN", 2) == IEC_NONE);
	CHECK(iec_type_find("", 0) == IEC_NONE);
	CHECK(iec_type_find("LREAL", 5) == IEC_LREAL);
	CHECK(iec_type_find("tod", 3) == IEC_TIME_OF_DAY);
	CHECK(iec_type_find("LTIME", 5) == IEC_TIME);
	CHECK(iec_type_find("WSTRING", 7) == IEC_NONE);
	CHECK(iec_type_size(IEC_STRING, 5) == 12 && iec_type_size(IEC_INT, 5) == 2);
	CHECK(iec_is_wide(IEC_LWORD) && iec_is_wide(IEC_ULINT) && !iec_is_wide(IEC_LINT));
	CHECK(iec_type_row(IEC_UINT)->high == 65535);
	CHECK(iec_type_row(IEC_SINT)->low == -128);
	CHECK(iec_type_row(IEC_TIME)->size == 8);
	CHECK(iec_type_row(IEC_NONE)->size == 0);
	CHECK(iec_type_row(IEC_TYPE_COUNT)->class == 0);
}

/* The whole table: rows from, columns to, in the order of the enum. */
static void widening(void)
{
	static const char *const table[] = {
		/* to: BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT
		 * ULINT REAL LREAL TIME TIME_OF_DAY DATE DATE_AND_TIME STRING */
		/* BOOL          */ "10000000000000000000",
		/* BYTE          */ "01111000000000000000",
		/* WORD          */ "00111000000000000000",
		/* DWORD         */ "00011000000000000000",
		/* LWORD         */ "00001000000000000000",
		/* SINT          */ "00000111100001100000",
		/* INT           */ "00000011100001100000",
		/* DINT          */ "00000001100000100000",
		/* LINT          */ "00000000100000000000",
		/* USINT         */ "00000011111111100000",
		/* UINT          */ "00000001101111100000",
		/* UDINT         */ "00000000100110100000",
		/* ULINT         */ "00000000000010000000",
		/* REAL          */ "00000000000001100000",
		/* LREAL         */ "00000000000000100000",
		/* TIME          */ "00000000000000010000",
		/* TIME_OF_DAY   */ "00000000000000001000",
		/* DATE          */ "00000000000000000100",
		/* DATE_AND_TIME */ "00000000000000000010",
		/* STRING        */ "00000000000000000001",
	};
	int wrong = 0;

	for (int from = IEC_BOOL; from < IEC_TYPE_COUNT; from++)
		for (int to = IEC_BOOL; to < IEC_TYPE_COUNT; to++) {
			bool want = table[from - 1][to - 1] == '1';

			wrong += iec_can_widen((enum iec_type)from,
					       (enum iec_type)to) != want;
		}
	CHECK(wrong == 0);
	CHECK(!iec_can_widen(IEC_NONE, IEC_INT));
	CHECK(!iec_can_widen(IEC_INT, IEC_NONE));
}

static void areas(void)
{
	bool good = true;

	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		const struct iec_area_row *row = iec_area_row((enum iec_area)i);

		good &= row->least <= row->usual && row->usual <= row->most &&
			row->usual > 0 && row->letters[0];
	}
	CHECK_AS(good, "the usual size of each area is an allowed one");
	CHECK(iec_area_row(AREA_NONE)->most == 0);
	CHECK(iec_area_row(AREA_COUNT)->most == 0);
	CHECK(iec_area_row(AREA_SM)->access == ACCESS_READ);
}

static void addresses(void)
{
	static const struct {
		const char *text;
		enum iec_addr_result result;
		const char *print;
	} table[] = {
		{ "%IX0.3", ADDR_OK, "%IX0.3" }, { "%I0.3", ADDR_OK, "%IX0.3" },
		{ "I0.3", ADDR_OK, "%IX0.3" },   { "I3", ADDR_OK, "%IX0.3" },
		{ "Q10", ADDR_OK, "%QX1.2" },    { "q10", ADDR_OK, "%QX1.2" },
		{ "M5", ADDR_OK, "%MX0.5" },     { "IB0.0", ADDR_OK, "%IX0.0" },
		{ "VB35.6", ADDR_OK, "%VX35.6" }, { "%QB1.7", ADDR_OK, "%QX1.7" },
		{ "%MW4.11", ADDR_OK, "%MX5.3" }, { "MD8.31", ADDR_OK, "%MX11.7" },
		{ "%ML0.63", ADDR_OK, "%MX7.7" }, { "AIW2.15", ADDR_OK, "%AIX3.7" },
		{ "MB0", ADDR_OK, "%MB0" },      { "MW4", ADDR_OK, "%MW4" },
		{ "%md4", ADDR_OK, "%MD4" },     { "V0.3", ADDR_OK, "%VX0.3" },
		{ "VB35", ADDR_OK, "%VB35" },    { "VW36", ADDR_OK, "%VW36" },
		{ "VD40", ADDR_OK, "%VD40" },    { "S5", ADDR_OK, "%SX0.5" },
		{ "SM0.5", ADDR_OK, "%SMX0.5" }, { "SMD8", ADDR_OK, "%SMD8" },
		{ "SB1", ADDR_OK, "%SB1" },      { "AI3", ADDR_OK, "%AIW6" },
		{ "AQ0", ADDR_OK, "%AQW0" },     { "AIW6", ADDR_OK, "%AIW6" },
		{ "XI9", ADDR_OK, "%XIX1.1" },   { "XAQ2", ADDR_OK, "%XAQW4" },
		{ "%XIX0.1", ADDR_OK, "%XIX0.1" }, { "%MW1", ADDR_OK, "%MW1" },
		{ "%IB8191", ADDR_OK, "%IB8191" },
		{ "I65535", ADDR_OK, "%IX8191.7" },
		{ "V4194303", ADDR_OK, "%VX524287.7" },
		{ "AI4095", ADDR_OK, "%AIW8190" }, { "SMB63", ADDR_OK, "%SMB63" },
		{ "%MX3", ADDR_OK, "%MX0.3" },
		{ "%IB8192", ADDR_RANGE, "" },   { "%IW8191", ADDR_RANGE, "" },
		{ "%ID8189", ADDR_RANGE, "" },   { "I65536", ADDR_RANGE, "" },
		{ "V4194304", ADDR_RANGE, "" },  { "AI4096", ADDR_RANGE, "" },
		{ "SMB64", ADDR_RANGE, "" },     { "SMW63", ADDR_RANGE, "" },
		{ "%IX0.8", ADDR_RANGE, "" },    { "%MW4.16", ADDR_RANGE, "" },
		{ "IB0.8", ADDR_RANGE, "" },     { "%MD4.32", ADDR_RANGE, "" },
		{ "%ML8", ADDR_OK, "%ML8" },  { "%ML524281", ADDR_RANGE, "" },
		{ "M4194304", ADDR_RANGE, "" }, { "M4194303", ADDR_OK, "%MX524287.7" },
		{ "%MB99999999999999999999", ADDR_RANGE, "" },
		{ "%IX0.99999999999999", ADDR_RANGE, "" },
		{ "%MX4294967296.0", ADDR_RANGE, "" },
		{ "", ADDR_NONE, "" },      { "%", ADDR_NONE, "" },
		{ "I", ADDR_NONE, "" },     { "%IX", ADDR_NONE, "" },
		{ "Motor", ADDR_NONE, "" }, { "M1x", ADDR_NONE, "" },
		{ "T37", ADDR_NONE, "" },   { "IN1", ADDR_NONE, "" },
		{ "B", ADDR_NONE, "" },     { "B0.3", ADDR_NONE, "" },
		{ "B1", ADDR_NONE, "" },    { "MW4.", ADDR_NONE, "" },
		{ "%B5", ADDR_NONE, "" },   { "ML0", ADDR_NONE, "" },
		{ "%IX0.", ADDR_NONE, "" }, { "%IX.3", ADDR_NONE, "" },
		{ "%IX0.3.1", ADDR_NONE, "" }, { "%IX-1", ADDR_NONE, "" },
		{ "%%IX0.3", ADDR_NONE, "" }, { "%IX0 ", ADDR_NONE, "" },
		{ "XYZ", ADDR_NONE, "" },   { "5", ADDR_NONE, "" },
	};

	for (size_t i = 0; i < sizeof(table) / sizeof(*table); i++) {
		struct iec_addr addr;
		char text[32];
		enum iec_addr_result result =
			iec_addr_parse(table[i].text, strlen(table[i].text),
				       &addr);

		iec_addr_print(addr, text, sizeof(text));
		CHECK_AS(result == table[i].result &&
			 strcmp(text, table[i].print) == 0, table[i].text);
	}
}

static void address_types(void)
{
	struct iec_addr addr;

	iec_addr_parse("%IX0.3", 6, &addr);
	CHECK(iec_addr_type(addr) == IEC_BOOL);
	iec_addr_parse("%IB0", 4, &addr);
	CHECK(iec_addr_type(addr) == IEC_BYTE);
	iec_addr_parse("%IW0", 4, &addr);
	CHECK(iec_addr_type(addr) == IEC_WORD);
	iec_addr_parse("%ID0", 4, &addr);
	CHECK(iec_addr_type(addr) == IEC_DWORD);
	iec_addr_parse("x", 1, &addr);
	CHECK(iec_addr_type(addr) == IEC_NONE);
	addr = (struct iec_addr){ AREA_M, 64, 0, 0 };
	CHECK(iec_addr_type(addr) == IEC_LWORD);
}

static void memory(void)
{
	uint8_t bytes[12];
	bool good = true;

	for (int type = IEC_BOOL; type < IEC_STRING; type++) {
		const struct iec_type_row *row = iec_type_row((enum iec_type)type);
		union iec_value value = { .i = row->low };

		if (row->class == CLASS_REAL)
			value.r = -1.5;
		memset(bytes, 0xee, sizeof(bytes));
		iec_store(bytes + 1, (enum iec_type)type, value);
		good &= bytes[0] == 0xee && bytes[1 + row->size] == 0xee;
		good &= iec_load(bytes + 1, (enum iec_type)type).i == value.i;
		if (row->class == CLASS_REAL)
			continue;
		value.i = row->high;
		iec_store(bytes + 1, (enum iec_type)type, value);
		good &= iec_load(bytes + 1, (enum iec_type)type).i == row->high;
	}
	CHECK_AS(good, "each type is stored unaligned in its own bytes only");
	iec_store(bytes, IEC_DWORD, (union iec_value){ .i = 0x01020304 });
	CHECK_AS(bytes[0] == 4 && bytes[3] == 1, "little-endian");
	iec_store(bytes, IEC_INT, (union iec_value){ .i = 0x18001 });
	CHECK_AS(iec_load(bytes, IEC_INT).i == -32767,
		 "a value that is too large keeps its low bits");
	iec_store(bytes, IEC_BOOL, (union iec_value){ .i = 3 });
	CHECK_AS(bytes[0] == 1, "a BOOL in memory is 0 or 1");
	CHECK(iec_load(bytes, IEC_NONE).i == 0);
	bytes[0] = 0x77;
	iec_store(bytes, IEC_NONE, (union iec_value){ .i = 3 });
	CHECK(bytes[0] == 0x77);
}

static const char *real(double value)
{
	static char text[40];

	iec_value_print(IEC_REAL, (union iec_value){ .r = value }, text,
			sizeof(text));
	return text;
}

static const char *whole(enum iec_type type, int64_t value)
{
	static char text[40];

	iec_value_print(type, (union iec_value){ .i = value }, text,
			sizeof(text));
	return text;
}

static void prints(void)
{
	char cut[4];

	CHECK_TEXT(real(0), "0");
	CHECK_TEXT(real(-0.0), "-0");
	CHECK_TEXT(real(1), "1");
	CHECK_TEXT(real(0.1f), "0.1");
	CHECK_TEXT(real(-2.5), "-2.5");
	CHECK_TEXT(real(100000), "100000");
	CHECK_TEXT(real(1e6), "1e+06");
	CHECK_TEXT(real(1e-5f), "1e-05");
	CHECK_TEXT(real(0.0001f), "0.0001");
	CHECK_TEXT(real(16777216), "16777216");
	CHECK_TEXT(real(1.0f / 3), "0.33333334");
	CHECK_TEXT(real(3.4028234663852886e38), "3.4028235e+38");
	CHECK_TEXT(real((double)INFINITY), "inf");
	CHECK_TEXT(real(-(double)INFINITY), "-inf");
	CHECK_TEXT(real((double)NAN), "nan");
	CHECK_TEXT(whole(IEC_BOOL, 1), "1");
	CHECK_TEXT(whole(IEC_INT, -32768), "-32768");
	CHECK_TEXT(whole(IEC_DWORD, 4294967295), "4294967295");
	CHECK_TEXT(whole(IEC_TIME, 1500000000), "1500");
	CHECK_TEXT(whole(IEC_TIME, 250000), "0.25");
	CHECK_TEXT(whole(IEC_TIME, 25), "0.000025");
	CHECK_TEXT(whole(IEC_TIME, -1000001), "-1.000001");
	CHECK_TEXT(whole(IEC_TIME, INT64_MIN), "-9223372036854.775808");
	CHECK_TEXT(whole(IEC_NONE, 5), "");
	CHECK(iec_value_print(IEC_DINT, (union iec_value){ .i = 123456 }, cut,
			      sizeof(cut)) == 6);
	CHECK_TEXT(cut, "123");
}

/* Random bit patterns of a float read back as the same float. */
static void reals_read_back(void)
{
	uint32_t seed = 12345;
	int wrong = 0;

	for (int i = 0; i < 20000; i++) {
		float value;

		seed = seed * 1664525u + 1013904223u;
		memcpy(&value, &seed, sizeof(value));
		if (!isfinite(value))
			continue;
		wrong += strtof(real((double)value), NULL) != value;
	}
	CHECK(wrong == 0);
}

static const char *lreal(double value)
{
	static char text[64];

	iec_value_print(IEC_LREAL, (union iec_value){ .r = value }, text,
			sizeof(text));
	return text;
}

static void prints_lreals(void)
{
	CHECK_TEXT(lreal(0.1), "0.1");
	CHECK_TEXT(lreal(0.1 + 0.2), "0.30000000000000004");
	CHECK_TEXT(lreal(-1.7976931348623157e308), "-1.7976931348623157e+308");
	CHECK_TEXT(lreal(2.2250738585072014e-308), "2.2250738585072014e-308");
	CHECK_TEXT(lreal(4.9406564584124654e-324), "5e-324");
	CHECK_TEXT(lreal(1e-310), "1e-310");
	CHECK_TEXT(lreal(123456789.0), "123456789");
	CHECK_TEXT(lreal(9007199254740993.0), "9007199254740992");
	CHECK_TEXT(real(1.401298464324817e-45), "1e-45");
	CHECK(strtod(lreal(4.9406564584124654e-324), NULL) > 0);
}

/* Prints and reads random bits, also subnormals. */
static void lreals_read_back(void)
{
	uint64_t bits = 0x9e3779b97f4a7c15u;
	int wrong = 0;

	for (int i = 0; i < 50000; i++) {
		double value, back;

		bits = bits * 6364136223846793005u + 1442695040888963407u;
		if (i % 3 == 0) /* subnormal */
			bits &= ~(UINT64_C(0x7ff) << 52);
		memcpy(&value, &bits, sizeof(value));
		if (!isfinite(value))
			continue;
		back = strtod(lreal(value), NULL);
		wrong += memcmp(&back, &value, sizeof(value)) != 0;
	}
	CHECK_AS(wrong == 0, "every LREAL reads back from its text");
}

static void prints_dates(void)
{
	CHECK_TEXT(whole(IEC_DATE_AND_TIME, 0), "1970-01-01-00:00:00");
	CHECK_TEXT(whole(IEC_DATE_AND_TIME, -1), "1969-12-31-23:59:59.999999999");
	CHECK_TEXT(whole(IEC_DATE_AND_TIME, INT64_MAX), "2262-04-11-23:47:16.854775807");
	CHECK_TEXT(whole(IEC_DATE_AND_TIME, INT64_MIN), "1677-09-21-00:12:43.145224192");
	CHECK_TEXT(whole(IEC_DATE, INT64_MIN), "1677-09-21");
	CHECK_TEXT(whole(IEC_DATE, INT64_MAX), "2262-04-11");
	CHECK_TEXT(whole(IEC_DATE, INT64_C(-86400000000000)), "1969-12-31");
	CHECK_TEXT(whole(IEC_DATE, INT64_C(951782400000000000)), "2000-02-29");
	CHECK_TEXT(whole(IEC_TIME_OF_DAY, INT64_C(86399999999999)), "23:59:59.999999999");
	CHECK_TEXT(whole(IEC_TIME_OF_DAY, -1), "23:59:59.999999999");
	CHECK_TEXT(whole(IEC_TIME_OF_DAY, INT64_MAX), "23:47:16.854775807");
	CHECK_TEXT(whole(IEC_ULINT, -1), "18446744073709551615");
	CHECK_TEXT(whole(IEC_LINT, INT64_MIN), "-9223372036854775808");
}

static void the_calendar(void)
{
	int64_t ns = 4711;
	bool good = true;

	for (int64_t day = -106751; day <= 106751 && good; day++) {
		int year, month, of_month;

		iec_civil(day, &year, &month, &of_month);
		good = iec_days(year, month, of_month) == day;
	}
	CHECK_AS(good, "each day gives a date that gives the same day");
	CHECK(iec_date(2024, 2, 29, &ns) && !iec_date(2023, 2, 29, &ns) &&
	      !iec_date(1900, 2, 29, &ns) && iec_date(2000, 2, 29, &ns));
	CHECK(!iec_date(2024, 0, 1, &ns) && !iec_date(2024, 13, 1, &ns) &&
	      !iec_date(2024, 1, 0, &ns) && !iec_date(2024, 4, 31, &ns));
	CHECK(!iec_date(1677, 9, 21, &ns) && iec_date(1677, 9, 22, &ns) &&
	      iec_date(2262, 4, 11, &ns) && !iec_date(2262, 4, 12, &ns));
	CHECK(!iec_date(-1, 1, 1, &ns) && !iec_date(INT64_MAX, 1, 1, &ns));
}

static void texts(void)
{
	struct iec_text room;
	struct iec_string *s = iec_text_init(&room, IEC_STRING_MOST);
	char out[IEC_VALUE_TEXT];

	memset(s->text, 1, IEC_STRING_MOST);
	CHECK(iec_value_print(IEC_STRING, (union iec_value){ .s = s }, out,
			      sizeof(out)) == (int)sizeof(out) - 1);
	CHECK(strlen(out) == sizeof(out) - 1 && out[sizeof(out) - 2] == '\'');
	s->length = 0;
	iec_value_print(IEC_STRING, (union iec_value){ .s = s }, out, sizeof(out));
	CHECK_TEXT(out, "''");
}

int main(void)
{
	types();
	widening();
	areas();
	addresses();
	address_types();
	memory();
	prints();
	prints_lreals();
	lreals_read_back();
	prints_dates();
	the_calendar();
	texts();
	reals_read_back();
	return tap_done();
}
