/* SPDX-License-Identifier: MIT
 *
 * test_kept - rungs above the screen are laid out later and become higher than was guessed: the screen
 * keeps showing the same rungs.
 */
#include "editor-gtk/ladder/grid_view.h"
#include "tests/editor/sheet_window.h"
#include "tests/editor/strips.h"
#include "tests/tap.h"

#include <string.h>

#define RUNGS 4000 /* more than are laid out while the window opens */

/* Rungs whose comment has three lines, which a guess does not know. */
static char *sample(void)
{
	GString *text = g_string_new("RUNGBOARD 1\n\nPROGRAM Main LD\nVAR\n  A : BOOL;\n  B : BOOL;\nEND_VAR\n");

	for (int i = 0; i < RUNGS; i++)
		g_string_append_printf(text, "RUNG \"Number %d\"\n  (* One line,\n     a second one,\n     and a third. *)\n"
				       "  | NO A | COIL B |\n", i);
	g_string_append(text, "END_PROGRAM\n");
	return g_string_free(text, FALSE);
}

static int count_measured(LadderGridView *view)
{
	int count = 0;

	for (guint i = 0; i < view->strips->len; i++)
		count += strip_of(view, (int)i)->measured;
	return count;
}

static double top_of(LadderGridView *view)
{
	return gtk_adjustment_get_value(view->canvas->adjustment[1]) / view->canvas->zoom;
}

/* How far the first rung on the screen begins above its edge, px. */
static int begins_above(LadderGridView *view, int rung)
{
	return (int)(top_of(view) - strip_of(view, rung)->y);
}

int main(void)
{
	GtkWidget *window, *scroller = NULL;
	char *text = sample();
	LadderDocument *document = sheet_window(text, 900, 600, &window);
	GtkAdjustment *down;
	LadderGridView *view;
	int rung, above;
	float guessed;

	g_free(text);
	if (!document)
		return 0;
	view = LADDER_GRID_VIEW(ladder_grid_view_new(document, 0));
	scroller = gtk_scrolled_window_new();
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), GTK_WIDGET(view));
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(gtk_window_get_child(GTK_WINDOW(window))), scroller);
	down = gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(scroller));
	WAIT(gtk_adjustment_get_page_size(down) > 300 && gtk_adjustment_get_upper(down) > 250000);
	gtk_adjustment_set_value(down, 240000);
	strips_lay_out(LADDER_CANVAS(view), gtk_adjustment_get_page_size(down));
	rung = strips_at(view, (float)top_of(view));
	above = begins_above(view, rung);
	guessed = strip_of(view, rung)->y;
	CHECK_AS(count_measured(view) < RUNGS, "rungs above the screen are not laid out yet");
	CHECK_SOON(count_measured(view) == RUNGS);
	CHECK_AS(strip_of(view, rung)->y > guessed + 500, "they are higher than was guessed");
	CHECK_AS(strips_at(view, (float)top_of(view)) == rung && begins_above(view, rung) == above,
		 "the same rung is at the same place of the screen");
	gtk_window_destroy(GTK_WINDOW(window));
	g_object_unref(document);
	return tap_done();
}
