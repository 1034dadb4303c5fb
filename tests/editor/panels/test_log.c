/* SPDX-License-Identifier: MIT
 *
 * test_log - the log tells edits, saves and errors, a button hides a kind of message, and the last 1,000 are kept.
 */
#include "editor-gtk/panels/log_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/editor/widgets.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <glib/gstdio.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nVAR\n  Lamp : BOOL;\nEND_VAR\n"
	"RUNG\n  | NO %IX0.0 | COIL Lamp |\nEND_PROGRAM\n";

static GtkWidget *view;

/* Does the log show this text? */
static bool says(const char *text)
{
	GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(find_type(view, GTK_TYPE_TEXT_VIEW)));
	GtkTextIter start, end;
	char *all;
	bool found;

	gtk_text_buffer_get_bounds(buffer, &start, &end);
	all = gtk_text_buffer_get_text(buffer, &start, &end, TRUE);
	found = strstr(all, text) != NULL;
	g_free(all);
	return found;
}

static GtkToggleButton *button_of(const char *label)
{
	GtkWidget *box = gtk_widget_get_parent(find_type(view, GTK_TYPE_TOGGLE_BUTTON)), *each;

	for (each = gtk_widget_get_first_child(box); each; each = gtk_widget_get_next_sibling(each))
		if (strcmp(gtk_button_get_label(GTK_BUTTON(each)), label) == 0)
			return GTK_TOGGLE_BUTTON(each);
	return NULL;
}

static void test_document(LadderDocument *document)
{
	const gsize at = (gsize)(strstr(sample, "Lamp |") - sample);
	char *folder = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *path = g_build_filename(folder, "lamp.rung", NULL);

	CHECK(says("new project"));
	CHECK(ladder_document_replace_step(document, at, 4, "Lump", "Rename the lamp") == NULL);
	CHECK_AS(says("Rename the lamp"), "an edit is told at once");
	CHECK_SOON(says("1 error"));
	CHECK(ladder_document_save(document, path, NULL));
	CHECK_AS(says(path), "a save is told with its file");
	gtk_toggle_button_set_active(button_of("Operator"), FALSE);
	CHECK_AS(!says("Rename the lamp") && says(path), "a button hides one kind");
	gtk_toggle_button_set_active(button_of("Operator"), TRUE);
	CHECK_AS(says("Rename the lamp"), "and shows it again");
	g_remove(path);
	g_rmdir(folder);
	g_free(path);
	g_free(folder);
}

static void test_most(void)
{
	for (int i = 0; i < 1000; i++) {
		char text[40];

		g_snprintf(text, sizeof(text), "message <%d>", i);
		ladder_log_view_put(view, LOG_COMMUNICATION, 0, text);
	}
	CHECK_AS(says("message <0>") && says("message <999>") && !says("new project"), "1,000 messages are kept");
	ladder_log_view_put(view, LOG_COMMUNICATION, 0, "one more");
	CHECK_AS(says("one more") && !says("message <0>") && says("message <1>"), "the oldest goes first");
}

int main(void)
{
	GtkWidget *window;
	LadderDocument *document;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	window = gtk_window_new();
	view = ladder_log_view_new(document);
	gtk_window_set_child(GTK_WINDOW(window), view);
	screen_show(window);
	test_document(document);
	test_most();
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(document);
	return tap_done();
}
