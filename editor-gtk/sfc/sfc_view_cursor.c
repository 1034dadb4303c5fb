/* SPDX-License-Identifier: MIT
 *
 * sfc_view_cursor - the shown chart and its cursor.
 *
 * After a change of the chart the sheet is made again. The cursor is made valid before the
 * entry closes: closing it moves the focus, and the window then reads the cursor's place.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include <string.h>

#define AROUND 30 /* px at 100 % shown around the cursor                         */

struct pou *sfc_pou(LadderSfcView *view)
{
	struct project *project = ladder_document_project(view->canvas->document);
	const int pou = view->canvas->pou;

	return project && pou < project->pou_count && project->pou[pou].sfc ?
	       &project->pou[pou] : NULL;
}

/* Where the body begins in the file, 1-based. */
static int line_of(LadderSfcView *view, const struct sfc_body *body)
{
	const struct sfc *sfc = sfc_pou(view)->sfc;

	for (int i = 0; i < sfc->action_count; i++)
		if (&sfc->action[i].body == body)
			return sfc->action[i].line + 1;
	for (int i = 0; i < sfc->transition_count; i++)
		if (&sfc->transition[i].condition == body)
			return sfc->transition[i].line + 1;
	return 1;
}

void sfc_want_body(LadderSfcView *view, const struct sfc_body *body)
{
	const bool rungs = sfc_body_has_rungs(body);

	g_signal_emit_by_name(view, "body-wanted", rungs ? body->first : line_of(view, body),
			      rungs ? body->count : 0);
}

/* ---- the sheet ---- */

void sfc_forget_places(LadderSfcView *view)
{
	struct sfc_places *places = &view->places;

	g_clear_pointer(&view->missing, g_array_unref);
	g_clear_pointer(&places->map, live_map_free);
	g_clear_pointer(&places->active, g_free);
	g_clear_pointer(&places->time, g_free);
	g_clear_pointer(&places->step, g_free);
	g_clear_pointer(&places->transition, g_free);
}

/* Moves the cursor back into the chart. */
static void fit_cursor(LadderSfcView *view)
{
	const int shapes = view->sheet ? view->sheet->layout->shape_count : 0;
	const struct sfc *sfc = view->sheet ? view->sheet->layout->sfc : NULL;
	struct sfc_at *cursor = &view->cursor;

	if (cursor->shape >= shapes)
		*cursor = (struct sfc_at){ shapes - 1, -1, false };
	if (cursor->shape < 0 && shapes)
		cursor->shape = 0;
	if (cursor->use >= 0 && (!sfc || cursor->use >= sfc->use_count ||
				 sfc->use[cursor->use].step != cursor->shape))
		cursor->use = -1;
}

void sfc_make_sheet(LadderSfcView *view)
{
	const struct pou *pou = sfc_pou(view);
	struct sfc_sheet *old = view->sheet;

	view->of = ladder_document_ladder(view->canvas->document);
	view->sheet = pou ? sfc_sheet_new(ladder_document_project(view->canvas->document), pou,
					  view->canvas->lettering) : NULL;
	g_free(view->selected);
	view->selected = g_new0(bool, view->sheet ? view->sheet->layout->shape_count + 1 : 1);
	sfc_sheet_free(old);
	sfc_forget_places(view);
	g_array_set_size(view->found, 0);
	view->stroke.from = view->stroke.to = (struct sfc_at){ -1, -1, false };
	view->stroke.drawn = false;
	g_array_set_size(view->marks, 0);
	fit_cursor(view);
	canvas_close_entry(LADDER_CANVAS(view));
	gtk_widget_queue_resize(GTK_WIDGET(view));
	sfc_reveal(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
	canvas_moved(LADDER_CANVAS(view));
}

void sfc_fresh(LadderSfcView *view)
{
	if (view->of != ladder_document_ladder(view->canvas->document))
		sfc_make_sheet(view);
}

/* ---- the shape at the cursor ---- */

enum sfc_part sfc_part_at_cursor(LadderSfcView *view, int *index)
{
	const struct sfc_shape *shape;

	*index = -1;
	if (!view->sheet || view->cursor.shape < 0)
		return SFC_NOTHING;
	shape = &view->sheet->layout->shape[view->cursor.shape];
	*index = shape->index;
	return shape->part;
}

enum sfc_part sfc_part_here(LadderSfcView *view, int *index)
{
	const enum sfc_part part = sfc_part_at_cursor(view, index);
	const struct sfc_jump *jump;

	if (part != SFC_JUMP)
		return part;
	jump = &view->sheet->layout->jump[*index];
	*index = jump->from;
	return jump->to_transition ? SFC_STEP : SFC_TRANSITION;
}

int sfc_macro_here(LadderSfcView *view)
{
	const struct sfc *sfc = sfc_pou(view)->sfc;
	int index;
	const enum sfc_part part = sfc_part_here(view, &index);

	if (part == SFC_STEP)
		return sfc->step[index].kind == STEP_MACRO ? index : sfc->step[index].macro;
	return part == SFC_TRANSITION ? sfc->transition[index].macro : -1;
}

graphene_rect_t sfc_box(LadderSfcView *view, struct sfc_at at)
{
	if (!view->sheet || at.shape < 0)
		return GRAPHENE_RECT_INIT(SFC_EDGE, SFC_EDGE, 80, SFC_ROW);
	return at.use >= 0 ? sfc_sheet_use(view->sheet, at.use) :
			     sfc_sheet_box(view->sheet, at.shape);
}

/* ---- moving ---- */

void sfc_reveal(LadderSfcView *view)
{
	const double around = AROUND * view->canvas->zoom;

	if (view->sheet && view->cursor.shape >= 0)
		canvas_reveal(LADDER_CANVAS(view), sfc_box(view, view->cursor), around, around);
}

void sfc_go(LadderSfcView *view, struct sfc_at at, bool extend)
{
	if (!view->sheet)
		return;
	if (!extend)
		memset(view->selected, 0, (size_t)view->sheet->layout->shape_count + 1);
	else if (view->cursor.shape >= 0)
		view->selected[view->cursor.shape] = true;
	view->cursor = at;
	if (extend && at.shape >= 0)
		view->selected[at.shape] = true;
	sfc_reveal(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
	canvas_moved(LADDER_CANVAS(view));
}
