/* SPDX-License-Identifier: MIT
 *
 * place - where a cell is, for a person; see place.h.
 */
#include "editor-gtk/place.h"

#include "editor-gtk/grid_display.h"
#include "editor-gtk/i18n.h"
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

/* ---- lines ---- */

/* The last of a kind that begins up to @line; -1: none. The nearest of all kinds is it. */
struct chart_part {
	int line, begins;
	int step, transition, action;
};

static bool is_nearer(struct chart_part *part, int begins)
{
	if (begins > part->line || begins <= part->begins)
		return false;
	*part = (struct chart_part){ part->line, begins, -1, -1, -1 };
	return true;
}

static struct chart_part part_at(const struct sfc *sfc, int line)
{
	struct chart_part part = { line, 0, -1, -1, -1 };

	for (int i = 0; i < sfc->step_count; i++)
		if (is_nearer(&part, sfc->step[i].line))
			part.step = i;
	for (int i = 0; i < sfc->transition_count; i++)
		if (is_nearer(&part, sfc->transition[i].line))
			part.transition = i;
	for (int i = 0; i < sfc->action_count; i++)
		if (is_nearer(&part, sfc->action[i].line))
			part.action = i;
	return part;
}

char *place_line(const struct project *project, int pou, int row)
{
	const struct pou *of = &project->pou[pou];
	const char *name = project_text(project, of->name);
	const struct sfc *sfc = of->sfc;
	const struct chart_part part = sfc ? part_at(sfc, of->line + row) :
				 (struct chart_part){ 0, 0, -1, -1, -1 };

	if (part.step >= 0)
		return g_strdup_printf(_("%s, step %s"), name,
				       project_text(project, sfc->step[part.step].name));
	if (part.transition >= 0)
		return g_strdup_printf(_("%s, transition %d"), name, part.transition + 1);
	if (part.action >= 0)
		return g_strdup_printf(_("%s, action %s"), name,
				       project_text(project, sfc->action[part.action].name));
	return g_strdup_printf(_("%s, line %d"), name, row + 1);
}
