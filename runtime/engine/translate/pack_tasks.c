/* SPDX-License-Identifier: MIT
 *
 * pack_tasks - tasks and their programs, as they stand in the code image.
 *
 * Without a CONFIGURATION, and for programs that it gives no task: one task that runs
 * in every cycle, behind all others. Without one, a program that another one calls runs only then.
 */
#include "engine/translate/assembler.h"

static const struct config none;

static const struct config *config_of(const struct assembler *as)
{
	const struct config *config = as->translation->project->config;

	return config ? config : &none;
}

static bool same_name(struct assembler *as, uint32_t a, uint32_t b)
{
	struct names *names = &as->translation->project->names;

	return a && b && names_fold(names, a) == names_fold(names, b);
}

static void add_call(struct assembler *as, struct code_task *task, int unit)
{
	words_push(as, &as->call, (uint32_t)unit);
	task->count++;
}

/* The calls of blocks that PROGRAM lines give to @name: project_called(). */
static void add_called(struct assembler *as, struct code_task *task, uint32_t name)
{
	const struct translation *t = as->translation;
	const struct config *config = config_of(as);

	for (int i = 0; i < config->count; i++)
		for (int k = 0; k < config->entry[i].calls; k++) {
			const uint32_t runs = project_called(t->project, &config->entry[i], k);

			if (!same_name(as, config->entry[i].called[k].task, name))
				continue;
			for (int unit = 0; unit < t->unit_count; unit++)
				if (same_name(as, t->unit[unit].pou->name, runs))
					add_call(as, task, unit);
		}
}

/* The programs that a PROGRAM line gives to @name, or, 0, to no task. */
static void add_named(struct assembler *as, struct code_task *task,
		      uint32_t name)
{
	const struct config *config = config_of(as);
	const struct translation *t = as->translation;

	for (int i = 0; i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];

		if (entry->kind != CONFIG_PROGRAM ||
		    (name ? !same_name(as, entry->task, name) : entry->task != 0))
			continue;
		const uint32_t runs = project_is_further(t->project, entry) ?
					      entry->name : entry->pou;

		for (int k = 0; k < t->unit_count; k++)
			if (t->unit[k].pou->kind == POU_PROGRAM &&
			    same_name(as, t->unit[k].pou->name, runs))
				add_call(as, task, k);
	}
}

static uint32_t event_of(struct assembler *as, uint32_t operand)
{
	const struct meaning *m;
	struct spot spot;
	enum diag_id why;

	m = scope_find(as->translation->scope, NULL, operand, &why);
	if (!m) {
		as->failed = true;
		return 0;
	}
	spot = layout_spot(as, m);
	return CODE_OPERAND(spot.packed ? spot.bit : 0, spot.offset);
}

static void split(int64_t ns, uint32_t words[2])
{
	words[0] = (uint32_t)ns;
	words[1] = (uint32_t)((uint64_t)ns >> 32);
}

static struct code_task *new_task(struct assembler *as)
{
	struct code_task *task = arena_push(as->arena, &as->task,
					    &as->task_count, sizeof(*task));

	if (!task) {
		as->failed = true;
		return NULL;
	}
	*task = (struct code_task){ .first = (uint32_t)as->call.count };
	return task;
}

static void add_task(struct assembler *as, const struct config_entry *entry)
{
	struct code_task *task = new_task(as);

	if (!task)
		return;
	task->kind = entry->single ? TASK_EVENT : TASK_INTERVAL;
	task->priority = entry->priority;
	split(entry->interval_ns, task->interval);
	split(entry->watchdog_ns, task->watchdog);
	if (entry->single)
		task->single = event_of(as, entry->single);
	add_named(as, task, entry->name);
	add_called(as, task, entry->name);
	task->name = entry->name; /* until pack_image knows its string */
}

/* By priority, otherwise as they stand: each is put before those behind it. */
static void sort_tasks(struct assembler *as)
{
	for (int i = 1; i < as->task_count; i++) {
		struct code_task task = as->task[i];
		int at = i;

		for (; at > 0 && as->task[at - 1].priority > task.priority; at--)
			as->task[at] = as->task[at - 1];
		as->task[at] = task;
	}
}

bool pack_tasks(struct assembler *as)
{
	const struct config *config = config_of(as);
	struct code_task *last;
	bool any = false;

	for (int i = 0; i < config->count; i++) {
		any |= config->entry[i].kind == CONFIG_PROGRAM;
		if (config->entry[i].kind == CONFIG_TASK)
			add_task(as, &config->entry[i]);
	}
	sort_tasks(as);
	last = new_task(as);
	if (!last)
		return false;
	last->priority = UINT32_MAX;
	if (any)
		add_named(as, last, 0);
	for (int i = 0; !any && i < as->translation->unit_count; i++)
		if (as->translation->unit[i].pou->kind == POU_PROGRAM && !as->called[i])
			add_call(as, last, i);
	/* Nothing to do in every cycle, but a program has one task at least. */
	if (last->count == 0 && as->task_count > 1)
		as->task_count--;
	return !as->failed;
}
