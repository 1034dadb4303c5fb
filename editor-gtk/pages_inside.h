/* SPDX-License-Identifier: MIT
 *
 * pages_inside - what pages.c and pages_paint.c share; used by them only.
 */
#ifndef EDITOR_PAGES_INSIDE_H
#define EDITOR_PAGES_INSIDE_H

#include "editor-gtk/listing.h"
#include "editor-gtk/pages.h"

#define PAGE_PX     (96 / 25.4f) /* px a mm                                     */
#define PAGE_MARGIN 45           /* px: 12 mm                                   */
#define PAGE_TITLE  52           /* px of the title block and the air above it   */

/* Part of a picture on a page. */
struct piece {
	const struct picture *picture;
	float y;         /* below the upper margin                               */
	float scale;
	float from, to;  /* px of the picture: what of it is shown                */
	float left, right; /* the same across; both 0: all of it                 */
};
struct page {
	GArray *piece;
	char *subject;   /* the POU, or "Symbols"                                */
};

struct pages {
	const struct project *project;
	struct lettering *lettering;
	const struct theme *theme;
	enum drafting_show show;
	char *file, *date;
	float width, height;           /* px of a page                          */
	float room_width, room_height; /* px inside the margins, above the title block */
	GPtrArray *page, *picture;
	struct listing_reads *reads;
	/* While they are made: */
	float y;                       /* what is free on the last page begins here */
	float left, right;             /* of what is put there: struct piece     */
	const char *subject;
	int pou;
	const struct rung *rung;
};

#endif
