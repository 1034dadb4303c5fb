/* SPDX-License-Identifier: MIT
 *
 * cmd_il - `ladder il`: prints the instruction lists that run, as a rung file of IL POUs.
 *
 * It replaces the rungs of the project in memory by the translated lists and writes the
 * project with the ordinary writer. So the output can be read again, except for charts: IL
 * in a rung file has no EACH, TICK or Step.X. Of a code image it prints lists made from the
 * instructions.
 */
#include "ladder/report.h"

#include "engine/exchange/image/image_il.h"
#include "engine/text/pou_print.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copies to @out the variables of @temp that the list uses; the others are for watching.
 * Returns how many; -1: no memory. */
static int pick_used(const struct project *project, const struct il *il,
		     struct var *const *temp, int count, struct var *out)
{
	uint8_t *used = calloc((size_t)count + 1, 1);
	int kept = 0;

	if (!used || !pou_temps_used(&project->names, il, temp, count, used)) {
		free(used);
		return -1;
	}
	for (int i = 0; i < count; i++)
		if (used[i])
			out[kept++] = *temp[i];
	free(used);
	return kept;
}

/* Adds the temporaries of translation to the variables of @pou, in a block of their own. */
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

/* R_EDGE and F_EDGE say it already. */
static void drop_edges(struct il *il)
{
	int kept = 0;

	for (int i = 0; i < il->count; i++)
		if (!(il->line[i].mark & IL_ENTERS))
			il->line[kept++] = il->line[i];
	il->count = kept;
}

/* Prints what an INCLUDE brought in, instead of its line. */
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

		if (pou_has_any_bounds(pou)) /* its calls have one list for each set of bounds */
			continue;
		pou->il = *ladder_il(ladder, i);
		drop_edges(&pou->il);
		pou->language = LANGUAGE_IL;
		pou->sfc = NULL;
		pou->st = NULL;
		if (pou->fbd && !ladder_declare_wires(ladder, i))
			return false;
		pou->fbd = NULL;
		if (!add_temporaries(project, pou, temp, count))
			return false;
		for (int k = 0; k < pou->rung_count; k++)
			rung_free(pou->rung[k]);
		pou->rung_count = 0;
	}
	return true;
}

/* Says on standard error what the lists lack. */
static enum status print_image(struct call *call, const struct ladder *ladder)
{
	size_t len;
	char *lost, *text = image_il_text(ladder_program(ladder), &len, &lost);
	const bool whole = !lost;

	if (!text)
		return report_no_memory(call->arg[0]);
	sink_write(&call->out, text, len);
	if (lost)
		fputs(lost, stderr);
	free(text);
	free(lost);
	return whole ? STATUS_GOOD : STATUS_NO;
}

enum status cmd_il(struct call *call)
{
	struct machine machine;
	enum status status = machine_open(&machine, call->arg[0], MACHINE_AS_FILE);
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
		status = print_image(call, machine.ladder);
	}
	free(text);
	machine_close(&machine);
	return status;
}
