/* SPDX-License-Identifier: MIT
 *
 * grid_view_cells - the sheet as people hear it: a child for each element that is seen.
 *
 * GTK 4.8 makes only widgets accessible, so there is one that draws nothing for each
 * element of the rungs on the screen. The one at the cursor is told as selected. They
 * follow a moment later, never while the window is laid out or scrolled.
 */
#include "editor-gtk/grid_view_inside.h"

#define FOLLOW_MS 60

#define LADDER_TYPE_CELL (ladder_cell_get_type())
G_DECLARE_FINAL_TYPE(LadderCell, ladder_cell, LADDER, CELL, GtkWidget)
struct _LadderCell {
	GtkWidget parent;
};
G_DEFINE_FINAL_TYPE(LadderCell, ladder_cell, GTK_TYPE_WIDGET)

static struct cell_widget *cell_of(LadderGridView *view, guint index)
{
	return &g_array_index(view->cells, struct cell_widget, index);
}

/* Assistive technology acts on a cell as a click would. */
static void cell_go(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderGridView *view = LADDER_GRID_VIEW(gtk_widget_get_parent(widget));

	(void)unused;
	for (guint i = 0; i < view->cells->len; i++) {
		struct cell_widget cell = *cell_of(view, i);

		if (cell.widget != widget)
			continue;
		ladder_grid_view_go(view, cell.rung, cell.row, cell.col);
		if (g_str_has_suffix(name, ".edit"))
			ladder_grid_view_do(view, VERB_enter);
		return;
	}
}

static void ladder_cell_class_init(LadderCellClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GRID_CELL);
	gtk_widget_class_install_action(widget, "cell.go", NULL, cell_go);
	gtk_widget_class_install_action(widget, "cell.edit", NULL, cell_go);
}

static void ladder_cell_init(LadderCell *cell)
{
	gtk_widget_set_can_target(GTK_WIDGET(cell), FALSE);
}

/* ---- names ---- */

/* "Rung 3, contact, closed while TRUE: Start, %IX0.0". */
static char *name_of(LadderGridView *view, int rung, int row, int col,
		     const struct cell *cell)
{
	const struct project *project = ladder_document_project(view->document);
	const struct word_row *word = words_row(&project->words, (enum word)cell->word);
	const char *operand = project_text(project, cell->operand);
	const struct grid_name name = grid_names_find(view->names, operand);
	GString *text = g_string_new(NULL);

	g_string_printf(text, _("Rung %d, %s"), view->first + rung + 1,
			word->word[0] ? word->word : word->id);
	if (words_explain(word)[0])
		g_string_append_printf(text, ", %s", _(words_explain(word)));
	if (operand[0])
		g_string_append_printf(text, ": %s", operand);
	if (name.symbol[0] && g_ascii_strcasecmp(name.symbol, operand) != 0)
		g_string_append_printf(text, ", %s", name.symbol);
	if (name.address[0] && g_ascii_strcasecmp(name.address, operand) != 0)
		g_string_append_printf(text, ", %s", name.address);
	if (cell->args)
		g_string_append_printf(text, ", %s", project_text(project, cell->args));
	act_said(view, rung, row, col, text);
	return g_string_free(text, FALSE);
}

static bool is_named(const struct cell *cell)
{
	return cell->word != ELEM_EMPTY && cell->word != ELEM_WIRE &&
	       cell->word != ELEM_PIN;
}

/* ---- which there are ---- */

static void name_it(LadderGridView *view, struct cell_widget *slot, const struct cell *cell)
{
	char *name = name_of(view, slot->rung, slot->row, slot->col, cell);

	if (g_strcmp0(name, slot->name) != 0)
		gtk_accessible_update_property(GTK_ACCESSIBLE(slot->widget),
					       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
	g_free(slot->name);
	slot->name = name;
}

static void use_widget(LadderGridView *view, guint index, int rung, int row, int col,
		       const struct cell *cell)
{
	struct cell_widget *slot;
	bool selected;

	if (index >= view->cells->len) {
		struct cell_widget fresh = {
			.widget = g_object_new(LADDER_TYPE_CELL, NULL),
		};

		gtk_widget_set_parent(fresh.widget, GTK_WIDGET(view));
		g_array_append_val(view->cells, fresh);
	}
	slot = cell_of(view, index);
	slot->rung = rung;
	slot->row = row;
	slot->col = col;
	selected = rung == view->cursor.rung && row == view->cursor.row &&
		grid_display_column(sheet_rung(view, rung), view->columns, row, col) ==
		view->cursor.col;
	name_it(view, slot, cell);
	gtk_accessible_update_state(GTK_ACCESSIBLE(slot->widget),
				    GTK_ACCESSIBLE_STATE_SELECTED, selected, -1);
}

static guint use_rung(LadderGridView *view, int rung, guint used)
{
	const struct rung *shown = sheet_rung(view, rung);

	for (int row = 0; row < shown->rows; row++)
		for (int col = 0; col < shown->cols; col++) {
			const struct cell *cell = rung_at(shown, row, col);

			if (is_named(cell))
				use_widget(view, used++, rung, row, col, cell);
		}
	return used;
}

static void drop_from(LadderGridView *view, guint from)
{
	for (guint i = from; i < view->cells->len; i++) {
		gtk_widget_unparent(cell_of(view, i)->widget);
		g_free(cell_of(view, i)->name);
	}
	g_array_set_size(view->cells, from);
}

static void cells_update(LadderGridView *view)
{
	const double zoom = view->zoom;
	const double top = gtk_adjustment_get_value(view->adjustment[1]) / zoom;
	const double end = top + gtk_widget_get_height(GTK_WIDGET(view)) / zoom;
	guint used = 0;

	if (view->names)
		for (int i = strips_at(view, (float)top);
		     i >= 0 && i < (int)view->strips->len; i++) {
			if (strips_get(view, i)->y > end)
				break;
			used = use_rung(view, i, used);
		}
	drop_from(view, used);
}

static gboolean update_now(gpointer data)
{
	LadderGridView *view = data;

	view->cells_idle = 0;
	cells_update(view);
	gtk_widget_queue_allocate(GTK_WIDGET(view));
	return G_SOURCE_REMOVE;
}

void cells_later(LadderGridView *view)
{
	if (!view->cells_idle)
		view->cells_idle = g_timeout_add(FOLLOW_MS, update_now, view);
}

void cells_scrolled(LadderGridView *view)
{
	g_clear_handle_id(&view->cells_idle, g_source_remove);
	cells_later(view);
}

/* It may be older than the rungs: until cells_update() it is not looked at. */
static bool is_there(LadderGridView *view, const struct cell_widget *cell)
{
	const struct rung *shown = sheet_rung(view, cell->rung);

	return shown && cell->rung < (int)view->strips->len && cell->row < shown->rows &&
	       cell->col < shown->cols;
}

void cells_rename(LadderGridView *view)
{
	for (guint i = 0; view->names && i < view->cells->len; i++) {
		struct cell_widget *slot = cell_of(view, i);
		const struct cell *cell = is_there(view, slot) ?
			rung_at(sheet_rung(view, slot->rung), slot->row, slot->col) : NULL;

		if (cell && is_named(cell))
			name_it(view, slot, cell);
	}
}

void cells_allocate(LadderGridView *view)
{
	const float zoom = (float)view->zoom;

	for (guint i = 0; i < view->cells->len; i++) {
		const struct cell_widget *cell = cell_of(view, i);

		if (!is_there(view, cell))
			continue;

		struct strip *strip = strips_get(view, cell->rung);
		const int column = rung_layout_column(strip->layout, cell->row, cell->col);
		graphene_rect_t rect = rung_layout_cell(strip->layout, cell->row, column);
		GtkAllocation place;

		rect.origin.y += strip->y;
		place.x = (int)(rect.origin.x * zoom -
				(float)gtk_adjustment_get_value(view->adjustment[0]));
		place.y = (int)(rect.origin.y * zoom -
				(float)gtk_adjustment_get_value(view->adjustment[1]));
		place.width = MAX((int)(rect.size.width * zoom), 1);
		place.height = MAX((int)(rect.size.height * zoom), 1);
		gtk_widget_measure(cell->widget, GTK_ORIENTATION_HORIZONTAL, -1, NULL,
				   NULL, NULL, NULL);
		gtk_widget_size_allocate(cell->widget, &place, -1);
	}
}

static void cursor_moved(LadderGridView *view)
{
	cells_later(view);
}

void cells_init(LadderGridView *view)
{
	gtk_accessible_update_property(GTK_ACCESSIBLE(view),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, _("Sheet"), -1);
	g_signal_connect(view, "cursor-moved", G_CALLBACK(cursor_moved), NULL);
}

void cells_clear(LadderGridView *view)
{
	g_clear_handle_id(&view->cells_idle, g_source_remove);
	drop_from(view, 0);
}
