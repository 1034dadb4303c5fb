/* SPDX-License-Identifier: MIT
 *
 * verbs - the rows of verbs.def as a table.
 */
#include "editor-gtk/kit/verbs.h"

#include "editor-gtk/kit/i18n.h"

#include "engine/base/catalog.h"

#include <string.h>

static const char *const ids[] = {
#define VERB(id, where, keys, label, group) "win." #id,
#include "editor-gtk/kit/verbs.def"
};
static const struct verb_row rows[] = {
#define VERB(id, where, keys, label, group) \
	{ "win." #id, VERB_##where, keys, label, VERBS_##group },
#include "editor-gtk/kit/verbs.def"
};

const struct verb_row *verb_row(enum verb verb)
{
	return &rows[verb];
}

enum verb verb_find(const char *action)
{
	for (int i = 0; i < VERB_COUNT; i++)
		if (strcmp(ids[i], action) == 0)
			return (enum verb)i;
	return VERB_COUNT;
}

const char *verb_found(enum verb verb)
{
	static const char *const found[VERB_COUNT] = {
#define VERB(id, where, keys, label, group)
#define FOUND(id, words) [VERB_##id] = words,
#include "editor-gtk/kit/verbs.def"
	};

	return found[verb];
}

/* ---- what a verb needs ---- */

static unsigned usual_needs(enum verb verb)
{
	static const unsigned sheet[] = { [VERB_SHEET] = WITH_RUNGS, [VERB_CHART] = WITH_CHART,
					  [VERB_NETWORK] = WITH_NETWORK,
					  [VERB_BOTH] = WITH_CANVAS, [VERB_TEXT] = WITH_ST,
					  [VERB_WINDOW] = 0 };
	const enum verb_group group = rows[verb].group;
	const bool edits = group == VERBS_DRAW || group == VERBS_RUNG || group == VERBS_CHART ||
			   group == VERBS_NETWORK;

	return sheet[rows[verb].where] | (edits ? WITH_FREE : 0u);
}

unsigned verb_needs(enum verb verb)
{
	static const unsigned needs[VERB_COUNT] = {
#define VERB(id, where, keys, label, group)
#define NEEDS(id, facts) [VERB_##id] = (unsigned)(facts),
#include "editor-gtk/kit/verbs.def"
	};

	return needs[verb] ? needs[verb] : usual_needs(verb);
}

const char *verb_why_not(enum verb verb, unsigned with)
{
	static const char *const why[VERB_FACTS] = {
#define VERB(id, where, keys, label, group)
#define FACT(id, text) [FACT_##id] = text,
#include "editor-gtk/kit/verbs.def"
	};
	const unsigned lacks = verb_needs(verb) & ~with;

	for (int i = 0; lacks && i < VERB_FACTS; i++)
		if (lacks & (1u << i))
			return _(why[i]);
	return NULL;
}

bool verb_is_parted(enum verb verb)
{
	static const bool parted[VERB_COUNT] = {
#define VERB(id, where, keys, label, group)
#define PARTED(id) [VERB_##id] = true,
#include "editor-gtk/kit/verbs.def"
	};

	return parted[verb];
}

const char *verb_nested(enum verb first, enum verb *last)
{
	static const struct { enum verb first, last; const char *label; } nested[] = {
#define VERB(id, where, keys, label, group)
#define NESTED(id, end, label) { VERB_##id, VERB_##end, label },
#include "editor-gtk/kit/verbs.def"
	};

	for (gsize i = 0; i < G_N_ELEMENTS(nested); i++) {
		if (nested[i].first != first)
			continue;
		*last = nested[i].last;
		return nested[i].label;
	}
	return NULL;
}

const char *verb_group_label(enum verb_group group)
{
	static const char *const labels[VERBS_GROUPS] = {
		[VERBS_FILE] = N_("File"), [VERBS_PROJECT] = N_("Project"),
		[VERBS_EDIT] = N_("Edit"),
		[VERBS_DRAW] = N_("Draw"), [VERBS_RUNG] = N_("Rungs"),
		[VERBS_CHART] = N_("Charts"), [VERBS_NETWORK] = N_("Networks"),
		[VERBS_GO] = N_("Go"), [VERBS_RUN] = N_("Simulation"),
		[VERBS_VIEW] = N_("View"),
		[VERBS_HELP] = N_("Help"),
	};

	return labels[group];
}

/* ---- schemes ---- */

struct key_row {
	enum key_scheme scheme;
	enum verb verb;    /* VERB_COUNT: a word of the catalogue              */
	const char *word;
	const char *keys;
};

static const char *const schemes[] = {
#define SCHEME(id, name) name,
#include "editor-gtk/kit/key_schemes.def"
};
static const struct key_row key_rows[] = {
#define KEYS(scheme, verb, keys) { SCHEME_##scheme, VERB_##verb, NULL, keys },
#define PUT(scheme, word, keys) { SCHEME_##scheme, VERB_COUNT, word, keys },
#include "editor-gtk/kit/key_schemes.def"
};

/* The keys in use; only verbs_use_scheme() changes them. */
static char *keys_now[VERB_COUNT];
static enum key_scheme scheme_now;
static GListStore *shortcuts[VERB_BOTH]; /* by verb_where: of sheets, charts, networks and texts */

const char *key_scheme_name(enum key_scheme scheme)
{
	return schemes[scheme];
}

static bool same_key(const char *a, const char *b)
{
	guint key_a, key_b;
	GdkModifierType state_a, state_b;

	return gtk_accelerator_parse(a, &key_a, &state_a) &&
	       gtk_accelerator_parse(b, &key_b, &state_b) && key_a == key_b &&
	       state_a == state_b;
}

/* The same key may have one meaning in sheets, another in charts, and a third one in texts. */
static bool is_apart(const struct key_row *row, enum verb verb)
{
	const enum verb_where a = row->word ? VERB_SHEET : rows[row->verb].where;
	const enum verb_where b = rows[verb].where;

	if (a == VERB_WINDOW || b == VERB_WINDOW || a == b)
		return false;
	return a == VERB_TEXT || b == VERB_TEXT || (a != VERB_BOTH && b != VERB_BOTH);
}

static bool is_given_away(enum key_scheme scheme, const char *key, enum verb verb)
{
	bool found = false;

	for (gsize i = 0; !found && i < G_N_ELEMENTS(key_rows); i++) {
		char **keys;

		if (key_rows[i].scheme != scheme || is_apart(&key_rows[i], verb))
			continue;
		keys = g_strsplit(key_rows[i].keys, "|", -1);
		for (char **one = keys; *one; one++)
			found = found || same_key(*one, key);
		g_strfreev(keys);
	}
	return found;
}

char *verb_keys_of(enum verb verb, enum key_scheme scheme)
{
	GString *left = g_string_new(NULL);
	char **keys;

	for (gsize i = 0; i < G_N_ELEMENTS(key_rows); i++)
		if (key_rows[i].scheme == scheme && key_rows[i].verb == verb)
			return g_string_free(g_string_assign(left, key_rows[i].keys), FALSE);
	keys = g_strsplit(rows[verb].keys, "|", -1);
	for (char **key = keys; *key; key++)
		if (**key && !is_given_away(scheme, *key, verb))
			g_string_append_printf(left, "%s%s", left->len ? "|" : "", *key);
	g_strfreev(keys);
	return g_string_free(left, FALSE);
}

const char *verb_keys(enum verb verb)
{
	return keys_now[verb] ? keys_now[verb] : rows[verb].keys;
}

char *keys_label(const char *text)
{
	char **keys = g_strsplit(text, "|", -1);
	guint key = 0;
	GdkModifierType modifiers = 0;
	char *label = NULL;

	if (keys[0] && keys[0][0] && gtk_accelerator_parse(keys[0], &key, &modifiers))
		label = gtk_accelerator_get_label(key, modifiers);
	g_strfreev(keys);
	return label ? label : g_strdup("");
}

char *verb_keys_label(enum verb verb)
{
	return keys_label(verb_keys(verb));
}

void menu_append(GMenu *menu, const char *label, const char *action, const char *keys)
{
	GMenuItem *item = g_menu_item_new(label, action);
	char **key = g_strsplit(keys, "|", 2);

	if (key[0])
		g_menu_item_set_attribute(item, "accel", "s", key[0]);
	g_menu_append_item(menu, item);
	g_strfreev(key);
	g_object_unref(item);
}

void verb_tell(GString *line, enum verb verb)
{
	char *keys = verb_keys_label(verb);

	if (keys[0])
		g_string_append_printf(line, _("%s%s: %s"), line->len ? " · " : "", keys,
				       _(verb_row(verb)->label));
	g_free(keys);
}

void verb_append(GMenu *menu, enum verb verb, const char *label, const char *action)
{
	menu_append(menu, label ? label : _(verb_row(verb)->label),
		    action ? action : verb_row(verb)->action, verb_keys(verb));
}

bool key_scheme_put(enum key_scheme scheme, int index, const char **word,
		    const char **keys)
{
	for (gsize i = 0; i < G_N_ELEMENTS(key_rows); i++) {
		if (key_rows[i].scheme != scheme || !key_rows[i].word || index-- > 0)
			continue;
		*word = key_rows[i].word;
		*keys = key_rows[i].keys;
		return true;
	}
	return false;
}

/* ---- whom they are given ---- */

static void add_shortcut(GListStore *to, const char *keys, const char *action,
			 GVariant *argument)
{
	GtkShortcutTrigger *trigger = gtk_shortcut_trigger_parse_string(keys);
	GtkShortcut *shortcut;

	g_assert(trigger);
	shortcut = gtk_shortcut_new(trigger, gtk_named_action_new(action));
	if (argument)
		gtk_shortcut_set_arguments(shortcut, argument);
	g_list_store_append(to, shortcut);
	g_object_unref(shortcut);
}

static void fill_shortcuts(enum verb_where where)
{
	const char *word, *keys;

	g_list_store_remove_all(shortcuts[where]);
	for (int i = 0; i < VERB_COUNT; i++)
		if ((rows[i].where == where ||
		     (rows[i].where == VERB_BOTH && where != VERB_TEXT)) &&
		    verb_keys((enum verb)i)[0])
			add_shortcut(shortcuts[where], verb_keys((enum verb)i),
				     rows[i].action, NULL);
	for (int i = 0; where == VERB_SHEET &&
	     key_scheme_put(scheme_now, i, &word, &keys); i++)
		add_shortcut(shortcuts[where], keys, "win.place",
			     g_variant_new_int32((int)word_find(word, strlen(word))));
}

GtkEventController *verbs_controller(enum verb_where where)
{
	if (!shortcuts[where]) {
		shortcuts[where] = g_list_store_new(GTK_TYPE_SHORTCUT);
		fill_shortcuts(where);
	}
	return gtk_shortcut_controller_new_for_model(G_LIST_MODEL(shortcuts[where]));
}

static bool is_pressed(const char *keys, GdkEvent *key)
{
	GtkShortcutTrigger *trigger = keys[0] ? gtk_shortcut_trigger_parse_string(keys) :
		NULL;
	const bool same = trigger &&
		gtk_shortcut_trigger_trigger(trigger, key, FALSE) == GDK_KEY_MATCH_EXACT;

	g_clear_object(&trigger);
	return same;
}

static enum verb pressed(GdkEvent *key, enum verb_where where, enum verb_where also)
{
	int i = 0;

	while (i < VERB_COUNT && ((rows[i].where != where && rows[i].where != also) ||
				  !is_pressed(verb_keys((enum verb)i), key)))
		i++;
	return (enum verb)i;
}

enum verb verb_of_key(GdkEvent *key)
{
	return pressed(key, VERB_WINDOW, VERB_WINDOW);
}

enum verb verb_of_sheet_key(GdkEvent *key, enum verb_where where)
{
	return pressed(key, where, VERB_BOTH);
}

static void give_keys(GtkApplication *application)
{
	for (int i = 0; i < VERB_COUNT; i++) {
		char **keys;

		if (rows[i].where != VERB_WINDOW)
			continue;
		keys = g_strsplit(verb_keys((enum verb)i), "|", -1);
		gtk_application_set_accels_for_action(application, rows[i].action,
						      (const char *const *)keys);
		g_strfreev(keys);
	}
}

void verbs_use_scheme(GtkApplication *application, enum key_scheme scheme)
{
	scheme_now = scheme;
	for (int i = 0; i < VERB_COUNT; i++) {
		g_free(keys_now[i]);
		keys_now[i] = verb_keys_of((enum verb)i, scheme);
	}
	for (int where = VERB_SHEET; where < VERB_BOTH; where++)
		if (shortcuts[where])
			fill_shortcuts((enum verb_where)where);
	if (application)
		give_keys(application);
}
