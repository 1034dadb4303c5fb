/* SPDX-License-Identifier: MIT
 *
 * test_pou_edit - a block that is used is deleted with what cannot be read without it.
 */
#include "editor-gtk/document/pou_edit.h"

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

static bool has(const char *text)
{
	char *whole = ladder_document_text(document, NULL);
	const bool found = strstr(whole, text);

	g_free(whole);
	return found;
}

static int pou_of(const char *name)
{
	return project_find_pou(ladder_document_project(document), name, strlen(name));
}

static void test_block(void)
{
	char *before = ladder_document_text(document, NULL);

	CHECK_AS(pou_uses(document, pou_of("Seal")) > 0, "its uses are counted");
	CHECK(pou_uses(document, pou_of("Main")) == 0);
	CHECK_AS(!pou_delete(document, pou_of("Seal")), "a used block is deleted");
	CHECK_AS(ladder_document_project(document) && pou_of("Seal") < 0 && !has("Seal"),
		 "with its boxes and instances");
	CHECK_AS(has("| NO %IX0.0 | COIL Lamp |") && has("| TON Delay PT:=T#1s | COIL %QX0.1 |"),
		 "power goes on where its boxes were");
	CHECK_AS(has("NO One.Q") && has("Delay : TON"), "other elements stay");
	CHECK(ladder_document_undo(document));
	CHECK_AS(has(before) && !ladder_document_undo_name(document), "one undo restores all");
	g_free(before);
}

static void test_function(void)
{
	CHECK(!pou_delete(document, pou_of("Twice")));
	CHECK_AS(!has("Twice") && has("  LD    %IX0.3\n  ST    %QX0.3\n"),
		 "lines of lists that call it are deleted");
	CHECK(ladder_document_undo(document) && has("Twice "));
}

int main(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, PROGRAM, strlen(PROGRAM), true);
	if (CHECK(ladder_document_project(document))) {
		test_block();
		test_function();
	}
	g_object_unref(document);
	return tap_done();
}
