/* SPDX-License-Identifier: MIT
 *
 * grid_view_live - values and power of the running program on a sheet.
 *
 * It shows results of the program and evaluates nothing. When values change, it redraws the
 * visible rungs that show another value; other rungs are updated when they become visible.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#define SAY_MS 300 /* delay of accessible names: a reader needs longer for one   */
#define VALUES_MS 1000 /* the same if only numbers in them change                 */

static bool flashes(LadderGridView *view)
{
	gboolean animations = TRUE;

	g_object_get(gtk_widget_get_settings(GTK_WIDGET(view)), "gtk-enable-animations",
		     &animations, NULL);
	return animations && !ladder_sim_is_past(view->canvas->sim);
}

/* ---- forgetting ---- */

void live_forget_all(LadderGridView *view)
{
	for (guint i = 0; i < view->strips->len; i++)
		strip_forget_live(strip_of(view, (int)i));
	g_clear_pointer(&view->live.map, live_map_free);
}

/* ---- finding ---- */

static struct live_map *map_of(LadderGridView *view)
{
	const struct pou *pou = sheet_pou(view);

	if (!view->live.map && pou) {
		view->live.map = live_map_new(
			&ladder_sim_twin(view->canvas->sim)->resource,
			project_text(ladder_document_project(view->canvas->document), pou->name),
			view->live.instance);
		live_map_set_sim(view->live.map, view->canvas->sim);
	}
	return view->live.map;
}

static bool same_text(const struct project *a, uint32_t x, const struct project *b,
		      uint32_t y)
{
	return g_str_equal(project_text(a, x), project_text(b, y));
}

/* Number of the rung in the running program; -1: it has another circuit there, whose power
 * must not be shown. */
static int number_of(LadderGridView *view, const struct rung *shown, int rung)
{
	const struct project *mine = ladder_document_project(view->canvas->document);
	const struct project *running = ladder_project(ladder_sim_ladder(view->canvas->sim));
	const int number = ladder_sim_rung(view->canvas->sim, view->canvas->document,
						  view->canvas->pou, view->first + rung);
	const int pou = ladder_sim_pou(view->canvas->sim, view->canvas->document,
				       view->canvas->pou);
	const struct rung *other;

	if (number < 0 || pou < 0 || number >= running->pou[pou].rung_count)
		return -1;
	other = running->pou[pou].rung[number];
	if (other->rows != shown->rows || other->cols != shown->cols)
		return -1;
	for (int i = 0; i < shown->rows * shown->cols; i++)
		if (shown->cell[i].link != other->cell[i].link ||
		    !same_text(mine, shown->cell[i].operand, running,
			       other->cell[i].operand) ||
		    !same_text(mine, shown->cell[i].args, running, other->cell[i].args))
			return -1;
	return number;
}

/* How good the inputs and outputs are that it shows. True: one has another quality. */
static bool judge(LadderGridView *view, struct live_rung *live)
{
	bool other = false;

	for (int i = 0; i < live->rows * live->cols; i++) {
		struct live_cell *cell = &live->cell[i];
		const uint8_t quality = cell->kind == LIVE_NOTHING || cell->at.type == IEC_NONE ? SIM_GOOD :
					(uint8_t)ladder_sim_quality(view->canvas->sim, cell->at);

		other |= quality != cell->quality;
		cell->quality = quality;
	}
	return other;
}

/* ---- updating ---- */

static void say_later(LadderGridView *view);
static void say_values_later(LadderGridView *view);

bool live_look(LadderGridView *view, int rung)
{
	struct strip *strip = strip_of(view, rung);
	const struct rung *shown = sheet_rung(view, rung);
	unsigned int changed;
	bool judged;

	if (!canvas_is_live(LADDER_CANVAS(view)) || shown == view->preview ||
	    strip->looked == view->live.stamp)
		return false;
	if (strip->live && strip->live->shown != shown)
		strip_forget_live(strip);
	/* The status bar may ask before the sheet has heard of another project. */
	if (!strip->live && map_of(view))
		strip->live = live_rung_new(map_of(view), ladder_document_project(view->canvas->document), shown,
					    number_of(view, shown, rung));
	strip->looked = view->live.stamp;
	if (!strip->live)
		return false;
	changed = live_rung_look(strip->live, &ladder_sim_twin(view->canvas->sim)->resource,
				 g_get_monotonic_time(), flashes(view));
	judged = judge(view, strip->live);
	if (changed & LIVE_OTHER_STATE || judged)
		say_later(view);
	else if (changed & LIVE_OTHER_TEXT)
		say_values_later(view);
	return changed != LIVE_SAME || judged;
}

const struct live_rung *live_rung_of(LadderGridView *view, int rung)
{
	const struct rung *shown = sheet_rung(view, rung);

	if (!canvas_is_live(LADDER_CANVAS(view)) || !shown || shown == view->preview)
		return NULL;
	if (live_look(view, rung))
		strips_redraw(view, rung);
	return strip_of(view, rung)->live;
}

static gboolean look_again(gpointer view);

/* Updates again at @until, when the marks of new values end. */
static void look_later(LadderGridView *view, gint64 until)
{
	const gint64 now = g_get_monotonic_time();

	if (until && !view->live.timer)
		view->live.timer = g_timeout_add((guint)(MAX(until - now, 0) / 1000 + 1),
						 look_again, view);
}

/* Updates the visible rungs. */
static void look_at_seen(LadderGridView *view)
{
	const double top = gtk_adjustment_get_value(view->canvas->adjustment[1]);
	const double end = top + gtk_widget_get_height(GTK_WIDGET(view));
	gint64 until = 0;
	bool changed = false;

	if (!gtk_widget_get_mapped(GTK_WIDGET(view)))
		return;
	for (int i = strips_at(view, (float)(top / view->canvas->zoom));
	     i >= 0 && i < (int)view->strips->len; i++) {
		struct strip *strip = strip_of(view, i);

		if (strip->y * view->canvas->zoom > end)
			break;
		if (!strip->layout)
			continue;
		if (live_look(view, i)) {
			g_clear_pointer(&strip->node, gsk_render_node_unref);
			changed = true;
		}
		if (strip->live && strip->live->until)
			until = until ? MIN(until, strip->live->until) :
				strip->live->until;
	}
	look_later(view, until);
	if (changed)
		gtk_widget_queue_draw(GTK_WIDGET(view));
}

static gboolean look_again(gpointer data)
{
	LadderGridView *view = data;

	view->live.timer = 0;
	view->live.stamp++;
	look_at_seen(view);
	return G_SOURCE_REMOVE;
}

/* ---- signals of the simulation ---- */

/* Power is drawn in RUN and PAUSE, not in STOP. */
static void notice_state(LadderGridView *view)
{
	const enum sim_state state = ladder_sim_state(view->canvas->sim);
	const bool still = state == SIM_STOP;

	if (still == view->live.still)
		return;
	view->live.still = still;
	strips_redraw(view, -1);
}

void live_values_changed(LadderCanvas *canvas)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);

	view->live.stamp++;
	if (!canvas_is_live(canvas))
		return;
	notice_state(view);
	look_at_seen(view);
}

void live_program_changed(LadderGridView *view)
{
	view->live.stamp++;
	live_forget_all(view);
	ladder_grid_view_set_blockers(view, -1, NULL, 0);
	strips_redraw(view, -1);
	canvas_cells_later(LADDER_CANVAS(view));
	canvas_moved(LADDER_CANVAS(view));
}

void live_state_changed(LadderGridView *view)
{
	if (canvas_is_live(LADDER_CANVAS(view)))
		notice_state(view);
	else
		live_program_changed(view);
}

static gboolean say_now(gpointer data)
{
	LadderGridView *view = data;

	view->live.say = 0;
	canvas_cells_later(LADDER_CANVAS(view));
	return G_SOURCE_REMOVE;
}

static void say_later(LadderGridView *view)
{
	if (!view->live.say)
		view->live.say = g_timeout_add(SAY_MS, say_now, view);
}

static gboolean say_values_now(gpointer data)
{
	LadderGridView *view = data;

	view->live.say_values = 0;
	canvas_cells_rename(LADDER_CANVAS(view));
	return G_SOURCE_REMOVE;
}

static void say_values_later(LadderGridView *view)
{
	if (!view->live.say_values)
		view->live.say_values = g_timeout_add(VALUES_MS, say_values_now, view);
}

/* ---- instances ---- */

void ladder_grid_view_set_instance(LadderGridView *view, const char *instance)
{
	g_free(view->live.instance);
	view->live.instance = g_strdup(instance);
	if (canvas_is_live(LADDER_CANVAS(view)))
		live_program_changed(view);
}

const char *ladder_grid_view_instance(LadderGridView *view)
{
	return canvas_is_live(LADDER_CANVAS(view)) && map_of(view) ?
	       live_map_instance(map_of(view)) : NULL;
}

/* ---- marks ---- */

static void blocker_clear(gpointer blocker)
{
	g_free((char *)((struct grid_blocker *)blocker)->note);
}

void ladder_grid_view_set_blockers(LadderGridView *view, int rung,
				   const struct grid_blocker *cells, int count)
{
	const int before = view->live.blocked;

	g_array_set_size(view->live.blockers, 0);
	view->live.blocked = count > 0 ? rung : -1;
	for (int i = 0; i < count; i++) {
		struct grid_blocker copy = cells[i];

		copy.note = g_strdup(copy.note);
		g_array_append_val(view->live.blockers, copy);
	}
	if (before >= 0)
		strips_redraw(view, before);
	if (view->live.blocked >= 0)
		strips_redraw(view, rung);
}

static unsigned int marks_of(const struct live_rung *live, int i)
{
	const uint8_t bits = live->bits[i], quality = live->cell[i].quality;

	return (bits & LIVE_FORCED ? MARK_FORCED : 0) | (bits & LIVE_FAILED ? MARK_FAILED : 0) |
	       (quality == SIM_STALE ? MARK_STALE : quality == SIM_VALUE_FAULT ? MARK_FAULT : 0);
}

void live_marks(LadderGridView *view, int rung, GArray *marks)
{
	const struct live_rung *live = strip_of(view, rung)->live;
	const struct rung *shown = sheet_rung(view, rung);

	if (shown == view->preview)
		return;
	for (int i = 0; live && i < live->rows * live->cols; i++)
		if (marks_of(live, i))
			mark_push(marks, i / live->cols,
				  grid_display_column(shown, view->columns, i / live->cols,
						      i % live->cols),
				  marks_of(live, i));
	for (guint i = 0; rung == view->live.blocked && i < view->live.blockers->len; i++) {
		const struct grid_blocker *one =
			&g_array_index(view->live.blockers, struct grid_blocker, i);

		if (one->row >= 0 && one->row < shown->rows && one->col >= 0 &&
		    one->col < shown->cols)
			mark_push(marks, one->row,
				  grid_display_column(shown, view->columns, one->row, one->col),
				  MARK_BLOCKS);
	}
}

const char *live_note(void *context, int row, int column)
{
	const struct live_place *place = context;
	LadderGridView *view = place->view;
	const struct rung *shown = sheet_rung(view, place->rung);

	for (guint i = 0; place->rung == view->live.blocked && shown != view->preview &&
	     i < view->live.blockers->len; i++) {
		const struct grid_blocker *one =
			&g_array_index(view->live.blockers, struct grid_blocker, i);

		if (one->row == row && one->row < shown->rows && one->col < shown->cols &&
		    grid_display_column(shown, view->columns, row, one->col) == column)
			return one->note;
	}
	return NULL;
}

/* ---- life ---- */

void live_init(LadderGridView *view)
{
	view->live.blocked = -1;
	view->live.stamp = 1;
	view->live.blockers = g_array_new(FALSE, FALSE, sizeof(struct grid_blocker));
	g_array_set_clear_func(view->live.blockers, blocker_clear);
	g_signal_connect(view, "map", G_CALLBACK(gtk_widget_queue_draw), NULL);
}

void live_clear(LadderGridView *view)
{
	live_forget_all(view);
	g_clear_handle_id(&view->live.timer, g_source_remove);
	g_clear_handle_id(&view->live.say, g_source_remove);
	g_clear_handle_id(&view->live.say_values, g_source_remove);
	g_clear_pointer(&view->live.instance, g_free);
}
