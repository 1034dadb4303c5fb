/* SPDX-License-Identifier: MIT
 *
 * test_narrow - the lists in German, as wide as a window of 1024 px has room for: columns share
 * the width, so that no text is cut beside free room, and all headings are seen.
 */
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/address_view.h"
#include "editor-gtk/panels/log_view.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/panels/symbols_view.h"
#include "editor-gtk/panels/tasks_view.h"
#include "editor-gtk/panels/types_view.h"
#include "editor-gtk/panels/uses_view.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <libintl.h>
#include <locale.h>

#define WIDE 790  /* px beside the project, in a window of 1024                  */
#define SIMULATING 733 /* the same, beside the panel of the simulation          */
#define STEP 7    /* px from one width of the window to the next                  */
#define LONG 210  /* a text may be cut if it is wider                            */

static const char sample[] =
	"RUNGBOARD 1\n\nTYPE\n  Recipe : STRUCT\n    Steps : ARRAY[1..12] OF DINT; (* of a batch *)\n"
	"  END_STRUCT;\n  Percent : INT (-32768..32767) := 1000; (* of the belt *)\nEND_TYPE\n\n"
	"CONFIGURATION Plant\nVAR_GLOBAL\n  StopButton AT %IX0.0 : BOOL;\n  Batches : ARRAY[1..12] OF DINT;\n"
	"  Count : INT;\n  Mix : Recipe;\nEND_VAR\n  RESOURCE Cpu ON LINUX\n"
	"    TASK Fast (INTERVAL := T#5ms, PRIORITY := 1); (* counts *)\n"
	"    PROGRAM Instance WITH Fast : Main;\n  END_RESOURCE\nEND_CONFIGURATION\n\n"
	"PROGRAM Main LD\nVAR\n  Counter : CTU;\nEND_VAR\n"
	"RUNG\n  | NO StopButton | CTU Counter R:=StopButton PV:=10 CV=>Count | |\nEND_PROGRAM\n";

static GtkWidget *window;

static void in_german(void)
{
	const char *build = g_getenv("BUILD");
	char *locale = g_build_filename(build ? build : "build", "locale", NULL);

	g_setenv("LANGUAGE", "de", TRUE);
	setlocale(LC_ALL, "");
	bindtextdomain(GETTEXT_PACKAGE, locale);
	bind_textdomain_codeset(GETTEXT_PACKAGE, "UTF-8");
	textdomain(GETTEXT_PACKAGE);
	g_free(locale);
}

/* Counts the labels below @widget that end in an ellipsis though they are not long. @seen: all. */
static int count_cut(GtkWidget *widget, int *seen)
{
	int cut = 0;

	if (!gtk_widget_get_mapped(widget))
		return 0;
	if (GTK_IS_LABEL(widget) && gtk_label_get_text(GTK_LABEL(widget))[0]) {
		PangoLayout *layout = gtk_label_get_layout(GTK_LABEL(widget));
		PangoLayout *whole = gtk_widget_create_pango_layout(widget,
			gtk_label_get_text(GTK_LABEL(widget)));
		int width;

		pango_layout_get_pixel_size(whole, &width, NULL);
		(*seen)++;
		cut = pango_layout_is_ellipsized(layout) && width < LONG;
		if (cut)
			printf("# %s\n", gtk_label_get_text(GTK_LABEL(widget)));
		g_object_unref(whole);
	}
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child;
	     child = gtk_widget_get_next_sibling(child))
		cut += count_cut(child, seen);
	return cut;
}

static GtkWidget *inside(GtkWidget *widget, GType type)
{
	GtkWidget *found = G_TYPE_CHECK_INSTANCE_TYPE(widget, type) ? widget : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = gtk_widget_get_visible(child) ? inside(child, type) : NULL;
	return found;
}

/* Px beyond the right edge of the list. */
static int beyond(GtkWidget *list)
{
	GtkAdjustment *across = gtk_scrollable_get_hadjustment(GTK_SCROLLABLE(list));

	return (int)(gtk_adjustment_get_upper(across) - gtk_adjustment_get_page_size(across));
}

/* @all: the headings fit, too. */
static void check(GtkWidget *view, const char *name, bool all)
{
	GtkWidget *list;
	int seen = 0, cut = 1;

	gtk_window_set_child(GTK_WINDOW(window), view);
	screen_show(window);
	list = inside(view, GTK_TYPE_COLUMN_VIEW);
	WAIT(gtk_widget_get_width(list) > 0 && (!all || beyond(list) <= 0) &&
	     (seen = 0, cut = count_cut(list, &seen)) == 0 && seen > 4);
	CHECK_AS(seen > 4, name);
	CHECK_AS(cut == 0, name);
	CHECK_AS(!all || beyond(list) <= 0, name);
}

static GtkWidget *uses(LadderDocument *document)
{
	LadderUsesView *view = LADDER_USES_VIEW(ladder_uses_view_new());

	ladder_uses_view_set_document(view, document);
	ladder_uses_view_set_symbol(view, 0, "StopButton");
	return GTK_WIDGET(view);
}

static GtkWidget *symbols(LadderDocument *document)
{
	LadderSymbolsView *view = LADDER_SYMBOLS_VIEW(ladder_symbols_view_new());

	ladder_symbols_view_set_document(view, document);
	return GTK_WIDGET(view);
}

static GtkWidget *subrange(LadderDocument *document)
{
	GtkWidget *view = ladder_types_view_new(document);

	ladder_types_view_show(LADDER_TYPES_VIEW(view), type_find(document, "Percent"));
	return view;
}

static GtkWidget *problems(LadderDocument *document)
{
	GtkWidget *view = ladder_problems_new();

	ladder_problems_set_document(LADDER_PROBLEMS(view), document);
	return view;
}

static gboolean count_frame(GtkWidget *widget, GdkFrameClock *clock, gpointer frames)
{
	(void)widget;
	(void)clock;
	++*(int *)frames;
	return G_SOURCE_CONTINUE;
}

/* Columns share the width in an idle call behind the frame in which the list has got it; then they are
 * laid out again. */
static void settle(GtkWidget *view)
{
	int frames = 0;
	const guint tick = gtk_widget_add_tick_callback(view, count_frame, &frames, NULL);

	WAIT(frames >= 4);
	gtk_widget_remove_tick_callback(view, tick);
}

/* Beside the panel of a simulation, and in wider windows: many names in a row do not cut the bytes. */
static void check_addresses(void)
{
	LadderDocument *document = ladder_document_new();
	GString *text = g_string_new("RUNGBOARD 1\n\nVAR\n");
	GtkWidget *view;
	int seen = 0;

	for (int i = 0; i < 8; i++)
		g_string_append_printf(text, "  ButtonOfStation%d AT %%IX0.%d : BOOL;\n", i, i);
	g_string_append(text, "END_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO ButtonOfStation1 | COIL %QX0.0 |\nEND_PROGRAM\n");
	ladder_document_open_text(document, NULL, text->str, text->len, true);
	ladder_document_check_now(document);
	gtk_window_set_child(GTK_WINDOW(window), NULL);
	view = ladder_address_view_new(document);
	check(view, "Adressbelegung", true);
	for (int wide = WIDE + 30; wide >= SIMULATING; wide -= STEP) {
		gtk_window_set_default_size(GTK_WINDOW(window), wide, 300);
		CHECK_SOON(gtk_widget_get_width(window) == wide);
		settle(view);
		CHECK_AS(count_cut(view, &seen) == 0 && seen > 4, "no byte is cut");
	}
	gtk_window_set_child(GTK_WINDOW(window), NULL);
	WAIT(G_OBJECT(document)->ref_count == 1);
	g_assert_finalize_object(document);
	g_string_free(text, TRUE);
}

/* A long message is there as a whole, without scrolling sideways. */
static void check_log(LadderDocument *document)
{
	GtkWidget *view = ladder_log_view_new(document), *text;
	GString *long_one = g_string_new("begin");
	GdkRectangle first, last;
	GtkTextBuffer *buffer;
	GtkTextIter at;

	for (int i = 0; i < 60; i++)
		g_string_append_printf(long_one, " message%d", i);
	gtk_window_set_child(GTK_WINDOW(window), view);
	screen_show(window);
	ladder_log_view_put(view, LOG_OPERATOR, 0, long_one->str);
	text = inside(view, GTK_TYPE_TEXT_VIEW);
	buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(text));
	WAIT(gtk_widget_get_width(text) > 0);
	gtk_text_buffer_get_end_iter(buffer, &at);
	gtk_text_iter_set_line_offset(&at, 0);
	gtk_text_view_get_iter_location(GTK_TEXT_VIEW(text), &at, &first);
	CHECK(gtk_text_view_forward_display_line(GTK_TEXT_VIEW(text), &at));
	gtk_text_view_get_iter_location(GTK_TEXT_VIEW(text), &at, &last);
	CHECK_AS(last.y > first.y && last.x > first.x, "it goes on below, behind time and kind");
	g_string_free(long_one, TRUE);
}

/* Says how many warnings there are, in the right form. */
static void check_count(LadderDocument *document, GtkWidget *log, const char *vars, const char *want)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(
		inside(log, GTK_TYPE_TEXT_VIEW)));
	char *text = g_strdup_printf("RUNGBOARD 1\n\nVAR\n%sEND_VAR\n\nPROGRAM Main LD\nRUNG\n"
		"  | NO %%IX0.0 | COIL %%QX0.0 |\nEND_PROGRAM\n", vars), *all;
	GtkTextIter first, last;

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	ladder_document_check_now(document);
	gtk_text_buffer_get_bounds(buffer, &first, &last);
	all = gtk_text_buffer_get_text(buffer, &first, &last, TRUE);
	CHECK_AS(g_str_has_suffix(all, want), all);
	g_free(all);
	g_free(text);
}

static void check_counts(void)
{
	LadderDocument *document = ladder_document_new();
	GtkWidget *log = g_object_ref_sink(ladder_log_view_new(document));

	check_count(document, log, "  A : INT;\n", "\t0 Fehler, 1 Warnung");
	check_count(document, log, "  A : INT;\n  B : INT;\n", "\t0 Fehler, 2 Warnungen");
	g_object_unref(log);
	g_object_unref(document);
}

int main(void)
{
	LadderDocument *document;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	in_german();
	if (strcmp(_("Address"), "Adresse") != 0) {
		printf("1..0 # SKIP the languages were not built: no msgfmt\n");
		return 0;
	}
	adw_init();
	window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(window), WIDE, 300);
	document = ladder_document_new();
	ladder_document_open_text(document, "/tmp/x/test.rung", sample, strlen(sample), true);
	ladder_document_check_now(document);
	check(uses(document), "Querverweise", true);
	check(problems(document), "Probleme", true);
	check(ladder_tasks_view_new(document), "Tasks", false);
	check(ladder_types_view_new(document), "Datentypen", true);
	check(subrange(document), "Datentypen", true);
	check(symbols(document), "Symbole", false);
	check_addresses();
	check_log(document);
	check_counts();
	gtk_window_destroy(GTK_WINDOW(window));
	WAIT(G_OBJECT(document)->ref_count == 1);
	g_assert_finalize_object(document);
	return tap_done();
}
