/* SPDX-License-Identifier: MIT
 *
 * sheet - layouts of all rungs of a POU; see sheet.h.
 */
#include "editor-gtk/sheet.h"

#include <glib.h>

struct sheet *sheet_new(const struct project *project, const struct pou *pou,
			struct lettering *lettering)
{
	struct sheet *sheet = g_new0(struct sheet, 1);

	sheet->pou = pou;
	sheet->drafting = (struct drafting){ .project = project, .lettering = lettering };
	return sheet;
}

static void forget(struct sheet *sheet)
{
	for (int i = 0; i < sheet->count; i++)
		rung_layout_free(sheet->rung[i]);
	g_free(sheet->rung);
	g_free(sheet->y);
	sheet->rung = NULL;
	sheet->y = NULL;
	sheet->count = 0;
}

void sheet_free(struct sheet *sheet)
{
	if (!sheet)
		return;
	forget(sheet);
	grid_names_free((struct grid_names *)sheet->drafting.names);
	g_free(sheet);
}

/* A long comment was broken into lines before it was known how wide the sheet is. */
static void use_width(struct sheet *sheet, int index)
{
	struct rung_layout *layout = sheet->rung[index];
	struct drafting wide = sheet->drafting;

	wide.width = sheet->rails;
	if (!layout->comment_lines || layout->comment_room >= sheet->rails)
		return;
	sheet->rung[index] = rung_layout_new(&wide, layout->rung, layout->number,
					     layout->rows);
	rung_layout_free(layout);
}

/* The right rail of all of them, and where each begins. */
static void align(struct sheet *sheet)
{
	float y = 0;

	sheet->rails = sheet->drafting.width;
	for (int i = 0; i < sheet->count; i++)
		sheet->rails = MAX(sheet->rails, sheet->rung[i]->natural);
	for (int i = 0; i < sheet->count; i++) {
		use_width(sheet, i);
		rung_layout_stretch(sheet->rung[i], sheet->rails);
		sheet->y[i] = y;
		y += sheet->rung[i]->height;
	}
	sheet->y[sheet->count] = y;
	sheet->height = y;
	sheet->width = RUNG_LEFT + sheet->rails + RUNG_AFTER;
}

static int columns_of(const struct pou *pou)
{
	int most = RUNG_LEAST_COLUMNS;

	for (int i = 0; i < pou->rung_count; i++)
		most = MAX(most, rung_layout_columns(pou->rung[i]));
	return most;
}

void sheet_layout(struct sheet *sheet)
{
	const struct pou *pou = sheet->pou;

	forget(sheet);
	grid_names_free((struct grid_names *)sheet->drafting.names);
	sheet->drafting.names = grid_names_new(sheet->drafting.project, pou);
	sheet->drafting.columns = columns_of(pou);
	sheet->count = pou->rung_count;
	sheet->rung = g_new(struct rung_layout *, sheet->count + 1);
	sheet->y = g_new(float, sheet->count + 1);
	for (int i = 0; i < sheet->count; i++)
		sheet->rung[i] = rung_layout_new(&sheet->drafting, pou->rung[i], i + 1, 0);
	align(sheet);
}
