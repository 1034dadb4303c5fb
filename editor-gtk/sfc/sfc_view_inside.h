/* SPDX-License-Identifier: MIT
 *
 * sfc_view_inside - the parts of a chart's widget. Each may call those before it: cursor;
 * live and edit; entry; the widget itself (sfc_view.c).
 */
#ifndef EDITOR_SFC_VIEW_INSIDE_H
#define EDITOR_SFC_VIEW_INSIDE_H

#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/edit/entry.h"
#include "editor-gtk/edit/sfc_edit.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "editor-gtk/sim/live_map.h"

/* A way that is drawn with the pointer. */
struct sfc_stroke {
	struct sfc_at from, to;     /* shape -1: none                          */
	bool drawn;
	graphene_point_t at;        /* the pointer, px at 100 %                 */
};

/* Where the values of the program that runs are. */
struct sfc_places {
	struct live_map *map;       /* NULL: not found                         */
	struct location *active, *time; /* by step; NULL: not looked for         */
	uint8_t *step, *transition; /* enum sfc_bit                            */
};

struct _LadderSfcView {
	LadderCanvas parent;
	const struct canvas_state *canvas;
	struct sfc_sheet *sheet;    /* NULL: the POU is no chart now           */
	const struct ladder *of;    /* what the sheet was made of              */
	struct sfc_at cursor;       /* shape -1: there is nothing              */
	bool *selected;             /* by shape                                */
	GArray *marks;              /* of struct sfc_mark: what the checks say   */
	struct sfc_at found;        /* by a search; shape -1: nothing           */
	struct sfc_stroke stroke;
	struct sfc_places places;
};

/* ---- sfc_view_cursor.c: the chart, and where the cursor is ---- */
/** sfc_pou - NULL: there is no chart now. */
struct pou *sfc_pou(LadderSfcView *view);
/** sfc_make_sheet - of the chart as it is now; what was asked for is closed. */
void sfc_make_sheet(LadderSfcView *view);
/** sfc_forget_places - another program runs, or another chart is shown. */
void sfc_forget_places(LadderSfcView *view);
/** sfc_fresh - makes the sheet if it is older than the project: other widgets may hear of
 * a change first, and ask this one. */
void sfc_fresh(LadderSfcView *view);
/** sfc_part_at_cursor - SFC_NOTHING for none; @index: its number in the chart. */
enum sfc_part sfc_part_at_cursor(LadderSfcView *view, int *index);
/** sfc_part_here - the same, but of a jump its transition, or the step whose jump it is:
 * where an edit goes on. */
enum sfc_part sfc_part_here(LadderSfcView *view, int *index);
/** sfc_macro_here - the macro-step at the cursor, else the one it stands in; -1: none. */
int sfc_macro_here(LadderSfcView *view);
/** sfc_box - of a place, px at 100 %. */
graphene_rect_t sfc_box(LadderSfcView *view, struct sfc_at at);
void sfc_reveal(LadderSfcView *view);
/** sfc_go - moves the cursor and shows it. @extend: what it leaves and comes to is
 * selected. */
void sfc_go(LadderSfcView *view, struct sfc_at at, bool extend);
/** sfc_want_body - emits "body-wanted". */
void sfc_want_body(LadderSfcView *view, const struct sfc_body *body);

/* ---- sfc_view_live.c: what runs ---- */
/** sfc_live_look - what the simulation has now; false: nothing runs. */
bool sfc_live_look(LadderSfcView *view, struct sfc_live *out);
/** sfc_live_force - makes the step at the cursor the active one. */
void sfc_live_force(LadderSfcView *view);

/* ---- sfc_view_edit.c: changes, and the clipboard ---- */
/** sfc_edit_begin - an edit of the chart; NULL: there is none. */
struct sfc_edit *sfc_edit_begin(LadderSfcView *view);
/** sfc_put - the edit's text replaces the chart (taken over; @good false or a NULL: only
 * the reason is told). The cursor goes to step or transition @index (of the edit) if @kind
 * is PIECE_STEP, PIECE_TRANSITION. @name: of the step of the history. */
bool sfc_put(LadderSfcView *view, struct sfc_edit *edit, bool good, const char *name,
	     enum piece_kind kind, int index);
/** sfc_lead - a way from what stands at @from to what stands at @to. */
void sfc_lead(LadderSfcView *view, struct sfc_at from, struct sfc_at to);
/** sfc_edit_do - a verb that changes the chart, or copies; false: it is another verb. */
bool sfc_edit_do(LadderSfcView *view, enum verb verb);

/* ---- sfc_view_entry.c: questions ---- */
enum sfc_asked { ASK_STEP, ASK_CONDITION, ASK_DOES, ASK_ANOTHER, ASK_LEAD, ASK_WAIT,
		 ASK_TIMES, ASK_NAME, ASK_PRIORITY, ASK_COMMENT, ASK_GO };
/** sfc_ask_for - something of what stands at the cursor. @typed: the first letters; NULL:
 * the line shows what there is. */
void sfc_ask_for(LadderSfcView *view, enum sfc_asked what, const char *typed);
/** sfc_ask_here - what is asked there first. */
void sfc_ask_here(LadderSfcView *view, const char *typed);

#endif
