/* SPDX-License-Identifier: MIT
 *
 * sfc_view_find - lines of a file and places of a chart; what find has come to; the name at
 * the cursor. It looks for nothing: find.c and the engine's cross reference do.
 */
#include "editor-gtk/edit/sfc_lines.h"
#include "editor-gtk/sfc/sfc_view_inside.h"

#include <string.h>

/* ---- lines ---- */

int chart_line_of(LadderSfcView *view, struct sfc_at at)
{
	const struct sfc_shape *shape = &view->sheet->layout->shape[at.shape];
	struct sfc_spot spot = { SPOT_NONE, shape->index };

	if (at.use >= 0)
		spot = (struct sfc_spot){ SPOT_USE, at.use };
	else if (shape->part == SFC_STEP)
		spot.kind = SPOT_STEP;
	else if (shape->part == SFC_TRANSITION)
		spot.kind = SPOT_TRANSITION;
	return sfc_line_of(view->sheet->project, view->sheet->layout->sfc, spot);
}

/* What is in an action is shown where it is called first. */
static struct sfc_at called_first(const struct sfc *sfc, int action)
{
	for (int i = 0; i < sfc->use_count; i++)
		if (sfc->use[i].action == action)
			return (struct sfc_at){ sfc->use[i].step, i, false };
	return (struct sfc_at){ -1, -1, false };
}

static struct sfc_at at_line(LadderSfcView *view, int line)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	const struct sfc_spot spot = sfc_spot_at(view->sheet->project, sfc, line);

	switch (spot.kind) {
	case SPOT_STEP:
		return (struct sfc_at){ spot.index, -1, false };
	case SPOT_TRANSITION:
		return (struct sfc_at){ sfc->step_count + spot.index, -1, false };
	case SPOT_USE:
		return (struct sfc_at){ sfc->use[spot.index].step, spot.index, false };
	case SPOT_ACTION:
		return called_first(sfc, spot.index);
	case SPOT_CONTROL:
	case SPOT_NONE:
		break;
	}
	return (struct sfc_at){ -1, -1, false };
}

void ladder_sfc_view_go_row(LadderSfcView *view, int row)
{
	struct sfc_at at;

	chart_fresh(view);
	if (view->sheet) {
		at = at_line(view, chart_pou(view)->line + row);
		if (at.shape >= 0)
			chart_go(view, at, false);
	}
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

int ladder_sfc_view_row(LadderSfcView *view)
{
	chart_fresh(view);
	return view->sheet && view->cursor.shape >= 0 ?
	       MAX(chart_line_of(view, view->cursor) - chart_pou(view)->line, -1) : -1;
}

bool ladder_sfc_view_is_at(LadderSfcView *view, int row)
{
	struct sfc_at at;

	chart_fresh(view);
	if (!view->sheet)
		return false;
	at = at_line(view, chart_pou(view)->line + row);
	return at.shape < 0 || (at.shape == view->cursor.shape &&
				at.use == view->cursor.use);
}

/* ---- what find has come to ---- */

void ladder_sfc_view_set_found(LadderSfcView *view, int row)
{
	chart_fresh(view);
	view->found = (struct sfc_at){ -1, -1, false };
	if (view->sheet && row >= 0)
		view->found = at_line(view, chart_pou(view)->line + row);
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

/* ---- the name at the cursor ---- */

/* The first name of a condition's rung, but for the coil of the condition itself. */
static const struct xref_use *name_in(const struct xref *xref, int pou,
				      const struct sfc_body *body)
{
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->pou == pou && use->slot && use->rung > body->first &&
		    use->rung <= body->first + body->count &&
		    strcmp(project_text(xref->project, *use->slot), SFC_CONDITION) != 0)
			return use;
	}
	return NULL;
}

static const struct xref_use *of_slot(const struct xref *xref, const uint32_t *slot)
{
	for (int i = 0; i < xref->count; i++)
		if (xref->use[i].slot == slot)
			return &xref->use[i];
	return NULL;
}

const struct xref_use *ladder_sfc_view_use(LadderSfcView *view, const struct xref *xref)
{
	const struct sfc *sfc;
	const struct sfc_body *body;
	const struct xref_use *use = NULL;
	enum sfc_part part;
	int index;

	chart_fresh(view);
	part = chart_part(view, &index);
	if (part == SFC_NOTHING)
		return NULL;
	sfc = view->sheet->layout->sfc;
	if (view->cursor.use >= 0)
		return of_slot(xref, &sfc->use[view->cursor.use].operand);
	if (part == SFC_JUMP) {
		const struct sfc_jump *jump = &view->sheet->layout->jump[index];

		return of_slot(xref, &sfc->ref[jump->ref].name);
	}
	if (part == SFC_STEP)
		return of_slot(xref, &sfc->step[index].name);
	body = &sfc->transition[index].condition;
	if (body->kind == BODY_EXPRESSION || body->kind == BODY_RUNGS)
		use = name_in(xref, view->pou, body);
	return use ? use : of_slot(xref, &sfc->transition[index].name);
}
