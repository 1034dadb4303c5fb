/* SPDX-License-Identifier: MIT
 *
 * sfc_control - how a chart starts, and how an operator controls it.
 */
#include "engine/translate/sfc_unit.h"

#include <stdio.h>

static uint32_t control(const struct sfc_il *s, enum control which)
{
	return s->sfc->control[which];
}

static bool has_modes(const struct sfc_il *s)
{
	return control(s, CONTROL_SEMI) || control(s, CONTROL_MANUAL);
}

/* @edge: TRUE in the scan in which @operand becomes TRUE. */
static uint32_t put_edge(struct sfc_il *s, uint32_t operand, const char *name,
			 const char *memory)
{
	const uint32_t was = sfc_var(s, memory, -1, IEC_BOOL);
	const uint32_t edge = sfc_var(s, name, -1, IEC_BOOL);

	sfc_op(s, OP_LD, 0, operand);
	sfc_op(s, OP_AND, MOD_N, was);
	sfc_op(s, OP_ST, 0, edge);
	sfc_op(s, OP_LD, 0, operand);
	sfc_op(s, OP_ST, 0, was);
	return edge;
}

/* _Forced: FORCE has a new number. */
static void note_forced(struct sfc_il *s)
{
	const uint32_t forced = sfc_var(s, "Forced", -1, IEC_BOOL);
	const uint32_t was = sfc_var(s, "ForceWas", -1, IEC_DINT);

	sfc_op(s, OP_LD, 0, control(s, CONTROL_FORCE));
	sfc_fn(s, FN_NE, was);
	sfc_op(s, OP_ST, 0, forced);
	sfc_op(s, OP_LD, 0, control(s, CONTROL_FORCE));
	sfc_op(s, OP_ST, 0, was);
}

static void put_steps(struct sfc_il *s, const struct sfc_steps *steps)
{
	sfc_op(s, OP_LD, 0, sfc_literal(s, "TRUE"));
	for (int i = 0; i < steps->count; i++)
		sfc_op(s, OP_ST, 0, sfc_var(s, "Entered", steps->step[i], IEC_BOOL));
}

bool sfc_may_begin_anew(const struct sfc_il *s)
{
	return control(s, CONTROL_RESET) || control(s, CONTROL_FORCE);
}

uint32_t sfc_anew(struct sfc_il *s)
{
	return sfc_var(s, "Anew", -1, IEC_BOOL);
}

/* Every active step is left, also one that becomes active again. */
static void leave_all(struct sfc_il *s, const char *name)
{
	const int count = s->sfc->step_count;
	const uint32_t back = sfc_label(s, name, -1);
	uint32_t *label = sfc_alloc(s, (size_t)count, sizeof(*label));
	char text[24];

	snprintf(text, sizeof(text), "%.16s_", name);
	for (int i = 0; label && i < count; i++)
		label[i] = sfc_label(s, text, i);
	if (!label)
		return;
	sfc_each(s, back, sfc_x_name(s, 0), label, count);
	sfc_set(s, sfc_anew(s), true);
	sfc_jump(s, s->leave);
	for (int i = 0; i < count; i++) {
		sfc_here(s, label[i]);
		sfc_set(s, sfc_var(s, "Left", i, IEC_BOOL), true);
		sfc_jump(s, back);
	}
}

static void put_reset(struct sfc_il *s, uint32_t rises)
{
	const uint32_t on = sfc_label(s, "NoReset", -1);

	sfc_op(s, OP_LD, 0, rises);
	sfc_jump_unless(s, on);
	sfc_forget(s);
	put_steps(s, &s->net.initial);
	leave_all(s, "Reset");
	sfc_here(s, on);
}

static void put_force(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	const uint32_t on = sfc_label(s, "NoForce", -1);
	const uint32_t all = sfc_label(s, "LeaveAll", -1);
	char number[16];

	sfc_op(s, OP_LD, 0, sfc_var(s, "Forced", -1, IEC_BOOL));
	if (control(s, CONTROL_RESET))
		sfc_op(s, OP_AND, MOD_N, sfc_var(s, "ResetWas", -1, IEC_BOOL));
	sfc_jump_unless(s, on);
	for (int i = 0; i < count; i++) {
		snprintf(number, sizeof(number), "%d", i + 1);
		sfc_op(s, OP_LD, 0, sfc_var(s, "ForceWas", -1, IEC_DINT));
		sfc_fn(s, FN_EQ, sfc_literal(s, number));
		sfc_jump_if(s, sfc_label(s, "Force", i));
	}
	sfc_jump(s, on);
	for (int i = 0; i < count; i++) {
		struct sfc_steps steps;

		if (!sfc_forced(s->sfc, i, s->ld.translation->arena, &steps))
			s->ld.failed = true;
		sfc_here(s, sfc_label(s, "Force", i));
		put_steps(s, &steps);
		sfc_jump(s, all);
	}
	sfc_here(s, all);
	leave_all(s, "Leaving");
	sfc_here(s, on);
}

void sfc_start(struct sfc_il *s)
{
	const uint32_t runs = sfc_var(s, "Runs", -1, IEC_BOOL);
	const uint32_t on = sfc_label(s, "Running", -1);

	sfc_op(s, OP_LD, 0, runs);
	sfc_jump_if(s, on);
	sfc_set(s, runs, true);
	put_steps(s, &s->net.initial);
	/* Evaluates the transitions that fired a second time. */
	if (sfc_rests_at_once(s->sfc))
		sfc_set(s, s->fired, true);
	sfc_jump(s, s->enter);
	sfc_here(s, on);
}

/* _Any: whatever its condition; _May: if its condition is TRUE; _Auto: without a TIP. */
static void put_modes(struct sfc_il *s)
{
	const uint32_t manual = control(s, CONTROL_MANUAL), semi = control(s, CONTROL_SEMI);
	const uint32_t tip = sfc_var(s, "Tip", -1, IEC_BOOL);

	if (!control(s, CONTROL_TIP))
		sfc_set(s, tip, false);
	if (manual) {
		sfc_op(s, OP_LD, 0, manual);
		sfc_op(s, OP_AND, 0, tip);
		sfc_op(s, OP_ST, 0, sfc_var(s, "Any", -1, IEC_BOOL));
	}
	sfc_op(s, OP_LD, semi ? MOD_N : 0, semi ? semi : sfc_literal(s, "TRUE"));
	if (manual)
		sfc_op(s, OP_AND, MOD_N, manual);
	sfc_op(s, OP_ST, 0, sfc_var(s, "Auto", -1, IEC_BOOL));
	if (semi)
		sfc_op(s, OP_OR, 0, tip);
	if (semi && manual)
		sfc_op(s, OP_AND, MOD_N, manual);
	sfc_op(s, OP_ST, 0, sfc_var(s, "May", -1, IEC_BOOL));
}

void sfc_allow(struct sfc_il *s)
{
	if (!has_modes(s))
		return;
	sfc_op(s, OP_AND, 0, sfc_var(s, "May", -1, IEC_BOOL));
	if (control(s, CONTROL_MANUAL))
		sfc_op(s, OP_OR, 0, sfc_var(s, "Any", -1, IEC_BOOL));
}

void sfc_once(struct sfc_il *s)
{
	if (control(s, CONTROL_MANUAL))
		sfc_set(s, sfc_var(s, "Any", -1, IEC_BOOL), false);
	if (control(s, CONTROL_SEMI)) {
		sfc_op(s, OP_LD, 0, sfc_var(s, "Auto", -1, IEC_BOOL));
		sfc_op(s, OP_ST, 0, sfc_var(s, "May", -1, IEC_BOOL));
	}
}

/* Uses the steps active at the beginning of the scan: an alarm or a SET may have changed
 * them. */
static uint32_t seen(struct sfc_il *s, enum control which)
{
	return sfc_var(s, which == CONTROL_RESET ? "ResetWas" : "Hold", -1, IEC_BOOL);
}

/* Nothing fires while the operand is TRUE. */
static void put_stop(struct sfc_il *s, enum control which)
{
	if (!control(s, which))
		return;
	sfc_op(s, OP_LD, 0, seen(s, which));
	sfc_jump_if(s, s->act);
}

void sfc_control(struct sfc_il *s)
{
	const uint32_t reset = control(s, CONTROL_RESET), tip = control(s, CONTROL_TIP);
	uint32_t rises = 0;

	s->line = (uint32_t)(s->sfc->control_line ? s->sfc->control_line :
			     s->ld.unit->pou->line);
	/* Edges are evaluated in every scan, whether they are used or not. */
	if (reset)
		rises = put_edge(s, reset, "ResetRises", "ResetWas");
	if (has_modes(s) && tip)
		put_edge(s, tip, "Tip", "TipWas");
	if (control(s, CONTROL_FORCE))
		note_forced(s);
	if (control(s, CONTROL_HOLD)) {
		sfc_op(s, OP_LD, 0, control(s, CONTROL_HOLD));
		sfc_op(s, OP_ST, 0, seen(s, CONTROL_HOLD));
	}
	if (has_modes(s))
		put_modes(s);
	if (!sfc_starts_itself(s->sfc))
		sfc_start(s);
	sfc_supervise(s);
	if (reset)
		put_reset(s, rises);
	if (control(s, CONTROL_FORCE))
		put_force(s);
}

void sfc_stop(struct sfc_il *s)
{
	put_stop(s, CONTROL_RESET);
	put_stop(s, CONTROL_HOLD);
}
