/* SPDX-License-Identifier: MIT
 *
 * dialect - tables of the addresses of STEP 7, Logix, GX Works, Omron and ClassicLadder; see dialect.h.
 */
#include "engine/model/dialect.h"

#include "engine/base/ascii.h"
#include "engine/base/catalog.h"

#include <stdio.h>
#include <string.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

/* Digits of base @base; -1: none, or too many. */
static int number(const char **at, const char *end, int base)
{
	int value = 0, count = 0;

	for (; *at < end && **at >= '0' && **at < '0' + base && count < 6; ++*at, count++)
		value = value * base + (**at - '0');
	return count > 0 && (*at == end || !ascii_digit(**at)) ? value : -1;
}

static bool put_bit(enum iec_area area, int bit, struct iec_addr *out)
{
	*out = (struct iec_addr){ area, 1, (uint8_t)(bit % 8), (uint32_t)(bit / 8) };
	return out->byte < iec_area_row(area)->most;
}

/* ---- Mitsubishi and Siemens ---- */

/* X0 … X7 are the same in octal and hexadecimal; beyond they are not. */
static bool find_octal(const char *text, size_t len, struct dialect *out)
{
	const enum iec_area area = ascii_upper(text[0]) == 'X' ? AREA_I : AREA_Q;
	const char *at = text + 1;
	int bit, octal;

	if ((ascii_upper(text[0]) != 'X' && ascii_upper(text[0]) != 'Y') || len < 2)
		return false;
	bit = number(&at, text + len, 10);
	if (bit < 0 || at != text + len)
		return false;
	out->kind = bit > 7 ? DIALECT_UNSURE : DIALECT_ADDRESS;
	if (bit <= 7)
		return put_bit(area, bit, &out->addr);
	at = text + 1;
	octal = number(&at, text + len, 8);
	bit = bit / 10 * 16 + bit % 10;
	put_bit(area, octal >= 0 && at == text + len ? octal : bit, &out->addr);
	put_bit(area, bit, &out->other);
	return true;
}

/* D0, a word; T37, C0. They have the letter of no address of ours. */
static bool find_number(const char *text, size_t len, struct dialect *out)
{
	const char letter = ascii_upper(text[0]);
	const char *at = text + 1;
	const int value = number(&at, text + len, 10);

	if (value < 0 || at != text + len || len >= sizeof(out->name))
		return false;
	snprintf(out->name, sizeof(out->name), "%.*s", (int)len, text);
	if (letter == 'D') {
		out->kind = DIALECT_WORD;
		out->type = IEC_INT;
		out->addr = (struct iec_addr){ AREA_V, 16, 0, (uint32_t)value * 2 };
	} else if (letter == 'T' || letter == 'C') {
		out->kind = DIALECT_BLOCK;
		out->word = letter == 'T' ? "TON" : "CTU";
		out->pin = "Q";
	} else {
		return false;
	}
	return true;
}

/* E0.0 and A4.0 of the German STEP 7. */
static bool find_german(const char *text, size_t len, struct dialect *out)
{
	const char letter = ascii_upper(text[0]);
	char other[24];

	if ((letter != 'E' && letter != 'A') || len < 4 || len >= sizeof(other) ||
	    !ascii_digit(text[1]) || !memchr(text, '.', len))
		return false;
	snprintf(other, sizeof(other), "%c%.*s", letter == 'E' ? 'I' : 'Q', (int)len - 1, text + 1);
	out->kind = DIALECT_ADDRESS;
	return iec_addr_parse(other, len, &out->addr) == ADDR_OK;
}

/* Logix and SLC: I:1/3 is bit 3 of the second word of inputs. */
static bool find_slash(const char *text, size_t len, struct dialect *out)
{
	static const struct { const char *head; enum iec_area area; } heads[] = {
		{ "I:", AREA_I }, { "O:", AREA_Q }, { "B3:", AREA_M },
	};
	const char *end = text + len;

	for (size_t i = 0; i < COUNT(heads); i++) {
		const size_t n = ascii_prefix(heads[i].head, text, len);
		const char *at = text + n;
		int word, bit;

		if (n == 0)
			continue;
		word = number(&at, end, 10);
		if (word < 0 || at >= end || (*at != '/' && *at != '.'))
			return false;
		at++;
		bit = number(&at, end, 10);
		out->kind = DIALECT_ADDRESS;
		return bit >= 0 && bit < 16 && at == end &&
		       put_bit(heads[i].area, word * 16 + bit, &out->addr);
	}
	return false;
}

/* ---- Omron ---- */

/* CIO0.05, W3.11: a word and one of its 16 bits, with two digits. Inputs begin at 0 and outputs at 100; what lies
 * between is one or the other. */
static bool find_channel(const char *text, size_t len, struct dialect *out)
{
	const bool work = ascii_same(text, "W", 1);
	const char *end = text + len, *at = text + (work ? 1 : 3);
	int word, bit;

	if (len < 5 || (!work && !ascii_same(text, "CIO", 3)) || !ascii_digit(*at))
		return false;
	word = number(&at, end, 10);
	if (word < 0 || end - at != 3 || *at++ != '.' || !ascii_digit(*at))
		return false;
	bit = number(&at, end, 10);
	if (bit < 0 || bit > 15 || (!work && ((word > 9 && word < 100) || word > 199)))
		return false;
	out->kind = DIALECT_ADDRESS;
	return put_bit(work ? AREA_M : word < 100 ? AREA_I : AREA_Q, (work ? word : word % 100) * 16 + bit, &out->addr);
}

/* ---- ClassicLadder ---- */

#define CLASSIC_TIMER      "T", "CL_TIMER"
#define CLASSIC_MONOSTABLE "Mono", "CL_MONO"
#define CLASSIC_IEC_TIMER  "TM", "CL_TON"
#define CLASSIC_COUNTER    "C", "CL_COUNTER"
#define CLASSIC_REGISTER   "Reg", "CL_REGISTER"

static const struct memory_row { const char *prefix, *area; int first, size; } memory_rows[] = {
#define CLASSIC_MEMORY(type, prefix, area, first, size, name) { prefix, area, first, size },
#include "engine/classic.def"
};

/* %TM0.Q is the pin Q of TM0; a step %X3.A is a BOOL X3, or the step Step3 or S3. */
static const struct pin_row { const char *prefix, *attribute, *name, *word, *pin; } pin_rows[] = {
#define CLASSIC_PIN(type, prefix, attribute, kind, pin, is_bool) \
	{ prefix, attribute, kind, pin },
#define CLASSIC_STEP(type, attribute, name, pin) { "X", attribute, name, "", pin }, \
	{ "X", attribute, "Step", "", sizeof(pin) == 1 ? "X" : "T" }, \
	{ "X", attribute, "S", "", sizeof(pin) == 1 ? "X" : "T" },
#include "engine/classic.def"
};

/* The parts of %TM0.V, or of TM0.V, which has no sign. */
struct parts {
	const char *prefix, *attribute; /* attribute: NULL: there is none      */
	size_t prefix_len, attribute_len;
	int number;
};

static bool take_apart(const char *text, size_t len, struct parts *out)
{
	const char *end = text + len, *at = text + (len > 0 && *text == '%');

	*out = (struct parts){ .prefix = at };
	while (at < end && ((*at >= 'A' && *at <= 'Z') || (*at >= 'a' && *at <= 'z')))
		at++;
	out->prefix_len = (size_t)(at - out->prefix);
	out->number = number(&at, end, 10);
	if (out->prefix_len == 0 || out->number < 0 || (at < end && *at != '.'))
		return false;
	if (at < end) {
		out->attribute = at + 1;
		out->attribute_len = (size_t)(end - at) - 1;
	}
	return true;
}

/* %B3, %W5, %QLED1. */
static bool find_memory(const struct parts *parts, struct dialect *out)
{
	char address[40];

	for (size_t i = 0; i < COUNT(memory_rows); i++) {
		const struct memory_row *row = &memory_rows[i];
		const int bit = row->first + parts->number * row->size;

		if (!ascii_is(row->prefix, parts->prefix, parts->prefix_len))
			continue;
		if (row->size == 1)
			snprintf(address, sizeof(address), "%%%sX%d.%d", row->area, bit / 8, bit % 8);
		else
			snprintf(address, sizeof(address), "%%%sD%d", row->area, bit / 8);
		out->kind = DIALECT_ADDRESS;
		return iec_addr_parse(address, strlen(address), &out->addr) == ADDR_OK;
	}
	return false;
}

/* %TM0.Q: row @index of those that fit. */
static bool find_pin(const struct parts *parts, int index, struct dialect *out)
{
	for (size_t i = 0; i < COUNT(pin_rows); i++) {
		const struct pin_row *row = &pin_rows[i];

		if (!ascii_is(row->prefix, parts->prefix, parts->prefix_len) ||
		    !ascii_is(row->attribute, parts->attribute, parts->attribute_len) || index-- > 0)
			continue;
		out->kind = *row->word ? DIALECT_PIN : DIALECT_STEP;
		out->word = row->word;
		out->pin = row->pin;
		snprintf(out->name, sizeof(out->name), "%s%d", row->name, parts->number);
		return true;
	}
	return false;
}

/* TM0.Q as an import writes it, T37.ET and C0.CV. */
static bool find_own_pin(const struct parts *parts, struct dialect *out)
{
	const int len = (int)parts->prefix_len;

	out->kind = DIALECT_PIN;
	snprintf(out->name, sizeof(out->name), "%.*s%d", len < 8 ? len : 8, parts->prefix,
		 parts->number);
	for (size_t i = 0; i < COUNT(pin_rows); i++)
		if (*pin_rows[i].word &&
		    ascii_is(pin_rows[i].name, parts->prefix, parts->prefix_len) &&
		    ascii_is(pin_rows[i].pin, parts->attribute, parts->attribute_len)) {
			out->word = pin_rows[i].word;
			out->pin = pin_rows[i].pin;
			return true;
		}
	if (len != 1 || (ascii_upper(*parts->prefix) != 'T' && ascii_upper(*parts->prefix) != 'C'))
		return false;
	out->word = ascii_upper(*parts->prefix) == 'T' ? "TON" : "CTU";
	const struct word_row *row = word_row(word_find(out->word, strlen(out->word)));
	const int pin = word_pin_find(row, parts->attribute, parts->attribute_len);

	if (pin >= 0 && pin < row->pin_count)
		out->pin = row->pin[pin].name;
	return out->pin;
}

/* ---- what other tools set by themselves ---- */

/* One name. */
static const struct { const char *name, *tool, *ours; } special_names[] = {
	{ "M8000", "GX Works", "SYS_ALWAYS_ON" }, { "M8002", "GX Works", "SYS_FIRST_SCAN" },
	{ "M8012", "GX Works", "SYS_CLOCK_100MS" }, { "M8013", "GX Works", "SYS_CLOCK_1S" },
	{ "M8014", "GX Works", "SYS_CLOCK_1MIN" },
	{ "SM400", "GX Works", "SYS_ALWAYS_ON" }, { "SM402", "GX Works", "SYS_FIRST_SCAN" },
	{ "SM410", "GX Works", "SYS_CLOCK_100MS" }, { "SM412", "GX Works", "SYS_CLOCK_1S" },
	{ "SM0.3", "STEP 7-Micro/WIN", "" }, { "SM0.6", "STEP 7-Micro/WIN", "" },
	{ "SM0.7", "STEP 7-Micro/WIN", "" }, { "SM1.0", "STEP 7-Micro/WIN", "" },
	{ "SM1.1", "STEP 7-Micro/WIN", "" }, { "SM1.2", "STEP 7-Micro/WIN", "" },
	{ "%S0", "ClassicLadder", "SYS_CLOCK_1S" }, { "%S4", "ClassicLadder", "SYS_FIRST_SCAN" },
	{ "%S7", "ClassicLadder", "SYS_MATH_ERROR" },
	{ "S:FS", "Logix", "SYS_FIRST_SCAN" }, { "S:1/15", "Logix", "SYS_FIRST_SCAN" },
	{ "S:V", "Logix", "" }, { "S:C", "Logix", "" }, { "S:Z", "Logix", "" }, { "S:N", "Logix", "" },
	{ "S:MINOR", "Logix", "" },
};

/* A head and a number without a dot. */
static const struct { const char *head; int low, high; const char *tool; } special_ranges[] = {
	{ "M", 8000, 8511, "GX Works" }, { "D", 8000, 8511, "GX Works" },
	{ "SM", 0, 9999, "GX Works" }, { "SD", 0, 9999, "GX Works" },
	{ "%S", 0, 255, "ClassicLadder" }, { "%SW", 0, 255, "ClassicLadder" },
};

/* S:4/0: a bit or word of the status file. */
static bool is_status(const char *text, size_t len)
{
	const char *at = text + 2, *end = text + len;

	if (len < 3 || ascii_upper(text[0]) != 'S' || text[1] != ':' || number(&at, end, 10) < 0)
		return false;
	return at == end || (*at++ == '/' && number(&at, end, 10) >= 0 && at == end);
}

bool dialect_special(const char *text, size_t len, struct dialect_special *out)
{
	for (size_t i = 0; i < COUNT(special_names); i++)
		if (ascii_is(special_names[i].name, text, len)) {
			*out = (struct dialect_special){ special_names[i].tool, special_names[i].ours };
			return true;
		}
	if (is_status(text, len)) {
		*out = (struct dialect_special){ "Logix", "" };
		return true;
	}
	for (size_t i = 0; i < COUNT(special_ranges); i++) {
		const size_t head = ascii_prefix(special_ranges[i].head, text, len);
		const char *at = text + head;
		const int value = head ? number(&at, text + len, 10) : -1;

		if (value >= special_ranges[i].low && value <= special_ranges[i].high && at == text + len) {
			*out = (struct dialect_special){ special_ranges[i].tool, "" };
			return true;
		}
	}
	return false;
}

static bool find(const char *text, size_t len, int index, struct dialect *out)
{
	struct parts parts;

	if (*text == '%')
		return take_apart(text, len, &parts) &&
		       (parts.attribute ? find_pin(&parts, index, out) :
					  index == 0 && find_memory(&parts, out));
	return index == 0 && (find_octal(text, len, out) || find_number(text, len, out) ||
			      find_german(text, len, out) || find_slash(text, len, out) || find_channel(text, len, out) ||
			      (take_apart(text, len, &parts) && parts.attribute &&
			       find_own_pin(&parts, out)));
}

bool dialect_find(const char *text, size_t len, int index, struct dialect *out)
{
	memset(out, 0, sizeof(*out));
	if (len >= 2 && find(text, len, index, out))
		return true;
	memset(out, 0, sizeof(*out));
	return false;
}

bool dialect_is_data_block(const char *text, size_t len)
{
	const char *at = text, *end = text + len;

	if (len < 7 || !ascii_same(at, "DB", 2))
		return false;
	at += 2;
	if (number(&at, end, 10) < 0 || end - at < 5 || !ascii_same(at, ".DB", 3) || !strchr("XBWDxbwd", at[3]))
		return false;
	at += 4;
	if (number(&at, end, 10) < 0)
		return false;
	return at == end || (*at++ == '.' && number(&at, end, 10) >= 0 && at == end);
}

static bool is_word(char c)
{
	return ascii_digit(c) || (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z') || c == '_';
}

size_t dialect_around(const char *begin, const char *end, const char *colon, const char **from)
{
	const char *to = colon + 1;

	for (*from = colon; *from > begin && is_word((*from)[-1]);)
		--*from;
	while (to < end && (is_word(*to) || (*to == '/' && to + 1 < end && is_word(to[1]))))
		to++;
	return (size_t)(to - *from);
}
