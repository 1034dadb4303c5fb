/* SPDX-License-Identifier: MIT
 *
 * pou_new - asks for the name of a new program or block; see pou_new.h.
 */
#include "editor-gtk/window/pou_new.h"

#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/ask.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

/* In the order of the drop-downs. A chart is always a program. */
static const enum pou_kind kinds[] = { POU_PROGRAM, POU_BLOCK, POU_FUNCTION, POU_SUBROUTINE };
static const enum pou_language languages[] = { LANGUAGE_LD, LANGUAGE_IL, LANGUAGE_SFC };

struct naming {
	struct core *core;
	AdwMessageDialog *dialog;
	GtkWidget *line, *why;
	GtkDropDown *kind, *language; /* NULL: a copy                          */
	char *original;               /* the POU that is copied; NULL: a new one */
	char *proposed;
	enum pou_kind kind_now;
};

static void naming_free(gpointer data, GClosure *closure)
{
	struct naming *naming = data;

	(void)closure;
	g_free(naming->original);
	g_free(naming->proposed);
	g_free(naming);
}

/* Caller frees. */
static char *name_typed(const struct naming *naming)
{
	return g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(naming->line))));
}

static void judge(struct naming *naming)
{
	char *name = name_typed(naming);

	ask_refuse(naming->dialog, "make", naming->line, naming->why,
		   pou_name_refusal(naming->core->document, naming->kind_now, name));
	g_free(name);
}

static void propose(struct naming *naming, char *name)
{
	g_free(naming->proposed);
	naming->proposed = name;
	gtk_editable_set_text(GTK_EDITABLE(naming->line), name);
	gtk_editable_select_region(GTK_EDITABLE(naming->line), 0, -1);
	judge(naming);
}

static void typed(struct naming *naming)
{
	judge(naming);
}

/* ---- making it ---- */

/* In a project whose CONFIGURATION lists its programs, a new one does not run yet. */
static void tell_tasks(struct naming *naming, const char *name)
{
	char *told;

	if (naming->kind_now != POU_PROGRAM || pou_order_counts(naming->core->document))
		return;
	told = g_strdup_printf(_("“%s” does not run yet. Add it to the CONFIGURATION."), name);
	messages_tell(naming->core->messages, told);
	g_free(told);
}

static char *make(struct naming *naming, const char *name)
{
	LadderDocument *document = naming->core->document;
	const struct project *project = ladder_document_project(document);
	int pou;

	if (!naming->original)
		return pou_add(document, naming->kind_now,
			       languages[gtk_drop_down_get_selected(naming->language)], name);
	pou = project ? project_find_pou(project, naming->original,
					 strlen(naming->original)) : -1;
	return pou < 0 ? g_strdup(_("It is not there any more")) :
			 pou_duplicate(document, pou, name);
}

static void answered(AdwMessageDialog *dialog, const char *answer, struct naming *naming)
{
	char *name = name_typed(naming), *why;

	(void)dialog;
	if (strcmp(answer, "make") == 0) {
		why = make(naming, name);
		if (why) {
			messages_warn(naming->core->messages, why);
		} else {
			tabs_go(naming->core->tabs, project_find_pou(ladder_document_project(
				naming->core->document), name, strlen(name)), 0, -1, -1);
			tell_tasks(naming, name);
		}
		g_free(why);
	}
	g_free(name);
}

/* ---- the dialog ---- */

static GtkWidget *labelled(const char *text, GtkWidget *widget)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);
	GtkWidget *label = gtk_label_new(text);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_set_hexpand(label, TRUE);
	spoken_name(widget, text);
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), widget);
	return box;
}

static void fill_languages(struct naming *naming, enum pou_language chosen)
{
	const char *names[] = { _("Ladder (LD)"), _("Instruction list (IL)"),
				naming->kind_now == POU_PROGRAM ? _("Chart (SFC)") : NULL, NULL };
	GtkStringList *list = gtk_string_list_new(names);
	guint at = 0;

	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(list)); i++)
		at = languages[i] == chosen ? i : at;
	gtk_drop_down_set_model(naming->language, G_LIST_MODEL(list));
	gtk_drop_down_set_selected(naming->language, at);
	g_object_unref(list);
}

/* A name that was proposed becomes one of the other kind. */
static void kind_chosen(struct naming *naming)
{
	const enum pou_language language =
		languages[gtk_drop_down_get_selected(naming->language)];
	char *name = name_typed(naming);

	naming->kind_now = kinds[gtk_drop_down_get_selected(naming->kind)];
	fill_languages(naming, language);
	if (strcmp(name, naming->proposed) == 0)
		propose(naming, pou_free_name(naming->core->document, naming->kind_now));
	else
		judge(naming);
	g_free(name);
}

static void add_choices(struct naming *naming, GtkWidget *box, enum pou_language language)
{
	const char *names[] = { _("Program"), _("Function block"), _("Function"),
				_("Subroutine"), NULL };

	naming->kind = GTK_DROP_DOWN(gtk_drop_down_new_from_strings(names));
	naming->language = GTK_DROP_DOWN(gtk_drop_down_new(NULL, NULL));
	for (guint i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (kinds[i] == naming->kind_now)
			gtk_drop_down_set_selected(naming->kind, i);
	fill_languages(naming, language);
	g_signal_connect_swapped(naming->kind, "notify::selected", G_CALLBACK(kind_chosen),
				 naming);
	gtk_box_append(GTK_BOX(box), labelled(_("Kind"), GTK_WIDGET(naming->kind)));
	gtk_box_append(GTK_BOX(box), labelled(_("Language"), GTK_WIDGET(naming->language)));
}

/* @naming: taken over. */
static void ask(struct naming *naming, const char *heading, const char *label, char *name,
		enum pou_language language)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);

	naming->dialog = ask_new(naming->core->window, heading, NULL, "make", label,
				 ADW_RESPONSE_SUGGESTED);
	naming->line = ask_entry(_("Name"));
	naming->why = ask_why();
	gtk_box_append(GTK_BOX(box), naming->line);
	gtk_box_append(GTK_BOX(box), naming->why);
	if (!naming->original)
		add_choices(naming, box, language);
	spoken_parts(box);
	adw_message_dialog_set_extra_child(naming->dialog, box);
	propose(naming, name);
	g_signal_connect_swapped(naming->line, "changed", G_CALLBACK(typed), naming);
	g_signal_connect_data(naming->dialog, "response", G_CALLBACK(answered), naming,
			      naming_free, 0);
	gtk_window_present(GTK_WINDOW(naming->dialog));
	gtk_widget_grab_focus(naming->line);
}

/* Nothing is asked if nothing can be made. */
static bool is_ready(struct core *core)
{
	const struct project *project = ladder_document_project(core->document);

	if (project && ladder_document_is_whole(core->document))
		return true;
	messages_tell(core->messages, _("Nothing can be added while a text of the project "
					"cannot be read"));
	return false;
}

void pou_new_ask(struct core *core, enum pou_kind kind, enum pou_language language)
{
	struct naming *naming;

	if (!is_ready(core))
		return;
	naming = g_new0(struct naming, 1);
	*naming = (struct naming){ .core = core, .kind_now = kind };
	ask(naming, _("New program or block"), _("Create"), pou_free_name(core->document, kind),
	    language);
}

void pou_duplicate_ask(struct core *core, int pou)
{
	const struct project *project = ladder_document_project(core->document);
	struct naming *naming;
	char *heading;

	if (!is_ready(core) || pou < 0 || pou >= project->pou_count)
		return;
	if (project->pou[pou].included) {
		messages_tell(core->messages, _("It is declared in another file"));
		return;
	}
	naming = g_new0(struct naming, 1);
	*naming = (struct naming){ .core = core, .kind_now = project->pou[pou].kind,
		.original = g_strdup(project_text(project, project->pou[pou].name)) };
	heading = g_strdup_printf(_("Duplicate “%s”"), naming->original);
	ask(naming, heading, _("Duplicate"), pou_copy_name(core->document, pou), LANGUAGE_LD);
	g_free(heading);
}
