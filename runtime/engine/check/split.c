/* SPDX-License-Identifier: MIT
 *
 * split - see split.h.
 */
#include "engine/check/split.h"

#include "engine/base/ascii.h"

#define DAY_PARTS { "YEAR", FN_YEAR_OF }, { "MONTH", FN_MONTH_OF }, { "DAY", FN_DAY_OF }
#define CLOCK_PARTS { "HOUR", FN_HOUR_OF }, { "MINUTE", FN_MINUTE_OF }, { "SECOND", FN_SECOND_OF }, \
	{ "MILLISECOND", FN_MILLISECOND_OF }

static const struct split splits[] = {
	{ "SPLIT_DATE", CLASS_DATE, 3, { DAY_PARTS } },
	{ "SPLIT_TOD", CLASS_TOD, 4, { CLOCK_PARTS } },
	{ "SPLIT_DT", CLASS_DT, 7, { DAY_PARTS, CLOCK_PARTS } },
};

const struct split *split_find(struct scope *scope, const struct pou *pou, const struct expr_node *callee)
{
	struct project *project = scope_project(scope);
	const uint32_t id = names_intern(&project->names, callee->text, callee->len);
	enum diag_id why;

	if ((callee->op != EXPR_NAME && callee->op != EXPR_CALL) || words_find(&project->words, callee->text, callee->len) != WORD_COUNT ||
	    scope_pou(scope, pou, id) || scope_find(scope, pou, id, &why))
		return NULL;
	for (size_t i = 0; i < sizeof(splits) / sizeof(*splits); i++)
		if (ascii_is(splits[i].word, callee->text, callee->len))
			return &splits[i];
	return NULL;
}

int split_pin(const struct split *split, const struct st_part *part, int *last)
{
	if (!part->pin.len)
		return *last < split->count ? ++*last : -1;
	if (ascii_is("IN", part->pin.text, part->pin.len))
		return 0;
	for (int i = 0; i < split->count; i++)
		if (ascii_is(split->part[i].pin, part->pin.text, part->pin.len))
			return i + 1;
	return -1;
}
