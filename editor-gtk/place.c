/* SPDX-License-Identifier: MIT
 *
 * place - where a cell is, for a person; see place.h.
 */
#include "editor-gtk/place.h"

#include "editor-gtk/grid_display.h"
#include "editor-gtk/rung_layout.h"

#define ALPHABET ('Z' - 'A' + 1)

const char *place_column(int column, char out[PLACE_LETTERS])
{
	char *at = out;

	if (column >= ALPHABET)
		*at++ = (char)('A' + column / ALPHABET - 1);
	*at++ = (char)('A' + column % ALPHABET);
	*at = '\0';
	return out;
}

static bool holds(const struct sfc_body *body, int rung)
{
	return body->kind == BODY_RUNGS && rung >= body->first &&
	       rung < body->first + body->count;
}

/* The body of a chart that the rung is in; NULL: none. */
static const struct sfc_body *body_of(const struct sfc *sfc, int rung)
{
	for (int i = 0; i < sfc->transition_count; i++)
		if (holds(&sfc->transition[i].condition, rung))
			return &sfc->transition[i].condition;
	for (int i = 0; i < sfc->action_count; i++)
		if (holds(&sfc->action[i].body, rung))
			return &sfc->action[i].body;
	return NULL;
}

static void look(struct place_sheet *sheet, const struct project *project, int number,
		 int rung)
{
	const struct pou *pou = &project->pou[number];
	const struct sfc_body *body = pou->sfc ? body_of(pou->sfc, rung) : NULL;

	if (sheet->project == project && sheet->pou == number && rung >= sheet->first &&
	    rung < sheet->first + sheet->count)
		return;
	*sheet = (struct place_sheet){ project, number, body ? body->first : 0,
		body ? body->count : pou->rung_count, RUNG_LEAST_COLUMNS };
	for (int i = sheet->first; i < sheet->first + sheet->count; i++)
		sheet->columns = grid_display_columns(pou->rung[i], sheet->columns);
}

int place_shown(struct place_sheet *sheet, const struct project *project, int pou, int rung,
		int row, int col)
{
	const struct rung *shown;

	if (!project || pou < 0 || pou >= project->pou_count || rung < 0 ||
	    rung >= project->pou[pou].rung_count)
		return col;
	shown = project->pou[pou].rung[rung];
	if (row < 0 || row >= shown->rows || col < 0 || col >= shown->cols)
		return col;
	look(sheet, project, pou, rung);
	return grid_display_column(shown, sheet->columns, row, col);
}
