/* SPDX-License-Identifier: MIT
 *
 * test_file_history - one history for the document and the text files beside it; each is
 * saved separately.
 */
#include "editor-gtk/document/file_history.h"
#include "tests/tap.h"

#include <string.h>

#define FILES 2
#define STEPS 400
#define ROUNDS 20

static const char sample[] = "RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
			     "RUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";

static LadderDocument *document;
static GtkTextBuffer *buffer[FILES];
static struct file_history *history[FILES];
static int told;
static char *told_text;

static void tell(gpointer data, const char *text)
{
	(void)data;
	told++;
	g_free(told_text);
	told_text = g_strdup(text);
}

static void start(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	for (int i = 0; i < FILES; i++) {
		buffer[i] = gtk_text_buffer_new(NULL);
		gtk_text_buffer_set_text(buffer[i], i ? "größer = 1\n门 = 2\n" : "", -1);
		history[i] = file_history_new(buffer[i], document, i ? "b.io" : "a.scn", false,
					      tell, NULL);
	}
}

static void end(void)
{
	for (int i = 0; i < FILES; i++) {
		file_history_free(history[i]);
		g_clear_object(&buffer[i]);
	}
	g_clear_object(&document);
}

static char *text_of(int file)
{
	GtkTextIter from, to;

	gtk_text_buffer_get_bounds(buffer[file], &from, &to);
	return gtk_text_buffer_get_text(buffer[file], &from, &to, TRUE);
}

static void insert(int file, int at, const char *text)
{
	GtkTextIter iter;

	gtk_text_buffer_get_iter_at_offset(buffer[file], &iter, at);
	gtk_text_buffer_begin_user_action(buffer[file]);
	gtk_text_buffer_insert(buffer[file], &iter, text, -1);
	gtk_text_buffer_end_user_action(buffer[file]);
}

static bool is_text(int file, const char *wanted)
{
	char *text = text_of(file);
	const bool same = strcmp(text, wanted) == 0;

	if (!same)
		printf("# %s\n", text);
	g_free(text);
	return same;
}

/* ---- one after the other ---- */

static void test_order(void)
{
	start();
	insert(0, 0, "one two");
	ladder_document_toggle_bookmark(document, 0, 0);
	insert(1, 0, "three\n");
	CHECK_TEXT(ladder_document_undo_name(document), "Change b.io");
	CHECK(ladder_document_undo(document) && told == 1);
	CHECK(is_text(1, "größer = 1\n门 = 2\n") && is_text(0, "one two"));
	CHECK(ladder_document_undo(document) && told == 1);
	CHECK(!ladder_document_is_bookmarked(document, 0, 0));
	CHECK_TEXT(ladder_document_undo_name(document), "Change a.scn");
	CHECK(ladder_document_undo(document) && told == 2 && is_text(0, ""));
	CHECK(!ladder_document_undo(document));
	CHECK_TEXT(ladder_document_redo_name(document), "Change a.scn");
	CHECK(ladder_document_redo(document) && is_text(0, "one two"));
	CHECK_TEXT(told_text, "one two");
	end();
	told = 0;
}

/* Letters typed in one line are one step; a letter in another line or a pasted text is not. */
static void test_typing(void)
{
	start();
	insert(0, 0, "a");
	insert(0, 1, "b");
	insert(0, 2, "门");
	insert(0, 3, "\n");
	insert(0, 4, "c");
	insert(0, 5, "piece");
	CHECK(ladder_document_undo(document) && is_text(0, "ab门\nc"));
	CHECK(ladder_document_undo(document) && is_text(0, "ab门\n"));
	CHECK(ladder_document_undo(document) && is_text(0, "ab门"));
	CHECK(ladder_document_undo(document) && is_text(0, ""));
	CHECK(!ladder_document_undo(document));
	end();
}

/* Edits of a file beside it leave the document saved. */
static void test_saved(void)
{
	start();
	CHECK(ladder_document_is_saved(document));
	insert(0, 0, "one");
	CHECK(ladder_document_is_saved(document));
	ladder_document_toggle_bookmark(document, 0, 1);
	CHECK(!ladder_document_is_saved(document));
	insert(0, 0, "two");
	CHECK(ladder_document_undo(document) && !ladder_document_is_saved(document));
	CHECK(ladder_document_undo(document) && ladder_document_is_saved(document));
	CHECK(ladder_document_undo(document) && ladder_document_is_saved(document));
	insert(1, 0, "other"); /* what was undone is forgotten */
	CHECK(ladder_document_is_saved(document));
	ladder_document_toggle_bookmark(document, 0, 1);
	CHECK(ladder_document_undo(document) && ladder_document_is_saved(document));
	end();
}

/* Undo can return to the saved text, even in the middle of a word. */
static void test_save_between(void)
{
	start();
	insert(0, 0, "a");
	insert(0, 1, "b");
	file_history_saved(history[0]);
	insert(0, 2, "c");
	CHECK(ladder_document_undo(document) && is_text(0, "ab"));
	CHECK(ladder_document_undo(document) && is_text(0, ""));
	end();
}

/* Reading the document again forgets its steps, but not those of the files beside it. */
static void test_read_again(void)
{
	start();
	insert(0, 0, "one");
	ladder_document_toggle_bookmark(document, 0, 0);
	insert(1, 0, "two\n");
	insert(0, 3, " more");
	CHECK(ladder_document_undo(document));
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	CHECK(ladder_document_is_saved(document) && !ladder_document_redo_name(document));
	CHECK(ladder_document_undo(document) && is_text(1, "größer = 1\n门 = 2\n"));
	CHECK(ladder_document_undo(document) && is_text(0, ""));
	CHECK(!ladder_document_undo(document) && ladder_document_is_saved(document));
	end();
}

/* Steps of a closed file are not undone; the others are. */
static void test_closed(void)
{
	start();
	insert(0, 0, "one");
	ladder_document_toggle_bookmark(document, 0, 0);
	insert(0, 3, " more");
	insert(1, 0, "kept\n");
	file_history_free(history[0]);
	history[0] = NULL;
	CHECK(ladder_document_undo(document) && is_text(1, "größer = 1\n门 = 2\n"));
	CHECK(ladder_document_undo(document) && ladder_document_is_saved(document));
	CHECK(!ladder_document_undo(document) && is_text(0, "one more"));
	CHECK(ladder_document_redo(document) && ladder_document_is_bookmarked(document, 0, 0));
	end();
}

/* An undone step of a closed file goes, and those that are done stay so. */
static void test_closed_undone(void)
{
	start();
	ladder_document_toggle_bookmark(document, 0, 0);
	insert(0, 0, "one");
	CHECK(ladder_document_undo(document) && is_text(0, ""));
	file_history_free(history[0]);
	history[0] = NULL;
	CHECK(!ladder_document_redo_name(document));
	CHECK(ladder_document_undo(document) && !ladder_document_is_bookmarked(document, 0, 0));
	end();
}

/* ---- at random ---- */

static const char *const pieces[] = { "a", "ö", "门", "\n", "line\nline", "Türe", "" };

static void delete(int file, int at, int count)
{
	GtkTextIter from, to;

	gtk_text_buffer_get_iter_at_offset(buffer[file], &from, at);
	gtk_text_buffer_get_iter_at_offset(buffer[file], &to, at + count);
	gtk_text_buffer_begin_user_action(buffer[file]);
	gtk_text_buffer_delete(buffer[file], &from, &to);
	gtk_text_buffer_end_user_action(buffer[file]);
}

static void random_step(GRand *random)
{
	const int file = g_rand_int_range(random, 0, FILES);
	const int at = g_rand_int_range(random, 0,
		gtk_text_buffer_get_char_count(buffer[file]) + 1);

	switch (g_rand_int_range(random, 0, 5)) {
	case 0:
		ladder_document_toggle_bookmark(document, 0, g_rand_int_range(random, 0, 2));
		return;
	case 1:
		delete(file, at, g_rand_int_range(random, 0, 9));
		return;
	case 2:
		ladder_document_undo(document);
		return;
	default:
		insert(file, at, pieces[g_rand_int_range(random, 0, G_N_ELEMENTS(pieces))]);
	}
}

static char *everything(void)
{
	char *first = text_of(0), *second = text_of(1);
	char *text = ladder_document_text(document, NULL);
	char *all = g_strjoin("\f", text, first, second, NULL);

	g_free(text);
	g_free(first);
	g_free(second);
	return all;
}

static void undo_all(void)
{
	while (ladder_document_undo(document))
		;
}

static void redo_all(void)
{
	while (ladder_document_redo(document))
		;
}

/* Is everything as it was? */
static bool is_again(const char *wanted)
{
	char *now = everything();
	const bool same = strcmp(now, wanted) == 0;

	g_free(now);
	return same;
}

static bool round_trip(GRand *random)
{
	char *before, *after;
	bool good;

	start();
	before = everything();
	for (int i = 0; i < STEPS; i++)
		random_step(random);
	redo_all();
	after = everything();
	undo_all();
	good = is_again(before) && ladder_document_is_saved(document);
	redo_all();
	good = good && is_again(after) && strcmp(before, after) != 0;
	g_free(before);
	g_free(after);
	end();
	return good;
}

static void test_random(void)
{
	GRand *random = g_rand_new_with_seed(20261123);
	int bad = 0;

	for (int round = 0; round < ROUNDS; round++)
		bad += !round_trip(random);
	g_rand_free(random);
	CHECK_AS(bad == 0,
		 "8,000 random steps: undone all and redone all, the same bytes, and saved");
}

int main(void)
{
	test_order();
	test_typing();
	test_saved();
	test_save_between();
	test_read_again();
	test_closed();
	test_closed_undone();
	test_random();
	g_free(told_text);
	return tap_done();
}
