/* SPDX-License-Identifier: MIT
 *
 * sfc_edit_insert - moves a pasted part into the sequence of a chart; see sfc_edit.h.
 *
 * The part is all steps and transitions from two numbers on. A transition leaves the part if
 * it leads to steps with lower numbers, or to unknown ones.
 */
#include "editor-gtk/edit/sfc_edit.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

struct passage {
	struct sfc_edit *edit;
	int step, way;           /* its first step and transition                */
	int step_end, way_end;   /* one behind its last ones                     */
	int macro;               /* the macro-step to insert into; -1: none      */
	int head, head_way;      /* the step or transition it begins with, else -1 */
	int heads;
	int tail, tails;         /* a step that no transition leaves; their number */
	int exit, exits;         /* the first transition that leaves the part; their number */
};

static uint32_t name_of(const struct passage *part, int step)
{
	return part->edit->sfc.step[step].name;
}

/* ---- ends of the part ---- */

/* The names on one side of a transition. */
static const struct sfc_ref *side_of(const struct passage *part, int transition, bool to,
				     int *count)
{
	const struct sfc *sfc = &part->edit->sfc;
	const struct sfc_transition *t = &sfc->transition[transition];

	*count = to ? t->to_count : t->from_count;
	return sfc->ref + (to ? t->first_to : t->first_from);
}

/* Does a transition of the part lead to the step (@to), or from it? */
static bool is_led(const struct passage *part, bool to, int step)
{
	for (int t = part->way; t < part->way_end; t++)
		if (sfc_edit_names_step(part->edit, t, to, step))
			return true;
	return false;
}

/* Are all steps of that side outside, and is there one? */
static bool is_open(const struct passage *part, int transition, bool to)
{
	int count;
	const struct sfc_ref *ref = side_of(part, transition, to, &count);

	for (int i = 0; i < count; i++)
		if (ref[i].step >= part->step)
			return false;
	return count > 0;
}

static void look_at(struct passage *part)
{
	const struct sfc *sfc = &part->edit->sfc;

	part->head = part->head_way = part->tail = part->exit = -1;
	for (int i = part->step; i < part->step_end; i++) {
		if (sfc->step[i].macro >= 0)
			continue;
		if (!is_led(part, true, i) && part->heads++ == 0)
			part->head = i;
		if (!is_led(part, false, i) && part->tails++ == 0)
			part->tail = i;
	}
	for (int i = part->way; i < part->way_end; i++) {
		if (sfc->transition[i].macro >= 0)
			continue;
		if (is_open(part, i, false) && part->heads++ == 0)
			part->head_way = i;
		if (is_open(part, i, true) && part->exits++ == 0)
			part->exit = i;
	}
}

/* ---- moving the pieces ---- */

static bool is_of(const struct passage *part, const struct sfc_piece *piece)
{
	return piece->kind == PIECE_TRANSITION ? piece->index >= part->way :
	       (piece->kind == PIECE_STEP || piece->kind == PIECE_MACRO_END) &&
	       piece->index >= part->step;
}

/* Moves its pieces, which are the last ones, behind piece @at. */
static bool move_pieces(struct passage *part, int at)
{
	struct sfc *sfc = &part->edit->sfc;
	const int count = sfc->piece_count;
	struct sfc_piece *kept;
	int first = at + 1, end;

	while (first < count && !is_of(part, &sfc->piece[first]))
		first++;
	for (end = first; end < count && is_of(part, &sfc->piece[end]);)
		end++;
	kept = arena_alloc(&part->edit->arena, (size_t)(end - first + 1) * sizeof(*kept));
	if (!kept)
		return sfc_edit_refuse(part->edit, N_("out of memory"));
	memcpy(kept, sfc->piece + first, (size_t)(end - first) * sizeof(*kept));
	memmove(sfc->piece + at + 1 + end - first, sfc->piece + at + 1,
		(size_t)(first - at - 1) * sizeof(*kept));
	memcpy(sfc->piece + at + 1, kept, (size_t)(end - first) * sizeof(*kept));
	return true;
}

static void move_inside(struct passage *part)
{
	struct sfc *sfc = &part->edit->sfc;

	if (part->macro < 0)
		return;
	for (int i = part->step; i < part->step_end; i++)
		if (sfc->step[i].macro < 0) {
			sfc->step[i].macro = part->macro;
			if (sfc->step[i].kind == STEP_INITIAL)
				sfc->step[i].kind = STEP_PLAIN;
		}
	for (int i = part->way; i < part->way_end; i++)
		if (sfc->transition[i].macro < 0)
			sfc->transition[i].macro = part->macro;
}

/* ---- joining the transitions ---- */

static bool lead(struct passage *part, int transition, bool to, int step)
{
	return sfc_edit_set_ways(part->edit, transition, to,
				 project_text(part->edit->project, name_of(part, step)));
}

/* A new step at the end of the part, or before its beginning. */
static int step_at(struct passage *part, bool end)
{
	struct sfc_edit *edit = part->edit;
	int at = -1;

	for (int i = 0; i < edit->sfc.piece_count && (end || at < 0); i++)
		if (is_of(part, &edit->sfc.piece[i]))
			at = i;
	return sfc_edit_new_step(edit, part->macro, end ? at : at - 1);
}

/* Can the transition name all these steps from the place of the part? Steps of the part
 * always count as known. */
static bool is_known(const struct passage *part, int transition, bool to)
{
	int count;
	const struct sfc_ref *ref = side_of(part, transition, to, &count);

	for (int i = 0; i < count; i++)
		if (ref[i].step < 0 ||
		    part->edit->sfc.step[ref[i].step].macro != part->macro)
			return false;
	return true;
}

/* Is it the first transition out of the part, or one to the same or to unknown steps? */
static bool goes_on(const struct passage *part, int transition,
		    const struct sfc_transition *exit)
{
	const struct sfc *sfc = &part->edit->sfc;
	const struct sfc_transition *t = &sfc->transition[transition];

	if (!is_known(part, transition, true))
		return true;
	for (int i = 0; i < t->to_count && t->to_count == exit->to_count; i++)
		if (sfc->ref[t->first_to + i].name != sfc->ref[exit->first_to + i].name)
			return false;
	return t->to_count == exit->to_count;
}

/* Transitions out of the part now lead where @like leads. */
static bool join(struct passage *part, const struct sfc_transition *like)
{
	struct sfc *sfc = &part->edit->sfc;
	const struct sfc_transition exit = part->exit < 0 ? *like :
					   sfc->transition[part->exit];
	int made;

	for (int i = part->way; i < part->way_end; i++) {
		struct sfc_transition *t = &sfc->transition[i];

		if (t->macro != part->macro || !is_open(part, i, true) ||
		    !goes_on(part, i, &exit))
			continue;
		t->first_to = like->first_to;
		t->to_count = like->to_count;
	}
	if (part->tail < 0 || !like->to_count)
		return true;
	made = sfc_edit_new_transition(part->edit, part->macro, part->tail, -1,
				       sfc_edit_step_end(part->edit, part->tail));
	if (made < 0)
		return false;
	sfc->transition[made].first_to = like->first_to;
	sfc->transition[made].to_count = like->to_count;
	return true;
}

/* Transitions with unknown steps lead to a new step, or from it. */
static bool close_ways(struct passage *part)
{
	int made[2] = { -1, -1 };

	for (int i = part->way; i < part->way_end; i++)
		for (int to = 0; to < 2; to++) {
			if (part->edit->sfc.transition[i].macro != part->macro ||
			    is_known(part, i, to))
				continue;
			if (made[to] < 0)
				made[to] = step_at(part, to);
			if (made[to] < 0 || !lead(part, i, to, made[to]))
				return false;
		}
	return true;
}

/* ---- the place in the sequence ---- */

static int behind_transition(struct passage *part, int transition)
{
	struct sfc_edit *edit = part->edit;
	const struct sfc_transition old = edit->sfc.transition[transition];
	int head = part->head;

	if (!move_pieces(part, sfc_edit_find_piece(edit, PIECE_TRANSITION, transition)))
		return -1;
	if (head < 0) {
		head = step_at(part, false);
		if (head < 0 || !lead(part, part->head_way, false, head))
			return -1;
	}
	return join(part, &old) && lead(part, transition, true, head) ? head : -1;
}

/* Makes all transitions out of the part lead to one step. */
static int last_step(struct passage *part)
{
	struct sfc_transition exit, like;
	int made;

	if (part->exits == 0)
		return part->tail;
	exit = part->edit->sfc.transition[part->exit];
	made = step_at(part, true);
	if (made < 0 || !lead(part, part->exit, true, made))
		return -1;
	like = part->edit->sfc.transition[part->exit];
	part->edit->sfc.transition[part->exit] = exit;
	return join(part, &like) ? made : -1;
}

static int behind_step(struct passage *part, int step, bool goes)
{
	struct sfc_edit *edit = part->edit;
	const int at = sfc_edit_step_end(edit, step);
	int last = -1;

	if (!move_pieces(part, at))
		return -1;
	if (goes) {
		last = last_step(part);
		if (last < 0 || !sfc_edit_hand_over(edit, step, last, part->way))
			return -1;
	} else if (!close_ways(part)) {
		return -1;
	}
	if (part->head < 0)
		return !lead(part, part->head_way, false, step) ? -1 :
		       part->step < part->step_end ? part->step : last >= 0 ? last : step;
	return sfc_edit_new_transition(edit, part->macro, step, part->head, at) < 0 ? -1 :
	       part->head;
}

/* The number of transitions that leave a step; @only: the last that leaves no other step,
 * -1: none. */
static int count_ways(const struct passage *part, int step, int *only)
{
	int count = 0;

	*only = -1;
	for (int t = 0; t < part->way; t++)
		if (sfc_edit_names_step(part->edit, t, false, step)) {
			count++;
			if (part->edit->sfc.transition[t].from_count == 1)
				*only = t;
		}
	return count;
}

int sfc_edit_insert(struct sfc_edit *edit, int step, int way, int at_step, int at_way)
{
	struct passage part = { .edit = edit, .step = step, .way = way,
			     .step_end = edit->sfc.step_count, .macro = -1,
			     .way_end = edit->sfc.transition_count };
	int only = -1, count = 0;

	look_at(&part);
	if ((at_step < 0 && at_way < 0) || part.heads != 1 || part.tails > 1 ||
	    part.tails + part.exits == 0) {
		if (at_step >= 0 || at_way >= 0)
			edit->why = N_("the pasted part stands beside the chart: it "
				       "does not have one beginning and one end");
		return close_ways(&part) ? step : -1;
	}
	part.macro = at_way >= 0 ? edit->sfc.transition[at_way].macro :
				   edit->sfc.step[at_step].macro;
	move_inside(&part);
	if (at_way < 0)
		count = count_ways(&part, at_step, &only);
	if (at_way >= 0)
		return behind_transition(&part, at_way);
	return count == 1 && only >= 0 && part.head >= 0 ?
	       behind_transition(&part, only) : behind_step(&part, at_step, count > 0);
}
