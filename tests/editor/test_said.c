/* SPDX-License-Identifier: MIT
 *
 * test_said - messages of the engine in German: the text, sentences round names of the
 * user, and those names as they are. Every golden message is read: one whose argument is a
 * sentence that nobody translated is found there.
 */
#include "editor-gtk/diag_said.h"
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

int main(void)
{
	int seen = 0;

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
	CHECK(english_golden(&seen) == 0);
	CHECK(seen > 60);
	return tap_done();
}
