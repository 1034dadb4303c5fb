/* SPDX-License-Identifier: MIT
 *
 * finder - the find bar of a window: where a search begins, and its marks on the sheets.
 */
#ifndef EDITOR_FINDER_H
#define EDITOR_FINDER_H

#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/panels/find_bar.h"
#include "editor-gtk/window/core.h"

struct finder {
	struct core *core;
	GtkBox *place;
	LadderFindBar *bar;
};

void finder_init(struct finder *finder, struct core *core);
/** finder_do - find, replace, next, previous. */
void finder_do(struct finder *finder, enum verb verb);
/** finder_close - closes the bar; false: it was closed. */
bool finder_close(struct finder *finder);

#endif
