/* SPDX-License-Identifier: MIT
 *
 * tree_rows - makes the rows of the project tree; see tree_rows.h.
 *
 * New rows are compared with the old ones; equal rows are kept.
 */
#include "editor-gtk/panels/tree_rows.h"

#include "editor-gtk/document/side_file.h"
#include "editor-gtk/document/task_rows.h"
#include "editor-gtk/document/type_edit.h"
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/live/watch.h"
#include "editor-gtk/sim/live_value.h"

#include "engine/base/name.h"

#include <string.h>

/* ---- rows ---- */

G_DEFINE_FINAL_TYPE(LadderTreeRow, ladder_tree_row, G_TYPE_OBJECT)

static guint changed;

static void ladder_tree_row_finalize(GObject *object)
{
	LadderTreeRow *row = LADDER_TREE_ROW(object);

	g_clear_object(&row->rows);
	g_free(row->text);
	g_free(row->note);
	g_free(row->path);
	G_OBJECT_CLASS(ladder_tree_row_parent_class)->finalize(object);
}

static void ladder_tree_row_class_init(LadderTreeRowClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_tree_row_finalize;
	changed = g_signal_new("changed", LADDER_TYPE_TREE_ROW, G_SIGNAL_RUN_LAST, 0, NULL,
			       NULL, NULL, G_TYPE_NONE, 0);
}

static void ladder_tree_row_init(LadderTreeRow *row)
{
	row->pou = -1;
}

static LadderTreeRow *add(GListStore *into, enum row_kind kind, const char *text,
			  char *note, GListStore *rows)
{
	LadderTreeRow *row = g_object_new(LADDER_TYPE_TREE_ROW, NULL);

	row->kind = kind;
	row->text = g_strdup(text);
	row->note = note;
	row->rows = rows;
	row->parent = rows != NULL;
	g_list_store_append(into, row);
	g_object_unref(row);
	return row;
}

static LadderTreeRow *add_row(GListStore *into, enum row_kind kind, const char *text,
			      char *note)
{
	return add(into, kind, text, note, NULL);
}

static LadderTreeRow *add_heading(GListStore *into, const char *text)
{
	return add(into, ROW_HEADING, text, NULL, g_list_store_new(LADDER_TYPE_TREE_ROW));
}

/* ---- filling ---- */

static void add_pous(GListStore *root, const struct project *project, const char *title,
		     bool programs)
{
	LadderTreeRow *heading = add_heading(root, title);

	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];
		char *note;
		LadderTreeRow *row;

		if ((pou->kind == POU_PROGRAM) != programs)
			continue;
		note = pou->sfc ? g_strdup_printf(ngettext("%d step", "%d steps",
			(unsigned long)pou->sfc->step_count), pou->sfc->step_count) :
			pou->language == LANGUAGE_LD ?
			g_strdup_printf(ngettext("%d rung", "%d rungs",
				(unsigned long)pou->rung_count), pou->rung_count) :
			g_strdup(pou_language_word(pou->language));
		row = add_row(heading->rows, ROW_POU, project_text(project, pou->name),
			      note);
		row->pou = i;
		row->parent = listing_count(&pou->vars) > 0;
	}
}

static void add_files(GListStore *root, const struct project *project)
{
	LadderTreeRow *heading = NULL;

	for (int i = 0; i < project->part_count; i++) {
		const struct part *part = &project->part[i];

		if ((part->kind != PART_INCLUDE && part->kind != PART_USES) ||
		    part->included)
			continue;
		if (!heading)
			heading = add_heading(root, _("Files"));
		add_row(heading->rows, ROW_FILE, project_text(project, part->text),
			g_strdup(part->kind == PART_USES ? "USES" : "INCLUDE"));
	}
}

/* Members or values of a type have rows below it. */
static bool has_parts(enum type_kind kind)
{
	return kind == TYPE_STRUCTURE || kind == TYPE_ENUMERATION;
}

/* What a type is, beside its name; NULL: a structure. Caller frees. */
static char *type_note(const struct project *project, int type)
{
	const enum type_kind kind = type_kind_of(project, type);

	return kind == TYPE_STRUCTURE ? NULL : has_parts(kind) ? g_strdup(type_kind_name(kind)) :
	       listing_type(project, type_like(project, type));
}

/* The page of data types, with the types below it. */
static void add_types(GListStore *root, const struct project *project)
{
	GArray *order = type_order(project);
	GListStore *rows = order->len ? g_list_store_new(LADDER_TYPE_TREE_ROW) : NULL;

	add(root, ROW_TYPES, _("Data types"), g_strdup_printf("%u", order->len), rows);
	for (guint i = 0; i < order->len; i++) {
		const int type = g_array_index(order, int, i);
		LadderTreeRow *row = add_row(rows, ROW_STRUCTURE, type_name(project, type),
					     type_note(project, type));

		row->pou = type;
		row->parent = has_parts(type_kind_of(project, type));
	}
	g_array_unref(order);
}

/* The period of a task, or "on" and its variable. */
static char *task_note(const struct project *project, const struct config_entry *task)
{
	char period[32];

	if (task->single)
		return g_strdup_printf(_("on %s"), project_text(project, task->single));
	live_time_print(task->interval_ns, period, sizeof(period));
	return g_strdup(period);
}

/* A program below a task. */
static void add_run(GListStore *rows, const struct project *project, uint32_t name, int pou)
{
	const char *text = project_text(project, name);
	const char *program = pou >= 0 ? project_text(project, project->pou[pou].name) : text;
	LadderTreeRow *row = add_row(rows, ROW_RUNS, text,
				     strcmp(program, text) == 0 ? NULL : g_strdup(program));

	row->pou = pou;
	row->what = TASKS_INSTANCE;
}

static int program_of(const struct project *project, const struct config_entry *entry)
{
	const char *name = project_text(project, entry->pou);

	return project_find_pou(project, name, strlen(name));
}

/* @task: string id; 0: programs without a task. */
static GListStore *runs_in(const struct project *project, uint32_t task)
{
	GListStore *rows = g_list_store_new(LADDER_TYPE_TREE_ROW);
	const struct config *config = project->config;
	const char *name = project_text(project, task);
	bool any = false;

	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];

		if (entry->kind != CONFIG_PROGRAM)
			continue;
		any = true;
		if (name_equal(project_text(project, entry->task), name))
			add_run(rows, project, entry->name, program_of(project, entry));
	}
	for (int i = 0; !any && !task && i < project->pou_count; i++)
		if (project->pou[i].kind == POU_PROGRAM)
			add_run(rows, project, project->pou[i].name, i);
	return rows;
}

static bool has_task(const struct config *config, const struct project *project, uint32_t task)
{
	for (int i = 0; i < config->count; i++)
		if (config->entry[i].kind == CONFIG_TASK &&
		    name_equal(project_text(project, config->entry[i].name), project_text(project, task)))
			return true;
	return false;
}

/* Programs with a task that is not there; those without a PROGRAM line, if there are such lines. */
static GListStore *idle_runs(const struct project *project)
{
	GListStore *rows = g_list_store_new(LADDER_TYPE_TREE_ROW);
	const struct config *config = project->config;

	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];

		if (entry->kind == CONFIG_PROGRAM && entry->task && !has_task(config, project, entry->task))
			add_run(rows, project, entry->name, program_of(project, entry));
	}
	for (int pou = 0; pou < project->pou_count; pou++) {
		bool any = false, runs = false;

		for (int i = 0; config && i < config->count; i++)
			if (config->entry[i].kind == CONFIG_PROGRAM) {
				any = true;
				runs |= program_of(project, &config->entry[i]) == pou;
			}
		if (any && !runs && project->pou[pou].kind == POU_PROGRAM)
			add_run(rows, project, project->pou[pou].name, pou);
	}
	return rows;
}

static void add_task(GListStore *tasks, enum task_what what, const char *text, char *note,
		     GListStore *runs)
{
	LadderTreeRow *row = add(tasks, ROW_TASK, text, note, runs);

	row->what = what;
	row->parent = g_list_model_get_n_items(G_LIST_MODEL(runs)) > 0;
}

/* As task_rows.h, without the text of the whole project. */
static void add_tasks(GListStore *root, const struct project *project)
{
	GListStore *rows = g_list_store_new(LADDER_TYPE_TREE_ROW);
	const struct config *config = project->config;
	bool any = false, rest = false; /* PROGRAM lines; one without a task   */
	GListStore *idle = idle_runs(project);

	add(root, ROW_TASKS, _("Tasks"), NULL, rows);
	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];

		if (entry->kind == CONFIG_TASK)
			add_task(rows, TASKS_TASK, project_text(project, entry->name),
				 task_note(project, entry), runs_in(project, entry->name));
		any |= entry->kind == CONFIG_PROGRAM;
		rest |= entry->kind == CONFIG_PROGRAM && !entry->task;
	}
	if (!any || rest)
		add_task(rows, TASKS_EACH_SCAN, _("Each scan"), NULL, runs_in(project, 0));
	if (g_list_model_get_n_items(G_LIST_MODEL(idle)))
		add_task(rows, TASKS_IDLE, _("Do not run"), NULL, idle);
	else
		g_object_unref(idle);
}

/* Adds text files beside the project. */
static void add_texts(GListStore *root, LadderDocument *document, const char *title,
		      const char *ending, bool own)
{
	GPtrArray *files = side_file_list(ladder_document_path(document), ending, own);
	LadderTreeRow *heading = files->len ? add_heading(root, title) : NULL;

	for (guint i = 0; i < files->len; i++) {
		char *name = g_path_get_basename(files->pdata[i]);
		LadderTreeRow *row = add_row(heading->rows, ROW_TEXT, name, NULL);

		row->path = g_strdup(files->pdata[i]);
		g_free(name);
	}
	g_ptr_array_unref(files);
}

/* The values of an enumeration. */
static GListStore *values(const struct project *project, int type)
{
	GListStore *rows = g_list_store_new(LADDER_TYPE_TREE_ROW);
	int value;

	for (int i = 0; (value = type_value(project, type, i)) >= 0; i++)
		add_row(rows, ROW_VARIABLE, project_text(project, project->enum_value[value].name),
			g_strdup_printf("%lld", (long long)project->enum_value[value].number));
	return rows;
}

/* The variables of a POU or a structure, or the values of an enumeration. */
static GListStore *variables(const struct project *project, const LadderTreeRow *row)
{
	const struct var_table *vars;
	GListStore *rows;

	if (row->kind != ROW_POU && row->pou >= project->structure_count)
		return values(project, row->pou);
	vars = row->kind == ROW_POU ? &project->pou[row->pou].vars :
	       &project->structure[row->pou].vars;
	rows = g_list_store_new(LADDER_TYPE_TREE_ROW);
	for (int i = listing_first(vars); i < vars_declared(vars); i++)
		add_row(rows, ROW_VARIABLE, project_text(project, vars->var[i].name),
			listing_type(project, &vars->var[i]));
	return rows;
}

static void add_bookmarks(GListStore *root, LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);
	LadderTreeRow *heading = NULL;

	if (!project_view(project)[0])
		return;
	for (int pou = 0; pou < project->pou_count; pou++)
		for (int i = 0; i < project->pou[pou].rung_count; i++) {
			const char *title = project_text(project,
				project->pou[pou].rung[i]->title);
			LadderTreeRow *row;
			char *text;

			if (!ladder_document_is_bookmarked(document, pou, i))
				continue;
			if (!heading)
				heading = add_heading(root, _("Bookmarks"));
			text = g_strdup_printf(_("%s, rung %d"), project_text(project,
				project->pou[pou].name), i + 1);
			/* Beside a title there is little room. */
			row = add_row(heading->rows, ROW_BOOKMARK, *title ? title : text,
				      *title ? g_strdup_printf("%s %d", project_text(project,
						project->pou[pou].name), i + 1) : g_strdup(""));
			row->pou = pou;
			row->rung = i;
			g_free(text);
		}
}

static void add_charts(GListStore *root, LadderDocument *document)
{
	GPtrArray *charts = watch_list_of(document);
	LadderTreeRow *heading = charts->len ? add_heading(root, _("Status charts")) : NULL;

	for (guint i = 0; i < charts->len; i++) {
		const struct watch *chart = charts->pdata[i];
		LadderTreeRow *row = add_row(heading->rows, ROW_CHART,
			*chart->name ? chart->name : _("Status chart"),
			g_strdup_printf("%u", chart->lines->len));

		row->path = g_strdup(chart->name);
	}
	g_ptr_array_unref(charts);
}

/* Boards that were connected, the newest first. */
static void add_boards(GListStore *root)
{
	char **boards = settings_get() ? g_settings_get_strv(settings_get(), "boards") : NULL;
	LadderTreeRow *heading = boards && *boards ? add_heading(root, _("Boards")) : NULL;

	for (int i = 0; heading && boards[i]; i++) {
		LadderTreeRow *row = add_row(heading->rows, ROW_BOARD,
			strcmp(boards[i], "unix:") == 0 ? _("This computer") : boards[i], NULL);

		row->path = g_strdup(boards[i]);
	}
	g_strfreev(boards);
}

static void add_all(GListStore *root, LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	if (!project)
		return;
	add_pous(root, project, _("Programs"), true);
	add_pous(root, project, _("Functions and blocks"), false);
	add_row(root, ROW_SYMBOLS, _("Symbols"),
		g_strdup_printf("%d", listing_symbol_count(project)));
	add_tasks(root, project);
	add_types(root, project);
	add_row(root, ROW_ADDRESSES, _("Address map"), NULL);
	add_bookmarks(root, document);
	add_charts(root, document);
	add_texts(root, document, _("Scenarios"), ".scn", true);
	add_texts(root, document, _("I/O maps"), ".io", true);
	add_texts(root, document, _("Other I/O maps"), ".io", false);
	add_files(root, project);
	add_boards(root);
}

/* ---- what became of them ---- */

static bool is_same(const LadderTreeRow *a, const LadderTreeRow *b)
{
	return a->kind == b->kind && a->parent == b->parent &&
	       g_strcmp0(a->text, b->text) == 0 && g_strcmp0(a->path, b->path) == 0;
}

static LadderTreeRow *row_at(GListStore *rows, guint at)
{
	LadderTreeRow *row = g_list_model_get_item(G_LIST_MODEL(rows), at);

	g_object_unref(row); /* the list has a reference */
	return row;
}

static void update(GListStore *old, GListStore *fresh, const struct project *project);

/* Gives a row that stays the values of @fresh. Its index may be that of another POU, so its
 * children are compared too. */
static void become(LadderTreeRow *old, LadderTreeRow *fresh, const struct project *project)
{
	GListStore *rows;

	old->pou = fresh->pou;
	old->rung = fresh->rung;
	old->what = fresh->what;
	if (g_strcmp0(old->note, fresh->note) != 0) {
		g_free(old->note);
		old->note = g_steal_pointer(&fresh->note);
		g_signal_emit(old, changed, 0);
	}
	if (!old->rows)
		return;
	rows = fresh->rows ? g_object_ref(fresh->rows) : variables(project, fresh);
	update(old->rows, rows, project);
	g_object_unref(rows);
}

static void update(GListStore *old, GListStore *fresh, const struct project *project)
{
	const guint was = g_list_model_get_n_items(G_LIST_MODEL(old));
	const guint is = g_list_model_get_n_items(G_LIST_MODEL(fresh)), least = MIN(was, is);
	GPtrArray *others = g_ptr_array_new();
	guint first = 0, last = 0;

	for (; first < least && is_same(row_at(old, first), row_at(fresh, first)); first++)
		become(row_at(old, first), row_at(fresh, first), project);
	for (; last < least - first && is_same(row_at(old, was - 1 - last),
					       row_at(fresh, is - 1 - last)); last++)
		become(row_at(old, was - 1 - last), row_at(fresh, is - 1 - last), project);
	for (guint i = first; i < is - last; i++)
		g_ptr_array_add(others, row_at(fresh, i));
	if (first < was - last || others->len)
		g_list_store_splice(old, first, was - last - first, others->pdata, others->len);
	g_ptr_array_unref(others);
}

void tree_row_set_missing(LadderTreeRow *row, bool missing)
{
	if (row->missing == missing)
		return;
	row->missing = missing;
	g_signal_emit(row, changed, 0);
}

void tree_rows_update(GListStore *root, LadderDocument *document)
{
	GListStore *fresh = g_list_store_new(LADDER_TYPE_TREE_ROW);

	add_all(fresh, document);
	update(root, fresh, ladder_document_project(document));
	g_object_unref(fresh);
}

GListModel *tree_row_children(LadderTreeRow *row, LadderDocument *document)
{
	const struct project *project = ladder_document_project(document);

	/* Between a change and its signal, indices may be out of date. */
	if (!row->parent || (!row->rows && (!project || row->pou >= (row->kind == ROW_POU ?
			project->pou_count : type_count(project)))))
		return NULL;
	if (!row->rows)
		row->rows = variables(project, row);
	return G_LIST_MODEL(g_object_ref(row->rows));
}
