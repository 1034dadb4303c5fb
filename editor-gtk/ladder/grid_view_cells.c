/* SPDX-License-Identifier: MIT
 *
 * grid_view_cells - the sheet as people hear it: a child for each element that is seen, and
 * for the cell at the cursor, whatever it holds.
 *
 * GTK 4.8 makes only widgets accessible, so there is one that draws nothing for each
 * element of the rungs on the screen. The one at the cursor is told as selected. They
 * follow a moment later, never while the window is laid out or scrolled.
 *
 * GTK 4.8 tells nobody of an active descendant. The sheet keeps the focus, and so the keys;
 * it is described by the cell that its cursor came to: of that readers hear, and say it.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/draw/place.h"

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
	if (widget == view->spot.widget) { /* there the cursor is already */
		gtk_widget_grab_focus(GTK_WIDGET(view));
		if (g_str_has_suffix(name, ".edit"))
			ladder_grid_view_do(view, VERB_enter);
		return;
	}
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
static void say_element(LadderGridView *view, int rung, const struct cell *cell,
			GString *text)
{
	const struct project *project = ladder_document_project(view->document);
	const struct word_row *word = words_row(&project->words, (enum word)cell->word);
	const char *operand = project_text(project, cell->operand);
	const struct grid_name name = grid_names_find(view->names, operand);

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
}

static char *name_of(LadderGridView *view, int rung, int row, int col,
		     const struct cell *cell)
{
	GString *text = g_string_new(NULL);

	say_element(view, rung, cell, text);
	act_said(view, rung, row, col, text);
	return g_string_free(text, FALSE);
}

static bool is_wire(LadderGridView *view, const struct grid_cursor *at)
{
	struct grid_place place;

	return grid_display_find(sheet_rung(view, at->rung), view->columns, at->row,
				 at->col, &place) != GRID_SEEN_EMPTY;
}

/* "Rung 3, empty cell, row 1, column B"; of an element its name and where it is, so that
 * the next one is called otherwise. @values: of what runs, too */
static char *name_at_cursor(LadderGridView *view, bool values)
{
	const struct grid_cursor *at = &view->cursor;
	GString *text = g_string_new(NULL);
	char column[PLACE_LETTERS];
	const struct cell *cell;
	int row, col;

	if (sheet_rungs(view) == 0) {
		g_string_append(text, _("no rung"));
		return g_string_free(text, FALSE);
	}
	cell = cursor_cell(view, &row, &col);
	if (cell)
		say_element(view, at->rung, cell, text);
	else
		g_string_printf(text, _("Rung %d, %s"), view->first + at->rung + 1,
				is_wire(view, at) ? _("wire") : _("empty cell"));
	if (cell && values)
		act_said(view, at->rung, row, col, text);
	g_string_append(text, ", ");
	g_string_append_printf(text, _("row %d, column %s"), at->row + 1,
			       place_column(at->col, column));
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

static bool is_at_cursor(LadderGridView *view, const struct cell_widget *slot)
{
	int row, col;

	return slot->rung == view->cursor.rung && cursor_cell(view, &row, &col) &&
	       slot->row == row && slot->col == col;
}

static void use_widget(LadderGridView *view, guint index, int rung, int row, int col,
		       const struct cell *cell)
{
	struct cell_widget *slot;

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
	name_it(view, slot, cell);
	gtk_accessible_update_state(GTK_ACCESSIBLE(slot->widget),
				    GTK_ACCESSIBLE_STATE_SELECTED,
				    is_at_cursor(view, slot), -1);
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

/* Nothing is laid out anew because it comes or goes: it is there, and hidden. */
static void show_spot(LadderGridView *view)
{
	struct sheet_spot *spot = &view->spot;
	const bool shown = sheet_rungs(view) > 0 && !cursor_cell(view, NULL, NULL);
	char *name;

	if (!spot->widget) {
		spot->widget = g_object_new(LADDER_TYPE_CELL, NULL);
		gtk_widget_set_parent(spot->widget, GTK_WIDGET(view));
	}
	if (shown) {
		name = name_at_cursor(view, false);
		gtk_accessible_update_property(GTK_ACCESSIBLE(spot->widget),
					       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
		g_free(name);
	}
	gtk_accessible_update_state(GTK_ACCESSIBLE(spot->widget),
				    GTK_ACCESSIBLE_STATE_HIDDEN, !shown,
				    GTK_ACCESSIBLE_STATE_SELECTED, shown, -1);
}

/* When the cursor is elsewhere, or something else is there; not for each new value: a
 * timer would never be silent. While an entry is open, that one is heard. */
static void tell_spot(LadderGridView *view)
{
	char *told, *text;

	if (view->entry)
		return;
	told = name_at_cursor(view, false);
	if (g_strcmp0(told, view->spot.told) != 0) {
		text = name_at_cursor(view, true);
		/* What is called the same may be another one. */
		gtk_accessible_reset_property(GTK_ACCESSIBLE(view),
					      GTK_ACCESSIBLE_PROPERTY_DESCRIPTION);
		gtk_accessible_update_property(GTK_ACCESSIBLE(view),
			GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, text, -1);
		g_free(text);
	}
	g_free(view->spot.told);
	view->spot.told = told;
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
	if (view->names) {
		show_spot(view);
		tell_spot(view);
	}
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

void cells_tell_again(LadderGridView *view)
{
	g_clear_pointer(&view->spot.told, g_free);
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

static void allocate(GtkWidget *widget, const GtkAllocation *place)
{
	gtk_widget_measure(widget, GTK_ORIENTATION_HORIZONTAL, -1, NULL, NULL, NULL, NULL);
	gtk_widget_size_allocate(widget, place, -1);
}

/* A rung far from what is seen is not laid out for this. */
static void allocate_spot(LadderGridView *view)
{
	const int rung = view->cursor.rung;
	graphene_rect_t rect;

	if (!view->spot.widget || rung >= (int)view->strips->len ||
	    !g_array_index(view->strips, struct strip, rung).layout)
		return;
	rect = cursor_rect(view);
	allocate(view->spot.widget, &(GtkAllocation){
		(int)rect.origin.x, (int)rect.origin.y, MAX((int)rect.size.width, 1),
		MAX((int)rect.size.height, 1) });
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
		allocate(cell->widget, &place);
	}
	allocate_spot(view);
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
	g_clear_pointer(&view->spot.widget, gtk_widget_unparent);
	g_clear_pointer(&view->spot.told, g_free);
}
