/* SPDX-License-Identifier: MIT
 *
 * spoken - names for those parts of the toolkit's widgets that it leaves without one.
 *
 * GTK 4.8 calls the button within a drop-down "GtkToggleButton", and libadwaita's cross of a
 * tab "GtkImage": so a screen reader says it. What is ours has its name where it is made.
 */
#ifndef EDITOR_SPOKEN_H
#define EDITOR_SPOKEN_H

#include <gtk/gtk.h>

/** spoken_parts - names what is found below @root now. */
void spoken_parts(GtkWidget *root);

#endif
