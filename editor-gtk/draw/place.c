/* SPDX-License-Identifier: MIT
 *
 * place - the name of a place for the user; see place.h.
 */
#include "editor-gtk/draw/place.h"

#include "editor-gtk/edit/fbd_lines.h"
#include "editor-gtk/edit/grid_display.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/draw/sfc_bodies.h"
#include "editor-gtk/edit/sfc_lines.h"
#include "engine/model/st.h"

#include <glib.h>

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

/* The body of a chart that contains the rung; NULL: none. */
static const struct sfc_body *body_of(const struct sfc *sfc, int rung)
{
	for (int i = 0; i < sfc_bodies(sfc); i++) {
		const struct sfc_body *body = sfc_body(sfc, i);

		if (body->kind == BODY_RUNGS && rung >= body->first &&
		    rung < body->first + body->count)
			return body;
	}
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

/* Its name, or the steps before and behind it: the user sees no numbers of transitions. */
static char *transition_text(const struct project *project, const struct sfc *sfc, int index)
{
	const char *name = project_text(project, sfc->transition[index].name);

	return *name ? g_strdup(name) : sfc_bodies_ways(project, sfc, index);
}

static char *chart_text(const struct project *project, const struct sfc *sfc, const char *pou,
			int line)
{
	const struct sfc_spot spot = sfc_spot_at(project, sfc, line);
	char *transition, *text;
	int step = spot.index;

	switch (spot.kind) {
	case SPOT_USE:
		step = sfc->use[spot.index].step;
		/* fall through */
	case SPOT_STEP:
		return g_strdup_printf(_("%s, step %s"), pou,
				       project_text(project, sfc->step[step].name));
	case SPOT_TRANSITION:
		transition = transition_text(project, sfc, spot.index);
		text = g_strdup_printf(_("%s, transition %s"), pou, transition);
		g_free(transition);
		return text;
	case SPOT_ACTION:
		return g_strdup_printf(_("%s, action %s"), pou,
				       project_text(project, sfc->action[spot.index].name));
	case SPOT_CONTROL:
		return g_strdup_printf("%s, CONTROL", pou);
	case SPOT_NONE:
		break;
	}
	return g_strdup(pou);
}

/* The EXECUTE box that holds a line of the file; NULL: none. */
static const struct boxed *boxed_at(const struct pou *pou, int line)
{
	const struct boxed *found = NULL;

	for (int i = 0; i < pou->boxed_count; i++) {
		const struct boxed *boxed = &pou->boxed[i];

		if (boxed->count > 0 && line > boxed->line &&
		    line <= pou->st->item[boxed->first + boxed->count - 1].line)
			found = boxed;
	}
	return found;
}

/* The network that has a line of the file, from 0; -1: it is above the first one. */
static int network_of(const struct pou *pou, int line)
{
	int network = fbd_lines_count(pou) - 1;

	while (network >= 0 && fbd_lines_line(pou, network) > line)
		network--;
	return network;
}

char *place_line(const struct project *project, int pou, int row)
{
	const struct pou *of = &project->pou[pou];
	const struct boxed *boxed = boxed_at(of, of->line + row);
	const char *name = project_text(project, of->name);
	char *path, *text;

	if (of->sfc && !boxed)
		return chart_text(project, of->sfc, name, of->line + row);
	if (network_of(of, of->line + row) >= 0)
		return g_strdup_printf(_("%s, network %d"), name, network_of(of, of->line + row) + 1);
	path = !boxed ? g_strdup(name) :
	       g_strdup_printf("%s.%s", name, boxed->name ? project_text(project, boxed->name) : "EXECUTE");
	row -= boxed ? boxed->line - of->line + 1 : of->kind == POU_ACTION && row > 0;
	text = g_strdup_printf(_("%s, line %d"), path, row + 1);
	g_free(path);
	return text;
}

/* ---- rungs ---- */

static bool holds(const struct sfc_body *body, int rung)
{
	return (body->kind == BODY_RUNGS || body->kind == BODY_EXPRESSION) &&
	       rung >= body->first && rung < body->first + body->count;
}

char *place_rung(const struct project *project, int pou, int rung, bool *whole)
{
	const struct sfc *sfc = project->pou[pou].sfc;
	const char *name = project_text(project, project->pou[pou].name);
	char *transition, *text;

	*whole = false;
	for (int i = 0; sfc && i < sfc->transition_count; i++) {
		if (!holds(&sfc->transition[i].condition, rung))
			continue;
		*whole = sfc->transition[i].condition.kind == BODY_EXPRESSION;
		transition = transition_text(project, sfc, i);
		text = g_strdup_printf(_("%s, transition %s"), name, transition);
		g_free(transition);
		return text;
	}
	for (int i = 0; sfc && i < sfc->action_count; i++)
		if (holds(&sfc->action[i].body, rung))
			return g_strdup_printf(_("%s, action %s"), name,
					       project_text(project, sfc->action[i].name));
	return g_strdup(name);
}

char *place_cell(struct place_sheet *sheet, const struct project *project, int pou, int rung,
		 int row, int col)
{
	const int seen = place_shown(sheet, project, pou, rung, row, col);
	char column[PLACE_LETTERS], *text;
	bool whole;
	char *part = place_rung(project, pou, rung, &whole);

	if (whole)
		return part;
	text = row < 0 ? g_strdup_printf(_("%s, rung %d"), part, rung + 1) :
	       g_strdup_printf(_("%s, rung %d, row %d, column %s"), part, rung + 1, row + 1,
			       place_column(seen > 0 ? seen : 0, column));
	g_free(part);
	return text;
}
