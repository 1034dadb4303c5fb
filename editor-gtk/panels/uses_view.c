/* SPDX-License-Identifier: MIT
 *
 * uses_view - the cross reference as a list: rows are made by uses_rows.c.
 */
#include "editor-gtk/panels/uses_view.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/panels/uses_rows.h"

#include <string.h>

enum { LOST, SIGNALS };
static guint signals[SIGNALS];

struct _LadderUsesView {
	GtkWidget parent_instance;
	GtkWidget *box, *modes, *search, *empty, *stack;
	struct panel_list list;
	struct panel_watch *watch;
	struct uses_cache cache;
	char *symbol;
	int pou;
	bool lost;      /* there is no such symbol                             */
};

G_DEFINE_FINAL_TYPE(LadderUsesView, ladder_uses_view, GTK_TYPE_WIDGET)

static enum uses_mode mode_of(LadderUsesView *view)
{
	return (enum uses_mode)gtk_drop_down_get_selected(GTK_DROP_DOWN(view->modes));
}

/* ---- the list ---- */

static void show_empty(LadderUsesView *view)
{
	static const char *const nothing[] = {
		[USES_SYMBOL] = N_("Nothing is used here. Place the cursor on an element."),
		[USES_ALL] = N_("No symbols yet"),
		[USES_UNUSED] = N_("Every symbol is used"),
		[USES_DOUBLE] = N_("No address has two names"),
	};
	const bool rows = g_list_model_get_n_items(G_LIST_MODEL(view->list.selection));

	gtk_label_set_label(GTK_LABEL(view->empty), *view->list.wanted ?
			    _("Nothing found") : _(nothing[mode_of(view)]));
	gtk_stack_set_visible_child_name(GTK_STACK(view->stack), rows ? "list" : "none");
}

static void refresh(GtkWidget *widget)
{
	LadderUsesView *view = LADDER_USES_VIEW(widget);
	LadderDocument *document = panel_watch_document(view->watch);
	GPtrArray *rows = uses_rows(&view->cache, document, mode_of(view), view->pou,
				    view->symbol);

	panel_list_update(&view->list, rows);
	view->lost = mode_of(view) == USES_SYMBOL && rows->len == 0;
	g_ptr_array_unref(rows);
	show_empty(view);
	if (view->lost)
		g_signal_emit(view, signals[LOST], 0);
}

void ladder_uses_view_refresh(LadderUsesView *view)
{
	refresh(GTK_WIDGET(view));
}

bool ladder_uses_view_is_lost(LadderUsesView *view)
{
	return view->lost;
}

GListModel *ladder_uses_view_list(LadderUsesView *view)
{
	return G_LIST_MODEL(view->list.selection);
}

/* ---- what is asked for ---- */

void ladder_uses_view_set_mode(LadderUsesView *view, enum uses_mode mode)
{
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->modes), mode);
}

void ladder_uses_view_set_symbol(LadderUsesView *view, int pou, const char *symbol)
{
	if (g_strcmp0(view->symbol, symbol) == 0 && view->pou == pou)
		return;
	g_free(view->symbol);
	view->symbol = g_strdup(symbol);
	view->pou = pou;
	/* The cursor may move on at once. */
	if (mode_of(view) == USES_SYMBOL)
		panel_watch_later(view->watch);
}

void ladder_uses_view_set_document(LadderUsesView *view, LadderDocument *document)
{
	if (!panel_watch_set(view->watch, document))
		return;
	uses_cache_clear(&view->cache);
	refresh(GTK_WIDGET(view));
}

static void mode_changed(GtkDropDown *modes, GParamSpec *spec, LadderUsesView *view)
{
	(void)modes;
	(void)spec;
	if (view->watch)
		refresh(GTK_WIDGET(view));
}

static void search_changed(GtkSearchEntry *entry, LadderUsesView *view)
{
	panel_list_want(&view->list, gtk_editable_get_text(GTK_EDITABLE(entry)));
	show_empty(view);
}

static void activated(GtkColumnView *list, guint at, LadderUsesView *view)
{
	LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(view->list.selection), at);

	(void)list;
	panel_go_to(GTK_WIDGET(view), row);
	g_clear_object(&row);
}

/* ---- the widget ---- */

static void dispose(GObject *object)
{
	LadderUsesView *view = LADDER_USES_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	panel_list_clear(&view->list);
	uses_cache_clear(&view->cache);
	g_clear_pointer(&view->symbol, g_free);
	G_OBJECT_CLASS(ladder_uses_view_parent_class)->dispose(object);
}

static void bind_children(GtkWidgetClass *class)
{
	gtk_widget_class_set_layout_manager_type(class, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(class,
		"/org/rungboard/Editor/ui/uses_view.ui");
	gtk_widget_class_bind_template_child(class, LadderUsesView, box);
	gtk_widget_class_bind_template_child(class, LadderUsesView, modes);
	gtk_widget_class_bind_template_child(class, LadderUsesView, search);
	gtk_widget_class_bind_template_child(class, LadderUsesView, empty);
	gtk_widget_class_bind_template_child(class, LadderUsesView, stack);
	gtk_widget_class_bind_template_child_full(class, "view", FALSE, 0);
	gtk_widget_class_bind_template_callback(class, activated);
	gtk_widget_class_bind_template_callback(class, mode_changed);
	gtk_widget_class_bind_template_callback(class, search_changed);
}

static void ladder_uses_view_class_init(LadderUsesViewClass *class)
{
	G_OBJECT_CLASS(class)->dispose = dispose;
	signals[LOST] = g_signal_new("lost", LADDER_TYPE_USES_VIEW, G_SIGNAL_RUN_LAST, 0, NULL,
				     NULL, NULL, G_TYPE_NONE, 0);
	bind_children(GTK_WIDGET_CLASS(class));
}

static void ladder_uses_view_init(LadderUsesView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	view->pou = -1;
	gtk_widget_init_template(widget);
	panel_list_init(&view->list, GTK_COLUMN_VIEW(gtk_widget_get_template_child(
		widget, LADDER_TYPE_USES_VIEW, "view")));
	panel_list_column(&view->list, _("Symbol"), USES_NAME, 0, 180);
	panel_list_column(&view->list, _("Address"), USES_ADDRESS, 0, 90);
	panel_list_column(&view->list, _("Use"), USES_KIND, 0, 110);
	panel_list_column(&view->list, _("Place"), USES_PLACE, PANEL_NUMBER, 260);
	panel_list_column(&view->list, _("In"), USES_TEXT, PANEL_EXPAND, 0);
	view->watch = panel_watch_new(widget, false, refresh);
	show_empty(view);
}

GtkWidget *ladder_uses_view_new(void)
{
	return g_object_new(LADDER_TYPE_USES_VIEW, NULL);
}
