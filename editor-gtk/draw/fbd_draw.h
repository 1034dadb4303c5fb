/* SPDX-License-Identifier: MIT
 *
 * fbd_draw - a network of a function block diagram as strokes: boxes, wires, values, marks, heading.
 *
 * Like grid_draw for rungs: the same strokes for screen, paper, pictures and tests; no widget, no
 * display. It evaluates nothing: the caller gives live values.
 */
#ifndef EDITOR_FBD_DRAW_H
#define EDITOR_FBD_DRAW_H

#include "editor-gtk/draw/fbd_layout.h"
#include "editor-gtk/draw/grid_draw.h"

/* State of a pin while a program runs: enum live_bit; LIVE_OUT of a BOOL that is TRUE. */
struct fbd_live {
	/** State of pin @pin, and of one that is no BOOL its value as text ("" of a BOOL); 0: not known. An output
	 * gives its wire. */
	unsigned int (*pin)(void *context, int pin, char *text, size_t size);
	/** Of a box: LIVE_OUT: it runs, as EN is not FALSE; part of a timer's time, below 0: none. NULL: none. */
	unsigned int (*box)(void *context, int box, float *part);
	void *context;
};

/* A mark of a box (pin -1), of a pin, or of the wire from an output (box -1); @marks: enum mark. */
struct fbd_mark { int box, pin; unsigned int marks; };

struct fbd_scene {
	const struct fbd_layout *layout;
	const struct theme *theme;
	const struct fbd_live *live;  /* NULL: not running                        */
	const struct fbd_mark *mark;
	int mark_count;
	unsigned int state;           /* enum rung_state                           */
	float scale;                  /* device px of a px; 0: unknown              */
	float width;                  /* of the strip; 0: that of the layout        */
};

/** fbd_draw - the strokes of a network, added to @picture at its place. */
void fbd_draw(const struct fbd_scene *scene, struct picture *picture);
/** fbd_draw_node - the same as one render node. Owns: the caller, gsk_render_node_unref. */
GskRenderNode *fbd_draw_node(const struct fbd_scene *scene);

#endif
