/* SPDX-License-Identifier: MIT
 *
 * test_code - values and results beside the list that a ladder is translated to.
 *
 * A written list with the same text is the judge: where a line has a result, it is the one that
 * the written list has after that line.
 */
#include "editor-gtk/panels/code_view.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/text/line_values.h"
#include "editor-gtk/text/text_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

#define VARS \
	"RUNGBOARD 1\n\nVAR\n  A : BOOL;\n  B : BOOL;\n  C : BOOL;\n  M : BOOL;\n  L : BOOL;\n" \
	"  K : BOOL;\n  N : INT := 5;\n  T : TON;\nEND_VAR\n\n"

static const char ladder[] = VARS
	"PROGRAM Main LD\nRUNG Seal\n  | NO A   | NC B | COIL M |\n  | NO M  ^|\n"
	"RUNG Branches\n  | NO A | NO B   | NO M | S L    |\n  | NC C | NC A ^|\n"
	"RUNG Both\n  | NO B | NC C | COIL K |\n"
	"RUNG Timed\n  | NO A | TON T PT:=T#1s | NC B | COIL %QX0.0 |\n"
	"RUNG Compared\n  | NO C | [ N > 3 ] | NO B | R L |\nEND_PROGRAM\n";

static const char jumps[] = VARS
	"PROGRAM Main LD\nRUNG\n  | NO A | JMP Skip |\nRUNG\n  | NO B | COIL M |\n"
	"RUNG Skip\n  | NO C | COIL L |\nEND_PROGRAM\n";

/* A ladder with its list, and the written list. */
static LadderDocument *document, *written;
static LadderLineValues *values;
static LadderTextView *view;
static LadderSim *sim, *judge;
static char **lines;
static int known; /* results at the last comparison                          */

static LadderDocument *opened(const char *text)
{
	LadderDocument *made = ladder_document_new();

	ladder_document_open_text(made, "/tmp/x/code.rung", text, strlen(text), true);
	ladder_document_check_now(made);
	return made;
}

static char *shown(void)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(values));
	GtkTextIter start, end;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	return gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
}

static void set(LadderSim *to, const char *name, bool on)
{
	const struct act act = { .kind = ACT_SET, .value.i = on,
		.at = live_value_find(live_image(to, false), name) };

	ladder_sim_act(to, &act);
}

static void step(int bits)
{
	LadderSim *const both[] = { sim, judge };

	for (int i = 0; i < 2; i++) {
		set(both[i], "A", bits & 1);
		set(both[i], "B", bits & 2);
		set(both[i], "C", bits & 4);
		ladder_sim_scan(both[i], 1);
	}
}

static int line_of(const char *text)
{
	for (int i = 0; lines[i]; i++)
		if (strcmp(g_strstrip(lines[i]), text) == 0)
			return i;
	return -1;
}

static bool has_result(const char *text, const char *result)
{
	return g_strcmp0(line_values_result(values, line_of(text)), result) == 0;
}

/* Do both show these bits, and no line another result than that of the written list? */
static bool agree(int bits)
{
	static const char *const loads[] = { "LD    A", "ANDN  B", "LD    C" };
	bool good = true;

	known = 0;
	for (int i = 0; i < 3; i++) {
		const char *wanted = bits >> i & 1 ? "TRUE" : "FALSE";
		const int at = line_of(loads[i]);

		good &= at >= 0 && g_strcmp0(line_values_text(values, at), wanted) == 0 &&
			g_strcmp0(ladder_text_view_value(view, at + 1), wanted) == 0;
	}
	for (int i = 0; good && lines[i]; i++) {
		char *result = g_strdup(line_values_result(values, i));

		known += result != NULL;
		good = !result || g_strcmp0(result, ladder_text_view_result(view, i + 1)) == 0;
		if (!good)
			printf("# %d: %s: %s, %s\n", bits, lines[i], result,
			       ladder_text_view_result(view, i + 1));
		g_free(result);
	}
	return good;
}

static void test_results(void)
{
	char *text = shown(), *list = g_strconcat(VARS, text, NULL);

	printf("# %s\n", text);
	lines = g_strsplit(text, "\n", -1);
	written = opened(list);
	view = g_object_ref_sink(LADDER_TEXT_VIEW(ladder_text_view_new(written, 0)));
	judge = ladder_sim_new(written);
	ladder_text_view_set_sim(view, judge);
	CHECK(has_result("ST    M", NULL));
	if (!CHECK(ladder_sim_begin(sim, NULL) && ladder_sim_begin(judge, NULL)))
		return;
	for (int bits = 0; bits < 16; bits++) {
		step(bits ^ bits >> 1);
		CHECK_SOON(agree((bits ^ bits >> 1) & 7));
		CHECK(known >= 12);
	}
	step(1);
	CHECK_SOON(agree(1));
	printf("# %d of %u lines\n", known, g_strv_length(lines));
	CHECK(has_result("LD    A", "TRUE") && has_result("OR    M", "TRUE") &&
	      has_result("ANDN  B", "TRUE") && has_result("ST    M", "TRUE"));
	CHECK_AS(has_result("END_PROGRAM", NULL) && has_result("VAR", NULL),
		 "only instructions have results");
	CHECK(ladder_sim_show(sim, 1));
	CHECK_AS(has_result("LD    A", "FALSE") && has_result("ST    M", "FALSE"),
		 "the results are those of the earlier scan");
	ladder_sim_end(sim);
	CHECK(has_result("ST    M", NULL));
	g_strfreev(lines);
	g_free(list);
	g_free(text);
}

int main(void)
{
	GtkWidget *window, *code;

	if (!screen_start()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	gtk_init();
	adw_init();
	gtk_source_init();
	document = opened(ladder);
	sim = ladder_sim_new(document);
	code = ladder_code_view_new(document, sim);
	values = LADDER_LINE_VALUES(gtk_scrolled_window_get_child(GTK_SCROLLED_WINDOW(code)));
	window = gtk_window_new();
	gtk_window_set_child(GTK_WINDOW(window), code);
	screen_show(window);
	turn(0);
	test_results();
	ladder_document_open_text(document, "/tmp/x/jumps.rung", jumps, strlen(jumps), true);
	ladder_document_check_now(document);
	turn(0);
	lines = g_strsplit(shown(), "\n", -1);
	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_scan(sim, 1);
	CHECK_SOON(line_of("ST    L") > 0 &&
		   line_values_text(values, line_of("ST    L")) != NULL);
	CHECK_AS(has_result("ST    L", NULL) && has_result("LD    B", NULL),
		 "with jumps the power may be that of another scan");
	g_strfreev(lines);
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(view);
	g_object_unref(judge);
	g_object_unref(sim);
	g_object_unref(written);
	g_object_unref(document);
	return tap_done();
}
