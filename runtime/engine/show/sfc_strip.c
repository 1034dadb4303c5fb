/* SPDX-License-Identifier: MIT
 *
 * sfc_strip - strips beside and below each other, exits joined or cut.
 *
 * What reaches how far right is kept from the last row upwards, because most strips grow
 * at their upper end, and exits count their rows from below for the same reason: so that
 * a long chart is not copied once for each of its steps.
 */
#include "engine/show/sfc_strip.h"

#include <string.h>

#define MOST_HINT 64

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

int strip_new(struct sfc_weave *weave, int rows)
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

bool strip_wire(struct sfc_weave *weave, int strip, struct sfc_wire wire)
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

bool strip_exit(struct sfc_weave *weave, int strip, struct sfc_exit exit)
{
	struct sfc_strip *s = &weave->strip[strip];
	struct sfc_exit *to = arena_push(&weave->arena, &s->exit, &s->exit_count,
					 sizeof(*to));

	if (to)
		*to = exit;
	return to != NULL;
}

bool strip_jump(struct sfc_weave *weave, int strip, int lane, int row,
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

bool strip_leads(const struct sfc_weave *weave, int strip, int point)
{
	const struct sfc_strip *s = &weave->strip[strip];

	for (int i = 0; i < s->exit_count; i++)
		if (s->exit[i].point == point)
			return true;
	return false;
}

/* ---- beside each other ---- */

/* The first lane that is free for @part at the right of what is there. Both begin in the
 * same row, so that nothing below the last row of @part is in its way, unless lines lead
 * on from it. */
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

/* A strip around another one, which takes over all that it has. */
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

int strip_beside(struct sfc_weave *weave, const int *part, int count)
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

/* ---- below each other ---- */

/* One more row at the lower end. */
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

/* The exits that lead to @point, from the first to the last of them. */
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

/* Is another exit in the way of what comes below the ones that are joined? */
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

bool strip_cut(struct sfc_weave *weave, int number)
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

/* Lines from the exits down to the row below all, where they meet. */
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

/* The exits that are left, with those of the part below between them. */
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

/* The rows of @part, then those of the strip above it. */
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

bool strip_join(struct sfc_weave *weave, int number, int point, int other, bool twin)
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

int strip_under(struct sfc_weave *weave, int part, int rows, bool line, bool twin)
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
