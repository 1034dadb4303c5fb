/* SPDX-License-Identifier: MIT
 *
 * project_tree - the project tree; see project_tree.h.
 */
#include "editor-gtk/panels/project_tree.h"

#include "editor-gtk/document/pou_convert.h"
#include "editor-gtk/document/pou_edit.h"
#include "editor-gtk/document/task_rows.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/row_move.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/panels/tree_rows.h"
#include "editor-gtk/kit/verbs.h"

#include <string.h>

struct tree {
	LadderDocument *document;
	LadderSim *sim;            /* NULL: none                               */
	GListStore *root;
	GtkTreeListModel *model;   /* owned by the selection                   */
	GtkSingleSelection *selection;
	GtkWidget *list, *panel;   /* owned by the panel                       */
	char *shape;       /* text form of the rows, to detect changes         */
	bool stale;        /* something not in `shape` may have changed        */
	guint timer;       /* compares `shape` when it elapses                 */
	LadderTreeRow *going; /* the row that was activated                    */
	guint going_soon;  /* idle that goes there                             */
};

/* Expands new headings. */
static void expand_headings(struct tree *tree, guint at, guint gone, guint come)
{
	(void)gone;
	for (guint i = at; i < at + come; i++) {
		GtkTreeListRow *row = gtk_tree_list_model_get_child_row(tree->model, i);

		gtk_tree_list_row_set_expanded(row, TRUE);
		g_object_unref(row);
	}
}

static int part_of(const LadderTreeRow *row)
{
	return row->kind == ROW_SYMBOLS ? SIM_SYMBOLS : row->kind == ROW_TYPES ? SIM_TYPES :
	       row->kind == ROW_TASKS ? SIM_TASKS : row->pou;
}

static bool is_part(const LadderTreeRow *row)
{
	return row->kind == ROW_POU || row->kind == ROW_SYMBOLS || row->kind == ROW_TYPES ||
	       row->kind == ROW_TASKS;
}

static void mark_missing(struct tree *tree, GListStore *rows)
{
	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(rows)); i++) {
		LadderTreeRow *row = g_list_model_get_item(G_LIST_MODEL(rows), i);

		if (is_part(row))
			tree_row_set_missing(row, ladder_sim_is_missing(tree->sim, tree->document,
									part_of(row), -1));
		if (row->kind == ROW_HEADING && row->rows)
			mark_missing(tree, row->rows);
		g_object_unref(row);
	}
}

static void mark_all_missing(struct tree *tree)
{
	if (tree->sim)
		mark_missing(tree, tree->root);
}

/* ---- unfolded rows ---- */

static LadderTreeRow *item_of(GtkTreeListRow *at)
{
	LadderTreeRow *row = gtk_tree_list_row_get_item(at);

	g_object_unref(row); /* the model has a reference */
	return row;
}

/* The kinds and names of the rows inside a heading that are unfolded. */
static GHashTable *unfolded(struct tree *tree)
{
	GHashTable *names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);

	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(tree->model)); i++) {
		GtkTreeListRow *at = g_list_model_get_item(G_LIST_MODEL(tree->model), i);
		const LadderTreeRow *row = item_of(at);

		if (gtk_tree_list_row_get_depth(at) && gtk_tree_list_row_get_expanded(at))
			g_hash_table_add(names, g_strdup_printf("%d%s", (int)row->kind, row->text));
		g_object_unref(at);
	}
	return names;
}

static void unfold(struct tree *tree, GHashTable *names)
{
	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(tree->model)); i++) {
		GtkTreeListRow *at = g_list_model_get_item(G_LIST_MODEL(tree->model), i);
		const LadderTreeRow *row = item_of(at);
		char *name = g_strdup_printf("%d%s", (int)row->kind, row->text);

		if (gtk_tree_list_row_get_depth(at) && g_hash_table_contains(names, name))
			gtk_tree_list_row_set_expanded(at, TRUE);
		g_free(name);
		g_object_unref(at);
	}
}

/* If the focus is on a row that disappears, it moves to the row now at that index. */
static void refill(struct tree *tree)
{
	GtkRoot *root = gtk_widget_get_root(tree->list);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;
	const bool here = focus && gtk_widget_is_ancestor(focus, tree->list);
	guint at = gtk_single_selection_get_selected(tree->selection), count;
	GHashTable *names = unfolded(tree);

	tree_rows_update(tree->root, tree->document);
	unfold(tree, names);
	g_hash_table_unref(names);
	mark_all_missing(tree);
	count = g_list_model_get_n_items(G_LIST_MODEL(tree->selection));
	if (!here)
		return;
	if (at != GTK_INVALID_LIST_POSITION && count &&
	    !gtk_single_selection_get_selected_item(tree->selection))
		gtk_single_selection_set_selected(tree->selection, MIN(at, count - 1));
	gtk_widget_grab_focus(tree->list);
	list_mend_focus(tree->list);
}

static char *shape_of(LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);
	const char *path = ladder_document_path(document);
	GString *shape = g_string_new(path);

	for (int i = 0; project && i < project->pou_count; i++)
		g_string_append_printf(shape, "%s %d %d\n",
			project_text(project, project->pou[i].name),
			(int)project->pou[i].kind, project->pou[i].rung_count);
	for (int i = 0; project && i < project->structure_count; i++)
		g_string_append_printf(shape, "%s %d\n", project_text(project, project->structure[i].name),
				       project->structure[i].vars.count);
	for (int i = 0; project && i < project->named_count; i++)
		g_string_append_printf(shape, "%s\n", project_text(project, project->named[i].name));
	if (project)
		g_string_append_printf(shape, "%d %d %s", listing_symbol_count(project),
				       project->part_count, project_view(project));
	return g_string_free(shape, FALSE);
}

static void follow(struct tree *tree)
{
	char *shape = shape_of(tree->document);
	const bool same = !tree->stale && g_strcmp0(shape, tree->shape) == 0;

	tree->stale = false;
	g_free(tree->shape);
	tree->shape = shape;
	if (!same)
		refill(tree);
}

static gboolean follow_now(gpointer data)
{
	struct tree *tree = data;

	tree->timer = 0;
	follow(tree);
	return G_SOURCE_REMOVE;
}

/* Counts are updated with a delay, so that typing does not wait for them. */
static void follow_later(struct tree *tree)
{
	if (!tree->timer)
		tree->timer = g_timeout_add(100, follow_now, tree);
}

/* Only names of variables and the like may have changed if it has the same shape. */
static void project_changed(struct tree *tree)
{
	char *shape = shape_of(tree->document);
	const bool same = g_strcmp0(shape, tree->shape) == 0;

	tree->stale = true;
	if (same)
		follow_later(tree);
	else
		follow(tree);
	g_free(shape);
}

static void variable_changed(struct tree *tree)
{
	tree->stale = true;
	follow_later(tree);
}

/* ---- acting ---- */

static LadderTreeRow *row_at(struct tree *tree, guint position)
{
	GtkTreeListRow *item = g_list_model_get_item(G_LIST_MODEL(tree->selection),
						     position);
	LadderTreeRow *row = item ? gtk_tree_list_row_get_item(item) : NULL;

	g_clear_object(&item);
	if (row)
		g_object_unref(row); /* the model has a reference */
	return row;
}

static gboolean go(gpointer data)
{
	struct tree *tree = data;
	LadderTreeRow *row = tree->going;

	tree->going_soon = 0;
	if (row->kind == ROW_POU || row->kind == ROW_BOOKMARK ||
	    (row->kind == ROW_RUNS && row->pou >= 0))
		gtk_widget_activate_action(tree->list, "win.go-to", "(iiii)", row->pou,
					   row->rung, -1, -1);
	else if (row->kind == ROW_TEXT)
		gtk_widget_activate_action(tree->list, "win.open-text", "s", row->path);
	else if (row->kind == ROW_CHART)
		gtk_widget_activate_action(tree->list, "win.show-chart", "s", row->path);
	else if (row->kind == ROW_BOARD)
		gtk_widget_activate_action(tree->list, "win.connect-board", "s", row->path);
	else if (row->kind == ROW_SYMBOLS)
		gtk_widget_activate_action(tree->list, "win.symbols", NULL);
	else if (row->kind == ROW_TASKS || row->kind == ROW_TASK)
		gtk_widget_activate_action(tree->list, "win.show-task", "s",
					   row->kind == ROW_TASK ? row->text : "");
	else if (row->kind == ROW_ADDRESSES)
		gtk_widget_activate_action(tree->list, "win.address_map", NULL);
	else if (row->kind == ROW_TYPES)
		gtk_widget_activate_action(tree->list, "win.types", NULL);
	else if (row->kind == ROW_STRUCTURE)
		gtk_widget_activate_action(tree->list, "win.show-type", "s", row->text);
	g_clear_object(&tree->going);
	return G_SOURCE_REMOVE;
}

/* Later, because the click moves the focus to the row after this signal; the sheet would
 * lose it. */
static void activated(struct tree *tree, guint position)
{
	LadderTreeRow *row = row_at(tree, position);

	if (!row)
		return;
	g_set_object(&tree->going, row);
	if (!tree->going_soon)
		tree->going_soon = g_idle_add(go, tree);
}

static int selected_pou(struct tree *tree)
{
	LadderTreeRow *row = row_at(tree,
		gtk_single_selection_get_selected(tree->selection));

	return row && row->kind == ROW_POU ? row->pou : -1;
}

/* Its name; NULL: no structure is selected. */
static const char *selected_type(struct tree *tree)
{
	LadderTreeRow *row = row_at(tree,
		gtk_single_selection_get_selected(tree->selection));

	return row && row->kind == ROW_STRUCTURE ? row->text : NULL;
}

/* Its name; NULL: no task is selected. */
static const char *selected_task(struct tree *tree)
{
	LadderTreeRow *row = row_at(tree,
		gtk_single_selection_get_selected(tree->selection));

	return row && row->kind == ROW_TASK ? row->text : NULL;
}

static bool is_of_task(const LadderTreeRow *row)
{
	return row && (row->kind == ROW_TASK || row->kind == ROW_RUNS);
}

/* A task, or a program below one; NULL: another row is selected. */
static LadderTreeRow *selected_of_task(struct tree *tree)
{
	LadderTreeRow *row = row_at(tree,
		gtk_single_selection_get_selected(tree->selection));

	return is_of_task(row) ? row : NULL;
}

static void tell(struct tree *tree, const char *text)
{
	gtk_widget_activate_action(tree->list, "win.tell", "s", text);
}

/* The number of a row of the tasks in @tasks; -1: none. */
static int number_of(const struct task_rows *tasks, const LadderTreeRow *row)
{
	return task_rows_find(tasks, (enum task_what)row->what, row->text);
}

/* A program out of its task. */
static void remove_run(struct tree *tree, const LadderTreeRow *row)
{
	struct task_rows *tasks = task_rows_new(tree->document);
	char *why = NULL;

	if (!task_rows_delete(tree->document, number_of(tasks, row), &why))
		tell(tree, why);
	task_rows_free(tasks);
	g_free(why);
}

/* Activates the action of the window for the selected row: "tree.rename" becomes
 * "win.rename-pou", "win.rename-type" or "win.rename-task". */
static void act_on_row(GSimpleAction *action, GVariant *unused, gpointer data)
{
	struct tree *tree = data;
	const int pou = selected_pou(tree);
	const char *type = selected_type(tree), *task = selected_task(tree);
	const LadderTreeRow *run = selected_of_task(tree);
	const char *act = g_action_get_name(G_ACTION(action));
	char *name = g_strdup_printf("win.%s-%s", act, type ? "type" : task ? "task" : "pou");

	(void)unused;
	if (type)
		gtk_widget_activate_action(tree->list, name, "s", type);
	else if (task && (strcmp(act, "rename") == 0 || strcmp(act, "delete") == 0))
		gtk_widget_activate_action(tree->list, name, "s", task);
	else if (run && !task && strcmp(act, "delete") == 0)
		remove_run(tree, run);
	else if (pou < 0)
		tell(tree, _("Select a program, a block or a data type first"));
	else
		gtk_widget_activate_action(tree->list, name, "i", pou);
	g_free(name);
}

/* Where the selected POU or structure is used. */
static void show_uses(GSimpleAction *action, GVariant *unused, gpointer data)
{
	struct tree *tree = data;
	LadderTreeRow *row = row_at(tree,
		gtk_single_selection_get_selected(tree->selection));

	(void)action;
	(void)unused;
	if (row && (row->kind == ROW_POU || row->kind == ROW_STRUCTURE))
		gtk_widget_activate_action(tree->list, "win.show-uses", "s", row->text);
	else
		tell(tree, _("Select a program, a block or a data type first"));
}

/* ---- order ---- */

/* The selected row gets the focus, if another row of the tree has it. */
static void focus_selected(struct tree *tree)
{
	GtkRoot *root = gtk_widget_get_root(tree->list);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;
	const guint at = gtk_single_selection_get_selected(tree->selection);

	if (!focus || (focus != tree->list && !gtk_widget_is_ancestor(focus, tree->list)))
		return;
	for (GtkWidget *child = gtk_widget_get_first_child(tree->list); child;
	     child = gtk_widget_get_next_sibling(child)) {
		GtkWidget *expander = gtk_widget_get_first_child(child);
		GtkTreeListRow *row = GTK_IS_TREE_EXPANDER(expander) ?
			gtk_tree_expander_get_list_row(GTK_TREE_EXPANDER(expander)) : NULL;

		if (row && gtk_tree_list_row_get_position(row) == at)
			gtk_widget_grab_focus(child);
	}
}

static void select_pou(struct tree *tree, const char *name)
{
	const struct project *project = ladder_document_project(tree->document);

	ladder_project_tree_select(tree->panel, project_find_pou(project, name, strlen(name)),
				   NULL, "");
	focus_selected(tree);
}

/* The order of programs is the order in which they run, unless a CONFIGURATION lists them. */
static void tell_order(struct tree *tree, const char *name)
{
	const struct project *project = ladder_document_project(tree->document);
	const int pou = project_find_pou(project, name, strlen(name));
	const int before = pou_beside(tree->document, pou, -1);
	char *text = NULL;

	if (project->pou[pou].kind != POU_PROGRAM)
		return;
	if (!pou_order_counts(tree->document))
		text = g_strdup(_("The order in which programs run does not change: the CONFIGURATION sets it"));
	else if (before < 0)
		text = g_strdup_printf(_("“%s” now runs first in each scan"), name);
	else
		text = g_strdup_printf(_("“%s” now runs after “%s” in each scan"), name,
				       project_text(project, project->pou[before].name));
	tell(tree, text);
	g_free(text);
}

static void move(struct tree *tree, int pou, int beside, bool behind)
{
	const struct project *project = ladder_document_project(tree->document);
	char *name = g_strdup(project_text(project, project->pou[pou].name));
	const char *why = pou_move(tree->document, pou, beside, behind);

	if (why) {
		tell(tree, why);
	} else {
		select_pou(tree, name);
		tell_order(tree, name);
	}
	g_free(name);
}

/* ---- the order of tasks and their programs ---- */

static bool has_run(const LadderTreeRow *task, const char *name)
{
	bool found = false;

	for (guint i = 0; !found && i < g_list_model_get_n_items(G_LIST_MODEL(task->rows)); i++) {
		LadderTreeRow *row = g_list_model_get_item(G_LIST_MODEL(task->rows), i);

		found = strcmp(row->text, name) == 0;
		g_object_unref(row);
	}
	return found;
}

/* Selects a row of the tasks. A program's task is unfolded: rows behind @i come then. */
static void select_of_task(struct tree *tree, int what, const char *name)
{
	for (guint i = 0; i < g_list_model_get_n_items(G_LIST_MODEL(tree->model)); i++) {
		GtkTreeListRow *at = g_list_model_get_item(G_LIST_MODEL(tree->model), i);
		const LadderTreeRow *row = item_of(at);
		const bool found = is_of_task(row) && row->what == what && strcmp(row->text, name) == 0;

		if (row->kind == ROW_TASK && what == TASKS_INSTANCE && row->rows && has_run(row, name))
			gtk_tree_list_row_set_expanded(at, TRUE);
		g_object_unref(at);
		if (!found)
			continue;
		gtk_single_selection_set_selected(tree->selection, i);
		list_scroll_to(tree->list, i);
		focus_selected(tree);
		return;
	}
}

/* After an edit that may have moved a row of this kind and name. */
static void moved(struct tree *tree, int what, const char *name, bool good, char *why)
{
	if (good) {
		follow(tree);
		select_of_task(tree, what, name);
	} else {
		tell(tree, why);
	}
	g_free(why);
}

static void drop_of_task(struct tree *tree, const LadderTreeRow *row, const LadderTreeRow *target,
			 bool below)
{
	struct task_rows *tasks = task_rows_new(tree->document);
	const int what = row->what;
	char *name = g_strdup(row->text), *why = NULL;
	const bool good = task_rows_drop(tree->document, number_of(tasks, row),
					 number_of(tasks, target), below, &why);

	task_rows_free(tasks);
	moved(tree, what, name, good, why);
	g_free(name);
}

static void step_of_task(struct tree *tree, const LadderTreeRow *row, int by)
{
	struct task_rows *tasks = task_rows_new(tree->document);
	const int what = row->what, number = number_of(tasks, row);
	char *name = g_strdup(row->text), *why = NULL;
	const bool good = task_rows_step(tree->document, number, by, &why);

	task_rows_free(tasks);
	moved(tree, what, name, good, why);
	g_free(name);
}

static bool can_drag(struct tree *tree, const LadderTreeRow *row)
{
	struct task_rows *tasks = task_rows_new(tree->document);
	const bool can = !tasks->fixed && (row->what == TASKS_TASK || row->what == TASKS_INSTANCE);

	task_rows_free(tasks);
	return can;
}

/* ---- both ---- */

static void move_by(struct tree *tree, int by)
{
	const LadderTreeRow *of_task = selected_of_task(tree);
	const int pou = selected_pou(tree);
	const int beside = pou < 0 ? -1 : pou_beside(tree->document, pou, by);

	if (of_task)
		step_of_task(tree, of_task, by);
	else if (pou < 0)
		tell(tree, _("Select a program or block first"));
	else if (beside < 0)
		tell(tree, by < 0 ? _("It is the first one already") :
				    _("It is the last one already"));
	else
		move(tree, pou, beside, by > 0);
}

static void move_selected(GSimpleAction *action, GVariant *unused, gpointer data)
{
	(void)unused;
	move_by(data, strcmp(g_action_get_name(G_ACTION(action)), "up") == 0 ? -1 : 1);
}

/* ---- dragging ---- */

/* Rows are updated with a delay: their names are right, their indices may be old. */
static int pou_of(struct tree *tree, const LadderTreeRow *row)
{
	const struct project *project = ladder_document_project(tree->document);

	return project && row && row->kind == ROW_POU ?
	       project_find_pou(project, row->text, strlen(row->text)) : -1;
}

static const char *name_of(gpointer pointer, gpointer of)
{
	struct tree *tree = pointer;
	const struct project *project = ladder_document_project(tree->document);
	LadderTreeRow *row = of;

	if (is_of_task(row))
		return project && can_drag(tree, row) ? row->text : NULL;
	return row->kind == ROW_POU && !project->pou[row->pou].included ? row->text : NULL;
}

/* A program goes below the row of a task; a task goes before or behind another one. */
static bool fits_task(const LadderTreeRow *row, const LadderTreeRow *at, bool *below)
{
	*below |= row->kind == ROW_RUNS && at->kind == ROW_TASK;
	return is_of_task(at) && (row->kind == ROW_RUNS || at->kind == ROW_TASK);
}

static bool fits(gpointer pointer, gpointer row, gpointer target, bool *below)
{
	struct tree *tree = pointer;
	const struct project *project = ladder_document_project(tree->document);
	const int from = pou_of(tree, row), to = pou_of(tree, target);

	if (is_of_task(row))
		return fits_task(row, target, below);
	return from >= 0 && to >= 0 && from != to && !project->pou[to].included &&
	       (project->pou[from].kind == POU_PROGRAM) == (project->pou[to].kind == POU_PROGRAM);
}

static void move_to(gpointer tree, gpointer row, gpointer target, bool below)
{
	if (is_of_task(row))
		drop_of_task(tree, row, target, below);
	else
		move(tree, pou_of(tree, row), pou_of(tree, target), below);
}

static const struct row_move moving = {
	.up = "tree.up", .down = "tree.down", .name = name_of, .fits = fits, .move = move_to,
};

/* ---- menus and actions ---- */

static GMenu *menu_model(void)
{
	static const enum verb verbs[] = {
		VERB_new_program, VERB_new_list, VERB_new_chart, VERB_new_block,
		VERB_new_function, VERB_new_subroutine, VERB_new_type, VERB_new_task,
		VERB_import, VERB_new_iomap,
	};
	GMenu *menu = g_menu_new();

	for (gsize i = 0; i < G_N_ELEMENTS(verbs); i++)
		g_menu_append(menu, _(verb_row(verbs[i])->label), verb_row(verbs[i])->action);
	return menu;
}

/* With what the rows of POUs have, too: of the selected one. */
static GMenu *button_menu(void)
{
	GMenu *menu = menu_model();

	g_menu_append(menu, _("Rename…"), "tree.rename");
	g_menu_append(menu, _("Delete"), "tree.delete");
	return menu;
}

enum { POU = 1, TYPE = 2, TASK = 4, RUNS = 8 }; /* kinds of a row with a menu of its own */

/* The languages that the selected POU can be shown as or converted to, if there are some. */
static void append_languages(struct tree *tree, GMenu *section, const char *label, bool converts)
{
	const struct project *project = ladder_document_project(tree->document);
	const int pou = selected_pou(tree);
	GMenu *languages = g_menu_new();

	for (int to = LANGUAGE_LD; pou >= 0 && to <= LANGUAGE_FBD; to++) {
		const enum verb verb = pou_convert_verb((enum pou_language)to, converts);
		GMenuItem *item;

		if (!pou_can_become(project, pou, (enum pou_language)to))
			continue;
		item = g_menu_item_new(_(verb_row(verb)->label), NULL);
		g_menu_item_set_action_and_target(item, "win.language-of", "(is)", (int)verb,
						 project_text(project, project->pou[pou].name));
		g_menu_append_item(languages, item);
		g_object_unref(item);
	}
	if (g_menu_model_get_n_items(G_MENU_MODEL(languages)))
		g_menu_append_submenu(section, _(label), G_MENU_MODEL(languages));
	g_object_unref(languages);
}

/* The context menu of a POU, a structure, a task or a program below one. A structure cannot be moved: its order has no
 * meaning. */
static GMenu *row_menu(struct tree *tree, unsigned of)
{
	static const struct {
		const char *label, *action, *keys;
		enum verb verb; /* with the same keys; VERB_COUNT: @keys          */
		unsigned of;    /* 0: a line between parts                        */
	} entries[] = {
		{ N_("Duplicate…"), "tree.duplicate", "<Control>d", VERB_COUNT, POU | TYPE },
		{ N_("Rename…"), "tree.rename", NULL, VERB_rename, POU | TYPE | TASK },
		{ N_("Where it is used"), "tree.uses", NULL, VERB_show_uses, POU | TYPE },
		{ N_("Delete"), "tree.delete", "Delete", VERB_COUNT, POU | TYPE | TASK },
		{ N_("Remove program from task"), "tree.delete", "Delete", VERB_COUNT, RUNS },
		{ NULL, NULL, NULL, VERB_COUNT, 0 },
		{ N_("Move up"), "tree.up", "<Alt>Up", VERB_COUNT, POU | TASK | RUNS },
		{ N_("Move down"), "tree.down", "<Alt>Down", VERB_COUNT, POU | TASK | RUNS },
		{ N_("Copy to file…"), "tree.copy", "", VERB_COUNT, POU },
		{ N_("Move to file…"), "tree.move", "", VERB_COUNT, POU },
		{ NULL, NULL, NULL, VERB_COUNT, 0 },
		{ N_("Properties…"), "tree.about", "<Alt>Return", VERB_COUNT, POU },
	};
	GMenu *menu = g_menu_new(), *section = g_menu_new(), *fresh = menu_model();

	for (gsize i = 0; i < G_N_ELEMENTS(entries); i++)
		if (!entries[i].of) {
			g_menu_append_section(menu, NULL, G_MENU_MODEL(section));
			g_object_unref(section);
			section = g_menu_new();
		} else if (entries[i].of & of) {
			menu_append(section, _(entries[i].label), entries[i].action,
				    entries[i].keys ? entries[i].keys : verb_keys(entries[i].verb));
		}
	if (of == POU) {
		append_languages(tree, section, N_("Show as"), false);
		append_languages(tree, section, N_("Convert to"), true);
	}
	g_menu_append_submenu(section, _("New"), G_MENU_MODEL(fresh));
	g_menu_append_section(menu, NULL, G_MENU_MODEL(section));
	g_object_unref(section);
	g_object_unref(fresh);
	return menu;
}

/* Actions of the panel: for its keys, its menus, and F2 of the window. */
static void add_actions(struct tree *tree, GtkWidget *panel)
{
	const GActionEntry entries[] = {
		{ .name = "rename", .activate = act_on_row },
		{ .name = "delete", .activate = act_on_row },
		{ .name = "duplicate", .activate = act_on_row },
		{ .name = "copy", .activate = act_on_row },
		{ .name = "move", .activate = act_on_row },
		{ .name = "about", .activate = act_on_row },
		{ .name = "uses", .activate = show_uses },
		{ .name = "up", .activate = move_selected },
		{ .name = "down", .activate = move_selected },
	};
	GSimpleActionGroup *group = g_simple_action_group_new();

	g_action_map_add_action_entries(G_ACTION_MAP(group), entries,
					G_N_ELEMENTS(entries), tree);
	gtk_widget_insert_action_group(panel, "tree", G_ACTION_GROUP(group));
	g_object_unref(group);
}

static GtkWidget *menu_new(void)
{
	GtkWidget *button = gtk_menu_button_new();

	popover_menu_of(GTK_MENU_BUTTON(button), button_menu);
	gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "list-add-symbolic");
	tip_set(button, _("Add, rename or delete"));
	spoken_name(button, _("Add, rename or delete"));
	gtk_widget_add_css_class(button, "flat");
	return button;
}

/* ---- the menu of a row ---- */

static void show_menu(struct tree *tree, double x, double y)
{
	const unsigned of = selected_pou(tree) >= 0 ? POU : selected_type(tree) ? TYPE :
			    selected_task(tree) ? TASK : selected_of_task(tree) ? RUNS : 0;

	/* not on the scrolled window, which takes the arrow keys */
	gtk_widget_translate_coordinates(tree->list, tree->panel, x, y, &x, &y);
	popover_menu(tree->panel, of ? row_menu(tree, of) : menu_model(),
		     &(GdkRectangle){ (int)x, (int)y, 1, 1 }, tree->list);
}

/* The menu is for the row below the pointer. */
static void right_pressed(struct tree *tree, int count, double x, double y)
{
	GtkListItem *item = row_move_at(tree->list, x, y);

	(void)count;
	if (item)
		gtk_single_selection_set_selected(tree->selection,
						  gtk_list_item_get_position(item));
	show_menu(tree, x, y);
}

static gboolean key_pressed(struct tree *tree, guint key, guint code, GdkModifierType state)
{
	const GdkModifierType held = state & gtk_accelerator_get_default_mod_mask();

	(void)code;
	if (key == GDK_KEY_Menu || (key == GDK_KEY_F10 && state & GDK_SHIFT_MASK))
		show_menu(tree, 20, 20);
	else if (key == GDK_KEY_Delete && !held)
		gtk_widget_activate_action(tree->list, "tree.delete", NULL);
	else if (gdk_keyval_to_lower(key) == GDK_KEY_d && held == GDK_CONTROL_MASK)
		gtk_widget_activate_action(tree->list, "tree.duplicate", NULL);
	else if (key == GDK_KEY_Return && held == GDK_ALT_MASK)
		gtk_widget_activate_action(tree->list, "tree.about", NULL);
	else
		return FALSE;
	return TRUE;
}

static void add_controllers(struct tree *tree)
{
	GtkGesture *click = gtk_gesture_click_new();
	GtkEventController *keys = gtk_event_controller_key_new();

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_SECONDARY);
	g_signal_connect_swapped(click, "pressed", G_CALLBACK(right_pressed), tree);
	g_signal_connect_swapped(keys, "key-pressed", G_CALLBACK(key_pressed), tree);
	gtk_widget_add_controller(tree->list, GTK_EVENT_CONTROLLER(click));
	gtk_widget_add_controller(tree->list, keys);
}

/* ---- the widget ---- */

/* A name that is completely visible needs no tooltip. */
static gboolean query_tip(GtkLabel *label, int x, int y, gboolean by_key, GtkTooltip *tooltip)
{
	(void)x, (void)y, (void)by_key;
	return tip_show(tooltip, pango_layout_is_ellipsized(gtk_label_get_layout(label)) ?
			gtk_label_get_text(label) : NULL);
}

static void setup_tip(GtkWidget *label)
{
	gtk_widget_set_has_tooltip(label, TRUE);
	g_signal_connect(label, "query-tooltip", G_CALLBACK(query_tip), NULL);
}

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	GtkWidget *expander = gtk_tree_expander_new();
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
	GtkWidget *text = gtk_label_new(NULL), *note = gtk_label_new(NULL);
	GtkWidget *arrow = gtk_label_new("\xe2\x86\x93");

	(void)factory;
	gtk_label_set_xalign(GTK_LABEL(text), 0);
	gtk_label_set_ellipsize(GTK_LABEL(text), PANGO_ELLIPSIZE_END);
	gtk_widget_set_hexpand(text, TRUE);
	gtk_widget_add_css_class(note, "dim-label");
	gtk_widget_add_css_class(note, "caption");
	gtk_label_set_ellipsize(GTK_LABEL(note), PANGO_ELLIPSIZE_END);
	gtk_box_append(GTK_BOX(box), text);
	gtk_box_append(GTK_BOX(box), note);
	gtk_box_append(GTK_BOX(box), arrow);
	gtk_widget_add_css_class(arrow, "not-downloaded");
	tip_set(arrow, _("not downloaded"));
	setup_tip(text);
	setup_tip(note);
	gtk_tree_expander_set_child(GTK_TREE_EXPANDER(expander), box);
	gtk_list_item_set_child(item, expander);
	row_move_stand(expander, item);
}

#define TEXT_WIDE 20 /* characters that remain for the text beside a note */
/* Of a bookmark the place must be seen, too: it tells two rungs of one title apart. */
#define TITLE_WIDE 8
#define PLACE_WIDE 8

/* The accessible name of the row, set on the widget that takes the focus too. */
static void speak(LadderTreeRow *row, GtkWidget *expander)
{
	GtkWidget *of_row = gtk_widget_get_parent(expander);
	char *name = g_strdup_printf("%s%s%s%s%s", row->text, row->note ? ", " : "",
				     row->note ? row->note : "", row->missing ? ", " : "",
				     row->missing ? _("not downloaded") : "");

	spoken_name(expander, name);
	if (of_row)
		spoken_name(of_row, name);
	g_free(name);
}

static void show_note(LadderTreeRow *row, GtkLabel *note)
{
	GtkWidget *widget = GTK_WIDGET(note), *arrow = gtk_widget_get_next_sibling(widget);

	gtk_widget_set_visible(arrow, row->missing);
	gtk_label_set_text(note, row->note ? row->note : "");
	gtk_widget_set_visible(widget, row->note != NULL);
	speak(row, gtk_widget_get_ancestor(widget, GTK_TYPE_TREE_EXPANDER));
}

static GtkWidget *text_of(GtkListItem *item)
{
	GtkWidget *expander = gtk_list_item_get_child(item);

	return gtk_widget_get_first_child(gtk_tree_expander_get_child(
		GTK_TREE_EXPANDER(expander)));
}

/* The width of a text in average characters, as GTK counts: narrow letters leave their room to the note. */
static int chars_wide(GtkWidget *label, const char *text)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(label, text);
	PangoFontMetrics *metrics = pango_context_get_metrics(pango_layout_get_context(layout),
							      NULL, NULL);
	const int each = MAX(pango_font_metrics_get_approximate_char_width(metrics),
			     pango_font_metrics_get_approximate_digit_width(metrics));
	int width;

	pango_layout_get_size(layout, &width, NULL);
	pango_font_metrics_unref(metrics);
	g_object_unref(layout);
	return (width + each - 1) / MAX(each, 1);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	GtkTreeListRow *list_row = gtk_list_item_get_item(item);
	LadderTreeRow *row = gtk_tree_list_row_get_item(list_row);
	GtkWidget *text = text_of(item), *note = gtk_widget_get_next_sibling(text);
	const bool place = row->kind == ROW_BOOKMARK && row->note;

	(void)factory;
	gtk_tree_expander_set_list_row(GTK_TREE_EXPANDER(gtk_list_item_get_child(item)),
				       list_row);
	gtk_label_set_text(GTK_LABEL(text), row->text);
	gtk_label_set_width_chars(GTK_LABEL(text), MIN(chars_wide(text, row->text),
						       place ? TITLE_WIDE : TEXT_WIDE));
	gtk_label_set_width_chars(GTK_LABEL(note), place ? MIN(chars_wide(note, row->note),
							       PLACE_WIDE) : -1);
	show_note(row, GTK_LABEL(note));
	g_signal_connect_object(row, "changed", G_CALLBACK(show_note), note, 0);
	g_object_set_data_full(G_OBJECT(note), "row", row, g_object_unref);
}

/* By now the list row may have no item. */
static void unbind(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	GtkWidget *note = gtk_widget_get_next_sibling(text_of(item));
	LadderTreeRow *row = g_object_steal_data(G_OBJECT(note), "row");

	(void)factory;
	g_signal_handlers_disconnect_by_func(row, show_note, note);
	g_object_unref(row);
}

static GListModel *children(gpointer item, gpointer data)
{
	const struct tree *tree = data;

	return tree_row_children(LADDER_TREE_ROW(item), tree->document);
}

static void tree_free(gpointer pointer)
{
	struct tree *tree = pointer;

	g_clear_handle_id(&tree->timer, g_source_remove);
	g_clear_handle_id(&tree->going_soon, g_source_remove);
	g_clear_object(&tree->going);
	if (tree->sim)
		g_signal_handlers_disconnect_by_data(tree->sim, tree);
	g_clear_object(&tree->sim);
	if (settings_get())
		g_signal_handlers_disconnect_by_data(settings_get(), tree);
	g_signal_handlers_disconnect_by_data(tree->document, tree);
	g_object_unref(tree->document);
	g_free(tree->shape);
	g_free(tree);
}

static GtkWidget *heading_new(void)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
	GtkWidget *label = gtk_label_new(_("PROJECT"));

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_set_hexpand(label, TRUE);
	gtk_widget_add_css_class(label, "panel-heading");
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), menu_new());
	return box;
}

static void make_list(struct tree *tree)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();

	tree->root = g_list_store_new(LADDER_TYPE_TREE_ROW);
	tree->model = gtk_tree_list_model_new(G_LIST_MODEL(tree->root), FALSE, FALSE,
					      children, tree, NULL);
	g_signal_connect_swapped(tree->root, "items-changed", G_CALLBACK(expand_headings),
				 tree); /* after the handlers of the model */
	tree->selection = gtk_single_selection_new(G_LIST_MODEL(tree->model));
	gtk_single_selection_set_autoselect(tree->selection, FALSE);
	gtk_single_selection_set_can_unselect(tree->selection, TRUE);
	g_signal_connect(factory, "setup", G_CALLBACK(setup), NULL);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), NULL);
	g_signal_connect(factory, "unbind", G_CALLBACK(unbind), NULL);
	tree->list = gtk_list_view_new(GTK_SELECTION_MODEL(tree->selection), factory);
	gtk_widget_add_css_class(tree->list, "navigation-sidebar");
	gtk_widget_add_css_class(tree->list, "project");
	spoken_name(tree->list, _("Project"));
	g_signal_connect_swapped(tree->list, "activate", G_CALLBACK(activated), tree);
}

static bool is_of(const LadderTreeRow *row, int pou, const char *path, const char *page)
{
	return (row->kind == ROW_POU && row->pou == pou) ||
	       (row->kind == ROW_FILE && path && g_strcmp0(row->path, path) == 0) ||
	       (row->kind == ROW_SYMBOLS && strcmp(page, " symbols") == 0) ||
	       (row->kind == ROW_TASKS && strcmp(page, " tasks") == 0) ||
	       (row->kind == ROW_TYPES && strcmp(page, " types") == 0) ||
	       (row->kind == ROW_ADDRESSES && strcmp(page, " addresses") == 0);
}

void ladder_project_tree_select(GtkWidget *box, int pou, const char *path, const char *page)
{
	struct tree *tree = g_object_get_data(G_OBJECT(box), "tree");
	GListModel *rows = G_LIST_MODEL(tree->selection);
	guint found = GTK_INVALID_LIST_POSITION;

	if (strcmp(page, " types") == 0 && selected_type(tree))
		return; /* the page shows this one */
	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		GtkTreeListRow *at = g_list_model_get_item(rows, i);
		LadderTreeRow *row = gtk_tree_list_row_get_item(at);

		if (is_of(row, pou, path, page))
			found = i;
		g_object_unref(row);
		g_object_unref(at);
	}
	gtk_single_selection_set_selected(tree->selection, found);
	if (found != GTK_INVALID_LIST_POSITION)
		list_scroll_to(tree->list, found);
}

void ladder_project_tree_set_sim(GtkWidget *box, LadderSim *sim)
{
	struct tree *tree = g_object_get_data(G_OBJECT(box), "tree");

	tree->sim = g_object_ref(sim);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(mark_all_missing), tree);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(mark_all_missing), tree);
	g_signal_connect_swapped(tree->document, "rungs-changed", G_CALLBACK(mark_all_missing),
				 tree);
}

void ladder_project_tree_look(GtkWidget *box)
{
	refill(g_object_get_data(G_OBJECT(box), "tree"));
}

GtkWidget *ladder_project_tree_new(LadderDocument *document)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *scroller = gtk_scrolled_window_new();
	struct tree *tree = g_new0(struct tree, 1);

	tree->document = g_object_ref(document);
	tree->panel = box;
	make_list(tree);
	add_controllers(tree);
	row_move_add(tree->list, &moving, tree);
	add_actions(tree, box);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), tree->list);
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_box_append(GTK_BOX(box), heading_new());
	gtk_box_append(GTK_BOX(box), list_tab_stop_new(scroller));
	g_object_set_data_full(G_OBJECT(box), "tree", tree, tree_free);
	g_signal_connect_swapped(document, "project-changed", G_CALLBACK(project_changed),
				 tree);
	g_signal_connect_swapped(document, "rungs-changed", G_CALLBACK(follow_later), tree);
	g_signal_connect_swapped(document, "variable-changed", G_CALLBACK(variable_changed),
				 tree);
	g_signal_connect_swapped(document, "bookmarks-changed", G_CALLBACK(follow), tree);
	g_signal_connect_swapped(document, "state-changed", G_CALLBACK(follow_later), tree);
	if (settings_get())
		g_signal_connect_swapped(settings_get(), "changed::boards", G_CALLBACK(refill), tree);
	follow(tree);
	return box;
}
