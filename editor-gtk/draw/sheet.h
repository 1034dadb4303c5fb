/* SPDX-License-Identifier: MIT
 *
 * sheet - the rungs of one POU laid out below one another, with one right rail.
 *
 * For pictures and paper, where nothing changes. A grid view lays out its rungs when they
 * become visible.
 */
#ifndef EDITOR_SHEET_H
#define EDITOR_SHEET_H

#include "editor-gtk/draw/rung_layout.h"

#include <glib.h>

struct sheet {
	struct drafting drafting;     /* change it only before sheet_layout()    */
	const struct pou *pou;        /* borrowed                                */
	struct rung_layout **rung;
	float *y;                     /* count + 1: where each rung begins, and the end */
	int count;
	float most;                   /* px from rail to rail; 0: any. A wider rung has its own
					 width and columns */
	float rails;                  /* px from rail to rail                    */
	float width, height;          /* px at 100 %                             */
};

/**
 * sheet_new - for a POU in LD
 * @lettering: borrowed
 *
 * Owns: the caller, sheet_free(). Call sheet_layout() next.
 */
struct sheet *sheet_new(const struct project *project, const struct pou *pou,
			struct lettering *lettering);
void sheet_free(struct sheet *sheet);
/** sheet_layout - lays out all rungs; again after changes of sheet->drafting or
 * sheet->most. drafting.width is the least width. */
void sheet_layout(struct sheet *sheet);
/** sheet_is_wide - does a rung need more than sheet->most? */
bool sheet_is_wide(const struct sheet *sheet, int index);
/** sheet_remarks - comments that are cut at their elements: a line each, with their place.
 * @lines: char *, g_free */
void sheet_remarks(const struct sheet *sheet, int index, GPtrArray *lines);

#endif
