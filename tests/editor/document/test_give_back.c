/* SPDX-License-Identifier: MIT
 *
 * test_give_back - Esc restores a rung as it was at a place in the history, without the
 * declarations of its edits. No display.
 */
#include "editor-gtk/document/document.h"

#include "tests/tap.h"

#include <glib/gstdio.h>

/* Without declarations: the first one adds a block, and the project is read again. */
static const char SAMPLE[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\n"
	"RUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n"
	"RUNG\n  | NO %IX0.1 | COIL %QX0.1 |\n"
	"RUNG There\n  | NC %IX0.2 | COIL %QX0.2 |\nEND_PROGRAM\n\n"
	"PROGRAM Other IL\n  LD    %IX0.4\n  ST    %QX0.3\nEND_PROGRAM\n";

static LadderDocument *open_sample(void)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, SAMPLE, strlen(SAMPLE), true);
	return document;
}

static char *text_of(LadderDocument *document)
{
	return ladder_document_text(document, NULL);
}

static bool has_text(LadderDocument *document, const char *want)
{
	char *text = text_of(document);
	const bool same = strcmp(text, want) == 0;

	if (!same)
		printf("# got:\n%s# wanted:\n%s", text, want);
	g_free(text);
	return same;
}

static void put(LadderDocument *document, int rung, const char *cell)
{
	char *text = g_strdup_printf("RUNG\n| NO %s | COIL %%QX0.1 |\n", cell);
	struct diag_list diags;

	diag_init(&diags);
	ladder_document_put_rung(document, 0, rung,
				 ladder_read_rung(ladder_document_ladder(document), text,
						  strlen(text), &diags), NULL);
	g_free(text);
}

/* As in quick entry: the element and its new name are one step. */
static void enter(LadderDocument *document, int rung, const char *name, const char *address)
{
	ladder_document_begin(document, "Add element", NULL);
	put(document, rung, name);
	ladder_document_declare(document, address[0] ? -1 : 0, name, "BOOL", address, NULL);
	ladder_document_end(document);
}

static enum back back_to(LadderDocument *document, int rung, guint64 place)
{
	return ladder_document_give_back(document, 0, rung, place, "Give back");
}

static void test_declared(void)
{
	LadderDocument *document = open_sample();
	const guint64 place = ladder_document_place(document);
	char *edited, *before = text_of(document);

	CHECK_AS(back_to(document, 1, place) == BACK_NOTHING, "without edits nothing is restored");
	enter(document, 1, "Open", "%IX0.5");
	enter(document, 1, "Shut", "%IX0.6");
	enter(document, 1, "Mark", "");
	put(document, 1, "%IX0.7");
	edited = text_of(document);
	CHECK(strstr(edited, "Open AT %IX0.5") && strstr(edited, "Mark : BOOL"));
	CHECK_AS(back_to(document, 2, place) == BACK_NOTHING,
		 "a rung without own edits is not restored");
	CHECK(back_to(document, 1, place) == BACK_DONE);
	CHECK_AS(has_text(document, before),
		 "restoring a rung removes the declaration of its edit");
	CHECK_AS(back_to(document, 1, place) == BACK_NOTHING, "a restored rung is not restored twice");
	CHECK(strcmp(ladder_document_undo_name(document), "Give back") == 0);
	CHECK(ladder_document_undo(document) && has_text(document, edited));
	CHECK_AS(back_to(document, 1, place) == BACK_DONE && has_text(document, before),
		 "a restored rung can be restored again after an undo");
	enter(document, 1, "Open", "%IX0.5");
	CHECK_AS(back_to(document, 1, place) == BACK_DONE && has_text(document, before),
		 "a rung that was edited again is restored");
	while (ladder_document_undo(document))
		;
	CHECK(has_text(document, SAMPLE));
	while (ladder_document_redo(document))
		;
	CHECK(has_text(document, before));
	g_free(edited);
	g_free(before);
	g_object_unref(document);
}

static void test_other(void)
{
	LadderDocument *document = open_sample();
	guint64 place = ladder_document_place(document);
	char *edited;

	enter(document, 1, "Open", "%IX0.5");
	ladder_document_toggle_bookmark(document, 0, 2);
	CHECK_AS(back_to(document, 1, place) == BACK_DONE,
		 "a rung is restored although a bookmark was set");
	edited = text_of(document);
	CHECK_AS(strstr(edited, "VIEW") && !strstr(edited, "Open"),
		 "restoring a rung keeps the bookmark");
	g_free(edited);

	place = ladder_document_place(document);
	enter(document, 1, "Open", "%IX0.5");
	CHECK(ladder_document_declare(document, -1, "Other", "BOOL", "", NULL));
	edited = text_of(document);
	CHECK_AS(back_to(document, 1, place) == BACK_OTHER,
		 "a separate declaration prevents restoring");
	CHECK_AS(has_text(document, edited),
		 "a rung that cannot be restored does not change");
	g_free(edited);
	CHECK(ladder_document_undo(document) && back_to(document, 1, place) == BACK_DONE);

	place = ladder_document_place(document);
	enter(document, 1, "Open", "%IX0.5");
	put(document, 2, "Open");
	CHECK_AS(back_to(document, 1, place) == BACK_OTHER,
		 "an edit of another rung prevents restoring");
	CHECK(ladder_document_undo(document) && ladder_document_undo(document));
	CHECK_AS(back_to(document, 1, place) == BACK_NOTHING,
		 "a rung whose edits are undone is not restored");
	CHECK(ladder_document_undo(document));
	CHECK(!ladder_document_knows_place(document, place));
	CHECK_AS(back_to(document, 1, place) == BACK_NOTHING, "an undone place cannot be restored");
	g_object_unref(document);
}

static void test_joined(void)
{
	LadderDocument *document = open_sample();
	guint64 place;

	for (int i = 0; i < 3; i++) {
		ladder_document_begin(document, "Typing", "same");
		put(document, 1, i ? "%IX0.7" : "%IX0.6");
		ladder_document_end(document);
		if (i == 0)
			place = ladder_document_place(document);
	}
	CHECK_AS(!ladder_document_knows_place(document, place),
		 "a place whose step was extended is unknown");
	CHECK(back_to(document, 1, place) == BACK_NOTHING);
	place = ladder_document_place(document);
	ladder_document_open_text(document, NULL, SAMPLE, strlen(SAMPLE), true);
	CHECK_AS(!ladder_document_knows_place(document, place), "a place of another document is unknown");
	g_object_unref(document);
}

/* ---- random edits ---- */

static guint32 state = 12345;

static int pick(int count)
{
	state = state * 1664525u + 1013904223u;
	return (int)(state >> 8) % count;
}

static void random_step(LadderDocument *document)
{
	char name[20];

	g_snprintf(name, sizeof(name), "X%d", pick(9));
	switch (pick(7)) {
	case 0: put(document, 1, name); break;
	case 1: enter(document, 1, name, pick(2) ? "%IX0.5" : ""); break;
	case 2: enter(document, 1, name, "%MX3.1"); break;
	case 3: ladder_document_toggle_bookmark(document, 0, pick(3)); break;
	case 4: if (pick(3) == 0) enter(document, 2, name, ""); break;
	case 5: ladder_document_undo(document); break;
	default: ladder_document_redo(document); break;
	}
}

/* Bytes before the VIEW part. */
static size_t program_len(const char *text)
{
	const char *view = strstr(text, "\nVIEW");

	return view ? (size_t)(view - text) : strlen(text);
}

/* A restored rung gives the text from before, apart from bookmarks. */
static void test_any(void)
{
	int done = 0, bad = 0;

	for (int round = 0; round < 300; round++) {
		LadderDocument *document = open_sample();
		char *before, *edited, *after;
		guint64 place;

		for (int i = pick(6); i > 0; i--)
			random_step(document);
		place = ladder_document_place(document);
		before = text_of(document);
		for (int i = pick(8); i > 0; i--)
			random_step(document);
		edited = text_of(document);
		if (back_to(document, 1, place) == BACK_DONE) {
			done++;
			after = text_of(document);
			bad += program_len(before) != program_len(after) ||
			       memcmp(before, after, program_len(before)) != 0;
			g_free(after);
			bad += !ladder_document_undo(document);
		}
		bad += !has_text(document, edited);
		while (ladder_document_undo(document))
			;
		bad += !has_text(document, SAMPLE);
		g_free(before);
		g_free(edited);
		g_object_unref(document);
	}
	printf("# given back in %d of 300\n", done);
	CHECK(bad == 0);
	CHECK(done > 50);
}

int main(void)
{
	test_declared();
	test_other();
	test_joined();
	test_any();
	return tap_done();
}
