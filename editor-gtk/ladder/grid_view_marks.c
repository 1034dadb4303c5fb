/* SPDX-License-Identifier: MIT
 *
 * grid_view_marks - what is marked in a rung of a sheet: the cursor, what is selected, what
 * the checks say, what was found.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

static void push_mark(GArray *marks, int row, int column, unsigned int mark)
{
	const struct grid_mark one = { row, column, mark };

	g_array_append_val(marks, one);
}

static void mark_selection(LadderGridView *view, int rung, GArray *marks)
{
	struct grid_area area;

	if (rung != view->cursor.rung)
		return;
	if (cursor_area(view, &area))
		for (int row = area.row; row <= area.last_row; row++)
			for (int col = area.col; col <= area.last_col; col++)
				push_mark(marks, row, col, MARK_SELECTED);
	if (gtk_widget_has_focus(GTK_WIDGET(view)) || view->entry)
		push_mark(marks, view->cursor.row, view->cursor.col, MARK_CURSOR);
	else
		push_mark(marks, view->cursor.row, view->cursor.col, MARK_SELECTED);
}

static void mark_checks(LadderGridView *view, int rung, GArray *marks)
{
	const struct rung *shown = sheet_rung(view, rung);

	for (guint i = 0; i < view->marks->len; i++) {
		const struct sheet_mark *mark =
			&g_array_index(view->marks, struct sheet_mark, i);

		if (mark->rung == rung && mark->row >= 0 && mark->row < shown->rows &&
		    mark->col >= 0 && mark->col < shown->cols)
			push_mark(marks, mark->row,
				  grid_display_column(shown, view->columns, mark->row,
						      mark->col), mark->marks);
	}
}

void marks_push(LadderGridView *view, int rung, GArray *marks)
{
	mark_selection(view, rung, marks);
	mark_checks(view, rung, marks);
	if (rung == view->found.rung)
		push_mark(marks, view->found.row, view->found.col, MARK_FOUND);
}

unsigned int marks_state(LadderGridView *view, int rung)
{
	unsigned int state = RUNG_ON_GUTTER;
	int first, last;

	if (rung == view->cursor.rung)
		state |= RUNG_CURRENT;
	if (cursor_rungs(view, &first, &last) && rung >= first && rung <= last)
		state |= RUNG_SELECTED;
	return state;
}
