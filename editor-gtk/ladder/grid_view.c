/* SPDX-License-Identifier: MIT
 *
 * grid_view - the class of the sheet of rungs: drawing, keys, clicks, changes of the document.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/settings.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderGridView, ladder_grid_view, LADDER_TYPE_CANVAS)

/* (int rung, int row, int col), of the POU, 0-based: Enter at an EXECUTE box. */
static guint statements_wanted;

/* ---- drawing ---- */

#define AHEAD 1.3 /* pages above and below the screen that are drawn before      */
#define BELOW 120 /* px of free sheet below the last rung                        */
#define HIDDEN_SLICE 4  /* px left of the outputs, where there are only wires    */
#define HIDDEN_DOT   3  /* px of a dot for hidden elements                       */
#define HIDDEN_ABOVE 12 /* px from the wire up to the dots                       */

/* Rails and columns follow the width of the page, a folded rung has other lines: a cell keeps its meaning. */
static struct canvas_hold hold(LadderCanvas *canvas, graphene_point_t at)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const int rung = strips_at(view, at.y);
	const struct strip *strip = rung < 0 ? NULL : strips_get(view, rung);
	const struct rung_layout *layout = strip ? strip->layout : NULL;
	const graphene_point_t laid = layout ? strip_laid(view, strip, at) : at;
	int column = 0;

	if (!layout || laid.x < RUNG_LEFT || laid.y > layout->height)
		return (struct canvas_hold){ layout ? rung : -1, -1, laid.x, laid.y };
	while (column + 1 < layout->columns && laid.x >= layout->column_x[column + 1])
		column++;
	return (struct canvas_hold){ rung, column, (laid.x - layout->column_x[column]) / layout->column_width[column],
				     laid.y };
}

static graphene_point_t held(LadderCanvas *canvas, const struct canvas_hold *hold)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const struct strip *strip = hold->number >= 0 && hold->number < sheet_rungs(view) ?
				    strips_get(view, hold->number) : NULL;
	float x = hold->x;

	if (!strip || !strip->layout)
		return GRAPHENE_POINT_INIT(hold->x, hold->y);
	if (hold->column >= 0 && hold->column < strip->layout->columns)
		x = strip->layout->column_x[hold->column] + hold->x * strip->layout->column_width[hold->column];
	return strip->fold ? strip_shown(view, strip, x, hold->y) : GRAPHENE_POINT_INIT(x, strip->y + hold->y);
}

static graphene_size_t size(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	return GRAPHENE_SIZE_INIT(strips_width(view), strips_height(view) + BELOW);
}

static void mark_selection(LadderGridView *view, int rung, GArray *marks)
{
	struct grid_area area;

	if (rung != view->cursor.at.rung)
		return;
	if (cursor_area(view, &area))
		for (int row = area.row; row <= area.last_row; row++)
			for (int col = area.col; col <= area.last_col; col++)
				mark_push(marks, row, col, MARK_SELECTED);
	if (gtk_widget_has_focus(GTK_WIDGET(view)) || view->canvas->entry)
		mark_push(marks, view->cursor.at.row, view->cursor.at.col, MARK_CURSOR);
	else
		mark_push(marks, view->cursor.at.row, view->cursor.at.col, MARK_SELECTED);
}

static void mark_checks(LadderGridView *view, int rung, GArray *marks)
{
	const struct rung *shown = sheet_rung(view, rung);

	for (guint i = 0; i < view->marks->len; i++) {
		const struct sheet_mark *mark =
			&g_array_index(view->marks, struct sheet_mark, i);

		if (mark->rung == rung && mark->row >= 0 && mark->row < shown->rows &&
		    mark->col >= 0 && mark->col < shown->cols)
			mark_push(marks, mark->row,
				  grid_display_column(shown, view->columns, mark->row,
						      mark->col), mark->marks);
	}
}

/* The first hit of a search in a rung or behind it; they are in the order of the rungs. */
static guint first_found(LadderGridView *view, int rung)
{
	guint from = 0, to = view->found->len;

	while (from < to) {
		const guint middle = (from + to) / 2;

		if (g_array_index(view->found, struct found_cell, middle).rung < rung)
			from = middle + 1;
		else
			to = middle;
	}
	return from;
}

static void mark_found(LadderGridView *view, int rung, GArray *marks)
{
	const struct rung *shown = sheet_rung(view, rung);

	for (guint i = first_found(view, rung); i < view->found->len; i++) {
		const struct found_cell *cell = &g_array_index(view->found, struct found_cell, i);

		if (cell->rung != rung)
			break;
		if (cell->row >= 0 && cell->row < shown->rows && cell->col >= 0 && cell->col < shown->cols)
			mark_push(marks, cell->row, grid_display_column(shown, view->columns, cell->row, cell->col),
				  MARK_FOUND | (cell->now ? MARK_FOUND_NOW : 0u));
	}
}

/* Hits in the title, the comment or the label of a rung. */
static unsigned int found_state(LadderGridView *view, int rung)
{
	unsigned int state = 0;

	for (guint i = first_found(view, rung); i < view->found->len; i++) {
		const struct found_cell *cell = &g_array_index(view->found, struct found_cell, i);

		if (cell->rung != rung)
			break;
		if (cell->row < 0)
			state |= RUNG_FOUND | (cell->now ? RUNG_FOUND_NOW : 0u);
	}
	return state;
}

static void marks_push(LadderGridView *view, int rung, GArray *marks)
{
	mark_selection(view, rung, marks);
	mark_checks(view, rung, marks);
	mark_found(view, rung, marks);
}

static unsigned int marks_state(LadderGridView *view, int rung)
{
	unsigned int state = RUNG_ON_GUTTER | found_state(view, rung);
	int first, last;

	if (rung == view->cursor.at.rung)
		state |= RUNG_CURRENT | (view->cursor.moved ? RUNG_GRID : 0u);
	if (cursor_rungs(view, &first, &last) && rung >= first && rung <= last)
		state |= RUNG_SELECTED;
	return state;
}

/* A rung that is edited shows no values: it does not run. */
static struct grid_live live_of(LadderGridView *view, int rung, const struct strip *strip,
				uint8_t **unknown)
{
	const struct rung *shown = sheet_rung(view, rung);

	if (strip->live && shown != view->preview)
		return (struct grid_live){ strip->live->bits, live_rung_value,
					   strip->live };
	*unknown = g_new0(uint8_t, shown->rows * shown->cols);
	return (struct grid_live){ *unknown, NULL, NULL };
}

static void draw_strip(LadderGridView *view, int rung, struct strip *strip)
{
	GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct grid_mark));
	struct live_place place = { view, rung };
	struct grid_scene scene = {
		.drafting = &view->drafting, .layout = strip->layout, .fold = strip->fold,
		.theme = canvas_theme(LADDER_CANVAS(view)), .note = live_note, .context = &place,
		.state = marks_state(view, rung),
		.scale = (float)(view->canvas->zoom * gtk_widget_get_scale_factor(GTK_WIDGET(view))),
	};
	struct grid_live live;
	uint8_t *unknown = NULL;
	bool *takes = drop_takes(view, rung, strip->layout);

	live_look(view, rung);
	if (canvas_is_live(LADDER_CANVAS(view))) {
		live = live_of(view, rung, strip, &unknown);
		scene.live = &live;
		scene.state |= view->live.still ? RUNG_STILL : 0;
		scene.state |= ladder_sim_is_missing(view->canvas->sim, view->canvas->document,
			view->canvas->pou, view->first + rung) ? RUNG_MISSING : 0;
	}
	marks_push(view, rung, marks);
	live_marks(view, rung, marks);
	drop_mark(view, rung, marks);
	scene.takes = takes;
	if (ladder_document_is_bookmarked(view->canvas->document, view->canvas->pou,
					     view->first + rung))
		scene.state |= RUNG_MARKED;
	if (view->preview && rung == view->cursor.at.rung)
		scene.state |= RUNG_EDITED;
	scene.mark = (const struct grid_mark *)(void *)marks->data;
	scene.mark_count = (int)marks->len;
	strip->node = grid_draw_node(&scene);
	g_array_unref(marks);
	g_free(unknown);
	g_free(takes);
}

static void append_strip(GtkSnapshot *snapshot, const struct strip *strip, float x, float y,
			 float zoom)
{
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(x, y));
	gtk_snapshot_scale(snapshot, zoom, zoom);
	gtk_snapshot_append_node(snapshot, strip->node);
	gtk_snapshot_restore(snapshot);
}

/* Between the last element that is shown wholly and the pinned outputs: the wires to them, as wide as
 * the room, and dots for what is hidden. @to: px of the widget, where the outputs begin. */
static void snapshot_hidden(LadderGridView *view, GtkSnapshot *snapshot,
			    const struct strip *strip, float x, float y, float to)
{
	const struct theme *theme = canvas_theme(LADDER_CANVAS(view));
	const struct rung_layout *layout = strip->layout;
	const float zoom = (float)view->canvas->zoom, top = y + layout->top * zoom;
	const float from = strips_pin_edge(view, strip) * zoom - x;
	const float slice = layout->column_x[layout->columns - 1] - HIDDEN_SLICE;
	const float size = HIDDEN_DOT * zoom, middle = (from + to) / 2;

	if (to - from < 1)
		return;
	gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(from, top, to - from,
							     y + strip->height * zoom - top));
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET],
		&GRAPHENE_RECT_INIT(from, top, to - from, y + strip->height * zoom - top));
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(from, y));
	gtk_snapshot_scale(snapshot, to - from, zoom);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(-slice, 0));
	gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(slice, 0, 1, strip->height));
	gtk_snapshot_append_node(snapshot, strip->node);
	gtk_snapshot_pop(snapshot);
	gtk_snapshot_restore(snapshot);
	for (int dot = -1; dot <= 1; dot++)
		gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_COMMENT],
			&GRAPHENE_RECT_INIT(middle + 2 * (float)dot * size - size / 2,
					    y + (layout->row[0].wire - HIDDEN_ABOVE) * zoom,
					    size, size));
	gtk_snapshot_pop(snapshot);
}

/* The outputs once more at the edge of a narrow page, behind a line. @x, @y: scroll position and
 * top of the strip, px of the widget. */
static void snapshot_pinned(LadderGridView *view, GtkSnapshot *snapshot,
			    const struct strip *strip, float x, float y)
{
	const struct theme *theme = canvas_theme(LADDER_CANVAS(view));
	const float zoom = (float)view->canvas->zoom, by = strips_pinned(view, strip);
	const float page = (float)gtk_widget_get_width(GTK_WIDGET(view));
	float left;

	if (by <= 0)
		return;
	left = strip->layout->column_x[strip->layout->columns - 1] * zoom - x - by;
	snapshot_hidden(view, snapshot, strip, x, y, left);
	gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(left, y, page - left,
							     strip->height * zoom));
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET],
		&GRAPHENE_RECT_INIT(left, y, page - left, strip->height * zoom));
	append_strip(snapshot, strip, -x - by, y, zoom);
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_GUTTER],
		&GRAPHENE_RECT_INIT(left, y, 2, strip->height * zoom));
	gtk_snapshot_pop(snapshot);
}

static void snapshot_rungs(LadderGridView *view, GtkSnapshot *snapshot)
{
	const float zoom = (float)view->canvas->zoom;
	const float x = (float)gtk_adjustment_get_value(view->canvas->adjustment[0]);
	const float top = (float)gtk_adjustment_get_value(view->canvas->adjustment[1]);
	const float end = top + (float)gtk_widget_get_height(GTK_WIDGET(view));

	for (int i = strips_at(view, top / zoom);
	     i >= 0 && i < (int)view->strips->len; i++) {
		struct strip *strip = strip_of(view, i);

		if (strip->y * zoom > end)
			break;
		if (strip->layout && live_look(view, i))
			g_clear_pointer(&strip->node, gsk_render_node_unref);
		if (!strip->layout)
			strips_resize_later(view); /* the allocation lays it out */
		else if (!strip->node)
			draw_strip(view, i, strip);
		if (!strip->node)
			continue;
		append_strip(snapshot, strip, -x, strip->y * zoom - top, zoom);
		snapshot_pinned(view, snapshot, strip, x, strip->y * zoom - top);
	}
}

/* Draws the rungs that come into view next, one at a time, while the program is
 * idle. Not while something runs: their values would change before they are seen. */
static gboolean draw_ahead(gpointer data)
{
	LadderGridView *view = data;
	const graphene_rect_t seen = canvas_page(LADDER_CANVAS(view));
	const double top = (double)seen.origin.y, page = (double)seen.size.height;
	int i = strips_at(view, (float)(top - AHEAD * page));

	for (; !canvas_is_live(LADDER_CANVAS(view)) && i >= 0 && i < (int)view->strips->len; i++) {
		if ((double)strip_of(view, i)->y > top + (1 + AHEAD) * page)
			break;
		if (strip_of(view, i)->node || !sheet_rung(view, i))
			continue;
		draw_strip(view, i, strips_get(view, i));
		return G_SOURCE_CONTINUE;
	}
	view->ahead = 0;
	return G_SOURCE_REMOVE;
}

static void draw_ahead_later(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	if (!view->ahead)
		view->ahead = g_idle_add_full(G_PRIORITY_LOW, draw_ahead, view, NULL);
}

/* An empty sheet says what to do. */
static bool is_blank(LadderGridView *view)
{
	const struct rung *rung = sheet_rungs(view) == 1 ? sheet_rung(view, 0) : NULL;

	for (int i = 0; rung && i < rung->rows * rung->cols; i++)
		if (rung->cell[i].word != ELEM_EMPTY)
			return false;
	return rung != NULL;
}

static void paint(LadderCanvas *canvas, GtkSnapshot *snapshot, const struct theme *theme)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const double zoom = view->canvas->zoom;
	const double left = gtk_adjustment_get_value(view->canvas->adjustment[0]);

	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_GUTTER],
		&GRAPHENE_RECT_INIT((float)-left, 0, (float)(RUNG_GUTTER * zoom),
				    (float)gtk_widget_get_height(GTK_WIDGET(view))));
	snapshot_rungs(view, snapshot);
	wire_snapshot(view, snapshot, theme);
	drop_snapshot(view, snapshot, theme);
	if (is_blank(view))
		canvas_snapshot_hint(canvas, snapshot, theme,
			_("Type a name, such as Start, and press Enter: a contact.\n"
			  "Type OUT Motor: a coil. Type TON: a timer. All dialects are understood.\n"
			  "Or drag an element from the left, and wires from the ends of elements.\n"
			  "F5 contact, F6 negated, F7 coil, Shift+F5 in parallel, "
			  "Ins new rung."),
			GRAPHENE_POINT_INIT((float)(RUNG_LEFT * zoom),
					    (float)((strips_height(view) + 24) * zoom)));
}

static void restyle(LadderCanvas *canvas)
{
	strips_redraw(LADDER_GRID_VIEW(canvas), -1);
}

static graphene_rect_t box_at_cursor(LadderCanvas *canvas)
{
	return cursor_cell_box(LADDER_GRID_VIEW(canvas));
}

static void reveal(LadderCanvas *canvas)
{
	cursor_reveal_head(LADDER_GRID_VIEW(canvas));
}

/* ---- the document. Rungs and cursor are updated first: closing the popup moves the focus,
 * and the window then reads the place of the cursor. ---- */

static void forget_edit(LadderGridView *view)
{
	wire_forget(view);
	ladder_grid_view_set_blockers(view, -1, NULL, 0);
	canvas_close_entry(LADDER_CANVAS(view));
	canvas_moved(LADDER_CANVAS(view));
}

static void rungs_changed(LadderCanvas *canvas, int pou, int at, int removed, int inserted)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	if (pou != view->canvas->pou)
		return;
	at -= view->first;
	if (view->count >= 0 && (at < 0 || at + removed > view->count)) {
		if (at < 0 && inserted != removed) { /* in a body above */
			view->first += inserted - removed;
			strips_renumber(view);
		}
		return;
	}
	if (view->count >= 0)
		view->count += inserted - removed;
	g_clear_pointer(&view->preview, rung_free);
	strips_splice(view, at, removed, inserted);
	cursor_fit(view);
	if (removed != inserted) {
		view->cursor.came_rung = -1;
		canvas_say_again(canvas);
	}
	forget_edit(view);
}

static void variable_changed(LadderCanvas *canvas, int pou, const char *name,
			     const char *address)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	if (pou >= 0 && pou != view->canvas->pou)
		return;
	strips_renamed(view, name, address);
	canvas_cells_later(canvas);
}

static void project_changed(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	g_clear_pointer(&view->preview, rung_free);
	live_forget_all(view);
	strips_reset(view);
	cursor_fit(view);
	forget_edit(view);
}

static void add_mark(LadderGridView *view, const struct diag *diag)
{
	struct sheet_mark mark = {
		diag->rung - 1 - view->first, diag->row - 1, diag->col - 1, grid_mark_of(diag), diag,
	};

	g_array_append_val(view->marks, mark);
}

static void checked(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const struct diag_list *diags = ladder_document_diags(view->canvas->document);
	const struct pou *pou = sheet_pou(view);
	const struct project *project = ladder_document_project(view->canvas->document);

	g_array_set_size(view->marks, 0);
	for (int i = 0; pou && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag->rung > view->first &&
		    diag->rung <= view->first + sheet_rungs(view) && diag->pou &&
		    strcmp(diag->pou, project_text(project, pou->name)) == 0)
			add_mark(view, diag);
	}
	strips_redraw(view, -1);
}

/* ---- the simulation ---- */

/* Variables may be at other places. */
static void program_gone(LadderCanvas *canvas)
{
	live_forget_all(LADDER_GRID_VIEW(canvas));
}

static void program_changed(LadderCanvas *canvas)
{
	act_forget(LADDER_GRID_VIEW(canvas));
	live_program_changed(LADDER_GRID_VIEW(canvas));
}

static void state_changed(LadderCanvas *canvas)
{
	if (!canvas_is_live(canvas))
		act_forget(LADDER_GRID_VIEW(canvas));
	live_state_changed(LADDER_GRID_VIEW(canvas));
}

/* ---- accessible children: one for each element ---- */

static bool is_named(const struct cell *cell)
{
	return cell->word != ELEM_EMPTY && cell->word != ELEM_WIRE &&
	       cell->word != ELEM_PIN;
}

static void list_rung(LadderGridView *view, int number)
{
	const struct rung *rung = sheet_rung(view, number);
	int row = -1, col = -1;
	const bool current = number == view->cursor.at.rung && cursor_cell(view, &row, &col);

	for (int r = 0; r < rung->rows; r++)
		for (int c = 0; c < rung->cols; c++)
			if (is_named(rung_at(rung, r, c)))
				canvas_add_cell(LADDER_CANVAS(view),
						(struct canvas_spot){ number, r, c },
						current && r == row && c == col);
}

static void list_cells(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const double zoom = view->canvas->zoom;
	const double top = gtk_adjustment_get_value(view->canvas->adjustment[1]) / zoom;
	const double end = top + gtk_widget_get_height(GTK_WIDGET(view)) / zoom;
	char *blank = NULL;

	if (!view->names)
		return;
	for (int i = strips_at(view, (float)top); i >= 0 && i < (int)view->strips->len; i++) {
		if (strips_get(view, i)->y > end)
			break;
		list_rung(view, i);
	}
	if (sheet_rungs(view) > 0 && !cursor_cell(view, NULL, NULL))
		blank = tell_cursor(view, false);
	canvas_set_blank(canvas, blank);
	g_free(blank);
}

/* NULL: the children are older than the rungs, and the cell is gone. */
static const struct cell *cell_at(LadderGridView *view, struct canvas_spot spot)
{
	const struct rung *rung = sheet_rung(view, spot.number);

	return view->names && rung && spot.number < (int)view->strips->len &&
	       spot.row < rung->rows && spot.col < rung->cols ?
	       rung_at(rung, spot.row, spot.col) : NULL;
}

static char *cell_name(LadderCanvas *canvas, struct canvas_spot spot)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const struct cell *cell = cell_at(view, spot);

	return cell && is_named(cell) ?
	       tell_cell(view, spot.number, spot.row, spot.col, cell) : NULL;
}

static bool cell_box(LadderCanvas *canvas, struct canvas_spot spot, graphene_rect_t *box)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const struct strip *strip;

	if (!cell_at(view, spot))
		return false;
	strip = strips_get(view, spot.number);
	*box = strip_box(view, strip, spot.row,
			 rung_layout_column(strip->layout, spot.row, spot.col));
	return true;
}

static void go_to_cell(LadderCanvas *canvas, struct canvas_spot spot)
{
	ladder_grid_view_go(LADDER_GRID_VIEW(canvas), spot.number, spot.row, spot.col);
}

static char *cursor_name(LadderCanvas *canvas, bool values)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	return view->names ? tell_cursor(view, values) : NULL;
}

/* ---- giving up ---- */

static void give_back(LadderGridView *view)
{
	if (view->cursor.came_rung != view->cursor.at.rung)
		return;
	if (ladder_document_give_back(view->canvas->document, view->canvas->pou,
				      view->first + view->cursor.at.rung, view->cursor.came,
				      _(verb_row(VERB_cancel)->label)) == BACK_OTHER)
		canvas_tell(LADDER_CANVAS(view), _("Other things were changed since. Undo "
						   "takes them back one by one."));
}

bool ladder_grid_view_has_begun(LadderGridView *view)
{
	return view->wire.drawing || view->canvas->entry || view->preview ||
	       view->cursor.selecting;
}

/* Esc cancels a wire, the entry or the selection, else the edits since the cursor came. */
static void do_cancel(LadderGridView *view)
{
	view->press.given_up = true;
	canvas_end_drag(LADDER_CANVAS(view));
	if (view->wire.drawing)
		wire_forget(view);
	else if (view->canvas->entry || view->preview)
		canvas_close_entry(LADDER_CANVAS(view));
	else if (view->cursor.selecting)
		cursor_set(view, view->cursor.at, false);
	else
		give_back(view);
}

/* ---- verbs ---- */

/* On an empty cell the key begins an entry: `/Stop`. */
static void do_negate(LadderGridView *view)
{
	struct project *project = ladder_document_project(view->canvas->document);
	const struct rung *rung = sheet_rung(view, view->cursor.at.rung);
	struct grid_at at = sheet_at(view);

	if (rung && !cursor_cell(view, NULL, NULL))
		entry_begin(view, "/");
	else if (rung)
		sheet_put(view, grid_negate(rung, &at, project, sheet_pou(view)), &at,
			  _(verb_row(VERB_negate)->label));
}

bool ladder_grid_view_rename_box(LadderGridView *view)
{
	const struct cell *cell = cursor_cell(view, NULL, NULL);

	if (!cell || cell->word != ELEM_EXECUTE || canvas_is_fixed(LADDER_CANVAS(view)))
		return false;
	entry_begin_edit(view);
	return true;
}

static bool changes(enum verb verb)
{
	return verb != VERB_copy && verb != VERB_copy_picture && verb != VERB_select_all &&
	       verb != VERB_cancel;
}

/* Enter at an EXECUTE box: somebody shows its statements. */
static bool wants_statements(LadderGridView *view, enum verb verb)
{
	int row, col;
	const struct cell *cell = verb == VERB_enter && sheet_pou(view) && sheet_rungs(view) > 0 ?
				  cursor_cell(view, &row, &col) : NULL;

	if (!cell || cell->word != ELEM_EXECUTE ||
	    !g_signal_has_handler_pending(view, statements_wanted, 0, TRUE))
		return false;
	g_signal_emit(view, statements_wanted, 0, view->first + view->cursor.at.rung, row, col);
	return true;
}

static void do_verb(LadderCanvas *canvas, enum verb verb)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	if (wants_statements(view, verb))
		return;
	if (act_do(view, verb) || (changes(verb) && canvas_is_fixed(canvas)) ||
	    edit_do(view, verb))
		return;
	switch ((int)verb) {
	case VERB_context_menu: canvas_show_menu(canvas); break;
	case VERB_enter: case VERB_edit_operand: entry_begin_edit(view); break;
	case VERB_contact: entry_begin_word(view, ELEM_CONTACT_NO, false); break;
	case VERB_contact_not: entry_begin_word(view, ELEM_CONTACT_NC, false); break;
	case VERB_coil: entry_begin_word(view, ELEM_COIL, false); break;
	case VERB_block: entry_begin_box(view); break;
	case VERB_parallel: entry_begin_word(view, ELEM_CONTACT_NO, true); break;
	case VERB_parallel_not: entry_begin_word(view, ELEM_CONTACT_NC, true); break;
	case VERB_negate: do_negate(view); break;
	case VERB_add_pin: case VERB_comment: case VERB_rung_title:
	case VERB_rung_label: case VERB_rung_comment:
		entry_begin_text(view, verb);
		break;
	case VERB_bookmark:
		ladder_document_toggle_bookmark(view->canvas->document, view->canvas->pou,
						view->first + view->cursor.at.rung);
		break;
	case VERB_cancel: do_cancel(view); break;
	default: break;
	}
}

/* ---- keys ---- */

static void type(LadderCanvas *canvas, const char *text)
{
	entry_begin(LADDER_GRID_VIEW(canvas), text);
}

/* ---- the pointer ---- */

/* A double click: at a pin of a box it edits the value there; else it acts as Enter. */
static void begin_there(LadderGridView *view, const struct rung_hit *hit)
{
	if (hit->part == RUNG_PART_PIN && !canvas_is_live(LADDER_CANVAS(view)))
		entry_begin_pin(view, hit->name, hit->name_len, hit->output);
	else
		do_verb(LADDER_CANVAS(view), VERB_enter);
}

/* Moves the cursor there; the selection ends. */
static void press_on(LadderGridView *view, int rung, const struct rung_hit *hit, int count,
		  GdkModifierType state)
{
	/* Found before the sheet scrolls to the cursor. */
	int here;
	const graphene_point_t at = sheet_where(view, view->press.x, view->press.y, &here);

	view->cursor.moved = true;
	if (hit_is_cell(hit)) {
		cursor_set(view, (struct grid_cursor){ rung, hit->row, hit->column },
			   state & GDK_SHIFT_MASK);
		view->press.takes = !(state & GDK_SHIFT_MASK) &&
			      !wire_press(view, view->press.x, view->press.y) &&
			      cursor_cell(view, NULL, NULL);
		view->press.toggles = view->press.takes &&
			act_is_click(view, at.x, at.y);
		if (count == 2 && !view->press.toggles)
			begin_there(view, hit);
		return;
	}
	cursor_set(view, (struct grid_cursor){ rung, 0, 0 }, state & GDK_SHIFT_MASK);
	if (hit->part == RUNG_PART_NUMBER && !(state & GDK_SHIFT_MASK))
		do_verb(LADDER_CANVAS(view), VERB_select_all);
	else if (hit->part == RUNG_PART_TITLE && count == 2)
		do_verb(LADDER_CANVAS(view), VERB_rung_title);
}

/* A press on the selection keeps it until the release: it may be dragged, or get a menu. */
static bool is_kept(LadderGridView *view, int rung, const struct rung_hit *hit, int count,
		    GdkModifierType state)
{
	int first, last;

	if (count > 1 || state & GDK_SHIFT_MASK)
		return false;
	if (hit->part == RUNG_PART_NUMBER || hit->part == RUNG_PART_TITLE)
		return cursor_rungs(view, &first, &last) &&
		       cursor_selects(view, rung, 0, 0);
	return hit_is_cell(hit) && cursor_selects(view, rung, hit->row, hit->column);
}

static void press(LadderCanvas *canvas, double x, double y, int count, GdkModifierType state)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	struct rung_hit hit;
	const int rung = sheet_point(view, x, y, &hit);

	view->press = (struct sheet_press){ .x = x, .y = y };
	wire_forget(view);
	if (rung < 0)
		return;
	view->press.keeps = view->press.takes = is_kept(view, rung, &hit, count, state);
	if (!view->press.keeps)
		press_on(view, rung, &hit, count, state);
}

/* Acts at the release of the button, since a press may begin a drag. */
static void release(LadderCanvas *canvas, double x, double y, int count, bool moved)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	struct rung_hit hit;
	int rung;

	(void)x;
	(void)y;
	if (view->press.keeps && !moved) {
		rung = sheet_point(view, view->press.x, view->press.y, &hit);
		if (rung >= 0)
			press_on(view, rung, &hit, count, 0);
		wire_forget(view);
	}
	if (view->press.toggles && !moved)
		act_click(view);
	view->press.toggles = view->press.keeps = false;
}

static bool can_drag(LadderCanvas *canvas)
{
	const struct sheet_press *press = &LADDER_GRID_VIEW(canvas)->press;

	return !press->takes && !press->given_up;
}

/* Extends the wire or the selection to the pointer; false: neither. */
static bool drag(LadderCanvas *canvas, double x, double y, GdkModifierType state)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	struct rung_hit hit;
	int rung;

	if (view->wire.pressed) {
		wire_drag(view, x, y, state);
		return true;
	}
	rung = sheet_point(view, x, y, &hit);
	if (rung < 0 || !hit_is_cell(&hit))
		return false;
	cursor_set(view, (struct grid_cursor){ rung, hit.row, hit.column }, true);
	return true;
}

static void drag_end(LadderCanvas *canvas, bool cancelled)
{
	if (cancelled)
		wire_forget(LADDER_GRID_VIEW(canvas));
	else
		wire_release(LADDER_GRID_VIEW(canvas));
}

static const enum verb of_element[] = { VERB_enter, VERB_edit_operand, VERB_negate, VERB_cycle, VERB_comment,
	VERB_add_pin, VERB_COUNT };
static const enum verb of_symbol[] = { VERB_show_uses, VERB_go_coil, VERB_rename, VERB_watch_add,
	VERB_expect, VERB_COUNT };
static const enum verb of_clipboard[] = { VERB_cut, VERB_copy, VERB_paste, VERB_delete,
	VERB_COUNT };
static const struct {
	const char *name;
	enum verb verb[14];
} submenus[] = {
	{ N_("Put here"), { VERB_contact, VERB_contact_not, VERB_coil, VERB_block,
		VERB_parallel, VERB_parallel_not, VERB_paste_parallel, VERB_COUNT } },
	{ N_("Wires"), { VERB_wire_left, VERB_wire_right, VERB_wire_up, VERB_wire_down,
		VERB_wire_here, VERB_link_here, VERB_COUNT } },
	{ N_("Rows and columns"), { VERB_insert_row, VERB_delete_row,
		VERB_insert_column, VERB_delete_column, VERB_COUNT } },
	{ N_("Rung"), { VERB_rung_below, VERB_rung_above, VERB_rung_duplicate,
		VERB_rung_up, VERB_rung_down, VERB_rung_title, VERB_rung_label,
		VERB_rung_comment, VERB_rung_off, VERB_bookmark, VERB_copy_picture,
		VERB_rung_delete, VERB_COUNT } },
};

/* Does the verb do something at the cursor? While simulating, the keys of VERB_enter and
 * VERB_cycle set a value. */
static bool applies(LadderCanvas *canvas, enum verb verb)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct cell *cell = cursor_cell(view, NULL, NULL);
	const struct word_row *row = cell ? words_row(&project->words, (enum word)cell->word) : NULL;
	const bool live = canvas_is_live(canvas);

	switch ((int)verb) {
	case VERB_enter: return cell && !live;
	case VERB_edit_operand: return cell && live;
	case VERB_comment: return cell;
	case VERB_negate: return cell && (cell->word == ELEM_COMPARE ||
			grid_word_negated((enum word)cell->word) != (enum word)cell->word);
	case VERB_cycle: return cell && !live && (row->operand == OPND_BOOL_R ||
						  row->operand == OPND_BOOL_W);
	case VERB_add_pin: return cell && (row->kind == WORD_FB || row->kind == WORD_FN ||
					   cell->word == ELEM_PIN);
	case VERB_show_uses: case VERB_go_coil: case VERB_watch_add:
		return cell && (cell->operand || cell->args);
	case VERB_rename: return cell && (cell->operand || cell->word == ELEM_EXECUTE) && !live;
	case VERB_expect: return live;
	default: return true;
	}
}

static void append_edit(LadderCanvas *canvas, GMenu *menu)
{
	GMenu *parts = g_menu_new();

	canvas_append_section(canvas, menu, of_element, applies);
	for (gsize i = 0; i < G_N_ELEMENTS(submenus); i++)
		canvas_append_submenu(canvas, parts, submenus[i].name, submenus[i].verb, applies);
	if (!canvas_is_live(canvas))
		canvas_append_submenu(canvas, parts, N_("Symbol"), of_symbol, applies);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(parts));
	g_object_unref(parts);
	canvas_append_section(canvas, menu, of_clipboard, applies);
}

/* While simulating: the values first, and what changes the program in a submenu. */
static GMenu *make_menu(LadderCanvas *canvas)
{
	GMenu *menu = g_menu_new(), *edit;
	GMenuModel *live = act_menu(LADDER_GRID_VIEW(canvas));

	g_menu_append_section(menu, NULL, live);
	g_object_unref(live);
	if (!canvas_is_live(canvas)) {
		append_edit(canvas, menu);
		return menu;
	}
	edit = g_menu_new();
	canvas_append_section(canvas, menu, of_symbol, applies);
	append_edit(canvas, edit);
	g_menu_append_submenu(menu, _("Edit"), G_MENU_MODEL(edit));
	g_object_unref(edit);
	return menu;
}

/* ---- from outside ---- */

void ladder_grid_view_set_range(LadderGridView *view, int first, int count)
{
	view->first = first;
	view->count = count;
	project_changed(LADDER_CANVAS(view));
	checked(LADDER_CANVAS(view));
}

int ladder_grid_view_range(LadderGridView *view, int *count)
{
	*count = view->count;
	return view->first;
}

int ladder_grid_view_first(LadderGridView *view)
{
	return view->first;
}

struct grid_cursor ladder_grid_view_cursor(LadderGridView *view)
{
	return view->cursor.at;
}

void ladder_grid_view_go(LadderGridView *view, int rung, int row, int col)
{
	struct grid_cursor to = { MAX(rung, 0), MAX(row, 0), MAX(col, 0) };
	const struct rung *shown;

	canvas_close_entry(LADDER_CANVAS(view));
	shown = sheet_rung(view, to.rung);
	if (shown && col >= 0 && to.row < shown->rows && to.col < shown->cols)
		to.col = grid_display_column(shown, view->columns, to.row, to.col);
	cursor_set(view, to, false);
	cursor_reveal_head(view);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

void ladder_grid_view_move(LadderGridView *view, struct grid_cursor to)
{
	cursor_set(view, to, false);
}

bool ladder_grid_view_cell(LadderGridView *view, int *row, int *col)
{
	return cursor_cell(view, row, col) != NULL;
}

enum drafting_show ladder_grid_view_show(LadderGridView *view)
{
	return view->drafting.show;
}

static void redraw_found(LadderGridView *view)
{
	int before = -1;

	for (guint i = 0; i < view->found->len; i++) {
		const int rung = g_array_index(view->found, struct found_cell, i).rung;

		if (rung != before)
			strips_redraw(view, rung);
		before = rung;
	}
}

void ladder_grid_view_set_found(LadderGridView *view, const struct find_seen *seen)
{
	const struct find_hit *hit;
	struct found_cell cell = { 0 };
	int at = 0;

	redraw_found(view);
	g_array_set_size(view->found, 0);
	while ((hit = find_seen_next(seen, view->canvas->pou, &at, &cell.now)) != NULL) {
		cell.rung = hit->rung - view->first;
		cell.row = hit->row;
		cell.col = hit->col;
		if (hit->rung >= view->first && sheet_rung(view, cell.rung))
			g_array_append_val(view->found, cell);
	}
	redraw_found(view);
}

void ladder_grid_view_put(LadderGridView *view, enum word word)
{
	gtk_widget_grab_focus(GTK_WIDGET(view)); /* before the entry takes it            */
	entry_begin_word(view, word, false);
}

/* ---- life ---- */

static void ladder_grid_view_dispose(GObject *object)
{
	LadderGridView *view = LADDER_GRID_VIEW(object);

	canvas_close_entry(LADDER_CANVAS(view));
	live_clear(view);
	g_clear_handle_id(&view->ahead, g_source_remove);
	strips_clear(view);
	G_OBJECT_CLASS(ladder_grid_view_parent_class)->dispose(object);
}

static void ladder_grid_view_finalize(GObject *object)
{
	LadderGridView *view = LADDER_GRID_VIEW(object);

	g_free(view->wire.legal);
	rung_free(view->preview);
	g_array_unref(view->strips);
	g_array_unref(view->marks);
	g_array_unref(view->found);
	g_array_unref(view->live.blockers);
	G_OBJECT_CLASS(ladder_grid_view_parent_class)->finalize(object);
}

static void ladder_grid_view_class_init(LadderGridViewClass *class)
{
	LadderCanvasClass *canvas = LADDER_CANVAS_CLASS(class);

	statements_wanted = g_signal_new("statements-wanted", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0,
					 NULL, NULL, NULL, G_TYPE_NONE, 3, G_TYPE_INT, G_TYPE_INT, G_TYPE_INT);

	G_OBJECT_CLASS(class)->dispose = ladder_grid_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_grid_view_finalize;
	canvas->least_zoom = 0.5;
	canvas->keys = VERB_SHEET;
	canvas->name = N_("Sheet");
	canvas->size = size;
	canvas->lay_out = strips_lay_out;
	canvas->hold = hold;
	canvas->held = held;
	canvas->scrolled = draw_ahead_later;
	canvas->paint = paint;
	canvas->restyle = restyle;
	canvas->cursor_box = box_at_cursor;
	canvas->reveal = reveal;
	canvas->cursor_name = cursor_name;
	canvas->place = tell_place;
	canvas->next_keys = tell_keys;
	canvas->do_verb = do_verb;
	canvas->key = cursor_key;
	canvas->type = type;
	canvas->closed = entry_closed;
	canvas->press = press;
	canvas->release = release;
	canvas->can_drag = can_drag;
	canvas->drag = drag;
	canvas->drag_end = drag_end;
	canvas->menu = make_menu;
	canvas->tip = tell_tip;
	canvas->list_cells = list_cells;
	canvas->cell_name = cell_name;
	canvas->cell_box = cell_box;
	canvas->go_to_cell = go_to_cell;
	canvas->project_changed = project_changed;
	canvas->rungs_changed = rungs_changed;
	canvas->variable_changed = variable_changed;
	canvas->bookmarks_changed = restyle;
	canvas->checked = checked;
	canvas->values_changed = live_values_changed;
	canvas->program_gone = program_gone;
	canvas->program_changed = program_changed;
	canvas->state_changed = state_changed;
}

/* ---- folding ---- */

bool ladder_grid_view_folds(LadderGridView *view)
{
	return view->drafting.folds;
}

void ladder_grid_view_set_folds(LadderGridView *view, bool folds)
{
	if (folds == view->drafting.folds)
		return;
	view->drafting.folds = folds;
	wire_forget(view);
	strips_reset(view);
	cursor_reveal_head(view);
}

static void folds_chosen(LadderGridView *view)
{
	ladder_grid_view_set_folds(view, settings_flag("fold-rungs", FALSE));
}

static void ladder_grid_view_init(LadderGridView *view)
{
	view->canvas = canvas_state(LADDER_CANVAS(view));
	view->marks = g_array_new(FALSE, TRUE, sizeof(struct sheet_mark));
	view->count = -1;
	view->found = g_array_new(FALSE, TRUE, sizeof(struct found_cell));
	view->drop.at.rung = view->cursor.came_rung = view->drop.line = -1;
	strips_init(view);
	live_init(view);
	act_init(view);
	drag_init(view);
	wire_init(view);
	if (settings_get())
		g_signal_connect_object(settings_get(), "changed::fold-rungs", G_CALLBACK(folds_chosen), view,
					G_CONNECT_SWAPPED);
}

GtkWidget *ladder_grid_view_new(LadderDocument *document, int pou)
{
	LadderGridView *view = g_object_new(LADDER_TYPE_GRID_VIEW, NULL);

	view->drafting.lettering = view->canvas->lettering;
	canvas_show(LADDER_CANVAS(view), document, pou);
	return GTK_WIDGET(view);
}
