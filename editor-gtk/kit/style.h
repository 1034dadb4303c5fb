/* SPDX-License-Identifier: MIT
 *
 * style - classes of the style sheet that come and go with what a widget shows.
 */
#ifndef EDITOR_STYLE_H
#define EDITOR_STYLE_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** style_set - gives a widget a class of style.css, or takes it away. */
void style_set(GtkWidget *widget, const char *class, bool on);
/** style_wrong - marks an entry or a cell whose text is refused, also for screen readers. */
void style_wrong(GtkWidget *widget, bool wrong);

#endif
