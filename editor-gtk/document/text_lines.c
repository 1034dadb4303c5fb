/* SPDX-License-Identifier: MIT
 *
 * text_lines - finds a line of the canonical text in the text as it was typed.
 */
#include "editor-gtk/document/text_lines.h"

#include "engine/base/name.h"

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

static size_t name_length(const char *at)
{
	size_t len = 0;

	while (isalnum((unsigned char)at[len]) || at[len] == '_' || at[len] & 0x80)
		len++;
	return len;
}

/* Same words, with other blanks, and spelled in another way. */
static bool says_same(const char *a, const char *b)
{
	for (;;) {
		size_t a_len, b_len;

		a += indent(a);
		b += indent(b);
		a_len = name_length(a);
		b_len = name_length(b);
		if (a_len && b_len) {
			if (!name_same(a, a_len, b, b_len))
				return false;
			a += a_len;
			b += b_len;
			continue;
		}
		if ((!*a || *a == '\n') && (!*b || *b == '\n'))
			return true;
		if (*a != *b)
			return false;
		a++;
		b++;
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

/* ---- all lines of two texts ---- */

/* A line that is not blank. */
struct full { const char *at; int number; };
struct lines { struct full *line; int count; };

static bool take_lines(const char *text, struct lines *out)
{
	struct full line = { text, 0 };

	out->count = 0;
	out->line = malloc((size_t)(text_lines_count(text) + 1) * sizeof(*out->line));
	for (; out->line && line.at; line.at = next_line(line.at), line.number++)
		if (!is_blank(line.at))
			out->line[out->count++] = line;
	return out->line;
}

/* The first line with these words; 0: there is none. */
static int first_same(const struct lines *lines, const char *words)
{
	for (int i = 0; i < lines->count; i++)
		if (says_same(lines->line[i].at, words))
			return i;
	return 0;
}

/* @a from its line @from on is @b up to its line @end, but for what was edited. */
static void match(const struct lines *a, int from, const struct lines *b, int end, int *found)
{
	const int len = a->count - from < end ? a->count - from : end;
	int before = 0, behind = 0;

	for (; before < len; before++) {
		const struct full *x = &a->line[from + before], *y = &b->line[before];

		if (!says_same(x->at, y->at))
			break;
		found[x->number] = y->number;
	}
	for (; behind < len - before; behind++) {
		const struct full *x = &a->line[a->count - 1 - behind];
		const struct full *y = &b->line[end - 1 - behind];

		if (!says_same(x->at, y->at))
			break;
		found[x->number] = y->number;
	}
}

int *text_lines_match(const char *shown, const char *other, int *count)
{
	struct lines a = { 0 }, b = { 0 };
	int *found = malloc((size_t)(text_lines_count(shown) + 1) * sizeof(*found));
	bool good = found && take_lines(shown, &a) && take_lines(other, &b);

	*count = text_lines_count(shown) + 1;
	for (int i = 0; good && i < *count; i++)
		found[i] = -1;
	if (good && a.count && b.count) {
		const int last = first_same(&b, a.line[a.count - 1].at);

		match(&a, first_same(&a, b.line[0].at), &b, last ? last + 1 : b.count, found);
	}
	free(a.line);
	free(b.line);
	if (!good)
		free(found);
	return good ? found : NULL;
}
