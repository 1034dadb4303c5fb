/* SPDX-License-Identifier: MIT
 *
 * test_live - a sheet while simulating: it shows the values of the program, redraws only
 * what changed, and its acts reach the program.
 */
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/text/text_view.h"
#include "tests/editor/nodes.h"
#include "tests/editor/screen.h"
#include "tests/editor/strips.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n"
	"VAR\n"
	"  Start AT %IX0.0 : BOOL;\n"
	"  Stop AT %IX0.1 : BOOL;\n"
	"  Motor AT %QX0.0 : BOOL;\n"
	"  Fan AT %QX0.1 : BOOL;\n"
	"  Level : INT;\n"
	"  High : BOOL;\n"
	"END_VAR\n"
	"FUNCTION_BLOCK Latch LD\n"
	"VAR_INPUT\n  On : BOOL;\nEND_VAR\n"
	"VAR_OUTPUT\n  Out : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO On | COIL Out |\n"
	"END_FUNCTION_BLOCK\n"
	"PROGRAM Main LD\n"
	"VAR\n  Run : TON;\n  First : Latch;\n  Second : Latch;\nEND_VAR\n"
	"RUNG \"Motor\"\n"
	"  | NO Start | NC Stop | COIL Motor |\n"
	"  | NO Motor ^|\n"
	"RUNG \"Fan\"\n  | NO Motor | TON Run PT:=T#5s | COIL Fan |\n"
	"RUNG \"Level\"\n  | [ Level > 500 ] | COIL High |\n"
	"RUNG \"One\"\n  | NO Start | Latch First |\n"
	"RUNG \"Other\"\n  | NO Stop | Latch Second |\n"
	"RUNG \"Alarm\"\n  | NO High | COIL %QX0.2 |\n"
	"END_PROGRAM\n"
	"PROGRAM List IL\nVAR\n  Count : INT;\nEND_VAR\n"
	"  LD Count (* Level *)\n  ADD 1\n  ST Count\n"
	"  LD Start\n  ANDN Motor\nEND_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;
static LadderGridView *view, *body;
static GtkWidget *window, *stack;
static StripsSeen *seen; /* drawings of the rungs of view */

/* ---- waiting ---- */

static void settle(void)
{
	while (g_main_context_iteration(NULL, FALSE))
		;
}

static bool until(bool (*come)(void))
{
	const gint64 end = g_get_monotonic_time() + 30 * G_USEC_PER_SEC;
	bool has;

	while (!(has = come()) && g_get_monotonic_time() < end)
		if (!g_main_context_iteration(NULL, FALSE))
			g_usleep(1000);
	return has;
}

static guint64 scans_wanted;

static bool has_scanned(void)
{
	return ladder_sim_twin(sim)->scan >= scans_wanted;
}

static void scan(int count)
{
	scans_wanted = ladder_sim_twin(sim)->scan + (guint64)count;
	ladder_sim_scan(sim, count);
	CHECK(until(has_scanned));
}

static GdkFrameClock *frames;
static int drawn_frames;

static void count_frame(void)
{
	drawn_frames++;
}

/* Everything is drawn, also what was queued during the last frame. */
static bool is_drawn(void)
{
	settle();
	return drawn_frames > 1 && widget_is_drawn(window);
}

static void draw(void)
{
	settle();
	drawn_frames = 0;
	gdk_frame_clock_begin_updating(frames);
	CHECK(until(is_drawn));
	gdk_frame_clock_end_updating(frames);
}

/* ---- values ---- */

static struct location find(const char *name)
{
	return image_find(&ladder_sim_twin(sim)->resource.image, name, strlen(name));
}

static gint64 value_of(const char *name)
{
	return image_get(&ladder_sim_twin(sim)->resource.image, find(name)).i;
}

static const char *wanted_name;
static gint64 wanted_value;

static bool has_value(void)
{
	return value_of(wanted_name) == wanted_value;
}

static bool comes(const char *name, gint64 value)
{
	wanted_name = name;
	wanted_value = value;
	return until(has_value);
}

static void set(const char *name, gint64 value)
{
	const struct act act = { .kind = ACT_SET, .at = find(name), .value.i = value };

	ladder_sim_act(sim, &act);
	CHECK(comes(name, value));
}

static unsigned int bits_of(LadderGridView *of, int rung, int row, int col)
{
	unsigned int bits = 0;
	char text[48];

	CHECK(strip_live(of, rung, row, col, &bits, text));
	return bits;
}

/* Without the mark of a new value. */
static unsigned int steady(int rung, int row, int col)
{
	return bits_of(view, rung, row, col) & ~(unsigned int)LIVE_FRESH;
}

static const char *text_of(int rung, int row, int col)
{
	static char text[48];
	unsigned int bits;

	CHECK(strip_live(view, rung, row, col, &bits, text));
	return text;
}

/* ---- tests ---- */

/* Compares each cell of each rung with resource_power(). */
static int differences(void)
{
	const struct resource *resource = &ladder_sim_twin(sim)->resource;
	const struct pou *pou = &ladder_document_project(document)->pou[1];
	int wrong = 0;

	for (int r = 0; r < pou->rung_count; r++)
		for (int row = 0; row < pou->rung[r]->rows; row++)
			for (int col = 0; col < pou->rung[r]->cols; col++) {
				bool in = false, out = false;
				const bool known = resource_power(resource, 1,
					(uint32_t)r + 1, (uint32_t)row + 1,
					(uint32_t)col + 1, &in, &out);
				unsigned int bits = 0;
				char text[48];

				strip_live(view, r, row, col, &bits, text);
				wrong += known != !!(bits & LIVE_KNOWN) ||
					 in != !!(bits & LIVE_IN) ||
					 out != !!(bits & LIVE_OUT);
			}
	return wrong;
}

static void test_stop(void)
{
	CHECK(ladder_sim_begin(sim, NULL));
	settle();
	CHECK_AS(bits_of(view, 0, 0, 0) == 0, "no power is known in STOP");
	set("Start", 1);
	CHECK_AS(steady(0, 0, 0) == LIVE_CLOSED, "values are known in STOP");
	set("Start", 0);
}

static void test_power(void)
{
	scan(1);
	CHECK(differences() == 0);
	CHECK(steady(0, 0, 0) == (LIVE_KNOWN | LIVE_IN));
	set("Start", 1);
	scan(1);
	CHECK(differences() == 0);
	CHECK(steady(0, 0, 0) ==
	      (LIVE_KNOWN | LIVE_IN | LIVE_OUT | LIVE_CLOSED));
	CHECK_AS(bits_of(view, 0, 0, 2) & LIVE_CLOSED, "the coil is on");
	set("Start", 0);
	scan(1);
	CHECK(differences() == 0);
	CHECK_AS(!(bits_of(view, 0, 0, 0) & LIVE_CLOSED) &&
		 bits_of(view, 0, 0, 2) & LIVE_CLOSED, "the coil stays on by its own contact");
}

static void test_values(void)
{
	CHECK_TEXT(text_of(1, 0, 1), "0.0 s / 5 s");
	scan(320);
	CHECK_TEXT(text_of(1, 0, 1), "3.2 s / 5 s");
	CHECK_TEXT(text_of(2, 0, 0), "0 > 500");
	set("Level", 512);
	CHECK_TEXT(text_of(2, 0, 0), "512 > 500");
	CHECK_TEXT(text_of(0, 0, 0), "");
}

static const char *wanted_text;

/* Is the value in the accessible name of an element? */
static bool is_heard(void)
{
	bool found = false;

	for (GtkWidget *cell = gtk_widget_get_first_child(GTK_WIDGET(view)); cell && !found;
	     cell = gtk_widget_get_next_sibling(cell)) {
		char *name = gtk_test_accessible_check_property(GTK_ACCESSIBLE(cell),
			GTK_ACCESSIBLE_PROPERTY_LABEL, "-");

		found = name && strstr(name, wanted_text);
		g_free(name);
	}
	return found;
}

/* A number is announced also if nothing else changes. */
static void test_heard(void)
{
	set("Level", 7);
	scan(1);
	wanted_text = ", 7 > 500, open";
	CHECK(until(is_heard));
	set("Level", 8);
	scan(1);
	wanted_text = ", 8 > 500, open";
	CHECK(until(is_heard));
	set("Level", 512);
	scan(1);
}

/* A contact is drawn as the scan saw it: what holds a coil comes behind that. What a person
 * sets since is shown at once. */
static void test_forced(void)
{
	struct act act = { .kind = ACT_FORCE, .at = find("High"), .value.i = 1 };

	set("Level", 3);
	scan(1);
	CHECK(steady(5, 0, 0) == (LIVE_KNOWN | LIVE_IN));
	ladder_sim_act(sim, &act);
	CHECK(comes("High", 1));
	CHECK_AS(steady(5, 0, 0) & LIVE_CLOSED,
		 "the contact shows the value of the last scan");
	scan(1);
	CHECK(value_of("High") == 1 && value_of("%QX0.2") == 0);
	CHECK(steady(5, 0, 0) == (LIVE_KNOWN | LIVE_IN | LIVE_FORCED));
	CHECK_AS(bits_of(view, 2, 0, 1) & LIVE_CLOSED, "the coil is on");
	act.kind = ACT_RELEASE;
	ladder_sim_act(sim, &act);
	CHECK(comes("High", 0));
	scan(1);
	CHECK(steady(5, 0, 0) == (LIVE_KNOWN | LIVE_IN));
	CHECK(ladder_sim_show(sim, ladder_sim_last(sim) - 1));
	CHECK_AS(steady(5, 0, 0) == (LIVE_KNOWN | LIVE_IN | LIVE_FORCED),
		 "the recorded scan shows the forced contact");
	ladder_sim_show_now(sim);
	set("Level", 512);
}

static void test_bodies(void)
{
	set("Start", 1);
	scan(1);
	CHECK_TEXT(ladder_grid_view_instance(body), "First");
	CHECK(bits_of(body, 0, 0, 0) & LIVE_OUT);
	ladder_grid_view_set_instance(body, "Second");
	CHECK_TEXT(ladder_grid_view_instance(body), "Second");
	CHECK(!(bits_of(body, 0, 0, 0) & LIVE_OUT) && bits_of(body, 0, 0, 0) & LIVE_KNOWN);
	set("Start", 0);
	scan(1);
}

/* Only visible rungs that changed are redrawn. */
static void test_drawn(void)
{
	g_usleep(1100000); /* the marks of new values have ended */
	draw();
	strips_redrawn(view, &seen);
	scan(1);
	draw();
	CHECK_AS(strips_redrawn(view, &seen) <= 1, "at most the rung of the timer is redrawn");
	set("Level", 3);
	draw();
	CHECK_AS(strips_redrawn(view, &seen) == 1, "only the rung with Level is redrawn");
	draw();
	CHECK_AS(strips_redrawn(view, &seen) == 0, "no rung is redrawn without a change");
}

static bool tells(LadderTextView *of, int line, const char *want)
{
	char *tip = ladder_text_view_tip(of, line);
	const bool good = g_strcmp0(tip, want) == 0;

	if (!good)
		printf("# line %d: %s\n", line, tip);
	g_free(tip);
	return good;
}

/* The tooltip of a list's line has the values of its variables. */
static void test_list(void)
{
	LadderTextView *list = LADDER_TEXT_VIEW(g_object_ref_sink(
		ladder_text_view_new(document, 2)));
	GtkTextBuffer *buffer = GTK_TEXT_BUFFER(ladder_text_view_buffer(list));
	char count[32];
	int line = 0;

	settle();
	for (int i = 0; i < gtk_text_buffer_get_line_count(buffer); i++) {
		GtkTextIter at, end;
		char *text;

		gtk_text_buffer_get_iter_at_line(buffer, &at, i);
		end = at;
		gtk_text_iter_forward_to_line_end(&end);
		text = gtk_text_iter_get_text(&at, &end);
		line = line == 0 && strstr(text, "Count (*") ? i + 1 : line;
		g_free(text);
	}
	CHECK(line > 0);
	CHECK_AS(tells(list, line, NULL), "no values without a simulation");
	ladder_text_view_set_sim(list, sim);
	g_snprintf(count, sizeof(count), "Count = %d", (int)value_of("List.Count"));
	CHECK(tells(list, line, count));
	CHECK(tells(list, line + 1, NULL));
	ladder_text_view_set_sim(list, NULL);
	g_object_unref(list);
}

/* Finds an action in a menu or its submenus; @accel gets its key, "": none. */
static bool has_action(GMenuModel *menu, const char *action, char *accel, gsize size)
{
	bool has = false;

	for (int i = 0; i < g_menu_model_get_n_items(menu) && !has; i++) {
		GMenuModel *section = g_menu_model_get_item_link(menu, i, G_MENU_LINK_SECTION);
		GMenuModel *submenu = g_menu_model_get_item_link(menu, i, G_MENU_LINK_SUBMENU);
		char *name = NULL, *key = NULL;

		g_menu_model_get_item_attribute(menu, i, "action", "s", &name);
		g_menu_model_get_item_attribute(menu, i, "accel", "s", &key);
		has = g_strcmp0(name, action) == 0;
		if (has)
			g_strlcpy(accel, key ? key : "", size);
		has = has || (section && has_action(section, action, accel, size)) ||
		      (submenu && has_action(submenu, action, accel, size));
		g_free(name);
		g_free(key);
		g_clear_object(&section);
		g_clear_object(&submenu);
	}
	return has;
}

/* The menu names keys as they are while simulating. */
static void test_menu_keys(void)
{
	GMenu *menu;
	char accel[40];

	ladder_grid_view_go(view, 0, 0, 0);
	menu = LADDER_CANVAS_GET_CLASS(view)->menu(LADDER_CANVAS(view));
	CHECK(has_action(G_MENU_MODEL(menu), "live.toggle", accel, sizeof(accel)));
	CHECK_TEXT(accel, "space");
	CHECK(!has_action(G_MENU_MODEL(menu), verb_row(VERB_cycle)->action, accel, sizeof(accel)));
	CHECK(has_action(G_MENU_MODEL(menu), verb_row(VERB_edit_operand)->action, accel,
			 sizeof(accel)));
	CHECK(g_menu_model_get_n_items(G_MENU_MODEL(menu)) == 3);
	g_object_unref(menu);
}

static void test_menu(void)
{
	test_menu_keys();
	ladder_grid_view_go(view, 0, 0, 1);
	gtk_widget_activate_action(GTK_WIDGET(view), "live.on", NULL);
	CHECK(comes("Stop", 1) && live_value_is_forced(sim, false, find("Stop")));
	gtk_widget_activate_action(GTK_WIDGET(view), "live.toggle", NULL);
	CHECK(comes("Stop", 0) && live_value_is_forced(sim, false, find("Stop")));
	gtk_widget_activate_action(GTK_WIDGET(view), "live.force", NULL);
	scan(1);
	CHECK(!live_value_is_forced(sim, false, find("Stop")));
	gtk_widget_activate_action(GTK_WIDGET(body), "live.instance", "s", "First");
	CHECK_TEXT(ladder_grid_view_instance(body), "First");
}

static void test_keys(void)
{
	char *keys;

	ladder_grid_view_go(view, 0, 0, 0);
	keys = ladder_canvas_next_keys(LADDER_CANVAS(view));
	CHECK_AS(g_str_has_prefix(keys, "Space: Toggle"), keys);
	g_free(keys);
	ladder_canvas_do(LADDER_CANVAS(view), VERB_cycle);
	CHECK(comes("Start", 1));
	ladder_canvas_do(LADDER_CANVAS(view), VERB_cycle);
	ladder_canvas_do(LADDER_CANVAS(view), VERB_cycle);
	ladder_canvas_do(LADDER_CANVAS(view), VERB_cycle);
	CHECK_AS(comes("Start", 0),
		 "each of several keys between two frames changes the value");
	ladder_grid_view_go(view, 0, 0, 2);
	ladder_canvas_do(LADDER_CANVAS(view), VERB_force);
	scan(1);
	CHECK(live_value_is_forced(sim, false, find("Motor")) && value_of("Motor") == 1);
	CHECK(bits_of(view, 0, 0, 2) & LIVE_FORCED && bits_of(view, 0, 1, 0) & LIVE_FORCED);
	ladder_canvas_do(LADDER_CANVAS(view), VERB_cycle);
	CHECK(comes("Motor", 0));
	scan(2);
	CHECK_AS(value_of("Motor") == 0, "the program does not change a forced value");
	ladder_canvas_do(LADDER_CANVAS(view), VERB_force);
	scan(2);
	CHECK(!live_value_is_forced(sim, false, find("Motor")));
	CHECK(!(bits_of(view, 0, 0, 2) & LIVE_FORCED));
}

static void test_tips(void)
{
	char *tip = ladder_grid_view_tip(view, 1, 0, 1);

	CHECK(strstr(tip, "PT = 5 s"));
	g_free(tip);
	tip = ladder_grid_view_tip(view, 2, 0, 0);
	CHECK(strstr(tip, "= 3 > 500"));
	g_free(tip);
}

static void set_animations(gboolean on)
{
	g_object_set(gtk_widget_get_settings(window), "gtk-enable-animations", on, NULL);
}

static bool has_aged(void)
{
	unsigned int bits;
	char text[48];

	return strip_live(view, 2, 0, 1, &bits, text) && !(bits & LIVE_FRESH);
}

/* A changed value is marked for a second, unless animations are off. */
static void test_fresh(void)
{
	g_usleep(1100000);
	set_animations(FALSE);
	set("Level", 600);
	scan(1);
	CHECK(!(bits_of(view, 2, 0, 0) & LIVE_FRESH));
	g_usleep(1100000);
	set_animations(TRUE);
	set("Level", 3);
	scan(1);
	CHECK(bits_of(view, 2, 0, 0) & LIVE_FRESH && bits_of(view, 2, 0, 1) & LIVE_FRESH);
	CHECK(!(bits_of(view, 0, 0, 1) & LIVE_FRESH));
	CHECK_AS(until(has_aged), "the mark of a new value ends without a scan");
}

static void test_blockers(void)
{
	static const struct grid_blocker cells[] = { { 0, 0, "must be on" }, { 1, 0, NULL } };

	draw();
	strips_redrawn(view, &seen);
	ladder_grid_view_set_blockers(view, 0, cells, 2);
	draw();
	CHECK(strips_redrawn(view, &seen) == 1);
	ladder_grid_view_set_blockers(view, -1, NULL, 0);
	draw();
	CHECK(strips_redrawn(view, &seen) == 1);
	/* Cells that do not exist are ignored. */
	ladder_grid_view_set_blockers(view, 99, cells, 2);
	ladder_grid_view_set_blockers(view, 3, cells, 2);
	draw();
	ladder_grid_view_set_blockers(view, -1, NULL, 0);
}

static int program_changes;

static void program_changed(void)
{
	program_changes++;
}

static bool has_changed(void)
{
	return program_changes > 0;
}

/* An edited rung shows no values until its program runs; the others do. */
static void test_edit(void)
{
	struct rung *edited = rung_copy(ladder_document_project(document)->pou[1].rung[0]);

	g_signal_connect(sim, "program-changed", G_CALLBACK(program_changed), NULL);
	rung_cell(edited, 0, 0)->word = ELEM_CONTACT_NC;
	ladder_document_begin(document, "edit", NULL);
	CHECK(ladder_document_put_rung(document, 1, 0, edited, NULL));
	ladder_document_end(document);
	CHECK_AS(!(bits_of(view, 0, 0, 0) & LIVE_KNOWN),
		 "the edited rung shows no power");
	CHECK_AS(bits_of(view, 1, 0, 0) & LIVE_KNOWN,
		 "the rung below the edited one shows power");
	CHECK(until(has_changed));
	scan(1);
	CHECK(bits_of(view, 0, 0, 0) & LIVE_KNOWN);
	CHECK(differences() == 0);
}

static void test_end(void)
{
	unsigned int bits;
	char text[48];

	ladder_sim_end(sim);
	settle();
	CHECK(!strip_live(view, 0, 0, 0, &bits, text));
	ladder_canvas_do(LADDER_CANVAS(view), VERB_force); /* only a message */
}

/* ---- a window ---- */

static GtkWidget *sheet_of(int pou)
{
	GtkWidget *scroller = gtk_scrolled_window_new();
	GtkWidget *sheet = ladder_grid_view_new(document, pou);

	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), sheet);
	ladder_canvas_set_sim(LADDER_CANVAS(sheet), sim);
	gtk_stack_add_named(GTK_STACK(stack), scroller, pou == 1 ? "main" : "body");
	return sheet;
}

static void make_window(void)
{
	window = gtk_window_new();
	stack = gtk_stack_new();
	gtk_window_set_child(GTK_WINDOW(window), stack);
	view = LADDER_GRID_VIEW(sheet_of(1));
	body = LADDER_GRID_VIEW(sheet_of(0));
	gtk_window_set_default_size(GTK_WINDOW(window), 1000, 860);
	gtk_window_present(GTK_WINDOW(window));
	frames = gtk_widget_get_frame_clock(window);
	g_signal_connect(frames, "after-paint", G_CALLBACK(count_frame), NULL);
	draw();
}

/* Coils are images, but where their px would not be those of the screen. */
static void test_zoom(void)
{
	static const struct { double zoom; bool image; } cases[] = {
		{ 1.1, false }, { 2, true }, { 0.5, false }, { 1, true },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(cases); i++) {
		ladder_canvas_set_zoom(LADDER_CANVAS(view), cases[i].zoom);
		draw();
		CHECK(widget_has(GTK_WIDGET(view), "texture {") == cases[i].image);
	}
}

/* The coil of the first rung, px of the widget. */
static graphene_rect_t coil_box(void)
{
	graphene_rect_t box = { 0 };

	CHECK(LADDER_CANVAS_GET_CLASS(view)->cell_box(LADDER_CANVAS(view),
						      (struct canvas_spot){ 0, 0, 2 }, &box));
	return canvas_rect(LADDER_CANVAS(view), box);
}

/* Rungs are as wide as the page; wider ones show their coils at its edge. */
static void test_width(void)
{
	const float page = (float)gtk_widget_get_width(GTK_WIDGET(view));
	graphene_rect_t box = coil_box();
	char *tip;

	CHECK(box.origin.x + box.size.width < page && box.origin.x + box.size.width > page - 60);
	ladder_grid_view_go(view, 0, 0, 0);
	ladder_canvas_set_zoom(LADDER_CANVAS(view), 3);
	draw();
	box = coil_box();
	CHECK_AS(box.origin.x < page && box.origin.x > page - 3 * (RUNG_AFTER + RUNG_CELL_WIDTH + 1),
		 "the coil is at the edge of the page");
	tip = LADDER_CANVAS_GET_CLASS(view)->tip(LADDER_CANVAS(view),
		(int)(page - 3 * (RUNG_AFTER + RUNG_CELL_WIDTH / 2)),
		(int)(box.origin.y + 3 * RUNG_WIRE), false);
	CHECK_AS(tip && strstr(tip, "Motor"),
		 "the tooltip at the edge of the page is that of the coil");
	g_free(tip);
	ladder_grid_view_go(view, 0, 0, 2);
	CHECK_AS(canvas_rect(LADDER_CANVAS(view), GRAPHENE_RECT_INIT(0, 0, 0, 0)).origin.x == 0,
		 "the page does not scroll to a coil at its edge");
	ladder_canvas_set_zoom(LADDER_CANVAS(view), 1);
	draw();
}

int main(void)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	CHECK(ladder_document_project(document)->pou_count == 3);
	sim = ladder_sim_new(document);
	make_window();
	test_zoom();
	test_stop();
	test_power();
	test_values();
	test_width();
	test_heard();
	test_forced();
	test_bodies();
	test_drawn();
	test_list();
	test_menu();
	test_keys();
	test_tips();
	test_fresh();
	test_blockers();
	test_edit();
	test_end();
	g_clear_pointer(&seen, g_ptr_array_unref);
	gtk_window_destroy(GTK_WINDOW(window));
	settle();
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
