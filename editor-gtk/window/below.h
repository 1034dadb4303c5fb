/* SPDX-License-Identifier: MIT
 *
 * below - the panels below the sheets.
 *
 * Most are never looked at while a window is open: a panel is made when it is first seen or
 * asked for.
 */
#ifndef EDITOR_BELOW_H
#define EDITOR_BELOW_H

#include "editor-gtk/window/core.h"

struct below {
	struct core *core;
	GtkPaned *paned;       /* sheets above, panels below                     */
	GtkBox *box;
	GtkStack *stack;
	GtkWidget *switcher;
	GtkScrolledWindow *tabs;
	GtkMenuButton *more;   /* seen when not all tabs are                     */
};

typedef GtkWidget *below_make(gpointer part);

void below_init(struct below *below, struct core *core);
/** below_add - a tab for a panel that @make(@part) makes. @name: lives for ever. @title: not
 * translated. */
void below_add(struct below *below, const char *name, const char *title, below_make *make,
	       gpointer part);
/** below_panel - by the name of its tab; made now, if nobody has seen it yet. Borrowed. */
GtkWidget *below_panel(struct below *below, const char *name);
/** below_made - the same; NULL: nobody has seen it yet. */
GtkWidget *below_made(struct below *below, const char *name);
/** below_show - the same, brought to the front. */
GtkWidget *below_show(struct below *below, const char *name);
/** below_show_error - the list of problems, with the keys at the first error. */
void below_show_error(struct below *below);
/** below_offer - whether its tab is shown. */
void below_offer(struct below *below, const char *name, bool offered);
/** below_set_title - @title: translated. */
void below_set_title(struct below *below, const char *name, const char *title);
/** below_make_room - @panel px for the panels, if the sheets keep @sheet px. */
void below_make_room(struct below *below, int panel, int sheet);

#endif
