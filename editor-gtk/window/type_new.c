/* SPDX-License-Identifier: MIT
 *
 * type_new - asks for the name of a new data type; see type_new.h.
 */
#include "editor-gtk/window/type_new.h"

#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/naming.h"
#include "editor-gtk/window/tabs.h"

struct fresh {
	struct core *core;
	struct naming *naming;
	GtkDropDown *kind;   /* NULL: a copy                                   */
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

static enum type_kind kind_of(const struct fresh *fresh)
{
	return (enum type_kind)gtk_drop_down_get_selected(fresh->kind);
}

static bool make(const struct fresh *fresh, const char *name, char **why)
{
	LadderDocument *document = fresh->core->document;
	int original;

	if (!fresh->original)
		return type_add(document, kind_of(fresh), name, why);
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

static char *free_name(const struct fresh *fresh)
{
	static const char *const like[TYPE_KINDS] = {
		[TYPE_STRUCTURE] = "Structure1", [TYPE_ENUMERATION] = "Enumeration1",
		[TYPE_SUBRANGE] = "Range1", [TYPE_ARRAY] = "Array1", [TYPE_ALIAS] = "Type1",
	};

	return type_free_name(fresh->core->document,
			      fresh->original ? fresh->original : like[kind_of(fresh)]);
}

/* A name that was proposed becomes one of the other kind. */
static void kind_chosen(struct fresh *fresh)
{
	if (naming_is_proposed(fresh->naming))
		naming_propose(fresh->naming, free_name(fresh));
}

static void add_kinds(struct fresh *fresh)
{
	const char *names[] = { _("Structure"), _("Enumeration"), _("Subrange"), _("Array"),
				_("Other name of a type"), NULL };
	GtkWidget *kind = gtk_drop_down_new_from_strings(names);

	fresh->kind = GTK_DROP_DOWN(kind);
	g_signal_connect_swapped(kind, "notify::selected", G_CALLBACK(kind_chosen), fresh);
	naming_add_labelled(fresh->naming, _("Kind"), kind);
}

void type_new_ask(struct core *core, const char *original)
{
	struct fresh *fresh;
	char *heading;

	if (!messages_can_add(core->messages))
		return;
	fresh = g_new0(struct fresh, 1);
	*fresh = (struct fresh){ .core = core, .original = g_strdup(original) };
	heading = original ? g_strdup_printf(_("Duplicate “%s”"), original) :
		  g_strdup(_("New data type"));
	fresh->naming = naming_new(core->window, heading, original ? _("Duplicate") : _("Create"),
				   _("Name"), &how, fresh);
	if (!original)
		add_kinds(fresh);
	naming_propose(fresh->naming, free_name(fresh));
	naming_show(fresh->naming);
	g_free(heading);
}
