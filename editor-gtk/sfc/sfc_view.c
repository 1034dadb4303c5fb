/* SPDX-License-Identifier: MIT
 *
 * sfc_view - the class of the sheet of a chart: drawing, names, keys, clicks.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#include "editor-gtk/edit/sfc_lines.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include <math.h>
#include <string.h>

G_DEFINE_FINAL_TYPE(LadderSfcView, ladder_sfc_view, LADDER_TYPE_CANVAS)

#define NOWHERE ((struct sfc_at){ -1, -1, false })
#define BELOW   60 /* px of free sheet below the chart                          */
#define SLACK   6  /* px around a box where a click hits it                     */
#define TIP_SLACK 4

static bool is_same(struct sfc_at a, struct sfc_at b)
{
	return a.shape == b.shape && a.use == b.use;
}

static struct sfc_at at_point(LadderSfcView *view, double x, double y, float slack)
{
	const graphene_point_t point = canvas_point(LADDER_CANVAS(view), x, y);

	return view->sheet ? sfc_sheet_at(view->sheet, point.x, point.y, slack) : NOWHERE;
}

/* ---- drawing ---- */

static graphene_size_t size(LadderCanvas *canvas)
{
	const struct sfc_sheet *sheet = LADDER_SFC_VIEW(canvas)->sheet;

	return sheet ? GRAPHENE_SIZE_INIT(sheet->width, sheet->height + BELOW) :
		       GRAPHENE_SIZE_INIT(0, 0);
}

static void push_mark(GArray *marks, int shape, int use, unsigned int signs)
{
	const struct sfc_mark mark = { shape, use, signs };

	if (shape >= 0)
		g_array_append_val(marks, mark);
}

static GArray *all_marks(LadderSfcView *view)
{
	GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));

	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		push_mark(marks, view->selected[i] ? i : -1, -1, SFC_SELECTED);
	g_array_append_vals(marks, view->found->data, view->found->len);
	g_array_append_vals(marks, view->marks->data, view->marks->len);
	g_array_append_vals(marks, sfc_missing(view)->data, sfc_missing(view)->len);
	push_mark(marks, view->cursor.shape, view->cursor.use, SFC_CURSOR);
	push_mark(marks, view->stroke.drawn ? view->stroke.to.shape : view->drop.shape, -1,
		  SFC_DROP);
	return marks;
}

/* The way drawn with the pointer. */
static void snapshot_stroke(LadderSfcView *view, GtkSnapshot *snapshot,
			    const struct theme *theme)
{
	const struct sfc_stroke *stroke = &view->stroke;
	const graphene_rect_t box = sfc_box(view, stroke->from);
	const struct sfc_layout *layout = view->sheet->layout;
	struct picture picture;

	picture_init(&picture);
	picture_line(&picture, TOKEN_ACCENT, STROKE_DASHED, 2,
		     view->sheet->lane[layout->shape[stroke->from.shape].lane].x,
		     box.origin.y + box.size.height, stroke->at.x, stroke->at.y);
	picture_disc(&picture, TOKEN_ACCENT, 1, stroke->at.x, stroke->at.y, 4);
	picture_snapshot(&picture, theme, view->canvas->lettering, snapshot);
	picture_clear(&picture);
}

static void snapshot_chart(LadderSfcView *view, GtkSnapshot *snapshot,
			   const struct theme *theme)
{
	const graphene_rect_t page = canvas_page(LADDER_CANVAS(view));
	GArray *marks = all_marks(view);
	struct sfc_live live;
	struct sfc_scene scene = {
		.sheet = view->sheet, .theme = theme,
		.mark = (const struct sfc_mark *)(void *)marks->data,
		.mark_count = (int)marks->len,
		.top = page.origin.y, .bottom = page.origin.y + page.size.height,
	};
	GskRenderNode *node;

	if (sfc_live_look(view, &live))
		scene.live = &live;
	node = sfc_draw_node(&scene);
	if (node) {
		gtk_snapshot_append_node(snapshot, node);
		gsk_render_node_unref(node);
	}
	if (view->stroke.drawn)
		snapshot_stroke(view, snapshot, theme);
	g_array_unref(marks);
}

static void paint(LadderCanvas *canvas, GtkSnapshot *snapshot, const struct theme *theme)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const graphene_rect_t origin = canvas_rect(canvas, GRAPHENE_RECT_INIT(0, 0, 0, 0));

	if (!view->sheet)
		return;
	if (!view->sheet->layout->shape_count) {
		canvas_snapshot_hint(canvas, snapshot, theme,
			_("Press Ins: a step, and below it a transition and the next one.\n"
			  "F6 another branch, F7 a branch beside it, F8 leads to a step.\n"
			  "Type a name at a step, a condition at a transition."),
			GRAPHENE_POINT_INIT(SFC_EDGE, SFC_EDGE));
		return;
	}
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(roundf(origin.origin.x),
							      roundf(origin.origin.y)));
	gtk_snapshot_scale(snapshot, (float)view->canvas->zoom, (float)view->canvas->zoom);
	snapshot_chart(view, snapshot, theme);
	gtk_snapshot_restore(snapshot);
}

/* ---- the document and the simulation ---- */

static void project_changed(LadderCanvas *canvas)
{
	sfc_make_sheet(LADDER_SFC_VIEW(canvas));
}

static void rungs_changed(LadderCanvas *canvas, int pou, int at, int removed, int inserted)
{
	(void)at;
	(void)removed;
	(void)inserted;
	if (pou == canvas_state(canvas)->pou)
		sfc_make_sheet(LADDER_SFC_VIEW(canvas));
}

/* The chart at the last check: edits of rungs may have moved lines since. NULL: unknown. */
static const struct sfc *checked_chart(LadderSfcView *view)
{
	struct ladder *ladder = ladder_document_checked(view->canvas->document);
	const struct project *project = ladder ? ladder_project(ladder) : NULL;

	return project && view->canvas->pou < project->pou_count ? project->pou[view->canvas->pou].sfc :
	       NULL;
}

static void checked(LadderCanvas *canvas)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const struct diag_list *diags = ladder_document_diags(view->canvas->document);
	const struct pou *pou = sfc_pou(view);
	const struct project *project = ladder_document_project(view->canvas->document);

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

static void values_changed(LadderCanvas *canvas)
{
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
	canvas_cells_later(canvas);
}

static void program_gone(LadderCanvas *canvas)
{
	sfc_forget_places(LADDER_SFC_VIEW(canvas));
}

/* ---- names and tips ---- */

static void add_names(GString *text, const struct project *project, const struct sfc *sfc,
		      int first, int count)
{
	for (int i = 0; i < count; i++)
		g_string_append_printf(text, "%s%s", i ? ", " : "",
				       project_text(project, sfc->ref[first + i].name));
}

static void say_step(LadderSfcView *view, GString *text, int index, bool live)
{
	const struct sfc *sfc = view->sheet->layout->sfc;

	g_string_append_printf(text, _("Step %s"), view->sheet->name[index]);
	if (sfc->step[index].kind == STEP_INITIAL)
		g_string_append_printf(text, ", %s", _("initial"));
	if (sfc->step[index].kind == STEP_MACRO)
		g_string_append_printf(text, ", %s", _("macro-step"));
	if (view->sheet->times[index][0])
		g_string_append_printf(text, ", %s", view->sheet->times[index]);
	if (live && canvas_is_live(LADDER_CANVAS(view)) && view->places.step &&
	    view->places.step[index] & SFC_ACTIVE)
		g_string_append_printf(text, ", %s", _("active"));
}

static void say_transition(LadderSfcView *view, GString *text, int index)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	const struct sfc_transition *t = &sfc->transition[index];
	GString *from = g_string_new(NULL), *to = g_string_new(NULL);

	add_names(from, view->sheet->project, sfc, t->first_from, t->from_count);
	add_names(to, view->sheet->project, sfc, t->first_to, t->to_count);
	g_string_append_printf(text, _("Transition %d, from %s to %s, condition %s"),
			       index + 1, from->str, to->str,
			       view->sheet->name[sfc->step_count + index]);
	g_string_free(from, TRUE);
	g_string_free(to, TRUE);
}

static bool is_missing(LadderSfcView *view, struct sfc_at at)
{
	const GArray *missing = sfc_missing(view);

	for (guint i = 0; i < missing->len; i++) {
		const struct sfc_mark *mark = &g_array_index(missing, struct sfc_mark, i);

		if (mark->shape == at.shape && mark->use == at.use)
			return true;
	}
	return false;
}

/* @live: with its state in the running program. */
static char *name_of(LadderSfcView *view, struct sfc_at at, bool live)
{
	const struct sfc_shape *shape = &view->sheet->layout->shape[at.shape];
	const char *comment = at.use >= 0 ? view->sheet->use_comment[at.use] :
			      view->sheet->comment[at.shape];
	GString *text = g_string_new(NULL);

	if (at.use >= 0)
		g_string_append_printf(text, _("%s does: %s %s"),
				       view->sheet->name[at.shape],
				       view->sheet->what[at.use],
				       view->sheet->does[at.use]);
	else if (shape->part == SFC_STEP)
		say_step(view, text, shape->index, live);
	else if (shape->part == SFC_TRANSITION)
		say_transition(view, text, shape->index);
	else
		g_string_append_printf(text, _("Jump to %s"), view->sheet->name[at.shape]);
	if (*comment)
		g_string_append_printf(text, ", %s", comment);
	if (live && is_missing(view, at))
		g_string_append_printf(text, ", %s", _("not downloaded"));
	return g_string_free(text, FALSE);
}

static char *cursor_name(LadderCanvas *canvas, bool values)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const struct sfc_at at = view->cursor;
	char *name, *text;

	if (!view->sheet || at.shape < 0)
		return NULL;
	name = name_of(view, at, values);
	if (values)
		return name;
	text = g_strdup_printf("%d %d %s", at.shape, at.use, name);
	g_free(name);
	return text;
}

static char *place(LadderCanvas *canvas)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	char *name;

	sfc_fresh(view);
	name = cursor_name(canvas, true);
	return name ? name : g_strdup("");
}

/* Comment and errors; NULL: none. Caller frees. */
static char *tip_of(LadderSfcView *view, int shape, int use)
{
	const struct diag_list *diags = ladder_document_diags(view->canvas->document);
	const struct pou *pou = sfc_pou(view);
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
		g_string_append_printf(text, _("%s%s: %s"), text->len ? "\n" : "",
			diag_severity(diag->id) == SEVERITY_ERROR ? _("Error") :
			_("Warning"), said);
		g_free(said);
	}
	return g_string_free(text, text->len == 0);
}

static char *tip(LadderCanvas *canvas, int x, int y, bool by_keys)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const struct sfc_at at = by_keys ? view->cursor : at_point(view, x, y, TIP_SLACK);

	return view->sheet && at.shape >= 0 ? tip_of(view, at.shape, at.use) : NULL;
}

static char *next_keys(LadderCanvas *canvas)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	static const enum verb verbs[][4] = {
		[SFC_NOTHING] = { VERB_step_below, VERB_paste, VERB_COUNT, VERB_COUNT },
		[SFC_STEP] = { VERB_step_below, VERB_step_branch, VERB_lead_to,
			       VERB_step_does },
		[SFC_TRANSITION] = { VERB_enter, VERB_step_parallel, VERB_wait_for,
				     VERB_as_rung },
		[SFC_JUMP] = { VERB_enter, VERB_step_below, VERB_delete, VERB_COUNT },
	};
	GString *text = g_string_new(NULL);
	enum sfc_part part;
	int index;

	sfc_fresh(view);
	part = sfc_part_at_cursor(view, &index);
	for (int i = 0; i < 4 && verbs[part][i] != VERB_COUNT; i++)
		verb_tell(text, verbs[part][i]);
	return g_string_free(text, FALSE);
}

/* ---- accessible children ---- */

/* An accessible child may be older than the chart. */
static bool is_there(LadderSfcView *view, struct sfc_at at)
{
	return view->sheet && at.shape < view->sheet->layout->shape_count &&
	       at.use < view->sheet->layout->sfc->use_count;
}

static struct sfc_at at_spot(struct canvas_spot spot)
{
	return (struct sfc_at){ spot.number, spot.row, false };
}

static void add_cell(LadderSfcView *view, int shape, int use)
{
	const struct sfc_at at = { shape, use, false };

	canvas_add_cell(LADDER_CANVAS(view), (struct canvas_spot){ shape, use, 0 },
			is_same(at, view->cursor));
}

static void list_cells(LadderCanvas *canvas)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const graphene_rect_t page = canvas_page(canvas);
	const struct sfc_layout *layout;
	struct sfc_live now;

	sfc_fresh(view);
	sfc_live_look(view, &now); /* updates the states in the names */
	layout = view->sheet ? view->sheet->layout : NULL;
	for (int i = 0; layout && i < layout->shape_count; i++) {
		const struct sfc_shape *shape = &layout->shape[i];
		const graphene_rect_t box = sfc_sheet_box(view->sheet, i);

		if (!graphene_rect_intersection(&page, &box, NULL))
			continue;
		add_cell(view, i, -1);
		for (int u = 0; shape->part == SFC_STEP &&
		     u < layout->sfc->step[shape->index].use_count; u++)
			add_cell(view, i, layout->sfc->step[shape->index].first_use + u);
	}
}

static char *cell_name(LadderCanvas *canvas, struct canvas_spot spot)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);

	return is_there(view, at_spot(spot)) ? name_of(view, at_spot(spot), true) : NULL;
}

static bool cell_box(LadderCanvas *canvas, struct canvas_spot spot, graphene_rect_t *box)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);

	if (!is_there(view, at_spot(spot)))
		return false;
	*box = sfc_box(view, at_spot(spot));
	return true;
}

static void go_to_cell(LadderCanvas *canvas, struct canvas_spot spot)
{
	sfc_go(LADDER_SFC_VIEW(canvas), at_spot(spot), false);
}

static graphene_rect_t cursor_box(LadderCanvas *canvas)
{
	return sfc_box(LADDER_SFC_VIEW(canvas), LADDER_SFC_VIEW(canvas)->cursor);
}

static void reveal(LadderCanvas *canvas)
{
	sfc_reveal(LADDER_SFC_VIEW(canvas));
}

/* ---- keys: the cursor goes to the nearest box in the direction of the arrow ---- */

#define ASIDE 2.5f /* weight of a px aside against a px ahead                  */

/* The point from which arrows measure: on the lane of a box; the middle of a step's line. */
static graphene_point_t anchor_of(LadderSfcView *view, struct sfc_at at)
{
	const graphene_rect_t box = sfc_box(view, at);
	graphene_point_t point = { box.origin.x + box.size.width / 2,
				   box.origin.y + box.size.height / 2 };

	if (at.shape >= 0 && at.use < 0)
		point.x = view->sheet->lane[view->sheet->layout->shape[at.shape].lane].x;
	return point;
}

/* Distance of a place in a direction; INFINITY: not in this direction. */
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

	if (is_same(at, view->cursor))
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

		/* Lines of steps are reached only from a line or from aside. */
		try_place(view, (struct sfc_at){ i, -1, false }, &from, dx, dy, &least,
			  &best);
		for (int u = 0; !extend && shape->part == SFC_STEP &&
		     u < layout->sfc->step[shape->index].use_count; u++) {
			if (dy && view->cursor.use < 0)
				continue; /* stay on the lane */
			try_place(view, (struct sfc_at){ i,
				layout->sfc->step[shape->index].first_use + u, false },
				&from, dx, dy, &least, &best);
		}
	}
	if (best.shape >= 0)
		sfc_go(view, best, extend);
}

/* False: nothing was selected; the window gets the key. */
static bool unselect(LadderSfcView *view)
{
	bool any = false;

	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		any = any || view->selected[i];
	sfc_go(view, view->cursor, false);
	return any;
}

static bool move_by_key(LadderCanvas *canvas, guint key, GdkModifierType state)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const bool extend = state & GDK_SHIFT_MASK;
	const int last = view->sheet ? view->sheet->layout->shape_count - 1 : -1;

	if (last < 0 || state & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return false;
	switch (key) {
	case GDK_KEY_Up: case GDK_KEY_KP_Up: go(view, 0, -1, extend); return true;
	case GDK_KEY_Down: case GDK_KEY_KP_Down: go(view, 0, 1, extend); return true;
	case GDK_KEY_Left: case GDK_KEY_KP_Left: go(view, -1, 0, extend); return true;
	case GDK_KEY_Right: case GDK_KEY_KP_Right: go(view, 1, 0, extend); return true;
	case GDK_KEY_Home: sfc_go(view, (struct sfc_at){ 0, -1, false }, false); return true;
	case GDK_KEY_End:
		sfc_go(view, (struct sfc_at){ view->sheet->layout->sfc->step_count > 0 ?
			view->sheet->layout->sfc->step_count - 1 : last, -1, false }, false);
		return true;
	case GDK_KEY_Escape: return unselect(view);
	default: return false;
	}
}

static void type(LadderCanvas *canvas, const char *text)
{
	if (LADDER_SFC_VIEW(canvas)->sheet)
		sfc_ask_here(LADDER_SFC_VIEW(canvas), text);
}

/* ---- the pointer: a way is drawn from a step or transition to another one ---- */

static void press(LadderCanvas *canvas, double x, double y, int count, GdkModifierType state)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const struct sfc_at at = at_point(view, x, y, SLACK);

	view->stroke = (struct sfc_stroke){ at, NOWHERE, false, { 0, 0 } };
	if (at.shape < 0)
		return;
	sfc_go(view, at, state & GDK_SHIFT_MASK);
	if (count == 2)
		sfc_ask_here(view, NULL);
}

static bool can_drag(LadderCanvas *canvas)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const struct sfc_at from = view->stroke.from;

	return view->sheet && from.shape >= 0 && from.use < 0 &&
	       view->sheet->layout->shape[from.shape].part != SFC_JUMP;
}

static bool drag(LadderCanvas *canvas, double x, double y, GdkModifierType state)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	struct sfc_stroke *stroke = &view->stroke;

	(void)state;
	if (!can_drag(canvas)) /* the chart changed since the press */
		return false;
	stroke->drawn = true;
	stroke->at = canvas_point(canvas, x, y);
	stroke->to = at_point(view, x, y, SLACK);
	if (stroke->to.shape == stroke->from.shape)
		stroke->to.shape = -1;
	gtk_widget_queue_draw(GTK_WIDGET(view));
	return true;
}

static void drag_end(LadderCanvas *canvas, bool cancelled)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	const struct sfc_stroke stroke = view->stroke;

	if (!stroke.drawn)
		return;
	view->stroke.drawn = false;
	gtk_widget_queue_draw(GTK_WIDGET(view));
	if (!cancelled && stroke.to.shape >= 0)
		sfc_lead(view, stroke.from, stroke.to);
}

/* ---- the menu ---- */

static const enum verb of_shape[] = { VERB_enter, VERB_step_does, VERB_as_rung, VERB_force,
	VERB_COUNT };
static const enum verb of_structure[] = { VERB_step_below, VERB_step_branch, VERB_step_parallel,
	VERB_lead_to, VERB_wait_for, VERB_branch_left, VERB_branch_right, VERB_COUNT };
static const enum verb of_properties[] = { VERB_step_kind, VERB_step_times, VERB_way_name,
	VERB_way_priority, VERB_chart_comment, VERB_macro_make, VERB_macro_open, VERB_COUNT };
static const enum verb of_symbol[] = { VERB_rename, VERB_show_uses, VERB_watch_add, VERB_COUNT };
static const enum verb of_clipboard[] = { VERB_cut, VERB_copy, VERB_paste, VERB_delete,
	VERB_COUNT };

/* Is there another branch beside it? */
static bool has_neighbour(LadderSfcView *view, enum sfc_part part, int index)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	int step = part == SFC_STEP ? index : -1, ways = 0, from = -1;

	for (int i = 0; i < sfc->transition_count; i++) {
		const struct sfc_transition *t = &sfc->transition[i];
		bool leads = part == SFC_TRANSITION && i == index;

		for (int k = t->first_to; step >= 0 && k < t->first_to + t->to_count; k++)
			leads |= sfc->ref[k].step == step;
		if (leads && step >= 0 && t->to_count > 1)
			return true;
		if (leads && t->from_count > 0)
			from = sfc->ref[t->first_from].step;
	}
	for (int i = 0; from >= 0 && i < sfc->transition_count; i++)
		for (int k = 0; k < sfc->transition[i].from_count; k++)
			ways += sfc->ref[sfc->transition[i].first_from + k].step == from;
	return ways > 1;
}

/* Does the verb apply at the cursor? */
static bool applies(LadderCanvas *canvas, enum verb verb)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);
	int index;
	const enum sfc_part part = sfc_part_at_cursor(view, &index);

	switch ((int)verb) {
	case VERB_branch_left: case VERB_branch_right:
		return has_neighbour(view, part, index);
	case VERB_step_does: case VERB_step_kind: case VERB_step_times: case VERB_macro_make:
	case VERB_step_branch:
		return part == SFC_STEP && view->cursor.use < 0;
	case VERB_wait_for: case VERB_way_name: case VERB_way_priority:
		return part == SFC_TRANSITION;
	case VERB_macro_open:
		return sfc_macro_here(view) >= 0;
	case VERB_as_rung:
		return part == SFC_TRANSITION || view->cursor.use >= 0;
	case VERB_enter: case VERB_chart_comment: case VERB_rename: case VERB_show_uses:
	case VERB_watch_add: case VERB_cut: case VERB_copy: case VERB_delete:
		return part != SFC_NOTHING && (verb != VERB_chart_comment || part != SFC_JUMP);
	case VERB_lead_to:
		return part == SFC_STEP || part == SFC_TRANSITION;
	case VERB_force:
		return part == SFC_STEP && canvas_is_live(canvas);
	default:
		return true;
	}
}

static GMenu *make_menu(LadderCanvas *canvas)
{
	GMenu *menu = g_menu_new(), *parts = g_menu_new();

	canvas_append_section(canvas, menu, of_shape, applies);
	canvas_append_section(canvas, menu, of_structure, applies);
	canvas_append_submenu(canvas, parts, N_("Properties"), of_properties, applies);
	canvas_append_submenu(canvas, parts, N_("Symbol"), of_symbol, applies);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(parts));
	g_object_unref(parts);
	canvas_append_section(canvas, menu, of_clipboard, applies);
	return menu;
}

/* ---- verbs ---- */

static void select_all(LadderSfcView *view)
{
	if (!view->sheet)
		return;
	for (int i = 0; i < view->sheet->layout->shape_count; i++)
		view->selected[i] = true;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static bool changes(enum verb verb)
{
	return verb != VERB_copy && verb != VERB_select_all && verb != VERB_go_rung &&
	       verb != VERB_enter;
}

static void do_verb(LadderCanvas *canvas, enum verb verb)
{
	LadderSfcView *view = LADDER_SFC_VIEW(canvas);

	sfc_fresh(view);
	if (!view->sheet || (changes(verb) && canvas_is_fixed(canvas)) ||
	    sfc_edit_do(view, verb))
		return;
	switch ((int)verb) {
	case VERB_lead_to: sfc_ask_for(view, ASK_LEAD, NULL); break;
	case VERB_wait_for: sfc_ask_for(view, ASK_WAIT, NULL); break;
	case VERB_step_does: sfc_ask_for(view, ASK_ANOTHER, NULL); break;
	case VERB_step_times: sfc_ask_for(view, ASK_TIMES, NULL); break;
	case VERB_way_name: sfc_ask_for(view, ASK_NAME, NULL); break;
	case VERB_way_priority: sfc_ask_for(view, ASK_PRIORITY, NULL); break;
	case VERB_chart_comment: sfc_ask_for(view, ASK_COMMENT, NULL); break;
	case VERB_go_rung: sfc_ask_for(view, ASK_GO, NULL); break;
	case VERB_enter: sfc_ask_here(view, NULL); break;
	case VERB_select_all: select_all(view); break;
	case VERB_context_menu: canvas_show_menu(canvas); break;
	case VERB_force: sfc_live_force(view); break;
	default: break;
	}
}

/* ---- the palette ---- */

static void place_action(LadderSfcView *view, enum qualifier qualifier)
{
	char *typed = g_strdup_printf("%s ", qualifier_word(qualifier));

	sfc_ask_for(view, ASK_ANOTHER, typed);
	g_free(typed);
}

void ladder_sfc_view_place(LadderSfcView *view, enum sfc_tool tool)
{
	int index;

	sfc_fresh(view);
	if (!view->sheet || canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	gtk_widget_grab_focus(GTK_WIDGET(view));
	if (tool >= TOOL_ACTION) {
		place_action(view, (enum qualifier)(tool - TOOL_ACTION));
	} else if (tool == TOOL_TRANSITION) {
		if (sfc_new_way(view) &&
		    sfc_part_at_cursor(view, &index) == SFC_TRANSITION)
			sfc_ask_for(view, ASK_CONDITION, NULL);
	} else if (tool == TOOL_INITIAL && !view->sheet->layout->shape_count) {
		do_verb(LADDER_CANVAS(view), VERB_step_below); /* the first step is initial */
	} else {
		do_verb(LADDER_CANVAS(view), sfc_tool_verb(tool));
	}
}

#define LADDER_TYPE_PART (ladder_part_get_type())

/* A tool that is dragged. */
static int *ladder_part_copy(int *part)
{
	return g_memdup2(part, sizeof(*part));
}

static GType ladder_part_get_type(void)
{
	static GType type;

	if (g_once_init_enter(&type))
		g_once_init_leave(&type, g_boxed_type_register_static("LadderPart",
			(GBoxedCopyFunc)ladder_part_copy, g_free));
	return type;
}

GdkContentProvider *ladder_sfc_view_drag(int tool)
{
	return gdk_content_provider_new_typed(LADDER_TYPE_PART, &tool);
}

static void drop_at(LadderSfcView *view, struct sfc_at at)
{
	if (is_same(at, view->drop))
		return;
	view->drop = at;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static GdkDragAction drop_motion(GtkDropTarget *target, double x, double y,
				 LadderSfcView *view)
{
	(void)target;
	sfc_fresh(view);
	if (!view->sheet || canvas_is_fixed(LADDER_CANVAS(view)))
		return 0;
	drop_at(view, at_point(view, x, y, SLACK));
	return view->drop.shape >= 0 || !view->sheet->layout->shape_count ? GDK_ACTION_COPY : 0;
}

static void drop_leave(GtkDropTarget *target, LadderSfcView *view)
{
	(void)target;
	drop_at(view, NOWHERE);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			LadderSfcView *view)
{
	const int tool = *(const int *)g_value_get_boxed(value);

	if (!drop_motion(target, x, y, view))
		return FALSE;
	if (view->drop.shape >= 0)
		sfc_go(view, view->drop, false);
	drop_at(view, NOWHERE);
	ladder_sfc_view_place(view, (enum sfc_tool)tool);
	return TRUE;
}

static void take_drops(LadderSfcView *view)
{
	GtkDropTarget *target = gtk_drop_target_new(LADDER_TYPE_PART, GDK_ACTION_COPY);

	g_signal_connect(target, "motion", G_CALLBACK(drop_motion), view);
	g_signal_connect(target, "leave", G_CALLBACK(drop_leave), view);
	g_signal_connect(target, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(target));
}

bool ladder_sfc_view_why(LadderSfcView *view)
{
	int index;

	sfc_fresh(view);
	if (sfc_part_at_cursor(view, &index) != SFC_TRANSITION ||
	    sfc_pou(view)->sfc->transition[index].condition.kind == BODY_NONE)
		return false;
	sfc_want_body(view, &sfc_pou(view)->sfc->transition[index].condition);
	return true;
}

void ladder_sfc_view_go(LadderSfcView *view, int rung)
{
	const struct diag diag = { .rung = rung + 1 };
	struct sfc_at at = NOWHERE;

	sfc_fresh(view);
	if (view->sheet && sfc_sheet_of_diag(view->sheet, NULL, &diag, &at.shape, &at.use))
		sfc_go(view, at, false);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

/* ---- lines ---- */

static int line_of(LadderSfcView *view, struct sfc_at at)
{
	const struct sfc_shape *shape = &view->sheet->layout->shape[at.shape];
	struct sfc_spot spot = { SPOT_NONE, shape->index };

	if (at.use >= 0)
		spot = (struct sfc_spot){ SPOT_USE, at.use };
	else if (shape->part == SFC_STEP)
		spot.kind = SPOT_STEP;
	else if (shape->part == SFC_TRANSITION)
		spot.kind = SPOT_TRANSITION;
	return sfc_line_of(view->sheet->project, view->sheet->layout->sfc, spot);
}

/* A line of an action is shown at the first step that calls it. */
static struct sfc_at called_first(const struct sfc *sfc, int action)
{
	for (int i = 0; i < sfc->use_count; i++)
		if (sfc->use[i].action == action)
			return (struct sfc_at){ sfc->use[i].step, i, false };
	return NOWHERE;
}

static struct sfc_at at_line(LadderSfcView *view, int line)
{
	const struct sfc *sfc = view->sheet->layout->sfc;
	const struct sfc_spot spot = sfc_spot_at(view->sheet->project, sfc, line);

	switch (spot.kind) {
	case SPOT_STEP:
		return (struct sfc_at){ spot.index, -1, false };
	case SPOT_TRANSITION:
		return (struct sfc_at){ sfc->step_count + spot.index, -1, false };
	case SPOT_USE:
		return (struct sfc_at){ sfc->use[spot.index].step, spot.index, false };
	case SPOT_ACTION:
		return called_first(sfc, spot.index);
	case SPOT_CONTROL:
	case SPOT_NONE:
		break;
	}
	return NOWHERE;
}

void ladder_sfc_view_go_row(LadderSfcView *view, int row)
{
	struct sfc_at at;

	sfc_fresh(view);
	if (view->sheet) {
		at = at_line(view, sfc_pou(view)->line + row);
		if (at.shape >= 0)
			sfc_go(view, at, false);
	}
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

int ladder_sfc_view_row(LadderSfcView *view)
{
	sfc_fresh(view);
	return view->sheet && view->cursor.shape >= 0 ?
	       MAX(line_of(view, view->cursor) - sfc_pou(view)->line, -1) : -1;
}

bool ladder_sfc_view_is_at(LadderSfcView *view, int row)
{
	struct sfc_at at;

	sfc_fresh(view);
	if (!view->sheet)
		return false;
	at = at_line(view, sfc_pou(view)->line + row);
	return at.shape < 0 || is_same(at, view->cursor);
}

/* ---- hits of a search ---- */

static bool holds(const struct sfc_body *body, int rung)
{
	return sfc_body_has_rungs(body) && rung >= body->first && rung < body->first + body->count;
}

/* The transition or action whose body has the rung. */
static struct sfc_at at_rung(const struct sfc *sfc, int rung)
{
	for (int i = 0; i < sfc->transition_count; i++)
		if (holds(&sfc->transition[i].condition, rung))
			return (struct sfc_at){ sfc->step_count + i, -1, false };
	for (int i = 0; i < sfc->action_count; i++)
		if (holds(&sfc->action[i].body, rung))
			return called_first(sfc, i);
	return NOWHERE;
}

void ladder_sfc_view_set_found(LadderSfcView *view, const struct find_seen *seen)
{
	const struct find_hit *hit;
	int index = 0;
	bool now;

	sfc_fresh(view);
	g_array_set_size(view->found, 0);
	while (view->sheet && (hit = find_seen_next(seen, view->canvas->pou, &index, &now)) != NULL) {
		const struct sfc_at at = hit->rung >= 0 ? at_rung(view->sheet->layout->sfc, hit->rung) :
					 at_line(view, sfc_pou(view)->line + hit->row);

		push_mark(view->found, at.shape, at.use, SFC_FOUND | (now ? SFC_FOUND_NOW : 0u));
	}
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

/* ---- the name at the cursor ---- */

/* The first name in a condition's rungs, except the coil of the condition itself. */
static const struct xref_use *name_in(const struct xref *xref, int pou,
				      const struct sfc_body *body)
{
	for (int i = 0; i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->pou == pou && use->slot && use->rung > body->first &&
		    use->rung <= body->first + body->count &&
		    strcmp(project_text(xref->project, *use->slot), SFC_CONDITION) != 0)
			return use;
	}
	return NULL;
}

static const struct xref_use *of_slot(const struct xref *xref, const uint32_t *slot)
{
	for (int i = 0; i < xref->count; i++)
		if (xref->use[i].slot == slot)
			return &xref->use[i];
	return NULL;
}

const struct xref_use *ladder_sfc_view_use(LadderSfcView *view, const struct xref *xref)
{
	const struct sfc *sfc;
	const struct sfc_body *body;
	const struct xref_use *use = NULL;
	enum sfc_part part;
	int index;

	sfc_fresh(view);
	part = sfc_part_at_cursor(view, &index);
	if (part == SFC_NOTHING)
		return NULL;
	sfc = view->sheet->layout->sfc;
	if (view->cursor.use >= 0)
		return of_slot(xref, &sfc->use[view->cursor.use].operand);
	if (part == SFC_JUMP) {
		const struct sfc_jump *jump = &view->sheet->layout->jump[index];

		return of_slot(xref, &sfc->ref[jump->ref].name);
	}
	if (part == SFC_STEP)
		return of_slot(xref, &sfc->step[index].name);
	body = &sfc->transition[index].condition;
	if (body->kind == BODY_EXPRESSION || body->kind == BODY_RUNGS)
		use = name_in(xref, view->canvas->pou, body);
	return use ? use : of_slot(xref, &sfc->transition[index].name);
}

/* ---- life ---- */

static void ladder_sfc_view_dispose(GObject *object)
{
	LadderSfcView *view = LADDER_SFC_VIEW(object);

	canvas_close_entry(LADDER_CANVAS(view));
	sfc_forget_places(view);
	g_clear_pointer(&view->sheet, sfc_sheet_free);
	G_OBJECT_CLASS(ladder_sfc_view_parent_class)->dispose(object);
}

static void ladder_sfc_view_finalize(GObject *object)
{
	LadderSfcView *view = LADDER_SFC_VIEW(object);

	g_array_unref(view->marks);
	g_array_unref(view->found);
	g_clear_pointer(&view->missing, g_array_unref);
	g_free(view->selected);
	G_OBJECT_CLASS(ladder_sfc_view_parent_class)->finalize(object);
}

static void ladder_sfc_view_class_init(LadderSfcViewClass *class)
{
	LadderCanvasClass *canvas = LADDER_CANVAS_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_sfc_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_sfc_view_finalize;
	canvas->least_zoom = 0.3;
	canvas->keys = VERB_CHART;
	canvas->name = N_("Chart");
	canvas->size = size;
	canvas->paint = paint;
	canvas->cursor_box = cursor_box;
	canvas->reveal = reveal;
	canvas->cursor_name = cursor_name;
	canvas->place = place;
	canvas->next_keys = next_keys;
	canvas->do_verb = do_verb;
	canvas->key = move_by_key;
	canvas->type = type;
	canvas->press = press;
	canvas->can_drag = can_drag;
	canvas->drag = drag;
	canvas->drag_end = drag_end;
	canvas->menu = make_menu;
	canvas->tip = tip;
	canvas->list_cells = list_cells;
	canvas->cell_name = cell_name;
	canvas->cell_box = cell_box;
	canvas->go_to_cell = go_to_cell;
	canvas->project_changed = project_changed;
	canvas->rungs_changed = rungs_changed;
	canvas->checked = checked;
	canvas->values_changed = values_changed;
	canvas->program_gone = program_gone;
	canvas->program_changed = values_changed;
	g_signal_new("body-wanted", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST,
		0, NULL, NULL, NULL, G_TYPE_NONE, 2, G_TYPE_INT, G_TYPE_INT);
}

static void ladder_sfc_view_init(LadderSfcView *view)
{
	view->canvas = canvas_state(LADDER_CANVAS(view));
	view->found = g_array_new(FALSE, FALSE, sizeof(struct sfc_mark));
	view->cursor = view->drop = NOWHERE;
	take_drops(view);
	view->stroke = (struct sfc_stroke){ NOWHERE, NOWHERE, false, { 0, 0 } };
	view->marks = g_array_new(FALSE, TRUE, sizeof(struct sfc_mark));
}

GtkWidget *ladder_sfc_view_new(LadderDocument *document, int pou)
{
	LadderSfcView *view = g_object_new(LADDER_TYPE_SFC_VIEW, NULL);

	canvas_show(LADDER_CANVAS(view), document, pou);
	return GTK_WIDGET(view);
}
