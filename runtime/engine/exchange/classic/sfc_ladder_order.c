/* SPDX-License-Identifier: MIT
 *
 * sfc_ladder_order - the rungs of a chart IN ORDER: behind each transition, what it does.
 *
 * A round begins at a label, and is gone through again while anything fires in it, at most
 * LIMIT_ROUNDS times. How the chart begins, and what RESET and FORCE do, stands behind it:
 * sfc_ladder_steps.c.
 */
#include "engine/exchange/classic/sfc_ladder_parts.h"

static char *no(struct lad *e, struct lad_var *var)
{
	return lad_text(e, "NO %s", lad_use(e, var));
}

static char *coil(struct lad *e, const char *word, struct lad_var *var)
{
	return lad_text(e, "%s %s", word, lad_use(e, var));
}

static const char *text_of(const struct lad *e, uint32_t id)
{
	return project_text(e->project, id);
}

bool lad_is_in_order(const struct lad *e)
{
	return e->sfc->evolution == EVOLVE_IN_ORDER;
}

/* ---- one transition ---- */

static void write_short(struct lad *e, int arc, int step)
{
	const struct sfc_step *at = &e->sfc->step[step];
	struct lad_rung *r = lad_begin(e);

	if (!at->min || !at->alarm)
		return;
	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	lad_head(r, lad_text(e, "[ %s < %s ]", lad_use(e, &e->step[step][LAD_T]),
			     lad_words(e, text_of(e, at->min))));
	lad_out(r, lad_text(e, "S %s", lad_words(e, text_of(e, at->alarm))));
	lad_write(e, r, "", lad_text(e, "%s was too short", lad_name(e, step)));
}

static void write_leave(struct lad *e, int arc)
{
	const struct sfc_steps *from = &e->net.arc[arc].from;
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	for (int i = 0; i < from->count; i++) {
		const int step = from->step[i];

		write_short(e, arc, step);
		if (e->step[step][LAD_ENDED].used)
			lad_out(r, coil(e, "S", &e->step[step][LAD_ENDED]));
		lad_out(r, coil(e, "R", &e->step[step][LAD_X]));
	}
	lad_write(e, r, "", lad_text(e, "Leave %s", lad_steps_text(e, from)));
}

static void write_enter(struct lad *e, int arc, int step)
{
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	lad_head(r, lad_text(e, "NC %s", lad_use(e, &e->step[step][LAD_X])));
	if (e->step[step][LAD_T].used)
		lad_out(r, lad_text(e, "[ %s := T#0s ]",
				    lad_use(e, &e->step[step][LAD_T])));
	if (e->step[step][LAD_STARTED].used)
		lad_out(r, coil(e, "S", &e->step[step][LAD_STARTED]));
	lad_once(e, r, step);
	lad_out(r, coil(e, "S", &e->step[step][LAD_X]));
	lad_write(e, r, "", lad_text(e, "Enter %s", lad_name(e, step)));
}

/* SET and RESET are done step by step in the order of the file. */
static void write_enters(struct lad *e, int arc)
{
	const struct sfc_steps *to = &e->net.arc[arc].to;
	int last = -1;

	for (int i = 0; i < to->count; i++) {
		int next = -1;

		for (int k = 0; k < to->count; k++)
			if (to->step[k] > last && (next < 0 || to->step[k] < next))
				next = to->step[k];
		write_enter(e, arc, next);
		last = next;
	}
}

static void write_fired(struct lad *e, int arc)
{
	struct lad_rung *r = lad_begin(e);

	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	lad_out(r, coil(e, "S", &e->whole[LAD_FIRED]));
	if (lad_has_modes(e))
		lad_out(r, coil(e, "R", &e->whole[LAD_HAND]));
	lad_write(e, r, "", "Something has fired in this round");
	r = lad_begin(e);
	if (!e->sfc->control[CONTROL_SEMI])
		return;
	lad_head(r, no(e, &e->arc[arc][LAD_FIRES]));
	lad_head(r, no(e, &e->whole[LAD_ONCE]));
	lad_out(r, coil(e, "R", &e->whole[LAD_GO]));
	lad_write(e, r, "", "SEMI: one TIP is one transition");
}

/* ---- rounds ---- */

void lad_order(struct lad *e)
{
	const char *rounds = lad_use(e, &e->whole[LAD_ROUNDS]);
	struct lad_rung *r = lad_begin(e);

	if (!e->net.arc_count)
		return;
	lad_head(r, lad_text(e, "NO SYS_ALWAYS_ON"));
	lad_out(r, lad_text(e, "[ %s := 0 ]", rounds));
	lad_write(e, r, text_of(e, e->again), "No round yet");
	r = lad_begin(e);
	lad_head(r, lad_text(e, "[ %s := %s + 1 ]", rounds, rounds));
	lad_out(r, coil(e, "R", &e->whole[LAD_FIRED]));
	lad_write(e, r, text_of(e, e->round), "A round");
	for (int i = 0; i < e->net.arc_count; i++) {
		lad_arc(e, i, "");
		write_leave(e, i);
		write_enters(e, i);
		write_fired(e, i);
	}
	r = lad_begin(e);
	lad_head(r, no(e, &e->whole[LAD_FIRED]));
	lad_head(r, lad_text(e, "[ %s < %d ]", rounds, LIMIT_ROUNDS));
	lad_out(r, lad_text(e, "JMP %s", text_of(e, e->round)));
	lad_write(e, r, "", "Until nothing fires");
}
