/* SPDX-License-Identifier: MIT
 *
 * test_said - diagnostics in other languages: their text and our words in it are
 * translated, names of the user are not.
 */
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/verbs.h"
#include "engine/ladder.h"
#include "tests/tap.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <libintl.h>
#include <locale.h>
#include <string.h>

static void in_language(const char *language)
{
	const char *build = g_getenv("BUILD");
	char *locale = g_build_filename(build ? build : "build", "locale", NULL);

	g_setenv("LC_ALL", "C.UTF-8", TRUE);
	g_setenv("LANGUAGE", language, TRUE);
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

/* Each diagnostic of the golden cases once: its id and its argument. */
struct golden {
	GHashTable *seen;
	struct ladder *ladder;
	const char *language;
	int wrong;
};

/* Two words, one of them in small letters: no name. */
static bool is_sentence(const char *part)
{
	return part[0] != '\'' && part[0] != '"' && strchr(part, ' ') &&
	       g_regex_match_simple("(^|[ ,]+)[a-z]{2,}($|[ ,]+)", part, 0, 0);
}

/* Is the part an expected token, or a thing of which there are too many? Texts of the
 * system are translated already; lines of the user are not ours. */
static bool is_of_ours(enum diag_id id, const char *part, int n)
{
	if (n == 0 && (id == DIAG_EXPECTED || id == DIAG_TOO_MANY || id == DIAG_SFC_TOO_MANY))
		return g_regex_match_simple("[a-z]{3}| or ", part, 0, 0);
	if (id >= DIAG_WRITE_INSTEAD && id <= DIAG_MISSING_ABOVE)
		return id == DIAG_WRITE_INSTEAD && n == 1 && is_sentence(part);
	/* COMPUTED and FBD_HINT show a line of the user, which may have a comment. */
	return id != DIAG_BAD_INCLUDE && id != DIAG_COMPUTED && id != DIAG_FBD_HINT && is_sentence(part);
}

static void wrong(struct golden *golden, const struct diag *diag, const char *what,
		  const char *text)
{
	golden->wrong++;
	printf("# %s: %s %s: %s\n", golden->language, diag_code(diag->id), what, text);
}

static void try_parts(struct golden *golden, const struct diag *diag, const char *got)
{
	char **part = g_strsplit(diag->arg, DIAG_AND, -1);

	for (int n = 0; part[n]; n++) {
		/* A word may be the same in both languages. */
		const bool translated = said(part[n]) != part[n];

		if (is_of_ours(diag->id, part[n], n) && !translated)
			wrong(golden, diag, "has an English part", part[n]);
		else if (!translated && !strstr(got, part[n]))
			wrong(golden, diag, "lost a name of the program", got);
	}
	g_strfreev(part);
}

static void try_diag(struct golden *golden, const struct diag *diag)
{
	char english[1024];
	char *got = diag_said_whole(diag);

	diag_fill(diag_text(diag->id), diag->arg, english, sizeof(english));
	if (strcmp(got, english) == 0)
		wrong(golden, diag, "has an English part", got);
	if (strpbrk(got, "%{}" DIAG_AND) && !strpbrk(english, "%{}"))
		wrong(golden, diag, "has a place without its text", got);
	try_parts(golden, diag, got);
	g_free(got);
}

static void try_file(struct golden *golden, const char *path)
{
	const struct diag_list *diags;

	if (ladder_load(golden->ladder, path))
		ladder_build(golden->ladder);
	diags = ladder_diags(golden->ladder);
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (g_hash_table_add(golden->seen, g_strdup_printf("%d %s", diag->id, diag->arg)))
			try_diag(golden, diag);
	}
}

/* The number of diagnostics that were tried. */
static guint try_golden(struct golden *golden)
{
	GDir *dir = g_dir_open("tests/golden", 0, NULL);
	const char *name;
	guint count;

	golden->wrong = 0;
	golden->seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	while (dir && (name = g_dir_read_name(dir))) {
		char *case_path = g_build_filename("tests/golden", name, "expected.diag", NULL);
		char *path = g_build_filename("tests/golden", name, "main.rung", NULL);

		/* The program of some cases is made by a script. */
		if (g_file_test(case_path, G_FILE_TEST_EXISTS) && g_file_test(path, G_FILE_TEST_EXISTS))
			try_file(golden, path);
		g_free(case_path);
		g_free(path);
	}
	if (dir)
		g_dir_close(dir);
	count = g_hash_table_size(golden->seen);
	g_hash_table_destroy(golden->seen);
	return count;
}

/* For each language of the build. */
static void check_golden(void)
{
	const char *build = g_getenv("BUILD");
	char *locale = g_build_filename(build ? build : "build", "locale", NULL);
	struct golden golden = { .ladder = ladder_new() };
	GDir *dir = g_dir_open(locale, 0, NULL);
	int languages = 0;

	while (golden.ladder && dir && (golden.language = g_dir_read_name(dir))) {
		in_language(golden.language);
		CHECK(try_golden(&golden) > 600);
		CHECK_AS(golden.wrong == 0, golden.language);
		languages++;
	}
	CHECK(languages >= 3);
	if (dir)
		g_dir_close(dir);
	ladder_free(golden.ladder);
	g_free(locale);
}

/* Without a place, in files and lines, in rungs. */
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

/* In English the lines are those that `ladder check` prints, for editors and scripts. */
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

/* In French a no-break space stands before a colon. */
static void check_hint_french(void)
{
	GString *line = g_string_new(NULL);

	verb_tell(line, VERB_rename);
	CHECK(strstr(line->str, "F2\xc2\xa0: ") == line->str);
	g_string_free(line, TRUE);
}

int main(void)
{
	check_lines_english();
	in_language("de");
	if (strcmp(gettext("Undo"), "Undo") == 0) {
		printf("1..0 # SKIP the languages are not built: they need msgfmt\n");
		return 0;
	}
	CHECK(says(DIAG_TYPE_NOT_TAKEN, "ADD" DIAG_AND "BOOL", "„ADD“ nimmt BOOL nicht an"));
	CHECK(says(DIAG_NEEDS_CONVERSION, "Level" DIAG_AND "INT" DIAG_AND "REAL",
		   "„Level“: INT und REAL sind verschiedene Typen; mit INT_TO_REAL umwandeln"));
	CHECK(says(DIAG_NEEDS_CONVERSION, DIAG_AND "INT" DIAG_AND "REAL",
		   "INT und REAL sind verschiedene Typen; mit INT_TO_REAL umwandeln"));
	CHECK(says(DIAG_DUPLICATE_NAME, "OPEN" DIAG_AND "4",
		   "„OPEN“ ist zweimal deklariert, zuerst in Zeile 4"));
	CHECK(says(DIAG_AREA_SIZE, "I" DIAG_AND "0" DIAG_AND "8192",
		   "„I“ muss 0 bis 8192 Bytes haben"));
	CHECK(says(DIAG_EXPECTED, ", or ]", "erwartet: , oder ]"));
	CHECK(says(DIAG_TOO_MANY, "tasks", "zu viele Tasks"));
	/* Names of the user are not translated. */
	CHECK(says(DIAG_UNKNOWN_NAME, "index", "„index“ ist nicht deklariert"));
	CHECK(says(DIAG_UNKNOWN_NAME, "Undo", "„Undo“ ist nicht deklariert"));
	CHECK(says(DIAG_UNKNOWN_NAME, "Haet" DIAG_AND "Heat",
		   "„Haet“ ist nicht deklariert; gemeint: Heat?"));
	check_lines_german();
	check_golden();
	in_language("fr");
	check_hint_french();
	return tap_done();
}
