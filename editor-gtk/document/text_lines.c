/* SPDX-License-Identifier: MIT
 *
 * text_lines - finds a line of the canonical text in the text as it was typed.
 */
#include "editor-gtk/document/text_lines.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const char *next_line(const char *at)
{
	const char *end = strchr(at, '\n');

	return end ? end + 1 : NULL;
}

static int indent(const char *at)
{
	int count = 0;

	while (at[count] == ' ' || at[count] == '\t' || at[count] == '\r')
		count++;
	return count;
}

static bool is_blank(const char *at)
{
	at += indent(at);
	return *at == '\n' || !*at;
}

static bool is_space(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

/* Same words, with other blanks and in any case. */
static bool says_same(const char *a, const char *b)
{
	for (;;) {
		a += indent(a);
		b += indent(b);
		while (*a && *a != '\n' && !is_space(*a) &&
		       toupper((unsigned char)*a) == toupper((unsigned char)*b)) {
			a++;
			b++;
		}
		if ((!*a || *a == '\n') && (!*b || *b == '\n'))
			return true;
		if (!is_space(*a) && !is_space(*b))
			return false;
		/* Skips a blank that only one of them has. */
	}
}

static const char *line_at(const char *text, int line)
{
	while (text && line-- > 0)
		text = next_line(text);
	return text;
}

/* Counts the non-blank lines before it. */
static int full_before(const char *text, int line)
{
	int count = 0;

	for (; text && line > 0; line--, text = next_line(text))
		count += !is_blank(text);
	return count;
}

void text_lines_place(const char *shown, const char *canonical, int *line, int *column)
{
	const char *wanted = line_at(canonical, *line), *best_at = NULL;
	const int full = full_before(canonical, *line);
	int best = -1, nearest = 0, count = 0, number = 0;
	bool best_same = false;

	if (!wanted || strcmp(shown, canonical) == 0)
		return;
	for (const char *at = shown; at; at = next_line(at), number++) {
		bool same;
		int distance;

		if (is_blank(at))
			continue;
		same = says_same(at, wanted);
		distance = abs(count++ - full);
		if (best < 0 || (same && !best_same) ||
		    (same == best_same && distance < nearest)) {
			best = number;
			nearest = distance;
			best_at = at;
			best_same = same;
		}
	}
	if (best < 0)
		return;
	*line = best;
	if (column && *column >= indent(wanted))
		*column += indent(best_at) - indent(wanted);
}

int text_lines_count(const char *text)
{
	int count = 0;

	for (; *text; text++)
		count += *text == '\n';
	return count;
}
