/* SPDX-License-Identifier: MIT
 *
 * test_diag - messages keep their place, their codes are unique, and hostile
 * arguments cannot reach a terminal.
 */
#include "engine/base/diag.h"
#include "engine/base/lex.h"
#include "tests/tap.h"

static struct diag_list list;

static void prints(void)
{
	struct diag place = { .id = DIAG_NOT_LAST, .file = "pump.rung",
			      .line = 14, .rung = 3, .row = 2, .col = 5 };
	char text[200], cut[10];
	int len;

	diag_init(&list);
	CHECK(!diag_add(&list, place, "%s", "%QX0.1"));
	len = diag_print(&list.diag[0], text, sizeof(text));
	CHECK_TEXT(text, "pump.rung:14: rung 3 (2,5): error LD203: "
			 "\"%QX0.1\" must be last on its branch; "
			 "put what follows on a branch of its own");
	CHECK(len == (int)strlen(text));
	CHECK(diag_print(&list.diag[0], cut, sizeof(cut)) == len);
	CHECK_TEXT(cut, "pump.rung");
	CHECK(diag_print(&list.diag[0], NULL, 0) == len);

	place = (struct diag){ .id = DIAG_COIL_TWICE, .file = "a", .line = 2,
			       .column = 7 };
	CHECK_AS(diag_add(&list, place, "%s", "Motor"),
		 "diag_add() returns true for a warning");
	diag_print(&list.diag[1], text, sizeof(text));
	CHECK_TEXT(text, "a:2:7: warning LD310: "
			 "\"Motor\" is written by coils in more than one place; the last one wins");
	place = (struct diag){ .id = DIAG_EMPTY_RUNG, .pou = "Main", .rung = 4 };
	diag_add(&list, place, "%s", "");
	diag_print(&list.diag[2], text, sizeof(text));
	CHECK_TEXT(text, "Main: rung 4: warning LD207: rung is empty; delete it or add a coil");
	place = (struct diag){ .id = DIAG_EMPTY_FILE, .file = "b.rung" };
	diag_add(&list, place, "%s", "");
	diag_print(&list.diag[3], text, sizeof(text));
	CHECK_TEXT(text, "b.rung: error LD101: file is empty");
	CHECK(list.count == 4 && list.errors == 2);
}

static void name_alone(void)
{
	struct diag diag = { .id = DIAG_UNKNOWN_NAME, .arg = "Haet" DIAG_AND "Heat" };

	CHECK(diag_name_length(&diag) == 4);
	diag = (struct diag){ .id = DIAG_NEEDS_CONVERSION, .arg = DIAG_AND "INT" DIAG_AND "REAL" };
	CHECK(diag_name_length(&diag) == 0);
}

static const char *filled(const char *text, const char *arg)
{
	static char out[100];
	int len = diag_fill(text, arg, out, sizeof(out));

	return len == (int)strlen(out) ? out : "the returned length is wrong";
}

static void fills_in_parts(void)
{
	CHECK_TEXT(filled("plain", ""), "plain");
	CHECK_TEXT(filled("", "one" DIAG_AND "two"), "one: two");
	CHECK_TEXT(filled("plain", "one"), "plain: one");
	CHECK_TEXT(filled("plain", "one" DIAG_AND "two"), "plain: one: two");
	CHECK_TEXT(filled("%1 at %2", "one" DIAG_AND "two"), "one at two");
	CHECK_TEXT(filled("%2 before %1", "one" DIAG_AND "two"), "two before one");
	CHECK_TEXT(filled("%1{ of %2}{, %3}", "one"), "one");
	CHECK_TEXT(filled("%1{ of %2}{, %3}", "one" DIAG_AND DIAG_AND "three"), "one, three");
	CHECK_TEXT(filled("{%1: }text", ""), "text");
	CHECK_TEXT(filled("{%1: }text", "one" DIAG_AND "two"), "one: text: two");
	CHECK_TEXT(filled("100% {open", "%1"), "100% open: %1");
}

static const char *argument(const char *text)
{
	struct diag place = { .id = DIAG_SYNTAX, .arg = "ignored" };

	diag_init(&list);
	diag_add(&list, place, "%s", text);
	return list.diag[0].arg;
}

static void cleans_arguments(void)
{
	char text[300] = "";

	CHECK_TEXT(argument(""), "");
	CHECK_TEXT(argument("a\033[2Jb\n\x7f"), "a?[2Jb??");
	CHECK_TEXT(argument("\xc2\x9bx"), "?x");
	CHECK_TEXT(argument("\xff" "a\xc3"), "?a?");
	CHECK_TEXT(argument("T\xc3\xbcr"), "T\xc3\xbcr");
	memset(text, 'x', 250);
	CHECK(strlen(argument(text)) == LIMIT_ARG - 1);
	for (int lead = 0; lead < 4; lead++) {
		const char *arg;
		size_t len = (size_t)lead;

		memset(text, 0, sizeof(text));
		memset(text, 'x', len);
		for (; len < 100; len += 4)
			memcpy(text + len, "\xf0\x9f\x94\xa7", 4);
		arg = argument(text);
		CHECK_AS(utf8_valid(arg, strlen(arg), NULL) &&
			 strlen(arg) > LIMIT_ARG - 5,
			 "a long argument is cut between two characters");
	}
}

static void counts_beyond_its_limit(void)
{
	struct diag error = { .id = DIAG_SYNTAX };
	struct diag warning = { .id = DIAG_UNUSED };

	diag_init(&list);
	for (int i = 0; i < LIMIT_DIAGS + 10; i++)
		diag_add(&list, error, "%d", i);
	CHECK(diag_add(&list, warning, "%s", "x"));
	CHECK(list.count == LIMIT_DIAGS);
	CHECK(list.dropped == 11);
	CHECK(list.errors == LIMIT_DIAGS + 10);
	CHECK_TEXT(list.diag[LIMIT_DIAGS - 1].arg, "99");
}

static void shows_errors_before_warnings(void)
{
	struct diag error = { .id = DIAG_SYNTAX };
	struct diag warning = { .id = DIAG_UNUSED };

	diag_init(&list);
	diag_add(&list, error, "first");
	for (int i = 0; i < LIMIT_DIAGS; i++)
		diag_add(&list, warning, "%d", i);
	CHECK(!diag_add(&list, error, "last"));
	CHECK(list.count == LIMIT_DIAGS && list.errors == 2);
	CHECK(list.dropped == 2);
	CHECK_TEXT(list.diag[0].arg, "first");
	CHECK_TEXT(list.diag[LIMIT_DIAGS - 2].arg, "97");
	CHECK_TEXT(list.diag[LIMIT_DIAGS - 1].arg, "last");
}

static void codes_are_unique(void)
{
	static const char *codes[DIAG_COUNT], *texts[DIAG_COUNT];
	bool unique = true, differ = true, shaped = true;

	for (int i = 0; i < DIAG_COUNT; i++) {
		const char *code = codes[i] = diag_code((enum diag_id)i);

		shaped &= strlen(code) == 5 && strncmp(code, "LD", 2) == 0 &&
			  strspn(code + 2, "0123456789") == 3 && diag_text((enum diag_id)i)[0] != '\0';
		texts[i] = diag_text((enum diag_id)i);
		for (int k = 0; k < i; k++) {
			unique &= strcmp(codes[k], code) != 0;
			differ &= strcmp(texts[k], texts[i]) != 0;
		}
	}
	CHECK(unique);
	CHECK_AS(differ, "the texts of all messages differ");
	CHECK(shaped);
	CHECK_TEXT(diag_code(DIAG_COUNT), "LD000");
	CHECK(diag_severity(DIAG_COUNT) == SEVERITY_ERROR);
	CHECK_TEXT(diag_text(DIAG_COUNT), "");
	CHECK(diag_severity(DIAG_NEVER_READ) == SEVERITY_WARNING);
}

int main(void)
{
	prints();
	name_alone();
	fills_in_parts();
	cleans_arguments();
	counts_beyond_its_limit();
	shows_errors_before_warnings();
	codes_are_unique();
	return tap_done();
}
