/* SPDX-License-Identifier: MIT
 *
 * grid_view_mouse - a sheet under the pointer: click, select, drag, drop, zoom, menu.
 *
 * Whatever the keyboard can do, the pointer can do too: by dragging, or from the menu of
 * the right button, which is made from the verbs.
 */
#include "editor-gtk/grid_view_inside.h"

#include "editor-gtk/ghost.h"
#include "editor-gtk/popover.h"

/* ---- what is dragged ---- */

#define LADDER_TYPE_DRAG (ladder_drag_get_type())

/* An element of the palette, or one of a sheet. */
struct ladder_drag {
	enum word word;
	LadderGridView *view;      /* it comes from; NULL: the palette         */
	struct grid_cursor from;
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

/* ---- clicks ---- */

static bool is_cell(const struct rung_hit *hit)
{
	return hit->part == RUNG_PART_CELL || hit->part == RUNG_PART_WIRE ||
	       hit->part == RUNG_PART_LINK || hit->part == RUNG_PART_PIN;
}

/* What was clicked twice: of a box the value at a pin; while it runs as Enter does. */
static void begin_there(LadderGridView *view, const struct rung_hit *hit)
{
	if (hit->part == RUNG_PART_PIN && !live_is_on(view))
		entry_begin_pin(view, hit->name, hit->name_len, hit->output);
	else
		ladder_grid_view_do(view, VERB_enter);
}

static void pressed(GtkGestureClick *gesture, int count, double x, double y,
		    LadderGridView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(gesture));
	/* Of the sheet, since that may scroll to the cursor. */
	const double at_x = (x + gtk_adjustment_get_value(view->adjustment[0])) / view->zoom;
	const double at_y = (y + gtk_adjustment_get_value(view->adjustment[1])) / view->zoom;
	struct rung_hit hit;
	const int rung = sheet_point(view, x, y, &hit);

	gtk_widget_grab_focus(GTK_WIDGET(view));
	view->press_x = x;
	view->press_y = y;
	view->takes = view->toggles = false;
	wire_forget(view);
	if (rung < 0)
		return;
	if (is_cell(&hit)) {
		cursor_set(view, (struct grid_cursor){ rung, hit.row, hit.column },
			   state & GDK_SHIFT_MASK);
		view->takes = !(state & GDK_SHIFT_MASK) && !wire_press(view, x, y) &&
			      cursor_cell(view, NULL, NULL);
		view->toggles = view->takes &&
			act_is_click(view, (float)at_x, (float)at_y);
		if (count == 2 && !view->toggles)
			begin_there(view, &hit);
		return;
	}
	cursor_set(view, (struct grid_cursor){ rung, 0, 0 }, state & GDK_SHIFT_MASK);
	if (hit.part == RUNG_PART_NUMBER && !(state & GDK_SHIFT_MASK))
		ladder_grid_view_do(view, VERB_select_all);
	else if (hit.part == RUNG_PART_TITLE && count == 2)
		ladder_grid_view_do(view, VERB_rung_title);
}

/* Not when it is pressed: it may be dragged. */
static void released(GtkGestureClick *gesture, int count, double x, double y,
		     LadderGridView *view)
{
	(void)gesture;
	(void)count;
	if (view->toggles &&
	    !gtk_drag_check_threshold(GTK_WIDGET(view), (int)view->press_x,
				      (int)view->press_y, (int)x, (int)y))
		act_click(view);
	view->toggles = false;
}

/* Sections; with a name, they open at the side. */
static const struct {
	const char *name;
	enum verb verb[14];
} menu_parts[] = {
	{ NULL, { VERB_edit_operand, VERB_negate, VERB_cycle, VERB_comment, VERB_COUNT } },
	{ N_("Put here"), { VERB_contact, VERB_contact_not, VERB_coil, VERB_block,
		VERB_parallel, VERB_parallel_not, VERB_add_pin, VERB_COUNT } },
	{ N_("Wires"), { VERB_wire_left, VERB_wire_right, VERB_wire_up, VERB_wire_down,
		VERB_wire_here, VERB_link_here, VERB_COUNT } },
	{ N_("Rows and columns"), { VERB_insert_row, VERB_delete_row,
		VERB_insert_column, VERB_delete_column, VERB_COUNT } },
	{ N_("Rung"), { VERB_rung_below, VERB_rung_above, VERB_rung_duplicate,
		VERB_rung_up, VERB_rung_down, VERB_rung_title, VERB_rung_label,
		VERB_rung_comment, VERB_rung_off, VERB_bookmark, VERB_copy_picture,
		VERB_rung_delete, VERB_COUNT } },
	{ NULL, { VERB_cut, VERB_copy, VERB_paste, VERB_paste_parallel, VERB_delete,
		VERB_COUNT } },
	{ NULL, { VERB_go_coil, VERB_show_uses, VERB_rename, VERB_watch_add, VERB_expect,
		VERB_COUNT } },
};

static GMenu *make_menu(LadderGridView *view)
{
	GMenu *menu = g_menu_new();
	GMenuModel *live = act_menu(view);

	g_menu_append_section(menu, NULL, live);
	g_object_unref(live);
	for (gsize i = 0; i < G_N_ELEMENTS(menu_parts); i++) {
		GMenu *part = g_menu_new();

		for (const enum verb *verb = menu_parts[i].verb; *verb != VERB_COUNT; verb++)
			g_menu_append(part, _(verb_row(*verb)->label),
				      verb_row(*verb)->action);
		if (menu_parts[i].name)
			g_menu_append_submenu(menu, _(menu_parts[i].name),
					      G_MENU_MODEL(part));
		else
			g_menu_append_section(menu, NULL, G_MENU_MODEL(part));
		g_object_unref(part);
	}
	return menu;
}

static void show_menu(GtkGestureClick *gesture, int count, double x, double y,
		      LadderGridView *view)
{
	const GdkRectangle at = { (int)x, (int)y, 1, 1 };

	pressed(gesture, MIN(count, 1), x, y, view);
	popover_menu(GTK_WIDGET(view), make_menu(view), &at, GTK_WIDGET(view));
}

void mouse_menu(LadderGridView *view)
{
	graphene_rect_t cell;

	cursor_reveal(view);
	cell = cursor_rect(view);
	popover_menu(GTK_WIDGET(view), make_menu(view),
		     &(GdkRectangle){ (int)cell.origin.x, (int)cell.origin.y,
				      (int)(cell.size.width / 2), (int)cell.size.height },
		     GTK_WIDGET(view));
}

/* ---- dragging: a wire from where one can begin; selecting from elsewhere, or with Shift */

/* (x, y) px of the widget: a wire grows to there, or the selection does; false: neither. */
static bool drag_to(LadderGridView *view, double x, double y, GdkModifierType state)
{
	struct rung_hit hit;
	int rung;

	if (view->wire.pressed) {
		wire_drag(view, x, y, state);
		return true;
	}
	rung = sheet_point(view, x, y, &hit);
	if (rung < 0 || !is_cell(&hit))
		return false;
	cursor_set(view, (struct grid_cursor){ rung, hit.row, hit.column }, true);
	return true;
}

static void drag_again(LadderGridView *view, double x, double y, GdkModifierType state)
{
	drag_to(view, x, y, state);
}

static void drag_update(GtkGestureDrag *gesture, double by_x, double by_y,
			LadderGridView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(gesture));
	double x, y;

	if (view->takes || !gtk_gesture_drag_get_start_point(gesture, &x, &y) ||
	    (!view->wire.drawing &&
	     !gtk_drag_check_threshold(GTK_WIDGET(view), (int)x, (int)y, (int)(x + by_x),
				       (int)(y + by_y))))
		return;
	if (drag_to(view, x + by_x, y + by_y, state))
		gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_CLAIMED);
	else if (!view->edge.timer)
		return;
	edge_at(view, x + by_x, y + by_y, state, drag_again);
}

static void drag_end(GtkGestureDrag *gesture, double by_x, double by_y,
		     LadderGridView *view)
{
	(void)gesture;
	(void)by_x;
	(void)by_y;
	edge_forget(view);
	wire_release(view);
}

static void drag_cancel(GtkGesture *gesture, GdkEventSequence *sequence,
			LadderGridView *view)
{
	(void)gesture;
	(void)sequence;
	edge_forget(view);
	wire_forget(view);
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

static GdkContentProvider *drag_prepare(GtkDragSource *source, double x, double y,
					LadderGridView *view)
{
	struct ladder_drag drag = { .view = view };
	struct rung_hit hit;
	const int rung = sheet_point(view, x, y, &hit);
	const struct cell *cell;

	(void)source;
	if (rung < 0 || view->entry || rung != view->cursor.rung)
		return NULL;
	drag.from = (struct grid_cursor){ rung, -1, -1 };
	if (hit.part == RUNG_PART_NUMBER)
		return gdk_content_provider_new_typed(LADDER_TYPE_DRAG, &drag);
	cell = cursor_cell(view, NULL, NULL);
	if (!is_cell(&hit) || !cell || !view->takes)
		return NULL;
	drag.word = (enum word)cell->word;
	drag.from = view->cursor;
	return with_names(view, cell,
			  gdk_content_provider_new_typed(LADDER_TYPE_DRAG, &drag));
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
	const bool inside = rung >= 0 && is_cell(hit);
	enum grid_drop how;

	if (inside && !is_below(view, rung, hit, y))
		return rung;
	if (!inside) {
		const int above = sheet_point(view, x, y - shift, hit);

		if (above < 0 || !is_cell(hit) || (rung >= 0 && rung != above))
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

/* The rung goes between those where the line is, which count without it; the cursor goes
 * with it. */
static bool move_rung(LadderGridView *view, const struct ladder_drag *drag, int before)
{
	const int from = drag->from.rung, to = before > from ? before - 1 : before;

	if (!takes_rung(view, drag) || to == from ||
	    !ladder_document_move_rung(view->document, view->pou, from, to))
		return false;
	cursor_set(view, (struct grid_cursor){ to, drag->from.row, drag->from.col }, false);
	return true;
}

/* From one rung to another is one step. */
static void move_between(LadderGridView *view, const struct ladder_drag *drag,
			 struct grid_cursor to)
{
	struct rung *from_rung = sheet_rung(drag->view, drag->from.rung);
	struct rung *to_rung = sheet_rung(view, to.rung), *source = NULL, *moved;
	struct grid_at from = { drag->view->columns, drag->from.row, drag->from.col, 0 };
	struct grid_at at = { view->columns, to.row, to.col, 0 };
	const bool same = from_rung == to_rung;

	if (!from_rung || !to_rung || drag->view->document != view->document)
		return;
	moved = grid_move(from_rung, &from, to_rung, &at, &source);
	if (!moved) {
		sheet_tell(view, _(grid_refusal_text(at.refusal ? at.refusal :
						     from.refusal)));
		return;
	}
	ladder_document_begin(view->document, _("Move element"), NULL);
	if (!same && source)
		sheet_splice(drag->view, drag->from.rung, 1, &source, 1, NULL);
	sheet_splice(view, to.rung, 1, &moved, 1, NULL);
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
		return move_rung(view, drag, drop_boundary(view, y));
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

/* ---- zoom about the pointer ---- */

static gboolean wheel(GtkEventControllerScroll *controller, double dx, double dy,
		      LadderGridView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(controller));

	(void)dx;
	if (!(state & GDK_CONTROL_MASK))
		return FALSE;
	ladder_grid_view_set_zoom(view, view->zoom * (dy < 0 ? 1.1 : 1 / 1.1));
	return TRUE;
}

static void pinched(GtkGestureZoom *gesture, double scale, LadderGridView *view)
{
	static const double step = 0.05;
	const double to = view->zoom * scale;

	(void)gesture;
	if (to > view->zoom * (1 + step) || to < view->zoom * (1 - step))
		ladder_grid_view_set_zoom(view, to);
}

/* ---- all of it ---- */

static void add_clicks(LadderGridView *view)
{
	GtkGesture *click = gtk_gesture_click_new();
	GtkGesture *menu = gtk_gesture_click_new();
	GtkGesture *drag = gtk_gesture_drag_new();

	g_signal_connect(click, "pressed", G_CALLBACK(pressed), view);
	g_signal_connect(click, "released", G_CALLBACK(released), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(click));
	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(menu), GDK_BUTTON_SECONDARY);
	g_signal_connect(menu, "pressed", G_CALLBACK(show_menu), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(menu));
	g_signal_connect(drag, "drag-update", G_CALLBACK(drag_update), view);
	g_signal_connect(drag, "drag-end", G_CALLBACK(drag_end), view);
	g_signal_connect(drag, "cancel", G_CALLBACK(drag_cancel), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(drag));
}

void mouse_init(LadderGridView *view)
{
	GtkDragSource *source = gtk_drag_source_new();
	GtkDropTarget *target = gtk_drop_target_new(LADDER_TYPE_DRAG,
						    GDK_ACTION_COPY | GDK_ACTION_MOVE);
	GtkEventController *scroll = gtk_event_controller_scroll_new(
		GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
	GtkGesture *pinch = gtk_gesture_zoom_new();

	gtk_drag_source_set_actions(source, GDK_ACTION_COPY | GDK_ACTION_MOVE);
	g_signal_connect(source, "prepare", G_CALLBACK(drag_prepare), view);
	g_signal_connect(source, "drag-begin", G_CALLBACK(drag_begin), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(source));
	add_clicks(view);
	view->target = target;
	gtk_drop_target_set_preload(target, TRUE);
	g_signal_connect(target, "motion", G_CALLBACK(drop_motion), view);
	g_signal_connect(target, "leave", G_CALLBACK(drop_leave), view);
	g_signal_connect(target, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(target));
	g_signal_connect(scroll, "scroll", G_CALLBACK(wheel), view);
	gtk_event_controller_set_propagation_phase(scroll, GTK_PHASE_CAPTURE);
	gtk_widget_add_controller(GTK_WIDGET(view), scroll);
	g_signal_connect(pinch, "scale-changed", G_CALLBACK(pinched), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(pinch));
}
