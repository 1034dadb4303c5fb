/* SPDX-License-Identifier: MIT
 *
 * problems - the list of problems; see problems.h.
 */
#include "editor-gtk/panels/problems.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/draw/place.h"
#include "engine/model/st.h"
#include "engine/xref/xref.h"

#include <string.h>

enum { COLUMN_TEXT, COLUMN_PLACE, COLUMN_CODE, COLUMN_SEVERITY };

struct _LadderProblems {
	GtkWidget parent_instance;
	GtkWidget *stack;       /* the list, or the page "no problems"          */
	struct panel_list list;
	LadderDocument *document;
	char *title;
	int count, errors;
};

G_DEFINE_FINAL_TYPE(LadderProblems, ladder_problems, GTK_TYPE_WIDGET)

static guint title_changed;

/* ---- rows ---- */

static int pou_of(const struct project *project, const char *name)
{
	return project && name ? project_find_pou(project, name, strlen(name)) : -1;
}

/* The text for the row of the symbol table. */
static char *declaration_text(const struct diag *diag)
{
	return diag->pou ? g_strdup_printf(_("%s, symbols"), diag->pou) :
			   g_strdup(_("Symbols"));
}

/* @row: 0-based line of the text of POU @pou; -1: none. Without a project the sheet is the text
 * of the file, where only its lines can be found. */
static char *place_text(const struct diag *diag, const struct project *project, int pou, int row,
			struct place_sheet *sheet)
{
	if (project && pou >= 0 && diag->rung)
		return place_cell(sheet, project, pou, diag->rung - 1, diag->row - 1,
				  diag->col - 1);
	if (project && pou >= 0 && row >= 0)
		return place_line(project, pou, row);
	if (!project && diag->line)
		return g_strdup_printf(_("line %d"), diag->line);
	if (diag->pou)
		return g_strdup(diag->pou);
	return diag->line ? g_strdup_printf(_("line %d"), diag->line) : g_strdup("");
}

static bool is_list(const struct project *project, int pou)
{
	return pou >= 0 && project->pou[pou].language != LANGUAGE_LD;
}

/* Is the line one of the statements of an EXECUTE box? */
static bool is_boxed(const struct pou *pou, int line)
{
	for (int i = 0; i < pou->boxed_count; i++) {
		const struct boxed *boxed = &pou->boxed[i];

		if (boxed->count > 0 && line > boxed->line &&
		    line <= pou->st->item[boxed->first + boxed->count - 1].line)
			return true;
	}
	return false;
}

/* In a list, the line in its text, whose first line is the heading. */
static int list_row(const struct project *project, int pou, int line)
{
	if (!line || (!is_list(project, pou) && (pou < 0 || !is_boxed(&project->pou[pou], line))))
		return -1;
	return MAX(line - project->pou[pou].line, 0);
}

static bool is_of_pou(const struct diag *diag)
{
	return diag->id == DIAG_NEVER_CALLED || diag->id == DIAG_NOT_RUN;
}

/* Finds the declaration that the message is about. */
static void find_declaration(struct project *project, const struct diag *diag,
			     LadderPanelRow *row)
{
	const uint32_t id = names_find(&project->names, diag->arg,
				       (size_t)diag_name_length(diag));
	const int table = row->pou + 1;
	const int index = !id || diag->rung ? -1 :
		vars_find(xref_table(project, table), names_fold(&project->names, id));

	if (index >= 0) {
		row->table = table;
		row->index = index;
	}
}

/* In a file that is no program: line and byte. */
static void set_place(LadderDocument *document, const struct diag *diag,
		      LadderPanelRow *row)
{
	struct project *project = ladder_document_project(document);
	struct ladder *checked = ladder_document_checked(document);
	const struct project *was = checked ? ladder_project(checked) : NULL;

	row->col = diag->rung ? diag->col - 1 : diag->column - 1;
	if (!project) {
		row->rung = diag->line - 1;
		return;
	}
	row->rung = diag->rung - 1;
	row->pou = pou_of(project, diag->pou);
	if (row->pou >= 0 && project->pou[row->pou].included && !diag->rung)
		return; /* its lines are those of another file */
	row->pou = -1;
	if (!diag->rung && diag->line) /* the project of an unreadable text may lack the POU */
		row->pou = ladder_document_list_at(document, diag->line, &row->row);
	if (row->pou >= 0)
		return;
	row->pou = pou_of(project, diag->pou);
	row->row = diag->rung ? diag->row - 1 : list_row(was, was ? pou_of(was, diag->pou) : -1,
							 diag->line);
	if (row->row < 0 && !diag->rung && diag->line && is_list(project, row->pou))
		row->row = 0; /* not a line of this POU */
	if (row->row < 0 && !diag->rung && !is_of_pou(diag))
		find_declaration(project, diag, row);
}

static LadderPanelRow *row_of(LadderDocument *document, const struct diag *diag,
			      struct place_sheet *sheet)
{
	LadderPanelRow *row = ladder_panel_row_new();
	const bool error = diag_severity(diag->id) == SEVERITY_ERROR;

	set_place(document, diag, row);
	row->tone = error ? PANEL_ERROR : PANEL_WARNING;
	/* Either may be -1. */
	row->number = ((gint64)row->pou * (1 << 20) + row->rung) * (1 << 20) + diag->line;
	row->text[COLUMN_TEXT] = diag_said_whole(diag);
	row->text[COLUMN_PLACE] = row->table >= 0 ? declaration_text(diag) :
		place_text(diag, ladder_document_project(document), row->pou,
			   row->row, sheet);
	row->text[COLUMN_CODE] = g_strdup(diag_code(diag->id));
	row->text[COLUMN_SEVERITY] = g_strdup(error ? _("Error") : _("Warning"));
	row->note = g_strdup(row->text[COLUMN_SEVERITY]);
	row->spoken = g_strdup_printf("%s: %s. %s", row->text[COLUMN_SEVERITY],
				      row->text[COLUMN_TEXT], row->text[COLUMN_PLACE]);
	return row;
}

static void set_title(LadderProblems *problems)
{
	char *title = problems->count ?
		g_strdup_printf(_("Problems %d"), problems->count) :
		g_strdup(_("Problems"));

	if (g_strcmp0(title, problems->title) != 0) {
		g_free(problems->title);
		problems->title = g_steal_pointer(&title);
		g_signal_emit(problems, title_changed, 0);
	}
	g_free(title);
}

/* Errors first, each kind by its place. */
static int compare(gconstpointer left, gconstpointer right)
{
	const LadderPanelRow *a = *(LadderPanelRow *const *)left, *b = *(LadderPanelRow *const *)right;

	if (a->tone != b->tone)
		return a->tone == PANEL_ERROR ? -1 : 1;
	return (a->number > b->number) - (a->number < b->number);
}

static void fill(LadderProblems *problems, LadderDocument *document, const struct diag_list *diags)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	struct place_sheet sheet = { 0 };

	for (int i = 0; diags && i < diags->count; i++)
		g_ptr_array_add(rows, row_of(document, &diags->diag[i], &sheet));
	g_ptr_array_sort(rows, compare);
	panel_list_update(&problems->list, rows);
	problems->count = diags ? diags->count + diags->dropped : 0;
	problems->errors = diags ? diags->errors : 0;
	gtk_stack_set_visible_child_name(GTK_STACK(problems->stack),
					 rows->len ? "list" : "none");
	set_title(problems);
	g_ptr_array_unref(rows);
}

/* Also while hidden, because the tab shows the count. */
static void refresh(LadderProblems *problems)
{
	LadderDocument *document = problems->document;

	fill(problems, document, document ? ladder_document_diags(document) : NULL);
}

/* ---- the widget ---- */

static void activated(GtkColumnView *view, guint at, LadderProblems *problems)
{
	LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(problems->list.selection),
						    at);

	(void)view;
	panel_go_to(GTK_WIDGET(problems), row);
	g_clear_object(&row);
}

bool ladder_problems_next(LadderProblems *problems, bool back)
{
	GtkSingleSelection *selection = problems->list.selection;
	const guint count = g_list_model_get_n_items(G_LIST_MODEL(selection));
	guint at = gtk_single_selection_get_selected(selection);

	if (!count)
		return false;
	if (at == GTK_INVALID_LIST_POSITION)
		at = back ? count - 1 : 0;
	else
		at = (at + (back ? count - 1 : 1)) % count;
	panel_list_go(&problems->list, at);
	panel_go_to(GTK_WIDGET(problems), panel_list_row(&problems->list));
	return true;
}

const char *ladder_problems_code(LadderProblems *problems)
{
	LadderPanelRow *row = panel_list_row(&problems->list);

	return row ? panel_row_text(row, COLUMN_CODE) : "";
}

const char *ladder_problems_current(LadderProblems *problems)
{
	const LadderPanelRow *row = panel_list_row(&problems->list);

	return row ? row->spoken : "";
}

bool ladder_problems_show_error(LadderProblems *problems)
{
	GtkSingleSelection *selection = problems->list.selection;

	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(selection)); i++) {
		LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(selection), i);
		const bool error = row->tone == PANEL_ERROR;

		g_object_unref(row);
		if (!error)
			continue;
		panel_list_go(&problems->list, i);
		panel_go_to(GTK_WIDGET(problems), panel_list_row(&problems->list));
		return true;
	}
	return false;
}

const char *ladder_problems_title(LadderProblems *problems)
{
	return problems->title;
}

int ladder_problems_count(LadderProblems *problems, bool errors)
{
	return errors ? problems->errors : problems->count;
}

void ladder_problems_set_document(LadderProblems *problems, LadderDocument *document)
{
	if (problems->document == document)
		return;
	if (problems->document)
		g_signal_handlers_disconnect_by_data(problems->document, problems);
	g_set_object(&problems->document, document);
	if (document)
		g_signal_connect_swapped(document, "checked", G_CALLBACK(refresh), problems);
	refresh(problems);
}

void ladder_problems_show(LadderProblems *problems, LadderDocument *document, const struct diag_list *diags)
{
	gtk_column_view_set_single_click_activate(GTK_COLUMN_VIEW(problems->list.view), TRUE);
	fill(problems, document, diags);
}

static void dispose(GObject *object)
{
	LadderProblems *problems = LADDER_PROBLEMS(object);

	if (problems->document)
		g_signal_handlers_disconnect_by_data(problems->document, problems);
	g_clear_object(&problems->document);
	g_clear_pointer(&problems->stack, gtk_widget_unparent);
	panel_list_clear(&problems->list);
	g_clear_pointer(&problems->title, g_free);
	G_OBJECT_CLASS(ladder_problems_parent_class)->dispose(object);
}

static void ladder_problems_class_init(LadderProblemsClass *class)
{
	G_OBJECT_CLASS(class)->dispose = dispose;
	title_changed = g_signal_new("title-changed", LADDER_TYPE_PROBLEMS,
		G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
	gtk_widget_class_set_layout_manager_type(GTK_WIDGET_CLASS(class),
						 GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(GTK_WIDGET_CLASS(class),
		"/org/rungboard/Editor/ui/problems.ui");
	gtk_widget_class_bind_template_child(GTK_WIDGET_CLASS(class), LadderProblems, stack);
	panel_bind_list(GTK_WIDGET_CLASS(class), LadderProblems);
	gtk_widget_class_bind_template_callback(GTK_WIDGET_CLASS(class), activated);
}

static void ladder_problems_init(LadderProblems *problems)
{
	GtkWidget *widget = GTK_WIDGET(problems);

	gtk_widget_init_template(widget);
	panel_list_init(&problems->list, problems->list.view);
	panel_list_column(&problems->list, "", COLUMN_SEVERITY, PANEL_ICON, 0);
	/* The name in quotes comes first, so long texts are cut at the end. */
	panel_list_column(&problems->list, _("Problem"), COLUMN_TEXT,
			  PANEL_EXPAND | PANEL_MIDDLE, 0);
	panel_list_column(&problems->list, _("Place"), COLUMN_PLACE, PANEL_NUMBER, 260);
	panel_list_column(&problems->list, _("Code"), COLUMN_CODE, 0, 80);
	set_title(problems);
}

GtkWidget *ladder_problems_new(void)
{
	return g_object_new(LADDER_TYPE_PROBLEMS, NULL);
}
