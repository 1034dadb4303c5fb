/* SPDX-License-Identifier: MIT
 *
 * test_told - the message below an entry is completely visible, at any length.
 */
#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/kit/entry_row.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

#define LONGEST 200 /* characters */

static GString *telling;

static char *changed(void *context, const char *line, int cursor, bool *good)
{
	(void)context, (void)line, (void)cursor;
	*good = true;
	return g_strdup(telling->str);
}

static bool taken(void *context, const char *line)
{
	(void)context, (void)line;
	return true;
}

static GtkWidget *label_in(GtkWidget *widget, const char *text)
{
	GtkWidget *found = NULL;

	if (GTK_IS_LABEL(widget) && strcmp(gtk_label_get_text(GTK_LABEL(widget)), text) == 0)
		return widget;
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = label_in(child, text);
	return found;
}

/* Is the message as high as it needs in its width, and inside its parent? */
static bool is_whole(GtkWidget *popup)
{
	GtkWidget *label = label_in(popup, telling->str);
	graphene_rect_t bounds;
	int needed;

	if (!label || gtk_widget_get_width(label) == 0)
		return false;
	gtk_widget_measure(label, GTK_ORIENTATION_VERTICAL, gtk_widget_get_width(label),
			   &needed, NULL, NULL, NULL);
	return gtk_widget_get_height(label) >= needed &&
	       gtk_widget_compute_bounds(label, gtk_widget_get_parent(label), &bounds) &&
	       bounds.origin.y + bounds.size.height <=
		       (float)gtk_widget_get_height(gtk_widget_get_parent(label));
}

static void test_lengths(GtkWidget *owner, const char *const *word, int words)
{
	const struct entry_popup_calls calls = { .changed = changed, .taken = taken };
	GtkWidget *popup = ladder_entry_popup_new(owner, "Name", "", false, &calls);

	g_string_truncate(telling, 0);
	ladder_entry_popup_show(LADDER_ENTRY_POPUP(popup), &(GdkRectangle){ 10, 10, 50, 50 });
	for (int i = 0; g_utf8_strlen(telling->str, -1) < LONGEST; i++) {
		g_string_append(telling, word[i % words]);
		ladder_entry_popup_ask(LADDER_ENTRY_POPUP(popup));
		WAIT(is_whole(popup));
		CHECK_AS(is_whole(popup), telling->str);
	}
	ladder_entry_popup_keep(LADDER_ENTRY_POPUP(popup));
}

static int candidates;

static char *offer(void *popup, const char *line, int cursor, bool *good)
{
	(void)line, (void)cursor;
	*good = true;
	for (int i = 0; i < candidates; i++) {
		char text[] = { (char)('A' + i), '\0' };

		for (int twice = 0; twice < 2; twice++)
			ladder_entry_popup_add(*(LadderEntryPopup **)popup,
				&(struct entry_popup_row){ text, (char *)"", (char *)"note",
							   (char *)"variable", text, false });
	}
	return NULL;
}

static int visible_rows(GtkWidget *list)
{
	int count = 0;

	for (GtkWidget *row = gtk_widget_get_first_child(list); row;
	     row = gtk_widget_get_next_sibling(row))
		count += gtk_widget_get_visible(row);
	return count;
}

/* The list has the height of its candidates, each of which is there once. */
static void test_list(GtkWidget *owner)
{
	LadderEntryPopup *popup;
	const struct entry_popup_calls calls = { .context = &popup, .changed = offer,
						 .taken = taken };
	GtkWidget *list, *scroller;
	int needed, taken_up;

	popup = LADDER_ENTRY_POPUP(ladder_entry_popup_new(owner, "Name", "", false, &calls));
	list = find_type(GTK_WIDGET(popup), GTK_TYPE_LIST_BOX);
	scroller = find_type(GTK_WIDGET(popup), GTK_TYPE_SCROLLED_WINDOW);
	ladder_entry_popup_show(popup, &(GdkRectangle){ 10, 10, 50, 50 });
	for (candidates = 1; candidates < 6; candidates++) {
		ladder_entry_popup_ask(popup);
		gtk_widget_measure(list, GTK_ORIENTATION_VERTICAL, -1, NULL, &needed, NULL, NULL);
		gtk_widget_measure(scroller, GTK_ORIENTATION_VERTICAL, -1, NULL, &taken_up, NULL,
				   NULL);
		CHECK_AS(visible_rows(list) == candidates, "no candidate is there twice");
		CHECK_AS(needed > 0 && taken_up == needed, "there is no room for an empty row");
	}
	ladder_entry_popup_keep(popup);
}

/* Has what the row draws a frame? */
static bool is_framed(GtkWidget *row)
{
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GskRenderNode *node;
	GBytes *bytes;
	bool framed;

	GTK_WIDGET_GET_CLASS(row)->snapshot(row, snapshot);
	node = gtk_snapshot_free_to_node(snapshot);
	bytes = gsk_render_node_serialize(node);
	framed = g_strstr_len(g_bytes_get_data(bytes, NULL), (gssize)g_bytes_get_size(bytes),
			      "border {") != NULL;
	g_bytes_unref(bytes);
	gsk_render_node_unref(node);
	return framed;
}

/* A name that would be made has a mark, and room for it. */
static void test_mark(void)
{
	LadderEntryRow *row = LADDER_ENTRY_ROW(g_object_ref_sink(ladder_entry_row_new()));
	int plain, marked;

	ladder_entry_row_say(row, "A name of twenty…", "", "BOOL", "");
	gtk_widget_measure(GTK_WIDGET(row), GTK_ORIENTATION_HORIZONTAL, -1, NULL, &plain, NULL,
			   NULL);
	CHECK(!is_framed(GTK_WIDGET(row)));
	ladder_entry_row_say(row, "A name of twenty…", "", "BOOL", "new");
	gtk_widget_measure(GTK_WIDGET(row), GTK_ORIENTATION_HORIZONTAL, -1, NULL, &marked, NULL,
			   NULL);
	CHECK(is_framed(GTK_WIDGET(row)) && marked > plain);
	g_object_unref(row);
}

int main(void)
{
	static const char *const english[] = { "a new ", "input ", "Pump ", "%IX0.5 ", "or any ",
					       "of ", "its ", "parts, " };
	static const char *const chinese[] = { "新", "变量", "，", "输入", "地址", "的" };
	GtkWidget *window, *owner;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	window = gtk_window_new();
	owner = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	gtk_window_set_child(GTK_WINDOW(window), owner);
	gtk_window_set_default_size(GTK_WINDOW(window), 900, 600);
	screen_show(window);
	telling = g_string_new("");
	test_lengths(owner, english, G_N_ELEMENTS(english));
	test_lengths(owner, chinese, G_N_ELEMENTS(chinese));
	test_list(owner);
	test_mark();
	ladder_entry_popup_drop(owner);
	g_string_free(telling, TRUE);
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
