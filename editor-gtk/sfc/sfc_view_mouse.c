/* SPDX-License-Identifier: MIT
 *
 * sfc_view_mouse - a chart under the pointer: click, select, draw a way, menu, zoom.
 *
 * A way is drawn from the lower edge of a step, or from a transition, to another step.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/kit/gtk48/popover.h"

#define SLACK 6

static struct sfc_at at_point(LadderSfcView *view, double x, double y)
{
	if (!view->sheet)
		return (struct sfc_at){ -1, -1, false };
	return sfc_sheet_at(view->sheet, (float)chart_px(view, x),
			    (float)chart_px(view, y), SLACK);
}

static void pressed(GtkGestureClick *gesture, int count, double x, double y,
		    LadderSfcView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(gesture));
	const struct sfc_at at = at_point(view, x, y);

	gtk_widget_grab_focus(GTK_WIDGET(view));
	view->press = at;
	view->press_x = chart_px(view, x);
	view->press_y = chart_px(view, y);
	view->dragging = false;
	if (at.shape < 0)
		return;
	chart_go(view, at, state & GDK_SHIFT_MASK);
	if (count == 2)
		chart_ask_here(view, NULL);
}

/* ---- drawing a way ---- */

static bool can_begin(LadderSfcView *view)
{
	const struct sfc_at at = view->press;

	if (!view->sheet || at.shape < 0 || at.use >= 0)
		return false;
	return view->sheet->layout->shape[at.shape].part != SFC_JUMP;
}

static void drag_update(GtkGestureDrag *gesture, double by_x, double by_y,
			LadderSfcView *view)
{
	double x, y;

	if (!can_begin(view) || !gtk_gesture_drag_get_start_point(gesture, &x, &y) ||
	    (!view->dragging && !gtk_drag_check_threshold(GTK_WIDGET(view), (int)x, (int)y,
						(int)(x + by_x), (int)(y + by_y))))
		return;
	gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_CLAIMED);
	view->dragging = true;
	view->drag_x = chart_px(view, x + by_x);
	view->drag_y = chart_px(view, y + by_y);
	view->drop = at_point(view, x + by_x, y + by_y);
	if (view->drop.shape == view->press.shape)
		view->drop.shape = -1;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void drag_end(GtkGestureDrag *gesture, double by_x, double by_y,
		     LadderSfcView *view)
{
	(void)gesture;
	(void)by_x;
	(void)by_y;
	if (!view->dragging)
		return;
	view->dragging = false;
	gtk_widget_queue_draw(GTK_WIDGET(view));
	if (view->drop.shape >= 0)
		chart_lead(view, view->press, view->drop);
}

void chart_drag_snapshot(LadderSfcView *view, GtkSnapshot *snapshot,
			 const struct theme *theme)
{
	struct picture picture;
	graphene_rect_t box;
	float x, y;

	if (!view->dragging)
		return;
	box = chart_box(view, view->press);
	x = view->sheet->lane[view->sheet->layout->shape[view->press.shape].lane].x;
	y = box.origin.y + box.size.height;
	picture_init(&picture);
	picture_line(&picture, TOKEN_ACCENT, STROKE_DASHED, 2, x, y, (float)view->drag_x,
		     (float)view->drag_y);
	picture_disc(&picture, TOKEN_ACCENT, 1, (float)view->drag_x, (float)view->drag_y, 4);
	picture_snapshot(&picture, theme, view->lettering, snapshot);
	picture_clear(&picture);
}

/* ---- menu ---- */

static const struct {
	const char *name;
	enum verb verb[9];
} menu_parts[] = {
	{ NULL, { VERB_enter, VERB_step_does, VERB_as_rung, VERB_COUNT } },
	{ NULL, { VERB_step_below, VERB_step_branch, VERB_step_parallel, VERB_lead_to,
		  VERB_wait_for, VERB_branch_left, VERB_branch_right, VERB_COUNT } },
	{ NULL, { VERB_step_kind, VERB_step_times, VERB_way_name, VERB_way_priority,
		  VERB_chart_comment, VERB_macro_make, VERB_macro_open, VERB_COUNT } },
	{ NULL, { VERB_rename, VERB_show_uses, VERB_watch_add, VERB_force, VERB_COUNT } },
	{ NULL, { VERB_cut, VERB_copy, VERB_paste, VERB_delete, VERB_COUNT } },
};

/* Is there another branch beside it? */
static bool has_neighbour(LadderSfcView *view, enum sfc_part part, int index)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	int step = part == SFC_STEP ? index : -1, ways = 0, from = -1;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];
		bool leads = part == SFC_TRANSITION && i == index;

		for (int k = t->first_to; step >= 0 && k < t->first_to + t->to_count; k++)
			leads |= sfc->ref[k].step == step;
		if (leads && step >= 0 && t->to_count > 1)
			return true;
		if (leads && t->from_count > 0)
			from = sfc->ref[t->first_from].step;
	}
	for (int i = 0; from >= 0 && i < sfc->transition_count; i++)
		for (int k = 0; k < sfc->transition[i].from_count; k++)
			ways += sfc->ref[sfc->transition[i].first_from + k].step == from;
	return ways > 1;
}

/* Has it anything to do with what the cursor is on? */
static bool applies(LadderSfcView *view, enum verb verb)
{
	int index;
	const enum sfc_part part = chart_part(view, &index);

	switch ((int)verb) {
	case VERB_branch_left: case VERB_branch_right:
		return has_neighbour(view, part, index);
	case VERB_step_does: case VERB_step_kind: case VERB_step_times: case VERB_macro_make:
	case VERB_step_branch:
		return part == SFC_STEP && view->cursor.use < 0;
	case VERB_wait_for: case VERB_way_name: case VERB_way_priority:
		return part == SFC_TRANSITION;
	case VERB_macro_open:
		return chart_macro_here(view) >= 0;
	case VERB_as_rung:
		return part == SFC_TRANSITION || view->cursor.use >= 0;
	case VERB_chart_comment:
		return part == SFC_STEP || part == SFC_TRANSITION;
	case VERB_force:
		return part == SFC_STEP && chart_live_is_on(view);
	default:
		return true;
	}
}

static GMenu *make_menu(LadderSfcView *view)
{
	GMenu *menu = g_menu_new();

	for (gsize i = 0; i < G_N_ELEMENTS(menu_parts); i++) {
		GMenu *part = g_menu_new();

		for (const enum verb *verb = menu_parts[i].verb; *verb != VERB_COUNT; verb++)
			if (applies(view, *verb))
				g_menu_append(part, _(verb_row(*verb)->label),
					      verb_row(*verb)->action);
		g_menu_append_section(menu, NULL, G_MENU_MODEL(part));
		g_object_unref(part);
	}
	return menu;
}

static void show_menu(GtkGestureClick *gesture, int count, double x, double y,
		      LadderSfcView *view)
{
	const GdkRectangle at = { (int)x, (int)y, 1, 1 };

	pressed(gesture, MIN(count, 1), x, y, view);
	popover_menu(GTK_WIDGET(view), make_menu(view), &at, GTK_WIDGET(view));
}

void chart_mouse_menu(LadderSfcView *view)
{
	graphene_rect_t box = GRAPHENE_RECT_INIT(0, 0, 1, 1);

	if (view->sheet && view->cursor.shape >= 0)
		box = chart_box(view, view->cursor);
	graphene_rect_scale(&box, (float)view->zoom, (float)view->zoom, &box);
	popover_menu(GTK_WIDGET(view), make_menu(view),
		     &(GdkRectangle){ (int)box.origin.x, (int)box.origin.y,
				      (int)box.size.width, (int)box.size.height },
		     GTK_WIDGET(view));
}

/* ---- zoom ---- */

static gboolean scrolled(GtkEventControllerScroll *scroll, double dx, double dy,
			 LadderSfcView *view)
{
	const GdkModifierType state = gtk_event_controller_get_current_event_state(
		GTK_EVENT_CONTROLLER(scroll));

	(void)dx;
	if (!(state & GDK_CONTROL_MASK) || dy == 0)
		return FALSE;
	ladder_sfc_view_set_zoom(view, view->zoom * (dy < 0 ? 1.1 : 1 / 1.1));
	return TRUE;
}

void chart_mouse_init(LadderSfcView *view)
{
	GtkGesture *click = gtk_gesture_click_new(), *menu = gtk_gesture_click_new();
	GtkGesture *drag = gtk_gesture_drag_new();
	GtkEventController *scroll = gtk_event_controller_scroll_new(
		GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);

	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_PRIMARY);
	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(menu), GDK_BUTTON_SECONDARY);
	g_signal_connect(click, "pressed", G_CALLBACK(pressed), view);
	g_signal_connect(menu, "pressed", G_CALLBACK(show_menu), view);
	g_signal_connect(drag, "drag-update", G_CALLBACK(drag_update), view);
	g_signal_connect(drag, "drag-end", G_CALLBACK(drag_end), view);
	g_signal_connect(scroll, "scroll", G_CALLBACK(scrolled), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(click));
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(menu));
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(drag));
	gtk_widget_add_controller(GTK_WIDGET(view), scroll);
}
