/* SPDX-License-Identifier: MIT
 *
 * grid_view_drag - drag and drop of elements and rungs on a sheet.
 *
 * A drag from a selection drags all of it. The drag content of an element is also text, the
 * names of its variables, for status charts and timing charts.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/draw/ghost.h"
#include "editor-gtk/draw/rung_fold.h"

#include "engine/base/name.h"

#include <math.h>
#include <string.h>

/* ---- the drag content ---- */

#define LADDER_TYPE_DRAG (ladder_drag_get_type())

/* An element of the palette; or one element, several, or whole rungs of a sheet. */
struct ladder_drag {
	enum word word;            /* for several: a word with the same targets */
	LadderGridView *view;      /* source; NULL: the palette                */
	struct grid_cursor from;   /* row -1: whole rungs, from here           */
	int last;                  /* to this one                              */
	bool several;              /* the elements in @area                    */
	struct grid_area area;
};

static struct ladder_drag *ladder_drag_copy(struct ladder_drag *drag)
{
	struct ladder_drag *copy = g_memdup2(drag, sizeof(*drag));

	if (copy->view)
		g_object_ref(copy->view);
	return copy;
}

static void ladder_drag_free(struct ladder_drag *drag)
{
	g_clear_object(&drag->view);
	g_free(drag);
}

static GType ladder_drag_get_type(void)
{
	static GType type;

	if (g_once_init_enter(&type))
		g_once_init_leave(&type, g_boxed_type_register_static("LadderDrag",
			(GBoxedCopyFunc)ladder_drag_copy,
			(GBoxedFreeFunc)ladder_drag_free));
	return type;
}

GdkContentProvider *ladder_grid_view_drag(enum word word)
{
	struct ladder_drag drag = { .word = word };

	return gdk_content_provider_new_typed(LADDER_TYPE_DRAG, &drag);
}

/* ---- variables of an element ---- */

static bool is_word(char c)
{
	return g_ascii_isalnum(c) || c == '_' || c & 0x80;
}

/* Length of a name with members and constant indices, or of an address; 0: neither. */
static gsize name_length(const char *text)
{
	gsize len = *text == '%';

	if (!len && (!is_word(*text) || g_ascii_isdigit(*text)))
		return 0;
	while (is_word(text[len]) || (text[len] == '.' && is_word(text[len + 1])))
		len++;
	while (text[len] == '[') {
		const gsize index = strspn(text + len + 1, "-0123456789,");

		if (text[len + 1 + index] != ']')
			break;
		len += index + 2;
		while (is_word(text[len]) || text[len] == '.')
			len++;
	}
	return len;
}

static bool is_declared(const struct project *project, const struct var_table *vars,
			const char *name)
{
	const gsize len = strcspn(name, ".[");

	for (int i = 0; i < vars->count; i++)
		if (name_is(project_text(project, vars->var[i].name), name, len))
			return true;
	return false;
}

/* "Main.Count" of Count; NULL: no variable, or one of a function block without an
 * instance. */
static char *full_name(LadderGridView *view, const char *name)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct pou *pou = sheet_pou(view);
	const char *owner = pou->kind == POU_PROGRAM || pou->kind == POU_SUBROUTINE ?
		project_text(project, pou->name) : ladder_grid_view_instance(view);

	if (*name == '%')
		return g_strdup(name);
	if (is_declared(project, &pou->vars, name))
		return owner ? g_strconcat(owner, ".", name, NULL) : NULL;
	return is_declared(project, &project->globals, name) ? g_strdup(name) : NULL;
}

/* Is it the name of a pin, as IN1 in `IN1:=Count`? */
static bool is_pin(const char *behind)
{
	behind += strspn(behind, " ");
	return g_str_has_prefix(behind, ":=") || g_str_has_prefix(behind, "=>");
}

static void take_names(LadderGridView *view, const char *text, bool args, GPtrArray *names)
{
	while (*text) {
		const gsize len = name_length(text);
		char *name = len ? g_strndup(text, len) : NULL;
		char *full = name && !(args && is_pin(text + len)) ? full_name(view, name) :
								     NULL;

		if (full && !g_ptr_array_find_with_equal_func(names, full, g_str_equal, NULL))
			g_ptr_array_add(names, g_steal_pointer(&full));
		g_free(full);
		g_free(name);
		/* Skip T#5s and the like: letters behind a number are no name. */
		text += len ? len : MAX(strspn(text, "0123456789#_."), 1);
	}
}

/* The variables of an element: "Main.Count Level %IW2"; "": none. Caller frees. */
static char *variables_of(LadderGridView *view, const struct cell *cell)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	char *all;

	take_names(view, project_text(project, cell->operand), false, names);
	if (names->len == 0 && cell->args && cell->word != ELEM_EXECUTE)
		take_names(view, project_text(project, cell->args), true, names);
	g_ptr_array_add(names, NULL);
	all = g_strjoinv(" ", (char **)names->pdata);
	g_ptr_array_unref(names);
	return all;
}

/* ---- marks of the drop target ---- */

#define LINE      3 /* px thick; odd, so that its middle is a pixel            */
#define KNOB     11 /* px square, at the ends of the line                      */

static void drop_word(LadderGridView *view, enum word word)
{
	if (word == view->drop.word)
		return;
	view->drop.word = word;
	strips_redraw(view, -1);
}

static const char *why_not(LadderGridView *view, int rung, int row, int col)
{
	struct grid_at at = { .columns = view->columns, .row = row, .col = col };

	rung_free(grid_drop(sheet_rung(view, rung), &at,
			    (struct cell){ .word = (uint16_t)view->drop.word }));
	return _(grid_refusal_text(at.refusal));
}

static void drop_at_cell(LadderGridView *view, int rung, int row, int col, bool legal)
{
	const int before = view->drop.at.rung;

	if (rung == before && row == view->drop.at.row && col == view->drop.at.col &&
	    legal == view->drop.legal)
		return;
	view->drop.at = (struct grid_cursor){ rung, row, col };
	view->drop.legal = legal;
	if (rung >= 0) /* the message stays after a refused drop */
		canvas_tell(LADDER_CANVAS(view), legal ? "" : why_not(view, rung, row, col));
	if (before >= 0)
		strips_redraw(view, before);
	if (rung >= 0)
		strips_redraw(view, rung);
}

/* ---- a row that is not there yet: a slot below the last row of the rung, or of a line of a folded
 * one. The rung keeps its height, so nothing runs away from the pointer. ---- */

#define DROP_BELOW  18 /* px under the wire where the row below begins          */
#define DROP_BEYOND 14 /* px of the slot in the head of the next rung           */

/* The bottom of the slots below a rung, px at 100 %. */
static float slots_end(LadderGridView *view, int rung)
{
	const struct strip *strip = strips_get(view, rung);

	return strip->y + strip->height + (rung + 1 < sheet_rungs(view) ? DROP_BEYOND : RUNG_CELL_HEIGHT);
}

/* False: the target is a row that is shown, or none. @slot: px at 100 %. */
static bool drop_slot(LadderGridView *view, graphene_rect_t *slot)
{
	const struct grid_cursor *at = &view->drop.at;
	const struct strip *strip = sheet_rung(view, at->rung) ? strips_get(view, at->rung) : NULL;
	float x, top, bottom;
	int rows, line;

	if (!strip || at->row < 1 || at->col >= strip->layout->columns || at->row > strip->layout->rows)
		return false;
	x = strip->layout->column_x[at->col] + strip->layout->column_width[at->col] / 2;
	line = strip->fold ? rung_fold_line_at(strip->fold, x) : 0;
	rows = strip->fold ? strip->fold->line[line].rows : strip->layout->rows;
	if (at->row < rows)
		return false;
	top = strip_shown(view, strip, x, strip->layout->row[at->row - 1].wire + DROP_BELOW).y;
	bottom = strip->fold && line + 1 < strip->fold->lines ? strip->y + strip->fold->line[line + 1].y :
								 slots_end(view, at->rung);
	*slot = strip_box(view, strip, at->row - 1, at->col);
	*slot = GRAPHENE_RECT_INIT(slot->origin.x + 1, top, slot->size.width - 2, bottom - top);
	return true;
}

/* The rung whose slots are at a point, px of the widget; -1: none. @hit: its last row there. */
static int slots_at(LadderGridView *view, double x, double y, struct rung_hit *hit)
{
	const graphene_point_t at = canvas_point(LADDER_CANVAS(view), x, y);
	int rung = strips_at(view, at.y);
	const struct rung_row *last;
	const struct strip *strip;
	graphene_point_t laid;

	if (rung > 0 && at.y < strips_get(view, rung)->y + DROP_BEYOND)
		rung--;
	if (rung < 0 || at.y >= slots_end(view, rung))
		return -1;
	strip = strips_get(view, rung);
	laid = strip_laid(view, strip, at);
	last = &strip->layout->row[strip->layout->rows - 1];
	if (at.y < strip->y + strip->height && laid.y < last->y + last->height)
		return -1;
	laid.y = MIN(laid.y, last->y + last->height - 1);
	*hit = rung_layout_hit(&view->drafting, strip->layout, laid.x, laid.y);
	return hit_is_cell(hit) ? rung : -1;
}

bool *drop_takes(LadderGridView *view, int rung, const struct rung_layout *layout)
{
	const struct grid_cursor *meant = &view->drop.at;
	bool *takes;

	if (view->drop.word == ELEM_EMPTY)
		return NULL;
	takes = g_new0(bool, layout->rows * layout->columns);
	grid_takes(sheet_rung(view, rung), layout->columns, layout->rows, view->drop.word,
		   takes);
	if (rung == meant->rung && meant->row < layout->rows && meant->col < layout->columns)
		takes[meant->row * layout->columns + meant->col] = false; /* drawn with a frame */
	return takes;
}

void drop_mark(LadderGridView *view, int rung, GArray *marks)
{
	if (rung == view->drop.at.rung && view->drop.legal)
		mark_push(marks, view->drop.at.row, view->drop.at.col, MARK_DROP);
}

/* ---- a rung ---- */

static void drop_line(LadderGridView *view, int before)
{
	if (before == view->drop.line)
		return;
	view->drop.line = before;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static int drop_boundary(LadderGridView *view, double y)
{
	const float at = canvas_point(LADDER_CANVAS(view), 0, y).y;
	const int rung = strips_at(view, at);
	const struct strip *strip;

	if (rung < 0)
		return 0;
	strip = strips_get(view, rung);
	return at > strip->y + strip->height / 2 ? rung + 1 : rung;
}

static void fill(GtkSnapshot *snapshot, const struct theme *theme, float x, float y,
		 float width, float height)
{
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_ACCENT],
				  &GRAPHENE_RECT_INIT(x, y, width, height));
}

#define FRAME 1.5f /* px thick; as that of a cell that takes the drop             */
#define DASH  5    /* px                                                          */

static void snapshot_slot(GtkSnapshot *snapshot, const struct theme *theme, const graphene_rect_t *r)
{
	const float x = r->origin.x, y = r->origin.y, width = r->size.width, height = r->size.height;
	GdkRGBA wash = theme->color[TOKEN_ACCENT];

	wash.alpha = theme->wash;
	gtk_snapshot_append_color(snapshot, &wash, r);
	for (float at = 0; at < width; at += 2 * DASH) {
		fill(snapshot, theme, x + at, y, MIN(DASH, width - at), FRAME);
		fill(snapshot, theme, x + at, y + height - FRAME, MIN(DASH, width - at), FRAME);
	}
	for (float at = 0; at < height; at += 2 * DASH) {
		fill(snapshot, theme, x, y + at, FRAME, MIN(DASH, height - at));
		fill(snapshot, theme, x + width - FRAME, y + at, FRAME, MIN(DASH, height - at));
	}
}

static void snapshot_line(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme)
{
	const float width = (float)gtk_widget_get_width(GTK_WIDGET(view));
	const double top = gtk_adjustment_get_value(view->canvas->adjustment[1]);
	float y;

	if (view->drop.line < 0)
		return;
	y = view->drop.line < sheet_rungs(view) ? strips_get(view, view->drop.line)->y :
						  strips_height(view);
	y = MAX(roundf((float)((double)y * view->canvas->zoom - top)), LINE / 2); /* at the top */
	fill(snapshot, theme, 0, y - LINE / 2, width, LINE);
	fill(snapshot, theme, 0, y - KNOB / 2, KNOB, KNOB);
	fill(snapshot, theme, width - KNOB, y - KNOB / 2, KNOB, KNOB);
}

void drop_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme)
{
	graphene_rect_t slot;

	snapshot_line(view, snapshot, theme);
	if (view->drop.legal && drop_slot(view, &slot)) {
		slot = canvas_rect(LADDER_CANVAS(view), slot);
		snapshot_slot(snapshot, theme, &slot);
	}
}

static void drop_rung_ghost(LadderGridView *view, GtkDragSource *source, int rung)
{
	const struct strip *strip = strips_get(view, rung);
	const graphene_point_t at = canvas_point(LADDER_CANVAS(view), view->press.x,
						 view->press.y);

	if (strip->layout)
		ghost_rung(source, &view->drafting, strip->layout,
			   canvas_theme(LADDER_CANVAS(view)), (float)view->canvas->zoom, at.x,
			   at.y - strip->y);
}

/* ---- the end ---- */

static void drop_forget(LadderGridView *view)
{
	drop_word(view, ELEM_EMPTY);
	drop_at_cell(view, -1, 0, 0, false);
	drop_line(view, -1);
}

/* ---- dragging an element or a rung ---- */

/* Adds the variables of the element as text. @element: taken over. */
static GdkContentProvider *with_names(LadderGridView *view, const struct cell *cell,
				      GdkContentProvider *element)
{
	char *names = variables_of(view, cell);
	GdkContentProvider *both[] = { element, NULL };

	if (*names)
		both[1] = gdk_content_provider_new_typed(G_TYPE_STRING, names);
	g_free(names);
	return both[1] ? gdk_content_provider_new_union(both, 2) : element;
}

static GdkContentProvider *provide(const struct ladder_drag *drag)
{
	return gdk_content_provider_new_typed(LADDER_TYPE_DRAG, drag);
}

/* The selected elements; NULL: there are none. */
static GdkContentProvider *drag_area(LadderGridView *view, struct ladder_drag *drag)
{
	const struct rung *rung = sheet_rung(view, drag->from.rung);
	struct rung *part = grid_copy(rung, view->columns, &drag->area);

	if (!part)
		return NULL;
	drag->several = true;
	drag->word = grid_is_outputs(part) ? ELEM_COIL : ELEM_CONTACT_NO;
	drag->from.row = drag->area.row;
	drag->from.col = drag->area.col;
	rung_free(part);
	return provide(drag);
}

static GdkContentProvider *drag_prepare(GtkDragSource *source, double x, double y,
					LadderGridView *view)
{
	struct ladder_drag drag = { .view = view };
	struct rung_hit hit;
	const int rung = sheet_point(view, x, y, &hit);
	const struct cell *cell;
	bool rungs;

	(void)source;
	if (rung < 0 || view->canvas->entry)
		return NULL;
	drag.from = (struct grid_cursor){ rung, -1, -1 };
	rungs = cursor_rungs(view, &drag.from.rung, &drag.last);
	if (rungs && view->press.keeps)
		return provide(&drag);
	if (rung != view->cursor.at.rung)
		return NULL;
	if (hit.part == RUNG_PART_NUMBER)
		return provide(&drag);
	if (view->press.keeps && cursor_area(view, &drag.area))
		return drag_area(view, &drag);
	cell = cursor_cell(view, NULL, NULL);
	if (!hit_is_cell(&hit) || !cell || !view->press.takes)
		return NULL;
	drag.word = (enum word)cell->word;
	drag.from = view->cursor.at;
	return with_names(view, cell, provide(&drag));
}

static void drag_begin(GtkDragSource *source, GdkDrag *begun, LadderGridView *view)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct ladder_drag *drag;
	GValue value = G_VALUE_INIT;

	g_value_init(&value, LADDER_TYPE_DRAG);
	if (!gdk_content_provider_get_value(gdk_drag_get_content(begun), &value, NULL))
		goto unset;
	drag = g_value_get_boxed(&value);
	if (drag->from.row < 0)
		drop_rung_ghost(view, source, drag->from.rung);
	else if (project)
		ghost_element(source, words_row(&project->words, drag->word),
			      canvas_theme(LADDER_CANVAS(view)), view->canvas->lettering);
unset:
	g_value_unset(&value);
}

/* ---- dropping ---- */

static const struct ladder_drag *dragged(GtkDropTarget *target)
{
	const GValue *value = gtk_drop_target_get_value(target);

	return value && G_VALUE_HOLDS(value, LADDER_TYPE_DRAG) ?
	       g_value_get_boxed(value) : NULL;
}

/* The lower part of the cell of an element means the row below. */
static bool is_below(LadderGridView *view, int rung, const struct rung_hit *hit, double x, double y)
{
	int here;

	return sheet_where(view, x, y, &here).y > strips_get(view, rung)->layout->row[hit->row].wire + DROP_BELOW;
}

/* The target cell: below an element the free cell of a new branch; below the last row a new
 * row, in the slot that drop_slot() draws. */
static int drop_at(LadderGridView *view, double x, double y, struct rung_hit *hit,
		   enum word word)
{
	int rung = sheet_point(view, x, y, hit);
	const bool inside = rung >= 0 && hit_is_cell(hit);
	enum grid_drop how;

	if (inside && !is_below(view, rung, hit, x, y))
		return rung;
	if (!inside)
		rung = slots_at(view, x, y, hit);
	if (rung < 0)
		return -1;
	how = grid_can_drop(sheet_rung(view, rung), view->columns, hit->row + 1,
			    hit->column, word);
	if (how == GRID_DROP_BELOW || (!inside && how != GRID_DROP_NOT))
		hit->row++;
	else if (!inside)
		return -1;
	return rung;
}

static bool is_rung(const struct ladder_drag *drag)
{
	return drag && drag->view && drag->from.row < 0;
}

/* Rungs change places within a program. */
static bool takes_rung(LadderGridView *view, const struct ladder_drag *drag)
{
	return drag->view == view && view->count < 0;
}

/* Marks the target of the drop; 0: refused. */
static GdkDragAction show_drop(LadderGridView *view, double x, double y)
{
	const struct ladder_drag *drag = dragged(view->drop.target);
	const enum word word = drag ? drag->word : ELEM_EMPTY;
	struct rung_hit hit;
	bool legal;
	int rung;

	if (is_rung(drag)) {
		drop_line(view, takes_rung(view, drag) ? drop_boundary(view, y) : -1);
		return takes_rung(view, drag) ? GDK_ACTION_MOVE : 0;
	}
	drop_word(view, word);
	rung = drop_at(view, x, y, &hit, word);
	if (rung < 0) {
		drop_at_cell(view, -1, 0, 0, false);
		return 0;
	}
	legal = drag && grid_can_drop(sheet_rung(view, rung), view->columns, hit.row,
				      hit.column, drag->word) != GRID_DROP_NOT;
	drop_at_cell(view, rung, hit.row, hit.column, legal);
	return !legal ? 0 : drag->view ? GDK_ACTION_MOVE : GDK_ACTION_COPY;
}

static void drop_again(LadderCanvas *canvas, double x, double y, GdkModifierType state)
{
	LadderGridView *view = LADDER_GRID_VIEW(canvas);
	GdkDrop *drop = gtk_drop_target_get_current_drop(view->drop.target);
	const GdkDragAction action = show_drop(view, x, y);

	(void)state;
	if (drop)
		gdk_drop_status(drop, action, action);
}

static GdkDragAction drop_motion(GtkDropTarget *target, double x, double y,
				 LadderGridView *view)
{
	(void)target;
	canvas_scroll_at_edge(LADDER_CANVAS(view), x, y, 0, drop_again);
	return show_drop(view, x, y);
}

static void drop_leave(GtkDropTarget *target, LadderGridView *view)
{
	(void)target;
	canvas_end_drag(LADDER_CANVAS(view));
	drop_forget(view);
}

/* The cursor moves with the rungs. */
static bool move_rungs(LadderGridView *view, const struct ladder_drag *drag, int before)
{
	return takes_rung(view, drag) &&
	       rungs_move(view, drag->from.rung, drag->last, before);
}

/* NULL: refused, with the reason in @at or @from. */
static struct rung *moved(const struct ladder_drag *drag, const struct rung *from_rung,
			  struct grid_at *from, const struct rung *to_rung,
			  struct grid_at *at, struct rung **source)
{
	bool below;

	if (!drag->several)
		return grid_move(from_rung, from, to_rung, at, source);
	below = grid_can_drop(to_rung, at->columns, at->row, at->col, drag->word) ==
		GRID_DROP_BELOW;
	at->row -= below; /* the row of the element that the branch goes round */
	return grid_move_area(from_rung, from, &drag->area, to_rung, at, below, source);
}

/* A move from one rung to another is one step of the history. */
static void move_between(LadderGridView *view, const struct ladder_drag *drag,
			 struct grid_cursor to)
{
	struct rung *from_rung = sheet_rung(drag->view, drag->from.rung);
	struct rung *to_rung = sheet_rung(view, to.rung), *source = NULL, *made;
	struct grid_at from = { drag->view->columns, drag->from.row, drag->from.col, 0 };
	struct grid_at at = { view->columns, to.row, to.col, 0 };
	const bool same = from_rung == to_rung;

	if (!from_rung || !to_rung || drag->view->canvas->document != view->canvas->document)
		return;
	made = moved(drag, from_rung, &from, to_rung, &at, &source);
	if (!made) {
		canvas_tell(LADDER_CANVAS(view), _(grid_refusal_text(at.refusal ? at.refusal :
						     from.refusal)));
		return;
	}
	ladder_document_begin(view->canvas->document, drag->several ? _("Move elements") :
			      _("Move element"), NULL);
	if (!same && source)
		sheet_splice(drag->view, drag->from.rung, 1, &source, 1, NULL);
	sheet_splice(view, to.rung, 1, &made, 1, NULL);
	ladder_document_end(view->canvas->document);
	cursor_set(view, (struct grid_cursor){ to.rung, at.row, at.col }, false);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
			LadderGridView *view)
{
	const struct ladder_drag *drag = g_value_get_boxed(value);
	struct rung_hit hit;
	int rung;

	(void)target;
	canvas_end_drag(LADDER_CANVAS(view));
	drop_forget(view);
	if (canvas_is_fixed(LADDER_CANVAS(view)))
		return FALSE;
	if (is_rung(drag))
		return move_rungs(view, drag, drop_boundary(view, y));
	rung = drop_at(view, x, y, &hit, drag->word);
	if (rung < 0)
		return FALSE;
	if (drag->view) {
		move_between(view, drag, (struct grid_cursor){ rung, hit.row, hit.column });
		return TRUE;
	}
	cursor_set(view, (struct grid_cursor){ rung, hit.row, hit.column }, false);
	entry_begin_drop(view, drag->word, hit.row, hit.column);
	return TRUE;
}

/* ---- all of it ---- */

void drag_init(LadderGridView *view)
{
	GtkDragSource *source = gtk_drag_source_new();
	GtkDropTarget *target = gtk_drop_target_new(LADDER_TYPE_DRAG,
						    GDK_ACTION_COPY | GDK_ACTION_MOVE);

	gtk_drag_source_set_actions(source, GDK_ACTION_COPY | GDK_ACTION_MOVE);
	g_signal_connect(source, "prepare", G_CALLBACK(drag_prepare), view);
	g_signal_connect(source, "drag-begin", G_CALLBACK(drag_begin), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(source));
	view->drop.target = target;
	gtk_drop_target_set_preload(target, TRUE);
	g_signal_connect(target, "motion", G_CALLBACK(drop_motion), view);
	g_signal_connect(target, "leave", G_CALLBACK(drop_leave), view);
	g_signal_connect(target, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(target));
}
