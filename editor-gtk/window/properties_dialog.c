/* SPDX-License-Identifier: MIT
 *
 * properties_dialog - the properties of a project and its POUs; see properties_dialog.h.
 */
#include "editor-gtk/window/properties_dialog.h"

#include "editor-gtk/document/properties.h"
#include "editor-gtk/document/rename.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/form.h"
#include "editor-gtk/window/messages.h"

#include <string.h>

/* ---- of the project ---- */

/* Rows of the form: the title, then the properties. */
static char *apply_project(struct form *form, gpointer data)
{
	char *title = form_get(form, 0), *why;
	char *text[PROPERTY_COUNT];

	for (int i = 0; i < PROPERTY_COUNT; i++)
		text[i] = form_get(form, i + 1);
	why = properties_set(data, title, (const char *const *)text);
	for (int i = 0; i < PROPERTY_COUNT; i++)
		g_free(text[i]);
	g_free(title);
	return why;
}

void project_properties_show(struct core *core)
{
	const struct project *project = ladder_document_project(core->document);
	struct form *form;

	if (!project) {
		messages_tell(core->messages, _("The file cannot be read as a program. Correct its errors first"));
		return;
	}
	form = form_new(core->window, _("Project properties"), apply_project,
			g_object_ref(core->document), g_object_unref);
	form_entry(form, _("Title"), project_text(project, project->title));
	for (int i = 0; i < PROPERTY_COUNT; i++) {
		const char *text = project_text(project, project->property[i]);

		if (i == PROPERTY_DESCRIPTION)
			form_text(form, property_label(i), text);
		else
			form_entry(form, property_label(i), text);
	}
	form_show(form);
}

/* ---- of a POU ---- */

struct about {
	LadderDocument *document;
	char *name;
};

static void about_free(gpointer data)
{
	struct about *about = data;

	g_object_unref(about->document);
	g_free(about->name);
	g_free(about);
}

/* -1: it is not there any more. */
static int pou_of(const struct about *about, const char *name)
{
	const struct project *project = ladder_document_project(about->document);

	return project ? project_find_pou(project, name, strlen(name)) : -1;
}

static char *name_refusal(const char *name, gpointer data)
{
	const struct about *about = data;
	const struct xref_target target = { .what = XREF_POU,
					    .index = pou_of(about, about->name) };

	if (target.index < 0)
		return g_strdup(_("It is not there any more"));
	if (strcmp(name, about->name) == 0)
		return NULL;
	return *name ? rename_refusal(about->document, &target, name) :
		       g_strdup(_("Enter a name"));
}

/* Name and comment change in one step. */
static char *apply_pou(struct form *form, gpointer data)
{
	const struct about *about = data;
	char *name = form_get(form, 0), *comment = form_get(form, 1);
	char *why = name_refusal(name, data);
	struct xref_target target = { .what = XREF_POU, .index = pou_of(about, about->name) };

	if (!why) {
		ladder_document_begin(about->document, _("Change properties"), NULL);
		if (strcmp(name, about->name) != 0)
			rename_everywhere(about->document, &target, name,
					  _("Change properties"), NULL, &why);
		if (!why)
			why = pou_set_comment(about->document, pou_of(about, name), comment);
		if (why)
			ladder_document_cancel(about->document);
		else
			ladder_document_end(about->document);
	}
	g_free(comment);
	g_free(name);
	return why;
}

void pou_properties_show(struct core *core, int pou)
{
	const struct project *project = ladder_document_project(core->document);
	struct about *about;
	struct form *form;
	char *title, *comment;

	if (!project || pou < 0 || pou >= project->pou_count)
		return;
	about = g_new(struct about, 1);
	about->document = g_object_ref(core->document);
	about->name = g_strdup(project_text(project, project->pou[pou].name));
	title = g_strdup_printf(_("Properties of “%s”"), about->name);
	comment = pou_comment(core->document, pou);
	form = form_new(core->window, title, apply_pou, about, about_free);
	if (project->pou[pou].included) {
		form_fact(form, _("Name"), g_strdup(about->name));
		form_fact(form, _("File"), g_path_get_basename(project->pou[pou].file));
	} else {
		form_judge(form, form_entry(form, _("Name"), about->name), name_refusal);
		form_text(form, _("Comment"), comment);
	}
	form_group(form, NULL);
	for (int i = 0; i < POU_FACTS; i++)
		form_fact(form, pou_fact_label(i), pou_fact(core->document, pou, i));
	form_show(form);
	g_free(comment);
	g_free(title);
}
