/* SPDX-License-Identifier: MIT
 *
 * test_rung_clip - rungs as text, and pasted into another project with their declarations.
 */
#include "editor-gtk/document/rung_clip.h"
#include "tests/editor/opened.h"
#include "tests/tap.h"

#include <stdlib.h>

static const char source[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Lamp AT %QX0.1 : BOOL; (* green *)\n  Motor AT %QX0.0 : BOOL;\n"
	"  Other : INT;\n  Rec : Recipe;\nEND_VAR\n\n"
	"TYPE\n  Recipe : STRUCT\n    Speed : INT := 5;\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR RETAIN\n  Parts : UDINT := 7;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  D1 : TON;\nEND_VAR\n"
	"RUNG\n  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |\n"
	"RUNG\n  | [ Parts := Parts + 1 ] |\nRUNG\n  | [ Rec.Speed := 3 ] |\nEND_PROGRAM\n";
static const char target[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\nEND_PROGRAM\n";

static char *copied(int rung)
{
	LadderDocument *document = opened(source);
	char *text = rung_clip_text(document, 0,
				    &ladder_document_project(document)->pou[0].rung[rung],
				    1);

	g_object_unref(document);
	return text;
}

/* Pastes as a sheet does, replacing the first rung. Returns the message, or the reason of a
 * refusal. */
static char *pasted(LadderDocument *document, const char *text, gsize len)
{
	char *told = NULL;
	struct rung_clip *clip = rung_clip_read(document, 0, text, len, &told);
	struct rung **rungs;

	if (!clip)
		return told;
	CHECK(!told);
	const int count = clip->count;

	rungs = rung_clip_take(clip);
	ladder_document_begin(document, "Paste", NULL);
	CHECK(ladder_document_splice(document, 0, 0, 1, rungs, count, NULL));
	told = rung_clip_declare(clip, document, 0, 0, count);
	ladder_document_end(document);
	g_free(rungs);
	rung_clip_free(clip);
	return told ? told : g_strdup("");
}

/* Pastes @text into @into, compares the message and the result, and undoes it once. */
static void becomes(const char *into, const char *text, const char *told, const char *want)
{
	LadderDocument *document = opened(into);
	char *before = ladder_document_text(document, NULL);
	char *got = pasted(document, text, strlen(text));
	char *after = ladder_document_text(document, NULL);

	CHECK_TEXT(got, told);
	CHECK_TEXT(after, want);
	g_free(after);
	if (strcmp(before, want) != 0) {
		CHECK(g_strcmp0(ladder_document_undo_name(document), "Paste") == 0);
		CHECK(ladder_document_undo(document));
	}
	CHECK(!ladder_document_undo_name(document));
	after = ladder_document_text(document, NULL);
	CHECK_TEXT(after, before);
	g_free(after);
	g_free(got);
	g_free(before);
	g_object_unref(document);
}

static void refused(const char *text, const char *why)
{
	becomes(target, text, why, target);
}

static void test_text(void)
{
	char *text = copied(0);

	CHECK_TEXT(text,
		"VAR_GLOBAL\n  Lamp AT %QX0.1 : BOOL; (* green *)\n  Motor AT %QX0.0 : BOOL;\n"
		"END_VAR\nVAR\n  D1 : TON;\nEND_VAR\n"
		"RUNG\n  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |\n");
	g_free(text);
	text = copied(1);
	CHECK_TEXT(text, "VAR_GLOBAL RETAIN\n  Parts : UDINT := 7;\nEND_VAR\n"
			 "RUNG\n  | [ Parts := Parts + 1 ] |\n");
	g_free(text);
}

static void test_declared(void)
{
	char *text = copied(0), *retain = copied(1), *own = copied(2);

	becomes(target, text, "3 names were declared",
		"RUNGBOARD 1\n\n"
		"VAR\n  Motor AT %QX0.0 : BOOL;\n  Lamp  AT %QX0.1 : BOOL; (* green *)\nEND_VAR\n\n"
		"PROGRAM Main LD\nVAR\n  D1 : TON;\nEND_VAR\n"
		"RUNG\n  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |\nEND_PROGRAM\n");
	becomes(target, retain, "1 name was declared",
		"RUNGBOARD 1\n\nVAR RETAIN\n  Parts : UDINT := 7;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | [ Parts := Parts + 1 ] |\nEND_PROGRAM\n");
	/* An unknown type: the check reports it. */
	becomes(target, own, "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | [ Rec.Speed := 3 ] |\nEND_PROGRAM\n");
	becomes("RUNGBOARD 1\n\nTYPE\n  Recipe : STRUCT\n    Speed : INT;\n  END_STRUCT;\n"
		"END_TYPE\n\nPROGRAM Main LD\nRUNG\nEND_PROGRAM\n", own, "1 name was declared",
		"RUNGBOARD 1\n\nTYPE\n  Recipe : STRUCT\n    Speed : INT;\n  END_STRUCT;\n"
		"END_TYPE\n\nVAR\n  Rec : Recipe;\nEND_VAR\n\nPROGRAM Main LD\n"
		"RUNG\n  | [ Rec.Speed := 3 ] |\nEND_PROGRAM\n");
	g_free(text);
	g_free(retain);
	g_free(own);
}

/* The constants that a declaration needs go with it. */
static void test_needed(void)
{
	LadderDocument *from = opened("RUNGBOARD 1\n\nVAR CONSTANT\n  Base  : INT := 5;\n"
		"  Limit : INT := Base * 2;\n  Other : INT := 1;\nEND_VAR\n\n"
		"VAR\n  Max : ARRAY[1..Limit] OF INT := [Limit - 1];\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | [ Max[1] > 3 ] | COIL %QX0.0 |\nEND_PROGRAM\n");
	char *text = rung_clip_text(from, 0, ladder_document_project(from)->pou[0].rung, 1);

	CHECK_TEXT(text, "VAR_GLOBAL\n  Max : ARRAY[1..Limit] OF INT := [Limit - 1];\nEND_VAR\n"
		"VAR_GLOBAL CONSTANT\n  Base : INT := 5;\n  Limit : INT := Base * 2;\nEND_VAR\n"
		"RUNG\n  | [ Max[1] > 3 ] | COIL %QX0.0 |\n");
	becomes(target, text, "3 names were declared",
		"RUNGBOARD 1\n\nVAR\n  Max : ARRAY[1..Limit] OF INT := [Limit - 1];\nEND_VAR\n\n"
		"VAR CONSTANT\n  Limit : INT := Base * 2;\n  Base  : INT := 5;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | [ Max[1] > 3 ] | COIL %QX0.0 |\nEND_PROGRAM\n");
	g_free(text);
	g_object_unref(from);
}

/* Known names stay as they are, and no address gets a second name. */
static void test_known(void)
{
	char *text = copied(0);

	becomes("RUNGBOARD 1\n\nVAR\n  LAMP  : INT;\n  Motor : BOOL;\n  D1    : TOF;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\nEND_PROGRAM\n", text, "",
		"RUNGBOARD 1\n\nVAR\n  LAMP  : INT;\n  Motor : BOOL;\n  D1    : TOF;\nEND_VAR\n\n"
		"PROGRAM Main LD\n"
		"RUNG\n  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |\nEND_PROGRAM\n");
	becomes("RUNGBOARD 1\n\nVAR\n  Fan AT %QB0 : BYTE;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\nEND_PROGRAM\n", text,
		"3 names were declared; Motor has no address: %QX0.0 is Fan here and 1 more",
		"RUNGBOARD 1\n\nVAR\n  Fan   AT %QB0 : BYTE;\n  Motor : BOOL;\n"
		"  Lamp  : BOOL; (* green *)\nEND_VAR\n\n"
		"PROGRAM Main LD\nVAR\n  D1 : TON;\nEND_VAR\n"
		"RUNG\n  | NO Motor | TON D1 PT:=T#5s | COIL Lamp |\nEND_PROGRAM\n");
	g_free(text);
}

static void test_typed(void)
{
	static const char two[] = "RUNGBOARD 1\n\nPROGRAM Main LD\n"
		"(* first *)\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
		"(* second *)\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";

	becomes(target, "\n| NO %IX0.0 | COIL %QX0.0 |\n| NO %IX0.1 | COIL %QX0.1 |\n", "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
		"  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n");
	becomes(target, "(* first *)\n| NO %IX0.0 | COIL %QX0.0 |\n"
		"// second\n\nrung\n| NO %IX0.1 | COIL %QX0.1 |", "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\n(* first *)\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
		"// second\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n");
	becomes(target, "(* first *)\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
		"(* second *)\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\n", "", two);
	becomes(target, two, "", two);
	becomes(target, two + strlen("RUNGBOARD 1\n\n"), "", two);
	/* A line of a comment does not begin a rung. */
	becomes(target, "(* a\nRUNG b\n*)\nRUNG\n  | COIL %QX0.0 |\n", "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\n(* a\nRUNG b\n*)\nRUNG\n  | COIL %QX0.0 |\n"
		"END_PROGRAM\n");
}

static void test_line(void)
{
	becomes(target, "  XIC Start\tXIO Stop  OTE Motor2\n", "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\n"
		"RUNG\n  | NO Start | NC Stop | COIL Motor2 |\nEND_PROGRAM\n");
	becomes(target, "LD %I0.0 TON T1 T#5s OUT %Q0.1", "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\n"
		"RUNG\n  | NO %IX0.0 | TON T1 PT:=T#5s | COIL %QX0.1 |\nEND_PROGRAM\n");
	/* In a list an output ends a rung. */
	becomes(target, "LD Start\nANDN Stop\r\nST Motor2\n\nLD %I0.5\nOUT %Q0.1\n", "",
		"RUNGBOARD 1\n\nPROGRAM Main LD\n"
		"RUNG\n  | NO Start | NC Stop | COIL Motor2 |\n"
		"RUNG\n  | NO %IX0.5 | COIL %QX0.1 |\nEND_PROGRAM\n");
	refused("XIC", "The clipboard, line 1: the operand is still missing");
	refused("XIC Start OTE", "The clipboard, line 1: the operand is still missing");
	refused("LD Start\nFROB Stop\nST Motor\n",
		"The clipboard, line 2: “FROB” is not a known word");
	refused("XIC Start BST XIO Stop NXB XIC Over BND OTE Motor",
		"The clipboard, line 1: “BST” is not a known word");
	refused("LD Start\nOR Stop\nST Motor\n", "The clipboard, line 2: “OR Stop” can only be "
		"pasted as a row of a rung file");
	refused("LD Start\nST Motor\nST Lamp\n", "The clipboard, line 3: “ST Lamp” can only be "
		"pasted as a row of a rung file");
	refused("Start XIC Stop", "The clipboard, line 1: “Start” is not a known word");
	refused("LD > 5", "The clipboard, line 1: “LD > 5” can only be pasted as a row of a rung file");
}

/* Takes the rungs of all ladder programs, and only the declarations that they use. */
static void test_file(void)
{
	becomes(target, "RUNGBOARD 1\nVAR\n  A AT %IX0.0, B : BOOL;\n  C : BOOL;\nEND_VAR\n"
		"PROGRAM One LD\nVAR CONSTANT\n  Most : INT := 16#10;\nEND_VAR\n"
		"RUNG\n  | NO A | [ Most > 3 ] | COIL %QX0.0 |\nEND_PROGRAM\n"
		"PROGRAM List IL\n  LD A\n  ST %QX0.7\nEND_PROGRAM\n"
		"FUNCTION_BLOCK Seal LD\nRUNG\n  | COIL %QX0.5 |\nEND_FUNCTION_BLOCK\n"
		"PROGRAM Two LD\nRUNG\n  | NO B | COIL %QX0.1 |\nEND_PROGRAM\n",
		"The clipboard, line 3: \":\" is missing before \",\"", target);
	becomes(target, "RUNGBOARD 1\nVAR\n  A AT %IX0.0 : BOOL;\n  B, C : BOOL;\nEND_VAR\n"
		"PROGRAM One LD\nVAR CONSTANT\n  Most : INT := 16#10;\nEND_VAR\n"
		"RUNG\n  | NO A | [ Most > 3 ] | COIL %QX0.0 |\nEND_PROGRAM\n"
		"PROGRAM List IL\n  LD A\n  ST %QX0.7\nEND_PROGRAM\n"
		"FUNCTION_BLOCK Seal LD\nRUNG\n  | COIL %QX0.5 |\nEND_FUNCTION_BLOCK\n"
		"PROGRAM Two LD\nRUNG\n  | NO B | COIL %QX0.1 |\nEND_PROGRAM\n",
		"3 names were declared",
		"RUNGBOARD 1\n\nVAR\n  A AT %IX0.0 : BOOL;\n  B : BOOL;\nEND_VAR\n\n"
		"PROGRAM Main LD\nVAR CONSTANT\n  Most : INT := 16#10;\nEND_VAR\n"
		"RUNG\n  | NO A | [ Most > 3 ] | COIL %QX0.0 |\n"
		"RUNG\n  | NO B | COIL %QX0.1 |\nEND_PROGRAM\n");
}

static void test_refused(void)
{
	static const char nul[] = "RUNG\n | COIL %QX0.0 |\n\0RUNG\n | COIL %QX0.1 |\n";
	LadderDocument *document = opened(target);
	char *why, *large = g_malloc0(LIMIT_TEXT + 2), *after;

	refused("", "The clipboard holds no rungs.");
	refused("\nthis is no rung", "The clipboard, line 2: “this” is not a known word");
	refused("VAR\n  A : BOOL;\nEND_VAR\n", "The clipboard holds no rungs.");
	refused("RUNGBOARD 1\nPROGRAM A IL\n  LD TRUE\nEND_PROGRAM\n",
		"The clipboard holds no rungs.");
	refused("RUNG\n  | BADWORD Start |\n", "The clipboard, line 2: \"BADWORD\" is not a known word");
	refused("\n  | BADWORD Start |\n", "The clipboard, line 2: \"BADWORD\" is not a known word");
	refused("RUNG\n| NO %IX0.0 |\n\n(* c\n*)\nRUNG\n| NO %IX0.0 |\n| BADWORD Start |\n",
		"The clipboard, line 8: \"BADWORD\" is not a known word");
	refused("hello\nRUNG\n| COIL %QX0.0 |\n", "The clipboard, line 1: \"RUNG\" is missing before \"hello\"");
	refused("VAR\n  D : TON;\nEND_VAR\n\nVAR_GLOBAL\n\n  A : BOOL := 7;\nEND_VAR\nRUNG\n| NO A |\n",
		"The clipboard, line 7: \"7\": constant is out of range");
	refused("RUNGBOARD 1\nPROGRAM A LD\nRUNG\n  | BADWORD Start |\nEND_PROGRAM\n",
		"The clipboard, line 4: \"BADWORD\" is not a known word");
	refused("PROGRAM A LD\nRUNG\n  | BADWORD Start |\nEND_PROGRAM\n",
		"The clipboard, line 3: \"BADWORD\" is not a known word");
	refused("RUNG\n | COIL \xff |\n", "not valid UTF-8 text; save the file as UTF-8");
	why = pasted(document, nul, sizeof(nul) - 1);
	CHECK_TEXT(why, "not valid UTF-8 text; save the file as UTF-8");
	g_free(why);
	memset(large, ' ', LIMIT_TEXT + 1);
	memcpy(large, "RUNG\n", 5);
	why = pasted(document, large, LIMIT_TEXT + 1);
	CHECK_TEXT(why, "file is too large");
	after = ladder_document_text(document, NULL);
	CHECK_TEXT(after, target);
	CHECK(ladder_document_is_saved(document));
	g_free(after);
	g_free(why);
	g_free(large);
	g_object_unref(document);
}

int main(void)
{
	test_text();
	test_declared();
	test_needed();
	test_known();
	test_typed();
	test_line();
	test_file();
	test_refused();
	return tap_done();
}
