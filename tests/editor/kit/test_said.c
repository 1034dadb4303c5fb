/* SPDX-License-Identifier: MIT
 *
 * test_said - messages of the engine in German: the text, sentences round names of the
 * user, and those names as they are. Every golden message is read: one whose argument is a
 * sentence that nobody translated is found there.
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
	struct diag diag = { .id = id };
	char *got;
	bool same;

	g_strlcpy(diag.arg, arg, sizeof(diag.arg));
	got = diag_said_arg(&diag);
	same = strcmp(got, wanted) == 0;
	if (!same)
		printf("# %s: %s, not %s\n", arg, got, wanted);
	g_free(got);
	return same;
}

static enum diag_id id_of(const char *code)
{
	enum diag_id id = 0;

	while (id < DIAG_COUNT && strncmp(diag_code(id), code, strlen("LD000")) != 0)
		id++;
	return id;
}

/* Two words, one of them of small letters: nobody's name. */
static bool is_sentence(const char *arg)
{
	static const char words[] = "(^|[ ,]+)[a-z]{2,}($|[ ,]+)";

	return strchr(arg, ' ') && arg[0] != '\'' && arg[0] != '"' &&
	       g_regex_match_simple(words, arg, 0, 0);
}

/* Those that a line of a golden file holds and that stay English; what it was. */
static int english(const char *line, int *seen)
{
	const char *code = g_strrstr(line, " LD");
	struct diag diag = { 0 };
	const char *arg;
	char *got;
	int left = 0;

	if (!code || (diag.id = id_of(code + 1)) == DIAG_COUNT)
		return 0;
	arg = strstr(code, diag_text(diag.id));
	arg = arg ? arg + strlen(diag_text(diag.id)) : "";
	/* Of imported files it is what stands there. */
	if (!g_str_has_prefix(arg, ": ") || !is_sentence(arg + 2) ||
	    g_str_has_prefix(code + 1, "LD7"))
		return 0;
	++*seen;
	g_strlcpy(diag.arg, arg + 2, sizeof(diag.arg));
	got = diag_said_arg(&diag);
	if (strcmp(got, diag.arg) == 0) {
		printf("# %s stays English: %s\n", diag_code(diag.id), got);
		left = 1;
	}
	g_free(got);
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
	char *wanted = g_strdup_printf("a.rung:4: %s%s LD301: %s: Missing", rung,
		gettext("error"), diag_said(&printed[4]));

	CHECK(strcmp(diag_said(&printed[4]), diag_text(DIAG_UNKNOWN_NAME)) != 0);
	CHECK_TEXT(line, wanted);
	g_free(line);
	g_free(rung);
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
	CHECK(says(DIAG_WRONG_TYPE, "ADD does not take BOOL", "ADD nimmt kein BOOL"));
	CHECK(says(DIAG_WRONG_TYPE, "LEFT.L does not take REAL", "LEFT.L nimmt kein REAL"));
	CHECK(says(DIAG_NEEDS_CONVERSION, "INT and REAL: Level", "INT und REAL: Level"));
	CHECK(says(DIAG_NEEDS_CONVERSION, "INT and REAL", "INT und REAL"));
	CHECK(says(DIAG_DUPLICATE_NAME, "OPEN, first in line 4", "OPEN, zuerst in Zeile 4"));
	CHECK(says(DIAG_AREA_SIZE, "I: 0 to 8192 bytes", "I: 0 bis 8192 Byte"));
	CHECK(says(DIAG_EXPECTED, ", or ]", ", oder ]"));
	CHECK(says(DIAG_NOT_BOOL, "the result", "das Ergebnis"));
	/* Names of the user are no texts of ours. */
	CHECK(says(DIAG_UNKNOWN_NAME, "index", "index"));
	CHECK(says(DIAG_UNKNOWN_NAME, "result", "result"));
	CHECK(says(DIAG_UNKNOWN_NAME, "Undo", "Undo"));
	/* Another message is another sentence; no name is empty. */
	CHECK(says(DIAG_UNKNOWN_NAME, "A does not take B", "A does not take B"));
	CHECK(says(DIAG_WRONG_TYPE, " does not take B", " does not take B"));
	CHECK(says(DIAG_WRONG_TYPE, "A does not take ", "A does not take "));
	check_lines_german();
	CHECK(english_golden(&seen) == 0);
	CHECK(seen > 60);
	return tap_done();
}
