/* SPDX-License-Identifier: MIT
 *
 * grid_view_strips - the strips of a sheet: a rung each, one below the other.
 *
 * A rung is laid out when it becomes visible or when the program is idle; until then its height
 * is a guess. It is drawn into one render node, kept until the rung changes or is far away, so
 * that scrolling redraws nothing. A strip far away keeps only its height.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/draw/rung_fold.h"
#include "editor-gtk/kit/settings.h"

#include <math.h>
#include <string.h>

#define TITLE_GUESS  32 /* px above the first row of a rung                    */
#define IDLE_RUNGS   64 /* laid out in one idle call                           */
#define NEAR_RUNGS   40 /* kept above and below the visible ones               */

/* ---- which rungs ---- */

struct pou *sheet_pou(LadderGridView *view)
{
	struct project *project = ladder_document_project(view->canvas->document);

	return project && view->canvas->pou < project->pou_count &&
	       (project->pou[view->canvas->pou].language == LANGUAGE_LD ||
		(project->pou[view->canvas->pou].sfc && view->count >= 0)) ?
	       &project->pou[view->canvas->pou] : NULL;
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
	return view->preview && rung == view->cursor.at.rung ? view->preview :
	       pou->rung[view->first + rung];
}

/* A change in a body of a chart includes a copy of the rung beside it, so that the document
 * knows which body changes. */
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
	good = ladder_document_splice(view->canvas->document, view->canvas->pou,
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
	return ladder_document_splice(view->canvas->document, view->canvas->pou,
				      view->first + at, removed, rungs, inserted, why);
}

/* ---- strips ---- */

void strip_forget_live(struct strip *strip)
{
	g_clear_pointer(&strip->live, live_rung_free);
	strip->looked = 0;
}

static void forget_drawing(struct strip *strip)
{
	g_clear_pointer(&strip->node, gsk_render_node_unref);
}

static void forget(struct strip *strip)
{
	forget_drawing(strip);
	strip_forget_live(strip);
	g_clear_pointer(&strip->fold, g_free);
	g_clear_pointer(&strip->layout, rung_layout_free);
}

static void guess(LadderGridView *view, int rung)
{
	const struct rung *shown = sheet_rung(view, rung);
	struct strip *strip = strip_of(view, rung);

	forget(strip);
	strip->measured = false;
	if (shown)
		strip->height = TITLE_GUESS + (float)shown->rows * RUNG_CELL_HEIGHT;
}

/* A folded rung keeps its height until it is laid out again, because a guess would be far off: a pointer that is
 * over it must not meet another rung. */
static void renew(LadderGridView *view, int rung)
{
	struct strip *strip = strip_of(view, rung);

	if (!strip->fold) {
		guess(view, rung);
		return;
	}
	forget(strip);
	strip->measured = false;
}

static void stack(LadderGridView *view, int from)
{
	float y = 0;

	if (from > 0)
		y = strip_of(view, from - 1)->y + strip_of(view, from - 1)->height;
	for (guint i = (guint)from; i < view->strips->len; i++) {
		struct strip *strip = strip_of(view, (int)i);

		strip->y = y;
		y += strip->height;
	}
}

static void share_names(LadderGridView *view)
{
	const struct pou *pou = sheet_pou(view);
	struct project *project = ladder_document_project(view->canvas->document);

	grid_names_free(view->names);
	view->names = project && pou ? grid_names_new(project, pou) : NULL;
	view->drafting.project = project;
	view->drafting.names = view->names;
}

/* The number of columns that all rungs share. */
static void share_columns(LadderGridView *view)
{
	int columns = RUNG_LEAST_COLUMNS;

	for (int i = 0; i < sheet_rungs(view); i++)
		columns = grid_display_columns(sheet_rung(view, i), columns);
	view->columns = columns;
	view->drafting.columns = columns;
}

/* GTK ignores a request for another size while it allocates or draws. */
static gboolean resize_now(gpointer data)
{
	LadderGridView *view = data;

	view->resize = 0;
	canvas_cells_later(LADDER_CANVAS(view));
	gtk_widget_queue_resize(GTK_WIDGET(view));
	return G_SOURCE_REMOVE;
}

void strips_resize_later(LadderGridView *view)
{
	if (!view->resize)
		view->resize = g_idle_add_full(G_PRIORITY_HIGH_IDLE, resize_now, view,
					       NULL);
}

static void forget_far(LadderGridView *view)
{
	const double top = gtk_adjustment_get_value(view->canvas->adjustment[1]) / view->canvas->zoom;
	const double page = gtk_adjustment_get_page_size(view->canvas->adjustment[1]);
	const int first = strips_at(view, (float)top) - NEAR_RUNGS;
	const int last = strips_at(view, (float)(top + page / view->canvas->zoom)) + NEAR_RUNGS;

	for (int i = 0; i < (int)view->strips->len; i++)
		if ((i < first || i > last) && i != view->cursor.at.rung)
			forget(strip_of(view, i));
	view->forgot_at = first;
}

/* Not at each step of the wheel: forget_far() visits all rungs. */
static void forget_behind(LadderGridView *view)
{
	const double top = gtk_adjustment_get_value(view->canvas->adjustment[1]) / view->canvas->zoom;
	const int first = strips_at(view, (float)top) - NEAR_RUNGS;

	if (ABS(first - view->forgot_at) >= NEAR_RUNGS / 2)
		forget_far(view);
}

static gboolean lay_out_more(gpointer data)
{
	LadderGridView *view = data;
	const int rungs = sheet_rungs(view);
	int done = 0;

	for (int i = 0; i < rungs && done < IDLE_RUNGS; i++)
		if (!strip_of(view, i)->measured) {
			strips_get(view, i);
			done++;
		}
	forget_far(view);
	lettering_trim(view->canvas->lettering);
	if (done > 0)
		return G_SOURCE_CONTINUE;
	view->idle = 0;
	return G_SOURCE_REMOVE;
}

/* Also asks for another size, which redraws. */
static void lay_out_later(LadderGridView *view)
{
	if (!view->idle)
		view->idle = g_idle_add_full(G_PRIORITY_LOW, lay_out_more, view, NULL);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

/* ---- changes ---- */

void strips_reset(LadderGridView *view)
{
	const int rungs = sheet_rungs(view);

	for (guint i = 0; i < view->strips->len; i++)
		forget(strip_of(view, (int)i));
	g_array_set_size(view->strips, (guint)rungs);
	share_names(view);
	share_columns(view);
	view->natural = view->rail = 0;
	for (int i = 0; i < rungs; i++)
		guess(view, i);
	stack(view, 0);
	lay_out_later(view);
}

static void forget_some(LadderGridView *view, int at, int count)
{
	for (int i = at; i < at + count && i < (int)view->strips->len; i++)
		forget(strip_of(view, i));
}

/* Only the number of the rung changed. */
static void renumber(LadderGridView *view, int rung)
{
	struct strip *strip = strip_of(view, rung);

	forget_drawing(strip);
	strip_forget_live(strip);
	if (strip->layout)
		strip->layout->number = view->first + rung + 1;
}

void strips_renumber(LadderGridView *view)
{
	for (int i = 0; i < (int)view->strips->len; i++)
		renumber(view, i);
	canvas_cells_later(LADDER_CANVAS(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void strips_splice(LadderGridView *view, int at, int removed, int inserted)
{
	const struct strip none = { 0 };
	const int columns = view->columns;

	forget_some(view, at, removed);
	g_array_remove_range(view->strips, (guint)at, (guint)removed);
	for (int i = 0; i < inserted; i++)
		g_array_insert_val(view->strips, (guint)at, none);
	share_columns(view);
	if (columns != view->columns) {
		strips_reset(view);
		return;
	}
	for (int i = at; i < at + inserted; i++)
		guess(view, i);
	for (int i = at + inserted; removed != inserted && i < (int)view->strips->len; i++)
		renumber(view, i);
	stack(view, at);
	lay_out_later(view);
}

static bool names_one(LadderGridView *view, int rung, uint32_t name, uint32_t address)
{
	const struct rung *shown = sheet_rung(view, rung);
	const struct names *names = &view->drafting.project->names;

	for (int i = 0; shown && i < shown->rows * shown->cols; i++) {
		const uint32_t fold = names_fold(names, shown->cell[i].operand);

		if (fold && (fold == name || fold == address))
			return true;
	}
	return false;
}

void strips_renamed(LadderGridView *view, const char *name, const char *address)
{
	struct names *names = &ladder_document_project(view->canvas->document)->names;
	const uint32_t of = names_find_any(names, name, strlen(name));
	const uint32_t at = names_find_any(names, address, strlen(address));

	share_names(view);
	for (int i = 0; i < (int)view->strips->len; i++)
		if (names_one(view, i, of, at))
			renew(view, i);
	stack(view, 0);
	lay_out_later(view);
}

void strips_dirty(LadderGridView *view, int rung)
{
	if (rung < 0 || rung >= (int)view->strips->len)
		return;
	if (grid_display_columns(sheet_rung(view, rung), 0) > view->columns) {
		strips_reset(view);
		return;
	}
	renew(view, rung);
	stack(view, rung);
	lay_out_later(view);
}

void strips_redraw(LadderGridView *view, int rung)
{
	for (int i = rung < 0 ? 0 : rung;
	     i < (int)view->strips->len && (rung < 0 || i == rung); i++)
		forget_drawing(strip_of(view, i));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

/* ---- laying out ---- */

/* A rung that is folded, or must be now, is laid out again: its title has another width, too. */
static void fit_strip(LadderGridView *view, struct strip *strip)
{
	if (strip->fold || (view->drafting.folds && strip->layout->tight > view->rail)) {
		forget(strip);
		strip->measured = false;
		return;
	}
	rung_layout_fit(strip->layout, view->rail);
	forget_drawing(strip);
}

/* All rungs have the same right rail: at the edge of the page, or that of the widest rung. */
static void widen(LadderGridView *view)
{
	const double page = gtk_widget_get_width(GTK_WIDGET(view)) / view->canvas->zoom;
	const float rail = MAX(view->natural, MIN((float)floor(page) - RUNG_LEFT - RUNG_AFTER,
						  RUNG_WIDE));

	/* The row for a wire may make a scrollbar appear: nothing may be folded anew below the pointer. */
	if (rail == view->rail || (view->wire.drawing && view->rail > 0 && rail >= view->natural))
		return;
	view->rail = rail;
	for (guint i = 0; i < view->strips->len; i++)
		if (strip_of(view, (int)i)->layout)
			fit_strip(view, strip_of(view, (int)i));
	if (view->drafting.folds && !view->idle)
		view->idle = g_idle_add_full(G_PRIORITY_LOW, lay_out_more, view, NULL);
	strips_resize_later(view);
}

/* ---- folding ---- */

/* Shows the rows where the cursor is, where a wire may end. */
static bool place_fold(LadderGridView *view, struct strip *strip, int rung)
{
	struct rung_fold_wish wish[2];
	int wishes = 0;

	if (rung == view->cursor.at.rung)
		wish[wishes++] = (struct rung_fold_wish){ view->cursor.at.row, view->cursor.at.col, false };
	if (rung == view->wire.rung && view->wire.drawing)
		wish[wishes++] = (struct rung_fold_wish){ view->wire.rows - 1,
							  strip->fold->line[view->wire.line].first, true };
	return rung_fold_place(strip->fold, strip->layout, wish, wishes);
}

void strip_follow(LadderGridView *view, int rung)
{
	struct strip *strip = rung >= 0 && rung < (int)view->strips->len ? strip_of(view, rung) : NULL;

	if (!strip || !strip->fold || !place_fold(view, strip, rung))
		return;
	strip->height = strip->fold->height;
	forget_drawing(strip);
	stack(view, rung);
	strips_resize_later(view);
}

/* Lays a rung out. One that is too wide is folded; its title has no more room than the page. */
static void lay_out(LadderGridView *view, struct strip *strip, int rung, int rows)
{
	const struct rung *shown = sheet_rung(view, rung);
	const int number = view->first + rung + 1;
	struct drafting narrow = view->drafting;
	const struct rung_layout *layout = strip->layout = rung_layout_new(&view->drafting, shown, number, rows);
	const float least = view->drafting.folds ? MIN(layout->tight, rung_fold_room(layout)) : layout->tight;

	view->natural = MAX(view->natural, least);
	widen(view);
	if (strip->layout && !(view->drafting.folds && strip->layout->tight > view->rail)) {
		rung_layout_fit(strip->layout, view->rail);
		return;
	}
	narrow.most = view->rail;
	rung_layout_free(strip->layout);
	strip->layout = rung_layout_new(&narrow, shown, number, rows);
	strip->fold = rung_fold_new(strip->layout, view->rail);
	place_fold(view, strip, rung);
}

/* If a rung above the screen grows, the screen keeps showing the same rungs. */
static void keep_view(LadderGridView *view, const struct strip *strip, float grown)
{
	GtkAdjustment *down = view->canvas->adjustment[1];
	const double value = gtk_adjustment_get_value(down);

	if (strip->y * view->canvas->zoom >= value)
		return;
	gtk_adjustment_set_upper(down, gtk_adjustment_get_upper(down) +
				 grown * view->canvas->zoom);
	gtk_adjustment_set_value(down, value + grown * view->canvas->zoom);
}

struct strip *strips_get(LadderGridView *view, int rung)
{
	struct strip *strip = strip_of(view, rung);
	const struct rung *shown = sheet_rung(view, rung);
	int rows = 0;
	float grown;

	if (strip->layout || !shown)
		return strip;
	if (rung == view->cursor.at.rung)
		rows = view->cursor.at.row + 1;
	if (rung == view->wire.rung && view->wire.drawing)
		rows = MAX(rows, view->wire.rows); /* the wire may end in a new row */
	lay_out(view, strip, rung, rows);
	strip->measured = true;
	grown = (strip->fold ? strip->fold->height : strip->layout->height) - strip->height;
	strip->height += grown;
	if (grown != 0) {
		stack(view, rung);
		keep_view(view, strip, grown);
		strips_resize_later(view);
	}
	return strip;
}

void strips_lay_out(LadderCanvas *canvas, double page)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	widen(view);
	for (int i = 0; i < (int)view->strips->len; i++) {
		const double top = gtk_adjustment_get_value(view->canvas->adjustment[1]);
		const int first = strips_at(view, (float)(top / view->canvas->zoom));

		if (strip_of(view, i = MAX(i, first))->y * view->canvas->zoom > top + page)
			break;
		strips_get(view, i);
	}
	forget_behind(view);
}

int strips_at(LadderGridView *view, float y)
{
	int low = 0, high = (int)view->strips->len - 1;

	while (low < high) {
		const int middle = (low + high + 1) / 2;

		if (strip_of(view, middle)->y <= y)
			low = middle;
		else
			high = middle - 1;
	}
	return high < 0 ? -1 : low;
}

/* Outputs that are moved left by @by px of the widget cut no element: one that is in their way is
 * hidden wholly. px at 100 %. */
static float pin_edge(LadderGridView *view, struct rung_layout *layout, float by)
{
	return rung_layout_whole(&view->drafting, layout, layout->column_x[layout->columns - 1] -
							  by / (float)view->canvas->zoom);
}

float strips_pinned(LadderGridView *view, const struct strip *strip)
{
	const float page = (float)gtk_widget_get_width(GTK_WIDGET(view));
	const float x = (float)gtk_adjustment_get_value(view->canvas->adjustment[0]);
	const float by = strips_width(view) * (float)view->canvas->zoom - x - page;
	struct rung_layout *layout = strip->layout;

	return by > 0 && layout && !strip->fold &&
	       (strips_width(view) - layout->column_x[layout->columns - 1]) *
	       (float)view->canvas->zoom < page / 2 &&
	       pin_edge(view, layout, by) * (float)view->canvas->zoom - x > page / 4 ? by : 0;
}

float strips_pin_edge(LadderGridView *view, const struct strip *strip)
{
	return pin_edge(view, strip->layout, strips_pinned(view, strip));
}

graphene_point_t strip_shown(LadderGridView *view, const struct strip *strip, float x, float y)
{
	graphene_point_t at = { x, y };

	if (strip->fold)
		at = rung_fold_shown(strip->fold, x, y);
	else if (x >= strip->layout->column_x[strip->layout->columns - 1])
		at.x -= strips_pinned(view, strip) / (float)view->canvas->zoom;
	at.y += strip->y;
	return at;
}

graphene_point_t strip_laid(LadderGridView *view, const struct strip *strip, graphene_point_t shown)
{
	graphene_point_t at = { shown.x, shown.y - strip->y };
	float by;

	if (!strip->layout)
		return at;
	if (strip->fold)
		return rung_fold_laid(strip->fold, strip->layout, at.x, at.y);
	by = strips_pinned(view, strip) / (float)view->canvas->zoom;
	if (by > 0 && at.x + by >= strip->layout->column_x[strip->layout->columns - 1])
		at.x += by;
	return at;
}

graphene_rect_t strip_box(LadderGridView *view, const struct strip *strip, int row, int column)
{
	graphene_rect_t box = rung_layout_cell(strip->layout, row, column);
	const float middle = box.size.width / 2;
	const graphene_point_t at = strip_shown(view, strip, box.origin.x + middle, box.origin.y);

	box.origin = GRAPHENE_POINT_INIT(at.x - middle, at.y);
	return box;
}

float strips_width(LadderGridView *view)
{
	return RUNG_LEFT + MAX(view->rail, RUNG_LEAST_COLUMNS * RUNG_TIGHT_WIDTH) +
	       RUNG_AFTER;
}

float strips_height(LadderGridView *view)
{
	const guint count = view->strips->len;

	return count ? strip_of(view, (int)count - 1)->y +
		       strip_of(view, (int)count - 1)->height : 0;
}

/* ---- life ---- */

void ladder_grid_view_set_show(LadderGridView *view, enum drafting_show show)
{
	view->drafting.show = show;
	strips_reset(view);
}

static void show_chosen(LadderGridView *view)
{
	ladder_grid_view_set_show(view, (enum drafting_show)settings_enum("show", SHOW_BOTH));
}

void strips_init(LadderGridView *view)
{
	view->strips = g_array_new(FALSE, TRUE, sizeof(struct strip));
	view->drafting.show = (enum drafting_show)settings_enum("show", SHOW_BOTH);
	view->drafting.folds = settings_flag("fold-rungs", FALSE);
	if (settings_get())
		g_signal_connect_object(settings_get(), "changed::show",
					G_CALLBACK(show_chosen), view, G_CONNECT_SWAPPED);
}

void strips_clear(LadderGridView *view)
{
	g_clear_handle_id(&view->idle, g_source_remove);
	g_clear_handle_id(&view->resize, g_source_remove);
	for (guint i = 0; i < view->strips->len; i++)
		forget(strip_of(view, (int)i));
	g_array_set_size(view->strips, 0);
	g_clear_pointer(&view->names, grid_names_free);
}
