/* SPDX-License-Identifier: MIT
 *
 * test_board - running on this machine: uses of a program, checks of an I/O map, the status
 * of ladderd, and a ladderd that misbehaves.
 */
#include "editor-gtk/sim/board_run.h"
#include "editor-gtk/document/document.h"
#include "editor-gtk/document/iomap_check.h"
#include "editor-gtk/iomap/iomap_rows.h"
#include "editor-gtk/document/iomap_uses.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <stdlib.h>

/* ---- what a program uses ---- */

static const char program[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL; (* push *)\n"
	"  Row AT %QX0.6 : ARRAY[1..3] OF BOOL;\n  Wide AT %IW2 : WORD;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Own AT %IX1.0 : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO Start | NO %IX0.5 | NO Own | COIL %QX0.0 |\nEND_PROGRAM\n";

static void uses(void)
{
	LadderDocument *document = ladder_document_new();
	GString *all = g_string_new(NULL);
	struct io_uses made;
	char *text;

	ladder_document_open_text(document, NULL, program, strlen(program), true);
	CHECK(io_uses_make(&made, ladder_document_project(document)));
	for (int i = 0; i < made.count; i++) {
		char address[24];

		iec_addr_print(made.use[i].addr, address, sizeof(address));
		g_string_append_printf(all, "%s=%s ", address, made.use[i].name);
	}
	CHECK_TEXT(all->str, "%IX0.0=Start %IX0.5= %IX1.0=Main.Own %IW2=Wide %QX0.0= %QX0.6=Row[1] "
		   "%QX0.7=Row[2] %QX1.0=Row[3] ");
	CHECK_TEXT(made.use[0].comment, "(* push *)");
	io_uses_free(&made);
	text = iomap_new_text(document);
	CHECK(strstr(text, "%IX1.0  ") && strstr(text, "   # Main.Own\n") &&
	      strstr(text, "  safe=0   # Row[3]\n") && strstr(text, "%IW2  sim   # Wide\n"));
	g_free(text);
	g_string_free(all, TRUE);
	g_object_unref(document);
}

/* ---- checks ---- */

static struct io_check *check(const char *text)
{
	struct areas areas;

	areas_init(&areas);
	return io_check_new(text, strlen(text), &areas, NULL, NULL);
}

static bool says(const struct io_check *checked, int line, enum diag_id id)
{
	bool warns;
	const struct diag *diag = io_check_at(checked, line, &warns);

	return id == DIAG_COUNT ? !diag : diag && diag->id == id &&
	       warns == (id == DIAG_IO_NO_SAFE);
}

static void checks(void)
{
	static const char map[] =
		"BOARD \"x\"\n%IX0.0 sim\n%IX0.0 sim\n%QX0.0 sim safe=2\n%IX0.1 what\n"
		"%IX0.2 gpio\n%IX600.0 sim\n%QX0.1 sim safe=1\n";
	struct io_check *checked = check(map);
	char *text;

	CHECK(says(checked, 2, DIAG_COUNT) && says(checked, 3, DIAG_IO_TWICE) &&
	      says(checked, 4, DIAG_IO_VALUE) && says(checked, 5, DIAG_IO_DRIVER) &&
	      says(checked, 6, DIAG_IO_MISSING_LINE) && says(checked, 7, DIAG_IO_OUTSIDE) &&
	      says(checked, 8, DIAG_COUNT));
	CHECK_AS(io_check_point(checked, 8) && io_check_point(checked, 8)->point->safe &&
		 io_check_point(checked, 2) && !io_check_point(checked, 4),
		 "correct lines give their points despite wrong ones");
	io_check_free(checked);
	checked = check("%IX0.0 sim\n%IX0.1 sim\n");
	CHECK_AS(says(checked, 1, DIAG_IO_NO_BOARD) && io_check_point(checked, 1) &&
		 io_check_point(checked, 2),
		 "a map without a board is reported and gives its points");
	io_check_free(checked);
	checked = check("BOARD oops\n%IX0.1 sim\n");
	CHECK(says(checked, 1, DIAG_IO_NO_BOARD) && io_check_point(checked, 2));
	io_check_free(checked);
	checked = check("BOARD \"x\"\n%QX0.0 sim\n%QX0.1 sim safe=hold\n%IX0.1 sim\n%QX0.2 sim\n");
	CHECK_AS(says(checked, 2, DIAG_IO_NO_SAFE) && says(checked, 3, DIAG_COUNT) &&
		 says(checked, 4, DIAG_COUNT) && says(checked, 5, DIAG_IO_NO_SAFE),
		 "each output without safe= has its warning");
	text = iomap_first_doubt(checked);
	CHECK_TEXT(text ? text : "", "Line 2: \"%QX0.0\" has no safe=, so it is off while no "
		   "program runs, as are other outputs: 1; write safe=0, safe=1 or safe=hold");
	g_free(text);
	io_check_free(checked);
	checked = check("");
	CHECK(checked->map.count == 0 && checked->errors.errors == 1);
	io_check_free(checked);
}

/* ---- status ---- */

static void status(void)
{
	static const char *const block[] = {
		"state: FAULT", "fault: division by zero, Main rung 3 (1,2)", "errors: 0",
		"forces: 0", "scans: 1234", "period: 10000.0 us",
		"scan: last 1.0 us, mean 2.5 us, max 9.1 us, p99 3.0 us", "late: 2",
		"odd line", "io: good, 2 lines in 1 requests, 0 calls failed, 0 reopened",
	};
	struct run_status told = { .stop = "old" };
	char long_line[600];
	bool end = false;

	for (gsize i = 0; i < G_N_ELEMENTS(block); i++)
		end = end || board_status_line(&told, block[i]);
	CHECK(!end && board_status_line(&told, ""));
	CHECK_TEXT(told.state, "FAULT");
	CHECK_TEXT(told.fault, "division by zero, Main rung 3 (1,2)");
	CHECK_TEXT(told.scans, "1234");
	CHECK_TEXT(told.mean, "2.5 us");
	CHECK_TEXT(told.worst, "9.1 us");
	CHECK(!told.stop[0] && strncmp(told.io, "good, 2 lines", 13) == 0);
	memset(long_line, 'x', sizeof(long_line) - 1);
	long_line[sizeof(long_line) - 1] = '\0';
	memcpy(long_line, "state: ", 7);
	board_status_line(&told, long_line);
	CHECK_TEXT(told.state, "xxxxxxx");
}

/* ---- children ---- */

static char *folder;
static GString *log_text;
static int ended;   /* exit status; -2: still running                          */

static void told(LadderBoardRun *run, const char *line)
{
	(void)run;
	g_string_append_printf(log_text, "%s|", line);
}

static void at_end(LadderBoardRun *run, int with)
{
	(void)run;
	ended = with;
}

/* Starts a script in place of ladderd. */
static LadderBoardRun *start(const char *script)
{
	char *path = g_build_filename(folder, "ladderd", NULL);
	char *text = g_strdup_printf("#!/bin/sh\n%s\n", script);
	LadderBoardRun *run = ladder_board_run_new();

	g_file_set_contents(path, text, -1, NULL);
	g_chmod(path, 0700);
	g_string_truncate(log_text, 0);
	ended = -2;
	g_signal_connect(run, "told", G_CALLBACK(told), NULL);
	g_signal_connect(run, "ended", G_CALLBACK(at_end), NULL);
	CHECK(ladder_board_run_start(run, "/a b.rung", "/c.io", NULL));
	g_free(text);
	g_free(path);
	return run;
}

static void children(void)
{
	LadderBoardRun *run = start("echo \"$@\" >&2; printf '\\377no newline' >&2; exit 3");

	CHECK(ladder_board_run_state(run) == BOARD_STARTING);
	WAIT(ended != -2);
	CHECK_AS(ended == 3 && ladder_board_run_state(run) == BOARD_OFF,
		 "a child that refuses the program");
	CHECK(g_str_has_prefix(log_text->str, "--attended --link "));
	CHECK(strstr(log_text->str, "/slots --io /c.io -- /a b.rung|\xef\xbf\xbdno newline|"));
	g_object_unref(run);
	run = start("trap 'echo ended >&2; exit 0' TERM\nprintf 'state: RUN\\n\\n'\n"
		    "while :; do sleep 0.05; done");
	WAIT(ladder_board_run_state(run) == BOARD_RUNNING);
	CHECK_TEXT(ladder_board_run_status(run)->state, "RUN");
	ladder_board_run_stop(run);
	CHECK(ladder_board_run_state(run) == BOARD_STOPPING);
	WAIT(ended != -2);
	CHECK(ended == 0);
	CHECK_TEXT(log_text->str, "ended|");
	g_object_unref(run);
	run = start("kill -KILL $$");
	WAIT(ended != -2);
	CHECK_AS(ended == -1, "a killed child is reported as ended");
	ladder_board_run_stop(run);
	CHECK_AS(ladder_board_run_state(run) == BOARD_OFF,
		 "stopping an ended child leaves it off");
	g_object_unref(run);
}

/* When the editor drops it, its standard input ends. */
static void orphan(void)
{
	char *mark = g_build_filename(folder, "gone", NULL);
	char *script = g_strdup_printf("trap '' TERM\necho ready >&2\ncat >/dev/null\n: >%s", mark);
	LadderBoardRun *run = start(script);

	WAIT(log_text->len);
	g_object_unref(run);
	WAIT(g_file_test(mark, G_FILE_TEST_EXISTS));
	CHECK(g_file_test(mark, G_FILE_TEST_EXISTS));
	g_unlink(mark);
	g_free(script);
	g_free(mark);
}

static void nobody(void)
{
	LadderBoardRun *run = ladder_board_run_new();
	GError *error = NULL;

	g_setenv("PATH", "", TRUE);
	CHECK(!ladder_board_run_start(run, "a", "b", &error) && error);
	g_clear_error(&error);
	g_object_unref(run);
}

int main(void)
{
	char *path, *with;

	folder = g_dir_make_tmp("rungboard-board-XXXXXX", NULL);
	with = g_strdup_printf("%s:%s", folder, g_getenv("PATH"));
	g_setenv("PATH", with, TRUE);
	log_text = g_string_new(NULL);
	uses();
	checks();
	status();
	children();
	orphan();
	nobody();
	path = g_build_filename(folder, "ladderd", NULL);
	g_unlink(path);
	g_rmdir(folder);
	g_free(path);
	g_free(with);
	g_free(folder);
	g_string_free(log_text, TRUE);
	return tap_done();
}
