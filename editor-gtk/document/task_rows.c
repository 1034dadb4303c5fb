/* SPDX-License-Identifier: MIT
 *
 * task_rows - the tasks of a document as rows, and edits of them.
 *
 * An edit changes, adds, moves or deletes lines of the CONFIGURATION (task_text.h); the text is
 * put together again and read before it replaces the old one.
 */
#include "editor-gtk/document/task_rows.h"

#include "editor-gtk/document/symbols.h"
#include "editor-gtk/document/task_text.h"
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/comment_text.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/scan/task.h"

#include <string.h>

static bool refuse(char **why, char *text)
{
	if (why)
		*why = text;
	else
		g_free(text);
	return false;
}

/* ---- rows ---- */

static const char *const field_names[TASKS_FIELDS] = {
	[TASKS_NAME] = N_("Name"), [TASKS_KIND] = N_("Kind"),
	[TASKS_WHEN] = N_("Period or event"), [TASKS_PRIORITY] = N_("Priority"),
	[TASKS_WATCHDOG] = N_("Watchdog"), [TASKS_PROGRAM] = N_("Program"),
	[TASKS_COMMENT] = N_("Comment"),
};

const char *task_rows_field_name(enum task_field field)
{
	return _(field_names[field]);
}

const char *task_rows_kind_name(bool event)
{
	return event ? _("Event") : _("Cyclic");
}

/* T#10ms: how often programs without a task run. Caller frees. */
static char *period_text(LadderDocument *document)
{
	struct ladder *checked = ladder_document_checked(document);
	const struct program *program = checked ? ladder_program(checked) : NULL;
	char text[64];

	literal_print_time(program ? tasks_tick(program, 0, TASKS_PERIOD_NS) : TASKS_PERIOD_NS,
			   text, sizeof(text));
	return g_strdup(text);
}

static struct task_row *add_row(struct task_rows *tasks, enum task_what what, int head,
				 struct task_line *line)
{
	struct task_row *row;

	tasks->row = g_renew(struct task_row, tasks->row, tasks->count + 1);
	row = &tasks->row[tasks->count];
	*row = (struct task_row){ .what = what, .head = head < 0 ? tasks->count : head,
				   .pou = -1 };
	tasks->count++;
	g_array_append_val(tasks->inside->of, line);
	for (int i = 0; i < TASKS_FIELDS; i++)
		row->text[i] = g_strdup("");
	return row;
}

static void name_line(struct task_row *row, const struct task_text *t, struct task_line *line)
{
	const struct config *config = t->project->config;
	const guint index = task_text_index(t, line);

	task_line_set(&row->text[TASKS_NAME], line->name);
	if (line->changed)
		return; /* it is not in the file */
	row->line = task_text_is_included(t->project) ? 0 : task_text_number(t, index);
	for (int i = 0; i < config->count; i++)
		if (name_equal(project_text(t->project, config->entry[i].name), line->name)) {
			g_free(row->text[TASKS_COMMENT]);
			row->text[TASKS_COMMENT] = comment_text(project_text(t->project,
				config->entry[i].comment));
			break;
		}
}

static void add_instance(struct task_rows *tasks, int head, struct task_line *line)
{
	const struct task_text *t = tasks->inside;
	struct task_row *row = add_row(tasks, TASKS_INSTANCE, head, line);

	name_line(row, t, line);
	task_line_set(&row->text[TASKS_PROGRAM], line->pou);
	row->pou = project_find_pou(t->project, line->pou, strlen(line->pou));
}

static void add_task(struct task_rows *tasks, struct task_line *task)
{
	const struct task_text *t = tasks->inside;
	struct task_row *row = add_row(tasks, TASKS_TASK, -1, task);
	const int head = row->head;

	row->event = *task->single;
	name_line(row, t, task);
	task_line_set(&row->text[TASKS_KIND], task_rows_kind_name(row->event));
	task_line_set(&row->text[TASKS_WHEN], row->event ? task->single : task->interval);
	task_line_set(&row->text[TASKS_PRIORITY], task->priority);
	task_line_set(&row->text[TASKS_WATCHDOG], task->watchdog);
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM &&
		    name_equal(task_line_at(t, i)->task, task->name))
			add_instance(tasks, head, task_line_at(t, i));
}

static void add_each_scan(struct task_rows *tasks)
{
	const struct task_text *t = tasks->inside;
	struct task_row *row = add_row(tasks, TASKS_EACH_SCAN, -1, NULL);
	const int head = row->head;

	task_line_set(&row->text[TASKS_NAME], _("Each scan"));
	g_free(row->text[TASKS_WHEN]);
	row->text[TASKS_WHEN] = period_text(t->document);
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM && !*task_line_at(t, i)->task)
			add_instance(tasks, head, task_line_at(t, i));
}

static bool has_task(const struct task_text *t, const char *name)
{
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_TASK &&
		    name_equal(task_line_at(t, i)->name, name))
			return true;
	return false;
}

static int idle_head(struct task_rows *tasks, int head)
{
	struct task_row *row;

	if (head >= 0)
		return head;
	row = add_row(tasks, TASKS_IDLE, -1, NULL);
	task_line_set(&row->text[TASKS_NAME], _("Do not run"));
	return row->head;
}

/* Programs without a line, and lines that name no task of the file. */
static void add_idle(struct task_rows *tasks)
{
	const struct task_text *t = tasks->inside;
	struct task_row *row;
	int head = -1;

	for (guint i = 0; i < t->line->len; i++) {
		struct task_line *line = task_line_at(t, i);

		if (line->kind != LINE_PROGRAM || !*line->task || has_task(t, line->task))
			continue;
		head = idle_head(tasks, head);
		add_instance(tasks, head, line);
	}
	for (int i = 0; i < t->project->pou_count; i++) {
		const char *name = project_text(t->project, t->project->pou[i].name);

		if (t->project->pou[i].kind != POU_PROGRAM || task_text_of_pou(t, name))
			continue;
		head = idle_head(tasks, head);
		row = add_row(tasks, TASKS_INSTANCE, head, NULL);
		task_line_set(&row->text[TASKS_NAME], name);
		task_line_set(&row->text[TASKS_PROGRAM], name);
		row->pou = i;
	}
}

struct task_rows *task_rows_new(LadderDocument *document)
{
	struct task_rows *tasks = g_new0(struct task_rows, 1);
	struct task_text *t = task_text_new(document, &tasks->written);

	tasks->inside = t;
	if (!t->project)
		return tasks;
	tasks->fixed = task_text_is_included(t->project) || ladder_document_is_fixed(document);
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_TASK)
			add_task(tasks, task_line_at(t, i));
	add_each_scan(tasks);
	add_idle(tasks);
	return tasks;
}

void task_rows_free(struct task_rows *tasks)
{
	if (!tasks)
		return;
	for (int i = 0; i < tasks->count; i++)
		for (int k = 0; k < TASKS_FIELDS; k++)
			g_free(tasks->row[i].text[k]);
	g_free(tasks->row);
	task_text_free(tasks->inside);
	g_free(tasks);
}

int task_rows_find(const struct task_rows *tasks, enum task_what what, const char *name)
{
	for (int i = 0; i < tasks->count; i++)
		if (tasks->row[i].what == what &&
		    (what == TASKS_EACH_SCAN || what == TASKS_IDLE ||
		     name_equal(tasks->row[i].text[TASKS_NAME], name)))
			return i;
	return -1;
}

int task_rows_programs(const struct task_rows *tasks, int head)
{
	int count = 0;

	for (int i = 0; i < tasks->count; i++)
		count += i != head && tasks->row[i].head == head;
	return count;
}

char *task_rows_error(LadderDocument *document, const struct task_row *row, bool *warning)
{
	const struct diag_list *diags = ladder_document_diags(document);
	const char *program = row->text[TASKS_PROGRAM];

	for (int i = 0; diags && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (row->line ? diag->pou || diag->line != row->line :
		    diag->id != DIAG_NOT_RUN || row->what != TASKS_INSTANCE ||
		    strcmp(diag->arg, program) != 0)
			continue;
		*warning = diag_severity(diag->id) != SEVERITY_ERROR;
		return diag_said_whole(diag);
	}
	return NULL;
}

/* ---- applying ---- */

static bool was_before(const struct task_text *t, const struct diag *diag)
{
	const struct diag_list *diags = ladder_document_diags(t->document);

	for (int i = 0; diags && i < diags->count; i++)
		if (diags->diag[i].id == diag->id &&
		    strcmp(diags->diag[i].arg, diag->arg) == 0)
			return true;
	return false;
}

/* Is the line, counted from the first of the lines, one of a changed line? */
static bool is_changed(const struct task_text *t, int number)
{
	for (guint i = 0; i < t->line->len; i++) {
		char *text = task_line_text(task_line_at(t, i));

		for (const char *at = text; *at; at++)
			number -= *at == '\n';
		g_free(text);
		if (number < 0)
			return task_line_at(t, i)->changed;
	}
	return false;
}

static const struct diag *new_error(const struct task_text *t, const struct diag_list *diags)
{
	const int first = task_text_number(t, 0);

	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag_severity(diag->id) == SEVERITY_ERROR && !diag->pou &&
		    is_changed(t, diag->line - first) && !was_before(t, diag))
			return diag;
	}
	return NULL;
}

/* Did every line stay one line? */
static bool are_lines(const struct task_text *t, const struct config *config)
{
	int count = 0, found = 0;

	for (guint i = 0; i < t->line->len; i++)
		count += task_line_at(t, i)->kind != LINE_FIXED;
	for (int i = 0; config && i < config->count; i++)
		found += config->entry[i].kind == CONFIG_TASK ||
			 config->entry[i].kind == CONFIG_PROGRAM;
	return count == found;
}

/* Reads and checks the new text in a project of its own. */
static bool is_good(const struct task_text *t, const char *text, gsize len, char **why)
{
	const char *path = ladder_document_path(t->document);
	struct ladder *ladder = ladder_document_reader(t->document);
	const struct diag *diag;

	if (ladder_load_text(ladder, path ? path : "", text, len)) {
		ladder_build(ladder);
		diag = new_error(t, ladder_diags(ladder));
		if (!diag && !are_lines(t, ladder_project(ladder)->config)) {
			ladder_free(ladder);
			return refuse(why, g_strdup(_("It cannot be read")));
		}
	} else {
		diag = diag_first_error(ladder_diags(ladder));
	}
	if (diag)
		refuse(why, diag_said_whole(diag));
	ladder_free(ladder);
	return !diag;
}

static bool apply(struct task_rows *tasks, const char *step, char **why)
{
	struct task_text *t = tasks->inside;
	char *text, *refusal;
	GString *whole;
	bool good;

	if (tasks->fixed)
		return refuse(why, g_strdup(_("It is declared in another file")));
	text = task_text_joined(t);
	whole = g_string_new(t->whole);
	g_string_erase(whole, (gssize)t->at, (gssize)t->removed);
	g_string_insert(whole, (gssize)t->at, text);
	good = is_good(t, whole->str, whole->len, why);
	if (good) {
		refusal = ladder_document_replace_step(t->document, t->at, t->removed, text,
						       step);
		good = !refusal || refuse(why, refusal);
	}
	g_string_free(whole, TRUE);
	g_free(text);
	return good;
}

/* ---- changing lines ---- */

static struct task_line *line_of(const struct task_rows *tasks, int row)
{
	return row >= 0 && row < tasks->count ?
	       g_array_index(tasks->inside->of, struct task_line *, row) : NULL;
}

/* Makes the line's text of its fields. Its comments stay. */
static void touch(struct task_text *t, struct task_line *line)
{
	const struct config *config = t->project->config;

	if (line->changed)
		return;
	line->changed = true;
	task_line_set(&line->text, "");
	for (int i = 0; config && i < config->count; i++)
		if (name_equal(project_text(t->project, config->entry[i].name), line->name) &&
		    (config->entry[i].kind == CONFIG_TASK) == (line->kind == LINE_TASK)) {
			task_line_set(&line->text, project_text(t->project,
								config->entry[i].comment));
			break;
		}
}

static void give(struct task_text *t, struct task_line *line, char **field, const char *text)
{
	touch(t, line);
	task_line_set(field, text);
}

static void take_out(struct task_text *t, struct task_line *line)
{
	g_ptr_array_remove(t->line, line);
}

/* Moves a line before or behind another. */
static void move_to(struct task_text *t, struct task_line *line, const struct task_line *by,
		    bool behind)
{
	struct task_line *moved;

	if (line == by)
		return;
	touch(t, line);
	moved = g_ptr_array_steal_index(t->line, task_text_index(t, line));
	g_ptr_array_insert(t->line, (int)task_text_index(t, by) + behind, moved);
}

static struct task_line *last_of(const struct task_text *t, enum task_line_kind kind,
				 const char *task, const struct task_line *but)
{
	struct task_line *last = NULL;

	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == kind && task_line_at(t, i) != but &&
		    (!task || name_equal(task_line_at(t, i)->task, task)))
			last = task_line_at(t, i);
	return last;
}

static struct task_line *first_program(const struct task_text *t)
{
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM)
			return task_line_at(t, i);
	return NULL;
}

/* Where a new task goes: behind the last, or above the programs. */
static guint place_of_task(const struct task_text *t)
{
	const struct task_line *last = last_of(t, LINE_TASK, NULL, NULL);
	const struct task_line *program = first_program(t);

	return last ? task_text_index(t, last) + 1 :
	       task_text_index(t, program ? program : task_text_closing(t));
}

static struct task_line *new_task(struct task_text *t, char *name, const char *interval)
{
	struct task_line *line = task_line_new(LINE_TASK, g_strdup(""));
	guint64 priority = 0;

	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_TASK)
			priority = MAX(priority, g_ascii_strtoull(
				task_line_at(t, i)->priority, NULL, 10) + 1);
	g_free(line->name);
	line->name = name;
	task_line_set(&line->interval, interval);
	g_free(line->priority);
	line->priority = g_strdup_printf("%u", MIN((unsigned)priority, 65535u));
	line->changed = true;
	g_ptr_array_insert(t->line, (int)place_of_task(t), line);
	return line;
}

/* A task of the programs that have none, with the period of the scan. */
static struct task_line *task_of_rest(struct task_rows *tasks, const struct task_row *head)
{
	struct task_text *t = tasks->inside;
	struct task_line *task = new_task(t, task_text_free_name(t, "Task", true),
						  head->text[TASKS_WHEN]);

	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM && !*task_line_at(t, i)->task)
			give(t, task_line_at(t, i), &task_line_at(t, i)->task, task->name);
	return task;
}

/* ---- fields ---- */

/* 10ms and 10 ms become T#10ms. Caller frees. */
static char *time_of(const char *text)
{
	const gsize size = strlen(text) + sizeof("T#");
	char **part = g_strsplit(text, " ", -1), *whole = g_strjoinv("", part);
	char *out = g_malloc0(size);
	bool fits;

	if (!entry_literal(whole, strlen(whole), out, size, &fits) || !fits)
		g_strlcpy(out, text, size);
	g_strfreev(part);
	g_free(whole);
	return out;
}

static bool is_time(const char *text)
{
	return g_ascii_isdigit(*text) || *text == '-' || *text == '+' ||
	       (strchr(text, '#') && !strchr(text, '%'));
}

/* Could the text be read as more than a value? */
static bool is_value(const char *text)
{
	return *text && !strpbrk(text, ",;:\n\"") && !strstr(text, "(*") && !strstr(text, "//");
}

static bool is_name(const char *name, char **why)
{
	const enum diag_id fault = ladder_name_fault(name);

	if (fault == DIAG_COUNT || fault == DIAG_SHADOWS_ADDRESS)
		return true;
	return refuse(why, fault == DIAG_EXPECTED ?
		      g_strdup_printf(_("“%s” is not a name"), name) :
		      diag_said_of(fault, name));
}

static bool rename_line(struct task_text *t, struct task_line *line, const char *name, char **why)
{
	if (!is_name(name, why))
		return false;
	if (!name_equal(line->name, name) && task_text_is_taken(t, name))
		return refuse(why, g_strdup_printf(_("“%s” is declared already"), name));
	for (guint i = 0; line->kind == LINE_TASK && i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM &&
		    name_equal(task_line_at(t, i)->task, line->name))
			give(t, task_line_at(t, i), &task_line_at(t, i)->task, name);
	give(t, line, &line->name, name);
	return true;
}

static void set_when(struct task_text *t, struct task_line *line, const char *text)
{
	char *time = time_of(text);

	if (is_time(time)) {
		give(t, line, &line->interval, time);
		task_line_set(&line->single, "");
	} else {
		give(t, line, &line->single, text);
		task_line_set(&line->interval, "");
	}
	g_free(time);
}

/* A new event task waits for the first BOOL, or the first input. */
static const char *some_event(const struct project *project)
{
	const struct var_table *vars = &project->globals;

	for (int i = 0; i < vars->count; i++)
		if (vars->var[i].type == IEC_BOOL && !vars->var[i].array.count)
			return project_text(project, vars->var[i].name);
	return "%IX0.0";
}

static bool set_kind(struct task_text *t, struct task_line *line, const char *text, char **why)
{
	const bool event = strcmp(text, task_rows_kind_name(true)) == 0;
	char period[64];

	if (!event && strcmp(text, task_rows_kind_name(false)) != 0)
		return refuse(why, g_strdup(_("This is not one of the choices; Alt+Down shows "
					      "them")));
	if (event == (*line->single != '\0'))
		return true;
	literal_print_time(TASKS_PERIOD_NS, period, sizeof(period));
	set_when(t, line, event ? some_event(t->project) : period);
	return true;
}

static bool set_comment(struct task_text *t, struct task_line *line, const char *text, char **why)
{
	char *clean;

	if (strstr(text, "(*") || strstr(text, "*)"))
		return refuse(why, g_strdup(_("a comment is one line without (* and *)")));
	clean = comment_text_safe(text);
	touch(t, line);
	g_free(line->text);
	line->text = *clean ? g_strdup_printf("(* %s *)", clean) : g_strdup("");
	g_free(clean);
	return true;
}

static bool set_program(struct task_text *t, struct task_line *line, const char *text, char **why)
{
	const struct task_line *other = task_text_of_pou(t, text);
	const int pou = project_find_pou(t->project, text, strlen(text));

	if (pou < 0 || t->project->pou[pou].kind != POU_PROGRAM)
		return refuse(why, g_strdup_printf(_("“%s” is not a program"), text));
	if (other && other != line)
		return refuse(why, g_strdup_printf(_("“%s” runs already, as “%s”"), text,
						   other->name));
	give(t, line, &line->pou, text);
	return true;
}

static bool set_line(struct task_text *t, struct task_line *line, enum task_field field,
		     const char *text, char **why)
{
	char *time;

	if (field == TASKS_COMMENT)
		return set_comment(t, line, text, why);
	if (!is_value(text) && (*text || (field != TASKS_PRIORITY && field != TASKS_WATCHDOG)))
		return refuse(why, *text ? g_strdup(_("It cannot be read")) :
				   g_strdup(_("A value is needed here")));
	switch (field) {
	case TASKS_NAME:
		return rename_line(t, line, text, why);
	case TASKS_KIND:
		return set_kind(t, line, text, why);
	case TASKS_WHEN:
		set_when(t, line, text);
		return true;
	case TASKS_PRIORITY:
		give(t, line, &line->priority, text);
		return true;
	case TASKS_WATCHDOG:
		time = time_of(text);
		give(t, line, &line->watchdog, time);
		g_free(time);
		return true;
	case TASKS_PROGRAM:
		return set_program(t, line, text, why);
	case TASKS_COMMENT: case TASKS_FIELDS:
		break;
	}
	return false;
}

static const char *step_name(enum task_field field)
{
	static const char *const name[TASKS_FIELDS] = {
		[TASKS_NAME] = N_("Rename"), [TASKS_KIND] = N_("Change kind"),
		[TASKS_WHEN] = N_("Change period or event"),
		[TASKS_PRIORITY] = N_("Change priority"),
		[TASKS_WATCHDOG] = N_("Change watchdog"),
		[TASKS_PROGRAM] = N_("Change program"), [TASKS_COMMENT] = N_("Change comment"),
	};

	return _(name[field]);
}

bool task_rows_has(enum task_what what, enum task_field field)
{
	const bool text = field == TASKS_NAME || field == TASKS_COMMENT;

	return what == TASKS_INSTANCE ? text || field == TASKS_PROGRAM :
	       what == TASKS_TASK ? field != TASKS_PROGRAM :
	       what == TASKS_EACH_SCAN && (field == TASKS_WHEN || field == TASKS_PRIORITY ||
					   field == TASKS_WATCHDOG);
}

bool task_rows_set(LadderDocument *document, int row, enum task_field field, const char *text,
	       char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	const struct task_row *of = row >= 0 && row < tasks->count ? &tasks->row[row] : NULL;
	struct task_line *line = line_of(tasks, row);
	char *clean = g_strstrip(g_strdup(text));
	bool good;

	if (!of || !task_rows_has(of->what, field) || (of->what == TASKS_INSTANCE && !line))
		good = refuse(why, g_strdup(_("This cannot be changed here")));
	else if (strcmp(of->text[field], clean) == 0)
		good = true;
	else
		good = set_line(tasks->inside, line ? line : task_of_rest(tasks, of), field, clean,
				why) &&
		       apply(tasks, step_name(field), why);
	g_free(clean);
	task_rows_free(tasks);
	return good;
}

char *task_rows_name_refusal(LadderDocument *document, int row, const char *name)
{
	struct task_rows *tasks = task_rows_new(document);
	struct task_line *line = line_of(tasks, row);
	char *why = NULL;

	if (!line)
		why = g_strdup(_("This cannot be changed here"));
	else if (!*name)
		why = g_strdup(_("Enter a name"));
	else
		rename_line(tasks->inside, line, name, &why);
	task_rows_free(tasks);
	return why;
}

/* ---- tasks and programs come, go and move ---- */

bool task_rows_add(LadderDocument *document, char **name, char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	struct task_text *t = tasks->inside;
	char period[64];
	bool good;

	if (!t->project) {
		task_rows_free(tasks);
		return refuse(why, g_strdup(_("The file cannot be read as a program. Correct its errors first")));
	}
	literal_print_time(TASKS_PERIOD_NS, period, sizeof(period));
	*name = g_strdup(new_task(t, task_text_free_name(t, "Task", true), period)->name);
	good = apply(tasks, _("New task"), why);
	if (!good)
		g_clear_pointer(name, g_free);
	task_rows_free(tasks);
	return good;
}

bool task_rows_delete(LadderDocument *document, int row, char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	struct task_text *t = tasks->inside;
	struct task_line *line = line_of(tasks, row);
	const bool task = line && line->kind == LINE_TASK;
	bool good;

	if (!line) {
		task_rows_free(tasks);
		return refuse(why, g_strdup(_("This cannot be deleted")));
	}
	for (guint i = 0; task && i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM &&
		    name_equal(task_line_at(t, i)->task, line->name))
			give(t, task_line_at(t, i), &task_line_at(t, i)->task, "");
	take_out(t, line);
	good = task_text_has(t, LINE_PROGRAM) || task ?
	       apply(tasks, task ? _("Delete task") : _("Remove program from task"), why) :
	       refuse(why, g_strdup(_("At least one program must run: without a PROGRAM line all "
				      "programs run")));
	task_rows_free(tasks);
	return good;
}

static const char *task_of(const struct task_rows *tasks, int head)
{
	return tasks->row[head].what == TASKS_TASK ? line_of(tasks, head)->name : "";
}

/* Puts a program's line behind the others of the task. The first one stays where it is. */
static void append_to(struct task_text *t, struct task_line *line, const char *task)
{
	const struct task_line *last = last_of(t, LINE_PROGRAM, task, line);

	give(t, line, &line->task, task);
	if (last)
		move_to(t, line, last, true);
}

static bool is_heading(const struct task_rows *tasks, int row)
{
	return row >= 0 && row < tasks->count && tasks->row[row].what != TASKS_INSTANCE;
}

bool task_rows_add_program(LadderDocument *document, int head, int pou, char **name, char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	struct task_text *t = tasks->inside;
	struct task_line *line;
	bool good;

	if (!is_heading(tasks, head) || tasks->row[head].what == TASKS_IDLE || pou < 0 ||
	    pou >= t->project->pou_count || t->project->pou[pou].kind != POU_PROGRAM) {
		task_rows_free(tasks);
		return refuse(why, g_strdup(_("This cannot be changed here")));
	}
	line = (struct task_line *)task_text_of_pou(t, project_text(t->project,
		t->project->pou[pou].name));
	if (!line)
		line = task_text_add_program(t, task_text_index(t, task_text_closing(t)), pou, "");
	append_to(t, line, task_of(tasks, head));
	*name = g_strdup(line->name);
	good = apply(tasks, _("Add program to task"), why);
	if (!good)
		g_clear_pointer(name, g_free);
	task_rows_free(tasks);
	return good;
}

static void move_program(struct task_rows *tasks, int row, int head, int before)
{
	struct task_text *t = tasks->inside;
	struct task_line *line = line_of(tasks, row), *by = line_of(tasks, before);

	if (tasks->row[head].what == TASKS_IDLE) {
		if (line)
			take_out(t, line);
		return;
	}
	if (!line)
		line = task_text_add_program(t, task_text_index(t, task_text_closing(t)),
					     tasks->row[row].pou, "");
	if (!by) {
		append_to(t, line, task_of(tasks, head));
		return;
	}
	give(t, line, &line->task, task_of(tasks, head));
	move_to(t, line, by, false);
}

static void move_task(struct task_rows *tasks, int row, int before)
{
	struct task_text *t = tasks->inside;
	struct task_line *line = line_of(tasks, row), *by = line_of(tasks, before);

	if (by)
		move_to(t, line, by, false);
	else if (last_of(t, LINE_TASK, NULL, line))
		move_to(t, line, last_of(t, LINE_TASK, NULL, line), true);
}

/* Does the move leave everything as it is? */
static bool is_there(const struct task_rows *tasks, int row, int head, int before)
{
	const struct task_row *of = &tasks->row[row];
	int next = row + 1;

	if (before == row)
		return true;
	if (of->what == TASKS_TASK) {
		next += task_rows_programs(tasks, row);
		return before < 0 ? tasks->row[next].what != TASKS_TASK : before == next;
	}
	return of->head == head && (tasks->row[head].what == TASKS_IDLE || (before < 0 ?
	       next == tasks->count || tasks->row[next].head != head : before == next));
}

bool task_rows_move(LadderDocument *document, int row, int head, int before, char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	const bool task = is_heading(tasks, row);
	bool good;

	if (row < 0 || row >= tasks->count || (task && tasks->row[row].what != TASKS_TASK) ||
	    (!task && !is_heading(tasks, head))) {
		good = refuse(why, g_strdup(_("This cannot be moved there")));
	} else if (is_there(tasks, row, head, before)) {
		good = true;
	} else {
		if (task)
			move_task(tasks, row, before);
		else
			move_program(tasks, row, head, before);
		good = task_text_has(tasks->inside, LINE_PROGRAM) ?
		       apply(tasks, task ? _("Move task") : _("Move program"), why) :
		       refuse(why, g_strdup(_("At least one program must run: without a PROGRAM "
					      "line all programs run")));
	}
	task_rows_free(tasks);
	return good;
}

/* The row before which @row would go, -1: last; as for task_rows_move(). */
static int row_before(const struct task_rows *tasks, int row, int target, bool below)
{
	const int head = tasks->row[target].head, last = head + task_rows_programs(tasks, head);
	const int before = target + below, next = target == head && !below ? target : last + 1;

	if (tasks->row[row].what != TASKS_TASK)
		return before > last ? -1 : before;
	return next < tasks->count && tasks->row[next].what == TASKS_TASK ? next : -1;
}

bool task_rows_drop(LadderDocument *document, int row, int target, bool below, char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	const bool known = row >= 0 && row < tasks->count && target >= 0 && target < tasks->count;
	const int head = known ? tasks->row[target].head : -1;
	const int before = known ? row_before(tasks, row, target, below) : -1;

	task_rows_free(tasks);
	return task_rows_move(document, row, head, before, why);
}

/* ---- a step by the keys ---- */

struct goal { int head, before; };

static int heading_beside(const struct task_rows *tasks, int head, int by)
{
	int at = head + by;

	while (at >= 0 && at < tasks->count && tasks->row[at].what == TASKS_INSTANCE)
		at += by;
	return at >= 0 && at < tasks->count ? at : -1;
}

static bool step_of_task(const struct task_rows *tasks, int row, int by, struct goal *to)
{
	const int beside = heading_beside(tasks, row, by);
	int behind;

	if (beside < 0 || tasks->row[beside].what != TASKS_TASK)
		return false;
	behind = by < 0 ? beside : heading_beside(tasks, beside, 1);
	*to = (struct goal){ -1, behind >= 0 && tasks->row[behind].what == TASKS_TASK ?
			      behind : -1 };
	return true;
}

/* The first program of a heading; -1: it has none. */
static int first_below(const struct task_rows *tasks, int head)
{
	return task_rows_programs(tasks, head) ? head + 1 : -1;
}

static bool step_of_program(const struct task_rows *tasks, int row, int by, struct goal *to)
{
	const int head = tasks->row[row].head;
	const int last = head + task_rows_programs(tasks, head);
	const bool ordered = tasks->row[head].what != TASKS_IDLE;
	int beside;

	if (by < 0 && row > head + 1 && ordered) {
		*to = (struct goal){ head, row - 1 };
	} else if (by > 0 && row < last && ordered) {
		*to = (struct goal){ head, row + 2 <= last ? row + 2 : -1 };
	} else {
		beside = heading_beside(tasks, head, by);
		*to = (struct goal){ beside, by < 0 || beside < 0 ? -1 :
				      first_below(tasks, beside) };
		return beside >= 0;
	}
	return true;
}

static bool step_to(const struct task_rows *tasks, int row, int by, struct goal *to)
{
	if (row < 0 || row >= tasks->count || tasks->fixed)
		return false;
	if (tasks->row[row].what == TASKS_INSTANCE)
		return step_of_program(tasks, row, by, to);
	return tasks->row[row].what == TASKS_TASK && step_of_task(tasks, row, by, to);
}

bool task_rows_can_step(const struct task_rows *tasks, int row, int by)
{
	struct goal to;

	return step_to(tasks, row, by, &to);
}

bool task_rows_step(LadderDocument *document, int row, int by, char **why)
{
	struct task_rows *tasks = task_rows_new(document);
	struct goal to;
	const bool can = step_to(tasks, row, by, &to);

	task_rows_free(tasks);
	return can ? task_rows_move(document, row, to.head, to.before, why) :
	       refuse(why, g_strdup(_("This cannot be moved there")));
}
