/* SPDX-License-Identifier: MIT
 *
 * sfc_view - the sheet of a chart: the widget, its drawing, and what it hears.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/settings.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <adwaita.h>
#include <string.h>

enum { CURSOR_MOVED, TOLD, ZOOM_CHANGED, BODY_WANTED, SIGNALS };
static guint signals[SIGNALS];

G_DEFINE_FINAL_TYPE(LadderSfcView, ladder_sfc_view, GTK_TYPE_WIDGET)

#define ZOOM_LEAST 0.3
#define ZOOM_MOST  3.0

/* ---- what is shown ---- */

struct pou *chart_pou(LadderSfcView *view)
{
	struct project *project = ladder_document_project(view->document);

	return project && view->pou < project->pou_count && project->pou[view->pou].sfc ?
	       &project->pou[view->pou] : NULL;
}

void chart_tell(LadderSfcView *view, const char *text)
{
	g_signal_emit(view, signals[TOLD], 0, text);
}

bool chart_is_fixed(LadderSfcView *view)
{
	if (!ladder_document_is_fixed(view->document))
		return false;
	chart_tell(view, _("This is the program before an edit: it can be looked at, not "
			   "changed"));
	return true;
}

void chart_body_wanted(LadderSfcView *view, const struct sfc_body *body)
{
	const bool rungs = body->kind == BODY_RUNGS || body->kind == BODY_EXPRESSION;

	g_signal_emit(view, signals[BODY_WANTED], 0, body->first,
		      rungs ? body->count : 0);
}

enum sfc_part chart_part(LadderSfcView *view, int *index)
{
	const struct sfc_shape *shape;

	*index = -1;
	if (!view->sheet || view->cursor.shape < 0)
		return SFC_NOTHING;
	shape = &view->sheet->layout->shape[view->cursor.shape];
	*index = shape->index;
	return shape->part;
}

graphene_rect_t chart_box(LadderSfcView *view, struct sfc_at at)
{
	if (!view->sheet || at.shape < 0)
		return GRAPHENE_RECT_INIT(SFC_EDGE, SFC_EDGE, 80, SFC_ROW);
	return at.use >= 0 ? sfc_sheet_use(view->sheet, at.use) :
			     sfc_sheet_box(view->sheet, at.shape);
}

double chart_px(LadderSfcView *view, double px)
{
	return px / view->zoom;
}

/* ---- the cursor ---- */

static int size_along(LadderSfcView *view, GtkOrientation orientation)
{
	double size = 200;

	if (view->sheet)
		size = (double)(orientation == GTK_ORIENTATION_HORIZONTAL ?
				view->sheet->width : view->sheet->height + 60) * view->zoom;
	return MAX((int)size, 100);
}

static void reveal_along(GtkAdjustment *adjustment, double from, double to)
{
	const double value = gtk_adjustment_get_value(adjustment);
	const double page = gtk_adjustment_get_page_size(adjustment);

	if (from < value)
		gtk_adjustment_set_value(adjustment, from);
	else if (to > value + page)
		gtk_adjustment_set_value(adjustment, MIN(to - page, from));
}

/* What scrolls the chart that way, knowing already how large the chart is: it may have
 * grown, and is only given its place when it is drawn. NULL: nothing. */
static GtkAdjustment *along(LadderSfcView *view, GtkOrientation orientation)
{
	GtkWidget *scroller = gtk_widget_get_ancestor(GTK_WIDGET(view),
						      GTK_TYPE_SCROLLED_WINDOW);
	GtkAdjustment *adjustment;

	if (!scroller)
		return NULL;
	adjustment = orientation == GTK_ORIENTATION_HORIZONTAL ?
		gtk_scrolled_window_get_hadjustment(GTK_SCROLLED_WINDOW(scroller)) :
		gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(scroller));
	gtk_adjustment_set_upper(adjustment, MAX(size_along(view, orientation),
						 gtk_adjustment_get_page_size(adjustment)));
	return adjustment;
}

/* Of the cursor, with some room around it: px of the widget. */
static graphene_rect_t cursor_box(LadderSfcView *view, float around)
{
	graphene_rect_t box = chart_box(view, view->cursor);

	graphene_rect_inset(&box, -around, -around);
	graphene_rect_scale(&box, (float)view->zoom, (float)view->zoom, &box);
	return box;
}

static void reveal(LadderSfcView *view)
{
	GtkAdjustment *x = along(view, GTK_ORIENTATION_HORIZONTAL);
	GtkAdjustment *y = along(view, GTK_ORIENTATION_VERTICAL);
	const graphene_rect_t box = cursor_box(view, 30);

	if (!x || view->cursor.shape < 0)
		return;
	reveal_along(x, (double)box.origin.x, (double)(box.origin.x + box.size.width));
	reveal_along(y, (double)box.origin.y, (double)(box.origin.y + box.size.height));
}

/* Is something of the cursor? */
static bool is_seen(LadderSfcView *view)
{
	GtkAdjustment *x = along(view, GTK_ORIENTATION_HORIZONTAL);
	GtkAdjustment *y = along(view, GTK_ORIENTATION_VERTICAL);
	const graphene_rect_t box = cursor_box(view, 0);

	if (!x || view->cursor.shape < 0)
		return false;
	return graphene_rect_intersection(&box, &GRAPHENE_RECT_INIT(
		(float)gtk_adjustment_get_value(x), (float)gtk_adjustment_get_value(y),
		(float)gtk_adjustment_get_page_size(x),
		(float)gtk_adjustment_get_page_size(y)), NULL);
}

void chart_moved(LadderSfcView *view)
{
	reveal(view);
	chart_cells_later(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
	g_signal_emit(view, signals[CURSOR_MOVED], 0);
}

void chart_go(LadderSfcView *view, struct sfc_at at, bool extend)
{
	if (!view->sheet)
		return;
	if (!extend)
		memset(view->selected, 0, (size_t)view->sheet->layout->shape_count + 1);
	else if (view->cursor.shape >= 0)
		view->selected[view->cursor.shape] = true;
	view->cursor = at;
	if (extend && at.shape >= 0)
		view->selected[at.shape] = true;
	chart_moved(view);
}

/* ---- drawing ---- */

static const struct theme *theme_now(void)
{
	AdwStyleManager *manager = adw_style_manager_get_default();
	const bool dark = adw_style_manager_get_dark(manager);
	const enum theme_power power = (enum theme_power)settings_enum("power", THEME_GREEN);

	if (adw_style_manager_get_high_contrast(manager))
		return theme_get(dark ? THEME_CONTRAST_DARK : THEME_CONTRAST, power);
	return theme_get(dark ? THEME_DARK : THEME_LIGHT, power);
}

static GArray *all_marks(LadderSfcView *view)
{
	GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));

	for (int i = 0; i < view->sheet->layout->shape_count; i++) {
		struct sfc_mark mark = { i, -1, SFC_SELECTED };

		if (view->selected[i])
			g_array_append_val(marks, mark);
	}
	if (view->found.shape >= 0) {
		struct sfc_mark mark = { view->found.shape, view->found.use, SFC_FOUND };

		g_array_append_val(marks, mark);
	}
	g_array_append_vals(marks, view->marks->data, view->marks->len);
	if (view->cursor.shape >= 0) {
		struct sfc_mark mark = { view->cursor.shape, view->cursor.use, SFC_CURSOR };

		g_array_append_val(marks, mark);
	}
	if (view->dragging && view->drop.shape >= 0) {
		struct sfc_mark mark = { view->drop.shape, -1, SFC_DROP };

		g_array_append_val(marks, mark);
	}
	return marks;
}

/* Only what is seen is drawn: a chart may be a thousand steps long. */
static void visible(LadderSfcView *view, float *top, float *bottom)
{
	GtkWidget *scroller = gtk_widget_get_ancestor(GTK_WIDGET(view),
						      GTK_TYPE_SCROLLED_WINDOW);
	GtkAdjustment *down = scroller ? gtk_scrolled_window_get_vadjustment(
		GTK_SCROLLED_WINDOW(scroller)) : NULL;

	*top = down ? (float)(gtk_adjustment_get_value(down) / view->zoom) : 0;
	*bottom = down ? *top + (float)(gtk_adjustment_get_page_size(down) / view->zoom) :
		  0;
}

static void snapshot_hint(LadderSfcView *view, GtkSnapshot *snapshot,
			  const struct theme *theme)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(view),
		_("Press Ins: a step, and below it a transition and the next one.\n"
		  "F6 another branch, F7 a branch beside it, F8 leads to a step.\n"
		  "Type a name at a step, a condition at a transition."));

	pango_layout_set_spacing(layout, 6 * PANGO_SCALE);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(SFC_EDGE, SFC_EDGE));
	gtk_snapshot_append_layout(snapshot, layout, &theme->color[TOKEN_COMMENT]);
	gtk_snapshot_restore(snapshot);
	g_object_unref(layout);
}

static void snapshot_chart(LadderSfcView *view, GtkSnapshot *snapshot,
			   const struct theme *theme)
{
	GArray *marks = all_marks(view);
	struct sfc_live live;
	struct sfc_scene scene = { .sheet = view->sheet, .theme = theme,
				   .mark = (const struct sfc_mark *)marks->data,
				   .mark_count = (int)marks->len };
	GskRenderNode *node;

	if (chart_live_look(view, &live))
		scene.live = &live;
	visible(view, &scene.top, &scene.bottom);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_scale(snapshot, (float)view->zoom, (float)view->zoom);
	node = sfc_draw_node(&scene);
	if (node) {
		gtk_snapshot_append_node(snapshot, node);
		gsk_render_node_unref(node);
	}
	chart_drag_snapshot(view, snapshot, theme);
	gtk_snapshot_restore(snapshot);
	g_array_unref(marks);
}

static void ladder_sfc_view_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderSfcView *view = LADDER_SFC_VIEW(widget);
	const struct theme *theme = theme_now();

	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET],
		&GRAPHENE_RECT_INIT(0, 0, (float)gtk_widget_get_width(widget),
				    (float)gtk_widget_get_height(widget)));
	lettering_trim(view->lettering);
	if (view->sheet && view->sheet->layout->shape_count)
		snapshot_chart(view, snapshot, theme);
	else if (view->sheet)
		snapshot_hint(view, snapshot, theme);
}

static void ladder_sfc_view_measure(GtkWidget *widget, GtkOrientation orientation,
				    int for_size, int *least, int *natural, int *least_base,
				    int *natural_base)
{
	(void)for_size;
	*least = *natural = size_along(LADDER_SFC_VIEW(widget), orientation);
	*least_base = *natural_base = -1;
}

static void ladder_sfc_view_size_allocate(GtkWidget *widget, int width, int height,
					  int baseline)
{
	GtkWidget *child = gtk_widget_get_first_child(widget);

	(void)width;
	(void)height;
	(void)baseline;
	chart_cells_allocate(LADDER_SFC_VIEW(widget));
	for (; child; child = gtk_widget_get_next_sibling(child))
		if (GTK_IS_POPOVER(child))
			gtk_popover_present(GTK_POPOVER(child));
}

/* ---- what is heard of the document ---- */

static void forget_sheet(LadderSfcView *view)
{
	chart_entry_close(view);
	chart_forget_uses(view);
	chart_live_forget(view);
	g_array_set_size(view->marks, 0);
	view->found.shape = -1;
	g_clear_pointer(&view->sheet, sfc_sheet_free);
	g_clear_pointer(&view->selected, g_free);
}

static void make_sheet(LadderSfcView *view)
{
	const struct pou *pou = chart_pou(view);

	forget_sheet(view);
	view->of = ladder_document_ladder(view->document);
	view->dragging = false;
	if (pou) {
		view->sheet = sfc_sheet_new(ladder_document_project(view->document), pou,
					    view->lettering);
		view->selected = g_new0(bool, view->sheet->layout->shape_count + 1);
	}
	if (!view->sheet || view->cursor.shape >= view->sheet->layout->shape_count)
		view->cursor = (struct sfc_at){ view->sheet ?
			view->sheet->layout->shape_count - 1 : -1, -1, false };
	if (view->sheet && view->cursor.shape < 0 && view->sheet->layout->shape_count)
		view->cursor.shape = 0;
	if (view->cursor.use >= (pou ? pou->sfc->use_count : 0) ||
	    (view->cursor.use >= 0 &&
	     pou->sfc->use[view->cursor.use].step != view->cursor.shape))
		view->cursor.use = -1;
	gtk_widget_queue_resize(GTK_WIDGET(view));
	chart_moved(view);
}

void chart_fresh(LadderSfcView *view)
{
	if (view->of != ladder_document_ladder(view->document))
		make_sheet(view);
}

static void rungs_changed(LadderSfcView *view, int pou)
{
	if (pou == view->pou)
		make_sheet(view);
	else
		chart_forget_uses(view);
}

/* The chart that the checks saw: rungs may have been edited since this one was read, so
 * that lines are others. NULL: not known. */
static const struct sfc *checked_chart(LadderSfcView *view)
{
	struct ladder *ladder = ladder_document_checked(view->document);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;

	return project && view->pou < project->pou_count ? project->pou[view->pou].sfc :
	       NULL;
}

static void checked(LadderSfcView *view)
{
	const struct diag_list *diags = ladder_document_diags(view->document);
	const struct pou *pou = chart_pou(view);
	const struct project *project = ladder_document_project(view->document);

	g_array_set_size(view->marks, 0);
	for (int i = 0; pou && view->sheet && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		struct sfc_mark mark;

		if (!diag->pou || strcmp(diag->pou, project_text(project, pou->name)) != 0 ||
		    !sfc_sheet_of_diag(view->sheet, checked_chart(view), diag, &mark.shape,
				       &mark.use))
			continue;
		mark.signs = diag_severity(diag->id) == SEVERITY_ERROR ? SFC_ERROR :
									 SFC_WARNING;
		g_array_append_val(view->marks, mark);
	}
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void listen(LadderSfcView *view)
{
	view->handler[0] = g_signal_connect_swapped(view->document, "rungs-changed",
		G_CALLBACK(rungs_changed), view);
	view->handler[1] = g_signal_connect_swapped(view->document, "project-changed",
		G_CALLBACK(make_sheet), view);
	view->handler[2] = g_signal_connect_swapped(view->document, "variable-changed",
		G_CALLBACK(chart_forget_uses), view);
	view->handler[3] = g_signal_connect_swapped(view->document, "checked",
		G_CALLBACK(checked), view);
}

/* ---- what is told of a place ---- */

char *ladder_sfc_view_tip(LadderSfcView *view, int shape, int use)
{
	const struct diag_list *diags = ladder_document_diags(view->document);
	const struct pou *pou = chart_pou(view);
	const char *comment = !view->sheet ? "" : use >= 0 ? view->sheet->use_comment[use] :
			      view->sheet->comment[shape];
	GString *text = g_string_new(comment);

	for (int i = 0; pou && view->sheet && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		int of_shape, of_use;
		char *said;

		if (!diag->pou || strcmp(diag->pou, project_text(view->sheet->project,
								 pou->name)) != 0 ||
		    !sfc_sheet_of_diag(view->sheet, checked_chart(view), diag, &of_shape,
				       &of_use) ||
		    of_shape != shape || of_use != use)
			continue;
		said = diag_said_whole(diag);
		g_string_append_printf(text, "%s%s: %s", text->len ? "\n" : "",
			diag_severity(diag->id) == SEVERITY_ERROR ? _("Error") :
			_("Warning"), said);
		g_free(said);
	}
	return g_string_free(text, text->len == 0);
}

static gboolean tip_wanted(GtkWidget *widget, int x, int y, gboolean by_keys,
			   GtkTooltip *tooltip)
{
	LadderSfcView *view = LADDER_SFC_VIEW(widget);
	struct sfc_at at = view->cursor;
	gboolean told;
	char *text;

	if (!view->sheet || view->entry)
		return FALSE;
	if (!by_keys)
		at = sfc_sheet_at(view->sheet, (float)chart_px(view, x),
				  (float)chart_px(view, y), 4);
	if (at.shape < 0)
		return FALSE;
	text = ladder_sfc_view_tip(view, at.shape, at.use);
	told = tip_show(tooltip, text);
	g_free(text);
	return told;
}

char *ladder_sfc_view_place(LadderSfcView *view)
{
	chart_fresh(view);
	return view->cursor.shape < 0 || !view->sheet ? g_strdup("") : chart_said(view, view->cursor);
}

/* ---- from outside ---- */

int ladder_sfc_view_pou(LadderSfcView *view)
{
	return view->pou;
}

void ladder_sfc_view_set_pou(LadderSfcView *view, int pou)
{
	view->pou = pou;
	make_sheet(view);
}

void ladder_sfc_view_go(LadderSfcView *view, int rung)
{
	const struct diag place = { .rung = rung + 1 };
	struct sfc_at at = { -1, -1, false };

	chart_fresh(view);
	if (view->sheet && sfc_sheet_of_diag(view->sheet, NULL, &place, &at.shape, &at.use))
		chart_go(view, at, false);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

double ladder_sfc_view_zoom(LadderSfcView *view)
{
	return view->zoom;
}

void ladder_sfc_view_set_zoom(LadderSfcView *view, double zoom)
{
	const bool seen = is_seen(view);

	zoom = CLAMP(zoom, ZOOM_LEAST, ZOOM_MOST);
	if (zoom == view->zoom)
		return;
	view->zoom = zoom;
	gtk_widget_queue_resize(GTK_WIDGET(view));
	if (seen)
		reveal(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
	g_signal_emit(view, signals[ZOOM_CHANGED], 0);
}

/* ---- life ---- */

static void ladder_sfc_view_dispose(GObject *object)
{
	LadderSfcView *view = LADDER_SFC_VIEW(object);

	chart_live_clear(view);
	chart_cells_clear(view);
	if (view->document) {
		forget_sheet(view);
		for (int i = 0; i < (int)G_N_ELEMENTS(view->handler); i++)
			g_signal_handler_disconnect(view->document, view->handler[i]);
	}
	g_clear_object(&view->document);
	G_OBJECT_CLASS(ladder_sfc_view_parent_class)->dispose(object);
}

static void ladder_sfc_view_finalize(GObject *object)
{
	LadderSfcView *view = LADDER_SFC_VIEW(object);

	g_array_unref(view->marks);
	g_array_unref(view->cells);
	lettering_free(view->lettering);
	G_OBJECT_CLASS(ladder_sfc_view_parent_class)->finalize(object);
}

static void ladder_sfc_view_class_init(LadderSfcViewClass *class)
{
	GObjectClass *object = G_OBJECT_CLASS(class);
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
	const GType type = G_TYPE_FROM_CLASS(class);

	object->dispose = ladder_sfc_view_dispose;
	object->finalize = ladder_sfc_view_finalize;
	widget->measure = ladder_sfc_view_measure;
	widget->size_allocate = ladder_sfc_view_size_allocate;
	widget->snapshot = ladder_sfc_view_snapshot;
	signals[CURSOR_MOVED] = g_signal_new("cursor-moved", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 1, G_TYPE_STRING);
	signals[ZOOM_CHANGED] = g_signal_new("zoom-changed", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[BODY_WANTED] = g_signal_new("body-wanted", type, G_SIGNAL_RUN_LAST, 0, NULL,
		NULL, NULL, G_TYPE_NONE, 2, G_TYPE_INT, G_TYPE_INT);
	gtk_widget_class_set_css_name(widget, "sheet");
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GRID);
}

static void ladder_sfc_view_init(LadderSfcView *view)
{
	view->zoom = CLAMP(settings_number("zoom", 1.0), ZOOM_LEAST, ZOOM_MOST);
	view->cursor = view->press = view->drop = (struct sfc_at){ -1, -1, false };
	view->marks = g_array_new(FALSE, TRUE, sizeof(struct sfc_mark));
	view->cells = g_array_new(FALSE, TRUE, sizeof(struct sfc_cell));
	gtk_widget_set_focusable(GTK_WIDGET(view), TRUE);
	gtk_widget_set_has_tooltip(GTK_WIDGET(view), TRUE);
	g_signal_connect(view, "query-tooltip", G_CALLBACK(tip_wanted), NULL);
	g_signal_connect(view, "notify::has-focus", G_CALLBACK(gtk_widget_queue_draw), NULL);
	chart_keys_init(view);
	chart_mouse_init(view);
	chart_cells_init(view);
}

GtkWidget *ladder_sfc_view_new(LadderDocument *document, int pou)
{
	LadderSfcView *view = g_object_new(LADDER_TYPE_SFC_VIEW, NULL);

	view->document = g_object_ref(document);
	view->pou = pou;
	view->lettering = lettering_new(gtk_widget_get_pango_context(GTK_WIDGET(view)),
					NULL);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(gtk_widget_queue_draw), view, G_CONNECT_SWAPPED);
	listen(view);
	make_sheet(view);
	checked(view);
	return GTK_WIDGET(view);
}
