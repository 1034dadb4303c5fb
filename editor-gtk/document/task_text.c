/* SPDX-License-Identifier: MIT
 *
 * task_text - the CONFIGURATION of a document as lines; see task_text.h.
 */
#include "editor-gtk/document/task_text.h"

#include "engine/base/name.h"

#include <string.h>

void task_line_set(char **text, const char *now)
{
	char *copy = g_strdup(now);

	g_free(*text);
	*text = copy;
}

/* ---- lines ---- */

static void line_free(gpointer pointer)
{
	struct task_line *line = pointer;

	g_free(line->text);
	g_free(line->name);
	g_free(line->task);
	g_free(line->pou);
	g_free(line->values);
	g_free(line->single);
	g_free(line->interval);
	g_free(line->priority);
	g_free(line->watchdog);
	g_free(line);
}

struct task_line *task_line_new(enum task_line_kind kind, char *text)
{
	struct task_line *line = g_new0(struct task_line, 1);

	line->kind = kind;
	line->text = text;
	line->name = g_strdup("");
	line->task = g_strdup("");
	line->pou = g_strdup("");
	line->values = g_strdup("");
	line->single = g_strdup("");
	line->interval = g_strdup("");
	line->priority = g_strdup("");
	line->watchdog = g_strdup("");
	return line;
}

struct task_line *task_line_at(const struct task_text *t, guint index)
{
	return t->line->pdata[index];
}

guint task_text_index(const struct task_text *t, const struct task_line *line)
{
	guint at = 0;

	g_ptr_array_find(t->line, line, &at);
	return at;
}

char *task_line_text(const struct task_line *line)
{
	GString *out;

	if (!line->changed)
		return g_strdup(line->text);
	out = g_string_new("  ");
	if (line->kind == LINE_TASK) {
		g_string_append_printf(out, "TASK %s (%s := %s, PRIORITY := %s", line->name,
			*line->single ? "SINGLE" : "INTERVAL",
			*line->single ? line->single : line->interval,
			*line->priority ? line->priority : "0");
		if (*line->watchdog)
			g_string_append_printf(out, ", WATCHDOG := %s", line->watchdog);
		g_string_append(out, ");");
	} else {
		g_string_append_printf(out, "PROGRAM %s", line->name);
		if (*line->task)
			g_string_append_printf(out, " WITH %s", line->task);
		g_string_append_printf(out, " : %s%s;", line->pou, line->values);
	}
	if (*line->text)
		g_string_append_printf(out, " %s", line->text);
	g_string_append_c(out, '\n');
	return g_string_free(out, FALSE);
}

/* ---- taking the configuration apart ---- */

struct places {
	struct task_text *t;
	GArray *entry;               /* of struct text_span                    */
	struct text_span part, resource, first;
};

static void take_span(void *context, const struct text_span *span)
{
	struct places *places = context;
	const struct part *part = span->part == TEXT_PART ?
		&places->t->project->part[span->number] : NULL;

	if (span->part == TEXT_ENTRY)
		g_array_append_val(places->entry, *span);
	else if (span->part == TEXT_RESOURCE)
		places->resource = *span;
	else if (part && part->kind == PART_CONFIG)
		places->part = *span;
	else if (part && part->kind == PART_POU && !places->first.len)
		places->first = *span;
}

static void add_fixed(struct task_text *t, gsize from, gsize to, bool closes)
{
	struct task_line *line;

	if (from == to)
		return;
	line = task_line_new(LINE_FIXED, g_strndup(t->whole + from, to - from));
	line->closes = closes;
	g_ptr_array_add(t->line, line);
}

/* Caller frees. */
static char *values_of(const struct project *project, const struct config_entry *entry)
{
	struct sink_memory memory;
	struct sink sink;
	char *out;

	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	project_write_values(project, entry, &sink);
	out = g_strdup(sink_memory_text(&memory));
	sink_memory_free(&memory);
	return out;
}

static void add_entry(struct task_text *t, const struct text_span *span)
{
	const struct project *project = t->project;
	const struct config_entry *entry = &project->config->entry[span->number];
	struct task_line *line = task_line_new(entry->kind == CONFIG_TASK ? LINE_TASK :
		entry->kind == CONFIG_PROGRAM ? LINE_PROGRAM : LINE_FIXED,
		g_strndup(t->whole + span->at, span->len));

	task_line_set(&line->name, project_text(project, entry->own_name ? entry->own_name : entry->name));
	task_line_set(&line->task, project_text(project, entry->own_task ? entry->own_task : entry->task));
	task_line_set(&line->pou, project_text(project, entry->pou));
	g_free(line->values);
	line->values = values_of(project, entry);
	task_line_set(&line->single, project_text(project, entry->single));
	task_line_set(&line->interval, project_text(project, entry->interval));
	task_line_set(&line->watchdog, project_text(project, entry->watchdog));
	g_free(line->priority);
	line->priority = g_strdup_printf("%u", (unsigned)entry->priority);
	g_ptr_array_add(t->line, line);
}

static void take_apart(struct task_text *t, const struct places *places)
{
	const gsize end = places->part.at + places->part.len;
	const gsize closing = places->resource.len ?
		places->resource.at + places->resource.len - strlen("  END_RESOURCE\n") :
		end - strlen("END_CONFIGURATION\n");
	gsize from = places->part.at;

	for (guint i = 0; i <= places->entry->len; i++) {
		const struct text_span *span = i < places->entry->len ?
			&g_array_index(places->entry, struct text_span, i) : NULL;
		const gsize to = span ? span->at : end;

		if (closing >= from && closing < to) {
			add_fixed(t, from, closing, false);
			from = closing;
		}
		add_fixed(t, from, to, from == closing);
		if (!span)
			break;
		add_entry(t, span);
		from = span->at + span->len;
	}
}

bool task_text_has(const struct task_text *t, enum task_line_kind kind)
{
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == kind)
			return true;
	return false;
}

const struct task_line *task_text_of_pou(const struct task_text *t, const char *pou)
{
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_PROGRAM &&
		    name_equal(task_line_at(t, i)->pou, pou))
			return task_line_at(t, i);
	return NULL;
}

bool task_text_is_taken(const struct task_text *t, const char *name)
{
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind != LINE_FIXED &&
		    name_equal(task_line_at(t, i)->name, name))
			return true;
	return false;
}

char *task_text_free_name(const struct task_text *t, const char *like, bool number)
{
	char *name = number ? g_strdup_printf("%s1", like) : g_strdup(like);

	for (int i = 2; task_text_is_taken(t, name); i++) {
		g_free(name);
		name = g_strdup_printf("%s%d", like, i);
	}
	return name;
}

struct task_line *task_text_closing(const struct task_text *t)
{
	for (guint i = 0; i < t->line->len; i++)
		if (task_line_at(t, i)->kind == LINE_FIXED && task_line_at(t, i)->closes)
			return task_line_at(t, i);
	return NULL;
}

struct task_line *task_text_add_program(struct task_text *t, guint at, int pou, const char *task)
{
	struct task_line *line = task_line_new(LINE_PROGRAM, g_strdup(""));

	task_line_set(&line->pou, project_text(t->project, t->project->pou[pou].name));
	task_line_set(&line->task, task);
	g_free(line->name);
	line->name = task_text_free_name(t, line->pou, false);
	line->changed = true;
	g_ptr_array_insert(t->line, (int)at, line);
	return line;
}

/* All programs in the order of the file, in each scan. */
static void write_programs(struct task_text *t)
{
	for (int i = 0; i < t->project->pou_count; i++)
		if (t->project->pou[i].kind == POU_PROGRAM)
			task_text_add_program(t, task_text_index(t, task_text_closing(t)), i, "");
}

bool task_text_is_included(const struct project *project)
{
	for (int i = 0; project && i < project->part_count; i++)
		if (project->part[i].kind == PART_CONFIG)
			return project->part[i].included;
	return false;
}

static void add_closing(struct task_text *t, const char *text)
{
	struct task_line *line = task_line_new(LINE_FIXED, g_strdup(text));

	line->closes = true;
	g_ptr_array_add(t->line, line);
}

/* The lines of another file, to be shown. */
static void take_included(struct task_text *t)
{
	for (int i = 0; i < t->project->config->count; i++)
		add_entry(t, &(struct text_span){ .number = i });
	add_closing(t, "");
}

struct task_text *task_text_new(LadderDocument *document, bool *written)
{
	struct task_text *t = g_new0(struct task_text, 1);
	struct places places = { .t = t };

	t->document = document;
	t->project = ladder_document_project(document);
	t->line = g_ptr_array_new_with_free_func(line_free);
	t->of = g_array_new(FALSE, FALSE, sizeof(struct task_line *));
	if (!t->project)
		return t;
	places.entry = g_array_new(FALSE, FALSE, sizeof(struct text_span));
	t->whole = ladder_document_outline(document, &t->len, take_span, &places);
	if (places.part.len) {
		t->at = places.part.at;
		t->removed = places.part.len;
		take_apart(t, &places);
	} else if (task_text_is_included(t->project)) {
		take_included(t);
	} else {
		t->at = places.first.len ? places.first.at : t->len;
		g_ptr_array_add(t->line, task_line_new(LINE_FIXED, g_strdup(places.first.len ?
			"CONFIGURATION Config\n" : "\nCONFIGURATION Config\n")));
		add_closing(t, "END_CONFIGURATION\n\n");
	}
	g_array_unref(places.entry);
	*written = task_text_has(t, LINE_PROGRAM);
	if (!*written)
		write_programs(t);
	return t;
}

void task_text_free(struct task_text *t)
{
	g_ptr_array_unref(t->line);
	g_array_unref(t->of);
	g_free(t->whole);
	g_free(t);
}

int task_text_number(const struct task_text *t, guint index)
{
	int number = 1;

	for (gsize i = 0; i < t->at; i++)
		number += t->whole[i] == '\n';
	for (guint i = 0; i < index; i++)
		for (const char *at = task_line_at(t, i)->text; *at; at++)
			number += *at == '\n';
	return number;
}

char *task_text_joined(const struct task_text *t)
{
	GString *out = g_string_new(NULL);

	for (guint i = 0; i < t->line->len; i++) {
		char *text = task_line_text(task_line_at(t, i));

		g_string_append(out, text);
		g_free(text);
	}
	return g_string_free(out, FALSE);
}
