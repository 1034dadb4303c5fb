/* SPDX-License-Identifier: MIT
 *
 * test_folds - blocks of a text: where they end, what folding hides, and what shows it again.
 */
#include "editor-gtk/text/fold_lines.h"
#include "editor-gtk/text/text_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

/* ---- where blocks end ---- */

/* @ends: the last line of each line's block, from 0, one letter each: "3123". */
static bool ends_are(const char *text, const char *ends)
{
	int count, *found = fold_ends(text, &count);
	struct fold_state state = { 0 };
	bool same = count == (int)strlen(ends);

	for (int i = 0; same && i < count; i++) {
		bool known;

		same = found[i] == ends[i] - '0' &&
		       (found[i] == i || fold_end(text, state, &known) == found[i] - i);
		fold_kind_of(text, &state);
		text = fold_next(text);
		if (!same)
			printf("# line %d ends in %d\n", i, found[i]);
	}
	g_free(found);
	return same;
}

static void test_ends(void)
{
	CHECK(ends_are("IF a THEN\n  b;\nEND_IF;\nc;", "2123"));
	CHECK(ends_are("IF a THEN b; END_IF;\nc;", "01"));
	CHECK(ends_are("for i := 1 to 3 do\n  if a then\n    b;\n  end_if;\nend_for;", "43234"));
	CHECK(ends_are("REPEAT\n  WHILE a DO\n    b;\n  END_WHILE;\nUNTIL c END_REPEAT;", "43234"));
	CHECK(ends_are("CASE n OF\n  1: a;\nEND_CASE;", "212"));
	CHECK(ends_are("PROGRAM Main ST\nVAR_INPUT\n  a : INT;\nEND_VAR\n  b;\nEND_PROGRAM\n", "5323456"));
	CHECK(ends_are("ACTION Fill:\n  a;\nEND_ACTION\nSTEP One:\n  Fill(N);\nEND_STEP", "212545"));
	CHECK_AS(ends_are("TYPE\n  T : STRUCT\n    a : INT;\n  END_STRUCT;\nEND_TYPE", "43234"), "a structure");
	CHECK_AS(ends_are("(* a\n  (* b *)\n*) c;\nd;", "2123"), "a comment in a comment");
	CHECK_AS(ends_are("/* a\n*/ IF b THEN\n  c;\nEND_IF;", "1323"), "behind a comment");
	CHECK_AS(ends_are("// a\n  // b\n// c\nd;\n// e", "21234"), "lines of //");
	CHECK_AS(ends_are("a := 'IF $' (*';\nb; // FOR\n(* CASE *)", "012"), "texts and comments have no blocks");
	CHECK_AS(ends_are("Step := 3;\nx.IF\nStep.X;\nINT#IF", "0123"), "names have none");
	CHECK_AS(ends_are("PROGRAM P WITH T : Main;\nb;", "01"), "an instance of a program has no body");
	CHECK_AS(ends_are("FOR a DO\n  IF b THEN\n  c;\nEND_FOR;\nd;", "32234"), "an unfinished block ends in the one around it");
	CHECK_AS(ends_are("IF a THEN\n  b;\n", "212"), "one that never ends ends with the text");
	CHECK_AS(ends_are("IF a THEN\r\n  b;\rEND_IF;", "212"), "all line ends that a text view knows");
	CHECK_AS(ends_are("", "0"), "no text");
}

/* ---- folding ---- */

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  a : INT;\n  b : INT;\nEND_VAR\n\n"
	"PROGRAM Main ST\n"             /* 1 */
	"  a := 1;\n"                   /* 2 */
	"  if a>2 then\n"               /* 3 */
	"    for b := 1 TO 3 DO\n"      /* 4 */
	"      a := a + b;\n"           /* 5 */
	"    end_for;\n"                /* 6 */
	"  end_if;\n"                   /* 7 */
	"  IF a > 5 THEN\n"             /* 8 */
	"    b := 6;\n"                 /* 9 */
	"  END_IF;\n"                   /* 10 */
	"  b := 7;\n"                   /* 11 */
	"END_PROGRAM\n";

static LadderDocument *document;
static LadderTextView *view;
static GtkTextBuffer *buffer;

static void put_cursor(int line, int column)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line_index(buffer, &at, line - 1, column);
	gtk_text_buffer_place_cursor(buffer, &at);
}

static int cursor(void)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	return gtk_text_iter_get_line(&at) + 1;
}

static bool fold_at(int line)
{
	put_cursor(line, 0);
	return ladder_text_view_fold(view, true);
}

static bool is_hidden(int line)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_line(buffer, &at, line - 1);
	return line <= gtk_text_buffer_get_line_count(buffer) &&
	       gtk_text_iter_has_tag(&at, gtk_text_tag_table_lookup(
		       gtk_text_buffer_get_tag_table(buffer), "folded"));
}

/* "2..3": how many lines are hidden behind each line, as one letter; -: the line itself is. */
static bool hidden_are(const char *wanted)
{
	for (int line = 1; *wanted; wanted++, line++) {
		const int want = *wanted == '.' ? 0 : *wanted == '-' ? -1 : *wanted - '0';
		int hidden = is_hidden(line) ? -1 : 0;

		while (hidden >= 0 && is_hidden(line + hidden + 1))
			hidden++;
		if (hidden != want) {
			printf("# line %d: %d\n", line, hidden);
			return false;
		}
	}
	return true;
}

static void move(GtkMovementStep step, int count)
{
	GtkWidget *text = GTK_WIDGET(gtk_root_get_focus(gtk_widget_get_root(GTK_WIDGET(view))));

	g_signal_emit_by_name(text, "move-cursor", step, count, FALSE);
}

static void test_folding(void)
{
	char *before = ladder_document_text(document, NULL), *after;

	CHECK(hidden_are("............"));
	CHECK(fold_at(5) && hidden_are("...2--......"));
	CHECK_AS(cursor() == 4, "the cursor goes to the line that is shown");
	CHECK_AS(ladder_text_view_fold(view, true) && hidden_are("..4----....."), "then the block around it");
	CHECK_AS(cursor() == 3 && ladder_text_view_fold(view, false) && hidden_are("...2--......"), "what is in it stays folded");
	ladder_text_view_fold_all(view, true);
	CHECK_AS(hidden_are("..4----2--.."), "all but the program");
	after = ladder_document_text(document, NULL);
	CHECK(strcmp(after, before) == 0);
	ladder_text_view_fold_all(view, false);
	CHECK(hidden_are("............"));
	g_free(before);
	g_free(after);
}

static void test_moving(void)
{
	ladder_text_view_fold_all(view, true);
	put_cursor(3, 0);
	move(GTK_MOVEMENT_DISPLAY_LINES, 1);
	CHECK(cursor() == 8);
	move(GTK_MOVEMENT_DISPLAY_LINES, -1);
	CHECK(cursor() == 3);
	move(GTK_MOVEMENT_PARAGRAPH_ENDS, 1);
	move(GTK_MOVEMENT_VISUAL_POSITIONS, 1);
	CHECK(cursor() == 8);
	move(GTK_MOVEMENT_VISUAL_POSITIONS, -1);
	CHECK(cursor() == 3);
	move(GTK_MOVEMENT_WORDS, 1);
	CHECK(cursor() == 8);
	move(GTK_MOVEMENT_WORDS, -2);
	CHECK(cursor() == 3);
	CHECK(hidden_are("..4----2--.."));
	ladder_text_view_go_here(view, 5, 3);
	CHECK_AS(cursor() == 5 && hidden_are(".......2--.."), "what is gone to is shown");
	ladder_text_view_fold_all(view, false);
}

/* As Backspace at the begin of a line. */
static void join_lines(void)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
	gtk_text_buffer_backspace(buffer, &at, FALSE, TRUE);
}

static void test_edits(void)
{
	ladder_text_view_fold_all(view, true);
	put_cursor(2, 0);
	gtk_text_buffer_insert_at_cursor(buffer, "  b := 1;\n", -1);
	CHECK_AS(hidden_are("...4----2--.."), "folds move with their lines");
	ladder_text_view_take(view);
	CHECK(ladder_document_undo(document) && hidden_are("..4----2--.."));
	put_cursor(8, 0);
	gtk_text_buffer_insert_at_cursor(buffer, "(* ", -1);
	CHECK_AS(hidden_are("..4----....."), "a comment above ends a fold");
	ladder_text_view_take(view);
	CHECK(ladder_document_undo(document) && hidden_are("..4----....."));
	put_cursor(3, 13);
	gtk_text_buffer_insert_at_cursor(buffer, "\n", -1);
	CHECK_AS(cursor() == 4 && !is_hidden(3) && !is_hidden(4), "a line behind the first one is shown");
	ladder_text_view_take(view);
	CHECK(ladder_document_undo(document));
	ladder_text_view_fold_all(view, true);
	put_cursor(8, 0);
	join_lines();
	CHECK_AS(cursor() == 7 && !is_hidden(7) && !is_hidden(8), "a line that is joined with a hidden one is shown");
	ladder_text_view_take(view);
	while (ladder_document_undo(document))
		;
	ladder_text_view_fold_all(view, false);
}

static void test_format(void)
{
	ladder_text_view_fold_all(view, true);
	put_cursor(11, 0);
	CHECK(ladder_text_view_format(view));
	CHECK_AS(hidden_are("..4----2--.."), "folds stay in a text that is formatted");
	CHECK(cursor() == 11);
	ladder_text_view_fold_all(view, false);
}

int main(void)
{
	GtkWidget *window;

	test_ends();
	if (!screen_start()) {
		printf("# no window: needs Xvfb\n");
		return tap_done();
	}
	gtk_init();
	adw_init();
	gtk_source_init();
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/folds.rung", sample, strlen(sample), true);
	window = gtk_window_new();
	view = LADDER_TEXT_VIEW(ladder_text_view_new(document, 0));
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	buffer = GTK_TEXT_BUFFER(ladder_text_view_buffer(view));
	gtk_window_set_default_size(GTK_WINDOW(window), 600, 500);
	screen_show(window);
	gtk_widget_grab_focus(GTK_WIDGET(view));
	turn(0);
	test_folding();
	test_moving();
	test_edits();
	test_format();
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(document);
	return tap_done();
}
