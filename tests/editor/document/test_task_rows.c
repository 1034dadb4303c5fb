/* SPDX-License-Identifier: MIT
 *
 * test_task_rows - tasks as rows, edits of each field, moves; random edits of random configurations
 * change their own lines and nothing else.
 */
#include "editor-gtk/document/task_rows.h"
#include "tests/editor/opened.h"
#include "tests/tap.h"

#include <stdlib.h>

static const char plant[] =
	"RUNGBOARD 1\n\n"
	"(* about the plant *)\n"
	"CONFIGURATION Plant (* head *)\n"
	"VAR_GLOBAL\n  Door AT %IX0.0 : BOOL; (* a switch *)\n  Fan  : BOOL;\nEND_VAR\n"
	"  AREA V 10240; (* as before *)\n"
	"  RESOURCE Cpu ON LINUX (* the board *)\n"
	"    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1, WATCHDOG := T#20ms); (* a\n    b *) // c\n"
	"    TASK Slow (INTERVAL := T#20ms, PRIORITY := 2); // slow\n"
	"    PROGRAM A WITH Fast : Quick; (* x *)\n"
	"    PROGRAM B WITH Fast : Lazy;\n"
	"  END_RESOURCE\n"
	"  PROGRAM C : Other; (* last *)\n"
	"END_CONFIGURATION\n\n"
	"(* above Quick *)\nPROGRAM Quick LD\nRUNG\n  | NO Door | COIL Fan |\nEND_PROGRAM\n\n"
	"PROGRAM Lazy LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n\n"
	"PROGRAM Other LD\nRUNG\n  | NO %IX0.2 | COIL %QX0.2 |\nEND_PROGRAM\n\n"
	"PROGRAM Spare LD\nRUNG\n  | NO %IX0.3 | COIL %QX0.3 |\nEND_PROGRAM\n";

static const char plain[] =
	"RUNGBOARD 1\n\nVAR\n  Door AT %IX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO Door | COIL %QX0.0 |\nEND_PROGRAM\n\n"
	"PROGRAM Other LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";

static LadderDocument *checked(const char *text)
{
	LadderDocument *document = opened(text);

	ladder_document_check_now(document);
	return document;
}

static char *text_of(LadderDocument *document)
{
	return ladder_document_text(document, NULL);
}

static int row_of(LadderDocument *document, const char *name)
{
	struct task_rows *tasks = task_rows_new(document);
	int row = -1;

	for (int i = 0; i < tasks->count && row < 0; i++)
		if (strcmp(tasks->row[i].text[TASKS_NAME], name) == 0)
			row = i;
	task_rows_free(tasks);
	return row;
}

/* "Fast: A B | Each scan: C". Caller frees. */
static char *order_of(LadderDocument *document)
{
	struct task_rows *tasks = task_rows_new(document);
	GString *out = g_string_new(NULL);

	for (int i = 0; i < tasks->count; i++)
		g_string_append_printf(out, tasks->row[i].what == TASKS_INSTANCE ? " %s" : "%s:",
				       tasks->row[i].text[TASKS_NAME]);
	task_rows_free(tasks);
	return g_string_free(out, FALSE);
}

static void check_order(LadderDocument *document, const char *want)
{
	char *order = order_of(document);

	CHECK_TEXT(order, want);
	g_free(order);
}

/* Is the text the one before with @old, which stands there once, in place of @now? */
static void check_changed(LadderDocument *document, const char *before, const char *old,
			  const char *now)
{
	const char *at = strstr(before, old);
	char *text = text_of(document), *want;

	if (CHECK(at)) {
		want = g_strdup_printf("%.*s%s%s", (int)(at - before), before, now,
				       at + strlen(old));
		CHECK_TEXT(text, want);
		g_free(want);
	}
	g_free(text);
}

static void set(LadderDocument *document, const char *name, enum task_field field,
		const char *text, const char *old, const char *now)
{
	char *before = text_of(document), *why = NULL;
	const bool good = task_rows_set(document, row_of(document, name), field, text, &why);
	char *after;

	if (!CHECK_AS(good, text))
		printf("# %s\n", why);
	check_changed(document, before, old, now);
	CHECK(ladder_document_undo(document));
	after = text_of(document);
	CHECK_AS(strcmp(after, before) == 0, "one undo restores the text");
	CHECK(!ladder_document_undo_name(document));
	g_free(after);
	g_free(why);
	g_free(before);
}

static void refuse(LadderDocument *document, const char *name, enum task_field field,
		   const char *text)
{
	char *before = text_of(document), *why = NULL, *after;
	char *what = g_strdup_printf("“%s” is refused", text);

	CHECK_AS(!task_rows_set(document, row_of(document, name), field, text, &why) && why && *why,
		 what);
	after = text_of(document);
	CHECK_AS(strcmp(after, before) == 0 && !ladder_document_undo_name(document),
		 "a refused value changes nothing");
	g_free(what);
	g_free(after);
	g_free(before);
	g_free(why);
}

static void test_fields(void)
{
	LadderDocument *document = checked(plant);
	char *text = text_of(document);

	CHECK_TEXT(text, plant);
	check_order(document, "Fast: A BSlow:Each scan: CDo not run: Spare");
	set(document, "Fast", TASKS_WHEN, "10ms", "INTERVAL := T#5ms", "INTERVAL := T#10ms");
	set(document, "Fast", TASKS_WHEN, "2.5 s", "INTERVAL := T#5ms", "INTERVAL := T#2.5s");
	set(document, "Fast", TASKS_WHEN, " T#1s500ms ", "INTERVAL := T#5ms",
	    "INTERVAL := T#1s500ms");
	set(document, "Fast", TASKS_WHEN, "Door", "INTERVAL := T#5ms", "SINGLE := Door");
	set(document, "Slow", TASKS_WHEN, "%IX0.7", "INTERVAL := T#20ms", "SINGLE := %IX0.7");
	set(document, "Slow", TASKS_KIND, task_rows_kind_name(true), "INTERVAL := T#20ms",
	    "SINGLE := Door");
	set(document, "Fast", TASKS_PRIORITY, "7", "PRIORITY := 1", "PRIORITY := 7");
	set(document, "Fast", TASKS_PRIORITY, "", "PRIORITY := 1", "PRIORITY := 0");
	set(document, "Fast", TASKS_WATCHDOG, "", ", WATCHDOG := T#20ms", "");
	set(document, "Slow", TASKS_WATCHDOG, "50ms", "PRIORITY := 2)",
	    "PRIORITY := 2, WATCHDOG := T#50ms)");
	set(document, "Slow", TASKS_COMMENT, "all the rest", "// slow", "(* all the rest *)");
	set(document, "B", TASKS_NAME, "Second", "PROGRAM B WITH", "PROGRAM Second WITH");
	set(document, "B", TASKS_PROGRAM, "Spare", ": Lazy;", ": Spare;");
	set(document, "Slow", TASKS_NAME, "Idle", "TASK Slow", "TASK Idle");
	refuse(document, "Fast", TASKS_WHEN, "10");
	refuse(document, "Fast", TASKS_WHEN, "1us");
	refuse(document, "Fast", TASKS_WHEN, "25h");
	refuse(document, "Fast", TASKS_WHEN, "Nobody");
	refuse(document, "Fast", TASKS_WHEN, "");
	refuse(document, "Fast", TASKS_WHEN, "T#1ms, PRIORITY := 3");
	refuse(document, "Slow", TASKS_WHEN, "T#1ms); TASK More (INTERVAL := T#1s");
	refuse(document, "Fast", TASKS_PRIORITY, "high");
	refuse(document, "Fast", TASKS_PRIORITY, "65536");
	refuse(document, "Fast", TASKS_PRIORITY, "-1");
	refuse(document, "Fast", TASKS_WATCHDOG, "Door");
	refuse(document, "Fast", TASKS_NAME, "A");
	refuse(document, "Fast", TASKS_NAME, "1st");
	refuse(document, "Fast", TASKS_NAME, "");
	refuse(document, "Fast", TASKS_KIND, "Weekly");
	refuse(document, "Fast", TASKS_COMMENT, "a *) b");
	refuse(document, "A", TASKS_PROGRAM, "Lazy");
	refuse(document, "A", TASKS_PROGRAM, "Nobody");
	refuse(document, "A", TASKS_PRIORITY, "1");
	refuse(document, "Spare", TASKS_NAME, "Other2");
	g_free(text);
	g_object_unref(document);
}

static void check_refused_name(LadderDocument *document, const char *name, const char *want)
{
	char *why = task_rows_name_refusal(document, row_of(document, "Quickly"), name);

	CHECK_AS(g_strcmp0(why, want) == 0, name);
	g_free(why);
}

/* A task's name stands in the lines of its programs, too. */
static void test_rename(void)
{
	LadderDocument *document = checked(plant);
	char *text;

	CHECK(task_rows_set(document, row_of(document, "Fast"), TASKS_NAME, "Quickly", NULL));
	check_order(document, "Quickly: A BSlow:Each scan: CDo not run: Spare");
	text = text_of(document);
	CHECK(!strstr(text, "Fast") && strstr(text, "PROGRAM A WITH Quickly : Quick; (* x *)\n"));
	CHECK_AS(strstr(text, "(* a\n    b *) // c\n"),
		 "a renamed task keeps its comments");
	g_free(text);
	check_refused_name(document, "2nd", "“2nd” is not a name");
	check_refused_name(document, "SLOW", "“SLOW” is declared already");
	check_refused_name(document, "", "Enter a name");
	check_refused_name(document, "quickly", NULL);
	g_object_unref(document);
}

/* A program names its task and its POU in other spellings: o with U+0308, and ö. */
static void test_spellings(void)
{
	LadderDocument *document = checked("RUNGBOARD 1\n\nCONFIGURATION Plant\n"
		"  RESOURCE Cpu ON LINUX\n    TASK Öl (INTERVAL := T#5ms, PRIORITY := 1);\n"
		"    PROGRAM A WITH O\u0308l : älter;\n    PROGRAM B WITH öl : Other;\n"
		"  END_RESOURCE\nEND_CONFIGURATION\n\n"
		"PROGRAM Älter LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n\n"
		"PROGRAM Other LD\nRUNG\n  | NO %IX0.2 | COIL %QX0.2 |\nEND_PROGRAM\n");
	char *text;

	check_order(document, "Öl: A BEach scan:");
	CHECK(task_rows_set(document, row_of(document, "Öl"), TASKS_NAME, "Fett", NULL));
	check_order(document, "Fett: A BEach scan:");
	text = text_of(document);
	CHECK(strstr(text, "A WITH Fett") && strstr(text, "B WITH Fett"));
	g_free(text);
	g_object_unref(document);
}

static void move(LadderDocument *document, const char *name, const char *head,
		 const char *before, const char *want)
{
	char *text = text_of(document), *why = NULL, *after;

	if (!CHECK(task_rows_move(document, row_of(document, name), row_of(document, head),
			      before ? row_of(document, before) : -1, &why)))
		printf("# %s\n", why);
	check_order(document, want);
	CHECK(ladder_document_undo(document));
	after = text_of(document);
	CHECK_AS(strcmp(after, text) == 0, "one undo restores the text");
	g_free(after);
	g_free(text);
	g_free(why);
}

static void test_moves(void)
{
	LadderDocument *document = checked(plant);

	move(document, "B", "Fast", "A", "Fast: B ASlow:Each scan: CDo not run: Spare");
	move(document, "A", "Fast", NULL, "Fast: B ASlow:Each scan: CDo not run: Spare");
	move(document, "A", "Slow", NULL, "Fast: BSlow: AEach scan: CDo not run: Spare");
	move(document, "A", "Each scan", "C", "Fast: BSlow:Each scan: A CDo not run: Spare");
	move(document, "C", "Fast", "B", "Fast: A C BSlow:Each scan:Do not run: Spare");
	move(document, "C", "Do not run", NULL, "Fast: A BSlow:Each scan:Do not run: Other Spare");
	move(document, "Spare", "Slow", NULL, "Fast: A BSlow: SpareEach scan: C");
	move(document, "Slow", "Slow", "Fast", "Slow:Fast: A BEach scan: CDo not run: Spare");
	move(document, "Fast", "Fast", NULL, "Slow:Fast: A BEach scan: CDo not run: Spare");
	g_object_unref(document);
}

/* Up and down lead through all tasks and back. */
static void test_steps(void)
{
	LadderDocument *document = checked(plant);
	char *text = text_of(document), *after;
	int steps = 0;

	while (task_rows_step(document, row_of(document, "A"), 1, NULL))
		steps++;
	/* behind B, Slow, Each scan, behind C, then it does not run and has no name of its own */
	check_order(document, "Fast: BSlow:Each scan: CDo not run: Quick Spare");
	CHECK(steps == 5);
	while (steps-- > 0)
		CHECK(ladder_document_undo(document));
	after = text_of(document);
	CHECK(strcmp(after, text) == 0);
	CHECK(task_rows_step(document, row_of(document, "Slow"), -1, NULL));
	check_order(document, "Slow:Fast: A BEach scan: CDo not run: Spare");
	CHECK(!task_rows_step(document, row_of(document, "Slow"), -1, NULL));
	g_free(after);
	g_free(text);
	g_object_unref(document);
}

static void test_rows_come_and_go(void)
{
	LadderDocument *document = checked(plant);
	char *name = NULL, *text, *after;

	CHECK(task_rows_add(document, &name, NULL) && g_strcmp0(name, "Task1") == 0);
	text = text_of(document);
	CHECK(strstr(text, "// slow\n    TASK Task1 (INTERVAL := T#10ms, PRIORITY := 3);\n"));
	g_clear_pointer(&name, g_free);
	CHECK(task_rows_add_program(document, row_of(document, "Task1"), 3, &name, NULL));
	CHECK(g_strcmp0(name, "Spare") == 0);
	g_clear_pointer(&name, g_free);
	CHECK(task_rows_add_program(document, row_of(document, "Task1"), 0, &name, NULL));
	CHECK_AS(g_strcmp0(name, "A") == 0,
		 "a program that already has a task moves to the new one");
	check_order(document, "Fast: BSlow:Task1: Spare AEach scan: C");
	CHECK(task_rows_delete(document, row_of(document, "Spare"), NULL));
	CHECK(task_rows_delete(document, row_of(document, "Task1"), NULL));
	check_order(document, "Fast: BSlow:Each scan: A CDo not run: Spare");
	for (int i = 0; i < 4; i++)
		CHECK(ladder_document_undo(document));
	after = text_of(document);
	CHECK_TEXT(after, text);
	g_free(name);
	g_free(text);
	g_free(after);
	g_object_unref(document);
}

/* Each instance of one program has a row; the name of a further one is its own. */
static void test_instances(void)
{
	LadderDocument *document = checked(
		"RUNGBOARD 1\n\nCONFIGURATION Plant\n  TASK Fast (INTERVAL := T#5ms, PRIORITY := 0);\n"
		"  PROGRAM A WITH Fast : Main;\n  PROGRAM B WITH Fast : Main;\nEND_CONFIGURATION\n\n"
		"PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n");

	check_order(document, "Fast: A BEach scan:");
	CHECK(!task_rows_set(document, row_of(document, "B"), TASKS_NAME, "Main", NULL));
	CHECK(task_rows_set(document, row_of(document, "B"), TASKS_NAME, "East", NULL));
	check_order(document, "Fast: A EastEach scan:");
	CHECK(ladder_document_undo(document));
	check_order(document, "Fast: A BEach scan:");
	g_object_unref(document);
}

/* Without a CONFIGURATION the first edit writes one. */
static void test_implicit(void)
{
	LadderDocument *document = checked(plain);
	struct task_rows *tasks = task_rows_new(document);
	char *name = NULL, *text;

	CHECK(!tasks->written && tasks->count == 3);
	task_rows_free(tasks);
	check_order(document, "Each scan: Main Other");
	CHECK(task_rows_set(document, 0, TASKS_WHEN, "20ms", NULL));
	check_changed(document, plain, "PROGRAM Main LD",
		"CONFIGURATION Config\n"
		"  TASK Task1 (INTERVAL := T#20ms, PRIORITY := 0);\n"
		"  PROGRAM Main WITH Task1 : Main;\n"
		"  PROGRAM Other WITH Task1 : Other;\n"
		"END_CONFIGURATION\n\nPROGRAM Main LD");
	CHECK(ladder_document_undo(document));
	text = text_of(document);
	CHECK_AS(strcmp(text, plain) == 0, "one undo removes the new CONFIGURATION");
	g_free(text);
	CHECK(task_rows_add(document, &name, NULL));
	check_changed(document, plain, "PROGRAM Main LD",
		"CONFIGURATION Config\n"
		"  TASK Task1 (INTERVAL := T#10ms, PRIORITY := 0);\n"
		"  PROGRAM Main : Main;\n"
		"  PROGRAM Other : Other;\n"
		"END_CONFIGURATION\n\nPROGRAM Main LD");
	CHECK(task_rows_move(document, row_of(document, "Other"), row_of(document, "Each scan"),
			 row_of(document, "Main"), NULL));
	check_order(document, "Task1:Each scan: Other Main");
	CHECK(task_rows_delete(document, row_of(document, "Main"), NULL));
	CHECK_AS(!task_rows_delete(document, row_of(document, "Other"), NULL),
		 "the last PROGRAM line is not deleted");
	g_free(name);
	g_object_unref(document);
}

/* Errors and warnings of the last check are those of their lines. */
static void test_errors(void)
{
	LadderDocument *document = checked(plant);
	struct task_rows *tasks = task_rows_new(document);
	bool warning = false;
	int found = 0;

	for (int i = 0; i < tasks->count; i++) {
		char *error = task_rows_error(document, &tasks->row[i], &warning);
		const char *name = tasks->row[i].text[TASKS_NAME];

		if (!error)
			continue;
		found++;
		CHECK(warning && strstr(error, name));
		CHECK(strcmp(name, "Slow") == 0 || strcmp(name, "Spare") == 0);
		g_free(error);
	}
	CHECK(found == 2);
	task_rows_free(tasks);
	g_object_unref(document);
}

/* A CONFIGURATION in another file is shown and cannot be changed. */
static void test_included(void)
{
	static const char other[] = "RUNGBOARD 1\n\nCONFIGURATION Plant\n"
		"  TASK Fast (INTERVAL := T#5ms, PRIORITY := 1);\n"
		"  PROGRAM A WITH Fast : Main;\nEND_CONFIGURATION\n";
	static const char program[] = "RUNGBOARD 1\n\nINCLUDE \"plant.rung\"\n\n"
		"PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n";
	char *folder = g_dir_make_tmp("rungboard-tasks-XXXXXX", NULL);
	char *path = g_build_filename(folder, "plant.rung", NULL);
	char *main_path = g_build_filename(folder, "main.rung", NULL);
	LadderDocument *document = ladder_document_new();
	struct task_rows *tasks;
	char *why = NULL;

	g_file_set_contents(path, other, -1, NULL);
	g_file_set_contents(main_path, program, -1, NULL);
	CHECK(ladder_document_open(document, main_path, NULL));
	tasks = task_rows_new(document);
	CHECK(tasks->fixed);
	task_rows_free(tasks);
	check_order(document, "Fast: AEach scan:");
	CHECK(!task_rows_set(document, 0, TASKS_PRIORITY, "3", &why));
	CHECK_TEXT(why, "It is declared in another file");
	CHECK(!ladder_document_undo_name(document));
	remove(path);
	remove(main_path);
	remove(folder);
	g_free(why);
	g_free(main_path);
	g_free(path);
	g_free(folder);
	g_object_unref(document);
}

/* ---- random edits ---- */

static guint dice(guint sides)
{
	static guint32 state = 1;

	state = state * 1664525u + 1013904223u;
	return (state >> 8) % sides;
}

static const char *one_of(const char *const *word, guint count)
{
	return word[dice(count)];
}
#define ONE_OF(words) one_of(words, G_N_ELEMENTS(words))

static void add_noise(GString *text)
{
	static const char *const noise[] = {
		"VAR_GLOBAL\n  G%u : INT; (* TASK X (INTERVAL := T#1s); *)\nEND_VAR\n",
		"VAR_GLOBAL CONSTANT\n  G%u : INT := 3;\nEND_VAR\n",
	};
	static guint number;

	if (dice(3) == 0)
		g_string_append_printf(text, ONE_OF(noise), number++);
}

static const char *comment(void)
{
	static const char *const comments[] = {
		"", "", "", " (* PROGRAM P9 : Prog9; *)", " // END_RESOURCE",
		" (* a *) (* b *)", " // END_CONFIGURATION",
	};

	return ONE_OF(comments);
}

static const char *const times[] = { "T#1ms", "T#2.5ms", "TIME#20ms", "T#1s500ms", "T#1h" };

static void add_task(GString *text, guint number)
{
	g_string_append_printf(text, "TASK T%u (", number);
	if (dice(4) == 0)
		g_string_append_printf(text, "SINGLE := %s", dice(2) ? "Door" : "%IX0.1");
	else
		g_string_append_printf(text, "INTERVAL := %s", ONE_OF(times));
	g_string_append_printf(text, ", PRIORITY := %u", dice(4));
	if (dice(2))
		g_string_append_printf(text, ", WATCHDOG := %s", ONE_OF(times));
	g_string_append_printf(text, ");%s\n", comment());
}

/* Caller frees. */
static char *random_project(void)
{
	GString *text = g_string_new("RUNGBOARD 1\n");
	const guint tasks = dice(5), programs = 1 + dice(5);
	const bool resource = dice(2);
	guint order[16];

	g_string_append(text, "VAR\n  Door AT %IX0.0 : BOOL;\nEND_VAR\n");
	if (dice(8)) {
		g_string_append_printf(text, "// above\nCONFIGURATION Plant%s\n", comment());
		add_noise(text);
		if (dice(2))
			g_string_append_printf(text, "AREA V 4096;%s\n", comment());
		if (resource)
			g_string_append_printf(text, "RESOURCE Cpu ON LINUX%s\n", comment());
		for (guint i = 0; i < tasks; i++) {
			add_task(text, i);
			add_noise(text);
		}
		for (guint i = 0; i < programs; i++)
			order[i] = i;
		for (guint i = 0; i < programs; i++) {
			const guint k = dice(programs), kept = order[k];

			order[k] = order[i];
			order[i] = kept;
		}
		for (guint i = 0; i < programs && (dice(5) || !i); i++) {
			g_string_append_printf(text, "PROGRAM P%u", order[i]);
			if (tasks && dice(3))
				g_string_append_printf(text, " WITH t%u", dice(tasks));
			g_string_append_printf(text, " : Prog%u;%s\n", order[i], comment());
		}
		if (resource)
			g_string_append(text, "END_RESOURCE\n");
		g_string_append(text, "END_CONFIGURATION\n");
	}
	for (guint i = 0; i < programs; i++)
		g_string_append_printf(text, "// of %u\nPROGRAM Prog%u LD\nRUNG \"TASK\"\n"
				       "  | NO Door | COIL %%QX0.%u |\nEND_PROGRAM\n", i, i, i);
	return g_string_free(text, FALSE);
}

static bool is_line_of_task(const char *line)
{
	const char *at = line + strspn(line, " ");

	return (g_str_has_prefix(at, "TASK ") && strstr(at, " (") && strstr(at, ");")) ||
	       (g_str_has_prefix(at, "PROGRAM ") && strstr(at, " : ") && strchr(at, ';'));
}

/* The text without lines of tasks and programs in the CONFIGURATION, and these lines.
 * Caller frees. */
static char *rest_of(const char *text, GPtrArray *lines)
{
	char **line = g_strsplit(text, "\n", -1);
	GString *rest = g_string_new(NULL);

	for (int i = 0; line[i]; i++)
		if (is_line_of_task(line[i]))
			g_ptr_array_add(lines, g_strdup(g_strstrip(line[i])));
		else
			g_string_append_printf(rest, "%s\n", line[i]);
	g_strfreev(line);
	return g_string_free(rest, FALSE);
}

static int by_text(gconstpointer a, gconstpointer b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

/* How many lines of @a are not in @b. */
static guint missing(const GPtrArray *a, const GPtrArray *b)
{
	guint count = 0, k = 0;

	for (guint i = 0; i < a->len; i++) {
		while (k < b->len && strcmp(b->pdata[k], a->pdata[i]) < 0)
			k++;
		if (k < b->len && strcmp(b->pdata[k], a->pdata[i]) == 0)
			k++;
		else
			count++;
	}
	return count;
}

enum { EDIT_SET, EDIT_ADD, EDIT_DELETE, EDIT_PROGRAM, EDIT_MOVE, EDIT_STEP, EDITS };

static bool edit(LadderDocument *document, guint what, guint *changes)
{
	static const char *const texts[] = {
		"5ms", "T#7ms", "Door", "%IX0.5", "3", "0", "", "New", "Prog1", "Nobody", "a;b", "T1",
		"Event", "Cyclic", "(* x", "1.5s", "99999", "T#1ms, PRIORITY := 1",
	};
	struct task_rows *tasks = task_rows_new(document);
	const guint count = (guint)tasks->count;
	const int row = (int)dice(count), other = (int)dice(count + 1) - 1;
	const int under = task_rows_programs(tasks, row), pous =
		ladder_document_project(document)->pou_count;
	const bool heading = tasks->row[row].what != TASKS_INSTANCE;
	char *name = NULL;
	bool done = false;

	/* lines that may differ: the row's own, those of its programs, those first written */
	*changes = tasks->written ? 1 + (heading ? (guint)under : 0) : 64;
	if (heading && tasks->row[row].what == TASKS_EACH_SCAN)
		++*changes;
	switch (what) {
	case EDIT_SET:
		done = task_rows_set(document, row, (enum task_field)dice(TASKS_FIELDS),
				 ONE_OF(texts), NULL);
		break;
	case EDIT_ADD: done = task_rows_add(document, &name, NULL); break;
	case EDIT_DELETE: done = task_rows_delete(document, row, NULL); break;
	case EDIT_PROGRAM:
		done = task_rows_add_program(document, row, (int)dice((guint)pous), &name, NULL);
		break;
	case EDIT_MOVE:
		done = task_rows_move(document, row, other >= 0 ? tasks->row[other].head : 0,
				  other >= 0 && (tasks->row[other].what == TASKS_INSTANCE) ==
				  !heading ? other : -1, NULL);
		break;
	case EDIT_STEP: done = task_rows_step(document, row, dice(2) ? 1 : -1, NULL); break;
	default: break;
	}
	g_free(name);
	task_rows_free(tasks);
	return done;
}

/* Whether the texts are equal, apart from a first CONFIGURATION in @after. */
static bool is_rest_kept(const char *before, const char *after)
{
	static const char config[] = "CONFIGURATION Config\nEND_CONFIGURATION\n\n";
	const char *at = strstr(after, config);
	char *without;
	bool same;

	if (!at || strstr(before, config))
		return strcmp(before, after) == 0;
	without = g_strdup_printf("%.*s%s", (int)(at - after), after, at + strlen(config));
	same = strcmp(before, without) == 0;
	g_free(without);
	return same;
}

/* One edit; false: it broke a rule. */
static bool edit_once(LadderDocument *document)
{
	GPtrArray *old = g_ptr_array_new_with_free_func(g_free);
	GPtrArray *now = g_ptr_array_new_with_free_func(g_free);
	char *before = text_of(document), *after, *rest, *rest_now, *undone;
	const guint what = dice(EDITS);
	guint changes;
	const bool done = edit(document, what, &changes);
	bool good;

	after = text_of(document);
	rest = rest_of(before, old);
	rest_now = rest_of(after, now);
	g_ptr_array_sort(old, by_text);
	g_ptr_array_sort(now, by_text);
	good = ladder_document_project(document) &&
	       is_rest_kept(rest, rest_now) && missing(old, now) <= changes &&
	       missing(now, old) <= changes && (done || strcmp(before, after) == 0);
	if (good && strcmp(before, after) != 0) {
		good = ladder_document_undo(document);
		undone = text_of(document);
		good = good && strcmp(undone, before) == 0 && ladder_document_redo(document);
		g_free(undone);
	}
	if (!good)
		printf("# edit %u\n%s\n# became\n%s\n", what, before, after);
	g_ptr_array_unref(old);
	g_ptr_array_unref(now);
	g_free(rest);
	g_free(rest_now);
	g_free(before);
	g_free(after);
	return good;
}

static void test_random(void)
{
	enum { PROJECTS = 60, EDITS_OF_EACH = 30 };
	int good = 0, changed = 0;

	for (int i = 0; i < PROJECTS; i++) {
		char *text = random_project();
		LadderDocument *document = ladder_document_new();

		ladder_document_open_text(document, NULL, text, strlen(text), true);
		if (!ladder_document_project(document))
			printf("# cannot be read:\n%s\n", text);
		for (int k = 0; k < EDITS_OF_EACH && ladder_document_project(document); k++)
			good += edit_once(document);
		changed += ladder_document_undo_name(document) != NULL;
		g_object_unref(document);
		g_free(text);
	}
	CHECK_AS(good == PROJECTS * EDITS_OF_EACH,
		 "random edits change only their own lines");
	CHECK_AS(changed == PROJECTS, "each project was changed");
}

int main(void)
{
	test_fields();
	test_rename();
	test_spellings();
	test_moves();
	test_steps();
	test_rows_come_and_go();
	test_instances();
	test_implicit();
	test_errors();
	test_included();
	test_random();
	return tap_done();
}
