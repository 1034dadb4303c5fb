/* SPDX-License-Identifier: MIT
 *
 * check_sfc_bodies - what conditions and actions are made of.
 *
 * A condition gives one value; nothing jumps from one list into another. All else in
 * rungs and lists is looked at as in other programs.
 */
#include "engine/check/sfc_check.h"

/* ---- the one rung of a condition ---- */

static bool is_condition(const struct sfc_check *c, uint32_t operand)
{
	enum diag_id why;
	const struct meaning *m = scope_find(c->scope, c->pou, operand, &why);

	return m && scope_is_condition(m);
}

/* Its output is COIL TRANSITION or its inverse, and there is no other. */
static bool has_one_coil(const struct sfc_check *c, const struct rung *rung)
{
	int outputs = 0, coils = 0;

	for (int i = 0; i < rung->rows * rung->cols; i++) {
		const struct cell *cell = &rung->cell[i];
		const enum word word = (enum word)cell->word;

		if (words_row(&c->project->words, word)->place != PLACE_LAST)
			continue;
		outputs++;
		coils += (word == ELEM_COIL || word == ELEM_COIL_NOT) &&
			 is_condition(c, cell->operand);
	}
	return outputs == 1 && coils == 1;
}

static void check_rung_of(struct sfc_check *c, const struct sfc_transition *t)
{
	const struct sfc_body *body = &t->condition;
	const struct rung *rung = body->count ? c->pou->rung[body->first] : NULL;
	const char *name = sfc_name(c, t->name);

	if (!rung || rung->off)
		sfc_report(c, DIAG_SFC_NO_CONDITION, t->line, t->column, name);
	else if (body->count > 1 || !has_one_coil(c, rung))
		sfc_report(c, DIAG_SFC_CONDITION_RUNG, rung_line(rung, 0), 0, name);
}

/* ---- lists ---- */

static void report_line(struct sfc_check *c, enum diag_id id, const struct il_line *line)
{
	sfc_report(c, id, (int)line->line, line->col, sfc_name(c, line->operand));
}

static bool is_jump(const struct il_line *line)
{
	return line->kind == IL_OP && line->op == OP_JMP;
}

static int *mark_of(struct sfc_check *c, const struct il_line *line)
{
	const uint32_t fold = names_fold(&c->project->names, line->operand);

	return fold ? &c->mark[fold] : NULL;
}

/* @key: another for each list. */
static void check_labels(struct sfc_check *c, const struct sfc_body *body, int key)
{
	const struct il_line *line = c->pou->il.line;
	int *mark;

	for (int i = body->first; i < body->first + body->count; i++) {
		mark = line[i].kind == IL_LABEL ? mark_of(c, &line[i]) : NULL;
		if (mark && *mark == key)
			report_line(c, DIAG_DUPLICATE_LABEL, &line[i]);
		if (mark)
			*mark = key;
	}
	for (int i = body->first; i < body->first + body->count; i++) {
		mark = is_jump(&line[i]) ? mark_of(c, &line[i]) : NULL;
		if (mark && *mark != key)
			report_line(c, DIAG_NO_LABEL, &line[i]);
	}
}

static bool is_empty(const struct sfc_check *c, const struct sfc_body *body)
{
	for (int i = body->first; i < body->first + body->count; i++)
		if (c->pou->il.line[i].kind != IL_COMMENT &&
		    c->pou->il.line[i].kind != IL_LABEL)
			return false;
	return true;
}

void sfc_check_bodies(struct sfc_check *c)
{
	const struct sfc *sfc = c->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		if (t->condition.kind == BODY_RUNGS)
			check_rung_of(c, t);
		if (t->condition.kind == BODY_LIST && is_empty(c, &t->condition))
			sfc_report(c, DIAG_SFC_NO_CONDITION, t->line, t->column,
				   sfc_name(c, t->name));
	}
	for (int i = 0; i < sfc_bodies(sfc); i++)
		if (sfc_body(sfc, i)->kind == BODY_LIST)
			check_labels(c, sfc_body(sfc, i), i + 1);
}
