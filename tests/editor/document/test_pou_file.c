/* SPDX-License-Identifier: MIT
 *
 * test_pou_file - a POU moves to another file: the project still builds, one undo restores both
 * files, and what cannot be is refused with the name of what stands against it.
 */
#include "editor-gtk/document/pou_file.h"

#include "editor-gtk/document/side_file.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <string.h>

static const char MAIN[] =
	"RUNGBOARD 1\n\nTYPE\n  Batch : STRUCT\n    Size : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  S    : Seal;\n  Last : Batch;\nEND_VAR\n\n"
	"PROGRAM First LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n\n"
	"(* the second\n   of three *)\nPROGRAM Second LD\nRUNG\n  | [ Last.Size > 0 ] | COIL %QX0.1 |\n"
	"END_PROGRAM\n\n"
	"PROGRAM Third LD\nRUNG\n  | NO %IX0.2 | Seal S | COIL %QX0.2 |\nEND_PROGRAM\n\n"
	"FUNCTION_BLOCK Seal LD\nVAR_INPUT\n  In : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO In | COIL Q |\nEND_FUNCTION_BLOCK\n";

static LadderDocument *document;
static char *folder, *own;
static LadderSideFile *opened; /* by the last move                              */
static GString *told;

static char *path_of(const char *name)
{
	return g_build_filename(folder, name, NULL);
}

static void put(const char *name, const char *text)
{
	char *path = path_of(name);

	CHECK(g_file_set_contents(path, text, -1, NULL));
	g_free(path);
}

static char *on_disk(const char *name)
{
	char *path = path_of(name), *text = NULL;

	g_file_get_contents(path, &text, NULL, NULL);
	g_free(path);
	return text;
}

static void file_opened(LadderDocument *of, LadderSideFile *file, gpointer unused)
{
	(void)of;
	(void)unused;
	g_set_object(&opened, file);
}

static int lost; /* times that the project could not be read             */

static void project_changed(LadderDocument *of, gpointer unused)
{
	(void)unused;
	lost += !ladder_document_project(of);
}

static void open_main(const char *text)
{
	g_clear_object(&opened);
	g_clear_object(&document);
	document = ladder_document_new();
	g_signal_connect(document, "file-opened", G_CALLBACK(file_opened), NULL);
	g_signal_connect(document, "project-changed", G_CALLBACK(project_changed), NULL);
	put("main.rung", text);
	CHECK(ladder_document_open(document, own, NULL) && ladder_document_project(document));
}

static int number_of(const char *name)
{
	return project_find_pou(ladder_document_project(document), name, strlen(name));
}

static bool move(const char *pou, const char *name)
{
	char *path = path_of(name);
	const bool good = pou_to_file(document, number_of(pou), path, told);

	g_free(path);
	return good;
}

static bool is_refused(const char *pou, const char *name, const char *part)
{
	char *before = ladder_document_text(document, NULL), *after, *disk = on_disk(name), *now;
	const bool good = !move(pou, name) && strstr(told->str, part);
	bool same;

	after = ladder_document_text(document, NULL);
	now = on_disk(name);
	same = strcmp(before, after) == 0 && g_strcmp0(disk, now) == 0 && !opened &&
	       !ladder_document_undo_name(document) && ladder_document_is_saved(document);
	if (!good || !same)
		printf("# %s\n%s\n", told->str, same ? "" : "something changed");
	g_free(now);
	g_free(disk);
	g_free(after);
	g_free(before);
	return good && same;
}

static bool builds(void)
{
	ladder_document_check_now(document);
	return ladder_document_diags(document)->errors == 0 &&
	       ladder_program(ladder_document_checked(document));
}

static char *order(void)
{
	const struct project *project = ladder_document_project(document);
	GString *out = g_string_new(NULL);

	for (int i = 0; i < project->pou_count; i++)
		g_string_append_printf(out, "%s%s ", project_text(project, project->pou[i].name),
				       project->pou[i].included ? "*" : "");
	return g_string_free(out, FALSE);
}

static void is_order(const char *wanted)
{
	char *is = order();

	CHECK_TEXT(is, wanted);
	g_free(is);
}

static void has_text(const char *wanted)
{
	char *text = ladder_document_text(document, NULL);

	CHECK_TEXT(text, wanted);
	g_free(text);
}

/* Both files are saved, and the project is read from the disk. */
static void save_and_read(void)
{
	CHECK(ladder_side_file_save(opened, NULL) && ladder_document_save(document, NULL, NULL));
	g_clear_object(&opened);
	g_clear_object(&document);
	document = ladder_document_new();
	CHECK(ladder_document_open(document, own, NULL) && ladder_document_project(document));
	CHECK(builds());
}

/* Each POU, used or not: the file is made, and the INCLUDE stands where the POU stood. */
static void test_new_file(void)
{
	static const struct { const char *pou, *order; } row[] = {
		{ "First", "First* Second Third Seal " }, { "Second", "First Second* Third Seal " },
		{ "Third", "First Second Third* Seal " }, { "Seal", "First Second Third Seal* " },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(row); i++) {
		char *text, *part;

		open_main(MAIN);
		CHECK(builds() && move(row[i].pou, "part.rung"));
		is_order(row[i].order);
		CHECK(builds());
		text = on_disk("part.rung");
		CHECK_AS(!text && !ladder_document_is_saved(document) && opened &&
			 ladder_side_file_differs(opened), "nothing is saved by the move");
		CHECK(ladder_document_undo(document));
		has_text(MAIN);
		is_order("First Second Third Seal ");
		CHECK_AS(ladder_side_file_is_nothing(opened) && !ladder_side_file_differs(opened),
			 "undo leaves no file");
		CHECK(ladder_document_redo(document));
		is_order(row[i].order);
		part = ladder_side_file_text(opened);
		CHECK(g_str_has_prefix(part, "RUNGBOARD 1\n\n"));
		save_and_read();
		is_order(row[i].order);
		text = on_disk("part.rung");
		CHECK_TEXT(text, part);
		g_free(text);
		text = path_of("part.rung");
		g_unlink(text);
		g_free(text);
		g_free(part);
	}
}

/* A file that was made and saved is deleted when it is empty again and saved. */
static void test_undo_after_save(void)
{
	char *text;

	open_main(MAIN);
	CHECK(move("Second", "part.rung") && ladder_side_file_save(opened, NULL) &&
	      ladder_document_save(document, NULL, NULL));
	text = on_disk("part.rung");
	CHECK_TEXT(text, "RUNGBOARD 1\n\n(* the second\n   of three *)\nPROGRAM Second LD\nRUNG\n"
		   "  | [ Last.Size > 0 ] | COIL %QX0.1 |\nEND_PROGRAM\n");
	CHECK(ladder_document_undo(document) && builds());
	has_text(MAIN);
	CHECK(ladder_side_file_differs(opened) && ladder_side_file_save(opened, NULL));
	g_free(text);
	text = on_disk("part.rung");
	CHECK_AS(!text, "no empty file stays");
	g_free(text);
}

/* To a file that the project includes already: before and behind the programs. */
static void test_included(void)
{
	char *text = g_strdup_printf("%s\nINCLUDE \"more.rung\"\n", MAIN), *more;
	static const char MORE[] = "RUNGBOARD 1\n\nPROGRAM Final LD\nRUNG\n  | NO %IX0.7 | COIL %QX0.7 |\n"
				   "END_PROGRAM\n";

	put("more.rung", MORE);
	open_main(text);
	CHECK(move("Seal", "more.rung") && builds());
	is_order("First Second Third Final* Seal* ");
	CHECK(!strstr(told->str, "order"));
	CHECK(move("First", "more.rung") && builds());
	is_order("Second Third Final* Seal* First* ");
	CHECK(strstr(told->str, "order: Second, Third, Final, First"));
	CHECK(ladder_document_undo(document) && ladder_document_undo(document));
	has_text(text);
	is_order("First Second Third Seal Final* ");
	more = ladder_side_file_text(opened);
	CHECK_TEXT(more, MORE);
	CHECK(!ladder_side_file_differs(opened));
	CHECK(ladder_document_redo(document) && ladder_document_redo(document));
	save_and_read();
	is_order("Second Third Final* Seal* First* ");
	g_free(more);
	g_free(text);
}

static void test_typed_in_part(void)
{
	open_main(MAIN);
	CHECK(move("Seal", "typed.rung"));
	ladder_side_file_append(opened, "\nPROGRAM Typed LD\nRUNG\nEND_PROGRAM\n");
	CHECK_AS(number_of("Typed") >= 0, "what is typed in a part is in the project at once");
	CHECK(ladder_document_undo(document) && number_of("Typed") < 0 && builds());
	ladder_side_file_append(opened, "nonsense\n");
	CHECK_AS(number_of("Seal") >= 0 && !builds(), "the check reports what cannot be read");
	CHECK(ladder_document_undo(document) && builds());
}

/* A project of its own gets a copy with all that it needs, and only if nothing here uses it. */
static void test_foreign(void)
{
	static const char OTHER[] = "RUNGBOARD 1\n\nPROGRAM Other LD\nRUNG\n"
				    "  | NO %IX0.7 | COIL %QX0.7 |\nEND_PROGRAM\n";
	char *text;

	put("other.rung", OTHER);
	open_main(MAIN);
	CHECK(is_refused("Seal", "other.rung", "“Third” uses “Seal”, so this project must include "
			 "“other.rung”"));
	CHECK(move("Second", "other.rung") && number_of("Second") < 0 && builds());
	text = ladder_side_file_text(opened);
	CHECK(strstr(text, "PROGRAM Other") && strstr(text, "PROGRAM Second") &&
	      strstr(text, "Batch : STRUCT") && strstr(text, "Last : Batch"));
	CHECK(ladder_document_undo(document));
	has_text(MAIN);
	g_free(text);
	text = ladder_side_file_text(opened);
	CHECK_TEXT(text, OTHER);
	g_free(text);
}

static void test_refused(void)
{
	static const char PARTS[] = "RUNGBOARD 1\n\nFUNCTION_BLOCK Late LD\nRUNG\n"
				    "END_FUNCTION_BLOCK\n";
	char *text = g_strdup_printf("RUNGBOARD 1\n\nUSES \"library.rung\"\n%s",
				     MAIN + strlen("RUNGBOARD 1\n")), *circle;

	open_main(MAIN);
	circle = g_strdup_printf("%s\nINCLUDE \"main.rung\"\n", PARTS);
	put("circle.rung", circle);
	CHECK(is_refused("Seal", "circle.rung", "“circle.rung” includes “main.rung”, so “main.rung” "
			 "cannot include it. Delete that INCLUDE there first"));
	put("damaged.rung", "RUNGBOARD 1\n\nPROGRAM\n");
	CHECK(is_refused("Seal", "damaged.rung", ""));
	put("same.rung", "RUNGBOARD 1\n\nFUNCTION_BLOCK First LD\nRUNG\nEND_FUNCTION_BLOCK\n");
	CHECK(is_refused("Seal", "same.rung", "First"));
	CHECK(is_refused("Seal", "main.rung", "This is the file of this project"));
	put("library.rung", PARTS);
	open_main(text);
	CHECK(is_refused("First", "library.rung", "“library.rung” is a library (USES)"));
	CHECK(is_refused("Late", "part.rung", "declared in another file"));
	CHECK(move("Seal", "library.rung") && builds());
	g_clear_object(&document);
	document = ladder_document_new();
	CHECK(!move("Main", "part.rung") && strstr(told->str, "Save the project first"));
	g_free(circle);
	g_free(text);
}

static void test_names(void)
{
	char *name, *why;

	open_main(MAIN);
	name = pou_file_name(document, number_of("Seal"));
	CHECK_TEXT(name, "Seal.rung");
	CHECK(!pou_file_refusal(document, name));
	g_free(name);
	why = pou_file_refusal(document, "main");
	CHECK_AS(why && strstr(why, "exists"), "the ending is added");
	g_free(why);
	why = pou_file_refusal(document, "");
	CHECK(why);
	g_free(why);
	why = pou_file_refusal(document, "nowhere/part.rung");
	CHECK(why && strstr(why, "no such folder"));
	g_free(why);
	CHECK(g_mkdir(folder, 0700) != 0);
	name = path_of("parts");
	CHECK(g_mkdir(name, 0700) == 0);
	CHECK(move("Seal", "parts/seal.rung") && builds());
	why = ladder_document_text(document, NULL);
	CHECK(strstr(why, "INCLUDE \"parts/seal.rung\""));
	g_free(why);
	g_free(name);
}

int main(void)
{
	char *clean;

	folder = g_dir_make_tmp(NULL, NULL);
	own = path_of("main.rung");
	told = g_string_new(NULL);
	test_new_file();
	test_undo_after_save();
	test_included();
	test_typed_in_part();
	test_foreign();
	test_refused();
	test_names();
	g_clear_object(&opened);
	g_clear_object(&document);
	CHECK_AS(lost == 0, "the project can be read at every moment of a move, an undo and a redo");
	clean = g_strdup_printf("rm -r '%s'", folder);
	CHECK(g_spawn_command_line_sync(clean, NULL, NULL, NULL, NULL));
	g_free(clean);
	g_string_free(told, TRUE);
	g_free(own);
	g_free(folder);
	return tap_done();
}
