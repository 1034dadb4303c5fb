/* SPDX-License-Identifier: MIT
 *
 * test_import - programs and blocks of another project, with their declarations, and names
 * that are already used.
 */
#include "editor-gtk/document/pou_import.h"
#include "tests/editor/texts.h"
#include "tests/tap.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char here[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Lamp  AT %QX0.0 : BOOL;\n"
	"  Level : INT;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO Start | COIL Lamp |\nEND_PROGRAM\n";

static const char there[] =
	"RUNGBOARD 1\n\nTYPE\n  Batch : STRUCT\n    Size : INT;\n    Done : BOOL;\n"
	"  END_STRUCT;\n  Unused : STRUCT\n    A : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Lamp  AT %QX0.5 : BOOL;\n  Other AT %QX0.6 : BOOL;\n"
	"END_VAR\n\n(* VAR by the way *)\nVAR RETAIN\n  Now   : Batch;\n  Spare : INT;\nEND_VAR\n\n"
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  In : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\n"
	"END_VAR\nRUNG\n  | NO In | COIL Q |\nEND_FUNCTION_BLOCK\n\n"
	"PROGRAM Main LD\nVAR\n  One : Seal;\nEND_VAR\nRUNG\n"
	"  | NO Start | Seal One | COIL Lamp |\nRUNG\n  | NO Now.Done | COIL %QX0.7 |\n"
	"END_PROGRAM\n\nPROGRAM Second LD\nRUNG\n  | NO Other | COIL Other |\nEND_PROGRAM\n";

static LadderDocument *document;

static bool import(const bool *chosen, GString *told)
{
	struct ladder *from = ladder_new();
	bool good = ladder_load_text(from, "there.rung", there, strlen(there)) &&
		pou_import(document, from, chosen, told);

	ladder_free(from);
	return good;
}

static bool lacks(const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool found = strstr(text, part);

	g_free(text);
	return !found;
}

static void open_here(void)
{
	ladder_document_open_text(document, "/tmp/x/here.rung", here, strlen(here), true);
}

/* A block goes to another file with its comments and what it needs, then is deleted here. */
static void test_export(void)
{
	static const char own[] = "RUNGBOARD 1\n\nTYPE\n  Batch : STRUCT\n    Size : INT;\n  END_STRUCT;\n"
		"END_TYPE\n\nVAR\n  Now : Batch;\n  Lamp AT %QX0.5 : BOOL;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n\n"
		"(* shows *)\nPROGRAM Show LD\nRUNG\n  | [ Now.Size > 2 ] | COIL Lamp |\nEND_PROGRAM\n";
	char *folder = g_dir_make_tmp(NULL, NULL), *path = g_build_filename(folder, "other.rung", NULL);
	GString *told = g_string_new(NULL);
	char *needs, *before, *text = NULL, *after;

	ladder_document_open_text(document, NULL, own, strlen(own), true);
	before = ladder_document_text(document, NULL);
	needs = pou_export_needs(document, 1);
	CHECK_TEXT(needs, "Show, Batch, Now, Lamp");
	CHECK(!pou_export(document, 1, path, told) && !g_file_test(path, G_FILE_TEST_EXISTS));
	CHECK(g_file_set_contents(path, here, -1, NULL) && pou_export(document, 1, path, told));
	CHECK_TEXT(told->str, "Imported; Lamp is now Lamp_2");
	CHECK(g_file_get_contents(path, &text, NULL, NULL));
	CHECK_AS(g_str_has_prefix(text, "RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;"),
		 "the other file keeps its content");
	CHECK(strstr(text, "(* shows *)\nPROGRAM Show LD\nRUNG\n  | [ Now.Size > 2 ] | COIL Lamp_2 |") &&
	      strstr(text, "Batch : STRUCT") && strstr(text, ": Batch;"));
	after = ladder_document_text(document, NULL);
	CHECK_AS(strcmp(before, after) == 0, "copying does not change this document");
	CHECK(g_file_set_contents(path, "nothing", -1, NULL) && !pou_export(document, 1, path, told));
	g_free(text);
	CHECK(g_file_get_contents(path, &text, NULL, NULL));
	CHECK_TEXT(text, "nothing");
	remove(path);
	remove(folder);
	g_free(after);
	g_free(text);
	g_free(before);
	g_free(needs);
	g_string_free(told, TRUE);
	g_free(path);
	g_free(folder);
}

/* The own file and an included one are refused by any path: a block that moves would be lost. */
static void test_own_files(void)
{
	static const char own[] = "RUNGBOARD 1\n\nINCLUDE \"more.rung\"\n\nPROGRAM Main LD\nRUNG\n"
		"END_PROGRAM\n";
	static const char more[] = "RUNGBOARD 1\n\nVAR\n  Far : INT;\nEND_VAR\n";
	static const char *const names[] = { "own.rung", "link.rung", "more.rung", "far.rung" };
	char *folder = g_dir_make_tmp(NULL, NULL), *path[4], *text;
	GString *told = g_string_new(NULL);
	GError *error = NULL;

	for (int i = 0; i < 4; i++)
		path[i] = g_build_filename(folder, names[i], NULL);
	CHECK(g_file_set_contents(path[0], own, -1, NULL) &&
	      g_file_set_contents(path[2], more, -1, NULL) &&
	      symlink("own.rung", path[1]) == 0 && symlink("more.rung", path[3]) == 0);
	CHECK(ladder_document_open(document, path[0], &error) && ladder_document_project(document));
	for (int i = 0; i < 4; i++) {
		CHECK(!pou_export(document, 0, path[i], told));
		CHECK_TEXT(told->str, i < 2 ? "This is the file of this project. Choose another." :
			   "This project includes the file. Choose another.");
		CHECK(g_file_get_contents(path[i], &text, NULL, NULL));
		CHECK_TEXT(text, i < 2 ? own : more);
		g_free(text);
	}
	for (int i = 0; i < 4; i++) {
		remove(path[i]);
		g_free(path[i]);
	}
	remove(folder);
	g_string_free(told, TRUE);
	g_free(folder);
}

int main(void)
{
	static const bool main_only[] = { false, true, false };
	static const bool nothing[] = { false, false, false };
	GString *told = g_string_new(NULL);
	char *text;

	document = ladder_document_new();
	open_here();
	CHECK(import(main_only, told));
	CHECK_TEXT(told->str, "Imported; Lamp is now Lamp_2; Main is now Main_2");
	CHECK(document_has(document, "PROGRAM Main LD\n") && document_has(document, "PROGRAM Main_2 LD\n"));
	CHECK_AS(document_has(document, "FUNCTION_BLOCK Seal"), "the called block is imported");
	CHECK_AS(document_has(document, "Batch : STRUCT") && lacks("Unused"), "the used structure is imported, and no other");
	CHECK_AS(document_has(document, "VAR RETAIN\n  Now : Batch;\nEND_VAR"), "the symbol is imported, with RETAIN");
	CHECK_AS(document_has(document, "Lamp_2 AT %QX0.5") && document_has(document, "COIL Lamp_2 |"),
		 "a different symbol with a known name gets a new name");
	CHECK_AS(lacks("Start_2") && lacks("Other") && lacks("Spare"),
		 "an equal symbol is shared, unused symbols are not imported");
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors == 0);
	CHECK_TEXT(ladder_document_undo_name(document), "Import");
	ladder_document_undo(document);
	text = ladder_document_text(document, NULL);
	CHECK_TEXT(text, here);
	g_free(text);
	CHECK_AS(import(nothing, told) && lacks("Main_2"), "an empty choice imports nothing");
	g_string_free(told, TRUE);
	test_export();
	test_own_files();
	g_object_unref(document);
	return tap_done();
}
