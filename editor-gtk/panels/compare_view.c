/* SPDX-License-Identifier: MIT
 *
 * compare_view - see compare_view.h.
 */
#include "editor-gtk/panels/compare_view.h"

#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/gtk48/list.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/picture_view.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/panels/compare_sides.h"

#include <adwaita.h>
#include <string.h>

#define BESIDE 620 /* px of both drawings; with less they are one below the other */

/* Texts of a LadderPanelRow; row->flags is its number, row->number whether a group begins. */
enum { ROW_GROUP, ROW_TITLE, ROW_WORDS, ROW_SIGN };

struct _LadderCompareView {
	GtkWidget parent_instance;
	GtkWidget *box, *title, *count, *stack, *nothing, *unreadable, *paned, *sides;
	GtkWidget *list, *name_a, *name_b, *place_a, *place_b;
	GtkWidget *picture[2];          /* of the older and the newer version   */
	float at[2];                    /* y of the place in each              */
	GListStore *store;
	GtkSingleSelection *selection;
	struct panel_watch *watch;
	LadderDocument *document;
	struct compare_side older;      /* text NULL: read from its file        */
	struct compare_side newer;      /* name NULL: the document             */
	GPtrArray *monitors;            /* of the files that are compared       */
	struct comparison *of;
	guint scrolling, turning;       /* sources                              */
	bool filling;
};

G_DEFINE_FINAL_TYPE(LadderCompareView, ladder_compare_view, GTK_TYPE_WIDGET)

static const struct compare_row *row_now(LadderCompareView *view)
{
	const LadderPanelRow *row = view->selection ?
		gtk_single_selection_get_selected_item(view->selection) : NULL;

	return row && view->of && row->flags < view->of->rows->len ?
	       view->of->rows->pdata[row->flags] : NULL;
}

/* ---- the drawings ---- */

static void draw(LadderCompareView *view, bool newer, struct picture *picture,
		 struct lettering *lettering)
{
	const struct compare_row *row = row_now(view);

	view->at[newer] = row ? compare_side_draw(view->of, row, newer,
		(enum drafting_show)settings_enum("show", SHOW_BOTH), picture, lettering) : 0;
}

static void draw_older(gpointer view, struct picture *picture, struct lettering *lettering)
{
	draw(view, false, picture, lettering);
}

static void draw_newer(gpointer view, struct picture *picture, struct lettering *lettering)
{
	draw(view, true, picture, lettering);
}

static LadderPictureView *picture_of(LadderCompareView *view, bool newer)
{
	return LADDER_PICTURE_VIEW(view->picture[newer]);
}

static GtkAdjustment *adjustment_of(LadderCompareView *view, bool newer)
{
	return gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(newer ? view->place_b :
									view->place_a));
}

/* After the layout of the new pictures. */
static gboolean scroll_now(gpointer data)
{
	LadderCompareView *view = data;

	view->scrolling = 0;
	for (int i = 0; i < 2; i++)
		gtk_adjustment_set_value(adjustment_of(view, i), (double)(view->at[i] *
			ladder_picture_view_scale(picture_of(view, i))));
	return G_SOURCE_REMOVE;
}

/* Both get the size of the larger one, so that they scroll together. */
static void show_pictures(LadderCompareView *view)
{
	const struct compare_row *row = row_now(view);
	float width[2], height[2];
	char *text = row ? g_strdup_printf("%s. %s", row->title, row->words) : g_strdup("");

	for (int i = 0; i < 2; i++) {
		ladder_picture_view_again(picture_of(view, i));
		ladder_picture_view_size(picture_of(view, i), &width[i], &height[i]);
		spoken_name(view->picture[i], text);
	}
	for (int i = 0; i < 2; i++)
		ladder_picture_view_grow(picture_of(view, i), MAX(width[0], width[1]),
					 MAX(height[0], height[1]));
	g_clear_handle_id(&view->scrolling, g_source_remove);
	view->scrolling = g_idle_add(scroll_now, view);
	g_free(text);
}

static void show_row(LadderCompareView *view)
{
	const guint at = gtk_single_selection_get_selected(view->selection);
	const guint all = g_list_model_get_n_items(G_LIST_MODEL(view->store));
	const struct compare_row *row = row_now(view);
	char *count = row ? g_strdup_printf(_("%u of %u"), at + 1, all) : g_strdup("");
	int place[4];

	if (view->filling)
		return;
	gtk_label_set_text(GTK_LABEL(view->count), count);
	gtk_widget_action_set_enabled(GTK_WIDGET(view), "compare.go", row &&
		(view->newer.name || row->map ||
		 compare_row_place(row, ladder_project(view->of->of_b), place)));
	gtk_widget_action_set_enabled(GTK_WIDGET(view), "compare.previous", row && at > 0);
	gtk_widget_action_set_enabled(GTK_WIDGET(view), "compare.next", row && at + 1 < all);
	show_pictures(view);
	g_free(count);
}

/* ---- the list ---- */

static const char *sign_of(enum compare_change change)
{
	static const char *const sign[] = {
		[COMPARE_CHANGED] = "\xe2\x89\xa0", [COMPARE_ADDED] = "+",
		[COMPARE_REMOVED] = "\xe2\x88\x92", [COMPARE_MOVED] = "\xe2\x86\x95",
	};

	return sign[change];
}

static LadderPanelRow *list_row(const struct compare_row *of, guint index, bool begins)
{
	LadderPanelRow *row = ladder_panel_row_new();
	const char *words = *of->words ? of->words : compare_change_text(of->change);

	row->text[ROW_GROUP] = g_strdup(of->group);
	row->text[ROW_TITLE] = g_strdup(of->title);
	row->text[ROW_WORDS] = g_strdup(words);
	row->text[ROW_SIGN] = g_strdup(sign_of(of->change));
	row->flags = index;
	row->number = begins;
	row->spoken = g_strdup_printf("%s, %s, %s: %s", of->group, of->title,
				      compare_change_text(of->change), words);
	return row;
}

static GtkWidget *label_new(GtkWidget *box, const char *class)
{
	GtkWidget *label = gtk_label_new(NULL);

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_widget_add_css_class(label, class);
	gtk_box_append(GTK_BOX(box), label);
	return label;
}

#define ITEM "compare-item" /* of the content of a row: its GtkListItem, borrowed */

static void setup(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
	GtkWidget *texts = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0), *words;

	(void)factory;
	label_new(box, "panel-heading");
	gtk_widget_add_css_class(line, "difference");
	gtk_box_append(GTK_BOX(box), line);
	gtk_widget_set_valign(label_new(line, "sign"), GTK_ALIGN_START);
	gtk_box_append(GTK_BOX(line), texts);
	gtk_label_set_ellipsize(GTK_LABEL(label_new(texts, "title")), PANGO_ELLIPSIZE_END);
	words = label_new(texts, "dim-label");
	gtk_label_set_wrap(GTK_LABEL(words), TRUE);
	gtk_label_set_wrap_mode(GTK_LABEL(words), PANGO_WRAP_WORD_CHAR);
	gtk_label_set_lines(GTK_LABEL(words), 4);
	gtk_label_set_ellipsize(GTK_LABEL(words), PANGO_ELLIPSIZE_END);
	gtk_label_set_width_chars(GTK_LABEL(words), 10);
	g_object_set_data(G_OBJECT(box), ITEM, item);
	gtk_list_item_set_child(item, box);
}

static void bind(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	static const char *const kinds[] = { "\xe2\x89\xa0", "+", "\xe2\x88\x92",
					     "\xe2\x86\x95" };
	static const char *const classes[] = { "changed", "added", "removed", "changed" };
	const LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *group = gtk_widget_get_first_child(gtk_list_item_get_child(item));
	GtkWidget *sign = gtk_widget_get_first_child(gtk_widget_get_next_sibling(group));
	GtkWidget *title = gtk_widget_get_first_child(gtk_widget_get_next_sibling(sign));
	GtkWidget *words = gtk_widget_get_next_sibling(title);

	(void)factory;
	gtk_label_set_text(GTK_LABEL(group), panel_row_text(row, ROW_GROUP));
	gtk_widget_set_visible(group, row->number != 0);
	gtk_label_set_text(GTK_LABEL(sign), panel_row_text(row, ROW_SIGN));
	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
		gtk_widget_remove_css_class(sign, classes[i]);
	for (gsize i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (strcmp(kinds[i], panel_row_text(row, ROW_SIGN)) == 0)
			gtk_widget_add_css_class(sign, classes[i]);
	gtk_label_set_text(GTK_LABEL(title), panel_row_text(row, ROW_TITLE));
	gtk_label_set_text(GTK_LABEL(words), panel_row_text(row, ROW_WORDS));
	tip_set(words, panel_row_text(row, ROW_WORDS));
	panel_speak(group, row);
	gtk_accessible_update_property(GTK_ACCESSIBLE(gtk_widget_get_parent(
		gtk_list_item_get_child(item))), GTK_ACCESSIBLE_PROPERTY_LABEL, row->spoken, -1);
}

/* ---- the two sides ---- */

static char *name_of(LadderDocument *document)
{
	const char *path = ladder_document_path(document);
	char *base = path ? g_path_get_basename(path) : g_strdup(_("not saved yet"));
	char *name = g_strdup_printf(_("%s, as it is now"), base);

	g_free(base);
	return name;
}

/* The text of the I/O map if it is open, saved or not; NULL: it is not. Caller frees. */
static char *open_map(LadderDocument *document)
{
	char *path = iomap_beside(ladder_document_path(document));
	LadderSideFile *file = path ? side_file_find(document, path) : NULL;
	char *text = file ? ladder_side_file_text(file) : NULL;

	g_free(path);
	return text;
}

static struct compare_side document_side(LadderCompareView *view)
{
	struct compare_side side = { name_of(view->document),
		g_strdup(ladder_document_path(view->document)), NULL, 0, NULL,
		open_map(view->document) };

	side.text = ladder_document_text(view->document, &side.len);
	return side;
}

static struct comparison *compare(LadderCompareView *view)
{
	struct compare_side a = compare_side_copy(&view->older);
	struct compare_side b = view->newer.name ? compare_side_copy(&view->newer) :
				document_side(view);

	return comparison_new(&a, &b);
}

/* Why there is nothing to compare. Caller frees. */
static char *unreadable(const struct comparison *of)
{
	GString *text = g_string_new(NULL);
	const struct compare_side *side[2] = { &of->a, &of->b };
	struct ladder *ladder[2] = { of->of_a, of->of_b };
	const bool read[2] = { of->read_a, of->read_b };

	for (int i = 0; i < 2; i++) {
		char *why = read[i] ? NULL : comparison_diags(ladder[i]);

		if (why)
			g_string_append_printf(text, _("“%s” cannot be read:"), side[i]->name);
		if (why)
			g_string_append_printf(text, "\n%s\n\n", why);
		g_free(why);
	}
	return g_string_free(text, FALSE);
}

static void fill(LadderCompareView *view)
{
	const guint was = gtk_single_selection_get_selected(view->selection);
	GPtrArray *rows = view->of->rows;
	const char *group = NULL;

	view->filling = true;
	g_list_store_remove_all(view->store);
	for (guint i = 0; i < rows->len; i++) {
		const struct compare_row *of = rows->pdata[i];
		LadderPanelRow *row = list_row(of, i, g_strcmp0(of->group, group) != 0);

		group = of->group;
		g_list_store_append(view->store, row);
		g_object_unref(row);
	}
	if (rows->len)
		gtk_single_selection_set_selected(view->selection,
			was == GTK_INVALID_LIST_POSITION ? 0 : MIN(was, rows->len - 1));
	view->filling = false;
	list_mend_focus(view->list);
}

static void show_state(LadderCompareView *view)
{
	const struct comparison *of = view->of;
	char *title = g_strdup_printf(_("Changes from “%s” to “%s”"), of->a.name, of->b.name);
	char *why = unreadable(of);
	char *equal = g_markup_printf_escaped(_("“%s” and “%s” do not differ."), of->a.name,
					      of->b.name);

	gtk_label_set_text(GTK_LABEL(view->title), title);
	tip_set(view->title, title);
	gtk_label_set_text(GTK_LABEL(view->name_a), of->a.name);
	gtk_label_set_text(GTK_LABEL(view->name_b), of->b.name);
	gtk_label_set_text(GTK_LABEL(view->unreadable), why);
	adw_status_page_set_description(ADW_STATUS_PAGE(view->nothing), equal);
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), *why ? "unreadable" :
					 of->rows->len ? "list" : "nothing");
	g_free(equal);
	g_free(why);
	g_free(title);
}

static void refresh(GtkWidget *widget)
{
	LadderCompareView *view = LADDER_COMPARE_VIEW(widget);

	if (!view->older.name)
		return;
	g_clear_pointer(&view->of, comparison_free);
	view->of = compare(view);
	fill(view);
	show_state(view);
	show_row(view);
}

/* ---- files that change ---- */

static void written(LadderCompareView *view)
{
	panel_watch_later(view->watch);
}

static void watch_file(LadderCompareView *view, const char *path)
{
	GFile *file = path ? g_file_new_for_path(path) : NULL;
	GFileMonitor *monitor = file ? g_file_monitor_file(file, G_FILE_MONITOR_NONE, NULL, NULL) :
				NULL;

	if (monitor) {
		g_signal_connect_object(monitor, "changed", G_CALLBACK(written), view,
					G_CONNECT_SWAPPED);
		g_ptr_array_add(view->monitors, monitor);
	}
	g_clear_object(&file);
}

static void watch_side(LadderCompareView *view, const struct compare_side *side)
{
	char *map = side->path && !side->files ? iomap_beside(side->path) : NULL;

	if (!side->text)
		watch_file(view, side->path);
	watch_file(view, map);
	g_free(map);
}

void ladder_compare_view_show(LadderCompareView *view, struct compare_side *older,
			      struct compare_side *newer)
{
	const struct compare_side document = { .path = (char *)ladder_document_path(
		view->document), .text = (char *)"" };

	compare_side_clear(&view->older);
	compare_side_clear(&view->newer);
	view->older = *older;
	*older = (struct compare_side){ 0 };
	if (newer) {
		view->newer = *newer;
		*newer = (struct compare_side){ 0 };
	}
	g_ptr_array_set_size(view->monitors, 0);
	watch_side(view, &view->older);
	watch_side(view, view->newer.name ? &view->newer : &document);
	gtk_single_selection_set_selected(view->selection, GTK_INVALID_LIST_POSITION);
	refresh(GTK_WIDGET(view));
}

void ladder_compare_view_enter(LadderCompareView *view)
{
	gtk_widget_grab_focus(gtk_widget_get_mapped(view->list) ? view->list :
			      GTK_WIDGET(view->stack));
}

/* ---- stepping and going ---- */

/* The widget of a row; NULL: it is out of sight. Borrowed. */
static GtkWidget *widget_of(LadderCompareView *view, guint at)
{
	for (GtkWidget *row = gtk_widget_get_first_child(view->list); row;
	     row = gtk_widget_get_next_sibling(row)) {
		GtkWidget *box = gtk_widget_get_first_child(row);
		GtkListItem *item = box ? g_object_get_data(G_OBJECT(box), ITEM) : NULL;

		if (item && gtk_list_item_get_position(item) == at)
			return row;
	}
	return NULL;
}

void ladder_compare_view_step(LadderCompareView *view, bool back)
{
	const guint at = gtk_single_selection_get_selected(view->selection);
	const guint all = g_list_model_get_n_items(G_LIST_MODEL(view->store));
	const guint to = back ? at - 1 : at + 1;
	GtkWidget *row;

	if (at == GTK_INVALID_LIST_POSITION || (back ? at == 0 : to >= all))
		return;
	gtk_single_selection_set_selected(view->selection, to);
	list_scroll_to(view->list, to);
	row = widget_of(view, to);
	if (row && gtk_widget_get_focus_child(view->list)) /* the focus goes along, and arrow keys go on from there */
		gtk_widget_grab_focus(row);
}

static void step(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	ladder_compare_view_step(LADDER_COMPARE_VIEW(widget),
				 strcmp(name, "compare.previous") == 0);
}

static void go_to_map(LadderCompareView *view)
{
	char *map = iomap_beside(ladder_document_path(view->document));

	if (map)
		gtk_widget_activate_action(GTK_WIDGET(view), "win.open-text", "s", map);
	g_free(map);
}

static void go(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderCompareView *view = LADDER_COMPARE_VIEW(widget);
	const struct compare_row *row = row_now(view);
	int place[4];

	(void)name;
	(void)unused;
	if (row && row->map && !view->newer.name)
		go_to_map(view);
	else if (row && view->newer.name)
		gtk_widget_activate_action(widget, "win.open-path", "s", view->newer.path);
	else if (row && compare_row_place(row, ladder_project(view->of->of_b), place))
		gtk_widget_activate_action(widget, "win.go-to", "(iiii)", place[0], place[1],
					   place[2], place[3]);
}

static void activated(GtkListView *list, guint at, LadderCompareView *view)
{
	(void)list;
	(void)at;
	gtk_widget_activate_action(GTK_WIDGET(view), "compare.go", NULL);
}

/* ---- the widget ---- */

static gboolean turn_now(gpointer data)
{
	LadderCompareView *view = data;
	const int room = gtk_widget_get_width(view->paned) -
			 gtk_paned_get_position(GTK_PANED(view->paned));

	view->turning = 0;
	gtk_orientable_set_orientation(GTK_ORIENTABLE(view->sides), room < BESIDE ?
		GTK_ORIENTATION_VERTICAL : GTK_ORIENTATION_HORIZONTAL);
	return G_SOURCE_REMOVE;
}

/* The signal comes during layout, when nothing may ask for another. */
static void turn(LadderCompareView *view)
{
	if (!view->turning)
		view->turning = g_idle_add(turn_now, view);
}

static void dispose(GObject *object)
{
	LadderCompareView *view = LADDER_COMPARE_VIEW(object);

	g_clear_handle_id(&view->scrolling, g_source_remove);
	g_clear_handle_id(&view->turning, g_source_remove);
	g_clear_pointer(&view->watch, panel_watch_free);
	if (view->document)
		g_signal_handlers_disconnect_by_data(view->document, view);
	g_clear_object(&view->document);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	g_clear_object(&view->selection);
	g_clear_object(&view->store);
	g_clear_pointer(&view->of, comparison_free);
	compare_side_clear(&view->older);
	compare_side_clear(&view->newer);
	g_clear_pointer(&view->monitors, g_ptr_array_unref);
	G_OBJECT_CLASS(ladder_compare_view_parent_class)->dispose(object);
}

static void add_keys(GtkWidgetClass *widget)
{
	gtk_widget_class_add_binding_action(widget, GDK_KEY_n, 0, "compare.next", NULL);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_p, 0, "compare.previous", NULL);
}

static void ladder_compare_view_class_init(LadderCompareViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/compare_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderCompareView, name)
	CHILD(box); CHILD(title); CHILD(count); CHILD(stack); CHILD(nothing); CHILD(unreadable);
	CHILD(paned); CHILD(sides); CHILD(list); CHILD(name_a); CHILD(name_b); CHILD(place_a);
	CHILD(place_b);
#undef CHILD
	gtk_widget_class_bind_template_callback(widget, activated);
	gtk_widget_class_bind_template_callback(widget, turn);
	gtk_widget_class_install_action(widget, "compare.next", NULL, step);
	gtk_widget_class_install_action(widget, "compare.previous", NULL, step);
	gtk_widget_class_install_action(widget, "compare.go", NULL, go);
	add_keys(widget);
}

/* The drawings scroll together; each keeps its own limits. */
static void tie(LadderCompareView *view)
{
	GtkScrolledWindow *a = GTK_SCROLLED_WINDOW(view->place_a);
	GtkScrolledWindow *b = GTK_SCROLLED_WINDOW(view->place_b);

	g_object_bind_property(gtk_scrolled_window_get_vadjustment(a), "value",
		gtk_scrolled_window_get_vadjustment(b), "value", G_BINDING_BIDIRECTIONAL);
	g_object_bind_property(gtk_scrolled_window_get_hadjustment(a), "value",
		gtk_scrolled_window_get_hadjustment(b), "value", G_BINDING_BIDIRECTIONAL);
}

static void ladder_compare_view_init(LadderCompareView *view)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();

	gtk_widget_init_template(GTK_WIDGET(view));
	view->monitors = g_ptr_array_new_with_free_func(g_object_unref);
	view->picture[0] = ladder_picture_view_new(draw_older, view);
	view->picture[1] = ladder_picture_view_new(draw_newer, view);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(view->place_a), view->picture[0]);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(view->place_b), view->picture[1]);
	tie(view);
	view->store = g_list_store_new(LADDER_TYPE_PANEL_ROW);
	view->selection = gtk_single_selection_new(g_object_ref(G_LIST_MODEL(view->store)));
	g_signal_connect_object(view->selection, "selection-changed", G_CALLBACK(show_row),
				view, G_CONNECT_SWAPPED);
	g_signal_connect(factory, "setup", G_CALLBACK(setup), NULL);
	g_signal_connect(factory, "bind", G_CALLBACK(bind), NULL);
	gtk_list_view_set_factory(GTK_LIST_VIEW(view->list), factory);
	gtk_list_view_set_model(GTK_LIST_VIEW(view->list),
				GTK_SELECTION_MODEL(view->selection));
	g_object_unref(factory);
	view->watch = panel_watch_new(GTK_WIDGET(view), false, refresh);
}

GtkWidget *ladder_compare_view_new(LadderDocument *document)
{
	LadderCompareView *view = g_object_new(LADDER_TYPE_COMPARE_VIEW, NULL);

	view->document = g_object_ref(document);
	panel_watch_set(view->watch, document);
	/* Saving changes the older version, typing in an I/O map the newer one. */
	g_signal_connect_swapped(document, "state-changed", G_CALLBACK(written), view);
	return GTK_WIDGET(view);
}
