/* SPDX-License-Identifier: MIT
 *
 * sfc_view_find - lines of a file and places of a chart; what find has come to; the name at
 * the cursor. It looks for nothing: find.c and the engine's cross reference do.
 */
#include "editor-gtk/sfc_view_inside.h"

#include <string.h>

/* ---- lines ---- */

static int lines_above(LadderSfcView *view, uint32_t comment)
{
	const char *text = project_text(view->sheet->project, comment);
	int lines = *text != '\0';

	for (; *text; text++)
		lines += *text == '\n';
	return lines;
}

int chart_line_of(LadderSfcView *view, struct sfc_at at)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	const struct sfc_shape *shape = &view->sheet->layout->shape[at.shape];

	if (at.use >= 0)
		return sfc->use[at.use].line - lines_above(view, sfc->use[at.use].comment);
	if (shape->part == SFC_STEP)
		return sfc->step[shape->index].line -
		       lines_above(view, sfc->step[shape->index].comment);
	if (shape->part == SFC_TRANSITION)
		return sfc->transition[shape->index].line -
		       lines_above(view, sfc->transition[shape->index].comment);
	return 0;
}

/* A place that begins at @begins, if it is the nearest one up to @line. */
static void try_line(int begins, int line, struct sfc_at at, int *best, struct sfc_at *found)
{
	if (begins > line || begins < *best || begins == 0)
		return;
	*best = begins;
	*found = at;
}

static struct sfc_at at_line(LadderSfcView *view, int line)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	struct sfc_at found = { -1, -1, false };
	int best = 1;

	for (int i = 0; i < sfc->step_count + sfc->transition_count; i++) {
		const struct sfc_at at = { i, -1, false };

		try_line(chart_line_of(view, at), line, at, &best, &found);
	}
	for (int i = 0; i < sfc->use_count; i++) {
		const struct sfc_at at = { sfc->use[i].step, i, false };

		/* Several stand in one line: the first of them. */
		if (i == 0 || sfc->use[i].line != sfc->use[i - 1].line)
			try_line(chart_line_of(view, at), line, at, &best, &found);
	}
	/* What is in an action is shown where it is called first. */
	for (int a = 0; a < sfc->action_count; a++) {
		struct sfc_at at = { -1, -1, false };

		for (int i = sfc->use_count - 1; i >= 0; i--)
			if (sfc->use[i].action == a)
				at = (struct sfc_at){ sfc->use[i].step, i, false };
		try_line(sfc->action[a].line - lines_above(view, sfc->action[a].comment),
			 line, at, &best, &found);
	}
	return found;
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
