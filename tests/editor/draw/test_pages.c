/* SPDX-License-Identifier: MIT
 *
 * test_pages - projects on paper, as `--render` puts them into a PDF.
 *
 * Uses pdftotext where that is installed.
 */
#include "editor-gtk/draw/pages.h"
#include "tests/editor/drawn.h"
#include "tests/editor/rendered.h"

#include <stdlib.h>
#include <sys/resource.h>

static bool has_glyphs(const char *text)
{
	PangoContext *context = lettering_context();
	PangoLayout *layout = pango_layout_new(context);

	pango_layout_set_text(layout, text, -1);
	int unknown = pango_layout_get_unknown_glyphs_count(layout);
	g_object_unref(layout);
	g_object_unref(context);
	return unknown == 0;
}

/* pt from top to bottom of the lowest text in a listing of boxes. */
static double smallest_type(const char *name)
{
	char *path = in_folder(name), *text = NULL;
	double smallest = 1000;

	g_file_get_contents(path, &text, NULL, NULL);
	for (char *at = text; at && (at = strstr(at, "yMin=\"")) != NULL; at++) {
		const char *end = strstr(at, "yMax=\"");

		if (end)
			smallest = MIN(smallest, g_ascii_strtod(end + 6, NULL) -
						 g_ascii_strtod(at + 6, NULL));
	}
	g_free(text);
	g_free(path);
	return smallest;
}

static void check_pdf(void)
{
	CHECK(render(SHAPES " -o OUT/a.pdf") == 0);
	CHECK(render(SHAPES " -o OUT/b.pdf") == 0 && same("a.pdf", "b.pdf"));
	CHECK(render(SHAPES " --paper letter --landscape --date 2026-03-01 -o OUT/c.pdf") ==
	      0);
	char *tool = g_find_program_in_path("pdftotext");
	if (!tool) {
		printf("# no pdftotext here\n");
		return;
	}
	g_free(tool);
	char *line = g_strdup_printf("pdftotext -layout %s/a.pdf %s/a.txt && "
				     "pdftotext -layout %s/c.pdf %s/c.txt", folder, folder,
				     folder, folder);
	CHECK(system(line) == 0);
	g_free(line);
	CHECK(has("a.txt", "PROGRAM Main"));
	if (has_glyphs("启动按钮，常开"))
		CHECK(has("a.txt", "启动按钮，常开"));
	else
		printf("# no font with Chinese here\n");
	CHECK(has("a.txt", "read in Main 1"));
	CHECK(has("a.txt", "Global symbols") && has("a.txt", "Symbols of Main"));
	CHECK(has("a.txt", "1 of ") && has("a.txt", "shapes.rung"));
	CHECK(!has("a.txt", "Date") && has("c.txt", "2026-03-01"));
}

/* A wide chart stays legible: it continues on further pages, and cut texts are listed
 * below. */
static void check_wide_chart(void)
{
	char *tool = g_find_program_in_path("pdftotext"), *line;

	CHECK(render("ladders/washing-machine.rung -o OUT/wide.pdf") == 0);
	if (!tool)
		return;
	line = g_strdup_printf("pdftotext -layout %s/wide.pdf %s/wide.txt && pdftotext "
			       "-bbox %s/wide.pdf %s/wide.html", folder, folder, folder,
			       folder);
	CHECK(system(line) == 0);
	CHECK(has("wide.txt", "PROGRAM Washing, part 1") &&
	      has("wide.txt", "PROGRAM Washing, part 2") && !has("wide.txt", "part 3"));
	CHECK(has("wide.txt", "If the bolt does not shut, end and release the door."));
	CHECK(has("wide.txt", "washing-machine.rung") && has("wide.txt", "5 of 5"));
	CHECK_AS(smallest_type("wide.html") >= 5.0, "no type is smaller than 5 pt");
	g_free(line);
	g_free(tool);
}

/* pt from top to bottom of a word in a listing of boxes; 0: not found. */
static double type_of(const char *name, const char *word)
{
	char *all = content(name, NULL), *end = g_strdup_printf(">%s</word>", word);
	char *at = strstr(all, end), *top, *bottom;
	double size = 0;

	if (at) {
		*at = '\0';
		top = g_strrstr(all, "yMin=\"");
		bottom = g_strrstr(all, "yMax=\"");
		size = g_ascii_strtod(bottom + 6, NULL) - g_ascii_strtod(top + 6, NULL);
	}
	g_free(end);
	g_free(all);
	return size;
}

static bool list_boxes(const char *name)
{
	char *tool = g_find_program_in_path("pdftotext"), *line;
	bool can = tool != NULL;

	line = g_strdup_printf("pdftotext -bbox %s/%s.pdf %s/%s.html", folder, name, folder,
			       name);
	if (can)
		CHECK(system(line) == 0);
	g_free(line);
	g_free(tool);
	return can;
}

/* A rung of 30 contacts is folded: other rungs keep their size, and every contact is there,
 * once. */
static void check_wide_rung(void)
{
	static const char narrow[] = "  | NO %IX0.0 | COIL %QX0.0 |\n";
	GString *rows = g_string_new(narrow);
	int missing = 0;

	g_string_append(rows, "RUNG \"Long\"\n  ");
	for (int i = 0; i < 30; i++)
		g_string_append_printf(rows, "| NO %%MX%d.0 ", i + 100);
	g_string_append_printf(rows, "| COIL %%QX9.0 |\n  | NO %%IX7.7 ^ |\nRUNG\n%s",
			       narrow);
	write_rung("long.rung", rows->str);
	write_rung("short.rung", narrow);
	CHECK(render("OUT/long.rung -o OUT/long.pdf") == 0);
	CHECK(render("OUT/short.rung -o OUT/short.pdf") == 0);
	if (list_boxes("long") && list_boxes("short")) {
		CHECK_AS(smallest_type("long.html") >= 5.0, "no type is smaller than 5 pt");
		CHECK(type_of("short.html", "%IX0.0") > 5);
		CHECK(type_of("long.html", "%IX0.0") == type_of("short.html", "%IX0.0"));
		for (int i = 0; i < 30; i++) {
			char *word = g_strdup_printf("%%MX%d.0", i + 100);
			char *all = content("long.html", NULL);
			char **parts = g_strsplit(all, word, -1);

			missing += g_strv_length(parts) != 2;
			g_strfreev(parts);
			g_free(all);
			g_free(word);
		}
		CHECK_AS(missing == 0, "each contact is there once");
		CHECK(has("long.html", ">%QX9.0<") && has("long.html", ">Long<"));
		CHECK(has("long.html", ">2/6<") && has("long.html", ">6/6<") &&
		      !has("long.html", ">7/6<"));
	}
	g_string_free(rows, TRUE);
}

static int count_of(const char *name, const char *word)
{
	char *all = content(name, NULL);
	char **parts = g_strsplit(all, word, -1);
	const int count = (int)g_strv_length(parts) - 1;

	g_strfreev(parts);
	g_free(all);
	return count;
}

/* A box of any width before a coil: a rung that is too wide is folded between them, and neither is cut. */
static void check_wide_box(void)
{
	int wrong = 0;

	for (int terms = 4; terms < 26; terms++) {
		GString *rows = g_string_new("  | [ %MW100");

		for (int i = 1; i < terms; i++)
			g_string_append_printf(rows, " + %%MW%d", i + 100);
		g_string_append(rows, " > 5 ] | COIL %QX9.0 |\n");
		write_rung("box.rung", rows->str);
		g_string_free(rows, TRUE);
		CHECK(render("OUT/box.rung -o OUT/box.pdf") == 0);
		if (!list_boxes("box"))
			return;
		wrong += count_of("box.html", ">%QX9.0<") != 1;
		if (count_of("box.html", ">%QX9.0<") != 1)
			printf("# %d terms: the coil is there %d times\n", terms, count_of("box.html", ">%QX9.0<"));
	}
	CHECK_AS(wrong == 0, "the coil is there once");
}

/* The page of a word, from 1; 0: none. */
static int page_of(const char *name, const char *word)
{
	char *all = content(name, NULL), *end = g_strdup_printf(">%s</word>", word);
	char **page = g_strsplit(all, "<page ", -1);
	int at = 1;

	while (page[at] && !strstr(page[at], end))
		at++;
	if (!page[at])
		at = 0;
	g_strfreev(page);
	g_free(end);
	g_free(all);
	return at;
}

/* A rung that is too high and too wide for a page has its title above its first row,
 * anywhere on a page. */
static void check_tall_and_wide(void)
{
	for (int before = 1; before < 9; before++) {
		GString *rows = g_string_new(NULL);

		for (int i = 0; i < before; i++)
			g_string_append(rows, "  | NO %IX0.0 | COIL %QX0.0 |\nRUNG\n");
		g_string_truncate(rows, rows->len - 1);
		g_string_append(rows, " \"Tall\"\n");
		for (int row = 0; row < 20; row++) {
			g_string_append_printf(rows, "  | NO %%MX20%d.0 ", row);
			for (int i = 0; i < 15; i++)
				g_string_append(rows, "| NO %IX0.1 ");
			g_string_append_printf(rows, "| COIL %%QX%d.1 |\n", row + 1);
		}
		write_rung("tall.rung", rows->str);
		CHECK(render("OUT/tall.rung -o OUT/tall.pdf") == 0);
		if (list_boxes("tall"))
			CHECK(page_of("tall.html", "Tall") > 0 &&
			      page_of("tall.html", "Tall") == page_of("tall.html",
								      "%MX200.0"));
		g_string_free(rows, TRUE);
	}
}

/* Places that do not fit below a coil are listed behind the rungs, once. */
static void check_references(void)
{
	GString *rows = g_string_new("  | NO %IX0.0 | S %QX0.0 |\n");

	for (int i = 0; i < 40; i++)
		g_string_append_printf(rows, "RUNG\n  | NO %%QX0.0 | COIL %%QX1.%d |\n",
				       i % 8);
	g_string_append(rows, "RUNG\n  | NO %IX0.1 | R %QX0.0 |\n");
	write_rung("reads.rung", rows->str);
	CHECK(render("OUT/reads.rung -o OUT/reads.pdf") == 0);
	if (list_boxes("reads")) {
		char *all = content("reads.html", NULL);
		char **parts = g_strsplit(all, ">41</word>", -1);

		CHECK(has("reads.html", ">reference</word>"));
		/* The 41st place, and the number of that rung. */
		CHECK(g_strv_length(parts) == 3);
		g_strfreev(parts);
		g_free(all);
	}
	CHECK(render(SHAPES " -o OUT/few.pdf") == 0);
	CHECK(!list_boxes("few") || !has("few.html", ">reference</word>"));
	g_string_free(rows, TRUE);
}

/* A rung of 256 rows takes several pages, and all rows are there. */
static void check_tall(void)
{
	GString *text = g_string_new("RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n");
	struct lettering *rule = lettering_new(NULL, NULL);
	struct paper paper = { .date = NULL };

	for (int row = 0; row < 256; row++)
		g_string_append_printf(text, "  | NO %%MX%d.%d %s|%s\n", row / 8, row % 8,
				       row ? "^" : "", row ? "" : " COIL %QX0.0 |");
	g_string_append(text, "END_PROGRAM\n");
	struct ladder *ladder = drawn_load("tall.rung", text->str);
	CHECK(ladder && paper_find("A4", &paper) && !paper_find("a44", &paper));
	if (ladder) {
		struct pages *pages = pages_new(ladder_project(ladder), "tall.rung", -1, 0,
						SHOW_BOTH, &paper, rule);

		CHECK(pages_count(pages) > 8 && pages_count(pages) < 30);
		pages_free(pages);
		ladder_free(ladder);
	}
	lettering_free(rule);
	g_string_free(text, TRUE);
}

/* Nothing is cut in the title block: a long name gets two lines, other fields give up spare
 * width. */
static void check_title_block(void)
{
	CHECK(render("ladders/packing.rung --date Wednesday,25_November_2026,14:38:05 "
		     "-o OUT/title.pdf") == 0);
	if (list_boxes("title")) {
		CHECK(has("title.html", ">Packing</word>") &&
		      has("title.html", ">address</word>"));
		CHECK(has("title.html", ">Wednesday,25_November_2026,14:38:05</word>"));
		CHECK(has("title.html", ">unit</word>") && has("title.html", ">packing.rung<"));
		CHECK(!has("title.html", "\xe2\x80\xa6"));
	}
	write_text("unit.rung", "PROGRAM The_unit_that_fills_the_hopper_of_this_line LD\n"
		   "RUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n");
	CHECK(render("OUT/unit.rung --date 2026-03-01 -o OUT/unit.pdf") == 0);
	if (list_boxes("unit")) {
		char *all = content("unit.html", NULL);
		char **parts = g_strsplit(all, ">The_unit_that_fills_the_hopper_of_this_line<",
					  -1);

		CHECK_AS(g_strv_length(parts) == 3, "the name is in the heading and in the title block");
		g_strfreev(parts);
		g_free(all);
	}
}

#define TWICE LONG "_" LONG
#define LONG "Sorter_of_the_second_hall_with_both_lifts_and_the_gate_to_the_yard_behind_it"

/* pt of the lowest occurrence of a word on a page; 0: not found. */
static double place_of(const char *name, int page, const char *what)
{
	char *all = content(name, NULL);
	char **pages = g_strsplit(all, "<page ", -1);
	char *mark = g_strdup_printf("\">%s</word>", what), *at = pages[page];
	double place = 0;

	while ((at = strstr(at, mark)) && at++)
		place = MAX(place, g_ascii_strtod(g_strrstr_len(pages[page], at - pages[page],
								"yMin=\"") + 6, NULL));
	g_free(mark);
	g_strfreev(pages);
	g_free(all);
	return place;
}

/* pt of the left end of a word. */
static double left_of(const char *name, const char *what)
{
	char *all = content(name, NULL), *mark = g_strdup_printf("\">%s</word>", what);
	const char *at = strstr(all, mark);
	const double left = at ? g_ascii_strtod(g_strrstr_len(all, at - all, "xMin=\"") + 6,
						NULL) : -1;

	g_free(mark);
	g_free(all);
	return left;
}

/* Writes a project with this name, a program with this name, and rungs. */
static void write_named(const char *file, const char *project, const char *program, int rungs)
{
	GString *text = g_string_new(NULL);

	g_string_append_printf(text, "PROJECT \"%s\"\nPROGRAM %s LD\n", project, program);
	for (int i = 0; i < rungs; i++)
		g_string_append(text, "RUNG \"Again\"\n  | NO %IX0.0 | COIL %QX0.0 |\n");
	g_string_append(text, "END_PROGRAM\n");
	write_text(file, text->str);
	g_string_free(text, TRUE);
}

/* Author, company, version, revision and date of the project stand in the title block. */
static void check_properties(void)
{
	write_text("about.rung", "PROJECT \"Door\"\nAUTHOR \"Miller\"\nCOMPANY \"Gates\"\n"
		   "VERSION \"1.3\"\nREVISION \"B7\"\nDATE \"2026-11-20\"\n\nPROGRAM Main LD\n"
		   "RUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n");
	CHECK(render("OUT/about.rung --date 2026-11-26 -o OUT/about.pdf") == 0);
	if (list_boxes("about")) {
		CHECK(has("about.html", ">Author</word>") && has("about.html", ">Miller,</word>") &&
		      has("about.html", ">Gates</word>"));
		CHECK(has("about.html", ">1.3,</word>") && has("about.html", ">B7,</word>") &&
		      has("about.html", ">2026-11-20</word>"));
		CHECK(has("about.html", ">2026-11-26</word>") && has("about.html", ">Door</word>"));
	}
}

/* The title block is as high as the longest names need, and no rung overlaps it. */
static void check_high_title_block(void)
{
	write_named(TWICE ".rung", TWICE ", \xe6\x94\xb9\xe8\xa3\x85\xe5\x90\x8e", TWICE, 40);
	CHECK(render("OUT/" TWICE ".rung --paper a5 --date 2026-11-26 -o OUT/high.pdf") == 0);
	if (list_boxes("high")) {
		const double block = place_of("high.html", 2, "Project");

		CHECK(!has("high.html", "\xe2\x80\xa6"));
		CHECK_AS(block > 0 && block < 595 - 34 - 27 - 40,
			 "the title block is as high as the longest names need");
		CHECK(place_of("high.html", 2, "%QX0.0") > 100);
		CHECK_AS(place_of("high.html", 2, "%QX0.0") < block - 30, "no rung overlaps the title block");
	}
}

/* A project name that fits in no title block is printed on a page of its own, even if only
 * the digits of the last page take the room. */
static void check_cut_name(void)
{
	int told = 0;

	for (int words = 255; words < 275; words++) {
		GString *name = g_string_new(NULL);

		for (int i = 0; i < words; i++)
			g_string_append_printf(name, "a%03d ", i);
		g_string_append(name, "Zend");
		write_named("cut.rung", name->str, "Main", 26);
		CHECK(render("OUT/cut.rung --paper a5 --landscape -o OUT/cut.pdf") == 0);
		told += list_boxes("cut") && page_of("cut.html", "Zend") == 0;
		g_string_free(name, TRUE);
	}
	CHECK_AS(told == 0, "the end of the name is printed");
}

/* A tab in a name is drawn as a blank, without overlaps. */
static void check_tabs(void)
{
	write_named("tabs.rung", "Left\t\t\t\t\t\t\t\t\t\tRight", "Main", 1);
	CHECK(render("OUT/tabs.rung -o OUT/tabs.pdf") == 0);
	if (list_boxes("tabs")) {
		CHECK(has("tabs.html", ">Left</word>") && has("tabs.html", ">Right</word>"));
		CHECK(left_of("tabs.html", "Left") < left_of("tabs.html", "Right"));
	}
}

/* An empty line of a list has a line on paper. */
static void check_empty_lines(void)
{
	write_text("empty.rung", "\nVAR\n  A : INT;\nEND_VAR\n\nPROGRAM Main ST\n  A := 1;\n\n\n  A := 2;\nEND_PROGRAM\n"
		   "\nPROGRAM Other IL\n  LD 1\n\n  ST A\nEND_PROGRAM\n");
	CHECK(render("OUT/empty.rung -o OUT/empty.pdf") == 0);
	if (list_boxes("empty"))
		CHECK(count_of("empty.html", ">PROGRAM</word>") == 4 && has("empty.html", ">2;</word>"));
}

/* Every sample can be printed. */
static void check_samples(const char *at)
{
	GDir *dir = g_dir_open(at, 0, NULL);

	for (const char *name; dir && (name = g_dir_read_name(dir));) {
		char *path = g_build_filename(at, name, NULL), *call = g_strdup_printf("%s -o OUT/sample.pdf", path);

		if (g_file_test(path, G_FILE_TEST_IS_DIR))
			check_samples(path);
		else if (g_str_has_suffix(name, ".rung"))
			CHECK_AS(render(call) == 0, path);
		g_free(call);
		g_free(path);
	}
	if (dir)
		g_dir_close(dir);
}

/* Texts that do not fit in their place are listed behind the rungs; a heading has two
 * lines. */
static void check_told_below(void)
{
#define UNIT "The_unit_that_fills_the_hopper_of_this_line_and_that_of_the_next_one_" \
	     "and_empties_both_of_them_in_the_evening"
	write_text("below.rung", "PROGRAM Main LD\nRUNG\n  | NO %IX0.0 (* closed while the "
		   "drive of the northern pump has no fault and its key is turned to auto *) "
		   "| NC %IX0.1 (* short *) | COIL %QX0.0 |\nEND_PROGRAM\n");
	CHECK(render("OUT/below.rung -o OUT/below.pdf") == 0);
	if (list_boxes("below")) {
		CHECK(has("below.html", ">Comments</word>"));
		CHECK(has("below.html", ">turned</word>") && has("below.html", ">auto</word>"));
		CHECK(has("below.html", ">short</word>"));
	}
	write_text("head.rung", "PROGRAM " UNIT " LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
		   "END_PROGRAM\n");
	CHECK(render("OUT/head.rung -o OUT/head.pdf") == 0);
	if (list_boxes("head"))
		CHECK_AS(!has("head.html", "\xe2\x80\xa6"), "a heading is not cut");
#undef UNIT
}

int main(void)
{
	/* A guard: a loop without end would take all memory of the machine. */
	setrlimit(RLIMIT_CPU, &(struct rlimit){ 300, 300 });
	folder = g_dir_make_tmp("pages-XXXXXX", NULL);
	if (!CHECK(folder))
		return tap_done();
	check_pdf();
	check_wide_chart();
	check_wide_rung();
	check_wide_box();
	check_tall_and_wide();
	check_references();
	check_tall();
	check_title_block();
	check_properties();
	check_high_title_block();
	check_cut_name();
	check_tabs();
	check_empty_lines();
	check_samples("ladders");
	check_told_below();
	clear_folder();
	g_free(folder);
	g_free(said);
	return tap_done();
}
