/* SPDX-License-Identifier: MIT
 *
 * grid_view_mouse - a sheet under the pointer: click, select, draw wires, zoom, menu.
 *
 * Whatever the keyboard can do, the pointer can do too: by dragging, or from the menu of
 * the right button, which is made from the verbs.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/gtk48/popover.h"

/* ---- clicks ---- */

bool mouse_is_cell(const struct rung_hit *hit)
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

/* The cursor goes there, and what was selected is not any more. */
static void press(LadderGridView *view, int rung, const struct rung_hit *hit, int count,
		  GdkModifierType state)
{
	/* Of the sheet, since that may scroll to the cursor. */
	const double at_x = (view->press_x + gtk_adjustment_get_value(view->adjustment[0])) /
			    view->zoom;
	const double at_y = (view->press_y + gtk_adjustment_get_value(view->adjustment[1])) /
			    view->zoom;

	if (mouse_is_cell(hit)) {
		cursor_set(view, (struct grid_cursor){ rung, hit->row, hit->column },
			   state & GDK_SHIFT_MASK);
		view->takes = !(state & GDK_SHIFT_MASK) &&
			      !wire_press(view, view->press_x, view->press_y) &&
			      cursor_cell(view, NULL, NULL);
		view->toggles = view->takes &&
			act_is_click(view, (float)at_x, (float)at_y);
		if (count == 2 && !view->toggles)
			begin_there(view, hit);
		return;
	}
	cursor_set(view, (struct grid_cursor){ rung, 0, 0 }, state & GDK_SHIFT_MASK);
	if (hit->part == RUNG_PART_NUMBER && !(state & GDK_SHIFT_MASK))
		ladder_grid_view_do(view, VERB_select_all);
	else if (hit->part == RUNG_PART_TITLE && count == 2)
		ladder_grid_view_do(view, VERB_rung_title);
}

/* What is selected may be dragged, or asked for its menu: it stays until that is known. */
static bool is_kept(LadderGridView *view, int rung, const struct rung_hit *hit, int count,
		    GdkModifierType state)
{
	int first, last;

	if (count > 1 || state & GDK_SHIFT_MASK)
		return false;
	if (hit->part == RUNG_PART_NUMBER || hit->part == RUNG_PART_TITLE)
		return cursor_rungs(view, &first, &last) &&
		       cursor_selects(view, rung, 0, 0);
	return mouse_is_cell(hit) && cursor_selects(view, rung, hit->row, hit->column);
}

static void pressed(GtkGestureClick *gesture, int count, double x, double y,
		    LadderGridView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(gesture));
	struct rung_hit hit;
	const int rung = sheet_point(view, x, y, &hit);

	gtk_widget_grab_focus(GTK_WIDGET(view));
	view->press_x = x;
	view->press_y = y;
	view->takes = view->toggles = view->keeps = view->given_up = false;
	wire_forget(view);
	if (rung < 0)
		return;
	view->keeps = view->takes = is_kept(view, rung, &hit, count, state);
	if (!view->keeps)
		press(view, rung, &hit, count, state);
}

/* Not when it is pressed: it may be dragged. */
static void released(GtkGestureClick *gesture, int count, double x, double y,
		     LadderGridView *view)
{
	const bool moved = gtk_drag_check_threshold(GTK_WIDGET(view), (int)view->press_x,
						    (int)view->press_y, (int)x, (int)y);
	struct rung_hit hit;
	int rung;

	(void)gesture;
	if (view->keeps && !moved) {
		rung = sheet_point(view, view->press_x, view->press_y, &hit);
		if (rung >= 0)
			press(view, rung, &hit, count, 0);
		wire_forget(view);
	}
	if (view->toggles && !moved)
		act_click(view);
	view->toggles = view->keeps = false;
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
	if (rung < 0 || !mouse_is_cell(&hit))
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

	if (view->takes || view->given_up ||
	    !gtk_gesture_drag_get_start_point(gesture, &x, &y) ||
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

/* ---- zoom about the pointer ---- */

static gboolean wheel(GtkEventControllerScroll *controller, double dx, double dy,
		      LadderGridView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(controller));

	(void)dx;
	if (!(state & GDK_CONTROL_MASK))
		return FALSE;
	sheet_zoom(view, view->zoom * (dy < 0 ? 1.1 : 1 / 1.1));
	return TRUE;
}

static void pinched(GtkGestureZoom *gesture, double scale, LadderGridView *view)
{
	static const double step = 0.05;
	const double to = view->zoom * scale;

	(void)gesture;
	if (to > view->zoom * (1 + step) || to < view->zoom * (1 - step))
		sheet_zoom(view, to);
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
	GtkEventController *scroll = gtk_event_controller_scroll_new(
		GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
	GtkGesture *pinch = gtk_gesture_zoom_new();

	drag_init(view);
	add_clicks(view);
	g_signal_connect(scroll, "scroll", G_CALLBACK(wheel), view);
	gtk_event_controller_set_propagation_phase(scroll, GTK_PHASE_CAPTURE);
	gtk_widget_add_controller(GTK_WIDGET(view), scroll);
	g_signal_connect(pinch, "scale-changed", G_CALLBACK(pinched), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(pinch));
}
