/* SPDX-License-Identifier: MIT
 *
 * sfc_view_inside - what the files of a chart's sheet share. Only editor-gtk/sfc_view*.c
 * include it.
 */
#ifndef EDITOR_SFC_VIEW_INSIDE_H
#define EDITOR_SFC_VIEW_INSIDE_H

#include "editor-gtk/edit/entry.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/draw/sfc_draw.h"
#include "editor-gtk/edit/sfc_edit.h"
#include "editor-gtk/sfc/sfc_view.h"

/* A shape that assistive technology can name: a widget that draws nothing. */
struct sfc_cell {
	GtkWidget *widget;
	struct sfc_at at;
	char *name;
};

/* What runs, of what is shown. */
struct chart_live {
	LadderSim *sim;             /* NULL: none was given                    */
	gulong handler[3];
	struct live_map *map;       /* NULL: it is off, or not yet             */
	struct location *active, *time; /* by step                             */
	uint8_t *step, *transition; /* enum sfc_bit                            */
	bool same;                  /* the chart that runs is the one shown    */
};

struct _LadderSfcView {
	GtkWidget parent;
	LadderDocument *document;
	int pou;
	gulong handler[4];          /* of the document's signals               */
	struct lettering *lettering;
	struct sfc_sheet *sheet;    /* NULL: the POU is no chart now           */
	const struct ladder *of;    /* what the sheet was made of              */
	double zoom;
	struct sfc_at cursor;       /* shape -1: there is nothing              */
	bool *selected;             /* by shape                                */
	GArray *marks;              /* of struct sfc_mark: what the checks say   */
	struct sfc_at found;        /* what find came to; shape -1: nothing      */
	GtkWidget *entry;           /* the popup, while it is there            */
	struct xref *xref;          /* of the project as it is; NULL: not asked yet */
	GArray *cells;              /* of struct sfc_cell                      */
	guint cells_later;
	char *told;                 /* of the cursor, to people who hear; NULL: nothing */
	graphene_rect_t seen;       /* when they were made last                */
	struct sfc_at press;        /* where the button went down              */
	double press_x, press_y;    /* px at 100 %                              */
	bool dragging;
	double drag_x, drag_y;      /* where the pointer is, px at 100 %        */
	struct sfc_at drop;
	struct chart_live live;
};

/* ---- sfc_view.c ---- */
/** chart_pou - NULL: there is no chart now. */
struct pou *chart_pou(LadderSfcView *view);
/** chart_fresh - the sheet is that of the project as it is: others may hear of a change
 * before this view does, and ask it. */
void chart_fresh(LadderSfcView *view);
void chart_tell(LadderSfcView *view, const char *text);
/** chart_is_fixed - is it a program that nobody can change? That is told. */
bool chart_is_fixed(LadderSfcView *view);
void chart_moved(LadderSfcView *view);
/** chart_part - the part at the cursor, SFC_NOTHING for none; its number in the chart. */
enum sfc_part chart_part(LadderSfcView *view, int *index);
/** chart_box - of a place, px at 100 %. */
graphene_rect_t chart_box(LadderSfcView *view, struct sfc_at at);
/** chart_go - the cursor goes there, and is seen. @extend: what it leaves and comes to is
 * selected. */
void chart_go(LadderSfcView *view, struct sfc_at at, bool extend);
/** chart_point - px of the widget become px at 100 %. */
double chart_px(LadderSfcView *view, double px);
void chart_body_wanted(LadderSfcView *view, const struct sfc_body *body);

/* ---- sfc_view_edit.c ---- */
/** chart_put - the edit's text takes the place of the chart (taken over; @good false or a
 * NULL: nothing but its reason is told). The cursor goes to step or transition @index (of
 * the edit) if @kind is PIECE_STEP, PIECE_TRANSITION. @name: of the step of the history. */
bool chart_put(LadderSfcView *view, struct sfc_edit *edit, bool good, const char *name,
	       enum piece_kind kind, int index);
struct sfc_edit *chart_edit(LadderSfcView *view);
/** chart_part_here - as chart_part(), but of a jump its transition, or the step whose jump it
 * is: where one would go on. */
enum sfc_part chart_part_here(LadderSfcView *view, int *index);
/** chart_macro_here - the macro-step at the cursor, else the one it stands in; -1: none. */
int chart_macro_here(LadderSfcView *view);
/** chart_lead - a way from what stands at @from to what stands at @to. */
void chart_lead(LadderSfcView *view, struct sfc_at from, struct sfc_at to);

/* ---- sfc_view_entry.c ---- */
enum chart_asked { ASK_STEP, ASK_CONDITION, ASK_DOES, ASK_ANOTHER, ASK_LEAD, ASK_WAIT,
		   ASK_TIMES, ASK_NAME, ASK_PRIORITY, ASK_COMMENT, ASK_GO };
/** chart_ask - for something of what stands at the cursor. @typed: already; NULL: what
 * there is. */
void chart_ask(LadderSfcView *view, enum chart_asked what, const char *typed);
/** chart_ask_here - for what is asked for there first. */
void chart_ask_here(LadderSfcView *view, const char *typed);
void chart_entry_close(LadderSfcView *view);

/* ---- sfc_view_offer.c ---- */
/** chart_offer - fills the popup with what could be meant at byte @at of @line. */
void chart_offer(LadderSfcView *view, enum chart_asked what, const char *line, gsize at);
/** chart_entry_place - where names are looked up; borrowed until the chart changes. */
struct entry_place chart_entry_place(LadderSfcView *view, bool output);
void chart_forget_uses(LadderSfcView *view);

/* ---- sfc_view_find.c ---- */
/** chart_line_of - from which line of the file on (1-based) a place stands there, its
 * comments too. */
int chart_line_of(LadderSfcView *view, struct sfc_at at);

/* ---- sfc_view_mouse.c ---- */
void chart_mouse_init(LadderSfcView *view);
/** chart_mouse_menu - what the right button shows, at the cursor. */
void chart_mouse_menu(LadderSfcView *view);
/** chart_drag_snapshot - the way that is drawn just now. */
void chart_drag_snapshot(LadderSfcView *view, GtkSnapshot *snapshot,
			 const struct theme *theme);

/* ---- sfc_view_keys.c ---- */
void chart_keys_init(LadderSfcView *view);

/* ---- sfc_view_cells.c ---- */
void chart_cells_init(LadderSfcView *view);
void chart_cells_clear(LadderSfcView *view);
void chart_cells_later(LadderSfcView *view);
void chart_cells_allocate(LadderSfcView *view);
/** chart_said - "Step Fill, initial": what a place is called. Caller frees. */
char *chart_said(LadderSfcView *view, struct sfc_at at);

/* ---- sfc_view_live.c ---- */
void chart_live_clear(LadderSfcView *view);
void chart_live_forget(LadderSfcView *view);
/** chart_live_look - what the simulation has now; false: nothing runs. */
bool chart_live_look(LadderSfcView *view, struct sfc_live *out);
bool chart_live_is_on(LadderSfcView *view);
/** chart_live_force - holds or releases the step at the cursor. */
void chart_live_force(LadderSfcView *view);

#endif
