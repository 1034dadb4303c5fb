/* SPDX-License-Identifier: MIT
 *
 * diff_draw - what differs between two versions of a rung, a chart or a list, as marks and
 * strokes.
 *
 * For the picture of a comparison and for the page of one. The engine finds the pairs
 * (compare/compare.h). Colour is never alone: + and - at the left, a sign at each changed
 * cell.
 */
#ifndef EDITOR_DIFF_DRAW_H
#define EDITOR_DIFF_DRAW_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/rung_layout.h"
#include "editor-gtk/draw/sfc_draw.h"

#include "engine/compare/compare.h"

#define DIFF_MARKS  512 /* of a rung at most                                      */
#define DIFF_ROOM   16  /* px of a cell's lower edge that the mark of a changed cell covers */
#define DIFF_LINE   17  /* px of a line of text                                  */
#define DIFF_SIGN_X 16  /* x of + and -                                          */
#define DIFF_TEXT_X 76

/* ---- rungs ---- */

struct diff_rungs {
	const struct project *a, *b;
	const struct rung *rung_a, *rung_b; /* of each                          */
};
/** diff_mark_cells - marks the cells of @layout, of one of the two rungs, that differ.
 * Returns the number of marks. */
int diff_mark_cells(const struct diff_rungs *of, const struct rung_layout *layout,
		    struct grid_mark mark[DIFF_MARKS]);

/* ---- charts ---- */

/** diff_mark_charts - adds marks (struct sfc_mark): SFC_CHANGED in both charts, SFC_REMOVED
 * or SFC_ADDED in one. */
void diff_mark_charts(const struct sfc_sheet *before, const struct sfc_sheet *after,
		      GArray *removed, GArray *added);
/* A step or transition that differs: its shape in each chart; -1: there is none. */
struct diff_part {
	int a, b;
	char *words;  /* lines of its text that only one version has, after - or + */
};
/** diff_chart_parts - those of two charts (struct diff_part), in the order of the older one,
 * then the new ones. Owns: the caller, g_array_unref(). */
GArray *diff_chart_parts(const struct sfc_sheet *before, const struct sfc_sheet *after);
/** diff_draw_chart - a chart with its marks, at @y. @added: the newer one, else the older.
 * Returns the y below. */
float diff_draw_chart(const struct sfc_sheet *chart, const GArray *marks, bool added,
		      const struct theme *theme, float y, struct picture *picture);

/* ---- text ---- */

/** diff_words - lines that only one of two texts has, after - or +. Owns: the caller, g_free(). */
char *diff_words(const char *from, const char *to);

/** diff_draw_line - a line of a list or chart with its number; with + or - if only one
 * version has it. */
void diff_draw_line(struct lettering *lettering, const struct compare_line *line, float y,
		    struct picture *picture);
/** diff_draw_text - a line of text; the picture grows to hold it. Returns its width. */
float diff_draw_text(struct lettering *lettering, enum token token, const char *text,
		     float x, float y, struct picture *picture);

#endif
