/* SPDX-License-Identifier: MIT
 *
 * grid_view_cursor - the cursor and the selection of a sheet, and the exchange of its rung.
 *
 * The cursor moves over display cells, from rung to rung as if there were no border.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/diag_said.h"

#define PAGE_RUNGS 5 /* rungs of a Page Down                                   */
#define MARGIN    40 /* px shown above and below the cursor                     */

static int rows_of(LadderGridView *view, int rung)
{
	const struct rung *shown = sheet_rung(view, rung);

	return shown ? shown->rows : 0;
}

void cursor_fit(LadderGridView *view)
{
	struct grid_cursor *cursor = &view->cursor.at;

	cursor->rung = CLAMP(cursor->rung, 0, MAX(sheet_rungs(view) - 1, 0));
	cursor->row = CLAMP(cursor->row, 0, MAX(rows_of(view, cursor->rung) - 1, 0));
	cursor->col = CLAMP(cursor->col, 0, view->columns - 1);
	view->cursor.selecting = false;
}

/* Esc restores the rung as it was when the cursor came, or as Undo left it. */
static void cursor_remember(LadderGridView *view)
{
	if (view->cursor.came_rung == view->cursor.at.rung &&
	    ladder_document_knows_place(view->canvas->document, view->cursor.came))
		return;
	view->cursor.came_rung = view->cursor.at.rung;
	view->cursor.came = ladder_document_place(view->canvas->document);
}

/* All rungs are redrawn when a selection of several rungs begins, changes or ends. */
static void redraw_moved(LadderGridView *view, int from, bool several)
{
	int first, last;

	if (several || cursor_rungs(view, &first, &last)) {
		strips_redraw(view, -1);
		return;
	}
	if (from != view->cursor.at.rung)
		strips_redraw(view, from);
	strips_redraw(view, view->cursor.at.rung);
}

static void tell_selected(LadderGridView *view, bool before)
{
	int first, last;
	char *text;

	if (cursor_rungs(view, &first, &last)) {
		text = g_strdup_printf(_("Rungs %d to %d are selected"),
				       view->first + first + 1, view->first + last + 1);
		canvas_tell(LADDER_CANVAS(view), text);
		g_free(text);
	} else if (before) {
		canvas_tell(LADDER_CANVAS(view), "");
	}
}

void cursor_set(LadderGridView *view, struct grid_cursor to, bool extend)
{
	const int from = view->cursor.at.rung;
	int first, last;
	const bool several = cursor_rungs(view, &first, &last);

	if (extend && !view->cursor.selecting)
		view->cursor.anchor = view->cursor.at;
	to.rung = CLAMP(to.rung, 0, MAX(sheet_rungs(view) - 1, 0));
	if (from != to.rung)
		canvas_close_entry(LADDER_CANVAS(view)); /* it belongs to the old rung */
	view->cursor.at = to;
	cursor_fit(view);
	if (from != view->cursor.at.rung)
		strip_follow(view, from);
	strip_follow(view, view->cursor.at.rung);
	view->cursor.selecting = extend;
	redraw_moved(view, from, several);
	cursor_remember(view);
	cursor_reveal(view);
	canvas_moved(LADDER_CANVAS(view));
	tell_selected(view, several);
}

bool cursor_area(LadderGridView *view, struct grid_area *area)
{
	const struct grid_cursor *a = &view->cursor.anchor, *b = &view->cursor.at;

	*area = (struct grid_area){ b->row, b->col, b->row, b->col };
	if (!view->cursor.selecting || a->rung != b->rung)
		return false;
	area->row = MIN(a->row, b->row);
	area->last_row = MAX(a->row, b->row);
	area->col = MIN(a->col, b->col);
	area->last_col = MAX(a->col, b->col);
	return true;
}

bool cursor_rungs(LadderGridView *view, int *first, int *last)
{
	const int other = view->cursor.selecting ? view->cursor.anchor.rung : view->cursor.at.rung;

	*first = MIN(view->cursor.at.rung, other);
	*last = MAX(view->cursor.at.rung, other);
	return *first != *last;
}

bool cursor_selects(LadderGridView *view, int rung, int row, int col)
{
	struct grid_area area;
	int first, last;

	if (cursor_rungs(view, &first, &last))
		return rung >= first && rung <= last;
	return cursor_area(view, &area) && rung == view->cursor.at.rung && row >= area.row &&
	       row <= area.last_row && col >= area.col && col <= area.last_col;
}

const struct cell *cursor_cell(LadderGridView *view, int *row, int *col)
{
	const struct rung *shown = sheet_rung(view, view->cursor.at.rung);
	struct grid_place place;
	const struct cell *cell;

	if (!shown || grid_display_find(shown, view->columns, view->cursor.at.row,
					view->cursor.at.col, &place) != GRID_SEEN_CELL)
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

graphene_rect_t cursor_cell_box(LadderGridView *view)
{
	struct strip *strip;

	if (view->cursor.at.rung >= (int)view->strips->len)
		return GRAPHENE_RECT_INIT(0, 0, 0, 0);
	strip = strips_get(view, view->cursor.at.rung);
	if (!strip->layout) /* the rung is deleted, the strips are not updated yet */
		return GRAPHENE_RECT_INIT(0, 0, 0, 0);
	return strip_box(view, strip, view->cursor.at.row, view->cursor.at.col);
}

/* Upper end of the area to show: in the first row it includes title and comment of the
 * rung if the page has room. */
static double head_of(LadderGridView *view, const graphene_rect_t *cell)
{
	const double page = gtk_adjustment_get_page_size(view->canvas->adjustment[1]);
	const double end = (cell->origin.y + cell->size.height) * view->canvas->zoom;
	const double from = cell->origin.y * view->canvas->zoom;

	if (view->cursor.at.row > 0 || view->cursor.at.rung >= (int)view->strips->len)
		return from;
	return MIN(from, MAX(strips_get(view, view->cursor.at.rung)->y * view->canvas->zoom,
			     end + 2 * MARGIN - page));
}

/* Px shown left and right of the cursor: a little less than there is behind a pinned output. */
static double aside(LadderGridView *view)
{
	return RUNG_AFTER * view->canvas->zoom - 1;
}

/* The box of the cursor, with the room right of it that pinned outputs take. */
static graphene_rect_t box_to_reveal(LadderGridView *view)
{
	graphene_rect_t box = cursor_cell_box(view);
	const struct strip *strip = view->cursor.at.rung < (int)view->strips->len ?
		strips_get(view, view->cursor.at.rung) : NULL;
	const struct rung_layout *layout = strip ? strip->layout : NULL;

	if (layout && view->cursor.at.col < layout->columns - 1 && strips_pinned(view, strip) > 0)
		box.size.width += layout->column_width[layout->columns - 1];
	return box;
}

void cursor_reveal(LadderGridView *view)
{
	canvas_reveal(LADDER_CANVAS(view), box_to_reveal(view), aside(view), MARGIN);
}

void cursor_reveal_head(LadderGridView *view)
{
	graphene_rect_t box;
	float head;

	cursor_reveal(view);
	box = box_to_reveal(view);
	head = (float)(head_of(view, &box) / view->canvas->zoom);
	box.size.height += box.origin.y - head;
	box.origin.y = head;
	canvas_reveal(LADDER_CANVAS(view), box, aside(view), MARGIN);
}

graphene_point_t sheet_where(LadderGridView *view, double x, double y, int *rung)
{
	const graphene_point_t at = canvas_point(LADDER_CANVAS(view), x, y);

	*rung = strips_at(view, at.y);
	return *rung < 0 ? at : strip_laid(view, strips_get(view, *rung), at);
}

int sheet_point(LadderGridView *view, double x, double y, struct rung_hit *hit)
{
	int rung;
	const graphene_point_t at = sheet_where(view, x, y, &rung);

	if (rung < 0 || canvas_point(LADDER_CANVAS(view), x, y).y >
			strip_of(view, rung)->y + strip_of(view, rung)->height)
		return -1;
	*hit = rung_layout_hit(&view->drafting, strip_of(view, rung)->layout, at.x, at.y);
	return rung;
}

bool hit_is_cell(const struct rung_hit *hit)
{
	return hit->part == RUNG_PART_CELL || hit->part == RUNG_PART_WIRE ||
	       hit->part == RUNG_PART_LINK || hit->part == RUNG_PART_PIN;
}

/* ---- keys ---- */

/* The lines of a folded rung; NULL: it has one. */
static const struct rung_fold *fold_of(LadderGridView *view, int rung)
{
	return rung >= 0 && rung < (int)view->strips->len ? strips_get(view, rung)->fold : NULL;
}

static float middle_of(LadderGridView *view, struct grid_cursor at)
{
	const graphene_rect_t box = strip_box(view, strips_get(view, at.rung), at.row, at.col);

	return box.origin.x + box.size.width / 2;
}

static int line_of(LadderGridView *view, struct grid_cursor at)
{
	const struct rung_fold *fold = fold_of(view, at.rung);
	const struct rung_layout *layout = strips_get(view, at.rung)->layout;

	return fold ? rung_fold_line_at(fold, layout->column_x[at.col] + layout->column_width[at.col] / 2) : 0;
}

/* The cell of a line that is nearest to @x: in its first row, or in its last one. */
static struct grid_cursor in_line(LadderGridView *view, int rung, int line, float x, bool in_last)
{
	const struct rung_fold_line *shown = &fold_of(view, rung)->line[line];
	struct grid_cursor best = { rung, in_last ? shown->rows - 1 : 0, shown->first }, at = best;

	for (at.col = shown->first; at.col < shown->last; at.col++)
		if (ABS(middle_of(view, at) - x) < ABS(middle_of(view, best) - x))
			best = at;
	return best;
}

/* The cell of a rung that is not folded, below or above one that is. */
static struct grid_cursor in_rung(LadderGridView *view, int rung, int row, float x)
{
	struct grid_cursor best = { rung, row, 0 }, at = best;

	for (at.col = 0; at.col < view->columns; at.col++)
		if (ABS(middle_of(view, at) - x) < ABS(middle_of(view, best) - x))
			best = at;
	return best;
}

/* From @from to another rung: the same column, or the nearest one if one of the rungs is folded. */
static struct grid_cursor to_rung(LadderGridView *view, struct grid_cursor from, int rung, bool in_last)
{
	const int row = in_last ? rows_of(view, rung) - 1 : 0;
	const struct rung_fold *fold = fold_of(view, rung);

	if (fold)
		return in_line(view, rung, in_last ? fold->lines - 1 : 0, middle_of(view, from), in_last);
	return fold_of(view, from.rung) ? in_rung(view, rung, row, middle_of(view, from)) :
					  (struct grid_cursor){ rung, row, from.col };
}

static struct grid_cursor up(LadderGridView *view, struct grid_cursor to)
{
	const int line = line_of(view, to);

	if (to.row > 0)
		to.row--;
	else if (line > 0)
		to = in_line(view, to.rung, line - 1, middle_of(view, to), true);
	else if (to.rung > 0)
		to = to_rung(view, to, to.rung - 1, true);
	return to;
}

static struct grid_cursor down(LadderGridView *view, struct grid_cursor to)
{
	const struct rung_fold *fold = fold_of(view, to.rung);
	const int line = line_of(view, to);

	if (to.row + 1 < (fold ? fold->line[line].rows : rows_of(view, to.rung)))
		to.row++;
	else if (fold && line + 1 < fold->lines)
		to = in_line(view, to.rung, line + 1, middle_of(view, to), false);
	else if (to.rung + 1 < sheet_rungs(view))
		to = to_rung(view, to, to.rung + 1, false);
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

/* A selection of several rungs grows or shrinks by whole rungs. */
static bool step_rungs(LadderGridView *view, guint key, struct grid_cursor *to)
{
	int first, last;

	if (!cursor_rungs(view, &first, &last) || !step(view, key, to))
		return false;
	if (to->rung == view->cursor.at.rung && to->row != view->cursor.at.row)
		to->rung += to->row > view->cursor.at.row ? 1 : -1;
	to->row = 0;
	return true;
}

bool cursor_key(LadderCanvas *canvas, guint key, GdkModifierType state)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const bool control = state & GDK_CONTROL_MASK;
	struct grid_cursor to = view->cursor.at;

	if (state & GDK_ALT_MASK)
		return false;
	if (control && (key == GDK_KEY_Home || key == GDK_KEY_End))
		to = (struct grid_cursor){ key == GDK_KEY_Home ? 0 :
					   sheet_rungs(view) - 1, 0, 0 };
	else if (control || !((state & GDK_SHIFT_MASK && step_rungs(view, key, &to)) ||
			      step(view, key, &to)))
		return false;
	view->cursor.moved = true;
	cursor_set(view, to, state & GDK_SHIFT_MASK);
	cursor_reveal_head(view);
	return true;
}

/* ---- the rung at the cursor is exchanged ---- */

struct grid_at sheet_at(LadderGridView *view)
{
	return (struct grid_at){ .columns = view->columns, .row = view->cursor.at.row,
				 .col = view->cursor.at.col };
}

static void tell_diags(LadderGridView *view, const struct diag_list *why)
{
	char *text;

	text = why->count ? diag_said_whole(&why->diag[0]) :
	       g_strdup(_("A rung file cannot hold this."));
	canvas_tell(LADDER_CANVAS(view), text);
	g_free(text);
}

bool sheet_put(LadderGridView *view, struct rung *rung, const struct grid_at *at,
	       const char *name)
{
	struct diag_list why;
	bool good;

	if (!rung) {
		canvas_tell(LADDER_CANVAS(view), _(grid_refusal_text(at->refusal)));
		return false;
	}
	diag_init(&why);
	cursor_remember(view);
	ladder_document_begin(view->canvas->document, name, NULL);
	good = sheet_splice(view, view->cursor.at.rung, 1, &rung, 1, &why);
	ladder_document_end(view->canvas->document);
	if (!good) {
		tell_diags(view, &why);
		return false;
	}
	canvas_tell(LADDER_CANVAS(view), "");
	cursor_set(view, (struct grid_cursor){ view->cursor.at.rung, at->row, at->col },
		   false);
	return true;
}
