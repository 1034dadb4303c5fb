/* SPDX-License-Identifier: MIT
 *
 * test_text_range - the lines of boxes and actions in the text of their POU.
 */
#include "editor-gtk/document/text_range.h"
#include "tests/tap.h"

#include <string.h>

#define HEAD "PROGRAM Main LD\nRUNG\n  | EXECUTE Add | EXECUTE |\n"
#define ADD "  EXECUTE Add:\n    A := A + 1; (* END_EXECUTE *)\n    B := 2;\n  END_EXECUTE\n"
#define PLAIN "  EXECUTE:\n    C := 3;\n  END_EXECUTE\n"
#define ACTION "ACTION Count:\n  D := 4;\nEND_ACTION\n"

static bool takes(struct text_range *range, const char *text, int line, const char *name, int lines)
{
	return text_range_take(range, text, line) && strcmp(range->name, name) == 0 &&
	       range->lines == lines;
}

static bool finds(struct text_range *range, const char *text, const char *shown, const char *want)
{
	char *found = text_range_find(range, text, shown);
	const bool same = g_strcmp0(found, want) == 0;

	g_free(found);
	return same;
}

static bool joins(const struct text_range *range, const char *shown, const char *want)
{
	char *whole = text_range_whole(range, shown);
	const bool same = strcmp(whole, want) == 0;

	g_free(whole);
	return same;
}

static void lines(void)
{
	struct text_range range;

	text_range_init(&range);
	CHECK_AS(joins(&range, "abc", "abc") && finds(&range, "abc", "", "abc"), "no part: the whole text");
	CHECK(takes(&range, HEAD ADD PLAIN "END_PROGRAM\n", 3, "Add", 4));
	CHECK(takes(&range, HEAD ADD PLAIN "END_PROGRAM\n", 6, "Add", 4));
	CHECK(takes(&range, HEAD ADD PLAIN "END_PROGRAM\n", 8, "", 8) && range.number == 1 && range.count == 2);
	CHECK_AS(!text_range_take(&range, HEAD ADD PLAIN "END_PROGRAM\n", 1) && range.lines == 8, "a line of a rung is in no part");
	CHECK_AS(takes(&range, "PROGRAM Main SFC\nACTION Do:\nRUNG\n | EXECUTE Add |\n" ADD "END_ACTION\n", 5, "Add", 5) &&
		 takes(&range, "PROGRAM Main SFC\nACTION Do:\nRUNG\n | EXECUTE Add |\n" ADD "END_ACTION\n", 2, "Do", 2), "the innermost one");
	CHECK(takes(&range, "(* more *)\n" ACTION, text_range_heading("(* more *)\n" ACTION), "Count", 2));
	CHECK(takes(&range, "ACTION Pump.Reset\n  D := 4;\nEND_ACTION\n", 0, "Pump.Reset", 1));
	text_range_clear(&range);
}

static void again(void)
{
	struct text_range range;

	text_range_init(&range);
	CHECK(takes(&range, HEAD ADD PLAIN "END_PROGRAM\n", 4, "Add", 4));
	CHECK(finds(&range, HEAD ADD PLAIN "END_PROGRAM\n", "", "    A := A + 1; (* END_EXECUTE *)\n    B := 2;"));
	CHECK_AS(joins(&range, "(* END_EXECUTE", HEAD "  EXECUTE Add:\n(* END_EXECUTE\n  END_EXECUTE\n" PLAIN "END_PROGRAM\n") &&
		 finds(&range, HEAD "  EXECUTE Add:\n(* END_EXECUTE\n  END_EXECUTE\n" PLAIN "END_PROGRAM\n", "", "(* END_EXECUTE"),
		 "a comment without end stays in its part");
	CHECK_AS(joins(&range, "x\n", HEAD "  EXECUTE Add:\nx\n\n  END_EXECUTE\n" PLAIN "END_PROGRAM\n") &&
		 finds(&range, HEAD "  EXECUTE Add:\nx\n\n  END_EXECUTE\n" PLAIN "END_PROGRAM\n", "", "x\n"), "an empty last line is kept");
	CHECK_AS(joins(&range, "", HEAD "  EXECUTE Add:\n  END_EXECUTE\n" PLAIN "END_PROGRAM\n") &&
		 finds(&range, HEAD "  EXECUTE Add:\n  END_EXECUTE\n" PLAIN "END_PROGRAM\n", "", ""), "no line at all");
	CHECK_AS(finds(&range, HEAD PLAIN ADD "END_PROGRAM\n", "", "    A := A + 1; (* END_EXECUTE *)\n    B := 2;") &&
		 range.number == 1 && range.lines == 7, "a part that moves is found by its name");
	CHECK_AS(finds(&range, HEAD PLAIN "  EXECUTE Sum:\n    B := 3;\n  END_EXECUTE\nEND_PROGRAM\n", "", "    B := 3;") &&
		 strcmp(range.name, "Sum") == 0, "with another name by its number");
	CHECK_AS(finds(&range, HEAD PLAIN "END_PROGRAM\n", "    B := 3;", NULL) && strcmp(range.name, "Sum") == 0, "a deleted part is not found");
	CHECK_AS(finds(&range, HEAD PLAIN ADD "  EXECUTE:\n    B := 3;\n  END_EXECUTE\nEND_PROGRAM\n", "    B := 3;", "    B := 3;") &&
		 range.number == 2, "with another name and number by its text");
	text_range_clear(&range);
}

int main(void)
{
	lines();
	again();
	return tap_done();
}
