/* SPDX-License-Identifier: MIT
 *
 * lists - the lists that run as the bodies of POUs.
 */
#include "engine/convert/convert.h"

#include "engine/check/wires.h"
#include "engine/text/pou_print.h"

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

bool convert_to_il(struct project *project, int number, const struct il *list, struct var *const *temp,
		   int temp_count)
{
	struct pou *pou = &project->pou[number];

	pou->il = *list;
	drop_edges(&pou->il);
	pou->language = LANGUAGE_IL;
	pou->sfc = NULL;
	pou->st = NULL;
	if (pou->fbd && !wires_declare(project, pou, &pou->il))
		return false;
	pou->fbd = NULL;
	if (!add_temporaries(project, pou, temp, temp_count))
		return false;
	for (int k = 0; k < pou->rung_count; k++)
		rung_free(pou->rung[k]);
	pou->rung_count = 0;
	return true;
}

void convert_join(struct project *project)
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
