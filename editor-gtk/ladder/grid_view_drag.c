/* SPDX-License-Identifier: MIT
 *
 * grid_view_drag - elements and rungs are dragged about: what is taken, where it may be
 * dropped, and what that does.
 *
 * What is selected goes as a whole, if it is taken by a part of it.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/draw/ghost.h"

/* ---- what is dragged ---- */

#define LADDER_TYPE_DRAG (ladder_drag_get_type())

/* An element of the palette, or of a sheet one, several, or whole rungs. */
struct ladder_drag {
	enum word word;            /* of several: one that goes where they do  */
	LadderGridView *view;      /* it comes from; NULL: the palette         */
	struct grid_cursor from;   /* of rungs: row -1                         */
	int last;                  /* of rungs: the last one                   */
	bool several;              /* elements: those in the area              */
	struct grid_area area;
};

static struct ladder_drag *ladder_drag_copy(struct ladder_drag *drag)
{
	struct ladder_drag *copy = g_memdup2(drag, sizeof(*drag));

	if (copy->view)
		g_object_ref(copy->view);
	return copy;
}

static void ladder_drag_free(struct ladder_drag *drag)
{
	g_clear_object(&drag->view);
	g_free(drag);
}

static GType ladder_drag_get_type(void)
{
	static GType type;

	if (g_once_init_enter(&type))
		g_once_init_leave(&type, g_boxed_type_register_static("LadderDrag",
			(GBoxedCopyFunc)ladder_drag_copy,
			(GBoxedFreeFunc)ladder_drag_free));
	return type;
}

GdkContentProvider *ladder_grid_view_drag(enum word word)
{
	struct ladder_drag drag = { .word = word };

	return gdk_content_provider_new_typed(LADDER_TYPE_DRAG, &drag);
}

/* ---- dragging an element or a rung ---- */

/* A chart takes an element as its variables. @element: taken over. */
static GdkContentProvider *with_names(LadderGridView *view, const struct cell *cell,
				      GdkContentProvider *element)
{
	char *names = sheet_variables(view, cell);
	GdkContentProvider *both[] = { element, NULL };

	if (*names)
		both[1] = gdk_content_provider_new_typed(G_TYPE_STRING, names);
	g_free(names);
	return both[1] ? gdk_content_provider_new_union(both, 2) : element;
}

static GdkContentProvider *provide(const struct ladder_drag *drag)
{
	return gdk_content_provider_new_typed(LADDER_TYPE_DRAG, drag);
}

/* All that is selected; NULL: nothing stands there. */
static GdkContentProvider *drag_area(LadderGridView *view, struct ladder_drag *drag)
{
	const struct rung *rung = sheet_rung(view, drag->from.rung);
	struct rung *part = grid_copy(rung, view->columns, &drag->area);

	if (!part)
		return NULL;
	drag->several = true;
	drag->word = grid_is_outputs(part) ? ELEM_COIL : ELEM_CONTACT_NO;
	drag->from.row = drag->area.row;
	drag->from.col = drag->area.col;
	rung_free(part);
	return provide(drag);
}

static GdkContentProvider *drag_prepare(GtkDragSource *source, double x, double y,
					LadderGridView *view)
{
	struct ladder_drag drag = { .view = view };
	struct rung_hit hit;
	const int rung = sheet_point(view, x, y, &hit);
	const struct cell *cell;
	bool rungs;

	(void)source;
	if (rung < 0 || view->entry)
		return NULL;
	drag.from = (struct grid_cursor){ rung, -1, -1 };
	rungs = cursor_rungs(view, &drag.from.rung, &drag.last);
	if (rungs && view->keeps)
		return provide(&drag);
	if (rung != view->cursor.rung)
		return NULL;
	if (hit.part == RUNG_PART_NUMBER)
		return provide(&drag);
	if (view->keeps && cursor_area(view, &drag.area))
		return drag_area(view, &drag);
	cell = cursor_cell(view, NULL, NULL);
	if (!mouse_is_cell(&hit) || !cell || !view->takes)
		return NULL;
	drag.word = (enum word)cell->word;
	drag.from = view->cursor;
	return with_names(view, cell, provide(&drag));
}

static void drag_begin(GtkDragSource *source, GdkDrag *begun, LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->document);
	const struct ladder_drag *drag;
	GValue value = G_VALUE_INIT;

	g_value_init(&value, LADDER_TYPE_DRAG);
	if (!gdk_content_provider_get_value(gdk_drag_get_content(begun), &value, NULL))
		goto unset;
	drag = g_value_get_boxed(&value);
	if (drag->from.row < 0)
		drop_rung_ghost(view, source, drag->from.rung);
	else if (project)
		ghost_element(source, words_row(&project->words, drag->word),
			      strips_theme(view), view->lettering);
unset:
	g_value_unset(&value);
}

/* ---- dropping ---- */

#define DROP_BELOW 18 /* px under the wire, from where on it is meant          */

static const struct ladder_drag *dragged(GtkDropTarget *target)
{
	const GValue *value = gtk_drop_target_get_value(target);

	return value && G_VALUE_HOLDS(value, LADDER_TYPE_DRAG) ?
	       g_value_get_boxed(value) : NULL;
}

/* The lower part of an element's cell means: below it. */
static bool is_below(LadderGridView *view, int rung, const struct rung_hit *hit, double y)
{
	const struct strip *strip = strips_get(view, rung);
	const struct rung_row *row = &strip->layout->row[hit->row];
	const double at = (y + gtk_adjustment_get_value(view->adjustment[1])) / view->zoom;

	return at > strip->y + row->wire + DROP_BELOW;
}

/* Which cell is meant: below an element the free one that would be a branch; below the last
 * row there is room for another. */
static int drop_at(LadderGridView *view, double x, double y, struct rung_hit *hit,
		   enum word word)
{
	const double shift = RUNG_CELL_HEIGHT * view->zoom;
	int rung = sheet_point(view, x, y, hit);
	const bool inside = rung >= 0 && mouse_is_cell(hit);
	enum grid_drop how;

	if (inside && !is_below(view, rung, hit, y))
		return rung;
	if (!inside) {
		const int above = sheet_point(view, x, y - shift, hit);

		if (above < 0 || !mouse_is_cell(hit) || (rung >= 0 && rung != above))
			return -1;
		rung = above;
	}
	how = grid_can_drop(sheet_rung(view, rung), view->columns, hit->row + 1,
			    hit->column, word);
	if (how == GRID_DROP_BELOW || (!inside && how != GRID_DROP_NOT))
		hit->row++;
	return rung;
}

static bool is_rung(const struct ladder_drag *drag)
{
	return drag && drag->view && drag->from.row < 0;
}

/* Rungs change places within a program. */
static bool takes_rung(LadderGridView *view, const struct ladder_drag *drag)
{
	return drag->view == view && view->count < 0;
}

/* Marks where it would be dropped; 0: it may not. */
static GdkDragAction show_drop(LadderGridView *view, double x, double y)
{
	const struct ladder_drag *drag = dragged(view->target);
	const enum word word = drag ? drag->word : ELEM_EMPTY;
	struct rung_hit hit;
	bool legal;
	int rung;

	if (is_rung(drag)) {
		drop_line(view, takes_rung(view, drag) ? drop_boundary(view, y) : -1);
		return takes_rung(view, drag) ? GDK_ACTION_MOVE : 0;
	}
	drop_word(view, word);
	rung = drop_at(view, x, y, &hit, word);
	if (rung < 0) {
		drop_at_cell(view, -1, 0, 0, false);
		return 0;
	}
	legal = drag && grid_can_drop(sheet_rung(view, rung), view->columns, hit.row,
				      hit.column, drag->word) != GRID_DROP_NOT;
	drop_at_cell(view, rung, hit.row, hit.column, legal);
	return !legal ? 0 : drag->view ? GDK_ACTION_MOVE : GDK_ACTION_COPY;
}

static void drop_again(LadderGridView *view, double x, double y, GdkModifierType state)
{
	GdkDrop *drop = gtk_drop_target_get_current_drop(view->target);
	const GdkDragAction action = show_drop(view, x, y);

	(void)state;
	if (drop)
		gdk_drop_status(drop, action, action);
}

static GdkDragAction drop_motion(GtkDropTarget *target, double x, double y,
				 LadderGridView *view)
{
	(void)target;
	edge_at(view, x, y, 0, drop_again);
	return show_drop(view, x, y);
}

static void drop_leave(GtkDropTarget *target, LadderGridView *view)
{
	(void)target;
	edge_forget(view);
	drop_forget(view);
}

/* The cursor goes with them. */
static bool move_rungs(LadderGridView *view, const struct ladder_drag *drag, int before)
{
	return takes_rung(view, drag) &&
	       rungs_move(view, drag->from.rung, drag->last, before);
}

/* NULL: it is refused, and @at or @from says why. */
static struct rung *moved(const struct ladder_drag *drag, const struct rung *from_rung,
			  struct grid_at *from, const struct rung *to_rung,
			  struct grid_at *at, struct rung **source)
{
	bool below;

	if (!drag->several)
		return grid_move(from_rung, from, to_rung, at, source);
	below = grid_can_drop(to_rung, at->columns, at->row, at->col, drag->word) ==
		GRID_DROP_BELOW;
	at->row -= below; /* of the element that it is a branch of */
	return grid_move_area(from_rung, from, &drag->area, to_rung, at, below, source);
}

/* From one rung to another is one step. */
static void move_between(LadderGridView *view, const struct ladder_drag *drag,
			 struct grid_cursor to)
{
	struct rung *from_rung = sheet_rung(drag->view, drag->from.rung);
	struct rung *to_rung = sheet_rung(view, to.rung), *source = NULL, *made;
	struct grid_at from = { drag->view->columns, drag->from.row, drag->from.col, 0 };
	struct grid_at at = { view->columns, to.row, to.col, 0 };
	const bool same = from_rung == to_rung;

	if (!from_rung || !to_rung || drag->view->document != view->document)
		return;
	made = moved(drag, from_rung, &from, to_rung, &at, &source);
	if (!made) {
		sheet_tell(view, _(grid_refusal_text(at.refusal ? at.refusal :
						     from.refusal)));
		return;
	}
	ladder_document_begin(view->document, drag->several ? _("Move elements") :
			      _("Move element"), NULL);
	if (!same && source)
		sheet_splice(drag->view, drag->from.rung, 1, &source, 1, NULL);
	sheet_splice(view, to.rung, 1, &made, 1, NULL);
	ladder_document_end(view->document);
	cursor_set(view, (struct grid_cursor){ to.rung, at.row, at.col }, false);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			LadderGridView *view)
{
	const struct ladder_drag *drag = g_value_get_boxed(value);
	struct rung_hit hit;
	int rung;

	(void)target;
	edge_forget(view);
	drop_forget(view);
	if (sheet_is_fixed(view))
		return FALSE;
	if (is_rung(drag))
		return move_rungs(view, drag, drop_boundary(view, y));
	rung = drop_at(view, x, y, &hit, drag->word);
	if (rung < 0)
		return FALSE;
	if (drag->view) {
		move_between(view, drag, (struct grid_cursor){ rung, hit.row, hit.column });
		return TRUE;
	}
	cursor_set(view, (struct grid_cursor){ rung, hit.row, hit.column }, false);
	entry_begin_drop(view, drag->word, hit.row, hit.column);
	return TRUE;
}

/* ---- all of it ---- */

void drag_init(LadderGridView *view)
{
	GtkDragSource *source = gtk_drag_source_new();
	GtkDropTarget *target = gtk_drop_target_new(LADDER_TYPE_DRAG,
						    GDK_ACTION_COPY | GDK_ACTION_MOVE);

	gtk_drag_source_set_actions(source, GDK_ACTION_COPY | GDK_ACTION_MOVE);
	g_signal_connect(source, "prepare", G_CALLBACK(drag_prepare), view);
	g_signal_connect(source, "drag-begin", G_CALLBACK(drag_begin), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(source));
	view->target = target;
	gtk_drop_target_set_preload(target, TRUE);
	g_signal_connect(target, "motion", G_CALLBACK(drop_motion), view);
	g_signal_connect(target, "leave", G_CALLBACK(drop_leave), view);
	g_signal_connect(target, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(target));
}
