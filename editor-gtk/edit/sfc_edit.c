/* SPDX-License-Identifier: MIT
 *
 * sfc_edit - edits of steps and transitions, names, conditions, comments, and actions of
 * steps; see sfc_edit.h.
 */
#include "editor-gtk/edit/sfc_edit.h"

#include "editor-gtk/edit/entry.h"
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/text/pou_print.h"
#include "engine/base/ascii.h"
#include "engine/base/lex.h"
#include "engine/base/sink.h"
#include "engine/model/expr.h"
#include "engine/model/st.h"
#include "engine/base/name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define NO_MEMORY N_("out of memory")

bool sfc_edit_refuse(struct sfc_edit *edit, const char *why)
{
	edit->why = why;
	return false;
}

/* ---- the copy ---- */

/* Copies a vector so that arena_push() can extend it. */
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

static uint32_t sfc_edit_id(struct sfc_edit *edit, const char *text)
{
	return names_intern(&edit->project->names, text, strlen(text));
}

/* ---- pieces: the order of steps and transitions in the file ---- */

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

void sfc_edit_drop_piece(struct sfc_edit *edit, int at)
{
	drop_pieces(edit, at, at);
}

/* The last piece of a step; for a macro-step its END_STEP. */
int sfc_edit_step_end(const struct sfc_edit *edit, int step)
{
	return sfc_edit_find_piece(edit, edit->sfc.step[step].kind == STEP_MACRO ?
			 PIECE_MACRO_END : PIECE_STEP, step);
}

/* Is it still in the file? */
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

bool sfc_edit_names_step(const struct sfc_edit *edit, int transition, bool to, int step)
{
	const struct sfc_transition *t = &edit->sfc.transition[transition];
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

/* Copies the names of one side to the end of sfc.ref, where they can grow; without @skip. */
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

/* Replaces one name by those that another transition leads to. */
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

/* ---- names ---- */

static bool is_called(const struct sfc_edit *edit, uint32_t id, const char *name)
{
	return id && name_equal(project_text(edit->project, id), name);
}

static bool is_taken(const struct sfc_edit *edit, const char *name)
{
	const struct sfc *sfc = &edit->sfc;
	const struct var_table *tables[] = { &edit->pou.vars, &edit->project->globals };

	for (int i = 0; i < sfc->step_count; i++)
		if (is_called(edit, sfc->step[i].name, name))
			return true;
	for (int i = 0; i < sfc->transition_count; i++)
		if (is_called(edit, sfc->transition[i].name, name))
			return true;
	for (int i = 0; i < sfc->action_count; i++)
		if (is_called(edit, sfc->action[i].name, name))
			return true;
	for (int t = 0; t < 2; t++)
		for (int i = 0; i < tables[t]->count; i++)
			if (is_called(edit, tables[t]->var[i].name, name))
				return true;
	return words_is_taken(name);
}

/* "Step3": a name that is not used. Lives as long as the edit. */
static const char *sfc_edit_free_name(struct sfc_edit *edit, const char *base)
{
	char name[64];

	for (int i = 1;; i++) {
		snprintf(name, sizeof(name), "%.40s%d", base, i);
		if (!is_taken(edit, name))
			break;
	}
	return project_text(edit->project, sfc_edit_id(edit, name));
}

/* Is it a valid and unused name? */
static bool can_be_called(struct sfc_edit *edit, const char *name)
{
	struct lex lex;

	lex_init(&lex, name, strlen(name));
	if (lex_next(&lex) != TOKEN_NAME || lex.token.len != strlen(name) ||
	    lex.token.len > LIMIT_NAME || strchr(name, '.'))
		return sfc_edit_refuse(edit, N_("this is not a name"));
	if (is_taken(edit, name))
		return sfc_edit_refuse(edit, N_("this name is used already"));
	return true;
}

bool sfc_edit_hand_over(struct sfc_edit *edit, int step, int other, int ways)
{
	for (int t = 0; t < ways; t++) {
		const struct sfc_transition *way = &edit->sfc.transition[t];

		if (!sfc_edit_names_step(edit, t, false, step) || !has_transition(edit, t))
			continue;
		if (!sfc_edit_copy_refs(edit, t, false, -1))
			return false;
		for (int i = 0; i < way->from_count; i++) {
			struct sfc_ref *ref = &edit->sfc.ref[way->first_from + i];

			if (ref->step == step)
				*ref = (struct sfc_ref){ .step = other,
					.name = edit->sfc.step[other].name };
		}
	}
	return true;
}

/* ---- new ones ---- */

int sfc_edit_push_step(struct sfc_edit *edit, enum step_kind kind, int macro)
{
	struct sfc *sfc = &edit->sfc;
	const uint32_t name = sfc_edit_id(edit, sfc_edit_free_name(edit, kind == STEP_MACRO ?
									  "Macro" : "Step"));
	struct sfc_step *step;

	if (sfc->step_count >= LIMIT_STEPS)
		return sfc_edit_refuse(edit, N_("the chart has too many steps")) - 1;
	step = arena_push(&edit->arena, &sfc->step, &sfc->step_count, sizeof(*step));
	if (!step || !name)
		return sfc_edit_refuse(edit, NO_MEMORY) - 1;
	*step = (struct sfc_step){ .name = name, .kind = kind, .macro = macro,
				   .first_use = sfc->use_count };
	return sfc->step_count - 1;
}

int sfc_edit_new_step(struct sfc_edit *edit, int macro, int behind)
{
	const int made = sfc_edit_push_step(edit, STEP_PLAIN, macro);

	return made >= 0 && sfc_edit_put_piece(edit, behind, PIECE_STEP, made) ? made : -1;
}

/* From @from (-1: none) to @to, behind piece @behind. */
int sfc_edit_new_transition(struct sfc_edit *edit, int macro, int from, int to, int behind)
{
	struct sfc *sfc = &edit->sfc;
	struct sfc_transition *t;
	const int number = sfc->transition_count;

	if (number >= 2 * LIMIT_STEPS)
		return sfc_edit_refuse(edit, N_("the chart has too many transitions")) - 1;
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

/* Behind a step and all its transitions, so that a new one is the last. */
static int behind_ways(const struct sfc_edit *edit, int step)
{
	int at = sfc_edit_step_end(edit, step);

	for (int i = at + 1; i < edit->sfc.piece_count; i++) {
		const struct sfc_piece *piece = &edit->sfc.piece[i];

		if (piece->kind == PIECE_TRANSITION &&
		    sfc_edit_names_step(edit, piece->index, false, step))
			at = i;
	}
	return at;
}

int sfc_edit_step_below(struct sfc_edit *edit, int step)
{
	const int count = edit->sfc.transition_count;
	const int macro = edit->sfc.step[step].macro;
	const int made = sfc_edit_new_step(edit, macro, sfc_edit_step_end(edit, step));

	if (made < 0 || !sfc_edit_hand_over(edit, step, made, count))
		return -1;
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
	/* before the actions */
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
		return sfc_edit_refuse(edit, N_("a link cannot cross the border of "
						"a macro-step")) - 1;
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
			if (len > LIMIT_NAME)
				return sfc_edit_refuse(edit, N_("this is not a name"));
			if (edit->sfc.ref_count - first >= LIMIT_BRANCHES)
				return sfc_edit_refuse(edit, N_("there are too many branches"));
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
		return sfc_edit_refuse(edit, N_("a link cannot cross the border of "
						"a macro-step"));
	if (sfc_edit_names_step(edit, transition, false, step))
		return sfc_edit_refuse(edit, N_("the transition waits for this step already"));
	if (t->from_count >= LIMIT_BRANCHES)
		return sfc_edit_refuse(edit, N_("there are too many branches"));
	return add_step(edit, transition, false, step);
}

/* ---- deleting ---- */

bool sfc_edit_delete_transition(struct sfc_edit *edit, int transition)
{
	const int at = sfc_edit_find_piece(edit, PIECE_TRANSITION, transition);

	sfc_edit_drop_piece(edit, at);
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

/* The one transition that leaves only this step; -1: none, or several. */
static int only_way(const struct sfc_edit *edit, int step)
{
	int found = -1;

	for (int t = 0; t < edit->sfc.transition_count; t++) {
		const struct sfc_transition *transition = &edit->sfc.transition[t];

		if (!has_transition(edit, t) || !sfc_edit_names_step(edit, t, false, step))
			continue;
		if (found >= 0 || transition->from_count > 1 ||
		    sfc_edit_names_step(edit, t, true, step))
			return -1;
		found = t;
	}
	return found;
}

/* For a deleted step: transitions to it lead to its successors. Without any, or if the
 * transition came from the step itself, the name is deleted. */
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

/* Is transition @a tried before @b? */
static bool comes_before(const struct sfc_edit *edit, int a, int b)
{
	const int x = edit->sfc.transition[a].priority, y = edit->sfc.transition[b].priority;

	if (x != y && (x == 0 || y == 0))
		return x != 0;
	return x != y ? x < y : sfc_edit_find_piece(edit, PIECE_TRANSITION, a) <
				sfc_edit_find_piece(edit, PIECE_TRANSITION, b);
}

/* The neighbour of @transition among those that leave the same step; -1: none. */
static int neighbour(const struct sfc_edit *edit, int transition, bool right)
{
	const struct sfc_transition *t = &edit->sfc.transition[transition];
	const int step = t->from_count ? edit->sfc.ref[t->first_from].step : -1;
	int best = -1;

	for (int i = 0; step >= 0 && i < edit->sfc.transition_count; i++) {
		if (i == transition || !has_transition(edit, i) ||
		    !sfc_edit_names_step(edit, i, false, step) ||
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
		    sfc_edit_names_step(edit, i, true, step))
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

/* ---- steps and transitions get other names ---- */

static bool is_letter(char c)
{
	return ascii_digit(c) || (ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z') ||
	       c == '_' || (unsigned char)c >= 0x80;
}

/* Finds the name @old with .X or .T in @text, and how long it is there; NULL: none. */
static const char *find_member(const char *text, const char *old, size_t *len)
{
	for (const char *at = text; *at; at++) {
		if (at > text && (is_letter(at[-1]) || strchr(".#", at[-1])))
			continue;
		for (*len = 0; is_letter(at[*len]);)
			++*len;
		if (name_is(old, at, *len) && at[*len] == '.' &&
		    at[*len + 1] && strchr("XxTt", at[*len + 1]) &&
		    !is_letter(at[*len + 2]))
			return at;
	}
	return NULL;
}

static bool has_member(const char *text, const char *old)
{
	size_t len;

	return find_member(text, old, &len) != NULL;
}

/* The text with all of them renamed; 0: no memory. */
static uint32_t with_name(struct sfc_edit *edit, uint32_t id, const char *old,
			  const char *name)
{
	const char *text = project_text(edit->project, id), *found;
	struct sink_memory memory;
	struct sink sink;
	size_t len;

	if (!id || !find_member(text, old, &len))
		return id;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	for (; (found = find_member(text, old, &len)) != NULL; text = found + len) {
		sink_write(&sink, text, (size_t)(found - text));
		sink_text(&sink, name);
	}
	sink_text(&sink, text);
	id = memory.failed ? 0 : sfc_edit_id(edit, sink_memory_text(&memory));
	sink_memory_free(&memory);
	return id;
}

/* Replaces a shared rung by a copy that may be changed. The copy is also added behind all
 * rungs, where those of the edit are. NULL: no memory. */
static struct rung *own_copy(struct sfc_edit *edit, int at)
{
	struct rung **to = arena_push(&edit->arena, &edit->pou.rung,
				      &edit->pou.rung_count, sizeof(*to));

	if (!to)
		return NULL;
	*to = rung_copy(edit->pou.rung[at]);
	if (!*to)
		edit->pou.rung_count--;
	else
		edit->pou.rung[at] = *to;
	return edit->pou.rung[at];
}

/* Rungs are copied before they are changed. */
static bool rename_in_rungs(struct sfc_edit *edit, const char *old, const char *name)
{
	const int first = edit->pou.rung_count;

	for (int i = 0; i < first; i++) {
		struct rung *rung = edit->pou.rung[i];
		bool named = false;

		for (int c = 0; c < rung->rows * rung->cols; c++)
			named |= has_member(project_text(edit->project,
							  rung->cell[c].operand), old) ||
				 has_member(project_text(edit->project,
							  rung->cell[c].args), old);
		if (!named)
			continue;
		if (i < edit->rungs) {
			rung = own_copy(edit, i);
			if (!rung)
				return sfc_edit_refuse(edit, NO_MEMORY);
		}
		for (int c = 0; c < rung->rows * rung->cols; c++) {
			rung->cell[c].operand = with_name(edit, rung->cell[c].operand, old,
							  name);
			rung->cell[c].args = with_name(edit, rung->cell[c].args, old, name);
		}
	}
	return true;
}

static bool rename_in_list(struct sfc_edit *edit, const char *old, const char *name)
{
	struct il_line *line = arena_alloc(&edit->arena, ((size_t)edit->pou.il.count + 1) *
					   sizeof(*line));

	if (!line)
		return sfc_edit_refuse(edit, NO_MEMORY);
	if (edit->pou.il.count)
		memcpy(line, edit->pou.il.line, (size_t)edit->pou.il.count * sizeof(*line));
	for (int i = 0; i < edit->pou.il.count; i++)
		line[i].operand = with_name(edit, line[i].operand, old, name);
	edit->pou.il.line = line;
	return true;
}

/* A copy of the statements that may be changed, with room for one more. NULL: no memory. */
static struct st *own_text(struct sfc_edit *edit)
{
	const struct st none = { .item = NULL };
	const struct st *st = edit->pou.st ? edit->pou.st : &none;
	struct st *own = arena_alloc(&edit->arena, sizeof(*own));

	if (own)
		own->item = arena_alloc(&edit->arena, ((size_t)st->count + 1) * sizeof(*own->item));
	if (!own || !own->item)
		return NULL;
	for (; own->count < st->count; own->count++)
		own->item[own->count] = st->item[own->count];
	return own;
}

static bool rename_in_text(struct sfc_edit *edit, const char *old, const char *name)
{
	struct st *own = edit->pou.st ? own_text(edit) : NULL;

	if (!own)
		return !edit->pou.st || sfc_edit_refuse(edit, NO_MEMORY);
	for (int i = 0; i < own->count; i++)
		if (own->item[i].kind != ST_COMMENT)
			own->item[i].text = with_name(edit, own->item[i].text, old, name);
	edit->pou.st = own;
	return true;
}

/* Renames in times of steps and in their actions. */
static void rename_in_steps(struct sfc_edit *edit, const char *old, const char *name)
{
	struct sfc *sfc = &edit->sfc;

	for (int i = 0; i < sfc->use_count; i++) {
		sfc->use[i].time = with_name(edit, sfc->use[i].time, old, name);
		sfc->use[i].operand = with_name(edit, sfc->use[i].operand, old, name);
	}
	for (int i = 0; i < sfc->step_count; i++) {
		sfc->step[i].min = with_name(edit, sfc->step[i].min, old, name);
		sfc->step[i].max = with_name(edit, sfc->step[i].max, old, name);
		sfc->step[i].alarm = with_name(edit, sfc->step[i].alarm, old, name);
	}
}

bool sfc_edit_asks_for(const struct sfc_edit *edit, int step)
{
	const struct sfc *sfc = &edit->sfc;
	const char *name = project_text(edit->project, sfc->step[step].name);
	bool found = false;

	for (int i = 0; i < edit->pou.rung_count && !found; i++) {
		const struct rung *rung = edit->pou.rung[i];

		for (int c = 0; c < rung->rows * rung->cols; c++)
			found |= has_member(project_text(edit->project,
						rung->cell[c].operand), name) ||
				 has_member(project_text(edit->project,
						rung->cell[c].args), name);
	}
	for (int i = 0; i < edit->pou.il.count && !found; i++)
		found = has_member(project_text(edit->project,
						 edit->pou.il.line[i].operand), name);
	for (int i = 0; edit->pou.st && i < edit->pou.st->count && !found; i++)
		found = edit->pou.st->item[i].kind != ST_COMMENT &&
			has_member(project_text(edit->project, edit->pou.st->item[i].text), name);
	for (int i = 0; i < sfc->use_count && !found; i++)
		found = has_member(project_text(edit->project, sfc->use[i].time), name);
	for (int i = 0; i < sfc->step_count && !found; i++)
		found = has_member(project_text(edit->project, sfc->step[i].min), name) ||
			has_member(project_text(edit->project, sfc->step[i].max), name);
	return found;
}

bool sfc_edit_name_step(struct sfc_edit *edit, int step, const char *name)
{
	struct sfc *sfc = &edit->sfc;
	const uint32_t old = sfc->step[step].name;
	const uint32_t id = sfc_edit_id(edit, name);

	if (names_fold(&edit->project->names, id) !=
	    names_fold(&edit->project->names, old) && !can_be_called(edit, name))
		return false;
	sfc->step[step].name = id;
	for (int i = 0; i < sfc->ref_count; i++)
		if (sfc->ref[i].step == step)
			sfc->ref[i].name = id;
	rename_in_steps(edit, project_text(edit->project, old), name);
	return rename_in_rungs(edit, project_text(edit->project, old), name) &&
	       rename_in_list(edit, project_text(edit->project, old), name) &&
	       rename_in_text(edit, project_text(edit->project, old), name);
}

bool sfc_edit_name_transition(struct sfc_edit *edit, int transition, const char *name)
{
	if (*name && !is_called(edit, edit->sfc.transition[transition].name, name) &&
	    !can_be_called(edit, name))
		return false;
	edit->sfc.transition[transition].name = sfc_edit_id(edit, name);
	return true;
}

bool sfc_edit_set_priority(struct sfc_edit *edit, int transition, int priority)
{
	if (priority < 0 || priority > 65535)
		return sfc_edit_refuse(edit, N_("the priority is a number from 1 to 65535"));
	edit->sfc.transition[transition].priority = priority;
	return true;
}

bool sfc_edit_set_kind(struct sfc_edit *edit, int step, enum step_kind kind)
{
	if (edit->sfc.step[step].kind == STEP_MACRO || kind == STEP_MACRO)
		return sfc_edit_refuse(edit, N_("a macro-step cannot become another kind of step"));
	edit->sfc.step[step].kind = kind;
	return true;
}

/* A single operand or literal, as it stands between commas in the file. */
static bool is_word(const char *text)
{
	return strlen(text) < 200 && !strpbrk(text, ",;()|\n\r\t \"");
}

/* 5s becomes T#5s; a name stays. */
static void spell_time(const char *word, char *out, size_t size)
{
	bool fits;

	out[0] = '\0';
	if (!entry_literal(word, strlen(word), out, size, &fits) || !fits)
		snprintf(out, size, "%s", word);
}

bool sfc_edit_set_times(struct sfc_edit *edit, int step, const char *min, const char *max,
			const char *alarm)
{
	struct sfc_step *s = &edit->sfc.step[step];
	char time[ENTRY_NAME];

	if (!is_word(min) || !is_word(max) || !is_word(alarm))
		return sfc_edit_refuse(edit, N_("write a time, such as T#5s, or the name of a bit"));
	spell_time(min, time, sizeof(time));
	s->min = sfc_edit_id(edit, time);
	spell_time(max, time, sizeof(time));
	s->max = sfc_edit_id(edit, time);
	s->alarm = sfc_edit_id(edit, alarm);
	return true;
}

/* ---- conditions ---- */

bool sfc_is_expression(const char *text)
{
	struct expr *expr = calloc(1, sizeof(*expr));
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good = expr && diags;

	if (good) {
		diag_init(diags);
		good = expr_parse_text(text, strlen(text), expr, diags,
				       (struct diag){ .id = DIAG_BAD_EXPRESSION }) &&
		       !expr->target;
	}
	free(expr);
	free(diags);
	return good;
}

static struct rung *expression_rung(struct sfc_edit *edit, const char *text)
{
	struct rung *rung = rung_new(1, 2);

	if (!rung)
		return NULL;
	rung->cell[0].word = ELEM_COMPARE;
	rung->cell[0].operand = sfc_edit_id(edit, text);
	rung->cell[1].word = ELEM_COIL;
	rung->cell[1].operand = sfc_edit_id(edit, SFC_CONDITION);
	return rung;
}

bool sfc_edit_set_condition(struct sfc_edit *edit, int transition, const char *text)
{
	struct sfc_body *body = &edit->sfc.transition[transition].condition;
	struct rung *rung, **to;

	if (!*text) {
		*body = (struct sfc_body){ BODY_NONE, 0, 0 };
		return true;
	}
	if (strpbrk(text, ";|\n\r") || strlen(text) > 4000 || !sfc_is_expression(text))
		return sfc_edit_refuse(edit, N_("the condition is not a valid expression"));
	rung = expression_rung(edit, text);
	to = rung ? arena_push(&edit->arena, &edit->pou.rung, &edit->pou.rung_count,
			       sizeof(*to)) : NULL;
	if (!to) {
		rung_free(rung);
		return sfc_edit_refuse(edit, NO_MEMORY);
	}
	*to = rung;
	*body = (struct sfc_body){ BODY_EXPRESSION, edit->pou.rung_count - 1, 1 };
	return true;
}

bool sfc_edit_as_rung(struct sfc_edit *edit, int transition)
{
	struct sfc_body *body = &edit->sfc.transition[transition].condition;

	if (body->kind == BODY_NONE && !sfc_edit_set_condition(edit, transition, "TRUE"))
		return false;
	if (body->kind == BODY_LIST)
		return sfc_edit_refuse(edit, N_("the condition is a list and cannot become a rung"));
	body->kind = BODY_RUNGS;
	return true;
}

/* ---- actions of a step ---- */

static const char *skip(const char *at)
{
	return at + strspn(at, " \t,");
}

/* The next word of a line; false: there is none. */
static bool next_word(const char **at, char *out, size_t size)
{
	size_t len;

	*at = skip(*at);
	len = strcspn(*at, " \t,");
	snprintf(out, size, "%.*s", (int)(len < size ? len : size - 1), *at);
	*at += len;
	return len > 0 && len < size;
}

/* Takes `L T#3s`, `SET`, `N`, if a name follows; false: something is missing. */
static bool take_qualifier(const char **at, struct sfc_doing *out)
{
	const char *behind = *at;
	char word[LIMIT_NAME + 1];
	enum qualifier found;

	if (!next_word(&behind, word, sizeof(word)) || !*skip(behind))
		return true;
	found = qualifier_find(word, strlen(word));
	if (strcasecmp(word, "SET") == 0)
		out->kind = USE_SET;
	else if (strcasecmp(word, "RESET") == 0)
		out->kind = USE_RESET;
	else if (found != QUALIFIER_COUNT)
		out->qualifier = found;
	else
		return true;
	*at = behind;
	if (out->kind != USE_ACTION || !qualifier_has_time(found))
		return true;
	out->why = N_("this qualifier needs a time and a name, as in L T#5s Motor");
	if (!next_word(at, word, sizeof(word)) || !*skip(*at) ||
	    strlen(word) + sizeof("T#") > sizeof(out->time))
		return false;
	spell_time(word, out->time, sizeof(out->time));
	return true;
}

/* Takes the name, with its declaration. */
static bool take_operand(const char *at, bool qualified, struct sfc_doing *out)
{
	char word[LIMIT_NAME + 1];
	size_t len;

	out->operand = skip(at);
	len = entry_declared_len(out->operand, strlen(out->operand), ENTRY_WORD_GIVEN);
	if (len > 0 && len <= LIMIT_NAME) {
		snprintf(out->name, sizeof(out->name), "%.*s", (int)len, out->operand);
		out->says = true;
		return true;
	}
	if (!next_word(&at, word, sizeof(word)))
		return false;
	if (out->action && strcasecmp(skip(at), "ST") == 0) {
		out->statements = true;
		at += strlen(at);
	}
	if (!is_word(word) || *skip(at)) {
		out->why = qualified ? N_("there are too many words: write a qualifier and a name") :
				       N_("the first word is not a qualifier");
		return false;
	}
	snprintf(out->name, sizeof(out->name), "%s", word);
	return true;
}

bool sfc_doing_read(const char *line, struct sfc_doing *out)
{
	const char *begin = skip(line), *at = begin, *behind;
	char word[LIMIT_NAME + 1];

	memset(out, 0, sizeof(*out));
	out->why = N_("the name of an action or a bit is missing");
	if (!entry_declared_len(at, strlen(at), ENTRY_WORD_POSSIBLE) &&
	    !take_qualifier(&at, out))
		return false;
	behind = at;
	if (next_word(&behind, word, sizeof(word)) && strcasecmp(word, "ACTION") == 0) {
		out->action = true;
		at = behind;
	}
	if (!take_operand(at, at != begin, out))
		return false;
	out->why = NULL;
	return true;
}

void sfc_doing_print(const struct project *project, const struct sfc *sfc, int use,
		     char *out, size_t size)
{
	const struct sfc_use *u = &sfc->use[use];
	const char *name = project_text(project, u->operand);

	if (u->kind != USE_ACTION)
		snprintf(out, size, "%s %s", u->kind == USE_SET ? "SET" : "RESET", name);
	else
		snprintf(out, size, "%s %s%s%s", qualifier_word(u->qualifier),
			 project_text(project, u->time), u->time ? " " : "", name);
}

/* A body of one empty rung. */
static bool empty_rung(struct sfc_edit *edit, struct sfc_body *body)
{
	struct rung **to = arena_push(&edit->arena, &edit->pou.rung, &edit->pou.rung_count,
				      sizeof(*to));

	if (!to)
		return sfc_edit_refuse(edit, NO_MEMORY);
	*to = rung_new(1, 1);
	if (!*to) {
		edit->pou.rung_count--;
		return sfc_edit_refuse(edit, NO_MEMORY);
	}
	*body = (struct sfc_body){ BODY_RUNGS, edit->pou.rung_count - 1, 1 };
	return true;
}

/* A body of one empty statement. */
static bool empty_statement(struct sfc_edit *edit, struct sfc_body *body)
{
	struct st *st = own_text(edit);

	if (!st)
		return sfc_edit_refuse(edit, NO_MEMORY);
	st->item[st->count] = (struct st_item){ .kind = ST_EMPTY, .text = sfc_edit_id(edit, "") };
	*body = (struct sfc_body){ BODY_ST, st->count++, 1 };
	edit->pou.st = st;
	return true;
}

/* Adds an action that does nothing yet. */
static bool new_action(struct sfc_edit *edit, const struct sfc_doing *doing)
{
	struct sfc *sfc = &edit->sfc;
	struct sfc_action *action;
	struct sfc_body body;

	if (!can_be_called(edit, doing->name) ||
	    !(doing->statements ? empty_statement(edit, &body) : empty_rung(edit, &body)))
		return false;
	action = arena_push(&edit->arena, &sfc->action, &sfc->action_count,
			    sizeof(*action));
	if (!action)
		return sfc_edit_refuse(edit, NO_MEMORY);
	*action = (struct sfc_action){ .name = sfc_edit_id(edit, doing->name), .body = body };
	return sfc_edit_put_piece(edit, sfc->piece_count - 1, PIECE_ACTION,
				 sfc->action_count - 1);
}

/* Copies the lines of a step behind all others, with room for one more; without @skip. */
static bool copy_uses(struct sfc_edit *edit, int step, int skip, bool more)
{
	struct sfc *sfc = &edit->sfc;
	const int old = sfc->step[step].first_use, count = sfc->step[step].use_count;
	const int first = sfc->use_count;

	for (int i = old; i < old + count + more; i++) {
		struct sfc_use *to;

		if (i == skip)
			continue;
		to = arena_push(&edit->arena, &sfc->use, &sfc->use_count, sizeof(*to));
		if (!to)
			return sfc_edit_refuse(edit, NO_MEMORY);
		*to = i < old + count ? sfc->use[i] : (struct sfc_use){ .step = step };
	}
	sfc->step[step].first_use = first;
	sfc->step[step].use_count = sfc->use_count - first;
	return true;
}

bool sfc_edit_set_use(struct sfc_edit *edit, int step, int use,
		      const struct sfc_doing *doing)
{
	struct sfc_step *s = &edit->sfc.step[step];
	const int line = use < 0 ? s->use_count : use - s->first_use;
	struct sfc_use *to;

	if (use < 0 && s->use_count >= LIMIT_STEP_USES)
		return sfc_edit_refuse(edit, N_("the step has too many actions"));
	if ((doing->action && !new_action(edit, doing)) ||
	    !copy_uses(edit, step, -1, use < 0))
		return false;
	to = &edit->sfc.use[edit->sfc.step[step].first_use + line];
	to->more = to->kind == doing->kind ? to->more : 0;
	to->kind = doing->kind;
	to->qualifier = doing->qualifier;
	to->operand = sfc_edit_id(edit, doing->name);
	to->time = sfc_edit_id(edit, doing->time);
	return true;
}

bool sfc_edit_delete_use(struct sfc_edit *edit, int use)
{
	return copy_uses(edit, edit->sfc.use[use].step, use, false);
}

/* ---- comments ---- */

/* Adds the delimiters of the file. */
static bool comment_id(struct sfc_edit *edit, const char *text, uint32_t *id)
{
	const size_t size = strlen(text) + 8;
	char *whole;

	if (strstr(text, "*)") || strstr(text, "(*") || strpbrk(text, "\r\n"))
		return sfc_edit_refuse(edit, N_("a comment is one line without (* and *)"));
	*id = 0;
	if (!*text)
		return true;
	whole = malloc(size);
	if (!whole)
		return sfc_edit_refuse(edit, NO_MEMORY);
	snprintf(whole, size, "(* %s *)", text);
	*id = sfc_edit_id(edit, whole);
	free(whole);
	return *id || sfc_edit_refuse(edit, NO_MEMORY);
}

bool sfc_edit_set_comment(struct sfc_edit *edit, enum piece_kind kind, int index,
			  const char *text)
{
	uint32_t id;

	if (!comment_id(edit, text, &id))
		return false;
	if (kind == PIECE_STEP)
		edit->sfc.step[index].comment = id;
	else
		edit->sfc.transition[index].comment = id;
	return true;
}

bool sfc_edit_set_use_comment(struct sfc_edit *edit, int use, const char *text)
{
	struct sfc_use *u = &edit->sfc.use[use];
	uint32_t id;

	if (!comment_id(edit, text, &id))
		return false;
	u->comment = id;
	u->more = id ? 0 : u->more;
	return true;
}
