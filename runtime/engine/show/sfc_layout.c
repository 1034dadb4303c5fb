/* SPDX-License-Identifier: MIT
 *
 * sfc_layout - a chart put together from its lower end to its upper one.
 *
 * Every point begins a strip, in which stand all points that it dominates. What follows it
 * stands beside each other; those of them that lead to one and the same point are joined
 * below, and the strip of that point is put there, until all that is dominated has its
 * place. So nothing has to be moved, and nothing can cross.
 */
#include "engine/show/sfc_strip.h"

#include <stdlib.h>

#define MOST_BESIDE 4 /* lines that run to one step beside each other          */

static const struct sfc *sfc_of(const struct sfc_weave *weave)
{
	return weave->layout->sfc;
}

int sfc_step_rows(const struct sfc *sfc, int step)
{
	const struct sfc_step *s = &sfc->step[step];
	const int rows = 1 + (s->min || s->max);

	return s->use_count > rows ? s->use_count : rows;
}

static int rows_of(const struct sfc_weave *weave, int point)
{
	if (point < weave->graph.steps)
		return sfc_step_rows(sfc_of(weave), point) + 2;
	return point < weave->graph.steps + weave->graph.transitions;
}

static bool is_root(const struct sfc_weave *weave, int point)
{
	return point >= weave->graph.steps + weave->graph.transitions;
}

/* ---- what follows a point ---- */

struct sewing {
	struct sfc_weave *weave;
	int *of_point;      /* strip, by point                                  */
	int *base;         /* hint that holds for a point: its own, or that of what
			      leads to it                                     */
	int *list;         /* strips beside each other                        */
	int list_count;
	int *late;         /* room for as many                                */
};

static int hint_of(const struct sewing *sewing, int point)
{
	const struct sfc_graph *graph = &sewing->weave->graph;

	if (point >= graph->steps && point < graph->steps + graph->transitions &&
	    graph->first[point] < graph->first[point + 1] &&
	    !graph->edge[graph->first[point]].far)
		point = graph->edge[graph->first[point]].to;
	return point < graph->steps ? sfc_of(sewing->weave)->step[point].column : 0;
}

static struct sfc_exit exit_of(int from, const struct sfc_edge *edge)
{
	return (struct sfc_exit){ 0, 0, edge->to, from, edge->ref };
}

/* The strip of one edge: a jump, a line that only leads on, or what it leads to. */
static int branch(struct sewing *sewing, int point, const struct sfc_edge *edge)
{
	struct sfc_weave *weave = sewing->weave;
	const struct sfc_exit exit = exit_of(point, edge);
	const bool open = !edge->far && weave->graph.ways[edge->to] > 1;
	int strip = edge->far || open ? strip_new(weave, 1) : sewing->of_point[edge->to];

	if (strip < 0 || (edge->far && !strip_jump(weave, strip, 0, 0, &exit)) ||
	    (open && !strip_exit(weave, strip, exit)) ||
	    (!is_root(weave, point) &&
	     !strip_wire(weave, strip, (struct sfc_wire){ false, 0, -1, 0, 0 })))
		return -1;
	weave->strip[strip].hint = -1;
	if (!edge->far && hint_of(sewing, edge->to))
		weave->strip[strip].hint = hint_of(sewing, edge->to) - sewing->base[point];
	return strip;
}

/* Puts strips first … last of the list together to one. */
static bool together(struct sewing *sewing, int first, int last)
{
	int strip = strip_beside(sewing->weave, sewing->list + first, last - first + 1);

	if (strip < 0)
		return false;
	sewing->list[first] = strip;
	for (int i = last + 1; i < sewing->list_count; i++)
		sewing->list[first + i - last] = sewing->list[i];
	sewing->list_count -= last - first;
	return true;
}

/* A point to which several of the list lead, below them. */
static bool merge(struct sewing *sewing, int point)
{
	struct sfc_weave *weave = sewing->weave;
	int first = -1, last = -1;

	for (int i = 0; i < sewing->list_count; i++)
		if (strip_leads(weave, sewing->list[i], point)) {
			first = first < 0 ? i : first;
			last = i;
		}
	if (first < 0) { /* all ways to it were cut */
		weave->strip[sewing->of_point[point]].entry = -1;
		weave->strip[sewing->of_point[point]].hint = -1;
		sewing->list[sewing->list_count++] = sewing->of_point[point];
		return true;
	}
	return together(sewing, first, last) &&
	       strip_join(weave, sewing->list[first], point, sewing->of_point[point],
			  point >= weave->graph.steps);
}

static int count_branches(const struct sfc_graph *graph, int point)
{
	return graph->first[point + 1] - graph->first[point];
}

static int count_exits(const struct sewing *sewing, int point)
{
	int count = 0;

	for (int i = 0; i < sewing->list_count; i++) {
		const struct sfc_strip *strip = &sewing->weave->strip[sewing->list[i]];

		for (int k = 0; k < strip->exit_count; k++)
			count += strip->exit[k].point == point;
	}
	return count;
}

/* Where many lines run down beside each other to one and the same step, a branch that is
 * nothing but another one of them ends in an arrow. */
static bool cut_short_ones(struct sewing *sewing, int point)
{
	struct sfc_weave *weave = sewing->weave;

	for (int i = 0; i < sewing->list_count; i++) {
		const int strip = sewing->list[i];
		const struct sfc_strip *s = &weave->strip[strip];

		if (s->rows > 2 || s->exit_count != 1)
			continue;
		const int to = s->exit[0].point;
		if (to < weave->graph.steps && weave->graph.dominator[to] != point &&
		    count_exits(sewing, to) > MOST_BESIDE && !strip_cut(weave, strip))
			return false;
	}
	return true;
}

/* What is over at once stands at the right: a chart from each of whose steps one can give
 * up is not wider for it, whatever the order. */
static void short_ones_last(struct sewing *sewing)
{
	const struct sfc_strip *strip = sewing->weave->strip;
	int *late = sewing->late, count = 0, kept = 0;

	for (int i = 0; i < sewing->list_count; i++) {
		const int at = sewing->list[i];

		if (strip[at].rows <= 2 && strip[at].exit_count == 0)
			late[count++] = at;
		else
			sewing->list[kept++] = at;
	}
	for (int i = 0; i < count; i++)
		sewing->list[kept + i] = late[i];
}

/* All that follows a point, as one strip. */
static int follow(struct sewing *sewing, int point)
{
	const struct sfc_graph *graph = &sewing->weave->graph;

	sewing->list_count = 0;
	for (int e = graph->first[point]; e < graph->first[point + 1]; e++) {
		int strip = branch(sewing, point, &graph->edge[e]);

		if (strip < 0)
			return -1;
		sewing->list[sewing->list_count++] = strip;
	}
	if (!is_root(sewing->weave, point)) {
		if (!cut_short_ones(sewing, point))
			return -1;
		short_ones_last(sewing);
	}
	for (int m = graph->merge[point]; m >= 0; m = graph->next[m])
		if (!merge(sewing, m))
			return -1;
	return strip_beside(sewing->weave, sewing->list, sewing->list_count);
}

static int sew(struct sewing *sewing, int point)
{
	struct sfc_weave *weave = sewing->weave;
	const struct sfc_graph *graph = &weave->graph;
	const struct sfc_edge *edge = &graph->edge[graph->first[point]];
	const int count = count_branches(graph, point), rows = rows_of(weave, point);
	int strip;

	if (is_root(weave, point))
		return follow(sewing, point);
	if (count == 1 && !edge->far && graph->ways[edge->to] > 1) {
		strip = strip_under(weave, -1, rows, false, false);
		return strip >= 0 && strip_exit(weave, strip, exit_of(point, edge)) ?
		       strip : -1;
	}
	strip = count ? follow(sewing, point) : -1;
	if (count && strip < 0)
		return -1;
	return strip_under(weave, strip, rows, count > 1, point >= graph->steps);
}

static bool sew_all(struct sewing *sewing)
{
	struct sfc_weave *weave = sewing->weave;
	const struct sfc_graph *graph = &weave->graph;

	for (int i = 0; i < graph->points; i++) {
		const int point = graph->order[i], over = graph->dominator[point];
		int hint = point < graph->steps ? sfc_of(weave)->step[point].column : 0;

		sewing->base[point] = hint > 0 ? hint : over < 0 ? 1 : sewing->base[over];
	}
	for (int i = graph->points - 1; i >= 0; i--) {
		const int point = graph->order[i];

		sewing->of_point[point] = sew(sewing, point);
		if (sewing->of_point[point] < 0)
			return false;
	}
	return true;
}

/* ---- from strips to places ---- */

static bool place_frames(struct sewing *sewing)
{
	struct sfc_weave *weave = sewing->weave;
	struct sfc_layout *layout = weave->layout;
	const int main = weave->graph.steps + weave->graph.transitions;
	int row = 0;

	for (int root = main; root < weave->graph.points; root++) {
		struct sfc_strip *strip = &weave->strip[sewing->of_point[root]];
		struct sfc_frame *frame;

		if (strip->rows == 0)
			continue;
		frame = arena_push(&layout->arena, &layout->frame, &layout->frame_count,
				   sizeof(*frame));
		if (!frame)
			return false;
		frame->macro = root - main - 1;
		frame->title = root > main ? row : -1;
		frame->top = row + (root > main ? 2 : 0);
		frame->bottom = frame->top + strip->rows - 1;
		strip->row = frame->top;
		row = frame->bottom + 3;
		layout->rows = frame->bottom + 1;
		if (strip->lanes > layout->lanes)
			layout->lanes = strip->lanes;
	}
	return true;
}

/* Parts stand before what they are parts of. */
static void place_strips(struct sfc_weave *weave)
{
	for (int i = weave->strip_count - 1; i >= 0; i--) {
		struct sfc_strip *strip = &weave->strip[i];

		if (strip->in < 0)
			continue;
		strip->lane += weave->strip[strip->in].lane;
		strip->row += weave->strip[strip->in].row;
	}
}

static void place_wires(struct sfc_weave *weave)
{
	for (int i = 0; i < weave->layout->wire_count; i++) {
		const struct sfc_strip *strip = &weave->strip[weave->wire_strip[i]];
		struct sfc_wire *wire = &weave->layout->wire[i];

		wire->lane += strip->lane;
		wire->end_lane += strip->lane;
		wire->row += strip->row;
		wire->end_row += strip->row;
	}
}

static bool place_shapes(struct sewing *sewing)
{
	struct sfc_weave *weave = sewing->weave;
	struct sfc_layout *layout = weave->layout;
	const int inner = weave->graph.steps + weave->graph.transitions;

	layout->shape_count = inner + layout->jump_count;
	layout->shape = arena_alloc(&layout->arena, (size_t)layout->shape_count *
				    sizeof(*layout->shape));
	if (!layout->shape)
		return false;
	for (int n = 0; n < inner; n++) {
		const struct sfc_strip *strip = &weave->strip[sewing->of_point[n]];
		const bool step = n < weave->graph.steps;

		layout->shape[n] = (struct sfc_shape){
			step ? SFC_STEP : SFC_TRANSITION,
			step ? n : n - weave->graph.steps, strip->lane, strip->row,
			strip->row + rows_of(weave, n) - 1 };
	}
	for (int i = 0; i < layout->jump_count; i++) {
		const struct sfc_strip *strip = &weave->strip[weave->jump_strip[i]];
		struct sfc_shape *shape = &layout->shape[inner + i];

		*shape = weave->jump_at[i];
		shape->lane += strip->lane;
		shape->top += strip->row;
		shape->bottom += strip->row;
	}
	return true;
}

/* ---- what is asked of it ---- */

struct sorted { int lane, top, index; };

static int compare_sorted(const void *a, const void *b)
{
	const struct sorted *x = a, *y = b;

	if (x->lane != y->lane)
		return x->lane < y->lane ? -1 : 1;
	return x->top < y->top ? -1 : x->top > y->top;
}

static bool sort_shapes(struct sfc_weave *weave)
{
	struct sfc_layout *layout = weave->layout;
	const int count = layout->shape_count;
	struct sorted *sorted = arena_alloc(&weave->arena, ((size_t)count + 1) *
					    sizeof(*sorted));

	layout->sorted = arena_alloc(&layout->arena, ((size_t)count + 1) * sizeof(int));
	if (!sorted || !layout->sorted)
		return false;
	for (int i = 0; i < count; i++)
		sorted[i] = (struct sorted){ layout->shape[i].lane, layout->shape[i].top,
					     i };
	qsort(sorted, (size_t)count, sizeof(*sorted), compare_sorted);
	for (int i = 0; i < count; i++)
		layout->sorted[i] = sorted[i].index;
	return true;
}

/* Names that no line joins: those of jumps, and those of what leads to a transition from
 * nowhere. */
static bool find_apart(struct sfc_layout *layout, const struct sfc_graph *graph)
{
	const struct sfc *sfc = layout->sfc;

	layout->apart = arena_alloc(&layout->arena, (size_t)sfc->ref_count + 1);
	if (!layout->apart)
		return false;
	for (int t = 0; t < graph->transitions; t++) {
		const struct sfc_transition *transition = &sfc->transition[t];

		for (int i = 0; i < transition->from_count; i++)
			layout->apart[transition->first_from + i] = true;
	}
	for (int e = 0; e < graph->first[graph->steps]; e++)
		layout->apart[graph->edge[e].ref] = false;
	for (int i = 0; i < layout->jump_count; i++)
		layout->apart[layout->jump[i].ref] = true;
	return true;
}

/* Transitions behind a step are asked from left to right, unless one has a priority or
 * stands elsewhere for being short. */
static bool find_turns(struct sfc_layout *layout, const struct sfc_graph *graph)
{
	const struct sfc *sfc = layout->sfc;

	layout->turn = arena_alloc(&layout->arena, ((size_t)graph->transitions + 1) *
				   sizeof(int));
	for (int s = 0; layout->turn && s < graph->steps; s++) {
		const int first = graph->first[s], end = graph->first[s + 1];
		bool told = false;
		int lane = -1;

		for (int e = first; e < end && end - first > 1; e++) {
			const int at = layout->shape[graph->edge[e].to].lane;

			told |= at < lane ||
				sfc->transition[graph->edge[e].to - graph->steps]
				.priority > 0;
			lane = at;
		}
		for (int e = first; told && e < end; e++)
			layout->turn[graph->edge[e].to - graph->steps] = e - first + 1;
	}
	return layout->turn != NULL;
}

static bool make_layout(struct sfc_layout *layout, struct sfc_weave *weave)
{
	struct sewing sewing = { .weave = weave };
	size_t room;

	if (!sfc_graph_make(&weave->graph, layout->sfc, &weave->arena))
		return false;
	room = ((size_t)layout->sfc->ref_count + 2 * (size_t)weave->graph.points) *
	       sizeof(int);
	sewing.of_point = arena_alloc(&weave->arena, room);
	sewing.base = arena_alloc(&weave->arena, room);
	sewing.list = arena_alloc(&weave->arena, room);
	sewing.late = arena_alloc(&weave->arena, room);
	if (weave->arena.failed || !sew_all(&sewing) || !place_frames(&sewing))
		return false;
	place_strips(weave);
	place_wires(weave);
	return place_shapes(&sewing) && sort_shapes(weave) &&
	       find_apart(layout, &weave->graph) && find_turns(layout, &weave->graph);
}

struct sfc_layout *sfc_layout_new(const struct sfc *sfc)
{
	struct sfc_layout *layout = calloc(1, sizeof(*layout));
	struct sfc_weave weave = { .layout = layout };
	bool good;

	if (!layout)
		return NULL;
	layout->sfc = sfc;
	arena_init(&layout->arena);
	arena_init(&weave.arena);
	good = make_layout(layout, &weave);
	arena_free(&weave.arena);
	if (good)
		return layout;
	sfc_layout_free(layout);
	return NULL;
}

void sfc_layout_free(struct sfc_layout *layout)
{
	if (layout)
		arena_free(&layout->arena);
	free(layout);
}

const struct sfc_shape *sfc_layout_step(const struct sfc_layout *layout, int step)
{
	return &layout->shape[step];
}

const struct sfc_shape *sfc_layout_transition(const struct sfc_layout *layout,
					      int transition)
{
	return &layout->shape[layout->sfc->step_count + transition];
}

int sfc_layout_at(const struct sfc_layout *layout, int lane, int row)
{
	int low = 0, high = layout->shape_count;

	while (low < high) { /* the last that begins at or above it */
		const int middle = low + (high - low) / 2;
		const struct sfc_shape *shape = &layout->shape[layout->sorted[middle]];

		if (shape->lane < lane || (shape->lane == lane && shape->top <= row))
			low = middle + 1;
		else
			high = middle;
	}
	if (low == 0)
		return -1;
	const struct sfc_shape *shape = &layout->shape[layout->sorted[low - 1]];
	return shape->lane == lane && shape->bottom >= row ? layout->sorted[low - 1] : -1;
}

int sfc_layout_use(const struct sfc_layout *layout, int step, int row)
{
	const struct sfc_step *s = &layout->sfc->step[step];
	const int line = row - layout->shape[step].top - 1;

	return line >= 0 && line < s->use_count ? s->first_use + line : -1;
}
