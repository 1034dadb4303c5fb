/* SPDX-License-Identifier: MIT
 *
 * test_lists - typing in the text of a POU: text that cannot be read yet, or holds more or
 * fewer POUs. No display.
 */
#include "editor-gtk/sim/sim.h"

#include "tests/tap.h"

#include <string.h>

static const char SAMPLE[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main IL\n  LD    Start\n  ST    %QX0.0\nEND_PROGRAM\n\n"
	"PROGRAM Other IL\n  LD    Start\n  ST    %QX0.3\nEND_PROGRAM\n\n"
	"PROGRAM Last LD\nRUNG\n  | NO Start | COIL %QX0.1 |\nEND_PROGRAM\n";

static void is_not_simulated(LadderDocument *document)
{
	LadderSim *sim = ladder_sim_new(document);
	GError *error = NULL;

	CHECK(!ladder_sim_begin(sim, &error) && error && !ladder_sim_is_on(sim));
	g_clear_error(&error);
	g_object_unref(sim);
}

/* The change touches no other POU, keeps the text as typed, and is reported at its line. */
static void test_put(LadderDocument *document, const char *list, enum diag_id id,
		     const char *about, int line)
{
	const struct diag_list *diags = ladder_document_diags(document);
	const struct diag *diag;
	char *text, *seen;

	CHECK(ladder_document_put_list(document, 1, list));
	CHECK(ladder_document_project(document)->pou_count == 3);
	seen = ladder_document_list(document, 1);
	CHECK_TEXT(seen, list);
	text = ladder_document_text(document, NULL);
	CHECK(strstr(text, list) && strstr(text, "PROGRAM Main IL\n  LD    Start\n") &&
	      strstr(text, "PROGRAM Last LD\nRUNG\n"));
	ladder_document_check_now(document);
	diag = &diags->diag[diags->count - 1];
	CHECK(diags->errors == 1 && diag->id == id && diag->line == line);
	CHECK_TEXT(diag->arg, about);
	CHECK_TEXT(diag->pou, "Other");
	is_not_simulated(document);
	g_free(text);
	g_free(seen);
}

static bool has(LadderDocument *document, const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool found = strstr(text, part);

	g_free(text);
	return found;
}

/* After an undo, positions in the text are computed again. */
static void test_round_it(LadderDocument *document)
{
	ladder_document_begin(document, "both", NULL);
	CHECK(ladder_document_splice(document, 2, 0, 1, NULL, 0, NULL));
	CHECK(ladder_document_put_list(document, 1, "PROGRAM Other IL\n  LD Start\nEND_PROGRAM\n"));
	ladder_document_end(document);
	CHECK(!has(document, "COIL %QX0.1"));
	CHECK(ladder_document_undo(document) && has(document, "COIL %QX0.1"));
	CHECK(ladder_document_put_list(document, 1, "PROGRAM Other IL\n  LDN Start\nEND_PROGRAM\n"));
	CHECK(has(document, "LDN   Start") && has(document, "COIL %QX0.1"));
	CHECK(ladder_document_undo(document) && has(document, SAMPLE));
}

int main(void)
{
	LadderDocument *document = ladder_document_new();
	char *text;

	ladder_document_open_text(document, NULL, SAMPLE, strlen(SAMPLE), true);
	test_put(document, "", DIAG_EXPECTED, "PROGRAM", 12);
	test_put(document, "(* none *)\n", DIAG_EXPECTED, "PROGRAM", 12);
	test_put(document, "PROGRAM Other IL\n  LD Start\nEND_PROGRAM\n"
		 "PROGRAM More IL\n  LD Start\nEND_PROGRAM\n", DIAG_MISPLACED, "More", 15);
	test_put(document, "PROGRAM Other IL\n  LD Start\nEND_PROGRAM\n"
		 "TYPE\n  Pair : STRUCT\n    A : INT;\n  END_STRUCT;\nEND_TYPE\n",
		 DIAG_MISPLACED, "", 12);
	test_put(document, "PROGRAM Other IL\n  LD Start\nEND_PROGRAM\n(* of what follows *)\n",
		 DIAG_MISPLACED, "", 12);
	while (ladder_document_undo(document))
		;
	test_round_it(document);
	/* One added and one deleted: the same number, but others. */
	CHECK(ladder_document_put_list(document, 1, "") &&
	      ladder_document_put_list(document, 0, "PROGRAM Main IL\nEND_PROGRAM\n"
				       "PROGRAM More IL\nEND_PROGRAM\n"));
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors > 0);
	is_not_simulated(document);
	CHECK(ladder_document_undo(document));
	CHECK(ladder_document_put_list(document, 1, "PROGRAM Mine IL\n  LD Start\nEND_PROGRAM\n"));
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors == 0);
	while (ladder_document_undo(document))
		;
	text = ladder_document_text(document, NULL);
	CHECK_TEXT(text, SAMPLE);
	g_free(text);
	g_object_unref(document);
	return tap_done();
}
