/* SPDX-License-Identifier: MIT
 *
 * grid_view - a sheet: the rungs of one POU, with a cursor.
 *
 * Here: the widget, its scrolling, and what it hears of the document.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/draw/place.h"
#include "editor-gtk/kit/settings.h"

#include <string.h>

enum { PROP_0, PROP_HADJUSTMENT, PROP_VADJUSTMENT, PROP_HPOLICY, PROP_VPOLICY };
enum { CURSOR_MOVED, TOLD, ZOOM_CHANGED, SIGNALS };
static guint signals[SIGNALS];

G_DEFINE_FINAL_TYPE_WITH_CODE(LadderGridView, ladder_grid_view, GTK_TYPE_WIDGET,
	G_IMPLEMENT_INTERFACE(GTK_TYPE_SCROLLABLE, NULL))

#define ZOOM_LEAST 0.5
#define ZOOM_MOST  3.0
#define BELOW      120 /* px of free sheet below the last rung                 */

/* ---- what is shown ---- */

struct pou *sheet_pou(LadderGridView *view)
{
	struct project *project = ladder_document_project(view->document);

	return project && view->pou < project->pou_count &&
	       (project->pou[view->pou].language == LANGUAGE_LD ||
		(project->pou[view->pou].sfc && view->count >= 0)) ?
	       &project->pou[view->pou] : NULL;
}

int sheet_rungs(LadderGridView *view)
{
	const struct pou *pou = sheet_pou(view);

	if (!pou || view->count < 0)
		return pou ? pou->rung_count : 0;
	return CLAMP(pou->rung_count - view->first, 0, view->count);
}

struct rung *sheet_rung(LadderGridView *view, int rung)
{
	const struct pou *pou = sheet_pou(view);

	if (!pou || rung < 0 || rung >= sheet_rungs(view))
		return NULL;
	return view->preview && rung == view->cursor.rung ? view->preview :
	       pou->rung[view->first + rung];
}

/* In a chart each change has a rung on both sides, so that it is sure whose body it is:
 * one that comes stands beside one that was there. */
static bool splice_body(LadderGridView *view, int at, int removed, struct rung **rungs,
			int inserted, struct diag_list *why)
{
	const struct pou *pou = sheet_pou(view);
	const bool before = at > 0;
	const int beside = before ? at - 1 : at + removed;
	struct rung **all;
	bool good;

	if (!pou || at < 0 || at + removed > sheet_rungs(view) ||
	    beside >= sheet_rungs(view)) {
		for (int i = 0; i < inserted; i++)
			rung_free(rungs[i]);
		return false;
	}
	all = g_new0(struct rung *, inserted + 1);
	for (int i = 0; i < inserted; i++)
		all[i + before] = rungs[i];
	all[before ? 0 : inserted] = rung_copy(pou->rung[view->first + beside]);
	good = ladder_document_splice(view->document, view->pou,
				      view->first + at - before, removed + 1, all,
				      inserted + 1, why);
	g_free(all);
	return good;
}

bool sheet_splice(LadderGridView *view, int at, int removed, struct rung **rungs,
		  int inserted, struct diag_list *why)
{
	if (view->count >= 0 && (removed == 0 || inserted == 0))
		return splice_body(view, at, removed, rungs, inserted, why);
	return ladder_document_splice(view->document, view->pou, view->first + at, removed,
				      rungs, inserted, why);
}

void sheet_tell(LadderGridView *view, const char *text)
{
	g_signal_emit(view, signals[TOLD], 0, text);
}

void sheet_moved(LadderGridView *view)
{
	keys_moved(view);
	g_signal_emit(view, signals[CURSOR_MOVED], 0);
}

/* ---- size and scrolling ---- */

static void configure(GtkAdjustment *adjustment, double content, double page)
{
	double value, upper = MAX(content, page);

	if (!adjustment)
		return;
	value = CLAMP(gtk_adjustment_get_value(adjustment), 0, upper - page);
	gtk_adjustment_configure(adjustment, value, 0, upper, 40, page * 0.9, page);
}

static void ladder_grid_view_size_allocate(GtkWidget *widget, int width, int height,
					   int baseline)
{
	LadderGridView *view = LADDER_GRID_VIEW(widget);

	(void)baseline;
	view->allocating = true;
	strips_lay_out(view, height);
	configure(view->adjustment[0], strips_width(view) * view->zoom, width);
	configure(view->adjustment[1], (strips_height(view) + BELOW) * view->zoom, height);
	cursor_reveal_late(view, height);
	if (height != view->cells_height)
		cells_later(view);
	view->cells_height = height;
	cells_allocate(view);
	entry_allocate(view);
	view->allocating = false;
}

static void ladder_grid_view_measure(GtkWidget *widget, GtkOrientation orientation,
				     int for_size, int *least, int *natural, int *least_base,
				     int *natural_base)
{
	LadderGridView *view = LADDER_GRID_VIEW(widget);

	(void)for_size;
	*least = 100;
	*natural = orientation == GTK_ORIENTATION_HORIZONTAL ?
		   (int)(strips_width(view) * view->zoom) : 400;
	*least_base = *natural_base = -1;
}

/* Nothing but the drawing follows at once: to allocate the window and the cells that
 * assistive technology sees would take longer than to draw. */
static void scrolled(LadderGridView *view)
{
	cells_scrolled(view);
	if (!view->allocating) {
		view->allocating = true; /* rungs that grow above may scroll it */
		strips_lay_out(view, gtk_widget_get_height(GTK_WIDGET(view)));
		view->allocating = false;
		if (view->entry)
			gtk_widget_queue_allocate(GTK_WIDGET(view));
	}
	strips_draw_ahead(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void set_adjustment(LadderGridView *view, int which, GtkAdjustment *adjustment)
{
	if (view->adjustment[which])
		g_signal_handler_disconnect(view->adjustment[which],
					    view->scrolled[which]);
	if (!adjustment)
		adjustment = gtk_adjustment_new(0, 0, 0, 0, 0, 0);
	g_set_object(&view->adjustment[which], adjustment);
	view->scrolled[which] = g_signal_connect_swapped(view->adjustment[which],
		"value-changed", G_CALLBACK(scrolled), view);
	gtk_widget_queue_resize(GTK_WIDGET(view));
}

/* An empty sheet says what to do. */
static bool is_blank(LadderGridView *view)
{
	const struct rung *rung = sheet_rungs(view) == 1 ? sheet_rung(view, 0) : NULL;

	for (int i = 0; rung && i < rung->rows * rung->cols; i++)
		if (rung->cell[i].word != ELEM_EMPTY)
			return false;
	return rung != NULL;
}

static void snapshot_hint(LadderGridView *view, GtkSnapshot *snapshot,
			  const struct theme *theme)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(view),
		_("Type a name, such as Start, and press Enter: a contact.\n"
		  "Type OUT Motor: a coil. Type TON: a timer. All dialects are understood.\n"
		  "Or drag an element from the left, and wires from the ends of elements.\n"
		  "F5 contact, F6 negated, F7 coil, Shift+F5 in parallel, "
		  "Ins new rung."));

	pango_layout_set_spacing(layout, 6 * PANGO_SCALE);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(
		(float)(RUNG_LEFT * view->zoom),
		(float)((strips_height(view) + 24) * view->zoom)));
	gtk_snapshot_append_layout(snapshot, layout, &theme->color[TOKEN_COMMENT]);
	gtk_snapshot_restore(snapshot);
	g_object_unref(layout);
}

static void ladder_grid_view_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderGridView *view = LADDER_GRID_VIEW(widget);
	const struct theme *theme = strips_theme(view);
	const float width = (float)gtk_widget_get_width(widget);
	const float height = (float)gtk_widget_get_height(widget);

	gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(0, 0, width, height));
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET],
				  &GRAPHENE_RECT_INIT(0, 0, width, height));
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_GUTTER],
		&GRAPHENE_RECT_INIT((float)-gtk_adjustment_get_value(view->adjustment[0]),
				    0, (float)(RUNG_GUTTER * view->zoom), height));
	strips_snapshot(view, snapshot);
	wire_snapshot(view, snapshot, theme);
	drop_snapshot(view, snapshot, theme);
	keys_snapshot(view, snapshot, theme);
	if (is_blank(view))
		snapshot_hint(view, snapshot, theme);
	gtk_snapshot_pop(snapshot);
}

/* ---- what is heard of the document ---- */

static void forget_edit(LadderGridView *view)
{
	entry_close(view);
	entry_forget_uses(view);
	wire_forget(view);
	g_clear_pointer(&view->preview, rung_free);
}

static void rungs_changed(LadderGridView *view, int pou, int at, int removed, int inserted)
{
	entry_forget_uses(view);
	if (pou != view->pou)
		return;
	at -= view->first;
	if (view->count >= 0 && (at < 0 || at + removed > view->count)) {
		if (at < 0 && inserted != removed) { /* of a body above */
			view->first += inserted - removed;
			strips_renumber(view);
		}
		return;
	}
	if (view->count >= 0)
		view->count += inserted - removed;
	strips_stale(view, at, removed); /* a popup that closes asks where the cursor is */
	forget_edit(view);
	ladder_grid_view_set_blockers(view, -1, NULL, 0);
	if (removed != inserted) {
		view->came_rung = -1;
		cells_tell_again(view);
	}
	strips_splice(view, at, removed, inserted);
	cursor_fit(view);
	sheet_moved(view);
}

static void variable_changed(LadderGridView *view, int pou, const char *name,
			     const char *address)
{
	entry_forget_uses(view);
	if (pou >= 0 && pou != view->pou)
		return;
	strips_renamed(view, name, address);
	cells_later(view);
}

static void project_changed(LadderGridView *view)
{
	/* Before a popup closes, which gives the keys back: they ask where the cursor is. */
	g_clear_pointer(&view->preview, rung_free);
	live_forget_all(view);
	strips_reset(view);
	cursor_fit(view);
	forget_edit(view);
	ladder_grid_view_set_blockers(view, -1, NULL, 0);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	sheet_moved(view);
}

static void add_mark(LadderGridView *view, const struct diag *diag)
{
	const bool error = diag_severity(diag->id) == SEVERITY_ERROR;
	struct sheet_mark mark = {
		diag->rung - 1 - view->first, diag->row - 1, diag->col - 1,
		error ? MARK_ERROR : MARK_WARNING, diag,
	};

	if (diag->id == DIAG_COIL_TWICE)
		mark.marks = MARK_TWICE;
	g_array_append_val(view->marks, mark);
}

static void checked(LadderGridView *view)
{
	const struct diag_list *diags = ladder_document_diags(view->document);
	const struct pou *pou = sheet_pou(view);
	const struct project *project = ladder_document_project(view->document);

	g_array_set_size(view->marks, 0);
	for (int i = 0; pou && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag->rung > view->first &&
		    diag->rung <= view->first + sheet_rungs(view) && diag->pou &&
		    strcmp(diag->pou, project_text(project, pou->name)) == 0)
			add_mark(view, diag);
	}
	strips_redraw(view, -1);
}

static void bookmarks_changed(LadderGridView *view)
{
	strips_redraw(view, -1);
}

static void listen(LadderGridView *view)
{
	view->handler[0] = g_signal_connect_swapped(view->document, "rungs-changed",
		G_CALLBACK(rungs_changed), view);
	view->handler[1] = g_signal_connect_swapped(view->document, "project-changed",
		G_CALLBACK(project_changed), view);
	view->handler[3] = g_signal_connect_swapped(view->document, "bookmarks-changed",
		G_CALLBACK(bookmarks_changed), view);
	view->handler[4] = g_signal_connect_swapped(view->document, "variable-changed",
		G_CALLBACK(variable_changed), view);
	view->handler[2] = g_signal_connect_swapped(view->document, "checked",
		G_CALLBACK(checked), view);
}

/* ---- from outside ---- */

int ladder_grid_view_pou(LadderGridView *view)
{
	return view->pou;
}

void ladder_grid_view_set_pou(LadderGridView *view, int pou)
{
	view->pou = pou;
	project_changed(view);
}

void ladder_grid_view_set_range(LadderGridView *view, int first, int count)
{
	view->first = first;
	view->count = count;
	project_changed(view);
	checked(view);
}

int ladder_grid_view_range(LadderGridView *view, int *count)
{
	*count = view->count;
	return view->first;
}

int ladder_grid_view_first(LadderGridView *view)
{
	return view->first;
}

struct grid_cursor ladder_grid_view_cursor(LadderGridView *view)
{
	return view->cursor;
}

void ladder_grid_view_go(LadderGridView *view, int rung, int row, int col)
{
	struct grid_cursor to = { MAX(rung, 0), MAX(row, 0), MAX(col, 0) };
	const struct rung *shown;

	entry_close(view);
	shown = sheet_rung(view, to.rung);
	if (shown && col >= 0 && to.row < shown->rows && to.col < shown->cols)
		to.col = grid_display_column(shown, view->columns, to.row, to.col);
	cursor_set(view, to, false);
	cursor_reveal_head(view);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

bool ladder_grid_view_cell(LadderGridView *view, int *row, int *col)
{
	return cursor_cell(view, row, col) != NULL;
}

static char *place_of(LadderGridView *view)
{
	const int rung = view->first + view->cursor.rung + 1, row = view->cursor.row + 1;
	char column[PLACE_LETTERS];

	if (sheet_rungs(view) == 0)
		return g_strdup(_("no rung"));
	place_column(view->cursor.col, column);
	return row > 1 ? g_strdup_printf(_("Rung %d · row %d · column %s"), rung, row, column) :
	       g_strdup_printf(_("Rung %d · column %s"), rung, column);
}

/* Of a block also the instance whose body it is. */
char *ladder_grid_view_place(LadderGridView *view)
{
	const char *instance = ladder_grid_view_instance(view);
	char *place = place_of(view), *whole;

	if (!instance)
		return place;
	whole = g_strdup_printf("%s · %s", place, instance);
	g_free(place);
	return whole;
}

double ladder_grid_view_zoom(LadderGridView *view)
{
	return view->zoom;
}

/* What is in the middle stays there. */
void sheet_zoom(LadderGridView *view, double zoom)
{
	GtkAdjustment *down = view->adjustment[1];
	const double middle = gtk_adjustment_get_page_size(down) / 2;
	const double at = (gtk_adjustment_get_value(down) + middle) / view->zoom;

	zoom = CLAMP(zoom, ZOOM_LEAST, ZOOM_MOST);
	if (zoom == view->zoom)
		return;
	view->zoom = zoom;
	gtk_adjustment_set_upper(down, (strips_height(view) + BELOW) * zoom);
	gtk_adjustment_set_value(down, at * zoom - middle);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	strips_redraw(view, -1); /* images of it have their size              */
	g_signal_emit(view, signals[ZOOM_CHANGED], 0);
}

void ladder_grid_view_set_show(LadderGridView *view, enum drafting_show show)
{
	view->drafting.show = show;
	strips_reset(view);
	gtk_widget_queue_resize(GTK_WIDGET(view));
}

enum drafting_show ladder_grid_view_show(LadderGridView *view)
{
	return view->drafting.show;
}

void ladder_grid_view_set_found(LadderGridView *view, int rung, int row, int col)
{
	const int before = view->found.rung;
	const struct rung *shown = sheet_rung(view, rung);

	view->found = (struct grid_cursor){ rung, row, col };
	if (shown && row >= 0 && row < shown->rows && col >= 0 && col < shown->cols)
		view->found.col = grid_display_column(shown, view->columns, row, col);
	strips_redraw(view, before);
	strips_redraw(view, rung);
}

/* ---- life ---- */

static void ladder_grid_view_get_property(GObject *object, guint id, GValue *value,
					  GParamSpec *spec)
{
	LadderGridView *view = LADDER_GRID_VIEW(object);

	if (id == PROP_HADJUSTMENT || id == PROP_VADJUSTMENT)
		g_value_set_object(value, view->adjustment[id - PROP_HADJUSTMENT]);
	else if (id == PROP_HPOLICY || id == PROP_VPOLICY)
		g_value_set_enum(value, (int)view->policy[id - PROP_HPOLICY]);
	else
		G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void ladder_grid_view_set_property(GObject *object, guint id, const GValue *value,
					  GParamSpec *spec)
{
	LadderGridView *view = LADDER_GRID_VIEW(object);

	if (id == PROP_HADJUSTMENT || id == PROP_VADJUSTMENT)
		set_adjustment(view, (int)id - PROP_HADJUSTMENT, g_value_get_object(value));
	else if (id == PROP_HPOLICY || id == PROP_VPOLICY)
		view->policy[id - PROP_HPOLICY] =
			(GtkScrollablePolicy)g_value_get_enum(value);
	else
		G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void ladder_grid_view_dispose(GObject *object)
{
	LadderGridView *view = LADDER_GRID_VIEW(object);

	entry_close(view);
	ladder_entry_popup_drop(GTK_WIDGET(view));
	edge_forget(view);
	live_clear(view);
	cells_clear(view);
	for (int i = 0; i < 2; i++) {
		if (view->adjustment[i])
			g_signal_handler_disconnect(view->adjustment[i],
						    view->scrolled[i]);
		g_clear_object(&view->adjustment[i]);
	}
	for (int i = 0; view->document && i < (int)G_N_ELEMENTS(view->handler); i++)
		g_signal_handler_disconnect(view->document, view->handler[i]);
	strips_clear(view);
	g_clear_object(&view->input);
	g_clear_object(&view->document);
	G_OBJECT_CLASS(ladder_grid_view_parent_class)->dispose(object);
}

static void ladder_grid_view_finalize(GObject *object)
{
	LadderGridView *view = LADDER_GRID_VIEW(object);

	entry_forget_uses(view);
	g_free(view->wire.legal);
	g_free(view->composed);
	rung_free(view->preview);
	g_array_unref(view->strips);
	g_array_unref(view->marks);
	g_array_unref(view->cells);
	g_clear_pointer(&view->live.blockers, g_array_unref);
	G_OBJECT_CLASS(ladder_grid_view_parent_class)->finalize(object);
}

static void ladder_grid_view_class_init(LadderGridViewClass *class)
{
	GObjectClass *object = G_OBJECT_CLASS(class);
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
	const GType type = G_TYPE_FROM_CLASS(class);

	object->get_property = ladder_grid_view_get_property;
	object->set_property = ladder_grid_view_set_property;
	object->dispose = ladder_grid_view_dispose;
	object->finalize = ladder_grid_view_finalize;
	widget->measure = ladder_grid_view_measure;
	widget->size_allocate = ladder_grid_view_size_allocate;
	widget->snapshot = ladder_grid_view_snapshot;
	g_object_class_override_property(object, PROP_HADJUSTMENT, "hadjustment");
	g_object_class_override_property(object, PROP_VADJUSTMENT, "vadjustment");
	g_object_class_override_property(object, PROP_HPOLICY, "hscroll-policy");
	g_object_class_override_property(object, PROP_VPOLICY, "vscroll-policy");
	signals[CURSOR_MOVED] = g_signal_new("cursor-moved", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 1, G_TYPE_STRING);
	signals[ZOOM_CHANGED] = g_signal_new("zoom-changed", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	gtk_widget_class_set_css_name(widget, "sheet");
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GRID);
}

static void ladder_grid_view_init(LadderGridView *view)
{
	view->zoom = CLAMP(settings_number("zoom", 1.0), ZOOM_LEAST, ZOOM_MOST);
	view->drafting.show = (enum drafting_show)settings_enum("show", SHOW_BOTH);
	view->strips = g_array_new(FALSE, TRUE, sizeof(struct strip));
	view->marks = g_array_new(FALSE, TRUE, sizeof(struct sheet_mark));
	view->cells = g_array_new(FALSE, TRUE, sizeof(struct cell_widget));
	view->count = -1;
	view->found.rung = view->drop.rung = view->came_rung = view->drop_line = -1;
	set_adjustment(view, 0, NULL);
	set_adjustment(view, 1, NULL);
	gtk_widget_set_focusable(GTK_WIDGET(view), TRUE);
	gtk_widget_set_overflow(GTK_WIDGET(view), GTK_OVERFLOW_HIDDEN);
	keys_init(view);
	live_init(view);
	mouse_init(view);
	wire_init(view);
	cells_init(view);
	tell_init(view);
}

GtkWidget *ladder_grid_view_new(LadderDocument *document, int pou)
{
	LadderGridView *view = g_object_new(LADDER_TYPE_GRID_VIEW, NULL);

	view->document = g_object_ref(document);
	view->pou = pou;
	strips_init(view);
	listen(view);
	checked(view);
	return GTK_WIDGET(view);
}
