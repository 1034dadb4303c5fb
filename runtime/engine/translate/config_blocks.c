/* SPDX-License-Identifier: MIT
 *
 * config_blocks - VAR_CONFIG of variables within blocks: Main.Pump.Stop AT %IX0.0 : BOOL;
 *
 * A block has one body for all instances, so its variable has no address of its own: it is copied from an input
 * before the program runs, to an output behind it, and both for a memory. RETURN leads to the copies behind.
 */
#include "engine/translate/translate.h"

#include "engine/model/located.h"
#include "engine/translate/temps.h"

#include <stdio.h>
#include <string.h>

/* A copy: operands of the variable and of the place with the address. */
struct copied { uint32_t within, place; enum iec_area area; uint32_t line; };

/* Is @line of VAR_CONFIG about a variable in a block of the program of @unit? */
static bool belongs(struct project *project, const struct unit *unit, const struct var *line, struct located *to)
{
	const char *name = project_text(project, unit->pou->name);

	if (!line->at_text || unit->pou->kind != POU_PROGRAM ||
	    !located_find(project, project_text(project, line->name), to) || !to->part)
		return false;
	return strcmp(name, project_text(project, to->instance && project_is_further(project, to->instance) ?
					 to->instance->name : project->pou[to->pou].name)) == 0;
}

static bool make_place(struct unit *unit, const struct var *line, int number, uint32_t *out)
{
	struct var like = { .type = line->type, .at = line->at, .at_text = line->at_text };
	char name[24];

	snprintf(name, sizeof(name), "_V%d", number);
	*out = temps_named(unit->temps, name, &like);
	return *out != 0;
}

static bool add(struct il *il, enum op op, uint8_t modifiers, uint32_t operand, uint32_t line)
{
	return il_add(il, (struct il_line){ .kind = IL_OP, .op = (uint8_t)op, .modifiers = modifiers, .mark = IL_MADE,
					    .operand = operand, .line = line });
}

static bool copy(struct il *il, const struct copied *copied, bool in)
{
	return add(il, OP_LD, 0, in ? copied->place : copied->within, copied->line) &&
	       add(il, OP_ST, 0, in ? copied->within : copied->place, copied->line);
}

/* The list with the copies around it. */
static bool surround(struct project *project, const struct copied *copied, int count, struct il *il)
{
	const uint32_t end = names_intern(&project->names, "_Located", 8);
	struct il out = { .arena = il->arena };
	bool good = end != 0;

	for (int i = 0; i < count; i++)
		if (copied[i].area != AREA_Q)
			good = good && copy(&out, &copied[i], true);
	for (int i = 0; i < il->count && good; i++) {
		struct il_line line = il->line[i];

		if (line.kind == IL_OP && line.op == OP_RET) {
			line.op = OP_JMP;
			line.operand = end;
		}
		good = il_add(&out, line);
	}
	good = good && il_add(&out, (struct il_line){ .kind = IL_LABEL, .mark = IL_MADE, .operand = end });
	for (int i = 0; i < count; i++)
		if (copied[i].area != AREA_I)
			good = good && copy(&out, &copied[i], false);
	if (good)
		*il = out;
	return good;
}

bool config_blocks(struct translation *translation, struct unit *unit, struct il *il)
{
	struct project *project = translation->project;
	struct copied *copied = NULL;
	int count = 0;

	for (int i = 0; i < project->located.count && unit->temps; i++) {
		const struct var *line = &project->located.var[i];
		struct copied *one;
		struct located to;

		if (!belongs(project, unit, line, &to))
			continue;
		one = arena_push(translation->arena, &copied, &count, sizeof(*one));
		if (!one)
			return false;
		*one = (struct copied){ .within = scope_within(translation->scope, to.text), .area = line->at.area,
					.line = (uint32_t)unit->pou->line };
		if (!one->within || !make_place(unit, line, i + 1, &one->place))
			return false;
	}
	return !count || surround(project, copied, count, il);
}
