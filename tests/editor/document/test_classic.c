/* SPDX-License-Identifier: MIT
 *
 * test_classic - a document imported from ClassicLadder: drawings of the original rungs,
 * the original of each rung after any edits, and export. No display.
 *
 * Drawings are compared with tests/editor/drawing/classic-*.strokes; --bless writes them.
 */
#include "editor-gtk/document/classic.h"
#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/document/report_lines.h"
#include "tests/editor/lines.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <libintl.h>
#include <locale.h>
#include <string.h>
#include <unistd.h>

#define PROJECTS "tests/classic/projects/"
#define DRAWINGS "tests/editor/drawing/"

static bool bless;
static struct lettering *lettering;

struct opened { LadderDocument *document; LadderOrigin *origin; };

static struct opened open_project(const char *name)
{
	char *path = g_strconcat(PROJECTS, name, NULL), *text;
	struct opened opened = { ladder_document_new(), NULL };
	struct ladder *ladder;
	gsize len;

	text = classic_import(path, &len, &ladder, NULL);
	if (!CHECK_AS(text, name))
		return opened;
	ladder_document_open_text(opened.document, NULL, text, len, false);
	opened.origin = ladder_origin_new(opened.document, path, ladder);
	g_free(text);
	return opened;
}

static void close_project(struct opened opened)
{
	g_clear_object(&opened.origin);
	g_object_unref(opened.document);
}

/* ---- drawings ---- */

static void compare(const struct picture *picture, const char *name)
{
	char *path = g_strdup_printf(DRAWINGS "%s.strokes", name);
	char *got = picture_lines(picture), *want = NULL;

	if (bless)
		g_file_set_contents(path, got, -1, NULL);
	g_file_get_contents(path, &want, NULL, NULL);
	CHECK_AS(want && strcmp(got, want) == 0, name);
	g_free(path);
	g_free(got);
	g_free(want);
}

/* Draws each rung, and checks that nothing is outside of the picture. */
static void draw_project(const char *name, const char *as)
{
	struct opened opened = open_project(name);
	const struct classic_project *project = opened.origin ?
		ladder_origin_project(opened.origin) : NULL;

	for (int i = 0; project && i < project->rungs; i++) {
		const struct classic_scene scene = { project, project->rung[i], lettering,
						     theme_get(THEME_LIGHT, THEME_GREEN) };
		char *file = g_strdup_printf("classic-%s-%d", as, project->rung[i]->number);
		struct picture picture;
		bool inside = true;

		picture_init(&picture);
		picture.height = grid_classic_draw(&scene, &picture);
		for (int n = 0; n < picture.count; n++)
			inside = inside && picture.stroke[n].x >= 0 &&
				 picture.stroke[n].y >= 0 &&
				 picture.stroke[n].x <= picture.width &&
				 picture.stroke[n].y <= picture.height;
		CHECK_AS(inside, "the drawing is inside its picture");
		compare(&picture, file);
		picture_clear(&picture);
		g_free(file);
	}
	close_project(opened);
}

/* ---- rungs and their originals ---- */

/* Number of the original of rung @rung of POU @pou; -1: none. */
static int from(struct opened opened, int pou, int rung)
{
	const struct classic_rung *one = ladder_origin_of(opened.origin, pou, rung);

	return one ? one->number : -1;
}

/* Compares the originals of a POU, as "0 0 1 2 2". */
static bool all_from(struct opened opened, int pou, const char *want)
{
	const struct project *project = ladder_document_project(opened.document);
	GString *got = g_string_new(NULL);
	bool same;

	for (int i = 0; i < project->pou[pou].rung_count; i++)
		g_string_append_printf(got, "%s%d", i ? " " : "", from(opened, pou, i));
	same = strcmp(got->str, want) == 0;
	if (!same)
		printf("# got %s, wanted %s\n", got->str, want);
	g_string_free(got, TRUE);
	return same;
}

static void delete_rung(struct opened opened, int rung)
{
	CHECK(ladder_document_splice(opened.document, 0, rung, 1, NULL, 0, NULL));
}

/* Replaces the first @what by @with. */
static void replace(struct opened opened, const char *what, const char *with)
{
	gsize len;
	char *text = ladder_document_outline(opened.document, &len, NULL, NULL);
	const char *at = strstr(text, what);

	ladder_document_begin(opened.document, "test", NULL);
	CHECK_AS(at && ladder_document_replace(opened.document, (gsize)(at - text),
					       strlen(what), with, NULL), what);
	ladder_document_end(opened.document);
	g_free(text);
}

static void test_follows(void)
{
	struct opened opened = open_project("linuxcnc.clp");
	LadderDocument *document = opened.document;
	const char *whole = "0 0 1 2 2";
	struct rung *empty = rung_new(1, 1);

	CHECK(all_from(opened, 0, whole));
	delete_rung(opened, 0);
	CHECK(all_from(opened, 0, "0 1 2 2"));
	delete_rung(opened, 1);
	CHECK(all_from(opened, 0, "0 2 2"));
	ladder_document_undo(document);
	ladder_document_undo(document);
	CHECK(all_from(opened, 0, whole));
	CHECK(ladder_document_move_rung(document, 0, 2, 0));
	CHECK(all_from(opened, 0, "1 0 0 2 2"));
	ladder_document_undo(document);
	CHECK(ladder_document_splice(document, 0, 1, 0, &empty, 1, NULL));
	CHECK(all_from(opened, 0, "0 -1 0 1 2 2"));
	ladder_document_undo(document);
	/* An edited rung keeps its original; so does one in whose text a name changed. */
	empty = rung_new(1, 1);
	CHECK(ladder_document_put_rung(document, 0, 2, empty, NULL));
	CHECK(all_from(opened, 0, whole));
	ladder_document_undo(document);
	replace(opened, "PROGRAM Prog1 LD", "PROGRAM Another LD");
	CHECK(all_from(opened, 0, whole));
	ladder_document_undo(document);
	replace(opened, "PROGRAM Prog1 LD", "PROGRAM First LD\nRUNG\nEND_PROGRAM\n\n"
		"PROGRAM Prog1 LD");
	CHECK(all_from(opened, 0, "-1") && all_from(opened, 1, whole));
	ladder_document_undo(document);
	CHECK(all_from(opened, 0, whole));
	close_project(opened);
}

/* Random edits of any kind, then all undone: all originals are back. */
static void test_storm(void)
{
	struct opened opened = open_project("elements.clprj");
	GRand *random = g_rand_new_with_seed(9);
	const int pous = ladder_document_project(opened.document)->pou_count;
	int *first[16] = { 0 };

	for (int i = 0; i < pous && i < 16; i++) {
		const struct pou *pou = &ladder_document_project(opened.document)->pou[i];

		first[i] = g_new(int, pou->rung_count + 1);
		for (int n = 0; n < pou->rung_count; n++)
			first[i][n] = from(opened, i, n);
	}
	for (int i = 0; i < 400; i++) {
		const int pou = g_rand_int_range(random, 0, pous);
		const int count =
			ladder_document_project(opened.document)->pou[pou].rung_count;
		const int a = count ? g_rand_int_range(random, 0, count) : 0;

		if (!count || g_rand_int_range(random, 0, 3) == 0)
			ladder_document_undo(opened.document);
		else if (g_rand_boolean(random))
			ladder_document_move_rung(opened.document, pou, a,
						  g_rand_int_range(random, 0, count));
		else
			ladder_document_splice(opened.document, pou, a, 1, NULL, 0, NULL);
	}
	while (ladder_document_undo(opened.document))
		;
	for (int i = 0; i < pous && i < 16; i++) {
		const struct pou *pou = &ladder_document_project(opened.document)->pou[i];
		bool same = true;

		for (int n = 0; n < pou->rung_count; n++)
			same = same && from(opened, i, n) == first[i][n];
		CHECK_AS(same, "undo restores all originals");
		g_free(first[i]);
	}
	g_rand_free(random);
	close_project(opened);
}

/* ---- the report ---- */

static void test_report(void)
{
	struct opened opened = open_project("linuxcnc.clp");
	GPtrArray *rows = report_lines_import(opened.origin, opened.document);
	const LadderPanelRow *row = rows->pdata[0];
	char *title = report_lines_title("x.clp", rows);

	CHECK_TEXT(title, "x.clp: 1 changed, 3 left out");
	CHECK_TEXT(panel_row_text(row, REPORT_THERE), "rung_1.csv:24");
	CHECK_TEXT(panel_row_text(row, REPORT_HERE), "Prog1, rung 3");
	CHECK(row->pou == 0 && row->rung == 2 && row->tone == PANEL_WARNING);
	g_free(title);
	g_ptr_array_unref(rows);
	delete_rung(opened, 2);
	rows = report_lines_import(opened.origin, opened.document);
	CHECK_TEXT(panel_row_text(rows->pdata[0], REPORT_HERE), "");
	g_ptr_array_unref(rows);
	close_project(opened);
	/* A numeric file has no members: lines alone identify the rung. */
	opened = open_project("numeric.txt");
	CHECK(ladder_origin_at(opened.origin, "", 0) == NULL);
	CHECK(ladder_origin_at(opened.origin, "", 1000000) == NULL);
	CHECK(from(opened, 0, 0) >= 0);
	close_project(opened);
}

/* Texts of all reports of @name: of its import, and of its export to each kind of file. */
static void add_reports(const char *name, const char *folder, GPtrArray *texts)
{
	static const char *const names[] = { "a.clprj", "a.clp", "a.txt" };
	struct opened opened = open_project(name);
	const struct classic_report *report = ladder_origin_report(opened.origin);
	GPtrArray *lines = g_ptr_array_new_with_free_func(left_line_free);

	for (int i = 0; i < report->count; i++)
		g_ptr_array_add(texts, g_strdup(report->line[i].text));
	for (gsize i = 0; i < G_N_ELEMENTS(names); i++) {
		char *path = g_build_filename(folder, names[i], NULL);

		classic_save(opened.document, path, lines, NULL);
		g_unlink(path);
		g_free(path);
	}
	for (guint i = 0; i < lines->len; i++) {
		const struct left_line *line = lines->pdata[i];

		if (!line->refused)
			g_ptr_array_add(texts, g_strdup(line->text));
	}
	g_ptr_array_unref(lines);
	close_project(opened);
}

static GPtrArray *all_reports(const char *folder)
{
	static const char *const names[] = { "elements.clprj", "charts.clprj", "faults.clprjz",
		"linuxcnc.clp", "expressions.clprj", "members.clprj", "sections.clprj",
		"pages.clprj", "numeric.txt" };
	GPtrArray *texts = g_ptr_array_new_with_free_func(g_free);

	for (gsize i = 0; i < G_N_ELEMENTS(names); i++)
		add_reports(names[i], folder, texts);
	return texts;
}

/* A report in German has the lines of the English one, each with other words. */
static void test_german(const char *folder)
{
	GPtrArray *english = all_reports(folder), *german;
	const char *build = g_getenv("BUILD");
	char *locale = g_build_filename(build ? build : "build", "locale", NULL);
	bool first = false;

	g_setenv("LC_ALL", "C.UTF-8", TRUE);
	g_setenv("LANGUAGE", "de", TRUE);
	setlocale(LC_ALL, "");
	bindtextdomain("rungboard", locale);
	bind_textdomain_codeset("rungboard", "UTF-8");
	textdomain("rungboard");
	german = all_reports(folder);
	CHECK(english->len > 40 && german->len == english->len);
	for (guint i = 0; i < german->len && i < english->len; i++) {
		const char *text = german->pdata[i];

		CHECK_AS(strcmp(text, english->pdata[i]) != 0, text);
		first = first || g_str_has_prefix(text, "ClassicLadder von LinuxCNC: 4 Strompfade, ");
	}
	CHECK_AS(first, "the counts are in German");
	g_ptr_array_unref(german);
	g_ptr_array_unref(english);
	g_free(locale);
}

/* ---- export ---- */

static bool save(LadderDocument *document, const char *path, GPtrArray *lines)
{
	GError *error = NULL;
	const bool good = classic_save(document, path, lines, &error);

	CHECK(good == !error);
	g_clear_error(&error);
	return good;
}

static void test_refused(const char *folder)
{
	static const char text[] = "RUNGBOARD 1\n\nVAR\n  Level : REAL;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nRUNG\n  | [ Level > 1.5 ] | "
		"COIL %QX0.1 |\nEND_PROGRAM\n";
	char *path = g_build_filename(folder, "r.clprj", NULL);
	GPtrArray *lines = g_ptr_array_new_with_free_func(left_line_free), *rows;
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	g_file_set_contents(path, "old", -1, NULL);
	CHECK(!save(document, path, lines));
	rows = report_lines_export(lines, document);
	CHECK(rows->len == 1 && ((LadderPanelRow *)rows->pdata[0])->rung == 1);
	g_ptr_array_unref(rows);
	/* Existing files stay; an unknown ending is refused. */
	CHECK(g_file_test(path, G_FILE_TEST_EXISTS) && !save(document, "x.rung", lines));
	ladder_document_open_text(document, NULL, "nonsense", 8, true);
	CHECK(!save(document, path, lines));
	g_unlink(path);
	g_object_unref(document);
	g_ptr_array_unref(lines);
	g_free(path);
}

static void test_written(const char *folder)
{
	static const char *const names[] = { "a.clprj", "a.CLPRJZ", "a.clp", "a.txt" };
	LadderDocument *document = ladder_document_new();
	GPtrArray *lines = g_ptr_array_new_with_free_func(left_line_free);
	static const char text[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n"
		"  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n";

	ladder_document_open_text(document, NULL, text, strlen(text), false);
	for (gsize i = 0; i < G_N_ELEMENTS(names); i++) {
		char *path = g_build_filename(folder, names[i], NULL);

		CHECK_AS(save(document, path, lines), names[i]);
		CHECK_AS(classic_is_project(path), names[i]);
		g_unlink(path);
		g_free(path);
	}
	CHECK(!ladder_document_is_saved(document) && !ladder_document_path(document));
	CHECK(classic_save_is("/x/a.clprj") && classic_save_is("a.CLP") &&
	      !classic_save_is("a.txt") && !classic_save_is("clprj"));
	g_ptr_array_unref(lines);
	g_object_unref(document);
}

/* File choosers begin in this folder. */
static void test_folder(const char *folder)
{
	struct opened opened = open_project("oldest.clp");
	char *whole = g_canonicalize_filename(PROJECTS, NULL), *path;
	char *of = ladder_document_folder(opened.document);

	CHECK_AS(g_strcmp0(of, whole) == 0, "an imported project begins in the original's folder");
	g_free(of);
	path = g_build_filename(folder, "x.rung", NULL);
	CHECK(ladder_document_save(opened.document, path, NULL));
	of = ladder_document_folder(opened.document);
	CHECK_AS(g_strcmp0(of, folder) == 0, "a saved project begins in its own folder");
	g_free(of);
	ladder_document_open_text(opened.document, NULL, "RUNGBOARD 1\n", 12, false);
	CHECK_AS(!ladder_document_folder(opened.document), "a new text has no folder");
	g_unlink(path);
	g_free(path);
	g_free(whole);
	close_project(opened);
}

int main(int argc, char **argv)
{
	char *folder = g_dir_make_tmp("rungboard-classic-XXXXXX", NULL);

	bless = argc > 1 && strcmp(argv[1], "--bless") == 0;
	lettering = lettering_new(NULL, NULL);
	draw_project("elements.clprj", "elements");
	draw_project("linuxcnc.clp", "linuxcnc");
	draw_project("oldest.clp", "oldest");
	test_follows();
	test_storm();
	test_report();
	test_refused(folder);
	test_written(folder);
	test_folder(folder);
	test_german(folder); /* last: the language remains */
	lettering_free(lettering);
	g_rmdir(folder);
	g_free(folder);
	return tap_done();
}
