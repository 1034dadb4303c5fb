/* SPDX-License-Identifier: MIT
 *
 * tokens_walk - the states of a chart one by one, nearest first.
 *
 * So the first way that is found to a state is a shortest one.
 */
#include "engine/check/tokens.h"

#include "engine/base/limits.h"

#include <string.h>

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

/* Unless it is known. False: no memory. */
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

/* ---- what is found ---- */

/* The first of a kind and step, or arc: a shortest way there. */
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

/* Nothing can fire: whoever waits for something waits in vain. */
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
