/* SPDX-License-Identifier: MIT
 *
 * tokens_prove - a chart whose branches come together as they parted.
 *
 * Each step gets a place: in which branch of which parting of the way it stands, inside
 * which others. If no step has two places, exactly one step is active for each branch
 * of each parting that is under way: no step is entered twice. If all branches of a
 * parting end in steps that one transition joins, there is no dead end. A chart that
 * this does not hold of may be good as well; its states are then looked at.
 */
#include "engine/check/tokens.h"

/* A branch of a parting; place 0 is the chart itself. */
struct spot {
	int parent;       /* the place where the way parted                    */
	int parting;
	int waits;        /* the step in it that only a join leaves; -1: none  */
	int waiting;      /* steps of that kind                                */
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

/* The place of what these steps are together; -1: they are nothing whole. */
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

/* The steps are entered together, at @parent. False: that cannot be. */
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

/* What is active when a macro-step is entered must be left with it. */
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

/* Of a parting: an arc from the steps in which its branches wait, and no others? */
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
