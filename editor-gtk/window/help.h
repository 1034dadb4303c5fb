/* SPDX-License-Identifier: MIT
 *
 * help - the manual in a window of its own, and F1: the page about the place with the focus.
 */
#ifndef EDITOR_HELP_H
#define EDITOR_HELP_H

#include "editor-gtk/window/core.h"

struct help {
	struct core *core;
	GtkWindow *window;  /* of the manual; NULL: not open. Borrowed           */
};

/* A row of help_places.def. */
struct help_place { const char *name, *page, *anchor; };
/** help_place - number @index; NULL: there are no more. */
const struct help_place *help_place(int index);

void help_init(struct help *help, struct core *core);
void help_clear(struct help *help);
/** help_show - a page of the manual: "tutorial.md"; NULL: as it was left, or the page of the
 * editor. */
void help_show(struct help *help, const char *page);
/** help_here - the page about the place with the focus. */
void help_here(struct help *help);

#endif
