/* SPDX-License-Identifier: MIT
 *
 * test_pou_convert - a POU in another language: from each language to each, as one step of the history
 * that changes this POU alone, or refused with a place.
 */
#include "editor-gtk/document/pou_convert.h"

#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static const char PROGRAM[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Go AT %IX0.0 : BOOL;\n  Lamp AT %QX0.0 : BOOL;\n  Horn AT %QX0.1 : BOOL;\n"
	"  A AT %QX1.0 : BOOL;\n  B AT %QX1.1 : BOOL;\n  C AT %QX1.2 : BOOL;\n  D AT %QX1.3 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Rungs LD\nVAR\n  Wait : TON;\nEND_VAR\nRUNG \"Seal\"\n  | NO Go | TON Wait PT:=T#1s | COIL A |\n"
	"RUNG\n  | P Go | S Horn |\nEND_PROGRAM\n\n"
	"PROGRAM Nets FBD\nNETWORK\n  Both := Go AND A\n  B := Both\nEND_PROGRAM\n\n"
	"PROGRAM Chart SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Run:\n    C(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Run := Go; END_TRANSITION\n"
	"  TRANSITION FROM Run TO Start := NOT Go; END_TRANSITION\nEND_PROGRAM\n\n"
	"PROGRAM Other SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Run:\n    Lamp(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Run := Go; END_TRANSITION\n"
	"  TRANSITION FROM Run TO Start := NOT Go; END_TRANSITION\nEND_PROGRAM\n\n"
	"PROGRAM Lines ST\n  IF Go THEN\n    D := TRUE;\n  END_IF;\nEND_PROGRAM\n\n"
	"PROGRAM List IL\n  LD    Go\n  ST    %QX2.0\nEND_PROGRAM\n";

static LadderDocument *document;
static struct diag_list why;

static int pou_of(const char *name)
{
	return project_find_pou(ladder_document_project(document), name, strlen(name));
}

static char *text_now(void)
{
	return ladder_document_text(document, NULL);
}

/* Every POU but the one as it was, byte by byte. */
static bool others_stay(struct ladder *was, const char *name, const char *before)
{
	const struct project *project = ladder_document_project(document);
	int same = 0;

	for (int i = 0; i < project->pou_count; i++) {
		char *pou = ladder_document_list(document, i);

		if (!pou_is_made(ladder_project(was), name, project, i))
			same += strstr(before, pou) != NULL;
		g_free(pou);
	}
	return same == ladder_project(was)->pou_count - 1;
}

static bool all_in(struct ladder *was, const char *name, enum pou_language to)
{
	const struct project *project = ladder_document_project(document);
	int made = 0;

	for (int i = 0; i < project->pou_count; i++) {
		if (!pou_is_made(ladder_project(was), name, project, i))
			continue;
		made++;
		if (project->pou[i].language != to)
			return false;
	}
	return made > 0;
}

static struct ladder *built(const char *text)
{
	struct ladder *ladder = ladder_new();
	const bool good = ladder_load_text(ladder, "", text, strlen(text)) && ladder_build(ladder);

	CHECK_AS(good, "it is a program");
	return ladder;
}

static void test_one(const char *name, enum pou_language to, bool should)
{
	char *before = text_now(), *said = g_strdup_printf("%s to %s", name, pou_language_word(to)), *after;
	struct ladder *was = built(before);
	const bool did = pou_convert(document, pou_of(name), to, &why);

	CHECK_AS(did == should, said);
	after = text_now();
	if (did) {
		CHECK_AS(all_in(was, name, to), "what comes from it has the new language");
		CHECK_AS(others_stay(was, name, before), "the other POUs stay as they were");
		ladder_free(built(after));
		CHECK(ladder_document_undo(document) && !ladder_document_undo_name(document));
		g_free(after);
		after = text_now();
	} else {
		CHECK_AS(why.errors > 0 && g_strcmp0(why.diag[0].pou, name) == 0, "a refusal has its place");
	}
	CHECK_AS(strcmp(before, after) == 0, "the text is as before");
	ladder_free(was);
	g_free(after);
	g_free(before);
	g_free(said);
}

/* L: to LD, I: IL, C: SFC, S: ST, F: FBD. */
static void test_all(void)
{
	static const struct { const char *name, *to; } pous[] = {
		{ "Rungs", "ISF" }, { "Nets", "LIS" }, { "Chart", "LISF" }, { "Lines", "I" }, { "List", "" },
	};
	static const char letters[] = "LICSF";

	for (gsize i = 0; i < G_N_ELEMENTS(pous); i++)
		for (int to = LANGUAGE_LD; to <= LANGUAGE_FBD; to++)
			test_one(pous[i].name, (enum pou_language)to, strchr(pous[i].to, letters[to]));
}

static void test_reasons(void)
{
	static const char text[] =
		"RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | NO Go | COIL %QX0.0 |\nRUNG\n  | NO Go | STOP |\nEND_PROGRAM\n";
	char *made;

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	made = pou_converted(document, 0, LANGUAGE_ST, &why);
	CHECK_AS(!made && why.errors == 1 && why.diag[0].rung == 2 && why.diag[0].row == 1 && why.diag[0].col == 2,
		 "the reason has the cell");
	g_free(made);
}

/* A block of a file that is included: the reason has the place in that file. */
static void test_included(void)
{
	static const char text[] = "RUNGBOARD 1\n\nINCLUDE \"belt.rung\"\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
				   "END_PROGRAM\n";
	static const char belt[] = "RUNGBOARD 1\n\n\nPROGRAM Belt LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL), *path = g_build_filename(folder, "main.rung", NULL);
	char *other = g_build_filename(folder, "belt.rung", NULL);
	LadderDocument *outer = document;

	CHECK(g_file_set_contents(path, text, -1, NULL) && g_file_set_contents(other, belt, -1, NULL));
	document = ladder_document_new();
	CHECK(ladder_document_open(document, path, NULL) && pou_of("Belt") >= 0);
	for (int to = LANGUAGE_IL; to <= LANGUAGE_FBD; to++) {
		CHECK(!pou_convert(document, pou_of("Belt"), (enum pou_language)to, &why));
		CHECK_AS(why.errors == 1 && why.diag[0].id == DIAG_CONVERT_INCLUDED && why.diag[0].line == 4 &&
			 g_str_has_suffix(why.diag[0].file, "belt.rung"), "its file is named, with the line there");
	}
	g_object_unref(document);
	document = outer;
	remove(path);
	remove(other);
	remove(folder);
	g_free(other);
	g_free(path);
	g_free(folder);
}

static void test_errors(void)
{
	static const char text[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO Missing | COIL %QX0.0 |\nEND_PROGRAM\n";

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK_AS(!pou_convert(document, 0, LANGUAGE_ST, &why) && why.errors == 1 && why.diag[0].rung == 1 &&
		 why.diag[0].id == DIAG_UNKNOWN_NAME, "the errors of the program are the reasons");
	CHECK(!ladder_document_undo_name(document));
}

int main(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, PROGRAM, strlen(PROGRAM), true);
	CHECK(ladder_document_project(document));
	test_all();
	test_reasons();
	test_included();
	test_errors();
	g_object_unref(document);
	return tap_done();
}
