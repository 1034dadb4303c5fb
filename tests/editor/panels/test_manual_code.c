/* SPDX-License-Identifier: MIT
 *
 * test_manual_code - lines of code in a page of the manual: none goes beyond the edge of a narrow window.
 */
#include "editor-gtk/panels/manual_page.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#define WIDE 400 /* px of the page                                            */

static const char source[] =
	"# Page\n\n```\nmake                                # builds the editor, if GTK 4 is installed\n"
	"short\n"
	"Averyveryveryveryveryveryveryveryveryveryveryveryveryveryveryveryverylongnamewithoutanyblank\n```\n";

static gboolean no_link(GtkLabel *label, const char *link, gpointer data)
{
	(void)label;
	(void)link;
	(void)data;
	return FALSE;
}

/* Px of the character that is furthest to the right. */
static int right_edge(GtkTextView *view)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(view);
	GtkTextIter at;
	GdkRectangle place;
	int most = 0;

	gtk_text_buffer_get_start_iter(buffer, &at);
	for (; !gtk_text_iter_is_end(&at); gtk_text_iter_forward_char(&at)) {
		gtk_text_view_get_iter_location(view, &at, &place);
		if (!g_unichar_isspace(gtk_text_iter_get_char(&at)))
			most = MAX(most, place.x + place.width);
	}
	return most;
}

int main(void)
{
	GtkWidget *window, *view, *scroller;
	struct manual_text text;
	struct md_page *page;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	page = markdown_read(source, sizeof(source) - 1);
	if (!page) {
		printf("1..0 # SKIP built without md4c\n");
		return 0;
	}
	window = gtk_window_new();
	view = gtk_text_view_new();
	scroller = gtk_scrolled_window_new();
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER, GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), view);
	gtk_window_set_child(GTK_WINDOW(window), scroller);
	gtk_window_set_default_size(GTK_WINDOW(window), WIDE, 300);
	manual_text_init(&text, GTK_TEXT_VIEW(view));
	manual_text_show(&text, page, ".", no_link, NULL);
	gtk_window_present(GTK_WINDOW(window));
	CHECK_SOON(gtk_widget_get_width(view) == WIDE && right_edge(GTK_TEXT_VIEW(view)) > WIDE / 2);
	CHECK_SOON(right_edge(GTK_TEXT_VIEW(view)) <= WIDE);
	manual_text_clear(&text);
	gtk_window_destroy(GTK_WINDOW(window));
	markdown_free(page);
	return tap_done();
}
