/* SPDX-License-Identifier: MIT
 *
 * pages_inside - what pages.c and pages_*.c share; used by them only.
 */
#ifndef EDITOR_PAGES_INSIDE_H
#define EDITOR_PAGES_INSIDE_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/draw/pages.h"
#include "editor-gtk/draw/sheet.h"

#define PAGE_PX     (96 / 25.4f) /* px a mm                                     */
#define PAGE_MARGIN 45           /* px: 12 mm                                   */
#define PAGE_FIELDS  5           /* of the title block                           */
#define TEXT_LINE   16           /* px of a line of IL or of a table             */
#define PAGE_AIR    14           /* px between what stands below each other      */
#define PAGE_LEAST  0.6f         /* no rung, no chart is made smaller: 5.1 pt        */

/* Part of a picture on a page. */
struct piece {
	const struct picture *picture;
	float y;         /* below the upper margin                               */
	float scale;
	float from, to;  /* px of the picture: what of it is shown                */
	float left, right; /* the same across; both 0: all of it                 */
	float x;         /* of the page: where @left stands, px of the picture    */
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
	float field[PAGE_FIELDS];      /* px: how wide those of the title block are */
	int title_lines;               /* of small type in them; 0: not measured */
	bool title_cut;                /* the name of the project has no room   */
	GPtrArray *page, *picture;
	struct listing_reads *reads;
	/* While they are made: */
	float y;                       /* what is free on the last page begins here */
	float left, right, x;          /* of what is put there: struct piece     */
	const struct picture *beside;  /* put with it, all its width; NULL: nothing */
	const char *subject;
	int pou;
	const struct rung *rung;
	const struct drafting *drafting;
	GPtrArray *reference;          /* lines: what had no room below its coil   */
	GPtrArray *remark;             /* and comments that had none at their element */
};

/* ---- the title block ---- */

/** pages_title_height - px of its frame; 0: the paper is too low for one. */
float pages_title_height(const struct pages *pages);
/** pages_measure_title - shares its width among its fields, so that all that they say on
 * these pages has room. true: it is higher now, or it cuts the name of the project now: the
 * pages must be made again. */
bool pages_measure_title(struct pages *pages);
/** pages_draw_title - that of page @page. */
void pages_draw_title(const struct pages *pages, int page, struct picture *picture);

/* ---- the flow: what is put stands where @y is, which goes on ---- */

/** pages_next - the last page ends here. */
void pages_next(struct pages *pages);
/** pages_picture - to be drawn on and put. Borrowed: it goes with the pages. */
struct picture *pages_picture(struct pages *pages);
/** pages_put_whole - a picture that fits on a page; on the next one if it does not fit on
 * this. @more: px that must follow it on the same page. */
void pages_put_whole(struct pages *pages, const struct picture *picture, float height,
		     float scale, float more);
/** pages_put_span - part of a picture; a single row may be taller than a page. */
void pages_put_span(struct pages *pages, const struct picture *picture, float scale,
		    float from, float end);
/** pages_put_heading - with @more px below it on its page. */
void pages_put_heading(struct pages *pages, const char *text, float more);
/** pages_put_line - of a list, broken where the page ends. */
void pages_put_line(struct pages *pages, const char *line);
/** pages_put_list - lines below a heading. Takes them over; NULL: none. */
void pages_put_list(struct pages *pages, const char *heading, char **lines);
/** pages_can_cut - may a page end at @x? Lines go on, what can be read does not.
 * @top: what stands above it is not cut. @room: px; a frame half as wide may be cut */
bool pages_can_cut(const struct picture *picture, float x, float top, float room);

/** pages_sheet - pages_rung.c: the rungs of the POU, laid out. Owns: the caller,
 * sheet_free(). */
struct sheet *pages_sheet(struct pages *pages);
/** pages_put_rungs - those from @first to before @end, below a heading. */
void pages_put_rungs(struct pages *pages, const struct sheet *sheet, const char *heading,
		     int first, int end);
/** pages_put_references - comments, and where coils are read, if there was no room. */
void pages_put_references(struct pages *pages);
/** pages_fold - pages_fold.c: a rung that is too wide, in strips below each other.
 * @first: it stands below the heading of its POU */
void pages_fold(struct pages *pages, const struct sheet *sheet, int index, float scale,
		bool first);
/** pages_scene - how a rung is drawn on paper. */
struct grid_scene pages_scene(struct pages *pages, const struct sheet *sheet,
			      const struct rung_layout *layout);
/** pages_put_rows - rows of a rung down to @bottom, as many as fit on each page.
 * @from: px of its picture, above the first row or at it */
void pages_put_rows(struct pages *pages, const struct rung_layout *layout,
		    const struct picture *picture, float scale, float from, float bottom);

/** pages_put_chart - pages_chart.c: the POU, which is a chart, and all its bodies. */
void pages_put_chart(struct pages *pages, const char *heading);

#endif
