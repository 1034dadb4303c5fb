/* SPDX-License-Identifier: MIT
 *
 * grid_pen - what the parts of grid_draw share; used by grid_*.c only.
 */
#ifndef EDITOR_GRID_PEN_H
#define EDITOR_GRID_PEN_H

#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/draw/rung_box.h"
#include "editor-gtk/draw/rung_text.h"

struct pen {
	const struct grid_scene *scene;
	const struct drafting *drafting;
	const struct rung_layout *layout;
	const struct rung *rung;
	const struct theme *theme;
	struct picture *picture;
	uint8_t *net_live;   /* enum live_bit of the net of each bar, by row     */
	enum token ink;      /* of shapes and names: fainter in a rung that is OFF */
};

/* How a piece of wire is drawn. */
struct wire { enum token token; enum stroke_style style; float width; };
/** pen_wire - @live: enum live_bit, LIVE_OUT for power. */
struct wire pen_wire(const struct pen *pen, unsigned int live);
/** pen_live - what is known of a cell of the rung; 0 when nothing runs. */
unsigned int pen_live(const struct pen *pen, int row, int col);
/** pen_net - LIVE_KNOWN and LIVE_OUT of the net of a bar. */
unsigned int pen_net(const struct pen *pen, int row, int bar);
void pen_line(const struct pen *pen, struct wire wire, float x1, float y1, float x2,
	      float y2);
/** pen_text - centred at @x, cut at no bound. */
void pen_text(const struct pen *pen, enum token token, enum letter letter,
	      struct lettered text, float x, float baseline);
/** pen_marks - those of (row, column). */
unsigned int pen_marks(const struct pen *pen, int row, int column);

/** pen_note - of a cell that blocks; NULL: none. */
const char *pen_note(const struct pen *pen, int row, int column);

/* The outline of an element: three characters of the catalogue. */
struct glyph {
	const char *strokes;    /* "|/|"                                          */
	const char *inside;     /* text instead of the middle one; NULL: none      */
	enum letter letter;     /* of it                                          */
	const struct rung_framed *framed; /* or lines of it; NULL: none           */
	float x, y, half;       /* of its middle; to its left and right stroke     */
	float up;               /* from its middle to its upper end               */
	struct wire wire;       /* of its strokes                                 */
	bool lit;
};
/** glyph_draw - @pen needs picture, theme and drafting only. */
void glyph_draw(const struct pen *pen, const struct glyph *glyph);
/** glyph_outline - its left and right stroke alone. */
void glyph_outline(const struct pen *pen, const struct glyph *glyph);
/** glyph_half - from the middle of (word) to its outer strokes. */
float glyph_half(const struct word_row *word);

/** grid_net_make - finds which bars are joined, and which of them have power.
 * Owns: pen->net_live, g_free. */
void grid_net_make(struct pen *pen);
/** grid_draw_element - everything of cell (row, col) but marks. */
void grid_draw_element(const struct pen *pen, int row, int col);
void grid_draw_box(const struct pen *pen, int row, int col);
/** grid_draw_grounds - marks that lie below the strokes; grid_draw_marks - above. */
void grid_draw_grounds(const struct pen *pen);
void grid_draw_marks(const struct pen *pen);

#endif
