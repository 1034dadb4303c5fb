/* SPDX-License-Identifier: MIT
 *
 * test_tips - the tooltip of a cell tells each fault of it, the first one and those that follow.
 */
#include "editor-gtk/ladder/grid_view.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <adwaita.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\n"
	"PROGRAM Main LD\nVAR\n  Lamp : BOOL;\n  Speed : INT;\nEND_VAR\n"
	"RUNG\n  | NO Absent | NC Gone | COIL Lamp |\n"
	"RUNG\n  | NO Speed | COIL Lamp |\nEND_PROGRAM\n";

static LadderGridView *view;

/* Does the tooltip of this cell tell an error with @text? */
static bool tells(int rung, int col, const char *text)
{
	char *tip = ladder_grid_view_tip(view, rung, 0, col);
	const char *error = tip ? strstr(tip, "Error: ") : NULL;
	const bool found = error && strstr(error, text);

	g_free(tip);
	return found;
}

int main(void)
{
	GtkWidget *window;
	LadderDocument *document;
	char *tip;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	document = ladder_document_new();
	ladder_document_open_text(document, NULL, sample, strlen(sample), true);
	window = gtk_window_new();
	view = LADDER_GRID_VIEW(ladder_grid_view_new(document, 0));
	gtk_window_set_child(GTK_WINDOW(window), GTK_WIDGET(view));
	screen_show(window);
	CHECK_SOON(tells(0, 0, "Absent"));
	CHECK_SOON(tells(0, 1, "Gone"));
	CHECK_SOON(tells(1, 0, "Speed"));
	CHECK_AS(!tells(0, 0, "Gone"), "a cell tells its own faults");
	tip = ladder_grid_view_tip(view, 0, 0, 2);
	CHECK_AS(tip && !strstr(tip, "Error"), "a cell without a fault tells none");
	g_free(tip);
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(document);
	return tap_done();
}
