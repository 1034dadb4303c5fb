/* SPDX-License-Identifier: MIT
 *
 * test_tab_title - in a bar of any width each title is there as a whole, or ends in an ellipsis inside its tab.
 */
#include "editor-gtk/kit/gtk48/tab_title.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <string.h>

#define TABS 4

static const char *const titles[TABS] = { "Main", "Types de donn\303\251es", "Aper\303\247u avant",
	"\xe6\x89\x93\xe5\x8d\xb0\xe9\xa2\x84\xe8\xa7\x88\xe5\x92\x8c\xe6\x89\x93\xe5\x8d\xb0\xe9\xa2\x84\xe8\xa7\x88" };

static AdwTabBar *bar;
static int seen, cut, wrong;

/* Looks at a title whose tab has @room px for it. */
static void judge(GtkLabel *label, int room)
{
	PangoLayout *whole = gtk_widget_create_pango_layout(GTK_WIDGET(label), gtk_label_get_text(label));
	const bool ends = pango_layout_is_ellipsized(gtk_label_get_layout(label));
	int width;

	pango_layout_get_pixel_size(whole, &width, NULL);
	g_object_unref(whole);
	seen++;
	cut += ends;
	wrong += ends != (width > room) || gtk_widget_get_width(GTK_WIDGET(label)) > room;
}

static void look(GtkWidget *widget)
{
	GtkWidget *child = gtk_widget_get_first_child(widget);

	if (strcmp(G_OBJECT_TYPE_NAME(widget), "AdwFadingLabel") == 0 && gtk_widget_get_width(widget) > 0) {
		judge(GTK_LABEL(child), gtk_widget_get_width(widget));
		return;
	}
	for (; child; child = gtk_widget_get_next_sibling(child))
		look(child);
}

static bool is_good(bool some)
{
	seen = cut = wrong = 0;
	look(GTK_WIDGET(bar));
	return seen == TABS && wrong == 0 && (cut > 0) == some;
}

static void check_width(GtkWidget *window, int width, bool some)
{
	gtk_window_set_default_size(GTK_WINDOW(window), width, 200);
	WAIT(gtk_widget_get_width(window) == width && is_good(some));
	if (!CHECK_AS(is_good(some), "titles fit"))
		printf("# %d px: %d titles, %d end in an ellipsis, %d wrong\n", width, seen, cut, wrong);
}

int main(void)
{
	AdwTabView *view;
	GtkWidget *window, *box;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	window = gtk_window_new();
	box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	view = ADW_TAB_VIEW(adw_tab_view_new());
	bar = ADW_TAB_BAR(adw_tab_bar_new());
	adw_tab_bar_set_view(bar, view);
	tab_titles_mend(bar);
	gtk_box_append(GTK_BOX(box), GTK_WIDGET(bar));
	gtk_box_append(GTK_BOX(box), GTK_WIDGET(view));
	gtk_window_set_child(GTK_WINDOW(window), box);
	for (int i = 0; i < TABS; i++)
		adw_tab_page_set_title(adw_tab_view_append(view, gtk_label_new(titles[i])), titles[i]);
	gtk_window_set_default_size(GTK_WINDOW(window), 500, 200);
	gtk_window_present(GTK_WINDOW(window));
	for (int width = 440; width < 560; width += 27)
		check_width(window, width, true);
	check_width(window, 790, false);
	check_width(window, 480, true);
	adw_tab_page_set_title(adw_tab_view_get_nth_page(view, 0), "A longer title for the first tab");
	CHECK_SOON(is_good(true) && cut == 3);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
