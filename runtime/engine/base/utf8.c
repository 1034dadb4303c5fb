/* SPDX-License-Identifier: MIT
 *
 * utf8 - validity of UTF-8 text, length and width of a character (see lex.h).
 *
 * It does not convert, compare or normalise.
 */
#include "engine/base/lex.h"

#include <stdint.h>
#include <string.h>

/* RFC 3629: no overlong forms, no surrogates, nothing past U+10FFFF. */
size_t utf8_length(const char *text, size_t len)
{
	const unsigned char *s = (const unsigned char *)text;
	unsigned char low = 0x80, high = 0xbf;
	size_t need;

	if (len == 0)
		return 0;
	if (s[0] < 0x80)
		return 1;
	if (s[0] < 0xc2 || s[0] > 0xf4)
		return 0;
	need = s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : 4;
	if (len < need)
		return 0;
	if (s[0] == 0xe0)
		low = 0xa0;
	else if (s[0] == 0xed)
		high = 0x9f;
	else if (s[0] == 0xf0)
		low = 0x90;
	else if (s[0] == 0xf4)
		high = 0x8f;
	if (s[1] < low || s[1] > high)
		return 0;
	for (size_t i = 2; i < need; i++)
		if (s[i] < 0x80 || s[i] > 0xbf)
			return 0;
	return need;
}

bool utf8_valid(const char *text, size_t len, size_t *bad)
{
	size_t at = 0;

	while (at < len) {
		size_t step;

		if ((unsigned char)text[at] - 1u < 0x7f) {
			at++;
			continue;
		}
		step = text[at] ? utf8_length(text + at, len - at) : 0;
		if (step == 0) {
			if (bad)
				*bad = at;
			return false;
		}
		at += step;
	}
	return true;
}

bool utf16_text(const char *text, size_t len)
{
	if (len < 4)
		return false;
	if (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0)
		return true;
	return !text[0] == !text[2] && !text[1] == !text[3] && !text[0] != !text[1];
}

uint32_t utf8_code(const char *text, size_t len)
{
	static const unsigned char first[] = { 0, 0x7f, 0x1f, 0x0f, 0x07 };
	uint32_t code = (unsigned char)text[0] & first[len];

	for (size_t i = 1; i < len; i++)
		code = code << 6 | ((unsigned char)text[i] & 0x3f);
	return code;
}

struct range {
	uint32_t first, last;
};

/* Unicode: combining marks and zero-width characters of the common scripts. */
static const struct range narrow[] = {
	{ 0x0300, 0x036f }, { 0x0483, 0x0489 }, { 0x0591, 0x05bd },
	{ 0x0610, 0x061a }, { 0x064b, 0x065f }, { 0x06d6, 0x06dc },
	{ 0x093c, 0x093c }, { 0x0941, 0x0948 }, { 0x094d, 0x094d },
	{ 0x0e31, 0x0e31 }, { 0x0e34, 0x0e3a }, { 0x0e47, 0x0e4e },
	{ 0x1ab0, 0x1aff }, { 0x1dc0, 0x1dff }, { 0x200b, 0x200f },
	{ 0x202a, 0x202e }, { 0x2060, 0x2064 }, { 0x20d0, 0x20f0 },
	{ 0x302a, 0x302d }, { 0x3099, 0x309a }, { 0xfe00, 0xfe0f },
	{ 0xfe20, 0xfe2f }, { 0xfeff, 0xfeff }, { 0xe0100, 0xe01ef },
};

/* Unicode TR 11: wide and full-width. */
static const struct range wide[] = {
	{ 0x1100, 0x115f }, { 0x231a, 0x231b }, { 0x2329, 0x232a },
	{ 0x23e9, 0x23ec }, { 0x2e80, 0x303e }, { 0x3041, 0x33ff },
	{ 0x3400, 0x4dbf }, { 0x4e00, 0x9fff }, { 0xa000, 0xa4cf },
	{ 0xa960, 0xa97c }, { 0xac00, 0xd7a3 }, { 0xf900, 0xfaff },
	{ 0xfe30, 0xfe6f }, { 0xff00, 0xff60 }, { 0xffe0, 0xffe6 },
	{ 0x1f300, 0x1f64f }, { 0x1f680, 0x1f6ff }, { 0x1f900, 0x1f9ff },
	{ 0x20000, 0x3fffd },
};

static bool is_in(const struct range *range, size_t count, uint32_t c)
{
	for (size_t i = 0; i < count && range[i].first <= c; i++)
		if (c <= range[i].last)
			return true;
	return false;
}

static uint32_t decode(const char *text, size_t len)
{
	const unsigned char *s = (const unsigned char *)text;
	uint32_t c = len == 2 ? s[0] & 0x1fu :
		     len == 3 ? s[0] & 0x0fu : s[0] & 0x07u;

	for (size_t i = 1; i < len; i++)
		c = c << 6 | (s[i] & 0x3fu);
	return c;
}

int utf8_width(const char *text, size_t len)
{
	int width = 0;

	while (len) {
		size_t step = utf8_length(text, len);

		if (step > 1) {
			uint32_t c = decode(text, step);

			if (is_in(wide, sizeof(wide) / sizeof(*wide), c))
				width += 2;
			else if (!is_in(narrow,
					sizeof(narrow) / sizeof(*narrow), c))
				width++;
		} else {
			width++;
			step = 1;
		}
		text += step;
		len -= step;
	}
	return width;
}
