/* SPDX-License-Identifier: MIT
 *
 * picture - a drawing as a list of strokes.
 *
 * A drawing is made once, as this list. It becomes a render node for the screen, cairo
 * calls for PDF, print and PNG, or SVG with real text; tests compare it as lines. Strokes
 * have tokens (theme.h) and styles of type (lettering.h) instead of colours and fonts.
 */
#ifndef EDITOR_PICTURE_H
#define EDITOR_PICTURE_H

#include "editor-gtk/kit/lettering.h"
#include "editor-gtk/kit/theme.h"

#include <cairo.h>
#include <gtk/gtk.h>

enum stroke_kind {
	STROKE_FILL,   /* rectangle x y w h                                     */
	STROKE_FRAME,  /* its outline, inside of it                             */
	STROKE_LINE,   /* from x, y to w, h                                     */
	STROKE_ARC,    /* around x, y with radius w, from angle h to @to         */
	STROKE_DISC,   /* filled, around x, y with radius w                     */
	STROKE_WAVE,   /* from x, y, w long                                     */
	STROKE_TEXT,   /* from x, baseline y, w wide                            */
};
enum stroke_style { STROKE_SOLID, STROKE_DASHED, STROKE_DOTTED };

struct stroke {
	enum stroke_kind kind : 8;
	enum token token : 8;
	enum stroke_style style : 8;
	enum letter letter : 8;  /* of a text                                   */
	float x, y, w, h, to;    /* px at 100 %, y downwards                    */
	float width;             /* of lines                                   */
	float alpha;             /* 0 … 1                                       */
	const char *text;        /* owned by the picture                       */
};

struct picture {
	struct stroke *stroke;
	int count, size;
	float width, height;     /* px at 100 %                                 */
	float dx, dy;            /* origin of the strokes that follow           */
	float scale;             /* device px of a px, for nodes; 0: unknown    */
	GStringChunk *texts;
};

/** picture_init - an empty picture. Free it with picture_clear(). */
void picture_init(struct picture *picture);
void picture_clear(struct picture *picture);
/** picture_move - sets the origin of the strokes that follow. */
void picture_move(struct picture *picture, float dx, float dy);
/** picture_grow - makes the picture reach at least to (@x, @y). */
void picture_grow(struct picture *picture, float x, float y);

void picture_fill(struct picture *picture, enum token token, float alpha,
		  float x, float y, float w, float h);
void picture_frame(struct picture *picture, enum token token, enum stroke_style style,
		   float width, float x, float y, float w, float h);
void picture_line(struct picture *picture, enum token token, enum stroke_style style,
		  float width, float x1, float y1, float x2, float y2);
/** picture_arc - angles in radians, clockwise from the right. */
void picture_arc(struct picture *picture, enum token token, float width,
		 float x, float y, float radius, float from, float to);
void picture_disc(struct picture *picture, enum token token, float alpha,
		  float x, float y, float radius);
void picture_wave(struct picture *picture, enum token token, float x, float y, float w);
void picture_text(struct picture *picture, enum token token, enum letter letter,
		  struct lettered text, float x, float baseline);

/** picture_caption - a comment above a drawing, @y from the top; the picture becomes wide enough. @text:
 * taken. Returns its height. */
float picture_caption(struct picture *picture, struct lettering *lettering, char *text, float y);

/** picture_snapshot - as render nodes. */
void picture_snapshot(const struct picture *picture, const struct theme *theme,
		      struct lettering *lettering, GtkSnapshot *snapshot);
/** picture_node - the same as one node. Owns: the caller, gsk_render_node_unref; NULL if
 * the picture is empty. */
GskRenderNode *picture_node(const struct picture *picture, const struct theme *theme,
			    struct lettering *lettering);
/** picture_cairo - on any surface; text stays text in a PDF. */
void picture_cairo(const struct picture *picture, const struct theme *theme,
		   struct lettering *lettering, cairo_t *cr);
/** picture_svg - a whole SVG file, text as text. Owns: the caller, g_free.
 * @ground: the sheet's colour below everything; else it is transparent */
char *picture_svg(const struct picture *picture, const struct theme *theme, float scale,
		  bool ground);
/** picture_png - a whole PNG file, on the sheet's colour. Owns: the caller, g_bytes_unref.
 * Fails: NULL, there is no memory for it. */
GBytes *picture_png(const struct picture *picture, const struct theme *theme,
		    struct lettering *lettering, float scale);
/** picture_append - a cairo_write_func_t; the closure is a GByteArray. */
cairo_status_t picture_append(void *bytes, const unsigned char *data, unsigned int len);

#endif
