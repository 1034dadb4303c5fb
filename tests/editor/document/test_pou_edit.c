/* SPDX-License-Identifier: MIT
 *
 * test_pou_edit - programs and blocks are added, duplicated, moved and deleted: each as one
 * step, and the text of all others stays as it is, byte by byte.
 */
#include "editor-gtk/document/pou_edit.h"

#include "tests/editor/texts.h"
#include "tests/tap.h"

#include <string.h>

static const char PROGRAM[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Lamp AT %QX0.0 : BOOL;\n  Shared : Seal;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  One : Seal;\n  Other : Seal;\n  Delay : TON;\nEND_VAR\n"
	"RUNG\n  | NO %IX0.0 | Seal One | COIL Lamp |\n"
	"RUNG\n  | Seal Other | TON Delay PT:=T#1s | Seal Shared | COIL %QX0.1 |\n"
	"RUNG\n  | NO One.Q | COIL %QX0.2 |\n"
	"END_PROGRAM\n\n"
	"PROGRAM List IL\nVAR\n  Se : Seal;\nEND_VAR\n"
	"  LD %IX0.3\n  Twice Lamp\n  ST %QX0.3\nEND_PROGRAM\n\n"
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  IN : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\n"
	"END_VAR\nRUNG\n  | NO IN | COIL Q |\nEND_FUNCTION_BLOCK\n\n"
	"FUNCTION Twice : BOOL LD\nVAR_INPUT\n  IN : BOOL;\n  X : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO X | COIL Twice |\nEND_FUNCTION\n";

static LadderDocument *document;

static int pou_of(const char *name)
{
	return project_find_pou(ladder_document_project(document), name, strlen(name));
}

static void test_block(void)
{
	char *before = ladder_document_text(document, NULL);

	CHECK_AS(pou_uses(document, pou_of("Seal")) > 0,
		 "the uses of a block are counted");
	CHECK(pou_uses(document, pou_of("Main")) == 0);
	CHECK_AS(!pou_delete(document, pou_of("Seal")), "a used block is deleted");
	CHECK_AS(ladder_document_project(document) && pou_of("Seal") < 0 && !document_has(document, "Seal"),
		 "deleting a block deletes its boxes and instances");
	CHECK_AS(document_has(document, "| NO %IX0.0 | COIL Lamp |") && document_has(document, "| TON Delay PT:=T#1s | COIL %QX0.1 |"),
		 "the line is closed where a deleted box was");
	CHECK_AS(document_has(document, "NO One.Q") && document_has(document, "Delay : TON"),
		 "deleting a block keeps other elements");
	CHECK(ladder_document_undo(document));
	CHECK_AS(document_has(document, before) && !ladder_document_undo_name(document), "one undo restores all");
	g_free(before);
}

static void test_function(void)
{
	CHECK(!pou_delete(document, pou_of("Twice")));
	CHECK_AS(!document_has(document, "Twice") && document_has(document, "  LD    %IX0.3\n  ST    %QX0.3\n"),
		 "lines of lists that call it are deleted");
	CHECK(ladder_document_undo(document) && document_has(document, "Twice "));
}

/* ---- order ---- */

/* POUs of all kinds with comments in all places, and other parts between them. */
static const char *const PARTS[] = {
	"VAR\n  Lamp  AT %QX0.0 : BOOL;\n  Total : INT;\nEND_VAR\n",
	"(* the first *)\nPROGRAM One LD\nVAR\n  D : TON; // delay\nEND_VAR\n"
	"(* seal *)\nRUNG Here \"Title\"\n  | NO %IX0.0 (* in *) | TON D PT:=T#1s | COIL Lamp |\n"
	"(* the end *)\nEND_PROGRAM\n",
	"// a line\nPROGRAM Two IL\n  LD    %IX0.1 (* typed *)\n  ST    %QX0.1\nEND_PROGRAM\n",
	"(* adds *)\n(* twice *)\nFUNCTION Sum : INT LD\nVAR_INPUT\n  A : INT;\n  B : INT;\n"
	"END_VAR\nRUNG\n  | ADD IN1:=A IN2:=B OUT=>Sum |\nEND_FUNCTION\n",
	"TYPE\n  Pair : STRUCT\n    X : INT; (* left *)\n  END_STRUCT;\nEND_TYPE\n",
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  On : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\n"
	"END_VAR\nRUNG\n  | NO On | COIL Q |\nEND_FUNCTION_BLOCK\n",
	"PROGRAM Three SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n",
	"SUBROUTINE Sub LD\nRUNG\n  | NO %IX0.2 | COIL %QX0.2 |\nEND_SUBROUTINE\n",
	"VIEW\n  bookmark One 1\nEND_VIEW\n",
};
enum { PARTS_COUNT = G_N_ELEMENTS(PARTS) };
/* The part of each POU, by its number. */
static const int part_of[] = { 1, 2, 3, 5, 6, 7 };

static char *joined(const int *order)
{
	GString *text = g_string_new("RUNGBOARD 1\nPROJECT \"Order\"\n");

	for (int i = 0; i < PARTS_COUNT; i++)
		g_string_append_printf(text, "\n%s", PARTS[order[i]]);
	return g_string_free(text, FALSE);
}

/* Makes the same move in the model, which is an order of parts. */
static void move_part(int *order, int part, int beside, bool behind)
{
	int others[PARTS_COUNT], count = 0, to = 0;

	for (int i = 0; i < PARTS_COUNT; i++)
		if (order[i] != part)
			others[count++] = order[i];
	for (int i = 0; i < count; i++) {
		if (others[i] == beside && !behind)
			order[to++] = part;
		order[to++] = others[i];
		if (others[i] == beside && behind)
			order[to++] = part;
	}
}

static char *text_now(void)
{
	return ladder_document_text(document, NULL);
}

static bool is_text(const char *text)
{
	char *now = text_now();
	const bool same = strcmp(now, text) == 0;

	if (!same)
		printf("# is:\n%s\n# expected:\n%s\n", now, text);
	g_free(now);
	return same;
}

static int part_of_pou_now(int pou)
{
	static const char *const name[] = { "One", "Two", "Sum", "Seal", "Three", "Sub" };
	const struct project *project = ladder_document_project(document);

	for (int i = 0; i < (int)G_N_ELEMENTS(name); i++)
		if (strcmp(project_text(project, project->pou[pou].name), name[i]) == 0)
			return part_of[i];
	return -1;
}

static void test_order(void)
{
	GRand *chance = g_rand_new_with_seed(7);
	int order[PARTS_COUNT];
	char *first, *before, *after;
	bool good = true;

	for (int i = 0; i < PARTS_COUNT; i++)
		order[i] = i;
	first = joined(order);
	ladder_document_open_text(document, NULL, first, strlen(first), true);
	CHECK_AS(is_text(first), "the example is in canonical form");
	for (int i = 0; good && i < 200; i++) {
		const int pou = g_rand_int_range(chance, 0, 6);
		const int beside = g_rand_int_range(chance, 0, 6);
		const bool behind = g_rand_boolean(chance);

		if (pou == beside)
			continue;
		before = text_now();
		move_part(order, part_of_pou_now(pou), part_of_pou_now(beside), behind);
		after = joined(order);
		good = !pou_move(document, pou, beside, behind) && is_text(after);
		if (good && strcmp(before, after) != 0)
			good = ladder_document_undo(document) && is_text(before) &&
			       ladder_document_redo(document) && is_text(after);
		g_free(before);
		g_free(after);
	}
	CHECK_AS(good, "each move gives the expected bytes and is one undo");
	before = text_now();
	CHECK_AS(!pou_move(document, 0, 0, true) && is_text(before), "beside itself it stays");
	g_free(before);
	while (ladder_document_undo(document))
		;
	CHECK_AS(is_text(first), "undo restores the first text");
	CHECK_AS(pou_beside(document, 0, -1) < 0 && pou_beside(document, 0, 1) == 1 &&
		 pou_beside(document, 1, 1) == 4 && pou_beside(document, 4, 1) < 0 &&
		 pou_beside(document, 2, -1) < 0 && pou_beside(document, 2, 1) == 3 &&
		 pou_beside(document, 3, 1) == 5, "programs stand beside programs");
	CHECK_AS(pou_order_counts(document),
		 "pou_order_counts() is true without a CONFIGURATION");
	g_free(first);
	g_rand_free(chance);
}

/* ---- duplicates ---- */

static char *with_copy(int part, const char *copy)
{
	GString *text = g_string_new("RUNGBOARD 1\nPROJECT \"Order\"\n");

	for (int i = 0; i < PARTS_COUNT; i++)
		g_string_append_printf(text, i == part ? "\n%s\n%s" : "\n%s", PARTS[i], copy);
	return g_string_free(text, FALSE);
}

static void test_duplicates(void)
{
	static const struct { const char *heading, *copied; } copies[] = {
		{ "PROGRAM One ", "PROGRAM One_2 " }, { "PROGRAM Two ", "PROGRAM Two_2 " },
		{ "FUNCTION Sum ", "FUNCTION Sum_2 " }, { "BLOCK Seal ", "BLOCK Seal_2 " },
		{ "PROGRAM Three ", "PROGRAM Three_2 " }, { "SUBROUTINE Sub ", "SUBROUTINE Sub_2 " },
	};
	char *first = text_now();

	for (int i = 0; i < (int)G_N_ELEMENTS(copies); i++) {
		GString *copy = g_string_new(PARTS[part_of[i]]);
		char *name = pou_copy_name(document, i), *expected, *why;

		g_string_replace(copy, copies[i].heading, copies[i].copied, 0);
		g_string_replace(copy, "OUT=>Sum ", "OUT=>Sum_2 ", 0);
		expected = with_copy(part_of[i], copy->str);
		why = pou_duplicate(document, i, name);
		CHECK_AS(!why && is_text(expected), "a copy differs only in its name");
		ladder_document_check_now(document);
		CHECK_AS(!ladder_document_diags(document)->errors, "the copy builds");
		CHECK(ladder_document_undo(document) && is_text(first));
		g_free(why);
		g_free(expected);
		g_free(name);
		g_string_free(copy, TRUE);
	}
	g_free(first);
}

/* ---- names ---- */

static bool is_refused(enum pou_kind kind, const char *name, const char *part)
{
	char *why = pou_name_refusal(document, kind, name);
	char *first = text_now();
	char *added = pou_add(document, kind, LANGUAGE_LD, name);
	const bool good = why && strstr(why, part) && added && is_text(first);

	g_free(added);
	g_free(first);
	g_free(why);
	return good;
}

static void test_names(void)
{
	static const enum pou_kind kinds[] = { POU_PROGRAM, POU_FUNCTION, POU_BLOCK,
					       POU_SUBROUTINE };
	char *first = text_now();

	CHECK(is_refused(POU_PROGRAM, "", "Enter a name"));
	CHECK(is_refused(POU_PROGRAM, "2nd", "not a name"));
	CHECK(is_refused(POU_PROGRAM, "a b", "not a name"));
	CHECK(is_refused(POU_PROGRAM, "END_VAR", "word of the language"));
	CHECK(is_refused(POU_BLOCK, "ton", "word of the language"));
	CHECK(is_refused(POU_PROGRAM, "ONE", "a program or block"));
	CHECK(is_refused(POU_FUNCTION, "lamp", "a symbol"));
	CHECK(is_refused(POU_BLOCK, "Pair", "a data type"));
	for (int kind = 0; kind < (int)G_N_ELEMENTS(kinds); kind++)
		for (int language = LANGUAGE_LD; language <= LANGUAGE_SFC; language++) {
			char *name = pou_free_name(document, kinds[kind]), *why;

			if (language == LANGUAGE_SFC && kinds[kind] != POU_PROGRAM && kinds[kind] != POU_BLOCK) {
				g_free(name);
				continue;
			}
			why = pou_add(document, kinds[kind], (enum pou_language)language, name);
			CHECK_AS(!why && document_has(document, name), name);
			ladder_document_check_now(document);
			CHECK_AS(!ladder_document_diags(document)->errors,
				 "a new POU builds");
			CHECK(ladder_document_undo(document) && is_text(first));
			g_free(why);
			g_free(name);
		}
	g_free(first);
}

/* Deleting a program deletes its PROGRAM line. */
static void test_program(void)
{
	static const char text[] = "RUNGBOARD 1\n\nCONFIGURATION Plant\n"
		"  TASK Fast (INTERVAL := T#5ms, PRIORITY := 1);\n"
		"  PROGRAM A WITH Fast : Main;\n  PROGRAM B : Other;\nEND_CONFIGURATION\n\n"
		"PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n\n"
		"PROGRAM Other LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";
	LadderDocument *kept = document;

	document = ladder_document_new();
	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK(!pou_delete(document, pou_of("Other")));
	CHECK_AS(!document_has(document, "Other") && document_has(document, "PROGRAM A WITH Fast : Main;\nEND_CONFIGURATION"),
		 "a program is deleted with its PROGRAM line");
	CHECK(ladder_document_undo(document) && document_has(document, text) && !ladder_document_undo_name(document));
	g_object_unref(document);
	document = kept;
}

int main(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, PROGRAM, strlen(PROGRAM), true);
	if (CHECK(ladder_document_project(document))) {
		test_block();
		test_function();
		test_program();
	}
	test_order();
	test_duplicates();
	test_names();
	g_object_unref(document);
	return tap_done();
}
