/* SPDX-License-Identifier: MIT
 *
 * test_whole - a window of 1024 px in each language, with each page and each panel, at rest and
 * while simulating: the text of each button, of each heading and of the title is whole; at rest
 * also each text in a list, and no list is wider than its place. Why a condition holds is read some times a second,
 * and not with each frame.
 */
#include "editor-gtk/kit/cell_entry.h"
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/text/text_view.h"
#include "editor-gtk/window/app.h"
#include "editor-gtk/window/window.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <gtksourceview/gtksource.h>
#include <libintl.h>
#include <locale.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\nPROJECT \"Pump\"\n\nTYPE\n  Recipe : STRUCT\n    Steps : ARRAY[1..12] OF DINT;\n"
	"  END_STRUCT;\nEND_TYPE\n\n"
	"CONFIGURATION Plant\nVAR_GLOBAL\n  Start AT %IX0.0 : BOOL; (* push button *)\n"
	"  Motor AT %QX0.0 : BOOL;\n  Count : INT;\n  Mix : Recipe;\nEND_VAR\n"
	"  RESOURCE Cpu ON LINUX\n    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1);\n"
	"    TASK Slow (INTERVAL := T#20ms, PRIORITY := 2, WATCHDOG := T#50ms);\n"
	"    PROGRAM A WITH Fast : Main;\n    PROGRAM B WITH Slow : Way;\n"
	"  END_RESOURCE\nEND_CONFIGURATION\n\n"
	"PROGRAM Main LD\nVAR\n  Delay : TON;\n  Parts : CTU;\n  Hot : ALARM;\nEND_VAR\n"
	"RUNG \"Motor\"\n  | NO Start | TON Delay PT:=T#5s | COIL Motor |\n"
	"RUNG\n  | NO Start | CTU Parts PV:=10 | COIL %QX0.1 |\n"
	"RUNG\n  | NC Start | ALARM Hot MSG:='The motor does not run: look at it' | COIL %QX0.2 |\nEND_PROGRAM\n\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Rest:\n  END_STEP\n  STEP Run:\n  END_STEP\n"
	"  TRANSITION FROM Rest TO Run := Start; END_TRANSITION\n"
	"  TRANSITION FROM Run TO Rest := NOT Start; END_TRANSITION\nEND_PROGRAM\n\n"
	"PROGRAM Sums IL\n  LD Count\n  ADD 1\n  ST Count\nEND_PROGRAM\n";

static const char *const pages[] = { "tasks", "types", "address_map", "print_preview",
				     "online_device" };
static const char *const panels[] = { "problems", "uses", "watch", "timing", "scenarios", "list",
				      "alarms", "log", "board" };

#define LONG 210 /* px: a longer text may be cut */

static GtkWidget *window;
static char *map; /* path of an I/O map */

/* ---- what is cut ---- */

static bool is_named(GtkWidget *widget, const char *type)
{
	return !strcmp(G_OBJECT_TYPE_NAME(widget), type);
}

/* Is @widget in a button, a heading or the title, or, if @cells, in a list? */
static bool counts(GtkWidget *widget, bool cells)
{
	for (; widget; widget = gtk_widget_get_parent(widget))
		if (GTK_IS_BUTTON(widget) || GTK_IS_MENU_BUTTON(widget) ||
		    is_named(widget, "GtkColumnViewTitle") || ADW_IS_WINDOW_TITLE(widget) ||
		    gtk_widget_has_css_class(widget, "heading") ||
		    (cells && (GTK_IS_LIST_VIEW(widget) || is_named(widget, "GtkColumnListView"))))
			return true;
	return false;
}

/* The text of a label or of a cell that can be edited; NULL: @widget is another one. */
static const char *text_of(GtkWidget *widget)
{
	if (LADDER_IS_CELL_ENTRY(widget))
		return gtk_editable_get_text(GTK_EDITABLE(widget));
	return GTK_IS_LABEL(widget) ? gtk_label_get_text(GTK_LABEL(widget)) : NULL;
}

static bool is_cut(GtkWidget *widget)
{
	PangoLayout *whole;
	int width;

	if (LADDER_IS_CELL_ENTRY(widget) ? !cell_entry_is_cut(LADDER_CELL_ENTRY(widget)) :
	    !pango_layout_is_ellipsized(gtk_label_get_layout(GTK_LABEL(widget))))
		return false;
	whole = gtk_widget_create_pango_layout(widget, text_of(widget));
	pango_layout_get_pixel_size(whole, &width, NULL);
	g_object_unref(whole);
	return width < LONG;
}

/* Px beyond the right edge of the lists below @widget. */
static int beyond(GtkWidget *widget)
{
	int by = 0;

	if (!gtk_widget_get_mapped(widget))
		return 0;
	if (GTK_IS_COLUMN_VIEW(widget)) {
		GtkAdjustment *across = gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(widget));

		return MAX((int)(gtk_adjustment_get_upper(across) -
				 gtk_adjustment_get_page_size(across)), 0);
	}
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		by += beyond(child);
	return by;
}

/* Counts the texts below @widget that are cut, and tells them as @where unless it is NULL. */
static int count_cut(GtkWidget *widget, const char *where, bool cells, int *seen)
{
	const char *text = text_of(widget);
	int cut = 0;

	if (!gtk_widget_get_mapped(widget))
		return 0;
	if (text && *text && counts(widget, cells)) {
		(*seen)++;
		cut = is_cut(widget);
		if (cut && where)
			printf("# %s: %s\n", where, text);
	}
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		cut += count_cut(child, where, cells, seen);
	return cut;
}

/* Tabs of panels that are only in the menu behind them. */
static int tabs_in_menu(GtkWidget *widget)
{
	const bool tabs = gtk_widget_has_css_class(widget, "below-tabs");
	int count = 0;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		count += tabs ? gtk_widget_get_visible(child) &&
				!gtk_widget_get_child_visible(child) : tabs_in_menu(child);
	return count;
}

/* ---- the window ---- */

static void speak(const char *language)
{
	const char *build = g_getenv("BUILD");
	char *locale = g_build_filename(build ? build : "build", "locale", NULL);

	g_setenv("LANGUAGE", language, TRUE);
	setlocale(LC_ALL, "");
	bindtextdomain(GETTEXT_PACKAGE, locale);
	bind_textdomain_codeset(GETTEXT_PACKAGE, "UTF-8");
	textdomain(GETTEXT_PACKAGE);
	g_free(locale);
}

static void painted(GdkFrameClock *clock, int *frames)
{
	(void)clock;
	--*frames;
}

/* Columns share the width one frame after the page is there. */
static void wait_for_frames(void)
{
	GdkFrameClock *clock = gtk_widget_get_frame_clock(window);
	int frames = 4;
	gulong handler = g_signal_connect(clock, "after-paint", G_CALLBACK(painted), &frames);

	gdk_frame_clock_begin_updating(clock);
	WAIT(frames <= 0);
	gdk_frame_clock_end_updating(clock);
	g_signal_handler_disconnect(clock, handler);
}

static void open_window(int width, const char *text)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	ladder_document_check_now(document);
	CHECK(ladder_document_project(document) != NULL);
	window = GTK_WIDGET(ladder_window_new(NULL, document));
	g_object_unref(document);
	gtk_window_set_default_size(GTK_WINDOW(window), width, 700);
	ladder_window_opened(LADDER_WINDOW(window));
	screen_show(window);
	wait_for_frames();
}

static void close_window(void)
{
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
}

/* @lists: no list scrolls sideways, and the texts in them are whole. */
static void check(const char *language, const char *where, bool lists, const char *mode)
{
	char *name = g_strdup_printf("%s: %s%s", language, where, mode);
	int seen = 0;

	wait_for_frames();
	WAIT((seen = 0, count_cut(window, NULL, lists, &seen)) == 0 && seen > 10 &&
	     (!lists || beyond(window) == 0));
	CHECK_AS(count_cut(window, name, lists, &seen) == 0 && seen > 10, name);
	if (lists && beyond(window) > 0)
		printf("# %s: %d px\n", name, beyond(window));
	CHECK_AS(!lists || beyond(window) == 0, name);
	g_free(name);
}

static void do_action(const char *name)
{
	char *action = g_strconcat("win.", name, NULL);

	gtk_widget_activate_action(window, action, NULL);
	g_free(action);
}

/* While simulating a panel takes room: lists may scroll then. */
static void check_all(const char *language, bool lists, const char *mode)
{
	for (gsize i = 0; i < G_N_ELEMENTS(pages); i++) {
		do_action(pages[i]);
		check(language, pages[i], lists, mode);
	}
	for (int pou = 0; pou < 3; pou++) {
		gtk_widget_activate_action(window, "win.go-to", "(iiii)", pou, 0, 0, 0);
		check(language, (const char *[]){ "ladder", "chart", "list" }[pou], lists, mode);
	}
	for (gsize i = 0; i < G_N_ELEMENTS(panels); i++) {
		gtk_widget_activate_action(window, "win.show-panel", "s", panels[i]);
		check(language, panels[i], lists, mode);
	}
}

/* The tables with most columns: where there is no room some leave, and no list scrolls sideways. */
static void check_tables(const char *language, const char *mode)
{
	do_action("symbols");
	check(language, "symbols", true, mode);
	gtk_widget_activate_action(window, "win.open-text", "s", map);
	check(language, "map", true, mode);
}

static char *write_map(void)
{
	static const char text[] = "BOARD \"Pump\"\n"
		"%IX0.0 gpio line=GPIO17 pull-up active-low debounce=5ms # start\n"
		"%QX0.0 sim safe=0\n%QX0.1 sim safe=0\n%QX0.2 gpio line=GPIO27 safe=0\n";
	char *folder = g_dir_make_tmp("whole-XXXXXX", NULL);
	char *path = g_build_filename(folder, "pump.io", NULL);

	g_file_set_contents(path, text, -1, NULL);
	g_free(folder);
	return path;
}

static void delete_map(void)
{
	char *folder = g_path_get_dirname(map);

	g_remove(map);
	g_rmdir(folder);
	g_free(folder);
	g_free(map);
}

/* ---- why a condition holds ---- */

static const char counting[] =
	"RUNGBOARD 1\n\nPROGRAM Main ST\nVAR\n  Count : DINT;\nEND_VAR\n"
	"  Count := Count + 1;\n  IF Count < 0 THEN\n    ;\n  END_IF;\nEND_PROGRAM\n";

/* The widget of this type, or the label that says whether a condition holds. */
static GtkWidget *find(GtkWidget *widget, const char *type)
{
	GtkWidget *found = NULL;

	if (type ? is_named(widget, type) && gtk_widget_get_mapped(widget) :
	    GTK_IS_LABEL(widget) && (g_str_has_prefix(text_of(widget), "TRUE: ") ||
				     g_str_has_prefix(text_of(widget), "FALSE: ")))
		return widget;
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found; child = gtk_widget_get_next_sibling(child))
		found = find(child, type);
	return found;
}

static void said_anew(int *times)
{
	++*times;
}

static void check_why(void)
{
	GtkWidget *list = NULL, *label = NULL;
	GtkTextBuffer *text;
	GtkTextIter at, end;
	gint64 began;
	int times = 0;

	speak("en");
	open_window(1024, counting);
	gtk_widget_activate_action(window, "win.go-to", "(iiii)", 0, 0, 0, 0);
	WAIT((list = find(window, "LadderTextView")) != NULL);
	CHECK(list != NULL);
	if (!list)
		return;
	text = GTK_TEXT_BUFFER(ladder_text_view_buffer(LADDER_TEXT_VIEW(list)));
	gtk_text_buffer_get_start_iter(text, &at);
	CHECK(gtk_text_iter_forward_search(&at, "IF Count", 0, &at, &end, NULL));
	gtk_text_buffer_place_cursor(text, &at);
	do_action("sim_mode");
	do_action("sim_run");
	WAIT((do_action("sim_why"), turn(0), (label = find(window, NULL)) != NULL));
	CHECK(label != NULL);
	began = g_get_monotonic_time();
	if (label)
		g_signal_connect_swapped(label, "notify::label", G_CALLBACK(said_anew), &times);
	WAIT(times >= 8);
	printf("# %d times in %d ms\n", times, (int)((g_get_monotonic_time() - began) / 1000));
	CHECK(times >= 8);
	CHECK(times <= 2 + (g_get_monotonic_time() - began) / 95000);
	close_window();
}

int main(void)
{
	static const char *const languages[] = { "en", "de", "fr", "zh_CN" };

	if (!screen_start() || !gtk_init_check()) {
		tap_skip("the window needs Xvfb");
		return tap_done();
	}
	adw_init();
	gtk_source_init();
	app_style();
	slow_bar_choose_all();
	map = write_map();
	for (gsize i = 0; i < G_N_ELEMENTS(languages); i++) {
		speak(languages[i]);
		open_window(1024, sample);
		check_tables(languages[i], "");
		check_all(languages[i], true, "");
		CHECK_AS(tabs_in_menu(window) == 0, languages[i]);
		do_action("sim_mode");
		check_all(languages[i], false, ", simulating");
		check_tables(languages[i], ", simulating");
		close_window();
	}
	delete_map();
	check_why();
	return tap_done();
}
