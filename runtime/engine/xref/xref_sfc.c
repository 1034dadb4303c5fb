/* SPDX-License-Identifier: MIT
 *
 * xref_sfc - steps, transitions and actions of a chart, and what they use.
 *
 * Conditions and actions are rungs and lists, which xref.c goes through.
 */
#include "engine/xref/xref_walk.h"

static struct xref_target target_of(const struct xref_walk *walk, const struct pou *pou,
				    enum xref_what what, int index)
{
	return (struct xref_target){ index < 0 ? XREF_UNKNOWN : what,
				     (int)(pou - walk->project->pou) + 1, index, { 0 } };
}

static void declare(struct xref_walk *walk, struct pou *pou)
{
	struct sfc *sfc = pou->sfc;

	for (int i = 0; i < sfc->step_count; i++) {
		xref_begin(walk, pou, sfc->step[i].line, sfc->step[i].column_at);
		xref_whole(walk, &sfc->step[i].name, target_of(walk, pou, XREF_STEP, i),
			   XREF_DECLARED);
	}
	for (int i = 0; i < sfc->transition_count; i++) {
		xref_begin(walk, pou, sfc->transition[i].line, sfc->transition[i].column);
		if (sfc->transition[i].name)
			xref_whole(walk, &sfc->transition[i].name,
				   target_of(walk, pou, XREF_TRANSITION, i),
				   XREF_DECLARED);
	}
	for (int i = 0; i < sfc->action_count; i++) {
		xref_begin(walk, pou, sfc->action[i].line, sfc->action[i].column);
		xref_whole(walk, &sfc->action[i].name,
			   target_of(walk, pou, XREF_ACTION, i), XREF_DECLARED);
	}
}

/* What a line does with its BOOL. */
static enum xref_kind kind_of(const struct sfc_use *use)
{
	if (use->kind == USE_SET || (use->kind == USE_ACTION &&
				     (use->qualifier == QUALIFIER_S ||
				      use->qualifier == QUALIFIER_SD ||
				      use->qualifier == QUALIFIER_DS ||
				      use->qualifier == QUALIFIER_SL)))
		return XREF_SET;
	if (use->kind == USE_RESET || use->qualifier == QUALIFIER_R)
		return XREF_RESET;
	return XREF_WRITTEN;
}

static void walk_uses(struct xref_walk *walk, struct pou *pou)
{
	for (int i = 0; i < pou->sfc->use_count; i++) {
		struct sfc_use *use = &pou->sfc->use[i];

		xref_begin(walk, pou, use->line, use->column);
		if (use->action >= 0)
			xref_whole(walk, &use->operand,
				   target_of(walk, pou, XREF_ACTION, use->action),
				   XREF_CALLED);
		else
			xref_all(walk, &use->operand, kind_of(use));
		xref_all(walk, &use->time, XREF_READ);
	}
}

static void walk_steps(struct xref_walk *walk, struct pou *pou)
{
	for (int i = 0; i < pou->sfc->step_count; i++) {
		struct sfc_step *step = &pou->sfc->step[i];

		xref_begin(walk, pou, step->line, step->column_at);
		xref_all(walk, &step->min, XREF_READ);
		xref_all(walk, &step->max, XREF_READ);
		xref_all(walk, &step->alarm, XREF_SET);
	}
}

static void walk_refs(struct xref_walk *walk, struct pou *pou, int first, int count,
		      enum xref_kind kind)
{
	for (int i = first; i < first + count; i++) {
		struct sfc_ref *ref = &pou->sfc->ref[i];

		xref_begin(walk, pou, ref->line, ref->column);
		xref_whole(walk, &ref->name, target_of(walk, pou, XREF_STEP, ref->step),
			   kind);
	}
}

void xref_sfc(struct xref_walk *walk, struct pou *pou)
{
	struct sfc *sfc = pou->sfc;

	declare(walk, pou);
	xref_begin(walk, pou, sfc->control_line, 0);
	for (int i = 0; i < CONTROL_COUNT; i++)
		xref_all(walk, &sfc->control[i], XREF_READ);
	walk_steps(walk, pou);
	walk_uses(walk, pou);
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		walk_refs(walk, pou, t->first_from, t->from_count, XREF_LEFT);
		walk_refs(walk, pou, t->first_to, t->to_count, XREF_ENTERED);
		xref_body(walk, pou, &t->condition);
	}
	for (int i = 0; i < sfc->action_count; i++)
		xref_body(walk, pou, &sfc->action[i].body);
}
