/* SPDX-License-Identifier: MIT
 *
 * cmd_il - `ladder il`: the instruction list that runs, as a rung file of IL
 * POUs.
 *
 * The project in memory gets the lists that translation made in place of its
 * rungs, and is written by the one writer; so what is shown can be read again,
 * but for charts, whose steps (Step.X, EACH, TICK) no list can name.
 */
#include "ladder/report.h"

#include <stdlib.h>
#include <string.h>

/* Those of @temp that the list speaks of; the others serve watching. */
static int pick_used(const struct project *project, const struct il *il,
		     struct var *const *temp, int count, struct var *out)
{
	uint8_t *used = calloc((size_t)project->names.count + 1, 1);
	int kept = 0;

	if (!used)
		return -1;
	for (int i = 0; i < il->count; i++)
		used[il->line[i].operand] = used[il->line[i].pin] = 1;
	for (int i = 0; i < count; i++)
		if (used[temp[i]->name])
			out[kept++] = *temp[i];
	free(used);
	return kept;
}

/* Variables of @pou and, in a block of their own, those that were added. */
static bool add_temporaries(struct project *project, struct pou *pou,
			    struct var *const *temp, int count)
{
	struct var_table *table = &pou->vars;
	size_t vars = (size_t)table->count, blocks = (size_t)table->block_count;
	struct var *var = arena_alloc(&project->arena, sizeof(*var) *
				      (vars + (size_t)count));
	struct var_block *block = arena_alloc(&project->arena, sizeof(*block) *
					      (blocks + 1));

	if (!var || !block)
		return false;
	count = pick_used(project, &pou->il, temp, count, var + vars);
	if (count <= 0)
		return count == 0;
	if (vars)
		memcpy(var, table->var, sizeof(*var) * vars);
	if (blocks)
		memcpy(block, table->block, sizeof(*block) * blocks);
	block[blocks].first = table->count;
	block[blocks].count = count;
	table->var = var;
	table->block = block;
	table->count += count;
	table->block_count++;
	return true;
}

/* What an INCLUDE brought in is shown too, and so its line is not. */
static void join_includes(struct project *project)
{
	int kept = 0;

	for (int i = 0; i < project->part_count; i++) {
		project->part[i].included = 0;
		if (project->part[i].kind != PART_INCLUDE &&
		    project->part[i].kind != PART_USES)
			project->part[kept++] = project->part[i];
	}
	project->part_count = kept;
	for (int i = 0; i < project->pou_count; i++)
		project->pou[i].included = 0;
}

static bool turn_to_il(struct ladder *ladder, struct project *project)
{
	join_includes(project);
	for (int i = 0; i < project->pou_count; i++) {
		struct pou *pou = &project->pou[i];
		int count = 0;
		struct var *const *temp = ladder_temporaries(ladder, i, &count);

		pou->il = *ladder_il(ladder, i);
		pou->language = LANGUAGE_IL;
		pou->sfc = NULL;
		if (!add_temporaries(project, pou, temp, count))
			return false;
		for (int k = 0; k < pou->rung_count; k++)
			rung_free(pou->rung[k]);
		pou->rung_count = 0;
	}
	return true;
}

enum status cmd_il(struct call *call)
{
	struct machine machine;
	enum status status = machine_open_file(&machine, call->arg[0]);
	struct project *project = NULL;
	char *text = NULL;
	size_t len;

	if (status == STATUS_GOOD)
		project = ladder_project(machine.ladder);
	if (project) {
		if (turn_to_il(machine.ladder, project))
			text = ladder_write(machine.ladder, &len);
		if (text)
			sink_write(&call->out, text, len);
		else
			status = report_no_memory(call->arg[0]);
	} else if (status == STATUS_GOOD) {
		report_diag((struct diag){ .id = DIAG_IMAGE_NO_TEXT,
					   .file = call->arg[0] },
			    "%s", "");
		status = STATUS_NO;
	}
	free(text);
	machine_close(&machine);
	return status;
}
