/* SPDX-License-Identifier: MIT
 *
 * test_plain_lines - places of the canonical text in a text as it was typed.
 */
#include "editor-gtk/text_lines.h"
#include "tests/tap.h"

#include <stddef.h>

static int line_of(const char *shown, const char *canonical, int line)
{
	text_lines_place(shown, canonical, &line, NULL);
	return line;
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
	CHECK_AS(line == 11 && column == 10, "the nearer of two that say the same, and its "
		 "column behind another indent");
	CHECK_AS(line_of("A\n\nB\nC\n", "x\ny\nz\n", 1) == 2, "as many lines before it");
	CHECK_AS(line_of("A\nB\n", "x\ny\nz\nv\nw\n", 4) == 1, "not behind the last one");
	CHECK_AS(line_of("", "x\ny\n", 1) == 1 && line_of("a\n", "", 7) == 7,
		 "nothing to go by: left alone");
	return tap_done();
}
