/* SPDX-License-Identifier: MIT
 *
 * test_alarms - the panel of the alarms in the simulation: rows, the newest first, what is not
 * printable, acknowledging one and all, and a scan of the past.
 */
#include "editor-gtk/document/panel.h"
#include "editor-gtk/panels/alarm_view.h"
#include "editor-gtk/sim/live_value.h"
#include "tests/editor/panel_list.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

enum { STATE = 2, BLOCK = 4, MESSAGE = 5, ACKED = 7, TIMES = 8 };

static const char text[] =
	"RUNGBOARD 1\n\nVAR\n  A : BOOL;\n  B : BOOL;\n  C : BOOL;\n  Hot : ALARM;\n  Low : ALARM_LIMIT;\n"
	"  Note : EVENT;\nEND_VAR\n\nPROGRAM Main LD\n"
	"RUNG\n  | NO A | ALARM Hot MSG:='$1B[31m热$L' CLASS:=1 |\n"
	"RUNG\n  | NO B | ALARM_LIMIT Low IN:=5.0 LIMIT:=1.0 MSG:='low' |\n"
	"RUNG\n  | NO C | EVENT Note MSG:='begun' |\nEND_PROGRAM\n";

static LadderSim *sim;
static LadderAlarmView *view;

static void set(const char *name, bool on)
{
	const struct act act = { .kind = ACT_SET, .value.i = on,
		.at = live_value_find(live_image(sim, false), name) };

	ladder_sim_act(sim, &act);
}

static guint rows(void)
{
	return g_list_model_get_n_items(panel_items(view));
}

static bool has(guint at, int column, const char *wanted)
{
	LadderPanelRow *row = g_list_model_get_item(panel_items(view), at);
	const bool good = row && strcmp(panel_row_text(row, column), wanted) == 0;

	if (!good)
		printf("# %s\n", row ? panel_row_text(row, column) : "no row");
	g_clear_object(&row);
	return good;
}

static void scan(void)
{
	static guint64 scans;

	scans++;
	ladder_sim_scan(sim, 1);
	WAIT(ladder_sim_twin(sim) && ladder_sim_twin(sim)->scan >= scans);
	panel_settle();
}

static GtkWidget *button(const char *label)
{
	GtkWidget *box = gtk_widget_get_first_child(gtk_widget_get_first_child(GTK_WIDGET(view)));
	GtkWidget *at = gtk_widget_get_first_child(box);

	while (at && (!GTK_IS_BUTTON(at) || strcmp(gtk_button_get_label(GTK_BUTTON(at)), label) != 0))
		at = gtk_widget_get_next_sibling(at);
	return at;
}

static void test_rows(void)
{
	scan();
	CHECK(rows() == 0);
	set("A", true);
	scan();
	CHECK(rows() == 1 && has(0, BLOCK, "Hot") && has(0, STATE, "active"));
	CHECK(has(0, MESSAGE, "?[31m热?"));
	set("B", true);
	set("C", true);
	set("A", false);
	scan();
	CHECK(rows() == 3 && has(2, BLOCK, "Hot") && has(2, STATE, "gone, not acknowledged"));
	CHECK(has(0, BLOCK, "Note") && has(0, STATE, "event") && has(0, MESSAGE, "begun"));
}

static void test_acknowledging(void)
{
	GtkSingleSelection *selection = GTK_SINGLE_SELECTION(panel_items(view));

	gtk_single_selection_set_selected(selection, 0);
	CHECK(!gtk_widget_get_sensitive(button("Acknowledge"))); /* an event */
	gtk_single_selection_set_selected(selection, 2);
	CHECK(gtk_widget_get_sensitive(button("Acknowledge")));
	g_signal_emit_by_name(button("Acknowledge"), "clicked");
	scan();
	CHECK(has(2, STATE, "gone") && !has(2, ACKED, "") && has(1, STATE, "active"));
	set("A", true);
	scan();
	CHECK(has(0, BLOCK, "Hot") && has(0, TIMES, "2"));
	g_signal_emit_by_name(button("Acknowledge all"), "clicked");
	scan();
	CHECK(has(0, STATE, "active, acknowledged") && has(2, STATE, "active, acknowledged"));
	CHECK(!gtk_widget_get_sensitive(button("Acknowledge all")));
}

/* While it runs, and for a limit. */
static void test_running(void)
{
	set("B", false);
	scan();
	ladder_sim_run(sim);
	set("B", true);
	CHECK_SOON(gtk_widget_get_sensitive(button("Acknowledge all")));
	g_signal_emit_by_name(button("Acknowledge all"), "clicked");
	CHECK_SOON(!gtk_widget_get_sensitive(button("Acknowledge all")));
	ladder_sim_pause(sim);
}

/* What a recorded scan held is shown, too. */
static void test_the_past(void)
{
	CHECK(ladder_sim_show(sim, 2));
	WAIT(ladder_sim_twin(sim)->scan == 2);
	panel_settle();
	CHECK(rows() == 1 && has(0, STATE, "active"));
}

int main(void)
{
	LadderDocument *document;
	LadderBoardLink *link;
	GtkWidget *window;

	if (!screen_start()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	gtk_init();
	adw_init();
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/alarms.rung", text, strlen(text), true);
	ladder_document_check_now(document);
	sim = ladder_sim_new(document);
	link = ladder_board_link_new();
	view = LADDER_ALARM_VIEW(ladder_alarm_view_new(sim, link));
	window = gtk_window_new();
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	screen_show(window);
	CHECK(ladder_sim_begin(sim, NULL));
	test_rows();
	test_acknowledging();
	test_the_past();
	test_running();
	ladder_sim_end(sim);
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(link);
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
