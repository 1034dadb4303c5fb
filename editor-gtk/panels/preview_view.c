/* SPDX-License-Identifier: MIT
 *
 * preview_view - see preview_view.h.
 */
#include "editor-gtk/panels/preview_view.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/draw/pages.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/settings.h"

#include <math.h>
#include <string.h>

#define GAP       18      /* px around a page                                   */
#define POINT     (96.0 / 72.0) /* px of a point at 100 %                        */
#define ZOOM_STEP 1.25

/* ---- the pages ---- */

#define LADDER_TYPE_PREVIEW_PAGES (ladder_preview_pages_get_type())
G_DECLARE_FINAL_TYPE(LadderPreviewPages, ladder_preview_pages, LADDER, PREVIEW_PAGES, GtkWidget)

/* Paints only what is in sight, each page once. */
struct _LadderPreviewPages {
	GtkWidget parent_instance;
	struct ladder *ladder;        /* a copy of the project                   */
	struct lettering *lettering;
	struct pages *pages;          /* NULL: nothing to print                  */
	GPtrArray *nodes;             /* GskRenderNode by page; NULL: not painted */
	double width, height;         /* points of a page                        */
	double zoom;                  /* 0: as wide as the view, 100 % at most   */
	GtkAdjustment *scroll;        /* borrowed                                */
};

G_DEFINE_FINAL_TYPE(LadderPreviewPages, ladder_preview_pages, GTK_TYPE_WIDGET)

static int count_of(LadderPreviewPages *pages)
{
	return pages->pages ? pages_count(pages->pages) : 0;
}

/* px of a point when the view is @width px wide. */
static double scale_for(LadderPreviewPages *pages, int width)
{
	return pages->zoom > 0 ? pages->zoom * POINT :
	       CLAMP((width - 2 * GAP) / MAX(pages->width, 1), 0.2, POINT);
}

static double scale_now(LadderPreviewPages *pages)
{
	return scale_for(pages, gtk_widget_get_width(GTK_WIDGET(pages)));
}

static void forget_nodes(LadderPreviewPages *pages)
{
	for (guint i = 0; i < pages->nodes->len; i++)
		g_clear_pointer(&pages->nodes->pdata[i], gsk_render_node_unref);
}

static void forget(LadderPreviewPages *pages)
{
	forget_nodes(pages);
	g_ptr_array_set_size(pages->nodes, 0);
	g_clear_pointer(&pages->pages, pages_free);
	g_clear_pointer(&pages->ladder, ladder_free);
}

static void measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
		    int *minimum, int *natural, int *minimum_baseline,
		    int *natural_baseline)
{
	LadderPreviewPages *pages = LADDER_PREVIEW_PAGES(widget);

	*minimum_baseline = *natural_baseline = -1;
	if (orientation == GTK_ORIENTATION_HORIZONTAL)
		*minimum = *natural = pages->zoom > 0 ?
			(int)(pages->width * pages->zoom * POINT) + 2 * GAP : 120;
	else
		*minimum = *natural = GAP + (int)(count_of(pages) * (GAP + pages->height *
			scale_for(pages, for_size < 0 ? 800 : for_size)));
}

static GtkSizeRequestMode request_mode(GtkWidget *widget)
{
	(void)widget;
	return GTK_SIZE_REQUEST_HEIGHT_FOR_WIDTH;
}

/* In points, so that it serves every zoom. */
static GskRenderNode *node_of(LadderPreviewPages *pages, int page)
{
	const graphene_rect_t all = GRAPHENE_RECT_INIT(0, 0, (float)pages->width,
						       (float)pages->height);
	GtkSnapshot *shot;
	cairo_t *cr;

	if (pages->nodes->pdata[page])
		return pages->nodes->pdata[page];
	shot = gtk_snapshot_new();
	cr = gtk_snapshot_append_cairo(shot, &all);
	pages_paint(pages->pages, page, cr);
	cairo_destroy(cr);
	pages->nodes->pdata[page] = gtk_snapshot_free_to_node(shot);
	return pages->nodes->pdata[page];
}

static void paint(LadderPreviewPages *pages, int page, double scale, GtkSnapshot *shot)
{
	const float width = (float)(pages->width * scale), height = (float)(pages->height * scale);
	const float x = MAX((float)gtk_widget_get_width(GTK_WIDGET(pages)) - width, 2 * GAP) / 2;
	const float y = GAP + (float)page * (height + GAP);
	const GdkRGBA white = { 1, 1, 1, 1 }, edge = { 0, 0, 0, 0.25f };
	GskRenderNode *node = node_of(pages, page);

	gtk_snapshot_append_color(shot, &edge, &GRAPHENE_RECT_INIT(x - 1, y - 1, width + 2,
								   height + 2));
	gtk_snapshot_append_color(shot, &white, &GRAPHENE_RECT_INIT(x, y, width, height));
	gtk_snapshot_save(shot);
	gtk_snapshot_translate(shot, &GRAPHENE_POINT_INIT(x, y));
	gtk_snapshot_scale(shot, (float)scale, (float)scale);
	if (node)
		gtk_snapshot_append_node(shot, node);
	gtk_snapshot_restore(shot);
}

static int page_at(LadderPreviewPages *pages, double y)
{
	const double high = pages->height * scale_now(pages) + GAP;

	return CLAMP((int)floor(y / high), 0, MAX(count_of(pages) - 1, 0));
}

static void snapshot(GtkWidget *widget, GtkSnapshot *shot)
{
	LadderPreviewPages *pages = LADDER_PREVIEW_PAGES(widget);
	const double top = gtk_adjustment_get_value(pages->scroll);
	const double bottom = top + gtk_adjustment_get_page_size(pages->scroll);

	if (!count_of(pages))
		return;
	for (int i = page_at(pages, top); i <= page_at(pages, bottom); i++)
		paint(pages, i, scale_now(pages), shot);
}

static void pages_dispose(GObject *object)
{
	LadderPreviewPages *pages = LADDER_PREVIEW_PAGES(object);

	if (pages->nodes)
		forget(pages);
	g_clear_pointer(&pages->nodes, g_ptr_array_unref);
	g_clear_pointer(&pages->lettering, lettering_free);
	G_OBJECT_CLASS(ladder_preview_pages_parent_class)->dispose(object);
}

static void ladder_preview_pages_class_init(LadderPreviewPagesClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = pages_dispose;
	widget->measure = measure;
	widget->get_request_mode = request_mode;
	widget->snapshot = snapshot;
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_IMG);
}

static void ladder_preview_pages_init(LadderPreviewPages *pages)
{
	PangoContext *context = lettering_context();

	pages->nodes = g_ptr_array_new();
	pages->lettering = lettering_new(context, NULL);
	gtk_widget_set_focusable(GTK_WIDGET(pages), TRUE);
	g_object_unref(context);
}

static void set_project(LadderPreviewPages *pages, LadderDocument *document,
			const struct paper *paper)
{
	const char *path = ladder_document_path(document);
	char *name = path ? g_path_get_basename(path) : g_strdup("");
	gsize len;
	char *text = ladder_document_text(document, &len);

	forget(pages);
	pages->width = (double)paper->width / 25.4 * 72;
	pages->height = (double)paper->height / 25.4 * 72;
	pages->ladder = ladder_document_reader(document);
	if (ladder_load_text(pages->ladder, path ? g_intern_string(path) : "",
					      text, len))
		pages->pages = pages_new(ladder_project(pages->ladder), name, -1, 0,
			(enum drafting_show)settings_enum("show", SHOW_BOTH), paper,
			pages->lettering);
	g_ptr_array_set_size(pages->nodes, count_of(pages));
	gtk_widget_queue_resize(GTK_WIDGET(pages));
	gtk_widget_queue_draw(GTK_WIDGET(pages));
	g_free(text);
	g_free(name);
}

/* ---- the view ---- */

struct _LadderPreviewView {
	GtkWidget parent_instance;
	GtkWidget *box, *number, *paper, *landscape, *place;
	LadderPreviewPages *pages;
	GtkPageSetup *setup;
	struct panel_watch *watch;
	guint telling;
	bool filling;
};

G_DEFINE_FINAL_TYPE(LadderPreviewView, ladder_preview_view, GTK_TYPE_WIDGET)

static const struct { const char *name, *label; } papers[] = {
	{ "iso_a4", "A4" }, { "iso_a3", "A3" }, { "iso_a5", "A5" }, { "na_letter", "Letter" },
	{ "na_legal", "Legal" },
};

static GtkAdjustment *scroll_of(LadderPreviewView *view)
{
	return gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(view->place));
}

static void tell_number(LadderPreviewView *view)
{
	GtkAdjustment *scroll = scroll_of(view);
	const int count = count_of(view->pages);
	const double middle = gtk_adjustment_get_value(scroll) +
			      gtk_adjustment_get_page_size(scroll) / 2;
	char *text = count ? g_strdup_printf(_("Page %d of %d"), page_at(view->pages, middle) + 1,
					     count) :
		     g_strdup(_("There is nothing to print: the file cannot be read as a "
				"program."));

	gtk_label_set_text(GTK_LABEL(view->number), text);
	spoken_name(view->pages, text);
	g_free(text);
}

static gboolean tell_now(gpointer data)
{
	LadderPreviewView *view = data;

	view->telling = 0;
	tell_number(view);
	return G_SOURCE_REMOVE;
}

/* The signal comes during layout, when nothing may ask for another. */
static void resized(LadderPreviewView *view)
{
	if (!view->telling)
		view->telling = g_idle_add(tell_now, view);
}

static void scrolled(LadderPreviewView *view)
{
	tell_number(view);
	gtk_widget_queue_draw(GTK_WIDGET(view->pages));
}

static void refresh(GtkWidget *widget)
{
	LadderPreviewView *view = LADDER_PREVIEW_VIEW(widget);
	GDateTime *now = g_date_time_new_now_local();
	char *date = g_date_time_format(now, "%x");
	const struct paper paper = {
		.width = (float)gtk_page_setup_get_paper_width(view->setup, GTK_UNIT_MM),
		.height = (float)gtk_page_setup_get_paper_height(view->setup, GTK_UNIT_MM),
		.date = date,
	};

	set_project(view->pages, panel_watch_document(view->watch), &paper);
	tell_number(view);
	g_free(date);
	g_date_time_unref(now);
}

static void paper_chosen(LadderPreviewView *view)
{
	const guint at = gtk_drop_down_get_selected(GTK_DROP_DOWN(view->paper));
	const bool across = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->landscape));
	GtkPaperSize *size;

	if (view->filling || !view->setup)
		return;
	if (at < G_N_ELEMENTS(papers)) {
		size = gtk_paper_size_new(papers[at].name);
		gtk_page_setup_set_paper_size(view->setup, size);
		gtk_paper_size_free(size);
	}
	gtk_page_setup_set_orientation(view->setup, across ? GTK_PAGE_ORIENTATION_LANDSCAPE :
				       GTK_PAGE_ORIENTATION_PORTRAIT);
	refresh(GTK_WIDGET(view));
}

/* The controls as the setup has it. Another size has no row and stays. */
static void show_setup(LadderPreviewView *view)
{
	const char *name = gtk_paper_size_get_name(gtk_page_setup_get_paper_size(view->setup));
	guint at = GTK_INVALID_LIST_POSITION;

	for (guint i = 0; i < G_N_ELEMENTS(papers); i++)
		if (strcmp(papers[i].name, name) == 0)
			at = i;
	view->filling = true;
	gtk_drop_down_set_selected(GTK_DROP_DOWN(view->paper), at);
	gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(view->landscape),
		gtk_page_setup_get_orientation(view->setup) == GTK_PAGE_ORIENTATION_LANDSCAPE);
	view->filling = false;
}

void ladder_preview_view_again(LadderPreviewView *view)
{
	show_setup(view);
	refresh(GTK_WIDGET(view));
}

void ladder_preview_view_zoom(LadderPreviewView *view, double factor)
{
	LadderPreviewPages *pages = view->pages;

	pages->zoom = factor > 0 ? CLAMP(scale_now(pages) / POINT * factor, 0.2, 5) : 0;
	gtk_widget_queue_resize(GTK_WIDGET(pages));
}

static void zoom(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)unused;
	ladder_preview_view_zoom(LADDER_PREVIEW_VIEW(widget),
		strcmp(name, "preview.zoom-in") == 0 ? ZOOM_STEP : 1 / ZOOM_STEP);
}

static void dispose(GObject *object)
{
	LadderPreviewView *view = LADDER_PREVIEW_VIEW(object);

	g_clear_handle_id(&view->telling, g_source_remove);
	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_object(&view->setup);
	g_clear_pointer(&view->box, gtk_widget_unparent);
	G_OBJECT_CLASS(ladder_preview_view_parent_class)->dispose(object);
}

static void ladder_preview_view_class_init(LadderPreviewViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/preview_view.ui");
#define CHILD(name) gtk_widget_class_bind_template_child(widget, LadderPreviewView, name)
	CHILD(box); CHILD(number); CHILD(paper); CHILD(landscape); CHILD(place);
#undef CHILD
	gtk_widget_class_bind_template_callback(widget, paper_chosen);
	gtk_widget_class_install_action(widget, "preview.zoom-in", NULL, zoom);
	gtk_widget_class_install_action(widget, "preview.zoom-out", NULL, zoom);
}

static void ladder_preview_view_init(LadderPreviewView *view)
{
	GtkStringList *names = gtk_string_list_new(NULL);

	view->filling = true;
	gtk_widget_init_template(GTK_WIDGET(view));
	for (gsize i = 0; i < G_N_ELEMENTS(papers); i++)
		gtk_string_list_append(names, papers[i].label);
	gtk_drop_down_set_model(GTK_DROP_DOWN(view->paper), G_LIST_MODEL(names));
	g_object_unref(names);
	view->filling = false;
	view->pages = g_object_new(LADDER_TYPE_PREVIEW_PAGES, NULL);
	view->pages->scroll = scroll_of(view);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(view->place),
				      GTK_WIDGET(view->pages));
	g_signal_connect_object(scroll_of(view), "value-changed", G_CALLBACK(scrolled), view,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(scroll_of(view), "changed", G_CALLBACK(resized), view,
				G_CONNECT_SWAPPED);
	view->watch = panel_watch_new(GTK_WIDGET(view), false, refresh);
}

GtkWidget *ladder_preview_view_new(LadderDocument *document, GtkPageSetup *setup)
{
	LadderPreviewView *view = g_object_new(LADDER_TYPE_PREVIEW_VIEW, NULL);

	view->setup = g_object_ref(setup);
	show_setup(view);
	panel_watch_set(view->watch, document);
	return GTK_WIDGET(view);
}
