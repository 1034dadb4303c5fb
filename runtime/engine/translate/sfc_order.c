/* SPDX-License-Identifier: MIT
 *
 * sfc_order - charts IN ORDER: transitions one after the other, each fires at once.
 *
 * What a transition does to its steps stands in its own part of the list, so that the next
 * one sees it. So a scan costs what there is, not what is active. It starts nothing and
 * ends nothing by itself: sfc_control.c, sfc_evolve.c.
 */
#include "engine/translate/sfc_unit.h"

#include <stdio.h>

bool sfc_is_in_order(const struct sfc_il *s)
{
	return s->sfc->evolution == EVOLVE_IN_ORDER;
}

static bool has(const struct sfc_steps *steps, int step)
{
	for (int i = 0; i < steps->count; i++)
		if (steps->step[i] == step)
			return true;
	return false;
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

/* One that is active stays so, unless it was left just now. */
static void enter(struct sfc_il *s, const struct sfc_arc *arc, int step)
{
	const bool left = has(&arc->from, step);
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
	/* One behind the other, before steps name some of them: EACH goes through them. */
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
