/* SPDX-License-Identifier: MIT
 *
 * spoken - what the toolkit's widgets leave out for a screen reader, or tell too much of.
 *
 * GTK 4.8 calls the button within a drop-down "GtkToggleButton", and libadwaita's cross of a
 * tab "GtkImage": so a screen reader says it. What is ours has its name where it is made.
 * And it tells of what is in a revealer that is closed: a message that is over.
 */
#ifndef EDITOR_SPOKEN_H
#define EDITOR_SPOKEN_H

#include <gtk/gtk.h>

/** spoken_parts - mends what is found below @root now. */
void spoken_parts(GtkWidget *root);
/** spoken_text - @label is there while it has a text: an empty one is called "GtkLabel". */
void spoken_text(GtkLabel *label);

#endif
