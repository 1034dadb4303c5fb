/* SPDX-License-Identifier: MIT
 *
 * verbs - the rows of verbs.def as a table.
 *
 * What a verb does is told by the window and the sheet; here is only what it is called,
 * which keys it has and where they count.
 */
#ifndef EDITOR_VERBS_H
#define EDITOR_VERBS_H

#include <gtk/gtk.h>
#include <stdbool.h>

enum verb {
#define VERB(id, where, keys, label, group) VERB_##id,
#include "editor-gtk/verbs.def"
	VERB_COUNT
};
enum verb_where { VERB_WINDOW, VERB_SHEET };
enum verb_group {
	VERBS_FILE, VERBS_EDIT, VERBS_DRAW, VERBS_RUNG, VERBS_GO, VERBS_VIEW, VERBS_HELP,
	VERBS_GROUPS
};

struct verb_row {
	const char *action;    /* "win.rung-below"                             */
	enum verb_where where;
	const char *keys;      /* parted by |; "" for none                     */
	const char *label;     /* not translated: _() it                       */
	enum verb_group group;
};

/** verb_row - lives for ever. */
const struct verb_row *verb_row(enum verb verb);
/** verb_find - of an action's name, "win.save"; VERB_COUNT: none. */
enum verb verb_find(const char *action);
/** verb_group_label - not translated. */
const char *verb_group_label(enum verb_group group);
/** verb_keys_label - "Ctrl+S" as people read it; "" if it has none. Caller frees. */
char *verb_keys_label(enum verb verb);
/** verbs_set_keys - gives the application the keys of all WINDOW verbs. */
void verbs_set_keys(GtkApplication *application);
/** verbs_add_shortcuts - gives a class of widgets the keys of all SHEET verbs. */
void verbs_add_shortcuts(GtkWidgetClass *class);

#endif
