/* SPDX-License-Identifier: MIT
 *
 * grid_view_drop - what a sheet shows while something is dragged over it: the cells that
 * take an element, the one that is meant, the line where a rung would come.
 *
 * Which cells take it is asked as a rung is drawn, so only of what is seen, and once: its
 * drawing is kept until something of it changes. It moves nothing.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/draw/ghost.h"

#include <math.h>

#define LINE      3 /* px thick; odd, so that its middle is a pixel            */
#define KNOB     11 /* px square, at the ends of the line                      */

/* ---- an element ---- */

void drop_word(LadderGridView *view, enum word word)
{
	if (word == view->drop_word)
		return;
	view->drop_word = word;
	strips_redraw(view, -1);
}

static const char *why_not(LadderGridView *view, int rung, int row, int col)
{
	struct grid_at at = { .columns = view->columns, .row = row, .col = col };

	rung_free(grid_drop(sheet_rung(view, rung), &at,
			    (struct cell){ .word = (uint16_t)view->drop_word }));
	return _(grid_refusal_text(at.refusal));
}

void drop_at_cell(LadderGridView *view, int rung, int row, int col, bool legal)
{
	const int before = view->drop.rung;

	if (rung == before && row == view->drop.row && col == view->drop.col &&
	    legal == view->drop_legal)
		return;
	view->drop = (struct grid_cursor){ rung, row, col };
	view->drop_legal = legal;
	if (rung >= 0) /* it stays when it is let go there */
		sheet_tell(view, legal ? "" : why_not(view, rung, row, col));
	if (before >= 0)
		strips_dirty(view, before);
	if (rung >= 0)
		strips_dirty(view, rung); /* it may need a row more */
}

bool *drop_takes(LadderGridView *view, int rung, const struct rung_layout *layout)
{
	const struct grid_cursor *meant = &view->drop;
	bool *takes;

	if (view->drop_word == ELEM_EMPTY)
		return NULL;
	takes = g_new0(bool, layout->rows * layout->columns);
	grid_takes(sheet_rung(view, rung), layout->columns, layout->rows, view->drop_word,
		   takes);
	if (rung == meant->rung && meant->row < layout->rows && meant->col < layout->columns)
		takes[meant->row * layout->columns + meant->col] = false; /* it has a frame */
	return takes;
}

void drop_mark(LadderGridView *view, int rung, GArray *marks)
{
	const struct grid_mark meant = { view->drop.row, view->drop.col,
					 view->drop_legal ? MARK_DROP : MARK_ILLEGAL };

	if (rung == view->drop.rung)
		g_array_append_val(marks, meant);
}

/* ---- a rung ---- */

void drop_line(LadderGridView *view, int before)
{
	if (before == view->drop_line)
		return;
	view->drop_line = before;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

int drop_boundary(LadderGridView *view, double y)
{
	const float at = (float)((y + gtk_adjustment_get_value(view->adjustment[1])) /
				 view->zoom);
	const int rung = strips_at(view, at);
	const struct strip *strip;

	if (rung < 0)
		return 0;
	strip = strips_get(view, rung);
	return at > strip->y + strip->height / 2 ? rung + 1 : rung;
}

static void fill(GtkSnapshot *snapshot, const struct theme *theme, float x, float y,
		 float width, float height)
{
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_ACCENT],
				  &GRAPHENE_RECT_INIT(x, y, width, height));
}

void drop_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme)
{
	const float width = (float)gtk_widget_get_width(GTK_WIDGET(view));
	const double top = gtk_adjustment_get_value(view->adjustment[1]);
	float y;

	if (view->drop_line < 0)
		return;
	y = view->drop_line < sheet_rungs(view) ? strips_get(view, view->drop_line)->y :
						  strips_height(view);
	y = MAX(roundf((float)((double)y * view->zoom - top)), LINE / 2); /* the first one */
	fill(snapshot, theme, 0, y - LINE / 2, width, LINE);
	fill(snapshot, theme, 0, y - KNOB / 2, KNOB, KNOB);
	fill(snapshot, theme, width - KNOB, y - KNOB / 2, KNOB, KNOB);
}

void drop_rung_ghost(LadderGridView *view, GtkDragSource *source, int rung)
{
	const struct strip *strip = strips_get(view, rung);
	const double x = view->press_x + gtk_adjustment_get_value(view->adjustment[0]);
	const double y = view->press_y + gtk_adjustment_get_value(view->adjustment[1]);

	if (strip->layout)
		ghost_rung(source, &view->drafting, strip->layout, strips_theme(view),
			   (float)view->zoom, (float)(x / view->zoom),
			   (float)(y / view->zoom) - strip->y);
}

/* ---- the end ---- */

void drop_forget(LadderGridView *view)
{
	drop_word(view, ELEM_EMPTY);
	drop_at_cell(view, -1, 0, 0, false);
	drop_line(view, -1);
}
