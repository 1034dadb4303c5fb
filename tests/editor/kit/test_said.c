/* SPDX-License-Identifier: MIT
 *
 * test_said - messages of the engine in German: the text and the words of ours in it are
 * translated, names of the user stay as they are.
 */
#include "editor-gtk/kit/diag_said.h"
#include "tests/tap.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <libintl.h>
#include <locale.h>
#include <string.h>

static void in_german(void)
{
	const char *build = g_getenv("BUILD");
	char *locale = g_build_filename(build ? build : "build", "locale", NULL);

	g_setenv("LC_ALL", "C.UTF-8", TRUE);
	g_setenv("LANGUAGE", "de", TRUE);
	setlocale(LC_ALL, "");
	bindtextdomain("rungboard", locale);
	bind_textdomain_codeset("rungboard", "UTF-8");
	textdomain("rungboard");
	g_free(locale);
}

static bool says(enum diag_id id, const char *arg, const char *wanted)
{
	char *got = diag_said_of(id, arg);
	bool same = strcmp(got, wanted) == 0;

	if (!same)
		printf("# %s, not %s\n", got, wanted);
	g_free(got);
	return same;
}

/* What was expected, or of what there are too many, in the lines of a golden file: each that
 * is a word of ours must be translated. */
static int english(const char *line, int *seen)
{
	static const struct { const char *before, *after; } text[] = {
		{ " LD107: expected: ", ", for " }, { " LD113: too many ", " in one project" },
		{ " LD405: too many ", " in one chart" },
	};
	int left = 0;

	for (gsize i = 0; i < G_N_ELEMENTS(text); i++) {
		const char *from = strstr(line, text[i].before);
		const char *end;
		char *what;

		if (!from)
			continue;
		from += strlen(text[i].before);
		end = strstr(from, text[i].after);
		what = end ? g_strndup(from, (gsize)(end - from)) : g_strdup(from);
		if (g_regex_match_simple("[a-z]{3}", what, 0, 0)) {
			++*seen;
			if (strcmp(gettext(what), what) == 0) {
				printf("# stays English: %s\n", what);
				left++;
			}
		}
		g_free(what);
	}
	return left;
}

static int english_in(const char *path, int *seen)
{
	char *text = NULL;
	char **lines;
	int left = 0;

	if (!g_file_get_contents(path, &text, NULL, NULL))
		return 0;
	lines = g_strsplit(text, "\n", -1);
	for (char **line = lines; *line; line++)
		left += english(*line, seen);
	g_strfreev(lines);
	g_free(text);
	return left;
}

static int english_golden(int *seen)
{
	GDir *dir = g_dir_open("tests/golden", 0, NULL);
	const char *name;
	int left = 0;

	while (dir && (name = g_dir_read_name(dir))) {
		char *path = g_build_filename("tests/golden", name, "expected.diag", NULL);

		left += english_in(path, seen);
		g_free(path);
	}
	if (dir)
		g_dir_close(dir);
	return left;
}

/* What is printed: of no place, of files and lines, of rungs. */
static const struct diag printed[] = {
	{ .id = DIAG_NO_MEMORY },
	{ .id = DIAG_CANNOT_READ, .file = "a.rung", .arg = "No such file" },
	{ .id = DIAG_EXPECTED, .file = "a.rung", .line = 4, .arg = "name" },
	{ .id = DIAG_EXPECTED, .file = "a.rung", .line = 4, .column = 7, .arg = "name" },
	{ .id = DIAG_UNKNOWN_NAME, .file = "a.rung", .line = 4, .pou = "Main", .rung = 2,
	  .row = 1, .col = 3, .arg = "Missing" },
	{ .id = DIAG_EMPTY_RUNG, .pou = "Main", .rung = 2 },
	{ .id = DIAG_NOT_SYNCED, .file = "a.rung" },
};

/* In English editors and scripts read it as what `ladder check` prints. */
static void check_lines_english(void)
{
	for (gsize i = 0; i < G_N_ELEMENTS(printed); i++) {
		char plain[512], *line = diag_said_line(&printed[i]);

		diag_print(&printed[i], plain, sizeof(plain));
		CHECK_TEXT(line, plain);
		g_free(line);
	}
}

static void check_lines_german(void)
{
	char *line = diag_said_line(&printed[4]);
	char *rung = g_strdup_printf(gettext("rung %d (%d,%d): "), 2, 1, 3);
	char *whole = diag_said_whole(&printed[4]);
	char *wanted = g_strdup_printf("a.rung:4: %s%s LD301: %s", rung, gettext("error"),
				       whole);

	CHECK(strstr(whole, "nicht deklariert") != NULL);
	CHECK_TEXT(line, wanted);
	g_free(line);
	g_free(rung);
	g_free(whole);
	g_free(wanted);
}

int main(void)
{
	int seen = 0;

	check_lines_english();
	in_german();
	if (strcmp(gettext("Undo"), "Undo") == 0) {
		printf("1..0 # SKIP the languages are not built: they need msgfmt\n");
		return 0;
	}
	CHECK(says(DIAG_TYPE_NOT_TAKEN, "ADD" DIAG_AND "BOOL", "„ADD“ nimmt BOOL nicht an"));
	CHECK(says(DIAG_NEEDS_CONVERSION, "Level" DIAG_AND "INT" DIAG_AND "REAL",
		   "„Level“: INT und REAL sind verschiedene Typen und brauchen eine Umwandlung"));
	CHECK(says(DIAG_NEEDS_CONVERSION, DIAG_AND "INT" DIAG_AND "REAL",
		   "INT und REAL sind verschiedene Typen und brauchen eine Umwandlung"));
	CHECK(says(DIAG_DUPLICATE_NAME, "OPEN" DIAG_AND "4",
		   "„OPEN“ ist zweimal deklariert, zuerst in Zeile 4"));
	CHECK(says(DIAG_AREA_SIZE, "I" DIAG_AND "0" DIAG_AND "8192",
		   "„I“ muss 0 bis 8192 Bytes haben"));
	CHECK(says(DIAG_EXPECTED, ", or ]", "erwartet: , oder ]"));
	CHECK(says(DIAG_TOO_MANY, "tasks", "zu viele Tasks in einem Projekt"));
	/* Names of the user are no texts of ours. */
	CHECK(says(DIAG_UNKNOWN_NAME, "index", "„index“ ist nicht deklariert"));
	CHECK(says(DIAG_UNKNOWN_NAME, "Undo", "„Undo“ ist nicht deklariert"));
	CHECK(says(DIAG_UNKNOWN_NAME, "Haet" DIAG_AND "Heat",
		   "„Haet“ ist nicht deklariert; gemeint: Heat?"));
	check_lines_german();
	CHECK(english_golden(&seen) == 0);
	CHECK(seen > 20);
	return tap_done();
}
