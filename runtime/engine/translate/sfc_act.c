/* SPDX-License-Identifier: MIT
 *
 * sfc_act - which actions the steps call, and what each action does (docs/sfc.md,
 * Qualifiers).
 *
 * First the active steps ask: _Call for actions called now, _Ask for stored ones. Then each
 * action that was asked for, or is not finished, sets _Due.
 */
#include "engine/translate/sfc_unit.h"

static const struct sfc_use *use_at(const struct sfc_il *s, int use)
{
	return &s->sfc->use[use];
}

static bool is_stored(enum qualifier qualifier)
{
	return qualifier == QUALIFIER_S || qualifier == QUALIFIER_DS ||
	       qualifier == QUALIFIER_SD || qualifier == QUALIFIER_SL;
}

static bool is_timed(enum qualifier qualifier)
{
	return qualifier == QUALIFIER_SD || qualifier == QUALIFIER_SL;
}

/* ---- which actions are called for ---- */

static int add_called(struct sfc_il *s, int action, uint32_t operand)
{
	s->called[s->called_count] = (struct sfc_called){ .action = action,
							   .operand = operand };
	return s->called_count++;
}

/* The same text, or another one for the same bit: one BOOL. */
static int find_bool(struct sfc_il *s, uint32_t operand)
{
	const struct names *names = &s->ld.translation->project->names;
	enum diag_id why;
	const struct meaning *m = scope_find(s->ld.translation->scope, s->ld.unit->pou,
					     operand, &why);
	int at;

	for (int i = 0; i < s->called_count; i++) {
		const struct sfc_called *c = &s->called[i];

		if (c->action < 0 &&
		    (names_fold(names, c->operand) == names_fold(names, operand) ||
		     (m && c->meaning && meaning_same(m, c->meaning))))
			return i;
	}
	at = add_called(s, -1, operand);
	s->called[at].meaning = m;
	return at;
}

static void add_use(struct sfc_il *s, struct sfc_called *called, int use)
{
	const enum qualifier q = use_at(s, use)->qualifier;
	const bool pulse = q == QUALIFIER_P0 || q == QUALIFIER_P1;
	int *slot = arena_push(s->ld.translation->arena, &called->use,
			       &called->use_count, sizeof(*slot));

	if (slot)
		*slot = use;
	s->ld.failed |= !slot;
	called->pulse |= pulse;
	called->unsure |= !pulse && q != QUALIFIER_N && q != QUALIFIER_P;
	called->off |= q == QUALIFIER_R;
	called->level |= !pulse && q != QUALIFIER_R;
}

void sfc_find_called(struct sfc_il *s)
{
	const struct sfc *sfc = s->sfc;

	s->called = sfc_alloc(s, (size_t)sfc->action_count + (size_t)sfc->use_count,
			      sizeof(*s->called));
	s->called_of = sfc_alloc(s, (size_t)sfc->use_count, sizeof(*s->called_of));
	if (!s->called || !s->called_of)
		return;
	for (int i = 0; i < sfc->action_count; i++)
		add_called(s, i, 0);
	for (int i = 0; i < sfc->use_count; i++) {
		const struct sfc_use *use = &sfc->use[i];
		int at = use->action;

		s->called_of[i] = -1;
		if (use->kind != USE_ACTION || !use->operand)
			continue;
		if (at < 0)
			at = find_bool(s, use->operand);
		s->called_of[i] = at;
		add_use(s, &s->called[at], i);
	}
}

/* ---- what the steps ask for ---- */

/* The result OR an earlier request. */
static void also(struct sfc_il *s, uint32_t var)
{
	sfc_op(s, OP_OR, 0, var);
	sfc_op(s, OP_ST, 0, var);
}

static void load_time(struct sfc_il *s, const struct sfc_use *use, enum word word)
{
	sfc_op(s, OP_LD, 0, sfc_t_name(s, use->step));
	sfc_fn(s, word, use->time);
}

static void ask(struct sfc_il *s, int number)
{
	const struct sfc_use *use = use_at(s, number);
	const int called = s->called_of[number];
	const uint32_t call = sfc_var(s, "Call", called, IEC_BOOL);

	s->line = (uint32_t)use->line;
	switch (use->qualifier) {
	case QUALIFIER_N: sfc_set(s, call, true); break;
	case QUALIFIER_R: sfc_set(s, sfc_var(s, "Off", called, IEC_BOOL), true); break;
	case QUALIFIER_L:
		load_time(s, use, FN_LT);
		also(s, call);
		break;
	case QUALIFIER_D:
		load_time(s, use, FN_GE);
		also(s, call);
		break;
	case QUALIFIER_DS:
		load_time(s, use, FN_GE);
		sfc_op(s, OP_AND, 0, sfc_var(s, "Wait", number, IEC_BOOL));
		sfc_op(s, OP_ST, 0, sfc_var(s, "Ask", number, IEC_BOOL));
		break;
	case QUALIFIER_S:
	case QUALIFIER_SD:
	case QUALIFIER_SL:
	case QUALIFIER_P:
	case QUALIFIER_P0:
	case QUALIFIER_P1:
	case QUALIFIER_COUNT:
		return;
	}
	sfc_set(s, sfc_var(s, "Due", called, IEC_BOOL), true);
}

/* Asked for in every scan in which the step is active. */
static bool is_level(const struct sfc_il *s, int use)
{
	switch (use_at(s, use)->qualifier) {
	case QUALIFIER_N:
	case QUALIFIER_R:
	case QUALIFIER_L:
	case QUALIFIER_D:
	case QUALIFIER_DS:
		return s->called_of[use] >= 0;
	case QUALIFIER_S:
	case QUALIFIER_P:
	case QUALIFIER_P0:
	case QUALIFIER_P1:
	case QUALIFIER_SD:
	case QUALIFIER_SL:
	case QUALIFIER_COUNT:
		break;
	}
	return false;
}

static bool asks(const struct sfc_il *s, int step)
{
	const struct sfc_step *at = &s->sfc->step[step];

	for (int i = at->first_use; i < at->first_use + at->use_count; i++)
		if (is_level(s, i))
			return true;
	return false;
}

static bool any_asks(const struct sfc_il *s)
{
	for (int i = 0; i < s->sfc->step_count; i++)
		if (asks(s, i))
			return true;
	return false;
}

/* The BOOL that becomes TRUE when the step becomes active; 0: none. An R ends a stored action
 * also when its step is active for less than a scan. */
static uint32_t begun(struct sfc_il *s, int use)
{
	const int called = s->called_of[use];

	switch (use_at(s, use)->qualifier) {
	case QUALIFIER_S:
	case QUALIFIER_SD:
	case QUALIFIER_SL: return sfc_var(s, "Ask", use, IEC_BOOL);
	case QUALIFIER_DS: return sfc_var(s, "Wait", use, IEC_BOOL);
	case QUALIFIER_P: return sfc_var(s, "Call", called, IEC_BOOL);
	case QUALIFIER_P1: return sfc_var(s, "Pulse", called, IEC_BOOL);
	case QUALIFIER_R:
		return sfc_goes_round(s->sfc) ? sfc_var(s, "End", called, IEC_BOOL) : 0;
	case QUALIFIER_N:
	case QUALIFIER_L:
	case QUALIFIER_D:
	case QUALIFIER_P0:
	case QUALIFIER_COUNT:
		break;
	}
	return 0;
}

/* A step that is left. */
static void end_use(struct sfc_il *s, int use)
{
	const enum qualifier q = use_at(s, use)->qualifier;
	const int called = s->called_of[use];

	if (q == QUALIFIER_DS)
		sfc_set(s, sfc_var(s, "Wait", use, IEC_BOOL), false);
	if (q != QUALIFIER_P0)
		return;
	sfc_set(s, sfc_var(s, "Pulse", called, IEC_BOOL), true);
	sfc_set(s, sfc_var(s, "Due", called, IEC_BOOL), true);
}

void sfc_pulse(struct sfc_il *s, int step, bool entered)
{
	const struct sfc_step *at = &s->sfc->step[step];

	for (int i = at->first_use; i < at->first_use + at->use_count; i++) {
		const uint32_t what = s->called_of[i] >= 0 ? begun(s, i) : 0;

		s->line = (uint32_t)use_at(s, i)->line;
		if (!entered && s->called_of[i] >= 0)
			end_use(s, i);
		if (!entered || !what)
			continue;
		sfc_set(s, what, true);
		sfc_set(s, sfc_var(s, "Due", s->called_of[i], IEC_BOOL), true);
	}
}

void sfc_ask(struct sfc_il *s)
{
	const int count = s->sfc->step_count;
	const uint32_t back = sfc_label(s, "Ask", -1), due = sfc_label(s, "Due", -1);
	uint32_t *label = sfc_alloc(s, (size_t)(count + s->called_count),
				    sizeof(*label));

	if (!label)
		return;
	sfc_here(s, s->act);
	for (int i = 0; i < s->called_count; i++)
		sfc_var(s, "Due", i, IEC_BOOL);
	for (int i = 0; i < count; i++)
		label[i] = asks(s, i) ? sfc_label(s, "Do", i) : back;
	if (any_asks(s))
		sfc_each(s, back, sfc_x_name(s, 0), label, count);
	for (int i = 0; i < s->called_count; i++)
		label[i] = sfc_label(s, "Due", i);
	if (s->called_count)
		sfc_each(s, due, sfc_var(s, "Due", 0, IEC_BOOL), label,
			 s->called_count);
}

/* ---- execution of actions ---- */

void sfc_forget(struct sfc_il *s)
{
	bool any = false;

	for (int i = 0; i < s->sfc->use_count; i++) {
		if (s->called_of[i] < 0 || !is_stored(use_at(s, i)->qualifier))
			continue;
		if (!any)
			sfc_op(s, OP_LD, 0, sfc_literal(s, "FALSE"));
		any = true;
		sfc_op(s, OP_ST, 0, sfc_var(s, "Kept", i, IEC_BOOL));
	}
}

/* Of stored actions also those that still wait. */
static void end_stored(struct sfc_il *s, const struct sfc_called *called)
{
	for (int i = 0; i < called->use_count; i++) {
		const int use = called->use[i];

		if (!is_stored(use_at(s, use)->qualifier))
			continue;
		sfc_op(s, OP_ST, 0, sfc_var(s, "Kept", use, IEC_BOOL));
		sfc_op(s, OP_ST, 0, sfc_var(s, "Ask", use, IEC_BOOL));
		if (use_at(s, use)->qualifier == QUALIFIER_DS)
			sfc_op(s, OP_ST, 0, sfc_var(s, "Wait", use, IEC_BOOL));
	}
}

/* R: neither called nor stored. */
static void put_off(struct sfc_il *s, int number)
{
	const struct sfc_called *called = &s->called[number];
	const uint32_t off = sfc_var(s, "Off", number, IEC_BOOL);
	const uint32_t on = sfc_label(s, "On", number);

	sfc_op(s, OP_LD, 0, off);
	sfc_jump_unless(s, on);
	sfc_op(s, OP_LD, 0, sfc_literal(s, "FALSE"));
	sfc_op(s, OP_ST, 0, off);
	if (called->level)
		sfc_op(s, OP_ST, 0, sfc_var(s, "Call", number, IEC_BOOL));
	if (called->pulse)
		sfc_op(s, OP_ST, 0, sfc_var(s, "Pulse", number, IEC_BOOL));
	end_stored(s, called);
	sfc_here(s, on);
}

/* An R of a step that was active for less than a scan. */
static void put_end(struct sfc_il *s, int number)
{
	const uint32_t end = sfc_var(s, "End", number, IEC_BOOL);
	const uint32_t on = sfc_label(s, "Ended", number);

	sfc_op(s, OP_LD, 0, end);
	sfc_jump_unless(s, on);
	sfc_op(s, OP_LD, 0, sfc_literal(s, "FALSE"));
	sfc_op(s, OP_ST, 0, end);
	end_stored(s, &s->called[number]);
	sfc_here(s, on);
}

/* S, DS: a memory. */
static void keep(struct sfc_il *s, int use)
{
	const uint32_t kept = sfc_var(s, "Kept", use, IEC_BOOL);
	const uint32_t asked = sfc_var(s, "Ask", use, IEC_BOOL);

	sfc_op(s, OP_LD, 0, kept);
	sfc_op(s, OP_OR, 0, asked);
	sfc_op(s, OP_ST, 0, kept);
	sfc_set(s, asked, false);
}

/* SD, SL: a memory, and how long it has been: _Call if it is time. */
static void keep_time(struct sfc_il *s, int number, int use)
{
	const struct sfc_use *at = use_at(s, use);
	const uint32_t kept = sfc_var(s, "Kept", use, IEC_BOOL);
	const uint32_t asked = sfc_var(s, "Ask", use, IEC_BOOL);
	const uint32_t since = sfc_var(s, "Since", use, IEC_TIME);
	const uint32_t had = sfc_label(s, "Had", use), on = sfc_label(s, "Kept", use);

	s->line = (uint32_t)at->line;
	sfc_op(s, OP_LD, 0, kept);
	sfc_jump_if(s, had);
	sfc_op(s, OP_LD, 0, sfc_literal(s, "T#0s"));
	sfc_op(s, OP_ST, 0, since);
	sfc_op(s, OP_LD, 0, asked);
	sfc_op(s, OP_ST, 0, kept);
	sfc_jump(s, on);
	sfc_here(s, had);
	sfc_op(s, OP_LD, 0, since);
	sfc_fn(s, FN_ADD, s->dt);
	sfc_op(s, OP_ST, 0, since);
	sfc_here(s, on);
	sfc_set(s, asked, false);
	sfc_op(s, OP_LD, 0, since);
	sfc_fn(s, at->qualifier == QUALIFIER_SD ? FN_GE : FN_LT, at->time);
	sfc_op(s, OP_AND, 0, kept);
	also(s, sfc_var(s, "Call", number, IEC_BOOL));
}

/* The result is TRUE if an action is stored or was asked for before: @any. */
static bool or_kept(struct sfc_il *s, const struct sfc_called *called, bool any,
		    bool timed)
{
	for (int i = 0; i < called->use_count; i++) {
		const enum qualifier q = use_at(s, called->use[i])->qualifier;

		if (!is_stored(q) || (!timed && is_timed(q)))
			continue;
		sfc_op(s, any ? OP_OR : OP_LD, 0,
		       sfc_var(s, "Kept", called->use[i], IEC_BOOL));
		any = true;
	}
	return any;
}

/* The result: a qualifier other than P0 and P1 calls it. */
static void load_called(struct sfc_il *s, int number)
{
	const struct sfc_called *called = &s->called[number];

	sfc_op(s, OP_LD, 0, called->level ? sfc_var(s, "Call", number, IEC_BOOL) :
					    sfc_literal(s, "FALSE"));
	or_kept(s, called, true, false);
}

static void or_pulse(struct sfc_il *s, int number)
{
	if (s->called[number].pulse)
		sfc_op(s, OP_OR, 0, sfc_var(s, "Pulse", number, IEC_BOOL));
}

static void end_calls(struct sfc_il *s, int number)
{
	const struct sfc_called *called = &s->called[number];

	if (called->level)
		sfc_set(s, sfc_var(s, "Call", number, IEC_BOOL), false);
	if (called->pulse)
		sfc_set(s, sfc_var(s, "Pulse", number, IEC_BOOL), false);
}

/* Without a call the variable is written only if it was written before. */
static void write_called(struct sfc_il *s, int number)
{
	const uint32_t now = sfc_var(s, "Now", number, IEC_BOOL);
	const uint32_t was = sfc_var(s, "Was", number, IEC_BOOL);
	const uint32_t idle = sfc_label(s, "Idle", number);

	sfc_op(s, OP_ST, 0, now);
	sfc_op(s, OP_OR, 0, was);
	sfc_jump_unless(s, idle);
	sfc_op(s, OP_LD, 0, now);
	sfc_op(s, OP_ST, 0, s->called[number].operand);
	sfc_op(s, OP_ST, 0, was);
	sfc_here(s, idle);
	sfc_op(s, OP_LD, 0, now);
}

static void do_bool(struct sfc_il *s, int number)
{
	load_called(s, number);
	or_pulse(s, number);
	if (s->called[number].unsure)
		write_called(s, number);
	else
		sfc_op(s, OP_ST, 0, s->called[number].operand);
	or_kept(s, &s->called[number], true, true);
	sfc_op(s, OP_ST, 0, sfc_var(s, "Due", number, IEC_BOOL));
	end_calls(s, number);
}

static void do_body(struct sfc_il *s, int number)
{
	const struct sfc_called *called = &s->called[number];
	const struct sfc_body *body = &s->sfc->action[called->action].body;
	const uint32_t due = sfc_var(s, "Due", number, IEC_BOOL);
	const uint32_t now = sfc_var(s, "Now", number, IEC_BOOL);
	const uint32_t was = sfc_var(s, "Was", number, IEC_BOOL);
	const uint32_t idle = sfc_label(s, "Idle", number);
	const uint32_t done = sfc_label(s, "Done", number);

	load_called(s, number);
	sfc_op(s, OP_ST, 0, now);
	or_pulse(s, number);
	sfc_op(s, OP_OR, 0, was);
	sfc_jump_unless(s, idle);
	sfc_put_body(s, body, done);
	sfc_here(s, done);
	s->line = (uint32_t)s->sfc->action[called->action].line;
	sfc_op(s, OP_LD, 0, now);
	sfc_op(s, OP_ST, 0, was);
	or_kept(s, called, true, true);
	if (s->ld.watch) { /* once more, so that its power is cleared */
		s->ld.mark = IL_WATCHING;
		sfc_op(s, OP_LD, 0, sfc_literal(s, "TRUE"));
		s->ld.mark = 0;
	}
	sfc_op(s, OP_ST, 0, due);
	end_calls(s, number);
	sfc_jump(s, sfc_label(s, "Due", -1));
	sfc_here(s, idle);
	sfc_darken(s, body);
	if (or_kept(s, called, false, true))
		sfc_op(s, OP_ST, 0, due);
	end_calls(s, number);
}

static void decide(struct sfc_il *s, int number)
{
	const struct sfc_called *called = &s->called[number];

	s->line = (uint32_t)(called->use_count ? use_at(s, called->use[0])->line :
			     s->sfc->action[called->action].line);
	sfc_here(s, sfc_label(s, "Due", number));
	if (called->action >= 0) /* do_bool() writes it too */
		sfc_set(s, sfc_var(s, "Due", number, IEC_BOOL), false);
	if (called->off && sfc_goes_round(s->sfc))
		put_end(s, number);
	if (called->off)
		put_off(s, number);
	for (int i = 0; i < called->use_count; i++) {
		const enum qualifier q = use_at(s, called->use[i])->qualifier;

		if (is_timed(q))
			keep_time(s, number, called->use[i]);
		else if (is_stored(q))
			keep(s, called->use[i]);
	}
	if (called->action >= 0)
		do_body(s, number);
	else
		do_bool(s, number);
	sfc_jump(s, sfc_label(s, "Due", -1));
}

void sfc_act(struct sfc_il *s)
{
	for (int i = 0; i < s->sfc->step_count; i++) {
		const struct sfc_step *at = &s->sfc->step[i];

		if (!asks(s, i))
			continue;
		sfc_here(s, sfc_label(s, "Do", i));
		for (int k = at->first_use; k < at->first_use + at->use_count; k++)
			if (is_level(s, k))
				ask(s, k);
		sfc_jump(s, sfc_label(s, "Ask", -1));
	}
	for (int i = 0; i < s->called_count; i++)
		decide(s, i);
}
