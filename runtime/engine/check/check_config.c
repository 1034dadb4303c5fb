/* SPDX-License-Identifier: MIT
 *
 * check_config - tasks and programs by name, each once; events that are bits; areas
 * that are not too large together.
 *
 * A configuration has at most 2 * LIMIT_POUS lines: comparing them all is quick.
 */
#include "engine/check/check_config.h"

#include <stdio.h>
#include <string.h>

struct config_check {
	struct scope *scope;
	struct project *project;
	const struct config *config;
	struct uses *uses;
	struct diag_list *diags;
	bool good;
};

static void report(struct config_check *c, enum diag_id id,
		   const struct config_entry *entry, const char *arg)
{
	struct diag place = { .id = id, .file = c->config->file,
			      .line = entry->line };

	c->good &= diag_add(c->diags, place, "%s", arg);
}

static bool same_name(struct config_check *c, uint32_t a, uint32_t b)
{
	struct names *names = &c->project->names;

	return a && names_fold(names, a) == names_fold(names, b);
}

/* A task may have the name of a program: only WITH names it. */
static bool is_repeated(struct config_check *c, const struct config_entry *entry,
			const struct config_entry *before)
{
	if (entry->kind == CONFIG_AREA)
		return before->kind == CONFIG_AREA && before->area == entry->area;
	return before->kind == entry->kind && same_name(c, before->name, entry->name);
}

static bool check_repeated(struct config_check *c,
			   const struct config_entry *entry)
{
	const struct config_entry *before = c->config->entry;

	while (before < entry && !is_repeated(c, entry, before))
		before++;
	if (before == entry && !(entry->kind == CONFIG_RESOURCE && same_name(c, entry->name, c->config->resource)))
		return true;
	report(c, DIAG_DUPLICATE_NAME, entry, entry->kind == CONFIG_AREA ?
	       iec_area_row(entry->area)->letters :
	       scope_text(c->scope, entry->name));
	return false;
}

static void check_event(struct config_check *c, const struct config_entry *entry)
{
	enum diag_id why;
	const struct meaning *m;

	if (!entry->single)
		return;
	m = scope_find(c->scope, NULL, entry->single, &why);
	if (m && m->kind == MEANING_LITERAL)
		report(c, DIAG_EXPECTED, entry, "a variable after SINGLE");
	else if (!m || m->type != IEC_BOOL)
		report(c, m ? DIAG_NOT_BOOL : why, entry,
		       scope_text(c->scope, entry->single));
	else
		uses_add(c->uses, m, USE_READ);
}

static void check_task(struct config_check *c, const struct config_entry *entry)
{
	bool used = false;

	check_event(c, entry);
	for (int i = 0; i < c->config->count && !used; i++) {
		const struct config_entry *program = &c->config->entry[i];

		used = same_name(c, program->task, entry->name);
		for (int k = 0; k < program->calls && !used; k++)
			used = same_name(c, program->called[k].task, entry->name);
	}
	if (!used)
		report(c, DIAG_TASK_EMPTY, entry, scope_text(c->scope, entry->name));
}

/* The RESOURCE that @entry is in: the number of those behind the first one that begin before it. */
static int resource_of(struct config_check *c, const struct config_entry *entry)
{
	int number = 0;

	for (const struct config_entry *before = c->config->entry; before < entry; before++)
		number += before->kind == CONFIG_RESOURCE;
	return number;
}

/* The task @name after WITH in @entry: of the same RESOURCE, or of none. */
static void check_with(struct config_check *c, const struct config_entry *entry, uint32_t name)
{
	enum diag_id id = DIAG_UNKNOWN_NAME;

	for (int i = 0; i < c->config->count; i++) {
		const struct config_entry *task = &c->config->entry[i];

		if (task->kind != CONFIG_TASK || !same_name(c, task->name, name))
			continue;
		if (!entry->inside || !task->inside || resource_of(c, task) == resource_of(c, entry))
			return;
		id = DIAG_TASK_ELSEWHERE;
	}
	report(c, id, entry, scope_text(c->scope, name));
}

/* The variables of a further instance are called by its name: B.Count. */
static bool has_own_name(struct config_check *c, const struct config_entry *entry)
{
	struct project *project = c->project;

	for (int i = 0; i < project->pou_count; i++)
		if (same_name(c, project->pou[i].name, entry->name))
			return false;
	return vars_find(&project->globals, names_fold(&project->names, entry->name)) < 0;
}

/* What calls the block is named `Main.Pump()`. */
static bool is_too_long(struct config_check *c, const struct config_entry *entry, const struct block_task *called)
{
	const uint32_t program = project_is_further(c->project, entry) ? entry->name : entry->pou;

	return names_len(&c->project->names, program) + names_len(&c->project->names, called->name) + 3 > LIMIT_NAME;
}

static bool is_called_before(struct config_check *c, const struct config_entry *entry, int index)
{
	for (int i = 0; i < index; i++)
		if (same_name(c, entry->called[i].name, entry->called[index].name))
			return true;
	return false;
}

/* `Pump WITH Fast`: a block of the program that has no other task, and a task. */
static void check_called(struct config_check *c, const struct config_entry *entry, const struct pou *pou)
{
	for (int i = 0; i < entry->calls; i++) {
		const struct block_task *called = &entry->called[i];
		enum diag_id why;
		const struct meaning *m = scope_find(c->scope, pou, called->name, &why);

		if (!m || m->kind != MEANING_INSTANCE || m->pou != pou)
			report(c, DIAG_BLOCK_TASK, entry, scope_text(c->scope, called->name));
		else if (is_too_long(c, entry, called))
			report(c, DIAG_NAME_TOO_LONG, entry, scope_text(c->scope, called->name));
		else if (is_called_before(c, entry, i))
			report(c, DIAG_BLOCK_TASK_TWICE, entry, scope_text(c->scope, called->name));
		else
			uses_add(c->uses, m, USE_READ | USE_CALLED);
		check_with(c, entry, called->task);
	}
}

static void check_program(struct config_check *c,
			  const struct config_entry *entry)
{
	const struct pou *pou = NULL;
	bool found = false;

	for (int i = 0; i < c->project->pou_count && !found; i++) {
		pou = &c->project->pou[i];
		found = pou->kind == POU_PROGRAM && same_name(c, pou->name, entry->pou);
	}
	if (found)
		check_called(c, entry, pou);
	if (!found)
		report(c, DIAG_UNKNOWN_NAME, entry,
		       scope_text(c->scope, entry->pou));
	if (found && project_is_further(c->project, entry) && !has_own_name(c, entry))
		report(c, DIAG_INSTANCE_NAME, entry, scope_text(c->scope, entry->name));
	if (entry->task)
		check_with(c, entry, entry->task);
}

/* At the line that makes them too large. */
static void check_areas(struct config_check *c)
{
	struct areas areas;
	char arg[LIMIT_ARG];

	areas_init(&areas);
	for (int i = 0; i < c->config->count; i++) {
		const struct config_entry *entry = &c->config->entry[i];

		if (entry->kind != CONFIG_AREA)
			continue;
		areas.bytes[entry->area] = entry->bytes;
		if (areas_place(&areas))
			continue;
		snprintf(arg, sizeof(arg), "%u" DIAG_AND "%u",
			 (unsigned)areas.size, (unsigned)LIMIT_AREAS);
		report(c, DIAG_AREAS_TOO_LARGE, entry, arg);
		return;
	}
}

bool check_config(struct scope *scope, struct uses *uses,
		  struct diag_list *diags)
{
	struct config_check c = {
		.scope = scope, .project = scope_project(scope), .uses = uses,
		.diags = diags, .good = true,
	};

	c.config = c.project->config;
	if (!c.config)
		return true;
	for (int i = 0; i < c.config->count; i++) {
		const struct config_entry *entry = &c.config->entry[i];

		if (entry->kind == CONFIG_VARS || entry->kind == CONFIG_ACCESS ||
		    entry->kind == CONFIG_LOCATED || !check_repeated(&c, entry))
			continue;
		if (entry->kind == CONFIG_TASK)
			check_task(&c, entry);
		if (entry->kind == CONFIG_PROGRAM)
			check_program(&c, entry);
	}
	check_areas(&c);
	return c.good;
}
