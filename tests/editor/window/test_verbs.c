/* SPDX-License-Identifier: MIT
 *
 * test_verbs - which commands can work: all of them, with each kind of page in front, while
 * simulating, with a program before an edit, a board and a recording. A command that cannot is
 * insensitive, and there is a reason to tell.
 */
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/window/app.h"
#include "editor-gtk/window/window.h"
#include "tests/editor/sim_seen.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <gtksourceview/gtksource.h>
#include <string.h>

/* A state is a letter: n no page is open, u the file cannot be read, l a ladder, i an instruction
 * list, c a chart, s a ladder while simulating, f the program before an edit, o a ladder while a
 * board runs, whose user may do all, r a ladder while a recording of a board is shown. */
#define ALL "nulicsfor"
#define READ "nlicsfor"

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  A AT %IX0.0 : BOOL;\n  Q AT %QX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO A | COIL Q |\nEND_PROGRAM\n\n"
	"PROGRAM List IL\n  LD A\n  ST %QX0.1\nEND_PROGRAM\n\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Start:\n  END_STEP\n  STEP Run:\n  END_STEP\n"
	"  TRANSITION FROM Start TO Run := A; END_TRANSITION\n"
	"  TRANSITION FROM Run TO Start := NOT A; END_TRANSITION\nEND_PROGRAM\n";
static const char damaged[] = "RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NOO A | COIL Q |\n";

/* The states in which a command works that is not of a sheet, or not only of it. */
static const struct { enum verb verb; const char *states; } works[] = {
	{ VERB_close_tab, "ulicsfor" }, { VERB_next_sheet, "ulicsfor" },
	{ VERB_previous_sheet, "ulicsfor" }, { VERB_print, READ }, { VERB_print_preview, READ },
	{ VERB_export_pdf, READ }, { VERB_export_classic, READ }, { VERB_properties, READ },
	{ VERB_new_program, READ }, { VERB_new_list, READ }, { VERB_new_chart, READ }, { VERB_new_statements, READ },
	{ VERB_new_networks, READ },
	{ VERB_format, "i" }, { VERB_mend, "i" }, { VERB_fold, "i" }, { VERB_unfold, "i" }, { VERB_fold_all, "i" },
	{ VERB_unfold_all, "i" },
	{ VERB_new_block, READ }, { VERB_new_function, READ }, { VERB_new_subroutine, READ },
	{ VERB_import, READ }, { VERB_new_task, READ }, { VERB_new_type, READ },
	{ VERB_import_symbols, READ }, { VERB_export_symbols, READ },
	{ VERB_cut, "lcsor" }, { VERB_copy, "lcsfor" }, { VERB_copy_picture, "lsfor" },
	{ VERB_paste, "lcsor" }, { VERB_paste_parallel, "lsor" }, { VERB_delete, "lcsor" },
	{ VERB_select_all, "lcsfor" }, { VERB_context_menu, "lcsfor" }, { VERB_enter, "lcsor" },
	{ VERB_find_element, "lcsor" }, { VERB_cancel, "lsfor" }, { VERB_go_rung, "ulicsfor" },
	{ VERB_bookmark, "lsor" }, { VERB_sim_scan, "nulicsf" }, { VERB_sim_stop, "sfo" },
	{ VERB_sim_cold, "sf" }, { VERB_sim_warm, "sf" }, { VERB_sim_back, "sfor" },
	{ VERB_sim_forth, "sfor" }, { VERB_sim_now, "sfor" }, { VERB_set_value, "sfor" },
	{ VERB_stop_toggle, "" }, { VERB_stop_if, "" }, { VERB_stop_none, READ },
	{ VERB_stop_go, "sf" }, { VERB_stop_into, "sf" }, { VERB_stop_over, "sf" },
	{ VERB_stop_out, "sf" }, { VERB_stop_to, "" },
	{ VERB_force, "sfor" }, { VERB_run_board, READ }, { VERB_stop_board, "" },
	{ VERB_online_reconnect, "o" },
	{ VERB_online_disconnect, "o" }, { VERB_online_run, "" }, { VERB_online_stop, "o" },
	{ VERB_online_reset, "" }, { VERB_online_compare, "o" }, { VERB_online_download, "o" },
	{ VERB_online_upload, "o" }, { VERB_sim_recording, "nulicsfr" }, { VERB_sim_why, "sfor" },
	{ VERB_sim_plant, "nulicsf" }, { VERB_sim_no_plant, "nulicsf" }, { VERB_sim_release, "" },
	{ VERB_record, "nlicsf" }, { VERB_expect, "sfor" }, { VERB_run_scenarios, READ },
	{ VERB_convert_fbd, "licsor" }, { VERB_convert_ld, "licsor" }, { VERB_convert_il, "licsor" },
	{ VERB_convert_st, "licsor" }, { VERB_show_fbd, "licsor" }, { VERB_show_ld, "licsor" },
	{ VERB_show_il, "licsor" }, { VERB_show_st, "licsor" },
	{ VERB_address_map, READ }, { VERB_show_as, "lsfor" }, { VERB_fold_rungs, "lsfor" }, { VERB_zoom_in, "lcsfor" },
	{ VERB_zoom_out, "lcsfor" }, { VERB_zoom_reset, "lcsfor" }, { VERB_right, "sfor" },
};

static GtkWidget *window, *probes[VERB_COUNT];

static bool should_work(enum verb verb, char state)
{
	const enum verb_group group = verb_row(verb)->group;

	for (gsize i = 0; i < G_N_ELEMENTS(works); i++)
		if (works[i].verb == verb)
			return strchr(works[i].states, state);
	return strchr(group == VERBS_DRAW || group == VERBS_RUNG ? "lsor" :
		      group == VERBS_CHART ? "c" : group == VERBS_NETWORK ? "" : ALL, state);
}

/* Their sensitivity follows the actions. */
static void add_probes(void)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);

	for (int i = 0; i < VERB_COUNT; i++) {
		probes[i] = gtk_button_new();
		gtk_actionable_set_action_name(GTK_ACTIONABLE(probes[i]),
					       verb_row((enum verb)i)->action);
		gtk_box_append(GTK_BOX(box), probes[i]);
	}
	gtk_widget_set_visible(box, FALSE);
	gtk_widget_set_parent(box, gtk_widget_get_first_child(window));
}

/* All but undo and redo, which depend on the history alone. */
static void check_state(char state, const char *name)
{
	int wrong = 0;

	for (int i = 0; i < VERB_COUNT; i++) {
		const bool should = should_work((enum verb)i, state);

		if (i == VERB_undo || i == VERB_redo || gtk_widget_is_sensitive(probes[i]) == should)
			continue;
		printf("# %s: %s is %s\n", name, verb_row((enum verb)i)->action,
		       should ? "insensitive" : "sensitive");
		wrong++;
	}
	CHECK_AS(wrong == 0, name);
}

static void check_facts(char state, const char *name, unsigned with)
{
	int wrong = 0;

	for (int i = 0; i < VERB_COUNT; i++) {
		const char *why = verb_why_not((enum verb)i, with);

		if (i == VERB_undo || i == VERB_redo || !why == should_work((enum verb)i, state))
			continue;
		printf("# %s: %s: %s\n", name, verb_row((enum verb)i)->action, why ? why : "works");
		wrong++;
	}
	CHECK_AS(wrong == 0, name);
}

static void do_action(const char *action)
{
	gtk_widget_activate_action(window, action, NULL);
	turn(0);
}

static bool can(enum verb verb)
{
	return gtk_widget_is_sensitive(probes[verb]);
}

static void go(int pou)
{
	gtk_widget_activate_action(window, "win.go-to", "(iiii)", pou, 0, 0, 0);
	turn(0);
}

static void open_window(const char *text)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	ladder_document_check_now(document);
	window = GTK_WIDGET(ladder_window_new(NULL, document));
	g_object_unref(document);
	add_probes();
	ladder_window_opened(LADDER_WINDOW(window));
	screen_show(window);
}

static void close_window(void)
{
	GtkWidget *box = gtk_widget_get_parent(probes[0]);

	gtk_widget_unparent(box);
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
}

/* ---- the dialog of all commands ---- */

static GtkWidget *find_list(GtkWidget *in)
{
	GtkWidget *found = GTK_IS_LIST_BOX(in) && gtk_widget_has_css_class(in, "commands") ? in : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(in); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = find_list(child);
	return found;
}

static GtkWindow *commands_dialog(void)
{
	GListModel *all = gtk_window_get_toplevels();

	for (guint i = 0; i < g_list_model_get_n_items(all); i++) {
		GtkWindow *one = g_list_model_get_item(all, i);

		g_object_unref(one);
		if (gtk_window_get_transient_for(one) == GTK_WINDOW(window) &&
		    find_list(GTK_WIDGET(one)))
			return one;
	}
	return NULL;
}

/* Does each row of the open dialog say what the sensitivity of its command says? */
static bool rows_follow(void)
{
	GtkListBox *list = GTK_LIST_BOX(find_list(GTK_WIDGET(commands_dialog())));
	GtkListBoxRow *row;
	int i = 0, wrong = 0;

	for (; (row = gtk_list_box_get_row_at_index(list, i)); i++) {
		const int verb = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(row), "verb"));
		GtkWidget *label = gtk_widget_get_first_child(gtk_list_box_row_get_child(row));
		const bool dim = gtk_widget_has_css_class(label, "dim-label");

		if (dim != can((enum verb)verb))
			continue;
		printf("# %s: its row is %s\n", verb_row((enum verb)verb)->action,
		       dim ? "dim" : "not dim");
		wrong++;
	}
	return i > 100 && wrong == 0;
}

/* The keys of each command of the window are known to the application, those of sheets are not:
 * there a letter is typed. */
static void check_keys(void)
{
	GtkApplication *application = gtk_application_new("io.github.rungboard.test",
							  G_APPLICATION_NON_UNIQUE);
	int wrong = 0;

	CHECK(g_application_register(G_APPLICATION(application), NULL, NULL));
	for (int scheme = 0; scheme < KEY_SCHEMES; scheme++) {
		verbs_use_scheme(application, (enum key_scheme)scheme);
		for (int i = 0; i < VERB_COUNT; i++) {
			const bool given = verb_row((enum verb)i)->where == VERB_WINDOW;
			char **keys = g_strsplit(given ? verb_keys((enum verb)i) : "", "|", -1);
			char **got;

			for (char **key = keys; *key; key++) {
				GdkModifierType state;
				guint value;

				gtk_accelerator_parse(*key, &value, &state);
				g_free(*key);
				*key = gtk_accelerator_name(value, state);
			}
			got = gtk_application_get_accels_for_action(application,
				verb_row((enum verb)i)->action);

			if (!g_strv_equal((const char *const *)keys, (const char *const *)got)) {
				printf("# %s of scheme %d\n", verb_row((enum verb)i)->action, scheme);
				wrong++;
			}
			g_strfreev(keys);
			g_strfreev(got);
		}
	}
	CHECK_AS(wrong == 0, "each command of the window has its keys");
	verbs_use_scheme(application, SCHEME_RUNGBOARD);
	g_object_unref(application);
}

static void check_simulated(void)
{
	struct sim_edited edit;
	LadderSim *sim;
	guint64 last;

	sim_watch();
	do_action("win.sim_run");
	CHECK(sim = sim_seen);
	CHECK_SOON(ladder_sim_last(sim) > 5 && can(VERB_sim_cold));
	ladder_sim_pause(sim);
	CHECK_SOON(ladder_sim_state(sim) == SIM_PAUSE);
	check_state('s', "simulating");
	do_action("win.rung_duplicate");
	CHECK_AS(can(VERB_undo) && !can(VERB_redo), "an edit can be undone");
	ladder_document_check_now(ladder_window_document(LADDER_WINDOW(window)));
	CHECK_SOON(ladder_sim_next_edit(sim, 0, &edit)); /* the changed program runs */
	last = ladder_sim_last(sim);
	ladder_sim_scan(sim, 5);
	CHECK_SOON(ladder_sim_twin(sim)->scan == last + 5); /* and is shown */
	CHECK(ladder_sim_show(sim, 2));
	CHECK_SOON(!can(VERB_contact));
	check_state('f', "the program before an edit");
	ladder_sim_show_now(sim);
	CHECK_SOON(can(VERB_contact));
	do_action("win.undo");
	CHECK(!can(VERB_undo) && can(VERB_redo));
	do_action("win.palette");
	CHECK_AS(rows_follow(), "the rows of the commands while simulating");
	ladder_sim_end(sim);
	CHECK_SOON(!can(VERB_sim_cold));
	CHECK_AS(rows_follow(), "the rows follow when the simulation ends");
	CHECK(ladder_sim_begin(sim, NULL));
	CHECK_SOON(can(VERB_sim_cold));
	CHECK_AS(rows_follow(), "and when it begins");
	ladder_sim_end(sim);
	CHECK_SOON(!can(VERB_sim_cold));
	gtk_window_destroy(commands_dialog());
	check_state('l', "after the simulation");
}

static bool has_panels(GtkWidget *in)
{
	bool has = gtk_widget_has_css_class(in, "below-tabs") && gtk_widget_get_visible(in);

	for (GtkWidget *child = gtk_widget_get_first_child(in); child && !has;
	     child = gtk_widget_get_next_sibling(child))
		has = gtk_widget_get_visible(child) && has_panels(child);
	return has;
}

/* The welcome page has no list of problems, until somebody asks for a panel. */
static void check_welcome(void)
{
	CHECK(has_panels(window));
	do_action("win.welcome");
	CHECK(!has_panels(window));
	go(0);
	CHECK(has_panels(window));
	do_action("win.welcome");
	do_action("win.below");
	CHECK_AS(has_panels(window), "they are shown when they are asked for");
	go(0);
	CHECK(has_panels(window));
	do_action("win.below");
	do_action("win.welcome");
	go(0);
	CHECK_AS(!has_panels(window), "panels that a person has hidden stay hidden");
	do_action("win.below");
}

static void check_pages(void)
{
	open_window(sample);
	go(1);
	check_state('i', "an instruction list");
	go(2);
	check_state('c', "a chart");
	go(0);
	check_state('l', "a ladder");
	check_welcome();
	check_simulated();
	while (can(VERB_close_tab))
		do_action("win.close_tab");
	check_state('n', "no page");
	close_window();
	open_window(damaged);
	check_state('u', "a file that cannot be read");
	close_window();
}

int main(void)
{
	const unsigned ladder = WITH_PROJECT | WITH_PAGE | WITH_POU | WITH_CANVAS | WITH_RUNGS | WITH_PARTS | WITH_FREE |
				WITH_ENTRY | WITH_LINES | WITH_ZOOM;

	check_facts('o', "a board runs", ladder | WITH_SIM | WITH_STOP | WITH_LINK | WITH_ANSWER | WITH_MAY_STOP |
		    WITH_MAY_DOWNLOAD | WITH_MAY_UPLOAD);
	check_facts('r', "a recording", ladder | WITH_SIM | WITH_OFFLINE);
	if (!screen_start() || !gtk_init_check()) {
		tap_skip("the window needs Xvfb");
		return tap_done();
	}
	adw_init();
	gtk_source_init();
	app_style();
	check_keys();
	check_pages();
	return tap_done();
}
