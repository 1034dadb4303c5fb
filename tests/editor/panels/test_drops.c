/* SPDX-License-Identifier: MIT
 *
 * test_drops - a row that is dropped on the tree, the data types or the tasks moves only if
 * it is a row of that list, not of the list of another window.
 */
#include "editor-gtk/kit/panel_row.h"
#include "editor-gtk/panels/project_tree.h"
#include "editor-gtk/panels/tasks_view.h"
#include "editor-gtk/panels/tree_rows.h"
#include "editor-gtk/panels/types_view.h"
#include "tests/editor/screen.h"
#include "tests/tap.h"

#include <adwaita.h>

static const char sample[] =
	"RUNGBOARD 1\n\nTYPE\n  Pair : STRUCT\n    First : INT;\n    Second : INT;\n  END_STRUCT;\n"
	"END_TYPE\n\nPROGRAM One LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n\n"
	"PROGRAM Two LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n\n"
	"CONFIGURATION Plant\n  TASK Fast (INTERVAL := T#5ms, PRIORITY := 1);\n"
	"  PROGRAM A WITH Fast : One;\n  PROGRAM B WITH Fast : Two;\nEND_CONFIGURATION\n";

struct side {
	LadderDocument *document;
	GtkWidget *window, *panel, *list;
};

static GtkWidget *find(GtkWidget *from, GType type, const char *text)
{
	GtkWidget *found = NULL;
	const char *own = GTK_IS_LABEL(from) ? gtk_label_get_text(GTK_LABEL(from)) :
		GTK_IS_EDITABLE(from) ? gtk_editable_get_text(GTK_EDITABLE(from)) : "";

	if (g_type_is_a(G_OBJECT_TYPE(from), type) && (!text || strcmp(own, text) == 0))
		return from;
	for (GtkWidget *child = gtk_widget_get_first_child(from); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = find(child, type, text);
	return found;
}

/* The list of this type in which a row has the text. */
static GtkWidget *list_with(GtkWidget *from, GType type, const char *text)
{
	GtkWidget *found = NULL;

	if (g_type_is_a(G_OBJECT_TYPE(from), type))
		return find(from, GTK_TYPE_LABEL, text) || find(from, GTK_TYPE_ENTRY, text) ?
		       from : NULL;
	for (GtkWidget *child = gtk_widget_get_first_child(from); child && !found;
	     child = gtk_widget_get_next_sibling(child))
		found = list_with(child, type, text);
	return found;
}

static void side_open(struct side *side, GtkWidget *(*new)(LadderDocument *), GType list,
		      const char *last)
{
	side->document = ladder_document_new();
	ladder_document_open_text(side->document, NULL, sample, strlen(sample), true);
	side->panel = new(side->document);
	side->window = gtk_window_new();
	gtk_window_set_default_size(GTK_WINDOW(side->window), 900, 600);
	gtk_window_set_child(GTK_WINDOW(side->window), side->panel);
	screen_show(side->window);
	WAIT((side->list = list_with(side->panel, list, last)));
}

static void side_close(struct side *side)
{
	gtk_window_destroy(GTK_WINDOW(side->window));
	g_object_unref(side->document);
}

/* The row with this text, a reference. */
static GObject *row_with(struct side *side, const char *text)
{
	GListModel *rows = G_LIST_MODEL(GTK_IS_LIST_VIEW(side->list) ?
		gtk_list_view_get_model(GTK_LIST_VIEW(side->list)) :
		gtk_column_view_get_model(GTK_COLUMN_VIEW(side->list)));

	for (guint i = 0; i < g_list_model_get_n_items(rows); i++) {
		GObject *row = g_list_model_get_item(rows, i);
		const char *own;

		if (GTK_IS_TREE_LIST_ROW(row)) {
			GObject *inside = gtk_tree_list_row_get_item(GTK_TREE_LIST_ROW(row));

			g_object_unref(row);
			row = inside;
		}
		own = LADDER_IS_TREE_ROW(row) ? LADDER_TREE_ROW(row)->text :
		      panel_row_text(LADDER_PANEL_ROW(row), 0);
		if (strcmp(own, text) == 0)
			return row;
		g_object_unref(row);
	}
	return NULL;
}

/* Drops a row on the lower half of the row that shows @text. True: the text changed. */
static bool drop(struct side *side, GObject *row, const char *text)
{
	GtkWidget *at = find(side->list, GTK_TYPE_LABEL, text);
	GListModel *all = gtk_widget_observe_controllers(side->list);
	char *before = ladder_document_text(side->document, NULL), *after;
	GValue value = G_VALUE_INIT;
	graphene_rect_t box;
	gboolean taken;
	bool changed;

	at = at ? at : find(side->list, GTK_TYPE_ENTRY, text);
	if (!at || !row || !gtk_widget_compute_bounds(at, side->list, &box)) {
		CHECK_AS(false, "both rows are there");
		return false;
	}
	g_value_init(&value, G_OBJECT_TYPE(row));
	g_value_set_object(&value, row);
	for (guint i = 0; i < g_list_model_get_n_items(all); i++) {
		GObject *each = g_list_model_get_item(all, i);

		if (GTK_IS_DROP_TARGET(each))
			g_signal_emit_by_name(each, "drop", &value,
				(double)(box.origin.x + box.size.width / 2),
				(double)(box.origin.y + box.size.height - 2), &taken);
		g_object_unref(each);
	}
	g_value_unset(&value);
	g_object_unref(all);
	after = ladder_document_text(side->document, NULL);
	changed = strcmp(before, after) != 0;
	g_free(after);
	g_free(before);
	return changed;
}

/* Something in @from gives what a drag that begins at @x, @y of the list carries. */
static bool carries(GtkWidget *from, double x, double y)
{
	GListModel *all = gtk_widget_observe_controllers(from);
	bool carried = false;

	for (guint i = 0; i < g_list_model_get_n_items(all); i++) {
		GObject *each = g_list_model_get_item(all, i);
		GdkContentProvider *what = NULL;

		if (GTK_IS_DRAG_SOURCE(each))
			g_signal_emit_by_name(each, "prepare", x, y, &what);
		carried |= what != NULL;
		g_clear_object(&what);
		g_object_unref(each);
	}
	g_object_unref(all);
	for (GtkWidget *child = gtk_widget_get_first_child(from); child && !carried;
	     child = gtk_widget_get_next_sibling(child))
		carried = carries(child, x, y);
	return carried;
}

/* A list is dragged at the row with @text, a table at a handle. */
static bool can_drag(struct side *side, const char *text)
{
	GtkWidget *at = find(side->list, GTK_TYPE_LABEL, text);
	graphene_rect_t box;

	at = at ? at : find(side->list, GTK_TYPE_ENTRY, text);
	return at && gtk_widget_compute_bounds(at, side->list, &box) &&
	       carries(side->list, box.origin.x + 2, box.origin.y + box.size.height / 2);
}

/* Drops @moved of another window, then of this one, on @at. */
static void test_list(GtkWidget *(*new)(LadderDocument *), GType list, const char *moved,
		      const char *at)
{
	struct side here, there;
	GObject *foreign, *own;

	side_open(&there, new, list, at);
	side_open(&here, new, list, at);
	CHECK_AS(can_drag(&here, moved), "a row can be dragged");
	foreign = row_with(&there, moved);
	own = row_with(&here, moved);
	CHECK_AS(!drop(&here, foreign, at), "a row of another window moves nothing");
	CHECK_AS(drop(&here, own, at), "a row of this list moves");
	g_clear_object(&foreign);
	g_clear_object(&own);
	side_close(&here);
	side_close(&there);
}

int main(void)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	adw_init();
	test_list(ladder_project_tree_new, GTK_TYPE_LIST_VIEW, "One", "Two");
	test_list(ladder_types_view_new, GTK_TYPE_COLUMN_VIEW, "First", "Second");
	test_list(ladder_tasks_view_new, GTK_TYPE_COLUMN_VIEW, "A", "B");
	return tap_done();
}
