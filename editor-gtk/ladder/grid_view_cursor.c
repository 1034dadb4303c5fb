/* SPDX-License-Identifier: MIT
 *
 * grid_view_cursor - where the cursor is, where it goes, what is selected.
 *
 * It moves over display cells, from rung to rung as if there were no border.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#define PAGE_RUNGS 5 /* that Page Down goes on                                 */
#define MARGIN    40 /* px above and below the cursor that are seen, too        */

static int rows_of(LadderGridView *view, int rung)
{
	const struct rung *shown = sheet_rung(view, rung);

	return shown ? shown->rows : 0;
}

void cursor_fit(LadderGridView *view)
{
	struct grid_cursor *cursor = &view->cursor;

	cursor->rung = CLAMP(cursor->rung, 0, MAX(sheet_rungs(view) - 1, 0));
	cursor->row = CLAMP(cursor->row, 0, MAX(rows_of(view, cursor->rung) - 1, 0));
	cursor->col = CLAMP(cursor->col, 0, view->columns - 1);
	view->selecting = false;
}

/* What Esc gives back: the rung as the cursor found it, or as Undo left it. */
void cursor_remember(LadderGridView *view)
{
	if (view->came_rung == view->cursor.rung &&
	    ladder_document_knows_place(view->document, view->came))
		return;
	view->came_rung = view->cursor.rung;
	view->came = ladder_document_place(view->document);
}

/* Several rungs are drawn anew when they are selected, and when they are no more. */
static void redraw_moved(LadderGridView *view, int from, bool several)
{
	int first, last;

	if (several || cursor_rungs(view, &first, &last)) {
		strips_redraw(view, -1);
		return;
	}
	if (from != view->cursor.rung)
		strips_redraw(view, from);
	strips_redraw(view, view->cursor.rung);
}

static void tell_selected(LadderGridView *view, bool before)
{
	int first, last;
	char *text;

	if (cursor_rungs(view, &first, &last)) {
		text = g_strdup_printf(_("Rungs %d to %d are selected"),
				       view->first + first + 1, view->first + last + 1);
		sheet_tell(view, text);
		g_free(text);
	} else if (before) {
		sheet_tell(view, "");
	}
}

void cursor_set(LadderGridView *view, struct grid_cursor to, bool extend)
{
	const int from = view->cursor.rung;
	int first, last;
	const bool several = cursor_rungs(view, &first, &last);

	if (extend && !view->selecting)
		view->anchor = view->cursor;
	to.rung = CLAMP(to.rung, 0, MAX(sheet_rungs(view) - 1, 0));
	view->cursor = to;
	cursor_fit(view);
	view->selecting = extend;
	if (from != view->cursor.rung)
		entry_close(view);
	redraw_moved(view, from, several);
	cursor_remember(view);
	cursor_reveal(view);
	sheet_moved(view);
	tell_selected(view, several);
}

bool cursor_area(LadderGridView *view, struct grid_area *area)
{
	const struct grid_cursor *a = &view->anchor, *b = &view->cursor;

	*area = (struct grid_area){ b->row, b->col, b->row, b->col };
	if (!view->selecting || a->rung != b->rung)
		return false;
	area->row = MIN(a->row, b->row);
	area->last_row = MAX(a->row, b->row);
	area->col = MIN(a->col, b->col);
	area->last_col = MAX(a->col, b->col);
	return true;
}

bool cursor_rungs(LadderGridView *view, int *first, int *last)
{
	const int other = view->selecting ? view->anchor.rung : view->cursor.rung;

	*first = MIN(view->cursor.rung, other);
	*last = MAX(view->cursor.rung, other);
	return *first != *last;
}

bool cursor_selects(LadderGridView *view, int rung, int row, int col)
{
	struct grid_area area;
	int first, last;

	if (cursor_rungs(view, &first, &last))
		return rung >= first && rung <= last;
	return cursor_area(view, &area) && rung == view->cursor.rung && row >= area.row &&
	       row <= area.last_row && col >= area.col && col <= area.last_col;
}

const struct cell *cursor_cell(LadderGridView *view, int *row, int *col)
{
	const struct rung *shown = sheet_rung(view, view->cursor.rung);
	struct grid_place place;
	const struct cell *cell;

	if (!shown || grid_display_find(shown, view->columns, view->cursor.row,
					view->cursor.col, &place) != GRID_SEEN_CELL)
		return NULL;
	if (place.box_row >= 0)
		place.row = place.box_row;
	cell = rung_at(shown, place.row, place.col);
	if (cell->word == ELEM_EMPTY || cell->word == ELEM_WIRE)
		return NULL;
	if (row)
		*row = place.row;
	if (col)
		*col = place.col;
	return cell;
}

/* ---- on the screen ---- */

static graphene_rect_t rect_at_100(LadderGridView *view)
{
	struct strip *strip;
	graphene_rect_t rect;

	if (view->cursor.rung >= (int)view->strips->len)
		return GRAPHENE_RECT_INIT(0, 0, 0, 0);
	strip = strips_get(view, view->cursor.rung);
	if (!strip->layout) /* it is gone, and the strips do not know it yet */
		return GRAPHENE_RECT_INIT(0, 0, 0, 0);
	rect = rung_layout_cell(strip->layout, view->cursor.row, view->cursor.col);
	rect.origin.y += strip->y;
	return rect;
}

graphene_rect_t cursor_rect(LadderGridView *view)
{
	const float zoom = (float)view->zoom;
	graphene_rect_t rect = rect_at_100(view);

	graphene_rect_scale(&rect, zoom, zoom, &rect);
	rect.origin.x -= (float)gtk_adjustment_get_value(view->adjustment[0]);
	rect.origin.y -= (float)gtk_adjustment_get_value(view->adjustment[1]);
	return rect;
}

/* Where what is shown with the cursor's cell begins: of the first row that is the title and
 * the comment of the rung, as far as there is room. */
static double head_of(LadderGridView *view, const graphene_rect_t *cell)
{
	const double page = gtk_adjustment_get_page_size(view->adjustment[1]);
	const double end = (cell->origin.y + cell->size.height) * view->zoom;
	const double from = cell->origin.y * view->zoom;

	if (view->cursor.row > 0 || view->cursor.rung >= (int)view->strips->len)
		return from;
	return MIN(from, MAX(strips_get(view, view->cursor.rung)->y * view->zoom,
			     end + 2 * MARGIN - page));
}

static void reveal(GtkAdjustment *adjustment, double from, double to, double margin)
{
	const double page = gtk_adjustment_get_page_size(adjustment);
	const double value = gtk_adjustment_get_value(adjustment);

	if (from - margin < value)
		gtk_adjustment_set_value(adjustment, from - margin);
	else if (to + margin > value + page)
		gtk_adjustment_set_value(adjustment, to + margin - page);
}

void cursor_reveal(LadderGridView *view)
{
	const double zoom = view->zoom;
	graphene_rect_t rect = rect_at_100(view);
	GtkAdjustment *across = view->adjustment[0], *down = view->adjustment[1];
	const double right = (rect.origin.x + rect.size.width) * zoom;
	const double end = (rect.origin.y + rect.size.height) * zoom;

	/* Of no page at all it would come to stand above the edge. */
	view->reveal = gtk_adjustment_get_page_size(down) <= 0;
	if (view->reveal)
		return;
	/* Before the next allocation they may still be too small for a new rung, or for a
	 * sheet that grew. */
	if (gtk_adjustment_get_upper(across) < right + 24)
		gtk_adjustment_set_upper(across, right + 24);
	if (gtk_adjustment_get_upper(down) < end + 60)
		gtk_adjustment_set_upper(down, end + 60);
	reveal(across, rect.origin.x * zoom, right, 24);
	reveal(down, rect.origin.y * zoom, end, MARGIN);
}

void cursor_reveal_head(LadderGridView *view)
{
	GtkAdjustment *down = view->adjustment[1];
	graphene_rect_t cell;

	cursor_reveal(view);
	cell = rect_at_100(view);
	if (!view->reveal)
		reveal(down, head_of(view, &cell),
		       (cell.origin.y + cell.size.height) * view->zoom, MARGIN);
}

void cursor_reveal_late(LadderGridView *view, double page)
{
	if (!view->reveal)
		return;
	cursor_reveal_head(view);
	strips_lay_out(view, page);
	cursor_reveal_head(view); /* rungs before it may have grown                */
}

/* Is something of its cell? */
static bool is_seen(LadderGridView *view)
{
	const graphene_rect_t cell = cursor_rect(view);
	const graphene_rect_t page = GRAPHENE_RECT_INIT(0, 0,
		(float)gtk_adjustment_get_page_size(view->adjustment[0]),
		(float)gtk_adjustment_get_page_size(view->adjustment[1]));

	return graphene_rect_intersection(&cell, &page, NULL);
}

void ladder_grid_view_set_zoom(LadderGridView *view, double zoom)
{
	const bool seen = is_seen(view);

	sheet_zoom(view, zoom);
	if (seen)
		cursor_reveal_head(view);
}

int sheet_point(LadderGridView *view, double x, double y, struct rung_hit *hit)
{
	const float at_x = (float)((x + gtk_adjustment_get_value(view->adjustment[0])) /
				   view->zoom);
	const float at_y = (float)((y + gtk_adjustment_get_value(view->adjustment[1])) /
				   view->zoom);
	const int rung = strips_at(view, at_y);
	struct strip *strip;

	if (rung < 0)
		return -1;
	strip = strips_get(view, rung);
	if (at_y > strip->y + strip->height)
		return -1;
	*hit = rung_layout_hit(&view->drafting, strip->layout, at_x, at_y - strip->y);
	return rung;
}

/* ---- keys ---- */

static struct grid_cursor up(LadderGridView *view, struct grid_cursor to)
{
	if (to.row > 0) {
		to.row--;
	} else if (to.rung > 0) {
		to.rung--;
		to.row = rows_of(view, to.rung) - 1;
	}
	return to;
}

static struct grid_cursor down(LadderGridView *view, struct grid_cursor to)
{
	if (to.row + 1 < rows_of(view, to.rung)) {
		to.row++;
	} else if (to.rung + 1 < sheet_rungs(view)) {
		to.rung++;
		to.row = 0;
	}
	return to;
}

static bool step(LadderGridView *view, guint key, struct grid_cursor *to)
{
	switch (key) {
	case GDK_KEY_Left: case GDK_KEY_KP_Left:
		to->col--;
		return true;
	case GDK_KEY_Right: case GDK_KEY_KP_Right:
		to->col++;
		return true;
	case GDK_KEY_Up: case GDK_KEY_KP_Up:
		*to = up(view, *to);
		return true;
	case GDK_KEY_Down: case GDK_KEY_KP_Down:
		*to = down(view, *to);
		return true;
	case GDK_KEY_Home: case GDK_KEY_KP_Home:
		to->col = 0;
		return true;
	case GDK_KEY_End: case GDK_KEY_KP_End:
		to->col = view->columns - 1;
		return true;
	case GDK_KEY_Page_Up:
		*to = (struct grid_cursor){ MAX(to->rung - PAGE_RUNGS, 0), 0, to->col };
		return true;
	case GDK_KEY_Page_Down:
		*to = (struct grid_cursor){ to->rung + PAGE_RUNGS, 0, to->col };
		return true;
	default:
		return false;
	}
}

/* Of several rungs one more, or one less, whatever rows they have. */
static bool step_rungs(LadderGridView *view, guint key, struct grid_cursor *to)
{
	int first, last;

	if (!cursor_rungs(view, &first, &last) || !step(view, key, to))
		return false;
	if (to->rung == view->cursor.rung && to->row != view->cursor.row)
		to->rung += to->row > view->cursor.row ? 1 : -1;
	to->row = 0;
	return true;
}

bool cursor_key(LadderGridView *view, guint key, GdkModifierType state)
{
	const bool control = state & GDK_CONTROL_MASK;
	struct grid_cursor to = view->cursor;

	if (state & GDK_ALT_MASK)
		return false;
	if (control && (key == GDK_KEY_Home || key == GDK_KEY_End))
		to = (struct grid_cursor){ key == GDK_KEY_Home ? 0 :
					   sheet_rungs(view) - 1, 0, 0 };
	else if (control || !((state & GDK_SHIFT_MASK && step_rungs(view, key, &to)) ||
			      step(view, key, &to)))
		return false;
	cursor_set(view, to, state & GDK_SHIFT_MASK);
	cursor_reveal_head(view);
	return true;
}
