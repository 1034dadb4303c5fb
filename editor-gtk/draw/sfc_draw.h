/* SPDX-License-Identifier: MIT
 *
 * sfc_draw - a chart as strokes: boxes, lines, texts, marks, active steps.
 *
 * Like grid_draw for rungs: the same strokes for screen, paper, pictures and tests; no
 * widget, no display, no colours.
 */
#ifndef EDITOR_SFC_DRAW_H
#define EDITOR_SFC_DRAW_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/draw/sfc_sheet.h"

/* State of a step or transition while the chart runs. */
enum sfc_bit {
	SFC_KNOWN = 1,
	SFC_ACTIVE = 2,    /* a step                                            */
	SFC_ENABLED = 4,   /* a transition: all steps before it are active       */
	SFC_TRUE = 8,      /* its condition, of an enabled one                   */
};
/* NULL pointer to it: nothing runs. */
struct sfc_live {
	const uint8_t *step, *transition; /* enum sfc_bit                      */
	/** Returns how long a step has been active; false: not shown. */
	bool (*time)(void *context, int step, char *out, size_t size);
	void *context;
};

enum sfc_sign {
	SFC_CURSOR = 1, SFC_SELECTED = 2, SFC_ERROR = 4, SFC_WARNING = 8,
	SFC_DROP = 16,     /* the dragged step may be dropped here              */
	SFC_FOUND = 32,
	SFC_FOUND_NOW = 1024, /* the current one, beside SFC_FOUND                */
	SFC_CHANGED = 64, SFC_ADDED = 128, SFC_REMOVED = 256, /* in a comparison  */
	SFC_MISSING = 512, /* the board runs without it                         */
};
struct sfc_mark { int shape, use; unsigned int signs; }; /* use -1: the shape    */

struct sfc_scene {
	const struct sfc_sheet *sheet;
	const struct theme *theme;
	const struct sfc_live *live;
	const struct sfc_mark *mark;
	int mark_count;
	float top, bottom;     /* px: draws only this part; both 0: all           */
};

/** sfc_draw - the strokes, added to @picture at its place. */
void sfc_draw(const struct sfc_scene *scene, struct picture *picture);
/** sfc_draw_node - the chart as one render node; NULL: it is empty. Owns: the caller,
 * gsk_render_node_unref. */
GskRenderNode *sfc_draw_node(const struct sfc_scene *scene);

#endif
