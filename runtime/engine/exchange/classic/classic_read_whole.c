/* SPDX-License-Identifier: MIT
 *
 * classic_read_whole - what was read, brought into order and looked at as a whole.
 *
 * Nothing stands twice, every rung and step that something leads to is there, chains of
 * rungs end. Whether the program makes sense is the importer's to say.
 */
#include "engine/exchange/classic/classic_read.h"

#include <stdlib.h>

static int compare(int a, int b)
{
	return (a > b) - (a < b);
}

static int by_rung(const void *a, const void *b)
{
	const struct classic_rung *const *x = a, *const *y = b;

	return compare((*x)->number, (*y)->number);
}

static int by_block(const void *a, const void *b)
{
	const struct classic_block *x = a, *y = b;

	return compare(x->number, y->number);
}

static int by_expression(const void *a, const void *b)
{
	const struct classic_expression *x = a, *y = b;

	return compare(x->number, y->number);
}

static int by_section(const void *a, const void *b)
{
	const struct classic_section *x = a, *y = b;

	return compare(x->number, y->number);
}

static int by_step(const void *a, const void *b)
{
	const struct classic_step *x = a, *y = b;

	return compare(x->index, y->index);
}

static int by_transition(const void *a, const void *b)
{
	const struct classic_transition *x = a, *y = b;

	return compare(x->index, y->index);
}

static void sort(void *vector, int count, size_t size,
		 int (*order)(const void *, const void *))
{
	if (count > 1)
		qsort(vector, (size_t)count, size, order);
}

static void order_blocks(struct classic_reader *reader, struct classic_blocks *blocks,
			 const char *what)
{
	sort(blocks->block, blocks->count, sizeof(*blocks->block), by_block);
	for (int i = 1; i < blocks->count; i++)
		if (blocks->block[i].number == blocks->block[i - 1].number)
			classic_twice(reader, blocks->block[i].place, what,
				      blocks->block[i].number);
}

static void order_lists(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;

	sort(project->rung, project->rungs, sizeof(*project->rung), by_rung);
	for (int i = 1; i < project->rungs; i++)
		if (project->rung[i]->number == project->rung[i - 1]->number)
			classic_twice(reader, project->rung[i]->place, "rung",
				      project->rung[i]->number);
	sort(project->expression, project->expressions, sizeof(*project->expression),
	     by_expression);
	for (int i = 1; i < project->expressions; i++)
		if (project->expression[i].number == project->expression[i - 1].number)
			classic_twice(reader, project->expression[i].place, "expression",
				      project->expression[i].number);
	sort(project->section, project->sections, sizeof(*project->section), by_section);
	sort(project->step, project->steps, sizeof(*project->step), by_step);
	for (int i = 1; i < project->steps; i++)
		if (project->step[i].index == project->step[i - 1].index)
			classic_twice(reader, project->step[i].place, "step",
				      project->step[i].index);
	sort(project->transition, project->transitions, sizeof(*project->transition),
	     by_transition);
	for (int i = 1; i < project->transitions; i++)
		if (project->transition[i].index == project->transition[i - 1].index)
			classic_twice(reader, project->transition[i].place, "transition",
				      project->transition[i].index);
}

static bool has_step(const struct classic_project *project, int index)
{
	struct classic_step key = { .index = index };

	return project->steps && bsearch(&key, project->step, (size_t)project->steps,
					 sizeof(key), by_step);
}

static void check_links(struct classic_reader *reader,
			const struct classic_transition *transition, const int *link,
			int count)
{
	for (int i = 0; i < count; i++)
		if (!has_step(reader->project, link[i])) {
			reader->line_number = transition->place.line;
			classic_fail_at(reader, DIAG_IMPORT_NO_STEP, transition->place, "", 0);
			return;
		}
}

/* Rungs one after the other to the last; each is seen once, or they go in a circle. How
 * many they are. */
static int check_chain(struct classic_reader *reader,
		       const struct classic_section *section)
{
	struct classic_project *project = reader->project;
	struct classic_place place = section->place;
	int number = section->first;

	for (int seen = 0; ; seen++) {
		const struct classic_rung *rung = classic_rung(project, number);
		char text[24] = "rung_";

		if (!rung) {
			int len = 5, from = len;

			do
				text[len++] = (char)('0' + number % 10);
			while ((number /= 10));
			for (int to = len - 1; from < to; from++, to--) {
				char digit = text[from];

				text[from] = text[to];
				text[to] = digit;
			}
			classic_fail_at(reader, DIAG_IMPORT_NO_RUNG, place, text, (size_t)len);
			return seen;
		}
		if (number == section->last)
			return seen + 1;
		if (seen > project->rungs) {
			classic_fail_at(reader, DIAG_IMPORT_CIRCLE, place, section->name,
					strlen(section->name));
			return seen;
		}
		place = rung->place;
		number = rung->next;
		if (number < 0) {
			classic_fail_at(reader, DIAG_IMPORT_CHAIN, place, section->name,
					strlen(section->name));
			return seen + 1;
		}
	}
}

/* A rung may belong to several sections, but so it does in no project that was drawn: a few
 * lines could stand for millions of rungs. */
static void check_sections(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	int rungs = 0;

	for (int i = 0; i < project->sections && rungs <= CLASSIC_LIMIT; i++) {
		struct classic_section *section = &project->section[i];

		if (!section->sequential)
			rungs += check_chain(reader, section);
		if (rungs > CLASSIC_LIMIT)
			classic_fail_at(reader, DIAG_IMPORT_OVERLAP, section->place,
					section->name, strlen(section->name));
	}
}

/* Before there were sections: all rungs, in the order of their numbers. */
static void add_only_section(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;
	struct classic_section *section;

	for (int i = 0; i < project->rungs; i++) {
		project->rung[i]->previous = i ? project->rung[i - 1]->number : -1;
		project->rung[i]->next = i + 1 < project->rungs ?
					 project->rung[i + 1]->number : -1;
	}
	section = arena_push(reader->arena, &project->section, &project->sections,
			     sizeof(*section));
	if (section)
		*section = (struct classic_section){
			.place = project->rung[0]->place, .name = "", .subroutine = -1,
			.first = project->rung[0]->number,
			.last = project->rung[project->rungs - 1]->number };
}

/* ---- who wrote it ---- */

static bool has_member(const struct classic_project *project, const char *name)
{
	for (int i = 0; i < project->members; i++)
		if (strcmp(project->member[i].name, name) == 0)
			return true;
	return false;
}

static bool wide(const struct classic_project *project)
{
	for (int i = 0; i < project->rungs; i++)
		if (project->rung[i]->columns > 10 || project->rung[i]->rows > 6)
			return true;
	return false;
}

/* Upstream has members and sizes that LinuxCNC has not, and the other way round. What
 * both could have written is taken for upstream's. */
static enum classic_dialect dialect_of(const struct classic_project *project)
{
	static const char *const upstream[] = {
		"project_infos.txt", "registers.csv", "config_events.csv", "modem_config.txt",
		"remote_alarms.txt", "spy_vars.csv" };

	for (size_t i = 0; i < sizeof(upstream) / sizeof(*upstream); i++)
		if (has_member(project, upstream[i]))
			return CLASSIC_UPSTREAM;
	if (wide(project))
		return CLASSIC_UPSTREAM;
	return classic_setting(project, "MODBUS_MAP_COIL_READ") ? CLASSIC_LINUXCNC :
								  CLASSIC_UPSTREAM;
}

void classic_whole(struct classic_reader *reader)
{
	struct classic_project *project = reader->project;

	order_lists(reader);
	order_blocks(reader, &project->timer, "timer");
	order_blocks(reader, &project->monostable, "monostable");
	order_blocks(reader, &project->counter, "counter");
	order_blocks(reader, &project->iec_timer, "IEC timer");
	order_blocks(reader, &project->reg, "register");
	if (project->dialect != CLASSIC_NUMERIC)
		project->dialect = dialect_of(project);
	if (!reader->good)
		return;
	if (project->rungs && !project->sections)
		add_only_section(reader);
	if (!project->sections) {
		classic_fail_at(reader, DIAG_IMPORT_NOTHING, (struct classic_place){ "", 0 },
				"", 0);
		return;
	}
	check_sections(reader);
	for (int i = 0; i < project->transitions; i++) {
		const struct classic_transition *transition = &project->transition[i];

		check_links(reader, transition, transition->activate, transition->activates);
		check_links(reader, transition, transition->deactivate,
			    transition->deactivates);
	}
	if (reader->good)
		classic_calls(reader);
}
