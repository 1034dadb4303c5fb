/* SPDX-License-Identifier: MIT
 *
 * test_import - programs and blocks of another project, with their declarations, and names
 * that are already used.
 */
#include "editor-gtk/document/pou_import.h"
#include "tests/tap.h"

#include <string.h>

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

static bool has(const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool found = strstr(text, part);

	if (!found)
		printf("# lacks %s\n%s\n", part, text);
	g_free(text);
	return found;
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
	CHECK(has("PROGRAM Main LD\n") && has("PROGRAM Main_2 LD\n"));
	CHECK_AS(has("FUNCTION_BLOCK Seal"), "the called block is imported");
	CHECK_AS(has("Batch : STRUCT") && lacks("Unused"), "the used structure is imported, and no other");
	CHECK_AS(has("VAR RETAIN\n  Now : Batch;\nEND_VAR"), "the symbol is imported, with RETAIN");
	CHECK_AS(has("Lamp_2 AT %QX0.5") && has("COIL Lamp_2 |"),
		 "another thing of the same name");
	CHECK_AS(lacks("Start_2") && lacks("Other") && lacks("Spare"),
		 "the same thing is shared, the rest stays away");
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors == 0);
	CHECK_TEXT(ladder_document_undo_name(document), "Import");
	ladder_document_undo(document);
	text = ladder_document_text(document, NULL);
	CHECK_TEXT(text, here);
	g_free(text);
	CHECK_AS(import(nothing, told) && lacks("Main_2"), "an empty choice imports nothing");
	g_string_free(told, TRUE);
	g_object_unref(document);
	return tap_done();
}
