/* SPDX-License-Identifier: MIT
 *
 * test_sim_panel - the simulation panel in a window: its lines, their values, clicks, keys
 * and menu.
 *
 * SIM_PICTURES=FOLDER saves pictures of it.
 */
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/window/app.h"
#include "tests/editor/panel_shown.h"
#include "tests/editor/keys.h"
#include "tests/editor/saved.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <glib/gstdio.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL; (* the green button *)\n"
	"  Stop AT %IX0.1 : BOOL;\n"
	"  Overload_of_the_second_motor_behind_the_wall AT %IX0.2 : BOOL;\n"
	"  \xe7\x94\xb5\xe6\x9c\xba AT %QX0.0 : BOOL; (* \xe4\xb8\xbb\xe7\x94\xb5\xe6\x9c\xba *)\n"
	"  Alarm AT %MX0.0 : BOOL;\n  Level AT %AIW0 : INT;\n  Speed AT %AQW2 : INT;\n"
	"  Wait : TIME := T#5s;\n  Count : INT;\n  Temp : REAL := 20.5;\n"
	"  Name : STRING := 'Pump';\n  Parts : CTU;\n"
	"END_VAR\n\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\n  Fixed : TON;\nEND_VAR\n"
	"RUNG \"Start\"\n"
	"  | NO Start | NC Stop | NC Overload_of_the_second_motor_behind_the_wall | COIL \xe7\x94\xb5\xe6\x9c\xba |\n"
	"  | NO \xe7\x94\xb5\xe6\x9c\xba ^ |\n"
	"RUNG\n  | NO \xe7\x94\xb5\xe6\x9c\xba | TON Delay PT:=Wait | COIL %QX0.3 |\n"
	"RUNG\n  | NO \xe7\x94\xb5\xe6\x9c\xba | TON Fixed PT:=T#100ms | COIL %QX0.4 |\n"
	"RUNG\n  | NO Start | CTU Parts PV:=4 CV=>Count | COIL Alarm |\n"
	"RUNG\n  | NO Start | MOVE IN:=Level OUT=>Speed |\n"
	"RUNG\n  | NO %IX1.3 | COIL %MX2.5 |\n"
	"END_PROGRAM\n";

static GtkWidget *window;
static LadderDocument *document;
static LadderSim *sim;
static LadderSimPanel *panel;

/* ---- pictures ---- */

/* ---- the panel ---- */

static LadderSimRow *row_of(const char *name)
{
	GListModel *list = panel_list(panel);

	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		LadderSimRow *row = g_list_model_get_item(list, i);

		g_object_unref(row);
		if (row->kind != SIM_HEADING && strcmp(row->name, name) == 0)
			return row;
	}
	return NULL;
}

static bool shows(const char *name, const char *want)
{
	LadderSimRow *row = row_of(name);
	char *text = row ? panel_shown(panel, row) : NULL;
	const bool is = g_strcmp0(text, want) == 0;

	g_free(text);
	return is;
}

/* All lines: "[Inputs] Start Stop [Outputs] …", with a map "[Inputs gpiochip1] Start …". */
static char *lines(void)
{
	GListModel *list = panel_list(panel);
	GString *out = g_string_new(NULL);

	for (guint i = 0; i < g_list_model_get_n_items(list); i++) {
		LadderSimRow *row = g_list_model_get_item(list, i);

		if (row->kind == SIM_HEADING)
			g_string_append_printf(out, "[%s%s%s] ", sim_group_name(row->group),
					       row->place ? " " : "",
					       row->place ? row->place : "");
		else
			g_string_append_printf(out, "%s ", row->name);
		g_object_unref(row);
	}
	return g_string_free(out, FALSE);
}

static void test_lines(void)
{
	char *all = lines();

	CHECK_TEXT(all, "[Inputs] Start Stop Overload_of_the_second_motor_behind_the_wall "
		   "%IX1.3 [Outputs] \xe7\x94\xb5\xe6\x9c\xba %QX0.3 %QX0.4 "
		   "[Memory] Alarm %MX2.5 [Timers] Delay Fixed [Counters] Parts "
		   "[Analogue] Level Speed [Values] Wait Count Temp Name ");
	g_free(all);
	CHECK_TEXT(row_of("Start")->comment, "the green button");
	CHECK_TEXT(row_of("Start")->address, "%IX0.0");
	CHECK(row_of("Delay")->given.type == IEC_TIME &&
	      row_of("Delay")->given.where == row_of("Wait")->at.where);
	CHECK(row_of("Fixed")->given.type == IEC_NONE);
	CHECK(row_of("Fixed")->start.type == IEC_TIME);
}

static void test_values(void)
{
	CHECK(shows("Start", "0") && shows("Temp", "20.5") && shows("Name", "'Pump'"));
	sim_row_press(row_of("Start"), sim);
	CHECK_SOON(shows("Start", "1"));
	CHECK_AS(shows("\xe7\x94\xb5\xe6\x9c\xba", "0"),
		 "an output does not change before a scan");
	ladder_sim_scan(sim, 1);
	CHECK_SOON(shows("\xe7\x94\xb5\xe6\x9c\xba", "1"));
	ladder_sim_scan(sim, 3);
	CHECK_SOON(shows("Delay", "0.0 s / 5 s"));
	CHECK_SOON(shows("Fixed", "30 ms / 100 ms"));
	CHECK(shows("Parts", "1 / 4"));
}

/* ---- what is done ---- */

static GtkWidget *find_widget(GtkWidget *from, GType type)
{
	if (G_TYPE_CHECK_INSTANCE_TYPE(from, type) && gtk_widget_get_mapped(from))
		return from;
	for (GtkWidget *child = gtk_widget_get_first_child(from); child;
	     child = gtk_widget_get_next_sibling(child)) {
		GtkWidget *found = find_widget(child, type);

		if (found)
			return found;
	}
	return NULL;
}

static void act_on(const char *name, const char *action)
{
	CHECK_AS(ladder_sim_panel_select(panel, name), name);
	CHECK_AS(gtk_widget_activate_action(GTK_WIDGET(panel), action, NULL), action);
	turn(20);
}

/* Types into the field of a line. */
static void type(const char *name, const char *action, const char *text)
{
	GtkWidget *entry;

	act_on(name, action);
	WAIT((entry = find_widget(GTK_WIDGET(panel), GTK_TYPE_ENTRY)) != NULL);
	CHECK_AS(entry, "the line has a field for its value");
	if (!entry)
		return;
	gtk_editable_set_text(GTK_EDITABLE(entry), text);
	g_signal_emit_by_name(entry, "activate");
}

static bool is_forced(const char *name)
{
	return sim_row_is_forced(row_of(name), sim);
}

static void test_force(void)
{
	act_on("Stop", "sim-panel.force-on");
	CHECK_SOON(shows("Stop", "1") && is_forced("Stop"));
	sim_row_press(row_of("Stop"), sim);
	CHECK_SOON(shows("Stop", "0"));
	CHECK_AS(is_forced("Stop"), "a click changes the forced value");
	act_on("Stop", "sim-panel.force");
	CHECK_SOON(!is_forced("Stop"));
	act_on("Temp", "sim-panel.force");
	CHECK_SOON(is_forced("Temp") && ladder_sim_forces(sim) == 1);
	act_on("Name", "sim-panel.force");
	act_on("Start", "sim-panel.force-off");
	CHECK_SOON(shows("Start", "0"));
	CHECK_AS(ladder_sim_forces(sim) == 2, "a STRING cannot be forced");
	save_pictures(window, "SIM_PICTURES", "forced");
	act_on("Start", "sim-panel.release-all");
	CHECK_SOON(ladder_sim_forces(sim) == 0);
	CHECK_SOON(shows("Start", "1"));
}

static void test_typed(void)
{
	type("Temp", "sim-panel.edit-value", "-3.5");
	CHECK_SOON(shows("Temp", "-3.5"));
	type("Name", "sim-panel.edit-value", "Fan 2");
	CHECK_SOON(shows("Name", "'Fan 2'"));
	type("Level", "sim-panel.edit-value", "120");
	CHECK_SOON(shows("Level", "120"));
	type("Delay", "sim-panel.edit-preset", "1m2.5s");
	CHECK_SOON(shows("Wait", "1:02 min"));
	type("Parts", "sim-panel.edit-value", "3");
	CHECK_SOON(shows("Parts", "3 / 4"));
	type("Fixed", "sim-panel.edit-value", "60ms");
	CHECK_SOON(shows("Fixed", "60 ms / 100 ms"));
	ladder_sim_scan(sim, 1);
	CHECK_SOON(shows("Fixed", "70 ms / 100 ms"));
	CHECK_SOON(shows("Delay", "0:00 / 1:02.5 min"));
	CHECK(shows("Speed", "120"));
	type("Count", "sim-panel.edit-value", "40000");
	CHECK_AS(gtk_widget_has_css_class(find_widget(GTK_WIDGET(panel), GTK_TYPE_ENTRY),
					  "error"), "a value too large for INT is refused");
	ladder_sim_panel_select(panel, "Start");
	gtk_widget_grab_focus(GTK_WIDGET(panel));
	gtk_window_set_focus(GTK_WINDOW(window), NULL);
	CHECK_SOON(!find_widget(GTK_WIDGET(panel), GTK_TYPE_ENTRY));
}

static bool has(const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool found = strstr(text, part);

	if (!found)
		printf("# %s\n", strstr(text, "VIEW"));
	g_free(text);
	return found;
}

static void test_choices(void)
{
	LadderSimRow *start;

	sim_row_press(row_of("Start"), sim);
	CHECK_SOON(shows("Start", "0"));
	act_on("Start", "sim-panel.push");
	CHECK(has("VIEW\n  panel Start push\nEND_VIEW"));
	start = row_of("Start");
	CHECK(start->push);
	sim_row_press(start, sim);
	CHECK_SOON(shows("Start", "1"));
	sim_row_unpress(start, sim);
	CHECK_SOON(shows("Start", "0"));
	ladder_document_undo(document);
	CHECK(!row_of("Start")->push && !strstr(ladder_document_view(document), "panel"));
	ladder_document_redo(document);
	CHECK(row_of("Start")->push);
	ladder_document_begin(document, "x", NULL);
	ladder_document_set_view(document, "VIEW\n  bookmark Main 2\n  panel stop toggle F6 push\n"
				 "  panel Level range -10 50.5\n  panel Nobody push\n"
				 "  panel %IX1.3 hold x range 5\n  panel Alarm hold nokey\n"
				 "  panel\n  panel Speed range 3 3\nEND_VIEW");
	ladder_document_end(document);
	CHECK(row_of("Stop")->push && row_of("Stop")->key_toggles);
	CHECK_TEXT(row_of("Stop")->key, "F6");
	CHECK_TEXT(row_of("%IX1.3")->key, "x");
	CHECK(!row_of("Alarm")->key && !row_of("Start")->push && !row_of("Speed")->ranged);
	CHECK(row_of("Level")->low == -10 && row_of("Level")->high == 50.5);
	CHECK(row_of("Speed")->low == -32768 && row_of("Speed")->high == 32767);
	save_pictures(window, "SIM_PICTURES", "chosen");
	act_on("Stop", "sim-panel.no-key");
	act_on("Level", "sim-panel.no-range");
	CHECK(has("  bookmark Main 2\n  panel Stop push\n  panel Nobody push\n"));
	CHECK(!row_of("Stop")->key && !row_of("Level")->ranged);
}

static void test_found(void)
{
	GtkWidget *search = find_widget(GTK_WIDGET(panel), GTK_TYPE_SEARCH_ENTRY);
	char *all;

	CHECK(ladder_sim_panel_select(panel, "Start"));
	CHECK(gtk_widget_grab_focus(find_widget(GTK_WIDGET(panel), GTK_TYPE_LIST_VIEW)));
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "8 ");
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "0 ");
	CHECK_AS(keys_arrive(window), "a key right after an edit is not lost");
	all = lines();
	CHECK(g_str_has_prefix(all, "[Inputs] [Outputs] ") && g_str_has_suffix(all, "[Values] "));
	g_free(all);
	gtk_editable_set_text(GTK_EDITABLE(search), "GREEN");
	WAIT(row_of("Start") && !row_of("Alarm"));
	all = lines();
	CHECK_TEXT(all, "[Inputs] Start ");
	g_free(all);
	gtk_editable_set_text(GTK_EDITABLE(search), "no symbol has this name");
	CHECK_SOON(g_list_model_get_n_items(panel_list(panel)) == 0);
	save_pictures(window, "SIM_PICTURES", "none");
	gtk_editable_set_text(GTK_EDITABLE(search), "");
	CHECK_SOON(row_of("Alarm"));
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "0 ");
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "8 ");
	CHECK(row_of("Start") && row_of("Temp"));
}

/* An edit that builds replaces the program; values stay. */
static void test_edit(void)
{
	LadderSimRow *alarm = row_of("Alarm");
	struct diag_list *why = g_new0(struct diag_list, 1);

	sim_row_press(alarm, sim);
	CHECK_SOON(shows("Alarm", "1"));
	CHECK(ladder_document_declare(document, -1, "Extra", "INT", "%MW10", why));
	ladder_document_check_now(document);
	CHECK_SOON(row_of("Extra"));
	CHECK_SOON(shows("Extra", "0") && shows("Alarm", "1"));
	g_free(why);
}

/* The plant of the tank gives level and float, and has a level of its own. */
static void test_plant(void)
{
	char *text, *all;
	gsize len;

	ladder_sim_end(sim);
	CHECK(g_file_get_contents("ladders/tank-level.rung", &text, &len, NULL));
	ladder_document_open_text(document, "ladders/tank-level.rung", text, len, true);
	CHECK(ladder_sim_set_plant(sim, "ladders/tank-level.plant.rung", NULL));
	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_reset(sim, false);
	CHECK_SOON(row_of("Raw") && row_of("OverfillOk"));
	CHECK(row_of("Raw")->driven && row_of("OverfillOk")->driven);
	CHECK(!row_of("Auto")->driven && !row_of("PumpOk")->driven);
	all = lines();
	CHECK_AS(strstr(all, "[Plant] Level "), all);
	g_free(all);
	ladder_sim_scan(sim, 2);
	CHECK_SOON(shows("Raw", "14080") && shows("OverfillOk", "1"));
	sim_row_press(row_of("OverfillOk"), sim);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(ladder_sim_twin(sim)->scan == 3);
	CHECK_AS(shows("OverfillOk", "1"), "the plant sets its input again after a click");
	act_on("OverfillOk", "sim-panel.force-off");
	CHECK_SOON(shows("OverfillOk", "0"));
	save_pictures(window, "SIM_PICTURES", "plant");
	g_free(text);
}

/* The time to update a thousand lines that all change in each scan. */
static void test_many(void)
{
	GString *text = g_string_new("RUNGBOARD 1\nVAR\n");
	gint64 from, took = G_MAXINT64;

	for (int i = 0; i < 1000; i++)
		g_string_append_printf(text, "  N%d : INT;\n", i);
	g_string_append(text, "END_VAR\nPROGRAM Main LD\n");
	for (int i = 0; i < 1000; i++)
		g_string_append_printf(text, "RUNG\n  | [ N%d := N%d + 1 ] |\n", i, i);
	g_string_append(text, "END_PROGRAM\n");
	ladder_sim_end(sim);
	ladder_sim_set_plant(sim, NULL, NULL);
	ladder_document_open_text(document, "/tmp/x/many.rung", text->str, text->len, true);
	from = g_get_monotonic_time();
	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_reset(sim, false);
	CHECK_SOON(row_of("N999"));
	printf("# begun in %d ms\n", (int)(g_get_monotonic_time() - from) / 1000);
	for (int i = 1; i <= 20; i++) {
		g_signal_handlers_block_matched(sim, G_SIGNAL_MATCH_DATA, 0, 0, NULL, NULL,
						panel);
		ladder_sim_scan(sim, 1);
		WAIT(ladder_sim_twin(sim)->scan == (guint64)i);
		g_signal_handlers_unblock_matched(sim, G_SIGNAL_MATCH_DATA, 0, 0, NULL, NULL,
						  panel);
		from = g_get_monotonic_time();
		g_signal_emit_by_name(sim, "shown");
		took = MIN(took, g_get_monotonic_time() - from);
	}
	CHECK(shows("N5", "20"));
	printf("# a look: %d us\n", (int)took);
	CHECK_AS(took < 20000, "an update of 1,000 lines takes less than a frame");
	g_string_free(text, TRUE);
}

/* Inputs and outputs are grouped by the chips of the I/O map, in its order, each with its
 * pin. */
static void test_map(void)
{
	static const char map[] = "BOARD \"Oven\"\n%IX0.1  gpio  chip=relays offset=7  # left\n"
		"%IX0.0  gpio  line=GPIO17\n%QX0.3 gpio line=GPIO4\n%IX0.2 sim\nwrong line\n"
		"%QX0.0 gpio chip=relays offset=3\n";
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL), *all;
	char *path = g_build_filename(folder, "test.rung", NULL);
	char *io = g_build_filename(folder, "test.io", NULL);

	ladder_sim_end(sim);
	CHECK(g_file_set_contents(io, map, -1, NULL));
	ladder_document_open_text(document, path, sample, strlen(sample), true);
	CHECK(ladder_sim_begin(sim, NULL));
	all = lines();
	CHECK(g_str_has_prefix(all, "[Inputs relays] Stop [Inputs Oven] Start [Inputs sim] "
		"Overload_of_the_second_motor_behind_the_wall [Inputs not in the I/O map] "
		"%IX1.3 [Outputs relays] \xe7\x94\xb5\xe6\x9c\xba [Outputs Oven] %QX0.3 "
		"[Outputs not in the I/O map] %QX0.4 [Memory] Alarm "));
	g_free(all);
	CHECK_TEXT(row_of("Stop")->pin, "7");
	CHECK_TEXT(row_of("Stop")->pin_told, "relays  7  (left)");
	CHECK_TEXT(row_of("Start")->pin, "GPIO17");
	CHECK(!row_of("%IX1.3")->pin && !row_of("Alarm")->place);
	save_pictures(window, "SIM_PICTURES", "map");
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "0 Oven");
	CHECK(!row_of("Start") && row_of("Stop"));
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "0 Oven");
	CHECK(row_of("Start"));
	CHECK(g_unlink(io) == 0 && g_rmdir(folder) == 0);
	ladder_sim_end(sim);
	CHECK(ladder_sim_begin(sim, NULL) && !row_of("Start")->place);
	g_free(io);
	g_free(path);
	g_free(folder);
}

static void test_end(void)
{
	ladder_sim_end(sim);
	CHECK_SOON(g_list_model_get_n_items(panel_list(panel)) == 0);
}

static const char wholes[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Line : Belt;\n  Table : ARRAY[1..3] OF INT;\n  Free : BOOL;\n"
	"END_VAR\n\n"
	"FUNCTION_BLOCK Belt LD\nVAR_INPUT\n  Run : BOOL; (* from the door *)\nEND_VAR\n"
	"VAR_OUTPUT\n  Motor : BOOL;\nEND_VAR\nVAR\n  Soft : TON;\nEND_VAR\n"
	"RUNG\n  | NO Run | TON Soft PT:=T#1s | COIL Motor |\nEND_FUNCTION_BLOCK\n\n"
	"PROGRAM Main SFC\n  INITIAL_STEP Start:\n    Q0.0(N);\n  END_STEP\n"
	"  STEP Fill:\n    Q0.1(N);\n  END_STEP\n"
	"  TRANSITION FROM Start TO Fill := I0.0;\n  END_TRANSITION\n"
	"  TRANSITION FROM Fill TO Start := I0.1;\n  END_TRANSITION\n"
	"END_PROGRAM\n\n"
	"PROGRAM Other LD\nVAR\n  Latch : SR;\n  Wait : TON;\nEND_VAR\n"
	"RUNG\n  | NO I0.0 | Belt Line | COIL Q0.2 |\n"
	"RUNG\n  | NO I0.0 | SR Latch R:=I0.1 | COIL Free |\n"
	"RUNG\n  | NO Free | TON Wait PT:=T#2s | COIL Q0.3 |\nEND_PROGRAM\n";

static bool lists(const char *expected)
{
	char *all = lines();
	const bool is = strcmp(all, expected) == 0;

	if (!is)
		printf("# %s\n", all);
	g_free(all);
	return is;
}

static void search(const char *text)
{
	gtk_editable_set_text(GTK_EDITABLE(find_widget(GTK_WIDGET(panel),
						       GTK_TYPE_SEARCH_ENTRY)), text);
}

/* A structure is a variable, as an array is, of the program or of all; so is one in an array. An
 * array of instances is a block. */
static void test_structures(void)
{
	static const char text[] =
		"RUNGBOARD 1\n\nTYPE\n  Bounds : STRUCT\n    Low : INT;\n    High : INT;\n"
		"  END_STRUCT;\nEND_TYPE\n\nVAR\n  Limit : Bounds;\n  Limits : ARRAY[1..2] OF Bounds;\n"
		"  Two : ARRAY[1..2] OF Belt;\n  Own : Belt;\nEND_VAR\n\n"
		"FUNCTION_BLOCK Belt LD\nVAR_INPUT\n  Run : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Motor : BOOL;\n"
		"END_VAR\nRUNG\n  | NO Run | COIL Motor |\nEND_FUNCTION_BLOCK\n\n"
		"PROGRAM Main LD\nVAR\n  Mine : Bounds;\n  My : Belt;\nEND_VAR\n"
		"RUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n";

	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(lists("[Inputs] %IX0.0 [Outputs] %QX0.0 [Blocks] Two Own My "
		    "[Values] Limit Limits Mine "));
}

#define IN_OUT "[Inputs] %IX0.0 %IX0.1 [Outputs] %QX0.0 %QX0.1 %QX0.2 %QX0.3 [Memory] Free "

/* An instance, a chart, an array is one line; it unfolds to its parts, which a search finds. */
static void test_wholes(void)
{
	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, wholes, strlen(wholes), true);
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK(lists(IN_OUT "[Timers] Wait [Blocks] Line Latch [Charts] Main "
			    "[Values] Table "));
	ladder_sim_scan(sim, 2);
	CHECK_SOON(shows("Main", "Start"));
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "Main");
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "Line");
	CHECK(lists(IN_OUT "[Timers] Wait [Blocks] Line Line.Run Line.Motor Line.Soft "
			    "Latch [Charts] Main Main.Start Main.Fill [Values] Table "));
	CHECK(shows("Main.Start", "10 ms"));
	/* what is unfolded stays so when another program runs */
	ladder_document_open_text(document, NULL, wholes, strlen(wholes) - 1, true);
	CHECK_SOON(row_of("Line.Soft") && row_of("Main.Fill"));
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "Main");
	gtk_widget_activate_action(GTK_WIDGET(panel), "sim-panel.fold", "s", "Line");
	CHECK(!row_of("Line.Soft") && !row_of("Main.Fill"));
	search("fill");
	WAIT(!row_of("Free"));
	CHECK(lists("[Charts] Main Main.Fill "));
	search("from the door");
	WAIT(!row_of("Main"));
	CHECK(lists("[Blocks] Line Line.Run "));
	search("wait.pt");
	WAIT(!row_of("Line"));
	CHECK(lists("[Timers] Wait Wait.PT "));
	search("");
	WAIT(row_of("Free"));
	CHECK(ladder_sim_panel_select(panel, "Table[2]") && row_of("Table[3]"));
}

/* What is in sight below the search: "list", "none", "empty". */
static const char *page(void)
{
	GtkWidget *box = gtk_widget_get_parent(find_widget(GTK_WIDGET(panel),
							   GTK_TYPE_SEARCH_ENTRY));

	return gtk_stack_get_visible_child_name(GTK_STACK(gtk_widget_get_last_child(box)));
}

/* ---- names ---- */

#define LETTERS 24

/* The least width of the panel in a window of 1024 px. */
#define PANEL_WIDTH 280

/* A name of so many letters that differs from all others. */
static char *name_of(int kind, int letters)
{
	GString *name = g_string_new(NULL);

	g_string_append_printf(name, "%c%c", 'A' + kind, 'a' + letters);
	while ((int)name->len < letters)
		g_string_append_c(name, "OpenDoorButton"[name->len % 14]);
	g_string_truncate(name, (gsize)letters);
	return g_string_free(name, FALSE);
}

static const char *const kinds[] = {
	"", "", ": BOOL", ": DINT := 2000000000", ": TIME := T#23h59m",
	": STRING := 'a text that alone is wider than the panel is'", ": TON", ": CTU",
};

static void open_names(void)
{
	GString *text = g_string_new("RUNGBOARD 1\nVAR\n"), *rungs = g_string_new(NULL);

	for (int letters = 3; letters <= LETTERS; letters++)
		for (guint kind = 0; kind < G_N_ELEMENTS(kinds); kind++) {
			char *name = name_of((int)kind, letters);

			g_string_append_printf(text, "  %s ", name);
			if (kind < 2) /* an input, an output */
				g_string_append_printf(text, "AT %%%cX%d.%d : BOOL", "IQ"[kind], letters / 8,
						       letters % 8);
			else
				g_string_append(text, kinds[kind]);
			g_string_append(text, ";\n");
			if (kind >= 6)
				g_string_append_printf(rungs, kind == 6 ? "RUNG\n  | %s %s PT:=T#12h30m |\n" :
						       "RUNG\n  | %s %s PV:=20000 |\n", kinds[kind] + 2, name);
			g_free(name);
		}
	g_string_append_printf(text, "END_VAR\nPROGRAM Main LD\n%sEND_PROGRAM\n", rungs->str);
	ladder_sim_end(sim);
	ladder_document_open_text(document, "/tmp/x/names.rung", text->str, text->len, true);
	CHECK(ladder_sim_begin(sim, NULL));
	g_string_free(rungs, TRUE);
	g_string_free(text, TRUE);
}

/* Of the lines that have a widget: how many there are, how many of their names are cut. */
static void count_names(GtkWidget *widget, int *all, int *cut, int *low)
{
	GtkWidget *name = LADDER_IS_SIM_ROW_VIEW(widget) ? panel_find(widget, panel_has_class, "sim-name") : NULL;

	if (name && gtk_widget_get_mapped(name)) {
		++*all;
		*low += gtk_widget_get_height(widget) < 32;
		if (pango_layout_is_ellipsized(gtk_label_get_layout(GTK_LABEL(name))) && ++*cut < 4)
			printf("# %d px: %s\n", gtk_widget_get_width(GTK_WIDGET(panel)),
			       gtk_label_get_text(GTK_LABEL(name)));
		return;
	}
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child; child = gtk_widget_get_next_sibling(child))
		count_names(child, all, cut, low);
}

static void check_names(int width, const char *what)
{
	int all = 0, cut = 0, low = 0;

	gtk_window_set_default_size(GTK_WINDOW(window), width, 860);
	CHECK_SOON(gtk_widget_get_width(GTK_WIDGET(panel)) == width);
	turn(60);
	count_names(GTK_WIDGET(panel), &all, &cut, &low);
	CHECK_AS(all > 20 && cut == 0, what);
	CHECK_AS(low > all / 4, "a line whose parts have room is a low one");
}

/* Names of up to 24 letters are read whole beside any value, with and without a mark of force. */
static void test_names(void)
{
	open_names();
	for (int width = PANEL_WIDTH; width <= 520; width += 40) {
		check_names(width, "no name is cut");
		for (int letters = 3; letters <= LETTERS && width == PANEL_WIDTH; letters++)
			for (int kind = 0; kind < 3; kind++) {
				char *name = name_of(kind, letters);

				live_value_force(sim, false, row_of(name)->at, (union iec_value){ .i = 1 });
				g_free(name);
			}
	}
	save_pictures(window, "SIM_PICTURES", "names");
	ladder_sim_release_all(sim);
	gtk_window_set_default_size(GTK_WINDOW(window), 290, 860);
	CHECK_SOON(gtk_widget_get_width(GTK_WIDGET(panel)) == 290);
}

static void test_empty(void)
{
	static const char text[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | |\nEND_PROGRAM\n";

	CHECK_TEXT(page(), "list");
	search("nobody");
	CHECK_SOON(strcmp(page(), "none") == 0);
	search("");
	CHECK_SOON(strcmp(page(), "list") == 0);
	ladder_sim_end(sim);
	ladder_document_open_text(document, NULL, text, strlen(text), true);
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK_TEXT(page(), "empty");
	save_pictures(window, "SIM_PICTURES", "empty");
}

int main(int argc, char **argv)
{
	if (!screen_start()) {
		printf("1..0 # SKIP no Xvfb\n");
		return 0;
	}
	(void)argc;
	(void)argv;
	adw_init();
	app_style();
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/test.rung", sample, strlen(sample), true);
	sim = ladder_sim_new(document);
	panel = LADDER_SIM_PANEL(ladder_sim_panel_new(sim));
	window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(window), 290, 860);
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(panel));
	screen_show(window);
	save_pictures(window, "SIM_PICTURES", "off");
	GError *error = NULL;

	CHECK(ladder_sim_begin(sim, &error));
	if (error)
		printf("# %s\n", error->message);
	test_lines();
	ladder_sim_reset(sim, false);
	test_values();
	save_pictures(window, "SIM_PICTURES", "on");
	test_force();
	test_typed();
	test_choices();
	test_found();
	test_edit();
	test_plant();
	test_many();
	test_map();
	test_structures();
	test_wholes();
	test_names();
	test_empty();
	test_end();
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
