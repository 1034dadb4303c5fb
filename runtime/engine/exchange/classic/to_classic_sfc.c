/* SPDX-License-Identifier: MIT
 *
 * to_classic_sfc - a chart as a sequential page.
 *
 * All pages of ClassicLadder run IN ORDER; a chart UNTIL STABLE is reported. The condition of
 * a transition there is one bit, and a step has no actions. A section before the page computes
 * longer conditions; a section behind it has coils for BOOLs that several steps hold. Any
 * other chart must be written as a ladder first.
 */
#include "engine/exchange/classic/to_classic_parts.h"

#include "engine/base/ascii.h"

#include <stdlib.h>
#include <string.h>

enum { PAGE_ROWS = 14 };

/* ---- charts that fit ---- */

static bool names_step(const struct project *project, const struct sfc *sfc,
		       const char *text)
{
	for (const char *dot = strchr(text, '.'); dot; dot = strchr(dot + 1, '.'))
		for (int i = 0; i < sfc->step_count; i++) {
			const char *name = project_text(project, sfc->step[i].name);
			size_t len = strlen(name);

			if ((size_t)(dot - text) >= len &&
			    ascii_is(name, dot - len, len))
				return true;
		}
	return false;
}

/* A condition fits if it is an expression or rungs that do not read steps of the chart. */
static bool condition_fits(const struct project *project, const struct pou *pou,
			   const struct sfc_body *body)
{
	if (body->kind != BODY_EXPRESSION && body->kind != BODY_RUNGS)
		return false;
	for (int i = 0; i < body->count; i++) {
		const struct rung *rung = pou->rung[body->first + i];

		for (int k = 0; k < rung->rows * rung->cols; k++)
			if (names_step(project, pou->sfc,
				       project_text(project, rung->cell[k].operand)) ||
			    names_step(project, pou->sfc,
				       project_text(project, rung->cell[k].args)))
				return false;
	}
	return true;
}

/* The CL_STEP in an action that an import writes; NULL: it is another action. */
static const struct cell *seconds_of(const struct pou *pou, const struct sfc_body *body)
{
	const struct cell *found = NULL;
	const struct rung *rung;

	if (body->kind != BODY_RUNGS || body->count != 1)
		return NULL;
	rung = pou->rung[body->first];
	for (int k = 0; k < rung->rows * rung->cols; k++) {
		if (rung->cell[k].word == FB_CL_STEP)
			found = &rung->cell[k];
		else if (rung->cell[k].word != ELEM_CONTACT_NO &&
			 rung->cell[k].word != ELEM_WIRE &&
			 rung->cell[k].word != ELEM_EMPTY)
			return NULL;
	}
	return found;
}

/* The coil of the bit of @step in an action that an import writes; NULL: it is another
 * action. */
static const struct cell *bit_of(const struct project *project, const struct pou *pou,
				 const struct sfc_body *body, int step)
{
	const char *name = project_text(project, pou->sfc->step[step].name);
	const size_t len = strlen(name);
	const struct rung *rung;
	const char *text;

	if (body->kind != BODY_RUNGS || body->count != 1)
		return NULL;
	rung = pou->rung[body->first];
	text = project_text(project, rung->cell[0].operand);
	if (rung->rows != 1 || rung->cols != 2 || rung->cell[0].word != ELEM_CONTACT_NO ||
	    rung->cell[1].word != ELEM_COIL || strlen(text) != len + 2 ||
	    !ascii_is(name, text, len) || !ascii_is(".X", text + len, 2))
		return NULL;
	return &rung->cell[1];
}

/* A line fits if it holds a BOOL or an action that an import writes. */
static bool line_fits(const struct project *project, const struct pou *pou,
		      const struct sfc_use *use)
{
	const struct sfc_body *body = use->action < 0 ? NULL :
				      &pou->sfc->action[use->action].body;

	if (use->kind != USE_ACTION)
		return false;
	if (body && bit_of(project, pou, body, use->step))
		return use->qualifier == QUALIFIER_N || use->qualifier == QUALIFIER_P1;
	return use->qualifier == QUALIFIER_N && (!body || seconds_of(pou, body));
}

static bool sfc_fits(const struct project *project, const struct pou *pou)
{
	const struct sfc *sfc = pou->sfc;

	if (!sfc_goes_round(sfc))
		return false;
	for (int i = 0; i < CONTROL_COUNT; i++)
		if (sfc->control[i])
			return false;
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].kind == STEP_MACRO || sfc->step[i].macro >= 0 ||
		    sfc->step[i].min || sfc->step[i].max)
			return false;
	for (int i = 0; i < sfc->use_count; i++)
		if (!line_fits(project, pou, &sfc->use[i]))
			return false;
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		if (t->priority || t->from_count > CLASSIC_LINKS ||
		    t->to_count > CLASSIC_LINKS || t->macro >= 0 ||
		    !condition_fits(project, pou, &t->condition))
			return false;
	}
	return true;
}

bool classic_sfc_fits(const struct project *project)
{
	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].sfc && !sfc_fits(project, &project->pou[i]))
			return false;
	return true;
}

/* ---- steps ---- */

static bool number_taken(const struct leaving *e, int number)
{
	for (int i = 0; i < e->out->steps; i++)
		if (e->out->step[i].number == number)
			return true;
	return false;
}

/* Step7 is %X7. -1: the name has no number. */
static int number_wished(const char *name)
{
	char *end;
	long wish;

	if (strncmp(name, "Step", 4) != 0 || !ascii_digit(name[4]))
		return -1;
	wish = strtol(name + 4, &end, 10);
	return !*end && wish < CLASSIC_LIMIT ? (int)wish : -1;
}

/* Does the name of any step ask for this number? */
static bool is_wished(const struct leaving *e, int number)
{
	for (int i = 0; i < e->project->pou_count; i++) {
		const struct sfc *sfc = e->project->pou[i].sfc;

		for (int k = 0; sfc && k < sfc->step_count; k++)
			if (number_wished(project_text(e->project,
						       sfc->step[k].name)) == number)
				return true;
	}
	return false;
}

static int step_number(const struct leaving *e, const char *name)
{
	int number = number_wished(name);

	if (number >= 0 && !number_taken(e, number))
		return number;
	number = e->free_step;
	while (number_taken(e, number) || is_wished(e, number))
		number++;
	return number;
}

static void step_slot(struct leaving *e, const struct pou *pou, const struct var *var,
		      int type, int number)
{
	struct out_slot *slot;

	if (!var || slot_find(e, var))
		return;
	slot = arena_push(e->arena, &e->slot, &e->slots, sizeof(*slot));
	if (slot)
		*slot = (struct out_slot){ .var = var, .pou = pou, .type = type,
			.number = number, .block = -1, .count = 0,
			.name = project_text(e->project, var->name), .comment = "",
			.extra = { -1, -1, -1, -1 } };
}

static const struct var *var_of(struct leaving *e, const struct pou *pou, uint32_t text,
				enum meaning_kind kind)
{
	enum diag_id why;
	const struct meaning *m = scope_find(e->scope, pou, text, &why);

	return m && m->kind == kind ? m->var : NULL;
}

static int uses_of(const struct sfc *sfc, const struct project *project, uint32_t operand)
{
	const char *name = project_text(project, operand);
	int count = 0;

	for (int i = 0; i < sfc->use_count; i++)
		count += sfc->use[i].action < 0 &&
			 ascii_is(name, project_text(project, sfc->use[i].operand),
				  strlen(project_text(project, sfc->use[i].operand)));
	return count;
}

/* A BOOL that only one step holds becomes the bit of that step. */
static void use_slots(struct leaving *e, const struct pou *pou, int step, int number)
{
	const struct sfc *sfc = pou->sfc;

	for (int i = 0; i < sfc->use_count; i++) {
		const struct sfc_use *use = &sfc->use[i];
		const struct var *var;
		const struct cell *seconds, *bit;

		if (use->step != step)
			continue;
		if (use->action >= 0 && (bit = bit_of(e->project, pou,
				&sfc->action[use->action].body, step))) {
			step_slot(e, pou, var_of(e, pou, bit->operand, MEANING_VARIABLE),
				  CL_STEP_BIT, number);
			continue;
		}
		if (use->action >= 0) {
			seconds = seconds_of(pou, &sfc->action[use->action].body);
			var = seconds ? var_of(e, pou, seconds->operand,
					       MEANING_INSTANCE) : NULL;
			step_slot(e, pou, var, CL_STEP_TIME, number);
			continue;
		}
		var = var_of(e, pou, use->operand, MEANING_VARIABLE);
		if (var && var->at.area == AREA_NONE && !var->array.count &&
		    uses_of(sfc, e->project, use->operand) == 1)
			step_slot(e, pou, var, CL_STEP_BIT, number);
	}
}

void sfc_prepare(struct leaving *e, const struct pou *pou, int page)
{
	const struct sfc *sfc = pou->sfc;

	for (int i = 0; i < sfc->step_count; i++) {
		const struct sfc_step *step = &sfc->step[i];
		const char *name = project_text(e->project, step->name);
		int number = step_number(e, name);
		struct classic_step *to = arena_push(e->arena, &e->out->step,
						     &e->out->steps, sizeof(*to));

		if (!to)
			return;
		if (number_wished(name) != number)
			e->free_step = number + 1;
		*to = (struct classic_step){ .index = e->out->steps - 1,
			.initial = step->kind == STEP_INITIAL, .number = number,
			.page = page, .x = step->column > 0 ? step->column - 1 :
			1 + i / PAGE_ROWS * 2, .y = i % PAGE_ROWS * 2 };
		step_slot(e, pou, &pou->vars.var[sfc_x(sfc, &pou->vars, i)], CL_STEP_BIT,
			  number);
		use_slots(e, pou, i, number);
	}
}

/* ---- transitions ---- */

/* An expression of one operand is the condition. false: it is longer. */
static bool plain_condition(struct leaving *e, const struct sfc_body *body,
			    struct classic_variable *out)
{
	const struct rung *rung = e->pou->rung[body->first];
	struct out_operand operand;
	const char *text = project_text(e->project, rung->cell[0].operand);

	if (body->kind != BODY_EXPRESSION || rung->cell[0].word != ELEM_COMPARE ||
	    strpbrk(text, " ()=<>&"))
		return false;
	if (!there_text(e, text, strlen(text), &operand) || !operand.is_bool ||
	    operand.is_constant || operand.variable.index_type >= 0)
		return false;
	*out = operand.variable;
	return true;
}

static void condition(struct leaving *e, const struct sfc_body *body,
		      struct classic_variable *out)
{
	const struct sfc *sfc = e->pou->sfc;
	const struct var *var = &e->pou->vars.var[sfc_condition(sfc, &e->pou->vars)];
	struct out_slot *slot;

	if (plain_condition(e, body, out))
		return;
	*out = variable_of(CL_BIT, new_bit(e));
	step_slot(e, e->pou, var, CL_BIT, out->number);
	slot = slot_find(e, var);
	if (!slot)
		return;
	slot->number = out->number;
	for (int i = 0; i < body->count && e->good; i++) {
		e->rung_index = body->first + i;
		leave_rung(e, e->pou->rung[body->first + i]);
	}
}

static const struct classic_step *step_at(const struct leaving *e, int page, int step)
{
	for (int i = 0; i < e->out->steps; i++)
		if (e->out->step[i].page == page)
			return &e->out->step[i + step];
	return NULL;
}

static void transition(struct leaving *e, const struct sfc_transition *from, int page)
{
	const struct sfc *sfc = e->pou->sfc;
	struct classic_transition *to = arena_push(e->arena, &e->out->transition,
						   &e->out->transitions, sizeof(*to));
	const struct classic_step *step;

	if (!to)
		return;
	*to = (struct classic_transition){ .index = e->out->transitions - 1, .page = page };
	for (int i = 0; i < from->from_count; i++) {
		step = step_at(e, page, sfc->ref[from->first_from + i].step);
		to->deactivate[to->deactivates++] = step ? step->index : 0;
		if (step && !i) {
			to->x = step->x;
			to->y = step->y + 1;
		}
	}
	for (int i = 0; i < from->to_count; i++) {
		step = step_at(e, page, sfc->ref[from->first_to + i].step);
		to->activate[to->activates++] = step ? step->index : 0;
		if (step && !i && !from->from_count) {
			to->x = step->x;
			to->y = step->y > 0 ? step->y - 1 : 0;
		}
	}
	condition(e, &from->condition, &to->condition);
}

/* ---- BOOLs that several steps hold ---- */

static bool first_use(const struct leaving *e, int use)
{
	const struct sfc *sfc = e->pou->sfc;
	const char *name = project_text(e->project, sfc->use[use].operand);

	for (int i = 0; i < use; i++) {
		const char *other = project_text(e->project, sfc->use[i].operand);

		if (sfc->use[i].action < 0 && ascii_is(name, other, strlen(other)))
			return false;
	}
	return true;
}

static void held(struct leaving *e, int use)
{
	const struct sfc *sfc = e->pou->sfc;
	const uint32_t name = sfc->use[use].operand;
	const char *text = project_text(e->project, name);
	struct rung *rung = rung_new(uses_of(sfc, e->project, name), 2);
	int row = 0;

	for (int i = use; rung && i < sfc->use_count; i++) {
		const char *other = project_text(e->project, sfc->use[i].operand), *x;

		if (sfc->use[i].action >= 0 || !ascii_is(text, other, strlen(other)))
			continue;
		x = out_text(e, "%s.X", project_text(e->project,
			     sfc->step[sfc->use[i].step].name));
		rung_set_cell(rung, row, 0, (struct cell){ .word = ELEM_CONTACT_NO,
			.link = row > 0,
			.operand = names_intern(&e->project->names, x, strlen(x)) });
		if (!row)
			rung_set_cell(rung, 0, 1, (struct cell){ .word = ELEM_COIL,
								 .operand = name });
		row++;
	}
	if (rung)
		leave_rung(e, rung);
	rung_free(rung);
}

void leave_sfc(struct leaving *e, const struct pou *pou, int page)
{
	const struct sfc *sfc = pou->sfc;
	const char *name = project_text(e->project, pou->name);

	if (sfc->evolution == EVOLVE_UNTIL_STABLE)
		tell_change(e, "in ClassicLadder, a chart UNTIL STABLE goes on transition by "
			    "transition, as one IN ORDER does");
	section_begin(e, out_text(e, "%.*s_If", classic_cut(name, 16), name), -1, false);
	for (int i = 0; i < sfc->transition_count && e->good; i++)
		transition(e, &sfc->transition[i], page);
	section_end(e, true);
	section_begin(e, name, -1, true);
	if (e->section)
		e->section->page = page;
	section_end(e, false);
	section_begin(e, out_text(e, "%.*s_Do", classic_cut(name, 16), name), -1, false);
	for (int i = 0; i < sfc->use_count && e->good; i++) {
		const struct var *var = var_of(e, pou, sfc->use[i].operand,
					       MEANING_VARIABLE);
		const struct out_slot *slot = var ? slot_find(e, var) : NULL;

		if (sfc->use[i].action < 0 && first_use(e, i) &&
		    !(slot && slot->type == CL_STEP_BIT))
			held(e, i);
	}
	section_end(e, true);
}
