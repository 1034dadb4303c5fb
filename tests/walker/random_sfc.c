/* SPDX-License-Identifier: MIT
 *
 * random_sfc - steps and transitions of a random chart. Its text: random_sfc_print.c.
 */
#include "tests/walker/random_sfc.h"

#define DEEPEST 3      /* nested structures                                    */
#define MANY_STEPS 20  /* from here on there are only plain sequences          */

uint64_t sfc_key(uint64_t of, uint32_t number)
{
	uint64_t x = of + 0x9e3779b97f4a7c15u * (number + 1u);

	x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
	x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
	return x ^ (x >> 31);
}

struct random_source sfc_source(uint64_t key)
{
	struct random_source source;

	random_seed(&source, key);
	return source;
}

bool sfc_has(struct random_sfc *sfc, uint64_t key)
{
	for (int i = 0; i < sfc->dropped_count; i++)
		if (sfc->dropped[i] == key)
			return false;
	if (sfc->part_count < SFC_PARTS)
		sfc->part[sfc->part_count++] = key;
	return true;
}

static int new_step(struct random_sfc *sfc, int macro, uint64_t key)
{
	sfc->step[sfc->steps] = (struct random_step){ .key = key, .macro = macro };
	return sfc->steps++;
}

static struct random_arc *new_arc(struct random_sfc *sfc, int macro, uint64_t key)
{
	struct random_arc *arc = &sfc->arc[sfc->arcs++];

	*arc = (struct random_arc){ .key = key, .macro = macro };
	return arc;
}

static void connect(struct random_sfc *sfc, int from, int to, uint64_t key)
{
	struct random_arc *arc = new_arc(sfc, sfc->step[from].macro, key);

	arc->from[arc->from_count++] = from;
	arc->to[arc->to_count++] = to;
}

static int sequence(struct random_sfc *sfc, int from, int depth, uint64_t key);

/* Alternative branches, joined again. */
static int alternatives(struct random_sfc *sfc, int from, int depth, uint64_t key)
{
	struct random_source source = sfc_source(key);
	int macro = sfc->step[from].macro, ways = 2 + (int)random_below(&source, 2);
	int end[3] = { from, from, from }, after;

	for (int i = 0; i < ways; i++) {
		uint64_t way = sfc_key(key, 10u + (uint32_t)i);

		if (random_chance(&source, 25))
			continue;
		end[i] = new_step(sfc, macro, sfc_key(way, 1));
		connect(sfc, from, end[i], sfc_key(way, 2));
		end[i] = sequence(sfc, end[i], depth + 1, sfc_key(way, 3));
	}
	after = new_step(sfc, macro, sfc_key(key, 1));
	for (int i = 0; i < ways; i++)
		if (i == 0 || sfc_has(sfc, sfc_key(key, 20u + (uint32_t)i)) ||
		    end[i] != from)
			connect(sfc, end[i], after, sfc_key(key, 30u + (uint32_t)i));
	return after;
}

/* Simultaneous branches; sometimes with another split before the join. */
static int together(struct random_sfc *sfc, int from, int depth, uint64_t key)
{
	struct random_source source = sfc_source(key);
	int macro = sfc->step[from].macro, after;
	int end[3] = { from }, ends = 1;

	for (int round = 0; round < 2; round++) {
		int ways = 2 + (int)random_below(&source, 2);
		struct random_arc *arc = new_arc(sfc, macro,
						 sfc_key(key, 40u + (uint32_t)round));

		arc->from_count = ends;
		for (int i = 0; i < ends; i++)
			arc->from[i] = end[i];
		arc->to_count = ends = ways;
		for (int i = 0; i < ways; i++)
			arc->to[i] = end[i] = new_step(sfc, macro, sfc_key(key,
				50u + (uint32_t)(10 * round + i)));
		for (int i = 0; i < ways; i++)
			end[i] = sequence(sfc, end[i], depth + 1, sfc_key(key,
				70u + (uint32_t)(10 * round + i)));
		if (!random_chance(&source, 15))
			break;
	}
	after = new_step(sfc, macro, sfc_key(key, 1));
	new_arc(sfc, macro, sfc_key(key, 2));
	for (int i = 0; i < ends; i++)
		sfc->arc[sfc->arcs - 1].from[i] = end[i];
	sfc->arc[sfc->arcs - 1].from_count = ends;
	sfc->arc[sfc->arcs - 1].to[0] = after;
	sfc->arc[sfc->arcs - 1].to_count = 1;
	return after;
}

static int loop(struct random_sfc *sfc, int from, int depth, uint64_t key)
{
	int macro = sfc->step[from].macro;
	int first = new_step(sfc, macro, sfc_key(key, 1)), last, after;

	connect(sfc, from, first, sfc_key(key, 2));
	last = sequence(sfc, first, depth + 1, sfc_key(key, 3));
	after = new_step(sfc, macro, sfc_key(key, 4));
	connect(sfc, last, first, sfc_key(key, 5));
	connect(sfc, last, after, sfc_key(key, 6));
	return after;
}

static int macro_step(struct random_sfc *sfc, int from, int depth, uint64_t key)
{
	int macro = new_step(sfc, sfc->step[from].macro, sfc_key(key, 1));
	int first = new_step(sfc, macro, sfc_key(key, 2));

	sfc->step[macro].is_macro = true;
	sfc->step[first].initial = true;
	connect(sfc, from, macro, sfc_key(key, 3));
	sequence(sfc, first, depth + 1, sfc_key(key, 4));
	return macro;
}

static int plain(struct random_sfc *sfc, int from, uint64_t key)
{
	int next = new_step(sfc, sfc->step[from].macro, sfc_key(key, 1));

	connect(sfc, from, next, sfc_key(key, 2));
	return next;
}

/* From the step with the token to a new step without transitions. */
static int element(struct random_sfc *sfc, int from, int depth, uint64_t key)
{
	struct random_source source = sfc_source(sfc_key(key, 0));
	uint32_t kind = random_below(&source, 10);

	if (depth >= DEEPEST || sfc->steps > MANY_STEPS || kind < 4)
		return plain(sfc, from, key);
	if (kind < 6)
		return alternatives(sfc, from, depth, key);
	if (kind < 8)
		return together(sfc, from, depth, key);
	return kind == 8 ? loop(sfc, from, depth, key) :
			   macro_step(sfc, from, depth, key);
}

/* Depth: DEEPEST. */
static int sequence(struct random_sfc *sfc, int from, int depth, uint64_t key)
{
	struct random_source source = sfc_source(sfc_key(key, 0));
	int count = (int)random_below(&source, depth ? 3 : 5) + !depth, spine[8] = { from };
	int length = 1;

	for (int i = 0; i < count; i++) {
		uint64_t at = sfc_key(key, 1u + (uint32_t)i);

		if (!sfc_has(sfc, at))
			continue;
		from = element(sfc, from, depth, at);
		spine[length++] = from;
	}
	/* A jump back, and another way on. */
	if (length > 1 && random_chance(&source, 20) && sfc_has(sfc, sfc_key(key, 90))) {
		connect(sfc, from, spine[random_below(&source, (uint32_t)length)],
			sfc_key(key, 91));
		from = plain(sfc, from, sfc_key(key, 92));
	}
	return from;
}

static bool is_left(const struct random_sfc *sfc, int step)
{
	for (int i = 0; i < sfc->arcs; i++)
		for (int k = 0; k < sfc->arc[i].from_count; k++)
			if (sfc->arc[i].from[k] == step)
				return true;
	return false;
}

/* Another step of the same macro-step; @left: a step with a transition. -1: none. */
static int pick(const struct random_sfc *sfc, struct random_source *source, int macro,
		int not, bool left)
{
	for (int i = 0; i < 20; i++) {
		int step = (int)random_below(source, (uint32_t)sfc->steps);

		if (sfc->step[step].macro == macro && step != not &&
		    (!left || is_left(sfc, step)))
			return step;
	}
	return -1;
}

/* A transition between any two steps. */
static void make_unsafe(struct random_sfc *sfc, uint64_t key)
{
	struct random_source source = sfc_source(key);
	int from = pick(sfc, &source, sfc->step[random_below(&source,
			(uint32_t)sfc->steps)].macro, -1, true);
	int macro = from < 0 ? -1 : sfc->step[from].macro, more, to;
	struct random_arc arc = { .key = sfc_key(key, 1), .macro = macro };

	if (from < 0 || !sfc_has(sfc, key))
		return;
	arc.from[arc.from_count++] = from;
	more = random_chance(&source, 30) ? pick(sfc, &source, macro, from, true) : -1;
	if (more >= 0)
		arc.from[arc.from_count++] = more;
	to = pick(sfc, &source, macro, -1, false);
	if (to < 0)
		return;
	arc.to[arc.to_count++] = to;
	more = random_chance(&source, 40) ? pick(sfc, &source, macro, to, false) : -1;
	if (more >= 0)
		arc.to[arc.to_count++] = more;
	sfc->arc[sfc->arcs++] = arc;
}

void sfc_grow(struct random_sfc *sfc)
{
	uint64_t key = sfc_key(sfc->seed, 0);
	struct random_source source = sfc_source(key);
	int rings = random_chance(&source, 20) ? 2 : 1;

	sfc->unsafe = random_chance(&source, 12);
	sfc->steps = sfc->arcs = 0;
	for (int i = 0; i < rings; i++) {
		uint64_t ring = sfc_key(key, 1u + (uint32_t)i);
		int first, last;

		if (i > 0 && !sfc_has(sfc, ring))
			break;
		first = new_step(sfc, -1, sfc_key(ring, 1));
		sfc->step[first].initial = true;
		last = sequence(sfc, first, 0, sfc_key(ring, 2));
		connect(sfc, last, first, sfc_key(ring, 3));
	}
	for (uint32_t i = 0; sfc->unsafe && i < 1 + random_below(&source, 3); i++)
		make_unsafe(sfc, sfc_key(key, 10 + i));
}
