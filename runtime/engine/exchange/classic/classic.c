/* SPDX-License-Identifier: MIT
 *
 * classic - what stands in a ClassicLadder project, by its number.
 *
 * All lists are in order, so that looking is short. It changes nothing.
 */
#include "engine/exchange/classic/classic.h"

#include <stdio.h>
#include <string.h>

int classic_rung_index(const struct classic_project *project, int number)
{
	int low = 0, high = project->rungs;

	while (low < high) {
		int middle = low + (high - low) / 2;

		if (project->rung[middle]->number < number)
			low = middle + 1;
		else
			high = middle;
	}
	return low < project->rungs && project->rung[low]->number == number ? low : -1;
}

const struct classic_rung *classic_rung(const struct classic_project *project, int number)
{
	const int index = classic_rung_index(project, number);

	return index < 0 ? NULL : project->rung[index];
}

const struct classic_block *classic_block(const struct classic_blocks *blocks, int number)
{
	int low = 0, high = blocks->count;

	while (low < high) {
		int middle = low + (high - low) / 2;

		if (blocks->block[middle].number < number)
			low = middle + 1;
		else
			high = middle;
	}
	return low < blocks->count && blocks->block[low].number == number ?
	       &blocks->block[low] : NULL;
}

const char *classic_expression(const struct classic_project *project, int number)
{
	int low = 0, high = project->expressions;

	while (low < high) {
		int middle = low + (high - low) / 2;

		if (project->expression[middle].number < number)
			low = middle + 1;
		else
			high = middle;
	}
	return low < project->expressions && project->expression[low].number == number ?
	       project->expression[low].text : NULL;
}

const char *classic_setting(const struct classic_project *project, const char *key)
{
	for (int i = 0; i < project->settings; i++)
		if (strcmp(project->setting[i].key, key) == 0)
			return project->setting[i].value;
	return NULL;
}

char *classic_print(struct arena *arena, const char *format, va_list args)
{
	va_list again;
	char *text;
	int need;

	va_copy(again, args);
	need = vsnprintf(NULL, 0, format, again);
	va_end(again);
	text = need < 0 ? NULL : arena_alloc(arena, (size_t)need + 1);
	if (text)
		vsnprintf(text, (size_t)need + 1, format, args);
	return text;
}
