/* SPDX-License-Identifier: MIT
 *
 * shown_page - a POU in another language; see shown_page.h.
 */
#include "editor-gtk/window/shown_page.h"

#include "editor-gtk/document/pou_convert.h"
#include "editor-gtk/kit/drop.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/problems.h"
#include "editor-gtk/sim/sim_shadow.h"
#include "editor-gtk/text/text_view.h"

#include <stdlib.h>
#include <string.h>

struct _LadderShownPage {
	GtkBox parent;
	struct core *core;
	LadderDocument *document;    /* of the window                              */
	LadderDocument *made;        /* in the other language; NULL: refused       */
	LadderSim *sim;              /* shows @made with what the window's one shows; NULL: as that */
	GtkWidget *(*make)(struct core *core, LadderDocument *document, int pou, LadderSim *sim);
	char *name;                  /* of the POU                                 */
	int pou;                     /* its number, to notice another name         */
	enum pou_language from, to;
	GArray *pous;                /* of @made: those that come from the POU     */
	GtkLabel *label;
	GtkDropDown *parts;          /* of @pous, if there are several             */
	GtkButton *convert;
	GtkWidget *child;            /* the page of one of them, or the reasons    */
	LadderSim *followed;         /* of the window                              */
	bool broken;                 /* @made does not build                       */
	bool filling;
	bool shown;                  /* @version is the one that is shown          */
	guint64 version;             /* of @document                               */
};

G_DEFINE_FINAL_TYPE(LadderShownPage, ladder_shown_page, GTK_TYPE_BOX)

bool shown_page_verb(enum verb verb, enum pou_language *to, bool *converts)
{
	for (int i = LANGUAGE_LD; i <= LANGUAGE_FBD; i++) {
		*to = (enum pou_language)i;
		*converts = verb == pou_convert_verb(*to, true);
		if (verb != VERB_COUNT && (verb == pou_convert_verb(*to, false) || *converts))
			return true;
	}
	return false;
}

int ladder_shown_page_pou(LadderShownPage *page)
{
	const struct project *project = ladder_document_project(page->document);

	return project && page->name ? project_find_pou(project, page->name, strlen(page->name)) : -1;
}

bool ladder_shown_page_is_over(LadderShownPage *page)
{
	const int pou = ladder_shown_page_pou(page);

	return pou < 0 || ladder_document_project(page->document)->pou[pou].language == page->to;
}

bool ladder_shown_page_follow(LadderShownPage *page, bool renamed)
{
	const struct project *project = ladder_document_project(page->document);
	const int pou = ladder_shown_page_pou(page);

	if (pou >= 0) {
		page->pou = pou;
		page->from = project->pou[pou].language;
	}
	if (!project || pou >= 0 || !renamed || page->pou >= project->pou_count ||
	    project->pou[page->pou].language != page->from)
		return false;
	g_free(page->name);
	page->name = g_strdup(project_text(project, project->pou[page->pou].name));
	return true;
}

GtkWidget *ladder_shown_page_child(LadderShownPage *page)
{
	return page->made ? page->child : NULL;
}

char *ladder_shown_page_title(LadderShownPage *page)
{
	return g_strdup_printf(_("%s as %s"), page->name, pou_language_word(page->to));
}

bool ladder_shown_page_enter(LadderShownPage *page)
{
	return page->child && !page->made && gtk_widget_child_focus(page->child, GTK_DIR_TAB_FORWARD);
}

static void drop_child(LadderShownPage *page)
{
	if (page->child)
		gtk_box_remove(GTK_BOX(page), page->child);
	page->child = NULL;
}

/* Of a text that was just put into its view, the end has the cursor. */
static void go_to_start(GtkWidget *child)
{
	GtkTextBuffer *text = LADDER_IS_TEXT_VIEW(child) ?
		GTK_TEXT_BUFFER(ladder_text_view_buffer(LADDER_TEXT_VIEW(child))) : NULL;
	GtkTextIter start;

	if (!text)
		return;
	gtk_text_buffer_get_start_iter(text, &start);
	gtk_text_buffer_place_cursor(text, &start);
}

static void put_child(LadderShownPage *page, GtkWidget *child)
{
	const bool focus = page->child && gtk_widget_get_focus_child(GTK_WIDGET(page)) == page->child;

	drop_child(page);
	page->child = child;
	gtk_widget_set_vexpand(child, TRUE);
	gtk_box_append(GTK_BOX(page), child);
	go_to_start(child);
	spoken_parts(child);
	if (focus)
		gtk_widget_child_focus(child, GTK_DIR_TAB_FORWARD);
	g_signal_emit_by_name(page->core->window, "place-changed");
}

/* The program that runs must be the one that was converted, with all that it uses. */
static bool may_follow(LadderShownPage *page)
{
	LadderSim *sim = page->followed;

	return gtk_widget_get_mapped(GTK_WIDGET(page)) && ladder_sim_is_on(sim) && !ladder_sim_older(sim, NULL) &&
	       ladder_sim_runs_all_of(sim, page->document, ladder_shown_page_pou(page));
}

static void follow(LadderShownPage *page)
{
	const guint part = gtk_drop_down_get_selected(page->parts);
	const bool may = page->made && !page->broken && part < page->pous->len && may_follow(page);

	if (may && !ladder_sim_is_on(page->sim))
		page->broken = !ladder_sim_follow(page->sim, page->followed, g_array_index(page->pous, int, part));
	else if (!may && page->sim)
		ladder_sim_end(page->sim);
}

static void show_part(LadderShownPage *page)
{
	const guint part = gtk_drop_down_get_selected(page->parts);

	if (page->filling || !page->made || part >= page->pous->len)
		return;
	put_child(page, page->make(page->core, page->made, g_array_index(page->pous, int, part), page->sim));
	ladder_sim_end(page->sim);
	follow(page);
}

static void fill_parts(LadderShownPage *page)
{
	const struct project *before = ladder_document_project(page->document);
	const struct project *after = ladder_document_project(page->made);
	const guint was = gtk_drop_down_get_selected(page->parts);
	GPtrArray *names = g_ptr_array_new();

	g_array_set_size(page->pous, 0);
	for (int i = 0; i < after->pou_count; i++) {
		if (!pou_is_made(before, page->name, after, i))
			continue;
		g_array_append_val(page->pous, i);
		g_ptr_array_add(names, (gpointer)project_text(after, after->pou[i].name));
	}
	page->filling = true;
	drop_fill(page->parts, names);
	gtk_drop_down_set_selected(page->parts, was < names->len ? was : 0);
	page->filling = false;
	gtk_widget_set_visible(GTK_WIDGET(page->parts), names->len > 1);
	g_ptr_array_unref(names);
	show_part(page);
}

static void show_reasons(LadderShownPage *page, const struct diag_list *why)
{
	GtkWidget *problems = ladder_problems_new();

	gtk_widget_set_visible(GTK_WIDGET(page->parts), FALSE);
	ladder_problems_show(LADDER_PROBLEMS(problems), page->document, why);
	put_child(page, problems);
}

static void say(LadderShownPage *page)
{
	const char *text = page->made ? _("“%s” as %s, read-only") : _("“%s” cannot be shown as %s");
	char *said = g_strdup_printf(text, page->name, pou_language_word(page->to));

	gtk_label_set_text(page->label, said);
	gtk_button_set_label(page->convert, _(verb_row(pou_convert_verb(page->to, true))->label));
	gtk_actionable_set_action_name(GTK_ACTIONABLE(page->convert), verb_row(pou_convert_verb(page->to, true))->action);
	gtk_widget_set_visible(GTK_WIDGET(page->convert), page->made != NULL);
	g_free(said);
}

/* A document of its own with this text. NULL: a file that it names cannot be read, as one that is not saved yet;
 * @why gets the reason. */
static LadderDocument *made_of(LadderShownPage *page, const char *text, struct diag_list *why)
{
	LadderDocument *made = ladder_document_new();
	const struct diag *first;

	if (ladder_document_path(page->document))
		ladder_document_open_text(made, ladder_document_path(page->document), text, strlen(text), true);
	else
		ladder_document_open_copy(made, ladder_document_file(page->document), text, strlen(text), true);
	ladder_document_fix(made);
	if (ladder_document_project(made))
		return made;
	ladder_document_check_now(made);
	first = ladder_document_diags(made)->count ? &ladder_document_diags(made)->diag[0] : NULL;
	if (first) {
		const struct diag place = { .id = first->id, .file = g_intern_string(first->file), .line = first->line };

		diag_add(why, place, "%s", first->arg);
	}
	g_object_unref(made);
	return NULL;
}

static void drop_made(LadderShownPage *page)
{
	if (page->sim)
		ladder_sim_end(page->sim);
	g_clear_object(&page->sim);
	g_clear_object(&page->made);
	page->broken = false;
}

static void show_now(LadderShownPage *page)
{
	const int pou = ladder_shown_page_pou(page);
	struct diag_list *why;
	char *text;

	if (ladder_shown_page_is_over(page))
		return;
	page->shown = true;
	page->version = ladder_document_version(page->document);
	why = g_new0(struct diag_list, 1);
	text = pou_converted(page->document, pou, page->to, why);
	drop_made(page);
	if (text)
		page->made = made_of(page, text, why);
	if (page->made)
		page->sim = ladder_sim_new(page->made);
	say(page);
	if (page->made)
		fill_parts(page);
	else
		show_reasons(page, why);
	free(text);
	g_free(why);
}

/* Converting builds the project: only what is visible is made anew. */
static void changed(LadderShownPage *page)
{
	if (page->shown && page->version == ladder_document_version(page->document))
		return;
	page->shown = false;
	if (gtk_widget_get_mapped(GTK_WIDGET(page)))
		show_now(page);
}

static void seen(LadderShownPage *page)
{
	if (!page->shown)
		show_now(page);
	follow(page);
}

void ladder_shown_page_set(LadderShownPage *page, int pou, enum pou_language to)
{
	const struct project *project = ladder_document_project(page->document);

	g_free(page->name);
	page->name = g_strdup(project_text(project, project->pou[pou].name));
	page->to = to;
	ladder_shown_page_follow(page, false);
	show_now(page);
}

static void ladder_shown_page_dispose(GObject *object)
{
	LadderShownPage *page = LADDER_SHOWN_PAGE(object);

	if (page->document)
		g_signal_handlers_disconnect_by_data(page->document, page);
	if (page->followed)
		g_signal_handlers_disconnect_by_data(page->followed, page);
	g_clear_object(&page->followed);
	g_clear_object(&page->document);
	drop_made(page);
	g_clear_pointer(&page->name, g_free);
	g_clear_pointer(&page->pous, g_array_unref);
	G_OBJECT_CLASS(ladder_shown_page_parent_class)->dispose(object);
}

static void ladder_shown_page_class_init(LadderShownPageClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_shown_page_dispose;
}

static void ladder_shown_page_init(LadderShownPage *page)
{
	GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);

	gtk_orientable_set_orientation(GTK_ORIENTABLE(page), GTK_ORIENTATION_VERTICAL);
	page->pous = g_array_new(FALSE, FALSE, sizeof(int));
	page->label = GTK_LABEL(gtk_label_new(NULL));
	page->parts = GTK_DROP_DOWN(gtk_drop_down_new(NULL, NULL));
	page->convert = GTK_BUTTON(gtk_button_new_with_label(""));
	gtk_label_set_xalign(page->label, 0);
	gtk_label_set_wrap(page->label, TRUE);
	gtk_widget_set_hexpand(GTK_WIDGET(page->label), TRUE);
	spoken_name(page->parts, _("Program or block"));
	gtk_widget_set_valign(GTK_WIDGET(page->convert), GTK_ALIGN_CENTER);
	gtk_widget_set_valign(GTK_WIDGET(page->parts), GTK_ALIGN_CENTER);
	gtk_widget_set_visible(GTK_WIDGET(page->parts), FALSE);
	gtk_widget_add_css_class(bar, "stand-bar");
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(page->label));
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(page->parts));
	gtk_box_append(GTK_BOX(bar), GTK_WIDGET(page->convert));
	gtk_box_append(GTK_BOX(page), bar);
	g_signal_connect_swapped(page->parts, "notify::selected", G_CALLBACK(show_part), page);
	g_signal_connect(page, "map", G_CALLBACK(seen), NULL);
	g_signal_connect_after(page, "unmap", G_CALLBACK(follow), NULL); /* then it is not mapped */
}

GtkWidget *ladder_shown_page_new(struct core *core,
				 GtkWidget *(*make)(struct core *core, LadderDocument *document, int pou,
						    LadderSim *sim))
{
	LadderShownPage *page = g_object_new(LADDER_TYPE_SHOWN_PAGE, NULL);

	page->core = core;
	page->make = make;
	page->document = g_object_ref(core->document);
	page->followed = g_object_ref(core->sim);
	g_signal_connect_swapped(core->document, "checked", G_CALLBACK(changed), page);
	g_signal_connect_swapped(core->sim, "state-changed", G_CALLBACK(follow), page);
	g_signal_connect_swapped(core->sim, "program-changed", G_CALLBACK(follow), page);
	return GTK_WIDGET(page);
}
