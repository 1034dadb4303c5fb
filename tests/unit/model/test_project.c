/* SPDX-License-Identifier: MIT
 *
 * test_project - rungs are inserted, removed and moved; flags and names of variables
 * and lines of IL are kept.
 */
#include "engine/model/project.h"
#include "tests/tap.h"

static struct rung *numbered(uint32_t number)
{
	struct rung *rung = rung_new(1, 1);

	if (rung)
		rung->line = number;
	return rung;
}

static bool in_order(const struct pou *pou, const char *order)
{
	if (pou->rung_count != (int)strlen(order))
		return false;
	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->line != (uint32_t)order[i])
			return false;
	return true;
}

static void rungs(struct project *project)
{
	struct pou *pou = arena_push(&project->arena, &project->pou,
				     &project->pou_count, sizeof(*pou));
	struct rung *taken, *spare = numbered('x');
	bool added = true;

	CHECK(project_add_rung(pou, 0, numbered('b')));
	CHECK(project_add_rung(pou, 0, numbered('a')));
	CHECK(project_add_rung(pou, 2, numbered('d')));
	CHECK(project_add_rung(pou, 2, numbered('c')));
	CHECK(in_order(pou, "abcd"));
	CHECK(!project_add_rung(pou, 5, spare));
	CHECK(!project_add_rung(pou, -1, spare));
	CHECK(!project_add_rung(pou, 0, NULL));
	rung_free(spare);
	taken = project_take_rung(pou, 1);
	CHECK(taken && taken->line == 'b');
	rung_free(taken);
	CHECK(in_order(pou, "acd"));
	CHECK(project_take_rung(pou, 3) == NULL);
	CHECK(project_take_rung(pou, -1) == NULL);
	while (pou->rung_count)
		rung_free(project_take_rung(pou, 0));
	CHECK(in_order(pou, ""));
	for (int i = 0; i < 100; i++)
		added &= project_add_rung(pou, i / 2, numbered('n'));
	CHECK(added && pou->rung_count == 100);
}

static void limit_of_rungs(struct project *project)
{
	struct pou *pou = arena_push(&project->arena, &project->pou,
				     &project->pou_count, sizeof(*pou));
	struct rung *one_more = numbered('x');
	bool added = true;

	for (int i = 0; i < LIMIT_RUNGS; i++)
		added &= project_add_rung(pou, i, numbered(1));
	CHECK(added);
	CHECK(!project_add_rung(pou, 0, one_more));
	rung_free(one_more);
}

static void variables(void)
{
	struct var var[5] = { { .fold = 3 }, { .fold = 4 }, { .fold = 5 },
			      { .fold = 4 }, { .fold = 0 } };
	struct var_block block[4] = {
		{ .flags = VAR_RETAIN, .first = 0, .count = 2 },
		{ .flags = VAR_GLOBAL_WORD, .first = 2, .count = 0 },
		{ .flags = VAR_CONSTANT, .first = 2, .count = 2 },
		{ .flags = 0, .first = 4, .count = 1 },
	};
	struct var_table table = { var, 5, block, 4 };
	struct var_table none = { 0 };

	CHECK(vars_flags(&table, 0) == VAR_RETAIN);
	CHECK(vars_flags(&table, 1) == VAR_RETAIN);
	CHECK(vars_flags(&table, 2) == VAR_CONSTANT);
	CHECK(vars_flags(&table, 3) == VAR_CONSTANT);
	CHECK(vars_flags(&table, 4) == 0);
	CHECK(vars_flags(&none, 0) == 0);
	CHECK_AS(vars_find(&table, 4) == 1, "the first of two equal names is found");
	CHECK(vars_find(&table, 5) == 2);
	CHECK(vars_find(&table, 9) == -1);
	CHECK(vars_find(&table, 0) == -1);
	CHECK(vars_find(&none, 3) == -1);
}

static void lines_of_il(struct project *project)
{
	struct il il = { .arena = &project->arena };
	bool kept = true;

	for (uint32_t i = 0; i < 100; i++)
		kept &= il_add(&il, (struct il_line){ .operand = i }) != NULL;
	for (uint32_t i = 0; i < 100; i++)
		kept &= il.line[i].operand == i;
	CHECK(kept && il.count == 100);
	project->arena.failed = true;
	while (il.count < 128 &&
	       il_add(&il, (struct il_line){ .operand = 7 }))
		kept &= il.line[il.count - 1].operand == 7;
	CHECK(kept && il.count == 128);
	CHECK(il_add(&il, (struct il_line){ .operand = 1 }) == NULL);
	CHECK(il.count == 128);
}

int main(void)
{
	struct project *project = project_new("garage.rung");
	struct project *unnamed = project_new(NULL);
	uint32_t id;

	CHECK(project != NULL);
	if (!project)
		return tap_done();
	CHECK_TEXT(project->file, "garage.rung");
	CHECK(unnamed && unnamed->file[0] == '\0');
	project_free(unnamed);
	project_free(NULL);
	id = names_intern(&project->names, "Motor", 5);
	CHECK_TEXT(project_text(project, id), "Motor");
	CHECK_TEXT(project_text(project, 0), "");
	rungs(project);
	limit_of_rungs(project);
	variables();
	lines_of_il(project);
	project_free(project);
	return tap_done();
}
