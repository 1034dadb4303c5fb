/* SPDX-License-Identifier: MIT
 *
 * tokens - the net of a chart, what can never fire, and what could be reached at most.
 */
#include "engine/check/tokens.h"

/* ---- arcs by step ---- */

static bool index_arcs(struct tokens *t)
{
	const struct sfc_net *net = &t->net;
	const int steps = t->sfc->step_count;
	int total = 0, *next;

	t->first = arena_alloc(t->arena, ((size_t)steps + 2) * sizeof(int));
	next = arena_alloc(t->arena, ((size_t)steps + 1) * sizeof(int));
	if (!t->first || !next)
		return false;
	for (int i = 0; i < net->arc_count; i++)
		for (int k = 0; k < net->arc[i].from.count; k++, total++)
			t->first[net->arc[i].from.step[k] + 1]++;
	for (int i = 0; i < steps; i++)
		next[i] = t->first[i + 1] += t->first[i];
	t->leaving = arena_alloc(t->arena, ((size_t)total + 1) * sizeof(int));
	if (!t->leaving)
		return false;
	for (int i = net->arc_count - 1; i >= 0; i--)
		for (int k = 0; k < net->arc[i].from.count; k++)
			t->leaving[--next[net->arc[i].from.step[k]]] = i;
	return true;
}

/* ---- what never fires ---- */

static bool has(const struct sfc_steps *steps, int step)
{
	for (int i = 0; i < steps->count; i++)
		if (steps->step[i] == step)
			return true;
	return false;
}

static bool is_within(const struct sfc_steps *some, const struct sfc_steps *all)
{
	for (int i = 0; i < some->count; i++)
		if (!has(all, some->step[i]))
			return false;
	return true;
}

/* An arc before it wants no more than it does and is always true: whenever this one is
 * enabled, that one is, and if that one is kept from its steps so is this one. IN ORDER one
 * between them may bring the steps back. */
static bool is_behind(const struct tokens *t, int arc, const uint8_t *always)
{
	const struct sfc_steps *from = &t->net.arc[arc].from;

	for (int k = 0; k < from->count; k++) {
		const int step = from->step[k];

		for (int i = t->first[step]; t->leaving[i] < arc; i++) {
			const struct sfc_arc *other = &t->net.arc[t->leaving[i]];

			if (always[other->transition] == 1 &&
			    other->from.step[0] == step &&
			    is_within(&other->from, from))
				return true;
		}
	}
	return false;
}

bool tokens_begin(struct tokens *t, const struct sfc *sfc, const uint8_t *always,
		  struct arena *arena)
{
	const size_t steps = (size_t)sfc->step_count + 1;
	const bool manual = sfc->control[CONTROL_MANUAL];
	size_t arcs;

	*t = (struct tokens){ .sfc = sfc, .arena = arena };
	if (!sfc_net_make(sfc, arena, &t->net) || !index_arcs(t))
		return false;
	arcs = (size_t)t->net.arc_count + 1;
	t->never = arena_alloc(arena, arcs);
	t->fires = arena_alloc(arena, arcs);
	t->strange = arena_alloc(arena, arcs);
	t->reached = arena_alloc(arena, steps);
	if (!t->never || !t->fires || !t->strange || !t->reached)
		return false;
	for (int i = 0; i < t->net.arc_count; i++)
		t->never[i] = !t->net.arc[i].from.count ||
			      (always[t->net.arc[i].transition] == 2 && !manual) ||
			      (sfc->evolution != EVOLVE_IN_ORDER && is_behind(t, i, always));
	return true;
}

/* ---- what could be reached ---- */

/* Steps whose arcs have to be looked at again, each once. */
struct bound {
	struct tokens *t;
	int *missing;     /* by arc: steps it leaves that were not reached      */
	int *queue, count;
};

static void reach(struct bound *b, const struct sfc_steps *steps)
{
	for (int i = 0; i < steps->count; i++) {
		if (b->t->reached[steps->step[i]])
			continue;
		b->t->reached[steps->step[i]] = 1;
		b->queue[b->count++] = steps->step[i];
	}
}

bool tokens_bound(struct tokens *t)
{
	const int steps = t->sfc->step_count, arcs = t->net.arc_count;
	struct bound b = { .t = t };

	b.missing = arena_alloc(t->arena, ((size_t)arcs + 1) * sizeof(int));
	b.queue = arena_alloc(t->arena, ((size_t)steps + 1) * sizeof(int));
	if (!b.missing || !b.queue)
		return false;
	for (int i = 0; i < steps; i++)
		t->reached[i] = 0;
	for (int i = 0; i < arcs; i++) {
		t->fires[i] = 0;
		b.missing[i] = t->net.arc[i].from.count;
	}
	reach(&b, &t->net.initial);
	for (int done = 0; done < b.count; done++) {
		const int step = b.queue[done];

		for (int i = t->first[step]; i < t->first[step + 1]; i++) {
			const int arc = t->leaving[i];

			if (t->never[arc] || --b.missing[arc])
				continue;
			t->fires[arc] = 1;
			reach(&b, &t->net.arc[arc].to);
		}
	}
	return true;
}
