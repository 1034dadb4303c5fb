/* SPDX-License-Identifier: MIT
 *
 * sfc_view_keys - the cursor of a chart, and letters that begin an entry.
 *
 * The cursor goes from box to box: to the nearest one in the way of the arrow.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include <math.h>

#define ASIDE 2.5f /* a px aside counts as so many ahead                       */

/* Where the cursor is felt to be: upon the lane of a box, in the middle of a line of a step. */
static graphene_point_t anchor_of(LadderSfcView *view, struct sfc_at at)
{
	const graphene_rect_t box = chart_box(view, at);
	graphene_point_t point = { box.origin.x + box.size.width / 2,
				   box.origin.y + box.size.height / 2 };

	if (at.shape >= 0 && at.use < 0)
		point.x = view->sheet->lane[view->sheet->layout->shape[at.shape].lane].x;
	return point;
}

/* How far a place is in a direction; INFINITY: it is not there. */
static float way_to_place(const graphene_point_t *from, const graphene_point_t *to, int dx,
			  int dy)
{
	const float ahead = dx ? (to->x - from->x) * (float)dx :
				 (to->y - from->y) * (float)dy;
	const float aside = dx ? fabsf(to->y - from->y) : fabsf(to->x - from->x);

	return ahead > 4 ? ahead + ASIDE * aside : INFINITY;
}

static void try_place(LadderSfcView *view, struct sfc_at at, const graphene_point_t *from,
		      int dx, int dy, float *least, struct sfc_at *best)
{
	const graphene_point_t to = anchor_of(view, at);
	const float far = way_to_place(from, &to, dx, dy);

	if (at.shape == view->cursor.shape && at.use == view->cursor.use)
		return;
	if (far < *least) {
		*least = far;
		*best = at;
	}
}

static void go(LadderSfcView *view, int dx, int dy, bool extend)
{
	const struct sfc_layout *layout = view->sheet->layout;
	const graphene_point_t from = anchor_of(view, view->cursor);
	struct sfc_at best = view->cursor;
	float least = INFINITY;

	for (int i = 0; i < layout->shape_count; i++) {
		const struct sfc_shape *shape = &layout->shape[i];

		/* From a line of a step one goes to its lines, and aside. */
		try_place(view, (struct sfc_at){ i, -1, false }, &from, dx, dy, &least,
			  &best);
		for (int u = 0; !extend && shape->part == SFC_STEP &&
		     u < layout->sfc->step[shape->index].use_count; u++) {
			if (dy && view->cursor.use < 0)
				continue; /* down the lane, not into the table */
			try_place(view, (struct sfc_at){ i,
				layout->sfc->step[shape->index].first_use + u, false },
				&from, dx, dy, &least, &best);
		}
	}
	if (best.shape >= 0)
		chart_go(view, best, extend);
}

/* False: nothing was selected, and the key is for somebody else. */
static bool unselect(LadderSfcView *view)
{
	bool any = false;

	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		any = any || view->selected[i];
	chart_go(view, view->cursor, false);
	return any;
}

static bool cursor_key(LadderSfcView *view, guint key, GdkModifierType state)
{
	const bool extend = state & GDK_SHIFT_MASK;
	const int last = view->sheet ? view->sheet->layout->shape_count - 1 : -1;

	if (last < 0 || state & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return false;
	switch (key) {
	case GDK_KEY_Up: case GDK_KEY_KP_Up: go(view, 0, -1, extend); return true;
	case GDK_KEY_Down: case GDK_KEY_KP_Down: go(view, 0, 1, extend); return true;
	case GDK_KEY_Left: case GDK_KEY_KP_Left: go(view, -1, 0, extend); return true;
	case GDK_KEY_Right: case GDK_KEY_KP_Right: go(view, 1, 0, extend); return true;
	case GDK_KEY_Home: chart_go(view, (struct sfc_at){ 0, -1, false }, false); return true;
	case GDK_KEY_End:
		chart_go(view, (struct sfc_at){ view->sheet->layout->sfc->step_count > 0 ?
			view->sheet->layout->sfc->step_count - 1 : last, -1, false }, false);
		return true;
	case GDK_KEY_Escape: return unselect(view);
	default: return false;
	}
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, LadderSfcView *view)
{
	const GdkModifierType others = GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK;
	const gunichar c = gdk_keyval_to_unicode(key);
	char text[8] = "";

	(void)controller;
	(void)code;
	if (cursor_key(view, key, state))
		return TRUE;
	if (state & others || !view->sheet ||
	    !(g_unichar_isalnum(c) || c == '%' || c == '_' || c == '('))
		return FALSE;
	text[g_unichar_to_utf8(c, text)] = '\0';
	chart_ask_here(view, text);
	return TRUE;
}

void chart_keys_init(LadderSfcView *view)
{
	GtkEventController *keys = gtk_event_controller_key_new();

	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), view);
	gtk_widget_add_controller(GTK_WIDGET(view), keys);
	/* Those of verbs come before the letters that begin an entry. */
	gtk_widget_add_controller(GTK_WIDGET(view), verbs_controller(VERB_CHART));
}
