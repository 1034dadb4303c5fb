/* SPDX-License-Identifier: MIT
 *
 * to_classic_often - does a rung run more than once in a scan: in a loop, in a subroutine
 * that is called in several places? Or not at all? A timer of ClassicLadder counts each time
 * that it is looked at.
 */
#include "engine/exchange/classic/to_classic_parts.h"

/* The rung whose label a jump names; -1: none. */
static int target_of(const struct leaving *e, const struct pou *pou, uint32_t label)
{
	const struct names *names = &e->project->names;

	for (int i = 0; i < pou->rung_count; i++)
		if (pou->rung[i]->label &&
		    names_fold(names, pou->rung[i]->label) == names_fold(names, label))
			return i;
	return -1;
}

static bool in_loop(const struct leaving *e, const struct pou *pou, int index)
{
	for (int i = index; i < pou->rung_count; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; k < rung->rows * rung->cols; k++) {
			int to = rung->cell[k].word == ELEM_JUMP && !rung->off ?
				 target_of(e, pou, rung->cell[k].operand) : -1;

			if (to >= 0 && to <= index)
				return true;
		}
	}
	return false;
}

struct call_place { const struct pou *pou; int rung, count; };

static void find_calls(const struct leaving *e, const struct pou *called,
		       struct call_place *place)
{
	*place = (struct call_place){ NULL, 0, 0 };
	for (int i = 0; i < e->project->pou_count; i++) {
		const struct pou *pou = &e->project->pou[i];

		for (int k = 0; k < pou->rung_count; k++)
			for (int m = 0; m < pou->rung[k]->rows * pou->rung[k]->cols; m++) {
				const struct cell *cell = &pou->rung[k]->cell[m];

				if (cell->word == ELEM_CALL && !pou->rung[k]->off &&
				    scope_pou(e->scope, pou, cell->operand) == called)
					*place = (struct call_place){ pou, k,
						place->count + 1 };
			}
	}
}

/* Does a rung before @index lead past it? */
static bool is_skipped(const struct leaving *e, const struct pou *pou, int index)
{
	for (int i = 0; i < index; i++) {
		const struct rung *rung = pou->rung[i];

		for (int k = 0; !rung->off && k < rung->rows * rung->cols; k++) {
			const struct cell *cell = &rung->cell[k];

			if (cell->word == ELEM_RETURN || cell->word == ELEM_END ||
			    (cell->word == ELEM_JUMP &&
			     target_of(e, pou, cell->operand) > index))
				return true;
		}
	}
	return false;
}

bool may_rest(struct leaving *e)
{
	return e->pou->kind == POU_SUBROUTINE || is_skipped(e, e->pou, e->rung_index);
}

bool runs_often(struct leaving *e)
{
	const struct pou *pou = e->pou;
	int rung = e->rung_index;

	for (int depth = 0; depth <= e->project->pou_count; depth++) {
		struct call_place place;

		if (in_loop(e, pou, rung))
			return true;
		if (pou->kind != POU_SUBROUTINE)
			return false;
		find_calls(e, pou, &place);
		if (place.count != 1)
			return place.count > 1;
		pou = place.pou;
		rung = place.rung;
	}
	return true;
}
