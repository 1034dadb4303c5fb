/* SPDX-License-Identifier: MIT
 *
 * sheet - the rungs of one POU laid out below one another, with one right rail.
 *
 * It owns the layouts and knows where each rung begins. The rungs are the project's;
 * whoever exchanges one says so. It draws nothing and is no widget.
 */
#ifndef EDITOR_SHEET_H
#define EDITOR_SHEET_H

#include "editor-gtk/rung_layout.h"

struct sheet {
	struct drafting drafting;     /* change it only before sheet_layout()    */
	const struct pou *pou;        /* borrowed                                */
	struct rung_layout **rung;
	float *y;                     /* count + 1: where each begins, the end    */
	int count;
	float rails;                  /* px from rail to rail                    */
	float width, height;          /* px at 100 %                             */
};

/**
 * sheet_new - of a POU in LD
 * @lettering: borrowed
 *
 * Owns: the caller, sheet_free(). Nothing is laid out before sheet_layout().
 */
struct sheet *sheet_new(const struct project *project, const struct pou *pou,
			struct lettering *lettering);
void sheet_free(struct sheet *sheet);
/** sheet_layout - lays out all rungs: after sheet_new(), when variables changed, or
 * something of sheet->drafting. The width of drafting is a least one. */
void sheet_layout(struct sheet *sheet);
/** sheet_changed - rungs from @at on: @removed of them are gone, and @added new ones (of
 * the POU as it is now) stand there. Lays out only these, unless the sheet gets wider.
 * @rows: least rows of the first one, 0: as it has. */
void sheet_changed(struct sheet *sheet, int at, int removed, int added, int rows);
/** sheet_rung_at - index of the rung at @y px; the last one below all; -1: none. */
int sheet_rung_at(const struct sheet *sheet, float y);

#endif
