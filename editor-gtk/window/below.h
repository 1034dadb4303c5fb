/* SPDX-License-Identifier: MIT
 *
 * below - the panels below the sheets.
 *
 * A panel is made when it is shown or asked for first: most are never used.
 */
#ifndef EDITOR_BELOW_H
#define EDITOR_BELOW_H

#include "editor-gtk/window/core.h"

struct below {
	struct core *core;
	GtkPaned *paned;
	GtkBox *box;
	GtkStack *stack;
	GtkWidget *switcher;
	GtkScrolledWindow *tabs;
	GtkMenuButton *more;   /* shown while the tabs are wider than the window */
	bool away;             /* hidden for the page in front, not by the person */
};

typedef GtkWidget *below_make(gpointer part);

void below_init(struct below *below, struct core *core);
/** below_add - adds a tab; @make(@part) makes its panel. @name: static. @title: not
 * translated. */
void below_add(struct below *below, const char *name, const char *title, below_make *make,
	       gpointer part);
/** below_panel - the panel of a tab; makes it if need be. Borrowed. */
GtkWidget *below_panel(struct below *below, const char *name);
/** below_made - the panel of a tab; NULL: not made yet. Borrowed. */
GtkWidget *below_made(struct below *below, const char *name);
/** below_show - below_panel(), and brings it to the front. */
GtkWidget *below_show(struct below *below, const char *name);
/** below_show_error - shows the problems and focuses the first error. */
void below_show_error(struct below *below);
/** below_toggle - the person shows or hides all panels. */
void below_toggle(struct below *below);
/** below_is_wanted - does the person want panels, though the page in front may have none? */
bool below_is_wanted(const struct below *below);
/** below_leave - hides the panels while a page without them is in front, until they are asked
 * for; @away false: shows them again. */
void below_leave(struct below *below, bool away);
/** below_offer - shows or hides a tab. */
void below_offer(struct below *below, const char *name, bool offered);
/** below_set_title - @title: translated. */
void below_set_title(struct below *below, const char *name, const char *title);
/** below_open - gives the panels their usual room, the problems only as much as they need. Before that they have a line below the tabs;
 * below_show() and a click on a tab do it too. */
void below_open(struct below *below);
/** below_rest - gives the panels the least room if the problems are in front and there is none. */
void below_rest(struct below *below);
/** below_share_room - gives the panels @panel px, but the sheets at least @sheets times as many. */
void below_share_room(struct below *below, int panel, int sheets);

#endif
