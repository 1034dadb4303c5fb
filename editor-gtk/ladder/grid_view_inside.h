/* SPDX-License-Identifier: MIT
 *
 * grid_view_inside - the files of the widget grid_view. A file may call only files before it:
 * strips, cursor, live, act, entry, edit, wire, drag, tell, grid_view.c.
 */
#ifndef EDITOR_GRID_VIEW_INSIDE_H
#define EDITOR_GRID_VIEW_INSIDE_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sim/live_map.h"

/* A rung of the sheet. Its height is a guess until it is laid out. */
struct strip {
	struct rung_layout *layout; /* NULL: not yet                           */
	struct rung_fold *fold;     /* NULL: it has one line                   */
	GskRenderNode *node;        /* NULL: to be drawn                       */
	float y, height;            /* px at 100 %                             */
	bool measured;              /* FALSE: the height is a guess            */
	struct live_rung *live;     /* NULL: not yet, or nothing runs           */
	guint looked;               /* sheet_live.stamp of the values in @live  */
};

struct sheet_cursor {
	struct grid_cursor at;
	struct grid_cursor anchor;  /* other corner of the selection           */
	bool moved;                 /* by a person: the grid of its rung is drawn */
	bool selecting;             /* from anchor to at; several rungs: whole ones */
	guint64 came;               /* place in the history when the cursor came */
	int came_rung;              /* to this rung; -1: unknown                */
};

/* The running program, and what the sheet shows of it. */
struct sheet_live {
	struct live_map *map;       /* NULL: nothing runs, or it is not made yet */
	char *instance;             /* chosen; NULL: the first one             */
	guint stamp;                /* counts changes of values                 */
	guint timer;                /* ends the marks of new values             */
	guint say, say_values;      /* timers: rename the accessible children   */
	bool still;                 /* SIM_STOP: no power is drawn              */
	guint ordered;              /* stamp of the last act; 0: none           */
	struct location ordered_at;
	union iec_value ordered_value;
	int blocked;                /* rung with blockers; -1: none             */
	GArray *blockers;           /* struct grid_blocker, owns the notes      */
};

/* A wire drawn with the pointer: where it could begin, and while it is drawn. */
struct sheet_wire {
	int hover;                  /* rung where one could begin; -1: not here */
	int rung;                   /* -1: none                                */
	bool pressed, drawing;      /* the button is down; the pointer moved    */
	bool erase, along;
	struct grid_end from, to;
	bool from_ends, to_ends;    /* shown at the end of a line of a folded rung, not where the next begins */
	int line;                   /* lines of a folded rung from this one on show all rows: none above the pointer
				       grows, so that nothing moves below it */
	enum grid_course course;
	bool *legal;                /* rows * columns of the sheet: may it end there? */
	int rows;
};

/* A drag over the sheet. */
struct sheet_drop {
	struct grid_cursor at;      /* target cell; rung -1: none               */
	bool legal;                 /* the cell accepts the drop                */
	enum word word;             /* the dragged element; ELEM_EMPTY: none    */
	int line;                   /* a dragged rung goes before this one; -1: none */
	GtkDropTarget *target;
};

/* A press of the button. */
struct sheet_press {
	double x, y;                /* px of the widget                        */
	bool takes;                 /* on something that can be dragged         */
	bool toggles;               /* the release toggles a value              */
	bool keeps;                 /* on the selection, kept until the release */
	bool given_up;              /* Esc since then: no wire, no selection     */
};

/* A mark of the checks: rung and cell of the rung, 0-based; row -1: the whole. */
struct sheet_mark {
	int rung, row, col;
	unsigned int marks;
	const struct diag *diag;    /* lives with the document's diags         */
};

/* A hit of a search, likewise. */
struct found_cell {
	int rung, row, col;
	bool now;                   /* the current one                         */
};

struct _LadderGridView {
	LadderCanvas parent;
	const struct canvas_state *canvas;
	int first, count;           /* rungs of the POU that are shown; -1: all  */
	GArray *strips;             /* of struct strip                         */
	int columns;                /* of the sheet                            */
	float natural, rail;        /* distance of the rails: the least of the widest rung, as shown */
	struct drafting drafting;
	struct grid_names *names;
	guint idle;                 /* lays out rungs out of sight              */
	guint ahead;                /* draws rungs before they scroll into view */
	int forgot_at;              /* the first rung that forget_far() kept     */
	guint resize;               /* asks for another size when idle           */
	struct rung *preview;       /* of the cursor's rung while the entry is open */
	bool asks_value;            /* the popup asks for a value of the running program */
	struct sheet_cursor cursor;
	GArray *marks;              /* of struct sheet_mark                     */
	GArray *found;              /* struct found_cell, of a search, by rung */
	struct sheet_drop drop;
	struct sheet_wire wire;
	struct sheet_press press;
	struct sheet_live live;
};

/* ---- grid_view_strips.c: the rungs that are shown, and their layouts ---- */
struct pou *sheet_pou(LadderGridView *view);
int sheet_rungs(LadderGridView *view);
/** sheet_rung - a rung as shown: the preview while it is edited. NULL: no such rung. */
struct rung *sheet_rung(LadderGridView *view, int rung);
/** sheet_splice - as ladder_document_splice, of rungs of the sheet. */
bool sheet_splice(LadderGridView *view, int at, int removed, struct rung **rungs,
		  int inserted, struct diag_list *why);
void strips_init(LadderGridView *view);
void strips_clear(LadderGridView *view);
/** strips_reset - after any rung may have changed. */
void strips_reset(LadderGridView *view);
/** strips_splice - after rungs were exchanged. */
void strips_splice(LadderGridView *view, int at, int removed, int inserted);
/** strips_renumber - after rungs before the sheet's were added or removed. */
void strips_renumber(LadderGridView *view);
/** strips_renamed - after a variable was declared or deleted. @address: "": it has none. */
void strips_renamed(LadderGridView *view, const char *name, const char *address);
/** strips_dirty - lays a rung out again when it is shown next. */
void strips_dirty(LadderGridView *view, int rung);
/** strips_redraw - draws a rung again. -1: all. */
void strips_redraw(LadderGridView *view, int rung);
/** strips_at - the rung at height @y px at 100 %, or the nearest one. -1: no rungs. */
int strips_at(LadderGridView *view, float y);
/** strips_get - a strip, laid out. */
struct strip *strips_get(LadderGridView *view, int rung);
/** strips_lay_out - lays out the strips of a page of @page px before they are drawn. */
void strips_lay_out(LadderCanvas *canvas, double page);
/** strips_resize_later - asks for another size when idle; safe during allocation. */
void strips_resize_later(LadderGridView *view);
/** strips_pinned - px of the widget that the outputs of a rung are moved left: they stay visible at the
 * edge of a page that is narrower than the rungs; 0: they are not. */
float strips_pinned(LadderGridView *view, const struct strip *strip);
/** strips_pin_edge - px at 100 %, up to where elements of a rung with pinned outputs are shown: none is
 * cut. */
float strips_pin_edge(LadderGridView *view, const struct strip *strip);
/** strip_shown - where a point of the layout is shown, px at 100 %: where it is folded or pinned. */
graphene_point_t strip_shown(LadderGridView *view, const struct strip *strip, float x, float y);
/** strip_laid - the opposite: what of the layout is shown at a point. */
graphene_point_t strip_laid(LadderGridView *view, const struct strip *strip, graphene_point_t shown);
/** strip_box - a cell as shown, px at 100 %: where it is folded or pinned. */
graphene_rect_t strip_box(LadderGridView *view, const struct strip *strip, int row, int column);
/** strip_follow - after the cursor or a wire came or went: a folded rung shows the rows that they need. */
void strip_follow(LadderGridView *view, int rung);
float strips_width(LadderGridView *view);
float strips_height(LadderGridView *view);
/** strip_forget_live - after the places of its values changed. */
void strip_forget_live(struct strip *strip);
/** mark_push - adds a mark of a cell as shown to those of a drawing. */
static inline void mark_push(GArray *marks, int row, int column, unsigned int mark)
{
	const struct grid_mark one = { row, column, mark };

	g_array_append_val(marks, one);
}
static inline struct strip *strip_of(LadderGridView *view, int rung)
{
	return &g_array_index(view->strips, struct strip, rung);
}

/* ---- grid_view_cursor.c ---- */
/** cursor_set - moves the cursor and scrolls to it; @extend: with the selection. Closes an
 * entry in another rung. */
void cursor_set(LadderGridView *view, struct grid_cursor to, bool extend);
/** cursor_fit - moves the cursor back into the sheet. */
void cursor_fit(LadderGridView *view);
/** cursor_reveal - scrolls to the cursor. */
void cursor_reveal(LadderGridView *view);
/** cursor_reveal_head - the same; in the first row also to the title and comment of its
 * rung. Not for a click: the sheet must not move below the pointer. */
void cursor_reveal_head(LadderGridView *view);
/** cursor_cell_box - the cell of the cursor, px at 100 %. */
graphene_rect_t cursor_cell_box(LadderGridView *view);
/** cursor_area - the selection within a rung, else the cell of the cursor. False: nothing
 * or several rungs are selected. */
bool cursor_area(LadderGridView *view, struct grid_area *area);
/** cursor_rungs - the first and the last selected rung, or that of the cursor. True: they
 * differ. */
bool cursor_rungs(LadderGridView *view, int *first, int *last);
/** cursor_selects - is (rung, row, col) selected? */
bool cursor_selects(LadderGridView *view, int rung, int row, int col);
/** cursor_cell - the element at the cursor; NULL: none. @row, @col: get its cell; NULL: not
 * needed. */
const struct cell *cursor_cell(LadderGridView *view, int *row, int *col);
bool cursor_key(LadderCanvas *canvas, guint key, GdkModifierType state);
/** sheet_where - the point of the layout that is shown at a point, px of the widget. @rung: gets its rung; -1:
 * none. y is from the top of the rung's strip. */
graphene_point_t sheet_where(LadderGridView *view, double x, double y, int *rung);
/** sheet_point - the rung at a point, px of the widget; -1: none. @hit: the part of it. */
int sheet_point(LadderGridView *view, double x, double y, struct rung_hit *hit);
/** hit_is_cell - is it a cell or a part of one? */
bool hit_is_cell(const struct rung_hit *hit);
struct grid_at sheet_at(LadderGridView *view);
/** sheet_put - replaces the cursor's rung by @rung (taken over) as step @name of the history,
 * and moves the cursor to @at. @rung NULL: says why, by @at->refusal. */
bool sheet_put(LadderGridView *view, struct rung *rung, const struct grid_at *at,
	       const char *name);

/* ---- grid_view_live.c ---- */
void live_init(LadderGridView *view);
void live_clear(LadderGridView *view);
void live_values_changed(LadderCanvas *canvas);
void live_program_changed(LadderGridView *view);
void live_state_changed(LadderGridView *view);
/** live_look - updates the values of a rung that is laid out. True: it must be redrawn. */
bool live_look(LadderGridView *view, int rung);
/** live_rung_of - the present values; NULL: nothing runs, or the rung is being edited. */
const struct live_rung *live_rung_of(LadderGridView *view, int rung);
/** live_forget_all - forgets where the values of all rungs are. */
void live_forget_all(LadderGridView *view);
/** live_marks - adds the marks of forces and blockers. */
void live_marks(LadderGridView *view, int rung, GArray *marks);
struct live_place { LadderGridView *view; int rung; };
/** live_note - the note of a blocker at a cell as shown; @place: struct live_place. NULL:
 * none. */
const char *live_note(void *place, int row, int column);

/* ---- grid_view_act.c: values of the running program are changed ---- */
void act_init(LadderGridView *view);
/** act_is_click - would a click at a point of the layout of its rung toggle the contact or
 * coil at the cursor? It must be on its shape or name. */
bool act_is_click(LadderGridView *view, float x, float y);
/** act_click - toggles it. */
void act_click(LadderGridView *view);
/** act_forget - closes a question for a value: its place may be another. */
void act_forget(LadderGridView *view);
/** act_do - a verb with another meaning while simulating; false: it has none. */
bool act_do(LadderGridView *view, enum verb verb);
/** act_menu - a section for the element at the cursor, empty while nothing runs. Caller
 * unrefs. */
GMenuModel *act_menu(LadderGridView *view);
/** act_keys - adds the keys for the value at the cursor; false: none. */
bool act_keys(LadderGridView *view, GString *text);
/** act_tip - adds the value of a cell of a rung. */
void act_tip(LadderGridView *view, int rung, int row, int col, GString *text);
/** act_said - adds ", on", ", forced" to the name of a cell. */
void act_said(LadderGridView *view, int rung, int row, int col, GString *text);

/* ---- grid_view_entry.c: the entry at the cursor ---- */
/** entry_begin - asks for an element. @text: typed so far. */
void entry_begin(LadderGridView *view, const char *text);
/** entry_begin_box - the same; blocks are the first candidates. */
void entry_begin_box(LadderGridView *view);
/** entry_begin_word - asks for the operand of a word and shows its preview. */
void entry_begin_word(LadderGridView *view, enum word word, bool parallel);
/** entry_begin_drop - the same for a word that was dropped on a cell. */
void entry_begin_drop(LadderGridView *view, enum word word, int row, int col);
/** entry_begin_edit - asks for the operand of the element at the cursor. */
void entry_begin_edit(LadderGridView *view);
/** entry_begin_pin - the same, with the value at a pin selected, or the cursor behind its
 * name; for a free Boolean input asks for the element that feeds it. */
void entry_begin_pin(LadderGridView *view, const char *pin, gsize len, bool output);
/** entry_begin_text - asks for a title, label, comment, pin. */
void entry_begin_text(LadderGridView *view, enum verb verb);
/** entry_closed - removes the preview. @was_open: the popup was open. */
void entry_closed(LadderCanvas *canvas, bool was_open);

/* ---- grid_view_edit.c ---- */
/** edit_do - a verb that changes, selects or copies rungs; false: another verb. */
bool edit_do(LadderGridView *view, enum verb verb);
/** rungs_move - moves rungs @first to @last before the present rung @before; the cursor goes
 * with them. False: they are there already. */
bool rungs_move(LadderGridView *view, int first, int last, int before);

/* ---- grid_view_wire.c ---- */
void wire_init(LadderGridView *view);
/** wire_press - the button went down; true: a wire can begin there. */
bool wire_press(LadderGridView *view, double x, double y);
/** wire_drag - the pointer moved. @state: with Ctrl the wire is erased. */
void wire_drag(LadderGridView *view, double x, double y, GdkModifierType state);
/** wire_release - the button was released; false: nothing was drawn. */
bool wire_release(LadderGridView *view);
/** wire_forget - drops the wire. */
void wire_forget(LadderGridView *view);
void wire_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme);

/* ---- grid_view_drag.c ---- */
void drag_init(LadderGridView *view);
/** drop_takes - which cells of a rung as laid out accept the drag, row by row, without the
 * target; NULL: no element is dragged. Owns: the caller, g_free. */
bool *drop_takes(LadderGridView *view, int rung, const struct rung_layout *layout);
/** drop_mark - adds the mark of the target cell. */
void drop_mark(LadderGridView *view, int rung, GArray *marks);
/** drop_snapshot - draws the line where a dragged rung would go, or the place of an element below a rung. */
void drop_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme);

/* ---- grid_view_tell.c ---- */
/** tell_cell - "Rung 3, contact, closed while TRUE: Start, %IX0.0". Caller frees. */
char *tell_cell(LadderGridView *view, int rung, int row, int col, const struct cell *cell);
/** tell_cursor - "Rung 3, empty cell, row 1, column B"; an element has its name and place,
 * so that two of one name differ. @values: with the running value. Caller frees. */
char *tell_cursor(LadderGridView *view, bool values);
char *tell_tip(LadderCanvas *canvas, int x, int y, bool by_keys);
char *tell_place(LadderCanvas *canvas);
char *tell_keys(LadderCanvas *canvas);

#endif
