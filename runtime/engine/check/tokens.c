/* SPDX-License-Identifier: MIT
 *
 * tokens - the net of a chart, what can never fire, and what could be reached at most.
 */
#include "engine/check/tokens.h"

#include "engine/base/limits.h"

#include <string.h>

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

static bool is_within(const struct sfc_steps *some, const struct sfc_steps *all)
{
	for (int i = 0; i < some->count; i++)
		if (!sfc_steps_has(all, some->step[i]))
			return false;
	return true;
}

/* Is there an arc before this one that needs no more steps and whose condition is always TRUE?
 * Whenever this arc is enabled, so is that one, and it fires first. IN ORDER, an arc between
 * the two may bring the steps back. */
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

#define BLOCK 256 /* states of one block                                       */
#define WORD(step) ((step) / 64)
#define BIT(step) (UINT64_C(1) << ((step) % 64))

/* ---- states ---- */

const uint64_t *tokens_state(const struct tokens *t, int state)
{
	const struct token_states *s = &t->states;

	return s->block[state / BLOCK] + (size_t)(state % BLOCK) * (size_t)s->words;
}

static bool begin_states(struct tokens *t)
{
	struct token_states *s = &t->states;
	const size_t bytes = (size_t)(t->sfc->step_count / 64 + 1) * sizeof(uint64_t);

	s->words = (int)(bytes / sizeof(uint64_t));
	s->most = LIMIT_MARKINGS_BYTES / bytes < LIMIT_MARKINGS ?
		  (int)(LIMIT_MARKINGS_BYTES / bytes) : LIMIT_MARKINGS;
	s->mask = 1;
	while (s->mask < 2u * (uint32_t)s->most)
		s->mask *= 2;
	s->slot = arena_alloc(t->arena, s->mask-- * sizeof(*s->slot));
	s->before = arena_alloc(t->arena, ((size_t)s->most + 1) * sizeof(int));
	s->block = arena_alloc(t->arena, ((size_t)s->most / BLOCK + 2) *
			       sizeof(*s->block));
	return s->slot && s->before && s->block;
}

static uint32_t hash_of(const uint64_t *bits, int words)
{
	uint64_t hash = 0;

	for (int i = 0; i < words; i++)
		hash = (hash ^ bits[i]) * UINT64_C(0x9e3779b97f4a7c15);
	return (uint32_t)(hash >> 32);
}

/* Where it stands in the hash, or the free slot. */
static uint32_t *slot_of(const struct tokens *t, const uint64_t *bits)
{
	const struct token_states *s = &t->states;
	const size_t bytes = (size_t)s->words * sizeof(uint64_t);
	uint32_t at = hash_of(bits, s->words) & s->mask;

	while (s->slot[at] &&
	       memcmp(tokens_state(t, (int)s->slot[at] - 1), bits, bytes) != 0)
		at = (at + 1) & s->mask;
	return &s->slot[at];
}

/* Adds a state unless it is known. False: no memory. */
static bool add_state(struct tokens *t, const uint64_t *bits, int before)
{
	struct token_states *s = &t->states;
	uint32_t *slot = slot_of(t, bits);
	const size_t bytes = (size_t)s->words * sizeof(uint64_t);
	uint64_t **block = &s->block[s->count / BLOCK];

	if (*slot)
		return true;
	if (s->count == s->most) {
		t->gave_up = true;
		return true;
	}
	if (!*block)
		*block = arena_alloc(t->arena, BLOCK * bytes);
	if (!*block)
		return false;
	memcpy(*block + (size_t)(s->count % BLOCK) * (size_t)s->words, bits, bytes);
	s->before[s->count] = before;
	*slot = (uint32_t)++s->count;
	return true;
}

/* ---- findings ---- */

/* Keeps the first finding of a kind at a step or arc: its way is a shortest one. */
static bool add_find(struct tokens *t, struct token_find find)
{
	struct token_find *slot;

	for (int i = 0; i < t->find_count; i++)
		if (t->find[i].kind == find.kind && t->find[i].step == find.step)
			return true;
	slot = arena_push(t->arena, &t->find, &t->find_count, sizeof(*slot));
	if (slot)
		*slot = find;
	return slot;
}

static bool is_enabled(const struct sfc_arc *arc, const uint64_t *bits)
{
	for (int i = 0; i < arc->from.count; i++)
		if (!(bits[WORD(arc->from.step[i])] & BIT(arc->from.step[i])))
			return false;
	return true;
}

static bool is_inside(const struct sfc *sfc, int step, int macro)
{
	for (step = sfc->step[step].macro; step >= 0; step = sfc->step[step].macro)
		if (step == macro)
			return true;
	return false;
}

/* Is something in @macro active? */
static bool is_filled(const struct tokens *t, const uint64_t *bits, int macro)
{
	for (int i = 0; i < t->sfc->step_count; i++)
		if (bits[WORD(i)] & BIT(i) && is_inside(t->sfc, i, macro))
			return true;
	return false;
}

/* A macro-step that was left should be empty. */
static bool look_behind(struct tokens *t, int arc, const uint64_t *after, int state)
{
	const struct sfc_steps *from = &t->net.arc[arc].from;

	for (int i = 0; i < from->count; i++) {
		const int step = from->step[i];

		if (t->sfc->step[step].kind == STEP_MACRO &&
		    !(after[WORD(step)] & BIT(step)) && is_filled(t, after, step) &&
		    !add_find(t, (struct token_find){ TOKEN_LEFT, step, arc, state }))
			return false;
	}
	return true;
}

/* @after: what arc number @arc makes of @state. */
static bool fire(struct tokens *t, int arc, int state, uint64_t *after)
{
	const struct sfc_arc *a = &t->net.arc[arc];

	memcpy(after, tokens_state(t, state), (size_t)t->states.words * sizeof(*after));
	for (int i = 0; i < a->from.count; i++)
		after[WORD(a->from.step[i])] &= ~BIT(a->from.step[i]);
	for (int i = 0; i < a->to.count; i++) {
		const int step = a->to.step[i];

		if (after[WORD(step)] & BIT(step) &&
		    !add_find(t, (struct token_find){ TOKEN_TWICE, step, arc, state }))
			return false;
		after[WORD(step)] |= BIT(step);
		t->reached[step] = 1;
	}
	return look_behind(t, arc, after, state) && add_state(t, after, state);
}

/* No transition can fire in @state: notes the waiting steps. */
static bool add_dead(struct tokens *t, int state)
{
	const uint64_t *bits = tokens_state(t, state);

	for (int i = 0; i < t->sfc->step_count; i++)
		if (bits[WORD(i)] & BIT(i) && t->first[i] < t->first[i + 1] &&
		    t->sfc->step[i].kind != STEP_MACRO)
			return add_find(t, (struct token_find){ TOKEN_DEAD, i, -1, state });
	return true; /* all of it is at its end */
}

/* All states that follow. */
static bool look_at(struct tokens *t, int state, uint64_t *after)
{
	const uint64_t *bits = tokens_state(t, state);
	bool alive = false;

	for (int step = 0; step < t->sfc->step_count; step++) {
		if (!bits[WORD(step)]) {
			step |= 63;
			continue;
		}
		if (!(bits[WORD(step)] & BIT(step)))
			continue;
		for (int i = t->first[step]; i < t->first[step + 1]; i++) {
			const int arc = t->leaving[i];
			const struct sfc_arc *a = &t->net.arc[arc];

			if (a->from.step[0] != step || t->never[arc] ||
			    !is_enabled(a, bits))
				continue;
			alive = true;
			t->fires[arc] = 1;
			if (!fire(t, arc, state, after))
				return false;
		}
	}
	return alive || add_dead(t, state);
}

bool tokens_walk(struct tokens *t)
{
	uint64_t *after;

	memset(t->fires, 0, (size_t)t->net.arc_count);
	memset(t->reached, 0, (size_t)t->sfc->step_count);
	if (!begin_states(t))
		return false;
	after = arena_alloc(t->arena, (size_t)t->states.words * sizeof(*after));
	if (!after)
		return false;
	for (int i = 0; i < t->net.initial.count; i++) {
		const int step = t->net.initial.step[i];

		after[WORD(step)] |= BIT(step);
		t->reached[step] = 1;
	}
	if (!add_state(t, after, -1))
		return false;
	for (int i = 0; i < t->states.count; i++)
		if (!look_at(t, i, after))
			return false;
	return true;
}

/* A branch of a parting; place 0 is the chart itself. */
struct spot {
	int parent;       /* the place where the way parted                    */
	int parting;
	int waits;        /* the step in it that only a join leaves; -1: none  */
	int waiting;      /* other steps that only a join leaves               */
	int stamp;
};

struct prover {
	struct tokens *t;
	struct spot *place;
	int places;
	int *branches;    /* by parting: how many                              */
	int *first;       /* by parting: its first place                       */
	int partings;
	int *of;          /* by step: its place; -1: none yet                  */
	int *missing;     /* by arc: steps it leaves that have no place        */
	int *queue, queued;
	int *list;        /* places that are being joined                      */
	int stamp;
	bool good, failed;
};

static bool is_macro(const struct prover *p, int step)
{
	return p->t->sfc->step[step].kind == STEP_MACRO;
}

/* Steps but for macro-steps, which stand where what is in them does. */
static int count_plain(const struct prover *p, const struct sfc_steps *steps)
{
	int count = 0;

	for (int i = 0; i < steps->count; i++)
		count += !is_macro(p, steps->step[i]);
	return count;
}

/* ---- places ---- */

static bool add_parting(struct prover *p, int parent, int branches)
{
	int *count = arena_push(p->t->arena, &p->branches, &p->partings, sizeof(int));
	int firsts = p->partings - 1;
	int *first = arena_push(p->t->arena, &p->first, &firsts, sizeof(int));

	if (!count || !first)
		return false;
	*count = branches;
	*first = p->places;
	for (int i = 0; i < branches; i++) {
		struct spot *place = arena_push(p->t->arena, &p->place, &p->places,
						 sizeof(*place));

		if (!place)
			return false;
		*place = (struct spot){ parent, p->partings - 1, -1, 0, 0 };
	}
	return true;
}

/* The place whose branches the places of p->list are, all of them and each once;
 * -1: they are not. The last parting is joined first: its places have the highest
 * numbers. */
static int join(struct prover *p, int count)
{
	while (count > 1) {
		int last = 0, kept = 0, joined = 0, parting;

		for (int i = 0; i < count; i++)
			last = p->list[i] > last ? p->list[i] : last;
		parting = p->place[last].parting;
		p->stamp++;
		for (int i = 0; i < count; i++) {
			struct spot *place = &p->place[p->list[i]];

			if (p->list[i] == 0 || place->parting != parting) {
				p->list[kept++] = p->list[i];
				continue;
			}
			joined += place->stamp != p->stamp;
			place->stamp = p->stamp;
		}
		if (last == 0 || joined != p->branches[parting] ||
		    joined != count - kept)
			return -1;
		p->list[kept++] = p->place[last].parent;
		count = kept;
	}
	return p->list[0];
}

/* The place that these steps make up together; -1: they make up none. */
static int place_of(struct prover *p, const struct sfc_steps *steps)
{
	int count = 0;

	for (int i = 0; i < steps->count; i++) {
		if (is_macro(p, steps->step[i]))
			continue;
		if (p->of[steps->step[i]] < 0)
			return -1;
		p->list[count++] = p->of[steps->step[i]];
	}
	return count ? join(p, count) : -1;
}

static bool have_places(const struct prover *p, const struct sfc_steps *steps)
{
	for (int i = 0; i < steps->count; i++)
		if (!is_macro(p, steps->step[i]) && p->of[steps->step[i]] < 0)
			return false;
	return true;
}

static void put(struct prover *p, int step, int place)
{
	p->of[step] = place;
	p->queue[p->queued++] = step;
}

/* The steps are entered together, at @parent. False: their branches do not allow it. */
static bool enter(struct prover *p, const struct sfc_steps *steps, int parent)
{
	const int count = count_plain(p, steps);
	int place = parent;

	if (have_places(p, steps))
		return place_of(p, steps) == parent;
	if (count > 1) {
		place = p->places;
		if (!add_parting(p, parent, count)) {
			p->failed = true;
			return false;
		}
	}
	for (int i = 0; i < steps->count; i++) {
		if (is_macro(p, steps->step[i]))
			continue;
		if (p->of[steps->step[i]] >= 0)
			return false;
		put(p, steps->step[i], place);
		place += count > 1;
	}
	return true;
}

static void follow(struct prover *p, int arc)
{
	const struct sfc_arc *a = &p->t->net.arc[arc];
	const int parent = place_of(p, &a->from);

	p->t->fires[arc] = 1;
	if (parent >= 0 && enter(p, &a->to, parent))
		return;
	p->t->strange[arc] = 1;
	p->good = false;
}

static void spread(struct prover *p)
{
	struct tokens *t = p->t;

	p->good = enter(p, &t->net.initial, 0);
	for (int done = 0; done < p->queued; done++) {
		const int step = p->queue[done];

		for (int i = t->first[step]; i < t->first[step + 1]; i++) {
			const int arc = t->leaving[i];

			if (!t->never[arc] && --p->missing[arc] == 0)
				follow(p, arc);
		}
	}
}

/* ---- macro-steps ---- */

/* The entry and the exit of a macro-step must belong to the same place. */
static void check_macros(struct prover *p)
{
	const struct sfc *sfc = p->t->sfc;

	for (int i = 0; i < sfc->step_count; i++) {
		int end = i;

		if (sfc->step[i].kind != STEP_MACRO)
			continue;
		while (end >= 0 && sfc->step[end].kind == STEP_MACRO)
			end = sfc_exit(sfc, end);
		if (end >= 0 && p->of[end] >= 0 && p->of[end] != p->of[sfc_entry(sfc, i)])
			p->good = false;
	}
}

/* ---- joins ---- */

/* Does nothing but a join leave it? */
static bool only_joins(const struct prover *p, int step)
{
	const struct tokens *t = p->t;

	for (int i = t->first[step]; i < t->first[step + 1]; i++)
		if (!t->never[t->leaving[i]] &&
		    count_plain(p, &t->net.arc[t->leaving[i]].from) == 1)
			return false;
	return true;
}

/* A step of the chart itself may be its end. */
static bool has_ways(const struct tokens *t, int step)
{
	return t->first[step] < t->first[step + 1];
}

static void find_waiting(struct prover *p)
{
	for (int i = 0; i < p->t->sfc->step_count; i++) {
		struct spot *place;

		if (p->of[i] < 0 || !only_joins(p, i))
			continue;
		place = &p->place[p->of[i]];
		place->waits = i;
		if (p->of[i] ? place->waiting++ > 0 : has_ways(p->t, i))
			p->good = false;
	}
}

/* Is there an arc that leaves exactly the steps in which the branches of the parting wait? */
static bool is_joined(struct prover *p, int parting)
{
	const struct tokens *t = p->t;
	const int first = p->first[parting], count = p->branches[parting];
	int step;

	for (int i = 0; i < count; i++)
		if (p->place[first + i].waits < 0)
			return true; /* this branch goes on for ever */
	step = p->place[first].waits;
	for (int i = t->first[step]; i < t->first[step + 1]; i++) {
		const struct sfc_steps *from = &t->net.arc[t->leaving[i]].from;
		int found = 0;

		if (t->never[t->leaving[i]])
			continue;
		for (int k = 0; k < from->count; k++) {
			const int place = p->of[from->step[k]];

			if (is_macro(p, from->step[k]))
				continue;
			found += place >= first && place < first + count &&
				 p->place[place].waits == from->step[k];
		}
		if (found == count && count_plain(p, from) == count)
			return true;
	}
	return false;
}

static void check_joins(struct prover *p)
{
	find_waiting(p);
	for (int i = 0; p->good && i < p->partings; i++)
		p->good = is_joined(p, i);
}

/* ---- all of it ---- */

static bool begin(struct prover *p, struct tokens *t)
{
	const size_t steps = (size_t)t->sfc->step_count + 1;
	const size_t arcs = (size_t)t->net.arc_count + 1;
	struct spot *root;

	*p = (struct prover){ .t = t };
	root = arena_push(t->arena, &p->place, &p->places, sizeof(*root));
	p->of = arena_alloc(t->arena, steps * sizeof(int));
	p->queue = arena_alloc(t->arena, steps * sizeof(int));
	p->list = arena_alloc(t->arena, steps * sizeof(int));
	p->missing = arena_alloc(t->arena, arcs * sizeof(int));
	if (!root || !p->of || !p->queue || !p->list || !p->missing)
		return false;
	*root = (struct spot){ -1, -1, -1, 0, 0 };
	for (int i = 0; i < t->sfc->step_count; i++)
		p->of[i] = -1;
	for (int i = 0; i < t->net.arc_count; i++)
		p->missing[i] = count_plain(p, &t->net.arc[i].from);
	return true;
}

/* A macro-step is reached with its first step. */
static void tell(struct prover *p)
{
	const struct sfc *sfc = p->t->sfc;

	for (int i = 0; i < sfc->step_count; i++) {
		p->t->reached[i] = p->of[i] >= 0;
		for (int at = sfc->step[i].macro; p->of[i] >= 0 && at >= 0;
		     at = sfc->step[at].macro)
			p->t->reached[at] = 1;
	}
}

bool tokens_prove(struct tokens *t)
{
	struct prover p;

	if (!begin(&p, t))
		return false;
	spread(&p);
	check_macros(&p);
	check_joins(&p);
	if (!p.good || p.failed)
		return false;
	tell(&p);
	return true;
}
