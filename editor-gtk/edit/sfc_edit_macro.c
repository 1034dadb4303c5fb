/* SPDX-License-Identifier: MIT
 *
 * sfc_edit_macro - makes macro-steps and dissolves them; see sfc_edit.h.
 *
 * Neither changes what the chart does: transitions to the first step of the group lead to
 * the macro-step, and those from its last step leave the macro-step.
 */
#include "editor-gtk/edit/sfc_edit.h"

#include "editor-gtk/kit/i18n.h"

#include <stdlib.h>
#include <string.h>

#define NO_MEMORY N_("out of memory")

/* Some steps of a chart, and their connections with the rest. */
struct group {
	struct sfc_edit *edit;
	const bool *step;       /* by step: does it belong to the group?       */
	int macro;              /* the macro-step that they are in; -1: the chart */
	int entry, exit;        /* -1: not known yet                           */
	bool *inner;            /* by transition: does it belong to the group? */
};

static bool refuse(struct group *group, const char *why)
{
	return sfc_edit_refuse(group->edit, why);
}

/* The number of names on one side that are steps of the group; @step: the last of them. */
static int count_in(const struct group *group, int first, int count, int *step)
{
	int found = 0;

	for (int i = first; i < first + count; i++) {
		const int one = group->edit->sfc.ref[i].step;

		if (one < 0 || !group->step[one])
			continue;
		*step = one;
		found++;
	}
	return found;
}

static bool is_written(const struct group *group, int transition)
{
	return group->edit->sfc.transition[transition].macro == group->macro &&
	       sfc_edit_find_piece(group->edit, PIECE_TRANSITION, transition) >= 0;
}

/* All transitions across the border must have the same step. */
static bool take_gate(struct group *group, int count, int step, int *gate,
		      const char *why)
{
	if (count == 0)
		return true;
	if (count > 1 || (*gate >= 0 && *gate != step))
		return refuse(group, why);
	*gate = step;
	return true;
}

#define SEVERAL_IN N_("these steps are entered at several places")
#define SEVERAL_OUT N_("these steps are left at several places")

/* A transition from the exit back to the entry leads from the macro-step to itself. */
static void free_loops(struct group *group)
{
	const struct sfc *sfc = &group->edit->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		if (group->inner[i] && group->exit >= 0 && group->entry >= 0 &&
		    t->from_count == 1 && t->to_count == 1 &&
		    sfc->ref[t->first_from].step == group->exit &&
		    sfc->ref[t->first_to].step == group->entry)
			group->inner[i] = false;
	}
}

/* Finds the inner transitions, and the entry and exit of the others. */
static bool find_gates(struct group *group)
{
	const struct sfc *sfc = &group->edit->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];
		int from = -1, to = -1;

		if (!is_written(group, i))
			continue;
		const int left = count_in(group, t->first_from, t->from_count, &from);
		const int entered = count_in(group, t->first_to, t->to_count, &to);

		group->inner[i] = left && entered && left == t->from_count &&
				  entered == t->to_count;
		if (!group->inner[i] &&
		    (!take_gate(group, left, from, &group->exit, SEVERAL_OUT) ||
		     !take_gate(group, entered, to, &group->entry, SEVERAL_IN)))
			return false;
	}
	free_loops(group);
	return true;
}

/* Does an inner transition leave it? */
static bool leads_on(const struct group *group, int step)
{
	for (int i = 0; i < group->edit->sfc.transition_count; i++)
		if (group->inner[i] && sfc_edit_names_step(group->edit, i, false, step))
			return true;
	return false;
}

/* Without transitions in or out: the first step, and the only one that no transition
 * leaves. */
static bool guess_gates(struct group *group)
{
	const struct sfc *sfc = &group->edit->sfc;
	int ends = 0;

	for (int i = 0; i < sfc->step_count; i++) {
		if (!group->step[i])
			continue;
		if (sfc->step[i].kind == STEP_INITIAL)
			return refuse(group, N_("the initial step cannot go into a macro-step"));
		group->entry = group->entry < 0 ? i : group->entry;
		if (group->exit >= 0 || leads_on(group, i))
			continue;
		ends++;
		if (ends > 1)
			return refuse(group, SEVERAL_OUT);
		group->exit = -2 - i;
	}
	if (group->exit < -1)
		group->exit = -2 - group->exit;
	if (group->exit < 0 || leads_on(group, group->exit))
		return refuse(group, N_("these steps have no last step: add one"));
	if (sfc->step[group->entry].kind == STEP_MACRO)
		return refuse(group, N_("a macro-step cannot begin with another macro-step"));
	return true;
}

static bool check_chosen(struct group *group)
{
	const struct sfc *sfc = &group->edit->sfc;
	bool any = false;

	for (int i = 0; i < sfc->step_count; i++) {
		if (!group->step[i])
			continue;
		if (any && sfc->step[i].macro != group->macro)
			return refuse(group, N_("the selected steps are in different charts"));
		group->macro = sfc->step[i].macro;
		any = true;
	}
	return any || refuse(group, N_("the cursor is not on a step"));
}

/* ---- making ---- */

/* Names of the group in outer transitions become the macro-step. */
static bool lead_to_macro(struct group *group, int macro)
{
	struct sfc_edit *edit = group->edit;

	for (int i = 0; i < edit->sfc.transition_count; i++) {
		struct sfc_transition *t = &edit->sfc.transition[i];

		if (!is_written(group, i) || group->inner[i])
			continue;
		if (!sfc_edit_copy_refs(edit, i, false, -1) ||
		    !sfc_edit_copy_refs(edit, i, true, -1))
			return false;
		for (int k = t->first_from; k < t->first_to + t->to_count; k++) {
			struct sfc_ref *ref = &edit->sfc.ref[k];

			if (ref->step < 0 || !group->step[ref->step])
				continue;
			ref->step = macro;
			ref->name = edit->sfc.step[macro].name;
		}
	}
	return true;
}

/* Does this piece, which is in no macro-step of the group, move inside? */
static bool goes_inside(const struct group *group, const struct sfc_piece *piece)
{
	if (piece->kind == PIECE_STEP || piece->kind == PIECE_MACRO_END)
		return group->step[piece->index];
	return piece->kind == PIECE_TRANSITION && group->inner[piece->index];
}

/* Moves all pieces of the group to the place of the first. */
static bool gather(struct group *group, int macro)
{
	struct sfc *sfc = &group->edit->sfc;
	const int count = sfc->piece_count;
	struct sfc_piece *piece = calloc((size_t)count + 2, sizeof(*piece));
	bool *inside = calloc((size_t)count + 1, sizeof(*inside));
	int deep = -1, out = 0;
	bool done = false;

	for (int i = 0; piece && inside && i < count; i++) {
		const struct sfc_piece *p = &sfc->piece[i];

		inside[i] = deep >= 0 || goes_inside(group, p);
		if (deep < 0 && inside[i] && p->kind == PIECE_STEP &&
		    sfc->step[p->index].kind == STEP_MACRO)
			deep = p->index;
		else if (p->kind == PIECE_MACRO_END && p->index == deep)
			deep = -1;
	}
	for (int i = 0; piece && inside && i < count; i++) {
		if (inside[i] && done)
			continue;
		if (!inside[i]) {
			piece[out++] = sfc->piece[i];
			continue;
		}
		piece[out++] = (struct sfc_piece){ PIECE_STEP, macro };
		for (int k = i; k < count; k++)
			if (inside[k])
				piece[out++] = sfc->piece[k];
		piece[out++] = (struct sfc_piece){ PIECE_MACRO_END, macro };
		done = true;
	}
	for (int i = 0; done && i < 2; i++)
		done = sfc_edit_put_piece(group->edit, sfc->piece_count - 1, PIECE_STEP, 0);
	if (done)
		memcpy(sfc->piece, piece, (size_t)out * sizeof(*piece));
	else
		refuse(group, NO_MEMORY);
	free(piece);
	free(inside);
	return done;
}

static int depth_of(const struct sfc *sfc, int step)
{
	int depth = 0;

	for (; step >= 0 && depth <= LIMIT_MACROS; step = sfc->step[step].macro)
		depth += sfc->step[step].kind == STEP_MACRO;
	return depth;
}

/* Would macro-steps be nested too deep? */
static bool is_too_deep(const struct group *group)
{
	const struct sfc *sfc = &group->edit->sfc;

	for (int i = 0; i < sfc->step_count; i++) {
		int top = i;

		while (top >= 0 && !group->step[top])
			top = sfc->step[top].macro;
		if (top >= 0 && depth_of(sfc, i) >= LIMIT_MACROS)
			return true;
	}
	return false;
}

static int put_inside(struct group *group)
{
	struct sfc *sfc = &group->edit->sfc;
	const int count = sfc->step_count;
	int macro;

	if (is_too_deep(group))
		return refuse(group, N_("macro-steps are nested too deeply")) - 1;
	macro = sfc_edit_push_step(group->edit, STEP_MACRO, group->macro);
	/* @step has no entry for the new one */
	if (macro < 0 || !gather(group, macro) || !lead_to_macro(group, macro))
		return -1;
	for (int i = 0; i < count; i++)
		if (group->step[i])
			sfc->step[i].macro = macro;
	for (int i = 0; i < sfc->transition_count; i++)
		if (group->inner[i])
			sfc->transition[i].macro = macro;
	sfc->step[group->entry].kind = STEP_INITIAL;
	return macro;
}

int sfc_edit_macro_make(struct sfc_edit *edit, const bool *chosen)
{
	const size_t steps = (size_t)edit->sfc.step_count + 1;
	bool *step = calloc(steps, sizeof(*step));
	struct group group = { edit, step, -1, -1, -1,
			       calloc((size_t)edit->sfc.transition_count + 1,
				      sizeof(bool)) };
	int made = -1;

	if (!step || !group.inner)
		refuse(&group, NO_MEMORY);
	else
		memcpy(step, chosen, (steps - 1) * sizeof(*step));
	if (step && group.inner && check_chosen(&group) && find_gates(&group) &&
	    guess_gates(&group))
		made = put_inside(&group);
	free(step);
	free(group.inner);
	return made;
}

/* ---- dissolving ---- */

static bool has_way_on(const struct sfc_edit *edit, int step)
{
	for (int i = 0; i < edit->sfc.transition_count; i++)
		if (sfc_edit_names_step(edit, i, false, step) &&
		    sfc_edit_find_piece(edit, PIECE_TRANSITION, i) >= 0)
			return true;
	return false;
}

/* Its only initial step, and its only step that no transition leaves; false: none or
 * several. */
static bool inside_gates(const struct sfc_edit *edit, int macro, int *entry, int *leave)
{
	int entries = 0, leaves = 0;

	for (int i = 0; i < edit->sfc.step_count; i++) {
		if (edit->sfc.step[i].macro != macro ||
		    sfc_edit_find_piece(edit, PIECE_STEP, i) < 0)
			continue;
		if (edit->sfc.step[i].kind == STEP_INITIAL) {
			*entry = i;
			entries++;
		}
		if (!has_way_on(edit, i)) {
			*leave = i;
			leaves++;
		}
	}
	return entries == 1 && leaves == 1;
}

static bool may_open(struct sfc_edit *edit, int macro)
{
	const struct sfc_step *step = &edit->sfc.step[macro];

	if (step->kind != STEP_MACRO)
		return sfc_edit_refuse(edit, N_("this is not a macro-step"));
	if (step->use_count || step->min || step->max || step->alarm)
		return sfc_edit_refuse(edit, N_("the macro-step has actions or times "
						"of its own: move them into its steps"));
	if (sfc_edit_asks_for(edit, macro))
		return sfc_edit_refuse(edit, N_("the chart uses .X or .T of the "
						"macro-step"));
	return true;
}

static void lead_to_inside(struct sfc_edit *edit, int macro, int entry, int leave)
{
	struct sfc *sfc = &edit->sfc;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];

		for (int k = 0; k < t->from_count + t->to_count; k++) {
			const bool to = k >= t->from_count;
			struct sfc_ref *ref = &sfc->ref[to ? t->first_to + k -
				t->from_count : t->first_from + k];

			if (ref->step != macro)
				continue;
			ref->step = to ? entry : leave;
			ref->name = sfc->step[ref->step].name;
		}
	}
}

int sfc_edit_macro_open(struct sfc_edit *edit, int macro)
{
	struct sfc *sfc = &edit->sfc;
	int entry = -1, leave = -1;

	if (!may_open(edit, macro))
		return -1;
	if (!inside_gates(edit, macro, &entry, &leave))
		return sfc_edit_refuse(edit, N_("the macro-step needs one initial step and "
						"one last step")) - 1;
	lead_to_inside(edit, macro, entry, leave);
	for (int i = 0; i < sfc->step_count; i++)
		if (sfc->step[i].macro == macro)
			sfc->step[i].macro = sfc->step[macro].macro;
	for (int i = 0; i < sfc->transition_count; i++)
		if (sfc->transition[i].macro == macro)
			sfc->transition[i].macro = sfc->step[macro].macro;
	sfc->step[entry].kind = STEP_PLAIN;
	if (!sfc->step[entry].comment)
		sfc->step[entry].comment = sfc->step[macro].comment;
	sfc_edit_drop_piece(edit, sfc_edit_find_piece(edit, PIECE_MACRO_END, macro));
	sfc_edit_drop_piece(edit, sfc_edit_find_piece(edit, PIECE_STEP, macro));
	return entry;
}
