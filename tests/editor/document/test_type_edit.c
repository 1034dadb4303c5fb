/* SPDX-License-Identifier: MIT
 *
 * test_type_edit - data types are added, duplicated and deleted, members moved, values and limits
 * edited: each in one step, and the rest of the file stays.
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
	CHECK_AS(type_add(document, TYPE_STRUCTURE, "Batch", &why) &&
		 has("  Box : STRUCT\n    Only : Recipe;\n  END_STRUCT;\n  Batch : STRUCT\n"
		     "    Member1 : INT;\n  END_STRUCT;\nEND_TYPE\n"),
		 "a structure is added after the others");
	CHECK(type_find(document, "bATCH") == 3);
	undone("one undo removes the added structure");
	refused(type_add(document, TYPE_STRUCTURE, "recipe", &why), "a name of another structure");
	refused(type_add(document, TYPE_STRUCTURE, "Main", &why), "a name of a program");
	refused(type_add(document, TYPE_STRUCTURE, "Last", &why), "a name of a symbol");
	refused(type_add(document, TYPE_STRUCTURE, "INT", &why), "a name of a type");
	refused(type_add(document, TYPE_STRUCTURE, "TON", &why), "a name of a block");
	refused(type_add(document, TYPE_STRUCTURE, "COIL", &why), "a word of cells");
	refused(type_add(document, TYPE_STRUCTURE, "2b", &why), "a text that is no name");
	refused(type_add(document, TYPE_STRUCTURE, "", &why), "an empty name");
	begin(plain);
	CHECK_AS(type_add(document, TYPE_STRUCTURE, "Batch", &why) &&
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

/* ---- types that are no structures ---- */

static const char KINDS[] =
	"RUNGBOARD 1\n\n"
	"(* of the lamps *)\n"
	"TYPE\n"
	"  Color : (Red, Green := 5, Blue) := Green; (* of a lamp *)\n"
	"  Line : STRUCT\n    Front : Color;\n    Level : Percent;\n  END_STRUCT;\n"
	"  Percent : INT (0..Most) := 5; (* 0 to 100 *)\n"
	"  Row     : ARRAY[1..3] OF Color := [3(Red)];\n"
	"  Hue     : Color;\n"
	"END_TYPE\n\n"
	"VAR CONSTANT\n  Most : INT := 100;\nEND_VAR\n\n"
	"VAR\n  Lamp : Color;\n  Rows : Row;\n  Gone : Hue := Blue;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | [ Lamp = Color#Red ] | [ Lamp := Green ] | COIL %QX0.0 |\n"
	"END_PROGRAM\n";

static void back(const char *what)
{
	CHECK_AS(ladder_document_undo(document) && has_text(KINDS) &&
		 !ladder_document_undo_name(document), what);
}

static void kept(bool good, const char *what)
{
	CHECK_AS(!good && why && *why && has_text(KINDS), what);
	printf("# %s\n", why ? why : "");
	g_free(why);
}

static void test_kinds(void)
{
	static const char *const names[] = { "Color", "Line", "Percent", "Row", "Hue" };
	static const enum type_kind kinds[] = { TYPE_ENUMERATION, TYPE_STRUCTURE, TYPE_SUBRANGE,
						TYPE_ARRAY, TYPE_ALIAS };
	const struct project *project;
	GArray *order;
	bool good = true;

	begin(KINDS);
	project = ladder_document_project(document);
	order = type_order(project);
	for (guint i = 0; i < G_N_ELEMENTS(names); i++) {
		const int type = i < order->len ? g_array_index(order, int, i) : -1;

		good = good && type == type_find(document, names[i]) &&
		       type_kind_of(project, type) == kinds[i] &&
		       symbol_table_find(document, names[i]) == type_table(document, type);
	}
	CHECK_AS(good && order->len == G_N_ELEMENTS(names),
		 "types of all kinds are found, in the order of the file");
	g_array_unref(order);
	CHECK(type_uses(document, type_find(document, "Color")) == 9);
	CHECK(type_uses(document, type_find(document, "Percent")) == 1);
	for (int kind = 0; kind < TYPE_KINDS; kind++) {
		CHECK(type_add(document, (enum type_kind)kind, "Fresh", &why) &&
		      type_kind_of(ladder_document_project(document),
				   type_find(document, "Fresh")) == (enum type_kind)kind);
		back("one undo removes a type of each kind");
	}
	kept(type_add(document, TYPE_ARRAY, "hue", &why), "a name of another type");
}

static void test_values(void)
{
	const int color = 1;
	char *name;

	begin(KINDS);
	CHECK(type_find(document, "Color") == color);
	CHECK_AS(type_rename_value(document, color, 1, "Olive", &why) &&
		 has("(Red, Olive := 5, Blue) := Olive; (* of a lamp *)") && has("[ Lamp := Olive ]"),
		 "a value is renamed everywhere");
	back("one undo restores the renamed value");
	kept(type_rename_value(document, color, 1, "red", &why), "a name of another value");
	kept(type_rename_value(document, color, 1, "2x", &why), "a value with a text that is no name");
	CHECK_AS(type_set_number(document, color, 1, "", &why) &&
		 has("  Color : (Red, Green, Blue) := Green; (* of a lamp *)\n"),
		 "a number is taken away, and the comment stays");
	back("one undo restores the number");
	CHECK(type_set_number(document, color, 0, "16#10", &why) && has("(Red := 16#10, Green := 5, "));
	back("one undo removes the number");
	kept(type_set_number(document, color, 0, "40000", &why), "a number that an INT cannot hold");
	kept(type_set_number(document, color, 0, "1, Other", &why), "two values in one number");
	CHECK(type_add_value(document, color, 0, &name, &why) && strcmp(name, "Value1") == 0 &&
	      has("(Red, Value1, Green := 5, Blue)"));
	g_free(name);
	back("one undo removes the added value");
	CHECK(type_move_value(document, color, 2, 0, &why) && has("(Blue, Red, Green := 5)"));
	back("one undo moves the value back");
	CHECK(type_set_base(document, color, "UINT", &why) && has("  Color : UINT (Red, Green := 5, Blue)"));
	back("one undo removes the base type");
	kept(type_set_base(document, color, "REAL", &why), "a base type that has no values");
	kept(type_delete_value(document, color, 1, &why), "a value that is an initial value");
	kept(type_delete_value(document, color, 9, &why), "a value that is not there");
}

static void test_others(void)
{
	int type;

	begin(KINDS);
	type = type_find(document, "Percent");
	CHECK_AS(type_set_bound(document, type, false, "-1", &why) &&
		 has("  Percent : INT (-1..Most) := 5; (* 0 to 100 *)\n"),
		 "a limit is changed, the other one and the comment stay");
	back("one undo restores the limit");
	kept(type_set_bound(document, type, false, "x y", &why), "a limit that cannot be read");
	kept(type_set_bound(document, type, true, "70000", &why), "a limit that an INT cannot hold");
	CHECK(symbol_set(document, type_table(document, type), 0, FIELD_INITIAL, "7", &why) &&
	      has("INT (0..Most) := 7; (* 0 to 100 *)"));
	back("one undo restores the initial value");
	type = type_find(document, "Row");
	CHECK(symbol_set(document, type_table(document, type), 0, FIELD_TYPE,
			 "ARRAY[1..3, 0..1] OF Hue", &why) &&
	      has("  Row     : ARRAY[1..3, 0..1] OF Hue := [3(Red)];\n"));
	back("one undo restores the array");
	kept(symbol_set(document, type_table(document, type), 0, FIELD_TYPE, "INT; X : INT", &why),
	     "two types in one");
	kept(symbol_set(document, type_table(document, type), 0, FIELD_TYPE, "Nothing", &why),
	     "an unknown type");
	CHECK(symbol_set(document, 0, 1, FIELD_COMMENT, "on", &why) &&
	      has("  Lamp : Color; (* on *)\n"));
	back("a variable of such a type keeps its type and gets no value");
	CHECK(type_duplicate(document, type_find(document, "Color"), "Paint", &why) &&
	      has("  Paint : (Red, Green := 5, Blue) := Green; (* of a lamp *)\n"));
	back("one undo removes the copy");
	kept(type_delete(document, type_find(document, "Color"), &why),
	     "a type that another type is made of");
	CHECK_AS(type_delete(document, type_find(document, "Row"), &why) && !has("Row") &&
		 has("  Lamp : Color;\n") && has("  Hue     : Color;\n"),
		 "a used type is deleted with its variables");
	CHECK(ladder_document_undo(document) && has_text(KINDS));
	begin("RUNGBOARD 1\n\nTYPE\n  Only : (A, B);\nEND_TYPE\n\n"
	      "PROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n");
	CHECK_AS(type_delete(document, 0, &why) && has_text("RUNGBOARD 1\n\nPROGRAM Main LD\n"
		 "RUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n"),
		 "deleting the last type deletes the TYPE part");
}

int main(void)
{
	test_add();
	test_duplicate();
	test_delete();
	test_moves();
	test_members();
	test_kinds();
	test_values();
	test_others();
	g_clear_object(&document);
	return tap_done();
}
