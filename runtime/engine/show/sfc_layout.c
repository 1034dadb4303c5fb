/* SPDX-License-Identifier: MIT
 *
 * sfc_layout - lays out a chart from its lower end to its upper end.
 *
 * Every point (step or transition) begins a strip that holds all points it dominates.
 * Its successors are side by side; successors that lead to the same point are joined
 * below, and the strip of that point is placed there, until every dominated point is
 * placed. A placed strip never moves, and no lines cross.
 */
#include "engine/show/sfc_layout.h"

#include "engine/base/arena.h"
#include "engine/model/sfc.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* A line that ends in a lane and must still be led to @point. */
struct sfc_exit {
	int lane, up;      /* rows between its end and the last row of the strip */
	int point;          /* edge of the graph                                */
	int from, ref;     /* the step or transition it comes from, and the reference */
};

struct sfc_strip {
	int in;            /* the strip that contains it; -1: none             */
	int lane, row;     /* offset in that strip, or in the drawing          */
	int lanes, rows;
	int entry;         /* lane of its last entry; -1: no line leads into it */
	int hint;          /* preferred lane, relative to the first strip beside it */
	int *reach;        /* lanes in use, by row, the last row first */
	int reach_count;   /* number of rows                                   */
	struct sfc_exit *exit; /* from left to right                           */
	int exit_count;
};

struct sfc_edge {
	int to;            /* point; -1: none of this name in this chart       */
	int ref;           /* of sfc.ref; -1: from a root                     */
	bool far;
};

struct sfc_graph {
	const struct sfc *sfc;
	int steps, transitions, points; /* points: with the roots               */
	struct sfc_edge *edge;         /* edges out of point n begin at first[n] */
	int *first;                    /* points + 1                           */
	int *order;                    /* points from top to bottom, with roots */
	int *ways;                     /* edges to a point, without far ones   */
	int *dominator;                /* -1: a root                          */
	int *merge;                    /* by dominator: its first dominated point with
				        * several ways; -1 */
	int *next;                     /* merge: the next of them, downwards  */
};

struct sfc_weave {
	struct sfc_graph graph;
	struct sfc_layout *layout;
	struct arena arena;      /* temporary memory                           */
	struct sfc_strip *strip; /* inner strips before outer ones             */
	int strip_count;
	int *wire_strip;         /* by wire: the strip it is in                */
	int wire_strip_count;
	int *jump_strip;
	int jump_strip_count;
	struct sfc_shape *jump_at; /* by jump                                  */
	int jump_at_count;
};

#define MOST_BESIDE 4 /* lines that run side by side to the same step          */

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

/* ---- the strip of a point ---- */

struct sewing {
	struct sfc_weave *weave;
	int *of_point;      /* strip, by point                                  */
	int *base;         /* hint that holds for a point: its own, or that of what
			      leads to it                                     */
	int *list;         /* strips side by side                             */
	int list_count;
	int *late;         /* capacity of that list                           */
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

static bool push_reach(struct sfc_weave *weave, struct sfc_strip *strip, int lanes)
{
	int *reach = arena_push(&weave->arena, &strip->reach, &strip->reach_count,
				sizeof(*reach));

	if (!reach)
		return false;
	*reach = lanes;
	strip->rows++;
	if (lanes > strip->lanes)
		strip->lanes = lanes;
	return true;
}

/* All of these return -1 or false when memory is out. Strips are identified by number. */

/** strip_new - of @rows rows; lane 0 is in use. */
static int strip_new(struct sfc_weave *weave, int rows)
{
	struct sfc_strip *strip = arena_push(&weave->arena, &weave->strip,
					     &weave->strip_count, sizeof(*strip));

	if (!strip)
		return -1;
	*strip = (struct sfc_strip){ .in = -1 };
	for (int i = 0; i < rows; i++)
		if (!push_reach(weave, strip, 1))
			return -1;
	return weave->strip_count - 1;
}

/* Adds a line; lanes and rows of @wire are the strip's. */
static bool strip_wire(struct sfc_weave *weave, int strip, struct sfc_wire wire)
{
	struct sfc_layout *layout = weave->layout;
	struct sfc_wire *to;
	int *in;

	if (wire.lane == wire.end_lane && wire.row == wire.end_row)
		return true;
	to = arena_push(&layout->arena, &layout->wire, &layout->wire_count, sizeof(*to));
	in = arena_push(&weave->arena, &weave->wire_strip, &weave->wire_strip_count,
			sizeof(*in));
	if (!to || !in)
		return false;
	*to = wire;
	*in = strip;
	return true;
}

/* Adds a line in lane 0 that continues from its last row. */
static bool strip_exit(struct sfc_weave *weave, int strip, struct sfc_exit exit)
{
	struct sfc_strip *s = &weave->strip[strip];
	struct sfc_exit *to = arena_push(&weave->arena, &s->exit, &s->exit_count,
					 sizeof(*to));

	if (to)
		*to = exit;
	return to != NULL;
}

/* An arrow at (lane, row), for @exit. */
static bool strip_jump(struct sfc_weave *weave, int strip, int lane, int row,
		       const struct sfc_exit *exit)
{
	struct sfc_layout *layout = weave->layout;
	const int steps = weave->graph.steps;
	struct sfc_jump *jump = arena_push(&layout->arena, &layout->jump,
					   &layout->jump_count, sizeof(*jump));
	int *in = arena_push(&weave->arena, &weave->jump_strip, &weave->jump_strip_count,
			     sizeof(*in));
	struct sfc_shape *at = arena_push(&weave->arena, &weave->jump_at,
					  &weave->jump_at_count, sizeof(*at));

	if (!jump || !in || !at)
		return false;
	*jump = (struct sfc_jump){ exit->ref, exit->from, false, -1 };
	jump->to_transition = exit->from < steps;
	if (jump->to_transition)
		jump->target = exit->point - steps;
	else
		jump->from -= steps;
	if (!jump->to_transition && exit->ref >= 0 &&
	    layout->sfc->ref[exit->ref].step < steps)
		jump->target = layout->sfc->ref[exit->ref].step;
	*in = strip;
	*at = (struct sfc_shape){ SFC_JUMP, layout->jump_count - 1, lane, row, row };
	return true;
}

/* The strip of one edge: a jump, a plain line, or the strip of its target. */
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

#define MOST_HINT 64

/* ---- side by side ---- */

/* The first free lane for @part to the right of the others. All begin in the same row,
 * so only the rows of @part matter, unless lines continue below it. */
static int free_lane(const struct sfc_strip *strip, const struct sfc_strip *part)
{
	int rows = part->rows < strip->rows ? part->rows + 1 : strip->rows, lane = 0;

	if (part->exit_count)
		return strip->lanes;
	for (int i = 0; i < rows; i++)
		if (strip->reach[strip->rows - 1 - i] > lane)
			lane = strip->reach[strip->rows - 1 - i];
	return lane;
}

static void put_reach(struct sfc_strip *strip, struct sfc_strip *part, int lane)
{
	for (int i = 0; i < part->rows; i++)
		part->reach[i] += lane;
	if (part->rows <= strip->rows) {
		memcpy(strip->reach + (strip->rows - part->rows), part->reach,
		       (size_t)part->rows * sizeof(int));
		return;
	}
	for (int i = 0; i < strip->exit_count; i++)
		strip->exit[i].up += part->rows - strip->rows;
	strip->reach = part->reach;
	strip->reach_count = strip->rows = part->rows;
}

static bool put_beside(struct sfc_weave *weave, int number, int other)
{
	struct sfc_strip *strip = &weave->strip[number], *part = &weave->strip[other];
	const int hint = part->hint - (strip->hint > 0 ? strip->hint : 0);
	int lane = free_lane(strip, part);

	if (hint > lane && hint < MOST_HINT)
		lane = hint;
	part->in = number;
	part->lane = lane;
	part->row = 0;
	if (part->entry >= 0)
		strip->entry = lane + part->entry;
	if (lane + part->lanes > strip->lanes)
		strip->lanes = lane + part->lanes;
	const int rows = part->rows;
	put_reach(strip, part, lane);
	for (int i = 0; i < part->exit_count; i++) {
		struct sfc_exit exit = part->exit[i];

		exit.lane += lane;
		exit.up += strip->rows - rows;
		if (!strip_exit(weave, number, exit))
			return false;
	}
	return true;
}

/* Puts a strip into an outer one, which takes over its entries and exits. */
static int around(struct sfc_weave *weave, int part)
{
	int number = strip_new(weave, 0);

	if (number < 0)
		return -1;
	struct sfc_strip *strip = &weave->strip[number], *inner = &weave->strip[part];
	*strip = *inner;
	inner->in = number;
	inner->lane = inner->row = 0;
	return number;
}

/* Puts some strips side by side, their first rows aligned. Returns the new strip. */
static int strip_beside(struct sfc_weave *weave, const int *part, int count)
{
	int number;

	if (count == 0)
		return strip_new(weave, 0);
	if (count == 1)
		return part[0];
	number = around(weave, part[0]);
	for (int i = 1; number >= 0 && i < count; i++)
		if (!put_beside(weave, number, part[i]))
			return -1;
	return number;
}

/* Joins strips first … last of the list into one. */
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

/* Whether it has an exit to @point. */
static bool strip_leads(const struct sfc_weave *weave, int strip, int point)
{
	const struct sfc_strip *s = &weave->strip[strip];

	for (int i = 0; i < s->exit_count; i++)
		if (s->exit[i].point == point)
			return true;
	return false;
}

/* The range of exits from the first to the last that leads to @point. */
struct span { int first, last, count; };

static struct span find_span(const struct sfc_strip *strip, int point)
{
	struct span span = { -1, -1, 0 };

	for (int i = 0; i < strip->exit_count; i++) {
		if (strip->exit[i].point != point)
			continue;
		span.first = span.first < 0 ? i : span.first;
		span.last = i;
		span.count++;
	}
	return span;
}

/* ---- one below another ---- */

/* Adds a row at the lower end. */
static bool grow_below(struct sfc_weave *weave, struct sfc_strip *strip, int reach)
{
	if (!push_reach(weave, strip, reach))
		return false;
	memmove(strip->reach + 1, strip->reach, (size_t)(strip->rows - 1) *
		sizeof(int));
	strip->reach[0] = reach;
	for (int i = 0; i < strip->exit_count; i++)
		strip->exit[i].up++;
	return true;
}

/* Whether another exit blocks the place below the joined ones. */
static bool is_shut(const struct sfc_strip *strip, struct span span, int i, int lanes)
{
	return i > span.first &&
	       (i < span.last || strip->exit[i].lane < strip->exit[span.first].lane + lanes);
}

static bool cut(struct sfc_weave *weave, int number, int point, struct span span,
		int lanes)
{
	struct sfc_strip *strip = &weave->strip[number];
	bool low = false;

	for (int i = 0; i < strip->exit_count; i++)
		low |= strip->exit[i].point != point && is_shut(strip, span, i, lanes) &&
		       strip->exit[i].up == 0;
	if (low && !grow_below(weave, strip, 0))
		return false;
	for (int i = 0; i < strip->exit_count; i++) {
		struct sfc_exit *exit = &strip->exit[i];
		int row = strip->rows - exit->up;
		int *reach = &strip->reach[exit->up - 1];

		if (exit->point == point || !is_shut(strip, span, i, lanes))
			continue;
		if (*reach <= exit->lane)
			*reach = exit->lane + 1;
		if (!strip_jump(weave, number, exit->lane, row, exit) ||
		    !strip_wire(weave, number, (struct sfc_wire){ false, exit->lane,
				row - 1, exit->lane, row }))
			return false;
		exit->point = -1;
	}
	return true;
}

/* Lines from the exits down to the row where they meet. */
static bool join_exits(struct sfc_weave *weave, int number, int point, struct span span,
		       bool twin)
{
	struct sfc_strip *strip = &weave->strip[number];
	const int first = strip->exit[span.first].lane;
	const int last = strip->exit[span.last].lane;

	if (span.count > 1) {
		if (!grow_below(weave, strip, last + 1) ||
		    !strip_wire(weave, number, (struct sfc_wire){ twin, first,
				strip->rows - 1, last, strip->rows - 1 }))
			return false;
	}
	for (int i = span.first; i <= span.last; i++) {
		const struct sfc_exit *exit = &strip->exit[i];

		if (exit->point == point &&
		    !strip_wire(weave, number, (struct sfc_wire){ false, exit->lane,
				strip->rows - 1 - exit->up, exit->lane,
				strip->rows - 1 }))
			return false;
	}
	return true;
}

/* The remaining exits, with those of the lower part between them. */
static bool exits_below(struct sfc_weave *weave, int number, int point, struct span span,
			const struct sfc_strip *part, int lane)
{
	struct sfc_strip *strip = &weave->strip[number];
	const struct sfc_exit *old = strip->exit;
	const int count = strip->exit_count;

	strip->exit = NULL;
	strip->exit_count = 0;
	for (int i = 0; i <= count; i++) {
		for (int k = 0; i == span.first && k < part->exit_count; k++) {
			struct sfc_exit exit = part->exit[k];

			exit.lane += lane;
			if (!strip_exit(weave, number, exit))
				return false;
		}
		if (i == count || old[i].point == point || old[i].point < 0)
			continue;
		struct sfc_exit exit = old[i];
		exit.up += part->rows;
		if (!strip_exit(weave, number, exit))
			return false;
	}
	return true;
}

/* Appends the rows of @part below those of the strip above it. */
static bool stack(struct sfc_weave *weave, struct sfc_strip *strip,
		  struct sfc_strip *part, int lane)
{
	const int *old = strip->reach;
	const int rows = strip->rows;

	for (int i = 0; lane && i < part->rows; i++)
		part->reach[i] += lane;
	strip->reach = part->reach;
	strip->reach_count = strip->rows = part->rows;
	for (int i = 0; i < rows; i++)
		if (!push_reach(weave, strip, old[i]))
			return false;
	if (lane + part->lanes > strip->lanes)
		strip->lanes = lane + part->lanes;
	return true;
}

/* Joins the exits to @point and leads them to @part below.
 * @twin: with a double line. Exits between them that could not get out become jumps. */
static bool strip_join(struct sfc_weave *weave, int number, int point, int other, bool twin)
{
	struct sfc_strip *strip = &weave->strip[number], *part = &weave->strip[other];
	const struct span span = find_span(strip, point);
	const int lane = strip->exit[span.first].lane;

	if (!cut(weave, number, point, span, part->lanes) ||
	    !join_exits(weave, number, point, span, twin) ||
	    !strip_wire(weave, other, (struct sfc_wire){ false, 0, -1, 0, 0 }))
		return false;
	part->in = number;
	part->lane = lane;
	part->row = strip->rows;
	return exits_below(weave, number, point, span, part, lane) &&
	       stack(weave, strip, part, lane);
}

/* Places a point that several strips of the list lead to below them. */
static bool merge(struct sewing *sewing, int point)
{
	struct sfc_weave *weave = sewing->weave;
	int first = -1, last = -1;

	for (int i = 0; i < sewing->list_count; i++)
		if (strip_leads(weave, sewing->list[i], point)) {
			first = first < 0 ? i : first;
			last = i;
		}
	if (first < 0) { /* all ways to it became jumps */
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

/* Replaces its only exit, in lane 0, by an arrow. */
static bool strip_cut(struct sfc_weave *weave, int number)
{
	struct sfc_strip *strip = &weave->strip[number];
	const int row = strip->rows - strip->exit->up;

	if ((strip->exit->up == 0 && !grow_below(weave, strip, 1)) ||
	    !strip_jump(weave, number, strip->exit->lane, row, strip->exit) ||
	    !strip_wire(weave, number, (struct sfc_wire){ false, strip->exit->lane,
			row - 1, strip->exit->lane, row }))
		return false;
	strip->exit_count = 0;
	return true;
}

/* If many lines run side by side to the same step, a branch that is only such a line
 * ends in an arrow. */
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

/* Moves short branches to the right: a chart with an exit at each of its steps does not
 * get wider by them. */
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

/* The strip of a point with all points it dominates. */
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

/* Puts @rows of one lane above a strip, or (strip -1) alone.
 * @line: with a line to all its entries; @twin: a double line. Returns the new strip. */
static int strip_under(struct sfc_weave *weave, int part, int rows, bool line, bool twin)
{
	int number = part < 0 ? strip_new(weave, 0) : around(weave, part);

	if (number < 0)
		return -1;
	struct sfc_strip *strip = &weave->strip[number];
	const int entry = strip->entry;
	if (part >= 0)
		weave->strip[part].row = rows + line;
	if (line && (!push_reach(weave, strip, entry + 1) ||
		     !strip_wire(weave, number, (struct sfc_wire){ twin, 0, rows, entry,
				 rows }) ||
		     !strip_wire(weave, number, (struct sfc_wire){ false, 0, rows - 1, 0,
				 rows })))
		return -1;
	for (int i = 0; i < rows; i++)
		if (!push_reach(weave, strip, 1))
			return -1;
	strip->entry = 0;
	strip->hint = -1;
	return number;
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

/* ---- absolute places ---- */

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

/* Inner strips come before outer ones. */
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

/* ---- public functions ---- */

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

/* Marks names without a line: those of jumps, and the sources of transitions that no
 * line leads to. */
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

/* Transitions behind a step are tested from left to right, unless one has a priority or
 * was moved because it is short. */
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

/* Temporary data while the graph is made. */
struct making {
	struct sfc_graph *graph;
	const struct sfc *sfc;
	struct arena *arena;
	int *group;        /* of a point: its root                             */
	int *stamp;        /* by step: the transition that named it last      */
	int *turn;         /* transitions by priority                         */
	int *start;        /* points without a way to them, in order           */
	int start_count;
	int *phase;        /* of a point: 0 not seen; later ones are greater   */
	int *at;           /* next edge of a point to visit; -1: done          */
	int *stack;
	int done;          /* points finished                                  */
};

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

/* A name that is twice in one list counts once. */
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

/* first[n + 1] holds the count of edges. The sums are the places where a point's edges
 * begin; writing an edge advances the place of its point to where the next begins. */
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
			edge->far = true; /* leads up, or out of its macro-step */
		}
	}
}

/* Roots: initial steps first; then points without a way to them; then loops without
 * one. */
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

/* Adds edges from the roots to the points where walks began. */
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

/* Each point has its parent and an ancestor far above it, so that the common ancestor
 * of two points is found in few steps. */
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

static int *integers(struct arena *arena, int count)
{
	return arena_alloc(arena, ((size_t)count + 1) * sizeof(int));
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

/* the graph of any chart, also with errors
 * @arena: for everything in it
 *
 * Scan-safe: no. Fails: false: no memory.
 */
static bool sfc_graph_make(struct sfc_graph *graph, const struct sfc *sfc, struct arena *arena)
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

void sfc_layout_free(struct sfc_layout *layout)
{
	if (layout)
		arena_free(&layout->arena);
	free(layout);
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

const struct sfc_shape *sfc_layout_step(const struct sfc_layout *layout, int step)
{
	return &layout->shape[step];
}
