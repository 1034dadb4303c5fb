/* SPDX-License-Identifier: MIT
 *
 * rung_fold - a rung that is wider than the sheet, in lines below each other.
 *
 * The rung is laid out and drawn once, as wide as it is: its place "as laid out". A fold says which part of
 * that each line shows, and where: the place "as shown". Both are px at 100 % from the upper left corner of
 * the rung. Everything that goes from a cell to the screen or back uses these functions, so drawing, pointer,
 * cursor and accessible children cannot differ. Paper has its own lines (pages.c).
 */
#ifndef EDITOR_RUNG_FOLD_H
#define EDITOR_RUNG_FOLD_H

#include "editor-gtk/draw/rung_layout.h"

/* px at 100 % */
#define FOLD_LEFT  78 /* x where later lines begin, behind the ends of cut wires */
#define FOLD_RIGHT 8  /* free before the place of the right rail: the ends of cut wires */
#define FOLD_GAP   8  /* between lines                                          */
#define FOLD_END   12 /* of a cut wire, to the tip of its arrow                 */

struct rung_fold_line {
	float from, to;   /* x as laid out                                      */
	float x;          /* where `from` is shown                              */
	int first, last;  /* its columns, up to before @last                    */
	int rows;         /* that it shows                                      */
	float y;          /* where the first row is shown                       */
};
struct rung_fold {
	int lines;        /* at least 2                                         */
	float top;        /* y as laid out of the first row: above it nothing is folded */
	float width;      /* px from rail to rail of the sheet                  */
	float height;     /* as shown, of the whole strip                       */
	struct rung_fold_line line[];
};

/* A cell that is to be shown, although nothing may be there. */
struct rung_fold_wish { int row, column; bool on; /* in the later lines, too  */ };

/** rung_fold_room - px from rail to rail that a rung needs to be folded: its widest column fits. */
float rung_fold_room(const struct rung_layout *layout);
/**
 * rung_fold_new - folds a rung that does not fit
 * @layout: its columns get their usual width, and its right rail comes to stand below that of other rungs
 * @width:  px from rail to rail of the sheet, at least rung_fold_room()
 *
 * No element is cut. Call rung_fold_place() next. Owns: the caller, g_free.
 */
struct rung_fold *rung_fold_new(struct rung_layout *layout, float width);
/** rung_fold_place - places the lines, each with the rows that have something in it, and with those of
 * @wish. True: the height changed. */
bool rung_fold_place(struct rung_fold *fold, const struct rung_layout *layout, const struct rung_fold_wish *wish,
		     int wishes);

/** rung_fold_line_at - the line that shows x as laid out. */
int rung_fold_line_at(const struct rung_fold *fold, float x);
/** rung_fold_bottom - y as laid out, where a line ends. */
float rung_fold_bottom(const struct rung_fold *fold, const struct rung_layout *layout, int line);
/** rung_fold_shown - where a point as laid out is shown; rung_fold_laid - the opposite: the nearest place that
 * the line at that height shows. */
graphene_point_t rung_fold_shown(const struct rung_fold *fold, float x, float y);
graphene_point_t rung_fold_laid(const struct rung_fold *fold, const struct rung_layout *layout, float x, float y);
/** rung_fold_goes_on - is the wire of @row cut between line @line and the next one? */
bool rung_fold_goes_on(const struct rung_fold *fold, const struct rung_layout *layout, int line, int row);

#endif
