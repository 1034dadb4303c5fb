/* SPDX-License-Identifier: MIT
 *
 * load_text - the table of `ladder check --tasks`.
 */
#include "ladder/load_text.h"

#include "engine/trial/load.h"

#include <stdio.h>
#include <stdlib.h>

#define ROW_SIZE 64

static const char *name_of(const struct program *program, uint32_t i)
{
	const char *name = task_name(program, i);

	return *name ? name : "-";
}

static void print_due(const struct load *load, uint32_t i, char *text)
{
	const struct code_task *task = &load->program->task[i];

	if (task->kind == TASK_EVENT)
		snprintf(text, ROW_SIZE, "at its event");
	else if (task->kind == TASK_CYCLE)
		snprintf(text, ROW_SIZE, "in every cycle");
	else
		snprintf(text, ROW_SIZE, "every %.10g ms", (double)task_interval(task) / 1e6);
}

/* Programs without a task run behind all tasks. */
static void print_row(const struct load *load, uint32_t i, bool timed, const struct sink *out)
{
	const struct load_task *task = &load->task[i];
	char due[ROW_SIZE], priority[16] = "-", words[32], way[32] = "-";

	print_due(load, i, due);
	if (load->program->task[i].kind != TASK_CYCLE)
		snprintf(priority, sizeof(priority), "%u", load->program->task[i].priority);
	snprintf(words, sizeof(words), "%llu%s", (unsigned long long)task->words,
		 task->loops ? " + loops" : "");
	if (task->way)
		snprintf(way, sizeof(way), "%llu%s", (unsigned long long)task->way,
			 task->way_loops ? " + loops" : "");
	sink_printf(out, "  %-16s %-16s %8s %18s %18s", name_of(load->program, i), due, priority,
		    words, way);
	if (timed)
		sink_printf(out, " %11.1f %11.1f %9llu", (double)task->run_ns / 1e3,
			    (double)task->wait_ns / 1e3, (unsigned long long)task->overruns);
	sink_text(out, "\n");
}

static void print_table(struct load *load, int64_t speed, bool good, const struct sink *out)
{
	sink_printf(out, "  %-16s %-16s %8s %18s %18s", "task", "is due", "priority", "words of a run",
		    "to a safe point");
	if (speed)
		sink_printf(out, " %11s %11s %9s", "run, us", "waits, us", "left out");
	sink_text(out, "\n");
	for (uint32_t i = 0; i < load->program->task_count; i++)
		print_row(load, i, speed != 0, out);
	sink_printf(out, "  cycles every %.10g ms, ", (double)load->tick_ns / 1e6);
	if (speed)
		sink_printf(out, "busy %u.%u %%\n", load->busy_permille / 10,
			    load->busy_permille % 10);
	if (speed && good)
		return;
	const uint64_t enough = load_enough(load);

	if (speed)
		sink_text(out, "  too slow: tasks leave out periods; ");
	if (enough)
		sink_printf(out, "%llu words a millisecond are enough\n",
			    (unsigned long long)enough);
	else
		sink_text(out, "no speed is enough\n");
}

static void print_json(const struct load *load, int64_t speed, uint64_t enough, bool good,
		       const struct sink *out)
{
	sink_printf(out, ", \"cycle_ns\": %lld, \"enough\": %llu, \"tasks\": [",
		    (long long)load->tick_ns, (unsigned long long)enough);
	for (uint32_t i = 0; i < load->program->task_count; i++) {
		const struct code_task *row = &load->program->task[i];
		const struct load_task *task = &load->task[i];

		sink_text(out, i ? ",\n  {\"name\": " : "\n  {\"name\": ");
		sink_json_text(out, task_name(load->program, i));
		sink_printf(out, ", \"interval_ns\": %lld, \"words\": %llu, \"loops\": %s",
			    (long long)task_interval(row), (unsigned long long)task->words,
			    task->loops ? "true" : "false");
		if (task->way)
			sink_printf(out, ", \"way\": %llu, \"way_loops\": %s",
				    (unsigned long long)task->way,
				    task->way_loops ? "true" : "false");
		if (row->kind != TASK_CYCLE)
			sink_printf(out, ", \"priority\": %u", row->priority);
		if (speed)
			sink_printf(out, ", \"run_ns\": %lld, \"wait_ns\": %lld, "
				    "\"left_out\": %llu", (long long)task->run_ns,
				    (long long)task->wait_ns, (unsigned long long)task->overruns);
		sink_text(out, "}");
	}
	sink_text(out, "]");
	if (speed)
		sink_printf(out, ", \"busy_permille\": %u, \"fast_enough\": %s",
			    load->busy_permille, good ? "true" : "false");
}

static enum status print(struct load *load, int64_t speed, bool json, const struct sink *out)
{
	uint64_t enough = 0;
	bool good = true;

	if (json)
		enough = load_enough(load);
	if (speed)
		good = load_run(load, (uint64_t)speed);
	if (json)
		print_json(load, speed, enough, good, out);
	else
		print_table(load, speed, good, out);
	return good ? STATUS_GOOD : STATUS_NO;
}

enum status load_print(struct ladder *ladder, const char *path, int64_t speed, bool json,
		       const struct sink *out)
{
	struct load *load = malloc(sizeof(*load));
	enum status status;

	if (!load || !load_measure(ladder_program(ladder), program_period(ladder, 0), load)) {
		free(load);
		return report_no_memory(path);
	}
	status = print(load, speed, json, out);
	load_free(load);
	free(load);
	return status;
}
