/* SPDX-License-Identifier: MIT
 *
 * grid_draw - a rung as strokes: wires, elements, marks, live power.
 *
 * The strokes of an element are the three characters of its row in catalog.def. Drawing
 * needs a rung and its layout but no widget and no display, so that screen, print,
 * pictures, palette and tests have the same drawing. It evaluates nothing: the caller gives
 * the power.
 */
#ifndef EDITOR_GRID_DRAW_H
#define EDITOR_GRID_DRAW_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/draw/rung_fold.h"

#include "engine/base/diag.h"

/* State of a cell while a program runs. */
enum live_bit {
	LIVE_KNOWN = 1,  /* else it is not scanned: dotted                      */
	LIVE_IN = 2,     /* power at its left end                               */
	LIVE_OUT = 4,    /* power at its right end                              */
	LIVE_CLOSED = 8, /* a contact that is closed, a coil whose bit is TRUE    */
	LIVE_FRESH = 16, /* its value changed within the last second             */
};
struct live_value {
	char text[48];
	float part;      /* progress 0 … 1, drawn as a bar in the box; below 0: none */
};
/* NULL pointer to it: not running; all wires are idle. */
struct grid_live {
	const uint8_t *cell; /* enum live_bit, rows * cols of the rung, by row     */
	/** Returns the value to show below an element or inside a box; false: none. NULL:
	 * no cell has one. */
	bool (*value)(void *context, int row, int col, struct live_value *out);
	void *context;
};

/* Marks of a cell, by row and column as shown. */
enum mark {
	MARK_CURSOR = 1,
	MARK_SELECTED = 2,
	MARK_DROP = 4,       /* the dragged element may be dropped here         */
	MARK_ERROR = 16,
	MARK_WARNING = 32,
	MARK_FORCED = 64,
	MARK_FOUND = 128,    /* by a search                                     */
	MARK_TWICE = 256,    /* also written elsewhere: the last write wins       */
	MARK_CHANGED = 512,  /* changed, in a comparison                        */
	MARK_FAILED = 2048,  /* it failed in the scan that is shown               */
	MARK_FOUND_NOW = 4096, /* the current one of those, beside MARK_FOUND    */
	MARK_STALE = 8192,   /* the input or output has no new value             */
	MARK_FAULT = 16384,  /* its device does not answer, or wrongly           */
	MARK_BLOCKS = 1024,  /* it blocks power; scene.note gives the reason     */
};
struct grid_mark { int row, column; unsigned int marks; };
/** grid_mark_of - the mark of the place of a message: MARK_ERROR, MARK_WARNING or MARK_TWICE. */
unsigned int grid_mark_of(const struct diag *diag);

enum rung_state {
	RUNG_CURRENT = 1,    /* bar at the left                                 */
	RUNG_SELECTED = 2,
	RUNG_EDITED = 4,     /* not yet committed                               */
	RUNG_ADDED = 8, RUNG_REMOVED = 16, RUNG_CHANGED = 32, /* in a comparison  */
	RUNG_MARKED = 128,   /* a bookmark                                      */
	RUNG_NO_GUTTER = 64, /* paper                                           */
	RUNG_STILL = 256,    /* running, but nothing is scanned: no power anywhere */
	RUNG_MISSING = 1024, /* the board runs without it                       */
	RUNG_FOUND = 2048, RUNG_FOUND_NOW = 4096, /* the heading, by a search     */
	RUNG_ON_GUTTER = 512, /* a sheet, which draws the gutter itself           */
	RUNG_GRID = 8192,    /* faint strokes where cells meet                  */
};

struct grid_scene {
	const struct drafting *drafting;
	const struct rung_layout *layout;
	const struct rung_fold *fold;  /* of the layout; NULL: it is not folded    */
	const struct theme *theme;     /* weights now, colours when it is painted */
	const struct grid_live *live;  /* NULL: not running                       */
	const struct grid_mark *mark;
	int mark_count;
	const bool *takes;             /* cells as shown, by row, that accept the dragged
					  element; NULL: no drag */
	unsigned int state;            /* enum rung_state, or'ed                  */
	float scale;                   /* device px of a px; 0: unknown           */
	/** Text below a coil on paper ("read in Main 3, 5"), at most @room px wide in
	 * LETTER_PIN; NULL: none. Owns: the caller, g_free. */
	char *(*reference)(void *context, int row, int col, float room);
	float reference_from;          /* x: its least start                       */
	/** Note at a MARK_BLOCKS; NULL: none. Owns: the callee. NULL function: no notes. */
	const char *(*note)(void *context, int row, int column);
	void *context;
};

/** grid_draw - the strokes of a rung, added to @picture at its place. */
void grid_draw(const struct grid_scene *scene, struct picture *picture);
/** grid_draw_node - the rung as one render node, folded if the scene has a fold. Owns: the caller,
 * gsk_render_node_unref. */
GskRenderNode *grid_draw_node(const struct grid_scene *scene);

/**
 * grid_draw_icon - an element for the palette, in the middle of @width x @height px
 * @word: of the catalogue or of a project
 */
void grid_draw_icon(const struct word_row *word, const struct theme *theme,
		    struct lettering *lettering, float width, float height,
		    struct picture *picture);

#endif
