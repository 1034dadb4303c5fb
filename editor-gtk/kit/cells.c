/* SPDX-License-Identifier: MIT
 *
 * cells - refusals, focus and pending edits in tables; see cells.h.
 */
#include "editor-gtk/kit/cells.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/left.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <string.h>

#define PLACE GTK_ENTRY_ICON_SECONDARY

/* An empty icon would take up space. */
static void hide_empty(GtkEntry *cell)
{
	for (GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(cell)); child;
	     child = gtk_widget_get_next_sibling(child))
		if (GTK_IS_IMAGE(child))
			gtk_widget_set_visible(child,
				gtk_image_get_storage_type(GTK_IMAGE(child)) !=
				GTK_IMAGE_EMPTY);
}

/* The icon at the end of a cell. */
struct sign {
	char *icon, *tip;
};

static void sign_free(gpointer data)
{
	struct sign *sign = data;

	g_free(sign->icon);
	g_free(sign->tip);
	g_free(sign);
}

void cells_icon(GtkEntry *cell, const char *icon, const char *tip)
{
	gtk_entry_set_icon_from_icon_name(cell, PLACE, icon);
	if (icon)
		gtk_entry_set_icon_tooltip_text(cell, PLACE, tip);
	hide_empty(cell);
}

/* The icon is needed because a colour does not show on an empty text. It replaces the icon
 * that is there, so that no text moves. */
static void show_icon(GtkEntry *cell, const char *why)
{
	struct sign *was = g_object_get_data(G_OBJECT(cell), "sign");

	if (why && !was) {
		was = g_new(struct sign, 1);
		was->icon = g_strdup(gtk_entry_get_icon_name(cell, PLACE));
		was->tip = was->icon ? gtk_entry_get_icon_tooltip_text(cell, PLACE) : NULL;
		g_object_set_data_full(G_OBJECT(cell), "sign", was, sign_free);
	}
	if (why) {
		cells_icon(cell, "dialog-error-symbolic", why);
	} else if (was) {
		cells_icon(cell, was->icon, was->tip);
		g_object_set_data(G_OBJECT(cell), "sign", NULL);
	}
}

void cells_refuse(GtkWidget *cell, char *why)
{
	if (GTK_IS_ENTRY(cell))
		show_icon(GTK_ENTRY(cell), why);
	if (why) {
		gtk_widget_add_css_class(cell, "error");
		tip_set(cell, why);
		gtk_accessible_update_state(GTK_ACCESSIBLE(cell),
			GTK_ACCESSIBLE_STATE_INVALID, GTK_ACCESSIBLE_INVALID_TRUE, -1);
	} else {
		gtk_widget_remove_css_class(cell, "error");
		tip_set(cell, NULL);
		gtk_accessible_reset_state(GTK_ACCESSIBLE(cell),
					   GTK_ACCESSIBLE_STATE_INVALID);
	}
	g_free(why);
}

void cells_refused(GtkWidget *cell, char *why)
{
	cells_refuse(cell, why ? why : g_strdup(_("Refused")));
}

void cells_add(GtkWidget *cell, const char *name, GtkEventController *controller)
{
	gtk_widget_add_controller(cell, controller);
	g_object_set_data(G_OBJECT(cell), name, controller);
}

/* ---- focus ---- */

#define FRAMES_SEEN 3  /* tries until a new row can be scrolled to              */
#define ENTERING "entering" /* data of a table: the callback that still waits */
#define FRAMES_MOST 60 /* that a table may need to make the cell                */

struct wanted {
	int table, index, field;
	int frames;
	bool entered;
};

void cells_stand(GtkWidget *cell, GtkListItem *item, int field)
{
	g_object_set_data(G_OBJECT(cell), "item", item);
	g_object_set_data(G_OBJECT(cell), "field", GINT_TO_POINTER(field));
}

static bool is_wanted(GtkWidget *cell, GtkListItem *item, const struct wanted *wanted)
{
	const LadderPanelRow *row = gtk_list_item_get_item(item);

	return row && row->table == wanted->table && row->index == wanted->index &&
	       gtk_widget_get_mapped(cell) && wanted->field ==
	       GPOINTER_TO_INT(g_object_get_data(G_OBJECT(cell), "field"));
}

void cells_keep_cursor(GtkEntry *cell, int cursor)
{
	g_object_set_data(G_OBJECT(cell), "cursor", GINT_TO_POINTER(cursor + 1));
}

void cells_shown(GtkWidget *cell, const char *text)
{
	g_object_set_data_full(G_OBJECT(cell), "shown", g_strdup(text), g_free);
}

bool cells_is_typed(GtkWidget *cell)
{
	const char *shown = GTK_IS_ENTRY(cell) ? g_object_get_data(G_OBJECT(cell), "shown") : NULL;

	return shown && strcmp(shown, gtk_editable_get_text(GTK_EDITABLE(cell))) != 0;
}

static bool has_focus(GtkWidget *cell)
{
	GtkRoot *root = gtk_widget_get_root(cell);
	GtkWidget *focus = root ? gtk_root_get_focus(root) : NULL;

	return focus && (focus == cell || gtk_widget_is_ancestor(focus, cell));
}

/* An entry selects its text when it gets the focus. When GTK has given it the focus already, somebody may be
 * typing: the next letter would replace what is there. */
static bool grab(GtkWidget *cell)
{
	const int cursor = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(cell), "cursor")) - 1;
	const bool typed = has_focus(cell) && cells_is_typed(cell);
	const bool has = typed || gtk_widget_grab_focus(cell);

	if (!typed && cursor >= 0 && has)
		gtk_editable_set_position(GTK_EDITABLE(cell), cursor);
	g_object_set_data(G_OBJECT(cell), "cursor", NULL);
	return has;
}

static bool enter(GtkWidget *within, const struct wanted *wanted)
{
	GtkListItem *item = g_object_get_data(G_OBJECT(within), "item");

	if (item)
		return is_wanted(within, item, wanted) && grab(within);
	for (GtkWidget *child = gtk_widget_get_first_child(within); child;
	     child = gtk_widget_get_next_sibling(child))
		if (enter(child, wanted))
			return true;
	return false;
}

static void scroll_to_selected(GtkWidget *table)
{
	const guint at = gtk_single_selection_get_selected(GTK_SINGLE_SELECTION(
		gtk_column_view_get_model(GTK_COLUMN_VIEW(table))));

	if (at != GTK_INVALID_LIST_POSITION)
		list_scroll_to(table, at);
}

static gboolean enter_later(GtkWidget *table, GdkFrameClock *clock, gpointer data)
{
	struct wanted *wanted = data;

	(void)clock;
	if (!wanted->entered)
		wanted->entered = enter(table, wanted);
	scroll_to_selected(table);
	wanted->frames++;
	if (wanted->frames < (wanted->entered ? FRAMES_SEEN : FRAMES_MOST))
		return G_SOURCE_CONTINUE;
	g_object_set_data(G_OBJECT(table), ENTERING, NULL);
	return G_SOURCE_REMOVE;
}

void cells_enter(GtkColumnView *table, const LadderPanelRow *row, int field)
{
	const guint before = GPOINTER_TO_UINT(g_object_get_data(G_OBJECT(table), ENTERING));
	struct wanted *wanted = g_new(struct wanted, 1);

	/* An older one would take the focus back from this cell, and what is typed into it. */
	if (before)
		gtk_widget_remove_tick_callback(GTK_WIDGET(table), before);
	*wanted = (struct wanted){ row->table, row->index, field, 0, false };
	wanted->entered = enter(GTK_WIDGET(table), wanted);
	g_object_set_data(G_OBJECT(table), ENTERING, GUINT_TO_POINTER(
		gtk_widget_add_tick_callback(GTK_WIDGET(table), enter_later, wanted, g_free)));
}

LadderPanelRow *cells_focused(GtkColumnView *table, int *field)
{
	GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(table));
	GtkWidget *cell = root ? gtk_root_get_focus(root) : NULL;

	if (!cell || !gtk_widget_is_ancestor(cell, GTK_WIDGET(table)))
		return NULL;
	while (cell != GTK_WIDGET(table) && !g_object_get_data(G_OBJECT(cell), "item"))
		cell = gtk_widget_get_parent(cell);
	if (cell == GTK_WIDGET(table))
		return NULL;
	*field = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(cell), "field"));
	return gtk_list_item_get_item(g_object_get_data(G_OBJECT(cell), "item"));
}

/* ---- pending edits ---- */

struct take {
	bool (*take)(GtkWidget *cell, GtkListItem *item);
	GtkListItem *item;   /* borrowed while the cell is bound              */
};

void cells_on_take(GtkWidget *cell, bool (*take)(GtkWidget *cell, GtkListItem *item),
		   GtkListItem *item)
{
	const struct take how = { take, item };

	g_object_set_data_full(G_OBJECT(cell), "take",
			       take ? g_memdup2(&how, sizeof(how)) : NULL, g_free);
}

bool cells_take(GtkWindow *window)
{
	GtkWidget *focus;

	left_now(); /* it may free the widget that has the focus now */
	focus = gtk_window_get_focus(window);
	for (; focus; focus = gtk_widget_get_parent(focus)) {
		const struct take *how = g_object_get_data(G_OBJECT(focus), "take");

		if (how)
			return how->take(focus, how->item);
	}
	return true;
}
