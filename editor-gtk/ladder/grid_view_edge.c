/* SPDX-License-Identifier: MIT
 *
 * grid_view_edge - a sheet scrolls while something is dragged near its edge.
 *
 * It scrolls as long as the pointer stays there, faster the nearer it is to the edge, and
 * tells whoever drags that what is below the pointer is another place now.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#define EDGE    28   /* px                                                     */
#define SLOWEST 3    /* px a step                                              */
#define FASTEST 24
#define STEP_MS 30

/* px a step; 0: not near an edge. */
static double speed(double at, double size)
{
	const double depth = at < EDGE ? EDGE - at : at > size - EDGE ?
			     EDGE - (size - at) : 0;
	const double by = SLOWEST + (FASTEST - SLOWEST) * MIN(depth / EDGE, 1);

	return depth <= 0 || size < 4 * EDGE ? 0 : at < EDGE ? -by : by;
}

static bool move(GtkAdjustment *adjustment, double by)
{
	const double before = gtk_adjustment_get_value(adjustment);

	if (by != 0)
		gtk_adjustment_set_value(adjustment, before + by);
	return gtk_adjustment_get_value(adjustment) != before;
}

static gboolean step(gpointer data)
{
	LadderGridView *view = data;
	struct sheet_edge *edge = &view->edge;
	const double across = speed(edge->x, gtk_widget_get_width(GTK_WIDGET(view)));
	const double down = speed(edge->y, gtk_widget_get_height(GTK_WIDGET(view)));
	const bool moved = move(view->adjustment[0], across);

	if (!move(view->adjustment[1], down) && !moved) {
		edge->timer = 0; /* there is no more */
		return G_SOURCE_REMOVE;
	}
	edge->again(view, edge->x, edge->y, edge->state);
	return G_SOURCE_CONTINUE;
}

void edge_at(LadderGridView *view, double x, double y, GdkModifierType state,
	     edge_call again)
{
	struct sheet_edge *edge = &view->edge;

	if (speed(x, gtk_widget_get_width(GTK_WIDGET(view))) == 0 &&
	    speed(y, gtk_widget_get_height(GTK_WIDGET(view))) == 0) {
		edge_forget(view);
		return;
	}
	*edge = (struct sheet_edge){ edge->timer, x, y, state, again };
	if (!edge->timer)
		edge->timer = g_timeout_add(STEP_MS, step, view);
}

void edge_forget(LadderGridView *view)
{
	g_clear_handle_id(&view->edge.timer, g_source_remove);
}
