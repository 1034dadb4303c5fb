/* SPDX-License-Identifier: MIT
 *
 * test_comparison - the rows of a comparison, without a display.
 */
#include "editor-gtk/document/comparison.h"
#include "editor-gtk/document/git_log.h"
#include "editor-gtk/document/revision.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <gio/gio.h>
#include <glib/gstdio.h>
#include <string.h>

#define HEAD "RUNGBOARD 1\n\n"
#define RUNG(text) "RUNG\n  | " text " |\n"
#define MAIN(rungs) "PROGRAM Main LD\n" rungs "END_PROGRAM\n"

static struct compare_side side(const char *name, const char *text)
{
	return (struct compare_side){ g_strdup(name), NULL, g_strdup(text), strlen(text), NULL,
				      NULL };
}

static struct comparison *compare(const char *older, const char *newer)
{
	struct compare_side a = side("old", older), b = side("new", newer);

	return comparison_new(&a, &b);
}

/* "group|title|change|words" of all rows, a line each. */
static char *rows_of(const struct comparison *of)
{
	GString *text = g_string_new(NULL);

	for (guint i = 0; i < of->rows->len; i++) {
		const struct compare_row *row = of->rows->pdata[i];
		char **lines = g_strsplit(row->words, "\n", -1);
		char *words = g_strjoinv(" ; ", lines);

		g_string_append_printf(text, "%s|%s|%s|%s\n", row->group, row->title,
				       compare_change_text(row->change), words);
		g_free(words);
		g_strfreev(lines);
	}
	return g_string_free(text, FALSE);
}

static void check_rows(const char *older, const char *newer, const char *want)
{
	struct comparison *of = compare(older, newer);
	char *got = rows_of(of);

	CHECK(of->read_a && of->read_b && !of->failed);
	CHECK_TEXT(got, want);
	g_free(got);
	comparison_free(of);
}

static void check_rungs(void)
{
	check_rows(HEAD MAIN(RUNG("NO %IX0.0 | COIL %QX0.0") RUNG("NO %IX0.1 | COIL %QX0.1")),
		   HEAD MAIN(RUNG("NC %IX0.0 | COILNOT %QX0.0") RUNG("NO %IX0.1 | COIL %QX0.1")
			     RUNG("NO %IX0.2 | COIL %QX0.2")),
		   "PROGRAM Main|Rung 1|changed|row 1, column A: NO %IX0.0 → NC %IX0.0 ; "
		   "row 1, column F: COIL %QX0.0 → COILNOT %QX0.0\n"
		   "PROGRAM Main|Rung 3|added|\n");
	check_rows(HEAD MAIN("RUNG \"One\"\n  | NO %IX0.0 | COIL %QX0.0 |\n"
			     RUNG("NO %IX0.1 | COIL %QX0.1") RUNG("NO %IX0.2 | COIL %QX0.2")),
		   HEAD MAIN(RUNG("NO %IX0.1 | COIL %QX0.1") RUNG("NO %IX0.2 | COIL %QX0.2")
			     "RUNG \"One\"\n  | NO %IX0.0 | COIL %QX0.0 |\n"),
		   "PROGRAM Main|Rung 3 (One)|moved|moved from 1 to 3\n");
}

static void check_names(void)
{
	check_rows(HEAD "VAR\n  A AT %IX0.0 : BOOL;\n  B : INT;\nEND_VAR\n" MAIN(RUNG("NO A | COIL %QX0.0")),
		   HEAD "VAR\n  A AT %IX0.1 : BOOL; (* key *)\n  C : INT;\nEND_VAR\n"
		   MAIN(RUNG("NO A | COIL %QX0.0")),
		   "Symbols|A|changed|address: %IX0.0 → %IX0.1 ; comment: nothing → (* key *)\n"
		   "Symbols|B|removed|\nSymbols|C|added|\n");
	check_rows(HEAD MAIN(RUNG("NO %IX0.0 | COIL %QX0.0")),
		   HEAD MAIN(RUNG("NO %IX0.0 | COIL %QX0.0"))
		   "PROGRAM Other LD\n" RUNG("NO %IX0.0 | COIL %QX0.1") "END_PROGRAM\n",
		   "PROGRAM Other|the whole POU|added|\n");
}

static void check_lists(void)
{
	check_rows(HEAD "PROGRAM Main IL\n  LD %IX0.0\n  AND %IX0.1\n  OR %IX0.2\n  ST %QX0.0\nEND_PROGRAM\n",
		   HEAD "PROGRAM Main IL\n  LD %IX0.0\n  ANDN %IX0.1\n  ORN %IX0.2\n  ST %QX0.0\n  ST %QX0.1\nEND_PROGRAM\n",
		   "PROGRAM Main|Line 2|changed|− AND %IX0.1 ; + ANDN %IX0.1 ; − OR %IX0.2 ; + ORN %IX0.2\n"
		   "PROGRAM Main|Line 5|added|+ ST %QX0.1\n");
}

#define CHART(action, condition, more) HEAD "PROGRAM Tank SFC\n  INITIAL_STEP S0:\n" \
	"    %QX0.0(" action ");\n  END_STEP\n  STEP S1:\n  END_STEP\n" \
	"  TRANSITION FROM S0 TO S1 := " condition "; END_TRANSITION\n" \
	"  TRANSITION FROM S1 TO S0 := %IX0.1; END_TRANSITION\n" more "END_PROGRAM\n"

static void check_charts(void)
{
	struct comparison *of = compare(CHART("N", "%IX0.0", ""), CHART("S", "%IX0.7", ""));
	char *got = rows_of(of);
	const struct compare_row *row;
	int place[4];

	CHECK(strstr(got, "PROGRAM Tank|Step S0|changed|− N %QX0.0 ; + S %QX0.0\n"));
	CHECK(strstr(got, "PROGRAM Tank|Transition") && strstr(got, "%IX0.7"));
	CHECK(of->rows->len == 2);
	row = of->rows->pdata[0];
	CHECK(compare_row_place(row, ladder_project(of->of_b), place) && place[0] == 0 &&
	      place[1] == -1 && place[2] == 1);
	g_free(got);
	comparison_free(of);
	of = compare(CHART("N", "%IX0.0", ""), CHART("N", "%IX0.0", "  STEP S2:\n  END_STEP\n"
		"  TRANSITION FROM S2 TO S1 := %IX0.2; END_TRANSITION\n"));
	got = rows_of(of);
	CHECK(strstr(got, "Step S2|added|") && of->rows->len == 2);
	g_free(got);
	comparison_free(of);
}

/* Where a row leads in the newer version. */
/* In which version a network stands elsewhere, is new, is gone, or has other lines. */
#define NETS(nets) HEAD "VAR\n  A AT %IX0.0 : BOOL;\n  Q AT %QX0.0 : BOOL;\n  P AT %QX0.1 : BOOL;\n  R AT %QX0.2 : BOOL;\n" \
	"END_VAR\n\nPROGRAM Nets FBD\n" nets "END_PROGRAM\n"
#define ONE   "NETWORK One \"First\"\n  W := NOT A\n  Q := W\n"
#define TWO   "NETWORK \"Second\"\n  P := A\n"
#define THREE "NETWORK\n  R := A AND Q\n"

static void check_networks(void)
{
	struct comparison *of;
	const struct compare_row *row;
	int place[4];

	check_rows(NETS(ONE TWO THREE), NETS(ONE "NETWORK \"Second\"\n  P := A OR Q\n" THREE),
		   "PROGRAM Nets|Network 2 (Second)|changed|− P := A ; + P := A OR Q\n");
	check_rows(NETS(ONE TWO THREE), NETS(ONE THREE), "PROGRAM Nets|Network 2 (Second)|removed|− Second ; − P := A\n");
	check_rows(NETS(ONE THREE), NETS(TWO ONE THREE), "PROGRAM Nets|Network 1 (Second)|added|+ Second ; + P := A\n");
	check_rows(NETS(ONE TWO THREE), NETS(TWO THREE ONE), "PROGRAM Nets|Network 3 (One)|moved|moved from 1 to 3\n");
	check_rows(NETS(ONE TWO), NETS("NETWORK One \"Other\"\n  W := A\n  Q := W\n" TWO THREE),
		   "PROGRAM Nets|Network 1 (One)|changed|− First ; − W := NOT A ; + Other ; + W := A\n"
		   "PROGRAM Nets|Network 3|added|+ R := A AND Q\n");
	of = compare(NETS(ONE TWO), NETS(ONE "NETWORK OFF \"Second\"\n  P := A\n"));
	row = of->rows->len == 1 ? of->rows->pdata[0] : NULL;
	CHECK(row && strcmp(row->words, "+ OFF") == 0 && row->shows == COMPARE_SHOWS_NETWORK &&
	      row->at_a == 1 && row->at_b == 1);
	CHECK_AS(row && compare_row_place(row, ladder_project(of->of_b), place) && place[0] == 0 && place[1] == 1,
		 "a network has its place");
	comparison_free(of);
}

static void check_places(void)
{
	struct comparison *of = compare(
		HEAD "VAR\n  A : BOOL;\nEND_VAR\n" MAIN(RUNG("NO A | COIL %QX0.0") RUNG("NO A | COIL %QX0.1"))
		"PROGRAM List IL\nVAR\n  X : INT;\nEND_VAR\n  LD A\n  ST %QX0.2\nEND_PROGRAM\n",
		HEAD "VAR\n  B : BOOL;\n  A : INT;\nEND_VAR\n" MAIN(RUNG("NC A | COIL %QX0.0"))
		"PROGRAM List IL\nVAR\n  X : INT;\nEND_VAR\n  LD A\n  ST %QX0.3\nEND_PROGRAM\n");
	static const struct { const char *title; int good, place[4]; } want[] = {
		{ "A", 1, { -1, -1, 0, 1 } }, { "B", 1, { -1, -1, 0, 0 } },
		{ "Rung 1", 1, { 0, 0, -1, -1 } }, { "Rung 2", 0, { 0, 0, 0, 0 } },
		{ "Line 2", 1, { 1, -1, 5, -1 } },
	};

	for (guint i = 0; i < of->rows->len; i++) {
		const struct compare_row *row = of->rows->pdata[i];
		int place[4];
		const bool good = compare_row_place(row, ladder_project(of->of_b), place);

		for (gsize k = 0; k < G_N_ELEMENTS(want); k++)
			if (strcmp(want[k].title, row->title) == 0)
				CHECK(good == want[k].good && (!good ||
				      memcmp(place, want[k].place, sizeof(place)) == 0));
	}
	CHECK(of->rows->len == G_N_ELEMENTS(want));
	comparison_free(of);
}

/* A version that cannot be read gives its diagnostics. */
static void check_unreadable(void)
{
	struct comparison *of = compare("RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | what I |\nEND_PROGRAM\n",
					HEAD MAIN(RUNG("NO %IX0.0 | COIL %QX0.0")));
	char *why = comparison_diags(of->of_a);

	CHECK(!of->read_a && of->read_b && of->rows->len == 0);
	CHECK(strstr(why, "error LD"));
	g_free(why);
	comparison_free(of);
}

/* ---- git ---- */

struct answer { GPtrArray *revisions; char *text, *why; gsize len; bool come; };

static void take_log(gpointer data, GPtrArray *revisions, const char *why)
{
	struct answer *answer = data;

	answer->revisions = revisions;
	answer->why = g_strdup(why);
	answer->come = true;
}

static void take_text(gpointer data, char *text, gsize len, const char *why)
{
	struct answer *answer = data;

	answer->text = text;
	answer->len = len;
	answer->why = g_strdup(why);
	answer->come = true;
}

static void wait_for(const struct answer *answer)
{
	while (!answer->come)
		g_main_context_iteration(NULL, TRUE);
}

static void clear(struct answer *answer)
{
	g_clear_pointer(&answer->revisions, g_ptr_array_unref);
	g_free(answer->text);
	g_free(answer->why);
	*answer = (struct answer){ 0 };
}

static bool git(const char *folder, const char *const *words)
{
	GPtrArray *all = g_ptr_array_new();
	int status;
	bool good;

	for (const char *const *word = (const char *const[]){ "git", "-C", folder, "-c",
	     "user.name=A", "-c", "user.email=a@b.c", NULL }; *word; word++)
		g_ptr_array_add(all, (gpointer)*word);
	for (; *words; words++)
		g_ptr_array_add(all, (gpointer)*words);
	g_ptr_array_add(all, NULL);
	good = g_spawn_sync(NULL, (char **)all->pdata, NULL, G_SPAWN_SEARCH_PATH |
		G_SPAWN_STDOUT_TO_DEV_NULL | G_SPAWN_STDERR_TO_DEV_NULL, NULL, NULL, NULL, NULL,
		&status, NULL) && status == 0;
	g_ptr_array_unref(all);
	return good;
}

/* A name that looks like an option or a pattern is only a name. */
static void check_git(void)
{
	char *folder = g_dir_make_tmp("git-XXXXXX", NULL);
	char *path = g_build_filename(folder, "--a*.rung", NULL);
	char *other = g_build_filename(folder, "other.rung", NULL);
	struct answer answer = { 0 };

	g_file_set_contents(path, "one", -1, NULL);
	git_log_read(path, NULL, take_log, &answer);
	wait_for(&answer);
	CHECK(!answer.revisions && strstr(answer.why, "is not in a git repository"));
	clear(&answer);
	if (!git(folder, (const char *const[]){ "init", "-q", NULL })) {
		tap_skip("git is not installed");
	} else {
		git(folder, (const char *const[]){ "add", ".", NULL });
		git(folder, (const char *const[]){ "commit", "-q", "-m", "First\x1f\xc3\xa4", NULL });
		g_file_set_contents(path, "two", -1, NULL);
		g_file_set_contents(other, "", -1, NULL);
		git(folder, (const char *const[]){ "commit", "-q", "-a", "-m", "Second", NULL });
		git_log_read(path, NULL, take_log, &answer);
		wait_for(&answer);
		CHECK(answer.revisions && answer.revisions->len == 2);
		struct git_revision *first = answer.revisions->pdata[1];
		char *hash = g_strdup(first->hash);
		CHECK(g_str_has_prefix(first->subject, "First") && strlen(hash) >= 40);
		CHECK(g_str_has_prefix(hash, first->brief));
		clear(&answer);
		git_log_show(path, hash, "--a*.rung", NULL, take_text, &answer);
		wait_for(&answer);
		CHECK(answer.text && answer.len == 3 && strcmp(answer.text, "one") == 0);
		clear(&answer);
		git_log_show(other, hash, "other.rung", NULL, take_text, &answer);
		wait_for(&answer);
		CHECK(!answer.text && strstr(answer.why, "“other.rung” is not in revision "));
		clear(&answer);
		git_log_read(other, NULL, take_log, &answer);
		wait_for(&answer);
		CHECK(!answer.revisions && strstr(answer.why, "No revision in git has"));
		clear(&answer);
		g_free(hash);
	}
	g_spawn_sync(NULL, (char *[]){ "rm", "-r", folder, NULL }, NULL, G_SPAWN_SEARCH_PATH,
		     NULL, NULL, NULL, NULL, NULL, NULL);
	g_free(other);
	g_free(path);
	g_free(folder);
}

/* ---- I/O maps ---- */

static void check_maps(void)
{
	const char *program = HEAD MAIN(RUNG("NO %IX0.0 | COIL %QX0.0"));
	struct compare_side a = side("old", program), b = side("new", program);
	struct comparison *of;
	char *rows;

	a.map = g_strdup("BOARD \"A\"\n%IX0.0 gpio line=GPIO17 pull=up\n%IX0.1 gpio line=GPIO18 # door\n"
			 "%QX0.0 gpio line=GPIO4 safe=0\n");
	b.map = g_strdup("BOARD \"B\"\n%QX0.0 gpio line=GPIO5 safe=1\n%ix0.0 gpio line=GPIO17 pull=up\n"
			 "%IX0.2 gpio line=GPIO18\n");
	of = comparison_new(&a, &b);
	rows = rows_of(of);
	CHECK_TEXT(rows, "I/O map|BOARD|changed|Board: A → B\n"
		   "I/O map|%QX0.0|changed|I/O line: GPIO4 → GPIO5 ; Safe: 0 → 1\n"
		   "I/O map|%IX0.2|added|gpio line=GPIO18\n"
		   "I/O map|%IX0.1|removed|gpio line=GPIO18\n");
	g_free(rows);
	comparison_free(of);
	a = side("old", program);
	b = side("new", program);
	b.map = g_strdup("\xff not a map\n%IX0.0\n");
	of = comparison_new(&a, &b);
	rows = rows_of(of);
	CHECK(strstr(rows, "I/O map|%IX0.0|added|"));
	g_free(rows);
	comparison_free(of);
}

/* ---- a project in a revision ---- */

#define LIB(block) "RUNGBOARD 1\n\nFUNCTION_BLOCK " block " LD\nRUNG\n  | NO %IX0.7 | COIL %QX0.7 |\n" \
		   "END_FUNCTION_BLOCK\n"
#define PUMP "RUNGBOARD 1\n\nINCLUDE \"lib.rung\"\n\nPROGRAM Main LD\nVAR\n  A : Seal;\nEND_VAR\n" \
	     "RUNG\n  | NO %IX0.0 | Seal A | COIL %QX0.0 |\nEND_PROGRAM\n"

struct read { struct compare_side side; char *why; bool come; };

static void take_side(gpointer data, struct compare_side *of, const char *why)
{
	struct read *read = data;

	if (of)
		read->side = *of;
	if (of)
		*of = (struct compare_side){ 0 };
	read->why = g_strdup(why);
	read->come = true;
}

static struct read read_revision(const char *path, const struct git_revision *revision)
{
	struct read read = { .come = false };

	revision_read(path, revision->hash, revision->name, "then", NULL, take_side, &read);
	while (!read.come)
		g_main_context_iteration(NULL, TRUE);
	return read;
}

static void put(const char *folder, const char *name, const char *text)
{
	char *path = g_build_filename(folder, name, NULL), *in = g_path_get_dirname(path);

	g_mkdir_with_parents(in, 0700);
	if (text)
		g_file_set_contents(path, text, -1, NULL);
	else
		g_unlink(path);
	g_free(in);
	g_free(path);
}

static void commit(const char *folder, const char *subject)
{
	git(folder, (const char *const[]){ "add", "-A", NULL });
	git(folder, (const char *const[]){ "commit", "-q", "-m", subject, NULL });
}

/* The revision with a subject. */
static const struct git_revision *find(const struct answer *log, const char *subject)
{
	for (guint i = 0; log->revisions && i < log->revisions->len; i++) {
		const struct git_revision *revision = log->revisions->pdata[i];

		if (strcmp(revision->subject, subject) == 0)
			return revision;
	}
	g_error("no revision %s", subject);
}

/* The file was renamed since, and the files that it names differ from those on the disk. */
static void make_history(const char *folder)
{
	put(folder, "old/tank.rung", PUMP);
	put(folder, "old/lib.rung", LIB("Seal"));
	put(folder, "old/tank.io", "%IX0.0 gpio line=GPIO17\n");
	commit(folder, "First");
	put(folder, "old/lib.rung", NULL);
	put(folder, "old/tank.rung", PUMP "\n");
	commit(folder, "Without lib");
	put(folder, "old/lib.rung", "RUNGBOARD 1\n\nFUNCTION_BLOCK Seal LD\nRUNG\n  | what |\n");
	put(folder, "old/tank.rung", PUMP "\n\n");
	commit(folder, "Damaged lib");
	git(folder, (const char *const[]){ "mv", "old/tank.rung", "pump.rung", NULL });
	git(folder, (const char *const[]){ "mv", "old/tank.io", "pump.io", NULL });
	put(folder, "lib.rung", LIB("Other"));
	commit(folder, "Rename");
	put(folder, "pump.rung", NULL);
	commit(folder, "Delete");
	put(folder, "pump.rung", "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
	    "END_PROGRAM\n");
	put(folder, "pump.io", "%IX0.0 gpio line=GPIO27\n");
	commit(folder, "Last");
}

static void check_first(const char *path, const struct git_revision *first)
{
	struct read read = read_revision(path, first);
	struct compare_side now = { g_strdup("now"), g_strdup(path), NULL, 0, NULL, NULL };
	struct comparison *of;
	char *rows;

	CHECK_TEXT(first->name, "old/tank.rung");
	CHECK(read.side.text && g_hash_table_contains(read.side.files, "old/lib.rung"));
	of = comparison_new(&read.side, &now);
	CHECK_AS(of->read_a && of->read_b, "the revision is read with its own files");
	rows = rows_of(of);
	CHECK(strstr(rows, "FUNCTION_BLOCK Seal|the whole POU|removed|"));
	CHECK(strstr(rows, "I/O map|%IX0.0|changed|I/O line: GPIO17 → GPIO27"));
	g_free(rows);
	comparison_free(of);
}

/* A named file that is missing or damaged gives an error with a place. */
static void check_named(const char *path, const struct git_revision *revision, const char *place)
{
	struct read read = read_revision(path, revision);
	struct compare_side now = { g_strdup("now"), g_strdup(path), NULL, 0, NULL, NULL };
	struct comparison *of = comparison_new(&read.side, &now);
	char *why = comparison_diags(of->of_a);

	CHECK(!of->read_a && of->read_b && of->rows->len == 0);
	CHECK_AS(strstr(why, place), place);
	if (!strstr(why, place))
		printf("# %s\n", why);
	g_free(why);
	comparison_free(of);
}

/* The map was renamed twice, and moved with the project. A foreign map has its first name now. */
static void check_map_renamed(void)
{
	char *folder = g_dir_make_tmp("git-XXXXXX", NULL);
	char *path = g_build_filename(folder, "site", "pump.rung", NULL);
	static const char *const want[][2] = { { "First", "GPIO1\n" }, { "Second", "GPIO2\n" },
					       { "Third", "GPIO3\n" } };
	struct answer log = { 0 };

	git(folder, (const char *const[]){ "init", "-q", NULL });
	put(folder, "pump.rung", PUMP);
	put(folder, "pump-board.io", "# the board of the pump\n%IX0.0 gpio line=GPIO1\n");
	commit(folder, "First");
	git(folder, (const char *const[]){ "mv", "pump-board.io", "pump-wiring.io", NULL });
	put(folder, "pump-wiring.io", "# the board of the pump\n%IX0.0 gpio line=GPIO2\n");
	put(folder, "pump.rung", PUMP "\n");
	commit(folder, "Second");
	put(folder, "site/x", "");
	git(folder, (const char *const[]){ "mv", "pump-wiring.io", "site/pump-terminals.io", NULL });
	git(folder, (const char *const[]){ "mv", "pump.rung", "site/pump.rung", NULL });
	put(folder, "site/pump-terminals.io", "# the board of the pump\n%IX0.0 gpio line=GPIO3\n");
	put(folder, "pump-board.io", "%QX0.0 gpio line=GPIO9\n");
	commit(folder, "Third");
	git_log_read(path, NULL, take_log, &log);
	wait_for(&log);
	for (gsize i = 0; i < G_N_ELEMENTS(want); i++) {
		struct read read = read_revision(path, find(&log, want[i][0]));

		CHECK_AS(read.side.map && g_str_has_suffix(read.side.map, want[i][1]), want[i][0]);
		compare_side_clear(&read.side);
	}
	clear(&log);
	g_spawn_sync(NULL, (char *[]){ "rm", "-r", folder, NULL }, NULL, G_SPAWN_SEARCH_PATH,
		     NULL, NULL, NULL, NULL, NULL, NULL);
	g_free(path);
	g_free(folder);
}

static void check_revision(void)
{
	char *folder = g_dir_make_tmp("git-XXXXXX", NULL);
	char *path = g_build_filename(folder, "pump.rung", NULL);
	struct answer log = { 0 };
	struct read gone;

	if (!git(folder, (const char *const[]){ "init", "-q", NULL })) {
		tap_skip("git is not installed");
	} else {
		make_history(folder);
		git_log_read(path, NULL, take_log, &log);
		wait_for(&log);
		check_first(path, find(&log, "First"));
		check_named(path, find(&log, "Without lib"), "old/tank.rung:3");
		check_named(path, find(&log, "Damaged lib"), "old/lib.rung:5");
		CHECK_TEXT(find(&log, "Rename")->name, "pump.rung");
		gone = read_revision(path, find(&log, "Delete"));
		CHECK(!gone.side.text && strstr(gone.why, "“pump.rung” is not in revision "));
		g_free(gone.why);
		clear(&log);
		check_map_renamed();
	}
	g_spawn_sync(NULL, (char *[]){ "rm", "-r", folder, NULL }, NULL, G_SPAWN_SEARCH_PATH,
		     NULL, NULL, NULL, NULL, NULL, NULL);
	g_free(path);
	g_free(folder);
}

static void never(gpointer data, struct compare_side *side, const char *why)
{
	(void)data;
	(void)side;
	(void)why;
	CHECK_AS(false, "nothing comes after it was cancelled");
}

/* What is cancelled is forgotten: it keeps nothing. */
static void check_cancelled(void)
{
	GCancellable *cancel = g_cancellable_new();

	revision_read("/tmp/x.rung", "HEAD", "x.rung", "then", cancel, never, NULL);
	g_cancellable_cancel(cancel);
	CHECK_SOON(G_OBJECT(cancel)->ref_count == 1);
	g_object_unref(cancel);
}

int main(void)
{
	check_rungs();
	check_names();
	check_lists();
	check_charts();
	check_networks();
	check_places();
	check_unreadable();
	check_maps();
	check_git();
	check_revision();
	check_cancelled();
	return tap_done();
}
