/* SPDX-License-Identifier: MIT
 *
 * grid_view_inside - what the files of a sheet share. Only editor-gtk/grid_view*.c include it.
 */
#ifndef EDITOR_GRID_VIEW_INSIDE_H
#define EDITOR_GRID_VIEW_INSIDE_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/edit/grid_edit.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/ladder/grid_view_live.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_map.h"

#include "engine/xref/xref.h"

/* A rung on its way across the sheet. What is not laid out yet has a height that was
 * guessed. */
struct strip {
	struct rung_layout *layout; /* NULL: not yet                           */
	GskRenderNode *node;        /* NULL: to be drawn                       */
	float y, height;            /* px at 100 %                             */
	bool measured;              /* the height is no guess                  */
	struct live_rung *live;     /* NULL: not yet, or nothing runs           */
	guint looked;               /* sheet_live.stamp when it was looked at   */
};

/* What runs, and what of it is shown. */
struct sheet_live {
	LadderSim *sim;             /* NULL: none was given                    */
	gulong handler[3];
	struct live_map *map;       /* NULL: it is off, or not yet              */
	char *instance;             /* chosen; NULL: the first one             */
	guint stamp;                /* another one whenever values are          */
	guint timer;                /* when something is new no more            */
	guint say, say_values;      /* when names of cells are told             */
	guint drawn;                /* rungs, since the view was made           */
	bool still;                 /* nothing is scanned                      */
	guint ordered;              /* stamp when this was ordered: */
	struct location ordered_at;
	union iec_value ordered_value;
	int blocked;                /* rung; -1: none                          */
	GArray *blockers;           /* of struct grid_blocker, notes owned      */
};

/* A cell that assistive technology can name: a widget that draws nothing. */
struct cell_widget {
	GtkWidget *widget;
	int rung, row, col;
	char *name;                 /* that it is called by                     */
};

/* The cell at the cursor, for those who hear it. */
struct sheet_spot {
	GtkWidget *widget;          /* of a wire or an empty cell; hidden at an element */
	char *told;                 /* that the sheet is described by, without values */
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

/* Something is dragged near an edge; (x, y) px of the widget. */
typedef void (*edge_call)(LadderGridView *view, double x, double y, GdkModifierType state);
struct sheet_edge {
	guint timer;                /* 0: it does not scroll                   */
	double x, y;
	GdkModifierType state;
	edge_call again;
};

struct _LadderGridView {
	GtkWidget parent;
	LadderDocument *document;
	int pou;
	int first, count;           /* rungs of the POU that are shown; -1: all  */
	gulong handler[5];          /* of the document's signals               */

	GArray *strips;             /* of struct strip                         */
	int columns;                /* of the sheet                            */
	float rail;                 /* distance of the rails                   */
	struct drafting drafting;
	struct grid_names *names;
	struct lettering *lettering;
	const struct theme *theme;  /* NULL: to be looked up                   */
	double zoom;
	guint idle;                 /* lays out what is not seen               */
	guint ahead;                /* draws what is seen next                  */
	int forgot_at;              /* the first rung kept, when others were forgotten */
	guint resize;               /* asks for another size, soon             */
	bool allocating;

	struct grid_cursor cursor;
	struct grid_cursor anchor;  /* other corner of the selection           */
	bool reveal;                /* it is to be seen, as soon as there is a size */
	bool selecting;             /* from anchor to cursor; of several rungs all */
	struct rung *preview;       /* of the cursor's rung, until its entry is done */
	guint64 came;               /* place in the history when the cursor came */
	int came_rung;              /* to this rung; -1: nobody knows           */
	GArray *marks;              /* of struct sheet_mark: what checks say   */
	struct grid_cursor found;   /* rung -1: nothing                        */
	struct grid_cursor drop;    /* rung -1: no element is dragged over it   */
	bool drop_legal;
	enum word drop_word;        /* what is; ELEM_EMPTY: nothing            */
	int drop_line;              /* before which rung one would come that is dragged; -1 */
	GtkDropTarget *target;      /* the sheet's own                          */
	struct sheet_edge edge;
	struct sheet_wire wire;

	GtkAdjustment *adjustment[2]; /* horizontal, vertical                  */
	gulong scrolled[2];
	GtkScrollablePolicy policy[2];
	GArray *cells;              /* of struct cell_widget                   */
	struct sheet_spot spot;
	guint cells_idle;
	int cells_height;           /* of the sheet, when they were made       */
	GtkWidget *entry;           /* the popup, while it is there            */
	bool entry_sets;            /* it asks for a value of what runs         */
	struct xref *xref;          /* of the project as it is; NULL: not asked yet */
	bool takes;                 /* the pointer went down on what can be dragged */
	bool given_up;              /* Esc since then: it draws and selects no more */
	double press_x, press_y;    /* where that was, px of the widget         */
	bool toggles;               /* and on what is toggled when it goes up   */
	bool keeps;                 /* and on what is selected, which it stays till then */
	struct sheet_live live;
	GtkIMContext *input;
	gunichar key;               /* that input methods look at              */
	bool plain;                 /* and made nothing else of                */
	char *composed;             /* what they have so far; NULL: nothing     */
};

/* A mark of the checks: rung and cell of the rung, 0-based; row -1: the whole. */
struct sheet_mark {
	int rung, row, col;
	unsigned int marks;
	const struct diag *diag;    /* lives with the document's diags         */
};

/* ---- grid_view.c ---- */
struct pou *sheet_pou(LadderGridView *view);
/** sheet_rung - as it is shown: the preview, if that one is edited. NULL: none. */
struct rung *sheet_rung(LadderGridView *view, int rung);
int sheet_rungs(LadderGridView *view);
/** sheet_splice - as ladder_document_splice, of rungs of the sheet. */
bool sheet_splice(LadderGridView *view, int at, int removed, struct rung **rungs,
		  int inserted, struct diag_list *why);
/** sheet_is_fixed - is it a program that nobody can change? That is told. */
bool sheet_is_fixed(LadderGridView *view);
/** sheet_zoom - wherever the cursor is then. */
void sheet_zoom(LadderGridView *view, double zoom);
/** sheet_tell - why something was not done. */
void sheet_tell(LadderGridView *view, const char *text);
void sheet_moved(LadderGridView *view);

/* ---- grid_view_strips.c ---- */
void strips_init(LadderGridView *view);
void strips_clear(LadderGridView *view);
/** strips_reset - all rungs may be others. */
void strips_reset(LadderGridView *view);
/** strips_stale - so many are gone: what is remembered of them goes before anybody asks. */
void strips_stale(LadderGridView *view, int at, int count);
/** strips_renumber - the rungs shown have other numbers, and are what they were. */
void strips_renumber(LadderGridView *view);
/** strips_splice - some are. */
void strips_splice(LadderGridView *view, int at, int removed, int inserted);
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
/** strips_theme - of the desktop now: light or dark, with more contrast or not. */
const struct theme *strips_theme(LadderGridView *view);
/** strips_lay_out - what is seen in a page of @page px, before it is drawn. */
void strips_lay_out(LadderGridView *view, double page);
float strips_width(LadderGridView *view);
float strips_height(LadderGridView *view);
void strips_snapshot(LadderGridView *view, GtkSnapshot *snapshot);
/** strips_draw_ahead - what comes into view next, as soon as nothing else is done. */
void strips_draw_ahead(LadderGridView *view);
/** strips_style - colours, type or what names show changed. */
void strips_style(LadderGridView *view);

/* ---- grid_view_cursor.c ---- */
/** cursor_set - moves and shows it; @extend: the selection reaches there. */
void cursor_set(LadderGridView *view, struct grid_cursor to, bool extend);
/** cursor_fit - back into what there is. */
void cursor_fit(LadderGridView *view);
/** cursor_remember - the cursor's rung as it is, for Esc, unless one is remembered. */
void cursor_remember(LadderGridView *view);
/** cursor_reveal - scrolls so far that it is seen. */
void cursor_reveal(LadderGridView *view);
/** cursor_reveal_head - the same; in the first row with the title and the comment of its
 * rung. Not below a pointer, where the sheet stays. */
void cursor_reveal_head(LadderGridView *view);
/** cursor_reveal_late - that, if it was to be seen before there was a page: now it has
 * @page px. */
void cursor_reveal_late(LadderGridView *view, double page);
/** cursor_rect - its cell in px of the widget. */
graphene_rect_t cursor_rect(LadderGridView *view);
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
bool cursor_key(LadderGridView *view, guint key, GdkModifierType state);
/** sheet_point - what is at a point of the widget; the rung, or -1. */
int sheet_point(LadderGridView *view, double x, double y, struct rung_hit *hit);

/* ---- grid_view_edit.c ---- */
/** sheet_put - the cursor's rung becomes @rung (taken over), the cursor goes to @at; of a
 * NULL it tells why. @name: of the step. */
bool sheet_put(LadderGridView *view, struct rung *rung, const struct grid_at *at,
	       const char *name);
struct grid_at sheet_at(LadderGridView *view);
void sheet_place(LadderGridView *view, struct cell cell, bool parallel);

/* ---- grid_view_entry.c ---- */
/** entry_begin - asks at the cursor for an element. @text: typed so far */
void entry_begin(LadderGridView *view, const char *text);
/** entry_begin_word - asks for what a word still needs, its preview being shown. */
void entry_begin_word(LadderGridView *view, enum word word, bool parallel);
/** entry_begin_drop - the same of a word that was dropped on a cell. */
void entry_begin_drop(LadderGridView *view, enum word word, int row, int col);
/** entry_begin_edit - for what stands at the cursor. */
void entry_begin_edit(LadderGridView *view);
/** entry_begin_pin - the same; of the box there the value at a pin is chosen, or is what
 * is typed next. */
void entry_begin_pin(LadderGridView *view, const char *pin, gsize len, bool output);
void entry_close(LadderGridView *view);
/** entry_forget_uses - the project changed: where its names are used is found anew. */
void entry_forget_uses(LadderGridView *view);
void entry_allocate(LadderGridView *view);
/* What the popup that is open is for. It lives until that is asked for something else. */
struct sheet_asked {
	LadderGridView *view;
	enum word word;       /* fixed; ELEM_EMPTY: the line begins with it     */
	bool edit;            /* of what stands there; its comment is kept      */
	bool parallel;
	bool before;          /* it comes before the output at the cursor       */
	enum verb verb;       /* of a text: title, label, comment, pin          */
	struct grid_at at;    /* of the element in the preview                 */
	struct grid_cursor cursor; /* when it began                            */
};
/** entry_ask - for what is asked at the cursor; what was open is closed. */
struct sheet_asked *entry_ask(LadderGridView *view);
struct entry_popup_calls;
/** entry_open - the popup at the cursor. @asked: taken over. */
void entry_open(struct sheet_asked *asked, const char *prompt, const char *text,
		bool typed, const struct entry_popup_calls *calls);
/* Its calls when it is gone, and when a click elsewhere left it. */
void entry_line_gone(void *asked);
void entry_line_left(void *asked, const char *line);

/* ---- grid_view_marks.c ---- */
/** marks_push - of struct grid_mark: of a rung that is drawn. */
void marks_push(LadderGridView *view, int rung, GArray *marks);
/** marks_state - enum rung_state: is it the cursor's, is it selected? */
unsigned int marks_state(LadderGridView *view, int rung);

/* ---- grid_view_rungs.c ---- */
/** rungs_move - from @first to @last they come to stand before @before, as it is now; the
 * cursor goes with them. False: they stand there. */
bool rungs_move(LadderGridView *view, int first, int last, int before);
/** rungs_do - a verb that is of whole rungs. */
void rungs_do(LadderGridView *view, enum verb verb);

/* ---- grid_view_text.c ---- */
void entry_begin_text(LadderGridView *view, enum verb verb);

/* ---- grid_view_label.c ---- */
/** label_refusal - why the jumps that lead to the label of the cursor's rung could not follow
 * it to @name; NULL: they could, or there are none. Caller frees. */
char *label_refusal(LadderGridView *view, const char *name);
/** label_set - it is called @name, with the jumps that lead to it, as one step; that is told.
 * False: there are none, nothing changed. */
bool label_set(LadderGridView *view, const char *name);

/* ---- grid_view_tell.c ---- */
void tell_init(LadderGridView *view);

/* ---- grid_view_vars.c ---- */
/** sheet_variables - of an element of the sheet: "Main.Count Level %IW2"; "": none that
 * stands somewhere by itself. Caller frees. */
char *sheet_variables(LadderGridView *view, const struct cell *cell);

/* ---- grid_view_live.c ---- */
void live_init(LadderGridView *view);
void live_clear(LadderGridView *view);
/** live_is_on - does something run, or stand, that can be shown? */
bool live_is_on(LadderGridView *view);
/** live_look - a rung that is laid out is looked at, if it was not since values changed.
 * True: its drawing is not what it should be. */
bool live_look(LadderGridView *view, int rung);
/** live_rung_of - looked at; NULL: nothing runs, or the rung is being edited. */
const struct live_rung *live_rung_of(LadderGridView *view, int rung);
/** live_forget - the places of a strip are others, or not needed. */
void live_forget(struct strip *strip);
/** live_forget_all - those of all, and names. */
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
/** act_forget - places are others: what is asked for is asked no more. */
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
/** act_said - adds ", on", ", forced" to what a cell is called. */
void act_said(LadderGridView *view, int rung, int row, int col, GString *text);

/* ---- grid_view_clipboard.c ---- */
void clipboard_do(LadderGridView *view, enum verb verb);

/* ---- grid_view_mouse.c ---- */
void mouse_init(LadderGridView *view);
/** mouse_is_cell - a cell, or something of it, was hit. */
bool mouse_is_cell(const struct rung_hit *hit);
/** mouse_menu - what the right button shows, at the cursor. */
void mouse_menu(LadderGridView *view);

/* ---- grid_view_drag.c: what is taken and dropped ---- */
void drag_init(LadderGridView *view);

/* ---- grid_view_drop.c: what is seen of it while something is dragged ---- */
/** drop_word - what is dragged over the sheet; ELEM_EMPTY: no element. */
void drop_word(LadderGridView *view, enum word word);
/** drop_at_cell - the cell that the pointer means; @rung -1: none. */
void drop_at_cell(LadderGridView *view, int rung, int row, int col, bool legal);
/** drop_line - a dragged rung would come before @before; -1: none is dragged. */
void drop_line(LadderGridView *view, int before);
/** drop_boundary - the end of a rung nearest to @y px of the widget: number of the rung
 * behind it, or how many there are. */
int drop_boundary(LadderGridView *view, double y);
/** drop_forget - nothing is dragged over it any more. */
void drop_forget(LadderGridView *view);
/** drop_takes - the cells of a rung as laid out that take it, by row, but for the one that
 * is meant; NULL: no element is dragged. Owns: the caller, g_free. */
bool *drop_takes(LadderGridView *view, int rung, const struct rung_layout *layout);
/** drop_mark - adds that of the one that is meant. */
void drop_mark(LadderGridView *view, int rung, GArray *marks);
/** drop_snapshot - the line where a rung would come. */
void drop_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme);
/** drop_rung_ghost - a rung of the sheet hangs from the pointer, which took it at
 * view->press_x, press_y. */
void drop_rung_ghost(LadderGridView *view, GtkDragSource *source, int rung);

/* ---- grid_view_edge.c ---- */
/** edge_at - something is dragged to (x, y): near an edge the sheet scrolls, until it is
 * elsewhere, and @again is told the same place in each step. */
void edge_at(LadderGridView *view, double x, double y, GdkModifierType state,
	     edge_call again);
/** edge_forget - it is dragged no more. */
void edge_forget(LadderGridView *view);

/* ---- grid_view_keys.c ---- */
void keys_init(LadderGridView *view);
/** keys_moved - the cursor is elsewhere: so is what input methods show. */
void keys_moved(LadderGridView *view);
/** keys_snapshot - what is being composed, at the cursor. */
void keys_snapshot(LadderGridView *view, GtkSnapshot *snapshot, const struct theme *theme);

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

/* ---- grid_view_cells.c ---- */
void cells_init(LadderGridView *view);
void cells_clear(LadderGridView *view);
/** cells_later - soon there are widgets for the elements that are seen. */
void cells_later(LadderGridView *view);
/** cells_scrolled - likewise, when it comes to rest. */
void cells_scrolled(LadderGridView *view);
/** cells_tell_again - another rung is at the cursor, though it may be called the same. */
void cells_tell_again(LadderGridView *view);
/** cells_rename - what is heard of those that there are is what they show now. */
void cells_rename(LadderGridView *view);
/** cells_allocate - puts them where their cells are. */
void cells_allocate(LadderGridView *view);

#endif
