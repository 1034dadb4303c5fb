/* SPDX-License-Identifier: MIT
 *
 * grid_view_inside - the parts of a sheet's widget. Each may call those before it: strips;
 * cursor; live; act; entry; edit; wire; drag; tell; the widget itself (grid_view.c).
 */
#ifndef EDITOR_GRID_VIEW_INSIDE_H
#define EDITOR_GRID_VIEW_INSIDE_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/sim/live_map.h"

/* A rung on its way across the sheet. Until it is laid out its height is a guess. */
struct strip {
	struct rung_layout *layout; /* NULL: not yet                           */
	GskRenderNode *node;        /* NULL: to be drawn                       */
	float y, height;            /* px at 100 %                             */
	bool measured;              /* the height is no guess                  */
	struct live_rung *live;     /* NULL: not yet, or nothing runs           */
	guint looked;               /* sheet_live.stamp when it was looked at   */
};

struct sheet_cursor {
	struct grid_cursor at;
	struct grid_cursor anchor;  /* other corner of the selection           */
	bool selecting;             /* from anchor to here; of several rungs all */
	guint64 came;               /* place in the history when the cursor came */
	int came_rung;              /* to this rung; -1: not known              */
};

/* What runs, and what of it is shown. */
struct sheet_live {
	struct live_map *map;       /* NULL: nothing runs, or it is not made yet */
	char *instance;             /* chosen; NULL: the first one             */
	guint stamp;                /* another one whenever values change       */
	guint timer;                /* for the end of what is marked as new     */
	guint say, say_values;      /* timers: names of cells follow            */
	guint drawn;                /* rungs, since the view was made           */
	bool still;                 /* nothing is scanned                      */
	guint ordered;              /* stamp when this was ordered: */
	struct location ordered_at;
	union iec_value ordered_value;
	int blocked;                /* rung; -1: none                          */
	GArray *blockers;           /* of struct grid_blocker, notes owned      */
};

/* A stroke of wire: where it could begin, and while it is drawn. */
struct sheet_wire {
	int hover;                  /* rung where one could begin; -1: not here */
	int rung;                   /* -1: none                                */
	bool pressed, drawing;      /* the button is down there; and moved       */
	bool erase, along;
	struct grid_end from, to;
	enum grid_course course;
	bool *legal;                /* rows * columns of the sheet: may it end there? */
	int rows;
};

/* What is dragged over the sheet. */
struct sheet_drop {
	struct grid_cursor at;      /* the cell that is meant; rung -1: none     */
	bool legal;                 /* it may be dropped there                  */
	enum word word;             /* ELEM_EMPTY: no element                   */
	int line;                   /* a rung would come before this one; -1: none */
	GtkDropTarget *target;
};

/* Where the button went down. */
struct sheet_press {
	double x, y;                /* px of the widget                        */
	bool takes;                 /* on something that can be dragged         */
	bool toggles;               /* its release toggles a value              */
	bool keeps;                 /* on the selection, which stays till then   */
	bool given_up;              /* Esc since then: no wire, no selection     */
};

/* A mark of the checks: rung and cell of the rung, 0-based; row -1: the whole. */
struct sheet_mark {
	int rung, row, col;
	unsigned int marks;
	const struct diag *diag;    /* lives with the document's diags         */
};

struct _LadderGridView {
	LadderCanvas parent;
	const struct canvas_state *canvas;
	int first, count;           /* rungs of the POU that are shown; -1: all  */
	GArray *strips;             /* of struct strip                         */
	int columns;                /* of the sheet                            */
	float rail;                 /* distance of the rails                   */
	struct drafting drafting;
	struct grid_names *names;
	guint idle;                 /* lays out what is not seen               */
	guint ahead;                /* draws what is seen next                  */
	int forgot_at;              /* the first rung kept, when others were forgotten */
	guint resize;               /* asks for another size, soon             */
	struct rung *preview;       /* of the cursor's rung, until its entry is done */
	bool asks_value;            /* the popup asks for a value of what runs   */
	struct sheet_cursor cursor;
	GArray *marks;              /* of struct sheet_mark                     */
	struct grid_cursor found;   /* rung -1: nothing                        */
	struct sheet_drop drop;
	struct sheet_wire wire;
	struct sheet_press press;
	struct sheet_live live;
};

/* ---- grid_view_strips.c: the rungs that are shown, and their layouts ---- */
struct pou *sheet_pou(LadderGridView *view);
int sheet_rungs(LadderGridView *view);
/** sheet_rung - as it is shown: the preview, if that one is edited. NULL: none. */
struct rung *sheet_rung(LadderGridView *view, int rung);
/** sheet_splice - as ladder_document_splice, of rungs of the sheet. */
bool sheet_splice(LadderGridView *view, int at, int removed, struct rung **rungs,
		  int inserted, struct diag_list *why);
void strips_init(LadderGridView *view);
void strips_clear(LadderGridView *view);
/** strips_reset - all rungs may be others. */
void strips_reset(LadderGridView *view);
/** strips_splice - some are. */
void strips_splice(LadderGridView *view, int at, int removed, int inserted);
/** strips_renumber - the same rungs have other numbers. */
void strips_renumber(LadderGridView *view);
/** strips_renamed - a variable of this name, at this address or "", came or went. */
void strips_renamed(LadderGridView *view, const char *name, const char *address);
/** strips_dirty - one is to be laid out anew. */
void strips_dirty(LadderGridView *view, int rung);
/** strips_redraw - one is to be drawn anew. -1: all. */
void strips_redraw(LadderGridView *view, int rung);
/** strips_at - the rung at height @y px at 100 %; the nearest one. -1: there is none. */
int strips_at(LadderGridView *view, float y);
/** strips_get - laid out. */
struct strip *strips_get(LadderGridView *view, int rung);
/** strips_lay_out - what is seen in a page of @page px, before it is drawn. */
void strips_lay_out(LadderCanvas *canvas, double page);
/** strips_resize_later - the sheet needs another size; safe while it is allocated. */
void strips_resize_later(LadderGridView *view);
float strips_width(LadderGridView *view);
float strips_height(LadderGridView *view);
/** strip_forget_live - the places of its values are others, or not needed. */
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
/** cursor_set - moves and shows it; @extend: the selection reaches there. An entry in
 * another rung is closed. */
void cursor_set(LadderGridView *view, struct grid_cursor to, bool extend);
/** cursor_fit - back into what there is. */
void cursor_fit(LadderGridView *view);
/** cursor_reveal - scrolls so far that it is seen. */
void cursor_reveal(LadderGridView *view);
/** cursor_reveal_head - the same; in the first row with the title and the comment of its
 * rung. Not for a click: there the sheet stays below the pointer. */
void cursor_reveal_head(LadderGridView *view);
/** cursor_cell_box - its cell, px at 100 %. */
graphene_rect_t cursor_cell_box(LadderGridView *view);
/** cursor_area - the selection, or its own cell. False: nothing is selected, or several
 * rungs are. */
bool cursor_area(LadderGridView *view, struct grid_area *area);
/** cursor_rungs - from the first to the last rung that is selected, or that of the cursor.
 * True: several are. */
bool cursor_rungs(LadderGridView *view, int *first, int *last);
/** cursor_selects - is (rung, row, col) part of what is selected? Of several rungs all is. */
bool cursor_selects(LadderGridView *view, int rung, int row, int col);
/** cursor_cell - the element below it; row and col of the rung too (or NULL). NULL: none. */
const struct cell *cursor_cell(LadderGridView *view, int *row, int *col);
bool cursor_key(LadderCanvas *canvas, guint key, GdkModifierType state);
/** sheet_point - what is at a point of the widget; the rung, or -1. */
int sheet_point(LadderGridView *view, double x, double y, struct rung_hit *hit);
/** hit_is_cell - is it a cell, or something in one? */
bool hit_is_cell(const struct rung_hit *hit);
struct grid_at sheet_at(LadderGridView *view);
/** sheet_put - the cursor's rung becomes @rung (taken over), the cursor goes to @at; of a
 * NULL it tells why. @name: of the step. */
bool sheet_put(LadderGridView *view, struct rung *rung, const struct grid_at *at,
	       const char *name);

/* ---- grid_view_live.c ---- */
void live_init(LadderGridView *view);
void live_clear(LadderGridView *view);
void live_values_changed(LadderCanvas *canvas);
void live_program_changed(LadderGridView *view);
void live_state_changed(LadderGridView *view);
/** live_look - a rung that is laid out is looked at, if it was not since values changed.
 * True: its drawing is not what it should be. */
bool live_look(LadderGridView *view, int rung);
/** live_rung_of - looked at; NULL: nothing runs, or the rung is being edited. */
const struct live_rung *live_rung_of(LadderGridView *view, int rung);
/** live_forget_all - the places of all rungs, and names. */
void live_forget_all(LadderGridView *view);
/** live_marks - adds those of forces and blockers. */
void live_marks(LadderGridView *view, int rung, GArray *marks);
struct live_place { LadderGridView *view; int rung; };
/** live_note - what a blocker says of a cell as shown; @place: struct live_place. NULL:
 * nothing. */
const char *live_note(void *place, int row, int column);

/* ---- grid_view_act.c: what a person does to what runs ---- */
void act_init(LadderGridView *view);
/** act_is_click - is a point, px of the sheet at 100 %, on the shape or the name of the
 * contact or coil at the cursor, and can that be toggled? */
bool act_is_click(LadderGridView *view, float x, float y);
/** act_click - toggles it. */
void act_click(LadderGridView *view);
/** act_forget - places are others: a question for a value ends. */
void act_forget(LadderGridView *view);
/** act_do - a verb that means something else while it simulates; false: it does not. */
bool act_do(LadderGridView *view, enum verb verb);
/** act_menu - a section for the element at the cursor, empty while nothing runs. Caller
 * unrefs. */
GMenuModel *act_menu(LadderGridView *view);
/** act_keys - adds what keys do there; false: nothing. */
bool act_keys(LadderGridView *view, GString *text);
/** act_tip - adds what a cell of a rung holds. */
void act_tip(LadderGridView *view, int rung, int row, int col, GString *text);
/** act_said - adds ", on", ", forced" to the name of a cell. */
void act_said(LadderGridView *view, int rung, int row, int col, GString *text);

/* ---- grid_view_entry.c: questions at the cursor ---- */
/** entry_begin - for an element. @text: typed so far */
void entry_begin(LadderGridView *view, const char *text);
/** entry_begin_word - for what a word still needs; its preview is shown. */
void entry_begin_word(LadderGridView *view, enum word word, bool parallel);
/** entry_begin_drop - the same of a word that was dropped on a cell. */
void entry_begin_drop(LadderGridView *view, enum word word, int row, int col);
/** entry_begin_edit - for what stands at the cursor. */
void entry_begin_edit(LadderGridView *view);
/** entry_begin_pin - the same; the value at a pin of the box is selected, or typed next. */
void entry_begin_pin(LadderGridView *view, const char *pin, gsize len, bool output);
/** entry_begin_text - for a title, label, comment, pin. */
void entry_begin_text(LadderGridView *view, enum verb verb);
/** entry_closed - the popup closed, or would if it was open: the preview goes. */
void entry_closed(LadderCanvas *canvas, bool was_open);

/* ---- grid_view_edit.c ---- */
/** edit_do - a verb that changes rungs, selects or copies; false: it is another verb. */
bool edit_do(LadderGridView *view, enum verb verb);
/** rungs_move - from @first to @last they come to stand before @before, as it is now; the
 * cursor goes with them. False: they stand there. */
bool rungs_move(LadderGridView *view, int first, int last, int before);

/* ---- grid_view_wire.c ---- */
void wire_init(LadderGridView *view);
/** wire_press - the button went down; true: where a wire can begin. */
bool wire_press(LadderGridView *view, double x, double y);
/** wire_drag - it moves on. @state: with Ctrl it erases */
void wire_drag(LadderGridView *view, double x, double y, GdkModifierType state);
/** wire_release - it is let go; false: nothing was drawn. */
bool wire_release(LadderGridView *view);
/** wire_forget - nothing is drawn after all. */
void wire_forget(LadderGridView *view);
void wire_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme);

/* ---- grid_view_drag.c ---- */
void drag_init(LadderGridView *view);
/** drop_takes - the cells of a rung as laid out that take what is dragged, by row, but for
 * the one that is meant; NULL: no element is dragged. Owns: the caller, g_free. */
bool *drop_takes(LadderGridView *view, int rung, const struct rung_layout *layout);
/** drop_mark - adds that of the one that is meant. */
void drop_mark(LadderGridView *view, int rung, GArray *marks);
/** drop_snapshot - the line where a rung would come. */
void drop_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme);

/* ---- grid_view_tell.c ---- */
/** tell_cell - "Rung 3, contact, closed while TRUE: Start, %IX0.0". Caller frees. */
char *tell_cell(LadderGridView *view, int rung, int row, int col, const struct cell *cell);
/** tell_cursor - "Rung 3, empty cell, row 1, column B"; of an element its name and where it
 * is, so that two of the same name differ. @values: of what runs, too. Caller frees. */
char *tell_cursor(LadderGridView *view, bool values);
char *tell_tip(LadderCanvas *canvas, int x, int y, bool by_keys);
char *tell_place(LadderCanvas *canvas);
char *tell_keys(LadderCanvas *canvas);

#endif
