/* SPDX-License-Identifier: MIT
 *
 * sheet - layouts of all rungs of a POU; see sheet.h.
 */
#include "editor-gtk/draw/sheet.h"
#include "editor-gtk/draw/rung_text.h"

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

/* Breaks a long heading again, now that the width of the sheet is known. */
static void use_width(struct sheet *sheet, int index)
{
	struct rung_layout *layout = sheet->rung[index];
	struct drafting wide = sheet->drafting;

	wide.width = sheet->rails;
	wide.columns = layout->columns;
	if ((!layout->comment_lines && !layout->title_lines) ||
	    layout->heading_room >= sheet->rails)
		return;
	sheet->rung[index] = rung_layout_new(&wide, layout->rung, layout->number,
					     layout->rows);
	rung_layout_free(layout);
}

bool sheet_is_wide(const struct sheet *sheet, int index)
{
	return sheet->most > 0 && sheet->rung[index]->natural > sheet->most;
}

/* px of the widest rung, apart from those that are too wide. */
static float rails_of(const struct sheet *sheet)
{
	float most = sheet->drafting.width;

	for (int i = 0; i < sheet->count; i++)
		if (!sheet_is_wide(sheet, i))
			most = MAX(most, sheet->rung[i]->natural);
	return most;
}

/* Sets the right rail of all rungs, and where each begins. */
static void align(struct sheet *sheet)
{
	float y = 0;

	sheet->rails = rails_of(sheet);
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

/* Most columns of all rungs that are not too wide by themselves. */
static int columns_of(const struct sheet *sheet)
{
	const struct pou *pou = sheet->pou;
	int most = RUNG_LEAST_COLUMNS;

	for (int i = 0; i < sheet->count; i++)
		if (!sheet_is_wide(sheet, i))
			most = MAX(most, rung_layout_columns(pou->rung[i]));
	return most;
}

static void lay_out(struct sheet *sheet, int index, int columns)
{
	sheet->drafting.columns = columns;
	rung_layout_free(sheet->rung[index]);
	sheet->rung[index] = rung_layout_new(&sheet->drafting, sheet->pou->rung[index],
					     index + 1, 0);
}

/* All rungs get the same columns, unless that makes the sheet wider. */
static void share_columns(struct sheet *sheet)
{
	const int columns = columns_of(sheet);
	const float rails = sheet->most > 0 ? rails_of(sheet) : 0;

	for (int i = 0; i < sheet->count; i++) {
		if (sheet_is_wide(sheet, i))
			continue;
		lay_out(sheet, i, columns);
		if (rails > 0 && sheet->rung[i]->natural > rails)
			lay_out(sheet, i, 0);
	}
	sheet->drafting.columns = columns;
}

void sheet_layout(struct sheet *sheet)
{
	const struct pou *pou = sheet->pou;

	forget(sheet);
	grid_names_free((struct grid_names *)sheet->drafting.names);
	sheet->drafting.names = grid_names_new(sheet->drafting.project, pou);
	sheet->count = pou->rung_count;
	sheet->rung = g_new0(struct rung_layout *, sheet->count + 1);
	sheet->y = g_new(float, sheet->count + 1);
	if (sheet->most > 0)
		for (int i = 0; i < sheet->count; i++)
			lay_out(sheet, i, 0);
	share_columns(sheet);
	align(sheet);
}

static void add_remark(const struct sheet *sheet, int index, int at, GPtrArray *lines)
{
	const struct rung *rung = sheet->rung[index]->rung;
	const struct cell *cell = &rung->cell[at];
	const struct word_row *word = words_row(&sheet->drafting.project->words, cell->word);
	const struct lettered whole = rung_element_comment(&sheet->drafting, cell, 0);
	const struct rung_label label = rung_label(&sheet->drafting, cell);

	if (word->kind != WORD_ELEM || word->place == PLACE_NONE ||
	    word->place == PLACE_WIRE || word->place == PLACE_PIN ||
	    whole.width <= LABEL_BOUND)
		return;
	g_ptr_array_add(lines, g_strdup_printf("%d (%d,%d) %s%s%s: %s",
		sheet->rung[index]->number, at / rung->cols + 1, at % rung->cols + 1,
		label.symbol.text, *label.symbol.text && *label.address.text ? " " : "",
		label.address.text, whole.text));
}

void sheet_remarks(const struct sheet *sheet, int index, GPtrArray *lines)
{
	const struct rung *rung = sheet->rung[index]->rung;

	for (int i = 0; i < rung->rows * rung->cols; i++)
		add_remark(sheet, index, i, lines);
}
