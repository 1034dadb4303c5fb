/* SPDX-License-Identifier: MIT
 *
 * test_cell_entry - a text that is too long for its cell ends with an ellipsis, but not
 * while it is edited.
 */
#include "editor-gtk/kit/cell_entry.h"
#include "tests/editor/screen.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

static GtkWidget *window, *cell, *other;

static void set_up(void)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);

	window = gtk_window_new();
	cell = cell_entry_new();
	other = gtk_button_new();
	gtk_editable_set_width_chars(GTK_EDITABLE(cell), 10);
	gtk_editable_set_max_width_chars(GTK_EDITABLE(cell), 10);
	gtk_box_append(GTK_BOX(box), cell);
	gtk_box_append(GTK_BOX(box), other);
	gtk_window_set_child(GTK_WINDOW(window), box);
	screen_show(window);
	CHECK_SOON(gtk_widget_get_width(cell) > 0);
	gtk_widget_grab_focus(other);
}

static bool is_cut(void)
{
	return cell_entry_is_cut(LADDER_CELL_ENTRY(cell));
}

/* Counts the nodes that draw text. */
static int texts_in(GskRenderNode *node)
{
	int count = 0;

	switch ((int)gsk_render_node_get_node_type(node)) {
	case GSK_TEXT_NODE:
		return 1;
	case GSK_CONTAINER_NODE:
		for (guint i = 0; i < gsk_container_node_get_n_children(node); i++)
			count += texts_in(gsk_container_node_get_child(node, i));
		return count;
	case GSK_CLIP_NODE:
		return texts_in(gsk_clip_node_get_child(node));
	case GSK_TRANSFORM_NODE:
		return texts_in(gsk_transform_node_get_child(node));
	default:
		return 0;
	}
}

/* Of the cell as it is now. */
static int texts_drawn(void)
{
	GdkPaintable *paintable = gtk_widget_paintable_new(cell);
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GskRenderNode *node;
	int count;

	gdk_paintable_snapshot(paintable, snapshot, gtk_widget_get_width(cell),
			       gtk_widget_get_height(cell));
	node = gtk_snapshot_free_to_node(snapshot);
	count = node ? texts_in(node) : 0;
	g_clear_pointer(&node, gsk_render_node_unref);
	g_object_unref(paintable);
	return count;
}

static void test_cut(void)
{
	gtk_editable_set_text(GTK_EDITABLE(cell), "BOOL");
	CHECK(!is_cut());
	CHECK_SOON(texts_drawn() == 1);
	gtk_editable_set_text(GTK_EDITABLE(cell), "ARRAY[0..99] OF DINT");
	CHECK(is_cut());
	CHECK_SOON(texts_drawn() == 2); /* with the ellipsis */
	gtk_widget_grab_focus(cell);
	gtk_editable_select_region(GTK_EDITABLE(cell), 0, 0);
	CHECK(!is_cut());
	CHECK_SOON(texts_drawn() == 1);
	gtk_widget_grab_focus(other);
	CHECK(is_cut());
	gtk_editable_set_text(GTK_EDITABLE(cell), "");
	CHECK(!is_cut());
}

static void test_chinese(void)
{
	gtk_editable_set_text(GTK_EDITABLE(cell), "\xe5\x90\xaf\xe5\x8a\xa8");
	CHECK(!is_cut());
	gtk_editable_set_text(GTK_EDITABLE(cell), "\xe5\x90\xaf\xe5\x8a\xa8\xe6\x8c\x89\xe9\x92\xae"
			      "\xe4\xb8\xbb\xe7\x94\xb5\xe6\x9c\xba\xe4\xb8\xbb\xe7\x94\xb5"
			      "\xe6\x9c\xba");
	CHECK(is_cut());
	CHECK_SOON(texts_drawn() == 2);
}

int main(void)
{
	if (!screen_start() || !gtk_init_check()) {
		printf("1..0 # SKIP needs Xvfb\n");
		return 0;
	}
	set_up();
	test_cut();
	test_chinese();
	gtk_window_destroy(GTK_WINDOW(window));
	return tap_done();
}
