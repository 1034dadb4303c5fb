/* SPDX-License-Identifier: MIT
 *
 * sfc_net - a chart as a net of steps and transitions.
 */
#include "engine/model/sfc_net.h"

#include <limits.h>

bool sfc_steps_has(const struct sfc_steps *steps, int step)
{
	for (int i = 0; i < steps->count; i++)
		if (steps->step[i] == step)
			return true;
	return false;
}

int sfc_entry(const struct sfc *sfc, int macro)
{
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].macro == macro && sfc->step[i].kind == STEP_INITIAL)
			return i;
	return -1;
}

static bool is_left(const struct sfc *sfc, int step)
{
	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		for (int k = 0; k < t->from_count; k++)
			if (sfc->ref[t->first_from + k].step == step)
				return true;
	}
	return false;
}

int sfc_exit(const struct sfc *sfc, int macro)
{
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].macro == macro && !is_left(sfc, i))
			return i;
	return -1;
}

/* ---- steps ---- */

/* Room for all steps; each is in a list once. */
struct collector {
	const struct sfc *sfc;
	const int *entry, *exit; /* by macro-step                              */
	uint32_t *seen, stamp;
	struct arena *arena;
	bool failed;
};

static bool add(struct collector *c, struct sfc_steps *steps, int step)
{
	int *slot;

	if (step < 0 || c->seen[step] == c->stamp)
		return false;
	c->seen[step] = c->stamp;
	slot = arena_push(c->arena, &steps->step, &steps->count, sizeof(*slot));
	if (slot)
		*slot = step;
	c->failed |= !slot;
	return slot;
}

/* Adds @step and the steps that are active with it when it is entered or left. */
static void add_inside(struct collector *c, struct sfc_steps *steps, int step,
		       const int *inside)
{
	while (add(c, steps, step) && c->sfc->step[step].kind == STEP_MACRO)
		step = inside[step];
}

static void add_refs(struct collector *c, struct sfc_steps *steps, int first, int count,
		     const int *inside)
{
	c->stamp++;
	for (int i = 0; i < count; i++)
		add_inside(c, steps, c->sfc->ref[first + i].step, inside);
}

static bool begin(struct collector *c, const struct sfc *sfc, struct arena *arena)
{
	const size_t count = (size_t)sfc->step_count + 1;
	int *entry = arena_alloc(arena, count * sizeof(*entry));
	int *leave = arena_alloc(arena, count * sizeof(*leave));

	*c = (struct collector){ .sfc = sfc, .entry = entry, .exit = leave,
				 .arena = arena,
				 .seen = arena_alloc(arena, count * sizeof(*c->seen)) };
	if (!entry || !leave || !c->seen)
		return false;
	for (int i = 0; i < sfc->step_count; i++) {
		const bool macro = sfc->step[i].kind == STEP_MACRO;

		entry[i] = macro ? sfc_entry(sfc, i) : -1;
		leave[i] = macro ? sfc_exit(sfc, i) : -1;
	}
	return true;
}

/* ---- the net ---- */

static int rank(const struct sfc_transition *t)
{
	return t->priority > 0 ? t->priority : INT_MAX;
}

static void put_arcs(struct collector *c, struct sfc_net *net)
{
	const struct sfc *sfc = c->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];
		struct sfc_arc *arc = &net->arc[net->arc_count++];

		*arc = (struct sfc_arc){ .transition = i };
		add_refs(c, &arc->from, t->first_from, t->from_count, c->exit);
		add_refs(c, &arc->to, t->first_to, t->to_count, c->entry);
	}
}

/* Few transitions have a priority: moves these to the front, one by one. */
static void sort_arcs(const struct sfc *sfc, struct sfc_net *net)
{
	for (int i = 1; i < net->arc_count; i++) {
		const struct sfc_arc arc = net->arc[i];
		const int high = rank(&sfc->transition[arc.transition]);
		int k = i;

		while (k > 0 && rank(&sfc->transition[net->arc[k - 1].transition]) > high) {
			net->arc[k] = net->arc[k - 1];
			k--;
		}
		net->arc[k] = arc;
	}
}

bool sfc_net_make(const struct sfc *sfc, struct arena *arena, struct sfc_net *out)
{
	struct collector c;

	*out = (struct sfc_net){ .arc_count = 0 };
	out->arc = arena_alloc(arena, ((size_t)sfc->transition_count + 1) *
			       sizeof(*out->arc));
	if (!out->arc || !begin(&c, sfc, arena))
		return false;
	put_arcs(&c, out);
	sort_arcs(sfc, out);
	c.stamp++;
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].kind == STEP_INITIAL && sfc->step[i].macro < 0)
			add(&c, &out->initial, i);
	return !c.failed;
}

bool sfc_forced(const struct sfc *sfc, int step, struct arena *arena, struct sfc_steps *out)
{
	struct collector c;

	*out = (struct sfc_steps){ .count = 0 };
	if (!begin(&c, sfc, arena))
		return false;
	c.stamp++;
	add_inside(&c, out, step, c.entry);
	for (int i = sfc->step[step].macro; i >= 0; i = sfc->step[i].macro)
		add(&c, out, i);
	return !c.failed;
}
