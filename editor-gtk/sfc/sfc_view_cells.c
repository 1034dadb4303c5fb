/* SPDX-License-Identifier: MIT
 *
 * sfc_view_cells - a chart as people hear it: a child for each box, condition and line that
 * is seen.
 *
 * As of rungs: GTK 4.8 makes only widgets accessible, so there is one that draws nothing
 * for each. The one at the cursor is told as selected, and when the cursor comes to it
 * described by the chart, which has the focus. They follow a moment later.
 */
#include "editor-gtk/sfc/sfc_view_inside.h"

#define FOLLOW_MS 60

#define LADDER_TYPE_SHAPE (ladder_shape_get_type())
G_DECLARE_FINAL_TYPE(LadderShape, ladder_shape, LADDER, SHAPE, GtkWidget)
struct _LadderShape {
	GtkWidget parent;
};
G_DEFINE_FINAL_TYPE(LadderShape, ladder_shape, GTK_TYPE_WIDGET)

static struct sfc_cell *cell_of(LadderSfcView *view, guint index)
{
	return &g_array_index(view->cells, struct sfc_cell, index);
}

/* Assistive technology acts on a shape as a click would. */
static void shape_go(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderSfcView *view = LADDER_SFC_VIEW(gtk_widget_get_parent(widget));

	(void)unused;
	for (guint i = 0; i < view->cells->len; i++) {
		if (cell_of(view, i)->widget != widget)
			continue;
		chart_go(view, cell_of(view, i)->at, false);
		gtk_widget_grab_focus(GTK_WIDGET(view));
		if (g_str_has_suffix(name, ".edit"))
			chart_ask_here(view, NULL);
		return;
	}
}

static void ladder_shape_class_init(LadderShapeClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GRID_CELL);
	gtk_widget_class_install_action(widget, "shape.go", NULL, shape_go);
	gtk_widget_class_install_action(widget, "shape.edit", NULL, shape_go);
}

static void ladder_shape_init(LadderShape *shape)
{
	gtk_widget_set_can_target(GTK_WIDGET(shape), FALSE);
}

/* ---- names ---- */

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
	if (live && chart_live_is_on(view) && view->live.step &&
	    view->live.step[index] & SFC_ACTIVE)
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

/* @live: and what it is now. */
static char *called(LadderSfcView *view, struct sfc_at at, bool live)
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
	return g_string_free(text, FALSE);
}

char *chart_said(LadderSfcView *view, struct sfc_at at)
{
	return called(view, at, true);
}

/* When the cursor is elsewhere, or something else is there; not when a step becomes
 * active. While an entry is open, that one is heard. */
static void tell_cursor(LadderSfcView *view)
{
	const struct sfc_at at = view->cursor;
	char *told, *text;

	if (view->entry || !view->sheet || at.shape < 0)
		return;
	text = called(view, at, false);
	/* What is called the same may be another one. */
	told = g_strdup_printf("%d %d %s", at.shape, at.use, text);
	g_free(text);
	if (g_strcmp0(told, view->told) != 0) {
		text = called(view, at, true);
		gtk_accessible_reset_property(GTK_ACCESSIBLE(view),
					      GTK_ACCESSIBLE_PROPERTY_DESCRIPTION);
		gtk_accessible_update_property(GTK_ACCESSIBLE(view),
			GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, text, -1);
		g_free(text);
	}
	g_free(view->told);
	view->told = told;
}

/* ---- which there are ---- */

static void use_widget(LadderSfcView *view, guint index, struct sfc_at at)
{
	struct sfc_cell *slot;
	char *name = chart_said(view, at);

	if (index >= view->cells->len) {
		struct sfc_cell fresh = { .widget = g_object_new(LADDER_TYPE_SHAPE, NULL) };

		gtk_widget_set_parent(fresh.widget, GTK_WIDGET(view));
		g_array_append_val(view->cells, fresh);
	}
	slot = cell_of(view, index);
	slot->at = at;
	if (g_strcmp0(name, slot->name) != 0)
		gtk_accessible_update_property(GTK_ACCESSIBLE(slot->widget),
					       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	g_free(slot->name);
	slot->name = name;
	gtk_accessible_update_state(GTK_ACCESSIBLE(slot->widget),
		GTK_ACCESSIBLE_STATE_SELECTED, at.shape == view->cursor.shape &&
		at.use == view->cursor.use, -1);
}

static void drop_from(LadderSfcView *view, guint from)
{
	for (guint i = from; i < view->cells->len; i++) {
		gtk_widget_unparent(cell_of(view, i)->widget);
		g_free(cell_of(view, i)->name);
	}
	g_array_set_size(view->cells, from);
}

/* What is seen of the chart, px at 100 %. */
static graphene_rect_t seen(LadderSfcView *view)
{
	GtkWidget *scroller = gtk_widget_get_ancestor(GTK_WIDGET(view),
						      GTK_TYPE_SCROLLED_WINDOW);
	GtkAdjustment *x, *y;

	if (!scroller)
		return GRAPHENE_RECT_INIT(0, 0, view->sheet->width, view->sheet->height);
	x = gtk_scrolled_window_get_hadjustment(GTK_SCROLLED_WINDOW(scroller));
	y = gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(scroller));
	return GRAPHENE_RECT_INIT((float)chart_px(view, gtk_adjustment_get_value(x)),
				  (float)chart_px(view, gtk_adjustment_get_value(y)),
				  (float)chart_px(view, gtk_adjustment_get_page_size(x)),
				  (float)chart_px(view, gtk_adjustment_get_page_size(y)));
}

static void cells_update(LadderSfcView *view)
{
	const struct sfc_layout *layout = view->sheet ? view->sheet->layout : NULL;
	graphene_rect_t page, box;
	guint used = 0;

	if (layout)
		page = seen(view);
	for (int i = 0; layout && i < layout->shape_count; i++) {
		const struct sfc_shape *shape = &layout->shape[i];

		box = sfc_sheet_box(view->sheet, i);
		if (!graphene_rect_intersection(&page, &box, NULL))
			continue;
		use_widget(view, used++, (struct sfc_at){ i, -1, false });
		for (int u = 0; shape->part == SFC_STEP &&
		     u < layout->sfc->step[shape->index].use_count; u++)
			use_widget(view, used++, (struct sfc_at){ i,
				layout->sfc->step[shape->index].first_use + u, false });
	}
	drop_from(view, used);
}

static gboolean update_now(gpointer data)
{
	LadderSfcView *view = data;
	struct sfc_live now;

	view->cells_later = 0;
	chart_fresh(view);
	/* What is said is what is shown now, drawn already or not. */
	chart_live_look(view, &now);
	cells_update(view);
	tell_cursor(view);
	gtk_widget_queue_allocate(GTK_WIDGET(view));
	return G_SOURCE_REMOVE;
}

void chart_cells_later(LadderSfcView *view)
{
	if (!view->cells_later)
		view->cells_later = g_timeout_add(FOLLOW_MS, update_now, view);
}

/* They may be older than the chart: until they follow they are not looked at. */
static bool is_there(LadderSfcView *view, struct sfc_at at)
{
	return view->sheet && at.shape < view->sheet->layout->shape_count &&
	       at.use < view->sheet->layout->sfc->use_count;
}

void chart_cells_allocate(LadderSfcView *view)
{
	const float zoom = (float)view->zoom;

	for (guint i = 0; i < view->cells->len; i++) {
		const struct sfc_cell *cell = cell_of(view, i);
		graphene_rect_t box;
		GtkAllocation place;

		if (!is_there(view, cell->at))
			continue;
		box = chart_box(view, cell->at);
		place = (GtkAllocation){ (int)(box.origin.x * zoom),
					 (int)(box.origin.y * zoom),
					 MAX((int)(box.size.width * zoom), 1),
					 MAX((int)(box.size.height * zoom), 1) };
		gtk_widget_measure(cell->widget, GTK_ORIENTATION_HORIZONTAL, -1, NULL, NULL,
				   NULL, NULL);
		gtk_widget_size_allocate(cell->widget, &place, -1);
	}
	/* Scrolled: others are seen. */
	if (view->sheet) {
		const graphene_rect_t page = seen(view);

		if (!graphene_rect_equal(&page, &view->seen))
			chart_cells_later(view);
		view->seen = page;
	}
}

void chart_cells_init(LadderSfcView *view)
{
	gtk_accessible_update_property(GTK_ACCESSIBLE(view), GTK_ACCESSIBLE_PROPERTY_LABEL,
				       _("Chart"), -1);
}

void chart_cells_clear(LadderSfcView *view)
{
	g_clear_handle_id(&view->cells_later, g_source_remove);
	drop_from(view, 0);
	g_clear_pointer(&view->told, g_free);
}
