/* SPDX-License-Identifier: MIT
 *
 * test_type_edit - structures are added, duplicated and deleted, and members moved: each in
 * one step, and the rest of the file stays.
 */
#include "editor-gtk/document/symbols.h"
#include "editor-gtk/document/type_edit.h"

#include "tests/editor/opened.h"
#include "tests/tap.h"

static const char PROGRAM[] =
	"RUNGBOARD 1\nPROJECT \"Types\"\n\n"
	"(* of the mixer *)\n"
	"TYPE\n"
	"  Bounds : STRUCT\n    Low  : INT := 10; (* least *)\n    High : INT;\n  END_STRUCT;\n"
	"  Recipe : STRUCT\n    Speed : INT;\n    Limit : Bounds;\n    Wait  : TIME;\n"
	"  END_STRUCT; (* shown *)\n"
	"  Box : STRUCT\n    Only : Recipe;\n  END_STRUCT;\n"
	"END_TYPE\n\n"
	"VAR\n  Now  : Recipe;\n  All  : ARRAY[1..3] OF Recipe := [3(Speed := 1)];\n"
	"  Last : INT;\n  Low  : Bounds;\nEND_VAR\n\n"
	"FUNCTION Least : Bounds LD\nVAR_INPUT\n  Of1 : Recipe;\nEND_VAR\n"
	"RUNG\n  | MOVE IN:=Of1.Limit OUT=>Least |\nEND_FUNCTION\n\n"
	"PROGRAM Main LD\nRUNG\n  | [ Now.Speed > 1 ] | COIL %QX0.0 |\nEND_PROGRAM\n";

static LadderDocument *document;
static char *why; /* of the last refusal                                   */

static char *text_now(void)
{
	return ladder_document_text(document, NULL);
}

static bool has(const char *part)
{
	char *text = text_now();
	const bool found = strstr(text, part);

	if (!found)
		printf("# %s\n", text);
	g_free(text);
	return found;
}

static bool has_text(const char *wanted)
{
	char *text = text_now();
	const bool is = strcmp(text, wanted) == 0;

	if (!is)
		printf("# %s\n", text);
	g_free(text);
	return is;
}

static void begin(const char *text)
{
	g_clear_object(&document);
	document = opened(text);
}

/* One Undo gives the file back, and there was no other step. */
static void undone(const char *what)
{
	CHECK_AS(ladder_document_undo(document) && has_text(PROGRAM) &&
		 !ladder_document_undo_name(document), what);
}

static void refused(bool good, const char *what)
{
	CHECK_AS(!good && why && *why && has_text(PROGRAM), what);
	printf("# %s\n", why ? why : "");
	g_free(why);
}

static void test_add(void)
{
	static const char plain[] = "RUNGBOARD 1\nPROJECT \"A\"\n\nVAR\n  A : INT;\n"
		"END_VAR\n\nPROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n";
	begin(PROGRAM);
	CHECK_AS(type_add(document, "Batch", &why) &&
		 has("  Box : STRUCT\n    Only : Recipe;\n  END_STRUCT;\n  Batch : STRUCT\n"
		     "    Member1 : INT;\n  END_STRUCT;\nEND_TYPE\n"),
		 "a structure is added after the others");
	CHECK(type_find(document, "bATCH") == 3);
	undone("one undo removes the added structure");
	refused(type_add(document, "recipe", &why), "a name of another structure");
	refused(type_add(document, "Main", &why), "a name of a program");
	refused(type_add(document, "Last", &why), "a name of a symbol");
	refused(type_add(document, "INT", &why), "a name of a type");
	refused(type_add(document, "TON", &why), "a name of a block");
	refused(type_add(document, "COIL", &why), "a word of cells");
	refused(type_add(document, "2b", &why), "a text that is no name");
	refused(type_add(document, "", &why), "an empty name");
	begin(plain);
	CHECK_AS(type_add(document, "Batch", &why) &&
		 has("PROJECT \"A\"\n\nTYPE\n  Batch : STRUCT\n    Member1 : INT;\n"
		     "  END_STRUCT;\nEND_TYPE\n\nVAR\n"),
		 "the first structure is added before the variables");
}

static void test_duplicate(void)
{
	char *name;

	begin(PROGRAM);
	name = type_free_name(document, "Recipe");
	CHECK_TEXT(name, "Recipe2");
	CHECK_AS(type_duplicate(document, 1, name, &why) &&
		 has("  END_STRUCT; (* shown *)\n  Recipe2 : STRUCT\n    Speed : INT;\n"
		     "    Limit : Bounds;\n    Wait  : TIME;\n  END_STRUCT; (* shown *)\n  Box"),
		 "a copy is added after its original");
	undone("one undo removes the copy");
	refused(type_duplicate(document, 1, "Box", &why), "a copy with a taken name");
	g_free(name);
}

static void test_delete(void)
{
	begin(PROGRAM);
	CHECK(type_uses(document, 1) == 4 && type_uses(document, 0) == 3);
	refused(type_delete(document, 0, &why),
		"a structure that a function returns is not deleted");
	refused(type_delete(document, 1, &why),
		"a structure that is the only member of another is not deleted");
	CHECK_AS(type_delete(document, 2, &why) && !has("Box") && has("Recipe : STRUCT"),
		 "an unused structure is deleted");
	CHECK_AS(type_delete(document, 1, &why), "a used structure is deleted");
	CHECK_AS(!has(": Recipe") && !has("OF Recipe") && has("  Last : INT;\n") &&
		 has("[ Now.Speed > 1 ]"),
		 "deleting a structure deletes its variables and inputs, but no rung");
	CHECK(ladder_document_undo(document) && ladder_document_undo(document));
	CHECK_AS(has_text(PROGRAM), "two undos restore both structures");
	begin("RUNGBOARD 1\n\nTYPE\n  Only : STRUCT\n    A : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	      "PROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n");
	CHECK_AS(type_delete(document, 0, &why) && has_text("RUNGBOARD 1\n\nPROGRAM Main LD\n"
		 "RUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n"),
		 "deleting the last structure deletes the TYPE part");
}

/* The names of the members of structure 0, in order. */
static char *order(void)
{
	const struct project *project = ladder_document_project(document);
	const struct var_table *vars = &project->structure[0].vars;
	GString *out = g_string_new("");

	for (int i = 0; i < vars->count; i++)
		g_string_append(out, project_text(project, vars->var[i].name));
	return g_string_free(out, FALSE);
}

/* Random moves: the order is that of a list that is moved likewise; Undo gives each back. */
static void test_moves(void)
{
	static const char many[] = "RUNGBOARD 1\n\nTYPE\n  S : STRUCT\n    A : INT;\n"
		"    B : STRING[9] := 'x'; (* b *)\n    C : ARRAY[0..1] OF BOOL;\n    D : T;\n"
		"    E : REAL;\n  END_STRUCT;\n  T : STRUCT\n    X : INT;\n  END_STRUCT;\n"
		"END_TYPE\n\nPROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n";
	GRand *random = g_rand_new_with_seed(7);
	char wanted[] = "ABCDE";
	int same = 0, moves = 0;

	begin(many);
	for (int i = 0; i < 60; i++) {
		const int from = g_rand_int_range(random, 0, 5), to = g_rand_int_range(random, 0, 5);
		const char moved = wanted[from];
		char *now;

		memmove(wanted + from, wanted + from + 1, 4 - (size_t)from);
		memmove(wanted + to + 1, wanted + to, 4 - (size_t)to);
		wanted[to] = moved;
		moves += from != to;
		type_move_member(document, 0, from, to, &why);
		now = order();
		same += strcmp(now, wanted) == 0;
		g_free(now);
	}
	CHECK_AS(same == 60, "each move gives the expected order");
	for (; moves > 0 && ladder_document_undo(document); moves--)
		;
	CHECK_AS(moves == 0 && !ladder_document_undo_name(document) && has_text(many),
		 "one undo for each move restores the file");
	g_rand_free(random);
}

static void test_members(void)
{
	char *name;

	ladder_document_open_text(document, NULL, "PROGRAM", 7, true);
	CHECK_AS(!ladder_document_project(document) &&
		 !type_add_member(document, 0, 0, &name, &why) && why && !name,
		 "a text that cannot be read gets no member");
	g_free(why);
	begin(PROGRAM);
	CHECK_AS(type_add_member(document, 1, 0, &name, &why) &&
		 has("    Speed  : INT;\n    Speed2 : INT;\n    Limit  : Bounds;\n"),
		 "a member is added after another one with its type");
	g_free(name);
	undone("one undo removes the added member");
	CHECK(type_add_member(document, 1, 2, &name, &why) && has("    Wait  : TIME;\n    Wait2 : TIME;\n"));
	g_free(name);
	undone("one undo removes the member added at the end");
	CHECK(symbol_set(document, type_table(document, 1), 0, FIELD_NAME, "Rate", &why));
	CHECK_AS(has("[ Now.Rate > 1 ]") && has("[3(Rate := 1)]") && has("    Rate  : INT;\n"),
		 "a member is renamed everywhere");
	undone("one undo restores the renamed member");
	CHECK(symbol_set(document, type_table(document, 1), 0, FIELD_INITIAL, "5", &why) &&
	      symbol_set(document, type_table(document, 1), 0, FIELD_COMMENT, "rpm", &why) &&
	      symbol_set(document, type_table(document, 1), 0, FIELD_TYPE, "ARRAY[0..1] OF BOOL",
			 &why) == false);
	CHECK(has("    Speed : INT := 5; (* rpm *)\n"));
	g_free(why);
}

int main(void)
{
	test_add();
	test_duplicate();
	test_delete();
	test_moves();
	test_members();
	g_clear_object(&document);
	return tap_done();
}
