/* SPDX-License-Identifier: MIT
 *
 * pou_new - asks for the name of a new program or block; see pou_new.h.
 */
#include "editor-gtk/window/pou_new.h"

#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/naming.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

/* In the order of the drop-downs. A chart is a program or a function block. */
static const enum pou_kind kinds[] = { POU_PROGRAM, POU_BLOCK, POU_FUNCTION, POU_SUBROUTINE };
static const enum pou_language languages[] = { LANGUAGE_LD, LANGUAGE_IL, LANGUAGE_ST,
						 LANGUAGE_FBD, LANGUAGE_SFC };

struct fresh {
	struct core *core;
	struct naming *naming;
	GtkDropDown *kind, *language; /* NULL: a copy                          */
	char *original;               /* the POU that is copied; NULL: a new one */
	enum pou_kind kind_now;
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

	return pou_name_refusal(fresh->core->document, fresh->kind_now, name);
}

/* ---- making it ---- */

/* In a project whose CONFIGURATION lists its programs, a new one does not run yet. */
static void tell_tasks(struct fresh *fresh, const char *name)
{
	char *told;

	if (fresh->kind_now != POU_PROGRAM || pou_order_counts(fresh->core->document))
		return;
	told = g_strdup_printf(_("“%s” does not run yet. Add it to the CONFIGURATION."), name);
	messages_tell(fresh->core->messages, told);
	g_free(told);
}

static char *make(struct fresh *fresh, const char *name)
{
	LadderDocument *document = fresh->core->document;
	const struct project *project = ladder_document_project(document);
	int pou;

	if (!fresh->original)
		return pou_add(document, fresh->kind_now,
			       languages[gtk_drop_down_get_selected(fresh->language)], name);
	pou = project ? project_find_pou(project, fresh->original,
					 strlen(fresh->original)) : -1;
	return pou < 0 ? g_strdup(_("It is not there any more")) :
			 pou_duplicate(document, pou, name);
}

static void take(gpointer data, const char *name)
{
	struct fresh *fresh = data;
	struct core *core = fresh->core;
	char *why = make(fresh, name);

	if (why) {
		messages_warn(core->messages, why);
	} else {
		tabs_go(core->tabs, project_find_pou(ladder_document_project(core->document),
						     name, strlen(name)), 0, -1, -1);
		tell_tasks(fresh, name);
	}
	g_free(why);
}

static const struct naming_how how = { refusal, take, fresh_free };

/* ---- the dialog ---- */

static void fill_languages(struct fresh *fresh, enum pou_language chosen)
{
	const char *names[] = { _("Ladder (LD)"), _("Instruction list (IL)"),
				_("Structured Text (ST)"), _("Function blocks (FBD)"),
				fresh->kind_now == POU_PROGRAM || fresh->kind_now == POU_BLOCK ?
				_("Chart (SFC)") : NULL, NULL };
	GtkStringList *list = gtk_string_list_new(names);
	guint at = 0;

	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(list)); i++)
		at = languages[i] == chosen ? i : at;
	gtk_drop_down_set_model(fresh->language, G_LIST_MODEL(list));
	gtk_drop_down_set_selected(fresh->language, at);
	g_object_unref(list);
}

/* A name that was proposed becomes one of the other kind. */
static void kind_chosen(struct fresh *fresh)
{
	const enum pou_language language =
		languages[gtk_drop_down_get_selected(fresh->language)];
	const bool proposed = naming_is_proposed(fresh->naming);

	fresh->kind_now = kinds[gtk_drop_down_get_selected(fresh->kind)];
	fill_languages(fresh, language);
	if (proposed)
		naming_propose(fresh->naming, pou_free_name(fresh->core->document, fresh->kind_now));
	else
		naming_judge(fresh->naming);
}

static void add_choices(struct fresh *fresh, enum pou_language language)
{
	const char *names[] = { _("Program"), _("Function block"), _("Function"),
				_("Subroutine"), NULL };

	fresh->kind = GTK_DROP_DOWN(gtk_drop_down_new_from_strings(names));
	fresh->language = GTK_DROP_DOWN(gtk_drop_down_new(NULL, NULL));
	for (guint i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (kinds[i] == fresh->kind_now)
			gtk_drop_down_set_selected(fresh->kind, i);
	fill_languages(fresh, language);
	g_signal_connect_swapped(fresh->kind, "notify::selected", G_CALLBACK(kind_chosen),
				 fresh);
	naming_add_labelled(fresh->naming, _("Kind"), GTK_WIDGET(fresh->kind));
	naming_add_labelled(fresh->naming, _("Language"), GTK_WIDGET(fresh->language));
}

/* @fresh, @name: taken over. */
static void ask(struct fresh *fresh, const char *heading, const char *label, char *name,
		enum pou_language language)
{
	fresh->naming = naming_new(fresh->core->window, heading, label, _("Name"), &how, fresh);
	if (!fresh->original)
		add_choices(fresh, language);
	naming_propose(fresh->naming, name);
	naming_show(fresh->naming);
}

void pou_new_ask(struct core *core, enum pou_kind kind, enum pou_language language)
{
	struct fresh *fresh;

	if (!messages_can_add(core->messages))
		return;
	fresh = g_new0(struct fresh, 1);
	*fresh = (struct fresh){ .core = core, .kind_now = kind };
	ask(fresh, _("New program or block"), _("Create"), pou_free_name(core->document, kind),
	    language);
}

void pou_duplicate_ask(struct core *core, int pou)
{
	const struct project *project = ladder_document_project(core->document);
	struct fresh *fresh;
	char *heading;

	if (!messages_can_add(core->messages) || pou < 0 || pou >= project->pou_count)
		return;
	if (project->pou[pou].included) {
		messages_tell(core->messages, _("It is declared in another file"));
		return;
	}
	fresh = g_new0(struct fresh, 1);
	*fresh = (struct fresh){ .core = core, .kind_now = project->pou[pou].kind,
		.original = g_strdup(project_text(project, project->pou[pou].name)) };
	heading = g_strdup_printf(_("Duplicate “%s”"), fresh->original);
	ask(fresh, heading, _("Duplicate"), pou_copy_name(core->document, pou), LANGUAGE_LD);
	g_free(heading);
}
