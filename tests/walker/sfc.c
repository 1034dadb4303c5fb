/* SPDX-License-Identifier: MIT
 *
 * sfc - plays a chart as a token game, as docs/sfc.md describes it.
 *
 * Every step, transition and line is evaluated in every scan; macro-steps are searched
 * each time. sfc_lines.c handles the lines of steps.
 */
#include "tests/walker/sfc_inside.h"

#include <limits.h>
#include <string.h>

#define ROUNDS_MAX 50        /* of a scan, IN ORDER                           */
#define EVOLUTIONS_MAX 1000  /* of a scan; a chart with more of them is a fault */

/* ---- macro-steps ---- */

static int entry_of(const struct sfc *sfc, int macro)
{
	int i = 0;

	while (i < sfc->step_count &&
	       (sfc->step[i].macro != macro || sfc->step[i].kind != STEP_INITIAL))
		i++;
	return i;
}

static bool has_way_out(const struct sfc *sfc, int step)
{
	for (int i = 0; i < sfc->transition_count; i++)
		for (int k = 0; k < sfc->transition[i].from_count; k++)
			if (sfc->ref[sfc->transition[i].first_from + k].step == step)
				return true;
	return false;
}

static int exit_of(const struct sfc *sfc, int macro)
{
	int i = 0;

	while (i < sfc->step_count &&
	       (sfc->step[i].macro != macro || has_way_out(sfc, i)))
		i++;
	return i;
}

/* Depth of these three: nested macro-steps, at most 8. */
static bool can_be_left(const struct played_sfc *played, int step)
{
	if (!value_is_true(*played->step[step].x))
		return false;
	return played->sfc->step[step].kind != STEP_MACRO ||
	       can_be_left(played, exit_of(played->sfc, step));
}

/* Whether no earlier transition takes it. */
static bool is_free(const struct played_sfc *played, int step)
{
	if (played->step[step].leaving)
		return false;
	return played->sfc->step[step].kind != STEP_MACRO ||
	       is_free(played, exit_of(played->sfc, step));
}

static void mark_leaving(struct played_sfc *played, int step)
{
	played->step[step].leaving = true;
	if (played->sfc->step[step].kind == STEP_MACRO)
		mark_leaving(played, exit_of(played->sfc, step));
}

static void mark_entering(struct played_sfc *played, int step)
{
	played->step[step].entering = true;
	if (played->sfc->step[step].kind == STEP_MACRO)
		mark_entering(played, entry_of(played->sfc, step));
}

/* ---- made once ---- */

static bool place(struct walker *walker, const struct frame *frame, uint32_t name,
		  struct placed *out)
{
	const char *text = project_text(walker->project, name);

	*out = (struct placed){ .kind = PLACED_NOWHERE };
	if (!name)
		return true;
	*out = walker_place(walker, frame, text, strlen(text));
	walker->why = text;
	return out->kind != PLACED_NOWHERE;
}

static bool make_steps(struct walker *walker, struct played_sfc *played)
{
	const struct sfc *sfc = played->sfc;
	const struct frame *frame = played->walked->frame;

	for (int i = 0; i < sfc->step_count; i++) {
		const struct sfc_step *from = &sfc->step[i];
		struct played_step *step = &played->step[i];
		const struct var_table *vars = &played->walked->pou->vars;

		step->x = frame->variable[sfc_x(sfc, vars, i)].value;
		step->t = frame->variable[sfc_t(sfc, vars, i)].value;
		if (!place(walker, frame, from->min, &step->min) ||
		    !place(walker, frame, from->max, &step->max) ||
		    !place(walker, frame, from->alarm, &step->alarm))
			return false;
	}
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].kind == STEP_MACRO &&
		    (entry_of(sfc, i) == sfc->step_count ||
		     exit_of(sfc, i) == sfc->step_count)) {
			walker->why = "a macro-step without a way in or out";
			return false;
		}
	return true;
}

static bool make_controls(struct walker *walker, struct played_sfc *played)
{
	for (int i = 0; i < CONTROL_COUNT; i++)
		if (!place(walker, played->walked->frame, played->sfc->control[i],
			   &played->control[i]))
			return false;
	return true;
}

static int rank(const struct sfc_transition *transition)
{
	return transition->priority ? transition->priority : INT_MAX;
}

/* Whether @a comes before @b. */
static bool is_before(const struct sfc *sfc, int a, int b)
{
	int high = rank(&sfc->transition[a]), low = rank(&sfc->transition[b]);

	return high < low || (high == low && a < b);
}

/* The rank of each: the number of those before it. */
static void make_order(struct played_sfc *played)
{
	const struct sfc *sfc = played->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		int before = 0;

		for (int k = 0; k < sfc->transition_count; k++)
			before += is_before(sfc, k, i);
		played->order[before] = i;
	}
}

struct played_sfc *sfc_new(struct walker *walker, struct walked_pou *walked)
{
	struct played_sfc *played = arena_alloc(&walker->arena, sizeof(*played));
	const struct sfc *sfc = walked->pou->sfc;
	size_t transitions = (size_t)sfc->transition_count + 1;

	if (!played)
		return NULL;
	played->sfc = sfc;
	played->walked = walked;
	played->step = arena_alloc(&walker->arena, ((size_t)sfc->step_count + 1) *
				   sizeof(*played->step));
	played->order = arena_alloc(&walker->arena, transitions * sizeof(*played->order));
	if (!played->step || !played->order ||
	    !make_steps(walker, played) || !make_controls(walker, played) ||
	    !lines_make(walker, played))
		return NULL;
	make_order(played);
	return played;
}

const struct sfc_body *rung_body(const struct sfc *sfc, int rung)
{
	const struct sfc_body *body;

	for (int i = 0; i < sfc->transition_count + sfc->action_count; i++) {
		body = i < sfc->transition_count ? &sfc->transition[i].condition :
			&sfc->action[i - sfc->transition_count].body;
		if ((body->kind == BODY_RUNGS || body->kind == BODY_EXPRESSION) &&
		    rung >= body->first && rung < body->first + body->count)
			return body;
	}
	return NULL;
}

/* ---- one evolution ---- */

static bool read_bool(struct walker *walker, const struct placed *at)
{
	struct placed here;

	return at->kind != PLACED_NOWHERE && placed_find(walker, at, &here) &&
	       value_is_true(placed_read(&here, IEC_BOOL));
}

static void write_bool(struct walker *walker, const struct placed *at, bool value)
{
	struct placed here;

	if (at->kind != PLACED_NOWHERE && placed_find(walker, at, &here))
		placed_write(&here, value_bool(value));
}

int64_t sfc_time(const struct placed *at)
{
	return placed_read(at, IEC_TIME).i;
}

static void activate(struct played_sfc *played, int step)
{
	*played->step[step].x = value_bool(true);
	played->step[step].t->i = 0;
	played->step[step].entered = true;
	played->step[step].begins = true;
}

/* The conditions behind the step are no longer evaluated, and have no power to compare.
 * The last step of a macro-step includes the conditions behind the macro-step. Depth:
 * macro-steps. */
static void forget_power(struct played_sfc *played, int step)
{
	const struct sfc *sfc = played->sfc;
	int macro = sfc->step[step].macro;

	if (macro >= 0 && exit_of(sfc, macro) == step)
		forget_power(played, macro);
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *at = &sfc->transition[i];
		const struct sfc_body *body = &at->condition;

		for (int k = 0; k < at->from_count; k++)
			if (sfc->ref[at->first_from + k].step == step &&
			    body->kind != BODY_LIST && body->kind != BODY_NONE)
				played->walked->rung[body->first].scan = 0;
	}
}

static void deactivate(struct played_sfc *played, int step)
{
	*played->step[step].x = value_bool(false);
	played->step[step].left = true;
	forget_power(played, step);
}

static void do_list(struct walker *walker, struct played_sfc *played, int step)
{
	if (played->step[step].begins)
		lines_once(walker, played, step);
	played->step[step].begins = false;
}

/* SET and RESET of the steps that just became active. */
static void do_lists(struct walker *walker, struct played_sfc *played)
{
	for (int i = 0; i < played->sfc->step_count; i++)
		do_list(walker, played, i);
}

static bool evaluate(struct walker *walker, struct played_sfc *played,
		     const struct sfc_body *body, bool *is_true)
{
	const struct sfc *sfc = played->sfc;
	int transition = sfc_condition(sfc, &played->walked->pou->vars);
	struct value *value = played->walked->frame->variable[transition].value;
	struct value result = value_bool(false);
	bool good;

	*value = value_bool(false);
	if (body->kind == BODY_LIST) {
		good = walk_list(walker, played->walked, body, &result);
		*is_true = value_is_true(result);
		return good;
	}
	good = walk_rungs(walker, played->walked, body->first, body->count);
	*is_true = value_is_true(*value);
	return good;
}

/* The values of the controls in this scan. */
struct orders {
	bool reset, held_reset, hold, semi, manual, tip;
	int force; /* number of a step, from 0; -1: none                      */
};

/* Whether all its steps are active, and no earlier transition takes one. */
static bool is_enabled(const struct played_sfc *played, const struct sfc_transition *transition)
{
	for (int k = 0; k < transition->from_count; k++) {
		int step = played->sfc->ref[transition->first_from + k].step;

		if (!can_be_left(played, step) || !is_free(played, step))
			return false;
	}
	return true;
}

static bool may_fire(struct orders orders, bool is_true)
{
	if (orders.manual)
		return orders.tip;
	return is_true && (!orders.semi || orders.tip);
}

/* The first enabled transition takes its steps. */
static bool choose(struct walker *walker, struct played_sfc *played, struct orders orders,
		   bool *any)
{
	const struct sfc *sfc = played->sfc;

	for (int i = 0; i < sfc->step_count; i++)
		played->step[i].leaving = played->step[i].entering = false;
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *at = &sfc->transition[played->order[i]];
		bool is_true;

		if (!is_enabled(played, at))
			continue;
		if (!evaluate(walker, played, &at->condition, &is_true))
			return false;
		if (!may_fire(orders, is_true))
			continue;
		for (int k = 0; k < at->from_count; k++)
			mark_leaving(played, sfc->ref[at->first_from + k].step);
		for (int k = 0; k < at->to_count; k++)
			mark_entering(played, sfc->ref[at->first_to + k].step);
		*any = true;
	}
	return true;
}

static void fire(struct walker *walker, struct played_sfc *played)
{
	for (int i = 0; i < played->sfc->step_count; i++) {
		struct played_step *step = &played->step[i];

		if (!step->leaving || step->entering)
			continue;
		if (step->min.kind != PLACED_NOWHERE && step->t->i < sfc_time(&step->min))
			write_bool(walker, &step->alarm, true);
		deactivate(played, i);
	}
	for (int i = 0; i < played->sfc->step_count; i++)
		if (played->step[i].entering && !value_is_true(*played->step[i].x))
			activate(played, i);
	do_lists(walker, played);
}

/* ---- IN ORDER ---- */

static bool is_each_active(const struct played_sfc *played, const struct sfc_transition *at)
{
	for (int k = 0; k < at->from_count; k++)
		if (!can_be_left(played, played->sfc->ref[at->first_from + k].step))
			return false;
	return true;
}

static void fire_at_once(struct walker *walker, struct played_sfc *played,
			 const struct sfc_transition *at)
{
	const struct sfc *sfc = played->sfc;

	for (int i = 0; i < sfc->step_count; i++)
		played->step[i].leaving = played->step[i].entering = false;
	for (int k = 0; k < at->from_count; k++)
		mark_leaving(played, sfc->ref[at->first_from + k].step);
	for (int k = 0; k < at->to_count; k++)
		mark_entering(played, sfc->ref[at->first_to + k].step);
	for (int i = 0; i < sfc->step_count; i++) {
		struct played_step *step = &played->step[i];

		if (!step->leaving)
			continue;
		if (step->min.kind != PLACED_NOWHERE && step->t->i < sfc_time(&step->min))
			write_bool(walker, &step->alarm, true);
		deactivate(played, i);
	}
	for (int i = 0; i < sfc->step_count; i++) {
		if (played->step[i].entering && !value_is_true(*played->step[i].x))
			activate(played, i);
		do_list(walker, played, i);
	}
}

/* One transition after another, each at once, until a round fires none. */
static bool evolve_in_order(struct walker *walker, struct played_sfc *played, struct orders orders)
{
	bool any = true;

	for (int round = 0; any && round < ROUNDS_MAX; round++) {
		any = false;
		for (int i = 0; i < played->sfc->transition_count; i++) {
			const struct sfc_transition *at =
				&played->sfc->transition[played->order[i]];
			bool is_true;

			if (!is_each_active(played, at))
				continue;
			if (!evaluate(walker, played, &at->condition, &is_true))
				return false;
			if (!may_fire(orders, is_true))
				continue;
			fire_at_once(walker, played, at);
			orders.tip = false;
			any = true;
		}
	}
	return true;
}

/* ---- a scan ---- */

static bool rises(struct played_sfc *played, enum control which, bool now)
{
	return block_rises(now, &played->was[which]);
}

static struct orders read_orders(struct walker *walker, struct played_sfc *played)
{
	const struct placed *from = played->control;
	struct orders orders = { .force = -1 };
	int64_t number = 0;

	orders.held_reset = read_bool(walker, &from[CONTROL_RESET]);
	orders.reset = rises(played, CONTROL_RESET, orders.held_reset);
	orders.hold = read_bool(walker, &from[CONTROL_HOLD]);
	orders.semi = read_bool(walker, &from[CONTROL_SEMI]);
	orders.manual = read_bool(walker, &from[CONTROL_MANUAL]);
	orders.tip = rises(played, CONTROL_TIP, read_bool(walker, &from[CONTROL_TIP]));
	if (from[CONTROL_FORCE].kind != PLACED_NOWHERE)
		number = placed_read(&from[CONTROL_FORCE], IEC_NONE).i;
	if (number != played->force && played->started && !orders.held_reset &&
	    number >= 1 && number <= played->sfc->step_count)
		orders.force = (int)number - 1;
	played->force = number;
	return orders;
}

/* Deactivates all steps; marked ones are activated anew. */
static void begin_anew(struct walker *walker, struct played_sfc *played)
{
	for (int i = 0; i < played->sfc->step_count; i++)
		if (value_is_true(*played->step[i].x))
			deactivate(played, i);
	for (int i = 0; i < played->sfc->step_count; i++)
		if (played->step[i].entering)
			activate(played, i);
	do_lists(walker, played);
}

static void begin_initial(struct walker *walker, struct played_sfc *played)
{
	for (int i = 0; i < played->sfc->step_count; i++)
		played->step[i].entering = played->sfc->step[i].macro < 0 &&
			played->sfc->step[i].kind == STEP_INITIAL;
	begin_anew(walker, played);
}

static void force(struct walker *walker, struct played_sfc *played, int step)
{
	const struct sfc *sfc = played->sfc;

	for (int i = 0; i < sfc->step_count; i++)
		played->step[i].entering = false;
	mark_entering(played, step);
	for (int at = sfc->step[step].macro; at >= 0; at = sfc->step[at].macro)
		played->step[at].entering = true;
	begin_anew(walker, played);
}

/* Times and supervision. */
static void pass_time(struct walker *walker, struct played_sfc *played, bool hold)
{
	int64_t passed = hold ? 0 : walker->now_ns - played->before_ns;

	for (int i = 0; i < played->sfc->step_count; i++) {
		struct played_step *step = &played->step[i];

		if (!value_is_true(*step->x))
			continue;
		step->t->i += passed;
		if (step->max.kind != PLACED_NOWHERE && step->t->i > sfc_time(&step->max))
			write_bool(walker, &step->alarm, true);
	}
	lines_pass_time(played, passed);
}

/* With UNTIL STABLE evolutions repeat until nothing fires; one TIP allows one
 * evolution. */
static bool evolve(struct walker *walker, struct played_sfc *played, struct orders orders)
{
	bool any = true;

	if (played->sfc->evolution == EVOLVE_IN_ORDER)
		return evolve_in_order(walker, played, orders);
	for (int count = 0; any; count++) {
		any = false;
		if (count == EVOLUTIONS_MAX || !choose(walker, played, orders, &any))
			return false;
		if (any)
			fire(walker, played);
		if (!sfc_goes_round(played->sfc))
			return true;
		orders.tip = false;
	}
	return true;
}

static bool is_uncontrolled(const struct sfc *sfc)
{
	for (int i = 0; i < CONTROL_COUNT; i++)
		if (sfc->control[i])
			return false;
	return true;
}

bool sfc_walk(struct walker *walker, struct played_sfc *played)
{
	struct orders orders = read_orders(walker, played);
	bool good = true;

	for (int i = 0; i < played->sfc->step_count; i++)
		played->step[i].entered = played->step[i].left = false;
	if (!played->started) {
		begin_initial(walker, played);
		if (sfc_goes_round(played->sfc) && is_uncontrolled(played->sfc))
			good = evolve(walker, played, orders);
	} else {
		pass_time(walker, played, orders.hold);
		if (orders.reset) {
			lines_forget(played);
			begin_initial(walker, played);
		} else if (orders.force >= 0) {
			force(walker, played, orders.force);
		} else if (!orders.held_reset && !orders.hold) {
			good = evolve(walker, played, orders);
		}
	}
	played->started = true;
	played->before_ns = walker->now_ns;
	return good && lines_act(walker, played);
}
