/* SPDX-License-Identifier: MIT
 *
 * row_move - moving the rows of a list; see row_move.h.
 */
#include "editor-gtk/kit/row_move.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"

#define ITEM "row-move-item"

struct moving {
	const struct row_move *how;
	gpointer owner;
	GtkWidget *list;
	GtkWidget *marked;      /* the row with the line of a drop; weak          */
};

static void moving_free(gpointer data)
{
	struct moving *moving = data;

	g_clear_weak_pointer(&moving->marked);
	g_free(moving);
}

/* ---- rows ---- */

void row_move_stand(GtkWidget *cell, GtkListItem *item)
{
	g_object_set_data(G_OBJECT(cell), ITEM, item);
}

static GtkListItem *item_in(GtkWidget *widget)
{
	GtkListItem *item = g_object_get_data(G_OBJECT(widget), ITEM);

	for (GtkWidget *child = gtk_widget_get_first_child(widget); child && !item;
	     child = gtk_widget_get_next_sibling(child))
		item = item_in(child);
	return item;
}

/* The widget of the row at a point; NULL: none. */
static GtkWidget *widget_at(GtkWidget *list, double x, double y)
{
	GtkWidget *at = gtk_widget_pick(list, x, y, GTK_PICK_DEFAULT), *parent;

	for (; at && at != list; at = parent) {
		parent = gtk_widget_get_parent(at);
		if (GTK_IS_LIST_VIEW(parent))
			return at;
	}
	return NULL;
}

GtkListItem *row_move_at(GtkWidget *list, double x, double y)
{
	GtkWidget *at = widget_at(list, x, y);

	return at ? item_in(at) : NULL;
}

/* The row of an item of a list. Borrowed from the model. */
static gpointer row_in(gpointer item)
{
	gpointer row = item;

	if (item && GTK_IS_TREE_LIST_ROW(item)) {
		row = gtk_tree_list_row_get_item(item);
		if (row)
			g_object_unref(row);
	}
	return row;
}

static gpointer row_of(GtkListItem *item)
{
	return item ? row_in(gtk_list_item_get_item(item)) : NULL;
}

/* The row may be of another window, or deleted since. */
static bool is_ours(const struct moving *moving, gpointer row)
{
	GListModel *rows = G_LIST_MODEL(GTK_IS_LIST_VIEW(moving->list) ?
		gtk_list_view_get_model(GTK_LIST_VIEW(moving->list)) :
		gtk_column_view_get_model(GTK_COLUMN_VIEW(moving->list)));
	bool found = false;

	for (guint i = 0; row && !found && i < g_list_model_get_n_items(rows); i++) {
		gpointer item = g_list_model_get_item(rows, i);

		found = row_in(item) == row;
		g_object_unref(item);
	}
	return found;
}

/* ---- the drag ---- */

static GdkContentProvider *drag_prepare(struct moving *moving, GtkListItem *item)
{
	gpointer row = row_of(item);

	return row && moving->how->name(moving->owner, row) ?
	       gdk_content_provider_new_typed(G_TYPE_OBJECT, row) : NULL;
}

static GdkContentProvider *drag_row(GtkDragSource *source, double x, double y,
				    struct moving *moving)
{
	(void)source;
	return drag_prepare(moving, row_move_at(moving->list, x, y));
}

static GdkContentProvider *drag_handle(GtkDragSource *source, double x, double y,
				       struct moving *moving)
{
	(void)x;
	(void)y;
	return drag_prepare(moving, item_in(gtk_event_controller_get_widget(
		GTK_EVENT_CONTROLLER(source))));
}

static void drag_begin(GtkDragSource *source, GdkDrag *drag, struct moving *moving)
{
	GValue value = G_VALUE_INIT;

	(void)source;
	g_value_init(&value, G_TYPE_OBJECT);
	if (gdk_content_provider_get_value(gdk_drag_get_content(drag), &value, NULL)) {
		GtkWidget *label = gtk_label_new(moving->how->name(moving->owner,
			g_value_get_object(&value)));

		gtk_widget_add_css_class(label, "dragged-row");
		gtk_drag_icon_set_child(GTK_DRAG_ICON(gtk_drag_icon_get_for_drag(drag)), label);
	}
	g_value_unset(&value);
	if (moving->how->dragging)
		moving->how->dragging(moving->owner, true);
}

static void drag_end(struct moving *moving)
{
	if (moving->how->dragging)
		moving->how->dragging(moving->owner, false);
}

static void add_source(GtkWidget *widget, GCallback prepare, struct moving *moving)
{
	GtkDragSource *source = gtk_drag_source_new();

	gtk_drag_source_set_actions(source, GDK_ACTION_MOVE);
	g_signal_connect(source, "prepare", prepare, moving);
	g_signal_connect(source, "drag-begin", G_CALLBACK(drag_begin), moving);
	g_signal_connect_swapped(source, "drag-end", G_CALLBACK(drag_end), moving);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(source));
}

/* ---- the drop ---- */

/* A line at @row; NULL: none. */
static void mark(struct moving *moving, GtkWidget *row, bool below)
{
	if (moving->marked) {
		gtk_widget_remove_css_class(moving->marked, "drop-above");
		gtk_widget_remove_css_class(moving->marked, "drop-below");
	}
	g_set_weak_pointer(&moving->marked, row);
	if (row)
		gtk_widget_add_css_class(row, below ? "drop-below" : "drop-above");
}

/* Where a row that is dragged to this point would go. */
struct place {
	gpointer row, target;
	GtkWidget *at;          /* the widget of @target                          */
	bool below;
};

static bool place_at(struct moving *moving, const GValue *dragged, double x, double y,
		     struct place *to)
{
	graphene_rect_t box;

	*to = (struct place){ .row = dragged ? g_value_get_object(dragged) : NULL,
			      .at = widget_at(moving->list, x, y) };
	to->target = to->at ? row_of(item_in(to->at)) : NULL;
	if (!to->target || !is_ours(moving, to->row) ||
	    !gtk_widget_compute_bounds(to->at, moving->list, &box))
		return false;
	to->below = y > box.origin.y + box.size.height / 2;
	return moving->how->fits(moving->owner, to->row, to->target, &to->below);
}

static GdkDragAction drag_over(GtkDropTarget *target, double x, double y, struct moving *moving)
{
	struct place to;
	const bool fits = place_at(moving, gtk_drop_target_get_value(target), x, y, &to);

	mark(moving, fits ? to.at : NULL, to.below);
	return fits ? GDK_ACTION_MOVE : 0;
}

static void drag_leave(struct moving *moving)
{
	mark(moving, NULL, false);
}

static gboolean dropped(struct moving *moving, const GValue *value, double x, double y)
{
	struct place to;

	mark(moving, NULL, false);
	if (!place_at(moving, value, x, y, &to))
		return FALSE;
	g_object_ref(to.row);
	g_object_ref(to.target);
	moving->how->move(moving->owner, to.row, to.target, to.below);
	g_object_unref(to.target);
	g_object_unref(to.row);
	return TRUE;
}

static void add_target(struct moving *moving)
{
	GtkDropTarget *target = gtk_drop_target_new(G_TYPE_OBJECT, GDK_ACTION_MOVE);

	gtk_drop_target_set_preload(target, TRUE);
	g_signal_connect(target, "enter", G_CALLBACK(drag_over), moving);
	g_signal_connect(target, "motion", G_CALLBACK(drag_over), moving);
	g_signal_connect_swapped(target, "leave", G_CALLBACK(drag_leave), moving);
	g_signal_connect_swapped(target, "drop", G_CALLBACK(dropped), moving);
	gtk_widget_add_controller(moving->list, GTK_EVENT_CONTROLLER(target));
}

/* ---- a drop beside the list ---- */

#define TARGET "row-move-target"

static gpointer place_row(GtkDropTarget *drop, const GValue *value, struct moving *moving,
			  gpointer *target)
{
	GtkWidget *place = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(drop));
	gpointer row = value ? g_value_get_object(value) : NULL;
	bool below = false;

	*target = g_object_get_data(G_OBJECT(place), TARGET);
	return is_ours(moving, row) && moving->how->fits(moving->owner, row, *target, &below) ?
	       row : NULL;
}

static void leave_place(GtkDropTarget *drop)
{
	gtk_widget_remove_css_class(gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(drop)),
				    "drop-here");
}

static GdkDragAction over_place(GtkDropTarget *drop, double x, double y, struct moving *moving)
{
	gpointer target;

	(void)x;
	(void)y;
	if (!place_row(drop, gtk_drop_target_get_value(drop), moving, &target)) {
		leave_place(drop);
		return 0;
	}
	gtk_widget_add_css_class(gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(drop)),
				 "drop-here");
	return GDK_ACTION_MOVE;
}

static gboolean dropped_on(GtkDropTarget *drop, const GValue *value, double x, double y,
			   struct moving *moving)
{
	gpointer target, row = place_row(drop, value, moving, &target);

	(void)x;
	(void)y;
	leave_place(drop);
	if (!row)
		return FALSE;
	g_object_ref(row);
	moving->how->move(moving->owner, row, target, false);
	g_object_unref(row);
	return TRUE;
}

void row_move_add_place(GtkWidget *list, GtkWidget *place, gpointer target)
{
	struct moving *moving = g_object_get_data(G_OBJECT(list), "row-move");
	GtkDropTarget *drop = gtk_drop_target_new(G_TYPE_OBJECT, GDK_ACTION_MOVE);

	g_object_set_data(G_OBJECT(place), TARGET, target);
	gtk_drop_target_set_preload(drop, TRUE);
	g_signal_connect(drop, "enter", G_CALLBACK(over_place), moving);
	g_signal_connect(drop, "motion", G_CALLBACK(over_place), moving);
	g_signal_connect(drop, "leave", G_CALLBACK(leave_place), NULL);
	g_signal_connect(drop, "drop", G_CALLBACK(dropped_on), moving);
	gtk_widget_add_controller(place, GTK_EVENT_CONTROLLER(drop));
}

/* ---- keys ---- */

static gboolean key_pressed(struct moving *moving, guint key, guint code, GdkModifierType state)
{
	(void)code;
	if ((key != GDK_KEY_Up && key != GDK_KEY_Down) ||
	    (state & gtk_accelerator_get_default_mod_mask()) != GDK_ALT_MASK)
		return FALSE;
	gtk_widget_activate_action(moving->list, key == GDK_KEY_Up ? moving->how->up :
				   moving->how->down, NULL);
	return TRUE;
}

static void add_keys(struct moving *moving)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	if (moving->how->before_cells)
		gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
	g_signal_connect_swapped(keys, "key-pressed", G_CALLBACK(key_pressed), moving);
	gtk_widget_add_controller(moving->list, keys);
}

/* ---- handles ---- */

static void setup_handle(GtkSignalListItemFactory *factory, GtkListItem *item,
			 struct moving *moving)
{
	GtkWidget *handle = gtk_image_new_from_icon_name("list-drag-handle-symbolic");

	(void)factory;
	gtk_widget_add_css_class(handle, "dim-label");
	row_move_stand(handle, item);
	add_source(handle, G_CALLBACK(drag_handle), moving);
	gtk_list_item_set_child(item, handle);
}

static void bind_handle(GtkSignalListItemFactory *factory, GtkListItem *item,
			struct moving *moving)
{
	GtkWidget *handle = gtk_list_item_get_child(item);
	const char *of = moving->how->name(moving->owner, gtk_list_item_get_item(item));
	char *name = of ? g_strdup_printf(_("Move %s (Alt+Up, Alt+Down)"), of) : NULL;

	(void)factory;
	gtk_widget_set_visible(handle, of != NULL);
	if (name) {
		tip_set(handle, name);
		spoken_name(handle, name);
	}
	g_free(name);
}

static void add_handles(struct moving *moving)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
	GtkColumnViewColumn *column = gtk_column_view_column_new("", factory);

	g_signal_connect(factory, "setup", G_CALLBACK(setup_handle), moving);
	g_signal_connect(factory, "bind", G_CALLBACK(bind_handle), moving);
	/* Not the first column: a press at the edge of the list moves the divider of panes. */
	gtk_column_view_insert_column(GTK_COLUMN_VIEW(moving->list), 1, column);
	g_object_unref(column);
}

void row_move_add(GtkWidget *list, const struct row_move *how, gpointer owner)
{
	struct moving *moving = g_new0(struct moving, 1);

	*moving = (struct moving){ .how = how, .owner = owner, .list = list };
	g_object_set_data_full(G_OBJECT(list), "row-move", moving, moving_free);
	if (GTK_IS_COLUMN_VIEW(list))
		add_handles(moving);
	else
		add_source(list, G_CALLBACK(drag_row), moving);
	add_target(moving);
	add_keys(moving);
}
