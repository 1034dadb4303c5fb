/* SPDX-License-Identifier: MIT
 *
 * test_palette - the focus goes backwards over families that were opened and closed. A critical
 * message of GTK ends the test.
 */
#include "editor-gtk/panels/palette.h"
#include "tests/editor/sheet_window.h"

static int families;

/* Opens and closes each family, then asks it for the focus from behind. */
static void go_over(GtkWidget *widget)
{
	if (GTK_IS_EXPANDER(widget)) {
		families++;
		gtk_expander_set_expanded(GTK_EXPANDER(widget), TRUE);
		turn(20);
		gtk_expander_set_expanded(GTK_EXPANDER(widget), FALSE);
		turn(20);
		CHECK_AS(gtk_widget_child_focus(widget, GTK_DIR_TAB_BACKWARD) && gtk_widget_has_focus(widget),
			 "the heading of a closed family gets the focus");
		gtk_expander_set_expanded(GTK_EXPANDER(widget), TRUE);
		turn(20);
		CHECK_AS(gtk_widget_child_focus(widget, GTK_DIR_TAB_FORWARD) && !gtk_widget_has_focus(widget),
			 "a tile of an open family gets it");
		return;
	}
	for (GtkWidget *child = gtk_widget_get_first_child(widget); child; child = gtk_widget_get_next_sibling(child))
		go_over(child);
}

int main(void)
{
	GtkWidget *window, *palette;
	LadderDocument *document = sheet_window("RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n",
						900, 600, &window);

	if (!document)
		return 0;
	palette = ladder_palette_new(document);
	gtk_window_set_child(GTK_WINDOW(window), palette);
	WAIT(gtk_widget_get_width(palette) > 0);
	go_over(palette);
	CHECK_AS(families > 5, "the palette has families");
	gtk_window_destroy(GTK_WINDOW(window));
	turn(20);
	g_object_unref(document);
	return tap_done();
}
