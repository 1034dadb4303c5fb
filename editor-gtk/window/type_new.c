/* SPDX-License-Identifier: MIT
 *
 * type_new - asks for the name of a new structure; see type_new.h.
 */
#include "editor-gtk/window/type_new.h"

#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/naming.h"
#include "editor-gtk/window/tabs.h"

struct fresh {
	struct core *core;
	char *original;      /* NULL: a new one                               */
};

static void fresh_free(gpointer data)
{
	struct fresh *fresh = data;

	g_free(fresh->original);
	g_free(fresh);
}

static char *refusal(gpointer data, const char *name)
{
	const struct fresh *fresh = data;

	return type_name_refusal(fresh->core->document, name);
}

static bool make(const struct fresh *fresh, const char *name, char **why)
{
	LadderDocument *document = fresh->core->document;
	int original;

	if (!fresh->original)
		return type_add(document, name, why);
	original = type_find(document, fresh->original);
	if (original >= 0)
		return type_duplicate(document, original, name, why);
	*why = g_strdup(_("It is not there any more"));
	return false;
}

static void take(gpointer data, const char *name)
{
	const struct fresh *fresh = data;
	char *why = NULL;

	if (make(fresh, name, &why))
		tabs_show_type(fresh->core->tabs, name);
	else
		messages_warn(fresh->core->messages, why);
	g_free(why);
}

static const struct naming_how how = { refusal, take, fresh_free };

void type_new_ask(struct core *core, const char *original)
{
	struct naming *naming;
	struct fresh *fresh;
	char *heading, *name;

	if (!messages_can_add(core->messages))
		return;
	fresh = g_new(struct fresh, 1);
	*fresh = (struct fresh){ core, g_strdup(original) };
	heading = original ? g_strdup_printf(_("Duplicate “%s”"), original) :
		  g_strdup(_("New structure"));
	name = type_free_name(core->document, original ? original : "Structure1");
	naming = naming_new(core->window, heading, original ? _("Duplicate") : _("Create"),
			    _("Name"), &how, fresh);
	naming_set(naming, name);
	naming_show(naming);
	g_free(name);
	g_free(heading);
}
