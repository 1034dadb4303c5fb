/* SPDX-License-Identifier: MIT
 *
 * sfc_graph - edges in the order of priorities, loops cut, dominators.
 */
#include "engine/show/sfc_graph.h"

#include <limits.h>
#include <stdlib.h>

/* What is needed while it is made. */
struct making {
	struct sfc_graph *graph;
	const struct sfc *sfc;
	struct arena *arena;
	int *group;        /* of a point: its root                             */
	int *stamp;        /* by step: the transition that named it last      */
	int *turn;         /* transitions by priority                         */
	int *start;        /* points that nothing leads to, as found           */
	int start_count;
	int *phase;        /* of a point: 0 not seen; later ones are greater   */
	int *at;           /* next edge of a point to be walked; -1: done      */
	int *stack;
	int done;          /* points finished                                  */
};

static int *integers(struct arena *arena, int count)
{
	return arena_alloc(arena, ((size_t)count + 1) * sizeof(int));
}

static int root_of(const struct sfc_graph *graph, int macro)
{
	const int main = graph->steps + graph->transitions;

	return macro >= 0 && macro < graph->steps ? main + 1 + macro : main;
}

/* ---- edges ---- */

struct turn { int priority, index; };

static int compare_turns(const void *a, const void *b)
{
	const struct turn *x = a, *y = b;

	if (x->priority != y->priority)
		return x->priority < y->priority ? -1 : 1;
	return x->index < y->index ? -1 : x->index > y->index;
}

static bool sort_transitions(struct making *making)
{
	const int count = making->graph->transitions;
	struct turn *turn = arena_alloc(making->arena, ((size_t)count + 1) *
					sizeof(*turn));

	if (!turn)
		return false;
	for (int i = 0; i < count; i++) {
		int priority = making->sfc->transition[i].priority;

		turn[i] = (struct turn){ priority > 0 ? priority : INT_MAX, i };
	}
	qsort(turn, (size_t)count, sizeof(*turn), compare_turns);
	for (int i = 0; i < count; i++)
		making->turn[i] = turn[i].index;
	return true;
}

static bool in_sfc(const struct making *making, int step, int transition)
{
	return step >= 0 && step < making->graph->steps &&
	       making->group[step] == making->group[making->graph->steps + transition];
}

static void put_edge(struct making *making, int point, int to, int ref, bool count)
{
	struct sfc_graph *graph = making->graph;

	if (count)
		graph->first[point + 1]++;
	else
		graph->edge[graph->first[point + 1]++] =
			(struct sfc_edge){ to, ref, to < 0 };
}

/* A name that stands twice in one list counts once. */
static bool is_again(const struct making *making, int step, int mark)
{
	if (step < 0 || step >= making->graph->steps)
		return false;
	if (making->stamp[step] == mark)
		return true;
	making->stamp[step] = mark;
	return false;
}

static void put_edges(struct making *making, bool count)
{
	const struct sfc *sfc = making->sfc;
	const int steps = making->graph->steps;

	for (int i = 0; i <= steps; i++)
		making->stamp[i] = -1;
	for (int k = 0; k < making->graph->transitions; k++) {
		const int t = making->turn[k];
		const struct sfc_transition *transition = &sfc->transition[t];

		for (int i = 0; i < transition->from_count; i++) {
			int ref = transition->first_from + i, step = sfc->ref[ref].step;

			if (in_sfc(making, step, t) &&
			    !is_again(making, step, 2 * t))
				put_edge(making, step, steps + t, ref, count);
		}
		for (int i = 0; i < transition->to_count; i++) {
			int ref = transition->first_to + i, step = sfc->ref[ref].step;

			if (!is_again(making, step, 2 * t + 1))
				put_edge(making, steps + t,
					 in_sfc(making, step, t) ? step : -1, ref,
					 count);
		}
	}
}

/* Counts go to first[n + 1]; summed up they are where a point's edges begin, and writing
 * an edge moves the one of its point on to where the next begins. */
static void sum_edges(int *first, int points)
{
	int sum = 0;

	for (int n = 1; n <= points; n++) {
		int count = first[n];

		first[n] = sum;
		sum += count;
	}
}

/* ---- loops ---- */

static void walk_from(struct making *making, int point, int phase)
{
	struct sfc_graph *graph = making->graph;
	int depth = 0;

	making->start[making->start_count++] = point;
	making->stack[depth++] = point;
	making->phase[point] = phase;
	making->at[point] = graph->first[point];
	while (depth > 0) {
		const int from = making->stack[depth - 1];

		if (making->at[from] == graph->first[from + 1]) {
			making->at[from] = -1;
			graph->order[making->done++] = from;
			depth--;
			continue;
		}
		struct sfc_edge *edge = &graph->edge[making->at[from]++];
		if (edge->far)
			continue;
		if (!making->phase[edge->to]) {
			making->phase[edge->to] = phase;
			making->at[edge->to] = graph->first[edge->to];
			making->stack[depth++] = edge->to;
		} else if (making->at[edge->to] >= 0 || making->phase[edge->to] < phase) {
			edge->far = true; /* up, or into what stands without it */
		}
	}
}

/* Initial steps first; then what nothing leads to; then loops that nothing leads to. */
static void walk(struct making *making)
{
	const struct sfc_graph *graph = making->graph;
	const int inner = graph->steps + graph->transitions;
	int phase = 1;

	for (int n = 0; n < graph->steps; n++)
		if (making->sfc->step[n].kind == STEP_INITIAL && !making->phase[n])
			walk_from(making, n, phase);
	for (int e = 0; e < graph->first[inner]; e++)
		if (graph->edge[e].to >= 0)
			graph->ways[graph->edge[e].to]++;
	for (int n = 0; n < inner; n++)
		if (!graph->ways[n] && !making->phase[n])
			walk_from(making, n, ++phase);
	for (int n = 0; n < inner; n++)
		if (!making->phase[n])
			walk_from(making, n, ++phase);
}

/* Roots lead to where the walks began. */
static void put_roots(struct making *making)
{
	struct sfc_graph *graph = making->graph;
	const int inner = graph->steps + graph->transitions;
	int *first = graph->first, sum = first[inner];

	for (int n = inner; n < graph->points; n++)
		first[n + 1] = 0;
	for (int i = 0; i < making->start_count; i++)
		first[making->group[making->start[i]] + 1]++;
	for (int n = inner; n < graph->points; n++) {
		int count = first[n + 1];

		first[n + 1] = sum;
		sum += count;
	}
	for (int i = 0; i < making->start_count; i++) {
		const int start = making->start[i], root = making->group[start];

		graph->edge[first[root + 1]++] = (struct sfc_edge){ start, -1, false };
	}
	for (int n = graph->points - 1; n >= inner; n--)
		graph->order[making->done++] = n;
	for (int a = 0, b = graph->points - 1; a < b; a++, b--) {
		int point = graph->order[a];

		graph->order[a] = graph->order[b];
		graph->order[b] = point;
	}
}

/* ---- dominators ---- */

/* Beside its parent, each point knows one far above it, so that two points meet in few
 * steps however deep they are. */
struct above { int depth, jump; };

static void hang(struct sfc_graph *graph, struct above *above, int point)
{
	const int parent = graph->dominator[point];

	if (parent < 0) {
		above[point] = (struct above){ 0, point };
		return;
	}
	const int far = above[parent].jump;
	const bool same = above[parent].depth - above[far].depth ==
			  above[far].depth - above[above[far].jump].depth;
	above[point] = (struct above){ above[parent].depth + 1,
				      same ? above[far].jump : parent };
}

static int meet(const struct sfc_graph *graph, const struct above *above, int a, int b)
{
	while (a != b) {
		if (above[a].depth < above[b].depth) {
			int other = a;

			a = b;
			b = other;
		}
		if (above[a].depth > above[b].depth)
			a = above[above[a].jump].depth >= above[b].depth ?
			    above[a].jump : graph->dominator[a];
		else if (above[a].jump != above[b].jump)
			a = above[a].jump, b = above[b].jump;
		else
			a = graph->dominator[a], b = graph->dominator[b];
	}
	return a;
}

static bool dominate(struct making *making)
{
	struct sfc_graph *graph = making->graph;
	struct above *above = arena_alloc(making->arena, (size_t)graph->points *
					  sizeof(*above));

	if (!above)
		return false;
	for (int n = 0; n < graph->points; n++) {
		graph->dominator[n] = graph->merge[n] = graph->next[n] = -1;
		graph->ways[n] = 0;
	}
	for (int i = 0; i < graph->points; i++) {
		const int point = graph->order[i];

		hang(graph, above, point);
		for (int e = graph->first[point]; e < graph->first[point + 1]; e++) {
			const int to = graph->edge[e].to;

			if (graph->edge[e].far)
				continue;
			graph->dominator[to] = graph->ways[to]++ == 0 ? point :
				meet(graph, above, graph->dominator[to], point);
		}
	}
	for (int i = graph->points - 1; i >= 0; i--) {
		const int point = graph->order[i], over = graph->dominator[point];

		if (graph->ways[point] < 2)
			continue;
		graph->next[point] = graph->merge[over];
		graph->merge[over] = point;
	}
	return true;
}

/* ---- */

static bool make_room(struct making *making)
{
	struct sfc_graph *graph = making->graph;
	struct arena *arena = making->arena;
	const int points = graph->points;

	graph->first = integers(arena, points + 1);
	graph->order = integers(arena, points);
	graph->ways = integers(arena, points);
	graph->dominator = integers(arena, points);
	graph->merge = integers(arena, points);
	graph->next = integers(arena, points);
	making->group = integers(arena, points);
	making->stamp = integers(arena, points);
	making->turn = integers(arena, points);
	making->start = integers(arena, points);
	making->phase = integers(arena, points);
	making->at = integers(arena, points);
	making->stack = integers(arena, points);
	return !arena->failed;
}

bool sfc_graph_make(struct sfc_graph *graph, const struct sfc *sfc, struct arena *arena)
{
	struct making making = { .graph = graph, .sfc = sfc, .arena = arena };

	*graph = (struct sfc_graph){ .sfc = sfc, .steps = sfc->step_count,
				     .transitions = sfc->transition_count };
	graph->points = 2 * graph->steps + graph->transitions + 1;
	if (!make_room(&making) || !sort_transitions(&making))
		return false;
	for (int i = 0; i < graph->steps; i++)
		making.group[i] = root_of(graph, sfc->step[i].macro);
	for (int i = 0; i < graph->transitions; i++)
		making.group[graph->steps + i] =
			root_of(graph, sfc->transition[i].macro);
	put_edges(&making, true);
	sum_edges(graph->first, graph->points);
	graph->edge = arena_alloc(arena, ((size_t)sfc->ref_count + (size_t)graph->points) *
				  sizeof(*graph->edge));
	if (!graph->edge)
		return false;
	put_edges(&making, false);
	walk(&making);
	put_roots(&making);
	return dominate(&making);
}
