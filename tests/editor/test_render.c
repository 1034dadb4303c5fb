/* SPDX-License-Identifier: MIT
 *
 * test_render - `ladder-editor --render`, in this process and without a display.
 *
 * Text in a PDF is looked for with pdftotext where that is installed.
 */
#include "editor-gtk/pages.h"
#include "editor-gtk/render.h"
#include "tests/editor/drawn.h"
#include "tests/tap.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#define SHAPES "tests/editor/drawing/shapes.rung"
#define FULL_BYTES 500          /* more than a message, less than a picture     */
#define OLD "what was there"
#define HUGE_BYTES ((off_t)1 << 40)

static char *folder;
static char *said; /* what the last call said on stderr                         */

static char *in_folder(const char *name)
{
	return g_build_filename(folder, name, NULL);
}

static char *content(const char *name, size_t *len)
{
	char *path = in_folder(name), *text = NULL;

	if (!g_file_get_contents(path, &text, len, NULL))
		text = g_strdup("");
	g_free(path);
	return text;
}

/* @words, blanks between them; OUT/ is the scratch folder. */
static int render(const char *words)
{
	char *place = g_strdup_printf("%s/", folder), *log = in_folder("said");
	char **parts = g_strsplit(words, "OUT/", -1), *all = g_strjoinv(place, parts);
	char *line = g_strdup_printf("ladder-editor --render %s", all);
	char **argv = g_strsplit(line, " ", -1);
	int keep = dup(2), status;

	fflush(stderr);
	if (!freopen(log, "w", stderr))
		return -1;
	status = render_main((int)g_strv_length(argv), argv);
	fflush(stderr);
	dup2(keep, 2);
	close(keep);
	g_free(said);
	said = content("said", NULL);
	g_strfreev(argv);
	g_strfreev(parts);
	g_free(line);
	g_free(all);
	g_free(log);
	g_free(place);
	return status;
}

static bool has(const char *file, const char *text)
{
	char *all = content(file, NULL);
	bool found = strstr(all, text) != NULL;

	g_free(all);
	return found;
}

static bool same(const char *a, const char *b)
{
	size_t a_len = 0, b_len = 0;
	char *x = content(a, &a_len), *y = content(b, &b_len);
	bool equal = a_len > 0 && a_len == b_len && memcmp(x, y, a_len) == 0;

	g_free(x);
	g_free(y);
	return equal;
}

static void check_svg(void)
{
	CHECK(render(SHAPES " -o OUT/a.svg") == 0);
	CHECK_TEXT(said, "");
	CHECK(has("a.svg", ">Motor</text>"));
	CHECK(has("a.svg", ">启动</text>"));
	CHECK(has("a.svg", "SUBROUTINE Sub"));
	CHECK(has("a.svg", "Level * 3 &gt; Count"));
	CHECK(render(SHAPES " -o OUT/b.svg") == 0 && same("a.svg", "b.svg"));
	CHECK(render(SHAPES " --dark -o OUT/dark.svg") == 0 && has("dark.svg", "#1b1c1f"));
	CHECK(render(SHAPES " --rung 1 -o OUT/one.svg") == 0 && !has("one.svg", "CTU"));
	CHECK(render(SHAPES " --pou SUB -o OUT/sub.svg") == 0 && has("sub.svg", "STOP") &&
	      !has("sub.svg", "Motor"));
	CHECK(render(SHAPES " --show addresses -o OUT/c.svg --rung 1") == 0 &&
	      !has("c.svg", "启动") && has("c.svg", "%IX0.0"));
	CHECK(render("ladders/mixer.rung -o OUT/il.svg") == 0 && has("il.svg", "JMPCN"));
}

static void check_png(void)
{
	cairo_surface_t *surface;
	char *path = in_folder("a.png");

	CHECK(render(SHAPES " --scale 2 --rung 1 --width 700 -o OUT/a.png") == 0);
	surface = cairo_image_surface_create_from_png(path);
	CHECK(cairo_image_surface_get_width(surface) >= 2 * (700 + RUNG_LEFT + RUNG_AFTER));
	const unsigned char *pixel = cairo_image_surface_get_data(surface);
	CHECK(pixel && pixel[4 * (cairo_image_surface_get_width(surface) - 2)] == 0xff);
	cairo_surface_destroy(surface);
	g_free(path);
}

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

/* pt from the top to the bottom of the lowest line of type in a listing of boxes. */
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

/* A chart that is wider than a page is not made smaller than can be read: it goes on, on
 * pages beside each other, and what was cut off stands below. */
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
	CHECK(has("wide.txt", "A bolt that does not go in: give up, and free the door."));
	CHECK(has("wide.txt", "washing-machine.rung") && has("wide.txt", "5 of 5"));
	CHECK_AS(smallest_type("wide.html") >= 5.0, "no type is smaller than 5 pt");
	g_free(line);
	g_free(tool);
}

static void write_rung(const char *name, const char *rows)
{
	char *path = in_folder(name), *text = g_strdup_printf("RUNGBOARD 1\n\n"
		"PROGRAM Main LD\nRUNG\n%sEND_PROGRAM\n", rows);

	CHECK(g_file_set_contents(path, text, -1, NULL));
	g_free(text);
	g_free(path);
}

/* pt from the top to the bottom of a word in a listing of boxes; 0: it is not there. */
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

/* A rung of 30 contacts goes on below itself: the others stay as large as they are without
 * it, and every contact is there, once. */
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

/* Of places that have no room below a coil all stand behind the rungs, once. */
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

static void check_diff(void)
{
	char *path = in_folder("new.rung"), *text = NULL, **parts, *changed;

	g_file_get_contents(SHAPES, &text, NULL, NULL);
	parts = g_strsplit(text, "| NC Stop (* interlock *) |", 2);
	changed = g_strjoinv("| NO Stop (* interlock *) |", parts);
	g_file_set_contents(path, changed, -1, NULL);
	CHECK(render("--diff " SHAPES " OUT/new.rung -o OUT/diff.svg") == 0);
	CHECK(has("diff.svg", ">+</text>") && has("diff.svg", ">\xe2\x88\x92</text>"));
	CHECK(has("diff.svg", ">\xe2\x89\xa0</text>"));
	CHECK(has("diff.svg", "PROGRAM Main") && !has("diff.svg", "SUBROUTINE Sub"));
	CHECK(!has("diff.svg", "switched off"));
	CHECK(render("--diff " SHAPES " " SHAPES " -o OUT/same.svg") == 0);
	CHECK(has("same.svg", "No rung differs"));
	CHECK(render("--diff ladders/motor.rung ladders/mixer.rung -o OUT/far.svg") == 0);
	CHECK(has("far.svg", ": removed") || has("far.svg", ": added") ||
	      has("far.svg", "differs"));
	g_strfreev(parts);
	g_free(changed);
	g_free(text);
	g_free(path);
}

/* A contact more moves the output on, which is the same all the same. */
static void check_moved(void)
{
	char *text, **parts;

	write_rung("one.rung", "  | NO %IX0.0 | COIL %QX0.0 |\n  | NO %IX0.1 ^ |\n");
	write_rung("two.rung", "  | NO %IX0.0 | NC %IX0.2 | COIL %QX0.0 |\n"
		   "  | NO %IX0.1 ^ |\n");
	CHECK(render("--diff OUT/one.rung OUT/two.rung -o OUT/moved.svg") == 0);
	text = content("moved.svg", NULL);
	parts = g_strsplit(text, ">\xe2\x89\xa0</text>", -1);
	CHECK_AS(g_strv_length(parts) == 2, "the new contact alone is marked");
	g_strfreev(parts);
	g_free(text);
}

static void check_wrong(void)
{
	static const struct { const char *words, *said; int status; } wrong[] = {
		{ "", "a file is missing", 2 },
		{ SHAPES, "-o is missing", 2 },
		{ SHAPES " -o OUT/a.gif", ".svg, .pdf or .png", 2 },
		{ SHAPES " " SHAPES " -o OUT/a.svg", "one file too many", 2 },
		{ SHAPES " --rung 0 -o OUT/a.svg", "a number from 1", 2 },
		{ SHAPES " --rung 1x -o OUT/a.svg", "a number from 1", 2 },
		{ SHAPES " --rung 99 -o OUT/a.svg", "has no rung 99", 2 },
		{ SHAPES " --pou Nobody -o OUT/a.svg", "no POU called Nobody", 2 },
		{ SHAPES " --paper a9 -o OUT/a.pdf", "--paper is", 2 },
		{ SHAPES " --show all -o OUT/a.svg", "--show is", 2 },
		{ SHAPES " --scale", "--scale wants a value", 2 },
		{ SHAPES " --what -o OUT/a.svg", "no option --what", 2 },
		{ SHAPES " -o OUT/no/such/folder.svg", "unchanged: No such file", 2 },
		{ SHAPES " -o OUT/no/such/folder.pdf", "unchanged: No such file", 2 },
		{ SHAPES " -o OUT/no/such/folder.png", "unchanged: No such file", 2 },
		{ SHAPES " --scale 10 --width 9000 -o OUT/a.png", "too large", 2 },
		{ "OUT/none.rung -o OUT/a.svg", "LD0", 2 },
		{ "OUT/bad.rung -o OUT/a.svg", "LD1", 1 },
		{ "--diff " SHAPES " -o OUT/a.svg", "a file is missing", 2 },
		{ "--diff OUT/bad.rung " SHAPES " -o OUT/a.svg", "LD1", 1 },
		{ "--diff " SHAPES " " SHAPES " --rung 1 -o OUT/a.svg", "--diff", 2 },
	};
	char *bad = in_folder("bad.rung");

	g_file_set_contents(bad, "RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NOO X |\n"
			    "END_PROGRAM\n", -1, NULL);
	for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
		int status = render(*wrong[i].words ? wrong[i].words : "--dark");

		if (!CHECK_AS(status == wrong[i].status && strstr(said, wrong[i].said),
			      wrong[i].said))
			printf("# status %d: %s", status, said);
	}
	g_free(bad);
}

static int count_files(void)
{
	GDir *dir = g_dir_open(folder, 0, NULL);
	int count = 0;

	while (dir && g_dir_read_name(dir))
		count++;
	if (dir)
		g_dir_close(dir);
	return count;
}

/* As on a disk that is full: path and reason are told, what was there stays. */
static void check_full(const char *name)
{
	char *path = in_folder(name), *words = g_strdup_printf(SHAPES " -o OUT/%s", name);

	CHECK(g_file_set_contents(path, OLD, -1, NULL));
	const int files = count_files();
	struct rlimit limit;
	getrlimit(RLIMIT_FSIZE, &limit);
	setrlimit(RLIMIT_FSIZE, &(struct rlimit){ FULL_BYTES, limit.rlim_max });
	CHECK(render(words) == 2);
	setrlimit(RLIMIT_FSIZE, &limit);
	if (!CHECK(strstr(said, path) && strstr(said, "File too large")))
		printf("# %s\n", said);
	char *now = content(name, NULL);
	CHECK_TEXT(now, OLD);
	CHECK_AS(count_files() == files, "and nothing else is left");
	CHECK(render(words) == 0 && !has(name, OLD));
	g_free(now);
	g_free(words);
	g_free(path);
}

static void check_large(void)
{
	char *path = in_folder("huge.rung");

	CHECK(g_file_set_contents(path, "", 0, NULL) && truncate(path, HUGE_BYTES) == 0);
	CHECK(render("OUT/huge.rung -o OUT/a.svg") == 2);
	CHECK(g_str_has_prefix(said, path));
	/* GLib puts a blank that breaks no line before a unit. */
	if (!CHECK(strstr(said, ": error LD004: file is too large: 1.1\302\240TB, "
			  "at most 67.1\302\240MB\n")))
		printf("# %s", said);
	g_free(path);
}

/* A rung of 256 rows takes several pages, and none of it is lost. */
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

static void check_marks(void)
{
	char *path = in_folder("wrong.rung");

	g_file_set_contents(path, "RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\n"
			    "PROGRAM Main LD\nRUNG\n  | NO A | NO Missing | COIL A |\n"
			    "END_PROGRAM\n", -1, NULL);
	CHECK(render("OUT/wrong.rung -o OUT/plain.svg") == 0);
	CHECK(!has("plain.svg", "<polyline"));
	CHECK(render("--check OUT/wrong.rung -o OUT/wrong.svg") == 1);
	CHECK(strstr(said, "rung 1 (1,2)") && strstr(said, "Missing"));
	CHECK(has("wrong.svg", "<polyline") &&
	      has("wrong.svg", "<text class=\"symbol f-error\""));
	CHECK(render("--check " SHAPES " -o OUT/a.pdf") == 2);
	g_free(path);
}

/* Every option of the help is told in the document, and none that is not there. */
static void check_document(void)
{
	char *text = NULL, *place;
	int missing = 0, options = 0;

	CHECK(g_file_get_contents("docs/pictures.md", &text, NULL, NULL));
	int keep = dup(1);
	char *path = in_folder("help");
	fflush(stdout);
	if (freopen(path, "w", stdout)) {
		render("--help");
		fflush(stdout);
	}
	dup2(keep, 1);
	close(keep);
	char *help = content("help", NULL);
	for (place = help; (place = strstr(place, "--")); place += 2) {
		size_t len = strspn(place + 2, "abcdefghijklmnopqrstuvwxyz") + 2;
		char *option = g_strndup(place, len);

		options++;
		missing += !text || !strstr(text, option);
		g_free(option);
	}
	CHECK(options > 12);
	CHECK_AS(missing == 0, "docs/pictures.md tells all options");
	g_free(help);
	g_free(path);
	g_free(text);
}

/* Of a project of ClassicLadder: as it becomes, as it was, both; of no other. */
static void check_original(void)
{
#define CLASSIC "tests/classic/projects/linuxcnc.clp"
	CHECK(render(CLASSIC " --rung 3 -o OUT/after.svg") == 0);
	CHECK(has("after.svg", ">TM0<") && !has("after.svg", ">%TM0<"));
	CHECK(render(CLASSIC " --rung 3 --original -o OUT/before.svg") == 0);
	CHECK(has("before.svg", ">%TM0<") && !has("before.svg", ">TM0<"));
	CHECK(has("before.svg", ">103<") && !has("before.svg", ">Estop chain<"));
	CHECK(render(CLASSIC " --before-after -o OUT/both.svg") == 0);
	CHECK(has("both.svg", ">%TM0<") && has("both.svg", ">TM0<"));
	CHECK(has("both.svg", ">Estop chain<") && has("both.svg", ">Here: Power, rung 1<"));
	CHECK(render(SHAPES " --original -o OUT/none.svg") == 2);
	CHECK(strstr(said, "nothing of it comes from ClassicLadder"));
	CHECK(render(CLASSIC " --original -o OUT/a.pdf") == 2);
	CHECK(render(CLASSIC " --rung 99 --original -o OUT/none.svg") == 2);
#undef CLASSIC
}

static void clear_folder(void)
{
	GDir *dir = g_dir_open(folder, 0, NULL);

	for (const char *name; dir && (name = g_dir_read_name(dir));) {
		char *path = in_folder(name);

		g_unlink(path);
		g_free(path);
	}
	if (dir)
		g_dir_close(dir);
	g_rmdir(folder);
}

int main(void)
{
	folder = g_dir_make_tmp("render-XXXXXX", NULL);
	if (!CHECK(folder))
		return tap_done();
	signal(SIGXFSZ, SIG_IGN); /* as the program does: a file's limit is a full disk */
	check_svg();
	check_png();
	check_pdf();
	check_wide_chart();
	check_wide_rung();
	check_references();
	check_diff();
	check_moved();
	check_wrong();
	check_full("full.svg");
	check_full("full.png");
	check_full("full.pdf");
	check_large();
	check_tall();
	check_marks();
	check_original();
	check_document();
	clear_folder();
	g_free(folder);
	g_free(said);
	return tap_done();
}
