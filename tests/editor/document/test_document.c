/* SPDX-License-Identifier: MIT
 *
 * test_document - a document's changes, its history, its file.
 *
 * Random edits of every kind, then all undone and redone: the same bytes. No display.
 */
#include "editor-gtk/document/document.h"

#include "engine/model/st.h"
#include "tests/tap.h"

#include <glib/gstdio.h>

static const char SAMPLE[] =
	"RUNGBOARD 1\nPROJECT \"Pump\"\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL; (* green *)\n  Motor AT %QX0.0 : BOOL;\n"
	"  Count : INT;\nEND_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\nEND_VAR\n"
	"RUNG \"Seal\"\n  | NO Start  | COIL Motor |\n  | NO Motor ^|\n"
	"RUNG\n  | NO Motor | TON Delay PT:=T#3s | COIL %QX0.1 |\n"
	"RUNG There\n  | NC Start | [ Count := Count + 1 ] |\nEND_PROGRAM\n\n"
	"PROGRAM Other IL\n  LD Start\n  ST %QX0.3\nEND_PROGRAM\n";

#define LIST "PROGRAM Other IL\n  LD    I0\n  ST    Q1\nEND_PROGRAM\n"

static LadderDocument *open_sample(void)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, SAMPLE, strlen(SAMPLE), true);
	return document;
}

static bool has_text(LadderDocument *document, const char *want)
{
	char *text = ladder_document_text(document, NULL);
	bool same = strcmp(text, want) == 0;

	if (!same)
		printf("# got:\n%s# wanted:\n%s", text, want);
	g_free(text);
	return same;
}

static struct rung *rung_of(LadderDocument *document, const char *text)
{
	struct diag_list diags;

	diag_init(&diags);
	return ladder_read_rung(ladder_document_ladder(document), text, strlen(text),
				&diags);
}

/* ---- one after the other ---- */

static int told_rungs, told_project, told_state;

static void count_rungs(LadderDocument *document, int pou, int at, int removed,
			int inserted, int *count)
{
	(void)document;
	*count = pou * 1000 + at * 100 + removed * 10 + inserted;
}

static void count_one(LadderDocument *document, int *count)
{
	(void)document;
	++*count;
}

static void test_rungs(void)
{
	LadderDocument *document = open_sample();
	char *before = ladder_document_text(document, NULL), *after;

	g_signal_connect(document, "rungs-changed", G_CALLBACK(count_rungs), &told_rungs);
	g_signal_connect(document, "state-changed", G_CALLBACK(count_one), &told_state);
	CHECK(ladder_document_is_saved(document));
	ladder_document_begin(document, "Negate", NULL);
	CHECK(ladder_document_put_rung(document, 0, 2, rung_of(document,
		"RUNG There\n  | NO Start | [ Count := Count + 1 ] |\n"), NULL));
	ladder_document_end(document);
	CHECK_AS(told_rungs == 211 && told_state > 0, "rungs-changed has the place");
	CHECK(!ladder_document_is_saved(document));
	CHECK_TEXT(ladder_document_undo_name(document), "Negate");
	after = ladder_document_text(document, NULL);
	CHECK(strstr(after, "| NO Start | [ Count"));
	CHECK(ladder_document_undo(document));
	CHECK(has_text(document, before) && ladder_document_is_saved(document));
	CHECK(!ladder_document_undo(document));
	CHECK(ladder_document_redo(document));
	CHECK(has_text(document, after));
	CHECK(ladder_document_move_rung(document, 0, 0, 2));
	CHECK(told_rungs == 201);
	CHECK_TEXT(ladder_document_undo_name(document), "Move rung");
	CHECK(ladder_document_undo(document) && has_text(document, after));
	CHECK(!ladder_document_splice(document, 1, 0, 0, NULL, 0, NULL));
	CHECK(!ladder_document_splice(document, 0, 2, 2, NULL, 0, NULL));
	CHECK(!ladder_document_move_rung(document, 0, 0, 3));
	CHECK(has_text(document, after));
	g_free(before);
	g_free(after);
	g_object_unref(document);
}

static void test_unwritable(void)
{
	LadderDocument *document = open_sample();
	struct project *project = ladder_document_project(document);
	struct rung *rung = rung_copy(project->pou[0].rung[0]);
	struct diag_list why;

	diag_init(&why);
	rung_cell(rung, 0, 0)->operand = names_intern(&project->names, "a | b", 5);
	CHECK_AS(!ladder_document_put_rung(document, 0, 0, rung, &why),
		 "a rung that a file could not hold is refused");
	CHECK(why.errors > 0 && !ladder_document_undo_name(document));
	g_object_unref(document);
}

static void test_steps(void)
{
	LadderDocument *document = open_sample();
	char *before = ladder_document_text(document, NULL);

	for (int i = 0; i < 3; i++) {
		char *text = g_strdup_printf("RUNG\n  | NO I%d | COIL Q0 |\n", i);

		ladder_document_begin(document, "Type", "operand");
		ladder_document_put_rung(document, 0, 0, rung_of(document, text), NULL);
		ladder_document_end(document);
		g_free(text);
	}
	CHECK(ladder_document_undo(document));
	CHECK_AS(has_text(document, before), "typing is one step");
	ladder_document_begin(document, "Many", NULL);
	ladder_document_splice(document, 0, 0, 3, NULL, 0, NULL);
	ladder_document_begin(document, "Inner", NULL);
	CHECK(ladder_document_replace(document, 12, 15, "PROJECT \"New\"\n", NULL));
	ladder_document_end(document);
	ladder_document_cancel(document);
	CHECK_AS(has_text(document, before), "cancel restores the text");
	CHECK(ladder_document_redo_name(document));
	g_free(before);
	g_object_unref(document);
}

static struct step_cursor cursor_of(gpointer data)
{
	return (struct step_cursor){ 0, *(const int *)data, 2, 3 };
}

/* Undo can move the cursor back to where the step began. */
static void test_cursor(void)
{
	LadderDocument *document = open_sample();
	int rung = 0;

	CHECK(ladder_document_undo_cursor(document).pou == -1);
	ladder_document_set_cursor(document, cursor_of, &rung);
	for (; rung < 2; rung++) {
		ladder_document_begin(document, "Type", "operand");
		ladder_document_put_rung(document, 0, 0, rung_of(document, rung ?
			"RUNG\n  | NO I1 | COIL Q0 |\n" : "RUNG\n  | NO I2 | COIL Q0 |\n"),
			NULL);
		rung += 10;
		ladder_document_end(document);
		rung -= 10;
	}
	CHECK_AS(ladder_document_undo_cursor(document).rung == 0 &&
		 ladder_document_undo_cursor(document).col == 3,
		 "joined steps keep the cursor from before the first one");
	ladder_document_begin(document, "Move", NULL);
	ladder_document_move_rung(document, 0, 0, 1);
	ladder_document_end(document);
	CHECK(ladder_document_undo_cursor(document).rung == 2);
	CHECK(ladder_document_undo(document));
	CHECK(ladder_document_undo_cursor(document).rung == 0);
	ladder_document_set_cursor(document, NULL, NULL);
	g_object_unref(document);
}

/* ---- text ---- */

static void find_motor(void *context, const struct text_span *span)
{
	if (span->part == TEXT_VAR && span->pou < 0 && span->number == 1)
		*(struct text_span *)context = *span;
}

static void test_text(void)
{
	LadderDocument *document = open_sample();
	struct text_span span = { 0 };
	struct diag_list why;
	gsize len;
	char *text = ladder_document_outline(document, &len, find_motor, &span);
	char *before = ladder_document_text(document, NULL);

	g_signal_connect(document, "project-changed", G_CALLBACK(count_one),
			 &told_project);
	CHECK(g_str_has_prefix(text + span.at, "  Motor AT %QX0.0 : BOOL;\n"));
	CHECK(ladder_document_replace(document, span.at, span.len,
				      "Motor AT %QX0.7 : BOOL; (* big *)\n", NULL));
	CHECK(told_project == 1);
	g_free(text);
	text = ladder_document_text(document, NULL);
	CHECK(strstr(text, "  Motor AT %QX0.7 : BOOL; (* big *)\n"));
	CHECK_AS(!ladder_document_replace(document, span.at, 3, "((", &why) &&
		 why.errors > 0, "a text that cannot be read is refused with a reason");
	CHECK(has_text(document, text));
	CHECK(ladder_document_undo(document) && has_text(document, before));
	CHECK(ladder_document_redo(document) && has_text(document, text));
	CHECK(!ladder_document_replace(document, 100000, 0, "", &why));
	g_free(text);
	g_free(before);
	g_object_unref(document);
}

static void test_list(void)
{
	LadderDocument *document = open_sample();
	char *before = ladder_document_text(document, NULL);
	char *list = ladder_document_list(document, 1);

	CHECK_TEXT(list, "PROGRAM Other IL\n  LD    Start\n  ST    %QX0.3\nEND_PROGRAM\n");
	g_free(list);
	CHECK(ladder_document_put_list(document, 1,
		"PROGRAM Other IL\n  LD Start ((\nEND_PROGRAM\n"));
	list = ladder_document_list(document, 1);
	CHECK_AS(strstr(list, "((") && ladder_document_project(document),
		 "a list that cannot be read is kept beside the project");
	g_free(list);
	CHECK(ladder_document_put_rung(document, 0, 1,
		rung_of(document, "RUNG\n  | NO Motor | COIL %QX0.6 |\n"), NULL));
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors > 0);
	char *text = ladder_document_text(document, NULL);
	CHECK(strstr(text, "((") && strstr(text, "%QX0.6"));
	g_free(text);
	CHECK(ladder_document_put_list(document, 1,
		"PROGRAM Other IL\n  LD Motor\n  ST %QX0.3\nEND_PROGRAM\n"));
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors == 0);
	while (ladder_document_undo(document))
		;
	CHECK(has_text(document, before));
	g_free(before);
	g_object_unref(document);
}

/* The lines of the canonical text, which is shown: the file has two declarations and two statements in a line. */
static void test_lines(void)
{
	static const char file[] = "RUNGBOARD 1\nPROGRAM Main ST\nVAR\n  a, b : INT;\nEND_VAR\n"
		"  a := 1; IF a > 2 THEN b := 3; END_IF;\nEND_PROGRAM\n"
		"PROGRAM Other IL\nVAR\n  c, d : INT;\nEND_VAR\n  LD c\n  ST d\nEND_PROGRAM\n";
	LadderDocument *document = ladder_document_new();
	const struct project *project;
	char *text, **line;

	ladder_document_open_text(document, "/x/lines.rung", file, strlen(file), true);
	ladder_document_check_now(document);
	project = ladder_document_project(document);
	text = ladder_document_text(document, NULL);
	line = g_strsplit(text, "\n", -1);
	CHECK(project && project->pou[0].st->count == 4 && project->pou[1].il.count == 2);
	CHECK_TEXT(line[project->pou[0].st->item[0].line - 1], "  a := 1;");
	CHECK_TEXT(line[project->pou[0].st->item[2].line - 1], "    b := 3;");
	CHECK_TEXT(line[project->pou[1].il.line[1].line - 1], "  ST    d");
	CHECK_TEXT(line[project->pou[1].line - 1], "PROGRAM Other IL");
	g_strfreev(line);
	g_free(text);
	g_object_unref(document);
}

static void test_damaged(void)
{
	static const char bad[] = "RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NO Start COIL |\n"
		"END_PROGRAM\n";
	LadderDocument *document = ladder_document_new();
	const char *wrong = strstr(bad, "COIL");

	ladder_document_open_text(document, "/x/bad.rung", bad, strlen(bad), true);
	CHECK(!ladder_document_project(document) && has_text(document, bad));
	ladder_document_check_now(document);
	CHECK(ladder_document_diags(document)->errors > 0);
	CHECK(ladder_document_replace(document, (gsize)(wrong - bad), 6,
				      "| COIL Q0 |", NULL));
	CHECK_AS(ladder_document_project(document), "a corrected text becomes a project");
	CHECK(ladder_document_undo(document));
	CHECK(!ladder_document_project(document) && has_text(document, bad));
	CHECK(ladder_document_redo(document) && ladder_document_project(document));
	g_object_unref(document);
}

/* ---- a storm ---- */

static guint32 seed = 1;

static int pick(int below)
{
	seed = seed * 1664525u + 1013904223u;
	return (int)((seed >> 8) % (guint32)below);
}

/* Compares the live project with one that is read from its text. */
static bool reads_again(LadderDocument *document)
{
	LadderDocument *other = ladder_document_new();
	char *text = ladder_document_text(document, NULL);
	bool same;

	ladder_document_open_text(other, NULL, text, strlen(text), true);
	same = has_text(other, text);
	g_free(text);
	g_object_unref(other);
	return same;
}

/* ---- one more variable ---- */

static int told_variable;

static void count_variable(LadderDocument *document, int pou, const char *name,
			   const char *address, int *count)
{
	(void)document;
	(void)pou;
	*count += name[0] && address;
}

/* @marked: a text with one @ where the line must be inserted. @live: without reading all of
 * it. */
static void is_declared(const char *marked, int pou, const char *name, const char *type,
			const char *address, const char *line, bool live)
{
	char **halves = g_strsplit(marked, "@", 2);
	char *before = g_strjoin(NULL, halves[0], halves[1], NULL);
	char *want = g_strjoin(NULL, halves[0], line, halves[1], NULL);
	LadderDocument *document = ladder_document_new();

	told_variable = told_project = 0;
	ladder_document_open_text(document, NULL, before, strlen(before), true);
	CHECK_AS(has_text(document, before), "the text of the test is canonical");
	g_signal_connect(document, "variable-changed", G_CALLBACK(count_variable),
			 &told_variable);
	g_signal_connect(document, "project-changed", G_CALLBACK(count_one), &told_project);
	CHECK(ladder_document_declare(document, pou, name, type, address, NULL));
	CHECK(has_text(document, want) && reads_again(document));
	CHECK(told_variable == live && told_project == !live);
	CHECK(ladder_document_undo(document) && has_text(document, before));
	CHECK(ladder_document_is_saved(document) && !ladder_document_undo(document));
	CHECK(ladder_document_redo(document) && has_text(document, want));
	CHECK(told_variable == 3 * live && told_project == 3 * !live);
	g_object_unref(document);
	g_strfreev(halves);
	g_free(before);
	g_free(want);
}

static void test_declare(void)
{
	static const char body[] = "RUNG\n  | NO Ready | COIL Ready |\nEND_PROGRAM\n";
	LadderDocument *document = open_sample();
	struct diag_list why;
	char *text;

	text = g_strconcat("RUNGBOARD 1\n\nVAR\n  Ready AT %IX0.0 : BOOL; (* a *)\n@"
			   "END_VAR\n\nVAR RETAIN\n  Count : INT;\nEND_VAR\n\n"
			   "PROGRAM Main LD\n", body, NULL);
	is_declared(text, -1, "Lamp1", "BOOL", "%QX0.5",
		    "  Lamp1 AT %QX0.5 : BOOL;\n", true);
	is_declared(text, -1, "Slow1", "TON", "", "  Slow1 : TON;\n", true);
	g_free(text);
	text = g_strconcat("RUNGBOARD 1\n\nPROGRAM Main LD\nVAR\n  Ready : BOOL;\n"
			   "  Old   : TON;\nEND_VAR\nVAR\n@END_VAR\nVAR CONSTANT\n"
			   "  Pi : REAL := 3.1;\nEND_VAR\n", body, NULL);
	is_declared(text, 0, "Wait", "TON", NULL, "  Wait : TON;\n", true);
	g_free(text);
	text = g_strconcat("RUNGBOARD 1\n\nVAR RETAIN\n  Count : INT;\nEND_VAR\n\n"
			   "@PROGRAM Main LD\n", body, NULL);
	is_declared(text, -1, "Ready", "BOOL", "", "VAR\n  Ready : BOOL;\nEND_VAR\n\n",
		    false);
	g_free(text);
	text = g_strconcat("RUNGBOARD 1\n\n@PROGRAM Main LD\n", body, NULL);
	is_declared(text, -1, "Ready", "BOOL", "%IX0.0",
		    "VAR\n  Ready AT %IX0.0 : BOOL;\nEND_VAR\n\n", false);
	g_free(text);
	text = g_strconcat("RUNGBOARD 1\n\nPROGRAM Main LD\n@", body, NULL);
	is_declared(text, 0, "Wait", "TON", NULL, "VAR\n  Wait : TON;\nEND_VAR\n", false);
	g_free(text);
	is_declared("RUNGBOARD 1\n\nFUNCTION_BLOCK Seal LD\nVAR_INPUT\n  A : BOOL;\n"
		    "END_VAR\nVAR\n  B1 : BOOL;\n@END_VAR\nRUNG\n  | NO A | COIL B1 |\n"
		    "END_FUNCTION_BLOCK\n", 0, "T1", "TON", NULL, "  T1 : TON;\n", false);
	is_declared("RUNGBOARD 1\n\nVAR\n  A : BOOL;\nEND_VAR\n\nCONFIGURATION C\n"
		    "VAR_GLOBAL\n  B1 : BOOL;\n@END_VAR\nEND_CONFIGURATION\n\n"
		    "PROGRAM Main LD\nRUNG\n  | NO A | COIL B1 |\nEND_PROGRAM\n", -1, "B2",
		    "BOOL", NULL, "  B2 : BOOL;\n", true);
	text = ladder_document_text(document, NULL);
	diag_init(&why);
	CHECK(!ladder_document_declare(document, -1, "Bad name", "BOOL", NULL, &why));
	CHECK(why.errors > 0 && has_text(document, text));
	CHECK(!ladder_document_declare(document, 0, "Good", "NONSENSE", NULL, &why));
	CHECK(!ladder_document_declare(document, 0, "Good", "BOOL; X : BOOL", NULL, &why));
	CHECK(!ladder_document_declare(document, -1, "Good", "BOOL", "%IX99999.0", &why));
	CHECK(has_text(document, text) && !ladder_document_undo_name(document));
	g_free(text);
	g_object_unref(document);
}

/* ---- all of it at random ---- */

static void random_rungs(LadderDocument *document)
{
	struct pou *pou = &ladder_document_project(document)->pou[0];
	int at = pick(pou->rung_count + 1);
	int removed = pou->rung_count - at > 0 ? pick(2) : 0;
	struct rung *rungs[3] = { NULL };
	int count = pick(3);

	for (int i = 0; i < count; i++) {
		char *text = g_strdup_printf("RUNG \"r%d\"\n  | N%c I%d | COIL Q%d |\n",
			pick(100), pick(2) ? 'O' : 'C', pick(9), pick(9));

		rungs[i] = rung_of(document, text);
		g_free(text);
	}
	ladder_document_splice(document, 0, at, removed, rungs, count, NULL);
}

struct spans {
	struct text_span span[64];
	int count;
};

static void take_var(void *context, const struct text_span *span)
{
	struct spans *spans = context;

	if (span->part == TEXT_VAR && spans->count < 64)
		spans->span[spans->count++] = *span;
}

static void random_symbol(LadderDocument *document)
{
	struct spans spans = { .count = 0 };
	gsize len;
	char *text = ladder_document_outline(document, &len, take_var, &spans);
	const struct text_span *span = &spans.span[pick(spans.count)];
	char *more = g_strdup_printf("  New%d : INT := %d;\n", pick(1000), pick(100));

	ladder_document_replace(document, span->at, pick(4) ? 0 : span->len, more, NULL);
	g_free(more);
	g_free(text);
}

static void random_declaration(LadderDocument *document)
{
	char *name = g_strdup_printf("Fresh%d", pick(1000));
	const bool timer = pick(3) == 0;
	char *address = g_strdup_printf("%%MX%d.%d", pick(100), pick(8));

	ladder_document_declare(document, timer || pick(3) ? 0 : -1, name,
				timer ? "TON" : "BOOL", timer || pick(2) ? NULL : address,
				NULL);
	g_free(address);
	g_free(name);
}

/* A list that can be read, one that cannot, one with more than its POU, or none. */
static const char *some_list(void)
{
	static const char *const lists[] = {
		LIST, "PROGRAM Other IL\n  LD (\nEND_PROGRAM\n",
		"PROGRAM Other IL\n  LD I0\nEND_PROGRAM\nPROGRAM More IL\nEND_PROGRAM\n",
		("PROGRAM Other IL\n  LD I0\nEND_PROGRAM\nTYPE Pair : STRUCT\n  A : INT;\n"
		 "END_STRUCT;\nEND_TYPE\n"),
		"(* none *)", "",
	};

	return lists[pick((int)G_N_ELEMENTS(lists))];
}

static void random_edit(LadderDocument *document)
{
	char *name = g_strdup_printf("step %d", pick(1000));
	struct project *project = ladder_document_project(document);

	ladder_document_begin(document, name, pick(3) ? NULL : "same");
	for (int i = pick(3); i >= 0; i--) {
		switch (pick(6)) {
		case 0:
			random_symbol(document);
			break;
		case 1:
			ladder_document_put_list(document, 1, some_list());
			break;
		case 2:
			ladder_document_move_rung(document, 0, pick(3), pick(3));
			break;
		case 3:
			random_declaration(document);
			break;
		default:
			random_rungs(document);
		}
		project = ladder_document_project(document);
	}
	(void)project;
	if (pick(10))
		ladder_document_end(document);
	else
		ladder_document_cancel(document);
	g_free(name);
}

/* The document keeps its text between changes. Whoever hears of one gets that of now, also between the
 * changes of one step. */
struct look {
	LadderDocument *document;
	int looks, stale;
};

static void look_at_text(struct look *look)
{
	char *fresh, *text;
	size_t len;

	if (!ladder_document_ladder(look->document) || !ladder_document_is_whole(look->document))
		return;
	fresh = ladder_write(ladder_document_ladder(look->document), &len);
	text = ladder_document_text(look->document, NULL);
	look->looks++;
	look->stale += strcmp(fresh, text) != 0;
	free(fresh);
	g_free(text);
}

static void look_on_change(struct look *look)
{
	static const char *const changes[] = { "rungs-changed", "variable-changed", "project-changed",
		"list-changed", "bookmarks-changed", "state-changed" };

	for (gsize i = 0; i < G_N_ELEMENTS(changes); i++)
		g_signal_connect_swapped(look->document, changes[i], G_CALLBACK(look_at_text), look);
}

static void test_storm(void)
{
	int bad = 0, looks = 0, stale = 0;

	for (int round = 0; round < 40; round++) {
		LadderDocument *document = open_sample();
		char *before = ladder_document_text(document, NULL), *after, *again;
		struct look look = { .document = document };

		look_on_change(&look);
		for (int i = 0; i < 60; i++) {
			random_edit(document);
			if (pick(6) == 0)
				ladder_document_undo(document);
			if (pick(6) == 0)
				ladder_document_redo(document);
		}
		while (ladder_document_redo(document))
			;
		after = ladder_document_text(document, NULL);
		while (ladder_document_undo(document))
			;
		bad += !has_text(document, before);
		while (ladder_document_redo(document))
			;
		again = ladder_document_text(document, NULL);
		bad += strcmp(after, again) != 0;
		ladder_document_put_list(document, 1, LIST);
		bad += !reads_again(document);
		g_free(before);
		g_free(after);
		g_free(again);
		looks += look.looks;
		stale += look.stale;
		g_object_unref(document);
	}
	CHECK_AS(looks > 2400 && stale == 0, "at each of their signals the text is that of now");
	CHECK_AS(bad == 0, "2,400 random steps: undone all and redone all, the same bytes");
}

/* ---- files ---- */

/* A document whose file was deleted is the only copy. */
static void test_gone(void)
{
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *path = g_build_filename(folder, "a.rung", NULL);
	char *away = g_build_filename(folder, "away", NULL);
	LadderDocument *document = open_sample();

	CHECK(ladder_document_save(document, path, NULL));
	CHECK(ladder_document_is_saved(document));
	CHECK(g_rename(path, away) == 0);
	CHECK(ladder_document_disk(document) == DISK_GONE);
	CHECK(!ladder_document_is_saved(document));
	CHECK(g_rename(away, path) == 0);
	CHECK(ladder_document_disk(document) == DISK_AS_READ);
	CHECK(ladder_document_is_saved(document));
	CHECK(g_unlink(path) == 0 && ladder_document_disk(document) == DISK_GONE);
	CHECK(g_file_set_contents(path, "other", -1, NULL));
	CHECK(ladder_document_disk(document) == DISK_OTHER);
	CHECK(g_unlink(path) == 0 && ladder_document_disk(document) == DISK_GONE);
	CHECK(ladder_document_save(document, NULL, NULL));
	CHECK(ladder_document_is_saved(document));
	CHECK(ladder_document_disk(document) == DISK_AS_READ);
	CHECK(g_unlink(path) == 0 && g_rmdir(folder) == 0);
	g_object_unref(document);
	g_free(away);
	g_free(path);
	g_free(folder);
}

/* In the files of other tools DWORD_TO_REAL keeps the number, in a rung file the bits. */
static void test_becomes_rung_file(void)
{
	static const char text[] = "(* @NESTEDCOMMENTS := 'Yes' *)\n(* @PATH := '' *)\nPROGRAM PLC_PRG\nVAR\n  Bits : DWORD := 1000;\n"
		"  Number : REAL;\nEND_VAR\n(* @END_DECLARATION := '0' *)\n(* DWORD_TO_REAL *)\n"
		"Number := Dword_to_Real(Bits) / 4;\nBits := REAL_TO_DWORD(Number * 2);\nEND_PROGRAM\n";
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL), *saved = NULL, *now;
	char *path = g_build_filename(folder, "a.EXP", NULL);
	char *rung = g_build_filename(folder, "a.rung", NULL);
	LadderDocument *document = ladder_document_new();
	GError *error = NULL;

	CHECK(g_file_set_contents(path, text, -1, NULL));
	CHECK(ladder_document_open(document, path, NULL));
	CHECK(ladder_document_put_list(document, 0, "PROGRAM PLC_PRG\nVAR\n  Bits : DWORD := 1000;\n  Number : REAL;\n"
		"END_VAR\n  Number := ;\nEND_PROGRAM\n"));
	CHECK_AS(!ladder_document_save(document, rung, &error) && error && strstr(error->message, "It cannot become a rung file: line ") &&
		 !g_file_test(rung, G_FILE_TEST_EXISTS), "what cannot be read does not become a rung file");
	g_clear_error(&error);
	CHECK(strcmp(ladder_document_path(document), path) == 0);
	CHECK(ladder_document_undo(document) && ladder_document_save(document, rung, NULL));
	CHECK(g_file_get_contents(rung, &saved, NULL, NULL) && g_str_has_prefix(saved, "RUNGBOARD 1\n"));
	CHECK_AS(strstr(saved, "Number := UDINT_TO_REAL(Bits) / 4;") && strstr(saved, "Bits := REAL_TO_UDINT(Number * 2);") &&
		 strstr(saved, "(* DWORD_TO_REAL *)"), "the numbers stay numbers");
	now = ladder_document_text(document, NULL);
	CHECK(strcmp(now, saved) == 0 && ladder_document_is_saved(document) && !ladder_document_undo_name(document));
	CHECK(g_unlink(path) == 0 && g_unlink(rung) == 0 && g_rmdir(folder) == 0);
	g_object_unref(document);
	g_free(now);
	g_free(saved);
	g_free(rung);
	g_free(path);
	g_free(folder);
}

/* A restored draft differs from the file, which may have changed since. */
static void test_restored(void)
{
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *path = g_build_filename(folder, "a.rung", NULL);
	LadderDocument *document = open_sample(), *again = ladder_document_new();
	char *text = ladder_document_text(document, NULL), *sum;

	CHECK(ladder_document_save(document, path, NULL));
	sum = g_strdup(ladder_document_disk_sum(document));
	ladder_document_restore(again, path, sum, text, strlen(text));
	CHECK(!ladder_document_is_saved(again));
	CHECK(ladder_document_disk(again) == DISK_AS_READ);
	CHECK(g_file_set_contents(path, "other", -1, NULL));
	CHECK(ladder_document_disk(again) == DISK_OTHER);
	ladder_document_restore(again, path, NULL, text, strlen(text));
	CHECK(ladder_document_disk(again) == DISK_AS_READ && !ladder_document_disk_sum(again));
	CHECK(g_unlink(path) == 0 && g_rmdir(folder) == 0);
	g_object_unref(document);
	g_object_unref(again);
	g_free(text);
	g_free(sum);
	g_free(path);
	g_free(folder);
}

static void test_files(void)
{
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *path = g_build_filename(folder, "a.rung", NULL);
	LadderDocument *document = open_sample();
	GError *error = NULL;
	char *text = ladder_document_text(document, NULL), *got = NULL;

	CHECK(ladder_document_save(document, path, NULL));
	CHECK(g_file_get_contents(path, &got, NULL, NULL) && strcmp(got, text) == 0);
	CHECK_TEXT(ladder_document_path(document), path);
	CHECK(ladder_document_disk(document) == DISK_AS_READ);
	CHECK(g_file_set_contents(path, "other", -1, NULL));
	CHECK(ladder_document_disk(document) == DISK_OTHER);
	CHECK(!ladder_document_save(document, "/nowhere/at/all.rung", &error) && error);
	CHECK_TEXT(ladder_document_path(document), path);
	g_clear_error(&error);
	CHECK(!ladder_document_open(document, "/nowhere.rung", &error) && error);
	CHECK(has_text(document, text));
	g_clear_error(&error);
	CHECK(g_file_set_contents(path, "RUNGBOARD 1\n\xff\n", -1, NULL));
	CHECK(ladder_document_open(document, path, NULL));
	CHECK(ladder_document_repaired(document) == 2 &&
	      !ladder_document_is_saved(document));
	g_unlink(path);
	g_rmdir(folder);
	g_free(got);
	g_free(text);
	g_free(path);
	g_free(folder);
	g_object_unref(document);
}

int main(void)
{
	test_rungs();
	test_unwritable();
	test_steps();
	test_cursor();
	test_text();
	test_list();
	test_lines();
	test_damaged();
	test_declare();
	test_storm();
	test_files();
	test_gone();
	test_becomes_rung_file();
	test_restored();
	return tap_done();
}
