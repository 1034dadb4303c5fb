/* SPDX-License-Identifier: MIT
 *
 * test_plain_lines - places of the canonical text in a text as it was typed.
 */
#include "editor-gtk/document/text_lines.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

static int line_of(const char *shown, const char *canonical, int line)
{
	text_lines_place(shown, canonical, &line, NULL);
	return line;
}

/* 100,000 equal lines, with indents. */
static void many(void)
{
	enum { COUNT = 100000 };
	char *shown = malloc(COUNT * 6 + 1), *canonical = malloc(COUNT * 5 + 1);
	const clock_t begin = clock();
	int good = 0;

	for (int i = 0; i < COUNT; i++) {
		memcpy(shown + i * 6, "LD  A\n", 7);
		memcpy(canonical + i * 5, "LD A\n", 6);
	}
	for (int line = 0; line < COUNT; line += COUNT / 20)
		good += line_of(shown, canonical, line) == line;
	CHECK(good == 20);
	CHECK_AS(clock() - begin < 5 * CLOCKS_PER_SEC, "the time is linear in the number of lines");
	free(shown);
	free(canonical);
}

/* "0 1 - 3": for each line of @shown its line in @other. */
static const char *matched(const char *shown, const char *other)
{
	static char out[200];
	int count, *found = text_lines_match(shown, other, &count);
	size_t len = 0;

	out[0] = '\0';
	for (int i = 0; found && i < count; i++)
		len += (size_t)snprintf(out + len, sizeof(out) - len, found[i] < 0 ? "%s-" : "%s%d",
					i ? " " : "", found[i]);
	free(found);
	return out;
}

static void all_lines(void)
{
	CHECK_TEXT(matched("P\n\n  a  b\n c\nEND", "P\nA b\nc\nEND\n"), "0 - 1 2 3");
	CHECK_TEXT(matched("P\na\nb\nc\nEND\n", "P\na\nx\ny\nc\nEND\n"), "0 1 - 4 5 -");
	CHECK_TEXT(matched("P\na\na\na\nEND\n", "P\na\na\nEND\n"), "0 1 2 - 3 -");
	CHECK_TEXT(matched("(* of P *)\nP\na\nEND\n", "P\na\nEND\n\nQ\na\nEND\n"), "- 0 1 2 -");
	CHECK_TEXT(matched("x", "P\na\nEND\n"), "-");
	CHECK_TEXT(matched("", "P\n"), "-");
	CHECK_TEXT(matched("P\n", ""), "- -");
}

int main(void)
{
	static const char canonical[] =
		"PROGRAM P IL\nVAR\n  A : BOOL;\nEND_VAR\n  LD    A\n  ST    B\n"
		"  LD    A\n  ST    C\nEND_PROGRAM\n";
	static const char typed[] =
		"\nprogram P IL\nVAR\n\nA:BOOL;\nEND_VAR\n\n\nld A\nST B\n\n    LD A\nST C\n"
		"END_PROGRAM";
	int line = 6, column = 8;

	for (int i = 0; i < 9; i++)
		CHECK(line_of(canonical, canonical, i) == i);
	CHECK(line_of(typed, canonical, 0) == 1);
	CHECK(line_of(typed, canonical, 2) == 4);
	CHECK(line_of(typed, canonical, 4) == 8);
	CHECK(line_of(typed, canonical, 5) == 9);
	CHECK(line_of(typed, canonical, 7) == 12);
	text_lines_place(typed, canonical, &line, &column);
	CHECK_AS(line == 11 && column == 10, "the nearest line with the same words, and its "
		 "column behind another indent");
	CHECK_AS(line_of("A\n\nB\nC\n", "x\ny\nz\n", 1) == 2,
		 "without equal words the line with the same number is taken");
	CHECK_AS(line_of("A\nB\n", "x\ny\nz\nv\nw\n", 4) == 1,
		 "the line is at most the last one");
	CHECK_AS(line_of("", "x\ny\n", 1) == 1 && line_of("a\n", "", 7) == 7,
		 "in an empty text the line number is kept");
	CHECK_AS(line_of("x\n  st  GRÖSSE\nld GRÖßE\n", "x\n  LD Größe\n  ST Größe\n", 1) == 2,
		 "names are compared by Unicode");
	many();
	all_lines();
	return tap_done();
}
