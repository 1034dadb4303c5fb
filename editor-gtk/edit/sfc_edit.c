/* SPDX-License-Identifier: MIT
 *
 * sfc_edit - steps and ways come, go and move; see sfc_edit.h.
 */
#include "editor-gtk/edit/sfc_edit.h"

#include "editor-gtk/kit/i18n.h"
#include "engine/text/pou_print.h"

#include <stdlib.h>
#include <string.h>

#define NO_MEMORY N_("out of memory")

bool sfc_edit_refuse(struct sfc_edit *edit, const char *why)
{
	edit->why = why;
	return false;
}

/* ---- the copy ---- */

/* A vector that arena_push() can go on with. */
static bool copy_vector(struct arena *arena, void *vector, const void *old, int count,
			size_t size)
{
	void *first = NULL;
	int pushed = 0;

	for (int i = 0; i < count; i++) {
		char *to = arena_push(arena, &first, &pushed, size);

		if (!to)
			return false;
		memcpy(to, (const char *)old + (size_t)i * size, size);
	}
	memcpy(vector, &first, sizeof(first));
	return true;
}

static bool copy_chart(struct sfc_edit *edit, const struct pou *pou)
{
	const struct sfc *old = pou->sfc;
	struct sfc *sfc = &edit->sfc;
	struct arena *arena = &edit->arena;

	edit->pou = *pou;
	*sfc = *old;
	edit->pou.sfc = sfc;
	edit->rungs = pou->rung_count;
	return copy_vector(arena, &sfc->step, old->step, old->step_count,
			   sizeof(*old->step)) &&
	       copy_vector(arena, &sfc->use, old->use, old->use_count,
			   sizeof(*old->use)) &&
	       copy_vector(arena, &sfc->transition, old->transition,
			   old->transition_count, sizeof(*old->transition)) &&
	       copy_vector(arena, &sfc->action, old->action, old->action_count,
			   sizeof(*old->action)) &&
	       copy_vector(arena, &sfc->ref, old->ref, old->ref_count,
			   sizeof(*old->ref)) &&
	       copy_vector(arena, &sfc->piece, old->piece, old->piece_count,
			   sizeof(*old->piece)) &&
	       copy_vector(arena, &edit->pou.rung, pou->rung, pou->rung_count,
			   sizeof(struct rung *));
}

struct sfc_edit *sfc_edit_new(struct project *project, const struct pou *pou)
{
	struct sfc_edit *edit = calloc(1, sizeof(*edit));

	if (!edit)
		return NULL;
	edit->project = project;
	arena_init(&edit->arena);
	if (copy_chart(edit, pou))
		return edit;
	sfc_edit_free(edit);
	return NULL;
}

void sfc_edit_free(struct sfc_edit *edit)
{
	if (!edit)
		return;
	for (int i = edit->rungs; i < edit->pou.rung_count; i++)
		rung_free(edit->pou.rung[i]);
	arena_free(&edit->arena);
	free(edit);
}

char *sfc_edit_text(const struct sfc_edit *edit)
{
	return edit->arena.failed ? NULL : pou_print(edit->project, &edit->pou);
}

uint32_t sfc_edit_id(struct sfc_edit *edit, const char *text)
{
	return names_intern(&edit->project->names, text, strlen(text));
}

/* ---- pieces: what stands where in the file ---- */

bool sfc_edit_put_piece(struct sfc_edit *edit, int at, enum piece_kind kind, int index)
{
	struct sfc *sfc = &edit->sfc;
	struct sfc_piece *piece = arena_push(&edit->arena, &sfc->piece, &sfc->piece_count,
					   sizeof(*piece));

	if (!piece)
		return sfc_edit_refuse(edit, NO_MEMORY);
	piece = sfc->piece + at + 1;
	memmove(piece + 1, piece, (size_t)(sfc->piece_count - at - 2) * sizeof(*piece));
	*piece = (struct sfc_piece){ kind, index };
	return true;
}

int sfc_edit_find_piece(const struct sfc_edit *edit, enum piece_kind kind, int index)
{
	for (int i = 0; i < edit->sfc.piece_count; i++)
		if (edit->sfc.piece[i].kind == kind && edit->sfc.piece[i].index == index)
			return i;
	return -1;
}

static void drop_pieces(struct sfc_edit *edit, int first, int last)
{
	struct sfc *sfc = &edit->sfc;

	if (first < 0 || last < first)
		return;
	memmove(sfc->piece + first, sfc->piece + last + 1,
		(size_t)(sfc->piece_count - last - 1) * sizeof(*sfc->piece));
	sfc->piece_count -= last - first + 1;
}

/* The last piece of a step: of a macro-step that of its END_STEP. */
int sfc_edit_step_end(const struct sfc_edit *edit, int step)
{
	return sfc_edit_find_piece(edit, edit->sfc.step[step].kind == STEP_MACRO ?
			 PIECE_MACRO_END : PIECE_STEP, step);
}

/* Is it still written? */
static bool has_transition(const struct sfc_edit *edit, int transition)
{
	return sfc_edit_find_piece(edit, PIECE_TRANSITION, transition) >= 0;
}

/* ---- ways ---- */

static int *first_of(struct sfc_transition *t, bool to)
{
	return to ? &t->first_to : &t->first_from;
}

static int *count_of(struct sfc_transition *t, bool to)
{
	return to ? &t->to_count : &t->from_count;
}

static bool names_step(const struct sfc_edit *edit, const struct sfc_transition *t, bool to,
		       int step)
{
	const int first = to ? t->first_to : t->first_from;
	const int count = to ? t->to_count : t->from_count;

	for (int i = first; i < first + count; i++)
		if (edit->sfc.ref[i].step == step)
			return true;
	return false;
}

static bool put_ref(struct sfc_edit *edit, uint32_t name, int step)
{
	struct sfc *sfc = &edit->sfc;
	struct sfc_ref *ref = arena_push(&edit->arena, &sfc->ref, &sfc->ref_count,
					 sizeof(*ref));

	if (!ref)
		return sfc_edit_refuse(edit, NO_MEMORY);
	*ref = (struct sfc_ref){ .name = name, .step = step };
	return true;
}

/* A copy of the names of one side behind all others, without @skip, where it may grow. */
bool sfc_edit_copy_refs(struct sfc_edit *edit, int transition, bool to, int skip)
{
	struct sfc_transition *t = &edit->sfc.transition[transition];
	const int old = *first_of(t, to), count = *count_of(t, to);
	const int first = edit->sfc.ref_count;

	for (int i = old; i < old + count; i++) {
		const struct sfc_ref ref = edit->sfc.ref[i];

		if (i != skip && !put_ref(edit, ref.name, ref.step))
			return false;
	}
	*first_of(t, to) = first;
	*count_of(t, to) = edit->sfc.ref_count - first;
	return true;
}

static bool add_step(struct sfc_edit *edit, int transition, bool to, int step)
{
	return sfc_edit_copy_refs(edit, transition, to, -1) &&
	       put_ref(edit, edit->sfc.step[step].name, step) &&
	       (*count_of(&edit->sfc.transition[transition], to))++ >= 0;
}

/* One name becomes those that another transition leads to. */
static bool replace_ref(struct sfc_edit *edit, int transition, int ref, int like)
{
	struct sfc_transition *t = &edit->sfc.transition[transition];
	const struct sfc_transition other = edit->sfc.transition[like];
	const int old = t->first_to, count = t->to_count, first = edit->sfc.ref_count;

	for (int i = old; i < old + count; i++) {
		const struct sfc_ref one = edit->sfc.ref[i];

		if (i != ref && !put_ref(edit, one.name, one.step))
			return false;
		for (int k = 0; i == ref && k < other.to_count; k++) {
			const struct sfc_ref next = edit->sfc.ref[other.first_to + k];

			if (!put_ref(edit, next.name, next.step))
				return false;
		}
	}
	t->first_to = first;
	t->to_count = edit->sfc.ref_count - first;
	return true;
}

/* ---- new ones ---- */

int sfc_edit_new_step(struct sfc_edit *edit, int macro, int behind)
{
	struct sfc *sfc = &edit->sfc;
	const uint32_t name = sfc_edit_id(edit, sfc_edit_free_name(edit, "Step"));
	struct sfc_step *step;

	if (sfc->step_count >= LIMIT_STEPS)
		return sfc_edit_refuse(edit, N_("there are too many steps")) - 1;
	step = arena_push(&edit->arena, &sfc->step, &sfc->step_count, sizeof(*step));
	if (!step || !name)
		return sfc_edit_refuse(edit, NO_MEMORY) - 1;
	*step = (struct sfc_step){ .name = name, .macro = macro,
				   .first_use = sfc->use_count };
	return sfc_edit_put_piece(edit, behind, PIECE_STEP, sfc->step_count - 1) ?
	       sfc->step_count - 1 : -1;
}

/* From @from (-1: none) to @to, behind a piece. */
int sfc_edit_new_transition(struct sfc_edit *edit, int macro, int from, int to, int behind)
{
	struct sfc *sfc = &edit->sfc;
	struct sfc_transition *t;
	const int number = sfc->transition_count;

	if (number >= 2 * LIMIT_STEPS)
		return sfc_edit_refuse(edit, N_("there are too many transitions")) - 1;
	t = arena_push(&edit->arena, &sfc->transition, &sfc->transition_count, sizeof(*t));
	if (!t)
		return sfc_edit_refuse(edit, NO_MEMORY) - 1;
	*t = (struct sfc_transition){ .macro = macro, .first_from = sfc->ref_count,
				      .first_to = sfc->ref_count };
	if ((from >= 0 && !add_step(edit, number, false, from)) ||
	    (to >= 0 && !add_step(edit, number, true, to)) ||
	    !sfc_edit_put_piece(edit, behind, PIECE_TRANSITION, number))
		return -1;
	return number;
}

/* Behind a step and all ways out of it, so that a new one is the last of them. */
static int behind_ways(const struct sfc_edit *edit, int step)
{
	int at = sfc_edit_step_end(edit, step);

	for (int i = at + 1; i < edit->sfc.piece_count; i++) {
		const struct sfc_piece *piece = &edit->sfc.piece[i];

		if (piece->kind == PIECE_TRANSITION &&
		    names_step(edit, &edit->sfc.transition[piece->index], false, step))
			at = i;
	}
	return at;
}

int sfc_edit_step_below(struct sfc_edit *edit, int step)
{
	const int count = edit->sfc.transition_count;
	const int macro = edit->sfc.step[step].macro;
	const int made = sfc_edit_new_step(edit, macro, sfc_edit_step_end(edit, step));

	if (made < 0)
		return -1;
	for (int t = 0; t < count; t++) {
		struct sfc_transition *transition = &edit->sfc.transition[t];

		if (!names_step(edit, transition, false, step) || !has_transition(edit, t))
			continue;
		if (!sfc_edit_copy_refs(edit, t, false, -1))
			return -1;
		for (int i = 0; i < transition->from_count; i++) {
			struct sfc_ref *ref = &edit->sfc.ref[transition->first_from + i];

			if (ref->step == step)
				*ref = (struct sfc_ref){ .step = made,
					.name = edit->sfc.step[made].name };
		}
	}
	return sfc_edit_new_transition(edit, macro, step, made,
				       sfc_edit_step_end(edit, step)) < 0 ? -1 : made;
}

int sfc_edit_step_after(struct sfc_edit *edit, int transition)
{
	const struct sfc_transition old = edit->sfc.transition[transition];
	const int made = sfc_edit_new_step(edit, old.macro,
				  sfc_edit_find_piece(edit, PIECE_TRANSITION, transition));
	struct sfc_transition *t;
	int next;

	if (made < 0)
		return -1;
	if (old.to_count) {
		next = sfc_edit_new_transition(edit, old.macro, made, -1,
					       sfc_edit_step_end(edit, made));
		if (next < 0)
			return -1;
		edit->sfc.transition[next].first_to = old.first_to;
		edit->sfc.transition[next].to_count = old.to_count;
	}
	t = &edit->sfc.transition[transition];
	t->first_to = edit->sfc.ref_count;
	t->to_count = 0;
	return add_step(edit, transition, true, made) ? made : -1;
}

int sfc_edit_branch(struct sfc_edit *edit, int step)
{
	const int macro = edit->sfc.step[step].macro;
	const int way = sfc_edit_new_transition(edit, macro, step, -1, behind_ways(edit, step));
	int made;

	if (way < 0)
		return -1;
	made = sfc_edit_new_step(edit, macro, sfc_edit_find_piece(edit, PIECE_TRANSITION, way));
	return made >= 0 && add_step(edit, way, true, made) ? made : -1;
}

int sfc_edit_parallel(struct sfc_edit *edit, int transition)
{
	const struct sfc_transition *t = &edit->sfc.transition[transition];
	const int last = t->to_count ? edit->sfc.ref[t->first_to + t->to_count - 1].step :
			 -1;
	const int behind = last >= 0 ? sfc_edit_step_end(edit, last) :
			   sfc_edit_find_piece(edit, PIECE_TRANSITION, transition);
	const int made = sfc_edit_new_step(edit, t->macro, behind);

	return made >= 0 && add_step(edit, transition, true, made) ? made : -1;
}

int sfc_edit_first(struct sfc_edit *edit, int macro)
{
	bool any = false;
	int at = macro >= 0 ? sfc_edit_step_end(edit, macro) - 1 :
		 edit->sfc.piece_count - 1, made;

	for (int i = 0; i < edit->sfc.step_count; i++)
		any |= edit->sfc.step[i].macro == macro &&
		       sfc_edit_find_piece(edit, PIECE_STEP, i) >= 0;
	/* Before the actions. */
	while (macro < 0 && at >= 0 && edit->sfc.piece[at].kind == PIECE_ACTION)
		at--;
	made = sfc_edit_new_step(edit, macro, at);
	if (made >= 0 && !any)
		edit->sfc.step[made].kind = STEP_INITIAL;
	return made;
}

int sfc_edit_lead(struct sfc_edit *edit, int from, int to)
{
	if (edit->sfc.step[from].macro != edit->sfc.step[to].macro)
		return sfc_edit_refuse(edit, N_("no way leads past the border of a "
						"macro-step")) - 1;
	return sfc_edit_new_transition(edit, edit->sfc.step[from].macro, from, to,
			      behind_ways(edit, from));
}

bool sfc_edit_set_ways(struct sfc_edit *edit, int transition, bool to, const char *names)
{
	struct sfc_transition *t = &edit->sfc.transition[transition];
	const int first = edit->sfc.ref_count;

	for (const char *at = names; *at;) {
		const size_t len = strcspn(at, ", \t");
		uint32_t name;

		if (len > 0) {
			if (len > LIMIT_NAME || edit->sfc.ref_count - first >= LIMIT_BRANCHES)
				return sfc_edit_refuse(edit, N_("this is too long"));
			name = names_intern(&edit->project->names, at, len);
			if (!put_ref(edit, name, sfc_find_step(&edit->sfc,
					&edit->project->names, name)))
				return false;
		}
		at += len + (at[len] != '\0');
	}
	if (edit->sfc.ref_count == first)
		return sfc_edit_refuse(edit, N_("the name of a step is missing"));
	*first_of(t, to) = first;
	*count_of(t, to) = edit->sfc.ref_count - first;
	return true;
}

bool sfc_edit_wait(struct sfc_edit *edit, int transition, int step)
{
	const struct sfc_transition *t = &edit->sfc.transition[transition];

	if (t->macro != edit->sfc.step[step].macro)
		return sfc_edit_refuse(edit, N_("no way leads past the border of a "
						"macro-step"));
	if (names_step(edit, t, false, step))
		return sfc_edit_refuse(edit, N_("it waits for that step already"));
	if (t->from_count >= LIMIT_BRANCHES)
		return sfc_edit_refuse(edit, N_("there are too many branches"));
	return add_step(edit, transition, false, step);
}

/* ---- deleting ---- */

bool sfc_edit_delete_transition(struct sfc_edit *edit, int transition)
{
	const int at = sfc_edit_find_piece(edit, PIECE_TRANSITION, transition);

	drop_pieces(edit, at, at);
	return at >= 0;
}

bool sfc_edit_cut_way(struct sfc_edit *edit, int transition, int ref)
{
	struct sfc_transition *t = &edit->sfc.transition[transition];
	const bool to = ref >= t->first_to && ref < t->first_to + t->to_count;

	if (*count_of(t, to) < 2)
		return sfc_edit_delete_transition(edit, transition);
	return sfc_edit_copy_refs(edit, transition, to, ref);
}

/* The one way out of a step, if it leaves no other step; -1: none, or several. */
static int only_way(const struct sfc_edit *edit, int step)
{
	int found = -1;

	for (int t = 0; t < edit->sfc.transition_count; t++) {
		const struct sfc_transition *transition = &edit->sfc.transition[t];

		if (!has_transition(edit, t) || !names_step(edit, transition, false, step))
			continue;
		if (found >= 0 || transition->from_count > 1 ||
		    names_step(edit, transition, true, step))
			return -1;
		found = t;
	}
	return found;
}

/* A transition that led to the step leads to what followed it; if nothing did, or if it
 * came from the step, the name goes. */
static bool loosen(struct sfc_edit *edit, int transition, int step, int way)
{
	for (int side = 0; side < 2; side++) {
		struct sfc_transition *t = &edit->sfc.transition[transition];
		const int first = *first_of(t, side), count = *count_of(t, side);

		for (int i = first; i < first + count; i++) {
			if (edit->sfc.ref[i].step != step)
				continue;
			if (side && way >= 0 && way != transition)
				return replace_ref(edit, transition, i, way);
			if (!sfc_edit_cut_way(edit, transition, i))
				return false;
			side = has_transition(edit, transition) ? side - 1 : 2;
			break;
		}
	}
	return true;
}

bool sfc_edit_delete_step(struct sfc_edit *edit, int step)
{
	const int way = only_way(edit, step);

	if (sfc_edit_find_piece(edit, PIECE_STEP, step) < 0)
		return sfc_edit_refuse(edit, N_("there is no step here"));
	for (int t = 0; t < edit->sfc.transition_count; t++)
		if (t != way && has_transition(edit, t) && !loosen(edit, t, step, way))
			return false;
	if (way >= 0)
		sfc_edit_delete_transition(edit, way);
	drop_pieces(edit, sfc_edit_find_piece(edit, PIECE_STEP, step),
		    sfc_edit_step_end(edit, step));
	return true;
}

/* ---- moving ---- */

static void swap_ints(int *a, int *b)
{
	int other = *a;

	*a = *b;
	*b = other;
}

/* Does @a come before @b when a step asks its ways on? */
static bool comes_before(const struct sfc_edit *edit, int a, int b)
{
	const int x = edit->sfc.transition[a].priority, y = edit->sfc.transition[b].priority;

	if (x != y && (x == 0 || y == 0))
		return x != 0;
	return x != y ? x < y : sfc_edit_find_piece(edit, PIECE_TRANSITION, a) <
				sfc_edit_find_piece(edit, PIECE_TRANSITION, b);
}

/* The nearest way out of the same step before or behind @transition; -1: none. */
static int neighbour(const struct sfc_edit *edit, int transition, bool right)
{
	const struct sfc_transition *t = &edit->sfc.transition[transition];
	const int step = t->from_count ? edit->sfc.ref[t->first_from].step : -1;
	int best = -1;

	for (int i = 0; step >= 0 && i < edit->sfc.transition_count; i++) {
		if (i == transition || !has_transition(edit, i) ||
		    !names_step(edit, &edit->sfc.transition[i], false, step) ||
		    comes_before(edit, i, transition) == right)
			continue;
		if (best < 0 || comes_before(edit, i, best) == right)
			best = i;
	}
	return best;
}

static bool move_way(struct sfc_edit *edit, int transition, bool right)
{
	const int other = neighbour(edit, transition, right);
	struct sfc_transition *t = edit->sfc.transition;
	int a, b;

	if (other < 0)
		return sfc_edit_refuse(edit, N_("there is no branch on that side"));
	a = sfc_edit_find_piece(edit, PIECE_TRANSITION, transition);
	b = sfc_edit_find_piece(edit, PIECE_TRANSITION, other);
	swap_ints(&edit->sfc.piece[a].index, &edit->sfc.piece[b].index);
	swap_ints(&t[transition].priority, &t[other].priority);
	return true;
}

bool sfc_edit_move(struct sfc_edit *edit, int step, int transition, bool right)
{
	for (int i = 0; step >= 0 && transition < 0 && i < edit->sfc.transition_count; i++)
		if (has_transition(edit, i) &&
		    names_step(edit, &edit->sfc.transition[i], true, step))
			transition = i;
	if (transition < 0)
		return sfc_edit_refuse(edit, N_("there is no branch on that side"));
	struct sfc_transition *t = &edit->sfc.transition[transition];
	if (step < 0 || t->to_count < 2)
		return move_way(edit, transition, right);
	if (!sfc_edit_copy_refs(edit, transition, true, -1))
		return false;
	for (int i = t->first_to; i < t->first_to + t->to_count; i++) {
		const int other = i + (right ? 1 : -1);
		struct sfc_ref kept = edit->sfc.ref[i];

		if (kept.step != step)
			continue;
		if (other < t->first_to || other >= t->first_to + t->to_count)
			break;
		edit->sfc.ref[i] = edit->sfc.ref[other];
		edit->sfc.ref[other] = kept;
		return true;
	}
	return sfc_edit_refuse(edit, N_("there is no branch on that side"));
}
