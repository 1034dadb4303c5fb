/* SPDX-License-Identifier: MIT
 *
 * stand_bar - above the sheets while the program stands in the middle of a scan: where, who called
 * it, and how it goes on. It opens the sheet there.
 */
#ifndef EDITOR_STAND_BAR_H
#define EDITOR_STAND_BAR_H

#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/window/core.h"

struct stand_bar {
	struct core *core;
	GtkWidget *bar;
	GtkLabel *label;
	GtkMenuButton *callers;
	GtkWidget *list;          /* of those who called                        */
	char *text;               /* what it says; NULL: it does not stand      */
	guint64 scan;             /* in which it stands                         */
};

/** stand_bar_init - @above: the widget above which it stands, in a GtkBox. */
void stand_bar_init(struct stand_bar *bar, struct core *core, GtkWidget *above);
void stand_bar_clear(struct stand_bar *bar);
/** stand_bar_do - false: the verb is none of breakpoints and steps. */
bool stand_bar_do(struct stand_bar *bar, enum verb verb);
#endif
