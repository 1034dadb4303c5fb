/* SPDX-License-Identifier: MIT
 *
 * mend_number - a comma that is a point, points between thousands, units of times.
 *
 * The brackets around a comma decide whether it separates two values.
 */
#include "engine/text/mend_number.h"

#include "engine/base/ascii.h"

#include <stdio.h>
#include <string.h>

/* Behind a number: units of other tools. */
static const struct { const char *from, *to; } units[] = {
	{ "ms", "ms" }, { "msec", "ms" }, { "s", "s" }, { "sec", "s" }, { "secs", "s" },
	{ "second", "s" }, { "seconds", "s" }, { "m", "m" }, { "min", "m" }, { "mins", "m" },
	{ "minute", "m" }, { "minutes", "m" }, { "h", "h" }, { "hour", "h" }, { "hours", "h" },
	{ "us", "us" }, { "d", "d" }, { "days", "d" },
};

bool mend_is_word(char c)
{
	return ascii_digit(c) || c == '_' || (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z') ||
	       (unsigned char)c >= 0x80;
}

size_t mend_word_length(const char *text)
{
	size_t len = 0;

	while (mend_is_word(text[len]))
		len++;
	return len;
}

static size_t digits(const char *text)
{
	size_t len = 0;

	while (ascii_digit(text[len]))
		len++;
	return len;
}

size_t mend_groups(const char *line, size_t at, char *out, size_t size)
{
	const char *text = line + at;
	const size_t first = digits(text);
	const char apart = text[first];
	size_t len = first, used = first;
	int groups = 0;

	if (!first || first > 3 || !apart || !strchr("., ", apart) || size < 40 ||
	    (at && (mend_is_word(line[at - 1]) || strchr(".,%", line[at - 1]))))
		return 0;
	memcpy(out, text, first);
	while (text[len] == apart && digits(text + len + 1) == 3 && used + 4 < size) {
		memcpy(out + used, text + len + 1, 3);
		used += 3;
		len += 4;
		groups++;
	}
	out[used] = '\0';
	const bool fraction = text[len] != apart && (text[len] == '.' || text[len] == ',') &&
			      ascii_digit(text[len + 1]);

	if (!groups || (groups < 2 && !fraction && apart != ' '))
		return 0;
	if (fraction) {
		const size_t part = digits(text + len + 1);

		if (used + part + 2 > size)
			return 0;
		snprintf(out + used, size - used, ".%.*s", (int)part, text + len + 1);
		len += 1 + part;
	}
	return mend_is_word(text[len]) || text[len] == '.' ||
	       (text[len] == ',' && ascii_digit(text[len + 1])) ? 0 : len;
}

size_t mend_unit(const char *line, size_t at, size_t len, char *out, size_t size)
{
	const char *text = line + at;
	const size_t gap = text[len] == ' ', unit = mend_word_length(text + len + gap);

	for (size_t i = 0; unit && i < sizeof(units) / sizeof(*units) && len < 12; i++) {
		if (!ascii_is(units[i].from, text + len + gap, unit))
			continue;
		snprintf(out, size, "%s%.*s%s", at > 1 && text[-1] == '#' ? "" : "T#", (int)len,
			 text, units[i].to);
		return len + gap + unit;
	}
	return 0;
}

int mend_bracket(const char *line, size_t at)
{
	int open = 0;

	for (size_t i = at; i-- > 0;) {
		if (line[i] == ')' || line[i] == ']')
			open++;
		else if ((line[i] == '(' || line[i] == '[') && open-- == 0)
			return (int)i;
	}
	return -1;
}

/* Is `name :=` before it, since the last comma or the bracket at @from? */
static bool is_named(const char *line, size_t from, size_t at)
{
	int open = 0;

	for (size_t i = at; i-- > from + 1;) {
		if (line[i] == ')' || line[i] == ']')
			open++;
		else if (line[i] == '(' || line[i] == '[')
			open--;
		else if (!open && line[i] == ',')
			return false;
		else if (!open && line[i] == '=' && line[i - 1] == ':')
			return true;
	}
	return false;
}

/* Is it the ( of n( … )? */
static bool is_repeat(const char *line, size_t open)
{
	size_t from = open;

	while (from && ascii_digit(line[from - 1]))
		from--;
	return line[open] == '(' && from < open && !(from && mend_is_word(line[from - 1]));
}

bool mend_separates(const char *line, size_t at, bool declares)
{
	const int open = mend_bracket(line, at);
	const bool behind_word = open > 0 && mend_is_word(line[open - 1]);

	if (open < 0 || is_repeat(line, (size_t)open) || is_named(line, (size_t)open, at))
		return false;
	return behind_word || (line[open] == '[' && declares);
}

/* Is the comma at @at between the arguments of a call, or the values of a list? */
static bool is_between(const char *line, int at, bool declares)
{
	const int open = mend_bracket(line, (size_t)at);

	return mend_separates(line, (size_t)at, declares) &&
	       (line[open] == '(' || !mend_is_word(line[open - 1]));
}

/* Is the comma at @at between two digits? */
static bool is_tight(const char *line, int at)
{
	return at > 0 && line[at] == ',' && ascii_digit(line[at - 1]) && ascii_digit(line[at + 1]);
}

/* Behind the number at @at. */
static int behind_number(const char *line, int at)
{
	while (mend_is_word(line[at]) || (line[at] == '.' && ascii_digit(line[at + 1])))
		at++;
	return at;
}

/* From the number before the comma at @comma: how many numbers follow one another, each behind a
 * comma without a blank. */
static int count_row(const char *line, int comma)
{
	int count = 1;

	while (is_tight(line, comma)) {
		count++;
		comma = behind_number(line, comma + 1);
	}
	return count;
}

int mend_next_decimal(const char *line, int from, int open, bool declares)
{
	for (int at = from; line[at]; at++) {
		if (!is_tight(line, at) || !is_between(line, at, declares) ||
		    (open >= 0 && mend_bracket(line, (size_t)at) != open))
			continue;
		if (count_row(line, at) % 2 == 0)
			return at;
		while (is_tight(line, at)) /* this row is left alone */
			at = behind_number(line, at + 1);
		at--;
	}
	return -1;
}
