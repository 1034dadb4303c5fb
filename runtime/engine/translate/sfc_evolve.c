/* SPDX-License-Identifier: MIT
 *
 * sfc_evolve - which transitions fire, and which steps they leave and enter; also IN ORDER.
 *
 * No step changes while conditions are evaluated: a transition that fires notes its steps,
 * and all of them change afterwards.
 */
#include "engine/translate/sfc_unit.h"

#include <stdio.h>

/* ---- conditions ---- */

static int find(int *parent, int step)
{
	while (parent[step] != step)
		step = parent[step] = parent[parent[step]];
	return step;
}

/* Steps that one arc needs form a group; the step with the smallest number stands for it. */
static void unite(int *parent, const struct sfc_steps *steps)
{
	for (int i = 1; i < steps->count; i++) {
		const int a = find(parent, steps->step[0]);
		const int b = find(parent, steps->step[i]);

		parent[a < b ? b : a] = a < b ? a : b;
	}
}

static enum step_duty duty_of(const struct sfc_il *s, const struct sfc_duty *duty)
{
	bool many = false;

	for (int i = 0; i < duty->arc_count; i++)
		many |= s->net.arc[duty->arc[i]].from.count > 1;
	if (!many)
		return duty->arc_count ? DUTY_OWN : DUTY_NONE;
	return duty->arc_count == 1 ? DUTY_JOIN : DUTY_GROUP;
}

static void give_arcs(struct sfc_il *s, int *parent)
{
	for (int i = 0; i < s->net.arc_count && !s->ld.failed; i++) {
		const struct sfc_steps *from = &s->net.arc[i].from;
		struct sfc_duty *duty;
		int *slot;

		if (!from->count)
			continue;
		duty = &s->duty[find(parent, from->step[0])];
		slot = arena_push(s->ld.translation->arena, &duty->arc,
				  &duty->arc_count, sizeof(*slot));
		if (slot)
			*slot = i;
		s->ld.failed |= !slot;
	}
}

void sfc_find_duties(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	int *parent = sfc_alloc(s, (size_t)count, sizeof(*parent));

	s->duty = sfc_alloc(s, (size_t)count, sizeof(*s->duty));
	if (!parent || !s->duty)
		return;
	for (int i = 0; i < count; i++)
		parent[i] = i;
	for (int i = 0; i < s->net.arc_count; i++)
		unite(parent, &s->net.arc[i].from);
	give_arcs(s, parent);
	for (int i = 0; i < count; i++)
		s->duty[i].duty = duty_of(s, &s->duty[i]);
	for (int i = 0; i < count; i++) {
		const int group = find(parent, i);

		s->duty[i].group = group;
		if (s->duty[group].duty == DUTY_GROUP)
			s->duty[i].duty = DUTY_GROUP;
	}
}

/* ---- conditions ---- */

static bool is_off(const struct sfc_il *s, const struct sfc_body *body)
{
	return body->kind == BODY_NONE ||
	       (sfc_body_has_rungs(body) && s->ld.unit->pou->rung[body->first]->off);
}

/* Is the last line the coil, and the only coil? Then its result need not be stored. */
static bool ends_with_coil(const struct sfc_il *s, int first)
{
	const struct il *il = s->ld.il;
	int stores = 0;

	for (int i = first; i < il->count; i++) {
		const struct il_line *line = &il->line[i];

		if (line->kind == IL_LABEL || line->operand != s->condition)
			continue;
		if (line->kind != IL_OP || line->op != OP_ST || line->modifiers)
			return false;
		stores++;
	}
	return stores == 1 && il->line[il->count - 1].operand == s->condition;
}

/* The result is whether arc @arc fires. */
static void sfc_put_condition(struct sfc_il *s, int arc)
{
	const int number = s->net.arc[arc].transition;
	const struct sfc_transition *t = &s->sfc->transition[number];
	const uint32_t end = sfc_label(s, "Known", number);
	const int before = s->ld.il->count;
	bool jumps = false;

	s->line = (uint32_t)t->line;
	if (is_off(s, &t->condition))
		sfc_set(s, s->condition, false);
	sfc_put_body(s, &t->condition, end);
	if (t->condition.kind == BODY_LIST)
		sfc_op(s, OP_ST, 0, s->condition);
	for (int i = before; i < s->ld.il->count; i++) {
		const struct il_line *line = &s->ld.il->line[i];

		jumps |= line->kind == IL_OP && line->op == OP_JMP &&
			 line->operand == end;
	}
	if (!jumps && ends_with_coil(s, before)) {
		s->ld.il->count--;
		sfc_allow(s);
		return;
	}
	if (jumps)
		sfc_here(s, end);
	sfc_op(s, OP_LD, 0, s->condition);
	sfc_allow(s);
}

static void note_fired(struct sfc_il *s, int arc)
{
	const struct sfc_arc *a = &s->net.arc[arc];

	s->line = (uint32_t)s->sfc->transition[a->transition].line;
	sfc_op(s, OP_LD, 0, sfc_literal(s, "TRUE"));
	sfc_op(s, OP_ST, 0, s->fired);
	for (int i = 0; i < a->from.count; i++)
		sfc_op(s, OP_ST, 0, sfc_var(s, "Left", a->from.step[i], IEC_BOOL));
	for (int i = 0; i < a->to.count; i++)
		sfc_op(s, OP_ST, 0, sfc_var(s, "Entered", a->to.step[i], IEC_BOOL));
}

/* The result: all steps that the arc needs are active; @known is known to be active, -1: no
 * step is. */
static void sfc_load_active(struct sfc_il *s, const struct sfc_arc *arc, int known)
{
	bool any = false;

	for (int i = 0; i < arc->from.count; i++) {
		if (arc->from.step[i] == known)
			continue;
		sfc_op(s, any ? OP_AND : OP_LD, 0, sfc_x_name(s, arc->from.step[i]));
		any = true;
	}
}

static void evaluate_own(struct sfc_il *s, const struct sfc_duty *duty)
{
	const int last = duty->arc_count - 1;

	for (int i = 0; i < last; i++) {
		sfc_put_condition(s, duty->arc[i]);
		sfc_jump_if(s, sfc_label(s, "Fire", duty->arc[i]));
	}
	sfc_put_condition(s, duty->arc[last]);
	sfc_jump_unless(s, s->next);
	note_fired(s, duty->arc[last]);
	sfc_jump(s, s->next);
}

/* Another of its steps may be the first after FROM. */
static void evaluate_join(struct sfc_il *s, int step)
{
	sfc_load_active(s, &s->net.arc[s->duty[step].arc[0]], step);
	sfc_jump_unless(s, s->next);
	evaluate_own(s, &s->duty[step]);
}

/* The first active step of the group evaluates the arc. */
static void evaluate_group(struct sfc_il *s, int step)
{
	const struct sfc_duty *duty = &s->duty[step];
	const uint32_t seen = sfc_var(s, "Seen", duty->group, IEC_BOOL);

	sfc_op(s, OP_LD, 0, seen);
	sfc_jump_if(s, s->next);
	if (duty->group != step) {
		sfc_jump(s, sfc_label(s, "Group", duty->group));
		return;
	}
	sfc_here(s, sfc_label(s, "Group", step));
	sfc_set(s, seen, true);
	for (int i = 0; i < duty->arc_count; i++) {
		const struct sfc_arc *arc = &s->net.arc[duty->arc[i]];
		const uint32_t skip = sfc_label(s, "Skip", duty->arc[i]);

		sfc_load_active(s, arc, -1);
		for (int k = 0; k < arc->from.count; k++)
			sfc_op(s, OP_AND, MOD_N,
			       sfc_var(s, "Left", arc->from.step[k], IEC_BOOL));
		sfc_jump_unless(s, skip);
		sfc_put_condition(s, duty->arc[i]);
		sfc_jump_unless(s, skip);
		note_fired(s, duty->arc[i]);
		sfc_here(s, skip);
	}
	sfc_jump(s, s->next);
}

static void evaluate_step(struct sfc_il *s, int step)
{
	const struct sfc_duty *duty = &s->duty[step];

	if (duty->duty == DUTY_NONE)
		return;
	s->line = (uint32_t)s->sfc->step[step].line;
	sfc_here(s, sfc_label(s, "At", step));
	switch (duty->duty) {
	case DUTY_OWN: evaluate_own(s, duty); break;
	case DUTY_JOIN: evaluate_join(s, step); break;
	case DUTY_GROUP: evaluate_group(s, step); break;
	case DUTY_NONE: break;
	}
}

/* ---- phases ---- */

/* Clears each group's BOOL: not evaluated yet. */
static void forget_groups(struct sfc_il *s)
{
	bool any = false;

	for (int i = 0; i < s->sfc->step_count; i++) {
		if (s->duty[i].duty != DUTY_GROUP || s->duty[i].group != i)
			continue;
		if (!any)
			sfc_op(s, OP_LD, 0, sfc_literal(s, "FALSE"));
		any = true;
		sfc_op(s, OP_ST, 0, sfc_var(s, "Seen", i, IEC_BOOL));
	}
}

void sfc_evaluate(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	uint32_t *label = sfc_alloc(s, (size_t)count, sizeof(*label));

	for (int i = 0; label && i < count; i++)
		label[i] = s->duty[i].duty == DUTY_NONE ? s->next :
			   sfc_label(s, "At", i);
	if (!label)
		return;
	if (sfc_goes_round(s->sfc))
		sfc_here(s, sfc_label(s, "Round", -1));
	forget_groups(s);
	sfc_each(s, s->next, sfc_x_name(s, 0), label, count);
	sfc_op(s, OP_LD, 0, s->fired);
	sfc_jump_if(s, s->leave);
}

void sfc_fire(struct sfc_il *s)
{
	for (int i = 0; i < s->sfc->step_count; i++)
		evaluate_step(s, i);
	for (int i = 0; i < s->sfc->step_count; i++) {
		const struct sfc_duty *duty = &s->duty[i];

		for (int k = 0; k < duty->arc_count - 1 && duty->duty != DUTY_GROUP;
		     k++) {
			sfc_here(s, sfc_label(s, "Fire", duty->arc[k]));
			note_fired(s, duty->arc[k]);
			sfc_jump(s, s->next);
		}
	}
}

/* ---- steps ---- */

static void load_late(struct sfc_il *s, int step, enum word word, uint32_t limit)
{
	sfc_op(s, OP_LD, 0, sfc_t_name(s, step));
	sfc_fn(s, word, limit);
}

void sfc_supervise(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	const uint32_t back = sfc_label(s, "Late", -1);
	const uint32_t on = sfc_label(s, "InTime", -1);
	uint32_t *label = sfc_alloc(s, (size_t)count, sizeof(*label));
	bool any = false;

	for (int i = 0; label && i < count; i++) {
		const bool has = s->sfc->step[i].max && s->sfc->step[i].alarm;

		label[i] = has ? sfc_label(s, "Late", i) : back;
		any |= has;
	}
	if (!any)
		return;
	sfc_each(s, back, sfc_x_name(s, 0), label, count);
	sfc_jump(s, on);
	for (int i = 0; i < count; i++) {
		if (label[i] == back)
			continue;
		s->line = (uint32_t)s->sfc->step[i].line;
		sfc_here(s, label[i]);
		load_late(s, i, FN_GT, s->sfc->step[i].max);
		sfc_op(s, OP_S, 0, s->sfc->step[i].alarm);
		sfc_jump(s, back);
	}
	sfc_here(s, on);
}

/* Conditions that are no longer evaluated have no power. */
static void darken_conditions(struct sfc_il *s, int step)
{
	for (int i = 0; s->ld.watch && i < s->net.arc_count; i++) {
		const struct sfc_arc *arc = &s->net.arc[i];

		for (int k = 0; k < arc->from.count; k++)
			if (arc->from.step[k] == step)
				sfc_darken(s, &s->sfc->transition[arc->transition]
						       .condition);
	}
}

static void sfc_end_step(struct sfc_il *s, int step)
{
	const struct sfc_step *at = &s->sfc->step[step];

	sfc_set(s, sfc_x_name(s, step), false);
	darken_conditions(s, step);
	if (at->min && at->alarm) {
		load_late(s, step, FN_LT, at->min);
		if (sfc_may_begin_anew(s))
			sfc_op(s, OP_AND, MOD_N, sfc_anew(s));
		sfc_op(s, OP_S, 0, at->alarm);
	}
	sfc_pulse(s, step, false);
}

static void leave_step(struct sfc_il *s, int step)
{
	const uint32_t entered = sfc_var(s, "Entered", step, IEC_BOOL);
	const uint32_t stay = sfc_label(s, "Stay", step);

	s->line = (uint32_t)s->sfc->step[step].line;
	sfc_here(s, sfc_label(s, "Leave", step));
	sfc_set(s, sfc_var(s, "Left", step, IEC_BOOL), false);
	sfc_op(s, OP_LD, 0, entered);
	if (sfc_may_begin_anew(s))
		sfc_op(s, OP_AND, MOD_N, sfc_anew(s));
	sfc_jump_if(s, stay);
	sfc_end_step(s, step);
	sfc_jump(s, s->leave);
	sfc_here(s, stay);
	sfc_set(s, entered, false);
	sfc_jump(s, s->leave);
}

void sfc_leave(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	uint32_t *label = sfc_alloc(s, (size_t)count, sizeof(*label));

	for (int i = 0; label && i < count; i++)
		label[i] = sfc_label(s, "Leave", i);
	if (!label)
		return;
	s->line = (uint32_t)s->ld.unit->pou->line;
	sfc_each(s, s->leave, sfc_var(s, "Left", 0, IEC_BOOL), label, count);
	if (sfc_may_begin_anew(s))
		sfc_set(s, sfc_anew(s), false);
	if (sfc_starts_itself(s->sfc))
		sfc_start(s);
	sfc_jump(s, s->enter);
	for (int i = 0; i < count; i++)
		leave_step(s, i);
}

static void sfc_begin_step(struct sfc_il *s, int step)
{
	const struct sfc_step *at = &s->sfc->step[step];

	sfc_set(s, sfc_x_name(s, step), true);
	sfc_op(s, OP_LD, 0, sfc_literal(s, "T#0s"));
	sfc_op(s, OP_ST, 0, sfc_t_name(s, step));
	for (int i = at->first_use; i < at->first_use + at->use_count; i++) {
		const struct sfc_use *use = &s->sfc->use[i];

		s->line = (uint32_t)use->line;
		if (use->kind != USE_ACTION && use->operand)
			sfc_set(s, use->operand, use->kind == USE_SET);
	}
	sfc_pulse(s, step, true);
}

static void enter_step(struct sfc_il *s, int step)
{
	s->line = (uint32_t)s->sfc->step[step].line;
	sfc_here(s, sfc_label(s, "Enter", step));
	sfc_set(s, sfc_var(s, "Entered", step, IEC_BOOL), false);
	sfc_op(s, OP_LD, 0, sfc_x_name(s, step));
	sfc_jump_if(s, s->enter);
	sfc_begin_step(s, step);
	sfc_jump(s, s->enter);
}

bool sfc_is_in_order(const struct sfc_il *s)
{
	return s->sfc->evolution == EVOLVE_IN_ORDER;
}

/* Can this part enter the step? IN ORDER, transitions enter steps themselves. */
static bool is_entered(const struct sfc_il *s, int step)
{
	return !sfc_is_in_order(s) || sfc_may_begin_anew(s) ||
	       (s->sfc->step[step].kind == STEP_INITIAL && s->sfc->step[step].macro < 0);
}

void sfc_enter(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	const uint32_t again = sfc_label(s, "Again", -1);
	uint32_t *label = sfc_alloc(s, (size_t)count, sizeof(*label));

	for (int i = 0; label && i < count; i++)
		label[i] = is_entered(s, i) ? sfc_label(s, "Enter", i) : s->enter;
	if (!label)
		return;
	s->line = (uint32_t)s->ld.unit->pou->line;
	sfc_each(s, s->enter, sfc_var(s, "Entered", 0, IEC_BOOL), label, count);
	if (sfc_goes_round(s->sfc)) {
		sfc_op(s, OP_LD, 0, s->fired);
		sfc_jump_if(s, sfc_is_in_order(s) ? sfc_label(s, "Order", -1) : again);
	}
	sfc_set(s, s->fired, false);
	sfc_jump(s, s->act);
	if (s->sfc->evolution == EVOLVE_UNTIL_STABLE) {
		sfc_here(s, again);
		sfc_set(s, s->fired, false);
		sfc_once(s);
		sfc_jump(s, sfc_label(s, "Round", -1));
	}
	for (int i = 0; i < count; i++)
		if (is_entered(s, i))
			enter_step(s, i);
}

/* SET and RESET are done step by step in the order of the file. */
static void sort(struct sfc_steps *steps)
{
	for (int i = 1; i < steps->count; i++) {
		const int step = steps->step[i];
		int k = i;

		for (; k > 0 && steps->step[k - 1] > step; k--)
			steps->step[k] = steps->step[k - 1];
		steps->step[k] = step;
	}
}

/* An active step stays active, unless it was left just now. */
static void enter(struct sfc_il *s, const struct sfc_arc *arc, int step)
{
	const bool left = sfc_steps_has(&arc->from, step);
	const uint32_t is = sfc_label(s, "Is", s->entries++);

	if (!left) {
		sfc_op(s, OP_LD, 0, sfc_x_name(s, step));
		sfc_jump_if(s, is);
	}
	sfc_begin_step(s, step);
	if (!left)
		sfc_here(s, is);
}

static void put_arc(struct sfc_il *s, int number)
{
	struct sfc_arc *arc = &s->net.arc[number];
	const uint32_t skip = sfc_label(s, "Skip", number);
	const uint32_t line = (uint32_t)s->sfc->transition[arc->transition].line;

	s->line = line;
	if (arc->from.count) {
		sfc_load_active(s, arc, -1);
		sfc_jump_unless(s, skip);
	}
	sfc_put_condition(s, number);
	sfc_jump_unless(s, skip);
	sfc_set(s, s->fired, true);
	for (int i = 0; i < arc->from.count; i++)
		sfc_end_step(s, arc->from.step[i]);
	sort(&arc->to);
	for (int i = 0; i < arc->to.count; i++)
		enter(s, arc, arc->to.step[i]);
	s->line = line;
	sfc_once(s);
	sfc_here(s, skip);
}

void sfc_order(struct sfc_il *s)
{
	const uint32_t rounds = sfc_var(s, "Rounds", -1, IEC_INT);
	const uint32_t round = sfc_label(s, "Round", -1);
	char most[16];

	snprintf(most, sizeof(most), "%d", LIMIT_ROUNDS);
	/* Places the BOOLs one after the other, before steps name some of them, because EACH
	 * goes through them. */
	for (int i = 0; i < s->called_count; i++)
		sfc_var(s, "Due", i, IEC_BOOL);
	sfc_here(s, sfc_label(s, "Order", -1));
	sfc_op(s, OP_LD, 0, sfc_literal(s, "0"));
	sfc_op(s, OP_ST, 0, rounds);
	sfc_here(s, round);
	sfc_set(s, s->fired, false);
	for (int i = 0; i < s->net.arc_count; i++)
		put_arc(s, i);
	s->line = (uint32_t)s->ld.unit->pou->line;
	sfc_op(s, OP_LD, 0, s->fired);
	sfc_jump_unless(s, s->act);
	sfc_op(s, OP_LD, 0, rounds);
	sfc_fn(s, FN_ADD, sfc_literal(s, "1"));
	sfc_op(s, OP_ST, 0, rounds);
	sfc_fn(s, FN_LT, sfc_literal(s, most));
	sfc_jump_if(s, round);
	sfc_set(s, s->fired, false);
}
