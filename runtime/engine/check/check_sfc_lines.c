/* SPDX-License-Identifier: MIT
 *
 * check_sfc_lines - lines of steps, their supervision and CONTROL: does it go together?
 *
 * Whether each operand is there and of the right type, check_sfc_names has told.
 */
#include "engine/check/sfc_check.h"

/* ---- supervision ---- */

/* A time that is the same for ever. */
static bool is_fixed(struct sfc_check *c, uint32_t text, int64_t *ns)
{
	enum diag_id why;
	const struct meaning *m = text ? scope_find(c->scope, c->pou, text, &why) : NULL;

	if (!m || m->type != IEC_TIME)
		return false;
	if (m->kind == MEANING_LITERAL)
		*ns = m->literal.value.i;
	else if (m->kind == MEANING_VARIABLE && m->constant && m->var->has_init)
		*ns = m->var->init.i;
	else
		return false;
	return true;
}

static void check_supervision(struct sfc_check *c, const struct sfc_step *step)
{
	const bool times = step->min || step->max;
	const char *name = sfc_name(c, step->name);
	int64_t least, most;

	if (is_fixed(c, step->min, &least) && is_fixed(c, step->max, &most) &&
	    most < least)
		sfc_report(c, DIAG_SFC_TIMES_CROSS, step->line, step->column_at, name);
	if (times != (step->alarm != 0))
		sfc_report(c, DIAG_SFC_NO_ALARM, step->line, step->column_at, name);
}

/* ---- lines ---- */

static void check_line(struct sfc_check *c, const struct sfc_use *use, uint8_t *called)
{
	const bool wanted = qualifier_has_time(use->qualifier);

	if (use->kind != USE_ACTION) {
		if (use->action >= 0)
			sfc_report(c, DIAG_SFC_SET_ACTION, use->line, use->column,
				   sfc_name(c, use->operand));
		return;
	}
	if (wanted != (use->time != 0))
		sfc_report(c, wanted ? DIAG_SFC_NEEDS_TIME : DIAG_SFC_NO_TIME,
			   use->line, use->column, qualifier_word(use->qualifier));
	if (use->action >= 0)
		called[use->action] = 1;
}

static void check_control(struct sfc_check *c)
{
	const uint32_t *control = c->sfc->control;

	if ((control[CONTROL_SEMI] || control[CONTROL_MANUAL]) && !control[CONTROL_TIP])
		sfc_report(c, DIAG_SFC_NO_TIP, c->sfc->control_line, 0, "");
}

void sfc_check_lines(struct sfc_check *c)
{
	const struct sfc *sfc = c->sfc;
	uint8_t *called = arena_alloc(c->scratch, (size_t)sfc->action_count + 1);

	for (int i = 0; i < sfc->step_count; i++)
		check_supervision(c, &sfc->step[i]);
	for (int i = 0; called && i < sfc->use_count; i++)
		check_line(c, &sfc->use[i], called);
	for (int i = 0; called && i < sfc->action_count; i++)
		if (!called[i])
			sfc_report(c, DIAG_SFC_NOT_CALLED, sfc->action[i].line,
				   sfc->action[i].column,
				   sfc_name(c, sfc->action[i].name));
	check_control(c);
}
