/* SPDX-License-Identifier: MIT
 *
 * verbs - the rows of verbs.def as a table.
 */
#include "editor-gtk/verbs.h"

#include "editor-gtk/i18n.h"

#include <string.h>

static const char *const ids[] = {
#define VERB(id, where, keys, label, group) "win." #id,
#include "editor-gtk/verbs.def"
};
static const struct verb_row rows[] = {
#define VERB(id, where, keys, label, group) \
	{ "win." #id, VERB_##where, keys, label, VERBS_##group },
#include "editor-gtk/verbs.def"
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

const char *verb_group_label(enum verb_group group)
{
	static const char *const labels[VERBS_GROUPS] = {
		[VERBS_FILE] = N_("File"), [VERBS_EDIT] = N_("Edit"),
		[VERBS_DRAW] = N_("Draw"), [VERBS_RUNG] = N_("Rungs"),
		[VERBS_GO] = N_("Go"), [VERBS_VIEW] = N_("View"),
		[VERBS_HELP] = N_("Help"),
	};

	return labels[group];
}

char *verb_keys_label(enum verb verb)
{
	char **keys = g_strsplit(rows[verb].keys, "|", -1);
	guint key = 0;
	GdkModifierType modifiers = 0;
	char *label = NULL;

	if (keys[0] && keys[0][0] && gtk_accelerator_parse(keys[0], &key, &modifiers))
		label = gtk_accelerator_get_label(key, modifiers);
	g_strfreev(keys);
	return label ? label : g_strdup("");
}

void verbs_set_keys(GtkApplication *application)
{
	for (int i = 0; i < VERB_COUNT; i++) {
		char **keys;

		if (rows[i].where != VERB_WINDOW || !rows[i].keys[0])
			continue;
		keys = g_strsplit(rows[i].keys, "|", -1);
		gtk_application_set_accels_for_action(application, rows[i].action,
						      (const char *const *)keys);
		g_strfreev(keys);
	}
}

void verbs_add_shortcuts(GtkWidgetClass *class)
{
	for (int i = 0; i < VERB_COUNT; i++) {
		GtkShortcutTrigger *trigger;
		GtkShortcut *shortcut;

		if (rows[i].where != VERB_SHEET || !rows[i].keys[0])
			continue;
		trigger = gtk_shortcut_trigger_parse_string(rows[i].keys);
		g_assert(trigger);
		shortcut = gtk_shortcut_new(trigger,
					    gtk_named_action_new(rows[i].action));
		gtk_widget_class_add_shortcut(class, shortcut);
		g_object_unref(shortcut);
	}
}
