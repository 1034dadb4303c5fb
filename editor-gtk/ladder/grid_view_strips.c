/* SPDX-License-Identifier: MIT
 *
 * grid_view_strips - the rungs of a sheet one below the other.
 *
 * A rung is laid out when it is seen, or when nothing else is to be done; until then its
 * height is guessed. It is drawn into one render node, which lives until something of it
 * changes or it is far away, so that scrolling draws nothing anew. Of what is far away
 * the height alone is kept.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/settings.h"

#include <adwaita.h>
#include <string.h>

#define TITLE_GUESS  32 /* px above the first row of a rung                    */
#define IDLE_RUNGS   64 /* laid out at a time while nothing else is done       */
#define NEAR_RUNGS   40 /* kept above and below what is seen                   */
#define AHEAD       1.3 /* pages above and below that are drawn before          */

static struct strip *strip_of(LadderGridView *view, int rung)
{
	return &g_array_index(view->strips, struct strip, rung);
}

/* Asked for once: a setting is looked up by names, which takes as long as a few wires. */
const struct theme *strips_theme(LadderGridView *view)
{
	AdwStyleManager *manager = adw_style_manager_get_default();
	const bool dark = adw_style_manager_get_dark(manager);
	const bool contrast = adw_style_manager_get_high_contrast(manager);

	if (!view->theme)
		view->theme = theme_get(contrast ? dark ? THEME_CONTRAST_DARK : THEME_CONTRAST :
					dark ? THEME_DARK : THEME_LIGHT,
			(enum theme_power)settings_enum("power", THEME_GREEN));
	return view->theme;
}

/* ---- what is remembered ---- */

static void forget_drawing(struct strip *strip)
{
	g_clear_pointer(&strip->node, gsk_render_node_unref);
}

static void forget(struct strip *strip)
{
	forget_drawing(strip);
	live_forget(strip);
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
	struct project *project = ladder_document_project(view->document);

	grid_names_free(view->names);
	view->names = project && pou ? grid_names_new(project, pou) : NULL;
	view->drafting.project = project;
	view->drafting.names = view->names;
	view->drafting.lettering = view->lettering;
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

/* While the window is allocated or drawn nobody may ask for another size. */
static gboolean resize_now(gpointer data)
{
	LadderGridView *view = data;

	view->resize = 0;
	cells_later(view);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	return G_SOURCE_REMOVE;
}

static void resize_later(LadderGridView *view)
{
	if (!view->resize)
		view->resize = g_idle_add_full(G_PRIORITY_HIGH_IDLE, resize_now, view,
					       NULL);
}

static void forget_far(LadderGridView *view)
{
	const double top = gtk_adjustment_get_value(view->adjustment[1]) / view->zoom;
	const double page = gtk_adjustment_get_page_size(view->adjustment[1]);
	const int first = strips_at(view, (float)top) - NEAR_RUNGS;
	const int last = strips_at(view, (float)(top + page / view->zoom)) + NEAR_RUNGS;

	for (int i = 0; i < (int)view->strips->len; i++)
		if ((i < first || i > last) && i != view->cursor.rung)
			forget(strip_of(view, i));
	view->forgot_at = first;
}

/* To look at all rungs for each step of a wheel would take a part of its frame. */
static void forget_behind(LadderGridView *view)
{
	const double top = gtk_adjustment_get_value(view->adjustment[1]) / view->zoom;
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
	lettering_trim(view->lettering);
	if (done > 0)
		return G_SOURCE_CONTINUE;
	view->idle = 0;
	return G_SOURCE_REMOVE;
}

static void lay_out_later(LadderGridView *view)
{
	if (!view->idle)
		view->idle = g_idle_add_full(G_PRIORITY_LOW, lay_out_more, view, NULL);
}

/* ---- what changes ---- */

void strips_reset(LadderGridView *view)
{
	const int rungs = sheet_rungs(view);

	for (guint i = 0; i < view->strips->len; i++)
		forget(strip_of(view, (int)i));
	g_array_set_size(view->strips, (guint)rungs);
	share_names(view);
	share_columns(view);
	view->rail = 0;
	for (int i = 0; i < rungs; i++)
		guess(view, i);
	stack(view, 0);
	lay_out_later(view);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void strips_stale(LadderGridView *view, int at, int count)
{
	for (int i = at; i < at + count && i < (int)view->strips->len; i++)
		forget(strip_of(view, i));
}

/* There are more or fewer before it; nothing else of it changed. */
static void renumber(LadderGridView *view, int rung)
{
	struct strip *strip = strip_of(view, rung);

	forget_drawing(strip);
	live_forget(strip);
	if (strip->layout)
		strip->layout->number = view->first + rung + 1;
}

void strips_renumber(LadderGridView *view)
{
	for (int i = 0; i < (int)view->strips->len; i++)
		renumber(view, i);
	cells_later(view);
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void strips_splice(LadderGridView *view, int at, int removed, int inserted)
{
	const struct strip none = { 0 };
	const int columns = view->columns;

	strips_stale(view, at, removed);
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
	gtk_widget_queue_resize(GTK_WIDGET(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
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
	struct names *names = &ladder_document_project(view->document)->names;
	const uint32_t of = names_find_any(names, name, strlen(name));
	const uint32_t at = names_find_any(names, address, strlen(address));

	share_names(view);
	for (int i = 0; i < (int)view->strips->len; i++)
		if (names_one(view, i, of, at))
			guess(view, i);
	stack(view, 0);
	lay_out_later(view);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void strips_dirty(LadderGridView *view, int rung)
{
	if (rung < 0 || rung >= (int)view->strips->len)
		return;
	if (grid_display_columns(sheet_rung(view, rung), 0) > view->columns) {
		strips_reset(view);
		return;
	}
	guess(view, rung);
	stack(view, rung);
	lay_out_later(view);
	gtk_widget_queue_resize(GTK_WIDGET(view));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

void strips_redraw(LadderGridView *view, int rung)
{
	for (int i = rung < 0 ? 0 : rung;
	     i < (int)view->strips->len && (rung < 0 || i == rung); i++)
		forget_drawing(strip_of(view, i));
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

/* ---- laying out ---- */

/* All rungs have the same right rail: the widest one's. */
static void widen(LadderGridView *view, float rail)
{
	view->rail = rail;
	for (guint i = 0; i < view->strips->len; i++) {
		struct strip *strip = strip_of(view, (int)i);

		if (strip->layout) {
			rung_layout_stretch(strip->layout, rail);
			forget_drawing(strip);
		}
	}
	resize_later(view);
}

/* What is seen stays where it is, if something above it grows. */
static void keep_view(LadderGridView *view, const struct strip *strip, float grown)
{
	GtkAdjustment *down = view->adjustment[1];
	const double value = gtk_adjustment_get_value(down);

	if (strip->y * view->zoom >= value)
		return;
	gtk_adjustment_set_upper(down, gtk_adjustment_get_upper(down) +
				 grown * view->zoom);
	gtk_adjustment_set_value(down, value + grown * view->zoom);
}

struct strip *strips_get(LadderGridView *view, int rung)
{
	struct strip *strip = strip_of(view, rung);
	const struct rung *shown = sheet_rung(view, rung);
	int rows = 0;
	float grown;

	if (strip->layout || !shown)
		return strip;
	if (rung == view->cursor.rung)
		rows = view->cursor.row + 1;
	if (rung == view->drop.rung)
		rows = MAX(rows, view->drop.row + 1);
	if (rung == view->wire.rung && view->wire.drawing)
		rows = MAX(rows, view->wire.rows); /* one may come below */
	strip->layout = rung_layout_new(&view->drafting, shown,
					view->first + rung + 1, rows);
	if (strip->layout->natural > view->rail)
		widen(view, strip->layout->natural);
	rung_layout_stretch(strip->layout, view->rail);
	strip->measured = true;
	grown = strip->layout->height - strip->height;
	strip->height = strip->layout->height;
	if (grown != 0) {
		stack(view, rung);
		keep_view(view, strip, grown);
		resize_later(view);
	}
	return strip;
}

void strips_lay_out(LadderGridView *view, double page)
{
	for (int i = 0; i < (int)view->strips->len; i++) {
		const double top = gtk_adjustment_get_value(view->adjustment[1]);
		const int first = strips_at(view, (float)(top / view->zoom));

		if (strip_of(view, i = MAX(i, first))->y * view->zoom > top + page)
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

float strips_width(LadderGridView *view)
{
	return RUNG_LEFT + MAX(view->rail, RUNG_LEAST_COLUMNS * RUNG_CELL_WIDTH) +
	       RUNG_AFTER;
}

float strips_height(LadderGridView *view)
{
	const guint count = view->strips->len;

	return count ? strip_of(view, (int)count - 1)->y +
		       strip_of(view, (int)count - 1)->height : 0;
}

/* ---- drawing ---- */

/* Of a rung that is being edited nothing is known. */
static struct grid_live live_of(LadderGridView *view, int rung, const struct strip *strip,
				uint8_t **unknown)
{
	const struct rung *shown = sheet_rung(view, rung);

	if (strip->live && shown != view->preview)
		return (struct grid_live){ strip->live->bits, live_rung_value,
					   strip->live };
	*unknown = g_new0(uint8_t, shown->rows * shown->cols);
	return (struct grid_live){ *unknown, NULL, NULL };
}

static void draw_strip(LadderGridView *view, int rung, struct strip *strip)
{
	GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct grid_mark));
	struct live_place place = { view, rung };
	struct grid_scene scene = {
		.drafting = &view->drafting, .layout = strip->layout,
		.theme = strips_theme(view), .note = live_note, .context = &place,
		.state = marks_state(view, rung),
		.scale = (float)(view->zoom * gtk_widget_get_scale_factor(GTK_WIDGET(view))),
	};
	struct grid_live live;
	uint8_t *unknown = NULL;
	bool *takes = drop_takes(view, rung, strip->layout);

	live_look(view, rung);
	if (live_is_on(view)) {
		live = live_of(view, rung, strip, &unknown);
		scene.live = &live;
		scene.state |= view->live.still ? RUNG_STILL : 0;
	}
	marks_push(view, rung, marks);
	live_marks(view, rung, marks);
	drop_mark(view, rung, marks);
	scene.takes = takes;
	if (ladder_document_is_bookmarked(view->document, view->pou,
					     view->first + rung))
		scene.state |= RUNG_MARKED;
	if (view->preview && rung == view->cursor.rung)
		scene.state |= RUNG_EDITED;
	scene.mark = (const struct grid_mark *)(void *)marks->data;
	scene.mark_count = (int)marks->len;
	strip->node = grid_draw_node(&scene);
	view->live.drawn++;
	g_array_unref(marks);
	g_free(unknown);
	g_free(takes);
}

void strips_snapshot(LadderGridView *view, GtkSnapshot *snapshot)
{
	const float zoom = (float)view->zoom;
	const float x = (float)gtk_adjustment_get_value(view->adjustment[0]);
	const float top = (float)gtk_adjustment_get_value(view->adjustment[1]);
	const float end = top + (float)gtk_widget_get_height(GTK_WIDGET(view));

	for (int i = strips_at(view, top / zoom);
	     i >= 0 && i < (int)view->strips->len; i++) {
		struct strip *strip = strip_of(view, i);

		if (strip->y * zoom > end)
			break;
		if (strip->layout && live_look(view, i))
			forget_drawing(strip);
		if (!strip->layout)
			resize_later(view); /* and it will be drawn */
		else if (!strip->node)
			draw_strip(view, i, strip);
		if (!strip->node)
			continue;
		gtk_snapshot_save(snapshot);
		gtk_snapshot_translate(snapshot,
			&GRAPHENE_POINT_INIT(-x, strip->y * zoom - top));
		gtk_snapshot_scale(snapshot, zoom, zoom);
		gtk_snapshot_append_node(snapshot, strip->node);
		gtk_snapshot_restore(snapshot);
	}
	lettering_trim(view->lettering);
}

/* What comes into view next is drawn before: one rung at a time, while nothing else is
 * done. Of what runs the values would be others by then. */
static gboolean draw_ahead(gpointer data)
{
	LadderGridView *view = data;
	const double top = gtk_adjustment_get_value(view->adjustment[1]) / view->zoom;
	const double page = gtk_adjustment_get_page_size(view->adjustment[1]) / view->zoom;
	int i = strips_at(view, (float)(top - AHEAD * page));

	for (; !live_is_on(view) && i >= 0 && i < (int)view->strips->len; i++) {
		if ((double)strip_of(view, i)->y > top + (1 + AHEAD) * page)
			break;
		if (strip_of(view, i)->node || !sheet_rung(view, i))
			continue;
		draw_strip(view, i, strips_get(view, i));
		return G_SOURCE_CONTINUE;
	}
	view->ahead = 0;
	return G_SOURCE_REMOVE;
}

void strips_draw_ahead(LadderGridView *view)
{
	if (!view->ahead)
		view->ahead = g_idle_add_full(G_PRIORITY_LOW, draw_ahead, view, NULL);
}

/* ---- life ---- */

void strips_style(LadderGridView *view)
{
	view->theme = NULL;
	strips_redraw(view, -1);
}

static void show_chosen(LadderGridView *view)
{
	ladder_grid_view_set_show(view, (enum drafting_show)settings_enum("show", SHOW_BOTH));
}

void strips_init(LadderGridView *view)
{
	view->lettering = lettering_new(gtk_widget_get_pango_context(GTK_WIDGET(view)),
					NULL);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(strips_style), view, G_CONNECT_SWAPPED);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::high-contrast",
				G_CALLBACK(strips_style), view, G_CONNECT_SWAPPED);
	if (settings_get()) {
		g_signal_connect_object(settings_get(), "changed::power",
					G_CALLBACK(strips_style), view, G_CONNECT_SWAPPED);
		g_signal_connect_object(settings_get(), "changed::show",
					G_CALLBACK(show_chosen), view, G_CONNECT_SWAPPED);
	}
	g_signal_connect(view, "notify::has-focus", G_CALLBACK(strips_style), NULL);
	g_signal_connect(view, "notify::scale-factor", G_CALLBACK(strips_style), NULL);
	strips_reset(view);
}

void strips_clear(LadderGridView *view)
{
	if (view->idle)
		g_source_remove(view->idle);
	if (view->resize)
		g_source_remove(view->resize);
	g_clear_handle_id(&view->ahead, g_source_remove);
	view->idle = view->resize = 0;
	for (guint i = 0; i < view->strips->len; i++)
		forget(strip_of(view, (int)i));
	g_array_set_size(view->strips, 0);
	g_clear_pointer(&view->names, grid_names_free);
	g_clear_pointer(&view->lettering, lettering_free);
}
