/* SPDX-License-Identifier: MIT
 *
 * popover - popovers and menus that GTK 4.8 closes, points and measures well; see popover.h.
 */
#include "editor-gtk/kit/gtk48/popover.h"

/* GTK waits half a second before it looks for a tooltip. Then it asks the surface that the
 * pointer was in last, which may be the popover's. It removes this timer itself at the next
 * event. */
static void forget_tooltip(GdkDisplay *display)
{
	GSource *timer = g_main_context_find_source_by_user_data(NULL, display);

	if (timer && g_strcmp0(g_source_get_name(timer), "[gtk] tooltip_popup_timeout") == 0)
		g_source_set_ready_time(timer, -1);
}

void popover_drop(GtkWidget *popover)
{
	/* An event may have brought the pointer back since it was hidden. GTK does not look
	 * for a surface below the pointer in an insensitive widget. */
	gtk_widget_set_sensitive(popover, FALSE);
	forget_tooltip(gtk_widget_get_display(popover));
	if (gtk_widget_get_parent(popover))
		gtk_widget_unparent(popover);
}

/* A disposed widget unparents only the children that it made itself. */
void popover_put(GtkWidget *popover, GtkWidget *parent)
{
	gtk_widget_set_parent(popover, parent);
	g_signal_connect_object(parent, "destroy", G_CALLBACK(popover_drop), popover,
				G_CONNECT_SWAPPED);
}

static int within(int at, int size)
{
	return CLAMP(at, 0, MAX(size - 1, 0));
}

void popover_point(GtkWidget *popover, const GdkRectangle *at)
{
	GtkWidget *parent = gtk_widget_get_parent(popover);
	const int width = gtk_widget_get_width(parent), height = gtk_widget_get_height(parent);
	const int x = within(at->x, width), y = within(at->y, height);
	const GdkRectangle seen = { x, y, MAX(within(at->x + at->width, width) - x, 1),
				    MAX(within(at->y + at->height, height) - y, 1) };

	gtk_popover_set_pointing_to(GTK_POPOVER(popover), &seen);
}

static gboolean drop(gpointer popover)
{
	popover_drop(popover);
	g_object_unref(popover);
	return G_SOURCE_REMOVE;
}

void popover_drop_later(GtkWidget *popover)
{
	g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, drop, g_object_ref(popover), NULL);
}

void popover_menu(GtkWidget *parent, GMenu *menu, const GdkRectangle *at, GtkWidget *then)
{
	GtkWidget *popover = gtk_popover_menu_new_from_model(G_MENU_MODEL(menu));

	popover_put(popover, parent);
	popover_point(popover, at);
	gtk_popover_set_has_arrow(GTK_POPOVER(popover), FALSE);
	gtk_popover_set_position(GTK_POPOVER(popover), GTK_POS_RIGHT);
	gtk_widget_set_valign(popover, GTK_ALIGN_START);
	g_signal_connect(popover, "closed", G_CALLBACK(popover_drop_later), NULL);
	g_signal_connect_object(popover, "closed", G_CALLBACK(gtk_widget_grab_focus), then,
				G_CONNECT_SWAPPED);
	gtk_popover_popup(GTK_POPOVER(popover));
	g_object_unref(menu);
}

/* ---- the menu of a button ---- */

static GtkWidget *focus_of(gpointer button)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(button));

	return root ? gtk_root_get_focus(root) : NULL;
}

static bool is_beside(GtkWidget *focus, gpointer button)
{
	return focus && !gtk_widget_is_ancestor(focus, GTK_WIDGET(button));
}

/* Keeps the focus if a command moved it. gtk_widget_grab_focus() would select the text of
 * an entry. */
static void give_back(GtkMenuButton *button)
{
	GtkWidget *then = g_object_get_data(G_OBJECT(button), "then");

	if (then && gtk_widget_get_root(then) && !is_beside(focus_of(button), button))
		gtk_root_set_focus(gtk_widget_get_root(then), then);
	g_object_set_data(G_OBJECT(button), "then", NULL);
}

/* Called each time before the menu opens; F10 opens it when the focus is not in the button. */
static void make_menu(GtkMenuButton *button, gpointer make)
{
	GtkWidget *focus = focus_of(button);
	GMenu *menu;

	g_object_set_data_full(G_OBJECT(button), "then", is_beside(focus, button) ?
			       g_object_ref(focus) : NULL, g_object_unref);
	if (gtk_menu_button_get_menu_model(button))
		return;
	menu = ((GMenu *(*)(void))make)();
	gtk_menu_button_set_menu_model(button, G_MENU_MODEL(menu));
	g_signal_connect_object(gtk_menu_button_get_popover(button), "closed",
				G_CALLBACK(give_back), button, G_CONNECT_SWAPPED);
	g_object_unref(menu);
}

void popover_menu_of(GtkMenuButton *button, GMenu *(*make)(void))
{
	gtk_menu_button_set_create_popup_func(button, make_menu, (gpointer)make, NULL);
}

/* ---- keys of a form ---- */

/* The last row that can have the focus, or the first. */
static GtkWidget *end_of(GtkWidget *list, bool last)
{
	GtkWidget *row = last ? gtk_widget_get_last_child(list) : gtk_widget_get_first_child(list);

	while (row && !gtk_widget_get_child_visible(row))
		row = last ? gtk_widget_get_prev_sibling(row) : gtk_widget_get_next_sibling(row);
	return row;
}

/* From the last widget to the first, and back. A list counts once: arrows move in it. */
static void go_on(GtkWidget *popover, GtkDirectionType direction)
{
	GtkWidget *child = gtk_popover_get_child(GTK_POPOVER(popover)), *focus = focus_of(popover);
	GtkWidget *list = focus ? gtk_widget_get_ancestor(focus, GTK_TYPE_LIST_BOX) : NULL;
	GtkWidget *end = list ? end_of(list, direction == GTK_DIR_TAB_FORWARD) : NULL;

	if (end)
		gtk_widget_grab_focus(end);
	if (!gtk_widget_child_focus(child, direction)) {
		gtk_root_set_focus(gtk_widget_get_root(popover), NULL);
		gtk_widget_child_focus(child, direction);
	}
	/* GTK enters a list at its selected row, also if a filter hides it. */
	focus = focus_of(popover);
	list = focus ? gtk_widget_get_ancestor(focus, GTK_TYPE_LIST_BOX) : NULL;
	if (list && !gtk_widget_get_child_visible(focus) && end_of(list, false))
		gtk_widget_grab_focus(end_of(list, false));
}

static gboolean form_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType held,
			 gpointer unused)
{
	GtkWidget *popover = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(keys));

	(void)code;
	(void)unused;
	if (held & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return FALSE;
	switch (key) {
	case GDK_KEY_Tab: case GDK_KEY_KP_Tab:
		go_on(popover, held & GDK_SHIFT_MASK ? GTK_DIR_TAB_BACKWARD : GTK_DIR_TAB_FORWARD);
		return TRUE;
	case GDK_KEY_ISO_Left_Tab:
		go_on(popover, GTK_DIR_TAB_BACKWARD);
		return TRUE;
	case GDK_KEY_Escape:
		gtk_popover_popdown(GTK_POPOVER(popover));
		return TRUE;
	default:
		return FALSE;
	}
}

/* Unless the focus is elsewhere already. */
static void form_closed(GtkWidget *popover, GtkWidget *back)
{
	GtkWidget *focus = focus_of(popover);

	if (!focus || gtk_widget_is_ancestor(focus, popover))
		gtk_widget_grab_focus(back);
}

void popover_form(GtkWidget *popover, GtkWidget *back)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(form_key), NULL);
	g_signal_connect(popover, "closed", G_CALLBACK(form_closed), back);
	gtk_widget_add_controller(popover, keys);
}

void popover_tell(GtkLabel *label, const char *text)
{
	GtkWidget *widget = GTK_WIDGET(label), *popover;
	int width, height;

	gtk_widget_set_size_request(widget, -1, -1);
	gtk_label_set_text(label, text);
	gtk_widget_set_visible(widget, text[0]);
	gtk_widget_measure(widget, GTK_ORIENTATION_HORIZONTAL, -1, NULL, &width, NULL, NULL);
	gtk_widget_measure(widget, GTK_ORIENTATION_VERTICAL, width, NULL, &height, NULL, NULL);
	gtk_widget_set_size_request(widget, width, height);
	popover = gtk_widget_get_ancestor(widget, GTK_TYPE_POPOVER);
	if (popover && gtk_widget_get_mapped(popover))
		gtk_popover_present(GTK_POPOVER(popover));
}

/* ---- closed popovers give up their surface ---- */

static gboolean give_up_surface(gpointer data)
{
	GtkWidget *popover = data;

	if (!gtk_widget_get_mapped(popover) && gtk_widget_get_realized(popover)) {
		forget_tooltip(gtk_widget_get_display(popover));
		gtk_widget_unrealize(popover);
	}
	return G_SOURCE_REMOVE;
}

/* Before the next frame, but not inside the handlers that hide it. */
static gboolean closed(GSignalInvocationHint *hint, guint count, const GValue *values,
		       gpointer data)
{
	GtkPopover *popover = g_value_get_object(values);

	(void)hint, (void)count, (void)data;
	if (gtk_popover_get_autohide(popover)) /* only popovers that close by themselves grab
						  the pointer */
		g_idle_add_full(G_PRIORITY_HIGH, give_up_surface, g_object_ref(popover),
				g_object_unref);
	return TRUE; /* of the next one, too */
}

/* ---- a closed popover gives up the focus ---- */

static bool takes_focus(GtkWidget *widget)
{
	return gtk_widget_get_mapped(widget) && (GTK_IS_TEXT(widget) ?
		gtk_text_grab_focus_without_selecting(GTK_TEXT(widget)) :
		gtk_widget_grab_focus(widget));
}

/* To the nearest widget around it; without one, keys go to the window. */
static gboolean give_up_focus(gpointer popover)
{
	GtkWidget *focus = focus_of(popover), *around = gtk_widget_get_parent(popover);

	if (gtk_widget_get_mapped(popover) || !focus || !gtk_widget_is_ancestor(focus, popover))
		return G_SOURCE_REMOVE;
	while (around && !GTK_IS_ROOT(around) && !takes_focus(around))
		around = gtk_widget_get_parent(around);
	if (!around || GTK_IS_ROOT(around))
		gtk_root_set_focus(gtk_widget_get_root(popover), NULL);
	return G_SOURCE_REMOVE;
}

static void focus_moved(GtkRoot *root)
{
	GtkWidget *focus = gtk_root_get_focus(root);
	GtkWidget *popover = focus ? gtk_widget_get_ancestor(focus, GTK_TYPE_POPOVER) : NULL;

	if (popover && !gtk_widget_get_mapped(popover))
		g_idle_add_full(G_PRIORITY_HIGH_IDLE, give_up_focus, g_object_ref(popover),
				g_object_unref);
}

static void guard_focus(GtkWidget *popover)
{
	GtkRoot *root = gtk_widget_get_root(popover);

	g_signal_handlers_disconnect_by_func(root, focus_moved, NULL);
	g_signal_connect(root, "notify::focus-widget", G_CALLBACK(focus_moved), NULL);
}

/* ---- an open menu hides tooltips ---- */

static void show_chosen(GtkWidget *popover);

static int open_count;
static void (*map_popover)(GtkWidget *popover), (*unmap_popover)(GtkWidget *popover);

static void mapped(GtkWidget *popover)
{
	open_count += gtk_popover_get_autohide(GTK_POPOVER(popover));
	guard_focus(popover);
	map_popover(popover);
	if (GTK_IS_DROP_DOWN(gtk_widget_get_parent(popover)))
		show_chosen(popover);
}

static void unmapped(GtkWidget *popover)
{
	open_count -= gtk_popover_get_autohide(GTK_POPOVER(popover));
	unmap_popover(popover);
}

bool popover_is_above(GtkWidget *widget)
{
	return open_count > 0 && (!widget || !gtk_widget_get_ancestor(widget, GTK_TYPE_POPOVER));
}

/* ---- the list of a drop-down ---- */

static GtkWidget *list_in(GtkWidget *widget)
{
	GtkWidget *list = GTK_IS_LIST_VIEW(widget) ? widget : NULL;

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !list;
	     child = gtk_widget_get_next_sibling(child))
		list = list_in(child);
	return list;
}

static gboolean scroll_to_chosen(gpointer popover)
{
	GtkWidget *drop = gtk_widget_get_parent(popover), *list = list_in(popover);
	const guint at = drop ? gtk_drop_down_get_selected(GTK_DROP_DOWN(drop)) :
				GTK_INVALID_LIST_POSITION;

	if (!list || at == GTK_INVALID_LIST_POSITION || !gtk_widget_get_mapped(popover))
		return G_SOURCE_REMOVE;
	gtk_widget_activate_action(list, "list.scroll-to-item", "u", at);
	return G_SOURCE_REMOVE;
}

static void show_chosen(GtkWidget *popover)
{
	g_idle_add_full(G_PRIORITY_HIGH_IDLE, scroll_to_chosen, g_object_ref(popover), g_object_unref);
}

/* ---- a popover points into its window ---- */

static void (*show_popover)(GtkWidget *popover), (*hide_popover)(GtkWidget *popover);

/* What a popover points to in @window, the widget with the surface of its parent. */
static GdkRectangle pointed(GtkWidget *popover, GtkWidget *window)
{
	GtkWidget *parent = gtk_widget_get_parent(popover);
	GdkRectangle at = { 0, 0, 0, 0 };
	double x, y;

	gtk_popover_get_pointing_to(GTK_POPOVER(popover), &at);
	if (!gtk_widget_translate_coordinates(parent, window, at.x, at.y, &x, &y))
		return at;
	return (GdkRectangle){ (int)x, (int)y, at.width, at.height };
}

static bool is_outside(const GdkRectangle *at, int width, int height)
{
	return at->x + at->width <= 0 || at->x >= width || at->y + at->height <= 0 ||
	       at->y >= height;
}

/* What a popover pointed to before it was shown. */
struct pointed {
	bool any;                /* false: to its parent                        */
	GdkRectangle before, inside;
};

static void point_inside(GtkWidget *popover, GtkWidget *window)
{
	const int width = gtk_widget_get_width(window), height = gtk_widget_get_height(window);
	const GdkRectangle at = pointed(popover, window);
	struct pointed was = { .any = false };
	double x, y;

	if (width > 0 && height > 0 && is_outside(&at, width, height) &&
	    gtk_widget_translate_coordinates(window, gtk_widget_get_parent(popover),
					     within(at.x, width), within(at.y, height), &x, &y)) {
		was.any = gtk_popover_get_pointing_to(GTK_POPOVER(popover), &was.before);
		was.inside = (GdkRectangle){ (int)x, (int)y, 1, 1 };
		gtk_popover_set_pointing_to(GTK_POPOVER(popover), &was.inside);
		g_object_set_data_full(G_OBJECT(popover), "pointed", g_memdup2(&was, sizeof(was)), g_free);
	}
}

/* Its parent may be in sight when it is shown again. */
static void point_back(GtkWidget *popover)
{
	struct pointed *was = g_object_steal_data(G_OBJECT(popover), "pointed");
	GdkRectangle now;

	if (was && gtk_popover_get_pointing_to(GTK_POPOVER(popover), &now) &&
	    gdk_rectangle_equal(&now, &was->inside))
		gtk_popover_set_pointing_to(GTK_POPOVER(popover), was->any ? &was->before : NULL);
	g_free(was);
}

static void shown(GtkWidget *popover)
{
	GtkWidget *parent = gtk_widget_get_parent(popover);

	if (parent && gtk_widget_get_native(parent))
		point_inside(popover, GTK_WIDGET(gtk_widget_get_native(parent)));
	show_popover(popover);
}

static void hidden(GtkWidget *popover)
{
	hide_popover(popover);
	point_back(popover);
}

void popover_init(void)
{
	/* stays: its signals live in it */
	GtkWidgetClass *class = g_type_class_ref(GTK_TYPE_POPOVER);

	show_popover = class->show;
	class->show = shown;
	hide_popover = class->hide;
	class->hide = hidden;
	map_popover = class->map;
	unmap_popover = class->unmap;
	class->map = mapped;
	class->unmap = unmapped;
	g_signal_add_emission_hook(g_signal_lookup("closed", GTK_TYPE_POPOVER), 0, closed,
				   NULL, NULL);
}
