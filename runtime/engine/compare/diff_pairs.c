/* SPDX-License-Identifier: MIT
 *
 * diff_pairs - the rungs and lines of two projects side by side, without words: for
 * drawings.
 */
#include "engine/compare/diff.h"

#include <string.h>

/* All rungs of a POU that the other project does not have. */
static void give_all(struct diff *diff, const struct pou *pou, bool added)
{
	struct compare_pair pair = diff->pair;
	bool list = pou->language != LANGUAGE_LD;

	pair.changed = true;
	pair.rung_a = pair.rung_b = -1;
	for (int i = 0; i < (list ? 1 : pou->rung_count); i++) {
		if (!list)
			*(added ? &pair.rung_b : &pair.rung_a) = i;
		diff->take(diff->context, pair);
	}
}

static void give_pou(struct diff *diff, int index)
{
	const struct pou *a = &diff->a->pou[index];
	const char *name = project_text(diff->a, a->name);
	int other = project_find_pou(diff->b, name, strlen(name));
	const struct pou *b = other < 0 ? NULL : &diff->b->pou[other];

	diff->pair = (struct compare_pair){ index, other, -1, -1, false, true };
	if (b && a->language == LANGUAGE_LD && b->language == LANGUAGE_LD) {
		diff_rungs(diff, a, b);
	} else if (b && a->language == b->language) {
		diff->count = 0;
		void (*take)(void *, struct compare_pair) = diff->take;
		diff->take = NULL;
		diff_il(diff, a, b);
		diff->take = take;
		diff->pair.changed = diff->count > 0;
		diff->take(diff->context, diff->pair);
	} else if (b) {
		diff->take(diff->context, diff->pair);
	} else {
		give_all(diff, a, false);
	}
}

static void say_nothing(void *context, const char *text, size_t len)
{
	(void)context;
	(void)text;
	(void)len;
}

bool compare_rungs(const struct project *a, const struct project *b,
		     void (*take)(void *context, struct compare_pair pair),
		     void *context)
{
	const struct sink silent = { .write = say_nothing };
	struct diff *diff = diff_open(a, b, &silent);

	if (!diff)
		return false;
	diff->take = take;
	diff->context = context;
	for (int i = 0; i < a->pou_count && !diff->failed; i++)
		give_pou(diff, i);
	for (int j = 0; j < b->pou_count && !diff->failed; j++) {
		const char *name = project_text(b, b->pou[j].name);

		diff->pair = (struct compare_pair){ -1, j, -1, -1, false, true };
		if (project_find_pou(a, name, strlen(name)) < 0)
			give_all(diff, &b->pou[j], true);
	}
	return diff_close(diff);
}

bool compare_lines(const struct project *a, int pou_a, const struct project *b,
		     int pou_b,
		     void (*take)(void *context, struct compare_line line), void *context)
{
	const struct sink silent = { .write = say_nothing };
	struct diff *diff = diff_open(a, b, &silent);

	if (!diff)
		return false;
	diff->take_line = take;
	diff->context = context;
	diff_il(diff, pou_a < 0 ? NULL : &a->pou[pou_a], pou_b < 0 ? NULL : &b->pou[pou_b]);
	return diff_close(diff);
}
