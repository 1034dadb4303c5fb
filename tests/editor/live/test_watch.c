/* SPDX-License-Identifier: MIT
 *
 * test_watch - status charts: printing and parsing of values, the lines in a file, and the
 * table over a running simulation.
 *
 * WATCH_PICTURES=FOLDER saves pictures of it.
 */
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/window/app.h"
#include "editor-gtk/live/watch_names.h"
#include "editor-gtk/live/watch_view.h"
#include "tests/editor/keys.h"
#include "tests/editor/saved.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"VAR\n  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\n  Count : INT;\n"
	"  Bits : WORD;\n  Long : DWORD;\n  Level : REAL;\n  Label : STRING[8];\n"
	"  Delay : TON;\n  Table : ARRAY[1..3] OF INT;\nEND_VAR\n\n"
	"VAR CONSTANT\n  Most : INT := 7;\nEND_VAR\n\n"
	"PROGRAM Main LD\n"
	"RUNG\n  | NO Start | COIL Motor |\n"
	"RUNG\n  | P Start | ADD IN1:=Count IN2:=1 OUT=>Count |\n"
	"RUNG\n  | NO Motor | TON Delay PT:=T#1m | COIL %QX0.1 |\n"
	"END_PROGRAM\n";

static GtkWidget *window;
static LadderDocument *document;
static LadderSim *sim;
static LadderWatchView *view;
static char *original; /* text of the file */

/* ---- values ---- */

static bool prints(enum live_format format, enum iec_type type, int64_t value,
		   const char *expected)
{
	char text[IEC_VALUE_TEXT];

	live_value_format(format, type, (union iec_value){ .i = value }, text, sizeof(text));
	if (strcmp(text, expected) != 0)
		printf("# %s, not %s\n", text, expected);
	return strcmp(text, expected) == 0;
}

static void check_print(void)
{
	CHECK(prints(FORMAT_AUTO, IEC_BOOL, 1, "1"));
	CHECK(prints(FORMAT_AUTO, IEC_INT, -5, "-5"));
	CHECK(prints(FORMAT_UNSIGNED, IEC_INT, -1, "65535"));
	CHECK(prints(FORMAT_SIGNED, IEC_WORD, 0xfffe, "-2"));
	CHECK(prints(FORMAT_HEX, IEC_INT, -1, "16#FFFF"));
	CHECK(prints(FORMAT_HEX, IEC_DWORD, 0xbeef, "16#0000BEEF"));
	CHECK(prints(FORMAT_BIN, IEC_BYTE, 0x12, "2#0001_0010"));
	CHECK(prints(FORMAT_FLOAT, IEC_DWORD, 0x3fc00000, "1.5"));
	CHECK(prints(FORMAT_TIME, IEC_UINT, 1500, "1.5 s"));
	CHECK(prints(FORMAT_AUTO, IEC_TIME, 2500000000, "2.5 s"));
	CHECK(prints(FORMAT_SIGNED, IEC_LWORD, -1, "-1"));
	CHECK(prints(FORMAT_UNSIGNED, IEC_ULINT, -1, "18446744073709551615"));
	CHECK(prints(FORMAT_HEX, IEC_BOOL, 1, "1"));
	CHECK(prints(FORMAT_TIME, IEC_ULINT, -1, "18446744073709551615"));
}

static bool reads(enum live_format format, enum iec_type type, const char *text,
		  int64_t expected)
{
	union iec_value value = { .i = 0 };
	struct iec_text room;
	enum diag_id why;

	return live_value_parse(format, type, text, &room, &value, &why) && value.i == expected;
}

static bool refuses(enum live_format format, enum iec_type type, const char *text)
{
	union iec_value value;
	struct iec_text room;
	enum diag_id why;

	return !live_value_parse(format, type, text, &room, &value, &why) &&
	       (why == DIAG_BAD_LITERAL || why == DIAG_LITERAL_RANGE);
}

static void check_parse(void)
{
	CHECK(reads(FORMAT_AUTO, IEC_INT, " -5 ", -5));
	CHECK(reads(FORMAT_HEX, IEC_INT, "ffff", -1));
	CHECK(reads(FORMAT_HEX, IEC_WORD, "16#12", 0x12));
	CHECK(reads(FORMAT_BIN, IEC_WORD, "1010", 10));
	CHECK(reads(FORMAT_UNSIGNED, IEC_INT, "65535", -1));
	CHECK(reads(FORMAT_SIGNED, IEC_WORD, "-2", 0xfffe));
	CHECK(reads(FORMAT_FLOAT, IEC_DWORD, "1.5", 0x3fc00000));
	CHECK(reads(FORMAT_TIME, IEC_UINT, "1s500ms", 1500));
	CHECK(reads(FORMAT_AUTO, IEC_TIME, "2s", 2000000000));
	CHECK(reads(FORMAT_AUTO, IEC_TIME, "T#2s", 2000000000));
	CHECK(reads(FORMAT_AUTO, IEC_TIME, "20", 20000000));
	CHECK(reads(FORMAT_AUTO, IEC_TIME, "2.5 s", 2500000000));
	CHECK(reads(FORMAT_AUTO, IEC_TIME, "2:05 min", 125000000000));
	CHECK(reads(FORMAT_AUTO, IEC_TIME, "-1:00:00.5 h", -3600500000000));
	CHECK(refuses(FORMAT_AUTO, IEC_TIME, "2:65 min"));
	CHECK(refuses(FORMAT_AUTO, IEC_TIME, "1:2:3:4"));
	CHECK(refuses(FORMAT_AUTO, IEC_TIME, "2: min"));
	CHECK(reads(FORMAT_AUTO, IEC_BOOL, "TRUE", 1));
	CHECK(refuses(FORMAT_AUTO, IEC_INT, "40000"));
	CHECK(refuses(FORMAT_HEX, IEC_BYTE, "100"));
	CHECK(refuses(FORMAT_SIGNED, IEC_WORD, "-40000"));
	CHECK(refuses(FORMAT_TIME, IEC_UINT, "500us"));
	CHECK(refuses(FORMAT_TIME, IEC_UINT, "2m"));
	CHECK(refuses(FORMAT_AUTO, IEC_BOOL, "2"));
	CHECK(refuses(FORMAT_BIN, IEC_WORD, "12"));
	CHECK(refuses(FORMAT_AUTO, IEC_INT, ""));
	CHECK(refuses(FORMAT_HEX, IEC_INT, "--"));
}

/* Every printed value can be parsed again, to the same value. */
static void check_round(void)
{
	guint32 seed = 1;
	int bad = 0;

	for (int n = 0; n < 20000; n++) {
		const enum iec_type type = (enum iec_type)(IEC_BOOL + n % (IEC_LREAL - IEC_BOOL));
		const enum live_format format = (enum live_format)(n / 40 % FORMAT_COUNT);
		unsigned char memory[8];
		char text[IEC_VALUE_TEXT];
		union iec_value value, back = { .i = 0 };
		struct iec_text room;
		enum diag_id why;

		for (int i = 0; i < 8; i++)
			memory[i] = (unsigned char)((seed = seed * 1103515245 + 12345) >> 16);
		memory[0] &= type == IEC_BOOL ? 1 : 255;
		value = iec_load(memory, type);
		if (iec_type_row(type)->class == CLASS_REAL && value.r != value.r)
			continue;
		live_value_format(format, type, value, text, sizeof(text));
		if (strchr("nN", text[0]) || strstr(text, "inf"))
			continue; /* not a number */
		if (!live_value_parse(format, type, text, &room, &back, &why) ||
		    back.i != value.i) {
			if (format == FORMAT_TIME && strchr(text, ' ') == NULL)
				continue; /* more than a TIME can hold */
			printf("# %s as %s: %s\n", iec_type_row(type)->word,
			       live_format_word(format), text);
			bad++;
		}
	}
	CHECK(bad == 0);
}

/* ---- what a file keeps ---- */

static bool writes(const char *before, const char *expected)
{
	GPtrArray *charts = watch_list_read(before);
	char *after = watch_list_write(before, charts);
	const bool same = strcmp(after, expected) == 0;

	if (!same)
		printf("# %s\n", after);
	g_ptr_array_unref(charts);
	g_free(after);
	return same;
}

static void check_file(void)
{
	static const char full[] =
		"VIEW\n  bookmark Main 1\n  status-chart Two words\n"
		"    watch auto Start the green one\n    watch hex %QW0\n  status-chart\n"
		"  bookmark Main 2\nEND_VIEW";
	GPtrArray *charts = watch_list_read(full);
	const struct watch *chart = charts->pdata[0];
	const struct watch_line *line = chart->lines->pdata[0];

	CHECK(charts->len == 2 && chart->lines->len == 2);
	CHECK(strcmp(chart->name, "Two words") == 0);
	CHECK(strcmp(line->name, "Start") == 0 && strcmp(line->comment, "the green one") == 0);
	CHECK(writes(full, full));
	CHECK(writes("VIEW\nEND_VIEW", "VIEW\nEND_VIEW"));
	CHECK(writes("VIEW\n  watch odd X\n  watcher\nEND_VIEW",
		     "VIEW\n  watch odd X\n  watcher\nEND_VIEW"));
	CHECK(writes("VIEW\nwatch bin  A   b \nEND_VIEW",
		     "VIEW\n  status-chart\n    watch bin A b\nEND_VIEW"));
	g_ptr_array_unref(charts);
	charts = watch_list_read("VIEW\nEND_VIEW");
	g_ptr_array_add(charts, watch_new("a\nEND_VIEW"));
	g_ptr_array_add(((struct watch *)charts->pdata[0])->lines,
			watch_line_new(FORMAT_AUTO, " Table[ 2 ]\n", "x\ny"));
	char *text = watch_list_write("", charts);

	CHECK(strcmp(text, "VIEW\n  status-chart a END_VIEW\n    watch auto Table[2] x y\n"
		     "END_VIEW") == 0);
	g_free(text);
	g_ptr_array_unref(charts);
}

/* ---- the table ---- */

static GListModel *list(void)
{
	GtkWidget *table = find_type(GTK_WIDGET(view), GTK_TYPE_COLUMN_VIEW);

	return G_LIST_MODEL(gtk_column_view_get_model(GTK_COLUMN_VIEW(table)));
}

static GtkWidget *find_class(GtkWidget *widget, const char *class)
{
	GtkWidget *found = gtk_widget_has_css_class(widget, class) ? widget : NULL;
	GtkWidget *child = gtk_widget_get_first_child(widget);

	for (; child && !found; child = gtk_widget_get_next_sibling(child))
		found = find_class(child, class);
	return found;
}

static bool has_text(GtkWidget *widget, const char *text)
{
	bool has = GTK_IS_LABEL(widget) && strcmp(gtk_label_get_text(GTK_LABEL(widget)), text) == 0;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !has;
	     child = gtk_widget_get_next_sibling(child))
		has = has_text(child, text);
	return has;
}

static const char *message(void)
{
	return gtk_label_get_text(GTK_LABEL(find_class(GTK_WIDGET(view), "panel-message")));
}

static guint rows(void)
{
	return g_list_model_get_n_items(list());
}

static LadderWatchRow *row(guint at)
{
	LadderWatchRow *found = g_list_model_get_item(list(), at);

	g_object_unref(found);
	return found;
}

static LadderWatchRow *row_of(const char *name)
{
	for (guint i = 0; i < rows(); i++)
		if (strcmp(row(i)->line->name, name) == 0)
			return row(i);
	return NULL;
}

/* The text in its cell. */
static const char *shown(const char *name)
{
	const LadderWatchRow *found = row_of(name);

	return found && found->value ? gtk_label_get_text(GTK_LABEL(found->value)) : "?";
}

static void type_new(const char *name, const char *text)
{
	gtk_editable_set_text(GTK_EDITABLE(row_of(name)->fresh), text);
}

static void do_action(const char *name)
{
	gtk_widget_activate_action(GTK_WIDGET(view), name, NULL);
	turn(20);
}

static bool file_has(const char *part)
{
	char *text = ladder_document_text(document, NULL);
	const bool has = strstr(text, part) != NULL;

	if (!has)
		printf("# %s\n", text);
	g_free(text);
	return has;
}

static bool is_unknown(const LadderWatchRow *of)
{
	return of->asked && of->at.type == IEC_NONE;
}

static bool expands(const struct image *image, const char *line, const char *expected)
{
	GPtrArray *names = watch_names_expand(image, line);
	char *text;
	bool same;

	g_ptr_array_add(names, NULL);
	text = g_strjoinv(" ", (char **)names->pdata);
	same = strcmp(text, expected) == 0;
	if (!same)
		printf("# %s\n", text);
	g_free(text);
	g_ptr_array_unref(names);
	return same;
}

/* A program with an instance of its own: with the program's name, without, with another's. */
static void check_local(void)
{
	static const char text[] =
		"RUNGBOARD 1\n\nPROGRAM Main LD\nVAR\n  Wait : TON;\n  Two : TON;\nEND_VAR\n"
		"RUNG\n  | NO %IX0.0 | TON Wait PT:=T#1s | TON Two PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n\n"
		"PROGRAM Other LD\nVAR\n  Two : TP;\nEND_VAR\n"
		"RUNG\n  | NO %IX0.1 | TP Two PT:=T#1s | COIL %QX0.1 |\nEND_PROGRAM\n";
	LadderDocument *other = ladder_document_new();
	LadderSim *simulated;
	const struct image *image;

	ladder_document_open_text(other, "/tmp/x/local.rung", text, strlen(text), true);
	ladder_document_check_now(other);
	simulated = ladder_sim_new(other);
	CHECK(ladder_sim_begin(simulated, NULL));
	image = live_image(simulated, false);
	CHECK(expands(image, "Main.Wait", "Main.Wait.IN Main.Wait.Q Main.Wait.PT Main.Wait.ET"));
	CHECK(expands(image, "main.two", "Main.Two.IN Main.Two.Q Main.Two.PT Main.Two.ET"));
	CHECK(expands(image, "Other.Wait Main.Nobody", "Other.Wait Main.Nobody"));
	CHECK(expands(image, "Main.Wait.Q", "Main.Wait.Q"));
	ladder_sim_end(simulated);
	g_object_unref(simulated);
	g_object_unref(other);
}

/* One variable has one row for each form of its value, whichever form of its name is added. */
static void check_once(void)
{
	static const char text[] =
		"RUNGBOARD 1\n\nPROGRAM Main LD\nVAR\n  Wait : TON;\n  Count : INT;\nEND_VAR\n"
		"RUNG\n  | NO %IX0.0 | TON Wait PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n\n"
		"VIEW\n  status-chart One\n    watch auto Wait.Q\n    watch auto Main.Wait\n"
		"    watch hex Count\nEND_VIEW\n";
	LadderDocument *other = ladder_document_new();
	LadderSim *idle = ladder_sim_new(other);
	LadderWatchView *one;
	char *kept;

	ladder_document_open_text(other, "/tmp/x/once.rung", text, strlen(text), true);
	ladder_document_check_now(other);
	one = LADDER_WATCH_VIEW(g_object_ref_sink(ladder_watch_view_new(other, idle)));
	CHECK(ladder_watch_view_add(one, "wait.et") && ladder_watch_view_add(one, "Main.Count"));
	CHECK(ladder_watch_view_add(one, "Count %QX0.0 %Q0.0"));
	kept = ladder_document_text(other, NULL);
	CHECK_TEXT(strstr(kept, "VIEW"), "VIEW\n  status-chart One\n    watch auto Wait.Q\n"
		   "    watch auto Main.Wait.IN\n    watch auto Main.Wait.PT\n    watch auto Main.Wait.ET\n"
		   "    watch auto Main.Count\n    watch auto %QX0.0\n    watch hex Count\nEND_VIEW\n");
	g_free(kept);
	g_object_unref(one);
	g_object_unref(idle);
	g_object_unref(other);
}

/* Rows can be made while the simulation is off; unknown names stay. */
static void check_making(void)
{
	CHECK(rows() == 0);
	CHECK(ladder_watch_view_add(view, "Start Motor Nobody"));
	CHECK(rows() == 3 && row(0)->at.type == IEC_BOOL);
	CHECK(is_unknown(row(2)));
	CHECK(file_has("  status-chart Chart 1\n    watch auto Start\n"));
	CHECK(ladder_watch_view_add(view, "Table[1..3] Delay"));
	CHECK(rows() >= 3 + 3 + 4);
	CHECK(row_of("Table[2]") && row_of("Delay.ET") &&
	      row_of("Delay.ET")->at.type == IEC_TIME);
	CHECK(ladder_document_undo(document));
	CHECK_SOON(rows() == 3);
	CHECK(ladder_watch_view_add(view, "%QW0 Count Bits Level Label Most"));
	CHECK(rows() == 9 && strcmp(shown("Count"), "") == 0);
	gtk_widget_activate_action(GTK_WIDGET(view), "watch.format", "(ii)", 5, FORMAT_HEX);
	CHECK(row(5)->line->format == FORMAT_HEX && file_has("    watch hex Bits\n"));
	do_action("watch.up"); /* of Most, which was added last */
	CHECK(strcmp(row(7)->line->name, "Most") == 0);
	do_action("watch.remove");
	CHECK(rows() == 8 && !row_of("Most"));
	CHECK(ladder_watch_view_add(view, "Most"));
	CHECK(!ladder_watch_view_add(view, " , "));
}

static void check_running(void)
{
	LadderWatchRow *start;

	CHECK(ladder_sim_begin(sim, NULL));
	ladder_sim_scan(sim, 1);
	CHECK_SOON(strcmp(shown("Motor"), "0") == 0);
	CHECK(strcmp(shown("Nobody"), "") == 0);
	CHECK_SOON(strcmp(shown("Bits"), "16#0000") == 0);
	start = row_of("Start");
	type_new("Start", "1");
	type_new("Bits", "beef");
	type_new("Level", "2.5");
	type_new("Label", "'abc'");
	CHECK(strcmp(shown("Start"), "0") == 0);
	do_action("watch.write-all");
	CHECK_SOON(strcmp(shown("Start"), "1") == 0 && strcmp(shown("Bits"), "16#BEEF") == 0);
	CHECK_SOON(strcmp(shown("Level"), "2.5") == 0 && strcmp(shown("Label"), "'abc'") == 0);
	CHECK(strcmp(gtk_editable_get_text(GTK_EDITABLE(row_of("Start")->fresh)), "") == 0);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(strcmp(shown("Motor"), "1") == 0 && strcmp(shown("Count"), "1") == 0);
	CHECK_SOON(strcmp(shown("%QW0"), "1") == 0);
	CHECK(row_of("Start") == start); /* new values keep the row objects */
	type_new("Label", "'much too long'");
	do_action("watch.write-all");
	CHECK(*message());
	CHECK(strcmp(shown("Label"), "'abc'") == 0);
	CHECK(gtk_widget_has_css_class(row_of("Label")->fresh, "error"));
	save_pictures(window, "WATCH_PICTURES", "running");
	type_new("Label", "");
	CHECK_AS(!*message(), "nothing is wrong with an empty entry");
	CHECK(!gtk_widget_has_css_class(row_of("Label")->fresh, "error"));
}

static void press(GtkWidget *button)
{
	g_signal_emit_by_name(button, "clicked");
	turn(20);
}

static void check_forces(void)
{
	type_new("Motor", "0");
	press(row_of("Motor")->force);
	CHECK_SOON(row_of("Motor")->seen.forced && strcmp(shown("Motor"), "0") == 0);
	CHECK_SOON(gtk_widget_has_css_class(row_of("Motor")->force, "forced"));
	CHECK(ladder_sim_forces(sim) == 1);
	ladder_sim_scan(sim, 1);
	CHECK_SOON(ladder_sim_last(sim) == 3);
	CHECK(strcmp(shown("Motor"), "0") == 0);
	save_pictures(window, "WATCH_PICTURES", "forced");
	press(row_of("Motor")->force);
	CHECK_SOON(!row_of("Motor")->seen.forced && strcmp(shown("Motor"), "1") == 0);
	CHECK(!gtk_widget_get_sensitive(row_of("Label")->force));
	CHECK(!gtk_widget_get_sensitive(row_of("Most")->force));
	CHECK(!gtk_widget_get_sensitive(row_of("Most")->fresh));
}

/* A scan of the past, another program, simulation off. */
static void check_following(void)
{
	CHECK(ladder_sim_show(sim, 1));
	CHECK_SOON(strcmp(shown("Motor"), "0") == 0 && strcmp(shown("Count"), "0") == 0);
	ladder_sim_show_now(sim);
	CHECK_SOON(strcmp(shown("Count"), "1") == 0);
	CHECK(ladder_document_declare(document, -1, "Nobody", "INT", NULL, NULL));
	ladder_document_check_now(document);
	CHECK_SOON(strcmp(shown("Nobody"), "0") == 0);
	CHECK(gtk_widget_grab_focus(row_of("Nobody")->fresh) && ladder_document_undo(document));
	ladder_document_check_now(document);
	CHECK_SOON(is_unknown(row_of("Nobody")));
	CHECK_AS(keys_arrive(window), "a key right after an edit is not lost");
	CHECK(ladder_document_redo(document));
	ladder_sim_end(sim);
	CHECK_SOON(strcmp(shown("Motor"), "") == 0 && strcmp(shown("Nobody"), "") == 0);
}

/* Widgets mark a force in the colours of the sheets, light and dark. */
static void check_colors(void)
{
	AdwStyleManager *manager = adw_style_manager_get_default();
	GtkStyleContext *context = gtk_widget_get_style_context(GTK_WIDGET(view));

	for (int dark = 0; dark < 2; dark++) {
		const struct theme *theme = theme_get(dark ? THEME_DARK : THEME_LIGHT, THEME_GREEN);
		GdkRGBA ground, text;

		adw_style_manager_set_color_scheme(manager, dark ?
			ADW_COLOR_SCHEME_FORCE_DARK : ADW_COLOR_SCHEME_FORCE_LIGHT);
		CHECK(gtk_style_context_lookup_color(context, "force_color", &ground) &&
		      gtk_style_context_lookup_color(context, "force_text_color", &text));
		CHECK(gdk_rgba_equal(&ground, &theme->color[TOKEN_FORCE]) &&
		      gdk_rgba_equal(&text, &theme->color[TOKEN_BADGE]));
	}
	adw_style_manager_set_color_scheme(manager, ADW_COLOR_SCHEME_DEFAULT);
}

/* A line of a file with an instance or a range is a row for each variable, and can be edited. */
static void check_unfolded(void)
{
	GPtrArray *charts = watch_list_read("VIEW\n  status-chart Saved\n    watch auto Start\n"
					    "    watch auto Delay the pause\n"
					    "    watch hex %QX0.0..2\n    watch auto Gone\nEND_VIEW");

	CHECK(watch_list_keep(document, charts, "x"));
	g_ptr_array_unref(charts);
	CHECK_SOON(row_of("Gone") && rows() == 1 + 4 + 3 + 1);
	CHECK(!row_of("Delay") && row_of("Delay.ET") && !is_unknown(row_of("Delay.ET")));
	CHECK(is_unknown(row_of("Gone")) && !row_of("Start")->line->comment[0]);
	CHECK_TEXT(row_of("Delay.IN")->line->comment, "the pause");
	CHECK_AS(file_has("    watch auto Delay the pause\n"), "looking at it changes no file");
	gtk_widget_activate_action(GTK_WIDGET(view), "watch.format", "(ii)", 3, FORMAT_HEX);
	CHECK(file_has("    watch auto Delay.IN the pause\n    watch auto Delay.Q\n"
		       "    watch hex Delay.PT\n    watch auto Delay.ET\n    watch hex %QX0.0\n"));
	CHECK(ladder_document_undo(document) && ladder_document_undo(document));
}

/* The entry of a chart's name refuses that of another chart, and says why. */
static void check_chart_name(void)
{
	GtkWidget *entry;

	do_action("watch.new-chart");
	do_action("watch.rename-chart");
	entry = find_type(find_type(GTK_WIDGET(view), LADDER_TYPE_ENTRY_POPUP), GTK_TYPE_ENTRY);
	gtk_editable_set_text(GTK_EDITABLE(entry), "Chart 1");
	turn(20);
	g_signal_emit_by_name(entry, "activate");
	turn(20);
	CHECK_AS(find_type(GTK_WIDGET(view), LADDER_TYPE_ENTRY_POPUP), "the entry stays open");
	CHECK(has_text(GTK_WIDGET(view), "Another status chart has this name"));
	CHECK(file_has("  status-chart Chart 2\n") || file_has("  status-chart Chart 2\nEND_VIEW"));
	gtk_editable_set_text(GTK_EDITABLE(entry), "Second");
	turn(20);
	g_signal_emit_by_name(entry, "activate");
	CHECK_SOON(!find_type(GTK_WIDGET(view), LADDER_TYPE_ENTRY_POPUP));
	CHECK(file_has("  status-chart Second\nEND_VIEW"));
	CHECK(ladder_document_undo(document) && ladder_document_undo(document));
	CHECK_SOON(rows() == 9);
}

static void check_charts(void)
{
	do_action("watch.new-chart");
	CHECK(rows() == 0 && file_has("  status-chart Chart 2\nEND_VIEW"));
	CHECK(ladder_watch_view_add(view, "Count"));
	CHECK(rows() == 1);
	do_action("watch.delete-chart");
	CHECK(rows() == 9);
	while (ladder_document_undo(document))
		turn(0);
	CHECK_SOON(rows() == 0);
	char *text = ladder_document_text(document, NULL);

	CHECK_TEXT(text, original);
	g_free(text);
}

static void make(void)
{
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/test.rung", sample, strlen(sample), true);
	ladder_document_check_now(document);
	original = ladder_document_text(document, NULL);
	sim = ladder_sim_new(document);
	window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(window), 900, 420);
	view = LADDER_WATCH_VIEW(ladder_watch_view_new(document, sim));
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	screen_show(window);
}

int main(void)
{
	check_print();
	check_parse();
	check_round();
	check_file();
	if (!screen_start() || !gtk_init_check()) {
		tap_skip("the view needs Xvfb");
		return tap_done();
	}
	adw_init();
	app_style();
	make();
	check_local();
	check_once();
	check_making();
	check_running();
	check_forces();
	check_following();
	check_unfolded();
	check_chart_name();
	check_charts();
	check_colors();
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(sim);
	WAIT(G_OBJECT(document)->ref_count == 1);
	g_assert_finalize_object(document);
	g_free(original);
	return tap_done();
}
