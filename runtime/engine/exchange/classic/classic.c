/* SPDX-License-Identifier: MIT
 *
 * classic - finds rungs, blocks, expressions and settings of a ClassicLadder project.
 *
 * All lists are sorted by number. These functions change nothing.
 */
#include "engine/exchange/classic/classic.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct classic_memory_row classic_memory_rows[CLASSIC_MEMORY_ROWS] = {
#define CLASSIC_MEMORY(type, prefix, area, first, size, name) \
	{ type, prefix, area, first, size, name },
#include "engine/classic.def"
};
const struct classic_pin_row classic_pin_rows[CLASSIC_PIN_ROWS] = {
#define CLASSIC_PIN(type, prefix, attribute, kind, pin, is_bool) \
	{ type, prefix, attribute, kind, pin, is_bool },
#include "engine/classic.def"
};
const char *const classic_kind_names[CLASSIC_KINDS] = {
	[CLASSIC_TIMER] = "T", [CLASSIC_MONOSTABLE] = "Mono",
	[CLASSIC_IEC_TIMER] = "TM", [CLASSIC_COUNTER] = "C", [CLASSIC_REGISTER] = "Reg",
};

const struct classic_memory_row *classic_memory_of(int type)
{
	for (int i = 0; i < CLASSIC_MEMORY_ROWS; i++)
		if (classic_memory_rows[i].type == type)
			return &classic_memory_rows[i];
	return NULL;
}

const struct classic_pin_row *classic_pin_of(int type)
{
	for (int i = 0; i < CLASSIC_PIN_ROWS; i++)
		if (classic_pin_rows[i].type == type)
			return &classic_pin_rows[i];
	return NULL;
}

enum classic_kind classic_kind_of(int type)
{
	const struct classic_pin_row *row = classic_pin_of(type);

	return row ? row->kind : CLASSIC_KINDS;
}

int classic_by_number(const void *a, const void *b)
{
	const int x = *(const int *)a, y = *(const int *)b;

	return (x > y) - (x < y);
}

static int by_rung(const void *number, const void *rung)
{
	return classic_by_number(number, *(struct classic_rung *const *)rung);
}

int classic_rung_index(const struct classic_project *project, int number)
{
	struct classic_rung **rung = project->rungs ?
		bsearch(&number, project->rung, (size_t)project->rungs, sizeof(*rung),
			by_rung) : NULL;

	return rung ? (int)(rung - project->rung) : -1;
}

const struct classic_rung *classic_rung(const struct classic_project *project, int number)
{
	const int index = classic_rung_index(project, number);

	return index < 0 ? NULL : project->rung[index];
}

const struct classic_block *classic_block(const struct classic_blocks *blocks, int number)
{
	return blocks->count ? bsearch(&number, blocks->block, (size_t)blocks->count,
				       sizeof(*blocks->block), classic_by_number) : NULL;
}

const char *classic_expression(const struct classic_project *project, int number)
{
	const struct classic_expression *found = project->expressions ?
		bsearch(&number, project->expression, (size_t)project->expressions,
			sizeof(*found), classic_by_number) : NULL;

	return found ? found->text : NULL;
}

const char *classic_setting(const struct classic_project *project, const char *key)
{
	for (int i = 0; i < project->settings; i++)
		if (strcmp(project->setting[i].key, key) == 0)
			return project->setting[i].value;
	return NULL;
}

