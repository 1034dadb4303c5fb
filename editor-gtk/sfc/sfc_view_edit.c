/* SPDX-License-Identifier: MIT
 *
 * sfc_view_edit - what the verbs of a chart do.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/sfc/sfc_view_clipboard.h"

#include <stdlib.h>
#include <string.h>

/* ---- an edit becomes a change of the document ---- */

struct pou_place { int pou; struct text_span span; };

static void take_pou(void *context, const struct text_span *span)
{
	struct pou_place *place = context;

	if (span->part == TEXT_POU && span->number == place->pou)
		place->span = *span;
}

/* Only the lines that differ are exchanged. */
static bool exchange(LadderSfcView *view, const char *text)
{
	struct pou_place place = { .pou = view->pou };
	gsize len, start = 0, end = 0;
	char *whole = ladder_document_outline(view->document, &len, take_pou, &place), *with;
	const char *old = whole + place.span.at;
	const gsize new_len = strlen(text), old_len = place.span.len;
	struct diag_list why;
	bool good;

	while (start < old_len && start < new_len && old[start] == text[start])
		start++;
	while (start > 0 && old[start - 1] != '\n')
		start--;
	while (end < old_len - start && end < new_len - start &&
	       old[old_len - 1 - end] == text[new_len - 1 - end])
		end++;
	while (end > 0 && old[old_len - end - 1] != '\n')
		end--;
	with = g_strndup(text + start, new_len - start - end);
	diag_init(&why);
	good = (old_len - start - end == 0 && !with[0]) ||
	       ladder_document_replace(view->document, place.span.at + start,
				       old_len - start - end, with, &why);
	if (!good)
		chart_tell(view, _("a file could not hold this"));
	g_free(with);
	g_free(whole);
	return good;
}

/* The number that it has when the file has been read. */
static int rank_of(const struct sfc_edit *edit, enum piece_kind kind, int index)
{
	int rank = 0;

	for (int i = 0; i < edit->sfc.piece_count; i++) {
		if (edit->sfc.piece[i].kind != kind)
			continue;
		if (edit->sfc.piece[i].index == index)
			return rank;
		rank++;
	}
	return -1;
}

static void go_rank(LadderSfcView *view, enum piece_kind kind, int rank)
{
	const struct pou *pou = chart_pou(view);

	if (!pou || rank < 0 || !view->sheet)
		return;
	chart_go(view, (struct sfc_at){ kind == PIECE_STEP ? rank :
					pou->sfc->step_count + rank, -1, false }, false);
}

struct sfc_edit *chart_edit(LadderSfcView *view)
{
	struct pou *pou = chart_pou(view);

	return pou ? sfc_edit_new(ladder_document_project(view->document), pou) : NULL;
}

bool chart_put(LadderSfcView *view, struct sfc_edit *edit, bool good, const char *name,
	       enum piece_kind kind, int index)
{
	const int rank = good && index >= 0 ? rank_of(edit, kind, index) : -1;
	char *text = good ? sfc_edit_text(edit) : NULL;

	if (edit && !good)
		chart_tell(view, edit->why ? _(edit->why) : "");
	sfc_edit_free(edit);
	if (!text)
		return false;
	ladder_document_begin(view->document, name, NULL);
	good = exchange(view, text);
	ladder_document_end(view->document);
	free(text);
	if (good)
		go_rank(view, kind, rank);
	return good;
}

/* ---- structure ---- */

/* A new step at which the cursor goes on. */
static void put_step(LadderSfcView *view, struct sfc_edit *edit, int step, enum verb verb)
{
	chart_put(view, edit, step >= 0, _(verb_row(verb)->label), PIECE_STEP, step);
}

/* The transition of a jump, or the step whose jump it is: where one would go on. */
enum sfc_part chart_part_here(LadderSfcView *view, int *index)
{
	enum sfc_part part = chart_part(view, index);
	const struct sfc_jump *jump;

	if (part != SFC_JUMP)
		return part;
	jump = &view->sheet->layout->jump[*index];
	*index = jump->from;
	return jump->to_transition ? SFC_STEP : SFC_TRANSITION;
}

static void step_below(LadderSfcView *view)
{
	struct sfc_edit *edit = chart_edit(view);
	int index, made;

	if (!edit)
		return;
	switch (chart_part_here(view, &index)) {
	case SFC_STEP:
		made = sfc_edit_step_below(edit, index);
		break;
	case SFC_TRANSITION:
		made = sfc_edit_step_after(edit, index);
		break;
	case SFC_NOTHING:
	case SFC_JUMP:
	default:
		made = sfc_edit_first(edit, -1);
		break;
	}
	put_step(view, edit, made, VERB_step_below);
}

static void branch(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);
	struct sfc_edit *edit = chart_edit(view);
	int index, made = -1;
	enum sfc_part part;

	if (!edit)
		return;
	part = chart_part_here(view, &index);
	/* Beside a transition: another way out of its step. */
	if (part == SFC_TRANSITION && pou->sfc->transition[index].from_count > 0)
		index = pou->sfc->ref[pou->sfc->transition[index].first_from].step;
	else if (part != SFC_STEP)
		index = -1;
	if (index >= 0)
		made = sfc_edit_branch(edit, index);
	else
		edit->why = N_("a branch begins at a step");
	put_step(view, edit, made, VERB_step_branch);
}

/* The transition that leads to a step; -1: none. */
static int way_to(const struct sfc *sfc, int step)
{
	for (int t = 0; t < sfc->transition_count; t++)
		for (int i = 0; i < sfc->transition[t].to_count; i++)
			if (sfc->ref[sfc->transition[t].first_to + i].step == step)
				return t;
	return -1;
}

static void parallel(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);
	struct sfc_edit *edit = chart_edit(view);
	int index, made = -1;
	enum sfc_part part;

	if (!edit)
		return;
	part = chart_part_here(view, &index);
	if (part == SFC_STEP)
		index = way_to(pou->sfc, index);
	if (index >= 0)
		made = sfc_edit_parallel(edit, index);
	else
		edit->why = N_("side by side run steps that one transition leads to");
	put_step(view, edit, made, VERB_step_parallel);
}

static void move(LadderSfcView *view, bool right)
{
	struct sfc_edit *edit = chart_edit(view);
	int index;
	enum sfc_part part;
	bool good;

	if (!edit)
		return;
	part = chart_part_here(view, &index);
	if (part == SFC_NOTHING) {
		sfc_edit_free(edit);
		return;
	}
	good = sfc_edit_move(edit, part == SFC_STEP ? index : -1,
			     part == SFC_TRANSITION ? index : -1, right);
	chart_put(view, edit, good, _("Move branch"), part == SFC_STEP ? PIECE_STEP :
		  PIECE_TRANSITION, index);
}

void chart_lead(LadderSfcView *view, struct sfc_at from, struct sfc_at to)
{
	const struct sfc_layout *layout = view->sheet->layout;
	const struct sfc_shape *a = &layout->shape[from.shape];
	const struct sfc_shape *b = &layout->shape[to.shape];
	struct sfc_edit *edit = chart_edit(view);
	int made = -1;
	bool good = false;

	if (!edit)
		return;
	if (a->part == SFC_STEP && b->part == SFC_STEP) {
		made = sfc_edit_lead(edit, a->index, b->index);
		good = made >= 0;
	} else if (a->part == SFC_STEP && b->part == SFC_TRANSITION) {
		made = b->index;
		good = sfc_edit_wait(edit, b->index, a->index);
	} else if (a->part == SFC_TRANSITION && b->part == SFC_STEP) {
		made = a->index;
		good = sfc_edit_set_ways(edit, a->index, true, project_text(
			view->sheet->project, layout->sfc->step[b->index].name));
	} else {
		edit->why = N_("a way leads from a step or transition to a step");
	}
	chart_put(view, edit, good, _("Draw a way"), PIECE_TRANSITION, made);
}

/* ---- deleting ---- */

/* The step before a transition; -1: none. */
static int step_of(const struct sfc *sfc, int transition)
{
	return transition >= 0 && sfc->transition[transition].from_count > 0 ?
	       sfc->ref[sfc->transition[transition].first_from].step : -1;
}

/* Where the cursor goes when what stands there is gone: to the step before it that stays. */
static int step_before(LadderSfcView *view, const struct sfc *sfc, enum sfc_part part,
		       int index)
{
	const int first = part == SFC_STEP ? index : -1;
	int step = part == SFC_STEP ? step_of(sfc, way_to(sfc, index)) :
		   part == SFC_TRANSITION ? step_of(sfc, index) : -1;

	for (int i = 0; i < sfc->step_count && step >= 0 && view->selected[step]; i++)
		step = step_of(sfc, way_to(sfc, step));
	return step == first || (step >= 0 && view->selected[step]) ? -1 : step;
}

static bool delete_jump(LadderSfcView *view, struct sfc_edit *edit, int index)
{
	const struct sfc_jump *jump = &view->sheet->layout->jump[index];

	return sfc_edit_cut_way(edit, jump->to_transition ? jump->target : jump->from,
				jump->ref);
}

static bool delete_shape(LadderSfcView *view, struct sfc_edit *edit, int number)
{
	const struct sfc_shape *shape = &view->sheet->layout->shape[number];

	switch (shape->part) {
	case SFC_STEP:
		return sfc_edit_delete_step(edit, shape->index);
	case SFC_TRANSITION: /* it may have gone with a step */
		return sfc_edit_delete_transition(edit, shape->index) || true;
	case SFC_JUMP:
		return delete_jump(view, edit, shape->index);
	case SFC_NOTHING:
	default:
		return false;
	}
}

static bool delete_selected(LadderSfcView *view, struct sfc_edit *edit, bool *any)
{
	const struct sfc_layout *layout = view->sheet->layout;
	const int boxes = layout->sfc->step_count + layout->sfc->transition_count;
	bool good = true;

	*any = false;
	for (int i = 0; i < boxes; i++)
		if (view->selected[i]) {
			*any = true;
			good = delete_shape(view, edit, i) && good;
		}
	return good;
}

static void delete(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);
	struct sfc_edit *edit;
	int index, next;
	enum sfc_part part;
	bool good, any;

	if (!pou || view->cursor.shape < 0)
		return;
	edit = chart_edit(view);
	part = chart_part(view, &index);
	next = step_before(view, pou->sfc, part, index);
	good = delete_selected(view, edit, &any);
	if (!any && view->cursor.use >= 0) {
		next = index;
		good = sfc_edit_delete_use(edit, view->cursor.use);
	} else if (!any) {
		good = delete_shape(view, edit, view->cursor.shape);
	}
	chart_put(view, edit, good, _(verb_row(VERB_delete)->label), PIECE_STEP, next);
}

/* ---- kinds ---- */

static void change_kind(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);
	struct sfc_edit *edit;
	int index;

	if (chart_part(view, &index) != SFC_STEP)
		return;
	edit = chart_edit(view);
	chart_put(view, edit, sfc_edit_set_kind(edit, index,
			pou->sfc->step[index].kind == STEP_INITIAL ? STEP_PLAIN :
			STEP_INITIAL), _(verb_row(VERB_step_kind)->label), PIECE_STEP, index);
}

/* ---- macro-steps ---- */

/* The steps that are selected, else the one at the cursor. */
static void macro_make(LadderSfcView *view)
{
	struct sfc_edit *edit = chart_edit(view);
	const int count = edit ? edit->sfc.step_count : 0;
	bool *chosen = g_new0(bool, count + 1), any = false;
	int index, made;

	for (int i = 0; i < count; i++)
		any |= chosen[i] = view->selected[i];
	if (!any && chart_part(view, &index) == SFC_STEP)
		chosen[index] = true;
	made = edit ? sfc_edit_macro_make(edit, chosen) : -1;
	chart_put(view, edit, made >= 0, _(verb_row(VERB_macro_make)->label), PIECE_STEP,
		  made);
	g_free(chosen);
}

int chart_macro_here(LadderSfcView *view)
{
	const struct sfc *sfc = chart_pou(view)->sfc;
	int index;
	const enum sfc_part part = chart_part_here(view, &index);

	if (part == SFC_STEP)
		return sfc->step[index].kind == STEP_MACRO ? index : sfc->step[index].macro;
	return part == SFC_TRANSITION ? sfc->transition[index].macro : -1;
}

static void macro_open(LadderSfcView *view)
{
	struct sfc_edit *edit = chart_edit(view);
	const int macro = chart_macro_here(view);
	int made = -1;

	if (edit && macro < 0)
		edit->why = N_("this is not a macro-step");
	if (edit && macro >= 0)
		made = sfc_edit_macro_open(edit, macro);
	chart_put(view, edit, made >= 0, _(verb_row(VERB_macro_open)->label), PIECE_STEP,
		  made);
}

/* A condition that is an expression becomes a rung; what is one is shown. */
static void as_rung(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);
	struct sfc_edit *edit;
	int index;

	switch (chart_part_here(view, &index)) {
	case SFC_TRANSITION:
		edit = chart_edit(view);
		if (chart_put(view, edit, sfc_edit_as_rung(edit, index),
			      _(verb_row(VERB_as_rung)->label), PIECE_TRANSITION, index) &&
		    chart_part(view, &index) == SFC_TRANSITION)
			chart_body_wanted(view,
				&chart_pou(view)->sfc->transition[index].condition);
		break;
	case SFC_STEP:
		if (view->cursor.use >= 0 && pou->sfc->use[view->cursor.use].action >= 0)
			chart_body_wanted(view, &pou->sfc->action[
				pou->sfc->use[view->cursor.use].action].body);
		else
			chart_tell(view, _("the cursor is on no condition and no action"));
		break;
	case SFC_NOTHING:
	case SFC_JUMP:
	default:
		break;
	}
}

bool ladder_sfc_view_why(LadderSfcView *view)
{
	int index;

	chart_fresh(view);
	if (chart_part(view, &index) != SFC_TRANSITION ||
	    chart_pou(view)->sfc->transition[index].condition.kind == BODY_NONE)
		return false;
	chart_body_wanted(view, &chart_pou(view)->sfc->transition[index].condition);
	return true;
}

static void select_all(LadderSfcView *view)
{
	if (!view->sheet)
		return;
	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		view->selected[i] = true;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static bool changes(enum verb verb)
{
	return verb != VERB_copy && verb != VERB_select_all && verb != VERB_go_rung &&
	       verb != VERB_enter;
}

void ladder_sfc_view_do(LadderSfcView *view, enum verb verb)
{
	chart_fresh(view);
	if (!view->sheet || (changes(verb) && chart_is_fixed(view)))
		return;
	switch ((int)verb) {
	case VERB_step_below: step_below(view); break;
	case VERB_step_branch: branch(view); break;
	case VERB_step_parallel: parallel(view); break;
	case VERB_branch_left: move(view, false); break;
	case VERB_branch_right: move(view, true); break;
	case VERB_step_kind: change_kind(view); break;
	case VERB_as_rung: as_rung(view); break;
	case VERB_lead_to: chart_ask(view, ASK_LEAD, NULL); break;
	case VERB_wait_for: chart_ask(view, ASK_WAIT, NULL); break;
	case VERB_step_does: chart_ask(view, ASK_ANOTHER, NULL); break;
	case VERB_step_times: chart_ask(view, ASK_TIMES, NULL); break;
	case VERB_way_name: chart_ask(view, ASK_NAME, NULL); break;
	case VERB_way_priority: chart_ask(view, ASK_PRIORITY, NULL); break;
	case VERB_chart_comment: chart_ask(view, ASK_COMMENT, NULL); break;
	case VERB_go_rung: chart_ask(view, ASK_GO, NULL); break;
	case VERB_macro_make: macro_make(view); break;
	case VERB_macro_open: macro_open(view); break;
	case VERB_enter: chart_ask_here(view, NULL); break;
	case VERB_delete: delete(view); break;
	case VERB_cut:
		chart_copy(view);
		ladder_document_begin(view->document, _(verb_row(VERB_cut)->label), NULL);
		delete(view);
		ladder_document_end(view->document);
		break;
	case VERB_copy: chart_copy(view); break;
	case VERB_paste: chart_paste(view); break;
	case VERB_select_all: select_all(view); break;
	case VERB_context_menu: chart_mouse_menu(view); break;
	case VERB_force: chart_live_force(view); break;
	default: break;
	}
}

/* ---- in the status bar ---- */

char *ladder_sfc_view_keys(LadderSfcView *view)
{
	static const enum verb verbs[][4] = {
		[SFC_NOTHING] = { VERB_step_below, VERB_paste, VERB_COUNT, VERB_COUNT },
		[SFC_STEP] = { VERB_step_below, VERB_step_branch, VERB_lead_to,
			       VERB_step_does },
		[SFC_TRANSITION] = { VERB_enter, VERB_step_parallel, VERB_wait_for,
				     VERB_as_rung },
		[SFC_JUMP] = { VERB_enter, VERB_step_below, VERB_delete, VERB_COUNT },
	};
	GString *text = g_string_new(NULL);
	enum sfc_part part;
	int index;

	chart_fresh(view);
	part = chart_part(view, &index);
	for (int i = 0; i < 4 && verbs[part][i] != VERB_COUNT; i++)
		verb_tell(text, verbs[part][i]);
	return g_string_free(text, FALSE);
}
