/* SPDX-License-Identifier: MIT
 *
 * pou_print - a POU as a text that reads again: as it is, or in IL.
 *
 * It makes a project of this POU alone and calls text_write(), so that it has no syntax of
 * its own. Globals are left out.
 */
#include "engine/text/pou_print.h"

#include "engine/text/text.h"

#include <stdlib.h>
#include <string.h>

/* Does the operand name @name, or a part of it? */
static bool is_of(const char *operand, const char *name)
{
	const size_t len = strlen(name);

	return strncmp(operand, name, len) == 0 && (operand[len] == '.' || operand[len] == '[');
}

bool pou_temps_used(const struct names *names, const struct il *il, struct var *const *temps, int count, uint8_t *used)
{
	uint8_t *named = calloc((size_t)names->count + 1, 1);

	for (int i = 0; named && i < il->count; i++)
		named[il->line[i].operand] = named[il->line[i].pin] = 1;
	for (int k = 0; named && k < count; k++) {
		used[k] = named[temps[k]->name];
		for (int i = 0; i < il->count && !used[k] && (temps[k]->type == IEC_NONE || temps[k]->array.count); i++)
			used[k] = is_of(names_text(names, il->line[i].operand), names_text(names, temps[k]->name));
	}
	free(named);
	return named != NULL;
}

/* @vars and, in a block of their own, the temporaries in use. */
static bool join_vars(const struct names *names, const struct var_table *vars,
		      struct var *const *temps, int temp_count,
		      const struct il *il, struct var_table *out)
{
	uint8_t *used = calloc((size_t)temp_count + 1, 1);
	size_t most = (size_t)vars->count + (size_t)temp_count;

	out->var = calloc(most + 1, sizeof(*out->var));
	out->block = calloc((size_t)vars->block_count + 1, sizeof(*out->block));
	if (!used || !out->var || !out->block || !pou_temps_used(names, il, temps, temp_count, used)) {
		free(used);
		return false;
	}
	if (vars->count > 0)
		memcpy(out->var, vars->var,
		       (size_t)vars->count * sizeof(*out->var));
	if (vars->block_count > 0)
		memcpy(out->block, vars->block,
		       (size_t)vars->block_count * sizeof(*out->block));
	out->count = vars->count;
	for (int i = 0; i < temp_count; i++)
		if (used[i])
			out->var[out->count++] = *temps[i];
	out->block_count = vars->block_count;
	if (out->count > vars->count)
		out->block[out->block_count++] = (struct var_block){
			.first = vars->count, .count = out->count - vars->count,
		};
	free(used);
	return true;
}

/* A project with one POU, and the types of @project. */
static struct project project_of(const struct project *project, struct pou *pou, struct part *part)
{
	return (struct project){
		.names = project->names, .words = project->words,
		.structure = project->structure, .structure_count = project->structure_count,
		.named = project->named, .named_count = project->named_count,
		.enumeration = project->enumeration, .enumeration_count = project->enumeration_count,
		.enum_value = project->enum_value, .enum_value_count = project->enum_value_count,
		.pou = pou, .pou_count = 1, .part = part, .part_count = 1,
	};
}

bool pou_print_il(const struct project *project, const struct pou *pou,
		   const struct var_table *vars, struct var *const *temps,
		   int temp_count, const struct il *il, const struct sink *sink)
{
	struct pou only = { .name = pou->name, .kind = pou->kind,
			    .language = LANGUAGE_IL, .il = *il };
	struct part part = { .kind = PART_POU };
	struct project one = project_of(project, &only, &part);
	char *text = NULL;
	size_t len;

	if (join_vars(&project->names, vars, temps, temp_count, il, &only.vars))
		text = text_write(&one, &len);
	/* The text before the POU is the head of the file. */
	const char *begin = text ? strstr(text, pou_word(pou->kind)) : NULL;
	if (begin)
		sink_text(sink, begin);
	free(text);
	free(only.vars.var);
	free(only.vars.block);
	return begin != NULL;
}

/* The VAR_ACCESS of the POU, as those of POU 0. */
static struct access_block *access_of(const struct project *project, const struct pou *pou, int *count)
{
	const char *name = project_text(project, pou->name);
	const int number = project->access_block_count ? project_find_pou(project, name, strlen(name)) : -1;
	struct access_block *out = number < 0 ? NULL : calloc((size_t)project->access_block_count, sizeof(*out));

	*count = 0;
	for (int i = 0; out && i < project->access_block_count; i++) {
		if (project->access_block[i].pou != number + 1)
			continue;
		out[*count] = project->access_block[i];
		out[(*count)++].pou = 1;
	}
	return out;
}

char *pou_print(const struct project *project, const struct pou *pou)
{
	struct pou only = *pou;
	struct part part = { .kind = PART_POU };
	struct project one = project_of(project, &only, &part);
	size_t len;
	char *text, *begin;

	only.comment = 0;
	only.included = 0;
	one.access = project->access;
	one.access_count = project->access_count;
	one.access_block = access_of(project, pou, &one.access_block_count);
	text = text_write(&one, &len);
	free(one.access_block);
	begin = text ? strstr(text, pou_word(pou->kind)) : NULL;
	if (begin)
		memmove(text, begin, strlen(begin) + 1);
	return text;
}
