/* SPDX-License-Identifier: MIT
 *
 * grid_classic - a rung of ClassicLadder as it is in its file, as strokes; and above the
 * rungs that the import made of it.
 *
 * All its cells are drawn in their places, also those that do nothing. Drawing needs no
 * widget and no display.
 */
#ifndef EDITOR_GRID_CLASSIC_H
#define EDITOR_GRID_CLASSIC_H

#include "editor-gtk/kit/picture.h"
#include "editor-gtk/draw/rung_layout.h"

#include "engine/exchange/classic/classic_say.h"

struct classic_scene {
	const struct classic_project *project;
	const struct classic_rung *rung;
	struct lettering *lettering;
	const struct theme *theme;
};

/** grid_classic_draw - added to @picture at its place; says how high it is, and makes the
 * picture wide enough. Units: px at 100 %. */
float grid_classic_draw(const struct classic_scene *scene, struct picture *picture);

/* The rung there, above the rungs here. */
struct classic_pair {
	struct classic_scene there;
	const char *there_name;      /* "rung_3.csv"                              */
	const struct project *project; /* here                                    */
	int pou;
	const int *rung;             /* 0-based, of @pou                          */
	int rungs;                   /* 0: only the rung there                    */
	enum drafting_show show;
	const char *lost;            /* then a text instead; NULL: none           */
};

/** grid_classic_pair - added to @picture at @y, which grows with it; gives where it ends. */
float grid_classic_pair(const struct classic_pair *pair, float y, struct picture *picture);

#endif
