/* SPDX-License-Identifier: MIT
 *
 * test_text - a list in its view: colours, words that could follow, errors in their
 * lines, typing and undoing in the one history.
 */
#include "editor-gtk/text/st_typing.h"
#include "editor-gtk/text/text_complete.h"
#include "editor-gtk/text/file_view.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/st_why.h"
#include "editor-gtk/text/text_mend.h"
#include "editor-gtk/text/line_values.h"
#include "editor-gtk/text/text_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"
#include "tests/editor/texts.h"
#include "tests/tap.h"
#include "engine/model/sfc.h"

#include <adwaita.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Stop AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO Start | COIL %QX0.5 |\nEND_PROGRAM\n\n"
	"PROGRAM List IL\nVAR\n  Delay : TON;\nEND_VAR\n  LD    Start\n  ANDN  Stop\n"
	"  ST    Motor\n  CAL   Delay(IN:=Start, PT:=T#1s)\nEND_PROGRAM\n";

static LadderDocument *document;
static LadderTextView *view;
static GtkTextBuffer *buffer;

static char *shown(void)
{
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

static void put_cursor(int line, int column)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line_index(buffer, &at, line, column);
	gtk_text_buffer_place_cursor(buffer, &at);
}

static void type(const char *text)
{
	for (; *text; text++)
		gtk_text_buffer_insert_at_cursor(buffer, text, 1);
	ladder_text_view_take(view);
}

static bool has_class(int line, int column, const char *name)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line_index(buffer, &at, line, column);
	return gtk_source_buffer_iter_has_context_class(GTK_SOURCE_BUFFER(buffer), &at,
							name);
}

/* Has the place a style? The scheme defines it, so any tag will do. */
static bool is_coloured(int line, int column)
{
	GtkTextIter start, end, at;
	GSList *tags;
	bool any = false;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	gtk_source_buffer_ensure_highlight(GTK_SOURCE_BUFFER(buffer), &start, &end);
	gtk_text_buffer_get_iter_at_line_index(buffer, &at, line, column);
	tags = gtk_text_iter_get_tags(&at);
	for (GSList *tag = tags; tag; tag = tag->next) {
		gboolean set;

		g_object_get(tag->data, "foreground-set", &set, NULL);
		any = any || set;
		if (!set)
			g_object_get(tag->data, "weight-set", &set, NULL);
		any = any || set;
	}
	g_slist_free(tags);
	return any;
}

/* List: 0 PROGRAM, 1 VAR, 2 Delay : TON, 3 END_VAR, 4 LD, 5 ANDN, 6 ST, 7 CAL, 8 END_PROGRAM. */
static void test_colours(void)
{
	CHECK(text_language() != NULL);
	CHECK_AS(is_coloured(0, 1), "PROGRAM is a keyword");
	CHECK_AS(is_coloured(2, 11), "TON behind a colon is a type");
	CHECK_AS(is_coloured(4, 3) && is_coloured(5, 5), "LD and ANDN are operators");
	CHECK_AS(!is_coloured(4, 9) && !is_coloured(2, 3), "names are not coloured");
	put_cursor(6, 13);
	type(" (* why *)");
	CHECK_AS(is_coloured(6, 18) && has_class(6, 18, "comment"),
		 "a comment is coloured");
	ladder_document_undo(document);
}

/* Does the text of a buffer with colours have a style at @column of @line? */
static bool is_coloured_in(GtkTextBuffer *other, const char *text, int line, int column)
{
	GtkTextBuffer *const own = buffer;
	bool any;

	gtk_text_buffer_set_text(other, text, -1);
	buffer = other;
	any = is_coloured(line, column);
	buffer = own;
	return any;
}

/* Each word that a line of a chart begins with, where it is one and where it is a name. */
static void test_chart_colours(void)
{
	GtkSourceBuffer *chart = gtk_source_buffer_new_with_language(text_language());
	const struct sfc_word *word;

	for (int i = 0; (word = sfc_word(i)); i++) {
		char *begins = g_strdup_printf("PROGRAM Main SFC\n  %s Fill:\n", word->word);
		char *named = g_strdup_printf("VAR\n  %s : BOOL;\nEND_VAR\n", word->word);
		const bool is_end = word->kind == SFC_WORD_END;

		CHECK_AS(is_coloured_in(GTK_TEXT_BUFFER(chart), begins, 1, 2), word->word);
		CHECK_AS(!is_coloured_in(GTK_TEXT_BUFFER(chart), begins, 1,
					 (int)strlen(word->word) + 4), "a step's name");
		CHECK_AS(is_coloured_in(GTK_TEXT_BUFFER(chart), named, 1, 2) == is_end,
			 "a name that is a word of charts elsewhere");
		g_free(begins);
		g_free(named);
	}
	CHECK_AS(is_coloured_in(GTK_TEXT_BUFFER(chart), "  STEP Fill: END_STEP\n", 0, 14),
		 "the end of a step in its line");
	CHECK_AS(!is_coloured_in(GTK_TEXT_BUFFER(chart), "  LD    STEP\n", 0, 9),
		 "an operand");
	g_object_unref(chart);
}

/* A body of Structured Text: what has a colour, and what has none. */
static void test_statement_colours(void)
{
	static const struct {
		const char *line;
		int column;
		bool coloured;
	} cases[] = {
		{ "  IF Start AND Stop THEN", 3, true }, { "  IF Start AND Stop THEN", 6, false },
		{ "  IF Start AND Stop THEN", 12, true }, { "  IF Start AND Stop THEN", 21, true },
		{ "  Iffy := 1;", 3, false }, { "  Level := 16#FF;", 13, true },
		{ "  Level := 16#FF;", 4, false }, { "  T1(PT := T#-1d2h);", 13, true },
		{ "  Now := Phase#Idle;", 11, true }, { "  FOR i := 1 TO 10 BY -2 DO", 13, true },
		{ "  Name := 'a$'IF';", 14, true }, { "  Name := 'a'; // why", 18, true },
		{ "  (* a (* b *) c *) Level := 1;", 14, true },
		{ "  (* a (* b *) c *) Level := 1;", 21, false },
		{ "  {region}", 4, true }, { "  Sum := INT_TO_REAL(Level);", 11, true },
		{ "  Sum := Level(1);", 11, false }, { "  Wait : TON;", 10, true },
		{ "  Wait : ARRAY[1..2] OF TON;", 25, true }, { "  END_REPEAT", 4, true },
		{ "  Level := %IW2;", 12, true }, { "  Level := TRUE;", 12, true },
		{ "  X : LREAL;", 8, true }, { "  X := Mix.Time;", 13, false },
	};
	LadderDocument *other = ladder_document_new();
	GtkSourceBuffer *body;
	const char *file = "PROGRAM Main ST\n  ;\nEND_PROGRAM\n";

	ladder_document_open_text(other, "/tmp/x/main.st", file, strlen(file), true);
	CHECK(text_language_of(other, 0) != text_language());
	CHECK(text_language_of(other, -1) == text_language_of(other, 0));
	CHECK(text_language_of(document, 1) == text_language() &&
	      text_language_of(document, -1) == text_language());
	body = gtk_source_buffer_new_with_language(text_language_of(other, 0));
	for (gsize i = 0; i < G_N_ELEMENTS(cases); i++)
		CHECK_AS(is_coloured_in(GTK_TEXT_BUFFER(body), cases[i].line, 0,
					cases[i].column) == cases[i].coloured, cases[i].line);
	g_object_unref(body);
	g_object_unref(other);
}

/* Each line of a body stands where it would be put. */
static void test_indents(void)
{
	static const char body[] =
		"PROGRAM Main ST\nVAR\n  i : INT;\nEND_VAR\n"
		"  IF Start THEN // DO\n    i := 1;\n    IF Stop THEN i := 2; END_IF;\n    i := 3;\n"
		"  ELSIF Stop THEN\n    (* THEN *)\n    REPEAT\n      i := 'DO' +\n      1;\n"
		"    UNTIL Stop END_REPEAT;\n    WHILE Stop DO\n      i := 4;\n    END_WHILE;\n"
		"  ELSE\n    CASE i OF\n      1, 2:\n        i := 5;\n        FOR i := 1 TO 3 DO\n"
		"          ;\n        END_FOR;\n    END_CASE;\n  END_IF;\n  i := 6;\n";
	char **lines = g_strsplit(body, "\n", -1);

	for (int i = 4; lines[i] && *lines[i]; i++) {
		if (st_indent(body, i) != (int)strspn(lines[i], " "))
			printf("# %d blanks: %s\n", st_indent(body, i), lines[i]);
		CHECK(st_indent(body, i) == (int)strspn(lines[i], " "));
	}
	CHECK(st_skeleton_is("if") && st_skeleton_is("REPEAT") && !st_skeleton_is("EXIT"));
	g_strfreev(lines);
}

/* The body with its first error mended, as the message asks. Caller frees. */
static char *mended(const char *body)
{
	char *text = g_strdup_printf("RUNGBOARD 1\nVAR\n  A : INT;\n  Level : INT;\nEND_VAR\n"
				     "SUBROUTINE Sub ST\n  A := 1;\nEND_SUBROUTINE\n"
				     "PROGRAM Main ST\n%sEND_PROGRAM\n", body);
	struct ladder *ladder = ladder_new();
	const struct diag_list *diags;
	struct text_mend mend;
	char *out = NULL;
	int line = 1;

	ladder_load_text(ladder, "x.rung", text, strlen(text));
	ladder_build(ladder);
	diags = ladder_diags(ladder);
	for (int i = 0; i < diags->count && !out; i++) {
		const struct diag *diag = &diags->diag[i];
		const char *at = text;

		for (line = 1; line < diag->line; line++)
			at = strchr(at, '\n') + 1;
		if (diag_severity(diag->id) != SEVERITY_ERROR || !text_mend_find(text,
				(gsize)(at - text) + (gsize)MAX(diag->column - 1, 0), diag, &mend))
			continue;
		out = g_strdup_printf("%.*s%s%s", (int)mend.at, text, mend.with,
				      text + mend.at + mend.len);
		g_free(mend.with);
	}
	ladder_free(ladder);
	if (out && g_str_has_suffix(out, "END_PROGRAM\n"))
		out[strlen(out) - strlen("END_PROGRAM\n")] = '\0';
	g_free(text);
	text = out ? g_strdup(strstr(out, "PROGRAM Main ST\n") + strlen("PROGRAM Main ST\n")) :
	       g_strdup("");
	g_free(out);
	return text;
}

static void test_mends(void)
{
	static const struct { const char *wrong, *right; } cases[] = {
		{ "  A := 1\n  Level := A;\n", "  A := 1;\n  Level := A;\n" },
		{ "  A = 5;\n", "  A := 5;\n" },
		{ "  IF A > 1 THEN\n    A := 2;\n  ELSE IF A > 0 THEN\n    A := 3;\n  END_IF;\n",
		  "  IF A > 1 THEN\n    A := 2;\n  ELSIF A > 0 THEN\n    A := 3;\n  END_IF;\n" },
		{ "  IF A > 1 THEN\n    A := 2;\n  Level := A;\n",
		  "  IF A > 1 THEN\n    A := 2;\n  END_IF;\n  Level := A;\n" },
		{ "  FOR A := 1 TO 3 DO\n    Level := 2;\n\n    Level := 3;\n",
		  "  FOR A := 1 TO 3 DO\n    Level := 2;\n\n    Level := 3;\n  END_FOR;\n" },
		{ "  A := Levl;\n", "  A := Level;\n" }, { "  A := 1 +;\n", "" },
		{ "  A := 'a';\n", "" },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(cases); i++) {
		char *now = mended(cases[i].wrong);

		CHECK_TEXT(now, cases[i].right);
		g_free(now);
	}
}

/* A whole statement, and the way of the cursor through it. */
static void test_skeleton(void)
{
	GtkSourceView *body = g_object_ref_sink(GTK_SOURCE_VIEW(gtk_source_view_new()));
	GtkTextBuffer *text = gtk_text_view_get_buffer(GTK_TEXT_VIEW(body));
	GtkTextIter at, end;
	char *now;

	gtk_text_buffer_set_text(text, "    ", -1);
	gtk_text_buffer_get_end_iter(text, &at);
	st_skeleton_put(body, &at, "for");
	gtk_text_buffer_insert_at_cursor(text, "i", -1);
	gtk_text_buffer_get_bounds(text, &at, &end);
	now = gtk_text_buffer_get_text(text, &at, &end, TRUE);
	CHECK_TEXT(now, "    FOR i :=  TO  DO\n      \n    END_FOR;");
	g_free(now);
	g_object_unref(body);
}

static bool offers(const char *text, int line, int column, const char *word, gsize *len)
{
	GListStore *words = text_complete_words(document, 1, text, line, column, len);
	bool found = false;

	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(words)); i++) {
		gpointer one = g_list_model_get_item(G_LIST_MODEL(words), i);
		char *typed = gtk_source_completion_proposal_get_typed_text(one);

		found = found || strcmp(typed, word) == 0;
		g_free(typed);
		g_object_unref(one);
	}
	g_object_unref(words);
	return found;
}

static void test_words(void)
{
	char *text = shown();
	gsize len;

	CHECK(offers(text, 4, 10, "Start", &len) && len == 2);
	CHECK(offers(text, 4, 10, "Stop", &len));
	CHECK_AS(!offers(text, 4, 10, "Motor", &len),
		 "a name that does not begin with the typed letters is not offered");
	CHECK(offers(text, 5, 4, "ANDN", &len) && len == 2);
	CHECK_AS(!offers(text, 5, 4, "Start", &len),
		 "no name is offered at the place of an operator");
	g_free(text);
	text = g_strdup("PROGRAM List IL\nVAR\n  Delay : TON;\nEND_VAR\n\n  CAL ( (\n"
			"  LD    Delay.\nEND_PROGRAM\n");
	CHECK_AS(offers(text, 6, 14, "Delay.Q", &len) || offers(text, 6, 14, "Q", &len),
		 "pins are offered in a list that cannot be read");
	g_free(text);
}

static bool wrong_at(int line, const char *part)
{
	char *text = ladder_text_view_tip(view, line + 1);
	const bool found = text && strstr(text, part);

	if (!found)
		printf("# line %d: %s\n", line, text ? text : "nothing");
	g_free(text);
	return found;
}

static int wrong_lines(void)
{
	int count = 0;

	for (int i = 0; i < gtk_text_buffer_get_line_count(buffer); i++) {
		char *text = ladder_text_view_tip(view, i + 1);

		count += text != NULL;
		g_free(text);
	}
	return count;
}

static void test_errors(void)
{
	char *before = shown(), *after;

	ladder_document_check_now(document);
	CHECK(wrong_lines() == 0);
	put_cursor(4, 13);
	type("x");
	ladder_document_check_now(document);
	CHECK_AS(wrong_at(4, "Startx") && wrong_lines() == 1,
		 "an unknown name is marked in its line");
	put_cursor(4, 0);
	type("\n\n");
	ladder_document_check_now(document);
	CHECK_AS(wrong_at(6, "Startx") && wrong_lines() == 1,
		 "the mark moves down with blank lines inserted above");
	put_cursor(8, 13);
	type("\n  BLAH ) 7\n");
	ladder_document_check_now(document);
	CHECK_AS(wrong_at(9, "LD"),
		 "the wrong line of a list that cannot be read is marked");
	CHECK(ladder_document_project(document) != NULL);
	while (ladder_document_undo(document))
		;
	after = shown();
	CHECK_TEXT(after, before);
	ladder_document_check_now(document);
	CHECK(wrong_lines() == 0);
	g_free(before);
	g_free(after);
}

/* The label below the text that has this class. */
static const char *label_with(const char *class)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(view));

	while (child && !gtk_widget_has_css_class(child, class))
		child = gtk_widget_get_next_sibling(child);
	return child ? gtk_label_get_text(GTK_LABEL(child)) : "";
}

/* What is told below the text is of the line of the cursor, wherever it goes. */
static void test_told(void)
{
	put_cursor(4, 13);
	type("x");
	put_cursor(5, 13);
	type("y");
	ladder_document_check_now(document);
	put_cursor(4, 3);
	CHECK(strstr(label_with("error"), "\"Startx\""));
	put_cursor(5, 3);
	CHECK(strstr(label_with("error"), "\"Stopy\"") && !strstr(label_with("error"), "Startx"));
	put_cursor(6, 3);
	CHECK_TEXT(label_with("error"), "");
	while (ladder_document_undo(document))
		;
	ladder_document_check_now(document);
}

/* A search begins at the cursor, and so at the first line of a text that is shown the first time. */
static void test_cursor_begins(void)
{
	LadderTextView *other = g_object_ref_sink(LADDER_TEXT_VIEW(ladder_text_view_new(document, 1)));
	GtkTextBuffer *text = GTK_TEXT_BUFFER(ladder_text_view_buffer(other));
	int at = -1;

	g_object_get(text, "cursor-position", &at, NULL);
	CHECK(at == 0 && gtk_text_buffer_get_char_count(text) > 50);
	g_object_unref(other);
}

static void test_typing(void)
{
	char *before = shown(), *after;
	GtkTextIter at;

	put_cursor(6, 13);
	type("2");
	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	CHECK_AS(gtk_text_iter_get_line(&at) == 6 &&
		 gtk_text_iter_get_line_index(&at) == 14,
		 "the cursor stays after the typed letter");
	type("3\n");
	put_cursor(7, 0);
	type("  LD Stop\n");
	CHECK_TEXT(ladder_document_undo_name(document), "Type text");
	ladder_document_undo(document);
	after = shown();
	CHECK_AS(strstr(after, "Motor23") && !strstr(after, "LD Stop"),
		 "undo removes one typed line");
	g_free(after);
	while (ladder_document_undo(document))
		;
	after = shown();
	CHECK_TEXT(after, before);
	CHECK(!gtk_text_buffer_get_can_undo(buffer));
	while (ladder_document_redo(document))
		;
	g_free(after);
	after = shown();
	CHECK(strstr(after, "Motor23") && strstr(after, "Stop"));
	while (ladder_document_undo(document))
		;
	g_free(after);
	g_free(before);
}

/* A letter goes into the document once: after it was drawn, or on request. */
static void test_soon(void)
{
	put_cursor(4, 13);
	gtk_text_buffer_insert_at_cursor(buffer, "8", 1);
	CHECK(!document_has(document, "Start8") && !ladder_document_undo_name(document));
	CHECK_SOON(document_has(document, "Start8"));
	gtk_text_buffer_insert_at_cursor(buffer, "9", 1);
	ladder_text_view_take(view);
	CHECK(document_has(document, "Start89"));
	CHECK(ladder_document_undo(document) && !ladder_document_undo_name(document));
	ladder_text_view_take(view);
	CHECK_AS(!document_has(document, "Start8"), "undone text does not return");
}

/* The text of the view, which has values beside its lines. */
static LadderLineValues *beside_view(void)
{
	return LADDER_LINE_VALUES(find_type(GTK_WIDGET(view), LADDER_TYPE_LINE_VALUES));
}

/* What is beside a line, by its text. */
static bool has_beside(const char *line, const char *value)
{
	char *text = shown(), **lines = g_strsplit(text, "\n", -1);
	const char *beside = NULL;
	bool found = false;

	for (int i = 0; lines[i]; i++)
		if (g_str_has_prefix(g_strchug(lines[i]), line)) {
			beside = line_values_text(beside_view(), i);
			found = true;
		}
	if (!found || g_strcmp0(beside, value) != 0)
		printf("# %s: %s\n", line, beside ? beside : found ? "nothing" : "no line");
	g_strfreev(lines);
	g_free(text);
	return found && g_strcmp0(beside, value) == 0;
}

/* The current result after a line, by its text. */
static bool has_result(const char *line, const char *value)
{
	char *text = shown(), **lines = g_strsplit(text, "\n", -1);
	const char *after = "no line";

	for (int i = 0; lines[i]; i++)
		if (g_str_has_prefix(g_strchug(lines[i]), line))
			after = line_values_result(beside_view(), i);
	if (g_strcmp0(after, value) != 0)
		printf("# %s: %s\n", line, after ? after : "nothing");
	g_strfreev(lines);
	g_free(text);
	return g_strcmp0(after, value) == 0;
}

static void put_list(const char *old, const char *new)
{
	char *text = shown(), **parts = g_strsplit(text, old, 2);
	char *with = g_strconcat(parts[0], new, parts[1], NULL);

	gtk_text_buffer_set_text(buffer, with, -1);
	ladder_text_view_take(view);
	g_free(with);
	g_strfreev(parts);
	g_free(text);
}

static void set_bit(LadderSim *sim, const char *name, bool on)
{
	const struct act act = { .kind = ACT_SET, .value.i = on,
		.at = live_value_find(live_image(sim, false), name) };

	ladder_sim_act(sim, &act);
	ladder_sim_scan(sim, 1);
}

/* What the scan computed, also of lines that it jumped over, of the past and after an edit. */
static void test_results(void)
{
	LadderSim *sim = ladder_sim_new(document);

	put_list("  ST    Motor\n", "  ST    Motor\n\n  JMPCN Off   (* not now *)\n"
		 "  LD    7\n  GT    5\nOff:\n");
	ladder_document_check_now(document);
	ladder_text_view_set_sim(view, sim);
	CHECK(has_result("LD    Start", NULL));
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(has_result("LD    Start", "not run") && has_result("VAR", NULL));
	ladder_sim_scan(sim, 1);
	CHECK_SOON(has_result("LD    Start", "FALSE"));
	CHECK(has_result("JMPCN Off", "FALSE") && has_result("LD    7", "not run") &&
	      has_result("GT    5", "not run") && has_result("Off:", NULL));
	set_bit(sim, "Start", true);
	CHECK_SOON(has_result("GT    5", "TRUE"));
	CHECK(has_result("LD    7", "7") && has_result("ANDN  Stop", "TRUE") &&
	      has_result("ST    Motor", "TRUE") && has_result("END_PROGRAM", NULL));
	CHECK(ladder_sim_show(sim, 1));
	CHECK_AS(has_result("LD    7", "not run") && has_result("ST    Motor", "FALSE"),
		 "the results are those of the earlier scan");
	ladder_sim_show_now(sim);
	put_list("GT    5", "GT    8");
	CHECK_AS(has_result("GT    8", NULL) && has_result("LD    7", "7") &&
		 has_beside("LD    Start", "TRUE"),
		 "an edited line has no result until a program with it runs");
	ladder_sim_end(sim);
	g_object_unref(sim);
}

static const char chart[] =
	"RUNGBOARD 1\n\nVAR\n  Start : BOOL;\n  Level : INT := 7;\n  Out   : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main SFC\nINITIAL_STEP Idle:\n  Look (N);\nEND_STEP\n\n"
	"STEP Fill:\n  Pour (N);\n  Look (N);\nEND_STEP\n\n"
	"TRANSITION FROM Idle TO Fill:\n  LD    Start\n  ST    Out\nEND_TRANSITION\n\n"
	"TRANSITION FROM Fill TO Idle := FALSE; END_TRANSITION\n\n"
	"ACTION Look:\n  LD    Level\n  GT    5\n  JMPCN Low\n  LD    2\nLow:\nEND_ACTION\n\n"
	"ACTION Pour:\n  LD    Level\n  ADD   100\n  ST    Level\nEND_ACTION\n"
	"END_PROGRAM\n";

/* Lists of conditions and actions in a chart: what is not evaluated in a scan is not run. */
static void test_chart_results(void)
{
	LadderDocument *charted = ladder_document_new(), *other = document;
	LadderTextView *listed = view;
	GtkTextBuffer *text = buffer;
	LadderSim *sim;

	ladder_document_open_text(charted, "/tmp/x/chart.rung", chart, strlen(chart), true);
	ladder_document_check_now(charted);
	document = charted;
	view = g_object_ref_sink(LADDER_TEXT_VIEW(ladder_text_view_new(charted, 0)));
	buffer = GTK_TEXT_BUFFER(ladder_text_view_buffer(view));
	sim = ladder_sim_new(charted);
	ladder_text_view_set_sim(view, sim);
	CHECK(has_result("GT    5", NULL) && ladder_sim_begin(sim, NULL));
	CHECK(has_result("GT    5", "not run"));
	ladder_sim_scan(sim, 1);
	CHECK_SOON(has_result("GT    5", "TRUE") && has_result("LD    2", "2"));
	CHECK(has_result("JMPCN Low", "TRUE") && has_beside("GT    5", NULL));
	CHECK_AS(has_result("ADD   100", "not run") && has_result("ST    Level", "not run"),
		 "the action of a step that is not active has not run");
	ladder_sim_scan(sim, 1);
	CHECK_SOON(has_result("LD    Start", "FALSE") && has_beside("LD    Start", "FALSE"));
	CHECK_AS(has_result("STEP Fill", NULL) && has_result("ACTION Look", NULL) &&
		 has_result("TRANSITION FROM", NULL), "only lines of lists have results");
	set_bit(sim, "Start", true);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(has_result("ADD   100", "207") || has_result("ADD   100", "107"));
	CHECK_AS(has_result("LD    Start", "not run"), "its step is left");
	CHECK(ladder_sim_show(sim, 1));
	CHECK_AS(has_result("ADD   100", "not run") && has_result("GT    5", "TRUE"),
		 "the results are those of the earlier scan");
	ladder_sim_end(sim);
	g_object_unref(sim);
	g_object_unref(view);
	g_object_unref(charted);
	view = listed;
	buffer = text;
	document = other;
}

static const char statements[] =
	"RUNGBOARD 1\n\nTYPE\n  Phase : (Idle, Filling := 3);\nEND_TYPE\n\n"
	"VAR\n  Start : BOOL;\n  Level : INT := 7;\n  Now : Phase;\n  PT : INT := 9;\nEND_VAR\n\n"
	"PROGRAM Main ST\nVAR\n  Wait : TON;\n  i : INT;\nEND_VAR\n"
	"  // Level\n  Wait(IN := TRUE, PT := T#1s);\n"
	"  IF Start THEN\n    Now := Phase#Filling;\n  ELSIF Level > 5 THEN\n    Level := Level + 100;\n"
	"  ELSE\n    Level := 0;\n  END_IF;\n"
	"  FOR i := 1 TO 3 DO\n    IF i = 2 THEN\n      EXIT;\n    END_IF;\n  END_FOR;\n"
	"  CASE Now OF\n    Idle:\n      PT := 1;\n    Filling:\n      PT := 2;\n  END_CASE;\n"
	"  WHILE FALSE DO\n    PT := 3;\n  END_WHILE;\nEND_PROGRAM\n";

static void check_why(LadderSim *sim, const char *condition, const char *wanted)
{
	char *text = g_strdup_printf("PROGRAM Main ST\n  %s\n", condition);
	char *why = st_why(sim, "Main", text, 1);

	CHECK_TEXT(why ? why : "", wanted);
	g_free(why);
	g_free(text);
}

/* The parts of a condition that decide. */
static void test_why(LadderSim *sim)
{
	check_why(sim, "IF Start THEN", "FALSE: Start is FALSE");
	check_why(sim, "IF Start XOR Level > 5 THEN",
		  "TRUE: Start is FALSE; and Level > 5 is true (Level = 107)");
	check_why(sim, "IF Level > 5 XOR NOT Start THEN",
		  "FALSE: Level > 5 is true (Level = 107); and NOT Start is true");
	check_why(sim, "IF Start OR Level < 5 XOR Start XOR Level > 5 AND NOT Start THEN",
		  "TRUE: Level < 5 is not true (Level = 107); and Start is FALSE; and Level > 5 AND NOT Start is true (Level = 107)");
	check_why(sim, "ELSIF Level > 5 AND NOT Start THEN",
		  "TRUE: Level > 5 is true (Level = 107); and NOT Start is true");
	check_why(sim, "IF Start OR Level < 5 THEN",
		  "FALSE: Start is FALSE; and Level < 5 is not true (Level = 107)");
	check_why(sim, "IF Level > 5 AND (Start OR Wait.Q) THEN", "FALSE: (Start OR Wait.Q) is not true");
	check_why(sim, "IF Start OR Now = Idle THEN", "TRUE: Now = Idle is true (Now = Idle)");
	check_why(sim, "WHILE Now = Phase#Filling DO",
		  "FALSE: Now = Phase#Filling is not true (Now = Idle)");
	check_why(sim, "UNTIL i >= 2 // why\n END_REPEAT;", "TRUE: i >= 2 is true (i = 2)");
	check_why(sim, "Start := Level = 107;", "TRUE: Level = 107 is true (Level = 107)");
	check_why(sim, "Level := Level + 1;", "");
	check_why(sim, "IF Nowhere THEN", "");
	check_why(sim, "END_IF;", "");
}

/* Structured Text: the values of a line, what a condition was, and which lines ran. */
static void test_statement_values(void)
{
	LadderDocument *written = ladder_document_new(), *other = document;
	LadderTextView *listed = view;
	GtkTextBuffer *text = buffer;
	LadderSim *sim;

	ladder_document_open_text(written, "/tmp/x/st.rung", statements, strlen(statements), true);
	ladder_document_check_now(written);
	document = written;
	view = g_object_ref_sink(LADDER_TEXT_VIEW(ladder_text_view_new(written, 0)));
	buffer = GTK_TEXT_BUFFER(ladder_text_view_buffer(view));
	sim = ladder_sim_new(written);
	ladder_text_view_set_sim(view, sim);
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(has_result("IF Start", "not run") && has_result("ELSE", NULL) &&
	      has_result("END_IF", NULL) && has_beside("//", NULL));
	ladder_sim_scan(sim, 1);
	CHECK_SOON(has_result("IF Start", "FALSE"));
	CHECK(has_result("ELSIF Level", "TRUE") && has_result("Level := Level", NULL) &&
	      has_beside("Level := Level", "107") &&
	      has_result("Now := ", "not run") && has_result("Level := 0", "not run"));
	CHECK(has_beside("Now := ", "Idle") && has_beside("IF Start", "FALSE") &&
	      has_beside("ELSIF Level", "107") && has_beside("Wait(", "0.0 s / 1 s"));
	CHECK(has_result("EXIT", NULL) && has_result("IF i", "TRUE") &&
	      has_result("FOR i", NULL) && has_beside("FOR i", "2"));
	CHECK(has_result("PT := 1", "1") && has_result("PT := 2", "not run") &&
	      has_result("WHILE FALSE", "FALSE") && has_result("PT := 3", "not run"));
	test_why(sim);
	set_bit(sim, "Start", true);
	CHECK_SOON(has_result("IF Start", "TRUE"));
	CHECK(has_result("ELSIF Level", "not run") && has_result("Level := Level", "not run") &&
	      has_result("PT := 2", "2") && has_beside("Now := ", "Filling") &&
	      has_result("Now := ", "Filling") &&
	      has_beside("CASE Now", "Filling"));
	CHECK(ladder_sim_show(sim, 1));
	CHECK_AS(has_result("IF Start", "FALSE") && has_beside("Now := ", "Idle"),
		 "the lines show an earlier scan");
	ladder_sim_end(sim);
	CHECK(has_result("IF Start", NULL));
	g_object_unref(sim);
	g_object_unref(view);
	g_object_unref(written);
	view = listed;
	buffer = text;
	document = other;
}

static void test_values(void)
{
	LadderSim *sim = ladder_sim_new(document);
	const struct act on = { .kind = ACT_SET, .value.i = 1 };
	struct act start = on;
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line_offset(buffer, &at, 7, 2);
	gtk_text_buffer_insert(buffer, &at, "Wait: ", -1);
	ladder_text_view_take(view);
	ladder_document_check_now(document);
	ladder_text_view_set_sim(view, sim);
	CHECK(line_values_text(beside_view(), 4) == NULL);
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(has_beside("LD    Start", "FALSE") && has_beside("ST    Motor", "FALSE"));
	start.at = live_value_find(live_image(sim, false), "Start");
	ladder_sim_act(sim, &start);
	ladder_sim_scan(sim, 31);
	CHECK_SOON(has_beside("LD    Start", "TRUE"));
	CHECK_SOON(has_beside("Wait: CAL   Delay", "0.3 s / 1 s"));
	CHECK(has_beside("ST    Motor", "TRUE") && has_beside("END_VAR", NULL) &&
	      has_beside("ANDN  Stop", "FALSE"));
	CHECK(ladder_sim_show(sim, 3));
	CHECK_AS(has_beside("Wait: CAL   Delay", "0.0 s / 1 s"),
		 "the lines show the values of an earlier scan");
	CHECK(ladder_sim_show(sim, 0) && has_beside("LD    Start", "FALSE"));
	ladder_sim_end(sim);
	CHECK(has_beside("LD    Start", NULL));
	g_object_unref(sim);
}

/* A place is shown that is gone to before the text has a size: its page begins at the first column. */
static void test_first_place(GtkWidget *window)
{
	GtkWidget *shown = gtk_window_get_child(GTK_WINDOW(window)), *inside;
	GtkWidget *stack = gtk_stack_new();
	LadderTextView *other = LADDER_TEXT_VIEW(ladder_text_view_new(document, 1));
	GtkScrolledWindow *scroller;
	GtkAdjustment *across, *down;

	inside = gtk_widget_get_first_child(GTK_WIDGET(other));
	while (!GTK_IS_SCROLLED_WINDOW(inside))
		inside = gtk_widget_get_next_sibling(inside);
	scroller = GTK_SCROLLED_WINDOW(inside);
	across = gtk_scrolled_window_get_hadjustment(scroller);
	down = gtk_scrolled_window_get_vadjustment(scroller);
	g_object_ref(shown);
	gtk_stack_add_child(GTK_STACK(stack), gtk_label_new(""));
	gtk_stack_add_child(GTK_STACK(stack), GTK_WIDGET(other));
	gtk_window_set_child(GTK_WINDOW(window), stack);
	gtk_window_set_default_size(GTK_WINDOW(window), 600, 500);
	screen_show(window);
	WAIT(gtk_adjustment_get_upper(down) > 100); /* its lines are known before it is shown */
	gtk_stack_set_visible_child(GTK_STACK(stack), GTK_WIDGET(other));
	ladder_text_view_go_here(other, 1, 1);
	WAIT(gtk_adjustment_get_page_size(across) > 300);
	CHECK(gtk_adjustment_get_page_size(across) > 300 && gtk_adjustment_get_page_size(down) > 300);
	CHECK(gtk_adjustment_get_value(across) == 0 && gtk_adjustment_get_value(down) == 0);
	gtk_window_set_child(GTK_WINDOW(window), shown);
	g_object_unref(shown);
}

/* Where the underline of line @line begins, in bytes; -1: the line has none. */
static int underline_at(GtkTextBuffer *text, int line)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(text, &at, line);
	for (;; gtk_text_iter_forward_char(&at)) {
		GSList *tags = gtk_text_iter_get_tags(&at);
		const bool any = tags != NULL;

		g_slist_free(tags);
		if (any)
			return gtk_text_iter_get_line_index(&at);
		if (gtk_text_iter_ends_line(&at))
			return -1;
	}
}

/* A flaw of a file is underlined from its column on. */
static void test_flaws_of_a_file(void)
{
	LadderSideFile *file = ladder_side_file_make("/tmp/x/list.scn", document);
	LadderFileView *shown = LADDER_FILE_VIEW(g_object_ref_sink(ladder_file_view_new(file, NULL)));
	GtkTextBuffer *text = ladder_side_file_buffer(file);

	gtk_text_buffer_set_text(text, "  one two\n  Gr\xc3\xb6\xc3\x9f" "e three four\n  five\n  six", -1);
	ladder_file_view_add_flaw(shown, 1, 7, "two");
	ladder_file_view_add_flaw(shown, 2, 11, "three");
	ladder_file_view_add_flaw(shown, 3, 0, "the whole line");
	CHECK(underline_at(text, 0) == 6);
	CHECK_AS(underline_at(text, 1) == 10, "columns are bytes");
	CHECK_AS(underline_at(text, 2) == 2, "without a column: behind the blanks");
	CHECK(underline_at(text, 3) == -1);
	ladder_file_view_clear_flaws(shown);
	CHECK(underline_at(text, 0) == -1 && underline_at(text, 1) == -1);
	g_object_unref(shown);
	g_object_unref(file);
}

int main(void)
{
	GtkWidget *window;

	if (!screen_start()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	gtk_init();
	adw_init();
	gtk_source_init();
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/list.rung", sample, strlen(sample), true);
	ladder_document_check_now(document);
	window = gtk_window_new();
	view = LADDER_TEXT_VIEW(ladder_text_view_new(document, 1));
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	buffer = GTK_TEXT_BUFFER(ladder_text_view_buffer(view));
	turn(0);
	test_colours();
	test_chart_colours();
	test_statement_colours();
	test_indents();
	test_skeleton();
	test_mends();
	test_words();
	test_errors();
	test_told();
	test_cursor_begins();
	test_typing();
	test_soon();
	test_values();
	test_results();
	test_chart_results();
	test_statement_values();
	test_first_place(window);
	test_flaws_of_a_file();
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(document);
	return tap_done();
}
