/* SPDX-License-Identifier: MIT
 *
 * test_instances - the first instance of a block: of the globals, of a program, inside another
 * instance; none of an array, of a block without instances, of a program.
 */
#include "editor-gtk/document/instances.h"

#include "tests/editor/opened.h"

#define BLOCK(name, vars) "FUNCTION_BLOCK " name " LD\nVAR_INPUT\n  In : BOOL;\nEND_VAR\n" vars \
	"RUNG\n  | NO In | COIL %QX0.7 |\nEND_FUNCTION_BLOCK\n\n"
static const char blocks[] =
	BLOCK("Lift", "") BLOCK("Cell", "VAR\n  A : ARRAY[1..2] OF Lift;\n  Door : Lift;\nEND_VAR\n");

static void first(const char *globals, const char *locals, const char *pou, const char *wanted)
{
	char *text = g_strdup_printf("RUNGBOARD 1\n\n%s\n%sPROGRAM Main LD\n%s"
				     "RUNG\n  | NO %%IX0.0 | COIL %%QX0.0 |\nEND_PROGRAM\n",
				     globals, blocks, locals);
	LadderDocument *document = opened(text);
	const struct project *project = ladder_document_project(document);
	char *found = instance_first(project, project_find_pou(project, pou, strlen(pou)));

	CHECK_TEXT(found ? found : "none", wanted);
	g_free(found);
	g_object_unref(document);
	g_free(text);
}

int main(void)
{
	first("", "VAR\n  N : INT;\n  L1 : Lift;\n  L2 : Lift;\nEND_VAR\n", "Lift", "Main.L1");
	first("VAR\n  L0 : Lift;\nEND_VAR\n", "VAR\n  L1 : Lift;\nEND_VAR\n", "Lift", "L0");
	first("", "VAR\n  C : Cell;\nEND_VAR\n", "Lift", "Main.C.Door");
	first("VAR\n  C : Cell;\nEND_VAR\n", "", "Lift", "C.Door");
	first("", "VAR\n  T : TON;\nEND_VAR\n", "Lift", "none");
	first("", "VAR\n  A : ARRAY[1..2] OF Lift;\nEND_VAR\n", "Lift", "none");
	first("", "VAR\n  L1 : Lift;\nEND_VAR\n", "Main", "none");
	return tap_done();
}
