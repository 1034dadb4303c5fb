/* SPDX-License-Identifier: MIT
 *
 * test_timing - the timing chart over a simulation: its variables, which of them the
 * project keeps, and that other lines of the VIEW part stay.
 */
#include "editor-gtk/live/timing_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"

#include <adwaita.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\n"
	"  Count : INT;\n  Table : ARRAY[1..3] OF INT;\nEND_VAR\n\nPROGRAM Main LD\n"
	"RUNG\n  | NO Start | COIL Motor |\n"
	"RUNG\n  | NO Start | [ Count := Count + 1 ] |\nEND_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;
static LadderTimingView *view;
static int changes; /* of the program that runs                            */

static void program_changed(void)
{
	changes++;
}

static char *names(void)
{
	struct timing *timing = ladder_timing_area_timing(LADDER_TIMING_AREA(find_type(GTK_WIDGET(view), LADDER_TYPE_TIMING_AREA)));
	GString *out = g_string_new(NULL);

	for (int i = 0; i < timing_lines(timing); i++)
		g_string_append_printf(out, "%s%s", i ? " " : "", timing_name(timing, i));
	return g_string_free(out, FALSE);
}

static bool has(const char *want)
{
	char *have = names();
	const bool is = strcmp(have, want) == 0;

	if (!is)
		printf("# %s, not %s\n", have, want);
	g_free(have);
	return is;
}

static bool keeps(const char *want)
{
	const bool is = strcmp(ladder_document_view(document), want) == 0;

	if (!is)
		printf("# %s\n", ladder_document_view(document));
	return is;
}

static void open_text(const char *text)
{
	ladder_document_open_text(document, NULL, text, strlen(text), true);
}

static void test_text(void)
{
	static const char view_part[] = "VIEW\n  bookmark Main 1\n\ttiming  Motor \n"
		"  timing\n  timingX Start\n  watch auto Start\n  timing Count\nEND_VIEW\n";
	static const char *const other[] = { "Start", "Nobody", NULL };
	static const char *const none[] = { NULL };
	char **found = timing_kept_read(view_part), *text;

	CHECK(g_strv_length(found) == 2);
	CHECK_TEXT(found[0], "Motor");
	CHECK_TEXT(found[1], "Count");
	g_strfreev(found);
	text = timing_kept_write(view_part, other);
	CHECK_TEXT(text, "VIEW\n  bookmark Main 1\n  timing Start\n  timing Nobody\n  timing\n"
		   "  timingX Start\n  watch auto Start\nEND_VIEW\n");
	g_free(text);
	text = timing_kept_write("", other);
	CHECK_TEXT(text, "VIEW\n  timing Start\n  timing Nobody\nEND_VIEW");
	g_free(text);
	text = timing_kept_write("VIEW\n  timing A\nend_view", none);
	CHECK_TEXT(text, "VIEW\nend_view");
	g_free(text);
}

static void test_choice(void)
{
	CHECK(ladder_sim_begin(sim, NULL));
	turn(0);
	CHECK_AS(has("Start Motor") && keeps(""),
		 "a chart has inputs and outputs at first");
	ladder_sim_scan(sim, 20);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 20);
	changes = 0;
	CHECK(ladder_timing_view_add(view, "Table[ 2 ]"));
	CHECK(!ladder_timing_view_add(view, "table[2]") && !ladder_timing_view_add(view, " "));
	CHECK(has("Start Motor Table[2]"));
	CHECK(keeps("VIEW\n  timing Start\n  timing Motor\n  timing Table[2]\nEND_VIEW"));
	ladder_document_check_now(document);
	turn(300);
	CHECK_AS(changes == 0 && ladder_sim_first(sim) == 0,
		 "a check without a change keeps the past");
	ladder_document_undo(document);
	CHECK(has("Start Motor") && keeps(""));
	ladder_document_redo(document);
	CHECK(has("Start Motor Table[2]"));
	ladder_sim_end(sim);
	CHECK(ladder_sim_begin(sim, NULL));
	turn(0);
	CHECK_AS(has("Start Motor Table[2]"),
		 "the chosen lines are there in the next simulation");
}

static void test_file(void)
{
	char *text = g_strconcat(sample, "\nVIEW\n  timing Count\n  timing Nobody\nEND_VIEW\n",
				 NULL);

	ladder_sim_end(sim);
	open_text(text);
	CHECK_AS(has("Count Nobody"),
		 "the lines of a file are there without a simulation");
	CHECK(ladder_sim_begin(sim, NULL));
	turn(0);
	CHECK(has("Count Nobody"));
	ladder_sim_end(sim);
	open_text(sample);
	CHECK(ladder_sim_begin(sim, NULL));
	turn(0);
	CHECK_AS(has("Start Motor"), "another file does not keep the lines");
	g_free(text);
}

/* A chart that is made while the simulation runs, or shows the past. */
static void test_late(void)
{
	LadderTimingView *first = view;

	ladder_sim_scan(sim, 5);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 5);
	for (int past = 0; past < 2; past++) {
		CHECK(!past || ladder_sim_show(sim, 2));
		CHECK(ladder_sim_is_past(sim) == (past == 1));
		view = LADDER_TIMING_VIEW(g_object_ref_sink(ladder_timing_view_new(sim)));
		CHECK(has("Start Motor"));
		g_object_unref(view);
	}
	ladder_sim_show_now(sim);
	view = first;
}

/* Types a name and presses Enter. @why: the refusal, at the entry; NULL: it is added. */
static void want(const char *name, const char *why)
{
	GtkWidget *entry = find_type(GTK_WIDGET(view), GTK_TYPE_SEARCH_ENTRY);
	GtkWidget *label = gtk_widget_get_next_sibling(entry);

	gtk_editable_set_text(GTK_EDITABLE(entry), name);
	g_signal_emit_by_name(entry, "search-changed");
	CHECK(!gtk_widget_has_css_class(entry, "error") && !gtk_widget_get_visible(label));
	g_signal_emit_by_name(entry, "activate");
	CHECK_AS(gtk_widget_has_css_class(entry, "error") == (why != NULL), name);
	CHECK_AS(gtk_widget_get_visible(label) == (why != NULL), name);
	CHECK_TEXT(gtk_label_get_text(GTK_LABEL(label)), why ? why : "");
}

/* What cannot be added is refused where it is typed, with the reason. */
static void test_wanted(void)
{
	CHECK(has("Start Motor"));
	want("Nobody", "There is no such symbol");
	want("start", "The chart shows it already");
	want("%IX0.0", "The chart shows it already");
	CHECK(has("Start Motor"));
	want("Count", NULL);
	CHECK(has("Start Motor Count"));
	ladder_document_undo(document);
}

int main(void)
{
	GtkWidget *window;

	if (!screen_start()) {
		printf("1..0 # SKIP no Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	open_text(sample);
	sim = ladder_sim_new(document);
	g_signal_connect(sim, "program-changed", G_CALLBACK(program_changed), NULL);
	view = LADDER_TIMING_VIEW(ladder_timing_view_new(sim));
	window = gtk_window_new();
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	gtk_window_present(GTK_WINDOW(window));
	test_text();
	test_choice();
	test_file();
	test_late();
	test_wanted();
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
