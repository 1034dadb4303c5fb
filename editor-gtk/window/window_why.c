/* SPDX-License-Identifier: MIT
 *
 * window_why - why the element at the cursor has no power, or by what ways it has it.
 *
 * The engine finds the reasons (trial/why.h); here they are marked in the rung and told in
 * the status bar, for the scan that is shown, until somebody asks again.
 */
#include "editor-gtk/window/window_inside.h"

#include "engine/trial/why.h"

#include <string.h>

/* What was asked; of the document. */
struct window_why {
	LadderGridView *sheet;  /* weak; NULL: nothing                         */
	int rung, row, col;     /* 0-based, of the rung                        */
	char *told;
};

static struct window_why *why_of(LadderWindow *window)
{
	return window->why;
}

static void forget(struct window_why *asked)
{
	if (asked->sheet)
		ladder_grid_view_set_blockers(asked->sheet, -1, NULL, 0);
	g_clear_weak_pointer(&asked->sheet);
	g_clear_pointer(&asked->told, g_free);
}

void window_why_free(LadderWindow *window)
{
	struct window_why *asked = why_of(window);

	if (!asked)
		return;
	g_clear_weak_pointer(&asked->sheet);
	g_free(asked->told);
	g_clear_pointer(&window->why, g_free);
}

/* ---- in words ---- */

/* The texts of why.def have one %s at most. */
static void append_said(GString *out, enum why_kind kind, bool on, const char *name)
{
	const char *text = said(why_text(kind, on)), *hole = strstr(text, "%s");

	if (!hole) {
		g_string_append(out, text);
		return;
	}
	g_string_append_len(out, text, hole - text);
	g_string_append(out, name);
	g_string_append(out, hole + strlen("%s"));
}

static void append_cell(GString *out, const struct why_cell *cell, bool on)
{
	append_said(out, cell->kind, on, cell->name);
	if (cell->values[0])
		g_string_append_printf(out, " (%s)", cell->values);
}

/* "Off: Start is FALSE; or Motor is FALSE". Caller frees. */
static char *in_words(const struct why *why)
{
	GString *out = g_string_new(why->on ? _("It has power: ") : _("No power: "));

	if (why->whole != WHY_COUNT)
		append_said(out, why->whole, false, why->name);
	for (int i = 0; i < why->ways; i++) {
		if (i)
			g_string_append(out, why->on ? _("; and ") : _("; or "));
		for (int k = 0; k < why->way[i].count; k++) {
			g_string_append(out, k ? _(" and ") : "");
			append_cell(out, &why->way[i].cell[k], why->on);
		}
		if (!why->way[i].count)
			g_string_append(out, _("from the left rail"));
	}
	if (why->more)
		g_string_append(out, " …");
	return g_string_free(out, FALSE);
}

/* ---- in the rung ---- */

static bool has(const GArray *cells, const struct why_cell *cell)
{
	for (guint i = 0; i < cells->len; i++) {
		const struct grid_blocker *one = &g_array_index(cells, struct grid_blocker, i);

		if (one->row == cell->row - 1 && one->col == cell->col - 1)
			return true;
	}
	return false;
}

static void mark(struct window_why *asked, const struct why *why)
{
	GArray *cells = g_array_new(FALSE, FALSE, sizeof(struct grid_blocker));

	for (int i = 0; !why->on && i < why->ways; i++)
		for (int k = 0; k < why->way[i].count; k++) {
			const struct why_cell *cell = &why->way[i].cell[k];
			const struct grid_blocker one = { cell->row - 1, cell->col - 1, NULL };

			if (!has(cells, cell))
				g_array_append_val(cells, one);
		}
	ladder_grid_view_set_blockers(asked->sheet, asked->rung,
		(const struct grid_blocker *)(gpointer)cells->data, (int)cells->len);
	g_array_unref(cells);
}

/* ---- asking ---- */

static bool ask(LadderWindow *window, struct window_why *asked, struct why *why)
{
	const struct twin *twin = ladder_sim_twin(window->sim);
	const int pou = ladder_grid_view_pou(asked->sheet);
	const int rung = ladder_sim_rung(window->sim,
		ladder_grid_view_document(asked->sheet), pou,
		asked->rung + ladder_grid_view_first(asked->sheet));
	struct arena arena;
	bool good;

	if (!twin || rung < 0)
		return false;
	arena_init(&arena);
	good = why_ask(&(struct why_place){
		.project = ladder_project(ladder_sim_ladder(window->sim)),
		.resource = &twin->resource, .pou = pou,
		.instance = ladder_grid_view_instance(asked->sheet),
		.rung = rung + 1, .row = asked->row + 1, .col = asked->col + 1,
	}, &arena, why);
	arena_free(&arena);
	return good;
}

static void tell(LadderWindow *window, struct window_why *asked, const struct why *why)
{
	char *text = in_words(why);

	if (g_strcmp0(text, asked->told) != 0) {
		mark(asked, why);
		ladder_window_tell(window, text);
	}
	g_free(asked->told);
	asked->told = text;
}

/* The answer of the scan that is shown now. */
static void look(LadderWindow *window)
{
	struct window_why *asked = why_of(window);
	struct why *why;

	if (!asked->sheet)
		return;
	why = g_new0(struct why, 1);
	if (ask(window, asked, why))
		tell(window, asked, why);
	else
		forget(asked);
	g_free(why);
}

/* The element at the cursor, else the first output of its rung. */
static bool meant(LadderGridView *sheet, int *row, int *col)
{
	const struct project *project = ladder_document_project(
		ladder_grid_view_document(sheet));
	const struct rung *rung = project->pou[ladder_grid_view_pou(sheet)]
		.rung[ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung];

	if (ladder_grid_view_cell(sheet, row, col))
		return true;
	*col = rung->cols - 1;
	for (*row = 0; *row < rung->rows; (*row)++)
		if (word_row(rung_at(rung, *row, *col)->word)->place == PLACE_LAST)
			return true;
	return false;
}

void window_why_ask(LadderWindow *window)
{
	struct window_why *asked = why_of(window);
	LadderGridView *sheet = tabs_seen_sheet(window);
	LadderSfcView *chart = tabs_seen_chart(window);
	int row, col;
	const int rung = sheet ? ladder_grid_view_cursor(sheet).rung : -1;
	bool again;

	if (!ladder_sim_is_on(window->sim)) {
		ladder_window_tell(window, _("Simulate first: then it can be told"));
		return;
	}
	/* A condition is shown as rungs first, with the power that they have. */
	if (!sheet && chart && ladder_sfc_view_why(chart))
		return;
	if (!sheet || !meant(sheet, &row, &col)) {
		ladder_window_tell(window, _("Put the cursor on the element that is meant"));
		return;
	}
	again = asked->sheet == sheet && asked->rung == rung && asked->row == row &&
		asked->col == col;
	forget(asked);
	ladder_window_tell(window, "");
	if (again)
		return;
	g_set_weak_pointer(&asked->sheet, sheet);
	asked->rung = rung;
	asked->row = row;
	asked->col = col;
	look(window);
	if (!asked->sheet)
		ladder_window_tell(window, _("This rung is not in the program that runs"));
}

void window_why_init(LadderWindow *window)
{
	window->why = g_new0(struct window_why, 1);
	g_signal_connect_object(window->sim, "shown", G_CALLBACK(look), window,
				G_CONNECT_SWAPPED);
}
