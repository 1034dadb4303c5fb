/* SPDX-License-Identifier: MIT
 *
 * test_below_tabs - the tabs of the panels below, in each language, after random sizes, panels, scrolling and
 * focus: each tab that has room is drawn, with its whole label, and each that is cut is not.
 */
#include "editor-gtk/kit/gtk48/slow_bar.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/app.h"
#include "editor-gtk/window/window.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#include <gtksourceview/gtksource.h>
#include <libintl.h>
#include <locale.h>
#include <string.h>

#define ACTS 60 /* in each language */

static const char sample[] =
	"RUNGBOARD 1\n\nVAR\n  Start AT %IX0.0 : BOOL;\n  Motor AT %QX0.0 : BOOL;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | NO Start | COIL Motor |\nEND_PROGRAM\n";
static const char *const panels[] = { "problems", "uses", "watch", "timing", "scenarios", "list", "log", "board" };
static const int widths[] = { 1024, 1024, 900, 1100, 1280, 1440 };

static GtkWidget *window, *tabs;
static GtkAdjustment *along;

static GtkWidget *find_tabs(GtkWidget *within)
{
	GtkWidget *found = gtk_widget_has_css_class(within, "below-tabs") ? within : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(within); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = find_tabs(child);
	return found;
}

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

static void open_window(void)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	window = GTK_WIDGET(ladder_window_new(NULL, document));
	g_object_unref(document);
	gtk_window_set_default_size(GTK_WINDOW(window), 1024, 700);
	ladder_window_opened(LADDER_WINDOW(window));
	screen_show(window);
	tabs = find_tabs(window);
	along = gtk_scrolled_window_get_hadjustment(GTK_SCROLLED_WINDOW(
		gtk_widget_get_ancestor(tabs, GTK_TYPE_SCROLLED_WINDOW)));
}

static bool is_drawn(GtkWidget *tab)
{
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GskRenderNode *node;
	int least, wanted;

	gtk_widget_snapshot_child(tabs, tab, snapshot);
	node = gtk_snapshot_free_to_node(snapshot);
	gtk_widget_measure(tab, GTK_ORIENTATION_HORIZONTAL, -1, &least, &wanted, NULL, NULL);
	if (!node)
		return false;
	gsk_render_node_unref(node);
	return gtk_widget_get_mapped(tab) && gtk_widget_get_width(tab) > 0 && least > 0;
}

/* NULL: all is right. */
static const char *wrong(void)
{
	const double left = gtk_adjustment_get_value(along), right = left + gtk_adjustment_get_page_size(along);
	int drawn = 0, room = 0;

	for (GtkWidget *tab = gtk_widget_get_first_child(tabs); tab; tab = gtk_widget_get_next_sibling(tab)) {
		graphene_rect_t at;

		if (!gtk_widget_get_visible(tab))
			continue;
		if (!gtk_widget_compute_bounds(tab, tabs, &at))
			return "a tab has no place";
		if (at.origin.x >= left - 0.5 && at.origin.x + at.size.width <= right + 0.5) {
			room++;
			drawn += is_drawn(tab);
		} else if (gtk_widget_get_mapped(tab) && (at.origin.x < left - 1.5 || at.origin.x + at.size.width > right + 1.5)) {
			return "a tab that is cut is drawn";
		}
	}
	return !room ? "no tab has room" : drawn < room ? "a tab with room is not drawn" : NULL;
}

static const char *state; /* after the last frame                              */
static int frames;

/* After a frame everything has its place. */
static void painted(void)
{
	frames++;
	state = gtk_widget_get_mapped(tabs) ? wrong() : NULL;
}

static GtkWidget *any_tab(GRand *dice)
{
	GtkWidget *tab = gtk_widget_get_first_child(tabs);

	for (int i = g_rand_int_range(dice, 0, 9); i > 0 && gtk_widget_get_next_sibling(tab); i--)
		tab = gtk_widget_get_next_sibling(tab);
	return tab;
}

/* Returns what it does. */
static const char *act(GRand *dice)
{
	switch (g_rand_int_range(dice, 0, 6)) {
	case 0:
		gtk_window_set_default_size(GTK_WINDOW(window), widths[g_rand_int_range(dice, 0, G_N_ELEMENTS(widths))],
					    g_rand_int_range(dice, 560, 800));
		return "a size";
	case 1:
		gtk_widget_activate_action(window, "win.show-panel", "s",
					   panels[g_rand_int_range(dice, 0, G_N_ELEMENTS(panels))]);
		return "a panel";
	case 2:
		gtk_adjustment_set_value(along, g_rand_double_range(dice, 0, gtk_adjustment_get_upper(along)));
		return "the wheel over the tabs";
	case 3:
		gtk_widget_grab_focus(any_tab(dice));
		return "the focus on a tab";
	case 4:
		gtk_widget_activate_action(window, "win.side", NULL);
		return "the panel at the side";
	default:
		gtk_widget_activate_action(window, "win.below", NULL);
		gtk_widget_activate_action(window, "win.below", NULL);
		return "the panels hidden and shown";
	}
}

static void test_language(const char *language)
{
	GRand *dice = g_rand_new_with_seed(7);
	const char *done = "opened";
	GdkFrameClock *clock;
	int bad = 0;

	speak(language);
	CHECK_AS((strcmp(_("Problems"), "Problems") != 0) == (strcmp(language, "en") != 0), "the texts of the language are there");
	open_window();
	clock = gtk_widget_get_frame_clock(window);
	g_signal_connect(clock, "after-paint", G_CALLBACK(painted), NULL);
	gdk_frame_clock_begin_updating(clock);
	for (int i = 0; i < ACTS && !bad; i++) {
		frames = 0;
		WAIT(frames > 3 && !state);
		if (state) {
			printf("# %s, act %d, after %s: %s\n", language, i, done, state);
			bad++;
		}
		done = act(dice);
	}
	CHECK_AS(bad == 0, language);
	g_rand_free(dice);
	g_signal_handlers_disconnect_by_func(clock, G_CALLBACK(painted), NULL);
	gdk_frame_clock_end_updating(clock);
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
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
	for (gsize i = 0; i < G_N_ELEMENTS(languages); i++)
		test_language(languages[i]);
	return tap_done();
}
