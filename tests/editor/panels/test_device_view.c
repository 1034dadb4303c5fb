/* SPDX-License-Identifier: MIT
 *
 * test_device_view - the state of a real board: its speed, and how the start before came about, after an
 * orderly end and after a kill.
 */
#include "editor-gtk/panels/device_view.h"
#include "tests/editor/online/board.h"
#include "tests/editor/screen.h"
#include "tests/editor/widgets.h"

#include <adwaita.h>
#include <string.h>

static GtkWidget *view;

/* The text beside a name in the first list; NULL: there is no such row. */
static const char *fact_of(const char *name)
{
	GtkGrid *grid = GTK_GRID(find_type(view, GTK_TYPE_GRID));
	GtkWidget *label;

	for (int row = 0; grid && (label = gtk_grid_get_child_at(grid, 0, row)); row++)
		if (strcmp(gtk_label_get_text(GTK_LABEL(label)), name) == 0)
			return gtk_label_get_text(GTK_LABEL(gtk_grid_get_child_at(grid, 1, row)));
	return NULL;
}

static bool says(const char *name, const char *text)
{
	const char *fact = fact_of(name);

	return fact && strcmp(fact, text) == 0;
}

int main(void)
{
	struct test_board board = { .empty = false };
	GtkWidget *window;
	LadderBoardLink *link;
	char *why = NULL;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	board_open(&board, "eng");
	link = ladder_board_link_new();
	window = gtk_window_new();
	view = ladder_device_view_new(link);
	gtk_window_set_child(GTK_WINDOW(window), view);
	gtk_window_present(GTK_WINDOW(window));
	CHECK(ladder_board_link_connect(link, board.where, &why));
	CHECK_SOON(says("Mode", "RUN"));
	CHECK_SOON(fact_of("Speed of the board, words/ms") && atoi(fact_of("Speed of the board, words/ms")) > 0);
	CHECK_AS(!fact_of("Before this start"), "nothing is known of before the first start");
	board_stop(&board);
	board_start(&board);
	CHECK_SOON(says("Before this start", "ladderd ended"));
	g_subprocess_force_exit(board.daemon);
	g_subprocess_wait(board.daemon, NULL, NULL);
	board_start(&board);
	CHECK_SOON(says("Before this start", "ladderd had ended abnormally; ladder-guard did not start it again"));
	ladder_board_link_disconnect(link);
	CHECK_SOON(!ladder_board_link_status(link));
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(link);
	board_close(&board);
	return tap_done();
}
