/* SPDX-License-Identifier: MIT
 *
 * below_part - the part of a page below its sheet: a heading, a button that closes it, and one widget.
 */
#ifndef EDITOR_BELOW_PART_H
#define EDITOR_BELOW_PART_H

#include <gtk/gtk.h>

struct below_part {
	GtkWidget *box;      /* hidden at first                                */
	GtkBox *place;       /* of the widget                                  */
	GtkLabel *heading;
};

/** below_part_init - @closed: of @page, when the button is clicked. @height: px, at least. */
void below_part_init(struct below_part *part, int height, GCallback closed, gpointer page);
/** below_part_follow - calls @entered of @page when @widget, or one in it, gets the focus. */
void below_part_follow(GtkWidget *widget, GCallback entered, gpointer page);

#endif
