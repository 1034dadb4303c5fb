/* SPDX-License-Identifier: MIT
 *
 * verbs - the rows of verbs.def as a table: names, keys and groups. Windows and sheets do
 * the work.
 */
#ifndef EDITOR_VERBS_H
#define EDITOR_VERBS_H

#include <gtk/gtk.h>
#include <stdbool.h>

enum verb {
#define VERB(id, where, keys, label, group) VERB_##id,
#include "editor-gtk/kit/verbs.def"
	VERB_COUNT
};
/* What is so in the window, as bits WITH_PROJECT and the like. */
enum verb_fact {
#define VERB(id, where, keys, label, group)
#define FACT(id, why) FACT_##id,
#include "editor-gtk/kit/verbs.def"
	VERB_FACTS
};
enum verb_with {
#define VERB(id, where, keys, label, group)
#define FACT(id, why) WITH_##id = 1 << FACT_##id,
#include "editor-gtk/kit/verbs.def"
};
enum verb_where { VERB_WINDOW, VERB_SHEET, VERB_CHART, VERB_NETWORK, VERB_TEXT, VERB_BOTH };
enum verb_group {
	VERBS_FILE, VERBS_PROJECT, VERBS_EDIT, VERBS_DRAW, VERBS_RUNG, VERBS_CHART, VERBS_NETWORK, VERBS_GO,
	VERBS_RUN, VERBS_VIEW, VERBS_HELP,
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
/** verb_find - by an action's name, "win.save"; VERB_COUNT: none. */
enum verb verb_find(const char *action);
/** verb_needs - the facts, bits WITH_…, that must hold for it to work. */
unsigned verb_needs(enum verb verb);
/** verb_why_not - the reason, translated, why it cannot work while @with holds; NULL: it can. */
const char *verb_why_not(enum verb verb, unsigned with);
/** verb_found - further words by which it is found, not translated: _() them; NULL: none. */
const char *verb_found(enum verb verb);
/** menu_append - appends a row to a menu that shows the first of @keys, "": none. @label:
 * translated. */
void menu_append(GMenu *menu, const char *label, const char *action, const char *keys);
/** verb_append - appends a row to a menu that shows the first key in the scheme in use.
 * @label, @action: NULL for those of the verb. */
void verb_append(GMenu *menu, enum verb verb, const char *label, const char *action);
/** verb_is_parted - does a line stand above it in the main menu? */
bool verb_is_parted(enum verb verb);
/** verb_nested - the label, not translated, of the menu in a menu that begins with it and ends
 * with @last; NULL: none does. */
const char *verb_nested(enum verb first, enum verb *last);
/** verb_group_label - not translated. */
const char *verb_group_label(enum verb_group group);
/** verb_keys - the keys in the scheme in use, separated by |; "": none. Borrowed until the
 * scheme changes. */
const char *verb_keys(enum verb verb);
/** keys_label - the first key as shown to the user; "": none. Caller frees. */
char *keys_label(const char *keys);
/** verb_keys_label - "Ctrl+S"; "" if it has none. Caller frees. */
char *verb_keys_label(enum verb verb);

/** verb_tell - appends "F5: Contact" to a line, if the verb has a key. */
void verb_tell(GString *line, enum verb verb);

/* Schemes of keys, key_schemes.def. */
enum key_scheme {
#define SCHEME(id, name) SCHEME_##id,
#include "editor-gtk/kit/key_schemes.def"
	KEY_SCHEMES
};
/** key_scheme_name - the editor it comes from; never translated. */
const char *key_scheme_name(enum key_scheme scheme);
/** verb_keys_of - the keys of a verb in a scheme. Caller frees. */
char *verb_keys_of(enum verb verb, enum key_scheme scheme);
/** key_scheme_put - word number @index with keys in a scheme; false: there are no more. */
bool key_scheme_put(enum key_scheme scheme, int index, const char **word,
		    const char **keys);
/** verbs_use_scheme - switches all windows and sheets to this scheme. @application may be
 * NULL. */
void verbs_use_scheme(GtkApplication *application, enum key_scheme scheme);
/** verb_of_key - the WINDOW verb of a key; VERB_COUNT: none. For widgets that handle keys
 * before the window. */
enum verb verb_of_key(GdkEvent *key);
/** verb_of_sheet_key - the same of the verbs of a kind of sheet: SHEET, CHART or NETWORK, and BOTH. */
enum verb verb_of_sheet_key(GdkEvent *key, enum verb_where where);
/** verbs_controller - handles the keys of all SHEET, CHART or NETWORK verbs, and of those of BOTH; or of all
 * TEXT verbs; in the scheme in use. Owns: the widget it is added to. */
GtkEventController *verbs_controller(enum verb_where where);

#endif
