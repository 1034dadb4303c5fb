/* SPDX-License-Identifier: MIT
 *
 * settle_acts - writes values where temporaries stood, as far as that changes nothing.
 *
 * The reader of a ladder makes a temporary wherever it might be needed. One is written in
 * place if it is used once, or is a single operand, and no act between changes what it reads.
 */
#include "engine/convert/acts.h"

#include <stdio.h>
#include <string.h>

enum { LARGEST = 12 }; /* operands of an expression that a person still reads */

static void count_act(struct acts *acts, const struct act *act)
{
	if (act->kind == ACT_NOTHING)
		return;
	if (act->temp >= 0)
		acts->temp[act->temp].defined++;
	if (act->when)
		term_count(acts, act->when);
	if (act->value)
		term_count(acts, act->value);
	for (int i = 0; i < act->args; i++) {
		if (act->arg[i].value)
			term_count(acts, act->arg[i].value);
		else if (!act->arg[i].place)
			acts->temp[act->arg[i].temp].defined++;
	}
}

static void count_all(struct acts *acts)
{
	for (int i = 0; i < acts->temps; i++)
		acts->temp[i].uses = acts->temp[i].defined = 0;
	for (int i = 0; i < acts->count; i++)
		count_act(acts, &acts->act[i]);
}

static int uses_in(struct acts *acts, const struct act *act, int temp)
{
	const int before = acts->temp[temp].uses;
	int uses;

	if (act->kind == ACT_NOTHING)
		return 0;
	if (act->when)
		term_count(acts, act->when);
	if (act->value)
		term_count(acts, act->value);
	for (int i = 0; i < act->args; i++)
		if (act->arg[i].value)
			term_count(acts, act->arg[i].value);
	uses = acts->temp[temp].uses - before;
	acts->temp[temp].uses = before;
	return uses;
}

static bool is_short(const struct acts *acts, const struct term *term)
{
	term = term_plain(acts, term);
	if (term->kind == TERM_NOT)
		term = term_plain(acts, term->part[0]);
	return term->kind == TERM_TRUE || term->kind == TERM_NAME || term->kind == TERM_TEMP ||
	       (term->kind == TERM_WORDS && term->level == LEVEL_NAME);
}

/* Is the value of act @at the same at each place that uses its temporary? */
static bool reaches(struct acts *acts, int at, int temp, int uses)
{
	const struct term *value = acts->act[at].value;

	for (int i = at + 1; i < acts->count && acts->act[i].rung == acts->act[at].rung; i++) {
		uses -= uses_in(acts, &acts->act[i], temp);
		if (uses == 0)
			return true;
		if (act_touches(acts, &acts->act[i], value))
			return false;
	}
	return false;
}

bool act_is_latch(struct acts *acts, const struct act *act)
{
	const struct meaning *m = act->target ? acts_meaning(acts, act->target) : NULL;

	/* S= and R= have no bit of an element behind an index. */
	return act->kind == ACT_STORE && act->when && m && !(m->part && m->opens) &&
	       (act->value->kind == TERM_TRUE ||
		(act->value->kind == TERM_WORDS && !strcmp(project_text(acts->project, act->value->text), "FALSE")));
}

/* Is it computed once in each call of the act, in front of all that can fail? */
static bool takes_edge(struct acts *acts, const struct act *act)
{
	const struct meaning *target = acts_meaning(acts, act->target);

	if (act->kind == ACT_JUMP || act->kind == ACT_RETURN || act->kind == ACT_STOP)
		return true;
	if (act->fails || (act->target && (!target || meaning_is_checked(target))))
		return false;
	if (act->kind == ACT_STORE)
		return !act->when || act_is_latch(acts, act);
	return act->kind == ACT_CALL && !act->when && !act->target && act->temp < 0 && acts_meaning(acts, act->text);
}

/* An edge remembers a value each time it is computed: it stays where that is so. */
static bool edge_goes(struct acts *acts, int at, int temp)
{
	for (int i = at + 1; i < acts->count && acts->act[i].rung == acts->act[at].rung; i++) {
		const struct act *act = &acts->act[i];

		if (uses_in(acts, act, temp))
			return takes_edge(acts, act);
		if (act->kind == ACT_JUMP || act->kind == ACT_RETURN || act->kind == ACT_LOOP ||
		    act->kind == ACT_LOOP_END || act->kind == ACT_LABEL)
			return false;
	}
	return false;
}

static bool give_way(struct acts *acts, int at)
{
	struct act *act = &acts->act[at];
	const int temp = act->temp, uses = temp >= 0 ? acts->temp[temp].uses : 0;

	if (act->kind != ACT_STORE || temp < 0 || act->when || acts->temp[temp].defined != 1)
		return false;
	if (uses > 0 && ((uses > 1 && !is_short(acts, act->value)) ||
			 term_size(acts, act->value) > LARGEST || !reaches(acts, at, temp, uses)))
		return false;
	if (uses > 0 && term_has_edge(acts, act->value) && (uses > 1 || !edge_goes(acts, at, temp)))
		return false;
	act->kind = ACT_NOTHING;
	acts->temp[temp].is = act->value;
	return true;
}

static struct act *next_act(struct acts *acts, int at)
{
	for (int i = at + 1; i < acts->count && acts->act[i].rung == acts->act[at].rung; i++)
		if (acts->act[i].kind != ACT_NOTHING)
			return &acts->act[i];
	return NULL;
}

static bool is_temp(const struct acts *acts, const struct term *term, int temp)
{
	term = term ? term_plain(acts, term) : NULL;
	return term && term->kind == TERM_TEMP && term->temp == temp;
}

/* A test whose result only the next act needs becomes its condition, or stores where that act would. */
static bool join_test(struct acts *acts, int at)
{
	struct act *act = &acts->act[at], *next = next_act(acts, at);
	struct term *both;

	if (acts->networks || act->kind != ACT_TEST || act->temp < 0 || acts->temp[act->temp].uses != 1 || !next ||
	    acts->temp[act->temp].defined != 1 || act->writes_any)
		return false;
	if (next->kind == ACT_STORE && next->target && !next->when && is_temp(acts, next->value, act->temp)) {
		next->kind = ACT_TEST;
		next->when = act->when;
		next->value = act->value;
	} else if (next->kind != ACT_TEST && next->kind != ACT_LOOP && is_temp(acts, next->when, act->temp)) {
		next->when = act->value;
		if (act->when) {
			both = arena_alloc(acts->arena, sizeof(*both));
			if (both)
				both->part = arena_alloc(acts->arena, 2 * sizeof(*both->part));
			if (!both || !both->part) {
				acts->failed = true;
				return false;
			}
			both->kind = TERM_AND;
			both->lazy = true;
			both->temp = -1;
			both->parts = 2;
			both->part[0] = act->when;
			both->part[1] = act->value;
			next->when = both;
		}
	} else {
		return false;
	}
	act->kind = ACT_NOTHING;
	return true;
}

/* ENO => Ready, if the next act only stores it there. */
static bool join_output(struct acts *acts, int at)
{
	struct act *act = &acts->act[at], *next = next_act(acts, at);
	const struct meaning *m = next && next->kind == ACT_STORE ? acts_meaning(acts, next->target) : NULL;

	if (act->kind != ACT_CALL || act->when || !m || next->when || m->type != IEC_BOOL || meaning_is_indexed(m))
		return false;
	for (int i = 0; i < act->args; i++) {
		struct act_arg *arg = &act->arg[i];

		if (arg->value || arg->place || acts->temp[arg->temp].uses != 1 ||
		    acts->temp[arg->temp].defined != 1 || !is_temp(acts, next->value, arg->temp))
			continue;
		arg->place = next->target;
		next->kind = ACT_NOTHING;
		return true;
	}
	return false;
}

/* Rung3, Rung3_2: the rung that it comes from. */
static void give_name(struct acts *acts, int temp)
{
	char name[32];

	if (temp < 0 || acts->temp[temp].name)
		return;
	if (acts->temp[temp].wish) {
		acts->temp[temp].name = acts_name(acts, project_text(acts->project, acts->temp[temp].wish));
		return;
	}
	snprintf(name, sizeof(name), "Rung%d", acts->temp[temp].rung + 1);
	acts->temp[temp].name = acts_name(acts, name);
}

static void give_names(struct acts *acts)
{
	for (int i = 0; i < acts->count; i++) {
		const struct act *act = &acts->act[i];

		if (act->kind == ACT_NOTHING)
			continue;
		give_name(acts, act->temp);
		for (int k = 0; k < act->args; k++)
			if (!act->arg[k].value && !act->arg[k].place)
				give_name(acts, act->arg[k].temp);
		if (act->kind == ACT_LOOP) {
			give_name(acts, act->loop.next);
			give_name(acts, act->loop.good);
		}
	}
}

void settle_acts(struct acts *acts)
{
	for (bool again = true; again && !acts->failed;) {
		again = false;
		count_all(acts);
		for (int i = 0; i < acts->count; i++)
			if (give_way(acts, i) || join_test(acts, i) || join_output(acts, i)) {
				again = true;
				count_all(acts);
			}
	}
	give_names(acts);
}
