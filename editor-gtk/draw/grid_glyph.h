/* SPDX-License-Identifier: MIT
 *
 * grid_glyph - the three characters of an element as strokes, for grid_draw and grid_classic.
 */
#ifndef EDITOR_GRID_GLYPH_H
#define EDITOR_GRID_GLYPH_H

#include "editor-gtk/draw/rung_text.h"
#include "editor-gtk/kit/picture.h"

/* Style of a piece of wire. */
struct wire { enum token token; enum stroke_style style; float width; };

/* Target of drawn glyphs. */
struct nib {
	struct picture *picture;
	const struct theme *theme;
	struct lettering *lettering;
	enum token ink;         /* of texts inside                              */
};

struct glyph {
	const char *strokes;    /* "|/|"                                          */
	const char *inside;     /* text instead of the middle one; NULL: none      */
	enum letter letter;     /* style of @inside                               */
	const struct rung_framed *framed; /* lines instead of the middle; NULL: none */
	float x, y, half;       /* its middle; px to its left and right stroke     */
	float up;               /* px from its middle to its upper end            */
	struct wire wire;       /* style of its strokes                           */
	bool lit;
};
void glyph_draw(const struct nib *nib, const struct glyph *glyph);
/** glyph_outline - only its left and right stroke. */
void glyph_outline(const struct nib *nib, const struct glyph *glyph);
/** glyph_meets - x where the wire at the left ends: at the tip of an arrow, else at the left stroke. */
float glyph_meets(const struct glyph *glyph);
/** glyph_half - px from the middle of a word's glyph to its outer strokes. */
float glyph_half(const struct word_row *word);

#endif
