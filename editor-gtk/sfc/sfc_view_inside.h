/* SPDX-License-Identifier: MIT
 *
 * sfc_view_inside - the files of the widget sfc_view. A file may call only files before it:
 * cursor, live and edit, entry, sfc_view.c.
 */
#ifndef EDITOR_SFC_VIEW_INSIDE_H
#define EDITOR_SFC_VIEW_INSIDE_H

#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/edit/entry.h"
#include "editor-gtk/edit/sfc_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "editor-gtk/sim/live_map.h"

/* A way drawn with the pointer. */
struct sfc_stroke {
	struct sfc_at from, to;     /* shape -1: none                          */
	bool drawn;
	graphene_point_t at;        /* the pointer, px at 100 %                 */
};

/* The places of the chart's values in the running program. */
struct sfc_places {
	struct live_map *map;       /* NULL: none                              */
	struct location *active, *time; /* by step; NULL: not looked up yet      */
	uint8_t *step, *transition; /* enum sfc_bit                            */
};

struct _LadderSfcView {
	LadderCanvas parent;
	const struct canvas_state *canvas;
	struct sfc_sheet *sheet;    /* NULL: the POU is no chart now           */
	const struct ladder *of;    /* the project that @sheet was made of     */
	struct sfc_at cursor;       /* shape -1: none                          */
	bool *selected;             /* by shape                                */
	GArray *marks;              /* struct sfc_mark: errors and warnings      */
	GArray *missing;            /* struct sfc_mark: what the board runs without; NULL: not
				       looked for yet                           */
	GArray *found;              /* struct sfc_mark: hits of a search         */
	struct sfc_stroke stroke;
	struct sfc_at drop;         /* where a tool of the palette would be dropped */
	struct sfc_places places;
};

/* ---- sfc_view_cursor.c: the shown chart and the cursor ---- */
/** sfc_pou - NULL: there is no chart now. */
struct pou *sfc_pou(LadderSfcView *view);
/** sfc_make_sheet - makes the sheet of the present chart; closes the entry. */
void sfc_make_sheet(LadderSfcView *view);
/** sfc_missing - marks of what the board runs without; empty in a simulation. Borrowed. */
const GArray *sfc_missing(LadderSfcView *view);
/** sfc_forget_places - after another program runs, or another chart is shown. */
void sfc_forget_places(LadderSfcView *view);
/** sfc_fresh - makes the sheet if it is older than the project: another widget may get the
 * signal of a change first and call this one. */
void sfc_fresh(LadderSfcView *view);
/** sfc_part_at_cursor - SFC_NOTHING for none; @index: its number in the chart. */
enum sfc_part sfc_part_at_cursor(LadderSfcView *view, int *index);
/** sfc_part_here - the same, but for a jump the transition or step that it leaves: edits
 * continue there. */
enum sfc_part sfc_part_here(LadderSfcView *view, int *index);
/** sfc_macro_here - the macro-step at the cursor, else the one it stands in; -1: none. */
int sfc_macro_here(LadderSfcView *view);
/** sfc_box - the box of a place, px at 100 %. */
graphene_rect_t sfc_box(LadderSfcView *view, struct sfc_at at);
void sfc_reveal(LadderSfcView *view);
/** sfc_go - moves the cursor and scrolls to it. @extend: selects its old and new shape. */
void sfc_go(LadderSfcView *view, struct sfc_at at, bool extend);
/** sfc_want_body - emits "body-wanted". */
void sfc_want_body(LadderSfcView *view, const struct sfc_body *body);

/* ---- sfc_view_live.c: the running program ---- */
/** sfc_live_look - the present states of the simulation; false: nothing runs. */
bool sfc_live_look(LadderSfcView *view, struct sfc_live *out);
/** sfc_live_force - activates the step at the cursor. */
void sfc_live_force(LadderSfcView *view);

/* ---- sfc_view_edit.c: changes, and the clipboard ---- */
/** sfc_edit_begin - an edit of the chart; NULL: there is none. */
struct sfc_edit *sfc_edit_begin(LadderSfcView *view);
/** sfc_put - replaces the chart by the text of @edit (taken over) as step @name of the
 * history, and moves the cursor to step or transition @index (of the edit) if @kind is
 * PIECE_STEP, PIECE_TRANSITION. @good false: only tells the reason. */
bool sfc_put(LadderSfcView *view, struct sfc_edit *edit, bool good, const char *name,
	     enum piece_kind kind, int index);
/** sfc_lead - adds a way from the shape at @from to the shape at @to. */
void sfc_lead(LadderSfcView *view, struct sfc_at from, struct sfc_at to);
/** sfc_new_way - a new transition behind the step or transition at the cursor, and a step behind
 * it; the cursor moves to the transition. */
bool sfc_new_way(LadderSfcView *view);
/** sfc_edit_do - a verb that changes or copies; false: another verb. */
bool sfc_edit_do(LadderSfcView *view, enum verb verb);

/* ---- sfc_view_entry.c: the entry ---- */
enum sfc_asked { ASK_STEP, ASK_CONDITION, ASK_DOES, ASK_ANOTHER, ASK_LEAD, ASK_WAIT,
		 ASK_TIMES, ASK_NAME, ASK_PRIORITY, ASK_COMMENT, ASK_GO,
		 ASK_FIRST };
/** sfc_ask_for - opens the entry for the shape at the cursor. @typed: the first letters; NULL:
 * the entry has the present text. */
void sfc_ask_for(LadderSfcView *view, enum sfc_asked what, const char *typed);
/** sfc_ask_here - the same with the usual question of the shape. */
void sfc_ask_here(LadderSfcView *view, const char *typed);

#endif
