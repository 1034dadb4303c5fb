/* SPDX-License-Identifier: MIT
 *
 * test_canvas - zoom, scrolling, accessible children and the entry: the same checks for
 * sheets of rungs and of charts.
 */
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "tests/editor/sheet_window.h"
#include "tests/editor/soon.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

static const char sample[] =
	"RUNGBOARD 1\n\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n\n"
	"PROGRAM Way SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n";

static GtkWidget *window;
static int zoomed, moved;
static bool had_place;

static void count_zoom(LadderCanvas *canvas)
{
	(void)canvas;
	zoomed++;
}

/* As the window does when the cursor or the focus moves. */
static void ask_place(LadderCanvas *canvas)
{
	char *place = ladder_canvas_place(canvas);

	moved++;
	had_place = had_place && place[0];
	g_free(place);
}

static GtkWidget *child_of(LadderCanvas *canvas, bool popover)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(canvas));

	while (child && (popover ? !GTK_IS_POPOVER(child) || !gtk_widget_get_mapped(child) :
			 GTK_IS_POPOVER(child)))
		child = gtk_widget_get_next_sibling(child);
	return child;
}

static void test_zoom(LadderCanvas *canvas, double least)
{
	GtkAdjustment *down = gtk_scrollable_get_vadjustment(GTK_SCROLLABLE(canvas));

	zoomed = 0;
	ladder_canvas_set_zoom(canvas, 10);
	CHECK(ladder_canvas_zoom(canvas) == 3 && zoomed == 1);
	CHECK_SOON(gtk_adjustment_get_upper(down) > gtk_adjustment_get_page_size(down));
	ladder_canvas_set_zoom(canvas, 0.01);
	CHECK(ladder_canvas_zoom(canvas) == least && zoomed == 2);
	CHECK_SOON(gtk_adjustment_get_upper(down) == gtk_adjustment_get_page_size(down));
	ladder_canvas_set_zoom(canvas, 1);
	ladder_canvas_set_zoom(canvas, 1);
	CHECK(zoomed == 3);
}

/* The scale of two fingers counts from when they came, however often it is told. */
static void test_pinch(LadderCanvas *canvas)
{
	GListModel *all = gtk_widget_observe_controllers(GTK_WIDGET(canvas));
	bool pinches = false;

	ladder_canvas_set_zoom(canvas, 1);
	for (guint i = 0; i < g_list_model_get_n_items(all); i++) {
		GObject *one = g_list_model_get_item(all, i);

		if (GTK_IS_GESTURE_ZOOM(one)) {
			pinches = true;
			for (int step = 1; step <= 10; step++)
				g_signal_emit_by_name(one, "scale-changed", 1 + 0.1 * step);
			CHECK(fabs(ladder_canvas_zoom(canvas) - 2) < 0.11);
		}
		g_object_unref(one);
	}
	CHECK(pinches);
	g_object_unref(all);
	ladder_canvas_set_zoom(canvas, 1);
}

/* The program is exchanged while the entry is open. */
static void test_change(LadderCanvas *canvas, LadderDocument *document, enum verb verb)
{
	const char *added = "\nPROGRAM More LD\nRUNG\nEND_PROGRAM\n";

	CHECK_SOON(child_of(canvas, false) != NULL);
	ladder_canvas_do(canvas, verb);
	CHECK_SOON(child_of(canvas, true) != NULL);
	moved = 0;
	had_place = true;
	CHECK(ladder_document_replace(document, strlen(sample), 0, added, NULL));
	CHECK_SOON(child_of(canvas, true) == NULL);
	CHECK(moved > 0 && had_place);
	CHECK(ladder_document_replace(document, strlen(sample), strlen(added), "", NULL));
}

/* The key of an action in a menu or its sections and submenus; NULL: none. Caller frees. */
static char *key_in(GMenuModel *menu, const char *action)
{
	char *found = NULL;

	for (int i = 0; i < g_menu_model_get_n_items(menu) && !found; i++) {
		GMenuModel *section = g_menu_model_get_item_link(menu, i, G_MENU_LINK_SECTION);
		GMenuModel *submenu = g_menu_model_get_item_link(menu, i, G_MENU_LINK_SUBMENU);
		char *name = NULL;

		if (g_menu_model_get_item_attribute(menu, i, "action", "s", &name) &&
		    strcmp(name, action) == 0)
			g_menu_model_get_item_attribute(menu, i, "accel", "s", &found);
		if (section && !found)
			found = key_in(section, action);
		if (submenu && !found)
			found = key_in(submenu, action);
		g_free(name);
		g_clear_object(&section);
		g_clear_object(&submenu);
	}
	return found;
}

/* The context menu shows the key of a verb that has several. */
static void test_menu(LadderCanvas *canvas)
{
	GMenu *menu = G_MENU(LADDER_CANVAS_GET_CLASS(canvas)->menu(canvas));
	char *key = key_in(G_MENU_MODEL(menu), verb_row(VERB_delete)->action);

	CHECK_TEXT(key ? key : "", "Delete");
	g_free(key);
	g_object_unref(menu);
}

static void test_sheet(LadderDocument *document, GtkWidget *sheet, double least, enum verb verb)
{
	GtkWidget *scroller = gtk_scrolled_window_new();
	LadderCanvas *canvas = LADDER_CANVAS(sheet);

	g_signal_connect(canvas, "zoom-changed", G_CALLBACK(count_zoom), NULL);
	g_signal_connect(canvas, "cursor-moved", G_CALLBACK(ask_place), NULL);
	g_signal_connect(canvas, "notify::has-focus", G_CALLBACK(ask_place), NULL);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), sheet);
	gtk_window_set_child(GTK_WINDOW(window), scroller);
	WAIT(gtk_widget_get_width(sheet) > 0 && gtk_widget_grab_focus(sheet));
	CHECK(pango_context_get_base_dir(gtk_widget_get_pango_context(sheet)) == PANGO_DIRECTION_LTR);
	test_zoom(canvas, least);
	test_pinch(canvas);
	test_menu(canvas);
	test_change(canvas, document, verb);
}

static GBytes *look(GtkWidget *page)
{
	GtkSnapshot *snapshot = gtk_snapshot_new();
	GskRenderNode *node;
	GBytes *bytes;

	GTK_WIDGET_GET_CLASS(page)->snapshot(page, snapshot);
	node = gtk_snapshot_free_to_node(snapshot);
	bytes = gsk_render_node_serialize(node);
	gsk_render_node_unref(node);
	return bytes;
}

/* Moves over the page until it would take the tool. */
static bool drag_over(GtkDropTarget *target, GtkWidget *page)
{
	GdkDragAction action = 0;

	for (int y = 0; y < gtk_widget_get_height(page) && !action; y += 8)
		for (int x = 0; x < gtk_widget_get_width(page) && !action; x += 8)
			g_signal_emit_by_name(target, "motion", (double)x, (double)y, &action);
	return action;
}

/* A tool is dragged over a chart and away: the mark of its place goes. */
static void test_drag(LadderDocument *document)
{
	GtkWidget *page = ladder_sfc_view_new(document, 1);
	GListModel *all = gtk_widget_observe_controllers(page);
	GtkDropTarget *target = NULL;
	GBytes *before, *over, *after;

	gtk_window_set_child(GTK_WINDOW(window), page);
	WAIT(gtk_widget_get_width(page) > 0 && gtk_widget_grab_focus(page));
	for (guint i = 0; i < g_list_model_get_n_items(all) && !target; i++) {
		gpointer each = g_list_model_get_item(all, i);

		target = GTK_IS_DROP_TARGET(each) ? each : NULL;
		g_object_unref(each);
	}
	before = look(page);
	CHECK(target && drag_over(target, page));
	over = look(page);
	g_signal_emit_by_name(target, "leave");
	after = look(page);
	CHECK_AS(!g_bytes_equal(before, over), "the place of a dragged tool is marked");
	CHECK_AS(g_bytes_equal(before, after), "no mark is left of a tool that was dragged away");
	g_bytes_unref(before);
	g_bytes_unref(over);
	g_bytes_unref(after);
	g_object_unref(all);
}

static GBytes *look_at(GtkWidget *page)
{
	gtk_window_set_child(GTK_WINDOW(window), page);
	WAIT(gtk_widget_get_width(page) > 0 && gtk_widget_grab_focus(page));
	return look(page);
}

/* A mistake is marked in the sheet that shows it, as in one that is opened later. */
static void test_marks(LadderDocument *document)
{
	const gsize at = (gsize)(strstr(sample, "%QX0.0") - sample);
	GtkWidget *page = ladder_grid_view_new(document, 0);
	GBytes *before = look_at(page), *now, *later;

	CHECK(ladder_document_replace(document, at, 6, "Wrong_", NULL));
	CHECK_SOON(ladder_document_diags(document)->errors > 0);
	now = look(page);
	later = look_at(ladder_grid_view_new(document, 0));
	CHECK_AS(!g_bytes_equal(before, now), "another name is shown");
	CHECK_AS(g_bytes_equal(now, later), "a mistake is marked at once");
	CHECK(ladder_document_replace(document, at, 6, "%QX0.0", NULL));
	g_bytes_unref(before);
	g_bytes_unref(now);
	g_bytes_unref(later);
}

/* Marks the hits of a search in a sheet of any kind. */
static void mark(GtkWidget *page, const struct find_seen *seen)
{
	if (LADDER_IS_SFC_VIEW(page))
		ladder_sfc_view_set_found(LADDER_SFC_VIEW(page), seen);
	else
		ladder_grid_view_set_found(LADDER_GRID_VIEW(page), seen);
}

/* What a search has found is marked, the current hit otherwise, and nothing when the search ends. */
static void test_found_on(LadderDocument *document, GtkWidget *page, const char *wanted)
{
	struct find *find = find_new(document, wanted, (struct find_options){ FIND_EVERYWHERE, false, false });
	struct find_seen all = { find, -1, true }, one = { find, 0, false }, none = { NULL, -1, true };
	GBytes *before = look_at(page), *found, *now, *after;

	while (one.current < (int)find->hit->len &&
	       ((const struct find_hit *)find->hit->pdata[one.current])->pou != ladder_canvas_pou(LADDER_CANVAS(page)))
		one.current++;
	CHECK_AS(one.current < (int)find->hit->len, "there is a hit on this sheet");
	mark(page, &all);
	found = look(page);
	mark(page, &one);
	now = look(page);
	mark(page, &none);
	after = look(page);
	CHECK_AS(!g_bytes_equal(before, found), "hits are marked");
	CHECK_AS(!g_bytes_equal(before, now) && !g_bytes_equal(found, now), "the current one in another way");
	CHECK_AS(g_bytes_equal(before, after), "and nothing when the search ends");
	g_bytes_unref(before);
	g_bytes_unref(found);
	g_bytes_unref(now);
	g_bytes_unref(after);
	find_free(find);
}

static int cell_count(GtkWidget *page)
{
	int count = 0;

	for (GtkWidget *child = gtk_widget_get_first_child(page); child;
	     child = gtk_widget_get_next_sibling(child))
		count += !GTK_IS_POPOVER(child);
	return count;
}

/* A screen reader finds the elements that the window shows, also after the window has grown. */
static void test_grows(void)
{
	GString *text = g_string_new("RUNGBOARD 1\n\nPROGRAM Main LD\n");
	LadderDocument *document = ladder_document_new();
	GtkWidget *page;
	int few;

	for (int i = 0; i < 40; i++)
		g_string_append(text, "RUNG\n  | NO %IX0.0 | COIL %QX0.0 |\n");
	g_string_append(text, "END_PROGRAM\n");
	ladder_document_open_text(document, NULL, text->str, text->len, true);
	page = ladder_grid_view_new(document, 0);
	gtk_window_set_child(GTK_WINDOW(window), page);
	CHECK_SOON(gtk_widget_get_height(page) > 0 && cell_count(page) > 0);
	few = cell_count(page);
	CHECK(few < 40);
	gtk_window_set_default_size(GTK_WINDOW(window), 500, 700);
	CHECK_SOON(gtk_widget_get_height(page) > 600);
	CHECK_SOON(cell_count(page) > 2 * few);
	gtk_window_set_child(GTK_WINDOW(window), NULL);
	g_object_unref(document);
	g_string_free(text, TRUE);
}

int main(void)
{
	LadderDocument *document = sheet_window(sample, 500, 200, &window);

	if (!document)
		return 0;
	/* as in Arabic or Hebrew */
	gtk_widget_set_default_direction(GTK_TEXT_DIR_RTL);
	test_sheet(document, ladder_grid_view_new(document, 0), 0.5, VERB_comment);
	test_sheet(document, ladder_sfc_view_new(document, 1), 0.3, VERB_chart_comment);
	test_drag(document);
	test_marks(document);
	test_found_on(document, ladder_sfc_view_new(document, 1), "Start");
	test_found_on(document, ladder_grid_view_new(document, 0), "%QX");
	test_grows();
	gtk_window_destroy(GTK_WINDOW(window));
	turn(0);
	g_object_unref(document);
	return tap_done();
}
