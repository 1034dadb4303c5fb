/* SPDX-License-Identifier: MIT
 *
 * test_bookmarks - bookmarks are saved in the file, follow their rungs, and can be undone.
 */
#include "editor-gtk/document/document.h"
#include "tests/tap.h"

#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
	"RUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nRUNG\n  | NO %IX0.2 | COIL %QX0.2 |\n"
	"END_PROGRAM\n\nPROGRAM Other LD\nRUNG\n  | NO %IX0.3 | COIL %QX0.3 |\n"
	"END_PROGRAM\n";

static LadderDocument *document;
static int told;

static void open_text(const char *text)
{
	ladder_document_open_text(document, "/tmp/x/marks.rung", text, strlen(text), true);
}

static bool text_is(const char *text)
{
	char *now = ladder_document_text(document, NULL);
	const bool same = strcmp(now, text) == 0;

	if (!same)
		printf("# %s\n", now);
	g_free(now);
	return same;
}

static bool ends_with(const char *end)
{
	char *now = ladder_document_text(document, NULL);
	const bool good = g_str_has_suffix(now, end);

	if (!good)
		printf("# %s\n", now);
	g_free(now);
	return good;
}

static void undo_all(void)
{
	while (ladder_document_undo(document))
		;
}

static void test_set(void)
{
	int pou = 0, rung = 0;

	CHECK(!ladder_document_next_bookmark(document, &pou, &rung));
	ladder_document_toggle_bookmark(document, 0, 1);
	CHECK(told == 1 && ladder_document_is_bookmarked(document, 0, 1));
	CHECK(ends_with("\nVIEW\n  bookmark Main 2\nEND_VIEW\n"));
	CHECK_TEXT(ladder_document_undo_name(document), "Set bookmark");
	ladder_document_toggle_bookmark(document, 1, 0);
	CHECK(ends_with("\nVIEW\n  bookmark Main 2\n  bookmark Other 1\nEND_VIEW\n"));
	CHECK(ladder_document_next_bookmark(document, &pou, &rung) && pou == 0 && rung == 1);
	CHECK(ladder_document_next_bookmark(document, &pou, &rung) && pou == 1 && rung == 0);
	CHECK_AS(ladder_document_next_bookmark(document, &pou, &rung) && pou == 0 &&
		 rung == 1, "the next bookmark after the last one is the first one");
	ladder_document_toggle_bookmark(document, 0, 1);
	CHECK(!ladder_document_is_bookmarked(document, 0, 1));
	ladder_document_toggle_bookmark(document, 1, 0);
	CHECK_AS(text_is(sample), "clearing the last bookmark removes the VIEW part");
	undo_all();
	CHECK(text_is(sample));
	while (ladder_document_redo(document))
		;
	CHECK(text_is(sample));
	undo_all();
}

/* Bookmarks for rungs 1 and 3. */
static void set_two(void)
{
	open_text(sample);
	ladder_document_toggle_bookmark(document, 0, 0);
	ladder_document_toggle_bookmark(document, 0, 2);
}

static bool marks_are(const char *which)
{
	for (int i = 0; which[i]; i++)
		if (ladder_document_is_bookmarked(document, 0, i) != (which[i] == 'x')) {
			printf("# rung %d\n", i + 1);
			return false;
		}
	return true;
}

static void test_follow(void)
{
	struct rung *rung = rung_new(1, 1);

	set_two();
	CHECK(ladder_document_splice(document, 0, 1, 0, &rung, 1, NULL));
	CHECK_AS(marks_are("x..x"), "a bookmark moves when a rung is inserted");
	ladder_document_undo(document);
	CHECK_AS(marks_are("x.x"), "one undo restores rungs and bookmarks");
	CHECK(ladder_document_splice(document, 0, 0, 1, NULL, 0, NULL));
	CHECK_AS(marks_are(".x"), "a deleted rung loses its bookmark");
	ladder_document_undo(document);
	CHECK(marks_are("x.x"));
	CHECK(ladder_document_move_rung(document, 0, 2, 0));
	CHECK_AS(marks_are("xx."), "a bookmark follows its rung up");
	ladder_document_undo(document);
	CHECK(ladder_document_move_rung(document, 0, 0, 1));
	CHECK_AS(marks_are(".xx"), "a bookmark follows its rung down");
	undo_all();
	CHECK(text_is(sample));
}

static void test_others(void)
{
	static const char kept[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n"
		"  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n\nVIEW\n  chart Speed\n"
		"  bookmark main 1 \"begin\"\n  bookmark Gone 7\nEND_VIEW\n";

	open_text(kept);
	CHECK_AS(marks_are("x"), "a bookmark is read in capitals and with text after it");
	ladder_document_toggle_bookmark(document, 0, 0);
	CHECK(ends_with("VIEW\n  chart Speed\n  bookmark Gone 7\nEND_VIEW\n"));
	ladder_document_undo(document);
	CHECK_AS(text_is(kept), "other lines of the VIEW part stay");
	ladder_document_begin(document, "Rename", NULL);
	ladder_document_rename_bookmarks(document, "Main", "Pump");
	ladder_document_end(document);
	CHECK(ends_with("  bookmark Pump 1 \"begin\"\n  bookmark Gone 7\nEND_VIEW\n"));
}

/* The heading is a line of the list: another name in it renames the POU. */
static void test_list(void)
{
	char *list, *other;

	open_text(sample);
	ladder_document_toggle_bookmark(document, 0, 1);
	ladder_document_toggle_bookmark(document, 1, 0);
	list = ladder_document_list(document, 0);
	other = g_strconcat("PROGRAM Pump", list + strlen("PROGRAM Main"), NULL);
	CHECK(ladder_document_put_list(document, 0, other));
	CHECK(ladder_document_is_bookmarked(document, 0, 1));
	CHECK(ends_with("\nVIEW\n  bookmark Pump 2\n  bookmark Other 1\nEND_VIEW\n"));
	ladder_document_undo(document);
	CHECK_AS(ends_with("\nVIEW\n  bookmark Main 2\n  bookmark Other 1\nEND_VIEW\n"),
		 "one undo restores the name and the bookmarks");
	g_free(other);
	/* Two POUs with the same name both keep their bookmarks. */
	other = g_strconcat("PROGRAM Other", list + strlen("PROGRAM Main"), NULL);
	CHECK(ladder_document_put_list(document, 0, other));
	CHECK(ladder_document_is_bookmarked(document, 1, 0));
	CHECK(ladder_document_put_list(document, 0, list));
	CHECK(ladder_document_is_bookmarked(document, 0, 1));
	CHECK(ends_with("\nVIEW\n  bookmark Main 2\n  bookmark Other 1\nEND_VIEW\n"));
	undo_all();
	g_free(other);
	g_free(list);
}

static void heard(void)
{
	told++;
}

int main(void)
{
	document = ladder_document_new();
	g_signal_connect(document, "bookmarks-changed", G_CALLBACK(heard), NULL);
	open_text(sample);
	test_set();
	test_follow();
	test_others();
	test_list();
	g_object_unref(document);
	return tap_done();
}
