/* SPDX-License-Identifier: MIT
 *
 * test_shrink - a button becomes narrower than its text, also with a text that is set later.
 */
#include "editor-gtk/kit/gtk48/shrink.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#define LONG "a text of a button that is longer than usual"

int main(void)
{
	GtkWidget *box, *button;
	int least, natural, before;

	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	box = g_object_ref_sink(gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0));
	button = gtk_button_new_with_label(LONG);
	gtk_box_append(GTK_BOX(box), button);
	gtk_box_append(GTK_BOX(box), gtk_button_new_from_icon_name("list-add-symbolic"));
	gtk_widget_measure(button, GTK_ORIENTATION_HORIZONTAL, -1, &least, &before, NULL, NULL);
	CHECK_AS(least == before, "GTK: never narrower than its text");
	shrink_buttons(box);
	gtk_widget_measure(button, GTK_ORIENTATION_HORIZONTAL, -1, &least, &natural, NULL, NULL);
	CHECK(least < before / 2 && natural == before);
	gtk_button_set_label(GTK_BUTTON(button), LONG LONG);
	gtk_widget_measure(button, GTK_ORIENTATION_HORIZONTAL, -1, &least, &natural, NULL, NULL);
	CHECK(least < before / 2 && natural > before);
	g_object_unref(box);
	return tap_done();
}
